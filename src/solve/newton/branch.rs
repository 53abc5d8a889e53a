//! Keeping to one branch of equilibria.
//!
//! Where branches cross, or nearly do as in a mechanism near a change-point, the Jacobian is nearly
//! singular. A step over that place may end on the other branch. The determinant tells: it keeps
//! its sign along a branch that does not cross, and falls where another one comes near. See
//! docs/theory.md, section 9.2.

/// A step should not take more from the determinant than this factor, nor add more than its
/// inverse.
const FALL: f64 = 0.5;
/// A step that takes more is rejected.
const LARGEST_FALL: f64 = 0.25;

/// The determinant along a path in time, forwards or backwards.
#[derive(Debug, Default)]
pub(crate) struct Branch {
    /// Sign and logarithm of the size at the last state.
    last: Option<(f64, f64)>,
    /// Relative change per time.
    slope: f64,
    /// Longest step that the last one allows.
    twice_last_step: Option<f64>,
}

impl Branch {
    /// Whether a state with this determinant may continue the branch.
    pub fn continues(&self, (sign, logarithm): (f64, f64)) -> bool {
        self.last.is_none_or(|(last_sign, last)| {
            sign == last_sign && logarithm - last > LARGEST_FALL.ln()
        })
    }

    /// Takes a state as the next one, after a step of so much time.
    pub fn advance(&mut self, step: f64, (sign, logarithm): (f64, f64)) {
        if let Some((last_sign, last)) = self.last {
            self.slope = (1.0 - sign * last_sign * (last - logarithm).exp()) / step;
            self.twice_last_step = Some(2.0 * step);
        }
        self.last = Some((sign, logarithm));
    }

    /// Time until the determinant will have fallen, or grown, as far as it should in a step.
    pub fn longest_step(&self) -> f64 {
        let step = if self.slope < 0.0 {
            (FALL - 1.0) / self.slope
        } else {
            (1.0 / FALL - 1.0) / self.slope
        };
        // Where it turns its slope says nothing.
        step.min(self.twice_last_step.unwrap_or(f64::INFINITY))
    }
}

#[cfg(test)]
mod tests {
    use super::Branch;

    #[test]
    fn steps_shrink_towards_a_crossing_and_a_change_of_sign_is_none_of_the_branch() {
        let mut branch = Branch::default();
        let at = |time: f64| (f64::signum(1.0 - time), f64::abs(1.0 - time).ln());
        assert!(branch.continues(at(0.0)));
        branch.advance(0.1, at(0.0));
        assert_eq!(branch.longest_step(), f64::INFINITY);
        branch.advance(0.5, at(0.5));
        // A straight line that reaches zero at 1 has fallen to a half at 0.75.
        assert!((branch.longest_step() - 0.25).abs() < 1e-12);
        assert!(
            branch.continues(at(0.75)) && !branch.continues(at(0.9)) && !branch.continues(at(1.5))
        );
    }

    #[test]
    fn a_step_is_at_most_twice_the_last() {
        let mut branch = Branch::default();
        for step in [1.0, 0.1, 0.3] {
            branch.advance(step, (1.0, 0.0));
        }
        // It does not change: its slope allows any.
        assert!((branch.longest_step() - 0.6).abs() < 1e-15);
    }
}
