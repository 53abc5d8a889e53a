//! What a file holds of a branch, and whether it fits together.

use super::saved::require;
use super::version::Saved;
use crate::collocation::GridState;
use crate::error::{Result, require_finite, require_positive_number};
use crate::fourier::TimeGrid;
use crate::model::Model;
use crate::solve::{Branch, BranchEnd, BranchPoint, Event, Free, PointStability};
use crate::system::{Regime, System};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;

/// All that a branch is made of.
#[derive(Serialize, Deserialize)]
pub(super) struct BranchContent<'a> {
    model: Cow<'a, Model>,
    period: f64,
    /// That which is followed last.
    free: Cow<'a, [Free]>,
    points: Vec<SavedPoint<'a>>,
    end: BranchEnd,
    explanation: Cow<'a, str>,
    rejected: usize,
    iterations: usize,
    locus: Option<Event>,
}

#[derive(Serialize, Deserialize)]
struct SavedPoint<'a> {
    values: Cow<'a, [f64]>,
    slope: f64,
    period: f64,
    state: Cow<'a, GridState>,
    step: f64,
    angle: f64,
    iterations: usize,
    event: Option<Event>,
    increments: Cow<'a, [f64]>,
    second_frequency: Option<f64>,
    stability: Option<PointStability>,
}

impl Saved for BranchContent<'_> {
    fn model(&self) -> &Model {
        &self.model
    }
}

impl<'a> BranchContent<'a> {
    pub fn of(branch: &'a Branch) -> Self {
        BranchContent {
            model: Cow::Borrowed(branch.model()),
            period: branch.period(),
            free: Cow::Borrowed(branch.free()),
            points: branch.points.iter().map(SavedPoint::of).collect(),
            end: branch.end,
            explanation: Cow::Borrowed(&branch.explanation),
            rejected: branch.rejected,
            iterations: branch.iterations,
            locus: branch.locus,
        }
    }

    /// The branch, if everything in it fits together.
    pub fn into_branch(self) -> Result<Branch> {
        let model = self.model.into_owned().checked()?;
        require_positive_number("period", self.period)?;
        require(!self.free.is_empty(), "free parameters")?;
        let system = System::of_known_solution(&model, Regime::Periodic(self.period))?;
        let count = self.free.len();
        let points = self.points.into_iter();
        let points = points.map(|point| point.into_point(&system, count));
        let points = points.collect::<Result<_>>()?;
        let mut branch = Branch::restored((&model, self.period), &self.free, points)?;
        branch.end = self.end;
        branch.explanation = self.explanation.into_owned();
        (branch.rejected, branch.iterations) = (self.rejected, self.iterations);
        branch.locus = self.locus;
        Ok(branch)
    }
}

impl<'a> SavedPoint<'a> {
    fn of(point: &'a BranchPoint) -> Self {
        SavedPoint {
            values: Cow::Borrowed(&point.values),
            slope: point.slope,
            period: point.grid.period(),
            state: Cow::Borrowed(&point.state),
            step: point.step,
            angle: point.angle,
            iterations: point.iterations,
            event: point.event,
            increments: Cow::Borrowed(&point.increments),
            second_frequency: point.second_frequency,
            stability: point.stability,
        }
    }

    /// The point of a branch in a system, with so many free parameters.
    fn into_point(self, system: &System, free: usize) -> Result<BranchPoint> {
        require(self.values.len() == free, "values of parameters")?;
        require_finite("values", &self.values)?;
        require_finite("steps", &[self.slope, self.step, self.angle])?;
        let state = self.state.into_owned();
        state.require_sizes(system)?;
        Ok(BranchPoint {
            values: self.values.into_owned(),
            slope: self.slope,
            grid: TimeGrid::even_or_odd(state.points(), self.period)?,
            state,
            step: self.step,
            angle: self.angle,
            iterations: self.iterations,
            event: self.event,
            increments: self.increments.into_owned(),
            second_frequency: self.second_frequency,
            stability: self.stability,
        })
    }
}

impl GridState {
    /// Checks that all is as long as a system needs.
    fn require_sizes(&self, system: &System) -> Result<()> {
        let fits = |length: usize, each: usize| each.checked_mul(self.points()) == Some(length);
        require(fits(self.motions.len(), system.nodes()), "motions")?;
        let multipliers = self.multipliers.len();
        require(fits(multipliers, system.own_unknowns()), "multipliers")?;
        require(
            fits(self.coordinates.len(), system.tracked()),
            "coordinates",
        )
    }
}
