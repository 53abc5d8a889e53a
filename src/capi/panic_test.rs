//! Defects anywhere in a solve: each is a status with a message, nothing is given, and the model is
//! as good as before.

use super::force::pdn_model_add_spring_damper;
use super::guard::pdn_set_panic_printing;
use super::id::{PDN_FIRST_JOINT, PDN_FIRST_NODE};
use super::joint::{pdn_model_add_revolute, pdn_model_prescribe};
use super::last_error::pdn_last_error;
use super::load::pdn_model_add_load;
use super::march::{pdn_march_options_init, pdn_solve_march};
use super::model::{pdn_model, pdn_model_add_rigid_body, pdn_model_free, pdn_model_new};
use super::modes::{pdn_modes_free, pdn_solve_modes};
use super::options::Options;
use super::periodic::{pdn_periodic_options_init, pdn_solve_periodic};
use super::quantity::{PDN_NODE_POSITION, pdn_quantity, pdn_solution_sample};
use super::shooting::{pdn_shooting_options_init, pdn_solve_shooting};
use super::signal::{pdn_signal, pdn_signal_init, pdn_signal_set_harmonics};
use super::solution::{pdn_solution, pdn_solution_free};
use super::stability::{pdn_solve_stability, pdn_stability_free};
use super::statics::{pdn_solve_static, pdn_static_options_init};
use super::status::{PDN_ERR_PANIC, PDN_OK, pdn_status};
use crate::workers::trip;
use std::mem::MaybeUninit;
use std::ptr::{null, null_mut};

/// Pulses until the first defect, of each kind of solve, are 0, 1, 2, ... and then more at a time.
const MOST: usize = 100_000;

/// A call that must go well.
macro_rules! ok {
    ($function:ident($($argument:expr),* $(,)?)) => {
        // SAFETY: handles are alive, arrays as long as told.
        assert_eq!(unsafe { $function($($argument),*) }, PDN_OK, stringify!($function))
    };
}

/// A struct with its defaults.
macro_rules! defaults {
    ($init:ident) => {{
        let mut value = MaybeUninit::zeroed();
        // SAFETY: the initialiser writes all of it, and any bits are valid.
        unsafe {
            $init(value.as_mut_ptr(), size_of_val(&value));
            value.assume_init()
        }
    }};
}

/// A double pendulum whose first hinge is driven, with a spring and a damper at the second.
fn pendulum() -> *mut pdn_model {
    let mut model = null_mut();
    ok!(pdn_model_new(&raw mut model));
    let inertia = [0.1, 0.0, 0.0, 0.0, 0.1, 0.0, 0.0, 0.0, 0.1];
    let axis = [0.0, 1.0, 0.0];
    let mut last = -1;
    for k in 0..2 {
        let (centre, hinge) = ([f64::from(k) + 0.5, 0.0, 0.0], [f64::from(k), 0.0, 0.0]);
        let (mut body, mut joint) = (0, 0);
        let (centre, hinge) = (centre.as_ptr(), hinge.as_ptr());
        ok!(pdn_model_add_rigid_body(
            model,
            1.0,
            centre,
            inertia.as_ptr(),
            &mut body
        ));
        ok!(pdn_model_add_revolute(
            model,
            last,
            body,
            hinge,
            axis.as_ptr(),
            &mut joint
        ));
        last = body;
    }
    let (joint, angle) = (PDN_FIRST_JOINT + 1, super::joint::PDN_ROTATION);
    ok!(pdn_model_add_spring_damper(
        model,
        joint,
        angle,
        200.0,
        5.0,
        0.0,
        null_mut()
    ));
    let mut signal: pdn_signal = defaults!(pdn_signal_init);
    let (cosines, sines) = ([0.0], [0.2]);
    let [c, s] = [cosines, sines].map(|of| of[0]);
    ok!(pdn_signal_set_harmonics(&mut signal, 0.0, 0.0, &c, &s, 1));
    ok!(pdn_model_prescribe(
        model,
        PDN_FIRST_JOINT,
        super::joint::PDN_ROTATION,
        &signal,
        null_mut()
    ));
    ok!(pdn_signal_set_harmonics(
        &mut signal,
        -9.81,
        0.0,
        null(),
        null(),
        0
    ));
    let (frame, force) = (super::load::PDN_FRAME_SPACE, super::load::PDN_FORCE_3);
    ok!(pdn_model_add_load(
        model,
        last,
        frame,
        force,
        &signal,
        null_mut()
    ));
    model
}

fn message() -> String {
    let mut buffer = [0_u8; 256];
    // SAFETY: the buffer is as long as it says.
    let length = unsafe { pdn_last_error(buffer.as_mut_ptr().cast(), buffer.len()) };
    String::from_utf8_lossy(&buffer[..length.min(256)]).into_owned()
}

type Attempt = fn(*const pdn_model, *mut *mut pdn_solution) -> pdn_status;

fn periodic(model: *const pdn_model, out: *mut *mut pdn_solution, threads: i32) -> pdn_status {
    let mut options: super::periodic::pdn_periodic_options = defaults!(pdn_periodic_options_init);
    options.grid_points = 9;
    options.threads = threads;
    // SAFETY: as above.
    unsafe { pdn_solve_periodic(model, 2.0, &options, out) }
}

const ATTEMPTS: [(&str, Attempt); 6] = [
    ("periodic", |model, out| periodic(model, out, 1)),
    ("periodic on two threads", |model, out| {
        periodic(model, out, 2)
    }),
    ("static", |model, out| {
        let mut options: super::statics::pdn_static_options = defaults!(pdn_static_options_init);
        options.period = 2.0;
        // SAFETY: as above.
        unsafe { pdn_solve_static(model, &options, out) }
    }),
    ("march", |model, out| {
        let mut options: super::march::pdn_march_options = defaults!(pdn_march_options_init);
        (options.duration, options.step, options.period) = (0.2, 0.05, 2.0);
        // SAFETY: as above.
        unsafe { pdn_solve_march(model, &options, out) }
    }),
    ("shooting", |model, out| {
        let mut options: super::shooting::pdn_shooting_options =
            defaults!(pdn_shooting_options_init);
        (options.steps_per_period, options.iteration_limit) = (10, 2);
        // SAFETY: as above.
        unsafe { pdn_solve_shooting(model, 2.0, &options, out) }
    }),
    ("stability", |model, out| {
        let mut stability = null_mut();
        let status = periodic(model, out, 1);
        if status != PDN_OK {
            return status;
        }
        // SAFETY: as above.
        unsafe {
            let status = pdn_solve_stability(*out, null(), &raw mut stability);
            pdn_stability_free(stability);
            if status != PDN_OK {
                pdn_solution_free(*out);
                *out = null_mut();
            }
            status
        }
    }),
];

/// Where a body is, of what is found without a defect.
fn look(model: *const pdn_model, attempt: Attempt) -> [u64; 6] {
    let (times, mut positions) = ([0.1, 0.17], [0.0; 6]);
    let mut solution = null_mut();
    assert_eq!(attempt(model, &raw mut solution), PDN_OK);
    let position = pdn_quantity {
        kind: PDN_NODE_POSITION,
        object: PDN_FIRST_NODE + 1,
        ..pdn_quantity::defaults()
    };
    let (times, to) = (times.as_ptr(), positions.as_mut_ptr());
    ok!(pdn_solution_sample(
        solution,
        &raw const position,
        times,
        2,
        to
    ));
    // SAFETY: as above.
    unsafe { pdn_solution_free(solution) };
    positions.map(f64::to_bits)
}

#[test]
fn defects_in_solves_are_statuses_and_leave_the_model_as_it_was() {
    pdn_set_panic_printing(0);
    let model = pendulum();
    for (what, attempt) in ATTEMPTS {
        let before = look(model, attempt);
        let (mut pulses, mut defects) = (0, 0);
        loop {
            assert!(pulses < MOST, "{what}");
            let mut solution = null_mut();
            trip::after(Some(pulses));
            let status = attempt(model, &raw mut solution);
            if trip::after(None).is_some() {
                // It went through.
                assert_eq!(status, PDN_OK, "{what}");
                // SAFETY: as above.
                unsafe { pdn_solution_free(solution) };
                break;
            }
            assert_eq!(
                status,
                PDN_ERR_PANIC,
                "{what}, {pulses} pulses: {}",
                message()
            );
            assert!(message().contains("tripped on purpose"), "{}", message());
            assert!(solution.is_null(), "{what}");
            pulses += 1 + pulses / 8;
            defects += 1;
        }
        assert!(defects > 2, "{what}: {defects}");
        assert_eq!(look(model, attempt), before, "{what}");
    }
    // Modes of it, too.
    let mut modes = null_mut();
    trip::after(Some(0));
    // SAFETY: as above.
    let status = unsafe { pdn_solve_modes(model, null(), &raw mut modes) };
    assert_eq!(status, PDN_ERR_PANIC);
    trip::after(None);
    assert!(modes.is_null());
    // SAFETY: as above.
    unsafe {
        pdn_modes_free(modes);
        pdn_model_free(model);
    }
    pdn_set_panic_printing(1);
}
