//! Eigenvalues of the quadratic pencil near a shift: band Arnoldi on its inverted linearisation.
//!
//! With `y = s x / ω` (`ω` a unit of frequency) the pencil is linear in `z = [x; y]`, and the map `z ↦ z'`
//!
//! ```text
//! u = −Q(σ)⁻¹ (C x + M (ω y + σ x)),     x' = u,     y' = (x + σ u) / ω
//! ```
//!
//! has the eigenvalues `θ = 1/(s − σ)`. Constraints have infinite `s`, so `θ = 0`: they are far from all
//! that is sought. For a complex shift the real part of the map serves, with
//! `θ = ½ (1/(s − σ) + 1/(s − σ̄))`. The state holds only unknowns that `C` or `M` know of.

use super::pencil::{C64, Inverse, Pencil};
use crate::error::{Error, ErrorKind, Result};
use faer::Mat;
use faer::linalg::solvers::Eigen;

/// Vectors that the space grows from at once: eigenvalues of this multiplicity are found at once.
const BLOCK: usize = 4;
/// Vectors added when all seems found, to find what hides behind equal eigenvalues.
const SECOND_BLOCK: usize = 2;
/// Steps taken with these at least.
const SECOND_STEPS: usize = 16;
/// A new direction smaller than this, relative to what it was before, is rounding.
const DEPENDENT: f64 = 1e-11;
/// Relative residual of an eigenvalue that is found.
const CONVERGED: f64 = 1e-13;

/// Relative residual of `K x` below which `x` is free to move.
pub(super) const FREE: f64 = 1e-13;
/// Steps that leave nothing but free motions.
const FREE_STEPS: usize = 20;

/// An eigenvalue with its vector of all unknowns.
pub(super) struct EigenPair {
    pub value: C64,
    pub vector: Vec<C64>,
}

/// Which eigenvalues are sought.
#[derive(Debug, Clone, Copy)]
pub(super) enum Target {
    /// Those of least size.
    Smallest,
    /// Those nearest to `iω`.
    Near(f64),
}

impl Target {
    /// What is to be small.
    pub fn distance(self, s: C64) -> f64 {
        match self {
            Target::Smallest => s.norm(),
            Target::Near(frequency) => {
                (C64::new(s.re, s.im.abs()) - C64::new(0.0, frequency)).norm()
            }
        }
    }
}

/// The map `z ↦ z'`.
struct Map<'a> {
    pencil: &'a Pencil,
    inverse: &'a Inverse,
    /// Unit of frequency.
    unit: f64,
    /// Unknowns in `x`, and those in `y`.
    x: &'a [usize],
    y: &'a [usize],
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

    fn apply(&self, z: &[f64]) -> Result<Vec<f64>> {
        let complex: Vec<C64> = z.iter().map(|z| C64::from(*z)).collect();
        let u = self
            .inverse
            .solve(self.pencil, &self.right_side(&complex))
            .ok_or_else(overflow)?;
        let mut next: Vec<f64> = self.x.iter().map(|&i| u[i].re).collect();
        let mut x = vec![0.0; self.pencil.size()];
        for (&i, value) in self.x.iter().zip(z) {
            x[i] = *value;
        }
        let shift = self.inverse.shift();
        next.extend(
            self.y
                .iter()
                .map(|&i| (x[i] + (shift * u[i]).re) / self.unit),
        );
        Ok(next)
    }

    /// All unknowns of an eigenvector, from its state.
    fn vector(&self, s: C64, z: &[C64]) -> Result<Vec<C64>> {
        let u = self
            .inverse
            .solve(self.pencil, &self.right_side(z))
            .ok_or_else(overflow)?;
        Ok(u.iter().map(|u| u * (s - self.inverse.shift())).collect())
    }
}

fn overflow() -> Error {
    Error::new(
        ErrorKind::Overflow,
        "modes: the result is too large to be a number",
    )
}

/// An orthonormal basis, and the map in it as far as it was applied.
struct Space {
    basis: Vec<Vec<f64>>,
    /// Column `j`: the image of basis vector `j`, in the basis.
    columns: Vec<Vec<f64>>,
    random: u64,
}

impl Space {
    fn empty() -> Self {
        Space {
            basis: Vec::new(),
            columns: Vec::new(),
            random: 0x9e37_79b9_7f4a_7c15,
        }
    }

    /// Takes from `w` its part in the basis; returns the coefficients.
    fn project_out(&self, w: &mut [f64]) -> Vec<f64> {
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
    fn grow(&mut self, map: &Map) -> Result<()> {
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
    fn seed(&mut self, start: &Map) -> Result<bool> {
        let size = start.x.len() + start.y.len();
        let mut w: Vec<f64> = (0..size).map(|_| self.next_random()).collect();
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

    /// Uniform in −1 to 1, always the same sequence.
    fn next_random(&mut self) -> f64 {
        self.random ^= self.random << 13;
        self.random ^= self.random >> 7;
        self.random ^= self.random << 17;
        (self.random >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    /// Eigenvalues `θ` of the map in the space, with their vectors and relative residuals.
    fn ritz(&self) -> Result<Vec<Ritz>> {
        let size = self.columns.len();
        let at = |i: usize, j: usize| self.columns[j].get(i).copied().unwrap_or(0.0);
        let square = Mat::from_fn(size, size, at);
        let eigen = Eigen::new_from_real(square.as_ref()).map_err(|_| {
            Error::new(
                ErrorKind::Overflow,
                "modes: the small eigenproblem cannot be solved",
            )
        })?;
        let mut found = Vec::with_capacity(size);
        for j in 0..size {
            let theta = eigen.S()[j];
            let mut y: Vec<C64> = (0..size).map(|i| eigen.U()[(i, j)]).collect();
            let length = y.iter().map(|y| y.norm_sqr()).sum::<f64>().sqrt();
            if !(length > 0.0 && theta.norm().is_finite() && length.is_finite()) {
                continue;
            }
            y.iter_mut().for_each(|y| *y /= length);
            let mut residual = 0.0;
            for i in size..self.basis.len() {
                let rest: C64 = y.iter().enumerate().map(|(k, y)| y * at(i, k)).sum();
                residual += rest.norm_sqr();
            }
            found.push(Ritz {
                theta,
                residual: residual.sqrt() / theta.norm(),
                y,
            });
        }
        found.sort_by(|a, b| b.theta.norm().total_cmp(&a.theta.norm()));
        Ok(found)
    }

    /// A vector of the space.
    fn combine(&self, y: &[C64]) -> Vec<C64> {
        let mut z = vec![C64::default(); self.basis[0].len()];
        for (v, y) in self.basis.iter().zip(y) {
            z.iter_mut().zip(v).for_each(|(z, v)| *z += y * *v);
        }
        z
    }
}

/// An eigenvalue of the map in a subspace.
struct Ritz {
    theta: C64,
    residual: f64,
    y: Vec<C64>,
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn norm(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}

/// The search for eigenvalues of one pencil.
pub(super) struct Search<'a> {
    pencil: &'a Pencil,
    x: Vec<usize>,
    y: Vec<usize>,
    highest: f64,
    /// Inverse at the highest frequency, to make vectors obey the constraints with little loss of high
    /// modes.
    cleaner: Option<Inverse>,
}

/// Eigenvalues found, and whether they are all that were sought.
pub(super) struct Found {
    pub pairs: Vec<EigenPair>,
    /// Whether the wanted number was found, or there are no more.
    pub complete: bool,
}

impl<'a> Search<'a> {
    pub fn new(pencil: &'a Pencil) -> Result<Self> {
        let (x, y) = pencil.dynamic_unknowns();
        let highest = pencil.highest_frequency();
        let cleaner = Inverse::new(pencil, C64::from(highest))?;
        Ok(Search {
            pencil,
            x,
            y,
            highest,
            cleaner,
        })
    }

    /// About the highest frequency.
    pub fn highest(&self) -> f64 {
        self.highest
    }

    /// A shift near the lowest frequencies but not zero, so that free motions do no harm.
    fn shift_for_smallest(&self) -> Result<f64> {
        let mut shift = 1e-3 * self.highest;
        for _ in 0..4 {
            let Some(inverse) = Inverse::new(self.pencil, C64::from(shift))? else {
                shift *= 1.37;
                continue;
            };
            let map = self.map(&inverse, shift);
            let mut space = self.space()?;
            for _ in 0..6 * BLOCK {
                if space.columns.len() < space.basis.len() {
                    space.grow(&map)?;
                }
            }
            // Roughly the lowest that is no free motion.
            let lowest = space
                .ritz()?
                .iter()
                .filter(|r| r.residual < 1e-2)
                .map(|r| (C64::from(shift) + r.theta.inv()).norm())
                .filter(|s| *s > 1e-4 * shift && *s > 1e-7 * self.highest)
                .fold(f64::INFINITY, f64::min);
            if !lowest.is_finite() {
                break;
            }
            let better = 0.314 * lowest;
            let done = better > 0.1 * shift;
            shift = better;
            if done {
                break;
            }
        }
        Ok(shift)
    }

    fn map<'b>(&'b self, inverse: &'b Inverse, unit: f64) -> Map<'b> {
        Map {
            pencil: self.pencil,
            inverse,
            unit,
            x: &self.x,
            y: &self.y,
        }
    }

    /// A space of random vectors that obey the constraints.
    fn space(&self) -> Result<Space> {
        let mut space = Space::empty();
        self.seed(&mut space, BLOCK)?;
        Ok(space)
    }

    fn seed(&self, space: &mut Space, count: usize) -> Result<bool> {
        let Some(cleaner) = &self.cleaner else {
            return Ok(false);
        };
        let start = self.map(cleaner, self.highest);
        let mut any = false;
        for _ in 0..count {
            any |= space.seed(&start)?;
        }
        Ok(any)
    }

    /// Finds `count` modes or more, if there are: twice as many eigenvalues, as most are conjugate pairs.
    ///
    /// # Errors
    /// If memory runs out, or numbers overflow.
    pub fn run(&self, target: Target, count: usize) -> Result<Found> {
        let shift = match target {
            Target::Smallest => C64::from(self.shift_for_smallest()?),
            Target::Near(frequency) => C64::new(0.0, frequency),
        };
        // Off an eigenvalue that is hit by chance.
        let mut inverse = None;
        for disturbance in [1.0, 1.003, 0.9917] {
            inverse = Inverse::new(self.pencil, shift * disturbance)?;
            if inverse.is_some() {
                break;
            }
        }
        let Some(inverse) = inverse else {
            return Ok(Found {
                pairs: Vec::new(),
                complete: false,
            });
        };
        let map = self.map(&inverse, shift.norm());
        let mut space = self.space()?;
        let most = (240 + 12 * count).min(self.x.len() + self.y.len());
        let (mut next_check, mut verified_at) = (3 * BLOCK, None);
        loop {
            let exhausted =
                space.columns.len() == space.basis.len() && !self.seed(&mut space, SECOND_BLOCK)?;
            let size = space.columns.len();
            if size >= next_check || exhausted || size >= most {
                let found = self.found(&map, &space, target, exhausted)?;
                let enough = found.len() >= 2 * count;
                if exhausted || size >= most {
                    let complete = exhausted || enough;
                    return self.pairs(&map, &space, found, complete);
                }
                match (enough, verified_at) {
                    (true, None) => {
                        self.seed(&mut space, SECOND_BLOCK)?;
                        verified_at = Some(size + SECOND_STEPS);
                    }
                    (true, Some(at)) if size >= at => {
                        return self.pairs(&map, &space, found, true);
                    }
                    _ => {}
                }
                next_check = size + (size / 4).max(BLOCK);
            }
            if !exhausted {
                space.grow(&map)?;
            }
        }
    }

    /// Converged eigenvalues that nothing nearer to the target can precede, nearest first; both of each
    /// conjugate pair.
    fn found(
        &self,
        map: &Map,
        space: &Space,
        target: Target,
        exhausted: bool,
    ) -> Result<Vec<(C64, Vec<C64>)>> {
        let mut candidates = Vec::new();
        // What is not converged is no larger than this.
        let mut open = 0.0;
        for ritz in space.ritz()? {
            let converged = ritz.residual <= CONVERGED;
            if !converged && !exhausted {
                open = ritz.theta.norm();
                break;
            }
            if converged && ritz.theta.norm() > 0.0 {
                candidates.push(ritz);
            }
        }
        let sigma = map.inverse.shift();
        let mut found = Vec::new();
        for ritz in candidates {
            let s = self.eigenvalue(map, space, &ritz);
            let distance = target.distance(s);
            let safe = match target {
                Target::Smallest => distance <= 1.0 / open - sigma.norm(),
                Target::Near(frequency) => {
                    distance >= frequency
                        || 0.5 * (1.0 / distance - 1.0 / (2.0 * frequency - distance)) >= open
                }
            };
            // Constraints are infinitely far.
            let finite = s.norm() < 1e3 * self.highest;
            if (safe || open == 0.0) && finite {
                found.push((s, ritz.y));
            }
        }
        found.sort_by(|a, b| target.distance(a.0).total_cmp(&target.distance(b.0)));
        Ok(found)
    }

    /// `s` from `θ`.
    fn eigenvalue(&self, map: &Map, space: &Space, ritz: &Ritz) -> C64 {
        let sigma = map.inverse.shift();
        if sigma.im == 0.0 {
            return sigma + ritz.theta.inv();
        }
        // θ s² − (2θ Re σ + 1) s + θ|σ|² + Re σ = 0; of its roots that which y = s x / ω tells.
        let z = space.combine(&ritz.y);
        let (zx, zy) = z.split_at(self.x.len());
        let (mut product, mut square) = (C64::default(), 0.0);
        let mut at = 0;
        for (&i, y) in self.y.iter().zip(zy) {
            while self.x[at] != i {
                at += 1;
            }
            product += zx[at].conj() * y;
            square += zx[at].norm_sqr();
        }
        let rough = product * map.unit / square;
        let theta = ritz.theta;
        let half = theta * sigma.re + 0.5;
        let root = (half * half - theta * (theta * sigma.norm_sqr() + sigma.re)).sqrt();
        let roots = [(half + root) / theta, (half - root) / theta];
        if !rough.norm().is_finite() || (roots[0] - rough).norm() < (roots[1] - rough).norm() {
            roots[0]
        } else {
            roots[1]
        }
    }

    /// Orthonormal vectors of the null space of `K`.
    ///
    /// `Q(σ)⁻¹ (σ C + σ² M)` keeps them, and shrinks all others.
    pub fn free_motions(&self) -> Result<Vec<Vec<f64>>> {
        let shift = self.shift_for_smallest()?;
        let mut free = Space::empty();
        let Some(inverse) = Inverse::new(self.pencil, C64::from(shift))? else {
            return Ok(Vec::new());
        };
        let (matrices, size) = (&self.pencil.matrices, self.pencil.size());
        while free.basis.len() < self.x.len() {
            let mut w: Vec<f64> = (0..size).map(|_| free.next_random()).collect();
            for _ in 0..FREE_STEPS {
                let old: Vec<C64> = w.iter().map(|w| C64::from(*w)).collect();
                let mut b = vec![C64::default(); size];
                let (first, second) = (C64::from(shift), C64::from(shift * shift));
                self.pencil
                    .add_product(&matrices.damping, first, &old, &mut b);
                self.pencil
                    .add_product(&matrices.mass, second, &old, &mut b);
                let next = inverse.solve(self.pencil, &b).ok_or_else(overflow)?;
                w = next.iter().map(|x| x.re).collect();
                free.project_out(&mut w);
                let length = norm(&w);
                if length == 0.0 {
                    return Ok(free.basis);
                }
                w.iter_mut().for_each(|w| *w /= length);
            }
            let complex: Vec<C64> = w.iter().map(|w| C64::from(*w)).collect();
            if self.pencil.relative_residual(C64::default(), &complex) > FREE {
                break;
            }
            free.basis.push(w);
        }
        Ok(free.basis)
    }

    /// Eigenvectors of what was found, one of each conjugate pair.
    fn pairs(
        &self,
        map: &Map,
        space: &Space,
        found: Vec<(C64, Vec<C64>)>,
        complete: bool,
    ) -> Result<Found> {
        let mut pairs = Vec::new();
        for (value, y) in found {
            if value.im >= 0.0 {
                // Once more from a state that has `y = s x / ω` exactly.
                let rough = map.vector(value, &space.combine(&y))?;
                let state = self.x.iter().map(|&i| rough[i]);
                let rates = self.y.iter().map(|&i| rough[i] * value / map.unit);
                let vector = map.vector(value, &state.chain(rates).collect::<Vec<_>>())?;
                if vector.iter().all(|v| v.re.is_finite() && v.im.is_finite()) {
                    pairs.push(EigenPair { value, vector });
                }
            }
        }
        Ok(Found { pairs, complete })
    }
}
