//! Periodic motions: from model to solution.
//! See docs/theory.md, section 9.
//!
//! * `options.rs`: what the user may choose;
//! * `given.rs`: a solve on a given grid, which may begin on a coarser one;
//! * `adaptive.rs`: grids made finer until the estimated error meets a tolerance;
//! * `on_the_way.rs`: how far Newton's method goes on grids that may not be the last;
//! * `conditioned.rs`: motions under conditions that determine free parameters;
//! * `sharp.rs`: when a motion is sharp, and the map of time that brings grid points there;
//! * `maps.rs`: when maps are looked for, and what becomes of them;
//! * `estimate.rs`, `waves.rs`, `loads.rs`: that error: of the motions at the grid points, by
//!   harmonics above the grid's, of loads that the grid cannot hold.

pub(crate) mod adaptive;
pub(crate) mod conditioned;
pub(crate) mod estimate;
mod given;
pub(crate) mod loads;
mod maps;
mod on_the_way;
pub(crate) mod options;
mod sharp;
mod waves;

use crate::collocation::require_like_blades;
use crate::error::Result;
use crate::fourier::TimeGrid;
use crate::model::Model;
use crate::solve::linear::cost::DirectCost;
use crate::solve::memory::MemoryLimit;
use crate::solve::newton::on_grid::{Found, Means, OnGrid};
use crate::solve::report::{Iteration, Outcome};
use crate::solve::result::{Assessment, GridTried, Kind, PeriodicRecord, Solved};
use crate::solve::start::InitialGuess;
use crate::solve::starts::Starts;
use crate::solve::watch::Stage;
use crate::system::{System, require_periodic_forces};
use crate::workers::Workers;
use adaptive::Adaptation;
use estimate::mesh_error;
use loads::Loads;
use maps::Maps;
use options::{GridPoints, PeriodicOptions};
use std::sync::Arc;
use std::time::Instant;

/// Grids of more than this many times the points of a quasi-static start begin at a solution on
/// fewer.
const LARGE: usize = 2;

/// One periodic solve on its way.
struct Periodic<'a> {
    on: OnGrid<'a>,
    starts: Starts,
    loads: Loads,
    /// Tolerance of Newton's method that is asked for.
    tolerance: f64,
    /// The largest estimated error that ends an adaptive solve; zero on a grid that is given.
    accepted: f64,
    /// Points of the finest grid that may follow; zero where it is given.
    finest: usize,
    maps: Maps,
    /// The grids that were tried.
    grids: Vec<GridTried>,
    /// Points of the grid on which one on a large grid looks for its start.
    coarse: usize,
    coarse_start: Option<GridTried>,
    /// Of the last solution that was assessed, on this grid.
    assessed: Option<(TimeGrid, Assessment)>,
}

/// Points of the grids that a solve begins with.
struct FirstGrids {
    /// Asked for: given, or the first of an adaptive solve.
    wanted: usize,
    /// Of quasi-static motions.
    starts: usize,
    /// Of a solution that Newton's method may begin at.
    coarse: usize,
    /// Of the first solution that is looked for.
    solved: usize,
}

impl FirstGrids {
    fn of(options: &PeriodicOptions, system: &System, loads: &Loads) -> Self {
        match (&options.guess, options.grid_points) {
            (InitialGuess::State(_), GridPoints::Fixed(wanted)) => FirstGrids {
                wanted,
                starts: wanted,
                coarse: wanted,
                solved: wanted,
            },
            (_, GridPoints::Fixed(wanted)) => {
                let adaptation = Adaptation::default();
                let first = adaptation.first(loads);
                let guess = adaptation.guess(first);
                let coarse = system.shared_points(first.min(wanted), wanted);
                let is_large = wanted > LARGE * guess;
                FirstGrids {
                    wanted,
                    starts: system.fewer_shared_points(guess.min(wanted), coarse),
                    coarse,
                    solved: if is_large { coarse } else { wanted },
                }
            }
            (guess, GridPoints::Adaptive(adaptation)) => {
                let shared = |points| system.shared_points(points, adaptation.largest);
                let first = adaptation.first(loads);
                let (wanted, starts) = match guess {
                    InitialGuess::State(state) => {
                        let points = state.points();
                        (points, adaptation.guess(points))
                    }
                    _ => {
                        let (wanted, guess) = (shared(first), adaptation.guess(first));
                        (wanted, system.fewer_shared_points(guess, wanted))
                    }
                };
                FirstGrids {
                    wanted,
                    starts,
                    coarse: wanted,
                    solved: wanted,
                }
            }
        }
    }
}

/// Finds the periodic response of `model` with period `period`.
///
/// On an adaptive grid, each solution starts from that on the grid before; the last is given.
///
/// Without a given start, Newton begins at the quasi-static motion, in steady rotation of what
/// hangs on drives, or, on a large grid or where inertial forces would displace that much, at a
/// solution on a smaller grid if that resolves the motion. Where that does not lead to a solution,
/// other starts are tried, see [`Start`](crate::solve::Start).
///
/// `observe` sees each iteration and returns `false` to cancel.
///
/// # Errors
/// If options or model are not valid. Not converging is an outcome, not an error.
pub fn solve_periodic(
    model: &Model,
    period: f64,
    options: &PeriodicOptions,
    observe: &mut dyn FnMut(Stage, &Iteration) -> bool,
) -> Result<Solved> {
    let began = Instant::now();
    options.validate()?;
    // What is wrong with the grid is said first.
    let (largest, points) = match options.grid_points {
        GridPoints::Fixed(points) => (points, points),
        GridPoints::Adaptive(adaptation) => (adaptation.largest, 1),
    };
    model.require_grid_points("grid_points", points)?;
    TimeGrid::even_or_odd(points, period)?;
    let map = options.time_map.given(period)?;
    let system = Arc::new(System::new(model, period)?);
    require_periodic_forces(model, system.scales().length, period)?;
    require_like_blades(&system)?;
    let limit = MemoryLimit(options.memory_limit);
    limit.require_grid(&system, points)?;
    let samples = Loads::samples(&system, largest);
    limit.require(
        "harmonics of the signals",
        4 * samples.saturating_mul(size_of::<f64>()),
    )?;
    let loads = Loads::of(&system, largest)?;
    let first = FirstGrids::of(options, &system, &loads);
    let [wanted, of_starts, grid] = [first.wanted, first.starts, first.solved]
        .map(|points| TimeGrid::even_or_odd(points, period).map(|grid| grid.mapped(map)));
    let (wanted, of_starts, grid) = (wanted?, of_starts?, grid?);
    let watching = options.watch.begin(Stage::InitialGuess, grid.points());
    let means = Means {
        newton: options.newton,
        linear: options.linear,
        oversampling: options.oversampling,
        workers: Workers::new(options.threads)?.telling(watching.pulse()),
        work_limit: options.work_limit,
        is_given: matches!(options.grid_points, GridPoints::Fixed(_)),
        memory: limit,
    };
    let mut observe = watching.with(observe);
    let (given, chosen) = match &options.guess {
        InitialGuess::State(state) => (Some(state.clone()), None),
        InitialGuess::By(start) => (None, Some(*start)),
        InitialGuess::Default => (None, None),
    };
    let (accepted, finest) = match &options.grid_points {
        GridPoints::Fixed(_) => (0.0, 0),
        GridPoints::Adaptive(adaptation) => (adaptation.error_tolerance, adaptation.largest_odd()),
    };
    let mut solve = Periodic {
        on: OnGrid::new(&system, grid, means, watching.clone(), &mut observe)?,
        starts: Starts::new(&system, of_starts, chosen)?,
        loads,
        tolerance: options.newton.tolerance,
        accepted,
        finest,
        maps: Maps::new(options.time_map.most_tried()),
        grids: Vec::new(),
        coarse: first.coarse,
        coarse_start: None,
        assessed: None,
    };
    for grid in [wanted, of_starts].into_iter().filter(|of| *of != grid) {
        let cost = DirectCost::of(&system, grid.points());
        solve.on.means.allow(&system, grid, cost);
    }
    // All that came before: the system, the loads, the first pattern.
    solve.on.timings.analysis = began.elapsed() - solve.on.newton.timings.analysis;
    let found = match options.grid_points {
        GridPoints::Adaptive(adaptation) => solve.refine(&adaptation, given),
        GridPoints::Fixed(_) => solve.on_given_grid(wanted, given),
    };
    let found = match watching.unless_cancelled(found)? {
        Some(found) => found,
        None => solve.on.cancelled()?,
    };
    solve.finish(model, options, found, began)
}

impl Periodic<'_> {
    /// The result: with what is known of errors, and multipliers of least norm.
    fn finish(
        mut self,
        model: &Model,
        options: &PeriodicOptions,
        (mut state, mut report): Found,
        began: Instant,
    ) -> Result<Solved> {
        let (on, sampled) = (&mut self.on, options.oversampling == 1);
        let estimating = Instant::now();
        let wanted = options.estimate_mesh || model.beams.is_empty();
        let mesh_error = if wanted && sampled && report.outcome.is_solution() {
            let found = mesh_error(model, &mut on.newton, &state);
            on.watching.unless_cancelled(found)?
        } else {
            None
        };
        on.timings.estimates += estimating.elapsed();
        let finishing = Instant::now();
        on.newton.update_kinematics(&state);
        report.outcome = on.watching.outcome(report.outcome);
        let assessment = self
            .assessed
            .take_if(|(grid, _)| *grid == on.grid && report.outcome.is_solution());
        // Between grid points, too, what has no effect at them may have some.
        let reduced = assessment.is_some() || report.outcome == Outcome::Cancelled;
        if sampled && !reduced {
            on.newton.equations.reduce_to_least_norm(&mut state)?;
        }
        on.timings.assembly += finishing.elapsed();
        Ok(Solved {
            system: on.system.clone(),
            grid: on.grid,
            node_states: on.newton.equations.node_states().to_vec(),
            state,
            report,
            guess_iterations: on.start_iterations,
            guess_time: on.start_time,
            timings: on.all_timings(),
            total_time: began.elapsed(),
            total_iterations: on.all_iterations(),
            kind: Kind::Periodic(PeriodicRecord {
                iterative: on.newton.linear.sampled().record().cloned(),
                grids: self.grids,
                coarse_start: self.coarse_start,
                attempts: self.starts.tried,
                threads: options.threads,
                assessment: assessment.map(|(_, assessment)| assessment),
                mesh_error: mesh_error.unwrap_or(f64::INFINITY),
            }),
        })
    }
}
