//! Threads that share work, from a pool of their own.
//!
//! Work is split into items that do not depend on each other, and each item is worked on in one
//! piece: results are the same, bit by bit, for any number of threads.

use crate::error::{Error, ErrorKind, Result};
use crate::work::Work;
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::fmt;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Condvar, Mutex};
use std::thread::{self, JoinHandle};
use std::time::Duration;

/// Keeps faer's convenient functions on the calling thread: by default they would start a thread
/// for each processor.
pub(crate) fn no_threads_unasked() {
    faer::set_global_parallelism(faer::Par::Seq);
}

/// Threads that have ended when it is dropped: a program may unload the library then.
#[derive(Debug)]
struct Pool {
    /// Always there until the end.
    pool: Option<ThreadPool>,
    threads: Vec<JoinHandle<()>>,
}

impl Pool {
    fn new(threads: usize) -> std::result::Result<Self, rayon::ThreadPoolBuildError> {
        let mut handles = Vec::new();
        let pool = ThreadPoolBuilder::new()
            .num_threads(threads)
            .spawn_handler(|thread| {
                let name = format!("periodyn {}", thread.index());
                handles.push(thread::Builder::new().name(name).spawn(|| thread.run())?);
                Ok(())
            })
            .build()?;
        Ok(Pool {
            pool: Some(pool),
            threads: handles,
        })
    }
}

impl Drop for Pool {
    fn drop(&mut self) {
        self.pool = None;
        for thread in self.threads.drain(..) {
            // Panics of work have been passed on to who asked for it.
            let _ = thread.join();
        }
    }
}

/// Multiply-adds that take several times as long as threads take to meet.
const WORTH_SHARING: usize = 300_000;
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
/// Looks at whether others have ended before a thread sleeps: some ten microseconds.
const LOOKS: usize = 1000;

/// One thread, or several, and who is told that they work.
#[derive(Clone, Default)]
pub struct Workers {
    pool: Option<Arc<Pool>>,
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
        for _ in 0..LOOKS {
            if !self.are_left() {
                return true;
            }
            std::hint::spin_loop();
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

/// Whether the calling thread is one of the pool's.
fn is_in(pool: &ThreadPool) -> bool {
    pool.current_thread_index().is_some()
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
        let pool = Pool::new(threads).map_err(|e| {
            let message = format!("options.threads: {threads} threads cannot be started: {e}");
            Error::new(ErrorKind::OutOfMemory, message)
        })?;
        Ok(Workers {
            pool: Some(Arc::new(pool)),
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
        let Some(pool) = self.pool().filter(|pool| !is_in(pool)) else {
            return (own(), other());
        };
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

    /// Does the same with each workspace: this thread begins with the first at once, threads of the
    /// pool come with the others.
    fn together<S: Send>(
        &self,
        pool: &ThreadPool,
        workspaces: &mut [S],
        work: &(impl Fn(&mut S) + Sync),
    ) {
        let Some((own, others)) = workspaces.split_first_mut() else {
            return;
        };
        let running = Running::new(others.len());
        pool.in_place_scope(|scope| {
            for other in others {
                scope.spawn(|_| {
                    let _end = End(&running);
                    work(other);
                });
            }
            work(own);
            // Those of the pool take what others have not begun meanwhile.
            if !is_in(pool) {
                self.wait_for(&running);
            }
        });
    }

    /// Waits for the others, and tells meanwhile that they work.
    fn wait_for(&self, running: &Running) {
        while !running.have_ended(WAIT) {
            self.beat();
        }
    }

    fn pool(&self) -> Option<&ThreadPool> {
        self.pool.as_ref().and_then(|pool| pool.pool.as_ref())
    }

    /// Number of threads.
    pub fn threads(&self) -> usize {
        self.pool().map_or(1, ThreadPool::current_num_threads)
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
            pool: None,
            pulse: self.pulse.clone(),
            work: self.work.clone(),
        }
    }

    /// Does something with faer, by these threads.
    pub fn dense<R: Send>(&self, work: impl FnOnce(faer::Par) -> R + Send) -> R {
        match self.pool() {
            Some(_) => self.both(|| (), || work(faer::Par::rayon(0))).1,
            None => work(faer::Par::Seq),
        }
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
        match self.pool() {
            Some(pool) if threads > 1 => {
                let length = items.len().div_ceil(SHARES * threads);
                let left = Mutex::new(items.chunks_mut(length).enumerate());
                let next = || left.lock().ok().and_then(|mut left| left.next());
                self.together(pool, &mut workspaces[..threads], &|workspace| {
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
