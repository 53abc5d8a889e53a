//! Full steps in spite of the line search, and the way back: the watchdog technique (Chamberlain,
//! Powell, Lemaréchal and Pedersen, Mathematical Programming Study 16, 1982). See docs/theory.md,
//! section 7.3.
//!
//! A measure of progress may grow although a step leads nearer, as where a beam that turns much
//! stretches by terms of second order. So a full step is taken that the line search refuses, while
//! increments after it show that it did: they have to shrink, or the solve returns to where such
//! steps began, for good.

/// Increments after forced steps are to be shorter than the first by this factor for each,
const CONTRACTION: f64 = 0.25;
/// but for this one: what held the first back may let go, as stress resultants do that were those
/// of stretching.
const GROWTH: f64 = 8.0;

/// Forced steps, one after the other; `P` is what is needed to return to where they began.
#[derive(Debug)]
pub(super) struct Watchdog<P> {
    allowed: bool,
    forced: Option<Forced<P>>,
}

#[derive(Debug)]
struct Forced<P> {
    start: P,
    /// The next increment is to be shorter than this.
    bound: f64,
}

impl<P> Watchdog<P> {
    /// One that may force steps, or may not.
    pub fn new(allowed: bool) -> Self {
        Watchdog {
            allowed,
            forced: None,
        }
    }

    /// Whether a step may be forced.
    pub fn allows(&self) -> bool {
        self.allowed
    }

    /// Judges forced steps by the size of the next increment, if there is one. Gives the point to
    /// return to where they have failed.
    pub fn judge(&mut self, increment: Option<f64>) -> Option<P> {
        let bound = self.forced.as_ref()?.bound;
        match increment {
            Some(size) if size > bound => self.give_up(),
            Some(_) => None,
            None => self.give_up(),
        }
    }

    /// Gives the point to return to, if steps were forced, and forces no more.
    pub fn give_up(&mut self) -> Option<P> {
        let forced = self.forced.take()?;
        self.allowed = false;
        Some(forced.start)
    }

    /// A step by an increment of this size is taken, forced or not, from the point that `start`
    /// gives.
    pub fn step(&mut self, forced: bool, increment: f64, start: impl FnOnce() -> P) {
        self.forced = forced.then(|| match self.forced.take() {
            Some(before) => Forced {
                bound: CONTRACTION * before.bound,
                ..before
            },
            None => Forced {
                start: start(),
                bound: GROWTH * increment,
            },
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn forced_steps_go_on_while_increments_shrink() {
        let mut watchdog = Watchdog::new(true);
        watchdog.step(true, 1.0, || "first");
        assert_eq!(watchdog.judge(Some(7.9)), None);
        watchdog.step(true, 7.9, || "second");
        assert_eq!(watchdog.judge(Some(1.9)), None);
        // One that the line search accepts ends them: later ones begin anew.
        watchdog.step(false, 1.9, || "third");
        assert_eq!(watchdog.judge(Some(100.0)), None);
        watchdog.step(true, 0.1, || "fourth");
        assert_eq!(watchdog.judge(Some(0.81)), Some("fourth"));
    }

    #[test]
    fn failure_leads_back_to_where_they_began_and_there_are_no_more() {
        let mut watchdog = Watchdog::new(true);
        watchdog.step(true, 1.0, || 1);
        watchdog.step(true, 4.0, || 2);
        assert_eq!(watchdog.judge(Some(2.1)), Some(1));
        assert!(!watchdog.allows());
        assert_eq!(watchdog.judge(Some(100.0)), None);

        let mut watchdog = Watchdog::new(true);
        watchdog.step(true, 1.0, || 1);
        assert_eq!(watchdog.judge(None), Some(1));

        let mut watchdog = Watchdog::new(true);
        assert_eq!((watchdog.give_up(), watchdog.allows()), (None, true));
        watchdog.step(true, 1.0, || 1);
        assert_eq!((watchdog.give_up(), watchdog.allows()), (Some(1), false));
    }
}
