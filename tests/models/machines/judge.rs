//! How a machine is solved, and how the solution is judged: by a finer grid, reached from the
//! solution and from cold, and by a march.

use super::Machine;
use periodyn::collocation::GridState;
use periodyn::error::Result;
use periodyn::fourier::TimeGrid;
use periodyn::output::Solution;
use periodyn::solve::*;

/// Error tolerance of default options.
pub const TOLERANCE: f64 = 1e-6;
/// Errors up to so many times the estimate, and estimates up to so many times the error, are right.
pub const TRUSTED: f64 = 3.0;
pub const SHARP: f64 = 10.0;
/// Errors that are left to rounding.
pub const ROUNDING: f64 = 1e-9;
/// A finer grid judges if its own estimate is less than this part of the difference, or if it has
/// so many points.
const SURER: f64 = 0.2;
const FINEST: usize = 600;
/// A solution is false if it is wrong by more than its estimate allows, and by so many times the
/// tolerance.
const FALSE: f64 = 10.0;
/// Difference to a march, in uncertainties of that, that disproves a solution.
const DISPROVED: f64 = 10.0;
/// Least steps of a march over a period, and steps for each of the solution's harmonics.
const LEAST_STEPS: usize = 400;
const STEPS_OF_HARMONIC: usize = 16;

/// An undamped machine has no periodic solution near if, in a march from rest, the largest
/// distances from the start in so many blocks of so many periods each grow, by this factor at least
/// from one to the next.
const BLOCKS: usize = 4;
const PERIODS: usize = 15;
const GROWTH: f64 = 1.15;
/// Steps to a period in that march.
const GROWTH_STEPS: usize = 96;

fn go_on(_: Stage, _: &Iteration) -> bool {
    true
}

/// Solves by default options.
pub fn solve(machine: &Machine) -> Result<Solution> {
    solve_watched(machine, &mut go_on)
}

/// The same, and shows each iteration.
pub fn solve_watched(
    machine: &Machine,
    observe: &mut dyn FnMut(Stage, &Iteration) -> bool,
) -> Result<Solution> {
    let options = PeriodicOptions::default();
    Solution::solve(&machine.model, machine.period, &options, observe)
}

/// What is known of a solution's error.
#[derive(Debug, Clone, Copy, Default)]
pub struct Checked {
    /// Largest difference to a solution on twice the grid, found from this one.
    pub error: Option<f64>,
    /// The same, found from cold; large if that is another solution.
    pub from_cold: Option<f64>,
    /// Largest difference to a march over a period from the solution's start, and that of two
    /// marches with steps of which one is half as long.
    pub march: Option<[f64; 2]>,
}

/// What is to be thought of a converged solution.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// The finer grid agrees.
    Right,
    /// It does not, or a march disproves the solution.
    False,
    /// There is no solution on the finer grid to compare with.
    Unchecked,
}

impl Checked {
    pub fn verdict(&self, estimate: f64) -> Verdict {
        let disproved = self
            .march
            .is_some_and(|[away, unsure]| away > DISPROVED * unsure + FALSE * TOLERANCE);
        match self.error {
            _ if disproved => Verdict::False,
            Some(error) if is_false(error, estimate) => Verdict::False,
            Some(_) => Verdict::Right,
            None => Verdict::Unchecked,
        }
    }
}

fn is_false(error: f64, estimate: f64) -> bool {
    error > TRUSTED * estimate + ROUNDING && error > FALSE * TOLERANCE
}

/// A grid of about twice the points that shares but one with this.
fn finer(grid: TimeGrid) -> Result<TimeGrid> {
    TimeGrid::new(2 * grid.points() + 1, grid.period())
}

/// The difference between a solution and that on a finer grid, found from it or from cold.
fn against_finer(machine: &Machine, solution: &Solution, from_cold: bool) -> Result<Option<f64>> {
    let mut grid = solution.grid();
    loop {
        grid = finer(grid)?;
        let carried = solution.prolonged(grid)?;
        let mut options = PeriodicOptions::with_grid_points(grid.points());
        if !from_cold {
            options.guess = InitialGuess::State(carried.clone());
        }
        let fine = Solution::solve(&machine.model, machine.period, &options, &mut go_on)?;
        if fine.outcome() != Outcome::Converged {
            return Ok(None);
        }
        let length = fine.details().system.scales().length;
        let difference = carried.distance(&fine.details().state, length);
        // A harmonic of the finer grid alone that resounds may make it the worse.
        let own = fine.diagnostics().error_estimate;
        if own < SURER * difference || difference < ROUNDING || grid.points() > FINEST {
            return Ok(Some(difference));
        }
    }
}

/// Checks a solution on a finer grid.
pub fn check(machine: &Machine, solution: &Solution) -> Option<f64> {
    against_finer(machine, solution, false).ok().flatten()
}

/// The same on one that is solved from cold.
pub fn check_from_cold(machine: &Machine, solution: &Solution) -> Option<f64> {
    against_finer(machine, solution, true).ok().flatten()
}

/// Marches a period from the solution's start, twice.
pub fn march(machine: &Machine, solution: &Solution) -> Option<[f64; 2]> {
    march_twice(machine, solution).ok().flatten()
}

fn march_twice(machine: &Machine, solution: &Solution) -> Result<Option<[f64; 2]>> {
    let period = machine.period;
    let steps = LEAST_STEPS.max(STEPS_OF_HARMONIC * solution.grid().points() / 2);
    let start = solution.start_state(0.0)?;
    let mut marches = Vec::new();
    for steps in [steps, 2 * steps] {
        let mut options =
            MarchOptions::with_step(period / steps as f64, MarchEnd::Duration(period));
        options.start = MarchStart::State(start.clone());
        options.period = Some(period);
        let march = Solution::march(&machine.model, &options, &mut go_on)?;
        if march.outcome() != Outcome::Converged {
            return Ok(None);
        }
        marches.push(march);
    }
    let instant = TimeGrid::new(1, period)?;
    let length = solution.details().system.scales().length;
    let mut largest = [0.0f64; 2];
    const TIMES: usize = 40;
    for k in 0..=TIMES {
        // The end of a march may be short by rounding.
        let time = period * (k as f64 / TIMES as f64).min(1.0 - 1e-12);
        let at =
            |solution: &Solution| -> Result<GridState> { solution.prolonged_from(time, instant) };
        let (coarse, fine) = (at(&marches[0])?, at(&marches[1])?);
        let distances = [
            at(solution)?.distance(&fine, length),
            coarse.distance(&fine, length),
        ];
        for (largest, distance) in largest.iter_mut().zip(distances) {
            *largest = largest.max(distance);
        }
    }
    Ok(Some(largest))
}

/// Whether a machine has no periodic solution near: it is undamped, and its vibrations grow from
/// period to period, as those of a linear one do at resonance.
pub fn grows(machine: &Machine) -> bool {
    machine.undamped && growth(machine).unwrap_or(false)
}

fn growth(machine: &Machine) -> Result<bool> {
    let period = machine.period;
    let duration = (BLOCKS * PERIODS) as f64 * period;
    let step = period / GROWTH_STEPS as f64;
    let mut options = MarchOptions::with_step(step, MarchEnd::Duration(duration));
    options.period = Some(period);
    // Hardly any numerical damping.
    options.spectral_radius = 0.95;
    let march = Solution::march(&machine.model, &options, &mut go_on)?;
    if march.outcome() != Outcome::Converged {
        return Ok(false);
    }
    let instant = TimeGrid::new(1, period)?;
    let start = march.prolonged_from(0.0, instant)?;
    let length = march.details().system.scales().length;
    let mut largest = [0.0f64; BLOCKS];
    for k in 1..BLOCKS * PERIODS {
        let state = march.prolonged_from(k as f64 * period, instant)?;
        let block = &mut largest[k / PERIODS];
        *block = block.max(start.distance(&state, length));
    }
    Ok(largest.windows(2).all(|pair| pair[1] > GROWTH * pair[0]))
}
