//! Block Arnoldi's method on the inverted linearisation of the quadratic pencil.
//!
//! With `y = s x / ω` (`ω` a unit of frequency) the pencil is linear in `z = [x; y]`, and the map
//! `z ↦ z'`
//!
//! ```text
//! u = −Q(σ)⁻¹ (C x + M (ω y + σ x)),     x' = u,     y' = (x + σ u) / ω
//! ```
//!
//! has the eigenvalues `θ = 1/(s − σ)`. Constraints have infinite `s`, so `θ = 0`: they are far
//! from all that is sought. For a complex shift the real part of the map serves, with
//! `θ = ½ (1/(s − σ) + 1/(s − σ̄))`. The state holds only unknowns that `C` or `M` know of. See
//! docs/theory.md, section 11.4.

use crate::error::{Error, ErrorKind, Result};
use crate::solve::linear::eigenvalues::eigenvectors;
use crate::solve::modes::pencil::{C64, Inverse, Pencil};
use faer::Mat;
use faer::linalg::solvers::{PartialPivLu, Solve};

/// A new direction smaller than this, relative to what it was before, is rounding.
const DEPENDENT: f64 = 1e-11;
/// Relative residual in the space of an eigenvector that needs no improvement.
const INSIDE: f64 = 1e-10;
/// Relative error that equal eigenvalues may have where they are first found.
const ROUGH: f64 = 1e-6;

/// The map `z ↦ z'`.
pub(crate) struct Map<'a> {
    pub pencil: &'a Pencil,
    pub inverse: &'a Inverse,
    /// Unit of frequency.
    pub unit: f64,
    /// Unknowns in `x`, and those in `y`.
    pub x: &'a [usize],
    pub y: &'a [usize],
}

impl Map<'_> {
    /// `−(C x + M (ω y + σ x))` over all unknowns.
    fn right_side(&self, z: &[C64]) -> Vec<C64> {
        let size = self.pencil.size();
        let (zx, zy) = z.split_at(self.x.len());
        let (mut x, mut y) = (vec![C64::default(); size], vec![C64::default(); size]);
        for (&i, value) in self.x.iter().zip(zx) {
            x[i] = *value;
            y[i] = self.inverse.shift() * value;
        }
        for (&i, value) in self.y.iter().zip(zy) {
            y[i] += value * self.unit;
        }
        let mut b = vec![C64::default(); size];
        let minus = C64::from(-1.0);
        self.pencil
            .add_product(&self.pencil.matrices.damping, minus, &x, &mut b);
        self.pencil
            .add_product(&self.pencil.matrices.mass, minus, &y, &mut b);
        b
    }

    /// `u` over all unknowns, and `z'`.
    pub fn image(&self, z: &[C64]) -> Result<(Vec<C64>, Vec<C64>)> {
        self.pencil.workers.pulse()?;
        let u = self
            .inverse
            .solve(self.pencil, &self.right_side(z))
            .ok_or_else(overflow)?;
        let mut x = vec![C64::default(); self.pencil.size()];
        for (&i, value) in self.x.iter().zip(z) {
            x[i] = *value;
        }
        let shift = self.inverse.shift();
        let moved = self.x.iter().map(|&i| u[i]);
        let rates = self.y.iter().map(|&i| (x[i] + shift * u[i]) / self.unit);
        let next = moved.chain(rates).collect();
        Ok((u, next))
    }

    /// Real part of the image of a real state.
    fn apply(&self, z: &[f64]) -> Result<Vec<f64>> {
        Ok(self.image(&complex(z))?.1.iter().map(|z| z.re).collect())
    }
}

pub(crate) fn overflow() -> Error {
    Error::new(
        ErrorKind::Overflow,
        "modes: the result is too large to be a number",
    )
}

/// Numbers that look random, always the same sequence.
pub(crate) struct Random(u64);

impl Random {
    pub fn new(seed: usize) -> Self {
        Random(0x9e37_79b9_7f4a_7c15 ^ seed as u64)
    }

    /// Uniform in −1 to 1.
    pub fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}

/// An orthonormal basis, and the map in it as far as it was applied.
pub(crate) struct Space {
    pub basis: Vec<Vec<f64>>,
    /// Column `j`: the image of basis vector `j`, in the basis.
    pub columns: Vec<Vec<f64>>,
    random: Random,
}

impl Space {
    pub fn empty() -> Self {
        Space {
            basis: Vec::new(),
            columns: Vec::new(),
            random: Random::new(0),
        }
    }

    /// Takes from `w` its part in the basis; returns the coefficients.
    pub fn project_out(&self, w: &mut [f64]) -> Vec<f64> {
        let mut coefficients = vec![0.0; self.basis.len()];
        // Twice is enough.
        for _ in 0..2 {
            let parts: Vec<f64> = self.basis.iter().map(|v| dot(v, w)).collect();
            for (v, part) in self.basis.iter().zip(&parts) {
                w.iter_mut().zip(v).for_each(|(w, v)| *w -= part * v);
            }
            coefficients
                .iter_mut()
                .zip(&parts)
                .for_each(|(c, p)| *c += p);
        }
        coefficients
    }

    /// Applies the map to the next basis vector.
    pub fn grow(&mut self, map: &Map) -> Result<()> {
        let mut w = map.apply(&self.basis[self.columns.len()])?;
        let before = norm(&w);
        let mut column = self.project_out(&mut w);
        let size = norm(&w);
        if size > DEPENDENT * before {
            w.iter_mut().for_each(|w| *w /= size);
            self.basis.push(w);
            column.push(size);
        }
        self.columns.push(column);
        Ok(())
    }

    /// Adds a random vector that obeys the constraints; `false` if there is no more.
    pub fn seed(&mut self, start: &Map) -> Result<bool> {
        let size = start.x.len() + start.y.len();
        let mut w: Vec<f64> = (0..size).map(|_| self.random.next()).collect();
        for _ in 0..2 {
            w = start.apply(&w)?;
            let size = norm(&w);
            if size == 0.0 {
                return Ok(false);
            }
            w.iter_mut().for_each(|w| *w /= size);
        }
        self.project_out(&mut w);
        let rest = norm(&w);
        if rest < 1e3 * DEPENDENT {
            return Ok(false);
        }
        w.iter_mut().for_each(|w| *w /= rest);
        self.basis.push(w);
        Ok(true)
    }

    /// Eigenvalues `θ` of the map in the space with their vectors, the largest first, up to the
    /// first whose relative residual is more than `most`; and the size of that one, zero if there
    /// is none.
    pub fn ritz(&self, most: f64) -> Result<(Vec<Ritz>, f64)> {
        let size = self.columns.len();
        let at = |i: usize, j: usize| self.columns[j].get(i).copied().unwrap_or(0.0);
        let square = Mat::from_fn(size, size, at);
        let (values, vectors) = eigenvectors(&square).ok_or_else(|| {
            Error::new(
                ErrorKind::Overflow,
                "modes: the small eigenproblem cannot be solved",
            )
        })?;
        let mut order: Vec<usize> = (0..size)
            .filter(|&j| values[j].norm().is_finite() && values[j].norm() > 0.0)
            .collect();
        order.sort_by(|&a, &b| values[b].norm().total_cmp(&values[a].norm()));
        let mut found = Vec::new();
        for j in order {
            let mut theta = values[j];
            let mut y: Vec<C64> = (0..size).map(|i| vectors[(i, j)]).collect();
            let (mut inside, mut outside) = self.residual(theta, &mut y);
            // The decomposition is careless about equal eigenvalues and their vectors.
            if inside.is_nan() || inside > INSIDE {
                (theta, y) = inverse_iteration(&square, theta, j);
                (inside, outside) = self.residual(theta, &mut y);
            }
            let residual = if inside <= INSIDE { outside } else { inside };
            if residual > most {
                return Ok((found, values[j].norm()));
            }
            if residual.is_finite() {
                found.push(Ritz { theta, residual, y });
            }
        }
        Ok((found, 0.0))
    }

    /// Makes `y` a unit vector; what `A y − θ y` has in the space and outside it, relative to `θ`.
    fn residual(&self, theta: C64, y: &mut [C64]) -> (f64, f64) {
        let size = length(y);
        y.iter_mut().for_each(|y| *y /= size);
        let mut rest = vec![C64::default(); self.basis.len()];
        for (y, (i, column)) in y.iter().zip(self.columns.iter().enumerate()) {
            rest[i] -= theta * y;
            rest.iter_mut()
                .zip(column)
                .for_each(|(rest, a)| *rest += y * *a);
        }
        let (inside, outside) = rest.split_at(y.len());
        (
            length(inside) / theta.norm(),
            length(outside) / theta.norm(),
        )
    }

    /// A vector of the space.
    pub fn combine(&self, y: &[C64]) -> Vec<C64> {
        let mut z = vec![C64::default(); self.basis[0].len()];
        for (v, y) in self.basis.iter().zip(y) {
            z.iter_mut().zip(v).for_each(|(z, v)| *z += y * *v);
        }
        z
    }
}

/// An eigenvalue of the map in a subspace.
pub(crate) struct Ritz {
    pub theta: C64,
    /// Relative to `θ`.
    pub residual: f64,
    pub y: Vec<C64>,
}

/// An eigenpair of `matrix` next to `theta` from a start that `seed` chooses: of equal eigenvalues
/// each has its own.
fn inverse_iteration(matrix: &Mat<f64>, theta: C64, seed: usize) -> (C64, Vec<C64>) {
    let size = matrix.nrows();
    let shift = theta * (1.0 + 1e-13);
    let shifted = Mat::from_fn(size, size, |i, j| {
        C64::from(matrix[(i, j)]) - if i == j { shift } else { C64::default() }
    });
    let factors = PartialPivLu::new(shifted.as_ref());
    let mut random = Random::new(seed + 1);
    let mut y = Mat::from_fn(size, 1, |_, _| C64::new(random.next(), random.next()));
    for _ in 0..2 {
        factors.solve_in_place(y.as_mut());
        let size = length(y.col_as_slice(0));
        y.col_as_slice_mut(0).iter_mut().for_each(|y| *y /= size);
    }
    let y = y.col_as_slice(0).to_vec();
    let image = |i: usize| -> C64 { (0..size).map(|k| y[k] * matrix[(i, k)]).sum() };
    let quotient: C64 = (0..size).map(|i| y[i].conj() * image(i)).sum();
    let near = (quotient - theta).norm() <= ROUGH * theta.norm();
    (if near { quotient } else { theta }, y)
}

pub(crate) fn complex(real: &[f64]) -> Vec<C64> {
    real.iter().map(|x| C64::from(*x)).collect()
}

fn length(y: &[C64]) -> f64 {
    y.iter().map(|y| y.norm_sqr()).sum::<f64>().sqrt()
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

pub(crate) fn norm(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}
