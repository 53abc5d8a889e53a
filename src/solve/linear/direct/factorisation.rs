//! A factorisation, front by front, subtrees of them side by side.

use crate::error::Result;
use crate::solve::linear::block::SpareBlocks;
use crate::solve::linear::direct::analysis::Analysis;
use crate::solve::linear::direct::sum::Sum;
use crate::solve::linear::front::{Front, FrontWorkspace, LARGE_FRONT, NoPivot};
use crate::workers::{Spare, Workers, join};
use faer::Par;
use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};

/// Most forks of the tree of fronts, one above the other, where threads part: each takes memory on
/// the stack.
const MOST_FORKS: usize = 32;

/// What a factorisation is of, and how.
pub(super) struct Factorisation<'a> {
    analysis: &'a Analysis,
    values: &'a [f64],
    smallest_pivot: f64,
    workspaces: Spare<FrontWorkspace>,
    /// Memory for what fronts leave.
    remainders: &'a SpareBlocks,
    workers: &'a Workers,
    /// Whether the matrix couples parts that were taken not to act on each other.
    is_coupled: AtomicBool,
}

impl<'a> Factorisation<'a> {
    pub fn new(
        analysis: &'a Analysis,
        values: &'a [f64],
        smallest_pivot: f64,
        (remainders, workers): (&'a SpareBlocks, &'a Workers),
    ) -> Self {
        Factorisation {
            analysis,
            values,
            smallest_pivot,
            workspaces: Spare::default(),
            remainders,
            workers,
            is_coupled: AtomicBool::new(false),
        }
    }

    /// Whether the matrix couples parts that were taken not to act on each other: what was factored
    /// is another one.
    pub fn is_coupled(&self) -> bool {
        self.is_coupled.load(Ordering::Relaxed)
    }

    /// Factors all fronts. `false` if the matrix is singular.
    pub fn run(&self, fronts: &mut [Front]) -> Result<bool> {
        self.workers.dense(|parallelism| match parallelism {
            Par::Seq => self.factor_in_order(0..fronts.len(), (0, fronts), parallelism),
            Par::Rayon(_) => {
                let mut subtrees = self.analysis.split(&self.analysis.roots(), fronts);
                self.factor_all(&mut subtrees, MOST_FORKS, parallelism)
            }
        })
    }

    /// Factors subtrees, each with its fronts, in parallel. `false` if a singular front has no
    /// parent.
    fn factor_all(
        &self,
        subtrees: &mut [(usize, &mut [Front])],
        forks: usize,
        parallelism: Par,
    ) -> Result<bool> {
        if let [(root, fronts)] = subtrees {
            return self.factor_subtree(*root, fronts, forks, parallelism);
        }
        if subtrees.is_empty() {
            return Ok(true);
        }
        let (some, others) = subtrees.split_at_mut(subtrees.len() / 2);
        let all = |subtrees| self.factor_all(subtrees, forks, parallelism);
        let (some, others) = join(|| all(some), || all(others));
        Ok(some? && others?)
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
            let mut subtrees = analysis.split(&analysis.plans[fork].children, before);
            if !self.factor_all(&mut subtrees, forks - 1, parallelism)? {
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
            let placed = (place, &self.is_coupled);
            let sum = Sum::new((analysis, self.values), f, (first, &*before), placed);
            front.resize(front.rows.len(), size - front.rows.len(), self.remainders)?;
            sum.write(front, (parallelism, self.workers))
        };
        let no_pivot = match plan.parent {
            Some(_) => NoPivot::Waits(self.smallest_pivot),
            None => NoPivot::Ends,
        };
        if !front.eliminate(assemble, no_pivot, workspace, parallelism)? {
            return Ok(false);
        }
        for &child in &plan.children {
            before[child - first].release(self.remainders);
        }
        Ok(true)
    }
}
