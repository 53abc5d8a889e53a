//! The one test that all quantities pass: their variations are derivatives of their features.

use super::*;
use crate::collocation::{Collocation, GridState};
use crate::elements::{LoadFrame, ShellPoint, ShellSide};
use crate::fourier::TimeGrid;
use crate::model::{Model, Signal};
use crate::system::{ElementRole, Regime, Standstill};
use crate::test_models::beams::rotor_blade;
use crate::test_models::elements::all_elements;
use crate::test_models::pendulums::zener_pendulum;
use crate::test_models::shells::flapping_plate;
use crate::test_models::small::{moving_models, one_blade};
use nalgebra::Vector3;
use std::f64::consts::TAU;
use std::sync::Arc;

const NODE: [NodeQuantity; 7] = [
    NodeQuantity::Position,
    NodeQuantity::RotationMatrix,
    NodeQuantity::Quaternion,
    NodeQuantity::Velocity,
    NodeQuantity::Acceleration,
    NodeQuantity::MaterialVelocity,
    NodeQuantity::MaterialAcceleration,
];
const BEAM: [BeamQuantity; 4] = [
    BeamQuantity::Strain,
    BeamQuantity::Force,
    BeamQuantity::MeanForce,
    BeamQuantity::ForceJump,
];
const SHELL: [ShellQuantity; 4] = [
    ShellQuantity::Strain,
    ShellQuantity::Resultant,
    ShellQuantity::SurfaceStress(ShellSide::Top),
    ShellQuantity::SurfaceStress(ShellSide::Bottom),
];

/// All quantities of a model.
fn all(model: &Model, system: &System) -> Vec<Quantity> {
    let mut all = Vec::new();
    for node in 0..system.nodes() {
        all.extend(NODE.map(|quantity| Quantity::Node(node, quantity)));
    }
    for (joint, definition) in system.joints().iter().enumerate() {
        let mut of_joint = |quantity| all.push(Quantity::Joint(joint, quantity));
        for &c in definition.kind().coordinates() {
            of_joint(JointQuantity::Coordinate(c));
            of_joint(JointQuantity::Rate(c));
            of_joint(JointQuantity::Acceleration(c));
        }
        for axes in [ResolvedIn::Space, ResolvedIn::First, ResolvedIn::Second] {
            of_joint(JointQuantity::Reaction(axes));
        }
    }
    for (at, _) in &model.prescribed {
        let effort = JointQuantity::DrivingEffort(at.coordinate);
        all.push(Quantity::Joint(at.joint, effort));
    }
    for element in 0..system.beams().len() {
        for station in [-1.0, 0.37, 1.0] {
            all.extend(BEAM.map(|quantity| Quantity::Beam {
                element,
                station,
                quantity,
            }));
        }
    }
    for element in 0..system.shells().len() {
        for axis in [None, Some(Vector3::new(0.3, 1.0, -0.2))] {
            let at = [0.37, -0.8];
            let point = ShellPoint { at, axis };
            all.extend(SHELL.map(|quantity| Quantity::Shell {
                element,
                point,
                quantity,
            }));
        }
    }
    for placed in system.elements() {
        let ElementRole::Force(force) = placed.role else {
            continue;
        };
        let mut of_force = |quantity| all.push(Quantity::Force(force, quantity));
        if placed.element.acted_measure().is_some() {
            of_force(ForceQuantity::Effort);
        }
        if placed.element.is_bushing() {
            of_force(ForceQuantity::BushingEfforts);
        }
        if let Some(controller) = placed.element.as_controller() {
            (0..controller.outputs().len()).for_each(|i| of_force(ForceQuantity::ControlEffort(i)));
            (0..controller.states().len()).for_each(|i| of_force(ForceQuantity::ControlState(i)));
        }
        let branches = match placed.has_feedback {
            true => 0,
            false => placed.element.own_unknowns(),
        };
        for branch in 0..branches {
            of_force(ForceQuantity::BranchEffort(branch));
            of_force(ForceQuantity::BranchElongation(branch));
        }
        for &node in placed.element.nodes() {
            of_force(ForceQuantity::OnNode(node, LoadFrame::Space));
            of_force(ForceQuantity::OnNode(node, LoadFrame::Follower));
        }
    }
    for (relation, placed) in system.relations().iter().enumerate() {
        all.extend(
            (0..placed.terms.len()).map(|coordinate| Quantity::RelationEffort {
                relation,
                coordinate,
            }),
        );
    }
    all
}

fn wave(i: usize) -> f64 {
    (0.37 * i as f64).sin()
}

/// Unscaled unknowns.
fn unscaled(equations: &Collocation, x: impl Fn(usize) -> f64) -> Vec<f64> {
    let scales = equations.column_scale().iter().enumerate();
    scales.map(|(i, scale)| x(i) * scale).collect()
}

/// Each model on a grid of several points, and one in steady rotation.
fn problems() -> Vec<(Model, Collocation)> {
    let on_grid = |(model, period): (Model, f64)| {
        let system = Arc::new(System::new(&model, period).unwrap());
        let grid = TimeGrid::new(5, period).unwrap();
        let equations = Collocation::new(system, grid).unwrap();
        (model, equations)
    };
    let mut models = moving_models();
    models.push(all_elements());
    models.push(rotor_blade(1, 3));
    models.push(flapping_plate(0.3, [1, 1], 3));
    let zener = zener_pendulum().0;
    models.push((zener, TAU));
    let mut problems: Vec<_> = models.into_iter().map(on_grid).collect();
    let (mut model, period) = one_blade(2);
    model.set_gravity([0.0; 3].map(|x| Signal::constant(x).unwrap()));
    let standstill = Standstill {
        time: 0.0,
        period: Some(period),
        angular_velocity: Vector3::new(0.0, 0.0, 3.0),
        axis_point: Vector3::new(0.1, 0.2, 0.0),
    };
    let system = System::in_regime(&model, Regime::Standstill(standstill)).unwrap();
    let grid = TimeGrid::new(1, period).unwrap();
    problems.push((model, Collocation::new(Arc::new(system), grid).unwrap()));
    problems
}

#[test]
fn variations_are_derivatives() {
    for (model, mut equations) in problems() {
        let system = equations.system().clone();
        let grid = equations.grid();
        let features: &[Feature] = match grid.points() {
            1 => &[Feature::Mean],
            _ => &[
                Feature::Mean,
                Feature::Cosine(1),
                Feature::Sine(2),
                Feature::At(0.3),
            ],
        };
        let reference = GridState::reference(&system, grid);
        let here = unscaled(&equations, |i| 0.1 * wave(i));
        let here = reference.incremented(&system, &here, 1.0);
        let direction = unscaled(&equations, |i| wave(7 * i + 3));
        let quantities = all(&model, &system);
        // Each component and feature of each quantity.
        let measure = |equations: &mut Collocation, state: &GridState| {
            equations.update_kinematics(state);
            let history = History::of(equations, state);
            let of = |quantity: &Quantity| {
                let probe = quantity.probe(&system).unwrap();
                let series = probe.samples(&history).unwrap().series(grid, None);
                let values = series.iter().map(|s| features.iter().map(|f| f.of(s)));
                values.flatten().collect()
            };
            quantities.iter().map(of).collect::<Vec<Vec<f64>>>()
        };
        let h = 2.5e-4;
        let mut at = |step: f64| {
            let state = here.incremented(&system, &direction, step);
            measure(&mut equations, &state)
        };
        let [a, b, c, d] = [at(h), at(-h), at(2.0 * h), at(-2.0 * h)];
        equations.update_kinematics(&here);
        for (q, quantity) in quantities.iter().enumerate() {
            let largest = a[q].iter().fold(0.0f64, |m, x| m.max(x.abs()));
            let mut place = 0;
            for component in 0..quantity.components() {
                for feature in features {
                    let measurement =
                        Measurement::new(*quantity, component, *feature, &system).unwrap();
                    let mut row = vec![0.0; equations.size()];
                    measurement
                        .add_gradient(&equations, &here, &mut row)
                        .unwrap();
                    let terms = row.iter().zip(&direction).map(|(x, y)| x * y);
                    let (found, size) = terms.fold((0.0, 0.0), |(sum, size): (f64, f64), x| {
                        (sum + x, size + x.abs())
                    });
                    let slope = (8.0 * (a[q][place] - b[q][place]) - (c[q][place] - d[q][place]))
                        / (12.0 * h);
                    // Fourth-order differences of what varies by parts in a thousand, and rounding.
                    assert!(
                        (slope - found).abs() <= 2e-9 * size + 1e-12 * largest / h,
                        "{measurement}: {slope:e} {found:e} of {size:e}"
                    );
                    place += 1;
                }
            }
        }
    }
}

#[test]
fn what_depends_on_motions_alone_stays_with_them() {
    let features = [Feature::Mean, Feature::Cosine(1), Feature::At(0.0)];
    let mut alone = 0;
    for (model, mut equations) in problems() {
        let system = equations.system().clone();
        let grid = equations.grid();
        if grid.points() == 1 {
            continue;
        }
        let here = unscaled(&equations, |i| 0.05 * wave(i));
        let here = GridState::reference(&system, grid).incremented(&system, &here, 1.0);
        let mut of = Vec::new();
        for quantity in all(&model, &system) {
            for feature in features {
                of.push(Measurement::new(quantity, 0, feature, &system).unwrap());
            }
        }
        let values = |equations: &mut Collocation| -> Vec<f64> {
            equations.update_kinematics(&here);
            let history = History::of(equations, &here);
            of.iter().map(|m| m.value(&history).unwrap()).collect()
        };
        let before = values(&mut equations);
        let other: Vec<f64> = equations.signals().iter().map(|x| 1.01 * x).collect();
        equations.set_signals(&other);
        let with_signals = values(&mut equations);
        equations.set_period(1.3 * grid.period()).unwrap();
        let with_period = values(&mut equations);
        for (i, measurement) in of.iter().enumerate() {
            let (same, now) = match measurement.dependence() {
                Dependence::Nothing => (before[i], with_period[i]),
                Dependence::Period => (before[i], with_signals[i]),
                Dependence::Parameters => continue,
            };
            alone += 1;
            let error = (same - now).abs();
            assert!(
                error <= 1e-12 * same.abs().max(1.0),
                "{measurement}: {same} {now}"
            );
        }
    }
    assert!(alone > 100);
}
