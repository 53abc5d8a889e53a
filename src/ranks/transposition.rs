//! From series that ranks have whole, each some of them, to columns of all series, and back.

use super::Ranks;
use crate::error::Result;
use std::ops::Range;
use std::sync::Arc;

/// A matrix of numbers, in two ways divided among ranks: by rows, which are series, such as a
/// component over the grid points; and by columns, such as grid points or harmonics.
#[derive(Debug, Clone)]
pub struct Transposition {
    ranks: Arc<dyn Ranks>,
    /// Rows of each rank.
    rows: Vec<usize>,
    /// Columns of each rank.
    columns: Vec<Range<usize>>,
    /// Numbers of an entry.
    width: usize,
    /// What is sent, and what comes.
    letters: [Vec<f64>; 2],
}

impl Transposition {
    /// Of so many `rows` of each rank, and `columns` that are divided evenly, with entries of so
    /// many numbers.
    pub fn new(ranks: &Arc<dyn Ranks>, rows: Vec<usize>, columns: usize, width: usize) -> Self {
        let count = ranks.count();
        let first = |rank: usize| columns * rank / count;
        Transposition {
            ranks: ranks.clone(),
            rows,
            columns: (0..count).map(|r| first(r)..first(r + 1)).collect(),
            width,
            letters: Default::default(),
        }
    }

    /// Columns that this rank has.
    pub fn own_columns(&self) -> Range<usize> {
        self.columns[self.ranks.rank()].clone()
    }

    /// Rows that this rank has.
    pub fn own_rows(&self) -> usize {
        self.rows[self.ranks.rank()]
    }

    /// Numbers of the rows that this rank has.
    pub fn by_rows(&self) -> usize {
        self.own_rows() * self.columns.last().map_or(0, |last| last.end) * self.width
    }

    /// Numbers of its columns of all rows.
    pub fn by_columns(&self) -> usize {
        self.rows.iter().sum::<usize>() * self.own_columns().len() * self.width
    }

    /// Numbers that go to each rank from the rows of this one, and that come from each to its
    /// columns.
    fn counts(&self) -> [Vec<usize>; 2] {
        let (rows, columns) = (self.own_rows(), self.own_columns().len());
        let sent = self.columns.iter().map(|c| rows * c.len() * self.width);
        let received = self.rows.iter().map(|r| r * columns * self.width);
        [sent.collect(), received.collect()]
    }

    /// Writes the columns of this rank, row by row of all, from its rows. By all ranks.
    ///
    /// # Errors
    /// If numbers cannot be told.
    pub fn to_columns(&mut self, rows: &[f64], columns: &mut [f64]) -> Result<()> {
        let [sent, received] = self.counts();
        let [send, _] = &mut self.letters;
        send.clear();
        let length = self.columns.last().map_or(0, |last| last.end) * self.width;
        for part in &self.columns {
            for row in 0..self.rows[self.ranks.rank()] {
                let row = &rows[row * length..][..length];
                send.extend_from_slice(&row[part.start * self.width..part.end * self.width]);
            }
        }
        self.ranks.exchange(send, &sent, columns, &received)
    }

    /// Writes the rows of this rank, from its columns. By all ranks.
    ///
    /// # Errors
    /// If numbers cannot be told.
    pub fn to_rows(&mut self, columns: &[f64], rows: &mut [f64]) -> Result<()> {
        let [received, sent] = self.counts();
        let [_, receive] = &mut self.letters;
        receive.resize(rows.len(), 0.0);
        self.ranks.exchange(columns, &sent, receive, &received)?;
        let length = self.columns.last().map_or(0, |last| last.end) * self.width;
        let mut rest = &receive[..];
        for part in &self.columns {
            let count = part.len() * self.width;
            for row in 0..self.rows[self.ranks.rank()] {
                let (values, next) = rest.split_at(count);
                rows[row * length + part.start * self.width..][..count].copy_from_slice(values);
                rest = next;
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ranks::threads::on_ranks;

    #[test]
    fn columns_are_those_of_all_rows_and_come_back() {
        const COLUMNS: usize = 5;
        const WIDTH: usize = 2;
        let entry =
            |row: usize, column: usize, part: usize| (100 * row + 10 * column + part) as f64;
        // More ranks than columns, and a rank without rows.
        for rows in [
            vec![4],
            vec![3, 1],
            vec![2, 0, 1],
            vec![1, 1, 1, 1, 1, 1, 2],
        ] {
            on_ranks(rows.len(), |ranks| {
                let first: usize = rows[..ranks.rank()].iter().sum();
                let mut all = Transposition::new(&ranks, rows.clone(), COLUMNS, WIDTH);
                let mut own = Vec::new();
                for row in first..first + rows[ranks.rank()] {
                    for column in 0..COLUMNS {
                        own.extend((0..WIDTH).map(|part| entry(row, column, part)));
                    }
                }
                assert_eq!(own.len(), all.by_rows());
                let mut columns = vec![0.0; all.by_columns()];
                all.to_columns(&own, &mut columns).unwrap();
                let mut expected = Vec::new();
                for row in 0..rows.iter().sum() {
                    for column in all.own_columns() {
                        expected.extend((0..WIDTH).map(|part| entry(row, column, part)));
                    }
                }
                assert_eq!(columns, expected);
                let mut back = vec![0.0; own.len()];
                all.to_rows(&columns, &mut back).unwrap();
                assert_eq!(back, own);
            });
        }
    }
}
