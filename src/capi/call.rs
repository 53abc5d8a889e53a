//! Reading what C gave, and writing what it gets. Every complaint names the argument.

use super::handle::{self, Exclusive, Handle};
use super::options::{self, Options, OutStruct};
use super::pointer::{check_pointer, null};
use crate::error::{Error, Result, require_finite};
use crate::model::Labels;
use libc::c_char;
use std::cell::RefCell;
use std::ffi::CStr;
use std::marker::PhantomData;
use std::sync::Arc;

/// One call from C. Nothing borrowed from the caller's memory outlives it.
///
/// Made by [`super::guard::guard`] alone. Its methods read pointers on the word of the C caller,
/// who owes what the header says: each pointer is NULL or valid for the length given with it.
pub(super) struct Call {
    /// Those of the model that the call is about, for its messages.
    labels: RefCell<Labels>,
}

impl Call {
    pub(super) fn new() -> Self {
        Call {
            labels: RefCell::default(),
        }
    }

    /// An error of the call, that names what has a label.
    pub(super) fn named(&self, error: Error) -> Error {
        let labels = self.labels.borrow();
        error.reworded(|message| labels.annotate(message))
    }

    /// The object of a handle, for reading. The `Arc` may be kept beyond the call.
    pub(super) fn shared<H: Handle>(&self, handle: *const H, name: &str) -> Result<Arc<H::Core>> {
        let core = handle::shared(handle, name)?;
        if let Some(labels) = H::labels(&core).filter(|labels| !labels.is_empty()) {
            self.labels.replace(labels.clone());
        }
        Ok(core)
    }

    /// The object of a handle, for changing it.
    pub(super) fn exclusive<H: Handle>(
        &self,
        handle: *mut H,
        name: &str,
    ) -> Result<Exclusive<'_, H::Core>>
    where
        H::Core: Clone,
    {
        handle::exclusive(handle, name)
    }

    /// A finite number.
    pub(super) fn number(&self, x: f64, name: &str) -> Result<f64> {
        require_finite(name, &[x])?;
        Ok(x)
    }

    /// Exactly `N` finite numbers.
    pub(super) fn array<const N: usize>(&self, x: *const f64, name: &str) -> Result<[f64; N]> {
        let x = *self.reference(x.cast::<[f64; N]>(), name)?;
        require_finite(name, &x)?;
        Ok(x)
    }

    /// As [`Call::array`], where NULL stands for "not given".
    pub(super) fn array_optional<const N: usize>(
        &self,
        x: *const f64,
        name: &str,
    ) -> Result<Option<[f64; N]>> {
        if x.is_null() {
            return Ok(None);
        }
        self.array(x, name).map(Some)
    }

    /// `length` finite numbers; NULL is allowed if there are none.
    pub(super) fn numbers(&self, x: *const f64, length: usize, name: &str) -> Result<&[f64]> {
        let x = self.slice(x, length, name)?;
        require_finite(name, x)?;
        Ok(x)
    }

    /// `length` items of any plain type; NULL is allowed if there are none.
    pub(super) fn slice<T: Copy>(&self, x: *const T, length: usize, name: &str) -> Result<&[T]> {
        if length == 0 {
            return Ok(&[]);
        }
        check_pointer(x, length, name)?;
        // SAFETY: not NULL, aligned, of possible size; the caller vouches for the items.
        Ok(unsafe { std::slice::from_raw_parts(x, length) })
    }

    /// A plain value behind a pointer.
    pub(super) fn reference<T: Copy>(&self, x: *const T, name: &str) -> Result<&T> {
        check_pointer(x, 1, name)?;
        // SAFETY: not NULL and aligned; the caller vouches for the value.
        Ok(unsafe { &*x })
    }

    /// Text ended by NUL, in UTF-8.
    pub(super) fn text(&self, text: *const c_char, name: &str) -> Result<&str> {
        if text.is_null() {
            return Err(null(name));
        }
        // SAFETY: not NULL; the caller vouches for the NUL at the end.
        let bytes = unsafe { CStr::from_ptr(text) };
        bytes.to_str().map_err(|error| {
            let got = format!("an invalid byte at position {}", error.valid_up_to());
            Error::value(name, "text in UTF-8", got)
        })
    }

    /// A callback that must be given, for the time of the call.
    pub(super) fn function<F>(&self, function: Option<F>, name: &str) -> Result<F> {
        function.ok_or_else(|| null(name))
    }

    /// Options; NULL stands for the defaults.
    pub(super) fn options<T: Options>(&self, options: *const T, name: &str) -> Result<T> {
        options::read(options, name)
    }

    /// An array of `count` structs that were each initialised; NULL is allowed if there are none.
    pub(super) fn structs<T: Options>(
        &self,
        array: *const T,
        count: usize,
        name: &str,
    ) -> Result<Vec<T>> {
        options::read_all(array, count, name)
    }

    /// Where a struct of results goes; it was initialised with its `struct_size`.
    pub(super) fn out_struct<T: Options>(
        &self,
        out: *mut T,
        name: &str,
    ) -> Result<OutStruct<'_, T>> {
        options::out_struct(out, name)
    }

    /// Where one value goes.
    pub(super) fn out<T>(&self, out: *mut T, name: &str) -> Result<Out<'_, T>> {
        check_pointer(out, 1, name)?;
        Ok(Out {
            pointer: out,
            call: PhantomData,
        })
    }

    /// As [`Call::out`], where NULL stands for "not wanted".
    pub(super) fn out_optional<T>(&self, out: *mut T, name: &str) -> Result<Option<Out<'_, T>>> {
        if out.is_null() {
            return Ok(None);
        }
        self.out(out, name).map(Some)
    }

    /// Where `length` items go; the caller's `length` must be `expected`.
    pub(super) fn out_slice<T: Copy>(
        &self,
        out: *mut T,
        length: usize,
        expected: usize,
        name: &str,
    ) -> Result<OutSlice<'_, T>> {
        if length != expected {
            return Err(Error::size(name, format!("length {expected}"), length));
        }
        if length > 0 {
            check_pointer(out, length, name)?;
        }
        Ok(OutSlice {
            pointer: out,
            length,
            call: PhantomData,
        })
    }

    /// As [`Call::out_slice`] for `length` items, where NULL stands for "not wanted".
    pub(super) fn out_slice_optional<T: Copy>(
        &self,
        out: *mut T,
        length: usize,
        name: &str,
    ) -> Result<Option<OutSlice<'_, T>>> {
        if out.is_null() {
            return Ok(None);
        }
        self.out_slice(out, length, length, name).map(Some)
    }
}

/// A place for one result, written at the end of a call that succeeds. May be uninitialised before.
#[must_use = "an output that is not set leaves the caller with garbage"]
pub(super) struct Out<'call, T> {
    pointer: *mut T,
    call: PhantomData<&'call mut T>,
}

impl<T> Out<'_, T> {
    /// Writes the result.
    pub(super) fn set(self, value: T) {
        // SAFETY: not NULL and aligned; the caller vouches for the memory. What was there is plain
        // data.
        unsafe { self.pointer.write(value) }
    }
}

impl<H: Handle> Out<'_, *mut H> {
    /// Makes a handle of `core` and gives it to the caller, who frees it.
    pub(super) fn give(self, core: H::Core) {
        self.set(handle::create(core));
    }
}

/// A place for several results.
#[must_use = "an output that is not set leaves the caller with garbage"]
pub(super) struct OutSlice<'call, T> {
    pointer: *mut T,
    length: usize,
    call: PhantomData<&'call mut T>,
}

impl<T: Copy> OutSlice<'_, T> {
    /// Writes the results.
    ///
    /// # Panics
    ///
    /// If there are not as many as the place is long.
    pub(super) fn set(self, values: &[T]) {
        assert_eq!(values.len(), self.length, "results and place for them");
        if self.length > 0 {
            // SAFETY: not NULL, aligned, as long as `values`, which may overlap (memmove).
            unsafe { std::ptr::copy(values.as_ptr(), self.pointer, self.length) }
        }
    }
}
