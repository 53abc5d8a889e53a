//! Frequency responses with folds against marching up and down in speed, and against shooting.

mod common;

use common::models::beams::shaken_rod;
use common::*;
use nalgebra::Vector3;
use periodyn::elements::{Coordinate, JointKind, LoadFrame, NodeForceLaw};
use periodyn::model::{JointCoordinate, Model};
use periodyn::output::{NodeQuantity, Solution};
use periodyn::solve::*;
use std::f64::consts::TAU;
use std::sync::Arc;

/// Times of a period at which motions are compared.
const TIMES: usize = 33;
/// Where the speed of the five points stands on the way from the lower fold to the upper one.
const UP: [f64; 5] = [-0.6, -0.1, 0.2, 0.5, 0.75];
const DOWN: [f64; 5] = [1.6, 1.1, 0.8, 0.5, 0.25];
/// To which what differs from a periodic motion has died away, in a march.
const PERIODIC: f64 = 1e-6;

/// A model whose response folds.
struct Folding {
    /// With this period.
    model: fn(f64) -> Model,
    /// Circular frequencies between which the folds are.
    range: [f64; 2],
    points: usize,
    /// Steps of a period in marches; twice as many in the finer ones.
    steps: usize,
    /// The node and the direction that are compared.
    observed: (usize, usize),
}

/// The crank of a slider-crank turns with the period; its slider carries a mass on a hardening
/// spring, node 0.
fn slider_crank_with_mass(period: f64) -> Model {
    let mut model = Model::new();
    let m = &mut model;
    let [shaft, pin, wrist, place] = [0.0, 0.15, 0.6, 1.0].map(|x| Vector3::new(x, 0.0, 0.0));
    let mass = Some(ball(m, 0.1, 1e-3, &place));
    let crank = Some(ball(m, 0.5, 1e-3, &shaft));
    let rod = Some(ball(m, 0.1, 1e-3, &((pin + wrist) / 2.0)));
    let slider = Some(ball(m, 0.04, 1e-5, &wrist));
    let (x, z) = (Vector3::x(), Vector3::z());
    let motor = revolute(m, None, crank, &shaft, &z);
    revolute(m, crank, rod, &pin, &z);
    join(m, JointKind::Spherical, [rod, slider], &wrist, &z);
    join(m, JointKind::Prismatic, [None, slider], &wrist, &x);
    let on_slider = join(m, JointKind::Prismatic, [slider, mass], &wrist, &x);
    let at = JointCoordinate {
        joint: on_slider,
        coordinate: Coordinate::Displacement1,
    };
    m.add_polynomial_spring_damper(at, &[10.0, 0.0, 4.0], &[0.14], 0.0)
        .unwrap();
    drive(m, motor, period);
    model
}

/// A rod that is clamped at one end, shaken at the other by 6 N, and held there by a force that
/// goes with the cube of the deflection.
fn rod_on_a_hardening_spring(_: f64) -> Model {
    let (mut model, _) = shaken_rod(6.0, 2, 2);
    let law = NodeForceLaw {
        function: Arc::new(|state, out| {
            let z = state.positions[0].z;
            out.forces[0][2] = -180.0 * z.powi(3);
            if let Some((by_motion, _)) = &mut out.tangents {
                by_motion[(2, 2)] = -540.0 * z * z;
            }
            Ok(())
        }),
        gives_tangents: true,
        frame: LoadFrame::Space,
    };
    let force = model.add_node_forces(&[4], law).unwrap();
    model.declare_of_phase(force).unwrap();
    model
}

/// Values over the period, its end included.
fn over_period(
    solution: &Solution,
    first: f64,
    period: f64,
    (node, axis): (usize, usize),
) -> Vec<f64> {
    let times: Vec<f64> = times(period, TIMES).iter().map(|t| first + t).collect();
    let positions = solution.node(node, NodeQuantity::Position, &times).unwrap();
    column(&positions, 3, axis)
}

/// Numbers of the points of a branch by parts between its folds.
fn parts(branch: &Branch) -> Vec<Vec<usize>> {
    let mut parts = vec![Vec::new()];
    for (i, point) in branch.points.iter().enumerate() {
        match point.event {
            Some(Event::Fold) => parts.push(Vec::new()),
            _ => parts.last_mut().unwrap().push(i),
        }
    }
    parts
}

impl Folding {
    fn branch(&self) -> Branch {
        let options = BranchOptions {
            periodic: options(self.points),
            range: self.range,
            stability: Some(StabilityOptions::default()),
            ..BranchOptions::default()
        };
        let period = TAU / self.range[0];
        let model = (self.model)(period);
        let branch = follow_branch(&model, period, Free::Frequency, &options, &mut |_, _| true);
        let branch = branch.unwrap();
        assert_eq!(branch.end, BranchEnd::Range, "{}", branch.explanation);
        branch
    }

    /// The periodic motion at a frequency on a part of the branch, and its multipliers outside.
    fn periodic(&self, branch: &Branch, part: &[usize], frequency: f64) -> (Solution, usize) {
        let away = |i: &usize| (branch.points[*i].values[0] - frequency).abs();
        let nearest = part.iter().min_by(|a, b| away(a).total_cmp(&away(b)));
        let point = &branch.points[*nearest.unwrap()];
        let from = PeriodicOptions {
            guess: InitialGuess::State(point.state.clone()),
            ..options(self.points)
        };
        let period = TAU / frequency;
        let model = (self.model)(period);
        let solution = Solution::solve(&model, period, &from, &mut |_, _| true).unwrap();
        assert_eq!(solution.outcome(), Outcome::Converged);
        (solution, point.stability.unwrap().outside)
    }

    /// Marches on from a state until it is periodic, and gives it and where it has come to.
    fn march(&self, start: MarchStart, frequency: f64, steps: usize) -> (Vec<f64>, MarchStart) {
        let period = TAU / frequency;
        let end = MarchEnd::Periodic {
            tolerance: PERIODIC,
            most_periods: 400,
        };
        let options = MarchOptions {
            start,
            period: Some(period),
            stored_periods: 1,
            ..MarchOptions::with_step(period / steps as f64, end)
        };
        let model = (self.model)(period);
        let marched = Solution::march(&model, &options, &mut |_, _| true).unwrap();
        assert_eq!(
            marched.outcome(),
            Outcome::Converged,
            "{}",
            marched.report()
        );
        let record = marched.details().march().unwrap();
        let (first, last) = (record.times[0], *record.times.last().unwrap());
        let values = over_period(&marched, first, period, self.observed);
        println!(
            "  {frequency:.3}: {} periods of {steps} steps",
            record.periods
        );
        (
            values,
            MarchStart::State(marched.start_state(last).unwrap()),
        )
    }

    /// The same by shooting from a solution.
    fn shoot(&self, from: &Solution, frequency: f64, steps: usize) -> (Vec<f64>, usize) {
        let options = ShootingOptions {
            steps,
            start: MarchStart::State(from.start_state(0.0).unwrap()),
            guess_periods: 0,
            ..ShootingOptions::default()
        };
        let period = TAU / frequency;
        let model = (self.model)(period);
        let found = Solution::solve_shooting(&model, period, &options, &mut |_, _| true).unwrap();
        assert_eq!(found.outcome(), Outcome::Converged, "{}", found.report());
        let Kind::Shooting { floquet, .. } = &found.details().kind else {
            panic!("{}", found.report());
        };
        let outside = floquet.iter().filter(|z| z[0].hypot(z[1]) > 1.0).count();
        (over_period(&found, 0.0, period, self.observed), outside)
    }

    /// Two motions by steps of which the second are half as long differ from the exact one by
    /// errors of second order: what is left when these are extrapolated is little beside them.
    fn compare(&self, exact: &[f64], [coarse, fine]: &[Vec<f64>; 2], rest: f64) {
        let extrapolated = fine.iter().zip(coarse).map(|(f, c)| f + (f - c) / 3.0);
        let extrapolated: Vec<f64> = extrapolated.collect();
        let [coarse, fine, extrapolated] =
            [coarse, fine, &extrapolated].map(|x| relative_to_range(x, exact));
        println!("    off by {coarse:.1e}, {fine:.1e}, extrapolated {extrapolated:.1e}");
        assert!(
            (0.2..0.3).contains(&(fine / coarse)),
            "{fine:e} of {coarse:e}"
        );
        assert!(extrapolated < 0.2 * fine + rest, "{extrapolated:e}");
    }

    fn check(&self) {
        let branch = self.branch();
        let parts = parts(&branch);
        assert_eq!(parts.len(), 3, "{}", branch.report());
        let folds = branch
            .points
            .iter()
            .filter(|p| p.event == Some(Event::Fold));
        let folds: Vec<f64> = folds.map(|p| p.values[0]).collect();
        println!("folds at {folds:?}");
        let at = |place: f64| folds[1] + place * (folds[0] - folds[1]);
        // What is left of what dies away, relative to the range of the motion.
        let rest = 100.0 * PERIODIC;
        for (part, places) in [(&parts[0], UP), (&parts[2], DOWN)] {
            let mut starts: Option<[MarchStart; 2]> = None;
            for frequency in places.map(at) {
                let (exact, outside) = self.periodic(&branch, part, frequency);
                assert_eq!(outside, 0);
                let from = || MarchStart::State(exact.start_state(0.0).unwrap());
                let [coarse, fine] = starts.take().unwrap_or_else(|| [from(), from()]);
                let coarse = self.march(coarse, frequency, self.steps);
                let fine = self.march(fine, frequency, 2 * self.steps);
                starts = Some([coarse.1, fine.1]);
                let exact = over_period(&exact, 0.0, TAU / frequency, self.observed);
                self.compare(&exact, &[coarse.0, fine.0], rest);
            }
        }
        // Three motions at one speed, the one between unstable.
        for (part, expected) in parts.iter().zip([0, 1, 0]) {
            let frequency = at(0.5);
            let (exact, outside) = self.periodic(&branch, part, frequency);
            let shots = [1, 2].map(|i| self.shoot(&exact, frequency, i * self.steps));
            assert_eq!([outside, shots[0].1, shots[1].1], [expected; 3]);
            let exact = over_period(&exact, 0.0, TAU / frequency, self.observed);
            self.compare(&exact, &shots.map(|shot| shot.0), 1e-7);
        }
    }
}

#[test]
fn a_slider_crank_that_shakes_a_mass() {
    Folding {
        model: slider_crank_with_mass,
        range: [7.0, 16.0],
        points: 41,
        steps: 80,
        observed: (0, 0),
    }
    .check();
}

#[test]
fn a_forced_cantilever() {
    Folding {
        model: rod_on_a_hardening_spring,
        range: [20.0, 50.0],
        points: 31,
        steps: 80,
        observed: (4, 2),
    }
    .check();
}
