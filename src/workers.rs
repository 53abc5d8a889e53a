//! Threads that share work, from a pool of their own.
//!
//! Work is split into items that do not depend on each other, and each item is worked on in one
//! piece: results are the same, bit by bit, for any number of threads.

use crate::error::{Error, ErrorKind, Result};
use crate::work::Work;
use pool::{AWAKE, Pool, stay_awake};
use rayon::ThreadPool;
use rayon::iter::IndexedParallelIterator;
use std::fmt;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Condvar, Mutex};
use std::thread;
use std::time::{Duration, Instant};

mod pool;

pub(crate) use pool::join;

/// Keeps faer's convenient functions on the calling thread: by default they would start a thread
/// for each processor.
pub(crate) fn no_threads_unasked() {
    faer::set_global_parallelism(faer::Par::Seq);
}

/// Multiply-adds that take several times as long as threads take to meet.
const WORTH_SHARING: usize = 300_000;
/// Bytes that one thread takes some milliseconds to touch first.
const LARGE: usize = 1 << 23;
/// Parts that items are divided into, for each thread.
const SHARES: usize = 8;

/// Someone who is told now and then that work goes on, and may stop it.
pub trait Pulse: Send + Sync {
    /// Work goes on. Does nothing on other threads than the one that is to tell.
    fn beat(&self);
    /// Whether work is to end.
    fn is_stopped(&self) -> bool;
}

/// How often the thread that waits for others tells that they go on.
const WAIT: Duration = Duration::from_millis(50);

/// Threads beside the calling one that share its items, and as many as work in all, for dense
/// matrices.
#[derive(Debug)]
struct Pools {
    helpers: Pool,
    team: Pool,
}

impl Pools {
    /// That which the calling thread is one of.
    fn here(&self) -> Option<&Pool> {
        [&self.helpers, &self.team]
            .into_iter()
            .find(|pool| pool.is_here())
    }
}

/// One thread, or several, and who is told that they work.
#[derive(Clone, Default)]
pub struct Workers {
    pools: Option<Arc<Pools>>,
    pulse: Option<Arc<dyn Pulse>>,
    work: Arc<Work>,
}

impl fmt::Debug for Workers {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} threads", self.threads())
    }
}

/// Threads that work.
struct Running {
    left: AtomicUsize,
    lock: Mutex<()>,
    changed: Condvar,
}

/// Tells, when it is dropped, that a thread has ended its work, in whatever way.
struct End<'a>(&'a Running);

impl Drop for End<'_> {
    fn drop(&mut self) {
        let _guard = self.0.lock.lock();
        self.0.left.fetch_sub(1, Ordering::Release);
        self.0.changed.notify_one();
    }
}

impl Running {
    fn new(threads: usize) -> Self {
        Running {
            left: AtomicUsize::new(threads),
            lock: Mutex::new(()),
            changed: Condvar::new(),
        }
    }

    fn are_left(&self) -> bool {
        self.left.load(Ordering::Acquire) > 0
    }

    /// Waits for their ends, first without sleep, as that takes longer than most waits.
    fn have_ended(&self, longest: Duration) -> bool {
        let since = Instant::now();
        while since.elapsed() < AWAKE {
            if !self.are_left() {
                return true;
            }
            thread::yield_now();
        }
        match self.lock.lock() {
            Ok(guard) => {
                let waited =
                    (self.changed).wait_timeout_while(guard, longest, |()| self.are_left());
                waited.is_ok_and(|(_guard, _)| !self.are_left())
            }
            Err(_) => !self.are_left(),
        }
    }
}

impl Workers {
    /// So many threads; as many as there are processors if that is zero.
    ///
    /// # Errors
    /// If they cannot be started.
    pub fn new(threads: usize) -> Result<Self> {
        if threads == 1 {
            return Ok(Workers::default());
        }
        let pool = |threads: usize| {
            Pool::new(threads).map_err(|e| {
                let message = format!("options.threads: {threads} threads cannot be started: {e}");
                Error::new(ErrorKind::OutOfMemory, message)
            })
        };
        let team = pool(threads)?;
        let others = team.pool.current_num_threads() - 1;
        if others == 0 {
            return Ok(Workers::default());
        }
        let helpers = pool(others)?;
        Ok(Workers {
            pools: Some(Arc::new(Pools { helpers, team })),
            ..Workers::default()
        })
    }

    /// The same threads; this is told that they work.
    pub fn telling(self, pulse: Option<Arc<dyn Pulse>>) -> Self {
        Workers { pulse, ..self }
    }

    /// Tells that work goes on.
    ///
    /// # Errors
    /// If it is to end, as someone wishes or as it was bounded; passed on as those of callbacks.
    pub fn pulse(&self) -> Result<()> {
        #[cfg(test)]
        trip::beat();
        if self.work.is_spent() {
            return Err(Error::new(ErrorKind::Callback, "more work than is allowed"));
        }
        let Some(pulse) = &self.pulse else {
            return Ok(());
        };
        pulse.beat();
        match pulse.is_stopped() {
            true => Err(Error::new(ErrorKind::Callback, "cancelled")),
            false => Ok(()),
        }
    }

    /// Counts what they do.
    pub(crate) fn work(&self) -> &Work {
        &self.work
    }

    /// Whether someone wishes that work ends.
    pub fn is_stopped(&self) -> bool {
        self.pulse.as_ref().is_some_and(|pulse| pulse.is_stopped())
    }

    /// Tells that work goes on, if someone is to be told.
    fn beat(&self) {
        if let Some(pulse) = &self.pulse {
            pulse.beat();
        }
    }

    /// Does one thing on this thread and another on one of the pool, if there is one, and tells
    /// meanwhile that it works.
    pub fn both<A, B: Send>(
        &self,
        own: impl FnOnce() -> A,
        other: impl FnOnce() -> B + Send,
    ) -> (A, B) {
        match &self.pools {
            Some(pools) if pools.here().is_none() => self.both_in(&pools.helpers.pool, own, other),
            _ => (own(), other()),
        }
    }

    fn both_in<A, B: Send>(
        &self,
        pool: &ThreadPool,
        own: impl FnOnce() -> A,
        other: impl FnOnce() -> B + Send,
    ) -> (A, B) {
        let running = Running::new(1);
        let result = Mutex::new(None);
        let found = pool.in_place_scope(|scope| {
            scope.spawn(|_| {
                let _end = End(&running);
                let found = other();
                if let Ok(mut result) = result.lock() {
                    *result = Some(found);
                }
            });
            let found = own();
            self.wait_for(&running);
            found
        });
        // A panic of the other has been passed on by the scope.
        match result.into_inner() {
            Ok(Some(other)) => (found, other),
            _ => unreachable!("work that has ended has a result"),
        }
    }

    /// Does the same with each workspace: this thread begins with the first at once, others come
    /// with theirs.
    fn together<S: Send>(
        &self,
        pools: &Pools,
        workspaces: &mut [S],
        work: &(impl Fn(&mut S) + Sync),
    ) {
        let Some((own, others)) = workspaces.split_first_mut() else {
            return;
        };
        // Threads of a pool take what others of it have not begun meanwhile, others wait.
        let (pool, is_outside) = match pools.here() {
            Some(pool) => (pool, false),
            None => (&pools.helpers, true),
        };
        let running = Running::new(others.len());
        pool.pool.in_place_scope(|scope| {
            for other in others {
                scope.spawn(|_| {
                    if is_outside {
                        stay_awake();
                    }
                    let _end = End(&running);
                    work(other);
                });
            }
            work(own);
            if is_outside {
                self.wait_for(&running);
            }
        });
    }

    /// Waits for the others, and tells meanwhile that they work.
    fn wait_for(&self, running: &Running) {
        while !running.have_ended(WAIT) {
            self.beat();
        }
        // The pool notices an instant later, until which this thread would fall asleep.
        thread::yield_now();
    }

    /// Number of threads.
    pub fn threads(&self) -> usize {
        let team = self.pools.as_ref().map(|pools| &pools.team.pool);
        team.map_or(1, ThreadPool::current_num_threads)
    }

    /// These threads, if work of about so many multiply-adds is worth sharing among them, or one.
    pub fn for_work(&self, size: usize) -> Self {
        match size < WORTH_SHARING {
            true => self.alone(),
            false => self.clone(),
        }
    }

    /// The calling thread alone.
    pub fn alone(&self) -> Self {
        Workers {
            pools: None,
            pulse: self.pulse.clone(),
            work: self.work.clone(),
        }
    }

    /// Does something with faer, by these threads.
    pub fn dense<R: Send>(&self, work: impl FnOnce(faer::Par) -> R + Send) -> R {
        match &self.pools {
            Some(pools) if pools.here().is_some() => work(faer::Par::rayon(0)),
            Some(pools) => {
                let shared = || pools.team.wide_awake(|| work(faer::Par::rayon(0)));
                self.both_in(&pools.team.pool, || (), shared).1
            }
            None => work(faer::Par::Seq),
        }
    }

    /// A list of so many items, written by all threads if it is large: memory that is touched first
    /// takes time.
    pub fn list<T: Clone + Send + Sync>(&self, count: usize, item: T) -> Vec<T> {
        if count.saturating_mul(size_of::<T>()) < LARGE || self.threads() == 1 {
            return vec![item; count];
        }
        let mut list = Vec::with_capacity(count);
        self.dense(|_| rayon::iter::repeat_n(item, count).collect_into_vec(&mut list));
        list
    }

    /// Works on all items.
    pub fn each<T: Send>(&self, items: &mut [T], work: impl Fn(usize, &mut T) + Sync) {
        self.for_each(items, &mut Vec::new(), || (), |(), i, item| work(i, item));
    }

    /// Works on all items, with a workspace of its own for each thread.
    ///
    /// Threads take a few items at a time, in order: one that the system slows down takes fewer.
    pub fn for_each<T: Send, S: Send>(
        &self,
        items: &mut [T],
        workspaces: &mut Vec<S>,
        new_workspace: impl Fn() -> S,
        work: impl Fn(&mut S, usize, &mut T) + Sync,
    ) {
        let threads = self.threads().min(items.len()).max(1);
        while workspaces.len() < threads {
            workspaces.push(new_workspace());
        }
        match &self.pools {
            Some(pools) if threads > 1 => {
                let length = items.len().div_ceil(SHARES * threads);
                let left = Mutex::new(items.chunks_mut(length).enumerate());
                let next = || left.lock().ok().and_then(|mut left| left.next());
                self.together(pools, &mut workspaces[..threads], &|workspace| {
                    while let Some((part, items)) = next() {
                        for (i, item) in items.iter_mut().enumerate() {
                            work(workspace, part * length + i, item);
                        }
                        self.beat();
                    }
                });
            }
            _ => {
                for (i, item) in items.iter_mut().enumerate() {
                    work(&mut workspaces[0], i, item);
                    self.beat();
                }
            }
        }
    }

    /// The same for work that may fail: the error of the first item that does. Items after it may
    /// be left out, as may be those that follow where work is to end.
    pub fn try_for_each<T: Send, S: Send>(
        &self,
        items: &mut [T],
        workspaces: &mut Vec<S>,
        new_workspace: impl Fn() -> S,
        work: impl Fn(&mut S, usize, &mut T) -> Result<()> + Sync,
    ) -> Result<()> {
        let failure = Mutex::new(None::<(usize, Error)>);
        let first_failed = AtomicUsize::new(usize::MAX);
        self.for_each(items, workspaces, new_workspace, |workspace, i, item| {
            if i < first_failed.load(Ordering::Relaxed)
                && let Err(error) = self.pulse().and_then(|()| work(workspace, i, item))
                && let Ok(mut failure) = failure.lock()
                && failure.as_ref().is_none_or(|(first, _)| i < *first)
            {
                *failure = Some((i, error));
                first_failed.store(i, Ordering::Relaxed);
            }
        });
        match failure.into_inner() {
            Ok(Some((_, error))) => Err(error),
            _ => Ok(()),
        }
    }
}

/// Things that threads take and give back.
#[derive(Debug)]
pub(crate) struct Spare<T>(Mutex<Vec<T>>);

impl<T> Default for Spare<T> {
    fn default() -> Self {
        Spare(Mutex::new(Vec::new()))
    }
}

impl<T> Spare<T> {
    /// One that was given back, or a new one.
    pub fn take(&self, new: impl FnOnce() -> T) -> T {
        let spare = self.0.lock().ok().and_then(|mut all| all.pop());
        spare.unwrap_or_else(new)
    }

    /// Gives one back.
    pub fn give(&self, one: T) {
        if let Ok(mut all) = self.0.lock() {
            all.push(one);
        }
    }
}

/// Parts of `values` of so many each, one after the other.
pub(crate) fn parts<T>(
    values: &mut [T],
    counts: impl IntoIterator<Item = usize>,
) -> impl Iterator<Item = &mut [T]> {
    let mut rest = values;
    counts.into_iter().map(move |count| {
        let (part, next) = std::mem::take(&mut rest).split_at_mut(count);
        rest = next;
        part
    })
}

/// A defect on purpose, for tests: on their thread alone.
#[cfg(test)]
pub mod trip {
    use std::cell::Cell;

    thread_local! {
        static LEFT: Cell<Option<usize>> = const { Cell::new(None) };
    }

    /// Lets work trip over its pulse after so many; gives what was left of the last such wish.
    pub fn after(pulses: Option<usize>) -> Option<usize> {
        LEFT.replace(pulses)
    }

    pub(super) fn beat() {
        let left = LEFT.get();
        LEFT.set(left.and_then(|left| left.checked_sub(1)));
        assert!(left != Some(0), "tripped on purpose");
    }
}
