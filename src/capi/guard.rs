//! The wall between Rust and C: no panic passes it, and every failure leaves its message.

use super::call::Call;
use super::handle::{self, Handle};
use super::last_error::fail;
use super::options::{self, Options};
use super::status::{PDN_OK, pdn_status};
use crate::error::{Error, ErrorKind, Result};
use std::any::Any;
use std::cell::Cell;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Once;
use std::sync::atomic::{AtomicBool, Ordering};

/// Body of a C function that returns a status.
///
/// Safe to call, yet [`Call`] reads raw pointers: the promise comes from the `unsafe extern "C"`
/// function around it, whose caller vouches for its pointers. Use it nowhere else.
pub(super) fn guard(body: impl FnOnce(&Call) -> Result<()>) -> pdn_status {
    match run(body) {
        Ok(()) => PDN_OK,
        Err(error) => fail(&error),
    }
}

/// Body of a C function that returns a value; `fallback` stands for failure.
pub(super) fn guard_or<T>(fallback: T, body: impl FnOnce(&Call) -> Result<T>) -> T {
    run(body).unwrap_or_else(|error| {
        fail(&error);
        fallback
    })
}

/// Body of a destructor.
pub(super) fn free<H: Handle>(handle: *mut H) {
    // A destructor may panic too.
    guard(|_| {
        handle::destroy(handle);
        Ok(())
    });
}

/// Body of an initialiser of the struct that is argument `name`.
pub(super) fn init<T: Options>(pointer: *mut T, struct_size: usize, name: &str) {
    guard(|_| options::write_defaults(pointer, struct_size, name));
}

fn run<T>(body: impl FnOnce(&Call) -> Result<T>) -> Result<T> {
    // Unwind safety: an exclusively used handle poisons itself, nothing else is changed in place.
    let outer = INSIDE.replace(true);
    let outcome = catch_unwind(AssertUnwindSafe(|| {
        let call = Call::new();
        body(&call).map_err(|error| call.named(error))
    }));
    INSIDE.set(outer);
    outcome.unwrap_or_else(|payload| Err(panic_error(payload.as_ref())))
}

fn panic_error(payload: &(dyn Any + Send)) -> Error {
    let said = payload
        .downcast_ref::<&str>()
        .copied()
        .or_else(|| payload.downcast_ref::<String>().map(String::as_str))
        .unwrap_or("no message");
    Error::new(
        ErrorKind::Panic,
        format!("internal error, please report it: {said}"),
    )
}

thread_local! {
    /// Whether this thread is inside a call of the library.
    static INSIDE: Cell<bool> = const { Cell::new(false) };
}

static SILENT: AtomicBool = AtomicBool::new(false);

/// Chooses whether internal errors are also printed to stderr. They are, unless this is called.
///
/// An internal error (PDN_ERR_PANIC) is a defect of the library; the printed text says where it is.
/// Holds for the whole process.
///
/// @param enabled  1: they are printed; 0: they are not
///
/// Threads: any.
/// @since 0.1
#[unsafe(no_mangle)]
pub extern "C" fn pdn_set_panic_printing(enabled: i32) {
    static HOOK: Once = Once::new();
    SILENT.store(enabled == 0, Ordering::Relaxed);
    // The hook is the process's: touched only on demand, and other people's panics pass through.
    if enabled == 0 {
        HOOK.call_once(|| {
            let previous = std::panic::take_hook();
            std::panic::set_hook(Box::new(move |info| {
                let ours = INSIDE.try_with(Cell::get).unwrap_or(false);
                if !(ours && SILENT.load(Ordering::Relaxed)) {
                    previous(info);
                }
            }));
        });
    }
}
