//! Linear relations between joint coordinates: gears, belts, racks, differentials.
//! See docs/theory.md, section 6.10.

use super::coordinate_force::{ActedCoordinate, ActedState};
use super::{Contribution, Element, Instant, Measure, Unknown};
use crate::error::Result;

/// Keeps `Σ bᵢ qᵢ − s(t)` at zero, with `s` a factor times a signal and whole turns counted.
///
/// With its multiplier `λ` it exerts the effort `−λ bᵢ` on coordinate `i`, towards growth.
#[derive(Debug, Clone)]
pub struct Relation {
    nodes: Vec<usize>,
    terms: Vec<(ActedCoordinate, f64)>,
    /// Number of the signal, and its factor.
    signal: (usize, f64),
    measure: Measure,
}

impl Relation {
    /// Of these coordinates, each with its coefficient `bᵢ`; the sum measures what `measure` says.
    pub fn new(terms: Vec<(ActedCoordinate, f64)>, signal: (usize, f64), measure: Measure) -> Self {
        let of_all = terms.iter().flat_map(|(at, _)| at.nodes());
        let mut nodes: Vec<usize> = of_all.copied().collect();
        nodes.sort_unstable();
        nodes.dedup();
        let terms = terms.into_iter();
        let terms = terms.map(|(at, b)| (at.among(&nodes), b)).collect();
        Relation {
            nodes,
            terms,
            signal,
            measure,
        }
    }
}

impl Element for Relation {
    fn nodes(&self) -> &[usize] {
        &self.nodes
    }

    fn own_unknowns(&self) -> usize {
        1
    }

    fn unknown(&self, _index: usize) -> Unknown {
        Unknown::Multiplier(self.measure)
    }

    fn potential(&self, _: &Instant, _: &mut Contribution) -> Result<Option<f64>> {
        Ok(Some(0.0))
    }

    fn evaluate(&self, instant: &Instant, out: &mut Contribution) -> Result<()> {
        let multiplier = instant.multipliers[0];
        let (signal, factor) = self.signal;
        out.constraint[0] -= factor * instant.signals[signal];
        for (at, coefficient) in &self.terms {
            let ActedState { relative, q, .. } = at.state(instant)?;
            out.constraint[0] += coefficient * q.value;
            let effort = coefficient * multiplier;
            if out.with_tangents {
                relative.add_gradient(0, &(q.gradient * *coefficient), out);
            }
            relative.add_wrench(&(q.gradient * effort), &(q.hessian * effort), None, out);
        }
        Ok(())
    }
}
