//! Strains between two nodes, and what they vary by (docs/theory.md, section 6.5).
//!
//! Half way between two nodes `Y = M_1⁻¹ M_2 = R²`, and the "velocity in ξ" is the Gibbs vector of
//! their relative motion, `ẽ = (Y − I)(Y + I)⁻¹`: all that follows is a polynomial in it.

use crate::elements::line_station::turns_too_far;
use crate::elements::{NodeState, StrainTangent};
use crate::error::Result;
use crate::motion::{Dual, DualMatrix, DualVector};
use nalgebra::Matrix6;

/// `1 + tr(Y) = 4 cos²(θ/2)` of relative turns that are too near to half of one: at this value the
/// rounding of motions changes strains by 1e-8 of them.
const LEAST_SPREAD: f64 = 4e-8;

/// Half way between two nodes.
pub(super) struct TwoNodes {
    /// "Velocity in ξ".
    pub e: DualVector,
}

impl TwoNodes {
    /// # Errors
    /// If one node is turned by nearly half a turn relative to the other.
    #[inline(always)]
    pub fn new([first, second]: [&NodeState; 2]) -> Result<Self> {
        let y = first.motion.relative(&second.motion).to_dual();
        let Dual { primal, dual } = y.trace();
        let spread = 1.0 + primal;
        // Written so that NaN is refused.
        if spread > LEAST_SPREAD {
            let inverse = Dual {
                primal: 1.0 / spread,
                dual: -dual / (spread * spread),
            };
            let e = y.axial().double() * inverse;
            return Ok(TwoNodes { e });
        }
        Err(turns_too_far())
    }

    /// `B_1 = −½ (I − ẽ + e eᵀ)` and `B_2 = ½ (I + ẽ + e eᵀ)`.
    #[inline(always)]
    pub fn strain_variations(&self) -> [DualMatrix; 2] {
        let even = (DualMatrix::identity() + self.e.outer(&self.e)) * 0.5;
        let odd = self.e.skew() * 0.5;
        [odd - even, odd + even]
    }

    /// `ė = B_1 V_1 + B_2 V_2`.
    #[inline(always)]
    pub fn strain_rate(&self, [first, second]: [DualVector; 2]) -> DualVector {
        let (sum, difference) = (first + second, second - first);
        (difference + self.e.cross(&sum) + self.e * self.e.dot(&difference)) * 0.5
    }

    /// `R_a = ½ ((eᵀ d) I + e dᵀ − s̃) B_a` with `d = V_2 − V_1` and `s = V_1 + V_2`.
    #[inline(always)]
    pub fn rate_variations(
        &self,
        strains: &[DualMatrix; 2],
        [first, second]: [DualVector; 2],
    ) -> [DualMatrix; 2] {
        let (sum, difference) = (first + second, second - first);
        let by_strain = (self.stretched(&difference) - sum.skew()) * 0.5;
        strains.map(|strain| by_strain * strain)
    }

    /// Both, without the rates' if there are no velocities.
    #[inline(always)]
    pub fn variations(&self, twists: Option<[DualVector; 2]>) -> [StrainTangent; 2] {
        let strains = self.strain_variations();
        let rates = match twists {
            Some(twists) => self.rate_variations(&strains, twists),
            None => [DualMatrix::zeros(); 2],
        };
        let [[first, second], [first_rate, second_rate]] = [strains, rates];
        let of = |strain, rate| StrainTangent { strain, rate };
        [of(first, first_rate), of(second, second_rate)]
    }

    /// `(eᵀ a) I + e aᵀ`.
    #[inline(always)]
    fn stretched(&self, a: &DualVector) -> DualMatrix {
        DualMatrix::identity() * self.e.dot(a) + self.e.outer(a)
    }

    /// `B_aᵀ σ` of a stress resultant.
    #[inline(always)]
    pub fn forces(&self, stress: &DualVector) -> [DualVector; 2] {
        let even = (*stress + self.e * self.e.dot(stress)) * 0.5;
        let odd = self.e.cross(stress) * 0.5;
        [-(even + odd), even - odd]
    }

    /// Geometric stiffness of a stress resultant, block by block: passed to `add(a, b, block)`.
    ///
    /// `K_ab = ½ (σ̃ ∓ ((eᵀσ) I + e σᵀ)) B_b`, minus at the first node.
    #[inline(always)]
    pub fn geometric_stiffness(
        &self,
        stress: &DualVector,
        strains: &[StrainTangent; 2],
        mut add: impl FnMut(usize, usize, &Matrix6<f64>),
    ) {
        let (odd, even) = (stress.skew() * 0.5, self.stretched(stress) * 0.5);
        let [first, second] = strains;
        let mut block = |a, b, block: DualMatrix| add(a, b, &block.to_stiffness_matrix());
        let beside = (odd - even) * second.strain;
        block(0, 0, (odd - even) * first.strain);
        block(0, 1, beside);
        block(1, 0, beside.transpose());
        block(1, 1, (odd + even) * second.strain);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::elements::line_station::{
        LineStation, NodePlace, NodeTerms, geometric_stiffness, rate_variations, relative_to_first,
        second_variations,
    };
    use crate::motion::Motion;
    use crate::motion::rotation_from_vector;
    use nalgebra::{Vector3, Vector6};

    fn near(a: &DualMatrix, b: &DualMatrix) {
        let apart = (a.primal - b.primal).amax().max((a.dual - b.dual).amax());
        assert!(apart < 1e-13, "{a:?} {b:?}");
    }

    fn state(turn: [f64; 3], place: [f64; 3], twist: [f64; 6]) -> NodeState {
        let motion = Motion::new(rotation_from_vector(&turn.into()), Vector3::from(place));
        NodeState {
            twist: Vector6::from(twist),
            ..NodeState::at_rest(motion)
        }
    }

    /// As at the midpoint of a line on which motions are interpolated.
    #[test]
    fn a_line_through_two_nodes_says_the_same_at_its_midpoint() {
        let states = [
            state(
                [0.3, -0.2, 0.5],
                [1.0, 2.0, -0.5],
                [0.3, 0.1, -0.7, 0.4, -1.2, 0.6],
            ),
            state(
                [0.9, 0.4, -0.8],
                [1.4, 1.1, 0.2],
                [-0.5, 0.8, 0.2, 1.1, 0.3, -0.9],
            ),
        ];
        let twists = [0, 1].map(|a| DualVector::from_twist(&states[a].twist));
        let stress = DualVector::from_wrench(&Vector6::new(0.7, -0.4, 1.3, 0.2, 0.9, -1.1));
        let line = LineStation {
            shapes: vec![(0.5, -0.5), (0.5, 0.5)],
        };
        let relative: Vec<_> = relative_to_first(states.iter().map(|s| &s.motion)).collect();
        let at = line.motion(&relative).unwrap();
        let places: Vec<NodePlace> = line.places(&at, &relative).collect();
        let mut terms: Vec<NodeTerms> = at.node_terms(places.iter().copied()).collect();
        let rate = at.strain_rate(&places, |a| twists[a]);
        let second: Vec<_> = second_variations(&at, &stress, places.iter().zip(&terms)).collect();
        let mut blocks = [[Matrix6::zeros(); 2]; 2];
        geometric_stiffness(&terms, &second, |a, b, block| blocks[a][b] += block);
        rate_variations(&at, &rate, |a| twists[a], &places, &mut terms);

        let between = TwoNodes::new([&states[0], &states[1]]).unwrap();
        let apart = |a: &DualVector, b: &DualVector| (a.to_twist() - b.to_twist()).amax();
        assert!(apart(&between.e, &at.e) < 1e-14);
        assert!(apart(&between.strain_rate(twists), &rate) < 1e-14);
        let variations = between.variations(Some(twists));
        let forces = between.forces(&stress);
        for (a, force) in at.node_forces(&stress, places.iter()).enumerate() {
            near(&variations[a].strain, &terms[a].strain);
            near(&variations[a].rate, &terms[a].rate);
            assert!(apart(&forces[a], &force) < 1e-14);
        }
        between.geometric_stiffness(&stress, &variations, |a, b, block| {
            assert!((block - blocks[a][b]).amax() < 1e-13, "{a} {b}");
        });
    }

    #[test]
    fn half_a_turn_is_refused() {
        let turned = |angle: f64| state([0.0, 0.0, angle], [1.0, 0.0, 0.0], [0.0; 6]);
        let of = |angle: f64| TwoNodes::new([&turned(0.0), &turned(angle)]);
        let e = of(3.1).unwrap().e.primal[2];
        assert!((e / 1.55f64.tan() - 1.0).abs() < 1e-12, "{e}");
        assert!(of(std::f64::consts::PI).is_err());
        assert!(of(f64::NAN).is_err());
    }
}
