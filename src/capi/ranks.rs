//! Ranks that tell each other numbers by functions of the caller.

use super::callback::Callback;
use crate::error::{Error, ErrorKind, Result};
use crate::ranks::Ranks;
use libc::c_void;
use std::fmt;

type Exchange =
    unsafe extern "C" fn(*const f64, *const usize, *mut f64, *const usize, *mut c_void) -> i32;

type Gather = unsafe extern "C" fn(*const f64, usize, *mut f64, *const usize, *mut c_void) -> i32;

/// Ranks of the caller.
pub(super) struct CallerRanks {
    rank: usize,
    count: usize,
    functions: Callback<(Exchange, Gather)>,
}

impl fmt::Debug for CallerRanks {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "rank {} of {}", self.rank, self.count)
    }
}

impl CallerRanks {
    /// This rank of so many, and the functions by which they tell each other numbers.
    pub(super) fn new(
        (rank, count): (usize, usize),
        functions: (Exchange, Gather),
        user_data: *mut c_void,
    ) -> Self {
        CallerRanks {
            rank,
            count,
            functions: Callback::new(functions, user_data, None),
        }
    }
}

fn require_counts(counts: &[usize], count: usize, length: usize) -> Result<()> {
    if counts.len() == count && counts.iter().sum::<usize>() == length {
        return Ok(());
    }
    Err(Error::new(
        ErrorKind::Panic,
        "internal error: counts of ranks do not fit",
    ))
}

impl Ranks for CallerRanks {
    fn rank(&self) -> usize {
        self.rank
    }

    fn count(&self) -> usize {
        self.count
    }

    fn exchange(
        &self,
        send: &[f64],
        send_counts: &[usize],
        receive: &mut [f64],
        receive_counts: &[usize],
    ) -> Result<()> {
        require_counts(send_counts, self.count, send.len())?;
        require_counts(receive_counts, self.count, receive.len())?;
        self.functions
            .invoke("exchange", |(exchange, _), user_data| {
                let (send, to) = (send.as_ptr(), send_counts.as_ptr());
                let (receive, from) = (receive.as_mut_ptr(), receive_counts.as_ptr());
                // SAFETY: the caller gave the function for this data; arrays are as long as their
                // counts say, and outlive the call.
                unsafe { exchange(send, to, receive, from, user_data) }
            })
    }

    fn gather(&self, send: &[f64], receive: &mut [f64], receive_counts: &[usize]) -> Result<()> {
        require_counts(receive_counts, self.count, receive.len())?;
        self.functions.invoke("gather", |(_, gather), user_data| {
            let (from, counts) = (send.as_ptr(), receive_counts.as_ptr());
            // SAFETY: as above.
            unsafe { gather(from, send.len(), receive.as_mut_ptr(), counts, user_data) }
        })
    }
}
