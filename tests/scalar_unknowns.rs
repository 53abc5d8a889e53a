//! Equations with unknowns that belong to no grid point: a period, a load, what holds a mean.

mod common;

use common::*;
use nalgebra::{Matrix3, Vector3};
use periodyn::collocation::{Collocation, Conditions, GridState, ScalarEquations};
use periodyn::elements::{LoadFrame, NodeForceLaw};
use periodyn::error::Result;
use periodyn::fourier::TimeGrid;
use periodyn::model::{Model, Signal, SpringDefinition};
use periodyn::motion::Motion;
use periodyn::solve::{Iteration, LinearMethod, NewtonOptions, Outcome, solve_with_scalars};
use periodyn::system::System;
use std::f64::consts::TAU;
use std::sync::Arc;

const OPTIONS: NewtonOptions = NewtonOptions {
    tolerance: 1e-9,
    iteration_limit: 30,
};

fn equations(model: &Model, period: f64, points: usize) -> Collocation {
    let system = Arc::new(System::new(model, period).unwrap());
    Collocation::new(system, TimeGrid::new(points, period).unwrap()).unwrap()
}

/// A solve that must converge, and its number of iterations.
fn iterations(equations: Collocation, state: &mut GridState, method: LinearMethod) -> usize {
    let mut observe = |_: &Iteration| true;
    let report = solve_with_scalars(equations, state, method, &OPTIONS, &mut observe).unwrap();
    println!("{method:?}: {report:#?}");
    assert_eq!(report.outcome, Outcome::Converged);
    report.iterations.len()
}

/// The period of a motion of node 0 along x that is not forced: a phase takes the place of what
/// tells the time, `x = 0` at the first grid point.
#[derive(Debug)]
struct Period;

impl ScalarEquations for Period {
    fn scales(&self) -> Vec<f64> {
        vec![TAU]
    }

    fn apply(&self, values: &[f64], equations: &mut Collocation) -> Result<()> {
        equations.set_period(values[0])
    }

    fn residual(&self, equations: &Collocation, state: &GridState, out: &mut [f64]) -> Result<()> {
        let length = equations.system().scales().length;
        out[0] = state.node(0)[0].position.x / length;
        Ok(())
    }

    fn gradient(
        &self,
        equations: &Collocation,
        _: &GridState,
        _: usize,
        row: &mut [f64],
    ) -> Result<()> {
        // Nothing turns.
        row[equations.layout().motion(0, 0).start] = 1.0;
        Ok(())
    }
}

#[test]
fn a_limit_cycle_has_its_period() {
    // Of van der Pol: x'' − (1 − x²) x' + x = 0.
    let (mut model, _) = mass_on_a_slide(1.0, &Vector3::x());
    let law = NodeForceLaw {
        function: Arc::new(|state, out| {
            let (x, v) = (state.positions[0].x, state.velocities[0][0]);
            out.forces[0][0] = (1.0 - x * x) * v - x;
            if let Some((by_motion, by_velocity)) = &mut out.tangents {
                by_motion[(0, 0)] = -2.0 * x * v - 1.0;
                by_velocity[(0, 0)] = 1.0 - x * x;
            }
            Ok(())
        }),
        gives_tangents: true,
        frame: LoadFrame::Space,
    };
    model.add_node_forces(&[0], law).unwrap();
    for method in [LinearMethod::Direct, LinearMethod::Iterative(None)] {
        let (points, guess) = (51, 6.5);
        let mut equations = equations(&model, guess, points);
        equations.set_scalars(Arc::new(Period));
        let mut state = GridState::reference(equations.system(), equations.grid());
        for (k, motion) in state.motions.iter_mut().enumerate() {
            motion.position.x = 2.0 * (TAU * k as f64 / points as f64).sin();
        }
        state.scalars = vec![guess];
        // Quadratic, with differences by the period.
        assert!(iterations(equations, &mut state, method) <= 5);
        // By shooting with steps at rounding; 2e-13 measured with a dense matrix.
        let error = state.scalars[0] - 6.663_286_859_323;
        println!("period off by {error:e}");
        assert!(error.abs() < 1e-11);
    }
}

/// A multiple of all loads that gives a mean of the position of node 0 along x.
#[derive(Debug)]
struct Trim(f64);

impl ScalarEquations for Trim {
    fn scales(&self) -> Vec<f64> {
        vec![1.0]
    }

    fn apply(&self, values: &[f64], equations: &mut Collocation) -> Result<()> {
        equations.set_conditions(Conditions {
            load_factor: values[0],
            ..Conditions::at(0.0)
        })
    }

    fn residual(&self, equations: &Collocation, state: &GridState, out: &mut [f64]) -> Result<()> {
        let sum: f64 = state.node(0).iter().map(|m| m.position.x).sum();
        let length = equations.system().scales().length;
        out[0] = (sum / state.points() as f64 - self.0) / length;
        Ok(())
    }

    fn gradient(
        &self,
        equations: &Collocation,
        state: &GridState,
        _: usize,
        row: &mut [f64],
    ) -> Result<()> {
        for k in 0..state.points() {
            row[equations.layout().motion(0, k).start] = 1.0 / state.points() as f64;
        }
        Ok(())
    }
}

#[test]
fn a_load_is_found_that_gives_a_mean() {
    // A cubic spring under 1 + cos t: the mean is no multiple of the load.
    let build = |factor: f64| {
        let (mut model, at) = mass_on_a_slide(0.3, &Vector3::x());
        let spring = SpringDefinition {
            at,
            stiffness: 1.0,
            damping: 0.4,
            rest: 0.0,
        };
        model.add_spring_damper(spring).unwrap();
        let cubic = NodeForceLaw {
            function: Arc::new(|state, out| {
                out.forces[0][0] = -state.positions[0].x.powi(3);
                Ok(())
            }),
            gives_tangents: false,
            frame: LoadFrame::Space,
        };
        model.add_node_forces(&[0], cubic).unwrap();
        let load = Signal::harmonics(factor, 0.0, &[factor], &[0.0]).unwrap();
        model.add_actuator(at, &load).unwrap();
        model
    };
    let points = 31;
    let mean =
        |motions: &[Motion]| motions.iter().map(|m| m.position.x).sum::<f64>() / points as f64;
    for method in [LinearMethod::Direct, LinearMethod::Iterative(None)] {
        let mut equations = equations(&build(1.0), TAU, points);
        equations.set_scalars(Arc::new(Trim(0.7)));
        let mut state = GridState::reference(equations.system(), equations.grid());
        state.scalars = vec![0.5];
        assert!(iterations(equations, &mut state, method) <= 8);
        assert!((mean(state.node(0)) - 0.7).abs() < 1e-12);
        // Given that load, the mean is found.
        let given = common::solve(&build(state.scalars[0]), TAU, points);
        let found = mean(given.details().state.node(0));
        assert!((found - 0.7).abs() < 1e-10, "{found}");
    }
}

/// The constant torque that holds the mean of an angle that nothing else does.
#[derive(Debug)]
struct Hold {
    /// All signals, and the place of the torque among those of a time.
    signals: Vec<f64>,
    torque: usize,
    mean: f64,
}

impl ScalarEquations for Hold {
    fn scales(&self) -> Vec<f64> {
        vec![1.0]
    }

    fn apply(&self, values: &[f64], equations: &mut Collocation) -> Result<()> {
        let mut signals = self.signals.clone();
        let count = equations.system().signals();
        for here in signals.chunks_exact_mut(count) {
            here[self.torque] = values[0];
        }
        equations.set_signals(&signals);
        Ok(())
    }

    fn residual(&self, _: &Collocation, state: &GridState, out: &mut [f64]) -> Result<()> {
        let angles = state.node(0).iter();
        let angles = angles.map(|m| m.rotation[(1, 0)].atan2(m.rotation[(0, 0)]));
        out[0] = angles.sum::<f64>() / state.points() as f64 - self.mean;
        Ok(())
    }

    fn gradient(
        &self,
        equations: &Collocation,
        state: &GridState,
        _: usize,
        row: &mut [f64],
    ) -> Result<()> {
        for k in 0..state.points() {
            row[equations.layout().motion(0, k).start + 5] = 1.0 / state.points() as f64;
        }
        Ok(())
    }
}

#[test]
fn a_mean_that_nothing_holds_can_be_given() {
    let (inertia, amplitude) = (0.5, 0.4);
    let mut model = Model::new();
    let spin = Matrix3::identity() * inertia;
    let body = model.add_rigid_body(1.0, &Vector3::zeros(), &spin).unwrap();
    let hinge = revolute(
        &mut model,
        None,
        Some(body),
        &Vector3::zeros(),
        &Vector3::z(),
    );
    model
        .add_actuator(rotation1(hinge), &cosine(amplitude))
        .unwrap();
    let other = 0.125;
    let torque = Signal::constant(other).unwrap();
    model.add_actuator(rotation1(hinge), &torque).unwrap();
    for method in [LinearMethod::Direct, LinearMethod::Iterative(None)] {
        let mut equations = equations(&model, TAU, 31);
        let signals = equations.signals().to_vec();
        let torque = signals.iter().position(|x| *x == other).unwrap();
        let mean = 0.3;
        equations.set_scalars(Arc::new(Hold {
            signals,
            torque,
            mean,
        }));
        let mut state = GridState::reference(equations.system(), equations.grid());
        state.scalars = vec![other];
        let times: Vec<f64> = equations.grid().times().collect();
        assert!(iterations(equations, &mut state, method) <= 4);
        assert!(state.scalars[0].abs() < 1e-12, "{:e}", state.scalars[0]);
        for (motion, time) in state.node(0).iter().zip(times) {
            let angle = motion.rotation[(1, 0)].atan2(motion.rotation[(0, 0)]);
            let exact = mean - amplitude / inertia * time.cos();
            // What the grid leaves of such turns is below rounding.
            assert!((angle - exact).abs() < 1e-11, "{:e}", angle - exact);
        }
    }
}

#[test]
fn scalars_that_do_not_fit_are_refused() {
    let (model, _) = mass_on_a_slide(1.0, &Vector3::x());
    let mut equations = equations(&model, TAU, 5);
    equations.set_scalars(Arc::new(Period));
    let mut state = GridState::reference(equations.system(), equations.grid());
    let refused = |equations: &Collocation, state: &mut GridState, name: &str| {
        let method = LinearMethod::Direct;
        let mut observe = |_: &Iteration| true;
        let end = solve_with_scalars(equations.clone(), state, method, &OPTIONS, &mut observe);
        let error = end.unwrap_err().to_string();
        assert!(error.contains(name), "{error}");
    };
    refused(&equations, &mut state, "state.scalars: expected 1, got 0");
    state.scalars = vec![-1.0];
    refused(&equations, &mut state, "period");
    state.scalars = vec![TAU];
    equations.oversample(2).unwrap();
    refused(&equations, &mut state, "no oversampling");
}
