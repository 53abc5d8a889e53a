//! What the equal parts of a rotor do in a mode of disturbances (docs/theory.md, section 12.6).

use super::{NodeQuantity, Solution};
use crate::error::{Error, ErrorKind, Result};
use crate::solve::Stability;
use nalgebra::{Complex, Matrix3, Vector3};
use std::f64::consts::TAU;

type C64 = Complex<f64>;

/// Harmonics of a mode that are told apart, at most.
const MOST_HARMONICS: usize = 40;
/// Motions of blades, of which 1 is the largest of all nodes, that are none.
const STILL: f64 = 0.05;
/// Share of waves in one direction from which on they are said to run.
const RUNNING: f64 = 2.0 / 3.0;
/// Turns a period that are none.
const NO_TURN: f64 = 1e-6;

/// How a pattern on blades goes around, seen from the blades.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Whirl {
    /// It does not: all blades move alike, or each against its neighbours, or waves stand.
    Standing,
    /// In the sense in which the rotor turns; in the order of the blades where it does not.
    Progressive,
    /// Against that.
    Regressive,
}

/// The pattern of nodal diameters that is largest in a mode.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NodalContent {
    /// Number of nodal diameters: the pattern repeats so many times around the rotor.
    pub diameters: usize,
    /// How it goes around.
    pub whirl: Whirl,
    /// Its share of the mean square of all motions of the blades.
    pub share: f64,
    /// Angular frequency of its strongest harmonic in the axes of the blades,
    pub frequency: f64,
    /// and from where the rotor is seen to turn.
    pub frequency_from_ground: f64,
    alternating: bool,
}

impl NodalContent {
    /// What it is called.
    pub fn name(&self) -> String {
        let whirl = match self.whirl {
            Whirl::Standing => "standing",
            Whirl::Progressive => "progressive",
            Whirl::Regressive => "regressive",
        };
        match (self.diameters, self.alternating) {
            (0, _) => "collective".into(),
            (_, true) => "alternating".into(),
            (n, false) => format!("diameter {n} {whirl}"),
        }
    }
}

/// Where equal parts of a rotor are over the period: of each a node, one after the other around it.
#[derive(Debug)]
pub(super) struct Blades {
    nodes: Vec<usize>,
    /// At each time, of each node: from its own axes to radial, tangential and axial ones.
    axes: Vec<Matrix3<f64>>,
    /// Angular velocity in the order of the blades.
    speed: f64,
    frequency: f64,
    length: f64,
}

impl Blades {
    /// At these times of a periodic solution, equally far apart over the period.
    ///
    /// # Errors
    /// If there are fewer than two nodes, or one twice, or one is none; if they are not around an
    /// axis.
    pub fn new(solution: &Solution, nodes: &[usize], times: &[f64]) -> Result<Self> {
        if nodes.len() < 2 {
            return Err(Error::size("blades", "two nodes at least", nodes.len()));
        }
        if let Some(i) = (1..nodes.len()).find(|&i| nodes[..i].contains(&nodes[i])) {
            let got = format!("node {} twice", nodes[i]);
            return Err(Error::value("blades", "different nodes", got));
        }
        let frequency = TAU / solution.grid().period();
        let length = solution.details().system.scales().length;
        let mut blades = Blades {
            nodes: nodes.to_vec(),
            axes: Vec::with_capacity(nodes.len() * times.len()),
            speed: 0.0,
            frequency,
            length,
        };
        let sampled = |quantity: NodeQuantity| -> Result<Vec<Vec<f64>>> {
            let of_node = |&node: &usize| solution.node(node, quantity, times);
            nodes.iter().map(of_node).collect()
        };
        let positions = sampled(NodeQuantity::Position)?;
        let rotations = sampled(NodeQuantity::RotationMatrix)?;
        let velocities = sampled(NodeQuantity::Velocity)?;
        for k in 0..times.len() {
            let vector =
                |series: &[f64], at: usize| Vector3::from_column_slice(&series[at..at + 3]);
            let at: Vec<_> = positions.iter().map(|p| vector(p, 3 * k)).collect();
            let turns = velocities.iter().map(|v| vector(v, 6 * k + 3));
            let turn = turns.sum::<Vector3<f64>>() / nodes.len() as f64;
            let axis = axis_of(&at, &turn);
            let Some((axis, centre)) = axis else {
                let message = "blades: expected nodes around an axis, one after the other; these \
                    are on a line, or two of what does not turn";
                return Err(Error::new(ErrorKind::Value, message));
            };
            blades.speed += turn.dot(&axis) / times.len() as f64;
            for (at, rotation) in at.iter().zip(&rotations) {
                let out = at - centre;
                let radial = (out - axis * out.dot(&axis)).try_normalize(1e-9 * length);
                let Some(radial) = radial else {
                    let message = "blades: expected nodes around an axis, got one on it";
                    return Err(Error::new(ErrorKind::Value, message));
                };
                let rows = Matrix3::from_columns(&[radial, axis.cross(&radial), axis]);
                let own = Matrix3::from_column_slice(&rotation[9 * k..9 * k + 9]);
                blades.axes.push(rows.tr_mul(&own));
            }
        }
        Ok(blades)
    }

    /// What they do in a mode; none if they hardly move.
    ///
    /// # Errors
    /// If there is no such mode.
    pub fn content(&self, stability: &Stability, number: usize) -> Result<Option<NodalContent>> {
        let count = self.nodes.len();
        let mut series: Vec<Vec<[C64; 6]>> = Vec::with_capacity(count);
        for (b, &node) in self.nodes.iter().enumerate() {
            let mut shape = stability.shape(number, node)?;
            for (k, u) in shape.iter_mut().enumerate() {
                self.turn(u, &self.axes[k * count + b]);
            }
            series.push(shape);
        }
        let exponent = stability.multipliers[number].exponent;
        let waves = self.waves(&series, exponent.im);
        let all: f64 = waves.iter().map(|wave| wave.square).sum();
        // Written so that NaN is still.
        let moves = all.sqrt() > STILL;
        Ok(moves.then(|| self.largest(&waves, all)))
    }

    /// Turns a node's increment to radial, tangential and axial axes, with displacements relative
    /// to the characteristic length.
    fn turn(&self, u: &mut [C64; 6], axes: &Matrix3<f64>) {
        let given = *u;
        for half in [0, 3] {
            let size = if half == 0 { 1.0 / self.length } else { 1.0 };
            for i in 0..3 {
                let terms = (0..3).map(|j| given[half + j] * axes[(i, j)] * size);
                u[half + i] = terms.sum();
            }
        }
    }

    /// All waves around the rotor, of each harmonic of the mode.
    fn waves(&self, series: &[Vec<[C64; 6]>], frequency: f64) -> Vec<Wave> {
        let (count, steps) = (series.len(), series[0].len());
        let most = (steps / 2).min(MOST_HARMONICS) as i64;
        let mut waves = Vec::new();
        for pattern in 0..count {
            let diameters = match pattern <= count / 2 {
                true => pattern as i64,
                false => pattern as i64 - count as i64,
            };
            let around = |k: usize, i: usize| -> C64 {
                let all = series.iter().enumerate();
                let sum = all.map(|(b, shape)| shape[k][i] * turned(pattern * b, count));
                sum.sum::<C64>() / count as f64
            };
            let by_time: Vec<[C64; 6]> = (0..steps)
                .map(|k| std::array::from_fn(|i| around(k, i)))
                .collect();
            for harmonic in -most..=most {
                let places = harmonic.rem_euclid(steps as i64) as usize;
                let square = (0..6).map(|i| {
                    let all = by_time.iter().enumerate();
                    let sum = all.map(|(k, u)| u[i] * turned((k + 1) * places % steps, steps));
                    (sum.sum::<C64>() / steps as f64).norm_sqr()
                });
                waves.push(Wave {
                    diameters,
                    frequency: frequency + harmonic as f64 * self.frequency,
                    square: square.sum(),
                });
            }
        }
        waves
    }

    /// The pattern with the most of all waves.
    fn largest(&self, waves: &[Wave], all: f64) -> NodalContent {
        let of = |choose: &dyn Fn(&Wave) -> bool| -> f64 {
            let chosen = waves.iter().filter(|wave| choose(wave));
            chosen.map(|wave| wave.square).sum()
        };
        let size = |n: usize| of(&|wave: &Wave| wave.diameters.unsigned_abs() as usize == n);
        let count = self.nodes.len();
        let patterns = 0..count / 2 + 1;
        let diameters = patterns.max_by(|&a, &b| size(a).total_cmp(&size(b)));
        let diameters = diameters.unwrap_or(0);
        let alternating = diameters > 0 && 2 * diameters == count;
        let turns_back = self.speed < -NO_TURN * self.frequency;
        let with_turn = if turns_back { -1.0 } else { 1.0 };
        // Of exp(i (ω t + n ψ)) the pattern goes around with −ω / n.
        let progressive = of(&|wave: &Wave| {
            let is_it = wave.diameters.unsigned_abs() as usize == diameters;
            is_it && wave.frequency * wave.diameters as f64 * with_turn < 0.0
        });
        let share = size(diameters);
        let whirl = match progressive / share {
            _ if diameters == 0 || alternating => Whirl::Standing,
            part if part > RUNNING => Whirl::Progressive,
            part if part < 1.0 - RUNNING => Whirl::Regressive,
            _ => Whirl::Standing,
        };
        let members = waves
            .iter()
            .filter(|wave| wave.diameters.unsigned_abs() as usize == diameters);
        let strongest = members.max_by(|a, b| a.square.total_cmp(&b.square));
        let [frequency, from_ground] = strongest.map_or([0.0; 2], |wave| {
            let turning = wave.diameters as f64 * self.speed;
            [wave.frequency.abs(), (wave.frequency - turning).abs()]
        });
        NodalContent {
            diameters,
            whirl,
            share: share / all,
            frequency,
            frequency_from_ground: from_ground,
            alternating,
        }
    }
}

/// `exp(i (ω t + n ψ))` over blades at the angles `ψ`.
struct Wave {
    diameters: i64,
    frequency: f64,
    /// Mean square of its motions.
    square: f64,
}

/// `exp(−2πi k / n)`.
fn turned(k: usize, n: usize) -> C64 {
    C64::cis(-TAU * (k % n) as f64 / n as f64)
}

/// The axis around which nodes are, in the sense of their order, and a point on it; of two nodes
/// that about which they turn. None if there is none.
fn axis_of(at: &[Vector3<f64>], turn: &Vector3<f64>) -> Option<(Vector3<f64>, Vector3<f64>)> {
    let centre = at.iter().sum::<Vector3<f64>>() / at.len() as f64;
    let size = at.iter().map(|x| (x - centre).norm_squared()).sum::<f64>();
    let area = (0..at.len()).map(|k| {
        let next = &at[(k + 1) % at.len()];
        (at[k] - centre).cross(&(next - centre))
    });
    let area = area.sum::<Vector3<f64>>();
    let axis = match at.len() {
        2 => turn.try_normalize(f64::MIN_POSITIVE),
        _ => area.try_normalize(1e-6 * size),
    };
    axis.map(|axis| (axis, centre))
}

impl Solution {
    /// Which pattern of nodal diameters the equal parts of a rotor make in a mode of the
    /// disturbances of this solution: `blades` are a node of each, the same on all, one after the
    /// other around the rotor. None if they hardly move in it.
    ///
    /// # Errors
    /// If there is no such mode, or modes are not known; if there are fewer than two nodes, one is
    /// none or there twice, or they are not around an axis.
    pub fn nodal_content(
        &self,
        stability: &Stability,
        number: usize,
        blades: &[usize],
    ) -> Result<Option<NodalContent>> {
        Blades::new(self, blades, &stability.times())?.content(stability, number)
    }
}
