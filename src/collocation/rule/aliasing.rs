//! Increments of the highest harmonics, which the grid confuses with others where the motion that
//! they are carried by has harmonics of its own.
//!
//! With `M = Σ M_m exp(imωt)`, an increment `u exp(ihωt)` changes `M` by harmonics `h + m`. Those
//! above the highest, `H`, are differentiated as harmonics `h + m − N`: averaged over time,
//!
//! ```text
//! A is off by  −iNω Σ P_m ũ,   B by  Nω² Σ (2(h + m) − N) P_m ũ,   P_m = M_mᴴ M_m,   h + m > H
//! ```
//!
//! which is all there is to it where `M` turns steadily. With an even number of points
//! harmonic `N/2` has no first derivative, as half of it is taken for harmonic `−N/2`.
//! See docs/theory.md, section 4.5.

use super::kinematics::NodeKinematics;
use crate::fourier::TimeGrid;
use crate::motion::{DualMatrix, DualVector};
use nalgebra::{Complex, Matrix6};

/// Harmonics of a motion that are looked at.
const MOST: usize = 6;
/// Change of velocities, relative to what is changed, that does not matter.
const SMALL: f64 = 1e-3;

/// What is wrong of the changes of velocity and acceleration by an increment of one harmonic.
#[derive(Debug, Clone, PartialEq)]
pub struct Aliasing {
    /// Of `Δv`.
    pub velocity: Matrix6<Complex<f64>>,
    /// Of `Δv̇`.
    pub acceleration: Matrix6<Complex<f64>>,
}

/// Real and imaginary part.
#[derive(Clone, Copy)]
struct Pair(DualMatrix, DualMatrix);

impl Pair {
    fn zeros() -> Self {
        Pair(DualMatrix::zeros(), DualMatrix::zeros())
    }

    fn add(&mut self, other: &Pair, factor: f64) {
        self.0 += other.0 * factor;
        self.1 += other.1 * factor;
    }

    fn map(&self, f: impl Fn(&DualMatrix) -> DualMatrix) -> Pair {
        Pair(f(&self.0), f(&self.1))
    }

    fn to_twist_matrix(self) -> Matrix6<Complex<f64>> {
        let (re, im) = (self.0.to_twist_matrix(), self.1.to_twist_matrix());
        re.zip_map(&im, Complex::new)
    }
}

impl NodeKinematics {
    /// Of the highest harmonic, the one below it, and so on while it matters.
    pub fn aliasing(&self, grid: TimeGrid) -> Vec<Aliasing> {
        let points = grid.points();
        let (highest, omega) = (points / 2, grid.frequency());
        let n = points as f64;
        // The first that is no harmonic of the grid, above the highest increment.
        let first = points % 2;
        let most = MOST.min(highest);
        let products: Vec<Pair> = (first..=most).map(|m| self.product(m)).collect();
        let (mut a, mut v) = (DualMatrix::zeros(), DualVector::zeros());
        for l in 0..points {
            a += self.first(l) * (1.0 / n);
            v += self.velocity(l) * (1.0 / n);
        }
        let mut all = Vec::new();
        for below in 0..products.len() {
            let h = highest - below;
            let (mut sum, mut weighted) = (Pair::zeros(), Pair::zeros());
            for (product, m) in products.iter().zip(first..).skip(below) {
                sum.add(product, grid.part_of_harmonic(h + m));
                weighted.add(product, 2.0 * (h + m) as f64 - n);
            }
            if sum.0.primal.norm() + sum.1.primal.norm() < SMALL {
                break;
            }
            let change_a = Pair(sum.1 * (n * omega), sum.0 * (-n * omega));
            let change_b = weighted.map(|w| *w * (n * omega * omega));
            // axial(X ũ) = ½ (tr(X) I − Xᵀ) u,  axial(ũ A) = ½ (tr(A) I − A) u
            let velocity = change_a.map(|x| x.trace_minus_transpose() * 0.5);
            let mut acceleration = change_b.map(|x| x.trace_minus_transpose() * 0.5);
            acceleration.add(&velocity.map(|g| a.trace_minus() * *g), -1.0);
            let carried = change_a.map(|x| (v.skew() * *x).trace_minus_transpose());
            acceleration.add(&carried, -1.0);
            all.push(Aliasing {
                velocity: velocity.to_twist_matrix(),
                acceleration: acceleration.to_twist_matrix(),
            });
        }
        all
    }

    /// `M_mᴴ M_m`.
    fn product(&self, m: usize) -> Pair {
        let points = self.points();
        let mut harmonic = Pair::zeros();
        for k in 0..points {
            let angle = std::f64::consts::TAU * ((m * k) % points) as f64 / points as f64;
            let (sine, cosine) = angle.sin_cos();
            let motion = self.motion(k) * (1.0 / points as f64);
            harmonic.0 += motion * cosine;
            harmonic.1 += motion * -sine;
        }
        let Pair(re, im) = harmonic;
        Pair(
            re.tr_mul(&re) + im.tr_mul(&im),
            re.tr_mul(&im) - im.tr_mul(&re),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collocation::rule::KinematicsScratch;
    use crate::fourier::Differentiation;
    use crate::motion::{Motion, rotation_from_vector};
    use nalgebra::{Vector3, Vector6};

    #[test]
    fn a_steady_turn_is_exact() {
        for points in [15, 16] {
            a_steady_turn_on(points);
        }
    }

    fn a_steady_turn_on(points: usize) {
        let grid = TimeGrid::even_or_odd(points, 2.0).unwrap();
        let omega = grid.frequency();
        let mut operators = Differentiation::new(grid);
        let offset = Motion::new(
            rotation_from_vector(&Vector3::new(0.3, -0.8, 0.4)),
            Vector3::new(1.0, 2.0, 0.5),
        );
        for turns in [1i32, 2, -1] {
            let motions: Vec<Motion> = grid
                .times()
                .map(|t| {
                    let turn =
                        rotation_from_vector(&Vector3::new(0.0, 0.0, f64::from(turns) * omega * t));
                    Motion::new(turn, Vector3::zeros()).compose(&offset)
                })
                .collect();
            let mut node = NodeKinematics::default();
            node.evaluate(&mut operators, &motions, &mut KinematicsScratch::default());
            let aliasing = node.aliasing(grid);
            // And the highest of an even number itself.
            let count = turns.unsigned_abs() as usize + 1 - points % 2;
            assert_eq!(aliasing.len(), count);
            let twist = node.velocity(0).skew().to_twist_matrix().map(Complex::from);
            for (below, expected) in aliasing.iter().enumerate() {
                let h = points / 2 - below;
                for component in 0..6 {
                    // The response to a cosine and, as imaginary part, to a sine.
                    let mut response = [Vector6::<Complex<f64>>::zeros(); 2];
                    for (part, factor) in [(0, Complex::from(1.0)), (1, Complex::i())] {
                        let mut increments = vec![0.0; 6 * points];
                        for (k, t) in grid.times().enumerate() {
                            let (sine, cosine) = (h as f64 * omega * t).sin_cos();
                            increments[6 * k + component] = [cosine, sine][part];
                        }
                        let scratch = &mut KinematicsScratch::default();
                        let mut rates = vec![[Vector6::zeros(); 2]; points];
                        node.variation(&mut operators, &increments, scratch, &mut rates);
                        for (l, [dv, da]) in rates.iter().enumerate() {
                            let back = Complex::from_polar(1.0, -omega * h as f64 * grid.time(l))
                                / points as f64;
                            response[0] += dv.map(|x| back * factor * x);
                            response[1] += da.map(|x| back * factor * x);
                        }
                    }
                    // ΔV = Δu̇ + Ṽ Δu and ΔV̇ = Δü + Ṽ Δu̇
                    let mut unit = Vector6::zeros();
                    unit[component] = Complex::from(1.0);
                    let rate = Complex::new(0.0, omega * h as f64);
                    let exact = [
                        unit * rate + twist * unit,
                        unit * rate * rate + twist * unit * rate,
                    ];
                    let off = [&expected.velocity, &expected.acceleration];
                    for ((response, exact), off) in response.iter().zip(&exact).zip(off) {
                        let difference = response - exact - off.column(component);
                        assert!(difference.map(|x| x.norm()).max() < 1e-9 * response.norm());
                    }
                }
            }
        }
    }
}
