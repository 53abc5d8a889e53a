//! Solutions: how they came out, and their quantities at any time.

use super::guard::{free, guard, guard_or, init};
use super::handle::Handle;
use super::last_error::copy_message;
use super::linear_solver::linear_solver_code;
use super::options::Options;
use super::status::pdn_status;
use crate::collocation::DecayKind;
use crate::error::{Error, Result};
use crate::fourier::SharpEvent;
use crate::model::Labels;
use crate::output::Solution;
use crate::quantity::require_numbers;
use crate::solve::{Iteration, Outcome};
use libc::c_char;

/// A solution, converged or not. Made by ::pdn_solve_periodic, ::pdn_solve_static,
/// ::pdn_solve_march and ::pdn_modes_motion, freed by ::pdn_solution_free.
///
/// That of a march is a trajectory: the same functions give its quantities at times from its first
/// to its last (PDN_ERR_VALUE for any other), but it has no harmonics (PDN_ERR_NOT_AVAILABLE).
pub struct pdn_solution {
    _private: [u8; 0],
}

impl Handle for pdn_solution {
    type Core = Solution;

    fn labels(core: &Solution) -> Option<&Labels> {
        Some(core.model().labels())
    }
}

/// Outcome: converged. With PDN_TOLERANCE_NOT_MET the only outcomes that are solutions.
pub const PDN_CONVERGED: i32 = 2400;
/// Outcome: the iteration limit was reached.
pub const PDN_ITERATION_LIMIT: i32 = 2401;
/// Outcome: no step along the Newton direction brings progress.
pub const PDN_STALLED: i32 = 2402;
/// Outcome: the Jacobian is singular; something is free to move, or in resonance without damping.
pub const PDN_SINGULAR: i32 = 2403;
/// Outcome: the progress callback cancelled the solve.
pub const PDN_CANCELLED: i32 = 2404;
/// Outcome: no initial guess could be found.
pub const PDN_NO_INITIAL_GUESS: i32 = 2405;
/// Outcome: constraints that depend on each other contradict each other; the mechanism is locked,
/// or cannot close.
pub const PDN_INCONSISTENT: i32 = 2406;
/// Outcome: a joint has closed turned over, its axes against each other; the report names it.
pub const PDN_WRONG_ASSEMBLY: i32 = 2407;
/// Outcome: converged on the last grid tried, but the estimated error misses the tolerance, as the
/// report explains; quantities are as good as pdn_diagnostics.error_estimate says.
pub const PDN_TOLERANCE_NOT_MET: i32 = 2408;
/// Outcome: all work was done that pdn_periodic_options.work_limit allows, and the report tells
/// what was tried; or as many steps of a march are kept as pdn_march_options.memory_limit allows.
pub const PDN_WORK_LIMIT: i32 = 2409;

/// Decay of harmonics: not known, as there are too few or the solve has not converged.
pub const PDN_DECAY_UNKNOWN: i32 = 2500;
/// Decay of harmonics: fast, as of a smooth response that the grid resolves.
pub const PDN_DECAY_FAST: i32 = 2501;
/// Decay of harmonics: no faster than the fourth power of their number. The response has a kink, or
/// a peak too narrow for the grid; forces may oscillate about their values.
pub const PDN_DECAY_SLOW: i32 = 2502;
/// Decay of harmonics: they have fallen to rounding; a finer grid gains nothing.
pub const PDN_DECAY_ROUNDING: i32 = 2503;

/// Axes of a joint reaction: the joint frame on the first body.
pub const PDN_FRAME_FIRST: i32 = 1603;
/// Axes of a joint reaction: the joint frame on the second body.
pub const PDN_FRAME_SECOND: i32 = 1604;

/// Frees a solution; NULL does nothing.
///
/// @param solution  the solution, not to be used any more
///
/// Threads: exclusive use of `solution`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_solution_free(solution: *mut pdn_solution) {
    free(solution);
}

pub(super) fn outcome_code(outcome: Outcome) -> i32 {
    match outcome {
        Outcome::Converged => PDN_CONVERGED,
        Outcome::IterationLimit => PDN_ITERATION_LIMIT,
        Outcome::Stalled => PDN_STALLED,
        Outcome::Singular => PDN_SINGULAR,
        Outcome::Cancelled => PDN_CANCELLED,
        Outcome::NoInitialGuess => PDN_NO_INITIAL_GUESS,
        Outcome::Inconsistent => PDN_INCONSISTENT,
        Outcome::WrongAssembly => PDN_WRONG_ASSEMBLY,
        Outcome::ToleranceNotMet => PDN_TOLERANCE_NOT_MET,
        Outcome::WorkLimit => PDN_WORK_LIMIT,
    }
}

/// The outcome of this code.
pub(super) fn read_outcome(code: i32) -> Result<Outcome> {
    let all = [
        Outcome::Converged,
        Outcome::IterationLimit,
        Outcome::Stalled,
        Outcome::Singular,
        Outcome::Cancelled,
        Outcome::NoInitialGuess,
        Outcome::Inconsistent,
        Outcome::WrongAssembly,
        Outcome::ToleranceNotMet,
        Outcome::WorkLimit,
    ];
    let found = all
        .into_iter()
        .find(|outcome| outcome_code(*outcome) == code);
    found.ok_or_else(|| Error::value("outcome", "a constant such as PDN_CONVERGED", code))
}

/// How the solve ended.
///
/// Unless it is PDN_CONVERGED or PDN_TOLERANCE_NOT_MET the solution's quantities are those of the
/// last iterate.
///
/// @param solution  the solution; not NULL
/// @return PDN_CONVERGED, PDN_ITERATION_LIMIT, PDN_STALLED, PDN_SINGULAR, PDN_CANCELLED,
///     PDN_NO_INITIAL_GUESS, PDN_INCONSISTENT, PDN_WRONG_ASSEMBLY, PDN_TOLERANCE_NOT_MET or
///     PDN_WORK_LIMIT; negative, as a ::pdn_status, if the handle is not valid
///
/// Threads: like `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_solution_outcome(solution: *const pdn_solution) -> i32 {
    let mut outcome = 0;
    let status = guard(|call| {
        outcome = outcome_code(call.shared(solution, "solution")?.outcome());
        Ok(())
    });
    if status < 0 { status } else { outcome }
}

/// A readable report: outcome and why, iterations, error estimates, time spent.
///
/// @param solution  the solution; not NULL
/// @param buffer  array of length [capacity] for the text, UTF-8, always ended by NUL; may be NULL
///     if capacity is 0
/// @param capacity  size of buffer in bytes
/// @return length of the whole report without the NUL, as snprintf does; 0 if the handle is not
///     valid
///
/// Threads: like `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_solution_report(
    solution: *const pdn_solution,
    buffer: *mut c_char,
    capacity: usize,
) -> usize {
    guard_or(0, |call| {
        let report = call.shared(solution, "solution")?.report();
        copy_message(&report, buffer, capacity);
        Ok(report.len())
    })
}

/// The report as JSON, for programs: an object with the texts `kind`, `outcome`, `explanation` and
/// `report`; sizes; `grids` and `attempts`; the Newton `iterations`; `estimates`, named as in
/// pdn_diagnostics; what iteration of `linear` equations took; and `seconds`. What is not known, or
/// does not apply, is null.
///
/// @param solution  the solution; not NULL
/// @param buffer  array of length [capacity] for the text, UTF-8, always ended by NUL; may be NULL
///     if capacity is 0
/// @param capacity  size of buffer in bytes
/// @return length of the whole text without the NUL, as snprintf does; 0 if the handle is not valid
///
/// Threads: like `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_solution_report_json(
    solution: *const pdn_solution,
    buffer: *mut c_char,
    capacity: usize,
) -> usize {
    guard_or(0, |call| {
        let report = call.shared(solution, "solution")?.report_json();
        copy_message(&report, buffer, capacity);
        Ok(report.len())
    })
}

/// Figures of a solve. Initialise with `PDN_INIT(pdn_diagnostics, &diagnostics)`.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct pdn_diagnostics {
    /// Set by the initialiser.
    pub struct_size: usize,
    /// Outcome, as ::pdn_solution_outcome.
    pub outcome: i32,
    /// Newton iterations of the periodic problem.
    pub iterations: i32,
    /// Newton iterations of the initial guess, each at a single instant.
    pub guess_iterations: i32,
    /// Constraints that depend on others, and are tolerated: the reactions given are those of least
    /// norm.
    pub redundant_constraints: i32,
    /// Number of grid points; of a march the number of times kept.
    pub grid_points: usize,
    /// Number of unknowns of the periodic problem, or of a step.
    pub unknowns: usize,
    /// Largest increment of the last iteration, as ::pdn_progress.
    pub last_increment: f64,
    /// Estimated error of the motions at all times: lengths relative to the size of the mechanism,
    /// angles in radians; infinite if it cannot be had. From the decay of their harmonics, the
    /// violation of constraints between grid points and, if several grids were tried, the
    /// difference between two of them. Velocities and forces have larger errors: see
    /// force_residual_between.
    pub error_estimate: f64,
    /// Largest residual force between grid points, relative to the largest force that any
    /// element exerts; infinite if the motion cannot be interpolated. Large values mean aliasing.
    pub force_residual_between: f64,
    /// Largest violation of a constraint between grid points: lengths relative to the size of
    /// the mechanism, angles in radians; infinite if the motion cannot be interpolated.
    pub constraint_residual_between: f64,
    /// Seconds spent on the initial guess: quasi-static motions, marches, and what is carried from
    /// grid to grid.
    pub guess_seconds: f64,
    /// Seconds spent on elements and assembly, on all grids and in all attempts, as all that
    /// follows.
    pub assembly_seconds: f64,
    /// Seconds spent on symbolic analysis.
    pub analysis_seconds: f64,
    /// Seconds spent on numeric factorisation of whole Jacobians.
    pub factorisation_seconds: f64,
    /// Seconds spent on forward and backward substitution, or on iteration.
    pub substitution_seconds: f64,
    /// How the upper half of the harmonics of motions falls: PDN_DECAY_FAST, PDN_DECAY_SLOW, ...
    pub decay: i32,
    /// Number of grids that an adaptive solve tried; 0 if their number of points was given.
    pub grids: i32,
    /// Exponent p of that fall, if harmonic j is as j^-p: 2 where velocities jump, 3 where
    /// accelerations do; of a smooth response ever larger with more grid points. 0 if it is not
    /// known.
    pub decay_order: f64,
    /// Time at which the upper half of the harmonics adds up to most: where a kink or narrow peak
    /// is.
    pub least_resolved_time: f64,
    /// How the linear equations of the last grid were solved: PDN_LINEAR_DIRECT,
    /// PDN_LINEAR_BODY_CIRCULANT, ...
    pub linear_solver: i32,
    /// Products with the Jacobian that iteration took, in all linear solves on that grid.
    pub linear_iterations: i32,
    /// Linear solves by iteration on that grid.
    pub linear_solves: i32,
    /// Largest number of products of one of them.
    pub most_linear_iterations: i32,
    /// Bytes that iteration took at most; 0 if there was none.
    pub linear_bytes: usize,
    /// Seconds spent on preconditioners, without the system of joints that turn.
    pub preconditioner_seconds: f64,
    /// Seconds spent on that system.
    pub interface_seconds: f64,
    /// Seconds spent on error estimates, and on why a Jacobian is singular.
    pub estimate_seconds: f64,
    /// Seconds of the whole solve: all of these, and the little that is none of them.
    pub total_seconds: f64,
    /// Newton iterations on all grids and in all attempts, without those of the initial guess.
    pub total_iterations: i32,
    /// Attempts, each from another start, as the report lists them; 0 where the start was given.
    pub attempts: i32,
    /// Estimated error of the motions of nodes by the mesh of beams, measured as error_estimate,
    /// which says nothing of the mesh: what elements of a higher degree would make of them. 0
    /// without beams; infinite unless asked for, of a march, of modes, and where it cannot be had.
    pub mesh_error: f64,
}

// SAFETY: all fields are plain numbers, `struct_size` is the first, no padding.
unsafe impl Options for pdn_diagnostics {
    const SIZES: &'static [usize] = &[112, 136, 160, 208];
}

/// Prepares a struct for ::pdn_solution_diagnostics; use `PDN_INIT(pdn_diagnostics, &diagnostics)`.
///
/// @param diagnostics  the struct; not NULL
/// @param struct_size  `sizeof *diagnostics`
///
/// Threads: any.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_diagnostics_init(
    diagnostics: *mut pdn_diagnostics,
    struct_size: usize,
) {
    init(diagnostics, struct_size, "diagnostics");
}

/// Figures of a solve: iterations, error estimates, residuals between grid points, time spent.
///
/// @param solution  the solution; not NULL
/// @param out  initialised by PDN_INIT; filled on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE
///
/// Threads: like `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_solution_diagnostics(
    solution: *const pdn_solution,
    out: *mut pdn_diagnostics,
) -> pdn_status {
    guard(|call| {
        let solution = call.shared(solution, "solution")?;
        let out = call.out_struct(out, "out")?;
        let details = solution.details();
        let timings = details.timings;
        let iterations = &details.report.iterations;
        let count = |n: usize| i32::try_from(n).unwrap_or(i32::MAX);
        let between = solution.diagnostics().between;
        let periodic = details.periodic();
        let iterative = periodic.and_then(|record| record.iterative.as_ref());
        let products = iterative.map_or(&[][..], |record| &record.products);
        out.set(pdn_diagnostics {
            outcome: outcome_code(solution.outcome()),
            iterations: count(iterations.len()),
            guess_iterations: count(details.guess_iterations),
            redundant_constraints: count(details.system.redundant_constraints()),
            grid_points: details.state.points(),
            unknowns: solution.unknowns(),
            last_increment: iterations.last().map_or(f64::INFINITY, |i| i.increment),
            error_estimate: solution.diagnostics().error_estimate,
            mesh_error: solution.diagnostics().mesh_error,
            force_residual_between: between.force,
            constraint_residual_between: between.constraint,
            guess_seconds: details.guess_time.as_secs_f64(),
            assembly_seconds: timings.assembly.as_secs_f64(),
            analysis_seconds: timings.analysis.as_secs_f64(),
            factorisation_seconds: timings.factorisation.as_secs_f64(),
            preconditioner_seconds: timings.preconditioner.as_secs_f64(),
            interface_seconds: timings.interface.as_secs_f64(),
            estimate_seconds: timings.estimates.as_secs_f64(),
            total_seconds: details.total_time.as_secs_f64(),
            total_iterations: count(details.total_iterations),
            attempts: count(periodic.map_or(0, |record| record.attempts.len())),
            substitution_seconds: timings.substitution.as_secs_f64(),
            decay: match solution.diagnostics().decay {
                DecayKind::Unknown => PDN_DECAY_UNKNOWN,
                DecayKind::Fast => PDN_DECAY_FAST,
                DecayKind::Slow => PDN_DECAY_SLOW,
                DecayKind::Rounding => PDN_DECAY_ROUNDING,
            },
            grids: count(periodic.map_or(0, |record| record.grids.len())),
            linear_solver: linear_solver_code(iterative),
            linear_iterations: count(products.iter().sum()),
            linear_solves: count(products.len()),
            most_linear_iterations: count(products.iter().copied().max().unwrap_or(0)),
            linear_bytes: iterative.map_or(0, |record| record.bytes),
            decay_order: solution.diagnostics().decay_order,
            least_resolved_time: solution.diagnostics().least_resolved_time,
            ..pdn_diagnostics::defaults()
        });
        Ok(())
    })
}

/// History of the Newton iterations of the periodic problem.
///
/// @param solution  the solution; not NULL
/// @param residuals  array of length [count] for the largest residual before each iteration; may be
///     NULL
/// @param increments  array of length [count] for the largest increment of each; may be NULL
/// @param steps  array of length [count] for the fraction of the increment taken; may be NULL
/// @param count  number of iterations, as pdn_diagnostics.iterations tells
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_SIZE, PDN_ERR_OVERFLOW
///
/// Threads: like `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_solution_history(
    solution: *const pdn_solution,
    residuals: *mut f64,
    increments: *mut f64,
    steps: *mut f64,
    count: usize,
) -> pdn_status {
    guard(|call| {
        let solution = call.shared(solution, "solution")?;
        let iterations = &solution.details().report.iterations;
        require_count(count, iterations.len())?;
        type Column = fn(&Iteration) -> f64;
        let columns: [(_, Column); 3] = [
            (
                call.out_slice_optional(residuals, count, "residuals")?,
                |i| i.residual,
            ),
            (
                call.out_slice_optional(increments, count, "increments")?,
                |i| i.increment,
            ),
            (call.out_slice_optional(steps, count, "steps")?, |i| i.step),
        ];
        for (out, value) in columns {
            if let Some(out) = out {
                let values: Vec<f64> = iterations.iter().map(value).collect();
                require_numbers("history", &values)?;
                out.set(&values);
            }
        }
        Ok(())
    })
}

/// Decay of the harmonics: largest amplitude of each over all nodes, of positions relative to the
/// size of the mechanism and of entries of rotation matrices.
///
/// @param solution  the solution; not NULL
/// @param amplitudes  array of length [count], harmonics 0, 1, ..., (N - 1) / 2
/// @param count  (pdn_diagnostics.grid_points + 1) / 2
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_SIZE, PDN_ERR_OVERFLOW
///
/// Threads: like `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_solution_decay(
    solution: *const pdn_solution,
    amplitudes: *mut f64,
    count: usize,
) -> pdn_status {
    guard(|call| {
        let solution = call.shared(solution, "solution")?;
        let harmonics = &solution.diagnostics().harmonics;
        require_count(count, harmonics.len())?;
        require_numbers("amplitudes", harmonics)?;
        call.out_slice(amplitudes, count, count, "amplitudes")?
            .set(harmonics);
        Ok(())
    })
}

/// Number of events that the grid points of a solution are closer together about: 0 if they are
/// equispaced.
///
/// @param solution  the solution; not NULL
/// @param out  the number; written on success only
/// @return PDN_OK, PDN_ERR_NULL
///
/// Threads: like `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_solution_sharp_event_count(
    solution: *const pdn_solution,
    out: *mut usize,
) -> pdn_status {
    guard(|call| {
        let solution = call.shared(solution, "solution")?;
        let out = call.out(out, "out")?;
        let grid = solution.grid();
        out.set(grid.map().events(grid.period()).len());
        Ok(())
    })
}

/// Events that the grid points of a solution are closer together about, those of
/// pdn_periodic_options or such as a solve to a tolerance has found.
///
/// @param solution  the solution; not NULL
/// @param times  array of length [count]: their times
/// @param widths  array of length [count]: half-widths of the additional density of grid points
/// @param shares  array of length [count]: shares of the grid points, beside 1 for the rest
/// @param count  their number, of ::pdn_solution_sharp_event_count
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_SIZE
///
/// Threads: like `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_solution_sharp_events(
    solution: *const pdn_solution,
    times: *mut f64,
    widths: *mut f64,
    shares: *mut f64,
    count: usize,
) -> pdn_status {
    guard(|call| {
        let solution = call.shared(solution, "solution")?;
        let grid = solution.grid();
        let events = grid.map().events(grid.period());
        require_count(count, events.len())?;
        let times = call.out_slice(times, count, count, "times")?;
        let widths = call.out_slice(widths, count, count, "widths")?;
        let shares = call.out_slice(shares, count, count, "shares")?;
        let all = |of: fn(&SharpEvent) -> f64| events.iter().map(of).collect::<Vec<f64>>();
        times.set(&all(|event| event.time));
        widths.set(&all(|event| event.width));
        shares.set(&all(|event| event.share));
        Ok(())
    })
}

/// Grid times t_k = k T / N, unless grid points are closer together about events; of a march the
/// times of its steps, from the start.
///
/// @param solution  the solution; not NULL
/// @param times  array of length [count]
/// @param count  N, the number of grid points, as pdn_diagnostics.grid_points tells
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_SIZE
///
/// Threads: like `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_solution_grid_times(
    solution: *const pdn_solution,
    times: *mut f64,
    count: usize,
) -> pdn_status {
    guard(|call| {
        let solution = call.shared(solution, "solution")?;
        let grid = solution.times();
        require_count(count, grid.len())?;
        call.out_slice(times, count, count, "times")?.set(&grid);
        Ok(())
    })
}

pub(super) fn require_count(count: usize, expected: usize) -> Result<()> {
    if count != expected {
        return Err(Error::size("count", expected, count));
    }
    Ok(())
}
