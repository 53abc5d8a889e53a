//! Long lists of numbers, in memory that is not touched before it is written to: so threads share
//! what that takes, and large pages, where the system has them, spare most of it.

use crate::error::Result;
use crate::memory;
use memmap2::MmapMut;
use std::ops::{Deref, DerefMut};

/// Bytes from which on a list has pages of its own.
const LARGE: usize = 1 << 21;
/// Bytes of a vector of the processor, which lists begin at multiples of.
const VECTOR: usize = 64;

/// A list of numbers, zeros at first.
#[derive(Debug, Default)]
pub(crate) struct Numbers {
    memory: Memory,
    first: usize,
    count: usize,
}

#[derive(Debug)]
enum Memory {
    Shared(Vec<f64>),
    Own(MmapMut),
}

impl Default for Memory {
    fn default() -> Self {
        Memory::Shared(Vec::new())
    }
}

impl Numbers {
    /// So many of them, for this.
    ///
    /// # Errors
    /// [`crate::error::ErrorKind::OutOfMemory`].
    pub fn zeros(what: &str, count: usize) -> Result<Self> {
        let bytes = count.saturating_mul(size_of::<f64>());
        if bytes >= LARGE {
            let pages = MmapMut::map_anon(bytes).map_err(|_| memory::lacking(what, bytes))?;
            // Where there are none, small ones serve.
            #[cfg(target_os = "linux")]
            let _ = pages.advise(memmap2::Advice::HugePage);
            return Ok(Numbers {
                memory: Memory::Own(pages),
                first: 0,
                count,
            });
        }
        let beside = VECTOR / size_of::<f64>();
        let mut values = memory::room(what, count + beside)?;
        values.resize(count + beside, 0.0);
        let first = values.as_ptr().align_offset(VECTOR).min(beside);
        Ok(Numbers {
            memory: Memory::Shared(values),
            first,
            count,
        })
    }
}

impl Deref for Numbers {
    type Target = [f64];

    fn deref(&self) -> &[f64] {
        match &self.memory {
            Memory::Shared(values) => &values[self.first..][..self.count],
            Memory::Own(pages) => bytemuck::cast_slice(pages),
        }
    }
}

impl DerefMut for Numbers {
    fn deref_mut(&mut self) -> &mut [f64] {
        match &mut self.memory {
            Memory::Shared(values) => &mut values[self.first..][..self.count],
            Memory::Own(pages) => bytemuck::cast_slice_mut(pages),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::ErrorKind;

    #[test]
    fn lists_begin_with_zeros_and_keep_what_is_written() {
        for count in [0, 1, 1000, LARGE / 8 - 1, LARGE / 8, LARGE] {
            let mut numbers = Numbers::zeros("a list", count).unwrap();
            assert_eq!(numbers.len(), count);
            assert_eq!(numbers.as_ptr().align_offset(VECTOR), 0, "{count}");
            assert!(numbers.iter().all(|x| *x == 0.0));
            let places = numbers.iter_mut().enumerate();
            places.for_each(|(i, x)| *x = i as f64);
            assert!(numbers.iter().enumerate().all(|(i, x)| *x == i as f64));
        }
    }

    #[test]
    fn what_no_machine_has_is_refused() {
        let error = Numbers::zeros("a list", isize::MAX as usize / 8).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::OutOfMemory);
        assert!(error.to_string().starts_with("a list: "), "{error}");
    }
}
