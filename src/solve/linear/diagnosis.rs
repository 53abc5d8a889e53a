//! Why a Jacobian is singular: what is free to move, and which constraints say the same thing
//! twice. See docs/theory.md, section 7.5.

use crate::collocation::{Collocation, GridState, Pattern};
use crate::system::{ConstraintNames, Dependency, ElementRole, Layout, System, name_all};
use faer::MatMut;
use faer::linalg::solvers::Solve;
use faer::sparse::{SparseColMat, Triplet};
use nalgebra::Vector3;
use std::f64::consts::TAU;

/// Why a Jacobian is singular, in words.
pub(crate) enum Singularity {
    /// Something is free to move.
    Free(String),
    /// Constraints depend on each other.
    Redundant(String),
    /// Not known: an iterative solver found no solution.
    Unsolved(String),
}

/// Explains the singularity of the Jacobian `values` at `state`, by a vector of its null space.
///
/// A null vector that moves nodes is a freedom that nothing resists; one of multipliers alone is a
/// set of constraints that are redundant.
pub(crate) fn diagnose(
    equations: &Collocation,
    pattern: &Pattern,
    values: &[f64],
    state: &GridState,
) -> Singularity {
    let Some(vector) = null_vector(pattern, values) else {
        let why = "the Jacobian is singular: some node has no inertia, stiffness or constraint";
        return Singularity::Free(why.into());
    };
    let layout = equations.layout();
    let motions = layout.motions().end;
    let largest = |part: &[f64]| part.iter().fold(0.0f64, |m, x| m.max(x.abs()));
    let moving = largest(&vector[..motions]);
    if moving > 1e-6 * largest(&vector) {
        Singularity::Free(describe_freedom(layout, &vector[..motions], moving, state))
    } else {
        Singularity::Redundant(describe_redundancy(equations, &vector[motions..]))
    }
}

/// A unit vector near the null space, by inverse iteration on a slightly disturbed matrix.
fn null_vector(pattern: &Pattern, values: &[f64]) -> Option<Vec<f64>> {
    let size = pattern.size();
    let disturbance = |i: usize| 1e-12 * ((i as f64 * 0.754_877_666).fract() - 0.5);
    let columns = pattern.column_pointers().windows(2).enumerate();
    let mut entries: Vec<_> = columns
        .flat_map(|(column, range)| (range[0]..range[1]).map(move |at| (column, at)))
        .map(|(column, at)| {
            let value = values[at] * (1.0 + disturbance(at));
            Triplet::new(pattern.row_indices()[at], column, value)
        })
        .collect();
    // On the diagonal too, or more constraints than unknowns could not be factored at all.
    entries.extend((0..size).map(|i| Triplet::new(i, i, 0.1 * disturbance(7 * i + 3))));
    let matrix = SparseColMat::<usize, f64>::try_new_from_triplets(size, size, &entries).ok()?;
    let factors = matrix.sp_lu().ok()?;
    let mut vector: Vec<f64> = (0..size)
        .map(|i| (i as f64 * 0.618_033_988_75).fract() - 0.3)
        .collect();
    for _ in 0..3 {
        factors.solve_in_place(MatMut::from_column_major_slice_mut(&mut vector, size, 1));
        let largest = vector.iter().fold(0.0f64, |m, x| m.max(x.abs()));
        vector.iter_mut().for_each(|x| *x /= largest);
    }
    vector.iter().all(|x| x.is_finite()).then_some(vector)
}

fn describe_freedom(layout: Layout, motions: &[f64], largest: f64, state: &GridState) -> String {
    let points = layout.points();
    let nodes = state.motions.len() / points;
    let part = |node: usize| &motions[layout.node(node)];
    let size = |node: usize| part(node).iter().fold(0.0f64, |m, x| m.max(x.abs()));
    let free: Vec<usize> = (0..nodes).filter(|&n| size(n) > 0.3 * largest).collect();
    let worst = (0..nodes)
        .max_by(|&a, &b| size(a).total_cmp(&size(b)))
        .unwrap_or(0);
    let k = (0..points)
        .max_by(|&a, &b| {
            let norm = |k: usize| part(worst)[6 * k..][..6].iter().map(|x| x * x).sum::<f64>();
            norm(a).total_cmp(&norm(b))
        })
        .unwrap_or(0);
    let u = &part(worst)[6 * k..][..6];
    let rotation = state.node(worst)[k].rotation;
    let linear = rotation * Vector3::new(u[0], u[1], u[2]);
    let angular = rotation * Vector3::new(u[3], u[4], u[5]);
    let how = if linear.amax() > angular.amax() {
        format!("move along {}", direction(&linear))
    } else {
        format!("turn about {}", direction(&angular))
    };
    let names = name_all("node", &free);
    if let Some(harmonic) = vibration(layout, motions, state) {
        let times = match harmonic {
            1 => "once".into(),
            harmonic => format!("{harmonic} times"),
        };
        return format!(
            "resonance without damping: {names} may vibrate {times} in a period at any amplitude, \
             with stiffness and \
             inertia in balance; there node {worst} can {how}. Add damping, or change the period"
        );
    }
    format!(
        "{names} {} free to move: nothing resists a motion in which node {worst} can {how}. \
         Add a joint, a spring, a damper or inertia, or prescribe a coordinate",
        if free.len() == 1 { "is" } else { "are" }
    )
}

/// Part of a motion that a mean must have, or else it vibrates.
const MEAN: f64 = 0.1;

/// The harmonic of a free motion that vibrates: one without a mean, along the inertial axes and
/// along those of the nodes alike.
fn vibration(layout: Layout, motions: &[f64], state: &GridState) -> Option<usize> {
    let points = layout.points();
    let mut found = (0.0, 0);
    for inertial in [true, false] {
        let mut power = vec![0.0; points / 2 + 1];
        for (node, part) in motions.chunks_exact(layout.of_node()).enumerate() {
            let mut series = vec![Vector3::zeros(); 2 * points];
            for (k, u) in part.chunks_exact(6).enumerate() {
                let rotation = state.node(node)[k].rotation;
                for (half, u) in u.chunks_exact(3).enumerate() {
                    let u = Vector3::new(u[0], u[1], u[2]);
                    series[half * points + k] = if inertial { rotation * u } else { u };
                }
            }
            for values in series.chunks_exact(points) {
                for (harmonic, power) in power.iter_mut().enumerate() {
                    *power += power_of(values, harmonic);
                }
            }
        }
        let total: f64 = power.iter().sum();
        if power[0] > MEAN * total {
            return None;
        }
        let largest = (power.iter().enumerate()).max_by(|a, b| a.1.total_cmp(b.1));
        if let Some((harmonic, &power)) = largest
            && power / total > found.0
        {
            found = (power / total, harmonic);
        }
    }
    (found.1 > 0).then_some(found.1)
}

/// Mean square of one harmonic of a series over the period.
fn power_of(values: &[Vector3<f64>], harmonic: usize) -> f64 {
    let points = values.len() as f64;
    let (mut cosine, mut sine) = (Vector3::zeros(), Vector3::zeros());
    for (k, value) in values.iter().enumerate() {
        let angle = TAU * (harmonic * k) as f64 / points;
        cosine += value * (angle.cos() / points);
        sine += value * (angle.sin() / points);
    }
    let both_signs = if harmonic == 0 { 1.0 } else { 2.0 };
    both_signs * (cosine.norm_squared() + sine.norm_squared())
}

fn describe_redundancy(equations: &Collocation, multipliers: &[f64]) -> String {
    let system = equations.system();
    let points = equations.grid().points();
    let mut names = ConstraintNames::default();
    for placed in system.elements() {
        let part = &multipliers[placed.own_over(points)];
        if part.iter().any(|x| x.abs() > 0.05) {
            names.add(placed.role);
        }
    }
    format!("over-constrained: the constraints of {names} depend on each other")
}

/// Says which constraints are redundant; empty if none is.
pub fn describe_dependencies(system: &System) -> String {
    let parts = system.dependencies().iter().map(Dependency::to_string);
    parts.collect::<Vec<_>>().join("; ")
}

/// Names constraints that cannot all hold.
pub(crate) fn describe_inconsistency(equations: &Collocation, residual: &[f64]) -> String {
    let parts = equations.system().dependencies().iter().map(|dependency| {
        let names = dependency.constraints();
        if names.prescribed.is_empty() {
            return format!(
                "the constraints of {names} contradict each other: they depend on each other, and \
                 do not all close"
            );
        }
        let [others, prescribed] = names.parted();
        format!(
            "locked: {prescribed} cannot move as prescribed, since {others} leave no freedom to do \
             so"
        )
    });
    format!(
        "{}{}. Use joints with fewer constraints, prescribe less, or make a member flexible",
        parts.collect::<Vec<_>>().join("; "),
        describe_open_joint(equations, residual)
    )
}

/// A joint that is open by more than this (relative to the size of the mechanism, or in radians)
/// may be locked. By less it is where large forces left Newton's method, or geometry was rounded.
const LOCKED: f64 = 1e-4;

/// Names the joint or prescribed coordinate that is furthest from closed, if any is open at all.
pub(crate) fn describe_open_joint(equations: &Collocation, residual: &[f64]) -> String {
    let system = equations.system();
    let mut worst = (1e-6, String::new());
    for placed in system.elements() {
        let part = &residual[equations.layout().element(placed)];
        let open = part.iter().fold(0.0f64, |m, x| m.max(x.abs()));
        let what = match placed.role {
            ElementRole::Joint(index) => format!("joint {index}"),
            ElementRole::Relation(index) => format!("relation {index}"),
            ElementRole::Prescribed(index) => format!("prescribed coordinate {index}"),
            _ => continue,
        };
        if open > worst.0 {
            worst = (open, what);
        }
    }
    if worst.1.is_empty() {
        return String::new();
    }
    let why = match worst.0 > LOCKED {
        true => ": the mechanism may be locked",
        false => "",
    };
    format!(
        "; {} stays open by {:.2e} (relative to the size of the mechanism, or in radians){why}",
        worst.1, worst.0
    )
}

fn direction(v: &Vector3<f64>) -> String {
    let v = v.normalize();
    format!("({:.3}, {:.3}, {:.3})", v.x, v.y, v.z)
}
