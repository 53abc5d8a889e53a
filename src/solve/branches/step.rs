//! Lengths of steps along a branch (docs/theory.md, section 13.4).

use super::BranchOptions;

/// Error of the predicted point, relative to the step, that steps aim at.
const PREDICTION: f64 = 0.05;
/// Least and largest factor from one step to the next.
const CHANGE: [f64; 2] = [0.4, 2.0];
/// A step by so many times the angle that is aimed at is taken again.
const TOO_FAR: f64 = 4.0 / 3.0;

/// What a step has shown.
#[derive(Debug, Clone, Copy)]
pub(super) struct Shown {
    /// Angle between the tangents at its ends.
    pub angle: f64,
    /// Distance of the point from the predicted one, over the length of the step.
    pub prediction: f64,
}

impl Shown {
    /// Whether the step is to be taken again, shorter.
    pub fn is_too_far(&self, options: &BranchOptions) -> bool {
        // Written so that NaN is, too.
        let is_near = self.angle <= TOO_FAR * options.angle;
        !is_near
    }

    /// Length of the next step.
    pub fn next(&self, step: f64, options: &BranchOptions) -> f64 {
        let by_angle = options.angle / self.angle;
        let by_prediction = (PREDICTION / self.prediction).sqrt();
        let [least, most] = CHANGE;
        let factor = by_angle.min(by_prediction).clamp(least, most);
        (step * factor).min(options.largest_step)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_follow_the_angle_and_the_error_of_the_prediction() {
        let options = BranchOptions::default();
        let next = |angle, prediction| Shown { angle, prediction }.next(0.1, &options);
        assert!((next(0.2, 1e-9) - 0.15).abs() < 1e-15);
        assert!((next(1e-9, 0.0625 * 0.8) - 0.1).abs() < 1e-15);
        assert_eq!(next(0.0, 0.0), 0.2);
        assert!((next(0.0, 100.0) - 0.04).abs() < 1e-15);
        let fast = Shown {
            angle: 0.1,
            prediction: 0.0,
        };
        assert_eq!(fast.next(0.7, &options), 1.0);
        assert!(
            Shown {
                angle: 0.41,
                prediction: 0.0
            }
            .is_too_far(&options)
        );
        assert!(
            Shown {
                angle: f64::NAN,
                prediction: 0.0
            }
            .is_too_far(&options)
        );
        assert!(
            !Shown {
                angle: 0.39,
                prediction: 0.0
            }
            .is_too_far(&options)
        );
    }
}
