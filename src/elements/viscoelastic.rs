//! Generalised Maxwell model on a joint coordinate: a spring and branches of spring and dashpot in
//! series. See docs/theory.md, section 6.10.

use super::coordinate_force::{ActedCoordinate, ActedState, Effort};
use super::{Contribution, Element, Instant, Measure, OutputVariation, Unknown};
use crate::error::Result;
use serde::{Deserialize, Serialize};

/// A Maxwell branch: spring and dashpot in series.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct MaxwellBranch {
    /// Stiffness `K_b` of its spring.
    pub stiffness: f64,
    /// Relaxation time `τ_b`; its dashpot has the damping `K_b τ_b`.
    pub relaxation_time: f64,
}

/// Effort `K∞ (q − q₀) + Σ K_b (q − β_b)` on a joint coordinate `q`, against its growth.
///
/// `β_b`, the elongation of the dashpot of branch b, is an internal state: the dashpot carries what
/// the spring does, `K_b τ_b β̇_b = K_b (q − β_b)`. With `α_b = q − β_b` this is
/// `τ_b α̇_b + α_b = τ_b q̇`. Without branches that move it is the spring alone; one branch makes
/// it a Zener element.
#[derive(Debug, Clone)]
pub struct Viscoelastic {
    at: ActedCoordinate,
    stiffness: f64,
    rest: f64,
    branches: Vec<MaxwellBranch>,
}

impl Viscoelastic {
    /// On this coordinate.
    pub fn new(
        at: ActedCoordinate,
        stiffness: f64,
        rest: f64,
        branches: Vec<MaxwellBranch>,
    ) -> Self {
        Viscoelastic {
            at,
            stiffness,
            rest,
            branches,
        }
    }

    fn effort(&self, state: &ActedState, dashpots: &[f64]) -> Effort {
        let q = state.q.value;
        let mut effort = Effort {
            value: self.stiffness * (q - self.rest),
            by_coordinate: self.stiffness,
            by_rate: 0.0,
        };
        for (branch, beta) in self.branches.iter().zip(dashpots) {
            effort.value += branch.stiffness * (q - beta);
            effort.by_coordinate += branch.stiffness;
        }
        effort
    }
}

impl Element for Viscoelastic {
    fn nodes(&self) -> &[usize] {
        self.at.nodes()
    }

    fn own_unknowns(&self) -> usize {
        self.branches.len()
    }

    fn unknown(&self, _index: usize) -> Unknown {
        self.at.internal_state()
    }

    fn evaluate(&self, instant: &Instant, out: &mut Contribution) -> Result<()> {
        let state = self.at.state(instant)?;
        let (dashpots, rates) = (instant.multipliers, instant.multiplier_rates);
        state.add_effort(&self.effort(&state, dashpots), out);
        for (b, branch) in self.branches.iter().enumerate() {
            let stiffness = branch.stiffness;
            let damping = stiffness * branch.relaxation_time;
            out.constraint[b] += damping * rates[b] - stiffness * (state.q.value - dashpots[b]);
            if out.with_tangents {
                state
                    .relative
                    .add_gradient(b, &(state.q.gradient * -stiffness), out);
                out.own[(b, b)] += stiffness;
                out.own_rate[(b, b)] += damping;
            }
        }
        Ok(())
    }

    /// The effort, then for each branch its effort and the elongation of its dashpot.
    fn outputs(&self, instant: &Instant, out: &mut Vec<f64>) -> Result<()> {
        let state = self.at.state(instant)?;
        out.push(self.effort(&state, instant.multipliers).value);
        for (branch, beta) in self.branches.iter().zip(instant.multipliers) {
            out.extend([branch.stiffness * (state.q.value - beta), *beta]);
        }
        Ok(())
    }

    fn acted_measure(&self) -> Option<Measure> {
        Some(self.at.measure())
    }

    fn vary_output(
        &self,
        instant: &Instant,
        index: usize,
        out: &mut OutputVariation,
    ) -> Result<()> {
        let state = self.at.state(instant)?;
        let Some(place) = index.checked_sub(1) else {
            state.vary_effort(&self.effort(&state, instant.multipliers), out);
            for (by_own, branch) in out.own.iter_mut().zip(&self.branches) {
                *by_own = -branch.stiffness;
            }
            return Ok(());
        };
        let (branch, is_elongation) = (place / 2, place % 2 == 1);
        if is_elongation {
            out.own[branch] = 1.0;
            return Ok(());
        }
        let stiffness = self.branches[branch].stiffness;
        let effort = Effort {
            by_coordinate: stiffness,
            ..Effort::default()
        };
        state.vary_effort(&effort, out);
        out.own[branch] = -stiffness;
        Ok(())
    }
}
