//! The equations of a rod in equilibrium, integrated by shooting.

use nalgebra::{Matrix3, Matrix6, SMatrix, SVector, Vector3, Vector6};
use periodyn::elements::LoadFrame;
use periodyn::motion::skew;

/// Position, axes, force and moment (inertial frame) of a rod's section.
#[derive(Clone, Copy)]
pub struct RodState {
    pub position: Vector3<f64>,
    pub rotation: Matrix3<f64>,
    pub force: Vector3<f64>,
    pub moment: Vector3<f64>,
}

/// A rod held at the origin, in its section's axes there, and its equations of equilibrium:
/// `r' = R (e₁ + γ)`, `R' = R (κ₀ + κ)~`, `n' = −f`, `m' = −r' × n − l`, and
/// `[γ; κ] = 𝒦⁻¹ Rᵀ[n; m]`.
pub struct Rod<'a> {
    pub length: f64,
    /// Fractions of the length where anything is not smooth, 0 and 1 included.
    pub corners: &'a [f64],
    /// Compliance at a fraction; the second argument is the middle of the smooth part that it is
    /// in.
    pub stiffness: &'a dyn Fn(f64, f64) -> Matrix6<f64>,
    /// Curvature of the line free of stress.
    pub curvature: &'a dyn Fn(f64, f64) -> Vector3<f64>,
    /// Force and moment for a unit of length, along the axes of `frame`.
    pub load: &'a dyn Fn(f64, f64) -> Vector6<f64>,
    pub frame: LoadFrame,
    /// Force and moment at the end, inertial frame.
    pub end: Vector6<f64>,
}

impl Rod<'_> {
    fn slope(&self, at: f64, part: f64, factor: f64, y: &RodState) -> RodState {
        let (n, m) = (y.rotation.tr_mul(&y.force), y.rotation.tr_mul(&y.moment));
        let stress = Vector6::new(n.x, n.y, n.z, m.x, m.y, m.z);
        let strain = (self.stiffness)(at, part).lu().solve(&stress).unwrap();
        let curvature = (self.curvature)(at, part) + strain.fixed_rows::<3>(3);
        let along = y.rotation * (Vector3::x() + strain.fixed_rows::<3>(0));
        let load = (self.load)(at, part) * factor;
        let turn = match self.frame {
            LoadFrame::Follower => y.rotation,
            _ => Matrix3::identity(),
        };
        RodState {
            position: along,
            rotation: y.rotation * skew(&curvature),
            force: -(turn * load.fixed_rows::<3>(0)),
            moment: -along.cross(&y.force) - turn * load.fixed_rows::<3>(3),
        }
    }

    /// The end, for a force and moment at the start: Runge and Kutta's fourth order, which leaves
    /// an error of about (1/1500)⁴ = 2e-13 in each smooth part.
    fn integrate(&self, start: &Vector6<f64>, factor: f64) -> RodState {
        const STEPS: usize = 1500;
        let mut y = RodState {
            position: Vector3::zeros(),
            rotation: Matrix3::identity(),
            force: start.fixed_rows::<3>(0).into_owned(),
            moment: start.fixed_rows::<3>(3).into_owned(),
        };
        let moved = |y: &RodState, k: &RodState, h: f64| RodState {
            position: y.position + k.position * h,
            rotation: y.rotation + k.rotation * h,
            force: y.force + k.force * h,
            moment: y.moment + k.moment * h,
        };
        for corners in self.corners.windows(2) {
            let part = 0.5 * (corners[0] + corners[1]);
            let step = (corners[1] - corners[0]) / STEPS as f64;
            let h = step * self.length;
            for i in 0..STEPS {
                let at = corners[0] + step * i as f64;
                let f = |x: f64, y: &RodState| self.slope(x, part, factor, y);
                let a = f(at, &y);
                let b = f(at + 0.5 * step, &moved(&y, &a, 0.5 * h));
                let c = f(at + 0.5 * step, &moved(&y, &b, 0.5 * h));
                let d = f(at + step, &moved(&y, &c, h));
                for (k, weight) in [(a, 1.0), (b, 2.0), (c, 2.0), (d, 1.0)] {
                    y = moved(&y, &k, weight * h / 6.0);
                }
            }
        }
        y
    }

    /// The end of the rod in equilibrium, by Newton on the force and moment at its start, in load
    /// steps.
    pub fn equilibrium(&self, steps: usize) -> RodState {
        let mut start = SVector::<f64, 6>::zeros();
        for step in 1..=steps {
            let factor = step as f64 / steps as f64;
            let miss = |start: &Vector6<f64>| {
                let y = self.integrate(start, factor);
                let (n, m) = (y.force, y.moment);
                Vector6::new(n.x, n.y, n.z, m.x, m.y, m.z) - self.end * factor
            };
            let scale = self.end.amax().max(1.0);
            let mut increment = f64::INFINITY;
            for _ in 0..30 {
                let residual = miss(&start);
                let mut jacobian = SMatrix::<f64, 6, 6>::zeros();
                let h = 1e-5 * scale;
                for column in 0..6 {
                    let mut moved = start;
                    moved[column] += h;
                    let high = miss(&moved);
                    moved[column] -= 2.0 * h;
                    jacobian.set_column(column, &((high - miss(&moved)) / (2.0 * h)));
                }
                let change = jacobian.lu().solve(&residual).unwrap();
                start -= change;
                increment = change.amax();
                if increment < 1e-11 * scale {
                    break;
                }
            }
            assert!(increment < 1e-9 * scale, "shooting: {increment:e}");
        }
        self.integrate(&start, 1.0)
    }
}
