//! Processes that work on one problem together, each with a part of it, and what they tell each
//! other. The library sends nothing itself: whoever uses it gives the means, as MPI's.
//!
//! What is said here to be done by all ranks must be called by all of them, in the same order.

mod transposition;

pub use transposition::Transposition;

use crate::error::{Error, ErrorKind, Result};
use std::fmt::Debug;

/// Bytes of a message that ranks tell each other of why one of them failed.
const MESSAGE: usize = 400;

/// The ranks, and the means by which they tell each other numbers.
pub trait Ranks: Send + Sync + Debug {
    /// Number of this one, from 0.
    fn rank(&self) -> usize;

    /// How many there are.
    fn count(&self) -> usize;

    /// Sends to each rank so many numbers, one part of `send` after the other, and receives from
    /// each so many. By all ranks.
    ///
    /// # Errors
    /// If that cannot be done.
    fn exchange(
        &self,
        send: &[f64],
        send_counts: &[usize],
        receive: &mut [f64],
        receive_counts: &[usize],
    ) -> Result<()>;

    /// Sends `send` to all ranks, and receives from each so many numbers, one part after the other.
    /// By all ranks.
    ///
    /// # Errors
    /// If that cannot be done.
    fn gather(&self, send: &[f64], receive: &mut [f64], receive_counts: &[usize]) -> Result<()>;
}

/// One rank that has everything.
#[derive(Debug, Clone, Copy, Default)]
pub struct Alone;

impl Ranks for Alone {
    fn rank(&self) -> usize {
        0
    }

    fn count(&self) -> usize {
        1
    }

    fn exchange(&self, send: &[f64], _: &[usize], receive: &mut [f64], _: &[usize]) -> Result<()> {
        receive.copy_from_slice(send);
        Ok(())
    }

    fn gather(&self, send: &[f64], receive: &mut [f64], _: &[usize]) -> Result<()> {
        receive.copy_from_slice(send);
        Ok(())
    }
}

impl dyn Ranks + '_ {
    /// Numbers of all ranks, which have so many each, one after the other. By all ranks.
    ///
    /// # Errors
    /// If they cannot be told.
    pub fn gathered(&self, own: &[f64], counts: &[usize]) -> Result<Vec<f64>> {
        let mut all = vec![0.0; counts.iter().sum()];
        self.gather(own, &mut all, counts)?;
        Ok(all)
    }

    /// The same where the others do not know how many each has; with these numbers. By all ranks.
    ///
    /// # Errors
    /// If they cannot be told.
    pub fn gathered_any(&self, own: &[f64]) -> Result<(Vec<f64>, Vec<usize>)> {
        let counts = self.gathered(&[own.len() as f64], &vec![1; self.count()])?;
        let counts: Vec<usize> = counts.iter().map(|count| *count as usize).collect();
        Ok((self.gathered(own, &counts)?, counts))
    }

    /// The largest of each number that all ranks have; NaN if that of any is. By all ranks.
    ///
    /// # Errors
    /// If they cannot be told.
    pub fn largest<const N: usize>(&self, own: [f64; N]) -> Result<[f64; N]> {
        let all = self.gathered(&own, &vec![N; self.count()])?;
        let mut largest = own;
        for values in all.chunks_exact(N) {
            for (most, value) in largest.iter_mut().zip(values) {
                *most = match most.is_nan() || value.is_nan() {
                    true => f64::NAN,
                    false => most.max(*value),
                };
            }
        }
        Ok(largest)
    }

    /// Sums of the numbers that all ranks have, each rank's in the same order. By all ranks.
    ///
    /// # Errors
    /// If they cannot be told.
    pub fn sums<const N: usize>(&self, own: [f64; N]) -> Result<[f64; N]> {
        let all = self.gathered(&own, &vec![N; self.count()])?;
        let mut sums = [0.0; N];
        for values in all.chunks_exact(N) {
            sums.iter_mut().zip(values).for_each(|(sum, x)| *sum += x);
        }
        Ok(sums)
    }

    /// What this rank has found, if none has failed; otherwise the error of the first that has, the
    /// same on all. By all ranks, between what may fail and what is done by all of them.
    ///
    /// # Errors
    /// If it failed on any rank.
    pub fn agreed<T>(&self, found: Result<T>) -> Result<T> {
        if self.count() == 1 {
            return found;
        }
        let code = found
            .as_ref()
            .map_or_else(|e| f64::from(e.kind().code()), |_| 0.0);
        let codes = self.gathered(&[code], &vec![1; self.count()])?;
        let Some(first) = codes.iter().position(|code| *code != 0.0) else {
            return found;
        };
        let mut text = found
            .err()
            .map_or_else(String::new, |e| e.to_string())
            .into_bytes();
        text.resize(MESSAGE, 0);
        let text: Vec<f64> = text.into_iter().map(f64::from).collect();
        let all = self.gathered(&text, &vec![MESSAGE; self.count()])?;
        let said = all[MESSAGE * first..][..MESSAGE].iter();
        let said: Vec<u8> = said.map(|x| *x as u8).take_while(|x| *x != 0).collect();
        let code = codes[first] as i32;
        let kind = ErrorKind::ALL.into_iter().find(|kind| kind.code() == code);
        let message = String::from_utf8_lossy(&said);
        Err(Error::new(kind.unwrap_or(ErrorKind::Panic), message).within(format!("rank {first}")))
    }

    /// Checks that all ranks have the same `value`. By all ranks.
    ///
    /// # Errors
    /// On all of them if they have not; the message tells which rank has another one than the
    /// first, of `what`.
    pub fn require_same(&self, value: u64, what: &str) -> Result<()> {
        let halves = [(value >> 32) as f64, (value & 0xffff_ffff) as f64];
        let all = self.gathered(&halves, &vec![2; self.count()])?;
        let other = all.chunks_exact(2).position(|pair| pair != &all[..2]);
        other.map_or(Ok(()), |rank| {
            let got = format!("another one on rank {rank} than on rank 0");
            Err(Error::value(what, "the same on all ranks", got))
        })
    }
}

#[cfg(test)]
pub(crate) mod threads;
