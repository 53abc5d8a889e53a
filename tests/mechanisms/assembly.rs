//! Joints whose frames do not fit at first: closed the right way round, or said to be turned over.

use super::*;
use periodyn::motion::{Motion, rotation_from_vector};

/// A body on a joint to the ground, whose second frame is turned by `turn` from the first.
fn body_on(kind: JointKind, turn: &Vector3<f64>) -> Model {
    let mut model = Model::new();
    let inertia = diagonal(0.1, 0.2, 0.15);
    let body = model
        .add_rigid_body(1.0, &Vector3::new(0.5, 0.1, 0.2), &inertia)
        .unwrap();
    let first = Motion::new(Matrix3::identity(), Vector3::zeros());
    let second = Motion::new(rotation_from_vector(turn), Vector3::new(0.01, 0.0, 0.02));
    let joint = model
        .add_joint(kind, None, Some(body), &first, &second)
        .unwrap();
    for &coordinate in kind.coordinates() {
        spring(&mut model, joint, coordinate, 30.0, 1.0, 0.0);
    }
    model
}

fn try_solve(model: &Model) -> Solution {
    let options = common::options(5);
    Solution::solve(model, 1.0, &options, &mut |_, _| true).unwrap()
}

const WITH_SENSE: [(JointKind, usize); 6] = [
    (JointKind::Rigid, 2),
    (JointKind::Revolute, 3),
    (JointKind::Prismatic, 2),
    (JointKind::Cylindrical, 3),
    (JointKind::Screw { pitch: 0.2 }, 3),
    (JointKind::Planar, 3),
];

#[test]
fn joints_that_close_turned_over_are_named() {
    let half_turn = Vector3::x() * std::f64::consts::PI;
    for (kind, axis) in WITH_SENSE {
        let solution = try_solve(&body_on(kind, &half_turn));
        assert_eq!(solution.outcome(), Outcome::WrongAssembly, "{kind:?}");
        let report = solution.report();
        let name = format!(
            "joint 0 ({}) has closed turned over: axis {axis} of its second frame",
            kind.name()
        );
        assert!(report.contains(&name), "{report}");
    }
}

#[test]
fn joints_close_the_right_way_round_from_frames_that_do_not_fit() {
    for (kind, _) in WITH_SENSE {
        for turn in [Vector3::new(0.9, -0.3, 0.4), Vector3::new(-0.2, 1.2, 0.1)] {
            let solution = try_solve(&body_on(kind, &turn));
            let report = solution.report();
            assert_eq!(solution.outcome(), Outcome::Converged, "{kind:?}: {report}");
        }
    }
}
