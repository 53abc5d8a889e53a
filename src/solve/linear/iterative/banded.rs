//! LU of banded matrices, in place, with pivots.

use crate::error::Result;
use crate::memory;
use crate::solve::linear::blocks;
use crate::workers::Workers;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::lu::partial_pivoting::factor::{lu_in_place, lu_in_place_scratch};
use faer::{MatMut, MatRef, Par};
use std::ops::Range;

/// Columns that are eliminated together.
const PANEL: usize = 64;

/// Numbers that are zeroed at a time.
const PIECE: usize = 1 << 20;

/// A square matrix whose entries are at most so many places from the diagonal.
pub(super) struct Banded {
    size: usize,
    /// Places from the diagonal.
    reach: usize,
    /// Column by column, each with room for what pivots fill in.
    values: Vec<f64>,
}

impl Banded {
    /// Of zeros.
    ///
    /// # Errors
    /// If memory runs out, or work is to end.
    pub fn zeros(size: usize, reach: usize, workers: &Workers) -> Result<Self> {
        let reach = reach.min(size);
        let mut matrix = Banded {
            size,
            reach,
            values: Vec::new(),
        };
        let count = size * (matrix.stride() + 1);
        matrix.values = memory::room(&format!("a band of {size} × {reach}"), count)?;
        for end in (PIECE..count).step_by(PIECE).chain([count]) {
            matrix.values.resize(end, 0.0);
            workers.pulse()?;
        }
        Ok(matrix)
    }

    /// Multiply-adds of its factors, at most.
    pub fn work(size: usize, reach: usize) -> f64 {
        2.0 * size as f64 * (reach as f64).powi(2)
    }

    /// Bytes of such a matrix.
    pub fn bytes(size: usize, reach: usize) -> usize {
        size_of::<f64>() * size * (3 * reach.min(size) + 2 * PANEL + 1)
    }

    /// Places above the diagonal, those that pivots fill included.
    fn above(&self) -> usize {
        2 * self.reach + PANEL
    }

    /// From one column to the next in a row. A column has one place more.
    fn stride(&self) -> usize {
        self.above() + self.reach + PANEL
    }

    fn at(&self, row: usize, column: usize) -> usize {
        self.above() + row + column * self.stride()
    }

    /// Entries of a column, from this row on.
    pub fn column_mut(&mut self, rows: Range<usize>, column: usize) -> &mut [f64] {
        let first = self.at(rows.start, column);
        &mut self.values[first..][..rows.len()]
    }

    fn column(&self, rows: Range<usize>, column: usize) -> &[f64] {
        &self.values[self.at(rows.start, column)..][..rows.len()]
    }

    /// Factors it; none if it is singular.
    ///
    /// # Errors
    /// If work is to end.
    pub fn factor(mut self, workers: &Workers) -> Result<Option<BandedLu>> {
        let tallest = (self.reach + PANEL).min(self.size);
        let (mut order, mut reverse) = (vec![0; tallest], vec![0; tallest]);
        let need = |par| lu_in_place_scratch::<usize, f64>(tallest, PANEL, par, Default::default());
        let scale = self.balance();
        let mut swaps = Vec::with_capacity(self.size.div_ceil(PANEL));
        let mut filled = 0;
        workers.dense(|par| {
            let mut memory = MemBuffer::new(need(par));
            for first in (0..self.size).step_by(PANEL) {
                let columns = first..(first + PANEL).min(self.size);
                let order = (&mut order[..], &mut reverse[..]);
                let pivots = self.factor_panel(columns.clone(), order, par, &mut memory);
                // Rows that have come up reach further than those that were there.
                let lowest = pivots.iter().map(|&(_, from)| first + from + 1).max();
                let reached = lowest.unwrap_or(0).max(columns.end) + self.reach;
                filled = filled.max(reached).min(self.size);
                self.eliminate(columns, filled, &pivots, par, workers)?;
                swaps.push(pivots);
                workers.pulse()?;
            }
            Ok(())
        })?;
        let pivots = (0..self.size).map(|i| self.values[self.at(i, i)]);
        let regular = pivots.into_iter().all(|p| p != 0.0 && p.is_finite());
        let tops = (0..self.size).map(|column| self.top(column)).collect();
        Ok(regular.then_some(BandedLu {
            factors: self,
            scale,
            swaps,
            tops,
            memory: Vec::new(),
        }))
    }

    /// First row of a column that is not zero, at the diagonal at last.
    fn top(&self, column: usize) -> usize {
        let first = column.saturating_sub(self.above());
        let above = self.column(first..column, column);
        first + above.iter().take_while(|x| **x == 0.0).count()
    }

    /// Rows below and at the diagonal that a panel of columns has.
    fn rows(&self, panel: &Range<usize>) -> Range<usize> {
        panel.start..(panel.end + self.reach).min(self.size)
    }

    /// Scales rows and columns so that the largest entries of rows are about 1, for the sake of
    /// pivots that are near. Gives by what.
    fn balance(&mut self) -> Vec<f64> {
        let (size, reach) = (self.size, self.reach);
        let rows = |column: usize| column.saturating_sub(reach)..(column + reach + 1).min(size);
        let mut largest = vec![0.0f64; size];
        for column in 0..size {
            let entries = self.column(rows(column), column);
            let places = largest[rows(column)].iter_mut();
            places.zip(entries).for_each(|(l, x)| *l = l.max(x.abs()));
        }
        let by_size = |l: &f64| if *l > 0.0 { l.sqrt().recip() } else { 1.0 };
        let scale: Vec<f64> = largest.iter().map(by_size).collect();
        for column in 0..size {
            let of_rows = &scale[rows(column)];
            let entries = self.column_mut(rows(column), column).iter_mut();
            entries
                .zip(of_rows)
                .for_each(|(x, s)| *x *= s * scale[column]);
        }
        scale
    }

    /// Factors a panel of columns. Gives where rows go, and from where, counted from its first.
    fn factor_panel(
        &mut self,
        panel: Range<usize>,
        (order, reverse): (&mut [usize], &mut [usize]),
        par: Par,
        memory: &mut MemBuffer,
    ) -> Vec<(usize, usize)> {
        let (height, stride) = (self.rows(&panel).len(), self.stride());
        let first = self.at(panel.start, panel.start);
        let order = &mut order[..height];
        let values = &mut self.values[first..];
        lu_in_place(
            MatMut::from_column_major_slice_with_stride_mut(values, height, panel.len(), stride),
            order,
            &mut reverse[..height],
            par,
            MemStack::new(memory),
            Default::default(),
        );
        let moves = order.iter().copied().enumerate();
        moves.filter(|(to, from)| to != from).collect()
    }

    /// Subtracts from the columns behind a panel, up to `end`, what it has.
    fn eliminate(
        &mut self,
        panel: Range<usize>,
        end: usize,
        pivots: &[(usize, usize)],
        par: Par,
        workers: &Workers,
    ) -> Result<()> {
        if panel.end >= end {
            return Ok(());
        }
        let (height, stride) = (self.rows(&panel).len(), self.stride());
        let (at_panel, at_right) = (
            self.at(panel.start, panel.start),
            self.at(panel.start, panel.end),
        );
        let (width, middle) = (panel.len(), panel.end * (stride + 1));
        let (left, right) = self.values.split_at_mut(middle);
        let left = &left[at_panel..];
        let own = MatRef::from_column_major_slice_with_stride(left, height, width, stride);
        let (right, columns) = (&mut right[at_right - middle..], end - panel.end);
        let mut beside =
            MatMut::from_column_major_slice_with_stride_mut(right, height, columns, stride);
        let mut values = Vec::with_capacity(pivots.len());
        for mut column in beside.as_mut().col_iter_mut() {
            values.clear();
            values.extend(pivots.iter().map(|&(_, from)| column[from]));
            for (&(to, _), value) in pivots.iter().zip(&values) {
                column[to] = *value;
            }
        }
        let (mut upper, rest) = beside.split_at_row_mut(width);
        let (diagonal, below) = own.split_at_row(width);
        let lower = (diagonal, blocks::Diagonal::Ones);
        blocks::solve_lower(lower, upper.as_mut(), par, workers)?;
        blocks::subtract_matmul(rest, below, upper.as_ref(), par, workers)
    }
}

/// Factors of a banded matrix.
pub(super) struct BandedLu {
    factors: Banded,
    /// Of rows and columns.
    scale: Vec<f64>,
    /// Where rows of each panel went, and from where, counted from its first.
    swaps: Vec<Vec<(usize, usize)>>,
    /// First row of each column: pivots fill in less than they might.
    tops: Vec<usize>,
    memory: Vec<f64>,
}

impl BandedLu {
    /// Solves in place.
    pub fn solve(&mut self, x: &mut [f64]) {
        let Self {
            factors,
            scale,
            swaps,
            tops,
            memory,
        } = self;
        x.iter_mut().zip(&*scale).for_each(|(x, s)| *x *= s);
        for (p, swaps) in swaps.iter().enumerate() {
            let first = p * PANEL;
            let panel = first..(first + PANEL).min(factors.size);
            memory.clear();
            memory.extend(swaps.iter().map(|&(_, from)| x[first + from]));
            for (&(to, _), value) in swaps.iter().zip(&*memory) {
                x[first + to] = *value;
            }
            let rows = factors.rows(&panel);
            for column in panel {
                let below = column + 1..rows.end;
                let (known, rest) = x.split_at_mut(column + 1);
                subtract(rest, factors.column(below, column), known[column]);
            }
        }
        for column in (0..factors.size).rev() {
            let above = tops[column]..column;
            let (rest, known) = x.split_at_mut(column);
            known[0] /= factors.values[factors.at(column, column)];
            subtract(
                &mut rest[above.start..],
                factors.column(above, column),
                known[0],
            );
        }
        x.iter_mut().zip(&*scale).for_each(|(x, s)| *x *= s);
    }
}

/// `x -= factor a`.
fn subtract(x: &mut [f64], a: &[f64], factor: f64) {
    x.iter_mut().zip(a).for_each(|(x, a)| *x -= factor * a);
}

#[cfg(test)]
mod tests {
    use super::*;
    use faer::Mat;
    use faer::prelude::Solve;

    fn noise(i: usize, j: usize) -> f64 {
        (4e4 * (1.7 * i as f64 + 0.3 * j as f64).sin()).fract()
    }

    #[test]
    fn bands_are_solved_as_dense_matrices() {
        // Less than a panel, several, one that fills the matrix, a diagonal that is zero.
        for (size, reach, diagonal) in [
            (40, 7, 1.0),
            (500, 33, 1.0),
            (300, 150, 0.0),
            (90, 200, 0.0),
        ] {
            let entry = |i: usize, j: usize| match i.abs_diff(j) {
                0 => diagonal * noise(i, j),
                d if d <= reach => noise(i, j),
                _ => 0.0,
            };
            let workers = Workers::default();
            let mut band = Banded::zeros(size, reach, &workers).unwrap();
            for j in 0..size {
                let rows = j.saturating_sub(reach)..(j + reach + 1).min(size);
                let first = rows.start;
                for (i, value) in band.column_mut(rows, j).iter_mut().enumerate() {
                    *value = entry(first + i, j);
                }
            }
            let mut lu = band.factor(&workers).unwrap().unwrap();
            let dense = Mat::from_fn(size, size, entry);
            let right = Mat::from_fn(size, 1, |i, _| noise(i, 1000));
            let expected = dense.partial_piv_lu().solve(&right);
            let mut x: Vec<f64> = (0..size).map(|i| right[(i, 0)]).collect();
            lu.solve(&mut x);
            let largest = expected.col(0).norm_max();
            for (i, x) in x.iter().enumerate() {
                // Condition numbers are some thousands.
                assert!(
                    (x - expected[(i, 0)]).abs() < 1e-9 * largest,
                    "{size} {reach} {i}"
                );
            }
        }
    }

    #[test]
    fn a_singular_band_is_told() {
        let workers = Workers::default();
        let mut band = Banded::zeros(100, 3, &workers).unwrap();
        for j in (0..100).filter(|j| *j != 70) {
            band.column_mut(j..j + 1, j)[0] = 1.0;
        }
        assert!(band.factor(&workers).unwrap().is_none());
    }
}
