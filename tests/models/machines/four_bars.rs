//! Four-bars, planar and spatial, with rigid or flexible links, whose crank turns or swings.

use super::waves::Wave;
use super::workshop::{Bar, FREQUENCY, Flexible, Vec3, Workshop};
use periodyn::elements::{Coordinate::*, JointKind};
use std::f64::consts::PI;

/// Least sine of the angle between coupler and rocker: 25 degrees, the engineer's rule is 40.
const LEAST_TRANSMISSION: f64 = 0.42;

/// Links and their places in a planar four-bar with a ground of length 1 along x.
struct Planar {
    crank: f64,
    coupler: f64,
    rocker: f64,
    angle: f64,
}

impl Planar {
    /// Crank pin and rocker pin for a crank angle, in the x-z plane; none where it cannot be closed
    /// or is transmitted badly.
    fn pins(&self, angle: f64) -> Option<[Vec3; 2]> {
        let pin = Vec3::new(self.crank * angle.cos(), 0.0, self.crank * angle.sin());
        let ground = Vec3::x();
        let diagonal = ground - pin;
        let d = diagonal.norm();
        let (b, c) = (self.coupler, self.rocker);
        let cosine = (b * b + c * c - d * d) / (2.0 * b * c);
        if (1.0 - cosine * cosine).max(0.0).sqrt() < LEAST_TRANSMISSION || cosine.abs() >= 1.0 {
            return None;
        }
        let along = (b * b - c * c + d * d) / (2.0 * d);
        let height = (b * b - along * along).max(0.0).sqrt();
        let e = diagonal / d;
        let other = pin + e * along + Vec3::new(-e.z, 0.0, e.x) * height;
        Some([pin, other])
    }

    fn works(&self, swing: f64) -> bool {
        const STEPS: usize = 72;
        (0..=STEPS).all(|k| {
            let part = 2.0 * k as f64 / STEPS as f64 - 1.0;
            self.pins(self.angle + part * swing).is_some()
        })
    }
}

/// How the crank moves: right round, or to and fro by so much.
fn drive(w: &mut Workshop) -> Option<f64> {
    w.random.percent(45).then(|| w.random.between(0.05, 0.5))
}

/// Part by which positions are checked beyond the swing.
const BEYOND: f64 = 1.1;

pub fn planar(w: &mut Workshop) {
    let swing = drive(w);
    let bars = loop {
        let bars = Planar {
            crank: if swing.is_some() {
                w.random.between(0.2, 1.0)
            } else {
                w.random.between(0.1, 0.4)
            },
            coupler: w.random.between(0.5, 1.3),
            rocker: w.random.between(0.4, 1.3),
            angle: PI * w.random.number(),
        };
        if bars.works(swing.map_or(PI, |swing| BEYOND * swing)) {
            break bars;
        }
    };
    let Planar {
        crank,
        coupler,
        rocker,
        angle,
    } = bars;
    w.note(format!(
        "crank {crank:.2}, coupler {coupler:.2}, rocker {rocker:.2}"
    ));
    let [pin, other] = bars.pins(angle).unwrap();
    let points = [Vec3::zeros(), pin, other, Vec3::x()];
    let longest = crank.max(coupler).max(rocker);
    let held = [true, false, false];
    let flexible = link_material(w, [crank, coupler, rocker], held, swing);
    let bars = links(w, &points, &Vec3::y(), flexible.as_ref());
    let axis = -Vec3::y();
    let motor = w.joint(JointKind::Revolute, None, bars[0].first, &points[0], &axis);
    w.joint(
        JointKind::Revolute,
        Some(bars[0].last),
        bars[1].first,
        &pin,
        &axis,
    );
    let kind = w.random.pick(&[JointKind::Revolute, JointKind::Spherical]);
    w.joint(kind, Some(bars[1].last), bars[2].first, &other, &axis);
    let pivot = w.joint(JointKind::Revolute, None, bars[2].last, &points[3], &axis);
    run(w, motor, pivot, &bars, swing, flexible.as_ref(), longest);
}

/// How much stiffer the crank is than the other links.
const CRANK: f64 = 3.0;

/// Bending stiffness that gives links of these lengths the first frequency wanted: the longest on
/// two hinges, and those that hinges or a motor hold at their root with half the coupler at their
/// end.
fn bending(lengths: [f64; 3], held: [bool; 3]) -> f64 {
    let longest = lengths.iter().copied().fold(0.0, f64::max);
    let mut compliance = longest.powi(4) / PI.powi(4);
    for (i, &length) in lengths.iter().enumerate().filter(|(i, _)| held[*i]) {
        let stiffer: f64 = if i == 0 { CRANK } else { 1.0 };
        let moving = 0.24 * length * stiffer.sqrt() + 0.5 * lengths[1];
        compliance = compliance.max(length.powi(3) * moving / (3.0 * stiffer));
    }
    FREQUENCY * FREQUENCY * compliance
}

/// Flexible links, and a speed that they can run at: bending by inertia stays below a quarter of
/// their length.
fn link_material(
    w: &mut Workshop,
    lengths: [f64; 3],
    held: [bool; 3],
    swing: Option<f64>,
) -> Option<Flexible> {
    if w.random.percent(35) {
        w.note("rigid");
        return None;
    }
    let longest = lengths.iter().copied().fold(0.0, f64::max);
    let travel = lengths[0] * swing.unwrap_or(1.0);
    let most = (0.25 * longest / travel).sqrt().min(0.4);
    w.speed = w.random.decades(0.02, most);
    Some(w.flexible(bending(lengths, held)))
}

fn links(
    w: &mut Workshop,
    points: &[Vec3; 4],
    across: &Vec3,
    flexible: Option<&Flexible>,
) -> [Bar; 3] {
    std::array::from_fn(|i| {
        let (start, end) = (&points[i], &points[i + 1]);
        let length = (end - start).norm();
        let stiffer: f64 = if i == 0 { CRANK } else { 1.0 };
        let own = flexible.map(|f| Flexible {
            bending: f.bending * stiffer,
            ..*f
        });
        let along = (end - start) / length;
        // Any direction across the bar.
        let across = if along.cross(across).norm() > 0.1 {
            *across
        } else {
            Vec3::new(0.3, 0.5, 0.8)
        };
        w.bar(start, end, &across, length * stiffer.sqrt(), own.as_ref())
    })
}

/// Drives and loads a four-bar.
fn run(
    w: &mut Workshop,
    motor: usize,
    pivot: usize,
    bars: &[Bar; 3],
    swing: Option<f64>,
    flexible: Option<&Flexible>,
    longest: f64,
) {
    let rate = w.rate();
    match swing {
        Some(swing) => {
            let wave = Wave::harmonics(&mut w.random, 1);
            w.note(format!("swings by {swing:.2}"));
            w.prescribe(motor, Rotation1, 0.0, Some((&wave, swing)));
        }
        None if w.random.percent(30) => {
            let (wave, part) = (
                Wave::harmonics(&mut w.random, 1),
                w.random.between(0.02, 0.15),
            );
            w.note("turns unevenly");
            w.prescribe(motor, Rotation1, rate, Some((&wave, part)));
        }
        None => {
            w.note("turns");
            w.prescribe(motor, Rotation1, rate, None);
        }
    }
    if w.random.percent(50) {
        let g = w.random.decades(1e-3, 0.3) * FREQUENCY * FREQUENCY;
        w.gravity(&Vec3::new(
            0.0,
            0.0,
            -if flexible.is_some() { 0.1 * g } else { g },
        ));
    }
    if w.random.percent(50) {
        let stiffness = w.random.decades(0.01, 1.0) * FREQUENCY * FREQUENCY / 10.0;
        // The coupler's force stays below 0.3 of what buckles it.
        let stiffness = flexible.map_or(stiffness, |f| stiffness.min(0.3 * f.bending / longest));
        w.spring_damper(pivot, Rotation1, stiffness, w.damper(stiffness), 0.0);
    }
    if w.random.percent(40) {
        let wave = w.wave();
        let most = flexible.map_or(FREQUENCY * FREQUENCY / 10.0, |f| {
            f.bending / (longest * longest)
        });
        let size = w.random.decades(1e-3, 0.5) * most / wave.response(w.speed, w.ratio);
        let direction = Vec3::new(w.random.number(), 0.0, 1.0);
        w.note("force on the rocker");
        w.force(bars[2].first, false, &direction, 0.0, (&wave, size));
    }
}

/// A spatial four-bar: the crank turns about `crank_axis` at the origin, the rocker about
/// `rocker_axis` at `pivot`.
struct Spatial {
    pivot: Vec3,
    crank_axis: Vec3,
    rocker_axis: Vec3,
    /// From the hinges to the pins, at the crank angle zero and in the reference configuration.
    crank: Vec3,
    rocker: Vec3,
}

impl Spatial {
    /// Whether it closes with margin for crank angles up to `swing`, the rocker is moved well and
    /// the coupler does not line up with the rocker's hinge, which the universal joint's first arm
    /// is along.
    fn works(&self, swing: f64) -> bool {
        let length2 = (self.pivot + self.rocker - self.crank).norm_squared();
        let across = self.rocker_axis.cross(&self.rocker);
        (-36..=36).all(|k| {
            let turn = self.crank_axis * (swing * f64::from(k) / 36.0);
            let pin = periodyn::motion::rotation_from_vector(&turn) * self.crank;
            // |pivot + cos θ rocker + sin θ across − pin|² is the coupler's length squared.
            let v = self.pivot - pin;
            let (e, f) = (2.0 * v.dot(&self.rocker), 2.0 * v.dot(&across));
            let g = length2 - v.norm_squared() - self.rocker.norm_squared();
            let reach = e.hypot(f);
            let size = self.rocker.norm() * length2.sqrt();
            let swing_of_rocker = (reach * reach - g * g).max(0.0).sqrt() / (2.0 * size);
            let start = f.atan2(e);
            // The branch of the reference configuration: that at angle zero when the crank is.
            let reference = 2.0 * (self.pivot - self.crank).dot(&across);
            let theta = start - reference.signum() * (g / reach).clamp(-1.0, 1.0).acos();
            let other = self.pivot + self.rocker * theta.cos() + across * theta.sin();
            let coupler = (other - pin).normalize();
            g.abs() < reach
                && swing_of_rocker > LEAST_TRANSMISSION
                && coupler.cross(&self.rocker_axis).norm() > LEAST_TRANSMISSION
        })
    }
}

pub fn spatial(w: &mut Workshop) {
    let swing = drive(w);
    let made = loop {
        let crank_axis = (Vec3::z() + 0.6 * w.random.vector()).normalize();
        let rocker_axis = (Vec3::x() + 0.8 * w.random.vector()).normalize();
        let across = |axis: &Vec3, v: Vec3| (v - axis * axis.dot(&v)).normalize();
        let one = across(&crank_axis, w.random.vector());
        let two = across(&rocker_axis, w.random.vector());
        let crank = if swing.is_some() {
            w.random.between(0.2, 0.8)
        } else {
            w.random.between(0.1, 0.4)
        };
        let made = Spatial {
            pivot: Vec3::x() + 0.4 * w.random.vector(),
            crank_axis,
            rocker_axis,
            crank: one * crank,
            rocker: two * w.random.between(0.5, 1.2),
        };
        let coupler = (made.pivot + made.rocker - made.crank).norm();
        if (0.5..1.6).contains(&coupler) && made.works(swing.map_or(PI, |swing| BEYOND * swing)) {
            break made;
        }
    };
    let Spatial {
        pivot,
        crank_axis,
        rocker_axis,
        crank,
        rocker,
    } = made;
    let points = [Vec3::zeros(), crank, pivot + rocker, pivot];
    let coupler = (points[2] - points[1]).norm();
    w.note(format!(
        "crank {:.2}, coupler {coupler:.2}, rocker {:.2}",
        crank.norm(),
        rocker.norm()
    ));
    let longest = coupler.max(rocker.norm()).max(crank.norm());
    let lengths = [crank.norm(), coupler, rocker.norm()];
    let flexible = link_material(w, lengths, [true, false, true], swing);
    let bars = links(w, &points, &Vec3::y(), flexible.as_ref());
    let motor = w.joint(
        JointKind::Revolute,
        None,
        bars[0].first,
        &points[0],
        &crank_axis,
    );
    w.joint(
        JointKind::Spherical,
        Some(bars[0].last),
        bars[1].first,
        &points[1],
        &Vec3::z(),
    );
    let second = rocker_axis.cross(&(points[2] - points[1]));
    let axes = [&rocker_axis, &second];
    w.joint_with_axes(
        JointKind::Universal,
        Some(bars[2].first),
        bars[1].last,
        &points[2],
        axes,
    );
    let pivot = w.joint(
        JointKind::Revolute,
        None,
        bars[2].last,
        &points[3],
        &rocker_axis,
    );
    run(w, motor, pivot, &bars, swing, flexible.as_ref(), longest);
}
