//! Velocities and accelerations of a node at the grid points, and their exact linearisation
//! (docs/theory.md, section 4.1). Everything is dual algebra.

use crate::elements::NodeState;
use crate::fourier::Differentiation;
use crate::motion::{DualMatrix, DualVector, Motion, mean_position, vectorised};
use nalgebra::Vector6;

/// Weights of the present and the past motions in first and second derivatives.
#[derive(Debug, Clone, Copy)]
pub struct BackwardWeights {
    /// Of the first derivative, per unit of time.
    pub first: [f64; 4],
    /// Of the second derivative, per unit of time squared.
    pub second: [f64; 4],
}

/// One node over the grid: what velocities, accelerations and their tangents follow from. All nodes
/// have one, and a linearisation keeps copies: no more than that.
#[derive(Debug, Clone, Default)]
pub struct NodeKinematics {
    /// `M_k`, with the mean position taken out.
    motions: Vec<Motion>,
    /// `A_ℓ = M_ℓᵀ (D M)_ℓ`.
    a: Vec<DualMatrix>,
    /// `B_ℓ = M_ℓᵀ (T M)_ℓ`.
    b: Vec<DualMatrix>,
}

/// Parts of a matrix, primal and dual, which are of another size, and the numbers of each.
const ENTRIES: [usize; 2] = [2, 9];
const ALL: usize = ENTRIES[0] * ENTRIES[1];

/// Dual matrices at the grid points, and their derivatives.
#[derive(Debug, Clone, Default)]
struct MatrixSeries {
    /// Primal and then dual part, point by point.
    samples: Vec<f64>,
    /// First derivatives and then second ones, likewise.
    derivatives: Vec<f64>,
}

impl MatrixSeries {
    fn resize(&mut self, points: usize) {
        self.samples.resize(ALL * points, 0.0);
        self.derivatives.resize(2 * ALL * points, 0.0);
    }

    #[inline(always)]
    fn set(&mut self, k: usize, matrix: &DualMatrix) {
        let samples = &mut self.samples[ALL * k..][..ALL];
        let (primal, dual) = samples.split_at_mut(ENTRIES[1]);
        primal.copy_from_slice(matrix.primal.as_slice());
        dual.copy_from_slice(matrix.dual.as_slice());
    }

    fn differentiate(&mut self, operators: &mut Differentiation) {
        operators.apply_to_many(ENTRIES, &self.samples, &mut self.derivatives);
    }

    #[inline(always)]
    fn first(&self, l: usize) -> DualMatrix {
        matrix_at(&self.derivatives, l)
    }

    #[inline(always)]
    fn second(&self, l: usize) -> DualMatrix {
        matrix_at(&self.derivatives[self.samples.len()..], l)
    }
}

#[inline(always)]
fn matrix_at(entries: &[f64], place: usize) -> DualMatrix {
    let (primal, dual) = entries[ALL * place..][..ALL].split_at(ENTRIES[1]);
    let mut matrix = DualMatrix::zeros();
    matrix.primal.as_mut_slice().copy_from_slice(primal);
    matrix.dual.as_mut_slice().copy_from_slice(dual);
    matrix
}

/// Scratch of [`NodeKinematics`].
#[derive(Debug, Clone, Default)]
pub struct KinematicsScratch {
    series: MatrixSeries,
    /// The same of what a transposed variation has beside that.
    other: MatrixSeries,
    by_a: Vec<DualMatrix>,
    by_b: Vec<DualMatrix>,
}

impl NodeKinematics {
    /// Evaluates everything for a node's `motions`, one at each grid point.
    pub fn evaluate(
        &mut self,
        operators: &mut Differentiation,
        motions: &[Motion],
        scratch: &mut KinematicsScratch,
    ) {
        let mean = mean_position(motions);
        self.motions.clear();
        self.motions
            .extend(motions.iter().map(|m| m.translated(&-mean)));
        let series = &mut scratch.series;
        series.resize(motions.len());
        for (k, motion) in self.motions.iter().enumerate() {
            series.set(k, &motion.to_dual());
        }
        series.differentiate(operators);
        self.a.clear();
        self.b.clear();
        let NodeKinematics { motions, a, b } = self;
        vectorised(
            #[inline(always)]
            || {
                for (l, motion) in motions.iter().enumerate() {
                    let motion = motion.to_dual();
                    a.push(motion.tr_mul(&series.first(l)));
                    b.push(motion.tr_mul(&series.second(l)));
                }
            },
        );
    }

    /// The same for one point in time, whose derivatives are backward differences with the weights
    /// `weights` of the present motion and of those at past steps, latest first.
    pub fn evaluate_backward<'p>(
        &mut self,
        weights: &BackwardWeights,
        present: &Motion,
        past: impl Iterator<Item = &'p Motion>,
    ) {
        // Relative to the present motion, so that M is the identity and A, B are the sums
        // themselves.
        let identity = DualMatrix::identity();
        let (mut a, mut b) = (identity * weights.first[0], identity * weights.second[0]);
        for (step, motion) in past.enumerate().take(weights.first.len() - 1) {
            let m = present.relative(motion).to_dual();
            a += m * weights.first[step + 1];
            b += m * weights.second[step + 1];
        }
        self.motions = vec![Motion::identity()];
        self.a = vec![a];
        self.b = vec![b];
    }

    /// Number of grid points.
    pub fn points(&self) -> usize {
        self.motions.len()
    }

    /// `M_ℓ`, with the mean position taken out.
    #[inline(always)]
    pub fn motion(&self, l: usize) -> DualMatrix {
        self.motions[l].to_dual()
    }

    /// `A_ℓ`.
    pub fn first(&self, l: usize) -> DualMatrix {
        self.a[l]
    }

    /// `v_ℓ = axial(A_ℓ)`.
    #[inline(always)]
    pub fn velocity(&self, l: usize) -> DualVector {
        self.a[l].axial()
    }

    /// Writes what the node does at the grid points, with the `motions` that were evaluated.
    pub fn write_states(&self, motions: &[Motion], states: &mut [NodeState]) {
        for (l, (state, motion)) in states.iter_mut().zip(motions).enumerate() {
            *state = NodeState {
                motion: *motion,
                twist: self.velocity(l).to_twist(),
                twist_rate: self.acceleration(l).to_twist(),
            };
        }
    }

    /// `v̇_ℓ = axial(B_ℓ − 2 ṽ_ℓ A_ℓ)`.
    pub fn acceleration(&self, l: usize) -> DualVector {
        (self.b[l] - self.velocity(l).skew() * self.a[l] * 2.0).axial()
    }

    /// `Δv_ℓ = Σ_k Γ_v Δu_k` and `Δv̇_ℓ = Σ_k Γ_a Δu_k` for `increments` of all grid points, six
    /// numbers each, by the operators themselves: with them as fast as `D` and `T` are applied. Of
    /// what repeats itself, for those of a part of the period, by the operators of that.
    ///
    /// `ΔM = M Δũ`, so that `ΔA = −Δũ A + Mᵀ (D ΔM)` and `ΔB = −Δũ B + Mᵀ (T ΔM)`. Of these, only
    /// axial parts, the trace of `ΔA` and `ΔA v` are needed: twice the axial part of `ṽ ΔA` is
    /// `tr(ΔA) v − ΔA v`.
    pub fn variation(
        &self,
        operators: &mut Differentiation,
        increments: &[f64],
        scratch: &mut KinematicsScratch,
        rates: &mut [[Vector6<f64>; 2]],
    ) {
        let series = &mut scratch.series;
        series.resize(rates.len());
        let twist = |u: &[f64]| DualVector::from_twist(&Vector6::from_column_slice(u));
        let increments = increments.chunks_exact(6);
        vectorised(
            #[inline(always)]
            || {
                for (k, u) in increments.clone().enumerate() {
                    series.set(k, &self.motion(k).times_skew(&twist(u)));
                }
            },
        );
        series.differentiate(operators);
        vectorised(
            #[inline(always)]
            || {
                for (l, (rates, u)) in rates.iter_mut().zip(increments.clone()).enumerate() {
                    let (motion, u, v) = (self.motion(l), twist(u), self.velocity(l));
                    let (a, b) = (&self.a[l], &self.b[l]);
                    let (first, second) = (series.first(l), series.second(l));
                    let delta_v = motion.axial_of_tr_mul(&first) - a.trace_minus_times(&u) * 0.5;
                    let delta_b = motion.axial_of_tr_mul(&second) - b.trace_minus_times(&u) * 0.5;
                    // tr(Δũ A) = −2 Δu · v
                    let trace = motion.inner(&first) + u.dot(&v) * 2.0;
                    let delta_a_v = motion.transpose() * (first * v) - u.cross(&(*a * v));
                    let delta_rate =
                        delta_b - a.trace_minus_times(&delta_v) - (v * trace - delta_a_v);
                    *rates = [delta_v.to_twist(), delta_rate.to_twist()];
                }
            },
        );
    }

    /// Adds the transposes of `Γ_v` and `Γ_a` times the wrenches `by_rates` that velocity and
    /// acceleration are multiplied by, by the operators themselves.
    ///
    /// As `w · axial(X)` is half the product of all entries of `w̃` and `X`, what they multiply is
    /// half the products of `ΔA` with `P = p̃ + 2 ṽ q̃` and of `ΔB` with `q̃`, where `q` multiplies
    /// `Δv̇` and `p` is what multiplies `Δv` less `(tr(A) I − Aᵀ) q`; `Dᵀ = −D` and `Tᵀ = T`.
    pub fn add_transposed_variation(
        &self,
        operators: &mut Differentiation,
        by_rates: &[[Vector6<f64>; 2]],
        scratch: &mut KinematicsScratch,
        out: &mut [f64],
    ) {
        let KinematicsScratch {
            series,
            other,
            by_a,
            by_b,
        } = scratch;
        series.resize(self.motions.len());
        other.resize(self.motions.len());
        by_a.clear();
        by_b.clear();
        for (l, [by_velocity, by_acceleration]) in by_rates.iter().enumerate() {
            let q = DualVector::from_wrench(by_acceleration);
            let p = DualVector::from_wrench(by_velocity) - self.a[l].trace_minus_transpose() * q;
            by_b.push(q.skew());
            by_a.push(p.skew() + self.velocity(l).skew() * by_b[l] * 2.0);
            series.set(l, &(self.motion(l) * by_a[l]));
            other.set(l, &(self.motion(l) * by_b[l]));
        }
        let sums = &mut series.derivatives[..ALL * self.motions.len()];
        operators.apply_transposed(ENTRIES, [&series.samples, &other.samples], sums);
        for (k, out) in out.chunks_exact_mut(6).enumerate() {
            let sum = self.motion(k).tr_mul(&matrix_at(sums, k))
                - by_a[k] * self.a[k].transpose()
                - by_b[k] * self.b[k].transpose();
            let wrench = sum.axial().to_wrench();
            out.iter_mut().zip(&wrench).for_each(|(out, x)| *out += x);
        }
    }

    /// Blocks `(ℓ, k)` of `Γ_v` and `Γ_a` (docs/theory.md, section 4.2): `Δv_ℓ = Σ_k Γ_v Δu_k`,
    /// `Δv̇_ℓ = Σ_k Γ_a Δu_k`.
    ///
    /// `weights` are `D_ℓk` and `T_ℓk`.
    pub fn tangent(&self, weights: (f64, f64), l: usize, k: usize) -> [DualMatrix; 2] {
        let [mut gamma_v, mut gamma_a] = self.carried(weights, l, k);
        if l == k {
            let (a, b, v) = (&self.a[l], &self.b[l], self.velocity(l));
            let a_spread = a.trace_minus();
            gamma_v = gamma_v - a_spread * 0.5;
            gamma_a = gamma_a - b.trace_minus() * 0.5 + (a.transpose() * v).skew()
                - v.outer(&v) * 2.0
                + a_spread * a_spread * 0.5;
        }
        [gamma_v, gamma_a]
    }

    /// The part of these blocks that is in proportion to the weights.
    pub fn carried(&self, weights: (f64, f64), l: usize, k: usize) -> [DualMatrix; 2] {
        vectorised(
            #[inline(always)]
            || self.in_proportion(weights, l, k),
        )
    }

    #[inline(always)]
    fn in_proportion(&self, (d, t): (f64, f64), l: usize, k: usize) -> [DualMatrix; 2] {
        // The zeros of the identity are wanted where a motion at rest has nothing else.
        let s = match l == k {
            true => DualMatrix::identity(),
            false => self.motion(l).tr_mul(&self.motion(k)),
        };
        // ½ D_ℓk (tr(S) I − Sᵀ), and with W = T_ℓk S − 2 D_ℓk ṽ S the same for the acceleration.
        let gamma_v = s.trace_minus_transpose() * (0.5 * d);
        let w = s * t - self.velocity(l).skew() * s * (2.0 * d);
        let gamma_a = w.trace_minus_transpose() * 0.5 - self.a[l].trace_minus() * gamma_v;
        [gamma_v, gamma_a]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fourier::TimeGrid;
    use crate::motion::rotation_from_vector;
    use nalgebra::Vector3;

    fn motion(phase: f64) -> Motion {
        let turn = rotation_from_vector(&Vector3::new(0.0, 0.0, phase))
            * rotation_from_vector(&Vector3::new(
                0.4 * phase.sin(),
                0.3 * (2.0 * phase).cos(),
                0.0,
            ));
        let position = Vector3::new(phase.cos(), 0.7 * (2.0 * phase).sin(), 3.0 + phase.sin());
        Motion::new(turn, position)
    }

    fn over(grid: TimeGrid) -> Vec<Motion> {
        grid.times().map(|t| motion(grid.frequency() * t)).collect()
    }

    #[test]
    fn velocities_and_accelerations_are_those_of_the_motion() {
        let grid = TimeGrid::new(41, 2.0).unwrap();
        let mut operators = Differentiation::new(grid);
        let mut node = NodeKinematics::default();
        node.evaluate(
            &mut operators,
            &over(grid),
            &mut KinematicsScratch::default(),
        );
        let omega = grid.frequency();
        let h = 1e-4;
        for l in [0, 7, 30] {
            let t = grid.time(l);
            let twist = |t: f64| {
                // Fourth-order differences of the motion itself.
                let here = motion(omega * t);
                let step = 1e-3;
                let relative = |s: f64| here.relative(&motion(omega * (t + s))).to_dual();
                let slope = ((relative(step) - relative(-step)) * 8.0
                    - (relative(2.0 * step) - relative(-2.0 * step)))
                    * (1.0 / (12.0 * step));
                slope.axial().to_twist()
            };
            assert!((node.velocity(l).to_twist() - twist(t)).amax() < 1e-8);
            let rate = (twist(t + h) - twist(t - h)) / (2.0 * h);
            assert!((node.acceleration(l).to_twist() - rate).amax() < 1e-4);
        }
    }

    #[test]
    fn tangents_are_exact() {
        for points in [1, 3, 9] {
            let grid = TimeGrid::new(points, 2.0).unwrap();
            let mut operators = Differentiation::new(grid);
            let motions = over(grid);
            let mut node = NodeKinematics::default();
            node.evaluate(&mut operators, &motions, &mut KinematicsScratch::default());
            let h = 1e-3;
            for k in 0..points {
                for component in 0..6 {
                    let mut at = |step: f64| {
                        let mut moved = motions.clone();
                        let mut increment = Vector6::zeros();
                        increment[component] = step;
                        moved[k] = moved[k].increment(&increment);
                        let mut other = NodeKinematics::default();
                        other.evaluate(&mut operators, &moved, &mut KinematicsScratch::default());
                        other
                    };
                    let (a, b, c, d) = (at(h), at(-h), at(2.0 * h), at(-2.0 * h));
                    for l in 0..points {
                        let slope = |f: &dyn Fn(&NodeKinematics) -> Vector6<f64>| {
                            ((f(&a) - f(&b)) * 8.0 - (f(&c) - f(&d))) / (12.0 * h)
                        };
                        let weights = (operators.first(l, k), operators.second(l, k));
                        let [gamma_v, gamma_a] = node.tangent(weights, l, k);
                        let dv = slope(&|n| n.velocity(l).to_twist());
                        let da = slope(&|n| n.acceleration(l).to_twist());
                        let exact_v = gamma_v.to_twist_matrix().column(component).into_owned();
                        let exact_a = gamma_a.to_twist_matrix().column(component).into_owned();
                        let omega = grid.frequency() * points as f64;
                        assert!((exact_v - dv).amax() < 1e-10 * (1.0 + omega));
                        assert!((exact_a - da).amax() < 1e-10 * (1.0 + omega * omega));
                    }
                }
            }
        }
    }
}
