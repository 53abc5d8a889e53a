//! The default initial guess: quasi-static equilibrium, followed once around the period
//! (docs/theory.md, section 9.1).

use super::tracker::Tracker;
use crate::collocation::{Collocation, Conditions, GivenRates, GridState, LikeBlades, Steady};
use crate::error::Result;
use crate::fourier::TimeGrid;
use crate::solve::newton::Newton;
use crate::solve::report::{Iteration, Outcome};
use crate::system::{Driven, System};
use crate::workers::Workers;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Steps taken over a period at least: an angle of a turn a period moves 18 degrees.
const LEAST_STEPS: usize = 20;
/// From this number of points on the period is gone around both ways.
const LARGE: usize = 40;

/// Parts of the period at which inertial forces are looked at, beside where a node's motion bends
/// most: none of the first four harmonics vanishes at both.
const LOOKED_AT: [f64; 2] = [0.0, 0.2];

/// How the guess ended.
pub(crate) struct Guess {
    /// State at the grid points, complete only if `outcome` is [`Outcome::Converged`].
    pub state: GridState,
    /// Whether the guess was found.
    pub outcome: Outcome,
    /// Why not, otherwise.
    pub explanation: String,
}

/// Quasi-static states at all points of `grid`: of what is at rest or, if `driven` is given, turns
/// steadily.
pub(crate) fn quasi_static(
    system: &Arc<System>,
    grid: TimeGrid,
    driven: Option<&Driven>,
    workers: &Workers,
    observe: &mut dyn FnMut(&Iteration) -> bool,
) -> Result<Guess> {
    let mut tracker = Tracker::new(system, workers, observe)?;
    tracker.driven = driven.cloned();
    let mut state = GridState::reference(system, grid);

    // From the unloaded reference configuration to time zero, then around the period.
    let mut states = Vec::new();
    // Like blades are where others were before.
    let alike = LikeBlades::on(system, grid);
    let points = alike.as_ref().map_or(grid.points(), |left| left.part);
    if tracker.follow(1.0, |fraction| (0.0, fraction))? {
        states.push(tracker.state.clone());
        let goes_both_ways = alike.is_none() && points >= LARGE && !system.counts_turns();
        let others = match goes_both_ways {
            true => both_ways(&mut tracker, grid, workers)?,
            false => walk(&mut tracker, grid, 0.0, 1..points)?,
        };
        states.extend(others);
    }
    for (k, at) in states.iter().enumerate() {
        state.copy_point(system, k, at, 0);
    }
    let complete = states.len() == points;
    if let (Some(left), true) = (alike, complete) {
        let equations = Collocation::new(system.clone(), grid)?;
        left.complete(system, equations.column_scale(), &mut state);
    }
    let (outcome, explanation) = tracker
        .failure
        .take()
        .unwrap_or((Outcome::Converged, String::new()));
    Ok(Guess {
        state,
        outcome,
        explanation,
    })
}

/// States at so many points of `grid`, followed from one to the next until there is no equilibrium:
/// from the present one, at time `from`.
fn walk(
    tracker: &mut Tracker,
    grid: TimeGrid,
    mut from: f64,
    points: impl Iterator<Item = usize>,
) -> Result<Vec<GridState>> {
    let parts = LEAST_STEPS.div_ceil(grid.points());
    let mut states = Vec::new();
    for k in points {
        let step = (grid.time(k) - from) / parts as f64;
        for part in 0..parts {
            let start = from + step * part as f64;
            if !tracker.follow(1.0, |fraction| (start + fraction * step, 1.0))? {
                return Ok(states);
            }
        }
        states.push(tracker.state.clone());
        from = grid.time(k);
    }
    Ok(states)
}

/// States at all points of `grid` but the first, as far as there are: from there, where the
/// tracker is, forwards over half the period, and backwards over the other half, which another
/// thread can do.
fn both_ways(tracker: &mut Tracker, grid: TimeGrid, workers: &Workers) -> Result<Vec<GridState>> {
    let system = tracker.newton.equations.system().clone();
    let points = grid.points();
    let half = points / 2 + 1;
    let (start, driven) = (tracker.state.clone(), tracker.driven.clone());
    let backwards = |observe: &mut dyn FnMut(&Iteration) -> bool| {
        let mut other = Tracker::new(&system, &workers.alone(), observe)?;
        other.state = start.clone();
        other.driven = driven.clone();
        let last = walk(&mut other, grid, grid.period(), (half..points).rev())?;
        Ok((
            last,
            other.failure.filter(|(outcome, _)| outcome.is_stopped()),
        ))
    };
    let is_whole = |states: &[GridState]| states.len() + 1 == half;
    let shared = system.time_workers(workers);
    let (mut states, (mut last, stopped)) = if shared.threads() == 1 {
        let states = walk(tracker, grid, 0.0, 1..half)?;
        if !is_whole(&states) {
            return Ok(states);
        }
        (states, backwards(tracker.observe)?)
    } else {
        let has_failed = AtomicBool::new(false);
        let mut seen = Vec::new();
        // Each way has a thread of its own.
        tracker.newton.equations.set_workers(workers.alone());
        let (states, last) = shared.both(
            || {
                let states = walk(tracker, grid, 0.0, 1..half);
                let complete = states.as_ref().is_ok_and(|states| is_whole(states));
                has_failed.store(!complete, Ordering::Relaxed);
                states
            },
            || {
                backwards(&mut |iteration| {
                    seen.push(*iteration);
                    !has_failed.load(Ordering::Relaxed)
                })
            },
        );
        tracker.newton.equations.set_workers(workers.clone());
        let (states, (last, mut stopped)) = (states?, last?);
        if !is_whole(&states) {
            return Ok(states);
        }
        // What the other thread did is told here.
        if !seen.iter().all(|iteration| (tracker.observe)(iteration)) {
            stopped = Some((Outcome::Cancelled, String::new()));
        }
        (states, (last, stopped))
    };
    if stopped.is_some() {
        tracker.failure = stopped;
        return Ok(states);
    }
    // What cannot be reached backwards may be forwards.
    let met = points - last.len();
    states.extend(walk(tracker, grid, grid.time(half - 1), half..met)?);
    if states.len() + 1 == met {
        last.reverse();
        join_turns(&system, states.last().unwrap_or(&start), &mut last);
        states.append(&mut last);
    }
    Ok(states)
}

/// Lets angles go on from those `before` without a jump by whole turns.
fn join_turns(system: &System, before: &GridState, states: &mut [GridState]) {
    let Some(first) = states.first() else {
        return;
    };
    let mut joined = first.clone();
    joined.coordinates.clone_from(&before.coordinates);
    joined.track(system);
    let both = joined.coordinates.iter().zip(&first.coordinates);
    let gains: Vec<f64> = both.map(|(joined, found)| joined - found).collect();
    for state in states {
        let all = state.coordinates.iter_mut().zip(&gains);
        all.for_each(|(angle, gain)| *angle += gain);
    }
}

/// Largest increment of a motion, in scaled unknowns, that the inertial forces of the quasi-static
/// motion `state` would cause at rest, or on what turns steadily, at the times looked at.
pub(crate) fn inertial_displacement(
    system: &Arc<System>,
    grid: TimeGrid,
    driven: Option<&Driven>,
    state: &GridState,
    workers: &Workers,
) -> Result<f64> {
    let count = grid.points();
    let mut newton = Newton::at_instant(system, workers)?;
    let mut at = GridState::at_points(system, 1);
    let mut most = 0.0f64;
    let parts = LOOKED_AT.map(|part| (part * count as f64) as usize);
    // Like blades do at one time what others do at other times.
    let blades = system.symmetry().map_or(1, |symmetry| symmetry.blades);
    let shared = if count.is_multiple_of(blades) {
        count / blades
    } else {
        count
    };
    let mut places: Vec<usize> = parts
        .into_iter()
        .chain([most_bent(system, state)])
        .collect();
    places.iter_mut().for_each(|k| *k %= shared);
    places.sort_unstable();
    places.dedup();
    for k in places {
        newton
            .equations
            .set_conditions(Conditions::at(grid.time(k)))?;
        if let Some(driven) = driven {
            let rule = Steady::new(driven.twists(1.0));
            newton.equations.set_rule(Box::new(rule));
        }
        at.copy_point(system, 0, state, k);
        let (next, last) = ((k + 1) % count, (k + count - 1) % count);
        let [after, before] = grid.intervals(k);
        let whole = after * before * (after + before);
        let differences = |node: usize| {
            let motions = state.node(node);
            let to = |other: usize| motions[k].relative(&motions[other]).logarithm();
            let (forwards, backwards) = (to(next), to(last));
            (
                (forwards * before * before - backwards * after * after) / whole,
                (forwards * before + backwards * after) * 2.0 / whole,
            )
        };
        let (twist, twist_rate) = (0..system.nodes()).map(differences).unzip();
        let given = GivenRates {
            twist,
            twist_rate,
            rates: vec![0.0; system.own_unknowns()],
            weight: 0.0,
            elastic: true,
        };
        most = most.max(newton.displacement_at(&at, Box::new(given))?.unwrap_or(0.0));
    }
    Ok(most)
}

/// The point at which second differences of a node's motion are largest.
fn most_bent(system: &System, state: &GridState) -> usize {
    let (count, length) = (state.points(), system.scales().length);
    let mut largest = (0, 0.0);
    for node in 0..system.nodes() {
        let motions = state.node(node);
        for k in 0..count {
            let [here, next, last] = [k, (k + 1) % count, (k + count - 1) % count]
                .map(|at| (motions[at].position, motions[at].rotation));
            let moved = (next.0 + last.0 - here.0 * 2.0).amax() / length;
            let turned = (next.1 + last.1 - here.1 * 2.0).amax();
            let bent = moved.max(turned);
            if bent > largest.1 {
                largest = (k, bent);
            }
        }
    }
    largest.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::elements::{Coordinate, JointKind};
    use crate::model::{JointCoordinate, Model, Signal, SpringDefinition};
    use crate::test_models::linkages::planar_linkage;
    use nalgebra::{Matrix3, Vector3};
    use std::f64::consts::TAU;

    #[test]
    fn inertial_forces_of_a_quasi_static_oscillation_displace_it_by_their_share_of_the_spring() {
        let (mass, stiffness, force, period) = (2.0, 50.0, 3.0, 1.7);
        let mut model = Model::new();
        let body = model
            .add_rigid_body(mass, &Vector3::zeros(), &Matrix3::identity())
            .unwrap();
        let axis = Model::frame_at("axis", &Vector3::zeros(), &Vector3::x()).unwrap();
        let joint = model
            .add_joint(JointKind::Prismatic, None, Some(body), &axis, &axis)
            .unwrap();
        let at = JointCoordinate {
            joint,
            coordinate: Coordinate::Displacement1,
        };
        let spring = SpringDefinition {
            at,
            stiffness,
            damping: 1.0,
            rest: 0.0,
        };
        model.add_spring_damper(spring).unwrap();
        let push = Signal::harmonics(0.0, 0.0, &[force], &[0.0]).unwrap();
        model.add_actuator(at, &push).unwrap();

        let system = Arc::new(System::new(&model, period).unwrap());
        let grid = TimeGrid::new(15, period).unwrap();
        let workers = Workers::default();
        let guess = quasi_static(&system, grid, None, &workers, &mut |_| true).unwrap();
        assert_eq!(guess.outcome, Outcome::Converged);
        let found = inertial_displacement(&system, grid, None, &guess.state, &workers).unwrap();
        // Second differences of a cosine over a grid interval; the damper has no share in it where
        // the motion turns.
        let interval = period / 15.0;
        let acceleration =
            force / stiffness * (2.0 - 2.0 * (TAU / 15.0).cos()) / (interval * interval);
        let expected = mass * acceleration / stiffness / system.scales().length;
        let error = found / expected - 1.0;
        assert!(error.abs() < 1e-9, "{error:e}");
    }

    #[test]
    fn both_ways_around_the_period_lead_to_the_same_motion() {
        let (model, period) = planar_linkage();
        let system = Arc::new(System::new(&model, period).unwrap());
        let grid = TimeGrid::new(LARGE | 1, period).unwrap();
        let [alone, shared] = [1, 2].map(|threads| {
            let workers = Workers::new(threads).unwrap();
            let guess = quasi_static(&system, grid, None, &workers, &mut |_| true).unwrap();
            assert_eq!(guess.outcome, Outcome::Converged);
            guess.state
        });
        assert_eq!(alone, shared);

        let observe = &mut |_: &_| true;
        let mut tracker = Tracker::new(&system, &Workers::default(), observe).unwrap();
        assert!(tracker.follow(1.0, |fraction| (0.0, fraction)).unwrap());
        let states = walk(&mut tracker, grid, 0.0, 1..grid.points()).unwrap();
        // Both are as accurate as the square of the last increment.
        let mut at = GridState::at_points(&system, 1);
        for (k, state) in (1..).zip(&states) {
            at.copy_point(&system, 0, &alone, k);
            assert!(at.distance(state, system.scales().length) < 1e-5);
            let both = at.coordinates.iter().zip(&state.coordinates);
            both.for_each(|(a, b)| assert!((a - b).abs() < 1e-5, "{k}: {a} {b}"));
        }
        // The crank gains a turn on the coupler.
        let [first, last] = [0, grid.points() - 1].map(|k| alone.tracked(&system, k));
        let gains = first.iter().zip(last).map(|(a, b)| (a - b).abs());
        assert!(gains.fold(0.0, f64::max) > 5.0);
    }

    #[test]
    fn a_guess_is_cancelled_on_either_way_around_the_period() {
        let (model, period) = planar_linkage();
        let system = Arc::new(System::new(&model, period).unwrap());
        let grid = TimeGrid::new(LARGE | 1, period).unwrap();
        for threads in [1, 2] {
            let workers = Workers::new(threads).unwrap();
            let until = |most: usize| {
                let mut seen = 0;
                let observe = &mut |_: &_| {
                    seen += 1;
                    seen <= most
                };
                let guess = quasi_static(&system, grid, None, &workers, observe).unwrap();
                (guess.outcome, seen)
            };
            let (outcome, all) = until(usize::MAX);
            assert_eq!(outcome, Outcome::Converged);
            // The last iteration of an equilibrium does not ask.
            for most in [all / 4, 3 * all / 4] {
                let (outcome, seen) = until(most);
                assert!(
                    outcome == Outcome::Cancelled && seen < most + all / 5,
                    "{seen}"
                );
            }
        }
    }
}
