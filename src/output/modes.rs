//! Modes: the equilibrium, eigenvalues and shapes, and the motion in a mode as a solution.

use super::solution::Solution;
use crate::collocation::{Collocation, GridState};
use crate::error::{Error, ErrorKind, Result, require_finite};
use crate::fourier::TimeGrid;
use crate::model::Model;
use crate::solve::{
    Iteration, Kind, Mode, ModesOptions, ModesSolve, NewtonReport, Outcome, Solved, Stage,
    solve_modes,
};
use nalgebra::{Complex, Vector6};
use std::f64::consts::TAU;
use std::fmt::Write;

/// Points over the period of a motion in a mode: resolves the exponential of turns of a radian to
/// rounding.
const GRID_POINTS: usize = 31;

/// Result of a modal analysis.
#[derive(Debug, Clone)]
pub struct Modes {
    model: Model,
    solve: ModesSolve,
}

impl Modes {
    /// Finds an equilibrium of `model` and the modes about it, see [`solve_modes`].
    pub fn solve(
        model: &Model,
        options: &ModesOptions,
        observe: &mut dyn FnMut(Stage, &Iteration) -> bool,
    ) -> Result<Self> {
        Ok(Modes {
            solve: solve_modes(model, options, observe)?,
            model: model.clone(),
        })
    }

    /// The model.
    pub fn model(&self) -> &Model {
        &self.model
    }

    /// The modes found, in their order.
    pub fn modes(&self) -> &[Mode] {
        &self.solve.modes
    }

    /// Mode number `index`.
    pub fn mode(&self, index: usize) -> Result<&Mode> {
        self.solve.modes.get(index).ok_or_else(|| {
            let count = self.solve.modes.len();
            let message = format!("mode: expected a number below {count}, got {index}");
            Error::new(ErrorKind::Identifier, message)
        })
    }

    /// Shape of a mode at `node`: material increment `[linear; angular]`.
    pub fn shape(&self, mode: usize, node: usize) -> Result<[Complex<f64>; 6]> {
        let mode = self.mode(mode)?;
        self.model.require_node("node", node)?;
        Ok(mode.shape[node])
    }

    /// How the search for the equilibrium ended. Unless it converged there are no modes.
    pub fn outcome(&self) -> Outcome {
        self.solve.equilibrium.report.outcome
    }

    /// Whether all modes asked for were found, or all that there are.
    pub fn is_complete(&self) -> bool {
        self.solve.complete
    }

    /// The equilibrium, converged or not.
    pub fn equilibrium(&self) -> Result<Solution> {
        Solution::of(&self.model, self.solve.equilibrium.clone())
    }

    /// The motion `M exp(a Re(φ exp(iωt)))` from the equilibrium `M` in a mode, for the amplitude
    /// `a`, as a solution with the period `2π/ω`.
    ///
    /// It neither decays nor grows: of the eigenvalue `s` only `ω = Im s` counts. For a real `s`,
    /// `ω = |s|` makes a period of the time constant, and for a free motion the period is that of
    /// the equilibrium.
    ///
    /// # Errors
    /// An unknown mode, or an amplitude so large that a node turns further than the grid can
    /// follow.
    pub fn motion(&self, mode: usize, amplitude: f64) -> Result<Solution> {
        let number = mode;
        let mode = self.mode(number)?;
        require_finite("amplitude", &[amplitude])?;
        let Solved {
            system,
            grid: instant,
            state: still,
            ..
        } = &self.solve.equilibrium;
        let s = mode.eigenvalue;
        let frequency = if s.im != 0.0 { s.im.abs() } else { s.norm() };
        let period = if frequency > 0.0 {
            TAU / frequency
        } else {
            instant.period()
        };
        let grid = TimeGrid::new(GRID_POINTS, period)?;
        let mut state = GridState::reference(system, grid);
        for k in 0..grid.points() {
            state.copy_point(system, k, still, 0);
            let phase = TAU * k as f64 / grid.points() as f64;
            let factor = Complex::from_polar(amplitude, phase);
            let now = |x: &Complex<f64>| (factor * x).re;
            for (node, shape) in mode.shape.iter().enumerate() {
                let increment = Vector6::from_fn(|i, _| now(&shape[i]));
                let motion = &mut state.motions[node * grid.points() + k];
                *motion = motion.increment(&increment).renormalised();
            }
            for placed in system.elements() {
                let values = state.own_of_mut(placed, k);
                for (value, change) in values.iter_mut().zip(&mode.own[placed.first_own..]) {
                    *value += now(change);
                }
            }
        }
        state.track(system);
        let mut equations = Collocation::new(system.clone(), grid)?;
        equations.update_kinematics(&state);
        let what = format!(
            "mode {number} with the amplitude {amplitude}: s = {:.9e} {:+.9e} i",
            s.re, s.im
        );
        let report = NewtonReport::ended(Outcome::Converged, what);
        let states = (state, equations.node_states().to_vec());
        let solve = Solved::known(system, grid, states, report, Kind::SmallMotion);
        Solution::of(&self.model, solve)
    }

    /// Outcome of the equilibrium, and the modes, in readable lines.
    pub fn report(&self) -> String {
        let report = &self.solve.equilibrium.report;
        let mut text = String::new();
        // Writing to a string cannot fail.
        let mut line = |arguments: std::fmt::Arguments| {
            let _ = writeln!(text, "{arguments}");
        };
        line(format_args!(
            "Modal analysis: equilibrium {}, {} modes{}",
            report.outcome.describe(),
            self.solve.modes.len(),
            if self.solve.complete || report.outcome != Outcome::Converged {
                ""
            } else {
                "; not all that were asked for converged"
            }
        ));
        if !report.explanation.is_empty() {
            line(format_args!("  {}", report.explanation));
        }
        if !self.solve.modes.is_empty() {
            line(format_args!(
                "  mode             Re s             Im s        frequency    damping   residual"
            ));
        }
        for (number, mode) in self.solve.modes.iter().enumerate() {
            line(format_args!(
                "  {number:4} {:16.8e} {:16.8e} {:16.8e} {:10.3e} {:10.1e}",
                mode.eigenvalue.re,
                mode.eigenvalue.im,
                mode.frequency(),
                mode.damping_ratio(),
                mode.residual
            ));
        }
        self.model.labels().annotate(&text)
    }
}
