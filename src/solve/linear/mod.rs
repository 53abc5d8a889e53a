//! Linear algebra: solvers of Newton's linear equations, and why these may be singular.

pub(crate) mod assembled;
mod blocks;
pub(crate) mod bordered;
pub(crate) mod dense;
pub(crate) mod diagnosis;
pub(crate) mod direct;
pub(crate) mod direct_trial;
pub(crate) mod eigenvalues;
mod freedoms;
mod front;
pub(crate) mod iterative;
pub(crate) mod method;
mod ordering;
mod partial_lu;
mod slender;
pub(crate) mod solver;
