//! One front of the multifrontal solver: its own unknowns are eliminated by dense kernels, as far
//! as they have pivots.

use crate::error::Result;
use crate::solve::linear::block::{Block, BlockView, SpareBlocks, TwoBlocks};
use crate::solve::linear::blocks::{self, Diagonal};
use crate::solve::linear::dense::largest;
use crate::solve::linear::lu;
use crate::solve::linear::partial_lu::factor_partially;
use crate::workers::Workers;
use faer::perm::swap_cols_idx;
use faer::{MatMut, Par};

/// Multiply-adds of a front, or several, that are worth sharing among threads.
pub(crate) const LARGE_FRONT: f64 = 2e7;

/// Smallest pivot, relative to its column, of a front that leaves something to its parent: to leave
/// more costs little there.
const SMALLEST_PARTIAL_PIVOT: f64 = 1e-4;

/// What rows in the boundary count of in the size of a column there.
const BOUNDARY_SHARE: f64 = 1e-2;

/// A front, and then its factors: `P F₁₁ Q = L U`, `U₁₂`, `L₂₁`.
#[derive(Debug)]
pub(crate) struct Front {
    /// Equations and unknowns of the matrix that are to be eliminated here; then those that are, in
    /// the order of their pivots.
    pub rows: Vec<usize>,
    pub columns: Vec<usize>,
    /// `L`, `U` and, to their right, `U₁₂`; before, `F₁₁` and `F₁₂`. Below them are the rows of
    /// equations without pivots: of `L`, and what is left. Then `L₂₁`, and to its right what is
    /// left of unknowns without pivots; before, `F₂₁`.
    pub factors: TwoBlocks,
    /// Whether it was found singular on its own: what has no pivot waits for the parent's ever
    /// after.
    waits: bool,
    /// Equations and unknowns without pivots.
    pub delayed_rows: Vec<usize>,
    pub delayed_columns: Vec<usize>,
    /// How large these columns have been: what is left of them may be rounding.
    pub delayed_sizes: Vec<f64>,
    /// What is left of the boundary, for the parent to take.
    pub remainder: Block,
    /// Largest entry of the matrix that enters here.
    pub largest_entry: f64,
}

/// What becomes of unknowns without pivots.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum NoPivot {
    /// Where pivots are no larger than this, relative to their columns, the parent has them.
    Waits(f64),
    /// The matrix is singular.
    Ends,
}

/// Multiply-adds of the elimination of so many unknowns, with so many others in their rows and
/// columns.
pub(crate) fn elimination_work(count: usize, rest: usize) -> f64 {
    let (own, rest) = (count as f64, rest as f64);
    own * own * own / 3.0 + own * own * rest + own * rest * rest
}

/// Memory that the factorisation of a front needs.
pub(crate) struct FrontWorkspace {
    /// Where each group begins in the front.
    pub place: Vec<usize>,
    order: Vec<usize>,
    /// Sizes of columns.
    pub sizes: Vec<f64>,
    /// Who tells that work goes on.
    workers: Workers,
}

impl FrontWorkspace {
    pub fn new(groups: usize, workers: &Workers) -> Self {
        FrontWorkspace {
            workers: workers.alone(),
            place: vec![usize::MAX; groups],
            order: Vec::new(),
            sizes: Vec::new(),
        }
    }
}

impl Front {
    pub fn empty() -> Self {
        Front {
            rows: Vec::new(),
            columns: Vec::new(),
            factors: TwoBlocks::default(),
            waits: false,
            delayed_rows: Vec::new(),
            delayed_columns: Vec::new(),
            delayed_sizes: Vec::new(),
            remainder: Block::default(),
            largest_entry: 0.0,
        }
    }

    /// The first of its factors.
    pub fn upper(&self) -> BlockView<'_> {
        self.factors.both()[0]
    }

    /// The second.
    pub fn lower(&self) -> BlockView<'_> {
        self.factors.both()[1]
    }

    /// Numbers of its factors.
    pub fn numbers(&self) -> usize {
        let count = self.rows.len();
        count * (count + 2 * self.left_over())
    }

    /// How many unknowns are left, without pivots and of the boundary.
    pub fn left_over(&self) -> usize {
        self.upper().columns().saturating_sub(self.rows.len())
    }

    /// The rows of a column of the factors below their pivots: of equations without pivots, and of
    /// the boundary.
    fn below(&self, column: usize) -> [&[f64]; 2] {
        let upper = &self.upper().column(column)[self.rows.len()..];
        [upper, self.lower().column(column)]
    }

    /// A column of what is left, of unknowns without pivots and then of the boundary: rows of
    /// equations without pivots, and of the boundary.
    pub fn left(&self, column: usize) -> [&[f64]; 2] {
        let place = self.rows.len() + column;
        match place.checked_sub(self.upper().rows()) {
            None => self.below(place),
            Some(beyond) => {
                let upper = &self.upper().column(place)[self.rows.len()..];
                [upper, self.remainder.column(beyond)]
            }
        }
    }

    /// Gives it `own` rows and columns, and `rest` in the boundary; what is in it is to be written.
    ///
    /// # Errors
    /// If memory runs out.
    pub fn resize(&mut self, own: usize, rest: usize, spare: &SpareBlocks) -> Result<()> {
        self.factors.resize([(own, own + rest), (rest, own)])?;
        if (self.remainder.rows(), self.remainder.columns()) != (rest, rest) {
            self.release(spare);
            self.remainder = spare.take(rest, rest)?;
        }
        Ok(())
    }

    /// Gives back the memory of what was left of the boundary.
    pub fn release(&mut self, spare: &SpareBlocks) {
        spare.give(std::mem::take(&mut self.remainder));
    }

    /// Eliminates the unknowns of the front, which `assemble` sums up, but for those without
    /// pivots. `workspace` tells the sizes that columns have had before.
    ///
    /// `false` if something is left that may not be.
    ///
    /// # Errors
    /// If memory runs out.
    pub fn eliminate(
        &mut self,
        assemble: impl Fn(&mut Self, &[usize]) -> Result<()>,
        no_pivot: NoPivot,
        workspace: &mut FrontWorkspace,
        parallelism: Par,
    ) -> Result<bool> {
        self.delayed_rows.clear();
        self.delayed_columns.clear();
        self.delayed_sizes.clear();
        let smallest_pivot = match no_pivot {
            NoPivot::Waits(smallest) => smallest,
            NoPivot::Ends => 0.0,
        };
        if !self.waits {
            assemble(self, &workspace.place)?;
            if self.eliminate_all(smallest_pivot, workspace, parallelism)? {
                return Ok(true);
            }
        }
        self.waits = no_pivot != NoPivot::Ends;
        if !self.waits {
            return Ok(false);
        }
        assemble(self, &workspace.place)?;
        self.eliminate_some(
            smallest_pivot.max(SMALLEST_PARTIAL_PIVOT),
            workspace,
            parallelism,
        )?;
        Ok(true)
    }

    /// Updates the largest sizes that its columns have had.
    fn measure_columns(&self, sizes: &mut [f64]) {
        for (j, size) in sizes.iter_mut().enumerate() {
            *size = size.max(largest(self.upper().column(j)));
        }
    }

    fn parallelism(&self, parallelism: Par) -> Par {
        let (count, rest) = (self.lower().columns(), self.lower().rows());
        match elimination_work(count, rest) < LARGE_FRONT {
            true => Par::Seq,
            false => parallelism,
        }
    }

    /// Eliminates all unknowns. `false` if their block is singular, or has too small a pivot.
    fn eliminate_all(
        &mut self,
        smallest_pivot: f64,
        workspace: &mut FrontWorkspace,
        parallelism: Par,
    ) -> Result<bool> {
        let count = self.upper().rows();
        self.measure_columns(&mut workspace.sizes);
        let parallelism = self.parallelism(parallelism);
        let FrontWorkspace {
            order,
            sizes,
            workers,
            ..
        } = workspace;
        order.resize(count, 0);
        // Written so that NaN fails too.
        let accepts = |j: usize, pivot: f64| pivot > smallest_pivot * sizes[j] && pivot.is_finite();
        let all = (parallelism, &*workers);
        let [upper, _] = self.factors.both_mut();
        if !lu::factor(upper, order, accepts, all)? {
            return Ok(false);
        }
        self.rows = order.iter().map(|&row| self.rows[row]).collect();
        self.reduce_boundary(parallelism, workers)?;
        Ok(true)
    }

    /// Reduces the rows of the boundary, once the unknowns that have pivots are known.
    fn reduce_boundary(&mut self, parallelism: Par, workers: &Workers) -> Result<()> {
        let (count, own) = (self.rows.len(), self.upper().rows());
        let [upper, lower] = self.factors.both_mut();
        let (square, beyond) = upper.as_ref().subrows(0, count).split_at_col(count);
        let (delayed, boundary) = beyond.split_at_col(own - count);
        let (mut lower, left) = lower.split_at_col_mut(count);
        // L₂₁ U = F₂₁, transposed: Uᵀ L₂₁ᵀ = F₂₁ᵀ.
        let transposed = lower.as_mut().transpose_mut();
        let square = (square.transpose(), Diagonal::Own);
        blocks::solve_lower(square, transposed, parallelism, workers)?;
        let remainder = self.remainder.as_mut();
        for (left, beyond) in [(left, delayed), (remainder, boundary)] {
            blocks::subtract_matmul(left, lower.as_ref(), beyond, parallelism, workers)?;
        }
        Ok(())
    }

    /// Eliminates the unknowns that have pivots.
    fn eliminate_some(
        &mut self,
        smallest_pivot: f64,
        workspace: &mut FrontWorkspace,
        parallelism: Par,
    ) -> Result<()> {
        let own = self.upper().rows();
        self.measure_columns(&mut workspace.sizes);
        // A column that is tiny but for its rows in the boundary has its pivot there.
        for (j, size) in workspace.sizes.iter_mut().enumerate() {
            *size = size.max(BOUNDARY_SHARE * largest(self.lower().column(j)));
        }
        let parallelism = self.parallelism(parallelism);
        let mut order: Vec<usize> = (0..own).collect();
        let [upper, _] = self.factors.both_mut();
        let count = factor_partially(
            upper,
            &mut self.rows,
            &mut order,
            &mut workspace.sizes,
            smallest_pivot,
            (parallelism, &workspace.workers),
        )?;
        self.columns = order.iter().map(|&column| self.columns[column]).collect();
        self.delayed_rows = self.rows.split_off(count);
        self.delayed_columns = self.columns.split_off(count);
        self.delayed_sizes
            .extend_from_slice(&workspace.sizes[count..]);
        let [_, lower] = self.factors.both_mut();
        exchange_columns(lower, order);
        self.reduce_boundary(parallelism, &workspace.workers)
    }
}

/// Puts the columns of a matrix in this order.
fn exchange_columns(mut matrix: MatMut<f64>, mut order: Vec<usize>) {
    for j in 0..order.len() {
        // Around the cycle that begins here.
        let mut to = j;
        while order[to] != j {
            let from = order[to];
            swap_cols_idx(matrix.as_mut(), to, from);
            order[to] = to;
            to = from;
        }
        order[to] = to;
    }
}
