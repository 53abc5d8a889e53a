//! A dense matrix, column by column, in memory that is not touched before it is written to.

use crate::error::Result;
use crate::numbers::Numbers;
use faer::{MatMut, MatRef};

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

    /// Gives it this size; what is in it is to be written.
    ///
    /// # Errors
    /// If memory runs out.
    pub fn resize(&mut self, rows: usize, columns: usize) -> Result<()> {
        if (self.rows, self.columns) != (rows, columns) {
            // The memory that it has first.
            *self = Block::default();
            let what = format!("a dense block of {rows} × {columns}");
            let count = stride(rows).saturating_mul(columns);
            self.values = Numbers::zeros(&what, count)?;
            (self.rows, self.columns) = (rows, columns);
        }
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

/// Numbers from one column to the next, of so many rows.
fn stride(rows: usize) -> usize {
    rows.next_multiple_of(ALIGNED)
}

/// A column of a matrix whose columns have their rows one after the other.
pub(crate) fn column_mut<'m>(matrix: &'m mut MatMut<f64>, j: usize) -> &'m mut [f64] {
    let column = matrix.as_mut().col_mut(j).try_as_col_major_mut();
    column.map_or(&mut [], |column| column.as_slice_mut())
}
