//! Length of the steps of a way: in time, in loads, in inertial forces, or along a direction.

use std::ops::RangeInclusive;

/// The next length to try: shorter after a step that failed, longer after one that was easy.
#[derive(Debug, Clone)]
pub(crate) struct StepLength {
    length: f64,
    /// The shortest, below which the way is given up, and the longest.
    range: RangeInclusive<f64>,
    /// What a step that fails is shortened to, relative to itself.
    retreat: f64,
}

impl StepLength {
    /// Steps of `length` at first, which are halved where they fail.
    pub fn halved(length: f64, range: RangeInclusive<f64>) -> Self {
        Self::shortened(length, range, 0.5)
    }

    /// The same, with steps shortened to this part of those that fail.
    pub fn shortened(length: f64, range: RangeInclusive<f64>, retreat: f64) -> Self {
        StepLength {
            length,
            range,
            retreat,
        }
    }

    /// Length of the next step, which may be taken in part.
    pub fn get(&self) -> f64 {
        self.length
    }

    /// The next step is `factor` times as long as one that succeeded, `taken`.
    pub fn grow(&mut self, taken: f64, factor: f64) {
        self.length = (taken * factor).min(*self.range.end());
    }

    /// A step has failed, `taken`. `false` if the next would be too short.
    pub fn shrink(&mut self, taken: f64) -> bool {
        self.length = taken * self.retreat;
        self.length >= *self.range.start()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_stay_within_their_limits() {
        let mut step = StepLength::halved(1.0, 0.2..=3.0);
        step.grow(step.get(), 2.0);
        assert_eq!(step.get(), 2.0);
        step.grow(step.get(), 2.0);
        assert_eq!(step.get(), 3.0);
        // The last step to an end is shorter than what was to be taken.
        assert!(step.shrink(0.8) && step.get() == 0.4);
        assert!(step.shrink(0.4) && step.get() == 0.2);
        assert!(!step.shrink(0.2));
        assert!(!StepLength::shortened(1.0, 0.3..=f64::INFINITY, 0.25).shrink(1.0));
    }
}
