//! GMRES with a preconditioner from the left, so that errors are measured by what they mean for the
//! unknowns, not by residuals, in which stiff directions drown soft ones. See docs/theory.md,
//! section 8.3.

use super::learnt::Learnt;
use super::least_squares::LeastSquares;
use super::long_vectors::{Parts, SMALLEST_SHARE, Vectors, small_norm};
use crate::error::Result;
use crate::memory;
use crate::numbers::Numbers;
use crate::workers::Workers;

/// A cycle that leaves more than this of the residual is the last.
const STAGNATION: f64 = 0.9;

/// Products after which it shows whether a solve comes to an end.
const TELLING: usize = 30;
/// It does not if it would take this many times the products that are allowed, at the rate so far:
/// convergence becomes faster on the way.
const HOPELESS: f64 = 1.5;

/// Error relative to the whole solution that is not undercut.
const FINEST: f64 = 1e-10;

/// When to stop.
#[derive(Debug, Clone, Copy)]
pub(crate) struct GmresOptions {
    /// Estimated error, relative to the smaller part of the solution.
    pub tolerance: f64,
    /// Entries of the first of its two parts, motions: the others, multipliers, may be of quite
    /// another size.
    pub leading: usize,
    /// Entries of both parts; what comes behind them is not asked for.
    pub essential: usize,
    /// How the two parts count.
    pub parts: Parts,
    /// Most products.
    pub iteration_limit: usize,
    /// Products between restarts, for which vectors are kept.
    pub restart: usize,
    /// Whether one more product shows in the end what is left: rounding in the preconditioner is
    /// seen by that alone. Not where the residual is found anyway.
    pub is_verified: bool,
}

/// How it ended.
#[derive(Debug, Clone, Copy)]
pub(crate) struct GmresEnd {
    /// Products taken.
    pub iterations: usize,
    /// Estimated error, relative to the smaller part of the solution: the preconditioned residual,
    /// amplified as much as the preconditioned operator may amplify it.
    pub error: f64,
    /// Whether a cycle has brought no more: rounding may allow no less.
    pub stagnated: bool,
}

/// Memory for long vectors, kept from one solve with a matrix to the next, as taking it takes time.
#[derive(Default)]
pub(crate) struct GmresWorkspace {
    /// Room for orthonormal vectors, one behind the other, of which a cycle fills the first.
    basis: Numbers,
    /// The right-hand side.
    b: Vec<f64>,
    /// What is left of it, preconditioned.
    rest: Vec<f64>,
    /// What the last cycle found of the operator, and the inner product in which it did.
    found: Option<(LeastSquares, [usize; 2], [f64; 2])>,
}

/// What memory is taken for.
const VECTORS: &str = "vectors of the iteration";
/// Vectors that are kept at least, where memory is short.
const LEAST_KEPT: usize = 20;
/// Vectors that a solve takes beside those.
const BESIDE: usize = 16;

impl GmresWorkspace {
    /// Takes the memory of a solve for a right side of so many entries, which keeps fewer vectors
    /// where there is not enough.
    ///
    /// # Errors
    /// [`crate::error::ErrorKind::OutOfMemory`].
    pub fn take(&mut self, options: &mut GmresOptions, entries: usize) -> Result<()> {
        options.restart = options.restart.min(options.iteration_limit);
        while self.basis.len() < (options.restart + 1) * entries {
            // That of the solves before first.
            self.basis = Numbers::default();
            let count = |vectors: usize| (options.restart + vectors).saturating_mul(entries);
            let room = memory::require_items(VECTORS, count(BESIDE), size_of::<f64>());
            match room.and_then(|()| Numbers::room(VECTORS, count(1))) {
                Ok(basis) => self.basis = basis,
                Err(_) if options.restart > LEAST_KEPT => {
                    options.restart = (options.restart / 2).max(LEAST_KEPT);
                }
                Err(error) => return Err(error),
            }
        }
        Ok(())
    }

    /// What the last cycle has found of the operator, of vectors of so many entries, with the
    /// memory for these.
    pub(super) fn learnt(&mut self, entries: usize) -> Option<Learnt> {
        let (hessenberg, ends, weights) = self.found.take()?;
        let basis = std::mem::take(&mut self.basis);
        Some(Learnt::new(basis, hessenberg, (ends, weights), entries))
    }
}

/// A preconditioned operator: what is asked of it are `P⁻¹ A x` and `P⁻¹ b`, in place.
pub(crate) trait Preconditioned {
    /// `y = A x`.
    fn product(&mut self, x: &[f64], y: &mut [f64]);
    /// `y = P⁻¹ y`.
    fn precondition(&mut self, y: &mut [f64]);
}

/// Solves `A x = b` from `x = 0`: `rhs` is `b` before and `x` after. What `workspace` holds does
/// not matter.
pub(crate) fn gmres(
    operator: &mut impl Preconditioned,
    rhs: &mut [f64],
    options: &GmresOptions,
    workers: &Workers,
    workspace: &mut GmresWorkspace,
) -> Result<GmresEnd> {
    let mut options = *options;
    workspace.take(&mut options, rhs.len())?;
    let options = &options;
    let mut vectors = Vectors {
        workers,
        ends: [options.leading, options.essential],
        weights: [1.0, 1.0],
    };
    for copy in [&mut workspace.b, &mut workspace.rest] {
        copy.clear();
        copy.extend_from_slice(rhs);
    }
    workspace.found = None;
    operator.precondition(&mut workspace.rest);
    if options.parts == Parts::Balanced {
        // The solution's two parts are about as large as those of this.
        let sizes = vectors.sizes(&mut workspace.rest);
        let larger = sizes[0].max(sizes[1]);
        let least = SMALLEST_SHARE.max(FINEST / options.tolerance).min(1.0);
        // Written so that NaN does not count.
        if larger > 0.0 {
            vectors.weights = sizes.map(|size| 1.0 / (size / larger).clamp(least, 1.0));
        }
    }
    let start = vectors.norm(&mut workspace.rest);
    rhs.fill(0.0);
    let end = GmresEnd {
        iterations: 0,
        error: if start == 0.0 { 0.0 } else { 1.0 },
        stagnated: false,
    };
    if start == 0.0 || !start.is_finite() {
        return Ok(end);
    }
    let mut run = Run {
        operator,
        vectors,
        options,
        workspace,
        share: None,
        is_hopeless: false,
        end,
    };
    while run.end.error > options.tolerance && run.end.iterations < options.iteration_limit {
        let before = run.vectors.norm(&mut run.workspace.rest);
        let progress = (run.cycle(rhs, before)).is_some_and(|left| left < STAGNATION * before);
        if run.is_hopeless {
            break;
        }
        if !progress {
            run.end.stagnated = run.end.error > options.tolerance;
            break;
        }
    }
    Ok(run.end)
}

/// A solve on its way.
struct Run<'a, P> {
    operator: &'a mut P,
    vectors: Vectors<'a>,
    options: &'a GmresOptions,
    workspace: &'a mut GmresWorkspace,
    /// What the smaller part is of the solution, once that is known.
    share: Option<f64>,
    is_hopeless: bool,
    end: GmresEnd,
}

impl<P: Preconditioned> Run<'_, P> {
    /// Improves `x` by a cycle, from a residual of size `before`; returns the size of what is left.
    /// `None` if work is to end.
    fn cycle(&mut self, x: &mut [f64], before: f64) -> Option<f64> {
        let Run {
            operator,
            vectors,
            options,
            workspace,
            ..
        } = self;
        let (size, found) = (x.len(), vectors.norm(x));
        let products = (options.restart).min(options.iteration_limit - self.end.iterations);
        let GmresWorkspace { basis, rest, .. } = &mut **workspace;
        vectors.sums(&mut basis[..size], 1, |first, v, _| {
            let rest = &rest[first..][..v.len()];
            v.iter_mut().zip(rest).for_each(|(v, r)| *v = r / before);
        });
        let mut least = LeastSquares::new(before);
        for j in 0..products {
            let (known, w) = basis.split_at_mut((j + 1) * size);
            let w = &mut w[..size];
            operator.product(&known[j * size..], w);
            operator.precondition(w);
            self.end.iterations += 1;
            if vectors.workers.pulse().is_err() {
                self.end.error = f64::INFINITY;
                return None;
            }
            let (column, length) = vectors.project_out(known, w);
            if length > 0.0 {
                vectors.scale(w, 1.0 / length);
            }
            if !least.push(column, length) {
                // A direction that the operator does not know.
                break;
            }
            let error = least.rest() * least.triangle.inverse_size();
            let y = least.solve();
            let whole = small_norm(&y).max(found);
            self.end.error = error / (self.share.unwrap_or(1.0) * whole);
            if self.end.error <= options.tolerance && self.share.is_none() {
                // Only now, as it takes a pass over all vectors.
                let sum = (&*x, &basis[..], &y[..]);
                let share = vectors.smaller_share(sum, rest, options.parts);
                let [first, second] = vectors.weights;
                let share = share.max(FINEST * first.max(second) / options.tolerance);
                self.share = Some(share);
                self.end.error = error / (share * whole);
            }
            if self.end.error <= options.tolerance || length == 0.0 {
                break;
            }
            // The error goes with the residual, and this falls by so much in each product.
            let rate = (before / least.rest()).ln() / (j + 1) as f64;
            let left = (self.end.error / options.tolerance).ln() / rate;
            let most = HOPELESS * options.iteration_limit as f64;
            self.is_hopeless = j >= TELLING && self.end.iterations as f64 + left > most;
            if self.is_hopeless {
                break;
            }
        }
        vectors.add(x, &workspace.basis, &least.solve());
        let left = match options.is_verified || self.end.error > options.tolerance {
            true => self.verify(x, &least),
            false => least.rest(),
        };
        let Vectors { ends, weights, .. } = self.vectors;
        self.workspace.found = Some((least, ends, weights));
        Some(left)
    }

    /// Finds the size of what is left of `x` by another product: what rounding in the
    /// preconditioner, nearly singular as it may be, leaves shows in the residual only.
    fn verify(&mut self, x: &mut [f64], least: &LeastSquares) -> f64 {
        let Run {
            operator, vectors, ..
        } = self;
        let GmresWorkspace { b, rest, .. } = &mut *self.workspace;
        operator.product(x, rest);
        vectors.sums(rest, 1, |first, r, _| {
            let b = &b[first..][..r.len()];
            r.iter_mut().zip(b).for_each(|(r, b)| *r = b - *r);
        });
        operator.precondition(rest);
        // Written so that NaN ends it too.
        let (left, size) = (vectors.norm(rest), vectors.norm(x));
        self.end.error = if size > 0.0 {
            left * least.triangle.inverse_size() / (self.share.unwrap_or(1.0) * size)
        } else {
            1.0
        };
        left
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::ops::Range;

    /// A matrix with a diagonal from 1 to 2 and a rotation, and no preconditioner.
    struct Plain(usize);

    impl Preconditioned for Plain {
        fn product(&mut self, x: &[f64], y: &mut [f64]) {
            let n = self.0;
            for i in 0..n {
                let shear = 0.3 * x[(i + 1) % n] - 0.3 * x[(i + n - 1) % n];
                y[i] = (1.0 + i as f64 / n as f64) * x[i] + shear;
            }
        }

        fn precondition(&mut self, _: &mut [f64]) {}
    }

    #[test]
    fn solves_to_the_tolerance_also_with_restarts() {
        for restart in [4, 50] {
            let mut operator = Plain(40);
            let exact: Vec<f64> = (0..40).map(|i| (i as f64).cos()).collect();
            let mut x = vec![0.0; 40];
            operator.product(&exact, &mut x);
            let options = GmresOptions {
                tolerance: 1e-10,
                leading: 40,
                essential: 40,
                parts: Parts::AsTheyAre,
                iteration_limit: 200,
                restart,
                is_verified: true,
            };
            let end = gmres(
                &mut operator,
                &mut x,
                &options,
                &Workers::default(),
                &mut GmresWorkspace::default(),
            )
            .unwrap();
            assert!(end.error <= 1e-10, "{end:?}");
            let error = x.iter().zip(&exact).map(|(x, e)| (x - e).abs());
            assert!(error.fold(0.0, f64::max) < 1e-9);
        }
    }

    #[test]
    fn both_parts_are_as_accurate_as_asked_however_small_one_is() {
        // The second part is a millionth of the first.
        let exact: Vec<f64> = (0..40)
            .map(|i| (i as f64).cos() * if i < 20 { 1.0 } else { 1e-6 })
            .collect();
        // What serves the first alone does not serve the second, of another size.
        struct Apart;
        impl Preconditioned for Apart {
            fn product(&mut self, x: &[f64], y: &mut [f64]) {
                Plain(20).product(&x[..20], &mut y[..20]);
                Plain(20).product(&x[20..], &mut y[20..]);
                y[20..].iter_mut().for_each(|y| *y *= 4.0);
            }
            fn precondition(&mut self, _: &mut [f64]) {}
        }
        let solve = |parts: Parts| {
            let mut x = vec![0.0; 40];
            Apart.product(&exact, &mut x);
            let options = GmresOptions {
                tolerance: 1e-3,
                leading: 20,
                essential: 40,
                parts,
                iteration_limit: 40,
                restart: 40,
                is_verified: true,
            };
            let (workers, mut workspace) = (Workers::default(), GmresWorkspace::default());
            let end = gmres(&mut Apart, &mut x, &options, &workers, &mut workspace).unwrap();
            let error = |part: Range<usize>| {
                let of = |x: &mut dyn Iterator<Item = f64>| x.map(|x| x * x).sum::<f64>().sqrt();
                let left = of(&mut part.clone().map(|i| x[i] - exact[i]));
                left / of(&mut part.map(|i| exact[i]))
            };
            (end, error(0..20), error(20..40))
        };
        let (end, first, second) = solve(Parts::Balanced);
        // An estimate, which counts amplification, and no more than ten times too large.
        assert!(first <= 1e-3 && second <= 1e-3, "{first:e} {second:e}");
        assert!(
            end.error <= 1e-3 && end.error <= 10.0 * first.max(second),
            "{end:?}"
        );
        let (alone, first, second) = solve(Parts::LeadingAlone);
        assert!(first <= 1e-3 && second > 1e-2, "{first:e} {second:e}");
        assert!(alone.iterations <= end.iterations);
    }

    #[test]
    fn what_is_not_verified_takes_a_product_less() {
        struct Counted(Plain, usize);
        impl Preconditioned for Counted {
            fn product(&mut self, x: &[f64], y: &mut [f64]) {
                self.1 += 1;
                self.0.product(x, y);
            }
            fn precondition(&mut self, _: &mut [f64]) {}
        }
        let exact: Vec<f64> = (0..40).map(|i| (i as f64).sin()).collect();
        let mut b = vec![0.0; 40];
        Plain(40).product(&exact, &mut b);
        let [verified, not] = [true, false].map(|is_verified| {
            let (mut operator, mut x) = (Counted(Plain(40), 0), b.clone());
            let options = GmresOptions {
                tolerance: 1e-8,
                leading: 40,
                essential: 40,
                parts: Parts::AsTheyAre,
                iteration_limit: 200,
                restart: 50,
                is_verified,
            };
            let (workers, mut workspace) = (Workers::default(), GmresWorkspace::default());
            let end = gmres(&mut operator, &mut x, &options, &workers, &mut workspace).unwrap();
            assert!(end.error <= 1e-8 && end.error > 1e-12, "{end:?}");
            let error = x.iter().zip(&exact).map(|(x, e)| (x - e).abs());
            assert!(error.fold(0.0, f64::max) < 1e-8);
            (end.iterations, operator.1, x)
        });
        assert_eq!(verified.1, verified.0 + 1);
        assert_eq!(not, (verified.0, verified.0, verified.2));
    }

    #[test]
    fn a_singular_system_ends() {
        struct Zero;
        impl Preconditioned for Zero {
            fn product(&mut self, _: &[f64], y: &mut [f64]) {
                y.fill(0.0);
            }
            fn precondition(&mut self, _: &mut [f64]) {}
        }
        let options = GmresOptions {
            tolerance: 1e-10,
            leading: 1,
            essential: 2,
            parts: Parts::AsTheyAre,
            iteration_limit: 20,
            restart: 20,
            is_verified: true,
        };
        let mut x = vec![1.0, 2.0];
        let end = gmres(
            &mut Zero,
            &mut x,
            &options,
            &Workers::default(),
            &mut GmresWorkspace::default(),
        )
        .unwrap();
        assert!(end.error > 0.5 && x.iter().all(|x| x.is_finite()));
    }

    #[test]
    fn what_would_take_too_long_is_left() {
        /// Of its 300 vectors none helps before the last.
        struct Shift;
        impl Preconditioned for Shift {
            fn product(&mut self, x: &[f64], y: &mut [f64]) {
                y[1..].copy_from_slice(&x[..x.len() - 1]);
                y[0] = x[x.len() - 1];
            }
            fn precondition(&mut self, _: &mut [f64]) {}
        }
        let options = GmresOptions {
            tolerance: 1e-6,
            leading: 300,
            essential: 300,
            parts: Parts::AsTheyAre,
            iteration_limit: 200,
            restart: 200,
            is_verified: true,
        };
        let mut x = vec![0.0; 300];
        x[0] = 1.0;
        let end = gmres(
            &mut Shift,
            &mut x,
            &options,
            &Workers::default(),
            &mut GmresWorkspace::default(),
        )
        .unwrap();
        assert!(end.error > 0.5 && !end.stagnated, "{end:?}");
        assert!(end.iterations < TELLING + 5, "{end:?}");
    }
}
