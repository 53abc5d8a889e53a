//! Products of small matrices, written out. Those of nalgebra go through loops over strides, which
//! take ten times as long where the compiler does not see through them, as between crates.

use super::scalar::Scalar;
use nalgebra::{ArrayStorage, Matrix3, SMatrix, Vector3};

/// `A B`.
#[inline(always)]
pub fn product<T: Scalar, const ROWS: usize, const INNER: usize, const COLUMNS: usize>(
    a: &SMatrix<T, ROWS, INNER>,
    b: &SMatrix<T, INNER, COLUMNS>,
) -> SMatrix<T, ROWS, COLUMNS> {
    let mut c = [[a.data.0[0][0]; ROWS]; COLUMNS];
    for (c, b) in c.iter_mut().zip(&b.data.0) {
        *c = combination(&a.data.0, b);
    }
    SMatrix::from_array_storage(ArrayStorage(c))
}

/// `Aᵀ B`.
#[inline(always)]
pub fn transposed_product<
    T: Scalar,
    const ROWS: usize,
    const INNER: usize,
    const COLUMNS: usize,
>(
    a: &SMatrix<T, INNER, ROWS>,
    b: &SMatrix<T, INNER, COLUMNS>,
) -> SMatrix<T, ROWS, COLUMNS> {
    product(&transpose(a), b)
}

/// `A B + C D`.
#[inline(always)]
pub fn sum_of_products<T: Scalar, const COLUMNS: usize>(
    (a, b): (&Matrix3<T>, &SMatrix<T, 3, COLUMNS>),
    (c, d): (&Matrix3<T>, &SMatrix<T, 3, COLUMNS>),
) -> SMatrix<T, 3, COLUMNS> {
    of_entries(&product(a, b), &product(c, d), |x, y| x + y)
}

/// `a bᵀ`.
#[inline(always)]
pub fn outer_product<T: Scalar>(a: &Vector3<T>, b: &Vector3<T>) -> Matrix3<T> {
    let ([a], [[b0, b1, b2]]) = (&a.data.0, &b.data.0);
    let scaled = |b: T| [a[0] * b, a[1] * b, a[2] * b];
    columns([scaled(*b0), scaled(*b1), scaled(*b2)])
}

/// `Aᵀ`.
#[inline(always)]
pub fn transpose<T: Copy, const ROWS: usize, const COLUMNS: usize>(
    a: &SMatrix<T, ROWS, COLUMNS>,
) -> SMatrix<T, COLUMNS, ROWS> {
    let begun = [[a.data.0[0][0]; COLUMNS]; ROWS];
    let mut transposed = SMatrix::from_array_storage(ArrayStorage(begun));
    for j in 0..COLUMNS {
        for i in 0..ROWS {
            transposed.data.0[i][j] = a.data.0[j][i];
        }
    }
    transposed
}

/// Entry by entry.
#[inline(always)]
pub fn of_entries<T: Copy, const ROWS: usize, const COLUMNS: usize>(
    a: &SMatrix<T, ROWS, COLUMNS>,
    b: &SMatrix<T, ROWS, COLUMNS>,
    f: impl Fn(T, T) -> T,
) -> SMatrix<T, ROWS, COLUMNS> {
    let mut c = *a;
    for j in 0..COLUMNS {
        for i in 0..ROWS {
            c.data.0[j][i] = f(a.data.0[j][i], b.data.0[j][i]);
        }
    }
    c
}

#[inline(always)]
fn columns<T>(columns: [[T; 3]; 3]) -> Matrix3<T> {
    Matrix3::from_array_storage(ArrayStorage(columns))
}

/// The sum of columns, each times a number.
#[inline(always)]
fn combination<T: Scalar, const ROWS: usize, const COLUMNS: usize>(
    columns: &[[T; ROWS]; COLUMNS],
    x: &[T; COLUMNS],
) -> [T; ROWS] {
    let mut sum = columns[0];
    for i in 0..ROWS {
        sum[i] = columns[0][i] * x[0];
    }
    for j in 1..COLUMNS {
        for i in 0..ROWS {
            sum[i] = sum[i].plus_product(columns[j][i], x[j]);
        }
    }
    sum
}

/// `aᵀ b`.
#[inline(always)]
pub fn dot<T: Scalar>(a: &Vector3<T>, b: &Vector3<T>) -> T {
    let ([[a0, a1, a2]], [[b0, b1, b2]]) = (a.data.0, b.data.0);
    (a0 * b0).plus_product(a1, b1).plus_product(a2, b2)
}

/// Trace.
#[inline(always)]
pub fn trace<T: Scalar>(a: &Matrix3<T>) -> T {
    let [x, y, z] = &a.data.0;
    x[0] + y[1] + z[2]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn products_are_those_of_nalgebra() {
        let a = Matrix3::from_fn(|i, j| (1.0 + i as f64 + 3.7 * j as f64).sin());
        let b = Matrix3::from_fn(|i, j| (2.0 - i as f64 + 1.9 * j as f64).cos());
        let c = a + b.transpose();
        let x = Vector3::new(0.3, -1.2, 2.5);
        // Sums of three products, each below 3.
        let rounding = 4e-15;
        assert!((product(&a, &b) - a * b).amax() < rounding);
        assert!((transposed_product(&a, &b) - a.transpose() * b).amax() < rounding);
        let sum = sum_of_products((&a, &b), (&c, &a));
        assert!((sum - (a * b + c * a)).amax() < 2.0 * rounding);
        assert!((outer_product(&x, &(x * 2.0)) - x * x.transpose() * 2.0).amax() < 2.0 * rounding);
        assert!((product(&a, &x) - a * x).amax() < rounding);
        assert!((transposed_product(&a, &x) - a.transpose() * x).amax() < rounding);
    }
}
