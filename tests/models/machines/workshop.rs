//! What machines are built with. All is given in units in which sizes and masses are about 1, with
//! the third axis up, and written down in the machine's own units and place.

use super::Machine;
use super::waves::Wave;
use crate::common::{Random, Setting};
use nalgebra::{Matrix3, Vector3};
use periodyn::elements::{
    Coordinate, CoordinateLaw, CoordinateState, Effort, IsotropicShell, JointKind, LoadFrame,
    ShellLoadPlace,
};
use periodyn::model::{
    JointCoordinate, Model, SectionInput, ShellLoadDefinition, ShellMesh, ShellPatch,
    ShellPlacement, Signal, SpringDefinition,
};
use periodyn::motion::{Motion, rotation_from_vector};
use std::f64::consts::TAU;
use std::sync::Arc;

pub type Vec3 = Vector3<f64>;

/// First natural angular frequency that stiffnesses are made for.
pub const FREQUENCY: f64 = 10.0;

/// Parts of a machine that damp.
#[derive(Clone, Copy, PartialEq)]
pub enum Damped {
    /// Beams, in all strains, and joints.
    AllStrains,
    /// Beams in bending and torsion, and joints.
    Bending,
    /// Joints alone.
    Joints,
}

/// A flexible bar: first bending stiffness, the other relative to it, axial stiffness times length
/// squared over the first, and the mesh.
#[derive(Clone, Copy)]
pub struct Flexible {
    pub bending: f64,
    pub other: f64,
    pub slenderness: f64,
    pub elements: usize,
    pub degree: usize,
}

/// A bar from one point to another; its end nodes are the same if it is rigid.
#[derive(Clone, Copy)]
pub struct Bar {
    pub first: usize,
    pub last: usize,
}

pub struct Workshop {
    pub random: Random,
    set: Setting,
    model: Model,
    /// Frequency of the excitation over the first natural frequency.
    pub speed: f64,
    /// Damping ratio of the first mode.
    pub ratio: f64,
    pub damped: Damped,
    notes: Vec<String>,
}

fn is_rotation(coordinate: Coordinate) -> bool {
    use Coordinate::{Rotation1, Rotation2, Rotation3};
    matches!(coordinate, Rotation1 | Rotation2 | Rotation3)
}

impl Workshop {
    pub fn new(mut random: Random) -> Self {
        let mut set = Setting::default();
        if random.percent(50) {
            let turn = random.vector() * 3.0;
            set.place = Motion::new(rotation_from_vector(&turn), random.vector() * 5.0);
        }
        if random.percent(50) {
            set.length = random.decades(1e-2, 1e3);
            set.mass = random.decades(1e-3, 1e3);
            set.time = random.decades(1e-2, 1e2);
        }
        set.place.position *= set.length;
        let ratio = match random.below(16) {
            0 => 0.0,
            _ => random.decades(1e-3, 0.1),
        };
        let all = random.percent(65);
        let damped = if all {
            Damped::AllStrains
        } else {
            Damped::Bending
        };
        Workshop {
            speed: random.decades(0.02, 3.0),
            random,
            set,
            model: Model::new(),
            ratio,
            damped,
            notes: Vec::new(),
        }
    }

    /// The machine, whose period is that of the excitation.
    pub fn finish(self) -> Machine {
        let period = TAU / (self.speed * FREQUENCY) * self.set.time;
        let damped = match self.damped {
            Damped::AllStrains => "all",
            Damped::Bending => "bending",
            Damped::Joints => "joints",
        };
        let what = format!(
            "{}; speed {:.3}, damping {:.4} ({damped})",
            self.notes.join(", "),
            self.speed,
            self.ratio
        );
        Machine {
            model: self.model,
            period,
            what,
            undamped: self.ratio == 0.0,
        }
    }

    pub fn note(&mut self, text: impl Into<String>) {
        self.notes.push(text.into());
    }

    /// Angular frequency of the excitation.
    pub fn rate(&self) -> f64 {
        self.speed * FREQUENCY
    }

    /// Amplitude of the response, over the size of the machine.
    pub fn target(&mut self) -> f64 {
        self.random.decades(1e-4, 0.5)
    }

    /// Damping that goes with a stiffness.
    pub fn damper(&self, stiffness: f64) -> f64 {
        2.0 * self.ratio / FREQUENCY * stiffness
    }

    pub fn wave(&mut self) -> Wave {
        let wave = Wave::random(&mut self.random);
        self.note(wave.what.clone());
        wave
    }

    /// A wave to move something by.
    pub fn motion(&mut self) -> Wave {
        let wave = Wave::random_motion(&mut self.random);
        self.note(wave.what.clone());
        wave
    }

    /// Leaves beams undamped in some cases, where joints damp.
    pub fn damped_by_joints(&mut self) {
        if self.random.percent(30) {
            self.damped = Damped::Joints;
        }
    }

    pub fn gravity(&mut self, acceleration: &Vec3) {
        let g = self.set.turned(acceleration) * self.set.length / self.set.time.powi(2);
        self.model
            .set_gravity([g.x, g.y, g.z].map(|g| Signal::constant(g).unwrap()));
    }

    /// Bending stiffness, and a mesh; two to six elements to the bar.
    pub fn flexible(&mut self, bending: f64) -> Flexible {
        let (elements, degree) = self.random.pick(&[
            (4, 1),
            (8, 1),
            (2, 2),
            (4, 2),
            (6, 2),
            (2, 3),
            (3, 3),
            (4, 3),
            (2, 4),
        ]);
        let slenderness = self.random.decades(1e2, 1e9);
        self.note(format!(
            "{elements} elements of degree {degree}, slenderness {slenderness:.1e}"
        ));
        Flexible {
            bending,
            other: 1.0,
            slenderness,
            elements,
            degree,
        }
    }

    fn section(&self, length: f64, mass: f64, flexible: &Flexible) -> SectionInput {
        let Flexible {
            bending,
            other,
            slenderness,
            ..
        } = *flexible;
        let axial = slenderness * bending / (length * length);
        let shear = 0.35 * axial;
        let torsion = 0.4 * bending * (1.0 + other.min(3.0));
        let stiffness = [axial, shear, shear, torsion, bending, other * bending];
        let line = mass / length;
        let gyration2 = length * length / slenderness;
        let moments = [1.0 + other, 1.0, other].map(|factor| factor * gyration2 * line);
        let mass = [line, moments[0], moments[1], moments[2]];
        let mut section = SectionInput::diagonal(&stiffness, &mass).unwrap();
        section
            .damp_proportionally(2.0 * self.ratio / FREQUENCY)
            .unwrap();
        let undamped = match self.damped {
            Damped::AllStrains => 0,
            Damped::Bending => 3,
            Damped::Joints => 6,
        };
        for i in 0..undamped {
            section.damping[(i, i)] = 0.0;
        }
        section
    }

    /// A straight bar, rigid and slender if it is not flexible; the first bending stiffness is
    /// against moments about `axis_2`.
    pub fn bar(
        &mut self,
        start: &Vec3,
        end: &Vec3,
        axis_2: &Vec3,
        mass: f64,
        flexible: Option<&Flexible>,
    ) -> Bar {
        let length = (end - start).norm();
        let Some(flexible) = flexible else {
            let along = (end - start) / length;
            let across = Matrix3::identity() - along * along.transpose();
            let thickness = 0.05 * length;
            let inertia = across * (mass * length * length / 12.0)
                + Matrix3::identity() * (0.5 * mass * thickness * thickness);
            let node = self.body(mass, &(0.5 * (start + end)), &inertia);
            return Bar {
                first: node,
                last: node,
            };
        };
        let section = self.set.section(&self.section(length, mass, flexible));
        let (start, end) = (self.set.point(start), self.set.point(end));
        let axis_2 = self.set.turned(axis_2);
        let (elements, degree) = (flexible.elements, flexible.degree);
        let beam = self
            .model
            .add_straight_beam(&start, &end, &axis_2, &section, elements, degree)
            .unwrap();
        Bar {
            first: beam.first_node,
            last: beam.last_node,
        }
    }

    fn inertia(&self, inertia: &Matrix3<f64>) -> Matrix3<f64> {
        let turn = self.set.place.rotation;
        turn * inertia * turn.transpose() * (self.set.mass * self.set.length.powi(2))
    }

    pub fn body(&mut self, mass: f64, centre: &Vec3, inertia: &Matrix3<f64>) -> usize {
        let (mass, centre, inertia) = (
            mass * self.set.mass,
            self.set.point(centre),
            self.inertia(inertia),
        );
        self.model.add_rigid_body(mass, &centre, &inertia).unwrap()
    }

    /// A compact body: a ball of this radius.
    pub fn ball(&mut self, mass: f64, centre: &Vec3, radius: f64) -> usize {
        let inertia = Matrix3::identity() * (0.4 * mass * radius * radius);
        self.body(mass, centre, &inertia)
    }

    /// Fixes a mass to a node.
    pub fn mass(&mut self, node: usize, mass: f64, centre: &Vec3, inertia: &Matrix3<f64>) {
        let (mass, centre, inertia) = (
            mass * self.set.mass,
            self.set.point(centre),
            self.inertia(inertia),
        );
        self.model.add_mass(node, mass, &centre, &inertia).unwrap();
    }

    /// A node without mass.
    pub fn node(&mut self, at: &Vec3) -> usize {
        let motion = Motion::new(Matrix3::identity(), self.set.point(at));
        self.model.add_node(&motion).unwrap()
    }

    /// A joint whose axis 3 is along `axis`.
    pub fn joint(
        &mut self,
        kind: JointKind,
        first: Option<usize>,
        second: usize,
        point: &Vec3,
        axis: &Vec3,
    ) -> usize {
        let (point, axis) = (self.set.point(point), self.set.turned(axis));
        let frame = Model::frame_at("axis", &point, &axis).unwrap();
        self.model
            .add_joint(kind, first, Some(second), &frame, &frame)
            .unwrap()
    }

    /// A joint with these axes 1 and 2 or, if they are not perpendicular, the second made so.
    pub fn joint_with_axes(
        &mut self,
        kind: JointKind,
        first: Option<usize>,
        second: usize,
        point: &Vec3,
        axes: [&Vec3; 2],
    ) -> usize {
        let one = self.set.turned(axes[0]).normalize();
        let three = one.cross(&self.set.turned(axes[1])).normalize();
        let rotation = Matrix3::from_columns(&[one, three.cross(&one), three]);
        let frame = Motion::new(rotation, self.set.point(point));
        self.model
            .add_joint(kind, first, Some(second), &frame, &frame)
            .unwrap()
    }

    pub fn clamp(&mut self, first: Option<usize>, second: usize, point: &Vec3) {
        self.joint(JointKind::Rigid, first, second, point, &Vec3::z());
    }

    /// Units of a coordinate and of the effort on it.
    fn units(&self, coordinate: Coordinate) -> (f64, f64) {
        if is_rotation(coordinate) {
            (1.0, self.set.moment())
        } else {
            (self.set.length, self.set.force())
        }
    }

    /// A spring with the damper that goes with it.
    pub fn spring(&mut self, joint: usize, coordinate: Coordinate, stiffness: f64, rest: f64) {
        let damping = self.damper(stiffness);
        self.spring_damper(joint, coordinate, stiffness, damping, rest);
    }

    pub fn spring_damper(
        &mut self,
        joint: usize,
        coordinate: Coordinate,
        stiffness: f64,
        damping: f64,
        rest: f64,
    ) {
        let (unit, effort) = self.units(coordinate);
        self.model
            .add_spring_damper(SpringDefinition {
                at: JointCoordinate { joint, coordinate },
                stiffness: stiffness * effort / unit,
                damping: damping * effort / unit * self.set.time,
                rest: rest * unit,
            })
            .unwrap();
    }

    /// A spring of which `cubic` is the third coefficient, with the damper that goes with the
    /// first.
    pub fn cubic_spring(
        &mut self,
        joint: usize,
        coordinate: Coordinate,
        stiffness: f64,
        cubic: f64,
    ) {
        let (unit, effort) = self.units(coordinate);
        let damping = self.damper(stiffness) * effort / unit * self.set.time;
        let k = [
            stiffness * effort / unit,
            0.0,
            cubic * effort / unit.powi(3),
        ];
        let at = JointCoordinate { joint, coordinate };
        self.model
            .add_polynomial_spring_damper(at, &k, &[damping], 0.0)
            .unwrap();
    }

    /// A user's law of effort by coordinate and rate, which gives its derivatives or not.
    pub fn law(
        &mut self,
        joint: usize,
        coordinate: Coordinate,
        gives_derivatives: bool,
        law: impl Fn(f64, f64) -> [f64; 3] + Send + Sync + 'static,
    ) {
        let ((unit, effort), time) = (self.units(coordinate), self.set.time);
        let function = move |state: &CoordinateState| {
            let [value, by_coordinate, by_rate] = law(state.value / unit, state.rate / unit * time);
            Ok(Effort {
                value: value * effort,
                by_coordinate: by_coordinate * effort / unit,
                by_rate: by_rate * effort / unit * time,
            })
        };
        let law = CoordinateLaw {
            function: Arc::new(function),
            gives_derivatives,
        };
        let at = JointCoordinate { joint, coordinate };
        self.model.add_coordinate_law(at, law).unwrap();
    }

    /// Prescribes `mean + rate t + amplitude × wave`.
    pub fn prescribe(
        &mut self,
        joint: usize,
        coordinate: Coordinate,
        rate: f64,
        wave: Option<(&Wave, f64)>,
    ) {
        let unit = self.units(coordinate).0;
        let rate = rate * unit / self.set.time;
        let signal = match wave {
            Some((wave, amplitude)) => wave.signal(0.0, rate, amplitude * unit),
            None => Signal::harmonics(0.0, rate, &[], &[]).unwrap(),
        };
        let at = JointCoordinate { joint, coordinate };
        self.model.prescribe(at, &signal).unwrap();
    }

    /// An effort on a coordinate: `mean + amplitude × wave`.
    pub fn actuator(
        &mut self,
        joint: usize,
        coordinate: Coordinate,
        mean: f64,
        wave: (&Wave, f64),
    ) {
        let effort = self.units(coordinate).1;
        let signal = wave.0.signal(mean * effort, 0.0, wave.1 * effort);
        let at = JointCoordinate { joint, coordinate };
        self.model.add_actuator(at, &signal).unwrap();
    }

    /// A force on a node, of a constant direction in space or in the node's axes:
    /// `mean + amplitude × wave`.
    pub fn force(
        &mut self,
        node: usize,
        follows: bool,
        direction: &Vec3,
        mean: f64,
        wave: (&Wave, f64),
    ) {
        let unit = self.set.force();
        let direction = self.set.turned(&direction.normalize());
        let (frame, direction) = if follows {
            let own = self.model.node(node).unwrap().rotation;
            (LoadFrame::Follower, own.transpose() * direction)
        } else {
            (LoadFrame::Space, direction)
        };
        let component = |i: usize| {
            let part = *direction.as_slice().get(i)? * unit;
            // Rounding of the axes is no load.
            (part.abs() > 1e-12 * unit).then(|| wave.0.signal(mean * part, 0.0, wave.1 * part))
        };
        self.model
            .add_load(node, frame, std::array::from_fn(component))
            .unwrap();
    }
    /// A patch of shells over the unit square.
    pub fn shell(
        &mut self,
        surface: impl Fn([f64; 2]) -> Vec3,
        mesh: &ShellMesh,
        section: &IsotropicShell,
    ) -> ShellPatch {
        let set = self.set;
        let section = IsotropicShell {
            thickness: section.thickness * set.length,
            young: section.young * set.force() / set.length.powi(2),
            density: section.density * set.mass / set.length.powi(3),
            damping_time: section.damping_time * set.time,
            ..*section
        };
        let surface = |at| Ok(set.point(&surface(at)));
        let placement = ShellPlacement::default();
        let section = section.section().unwrap();
        self.model
            .add_shell_patch(surface, mesh, &section, &placement)
            .unwrap()
    }

    /// A force per area on all of a patch, along the third axis or, if it follows, the normal:
    /// `amplitude × wave`.
    pub fn pressure(&mut self, patch: &ShellPatch, follows: bool, (wave, size): (&Wave, f64)) {
        let unit = self.set.force() / self.set.length.powi(2);
        let (frame, direction) = if follows {
            (LoadFrame::Follower, Vec3::z())
        } else {
            (LoadFrame::Space, self.set.turned(&Vec3::z()))
        };
        let component = |i: usize| {
            let part = *direction.as_slice().get(i)? * size * unit;
            Some(wave.signal(0.0, 0.0, part))
        };
        self.model
            .add_shell_load(ShellLoadDefinition {
                first_element: patch.first_element,
                elements: patch.element_count(),
                place: ShellLoadPlace::Surface,
                frame,
                components: std::array::from_fn(component),
            })
            .unwrap();
    }
}
