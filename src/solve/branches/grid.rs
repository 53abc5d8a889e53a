//! Numbers of grid points along a branch (docs/theory.md, section 13.3).

use super::walk::{Place, Walk};
use crate::collocation::{Decay, DecayKind};
use crate::error::{ErrorKind, Result};
use crate::fourier::TimeGrid;
use crate::solve::periodic::adaptive::Adaptation;
use crate::solve::periodic::loads::Loads;
use crate::solve::periodic::options::GridPoints;

/// Points in a row that need less before the grid gets coarser.
const PATIENCE: usize = 3;
/// Share of the grid points that are then enough.
const ENOUGH: f64 = 0.75;

/// Chooses grids along a branch.
pub(super) struct Grids {
    adaptation: Option<Adaptation>,
    /// Fewest points.
    least: usize,
    /// Points of the branch in a row that needed less.
    needed_less: usize,
}

impl Grids {
    pub fn of(walk: &Walk) -> Result<Self> {
        let adaptation = match walk.options.periodic.grid_points {
            GridPoints::Adaptive(adaptation) => Some(adaptation),
            GridPoints::Fixed(_) => None,
        };
        let least = match &adaptation {
            Some(adaptation) => {
                let system = walk.newton.equations.system();
                adaptation.first(&Loads::of(system, adaptation.largest)?)
            }
            None => 0,
        };
        Ok(Grids {
            adaptation,
            least,
            needed_less: 0,
        })
    }

    /// Goes on with more grid points where the estimated error asks for it, and with fewer where
    /// far fewer have been enough for some points of the branch.
    pub fn go_on(&mut self, walk: &mut Walk, place: Place) -> Result<Place> {
        let Some(adaptation) = self.adaptation else {
            return Ok(place);
        };
        if let Some(finer) = walk.finer(&place) {
            self.needed_less = 0;
            return Ok(walk.refine(&place, finer, None)?.unwrap_or(place));
        }
        let equations = &walk.newton.equations;
        let (grid, tolerance) = (equations.grid(), adaptation.error_tolerance);
        let decay = Decay::of(equations.system(), grid, &place.state);
        let points = grid.points();
        let fewer = adaptation.enough(&decay).max(self.least);
        self.needed_less = match (fewer as f64) <= ENOUGH * points as f64 {
            true => self.needed_less + 1,
            false => 0,
        };
        if self.needed_less < PATIENCE {
            return Ok(place);
        }
        self.needed_less = 0;
        let coarser = walk.refine(&place, fewer, Some(tolerance))?;
        Ok(coarser.unwrap_or(place))
    }
}

impl Walk<'_> {
    /// Points of the grid that the estimated error of a place asks for, if they are more.
    pub fn finer(&self, place: &Place) -> Option<usize> {
        let GridPoints::Adaptive(adaptation) = self.options.periodic.grid_points else {
            return None;
        };
        let equations = &self.newton.equations;
        let grid = equations.grid();
        let decay = Decay::of(equations.system(), grid, &place.state);
        if decay.tail <= adaptation.error_tolerance || decay.kind == DecayKind::Rounding {
            return None;
        }
        let next = adaptation.next_by_decay(grid.points(), &decay);
        (next > grid.points()).then_some(next)
    }

    /// A place on the present grid; none if its motion cannot be interpolated.
    pub fn on_present_grid(&self, place: &Place) -> Result<Option<Place>> {
        let equations = &self.newton.equations;
        let (system, points) = (equations.system(), equations.grid().points());
        if place.state.points() == points {
            return Ok(Some(place.clone()));
        }
        let [from, to] = [place.state.points(), points];
        let from = TimeGrid::even_or_odd(from, equations.grid().period())?;
        let to = TimeGrid::even_or_odd(to, equations.grid().period())?;
        match place.state.resampled(system, from, 0.0, to, &self.workers) {
            Ok(state) => {
                let tangent = self.resampled(&place.tangent, from, points);
                Ok(Some(Place::new(state, tangent)))
            }
            Err(e) if e.kind() == ErrorKind::GridTooCoarse => Ok(None),
            Err(e) => Err(e),
        }
    }
}
