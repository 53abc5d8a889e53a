//! Plates and shells in the benchmarks of the literature: large bending of curved and of slit
//! shells, thin twisted strips, a hook, with the figures of an independent program for the same
//! meshes.

mod models;

use models::parts::{ball, join};
use models::shells::*;
use nalgebra::{Matrix3, Rotation3, Vector3};
use periodyn::elements::*;
use periodyn::error::Result;
use periodyn::model::*;
use periodyn::motion::Motion;
use periodyn::output::{NodeQuantity, Solution};
use periodyn::solve::*;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// A model with its solution, and Newton's iterations.
struct Found {
    solution: Solution,
    iterations: usize,
}

impl Found {
    fn displacement(&self, node: usize) -> Vector3<f64> {
        let values = self.solution.node(node, NodeQuantity::Position, &[0.0]);
        let there = Vector3::from_column_slice(&values.unwrap());
        there - self.solution.model().node(node).unwrap().position
    }

    /// Turn about z, if small, of a node.
    fn turn(&self, node: usize) -> f64 {
        let values = self
            .solution
            .node(node, NodeQuantity::RotationMatrix, &[0.0]);
        let now = Matrix3::from_column_slice(&values.unwrap());
        let before = self.solution.model().node(node).unwrap().rotation;
        let turn = now * before.transpose();
        0.5 * (turn[(1, 0)] - turn[(0, 1)])
    }

    /// The mean over an edge, by its weights.
    fn mean(&self, nodes: &[usize], weights: &[f64]) -> Vector3<f64> {
        let all = nodes.iter().zip(weights);
        let sum: Vector3<f64> = all.map(|(&node, w)| self.displacement(node) * *w).sum();
        sum / weights.iter().sum::<f64>()
    }
}

fn statics(model: &Model, least_load_steps: usize) -> Found {
    statics_to(1e-9, model, least_load_steps)
}

fn statics_to(tolerance: f64, model: &Model, least_load_steps: usize) -> Found {
    let mut iterations = 0;
    let options = StaticOptions {
        least_load_steps,
        newton: NewtonOptions {
            tolerance,
            iteration_limit: 60,
        },
        ..StaticOptions::default()
    };
    let solution = Solution::solve_static(model, &options, &mut |_, _| {
        iterations += 1;
        true
    })
    .unwrap();
    let report = solution.report();
    assert_eq!(solution.outcome(), Outcome::Converged, "{report}");
    Found {
        solution,
        iterations,
    }
}

fn patch_of(
    model: &mut Model,
    surface: impl Fn([f64; 2]) -> Vector3<f64>,
    section: &IsotropicShell,
    mesh: &ShellMesh,
    frames: ShellFrames,
) -> ShellPatch {
    if frames == ShellFrames::NodeAxes {
        let axes = axes_along_normals(&surface);
        return patch_with_axes(model, &surface, axes, section, mesh, frames);
    }
    let surface = |at: [f64; 2]| -> Result<Vector3<f64>> { Ok(surface(at)) };
    let placement = ShellPlacement {
        frames,
        ..ShellPlacement::default()
    };
    let section = section.section().unwrap();
    model
        .add_shell_patch(surface, mesh, &section, &placement)
        .unwrap()
}

/// Axes whose third one is the normal of the surface itself.
fn axes_along_normals(
    surface: &impl Fn([f64; 2]) -> Vector3<f64>,
) -> impl Fn([f64; 2]) -> Matrix3<f64> {
    move |[u, v]| {
        const SMALL: f64 = 1e-6;
        let along = surface([u + SMALL, v]) - surface([u - SMALL, v]);
        let across = surface([u, v + SMALL]) - surface([u, v - SMALL]);
        let (first, normal) = (along.normalize(), along.cross(&across).normalize());
        Matrix3::from_columns(&[first, normal.cross(&first), normal])
    }
}

/// A patch over nodes with these axes, whose third ones are taken for the surface's normals, by
/// `NodeAxes` or `NodeFrames`.
fn patch_with_axes(
    model: &mut Model,
    surface: impl Fn([f64; 2]) -> Vector3<f64>,
    axes: impl Fn([f64; 2]) -> Matrix3<f64>,
    section: &IsotropicShell,
    mesh: &ShellMesh,
    frames: ShellFrames,
) -> ShellPatch {
    let places = [0, 1].map(|d| {
        let (elements, degree) = (mesh.elements[d], mesh.degrees[d]);
        let points = lobatto_points(degree + 1);
        let place = |k: usize| match k {
            k if k == elements * degree => 1.0,
            k => ((k / degree) as f64 + 0.5 * (points[k % degree] + 1.0)) / elements as f64,
        };
        (0..=elements * degree).map(place).collect::<Vec<f64>>()
    });
    let lines = [places[0].len(), places[1].len()];
    let mut nodes = Vec::new();
    for &u in &places[0] {
        for &v in &places[1] {
            let motion = Motion::new(axes([u, v]), surface([u, v]));
            nodes.push(model.add_node(&motion).unwrap());
        }
    }
    let section = section.section().unwrap();
    let placement = ShellPlacement {
        frames,
        ..ShellPlacement::default()
    };
    let [du, dv] = mesh.degrees;
    let first_element = model.shell_element_count();
    for i in 0..mesh.elements[0] {
        for j in 0..mesh.elements[1] {
            let at = |(a, b): (usize, usize)| nodes[(i * du + a) * lines[1] + j * dv + b];
            let own = (0..=du).flat_map(|a| (0..=dv).map(move |b| (a, b)));
            let own: Vec<usize> = own.map(at).collect();
            let sides = [du + 1, dv + 1];
            let added = model.add_shell_element(&own, sides, &section, &placement);
            added.unwrap();
        }
    }
    ShellPatch {
        first_element,
        elements: mesh.elements,
        lines,
        nodes,
    }
}

/// Checks that numbers are those given, to a unit of the last digit that is given: half of it for
/// its rounding, half for what the tolerances of both programs leave.
fn require_digits(what: &str, found: &[f64], given: &[f64], unit: f64) {
    println!("{what}: {found:?}, given {given:?}");
    for (found, given) in found.iter().zip(given) {
        assert!((found - given).abs() <= unit, "{what}: {found} {given}");
    }
}

/// A strip under a dead shear force at its end; shortening and deflection of the end.
fn cantilever(nodes: usize, elements: usize) -> ([f64; 2], usize) {
    let section = IsotropicShell::new(0.1, 1.2e6, 0.0, 1.0);
    let mut model = Model::new();
    let mesh = mesh([elements, 1], [nodes, nodes]);
    let patch = add_strip(&mut model, [10.0, 1.0], &section.section().unwrap(), &mesh);
    clamp_edge(&mut model, &patch.edge(PatchEdge::StartU));
    let (tip, weights) = (patch.edge(PatchEdge::EndU), edge_weights(1.0, 1, nodes - 1));
    load_edge(&mut model, &tip, &weights, [0.0, 0.0, 4.0, 0.0, 0.0, 0.0]);
    let found = statics(&model, 1);
    let moved = found.displacement(tip[0]);
    ([-moved.x, moved.z], found.iterations)
}

#[test]
fn a_cantilever_converges_with_order_and_mesh() {
    for (nodes, elements, given) in [
        (2, 8, [3.23348, 6.61413]),
        (2, 16, [3.27516, 6.67821]),
        (3, 4, [3.28537, 6.69283]),
        (3, 8, [3.28923, 6.69962]),
        (4, 2, [3.28752, 6.69620]),
        (4, 4, [3.28947, 6.70005]),
        (5, 1, [3.28481, 6.69123]),
        (5, 2, [3.28945, 6.70001]),
        (6, 1, [3.28915, 6.69943]),
        (6, 2, [3.28951, 6.70013]),
        (8, 1, [3.28951, 6.70013]),
    ] {
        let (found, iterations) = cantilever(nodes, elements);
        let what = format!("{nodes} nodes, {elements} elements, {iterations} iterations");
        require_digits(&what, &found, &given, 1e-5);
        // 8 of the other program.
        assert!(iterations <= 10, "{iterations}");
    }
}

/// A ring that is slit, one lip of it clamped and the other lifted; how far the inner and the outer
/// end of this go.
fn slit_ring(nodes: usize, elements: [usize; 2], drilling: f64) -> ([f64; 2], usize) {
    let section = IsotropicShell {
        drilling,
        ..IsotropicShell::new(0.03, 21e6, 0.0, 1.0)
    };
    let mesh = ShellMesh {
        join: false,
        ..mesh(elements, [nodes, nodes])
    };
    let mut model = Model::new();
    let (centre, axis, start) = (Vector3::zeros(), Vector3::z(), Vector3::x());
    let ring = annulus_sector(&centre, &axis, &start, [6.0, 10.0], TAU).unwrap();
    let ring = |at| ring(at).unwrap();
    let patch = patch_of(&mut model, ring, &section, &mesh, ShellFrames::Parallel);
    clamp_edge(&mut model, &patch.edge(PatchEdge::StartV));
    let lip = patch.edge(PatchEdge::EndV);
    let weights = edge_weights(4.0, elements[0], nodes - 1);
    load_edge(&mut model, &lip, &weights, [0.0, 0.0, 0.8, 0.0, 0.0, 0.0]);
    let found = statics(&model, 7);
    let ends = [lip[0], lip[lip.len() - 1]];
    (
        ends.map(|node| found.displacement(node).z),
        found.iterations,
    )
}

/// Checks how far the ends go, to the digits given.
fn require_slit_ring(nodes: usize, elements: [usize; 2], given: [f64; 2]) {
    let (found, iterations) = slit_ring(nodes, elements, 1.0);
    let what = format!("{nodes} nodes, {elements:?}, {iterations} iterations");
    require_digits(&what, &found, &given, 1e-3);
    // 37 of the other program, with 7 load steps, too, each of which converges.
    assert!(iterations <= 26, "{iterations}");
}

#[test]
fn a_slit_ring_converges_with_order_and_mesh() {
    for (nodes, elements, given) in [
        (2, [6, 30], [12.487, 16.110]),
        (3, [3, 15], [13.114, 16.725]),
        (4, [1, 6], [12.804, 16.388]),
        (4, [2, 10], [13.524, 17.156]),
        (5, [1, 6], [13.400, 17.042]),
        (6, [1, 6], [13.705, 17.340]),
        (6, [2, 8], [13.764, 17.402]),
    ] {
        require_slit_ring(nodes, elements, given);
    }
    // Held less against drilling; the inner end alone is known.
    let (found, _) = slit_ring(4, [1, 6], 0.1);
    require_digits("drilling 0.1", &found[..1], &[12.875], 1e-3);
}

#[test]
fn the_finest_slit_rings_are_those_of_the_other_program() {
    require_slit_ring(5, [2, 12], [13.800, 17.437]);
    require_slit_ring(8, [1, 6], [13.823, 17.461]);
}

/// Holds the nodes of an edge to the plane across `axis`, without turning about other axes.
fn hold_in_plane(model: &mut Model, nodes: &[usize], axis: &Vector3<f64>) {
    for &node in nodes {
        let at = model.node(node).unwrap().position;
        let frame = Model::frame_at("axis", &at, axis).unwrap();
        model
            .add_joint(JointKind::Planar, None, Some(node), &frame, &frame)
            .unwrap();
    }
}

/// A quarter of a hemisphere with a hole of 18° at its top, drawn outwards and pushed inwards; how
/// far the points of these forces go.
fn hemisphere(
    nodes: usize,
    elements: usize,
    frames: ShellFrames,
    drilling: f64,
) -> ([f64; 2], usize) {
    hemisphere_in(4, (nodes, elements), frames, drilling)
}

/// The same in so many load steps at least. `NodeFrames` are along the sphere's normals, turned
/// from the hemisphere's axis by the smallest rotations.
fn hemisphere_in(
    least_load_steps: usize,
    (nodes, elements): (usize, usize),
    frames: ShellFrames,
    drilling: f64,
) -> ([f64; 2], usize) {
    let section = IsotropicShell {
        drilling,
        ..IsotropicShell::new(0.04, 6.825e7, 0.3, 1.0)
    };
    let (radius, hole) = (10.0, PI / 10.0);
    let surface = |[u, v]: [f64; 2]| {
        let (polar, around) = (FRAC_PI_2 - (FRAC_PI_2 - hole) * v, FRAC_PI_2 * u);
        let (sine, cosine) = polar.sin_cos();
        Vector3::new(sine * around.cos(), sine * around.sin(), cosine) * radius
    };
    let mut model = Model::new();
    let mesh = mesh([elements, elements], [nodes, nodes]);
    let axes = |at: [f64; 2]| {
        let turn = Rotation3::rotation_between(&Vector3::z(), &surface(at));
        *turn.unwrap().matrix()
    };
    let patch = match frames {
        ShellFrames::NodeFrames => {
            patch_with_axes(&mut model, surface, axes, &section, &mesh, frames)
        }
        frames => patch_of(&mut model, surface, &section, &mesh, frames),
    };
    let meridians = [PatchEdge::StartU, PatchEdge::EndU].map(|edge| patch.edge(edge));
    hold_in_plane(&mut model, &meridians[0], &Vector3::y());
    hold_in_plane(&mut model, &meridians[1], &Vector3::x());
    let equator = patch.edge(PatchEdge::StartV);
    // Nothing else holds it vertically, and nothing lifts it.
    let middle = equator[equator.len() / 2];
    let position = model.node(middle).unwrap().position;
    let free = join(
        &mut model,
        JointKind::Free,
        [None, Some(middle)],
        &position,
        &Vector3::z(),
    );
    let height = JointCoordinate {
        joint: free,
        coordinate: Coordinate::Displacement3,
    };
    model
        .prescribe(height, &Signal::constant(0.0).unwrap())
        .unwrap();
    let points = [equator[0], equator[equator.len() - 1]];
    for (&node, force) in points.iter().zip([[200.0, 0.0], [0.0, -200.0]]) {
        let force = [force[0], force[1], 0.0, 0.0, 0.0, 0.0];
        load_edge(&mut model, &[node], &[1.0], force);
    }
    let found = statics(&model, least_load_steps);
    let [outwards, inwards] = points.map(|node| found.displacement(node));
    ([outwards.x, -inwards.y], found.iterations)
}

#[test]
fn a_hemisphere_with_a_hole_converges_with_order_and_mesh() {
    for (nodes, elements, drilling, given) in [
        (2, 8, 1.0, [3.178, 6.306]),
        (2, 16, 1.0, [3.865, 7.936]),
        (3, 4, 1.0, [3.126, 5.620]),
        (3, 8, 1.0, [3.908, 7.752]),
        (4, 4, 1.0, [3.916, 7.790]),
        (5, 2, 1.0, [3.727, 7.326]),
        (5, 3, 1.0, [3.984, 7.955]),
        (5, 3, 0.1, [4.004, 8.016]),
        (6, 2, 1.0, [3.963, 7.907]),
    ] {
        let (found, iterations) = hemisphere(nodes, elements, ShellFrames::Parallel, drilling);
        let what = format!("{nodes} nodes, {elements}², {drilling}, {iterations} iterations");
        require_digits(&what, &found, &given, 1e-3);
        assert!(iterations <= 20, "{iterations}");
    }
    for (nodes, elements, given) in [
        (5, 4, [4.0495, 8.1061]),
        (6, 3, [4.0573, 8.1160]),
        (8, 2, [4.0627, 8.1161]),
    ] {
        let (found, iterations) = hemisphere(nodes, elements, ShellFrames::Parallel, 1.0);
        let what = format!("{nodes} nodes, {elements}², {iterations} iterations");
        require_digits(&what, &found, &given, 1e-4);
    }
}

/// Newton's method is lost at once, and goes on with parts of the load.
#[test]
fn a_load_step_that_is_too_long_is_soon_given_up() {
    let of = |steps| hemisphere_in(steps, (4, 3), ShellFrames::Parallel, 1.0);
    let ((found, iterations), (with_four, _)) = (of(1), of(4));
    for (found, other) in found.iter().zip(&with_four) {
        // Both converged to 1e-9 of the size of the shell.
        assert!((found - other).abs() < 1e-8, "{found} {other}");
    }
    // 14 of the other program.
    assert!(iterations <= 17, "{iterations}");
}

#[test]
fn frames_along_normals_are_nearer_to_the_limit_of_the_hemisphere() {
    // The other program's frames are along the sphere's normals, each turned from the hemisphere's
    // axis by the smallest rotation: these are its figures.
    for (nodes, elements, other) in [
        (2, 8, [3.023, 5.878]),
        (2, 16, [3.837, 7.899]),
        (3, 4, [2.971, 5.179]),
        (3, 8, [3.864, 7.602]),
        (4, 4, [3.866, 7.660]),
        (5, 2, [3.699, 7.166]),
        (5, 3, [3.985, 7.939]),
        (6, 2, [3.984, 7.905]),
    ] {
        let (found, iterations) = hemisphere(nodes, elements, ShellFrames::NodeFrames, 1.0);
        let what = format!("{nodes} nodes, {elements}², {iterations} iterations");
        require_digits(&what, &found, &other, 1e-3);
        let (found, _) = hemisphere(nodes, elements, ShellFrames::Normals, 1.0);
        // Of the finest meshes: 4.063, 8.116.
        for ((found, other), limit) in found.iter().zip(&other).zip([4.07, 8.13]) {
            assert!(found > other && *found < limit, "{found} {other}");
        }
    }
}

/// MacNeal and Harder's twisted beam of thickness `h`, by forces in and out of the plane of its
/// end: its displacements along these. `NodeAxes` are those of its cross-sections.
fn twisted(h: f64, nodes: usize, elements: [usize; 2], frames: ShellFrames) -> [f64; 2] {
    let force: f64 = if h < 0.1 { 1e-6 } else { 1.0 };
    twisted_by(force, h, nodes, elements, frames)
}

/// The same by forces of this size, over this size.
fn twisted_by(
    force: f64,
    h: f64,
    nodes: usize,
    elements: [usize; 2],
    frames: ShellFrames,
) -> [f64; 2] {
    let section = IsotropicShell::new(h, 29e6, 0.22, 1.0);
    let (length, width) = (12.0, 1.1);
    let axes =
        |[u, _]: [f64; 2]| *Rotation3::from_axis_angle(&Vector3::x_axis(), FRAC_PI_2 * u).matrix();
    let surface = |[u, v]: [f64; 2]| {
        axes([u, v]).column(1) * (width * (v - 0.5)) + Vector3::x() * (length * u)
    };
    let weights = edge_weights(width, elements[1], nodes - 1);
    let mut out = [0.0; 2];
    for (axis, out) in [2, 1].into_iter().zip(&mut out) {
        let mut model = Model::new();
        let mesh = mesh(elements, [nodes, nodes]);
        let patch = match frames {
            ShellFrames::NodeAxes => {
                patch_with_axes(&mut model, surface, axes, &section, &mesh, frames)
            }
            frames => patch_of(&mut model, surface, &section, &mesh, frames),
        };
        clamp_edge(&mut model, &patch.edge(PatchEdge::StartU));
        let tip = patch.edge(PatchEdge::EndU);
        let mut load = [0.0; 6];
        load[axis] = force / width;
        load_edge(&mut model, &tip, &weights, load);
        let found = statics(&model, 1);
        *out = found.mean(&tip, &weights)[axis] / force;
    }
    out
}

#[test]
fn a_twisted_beam_converges_thick_and_thin() {
    use ShellFrames::{NodeAxes, Normals, Parallel};
    let (thick, thin) = ([5.424e-3, 1.754e-3], [5256.0, 1294.0]);
    // The other program's frames are those of the cross-sections, whose third axes are not quite
    // along the normals beside the middle.
    for (h, nodes, elements, frames, given, unit) in [
        (0.32, 2, [24, 4], Normals, [0.9966, 0.9951], 1e-3),
        (0.32, 3, [6, 1], Normals, [0.9968, 0.9984], 1e-3),
        (0.32, 3, [12, 2], Normals, [0.9975, 0.9978], 1e-4),
        (0.32, 4, [4, 1], Normals, [0.9965, 0.9978], 1e-4),
        (0.32, 5, [4, 1], Normals, [0.9973, 0.9979], 1e-4),
        (0.32, 8, [2, 1], Normals, [0.9975, 0.9980], 1e-4),
        (0.0032, 2, [24, 4], Normals, [0.9823, 0.9904], 1e-3),
        (0.0032, 3, [6, 1], Normals, [0.9643, 0.9565], 2.5e-3),
        (0.0032, 3, [12, 2], Normals, [0.9784, 0.9852], 1e-3),
        (0.0032, 4, [4, 1], Normals, [0.9883, 0.9966], 1.5e-3),
        (0.0032, 5, [4, 1], Normals, [0.9916, 0.9981], 3e-4),
        (0.0032, 8, [2, 1], Normals, [0.9958, 0.9988], 1e-4),
        (0.0032, 2, [12, 2], Parallel, [0.38, 0.71], 1e-2),
        (0.0032, 2, [24, 4], Parallel, [0.8845, 0.9865], 1e-4),
        (0.0032, 3, [6, 1], Parallel, [0.9809, 0.9777], 1e-4),
        (0.0032, 3, [12, 2], Parallel, [0.9922, 0.9933], 1e-4),
        (0.0032, 4, [4, 1], Parallel, [0.9931, 0.9977], 1e-4),
        (0.0032, 5, [4, 1], Parallel, [0.9937, 0.9985], 1e-4),
        (0.0032, 8, [2, 1], Parallel, [0.9968, 0.9988], 1e-4),
    ] {
        let exact = if h == 0.32 { thick } else { thin };
        let found = twisted(h, nodes, elements, frames);
        let ratios = [found[0] / exact[0], found[1] / exact[1]];
        let what = format!("{h}, {nodes} nodes, {elements:?}, {frames:?}");
        require_digits(&what, &ratios, &given, unit);
        if frames == Normals {
            let found = twisted(h, nodes, elements, NodeAxes);
            let ratios = [found[0] / exact[0], found[1] / exact[1]];
            require_digits(&format!("{what}, of sections"), &ratios, &given, 1e-4);
        }
    }
    let found = twisted(0.32, 8, [3, 1], Parallel);
    require_digits("finest, thick", &found, &[5.41192e-3, 1.750514e-3], 1e-8);
    let found = twisted(0.0032, 8, [3, 1], Parallel);
    require_digits("finest, thin", &found, &[5244.3, 1292.55], 0.15);
    // What is of second order shows in the last digits: forces of 7.6e-6 to 9.5e-6 give those of
    // the other program.
    let found = twisted_by(8.5e-6, 0.0032, 8, [3, 1], Parallel);
    require_digits("in plane", &found[..1], &[5244.3], 0.05);
    require_digits("out of plane", &found[1..], &[1292.55], 0.005);
    // By default elements of two nodes a side do not lock.
    let found = twisted(0.0032, 2, [12, 2], Normals);
    assert!(found[0] > 0.95 * thin[0], "{found:?}");
}

/// Raasch's hook under a force along its width: how far its end goes.
fn hook(nodes: usize, elements: [usize; 2], frames: ShellFrames, drilling: f64) -> f64 {
    let section = IsotropicShell {
        drilling,
        ..IsotropicShell::new(2.0, 3300.0, 0.35, 1.0)
    };
    let (width, radii, angles) = (20.0, [14.0, 46.0], [PI / 3.0, 5.0 * PI / 6.0]);
    let surface = |[u, v]: [f64; 2]| {
        let at = width * v;
        // Turns to the left first, then to the right.
        let along = |angle: f64| Vector3::new(angle.sin(), 0.0, 1.0 - angle.cos());
        if u <= 0.5 {
            return along(2.0 * u * angles[0]) * radii[0] + Vector3::y() * at;
        }
        let (corner, turn) = (angles[0], angles[0] - (2.0 * u - 1.0) * angles[1]);
        let second = Vector3::new(corner.sin() - turn.sin(), 0.0, turn.cos() - corner.cos());
        along(corner) * radii[0] + second * radii[1] + Vector3::y() * at
    };
    let mut model = Model::new();
    let mesh = mesh([2 * elements[0], elements[1]], [nodes, nodes]);
    let patch = patch_of(&mut model, surface, &section, &mesh, frames);
    clamp_edge(&mut model, &patch.edge(PatchEdge::StartU));
    let tip = patch.edge(PatchEdge::EndU);
    let weights = edge_weights(width, elements[1], nodes - 1);
    let small = 1e-3;
    load_edge(
        &mut model,
        &tip,
        &weights,
        [0.0, small / width, 0.0, 0.0, 0.0, 0.0],
    );
    let found = statics(&model, 1);
    found.mean(&tip, &weights).y / small
}

#[test]
fn raaschs_hook_converges_with_order_and_mesh() {
    use ShellFrames::{NodeAxes, Normals};
    for (nodes, elements, drilling, given, unit) in [
        (2, [9, 5], 1.0, 4.779, 1e-3),
        (3, [9, 3], 1.0, 4.889, 1e-3),
        (4, [3, 2], 1.0, 4.904, 1e-3),
        (5, [3, 2], 1.0, 4.930, 1e-3),
        (8, [1, 1], 1.0, 4.9373, 1e-4),
        // Of its finest mesh.
        (8, [2, 1], 1.0, 4.93779, 5e-5),
        (8, [2, 1], 0.1, 4.9415, 1e-4),
    ] {
        let found = hook(nodes, elements, NodeAxes, drilling);
        let what = format!("{nodes} nodes, {elements:?}, {drilling}");
        require_digits(&what, &[found], &[given], unit);
        // Elements of two nodes a side alone show what the exact normals are good for.
        let found = hook(nodes, elements, Normals, drilling);
        let near = if nodes == 2 { 0.05 } else { 1e-3 };
        assert!((found - given).abs() < near, "{what}: {found}");
    }
}

#[test]
fn a_rigid_edge_passes_a_couple_about_the_normal_to_a_beam_along_it() {
    let (length, width, h, young) = (1.0, 0.5, 0.02, 1e7);
    let (beam_length, torsion, couple) = (0.7, 3e2, 0.1);
    for (nodes, drilling) in [2, 3, 4, 5].into_iter().flat_map(|n| [(n, 1.0), (n, 0.1)]) {
        let section = IsotropicShell {
            drilling,
            ..IsotropicShell::new(h, young, 0.0, 1.0)
        };
        let mut model = Model::new();
        let section = section.section().unwrap();
        let mesh = mesh([2, 2], [nodes, nodes]);
        let patch = add_strip(&mut model, [length, width], &section, &mesh);
        clamp_edge(&mut model, &patch.edge(PatchEdge::StartU));
        let middle = Vector3::new(length, 0.5 * width, 0.0);
        let body = ball(&mut model, 1.0, 1.0, &middle);
        let edge = patch.edge(PatchEdge::EndU);
        model.add_rigid_joints(Some(body), &edge).unwrap();
        let stiffness = [1e6, 1e6, 1e6, torsion, 1e3, 1e3];
        let of_beam = SectionInput::diagonal(&stiffness, &[1.0, 1e-3, 1e-3, 1e-3]).unwrap();
        let end = middle + Vector3::z() * beam_length;
        let beam = model
            .add_straight_beam(&middle, &end, &Vector3::x(), &of_beam, 2, 2)
            .unwrap();
        join(
            &mut model,
            JointKind::Rigid,
            [Some(body), Some(beam.first_node)],
            &middle,
            &Vector3::z(),
        );
        let load = [0.0, 0.0, 0.0, 0.0, 0.0, couple];
        load_edge(&mut model, &[beam.last_node], &[1.0], load);
        let found = statics_to(1e-12, &model, 1);
        let turn = found.turn(beam.last_node);
        // Gradients of the drilling rotation resist, too: k_t G h³/12 for each width.
        let bending = young * h * width.powi(3) / 12.0;
        let bending = bending + 0.1 * 0.5 * young * h.powi(3) / 12.0 * width;
        let exact = couple * (length / bending + beam_length / torsion);
        let error = (turn / exact - 1.0).abs();
        println!("{nodes} nodes, k_d {drilling}: {error:e}");
        // What is of second order in turns of 3e-4.
        assert!(error < 4e-8, "{error:e}");
    }
}
