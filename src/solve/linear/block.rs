//! A dense matrix, column by column, in memory that is not touched before it is written to.

use crate::error::Result;
use crate::numbers::Numbers;
use faer::{MatMut, MatRef};
use std::sync::Mutex;

/// Columns begin at multiples of so many numbers, for vector instructions.
const ALIGNED: usize = 8;

/// A dense matrix.
#[derive(Debug, Default)]
pub(crate) struct Block {
    values: Numbers,
    rows: usize,
    columns: usize,
}

impl Block {
    /// Of zeros.
    ///
    /// # Errors
    /// If memory runs out.
    pub fn zeros(rows: usize, columns: usize) -> Result<Self> {
        let mut block = Block::default();
        block.resize(rows, columns)?;
        block.values.fill(0.0);
        Ok(block)
    }

    /// Gives it this size, in the memory that it has if that will do; what is in it is to be
    /// written.
    ///
    /// # Errors
    /// If memory runs out.
    pub fn resize(&mut self, rows: usize, columns: usize) -> Result<()> {
        let count = stride(rows).saturating_mul(columns);
        if count > self.values.len() {
            // The memory that it has first.
            *self = Block::default();
            let what = format!("a dense block of {rows} × {columns}");
            self.values = Numbers::room(&what, count)?;
        }
        (self.rows, self.columns) = (rows, columns);
        Ok(())
    }

    pub fn rows(&self) -> usize {
        self.rows
    }

    pub fn columns(&self) -> usize {
        self.columns
    }

    /// To be read.
    fn view(&self) -> BlockView<'_> {
        BlockView {
            values: &self.values,
            rows: self.rows,
            columns: self.columns,
        }
    }

    pub fn column(&self, j: usize) -> &[f64] {
        self.view().column(j)
    }

    pub fn as_ref(&self) -> MatRef<'_, f64> {
        self.view().as_ref()
    }

    pub fn as_mut(&mut self) -> MatMut<'_, f64> {
        to_be_written(&mut self.values, (self.rows, self.columns))
    }
}

/// A dense matrix to be read.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BlockView<'a> {
    values: &'a [f64],
    rows: usize,
    columns: usize,
}

impl<'a> BlockView<'a> {
    pub fn rows(self) -> usize {
        self.rows
    }

    pub fn columns(self) -> usize {
        self.columns
    }

    pub fn column(self, j: usize) -> &'a [f64] {
        self.each_column()(j)
    }

    /// The same for many of them.
    pub fn each_column(self) -> impl Fn(usize) -> &'a [f64] + Copy + Sync {
        let (values, rows, stride) = (self.values, self.rows, stride(self.rows));
        move |j| &values[j * stride..][..rows]
    }

    pub fn as_ref(self) -> MatRef<'a, f64> {
        let (rows, columns) = (self.rows, self.columns);
        MatRef::from_column_major_slice_with_stride(self.values, rows, columns, stride(rows))
    }
}

fn to_be_written(values: &mut [f64], (rows, columns): (usize, usize)) -> MatMut<'_, f64> {
    MatMut::from_column_major_slice_with_stride_mut(values, rows, columns, stride(rows))
}

/// Two dense matrices in one piece of memory, of which large pieces take less time to be had.
#[derive(Debug, Default)]
pub(crate) struct TwoBlocks {
    values: Numbers,
    /// Rows and columns of each.
    sizes: [(usize, usize); 2],
}

impl TwoBlocks {
    /// Gives them these sizes, in the memory that there is if that will do; what is in it is to be
    /// written.
    ///
    /// # Errors
    /// If memory runs out.
    pub fn resize(&mut self, sizes: [(usize, usize); 2]) -> Result<()> {
        let counts = sizes.map(|(rows, columns)| stride(rows).saturating_mul(columns));
        let count = counts[0].saturating_add(counts[1]);
        if count > self.values.len() {
            // The memory that it has first.
            *self = TwoBlocks::default();
            let [(own, all), (rest, _)] = sizes;
            let what = format!("dense blocks of {own} × {all} and {rest} × {own}");
            self.values = Numbers::room(&what, count)?;
        }
        self.sizes = sizes;
        Ok(())
    }

    /// Where the second begins.
    fn second(&self) -> usize {
        let (rows, columns) = self.sizes[0];
        stride(rows) * columns
    }

    pub fn both(&self) -> [BlockView<'_>; 2] {
        let (first, second) = self.values.split_at(self.second());
        let view = |values, (rows, columns)| BlockView {
            values,
            rows,
            columns,
        };
        [view(first, self.sizes[0]), view(second, self.sizes[1])]
    }

    pub fn both_mut(&mut self) -> [MatMut<'_, f64>; 2] {
        let (at, sizes) = (self.second(), self.sizes);
        let (first, second) = self.values.split_at_mut(at);
        [
            to_be_written(first, sizes[0]),
            to_be_written(second, sizes[1]),
        ]
    }
}

/// Memory of blocks that are gone, for others.
#[derive(Debug, Default)]
pub(crate) struct SpareBlocks(Mutex<Vec<Block>>);

impl SpareBlocks {
    /// A block of this size, in the least memory that will do; what is in it is to be written.
    ///
    /// # Errors
    /// If memory runs out.
    pub fn take(&self, rows: usize, columns: usize) -> Result<Block> {
        let wanted = stride(rows).saturating_mul(columns);
        // Where none will do the largest makes way.
        let fit = |block: &Block| match block.values.len().checked_sub(wanted) {
            Some(beyond) => (false, beyond),
            None => (true, wanted - block.values.len()),
        };
        let found = self.0.lock().ok().and_then(|mut spare| {
            let best = (0..spare.len()).min_by_key(|&at| fit(&spare[at]));
            best.map(|at| spare.swap_remove(at))
        });
        let mut block = found.unwrap_or_default();
        block.resize(rows, columns)?;
        Ok(block)
    }

    /// Gives one back.
    pub fn give(&self, block: Block) {
        if let Ok(mut spare) = self.0.lock()
            && !block.values.is_empty()
        {
            spare.push(block);
        }
    }
}

/// Numbers from one column to the next, of so many rows.
fn stride(rows: usize) -> usize {
    rows.next_multiple_of(ALIGNED)
}

/// A column of a matrix whose columns have their rows one after the other.
pub(crate) fn column<'m>(matrix: MatRef<'m, f64>, j: usize) -> &'m [f64] {
    let column = matrix.col(j).try_as_col_major();
    column.map_or(&[], |column| column.as_slice())
}

/// The same, to be written.
pub(crate) fn column_mut<'m>(matrix: &'m mut MatMut<f64>, j: usize) -> &'m mut [f64] {
    let column = matrix.as_mut().col_mut(j).try_as_col_major_mut();
    column.map_or(&mut [], |column| column.as_slice_mut())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn memory_is_that_of_the_smallest_block_that_will_do() {
        let spare = SpareBlocks::default();
        for size in [8, 32, 16] {
            spare.give(Block::zeros(size, size).unwrap());
        }
        let takes = |rows: usize, size: usize| {
            let block = spare.take(rows, rows).unwrap();
            assert_eq!((block.rows(), block.columns()), (rows, rows));
            assert_eq!(block.values.len(), size * size);
            block
        };
        let first = takes(9, 16);
        takes(12, 32);
        // The last one makes way.
        takes(40, 40);
        assert!(spare.0.lock().unwrap().is_empty());
        spare.give(first);
        takes(8, 16);
    }
}
