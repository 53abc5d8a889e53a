//! Where Newton's method begins: ways to start, cheapest first, each with its share of work.
//! See docs/theory.md, section 9.

mod dissipative_march;
mod in_steps;
mod quasi_static;
pub(crate) mod tracker;

use crate::collocation::GridState;
use crate::error::Result;
use crate::fourier::TimeGrid;
use crate::solve::newton::on_grid::{Found, OnGrid};
use crate::solve::report::{NewtonReport, Outcome};
use crate::solve::start::{Attempt, Start};
use crate::system::{Driven, System};
use dissipative_march::DissipativeMarch;
pub(crate) use in_steps::affords_more;
use in_steps::{lowered_damping, raised_inertia, raised_loads};
use quasi_static::{Guess, inertial_displacement, quasi_static};
use std::sync::Arc;
use std::time::Instant;

/// Short steps after which Newton's method is given up where there are other ways to start, and
/// from the last of several.
pub(crate) const PATIENCE: usize = 4;
const LAST_PATIENCE: usize = 8;
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

/// The library's own ways to start, and what came of them.
pub(crate) struct Starts {
    /// Where quasi-static motions are found.
    pub grid: TimeGrid,
    /// The quasi-static motions that were found, or not.
    found: Vec<(Start, Guess)>,
    /// What turns with drives.
    driven: Option<Driven>,
    /// How to start, if the user says so.
    chosen: Option<Start>,
    /// What was tried.
    pub tried: Vec<Attempt>,
}

impl Starts {
    pub fn new(system: &Arc<System>, grid: TimeGrid, chosen: Option<Start>) -> Result<Self> {
        Ok(Starts {
            grid,
            found: Vec::new(),
            driven: system.driven()?,
            chosen,
            tried: Vec::new(),
        })
    }

    /// Whether a quasi-static motion comes first.
    pub fn is_quasi_static(&self) -> bool {
        matches!(
            self.chosen,
            None | Some(Start::QuasiStatic | Start::SteadyRotation)
        )
    }

    /// The quasi-static start that comes first.
    pub fn first(&self) -> Start {
        match (self.chosen, &self.driven) {
            (Some(start @ (Start::QuasiStatic | Start::SteadyRotation)), _) => start,
            (_, Some(driven)) if driven.is_rigid() => Start::SteadyRotation,
            _ => Start::QuasiStatic,
        }
    }

    /// The ways to start, cheapest first.
    fn all(&self) -> Vec<Start> {
        if let Some(start) = self.chosen {
            return vec![start];
        }
        let first = self.first();
        let mut starts = vec![first];
        if first == Start::SteadyRotation {
            starts.extend([Start::RigidRotation, Start::QuasiStatic]);
        }
        starts.extend([
            Start::RaisedInertia,
            Start::March,
            Start::LoweredDamping,
            Start::RaisedLoads,
        ]);
        starts
    }

    /// What turns steadily in a start.
    fn turning(&self, start: Start) -> Option<Driven> {
        let driven = self.driven.as_ref();
        driven.filter(|_| start == Start::SteadyRotation).cloned()
    }

    /// Finds quasi-static motions at the points of another grid from now on.
    pub fn move_to(&mut self, grid: TimeGrid) {
        if self.grid != grid {
            self.found.retain(|(_, guess)| guess.outcome.is_stopped());
        }
        self.grid = grid;
    }

    /// A quasi-static motion at the points of its grid, found at the first call.
    fn quasi_static(&mut self, on: &mut OnGrid, start: Start) -> Result<&Guess> {
        let at = match self.found.iter().position(|(of, _)| *of == start) {
            Some(at) => at,
            None => {
                let (grid, workers) = (self.grid, on.means.workers.clone());
                let driven = self.turning(start);
                let guess = on.look_for_start(|system, observe| {
                    quasi_static(system, grid, driven.as_ref(), &workers, observe)
                })?;
                self.found.push((start, guess));
                self.found.len() - 1
            }
        };
        Ok(&self.found[at].1)
    }

    /// The first quasi-static motion at the points where it was found, if that is how to start and
    /// there is one.
    pub fn first_where_found(&mut self, on: &mut OnGrid) -> Result<Option<&GridState>> {
        if !self.is_quasi_static() {
            return Ok(None);
        }
        let start = self.first();
        on.watching.attempt(0, Some(start));
        let guess = self.quasi_static(on, start)?;
        Ok((guess.outcome == Outcome::Converged).then_some(&guess.state))
    }

    /// The same, if it has been looked for before.
    pub fn first_found(&self) -> Option<(TimeGrid, &GridState)> {
        let first = self.first();
        let (_, guess) = self.found.iter().find(|(of, _)| *of == first)?;
        (guess.outcome == Outcome::Converged).then_some((self.grid, &guess.state))
    }

    /// A quasi-static motion at the points of the present grid, if there is one.
    pub fn quasi_static_here(
        &mut self,
        on: &mut OnGrid,
        start: Start,
    ) -> Result<Option<GridState>> {
        let from = self.grid;
        let guess = self.quasi_static(on, start)?;
        if guess.outcome != Outcome::Converged {
            return Ok(None);
        }
        if on.grid == from {
            return Ok(Some(guess.state.clone()));
        }
        on.carried_alike(&guess.state, from)
    }

    /// The first quasi-static motion at the points of another grid, if that is how to start and
    /// there is one.
    pub fn followed(&mut self, on: &mut OnGrid, grid: TimeGrid) -> Result<Option<GridState>> {
        if !self.is_quasi_static() {
            return Ok(None);
        }
        let (workers, driven) = (on.means.workers.clone(), self.turning(self.first()));
        let guess = on.look_for_start(|system, observe| {
            quasi_static(system, grid, driven.as_ref(), &workers, observe)
        })?;
        Ok((guess.outcome == Outcome::Converged).then_some(guess.state))
    }

    /// How far inertial forces would displace the first quasi-static motion; zero where there is
    /// none.
    pub fn inertial_displacement(&mut self, on: &mut OnGrid) -> Result<f64> {
        let (at, start, driven) = (self.grid, self.first(), self.turning(self.first()));
        let guess = self.quasi_static(on, start)?;
        if guess.outcome != Outcome::Converged {
            return Ok(0.0);
        }
        let workers = on.means.workers.clone();
        on.look_for_start(|system, _| {
            inertial_displacement(system, at, driven.as_ref(), &guess.state, &workers)
        })
    }

    /// Solves from the quasi-static starts and rigid rotation alone.
    pub fn solve_at_once(&mut self, on: &mut OnGrid) -> Result<Found> {
        let all = self.all();
        let quick: Vec<Start> = all.iter().copied().filter(Start::is_quick).collect();
        self.solve_from(on, if quick.is_empty() { &all } else { &quick })
    }

    /// Solves from one start after the other.
    pub fn solve(&mut self, on: &mut OnGrid) -> Result<Found> {
        let all = self.all();
        self.solve_from(on, &all)
    }

    fn solve_from(&mut self, on: &mut OnGrid, starts: &[Start]) -> Result<Found> {
        let mut left: Option<Found> = None;
        for (number, &start) in starts.iter().enumerate() {
            let others = number + 1 < starts.len();
            on.newton.patience = match (others, number) {
                (true, _) => Some(PATIENCE),
                (false, 0) => None,
                (false, _) => Some(LAST_PATIENCE),
            };
            on.watching.attempt(self.tried.len() + 1, Some(start));
            let (began, guessed) = (Instant::now(), on.start_iterations);
            let before = on.newton.iterations;
            let found = self.solve_by(on, start);
            on.newton.patience = None;
            let Some((state, report)) = found? else {
                continue;
            };
            self.tried.push(Attempt {
                start,
                points: on.grid.points(),
                guess_iterations: on.start_iterations - guessed,
                iterations: on.newton.iterations - before,
                time: began.elapsed(),
                outcome: report.outcome,
                explanation: report.explanation.clone(),
            });
            if on.is_final(report.outcome) {
                return Ok((state, report));
            }
            // What stopped Newton's method on the grid says more than why there was no start.
            if left.is_none() || !report.iterations.is_empty() {
                left = Some((state, report));
            }
        }
        Ok(left.unwrap_or_else(|| {
            let why = "there is no such start".into();
            nothing(on, Outcome::NoInitialGuess, why)
        }))
    }

    /// By one way; `None` where it cannot be gone.
    fn solve_by(&mut self, on: &mut OnGrid, start: Start) -> Result<Option<Found>> {
        match start {
            Start::QuasiStatic | Start::SteadyRotation => self.by_quasi_static(on, start).map(Some),
            Start::RigidRotation => match self.rigid_rotation(on)? {
                Some(state) => on.solve(state).map(Some),
                None => Ok(None),
            },
            Start::RaisedInertia => match self.quasi_static_here(on, Start::QuasiStatic)? {
                Some(state) => raised_inertia(on, state),
                None => Ok(None),
            },
            Start::LoweredDamping => match self.quasi_static_here(on, self.first())? {
                Some(state) => lowered_damping(on, state),
                None => Ok(None),
            },
            Start::RaisedLoads => raised_loads(on),
            Start::March => self.through_march(on),
        }
    }

    fn by_quasi_static(&mut self, on: &mut OnGrid, start: Start) -> Result<Found> {
        if let Some(state) = self.quasi_static_here(on, start)? {
            return on.solve(state);
        }
        let guess = self.quasi_static(on, start)?;
        let outcome = match guess.outcome {
            Outcome::Cancelled
            | Outcome::WorkLimit
            | Outcome::Singular
            | Outcome::Inconsistent
            | Outcome::WrongAssembly => guess.outcome,
            _ => Outcome::NoInitialGuess,
        };
        let (state, report) = nothing(on, outcome, guess.explanation.clone());
        let is_here = guess.state.points() == on.grid.points();
        Ok((if is_here { guess.state.clone() } else { state }, report))
    }

    /// All that hangs on drives turned with them, if the joints let it.
    fn rigid_rotation(&self, on: &OnGrid) -> Result<Option<GridState>> {
        let Some(driven) = self.driven.as_ref().filter(|driven| driven.is_rigid()) else {
            return Ok(None);
        };
        let (system, points) = (&on.system, on.grid.points());
        let mut state = GridState::reference(system, on.grid);
        let mut signals = vec![0.0; system.signals()];
        for k in 0..points {
            system.signal_values(on.grid.time(k), 1.0, &mut signals)?;
            for (node, reference) in system.reference().iter().enumerate() {
                state.motions[node * points + k] = driven.carried(node, reference, &signals);
            }
        }
        state.track(system);
        Ok(Some(state))
    }

    /// Marches in time, and tries Newton's method from its periods now and then.
    fn through_march(&mut self, on: &mut OnGrid) -> Result<Option<Found>> {
        let start = match self.quasi_static_here(on, Start::QuasiStatic)? {
            Some(state) => Some(state),
            None => self.rigid_rotation(on)?,
        };
        // In equal steps.
        let steps = on.grid.equispaced();
        let workers = on.means.workers.clone();
        let start = match start {
            Some(state) => on.resampled(&state, on.grid, steps)?,
            None => None,
        };
        let mut march = DissipativeMarch::new(&on.system, steps, start.as_ref(), &workers)?;
        let mut found: Option<Found> = None;
        let mut tries = TRIED.iter().peekable();
        let mut early = f64::INFINITY;
        for period in 1..=MOST_PERIODS {
            let marched = on.look_for_start(|_, observe| march.go_on(observe))?;
            let state = match marched {
                Ok(state) => state,
                Err((outcome, why)) => {
                    let tried = found.filter(|_| !outcome.is_stopped());
                    return Ok(tried.or_else(|| Some(nothing(on, outcome, why))));
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
            let Some(state) = on.carried(&state, steps)? else {
                continue;
            };
            let next = on.solve(state)?;
            if on.is_final(next.1.outcome) || is_last || tries.peek().is_none() {
                return Ok(Some(next));
            }
            found = Some(next);
        }
        Ok(found)
    }
}

/// No state but the reference, and why.
fn nothing(on: &OnGrid, outcome: Outcome, why: String) -> Found {
    let state = GridState::reference(&on.system, on.grid);
    (state, NewtonReport::ended(outcome, why))
}
