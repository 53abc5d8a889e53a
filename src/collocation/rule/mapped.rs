//! The motion over a grid that is equispaced in pseudo-time (docs/theory.md, section 4.6).

use super::aliasing::Aliasing;
use super::spectral::Spectral;
use super::{OverGrid, RuleWorkspace, TimeRule};
use crate::collocation::state::GridState;
use crate::elements::NodeState;
use crate::fourier::{Slope, TimeGrid};
use crate::motion::DualMatrix;
use crate::workers::Workers;
use nalgebra::Vector6;

/// Spectral differentiation by pseudo-time, and by time from there: `v = v_s/g'` and
/// `v̇ = v̇_s/g'² − v_s g''/g'³`.
#[derive(Debug, Clone)]
pub struct Mapped {
    pseudo: Spectral,
    slopes: Vec<Slope>,
}

impl Mapped {
    /// On `grid`, which is mapped, for so many nodes.
    pub fn new(grid: TimeGrid, nodes: usize) -> Self {
        Mapped {
            pseudo: Spectral::new(grid, nodes),
            slopes: grid.all_slopes(),
        }
    }
}

impl TimeRule for Mapped {
    fn evaluate(&mut self, state: &GridState, workers: &Workers, nodes: &mut [NodeState]) {
        self.pseudo.evaluate(state, workers, nodes);
        for states in nodes.chunks_mut(state.points()) {
            for (node, slope) in states.iter_mut().zip(&self.slopes) {
                [node.twist, node.twist_rate] = slope.by_time(node.twist, node.twist_rate);
            }
        }
    }

    fn rates(&mut self, place: usize, values: &[f64], gain: f64, rates: &mut [f64]) {
        self.pseudo.rates(place, values, gain, rates);
        scale(rates, &self.slopes);
    }

    /// With `D/g' + μ` and `T/g'² − D g''/g'³ + 2μ D/g' + μ²`.
    fn tangent(&self, node: usize, power: usize, l: usize, k: usize) -> [DualMatrix; 2] {
        let [velocity, acceleration] = self.pseudo.tangent(node, power, l, k);
        match power {
            0 => self.slopes[l].by_time(velocity, acceleration),
            1 => [velocity, acceleration * self.slopes[l].rate],
            _ => [velocity, acceleration],
        }
    }

    fn rate_weight(&self, power: usize, l: usize, k: usize) -> f64 {
        let weight = self.pseudo.rate_weight(power, l, k);
        match power {
            0 => weight * self.slopes[l].rate,
            _ => weight,
        }
    }

    fn vary(
        &self,
        node: usize,
        increments: &[f64],
        workspace: &mut RuleWorkspace,
        rates: &mut [[Vector6<f64>; 2]],
    ) {
        self.pseudo.vary(node, increments, workspace, rates);
        for (rates, slope) in rates.iter_mut().zip(&self.slopes) {
            *rates = slope.by_time(rates[0], rates[1]);
        }
    }

    fn vary_rates(&self, values: &[f64], workspace: &mut RuleWorkspace, rates: &mut [f64]) {
        self.pseudo.vary_rates(values, workspace, rates);
        scale(rates, &self.slopes);
    }

    fn vary_transposed(
        &self,
        node: usize,
        by_rates: &[[Vector6<f64>; 2]],
        workspace: &mut RuleWorkspace,
        out: &mut [f64],
    ) {
        let mut by_pseudo = std::mem::take(&mut workspace.by_rates);
        by_pseudo.clear();
        let pairs = by_rates.iter().zip(&self.slopes);
        by_pseudo.extend(pairs.map(|([v, a], slope)| slope.transposed(*v, *a)));
        self.pseudo
            .vary_transposed(node, &by_pseudo, workspace, out);
        workspace.by_rates = by_pseudo;
    }

    fn vary_rates_transposed(
        &self,
        by_rates: &[f64],
        workspace: &mut RuleWorkspace,
        out: &mut [f64],
    ) {
        let mut by_pseudo = std::mem::take(&mut workspace.scaled);
        by_pseudo.clear();
        by_pseudo.extend_from_slice(by_rates);
        scale(&mut by_pseudo, &self.slopes);
        self.pseudo
            .vary_rates_transposed(&by_pseudo, workspace, out);
        workspace.scaled = by_pseudo;
    }

    /// Of derivatives by pseudo-time.
    fn aliasing(&self, node: usize) -> Vec<Aliasing> {
        self.pseudo.aliasing(node)
    }

    fn over_grid(&self) -> Option<OverGrid<'_>> {
        let over = self.pseudo.over_grid()?;
        Some(OverGrid {
            slopes: &self.slopes,
            ..over
        })
    }
}

/// Rates by time from those by pseudo-time.
fn scale(rates: &mut [f64], slopes: &[Slope]) {
    let scaled = rates.iter_mut().zip(slopes);
    scaled.for_each(|(rate, slope)| *rate *= slope.rate);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fourier::{SharpEvent, TimeMap};
    use crate::model::Model;
    use crate::motion::{Motion, rotation_from_vector};
    use crate::system::System;
    use crate::test_models::parts::ball;
    use nalgebra::Vector3;

    /// A turn that is steady in pseudo-time is aliased as one that is steady in time.
    #[test]
    fn aliasing_is_that_of_pseudo_time() {
        let even = TimeGrid::new(9, 2.0).unwrap();
        let event = SharpEvent {
            time: 0.7,
            width: 0.1,
            share: 0.5,
        };
        let grid = even.mapped(TimeMap::new(&[event], 2.0).unwrap());
        let turn = |k: usize| Vector3::z() * (std::f64::consts::TAU * k as f64 / 9.0);
        let motion = |k| Motion::new(rotation_from_vector(&turn(k)), Vector3::zeros());
        let mut model = Model::new();
        ball(&mut model, 1.0, 1.0, &Vector3::zeros());
        let mut state = GridState::reference(&System::new(&model, 2.0).unwrap(), even);
        state.motions = (0..9).map(motion).collect();
        let found = |rule: &mut dyn TimeRule| {
            let mut nodes = vec![NodeState::at_rest(Motion::identity()); 9];
            rule.evaluate(&state, &Workers::default(), &mut nodes);
            rule.aliasing(0)
        };
        let expected = found(&mut Spectral::new(even, 1));
        let aliasing = found(&mut Mapped::new(grid, 1));
        assert_eq!((aliasing.len(), expected.len()), (1, 1));
        for (found, expected) in aliasing.iter().zip(&expected) {
            assert!(expected.velocity.camax() > 0.1);
            assert!((found.velocity - expected.velocity).camax() < 1e-12);
            assert!((found.acceleration - expected.acceleration).camax() < 1e-11);
        }
    }
}
