//! Sparse LU with faer: symbolic work once for a pattern, numeric work for each Jacobian.

use crate::collocation::Pattern;
use crate::error::{Error, ErrorKind, Result};
use faer::MatMut;
use faer::linalg::solvers::SolveCore;
use faer::sparse::linalg::LuError;
use faer::sparse::linalg::solvers::{Lu, SymbolicLu};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};

/// Direct solver for matrices of one pattern.
#[derive(Debug)]
pub struct DirectSolver {
    symbolic: SymbolicLu<usize>,
    factors: Option<Lu<usize, f64>>,
}

fn structure(pattern: &Pattern) -> SymbolicSparseColMatRef<'_, usize> {
    let size = pattern.size();
    SymbolicSparseColMatRef::new_checked(
        size,
        size,
        pattern.column_pointers(),
        None,
        pattern.row_indices(),
    )
}

impl DirectSolver {
    /// Orders and analyses matrices of `pattern`.
    pub fn new(pattern: &Pattern) -> Result<Self> {
        let symbolic = SymbolicLu::try_new(structure(pattern)).map_err(|e| {
            let message = format!("the Jacobian's factorisation does not fit in memory: {e:?}");
            Error::new(ErrorKind::OutOfMemory, message)
        })?;
        Ok(DirectSolver {
            symbolic,
            factors: None,
        })
    }

    /// Factors the matrix with these values. `false` if it is structurally singular.
    pub fn factor(&mut self, pattern: &Pattern, values: &[f64]) -> Result<bool> {
        let matrix = SparseColMatRef::new(structure(pattern), values);
        // Freed first, so that two factorisations never live at once.
        self.factors = None;
        match Lu::try_new_with_symbolic(self.symbolic.clone(), matrix) {
            Ok(factors) => {
                self.factors = Some(factors);
                Ok(true)
            }
            Err(LuError::SymbolicSingular { .. }) => Ok(false),
            Err(e) => {
                let message = format!("the Jacobian's factorisation failed: {e:?}");
                Err(Error::new(ErrorKind::OutOfMemory, message))
            }
        }
    }

    /// Solves in place. `false` if there are no factors or the result is not finite.
    pub fn solve(&self, rhs: &mut [f64]) -> bool {
        let Some(factors) = &self.factors else {
            return false;
        };
        let size = rhs.len();
        let column = MatMut::from_column_major_slice_mut(rhs, size, 1);
        factors.solve_in_place_with_conj(faer::Conj::No, column);
        rhs.iter().all(|x| x.is_finite())
    }
}
