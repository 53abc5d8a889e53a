//! Handles: what C holds of an object of the core.
//!
//! C sees an opaque type, and behind the pointer lies a private shell around an `Arc` of the core's
//! object:
//!
//! ```ignore
//! /// A mechanism. Made by ::pdn_model_new, freed by ::pdn_model_free.
//! pub struct pdn_model {
//!     _private: [u8; 0],
//! }
//!
//! impl Handle for pdn_model {
//!     type Core = crate::model::Model;
//! }
//!
//! pub unsafe extern "C" fn pdn_model_new(out: *mut *mut pdn_model) -> pdn_status {
//!     guard(|call| {
//!         let out = call.out(out, "out")?;
//!         out.give(Model::new());
//!         Ok(())
//!     })
//! }
//!
//! pub unsafe extern "C" fn pdn_model_free(model: *mut pdn_model) {
//!     free(model);
//! }
//! ```
//!
//! Do not put `#[repr(C)]` on it, or cbindgen shows its inside.
//!
//! The `Arc` makes lifetimes simple: a child (a solution) keeps the `Arc` of its parent (the
//! model) as it was; changing the parent later copies it first if a child still looks at it.

use super::pointer::null;
use crate::error::{Error, ErrorKind, Result};
use crate::model::Labels;
use std::cell::UnsafeCell;
use std::marker::PhantomData;
use std::ops::{Deref, DerefMut};
use std::sync::Arc;
use std::sync::atomic::{AtomicU8, Ordering};

/// An opaque C type, and the object of the core it stands for.
pub(crate) trait Handle {
    /// `Send + Sync` is the library's threading contract, checked here for every handle.
    type Core: Send + Sync + 'static;

    /// What the user calls parts of the model that it is, or is of.
    fn labels(_: &Self::Core) -> Option<&Labels> {
        None
    }
}

const FREE: u8 = 0;
const BUSY: u8 = 1;
const POISONED: u8 = 2;

/// What really lies behind a pointer to a [`Handle`].
struct Shell<C> {
    state: AtomicU8,
    core: UnsafeCell<Arc<C>>,
}

/// A new handle, owned by C until it calls [`super::guard::free`].
pub(super) fn create<H: Handle>(core: H::Core) -> *mut H {
    let shell = Shell {
        state: AtomicU8::new(FREE),
        core: UnsafeCell::new(Arc::new(core)),
    };
    Box::into_raw(Box::new(shell)).cast()
}

/// Frees a handle; NULL does nothing. Objects made from it stay valid.
pub(super) fn destroy<H: Handle>(handle: *mut H) {
    if !handle.is_null() {
        // SAFETY: a pointer that is not NULL came from `create` and is freed once.
        drop(unsafe { Box::from_raw(handle.cast::<Shell<H::Core>>()) });
    }
}

/// The object of a handle, for a `const` function or for a child to keep.
pub(super) fn shared<H: Handle>(handle: *const H, name: &str) -> Result<Arc<H::Core>> {
    let shell = shell(handle, name)?;
    match shell.state.load(Ordering::Acquire) {
        // SAFETY: nobody changes the core; the caller promises that nobody starts to meanwhile.
        FREE => Ok(Arc::clone(unsafe { &*shell.core.get() })),
        state => Err(unusable(state, name)),
    }
}

/// The object of a handle, to be changed. If the change panics, the handle is poisoned.
pub(super) fn exclusive<'call, H: Handle>(
    handle: *mut H,
    name: &str,
) -> Result<Exclusive<'call, H::Core>>
where
    H::Core: Clone,
{
    let shell = shell::<H>(handle, name)?;
    shell
        .state
        .compare_exchange(FREE, BUSY, Ordering::AcqRel, Ordering::Acquire)
        .map_err(|state| unusable(state, name))?;
    Ok(Exclusive {
        shell,
        call: PhantomData,
    })
}

fn shell<'call, H: Handle>(handle: *const H, name: &str) -> Result<&'call Shell<H::Core>> {
    // SAFETY: a pointer that is not NULL came from `create` and is not freed during the call.
    unsafe { handle.cast::<Shell<H::Core>>().as_ref() }.ok_or_else(|| null(name))
}

fn unusable(state: u8, name: &str) -> Error {
    if state == POISONED {
        let message = format!("{name}: an internal error left it in an unknown state; free it");
        return Error::new(ErrorKind::Poisoned, message);
    }
    Error::value(
        name,
        "a handle that no other call is changing",
        "one in use, by a call around this callback or by another thread",
    )
}

/// Sole access to the object of a handle for the time of a call.
pub(crate) struct Exclusive<'call, C> {
    shell: &'call Shell<C>,
    call: PhantomData<&'call mut C>,
}

impl<C> Deref for Exclusive<'_, C> {
    type Target = C;

    fn deref(&self) -> &C {
        // SAFETY: BUSY keeps all others out.
        unsafe { &*self.shell.core.get() }
    }
}

impl<C: Clone> DerefMut for Exclusive<'_, C> {
    fn deref_mut(&mut self) -> &mut C {
        // SAFETY: BUSY keeps all others out. A child that shares the object keeps its own copy.
        Arc::make_mut(unsafe { &mut *self.shell.core.get() })
    }
}

impl<C> Drop for Exclusive<'_, C> {
    fn drop(&mut self) {
        let state = if std::thread::panicking() {
            POISONED
        } else {
            FREE
        };
        self.shell.state.store(state, Ordering::Release);
    }
}
