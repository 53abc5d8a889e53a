//! LU factorisations of many small sparse matrices with one structure: those of all harmonics, or
//! of all grid points. Blocks are those of nodes; pivots are sought within a block.

use super::fronts::{Factors, FrontScratch, Fronts, pay};
use super::lane_blocks::{add_block_product, invert, two};
use super::lanes::{LANES, Lanes};
use crate::motion::vectorised;
use crate::solve::linear::ordering::{FrontPlan, NEVER, elimination};
use crate::workers::Workers;
use std::collections::{BTreeMap, BTreeSet};

/// Where blocks are, and the order of elimination.
#[derive(Debug, Clone)]
pub(super) struct BlockStructure {
    sizes: Vec<usize>,
    /// First unknown of each block row.
    first: Vec<usize>,
    unknowns: usize,
    /// Block by block, or in fronts.
    steps: Vec<Step>,
    fronts: Option<Fronts>,
    /// Pairs of rows that are not eliminated, with the places of their blocks.
    kept: Vec<(usize, usize, usize)>,
    /// First entry of each block.
    blocks: BTreeMap<(usize, usize), usize>,
    entries: usize,
    /// Rows that have no blocks.
    left_out: Vec<bool>,
}

/// Where entries of a part of a block are.
#[derive(Debug, Clone, Copy)]
pub(super) struct BlockPlace {
    first: usize,
    /// From one row to the next, and from one column to the next.
    steps: (usize, usize),
}

impl BlockPlace {
    /// Place of entry `(i, j)`.
    pub fn entry(&self, i: usize, j: usize) -> usize {
        self.first + i * self.steps.0 + j * self.steps.1
    }
}

/// Elimination of one block row.
#[derive(Debug, Clone)]
struct Step {
    pivot: usize,
    pivot_block: usize,
    /// Rows eliminated later, with the places of the blocks in their column and in the pivot's row.
    later: Vec<(usize, usize, usize)>,
    /// Places of the blocks that change, for each pair of `later`.
    changed: Vec<usize>,
}

impl BlockStructure {
    /// For block rows with these `sizes` and couplings, of which some are `kept`, not eliminated.
    pub fn new(sizes: Vec<usize>, coupled: Vec<BTreeSet<usize>>, kept: &[bool]) -> Self {
        let waiting = kept.iter().map(|kept| if *kept { NEVER } else { 0 });
        let order = elimination(&sizes, &coupled, waiting.collect());
        let in_fronts = pay(&sizes, &order);
        Self::in_order((sizes, coupled), kept, order, in_fronts)
    }

    /// The same of all rows but those that are `left_out`; none where that is done in fronts.
    pub fn without(
        sizes: Vec<usize>,
        mut coupled: Vec<BTreeSet<usize>>,
        kept: &[bool],
        left_out: &[bool],
    ) -> Option<Self> {
        for (row, others) in coupled.iter_mut().enumerate() {
            others.retain(|&other| !left_out[row] && !left_out[other]);
        }
        let waits = |(kept, left_out): (&bool, &bool)| if *kept || *left_out { NEVER } else { 0 };
        let waiting = kept.iter().zip(left_out).map(waits).collect();
        let order = elimination(&sizes, &coupled, waiting);
        let left_out = left_out.to_vec();
        let in_fronts = pay(&sizes, &order);
        (!in_fronts).then(|| Self::of_rows((sizes, coupled), (kept, left_out), order, false))
    }

    /// For block rows with these sizes and couplings, eliminated in this order.
    pub(super) fn in_order(
        (sizes, coupled): (Vec<usize>, Vec<BTreeSet<usize>>),
        kept: &[bool],
        order: Vec<FrontPlan>,
        in_fronts: bool,
    ) -> Self {
        let left_out = vec![false; sizes.len()];
        Self::of_rows((sizes, coupled), (kept, left_out), order, in_fronts)
    }

    fn of_rows(
        (sizes, coupled): (Vec<usize>, Vec<BTreeSet<usize>>),
        (kept, left_out): (&[bool], Vec<bool>),
        order: Vec<FrontPlan>,
        in_fronts: bool,
    ) -> Self {
        let mut first = Vec::with_capacity(sizes.len());
        let mut unknowns = 0;
        for size in &sizes {
            first.push(unknowns);
            unknowns += size;
        }
        let mut blocks = BTreeMap::new();
        let mut entries = 0;
        let mut place = |row: usize, column: usize| {
            *blocks.entry((row, column)).or_insert_with(|| {
                entries += sizes[row] * sizes[column];
                entries - sizes[row] * sizes[column]
            })
        };
        // What is kept comes first, for the rest to be dropped where there are fronts.
        for (row, neighbours) in coupled.iter().enumerate().filter(|(row, _)| kept[*row]) {
            for &column in neighbours.iter().chain([&row]).filter(|&&c| kept[c]) {
                place(row, column);
            }
        }
        let (steps, fronts) = match in_fronts {
            true => {
                let fronts = Fronts::new(&sizes, &coupled, order, &mut place);
                (Vec::new(), Some(fronts))
            }
            false => (steps(&order, &mut place), None),
        };
        for (row, neighbours) in coupled
            .iter()
            .enumerate()
            .filter(|(row, _)| !left_out[*row])
        {
            for &column in neighbours.iter().chain([&row]) {
                place(row, column);
            }
        }
        let kept: Vec<_> = blocks
            .iter()
            .filter(|((row, column), _)| kept[*row] && kept[*column])
            .map(|(&(row, column), &place)| (row, column, place))
            .collect();
        BlockStructure {
            kept,
            sizes,
            first,
            unknowns,
            steps,
            fronts,
            blocks,
            entries,
            left_out,
        }
    }

    /// Sets to zero what stands at rows that have no blocks.
    pub fn silence<T: Lanes>(&self, x: &mut [T]) {
        for (row, _) in self.left_out.iter().enumerate().filter(|(_, out)| **out) {
            let (first, size) = self.part(row);
            x[first..first + size].fill(T::zero());
        }
    }

    /// Whether a row has no blocks.
    pub fn leaves_out(&self, row: usize) -> bool {
        self.left_out[row]
    }

    /// Number of unknowns.
    pub fn unknowns(&self) -> usize {
        self.unknowns
    }

    /// Number of block rows.
    pub fn rows(&self) -> usize {
        self.sizes.len()
    }

    /// Unknowns of a block row.
    pub fn size(&self, row: usize) -> usize {
        self.sizes[row]
    }

    /// First unknown of a block row.
    pub fn first(&self, row: usize) -> usize {
        self.first[row]
    }

    /// First unknown of a block row, and their number.
    #[inline(always)]
    fn part(&self, row: usize) -> (usize, usize) {
        (self.first[row], self.sizes[row])
    }

    /// What begins at an unknown of a block row and at one of a block column, whose block must be
    /// there.
    pub fn block_at(
        &self,
        (row, first_row): (usize, usize),
        (column, first_column): (usize, usize),
    ) -> BlockPlace {
        BlockPlace {
            first: self.entry((row, column), (first_row, first_column)),
            steps: (self.sizes[column], 1),
        }
    }

    /// The same of the block that stands in its place in the transpose, seen as it is in the matrix
    /// itself.
    pub fn transposed_block_at(&self, row: (usize, usize), column: (usize, usize)) -> BlockPlace {
        let BlockPlace { first, steps } = self.block_at(column, row);
        BlockPlace {
            first,
            steps: (steps.1, steps.0),
        }
    }

    /// The same; none if that block is not there.
    pub fn find(
        &self,
        (row, first_row): (usize, usize),
        (column, first_column): (usize, usize),
    ) -> Option<BlockPlace> {
        let columns = self.sizes[column];
        let first = self.blocks.get(&(row, column))? + first_row * columns + first_column;
        let steps = (columns, 1);
        Some(BlockPlace { first, steps })
    }

    /// Place of entry `(i, j)` of the block `(row, column)`, which must be there.
    pub fn entry(&self, (row, column): (usize, usize), (i, j): (usize, usize)) -> usize {
        self.blocks[&(row, column)] + i * self.sizes[column] + j
    }

    /// Pairs of rows that are not eliminated, with the places of their blocks.
    pub fn kept(&self) -> &[(usize, usize, usize)] {
        &self.kept
    }
}

/// The elimination of one block row after the other, where `place` tells places of blocks.
fn steps(order: &[FrontPlan], mut place: impl FnMut(usize, usize) -> usize) -> Vec<Step> {
    let step = |front: &FrontPlan| {
        let pivot = front.own[0];
        let pivot_block = place(pivot, pivot);
        let later = front.boundary.iter();
        let later = later.map(|&other| (other, place(other, pivot), place(pivot, other)));
        let later = later.collect();
        let pairs = front.boundary.iter();
        let pairs = pairs.flat_map(|&row| front.boundary.iter().map(move |&column| (row, column)));
        Step {
            pivot,
            pivot_block,
            later,
            changed: pairs.map(|(row, column)| place(row, column)).collect(),
        }
    };
    order.iter().map(step).collect()
}

/// [`LANES`] matrices, or their factors: `L` and `U` without the diagonal blocks, and these
/// inverted; or those of fronts, and what is kept.
#[derive(Debug, Clone)]
pub(super) struct BlockLanes<T: Lanes> {
    values: Vec<T>,
    /// How many of them differ.
    used: usize,
    fronts: Vec<Factors<T::Number>>,
}

/// Memory that a solution needs.
pub(super) struct Scratch<T: Lanes> {
    lanes: Vec<T>,
    /// Of each lane.
    fronts: Vec<FrontScratch<T::Number>>,
}

impl<T: Lanes> Default for Scratch<T> {
    fn default() -> Self {
        Scratch {
            lanes: Vec::new(),
            fronts: Vec::new(),
        }
    }
}

impl<T: Lanes> BlockLanes<T> {
    /// Zero matrices, of which so many will differ: others are like the last of these.
    pub fn new(structure: &BlockStructure, used: usize) -> Self {
        BlockLanes {
            values: vec![T::zero(); structure.entries],
            used: used.min(LANES),
            fronts: Vec::new(),
        }
    }

    /// Bytes that the factors take.
    pub fn bytes(&self) -> usize {
        let fronts = self.fronts.iter().map(Factors::bytes);
        size_of_val(&self.values[..]) + fronts.sum::<usize>()
    }

    /// Makes all that are not used like the last that is.
    pub fn repeat_last(&mut self) {
        for lane in self.used..LANES {
            for value in &mut self.values {
                value.set(lane, value.get(self.used - 1));
            }
        }
    }

    /// The entry at a place.
    pub fn at(&mut self, place: usize) -> &mut T {
        &mut self.values[place]
    }

    /// The same, to be read.
    pub fn get(&self, place: usize) -> &T {
        &self.values[place]
    }

    /// Factors all matrices in place, but for rows that are kept: there remain their Schur
    /// complements. `false` if one is singular.
    pub fn factor(&mut self, structure: &BlockStructure, workers: &Workers) -> bool {
        match &structure.fronts {
            Some(fronts) => self.factor_fronts(structure, fronts, workers),
            None => vectorised(
                #[inline(always)]
                || self.factor_blocks(structure),
            ),
        }
    }

    fn factor_fronts(
        &mut self,
        structure: &BlockStructure,
        fronts: &Fronts,
        workers: &Workers,
    ) -> bool {
        let mut all: Vec<Option<Factors<T::Number>>> = vec![None; self.used];
        let values = &self.values;
        workers.each(&mut all, |lane, factors| {
            *factors = fronts.factor(values, lane)
        });
        for (lane, factors) in all.into_iter().enumerate() {
            let Some(mut factors) = factors else {
                return false;
            };
            fronts.add_kept(&mut factors, (&mut self.values, lane));
            self.fronts.push(factors);
        }
        // Where the last kept block ends.
        let kept = structure.kept.iter();
        let ends = kept
            .map(|&(row, column, place)| place + structure.sizes[row] * structure.sizes[column]);
        self.values.truncate(ends.max().unwrap_or(0));
        self.values.shrink_to_fit();
        true
    }

    #[inline(always)]
    fn factor_blocks(&mut self, structure: &BlockStructure) -> bool {
        let (mut left, mut exchanged) = (Vec::new(), Vec::new());
        for step in &structure.steps {
            let size = structure.sizes[step.pivot];
            let pivot = &mut self.values[step.pivot_block..][..size * size];
            if !invert(pivot, size, &mut exchanged) {
                return false;
            }
            for &(row, below, _) in &step.later {
                let (rows, count) = (structure.sizes[row], structure.sizes[row] * size);
                left.clear();
                left.extend_from_slice(&self.values[below..][..count]);
                let (inverse, target) = two(
                    &mut self.values,
                    (step.pivot_block, size * size),
                    (below, count),
                );
                target.fill(T::zero());
                add_block_product::<T, false>(target, &left, inverse, (rows, size, size));
            }
            for (r, &(row, below, _)) in step.later.iter().enumerate() {
                let rows = structure.sizes[row];
                left.clear();
                left.extend_from_slice(&self.values[below..][..rows * size]);
                for (c, &(column, _, beside)) in step.later.iter().enumerate() {
                    let columns = structure.sizes[column];
                    let changed = step.changed[r * step.later.len() + c];
                    let (right, target) = two(
                        &mut self.values,
                        (beside, size * columns),
                        (changed, rows * columns),
                    );
                    add_block_product::<T, true>(target, &left, right, (rows, size, columns));
                }
            }
        }
        true
    }

    /// Solves with `L`: what is left at rows that are kept is their reduced right-hand side.
    pub fn forward(
        &self,
        structure: &BlockStructure,
        x: &mut [T],
        (scratch, workers): (&mut Scratch<T>, &Workers),
    ) {
        if let Some(fronts) = &structure.fronts {
            self.by_fronts(x, (scratch, workers), |factors, x, scratch| {
                factors.forward(fronts, x, scratch)
            });
        }
        vectorised(
            #[inline(always)]
            || self.forward_by_blocks(structure, x),
        );
    }

    #[inline(always)]
    fn forward_by_blocks(&self, structure: &BlockStructure, x: &mut [T]) {
        for step in &structure.steps {
            for &(row, below, _) in &step.later {
                let (pivot, target) = two(x, structure.part(step.pivot), structure.part(row));
                let (rows, columns) = (target.len(), pivot.len());
                let block = &self.values[below..][..rows * columns];
                add_block_product::<T, true>(target, block, pivot, (rows, columns, 1));
            }
        }
    }

    /// Solves with `U`, where rows that are kept are known.
    pub fn backward(
        &self,
        structure: &BlockStructure,
        x: &mut [T],
        (scratch, workers): (&mut Scratch<T>, &Workers),
    ) {
        if let Some(fronts) = &structure.fronts {
            self.by_fronts(x, (scratch, workers), |factors, x, scratch| {
                factors.backward(fronts, x, scratch)
            });
        }
        vectorised(
            #[inline(always)]
            || self.backward_by_blocks(structure, x, &mut scratch.lanes),
        );
    }

    #[inline(always)]
    fn backward_by_blocks(&self, structure: &BlockStructure, x: &mut [T], scratch: &mut Vec<T>) {
        for step in structure.steps.iter().rev() {
            for &(row, _, beside) in &step.later {
                let (other, target) = two(x, structure.part(row), structure.part(step.pivot));
                let (rows, columns) = (target.len(), other.len());
                let block = &self.values[beside..][..rows * columns];
                add_block_product::<T, true>(target, block, other, (rows, columns, 1));
            }
            let (first, size) = structure.part(step.pivot);
            scratch.clear();
            scratch.extend_from_slice(&x[first..first + size]);
            let target = &mut x[first..first + size];
            target.fill(T::zero());
            let inverse = &self.values[step.pivot_block..][..size * size];
            add_block_product::<T, false>(target, inverse, scratch, (size, size, 1));
        }
    }

    /// Solves with factors of fronts, one lane beside the other.
    fn by_fronts(
        &self,
        x: &mut [T],
        (scratch, workers): (&mut Scratch<T>, &Workers),
        solve: impl Fn(&Factors<T::Number>, (&[T], usize), &mut FrontScratch<T::Number>) + Sync,
    ) {
        let scratch = &mut scratch.fronts;
        scratch.resize_with(self.fronts.len(), FrontScratch::default);
        let given = &*x;
        workers.each(scratch, |lane, scratch| {
            solve(&self.fronts[lane], (given, lane), scratch)
        });
        for (lane, solved) in scratch.iter().enumerate() {
            solved.write((x, lane));
        }
    }

    /// Adds to `y` the product of the Schur complements and `x`, at rows that are kept.
    pub fn add_kept_product(&self, structure: &BlockStructure, x: &[T], y: &mut [T]) {
        for &(row, column, place) in &structure.kept {
            let (first, columns) = structure.part(column);
            let x = &x[first..first + columns];
            let (first, rows) = structure.part(row);
            let block = &self.values[place..][..rows * columns];
            add_block_product::<T, false>(
                &mut y[first..first + rows],
                block,
                x,
                (rows, columns, 1),
            );
        }
    }
}
