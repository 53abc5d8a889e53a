//! The dense system of joints that turn: motions at these joints at all grid points, by the dynamic stiffness of
//! the bodies between them.
//!
//! ```text
//! D u + Gᵀ λ = r,   G u = g
//! ```
//!
//! with `D` circulant and `G` local in time. At each grid point `u = Y g + Z q` with `G Z = 0`, so that
//! `Zᵀ D Z q = Zᵀ (r − D Y g)`.

use super::constraints::Class;
use super::dense::{DenseLu, zeros};
use super::layout::own_first;
use crate::collocation::Collocation;
use crate::error::Result;
use crate::workers::Workers;
use nalgebra::{DMatrix, DVector};

/// Singular values of gradients below this, relative to the largest, are those of constraints that depend on others.
const DEPENDENT: f64 = 1e-9;

/// Constraints that are not steady.
pub(super) struct Interface {
    points: usize,
    /// Of each row of `G`: its place at the first grid point, and from one grid point to the next.
    rows: Vec<(usize, usize)>,
    /// At each grid point.
    splits: Vec<Split>,
    factors: Option<DenseLu>,
    values: Vec<f64>,
}

/// Motions at one grid point that constraints determine, and that they leave free.
struct Split {
    /// `Y`.
    determined: DMatrix<f64>,
    /// `Z`.
    free: DMatrix<f64>,
    /// What multipliers that have no effect take from their rows.
    redundant: Option<DMatrix<f64>>,
}

impl Interface {
    /// The constraints that `classes` keep exact, on motions whose places at the first grid point are `kept`. None
    /// if more of them depend on each other at some grid points than at others.
    pub fn new(
        equations: &Collocation,
        classes: &[Class],
        kept: &[(usize, usize)],
    ) -> Option<Self> {
        let points = equations.grid().points();
        let system = equations.system();
        let mut rows = Vec::new();
        let mut gradients = vec![Vec::new(); points];
        for (index, class) in classes.iter().enumerate() {
            let Class::Exact(all) = class else {
                continue;
            };
            let element = &system.elements()[index].element;
            let columns: Vec<usize> = element
                .nodes()
                .iter()
                .flat_map(|&node| (0..6).map(move |i| 6 * points * node + i))
                .map(|place| kept.iter().position(|k| k.0 == place))
                .collect::<Option<_>>()?;
            for row in 0..element.multipliers() {
                rows.push((own_first(equations, index) + row, element.multipliers()));
                for (list, gradient) in gradients.iter_mut().zip(all) {
                    let mut full = DVector::zeros(kept.len());
                    for (&column, value) in columns.iter().zip(gradient.row(row).iter()) {
                        full[column] = *value;
                    }
                    list.push(full);
                }
            }
        }
        let compliant = equations.regularisation();
        let splits: Vec<Split> = gradients
            .iter()
            .map(|rows| {
                // Whether work is to end is asked where it may fail.
                let _ = equations.workers().pulse();
                Split::new(&DMatrix::from_columns(rows).transpose(), compliant)
            })
            .collect::<Option<_>>()?;
        let free = splits[0].free.ncols();
        splits
            .iter()
            .all(|s| s.free.ncols() == free)
            .then(|| Interface {
                values: vec![0.0; free * points],
                points,
                rows,
                splits,
                factors: None,
            })
    }

    /// Free motions at one grid point.
    fn free(&self) -> usize {
        self.splits[0].free.ncols()
    }

    /// Number of unknowns.
    pub fn size(&self) -> usize {
        self.values.len()
    }

    /// Assembles and factors `Zᵀ D Z`. `false` if it is singular.
    ///
    /// `stiffness[i][j]` is, over the grid, the force at `i` by a unit motion of `j` at the first grid point;
    /// empty where there is none.
    ///
    /// # Errors
    /// If memory runs out.
    pub fn factor(&mut self, stiffness: &[Vec<Vec<f64>>], workers: &Workers) -> Result<bool> {
        // The old factors' memory first.
        self.factors = None;
        let free = self.free();
        let mut matrix = zeros(self.size(), self.size(), workers)?;
        let mut forces = vec![vec![0.0; self.points]; stiffness.len()];
        let add = |to: &mut [f64], from: &[f64], factor: f64| {
            to.iter_mut().zip(from).for_each(|(t, f)| *t += factor * f);
        };
        for l in 0..self.points {
            for b in 0..free {
                workers.pulse()?;
                for (force, row) in forces.iter_mut().zip(stiffness) {
                    force.fill(0.0);
                    let (early, late) = force.split_at_mut(l);
                    for (series, &motion) in row.iter().zip(&self.splits[l].free.column(b)) {
                        if !series.is_empty() && motion != 0.0 {
                            add(late, series, motion);
                            add(early, &series[series.len() - l..], motion);
                        }
                    }
                }
                let column = matrix.col_as_slice_mut(free * l + b);
                for (k, (rows, split)) in
                    column.chunks_exact_mut(free).zip(&self.splits).enumerate()
                {
                    for (entry, z) in rows.iter_mut().zip(split.free.column_iter()) {
                        *entry = z.iter().zip(&forces).map(|(z, f)| z * f[k]).sum();
                    }
                }
            }
        }
        self.factors = DenseLu::new(matrix, workers)?;
        Ok(self.factors.is_some())
    }

    /// Motions `Y g` that open the joints by the rows of `x`; component by component over the grid.
    pub fn determined(&self, x: &[f64], motions: &mut [Vec<f64>]) {
        for (k, split) in self.splits.iter().enumerate() {
            let g = DVector::from_iterator(
                self.rows.len(),
                self.rows
                    .iter()
                    .map(|(first, stride)| x[first + stride * k]),
            );
            let u = &split.determined * g;
            motions
                .iter_mut()
                .zip(&u)
                .for_each(|(motion, u)| motion[k] = *u);
        }
    }

    /// Adds the free motions `Z q` that the forces `r − D Y g` cause.
    pub fn add_free(&mut self, forces: &[Vec<f64>], motions: &mut [Vec<f64>]) {
        let free = self.free();
        for (k, (q, split)) in self
            .values
            .chunks_exact_mut(free)
            .zip(&self.splits)
            .enumerate()
        {
            for (q, z) in q.iter_mut().zip(split.free.column_iter()) {
                *q = z.iter().zip(forces).map(|(z, f)| z * f[k]).sum();
            }
        }
        if let Some(factors) = &mut self.factors {
            factors.solve(&mut self.values);
        }
        for (k, (q, split)) in self.values.chunks_exact(free).zip(&self.splits).enumerate() {
            for (q, z) in q.iter().zip(split.free.column_iter()) {
                for (motion, z) in motions.iter_mut().zip(&z) {
                    motion[k] += q * z;
                }
            }
        }
    }

    /// Writes the multipliers `Yᵀ (r − D u)` of what is left of the `forces` to their places in `x`, which hold `g`.
    pub fn write_multipliers(&self, forces: &[Vec<f64>], x: &mut [f64]) {
        for (k, split) in self.splits.iter().enumerate() {
            let left = DVector::from_iterator(forces.len(), forces.iter().map(|f| f[k]));
            let mut multipliers = split.determined.tr_mul(&left);
            if let Some(redundant) = &split.redundant {
                let g = self
                    .rows
                    .iter()
                    .map(|(first, stride)| x[first + stride * k]);
                multipliers -= redundant * DVector::from_iterator(self.rows.len(), g);
            }
            for ((first, stride), multiplier) in self.rows.iter().zip(&multipliers) {
                x[first + stride * k] = *multiplier;
            }
        }
    }
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
