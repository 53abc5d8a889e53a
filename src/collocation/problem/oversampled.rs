//! The governing equations sampled on a finer grid and tested by the unknowns: Galerkin's method in
//! time, up to what aliases on the finer grid.
//!
//! Motions and own unknowns of a grid of `N` points are interpolated to `M > N` points (motions by
//! polar decomposition), where the governing equations are evaluated. Of the constraints, and of
//! the equations of internal states, the harmonics up to `(N − 1) / 2` are to vanish. So is the
//! virtual work of the forces `F_j`, `Σ_j F_jᵀ δρ_j` for all `δu_k`, where `A δρ = 2 axial(Rᵀ δG)`
//! and `δG = Σ_k w_k M_k δũ_k`. With `A μ = F` and `H = R μ̃`, the row of `δu_k` is
//! `2 axial(M_kᵀ Π H)`, where `Π` keeps the lowest harmonics: those of the forces themselves if
//! nothing turns.
//!
//! On a mapped grid all this is in pseudo-time, where virtual work has the weight `g'`; rows are
//! divided by that at the coarser grid's points, to be as large as those of collocation.
//!
//! (Harmonics of components in turning frames would not do: the highest of a multiplier in another
//! frame is beyond them, and would have no effect.) See docs/theory.md, section 10.6.

use super::Collocation;
use crate::collocation::resampled::too_coarse;
use crate::collocation::state::GridState;
use crate::collocation::tangent::Tangent;
use crate::error::Result;
use crate::fourier::{Resampling, TimeGrid};
use crate::motion::{DualMatrix, DualPolar, DualVector, append_centred};
use crate::system::{Layout, System};
use crate::workers::Workers;
use nalgebra::Vector6;
use std::ops::Range;
use std::sync::Arc;

/// The equations on the finer grid, for unknowns of the coarser.
#[derive(Debug, Clone)]
pub struct Oversampled {
    fine: Collocation,
    grid: TimeGrid,
    interpolation: Resampling,
    projection: Resampling,
    /// `M_k`: motion of node `a` at point `k` of the coarser grid, its mean position taken out, at
    /// `a N + k`.
    motions: Vec<DualMatrix>,
    /// `R` and `S` of node `a` at point `j` of the finer grid, at `a M + j`.
    polars: Vec<DualPolar>,
    /// `μ`, in the same places.
    mus: Vec<DualVector>,
    /// `Π H`, at `a N + k`.
    tests: Vec<DualMatrix>,
    /// `g'` at the points of both grids; none if time is pseudo-time.
    weights: [Vec<f64>; 2],
    scratch: Scratch,
}

/// Memory for interpolation and projection.
#[derive(Debug, Clone)]
struct Scratch {
    coarse: Vec<DualMatrix>,
    fine: Vec<DualMatrix>,
    coarse_samples: Vec<f64>,
    fine_samples: Vec<f64>,
    residual: Vec<f64>,
}

impl Oversampled {
    /// For unknowns on `grid`, sampled at `factor` times as many points, or one more.
    pub fn new(system: &Arc<System>, grid: TimeGrid, factor: usize) -> Result<Self> {
        let points = grid.points();
        let finer = grid.with_points((factor * points) | 1)?;
        let fine = Collocation::new(system.clone(), finer)?;
        let (nodes, zero) = (system.nodes(), DualMatrix::zeros());
        Ok(Oversampled {
            interpolation: Resampling::new(grid, 0.0, finer.points()),
            projection: Resampling::new(finer, 0.0, points),
            motions: Vec::with_capacity(nodes * points),
            polars: Vec::with_capacity(nodes * finer.points()),
            mus: vec![DualVector::zeros(); nodes * finer.points()],
            tests: vec![zero; nodes * points],
            weights: [grid, finer].map(|grid| {
                let slopes = grid.all_slopes().into_iter();
                slopes.map(|slope| 1.0 / slope.rate).collect()
            }),
            scratch: Scratch {
                coarse: vec![zero; points],
                fine: vec![zero; finer.points()],
                coarse_samples: vec![0.0; points],
                fine_samples: vec![0.0; finer.points()],
                residual: vec![0.0; fine.size()],
            },
            fine,
            grid,
        })
    }

    /// The equations on the finer grid.
    pub(super) fn fine_mut(&mut self) -> &mut Collocation {
        &mut self.fine
    }

    /// Numbers of points of both grids.
    fn points(&self) -> (usize, usize) {
        (self.grid.points(), self.fine.grid().points())
    }

    /// Places of the unknowns on both grids.
    fn layouts(&self) -> (Layout, Layout) {
        let coarse = self.fine.system().layout(self.grid.points());
        (coarse, self.fine.layout())
    }

    /// Writes the scaled residual.
    ///
    /// # Errors
    /// [`crate::error::ErrorKind::GridTooCoarse`] if a motion cannot be interpolated; those of the
    /// elements.
    pub fn residual(&mut self, state: &GridState, out: &mut [f64]) -> Result<()> {
        self.interpolate_motions(state)?;
        let (points, finer) = self.points();
        let resampled = state.resampled(
            self.fine.system(),
            self.grid,
            0.0,
            self.fine.grid(),
            self.fine.workers(),
        )?;
        self.fine.residual(&resampled, &mut self.scratch.residual)?;
        let (coarse, fine) = self.layouts();
        let system = self.fine.system().clone();
        weigh(
            &system,
            fine,
            &self.weights[1],
            1,
            &mut self.scratch.residual,
        );
        let scale = Vector6::from_column_slice(&self.fine.row_scale()[..6]);
        for node in 0..self.fine.system().nodes() {
            let forces = &self.scratch.residual[fine.node(node)];
            for (j, force) in forces.chunks_exact(6).enumerate() {
                let force = Vector6::from_column_slice(force).component_div(&scale);
                let polar = &self.polars[node * finer + j];
                let mu = polar.spread_inverse * DualVector::from_wrench(&force);
                self.mus[node * finer + j] = mu;
                self.scratch.fine[j] = polar.rotation * mu.skew();
            }
            self.project();
            let place = node * points;
            self.tests[place..place + points].copy_from_slice(&self.scratch.coarse);
            for (k, out) in (place..).zip(out[coarse.node(node)].chunks_exact_mut(6)) {
                let row = self.motions[k].tr_mul(&self.tests[k]).axial() * 2.0;
                let row = row.to_wrench().component_mul(&scale);
                out.copy_from_slice(row.as_slice());
            }
        }
        let residual = std::mem::take(&mut self.scratch.residual);
        self.project_own(&residual, out);
        self.scratch.residual = residual;
        weigh(&system, coarse, &self.weights[0], -1, out);
        Ok(())
    }

    /// The motions at the points of the finer grid.
    fn interpolate_motions(&mut self, state: &GridState) -> Result<()> {
        let points = self.grid.points();
        let finer = self.fine.grid();
        self.motions.clear();
        self.polars.clear();
        for node in 0..self.fine.system().nodes() {
            append_centred(state.node(node), &mut self.motions);
            let motions = &self.motions[node * points..];
            self.scratch.coarse.copy_from_slice(motions);
            self.interpolate();
            for (j, sum) in self.scratch.fine.iter().enumerate() {
                let polar =
                    DualPolar::new(sum).ok_or_else(|| too_coarse(node, finer.time(j), points))?;
                self.polars.push(polar);
            }
        }
        Ok(())
    }

    /// From `scratch.coarse` to `scratch.fine`.
    fn interpolate(&mut self) {
        let Scratch {
            coarse,
            fine,
            fine_samples,
            ..
        } = &mut self.scratch;
        resample(&mut self.interpolation, coarse, None, fine, fine_samples);
    }

    /// `Π`: from `scratch.fine` to `scratch.coarse`.
    fn project(&mut self) {
        let Scratch {
            coarse,
            fine,
            coarse_samples,
            ..
        } = &mut self.scratch;
        let most = Some(self.grid.harmonics());
        resample(&mut self.projection, fine, most, coarse, coarse_samples);
    }

    /// `Π` of the rows of the elements.
    fn project_own(&mut self, from: &[f64], out: &mut [f64]) {
        let (points, finer) = self.points();
        let samples = &mut self.scratch.coarse_samples;
        for (coarse, fine, count) in own_rows(self.fine.system(), points, finer) {
            for row in 0..count {
                self.projection
                    .read((0..finer).map(|j| from[fine + count * j + row]));
                self.projection.truncate(self.grid.harmonics());
                self.projection.write(0, 0, samples);
                for (k, value) in samples.iter().enumerate() {
                    out[coarse + count * k + row] = *value;
                }
            }
        }
    }

    /// Own unknowns of the elements on the finer grid.
    fn interpolate_own(&mut self, from: &[f64], out: &mut [f64]) {
        let (points, finer) = self.points();
        let samples = &mut self.scratch.fine_samples;
        for (coarse, fine, count) in own_rows(self.fine.system(), points, finer) {
            for row in 0..count {
                self.interpolation
                    .read((0..points).map(|k| from[coarse + count * k + row]));
                self.interpolation.write(0, 0, samples);
                for (j, value) in samples.iter().enumerate() {
                    out[fine + count * j + row] = *value;
                }
            }
        }
    }
}

/// Resamples motions entry by entry, with harmonics up to `most`.
fn resample(
    resampling: &mut Resampling,
    from: &mut [DualMatrix],
    most: Option<usize>,
    to: &mut [DualMatrix],
    samples: &mut [f64],
) {
    for (part, entry) in DualMatrix::entries() {
        resampling.read(from.iter_mut().map(|m| part(m)[entry]));
        if let Some(most) = most {
            resampling.truncate(most);
        }
        resampling.write(0, 0, samples);
        for (m, value) in to.iter_mut().zip(&*samples) {
            part(m)[entry] = *value;
        }
    }
}

/// Multiplies equations at the points of a grid by a power of these weights, if there are any.
fn weigh(system: &System, layout: Layout, weights: &[f64], power: i32, rows: &mut [f64]) {
    let mut scale = |places: Range<usize>, count: usize| {
        let points = rows[places].chunks_exact_mut(count).zip(weights);
        points.for_each(|(rows, weight)| {
            rows.iter_mut().for_each(|x| *x *= weight.powi(power));
        });
    };
    for node in 0..system.nodes() {
        scale(layout.node(node), 6);
    }
    for placed in system.elements() {
        scale(layout.element(placed), placed.element.own_unknowns().max(1));
    }
}

/// Places of the first own unknown of each element on both grids, and how many there are at a
/// point.
fn own_rows(
    system: &System,
    points: usize,
    finer: usize,
) -> impl Iterator<Item = (usize, usize, usize)> + '_ {
    let [coarse, fine] = [points, finer].map(|points| system.layout(points));
    system.elements().iter().map(move |placed| {
        let first = |layout: &Layout| layout.element(placed).start;
        (first(&coarse), first(&fine), placed.element.own_unknowns())
    })
}

/// The Jacobian of [`Oversampled`] at one state, as an operator.
#[derive(Debug)]
pub struct OversampledTangent {
    equations: Oversampled,
    tangent: Tangent,
    /// `Δρ` and `ΔG` of all nodes at the points of the finer grid, as its motions are.
    turns: Vec<DualVector>,
    sums: Vec<DualMatrix>,
    x: Vec<f64>,
    y: Vec<f64>,
}

impl OversampledTangent {
    /// Memory for the Jacobian of `equations`.
    pub fn new(equations: &Oversampled) -> Self {
        let (_, finer) = equations.points();
        let (system, size) = (equations.fine.system(), equations.fine.size());
        OversampledTangent {
            tangent: Tangent::with_resultants_apart(system, finer),
            turns: Vec::with_capacity(system.nodes() * finer),
            sums: Vec::with_capacity(system.nodes() * finer),
            x: vec![0.0; size],
            y: vec![0.0; size],
            equations: equations.clone(),
        }
    }

    /// Linearises `equations`, which may then change, at `state`.
    ///
    /// # Errors
    /// As for [`Oversampled::residual`].
    pub fn evaluate(&mut self, equations: &Oversampled, state: &GridState) -> Result<()> {
        self.equations = equations.clone();
        let equations = &mut self.equations;
        let mut residual = vec![0.0; equations.fine.system().layout(state.points()).size()];
        equations.residual(state, &mut residual)?;
        let finer = equations.fine.grid();
        let fine = state.resampled(
            equations.fine.system(),
            equations.grid,
            0.0,
            finer,
            &Workers::default(),
        )?;
        self.tangent.evaluate(&mut equations.fine, &fine)
    }

    /// Writes the product of the scaled Jacobian and `x`.
    pub fn apply(&mut self, x: &[f64], y: &mut [f64]) {
        self.extend(x);
        self.tangent
            .apply(&self.equations.fine, &self.x, &mut self.y);
        let equations = &mut self.equations;
        let (points, finer) = equations.points();
        let (coarse, fine) = equations.layouts();
        let system = equations.fine.system().clone();
        weigh(&system, fine, &equations.weights[1], 1, &mut self.y);
        // Those of all nodes and points are the same.
        let scale = Vector6::from_column_slice(&equations.fine.row_scale()[..6]);
        let column_scale = Vector6::from_column_slice(&equations.fine.column_scale()[..6]);
        for node in 0..equations.fine.system().nodes() {
            let forces = &self.y[fine.node(node)];
            for (j, force) in forces.chunks_exact(6).enumerate() {
                let force = Vector6::from_column_slice(force).component_div(&scale);
                let at = node * finer + j;
                let (polar, mu) = (&equations.polars[at], &equations.mus[at]);
                let turn = self.turns[at].skew();
                // ΔS = Rᵀ ΔG − Δρ̃ S,  A Δμ = ΔF − ΔA μ,  ΔH = R (Δρ̃ μ̃ + Δμ̃)
                let factor = polar.rotation.tr_mul(&self.sums[at]) - turn * polar.factor;
                let change = DualVector::from_wrench(&force) - factor.trace_minus() * *mu;
                let mu_change = polar.spread_inverse * change;
                equations.scratch.fine[j] = polar.rotation * (turn * mu.skew() + mu_change.skew());
            }
            equations.project();
            for k in 0..points {
                let at = node * points + k;
                let u = Vector6::from_column_slice(&x[coarse.motion(node, k)]);
                let u = DualVector::from_twist(&u.component_mul(&column_scale)).skew();
                let motion = &equations.motions[at];
                let moved = motion.tr_mul(&equations.scratch.coarse[k])
                    - u * motion.tr_mul(&equations.tests[at]);
                let row = (moved.axial() * 2.0).to_wrench().component_mul(&scale);
                y[coarse.motion(node, k)].copy_from_slice(row.as_slice());
            }
        }
        equations.project_own(&self.y, y);
        weigh(&system, coarse, &equations.weights[0], -1, y);
    }

    /// The change of the interpolated motions and own unknowns.
    fn extend(&mut self, x: &[f64]) {
        let equations = &mut self.equations;
        let (points, finer) = equations.points();
        let (coarse, fine) = equations.layouts();
        let scale = Vector6::from_column_slice(&equations.fine.column_scale()[..6]);
        self.turns.clear();
        self.sums.clear();
        for node in 0..equations.fine.system().nodes() {
            let increments = x[coarse.node(node)].chunks_exact(6);
            let motions = &equations.motions[node * points..][..points];
            let moved = &mut equations.scratch.coarse;
            for ((moved, motion), u) in moved.iter_mut().zip(motions).zip(increments) {
                let u = Vector6::from_column_slice(u).component_mul(&scale);
                *moved = *motion * DualVector::from_twist(&u).skew();
            }
            equations.interpolate();
            self.sums.extend_from_slice(&equations.scratch.fine);
            for j in 0..finer {
                let at = node * finer + j;
                // As `R` of `G = R S` turns with time.
                let turn = equations.polars[at].velocity(&self.sums[at]);
                self.turns.push(turn);
                let turn = turn.to_twist().component_div(&scale);
                self.x[fine.motion(node, j)].copy_from_slice(turn.as_slice());
            }
        }
        equations.interpolate_own(x, &mut self.x);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::test_models::small::moving_models;

    #[test]
    fn products_are_the_changes_of_the_residual() {
        for (model, period) in moving_models() {
            for (points, factor) in [(1, 3), (9, 2), (15, 3)] {
                let system = Arc::new(System::new(&model, period).unwrap());
                let grid = TimeGrid::new(points, period).unwrap();
                let mut equations = Oversampled::new(&system, grid, factor).unwrap();
                let plain = Collocation::new(system.clone(), grid).unwrap();
                let scales = plain.column_scale();
                let wave = |i: usize| (0.37 * i as f64).sin();
                let moved = |of: &GridState, wave: &dyn Fn(usize) -> f64, size: f64| {
                    let increment: Vec<f64> = scales
                        .iter()
                        .enumerate()
                        .map(|(i, s)| wave(i) * s)
                        .collect();
                    of.incremented(&system, &increment, size)
                };
                let state = moved(&GridState::reference(&system, grid), &wave, 0.05);
                let along = |i: usize| wave(3 * i + 1);
                let x: Vec<f64> = (0..plain.size()).map(along).collect();
                let mut tangent = OversampledTangent::new(&equations);
                tangent.evaluate(&equations, &state).unwrap();
                let mut found = vec![0.0; x.len()];
                tangent.apply(&x, &mut found);
                let mut at = |step: f64| {
                    let mut out = vec![0.0; x.len()];
                    let state = moved(&state, &along, step);
                    equations.residual(&state, &mut out).unwrap();
                    out
                };
                let h = 1e-3;
                let [a, b, c, d] = [at(h), at(-h), at(2.0 * h), at(-2.0 * h)];
                let size = found.iter().fold(0.0, |m: f64, y| m.max(y.abs()));
                for (i, y) in found.iter().enumerate() {
                    let slope = (8.0 * (a[i] - b[i]) - (c[i] - d[i])) / (12.0 * h);
                    // Fourth-order differences, of motions that turn by thousandths.
                    assert!(
                        (slope - y).abs() < 1e-8 * size,
                        "{points} {factor} {i}: {slope} {y} of {size}"
                    );
                }
            }
        }
    }
}
