//! Direct solution of the Jacobian of mechanisms with few freedoms: constraints are eliminated first, at each grid point by
//! itself, and what is left, dense in time, is as large as the freedoms at all grid points.
//!
//! Constraints hold at each instant, `C u = g`. With `C = L [T F]` the motions that obey them are `u = u_p + Z v`, and of the
//! equilibrium `K u + Cᵀ λ = f` there remains `Zᵀ K Z v = Zᵀ (f − K u_p)`.
//! See docs/theory.md, section 8.2.

use super::dense::{largest, solve_unit_lower, solve_upper, subtract_product};
use super::partial_lu::factor_partially;
use crate::collocation::{Collocation, Panel, Pattern};
use crate::error::Result;
use crate::workers::Workers;
use faer::{Mat, Par};

/// A constraint of which no more than this is left beside those before it waits, for one that depends on others is to be left out.
const POSTPONED: f64 = 0.1;
/// What is left of a constraint must be more than this, of one that is left out less than the other: relative to its gradient.
const SMALLEST_PIVOT: f64 = 1e-5;
const LARGEST_REMAINDER: f64 = 1e-2;
/// Pivot of the equations of the freedoms that is zero, relative to its column.
const SINGULAR: f64 = 1e-13;
/// Part of the largest violation that a constraint that was left out may keep, and one that is rounding.
const LEFT_OPEN: f64 = 0.1;
const ROUNDING: f64 = 1e-10;
/// Residual of a solve, relative to its right-hand side, that needs no refinement, and one that is too large.
const ACCURATE: f64 = 1e-10;
const INACCURATE: f64 = 1e-9;
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

/// Constraints of one grid point, eliminated: those in order are `L U` with unit pivots in `U`.
#[derive(Debug, Default)]
struct Point {
    /// The gradient, row by row.
    gradient: Vec<f64>,
    /// `L`, row by row, also of those left out; its diagonal the pivots.
    lower: Vec<f64>,
    /// `U`, row by row.
    upper: Vec<f64>,
    /// The constraints in order, then those left out.
    rows: Vec<usize>,
    /// Coordinates with pivots, in order, then those without: the freedoms.
    columns: Vec<usize>,
    /// `Z`, row by row.
    basis: Vec<f64>,
}

/// Solver for the Jacobians of one pattern.
#[derive(Debug)]
pub(super) struct FreedomSolver {
    layout: Layout,
    elements: Vec<Constraints>,
    /// All entries but those of constraints, and where their rows and columns begin.
    panels: Vec<(Panel, usize, usize)>,
    points: Vec<Point>,
    /// `Zᵀ K Z`, factored, and the order of its rows and columns.
    matrix: Mat<f64>,
    rows: Vec<usize>,
    columns: Vec<usize>,
    /// `K Z`, column by column.
    product: Vec<f64>,
    room: Room,
    /// Whether solves with the present factors are known to need no refinement.
    accurate: bool,
}

/// Scratch.
#[derive(Debug, Default)]
struct Room {
    motion: Vec<f64>,
    rest: Vec<f64>,
    wanted: Vec<f64>,
    reduced: Vec<f64>,
    permuted: Vec<f64>,
    local: Vec<f64>,
    sizes: Vec<f64>,
}

/// `Σ aᵢ bᵢ`.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// `y += factor x`.
fn add(y: &mut [f64], factor: f64, x: &[f64]) {
    y.iter_mut().zip(x).for_each(|(y, x)| *y += factor * x);
}

impl Point {
    /// Eliminates constraints, `left_out` of which depend on others. `false` if that cannot be done.
    fn eliminate(&mut self, count: usize, size: usize, left_out: usize) -> bool {
        let rank = count - left_out;
        self.lower.clear();
        self.lower.resize(count * count, 0.0);
        self.upper.clone_from(&self.gradient);
        self.rows.clear();
        self.columns.clear();
        self.columns.extend(0..size);
        // Of the constraints that wait, the one of which most is left comes first.
        let mut waiting: Vec<usize> = Vec::new();
        for row in 0..count {
            if !self.reduce(row, size, count) {
                return false;
            }
            let left = self.left_of(row, size);
            if left > POSTPONED && self.rows.len() < rank {
                self.take(row, size, count);
            } else {
                waiting.push(row);
            }
        }
        while self.rows.len() < rank {
            // They have been reduced by what came before each alone.
            let mut most = (0, 0.0);
            for (place, &row) in waiting.iter().enumerate() {
                if !self.reduce(row, size, count) {
                    return false;
                }
                let left = self.left_of(row, size);
                if left > most.1 {
                    most = (place, left);
                }
            }
            // Written so that NaN fails too.
            let enough = most.1 > SMALLEST_PIVOT;
            if !enough {
                return false;
            }
            let row = waiting.swap_remove(most.0);
            self.take(row, size, count);
        }
        for &row in &waiting {
            let reduced = self.reduce(row, size, count);
            if !reduced || self.left_of(row, size) > LARGEST_REMAINDER {
                return false;
            }
        }
        self.rows.extend(waiting);
        true
    }

    /// Takes from a constraint, which may have been reduced before, what those in order make of it. `false` if it is not finite.
    fn reduce(&mut self, row: usize, size: usize, count: usize) -> bool {
        for place in 0..self.rows.len() {
            let column = self.columns[place];
            let part = self.upper[row * size + column];
            if part == 0.0 {
                continue;
            }
            self.lower[row * count + place] = part;
            let pivot_row = self.rows[place];
            let (to, from) = two_rows(&mut self.upper, size, row, pivot_row);
            add(to, -part, from);
            to[column] = 0.0;
        }
        self.upper[row * size..][..size]
            .iter()
            .all(|x| x.is_finite())
    }

    /// What is left of a constraint, relative to its gradient.
    fn left_of(&self, row: usize, size: usize) -> f64 {
        let whole = largest(&self.gradient[row * size..][..size]);
        largest(&self.upper[row * size..][..size]) / whole.max(f64::MIN_POSITIVE)
    }

    /// Makes a reduced constraint the next in order, with its largest entry as pivot.
    fn take(&mut self, row: usize, size: usize, count: usize) {
        let place = self.rows.len();
        let entries = &mut self.upper[row * size..][..size];
        let mut best = place;
        for other in place..size {
            if entries[self.columns[other]].abs() > entries[self.columns[best]].abs() {
                best = other;
            }
        }
        self.columns.swap(place, best);
        let pivot = entries[self.columns[place]];
        entries.iter_mut().for_each(|x| *x /= pivot);
        self.lower[row * count + place] = pivot;
        self.rows.push(row);
    }

    /// Finds `Z`.
    fn find_basis(&mut self, rank: usize, size: usize) {
        let freedoms = size - rank;
        self.basis.clear();
        self.basis.resize(size * freedoms, 0.0);
        for (i, &free) in self.columns[rank..].iter().enumerate() {
            self.basis[free * freedoms + i] = 1.0;
        }
        for place in (0..rank).rev() {
            let entries = &self.upper[self.rows[place] * size..][..size];
            for i in 0..freedoms {
                let mut sum = entries[self.columns[rank + i]];
                for &later in &self.columns[place + 1..rank] {
                    sum += entries[later] * self.basis[later * freedoms + i];
                }
                self.basis[self.columns[place] * freedoms + i] = -sum;
            }
        }
    }

    /// Motion without freedoms that the constraints have these values for, `C u = g`.
    fn particular(&self, rank: usize, size: usize, values: &[f64], motion: &mut [f64]) {
        let count = self.rows.len();
        motion.fill(0.0);
        for place in 0..rank {
            let row = self.rows[place];
            let lower = &self.lower[row * count..][..count];
            let known = self.columns[..place].iter().zip(lower);
            let known: f64 = known.map(|(&column, l)| l * motion[column]).sum();
            motion[self.columns[place]] = (values[row] - known) / lower[place];
        }
        for place in (0..rank).rev() {
            let entries = &self.upper[self.rows[place] * size..][..size];
            let later = self.columns[place + 1..rank].iter();
            let known: f64 = later.map(|&column| entries[column] * motion[column]).sum();
            motion[self.columns[place]] -= known;
        }
    }

    /// Multipliers that balance these forces, `Cᵀ λ = f`, where only those on coordinates with pivots count.
    fn multipliers(&self, rank: usize, size: usize, forces: &mut [f64], multipliers: &mut [f64]) {
        let count = self.rows.len();
        for place in 0..rank {
            let entries = &self.upper[self.rows[place] * size..][..size];
            let force = forces[self.columns[place]];
            for &later in &self.columns[place + 1..rank] {
                forces[later] -= entries[later] * force;
            }
        }
        multipliers.fill(0.0);
        for place in (0..rank).rev() {
            let row = self.rows[place];
            let lower = &self.lower[row * count..][..count];
            let multiplier = forces[self.columns[place]] / lower[place];
            multipliers[row] = multiplier;
            for (&column, l) in self.columns[..place].iter().zip(lower) {
                forces[column] -= l * multiplier;
            }
        }
    }

    /// Logarithm of the determinant of `I + W Wᵀ`, where the constraints left out are `W` times the others.
    fn of_left_out(&self, rank: usize) -> f64 {
        let count = self.rows.len();
        let left_out = count - rank;
        let mut parts = vec![0.0; left_out * rank];
        for (part, &row) in parts.chunks_exact_mut(rank.max(1)).zip(&self.rows[rank..]) {
            part.copy_from_slice(&self.lower[row * count..][..rank]);
            for place in (0..rank).rev() {
                let lower = &self.lower[self.rows[place] * count..][..count];
                part[place] /= lower[place];
                let (before, from) = part.split_at_mut(place);
                add(before, -from[0], lower);
            }
        }
        let mut matrix = Mat::from_fn(left_out, left_out, |i, j| {
            let row = |i: usize| &parts[i * rank..][..rank];
            f64::from(i == j) + dot(row(i), row(j))
        });
        // Positive definite: eliminated in order.
        let mut logarithm = 0.0;
        for k in 0..left_out {
            logarithm += matrix[(k, k)].ln();
            for i in k + 1..left_out {
                let part = matrix[(i, k)] / matrix[(k, k)];
                for j in k + 1..left_out {
                    matrix[(i, j)] -= part * matrix[(k, j)];
                }
            }
        }
        logarithm
    }
}

/// Two different rows of a matrix that is stored row by row.
fn two_rows(matrix: &mut [f64], size: usize, a: usize, b: usize) -> (&mut [f64], &[f64]) {
    if a < b {
        let (before, from) = matrix.split_at_mut(b * size);
        (&mut before[a * size..][..size], &from[..size])
    } else {
        let (before, from) = matrix.split_at_mut(a * size);
        (&mut from[..size], &before[b * size..][..size])
    }
}

impl Layout {
    fn new(equations: &Collocation) -> Self {
        let (system, points) = (equations.system(), equations.grid().points());
        let nodes = system.nodes();
        let (mut coordinate_at, mut multiplier_at) = (Vec::new(), Vec::new());
        for k in 0..points {
            for node in 0..nodes {
                let first = 6 * (node * points + k);
                coordinate_at.extend(first..first + 6);
            }
            for placed in system.elements() {
                let count = placed.element.multipliers();
                let first = 6 * nodes * points + placed.first_multiplier * points + count * k;
                match placed.has_states {
                    true => coordinate_at.extend(first..first + count),
                    false => multiplier_at.extend(first..first + count),
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
}

impl FreedomSolver {
    /// For the Jacobians of `equations`, if that is much cheaper than elimination of node by node. Not where there are beams: they
    /// are stiff in tension by so much that what is left for bending would be rounding.
    pub fn new(equations: &Collocation, pattern: &Pattern) -> Option<Self> {
        let layout = Layout::new(equations);
        let (points, nodes) = (layout.points as f64, equations.system().nodes() as f64);
        let (size, freedoms) = (layout.coordinates as f64, layout.freedoms as f64);
        let constraints = layout.constraints as f64;
        // About what a node with its joints takes, one by one.
        let directly = nodes * ((6.0 * points).powi(3) + BOOKKEEPING);
        // Gradients of constraints are mostly zeros.
        let here = 0.25 * points * constraints * constraints * size
            + pattern.entries() as f64 * freedoms.max(1.0)
            + (freedoms * points).powi(3) / 3.0;
        let solvable = equations.system().slenderness() == 0.0
            && layout.constraints > 0
            && layout.rank() <= layout.constraints
            && equations.oversampled().is_none();
        if !solvable || here > 0.5 * directly {
            return None;
        }
        let groups = pattern.groups();
        let is_coordinate = |at: usize| layout.coordinate_of[at] != usize::MAX;
        let placed = pattern.panels().into_iter().map(|panel| {
            let row = groups[panel.row.0].start + panel.row.1;
            let column = groups[panel.column.0].start + panel.column.1;
            (panel, row, column)
        });
        let panels =
            placed.filter(|(_, row, column)| is_coordinate(*row) && is_coordinate(*column));
        let mut first = 0;
        let mut elements = Vec::new();
        for (element, placed) in equations.system().elements().iter().enumerate() {
            let count = placed.element.multipliers();
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
        Some(FreedomSolver {
            elements,
            panels: panels.collect(),
            points: (0..layout.points).map(|_| Point::default()).collect(),
            matrix: Mat::zeros(unknowns, unknowns),
            rows: Vec::new(),
            columns: Vec::new(),
            product: Vec::new(),
            room: Room::default(),
            accurate: false,
            layout,
        })
    }

    /// Factors the matrix with these values, of constraints that may depend on each other if `regularised`. `false` if that cannot
    /// be done, or is not sure.
    pub fn factor(
        &mut self,
        pattern: &Pattern,
        values: &[f64],
        regularised: bool,
        workers: &Workers,
    ) -> Result<bool> {
        let (count, size) = (self.layout.constraints, self.layout.coordinates);
        let rank = self.layout.rank();
        self.accurate = false;
        if count > rank && !regularised {
            return Ok(false);
        }
        for (k, point) in self.points.iter_mut().enumerate() {
            point.gradient.resize(count * size, 0.0);
            for of in &self.elements {
                for (local, &node) in of.nodes.iter().enumerate() {
                    for component in 0..6 {
                        let first = pattern.constraint_value(of.element, local, node, k, component);
                        let column = 6 * node + component;
                        for (row, value) in values[first..first + of.count].iter().enumerate() {
                            point.gradient[(of.first + row) * size + column] = *value;
                        }
                    }
                }
            }
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
        let (freedoms, size, all) = (
            layout.freedoms,
            layout.coordinates,
            layout.coordinate_of.len(),
        );
        let unknowns = freedoms * layout.points;
        if unknowns == 0 {
            return Ok(true);
        }
        self.product.clear();
        self.product.resize(all * unknowns, 0.0);
        for (panel, row, first) in &self.panels {
            for j in 0..panel.columns {
                let number = layout.coordinate_of[first + j];
                let (k, coordinate) = (number / size, number % size);
                let basis = &self.points[k].basis[coordinate * freedoms..][..freedoms];
                let entries = &values[panel.value + j * panel.stride..][..panel.rows];
                for (i, &z) in basis.iter().enumerate() {
                    if z != 0.0 {
                        let column = &mut self.product[(k * freedoms + i) * all..][..all];
                        add(&mut column[*row..], z, entries);
                    }
                }
            }
        }
        let sizes = &mut self.room.sizes;
        sizes.clear();
        for (j, product) in self.product.chunks_exact(all).enumerate() {
            let column = self.matrix.col_as_slice_mut(j);
            project(layout, &self.points, product, column);
            sizes.push(largest(column));
        }
        self.rows.clear();
        self.rows.extend(0..unknowns);
        self.columns.clone_from(&self.rows);
        let (rows, columns) = (&mut self.rows, &mut self.columns);
        let matrix = &mut self.matrix;
        let alone = (Par::Seq, workers);
        let found = factor_partially(matrix, rows, columns, sizes, SINGULAR, alone)?;
        Ok(found == unknowns)
    }

    /// Solves in place, for the `values` that were factored; constraints that depend on others get no multipliers. `false` if that is
    /// not accurate, or violates what was left out.
    pub fn solve(&mut self, values: &[f64], rhs: &mut [f64]) -> bool {
        let mut room = std::mem::take(&mut self.room);
        room.wanted.clear();
        room.wanted.extend_from_slice(rhs);
        self.substitute(values, rhs, &mut room);
        let mut solved = rhs.iter().all(|x| x.is_finite());
        if solved && !self.accurate {
            let wanted = largest(&room.wanted);
            let left = self.residual(values, rhs, &mut room);
            self.accurate = left <= ACCURATE * wanted;
            if !self.accurate {
                let mut correction = room.rest.clone();
                std::mem::swap(&mut room.wanted, &mut room.rest);
                self.substitute(values, &mut correction, &mut room);
                std::mem::swap(&mut room.wanted, &mut room.rest);
                rhs.iter_mut().zip(&correction).for_each(|(x, d)| *x += d);
                let left = self.residual(values, rhs, &mut room);
                let entries = self.panels.iter().map(|(panel, ..)| {
                    let columns = 0..panel.columns;
                    let column =
                        |j| largest(&values[panel.value + j * panel.stride..][..panel.rows]);
                    columns.map(column).fold(0.0, f64::max)
                });
                // Rounding of the product is none of the factors' fault.
                let size = wanted.max(entries.fold(1.0, f64::max) * largest(rhs));
                solved = left <= INACCURATE * size;
            }
        }
        solved = solved && self.closes_all(rhs, &room.wanted);
        self.room = room;
        solved
    }

    /// Solves in place without regard to accuracy, or to what was left out. `false` if the result is not finite.
    pub fn respond(&mut self, values: &[f64], rhs: &mut [f64]) -> bool {
        let mut room = std::mem::take(&mut self.room);
        self.substitute(values, rhs, &mut room);
        self.room = room;
        rhs.iter().all(|x| x.is_finite())
    }

    /// Replaces the right side by the solution.
    fn substitute(&self, values: &[f64], x: &mut [f64], room: &mut Room) {
        let layout = &self.layout;
        let (count, size) = (layout.constraints, layout.coordinates);
        let (freedoms, rank) = (layout.freedoms, layout.rank());
        let Room {
            motion,
            rest,
            reduced,
            permuted,
            local,
            ..
        } = room;
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
        self.subtract_forces(values, motion, rest);
        if freedoms > 0 {
            reduced.resize(freedoms * layout.points, 0.0);
            project(layout, &self.points, rest, reduced);
            permuted.clear();
            permuted.extend(self.rows.iter().map(|&row| reduced[row]));
            solve_unit_lower(|j| self.matrix.col_as_slice(j), permuted);
            solve_upper(|j| self.matrix.col_as_slice(j), permuted);
            for (&column, v) in self.columns.iter().zip(&*permuted) {
                reduced[column] = *v;
            }
            let all = x.len();
            subtract_product(rest, |j| &self.product[j * all..][..all], reduced);
            for (k, point) in self.points.iter().enumerate() {
                let v = &reduced[k * freedoms..][..freedoms];
                let places = &layout.coordinate_at[k * size..][..size];
                for (&at, z) in places.iter().zip(point.basis.chunks_exact(freedoms)) {
                    motion[at] += dot(z, v);
                }
            }
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

    /// `rest −= K u`.
    fn subtract_forces(&self, values: &[f64], motion: &[f64], rest: &mut [f64]) {
        for (panel, row, column) in &self.panels {
            subtract_product(
                &mut rest[*row..][..panel.rows],
                |j| &values[panel.value + j * panel.stride..][..panel.rows],
                &motion[*column..][..panel.columns],
            );
        }
    }

    /// Residual of a solution of the equations with the right side `room.wanted`, without the constraints left out: the largest.
    fn residual(&self, values: &[f64], x: &[f64], room: &mut Room) -> f64 {
        let layout = &self.layout;
        let (count, size) = (layout.constraints, layout.coordinates);
        let Room { rest, wanted, .. } = room;
        rest.clone_from(wanted);
        self.subtract_forces(values, x, rest);
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

    /// Sign and logarithm of the size of the determinant of the matrix that was factored, of which `regularisation` is what
    /// constraints left out have of their own, but for terms of that order.
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
            if super::direct::is_odd(order) {
                sign = -sign;
            }
        }
        (sign, logarithm)
    }
}

fn is_odd(number: usize) -> bool {
    number % 2 == 1
}

/// `Zᵀ f` of forces on all coordinates.
fn project(layout: &Layout, points: &[Point], forces: &[f64], out: &mut [f64]) {
    let (freedoms, size) = (layout.freedoms, layout.coordinates);
    out.fill(0.0);
    let parts = out.chunks_exact_mut(freedoms).zip(points).enumerate();
    for (k, (out, point)) in parts {
        let places = &layout.coordinate_at[k * size..][..size];
        for (&at, z) in places.iter().zip(point.basis.chunks_exact(freedoms)) {
            add(out, forces[at], z);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collocation::{GridState, TangentBlocks};
    use crate::elements::{Coordinate, JointKind};
    use crate::fourier::TimeGrid;
    use crate::model::{JointCoordinate, Model, Signal, SpringDefinition};
    use crate::system::System;
    use nalgebra::{Matrix3, Vector3};
    use std::sync::Arc;

    fn factored(
        solver: &mut FreedomSolver,
        pattern: &Pattern,
        values: &[f64],
        regularised: bool,
    ) -> bool {
        let alone = Workers::default();
        solver.factor(pattern, values, regularised, &alone).unwrap()
    }

    /// A planar four-bar of revolutes, three constraints of which depend on others; without its last joint a driven triple
    /// pendulum. All joints have springs, but for one that is driven.
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

    /// The solver, and the Jacobian at the reference configuration.
    fn jacobian_of(model: &Model, points: usize) -> (FreedomSolver, Pattern, Vec<f64>, f64) {
        let period = std::f64::consts::TAU / 3.0;
        let system = Arc::new(System::new(model, period).unwrap());
        let grid = TimeGrid::new(points, period).unwrap();
        let mut state = GridState::reference(&system, grid);
        for (i, multiplier) in state.multipliers.iter_mut().enumerate() {
            *multiplier = (0.9 * i as f64).sin();
        }
        let mut equations = Collocation::new(system.clone(), grid).unwrap();
        let pattern = Pattern::new(&system, points);
        let mut values = vec![0.0; pattern.entries()];
        let mut blocks = TangentBlocks::default();
        equations
            .jacobian(&state, &pattern, &mut blocks, &mut values)
            .unwrap();
        let solver = FreedomSolver::new(&equations, &pattern).unwrap();
        (solver, pattern, values, equations.regularisation())
    }

    fn dense(pattern: &Pattern, values: &[f64]) -> Mat<f64> {
        let mut matrix = Mat::zeros(pattern.size(), pattern.size());
        for (column, range) in pattern.column_pointers().windows(2).enumerate() {
            for at in range[0]..range[1] {
                matrix[(pattern.row_indices()[at], column)] = values[at];
            }
        }
        matrix
    }

    #[test]
    fn motions_and_forces_are_those_of_the_whole_jacobian() {
        for (closed, driven, points) in [
            (false, false, 1),
            (false, true, 7),
            (true, false, 5),
            (true, true, 9),
        ] {
            let (mut solver, pattern, values, regularisation) =
                jacobian_of(&four_bar(closed, driven), points);
            assert_eq!(
                solver.layout.freedoms,
                3 - 2 * usize::from(closed) - usize::from(driven)
            );
            assert!(factored(
                &mut solver,
                &pattern,
                &values,
                regularisation != 0.0
            ));
            let mut matrix = dense(&pattern, &values);
            let size = pattern.size();
            // Without the compliance.
            let exact = Mat::from_fn(size, 1, |i, _| (0.7 * i as f64).sin());
            for &at in &solver.layout.multiplier_at {
                matrix[(at, at)] = 0.0;
            }
            let rhs = &matrix * &exact;
            let mut found = rhs.col_as_slice(0).to_vec();
            assert!(solver.solve(&values, &mut found));
            let motions = 6 * 3 * points;
            for i in 0..motions {
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
    fn what_closes_no_loop_is_not_solved() {
        let (mut solver, pattern, values, _) = jacobian_of(&four_bar(true, true), 3);
        assert!(factored(&mut solver, &pattern, &values, true));
        let mut rhs = vec![0.0; pattern.size()];
        // A crank that is to move out of the plane.
        rhs[solver.layout.multiplier_at[2]] = 1.0;
        assert!(!solver.solve(&values, &mut rhs));
        // And none are left out that are not known to depend on others.
        assert!(!factored(&mut solver, &pattern, &values, false));
    }

    #[test]
    fn the_determinant_is_that_of_the_whole_jacobian() {
        for (closed, driven, points) in [(false, false, 1), (true, false, 1), (true, true, 3)] {
            let (mut solver, pattern, values, regularisation) =
                jacobian_of(&four_bar(closed, driven), points);
            assert!(factored(
                &mut solver,
                &pattern,
                &values,
                regularisation != 0.0
            ));
            let (sign, logarithm) = solver.determinant(regularisation);
            let determinant = dense(&pattern, &values).determinant();
            assert_eq!(sign, determinant.signum(), "{closed} {driven} {points}");
            // Terms of the order of the compliance, 1e-7, times the condition of the constraints.
            let error = (logarithm - determinant.abs().ln()).abs();
            assert!(error < 1e-4, "{closed} {driven} {points}: {error:e}");
        }
    }
}
