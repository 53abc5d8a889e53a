//! Where a branch goes on from a point, by the point before (docs/theory.md, section 13.3).

use crate::collocation::GridState;
use crate::motion::DualVector;
use crate::system::Layout;
use nalgebra::Vector6;
use std::ops::{Add, Mul, Sub};
use std::sync::Arc;

/// Part of the third degree that is taken: where steps turn far, all of it misses as much as none.
const DAMPED: f64 = 0.5;
/// Steps of Newton's method for a length along the branch, and most of it, relative to the length
/// along the tangent, that bending adds or takes.
const REFINEMENTS: usize = 4;
const BENDS: f64 = 0.5;
/// What halves a length to rounding.
const HALVINGS: usize = 53;

/// What follows the tangent `t` at a point: `t σ + a σ² + b σ³`, an increment of the state there.
#[derive(Debug, Clone)]
pub(super) struct Course {
    /// `a`, not scaled.
    second: Vec<f64>,
    /// `b`.
    third: Vec<f64>,
    /// Stress resultants at the point, and what they change by likewise, if they are known.
    resultants: Vec<[Vector6<f64>; 4]>,
}

/// Stress resultants at a point, and their rates by the length along the branch.
pub(super) type Resultants = Arc<[Vec<Vector6<f64>>; 2]>;

/// A point of a branch, and the tangent there.
type At<'a> = (&'a GridState, &'a [f64]);

impl Course {
    /// The cubic that has the points and the tangents of both, `length` apart; of multipliers and
    /// internal states, which hardly count, of second degree.
    pub fn through((before, first): At, (now, tangent): At, layout: Layout, length: f64) -> Self {
        let mut course = Course {
            second: vec![0.0; tangent.len()],
            third: vec![0.0; tangent.len()],
            resultants: Vec::new(),
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

    /// Has stress resultants go along, which are these at the points.
    pub fn carry(&mut self, before: &Resultants, now: &Resultants, length: f64) {
        let [[before, first], [now, rate]] = [before, now].map(|both| both.each_ref());
        let both = before.iter().zip(first).zip(now.iter().zip(rate));
        let terms = both.map(|((before, first), (now, rate))| {
            let [second, third] = of_cubic(before - now, *first, *rate, length);
            [*now, *rate, second, third]
        });
        self.resultants = terms.collect();
    }

    /// Stress resultants at `length` along the branch; none where they are not known.
    pub fn resultants(&self, length: f64) -> Vec<Vector6<f64>> {
        let at =
            |[now, t, a, b]: &[Vector6<f64>; 4]| now + (t + (a + b * length) * length) * length;
        self.resultants.iter().map(at).collect()
    }

    /// Sets the entry that is `back` at `-length`, with this rate, and zero here.
    fn set(&mut self, i: usize, (back, rate): (f64, f64), tangent: f64, length: f64) {
        let [second, third] = of_cubic(back, rate, tangent, length);
        (self.second[i], self.third[i]) = (second, third);
    }

    /// What serves beyond the points.
    pub fn damped(mut self) -> Self {
        self.third.iter_mut().for_each(|b| *b *= DAMPED);
        let of_resultants = self.resultants.iter_mut();
        of_resultants.for_each(|[_, _, _, b]| *b *= DAMPED);
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

    /// How far along the branch what is measured `along` something comes to this length, where that
    /// is not far from where it would by the tangent alone.
    pub fn reaching(&self, length: f64, tangent: &[f64], along: impl Fn(&[f64]) -> f64) -> f64 {
        let [t, a, b] = [tangent, &self.second, &self.third].map(along);
        let straight = length / t;
        let mut reached = straight;
        for _ in 0..REFINEMENTS {
            let left = length - reached * (t + reached * (a + reached * b));
            reached += left / (t + reached * (2.0 * a + 3.0 * reached * b));
        }
        // Written so that NaN is none.
        match (reached / straight - 1.0).abs() <= BENDS {
            true => reached,
            false => straight,
        }
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

/// Terms of second and third degree of the cubic that is `back` at `-length`, with the rate `first`
/// there, and zero with the rate `now` at zero.
fn of_cubic<T>(back: T, first: T, now: T, length: f64) -> [T; 2]
where
    T: Copy + Add<Output = T> + Sub<Output = T> + Mul<f64, Output = T>,
{
    let away = (back + now * length) * (1.0 / (length * length));
    let turn = (first - now) * (1.0 / length);
    [away * 3.0 + turn, (away * 2.0 + turn) * (1.0 / length)]
}

#[cfg(test)]
mod tests {
    use super::Course;

    #[test]
    fn a_length_along_the_tangent_is_reached_where_the_branch_bends_little() {
        let course = |second: f64| Course {
            second: vec![second],
            third: vec![0.0],
            resultants: Vec::new(),
        };
        let reached = |second: f64| course(second).reaching(1.0, &[1.0], |x| x[0]);
        // σ - σ²/8 = 1.
        assert!((reached(-0.125) - (4.0 - 8.0f64.sqrt())).abs() < 1e-12);
        // σ - σ²/2 never comes to it.
        assert_eq!(reached(-0.5), 1.0);
    }

    #[test]
    fn a_value_of_an_unknown_is_found_between_the_points() {
        // x = 2σ + 3σ² + σ³ = -3/8 at σ = -1/2, and at σ = (√3.25 - 2.5)/2 before that.
        let course = Course {
            second: vec![0.0, 3.0],
            third: vec![0.0, 1.0],
            resultants: Vec::new(),
        };
        let back = course.back_to(1, &[1.0, 2.0], -0.375, 0.45);
        assert!((back - 0.5 * (3.25f64.sqrt() - 2.5)).abs() < 1e-15);
    }
}
