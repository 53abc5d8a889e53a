//! A step of Radau's method IIA about a known motion: disturbances of it are polynomials over the
//! step, through its start and its stages (docs/theory.md, section 12.4).

use super::TimeRule;
use crate::collocation::state::GridState;
use crate::elements::NodeState;
use crate::motion::{DualMatrix, DualVector};
use crate::workers::Workers;

/// Stages of a step.
pub const STAGES: usize = 9;

/// Their places in a step of length 1; the last is its end.
pub const PLACES: [f64; STAGES] = [
    0.017_779_915_147_363_45,
    0.091_323_607_899_793_96,
    0.214_308_479_395_630_76,
    0.371_932_164_583_272_3,
    0.545_186_684_803_426_7,
    0.713_175_242_855_569_4,
    0.855_633_742_957_854_4,
    0.955_366_044_710_030_2,
    1.0,
];

/// How derivatives at the stages follow from values there and at the start, for a step of some
/// length.
#[derive(Debug, Clone, Copy)]
pub struct RadauWeights {
    /// `D`: by values at the stages.
    pub first: [[f64; STAGES]; STAGES],
    /// `d`: by the value at the start.
    pub start: [f64; STAGES],
    /// `D D`.
    pub second: [[f64; STAGES]; STAGES],
    /// `D d`.
    pub second_start: [f64; STAGES],
}

impl RadauWeights {
    /// For steps of this length.
    pub fn new(length: f64) -> Self {
        let mut places = [0.0; STAGES + 1];
        places[1..].copy_from_slice(&PLACES);
        // Barycentric weights of the polynomial through all of them.
        let weight = |j: usize| -> f64 {
            let others = (0..=STAGES).filter(|&m| m != j);
            1.0 / others.map(|m| places[j] - places[m]).product::<f64>()
        };
        let weights: [f64; STAGES + 1] = std::array::from_fn(weight);
        let slope = |i: usize, j: usize| weights[j] / weights[i] / (places[i] - places[j]) / length;
        let row = |i: usize| -> [f64; STAGES + 1] {
            let mut row = std::array::from_fn(|j| if i == j { 0.0 } else { slope(i, j) });
            row[i] = -row.iter().sum::<f64>();
            row
        };
        let rows: [[f64; STAGES + 1]; STAGES] = std::array::from_fn(|i| row(i + 1));
        let first: [[f64; STAGES]; STAGES] =
            std::array::from_fn(|i| std::array::from_fn(|j| rows[i][j + 1]));
        let start: [f64; STAGES] = std::array::from_fn(|i| rows[i][0]);
        let by_first = |i: usize, of: &dyn Fn(usize) -> f64| -> f64 {
            (0..STAGES).map(|j| first[i][j] * of(j)).sum()
        };
        RadauWeights {
            second: std::array::from_fn(|i| std::array::from_fn(|k| by_first(i, &|j| first[j][k]))),
            second_start: std::array::from_fn(|i| by_first(i, &|j| start[j])),
            first,
            start,
        }
    }
}

/// The step: what the nodes do at its stages is given, increments are those of the stages, of a
/// polynomial that is zero at the start.
#[derive(Debug, Clone)]
pub struct RadauStep {
    /// Weights of this step.
    pub weights: RadauWeights,
    /// Node `a` at stage `k`, at `a STAGES + k`.
    pub nodes: Vec<NodeState>,
    /// Rates of own unknown `i` at stage `k`, at `i STAGES + k`.
    pub rates: Vec<f64>,
}

impl RadauStep {
    /// `ṽ` of a node at a stage.
    fn skew(&self, node: usize, k: usize) -> DualMatrix {
        DualVector::from_twist(&self.nodes[node * STAGES + k].twist).skew()
    }
}

impl TimeRule for RadauStep {
    fn evaluate(&mut self, _: &GridState, _: &Workers, nodes: &mut [NodeState]) {
        nodes.copy_from_slice(&self.nodes);
    }

    fn rates(&mut self, place: usize, _: &[f64], _: f64, rates: &mut [f64]) {
        rates.copy_from_slice(&self.rates[place * STAGES..][..STAGES]);
    }

    /// `Δv = Δu̇ + ṽ Δu` and its derivative.
    fn tangent(&self, node: usize, power: usize, l: usize, k: usize) -> [DualMatrix; 2] {
        if power > 0 {
            return [DualMatrix::zeros(); 2];
        }
        let RadauWeights { first, second, .. } = &self.weights;
        let (one, skew) = (DualMatrix::identity(), self.skew(node, k));
        let mut gamma_v = one * first[l][k];
        if l == k {
            gamma_v += skew;
        }
        [gamma_v, one * second[l][k] + skew * first[l][k]]
    }

    fn rate_weight(&self, power: usize, l: usize, k: usize) -> f64 {
        match power {
            0 => self.weights.first[l][k],
            _ => 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_stages_are_radaus_and_polynomials_are_differentiated_exactly() {
        // P_9 − P_8 vanishes at them.
        for place in PLACES {
            let x = 2.0 * place - 1.0;
            let (mut before, mut now) = (1.0, x);
            for n in 1..STAGES {
                let n = n as f64;
                (before, now) = (now, ((2.0 * n + 1.0) * x * now - n * before) / (n + 1.0));
            }
            assert!((now - before).abs() < 1e-13, "{place}: {:e}", now - before);
        }
        let length = 0.3;
        let weights = RadauWeights::new(length);
        for power in 0..=STAGES {
            let value = |place: f64| (place * length).powi(power as i32);
            for (i, place) in PLACES.iter().enumerate() {
                let t = place * length;
                let by = |row: &[f64; STAGES], start: f64| -> f64 {
                    let sum: f64 = row.iter().zip(PLACES).map(|(w, p)| w * value(p)).sum();
                    sum + start * value(0.0)
                };
                let n = power as f64;
                let first = n * t.powi(power as i32 - 1);
                let found = by(&weights.first[i], weights.start[i]);
                assert!((found - first).abs() < 1e-11, "{power}: {found} {first}");
            }
        }
    }
}
