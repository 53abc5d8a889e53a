//! Functions of the caller that the library calls, and how they report failure.

use super::guard::{guard, guard_or};
use super::last_error::keep;
use super::status::pdn_status;
use crate::error::{Error, ErrorKind, Result};
use libc::{c_char, c_void};
use std::cell::{Cell, RefCell};

thread_local! {
    static MESSAGE: RefCell<String> = const { RefCell::new(String::new()) };
    static CODE: Cell<i32> = const { Cell::new(0) };
}

/// Sets the message that ::pdn_last_error gives on this thread: for libraries on top of this one,
/// whose own functions fail.
///
/// @param message  text in UTF-8, ended by NUL, copied; not NULL
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_VALUE (no UTF-8)
///
/// Threads: any; each thread has its own message.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_set_last_error(message: *const c_char) -> pdn_status {
    guard(|call| {
        keep(call.text(message, "message")?);
        Ok(())
    })
}

/// To be called by a callback that is about to report failure: says why.
///
/// The text becomes a part of the message of the call that fails with PDN_ERR_CALLBACK.
///
/// @param message  text in UTF-8, ended by NUL, copied; not NULL
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_VALUE
///
/// Threads: any; holds for the callback running on the calling thread.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_set_callback_error(message: *const c_char) -> pdn_status {
    guard(|call| {
        let text = call.text(message, "message")?;
        MESSAGE.with(|message| text.clone_into(&mut message.borrow_mut()));
        Ok(())
    })
}

/// What the last failing callback on this thread returned.
///
/// @return the callback's own nonzero number; 0 if none has failed
///
/// Threads: any; each thread has its own number.
/// @since 0.1
#[unsafe(no_mangle)]
pub extern "C" fn pdn_last_callback_code() -> i32 {
    guard_or(0, |_| Ok(CODE.get()))
}

/// A function of the caller with its `user_data`, and how to dispose of that.
///
/// `F` is the type of the function pointer without `Option`; call it by
/// `callback.invoke("force", |f, user_data| unsafe { f(t, out, user_data) })`.
pub(crate) struct Callback<F> {
    /// The function.
    function: F,
    user_data: *mut c_void,
    destroy: Option<unsafe extern "C" fn(*mut c_void)>,
}

// SAFETY: the header tells on which threads a callback may be called, and that handles move between
// threads; the caller's `user_data` has to bear that.
unsafe impl<F: Send> Send for Callback<F> {}
// SAFETY: as above.
unsafe impl<F: Sync> Sync for Callback<F> {}

impl<F> Callback<F> {
    /// Takes over `user_data`: `destroy`, if given, is called once when it is no longer needed.
    pub(super) fn new(
        function: F,
        user_data: *mut c_void,
        destroy: Option<unsafe extern "C" fn(*mut c_void)>,
    ) -> Self {
        Callback {
            function,
            user_data,
            destroy,
        }
    }

    /// Makes a call through `invoke`, which gets function and `user_data`, and turns a nonzero
    /// answer into an error of callback `name`.
    pub(super) fn invoke(
        &self,
        name: &str,
        invoke: impl FnOnce(&F, *mut c_void) -> i32,
    ) -> Result<()> {
        MESSAGE.with(|message| message.borrow_mut().clear());
        match invoke(&self.function, self.user_data) {
            0 => Ok(()),
            code => Err(failure(name, code)),
        }
    }
}

impl<F> Drop for Callback<F> {
    fn drop(&mut self) {
        if let Some(destroy) = self.destroy {
            // SAFETY: the caller gave `destroy` for this `user_data`; it is called once.
            unsafe { destroy(self.user_data) }
        }
    }
}

fn failure(name: &str, code: i32) -> Error {
    CODE.set(code);
    let said = MESSAGE.with(RefCell::take);
    let separator = if said.is_empty() { "" } else { ": " };
    Error::new(
        ErrorKind::Callback,
        format!("{name}: the callback returned {code}{separator}{said}"),
    )
}
