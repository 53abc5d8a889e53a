//! The system of joints that turn: motions at these joints at all grid points, by the dynamic
//! stiffness of the bodies between them.
//!
//! ```text
//! D u + Gᵀ λ = r,   G u = g
//! ```
//!
//! with `D` circulant and `G` local in time. At each grid point `u = Y g + Z q` with `G Z = 0`, so
//! that `Zᵀ D Z q = Zᵀ (r − D Y g)`: dense, or banded in harmonics as far as those of `Z` fall off.
//! See docs/theory.md, section 8.5.

use super::constraints::Class;
use super::dense::DenseLu;
use super::harmonic_band::{HarmonicBand, Reach, Spectra};
use super::part::{Part, add_product};
use crate::collocation::Collocation;
use crate::error::Result;
use crate::fourier::Synthesis;
use crate::solve::linear::block::Block;
use crate::solve::linear::dense::probe;
use crate::workers::Workers;
use faer::prelude::ReborrowMut;

/// Multiply-adds of a dense matrix that take as long as one of a band, with its smaller products,
/// its assembly and the check of what it leaves.
const OF_DENSE: f64 = 4.0;
/// Bytes of the largest matrix.
const LARGEST: usize = 1_600_000_000;

/// What is left out of the harmonics of free motions at first, relative to all of them.
pub(super) const LEFT_OUT: f64 = 1e-3;
/// The part of an error that the band may leave.
const SHARP: f64 = 0.5;
/// What is aimed at where it leaves more. Where bodies are stiff that goes with the square of what
/// is left out: of soft motions `D Z q` is small, so that stiffness comes in on both sides of `D`.
const AIM: f64 = 0.05;
/// Least and most that is left out next, relative to last.
const SHARPER: [f64; 2] = [1e-3, 0.3];
/// Times that an error is followed to find that part; the last two count.
const FOLLOWED: usize = 5;

/// Writes forces by motions, each over the grid.
type Product<'a> = dyn FnMut(&[Vec<f64>], &mut [Vec<f64>]) + 'a;

/// Constraints that are not steady.
pub(super) struct Interface {
    points: usize,
    parts: Vec<Part>,
    /// What is kept of harmonics, if that pays.
    reach: Option<Reach>,
    bounds: Bounds,
    factors: Option<Factors>,
    /// Free motion by free motion, over the grid.
    values: Vec<f64>,
}

/// What the system may take.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bounds {
    /// Most multiply-adds.
    pub most_work: f64,
    /// Whether a band that leaves much of errors will do, as there is nothing else to try.
    pub any_band: bool,
    /// Harmonics of free motions that may be left out, as far as is known.
    pub left_out: f64,
}

enum Factors {
    Dense(DenseLu),
    Banded(Box<HarmonicBand>),
}

/// Multiply-adds of a dense system.
pub(super) fn dense_work(size: usize) -> f64 {
    (size as f64).powi(3) / 3.0
}

fn dense_bytes(size: usize) -> usize {
    size_of::<f64>() * size.pow(2)
}

/// Multiply-adds that the system of so many free motions at a grid point is likely to take.
pub(super) fn likely_work(free: usize, points: usize) -> f64 {
    let banded = OF_DENSE * Reach::usual(free, points).work();
    dense_work(free * points).min(banded)
}

impl Interface {
    /// The constraints that `classes` keep exact, on motions whose places at the first grid point
    /// are `kept`. None if more of them depend on each other at some grid points than at others,
    /// or the system would take more memory or multiply-adds than it may.
    pub fn new(
        equations: &Collocation,
        classes: &[Class],
        kept: &[(usize, usize)],
        bounds: Bounds,
    ) -> Option<Self> {
        let points = equations.grid().points();
        let parts = Part::all(equations, classes, kept)?;
        let free: usize = parts.iter().map(|part| part.free).sum();
        let mut interface = Interface {
            points,
            parts,
            reach: None,
            bounds,
            factors: None,
            values: vec![0.0; free * points],
        };
        interface.reach = interface.reach_that_pays();
        (interface.reach.is_some() || interface.may_be_dense()).then_some(interface)
    }

    /// What is kept of harmonics; none if that does not pay, or takes more than it may.
    fn reach_that_pays(&self) -> Option<Reach> {
        // The band is of cosines and sines, of which the highest harmonic of an even number of
        // points has one alone.
        if self.points.is_multiple_of(2) {
            return None;
        }
        let reach = Reach::of(&self.parts, self.points, self.bounds.left_out);
        let work = OF_DENSE * reach.work();
        let pays = work < dense_work(self.size()) || !self.may_be_dense();
        (pays && work <= self.bounds.most_work && reach.bytes() <= LARGEST).then_some(reach)
    }

    /// Whether a dense matrix takes no more work and memory than it may.
    fn may_be_dense(&self) -> bool {
        dense_bytes(self.size()) <= LARGEST && dense_work(self.size()) <= self.bounds.most_work
    }

    /// What may be left out of harmonics, as it has turned out.
    pub fn left_out(&self) -> f64 {
        self.bounds.left_out
    }

    /// Number of unknowns.
    pub fn size(&self) -> usize {
        self.values.len()
    }

    /// Multiply-adds of its factors.
    pub fn work(&self) -> f64 {
        self.reach
            .map_or(dense_work(self.size()), |reach| reach.work())
    }

    /// Bytes that they take.
    pub fn bytes(&self) -> usize {
        self.reach
            .map_or(dense_bytes(self.size()), |reach| reach.bytes())
    }

    /// Assembles and factors `Zᵀ D Z`, with the forces by motions that are kept in harmonics; these
    /// are also what `multiply` gives, over the grid. `false` if it is singular.
    ///
    /// # Errors
    /// If memory runs out.
    pub fn factor(
        &mut self,
        stiffness: &Spectra,
        multiply: &mut Product,
        workers: &Workers,
    ) -> Result<bool> {
        // The old factors' memory first.
        self.factors = None;
        while let Some(reach) = self.reach {
            workers.work().spend(OF_DENSE * reach.work());
            let Some(mut band) = HarmonicBand::new(reach, &self.parts, stiffness, workers)? else {
                self.reach = None;
                break;
            };
            let error = self.error_left(&mut band, stiffness.len(), multiply);
            // Written so that NaN is not sharp.
            let is_sharp = error <= SHARP;
            if !is_sharp {
                let [least, most] = SHARPER;
                self.bounds.left_out *= (AIM / error).sqrt().clamp(least, most).min(most);
                self.reach = self.reach_that_pays();
            }
            if is_sharp || self.bounds.any_band && self.reach.is_none() && !self.may_be_dense() {
                self.reach = Some(reach);
                self.factors = Some(Factors::Banded(Box::new(band)));
                return Ok(true);
            }
        }
        if !self.may_be_dense() {
            return Ok(false);
        }
        workers.work().spend(dense_work(self.size()));
        let dense = self.factor_densely(stiffness, workers)?;
        self.factors = dense.map(Factors::Dense);
        Ok(self.factors.is_some())
    }

    /// The part of an error in free motions that solving with the band leaves, for the errors that
    /// stay longest.
    fn error_left(&self, band: &mut HarmonicBand, kept: usize, multiply: &mut Product) -> f64 {
        let norm = |x: &[f64]| x.iter().map(|x| x * x).sum::<f64>().sqrt();
        let mut motions = vec![vec![0.0; self.points]; kept];
        let mut forces = motions.clone();
        let mut error = probe(self.size());
        let mut solved = error.clone();
        let mut sizes = vec![norm(&error)];
        for _ in 0..FOLLOWED {
            motions.iter_mut().for_each(|m| m.fill(0.0));
            self.add_motions(&error, &mut motions);
            multiply(&motions, &mut forces);
            for part in &self.parts {
                part.project(&forces, &mut solved);
            }
            band.solve(&mut solved);
            error.iter_mut().zip(&solved).for_each(|(e, s)| *e -= s);
            sizes.push(norm(&error));
        }
        (sizes[FOLLOWED] / sizes[FOLLOWED - 2]).sqrt()
    }

    fn factor_densely(&self, stiffness: &Spectra, workers: &Workers) -> Result<Option<DenseLu>> {
        let points = self.points;
        let stiffness = over_grid(stiffness, points);
        let mut matrix = Block::zeros(self.size(), self.size())?;
        let mut columns: Vec<_> = if matrix.rows() > 0 {
            let columns = matrix.as_mut().col_iter_mut();
            columns.filter_map(|c| c.try_as_col_major_mut()).collect()
        } else {
            Vec::new()
        };
        let parts = &self.parts;
        workers.for_each(
            &mut columns,
            &mut Vec::new(),
            || vec![vec![0.0; points]; stiffness.len()],
            |forces, at, column| {
                let (b, l) = (at / points, at % points);
                let last = parts.partition_point(|part| part.first <= b) - 1;
                let part = &parts[last];
                set_forces(forces, part, b - part.first, l, &stiffness);
                let column = column.rb_mut().as_slice_mut();
                parts.iter().for_each(|part| part.project(forces, column));
            },
        );
        DenseLu::new(matrix, workers)
    }

    /// Motions `Y g` that open the joints by the rows of `x`; component by component over the grid.
    pub fn determined(&self, x: &[f64], motions: &mut [Vec<f64>]) {
        for part in &self.parts {
            let rows = part.rows.len();
            for (m, &motion) in part.motions.iter().enumerate() {
                let motion = &mut motions[motion];
                motion.fill(0.0);
                for (y, &row) in part.determined[m * rows..].iter().zip(&part.rows) {
                    let g = series_of(x, row);
                    let terms = y.iter().zip(g);
                    motion
                        .iter_mut()
                        .zip(terms)
                        .for_each(|(u, (y, g))| *u += y * g);
                }
            }
        }
    }

    /// Adds the free motions `Z q` that the forces `r − D Y g` cause.
    pub fn add_free(&mut self, forces: &[Vec<f64>], motions: &mut [Vec<f64>]) {
        for part in &self.parts {
            part.project(forces, &mut self.values);
        }
        match &mut self.factors {
            Some(Factors::Dense(factors)) => factors.solve(&mut self.values),
            Some(Factors::Banded(factors)) => factors.solve(&mut self.values),
            None => (),
        }
        self.add_motions(&self.values, motions);
    }

    /// Adds `Z q`.
    fn add_motions(&self, free: &[f64], motions: &mut [Vec<f64>]) {
        for part in &self.parts {
            let own = free[part.first * self.points..].chunks_exact(self.points);
            for (b, q) in own.take(part.free).enumerate() {
                for (m, &motion) in part.motions.iter().enumerate() {
                    let direction = &part.directions[m * part.free + b];
                    add_product(&mut motions[motion], direction, q);
                }
            }
        }
    }

    /// Writes the multipliers `Yᵀ (r − D u)` of what is left of the `forces` to their places in
    /// `x`, which hold `g`.
    pub fn write_multipliers(&self, forces: &[Vec<f64>], x: &mut [f64]) {
        for part in &self.parts {
            let count = part.rows.len();
            let mut multipliers = vec![vec![0.0; self.points]; count];
            for (r, multiplier) in multipliers.iter_mut().enumerate() {
                for (m, &motion) in part.motions.iter().enumerate() {
                    add_product(multiplier, &part.determined[m * count + r], &forces[motion]);
                }
                for (s, &row) in part.rows.iter().enumerate() {
                    if let Some(redundant) = &part.redundant {
                        let terms = redundant[r * count + s].iter().zip(series_of(x, row));
                        multiplier
                            .iter_mut()
                            .zip(terms)
                            .for_each(|(m, (r, g))| *m -= r * g);
                    }
                }
            }
            for (&(first, stride), multiplier) in part.rows.iter().zip(&multipliers) {
                let places = x[first..].iter_mut().step_by(stride);
                places.zip(multiplier).for_each(|(x, m)| *x = *m);
            }
        }
    }
}

/// The same forces over the grid, by unit motions at the first grid point.
fn over_grid(stiffness: &Spectra, points: usize) -> Vec<Vec<Vec<f64>>> {
    let mut synthesis = Synthesis::new(points);
    let mut sample = |spectrum: &Vec<_>| match spectrum.is_empty() {
        true => Vec::new(),
        false => {
            let mut series = vec![0.0; points];
            synthesis.spectrum.copy_from_slice(spectrum);
            synthesis.write(&mut series);
            series.iter_mut().for_each(|x| *x /= points as f64);
            series
        }
    };
    let rows = stiffness.iter();
    rows.map(|row| row.iter().map(&mut sample).collect())
        .collect()
}

/// Writes the forces by a unit of free motion `b` of `part` at grid point `l`.
fn set_forces(
    forces: &mut [Vec<f64>],
    part: &Part,
    b: usize,
    l: usize,
    stiffness: &[Vec<Vec<f64>>],
) {
    for (force, row) in forces.iter_mut().zip(stiffness) {
        force.fill(0.0);
        let (early, late) = force.split_at_mut(l);
        for (m, &motion) in part.motions.iter().enumerate() {
            let (z, series) = (&part.directions[m * part.free + b], &row[motion]);
            let (Some(&z), false) = (z.get(l), series.is_empty()) else {
                continue;
            };
            let (begin, end) = series.split_at(series.len() - l);
            late.iter_mut().zip(begin).for_each(|(f, s)| *f += z * s);
            early.iter_mut().zip(end).for_each(|(f, s)| *f += z * s);
        }
    }
}

/// What stands at a place over the grid.
fn series_of(x: &[f64], (first, stride): (usize, usize)) -> impl Iterator<Item = &f64> {
    x[first..].iter().step_by(stride)
}

#[cfg(test)]
mod tests {
    use super::super::body_circulant::BodyCirculant;
    use super::super::constraints::Joints;
    use super::*;
    use crate::collocation::Tangent;
    use crate::solve::{PeriodicOptions, solve_periodic};
    use crate::test_models::small::crank_rocker;

    const POINTS: usize = 41;
    const BOUNDS: Bounds = Bounds {
        most_work: f64::INFINITY,
        any_band: true,
        left_out: LEFT_OUT,
    };

    /// Of a mechanism whose joints swing, at its periodic motion.
    fn swinging() -> BodyCirculant {
        let (model, period) = crank_rocker(1, 2, 3.0);
        let options = PeriodicOptions::with_grid_points(POINTS);
        let solve = solve_periodic(&model, period, &options, &mut |_, _| true).unwrap();
        let mut equations = Collocation::new(solve.system.clone(), solve.grid).unwrap();
        let mut tangent = Tangent::with_resultants_apart(equations.system(), POINTS);
        tangent.evaluate(&mut equations, &solve.state).unwrap();
        let circulant = BodyCirculant::new(&equations, &tangent, Joints::Exact, (BOUNDS, false));
        circulant.unwrap().unwrap()
    }

    #[test]
    fn the_band_is_the_dense_matrix_as_far_as_harmonics_are_kept() {
        let mut circulant = swinging();
        let stiffness = circulant.kept_stiffness();
        let interface = circulant.interface.take().unwrap();
        let workers = Workers::default();
        let band = |left_out: f64| {
            let reach = Reach::of(&interface.parts, POINTS, left_out);
            let band = HarmonicBand::new(reach, &interface.parts, &stiffness, &workers);
            band.unwrap().unwrap()
        };
        let mut dense = interface
            .factor_densely(&stiffness, &workers)
            .unwrap()
            .unwrap();
        let mut expected = probe(interface.size());
        let mut all = expected.clone();
        dense.solve(&mut expected);
        band(0.0).solve(&mut all);
        let norm = |x: &[f64]| x.iter().map(|x| x * x).sum::<f64>().sqrt();
        let difference: Vec<f64> = all.iter().zip(&expected).map(|(a, b)| a - b).collect();
        assert!(
            norm(&difference) < 1e-8 * norm(&expected),
            "{:e}",
            norm(&difference)
        );

        // What is left of errors goes with what is left out, down to where the directions of
        // motions, which constraints determine only up to turns among themselves, have a tail of
        // all harmonics: how long depends on rounding.
        let mut left = |left_out: f64| {
            let multiply = &mut |motions: &[Vec<f64>], forces: &mut [Vec<f64>]| {
                circulant.multiply_kept(motions, forces);
            };
            interface.error_left(&mut band(left_out), stiffness.len(), multiply)
        };
        let errors = [1e-2, 1e-3, 1e-4, 1e-5].map(&mut left);
        println!("{errors:?}, {:e}", left(0.0));
        assert!(left(0.0) < 1e-6);
        for (error, left_out) in errors.iter().zip([1e-2f64, 1e-3, 1e-4]) {
            assert!(*error < 500.0 * left_out, "{errors:?}");
        }
        assert!(errors[3] < 500.0 * 1e-4, "{errors:?}");
        assert!(errors[2] <= SHARP);
    }
}
