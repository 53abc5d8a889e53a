//! Where Newton's method begins: ways to start, cheapest first, each with its share of work.
//! See docs/theory.md, section 9.

mod dissipative_march;
pub(crate) mod quasi_static;

use crate::collocation::{Conditions, GridState};
use crate::error::Result;
use crate::fourier::TimeGrid;
use crate::solve::linear::method::DirectCost;
use crate::solve::periodic::Attempts;
use crate::solve::report::{NewtonReport, Outcome};
use crate::solve::start::{Attempt, Start};
use crate::solve::starts::dissipative_march::DissipativeMarch;
use crate::solve::starts::quasi_static::{Guess, inertial_displacement, quasi_static};
use crate::solve::step_length::StepLength;
use crate::system::Driven;
use std::time::Instant;

/// Short steps after which Newton's method is given up where there are other ways to start.
pub(crate) const PATIENCE: usize = 4;
/// Smallest step of the continuation in the inertia factor.
const SMALLEST_INERTIA_STEP: f64 = 1.0 / 16.0;
/// Least and largest number of Newton iterations that this continuation may take, and multiply-adds
/// of their factorisations.
const RAISING: [usize; 2] = [12, 40];
const RAISING_WORK: f64 = 2e10;
/// Periods that a march takes at most.
const MOST_PERIODS: usize = 24;
/// Changes from one period to the next, relative to the characteristic length or in radians, at
/// which Newton's method is tried: from a motion that is still far from periodic it may find one
/// that nobody meant.
const TRIED: [f64; 3] = [5e-2, 5e-3, 1e-3];

/// Periods after which the change is compared with later ones.
const EARLY: usize = 3;

/// Whether a change that has become what it is after `period` periods, at the rate since the early
/// one, falls below `most` in time.
fn settles(early: f64, change: f64, period: usize, most: f64) -> bool {
    let rate = (change / early).ln() / (period - EARLY) as f64;
    let left = (MOST_PERIODS - period) as f64;
    change.ln() + rate * left < most.ln()
}

/// State and report of a Newton solve.
type Found = (GridState, NewtonReport);

impl Attempts<'_> {
    /// The quasi-static start that comes first.
    pub(crate) fn first_start(&self) -> Start {
        match (self.chosen, &self.driven) {
            (Some(start @ (Start::QuasiStatic | Start::SteadyRotation)), _) => start,
            (_, Some(driven)) if driven.is_rigid() => Start::SteadyRotation,
            _ => Start::QuasiStatic,
        }
    }

    /// The ways to start, cheapest first.
    fn starts(&self) -> Vec<Start> {
        if let Some(start) = self.chosen {
            return vec![start];
        }
        let first = self.first_start();
        let mut starts = vec![first];
        if first == Start::SteadyRotation {
            starts.extend([Start::RigidRotation, Start::QuasiStatic]);
        }
        starts.extend([Start::RaisedInertia, Start::March]);
        starts
    }

    /// What turns steadily in a start.
    fn turning(&self, start: Start) -> Option<Driven> {
        let driven = self.driven.as_ref();
        driven.filter(|_| start == Start::SteadyRotation).cloned()
    }

    /// A quasi-static motion at the points of its grid, found at the first call.
    fn quasi_static(&mut self, start: Start) -> Result<&Guess> {
        let at = match self.guesses.iter().position(|(of, _)| *of == start) {
            Some(at) => at,
            None => {
                let (grid, workers) = (self.guess_grid, self.workers.clone());
                let driven = self.turning(start);
                let guess = self.guess(|system, _, observe| {
                    quasi_static(system, grid, driven.as_ref(), &workers, observe)
                })?;
                self.guesses.push((start, guess));
                self.guesses.len() - 1
            }
        };
        Ok(&self.guesses[at].1)
    }

    /// Finds quasi-static motions at the points of another grid from now on.
    pub(crate) fn guess_on(&mut self, grid: TimeGrid) -> Result<()> {
        if self.guess_grid != grid {
            self.guesses
                .retain(|(_, guess)| guess.outcome == Outcome::Cancelled);
        }
        self.guess_grid = grid;
        Ok(())
    }

    /// The first quasi-static motion at the points where it was found, if that is how to start and
    /// there is one.
    pub(crate) fn first_quasi_static(&mut self) -> Result<Option<&GridState>> {
        if !matches!(
            self.chosen,
            None | Some(Start::QuasiStatic | Start::SteadyRotation)
        ) {
            return Ok(None);
        }
        let start = self.first_start();
        self.watching.attempt(0, Some(start));
        let guess = self.quasi_static(start)?;
        Ok((guess.outcome == Outcome::Converged).then_some(&guess.state))
    }

    /// The first quasi-static motion at the points of the present grid, if there is one.
    pub(crate) fn start(&mut self) -> Result<Option<GridState>> {
        self.quasi_static_here(self.first_start())
    }

    fn quasi_static_here(&mut self, start: Start) -> Result<Option<GridState>> {
        let (grid, from) = (self.grid, self.guess_grid);
        let guess = self.quasi_static(start)?;
        if guess.outcome != Outcome::Converged {
            return Ok(None);
        }
        let state = guess.state.clone();
        if grid == from {
            return Ok(Some(state));
        }
        self.carried(&state, from)
    }

    /// How far inertial forces would displace the first quasi-static motion; zero where there is
    /// none.
    pub(crate) fn inertial_displacement(&mut self) -> Result<f64> {
        let (at, start) = (self.guess_grid, self.first_start());
        let guess = self.quasi_static(start)?;
        if guess.outcome != Outcome::Converged {
            return Ok(0.0);
        }
        let state = guess.state.clone();
        let (workers, driven) = (self.workers.clone(), self.turning(start));
        self.guess(|system, _, _| {
            inertial_displacement(system, at, driven.as_ref(), &state, &workers)
        })
    }

    /// From the library's own starts, the quasi-static ones alone.
    pub(crate) fn find_at_once(&mut self) -> Result<Found> {
        let starts = self.starts();
        let quick = |start: &Start| !matches!(start, Start::RaisedInertia | Start::March);
        let quick: Vec<Start> = starts.iter().copied().filter(quick).collect();
        self.find_from(if quick.is_empty() { &starts } else { &quick })
    }

    /// From the library's own starts.
    pub(crate) fn find(&mut self) -> Result<Found> {
        let starts = self.starts();
        self.find_from(&starts)
    }

    fn find_from(&mut self, starts: &[Start]) -> Result<Found> {
        let mut left: Option<Found> = None;
        for (number, &start) in starts.iter().enumerate() {
            let others = number + 1 < starts.len();
            self.newton.patience = others.then_some(PATIENCE);
            self.watching.attempt(self.tried.len() + 1, Some(start));
            let (began, guessed) = (Instant::now(), self.guess_iterations);
            let before = self.newton.iterations;
            let found = self.find_by(start);
            self.newton.patience = None;
            let Some((state, report)) = found? else {
                continue;
            };
            self.tried.push(Attempt {
                start,
                points: self.grid.points(),
                guess_iterations: self.guess_iterations - guessed,
                iterations: self.newton.iterations - before,
                time: began.elapsed(),
                outcome: report.outcome,
                explanation: report.explanation.clone(),
            });
            if report.outcome.is_final() {
                return Ok((state, report));
            }
            // What stopped Newton's method on the grid says more than why there was no start.
            if left.is_none() || !report.iterations.is_empty() {
                left = Some((state, report));
            }
        }
        Ok(left.unwrap_or_else(|| {
            let report = NewtonReport {
                outcome: Outcome::NoInitialGuess,
                iterations: Vec::new(),
                explanation: "there is no such start".into(),
            };
            (GridState::reference(&self.system, self.grid), report)
        }))
    }

    /// By one way; `None` where it cannot be gone.
    fn find_by(&mut self, start: Start) -> Result<Option<Found>> {
        match start {
            Start::QuasiStatic | Start::SteadyRotation => self.by_quasi_static(start).map(Some),
            Start::RigidRotation => match self.rigid_rotation()? {
                Some(state) => self.newton(state).map(Some),
                None => Ok(None),
            },
            Start::RaisedInertia => match self.quasi_static_here(Start::QuasiStatic)? {
                Some(state) => self.through_inertia(state),
                None => Ok(None),
            },
            Start::March => self.through_march(),
        }
    }

    fn by_quasi_static(&mut self, start: Start) -> Result<Found> {
        if let Some(state) = self.quasi_static_here(start)? {
            return self.newton(state);
        }
        let (system, grid) = (self.system.clone(), self.grid);
        let guess = self.quasi_static(start)?;
        let outcome = match guess.outcome {
            Outcome::Cancelled
            | Outcome::Singular
            | Outcome::Inconsistent
            | Outcome::WrongAssembly => guess.outcome,
            _ => Outcome::NoInitialGuess,
        };
        let report = NewtonReport {
            outcome,
            iterations: Vec::new(),
            explanation: guess.explanation.clone(),
        };
        let state = if guess.state.points() == grid.points() {
            guess.state.clone()
        } else {
            GridState::reference(&system, grid)
        };
        Ok((state, report))
    }

    /// All that hangs on drives turned with them, if the joints let it.
    fn rigid_rotation(&self) -> Result<Option<GridState>> {
        let Some(driven) = self.driven.as_ref().filter(|driven| driven.is_rigid()) else {
            return Ok(None);
        };
        let (system, points) = (&self.system, self.grid.points());
        let mut state = GridState::reference(system, self.grid);
        let mut signals = vec![0.0; system.signals()];
        for k in 0..points {
            system.signal_values(self.grid.time(k), 1.0, &mut signals)?;
            for (node, reference) in system.reference().iter().enumerate() {
                state.motions[node * points + k] = driven.carried(node, reference, &signals);
            }
        }
        state.track(system);
        Ok(Some(state))
    }

    /// Whether the fewest iterations of one more way to start on this grid are little work.
    pub(crate) fn affords_more(&self) -> bool {
        let work = DirectCost::of(&self.system, self.grid.points()).work;
        RAISING[0] as f64 * work <= RAISING_WORK
    }

    /// Raises the inertial forces in steps, from a solution without them.
    fn through_inertia(&mut self, mut state: GridState) -> Result<Option<Found>> {
        let mut reached = 0.0f64;
        let mut step = StepLength::halved(0.25, SMALLEST_INERTIA_STEP..=1.0);
        let before = self.newton.iterations;
        let work = DirectCost::of(&self.system, self.grid.points()).work;
        let most = ((RAISING_WORK / work) as usize).clamp(RAISING[0], RAISING[1]);
        let mut found = None;
        while reached < 1.0 {
            let next = (reached + step.get()).min(1.0);
            let mut goes_on = true;
            self.newton.equations.set_conditions(Conditions {
                inertia_factor: next,
                ..Conditions::at(0.0)
            })?;
            let (trial, report) = self.newton(state.clone())?;
            match report.outcome {
                Outcome::Converged => {
                    state = trial;
                    reached = next;
                    step.grow(step.get(), 1.5);
                    found = Some((state.clone(), report));
                }
                Outcome::Cancelled => {
                    found = Some((trial, report));
                    break;
                }
                _ => goes_on = step.shrink(step.get()),
            }
            let spent = self.newton.iterations - before;
            if reached < 1.0 && (!goes_on || spent > most) {
                let explanation = format!("ended at the fraction {reached:.3} of inertial forces");
                let report = NewtonReport {
                    outcome: Outcome::Stalled,
                    iterations: Vec::new(),
                    explanation,
                };
                found = Some((state, report));
                break;
            }
        }
        self.newton.equations.set_conditions(Conditions::at(0.0))?;
        Ok(found)
    }

    /// Marches in time, and tries Newton's method from its periods now and then.
    fn through_march(&mut self) -> Result<Option<Found>> {
        let start = match self.quasi_static_here(Start::QuasiStatic)? {
            Some(state) => Some(state),
            None => self.rigid_rotation()?,
        };
        let (system, workers) = (&self.system, &self.workers);
        let mut march = DissipativeMarch::new(system, self.grid, start.as_ref(), workers)?;
        let mut found: Option<Found> = None;
        let mut tries = TRIED.iter().peekable();
        let mut early = f64::INFINITY;
        for period in 1..=MOST_PERIODS {
            let marched = self.guess(|_, _, observe| march.go_on(observe))?;
            let state = match marched {
                Ok(state) => state,
                Err((outcome, explanation)) => {
                    let report = NewtonReport {
                        outcome,
                        iterations: Vec::new(),
                        explanation,
                    };
                    let state = GridState::reference(&self.system, self.grid);
                    return Ok(found.or(Some((state, report))));
                }
            };
            let change = march.change();
            if period == EARLY {
                early = change;
            }
            // What does not settle soon enough is tried once, as it is.
            let is_last = period == MOST_PERIODS
                || (period >= 2 * EARLY && !settles(early, change, period, TRIED[0]));
            let is_near = tries.next_if(|most| change < **most).is_some();
            if !is_near && !is_last {
                continue;
            }
            while tries.next_if(|most| march.change() < **most).is_some() {}
            let next = self.newton(state)?;
            if next.1.outcome.is_final() || is_last || tries.peek().is_none() {
                return Ok(Some(next));
            }
            found = Some(next);
        }
        Ok(found)
    }
}
