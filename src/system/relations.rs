//! Relations between joint coordinates: whole turns that they let a period gain, and rates.
//! See docs/theory.md, section 6.10.

use super::{Regime, System};
use crate::elements::{Measure, NodeState};
use crate::error::{Error, ErrorKind, Result};
use crate::model::JointCoordinate;
use nalgebra::{DMatrix, DVector};
use std::f64::consts::TAU;

/// Gains that differ by no more than this, in turns and relative to them, do not differ: ratios of
/// nine digits pass.
const SAME: f64 = 1e-9;
/// Most periods that are looked at for a whole number of turns.
const MOST_PERIODS: usize = 1000;
/// Factor of the rate of a drive that is looked at no further.
const MOST_RATIO: f64 = 1e3;

/// A relation of a system, in units in which its largest coefficient is 1.
#[derive(Debug, Clone)]
pub struct PlacedRelation {
    /// The coordinates, each with its coefficient.
    pub terms: Vec<(JointCoordinate, f64)>,
    /// What the sum of these is of the sum that the user gave.
    pub factor: f64,
    /// Number of the signal that the latter is equal to.
    pub signal: usize,
}

impl System {
    /// The relations between joint coordinates.
    pub fn relations(&self) -> &[PlacedRelation] {
        &self.relations
    }

    /// How much faster than a prescribed angle others may turn by the relations, at most.
    pub(super) fn largest_ratio(&self) -> f64 {
        let spread = |relation: &PlacedRelation| {
            let angles = relation.terms.iter();
            let angles = angles.filter(|(at, _)| at.coordinate.measure() == Measure::Angle);
            let sizes = angles.map(|(_, b)| b.abs());
            let (least, most) = sizes.fold((f64::INFINITY, 0.0f64), |(least, most), b| {
                (least.min(b), most.max(b))
            });
            if least > 0.0 { most / least } else { 1.0 }
        };
        let ratio = self.relations.iter().map(spread).product::<f64>();
        ratio.clamp(1.0, MOST_RATIO)
    }

    /// Checks that angles may gain whole turns in a period as the relations say, where what is
    /// prescribed determines them.
    ///
    /// # Errors
    /// [`ErrorKind::NotPeriodic`], naming what gains no whole number of turns; those of functions
    /// of the user.
    pub(super) fn require_whole_turns(&self) -> Result<()> {
        if self.relations.is_empty() || !matches!(self.regime, Regime::Periodic(_)) {
            return Ok(());
        }
        let mut unknown: Vec<JointCoordinate> = Vec::new();
        let mut place_of = |at: &JointCoordinate| {
            unknown
                .iter()
                .position(|other| other == at)
                .unwrap_or_else(|| {
                    unknown.push(*at);
                    unknown.len() - 1
                })
        };
        let (mut entries, mut known) = (Vec::new(), Vec::new());
        for (row, relation) in self.relations.iter().enumerate() {
            let mut sum = 0.0;
            for (at, b) in &relation.terms {
                let kind = self.joints[at.joint].kind();
                if let Some(signal) = self.prescribed_place(at) {
                    sum += b * self.mean_rate(signal)? * self.period() / TAU;
                } else if kind.leaves_turns_open(at.coordinate) {
                    entries.push((row, place_of(at), *b));
                }
            }
            known.push(sum);
        }
        let mut matrix = DMatrix::zeros(known.len(), unknown.len());
        entries
            .into_iter()
            .for_each(|(i, j, b)| matrix[(i, j)] += b);
        let gains = Gains::of(&matrix, &DVector::from_vec(known));
        self.judge(&gains, &unknown)
    }

    fn judge(&self, gains: &Gains, unknown: &[JointCoordinate]) -> Result<()> {
        let refuse = |message: String| Err(Error::new(ErrorKind::NotPeriodic, message));
        if let Some((relation, left)) = gains.contradiction {
            let left = left / self.relations[relation].factor;
            return refuse(format!(
                "relation {relation}: the turns that its coordinates gain in a period, times their \
                 coefficients, add up to {left:.9}, not to zero"
            ));
        }
        for (at, turns) in unknown.iter().zip(&gains.turns) {
            let is_whole = |x: f64| (x - x.round()).abs() <= SAME * x.abs().max(1.0);
            let Some(turns) = turns.filter(|x| !is_whole(*x)) else {
                continue;
            };
            let longer = (2..=MOST_PERIODS).find(|&n| is_whole(turns * n as f64));
            let advice = longer.map_or(String::new(), |n| {
                format!("; a period {n} times as long would have a whole number of them")
            });
            return refuse(format!(
                "{} of joint {}: by the relations between joint coordinates it gains {turns:.9} \
                 turns in a period, not a whole number{advice}",
                at.coordinate, at.joint
            ));
        }
        Ok(())
    }

    /// Whether the relations hold while each node moves with a twist, about the origin and resolved
    /// in space, and drives run at their rates.
    pub(super) fn relations_allow(&self, twist: impl Fn(usize) -> nalgebra::Vector6<f64>) -> bool {
        let state = |node: &usize| {
            let at_rest = NodeState::at_rest(self.reference[*node]);
            let carried = at_rest.motion.inverse().adjoint() * twist(*node);
            NodeState {
                twist: carried,
                ..at_rest
            }
        };
        self.relations.iter().all(|relation| {
            let rates = relation.terms.iter().map(|(at, b)| {
                let joint = &self.joints[at.joint];
                let nodes = crate::elements::Element::nodes(joint).iter();
                let states: Vec<NodeState> = nodes.map(state).collect();
                b * joint.coordinate_derivatives(at.coordinate, &states)[1]
            });
            let (sum, size) = rates.fold((0.0, 0.0f64), |(sum, size), x| {
                (sum + x, size.max(f64::abs(x)))
            });
            f64::abs(sum) <= SAME * size
        })
    }
}

/// Turns in a period that relations determine.
struct Gains {
    /// Of each unknown, if it is determined.
    turns: Vec<Option<f64>>,
    /// The relation that cannot hold, and what is left of it.
    contradiction: Option<(usize, f64)>,
}

impl Gains {
    /// Of `matrix · turns + known = 0`.
    fn of(matrix: &DMatrix<f64>, known: &DVector<f64>) -> Self {
        let size = known.amax().max(1.0);
        let (mut turns, mut left) = (vec![None; matrix.ncols()], known.clone());
        if !turns.is_empty() {
            let svd = matrix.clone().svd(true, true);
            let least = SAME * svd.singular_values.amax();
            if let (Ok(found), Some(rows)) = (svd.solve(&-known, least), &svd.v_t) {
                left += matrix * &found;
                for (j, turns) in turns.iter_mut().enumerate() {
                    let kept = svd.singular_values.iter().enumerate();
                    let kept = kept.filter(|(_, s)| **s > least);
                    let share: f64 = kept.map(|(i, _)| rows[(i, j)].powi(2)).sum();
                    // The unit vector along it has no part in the null space.
                    *turns = (share > 1.0 - SAME).then_some(found[j]);
                }
            }
        }
        let worst = left.iter().enumerate();
        let worst = worst.max_by(|(_, a), (_, b)| a.abs().total_cmp(&b.abs()));
        Gains {
            turns,
            contradiction: worst
                .filter(|(_, x)| x.abs() > SAME * size)
                .map(|(i, x)| (i, *x)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn turns_that_relations_determine() {
        // 2 a + known 1, b + c undetermined, and both at once.
        let matrix = DMatrix::from_row_slice(2, 3, &[2.0, 0.0, 0.0, 0.0, 1.0, 1.0]);
        let gains = Gains::of(&matrix, &DVector::from_vec(vec![1.0, 4.0]));
        assert!(gains.contradiction.is_none());
        assert!((gains.turns[0].unwrap() + 0.5).abs() < 1e-14);
        assert_eq!(&gains.turns[1..], [None, None]);
        // The same twice with other knowns.
        let twice = DMatrix::from_row_slice(2, 1, &[1.0, 1.0]);
        let gains = Gains::of(&twice, &DVector::from_vec(vec![1.0, 2.0]));
        assert!(gains.contradiction.is_some());
        // Nothing unknown.
        let gains = Gains::of(&DMatrix::zeros(1, 0), &DVector::from_vec(vec![0.25]));
        assert_eq!(gains.contradiction, Some((0, 0.25)));
    }
}
