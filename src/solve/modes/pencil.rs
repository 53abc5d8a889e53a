//! The quadratic pencil `Q(s) = s² M + s C + K` of small motions, and its inverse at a shift.

use crate::collocation::{Linearisation, Pattern};
use crate::error::{Error, ErrorKind, Result};
use crate::workers::Workers;
use faer::MatMut;
use faer::linalg::solvers::Solve;
use faer::sparse::linalg::LuError;
use faer::sparse::linalg::solvers::{Lu, SymbolicLu};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use nalgebra::Complex;

/// Complex number.
pub(crate) type C64 = Complex<f64>;

/// `Q(s)`, scaled.
pub(crate) struct Pencil {
    pub pattern: Pattern,
    pub matrices: Linearisation,
    /// Who tells that work goes on.
    pub workers: Workers,
    symbolic: SymbolicLu<usize>,
}

impl Pencil {
    /// A pencil of matrices with this pattern.
    ///
    /// # Errors
    /// If memory runs out.
    pub fn new(pattern: Pattern, matrices: Linearisation, workers: Workers) -> Result<Self> {
        let symbolic = SymbolicLu::try_new(structure(&pattern)).map_err(|_| out_of_memory())?;
        Ok(Pencil {
            pattern,
            matrices,
            workers,
            symbolic,
        })
    }

    /// Number of unknowns.
    pub fn size(&self) -> usize {
        self.pattern.size()
    }

    /// `y += factor A x`, for a matrix with these `values`.
    pub fn add_product(&self, values: &[f64], factor: C64, x: &[C64], y: &mut [C64]) {
        let rows = self.pattern.row_indices();
        for (range, x) in self.pattern.column_pointers().windows(2).zip(x) {
            let scaled = factor * x;
            for (value, &row) in values[range[0]..range[1]].iter().zip(&rows[range[0]..]) {
                y[row] += scaled * *value;
            }
        }
    }

    /// `Q(s) x`.
    pub fn product(&self, s: C64, x: &[C64]) -> Vec<C64> {
        let mut y = vec![C64::default(); self.size()];
        self.add_product(&self.matrices.stiffness, C64::from(1.0), x, &mut y);
        self.add_product(&self.matrices.damping, s, x, &mut y);
        self.add_product(&self.matrices.mass, s * s, x, &mut y);
        y
    }

    /// Largest entry of `Q(s) x`, relative to the largest sum of the sizes of its terms.
    pub fn relative_residual(&self, s: C64, x: &[C64]) -> f64 {
        let mut sizes = vec![0.0; self.size()];
        let rows = self.pattern.row_indices();
        let terms = [
            (&self.matrices.stiffness, 1.0),
            (&self.matrices.damping, s.norm()),
            (&self.matrices.mass, s.norm_sqr()),
        ];
        for (values, factor) in terms {
            for (range, x) in self.pattern.column_pointers().windows(2).zip(x) {
                let scaled = factor * x.norm();
                for (value, &row) in values[range[0]..range[1]].iter().zip(&rows[range[0]..]) {
                    sizes[row] += scaled * value.abs();
                }
            }
        }
        let size = sizes.iter().copied().fold(0.0, f64::max);
        let residual = largest(&self.product(s, x));
        if size > 0.0 {
            residual / size
        } else {
            residual
        }
    }

    /// Largest entry of `K x`, relative to the largest ones of `K` and `x`: for a free motion, all
    /// terms of which may vanish.
    pub fn resistance(&self, x: &[C64]) -> f64 {
        let stiffest = self
            .matrices
            .stiffness
            .iter()
            .fold(0.0, |m: f64, v| m.max(v.abs()));
        let size = stiffest * largest(x);
        let resisted = largest(&self.product(C64::default(), x));
        if size > 0.0 { resisted / size } else { 0.0 }
    }

    /// Unknowns whose columns of `C` or `M` are not zero, and those of `M` alone.
    pub fn dynamic_unknowns(&self) -> (Vec<usize>, Vec<usize>) {
        let any = |values: &[f64], column: usize| {
            let pointers = self.pattern.column_pointers();
            values[pointers[column]..pointers[column + 1]]
                .iter()
                .any(|v| *v != 0.0)
        };
        let with_mass = |c: &usize| any(&self.matrices.mass, *c);
        let moving = |c: &usize| with_mass(c) || any(&self.matrices.damping, *c);
        (
            (0..self.size()).filter(moving).collect(),
            (0..self.size()).filter(with_mass).collect(),
        )
    }

    /// About the largest frequency of small motions, from the diagonals; 1 if these tell nothing.
    pub fn highest_frequency(&self) -> f64 {
        let diagonal = |values: &[f64]| -> Vec<f64> {
            let pointers = self.pattern.column_pointers();
            let rows = self.pattern.row_indices();
            (0..self.size())
                .map(|c| {
                    (pointers[c]..pointers[c + 1])
                        .find(|&at| rows[at] == c)
                        .map_or(0.0, |at| values[at].abs())
                })
                .collect()
        };
        let stiffness = diagonal(&self.matrices.stiffness);
        let damping = diagonal(&self.matrices.damping);
        let mass = diagonal(&self.matrices.mass);
        let largest_mass = mass.iter().copied().fold(0.0, f64::max);
        let mut highest = 0.0f64;
        for i in 0..self.size() {
            if mass[i] > 1e-12 * largest_mass {
                highest = highest.max((stiffness[i] / mass[i]).sqrt());
                highest = highest.max(if stiffness[i] == 0.0 {
                    damping[i] / mass[i]
                } else {
                    0.0
                });
            } else if damping[i] > 0.0 {
                highest = highest.max(stiffness[i] / damping[i]);
            }
        }
        if highest > 0.0 && highest.is_finite() {
            highest
        } else {
            1.0
        }
    }
}

/// Size of the largest entry.
fn largest(x: &[C64]) -> f64 {
    x.iter().fold(0.0, |m: f64, x| m.max(x.norm()))
}

/// `Q(σ)⁻¹` for a real or complex shift `σ`.
pub(crate) struct Inverse {
    shift: C64,
    factors: Lu<usize, C64>,
}

impl Inverse {
    /// Factors `Q(σ)`. `None` if it is singular.
    ///
    /// # Errors
    /// If memory runs out, or work is to end.
    pub fn new(pencil: &Pencil, shift: C64) -> Result<Option<Self>> {
        pencil.workers.pulse()?;
        let m = &pencil.matrices;
        let mut values: Vec<C64> = (0..pencil.pattern.entries())
            .map(|i| shift * shift * m.mass[i] + shift * m.damping[i] + m.stiffness[i])
            .collect();
        if let Some(compliance) = &m.compliance {
            values.iter_mut().zip(compliance).for_each(|(v, c)| *v += c);
        }
        let matrix = SparseColMatRef::new(structure(&pencil.pattern), &values);
        let factors = match Lu::try_new_with_symbolic(pencil.symbolic.clone(), matrix) {
            Err(LuError::SymbolicSingular { .. }) => return Ok(None),
            factors => factors.map_err(|_| out_of_memory())?,
        };
        let inverse = Inverse { shift, factors };
        // A pivot of zero is told by what it does to a solution.
        let ones = vec![C64::from(1.0); pencil.size()];
        let regular = inverse.solve_once(&ones).is_some();
        Ok(regular.then_some(inverse))
    }

    /// The shift.
    pub fn shift(&self) -> C64 {
        self.shift
    }

    /// Solves `Q(σ) x = b`, with iterative refinement, which also undoes the compliance of
    /// constraints. `None` if that overflows.
    pub fn solve(&self, pencil: &Pencil, b: &[C64]) -> Option<Vec<C64>> {
        let mut x = self.solve_once(b)?;
        let steps = if pencil.matrices.compliance.is_some() {
            3
        } else {
            1
        };
        for _ in 0..steps {
            let mut rest = pencil.product(self.shift, &x);
            rest.iter_mut().zip(b).for_each(|(r, b)| *r = b - *r);
            let correction = self.solve_once(&rest)?;
            x.iter_mut().zip(&correction).for_each(|(x, d)| *x += d);
        }
        Some(x)
    }

    /// Solves as the factors do, with what rounding and the compliance of constraints make of it.
    pub fn solve_once(&self, b: &[C64]) -> Option<Vec<C64>> {
        let (mut x, size) = (b.to_vec(), b.len());
        let column = MatMut::from_column_major_slice_mut(&mut x, size, 1);
        self.factors.solve_in_place(column);
        x.iter().all(|x| x.is_finite()).then_some(x)
    }

    /// The same with the transposed matrix.
    pub fn solve_transposed(&self, b: &[C64]) -> Option<Vec<C64>> {
        let (mut x, size) = (b.to_vec(), b.len());
        let column = MatMut::from_column_major_slice_mut(&mut x, size, 1);
        self.factors.solve_transpose_in_place(column);
        x.iter().all(|x| x.is_finite()).then_some(x)
    }
}

fn structure(pattern: &Pattern) -> SymbolicSparseColMatRef<'_, usize> {
    let (size, pointers) = (pattern.size(), pattern.column_pointers());
    SymbolicSparseColMatRef::new_checked(size, size, pointers, None, pattern.row_indices())
}

fn out_of_memory() -> Error {
    let message = "modes: no memory for the factors of the equations";
    Error::new(ErrorKind::OutOfMemory, message)
}
