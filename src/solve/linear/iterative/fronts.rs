//! LU factorisations of sparse matrices with one structure by fronts: what is eliminated together
//! stands in dense matrices, as large meshes have large ones. Pivots are sought among what is
//! eliminated together.

use super::front_lu::FrontLu;
use super::lanes::{Lanes, Number};
use crate::solve::linear::ordering::{FrontPlan, joined_fronts};
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::lu::partial_pivoting::factor::{lu_in_place, lu_in_place_scratch};
use faer::linalg::matmul::matmul;
use faer::linalg::triangular_solve::{
    solve_lower_triangular_in_place, solve_unit_lower_triangular_in_place,
};
use faer::{Accum, Mat, Par};
use std::collections::BTreeSet;

/// A pivot smaller than this, relative to its column, is none.
const SINGULAR: f64 = 1e-14;
/// Multiply-adds for each unknown from which on fronts are worth their copies.
const WORTH_COPIES: f64 = 3000.0;

/// Whether the elimination in this order takes so much that fronts pay.
pub(super) fn pay(sizes: &[usize], order: &[FrontPlan]) -> bool {
    let (mut work, mut unknowns) = (0.0, 0.0);
    for front in order {
        let size = |groups: &[usize]| groups.iter().map(|&g| sizes[g] as f64).sum::<f64>();
        let (own, rest) = (size(&front.own), size(&front.boundary));
        work += own * (own + rest).powi(2);
        unknowns += own;
    }
    work > WORTH_COPIES * unknowns
}

/// A block of the matrix: the place of its first entry, row by row, its first row and column in a
/// front, and its size.
#[derive(Debug, Clone, Copy)]
struct Block {
    place: usize,
    at: (usize, usize),
    size: (usize, usize),
}

/// What stands in a front.
#[derive(Debug, Clone)]
struct Front {
    /// Unknowns that are eliminated here, and then those that these are coupled with.
    unknowns: Vec<usize>,
    /// How many are eliminated.
    own: usize,
    /// Blocks of the matrix that enter here.
    blocks: Vec<Block>,
    /// Fronts whose remainders enter here.
    children: Vec<usize>,
    /// Of each group of the boundary: where it begins in the boundary and in the parent, its size.
    in_parent: Vec<(usize, usize, usize)>,
    /// Where there is no parent: blocks of the remainder.
    in_matrix: Vec<Block>,
}

/// Where everything stands.
#[derive(Debug, Clone)]
pub(super) struct Fronts {
    fronts: Vec<Front>,
}

impl Fronts {
    /// For groups with these `sizes` and couplings, and an order in which all are eliminated but
    /// those that are to be kept. `place` tells the place of a block of the matrix; remainders are
    /// asked for first.
    pub fn new(
        sizes: &[usize],
        coupled: &[BTreeSet<usize>],
        order: Vec<FrontPlan>,
        mut place: impl FnMut(usize, usize) -> usize,
    ) -> Self {
        let plans = joined_fronts(sizes, order);
        let mut first = Vec::with_capacity(sizes.len());
        sizes.iter().fold(0, |next, size| {
            first.push(next);
            next + size
        });
        let mut eliminated_in = vec![usize::MAX; sizes.len()];
        for (i, plan) in plans.iter().enumerate() {
            plan.own.iter().for_each(|&group| eliminated_in[group] = i);
        }
        let mut fronts: Vec<Front> = Vec::with_capacity(plans.len());
        for plan in &plans {
            let size = |groups: &[usize]| groups.iter().map(|&g| sizes[g]).sum::<usize>();
            let groups = plan.own.iter().chain(&plan.boundary);
            let unknowns = groups.flat_map(|&g| first[g]..first[g] + sizes[g]);
            let mut in_matrix = Vec::new();
            if plan.parent.is_none() {
                let begins = beginnings(sizes, plan.boundary.iter().copied());
                for (&row, &i) in plan.boundary.iter().zip(&begins) {
                    for (&column, &j) in plan.boundary.iter().zip(&begins) {
                        in_matrix.push(Block {
                            place: place(row, column),
                            at: (i, j),
                            size: (sizes[row], sizes[column]),
                        });
                    }
                }
            }
            fronts.push(Front {
                own: size(&plan.own),
                unknowns: unknowns.collect(),
                blocks: Vec::new(),
                children: plan.children.clone(),
                in_parent: Vec::new(),
                in_matrix,
            });
        }
        // Where each group begins in the front at hand.
        let mut at = vec![usize::MAX; sizes.len()];
        for (i, plan) in plans.iter().enumerate() {
            let groups = || plan.own.iter().chain(&plan.boundary).copied();
            let begins = beginnings(sizes, groups());
            groups().zip(&begins).for_each(|(g, &begin)| at[g] = begin);
            let mut blocks = Vec::new();
            let mut enter = |row: usize, column: usize| {
                blocks.push(Block {
                    place: place(row, column),
                    at: (at[row], at[column]),
                    size: (sizes[row], sizes[column]),
                });
            };
            for &group in &plan.own {
                enter(group, group);
                for &other in coupled[group].iter().filter(|&&other| other != group) {
                    if eliminated_in[other] >= i {
                        enter(group, other);
                    }
                    if eliminated_in[other] > i {
                        enter(other, group);
                    }
                }
            }
            fronts[i].blocks = blocks;
            for &child in &plan.children {
                let boundary = &plans[child].boundary;
                let begins = beginnings(sizes, boundary.iter().copied());
                let places = boundary.iter().zip(begins);
                let places = places.map(|(&g, begin)| (begin, at[g], sizes[g]));
                fronts[child].in_parent = places.collect();
            }
        }
        Fronts { fronts }
    }

    /// Factors the matrix in one of the lanes of its entries. None if it is singular.
    pub fn factor<T: Lanes>(&self, values: &[T], lane: usize) -> Option<Factors<T::Number>> {
        let mut workspace = MemBuffer::new(faer::dyn_stack::StackReq::EMPTY);
        let mut room = 0;
        let mut waiting: Vec<Mat<T::Number>> = Vec::new();
        let mut all = Factors {
            fronts: Vec::with_capacity(self.fronts.len()),
            kept: Vec::new(),
        };
        for front in &self.fronts {
            let (own, rest) = (front.own, front.unknowns.len() - front.own);
            if own > room {
                room = own;
                let need =
                    lu_in_place_scratch::<usize, T::Number>(own, own, Par::Seq, Default::default());
                workspace = MemBuffer::new(need);
            }
            let mut parts = Parts {
                own,
                upper: Mat::zeros(own, own + rest),
                lower: Mat::zeros(rest, own),
                remainder: Mat::zeros(rest, rest),
            };
            for block in &front.blocks {
                let (target, (first, column)) = parts.at(block.at);
                let (rows, columns) = block.size;
                for j in 0..columns {
                    let target = &mut target.col_as_slice_mut(column + j)[first..][..rows];
                    for (i, target) in target.iter_mut().enumerate() {
                        *target += values[block.place + i * columns + j].get(lane);
                    }
                }
            }
            for &child in front.children.iter().rev() {
                let remainder = waiting.pop()?;
                parts.add_remainder(&remainder, &self.fronts[child].in_parent);
            }
            let (lu, remainder) = parts.eliminate(&mut workspace)?;
            all.fronts.push(lu);
            match front.in_parent.is_empty() {
                false => waiting.push(remainder),
                true => all.kept.push(remainder),
            }
        }
        Some(all)
    }

    /// Adds to one of the lanes of a matrix what its factors have left of unknowns that are not
    /// eliminated.
    pub fn add_kept<T: Lanes>(
        &self,
        factors: &mut Factors<T::Number>,
        (values, lane): (&mut [T], usize),
    ) {
        let without_parent = self.fronts.iter().filter(|f| f.in_parent.is_empty());
        for (front, remainder) in without_parent.zip(factors.kept.drain(..)) {
            for block in &front.in_matrix {
                let (rows, columns) = block.size;
                for i in 0..rows {
                    for j in 0..columns {
                        let value = &mut values[block.place + i * columns + j];
                        let more = remainder[(block.at.0 + i, block.at.1 + j)];
                        value.set(lane, value.get(lane) + more);
                    }
                }
            }
        }
    }
}

/// Where groups begin that stand one after the other.
fn beginnings(sizes: &[usize], groups: impl Iterator<Item = usize>) -> Vec<usize> {
    let mut next = 0;
    let begin = |group: usize| {
        next += sizes[group];
        next - sizes[group]
    };
    groups.map(begin).collect()
}

/// A front, of which so many unknowns are eliminated.
struct Parts<N> {
    own: usize,
    upper: Mat<N>,
    lower: Mat<N>,
    remainder: Mat<N>,
}

impl<N: Number> Parts<N> {
    /// The part where an entry is, and its place there.
    fn at(&mut self, (i, j): (usize, usize)) -> (&mut Mat<N>, (usize, usize)) {
        let own = self.own;
        match (i < own, j < own) {
            (true, _) => (&mut self.upper, (i, j)),
            (false, true) => (&mut self.lower, (i - own, j)),
            (false, false) => (&mut self.remainder, (i - own, j - own)),
        }
    }

    fn add_remainder(&mut self, remainder: &Mat<N>, places: &[(usize, usize, usize)]) {
        for &(from_column, to_column, columns) in places {
            for &(from, to, rows) in places {
                let (target, (to, to_column)) = self.at((to, to_column));
                for j in 0..columns {
                    let target = &mut target.col_as_slice_mut(to_column + j)[to..][..rows];
                    let more = &remainder.col_as_slice(from_column + j)[from..][..rows];
                    target.iter_mut().zip(more).for_each(|(t, m)| *t += *m);
                }
            }
        }
    }

    /// The factors, and what remains of the boundary. None if there is no pivot.
    fn eliminate(mut self, workspace: &mut MemBuffer) -> Option<(FrontLu<N>, Mat<N>)> {
        let own = self.own;
        let largest = |matrix: &Mat<N>, j: usize| {
            let column = matrix.col_as_slice(j)[..own].iter();
            column.fold(0.0f64, |most, x| most.max((*x).modulus()))
        };
        let sizes: Vec<f64> = (0..own).map(|j| largest(&self.upper, j)).collect();
        let (mut permutation, mut inverse) = (vec![0usize; own], vec![0usize; own]);
        let (mut square, mut beyond) = self.upper.as_mut().split_at_col_mut(own);
        lu_in_place(
            square.as_mut(),
            &mut permutation,
            &mut inverse,
            Par::Seq,
            MemStack::new(workspace),
            Default::default(),
        );
        for (j, size) in sizes.iter().enumerate() {
            let pivot = square[(j, j)].modulus();
            // Written so that NaN fails too.
            let regular = pivot > SINGULAR * size && pivot.is_finite();
            if !regular {
                return None;
            }
        }
        let mut column = Vec::with_capacity(own);
        for j in 0..beyond.ncols() {
            column.clear();
            column.extend(permutation.iter().map(|&row| beyond[(row, j)]));
            (0..own).for_each(|i| beyond[(i, j)] = column[i]);
        }
        let square = square.as_ref();
        solve_unit_lower_triangular_in_place(square, beyond.as_mut(), Par::Seq);
        // L₂₁ U = F₂₁, transposed: Uᵀ L₂₁ᵀ = F₂₁ᵀ.
        let transposed = self.lower.as_mut().transpose_mut();
        solve_lower_triangular_in_place(square.transpose(), transposed, Par::Seq);
        let (lower, minus) = (self.lower.as_ref(), -N::from_real(1.0));
        matmul(
            self.remainder.as_mut(),
            Accum::Add,
            lower,
            beyond.as_ref(),
            minus,
            Par::Seq,
        );
        let lu = FrontLu::new(permutation, self.upper.as_ref(), self.lower.as_ref())?;
        Some((lu, self.remainder))
    }
}

/// Memory that a solution needs.
#[derive(Debug, Default)]
pub(super) struct FrontScratch<N> {
    x: Vec<N>,
    front: Vec<N>,
    own: Vec<N>,
}

/// The factors of a matrix.
#[derive(Debug, Clone)]
pub(super) struct Factors<N: Number> {
    fronts: Vec<FrontLu<N>>,
    /// What is left of unknowns that are not eliminated, until it is added to the matrix.
    kept: Vec<Mat<N>>,
}

impl<N: Number> Factors<N> {
    /// Bytes that they take.
    pub fn bytes(&self) -> usize {
        self.fronts.iter().map(FrontLu::bytes).sum()
    }

    /// Solves with `L` in one of the lanes of `x`: what is left at unknowns that are not eliminated
    /// is their reduced right-hand side. The solution stays in the memory.
    pub fn forward<T: Lanes<Number = N>>(
        &self,
        fronts: &Fronts,
        (x, lane): (&[T], usize),
        scratch: &mut FrontScratch<N>,
    ) {
        scratch.read(x, lane);
        let FrontScratch {
            x,
            front: part,
            own,
        } = scratch;
        for (front, lu) in fronts.fronts.iter().zip(&self.fronts) {
            part.clear();
            part.extend(front.unknowns.iter().map(|&unknown| x[unknown]));
            lu.forward(part, own);
            let solved = front.unknowns.iter().zip(&*part);
            solved.for_each(|(&unknown, value)| x[unknown] = *value);
        }
    }

    /// Solves with `U`, where unknowns that are not eliminated are known. The solution stays in the
    /// memory.
    pub fn backward<T: Lanes<Number = N>>(
        &self,
        fronts: &Fronts,
        (x, lane): (&[T], usize),
        scratch: &mut FrontScratch<N>,
    ) {
        scratch.read(x, lane);
        let FrontScratch { x, front: part, .. } = scratch;
        for (front, lu) in fronts.fronts.iter().zip(&self.fronts).rev() {
            part.clear();
            part.extend(front.unknowns.iter().map(|&unknown| x[unknown]));
            lu.backward(part);
            let solved = front.unknowns[..front.own].iter().zip(&*part);
            solved.for_each(|(&unknown, value)| x[unknown] = *value);
        }
    }
}

impl<N: Number> FrontScratch<N> {
    fn read<T: Lanes<Number = N>>(&mut self, x: &[T], lane: usize) {
        self.x.clear();
        self.x.extend(x.iter().map(|x| x.get(lane)));
    }

    /// Writes a solution to one of the lanes of `x`.
    pub fn write<T: Lanes<Number = N>>(&self, (x, lane): (&mut [T], usize)) {
        x.iter_mut().zip(&self.x).for_each(|(x, y)| x.set(lane, *y));
    }
}
