//! Iteration on the equations of one of like blades over the whole period (docs/theory.md,
//! section 8.10).

use crate::collocation::{Collocation, GridState, LikeBlades, OneBlade};
use crate::error::Result;
use crate::solve::linear::iterative::{Iterative, Preconditioner};
use crate::solve::linear::solver::LinearSolver;
use crate::solve::report::Timings;
use crate::system::System;
use std::sync::Arc;

/// One blade, and what iterates on its equations.
pub(super) struct Iteration {
    /// Of the whole.
    system: Arc<System>,
    pub blade: OneBlade,
    pub iterative: Iterative,
    /// Growth of the last linearisation.
    pub growth: f64,
}

impl Iteration {
    /// For `equations`; none if an element acts on two blades.
    pub fn new(equations: &Collocation, left: &LikeBlades) -> Option<Self> {
        let system = equations.system().clone();
        let blade = OneBlade::of(equations, system.symmetry()?, left).ok()??;
        let iterative = Iterative::new(&blade.equations, Some(Preconditioner::BodyCirculant));
        Some(Iteration {
            system,
            blade,
            iterative,
            growth: f64::INFINITY,
        })
    }

    /// Linearises at a state of the whole. `false` if that is singular, or nearly so.
    pub fn linearise(
        &mut self,
        equations: &Collocation,
        left: &LikeBlades,
        state: &GridState,
        timings: &mut Timings,
    ) -> Result<bool> {
        // Parameters may have made other elements.
        if !Arc::ptr_eq(&self.system, equations.system()) {
            let Some(next) = Self::new(equations, left) else {
                return Ok(false);
            };
            *self = next;
        }
        let Iteration {
            system,
            blade,
            iterative,
            growth,
        } = self;
        blade.follow(equations)?;
        let own = blade.state(system, state);
        let done = iterative.linearise(&mut blade.equations, &own, timings)?;
        *growth = match done {
            true => iterative.growth(&mut blade.equations),
            false => f64::INFINITY,
        };
        Ok(*growth <= iterative.suspect)
    }

    /// Solves in place for the unknowns that are left.
    pub fn solve(
        &mut self,
        left: &LikeBlades,
        x: &mut [f64],
        accuracy: f64,
        timings: &mut Timings,
    ) -> Result<bool> {
        let Iteration {
            blade, iterative, ..
        } = self;
        let mut own = blade.rows(left, x);
        let solved = iterative.solve(&mut blade.equations, &mut own, accuracy, timings)?;
        if solved {
            blade.unknowns(left, &own, x);
        }
        Ok(solved)
    }
}
