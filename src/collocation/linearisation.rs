//! Small motions about a state that stands still: `(s² M + s C + K) x = 0` for `x exp(st)`.
//! See docs/theory.md, section 11.3.

use super::pattern::Pattern;
use super::problem::Collocation;
use super::state::GridState;
use crate::error::Result;

/// The matrices of small motions, scaled as the Jacobian is: values in the order of one pattern.
///
/// The unknowns are those of a grid of one point: constraints are a part of `K`, rates of internal
/// states of `C`.
#[derive(Debug, Clone)]
pub struct Linearisation {
    /// `K`.
    pub stiffness: Vec<f64>,
    /// `C`.
    pub damping: Vec<f64>,
    /// `M`.
    pub mass: Vec<f64>,
    /// Where constraints depend on each other, a small compliance of all of them that makes factors
    /// of `K` exist; no part of the equations.
    pub compliance: Option<Vec<f64>>,
}

impl Collocation {
    /// Linearises about `state`, on a grid of one point.
    ///
    /// With `V = 0` in the frame that motions are described in, `ΔV = Δu̇` and `ΔV̇ = Δü`.
    pub fn linearise(&mut self, state: &GridState, pattern: &Pattern) -> Result<Linearisation> {
        debug_assert_eq!(self.grid().points(), 1);
        self.update_kinematics(state);
        let zeros = vec![0.0; pattern.entries()];
        let mut matrices = Linearisation {
            stiffness: zeros.clone(),
            damping: zeros.clone(),
            mass: zeros.clone(),
            compliance: None,
        };
        let system = self.system().clone();
        for (index, placed) in system.elements().iter().enumerate() {
            let nodes = placed.element.nodes();
            let count = placed.element.multipliers();
            let out = self
                .instants
                .evaluate(placed, 0, state, &mut self.with_tangents)?;
            for (a, &row) in nodes.iter().enumerate() {
                for (b, &column) in nodes.iter().enumerate() {
                    let pair = pattern.pair(row, column);
                    for component in 0..6 {
                        let first = pattern.pair_value(column, pair, 0, component);
                        for i in 0..6 {
                            let at = (6 * a + i, 6 * b + component);
                            matrices.stiffness[first + i] += out.stiffness[at];
                            matrices.damping[first + i] += out.damping[at];
                            matrices.mass[first + i] += out.mass[at];
                        }
                    }
                }
            }
            for row in 0..count {
                for (local, &node) in nodes.iter().enumerate() {
                    let force = pattern.force_value(index, local, 0, row, count);
                    for component in 0..6 {
                        let gradient = out.gradient[(row, 6 * local + component)];
                        let first = pattern.constraint_value(index, local, node, 0, component);
                        matrices.stiffness[first + row] = gradient;
                        matrices.stiffness[force + component] = gradient;
                    }
                }
                let own = pattern.own_value(index, 0, row, count);
                for other in 0..if placed.has_states { count } else { 0 } {
                    matrices.stiffness[own + other] = out.own[(other, row)];
                    matrices.damping[own + other] = out.own_rate[(other, row)];
                }
            }
        }
        for values in [
            &mut matrices.stiffness,
            &mut matrices.damping,
            &mut matrices.mass,
        ] {
            self.scale(pattern, values);
        }
        if self.is_regularised() {
            let mut compliance = zeros;
            self.add_compliance(pattern, &mut compliance);
            matrices.compliance = Some(compliance);
        }
        Ok(matrices)
    }
}
