//! Newton's method with the exact tangent and a line search that does not depend on scaling.
//! See docs/theory.md, section 7.1.

pub(crate) mod assembly;
pub(crate) mod branch;
mod chord;
mod line_search;
pub(crate) mod norms;
pub(crate) mod on_grid;
mod run;
mod scalars;
mod verdict;
mod watchdog;

use crate::collocation::{Collocation, GridState, Leaders, TimeRule};
use crate::error::Result;
use crate::fourier::TimeGrid;
use crate::memory;
use crate::solve::linear::assembled::Assembled;
use crate::solve::linear::cost::tangent_bytes;
use crate::solve::linear::solver::{COARSE, ESTIMATE, LinearSolver};
use crate::solve::memory::of_grid;
use crate::solve::newton::assembly::describe_turned_over;
use crate::solve::report::{Iteration, NewtonOptions, NewtonReport, Outcome, Timings, timed};
use crate::system::System;
use crate::work::{LINEARISATION, Work};
use crate::workers::Workers;
use nalgebra::Vector6;
use norms::{norm, norm_of_wave};
use run::Run;
pub use scalars::solve_with_scalars;
use std::sync::Arc;
use verdict::Ending;
pub(crate) use verdict::SINGULAR_GROWTH;

/// Error that the last step may leave in multipliers, and in motions after steps with the same
/// matrix, relative to the tolerance.
const ERROR_LEFT: f64 = 1e-3;
/// Largest contraction, from one increment to the next with the same matrix, that leaves its
/// determinant as it is.
const FAITHFUL: f64 = 0.05;
/// The finest that is asked for.
const FINEST: f64 = 1e-8;
/// Accuracy relative to the last increment, so that convergence stays quadratic.
const FORCING: f64 = 0.1;

/// That all work was done that may be.
fn describe_work(work: &Work) -> String {
    format!(
        "{:.1e} operations were done, and options.work_limit allows {:.1e}",
        work.done(),
        work.most()
    )
}

/// Matrices and factors of the equations at an instant, in terms of the tangents.
const AT_INSTANT: f64 = 3.0;

/// A point on the way to what is looked for.
#[derive(Debug)]
pub(crate) struct Waypoint {
    /// An increment that is no longer leads there. If that is more than the tolerance, stress
    /// resultants go along with it.
    pub enough: f64,
    /// Stress resultants that the first geometric stiffness is taken at; those of the strains if
    /// there are none.
    pub resultants: Vec<Vector6<f64>>,
}

/// Newton solver for one system and grid; keeps everything that can be used again.
#[derive(Debug)]
pub(crate) struct Newton<L = Assembled> {
    /// The equations.
    pub equations: Collocation,
    /// What solves them, linearised.
    pub linear: L,
    /// What the second increment with the same Jacobian was relative to the first, or the first
    /// where that was so small that it was the last; none if neither is known.
    contraction: Option<f64>,
    /// Steps with the same matrix that are worth no other one.
    pub chords: i32,
    /// Whether stretching has hidden the progress of steps with the same matrix: then stress
    /// resultants are unknowns of their own from the first one on, if solutions are accurate.
    stretches: bool,
    /// Whether the Jacobian is taken to be regular where a solve begins, as next to where it was.
    pub trusts: bool,
    /// What is to be looked at of the last solution, where blades are alike.
    pub alike: Option<Arc<Leaders>>,
    /// Whether solutions only lead to others: where blades are alike, the others than one are not
    /// looked at then.
    pub is_on_the_way: bool,
    /// Whether the next iteration is by the matrix of the last one.
    keeps_matrix: bool,
    /// Short steps after which it is given up, if there are other ways.
    pub patience: Option<usize>,
    /// Iterations since this object was made.
    pub iterations: usize,
    /// Time spent since this object was made.
    pub timings: Timings,
}

/// Bytes that a solve on a grid of one point takes, with its linear equations.
pub(crate) fn bytes_at_instant(system: &System) -> usize {
    of_grid(system, 1).saturating_add((AT_INSTANT * tangent_bytes(system, 1)) as usize)
}

impl Newton {
    /// A solver for `equations` that assembles and factors their Jacobian.
    pub fn new(equations: Collocation) -> Self {
        let mut timings = Timings::default();
        let linear = timed(&mut timings.analysis, || Assembled::new(&equations));
        Newton {
            timings,
            ..Newton::with(equations, linear)
        }
    }

    /// The same for a grid of one point: an equilibrium, or a step in time.
    pub fn at_instant(system: &Arc<System>, workers: &Workers) -> Result<Self> {
        let instant = TimeGrid::new(1, system.period())?;
        memory::require("the equations at an instant", bytes_at_instant(system))?;
        let mut equations = Collocation::new(system.clone(), instant)?;
        equations.set_workers(workers.clone());
        Ok(Newton::new(equations))
    }

    /// Sign of the Jacobian's determinant at `state`, where the last solve ended, and logarithm of
    /// its size; none if it is singular.
    pub fn determinant(&mut self, state: &GridState) -> Result<Option<(f64, f64)>> {
        if self.contraction.is_some() && self.contracts() {
            return Ok(Some(self.linear.determinant()));
        }
        let regular = self.linearise(state)?;
        Ok(regular.then(|| self.linear.determinant()))
    }

    /// Largest increment of a motion that the equations with the rates of another rule ask for,
    /// with the Jacobian of the present one; none if that is singular.
    pub fn displacement_at(
        &mut self,
        state: &GridState,
        rates: Box<dyn TimeRule>,
    ) -> Result<Option<f64>> {
        let regular = self.linearise(state)?;
        let mut increment = vec![0.0; self.equations.size()];
        let rule = self.equations.set_rule(rates);
        let residual = self.equations.residual(state, &mut increment);
        self.equations.set_rule(rule);
        residual?;
        let solved = regular && self.solve_linear(&mut increment, COARSE)?;
        Ok(solved.then(|| self.norm(&increment)))
    }

    /// Growth of the factored Jacobian, see [`LinearSolver::growth`].
    pub fn growth(&mut self) -> f64 {
        self.linear.growth(&mut self.equations)
    }
}

impl<L: LinearSolver> Newton<L> {
    /// A solver for `equations` by `linear`.
    pub fn with(equations: Collocation, linear: L) -> Self {
        Newton {
            linear,
            contraction: None,
            alike: None,
            is_on_the_way: false,
            keeps_matrix: false,
            patience: None,
            trusts: false,
            stretches: false,
            chords: chord::STEPS,
            iterations: 0,
            equations,
            timings: Timings::default(),
        }
    }

    /// Turns scaled forces and constraints into the increment of the scaled unknowns that they
    /// cause, with the Jacobian of the last linearisation, and gives its largest motion; none if
    /// that is singular.
    pub fn response(&mut self, scaled: &mut [f64]) -> Result<Option<f64>> {
        let solved = self.solve_linear(scaled, ESTIMATE)?;
        let largest = self.norm(scaled);
        Ok((solved && largest.is_finite()).then_some(largest))
    }

    /// The same of equations of a wave.
    pub fn response_of_wave(&mut self, scaled: &mut [f64]) -> Result<Option<f64>> {
        let solved = self.solve_linear(scaled, ESTIMATE)?;
        let largest = norm_of_wave(self.equations.layout(), scaled);
        Ok((solved && largest.is_finite()).then_some(largest))
    }

    /// Largest motion of a scaled increment.
    fn norm(&self, scaled: &[f64]) -> f64 {
        norm(self.equations.layout(), scaled)
    }

    /// Evaluates velocities and accelerations at the last solution, if they are not there.
    pub fn update_kinematics(&mut self, state: &GridState) {
        (self.equations).ensure_kinematics(self.alike.clone(), state);
    }

    /// Counts an evaluation that takes so much for each number at a node and grid point.
    fn count_evaluation(&self, work: f64) {
        let numbers = self.equations.layout().motions().len() as f64;
        self.equations.workers().work().spend(work * numbers);
    }

    /// Whether the Jacobian of the last linearisation is nearly that where the last solve has
    /// converged.
    pub fn contracts(&self) -> bool {
        // Without another increment that linearisation was as good as there.
        self.contraction.is_none_or(|c| c <= FAITHFUL)
    }

    /// Linearises the equations at `state`. `false` if they are singular.
    pub fn linearise(&mut self, state: &GridState) -> Result<bool> {
        self.count_evaluation(LINEARISATION);
        self.equations.forget_linearised_residual();
        self.linear
            .linearise(&mut self.equations, state, &mut self.timings)
    }

    /// Solves from `state`, which becomes the solution or the last iterate.
    ///
    /// `observe` sees each iteration and returns `false` to cancel.
    ///
    /// # Errors
    /// If the equations cannot be evaluated at the start, or memory runs out.
    pub fn solve(
        &mut self,
        state: &mut GridState,
        options: &NewtonOptions,
        observe: &mut dyn FnMut(&Iteration) -> bool,
    ) -> Result<NewtonReport> {
        Ok(self.find(state, options, None, observe)?.0)
    }

    /// Goes on from where [`Newton::solve`] has converged last, with the matrix that it ended with
    /// while that serves.
    pub fn go_on(
        &mut self,
        state: &mut GridState,
        options: &NewtonOptions,
        observe: &mut dyn FnMut(&Iteration) -> bool,
    ) -> Result<NewtonReport> {
        self.keeps_matrix = true;
        self.equations.forget_linearised_residual();
        self.solve(state, options, observe)
    }

    /// As [`Newton::solve`], to a point on the way: whether the multipliers have converged with the
    /// motions does not matter. Gives also the stress resultants with which the way goes on, those
    /// of the strains if there are none.
    pub(crate) fn approach(
        &mut self,
        state: &mut GridState,
        options: &NewtonOptions,
        waypoint: Waypoint,
        observe: &mut dyn FnMut(&Iteration) -> bool,
    ) -> Result<(NewtonReport, Vec<Vector6<f64>>)> {
        self.find(state, options, Some(waypoint), observe)
    }

    fn find(
        &mut self,
        state: &mut GridState,
        options: &NewtonOptions,
        waypoint: Option<Waypoint>,
        observe: &mut dyn FnMut(&Iteration) -> bool,
    ) -> Result<(NewtonReport, Vec<Vector6<f64>>)> {
        let mut iterations = Vec::new();
        self.linear.prepare(&mut self.equations, state);
        let workers = self.equations.workers().clone();
        let was_bounded = workers.work().bound(true);
        let mut run = Run::new(self, state, options, &mut iterations, observe);
        run.approach(waypoint);
        let mut end = run.iterate();
        self.alike = self.equations.set_leaders(None);
        let looks_at_all = self.alike.is_some() && !self.is_on_the_way;
        let converged = |end: &Ending| end.outcome == Outcome::Converged;
        if looks_at_all && end.as_ref().is_ok_and(converged) {
            let mut run = Run::new(self, state, options, &mut iterations, observe);
            end = run
                .complete()
                .map(|ending| ending.unwrap_or(Ending::plain(Outcome::Converged)));
        }
        let resultants = self.equations.take_resultants();
        let is_spent = workers.work().is_spent();
        workers.work().bound(was_bounded);
        let ending = match end {
            Err(_) if workers.is_stopped() => Ending::plain(Outcome::Cancelled),
            Err(_) if is_spent => Ending::new(Outcome::WorkLimit, describe_work(workers.work())),
            end => end?,
        };
        self.iterations += iterations.len();
        let mut report = NewtonReport {
            outcome: ending.outcome,
            iterations,
            explanation: ending.explanation,
        };
        // Some are singular where they are turned over.
        if matches!(report.outcome, Outcome::Converged | Outcome::Singular)
            && let Some(why) = describe_turned_over(self.equations.system(), state)
        {
            report.outcome = Outcome::WrongAssembly;
            report.explanation = why;
        }
        Ok((report, resultants))
    }

    /// Solves with the factored Jacobian.
    ///
    /// Where constraints have a compliance, takes back what that lets them open: motions are then
    /// those of the exact Jacobian, and the line search, which looks at motions only, does not take
    /// compliance for distance.
    pub(crate) fn solve_linear(&mut self, rhs: &mut [f64], accuracy: f64) -> Result<bool> {
        let (equations, timings) = (&mut self.equations, &mut self.timings);
        let solved = self.linear.solve(equations, rhs, accuracy, timings)?;
        equations.workers().pulse()?;
        if !solved {
            return Ok(false);
        }
        if equations.is_regularised() && self.linear.has_compliance() {
            let mut rest = vec![0.0; rhs.len()];
            equations.compliance_of(rhs, &mut rest);
            let solved = (self.linear).solve(equations, &mut rest, accuracy, timings)?;
            equations.workers().pulse()?;
            if !solved {
                return Ok(false);
            }
            rhs.iter_mut().zip(&rest).for_each(|(x, d)| *x += d);
        }
        Ok(true)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Model;
    use crate::test_models::parts::{ball, join, rotation1, spring};
    use crate::test_models::pendulums::oscillator;
    use crate::workers::Workers;
    use nalgebra::Vector3;
    use periodyn::elements::JointKind;

    /// Two hinges, on the spring of one of which less and less is left.
    #[test]
    fn growth_tells_how_soft_the_softest_motion_is() {
        let growth = |softness: f64| {
            let mut model = Model::new();
            for stiffness in [1.0, softness] {
                let body = [None, Some(ball(&mut model, 1.0, 1.0, &Vector3::zeros()))];
                let (centre, axis) = (Vector3::zeros(), Vector3::x());
                let hinge = join(&mut model, JointKind::Revolute, body, &centre, &axis);
                spring(&mut model, rotation1(hinge), stiffness, 0.0);
            }
            let system = Arc::new(System::new(&model, 1.0).unwrap());
            let mut newton = Newton::at_instant(&system, &Workers::default()).unwrap();
            let state = GridState::reference(&system, newton.equations.grid());
            assert!(newton.linearise(&state).unwrap());
            newton.growth()
        };
        let [hard, soft, none] = [1.0, 1e-6, 1e-18].map(growth);
        assert!(hard > 0.1 && hard < 1e3, "{hard}");
        assert!(soft > 1e4 * hard && soft < SINGULAR_GROWTH, "{soft}");
        assert!(none > SINGULAR_GROWTH, "{none}");
    }

    #[test]
    fn an_instant_takes_its_unknowns_and_their_equations() {
        let (model, _) = oscillator();
        let system = System::new(&model, 1.0).unwrap();
        let unknowns = system.layout(1).size();
        let entries = unknowns * size_of::<f64>();
        assert!(bytes_at_instant(&system) > of_grid(&system, 1).max(10 * entries));
    }
}
