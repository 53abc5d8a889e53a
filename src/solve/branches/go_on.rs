//! A branch that goes on where it had ended.

use super::follow::Follow;
use super::walk::{Place, Walk};
use super::{Branch, BranchEnd, BranchOptions, BranchPoint, no_first_point};
use crate::collocation::GridState;
use crate::error::{Error, ErrorKind, Result};
use crate::fourier::TimeGrid;
use crate::solve::watch::Stage;
use crate::workers::Workers;

/// Length of a step that tells no direction.
const NO_STEP: f64 = 1e-9;

/// Follows a branch on from its last point, in the direction in which it came there, with these
/// options: a wider range, more points, a shorter smallest step. What is returned has the points of
/// `branch`, too, and `observe` is told of those that are new.
///
/// # Errors
/// [`ErrorKind::NotAvailable`] of a locus, and of a branch without points or one that has come back
/// to its first; if the last point is not in the range; else as
/// [`follow_branch`](super::follow_branch).
pub fn continue_branch(
    branch: &Branch,
    options: &BranchOptions,
    observe: &mut dyn FnMut(usize, &BranchPoint) -> bool,
) -> Result<Branch> {
    options.validate()?;
    let none = |why: &str| {
        Err(Error::new(
            ErrorKind::NotAvailable,
            format!("branch: {why}"),
        ))
    };
    let Some(last) = branch.points.last() else {
        return none("it has no points to go on from");
    };
    if branch.locus.is_some() {
        return none("a locus cannot be continued");
    }
    if branch.end == BranchEnd::Closed {
        return none("it has come back to its first point");
    }
    let free = branch.conditioned.free();
    options.require_conditions(free.len() - 1)?;
    options.require_value(&branch.parameter_name(), last.values[0])?;
    let grid = TimeGrid::even_or_odd(last.grid.points(), branch.period)?;
    let watching = options.periodic.watch.begin(Stage::Newton, grid.points());
    let workers = Workers::new(options.periodic.threads)?.telling(watching.pulse());
    let walk = Walk::new(branch.model(), grid, free, (options, workers, watching))?;
    let more = Branch {
        end: BranchEnd::NoStart,
        explanation: String::new(),
        threads: options.periodic.threads,
        ..branch.clone()
    };
    let mut follow = Follow::new(walk, more, observe);
    let went = follow.resume();
    follow.end(went)
}

impl Follow<'_, '_> {
    fn resume(&mut self) -> Result<()> {
        let points = &self.branch.points;
        let states: Vec<GridState> = points.iter().map(BranchPoint::state_with_scalars).collect();
        let Some(state) = states.last().cloned() else {
            return Ok(());
        };
        // From the last point that is another one.
        let mut along = None;
        for before in states.iter().rev().skip(1) {
            let before = Place::at(before.clone(), &self.walk);
            let Some(before) = self.walk.on_present_grid(&before)? else {
                continue;
            };
            let away = self.walk.away(&before.state, &state);
            let length = self.walk.length(&away);
            if length > NO_STEP {
                along = Some(away.iter().map(|x| x / length).collect());
                break;
            }
        }
        let place = match along {
            None => {
                let value = self.walk.parameter(&state);
                let (state, report) = self.walk.at_parameter(state, value)?;
                if !report.outcome.is_solution() {
                    self.ends(BranchEnd::NoStart, no_first_point(&report));
                    return Ok(());
                }
                self.walk.first_tangent(state)?
            }
            Some(tangent) => match self.walk.step(&Place::new(state, tangent), 0.0)? {
                Ok(stepped) => Some(stepped.to),
                Err(report) => {
                    self.ends(BranchEnd::NoStart, no_first_point(&report));
                    return Ok(());
                }
            },
        };
        let Some(place) = place else {
            self.ends(
                BranchEnd::NoStart,
                "the branch has no tangent where it ended",
            );
            return Ok(());
        };
        let first = self.first_of(&states, &place)?;
        if self.leaves_range(&place) {
            self.ends(BranchEnd::Range, "");
            return Ok(());
        }
        let tests = self.walk.tests(&place)?;
        self.go_on((place, tests), &first)
    }

    /// The first point with the direction in which the branch left it; where there is but one, that
    /// which it is continued from.
    fn first_of(&self, states: &[GridState], last: &Place) -> Result<Place> {
        let of = |state: &GridState| {
            let place = Place::at(state.clone(), &self.walk);
            self.walk.on_present_grid(&place)
        };
        let [Some(first), Some(second)] = [states.first(), states.get(1)] else {
            return Ok(last.clone());
        };
        let (Some(first), Some(second)) = (of(first)?, of(second)?) else {
            return Ok(last.clone());
        };
        Ok(Place {
            tangent: self.walk.away(&first.state, &second.state),
            ..first
        })
    }

    /// Whether a place is at an end of the range, and the branch goes on beyond it.
    fn leaves_range(&self, place: &Place) -> bool {
        let [low, high] = self.walk.options.range;
        let (value, slope) = (self.walk.parameter(&place.state), self.walk.slope(place));
        let slack = 1e-12 * (high - low);
        value >= high - slack && slope > 0.0 || value <= low + slack && slope < 0.0
    }
}

impl Place {
    /// A state, in no direction.
    fn at(state: GridState, walk: &Walk) -> Self {
        let layout = walk.newton.equations.system().layout(state.points());
        let size = layout.with_scalars(walk.scales.len()).size();
        Place::new(state, vec![0.0; size])
    }
}

impl BranchPoint {
    /// The motion with the free parameters as its scalars, that which is followed last.
    fn state_with_scalars(&self) -> GridState {
        let mut state = self.state.clone();
        state.scalars = self.values[1..].to_vec();
        state.scalars.push(self.values[0]);
        state
    }
}
