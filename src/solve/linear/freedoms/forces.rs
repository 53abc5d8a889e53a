//! What the elimination of constraints needs of a Jacobian: gradients of the constraints, and
//! forces by motions.

use super::point::{Point, add};
use super::{Constraints, Layout};
use crate::collocation::{Collocation, GridState, MotionTangent, Panel, Pattern};
use crate::error::Result;
use crate::solve::linear::dense::largest;
use crate::solve::linear::triangles::subtract_product;

/// The forces that motions cause, `K`.
#[derive(Debug)]
pub(super) enum Forces {
    /// Of one grid point, with internal states or with many freedoms: in the values of the
    /// Jacobian, assembled.
    Assembled(Assembled),
    /// Not formed.
    Tangents(Box<MotionTangent>),
}

/// Where entries are among the values.
#[derive(Debug)]
pub(super) struct Assembled {
    /// All but those of constraints, and where their rows and columns begin.
    panels: Vec<(Panel, usize, usize)>,
    /// Those of constraints: of each element in turn, at each grid point, of each component of each
    /// of its nodes.
    gradients: Vec<usize>,
    /// `K Z`, column by column.
    product: Vec<f64>,
}

impl Assembled {
    pub fn new(layout: &Layout, elements: &[Constraints], pattern: &Pattern) -> Self {
        let groups = pattern.groups();
        let is_coordinate = |at: usize| layout.coordinate_of[at] != usize::MAX;
        let placed = pattern.panels().into_iter().map(|panel| {
            let row = groups[panel.row.0].start + panel.row.1;
            let column = groups[panel.column.0].start + panel.column.1;
            (panel, row, column)
        });
        let panels =
            placed.filter(|(_, row, column)| is_coordinate(*row) && is_coordinate(*column));
        let mut gradients = Vec::new();
        for k in 0..layout.points {
            for of in elements {
                for (local, &node) in of.nodes.iter().enumerate() {
                    let at = |c: usize| pattern.constraint_value(of.element, local, node, k, c);
                    gradients.extend((0..6).map(at));
                }
            }
        }
        Assembled {
            panels: panels.collect(),
            gradients,
            product: Vec::new(),
        }
    }

    /// Writes `Zᵀ K Z`, column by column.
    fn between(&mut self, layout: &Layout, points: &[Point], values: &[f64], out: &mut [f64]) {
        let (freedoms, size) = (layout.freedoms, layout.coordinates);
        let (all, unknowns) = (layout.coordinate_of.len(), freedoms * layout.points);
        self.product.clear();
        self.product.resize(all * unknowns, 0.0);
        for (panel, row, first) in &self.panels {
            for j in 0..panel.columns {
                let number = layout.coordinate_of[first + j];
                let (k, coordinate) = (number / size, number % size);
                let basis = &points[k].basis[coordinate * freedoms..][..freedoms];
                let entries = &values[panel.value + j * panel.stride..][..panel.rows];
                for (i, &z) in basis.iter().enumerate() {
                    if z != 0.0 {
                        let column = &mut self.product[(k * freedoms + i) * all..][..all];
                        add(&mut column[*row..], z, entries);
                    }
                }
            }
        }
        let columns = out.chunks_exact_mut(unknowns);
        for (column, product) in columns.zip(self.product.chunks_exact(all)) {
            layout.project(points, product, column);
        }
    }
}

impl Forces {
    /// Linearises at `state`, if the Jacobian is not formed. `false` where its values are needed.
    pub fn evaluate(&mut self, equations: &mut Collocation, state: &GridState) -> Result<bool> {
        match self {
            Forces::Assembled(_) => Ok(false),
            Forces::Tangents(tangent) => tangent.evaluate(equations, state).map(|()| true),
        }
    }

    /// Writes the gradients of the constraints at grid point `k`, row by row.
    pub fn gradient(
        &self,
        (layout, elements): (&Layout, &[Constraints]),
        (equations, values): (&Collocation, &[f64]),
        k: usize,
        out: &mut [f64],
    ) {
        let size = layout.coordinates;
        match self {
            Forces::Assembled(assembled) => {
                let count = assembled.gradients.len() / layout.points;
                let mut places = assembled.gradients[k * count..][..count].iter();
                for of in elements {
                    for (&node, component) in of.columns() {
                        let first = places.next().map_or(0, |first| *first);
                        let entries = &values[first..][..of.count];
                        for (row, entry) in entries.iter().enumerate() {
                            out[(of.first + row) * size + 6 * node + component] = *entry;
                        }
                    }
                }
            }
            Forces::Tangents(tangent) => {
                let multipliers = &layout.multiplier_at[k * layout.constraints..];
                for of in elements {
                    let gradient = tangent.gradient(equations.system(), of.element, k);
                    let columns = gradient.chunks_exact(of.count);
                    for (entries, (&node, component)) in columns.zip(of.columns()) {
                        let scale = equations.column_scale()[component];
                        for (row, entry) in entries.iter().enumerate() {
                            let row_scale = equations.row_scale()[multipliers[of.first + row]];
                            out[(of.first + row) * size + 6 * node + component] =
                                entry * row_scale * scale;
                        }
                    }
                }
            }
        }
    }

    /// Writes `Zᵀ K Z`, column by column.
    pub fn between(&mut self, layout: &Layout, points: &[Point], values: &[f64], out: &mut [f64]) {
        match self {
            Forces::Assembled(assembled) => assembled.between(layout, points, values, out),
            Forces::Tangents(tangent) => {
                tangent.between(layout.freedoms, |k| &points[k].basis, out)
            }
        }
    }

    /// `rest −= K u`.
    pub fn subtract(&mut self, values: &[f64], motion: &[f64], rest: &mut [f64]) {
        match self {
            Forces::Assembled(assembled) => {
                for (panel, row, column) in &assembled.panels {
                    subtract_product(
                        &mut rest[*row..][..panel.rows],
                        |j| &values[panel.value + j * panel.stride..][..panel.rows],
                        &motion[*column..][..panel.columns],
                    );
                }
            }
            Forces::Tangents(tangent) => tangent.subtract_forces(motion, rest),
        }
    }

    /// The largest entry of `K`, or about that.
    pub fn largest(&self, values: &[f64]) -> f64 {
        match self {
            Forces::Assembled(assembled) => {
                let entries = assembled.panels.iter().map(|(panel, ..)| {
                    let columns = 0..panel.columns;
                    let column =
                        |j| largest(&values[panel.value + j * panel.stride..][..panel.rows]);
                    columns.map(column).fold(0.0, f64::max)
                });
                entries.fold(0.0, f64::max)
            }
            Forces::Tangents(tangent) => tangent.largest(),
        }
    }
}
