//! The foundations as a C caller meets them, on a toy handle.

use super::call::Call;
use super::callback::{
    Callback, pdn_last_callback_code, pdn_set_callback_error, pdn_set_last_error,
};
use super::guard::{free, guard, init, pdn_set_panic_printing};
use super::handle::Handle;
use super::last_error::pdn_last_error;
use super::options::{self, Options};
use super::status::*;
use crate::error::{Error, Result};
use libc::{c_char, c_void};
use std::ptr::{null, null_mut};
use std::sync::Arc;

/// A toy object: a list of numbers.
struct toy {
    _private: [u8; 0],
}

impl Handle for toy {
    type Core = Vec<f64>;
}

fn new_toy() -> *mut toy {
    let mut toy = null_mut();
    let made = guard(|call| {
        call.out(&raw mut toy, "out")?.give(Vec::new());
        Ok(())
    });
    assert_eq!(made, PDN_OK);
    toy
}

fn push(toy: *mut toy, x: f64) -> pdn_status {
    guard(|call| {
        let mut toy = call.exclusive(toy, "toy")?;
        toy.push(call.number(x, "x")?);
        Ok(())
    })
}

fn length(toy: *const toy, out: *mut usize) -> pdn_status {
    guard(|call| {
        let toy = call.shared(toy, "toy")?;
        call.out(out, "out")?.set(toy.len());
        Ok(())
    })
}

fn last_error() -> String {
    let mut buffer = [0_u8; 256];
    // SAFETY: the buffer is as long as it says.
    let needed = unsafe { pdn_last_error(buffer.as_mut_ptr().cast(), buffer.len()) };
    String::from_utf8(buffer[..needed].to_vec()).unwrap()
}

/// Status and message of a body that fails.
fn failure(body: impl FnOnce(&Call) -> Result<()>) -> (pdn_status, String) {
    (guard(body), last_error())
}

#[test]
fn a_handle_lives_from_new_to_free() {
    let toy = new_toy();
    let mut n = 99;
    assert_eq!(push(toy, 2.0), PDN_OK);
    assert_eq!(length(toy, &raw mut n), PDN_OK);
    assert_eq!(n, 1);
    free(toy);
    free::<toy>(null_mut());
}

#[test]
fn failures_name_the_argument_and_write_nothing() {
    let toy = new_toy();
    let mut n = 99;
    assert_eq!(length(null(), &raw mut n), PDN_ERR_NULL);
    assert_eq!(n, 99);
    assert_eq!(last_error(), "toy: expected a pointer, got NULL");
    assert_eq!(length(toy, null_mut()), PDN_ERR_NULL);
    assert_eq!(last_error(), "out: expected a pointer, got NULL");
    assert_eq!(push(toy, f64::NAN), PDN_ERR_NOT_FINITE);
    assert_eq!(last_error(), "x: expected a finite number, got NaN");
    // Success leaves the message, and a refused change is no change.
    assert_eq!(length(toy, &raw mut n), PDN_OK);
    assert_eq!(n, 0);
    assert_eq!(last_error(), "x: expected a finite number, got NaN");
    free(toy);
}

#[test]
fn a_child_keeps_the_parent_as_it_was() {
    let toy = new_toy();
    push(toy, 1.0);
    let mut child = Arc::default();
    guard(|call| {
        child = call.shared(toy, "toy")?;
        Ok(())
    });
    push(toy, 2.0);
    assert_eq!(*child, [1.0]);
    free(toy);
    assert_eq!(*child, [1.0]);
}

#[test]
fn a_panic_becomes_a_status_and_poisons_what_it_changed() {
    pdn_set_panic_printing(0);
    let (changed, read) = (new_toy(), new_toy());
    let (status, message) = failure(|call| {
        let _read = call.shared(read, "read")?;
        let mut changed = call.exclusive(changed, "changed")?;
        changed.push(1.0);
        panic!("tripped over {}", 3);
    });
    assert_eq!(status, PDN_ERR_PANIC);
    assert_eq!(message, "internal error, please report it: tripped over 3");
    let mut n = 99;
    assert_eq!(push(changed, 1.0), PDN_ERR_POISONED);
    assert_eq!(length(changed, &raw mut n), PDN_ERR_POISONED);
    assert_eq!(length(read, &raw mut n), PDN_OK);
    free(changed);
    free(read);
    pdn_set_panic_printing(1);
}

#[test]
fn a_handle_being_changed_is_refused_to_others() {
    let toy = new_toy();
    let status = guard(|call| {
        let _busy = call.exclusive(toy, "toy")?;
        assert_eq!(push(toy, 1.0), PDN_ERR_VALUE);
        assert_eq!(length(toy, &mut 0), PDN_ERR_VALUE);
        Ok(())
    });
    assert_eq!(status, PDN_OK);
    assert_eq!(push(toy, 1.0), PDN_OK);
    free(toy);
}

#[test]
fn arrays_are_checked() {
    let good = [1.0, 2.0, 3.0];
    let bad = [1.0, f64::INFINITY, 3.0];
    assert_eq!(
        guard(|call| {
            assert_eq!(call.array::<3>(good.as_ptr(), "x")?, good);
            assert_eq!(call.numbers(good.as_ptr(), 2, "x")?, [1.0, 2.0]);
            assert!(call.numbers(null(), 0, "x")?.is_empty());
            assert_eq!(call.array_optional::<3>(null(), "x")?, None);
            Ok(())
        }),
        PDN_OK
    );
    let infinite = "x[1]: expected a finite number, got inf";
    let (status, message) = failure(|call| call.array::<3>(bad.as_ptr(), "x").map(drop));
    assert_eq!((status, &*message), (PDN_ERR_NOT_FINITE, infinite));
    let (status, message) = failure(|call| call.numbers(bad.as_ptr(), 3, "x").map(drop));
    assert_eq!((status, &*message), (PDN_ERR_NOT_FINITE, infinite));
    let (status, _) = failure(|call| call.numbers(null(), 3, "x").map(drop));
    assert_eq!(status, PDN_ERR_NULL);
    let (status, _) = failure(|call| call.array::<3>(null(), "x").map(drop));
    assert_eq!(status, PDN_ERR_NULL);
    let huge = usize::MAX / 2;
    let (status, _) = failure(|call| call.numbers(good.as_ptr(), huge, "x").map(drop));
    assert_eq!(status, PDN_ERR_SIZE);
    let odd = good.as_ptr().cast::<u8>().wrapping_add(1).cast();
    let (status, message) = failure(|call| call.numbers(odd, 1, "x").map(drop));
    assert_eq!(status, PDN_ERR_VALUE);
    assert!(message.starts_with("x: expected a pointer aligned to 8 bytes"));
}

#[test]
fn outputs_have_the_length_they_must_have() {
    let mut place = [0.0; 3];
    let pointer = place.as_mut_ptr();
    let (status, message) = failure(|call| {
        call.out_slice(pointer, 2, 3, "torque")?.set(&[1.0; 3]);
        Ok(())
    });
    assert_eq!(status, PDN_ERR_SIZE);
    assert_eq!(message, "torque: expected length 3, got 2");
    assert_eq!(place, [0.0; 3]);
    let status = guard(|call| {
        call.out_slice(pointer, 3, 3, "torque")?.set(&[1.0; 3]);
        call.out_slice(null_mut::<f64>(), 0, 0, "none")?.set(&[]);
        assert!(call.out_optional(null_mut::<f64>(), "none")?.is_none());
        Ok(())
    });
    assert_eq!(status, PDN_OK);
    assert_eq!(place, [1.0; 3]);
}

#[test]
fn text_must_be_there_and_be_utf8() {
    let good = c"bar AB".as_ptr();
    let bad = c"bar \xff".as_ptr();
    assert_eq!(
        guard(|call| {
            assert_eq!(call.text(good, "name")?, "bar AB");
            Ok(())
        }),
        PDN_OK
    );
    let (status, message) = failure(|call| call.text(bad, "name").map(drop));
    assert_eq!(status, PDN_ERR_VALUE);
    assert_eq!(
        message,
        "name: expected text in UTF-8, got an invalid byte at position 4"
    );
    let (status, _) = failure(|call| call.text(null(), "name").map(drop));
    assert_eq!(status, PDN_ERR_NULL);
}

/// Options of a toy whose second release added `late`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
struct toy_options {
    struct_size: usize,
    early: f64,
    late: f64,
}

// SAFETY: numbers only, `struct_size` first, no padding.
unsafe impl Options for toy_options {
    const SIZES: &'static [usize] = &[16, 24];

    fn defaults() -> Self {
        toy_options {
            struct_size: size_of::<Self>(),
            early: 1.0,
            late: 2.0,
        }
    }
}

/// The memory of an options struct of `size` bytes, initialised, followed by a canary.
fn initialised(size: usize) -> [u64; 8] {
    let mut memory = [u64::MAX; 8];
    init(memory.as_mut_ptr().cast::<toy_options>(), size, "options");
    memory
}

fn read(memory: &[u64; 8]) -> Result<toy_options> {
    options::read(memory.as_ptr().cast::<toy_options>(), "options")
}

#[test]
fn options_of_an_old_program_leave_the_rest_alone() {
    let mut old = initialised(16);
    assert_eq!(old[..3], [16, 1.0_f64.to_bits(), u64::MAX]);
    old[1] = 5.0_f64.to_bits();
    let read = read(&old).unwrap();
    assert_eq!((read.early, read.late), (5.0, 2.0));
}

#[test]
fn options_of_a_new_program_pass_unless_they_ask_for_the_unknown() {
    let mut new = initialised(40);
    assert_eq!(new[3..6], [0, 0, u64::MAX]);
    assert_eq!(read(&new).unwrap().late, 2.0);
    new[4] = 1;
    assert_eq!(
        read(&new).unwrap_err().kind(),
        crate::error::ErrorKind::StructSize
    );
}

#[test]
fn options_that_were_not_initialised_are_refused() {
    for size in [0, 8, 17, 23, 4097, usize::MAX] {
        let mut memory = initialised(24);
        memory[0] = size as u64;
        let error: Error = read(&memory).unwrap_err();
        assert_eq!(error.kind().code(), PDN_ERR_STRUCT_SIZE, "{error}");
    }
    assert_eq!(
        options::read::<toy_options>(null(), "options").unwrap(),
        toy_options::defaults()
    );
    // Nothing sensible can be written here, and nothing is.
    init::<toy_options>(null_mut(), 24, "options");
    assert_eq!(initialised(7), [u64::MAX; 8]);
    assert_eq!(initialised(5000), [u64::MAX; 8]);
}

type scale_fn = unsafe extern "C" fn(x: f64, out: *mut f64, user_data: *mut c_void) -> i32;

unsafe extern "C" fn scale(x: f64, out: *mut f64, user_data: *mut c_void) -> i32 {
    if x < 0.0 {
        // SAFETY: text ended by NUL.
        unsafe { pdn_set_callback_error(c"no negative x".as_ptr()) };
        return -3;
    }
    // SAFETY: the test gives a place for the result and a factor.
    unsafe { *out = x * *user_data.cast::<f64>() };
    0
}

unsafe extern "C" fn reset(user_data: *mut c_void) {
    // SAFETY: the test gives a factor.
    unsafe { *user_data.cast::<f64>() = 0.0 };
}

#[test]
fn callbacks_report_failure_and_dispose_of_their_data() {
    let mut factor = 2.0_f64;
    let callback = Callback::<scale_fn>::new(scale, (&raw mut factor).cast(), Some(reset));
    let apply = |x| {
        let mut y = 0.0;
        callback.invoke("force", |function, user_data| {
            // SAFETY: `scale` wants a place and its factor.
            unsafe { function(x, &raw mut y, user_data) }
        })?;
        Ok::<f64, Error>(y)
    };
    assert_eq!(apply(4.0).unwrap(), 8.0);
    let (status, message) = failure(|_| apply(-1.0).map(drop));
    assert_eq!(status, PDN_ERR_CALLBACK);
    assert_eq!(message, "force: the callback returned -3: no negative x");
    assert_eq!(pdn_last_callback_code(), -3);
    drop(callback);
    assert_eq!(factor, 0.0);
    // SAFETY: NULL is refused.
    let status = unsafe { pdn_set_callback_error(null::<c_char>()) };
    assert_eq!(status, PDN_ERR_NULL);
    let missing: Option<scale_fn> = None;
    let (status, _) = failure(|call| call.function(missing, "force").map(drop));
    assert_eq!(status, PDN_ERR_NULL);
}

#[test]
fn libraries_on_top_set_messages_of_their_own() {
    let read = || {
        let mut buffer = [0_u8; 64];
        // SAFETY: the buffer is as long as that.
        let length = unsafe { pdn_last_error(buffer.as_mut_ptr().cast(), buffer.len()) };
        String::from_utf8_lossy(&buffer[..length.min(63)]).into_owned()
    };
    // SAFETY: a text ended by NUL; NULL is refused.
    let statuses = unsafe {
        let set = pdn_set_last_error(c"rank 1: no memory".as_ptr());
        assert_eq!(read(), "rank 1: no memory");
        [set, pdn_set_last_error(null::<c_char>())]
    };
    assert_eq!(statuses, [PDN_OK, PDN_ERR_NULL]);
    assert!(read().starts_with("message: "), "{}", read());
}
