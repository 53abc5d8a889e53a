//! Work that is counted, not timed: a bound on it does not depend on the machine, nor on threads.

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

/// What takes as long as so many multiply-adds, for each number that is stored at a node and grid
/// point: a product of the Jacobian with its preconditioner,
pub(crate) const PRODUCT: f64 = 1e3;
/// the evaluation of the equations,
pub(crate) const RESIDUAL: f64 = 1e3;
/// their linearisation,
pub(crate) const LINEARISATION: f64 = 2e3;
/// taking from a vector its part along another, for each entry: memory is slow.
pub(crate) const PROJECTION: f64 = 12.0;
/// A number of factors, or of the matrix itself, that a substitution or a residual reads takes as
/// long as so many: memory is slow.
pub(crate) const SUBSTITUTION: f64 = 4.0;
/// And a multiply-add of factors takes as long as so much of one: each number that is read is used
/// often.
pub(crate) const OF_FACTORS: f64 = 0.3;

/// Work that was done, in multiply-adds of dense matrices or what takes as long, and how much of it
/// may be. Without bound by default.
#[derive(Debug)]
pub(crate) struct Work {
    done: AtomicU64,
    most: AtomicU64,
    /// Whether the bound holds now.
    is_bounded: AtomicBool,
}

impl Default for Work {
    fn default() -> Self {
        Work {
            done: AtomicU64::new(0),
            most: AtomicU64::new(u64::MAX),
            is_bounded: AtomicBool::new(false),
        }
    }
}

impl Work {
    /// Counts what is done next.
    pub fn spend(&self, work: f64) {
        self.done.fetch_add(work as u64, Ordering::Relaxed);
    }

    /// Does not count what was done after so much.
    pub fn take_back(&self, done: f64) {
        self.done.store(done as u64, Ordering::Relaxed);
    }

    /// All that was counted.
    pub fn done(&self) -> f64 {
        self.done.load(Ordering::Relaxed) as f64
    }

    /// Most work that may be done.
    pub fn most(&self) -> f64 {
        self.most.load(Ordering::Relaxed) as f64
    }

    /// Work that is still allowed.
    pub fn left(&self) -> f64 {
        match self.is_bounded.load(Ordering::Relaxed) {
            true => (self.most() - self.done()).max(0.0),
            false => f64::INFINITY,
        }
    }

    /// Allows as much, unless it allows more.
    pub fn allow_more(&self, most: f64) {
        let before = self.most.load(Ordering::Relaxed);
        let most = (most as u64).max(if before < u64::MAX { before } else { 0 });
        self.most.store(most, Ordering::Relaxed);
    }

    /// Makes the bound hold, or not: what has been found is still to be judged. Gives whether it
    /// did before.
    pub fn bound(&self, holds: bool) -> bool {
        self.is_bounded.swap(holds, Ordering::Relaxed)
    }

    /// Whether work is to end.
    pub fn is_spent(&self) -> bool {
        self.is_bounded.load(Ordering::Relaxed)
            && self.done.load(Ordering::Relaxed) > self.most.load(Ordering::Relaxed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bound_ends_work_where_it_holds() {
        let work = Work::default();
        work.spend(1e15);
        assert!(work.left().is_infinite());
        assert!(!work.bound(true) && !work.is_spent());
        work.allow_more(2e15);
        work.allow_more(1e15);
        assert!(!work.is_spent() && work.left() == 1e15);
        work.spend(1.5e15);
        assert!(work.is_spent() && work.done() == 2.5e15 && work.most() == 2e15);
        assert_eq!(work.left(), 0.0);
        assert!(work.bound(false) && !work.is_spent());
    }
}
