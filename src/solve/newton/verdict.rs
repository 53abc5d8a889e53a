//! How a solve ends, and why; singular equations among others (docs/theory.md, section 7.5).

use super::Newton;
use crate::collocation::{Collocation, GridState};
use crate::solve::linear::diagnosis::{Singularity, describe_inconsistency, describe_open_joint};
use crate::solve::linear::solver::LinearSolver;
use crate::solve::report::{NewtonOptions, Outcome, timed};

/// Growth that means a singular matrix.
pub(crate) const SINGULAR_GROWTH: f64 = 1e15;
/// Growth that does so where Newton's method stalls: off the constraints by rounding, a freedom is
/// resisted by as much.
pub(super) const STALLED_GROWTH: f64 = 1e13;
/// Violation of constraints (relative to the size of the mechanism, or in radians) that rounding of
/// the user's geometry excuses, where constraints depend on each other.
const VIOLATION: f64 = 1e-8;

/// How a solve ends.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Ending {
    pub outcome: Outcome,
    /// Why it ended so, where there is more to say.
    pub explanation: String,
}

impl Ending {
    pub fn new(outcome: Outcome, explanation: String) -> Self {
        Ending {
            outcome,
            explanation,
        }
    }

    /// Where there is no more to say.
    pub fn plain(outcome: Outcome) -> Self {
        Ending::new(outcome, String::new())
    }
}

/// What to do about a Jacobian that is singular.
#[derive(Debug, PartialEq)]
pub(super) enum Verdict {
    /// Constraints depend on each other: go on with a compliance of theirs.
    Regularise,
    /// Give it up.
    End(Ending),
    /// It is not known why.
    Unknown(String),
}

impl Verdict {
    fn of(singularity: Singularity, is_regularised: bool) -> Self {
        match singularity {
            Singularity::Redundant(_) if !is_regularised => Verdict::Regularise,
            Singularity::Free(why) | Singularity::Redundant(why) => {
                Verdict::End(Ending::new(Outcome::Singular, why))
            }
            Singularity::Unsolved(why) => Verdict::Unknown(why),
        }
    }
}

impl<L: LinearSolver> Newton<L> {
    /// Whether the Jacobian, by which equations were solved, is singular after all: if it grows by
    /// this, see [`LinearSolver::growth`].
    pub(super) fn is_singular(&mut self, growth: f64) -> bool {
        let (linear, equations) = (&mut self.linear, &mut self.equations);
        timed(&mut self.timings.substitution, || {
            linear.growth(equations) > growth && !linear.is_resisted(equations)
        })
    }

    /// What to do about a Jacobian that is singular at `state`. Where constraints depend on each
    /// other, they get a compliance.
    pub(super) fn judge_singular(&mut self, state: &GridState) -> Verdict {
        let (linear, equations) = (&mut self.linear, &mut self.equations);
        let why = timed(&mut self.timings.estimates, || {
            linear.explain(equations, state)
        });
        let verdict = Verdict::of(why, self.equations.is_regularised());
        if verdict == Verdict::Regularise {
            self.equations.regularise();
        }
        verdict
    }
}

/// Equations whose solution ends, and what is left of them.
pub(super) struct Left<'a> {
    pub equations: &'a Collocation,
    pub residual: &'a [f64],
    pub options: &'a NewtonOptions,
}

impl Left<'_> {
    /// Whether constraints that depend on each other are left open.
    pub fn is_contradicted(&self) -> bool {
        self.equations.is_regularised()
            && self.equations.violation(self.residual) > self.options.tolerance.max(VIOLATION)
    }

    /// The end where they are and nothing moves any more. Before that they may be open because a
    /// solution is far.
    pub fn contradiction(&self) -> Option<Ending> {
        self.is_contradicted().then(|| {
            let why = describe_inconsistency(self.equations, self.residual);
            Ending::new(Outcome::Inconsistent, why)
        })
    }

    /// The end where no step by an increment of this size brings progress.
    pub fn stalled(&self, increment: f64) -> Ending {
        let why = format!(
            "no step along the Newton direction brings progress; the last increment is \
             {increment:.3e}{}{}",
            describe_open_joint(self.equations, self.residual),
            self.describe_open_condition()
        );
        Ending::new(Outcome::Stalled, why)
    }

    /// The end where no more iterations are allowed.
    pub fn exhausted(&self) -> Ending {
        let why = format!(
            "not converged after {} iterations{}{}",
            self.options.iteration_limit,
            describe_open_joint(self.equations, self.residual),
            self.describe_open_condition()
        );
        Ending::new(Outcome::IterationLimit, why)
    }

    /// The condition that is least met; empty if all are.
    fn describe_open_condition(&self) -> String {
        let Some(scalars) = self.equations.scalars() else {
            return String::new();
        };
        let all = self.residual[self.equations.layout().scalars()].iter();
        let worst = all
            .enumerate()
            .max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
        match worst {
            Some((index, left)) if left.abs() > self.options.tolerance => format!(
                "; {} is off by {:.2e} of its scale: it may not be possible to meet it",
                scalars.describe_equation(index),
                left.abs()
            ),
            _ => String::new(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::elements::{Coordinate, JointKind};
    use crate::fourier::TimeGrid;
    use crate::model::{JointCoordinate, Model, Signal};
    use crate::motion::Motion;
    use crate::solve::report::NewtonReport;
    use crate::system::System;
    use nalgebra::{Matrix3, Vector3};
    use std::f64::consts::TAU;
    use std::sync::Arc;

    /// A body on hinges about the z-axis, of which the second misses it by `gap`, turned or free.
    fn body_on_hinges(hinges: usize, gap: f64, is_driven: bool) -> Newton {
        let mut model = Model::new();
        let (centre, ball) = (Vector3::x(), Matrix3::identity());
        let body = model.add_rigid_body(1.0, &centre, &ball).unwrap();
        for hinge in 0..hinges {
            let place = Vector3::z() * hinge as f64;
            let frame = Model::frame_at("axis", &place, &Vector3::z()).unwrap();
            let off = Vector3::x() * (gap * hinge as f64);
            let ground = Motion::new(frame.rotation, place + off);
            model
                .add_joint(JointKind::Revolute, None, Some(body), &ground, &frame)
                .unwrap();
        }
        if is_driven {
            let turn = Signal::harmonics(0.0, 1.0, &[0.0], &[0.3]).unwrap();
            let at = JointCoordinate {
                joint: 0,
                coordinate: Coordinate::Rotation1,
            };
            model.prescribe(at, &turn).unwrap();
        }
        let system = Arc::new(System::new(&model, TAU).unwrap());
        Newton::new(Collocation::new(system, TimeGrid::new(5, TAU).unwrap()).unwrap())
    }

    fn solve(mut newton: Newton) -> NewtonReport {
        let options = NewtonOptions {
            tolerance: 1e-9,
            iteration_limit: 20,
        };
        let grid = newton.equations.grid();
        let mut state = GridState::reference(newton.equations.system(), grid);
        newton.solve(&mut state, &options, &mut |_| true).unwrap()
    }

    #[test]
    fn what_is_free_to_move_is_named() {
        let report = solve(body_on_hinges(1, 0.0, false));
        assert_eq!(report.outcome, Outcome::Singular);
        let why = &report.explanation;
        assert!(why.contains("node 0 is free to move"), "{why}");
        assert!(report.iterations.is_empty());
        let mut newton = body_on_hinges(1, 0.0, false);
        let grid = newton.equations.grid();
        let state = GridState::reference(newton.equations.system(), grid);
        newton.linearise(&state).unwrap();
        let end = Verdict::End(Ending::new(Outcome::Singular, why.clone()));
        assert_eq!(newton.judge_singular(&state), end);
    }

    #[test]
    fn constraints_that_depend_on_each_other_are_let_off_unless_they_contradict() {
        assert_eq!(
            solve(body_on_hinges(1, 0.0, true)).outcome,
            Outcome::Converged
        );
        assert_eq!(
            solve(body_on_hinges(2, 0.0, true)).outcome,
            Outcome::Converged
        );
        let report = solve(body_on_hinges(2, 1e-3, true));
        assert_eq!(report.outcome, Outcome::Inconsistent);
        let why = &report.explanation;
        assert!(
            why.contains("1.00e-3") || why.contains("stays open"),
            "{why}"
        );
    }

    #[test]
    fn they_get_a_compliance_once() {
        let redundant = || Singularity::Redundant("of joints".into());
        assert_eq!(Verdict::of(redundant(), false), Verdict::Regularise);
        let end = Ending::new(Outcome::Singular, "of joints".into());
        assert_eq!(Verdict::of(redundant(), true), Verdict::End(end));
        let unsolved = Singularity::Unsolved("by iteration".into());
        let unknown = Verdict::Unknown("by iteration".into());
        assert_eq!(Verdict::of(unsolved, false), unknown);
    }
}
