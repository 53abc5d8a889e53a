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
            self.values = Numbers::zeros(&what, count)?;
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

    pub fn column(&self, j: usize) -> &[f64] {
        &self.values[j * stride(self.rows)..][..self.rows]
    }

    /// The same for many of them.
    pub fn each_column<'a>(&'a self) -> impl Fn(usize) -> &'a [f64] + Copy + Sync {
        let (values, rows, stride) = (&self.values[..], self.rows, stride(self.rows));
        move |j| &values[j * stride..][..rows]
    }

    pub fn as_ref(&self) -> MatRef<'_, f64> {
        let stride = stride(self.rows);
        MatRef::from_column_major_slice_with_stride(&self.values, self.rows, self.columns, stride)
    }

    pub fn as_mut(&mut self) -> MatMut<'_, f64> {
        let Block {
            values,
            rows,
            columns,
        } = self;
        MatMut::from_column_major_slice_with_stride_mut(values, *rows, *columns, stride(*rows))
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
