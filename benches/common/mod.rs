//! Models that the benchmarks share.

use nalgebra::Vector3;
use periodyn::elements::{Coordinate, JointKind};
use periodyn::model::{JointCoordinate, Model, SectionInput, Signal, SpringDefinition};
use std::f64::consts::TAU;

/// Period of the spatial four-bar's motion, in seconds.
pub const PERIOD: f64 = TAU / 0.3;

/// The spatial four-bar of section 7.2 of the paper, with `elements` elements of `degree` to a bar.
pub fn spatial_four_bar(elements: usize, degree: usize) -> Model {
    let a = Vector3::new(-0.4, 0.0, 0.0);
    let b = Vector3::new(-0.75, 0.0, 0.652);
    let c = Vector3::new(0.0, 0.85, 0.2);
    let d = Vector3::new(0.0, 0.85, 0.0);
    let (i1, i2) = (Vector3::x(), Vector3::y());
    let thick = SectionInput::diagonal(
        &[52.99e6, 16.88e6, 16.88e6, 733.5, 1131.0, 1131.0],
        &[1.997, 85.2e-6, 42.6e-6, 42.6e-6],
    )
    .unwrap();
    let thin = SectionInput::diagonal(
        &[13.25e6, 4.22e6, 4.22e6, 45.84, 70.66, 70.66],
        &[0.4992, 5.324e-6, 2.662e-6, 2.662e-6],
    )
    .unwrap();
    let mut model = Model::new();
    let mut bar = |from, to, across, section| {
        model
            .add_straight_beam(from, to, across, section, elements, degree)
            .unwrap()
    };
    let rocker = bar(&a, &b, &i2, &thick);
    let coupler = bar(&b, &c, &i1, &thick);
    let crank = bar(&c, &d, &i1, &thin);
    let mut join = |kind, first, second, frame| {
        model
            .add_joint(kind, first, Some(second), &frame, &frame)
            .unwrap()
    };
    let about = |point, axis| Model::frame_at("axis", point, axis).unwrap();
    let hinge = join(JointKind::Revolute, None, rocker.first_node, about(&a, &i2));
    let coupling = (Some(rocker.last_node), coupler.first_node);
    join(JointKind::Spherical, coupling.0, coupling.1, about(&b, &i2));
    let cross = Model::cross_frame(&c, &i1.cross(&(c - b)), &i1).unwrap();
    join(
        JointKind::Universal,
        Some(coupler.last_node),
        crank.first_node,
        cross,
    );
    let motor = join(JointKind::Revolute, None, crank.last_node, about(&d, &i1));

    let coordinate = Coordinate::Rotation1;
    model
        .add_spring_damper(SpringDefinition {
            at: JointCoordinate {
                joint: hinge,
                coordinate,
            },
            stiffness: 18.0,
            damping: 0.0,
            rest: 0.0,
        })
        .unwrap();
    let mean = 1.0 / 3.0 + 1.0 / 21.0;
    let turn = Signal::harmonics(mean, 0.3, &[-1.0 / 3.0, 0.0, -1.0 / 21.0], &[0.0, 0.1, 0.0]);
    let at = JointCoordinate {
        joint: motor,
        coordinate,
    };
    model.prescribe(at, &turn.unwrap()).unwrap();
    model
}
