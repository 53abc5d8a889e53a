//! What models are built of.

use nalgebra::{Matrix3, Vector3};
use periodyn::elements::{Coordinate, CoordinateLaw, Effort, JointKind, LoadFrame};
use periodyn::model::*;
use std::f64::consts::TAU;
use std::sync::Arc;

/// A ball of inertia `inertia` about each axis.
pub fn ball(model: &mut Model, mass: f64, inertia: f64, centre: &Vector3<f64>) -> usize {
    let inertia = Matrix3::identity() * inertia;
    model.add_rigid_body(mass, centre, &inertia).unwrap()
}

/// A mass, which is node 0, on a slide from the ground, and the slide's coordinate.
pub fn mass_on_a_slide(mass: f64, axis: &Vector3<f64>) -> (Model, JointCoordinate) {
    let mut model = Model::new();
    let body = ball(&mut model, mass, 1.0, &Vector3::zeros());
    let origin = Vector3::zeros();
    let slide = [None, Some(body)];
    let joint = join(&mut model, JointKind::Prismatic, slide, &origin, axis);
    let at = JointCoordinate {
        joint,
        coordinate: Coordinate::Displacement1,
    };
    (model, at)
}

/// A body, which is node 0, on a revolute joint from the ground about `axis` at the origin; and the
/// joint.
pub fn hinged_body(
    mass: f64,
    centre: &Vector3<f64>,
    inertia: &Matrix3<f64>,
    axis: &Vector3<f64>,
) -> (Model, usize) {
    let mut model = Model::new();
    let body = model.add_rigid_body(mass, centre, inertia).unwrap();
    let hinge = revolute(&mut model, None, Some(body), &Vector3::zeros(), axis);
    (model, hinge)
}

/// A joint at `point` about, or along, `axis`.
pub fn join(
    model: &mut Model,
    kind: JointKind,
    [first, second]: [Option<usize>; 2],
    point: &Vector3<f64>,
    axis: &Vector3<f64>,
) -> usize {
    let frame = Model::frame_at("axis", point, axis).unwrap();
    model
        .add_joint(kind, first, second, &frame, &frame)
        .unwrap()
}

/// A revolute joint at `point` about `axis`.
pub fn revolute(
    model: &mut Model,
    first: Option<usize>,
    second: Option<usize>,
    point: &Vector3<f64>,
    axis: &Vector3<f64>,
) -> usize {
    join(model, JointKind::Revolute, [first, second], point, axis)
}

/// Holds a node where it is; gives the joint.
pub fn clamp(model: &mut Model, node: usize) -> usize {
    let frame = *model.node(node).unwrap();
    let held = model.add_joint(JointKind::Rigid, None, Some(node), &frame, &frame);
    held.unwrap()
}

pub fn rotation1(joint: usize) -> JointCoordinate {
    JointCoordinate {
        joint,
        coordinate: Coordinate::Rotation1,
    }
}

/// A spring and damper without stress at zero.
pub fn spring(model: &mut Model, at: JointCoordinate, stiffness: f64, damping: f64) {
    let definition = SpringDefinition {
        at,
        stiffness,
        damping,
        rest: 0.0,
    };
    model.add_spring_damper(definition).unwrap();
}

/// A spring with the energy `stiffness (1 − cos q)`.
pub fn sine_spring(stiffness: f64) -> CoordinateLaw {
    CoordinateLaw {
        function: Arc::new(move |at| {
            Ok(Effort {
                value: stiffness * at.value.sin(),
                by_coordinate: stiffness * at.value.cos(),
                by_rate: 0.0,
            })
        }),
        gives_derivatives: true,
    }
}

pub fn gravity(model: &mut Model, acceleration: [f64; 3]) {
    model.set_gravity(acceleration.map(|g| Signal::constant(g).unwrap()));
}

/// A cosine of the period's first harmonic.
pub fn cosine(amplitude: f64) -> Signal {
    Signal::harmonics(0.0, 0.0, &[amplitude], &[0.0]).unwrap()
}

/// What grows by `rate` a unit of time.
pub fn steady(rate: f64) -> Signal {
    Signal::harmonics(0.0, rate, &[], &[]).unwrap()
}

/// Turns a joint once a period.
pub fn drive(model: &mut Model, joint: usize, period: f64) {
    model
        .prescribe(rotation1(joint), &steady(TAU / period))
        .unwrap();
}

/// A force on `node` along axis `component` of space.
pub fn push(model: &mut Model, node: usize, component: usize, force: Signal) {
    let mut components = [(); 6].map(|()| None);
    components[component] = Some(force);
    model.add_load(node, LoadFrame::Space, components).unwrap();
}

/// A load of constant and cosine parts, given as vectors `[force; moment]`.
pub fn add_load(
    model: &mut Model,
    node: usize,
    frame: LoadFrame,
    constant: &[f64; 6],
    cosine: &[f64; 6],
) {
    let component = |i: usize| {
        let any = constant[i] != 0.0 || cosine[i] != 0.0;
        any.then(|| Signal::harmonics(constant[i], 0.0, &[cosine[i]], &[0.0]).unwrap())
    };
    model
        .add_load(node, frame, std::array::from_fn(component))
        .unwrap();
}

/// A section whose damping is `seconds` times the stiffness.
pub fn damped_section(stiffness: &[f64; 6], mass: &[f64; 4], seconds: f64) -> SectionInput {
    let mut section = SectionInput::diagonal(stiffness, mass).unwrap();
    section.damp_proportionally(seconds).unwrap();
    section
}

/// Sectional stiffnesses and masses of the paper's bars.
pub const THICK: [f64; 6] = [52.99e6, 16.88e6, 16.88e6, 733.5, 1131.0, 1131.0];
pub const THICK_MASS: [f64; 4] = [1.997, 85.2e-6, 42.6e-6, 42.6e-6];
pub const THIN: [f64; 6] = [13.25e6, 4.22e6, 4.22e6, 45.84, 70.66, 70.66];
pub const THIN_MASS: [f64; 4] = [0.4992, 5.324e-6, 2.662e-6, 2.662e-6];
