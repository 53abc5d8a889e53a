//! Linear algebra: solvers of Newton's linear equations, and why these may be singular. See
//! docs/theory.md, section 8.
//!
//! What Newton's method asks for is in `solver`; which solver answers, in `method` (docs/theory.md,
//! section 8.7), by the work that `cost` plans, and `direct_trial` and `iterative/trial` measure.
//!
//! * Directly (docs/theory.md, section 8.1): `assembled` forms the Jacobian and factors it by
//!   `direct`, multifrontal LU, with the matrices of very slender beams refined in `slender`.
//!   `ordering` says in which order, `two_branches` for several threads, `direct/analysis` which
//!   fronts follow, `direct/factorisation` goes through them, `direct/sum` sums one up, and `front`
//!   eliminates it, with `partial_lu` where not all has pivots.
//! * By freedoms, of mechanisms that have few (docs/theory.md, section 8.2): `freedoms`.
//! * By what is left of a rotor of like blades (docs/theory.md, section 8.10): `like_blades`.
//! * By iteration: `iterative`, with GMRES in `iterative/gmres` (docs/theory.md, section 8.3) and
//!   the preconditioners `iterative/body_circulant` (docs/theory.md, section 8.5) and
//!   `iterative/time_local` (docs/theory.md, section 8.6).
//! * With scalar unknowns, such as a period, and equations for them: `bordered`, `borders`, and
//!   `direct/with_borders` with factors of both (docs/theory.md, section 8.8).
//! * `diagnosis` says what is free to move, or which constraints say the same thing twice
//!   (docs/theory.md, section 7.5).
//! * Dense kernels: `triangles` with one vector, `blocks` with large matrices, `lu` for their
//!   factors, `eigenvalues`; what else is asked of vectors in `dense`.

pub(crate) mod assembled;
mod block;
mod blocks;
pub(crate) mod bordered;
pub(crate) mod borders;
pub(crate) mod cost;
mod critical_path;
pub(crate) mod dense;
pub(crate) mod diagnosis;
pub(crate) mod direct;
pub(crate) mod direct_trial;
pub(crate) mod eigenvalues;
mod freedoms;
mod front;
pub(crate) mod iterative;
pub(crate) mod like_blades;
mod lu;
pub(crate) mod method;
mod ordering;
mod partial_lu;
pub(crate) mod plan;
mod slender;
pub(crate) mod solver;
mod triangles;
mod two_branches;
