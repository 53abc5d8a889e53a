//! Branches: periodic motions along a parameter.

use super::call::Call;
use super::condition::{free_parameter, pdn_conditions};
use super::guard::{free, guard, guard_or, init};
use super::handle::Handle;
use super::id::Kind;
use super::last_error::copy_message;
use super::model::{number, pdn_model};
use super::options::Options;
use super::periodic::{
    PDN_TIME_MAP_AUTOMATIC, PDN_TIME_MAP_EQUISPACED, pdn_periodic_options, read_options,
};
use super::quantity::{pdn_quantity, selections};
use super::solution::pdn_solution;
use super::stability::{
    PDN_STABILITY_NOT_KNOWN, core_options as core_stability_options, pdn_stability_options,
    verdict_code,
};
use super::status::pdn_status;
use crate::error::{Error, Result};
use crate::model::{Labels, Model};
use crate::solve::{
    Branch, BranchEnd, BranchOptions, BranchPoint, Event, Free, StabilityOptions, continue_branch,
    follow_branch, follow_locus, switch_branch,
};
use libc::{c_char, c_void};
use std::f64::consts::TAU;
use std::path::Path;

/// A branch ended at an end of the parameter's range.
pub const PDN_BRANCH_RANGE: i32 = 4000;
/// A branch ended as it came back to its first point.
pub const PDN_BRANCH_CLOSED: i32 = 4001;
/// A branch ended as it has as many points as are allowed.
pub const PDN_BRANCH_POINT_LIMIT: i32 = 4002;
/// A branch ended where the shortest step leads to no solution.
pub const PDN_BRANCH_SMALLEST_STEP: i32 = 4003;
/// A branch ended as it was cancelled.
pub const PDN_BRANCH_CANCELLED: i32 = 4004;
/// A branch has no points, as there is no solution to start from.
pub const PDN_BRANCH_NO_START: i32 = 4005;
/// A branch ended with an error, such as that of a callback, which its report tells.
pub const PDN_BRANCH_FAILED: i32 = 4006;

/// Nothing happens at a point of a branch.
pub const PDN_EVENT_NONE: i32 = 4100;
/// The parameter turns back at a point of a branch: a fold.
pub const PDN_EVENT_FOLD: i32 = 4101;
/// Another branch passes through a point of a branch.
pub const PDN_EVENT_BRANCH_POINT: i32 = 4102;
/// A branch of twice the period begins at a point of a branch.
pub const PDN_EVENT_PERIOD_DOUBLING: i32 = 4103;
/// A pair of complex multipliers is on the unit circle at a point of a branch: motions with a
/// second frequency begin there.
pub const PDN_EVENT_TORUS: i32 = 4104;

/// Periodic motions along a parameter. Made by ::pdn_follow_branch, freed by ::pdn_branch_free.
pub struct pdn_branch {
    _private: [u8; 0],
}

impl Handle for pdn_branch {
    type Core = Branch;

    fn labels(core: &Branch) -> Option<&Labels> {
        Some(core.model().labels())
    }
}

/// A point of a branch. Initialise with `PDN_INIT(pdn_branch_point, &point)`.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct pdn_branch_point {
    /// Set by the initialiser.
    pub struct_size: usize,
    /// Value of the parameter that is followed.
    pub parameter: f64,
    /// Its derivative by the length along the branch, over its range: zero at a fold.
    pub slope: f64,
    /// Period of the motion.
    pub period: f64,
    /// Length of the step from the point before.
    pub step: f64,
    /// Angle between the branch here and at the point before \[radians\].
    pub angle: f64,
    /// Number of grid points.
    pub grid_points: usize,
    /// Number of Newton iterations.
    pub iterations: i32,
    /// PDN_EVENT_NONE, PDN_EVENT_FOLD, ...
    pub event: i32,
    /// At a torus point, the angular frequency of the motions that begin there; else zero.
    pub second_frequency: f64,
    /// Size of the largest multiplier; zero if multipliers were not wanted.
    pub largest_multiplier: f64,
    /// Number of multipliers outside the unit circle; zero also if they were not wanted.
    pub multipliers_outside: i32,
    /// PDN_STABLE, PDN_UNSTABLE or PDN_STABILITY_NOT_KNOWN, also if multipliers were not wanted.
    pub stability: i32,
}

// SAFETY: all fields are plain numbers, `struct_size` is the first, no padding.
unsafe impl Options for pdn_branch_point {
    const SIZES: &'static [usize] = &[88];

    fn defaults() -> Self {
        pdn_branch_point {
            event: PDN_EVENT_NONE,
            stability: PDN_STABILITY_NOT_KNOWN,
            ..Self::blank()
        }
    }
}

/// Sets a point to that of nothing; use `PDN_INIT(pdn_branch_point, &point)`.
///
/// @param point  the point; not NULL
/// @param struct_size  `sizeof *point`
///
/// Threads: any.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_branch_point_init(point: *mut pdn_branch_point, struct_size: usize) {
    init(point, struct_size, "point");
}

impl pdn_branch_point {
    fn of(point: &BranchPoint) -> Self {
        pdn_branch_point {
            parameter: point.values[0],
            slope: point.slope,
            period: point.grid.period(),
            step: point.step,
            angle: point.angle,
            grid_points: point.grid.points(),
            iterations: i32::try_from(point.iterations).unwrap_or(i32::MAX),
            event: match point.event {
                None => PDN_EVENT_NONE,
                Some(Event::Fold) => PDN_EVENT_FOLD,
                Some(Event::BranchPoint) => PDN_EVENT_BRANCH_POINT,
                Some(Event::PeriodDoubling) => PDN_EVENT_PERIOD_DOUBLING,
                Some(Event::Torus) => PDN_EVENT_TORUS,
            },
            second_frequency: point.second_frequency.unwrap_or(0.0),
            largest_multiplier: point.stability.map_or(0.0, |found| found.largest),
            multipliers_outside: point
                .stability
                .map_or(0, |found| i32::try_from(found.outside).unwrap_or(i32::MAX)),
            stability: point
                .stability
                .map_or(PDN_STABILITY_NOT_KNOWN, |found| verdict_code(found.verdict)),
            ..Self::blank()
        }
    }
}

/// Called with each point of a branch, on the thread that follows it; `number` counts from 1.
///
/// `point` is valid during the call only. Return 0 to go on, anything else to end the branch there.
pub type pdn_branch_fn = Option<
    unsafe extern "C" fn(
        point: *const pdn_branch_point,
        number: i32,
        user_data: *mut c_void,
    ) -> i32,
>;

/// Options of ::pdn_follow_branch. Set the defaults by `PDN_INIT(pdn_branch_options, &options)`.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct pdn_branch_options {
    /// Set by the initialiser.
    pub struct_size: usize,
    /// Grid, tolerance and linear solver, where the first solve starts, and who is told of the
    /// iterations; NULL for the defaults. Grids are equispaced. Default NULL.
    pub periodic: *const pdn_periodic_options,
    /// What else is free along the branch, and as many conditions; NULL for nothing. Default NULL.
    pub conditions: *const pdn_conditions,
    /// Least value of the parameter, where the branch ends.
    pub from: f64,
    /// Largest value of the parameter, where the branch ends; more than `from`.
    pub to: f64,
    /// What counts as 1 in motions, relative to the size of the mechanism and in radians; as the
    /// whole range does in the parameter. Default 1.
    pub motion_scale: f64,
    /// Length of the first step: 1 is the whole range, or a motion of motion_scale. Default 0.02.
    pub first_step: f64,
    /// Shortest step. Default 1e-6.
    pub smallest_step: f64,
    /// Longest step. Default 1.
    pub largest_step: f64,
    /// Angle between the branch at neighbouring points that steps aim at \[radians\]; steps by four
    /// thirds of it are taken again by half. Default 0.3.
    pub angle: f64,
    /// Most points. Default 1000.
    pub point_limit: usize,
    /// Told of each point; may end the branch. Default NULL.
    pub progress: pdn_branch_fn,
    /// Handed to progress.
    pub progress_data: *mut c_void,
    /// 1 if the parameter decreases at first. Default 0.
    pub downwards: i32,
    /// 1 to look for branch points (where there are no conditions) and period doublings, too, by
    /// two more factorisations of the whole Jacobian a point. Default 0.
    pub events: i32,
    /// 1 to find the multipliers of each point, and with them torus points. Default 0.
    pub stability: i32,
    /// Leave it zero.
    pub reserved: i32,
}

// SAFETY: all fields are plain numbers or pointers, `struct_size` is the first, no padding.
unsafe impl Options for pdn_branch_options {
    const SIZES: &'static [usize] = &[120];

    fn defaults() -> Self {
        let core = BranchOptions::default();
        pdn_branch_options {
            motion_scale: core.motion_scale,
            first_step: core.first_step,
            smallest_step: core.smallest_step,
            largest_step: core.largest_step,
            angle: core.angle,
            point_limit: core.point_limit,
            ..Self::blank()
        }
    }
}

/// Sets default options; use `PDN_INIT(pdn_branch_options, &options)`.
///
/// @param options  the options; not NULL
/// @param struct_size  `sizeof *options`
///
/// Threads: any.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_branch_options_init(
    options: *mut pdn_branch_options,
    struct_size: usize,
) {
    init(options, struct_size, "options");
}

fn core_options(
    call: &Call,
    given: &pdn_branch_options,
    model: &Model,
    period: f64,
) -> Result<BranchOptions> {
    for (name, value) in [
        ("options.motion_scale", given.motion_scale),
        ("options.first_step", given.first_step),
        ("options.smallest_step", given.smallest_step),
        ("options.largest_step", given.largest_step),
        ("options.angle", given.angle),
    ] {
        call.number(value, name)?;
    }
    let mut periodic = call.options(given.periodic, "options.periodic")?;
    // Branches are followed on equispaced grids, wherever the points of a start are.
    if periodic.time_map == PDN_TIME_MAP_AUTOMATIC {
        periodic.time_map = PDN_TIME_MAP_EQUISPACED;
    }
    let (free, conditions) = if given.conditions.is_null() {
        (Vec::new(), Vec::new())
    } else {
        let conditions = call.shared(given.conditions, "options.conditions")?;
        conditions.of(model)?
    };
    let flag = |value: i32, name: &str| match value {
        0 => Ok(false),
        1 => Ok(true),
        other => Err(Error::value(name, "0 or 1", other)),
    };
    let periodic = read_options(call, &periodic, model, period)?;
    let stability = StabilityOptions {
        watch: periodic.watch.clone(),
        ..StabilityOptions::default()
    };
    Ok(BranchOptions {
        periodic,
        stability: flag(given.stability, "options.stability")?.then_some(stability),
        free,
        conditions,
        range: [
            call.number(given.from, "options.from")?,
            call.number(given.to, "options.to")?,
        ],
        downwards: flag(given.downwards, "options.downwards")?,
        events: flag(given.events, "options.events")?,
        motion_scale: given.motion_scale,
        first_step: given.first_step,
        smallest_step: given.smallest_step,
        largest_step: given.largest_step,
        angle: given.angle,
        point_limit: given.point_limit,
    })
}

/// What tells the caller of points.
fn observer(given: &pdn_branch_options) -> impl FnMut(usize, &BranchPoint) -> bool + use<> {
    let (progress, data) = (given.progress, given.progress_data);
    move |number: usize, point: &BranchPoint| {
        let Some(function) = progress else {
            return true;
        };
        let point = pdn_branch_point::of(point);
        let number = i32::try_from(number).unwrap_or(i32::MAX);
        // SAFETY: the caller gave the function for this data; `point` outlives the call.
        unsafe { function(&raw const point, number, data) == 0 }
    }
}

/// Options for what begins at a branch.
fn options_for(
    call: &Call,
    options: *const pdn_branch_options,
    branch: &Branch,
) -> Result<(pdn_branch_options, BranchOptions)> {
    let given = call.options(options, "options")?;
    let options = core_options(call, &given, branch.model(), branch.period())?;
    Ok((given, options))
}

/// Follows periodic motions along a parameter, through folds, from the response at its value in the
/// model.
///
/// Steps are as long as the branch allows: they aim at `options.angle` between the tangents of
/// neighbouring points. Folds are located exactly, and are points of their own. Unless a number of
/// grid points is given it grows along the branch. That the branch ends early is no error, whatever
/// happens after its first point: ::pdn_branch_end tells, and all its points are kept.
///
/// @param model  the model; it is copied, so that later changes do not touch the branch
/// @param period  T of the first response, or a guess of it where the frequency is free
/// @param parameter  id of the parameter to be followed, or PDN_FREQUENCY
/// @param options  the range of the parameter, at least; not NULL
/// @param out  the branch; free it with ::pdn_branch_free; written on success only
/// @return as ::pdn_solve_conditioned; PDN_ERR_VALUE also if the parameter is not in its range
///
/// Threads: like a `const` use of `model` and of what `options` points to. Functions of yours are
/// called on this thread.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_follow_branch(
    model: *const pdn_model,
    period: f64,
    parameter: i32,
    options: *const pdn_branch_options,
    out: *mut *mut pdn_branch,
) -> pdn_status {
    guard(|call| {
        let model = call.shared(model, "model")?;
        let period = call.number(period, "period")?;
        let given = call.options(options, "options")?;
        let out = call.out(out, "out")?;
        let options = core_options(call, &given, &model, period)?;
        let parameter = free_parameter(&model, parameter)?;
        let observe = &mut observer(&given);
        out.give(follow_branch(&model, period, parameter, &options, observe)?);
        Ok(())
    })
}

/// Finds the response over a range of frequencies, through folds: ::pdn_follow_branch along
/// PDN_FREQUENCY.
///
/// @param model  the model, whose loads and prescribed motions are functions of the phase; rates
///     are those at the frequency `first`, and remain as many turns a period
/// @param first  circular frequency 2 pi / T at which it begins
/// @param last  circular frequency at which it ends, more or less than `first`
/// @param options  may be NULL for the defaults; its range, direction and conditions are not used
/// @param out  the branch; free it with ::pdn_branch_free; written on success only
/// @return as ::pdn_follow_branch
///
/// Threads: as ::pdn_follow_branch.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_solve_frequency_response(
    model: *const pdn_model,
    first: f64,
    last: f64,
    options: *const pdn_branch_options,
    out: *mut *mut pdn_branch,
) -> pdn_status {
    guard(|call| {
        let model = call.shared(model, "model")?;
        let first = positive(call, first, "first")?;
        let last = positive(call, last, "last")?;
        let mut given = call.options(options, "options")?;
        let out = call.out(out, "out")?;
        given.conditions = std::ptr::null();
        (given.from, given.to) = (first.min(last), first.max(last));
        given.downwards = i32::from(last < first);
        let period = TAU / first;
        let options = core_options(call, &given, &model, period)?;
        let (free, observe) = (Free::Frequency, &mut observer(&given));
        out.give(follow_branch(&model, period, free, &options, observe)?);
        Ok(())
    })
}

/// Follows the other branch at a point where one begins: a branch point, or a period doubling, from
/// where motions have twice the period, on one grid point less than twice as many.
///
/// It begins where motions are `amplitude` away in the direction in which it leaves, and goes on
/// away from there. That it cannot is no error: ::pdn_branch_end tells.
///
/// @param branch  the branch; not NULL
/// @param point  number of the point, from 0
/// @param amplitude  length, of which 1 is a motion of `options.motion_scale`, of either sign; not
///     zero
/// @param options  the range of the same parameter, at least, and conditions as those of the
///     branch; its direction, and where solves start, are not used; not NULL
/// @param out  the other branch; free it with ::pdn_branch_free; written on success only
/// @return as ::pdn_follow_branch; PDN_ERR_ID (there is no such point), PDN_ERR_NOT_AVAILABLE (no
///     other branch begins there), PDN_ERR_GRID_TOO_COARSE
///
/// Threads: like a `const` use of `branch` and of what `options` points to. Functions of yours are
/// called on this thread.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_switch_branch(
    branch: *const pdn_branch,
    point: i32,
    amplitude: f64,
    options: *const pdn_branch_options,
    out: *mut *mut pdn_branch,
) -> pdn_status {
    guard(|call| {
        let branch = call.shared(branch, "branch")?;
        let point = number(point, branch.points.len(), "point", "a point")?;
        let amplitude = call.number(amplitude, "amplitude")?;
        let (given, options) = options_for(call, options, &branch)?;
        let out = call.out(out, "out")?;
        let observe = &mut observer(&given);
        out.give(switch_branch(&branch, point, amplitude, &options, observe)?);
        Ok(())
    })
}

/// Follows folds, period doublings or torus points along a second parameter, from one of them on a
/// branch: that of the branch is free beside it.
///
/// All points of what is returned are such points. Their `parameter` is the second one, that of the
/// branch is ::pdn_solution_parameter of their solutions. The CSV file has both.
///
/// @param branch  the branch; not NULL
/// @param point  number of the point, from 0
/// @param parameter  id of the second parameter, or PDN_FREQUENCY
/// @param options  the range of the second parameter, at least, and conditions as those of the
///     branch; where solves start is not used; not NULL
/// @param out  the points; free them with ::pdn_branch_free; written on success only
/// @return as ::pdn_follow_branch; PDN_ERR_ID (there is no such point), PDN_ERR_NOT_AVAILABLE
///     (nothing happens there, or a branch point)
///
/// Threads: like a `const` use of `branch` and of what `options` points to. Functions of yours are
/// called on this thread.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_follow_locus(
    branch: *const pdn_branch,
    point: i32,
    parameter: i32,
    options: *const pdn_branch_options,
    out: *mut *mut pdn_branch,
) -> pdn_status {
    guard(|call| {
        let branch = call.shared(branch, "branch")?;
        let point = number(point, branch.points.len(), "point", "a point")?;
        let second = free_parameter(branch.model(), parameter)?;
        let (given, options) = options_for(call, options, &branch)?;
        let out = call.out(out, "out")?;
        let observe = &mut observer(&given);
        out.give(follow_locus(&branch, point, second, &options, observe)?);
        Ok(())
    })
}

/// Follows a branch on from its last point, in the direction in which it came there: with a wider
/// range, more points, a shorter smallest step.
///
/// @param branch  the branch, as it was followed or loaded; not NULL
/// @param options  the range of the same parameter, at least, and conditions as those of the
///     branch; its direction, and where solves start, are not used; not NULL
/// @param out  a branch with the points of the first and those that are new; free it with
///     ::pdn_branch_free; written on success only
/// @return as ::pdn_follow_branch; PDN_ERR_NOT_AVAILABLE (it has no points, has come back to its
///     first one, or is one of ::pdn_follow_locus)
///
/// Threads: like a `const` use of `branch` and of what `options` points to. Functions of yours are
/// called on this thread.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_continue_branch(
    branch: *const pdn_branch,
    options: *const pdn_branch_options,
    out: *mut *mut pdn_branch,
) -> pdn_status {
    guard(|call| {
        let branch = call.shared(branch, "branch")?;
        let (given, options) = options_for(call, options, &branch)?;
        let out = call.out(out, "out")?;
        let observe = &mut observer(&given);
        out.give(continue_branch(&branch, &options, observe)?);
        Ok(())
    })
}

/// Saves a branch with its model and all its points.
///
/// ::pdn_branch_load gives it back. Callbacks cannot be saved: see there. The format is the same on
/// all platforms, and later versions of the library read it.
///
/// @param branch  the branch; not NULL
/// @param path  where to, UTF-8. A file that is there is replaced when all is written; if that
///     fails it stays as it was
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_VALUE (text that is not UTF-8), PDN_ERR_IO
///
/// Threads: like `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_branch_save(
    branch: *const pdn_branch,
    path: *const c_char,
) -> pdn_status {
    guard(|call| {
        let branch = call.shared(branch, "branch")?;
        branch.save(Path::new(call.text(path, "path")?))
    })
}

/// Loads a branch that ::pdn_branch_save saved. It can be continued.
///
/// If its model had callbacks, in signals or forces, solutions of its points and all that is
/// followed from it fail with PDN_ERR_CALLBACK, as they are not there.
///
/// @param path  the file, UTF-8. It need not be trusted: its checksum and everything in it are
///     checked
/// @param out  the branch; free it with ::pdn_branch_free; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_VALUE (text that is not UTF-8), PDN_ERR_IO, PDN_ERR_FORMAT
///     (not a saved branch, cut off, damaged, or of a newer version), PDN_ERR_MEMORY
///
/// Threads: any.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_branch_load(
    path: *const c_char,
    out: *mut *mut pdn_branch,
) -> pdn_status {
    guard(|call| {
        let path = call.text(path, "path")?;
        let out = call.out(out, "out")?;
        out.give(Branch::load(Path::new(path))?);
        Ok(())
    })
}

fn positive(call: &Call, value: f64, name: &str) -> Result<f64> {
    match call.number(value, name)? {
        value if value > 0.0 => Ok(value),
        value => Err(Error::value(name, "a positive number", value)),
    }
}

/// Frees a branch; NULL does nothing. Solutions made from it stay.
///
/// @param branch  the branch, not to be used any more
///
/// Threads: exclusive use of `branch`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_branch_free(branch: *mut pdn_branch) {
    free(branch);
}

/// Why a branch ended.
///
/// @param branch  the branch; not NULL
/// @return PDN_BRANCH_RANGE, ...; or PDN_ERR_NULL
///
/// Threads: like `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_branch_end(branch: *const pdn_branch) -> i32 {
    let mut end = 0;
    let status = guard(|call| {
        end = match call.shared(branch, "branch")?.end {
            BranchEnd::Range => PDN_BRANCH_RANGE,
            BranchEnd::Closed => PDN_BRANCH_CLOSED,
            BranchEnd::PointLimit => PDN_BRANCH_POINT_LIMIT,
            BranchEnd::SmallestStep => PDN_BRANCH_SMALLEST_STEP,
            BranchEnd::Cancelled => PDN_BRANCH_CANCELLED,
            BranchEnd::NoStart => PDN_BRANCH_NO_START,
            BranchEnd::Failed => PDN_BRANCH_FAILED,
        };
        Ok(())
    });
    if status < 0 { status } else { end }
}

/// A readable report: points, events, and why the branch ended.
///
/// @param branch  the branch; not NULL
/// @param buffer  array of length [capacity] for the text, UTF-8, always ended by NUL; may be NULL
/// @param capacity  bytes in the buffer
/// @return bytes of the whole text, without the NUL; 0 if an error occurred
///
/// Threads: like `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_branch_report(
    branch: *const pdn_branch,
    buffer: *mut c_char,
    capacity: usize,
) -> usize {
    guard_or(0, |call| {
        let report = call.shared(branch, "branch")?.report();
        copy_message(&report, buffer, capacity);
        Ok(report.len())
    })
}

/// Number of points of a branch.
///
/// @param branch  the branch; not NULL
/// @param out  the number; written on success only
/// @return PDN_OK, PDN_ERR_NULL
///
/// Threads: like `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_branch_count(branch: *const pdn_branch, out: *mut i32) -> pdn_status {
    guard(|call| {
        let branch = call.shared(branch, "branch")?;
        let out = call.out(out, "out")?;
        out.set(i32::try_from(branch.points.len()).unwrap_or(i32::MAX));
        Ok(())
    })
}

/// A point of a branch.
///
/// @param branch  the branch; not NULL
/// @param point  its number, from 0
/// @param out  the point, initialised; not NULL
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID, PDN_ERR_STRUCT_SIZE
///
/// Threads: like `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_branch_get(
    branch: *const pdn_branch,
    point: i32,
    out: *mut pdn_branch_point,
) -> pdn_status {
    guard(|call| {
        let branch = call.shared(branch, "branch")?;
        let point = number(point, branch.points.len(), "point", "a point")?;
        let out = call.out_struct(out, "out")?;
        out.set(pdn_branch_point::of(&branch.points[point]));
        Ok(())
    })
}

/// The solution at a point of a branch.
///
/// @param branch  the branch; not NULL
/// @param point  its number, from 0
/// @param out  the solution; free it with ::pdn_solution_free; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID, PDN_ERR_CALLBACK, PDN_ERR_MEMORY
///
/// Threads: like `const`. Functions of the model may be called on this thread.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_branch_solution(
    branch: *const pdn_branch,
    point: i32,
    out: *mut *mut pdn_solution,
) -> pdn_status {
    guard(|call| {
        let branch = call.shared(branch, "branch")?;
        let point = number(point, branch.points.len(), "point", "a point")?;
        let out = call.out(out, "out")?;
        out.give(branch.solution(point)?);
        Ok(())
    })
}

/// Writes a branch as CSV: a line for each point, with the parameter, how the step went, what
/// happens there, what multipliers say if they were wanted (`pdn_branch_options.stability`) and, of
/// each component of quantities, the mean, the size of the first harmonic, the least and the
/// largest value over the period. `script/plot.py` draws it.
///
/// @param branch  the branch; not NULL
/// @param quantities  array of length [count] of quantities, each initialised by PDN_INIT; may be
///     NULL if count is 0
/// @param count  number of quantities
/// @param path  name of the file, UTF-8; an existing file is replaced
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE, PDN_ERR_ID, PDN_ERR_VALUE,
///     PDN_ERR_NOT_AVAILABLE (there are no points; no such quantity), PDN_ERR_GRID_TOO_COARSE,
///     PDN_ERR_OVERFLOW, PDN_ERR_IO
///
/// Threads: like `const`. Functions of the model may be called on this thread.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_branch_write_csv(
    branch: *const pdn_branch,
    quantities: *const pdn_quantity,
    count: usize,
    path: *const c_char,
) -> pdn_status {
    guard(|call| {
        let branch = call.shared(branch, "branch")?;
        let outputs = selections(call, quantities, count)?;
        branch.write_csv(Path::new(call.text(path, "path")?), &outputs)
    })
}

/// Writes a chart of the exponents of small disturbances along a branch as CSV, as of Campbell: of
/// each point that is no event a line for each multiplier, but for conjugates and for those that
/// only move the motion in time or space. `script/plot.py` draws it.
///
/// A line has the parameter, the period, the rate of growth (real part of mu), the angular
/// frequency of the mode in its nodes' own axes and from the ground, the size of the multiplier,
/// the estimated error of that, and what moves: of a rotor with equal parts the pattern that is
/// largest, and its share of their motions. It is `collective`, `alternating` (each part against
/// its neighbours), or a number of nodal diameters, `progressive` where the pattern goes around in
/// the sense of the rotation, `regressive` where against it, seen from the parts, or `standing`.
/// Where no parts are named, or these hardly move, it is the node that moves most.
///
/// @param branch  the branch; not NULL
/// @param options  may be NULL for the defaults
/// @param blades  array of length [count]: ids of nodes, one of each of the equal parts, the same
///     on all of them, one after the other around the rotor; may be NULL if count is 0
/// @param count  number of parts: 0, or at least 2
/// @param path  name of the file, UTF-8; an existing file is replaced
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE, PDN_ERR_NOT_FINITE, PDN_ERR_ID,
///     PDN_ERR_SIZE (one part), PDN_ERR_VALUE (parts that are not around an axis, or twice there),
///     PDN_ERR_NOT_AVAILABLE (there are no points; cancelled), PDN_ERR_GRID_TOO_COARSE,
///     PDN_ERR_CALLBACK, PDN_ERR_MEMORY, PDN_ERR_IO
///
/// Threads: like `const`. Functions of the model and `options.progress` are called on this thread.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_branch_write_campbell(
    branch: *const pdn_branch,
    options: *const pdn_stability_options,
    blades: *const i32,
    count: usize,
    path: *const c_char,
) -> pdn_status {
    guard(|call| {
        let branch = call.shared(branch, "branch")?;
        let options = core_stability_options(call, &call.options(options, "options")?)?;
        let total = branch.model().node_count();
        let blades = call.slice(blades, count, "blades")?.iter().enumerate();
        let blades = blades.map(|(k, &node)| {
            let name = format!("blades[{k}]");
            Kind::Node.index_below(node, total, &name)
        });
        let blades = blades.collect::<Result<Vec<_>>>()?;
        branch.write_campbell(Path::new(call.text(path, "path")?), &options, &blades)
    })
}
