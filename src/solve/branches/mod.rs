//! Branches: periodic motions followed along a parameter, through folds.
//! See docs/theory.md, section 13.3.
//!
//! * `walk.rs`: a point, the next point; `tangent.rs`: in which direction;
//! * `course.rs`, `prediction.rs`: where it is guessed to be; `step.rs`: how long the next step is;
//! * `follow.rs`: from the first point to the end;
//! * `grid.rs`: with how many grid points it goes on;
//! * `events.rs`, `determinants.rs`, `multipliers.rs`: what lies between two points, located;
//! * `event_equation.rs`, `singular.rs`, `turning.rs`: an event's own equation; `augmented.rs`:
//!   Newton's method with it;
//! * `go_on.rs`: from where it had ended;
//! * `switch.rs`: the other branch at such a point;
//! * `locus.rs`: such points along a second parameter.

mod augmented;
mod course;
mod determinants;
mod event_equation;
mod events;
mod follow;
mod go_on;
mod grid;
mod locus;
mod multipliers;
mod prediction;
pub(in crate::solve) mod singular;
mod step;
mod switch;
mod tangent;
mod turning;
mod walk;

pub use follow::follow_branch;
pub use go_on::continue_branch;
pub use locus::follow_locus;
pub use multipliers::PointStability;
pub use switch::switch_branch;

use crate::collocation::GridState;
use crate::error::{Error, Result, require_finite, require_positive_number};
use crate::fourier::TimeGrid;
use crate::model::Model;
use crate::solve::conditions::{Condition, Conditioned, Free};
use crate::solve::periodic::conditioned::known;
use crate::solve::periodic::options::PeriodicOptions;
use crate::solve::report::{NewtonReport, Outcome};
use crate::solve::result::Solved;
use crate::solve::stability::StabilityOptions;
use crate::system::System;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// How a branch is followed.
#[derive(Debug, Clone)]
pub struct BranchOptions {
    /// Grid, tolerance, linear solver, threads, and where the first solve starts.
    pub periodic: PeriodicOptions,
    /// What else is free along the branch, and as many conditions.
    pub free: Vec<Free>,
    /// Those conditions.
    pub conditions: Vec<Arc<dyn Condition>>,
    /// The parameter stays from the first to the second: the branch ends there.
    pub range: [f64; 2],
    /// Whether the parameter decreases at first.
    pub downwards: bool,
    /// What counts as 1 in motions, relative to the size of the mechanism and in radians: less
    /// makes steps shorter where motions change, more where the parameter does.
    pub motion_scale: f64,
    /// Length of the first step, of which 1 is the range of the parameter or a motion of
    /// `motion_scale`.
    pub first_step: f64,
    /// Shortest step: where that fails the branch ends.
    pub smallest_step: f64,
    /// Longest step.
    pub largest_step: f64,
    /// Angle between tangents of neighbouring points that steps aim at, in radians. Steps by four
    /// thirds of it are taken again by half.
    pub angle: f64,
    /// Most points.
    pub point_limit: usize,
    /// Whether branch points and period doublings are looked for, too: two more factorisations of
    /// the whole Jacobian a point. Branch points only where there are no conditions. All events but
    /// branch points are then located by an equation of their own.
    pub events: bool,
    /// How multipliers of each point are found, if they are wanted; with them torus points, which
    /// are then looked for, too.
    pub stability: Option<StabilityOptions>,
}

impl Default for BranchOptions {
    fn default() -> Self {
        BranchOptions {
            periodic: PeriodicOptions::default(),
            free: Vec::new(),
            conditions: Vec::new(),
            range: [f64::NEG_INFINITY, f64::INFINITY],
            downwards: false,
            motion_scale: 1.0,
            first_step: 0.02,
            smallest_step: 1e-6,
            largest_step: 1.0,
            angle: 0.3,
            point_limit: 1000,
            events: false,
            stability: None,
        }
    }
}

impl BranchOptions {
    fn validate(&self) -> Result<()> {
        self.periodic.validate()?;
        let why = "branches are followed on equispaced grids";
        self.periodic.time_map.require_equispaced(why)?;
        require_finite("options.range", &self.range)?;
        let [low, high] = self.range;
        if low >= high {
            let expected = format!("more than {low} for its end");
            return Err(Error::value("options.range", expected, high));
        }
        for (name, value) in [
            ("options.motion_scale", self.motion_scale),
            ("options.first_step", self.first_step),
            ("options.smallest_step", self.smallest_step),
            ("options.largest_step", self.largest_step),
            ("options.angle", self.angle),
        ] {
            require_positive_number(name, value)?;
        }
        if self.smallest_step > self.first_step || self.first_step > self.largest_step {
            let expected = "from smallest_step to largest_step";
            return Err(Error::value(
                "options.first_step",
                expected,
                self.first_step,
            ));
        }
        if self.point_limit == 0 {
            return Err(Error::size("options.point_limit", "at least 1", 0));
        }
        Ok(())
    }

    /// Checks that there are so many conditions.
    fn require_conditions(&self, count: usize) -> Result<()> {
        if self.conditions.len() == count {
            return Ok(());
        }
        let expected = format!("as many as there are free parameters ({count})");
        Err(Error::size(
            "options.conditions",
            expected,
            self.conditions.len(),
        ))
    }

    /// Checks that a parameter is in the range.
    fn require_within(&self, model: &Model, period: f64, parameter: Free) -> Result<()> {
        self.require_value(&parameter.name(model), parameter.value(model, period)?)
    }

    fn require_value(&self, name: &str, value: f64) -> Result<()> {
        let [low, high] = self.range;
        // A frequency is that of a period that was given.
        let slack = 1e-12 * (high - low).max(value.abs());
        if (low - slack..=high + slack).contains(&value) {
            return Ok(());
        }
        let expected = format!("{name} between {low} and {high}");
        Err(Error::value("options.range", expected, value))
    }
}

/// What happens at a point of a branch.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Event {
    /// The parameter turns back.
    Fold,
    /// Another branch passes through.
    BranchPoint,
    /// A multiplier is −1: a branch of twice the period begins.
    PeriodDoubling,
    /// A pair of complex multipliers is on the unit circle: motions with a second frequency begin.
    Torus,
}

impl Event {
    /// What it is, for people.
    pub fn describe(self) -> &'static str {
        match self {
            Event::Fold => "fold",
            Event::BranchPoint => "branch point",
            Event::PeriodDoubling => "period doubling",
            Event::Torus => "torus point",
        }
    }
}

/// A periodic motion on a branch.
#[derive(Debug, Clone)]
pub struct BranchPoint {
    /// The parameter that is followed, then those that are free beside it.
    pub values: Vec<f64>,
    /// Derivative of the parameter by the arc length, over the parameter's range: zero at a fold.
    pub slope: f64,
    /// Grid of the motion, with its period.
    pub grid: TimeGrid,
    /// The motion.
    pub state: GridState,
    /// Length of the step from the point before.
    pub step: f64,
    /// Angle between the tangents here and at the point before.
    pub angle: f64,
    /// Newton iterations.
    pub iterations: usize,
    /// What happens here.
    pub event: Option<Event>,
    /// Lengths of Newton's increments by which the event was located, if it was so.
    pub increments: Vec<f64>,
    /// Frequency of the motions that begin at a torus point.
    pub second_frequency: Option<f64>,
    /// What multipliers say, if they were wanted.
    pub stability: Option<PointStability>,
}

/// Why a branch ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum BranchEnd {
    /// The parameter reached an end of its range.
    Range,
    /// It came back to its first point.
    Closed,
    /// There are as many points as are allowed.
    PointLimit,
    /// The shortest step led to no solution.
    SmallestStep,
    /// It was cancelled.
    Cancelled,
    /// There is no first point.
    NoStart,
    /// An error ended it, which the explanation tells.
    Failed,
}

/// Why there is no first point, after a solve that ended so.
fn no_first_point(report: &NewtonReport) -> String {
    format!("no first point was found: {}", report.describe())
}

/// Periodic motions along a parameter.
#[derive(Debug, Clone)]
pub struct Branch {
    pub(super) conditioned: Conditioned,
    pub(super) period: f64,
    /// The points, in order.
    pub points: Vec<BranchPoint>,
    /// Why it ended.
    pub end: BranchEnd,
    /// More on that.
    pub explanation: String,
    /// Steps that were taken again by half.
    pub rejected: usize,
    /// Newton iterations, with those of steps that were rejected and of events.
    pub iterations: usize,
    /// What happens at all points, of a locus.
    pub locus: Option<Event>,
    threads: usize,
}

impl Branch {
    /// One whose first point was not found.
    fn without_points(conditioned: Conditioned, period: f64, report: &NewtonReport) -> Self {
        Branch {
            explanation: no_first_point(report),
            ..Branch::empty(conditioned, period)
        }
    }

    /// One that has no points yet.
    fn empty(conditioned: Conditioned, period: f64) -> Self {
        Branch {
            conditioned,
            period,
            points: Vec::new(),
            end: BranchEnd::NoStart,
            explanation: String::new(),
            rejected: 0,
            iterations: 0,
            locus: None,
            threads: 1,
        }
    }

    /// One that was saved. Points are not checked.
    ///
    /// # Errors
    /// If a free parameter is none.
    pub(crate) fn restored(
        (model, period): (&Model, f64),
        free: &[Free],
        points: Vec<BranchPoint>,
    ) -> Result<Self> {
        Ok(Branch {
            points,
            ..Branch::empty(Conditioned::new(model, period, free)?, period)
        })
    }

    /// The free parameters, that which is followed last.
    pub(crate) fn free(&self) -> &[Free] {
        self.conditioned.free()
    }

    /// Period of the model as it is.
    pub(crate) fn period(&self) -> f64 {
        self.period
    }

    /// What the parameter that is followed is called in messages.
    pub fn parameter_name(&self) -> String {
        let names = self.conditioned.unknown_names();
        names.last().cloned().unwrap_or_default()
    }

    /// The model, with the values of its first point.
    pub fn model(&self) -> &Model {
        self.conditioned.model()
    }

    /// Names of [`BranchPoint::values`] for tables.
    pub fn value_names(&self) -> Vec<String> {
        let mut names = self.conditioned.short_names();
        names.rotate_right(1);
        names
    }

    /// The model and the motion of a point.
    ///
    /// # Errors
    /// If there is no such point.
    pub fn solved(&self, index: usize) -> Result<(Model, Solved)> {
        let Some(point) = self.points.get(index) else {
            let expected = format!("a point below {}", self.points.len());
            return Err(Error::value("point", expected, index));
        };
        let mut scalars = point.values[1..].to_vec();
        scalars.push(point.values[0]);
        let (model, period) = self.conditioned.model_at(&scalars, self.period)?;
        let grid = TimeGrid::even_or_odd(point.grid.points(), period)?;
        let report = NewtonReport::ended(Outcome::Converged, String::new());
        let motion = (grid, point.state.clone());
        let system = Arc::new(System::new(&model, period)?);
        let solved = known(&system, motion, report, self.threads, Vec::new())?;
        Ok((model, solved))
    }
}
