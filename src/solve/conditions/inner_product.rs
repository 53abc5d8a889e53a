//! What measures motions over the period, independent of grid, mesh and units.

use crate::collocation::{Collocation, GridState};
use crate::motion::Motion;
use crate::system::Layout;
use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};

/// `⟨a, b⟩`, a mean over grid points and nodes of `(Δr·Δr / L² + Δψ·Δψ) / s²`, of increments that
/// are not scaled.
#[derive(Debug, Clone, Copy)]
pub(crate) struct InnerProduct {
    length: f64,
    /// What counts as 1 in motions.
    scale: f64,
}

impl InnerProduct {
    /// Of motions of `equations`, `scale` of which count as 1.
    pub fn new(equations: &Collocation, scale: f64) -> Self {
        let length = equations.system().scales().length;
        InnerProduct { length, scale }
    }

    /// Weights of the six numbers of a motion.
    fn weights(&self, layout: Layout) -> Vector6<f64> {
        let places = layout.motions().len() / 6;
        let angular = 1.0 / (places as f64 * self.scale * self.scale);
        let linear = angular / (self.length * self.length);
        Vector6::new(linear, linear, linear, angular, angular, angular)
    }

    /// `⟨a, b⟩` of motions.
    pub fn of(&self, layout: Layout, a: &[f64], b: &[f64]) -> f64 {
        let weights = self.weights(layout);
        let motions = layout.motions();
        let pairs = a[motions.clone()].iter().zip(&b[motions]);
        let terms = pairs.enumerate().map(|(i, (x, y))| weights[i % 6] * x * y);
        terms.sum()
    }

    /// Writes what `to` is away from `from`, motion by motion.
    pub fn write_difference(from: &GridState, to: &GridState, out: &mut [f64]) {
        let pairs = from.motions.iter().zip(&to.motions);
        for (out, (from, to)) in out.chunks_exact_mut(6).zip(pairs) {
            out.copy_from_slice(difference(from, to).as_slice());
        }
    }

    /// `⟨a, Δ⟩` of what `state` is away from `from`.
    pub fn along(&self, layout: Layout, a: &[f64], from: &GridState, state: &GridState) -> f64 {
        let weights = self.weights(layout);
        let pairs = from.motions.iter().zip(&state.motions);
        let terms = pairs.zip(a.chunks_exact(6)).map(|((from, to), a)| {
            let a = Vector6::from_column_slice(a);
            a.component_mul(&weights).dot(&difference(from, to))
        });
        terms.sum()
    }

    /// Adds its derivatives by increments of `state` to `row`.
    pub fn add_gradient(
        &self,
        layout: Layout,
        a: &[f64],
        (from, state): (&GridState, &GridState),
        row: &mut [f64],
    ) {
        let weights = self.weights(layout);
        let pairs = from.motions.iter().zip(&state.motions);
        let rows = row.chunks_exact_mut(6).zip(a.chunks_exact(6));
        for ((from, to), (row, a)) in pairs.zip(rows) {
            let a = Vector6::from_column_slice(a).component_mul(&weights);
            let by = difference_tangent(from, to).tr_mul(&a);
            row.iter_mut().zip(&by).for_each(|(x, d)| *x += d);
        }
    }
}

/// What `to` is away from `from`, as a material increment: to the first order, and smooth.
pub(crate) fn difference(from: &Motion, to: &Motion) -> Vector6<f64> {
    let moved = from.rotation.tr_mul(&(to.position - from.position));
    let turned = from.rotation.tr_mul(&to.rotation);
    let axis = Vector3::new(
        turned[(2, 1)] - turned[(1, 2)],
        turned[(0, 2)] - turned[(2, 0)],
        turned[(1, 0)] - turned[(0, 1)],
    );
    let mut result = Vector6::zeros();
    result.fixed_rows_mut::<3>(0).copy_from(&moved);
    result.fixed_rows_mut::<3>(3).copy_from(&(axis * 0.5));
    result
}

/// Its derivative by material increments of `to`.
fn difference_tangent(from: &Motion, to: &Motion) -> Matrix6<f64> {
    let turned = from.rotation.tr_mul(&to.rotation);
    let mut result = Matrix6::zeros();
    let mut linear = result.fixed_view_mut::<3, 3>(0, 0);
    linear.copy_from(&turned);
    let mut angular = result.fixed_view_mut::<3, 3>(3, 3);
    angular.copy_from(&((Matrix3::identity() * turned.trace() - turned.transpose()) * 0.5));
    result
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_tangent_is_that_of_the_difference() {
        let turn = |v: Vector3<f64>| nalgebra::Rotation3::new(v).into_inner();
        let from = Motion::new(
            turn(Vector3::new(0.3, -0.2, 0.9)),
            Vector3::new(1.0, 2.0, 3.0),
        );
        let to = Motion::new(
            turn(Vector3::new(0.5, 0.1, 0.4)),
            Vector3::new(1.5, 1.0, 2.0),
        );
        let tangent = difference_tangent(&from, &to);
        let h = 1e-6;
        for j in 0..6 {
            let at = |h: f64| {
                let mut u = Vector6::zeros();
                u[j] = h;
                difference(&from, &to.increment(&u))
            };
            let error = (at(h) - at(-h)) / (2.0 * h) - tangent.column(j);
            assert!(error.amax() < 1e-9, "{error}");
        }
    }
}
