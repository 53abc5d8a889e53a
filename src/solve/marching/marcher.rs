//! A march, step by step.

use crate::collocation::{AlphaStep, Conditions, GeneralizedAlpha, GridState, MotionState};
use crate::error::ErrorKind;
use crate::solve::marching::consistent::Initial;
use crate::solve::marching::options::MarchOptions;
use crate::solve::marching::{Stop, Tried};
use crate::solve::newton::Newton;
use crate::solve::report::{Iteration, NewtonOptions, Outcome};
use crate::solve::result::MarchRecord;
use crate::system::{Scales, System};
use crate::workers::Workers;
use std::sync::Arc;

/// A march on its way.
pub(super) struct Marcher {
    pub newton: Newton,
    pub method: GeneralizedAlpha,
    newton_options: NewtonOptions,
    /// The present state, and the length of the next step.
    step: AlphaStep,
    next: GridState,
    pub record: MarchRecord,
    /// The last iteration of the last step.
    pub last: Iteration,
}

impl Marcher {
    /// From a time's motions and velocities, which are made consistent. `states_given` tells
    /// whether internal states are to be relaxed.
    pub fn new(
        system: &Arc<System>,
        options: &MarchOptions,
        step: f64,
        (start, states_given): (&mut MotionState, bool),
        workers: &Workers,
    ) -> Tried<Self> {
        let mut newton = Newton::at_instant(system, workers)?;
        let method = GeneralizedAlpha::new(options.spectral_radius);
        let mut initial = Initial::new(&mut newton, step);
        let (moved, corrected) = initial.make_consistent(start, states_given, &method)?;
        Ok(Marcher {
            newton,
            method,
            newton_options: options.newton,
            next: start.state.clone(),
            step: AlphaStep::new(method, step, start.clone()),
            record: MarchRecord {
                start_moved: moved,
                start_corrected: corrected,
                ..MarchRecord::new()
            },
            last: Iteration::none(),
        })
    }

    /// The present state.
    pub fn now(&self) -> &MotionState {
        &self.step.start
    }

    /// Goes on from another state.
    pub fn restart(&mut self, start: MotionState) {
        self.step.start = start;
    }

    /// Corrects the present time by its rounding.
    pub fn set_time(&mut self, time: f64) {
        self.step.start.time = time;
    }

    /// Goes on with steps of this length.
    pub fn set_length(&mut self, length: f64) {
        let ratio = length / self.step.length;
        if ratio != 1.0 {
            self.step.start.change_step(ratio);
            self.step.length = length;
        }
    }

    /// Tries one step, with an estimated error of at most `tolerance`, and returns this error; the
    /// present state is then its end. Otherwise says why not, and nothing has changed.
    pub fn step(&mut self, tolerance: f64) -> Tried<f64> {
        let time = self.step.start.time + self.step.length;
        let system = self.newton.equations.system().clone();
        self.newton.equations.set_conditions(Conditions::at(time))?;
        self.step.predict(&mut self.next);
        self.next
            .coordinates
            .copy_from_slice(&self.step.start.state.coordinates);
        let start = &self.step.start;
        let length = self.step.length;
        system.foresee(|n| start.node(n), length, &mut self.next.coordinates);
        self.next.track(&system);
        self.newton.equations.set_rule(Box::new(self.step.clone()));
        let report = self
            .newton
            .solve(&mut self.next, &self.newton_options, &mut |_| true);
        let report = match report {
            Ok(report) => report,
            Err(error) if error.kind() == ErrorKind::Callback => return Err(error.into()),
            // Too distorted: shorter steps may not be.
            Err(error) => return Err(Stop::Refused((Outcome::Stalled, error.to_string()))),
        };
        self.record.iterations += report.iterations.len();
        if let Some(last) = report.iterations.last() {
            self.last = *last;
        }
        if report.outcome == Outcome::Cancelled {
            // Shorter steps are no way out.
            self.newton.equations.workers().pulse()?;
        }
        if report.outcome != Outcome::Converged {
            return Err(Stop::Refused((report.outcome, report.explanation)));
        }
        let equations = &mut self.newton.equations;
        equations.update_kinematics(&self.next);
        equations.reduce_to_least_norm(&mut self.next)?;
        let error = self.step_error(system.scales());
        // Written so that NaN fails too.
        let accepted = error <= tolerance;
        if !accepted {
            let why = "the error stays above the tolerance".into();
            return Err(Stop::Refused((Outcome::Stalled, why)));
        }
        let node_states = self.newton.equations.node_states();
        self.step.advance(&self.next, node_states, |place| {
            system.unknown(place).is_state()
        });
        self.step.start.time = time;
        self.record.steps += 1;
        self.record.step_error = self.record.step_error.max(error);
        Ok(error)
    }

    /// Estimated error of a motion in the step just made: `C h³ v̈`.
    fn step_error(&self, scales: &Scales) -> f64 {
        let h = self.step.length;
        let factor = self.method.error_constant() * h * h;
        let states = self.newton.equations.node_states();
        let rates = states.iter().zip(&self.step.start.twist_rate);
        rates
            .map(|(end, start)| scales.size_of(&((end.twist_rate - start) * factor)))
            .fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solve::marching::options::MarchEnd;
    use crate::system::{Regime, Transient};
    use crate::test_models::pendulums::oscillator;

    #[test]
    fn another_length_of_step_changes_what_it_starts_from() {
        let (model, _) = oscillator();
        let regime = Regime::March(Transient {
            period: Some(2.0),
            duration: 1.0,
            step: 0.1,
        });
        let system = Arc::new(System::in_regime(&model, regime).unwrap());
        let options = MarchOptions::with_step(0.1, MarchEnd::Duration(1.0));
        let mut start = MotionState::at_rest(0.0, GridState::at_points(&system, 1));
        let begun = Marcher::new(
            &system,
            &options,
            0.1,
            (&mut start, true),
            &Workers::default(),
        );
        let Ok(mut marcher) = begun else {
            panic!("the start is consistent");
        };
        marcher.step.start.twist_rate[0][0] = 1.0;
        marcher.step.start.averaged[0][0] = 0.7;
        marcher.set_length(0.2);
        assert!((marcher.now().averaged[0][0] - 0.4).abs() < 1e-15);
        marcher.set_length(0.2);
        assert!((marcher.now().averaged[0][0] - 0.4).abs() < 1e-15);
    }
}
