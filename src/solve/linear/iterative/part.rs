//! Constraints that share motions, and the motions that they leave free.

use super::constraints::Class;
use super::transport::transport;
use crate::collocation::Collocation;
use crate::solve::linear::dense::decomposed;
use nalgebra::{DMatrix, DVector};

/// Singular values of gradients below this, relative to the largest, are those of constraints that
/// depend on others.
const DEPENDENT: f64 = 1e-9;

/// Constraints that share motions. Matrices stand entry by entry, each over the grid.
pub(super) struct Part {
    /// Of each row of `G`: its place at the first grid point, and from one grid point to the next.
    pub rows: Vec<(usize, usize)>,
    /// Which of the motions that are kept it constrains.
    pub motions: Vec<usize>,
    /// Free motions of the parts before this one, and its own.
    pub first: usize,
    pub free: usize,
    /// `Y`: motions by rows.
    pub determined: Vec<Vec<f64>>,
    /// `Z`: motions by free motions; empty where there is nothing.
    pub directions: Vec<Vec<f64>>,
    /// What multipliers that have no effect take from their rows.
    pub redundant: Option<Vec<Vec<f64>>>,
}

/// Motions at one grid point that constraints determine, and that they leave free.
struct Split {
    determined: DMatrix<f64>,
    free: DMatrix<f64>,
    redundant: Option<DMatrix<f64>>,
}

impl Part {
    /// All constraints that `classes` keep exact, on motions whose places at the first grid point
    /// are `kept`. None if more of them depend on each other at some grid points than at others.
    pub fn all(
        equations: &Collocation,
        classes: &[Class],
        kept: &[(usize, usize)],
    ) -> Option<Vec<Self>> {
        let mut parts = Vec::new();
        let mut first = 0;
        for (elements, motions) in connected(equations, classes, kept)? {
            let part = Part::new(equations, classes, kept, &elements, motions, first)?;
            first += part.free;
            parts.push(part);
        }
        Some(parts)
    }

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
        let mut splits: Vec<Split> = gradients.iter().map(split).collect::<Option<_>>()?;
        let free = splits[0].free.ncols();
        if splits.iter().any(|s| s.free.ncols() != free) {
            return None;
        }
        let take = |s: &mut Split| std::mem::replace(&mut s.free, DMatrix::zeros(0, 0));
        let mut bases: Vec<_> = splits.iter_mut().map(take).collect();
        transport(&mut bases);
        for (split, basis) in splits.iter_mut().zip(bases) {
            split.free = basis;
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

    /// Writes `Zᵀ f` to `values`, free motion by free motion.
    pub fn project(&self, forces: &[Vec<f64>], values: &mut [f64]) {
        let Some(points) = forces.first().map(Vec::len) else {
            return;
        };
        let own = values[self.first * points..].chunks_exact_mut(points);
        for (b, projected) in own.take(self.free).enumerate() {
            projected.fill(0.0);
            for (m, &motion) in self.motions.iter().enumerate() {
                let direction = &self.directions[m * self.free + b];
                add_product(projected, direction, &forces[motion]);
            }
        }
    }
}

/// `y += a b`, entry by entry.
pub(super) fn add_product(y: &mut [f64], a: &[f64], b: &[f64]) {
    y.iter_mut()
        .zip(a.iter().zip(b))
        .for_each(|(y, (a, b))| *y += a * b);
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
        let svd = decomposed(square)?;
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
