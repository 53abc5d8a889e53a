//! Signals, by value: scalar functions of time that drive loads and prescribed coordinates.

use super::call::Call;
use super::callback::Callback;
use super::guard::{guard, init};
use super::options::Options;
use super::pointer::null;
use super::section::{read_struct, read_structs, update_struct};
use super::status::pdn_status;
use crate::error::{Error, Result};
use crate::model::Signal;
use libc::c_void;
use std::mem::offset_of;
use std::sync::Arc;

/// Kind of a signal: mean, rate and harmonics. Also what a constant is.
pub const PDN_SIGNAL_HARMONICS: i32 = 1200;
/// Kind of a signal: rate and samples over one period.
pub const PDN_SIGNAL_SAMPLES: i32 = 1201;
/// Kind of a signal: a function of the caller.
pub const PDN_SIGNAL_FUNCTION: i32 = 1202;

/// Kind of a signal: a function of the caller, of the phase.
pub const PDN_SIGNAL_FUNCTION_OF_PHASE: i32 = 1203;

/// A function of time, to be written by the caller.
///
/// Called on the thread that solves, with times from 0 to the period T of the solve, or with the
/// times of a march; if two threads solve at once, on both at once. It must give the same value for
/// the same time, and must neither throw nor jump out, nor use the model it belongs to.
///
/// @param time  in [0, T]
/// @param value  where the value goes; not NULL, valid during the call only
/// @param user_data  as given to ::pdn_signal_set_function
/// @return 0 for success; anything else makes the solve fail with PDN_ERR_CALLBACK (see
///     ::pdn_set_callback_error and ::pdn_last_callback_code), as does a value that is not finite
pub type pdn_signal_fn =
    Option<unsafe extern "C" fn(time: f64, value: *mut f64, user_data: *mut c_void) -> i32>;

/// The function pointer without its `Option`.
type Function = unsafe extern "C" fn(f64, *mut f64, *mut c_void) -> i32;

/// A scalar function of time: a load's component or a prescribed coordinate.
///
/// Start with `PDN_INIT(pdn_signal, &signal)`, which makes it zero; then one of the
/// `pdn_signal_set_...`, each of which replaces all that was set before. Leave the fields to them.
///
/// The signal only points to the caller's arrays: they must be there until the signal has been
/// given to the model, which copies them. It can be given any number of times.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct pdn_signal {
    /// Set by the initialiser.
    pub struct_size: usize,
    /// PDN_SIGNAL_HARMONICS, PDN_SIGNAL_SAMPLES, PDN_SIGNAL_FUNCTION or
    /// PDN_SIGNAL_FUNCTION_OF_PHASE.
    pub kind: i32,
    /// Leave it zero.
    pub reserved: i32,
    /// Mean; with harmonics only.
    pub mean: f64,
    /// Growth for a unit of time; with harmonics or samples.
    pub rate: f64,
    /// Array of length [harmonics].
    pub cosines: *const f64,
    /// Array of length [harmonics].
    pub sines: *const f64,
    /// Number of harmonics.
    pub harmonics: usize,
    /// Array of length [sample_count].
    pub samples: *const f64,
    /// Number of samples.
    pub sample_count: usize,
    /// The function.
    pub function: pdn_signal_fn,
    /// Handed to the function.
    pub user_data: *mut c_void,
}

// SAFETY: numbers and pointers only, `struct_size` is the first, and there is no padding.
unsafe impl Options for pdn_signal {
    // A release that adds a field adds where that field ends.
    const SIZES: &'static [usize] = &[offset_of!(pdn_signal, user_data) + size_of::<*mut c_void>()];

    fn defaults() -> Self {
        pdn_signal {
            kind: PDN_SIGNAL_HARMONICS,
            ..Self::blank()
        }
    }
}

/// The signal that an argument gives, with copies of its arrays.
pub(super) fn read(call: &Call, signal: *const pdn_signal, name: &str) -> Result<Signal> {
    let given = read_struct(call, signal, name)?;
    let core = given.core(call);
    core.map_err(|error| error.within(name))
}

/// An array of signals: those of a caller compiled with another release have another size.
pub(super) fn read_array(
    call: &Call,
    signals: *const pdn_signal,
    count: usize,
    name: &str,
) -> Result<Vec<Signal>> {
    read_structs(call, signals, count, name, |s| s.struct_size)?
        .iter()
        .enumerate()
        .map(|(i, given)| {
            let core = given.core(call);
            core.map_err(|error| error.within(format!("{name}[{i}]")))
        })
        .collect()
}

impl pdn_signal {
    fn core(&self, call: &Call) -> Result<Signal> {
        if self.reserved != 0 {
            return Err(Error::value("reserved", "zero", self.reserved));
        }
        match self.kind {
            PDN_SIGNAL_HARMONICS => Signal::harmonics(
                self.mean,
                self.rate,
                call.numbers(self.cosines, self.harmonics, "cosines")?,
                call.numbers(self.sines, self.harmonics, "sines")?,
            ),
            PDN_SIGNAL_SAMPLES => Signal::samples(
                self.rate,
                call.numbers(self.samples, self.sample_count, "samples")?,
            ),
            PDN_SIGNAL_FUNCTION | PDN_SIGNAL_FUNCTION_OF_PHASE => {
                let function = self.function.ok_or_else(|| null("function"))?;
                let callback = Callback::<Function>::new(function, self.user_data, None);
                let signal = match self.kind {
                    PDN_SIGNAL_FUNCTION => Signal::function,
                    _ => Signal::function_of_phase,
                };
                Ok(signal(Arc::new(move |time| {
                    // What the function leaves unwritten is found out.
                    let mut value = f64::NAN;
                    callback.invoke("signal", |function, user_data| {
                        // SAFETY: the caller gave the function with its `user_data`; it writes one
                        // number.
                        unsafe { function(time, &raw mut value, user_data) }
                    })?;
                    Ok(value)
                })))
            }
            other => Err(Error::value(
                "kind",
                "PDN_SIGNAL_HARMONICS, PDN_SIGNAL_SAMPLES or PDN_SIGNAL_FUNCTION, _OF_PHASE",
                other,
            )),
        }
    }

    /// Becomes `new`, but for its size.
    fn replace(&mut self, new: Self) {
        *self = pdn_signal {
            struct_size: self.struct_size,
            ..new
        };
    }
}

/// Makes a signal that is zero. Use it as `PDN_INIT(pdn_signal, &signal)`.
///
/// @param signal  the signal; not NULL
/// @param struct_size  sizeof(pdn_signal)
///
/// Threads: any.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_signal_init(signal: *mut pdn_signal, struct_size: usize) {
    init(signal, struct_size, "signal");
}

/// Makes a signal constant.
///
/// @param signal  an initialised signal; not NULL
/// @param value  its value, in the unit of what it drives
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE, PDN_ERR_NOT_FINITE
///
/// Threads: exclusive use of `signal`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_signal_set_constant(
    signal: *mut pdn_signal,
    value: f64,
) -> pdn_status {
    guard(|call| {
        update_struct(call, signal, "signal", |signal| {
            signal.replace(pdn_signal {
                mean: call.number(value, "value")?,
                ..pdn_signal::defaults()
            });
            Ok(())
        })
    })
}

/// Makes a signal of harmonics, mean and rate.
///
/// Its value is mean + rate t + the sum over j = 1 ... count of cosines[j-1] cos(j w t) +
/// sines[j-1] sin(j w t), with w = 2 pi / T and the period T that is given to the solve. What
/// drives a rotation may have a rate if it grows by whole turns in a period (rate * T a multiple of
/// 2 pi); all else must have rate zero.
///
/// @param signal  an initialised signal; not NULL
/// @param mean  mean, in the unit of what the signal drives; usually 0
/// @param rate  growth for a unit of time; usually 0
/// @param cosines  array of length [count]; may be NULL if count is 0. Read by the call that takes
///     the signal: must be there until then
/// @param sines  array of length [count]; may be NULL if count is 0. Read by the call that takes
///     the signal: must be there until then
/// @param count  number of harmonics
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE, PDN_ERR_SIZE, PDN_ERR_NOT_FINITE
///
/// Threads: exclusive use of `signal`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_signal_set_harmonics(
    signal: *mut pdn_signal,
    mean: f64,
    rate: f64,
    cosines: *const f64,
    sines: *const f64,
    count: usize,
) -> pdn_status {
    guard(|call| {
        update_struct(call, signal, "signal", |signal| {
            call.numbers(cosines, count, "cosines")?;
            call.numbers(sines, count, "sines")?;
            signal.replace(pdn_signal {
                mean: call.number(mean, "mean")?,
                rate: call.number(rate, "rate")?,
                cosines,
                sines,
                harmonics: count,
                ..pdn_signal::defaults()
            });
            Ok(())
        })
    })
}

/// Makes a signal rate t plus the trigonometric interpolation of samples[k] at t = k T / count.
///
/// The samples are equally spaced over one period T of the solve, the end of which is not repeated.
///
/// @param signal  an initialised signal; not NULL
/// @param rate  growth for a unit of time, as in ::pdn_signal_set_harmonics; usually 0
/// @param samples  array of length [count], without the growth, in the unit of what the signal
///     drives; not NULL. Read by the call that takes the signal: must be there until then
/// @param count  number of samples, at least 1, odd or even
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE, PDN_ERR_SIZE, PDN_ERR_NOT_FINITE
///
/// Threads: exclusive use of `signal`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_signal_set_samples(
    signal: *mut pdn_signal,
    rate: f64,
    samples: *const f64,
    count: usize,
) -> pdn_status {
    guard(|call| {
        update_struct(call, signal, "signal", |signal| {
            if count == 0 {
                return Err(Error::size("count", "at least 1", count));
            }
            call.numbers(samples, count, "samples")?;
            signal.replace(pdn_signal {
                kind: PDN_SIGNAL_SAMPLES,
                rate: call.number(rate, "rate")?,
                samples,
                sample_count: count,
                ..pdn_signal::defaults()
            });
            Ok(())
        })
    })
}

/// Makes a signal a function of the caller of this kind.
fn set_function(
    signal: *mut pdn_signal,
    function: pdn_signal_fn,
    user_data: *mut c_void,
    kind: i32,
) -> pdn_status {
    guard(|call| {
        update_struct(call, signal, "signal", |signal| {
            call.function(function, "function")?;
            signal.replace(pdn_signal {
                kind,
                function,
                user_data,
                ..pdn_signal::defaults()
            });
            Ok(())
        })
    })
}

/// Makes a signal a function of the caller.
///
/// Over a period it may grow by whole turns if it drives a rotation, and must not grow otherwise.
///
/// @param signal  an initialised signal; not NULL
/// @param function  the function, see ::pdn_signal_fn for when it is called; not NULL
/// @param user_data  handed to the function; may be NULL. Must be valid until each model that was
///     given the signal, and each solution of it, has been freed
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE
///
/// Threads: exclusive use of `signal`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_signal_set_function(
    signal: *mut pdn_signal,
    function: pdn_signal_fn,
    user_data: *mut c_void,
) -> pdn_status {
    set_function(signal, function, user_data, PDN_SIGNAL_FUNCTION)
}

/// Makes a signal a function of the caller, of the phase 2 pi t / T \[radians\], which it is told
/// in place of the time: it holds for any period T.
///
/// Over a period it may grow by whole turns if it drives a rotation, and must not grow otherwise.
///
/// @param signal  an initialised signal; not NULL
/// @param function  the function, see ::pdn_signal_fn for when it is called; not NULL
/// @param user_data  handed to the function; may be NULL. Must be valid until each model that was
///     given the signal, and each solution of it, has been freed
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE
///
/// Threads: exclusive use of `signal`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_signal_set_function_of_phase(
    signal: *mut pdn_signal,
    function: pdn_signal_fn,
    user_data: *mut c_void,
) -> pdn_status {
    set_function(signal, function, user_data, PDN_SIGNAL_FUNCTION_OF_PHASE)
}
