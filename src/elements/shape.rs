//! Quadrature points and Lagrange shape functions on `[−1, 1]`.
//! See docs/theory.md, section 6.2.

/// Legendre polynomial `P_n` and its derivative at `x`.
fn legendre(n: usize, x: f64) -> (f64, f64) {
    let (mut previous, mut current) = (1.0, x);
    if n == 0 {
        return (1.0, 0.0);
    }
    let (mut d_previous, mut d_current) = (0.0, 1.0);
    for k in 1..n {
        let k = k as f64;
        let next = ((2.0 * k + 1.0) * x * current - k * previous) / (k + 1.0);
        let d_next = d_previous + (2.0 * k + 1.0) * current;
        (previous, current) = (current, next);
        (d_previous, d_current) = (d_current, d_next);
    }
    (current, d_current)
}

/// Points and weights of the `n`-point Gauss–Legendre rule, in ascending order.
pub fn gauss_legendre(n: usize) -> Vec<(f64, f64)> {
    (0..n)
        .map(|i| {
            let mut x = -(std::f64::consts::PI * (i as f64 + 0.75) / (n as f64 + 0.5)).cos();
            for _ in 0..20 {
                let (p, d) = legendre(n, x);
                x -= p / d;
            }
            let d = legendre(n, x).1;
            (x, 2.0 / ((1.0 - x * x) * d * d))
        })
        .collect()
}

/// The `n ≥ 2` Gauss–Lobatto–Legendre points, in ascending order: where a beam's nodes lie.
pub fn lobatto_points(n: usize) -> Vec<f64> {
    let degree = n - 1;
    let mut points: Vec<f64> = (0..n)
        .map(|i| -(std::f64::consts::PI * i as f64 / degree as f64).cos())
        .collect();
    let d = degree as f64;
    for x in &mut points[1..n - 1] {
        // Newton on P'_d, with (1 − x²) P''= 2 x P' − d (d + 1) P.
        for _ in 0..20 {
            let (p, dp) = legendre(degree, *x);
            let second = (2.0 * *x * dp - d * (d + 1.0) * p) / (1.0 - *x * *x);
            *x -= dp / second;
        }
    }
    points
}

/// Values and derivatives at `x` of the Lagrange polynomials on `points`.
pub fn shape_functions(points: &[f64], x: f64) -> Vec<(f64, f64)> {
    (0..points.len())
        .map(|a| {
            let others = || points.iter().enumerate().filter(move |(b, _)| *b != a);
            let factor = |b: f64| (x - b) / (points[a] - b);
            let value = others().map(|(_, &p)| factor(p)).product();
            // Product rule, without dividing by factors that may vanish.
            let slope = others()
                .map(|(b, &p)| {
                    let rest: f64 = others()
                        .filter(|(c, _)| *c != b)
                        .map(|(_, &q)| factor(q))
                        .product();
                    rest / (points[a] - p)
                })
                .sum();
            (value, slope)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gauss_rules_integrate_polynomials_exactly() {
        for n in 1..=20 {
            let rule = gauss_legendre(n);
            for power in 0..2 * n {
                let sum: f64 = rule.iter().map(|(x, w)| w * x.powi(power as i32)).sum();
                let exact = if power % 2 == 0 {
                    2.0 / (power + 1) as f64
                } else {
                    0.0
                };
                assert!((sum - exact).abs() < 1e-14, "{n} {power} {sum}");
            }
        }
    }

    #[test]
    fn shape_functions_on_lobatto_points_reproduce_polynomials() {
        for n in 2..=18 {
            let points = lobatto_points(n);
            assert_eq!((points[0], points[n - 1]), (-1.0, 1.0));
            for x in [-1.0, -0.3, 0.1, points[n / 2], 1.0] {
                let shapes = shape_functions(&points, x);
                let power = n as i32 - 1;
                let value: f64 = shapes
                    .iter()
                    .zip(&points)
                    .map(|(s, p)| s.0 * p.powi(power))
                    .sum();
                let slope: f64 = shapes
                    .iter()
                    .zip(&points)
                    .map(|(s, p)| s.1 * p.powi(power))
                    .sum();
                assert!((value - x.powi(power)).abs() < 1e-13);
                assert!((slope - f64::from(power) * x.powi(power - 1)).abs() < 2e-12);
            }
        }
        // The interior points of five are at ±√(3/7).
        assert!((lobatto_points(5)[3] - (3.0f64 / 7.0).sqrt()).abs() < 1e-15);
    }

    #[test]
    fn lobatto_points_are_where_the_derivative_vanishes() {
        for n in 3..=25 {
            let degree = n - 1;
            for x in &lobatto_points(n)[1..degree] {
                let (p, dp) = legendre(degree, *x);
                let d = degree as f64;
                let second = (2.0 * x * dp - d * (d + 1.0) * p) / (1.0 - x * x);
                // How far off it is: rounding of the recurrence.
                assert!((dp / second).abs() < 1e-15, "{n}: {x} {:e}", dp / second);
            }
        }
    }
}
