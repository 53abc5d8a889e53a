//! Which fronts a matrix is eliminated by, and what enters each.

use crate::collocation::Panel;
use crate::solve::linear::front::{Front, elimination_work};
use crate::solve::linear::ordering::{FrontPlan, with_last};
use crate::solve::linear::two_branches::plan_for;
use crate::workers::parts;
use std::collections::BTreeSet;
use std::ops::Range;

/// What does not depend on the values of a matrix.
#[derive(Debug)]
pub(super) struct Analysis {
    pub groups: Vec<Range<usize>>,
    pub plans: Vec<FrontPlan>,
    /// Entries of the matrix that enter each front.
    pub panels: Vec<Vec<Panel>>,
    /// Those in the rows of each group.
    pub rows: Vec<Vec<Panel>>,
    /// Of each front with all those that lead to it, which come just before it: multiply-adds, and
    /// their number.
    pub subtrees: Vec<(f64, usize)>,
}

impl Analysis {
    /// Of unknowns in groups, of which the first are nodes, with these entries, for so many
    /// threads.
    pub fn new(
        (groups, node_groups): (Vec<Range<usize>>, usize),
        panels: Vec<Panel>,
        threads: usize,
    ) -> Self {
        let plans = Self::plans((&groups, node_groups), &panels, threads);
        Self::planned(groups, plans, panels)
    }

    /// The same, with a group more, which these entries `between` couple with all others.
    pub fn bordered(
        (mut groups, node_groups): (Vec<Range<usize>>, usize),
        mut panels: Vec<Panel>,
        (last, between): (Range<usize>, Vec<Panel>),
        threads: usize,
    ) -> Self {
        let plans = Self::plans((&groups, node_groups), &panels, threads);
        let plans = with_last(plans, groups.len());
        groups.push(last);
        panels.extend(between);
        Self::planned(groups, plans, panels)
    }

    fn plans(
        (groups, node_groups): (&[Range<usize>], usize),
        panels: &[Panel],
        threads: usize,
    ) -> Vec<FrontPlan> {
        let mut coupled = vec![BTreeSet::new(); groups.len()];
        for panel in panels {
            coupled[panel.row.0].insert(panel.column.0);
            coupled[panel.column.0].insert(panel.row.0);
        }
        let sizes: Vec<usize> = groups.iter().map(ExactSizeIterator::len).collect();
        plan_for(threads, &sizes, &coupled, node_groups)
    }

    fn planned(groups: Vec<Range<usize>>, plans: Vec<FrontPlan>, all_panels: Vec<Panel>) -> Self {
        let follows = |end: usize, group: &Range<usize>| (group.start == end).then_some(group.end);
        debug_assert!(
            groups.iter().try_fold(0, follows).is_some(),
            "a gap between groups"
        );
        let mut front_of = vec![0; groups.len()];
        for (f, front) in plans.iter().enumerate() {
            for &g in &front.own {
                front_of[g] = f;
            }
        }
        // An entry enters the front that is first to eliminate its row or column.
        let mut panels = vec![Vec::new(); plans.len()];
        let mut rows = vec![Vec::new(); groups.len()];
        for panel in all_panels {
            rows[panel.row.0].push(panel.clone());
            panels[front_of[panel.row.0].min(front_of[panel.column.0])].push(panel);
        }
        let size = |own: &[usize]| own.iter().map(|&g| groups[g].len()).sum::<usize>();
        let mut subtrees: Vec<(f64, usize)> = Vec::with_capacity(plans.len());
        for front in &plans {
            let own = elimination_work(size(&front.own), size(&front.boundary));
            let children = front.children.iter().map(|&child| subtrees[child]);
            subtrees.push(children.fold((own, 1), |sum, child| (sum.0 + child.0, sum.1 + child.1)));
        }
        Analysis {
            groups,
            plans,
            panels,
            rows,
            subtrees,
        }
    }

    /// The fronts that have no parents.
    pub fn roots(&self) -> Vec<usize> {
        let all = 0..self.plans.len();
        all.filter(|&f| self.plans[f].parent.is_none()).collect()
    }

    /// Multiply-adds of a factorisation, as planned.
    pub fn work(&self) -> f64 {
        self.roots().iter().map(|&root| self.subtrees[root].0).sum()
    }

    /// The subtrees that end with these fronts, which are in order, from `fronts` that begin with
    /// their first.
    pub fn split<'f>(
        &self,
        roots: &[usize],
        fronts: &'f mut [Front],
    ) -> Vec<(usize, &'f mut [Front])> {
        let counts = roots.iter().map(|&root| self.subtrees[root].1);
        roots.iter().copied().zip(parts(fronts, counts)).collect()
    }

    pub fn size_of(&self, groups: &[usize]) -> usize {
        groups.iter().map(|&g| self.groups[g].len()).sum()
    }
}
