//! The periodic solve.

use super::call::Call;
use super::guard::{guard, init};
use super::linear_solver::{PDN_LINEAR_AUTOMATIC, read_linear_solver};
use super::model::pdn_model;
use super::options::Options;
use super::pointer::null;
use super::solution::pdn_solution;
use super::status::pdn_status;
use crate::collocation::GridState;
use crate::error::{Error, Result};
use crate::fourier::{SharpEvent, TimeGrid, TimeMap};
use crate::model::Model;
use crate::motion::{Motion, is_rotation, polar_rotation};
use crate::output::Solution;
use crate::solve::{
    Adaptation, GridPoints, InitialGuess, NewtonOptions, PeriodicOptions, Progress, Stage, Start,
    TimeMapping, Watch, require_states,
};
use crate::system::System;
use libc::c_void;
use nalgebra::{Matrix3, Vector3};

/// Stage of a solve: finding the initial guess, each iteration at a single instant.
pub const PDN_STAGE_INITIAL_GUESS: i32 = 3200;
/// Stage of a solve: Newton iterations of the periodic problem.
pub const PDN_STAGE_NEWTON: i32 = 3201;
/// Stage of a march: a step, with the last of its iterations.
pub const PDN_STAGE_MARCH: i32 = 3202;
/// Stage of a modal analysis: looking for modes about the equilibrium.
pub const PDN_STAGE_MODES: i32 = 3203;
/// Following disturbances of a periodic solution.
pub const PDN_STAGE_STABILITY: i32 = 3204;

/// Start of a periodic solve: the library tries those that suit, cheapest first.
pub const PDN_START_AUTOMATIC: i32 = 3300;
/// Start of a periodic solve: equilibrium at each time, without velocities.
pub const PDN_START_QUASI_STATIC: i32 = 3301;
/// Start of a periodic solve: equilibrium at each time of what turns steadily with its drives, with
/// its centrifugal and gyroscopic forces.
pub const PDN_START_STEADY_ROTATION: i32 = 3302;
/// Start of a periodic solve: all that hangs on drives turned with them, undeformed.
pub const PDN_START_RIGID_ROTATION: i32 = 3303;
/// Start of a periodic solve: the quasi-static motion, and inertial forces raised in steps.
pub const PDN_START_RAISED_INERTIA: i32 = 3304;
/// Start of a periodic solve: a march in time with strong numerical dissipation.
pub const PDN_START_MARCH: i32 = 3305;
/// Start of a periodic solve: the quasi-static motion, and added damping taken away in steps.
pub const PDN_START_LOWERED_DAMPING: i32 = 3306;
/// Start of a periodic solve: the reference configuration, and loads and prescribed motions raised
/// in steps; not where these gain whole turns in a period.
pub const PDN_START_RAISED_LOADS: i32 = 3307;

/// Grid points are equispaced, but closer together where a solve to a tolerance finds the motion
/// sharp.
pub const PDN_TIME_MAP_AUTOMATIC: i32 = 3400;
/// Grid points are equispaced.
pub const PDN_TIME_MAP_EQUISPACED: i32 = 3401;
/// Grid points are closer together about events that are given.
pub const PDN_TIME_MAP_EVENTS: i32 = 3402;

/// How far a solve is, as told to a ::pdn_progress_fn.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct pdn_progress {
    /// Size of the struct in this library.
    pub struct_size: usize,
    /// PDN_STAGE_INITIAL_GUESS, PDN_STAGE_NEWTON, PDN_STAGE_MARCH, PDN_STAGE_MODES or
    /// PDN_STAGE_STABILITY.
    pub stage: i32,
    /// Number of the last iteration, from 1, or 0 before the first; starts again with each Newton
    /// solve. In a march, number of the step.
    pub iteration: i32,
    /// Largest residual before the step: forces relative to the characteristic force (the largest
    /// stiffness times the size of the mechanism), lengths relative to its size, angles in radians.
    pub residual: f64,
    /// Largest increment of a motion: displacements relative to the size of the mechanism, turns in
    /// radians.
    pub increment: f64,
    /// Fraction of the increment that was taken.
    pub step: f64,
    /// In a march the end of the step; otherwise 0.
    pub time: f64,
    /// Seconds since the solve began.
    pub elapsed: f64,
    /// Number of points of the grid that is worked on; 1 of an equilibrium or a march.
    pub grid_points: usize,
    /// Number of the attempt of a periodic solve, from 1, as the report lists them; 0 where the
    /// start was given, and before the first, as on a coarse grid that is to give a start.
    pub attempt: i32,
    /// What it starts from: PDN_START_QUASI_STATIC, ...; 0 where the start was given.
    pub start: i32,
    /// 1 where an iteration, or a step of a march, has just ended; 0 while one lasts, or what comes
    /// between them.
    pub iterated: i32,
    /// Zero.
    pub reserved: i32,
}

/// Called after each Newton iteration, or after each step of a march, and while one lasts about ten
/// times a second, on the solving thread.
///
/// `progress` is valid during the call only. It must not use the model that is being solved, nor
/// throw or jump out. Return 0 to go on, anything else to cancel: the outcome is PDN_CANCELLED.
pub type pdn_progress_fn =
    Option<unsafe extern "C" fn(progress: *const pdn_progress, user_data: *mut c_void) -> i32>;

/// Options of ::pdn_solve_periodic. Set the defaults by `PDN_INIT(pdn_periodic_options, &options)`.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct pdn_periodic_options {
    /// Set by the initialiser.
    pub struct_size: usize,
    /// Number N of grid points, odd, or a multiple of the number of like blades
    /// (pdn_model_set_rotor_symmetry): harmonics below N / 2 are resolved. 0 for as many as
    /// error_tolerance needs. Default 0.
    pub grid_points: usize,
    /// If not 0, the number of harmonics that are resolved: grid_points is then 2 harmonics + 1.
    /// Default 0.
    pub harmonics: usize,
    /// Newton's method has converged when the largest increment (lengths relative to the size of
    /// the mechanism, angles in radians) is below this. Newton is quadratic: the error left in
    /// motions is about its square, that in forces about it times their last change. Default 1e-9.
    pub tolerance: f64,
    /// Most Newton iterations on a grid. Default 30.
    pub iteration_limit: usize,
    /// Start from this solution, periodic or static, also on another grid or of another period, or
    /// from the last period of this march; NULL to start otherwise. Its model is to have the same
    /// bodies, joints, forces and prescribed coordinates, and the same beams, which may have other
    /// meshes. If grid_points is 0, the first grid is that of this solution. Default NULL.
    pub initial: *const pdn_solution,
    /// Start from these positions, an array of shape 3 x [N] x [nodes]: coordinates fastest, then
    /// grid points, then nodes; NULL to start otherwise. Needs guess_rotations, and grid_points or
    /// harmonics. Default NULL.
    pub guess_positions: *const f64,
    /// Rotation matrices of the same start, an array of shape 9 x [N] x [nodes], each column by
    /// column. Default NULL.
    pub guess_rotations: *const f64,
    /// Told of each iteration, and while one lasts, see progress_interval; may cancel. Default
    /// NULL.
    pub progress: pdn_progress_fn,
    /// Handed to progress.
    pub progress_data: *mut c_void,
    /// If grid_points is 0, grid points are added until the estimated error of the motions is below
    /// this: positions relative to the size of the mechanism, angles in radians. Default 1e-6,
    /// which leaves about three digits to forces and accelerations, which are second derivatives.
    pub error_tolerance: f64,
    /// If grid_points is 0, the largest number of grid points, at least 3; if the tolerance would
    /// need more, the outcome is PDN_TOLERANCE_NOT_MET. Default 511.
    pub largest_grid_points: usize,
    /// How linear equations are solved: PDN_LINEAR_AUTOMATIC, PDN_LINEAR_DIRECT, ... Default
    /// PDN_LINEAR_AUTOMATIC.
    pub linear_solver: i32,
    /// Threads that share the work, of a pool that lasts as long as the call; 0 for as many as
    /// there are processors. Signals' and other functions of yours are called on the calling thread
    /// alone. Default 1.
    pub threads: i32,
    /// The equations are sampled at this many times as many points (or one more), from 1 to 16,
    /// where motions and multipliers are interpolated; their virtual work, and the harmonics of the
    /// constraints up to those of the grid, are to vanish. 1: at the grid points alone. Default 1.
    pub oversampling: usize,
    /// If grid_points is 0 and this is not, the estimated error of the motions is also to be below
    /// this times the amplitude of the response: the largest deviation of a node from its mean or,
    /// if it makes whole turns in a period, from a steady turn, in the measure of error_tolerance.
    /// For responses that are small beside the mechanism. Default 0.
    pub response_tolerance: f64,
    /// Where the library starts, unless a start is given: PDN_START_AUTOMATIC, or one way alone:
    /// PDN_START_QUASI_STATIC, ... PDN_START_STEADY_ROTATION and PDN_START_RIGID_ROTATION need a
    /// drive that turns. Default PDN_START_AUTOMATIC.
    pub start: i32,
    /// 1 to estimate the error by the mesh of beams, too, pdn_diagnostics.mesh_error, which takes
    /// about as long as an iteration; not with oversampling. Default 0.
    pub estimate_mesh: i32,
    /// Least time between two calls of progress while an iteration lasts, in seconds; 0 to be
    /// called at any opportunity. Default 0.1.
    pub progress_interval: f64,
    /// Most work, counted in operations and not in time, of all starts and grids: this many times
    /// that of an easy Newton iteration on the finest grid so far, by few products or by factors,
    /// and a constant for small models. What takes more ends as PDN_WORK_LIMIT or, where a coarser
    /// grid had a solution, with that as PDN_TOLERANCE_NOT_MET. Twice that on a given grid. 0 for
    /// no bound. Default 17.
    pub work_limit: f64,
    /// Bytes of memory that the solve may take, by an estimate that is made before it is begun on a
    /// grid: one that would take more is PDN_ERR_MEMORY, and its message tells the estimate. If
    /// grid_points is 0, only the first grid is refused so; finer ones that would take more end the
    /// solve as PDN_TOLERANCE_NOT_MET. 0 for no limit but that of the system. Default 0.
    pub memory_limit: usize,
    /// Where the points of grids are: PDN_TIME_MAP_AUTOMATIC, PDN_TIME_MAP_EQUISPACED or
    /// PDN_TIME_MAP_EVENTS. By PDN_TIME_MAP_AUTOMATIC, a given number of points is equispaced, and
    /// a solve to a tolerance that starts from a solution goes on with the map of that. Default
    /// PDN_TIME_MAP_AUTOMATIC.
    pub time_map: i32,
    /// Zero.
    pub reserved: i32,
    /// Number of the events of PDN_TIME_MAP_EVENTS, at most 16. Default 0.
    pub event_count: usize,
    /// Times of the events, which repeat themselves every period: an array of length
    /// [event_count]. Default NULL.
    pub event_times: *const f64,
    /// Times from there to where the additional density of grid points is half as large, about as
    /// long as the events last, from 1e-5 to half the period: an array of length [event_count].
    /// Default NULL.
    pub event_widths: *const f64,
    /// Grid points that are there for each, beside those spread equally over the period, which
    /// count as 1; above 0, at most 100: an array of length [event_count]. Default NULL.
    pub event_shares: *const f64,
}

// SAFETY: all fields are plain numbers or pointers, `struct_size` is the first, no padding.
unsafe impl Options for pdn_periodic_options {
    const SIZES: &'static [usize] = &[80, 96, 104, 112, 120, 136, 152, 192];

    fn defaults() -> Self {
        let core = PeriodicOptions::default();
        let adaptation = Adaptation::default();
        pdn_periodic_options {
            tolerance: core.newton.tolerance,
            iteration_limit: core.newton.iteration_limit,
            error_tolerance: adaptation.error_tolerance,
            largest_grid_points: adaptation.largest,
            threads: 1,
            oversampling: core.oversampling,
            response_tolerance: adaptation.response_tolerance,
            progress_interval: PROGRESS_INTERVAL,
            work_limit: core.work_limit,
            linear_solver: PDN_LINEAR_AUTOMATIC,
            start: PDN_START_AUTOMATIC,
            time_map: PDN_TIME_MAP_AUTOMATIC,
            ..Self::blank()
        }
    }
}

/// Sets default options; use `PDN_INIT(pdn_periodic_options, &options)`.
///
/// @param options  the options; not NULL
/// @param struct_size  `sizeof *options`
///
/// Threads: any.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_periodic_options_init(
    options: *mut pdn_periodic_options,
    struct_size: usize,
) {
    init(options, struct_size, "options");
}

/// Finds the periodic response of a model directly, by Fourier spectral collocation.
///
/// Newton's method with the exact tangent on the equations of motion at N times of a period, from
/// the quasi-static motion unless another start is given; where inertia takes the response far from
/// that, or N is large, from a solution on fewer points. Unless N is given, it is raised, each
/// solution starting the next, until the estimated error meets the tolerance. Not converging is no
/// error: PDN_OK says that the solve was carried out, ::pdn_solution_outcome how it ended,
/// ::pdn_solution_report why.
///
/// @param model  the model; it is copied, so that later changes do not touch the solution
/// @param period  T, the period of the response; harmonics of signals are those of this period
/// @param options  may be NULL for the defaults
/// @param out  the solution, also if it has not converged; free it with ::pdn_solution_free;
///     written on success only
/// @return PDN_OK; PDN_ERR_NULL; PDN_ERR_NOT_FINITE; PDN_ERR_SIZE (even number of grid points,
///     a start of arrays without their number, events that are too many); PDN_ERR_VALUE;
///     PDN_ERR_STRUCT_SIZE; PDN_ERR_MODEL (no node, a beam too distorted);
///     PDN_ERR_NOT_PERIODIC (a prescribed motion or load that does not repeat, a spring on an
///     angle that gains turns); PDN_ERR_GRID_TOO_COARSE (of the initial solution);
///     PDN_ERR_CALLBACK (of a signal); PDN_ERR_OVERFLOW (numbers too large to compute with);
///     PDN_ERR_MEMORY
///
/// Threads: like a `const` use of `model` and of `options.initial`. Signals' functions and
/// `progress` are called on this thread.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_solve_periodic(
    model: *const pdn_model,
    period: f64,
    options: *const pdn_periodic_options,
    out: *mut *mut pdn_solution,
) -> pdn_status {
    guard(|call| {
        let model = call.shared(model, "model")?;
        let period = call.number(period, "period")?;
        let given = call.options(options, "options")?;
        let out = call.out(out, "out")?;
        let options = read_options(call, &given, &model, period)?;
        out.give(Solution::solve(&model, period, &options, &mut |_, _| true)?);
        Ok(())
    })
}

/// Seconds between two calls while an iteration lasts.
pub(super) const PROGRESS_INTERVAL: f64 = 0.1;

/// A function of the caller that is told of progress.
struct Caller {
    function: unsafe extern "C" fn(progress: *const pdn_progress, user_data: *mut c_void) -> i32,
    data: *mut c_void,
}

// SAFETY: it is called on the thread alone that the caller gave it on, as the header says.
unsafe impl Send for Caller {}

impl Caller {
    /// `false` to cancel.
    fn tell(&self, progress: &Progress) -> bool {
        let progress = of_progress(progress);
        // SAFETY: the caller gave the function for this data; `progress` outlives the call.
        unsafe { (self.function)(&progress, self.data) == 0 }
    }
}

/// Tells `function` how a solve goes on, at least every `interval` seconds.
pub(super) fn watch(function: pdn_progress_fn, data: *mut c_void, interval: f64) -> Result<Watch> {
    let Some(function) = function else {
        return Ok(Watch::default());
    };
    let caller = Caller { function, data };
    Watch::with_interval(interval, move |progress| caller.tell(progress))
}

fn of_progress(progress: &Progress) -> pdn_progress {
    let count = |n: usize| i32::try_from(n).unwrap_or(i32::MAX);
    let iteration = &progress.iteration;
    pdn_progress {
        struct_size: size_of::<pdn_progress>(),
        stage: match progress.stage {
            Stage::InitialGuess => PDN_STAGE_INITIAL_GUESS,
            Stage::Newton => PDN_STAGE_NEWTON,
            Stage::March { .. } => PDN_STAGE_MARCH,
            Stage::Modes => PDN_STAGE_MODES,
            Stage::Stability => PDN_STAGE_STABILITY,
        },
        iteration: count(iteration.number),
        residual: iteration.residual,
        increment: iteration.increment,
        step: iteration.step,
        time: match progress.stage {
            Stage::March { time } => time,
            _ => 0.0,
        },
        elapsed: progress.elapsed.as_secs_f64(),
        grid_points: progress.points,
        attempt: count(progress.attempt),
        start: progress.start.map_or(PDN_START_AUTOMATIC, start_code),
        iterated: i32::from(progress.iterated),
        reserved: 0,
    }
}

fn start_code(start: Start) -> i32 {
    match start {
        Start::QuasiStatic => PDN_START_QUASI_STATIC,
        Start::SteadyRotation => PDN_START_STEADY_ROTATION,
        Start::RigidRotation => PDN_START_RIGID_ROTATION,
        Start::RaisedInertia => PDN_START_RAISED_INERTIA,
        Start::March => PDN_START_MARCH,
        Start::LoweredDamping => PDN_START_LOWERED_DAMPING,
        Start::RaisedLoads => PDN_START_RAISED_LOADS,
    }
}

fn read_start(value: i32) -> Result<InitialGuess> {
    Ok(InitialGuess::By(match value {
        PDN_START_AUTOMATIC => return Ok(InitialGuess::Default),
        PDN_START_QUASI_STATIC => Start::QuasiStatic,
        PDN_START_STEADY_ROTATION => Start::SteadyRotation,
        PDN_START_RIGID_ROTATION => Start::RigidRotation,
        PDN_START_RAISED_INERTIA => Start::RaisedInertia,
        PDN_START_MARCH => Start::March,
        PDN_START_LOWERED_DAMPING => Start::LoweredDamping,
        PDN_START_RAISED_LOADS => Start::RaisedLoads,
        _ => {
            let expected = "a constant PDN_START_...";
            return Err(Error::value("options.start", expected, value));
        }
    }))
}

pub(super) fn read_options(
    call: &Call,
    given: &pdn_periodic_options,
    model: &Model,
    period: f64,
) -> Result<PeriodicOptions> {
    call.number(given.tolerance, "options.tolerance")?;
    let grid_points = match given.harmonics {
        0 => given.grid_points,
        harmonics => harmonics.saturating_mul(2).saturating_add(1),
    };
    const MOST: usize = 1 << 24;
    if grid_points > MOST {
        let (name, most, got) = match given.harmonics {
            0 => ("options.grid_points", MOST, grid_points),
            harmonics => ("options.harmonics", (MOST - 1) / 2, harmonics),
        };
        return Err(Error::size(name, format!("at most {most}"), got));
    }
    if given.largest_grid_points > MOST {
        let got = given.largest_grid_points;
        let expected = format!("at most {MOST}");
        return Err(Error::size("options.largest_grid_points", expected, got));
    }
    let mut time_map = read_time_map(call, given, period)?;
    let grid_of = |points: usize| {
        model.require_grid_points("options.grid_points", points)?;
        TimeGrid::even_or_odd(points, period)
    };
    // Without a number of points, the grid that a given start is on.
    let (points, grid) = match grid_points {
        0 => {
            call.number(given.error_tolerance, "options.error_tolerance")?;
            call.number(given.response_tolerance, "options.response_tolerance")?;
            let adaptation = Adaptation {
                error_tolerance: given.error_tolerance,
                response_tolerance: given.response_tolerance,
                largest: given.largest_grid_points,
            };
            (GridPoints::Adaptive(adaptation), None)
        }
        points => (GridPoints::Fixed(points), Some(grid_of(points)?)),
    };
    let start = read_start(given.start)?;
    let arrays = [given.guess_positions, given.guess_rotations];
    let is_given = !given.initial.is_null() || arrays.iter().any(|array| !array.is_null());
    if is_given && given.start != PDN_START_AUTOMATIC {
        let expected = "PDN_START_AUTOMATIC, as a start is given";
        return Err(Error::value("options.start", expected, given.start));
    }
    let guess = if !given.initial.is_null() {
        let initial = call.shared(given.initial, "options.initial")?;
        let events = initial.grid().map().events(period);
        if time_map == TimeMapping::Automatic && grid.is_none() && !events.is_empty() {
            time_map = TimeMapping::Events(events);
        }
        let map = time_map.given(period)?;
        let grid = match (grid, points) {
            (Some(grid), _) => grid,
            (None, GridPoints::Adaptive(adaptation)) => {
                grid_of(adaptation.start_from(initial.grid().points()))?
            }
            (None, GridPoints::Fixed(points)) => grid_of(points)?,
        };
        require_states(model.node_count(), grid.points())?;
        InitialGuess::State(initial.prolonged_to(model, grid.mapped(map))?)
    } else if given.guess_positions.is_null() && given.guess_rotations.is_null() {
        start
    } else {
        let grid = grid.ok_or_else(|| {
            let expected = "the number of points of options.guess_positions";
            Error::size("options.grid_points", expected, 0)
        })?;
        InitialGuess::State(read_guess(call, given, model, grid)?)
    };
    Ok(PeriodicOptions {
        linear: read_linear_solver(given.linear_solver)?,
        threads: read_threads(given.threads)?,
        oversampling: given.oversampling,
        estimate_mesh: match given.estimate_mesh {
            0 => false,
            1 => true,
            other => return Err(Error::value("options.estimate_mesh", "0 or 1", other)),
        },
        work_limit: call.number(given.work_limit, "options.work_limit")?,
        grid_points: points,
        time_map,
        memory_limit: given.memory_limit,
        newton: NewtonOptions {
            tolerance: given.tolerance,
            iteration_limit: given.iteration_limit,
        },
        guess,
        watch: watch(given.progress, given.progress_data, {
            call.number(given.progress_interval, "options.progress_interval")?
        })?,
    })
}

fn read_time_map(call: &Call, given: &pdn_periodic_options, period: f64) -> Result<TimeMapping> {
    match given.time_map {
        PDN_TIME_MAP_AUTOMATIC => Ok(TimeMapping::Automatic),
        PDN_TIME_MAP_EQUISPACED => Ok(TimeMapping::Equispaced),
        PDN_TIME_MAP_EVENTS => {
            let count = given.event_count;
            if !(1..=TimeMap::MOST_EVENTS).contains(&count) {
                let expected = format!("1 to {}", TimeMap::MOST_EVENTS);
                return Err(Error::size("options.event_count", expected, count));
            }
            let times = call.numbers(given.event_times, count, "options.event_times")?;
            let widths = call.numbers(given.event_widths, count, "options.event_widths")?;
            let shares = call.numbers(given.event_shares, count, "options.event_shares")?;
            let event = |i: usize| SharpEvent {
                time: times[i],
                width: widths[i],
                share: shares[i],
            };
            let mapping = TimeMapping::Events((0..count).map(event).collect());
            mapping.given(period).map_err(|e| e.within("options"))?;
            Ok(mapping)
        }
        other => {
            let expected = "a constant PDN_TIME_MAP_...";
            Err(Error::value("options.time_map", expected, other))
        }
    }
}

pub(super) fn read_threads(value: i32) -> Result<usize> {
    const MOST: i32 = 1024;
    match usize::try_from(value) {
        Ok(threads) if value <= MOST => Ok(threads),
        _ => {
            let expected = format!("from 0 to {MOST}");
            Err(Error::value("options.threads", expected, value))
        }
    }
}

fn read_guess(
    call: &Call,
    given: &pdn_periodic_options,
    model: &Model,
    grid: TimeGrid,
) -> Result<GridState> {
    for (pointer, name) in [
        (given.guess_positions, "options.guess_positions"),
        (given.guess_rotations, "options.guess_rotations"),
    ] {
        if pointer.is_null() {
            return Err(null(name));
        }
    }
    require_states(model.node_count(), grid.points())?;
    let count = grid.points() * model.node_count();
    let positions = call.numbers(given.guess_positions, 3 * count, "options.guess_positions")?;
    let rotations = call.numbers(given.guess_rotations, 9 * count, "options.guess_rotations")?;
    let system = System::new(model, grid.period())?;
    let mut state = GridState::reference(&system, grid);
    for (i, motion) in state.motions.iter_mut().enumerate() {
        *motion = read_motion(positions, rotations, i, "options.guess_rotations")?;
    }
    state.track_through(&system);
    Ok(state)
}

/// Motion number `i` of arrays of positions and rotation matrices.
pub(super) fn read_motion(
    positions: &[f64],
    rotations: &[f64],
    i: usize,
    name: &str,
) -> Result<Motion> {
    let rotation = Matrix3::from_column_slice(&rotations[9 * i..9 * i + 9]);
    // Entries written with 9 digits pass, and are then cleaned.
    if !is_rotation(&rotation, 1e-8) {
        let got = format!("a matrix that is none (number {i})");
        return Err(Error::value(name, "rotation matrices", got));
    }
    let position = Vector3::from_column_slice(&positions[3 * i..3 * i + 3]);
    Ok(Motion::new(polar_rotation(&rotation), position))
}
