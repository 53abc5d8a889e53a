//! Plates and shells.

use super::parts::*;
use nalgebra::Vector3;
use periodyn::elements::{
    IsotropicShell, JointKind, LoadFrame, ShellSection, gauss_legendre, lobatto_points,
    shape_functions,
};
use periodyn::model::*;
use periodyn::motion::Motion;

/// Lengths of an edge that its nodes stand for, by the weights of Lobatto's rule.
pub fn edge_weights(length: f64, elements: usize, degree: usize) -> Vec<f64> {
    let points = lobatto_points(degree + 1);
    let mut weights = vec![0.0; elements * degree + 1];
    for element in 0..elements {
        for (x, weight) in gauss_legendre(degree + 1) {
            for (k, shape) in shape_functions(&points, x).iter().enumerate() {
                let half = 0.5 * length / elements as f64;
                weights[element * degree + k] += weight * half * shape.0;
            }
        }
    }
    weights
}

/// Dead forces `[force; moment]` per length on the nodes of an edge, by Lobatto's weights.
pub fn load_edge(model: &mut Model, nodes: &[usize], weights: &[f64], load: [f64; 6]) {
    for (&node, weight) in nodes.iter().zip(weights) {
        let load = load.map(|x| x * weight);
        add_load(model, node, LoadFrame::Space, &load, &[0.0; 6]);
    }
}

/// Clamps all nodes of an edge to the ground.
pub fn clamp_edge(model: &mut Model, nodes: &[usize]) {
    for &node in nodes {
        clamp(model, node);
    }
}

/// A mesh of elements with so many nodes a side.
pub fn mesh(elements: [usize; 2], nodes: [usize; 2]) -> ShellMesh {
    ShellMesh {
        elements,
        degrees: nodes.map(|n| n - 1),
        join: true,
    }
}

/// Adds a flat strip from the origin, `length` along x and `width` along y.
pub fn add_strip(
    model: &mut Model,
    [length, width]: [f64; 2],
    section: &ShellSection,
    mesh: &ShellMesh,
) -> ShellPatch {
    let sides = [Vector3::x() * length, Vector3::y() * width];
    let surface = rectangle(&Vector3::zeros(), &sides[0], &sides[1]).unwrap();
    let placement = ShellPlacement::default();
    model
        .add_shell_patch(surface, mesh, section, &placement)
        .unwrap()
}

/// Thickness, modulus, density, and time of damping of the rubber-like plate below.
pub const RUBBER: [f64; 4] = [0.02, 2e8, 1100.0, 2e-3];

/// A rubber-like plate, 1 × 0.5, that is welded to a shaft along y, which turns to and fro by
/// `swing`; its period.
pub fn flapping_plate(swing: f64, elements: [usize; 2], nodes: usize) -> (Model, f64) {
    let (model, patch) = rubber_plate([1.0, 0.5], 0.3, &mesh(elements, [nodes, nodes]));
    swung(model, &patch.edge(PatchEdge::StartU), swing)
}

/// The plate alone, of another size and Poisson's ratio.
pub fn rubber_plate(size: [f64; 2], poisson: f64, mesh: &ShellMesh) -> (Model, ShellPatch) {
    let [thickness, young, density, damping_time] = RUBBER;
    let section = IsotropicShell {
        damping_time,
        ..IsotropicShell::new(thickness, young, poisson, density)
    };
    let mut model = Model::new();
    let patch = add_strip(&mut model, size, &section.section().unwrap(), mesh);
    (model, patch)
}

/// With nodes welded to a shaft along y that turns to and fro by `swing`, under gravity; the
/// period.
pub fn swung(mut model: Model, nodes: &[usize], swing: f64) -> (Model, f64) {
    let shaft = ball(&mut model, 0.1, 1e-3, &Vector3::zeros());
    for &node in nodes {
        let here = Motion::identity();
        model
            .add_joint(JointKind::Rigid, Some(shaft), Some(node), &here, &here)
            .unwrap();
    }
    let joint = revolute(
        &mut model,
        None,
        Some(shaft),
        &Vector3::zeros(),
        &Vector3::y(),
    );
    model.prescribe(rotation1(joint), &cosine(swing)).unwrap();
    gravity(&mut model, [0.0, 0.0, -9.81]);
    (model, 1.6)
}

/// A square plate of unit sides and this thickness, Poisson's ratio 0.3, clamped along an edge or
/// free; and the unit of its frequencies, `√(D / (ρh a⁴))`.
pub fn square_plate(h: f64, nodes: usize, elements: usize, clamped: bool) -> (Model, f64) {
    let (nu, young, density) = (0.3, 1e6, 1.0);
    let section = IsotropicShell::new(h, young, nu, density);
    let section = section.section().unwrap();
    let mut model = Model::new();
    let mesh = mesh([elements, elements], [nodes, nodes]);
    let patch = add_strip(&mut model, [1.0, 1.0], &section, &mesh);
    if clamped {
        clamp_edge(&mut model, &patch.edge(PatchEdge::StartU));
    }
    let bending = young * h * h * h / (12.0 * (1.0 - nu * nu));
    (model, (bending / (density * h)).sqrt())
}
