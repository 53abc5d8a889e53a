//! Slider-cranks and a Scotch yoke.

use super::common::times;
use super::jet::{Jet, Point, second_rate};
use super::*;
use periodyn::elements::Coordinate::{Displacement1, Rotation1};

const G: f64 = 9.81;

/// Crank and slider in the plane of x and y: the crank about the origin, the slider along x at the
/// height `offset`.
struct SliderCrank {
    crank: f64,
    rod: f64,
    offset: f64,
    masses: [f64; 3],
    /// Moments of inertia of crank and rod about their centres, which are their middles.
    inertias: [f64; 2],
}

impl SliderCrank {
    /// Crank pin, slider, and angle of the rod, at an angle of the crank.
    fn at(&self, angle: f64) -> (Point, Point, Jet) {
        let theta = Jet::variable(angle);
        let zero = Jet::constant(0.0);
        let (x, y) = (theta.cos() * self.crank, theta.sin() * self.crank);
        let rise = Jet::constant(self.offset) - y;
        let reach = (Jet::constant(self.rod * self.rod) - rise * rise).sqrt();
        let slider = Point::new(x + reach, Jet::constant(self.offset), zero);
        (Point::new(x, y, zero), slider, rise.atan2(reach))
    }

    fn middle(a: &Point, b: &Point) -> Point {
        Point([0, 1, 2].map(|i| (a.0[i] + b.0[i]) * 0.5))
    }

    /// Torque on the crank and force of the guide on the slider across it.
    fn efforts(&self, angle: [f64; 3]) -> (f64, f64) {
        let [angle, rate, acceleration] = angle;
        let (pin, slider, turn) = self.at(angle);
        let origin = Point([Vector3::zeros(); 3]);
        let centres = [
            Self::middle(&origin, &pin),
            Self::middle(&pin, &slider),
            slider,
        ];
        let weight = Vector3::new(0.0, -G, 0.0);
        // Virtual power of inertial forces and weights, for a unit rate of the crank.
        let mut torque = self.inertias[0] * acceleration
            + self.inertias[1] * turn.0[1] * second_rate(&turn, rate, acceleration);
        for (mass, centre) in self.masses.iter().zip(&centres) {
            let inertial = (centre.acceleration(rate, acceleration) - weight) * *mass;
            torque += inertial.dot(&centre.0[1]);
        }
        // The rod, about the crank pin, with the force that it exerts on the slider.
        let push_x = self.masses[2] * slider.acceleration(rate, acceleration).x;
        let along = slider.0[0] - pin.0[0];
        let inertial = (centres[1].acceleration(rate, acceleration) - weight) * self.masses[1];
        let moment = self.inertias[1] * second_rate(&turn, rate, acceleration)
            + (along * 0.5).cross(&inertial).z;
        let push_y = (along.y * push_x - moment) / along.x;
        (torque, self.masses[2] * G - push_y)
    }

    /// The model at a reference angle of the crank; slider, and joints of crank and slider to the
    /// ground.
    fn build(&self, angle: f64, turning: &Turning) -> (Model, [usize; 3]) {
        let (pin, slider, _) = self.at(angle);
        let (pin, slider) = (pin.0[0], slider.0[0]);
        let z = Vector3::z();
        let mut model = Model::new();
        let mut bar = |middle: Vector3<f64>, mass, inertia| {
            let spin = diagonal(0.6 * inertia, 0.7 * inertia, inertia);
            Some(model.add_rigid_body(mass, &middle, &spin).unwrap())
        };
        let crank = bar(pin * 0.5, self.masses[0], self.inertias[0]);
        let rod = bar((pin + slider) * 0.5, self.masses[1], self.inertias[1]);
        let block = bar(slider, self.masses[2], 0.1);
        let m = &mut model;
        let motor = joint(m, JointKind::Revolute, None, crank, &Vector3::zeros(), &z);
        // Play across the plane leaves no constraint redundant.
        joint(m, JointKind::Cylindrical, crank, rod, &pin, &z);
        joint(m, JointKind::Spherical, rod, block, &slider, &z);
        let guide = joint(m, JointKind::Prismatic, None, block, &slider, &Vector3::x());
        prescribe(m, motor, Rotation1, &turning.signal(angle));
        gravity(m, &Vector3::new(0.0, -G, 0.0));
        (model, [block.unwrap(), motor, guide])
    }
}

fn check_slider_crank(offset: f64) {
    let mechanism = SliderCrank {
        crank: 0.3,
        rod: 0.9,
        offset,
        masses: [1.5, 2.0, 0.8],
        inertias: [0.02, 0.15],
    };
    let turning = Turning {
        offset: -0.2,
        omega: 5.0,
        swing: 0.3,
    };
    let reference = 0.7;
    let (model, [block, motor, guide]) = mechanism.build(reference, &turning);
    let solution = solve(&model, turning.period(), 65);
    let times = times(turning.period(), 57);
    let slider = |t: f64| {
        let [angle, rate, acceleration] = turning.at(t);
        let point = mechanism.at(angle).1;
        [
            point.0[0].x,
            point.0[1].x * rate,
            point.acceleration(rate, acceleration).x,
        ]
    };
    let start = mechanism.at(reference).1.0[0].x;
    let exact = |i: usize, from: f64| along(&times, |t| slider(t)[i] - from);
    let of = |joint, quantity| of_joint(&solution, joint, quantity, &times);
    let name = |what: &str| format!("slider-crank, offset {offset}: {what}");

    let place = position(&solution, block, &times);
    assert_near(
        &common::column(&place, 3, 0),
        &exact(0, 0.0),
        &name("slider"),
    );
    let coordinate = of(guide, JointQuantity::Coordinate(Displacement1));
    assert_near(&coordinate, &exact(0, start), &name("displacement"));
    let rate = of(guide, JointQuantity::Rate(Displacement1));
    assert_near(&rate, &exact(1, 0.0), &name("velocity"));
    let acceleration = of(guide, JointQuantity::Acceleration(Displacement1));
    assert_near(&acceleration, &exact(2, 0.0), &name("acceleration"));
    let torque = along(&times, |t| mechanism.efforts(turning.at(t)).0);
    let found = of(motor, JointQuantity::DrivingEffort(Rotation1));
    assert_near(&found, &torque, &name("torque"));
    let hold = along_vectors(&times, |t| {
        Vector3::new(0.0, mechanism.efforts(turning.at(t)).1, 0.0)
    });
    assert_near(
        &reaction(&solution, guide, 0, &times),
        &hold,
        &name("guide"),
    );
    // The force of the rod goes through the middle of the slider.
    let moment = reaction(&solution, guide, 3, &times);
    let size = largest(hold) * mechanism.rod;
    assert_close(
        &moment,
        &vec![0.0; moment.len()],
        size,
        &name("moment of the guide"),
    );
}

#[test]
fn a_slider_crank_moves_and_resists_as_it_must() {
    check_slider_crank(0.0);
}

#[test]
fn an_offset_slider_crank_moves_and_resists_as_it_must() {
    check_slider_crank(0.2);
    check_slider_crank(-0.35);
}

#[test]
fn a_scotch_yoke_is_harmonic() {
    let (radius, omega) = (0.4, 6.0);
    let (yoke_mass, block_mass, inertia) = (2.0, 0.5, 0.03);
    let turning = Turning {
        offset: 0.0,
        omega,
        swing: 0.2,
    };
    let mut model = Model::new();
    let (x, y, z) = (Vector3::x(), Vector3::y(), Vector3::z());
    let spin = diagonal(0.02, 0.025, inertia);
    let pin = x * radius;
    let m = &mut model;
    let crank = Some(m.add_rigid_body(1.0, &Vector3::zeros(), &spin).unwrap());
    let block = Some(m.add_rigid_body(block_mass, &pin, &spin).unwrap());
    let beside = Vector3::new(0.9, 0.0, 0.0);
    let yoke = Some(m.add_rigid_body(yoke_mass, &beside, &spin).unwrap());
    let motor = joint(m, JointKind::Revolute, None, crank, &Vector3::zeros(), &z);
    joint(m, JointKind::Cylindrical, crank, block, &pin, &z);
    let slot = joint(m, JointKind::Cylindrical, yoke, block, &pin, &y);
    let guide = joint(m, JointKind::Cylindrical, None, yoke, &beside, &x);
    prescribe(m, motor, Rotation1, &turning.signal(0.0));
    let solution = solve(m, turning.period(), 25);
    let times = times(turning.period(), 40);

    let exact = |f: &dyn Fn(Jet) -> Jet, order: usize| {
        along(&times, |t| {
            let [angle, rate, acceleration] = turning.at(t);
            let value = f(Jet::variable(angle));
            match order {
                0 => value.0[0],
                1 => value.0[1] * rate,
                _ => second_rate(&value, rate, acceleration),
            }
        })
    };
    let advance = |angle: Jet| (angle.cos() - Jet::constant(1.0)) * radius;
    let lift = |angle: Jet| angle.sin() * radius;
    let of = |joint, quantity| of_joint(&solution, joint, quantity, &times);
    let quantities = [
        JointQuantity::Coordinate(Displacement1),
        JointQuantity::Rate(Displacement1),
        JointQuantity::Acceleration(Displacement1),
    ];
    for (order, quantity) in quantities.into_iter().enumerate() {
        assert_near(&of(guide, quantity), &exact(&advance, order), "yoke");
        assert_near(
            &of(slot, quantity),
            &exact(&lift, order),
            "block in its slot",
        );
    }
    let zero = vec![0.0; times.len()];
    let roll = of(guide, JointQuantity::Coordinate(Rotation1));
    assert_close(&roll, &zero, 1.0, "roll of the yoke");
    let torque = along(&times, |t| {
        let [angle, rate, acceleration] = turning.at(t);
        let x = advance(Jet::variable(angle));
        (inertia + block_mass * radius * radius) * acceleration
            + yoke_mass * second_rate(&x, rate, acceleration) * x.0[1]
    });
    let found = of(motor, JointQuantity::DrivingEffort(Rotation1));
    assert_near(&found, &torque, "torque");
    // The slot pushes the yoke along the guide, which itself exerts no force along x.
    let push = along(&times, |t| {
        let [angle, rate, acceleration] = turning.at(t);
        -yoke_mass * second_rate(&advance(Jet::variable(angle)), rate, acceleration)
    });
    let found = common::column(&reaction(&solution, slot, 0, &times), 3, 0);
    assert_near(&found, &push, "force of the slot on the block");
}
