//! Linkages with more constraints than they seem to bear: Bennett's of four hinges, and Bricard's
//! of six.

use super::common::times;
use super::jet::{Jet, Point, second_rate};
use super::*;
use periodyn::elements::Coordinate::Rotation1;
use periodyn::motion::Motion;

/// A frame whose place depends on one variable: columns of its rotation matrix, and its origin.
#[derive(Clone, Copy)]
struct Frame {
    axes: [[Jet; 3]; 3],
    origin: [Jet; 3],
}

/// A link between two hinges: distance and angle between their axes (Denavit and Hartenberg).
#[derive(Clone, Copy)]
struct Link {
    length: f64,
    twist: f64,
}

impl Frame {
    fn ground() -> Self {
        let unit = |i: usize, j: usize| Jet::constant(f64::from(u8::from(i == j)));
        Frame {
            axes: std::array::from_fn(|j| std::array::from_fn(|i| unit(i, j))),
            origin: [Jet::constant(0.0); 3],
        }
    }

    fn sum(a: &[Jet; 3], x: Jet, b: &[Jet; 3], y: Jet) -> [Jet; 3] {
        std::array::from_fn(|i| a[i] * x + b[i] * y)
    }

    /// Turned about axis 3, then moved along the new axis 1, and turned about it.
    fn after(&self, angle: Jet, link: Link) -> Self {
        let [x, y, z] = &self.axes;
        let (s, c) = (angle.sin(), angle.cos());
        let first = Self::sum(x, c, y, s);
        let across = Self::sum(x, -s, y, c);
        let (st, ct) = link.twist.sin_cos();
        let (st, ct) = (Jet::constant(st), Jet::constant(ct));
        let move_along = Jet::constant(link.length);
        Frame {
            axes: [
                first,
                Self::sum(&across, ct, z, st),
                Self::sum(&across, -st, z, ct),
            ],
            origin: Self::sum(&self.origin, Jet::constant(1.0), &first, move_along),
        }
    }

    fn motion(&self) -> Motion {
        let axes = Matrix3::from_fn(|i, j| self.axes[j][i].0[0]);
        Motion::new(axes, Vector3::from_fn(|i, _| self.origin[i].0[0]))
    }

    fn middle(&self, other: &Frame) -> Point {
        let [x, y, z] = Self::sum(
            &self.origin,
            Jet::constant(0.5),
            &other.origin,
            Jet::constant(0.5),
        );
        Point::new(x, y, z)
    }
}

/// A closed chain of hinges, whose last link is the ground and whose first hinge is turned: the
/// angles of all hinges, continuous functions of that of the first.
struct Chain<'a> {
    name: &'a str,
    links: Vec<Link>,
    angles: &'a dyn Fn(f64) -> Vec<Jet>,
    /// Of each moving link, at its middle.
    masses: Vec<f64>,
    turning: Turning,
    /// Whether the first hinge turns round, not only to and fro.
    turns: bool,
    reference: f64,
    points: usize,
    redundant: usize,
}

impl Chain<'_> {
    /// Angle of the first hinge, with its rate and acceleration.
    fn at(&self, t: f64) -> [f64; 3] {
        let [angle, rate, acceleration] = self.turning.at(t);
        if self.turns {
            return [angle, rate, acceleration];
        }
        let omega = self.turning.omega;
        [angle - omega * t, rate - omega, acceleration]
    }

    fn frames(&self, angle: f64) -> Vec<Frame> {
        let mut frames = vec![Frame::ground()];
        for (angle, link) in (self.angles)(angle).into_iter().zip(&self.links) {
            frames.push(frames[frames.len() - 1].after(angle, *link));
        }
        frames
    }

    /// The closed form closes the chain, with all derivatives: nothing else is taken for granted.
    fn check_closure(&self, angle: f64) {
        let (first, last) = (Frame::ground(), *self.frames(angle).last().unwrap());
        let flat = |f: &Frame| [f.axes.concat(), f.origin.to_vec()].concat();
        for (a, b) in flat(&first).iter().zip(flat(&last)) {
            for k in 0..3 {
                let gap = (a.0[k] - b.0[k]).abs();
                assert!(gap < 1e-12, "{}: closed form at {angle}: {gap}", self.name);
            }
        }
    }

    fn check(&self) {
        let weight = Vector3::new(1.0, -2.0, -9.0);
        let count = self.links.len();
        let at_start: Vec<Motion> = self
            .frames(self.reference)
            .iter()
            .map(Frame::motion)
            .collect();
        let mut model = Model::new();
        let m = &mut model;
        let bodies: Vec<Option<usize>> = (0..count - 1)
            .map(|i| {
                let middle = 0.5 * (at_start[i].position + at_start[i + 1].position);
                Some(particle(m, self.masses[i], &middle))
            })
            .collect();
        let joints: Vec<usize> = (0..count)
            .map(|i| {
                let first = if i == 0 { None } else { bodies[i - 1] };
                let second = bodies.get(i).copied().flatten();
                m.add_joint(
                    JointKind::Revolute,
                    first,
                    second,
                    &at_start[i],
                    &at_start[i],
                )
                .unwrap()
            })
            .collect();
        let Turning {
            offset,
            omega,
            swing,
        } = self.turning;
        let rate = if self.turns { omega } else { 0.0 };
        let signal = Signal::harmonics(offset - self.reference, rate, &[0.0], &[swing]);
        prescribe(m, joints[0], Rotation1, &signal.unwrap());
        gravity(m, &weight);
        let period = self.turning.period();
        let solution = solve(&model, period, self.points);
        let said = format!("{} redundant constraint", self.redundant);
        assert!(solution.report().contains(&said), "{}", solution.report());

        let times = times(period, 61);
        times
            .iter()
            .for_each(|&t| self.check_closure(self.at(t)[0]));
        let name = |what: &str| format!("{}: {what}", self.name);
        let of = |joint, quantity| of_joint(&solution, joint, quantity, &times);
        let start = (self.angles)(self.reference);
        for (i, &joint) in joints.iter().enumerate() {
            let exact = |order: usize| {
                along(&times, |t| {
                    let [angle, rate, acceleration] = self.at(t);
                    let turned = (self.angles)(angle)[i];
                    match order {
                        0 => turned.0[0] - start[i].0[0],
                        1 => turned.0[1] * rate,
                        _ => second_rate(&turned, rate, acceleration),
                    }
                })
            };
            let quantities = [
                JointQuantity::Coordinate(Rotation1),
                JointQuantity::Rate(Rotation1),
                JointQuantity::Acceleration(Rotation1),
            ];
            for (order, quantity) in quantities.into_iter().enumerate() {
                let what = name(&format!("hinge {i}, {quantity:?}"));
                assert_near(&of(joint, quantity), &exact(order), &what);
            }
        }
        let point = |i: usize, t: f64| {
            let frames = self.frames(self.at(t)[0]);
            frames[i].middle(&frames[i + 1])
        };
        let force = |i: usize, t: f64| {
            let [_, rate, acceleration] = self.at(t);
            (point(i, t).acceleration(rate, acceleration) - weight) * self.masses[i]
        };
        for (i, body) in bodies.iter().enumerate() {
            let exact = along_vectors(&times, |t| point(i, t).0[0]);
            let found = position(&solution, body.unwrap(), &times);
            assert_near(&found, &exact, &name(&format!("place of link {i}")));
        }
        let torque = along(&times, |t| {
            (0..count - 1)
                .map(|i| force(i, t).dot(&point(i, t).0[1]))
                .sum()
        });
        let found = of(joints[0], JointQuantity::DrivingEffort(Rotation1));
        assert_near(&found, &torque, &name("torque"));
        // How the hinges share the load is not determined; what they bear together is.
        let bearing = reaction(&solution, joints[0], 0, &times);
        let other = reaction(&solution, joints[count - 1], 0, &times);
        let borne: Vec<f64> = bearing.iter().zip(other).map(|(a, b)| a - b).collect();
        let exact = along_vectors(&times, |t| (0..count - 1).map(|i| force(i, t)).sum());
        assert_near(&borne, &exact, &name("force on the ground"));
    }
}

/// Bennett: opposite links are equal, and twists go with lengths, `sin α / a = sin β / b`. Then
/// `tan(θ₁/2) tan(θ₂/2) = sin((β + α)/2) / sin((β − α)/2)`, and opposite hinges turn by opposite
/// angles.
#[test]
fn a_bennett_linkage_turns_round_and_round() {
    let (a, alpha, beta) = (0.5, 0.6f64, 1.3f64);
    let short = Link {
        length: a,
        twist: alpha,
    };
    let long = Link {
        length: a * beta.sin() / alpha.sin(),
        twist: beta,
    };
    let ratio = (0.5 * (beta + alpha)).sin() / (0.5 * (beta - alpha)).sin();
    // θ₂ = π − θ₁ + 2 δ, where δ does not jump.
    let angles = |angle: f64| {
        let first = Jet::variable(angle);
        let less = ratio - 1.0;
        let delta = (first.sin() * less).atan2(Jet::constant(ratio + 1.0) + first.cos() * less);
        let second = Jet::constant(std::f64::consts::PI) - first + delta * 2.0;
        let half = 0.5 * angle;
        let product = half.tan() * (0.5 * second.0[0]).tan();
        assert!((product - ratio).abs() < 1e-9 * (1.0 + half.tan().abs()) * ratio);
        vec![first, second, -first, -second]
    };
    Chain {
        name: "Bennett",
        links: vec![short, long, short, long],
        angles: &angles,
        masses: vec![1.0, 2.0, 0.7],
        turning: Turning {
            offset: 0.4,
            omega: 3.0,
            swing: 0.15,
        },
        turns: true,
        reference: 0.4,
        points: 81,
        redundant: 3,
    }
    .check();
}

/// Bricard, with threefold symmetry: equal links, twists `α` and `−α` in turn. Then every second
/// hinge turns by the same angle, and `cos²α + sin²α (cos θ + cos φ) + (1 + cos²α) cos θ cos φ = 2
/// cos α sin θ sin φ`.
#[test]
fn a_bricard_linkage_swings() {
    let twist = 1.1f64;
    let link = |twist: f64| Link { length: 0.4, twist };
    let (s, c) = twist.sin_cos();
    let angles = |angle: f64| {
        let theta = Jet::variable(angle);
        let known = Jet::constant(c * c) + theta.cos() * (s * s);
        let x = Jet::constant(s * s) + theta.cos() * (1.0 + c * c);
        let y = theta.sin() * (-2.0 * c);
        let size = (x * x + y * y).sqrt();
        let phi = y.atan2(x) + (-known * size.inverse()).acos();
        vec![theta, phi, theta, phi, theta, phi]
    };
    let (forward, back) = (link(twist), link(-twist));
    Chain {
        name: "Bricard",
        links: vec![forward, back, forward, back, forward, back],
        angles: &angles,
        masses: vec![1.0, 2.0, 0.7, 1.5, 0.4],
        turning: Turning {
            offset: 0.7,
            omega: 2.0,
            swing: 0.6,
        },
        turns: false,
        reference: 0.7,
        points: 61,
        redundant: 1,
    }
    .check();
}
