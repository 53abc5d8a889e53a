//! Blades and rotors of two to four blades: clamped or on flap and lag hinges, with pitch, on a
//! driven hub, which may stand on a tower.

use super::waves::Wave;
use super::workshop::{Bar, FREQUENCY, Flexible, Vec3, Workshop};
use nalgebra::Matrix3;
use periodyn::elements::{Coordinate::*, JointKind};
use periodyn::motion::rotation_from_vector;
use std::f64::consts::TAU;

/// How the blades of a rotor are made and loaded: of radius and mass 1.
struct Blades {
    root: Root,
    /// Place of the hinges or clamps.
    offset: f64,
    flexible: Option<Flexible>,
    /// Frequencies of hinge springs, and damping ratios of hinge dampers against the rate of
    /// rotation.
    springs: [f64; 2],
    dampers: [f64; 2],
    /// Collective and cyclic pitch.
    pitch: Option<[f64; 2]>,
    /// Flap moment at the tip: mean, amplitude and shape.
    lift: [f64; 2],
    drag: f64,
    wave: Wave,
    axis: Vec3,
}

#[derive(Clone, Copy, PartialEq)]
enum Root {
    Clamped,
    Flap,
    FlapAndLag,
}

impl Blades {
    fn draw(w: &mut Workshop, axis: Vec3, small: bool) -> Self {
        let root = w
            .random
            .pick(&[Root::Clamped, Root::Flap, Root::FlapAndLag]);
        let offset = w.random.between(0.03, 0.15);
        let length = 1.0 - offset;
        let flexible = (root == Root::Clamped || w.random.percent(40)).then(|| {
            let stiffer = if root == Root::Clamped {
                1.0
            } else {
                w.random.between(1.0, 5.0)
            };
            let bending = (stiffer * FREQUENCY).powi(2) * length.powi(3) / 12.36;
            let mut flexible = w.flexible(bending);
            flexible.other = w.random.decades(2.0, 30.0);
            flexible.slenderness = flexible.slenderness.max(1e3);
            if small {
                (flexible.elements, flexible.degree) = w.random.pick(&[(2, 2), (3, 2), (2, 3)]);
            }
            flexible
        });
        let sprung = w.random.percent(40);
        let spring = |w: &mut Workshop| {
            if sprung {
                w.random.between(0.1, 1.0)
            } else {
                0.0
            }
        };
        let springs = [spring(w), spring(w)];
        // Aerodynamic damping of flapping is large, that of lagging comes from its damper.
        let dampers = [
            w.ratio.max(0.01) * w.random.between(1.0, 5.0),
            w.ratio.max(0.01),
        ];
        let pitch = w
            .random
            .percent(40)
            .then(|| [w.random.between(-0.1, 0.2), w.random.between(0.0, 0.1)]);
        let wave = w.wave();
        // Restoring moment for a radian: elastic and centrifugal.
        let (elastic, rate) = if root == Root::Clamped {
            (FREQUENCY, w.rate())
        } else {
            (0.0, w.rate())
        };
        let own = (elastic * elastic + rate * rate * (1.0 + 1.5 * offset)).sqrt();
        let ratio = if root == Root::Clamped {
            w.ratio
        } else {
            dampers[0] * rate / own
        };
        let target = w.random.decades(1e-3, 0.2);
        let moment = own * own * length * length / 3.0;
        let amplitude = target * moment / wave.response(rate / own, ratio);
        let mean = w.random.between(0.0, 0.1) * moment;
        let drag = w.random.between(0.0, 0.2) * amplitude;
        let name = match root {
            Root::Clamped => "clamped",
            Root::Flap => "flap hinge",
            Root::FlapAndLag => "flap and lag hinges",
        };
        w.note(format!(
            "{name} at {offset:.2}, {}, {}pitch {pitch:.2?}, lift {target:.1e}",
            if flexible.is_some() {
                "flexible"
            } else {
                "rigid"
            },
            if sprung { "hinge springs, " } else { "" }
        ));
        Blades {
            root,
            offset,
            flexible,
            springs,
            dampers,
            pitch,
            lift: [mean, amplitude],
            drag,
            wave,
            axis,
        }
    }

    /// Adds a blade at this part of a turn.
    fn add(&self, w: &mut Workshop, hub: usize, azimuth: f64) {
        let turn = rotation_from_vector(&(self.axis * (TAU * azimuth)));
        let out = turn * Vec3::x();
        let across = self.axis.cross(&out);
        let (root, tip) = (out * self.offset, out);
        let length = 1.0 - self.offset;
        // Axis 2 of the section lies in the plane of the rotor: bending about it is flapping.
        let blade = w.bar(&root, &tip, &across, length, self.flexible.as_ref());
        // About this axis a positive turn flaps along the axis of the rotor.
        let flap = -across;
        let mut carrier = Some(hub);
        if let Some([collective, cyclic]) = self.pitch {
            let cuff = w.ball(0.02, &root, 0.05);
            let bearing = if self.root == Root::Clamped {
                w.joint(JointKind::Revolute, carrier, cuff, &root, &out)
            } else {
                self.hinge(w, hub, cuff, &root, [&flap, &self.axis]);
                w.joint(JointKind::Revolute, Some(cuff), blade.first, &root, &out)
            };
            let wave = Wave::swash(collective, cyclic, azimuth);
            w.prescribe(bearing, Rotation1, 0.0, Some((&wave, 1.0)));
            if self.root == Root::Clamped {
                carrier = Some(cuff);
                w.clamp(carrier, blade.first, &root);
            }
        } else if self.root == Root::Clamped {
            w.clamp(carrier, blade.first, &root);
        } else {
            self.hinge(w, hub, blade.first, &root, [&flap, &self.axis]);
        }
        self.load(w, &blade, azimuth, &across);
    }

    fn hinge(&self, w: &mut Workshop, hub: usize, blade: usize, root: &Vec3, axes: [&Vec3; 2]) {
        let length = 1.0 - self.offset;
        let inertia = length.powi(3) / 3.0;
        let rate = w.rate();
        let (kind, coordinates): (_, &[_]) = match self.root {
            Root::FlapAndLag => (JointKind::Universal, &[Rotation1, Rotation2]),
            _ => (JointKind::Revolute, &[Rotation1]),
        };
        let joint = match kind {
            JointKind::Revolute => w.joint(kind, Some(hub), blade, root, axes[0]),
            _ => w.joint_with_axes(kind, Some(hub), blade, root, axes),
        };
        for (i, &coordinate) in coordinates.iter().enumerate() {
            let stiffness = inertia * (self.springs[i] * rate).powi(2);
            let damping = 2.0 * self.dampers[i] * inertia * rate;
            w.spring_damper(joint, coordinate, stiffness, damping, 0.0);
        }
    }

    fn load(&self, w: &mut Workshop, blade: &Bar, azimuth: f64, across: &Vec3) {
        let wave = self.wave.later(azimuth);
        // A rigid blade's node is its centre.
        let arm = match self.flexible {
            Some(_) => 1.0 - self.offset,
            None => 0.5 * (1.0 - self.offset),
        };
        let [mean, amplitude] = self.lift.map(|moment| moment / arm);
        let axis = self.axis;
        w.force(blade.last, true, &axis, mean, (&wave, amplitude));
        if self.drag > 0.0 {
            w.force(blade.last, true, &-across, 0.0, (&wave, self.drag / arm));
        }
    }

    /// Gravity that neither lets blades droop much without rotation, if they are clamped, nor in
    /// it.
    fn gravity(&self, w: &mut Workshop) {
        let rate2 = w.rate().powi(2);
        let sag = w.random.decades(1e-3, 0.1);
        let stiffness = match self.root {
            Root::Clamped => (FREQUENCY * FREQUENCY + rate2).min(3.0 * FREQUENCY * FREQUENCY),
            _ => rate2,
        };
        w.note(format!("sag {sag:.1e}"));
        w.gravity(&Vec3::new(0.0, 0.0, -sag * stiffness));
    }
}

/// Of a helicopter or of a wind turbine.
fn axis(w: &mut Workshop) -> Vec3 {
    let level = w.random.percent(50);
    w.note(if level {
        "level shaft"
    } else {
        "upright shaft"
    });
    if level { Vec3::y() } else { Vec3::z() }
}

pub fn blade(w: &mut Workshop) {
    let axis = axis(w);
    let blades = Blades::draw(w, axis, false);
    let hub = w.node(&Vec3::zeros());
    let shaft = w.joint(JointKind::Revolute, None, hub, &Vec3::zeros(), &axis);
    w.prescribe(shaft, Rotation1, w.rate(), None);
    blades.add(w, hub, 0.0);
    if w.random.percent(70) {
        blades.gravity(w);
    }
}

pub fn rotor(w: &mut Workshop) {
    let axis = axis(w);
    let count = 2 + w.random.below(3);
    w.note(format!("{count} blades"));
    let blades = Blades::draw(w, axis, true);
    let inertia = Matrix3::identity() * 0.02;
    let hub = w.body(1.0, &Vec3::zeros(), &inertia);
    let nacelle = tower(w, count as f64 + 1.0);
    let shaft = w.joint(JointKind::Revolute, nacelle, hub, &Vec3::zeros(), &axis);
    w.prescribe(shaft, Rotation1, w.rate(), None);
    for i in 0..count {
        blades.add(w, hub, i as f64 / count as f64);
    }
    if w.random.percent(70) {
        blades.gravity(w);
    }
}

/// A nacelle on a tower, or on springs in all directions; none where the bearing is on the ground.
fn tower(w: &mut Workshop, carried: f64) -> Option<usize> {
    let kind = w.random.below(4);
    if kind < 2 {
        return None;
    }
    let nacelle = w.ball(2.0, &Vec3::zeros(), 0.3);
    // The tower's frequency over that of the blades; not within 15 % of the rate of rotation, as
    // every manufacturer sees to.
    let frequency = loop {
        let frequency = w.random.decades(0.3, 5.0);
        if (frequency / w.speed).ln().abs() > 0.15 {
            break frequency * FREQUENCY;
        }
    };
    let total = carried + 2.0;
    if kind == 2 {
        w.note(format!("nacelle on springs, {:.2}", frequency / FREQUENCY));
        let axes = [&Vec3::x(), &Vec3::y()];
        let mount = w.joint_with_axes(JointKind::Free, None, nacelle, &Vec3::zeros(), axes);
        let stiffness = total * frequency * frequency;
        let damping = 2.0 * w.ratio.max(5e-3) * total * frequency;
        for coordinate in [Displacement1, Displacement2, Displacement3] {
            w.spring_damper(mount, coordinate, stiffness, damping, 0.0);
        }
        for coordinate in [Rotation1, Rotation2, Rotation3] {
            w.spring_damper(mount, coordinate, 3.0 * stiffness, 3.0 * damping, 0.0);
        }
    } else {
        w.note(format!("tower, {:.2}", frequency / FREQUENCY));
        let height = 1.8;
        let foot = Vec3::new(0.0, 0.0, -height);
        let bending = frequency * frequency * total * f64::powi(height, 3) / 3.0;
        let tower = Flexible {
            bending,
            other: 1.0,
            slenderness: 1e5,
            elements: 2,
            degree: 3,
        };
        let bar = w.bar(&foot, &Vec3::zeros(), &Vec3::y(), 1.0, Some(&tower));
        w.clamp(None, bar.first, &foot);
        w.clamp(Some(bar.last), nacelle, &Vec3::zeros());
    }
    Some(nacelle)
}
