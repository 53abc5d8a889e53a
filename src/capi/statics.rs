//! Static equilibrium and steady rotation.

use super::call::Call;
use super::guard::{guard, init};
use super::model::pdn_model;
use super::options::Options;
use super::periodic::{PROGRESS_INTERVAL, pdn_progress_fn, watch};
use super::solution::pdn_solution;
use super::status::pdn_status;
use crate::error::{Error, Result};
use crate::fourier::TimeGrid;
use crate::model::Model;
use crate::output::Solution;
use crate::solve::{InitialGuess, NewtonOptions, StaticOptions};
use crate::system::Standstill;
use libc::c_void;
use nalgebra::Vector3;

/// Options of ::pdn_solve_static. Set the defaults by `PDN_INIT(pdn_static_options, &options)`.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct pdn_static_options {
    /// Set by the initialiser.
    pub struct_size: usize,
    /// Loads and prescribed motions have their values at this time. Default 0.
    pub time: f64,
    /// Period that harmonics and samples of signals refer to; 0 if not given, as at time 0, where
    /// it does not matter. Default 0.
    pub period: f64,
    /// Load steps taken at least, from the unloaded reference configuration; a step that does not
    /// converge is halved. More than one keeps to the branch that grows from the reference
    /// configuration, where there are several. Not used with an initial solution. Default 1.
    pub load_steps: usize,
    /// As in ::pdn_periodic_options. Default 1e-9.
    pub tolerance: f64,
    /// Most Newton iterations at the full loads. Default 30.
    pub iteration_limit: usize,
    /// Angular velocity of the frame that everything turns with steadily, the ground too, inertial
    /// frame \[angle/time\]. Default 0.
    pub angular_velocity: [f64; 3],
    /// A point of the axis it turns about \[length\]. Default 0.
    pub axis_point: [f64; 3],
    /// Start from this solution, at `time`, of a model with the same nodes and joints; NULL to
    /// start from the reference configuration. Default NULL.
    pub initial: *const pdn_solution,
    /// Told of each iteration, and about ten times a second while one lasts; may cancel. Default
    /// NULL.
    pub progress: pdn_progress_fn,
    /// Handed to progress.
    pub progress_data: *mut c_void,
    /// Bytes of memory that the solve may take, by an estimate that is made before it begins, with
    /// the modes of ::pdn_solve_modes: what would take more is PDN_ERR_MEMORY, and the message
    /// tells the estimate. 0 for no limit but that of the system. Default 0.
    pub memory_limit: usize,
}

// SAFETY: all fields are plain numbers or pointers, `struct_size` is the first, no padding.
unsafe impl Options for pdn_static_options {
    const SIZES: &'static [usize] = &[120, 128];

    fn defaults() -> Self {
        let core = StaticOptions::default();
        pdn_static_options {
            load_steps: core.least_load_steps,
            tolerance: core.newton.tolerance,
            iteration_limit: core.newton.iteration_limit,
            ..Self::blank()
        }
    }
}

/// Sets default options; use `PDN_INIT(pdn_static_options, &options)`.
///
/// @param options  the options; not NULL
/// @param struct_size  `sizeof *options`
///
/// Threads: any.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_static_options_init(
    options: *mut pdn_static_options,
    struct_size: usize,
) {
    init(options, struct_size, "options");
}

/// Finds an equilibrium at one time: of forces at rest, or in steady rotation.
///
/// Newton's method with the exact tangent, after load steps from the unloaded reference
/// configuration. Where these lead nowhere, as for a pendulum that is not in a position of
/// equilibrium yet, the masses creep downhill. Not converging is no error: PDN_OK says that the
/// solve was carried out, ::pdn_solution_outcome how it ended, ::pdn_solution_report why. A
/// position that nothing determines, such as that of a free body, is PDN_SINGULAR.
///
/// The solution has a grid of one point and the same values at any time.
///
/// With options.angular_velocity everything turns steadily, the ground too: the solution is the
/// equilibrium in the turning frame, under centrifugal and gyroscopic forces. Positions and
/// directions are those in that frame, at a moment at which its axes are the inertial ones;
/// velocities and accelerations of nodes are those in the inertial frame, in forces of yours on
/// nodes, too; rates of joints, and dampers, know the motion in the frame only. Loads with
/// PDN_FRAME_SPACE keep their directions in the turning frame, as the ground does. Gravity must be
/// along the axis.
///
/// @param model  the model; it is copied, so that later changes do not touch the solution
/// @param options  may be NULL for the defaults
/// @param out  the solution, also if it has not converged; free it with ::pdn_solution_free;
///     written on success only
/// @return PDN_OK; PDN_ERR_NULL; PDN_ERR_NOT_FINITE; PDN_ERR_VALUE (no load step, a period that is
///     needed but not given, an initial solution of another model); PDN_ERR_STRUCT_SIZE;
///     PDN_ERR_MODEL (no node, a beam too distorted); PDN_ERR_NOT_PERIODIC (gravity across the axis
///     of rotation); PDN_ERR_GRID_TOO_COARSE (of the initial solution); PDN_ERR_CALLBACK (of a
///     signal); PDN_ERR_OVERFLOW (numbers too large to compute with); PDN_ERR_MEMORY
///
/// Threads: like a `const` use of `model` and of `options.initial`. Signals' functions and
/// `progress` are called on this thread.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_solve_static(
    model: *const pdn_model,
    options: *const pdn_static_options,
    out: *mut *mut pdn_solution,
) -> pdn_status {
    guard(|call| {
        let model = call.shared(model, "model")?;
        let given = call.options(options, "options")?;
        let out = call.out(out, "out")?;
        let options = read_static_options(call, &given, &model, "options")?;
        out.give(Solution::solve_static(&model, &options, &mut |_, _| true)?);
        Ok(())
    })
}

/// The options of the core; `name` is that of the struct in messages.
pub(super) fn read_static_options(
    call: &Call,
    given: &pdn_static_options,
    model: &Model,
    name: &str,
) -> Result<StaticOptions> {
    let field = |field: &str| format!("{name}.{field}");
    call.number(given.time, &field("time"))?;
    call.number(given.period, &field("period"))?;
    call.number(given.tolerance, &field("tolerance"))?;
    let mut options = StaticOptions {
        standstill: Standstill {
            time: given.time,
            period: (given.period != 0.0).then_some(given.period),
            angular_velocity: Vector3::from(given.angular_velocity),
            axis_point: Vector3::from(given.axis_point),
        },
        least_load_steps: given.load_steps,
        newton: NewtonOptions {
            tolerance: given.tolerance,
            iteration_limit: given.iteration_limit,
        },
        guess: InitialGuess::Default,
        memory_limit: given.memory_limit,
        watch: watch(given.progress, given.progress_data, PROGRESS_INTERVAL)?,
    };
    let within = |e: Error| match name {
        "options" => e,
        _ => e.within(name),
    };
    options.validate().map_err(within)?;
    if !given.initial.is_null() {
        let initial = call.shared(given.initial, &field("initial"))?;
        initial.require_same_shape(model).map_err(within)?;
        let grid = TimeGrid::new(1, options.standstill.period())?;
        options.guess = InitialGuess::State(initial.prolonged_from(given.time, grid)?);
    }
    Ok(options)
}
