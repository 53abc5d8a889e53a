//! Maps of time in an adaptive solve: when they are looked for, and what becomes of them.
//! See docs/theory.md, section 10.7.

use super::Periodic;
use super::adaptive::{Adaptation, LEFT_BY_GUESS, UNRESOLVED, quick};
use super::sharp::{HARM, MOST_MAPS, Sharper, gain, of_rest, of_solution, sharper_still};
use crate::collocation::{Decay, GridState};
use crate::error::Result;
use crate::fourier::TimeGrid;
use crate::solve::newton::on_grid::Found;
use crate::solve::report::Outcome;
use crate::solve::result::{Assessment, GridTried};
use std::time::Instant;

/// A grid of fewer points tells little of where a motion is sharp, and costs little.
const LEAST_MAPPED: usize = 41;
/// The next grid has so many times the points where harmonics fall slowly.
const MUCH_FINER: f64 = 1.5;
/// A mapped grid has this part of the points at least that told of the map.
const LEAST_PART: f64 = 0.75;
/// Points at which the quasi-static motion is looked at, and so many times those of the grid.
const QUASI_STATIC: usize = 511;
const FINER: usize = 4;
/// The first mapped grid has so many times the points that hold the quasi-static motion.
const BEYOND_REST: f64 = 3.0;

/// A quasi-static motion on fewer points tells little of how its harmonics end, which the highest
/// of so many do.
const LEAST_TELLING: usize = 25;
const HIGHEST: usize = 4;

/// Maps so far.
pub(super) struct Maps {
    /// How often grids may yet be mapped where the motion is sharp.
    pub left: usize,
    /// The quasi-static motion that maps are to suit, if there is one, and whether it was looked
    /// for.
    followed: Option<Followed>,
    looked: bool,
    /// A map led nowhere: the next one starts from a solution that resolves the motion.
    waits: bool,
    /// The best solution since then.
    best: Option<Best>,
}

impl Maps {
    /// So many may be tried.
    pub fn new(left: usize) -> Self {
        Maps {
            left,
            followed: None,
            looked: false,
            waits: false,
            best: None,
        }
    }

    /// No solution was found on a grid with a new map: there may be one without a map, from which
    /// another is tried, but once.
    pub fn led_nowhere(&mut self) {
        if self.waits {
            self.left = 0;
        }
        self.waits = true;
    }
}

/// A quasi-static motion on a fine grid, and the map that suits it.
struct Followed {
    grid: TimeGrid,
    state: GridState,
    sharper: Option<Sharper>,
}

/// The solution with the least estimated error so far.
struct Best {
    error: f64,
    grid: TimeGrid,
    state: GridState,
    assessed: Option<(TimeGrid, Assessment)>,
}

impl Periodic<'_> {
    /// A grid with its points closer together where the motion is sharp, if its harmonics fall
    /// slowly and would end much earlier there; where it would go on with so many, if it would.
    pub(super) fn sharper_grid(
        &mut self,
        adaptation: &Adaptation,
        found: &Assessment,
        wanted: Option<f64>,
        state: &GridState,
    ) -> Result<Option<TimeGrid>> {
        let grid = self.on.grid;
        let points = grid.points();
        let Some(wanted) = wanted else {
            return Ok(None);
        };
        let few = points < LEAST_MAPPED || wanted < MUCH_FINER * points as f64;
        // Blades are alike at equispaced points only.
        let alike = self.on.newton.alike.is_some();
        if self.maps.left == 0 || few || alike || found.unheld.is_some() {
            return Ok(None);
        }
        // What is resolved goes on at equispaced points while it may have as many as it asks for:
        // linear equations are easier there.
        let is_resolved = found.error <= UNRESOLVED;
        if is_resolved && grid.map().is_identity() && wanted <= adaptation.largest as f64 {
            return Ok(None);
        }
        // What resolves nothing tells nothing.
        let found = match grid.map().is_identity() {
            true if self.maps.waits && !is_resolved => None,
            true => self.first_map(grid, state)?,
            false if !is_resolved => None,
            false => self.next_map(grid, state),
        };
        let Some(Sharper { map, gain, holding }) = found else {
            return Ok(None);
        };
        let enough = match holding {
            Some(holding) if self.maps.waits => {
                f64::max(BEYOND_REST * holding as f64, LEAST_PART * points as f64)
            }
            Some(holding) => BEYOND_REST * holding as f64,
            None => (wanted / gain).max(LEAST_PART * points as f64),
        };
        let points = quick(enough.ceil() as usize).min(adaptation.largest_odd());
        self.maps.left -= 1;
        Ok(Some(grid.with_points(points)?.mapped(map)))
    }

    /// A map that suits the quasi-static motion, which shows early how sharp the motion will be,
    /// and does little harm to the present solution; where there is no such motion, one that suits
    /// this.
    fn first_map(&mut self, grid: TimeGrid, state: &GridState) -> Result<Option<Sharper>> {
        if !self.maps.looked {
            if self.is_smooth_at_rest() {
                self.maps.left = 0;
                return Ok(None);
            }
            self.maps.looked = true;
            self.maps.followed = self.follow(grid)?;
        }
        let (began, system) = (Instant::now(), &self.on.system);
        let found = match &self.maps.followed {
            Some(Followed { sharper, .. }) => {
                let sharper = sharper.clone();
                sharper.filter(|found| HARM * gain(system, grid, state, &found.map) >= 1.0)
            }
            None => of_solution(system, grid, state),
        };
        self.on.newton.timings.estimates += began.elapsed();
        Ok(found)
    }

    /// The quasi-static motion on a grid that is finer than this one, and the map that suits it.
    fn follow(&mut self, grid: TimeGrid) -> Result<Option<Followed>> {
        let fine = grid.with_points(QUASI_STATIC.max(FINER * grid.points()) | 1)?;
        let Some(state) = self.starts.followed(&mut self.on, fine)? else {
            return Ok(None);
        };
        let began = Instant::now();
        let sharper = of_rest(&self.on.system, fine, &state);
        self.on.newton.timings.estimates += began.elapsed();
        Ok(Some(Followed {
            grid: fine,
            state,
            sharper,
        }))
    }

    /// Whether the harmonics of the quasi-static motion on the grid where it was found first end in
    /// what its Newton iterations may leave: a finer one shows no more then.
    fn is_smooth_at_rest(&self) -> bool {
        let found = self.starts.first_found();
        let Some((grid, state)) = found.filter(|(grid, _)| grid.points() >= LEAST_TELLING) else {
            return false;
        };
        let amplitudes = Decay::of(&self.on.system, grid, state).amplitudes;
        let upper = amplitudes.iter().rev().take(amplitudes.len() / HIGHEST);
        upper.fold(0.0, |most: f64, a| most.max(*a)) <= LEFT_BY_GUESS
    }

    /// A map that suits the present solution more than that of its grid.
    fn next_map(&mut self, grid: TimeGrid, state: &GridState) -> Option<Sharper> {
        let (began, system) = (Instant::now(), &self.on.system);
        let followed = self.maps.followed.as_ref()?;
        let exact = (followed.grid, &followed.state);
        let found = sharper_still(system, (grid, state), exact);
        self.on.newton.timings.estimates += began.elapsed();
        found
    }

    /// The quasi-static motion that a map was chosen for, on the first grid with that, where the
    /// solution before resolves nothing.
    pub(super) fn near_rest(&mut self, error: f64) -> Result<Option<GridState>> {
        let is_first = self.maps.left + 1 == MOST_MAPS && !self.on.grid.map().is_identity();
        let followed = self.maps.followed.as_ref();
        let Some(followed) = followed.filter(|_| is_first && error > UNRESOLVED) else {
            return Ok(None);
        };
        let start = self.on.carried(&followed.state, followed.grid)?;
        self.on.newton.equations.set_resultants(Vec::new());
        Ok(start)
    }

    /// Keeps a solution, if grids are mapped, which may make it worse.
    pub(super) fn keep_if_best(&mut self, state: &GridState, error: f64) {
        let may_be_worse = self.maps.left < MOST_MAPS && self.maps.looked;
        let best = self.maps.best.as_ref();
        if may_be_worse && best.is_none_or(|best| error < best.error) {
            self.maps.best = Some(Best {
                error,
                grid: self.on.grid,
                state: state.clone(),
                assessed: self.assessed.clone(),
            });
        }
    }

    /// What was found, or where that misses the tolerance what was found before and is better.
    pub(super) fn best_of(&mut self, (state, mut report): Found) -> Result<Found> {
        let missed = report.outcome == Outcome::ToleranceNotMet;
        let here = self.on.grid;
        let Some(best) = self.maps.best.take_if(|best| missed && best.grid != here) else {
            return Ok((state, report));
        };
        self.on.move_to(best.grid)?;
        self.assessed = best.assessed;
        let (points, error) = (best.grid.points(), best.error);
        self.grids.push(GridTried {
            points,
            iterations: 0,
            error_estimate: error,
        });
        let kept = format!("; that on {points} points before, with {error:.1e}, is kept");
        report.explanation.push_str(&kept);
        Ok((best.state, report))
    }
}
