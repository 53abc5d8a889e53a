//! Multipliers and modes of the period map, for one number of steps.

use crate::error::{Error, ErrorKind, Result};
use crate::motion::DualVector;
use crate::solve::linear::eigenvalues::eigenvectors;
use crate::solve::modes::krylov::Random;
use crate::solve::result::Solved;
use crate::solve::stability::next_blade::NextBlade;
use crate::solve::stability::period_map::PeriodMap;
use crate::solve::stability::shifts::Shifts;
use faer::linalg::solvers::{PartialPivLu, Solve};
use faer::{Mat, c64};
use nalgebra::{Complex, Vector6};
use std::f64::consts::TAU;
use std::sync::Arc;

/// Disturbances tried at first, and more than were found with fewer steps.
pub(super) const FIRST: usize = 24;
const MORE: usize = 6;
/// Part of the period after which disturbances that have died away are left out: one in so many.
const PART: usize = 2;
/// Steps that make any disturbance obey the constraints.
const CLEANING: usize = 4;
/// What is left of a disturbance that has died away in that part, and of one that never was.
const DEAD: f64 = 1e-10;
const NOTHING: f64 = 1e-13;
/// Errors of multipliers fall by this power of the number of steps at least, where these begin to
/// resolve them: with twice as many by 4 to 20 where blades swing far, though by 2¹⁷ in the end.
const ORDER: f64 = 3.46;
/// Most memory for the shapes of modes, in bytes.
const MOST_MEMORY: usize = 1 << 32;
/// Relative difference of multipliers that the steps resolve from those by half as many.
const ALIKE: f64 = 0.1;
/// Rounding of a step.
const ROUNDING: f64 = 1e-14;
/// Distance of a multiplier from 1 that a motion in time or space may have by rounding, of which
/// that of a double one is the root, or by errors of the solution.
const NEAR_ONE: f64 = 1e-3;

/// A multiplier and its frequency.
pub(super) type Rough = (Complex<f64>, f64);

/// Multipliers of the modes that the steps do not kill at once.
#[derive(Debug, Clone)]
pub(super) struct Spectrum {
    pub values: Vec<Complex<f64>>,
    /// Angular frequency of each over the period, with the sign of its turning.
    pub frequencies: Vec<f64>,
    pub errors: Vec<f64>,
    /// What of them is rounding.
    rounding: Vec<f64>,
    /// Whether the mode is a motion in time or space.
    pub shifts: Vec<bool>,
    /// Disturbances at the start that were followed; scaled.
    pub basis: Mat<f64>,
    /// Of each, the part of each disturbance that was followed: real and imaginary parts.
    parts: [Mat<f64>; 2],
    /// Increments of the nodes at the end of each step of a part of the period, of each
    /// disturbance; scaled.
    samples: Vec<Mat<f64>>,
    /// Of a rotor of like blades: what happens from one part to the next, and by which factors at
    /// the places of the next blades.
    next: Option<Arc<NextBlade>>,
    factors: Vec<Complex<f64>>,
}

impl Default for Spectrum {
    fn default() -> Self {
        Spectrum {
            values: Vec::new(),
            frequencies: Vec::new(),
            errors: Vec::new(),
            rounding: Vec::new(),
            shifts: Vec::new(),
            basis: Mat::new(),
            parts: [Mat::new(), Mat::new()],
            samples: Vec::new(),
            next: None,
            factors: Vec::new(),
        }
    }
}

/// How many times larger than the error is the difference of multipliers from those by so many
/// times fewer steps, at least.
pub(super) fn gain(ratio: f64) -> f64 {
    ratio.powf(ORDER) - 1.0
}

/// The spectrum of a period map of at most so many `states`; none if steps are singular.
pub(super) fn spectrum(
    map: &mut PeriodMap,
    states: usize,
    guess: usize,
    solve: &Solved,
) -> Result<Option<Spectrum>> {
    match basis(map, states, guess)? {
        Some(basis) => within(map, basis, solve),
        None => Ok(None),
    }
}

/// The spectrum of a period map within a basis of disturbances; none if steps are singular.
pub(super) fn within(
    map: &mut PeriodMap,
    basis: Mat<f64>,
    solve: &Solved,
) -> Result<Option<Spectrum>> {
    let (count, steps) = (basis.ncols(), map.part());
    let nodes = solve.system.nodes();
    if 12 * nodes * count * steps * size_of::<f64>() > MOST_MEMORY {
        let message = format!(
            "stability: no memory for {count} modes of {nodes} nodes at {steps} times; a lower \
             highest_frequency takes less"
        );
        return Err(Error::new(ErrorKind::OutOfMemory, message));
    }
    let mut columns = basis.clone();
    let mut samples = Vec::with_capacity(steps);
    let mut rates = Vec::with_capacity(steps);
    let regular = map.over_part(&mut columns, |_, columns| {
        let part = |of: usize| {
            Mat::from_fn(6 * nodes, count, |i, j| {
                columns[(12 * (i / 6) + of + i % 6, j)]
            })
        };
        samples.push(part(0));
        rates.push(part(6));
    })?;
    if !regular {
        return Ok(None);
    }
    let square = basis.transpose() * &columns;
    let Some((mut factors, mut vectors)) = eigenvectors(&square) else {
        return Ok(None);
    };
    let mut rounding = rounding(&square, &vectors, steps);
    let next = map.next().cloned();
    let blades = next.as_ref().map_or(1, |next| next.blades) as u32;
    let values = powers(blades, &mut factors, &mut vectors);
    for (error, factor) in rounding.iter_mut().zip(&factors) {
        *error *= f64::from(blades) * factor.norm().powi(blades as i32 - 1);
    }
    let part = |of: fn(c64) -> f64| Mat::from_fn(count, count, |i, j| of(vectors[(i, j)]));
    let mut found = Spectrum {
        basis,
        errors: rounding.clone(),
        rounding,
        parts: [part(|z| z.re), part(|z| z.im)],
        samples,
        values,
        next,
        factors,
        ..Spectrum::default()
    };
    found.make_rates(map, solve, &mut rates);
    found.frequencies = found.frequencies(&rates, solve);
    found.shifts = vec![false; count];
    let is_near_one = |value: &Complex<f64>| (value - 1.0).norm() < NEAR_ONE;
    if found.values.iter().any(is_near_one) {
        let shifts = Shifts::new(map, solve)?;
        let is_shift = |j: usize| {
            let disturbances = (0..found.steps()).map(|step| found.disturbance(j, step));
            is_near_one(&found.values[j]) && shifts.contain(disturbances)
        };
        found.shifts = (0..count).map(is_shift).collect();
    }
    Ok(Some(found))
}

/// An orthonormal basis of the disturbances that obey the constraints and do not die away within
/// a part of the period, at its start.
fn basis(map: &mut PeriodMap, states: usize, guess: usize) -> Result<Option<Mat<f64>>> {
    let steps = map.steps();
    let mut count = match guess {
        0 => FIRST.min(states),
        _ if states <= FIRST => states,
        _ => (guess + MORE).min(states),
    };
    let mut random = Random::new(count);
    let mut matrix = Mat::<f64>::zeros(map.size(), 0);
    loop {
        // All that there are need only obey the constraints.
        let (part, dead) = match count == states {
            true => (CLEANING, NOTHING),
            false => (steps / PART, DEAD),
        };
        let mut more = Mat::from_fn(map.size(), count - matrix.ncols(), |_, _| random.next());
        if !map.through(part, &mut more)? {
            return Ok(None);
        }
        let before = matrix.ncols();
        matrix.resize_with(map.size(), count, |i, j| more[(i, j - before)]);
        let factors = matrix.col_piv_qr();
        let triangle = factors.thin_R();
        let largest = triangle.get(0, 0).abs();
        let alive = |j: &usize| triangle[(*j, *j)].abs() > dead * largest;
        let rank = (0..count).take_while(alive).count();
        if rank < count || count == states {
            let basis = factors.compute_thin_Q();
            return Ok(Some(basis.subcols(0, rank).to_owned()));
        }
        count = (2 * count).min(states);
    }
}

/// What disturbances are multiplied by in a period, by the `factors` of its like parts; of a pair
/// that with the positive imaginary part is put first.
fn powers(parts: u32, factors: &mut [c64], vectors: &mut Mat<c64>) -> Vec<c64> {
    let mut values: Vec<c64> = factors.iter().map(|factor| factor.powu(parts)).collect();
    let first_of_pairs = (0..values.len()).filter(|&j| factors[j].im > 0.0);
    for j in first_of_pairs.collect::<Vec<_>>() {
        if values[j].im < 0.0 {
            values.swap(j, j + 1);
            factors.swap(j, j + 1);
            for i in 0..vectors.nrows() {
                let before = vectors[(i, j)];
                vectors[(i, j)] = vectors[(i, j + 1)];
                vectors[(i, j + 1)] = before;
            }
        }
    }
    values
}

/// What rounding may do to each eigenvalue of a matrix.
fn rounding(square: &Mat<f64>, vectors: &Mat<c64>, steps: usize) -> Vec<f64> {
    let count = square.nrows();
    let identity = Mat::<c64>::identity(count, count);
    let left = PartialPivLu::new(vectors.as_ref()).solve(&identity);
    let size = square.norm_l2().max(1.0) * steps as f64;
    // Eigenvalues that are nearly double with one vector move by the root.
    let most = (ROUNDING * size).sqrt();
    let each = |j: usize| {
        let row: f64 = (0..count).map(|i| left[(j, i)].norm_sqr()).sum();
        let column: f64 = (0..count).map(|i| vectors[(i, j)].norm_sqr()).sum();
        let error = ROUNDING * size * (row * column).sqrt();
        if error.is_finite() {
            error.min(most)
        } else {
            most
        }
    };
    (0..count).map(each).collect()
}

impl Spectrum {
    /// Number of multipliers.
    pub fn count(&self) -> usize {
        self.values.len()
    }

    /// Number of nodes.
    pub fn nodes(&self) -> usize {
        self.samples
            .first()
            .map_or(0, |columns| columns.nrows() / 6)
    }

    /// Steps to the period.
    fn steps(&self) -> usize {
        self.samples.len() * self.next.as_ref().map_or(1, |next| next.blades)
    }

    /// The disturbance of mode `j` at the end of a step, scaled.
    fn disturbance(&self, j: usize, step: usize) -> Vec<Complex<f64>> {
        let columns = &self.samples[step % self.samples.len()];
        let [re, im] = self.parts.each_ref().map(|part| columns * part.col(j));
        let entries = re.iter().zip(im.iter());
        let mut all: Vec<_> = entries.map(|(re, im)| Complex::new(*re, *im)).collect();
        if let Some(next) = &self.next {
            next.later(step / self.samples.len(), self.factors[j], &mut all);
        }
        all
    }

    /// Mode `j` at a node over the period, for this exponent; scaled.
    pub fn shape(
        &self,
        j: usize,
        node: usize,
        exponent: Complex<f64>,
        period: f64,
    ) -> Vec<[Complex<f64>; 6]> {
        let steps = self.steps();
        let mut largest = Complex::<f64>::default();
        let mut shape = Vec::with_capacity(steps);
        for step in 0..steps {
            let time = period * ((step + 1) as f64 / steps as f64);
            let factor = (-exponent * time).exp();
            let all = self.disturbance(j, step);
            for x in &all {
                let x = factor * x;
                // Of equal ones the first, whatever their rounding.
                if x.norm() > largest.norm() * (1.0 + 1e-6) {
                    largest = x;
                }
            }
            shape.push(std::array::from_fn(|i| factor * all[6 * node + i]));
        }
        if largest.norm() > 0.0 {
            shape.iter_mut().flatten().for_each(|x| *x /= largest);
        }
        shape
    }

    /// Makes rates of increments, `Δu̇ = Δv − ṽ Δu`, of changes of velocities in the unit of time
    /// of the period.
    fn make_rates(&self, map: &PeriodMap, solve: &Solved, rates: &mut [Mat<f64>]) {
        let (length, unit) = (solve.system.scales().length, TAU / solve.grid.period());
        let units = [length, length, length, 1.0, 1.0, 1.0];
        for (step, (rates, samples)) in rates.iter_mut().zip(&self.samples).enumerate() {
            for node in 0..self.nodes() {
                let skew = DualVector::from_twist(&map.end(step, node).twist).skew();
                for j in 0..self.count() {
                    let u = &samples.col_as_slice(j)[6 * node..][..6];
                    let rate = &mut rates.col_as_slice_mut(j)[6 * node..][..6];
                    let u = Vector6::from_fn(|i, _| u[i] * units[i]);
                    let carried = (skew * DualVector::from_twist(&u)).to_twist();
                    for i in 0..6 {
                        rate[i] = rate[i] * unit - carried[i] / units[i];
                    }
                }
            }
        }
    }

    /// Sizes of the rates of all modes relative to their own, without their growth, in the mean
    /// over the period.
    fn frequencies(&self, rates: &[Mat<f64>], solve: &Solved) -> Vec<f64> {
        let steps = self.steps() as f64;
        // Of a pair that with the positive imaginary part, which comes first.
        let ones = (0..self.count()).filter(|&j| self.values[j].im >= 0.0);
        let ones: Vec<usize> = ones.collect();
        let of_ones =
            |part: &Mat<f64>| Mat::from_fn(self.count(), ones.len(), |i, j| part[(i, ones[j])]);
        let parts = self.parts.each_ref().map(of_ones);
        let sizes = ones.iter().map(|&j| self.values[j].norm());
        let sizes: Vec<f64> = sizes.collect();
        let mut sums = vec![[0.0; 3]; ones.len()];
        for (step, (samples, rates)) in self.samples.iter().zip(rates).enumerate() {
            let now = parts.each_ref().map(|part| samples * part);
            let rate = parts.each_ref().map(|part| rates * part);
            for (j, (sums, size)) in sums.iter_mut().zip(&sizes).enumerate() {
                let growth = size.powf((step + 1) as f64 / steps);
                let growth_rate = size.ln() / solve.grid.period();
                let [re, im] = now.each_ref().map(|part| part.col_as_slice(j));
                let [rate_re, rate_im] = rate.each_ref().map(|part| part.col_as_slice(j));
                let entries = re.iter().zip(im).zip(rate_re.iter().zip(rate_im));
                let mut step = [0.0; 3];
                for ((re, im), (rate_re, rate_im)) in entries {
                    let (rate_re, rate_im) =
                        (rate_re - growth_rate * re, rate_im - growth_rate * im);
                    step[0] += re * rate_im - im * rate_re;
                    step[1] += re * re + im * im;
                    step[2] += rate_re * rate_re + rate_im * rate_im;
                }
                for (sum, term) in sums.iter_mut().zip(step) {
                    *sum += term / growth / growth;
                }
            }
        }
        let mut frequencies = vec![0.0; self.count()];
        for (&j, [turning, square, of_rates]) in ones.iter().zip(sums) {
            let frequency = (of_rates / square).sqrt().copysign(turning);
            if frequency.is_finite() {
                frequencies[j] = frequency;
                if self.values[j].im > 0.0 {
                    frequencies[j + 1] = -frequency;
                }
            }
        }
        frequencies
    }

    /// The multipliers with their frequencies.
    pub fn rough(&self) -> Vec<Rough> {
        let all = self.values.iter().zip(&self.frequencies);
        all.map(|(value, frequency)| (*value, frequency.abs()))
            .collect()
    }

    /// Whether the error of a multiplier counts: not that of a shift, which is 1, where there are
    /// several, whose multipliers differ by the roots of their errors.
    pub fn counts(&self, j: usize) -> bool {
        !self.shifts[j] || self.shifts.iter().filter(|shift| **shift).count() == 1
    }

    /// Largest error of modes of up to this frequency with multipliers no smaller than `least`.
    pub fn worst(&self, highest: f64, least: f64) -> f64 {
        let counts = |j: &usize| {
            let within = self.frequencies[*j].abs() <= highest && self.values[*j].norm() >= least;
            self.counts(*j) && within
        };
        let errors = (0..self.count()).filter(counts).map(|j| {
            let size = self.values[j].norm().max(1.0);
            self.errors[j] / size
        });
        errors.fold(0.0, f64::max)
    }

    /// Frequencies, up to the `highest`, of the modes, each with the size of its multiplier; not of
    /// those whose multiplier is rounding, and their frequency with it.
    pub fn modes(&self, highest: f64) -> impl Iterator<Item = (f64, f64)> {
        let sizes = self.values.iter().map(|value| value.norm());
        let all = sizes.zip(&self.rounding).zip(&self.frequencies);
        let known = all.filter(|((size, rounding), _)| size > *rounding);
        let modes = known.map(|((size, _), frequency)| (frequency.abs(), size));
        modes.filter(move |mode| mode.0 <= highest)
    }

    /// Adds an error, relative to multipliers that are larger than 1, to all.
    pub fn add_error(&mut self, error: f64, tolerance: f64) {
        for (value, own) in self.values.iter().zip(&mut self.errors) {
            // Of what dies within the period nothing is known but that.
            *own += match value.norm() {
                size if size < tolerance => size,
                size => error * size.max(1.0),
            };
        }
    }

    /// Estimates errors anew by what came with fewer steps, of which there are `ratio` times as
    /// many now. Whether all are so alike that the steps resolve them.
    pub fn compare(
        &mut self,
        (before, ratio): (&[Rough], f64),
        harmonic: f64,
        tolerance: f64,
    ) -> bool {
        let gain = gain(ratio);
        self.errors.clone_from(&self.rounding);
        let mut taken = vec![false; before.len()];
        let mut all = true;
        for j in 0..self.count() {
            let (value, frequency) = (self.values[j], self.frequencies[j].abs());
            let near = |i: &usize| {
                let difference = (before[*i].1 - frequency).abs();
                !taken[*i] && difference < 0.5 * harmonic + 0.2 * frequency
            };
            let distance = |i: usize| (before[i].0 - value).norm();
            let nearest = (0..before.len())
                .filter(near)
                .min_by(|&a, &b| distance(a).total_cmp(&distance(b)));
            let difference = nearest.map_or(f64::INFINITY, distance);
            all &= difference <= ALIKE * value.norm();
            match nearest {
                // Of what dies within the period nothing is known but that.
                _ if value.norm() < tolerance => self.errors[j] += value.norm(),
                Some(i) => {
                    taken[i] = true;
                    self.errors[j] += difference / gain;
                }
                None => self.errors[j] += 1.0,
            }
        }
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn modes_whose_multiplier_is_rounding_do_not_count() {
        let spectrum = Spectrum {
            values: [0.3, 1e-13, 2e-11, 0.1].map(Complex::from).to_vec(),
            frequencies: vec![-2.0, 5.0, 7.0, 30.0],
            rounding: vec![1e-12; 4],
            ..Spectrum::default()
        };
        let found: Vec<(f64, f64)> = spectrum.modes(10.0).collect();
        assert_eq!(found, [(2.0, 0.3), (7.0, 2e-11)]);
    }
}
