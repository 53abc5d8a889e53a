//! A solve on a given grid, which may begin on a coarser one. See docs/theory.md, section 9.

use super::Periodic;
use super::estimate::assess;
use crate::collocation::GridState;
use crate::error::Result;
use crate::fourier::TimeGrid;
use crate::solve::newton::on_grid::Found;
use crate::solve::report::{NewtonOptions, Outcome};
use crate::solve::result::GridTried;
use std::time::Instant;

/// Estimated error of such a solution that leaves it nearer than the quasi-static motion: this, or
/// so many times what inertial forces displace that by.
const RESOLVED: f64 = 1e-4;
const NEARER: f64 = 0.1;
/// Tolerance of such a solution: the error after the last increment goes with its square.
const ENOUGH: f64 = 1e-4;
/// Inertial displacement, in scaled unknowns, of a quasi-static motion from which Newton's method
/// takes more than a few iterations.
const FAR: f64 = 0.001;
/// Fewest points of a grid with half the harmonics that may serve as a start; and the inertial
/// displacement for fewer than so many points, which leave errors of a few thousandths.
const LEAST_COARSE: usize = 7;
const FEW: usize = 9;
const FAR_FOR_FEW: f64 = 0.02;
/// Most iterations on it: more would take longer than those it is to spare.
const MOST_COARSE: usize = 8;
/// Estimated error from which Newton's method factors once more on the finer grid. A grid with half
/// the harmonics spares that, if it has so many times the points of the first one.
const ONCE_MORE: f64 = 1e-5;
const FINER: f64 = 1.5;

impl Periodic<'_> {
    /// On this grid, which may be finer than the present one, from a given state or the library's
    /// own start.
    pub(super) fn on_given_grid(
        &mut self,
        grid: TimeGrid,
        given: Option<GridState>,
    ) -> Result<Found> {
        let (mut state, mut report) = match given {
            Some(state) => self.on.solve(state)?,
            None => self.find_on(grid)?,
        };
        if report.outcome == Outcome::Converged {
            self.assess(&mut state, &report)?;
            report.explanation = self.describe_unheld().unwrap_or_default();
        }
        Ok((state, report))
    }

    fn find_on(&mut self, grid: TimeGrid) -> Result<Found> {
        // No coarse solution from the quasi-static motion where another start was asked for.
        if !self.starts.is_quasi_static() {
            return self.find_at(grid);
        }
        let shared = |points| self.on.system.shared_points(points, grid.points());
        let half = grid.with_points(shared(grid.of_half_the_harmonics().points()))?;
        let coarser = grid.with_points(half.points().min(self.coarse))?;
        let is_first = self.on.grid == grid;
        if is_first && coarser.points() < LEAST_COARSE {
            return self.find_near(grid);
        }
        self.on.watching.attempt(0, Some(self.starts.first()));
        let distance = self.starts.inertial_displacement(&mut self.on)?;
        let mut most = self.on.means.newton.iteration_limit;
        if is_first {
            let far = if coarser.points() < FEW {
                FAR_FOR_FEW
            } else {
                FAR
            };
            if distance <= far {
                return self.find_near(grid);
            }
            most = most.min(MOST_COARSE);
        }
        let by_factors = is_first && self.on.newton.linear.sampled().is_direct();
        self.on.move_to(coarser)?;
        let start = match self.on_coarse_grids(distance, most, by_factors.then_some(half))? {
            // Cancelled.
            Some((state, report)) if report.outcome != Outcome::Converged => {
                let coarse = self.on.grid;
                self.on.move_to(grid)?;
                let reached = self.on.carried(&state, coarse)?;
                let reference = || GridState::reference(&self.on.system, grid);
                return Ok((reached.unwrap_or_else(reference), report));
            }
            Some((state, _)) => self.on.carry_to(grid, &state)?,
            None => None,
        };
        if let Some(start) = start {
            let found = self.on.solve(start)?;
            // What is prolonged may miss constraints that depend on each other.
            if found.1.outcome == Outcome::Converged || found.1.outcome.is_stopped() {
                return Ok(found);
            }
            self.on.begin_again()?;
        }
        self.coarse_start = None;
        self.find_at(grid)
    }

    /// From a quasi-static motion that inertial forces hardly displace, on as few points as it
    /// takes.
    fn find_near(&mut self, grid: TimeGrid) -> Result<Found> {
        if self.starts.grid != grid {
            let found = self.starts.solve_at_once(&mut self.on)?;
            if self.on.is_final(found.1.outcome) {
                return Ok(found);
            }
            self.on.begin_again()?;
        }
        self.find_at(grid)
    }

    /// From the library's own starts, found at the points of this grid.
    fn find_at(&mut self, grid: TimeGrid) -> Result<Found> {
        self.on.move_to(grid)?;
        self.starts.move_to(grid);
        self.starts.solve(&mut self.on)
    }

    /// A solution on the present grid, which is coarse, from the quasi-static motion, and from that
    /// one on `finer` where that spares factors of the last grid; see [`Self::on_coarse_grid`].
    fn on_coarse_grids(
        &mut self,
        distance: f64,
        most: usize,
        finer: Option<TimeGrid>,
    ) -> Result<Option<Found>> {
        let first = self.starts.first();
        let Some(start) = self.starts.quasi_static_here(&mut self.on, first)? else {
            return Ok(None);
        };
        let found = self.on_coarse_grid(start, distance, most)?;
        let leaves_much = |finer: TimeGrid| {
            self.coarse_start.as_ref().is_some_and(|tried| {
                let larger = finer.points() as f64 >= FINER * tried.points as f64;
                larger && tried.error_estimate > ONCE_MORE
            })
        };
        match (found, finer) {
            (Some((state, _)), Some(finer)) if leaves_much(finer) => {
                match self.on.carry_to(finer, &state)? {
                    Some(start) => self.on_coarse_grid(start, distance, most),
                    None => Ok(None),
                }
            }
            (found, _) => Ok(found),
        }
    }

    /// A solution on the present grid, which is coarse, if `most` iterations find one with an
    /// error that is small beside the `distance` of the quasi-static motion, or what was reached
    /// when that was cancelled.
    fn on_coarse_grid(
        &mut self,
        start: GridState,
        distance: f64,
        most: usize,
    ) -> Result<Option<Found>> {
        let on = &mut self.on;
        let enough = NewtonOptions {
            tolerance: on.means.newton.tolerance.max(ENOUGH),
            iteration_limit: most,
        };
        on.newton.is_on_the_way = true;
        let (state, report) = on.solve_to(start, &enough)?;
        on.newton.is_on_the_way = false;
        match report.outcome {
            Outcome::Converged => {}
            Outcome::Cancelled => return Ok(Some((state, report))),
            _ => return Ok(None),
        }
        // As a start it is as good as its harmonics fall: stretching between points, which is a
        // part of the error, is taken out by the stress resultants that are carried.
        let began = Instant::now();
        let alike = on.newton.alike.as_deref();
        let (found, _) = assess(&on.system, on.grid, (&state, alike), &on.means.workers)?;
        on.timings.estimates += began.elapsed();
        if found.error >= RESOLVED.max(NEARER * distance) {
            return Ok(None);
        }
        self.coarse_start = Some(GridTried {
            points: on.grid.points(),
            iterations: report.iterations.len(),
            error_estimate: found.error,
        });
        Ok(Some((state, report)))
    }
}
