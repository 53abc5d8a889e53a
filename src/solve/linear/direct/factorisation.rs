//! A factorisation, front by front, subtrees of them side by side.

use crate::error::Result;
use crate::solve::linear::dense::largest;
use crate::solve::linear::direct::analysis::Analysis;
use crate::solve::linear::front::{Front, FrontWorkspace, LARGE_FRONT, NoPivot, make_zero};
use crate::workers::{Spare, Workers};
use faer::{Mat, Par};
use rayon::iter::{IntoParallelIterator, ParallelIterator};
use std::iter::once;
use std::ops::Range;

/// Most forks of the tree of fronts, one above the other, where threads part: each takes memory on
/// the stack.
const MOST_FORKS: usize = 32;

/// What a factorisation is of, and how.
pub(super) struct Factorisation<'a> {
    analysis: &'a Analysis,
    values: &'a [f64],
    smallest_pivot: f64,
    workspaces: Spare<FrontWorkspace>,
    workers: &'a Workers,
}

impl<'a> Factorisation<'a> {
    pub fn new(
        analysis: &'a Analysis,
        values: &'a [f64],
        smallest_pivot: f64,
        workers: &'a Workers,
    ) -> Self {
        Factorisation {
            analysis,
            values,
            smallest_pivot,
            workspaces: Spare::default(),
            workers,
        }
    }

    /// Factors all fronts. `false` if the matrix is singular.
    pub fn run(&self, fronts: &mut [Front]) -> Result<bool> {
        self.workers.dense(|parallelism| match parallelism {
            Par::Seq => self.factor_in_order(0..fronts.len(), (0, fronts), parallelism),
            Par::Rayon(_) => {
                let subtrees = self.analysis.split(&self.analysis.roots(), fronts);
                self.factor_all(subtrees, MOST_FORKS, parallelism)
            }
        })
    }

    /// Factors subtrees, each with its fronts, in parallel. `false` if a singular front has no
    /// parent.
    fn factor_all(
        &self,
        subtrees: Vec<(usize, &mut [Front])>,
        forks: usize,
        parallelism: Par,
    ) -> Result<bool> {
        let results = subtrees
            .into_par_iter()
            .map(|(root, fronts)| self.factor_subtree(root, fronts, forks, parallelism));
        results.reduce(|| Ok(true), |a, b| Ok(a? && b?))
    }

    /// Factors a subtree; where it divides, in parallel, for so many forks one above the other.
    fn factor_subtree(
        &self,
        root: usize,
        fronts: &mut [Front],
        forks: usize,
        parallelism: Par,
    ) -> Result<bool> {
        let analysis = self.analysis;
        let first = root + 1 - fronts.len();
        let mut fork = root;
        while let [child] = analysis.plans[fork].children[..] {
            fork = child;
        }
        let mut next = first;
        if forks > 0 && analysis.subtrees[fork].0 > LARGE_FRONT {
            let before = &mut fronts[..fork - first];
            let subtrees = analysis.split(&analysis.plans[fork].children, before);
            if !self.factor_all(subtrees, forks - 1, parallelism)? {
                return Ok(false);
            }
            next = fork;
        }
        self.factor_in_order(next..root + 1, (first, fronts), parallelism)
    }

    /// Factors some of `fronts`, of which front `first` is the first, one after the other; what
    /// leads to them has been factored.
    fn factor_in_order(
        &self,
        some: Range<usize>,
        (first, fronts): (usize, &mut [Front]),
        parallelism: Par,
    ) -> Result<bool> {
        let mut workspace = self
            .workspaces
            .take(|| FrontWorkspace::new(self.analysis.groups.len(), self.workers));
        for f in some {
            self.workers.pulse()?;
            if !self.factor(f, (first, fronts), &mut workspace, parallelism)? {
                return Ok(false);
            }
        }
        self.workspaces.give(workspace);
        Ok(true)
    }

    /// Factors front `f`, one of `fronts`, of which front `first` is the first. `false` if it is
    /// singular and has no parent.
    fn factor(
        &self,
        f: usize,
        (first, fronts): (usize, &mut [Front]),
        workspace: &mut FrontWorkspace,
        parallelism: Par,
    ) -> Result<bool> {
        let analysis = self.analysis;
        let plan = &analysis.plans[f];
        let (before, front) = fronts.split_at_mut(f - first);
        let front = &mut front[0];
        front.rows.clear();
        for &g in &plan.own {
            workspace.place[g] = front.rows.len();
            front.rows.extend(analysis.groups[g].clone());
        }
        front.columns.clone_from(&front.rows);
        workspace.sizes.clear();
        workspace.sizes.resize(front.rows.len(), 0.0);
        for &child in &plan.children {
            let child = &before[child - first];
            front.rows.extend(&child.delayed_rows);
            front.columns.extend(&child.delayed_columns);
            workspace.sizes.extend(&child.delayed_sizes);
        }
        let mut size = front.rows.len();
        for &g in &plan.boundary {
            workspace.place[g] = size;
            size += analysis.groups[g].len();
        }
        let assemble = |front: &mut Front, place: &[usize]| {
            self.assemble(f, (first, &*before), place, (front, size))
        };
        let no_pivot = match plan.parent {
            Some(_) => NoPivot::Waits(self.smallest_pivot),
            None => NoPivot::Ends,
        };
        if !front.eliminate(assemble, no_pivot, workspace, parallelism)? {
            return Ok(false);
        }
        for &child in &plan.children {
            before[child - first].remainder = Mat::new();
        }
        // Where the entries have just been read.
        front.largest_entry = 0.0;
        for panel in &analysis.panels[f] {
            for column in 0..panel.columns {
                let entries = &self.values[panel.value + column * panel.stride..][..panel.rows];
                front.largest_entry = front.largest_entry.max(largest(entries));
            }
        }
        Ok(true)
    }

    /// Sums up front `f` of `size` unknowns from the matrix and what is left of the fronts that
    /// lead to it, which are among `fronts` from front `first` on. Group `g` begins at `place[g]`.
    fn assemble(
        &self,
        f: usize,
        (first, fronts): (usize, &[Front]),
        place: &[usize],
        (front, size): (&mut Front, usize),
    ) -> Result<()> {
        let analysis = self.analysis;
        let plan = &analysis.plans[f];
        let count = front.rows.len();
        let rest = size - count;
        make_zero(&mut front.upper, count, size)?;
        make_zero(&mut front.lower, rest, count)?;
        make_zero(&mut front.remainder, rest, rest)?;
        // Part of a column, of rows that belong together.
        let mut part =
            |row: usize, column: usize, length: usize, work: &mut dyn FnMut(&mut [f64])| {
                let whole = if row < count {
                    &mut front.upper.col_as_slice_mut(column)[row..]
                } else if column < count {
                    &mut front.lower.col_as_slice_mut(column)[row - count..]
                } else {
                    &mut front.remainder.col_as_slice_mut(column - count)[row - count..]
                };
                work(&mut whole[..length]);
            };
        for panel in &analysis.panels[f] {
            let row = place[panel.row.0] + panel.row.1;
            let first = place[panel.column.0] + panel.column.1;
            for column in 0..panel.columns {
                let entries = &self.values[panel.value + column * panel.stride..][..panel.rows];
                part(row, first + column, panel.rows, &mut |to| {
                    to.copy_from_slice(entries);
                });
            }
        }
        // Behind the own groups comes what the fronts that lead here have delayed.
        let mut delayed_place = analysis.size_of(&plan.own);
        for &child in &plan.children {
            let delayed = fronts[child - first].delayed_rows.len();
            let groups = &analysis.plans[child].boundary;
            let groups = groups.iter().map(|&g| (place[g], analysis.groups[g].len()));
            let parts: Vec<(usize, usize)> = once((delayed_place, delayed)).chain(groups).collect();
            delayed_place += delayed;
            let remainder = &fronts[child - first].remainder;
            let columns = parts
                .iter()
                .flat_map(|&(place, length)| place..place + length);
            for (source_column, column) in columns.enumerate() {
                let mut source = remainder.col_as_slice(source_column);
                for &(row, length) in &parts {
                    let (entries, others) = source.split_at(length);
                    source = others;
                    part(row, column, length, &mut |to| {
                        to.iter_mut().zip(entries).for_each(|(t, s)| *t += s);
                    });
                }
            }
        }
        Ok(())
    }
}
