//! Threads of a pool: they end with it, and stay awake for a while after each piece of work.

use rayon::{ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder, Yield};
use std::cell::Cell;
use std::ops::Deref;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

/// Threads that have ended when it is dropped: a program may unload the library then.
#[derive(Debug)]
pub(super) struct Pool {
    // Told to end first, then waited for: fields are dropped in this order.
    pub pool: ThreadPool,
    _threads: Threads,
}

impl Pool {
    /// A pool of so many threads; of as many as there are processors if that is zero.
    pub fn new(threads: usize) -> Result<Self, ThreadPoolBuildError> {
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
            pool,
            _threads: Threads(handles),
        })
    }

    /// Whether the calling thread is one of them.
    pub fn is_here(&self) -> bool {
        self.pool.current_thread_index().is_some()
    }
}

/// Threads that are waited for when this is dropped.
#[derive(Debug)]
struct Threads(Vec<JoinHandle<()>>);

impl Drop for Threads {
    fn drop(&mut self) {
        for thread in self.0.drain(..) {
            // Panics of work have been passed on to who asked for it.
            let _ = thread.join();
        }
    }
}

/// How long a thread looks for what comes next before it sleeps: some times what it takes to wake
/// it.
pub(super) const AWAKE: Duration = Duration::from_micros(300);

/// The same within work that others have much of their own to do in, such as a factorisation. A
/// thread may come to look in the midst of what others wait for, so that this has an end.
const WIDE_AWAKE: Duration = Duration::from_millis(3);

thread_local! {
    static STAYS_AWAKE: Cell<bool> = const { Cell::new(false) };
}

/// Has this thread of a pool look for more work for a while, after what it does now: most work
/// comes in pieces that take no longer than to wake a thread.
pub(super) fn stay_awake() {
    // Within such a look already, which goes on.
    if !STAYS_AWAKE.get() {
        rayon::spawn(|| {
            STAYS_AWAKE.set(true);
            look_for_work(AWAKE, || false);
            STAYS_AWAKE.set(false);
        });
    }
}

/// Does what work there is until something holds, or until there has been none for so long.
fn look_for_work(longest: Duration, ends: impl Fn() -> bool) {
    let mut since = Instant::now();
    while !ends() && since.elapsed() < longest {
        match rayon::yield_now() {
            Some(Yield::Executed) => since = Instant::now(),
            // Others in the machine may have something to do.
            _ => thread::yield_now(),
        }
    }
}

/// Tells, when it is dropped, that something has ended, in whatever way.
struct Ends<T: Deref<Target = AtomicBool>>(T);

impl<T: Deref<Target = AtomicBool>> Drop for Ends<T> {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Release);
    }
}

impl Pool {
    /// Does something on the calling thread, one of the pool, while the others stay awake.
    pub fn wide_awake<R>(&self, work: impl FnOnce() -> R) -> R {
        let ended = Arc::new(AtomicBool::new(false));
        let (here, seen) = (rayon::current_thread_index(), ended.clone());
        let _ends = Ends(ended);
        self.pool.spawn_broadcast(move |context| {
            if Some(context.index()) != here {
                look_for_work(WIDE_AWAKE, || seen.load(Ordering::Acquire));
            }
        });
        work()
    }
}

/// Does two things side by side, on threads of the pool that the calling one is of. This one looks
/// for other work while it waits, and does not fall asleep at once.
pub(crate) fn join<A, B: Send>(
    own: impl FnOnce() -> A,
    other: impl FnOnce() -> B + Send,
) -> (A, B) {
    let ended = AtomicBool::new(false);
    let mut second = None;
    let first = rayon::in_place_scope(|scope| {
        scope.spawn(|_| {
            let _ends = Ends(&ended);
            second = Some(other());
        });
        let first = own();
        look_for_work(AWAKE, || ended.load(Ordering::Acquire));
        first
    });
    match second {
        Some(second) => (first, second),
        // A panic has been passed on by the scope.
        None => unreachable!("work that has ended has a result"),
    }
}
