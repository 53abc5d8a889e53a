//! Multipliers at points of a branch.

use super::walk::{Place, Walk, found_or_none};
use crate::error::Result;
use crate::fourier::TimeGrid;
use crate::solve::periodic::conditioned::known;
use crate::solve::report::{NewtonReport, Outcome};
use crate::solve::stability::{Stability, Verdict, solve_stability_after};
use crate::system::System;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// What multipliers say at a point of a branch.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct PointStability {
    /// Whether disturbances die away.
    pub verdict: Verdict,
    /// Number of multipliers outside the unit circle, by more than their errors; without those that
    /// only move the solution in time or space.
    pub outside: usize,
    /// Size of the largest of the others, too.
    pub largest: f64,
}

impl PointStability {
    fn of(stability: &Stability) -> Self {
        PointStability {
            verdict: stability.verdict,
            outside: stability.outside(),
            largest: stability.largest(),
        }
    }
}

/// A pair of complex multipliers.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pair {
    pub size: f64,
    /// Angular frequency of the mode.
    pub frequency: f64,
}

/// Multipliers at a place.
#[derive(Debug, Clone)]
pub(super) struct Multipliers {
    pub stability: PointStability,
    /// The largest first.
    pub pairs: Vec<Pair>,
}

impl Multipliers {
    /// Number of complex pairs outside the unit circle.
    pub fn pairs_outside(&self) -> usize {
        self.pairs.iter().filter(|pair| pair.size > 1.0).count()
    }
}

impl Walk<'_> {
    /// Multipliers at a place, if they are wanted and can be found.
    pub fn multipliers(&mut self, place: &Place) -> Result<Option<Multipliers>> {
        found_or_none(self.find_multipliers(place))
    }

    fn find_multipliers(&mut self, place: &Place) -> Result<Option<Multipliers>> {
        let Some(options) = &self.options.stability else {
            return Ok(None);
        };
        let mut state = place.state.clone();
        let scalars = std::mem::take(&mut state.scalars);
        let nominal = self.newton.equations.system().period();
        let (model, period) = self.conditioned.model_at(&scalars, nominal)?;
        let grid = TimeGrid::even_or_odd(state.points(), period)?;
        let system = Arc::new(System::new(&model, period)?);
        let report = NewtonReport::ended(Outcome::Converged, String::new());
        let threads = self.options.periodic.threads;
        let solved = known(&system, (grid, state), report, threads, Vec::new())?;
        let found = solve_stability_after(&mut self.experience, &solved, options)?;
        let pairs = found.multipliers.iter();
        let pairs = pairs.filter(|m| !m.trivial && m.value.im > m.error);
        let pairs = pairs.map(|m| Pair {
            size: m.value.norm(),
            frequency: m.exponent.im.abs(),
        });
        Ok(Some(Multipliers {
            stability: PointStability::of(&found),
            pairs: pairs.collect(),
        }))
    }

    /// What they say.
    pub fn stability(&mut self, place: &Place) -> Result<Option<PointStability>> {
        Ok(self.multipliers(place)?.map(|found| found.stability))
    }
}
