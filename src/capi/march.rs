//! Marching in time.

use super::call::Call;
use super::guard::{guard, init};
use super::model::pdn_model;
use super::options::Options;
use super::periodic::{PROGRESS_INTERVAL, pdn_progress_fn, read_motion, watch};
use super::pointer::null;
use super::solution::pdn_solution;
use super::status::pdn_status;
use crate::error::{Error, ErrorKind, Result};
use crate::model::Model;
use crate::output::Solution;
use crate::solve::{MarchEnd, MarchOptions, MarchStart, NewtonOptions, StartState};
use libc::c_void;
use nalgebra::{Vector3, Vector6};

/// Options of ::pdn_solve_march. Set the defaults by `PDN_INIT(pdn_march_options, &options)`.
///
/// There is no default of how long to march and in which steps: set duration or periodic_tolerance,
/// and step or steps_per_period.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct pdn_march_options {
    /// Set by the initialiser.
    pub struct_size: usize,
    /// When the march starts. Default 0.
    pub start_time: f64,
    /// How long it is; leave it 0 to march until periodic. Default 0.
    pub duration: f64,
    /// Period T that harmonics and samples of signals refer to, and that the motion may repeat
    /// itself with; 0 if neither matters. Steps must not be longer, unless error_tolerance chooses
    /// them. Default 0.
    pub period: f64,
    /// Length of the steps, made shorter by what lets a whole number of them fit the duration or
    /// the period. With error_tolerance the length of the first. Default 0.
    pub step: f64,
    /// If not 0, the steps are period / steps_per_period. Default 0.
    pub steps_per_period: usize,
    /// Spectral radius at infinite frequency, from 0 to 1: the numerical damping. With 1 no energy
    /// is lost, but the reactions of joints oscillate; 0 removes at once what the steps do not
    /// resolve. Default 0.5.
    pub spectral_radius: f64,
    /// If not 0, steps are chosen so that each has at most this estimated error of a motion
    /// (lengths relative to the size of the mechanism, angles in radians). Default 0.
    pub error_tolerance: f64,
    /// If not 0, march until motions and velocities differ by at most this from the periodic ones,
    /// by how the differences from each period to the next decay: displacements relative to the
    /// size of the mechanism, entries of rotation matrices, velocities likewise in the time T / (2
    /// pi). Default 0.
    pub periodic_tolerance: f64,
    /// Most periods of a march until periodic; then its outcome is PDN_ITERATION_LIMIT. Default
    /// 200.
    pub most_periods: usize,
    /// Keep the steps of only so many of the last periods; all steps if 0. Default 0.
    pub stored_periods: usize,
    /// Newton's method in a step has converged when the largest increment is below this, as in
    /// ::pdn_periodic_options. Default 1e-9.
    pub tolerance: f64,
    /// Most Newton iterations in a step. Default 20.
    pub iteration_limit: usize,
    /// Start from this solution of a model with the same nodes and joints, at start_time: an
    /// equilibrium, a periodic motion or another march; NULL to start otherwise. Default NULL.
    pub initial: *const pdn_solution,
    /// Start from these positions, an array of shape 3 x [nodes]; NULL for those of the reference
    /// configuration. Needs rotations. Default NULL.
    pub positions: *const f64,
    /// Rotation matrices of the same start, an array of shape 9 x [nodes], each column by column.
    /// Default NULL.
    pub rotations: *const f64,
    /// Velocities of the same start, an array of shape 6 x [nodes]: velocity of each node and its
    /// angular velocity, inertial frame; NULL for none. Default NULL.
    pub velocities: *const f64,
    /// Told of each step, and about ten times a second while one lasts; may cancel. Default NULL.
    pub progress: pdn_progress_fn,
    /// Handed to progress.
    pub progress_data: *mut c_void,
    /// Bytes of memory that the steps which are kept may take, by an estimate. A march whose
    /// number of steps is known, and takes more, is PDN_ERR_MEMORY before it begins; another that
    /// comes to take more ends there as PDN_WORK_LIMIT, with what was marched. 0 for no limit but
    /// that of the system. Default 0.
    pub memory_limit: usize,
}

// SAFETY: all fields are plain numbers or pointers, `struct_size` is the first, no padding.
unsafe impl Options for pdn_march_options {
    const SIZES: &'static [usize] = &[152, 160];

    fn defaults() -> Self {
        let core = MarchOptions::with_step(1.0, MarchEnd::Duration(1.0));
        pdn_march_options {
            spectral_radius: core.spectral_radius,
            most_periods: 200,
            tolerance: core.newton.tolerance,
            iteration_limit: core.newton.iteration_limit,
            ..Self::blank()
        }
    }
}

/// Sets default options; use `PDN_INIT(pdn_march_options, &options)`.
///
/// @param options  the options; not NULL
/// @param struct_size  `sizeof *options`
///
/// Threads: any.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_march_options_init(
    options: *mut pdn_march_options,
    struct_size: usize,
) {
    init(options, struct_size, "options");
}

/// Marches a model in time, for a given duration or until its motion repeats itself.
///
/// The generalised-alpha method on SE(3) for the equations of index 3 (Arnold and Bruels 2007;
/// Bruels, Cardona and Arnold 2012), of second order: motions are updated by the exponential map,
/// equilibrium and constraints hold at the end of each step. It starts in the reference
/// configuration at rest unless another start is given, but what hangs on a prescribed rotation
/// turns with it as one rigid body, if the joints let it: a blade is not left behind a hub that
/// spins. Then motions are moved and velocities changed by the least, by inertia, that satisfies
/// the constraints and prescribed motions, and accelerations and reactions follow. Internal states
/// of viscoelastic elements start relaxed, or as they are in the initial solution.
///
/// The solution is a trajectory: the functions of solutions give its quantities at any times from
/// its first to its last. Between steps motions, velocities and joint coordinates are interpolated
/// by cubic polynomials, all else linearly. It has no harmonics. Not reaching the end is no error:
/// ::pdn_solution_outcome tells, and the trajectory is there as far as it came. It serves as
/// `initial` of other solves; of a periodic one, its last period does.
///
/// @param model  the model; it is copied, so that later changes do not touch the solution. Signals
///     that are functions are called with the times of the march, and need not be periodic
/// @param options  not NULL: how long, and in which steps
/// @param out  the solution, also if the march ended early; free it with ::pdn_solution_free;
///     written on success only
/// @return PDN_OK; PDN_ERR_NULL; PDN_ERR_NOT_FINITE; PDN_ERR_VALUE (no duration or step, a period
///     that is needed but not given, an initial solution of another model, rotations that are
///     none); PDN_ERR_STRUCT_SIZE; PDN_ERR_MODEL (no node, a beam too distorted);
///     PDN_ERR_GRID_TOO_COARSE (of the initial solution); PDN_ERR_CALLBACK (of a signal or force);
///     PDN_ERR_OVERFLOW (numbers too large to compute with); PDN_ERR_MEMORY
///
/// Threads: like a `const` use of `model` and of `options.initial`. Signals' functions and
/// `progress` are called on this thread.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_solve_march(
    model: *const pdn_model,
    options: *const pdn_march_options,
    out: *mut *mut pdn_solution,
) -> pdn_status {
    guard(|call| {
        let model = call.shared(model, "model")?;
        call.reference(options.cast::<usize>(), "options")?;
        let given = call.options(options, "options")?;
        let out = call.out(out, "out")?;
        let options = read_march_options(call, &given, &model)?;
        out.give(Solution::march(&model, &options, &mut |_, _| true)?);
        Ok(())
    })
}

fn read_march_options(
    call: &Call,
    given: &pdn_march_options,
    model: &Model,
) -> Result<MarchOptions> {
    for (value, name) in [
        (given.start_time, "options.start_time"),
        (given.duration, "options.duration"),
        (given.period, "options.period"),
        (given.step, "options.step"),
        (given.spectral_radius, "options.spectral_radius"),
        (given.error_tolerance, "options.error_tolerance"),
        (given.periodic_tolerance, "options.periodic_tolerance"),
        (given.tolerance, "options.tolerance"),
    ] {
        call.number(value, name)?;
    }
    let end = match (given.periodic_tolerance != 0.0, given.duration != 0.0) {
        (true, true) => {
            let expected = "zero, as options.periodic_tolerance is given";
            return Err(Error::value("options.duration", expected, given.duration));
        }
        (true, false) => MarchEnd::Periodic {
            tolerance: given.periodic_tolerance,
            most_periods: given.most_periods,
        },
        (false, _) => MarchEnd::Duration(given.duration),
    };
    let step = match (given.steps_per_period, given.step != 0.0) {
        (0, _) => given.step,
        (_, true) => {
            let expected = "zero, as options.steps_per_period is given";
            return Err(Error::value("options.step", expected, given.step));
        }
        (_, false) if given.period == 0.0 => {
            let expected = "the period of options.steps_per_period";
            return Err(Error::value("options.period", expected, 0.0));
        }
        (steps, false) => given.period / steps as f64,
    };
    Ok(MarchOptions {
        start: read_start(call, given, model)?,
        start_time: given.start_time,
        period: (given.period != 0.0).then_some(given.period),
        error_tolerance: (given.error_tolerance != 0.0).then_some(given.error_tolerance),
        spectral_radius: given.spectral_radius,
        newton: NewtonOptions {
            tolerance: given.tolerance,
            iteration_limit: given.iteration_limit,
        },
        stored_periods: given.stored_periods,
        memory_limit: given.memory_limit,
        watch: watch(given.progress, given.progress_data, PROGRESS_INTERVAL)?,
        ..MarchOptions::with_step(step, end)
    })
}

fn read_start(call: &Call, given: &pdn_march_options, model: &Model) -> Result<MarchStart> {
    if !given.initial.is_null() {
        let initial = call.shared(given.initial, "options.initial")?;
        initial.require_same_shape(model)?;
        let start = initial.start_state(given.start_time);
        return Ok(MarchStart::State(start.map_err(|e| {
            // Of a trajectory: the time is not one of its own.
            match e.kind() {
                ErrorKind::Value => e.within("options.start_time"),
                _ => e,
            }
        })?));
    }
    let count = model.node_count();
    let arrays = [given.positions, given.rotations, given.velocities];
    if arrays.iter().all(|array| array.is_null()) {
        return Ok(MarchStart::Reference);
    }
    let mut motions = model.reference_motions().to_vec();
    if !(given.positions.is_null() && given.rotations.is_null()) {
        for (pointer, name) in [
            (given.positions, "options.positions"),
            (given.rotations, "options.rotations"),
        ] {
            if pointer.is_null() {
                return Err(null(name));
            }
        }
        let positions = call.numbers(given.positions, 3 * count, "options.positions")?;
        let rotations = call.numbers(given.rotations, 9 * count, "options.rotations")?;
        for (i, motion) in motions.iter_mut().enumerate() {
            *motion = read_motion(positions, rotations, i, "options.rotations")?;
        }
    }
    let mut twists = Vec::new();
    if !given.velocities.is_null() {
        let velocities = call.numbers(given.velocities, 6 * count, "options.velocities")?;
        for (motion, v) in motions.iter().zip(velocities.chunks_exact(6)) {
            let own = |part: &[f64]| motion.rotation.tr_mul(&Vector3::from_column_slice(part));
            let (linear, angular) = (own(&v[..3]), own(&v[3..]));
            twists.push(Vector6::from_fn(|i, _| {
                if i < 3 { linear[i] } else { angular[i - 3] }
            }));
        }
    }
    Ok(MarchStart::State(StartState {
        motions,
        twists,
        internal: None,
    }))
}

/// Figures of a march. Initialise with `PDN_INIT(pdn_march_diagnostics, &diagnostics)`.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct pdn_march_diagnostics {
    /// Set by the initialiser.
    pub struct_size: usize,
    /// Steps taken.
    pub steps: usize,
    /// Steps that were given up for shorter ones.
    pub rejected_steps: usize,
    /// Newton iterations over all steps.
    pub iterations: usize,
    /// Whole periods marched.
    pub periods: usize,
    /// First time of the trajectory: the start, or the oldest step that was kept.
    pub first_time: f64,
    /// Last time of the trajectory.
    pub last_time: f64,
    /// How much the last period differs from the one before, as
    /// pdn_march_options.periodic_tolerance; infinite before the end of the first period.
    pub repetition: f64,
    /// Largest estimated error of a motion in one step, as pdn_march_options.error_tolerance.
    pub step_error: f64,
    /// How much motions were moved at the start to satisfy constraints and prescribed motions:
    /// lengths relative to the size of the mechanism, entries of rotation matrices.
    pub start_moved: f64,
    /// How much velocities were changed at the start: lengths relative to the size of the
    /// mechanism, or radians, in the unit of time.
    pub start_corrected: f64,
}

// SAFETY: all fields are plain numbers, `struct_size` is the first, no padding.
unsafe impl Options for pdn_march_diagnostics {
    const SIZES: &'static [usize] = &[88];
}

/// Prepares a struct for ::pdn_solution_march; use `PDN_INIT(pdn_march_diagnostics, &diagnostics)`.
///
/// @param diagnostics  the struct; not NULL
/// @param struct_size  `sizeof *diagnostics`
///
/// Threads: any.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_march_diagnostics_init(
    diagnostics: *mut pdn_march_diagnostics,
    struct_size: usize,
) {
    init(diagnostics, struct_size, "diagnostics");
}

/// The solution is none of a march.
pub(super) fn no_trajectory() -> Error {
    let message = "solution: expected one of a march, got one that is no trajectory";
    Error::new(ErrorKind::NotAvailable, message)
}

/// Figures of a march: steps, periods, how much the last of them differ, how much the start was
/// changed.
///
/// @param solution  a solution of ::pdn_solve_march; not NULL
/// @param out  initialised by PDN_INIT; filled on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE, PDN_ERR_NOT_AVAILABLE (the solution is no
///     trajectory)
///
/// Threads: like `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_solution_march(
    solution: *const pdn_solution,
    out: *mut pdn_march_diagnostics,
) -> pdn_status {
    guard(|call| {
        let solution = call.shared(solution, "solution")?;
        let out = call.out_struct(out, "out")?;
        let Some(record) = solution.details().march() else {
            return Err(no_trajectory());
        };
        out.set(pdn_march_diagnostics {
            steps: record.steps,
            rejected_steps: record.rejected,
            iterations: record.iterations,
            periods: record.periods,
            first_time: record.times.first().copied().unwrap_or(0.0),
            last_time: record.times.last().copied().unwrap_or(0.0),
            repetition: record.repetition,
            step_error: record.step_error,
            start_moved: record.start_moved,
            start_corrected: record.start_corrected,
            ..pdn_march_diagnostics::defaults()
        });
        Ok(())
    })
}
