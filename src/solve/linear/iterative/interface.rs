//! The dense system of joints that turn: motions at these joints at all grid points, by the dynamic
//! stiffness of the bodies between them.
//!
//! ```text
//! D u + Gᵀ λ = r,   G u = g
//! ```
//!
//! with `D` circulant and `G` local in time. At each grid point `u = Y g + Z q` with `G Z = 0`, so
//! that `Zᵀ D Z q = Zᵀ (r − D Y g)`. See docs/theory.md, section 8.5.

use super::constraints::Class;
use super::dense::{DenseLu, zeros};
use crate::collocation::Collocation;
use crate::error::Result;
use crate::workers::Workers;
use faer::prelude::ReborrowMut;
use nalgebra::{DMatrix, DVector};

/// Singular values of gradients below this, relative to the largest, are those of constraints that
/// depend on others.
const DEPENDENT: f64 = 1e-9;

/// Constraints that are not steady.
pub(super) struct Interface {
    points: usize,
    parts: Vec<Part>,
    factors: Option<DenseLu>,
    values: Vec<f64>,
}

/// Constraints that share motions. Matrices stand entry by entry, each over the grid.
struct Part {
    /// Of each row of `G`: its place at the first grid point, and from one grid point to the next.
    rows: Vec<(usize, usize)>,
    /// Which of the motions that are kept it constrains.
    motions: Vec<usize>,
    /// Free motions of the parts before this one, and its own.
    first: usize,
    free: usize,
    /// `Y`: motions by rows.
    determined: Vec<Vec<f64>>,
    /// `Z`: motions by free motions; empty where there is nothing.
    directions: Vec<Vec<f64>>,
    /// What multipliers that have no effect take from their rows.
    redundant: Option<Vec<Vec<f64>>>,
}

/// Motions at one grid point that constraints determine, and that they leave free.
struct Split {
    determined: DMatrix<f64>,
    free: DMatrix<f64>,
    redundant: Option<DMatrix<f64>>,
}

impl Interface {
    /// The constraints that `classes` keep exact, on motions whose places at the first grid point
    /// are `kept`. None if more of them depend on each other at some grid points than at others.
    pub fn new(
        equations: &Collocation,
        classes: &[Class],
        kept: &[(usize, usize)],
    ) -> Option<Self> {
        let points = equations.grid().points();
        let mut parts = Vec::new();
        let mut first = 0;
        for (elements, motions) in connected(equations, classes, kept)? {
            let part = Part::new(equations, classes, kept, &elements, motions, first)?;
            first += part.free;
            parts.push(part);
        }
        Some(Interface {
            points,
            parts,
            factors: None,
            values: vec![0.0; first * points],
        })
    }

    /// Number of unknowns.
    pub fn size(&self) -> usize {
        self.values.len()
    }

    /// Assembles and factors `Zᵀ D Z`. `false` if it is singular.
    ///
    /// `stiffness[i][j]` is, over the grid, the force at `i` by a unit motion of `j` at the first
    /// grid point; empty where there is none.
    ///
    /// # Errors
    /// If memory runs out.
    pub fn factor(&mut self, stiffness: &[Vec<Vec<f64>>], workers: &Workers) -> Result<bool> {
        // The old factors' memory first.
        self.factors = None;
        let (points, free) = (self.points, self.size() / self.points);
        let mut matrix = zeros(self.size(), self.size(), workers)?;
        let mut columns: Vec<_> = if matrix.nrows() > 0 {
            matrix
                .col_iter_mut()
                .filter_map(|c| c.try_as_col_major_mut())
                .collect()
        } else {
            Vec::new()
        };
        let parts = &self.parts;
        workers.for_each(
            &mut columns,
            &mut Vec::new(),
            || Forces::new(points, stiffness.len()),
            |forces, at, column| {
                let (l, b) = (at / free, at % free);
                let last = parts.partition_point(|part| part.first <= b) - 1;
                forces.set(&parts[last], b - parts[last].first, l, stiffness);
                let column = column.rb_mut().as_slice_mut();
                for part in parts {
                    part.project(&forces.series, &mut forces.projected, column, free);
                }
            },
        );
        self.factors = DenseLu::new(matrix, workers)?;
        Ok(self.factors.is_some())
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
        let free = self.size() / self.points;
        let mut projected = vec![0.0; self.points];
        for part in &self.parts {
            part.project(forces, &mut projected, &mut self.values, free);
        }
        if let Some(factors) = &mut self.factors {
            factors.solve(&mut self.values);
        }
        for part in &self.parts {
            for (m, &motion) in part.motions.iter().enumerate() {
                for (b, z) in part.directions[m * part.free..][..part.free]
                    .iter()
                    .enumerate()
                {
                    let q = self.values[part.first + b..].iter().step_by(free);
                    let terms = z.iter().zip(q);
                    motions[motion]
                        .iter_mut()
                        .zip(terms)
                        .for_each(|(u, (z, q))| *u += z * q);
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

/// Memory for the forces by one free motion at one grid point.
struct Forces {
    series: Vec<Vec<f64>>,
    projected: Vec<f64>,
}

impl Forces {
    fn new(points: usize, motions: usize) -> Self {
        Forces {
            series: vec![vec![0.0; points]; motions],
            projected: vec![0.0; points],
        }
    }

    /// Forces by a unit of free motion `b` of `part` at grid point `l`.
    fn set(&mut self, part: &Part, b: usize, l: usize, stiffness: &[Vec<Vec<f64>>]) {
        for (force, row) in self.series.iter_mut().zip(stiffness) {
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
}

impl Part {
    /// The constraints of `elements`, on those `motions` of all that are `kept`.
    fn new(
        equations: &Collocation,
        classes: &[Class],
        kept: &[(usize, usize)],
        elements: &[usize],
        motions: Vec<usize>,
        first: usize,
    ) -> Option<Self> {
        let points = equations.grid().points();
        let mut rows = Vec::new();
        let mut gradients = vec![Vec::new(); points];
        for &index in elements {
            let Class::Exact(all) = &classes[index] else {
                continue;
            };
            let placed = &equations.system().elements()[index];
            let columns: Vec<usize> = places_of(equations, placed.element.nodes())
                .map(|place| motions.iter().position(|&m| kept[m].0 == place))
                .collect::<Option<_>>()?;
            let own = equations.layout().element_at(placed, 0);
            for (row, place) in own.clone().enumerate() {
                rows.push((place, own.len()));
                for (list, gradient) in gradients.iter_mut().zip(all) {
                    let mut full = DVector::zeros(motions.len());
                    for (&column, value) in columns.iter().zip(gradient.row(row).iter()) {
                        full[column] = *value;
                    }
                    list.push(full);
                }
            }
        }
        let compliant = equations.regularisation();
        let split = |rows: &Vec<DVector<f64>>| {
            // Whether work is to end is asked where it may fail.
            let _ = equations.workers().pulse();
            let gradient = match rows[..] {
                [] => DMatrix::zeros(0, motions.len()),
                _ => DMatrix::from_columns(rows).transpose(),
            };
            Split::new(&gradient, compliant)
        };
        let splits: Vec<Split> = gradients.iter().map(split).collect::<Option<_>>()?;
        let free = splits[0].free.ncols();
        if splits.iter().any(|s| s.free.ncols() != free) {
            return None;
        }
        let is_redundant = splits[0].redundant.is_some();
        Some(Part {
            determined: over_time(&splits, |s| Some(&s.determined)),
            directions: over_time(&splits, |s| Some(&s.free)),
            redundant: is_redundant.then(|| over_time(&splits, |s| s.redundant.as_ref())),
            rows,
            motions,
            first,
            free,
        })
    }

    /// Writes `Zᵀ f` to `values`, of which there are `stride` at each grid point.
    fn project(
        &self,
        forces: &[Vec<f64>],
        projected: &mut [f64],
        values: &mut [f64],
        stride: usize,
    ) {
        for b in 0..self.free {
            projected.fill(0.0);
            for (m, &motion) in self.motions.iter().enumerate() {
                add_product(
                    projected,
                    &self.directions[m * self.free + b],
                    &forces[motion],
                );
            }
            let places = values[self.first + b..].iter_mut().step_by(stride);
            places.zip(&*projected).for_each(|(value, p)| *value = *p);
        }
    }
}

/// `y += a b`, entry by entry.
fn add_product(y: &mut [f64], a: &[f64], b: &[f64]) {
    y.iter_mut()
        .zip(a.iter().zip(b))
        .for_each(|(y, (a, b))| *y += a * b);
}

/// What stands at a place over the grid.
fn series_of(x: &[f64], (first, stride): (usize, usize)) -> impl Iterator<Item = &f64> {
    x[first..].iter().step_by(stride)
}

/// Places of the motions of nodes at the first grid point.
fn places_of(equations: &Collocation, nodes: &[usize]) -> impl Iterator<Item = usize> {
    let layout = equations.layout();
    nodes.iter().flat_map(move |&node| layout.motion(node, 0))
}

/// Entries of matrices, row by row, each over the grid; empty where all are zero.
fn over_time<'s>(
    splits: &'s [Split],
    matrix: impl Fn(&'s Split) -> Option<&'s DMatrix<f64>>,
) -> Vec<Vec<f64>> {
    let all: Vec<_> = splits.iter().filter_map(matrix).collect();
    let (rows, columns) = all.first().map_or((0, 0), |m| m.shape());
    let places = (0..rows).flat_map(|i| (0..columns).map(move |j| (i, j)));
    let entries = places.map(|place| all.iter().map(|m| m[place]).collect::<Vec<f64>>());
    entries
        .map(|series| match series.iter().all(|x| *x == 0.0) {
            true => Vec::new(),
            false => series,
        })
        .collect()
}

/// Elements with exact constraints, and the motions that they share, part by part; motions without
/// one stand alone. None if a constrained motion is not kept.
fn connected(
    equations: &Collocation,
    classes: &[Class],
    kept: &[(usize, usize)],
) -> Option<Vec<(Vec<usize>, Vec<usize>)>> {
    let mut parts: Vec<(Vec<usize>, Vec<usize>)> = (0..kept.len())
        .map(|motion| (Vec::new(), vec![motion]))
        .collect();
    for (index, class) in classes.iter().enumerate() {
        if !matches!(class, Class::Exact(_)) {
            continue;
        }
        let nodes = equations.system().elements()[index].element.nodes();
        let motions: Vec<usize> = places_of(equations, nodes)
            .map(|place| kept.iter().position(|k| k.0 == place))
            .collect::<Option<_>>()?;
        let (mut joined, others): (Vec<_>, Vec<_>) = parts
            .into_iter()
            .partition(|(_, all)| all.iter().any(|m| motions.contains(m)));
        parts = others;
        let elements = joined
            .iter_mut()
            .flat_map(|part| std::mem::take(&mut part.0));
        let elements = elements.chain([index]).collect();
        parts.push((
            elements,
            joined.into_iter().flat_map(|part| part.1).collect(),
        ));
    }
    Some(parts)
}

impl Split {
    /// Of the gradient `G`. None if constraints depend on each other that have no compliance.
    fn new(gradient: &DMatrix<f64>, compliant: f64) -> Option<Self> {
        let (rows, columns) = gradient.shape();
        // Padded to a square, so that the decomposition has all directions.
        let mut square = DMatrix::zeros(columns.max(rows), columns);
        square.rows_mut(0, rows).copy_from(gradient);
        let svd = square.svd(true, true);
        let (u, v) = (svd.u?, svd.v_t?.transpose());
        let largest = svd.singular_values.max();
        let (mut determined, mut free) = (DMatrix::zeros(columns, rows), Vec::new());
        let mut known = DMatrix::zeros(rows, rows);
        for (i, &value) in svd.singular_values.iter().enumerate() {
            if value > DEPENDENT * largest {
                let left = u.view((0, i), (rows, 1));
                determined += v.column(i) * left.transpose() / value;
                known += left * left.transpose();
            } else {
                free.push(v.column(i).into_owned());
            }
        }
        let rank = columns - free.len();
        if rank < rows && compliant == 0.0 {
            return None;
        }
        Some(Split {
            determined,
            free: if free.is_empty() {
                DMatrix::zeros(columns, 0)
            } else {
                DMatrix::from_columns(&free)
            },
            redundant: (rank < rows).then(|| (DMatrix::identity(rows, rows) - known) / compliant),
        })
    }
}
