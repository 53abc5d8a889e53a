//! Who is told how a solve goes on, and may cancel it.

use crate::error::{Error, ErrorKind, Result};
use crate::solve::report::{Iteration, Outcome};
use crate::solve::start::Start;
use crate::workers::Pulse;
use std::fmt;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex};
use std::thread::{self, ThreadId};
use std::time::{Duration, Instant};

/// What the solver is doing, as told to the progress callback.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Stage {
    /// Finding the initial guess.
    InitialGuess,
    /// Newton iterations of the periodic problem.
    Newton,
    /// Marching in time, each step, which ends at this time.
    March {
        /// End of the step.
        time: f64,
    },
    /// Looking for modes about an equilibrium.
    Modes,
    /// Following disturbances of a periodic solution.
    Stability,
}

/// How far a solve is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Progress {
    /// What it is doing.
    pub stage: Stage,
    /// Whether an iteration, or a step of a march, has just ended; otherwise work goes on within
    /// one.
    pub iterated: bool,
    /// The last iteration; number 0 before the first.
    pub iteration: Iteration,
    /// Number of the attempt, from 1; 0 where the library does not choose the start.
    pub attempt: usize,
    /// What the attempt starts from.
    pub start: Option<Start>,
    /// Points of the grid that is worked on.
    pub points: usize,
    /// Time since the solve began.
    pub elapsed: Duration,
}

/// Time between two calls within an iteration.
const INTERVAL: Duration = Duration::from_millis(100);

type Callback = dyn FnMut(&Progress) -> bool + Send;

struct Watched {
    interval: Duration,
    callback: Mutex<Box<Callback>>,
}

/// Who is told how a solve goes on, on the thread that asked for it: after each iteration and,
/// while one lasts, a few times a second. Nobody by default.
#[derive(Clone, Default)]
pub struct Watch(Option<Arc<Watched>>);

impl fmt::Debug for Watch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(if self.0.is_some() { "Watch" } else { "None" })
    }
}

impl Watch {
    /// Calls `callback`, which returns `false` to cancel; within iterations whenever 0.1 s have
    /// passed since the last call.
    pub fn new(callback: impl FnMut(&Progress) -> bool + Send + 'static) -> Self {
        Watch(Some(Arc::new(Watched {
            interval: INTERVAL,
            callback: Mutex::new(Box::new(callback)),
        })))
    }

    /// The same, whenever `interval` seconds have passed; at any opportunity if that is zero.
    ///
    /// # Errors
    /// If that is no number of seconds.
    pub fn with_interval(
        interval: f64,
        callback: impl FnMut(&Progress) -> bool + Send + 'static,
    ) -> Result<Self> {
        let interval = Duration::try_from_secs_f64(interval).map_err(|_| {
            let expected = "zero or a positive number of seconds";
            Error::value("options.progress_interval", expected, interval)
        })?;
        Ok(Watch(Some(Arc::new(Watched {
            interval,
            callback: Mutex::new(Box::new(callback)),
        }))))
    }

    /// Begins to watch a solve, on the calling thread.
    pub(crate) fn begin(&self, stage: Stage, points: usize) -> Watching {
        Watching(self.0.as_ref().map(|watched| {
            Arc::new(Told {
                watched: watched.clone(),
                caller: thread::current().id(),
                began: Instant::now(),
                last: AtomicU64::new(0),
                stopped: AtomicBool::new(false),
                now: Mutex::new(Progress {
                    stage,
                    iterated: false,
                    iteration: Iteration::none(),
                    attempt: 0,
                    start: None,
                    points,
                    elapsed: Duration::ZERO,
                }),
            })
        }))
    }
}

/// A solve that is watched.
struct Told {
    watched: Arc<Watched>,
    caller: ThreadId,
    began: Instant,
    /// Time of the last call, in nanoseconds.
    last: AtomicU64,
    stopped: AtomicBool,
    now: Mutex<Progress>,
}

impl Told {
    /// Makes a call, unless one is being made or the solve is to end.
    fn call(&self, elapsed: Duration) {
        let Ok(mut now) = self.now.try_lock() else {
            return;
        };
        let Ok(mut callback) = self.watched.callback.try_lock() else {
            return;
        };
        if self.is_stopped() {
            return;
        }
        now.elapsed = elapsed;
        if !callback(&now) {
            self.stopped.store(true, Ordering::Relaxed);
        }
        let end = u64::try_from(self.began.elapsed().as_nanos());
        self.last.store(end.unwrap_or(u64::MAX), Ordering::Relaxed);
    }
}

impl Pulse for Told {
    fn beat(&self) {
        if thread::current().id() != self.caller || self.is_stopped() {
            return;
        }
        let elapsed = self.began.elapsed();
        let last = Duration::from_nanos(self.last.load(Ordering::Relaxed));
        if elapsed.saturating_sub(last) >= self.watched.interval {
            self.call(elapsed);
        }
    }

    fn is_stopped(&self) -> bool {
        self.stopped.load(Ordering::Relaxed)
    }
}

/// A solve that may be watched.
#[derive(Clone)]
pub(crate) struct Watching(Option<Arc<Told>>);

impl Watching {
    /// What is to be told of work that goes on.
    pub fn pulse(&self) -> Option<Arc<dyn Pulse>> {
        let told = self.0.as_ref()?;
        Some(told.clone())
    }

    fn change(&self, change: impl FnOnce(&mut Progress)) {
        if let Some(told) = &self.0
            && let Ok(mut now) = told.now.lock()
        {
            change(&mut now);
            now.iterated = false;
        }
    }

    /// Another attempt begins.
    pub fn attempt(&self, number: usize, start: Option<Start>) {
        self.change(|now| (now.attempt, now.start) = (number, start));
    }

    /// Another stage begins.
    pub fn stage(&self, stage: Stage) {
        self.change(|now| now.stage = stage);
    }

    /// Work goes on on another grid.
    pub fn grid(&self, points: usize) {
        self.change(|now| now.points = points);
    }

    /// An iteration has ended. `false` if the solve is to end.
    pub fn iteration(&self, stage: Stage, iteration: &Iteration) -> bool {
        let Some(told) = &self.0 else {
            return true;
        };
        if let Ok(mut now) = told.now.lock() {
            (now.stage, now.iteration, now.iterated) = (stage, *iteration, true);
        }
        told.call(told.began.elapsed());
        self.change(|_| ());
        !told.is_stopped()
    }

    /// Tells of iterations both here and to `observe`.
    pub fn with<'a>(
        &'a self,
        observe: &'a mut dyn FnMut(Stage, &Iteration) -> bool,
    ) -> impl FnMut(Stage, &Iteration) -> bool + 'a {
        move |stage, iteration| {
            let goes_on = self.iteration(stage, iteration);
            observe(stage, iteration) && goes_on
        }
    }

    /// Whether the solve is to end.
    pub fn is_stopped(&self) -> bool {
        self.0.as_ref().is_some_and(|told| told.is_stopped())
    }

    /// `outcome`, unless the solve has been cancelled since.
    pub fn outcome(&self, outcome: Outcome) -> Outcome {
        if self.is_stopped() {
            return Outcome::Cancelled;
        }
        outcome
    }

    /// A result, or none if there is no more to it than that the solve is to end.
    pub fn unless_cancelled<T>(&self, result: Result<T>) -> Result<Option<T>> {
        match result {
            Err(error) if self.cancels(&error) => Ok(None),
            result => result.map(Some),
        }
    }

    /// Whether `error` says no more than that the solve is to end.
    pub fn cancels(&self, error: &Error) -> bool {
        self.is_stopped() && error.kind() == ErrorKind::Callback
    }
}
