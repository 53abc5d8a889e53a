//! Where a branch goes on from a point, by the point before (docs/theory.md, section 13.3).

use crate::collocation::GridState;
use crate::motion::DualVector;
use crate::system::Layout;
use nalgebra::Vector6;

/// Part of the third degree that is taken: where steps turn far, all of it misses as much as none.
const DAMPED: f64 = 0.5;
/// What halves a length to rounding.
const HALVINGS: usize = 53;

/// What follows the tangent `t` at a point: `t σ + a σ² + b σ³`, an increment of the state there.
#[derive(Debug, Clone)]
pub(super) struct Course {
    /// `a`, not scaled.
    second: Vec<f64>,
    /// `b`.
    third: Vec<f64>,
}

/// A point of a branch, and the tangent there.
type At<'a> = (&'a GridState, &'a [f64]);

impl Course {
    /// The cubic that has the points and the tangents of both, `length` apart; of multipliers and
    /// internal states, which hardly count, of second degree.
    pub fn through((before, first): At, (now, tangent): At, layout: Layout, length: f64) -> Self {
        let mut course = Course {
            second: vec![0.0; tangent.len()],
            third: vec![0.0; tangent.len()],
        };
        for i in layout.own() {
            course.second[i] = (tangent[i] - first[i]) / (2.0 * length);
        }
        for (i, scalar) in layout.scalars().zip(0..) {
            let back = before.scalars[scalar] - now.scalars[scalar];
            course.set(i, (back, first[i]), tangent[i], length);
        }
        for node in 0..layout.motions().len() / layout.of_node() {
            let both = before.node(node).iter().zip(now.node(node));
            for (k, (before, now)) in both.enumerate() {
                let at = layout.motion(node, k);
                let back = now.relative(before).logarithm();
                // The rate of the logarithm there, to the order that matters.
                let rate = Vector6::from_column_slice(&first[at.clone()]);
                let turned = DualVector::from_twist(&back).cross(&DualVector::from_twist(&rate));
                let rate = rate + turned.to_twist() * 0.5;
                for (i, j) in at.zip(0..6) {
                    course.set(i, (back[j], rate[j]), tangent[i], length);
                }
            }
        }
        course
    }

    /// Sets the entry that is `back` at `-length`, with this rate, and zero here.
    fn set(&mut self, i: usize, (back, rate): (f64, f64), tangent: f64, length: f64) {
        let away = (back + length * tangent) / (length * length);
        let turn = (rate - tangent) / length;
        self.second[i] = 3.0 * away + turn;
        self.third[i] = (2.0 * away + turn) / length;
    }

    /// What serves beyond the points.
    pub fn damped(mut self) -> Self {
        self.third.iter_mut().for_each(|b| *b *= DAMPED);
        self
    }

    /// How far back from the point an unknown is as much larger, no farther than `length`.
    pub fn back_to(&self, unknown: usize, tangent: &[f64], change: f64, length: f64) -> f64 {
        let (t, a, b) = (tangent[unknown], self.second[unknown], self.third[unknown]);
        let beyond = |back: f64| back * (t + back * (a + back * b)) - change;
        let (mut near, mut far) = (0.0, -length);
        let rises = beyond(near) > 0.0;
        for _ in 0..HALVINGS {
            let middle = 0.5 * (near + far);
            match (beyond(middle) > 0.0) == rises {
                true => near = middle,
                false => far = middle,
            }
        }
        near
    }

    /// The increment at `length` along the branch.
    pub fn increment(&self, tangent: &[f64], length: f64) -> Vec<f64> {
        let more = self.second.iter().zip(&self.third);
        let terms = tangent.iter().zip(more);
        let at = |(t, (a, b)): (&f64, (&f64, &f64))| length * (t + length * (a + length * b));
        terms.map(at).collect()
    }

    /// Its rate there.
    pub fn rate(&self, tangent: &[f64], length: f64) -> Vec<f64> {
        let more = self.second.iter().zip(&self.third);
        let terms = tangent.iter().zip(more);
        let at = |(t, (a, b)): (&f64, (&f64, &f64))| t + length * (2.0 * a + 3.0 * length * b);
        terms.map(at).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::Course;

    #[test]
    fn a_value_of_an_unknown_is_found_between_the_points() {
        // x = 2σ + 3σ² + σ³ = -3/8 at σ = -1/2, and at σ = (√3.25 - 2.5)/2 before that.
        let course = Course {
            second: vec![0.0, 3.0],
            third: vec![0.0, 1.0],
        };
        let back = course.back_to(1, &[1.0, 2.0], -0.375, 0.45);
        assert!((back - 0.5 * (3.25f64.sqrt() - 2.5)).abs() < 1e-15);
    }
}
