//! Which constraints may be averaged over time, and which must stay exact.

use crate::collocation::{Collocation, Tangent};
use crate::motion::DualVector;
use crate::system::System;
use nalgebra::DMatrix;

/// Constraints whose gradients change by less than this, relative to themselves, count as steady.
const STEADY: f64 = 0.05;

/// How constraints are treated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Joints {
    /// As they are at each time.
    Exact,
    /// Averaged over time too, so that everything is circulant.
    Averaged,
}

/// What becomes of an element's own unknowns.
#[derive(Clone)]
pub(super) enum Class {
    /// It has none.
    None,
    /// They are averaged over time.
    Averaged(Average),
    /// Multipliers that stay exact, with the scaled gradient at each grid point.
    Exact(Vec<DMatrix<f64>>),
}

impl Class {
    /// Whether it is a constraint that is the same at all times in the frames of its bodies.
    fn is_steady(&self) -> bool {
        matches!(self, Class::Averaged(average) if average.inverse_rotations.is_some())
    }
}

#[derive(Clone)]
pub(super) struct Average {
    /// Scaled gradient, a row for each own unknown.
    pub gradient: DMatrix<f64>,
    /// What their equations vary by with velocities, likewise, and the transpose of what the forces
    /// do by them, where that is not the gradient.
    pub feedback: Option<Feedback>,
    /// `Q_k⁻¹`, of steady constraints.
    pub inverse_rotations: Option<Vec<DMatrix<f64>>>,
}

/// Scaled tangents of states with feedback.
#[derive(Clone)]
pub(super) struct Feedback {
    /// What their equations vary by with rates of increments, a row for each.
    pub velocity: DMatrix<f64>,
    /// The transpose of what forces vary by with them.
    pub effect: DMatrix<f64>,
}

/// What becomes of the own unknowns of each element.
///
/// Steady constraints all of whose nodes have a joint that turns stay exact as well, which leaves
/// fewer motions free there. So do those of a node that they hold more than once where its
/// neighbours' joints turn: they would hold the neighbours, too.
pub(super) fn classify(equations: &Collocation, tangent: &Tangent, joints: Joints) -> Vec<Class> {
    let mut classes = classify_alone(equations, tangent, joints);
    keep_exact(equations, tangent, &mut classes, |_, turning, nodes| {
        nodes.iter().all(|&node| turning[node])
    });
    while keep_exact(equations, tangent, &mut classes, |rows, turning, nodes| {
        let is_held = |&node: &usize| turning[node] || rows[node] > 6;
        nodes.iter().all(is_held)
    }) {}
    classes
}

/// Keeps steady constraints exact at whose nodes a joint turns, and those between them.
/// `false` if there are none.
pub(super) fn keep_neighbours(
    equations: &Collocation,
    tangent: &Tangent,
    classes: &mut [Class],
) -> bool {
    let any = |_: &[usize], turning: &[bool], nodes: &[usize]| nodes.iter().any(|&n| turning[n]);
    let all = |_: &[usize], turning: &[bool], nodes: &[usize]| nodes.iter().all(|&n| turning[n]);
    let found = keep_exact(equations, tangent, classes, any);
    keep_exact(equations, tangent, classes, all);
    found
}

/// Keeps those steady constraints exact that `choose` says, of the number of rows that would hold
/// each node if all its constraints to turning nodes and the ground were exact, which nodes turn,
/// and the nodes of the constraint. `false` if there are none.
fn keep_exact(
    equations: &Collocation,
    tangent: &Tangent,
    classes: &mut [Class],
    choose: impl Fn(&[usize], &[bool], &[usize]) -> bool,
) -> bool {
    let system = equations.system();
    let turning = turning_nodes(system, classes);
    if !turning.contains(&true) {
        return false;
    }
    let mut rows = vec![0; system.nodes()];
    for (class, placed) in classes.iter().zip(system.elements()) {
        let nodes = placed.element.nodes();
        let mut resting = nodes.iter().filter(|&&node| !turning[node]);
        if let (true, Some(&node), None) = (class.is_steady(), resting.next(), resting.next()) {
            rows[node] += placed.element.own_unknowns();
        }
    }
    let mut found = false;
    for (index, class) in classes.iter_mut().enumerate() {
        let nodes = system.elements()[index].element.nodes();
        if class.is_steady() && choose(&rows, &turning, nodes) {
            *class = Class::Exact(scaled_gradients(equations, tangent, index));
            found = true;
        }
    }
    found
}

/// Which nodes have a constraint that stays exact.
pub(super) fn turning_nodes(system: &System, classes: &[Class]) -> Vec<bool> {
    let mut turning = vec![false; system.nodes()];
    for (class, placed) in classes.iter().zip(system.elements()) {
        if matches!(class, Class::Exact(_)) {
            for &node in placed.element.nodes() {
                turning[node] = true;
            }
        }
    }
    turning
}

/// The same, each element for itself.
fn classify_alone(equations: &Collocation, tangent: &Tangent, joints: Joints) -> Vec<Class> {
    let points = equations.grid().points();
    let elements = equations.system().elements().iter().enumerate();
    elements
        .map(|(index, placed)| {
            if placed.element.own_unknowns() == 0 {
                return Class::None;
            }
            let gradients = scaled_gradients(equations, tangent, index);
            let mean = || {
                let zero = DMatrix::zeros(gradients[0].nrows(), gradients[0].ncols());
                gradients.iter().fold(zero, |sum, g| sum + g) / points as f64
            };
            if placed.has_feedback {
                return Class::Averaged(mean_feedback(equations, tangent, index));
            }
            if placed.has_states || joints == Joints::Averaged {
                return Class::Averaged(Average {
                    gradient: mean(),
                    feedback: None,
                    inverse_rotations: None,
                });
            }
            match inverse_rotations(&gradients) {
                Some(inverse) => Class::Averaged(Average {
                    gradient: gradients[0].clone(),
                    feedback: None,
                    inverse_rotations: Some(inverse),
                }),
                None => Class::Exact(gradients),
            }
        })
        .collect()
}

/// All own unknowns as they are at one grid point.
pub(super) fn classify_at(equations: &Collocation, tangent: &Tangent, k: usize) -> Vec<Class> {
    let elements = equations.system().elements().iter().enumerate();
    elements
        .map(|(index, placed)| match placed.element.own_unknowns() {
            0 => Class::None,
            _ => Class::Averaged(Average {
                gradient: scaled_gradient(equations, tangent, index, k),
                feedback: placed.has_feedback.then(|| Feedback {
                    velocity: DMatrix::zeros(0, 0),
                    effect: scaled_effect(equations, tangent, index, k),
                }),
                inverse_rotations: None,
            }),
        })
        .collect()
}

/// Scaled gradient of an element at each grid point.
fn scaled_gradients(equations: &Collocation, tangent: &Tangent, index: usize) -> Vec<DMatrix<f64>> {
    (0..equations.grid().points())
        .map(|k| scaled_gradient(equations, tangent, index, k))
        .collect()
}

/// Scaled gradient of an element at grid point `k`: a row for each constraint.
fn scaled_gradient(
    equations: &Collocation,
    tangent: &Tangent,
    index: usize,
    k: usize,
) -> DMatrix<f64> {
    let system = equations.system();
    let placed = &system.elements()[index];
    let layout = equations.layout();
    let count = placed.element.own_unknowns();
    let nodes = placed.element.nodes();
    let mut g =
        DMatrix::from_column_slice(count, 6 * nodes.len(), tangent.gradient(system, index, k));
    let first = layout.element(placed).start;
    for (local, &node) in nodes.iter().enumerate() {
        for component in 0..6 {
            let column_scale = equations.column_scale()[layout.node(node).start + component];
            for row in 0..count {
                g[(row, 6 * local + component)] *=
                    column_scale * equations.row_scale()[first + row];
            }
        }
    }
    g
}

/// The transpose of what the forces of an element vary by with its own unknowns at grid point `k`,
/// scaled.
fn scaled_effect(
    equations: &Collocation,
    tangent: &Tangent,
    index: usize,
    k: usize,
) -> DMatrix<f64> {
    let system = equations.system();
    let placed = &system.elements()[index];
    let (layout, nodes) = (equations.layout(), placed.element.nodes());
    let (own, first) = (placed.element.own_unknowns(), layout.element(placed).start);
    let effect = tangent.effect(system, index, k);
    DMatrix::from_fn(own, 6 * nodes.len(), |row, column| {
        let node = layout.node(nodes[column / 6]).start + column % 6;
        let scale = equations.row_scale()[node] * equations.column_scale()[first + row];
        effect[column * own + row] * scale
    })
}

/// Means over time of an element with feedback, with `ΔV = Δu̇ + Ṽ Δu`; on a mapped grid increments
/// are differentiated by pseudo-time.
fn mean_feedback(equations: &Collocation, tangent: &Tangent, index: usize) -> Average {
    let (system, points) = (equations.system(), equations.grid().points());
    let placed = &system.elements()[index];
    let (layout, nodes) = (equations.layout(), placed.element.nodes());
    let (own, first) = (placed.element.own_unknowns(), layout.element(placed).start);
    let mut gradient = DMatrix::zeros(own, 6 * nodes.len());
    let (mut velocity, mut effect) = (gradient.clone(), gradient.clone());
    let slopes = equations.slopes();
    for k in 0..points {
        gradient += scaled_gradient(equations, tangent, index, k);
        effect += scaled_effect(equations, tangent, index, k);
        let rate = tangent.gradient_rate(system, index, k);
        let by_velocity = DMatrix::from_column_slice(own, 6 * nodes.len(), rate);
        let by_pseudo = slopes.get(k).map_or(1.0, |slope| slope.rate);
        for (local, &node) in nodes.iter().enumerate() {
            let twist = DualVector::from_twist(&equations.node_states()[node * points + k].twist);
            let twist = twist.skew().to_twist_matrix();
            let of_node = by_velocity.columns(6 * local, 6);
            let carried = of_node * twist;
            for (row, component) in (0..own).flat_map(|row| (0..6).map(move |i| (row, i))) {
                let scale = equations.row_scale()[first + row]
                    * equations.column_scale()[layout.node(node).start + component];
                let at = (row, 6 * local + component);
                gradient[at] += carried[(row, component)] * scale;
                velocity[at] += of_node[(row, component)] * scale * by_pseudo;
            }
        }
    }
    let mean = |sum: DMatrix<f64>| sum / points as f64;
    Average {
        gradient: mean(gradient),
        feedback: Some(Feedback {
            velocity: mean(velocity),
            effect: mean(effect),
        }),
        inverse_rotations: None,
    }
}

/// `Q_k⁻¹` with `G_k = Q_k Ḡ` for all grid points, if there are such; the first is the identity.
fn inverse_rotations(gradients: &[DMatrix<f64>]) -> Option<Vec<DMatrix<f64>>> {
    let mean = &gradients[0];
    let gram_inverse = (mean * mean.transpose()).try_inverse()?;
    let projector = mean.transpose() * gram_inverse;
    gradients
        .iter()
        .map(|g| {
            let q = g * &projector;
            let steady = (g - &q * mean).norm() <= STEADY * g.norm();
            steady.then_some(q)?.try_inverse()
        })
        .collect()
}

/// Inverse of `Q_k` of a steady constraint at each grid point.
pub(super) struct RowRotation {
    pub first: usize,
    pub count: usize,
    pub inverse: Vec<DMatrix<f64>>,
}

/// Motions that joints which turn leave their nodes at a grid point; none if there are no such
/// joints.
pub(super) fn count_free(equations: &Collocation, tangent: &Tangent) -> Option<usize> {
    let classes = classify(equations, tangent, Joints::Exact);
    let rows = |class: &Class| match class {
        Class::Exact(gradients) => gradients[0].nrows(),
        _ => 0,
    };
    let constraints: usize = classes.iter().map(rows).sum();
    let turning = turning_nodes(equations.system(), &classes);
    let nodes = turning.iter().filter(|turns| **turns).count();
    (constraints > 0).then(|| (6 * nodes).saturating_sub(constraints))
}

/// Rotations of all steady constraints.
pub(super) fn row_rotations(equations: &Collocation, classes: &[Class]) -> Vec<RowRotation> {
    let first_own = |index| {
        let placed = &equations.system().elements()[index];
        equations.layout().element(placed).start
    };
    let steady = |(index, class): (usize, &Class)| match class {
        Class::Averaged(Average {
            inverse_rotations: Some(inverse),
            ..
        }) => Some(RowRotation {
            first: first_own(index),
            count: inverse[0].nrows(),
            inverse: inverse.clone(),
        }),
        _ => None,
    };
    classes.iter().enumerate().filter_map(steady).collect()
}

impl RowRotation {
    /// `x = Q⁻¹ x` of its rows or, transposed, `x = Q⁻ᵀ x`.
    pub fn apply(&self, x: &mut [f64], transposed: bool) {
        let mut product = vec![0.0; self.count];
        for (k, inverse) in self.inverse.iter().enumerate() {
            let values = &mut x[self.first + self.count * k..][..self.count];
            for (i, p) in product.iter_mut().enumerate() {
                *p = values
                    .iter()
                    .enumerate()
                    .map(|(j, v)| {
                        v * if transposed {
                            inverse[(j, i)]
                        } else {
                            inverse[(i, j)]
                        }
                    })
                    .sum();
            }
            values.copy_from_slice(&product);
        }
    }
}
