use nalgebra::{Matrix6, Vector3, Vector6};
use periodyn::elements::{Coordinate, JointKind};
use periodyn::model::*;
use periodyn::solve::*;

pub fn section(s: [f64; 6], m: [f64; 4]) -> SectionInput {
    SectionInput {
        stiffness: Matrix6::from_diagonal(&Vector6::from(s)),
        mass: Matrix6::from_diagonal(&Vector6::new(m[0], m[0], m[0], m[1], m[2], m[3])),
        damping: Matrix6::zeros(),
    }
}

#[test]
fn four_bar() {
    let a = Vector3::new(-0.4, 0.0, 0.0);
    let b = Vector3::new(-0.75, 0.0, 0.652);
    let c = Vector3::new(0.0, 0.85, 0.2);
    let d = Vector3::new(0.0, 0.85, 0.0);
    let (i1, i2) = (Vector3::x(), Vector3::y());
    let s16 = section(
        [52.99e6, 16.88e6, 16.88e6, 733.5, 1131.0, 1131.0],
        [1.997, 85.2e-6, 42.6e-6, 42.6e-6],
    );
    let s8 = section(
        [13.25e6, 4.22e6, 4.22e6, 45.84, 70.66, 70.66],
        [0.4992, 5.324e-6, 2.662e-6, 2.662e-6],
    );
    let mut m = Model::new();
    let bar1 = m.add_straight_beam(&a, &b, &i2, &s16, 8, 1).unwrap();
    let bar2 = m.add_straight_beam(&b, &c, &i1, &s16, 8, 1).unwrap();
    let bar3 = m.add_straight_beam(&c, &d, &i1, &s8, 8, 1).unwrap();
    let fa = Model::frame_at("axis", &a, &i2).unwrap();
    let ja = m
        .add_joint(JointKind::Revolute, None, Some(bar1.first_node), &fa, &fa)
        .unwrap();
    let fb = Model::frame_at("axis", &b, &i2).unwrap();
    m.add_joint(
        JointKind::Spherical,
        Some(bar1.last_node),
        Some(bar2.first_node),
        &fb,
        &fb,
    )
    .unwrap();
    let fc = Model::cross_frame(&c, &i1.cross(&(c - b)), &i1).unwrap();
    m.add_joint(
        JointKind::Universal,
        Some(bar2.last_node),
        Some(bar3.first_node),
        &fc,
        &fc,
    )
    .unwrap();
    let fd = Model::frame_at("axis", &d, &i1).unwrap();
    let jd = m
        .add_joint(JointKind::Revolute, None, Some(bar3.last_node), &fd, &fd)
        .unwrap();
    m.add_spring_damper(SpringDefinition {
        at: JointCoordinate {
            joint: ja,
            coordinate: Coordinate::Rotation1,
        },
        stiffness: 18.0,
        damping: 0.0,
        rest: 0.0,
    })
    .unwrap();
    let turn = Signal::harmonics(
        1.0 / 3.0 + 1.0 / 21.0,
        0.3,
        &[-1.0 / 3.0, 0.0, -1.0 / 21.0],
        &[0.0, 0.1, 0.0],
    )
    .unwrap();
    m.prescribe(
        JointCoordinate {
            joint: jd,
            coordinate: Coordinate::Rotation1,
        },
        &turn,
    )
    .unwrap();
    let period = std::f64::consts::TAU / 0.3;
    for n in [3, 5, 7, 11, 21, 41] {
        let options = PeriodicOptions {
            grid_points: n,
            newton: NewtonOptions {
                tolerance: 1e-9,
                iteration_limit: 20,
            },
            guess: InitialGuess::Default,
        };
        let t = std::time::Instant::now();
        let s = solve_periodic(&m, period, &options, &mut |_, _| true).unwrap();
        println!(
            "N={n} {:?} total {:?} guess {:?} ({} it) {:?}",
            s.report.outcome,
            t.elapsed(),
            s.guess_time,
            s.guess_iterations,
            s.timings
        );
        println!("  {}", s.report.explanation);
        for i in &s.report.iterations {
            println!("  {i:?}");
        }
        let z: Vec<f64> = s
            .state
            .node(bar1.last_node)
            .iter()
            .map(|m| m.position.z)
            .collect();
        println!("  {:?}", &z[..z.len().min(7)]);
        let torque: Vec<f64> = s.state.multipliers[s.state.multipliers.len() - n..]
            .iter()
            .map(|x| -x)
            .collect();
        println!("  torque {:?}", &torque[..n.min(7)]);
    }
}
