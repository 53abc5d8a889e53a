//! Which fronts a matrix is eliminated by, and what enters each.

use super::parts::{Divided, Parts, Piece};
use super::structure::Structure;
use crate::solve::linear::front::{Front, elimination_work};
use crate::solve::linear::ordering::{FrontPlan, with_last};
use crate::solve::linear::two_branches::plan_for;
use crate::workers::parts;
use std::collections::BTreeSet;
use std::ops::Range;

/// Multiply-adds of a factorisation that are worth a look for parts that do not act on each other.
const WORTH_PARTS: f64 = 3e6;

/// What depends on which entries of a matrix are zero, and not on their values.
#[derive(Debug)]
pub(super) struct Analysis {
    /// Groups that are eliminated: those of the matrix, or parts of them.
    pub groups: Vec<Range<usize>>,
    /// Place of each unknown among those of the groups, where these are divided.
    pub places: Option<Vec<usize>>,
    pub plans: Vec<FrontPlan>,
    /// Entries of the matrix that enter each front.
    pub pieces: Vec<Vec<Piece>>,
    /// Of each front with all those that lead to it, which come just before it: multiply-adds, and
    /// their number.
    pub subtrees: Vec<(f64, usize)>,
    /// Numbers of factors that are not worth parts: those of the whole, as planned.
    pub most_numbers: usize,
    /// Which unknowns act on each other, as far as matrices have told; none if they may all.
    pub parts: Option<Parts>,
}

impl Analysis {
    /// Of any matrix of this structure, for so many threads.
    pub fn new(structure: &Structure, threads: usize) -> Self {
        let mut analysis = Self::whole(structure, threads);
        if structure.instants > 1 && analysis.work() > WORTH_PARTS {
            analysis.parts = Some(Parts::new(structure));
        }
        analysis
    }

    /// Of the same, whatever acts on what.
    pub fn whole(structure: &Structure, threads: usize) -> Self {
        Self::planned(structure, Divided::whole(structure), threads)
    }

    /// Whether no matrix has told yet which unknowns act on each other.
    pub fn is_undivided(&self) -> bool {
        self.parts.is_some() && self.places.is_none()
    }

    /// Of those that have what these `values` couple coupled, too.
    pub fn coupled(&self, structure: &Structure, values: &[f64], threads: usize) -> Option<Self> {
        let mut parts = self.parts.clone()?;
        parts.join_coupled(structure, values);
        let whole = parts.are_whole();
        let divided = (!whole).then(|| Divided::new(structure, &parts)).flatten();
        let parts = divided.is_some().then_some(parts);
        let divided = divided.unwrap_or_else(|| Divided::whole(structure));
        let planned = Self::planned(structure, divided, threads);
        let most_numbers = match planned.places {
            // From the first, which was of the whole.
            Some(_) if self.places.is_none() => self.numbers(),
            Some(_) => self.most_numbers,
            None => usize::MAX,
        };
        Some(Analysis {
            parts,
            most_numbers,
            ..planned
        })
    }

    fn planned(structure: &Structure, divided: Divided, threads: usize) -> Self {
        let Divided {
            groups,
            nodes,
            pieces: all_pieces,
            places,
        } = divided;
        let follows = |end: usize, group: &Range<usize>| (group.start == end).then_some(group.end);
        debug_assert!(
            groups.iter().try_fold(0, follows).is_some(),
            "a gap between groups"
        );
        let plans = plans(structure, (&groups, nodes), &all_pieces, threads);
        let mut front_of = vec![0; groups.len()];
        for (f, front) in plans.iter().enumerate() {
            for &g in &front.own {
                front_of[g] = f;
            }
        }
        // An entry enters the front that is first to eliminate its row or column.
        let mut pieces = vec![Vec::new(); plans.len()];
        for piece in all_pieces {
            pieces[front_of[piece.row.0].min(front_of[piece.column.0])].push(piece);
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
            places,
            plans,
            pieces,
            subtrees,
            most_numbers: usize::MAX,
            parts: None,
        }
    }

    /// Numbers of factors, as planned.
    fn numbers(&self) -> usize {
        let fronts = self.plans.iter().map(|plan| {
            let own = self.size_of(&plan.own);
            own * (own + 2 * self.size_of(&plan.boundary))
        });
        fronts.sum()
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

/// Fronts for groups, of which the first are nodes, with these entries; that of borders, if any,
/// comes last.
fn plans(
    structure: &Structure,
    (groups, nodes): (&[Range<usize>], usize),
    pieces: &[Piece],
    threads: usize,
) -> Vec<FrontPlan> {
    let count = groups.len() - usize::from(structure.is_bordered);
    let mut coupled = vec![BTreeSet::new(); count];
    for piece in pieces {
        let (row, column) = (piece.row.0, piece.column.0);
        if row < count && column < count {
            coupled[row].insert(column);
            coupled[column].insert(row);
        }
    }
    let sizes: Vec<usize> = groups[..count].iter().map(ExactSizeIterator::len).collect();
    let plans = plan_for(threads, &sizes, &coupled, nodes);
    match structure.is_bordered {
        true => with_last(plans, count),
        false => plans,
    }
}
