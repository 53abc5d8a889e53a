//! Models that tests of the linear solvers share.

use crate::collocation::{Collocation, GridState, Pattern, TangentBlocks};
use crate::elements::{Coordinate, JointKind, LoadFrame};
use crate::fourier::TimeGrid;
use crate::model::*;
use crate::system::System;
use faer::Mat;
use nalgebra::{Matrix3, Vector3};
use std::f64::consts::TAU;
use std::sync::Arc;

/// The equations of a model, and their Jacobian, assembled.
pub(crate) struct Linearised {
    pub equations: Collocation,
    pub state: GridState,
    pub pattern: Pattern,
    pub values: Vec<f64>,
}

impl Linearised {
    /// In the reference configuration, with these multipliers.
    pub fn new(
        model: &Model,
        period: f64,
        points: usize,
        multiplier: impl Fn(usize) -> f64,
    ) -> Self {
        let system = Arc::new(System::new(model, period).unwrap());
        let grid = TimeGrid::new(points, period).unwrap();
        let mut state = GridState::reference(&system, grid);
        for (i, value) in state.multipliers.iter_mut().enumerate() {
            *value = multiplier(i);
        }
        let mut equations = Collocation::new(system.clone(), grid).unwrap();
        let pattern = Pattern::new(&system, points);
        let mut values = vec![0.0; pattern.entries()];
        let mut blocks = TangentBlocks::default();
        equations
            .jacobian(&state, &pattern, &mut blocks, &mut values)
            .unwrap();
        Linearised {
            equations,
            state,
            pattern,
            values,
        }
    }

    /// The whole Jacobian.
    pub fn dense(&self) -> Mat<f64> {
        let mut matrix = Mat::zeros(self.pattern.size(), self.pattern.size());
        for (column, range) in self.pattern.column_pointers().windows(2).enumerate() {
            for at in range[0]..range[1] {
                matrix[(self.pattern.row_indices()[at], column)] = self.values[at];
            }
        }
        matrix
    }
}

fn at(joint: usize) -> JointCoordinate {
    JointCoordinate {
        joint,
        coordinate: Coordinate::Rotation1,
    }
}

/// A flexible crank and rocker with a flexible coupler, in a plane, and its period.
pub(crate) fn four_bar(elements: usize, degree: usize, frequency: f64) -> (Model, f64) {
    let mut model = Model::new();
    let point = |x: f64, y: f64| Vector3::new(x, y, 0.0);
    let [a, b, c, d] = [
        point(0.0, 0.0),
        point(0.0, 0.3),
        point(1.0, 0.8),
        point(1.0, 0.0),
    ];
    let section = SectionInput::diagonal(
        &[4e6, 1.4e6, 1.4e6, 60.0, 80.0, 80.0],
        &[0.3, 1e-5, 5e-6, 5e-6],
    );
    let section = section.unwrap();
    let bars = [(&a, &b), (&b, &c), (&c, &d)].map(|(from, to)| {
        model
            .add_straight_beam(from, to, &Vector3::z(), &section, elements, degree)
            .unwrap()
    });
    let mut hinge = |first, second, place: &Vector3<f64>, kind| {
        let frame = Model::frame_at("axis", place, &Vector3::z()).unwrap();
        model
            .add_joint(kind, first, second, &frame, &frame)
            .unwrap()
    };
    let motor = hinge(None, Some(bars[0].first_node), &a, JointKind::Revolute);
    hinge(
        Some(bars[0].last_node),
        Some(bars[1].first_node),
        &b,
        JointKind::Spherical,
    );
    let knee = hinge(
        Some(bars[1].last_node),
        Some(bars[2].first_node),
        &c,
        JointKind::Revolute,
    );
    hinge(None, Some(bars[2].last_node), &d, JointKind::Revolute);
    let turn = Signal::harmonics(0.0, frequency, &[0.0], &[0.2]).unwrap();
    model.prescribe(at(motor), &turn).unwrap();
    let knee = at(knee);
    let branches = vec![crate::elements::MaxwellBranch {
        stiffness: 2.0,
        relaxation_time: 0.5 / frequency,
    }];
    model.add_viscoelastic(knee, 1.0, 0.0, &branches).unwrap();
    (model, TAU / frequency)
}

/// A hub that turns at 1, with a clamped flexible blade, in gravity.
pub(crate) fn rotor(elements: usize) -> (Model, f64) {
    let mut model = Model::new();
    let (root, tip) = (Vector3::new(0.2, 0.0, 0.0), Vector3::new(10.2, 0.0, 0.0));
    let ball = Matrix3::identity();
    let hub = model.add_rigid_body(2.0, &Vector3::zeros(), &ball).unwrap();
    let section = SectionInput::diagonal(
        &[1e6, 3e5, 3e5, 800.0, 2600.0, 5100.0],
        &[1.0, 0.02, 0.01, 0.01],
    );
    let blade = model
        .add_straight_beam(&root, &tip, &Vector3::y(), &section.unwrap(), elements, 2)
        .unwrap();
    let axis = Model::frame_at("axis", &Vector3::zeros(), &Vector3::z()).unwrap();
    let shaft = model
        .add_joint(JointKind::Revolute, None, Some(hub), &axis, &axis)
        .unwrap();
    let frame = Model::frame_at("axis", &root, &Vector3::x()).unwrap();
    model
        .add_joint(
            JointKind::Rigid,
            Some(hub),
            Some(blade.first_node),
            &frame,
            &frame,
        )
        .unwrap();
    let turn = Signal::harmonics(0.0, 1.0, &[], &[]).unwrap();
    model.prescribe(at(shaft), &turn).unwrap();
    model.set_gravity([0.0, -0.5, 0.0].map(|g| Signal::constant(g).unwrap()));
    (model, TAU)
}

/// A clamped beam under a turning force at its tip, and the period.
pub(crate) fn hingeless() -> (Model, f64) {
    let mut model = Model::new();
    let (root, tip) = (Vector3::zeros(), Vector3::new(1.0, 0.0, 0.0));
    let section = SectionInput::diagonal(
        &[4e6, 1.4e6, 1.4e6, 60.0, 80.0, 80.0],
        &[0.3, 1e-5, 5e-6, 5e-6],
    );
    let beam = model
        .add_straight_beam(&root, &tip, &Vector3::y(), &section.unwrap(), 2, 2)
        .unwrap();
    let frame = Model::frame_at("axis", &root, &Vector3::z()).unwrap();
    model
        .add_joint(
            JointKind::Rigid,
            None,
            Some(beam.first_node),
            &frame,
            &frame,
        )
        .unwrap();
    let mut force: [Option<Signal>; 6] = Default::default();
    force[1] = Some(Signal::harmonics(0.0, 0.0, &[1.0], &[0.0]).unwrap());
    force[2] = Some(Signal::harmonics(0.0, 0.0, &[0.0], &[1.0]).unwrap());
    model
        .add_load(beam.last_node, LoadFrame::Space, force)
        .unwrap();
    (model, TAU / 20.0)
}

/// One model of each kind, with periods.
pub(crate) fn moving_models() -> Vec<(Model, f64)> {
    vec![four_bar(2, 2, 3.0), rotor(2)]
}
