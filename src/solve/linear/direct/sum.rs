//! A front summed up from the matrix and what is left of the fronts that lead to it, in strips of
//! columns side by side.

use crate::error::Result;
use crate::solve::linear::block::column_mut;
use crate::solve::linear::blocks::strips;
use crate::solve::linear::dense::largest;
use crate::solve::linear::direct::analysis::Analysis;
use crate::solve::linear::direct::parts::Piece;
use crate::solve::linear::front::Front;
use crate::workers::Workers;
use faer::{MatMut, Par};
use std::iter::once;
use std::ops::Range;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

/// Numbers of a strip.
const STRIP: usize = 1 << 16;

/// What is left of a front that leads here.
struct Child<'a> {
    front: &'a Front,
    /// Where its rows and columns belong, and how many come together: those without pivots first.
    places: Vec<(usize, usize)>,
}

/// What a front is the sum of.
pub(super) struct Sum<'a> {
    values: &'a [f64],
    pieces: &'a [Piece],
    /// Where each group begins.
    place: &'a [usize],
    children: Vec<Child<'a>>,
    /// Bits of the largest entry of the matrix: those of what is not negative are in order.
    largest: AtomicU64,
    /// Whether the matrix couples what was taken to be parts that do not act on each other.
    is_coupled: &'a AtomicBool,
}

impl<'a> Sum<'a> {
    /// Of front `f`; what leads to it is among `fronts` from front `first` on. Group `g` begins at
    /// `place[g]`.
    pub fn new(
        (analysis, values): (&'a Analysis, &'a [f64]),
        f: usize,
        (first, fronts): (usize, &'a [Front]),
        (place, is_coupled): (&'a [usize], &'a AtomicBool),
    ) -> Self {
        let plan = &analysis.plans[f];
        // Behind the own groups comes what the fronts that lead here have delayed.
        let mut delayed_place = analysis.size_of(&plan.own);
        let children = plan.children.iter().map(|&child| {
            let front = &fronts[child - first];
            let delayed = front.delayed_rows.len();
            let groups = analysis.plans[child].boundary.iter();
            let groups = groups.map(|&g| (place[g], analysis.groups[g].len()));
            let places = once((delayed_place, delayed)).chain(groups).collect();
            delayed_place += delayed;
            Child { front, places }
        });
        Sum {
            values,
            pieces: &analysis.pieces[f],
            place,
            children: children.collect(),
            largest: AtomicU64::new(0),
            is_coupled,
        }
    }

    /// Writes the sum to `front`, which has its size.
    ///
    /// # Errors
    /// If work is to end.
    pub fn write(&self, front: &mut Front, shared: (Par, &Workers)) -> Result<()> {
        let (count, size) = (front.upper().rows(), front.upper().columns());
        self.largest.store(0, Ordering::Relaxed);
        let width = (STRIP / size.max(1)).max(1);
        let Front {
            factors, remainder, ..
        } = front;
        let [upper, lower] = factors.both_mut();
        let (left, right) = upper.split_at_col_mut(count);
        for (first, upper, below) in [(0, left, lower), (count, right, remainder.as_mut())] {
            let columns = (upper, below);
            strips(columns, width, shared, &|column, (upper, below)| {
                self.write_strip(first + column, upper, below);
                Ok(())
            })?;
        }
        front.largest_entry = f64::from_bits(self.largest.load(Ordering::Relaxed));
        Ok(())
    }

    /// Writes columns from `first` on: their own rows of the front, and those below.
    fn write_strip(&self, first: usize, mut upper: MatMut<f64>, mut below: MatMut<f64>) {
        let (own, columns) = (upper.nrows(), first..first + upper.ncols());
        for column in 0..upper.ncols() {
            column_mut(&mut upper, column).fill(0.0);
            column_mut(&mut below, column).fill(0.0);
        }
        // Part of a column, of rows that belong together.
        let mut part =
            |row: usize, column: usize, length: usize, work: &mut dyn FnMut(&mut [f64])| {
                let (to, row) = match row < own {
                    true => (column_mut(&mut upper, column - first), row),
                    false => (column_mut(&mut below, column - first), row - own),
                };
                work(&mut to[row..][..length]);
            };
        let mut most = 0.0f64;
        let mut apart = true;
        for piece in self.pieces {
            let row = self.place[piece.row.0] + piece.row.1;
            let start = self.place[piece.column.0] + piece.column.1;
            for column in within(&columns, start, piece.columns.count) {
                let from = piece.value + piece.columns.at(column - start) * piece.stride;
                let entries = &self.values[from..][..piece.length];
                most = most.max(largest(entries));
                part(row, column, piece.rows.count, &mut |to| {
                    apart &= piece.rows.copy(entries, to) || !piece.alone;
                });
            }
        }
        if !apart {
            self.is_coupled.store(true, Ordering::Relaxed);
        }
        self.largest.fetch_max(most.to_bits(), Ordering::Relaxed);
        for Child { front, places } in &self.children {
            let mut source = 0;
            for &(start, length) in places {
                for column in within(&columns, start, length) {
                    let [delayed, mut boundary] = front.left(source + column - start);
                    let mut add = |row: usize, entries: &[f64]| {
                        part(row, column, entries.len(), &mut |to| {
                            to.iter_mut().zip(entries).for_each(|(t, s)| *t += s);
                        });
                    };
                    add(places[0].0, delayed);
                    for &(row, length) in &places[1..] {
                        let (entries, others) = boundary.split_at(length);
                        add(row, entries);
                        boundary = others;
                    }
                }
                source += length;
            }
        }
    }
}

/// Those of so many columns from `start` on that are among these.
fn within(columns: &Range<usize>, start: usize, count: usize) -> Range<usize> {
    columns.start.max(start)..columns.end.min(start + count)
}
