//! Shafts that turn in springs, with discs, unbalance and cranks, in one piece or joined.

use super::workshop::{FREQUENCY, Flexible, Vec3, Workshop};
use nalgebra::Matrix3;
use periodyn::elements::{Coordinate::*, JointKind};
use periodyn::motion::rotation_from_vector;
use std::f64::consts::TAU;

/// A piece of the shaft: its end nodes and places.
struct Piece {
    nodes: [usize; 2],
    ends: [Vec3; 2],
}

/// How the shaft is turned.
#[derive(Clone, Copy, PartialEq)]
enum Drive {
    /// Its turn at the first bearing is prescribed, whose springs hold it.
    OnSprings,
    /// A motor in a fixed bearing turns its first end.
    Hinged,
    /// A motor does, by a universal joint.
    Universal,
}

pub fn build(w: &mut Workshop) {
    let discs = w.random.below(4);
    let disc_mass = if discs == 0 {
        0.0
    } else {
        w.random.decades(0.1, 3.0)
    };
    let total = 1.0 + discs as f64 * disc_mass;
    // Share of the bearings in the static deflection.
    let share = w.random.between(0.1, 0.9);
    let moving = 0.49 + discs as f64 * disc_mass;
    let bending = moving * FREQUENCY * FREQUENCY / (48.0 * (1.0 - share));
    let pieces = w.random.pick(&[1, 1, 2, 3, 4, 6, 8]);
    let throw = if pieces >= 3 && w.random.percent(50) {
        w.random.between(0.03, 0.1)
    } else {
        0.0
    };
    w.note(format!(
        "{pieces} pieces, {discs} discs of {disc_mass:.2}, throw {throw:.2}"
    ));
    let pieces = pieces_of(w, pieces, throw, bending);
    let drive = drive(w, &pieces);
    bearings(w, &pieces, drive, total * FREQUENCY * FREQUENCY / share);
    for i in 0..discs {
        let piece = &pieces[(i + 1) * (pieces.len() - 1) / discs.max(1)];
        let radius = w.random.between(0.1, 0.25);
        let moments = Vec3::new(0.5, 0.25, 0.25) * (disc_mass * radius * radius);
        let centre = Vec3::new(piece.ends[1].x, 0.0, 0.0);
        w.mass(
            piece.nodes[1],
            disc_mass,
            &centre,
            &Matrix3::from_diagonal(&moments),
        );
    }
    // A small mass off the axis: whirls by so much of the length.
    let whirl = w.random.decades(1e-6, 0.05);
    let x = w.speed;
    let off = whirl * total / (x * x * super::waves::gain(x, w.ratio)).max(0.05);
    let off = off.min(0.02 * total);
    let small = 0.05 * total;
    let at = &pieces[pieces.len() / 2];
    let (node, centre) = (at.nodes[0], Vec3::new(at.ends[0].x, 0.0, off / small));
    w.note(format!("whirl {whirl:.1e}"));
    w.mass(node, small, &centre, &Matrix3::zeros());
    if w.random.percent(60) {
        let sag = w.random.decades(1e-4, 0.03);
        w.gravity(&Vec3::new(0.0, 0.0, -sag * FREQUENCY * FREQUENCY));
    }
    if w.random.percent(40) {
        let (wave, target) = (w.wave(), w.random.decades(1e-4, 0.05));
        let size = total * FREQUENCY * FREQUENCY * target / wave.response(x, w.ratio);
        w.note(format!("force {target:.1e}"));
        w.force(node, false, &Vec3::z(), 0.0, (&wave, size));
    }
}

/// Pieces along the first axis; inner ones off it, if the shaft has cranks, one after the other
/// further round.
fn pieces_of(w: &mut Workshop, count: usize, throw: f64, bending: f64) -> Vec<Piece> {
    let mut whole = w.flexible(bending);
    whole.slenderness = whole.slenderness.max(1e3);
    let (elements, degree) = match count {
        1 => (whole.elements.max(4), whole.degree),
        2 => (2, 2),
        _ => (1, 2),
    };
    let mut pieces: Vec<Piece> = Vec::new();
    for i in 0..count {
        let length = 1.0 / count as f64;
        let own = Flexible {
            // Axial stiffness times the length of the piece squared.
            slenderness: whole.slenderness * length * length,
            elements,
            degree,
            ..whole
        };
        let pin = if i % 2 == 1 { throw } else { 0.0 };
        let round = rotation_from_vector(&(Vec3::x() * (TAU * 0.25 * (i / 2) as f64)));
        let ends = [i, i + 1].map(|k| Vec3::x() * (k as f64 * length) + round * Vec3::z() * pin);
        let bar = w.bar(&ends[0], &ends[1], &Vec3::y(), length, Some(&own));
        if let Some(before) = pieces.last() {
            w.clamp(Some(before.nodes[1]), bar.first, &ends[0]);
        }
        pieces.push(Piece {
            nodes: [bar.first, bar.last],
            ends,
        });
    }
    pieces
}

fn drive(w: &mut Workshop, pieces: &[Piece]) -> Drive {
    let drive = w.random.pick(&[
        Drive::OnSprings,
        Drive::OnSprings,
        Drive::Hinged,
        Drive::Universal,
    ]);
    let first = pieces[0].nodes[0];
    let origin = Vec3::zeros();
    let driven = match drive {
        Drive::OnSprings => {
            w.note("driven on its springs");
            return drive;
        }
        Drive::Hinged => {
            w.note("hinged at the motor");
            w.joint(JointKind::Revolute, None, first, &origin, &Vec3::x())
        }
        Drive::Universal => {
            w.note("motor by a universal joint");
            let motor = w.ball(0.5, &origin, 0.1);
            let axes = [&Vec3::y(), &Vec3::z()];
            w.joint_with_axes(JointKind::Universal, Some(motor), first, &origin, axes);
            w.joint(JointKind::Revolute, None, motor, &origin, &Vec3::x())
        }
    };
    w.prescribe(driven, Rotation1, w.rate(), None);
    drive
}

/// Bearing springs on the axis, which add up to this stiffness across.
fn bearings(w: &mut Workshop, pieces: &[Piece], drive: Drive, stiffness: f64) {
    let on_axis = |piece: &&Piece| piece.ends[0].yz().norm() < 1e-9;
    let mut places: Vec<(usize, Vec3)> = Vec::new();
    if drive == Drive::OnSprings {
        places.push((pieces[0].nodes[0], pieces[0].ends[0]));
    }
    if pieces.len() > 3 {
        let inner = pieces.iter().skip(1).filter(on_axis);
        places.extend(inner.map(|piece| (piece.nodes[0], piece.ends[0])));
    }
    let last = &pieces[pieces.len() - 1];
    // A bearing that is off the axis, on a crank's end, holds it by a journal.
    places.push((last.nodes[1], Vec3::new(1.0, 0.0, 0.0)));
    let each = stiffness / places.len() as f64;
    let uneven = w.random.between(1.0, 2.0);
    for (i, (node, at)) in places.iter().enumerate() {
        let axes = [&Vec3::x(), &Vec3::y()];
        let mount = w.joint_with_axes(JointKind::Free, None, *node, at, axes);
        w.spring(mount, Displacement2, each, 0.0);
        w.spring(mount, Displacement3, each * uneven, 0.0);
        if i == 0 && drive == Drive::OnSprings {
            w.spring(mount, Displacement1, stiffness, 0.0);
            w.prescribe(mount, Rotation1, w.rate(), None);
        }
    }
}
