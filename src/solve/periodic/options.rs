//! Options of a periodic solve.

use super::adaptive::Adaptation;
use super::sharp::MOST_MAPS;
use crate::error::{Error, Result};
use crate::fourier::{SharpEvent, TimeMap};
use crate::solve::linear::method::LinearMethod;
use crate::solve::report::NewtonOptions;
use crate::solve::start::InitialGuess;
use crate::solve::watch::Watch;

/// How many grid points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum GridPoints {
    /// This odd number.
    Fixed(usize),
    /// Few at first, then more until the estimated error meets a tolerance.
    Adaptive(Adaptation),
}

/// Where the points of grids are.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum TimeMapping {
    /// Equispaced, but closer together where an adaptive solve finds the motion sharp.
    #[default]
    Automatic,
    /// Equispaced.
    Equispaced,
    /// Closer together about these events, of all grids.
    Events(Vec<SharpEvent>),
}

impl TimeMapping {
    /// The map that is given; none otherwise.
    ///
    /// # Errors
    /// If an event is none.
    pub(crate) fn given(&self, period: f64) -> Result<TimeMap> {
        match self {
            TimeMapping::Automatic | TimeMapping::Equispaced => Ok(TimeMap::default()),
            TimeMapping::Events(events) => TimeMap::new(events, period),
        }
    }

    /// How many maps an adaptive solve may try, one after the other.
    pub(super) fn most_tried(&self) -> usize {
        match self {
            TimeMapping::Automatic => MOST_MAPS,
            TimeMapping::Equispaced | TimeMapping::Events(_) => 0,
        }
    }

    /// Checks that grids are not told to be mapped.
    ///
    /// # Errors
    /// If they are, with `why` that cannot be.
    pub(crate) fn require_equispaced(&self, why: &str) -> Result<()> {
        match self {
            TimeMapping::Events(events) if !events.is_empty() => {
                let expected = format!("none, as {why}");
                Err(Error::value("options.time_map", expected, "events"))
            }
            _ => Ok(()),
        }
    }
}

/// Options of a periodic solve.
#[derive(Debug, Clone)]
pub struct PeriodicOptions {
    /// Number of grid points.
    pub grid_points: GridPoints,
    /// When to stop on each grid.
    pub newton: NewtonOptions,
    /// Where to start.
    pub guess: InitialGuess,
    /// How linear equations are solved.
    pub linear: LinearMethod,
    /// Threads that share the work, 0 for as many as there are processors. Results do not depend on
    /// it but for rounding. The user's functions are called on the calling thread alone.
    pub threads: usize,
    /// The equations are sampled at this many times as many points, or one more, where motions and
    /// own unknowns are interpolated: forces are to do no virtual work on their changes,
    /// constraints to have none of the grid's harmonics. 1 for the grid points alone: collocation,
    /// where higher harmonics of the equations count as the lower ones that they alias onto.
    pub oversampling: usize,
    /// Whether the error by the mesh of beams is estimated, too, which takes about as long as an
    /// iteration.
    pub estimate_mesh: bool,
    /// Most work, counted in operations and not in time, in easy Newton iterations on the finest
    /// grid so far: by few products or by factors, as takes less; twice that on a given grid. Zero
    /// for no bound.
    pub work_limit: f64,
    /// Bytes of memory that the solve may take, by an estimate made before it is begun on a grid,
    /// or any number if zero. Grids of adaptive solves that would take more are not tried.
    pub memory_limit: usize,
    /// Where the points of grids are. A state to start from is one at the points of the grid.
    pub time_map: TimeMapping,
    /// Who is told how the solve goes on, and may cancel it.
    pub watch: Watch,
}

/// The largest factor of oversampling: sixteen times the points leave no alias of products of
/// thirty-one.
const MOST_OVERSAMPLING: usize = 16;

/// Easy iterations whose work a solve may take by default.
const WORK_LIMIT: f64 = 17.0;

impl Default for PeriodicOptions {
    fn default() -> Self {
        PeriodicOptions {
            grid_points: GridPoints::Adaptive(Adaptation::default()),
            newton: NewtonOptions {
                tolerance: 1e-9,
                iteration_limit: 30,
            },
            guess: InitialGuess::Default,
            linear: LinearMethod::Automatic,
            threads: 1,
            oversampling: 1,
            estimate_mesh: false,
            work_limit: WORK_LIMIT,
            memory_limit: 0,
            time_map: TimeMapping::default(),
            watch: Watch::default(),
        }
    }
}

impl PeriodicOptions {
    /// The defaults, on a grid of this many points.
    pub fn with_grid_points(points: usize) -> Self {
        PeriodicOptions {
            grid_points: GridPoints::Fixed(points),
            ..PeriodicOptions::default()
        }
    }

    /// The defaults, with grid points added until the estimated error is below this.
    pub fn with_error_tolerance(error_tolerance: f64) -> Self {
        PeriodicOptions {
            grid_points: GridPoints::Adaptive(Adaptation {
                error_tolerance,
                ..Adaptation::default()
            }),
            ..PeriodicOptions::default()
        }
    }

    pub(crate) fn validate(&self) -> Result<()> {
        self.newton.validate()?;
        if !(self.work_limit.is_finite() && self.work_limit >= 0.0) {
            let expected = "zero or a positive, finite number";
            let name = "options.work_limit";
            return Err(Error::value(name, expected, self.work_limit));
        }
        if !(1..=MOST_OVERSAMPLING).contains(&self.oversampling) {
            let expected = format!("a number from 1 to {MOST_OVERSAMPLING}");
            let name = "options.oversampling";
            return Err(Error::value(name, expected, self.oversampling));
        }
        match self.grid_points {
            GridPoints::Fixed(_) => Ok(()),
            GridPoints::Adaptive(adaptation) => adaptation.validate(),
        }
    }
}
