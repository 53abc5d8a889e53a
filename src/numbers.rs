//! Long lists of numbers, in memory that is not touched before it is written to: so threads share
//! what that takes, and large pages, where the system has them, spare most of it.

use crate::error::Result;
use crate::memory;
use crate::pages::{PAGE, Pages};
use bytemuck::{Pod, cast_slice, cast_slice_mut};
use std::marker::PhantomData;
use std::ops::{Deref, DerefMut, Range};

/// Bytes from which on a list has pages of its own.
const LARGE: usize = PAGE / 3 * 2;
/// The last page is a large one where what is beside it is at most a half of the list.
const BESIDE: usize = 2;
/// Bytes of a vector of the processor, which lists begin at multiples of.
const VECTOR: usize = 64;

/// What is in a list at first. Nobody is to read it: it may be what others have left.
const NOTHING: f64 = if cfg!(debug_assertions) {
    f64::NAN
} else {
    0.0
};

/// A list of numbers, or of vectors or matrices of them.
#[derive(Debug)]
pub(crate) struct Numbers<T = f64> {
    memory: Memory,
    /// Where it is in that.
    place: Range<usize>,
    of: PhantomData<T>,
}

#[derive(Debug)]
enum Memory {
    Shared(Vec<f64>),
    Own(Pages),
}

impl<T> Numbers<T> {
    /// In so much memory, from this number on.
    fn within(memory: Memory, first: usize, bytes: usize) -> Self {
        Numbers {
            memory,
            place: first..first + bytes / size_of::<f64>(),
            of: PhantomData,
        }
    }
}

impl<T> Default for Numbers<T> {
    fn default() -> Self {
        Self::within(Memory::Shared(Vec::new()), 0, 0)
    }
}

impl<T: Pod> Numbers<T> {
    /// So many of them, for this; they are to be written.
    ///
    /// # Errors
    /// [`crate::error::ErrorKind::OutOfMemory`].
    pub fn room(what: &str, count: usize) -> Result<Self> {
        let bytes = count.saturating_mul(size_of::<T>());
        if bytes >= LARGE {
            let whole = bytes.checked_next_multiple_of(PAGE).unwrap_or(bytes);
            let taken = match BESIDE * (whole - bytes) <= bytes {
                true => whole,
                false => bytes,
            };
            let pages = Pages::take(taken).map_err(|_| memory::lacking(what, bytes))?;
            let mut numbers = Self::within(Memory::Own(pages), 0, bytes);
            if cfg!(debug_assertions) {
                cast_slice_mut::<T, f64>(&mut numbers).fill(NOTHING);
            }
            return Ok(numbers);
        }
        let (count, beside) = (bytes / size_of::<f64>(), VECTOR / size_of::<f64>());
        let mut values = memory::room(what, count + beside)?;
        values.resize(count + beside, NOTHING);
        let first = values.as_ptr().align_offset(VECTOR).min(beside);
        Ok(Self::within(Memory::Shared(values), first, bytes))
    }
}

impl<T: Pod> Deref for Numbers<T> {
    type Target = [T];

    fn deref(&self) -> &[T] {
        let end = self.place.end * size_of::<f64>();
        let all = match &self.memory {
            Memory::Shared(values) => values,
            Memory::Own(pages) => cast_slice(&pages[..end]),
        };
        cast_slice(&all[self.place.clone()])
    }
}

impl<T: Pod> DerefMut for Numbers<T> {
    fn deref_mut(&mut self) -> &mut [T] {
        let end = self.place.end * size_of::<f64>();
        let all = match &mut self.memory {
            Memory::Shared(values) => values,
            Memory::Own(pages) => cast_slice_mut(&mut pages[..end]),
        };
        cast_slice_mut(&mut all[self.place.clone()])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::ErrorKind;

    #[test]
    fn lists_keep_what_is_written() {
        for count in [0, 1, 1000, LARGE / 8 - 1, LARGE / 8, LARGE] {
            let mut numbers: Numbers = Numbers::room("a list", count).unwrap();
            assert_eq!(numbers.len(), count);
            assert_eq!(numbers.as_ptr().align_offset(VECTOR), 0, "{count}");
            let places = numbers.iter_mut().enumerate();
            places.for_each(|(i, x)| *x = i as f64);
            assert!(numbers.iter().enumerate().all(|(i, x)| *x == i as f64));
        }
    }

    #[test]
    fn what_no_machine_has_is_refused() {
        let error = Numbers::<f64>::room("a list", isize::MAX as usize / 8).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::OutOfMemory);
        assert!(error.to_string().starts_with("a list: "), "{error}");
    }
}
