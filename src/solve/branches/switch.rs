//! The other branch at a branch point or period doubling (docs/theory.md, section 13.6).

use super::follow::follow_from;
use super::walk::Walk;
use super::{Branch, BranchOptions, BranchPoint, Event};
use crate::collocation::{
    Antiperiodic, Collocation, GridState, Spectral, TimeRule, antiperiodic_at,
};
use crate::error::{Error, ErrorKind, Result};
use crate::fourier::TimeGrid;
use crate::model::Model;
use crate::solve::linear::assembled::Assembled;
use crate::solve::linear::dense::{largest, probe};
use crate::solve::watch::Stage;
use crate::system::System;
use crate::workers::Workers;
use std::sync::Arc;

/// Inverse iterations to a null vector.
const INVERSE_ITERATIONS: usize = 4;

/// Scaled stiffness of the nodes against the ground, small beside what else resists them.
const GROUNDING: f64 = 1e-8;

/// Where another branch begins: its model and grid, the motion there, and the direction in which it
/// leaves, of motions at the grid points.
struct Crossing {
    model: Model,
    grid: TimeGrid,
    state: GridState,
    direction: Vec<f64>,
}

/// Follows the other branch at a point of `branch` where one begins: a branch point, or a period
/// doubling, where it has twice the period, on one point less than twice as many.
///
/// Its first point is where motions are `amplitude` away, in the direction in which it leaves: a
/// length along the branch, of either sign. It goes on away from there.
///
/// # Errors
/// [`ErrorKind::NotAvailable`] if there is no such point, or none begins there;
/// [`ErrorKind::GridTooCoarse`] if the motion cannot be interpolated; else as
/// [`follow_branch`](super::follow_branch).
pub fn switch_branch(
    branch: &Branch,
    index: usize,
    amplitude: f64,
    options: &BranchOptions,
    observe: &mut dyn FnMut(usize, &BranchPoint) -> bool,
) -> Result<Branch> {
    options.validate()?;
    if !(amplitude.is_finite() && amplitude != 0.0) {
        let expected = "a number other than zero";
        return Err(Error::value("amplitude", expected, amplitude));
    }
    let crossing = Crossing::of(branch, index)?;
    let free = branch.conditioned.free().to_vec();
    options.require_conditions(free.len() - 1)?;
    let watching = options
        .periodic
        .watch
        .begin(Stage::Newton, crossing.grid.points());
    let workers = Workers::new(options.periodic.threads)?.telling(watching.pulse());
    let (model, grid) = (&crossing.model, crossing.grid);
    let mut walk = Walk::new(model, grid, &free, (options, workers, watching))?;
    let before = walk.conditioned.values(grid.period())?;
    let (mut state, report) = walk.aside(
        crossing.state,
        before.clone(),
        (crossing.direction, amplitude),
    )?;
    let mut options = options.clone();
    let last = before.len() - 1;
    let found = state.scalars.get(last).copied().unwrap_or(before[last]);
    options.downwards = found < before[last];
    if !report.outcome.is_solution() {
        state.scalars = before;
        let (conditioned, period) = (walk.conditioned, grid.period());
        return Ok(Branch::without_points(conditioned, period, &report));
    }
    let values = std::mem::take(&mut state.scalars);
    let (model, period) = walk.conditioned.model_at(&values, grid.period())?;
    let grid = TimeGrid::even_or_odd(grid.points(), period)?;
    follow_from(&model, (grid, state), &free, &options, observe)
}

impl Crossing {
    fn of(branch: &Branch, index: usize) -> Result<Self> {
        let (model, solved) = branch.solved(index)?;
        let event = branch.points[index].event;
        let (grid, state, system) = (solved.grid, solved.state, solved.system);
        let nodes = system.nodes();
        let rule: Box<dyn TimeRule> = match event {
            Some(Event::PeriodDoubling) => Box::new(Antiperiodic::new(grid, nodes)),
            Some(Event::BranchPoint) => Box::new(Spectral::new(grid, nodes)),
            Some(Event::Fold | Event::Torus) | None => {
                let message = format!("point: no other branch begins at point {index}");
                return Err(Error::new(ErrorKind::NotAvailable, message));
            }
        };
        let direction = null_vector(&system, (grid, &state), rule)?;
        if event == Some(Event::BranchPoint) {
            return Ok(Crossing {
                model,
                grid,
                state,
                direction,
            });
        }
        let (count, points) = (grid.points(), 2 * grid.points() - 1);
        let fine = TimeGrid::even_or_odd(points, grid.period())?;
        let once = state.resampled(&system, grid, 0.0, fine, &Workers::default())?;
        let model = model.repeated(2);
        let twice = TimeGrid::even_or_odd(points, 2.0 * grid.period())?;
        let doubled = System::new(&model, twice.period())?;
        let mut state = GridState::reference(&doubled, twice);
        let layout = doubled.layout(points);
        let mut wave = vec![0.0; layout.motions().end];
        for k in 0..points {
            // Two periods later in steps of twice the size.
            state.copy_point(&doubled, k, &once, 2 * k % points);
            let weights = antiperiodic_at(count, 2.0 * k as f64 / points as f64);
            for node in 0..nodes {
                for i in 0..6 {
                    let at = |l: usize| direction[6 * (node * count + l) + i];
                    let terms = weights.iter().enumerate().map(|(l, w)| w * at(l));
                    wave[layout.motion(node, k).start + i] = terms.sum();
                }
            }
        }
        state.track(&doubled);
        Ok(Crossing {
            model,
            grid: twice,
            state,
            direction: wave,
        })
    }
}

/// Motions, not scaled, that the equations linearised with a rule for increments do not resist.
fn null_vector(
    system: &Arc<System>,
    (grid, state): (TimeGrid, &GridState),
    rule: Box<dyn TimeRule>,
) -> Result<Vec<f64>> {
    let mut equations = Collocation::new(system.clone(), grid)?;
    let mut linear = Assembled::new(&equations);
    equations.set_rule(rule);
    // Singular to rounding it could not be factored.
    equations.ground(GROUNDING);
    linear.assemble(&mut equations, state)?;
    let singular = || {
        let message = "the equations could not be factored where the other branch begins";
        Error::new(ErrorKind::NotAvailable, message)
    };
    if !linear.factor_all(&equations)? {
        return Err(singular());
    }
    let motions = equations.layout().motions();
    let mut vector = probe(equations.size());
    for _ in 0..INVERSE_ITERATIONS {
        // Of motions and forces alone: the least of constraints are high harmonics.
        vector[motions.end..].fill(0.0);
        let size = largest(&vector);
        vector.iter_mut().for_each(|x| *x /= size);
        if !linear.substitute(&mut vector) {
            return Err(singular());
        }
    }
    vector.truncate(motions.end);
    let scales = equations.column_scale().iter();
    vector
        .iter_mut()
        .zip(scales)
        .for_each(|(x, scale)| *x *= scale);
    Ok(vector)
}
