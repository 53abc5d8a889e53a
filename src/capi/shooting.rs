//! Periodic motions by shooting.

use super::call::Call;
use super::guard::{guard, init};
use super::model::pdn_model;
use super::options::Options;
use super::periodic::{PROGRESS_INTERVAL, pdn_progress_fn, watch};
use super::solution::pdn_solution;
use super::status::pdn_status;
use crate::error::{Error, Result};
use crate::model::Model;
use crate::output::Solution;
use crate::solve::{MarchStart, NewtonOptions, ShootingOptions};
use libc::c_void;

/// Options of ::pdn_solve_shooting. Set the defaults by `PDN_INIT(pdn_shooting_options, &options)`.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct pdn_shooting_options {
    /// Set by the initialiser.
    pub struct_size: usize,
    /// Number of equal steps to the period. Default 200.
    pub steps_per_period: usize,
    /// Periods marched for the first guess. Default 1.
    pub guess_periods: usize,
    /// Spectral radius at infinite frequency, from 0 to less than 1, as in ::pdn_march_options.
    /// Default 0.5.
    pub spectral_radius: f64,
    /// Converged when the largest increment of a motion or velocity at the start (lengths relative
    /// to the size of the mechanism, angles in radians, velocities in the time T / (2 pi)) is below
    /// this. Default 1e-8.
    pub tolerance: f64,
    /// Most Newton iterations. Default 30.
    pub iteration_limit: usize,
    /// Start the march from this solution of a model with the same nodes and joints, at its time 0
    /// or, of a march, at its first time; NULL for the reference configuration at rest. Default
    /// NULL.
    pub initial: *const pdn_solution,
    /// Told of each period of the guess and of each iteration, and about ten times a second while
    /// one lasts; may cancel. Default NULL.
    pub progress: pdn_progress_fn,
    /// Handed to progress.
    pub progress_data: *mut c_void,
    /// Bytes of memory that the solve may take, by an estimate that is made before it begins: what
    /// would take more is PDN_ERR_MEMORY, and the message tells the estimate. 0 for no limit but
    /// that of the system. Default 0.
    pub memory_limit: usize,
}

// SAFETY: all fields are plain numbers or pointers, `struct_size` is the first, no padding.
unsafe impl Options for pdn_shooting_options {
    const SIZES: &'static [usize] = &[72, 80];

    fn defaults() -> Self {
        let core = ShootingOptions::default();
        pdn_shooting_options {
            steps_per_period: core.steps,
            guess_periods: core.guess_periods,
            spectral_radius: core.spectral_radius,
            tolerance: core.newton.tolerance,
            iteration_limit: core.newton.iteration_limit,
            ..Self::blank()
        }
    }
}

/// Sets default options; use `PDN_INIT(pdn_shooting_options, &options)`.
///
/// @param options  the options; not NULL
/// @param struct_size  `sizeof *options`
///
/// Threads: any.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_shooting_options_init(
    options: *mut pdn_shooting_options,
    struct_size: usize,
) {
    init(options, struct_size, "options");
}

/// Finds the periodic response of a model by shooting: Newton's method on the period map of
/// ::pdn_solve_march.
///
/// What is found is the periodic motion of the marching scheme, of second order in its step; the
/// derivative of the map is exact. It needs time and memory that grow with the square of the number
/// of nodes; it is there to compare with, and for the Floquet multipliers, which tell whether the
/// motion is stable.
///
/// The solution is a trajectory over one period, from 0 to T. Not converging is no error:
/// ::pdn_solution_outcome tells. A motion that may be shifted in time or space, as without a drive
/// or without damping, is PDN_SINGULAR.
///
/// @param model  the model; it is copied, so that later changes do not touch the solution
/// @param period  T, the period of the response; harmonics of signals are those of this period
/// @param options  may be NULL for the defaults
/// @param out  the solution, also if it has not converged; free it with ::pdn_solution_free;
///     written on success only
/// @return PDN_OK; PDN_ERR_NULL; PDN_ERR_NOT_FINITE; PDN_ERR_VALUE; PDN_ERR_STRUCT_SIZE;
///     PDN_ERR_MODEL (no node, a beam too distorted); PDN_ERR_NOT_PERIODIC (a prescribed motion or
///     load that does not repeat); PDN_ERR_GRID_TOO_COARSE (of the initial solution);
///     PDN_ERR_CALLBACK (of a signal or force); PDN_ERR_MEMORY
///
/// Threads: like a `const` use of `model` and of `options.initial`. Signals' functions and
/// `progress` are called on this thread.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_solve_shooting(
    model: *const pdn_model,
    period: f64,
    options: *const pdn_shooting_options,
    out: *mut *mut pdn_solution,
) -> pdn_status {
    guard(|call| {
        let model = call.shared(model, "model")?;
        let period = call.number(period, "period")?;
        let given = call.options(options, "options")?;
        let out = call.out(out, "out")?;
        let options = read_shooting_options(call, &given, &model)?;
        out.give(Solution::solve_shooting(
            &model,
            period,
            &options,
            &mut |_, _| true,
        )?);
        Ok(())
    })
}

fn read_shooting_options(
    call: &Call,
    given: &pdn_shooting_options,
    model: &Model,
) -> Result<ShootingOptions> {
    call.number(given.spectral_radius, "options.spectral_radius")?;
    call.number(given.tolerance, "options.tolerance")?;
    let start = if given.initial.is_null() {
        MarchStart::Reference
    } else {
        let initial = call.shared(given.initial, "options.initial")?;
        initial.require_same_shape(model)?;
        let first = initial.times().first().copied().unwrap_or(0.0);
        MarchStart::State(initial.start_state(first)?)
    };
    Ok(ShootingOptions {
        steps: given.steps_per_period,
        start,
        guess_periods: given.guess_periods,
        spectral_radius: given.spectral_radius,
        newton: NewtonOptions {
            tolerance: given.tolerance,
            iteration_limit: given.iteration_limit,
        },
        memory_limit: given.memory_limit,
        watch: watch(given.progress, given.progress_data, PROGRESS_INTERVAL)?,
    })
}

/// Number of Floquet multipliers of a solution: as many as the system has states, if
/// ::pdn_solve_shooting found them; of a periodic solution as many as ::pdn_solve_stability finds,
/// which is called with default options unless it has been before.
///
/// @param solution  a solution of ::pdn_solve_periodic, or one like it, that has converged, of
///     ::pdn_solve_shooting or of ::pdn_solve_march; not NULL
/// @param out  the number; zero of a march; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_AVAILABLE (of an equilibrium or a small motion, and of
///     what has not converged); else as ::pdn_solve_stability
///
/// Threads: like `const`. Functions of the model may be called on this thread.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_solution_floquet_count(
    solution: *const pdn_solution,
    out: *mut usize,
) -> pdn_status {
    guard(|call| {
        let solution = call.shared(solution, "solution")?;
        let out = call.out(out, "out")?;
        out.set(solution.floquet()?.len());
        Ok(())
    })
}

/// Floquet multipliers: what disturbances of the motion are multiplied by in a period, the largest
/// first.
///
/// The motion is stable if all are smaller than 1 in magnitude. Those of shooting are of the
/// marching scheme, with its error and its numerical damping; ::pdn_solve_stability tells more of
/// those of periodic solutions.
///
/// @param solution  as for ::pdn_solution_floquet_count; not NULL
/// @param real  array of length [count] for the real parts
/// @param imaginary  array of length [count] for the imaginary parts
/// @param count  their number, as ::pdn_solution_floquet_count tells
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_SIZE, PDN_ERR_NOT_AVAILABLE as there; else as
///     ::pdn_solve_stability
///
/// Threads: like `const`. Functions of the model may be called on this thread.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_solution_floquet(
    solution: *const pdn_solution,
    real: *mut f64,
    imaginary: *mut f64,
    count: usize,
) -> pdn_status {
    guard(|call| {
        let solution = call.shared(solution, "solution")?;
        let multipliers = solution.floquet()?;
        if count != multipliers.len() {
            return Err(Error::size("count", multipliers.len(), count));
        }
        let real = call.out_slice(real, count, count, "real")?;
        let imaginary = call.out_slice(imaginary, count, count, "imaginary")?;
        real.set(&multipliers.iter().map(|z| z[0]).collect::<Vec<_>>());
        imaginary.set(&multipliers.iter().map(|z| z[1]).collect::<Vec<_>>());
        Ok(())
    })
}
