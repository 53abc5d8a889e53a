//! The quadratic pencil `Q(s) = s² M + s C + K` of small motions, and its inverse at a shift.

use crate::collocation::{Linearisation, Panel, Pattern};
use crate::error::Result;
use crate::solve::linear::direct::DirectSolver;
use crate::workers::Workers;
use nalgebra::Complex;

/// Complex number.
pub(crate) type C64 = Complex<f64>;

/// `Q(s)`, scaled.
pub(crate) struct Pencil {
    pub pattern: Pattern,
    pub matrices: Linearisation,
    /// Who tells that work goes on.
    pub workers: Workers,
}

impl Pencil {
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
    solver: DirectSolver,
    /// For a complex shift: places of real and imaginary parts of each unknown.
    places: Option<Vec<[usize; 2]>>,
}

impl Inverse {
    /// Factors `Q(σ)`. `None` if it is singular.
    pub fn new(pencil: &Pencil, shift: C64) -> Result<Option<Self>> {
        let m = &pencil.matrices;
        let mut values: Vec<C64> = (0..pencil.pattern.entries())
            .map(|i| shift * shift * m.mass[i] + shift * m.damping[i] + m.stiffness[i])
            .collect();
        if let Some(compliance) = &m.compliance {
            values.iter_mut().zip(compliance).for_each(|(v, c)| *v += c);
        }
        if shift.im == 0.0 {
            let real: Vec<f64> = values.iter().map(|v| v.re).collect();
            let mut solver = DirectSolver::new(&pencil.pattern);
            solver.set_workers(pencil.workers.clone());
            let factored = solver.factor(&real)?;
            let inverse = Inverse {
                shift,
                solver,
                places: None,
            };
            return Ok(factored.then_some(inverse));
        }
        let (solver, places) = factor_complex(&pencil.pattern, &values, &pencil.workers)?;
        let inverse = |solver| Inverse {
            shift,
            solver,
            places: Some(places),
        };
        Ok(solver.map(inverse))
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

    fn solve_once(&self, b: &[C64]) -> Option<Vec<C64>> {
        let Some(places) = &self.places else {
            let mut parts = [vec![0.0; b.len()], vec![0.0; b.len()]];
            for (i, b) in b.iter().enumerate() {
                (parts[0][i], parts[1][i]) = (b.re, b.im);
            }
            for part in &mut parts {
                if part.iter().any(|x| *x != 0.0) && !self.solver.solve(part) {
                    return None;
                }
            }
            let [re, im] = parts;
            return Some(
                re.iter()
                    .zip(&im)
                    .map(|(re, im)| C64::new(*re, *im))
                    .collect(),
            );
        };
        let mut doubled = vec![0.0; 2 * b.len()];
        for (b, [re, im]) in b.iter().zip(places) {
            (doubled[*re], doubled[*im]) = (b.re, b.im);
        }
        self.solver.solve(&mut doubled).then(|| {
            let at = |[re, im]: &[usize; 2]| C64::new(doubled[*re], doubled[*im]);
            places.iter().map(at).collect()
        })
    }
}

/// Factors a complex matrix as the real one `[Re −Im; Im Re]`, with both parts of each group
/// together.
fn factor_complex(
    pattern: &Pattern,
    values: &[C64],
    workers: &Workers,
) -> Result<(Option<DirectSolver>, Vec<[usize; 2]>)> {
    let groups = pattern.groups();
    let mut places = vec![[0; 2]; pattern.size()];
    for group in &groups {
        for i in group.clone() {
            let first = 2 * group.start + (i - group.start);
            places[i] = [first, first + group.len()];
        }
    }
    // The values of the four parts one after another, column by column.
    let mut doubled = Vec::with_capacity(4 * values.len());
    doubled.extend(values.iter().map(|v| v.re));
    doubled.extend(values.iter().map(|v| v.im));
    doubled.extend(values.iter().map(|v| -v.im));
    doubled.extend(values.iter().map(|v| v.re));
    let panels = pattern.panels().into_iter().flat_map(|panel| {
        let (rows, columns) = (groups[panel.row.0].len(), groups[panel.column.0].len());
        [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(row_part, column_part)| Panel {
            row: (panel.row.0, panel.row.1 + row_part * rows),
            column: (panel.column.0, panel.column.1 + column_part * columns),
            value: panel.value + (2 * column_part + row_part) * values.len(),
            ..panel
        })
    });
    let doubled_groups = groups.iter().map(|g| 2 * g.start..2 * g.end).collect();
    let mut solver = DirectSolver::with_panels(doubled_groups, pattern.node_groups(), panels);
    solver.set_workers(workers.clone());
    let factored = solver.factor(&doubled)?;
    Ok((factored.then_some(solver), places))
}
