//! What a long iteration has found of the preconditioned operator, for the solves after it with the
//! same equations or with similar ones. See docs/theory.md, section 8.3.

use super::least_squares::LeastSquares;
use super::long_vectors::Vectors;
use crate::numbers::Numbers;
use crate::workers::Workers;

/// `B V = V⁺ H` of Arnoldi's method, with `H = Q R`: `B` takes `U = V R⁻¹` to the orthonormal
/// `C = V⁺ Q`.
pub(super) struct Learnt {
    /// `V⁺`, one vector behind the other, and room for more.
    basis: Numbers,
    /// `Q` and `R`.
    hessenberg: LeastSquares,
    /// Of the inner product in which they are orthonormal.
    ends: [usize; 2],
    weights: [f64; 2],
    /// Entries of a vector.
    entries: usize,
}

impl Learnt {
    /// Of an iteration with these vectors of so many entries.
    pub fn new(
        basis: Numbers,
        hessenberg: LeastSquares,
        (ends, weights): ([usize; 2], [f64; 2]),
        entries: usize,
    ) -> Self {
        Learnt {
            basis,
            hessenberg,
            ends,
            weights,
            entries,
        }
    }

    /// Products that the iteration took.
    pub fn products(&self) -> usize {
        self.hessenberg.products()
    }

    fn basis(&self) -> &[f64] {
        &self.basis[..(self.products() + 1) * self.entries]
    }

    /// Whether it was of vectors of so many entries.
    pub fn is_of(&self, entries: usize) -> bool {
        self.entries == entries
    }

    /// `y += (U − C) Cᵀ y`: of a product with `B`, what it makes of `U` becomes `U` again, and of
    /// what it makes of all else nothing is left along `C`.
    pub fn apply(&self, y: &mut [f64], workers: &Workers) {
        let vectors = Vectors {
            workers,
            ends: self.ends,
            weights: self.weights,
        };
        let mut along = vectors.along(self.basis(), y);
        self.hessenberg.rotate(&mut along);
        if let Some(last) = along.last_mut() {
            *last = 0.0;
        }
        let inverse = self.hessenberg.triangle.solve(&along);
        self.hessenberg.rotate_back(&mut along);
        along.iter_mut().for_each(|c| *c = -*c);
        along.iter_mut().zip(&inverse).for_each(|(c, u)| *c += u);
        vectors.add(y, self.basis(), &along);
    }
}

#[cfg(test)]
mod tests {
    use super::super::gmres::{GmresOptions, GmresWorkspace, Preconditioned, gmres};
    use super::super::long_vectors::Parts;
    use super::*;

    /// Near identity, with a rotation, but for 20 directions in which it is from 0.001 to 20.
    struct Operator<'a> {
        changed: f64,
        learnt: Option<&'a Learnt>,
        workers: Workers,
    }

    const SIZE: usize = 300;

    impl Preconditioned for Operator<'_> {
        fn product(&mut self, x: &[f64], y: &mut [f64]) {
            for i in 0..SIZE {
                let near = 0.1 * (x[(i + 1) % SIZE] - x[(i + SIZE - 1) % SIZE]);
                let outlier = match i {
                    0..10 => 1e-3 * (i + 1) as f64,
                    10..20 => 2.0 * (i - 9) as f64,
                    _ => 1.0,
                };
                y[i] = (outlier + self.changed * (i as f64).cos()) * x[i] + near;
            }
        }

        fn precondition(&mut self, y: &mut [f64]) {
            if let Some(learnt) = self.learnt {
                learnt.apply(y, &self.workers);
            }
        }
    }

    /// Solves for a known solution; gives the products taken and the largest error.
    fn solve(
        changed: f64,
        learnt: Option<&Learnt>,
        seed: f64,
        workspace: &mut GmresWorkspace,
    ) -> (usize, f64) {
        let workers = Workers::default();
        let mut operator = Operator {
            changed,
            learnt,
            workers: workers.clone(),
        };
        let exact: Vec<f64> = (0..SIZE).map(|i| (seed * i as f64).sin()).collect();
        let mut x = vec![0.0; SIZE];
        operator.product(&exact, &mut x);
        let options = GmresOptions {
            tolerance: 1e-8,
            leading: 100,
            essential: SIZE,
            parts: Parts::Balanced,
            iteration_limit: 200,
            restart: 200,
            is_verified: true,
        };
        let end = gmres(&mut operator, &mut x, &options, &workers, workspace).unwrap();
        assert!(end.error <= 1e-8, "{end:?}");
        let errors = x.iter().zip(&exact).map(|(x, e)| (x - e).abs());
        (end.iterations, errors.fold(0.0, f64::max))
    }

    #[test]
    fn solves_after_a_long_one_take_fewer_products_and_find_the_same() {
        let workspace = &mut GmresWorkspace::default();
        let (first, _) = solve(0.0, None, 0.7, workspace);
        let learnt = workspace.learnt(SIZE).unwrap();
        assert_eq!(learnt.products(), first);
        // Of another right side, of the same operator and of one that has changed a little.
        for (changed, most) in [(0.0, first / 3), (1e-5, first / 2)] {
            let (without, _) = solve(changed, None, 1.9, &mut GmresWorkspace::default());
            let (with, error) = solve(changed, Some(&learnt), 1.9, workspace);
            println!("{first} {without} {with} {error:e}");
            assert!(with <= most && without > 2 * with && error < 1e-6);
        }
    }

    #[test]
    fn what_the_operator_makes_of_what_was_learnt_is_that_again() {
        let workspace = &mut GmresWorkspace::default();
        solve(0.0, None, 0.7, workspace);
        let learnt = workspace.learnt(SIZE).unwrap();
        let mut operator = Operator {
            changed: 0.0,
            learnt: Some(&learnt),
            workers: Workers::default(),
        };
        // U: any sum of the vectors but the last.
        let mut x = vec![0.0; SIZE];
        for (j, v) in learnt
            .basis
            .chunks_exact(SIZE)
            .take(learnt.products())
            .enumerate()
        {
            x.iter_mut()
                .zip(v)
                .for_each(|(x, v)| *x += (1.3 * j as f64).cos() * v);
        }
        let mut y = vec![0.0; SIZE];
        operator.product(&x, &mut y);
        operator.precondition(&mut y);
        let errors = x.iter().zip(&y).map(|(x, y)| (x - y).abs());
        let error = errors.fold(0.0, f64::max);
        println!("{error:e}");
        // Vectors may keep a millionth along others, and the operator's inverse is up to 1e3.
        assert!(error < 1e-5);
    }
}
