//! Memory whose amount comes from the user is asked for before it is taken: where an allocation
//! fails, Rust ends the process.

use crate::error::{Error, ErrorKind, Result};
use crate::pages::with_what_is_kept;
use std::hint::black_box;

/// The error where so many bytes cannot be had.
pub(crate) fn lacking(what: &str, bytes: usize) -> Error {
    let message = format!("{what}: {bytes} bytes of memory cannot be had");
    Error::new(ErrorKind::OutOfMemory, message)
}

/// Checks that so many bytes are to be had just now, and takes none of them.
pub(crate) fn require(what: &str, bytes: usize) -> Result<()> {
    let had = with_what_is_kept(|| {
        let mut probe = Vec::<u8>::new();
        let had = probe.try_reserve_exact(bytes);
        // What is never looked at the compiler would not take, either.
        black_box(&probe);
        had
    });
    had.map_err(|_| lacking(what, bytes))
}

/// The same of `count` items of `size` bytes each.
pub(crate) fn require_items(what: &str, count: usize, size: usize) -> Result<()> {
    require(what, count.saturating_mul(size))
}

/// Makes room for `more` items, and as many as the list has grown by so far.
pub(crate) fn reserve<T>(what: &str, list: &mut Vec<T>, more: usize) -> Result<()> {
    let bytes = (list.len().saturating_add(more)).saturating_mul(size_of::<T>());
    let had = with_what_is_kept(|| list.try_reserve(more));
    had.map_err(|_| lacking(what, bytes))
}

/// A list of no items, with room for `count`.
pub(crate) fn room<T>(what: &str, count: usize) -> Result<Vec<T>> {
    let mut list = Vec::new();
    let had = with_what_is_kept(|| list.try_reserve_exact(count));
    had.map_err(|_| lacking(what, count.saturating_mul(size_of::<T>())))?;
    Ok(list)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_no_machine_has_is_refused_with_the_bytes_asked() {
        let most = isize::MAX as usize;
        let errors = [
            require("a grid", most).unwrap_err(),
            require_items("a grid", most / 8, 8).unwrap_err(),
            room::<u64>("a grid", most / 8).unwrap_err(),
            reserve("a grid", &mut vec![1u8], most - 1).unwrap_err(),
        ];
        for error in errors {
            assert_eq!(error.kind(), ErrorKind::OutOfMemory);
            let message = error.to_string();
            assert!(message.starts_with("a grid: "), "{message}");
            assert!(message.contains("922337203685477"), "{message}");
        }
        // More than can be counted.
        let uncounted = require_items("a grid", usize::MAX, 8).unwrap_err();
        assert_eq!(uncounted.kind(), ErrorKind::OutOfMemory);
        require("nothing", 0).unwrap();
        require("little", 1 << 20).unwrap();
        assert!(room::<u8>("three", 3).unwrap().capacity() >= 3);
    }
}
