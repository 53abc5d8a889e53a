//! Constraints of one grid point, eliminated: the motions that obey them, and the forces that they
//! exert.

use crate::solve::linear::dense::largest;
use faer::Mat;

/// A constraint of which no more than this is left beside those before it waits, for one that
/// depends on others is to be left out.
const POSTPONED: f64 = 0.1;
/// What is left of a constraint must be more than this, of one that is left out less than the
/// other: relative to its gradient.
const SMALLEST_PIVOT: f64 = 1e-5;
const LARGEST_REMAINDER: f64 = 1e-2;

/// Constraints of one grid point, eliminated: those in order are `L U` with unit pivots in `U`.
#[derive(Debug, Default)]
pub(super) struct Point {
    /// The gradient, row by row.
    pub gradient: Vec<f64>,
    /// `L`, row by row, also of those left out; its diagonal the pivots.
    pub lower: Vec<f64>,
    /// `U`, row by row.
    upper: Vec<f64>,
    /// The constraints in order, then those left out.
    pub rows: Vec<usize>,
    /// Coordinates with pivots, in order, then those without: the freedoms.
    pub columns: Vec<usize>,
    /// `Z`, row by row.
    pub basis: Vec<f64>,
}

/// `Σ aᵢ bᵢ`.
pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// `y += factor x`.
pub(super) fn add(y: &mut [f64], factor: f64, x: &[f64]) {
    y.iter_mut().zip(x).for_each(|(y, x)| *y += factor * x);
}

impl Point {
    /// Eliminates constraints, `left_out` of which depend on others. `false` if that cannot be
    /// done.
    pub fn eliminate(&mut self, count: usize, size: usize, left_out: usize) -> bool {
        let rank = count - left_out;
        self.lower.clear();
        self.lower.resize(count * count, 0.0);
        self.upper.clone_from(&self.gradient);
        self.rows.clear();
        self.columns.clear();
        self.columns.extend(0..size);
        // Of the constraints that wait, the one of which most is left comes first.
        let mut waiting: Vec<usize> = Vec::new();
        for row in 0..count {
            if !self.reduce(row, size, count) {
                return false;
            }
            let left = self.left_of(row, size);
            if left > POSTPONED && self.rows.len() < rank {
                self.take(row, size, count);
            } else {
                waiting.push(row);
            }
        }
        while self.rows.len() < rank {
            // They have been reduced by what came before each alone.
            let mut most = (0, 0.0);
            for (place, &row) in waiting.iter().enumerate() {
                if !self.reduce(row, size, count) {
                    return false;
                }
                let left = self.left_of(row, size);
                if left > most.1 {
                    most = (place, left);
                }
            }
            // Written so that NaN fails too.
            let enough = most.1 > SMALLEST_PIVOT;
            if !enough {
                return false;
            }
            let row = waiting.swap_remove(most.0);
            self.take(row, size, count);
        }
        for &row in &waiting {
            let reduced = self.reduce(row, size, count);
            if !reduced || self.left_of(row, size) > LARGEST_REMAINDER {
                return false;
            }
        }
        self.rows.extend(waiting);
        true
    }

    /// Takes from a constraint, which may have been reduced before, what those in order make of it.
    /// `false` if it is not finite.
    fn reduce(&mut self, row: usize, size: usize, count: usize) -> bool {
        for place in 0..self.rows.len() {
            let column = self.columns[place];
            let part = self.upper[row * size + column];
            if part == 0.0 {
                continue;
            }
            self.lower[row * count + place] = part;
            let pivot_row = self.rows[place];
            let (to, from) = two_rows(&mut self.upper, size, row, pivot_row);
            add(to, -part, from);
            to[column] = 0.0;
        }
        self.upper[row * size..][..size]
            .iter()
            .all(|x| x.is_finite())
    }

    /// What is left of a constraint, relative to its gradient.
    fn left_of(&self, row: usize, size: usize) -> f64 {
        let whole = largest(&self.gradient[row * size..][..size]);
        largest(&self.upper[row * size..][..size]) / whole.max(f64::MIN_POSITIVE)
    }

    /// Makes a reduced constraint the next in order, with its largest entry as pivot.
    fn take(&mut self, row: usize, size: usize, count: usize) {
        let place = self.rows.len();
        let entries = &mut self.upper[row * size..][..size];
        let mut best = place;
        for other in place..size {
            if entries[self.columns[other]].abs() > entries[self.columns[best]].abs() {
                best = other;
            }
        }
        self.columns.swap(place, best);
        let pivot = entries[self.columns[place]];
        entries.iter_mut().for_each(|x| *x /= pivot);
        self.lower[row * count + place] = pivot;
        self.rows.push(row);
    }

    /// Finds `Z`.
    pub fn find_basis(&mut self, rank: usize, size: usize) {
        let freedoms = size - rank;
        self.basis.clear();
        self.basis.resize(size * freedoms, 0.0);
        for (i, &free) in self.columns[rank..].iter().enumerate() {
            self.basis[free * freedoms + i] = 1.0;
        }
        for place in (0..rank).rev() {
            let entries = &self.upper[self.rows[place] * size..][..size];
            for i in 0..freedoms {
                let mut sum = entries[self.columns[rank + i]];
                for &later in &self.columns[place + 1..rank] {
                    sum += entries[later] * self.basis[later * freedoms + i];
                }
                self.basis[self.columns[place] * freedoms + i] = -sum;
            }
        }
    }

    /// Motion without freedoms that the constraints have these values for, `C u = g`.
    pub fn particular(&self, rank: usize, size: usize, values: &[f64], motion: &mut [f64]) {
        let count = self.rows.len();
        motion.fill(0.0);
        for place in 0..rank {
            let row = self.rows[place];
            let lower = &self.lower[row * count..][..count];
            let known = self.columns[..place].iter().zip(lower);
            let known: f64 = known.map(|(&column, l)| l * motion[column]).sum();
            motion[self.columns[place]] = (values[row] - known) / lower[place];
        }
        for place in (0..rank).rev() {
            let entries = &self.upper[self.rows[place] * size..][..size];
            let later = self.columns[place + 1..rank].iter();
            let known: f64 = later.map(|&column| entries[column] * motion[column]).sum();
            motion[self.columns[place]] -= known;
        }
    }

    /// Multipliers that balance these forces, `Cᵀ λ = f`, where only those on coordinates with
    /// pivots count.
    pub fn multipliers(
        &self,
        rank: usize,
        size: usize,
        forces: &mut [f64],
        multipliers: &mut [f64],
    ) {
        let count = self.rows.len();
        for place in 0..rank {
            let entries = &self.upper[self.rows[place] * size..][..size];
            let force = forces[self.columns[place]];
            for &later in &self.columns[place + 1..rank] {
                forces[later] -= entries[later] * force;
            }
        }
        multipliers.fill(0.0);
        for place in (0..rank).rev() {
            let row = self.rows[place];
            let lower = &self.lower[row * count..][..count];
            let multiplier = forces[self.columns[place]] / lower[place];
            multipliers[row] = multiplier;
            for (&column, l) in self.columns[..place].iter().zip(lower) {
                forces[column] -= l * multiplier;
            }
        }
    }

    /// Logarithm of the determinant of `I + W Wᵀ`, where the constraints left out are `W` times the
    /// others.
    pub fn of_left_out(&self, rank: usize) -> f64 {
        let count = self.rows.len();
        let left_out = count - rank;
        let mut parts = vec![0.0; left_out * rank];
        for (part, &row) in parts.chunks_exact_mut(rank.max(1)).zip(&self.rows[rank..]) {
            part.copy_from_slice(&self.lower[row * count..][..rank]);
            for place in (0..rank).rev() {
                let lower = &self.lower[self.rows[place] * count..][..count];
                part[place] /= lower[place];
                let (before, from) = part.split_at_mut(place);
                add(before, -from[0], lower);
            }
        }
        let mut matrix = Mat::from_fn(left_out, left_out, |i, j| {
            let row = |i: usize| &parts[i * rank..][..rank];
            f64::from(i == j) + dot(row(i), row(j))
        });
        // Positive definite: eliminated in order.
        let mut logarithm = 0.0;
        for k in 0..left_out {
            logarithm += matrix[(k, k)].ln();
            for i in k + 1..left_out {
                let part = matrix[(i, k)] / matrix[(k, k)];
                for j in k + 1..left_out {
                    matrix[(i, j)] -= part * matrix[(k, j)];
                }
            }
        }
        logarithm
    }
}

/// Two different rows of a matrix that is stored row by row.
fn two_rows(matrix: &mut [f64], size: usize, a: usize, b: usize) -> (&mut [f64], &[f64]) {
    if a < b {
        let (before, from) = matrix.split_at_mut(b * size);
        (&mut before[a * size..][..size], &from[..size])
    } else {
        let (before, from) = matrix.split_at_mut(a * size);
        (&mut from[..size], &before[b * size..][..size])
    }
}
