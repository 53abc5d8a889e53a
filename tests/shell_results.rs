//! What shells tell: strains, resultants and stresses in stated axes, animations, warnings, what is
//! refused; and initial stress.

mod common;
#[path = "common/vtk.rs"]
mod vtk;

use common::models::parts::{add_load, clamp};
use common::models::shells::*;
use common::statics;
use nalgebra::{Matrix3, Vector3};
use periodyn::elements::*;
use periodyn::model::*;
use periodyn::motion::Motion;
use periodyn::output::{Modes, NodeQuantity, ShellQuantity, Solution};
use periodyn::solve::*;
use periodyn::system::Summary;
use std::f64::consts::PI;
use vtk::Piece;

const THICKNESS: f64 = 0.02;

fn strip(poisson: f64, mesh: &ShellMesh) -> (Model, ShellPatch) {
    let section = IsotropicShell::new(THICKNESS, 1e7, poisson, 1.0);
    let mut model = Model::new();
    let patch = add_strip(&mut model, [1.0, 0.5], &section.section().unwrap(), mesh);
    (model, patch)
}

/// A strip without contraction under a pull and a couple for each length of its end, which bend and
/// stretch it evenly.
fn pulled_and_bent(pull: f64, couple: f64) -> (Solution, ShellPatch) {
    let (mut model, patch) = strip(0.0, &mesh([2, 1], [4, 3]));
    clamp_edge(&mut model, &patch.edge(PatchEdge::StartU));
    let (end, weights) = (patch.edge(PatchEdge::EndU), edge_weights(0.5, 1, 2));
    let load = [pull, 0.0, 0.0, 0.0, couple, 0.0];
    load_edge(&mut model, &end, &weights, load);
    (statics(&model), patch)
}

#[test]
fn resultants_and_stresses_balance_the_loads_in_any_axes() {
    // So little that the strip hardly moves.
    let (pull, couple) = (1e-3, 1e-5);
    let (solution, _) = pulled_and_bent(pull, couple);
    let at = |point: ShellPoint, quantity: ShellQuantity| {
        solution.shell(1, point, quantity, &[0.0]).unwrap()
    };
    let top = pull / THICKNESS + 6.0 * couple / (THICKNESS * THICKNESS);
    for place in [[-1.0, 0.2], [0.4, -0.7], [1.0, 1.0]] {
        let plain = ShellPoint::new(place);
        // Displacements of second order are 1e-4 of the length.
        let near = |found: &[f64], exact: &[f64], size: f64| {
            for (found, exact) in found.iter().zip(exact) {
                assert!((found - exact).abs() < 1e-4 * size, "{found} {exact}");
            }
        };
        let found = at(plain, ShellQuantity::Resultant);
        near(&found[..6], &[pull, 0.0, 0.0, 0.0, couple, 0.0], pull);
        near(&found[3..6], &[0.0, couple, 0.0], couple);
        near(&found[6..], &[0.0; 6], pull);
        let strain = at(plain, ShellQuantity::Strain);
        near(&strain[..1], &[pull / (1e7 * THICKNESS)], 1e-8);
        near(
            &strain[4..5],
            &[12.0 * couple / (1e7 * THICKNESS.powi(3))],
            1e-6,
        );
        let stress = at(plain, ShellQuantity::SurfaceStress(ShellSide::Top));
        near(&stress, &[top, 0.0, 0.0, top], top);
        let below = at(plain, ShellQuantity::SurfaceStress(ShellSide::Bottom));
        near(&below[..1], &[2.0 * pull / THICKNESS - top], top);
        // Along y, and at 30° from x: the same tensor.
        let turned = |angle: f64| ShellPoint {
            axis: Some(Vector3::new(angle.cos(), angle.sin(), 0.3)),
            ..plain
        };
        let across = at(turned(0.5 * PI), ShellQuantity::Resultant);
        near(&across[6..9], &[0.0, pull, 0.0], pull);
        // Axis 1 is −x there: the couple about y that bends lines along x is M21, with its sign.
        near(&across[9..], &[-couple, 0.0, 0.0], couple);
        let (sine, cosine) = (PI / 6.0).sin_cos();
        let stress = at(
            turned(PI / 6.0),
            ShellQuantity::SurfaceStress(ShellSide::Top),
        );
        let exact = [
            top * cosine * cosine,
            top * sine * sine,
            -top * sine * cosine,
            top,
        ];
        near(&stress, &exact, top);
    }
    // The same of other times and as a series.
    let refused = |element, point, quantity| {
        let refused = solution.shell(element, point, quantity, &[0.0]);
        refused.unwrap_err().to_string()
    };
    let strain = ShellQuantity::Strain;
    let along_normal = ShellPoint {
        axis: Some(Vector3::z()),
        ..ShellPoint::new([0.0; 2])
    };
    assert!(refused(2, ShellPoint::new([0.0; 2]), strain).contains("below 2"));
    assert!(refused(0, ShellPoint::new([0.0, 1.2]), strain).contains("−1 to 1"));
    assert!(refused(0, ShellPoint::new([f64::NAN, 0.0]), strain).contains("at"));
    assert!(refused(0, along_normal, strain).contains("along the normal"));
}

#[test]
fn bending_curves_a_plate_across_by_poissons_ratio() {
    // Free to contract: M22 vanishes, κ21 = ν κ12. A small couple on both ends, held at a corner.
    let nu = 0.3;
    let (mut model, patch) = strip(nu, &mesh([2, 2], [4, 4]));
    clamp(&mut model, patch.nodes[0]);
    let weights = edge_weights(0.5, 2, 3);
    let couple = 1e-6;
    for (edge, sign) in [(PatchEdge::StartU, -1.0), (PatchEdge::EndU, 1.0)] {
        let load = [0.0, 0.0, 0.0, 0.0, sign * couple, 0.0];
        load_edge(&mut model, &patch.edge(edge), &weights, load);
    }
    let solution = statics(&model);
    let sample = |quantity| solution.shell(0, ShellPoint::new([0.3, -0.2]), quantity, &[0.0]);
    let (strain, force) = (
        sample(ShellQuantity::Strain).unwrap(),
        sample(ShellQuantity::Resultant).unwrap(),
    );
    let curvature = 12.0 * couple / (1e7 * THICKNESS.powi(3));
    assert!((strain[4] - curvature).abs() < 1e-5 * curvature);
    assert!((strain[9] - nu * curvature).abs() < 1e-5 * curvature);
    assert!((force[4] - couple).abs() < 1e-5 * couple && force[9].abs() < 1e-5 * couple);
    let stress = sample(ShellQuantity::SurfaceStress(ShellSide::Top)).unwrap();
    let exact = 6.0 * couple / (THICKNESS * THICKNESS);
    assert!((stress[0] - exact).abs() < 1e-4 * exact && stress[1].abs() < 1e-4 * exact);
}

#[test]
fn only_isotropic_shells_have_surface_stresses() {
    let mut section = IsotropicShell::new(0.1, 1e6, 0.3, 1.0).section().unwrap();
    for drilling in [0.1, 1.0] {
        let shell = IsotropicShell {
            drilling,
            ..IsotropicShell::new(0.1, 1e6, 0.3, 1.0)
        };
        let found = shell.section().unwrap().isotropic_thickness().unwrap();
        assert!((found - 0.1).abs() < 1e-14);
    }
    section.stiffness[(0, 0)] *= 1.1;
    assert_eq!(section.isotropic_thickness(), None);
    let mut model = Model::new();
    let patch = add_strip(&mut model, [1.0, 1.0], &section, &mesh([1, 1], [3, 3]));
    clamp_edge(&mut model, &patch.edge(PatchEdge::StartU));
    let stress = ShellQuantity::SurfaceStress(ShellSide::Top);
    let refused = statics(&model).shell(0, ShellPoint::new([0.0; 2]), stress, &[0.0]);
    let refused = refused.unwrap_err().to_string();
    assert!(refused.contains("isotropic"), "{refused}");
}

#[test]
fn animations_have_shells_as_curved_quadrilaterals() {
    let (solution, patch) = pulled_and_bent(1e2, 5.0);
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("strip.pvd");
    solution.write_vtk(&[0.0], 2, &path).unwrap();
    let file = directory.path().join("strip").join("shells_000000.vtu");
    let text = std::fs::read_to_string(&file).unwrap();
    assert!(text.contains("UnstructuredGrid") && text.contains("HigherOrderDegrees=\"Higher"));
    let piece = Piece::read(&file);
    // Two elements of 4 × 3 points.
    assert_eq!(piece.points.len(), 3 * 24);
    assert_eq!(piece.offsets, [12.0, 24.0]);
    assert_eq!(piece.types, [70.0, 70.0]);
    assert_eq!(piece.cell_data["element"], [0.0, 1.0]);
    let degrees = &piece.cell_data["HigherOrderDegrees"];
    assert_eq!(degrees, &[3.0, 2.0, 0.0, 3.0, 2.0, 0.0]);
    // Corners around: u = 0 or 1/2 and v = 0, 1, of the nodes of the patch.
    let corners = [[0, 0], [3, 0], [3, 2], [0, 2]];
    let position = |node| solution.node(node, NodeQuantity::Position, &[0.0]).unwrap();
    for (corner, &at) in corners.iter().enumerate() {
        let node = position(patch.node(at).unwrap());
        for (i, x) in node.iter().enumerate() {
            assert!((piece.points[3 * corner + i] - x).abs() < 1e-14);
        }
    }
    // The second point of the first edge: at ξ = −1/3, η = −1.
    let frame = solution
        .shell_frames(0, &[[-1.0 / 3.0, -1.0]], &[0.0])
        .unwrap()[0];
    for i in 0..3 {
        assert!((piece.points[3 * 4 + i] - frame.position[i]).abs() < 1e-14);
        let axis = piece.at_points("axis_3")[3 * 4 + i];
        assert!((axis - frame.rotation[(i, 2)]).abs() < 1e-14);
    }
    let resultant = |at| solution.shell(0, ShellPoint::new(at), ShellQuantity::Resultant, &[0.0]);
    let first = resultant([-1.0, -1.0]).unwrap();
    assert_eq!(piece.at_points("force_1")[..3], first[..3]);
    assert_eq!(piece.at_points("moment_2")[..3], first[9..]);
    let stress = ShellQuantity::SurfaceStress(ShellSide::Bottom);
    let stress = solution.shell(0, ShellPoint::new([-1.0, -1.0]), stress, &[0.0]);
    assert_eq!(piece.at_points("von_mises_bottom")[0], stress.unwrap()[3]);
    // Their nodes are no bodies.
    assert!(
        !directory
            .path()
            .join("strip")
            .join("bodies_000000.vtp")
            .exists()
    );
}

fn warnings(model: &Model) -> String {
    Summary::of(model).unwrap().warnings.join("\n")
}

#[test]
fn couples_about_the_normal_of_a_single_node_are_warned_of() {
    const WARNED: &str = "a couple about the normal of a shell acts on node";
    let held = || {
        let (mut model, patch) = strip(0.3, &mesh([2, 2], [3, 3]));
        clamp_edge(&mut model, &patch.edge(PatchEdge::StartU));
        let middle = patch.node([2, 2]).unwrap();
        (model, middle)
    };
    let none = warnings(&held().0);
    assert!(none.is_empty(), "{none}");
    let moment = |moment: [f64; 3]| {
        let (mut model, node) = held();
        let load = [0.0, 0.0, 0.0, moment[0], moment[1], moment[2]];
        add_load(&mut model, node, LoadFrame::Space, &load, &[0.0; 6]);
        (warnings(&model), node)
    };
    let (about_normal, node) = moment([0.0, 0.0, 1.0]);
    assert!(
        about_normal.contains(&format!("{WARNED} {node} alone")),
        "{about_normal}"
    );
    assert!(moment([1.0, 1.0, 0.0]).0.is_empty());
    // A joint to the ground at one node, about the normal and across it.
    let joint = |kind, axis: Vector3<f64>| {
        let (mut model, patch) = strip(0.3, &mesh([2, 2], [3, 3]));
        let node = patch.nodes[0];
        let at = model.node(node).unwrap().position;
        let frame = Model::frame_at("axis", &at, &axis).unwrap();
        model
            .add_joint(kind, None, Some(node), &frame, &frame)
            .unwrap();
        warnings(&model)
    };
    assert!(joint(JointKind::Rigid, Vector3::z()).contains(WARNED));
    assert!(joint(JointKind::Revolute, Vector3::x()).contains(WARNED));
    assert!(!joint(JointKind::Revolute, Vector3::z()).contains(WARNED));
    assert!(!joint(JointKind::Spherical, Vector3::z()).contains(WARNED));
    // A beam that butts on a node: frames of nodes have axis 1 along it.
    let section = IsotropicShell::new(THICKNESS, 1e7, 0.3, 1.0).section();
    let axes = Matrix3::from_columns(&[Vector3::z(), Vector3::x(), Vector3::y()]);
    let mut model = Model::new();
    let mut add = |x: f64, y: f64, z: f64| {
        let place = Motion::new(axes, Vector3::new(x, y, z));
        model.add_node(&place).unwrap()
    };
    let corners = [
        add(0.0, 0.0, 0.0),
        add(0.0, 1.0, 0.0),
        add(1.0, 0.0, 0.0),
        add(1.0, 1.0, 0.0),
    ];
    let tip = add(1.0, 1.0, 1.0);
    let placement = ShellPlacement::default();
    model
        .add_shell_element(&corners, [2, 2], &section.unwrap(), &placement)
        .unwrap();
    clamp_edge(&mut model, &corners[..2]);
    assert!(!warnings(&model).contains(WARNED));
    let section = SectionInput::diagonal(&[1e4, 1e4, 1e4, 1.0, 1.0, 1.0], &[1.0, 1e-2, 1e-2, 1e-2]);
    model
        .add_beam_element(&[corners[3], tip], &section.unwrap())
        .unwrap();
    assert!(warnings(&model).contains(WARNED));
}

#[test]
fn thin_warped_elements_of_two_nodes_a_side_are_warned_of() {
    let twisted = |h: f64, nodes: usize, frames: ShellFrames| {
        let section = IsotropicShell::new(h, 29e6, 0.22, 1.0).section().unwrap();
        let surface = |[u, v]: [f64; 2]| {
            let (sine, cosine) = (0.5 * PI * u).sin_cos();
            let across = 1.1 * (v - 0.5);
            Ok(Vector3::new(12.0 * u, across * cosine, across * sine))
        };
        let placement = ShellPlacement {
            frames,
            ..ShellPlacement::default()
        };
        let mut model = Model::new();
        let patch = model.add_shell_patch(
            surface,
            &mesh([12, 2], [nodes, nodes]),
            &section,
            &placement,
        );
        clamp_edge(&mut model, &patch.unwrap().edge(PatchEdge::StartU));
        warnings(&model)
    };
    let locked = twisted(0.0032, 2, ShellFrames::Parallel);
    assert!(
        locked.contains("shell element") && locked.contains("warped"),
        "{locked}"
    );
    assert!(!twisted(0.32, 2, ShellFrames::Parallel).contains("warped"));
    assert!(!twisted(0.0032, 3, ShellFrames::Parallel).contains("warped"));
    assert!(!twisted(0.0032, 2, ShellFrames::Normals).contains("warped"));
}

#[test]
fn solutions_of_other_shell_meshes_are_no_start_and_their_error_is_said_to_be_unknown() {
    let of = |elements| flapping_plate(0.1, [elements, 1], 3);
    let options = PeriodicOptions::with_grid_points(5);
    let (model, period) = of(1);
    let first = Solution::solve(&model, period, &options, &mut |_, _| true).unwrap();
    let report = first.report();
    assert!(report.contains("no such estimate with shells"), "{report}");
    let (model, _) = of(2);
    let start = first.prolonged_to(&model, first.grid());
    let refused = start.map(|_| ()).unwrap_err().to_string();
    assert!(refused.contains("not of shells"), "{refused}");
    assert!(first.prolonged_to(&of(1).0, first.grid()).is_ok());
}

#[test]
fn initial_stress_tunes_a_strip_like_a_string() {
    // Both ends clamped: D w'''' − N w'' = ρ h ω² w.
    let (h, young, density, width, strain) = (5e-3, 1e7, 1.0, 0.1, 1e-3);
    let section = IsotropicShell::new(h, young, 0.0, density)
        .section()
        .unwrap();
    let mut model = Model::new();
    let patch = add_strip(&mut model, [1.0, width], &section, &mesh([4, 1], [6, 3]));
    for edge in [PatchEdge::StartU, PatchEdge::EndU] {
        clamp_edge(&mut model, &patch.edge(edge));
    }
    let mut resultants = Vector12::zeros();
    let tension = strain * young * h;
    resultants[0] = tension;
    for element in 0..patch.element_count() {
        model.set_shell_prestress(element, &resultants).unwrap();
    }
    let refused = model.set_shell_prestress(4, &resultants).unwrap_err();
    assert!(refused.to_string().contains("below 4"));
    let options = ModesOptions {
        count: 1,
        ..ModesOptions::default()
    };
    let modes = Modes::solve(&model, &options, &mut |_, _| true).unwrap();
    let found = modes.modes()[0].eigenvalue.im;
    // a tanh(a/2) + b tan(b/2) = 0 for the lowest symmetric mode, a² − b² = N/D, a b = ω √(ρh/D).
    let bending = young * h.powi(3) / 12.0;
    let mismatch = |b: f64| {
        let a = (b * b + tension / bending).sqrt();
        a * (0.5 * a).tanh() + b * (0.5 * b).tan()
    };
    let (mut low, mut high) = (PI * (1.0 + 1e-9), 1.5 * PI);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if mismatch(middle) < 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    let a = (low * low + tension / bending).sqrt();
    let exact = a * low * (bending / (density * h)).sqrt();
    // Of shear, (h/L)² times a few.
    assert!((found - exact).abs() < 2e-4 * exact, "{found} {exact}");
    // A file has it, too.
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("strip");
    model.save(&path).unwrap();
    let loaded = Modes::solve(&Model::load(&path).unwrap(), &options, &mut |_, _| true).unwrap();
    assert_eq!(loaded.modes()[0].eigenvalue.im, found);
    let solution = statics(&model);
    let resultant = solution.shell(
        1,
        ShellPoint::new([0.1, 0.2]),
        ShellQuantity::Resultant,
        &[0.0],
    );
    assert!((resultant.unwrap()[0] - tension).abs() < 1e-12 * tension);
}
