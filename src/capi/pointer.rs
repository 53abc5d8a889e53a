//! What can be told of a pointer from C.

use crate::error::{Error, ErrorKind, Result};

/// Argument `name` is NULL and must not be.
pub(super) fn null(name: &str) -> Error {
    Error::new(
        ErrorKind::Null,
        format!("{name}: expected a pointer, got NULL"),
    )
}

/// What can be checked of a pointer to `length` items.
pub(super) fn check_pointer<T>(pointer: *const T, length: usize, name: &str) -> Result<()> {
    if pointer.is_null() {
        return Err(null(name));
    }
    if !pointer.is_aligned() {
        let expected = format!("a pointer aligned to {} bytes", align_of::<T>());
        return Err(Error::value(name, expected, format!("{pointer:p}")));
    }
    let limit = isize::MAX as usize / size_of::<T>().max(1);
    if length > limit {
        return Err(Error::size(name, format!("at most {limit}"), length));
    }
    Ok(())
}
