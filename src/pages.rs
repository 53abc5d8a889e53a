//! Large pieces of memory, kept from the lists that are no more for those that come: to be given
//! pages by the system takes as long as a quarter of what is done with them, and longer in virtual
//! machines.

use memmap2::MmapMut;
use std::io;
use std::ops::{Deref, DerefMut};
use std::sync::{Mutex, PoisonError};

/// Bytes of a large page.
pub(crate) const PAGE: usize = 1 << 21;
/// Bytes that are kept at most, by all threads together.
const MOST_KEPT: usize = 1 << 29;
/// How many times as large as is asked for a kept piece may be.
const LARGER: usize = 2;

/// What is kept, the oldest first.
static KEPT: Kept = Kept(Mutex::new(Vec::new()));

/// Pages of one list. What is in them is to be written: it is zeros, or what others have left.
#[derive(Debug)]
pub(crate) struct Pages {
    /// Until they are dropped.
    memory: Option<MmapMut>,
    /// Where a large page begins.
    first: usize,
}

impl Pages {
    /// At least so many bytes, from where a large page begins.
    ///
    /// # Errors
    /// If the system has none.
    pub fn take(bytes: usize) -> io::Result<Self> {
        if let Some(pages) = KEPT.take(bytes) {
            return Ok(pages);
        }
        with_what_is_kept(|| Self::fresh(bytes))
    }

    fn fresh(bytes: usize) -> io::Result<Self> {
        let mut memory = MmapMut::map_anon(bytes)?;
        if first_page(&memory) != 0 {
            // Another place, with room for it to begin where a large page does.
            drop(memory);
            memory = MmapMut::map_anon(bytes.saturating_add(PAGE))?;
        }
        // Where there are none, small ones serve.
        #[cfg(target_os = "linux")]
        let _ = memory.advise_range(memmap2::Advice::HugePage, first_page(&memory), bytes);
        Ok(Self::of(memory))
    }

    fn of(memory: MmapMut) -> Self {
        Pages {
            first: first_page(&memory),
            memory: Some(memory),
        }
    }
}

/// Where the first large page begins.
fn first_page(memory: &MmapMut) -> usize {
    memory.as_ptr().align_offset(PAGE).min(PAGE)
}

impl Deref for Pages {
    type Target = [u8];

    fn deref(&self) -> &[u8] {
        let memory = self.memory.as_deref().unwrap_or_default();
        &memory[self.first..]
    }
}

impl DerefMut for Pages {
    fn deref_mut(&mut self) -> &mut [u8] {
        let memory = self.memory.as_deref_mut().unwrap_or_default();
        &mut memory[self.first..]
    }
}

impl Drop for Pages {
    fn drop(&mut self) {
        if let Some(memory) = self.memory.take() {
            KEPT.give(memory, MOST_KEPT);
        }
    }
}

/// Takes memory, if need be that which is kept for lists to come.
pub(crate) fn with_what_is_kept<T, E>(
    mut take: impl FnMut() -> std::result::Result<T, E>,
) -> std::result::Result<T, E> {
    take().or_else(|_| {
        let_go();
        take()
    })
}

/// Gives the system back what is kept.
pub(crate) fn let_go() {
    KEPT.give_back();
}

struct Kept(Mutex<Vec<MmapMut>>);

impl Kept {
    fn with<T>(&self, work: impl FnOnce(&mut Vec<MmapMut>) -> T) -> T {
        work(&mut self.0.lock().unwrap_or_else(PoisonError::into_inner))
    }

    /// The least that will do.
    fn take(&self, bytes: usize) -> Option<Pages> {
        let beyond = |memory: &MmapMut| {
            let room = memory.len().checked_sub(first_page(memory))?;
            let beyond = room.checked_sub(bytes)?;
            (room / LARGER <= bytes).then_some(beyond)
        };
        self.with(|kept| {
            let pieces = kept.iter().enumerate();
            let fitting = pieces.filter_map(|(at, memory)| Some((beyond(memory)?, at)));
            let (_, at) = fitting.min()?;
            Some(Pages::of(kept.remove(at)))
        })
    }

    /// Keeps it, and of the others the newest that come to no more than so many bytes with it.
    fn give(&self, memory: MmapMut, most: usize) {
        let old: Vec<_> = self.with(|kept| {
            kept.push(memory);
            let mut bytes = 0;
            let newest = kept.iter().rev().take_while(|memory| {
                bytes += memory.len();
                bytes <= most
            });
            let count = newest.count();
            kept.drain(..kept.len() - count).collect()
        });
        // Others may have theirs meanwhile.
        drop(old);
    }

    fn give_back(&self) {
        drop(self.with(std::mem::take));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn memory(bytes: usize) -> MmapMut {
        MmapMut::map_anon(bytes).unwrap()
    }

    fn lengths(kept: &Kept) -> Vec<usize> {
        kept.with(|kept| kept.iter().map(|memory| memory.len()).collect())
    }

    #[test]
    fn the_newest_are_kept_as_far_as_there_is_room() {
        let kept = Kept(Mutex::default());
        for pages in [4, 5, 3] {
            kept.give(memory(pages * PAGE), 9 * PAGE);
        }
        assert_eq!(lengths(&kept), [5 * PAGE, 3 * PAGE]);
        kept.give(memory(10 * PAGE), 9 * PAGE);
        assert!(lengths(&kept).is_empty());
    }

    #[test]
    fn a_list_gets_the_least_that_will_do_and_not_far_more_than_it_takes() {
        let kept = Kept(Mutex::default());
        // Each may begin anywhere, but for the first large page.
        for pages in [9, 6, 4] {
            kept.give(memory(pages * PAGE), 100 * PAGE);
        }
        assert!(kept.take(12 * PAGE).is_none());
        assert!(kept.take(PAGE).is_none());
        let pages = kept.take(3 * PAGE).unwrap();
        assert!(pages.len() >= 3 * PAGE && pages.len() <= 4 * PAGE);
        assert_eq!(pages.as_ptr().align_offset(PAGE), 0);
        assert_eq!(lengths(&kept), [9 * PAGE, 6 * PAGE]);
        kept.give_back();
        assert!(lengths(&kept).is_empty());
    }

    #[test]
    fn pages_are_written_and_given_back() {
        let mut pages = Pages::take(3 * PAGE).unwrap();
        assert!(pages.len() >= 3 * PAGE);
        pages[3 * PAGE - 1] = 1;
        drop(pages);
        let_go();
        assert!(Pages::take(isize::MAX as usize).is_err());
    }
}
