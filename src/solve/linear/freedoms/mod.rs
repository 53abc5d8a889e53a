//! Direct solution of the Jacobian of mechanisms with few freedoms: constraints are eliminated
//! first, at each grid point by itself, and what is left, dense in time, is as large as the
//! freedoms at all grid points.
//!
//! Constraints hold at each instant, `C u = g`. With `C = L [T F]` the motions that obey them are
//! `u = u_p + Z v`, and of the equilibrium `K u + Cᵀ λ = f` there remains
//! `Zᵀ K Z v = Zᵀ (f − K u_p)`. See docs/theory.md, section 8.2.

mod forces;
mod point;

use crate::collocation::{Collocation, GridState, MotionTangent, Pattern};
use crate::error::Result;
use crate::solve::linear::dense::largest;
use crate::solve::linear::partial_lu::factor_partially;
use crate::solve::linear::triangles::{solve_unit_lower, solve_upper};
use crate::work::OF_FACTORS;
use crate::workers::Workers;
use faer::{Mat, Par};
use forces::{Assembled, Forces};
use point::{Point, add, dot};
use std::collections::BTreeMap;

/// Pivot of the equations of the freedoms that is zero, relative to its column.
const SINGULAR: f64 = 1e-13;
/// Part of the largest violation that a constraint that was left out may keep, and one that is
/// rounding.
const LEFT_OPEN: f64 = 0.1;
const ROUNDING: f64 = 1e-10;
/// Residual of a solve, relative to its right-hand side, that needs no refinement, and one that is
/// too large.
const ACCURATE: f64 = 1e-10;
const INACCURATE: f64 = 1e-9;
/// Freedoms up to which forces between them are found without the matrix of all motions: with more,
/// that takes longer.
const FEW: usize = 3;
/// Multiply-adds that the direct solver's bookkeeping of a node is worth.
const BOOKKEEPING: f64 = 2e4;

/// Constraints of one element at one grid point.
#[derive(Debug)]
struct Constraints {
    element: usize,
    nodes: Vec<usize>,
    /// First of them at a grid point, and their number.
    first: usize,
    count: usize,
}

impl Constraints {
    /// What their gradients are of: components of the motion of each node.
    fn columns(&self) -> impl Iterator<Item = (&usize, usize)> {
        let components = |node| (0..6).map(move |component| (node, component));
        self.nodes.iter().flat_map(components)
    }
}

/// Which unknown is what.
#[derive(Debug)]
struct Layout {
    points: usize,
    /// Coordinates, motions and internal states, at a grid point; constraints; freedoms.
    coordinates: usize,
    constraints: usize,
    freedoms: usize,
    /// Places of the coordinates and of the multipliers, grid point by grid point.
    coordinate_at: Vec<usize>,
    multiplier_at: Vec<usize>,
    /// The reverse of the first.
    coordinate_of: Vec<usize>,
}

/// Solver for the Jacobians of one pattern.
#[derive(Debug)]
pub(crate) struct FreedomSolver {
    layout: Layout,
    elements: Vec<Constraints>,
    forces: Forces,
    points: Vec<Point>,
    /// `Zᵀ K Z`, factored, and the order of its rows and columns.
    matrix: Mat<f64>,
    rows: Vec<usize>,
    columns: Vec<usize>,
    workspace: Workspace,
    /// Whether solves with the present factors are known to need no refinement.
    accurate: bool,
}

/// Scratch.
#[derive(Debug, Default)]
struct Workspace {
    motion: Vec<f64>,
    free: Vec<f64>,
    rest: Vec<f64>,
    wanted: Vec<f64>,
    reduced: Vec<f64>,
    permuted: Vec<f64>,
    local: Vec<f64>,
    sizes: Vec<f64>,
    matrix: Vec<f64>,
}

impl Layout {
    fn new(equations: &Collocation) -> Self {
        let (system, points) = (equations.system(), equations.grid().points());
        let layout = equations.layout();
        let (mut coordinate_at, mut multiplier_at) = (Vec::new(), Vec::new());
        for k in 0..points {
            (0..system.nodes()).for_each(|node| coordinate_at.extend(layout.motion(node, k)));
            for placed in system.elements() {
                match placed.has_states {
                    true => coordinate_at.extend(layout.element_at(placed, k)),
                    false => multiplier_at.extend(layout.element_at(placed, k)),
                }
            }
        }
        let mut coordinate_of = vec![usize::MAX; equations.size()];
        for (number, &at) in coordinate_at.iter().enumerate() {
            coordinate_of[at] = number;
        }
        let (coordinates, constraints) =
            (coordinate_at.len() / points, multiplier_at.len() / points);
        let independent = constraints.saturating_sub(system.redundant_constraints());
        Layout {
            points,
            coordinates,
            constraints,
            freedoms: coordinates.saturating_sub(independent),
            coordinate_at,
            multiplier_at,
            coordinate_of,
        }
    }

    /// Constraints that do not depend on each other.
    fn rank(&self) -> usize {
        self.coordinates - self.freedoms
    }

    /// `Zᵀ f` of forces on all coordinates.
    fn project(&self, points: &[Point], forces: &[f64], out: &mut [f64]) {
        let (freedoms, size) = (self.freedoms, self.coordinates);
        out.fill(0.0);
        let parts = out.chunks_exact_mut(freedoms).zip(points).enumerate();
        for (k, (out, point)) in parts {
            let places = &self.coordinate_at[k * size..][..size];
            for (&at, z) in places.iter().zip(point.basis.chunks_exact(freedoms)) {
                add(out, forces[at], z);
            }
        }
    }
}

/// Multiply-adds of eliminating constraints at all points: their gradients are mostly zeros.
fn elimination(points: f64, constraints: usize, coordinates: usize) -> f64 {
    0.25 * points * (constraints * constraints * coordinates) as f64
}

impl FreedomSolver {
    /// Multiply-adds of one factorisation, if that is much cheaper than elimination of node by
    /// node. Not where there are beams: they are stiff in tension by so much that what is left for
    /// bending would be rounding.
    pub fn work(equations: &Collocation) -> Option<f64> {
        match equations.system().slenderness() == 0.0 {
            true => Self::work_of(&Layout::new(equations), equations),
            false => None,
        }
    }

    fn work_of(layout: &Layout, equations: &Collocation) -> Option<f64> {
        let (points, nodes) = (layout.points as f64, equations.system().nodes() as f64);
        let freedoms = layout.freedoms as f64;
        // About what a node with its joints takes, one by one.
        let directly = nodes * ((6.0 * points).powi(3) + BOOKKEEPING);
        let here = elimination(points, layout.constraints, layout.coordinates)
            + entries(equations) * freedoms.max(1.0)
            + (freedoms * points).powi(3) / 3.0;
        let solvable = equations.system().slenderness() == 0.0
            && layout.constraints > 0
            && layout.rank() <= layout.constraints
            && equations.oversampled().is_none();
        (solvable && here <= 0.5 * directly).then_some(here)
    }

    /// For the Jacobians of `equations`, if that is worth it. `pattern` is asked for where the
    /// Jacobian has to be formed.
    pub fn new<'p>(equations: &Collocation, pattern: impl FnOnce() -> &'p Pattern) -> Option<Self> {
        let layout = Layout::new(equations);
        Self::work_of(&layout, equations)?;
        let mut first = 0;
        let mut elements = Vec::new();
        for (element, placed) in equations.system().elements().iter().enumerate() {
            let count = placed.element.own_unknowns();
            if count > 0 && !placed.has_states {
                let nodes = placed.element.nodes().to_vec();
                elements.push(Constraints {
                    element,
                    nodes,
                    first,
                    count,
                });
                first += count;
            }
        }
        let unknowns = layout.freedoms * layout.points;
        let tangent = match layout.freedoms <= FEW {
            true => MotionTangent::new(equations),
            false => None,
        };
        let forces = match tangent {
            Some(tangent) => Forces::Tangents(Box::new(tangent)),
            None => Forces::Assembled(Assembled::new(&layout, &elements, pattern())),
        };
        Some(FreedomSolver {
            elements,
            forces,
            points: (0..layout.points).map(|_| Point::default()).collect(),
            matrix: Mat::zeros(unknowns, unknowns),
            rows: Vec::new(),
            columns: Vec::new(),
            workspace: Workspace::default(),
            accurate: false,
            layout,
        })
    }

    /// Linearises at `state`, where the Jacobian need not be formed. `false` where its values are
    /// needed.
    pub fn evaluate(&mut self, equations: &mut Collocation, state: &GridState) -> Result<bool> {
        self.forces.evaluate(equations, state)
    }

    /// Factors the Jacobian, with these values if it was formed. `false` if that cannot be done, or
    /// is not sure.
    pub fn factor(
        &mut self,
        equations: &Collocation,
        values: &[f64],
        workers: &Workers,
    ) -> Result<bool> {
        let (count, size) = (self.layout.constraints, self.layout.coordinates);
        let rank = self.layout.rank();
        let points = self.layout.points as f64;
        let work = OF_FACTORS * elimination(points, count, size);
        workers.work().spend(work);
        self.accurate = false;
        let places = (&self.layout, &self.elements[..]);
        for (k, point) in self.points.iter_mut().enumerate() {
            point.gradient.resize(count * size, 0.0);
            let gradient = &mut point.gradient;
            self.forces
                .gradient(places, (equations, values), k, gradient);
            if !point.eliminate(count, size, count - rank) {
                return Ok(false);
            }
            point.find_basis(rank, size);
        }
        self.factor_freedoms(values, workers)
    }

    /// Forms and factors `Zᵀ K Z`.
    fn factor_freedoms(&mut self, values: &[f64], workers: &Workers) -> Result<bool> {
        let layout = &self.layout;
        let unknowns = layout.freedoms * layout.points;
        if unknowns == 0 {
            return Ok(true);
        }
        let work = OF_FACTORS * (unknowns as f64).powi(3) / 3.0;
        workers.work().spend(work);
        let formed = &mut self.workspace.matrix;
        formed.resize(unknowns * unknowns, 0.0);
        self.forces.between(layout, &self.points, values, formed);
        let sizes = &mut self.workspace.sizes;
        sizes.clear();
        for (j, column) in formed.chunks_exact(unknowns).enumerate() {
            self.matrix.col_as_slice_mut(j).copy_from_slice(column);
            sizes.push(largest(column));
        }
        self.rows.clear();
        self.rows.extend(0..unknowns);
        self.columns.clone_from(&self.rows);
        let (rows, columns) = (&mut self.rows, &mut self.columns);
        let matrix = &mut self.matrix;
        let alone = (Par::Seq, workers);
        let found = factor_partially(matrix.as_mut(), rows, columns, sizes, SINGULAR, alone)?;
        Ok(found == unknowns)
    }

    /// Solves in place, for the `values` that were factored; constraints that depend on others get
    /// no multipliers. `false` if that is not accurate, or violates what was left out.
    pub fn solve(&mut self, values: &[f64], rhs: &mut [f64]) -> bool {
        let mut workspace = std::mem::take(&mut self.workspace);
        workspace.wanted.clear();
        workspace.wanted.extend_from_slice(rhs);
        self.substitute(values, rhs, &mut workspace);
        let mut solved = rhs.iter().all(|x| x.is_finite());
        if solved && !self.accurate {
            let wanted = largest(&workspace.wanted);
            let left = self.residual(values, rhs, &mut workspace);
            self.accurate = left <= ACCURATE * wanted;
            if !self.accurate {
                let mut correction = workspace.rest.clone();
                self.substitute(values, &mut correction, &mut workspace);
                rhs.iter_mut().zip(&correction).for_each(|(x, d)| *x += d);
                let left = self.residual(values, rhs, &mut workspace);
                // Rounding of the product is none of the factors' fault.
                let size = wanted.max(self.largest(values).max(1.0) * largest(rhs));
                solved = left <= INACCURATE * size;
            }
        }
        solved = solved && self.closes_all(rhs, &workspace.wanted);
        self.workspace = workspace;
        solved
    }

    /// Solves in place without regard to accuracy, or to what was left out. `false` if the result
    /// is not finite.
    pub fn respond(&mut self, values: &[f64], rhs: &mut [f64]) -> bool {
        let mut workspace = std::mem::take(&mut self.workspace);
        self.substitute(values, rhs, &mut workspace);
        self.workspace = workspace;
        rhs.iter().all(|x| x.is_finite())
    }

    /// The largest entry of the Jacobian but for those of constraints, or about that.
    pub fn largest(&self, values: &[f64]) -> f64 {
        self.forces.largest(values)
    }

    /// Replaces the right side by the solution.
    fn substitute(&mut self, values: &[f64], x: &mut [f64], workspace: &mut Workspace) {
        let layout = &self.layout;
        let (count, size) = (layout.constraints, layout.coordinates);
        let (freedoms, rank) = (layout.freedoms, layout.rank());
        let Workspace {
            motion,
            free,
            rest,
            reduced,
            permuted,
            local,
            ..
        } = workspace;
        rest.clear();
        rest.extend_from_slice(x);
        motion.clear();
        motion.resize(x.len(), 0.0);
        for (k, point) in self.points.iter().enumerate() {
            local.clear();
            let places = &layout.multiplier_at[k * count..][..count];
            local.extend(places.iter().map(|&at| x[at]));
            local.resize(count + size, 0.0);
            let (constraints, particular) = local.split_at_mut(count);
            point.particular(rank, size, constraints, particular);
            let places = &layout.coordinate_at[k * size..][..size];
            for (&at, u) in places.iter().zip(&*particular) {
                motion[at] = *u;
            }
        }
        self.forces.subtract(values, motion, rest);
        if freedoms > 0 {
            reduced.resize(freedoms * layout.points, 0.0);
            layout.project(&self.points, rest, reduced);
            permuted.clear();
            permuted.extend(self.rows.iter().map(|&row| reduced[row]));
            solve_unit_lower(|j| self.matrix.col_as_slice(j), permuted);
            solve_upper(|j| self.matrix.col_as_slice(j), permuted);
            for (&column, v) in self.columns.iter().zip(&*permuted) {
                reduced[column] = *v;
            }
            free.resize(x.len(), 0.0);
            for (k, point) in self.points.iter().enumerate() {
                let v = &reduced[k * freedoms..][..freedoms];
                let places = &layout.coordinate_at[k * size..][..size];
                for (&at, z) in places.iter().zip(point.basis.chunks_exact(freedoms)) {
                    free[at] = dot(z, v);
                    motion[at] += free[at];
                }
            }
            self.forces.subtract(values, free, rest);
        }
        for (k, point) in self.points.iter().enumerate() {
            local.clear();
            let places = &layout.coordinate_at[k * size..][..size];
            local.extend(places.iter().map(|&at| rest[at]));
            local.resize(size + count, 0.0);
            for &at in places {
                x[at] = motion[at];
            }
            let (forces, multipliers) = local.split_at_mut(size);
            point.multipliers(rank, size, forces, multipliers);
            let places = &layout.multiplier_at[k * count..][..count];
            for (&at, multiplier) in places.iter().zip(&*multipliers) {
                x[at] = *multiplier;
            }
        }
    }

    /// Residual of a solution of the equations with the right side `workspace.wanted`, without the
    /// constraints left out: the largest.
    fn residual(&mut self, values: &[f64], x: &[f64], workspace: &mut Workspace) -> f64 {
        let layout = &self.layout;
        let (count, size) = (layout.constraints, layout.coordinates);
        let Workspace { rest, wanted, .. } = workspace;
        rest.clone_from(wanted);
        self.forces.subtract(values, x, rest);
        for (k, point) in self.points.iter().enumerate() {
            let coordinates = &layout.coordinate_at[k * size..][..size];
            let multipliers = &layout.multiplier_at[k * count..][..count];
            for (&at, gradient) in multipliers.iter().zip(point.gradient.chunks_exact(size)) {
                let multiplier = x[at];
                let mut violation = rest[at];
                for (&place, entry) in coordinates.iter().zip(gradient) {
                    violation -= entry * x[place];
                    rest[place] -= entry * multiplier;
                }
                rest[at] = violation;
            }
            for &row in &point.rows[layout.rank()..] {
                rest[multipliers[row]] = 0.0;
            }
        }
        largest(rest)
    }

    /// Whether a solution closes the constraints that were left out about as it does the others.
    fn closes_all(&self, x: &[f64], wanted: &[f64]) -> bool {
        let layout = &self.layout;
        let (count, size) = (layout.constraints, layout.coordinates);
        if count == layout.rank() {
            return true;
        }
        let values = layout.multiplier_at.iter().map(|&at| wanted[at].abs());
        let allowed = LEFT_OPEN * values.fold(0.0, f64::max) + ROUNDING;
        self.points.iter().enumerate().all(|(k, point)| {
            let coordinates = &layout.coordinate_at[k * size..][..size];
            point.rows[layout.rank()..].iter().all(|&row| {
                let gradient = &point.gradient[row * size..][..size];
                let moved = coordinates.iter().zip(gradient);
                let moved: f64 = moved.map(|(&at, entry)| entry * x[at]).sum();
                (wanted[layout.multiplier_at[k * count + row]] - moved).abs() <= allowed
            })
        })
    }

    /// Sign and logarithm of the size of the determinant of the matrix that was factored, of which
    /// `regularisation` is what constraints left out have of their own, but for terms of that
    /// order.
    pub fn determinant(&self, regularisation: f64) -> (f64, f64) {
        let layout = &self.layout;
        let (count, rank) = (layout.constraints, layout.rank());
        let (mut sign, mut logarithm) = (1.0, 0.0);
        if is_odd(count * layout.points) {
            sign = -sign;
        }
        for point in &self.points {
            for (place, &row) in point.rows[..rank].iter().enumerate() {
                logarithm += 2.0 * point.lower[row * count + place].abs().ln();
            }
            if count > rank {
                logarithm += (count - rank) as f64 * regularisation.ln() + point.of_left_out(rank);
            }
        }
        for j in 0..self.rows.len() {
            let pivot = self.matrix[(j, j)];
            sign *= pivot.signum();
            logarithm += pivot.abs().ln();
        }
        for order in [&self.rows, &self.columns] {
            if crate::solve::linear::direct::is_odd(order) {
                sign = -sign;
            }
        }
        (sign, logarithm)
    }
}

/// Entries of the Jacobian, but for those of constraints, about.
fn entries(equations: &Collocation) -> f64 {
    let (mut pairs, points) = (BTreeMap::new(), equations.grid().points() as f64);
    for placed in equations.system().elements() {
        let element = &placed.element;
        let moving = element.has_mass() || element.has_damping();
        for row in element.nodes() {
            for column in element.nodes() {
                *pairs.entry((row, column)).or_insert(false) |= moving;
            }
        }
    }
    let blocks = pairs.values().map(|&moving| match moving {
        true => points * points,
        false => points,
    });
    36.0 * blocks.sum::<f64>()
}

fn is_odd(number: usize) -> bool {
    number % 2 == 1
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::elements::{Coordinate, JointKind};
    use crate::model::{JointCoordinate, Model, Signal, SpringDefinition};
    use crate::solve::test_models::Linearised;
    use nalgebra::{Matrix3, Vector3};

    /// A planar four-bar of revolutes, three constraints of which depend on others; without its
    /// last joint a driven triple pendulum. All joints have springs, but for one that is driven.
    fn four_bar(closed: bool, driven: bool) -> Model {
        let mut model = Model::new();
        let corners = [(0.0, 0.0), (0.1, 0.3), (0.7, 0.4), (0.8, 0.0)];
        let corners = corners.map(|(x, y)| Vector3::new(x, y, 0.0));
        let mut bodies = vec![None];
        for pair in corners.windows(2) {
            let ball = Matrix3::identity() * 0.02;
            let middle = (pair[0] + pair[1]) / 2.0;
            bodies.push(Some(model.add_rigid_body(2.0, &middle, &ball).unwrap()));
        }
        bodies.push(None);
        let mut joints = Vec::new();
        for (corner, pair) in corners
            .iter()
            .zip(bodies.windows(2))
            .take(3 + usize::from(closed))
        {
            let frame = Model::frame_at("axis", corner, &Vector3::z()).unwrap();
            let kind = JointKind::Revolute;
            let joint = model.add_joint(kind, pair[0], pair[1], &frame, &frame);
            joints.push(joint.unwrap());
        }
        let at = |joint: usize| JointCoordinate {
            joint,
            coordinate: Coordinate::Rotation1,
        };
        if driven {
            let turn = Signal::harmonics(0.0, 3.0, &[], &[]).unwrap();
            model.prescribe(at(joints[0]), &turn).unwrap();
        }
        for (joint, stiffness) in joints[usize::from(driven)..].iter().zip([40.0, 25.0, 30.0]) {
            let spring = SpringDefinition {
                at: at(*joint),
                stiffness,
                damping: 2.0,
                rest: 0.1,
            };
            model.add_spring_damper(spring).unwrap();
        }
        model
    }

    /// The Jacobian at the reference configuration, and its solver after a try to factor it.
    fn factored(model: &Model, points: usize) -> (FreedomSolver, Linearised, bool) {
        let period = std::f64::consts::TAU / 3.0;
        let mut at = Linearised::new(model, period, points, |i| (0.9 * i as f64).sin());
        let mut solver = FreedomSolver::new(&at.equations, || &at.pattern).unwrap();
        let unformed = solver.evaluate(&mut at.equations, &at.state).unwrap();
        assert_eq!(unformed, points > 1);
        // What the equations are evaluated at meanwhile does not matter.
        let mut elsewhere = at.state.clone();
        for (i, motion) in elsewhere.motions.iter_mut().enumerate() {
            motion.position.x += (0.4 * i as f64).cos();
        }
        let mut residual = vec![0.0; at.equations.size()];
        at.equations.residual(&elsewhere, &mut residual).unwrap();
        let alone = Workers::default();
        let regular = solver.factor(&at.equations, &at.values, &alone).unwrap();
        (solver, at, regular)
    }

    #[test]
    fn motions_and_forces_are_those_of_the_whole_jacobian() {
        for (closed, driven, points) in [
            (false, false, 1),
            (false, true, 7),
            (true, false, 5),
            (true, true, 9),
        ] {
            let (mut solver, at, regular) = factored(&four_bar(closed, driven), points);
            assert!(regular);
            assert_eq!(
                solver.layout.freedoms,
                3 - 2 * usize::from(closed) - usize::from(driven)
            );
            let mut matrix = at.dense();
            let size = at.pattern.size();
            // Without the compliance.
            let exact = Mat::from_fn(size, 1, |i, _| (0.7 * i as f64).sin());
            for &at in &solver.layout.multiplier_at {
                matrix[(at, at)] = 0.0;
            }
            let rhs = &matrix * &exact;
            let mut found = rhs.col_as_slice(0).to_vec();
            assert!(solver.solve(&at.values, &mut found));
            for i in at.equations.layout().motions() {
                // A thousand times rounding, of a matrix whose condition is no more.
                let error = (found[i] - exact[(i, 0)]).abs();
                assert!(error < 1e-11, "{closed} {driven} {points}: {i} {error:e}");
            }
            let found = Mat::from_fn(size, 1, |i, _| found[i]);
            let left = &rhs - &matrix * &found;
            let scale = largest(rhs.col_as_slice(0));
            // Of all equations, also those of the constraints left out.
            assert!(largest(left.col_as_slice(0)) < 1e-12 * scale, "{left:?}");
        }
    }

    #[test]
    fn what_factors_lack_is_corrected() {
        let (mut solver, at, regular) = factored(&four_bar(false, true), 7);
        assert!(regular);
        solver.matrix[(0, 0)] *= 1.0 + 1e-6;
        let matrix = at.dense();
        let size = at.pattern.size();
        let exact = Mat::from_fn(size, 1, |i, _| (0.7 * i as f64).sin());
        let rhs = &matrix * &exact;
        let mut found = rhs.col_as_slice(0).to_vec();
        assert!(solver.solve(&at.values, &mut found));
        for i in at.equations.layout().motions() {
            // The square of what they lack, times a condition of a thousand.
            let error = (found[i] - exact[(i, 0)]).abs();
            assert!(error < 1e-9, "{i} {error:e}");
        }
    }

    #[test]
    fn what_closes_no_loop_is_not_solved() {
        let (mut solver, at, regular) = factored(&four_bar(true, true), 3);
        assert!(regular);
        let mut rhs = vec![0.0; at.pattern.size()];
        // A crank that is to move out of the plane.
        rhs[solver.layout.multiplier_at[2]] = 1.0;
        assert!(!solver.solve(&at.values, &mut rhs));
    }

    #[test]
    fn the_determinant_is_that_of_the_whole_jacobian() {
        for (closed, driven, points) in [(false, false, 1), (true, false, 1), (true, true, 3)] {
            let (solver, at, regular) = factored(&four_bar(closed, driven), points);
            assert!(regular);
            let (sign, logarithm) = solver.determinant(at.equations.regularisation());
            let determinant = at.dense().determinant();
            assert_eq!(sign, determinant.signum(), "{closed} {driven} {points}");
            // Terms of the order of the compliance, 1e-7, times the condition of the constraints.
            let error = (logarithm - determinant.abs().ln()).abs();
            assert!(error < 1e-4, "{closed} {driven} {points}: {error:e}");
        }
    }
}
