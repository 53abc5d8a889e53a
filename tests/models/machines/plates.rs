//! Plates and shells: clamped along one side, whose base moves or that are loaded at a corner or
//! all over.

use super::workshop::{FREQUENCY, Vec3, Workshop};
use periodyn::elements::{Coordinate::*, IsotropicShell, JointKind};
use periodyn::model::{PatchEdge, ShellMesh};
use std::f64::consts::TAU;

/// First natural frequency of a strip, clamped at one end, of unit length, bending stiffness and
/// mass per area.
const STRIP: f64 = 3.5;

/// A surface over the unit square, of length 1 from the clamped side on, its area, and its width
/// there where it is loaded.
struct Shape {
    at: Box<dyn Fn([f64; 2]) -> Vec3>,
    area: f64,
    width: f64,
}

/// A strip in the plane.
fn plate(width: f64) -> Shape {
    Shape {
        at: Box::new(move |[u, v]| Vec3::new(u, width * (v - 0.5), 0.0)),
        area: width,
        width,
    }
}

/// A strip whose middle line is a circle's part of so many radians.
fn cylinder(width: f64, angle: f64) -> Shape {
    let bent = move |[u, v]: [f64; 2]| {
        let (sine, cosine) = (angle * u).sin_cos();
        Vec3::new(sine / angle, width * (v - 0.5), (1.0 - cosine) / angle)
    };
    Shape {
        at: Box::new(bent),
        area: width,
        width,
    }
}

/// A strip that is twisted by so many radians.
fn twisted(width: f64, angle: f64) -> Shape {
    let turned = move |[u, v]: [f64; 2]| {
        let (sine, cosine) = (angle * u).sin_cos();
        let across = width * (v - 0.5);
        Vec3::new(u, across * cosine, across * sine)
    };
    Shape {
        at: Box::new(turned),
        area: width,
        width,
    }
}

/// A part of a ring that is clamped at its inner side.
fn ring(inner: f64, angle: f64) -> Shape {
    let turned = move |[u, v]: [f64; 2]| {
        let (sine, cosine) = (angle * (v - 0.5)).sin_cos();
        Vec3::new(cosine, sine, 0.0) * (inner + u)
    };
    let area = 0.5 * angle * (2.0 * inner + 1.0);
    Shape {
        at: Box::new(turned),
        area,
        width: area,
    }
}

/// A patch with a bend in both directions.
fn saddle(width: f64, height: f64) -> Shape {
    let bent = move |[u, v]: [f64; 2]| {
        let across = 2.0 * v - 1.0;
        let z = height * (u * u - across * across * width * width);
        Vec3::new(u, 0.5 * width * across, z)
    };
    Shape {
        at: Box::new(bent),
        area: width,
        width,
    }
}

fn shape(w: &mut Workshop) -> (Shape, bool) {
    let width = w.random.decades(0.2, 1.5);
    let angle = w.random.between(0.2, 1.2);
    let inner = w.random.between(0.3, 1.5);
    let (shape, what) = match w.random.below(6) {
        0 | 1 => (plate(width), format!("plate of {width:.2}")),
        2 => {
            let what = format!("cylinder of {width:.2} over {angle:.2}");
            (cylinder(width, angle), what)
        }
        3 => {
            let what = format!("strip of {width:.2} twisted by {angle:.2}");
            (twisted(width, angle), what)
        }
        4 => {
            let closes = w.random.percent(30);
            let angle = if closes { TAU } else { angle };
            w.note(format!("ring from {inner:.2} over {angle:.2}"));
            return (ring(inner, angle), closes);
        }
        _ => {
            let what = format!("saddle of {width:.2}, {:.2} high", 0.1 * angle);
            (saddle(width, 0.1 * angle), what)
        }
    };
    w.note(what);
    (shape, false)
}

fn mesh(w: &mut Workshop, closes: bool) -> ShellMesh {
    let (elements, degrees) = if closes {
        w.random.pick(&[([1, 6], [3, 3]), ([1, 5], [3, 4])])
    } else {
        w.random.pick(&[
            ([1, 1], [3, 2]),
            ([1, 1], [4, 2]),
            ([2, 1], [3, 3]),
            ([2, 2], [3, 3]),
            ([1, 1], [5, 4]),
            ([3, 2], [2, 2]),
            ([6, 3], [1, 1]),
        ])
    };
    let note = format!("{elements:?} elements of degrees {degrees:?}");
    w.note(note);
    ShellMesh {
        elements,
        degrees,
        join: true,
    }
}

pub fn build(w: &mut Workshop) {
    let (shape, closes) = shape(w);
    let mesh = mesh(w, closes);
    let thickness = w.random.decades(3e-3, 0.05);
    let poisson = w.random.between(0.0, 0.45);
    w.note(format!("thickness {thickness:.1e}"));
    // Mass 1.
    let bending = (FREQUENCY / STRIP).powi(2) / shape.area;
    let young = 12.0 * (1.0 - poisson * poisson) * bending / thickness.powi(3);
    let density = 1.0 / (shape.area * thickness);
    let section = IsotropicShell {
        damping_time: w.damper(1.0),
        ..IsotropicShell::new(thickness, young, poisson, density)
    };
    let patch = w.shell(&shape.at, &mesh, &section);
    let mut root = patch.edge(PatchEdge::StartU);
    if closes {
        root.pop();
    }
    if w.random.percent(50) {
        // Weight bends it by so much of its length, about.
        let sag = w.random.decades(1e-4, 0.1);
        w.note(format!("sag {sag:.1e}"));
        w.gravity(&Vec3::new(0.0, 0.0, -8.0 * bending * shape.width * sag));
    }
    let start = (shape.at)([0.0, 0.5]);
    if w.random.percent(50) {
        let shaft = w.ball(0.1, &start, 0.1);
        for node in root {
            w.clamp(Some(shaft), node, &start);
        }
        let (wave, target) = (w.motion(), w.target());
        let size = target / wave.base_response(w.speed, w.ratio);
        w.note(format!("base moved {size:.1e}"));
        let (joint, coordinate) = if w.random.percent(50) {
            let slide = w.joint(JointKind::Prismatic, None, shaft, &start, &Vec3::z());
            (slide, Displacement1)
        } else {
            let hinge = w.joint(JointKind::Revolute, None, shaft, &start, &Vec3::y());
            (hinge, Rotation1)
        };
        w.prescribe(joint, coordinate, 0.0, Some((&wave, size)));
        return;
    }
    for node in root {
        w.clamp(None, node, &start);
    }
    let (wave, target) = (w.wave(), w.target());
    let size = bending * shape.width * target / wave.response(w.speed, w.ratio);
    let follows = w.random.percent(50);
    let kind = if follows { "following" } else { "dead" };
    if w.random.percent(50) {
        w.note(format!("corner force {target:.1e}, {kind}"));
        let corner = patch.edge(PatchEdge::EndU)[0];
        w.force(corner, follows, &Vec3::z(), 0.0, (&wave, 3.0 * size));
    } else {
        w.note(format!("pressure {target:.1e}, {kind}"));
        w.pressure(&patch, follows, (&wave, 8.0 * size / shape.area));
    }
}
