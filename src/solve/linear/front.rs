//! One front of the multifrontal solver: its own unknowns are eliminated by dense kernels, as far
//! as they have pivots.

use crate::error::Result;
use crate::solve::linear::blocks::{self, Diagonal};
use crate::solve::linear::dense::largest;
use crate::solve::linear::lu;
use crate::solve::linear::partial_lu::factor_partially;
use crate::workers::Workers;
use faer::{Mat, MatRef, Par};

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
    /// `L`, `U` and, to their right, `U₁₂`; before, `F₁₁` and `F₁₂`.
    pub upper: Mat<f64>,
    /// `L₂₁`; before, `F₂₁`.
    pub lower: Mat<f64>,
    /// Whether it was found singular on its own: what has no pivot waits for the parent's ever
    /// after.
    waits: bool,
    /// Equations and unknowns without pivots.
    pub delayed_rows: Vec<usize>,
    pub delayed_columns: Vec<usize>,
    /// How large these columns have been: what is left of them may be rounding.
    pub delayed_sizes: Vec<f64>,
    /// What is left of their entries, and behind them of those of the boundary, until the parent
    /// takes it.
    pub remainder: Mat<f64>,
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

/// Gives a matrix this size; what is in it is to be written.
pub(crate) fn make_room(matrix: &mut Mat<f64>, rows: usize, columns: usize) -> Result<()> {
    if (matrix.nrows(), matrix.ncols()) == (rows, columns) {
        return Ok(());
    }
    *matrix = Mat::new();
    blocks::reserve(matrix, rows, columns)?;
    matrix.resize_with(rows, columns, |_, _| 0.0);
    Ok(())
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
            upper: Mat::new(),
            lower: Mat::new(),
            waits: false,
            delayed_rows: Vec::new(),
            delayed_columns: Vec::new(),
            delayed_sizes: Vec::new(),
            remainder: Mat::new(),
            largest_entry: 0.0,
        }
    }

    /// Numbers that its factors take.
    pub fn numbers(&self) -> usize {
        let (upper, lower) = (&self.upper, &self.lower);
        upper.nrows() * upper.ncols() + lower.nrows() * lower.ncols()
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
            *size = size.max(largest(self.upper.col_as_slice(j)));
        }
    }

    fn parallelism(&self, parallelism: Par) -> Par {
        let (count, rest) = (self.lower.ncols(), self.lower.nrows());
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
        let count = self.upper.nrows();
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
        if !lu::factor(self.upper.as_mut(), order, accepts, all)? {
            return Ok(false);
        }
        self.rows = order.iter().map(|&row| self.rows[row]).collect();
        let (factors, beyond) = self.upper.as_ref().split_at_col(count);
        // L₂₁ U = F₂₁, transposed: Uᵀ L₂₁ᵀ = F₂₁ᵀ.
        let transposed = self.lower.as_mut().transpose_mut();
        blocks::solve_lower(
            (factors.transpose(), Diagonal::Own),
            transposed,
            parallelism,
            workers,
        )?;
        blocks::subtract_matmul(
            self.remainder.as_mut(),
            self.lower.as_ref(),
            beyond,
            parallelism,
            workers,
        )?;
        Ok(true)
    }

    /// Eliminates the unknowns that have pivots.
    fn eliminate_some(
        &mut self,
        smallest_pivot: f64,
        workspace: &mut FrontWorkspace,
        parallelism: Par,
    ) -> Result<()> {
        let (own, size) = (self.upper.nrows(), self.upper.ncols());
        self.measure_columns(&mut workspace.sizes);
        // A column that is tiny but for its rows in the boundary has its pivot there.
        for (j, size) in workspace.sizes.iter_mut().enumerate() {
            *size = size.max(BOUNDARY_SHARE * largest(self.lower.col_as_slice(j)));
        }
        let parallelism = self.parallelism(parallelism);
        let mut order: Vec<usize> = (0..own).collect();
        let count = factor_partially(
            &mut self.upper,
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

        let delayed = own - count;
        let (factored, unfactored) = self.upper.as_ref().split_at_row(count);
        let mut upper = Mat::new();
        make_room(&mut upper, count, size)?;
        upper.copy_from(factored);
        let mut lower = Mat::new();
        make_room(&mut lower, size - count, count)?;
        let (mut above, mut below) = lower.as_mut().split_at_row_mut(delayed);
        above.copy_from(unfactored.subcols(0, count));
        let column = |j: usize| self.lower.col(order[j]);
        (0..count).for_each(|j| below.as_mut().col_mut(j).copy_from(column(j)));
        let square = upper.as_ref().subcols(0, count);
        let transposed = below.as_mut().transpose_mut();
        blocks::solve_lower(
            (square.transpose(), Diagonal::Own),
            transposed,
            parallelism,
            &workspace.workers,
        )?;

        let mut remainder = Mat::new();
        make_room(&mut remainder, size - count, size - count)?;
        let (mut first_rows, mut rest) = remainder.as_mut().split_at_row_mut(delayed);
        first_rows.copy_from(unfactored.subcols(count, size - count));
        for j in 0..delayed {
            rest.as_mut().col_mut(j).copy_from(column(count + j));
        }
        let boundary = rest.as_mut().subcols_mut(delayed, size - own);
        { boundary }.copy_from(self.remainder.as_ref());
        let beyond: MatRef<f64> = upper.as_ref().subcols(count, size - count);
        let workers = &workspace.workers;
        blocks::subtract_matmul(rest, below.as_ref(), beyond, parallelism, workers)?;
        (self.upper, self.lower, self.remainder) = (upper, lower, remainder);
        Ok(())
    }
}
