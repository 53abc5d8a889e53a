//! Stability of periodic solutions.

use super::call::Call;
use super::guard::{free, guard, guard_or, init};
use super::handle::Handle;
use super::id::Kind;
use super::last_error::copy_message;
use super::model;
use super::options::Options;
use super::periodic::{PROGRESS_INTERVAL, pdn_progress_fn, watch};
use super::solution::{outcome_code, pdn_solution, require_count};
use super::status::pdn_status;
use crate::error::Result;
use crate::solve::{Stability, StabilityOptions, Verdict};
use libc::{c_char, c_void};

/// Verdict on stability: it cannot be told, as multipliers are on the unit circle or not known well
/// enough.
pub const PDN_STABILITY_NOT_KNOWN: i32 = 4200;
/// Verdict on stability: disturbances die away, but for those that only move the solution in time
/// or space.
pub const PDN_STABLE: i32 = 4201;
/// Verdict on stability: a disturbance grows.
pub const PDN_UNSTABLE: i32 = 4202;

/// Floquet multipliers of a periodic solution. Made by ::pdn_solve_stability, freed by
/// ::pdn_stability_free.
pub struct pdn_stability {
    _private: [u8; 0],
}

impl Handle for pdn_stability {
    type Core = Stability;
}

/// What a verdict is in C.
pub(super) fn verdict_code(verdict: Verdict) -> i32 {
    match verdict {
        Verdict::NotKnown => PDN_STABILITY_NOT_KNOWN,
        Verdict::Stable => PDN_STABLE,
        Verdict::Unstable => PDN_UNSTABLE,
    }
}

/// Options of ::pdn_solve_stability. Set the defaults by `PDN_INIT(pdn_stability_options,
/// &options)`.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct pdn_stability_options {
    /// Set by the initialiser.
    pub struct_size: usize,
    /// Modes of up to this angular frequency matter \[angle/time\]; 0 for 20 times that of the
    /// period. Default 0.
    pub highest_frequency: f64,
    /// Estimated error of the multipliers of these modes, in units of 1 or of the multiplier where
    /// that is more. Default 1e-8.
    pub tolerance: f64,
    /// Told about ten times a second that work goes on; may cancel. Default NULL.
    pub progress: pdn_progress_fn,
    /// Handed to progress.
    pub progress_data: *mut c_void,
}

// SAFETY: all fields are plain numbers or pointers, `struct_size` is the first, no padding.
unsafe impl Options for pdn_stability_options {
    const SIZES: &'static [usize] = &[40];

    fn defaults() -> Self {
        pdn_stability_options {
            tolerance: StabilityOptions::default().tolerance,
            ..Self::blank()
        }
    }
}

/// What options ask for.
pub(super) fn core_options(call: &Call, given: &pdn_stability_options) -> Result<StabilityOptions> {
    let highest = call.number(given.highest_frequency, "options.highest_frequency")?;
    Ok(StabilityOptions {
        highest_frequency: (highest != 0.0).then_some(highest),
        tolerance: call.number(given.tolerance, "options.tolerance")?,
        watch: watch(given.progress, given.progress_data, PROGRESS_INTERVAL)?,
        ..StabilityOptions::default()
    })
}

/// Sets default options; use `PDN_INIT(pdn_stability_options, &options)`.
///
/// @param options  the options; not NULL
/// @param struct_size  `sizeof *options`
///
/// Threads: any.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_stability_options_init(
    options: *mut pdn_stability_options,
    struct_size: usize,
) {
    init(options, struct_size, "options");
}

/// Finds the Floquet multipliers of a periodic solution: what small disturbances are multiplied by
/// in a period.
///
/// Disturbances obey the exact linearised equations, constraints, redundant ones too, and internal
/// states included, about the solution interpolated between its grid points. They are integrated
/// over the period in steps that are halved until the multipliers of modes up to the highest
/// frequency stand still. The error of the periodic solution itself comes with theirs.
///
/// @param solution  a converged solution of ::pdn_solve_periodic or one like it; not NULL
/// @param options  may be NULL for the defaults
/// @param out  the multipliers; free them with ::pdn_stability_free; written on success only
/// @return PDN_OK; PDN_ERR_NULL; PDN_ERR_NOT_FINITE; PDN_ERR_VALUE; PDN_ERR_STRUCT_SIZE;
///     PDN_ERR_NOT_AVAILABLE (no periodic solution, or one that has not converged);
///     PDN_ERR_GRID_TOO_COARSE (a motion that cannot be interpolated); PDN_ERR_CALLBACK (of a
///     signal or force); PDN_ERR_MEMORY
///
/// Threads: like a `const` use of `solution`. Signals' functions, forces and `progress` are called
/// on this thread.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_solve_stability(
    solution: *const pdn_solution,
    options: *const pdn_stability_options,
    out: *mut *mut pdn_stability,
) -> pdn_status {
    guard(|call| {
        let solution = call.shared(solution, "solution")?;
        let options = core_options(call, &call.options(options, "options")?)?;
        let out = call.out(out, "out")?;
        out.give(solution.solve_stability(&options)?);
        Ok(())
    })
}

/// Frees multipliers; NULL does nothing.
///
/// @param stability  the multipliers, not to be used any more
///
/// Threads: exclusive use of `stability`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_stability_free(stability: *mut pdn_stability) {
    free(stability);
}

/// How the analysis ended.
///
/// @param stability  the multipliers; not NULL
/// @return PDN_CONVERGED; PDN_TOLERANCE_NOT_MET (not all multipliers up to the highest frequency
///     that was asked for are known to the tolerance); PDN_SINGULAR or PDN_CANCELLED (there are no
///     multipliers); or an error as ::pdn_solution_outcome
///
/// Threads: like `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_stability_outcome(stability: *const pdn_stability) -> i32 {
    let mut outcome = 0;
    let status = guard(|call| {
        outcome = outcome_code(call.shared(stability, "stability")?.outcome);
        Ok(())
    });
    if status < 0 { status } else { outcome }
}

/// What the multipliers say.
///
/// @param stability  the multipliers; not NULL
/// @param verdict  PDN_STABLE, PDN_UNSTABLE or PDN_STABILITY_NOT_KNOWN; written on success only
/// @param frequency_limit  angular frequency of modes up to which the verdict holds; infinite if
///     all multipliers are known; may be NULL; written on success only
/// @return PDN_OK, PDN_ERR_NULL
///
/// Threads: like `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_stability_verdict(
    stability: *const pdn_stability,
    verdict: *mut i32,
    frequency_limit: *mut f64,
) -> pdn_status {
    guard(|call| {
        let stability = call.shared(stability, "stability")?;
        let verdict = call.out(verdict, "verdict")?;
        let limit = call.out_optional(frequency_limit, "frequency_limit")?;
        verdict.set(verdict_code(stability.verdict));
        if let Some(limit) = limit {
            limit.set(stability.frequency_limit);
        }
        Ok(())
    })
}

/// Number of multipliers that are known, and of those that the system has, one for each state.
///
/// Multipliers of modes far above the highest frequency that was asked for may be left out.
///
/// @param stability  the multipliers; not NULL
/// @param out  the number that are known; written on success only
/// @param states  the number that the system has; may be NULL; written on success only
/// @return PDN_OK, PDN_ERR_NULL
///
/// Threads: like `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_stability_count(
    stability: *const pdn_stability,
    out: *mut usize,
    states: *mut usize,
) -> pdn_status {
    guard(|call| {
        let stability = call.shared(stability, "stability")?;
        let out = call.out(out, "out")?;
        let states = call.out_optional(states, "states")?;
        out.set(stability.multipliers.len());
        if let Some(states) = states {
            states.set(stability.states);
        }
        Ok(())
    })
}

/// A disturbance `exp(mu t) phi(t)` of a periodic solution, where phi has its period. Initialise
/// with `PDN_INIT(pdn_multiplier, &multiplier)`.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct pdn_multiplier {
    /// Set by the initialiser.
    pub struct_size: usize,
    /// Real part of the multiplier rho = exp(mu T).
    pub real: f64,
    /// Imaginary part of rho.
    pub imaginary: f64,
    /// Real part of the exponent mu \[1/time\]; negative if the disturbance dies away.
    pub exponent_real: f64,
    /// Imaginary part of mu \[angle/time\]: of the many that give rho that nearest to the frequency
    /// of the mode.
    pub exponent_imaginary: f64,
    /// Angular frequency of the mode over the period, in the nodes' own axes.
    pub frequency: f64,
    /// Estimated error of rho, for this periodic solution.
    pub error: f64,
    /// 1 if rho is 1 because the disturbance only moves the solution in time, or all of the
    /// mechanism in space; else 0.
    pub trivial: i32,
    /// Zero.
    pub reserved: i32,
}

// SAFETY: all fields are plain numbers, `struct_size` is the first, no padding.
unsafe impl Options for pdn_multiplier {
    const SIZES: &'static [usize] = &[64];
}

/// Prepares a struct for ::pdn_stability_get; use `PDN_INIT(pdn_multiplier, &multiplier)`.
///
/// @param multiplier  the struct; not NULL
/// @param struct_size  `sizeof *multiplier`
///
/// Threads: any.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_multiplier_init(multiplier: *mut pdn_multiplier, struct_size: usize) {
    init(multiplier, struct_size, "multiplier");
}

/// A multiplier.
///
/// @param stability  the multipliers; not NULL
/// @param number  its number, from 0: the largest is first, of a conjugate pair that with the
///     positive imaginary part
/// @param out  initialised by PDN_INIT; filled on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID, PDN_ERR_STRUCT_SIZE
///
/// Threads: like `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_stability_get(
    stability: *const pdn_stability,
    number: i32,
    out: *mut pdn_multiplier,
) -> pdn_status {
    guard(|call| {
        let stability = call.shared(stability, "stability")?;
        let count = stability.multipliers.len();
        let number = model::number(number, count, "number", "a multiplier's number")?;
        let out = call.out_struct(out, "out")?;
        let multiplier = &stability.multipliers[number];
        out.set(pdn_multiplier {
            real: multiplier.value.re,
            imaginary: multiplier.value.im,
            exponent_real: multiplier.exponent.re,
            exponent_imaginary: multiplier.exponent.im,
            frequency: multiplier.frequency,
            error: multiplier.error,
            trivial: i32::from(multiplier.trivial),
            ..pdn_multiplier::defaults()
        });
        Ok(())
    })
}

/// Number of times of the shapes of modes.
///
/// @param stability  the multipliers; not NULL
/// @param out  the number; written on success only
/// @return PDN_OK, PDN_ERR_NULL
///
/// Threads: like `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_stability_time_count(
    stability: *const pdn_stability,
    out: *mut usize,
) -> pdn_status {
    guard(|call| {
        let stability = call.shared(stability, "stability")?;
        call.out(out, "out")?.set(stability.times().len());
        Ok(())
    })
}

/// Times of the shapes of modes: ends of equal steps over the period, the last is the period.
///
/// @param stability  the multipliers; not NULL
/// @param times  array of length [count]
/// @param count  their number, as ::pdn_stability_time_count tells
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_SIZE
///
/// Threads: like `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_stability_times(
    stability: *const pdn_stability,
    times: *mut f64,
    count: usize,
) -> pdn_status {
    guard(|call| {
        let all = call.shared(stability, "stability")?.times();
        require_count(count, all.len())?;
        call.out_slice(times, count, count, "times")?.set(&all);
        Ok(())
    })
}

/// The mode phi of a multiplier at a node over the period.
///
/// Small displacements and rotations along the node's own axes, at the times of
/// ::pdn_stability_times. The largest component of all nodes over the period is 1, with
/// displacements relative to the size of the mechanism and rotations in radians.
///
/// @param stability  the multipliers; not NULL
/// @param number  number of the multiplier, from 0
/// @param node  id of the node
/// @param steps  number of times, as ::pdn_stability_time_count tells
/// @param real  array of shape 6 x [steps]: real part, components fastest
/// @param imaginary  array of shape 6 x [steps]: imaginary part; may be NULL
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID, PDN_ERR_SIZE
///
/// Threads: like `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_stability_shape(
    stability: *const pdn_stability,
    number: i32,
    node: i32,
    steps: usize,
    real: *mut f64,
    imaginary: *mut f64,
) -> pdn_status {
    guard(|call| {
        let stability = call.shared(stability, "stability")?;
        let count = stability.multipliers.len();
        let number = model::number(number, count, "number", "a multiplier's number")?;
        let node = Kind::Node.index_below(node, stability.nodes(), "node")?;
        let shape = stability.shape(number, node)?;
        if steps != shape.len() {
            return Err(crate::error::Error::size("steps", shape.len(), steps));
        }
        let length = 6 * shape.len();
        let real = call.out_slice(real, length, length, "real")?;
        let imaginary = call.out_slice_optional(imaginary, length, "imaginary")?;
        let all = shape.as_flattened();
        real.set(&all.iter().map(|x| x.re).collect::<Vec<_>>());
        if let Some(imaginary) = imaginary {
            imaginary.set(&all.iter().map(|x| x.im).collect::<Vec<_>>());
        }
        Ok(())
    })
}

/// A readable report: the verdict, how far it holds, and a table of the multipliers.
///
/// @param stability  the multipliers; not NULL
/// @param buffer  array of length [capacity] for the text, UTF-8, always ended by NUL; may be NULL
///     if capacity is 0
/// @param capacity  size of buffer in bytes
/// @return length of the whole report without the NUL, as snprintf does; 0 if the handle is not
///     valid
///
/// Threads: like `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_stability_report(
    stability: *const pdn_stability,
    buffer: *mut c_char,
    capacity: usize,
) -> usize {
    guard_or(0, |call| {
        let report = call.shared(stability, "stability")?.report();
        copy_message(&report, buffer, capacity);
        Ok(report.len())
    })
}
