//! Option structs that may grow: the first field tells how much of the struct the caller knows.
//!
//! ```ignore
//! /// Options of ::pdn_solve. Set the defaults by `PDN_INIT(pdn_solve_options, &options)`.
//! #[repr(C)]
//! #[derive(Clone, Copy)]
//! pub struct pdn_solve_options {
//!     /// Set by the initialiser.
//!     pub struct_size: usize,
//!     /// Number of grid points, odd.
//!     pub grid_points: usize,
//!     /// Largest number of Newton steps.
//!     pub max_iterations: i32,
//!     /// Leave it zero.
//!     pub reserved: i32,
//! }
//!
//! // SAFETY: all fields are plain numbers, `struct_size` is the first, and there is no padding.
//! unsafe impl Options for pdn_solve_options {
//!     const SIZES: &'static [usize] = &[24]; // a release that adds a field adds its size
//!     fn defaults() -> Self {
//!         let struct_size = size_of::<Self>();
//!         pdn_solve_options { struct_size, grid_points: 21, max_iterations: 20, reserved: 0 }
//!     }
//! }
//!
//! pub unsafe extern "C" fn pdn_solve_options_init(
//!     options: *mut pdn_solve_options,
//!     struct_size: usize,
//! ) {
//!     init(options, struct_size, "options");
//! }
//! ```

use super::pointer::check_pointer;
use crate::error::{Error, ErrorKind, Result};

/// A `#[repr(C)]` struct of options, see the module.
///
/// # Safety
///
/// `#[repr(C)]`, first field `struct_size: usize`, all others numbers or pointers for which any
/// bits are valid, no padding (fill holes with `reserved` fields).
pub(crate) unsafe trait Options: Copy {
    /// Size of the struct in each release that changed it, oldest first. Append only.
    const SIZES: &'static [usize];

    /// All zero, NULL or absent, but for `struct_size`.
    fn blank() -> Self {
        // SAFETY: any bits are valid, and `struct_size` is the first field.
        unsafe {
            let mut blank: Self = std::mem::zeroed();
            (&raw mut blank).cast::<usize>().write(size_of::<Self>());
            blank
        }
    }

    /// What NULL means, and what the initialiser writes.
    fn defaults() -> Self {
        Self::blank()
    }
}

/// No struct of options is larger; what claims to be is not initialised.
const LARGEST: usize = 4096;

/// Reads what the caller knows of the struct, and the defaults for the rest. NULL: all defaults.
pub(super) fn read<T: Options>(options: *const T, name: &str) -> Result<T> {
    const {
        assert!(T::SIZES[T::SIZES.len() - 1] == size_of::<T>());
        assert!(T::SIZES[0] >= size_of::<usize>() && size_of::<T>() <= LARGEST);
    }
    let mut result = T::defaults();
    if options.is_null() {
        return Ok(result);
    }
    check_pointer(options, 1, name)?;
    // SAFETY: the first field is there in every release.
    let given = unsafe { options.cast::<usize>().read() };
    let wrong = |expected: String| {
        let message = format!(
            "{name}: expected struct_size {expected}, got {given}; use the struct's initialiser"
        );
        Err(Error::new(ErrorKind::StructSize, message))
    };
    if given > LARGEST {
        return wrong(format!("of at most {LARGEST}"));
    }
    let Some(known) = T::SIZES.iter().copied().rfind(|&size| size <= given) else {
        return wrong(format!("of at least {}", T::SIZES[0]));
    };
    if known < given && known < size_of::<T>() {
        return wrong(format!("to be one of {:?}", T::SIZES));
    }
    // SAFETY: the caller vouches for `given` readable bytes, of which `known` are fields of T; any
    // bits are valid for them.
    unsafe {
        let bytes = options.cast::<u8>();
        std::ptr::copy_nonoverlapping(bytes, (&raw mut result).cast(), known);
        let tail = std::slice::from_raw_parts(bytes.add(known), given - known);
        if tail.iter().any(|&byte| byte != 0) {
            return Err(Error::new(
                ErrorKind::StructSize,
                format!("{name}: an option is set that this version of the library does not know"),
            ));
        }
    }
    Ok(result)
}

/// Reads an array of such structs, all of the size that the first one tells. NULL: none.
pub(super) fn read_all<T: Options>(array: *const T, count: usize, name: &str) -> Result<Vec<T>> {
    if count == 0 {
        return Ok(Vec::new());
    }
    check_pointer(array, count, name)?;
    let mut all = vec![read(array, name)?];
    // SAFETY: the first field is there in every release.
    let size = unsafe { array.cast::<usize>().read() };
    for i in 1..count {
        let name = format!("{name}[{i}]");
        // SAFETY: the caller vouches for `count` structs of `size` bytes, one after the other.
        let one = unsafe { array.cast::<u8>().add(i * size) }.cast::<T>();
        check_pointer(one, 1, &name)?;
        // SAFETY: as above.
        let given = unsafe { one.cast::<usize>().read() };
        if given != size {
            let message = format!("{name}: expected struct_size {size} as the first, got {given}");
            return Err(Error::new(ErrorKind::StructSize, message));
        }
        all.push(read(one, &name)?);
    }
    Ok(all)
}

/// Writes the defaults, as much as fits, and zero to fields unknown here.
pub(super) fn write_defaults<T: Options>(options: *mut T, size: usize, name: &str) -> Result<()> {
    check_pointer(options, 1, name)?;
    if !(size_of::<usize>()..=LARGEST).contains(&size) {
        let expected = format!("between {} and {LARGEST}", size_of::<usize>());
        return Err(Error::size("struct_size", expected, size));
    }
    let defaults = T::defaults();
    let known = size.min(size_of::<T>());
    let bytes = options.cast::<u8>();
    // SAFETY: the caller vouches for `size` writable bytes.
    unsafe {
        std::ptr::copy_nonoverlapping((&raw const defaults).cast(), bytes, known);
        bytes.add(known).write_bytes(0, size - known);
        options.cast::<usize>().write(size);
    }
    Ok(())
}

/// Where a struct of results goes: the caller told by its `struct_size` how much of it there is.
#[must_use = "an output that is not set leaves the caller with garbage"]
pub(super) struct OutStruct<'call, T> {
    pointer: *mut T,
    length: usize,
    call: std::marker::PhantomData<&'call mut T>,
}

/// Checks the `struct_size` of a struct of results, as [`read`] does.
pub(super) fn out_struct<'call, T: Options>(
    out: *mut T,
    name: &str,
) -> Result<OutStruct<'call, T>> {
    check_pointer(out, 1, name)?;
    // What `read` accepts may be written; fields unknown here stay as they are.
    let given = read(out.cast_const(), name)?;
    // SAFETY: as in `read`, the first field is there in every release.
    let length = unsafe { out.cast::<usize>().read() }.min(size_of_val(&given));
    Ok(OutStruct {
        pointer: out,
        length,
        call: std::marker::PhantomData,
    })
}

impl<T: Options> OutStruct<'_, T> {
    /// Writes the results, but for `struct_size`, which stays the caller's.
    pub(super) fn set(self, value: T) {
        let header = size_of::<usize>();
        // SAFETY: `out_struct` checked that the caller has `length` bytes, all of them fields of T.
        unsafe {
            let source = (&raw const value).cast::<u8>().add(header);
            let target = self.pointer.cast::<u8>().add(header);
            std::ptr::copy_nonoverlapping(source, target, self.length - header);
        }
    }
}
