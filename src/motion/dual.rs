//! Dual numbers, vectors and 3×3 matrices, `a + ε a°` with `ε² = 0` (docs/theory.md, section 1.1).
//!
//! A formula for rotations, evaluated in dual algebra, is the formula for motions.

use super::product::{dot, of_entries, outer_product, product, sum_of_products, trace, transpose};
use super::rotation::{axial, cross, skew, skew_times, times_skew};
use super::scalar::Scalar;
use nalgebra::{ArrayStorage, Matrix3, Matrix6, Vector3, Vector6};
use std::ops::{Add, AddAssign, Mul, Neg, Sub};

/// Dual number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dual<T = f64> {
    /// Primal part.
    pub primal: T,
    /// Dual part.
    pub dual: T,
}

/// Dual 3-vector.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DualVector<T = f64> {
    /// Primal part.
    pub primal: Vector3<T>,
    /// Dual part.
    pub dual: Vector3<T>,
}

/// Dual 3×3 matrix.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DualMatrix<T = f64> {
    /// Primal part.
    pub primal: Matrix3<T>,
    /// Dual part.
    pub dual: Matrix3<T>,
}

macro_rules! linear_operations {
    ($type:ident, $of_entries:ident) => {
        impl<T: Scalar> Add for $type<T> {
            type Output = $type<T>;
            #[inline(always)]
            fn add(self, b: $type<T>) -> $type<T> {
                $type {
                    primal: $of_entries(&self.primal, &b.primal, |a, b| a + b),
                    dual: $of_entries(&self.dual, &b.dual, |a, b| a + b),
                }
            }
        }
        impl<T: Scalar> AddAssign for $type<T> {
            #[inline(always)]
            fn add_assign(&mut self, b: $type<T>) {
                *self = *self + b;
            }
        }
        impl<T: Scalar> Sub for $type<T> {
            type Output = $type<T>;
            #[inline(always)]
            fn sub(self, b: $type<T>) -> $type<T> {
                $type {
                    primal: $of_entries(&self.primal, &b.primal, |a, b| a - b),
                    dual: $of_entries(&self.dual, &b.dual, |a, b| a - b),
                }
            }
        }
        impl<T: Scalar> Neg for $type<T> {
            type Output = $type<T>;
            #[inline(always)]
            fn neg(self) -> $type<T> {
                $type {
                    primal: $of_entries(&self.primal, &self.primal, |a, _| -a),
                    dual: $of_entries(&self.dual, &self.dual, |a, _| -a),
                }
            }
        }
        impl<T: Scalar> Mul<T> for $type<T> {
            type Output = $type<T>;
            #[inline(always)]
            fn mul(self, b: T) -> $type<T> {
                $type {
                    primal: $of_entries(&self.primal, &self.primal, |a, _| a * b),
                    dual: $of_entries(&self.dual, &self.dual, |a, _| a * b),
                }
            }
        }
    };
}
linear_operations!(Dual, of_numbers);
linear_operations!(DualVector, of_entries);
linear_operations!(DualMatrix, of_entries);

#[inline(always)]
fn of_numbers<T: Scalar>(a: &T, b: &T, f: impl Fn(T, T) -> T) -> T {
    f(*a, *b)
}

macro_rules! product_with_matrix {
    ($type:ident) => {
        impl<T: Scalar> Mul<$type<T>> for DualMatrix<T> {
            type Output = $type<T>;
            #[inline(always)]
            fn mul(self, b: $type<T>) -> $type<T> {
                $type {
                    primal: product(&self.primal, &b.primal),
                    dual: sum_of_products((&self.primal, &b.dual), (&self.dual, &b.primal)),
                }
            }
        }
    };
}
product_with_matrix!(DualVector);
product_with_matrix!(DualMatrix);

macro_rules! product_with_dual {
    ($type:ident) => {
        impl<T: Scalar> Mul<Dual<T>> for $type<T> {
            type Output = $type<T>;
            #[inline(always)]
            fn mul(self, b: Dual<T>) -> $type<T> {
                let (primal, dual) = (&self.primal, &self.dual);
                $type {
                    primal: of_entries(primal, primal, |a, _| a * b.primal),
                    dual: of_entries(primal, dual, |a, d| (a * b.dual).plus_product(d, b.primal)),
                }
            }
        }
    };
}
product_with_dual!(DualVector);
product_with_dual!(DualMatrix);

impl DualVector {
    /// The zero vector.
    #[inline]
    pub fn zeros() -> Self {
        DualVector {
            primal: Vector3::zeros(),
            dual: Vector3::zeros(),
        }
    }

    /// From a twist or increment `[linear; angular]`: the angular part is primal.
    #[inline]
    pub fn from_twist(v: &Vector6<f64>) -> Self {
        DualVector {
            primal: Vector3::new(v[3], v[4], v[5]),
            dual: Vector3::new(v[0], v[1], v[2]),
        }
    }

    /// The twist at the origin of what turns with `angular` about an axis through `point`.
    pub fn of_turn(angular: &Vector3<f64>, point: &Vector3<f64>) -> Self {
        DualVector {
            primal: *angular,
            dual: point.cross(angular),
        }
    }

    /// As a twist `[linear; angular]`.
    #[inline]
    pub fn to_twist(self) -> Vector6<f64> {
        let (a, l) = (self.primal, self.dual);
        Vector6::new(l.x, l.y, l.z, a.x, a.y, a.z)
    }

    /// From a wrench `[force; moment]`: the force is primal, so that the dual part of the product
    /// of a wrench and a twist is their power.
    #[inline]
    pub fn from_wrench(w: &Vector6<f64>) -> Self {
        DualVector {
            primal: Vector3::new(w[0], w[1], w[2]),
            dual: Vector3::new(w[3], w[4], w[5]),
        }
    }

    /// As a wrench `[force; moment]`.
    #[inline]
    pub fn to_wrench(self) -> Vector6<f64> {
        let (f, m) = (self.primal, self.dual);
        Vector6::new(f.x, f.y, f.z, m.x, m.y, m.z)
    }
}

/// The primal part of a dual matrix, or the dual one.
type Part = fn(&mut DualMatrix) -> &mut Matrix3<f64>;

impl DualMatrix {
    /// The places of all entries.
    pub fn entries() -> impl Iterator<Item = (Part, usize)> {
        let parts: [Part; 2] = [|m| &mut m.primal, |m| &mut m.dual];
        (0..9).flat_map(move |entry| parts.map(|part| (part, entry)))
    }

    /// The zero matrix.
    #[inline]
    pub fn zeros() -> Self {
        DualMatrix {
            primal: Matrix3::zeros(),
            dual: Matrix3::zeros(),
        }
    }

    /// The identity.
    #[inline]
    pub fn identity() -> Self {
        DualMatrix {
            primal: Matrix3::identity(),
            dual: Matrix3::zeros(),
        }
    }

    /// `axial(AᵀB)`.
    #[inline(always)]
    pub fn axial_of_tr_mul(&self, b: &DualMatrix) -> DualVector {
        let axial = |a: &Matrix3<f64>, b: &Matrix3<f64>| {
            let ([a0, a1, a2], [b0, b1, b2]) = (&a.data.0, &b.data.0);
            let dot = |x: &[f64; 3], y: &[f64; 3]| x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
            0.5 * Vector3::new(
                dot(a2, b1) - dot(a1, b2),
                dot(a0, b2) - dot(a2, b0),
                dot(a1, b0) - dot(a0, b1),
            )
        };
        DualVector {
            primal: axial(&self.primal, &b.primal),
            dual: axial(&self.primal, &b.dual) + axial(&self.dual, &b.primal),
        }
    }

    /// `tr(AᵀB)`.
    #[inline(always)]
    pub fn inner(&self, b: &DualMatrix) -> Dual {
        Dual {
            primal: self.primal.dot(&b.primal),
            dual: self.primal.dot(&b.dual) + self.dual.dot(&b.primal),
        }
    }

    /// 6×6 matrix acting on twists `[dual; primal]`: `[A A°; 0 A]` (docs/theory.md, section 1.2).
    #[inline]
    pub fn to_twist_matrix(&self) -> Matrix6<f64> {
        let mut m = Matrix6::zeros();
        m.fixed_view_mut::<3, 3>(0, 0).copy_from(&self.primal);
        m.fixed_view_mut::<3, 3>(0, 3).copy_from(&self.dual);
        m.fixed_view_mut::<3, 3>(3, 3).copy_from(&self.primal);
        m
    }

    /// Adds the product of `m` and the matrix that acts on twists, `m [A A°; 0 A]`, to `sum`,
    /// sparing the zeros.
    #[inline(always)]
    pub fn add_product_to(&self, m: &Matrix6<f64>, sum: &mut Matrix6<f64>) {
        let sum = &mut sum.data.0;
        for j in 0..3 {
            let mut columns = [sum[j], sum[j + 3]];
            self.add_columns_of_product(m, j, &mut columns);
            [sum[j], sum[j + 3]] = columns;
        }
    }

    /// Adds columns `j` and `j + 3` of the product of `m` and the matrix that acts on twists,
    /// `m [A A°; 0 A]`, to these, sparing the zeros.
    #[inline(always)]
    pub fn add_columns_of_product(&self, m: &Matrix6<f64>, j: usize, sums: &mut [[f64; 6]; 2]) {
        let (m, [left, right]) = (&m.data.0, sums);
        for i in 0..3 {
            let (p, d) = (self.primal[(i, j)], self.dual[(i, j)]);
            for row in 0..6 {
                left[row] += m[i][row] * p;
                right[row] += m[i][row] * d + m[i + 3][row] * p;
            }
        }
    }

    /// 6×6 matrix that takes a twist `[dual; primal]` to a wrench `[primal; dual]`: `[0 A; A A°]`.
    #[inline(always)]
    pub fn to_stiffness_matrix(&self) -> Matrix6<f64> {
        let mut m = Matrix6::zeros();
        m.fixed_view_mut::<3, 3>(0, 3).copy_from(&self.primal);
        m.fixed_view_mut::<3, 3>(3, 0).copy_from(&self.primal);
        m.fixed_view_mut::<3, 3>(3, 3).copy_from(&self.dual);
        m
    }
}

impl<T: Scalar> DualVector<T> {
    /// Skew dual matrix `ã`.
    #[inline(always)]
    pub fn skew(&self) -> DualMatrix<T> {
        DualMatrix {
            primal: skew(&self.primal),
            dual: skew(&self.dual),
        }
    }

    /// `ã B`.
    #[inline(always)]
    pub fn skew_times(&self, b: &DualMatrix<T>) -> DualMatrix<T> {
        let dual = DualMatrix {
            primal: skew_times(&self.primal, &b.dual),
            dual: skew_times(&self.dual, &b.primal),
        };
        DualMatrix {
            primal: skew_times(&self.primal, &b.primal),
            dual: of_entries(&dual.primal, &dual.dual, |a, b| a + b),
        }
    }

    /// Inner product `aᵀb`.
    #[inline(always)]
    pub fn dot(&self, b: &DualVector<T>) -> Dual<T> {
        Dual {
            primal: dot(&self.primal, &b.primal),
            dual: dot(&self.primal, &b.dual) + dot(&self.dual, &b.primal),
        }
    }

    /// Vector product `a × b = ã b`.
    #[inline(always)]
    pub fn cross(&self, b: &DualVector<T>) -> DualVector<T> {
        let cross = |a: &Vector3<T>, b: &Vector3<T>| {
            Vector3::from_array_storage(ArrayStorage([cross(a.data.0[0], b.data.0[0])]))
        };
        let [left, right] = [cross(&self.primal, &b.dual), cross(&self.dual, &b.primal)];
        DualVector {
            primal: cross(&self.primal, &b.primal),
            dual: of_entries(&left, &right, |a, b| a + b),
        }
    }

    /// Outer product `a bᵀ`.
    #[inline(always)]
    pub fn outer(&self, b: &DualVector<T>) -> DualMatrix<T> {
        let left = outer_product(&self.primal, &b.dual);
        let right = outer_product(&self.dual, &b.primal);
        DualMatrix {
            primal: outer_product(&self.primal, &b.primal),
            dual: of_entries(&left, &right, |a, b| a + b),
        }
    }

    /// `2 a`.
    #[inline(always)]
    pub fn double(self) -> Self {
        self + self
    }

    /// Entry by entry.
    #[inline(always)]
    pub fn map<U: Copy>(&self, f: impl Fn(T) -> U) -> DualVector<U> {
        let of = |a: &Vector3<T>| {
            let [[x, y, z]] = a.data.0;
            Vector3::from_array_storage(ArrayStorage([[f(x), f(y), f(z)]]))
        };
        DualVector {
            primal: of(&self.primal),
            dual: of(&self.dual),
        }
    }
}

impl<T: Scalar> DualMatrix<T> {
    /// Transpose; the inverse of a dual rotation.
    #[inline(always)]
    pub fn transpose(&self) -> Self {
        DualMatrix {
            primal: transpose(&self.primal),
            dual: transpose(&self.dual),
        }
    }

    /// Product `AᵀB`.
    #[inline(always)]
    pub fn tr_mul(&self, b: &DualMatrix<T>) -> Self {
        self.transpose() * *b
    }

    /// `2 A`.
    #[inline(always)]
    pub fn double(self) -> Self {
        self + self
    }

    /// Trace.
    #[inline(always)]
    pub fn trace(&self) -> Dual<T> {
        Dual {
            primal: trace(&self.primal),
            dual: trace(&self.dual),
        }
    }

    /// Axial vector.
    #[inline(always)]
    pub fn axial(&self) -> DualVector<T> {
        DualVector {
            primal: axial(&self.primal),
            dual: axial(&self.dual),
        }
    }

    /// `tr(A) I − A`: `axial(ã A) = ½ (tr(A) I − A) a`.
    #[inline(always)]
    pub fn trace_minus(&self) -> Self {
        let t = self.trace();
        let mut difference = -*self;
        for i in 0..3 {
            let DualMatrix { primal, dual } = &mut difference;
            primal.data.0[i][i] = t.primal - self.primal.data.0[i][i];
            dual.data.0[i][i] = t.dual - self.dual.data.0[i][i];
        }
        difference
    }

    /// `(tr(A) I − A) b`.
    #[inline(always)]
    pub fn trace_minus_times(&self, b: &DualVector<T>) -> DualVector<T> {
        *b * self.trace() - *self * *b
    }

    /// `tr(A) I − Aᵀ`: `axial(A ã) = ½ (tr(A) I − Aᵀ) a`.
    #[inline(always)]
    pub fn trace_minus_transpose(&self) -> Self {
        self.transpose().trace_minus()
    }

    /// `A b̃`.
    #[inline(always)]
    pub fn times_skew(&self, b: &DualVector<T>) -> Self {
        let left = times_skew(&self.primal, &b.dual);
        let right = times_skew(&self.dual, &b.primal);
        DualMatrix {
            primal: times_skew(&self.primal, &b.primal),
            dual: of_entries(&left, &right, |a, b| a + b),
        }
    }

    /// Entry by entry.
    #[inline(always)]
    pub fn map<U: Copy>(&self, f: impl Fn(T) -> U) -> DualMatrix<U> {
        let of = |[x, y, z]: [T; 3]| [f(x), f(y), f(z)];
        let of = |a: &Matrix3<T>| {
            let [x, y, z] = a.data.0;
            Matrix3::from_array_storage(ArrayStorage([of(x), of(y), of(z)]))
        };
        DualMatrix {
            primal: of(&self.primal),
            dual: of(&self.dual),
        }
    }
}

/// `Ṽ`, the 6×6 matrix of a twist: `Ṽ W` is the dual cross product of both.
pub fn tilde(twist: &Vector6<f64>) -> Matrix6<f64> {
    DualVector::from_twist(twist).skew().to_twist_matrix()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn vector(seed: f64) -> DualVector {
        DualVector {
            primal: Vector3::new(seed.sin(), (2.0 * seed).cos(), (3.0 * seed).sin()),
            dual: Vector3::new((5.0 * seed).cos(), (7.0 * seed).sin(), (11.0 * seed).cos()),
        }
    }

    fn matrix(seed: f64) -> DualMatrix {
        vector(seed).outer(&vector(seed + 0.3))
            + vector(seed + 1.0).outer(&vector(seed + 1.3))
            + vector(seed + 2.0).skew()
    }

    fn assert_equal(a: DualVector, b: DualVector) {
        let d = a - b;
        assert!(d.primal.amax() < 1e-14 && d.dual.amax() < 1e-14, "{d:?}");
    }

    #[test]
    fn identities_hold_in_dual_algebra() {
        let (a, b, m) = (vector(0.7), vector(1.9), matrix(0.4));
        // (38a), (38b), (38c)
        assert_equal((a.skew() * m).axial(), m.trace_minus() * a * 0.5);
        assert_equal((m * a.skew()).axial(), m.trace_minus_transpose() * a * 0.5);
        assert_equal(
            (b.skew() * a.skew() * m).axial(),
            (m.transpose() * b).skew() * a * 0.5 - m.axial() * b.dot(&a),
        );
        // (38e)
        let trace = (a.skew() * m).trace() + a.dot(&m.axial()) * 2.0;
        assert!(trace.primal.abs() < 1e-14 && trace.dual.abs() < 1e-14);
    }

    #[test]
    fn parts_of_products_are_those_of_the_products() {
        let (a, m, other) = (vector(0.7), matrix(0.4), matrix(1.5));
        let by_skew = m.times_skew(&a) - m * a.skew();
        assert!(by_skew.primal.amax() < 1e-14 && by_skew.dual.amax() < 1e-14);
        let by_skew = a.skew_times(&m) - a.skew() * m;
        assert!(by_skew.primal.amax() < 1e-14 && by_skew.dual.amax() < 1e-14);
        assert_equal(m.trace_minus_times(&a), m.trace_minus() * a);
        assert_equal(a.cross(&vector(1.9)), a.skew() * vector(1.9));
        let product = m.transpose() * other;
        assert_equal(m.axial_of_tr_mul(&other), product.axial());
        let inner = m.inner(&other) + -product.trace();
        assert!(inner.primal.abs() < 1e-13 && inner.dual.abs() < 1e-13);
    }

    #[test]
    fn six_by_six_forms_agree_with_dual_products() {
        let (a, m) = (vector(0.2), matrix(1.1));
        let twist = m.to_twist_matrix() * a.to_twist() - (m * a).to_twist();
        assert!(twist.amax() < 1e-14);
        let wrench = m.to_stiffness_matrix() * a.to_twist() - (m * a).to_wrench();
        assert!(wrench.amax() < 1e-14);
        // The transpose of the twist matrix acts on wrenches as the transposed dual matrix.
        let dual =
            m.to_twist_matrix().transpose() * a.to_wrench() - (m.transpose() * a).to_wrench();
        assert!(dual.amax() < 1e-14);
    }
}
