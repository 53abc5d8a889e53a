//! What is given to the library: sections, signals, and functions that fail now and then.

use super::bytes::Bytes;
use periodyn::capi::controller::{pdn_controller_state, pdn_controller_values};
use periodyn::capi::periodic::pdn_progress;
use periodyn::capi::section::{pdn_section, pdn_section_init};
use periodyn::capi::signal::{PDN_SIGNAL_HARMONICS, pdn_signal, pdn_signal_init};
use periodyn::capi::surface_force::{pdn_surface_state, pdn_surface_values};
use std::cell::Cell;
use std::ffi::c_void;
use std::ptr::null_mut;

thread_local! {
    /// Calls of functions that are left until one fails, and how it does.
    static LEFT: Cell<(u32, u8)> = const { Cell::new((u32::MAX, 0)) };
    /// Calls of progress that are left until a solve is cancelled.
    static PATIENCE: Cell<u32> = const { Cell::new(0) };
}

/// Lets a call of the functions fail: not at all, or the first, second, ... from now.
pub fn plan_failure(bytes: &mut Bytes) {
    let calls = match bytes.byte() {
        0..=159 => u32::MAX,
        byte => u32::from(byte - 160) * 7,
    };
    LEFT.set((calls, bytes.byte()));
}

/// What the next call of a function is to give in place of its value: a failure, or no number.
fn next() -> Option<u8> {
    let (left, how) = LEFT.get();
    LEFT.set((left.saturating_sub(u32::from(left != u32::MAX)), how));
    (left == 0).then_some(how)
}

unsafe extern "C" fn function(time: f64, value: *mut f64, _: *mut c_void) -> i32 {
    let (result, x) = match next() {
        None => (0, (3.0 * time).sin()),
        Some(how) if how < 128 => (1, 0.0),
        Some(how) if how < 192 => (0, f64::NAN),
        Some(_) => (0, f64::INFINITY),
    };
    // SAFETY: the library gives a place for one number.
    unsafe { value.write(x) };
    result
}

/// A law without tangents: a cubic spring with a damper.
pub unsafe extern "C" fn law(
    _: f64,
    coordinate: f64,
    rate: f64,
    effort: *mut f64,
    _: *mut f64,
    _: *mut c_void,
) -> i32 {
    let (result, x) = match next() {
        None => (0, 2.0 * coordinate + coordinate.powi(3) + 0.3 * rate),
        Some(how) if how < 128 => (1, 0.0),
        Some(_) => (0, f64::NAN),
    };
    // SAFETY: the library gives a place for one number.
    unsafe { effort.write(x) };
    result
}

/// What is written to the first of some values in place of what was computed, and the result.
///
/// # Safety
/// `values` has room for a number.
unsafe fn spoil(how: u8, values: *mut f64) -> i32 {
    if how >= 128 {
        // SAFETY: the caller gives a place.
        unsafe { values.write(f64::NAN) };
    }
    i32::from(how < 128)
}

/// Efforts by the sums of all that is read; states that follow it with a lag.
pub unsafe extern "C" fn controller(
    state: *const pdn_controller_state,
    values: *mut pdn_controller_values,
    _: *mut c_void,
) -> i32 {
    // SAFETY: the library gives both, with arrays as long as they tell; empty ones may be NULL.
    unsafe {
        let (state, values) = (&*state, &*values);
        let sum = |at: *const f64, count| (0..count).map(|i| *at.add(i)).sum::<f64>();
        let read = sum(state.inputs, state.input_count) + sum(state.input_rates, state.input_count);
        let kept = sum(state.states, state.state_count);
        for i in 0..values.output_count {
            values.efforts.add(i).write(-0.3 * read - 0.1 * kept);
        }
        for i in 0..state.state_count {
            values.state_rates.add(i).write(read - *state.states.add(i));
        }
        next().map_or(0, |how| spoil(how, values.efforts))
    }
}

/// A drag on each point of a surface.
pub unsafe extern "C" fn surface_force(
    state: *const pdn_surface_state,
    values: *mut pdn_surface_values,
    _: *mut c_void,
) -> i32 {
    // SAFETY: the library gives both, with arrays as long as they tell.
    unsafe {
        let (state, values) = (&*state, &*values);
        for i in 0..6 * state.point_count {
            values.forces.add(i).write(-0.2 * *state.velocities.add(i));
        }
        next().map_or(0, |how| spoil(how, values.forces))
    }
}

/// Lets solves go on for so many calls of [`progress`].
pub fn be_patient(calls: u32) {
    PATIENCE.set(calls);
}

pub unsafe extern "C" fn progress(_: *const pdn_progress, _: *mut c_void) -> i32 {
    let left = PATIENCE.get();
    PATIENCE.set(left.saturating_sub(1));
    i32::from(left == 0)
}

pub fn section(bytes: &mut Bytes) -> pdn_section {
    let mut section = std::mem::MaybeUninit::zeroed();
    // SAFETY: plain numbers, of the size told.
    let mut section = unsafe {
        pdn_section_init(section.as_mut_ptr(), size_of::<pdn_section>());
        section.assume_init()
    };
    let (stiff, heavy) = (bytes.positive(), bytes.positive());
    for k in 0..6 {
        section.stiffness[7 * k] = 100.0 * stiff;
        section.mass[7 * k] = 0.1 * heavy;
        section.damping[7 * k] = 0.1 * stiff;
    }
    if bytes.rarely(4) {
        let coupling = bytes.number();
        for matrix in [
            &mut section.stiffness,
            &mut section.mass,
            &mut section.damping,
        ] {
            (matrix[4], matrix[24]) = (coupling, coupling);
        }
    }
    if bytes.rarely(6) {
        let at = bytes.below(36);
        section.stiffness[at] = bytes.number();
    }
    section
}

/// Arrays that a signal refers to.
#[derive(Default)]
pub struct Arrays {
    first: [f64; 7],
    second: [f64; 7],
}

pub fn signal(bytes: &mut Bytes, arrays: &mut Arrays) -> pdn_signal {
    let mut signal = std::mem::MaybeUninit::zeroed();
    // SAFETY: plain numbers and pointers, of the size told.
    let mut signal = unsafe {
        pdn_signal_init(signal.as_mut_ptr(), size_of::<pdn_signal>());
        signal.assume_init()
    };
    arrays.first = bytes.numbers();
    arrays.second = bytes.numbers();
    signal.kind = bytes.constant(PDN_SIGNAL_HARMONICS, 4);
    signal.mean = bytes.number();
    signal.rate = match bytes.below(4) {
        0 => bytes.number(),
        1 => std::f64::consts::PI,
        _ => 0.0,
    };
    signal.harmonics = bytes.below(4);
    (signal.cosines, signal.sines) = (arrays.first.as_ptr(), arrays.second.as_ptr());
    signal.samples = arrays.first.as_ptr();
    signal.sample_count = bytes.below(8);
    signal.function = match bytes.rarely(16) {
        true => None,
        false => Some(function),
    };
    signal.user_data = null_mut();
    if bytes.rarely(24) {
        signal.cosines = std::ptr::null();
    }
    signal
}
