//! What iterative solves took, and by what (docs/theory.md, section 8.3).

use serde::{Deserialize, Serialize};

/// What the Jacobian is approximated by, to be solved with exactly.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Preconditioner {
    /// Bodies averaged over time, each in its own frame; joints as they are. Serves all kinds of
    /// systems.
    BodyCirculant,
    /// Equilibrium at each grid point by itself, without inertia: for slow mechanisms.
    TimeLocal,
    /// Everything averaged over time, as the paper proposes: for systems with no joints that turn.
    Circulant,
}

impl Preconditioner {
    /// For reports.
    pub fn name(self) -> &'static str {
        match self {
            Preconditioner::BodyCirculant => "body-circulant preconditioner",
            Preconditioner::TimeLocal => "time-local preconditioner",
            Preconditioner::Circulant => "circulant preconditioner",
        }
    }
}

/// What iterative solves took.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct IterativeRecord {
    /// The preconditioner that was used last; none if iteration was given up for factors.
    pub preconditioner: Option<Preconditioner>,
    /// Products of each linear solve.
    pub products: Vec<usize>,
    /// Times that a preconditioner was factored.
    pub factorisations: usize,
    /// Unknowns of the system of joints that turn.
    pub interface: usize,
    /// Bytes of the tangents, the factors and the vectors that were kept, at most.
    pub bytes: usize,
}
