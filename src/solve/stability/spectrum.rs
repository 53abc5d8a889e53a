//! Multipliers and modes of the period map, for one number of steps.

use crate::error::{Error, ErrorKind, Result};
use crate::memory;
use crate::motion::DualVector;
use crate::solve::linear::eigenvalues::eigenvectors;
use crate::solve::modes::krylov::Random;
use crate::solve::result::Solved;
use crate::solve::stability::period_map::PeriodMap;
use faer::linalg::solvers::{PartialPivLu, Solve};
use faer::{Mat, c64};
use nalgebra::{Complex, DMatrix, Vector6};
use std::f64::consts::TAU;

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
/// Errors of multipliers fall by more than this from one number of steps to twice as many, where
/// these begin to resolve them: by 4 to 20 where blades swing far, though by 2¹⁷ in the end.
const GAIN: f64 = 10.0;
/// Most memory for the shapes of modes, in bytes.
const MOST_MEMORY: usize = 1 << 32;
/// Relative difference of multipliers that the steps resolve from those by half as many.
const ALIKE: f64 = 0.1;
/// Rounding of a step.
const ROUNDING: f64 = 1e-14;
/// Share of a mode outside the motions in time and space of one that is such a motion.
const OUTSIDE: f64 = 1e-4;
/// Distance of a multiplier from 1 that a motion in time or space may have by rounding, of which
/// that of a double one is the root, or by errors of the solution.
const NEAR_ONE: f64 = 1e-3;
/// Size of a direction that is none.
const FLAT: f64 = 1e-9;

/// A multiplier and its frequency.
pub(super) type Rough = (Complex<f64>, f64);

/// Multipliers of the modes that the steps do not kill at once.
#[derive(Debug, Clone, Default)]
pub(super) struct Spectrum {
    pub values: Vec<Complex<f64>>,
    /// Angular frequency of each over the period, with the sign of its turning.
    pub frequencies: Vec<f64>,
    pub errors: Vec<f64>,
    /// Whether the mode is a motion in time or space.
    pub shifts: Vec<bool>,
    /// Of each, the part of each disturbance that was followed.
    vectors: Vec<Vec<Complex<f64>>>,
    /// Increments of the nodes at the end of each step, of each disturbance; scaled.
    samples: Vec<Vec<Vec<f64>>>,
}

/// The spectrum of a period map of at most so many `states`; none if steps are singular.
pub(super) fn spectrum(
    map: &mut PeriodMap,
    states: usize,
    guess: usize,
    solve: &Solved,
) -> Result<Option<Spectrum>> {
    let Some(basis) = basis(map, states, guess)? else {
        return Ok(None);
    };
    let (size, count, steps) = (basis.nrows(), basis.ncols(), map.steps());
    let mut columns: Vec<Vec<f64>> = (0..count).map(|j| basis.col_as_slice(j).to_vec()).collect();
    let mut samples = Vec::with_capacity(steps);
    let mut rates = Vec::with_capacity(steps);
    let nodes = solve.system.nodes();
    if 12 * nodes * count * steps * size_of::<f64>() > MOST_MEMORY {
        let message = format!(
            "stability: no memory for {count} modes of {nodes} nodes at {steps} times; a lower \
             highest_frequency takes less"
        );
        return Err(Error::new(ErrorKind::OutOfMemory, message));
    }
    let regular = map.sweep(0..steps, &mut columns, |_, columns| {
        let part = |of: usize| -> Vec<Vec<f64>> {
            let entries = |column: &Vec<f64>| -> Vec<f64> {
                let of_nodes = column[..12 * nodes].chunks_exact(12);
                of_nodes
                    .flat_map(|node| &node[of..of + 6])
                    .copied()
                    .collect()
            };
            columns.iter().map(entries).collect()
        };
        samples.push(part(0));
        rates.push(part(6));
    })?;
    if !regular {
        return Ok(None);
    }
    let ends = Mat::from_fn(size, count, |i, j| columns[j][i]);
    let square = basis.transpose() * &ends;
    let Some((values, vectors)) = eigenvectors(&square) else {
        return Ok(None);
    };
    let mut found = Spectrum {
        errors: rounding(&square, &vectors, steps),
        vectors: (0..count)
            .map(|j| (0..count).map(|i| vectors[(i, j)]).collect())
            .collect(),
        samples,
        ..Spectrum::default()
    };
    found.values = values;
    found.make_rates(map, solve, &mut rates);
    found.frequencies = (0..count)
        .map(|j| found.frequency(j, &rates, solve))
        .collect();
    found.shifts = vec![false; count];
    let is_near_one = |value: &Complex<f64>| (value - 1.0).norm() < NEAR_ONE;
    if found.values.iter().any(is_near_one) {
        let shifts = Shifts::new(map, solve)?;
        let is_shift =
            |j: usize| is_near_one(&found.values[j]) && shifts.outside(&found, j) < OUTSIDE;
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
    loop {
        // All that there are need only obey the constraints.
        let (part, dead) = match count == states {
            true => (CLEANING, NOTHING),
            false => (steps / PART, DEAD),
        };
        let mut random = Random::new(count);
        let mut columns: Vec<Vec<f64>> = (0..count)
            .map(|_| (0..map.size()).map(|_| random.next()).collect())
            .collect();
        if !map.sweep(steps - part..steps, &mut columns, |_, _| ())? {
            return Ok(None);
        }
        let matrix = Mat::from_fn(map.size(), count, |i, j| columns[j][i]);
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
        let first = self.samples.first().and_then(|columns| columns.first());
        first.map_or(0, |column| column.len() / 6)
    }

    /// The disturbance of mode `j` at the end of a step, scaled.
    fn disturbance(&self, j: usize, step: usize) -> Vec<Complex<f64>> {
        self.combined(j, &self.samples[step])
    }

    /// What mode `j` is of the disturbances that were followed.
    fn combined(&self, j: usize, columns: &[Vec<f64>]) -> Vec<Complex<f64>> {
        let mut sum = vec![Complex::default(); columns.first().map_or(0, Vec::len)];
        for (column, part) in columns.iter().zip(&self.vectors[j]) {
            sum.iter_mut()
                .zip(column)
                .for_each(|(s, x)| *s += part * *x);
        }
        sum
    }

    /// Mode `j` at a node over the period, for this exponent; scaled.
    pub fn shape(
        &self,
        j: usize,
        node: usize,
        exponent: Complex<f64>,
        period: f64,
    ) -> Vec<[Complex<f64>; 6]> {
        let steps = self.samples.len();
        let mut largest = Complex::<f64>::default();
        let mut shape = Vec::with_capacity(steps);
        for step in 0..steps {
            let time = period * (step + 1) as f64 / steps as f64;
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
    fn make_rates(&self, map: &PeriodMap, solve: &Solved, rates: &mut [Vec<Vec<f64>>]) {
        let (length, unit) = (solve.system.scales().length, TAU / solve.grid.period());
        let units = [length, length, length, 1.0, 1.0, 1.0];
        for (step, (rates, samples)) in rates.iter_mut().zip(&self.samples).enumerate() {
            for (rates, samples) in rates.iter_mut().zip(samples) {
                let nodes = rates.chunks_exact_mut(6).zip(samples.chunks_exact(6));
                for (node, (rate, u)) in nodes.enumerate() {
                    let u = Vector6::from_fn(|i, _| u[i] * units[i]);
                    let skew = DualVector::from_twist(&map.end(step, node).twist).skew();
                    let carried = (skew * DualVector::from_twist(&u)).to_twist();
                    for i in 0..6 {
                        rate[i] = rate[i] * unit - carried[i] / units[i];
                    }
                }
            }
        }
    }

    /// Size of the rates of mode `j` relative to its own, without its growth, in the mean over the
    /// period.
    fn frequency(&self, j: usize, rates: &[Vec<Vec<f64>>], solve: &Solved) -> f64 {
        let steps = self.samples.len();
        let size = self.values[j].norm();
        let decay = size.powf(1.0 / steps as f64);
        let growth_rate = size.ln() / solve.grid.period();
        if !(decay > 0.0 && growth_rate.is_finite()) {
            return 0.0;
        }
        let (mut turning, mut square, mut of_rates) = (0.0, 0.0, 0.0);
        let mut growth = 1.0;
        for (step, rates) in rates.iter().enumerate() {
            growth *= decay;
            let now = self.combined(j, &self.samples[step]);
            for (u, rate) in now.iter().zip(self.combined(j, rates)) {
                let (u, rate) = (u / growth, (rate - u * growth_rate) / growth);
                turning += (u.conj() * rate).im;
                square += u.norm_sqr();
                of_rates += rate.norm_sqr();
            }
        }
        let frequency = (of_rates / square).sqrt().copysign(turning);
        if frequency.is_finite() {
            frequency
        } else {
            0.0
        }
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

    /// Largest error of modes of up to this frequency.
    pub fn worst(&self, highest: f64) -> f64 {
        let counts = |j: &usize| self.counts(*j) && self.frequencies[*j].abs() <= highest;
        let errors = (0..self.count()).filter(counts).map(|j| {
            let size = self.values[j].norm().max(1.0);
            self.errors[j] / size
        });
        errors.fold(0.0, f64::max)
    }

    /// Estimates errors by what came with half as many steps. Whether all are so alike that the
    /// steps resolve them.
    pub fn compare(&mut self, before: &[Rough], harmonic: f64, tolerance: f64) -> bool {
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
                    self.errors[j] += difference / GAIN;
                }
                None => self.errors[j] += 1.0,
            }
        }
        all
    }
}

/// Motions of the solution in time and of all nodes in space.
struct Shifts {
    /// Orthonormal columns that velocities, three displacements and three turns are made of; of all
    /// nodes at the ends of all steps.
    directions: DMatrix<f64>,
    nodes: usize,
}

impl Shifts {
    fn new(map: &PeriodMap, solve: &Solved) -> Result<Self> {
        let (nodes, steps) = (solve.system.nodes(), map.steps());
        let length = solve.system.scales().length;
        let scaled =
            |u: &Vector6<f64>| Vector6::from_fn(|i, _| u[i] / if i < 3 { length } else { 1.0 });
        // The basis, its decomposition, and modes beside it.
        let entries = (3 * 7 + 2) * 6 * nodes * steps;
        memory::require_items("modes over the period", entries, size_of::<f64>())?;
        let mut basis = DMatrix::zeros(6 * nodes * steps, 7);
        for step in 0..steps {
            for node in 0..nodes {
                let state = map.end(step, node);
                let row = 6 * (step * nodes + node);
                let velocity = scaled(&state.twist);
                basis.fixed_view_mut::<6, 1>(row, 0).copy_from(&velocity);
                let carried = state.motion.inverse().adjoint();
                for component in 0..6 {
                    let unit = if component < 3 { length } else { 1.0 };
                    let moved = scaled(&(carried.column(component) * unit));
                    basis
                        .fixed_view_mut::<6, 1>(row, 1 + component)
                        .copy_from(&moved);
                }
            }
        }
        for mut column in basis.column_iter_mut() {
            let size = column.norm();
            if size > 0.0 {
                column /= size;
            }
        }
        let decomposition = basis.svd(true, false);
        let sizes = decomposition.singular_values.iter();
        let kept: Vec<usize> = sizes
            .enumerate()
            .filter(|s| *s.1 > FLAT)
            .map(|s| s.0)
            .collect();
        let directions = decomposition.u.unwrap_or_default();
        Ok(Shifts {
            directions: directions.select_columns(&kept),
            nodes,
        })
    }

    /// Share of mode `j` that is no such motion.
    fn outside(&self, spectrum: &Spectrum, j: usize) -> f64 {
        let rows = 6 * self.nodes;
        let mut mode = DMatrix::zeros(self.directions.nrows(), 2);
        for step in 0..spectrum.samples.len() {
            for (i, x) in spectrum.disturbance(j, step).iter().enumerate() {
                mode[(step * rows + i, 0)] = x.re;
                mode[(step * rows + i, 1)] = x.im;
            }
        }
        let size = mode.norm();
        let parts = self.directions.tr_mul(&mode);
        mode -= &self.directions * parts;
        mode.norm() / size
    }
}
