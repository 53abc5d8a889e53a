//! What equilibrium at each grid point leaves out: inertia and damping, of the softest motions at
//! each, which are a dense system over all grid points. See docs/theory.md, section 8.6.

use super::dense::DenseLu;
use super::interface::dense_work;
use crate::collocation::{Collocation, OverGrid, Tangent};
use crate::error::Result;
use crate::motion::DualVector;
use crate::numbers::Numbers;
use crate::solve::linear::block::{Block, column_mut};
use crate::solve::linear::blocks::strips;
use crate::solve::linear::dense::probe;
use crate::work::PRODUCT;
use crate::workers::Workers;
use faer::linalg::matmul::matmul;
use faer::{Accum, MatMut, MatRef};
use nalgebra::{DMatrix, Matrix3, Vector6};

/// Most motions at a grid point, and most over all.
const MOST: usize = 6;
const MOST_OVER_GRID: usize = 2000;
/// Fewer at a grid point leave too much out.
const LEAST: usize = 3;
/// Times that they are taken to what their inertia displaces.
const ITERATIONS: usize = 4;
/// Motions with less than this part of the inertia of others depend on them.
const DEPENDENT: f64 = 1e-14;

/// Columns that are written together.
const STRIP: usize = 64;

/// The softest motions at all grid points, and their equations.
pub(super) struct SoftMotions {
    points: usize,
    /// Motions of all nodes, one behind the other.
    shapes: Vec<Vec<f64>>,
    /// The Jacobian between them.
    whole: DenseLu,
    /// Inverses of what equilibrium makes of it, at each grid point.
    still: Vec<DMatrix<f64>>,
    /// Of the motions, in a solve, and of those of equilibrium.
    coefficients: Vec<f64>,
    at_rest: Vec<f64>,
    workers: Workers,
}

impl SoftMotions {
    /// Of `tangent`, of whose equilibrium at each grid point `solve` gives the motions by forces,
    /// in place; none if there are too few, or they have no inertia.
    ///
    /// # Errors
    /// If memory runs out, or work is to end.
    pub fn new(
        equations: &Collocation,
        tangent: &Tangent,
        solve: &mut dyn FnMut(&mut [f64]),
    ) -> Result<Option<Self>> {
        let points = equations.grid().points();
        let count = MOST.min(MOST_OVER_GRID / points);
        if count < LEAST {
            return Ok(None);
        }
        let Some(shapes) = softest(equations, tangent, solve, count) else {
            return Ok(None);
        };
        let workers = equations.workers().clone();
        workers.pulse()?;
        let numbers = equations.layout().motions().len() as f64;
        let taken = (count * ITERATIONS) as f64 * PRODUCT * numbers;
        workers.work().spend(taken + dense_work(count * points));
        let Some((matrix, still)) = projected(equations, tangent, &shapes)? else {
            return Ok(None);
        };
        let still: Option<Vec<_>> = still.into_iter().map(DMatrix::try_inverse).collect();
        let (Some(still), Some(whole)) = (still, DenseLu::new(matrix, &workers)?) else {
            return Ok(None);
        };
        Ok(Some(SoftMotions {
            points,
            shapes,
            whole,
            still,
            coefficients: vec![0.0; count * points],
            at_rest: vec![0.0; count * points],
            workers,
        }))
    }

    /// Bytes that it takes.
    pub fn bytes(&self) -> usize {
        let size = self.coefficients.len();
        let shapes: usize = self.shapes.iter().map(Vec::len).sum();
        (shapes + size * size) * size_of::<f64>()
    }

    /// What the motions by `forces` are more than those of equilibrium, times the shapes: to be
    /// added by [`SoftMotions::add`].
    pub fn find(&mut self, forces: &[f64]) {
        let (count, points) = (self.shapes.len(), self.points);
        let mut sums: Vec<&mut [f64]> = self.coefficients.chunks_exact_mut(count).collect();
        let shapes = &self.shapes;
        let per_node = 6 * points;
        self.workers.each(&mut sums, |k, sums| {
            for (sum, shape) in sums.iter_mut().zip(shapes) {
                *sum = (6 * k..shape.len())
                    .step_by(per_node)
                    .map(|at| dot6(&shape[at..], &forces[at..]))
                    .sum();
            }
        });
        let at_rest = self.at_rest.chunks_exact_mut(count).zip(&self.still);
        for ((found, inverse), values) in at_rest.zip(self.coefficients.chunks_exact(count)) {
            found.fill(0.0);
            for (column, x) in inverse.column_iter().zip(values) {
                found.iter_mut().zip(&column).for_each(|(y, a)| *y += a * x);
            }
        }
        self.whole.solve(&mut self.coefficients);
        let both = self.coefficients.iter_mut().zip(&self.at_rest);
        both.for_each(|(whole, at_rest)| *whole -= at_rest);
    }

    /// Adds what was found to motions.
    pub fn add(&self, motions: &mut [f64]) {
        let count = self.shapes.len();
        let motions = &mut motions[..self.shapes[0].len()];
        let mut nodes: Vec<_> = motions.chunks_exact_mut(6 * self.points).collect();
        self.workers.each(&mut nodes, |node, x| {
            let first = 6 * self.points * node;
            for (i, shape) in self.shapes.iter().enumerate() {
                let shape = &shape[first..][..x.len()];
                let pairs = x.chunks_exact_mut(6).zip(shape.chunks_exact(6));
                for ((x, s), c) in pairs.zip(self.coefficients[i..].iter().step_by(count)) {
                    x.iter_mut().zip(s).for_each(|(x, s)| *x += c * s);
                }
            }
        });
    }
}

fn dot6(a: &[f64], b: &[f64]) -> f64 {
    a[..6].iter().zip(&b[..6]).map(|(a, b)| a * b).sum()
}

/// Scaled inertial forces of motions.
fn inertial(equations: &Collocation, tangent: &Tangent, x: &[f64], forces: &mut [f64]) {
    let (layout, points) = (equations.layout(), equations.grid().points());
    let columns = equations.column_scale();
    let mut nodes: Vec<_> = forces.chunks_exact_mut(6 * points).collect();
    equations.workers().each(&mut nodes, |node, forces| {
        forces.fill(0.0);
        for &pair in tangent.couplings_of_row(node) {
            let column = layout.node(tangent.couplings()[pair].column).start;
            for (k, force) in forces.chunks_exact_mut(6).enumerate() {
                let at = column + 6 * k;
                let u = Vector6::from_fn(|i, _| x[at + i] * columns[at + i]);
                let sum = tangent.pair(pair, k).mass * u;
                force.iter_mut().zip(&sum).for_each(|(y, f)| *y += f);
            }
        }
        let scales = &equations.row_scale()[layout.node(node)];
        forces.iter_mut().zip(scales).for_each(|(y, s)| *y *= s);
    });
}

/// The softest motions at each grid point, orthonormal by their inertia there.
fn softest(
    equations: &Collocation,
    tangent: &Tangent,
    solve: &mut dyn FnMut(&mut [f64]),
    count: usize,
) -> Option<Vec<Vec<f64>>> {
    let (size, points) = (equations.size(), equations.grid().points());
    let motions = equations.layout().motions().len();
    let nodes = motions / (6 * points);
    let numbers = probe(6 * nodes * count);
    let mut shapes: Vec<Vec<f64>> = numbers
        .chunks_exact(6 * nodes)
        .map(|numbers| {
            let of_node = |six: &[f64]| six.repeat(points);
            numbers.chunks_exact(6).flat_map(of_node).collect()
        })
        .collect();
    let mut forces = vec![vec![0.0; motions]; count];
    let mut all = vec![0.0; size];
    for _ in 0..ITERATIONS {
        for (shape, force) in shapes.iter_mut().zip(&mut forces) {
            inertial(equations, tangent, shape, force);
            all.fill(0.0);
            all[..motions].copy_from_slice(force);
            solve(&mut all);
            shape.copy_from_slice(&all[..motions]);
            inertial(equations, tangent, shape, force);
        }
        orthonormalise(&mut shapes, &forces, points, equations.workers())?;
    }
    Some(shapes)
}

/// Makes the motions at each grid point orthonormal by their inertial forces.
fn orthonormalise(
    shapes: &mut [Vec<f64>],
    forces: &[Vec<f64>],
    points: usize,
    workers: &Workers,
) -> Option<()> {
    let mut turns: Vec<Option<DMatrix<f64>>> = vec![None; points];
    workers.each(&mut turns, |k, turn| {
        *turn = orthonormal(shapes, forces, (k, points));
    });
    let turns: Vec<DMatrix<f64>> = turns.into_iter().collect::<Option<_>>()?;
    let nodes = shapes[0].len() / (6 * points);
    let shapes = shapes
        .iter_mut()
        .map(|shape| shape.chunks_exact_mut(6 * points));
    let mut shapes: Vec<_> = shapes.collect();
    let of_node = |_| shapes.iter_mut().filter_map(Iterator::next).collect();
    let mut nodes: Vec<Vec<&mut [f64]>> = (0..nodes).map(of_node).collect();
    workers.each(&mut nodes, |_, shapes| {
        let mut row = [0.0; MOST];
        for (at, turn) in turns
            .iter()
            .enumerate()
            .flat_map(|(k, turn)| (6 * k..6 * k + 6).map(move |at| (at, turn)))
        {
            let numbers = row.iter_mut().zip(&*shapes);
            numbers.for_each(|(x, shape)| *x = shape[at]);
            for (shape, column) in shapes.iter_mut().zip(turn.column_iter()) {
                shape[at] = row.iter().zip(&column).map(|(x, t)| x * t).sum();
            }
        }
    });
    Some(())
}

/// Combinations, column by column, of motions at grid point `k` that are orthonormal by their
/// inertial forces.
fn orthonormal(
    shapes: &[Vec<f64>],
    forces: &[Vec<f64>],
    (k, points): (usize, usize),
) -> Option<DMatrix<f64>> {
    let count = shapes.len();
    let gram = DMatrix::from_fn(count, count, |i, j| {
        (6 * k..shapes[0].len())
            .step_by(6 * points)
            .map(|at| dot6(&shapes[i][at..], &forces[j][at..]))
            .sum()
    });
    let gram = (&gram + gram.transpose()) * 0.5;
    let eigen = gram.symmetric_eigen();
    let largest = eigen.eigenvalues.max();
    // Written so that NaN does not count.
    let apart = largest > 0.0 && eigen.eigenvalues.min() >= DEPENDENT * largest;
    if !apart {
        return None;
    }
    let mut turn = eigen.eigenvectors;
    for (mut column, value) in turn.column_iter_mut().zip(&eigen.eigenvalues) {
        column /= value.sqrt();
    }
    Some(turn)
}

/// The Jacobian between motions, and that of equilibrium at each grid point.
type Projected = (Block, Vec<DMatrix<f64>>);

/// Both; none where rates are not those of series over the grid.
fn projected(
    equations: &Collocation,
    tangent: &Tangent,
    shapes: &[Vec<f64>],
) -> Result<Option<Projected>> {
    let (workers, points, count) = (equations.workers(), equations.grid().points(), shapes.len());
    let rule = tangent.rule(equations);
    let Some(over) = rule.over_grid() else {
        return Ok(None);
    };
    let (columns, size) = (equations.column_scale(), count * points);
    let unscaled: Vec<Vec<Vector6<f64>>> = shapes
        .iter()
        .map(|shape| {
            let six = shape.chunks_exact(6).zip(columns.chunks_exact(6));
            six.map(|(s, c)| Vector6::from_fn(|i, _| s[i] * c[i]))
                .collect()
        })
        .collect();
    // Column by column: of one motion at one grid point.
    let width = ENTRIES * over.kinematics.len();
    let side = || Numbers::room("the softest motions", width * size);
    let mut sides = [side()?, side()?, side()?];
    let mut here = vec![Here::new(count); points];
    let [by_first, by_second, motions] =
        sides.each_mut().map(|side| side.chunks_mut(width * count));
    let of_points = by_first.zip(by_second).zip(motions).zip(&mut here);
    let mut of_points: Vec<_> = of_points.collect();
    workers.each(&mut of_points, |k, (((first, second), motions), here)| {
        let at = AtPoint {
            equations,
            tangent,
            shapes,
            unscaled: &unscaled,
            k,
        };
        at.write(&over, here, [first, second, motions]);
    });
    let [by_first, by_second, motions] = sides
        .each_ref()
        .map(|side| MatRef::from_column_major_slice(side, width, size));
    let product = |by: MatRef<f64>| -> Result<Block> {
        let mut product = Block::default();
        product.resize(size, size)?;
        workers.dense(|par| {
            let to = product.as_mut();
            matmul(to, Accum::Replace, by.transpose(), motions, 0.5, par);
        });
        Ok(product)
    };
    let (mut whole, second) = (product(by_first)?, product(by_second)?);
    let write = |first: usize, mut columns: MatMut<f64>| {
        for column in 0..columns.ncols() {
            let (l, j) = ((first + column) / count, (first + column) % count);
            let parts = column_mut(&mut columns, column).chunks_exact_mut(count);
            let seconds = second.column(first + column).chunks_exact(count);
            for (k, (part, second)) in parts.zip(seconds).enumerate() {
                let [d, t] = [over.operators.first(k, l), over.operators.second(k, l)];
                let both = part.iter_mut().zip(second);
                both.for_each(|(whole, second)| *whole = d * *whole + t * second);
            }
            let Here { still, moving } = &here[l];
            let own = still.column(j) + moving.column(j);
            column_mut(&mut columns, column)[count * l..][..count].copy_from_slice(own.as_slice());
        }
        Ok(())
    };
    workers.dense(|par| strips(whole.as_mut(), STRIP, (par, workers), &write))?;
    let still = here.into_iter().map(|here| here.still);
    Ok(Some((whole, still.collect())))
}

/// The Jacobian between motions at one grid point: that of equilibrium, and all else.
#[derive(Clone)]
struct Here {
    still: DMatrix<f64>,
    moving: DMatrix<f64>,
}

impl Here {
    fn new(count: usize) -> Self {
        let still = DMatrix::zeros(count, count);
        let moving = still.clone();
        Here { still, moving }
    }
}

/// Entries of a dual matrix.
const ENTRIES: usize = 18;

/// Motions at a grid point.
struct AtPoint<'a> {
    equations: &'a Collocation,
    tangent: &'a Tangent,
    shapes: &'a [Vec<f64>],
    unscaled: &'a [Vec<Vector6<f64>>],
    k: usize,
}

impl AtPoint<'_> {
    /// Writes the Jacobian there, and what that of other grid points is products of
    /// (docs/theory.md, section 8.6): `M (p̃ + 2 ṽ q̃)` and `M q̃` of what velocities and
    /// accelerations are multiplied by, and `M ũ`.
    fn write(
        &self,
        over: &OverGrid,
        Here { still, moving }: &mut Here,
        [by_first, by_second, motions]: [&mut [f64]; 3],
    ) {
        let (k, points, count) = (self.k, self.equations.grid().points(), self.shapes.len());
        let nodes = over.kinematics.len();
        let work = self.work(still);
        let rule = self.tangent.rule(self.equations);
        for (node, kinematics) in over.kinematics.iter().enumerate() {
            let (motion, velocity) = (kinematics.motion(k), kinematics.velocity(k));
            let spread = kinematics.first(k).trace_minus_transpose();
            let [here_v, here_a] = rule
                .tangent(node, 0, k, k)
                .map(|gamma| gamma.to_twist_matrix());
            for i in 0..count {
                let [by_velocity, by_acceleration] = work[node * count + i];
                let here = here_v.tr_mul(&by_velocity) + here_a.tr_mul(&by_acceleration);
                for (j, u) in self.unscaled.iter().enumerate() {
                    moving[(i, j)] += here.dot(&u[node * points + k]);
                }
                let slope = over.slopes.get(k);
                let [by_velocity, by_acceleration] = slope
                    .map_or([by_velocity, by_acceleration], |slope| {
                        slope.transposed(by_velocity, by_acceleration)
                    });
                let q = DualVector::from_wrench(&by_acceleration);
                let p = DualVector::from_wrench(&by_velocity) - spread * q;
                let first = motion * (p.skew() + velocity.skew() * q.skew() * 2.0);
                let second = motion * q.skew();
                let u = DualVector::from_twist(&self.unscaled[i][node * points + k]);
                let at = (i * nodes + node) * ENTRIES;
                let put = |side: &mut [f64], [a, b]: [&Matrix3<f64>; 2]| {
                    side[at..][..9].copy_from_slice(a.as_slice());
                    side[at + 9..][..9].copy_from_slice(b.as_slice());
                };
                // What is multiplied with each other is one's primal and the other's dual part.
                put(by_first, [&first.primal, &first.dual]);
                put(by_second, [&second.primal, &second.dual]);
                let moved = motion.times_skew(&u);
                put(motions, [&moved.dual, &moved.primal]);
            }
        }
    }

    /// What velocities and accelerations of the nodes are multiplied by in the equation of each
    /// motion.
    fn work(&self, still: &mut DMatrix<f64>) -> Vec<[Vector6<f64>; 2]> {
        let (layout, points) = (self.equations.layout(), self.equations.grid().points());
        let (k, count, rows) = (self.k, self.shapes.len(), self.equations.row_scale());
        let nodes = self.equations.system().nodes();
        let mut work = vec![[Vector6::zeros(); 2]; nodes * count];
        for (pair, coupling) in self.tangent.couplings().iter().enumerate() {
            let [stiffness, damping] = self.tangent.whole_pair(pair, k);
            let mass = self.tangent.pair(pair, k).mass;
            let at = layout.node(coupling.row).start + 6 * k;
            for (i, shape) in self.shapes.iter().enumerate() {
                let test = Vector6::from_fn(|c, _| shape[at + c] * rows[at + c]);
                let [by_velocity, by_acceleration] = &mut work[coupling.column * count + i];
                *by_velocity += damping.tr_mul(&test);
                *by_acceleration += mass.tr_mul(&test);
                let by_motion = stiffness.tr_mul(&test);
                for (j, u) in self.unscaled.iter().enumerate() {
                    still[(i, j)] += by_motion.dot(&u[coupling.column * points + k]);
                }
            }
        }
        work
    }
}

#[cfg(test)]
mod tests {
    use super::super::time_local::TimeLocal;
    use super::*;
    use crate::collocation::GridState;
    use crate::fourier::{SharpEvent, TimeGrid, TimeMap};
    use crate::solve::{PeriodicOptions, solve_periodic};
    use crate::test_models::small::crank_rocker;

    /// On an even grid and on a mapped one, of a motion that turns and bends.
    #[test]
    fn the_jacobian_between_motions_is_that_of_products() {
        let (model, period) = crank_rocker(1, 2, 3.0);
        let options = PeriodicOptions::with_grid_points(15);
        let solved = solve_periodic(&model, period, &options, &mut |_, _| true).unwrap();
        let event = SharpEvent {
            time: 0.3,
            width: 0.05,
            share: 0.7,
        };
        let map = TimeMap::new(&[event], 1.0).unwrap();
        for map in [TimeMap::default(), map] {
            let grid = TimeGrid::new(15, period).unwrap().mapped(map);
            let mut equations = Collocation::new(solved.system.clone(), grid).unwrap();
            let state: &GridState = &solved.state;
            let mut tangent = Tangent::with_resultants_apart(&solved.system, 15);
            tangent.evaluate(&mut equations, state).unwrap();
            let mut local = TimeLocal::new(&equations, &tangent, false).unwrap();
            let shapes = softest(&equations, &tangent, &mut |x| local.apply_alone(x), 3).unwrap();
            let (whole, _) = projected(&equations, &tangent, &shapes).unwrap().unwrap();
            let motions = equations.layout().motions().len();
            let of_point = |shape: &[f64], k: usize| -> Vec<f64> {
                let here = |(at, x): (usize, &f64)| if at / 6 % 15 == k { *x } else { 0.0 };
                shape.iter().enumerate().map(here).collect()
            };
            let largest = whole
                .as_ref()
                .col_iter()
                .flat_map(|c| c.iter())
                .fold(0.0f64, |m, x| m.max(x.abs()));
            for (j, l) in [(0, 4), (1, 0), (2, 13)] {
                let mut x = vec![0.0; equations.size()];
                x[..motions].copy_from_slice(&of_point(&shapes[j], l));
                let mut y = vec![0.0; equations.size()];
                tangent.apply(&equations, &x, &mut y);
                for (i, shape) in shapes.iter().enumerate() {
                    for k in 0..15 {
                        let test = of_point(shape, k);
                        let exact: f64 = test.iter().zip(&y).map(|(a, b)| a * b).sum();
                        let error = (whole.column(3 * l + j)[3 * k + i] - exact).abs();
                        assert!(
                            error < 1e-9 * largest,
                            "{i} {k} {j} {l}: {error:e} {exact:e}"
                        );
                    }
                }
            }
        }
    }
}
