//! The system of joints that turn, harmonic by harmonic. There the dynamic stiffness of the bodies
//! is block diagonal, and a joint that turns couples neighbours: the matrix is banded, as far as
//! the harmonics of its free motions fall off. See docs/theory.md, section 8.5.

use super::banded::{Banded, BandedLu};
use super::part::Part;
use crate::error::Result;
use crate::fourier::{Analysis, Synthesis};
use crate::workers::Workers;
use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, c64};
use nalgebra::Complex;

/// Harmonics that usually are kept.
const USUAL: usize = 8;

/// Forces by motions, each over the harmonics from 0 on; empty where there are none.
pub(super) type Spectra = Vec<Vec<Vec<Complex<f64>>>>;

/// The harmonics that are kept of free motions.
#[derive(Debug, Clone, Copy)]
pub(super) struct Reach {
    points: usize,
    /// Free motions at a grid point.
    free: usize,
    /// Motions that are kept.
    motions: usize,
    /// The highest.
    highest: usize,
}

impl Reach {
    /// Of the free motions of these parts, so that so much of all is left out.
    pub fn of(parts: &[Part], points: usize, left_out: f64) -> Self {
        let mut analysis = Analysis::new(points);
        let mut power = vec![0.0; points / 2 + 1];
        for series in parts.iter().flat_map(|part| &part.directions) {
            if !series.is_empty() {
                analysis.read(series.iter().copied());
                let squares = analysis.spectrum.iter().map(|x| x.norm_sqr());
                power.iter_mut().zip(squares).for_each(|(p, x)| *p += x);
            }
        }
        let least = power.iter().sum::<f64>() * left_out * left_out;
        let mut rest = 0.0;
        let highest = (0..power.len()).rev().find(|&h| {
            rest += power[h];
            rest > least
        });
        Reach {
            points,
            free: parts.iter().map(|part| part.free).sum(),
            motions: parts.iter().map(|part| part.motions.len()).sum(),
            highest: highest.unwrap_or(0),
        }
    }

    /// What joints that turn once in a period usually take.
    pub fn usual(free: usize, points: usize) -> Self {
        Reach {
            points,
            free,
            motions: 2 * free,
            highest: USUAL.min(points / 2),
        }
    }

    /// Harmonics from `-highest` to `highest`.
    fn count(&self) -> usize {
        2 * self.highest + 1
    }

    fn size(&self) -> usize {
        self.points * self.free
    }

    /// Places from the diagonal. Free motions couple harmonics up to twice their highest apart.
    fn places(&self) -> usize {
        (2 * self.free * self.count()).saturating_sub(1)
    }

    /// Multiply-adds of the matrix and its factors.
    pub fn work(&self) -> f64 {
        let columns = (self.count() * self.free) as f64;
        let complex = self.motions as f64 * columns * (columns + self.motions as f64);
        2.0 * self.points as f64 * complex + Banded::work(self.size(), self.places())
    }

    /// Bytes of the matrix.
    pub fn bytes(&self) -> usize {
        Banded::bytes(self.size(), self.places())
    }

    /// Place of the first number of a harmonic: real parts of all free motions, then imaginary.
    fn first(&self, harmonic: usize) -> usize {
        match harmonic {
            0 => 0,
            j => (2 * j - 1) * self.free,
        }
    }

    /// The harmonic that is sampled as this one, which may be beyond the highest of the grid.
    fn sampled(&self, harmonic: isize) -> isize {
        let points = self.points as isize;
        (harmonic + points / 2).rem_euclid(points) - points / 2
    }
}

/// The system, factored.
pub(super) struct HarmonicBand {
    reach: Reach,
    factors: BandedLu,
    analysis: Analysis,
    synthesis: Synthesis,
    values: Vec<f64>,
}

impl HarmonicBand {
    /// Of `Zᵀ D Z`, with `D` in harmonics; none if it is singular.
    ///
    /// # Errors
    /// If memory runs out, or work is to end.
    pub fn new(
        reach: Reach,
        parts: &[Part],
        stiffness: &Spectra,
        workers: &Workers,
    ) -> Result<Option<Self>> {
        let directions = harmonics_of(parts, reach);
        let mut band = Banded::zeros(reach.size(), reach.places(), workers)?;
        let (motions, columns) = (directions.nrows(), directions.ncols());
        let mut own = Mat::<c64>::zeros(motions, motions);
        let mut forces = Mat::<c64>::zeros(motions, columns);
        let mut product = Mat::<c64>::zeros(columns, columns);
        let one = c64::new(1.0, 0.0);
        for k in 0..=reach.points / 2 {
            for (i, row) in stiffness.iter().enumerate() {
                for (j, series) in row.iter().enumerate() {
                    own[(i, j)] = series.get(k).copied().unwrap_or_default();
                }
            }
            workers.dense(|par| {
                let by_motions = (own.as_ref(), directions.as_ref());
                matmul(
                    &mut forces,
                    Accum::Replace,
                    by_motions.0,
                    by_motions.1,
                    one,
                    par,
                );
                let projected = (directions.adjoint(), forces.as_ref());
                matmul(
                    &mut product,
                    Accum::Replace,
                    projected.0,
                    projected.1,
                    one,
                    par,
                );
            });
            add_harmonic(&mut band, reach, k as isize, &product);
            workers.pulse()?;
        }
        Ok(band.factor(workers)?.map(|factors| HarmonicBand {
            reach,
            factors,
            analysis: Analysis::new(reach.points),
            synthesis: Synthesis::new(reach.points),
            values: vec![0.0; reach.size()],
        }))
    }

    /// Solves in place, for free motion by free motion over the grid.
    pub fn solve(&mut self, x: &mut [f64]) {
        let Reach { points, free, .. } = self.reach;
        for (b, series) in x.chunks_exact(points).enumerate() {
            self.analysis.read(series.iter().copied());
            for (j, value) in self.analysis.spectrum.iter().enumerate() {
                let first = self.reach.first(j) + b;
                self.values[first] = value.re;
                if j > 0 {
                    self.values[first + free] = value.im;
                }
            }
        }
        self.factors.solve(&mut self.values);
        let scale = 1.0 / points as f64;
        for (b, series) in x.chunks_exact_mut(points).enumerate() {
            for (j, value) in self.synthesis.spectrum.iter_mut().enumerate() {
                let first = self.reach.first(j) + b;
                let imaginary = if j > 0 {
                    self.values[first + free]
                } else {
                    0.0
                };
                *value = Complex::new(self.values[first], imaginary) * scale;
            }
            self.synthesis.write(series);
        }
    }
}

/// Harmonics of the directions of free motions, from the lowest that is kept to the highest:
/// motions by free motions, harmonic after harmonic.
fn harmonics_of(parts: &[Part], reach: Reach) -> Mat<c64> {
    let mut all = Mat::<c64>::zeros(reach.motions, reach.count() * reach.free);
    let mut analysis = Analysis::new(reach.points);
    let scale = 1.0 / reach.points as f64;
    for part in parts {
        for (m, &motion) in part.motions.iter().enumerate() {
            for b in 0..part.free {
                let series = &part.directions[m * part.free + b];
                if series.is_empty() {
                    continue;
                }
                analysis.read(series.iter().copied());
                for h in 0..=reach.highest {
                    let value = analysis.spectrum[h] * scale;
                    let column = |h: usize| h * reach.free + part.first + b;
                    all[(motion, column(reach.highest + h))] = value;
                    all[(motion, column(reach.highest - h))] = value.conj();
                }
            }
        }
    }
    all
}

/// Adds what goes through harmonic `k` of the bodies, and through `-k`.
fn add_harmonic(band: &mut Banded, reach: Reach, k: isize, product: &Mat<c64>) {
    let highest = reach.highest as isize;
    for (a, h) in (-highest..=highest).enumerate() {
        let row = reach.sampled(k - h);
        for (b, g) in (-highest..=highest).enumerate() {
            let column = reach.sampled(k - g);
            let place = (a * reach.free, b * reach.free);
            if row >= 0 {
                add_block(band, reach, (row, column), product, place, 1.0);
            }
            if k > 0 && row <= 0 {
                add_block(band, reach, (-row, -column), product, place, -1.0);
            }
        }
    }
}

/// Adds a block, conjugated by the `sign` of its imaginary part, of the forces in harmonic `row` by
/// free motions in harmonic `column`, which may be negative.
fn add_block(
    band: &mut Banded,
    reach: Reach,
    (row, column): (isize, isize),
    product: &Mat<c64>,
    (first_row, first_column): (usize, usize),
    sign: f64,
) {
    let free = reach.free;
    // Negative harmonics have conjugate motions.
    let mirror = if column < 0 { -1.0 } else { 1.0 };
    let to_rows = reach.first(row.unsigned_abs());
    let to_columns = reach.first(column.unsigned_abs());
    let real_rows = to_rows..to_rows + free;
    let imaginary_rows = to_rows + free..to_rows + 2 * free;
    for j in 0..free {
        let values = &product.col_as_slice(first_column + j)[first_row..][..free];
        let mut add = |rows: &std::ops::Range<usize>, column: usize, part: &dyn Fn(&c64) -> f64| {
            let entries = band.column_mut(rows.clone(), column);
            entries
                .iter_mut()
                .zip(values)
                .for_each(|(e, v)| *e += part(v));
        };
        let (real, imaginary) = (to_columns + j, to_columns + free + j);
        add(&real_rows, real, &|v| v.re);
        if row != 0 {
            add(&imaginary_rows, real, &|v| sign * v.im);
        }
        if column != 0 {
            add(&real_rows, imaginary, &|v| -mirror * sign * v.im);
            if row != 0 {
                add(&imaginary_rows, imaginary, &|v| mirror * v.re);
            }
        }
    }
}
