//! Products of small matrices, written out. Those of nalgebra go through loops over strides, which
//! take ten times as long where the compiler does not see through them, as between crates.

use nalgebra::{ArrayStorage, Matrix3, SMatrix, Vector3};

/// `A B`.
#[inline(always)]
pub fn product<const ROWS: usize, const INNER: usize, const COLUMNS: usize>(
    a: &SMatrix<f64, ROWS, INNER>,
    b: &SMatrix<f64, INNER, COLUMNS>,
) -> SMatrix<f64, ROWS, COLUMNS> {
    let mut c = SMatrix::zeros();
    for j in 0..COLUMNS {
        c.data.0[j] = combination(&a.data.0, &b.data.0[j]);
    }
    c
}

/// `Aᵀ B`.
#[inline(always)]
pub fn transposed_product<const ROWS: usize, const INNER: usize, const COLUMNS: usize>(
    a: &SMatrix<f64, INNER, ROWS>,
    b: &SMatrix<f64, INNER, COLUMNS>,
) -> SMatrix<f64, ROWS, COLUMNS> {
    product(&transpose(a), b)
}

/// `A B + C D`.
#[inline(always)]
pub fn sum_of_products<const COLUMNS: usize>(
    (a, b): (&Matrix3<f64>, &SMatrix<f64, 3, COLUMNS>),
    (c, d): (&Matrix3<f64>, &SMatrix<f64, 3, COLUMNS>),
) -> SMatrix<f64, 3, COLUMNS> {
    of_entries(&product(a, b), &product(c, d), |x, y| x + y)
}

/// `a bᵀ`.
#[inline(always)]
pub fn outer_product(a: &Vector3<f64>, b: &Vector3<f64>) -> Matrix3<f64> {
    let ([a], [[b0, b1, b2]]) = (&a.data.0, &b.data.0);
    let scaled = |b: f64| [a[0] * b, a[1] * b, a[2] * b];
    columns([scaled(*b0), scaled(*b1), scaled(*b2)])
}

/// `Aᵀ`.
#[inline(always)]
pub fn transpose<const ROWS: usize, const COLUMNS: usize>(
    a: &SMatrix<f64, ROWS, COLUMNS>,
) -> SMatrix<f64, COLUMNS, ROWS> {
    let mut transposed = SMatrix::zeros();
    for j in 0..COLUMNS {
        for i in 0..ROWS {
            transposed.data.0[i][j] = a.data.0[j][i];
        }
    }
    transposed
}

/// Entry by entry.
#[inline(always)]
pub fn of_entries<const ROWS: usize, const COLUMNS: usize>(
    a: &SMatrix<f64, ROWS, COLUMNS>,
    b: &SMatrix<f64, ROWS, COLUMNS>,
    f: impl Fn(f64, f64) -> f64,
) -> SMatrix<f64, ROWS, COLUMNS> {
    let mut c = *a;
    for j in 0..COLUMNS {
        for i in 0..ROWS {
            c.data.0[j][i] = f(a.data.0[j][i], b.data.0[j][i]);
        }
    }
    c
}

#[inline(always)]
fn columns(columns: [[f64; 3]; 3]) -> Matrix3<f64> {
    Matrix3::from_array_storage(ArrayStorage(columns))
}

/// The sum of columns, each times a number.
#[inline(always)]
fn combination<const ROWS: usize, const COLUMNS: usize>(
    columns: &[[f64; ROWS]; COLUMNS],
    x: &[f64; COLUMNS],
) -> [f64; ROWS] {
    let mut sum = [0.0; ROWS];
    for i in 0..ROWS {
        sum[i] = columns[0][i] * x[0];
    }
    for j in 1..COLUMNS {
        for i in 0..ROWS {
            sum[i] += columns[j][i] * x[j];
        }
    }
    sum
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
