//! Threads that share work, from a pool of their own.
//!
//! Work is split into items that do not depend on each other, and each item is worked on in one piece: results are
//! the same, bit by bit, for any number of threads.

use crate::error::{Error, ErrorKind, Result};
use rayon::iter::{IntoParallelRefMutIterator, ParallelIterator};
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};
use std::thread::{self, JoinHandle};

/// Keeps faer's convenient functions on the calling thread: by default they would start a thread for each processor.
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

/// One thread, or several.
#[derive(Debug, Clone, Default)]
pub struct Workers {
    pool: Option<Arc<Pool>>,
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
        })
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
            true => Workers::default(),
            false => self.clone(),
        }
    }

    /// Does something with faer, by these threads.
    pub fn dense<R: Send>(&self, work: impl FnOnce(faer::Par) -> R + Send) -> R {
        match self.pool() {
            Some(pool) => pool.install(|| work(faer::Par::rayon(0))),
            None => work(faer::Par::Seq),
        }
    }

    /// Works on all items, with room of its own for each thread.
    ///
    /// Threads take a few items at a time, in order: one that the system slows down takes fewer.
    pub fn for_each<T: Send, S: Send>(
        &self,
        items: &mut [T],
        rooms: &mut Vec<S>,
        new_room: impl Fn() -> S,
        work: impl Fn(&mut S, usize, &mut T) + Sync,
    ) {
        let threads = self.threads().min(items.len()).max(1);
        while rooms.len() < threads {
            rooms.push(new_room());
        }
        match self.pool() {
            Some(pool) if threads > 1 => {
                let length = items.len().div_ceil(SHARES * threads);
                let left = Mutex::new(items.chunks_mut(length).enumerate());
                let next = || left.lock().ok().and_then(|mut left| left.next());
                pool.install(|| {
                    rooms[..threads].par_iter_mut().for_each(|room| {
                        while let Some((part, items)) = next() {
                            for (i, item) in items.iter_mut().enumerate() {
                                work(room, part * length + i, item);
                            }
                        }
                    });
                });
            }
            _ => {
                for (i, item) in items.iter_mut().enumerate() {
                    work(&mut rooms[0], i, item);
                }
            }
        }
    }

    /// The same for work that may fail: the error of the first item that does. Items after it may be left out.
    pub fn try_for_each<T: Send, S: Send>(
        &self,
        items: &mut [T],
        rooms: &mut Vec<S>,
        new_room: impl Fn() -> S,
        work: impl Fn(&mut S, usize, &mut T) -> Result<()> + Sync,
    ) -> Result<()> {
        let failure = Mutex::new(None::<(usize, Error)>);
        let first_failed = AtomicUsize::new(usize::MAX);
        self.for_each(items, rooms, new_room, |room, i, item| {
            if i < first_failed.load(Ordering::Relaxed)
                && let Err(error) = work(room, i, item)
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
