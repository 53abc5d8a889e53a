//! Forces along beams by functions of the user: the same as loads where they are such, and closed
//! forms of rods that a fluid damps.

mod common;

use common::models::beams::shaken_rod;
use common::models::rotors::{AXIS, RotorKind, bladed_rotor};
use common::*;
use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};
use periodyn::elements::*;
use periodyn::error::{Error, ErrorKind, Result};
use periodyn::model::*;
use periodyn::motion::{Motion, rotation_from_vector, skew};
use periodyn::output::{JointQuantity, Modes, NodeQuantity, Solution};
use periodyn::solve::*;
use periodyn::system::check_tangents;
use std::f64::consts::TAU;
use std::sync::Arc;

type Input<'a> = SurfaceForceInput<'a>;
type Output<'a> = SurfaceForceOutput<'a>;

fn law(
    frame: LoadFrame,
    gives_tangents: bool,
    function: impl Fn(&Input, &mut Output) -> Result<()> + Send + Sync + 'static,
) -> SurfaceForceLaw {
    SurfaceForceLaw {
        function: Arc::new(function),
        gives_tangents,
        frame,
    }
}

/// Position and rotation of all nodes.
fn motions(solution: &Solution) -> Vec<f64> {
    let of = |node| {
        [NodeQuantity::Position, NodeQuantity::RotationMatrix]
            .map(|quantity| solution.node(node, quantity, &[0.0]).unwrap())
            .concat()
    };
    (0..solution.model().node_count()).flat_map(of).collect()
}

/// A rod of 1 m over three elements, bent to a quarter of a circle if `curved`, whose section is
/// turned by an angle with a corner half-way, within the second element; clamped.
fn twisted_rod(curved: bool) -> Model {
    let section =
        SectionInput::diagonal(&[8e3, 3e3, 3e3, 14.0, 9.0, 25.0], &[0.3, 1e-5, 5e-6, 5e-6]);
    let section = section.unwrap();
    let stations = [(0.0, 0.2), (0.5, 0.9), (1.0, 0.4)];
    let stations = stations.map(|(fraction, twist)| SectionStation {
        fraction,
        section,
        twist,
    });
    let bend = if curved { 0.25 * TAU } else { 0.0 };
    let line = move |t: f64| {
        let turn = rotation_from_vector(&(Vector3::z() * (bend * t)));
        let place = match curved {
            true => Vector3::new((bend * t).sin(), 1.0 - (bend * t).cos(), 0.0) / bend,
            false => Vector3::x() * t,
        };
        Ok(Motion::new(turn, place))
    };
    let mut model = Model::new();
    let rod = model.add_beam_along(line, &stations, 3, 3).unwrap();
    clamp(&mut model, rod.first_node);
    model
}

/// What a function that returns a load, linear from `from` to `to` over the last two of the three
/// elements, and the load itself move the rod by differently, and how far it moves.
fn apart_from_load(
    curved: bool,
    frame: BeamLoadFrame,
    [from, to]: [f64; 2],
    given: bool,
) -> [f64; 2] {
    let load = [30.0, -20.0, 50.0, 2.0, 4.0, -3.0];
    let mut loaded = twisted_rod(curved);
    loaded
        .add_distributed_load(DistributedLoadDefinition {
            first_element: 1,
            elements: 2,
            frame,
            components: load.map(|x| Some(Signal::constant(x).unwrap())),
            factors: vec![(0.0, from), (1.0, to)],
        })
        .unwrap();
    let expected = motions(&statics(&loaded));
    let mut model = twisted_rod(curved);
    let (place, frame) = match frame {
        BeamLoadFrame::Space => (ForcePlace::Line, LoadFrame::Space),
        BeamLoadFrame::Follower => (ForcePlace::Line, LoadFrame::Follower),
        BeamLoadFrame::Untwisted(axis_2) => {
            (ForcePlace::UntwistedLine(axis_2), LoadFrame::Follower)
        }
    };
    // The tangents are zero.
    let law = law(frame, given, move |state, out| {
        assert_eq!(state.place, place);
        for (force, [xi, eta]) in out.forces.iter_mut().zip(state.places) {
            assert_eq!(*eta, 0.0);
            let fraction = 0.5 * ((state.element - 1) as f64 + 0.5 * (xi + 1.0));
            *force = Vector6::from(load) * (from + (to - from) * fraction);
        }
        Ok(())
    });
    let first = model.add_surface_forces(1, 2, place, law);
    assert_eq!(first.unwrap(), 0);
    let found = motions(&statics(&model));
    let free = motions(&statics(&twisted_rod(curved)));
    [
        largest_difference(&found, &expected),
        largest_difference(&found, &free),
    ]
}

#[test]
fn functions_that_do_not_depend_on_the_motion_are_loads() {
    let untwisted = BeamLoadFrame::Untwisted(Vector3::new(0.1, 0.7, 0.4));
    for frame in [BeamLoadFrame::Space, BeamLoadFrame::Follower, untwisted] {
        for given in [true, false] {
            // Constant loads are integrated as loads are, whatever the line; linear ones by the
            // same rule where the length for a unit of ξ is the same.
            for (curved, factors) in [
                (false, [1.0, 1.0]),
                (true, [1.0, 1.0]),
                (false, [-0.4, 1.6]),
            ] {
                let [apart, moved] = apart_from_load(curved, frame, factors, given);
                println!("{frame:?} {given} {curved} {factors:?}: {apart:e} of {moved}");
                // Rounding, times the condition of the equations.
                assert!(moved > 0.1 && apart < 1e-13, "{moved} {apart:e}");
            }
        }
    }
}

#[test]
fn how_the_elements_are_divided_among_calls_does_not_matter() {
    let solve = |parts: &[(usize, usize)]| {
        let mut model = twisted_rod(true);
        for &(first, count) in parts {
            let law = law(LoadFrame::Follower, false, |state, out| {
                for (k, force) in out.forces.iter_mut().enumerate() {
                    force[2] = 40.0 * state.positions[k][0] - 9.0 * state.rotations[k][(2, 1)];
                    force[3] = 2.0 + state.element as f64;
                }
                Ok(())
            });
            model
                .add_surface_forces(first, count, ForcePlace::Line, law)
                .unwrap();
        }
        motions(&statics(&model))
    };
    let whole = solve(&[(0, 3)]);
    for parts in [&[(0, 1), (1, 2)][..], &[(0, 1), (1, 1), (2, 1)]] {
        assert_eq!(solve(parts), whole);
    }
}

/// Eigenvalues `λ` of small motions, those with `Im λ > 0`.
fn eigenvalues(model: &Model) -> Vec<[f64; 2]> {
    let options = ModesOptions {
        count: 5,
        ..ModesOptions::default()
    };
    let modes = Modes::solve(model, &options, &mut |_, _| true).unwrap();
    assert_eq!(modes.outcome(), Outcome::Converged, "{}", modes.report());
    let found = modes.modes().iter().map(|mode| mode.eigenvalue);
    found.map(|value| [value.re, value.im]).collect()
}

#[test]
fn a_fluid_that_resists_in_proportion_to_mass_damps_all_modes_alike() {
    let (rate, mass) = (6.0, [0.3, 4e-5, 1e-5, 3e-5]);
    let rod = |degree: usize| {
        let section = SectionInput::diagonal(&[8e5, 3e5, 3e5, 14.0, 9.0, 25.0], &mass).unwrap();
        let mut model = Model::new();
        let (root, tip) = (Vector3::zeros(), Vector3::x());
        let rod = model
            .add_straight_beam(&root, &tip, &Vector3::y(), &section, 2, degree)
            .unwrap();
        clamp(&mut model, rod.first_node);
        model
    };
    let error = |degree: usize, frame: LoadFrame, gives_tangents: bool| {
        let free = eigenvalues(&rod(degree));
        let mut model = rod(degree);
        let law = law(frame, gives_tangents, move |state, out| {
            let [m, turning @ ..] = mass;
            let factors = Vector6::new(m, m, m, turning[0], turning[1], turning[2]) * -rate;
            for (force, velocity) in out.forces.iter_mut().zip(state.velocities) {
                *force = factors.component_mul(velocity);
            }
            if let Some([_, by_velocity]) = &mut out.tangents {
                by_velocity.fill(Matrix6::from_diagonal(&factors));
            }
            Ok(())
        });
        model
            .add_surface_forces(0, 2, ForcePlace::Line, law)
            .unwrap();
        let damped = eigenvalues(&model);
        let errors = damped.iter().zip(&free).map(|(damped, free)| {
            // λ² + rate λ + ω² = 0.
            let exact = [-0.5 * rate, (free[1] * free[1] - 0.25 * rate * rate).sqrt()];
            (damped[0] - exact[0]).hypot(damped[1] - exact[1]) / free[1]
        });
        let errors: Vec<f64> = errors.collect();
        println!("degree {degree}, {frame:?}, {gives_tangents}: {errors:?}");
        largest(errors)
    };
    // Inertia interpolates velocities, the force motions: these differ by what the mesh leaves.
    let errors = [3, 5, 7].map(|degree| error(degree, LoadFrame::Space, true));
    let differenced = error(7, LoadFrame::Follower, false);
    assert!(
        errors[1] < 0.1 * errors[0] && errors[2] < 0.1 * errors[1],
        "{errors:?}"
    );
    assert!(
        errors[2] < 1e-7 && differenced < 1e-7,
        "{errors:?} {differenced:e}"
    );
}

const LENGTH: f64 = 1.5;
const MASS: f64 = 1e-3;

/// A rod, all but rigid, whose end turns about the axis `z` by large angles as `swing` says, in a
/// fluid; the joint, and the node at the tip.
fn swung_rod(swing: &Signal, law: SurfaceForceLaw) -> (Model, usize) {
    // So stiff that it bends by 1e-8; a twist that a blade has, and nodes enough to interpolate it:
    // with degree 3 places of points would be off by 1e-7.
    let stiffness = [1e10, 1e10, 1e10, 1e10, 1e10, 1e10];
    let section = SectionInput::diagonal(&stiffness, &[MASS, 1e-9, 5e-10, 5e-10]).unwrap();
    let stations = [(0.0, 0.3), (1.0, -0.1)].map(|(fraction, twist)| SectionStation {
        fraction,
        section,
        twist,
    });
    let (root, tip) = (Vector3::zeros(), Vector3::x() * LENGTH);
    let line = straight_line(&root, &tip, &Vector3::y()).unwrap();
    let mut model = Model::new();
    let rod = model.add_beam_along(line, &stations, 2, 5).unwrap();
    let joint = revolute(&mut model, None, Some(rod.first_node), &root, &Vector3::z());
    model.prescribe(rotation1(joint), swing).unwrap();
    model
        .add_surface_forces(0, 2, ForcePlace::Line, law)
        .unwrap();
    (model, joint)
}

/// Drag against the velocity across the rod, in proportion to it: by the velocity in space, with
/// tangents, or along the axes of the sections, by differences.
fn drag(c: f64, in_space: bool) -> SurfaceForceLaw {
    if !in_space {
        return law(LoadFrame::Follower, false, move |state, out| {
            for (force, velocity) in out.forces.iter_mut().zip(state.velocities) {
                (force[1], force[2]) = (-c * velocity[1], -c * velocity[2]);
            }
            Ok(())
        });
    }
    // −c (1 − a aᵀ) v, where a is along the rod.
    law(LoadFrame::Space, true, move |state, out| {
        for (k, velocity) in state.velocities.iter().enumerate() {
            let a: Vector3<f64> = state.rotations[k].column(0).into();
            let v: Vector3<f64> = velocity.fixed_rows::<3>(0).into();
            let force = (v - a * a.dot(&v)) * -c;
            out.forces[k].fixed_rows_mut::<3>(0).copy_from(&force);
            if let Some([by_motion, by_velocity]) = &mut out.tangents {
                let by_a = (Matrix3::identity() * a.dot(&v) + a * v.transpose()) * c;
                let by_turn = by_a * -skew(&a);
                by_motion[k]
                    .fixed_view_mut::<3, 3>(0, 3)
                    .copy_from(&by_turn);
                let by_v = (Matrix3::identity() - a * a.transpose()) * -c;
                by_velocity[k].fixed_view_mut::<3, 3>(0, 0).copy_from(&by_v);
            }
        }
        Ok(())
    })
}

#[test]
fn drag_on_a_rod_that_swings_widely_is_its_closed_form() {
    let (swing, period, c) = (1.2, 1.6, 40.0);
    let times: Vec<f64> = (0..7).map(|k| period * f64::from(k) / 7.0).collect();
    for in_space in [true, false] {
        let (model, joint) = swung_rod(&cosine(swing), drag(c, in_space));
        match in_space {
            true => {
                let check = check_tangents(&model, 1, period).unwrap();
                println!("{check:?}");
                // Of central differences: the power 2/3 of rounding, 4e-11, times a few.
                assert!(check.error < 1e-8, "{check:?}");
            }
            false => {
                let error = check_tangents(&model, 1, period).unwrap_err();
                assert_eq!(error.kind(), ErrorKind::NotAvailable);
            }
        }
        let solution = solve(&model, period, 31);
        let effort = JointQuantity::DrivingEffort(Coordinate::Rotation1);
        let found = solution.joint(joint, effort, &times).unwrap();
        let omega = TAU / period;
        let exact: Vec<f64> = times
            .iter()
            .map(|t| {
                let (sine, cosine) = (omega * t).sin_cos();
                let rate = -swing * omega * sine;
                let third = LENGTH.powi(3) / 3.0;
                c * third * rate - MASS * third * omega * omega * swing * cosine
            })
            .collect();
        let error = largest_difference(&found, &exact) / largest(exact);
        println!("{error:e}");
        // What the rod bends by, and its rotary inertia beside that of its length.
        assert!(error < 1e-7, "{error:e}");
    }
}

#[test]
fn velocities_are_relative_to_the_inertial_frame_where_a_rod_turns_steadily() {
    let (period, c) = (0.5, 3.0);
    let omega = TAU / period;
    for in_space in [true, false] {
        let (model, joint) = swung_rod(&steady(omega), drag(c, in_space));
        let effort = JointQuantity::DrivingEffort(Coordinate::Rotation1);
        let solution = solve(&model, period, 9);
        let found = solution.joint(joint, effort, &[0.0, 0.3 * period]).unwrap();
        let exact = c * LENGTH.powi(3) / 3.0 * omega;
        println!("{found:?} {exact}");
        let error = largest(found.iter().map(|x| x / exact - 1.0));
        assert!(error < 1e-7, "{error:e}");
    }
}

/// The nylon rod that a force at its tip shakes near its first natural frequency, with drag as the
/// cube of the velocity across it.
fn dragged_rod(elements: usize, degree: usize, gives_tangents: bool) -> (Model, f64) {
    let drag = law(LoadFrame::Follower, gives_tangents, |state, out| {
        const FACTOR: f64 = 0.2;
        for (k, velocity) in state.velocities.iter().enumerate() {
            for i in [1, 2] {
                let v = velocity[i];
                out.forces[k][i] = -FACTOR * v * v * v;
                if let Some([_, by_velocity]) = &mut out.tangents {
                    by_velocity[k][(i, i)] = -3.0 * FACTOR * v * v;
                }
            }
        }
        Ok(())
    });
    let (mut model, period) = shaken_rod(12.0, elements, degree);
    model
        .add_surface_forces(0, elements, ForcePlace::Line, drag)
        .unwrap();
    (model, period)
}

/// Position of the tip, the last node.
fn tip(solution: &Solution, times: &[f64]) -> Vec<f64> {
    let last = solution.model().node_count() - 1;
    solution.node(last, NodeQuantity::Position, times).unwrap()
}

#[test]
fn a_rod_with_drag_converges_quadratically_by_all_solvers_and_meshes() {
    let times = times(0.3, 9);
    let free = tip(&solve(&shaken_rod(12.0, 2, 4).0, 0.3, 31), &times);
    let found = [true, false].map(|gives_tangents| {
        let (model, period) = dragged_rod(2, 4, gives_tangents);
        let solution = solve(&model, period, 31);
        let iterations = &solution.details().report.iterations;
        let increments: Vec<f64> = iterations.iter().map(|i| i.increment).collect();
        println!("{increments:?}");
        for pair in increments.windows(2).rev().take(2) {
            assert!(
                pair[1] <= 10.0 * pair[0] * pair[0] + 1e-11,
                "{increments:?}"
            );
        }
        tip(&solution, &times)
    });
    let apart = largest_difference(&found[0], &found[1]);
    let damped = largest_difference(&found[0], &free);
    println!("differenced {apart:e}, damped by {damped}");
    assert!(apart < 1e-12 && damped > 0.1, "{apart:e} {damped}");

    let (model, period) = dragged_rod(2, 4, true);
    let mut iterative = options(31);
    iterative.linear = LinearMethod::Iterative(None);
    let solution = Solution::solve(&model, period, &iterative, &mut |_, _| true);
    let apart = largest_difference(&tip(&converged(solution.unwrap()), &times), &found[0]);
    println!("iterative {apart:e}");
    assert!(apart < 1e-12, "{apart:e}");

    // Spectral in the mesh.
    let fine = tip(&solve(&dragged_rod(3, 6, true).0, 0.3, 31), &times);
    let errors = [3, 4, 5].map(|degree| {
        let coarse = tip(&solve(&dragged_rod(2, degree, true).0, 0.3, 31), &times);
        largest_difference(&coarse, &fine)
    });
    println!("{errors:?}");
    assert!(
        errors[1] < 0.3 * errors[0] && errors[2] < 0.3 * errors[1] && errors[2] < 1e-6,
        "{errors:?}"
    );
}

#[test]
fn a_march_keeps_to_the_periodic_motion_to_the_second_order() {
    let (model, period) = dragged_rod(2, 2, true);
    let periodic = solve(&model, period, 41);
    let exact = tip(&periodic, &[0.5 * period]);
    let errors = [200, 400].map(|steps| {
        let duration = 0.5 * period;
        let end = MarchEnd::Duration(duration);
        let mut options = MarchOptions::with_step(duration / f64::from(steps), end);
        options.newton.tolerance = 1e-10;
        options.period = Some(period);
        options.start = MarchStart::State(periodic.start_state(0.0).unwrap());
        let marched = Solution::march(&model, &options, &mut |_, _| true).unwrap();
        largest_difference(&tip(&converged(marched), &[duration]), &exact)
    });
    println!("{errors:?}");
    let ratio = errors[0] / errors[1];
    assert!((3.6..4.4).contains(&ratio), "{errors:?}");
    assert!(errors[1] < 1e-5, "{errors:?}");
}

#[test]
fn the_air_on_like_blades_is_that_on_all_of_them() {
    // By the velocity of the sections relative to a wind that is stronger higher up, as its square.
    let mut rotor = bladed_rotor(&RotorKind::new(3, 1, true));
    let air = law(LoadFrame::Space, false, |state, out| {
        for (k, velocity) in state.velocities.iter().enumerate() {
            let wind = AXIS * (8.0 + state.positions[k][2]);
            let relative = velocity.fixed_rows::<3>(0) - wind;
            let force = relative * (-0.02 * relative.norm());
            out.forces[k].fixed_rows_mut::<3>(0).copy_from(&force);
        }
        Ok(())
    });
    // The tower is the first element.
    let blades = rotor.model.object_count(ObjectKind::BeamElement) - 1;
    let still = solve(&rotor.model, rotor.period, 21);
    rotor
        .model
        .add_surface_forces(1, blades, ForcePlace::Line, air)
        .unwrap();
    let whole = solve(&rotor.model, rotor.period, 21);
    let alike = solve(&rotor.symmetric(), rotor.period, 21);
    let times = times(rotor.period, 5);
    for blade in &rotor.blades {
        let of = |solution: &Solution| {
            let node = *blade.last().unwrap();
            solution.node(node, NodeQuantity::Position, &times).unwrap()
        };
        let apart = largest_difference(&of(&whole), &of(&alike));
        let moved = largest_difference(&of(&whole), &of(&still));
        println!("{apart:e} of {moved}");
        assert!(apart < 1e-10 && moved > 1e-2, "{apart:e} {moved}");
    }
}

#[test]
fn what_cannot_be_is_refused() {
    let zero = || law(LoadFrame::Space, true, |_, _| Ok(()));
    let mut model = twisted_rod(true);
    for (first, elements, place, kind) in [
        (3, 1, ForcePlace::Line, ErrorKind::Identifier),
        (1, 3, ForcePlace::Line, ErrorKind::Size),
        (
            1,
            2,
            ForcePlace::UntwistedLine(Vector3::zeros()),
            ErrorKind::Value,
        ),
        (0, 0, ForcePlace::Line, ErrorKind::Size),
        // There is no shell.
        (0, 1, ForcePlace::Surface, ErrorKind::Identifier),
    ] {
        let error = model
            .add_surface_forces(first, elements, place, zero())
            .unwrap_err();
        assert_eq!(error.kind(), kind, "{error}");
        assert_eq!(model.force_count(), 0);
    }
    let refusal = |law: SurfaceForceLaw| {
        let mut model = twisted_rod(true);
        model
            .add_surface_forces(1, 1, ForcePlace::Line, law)
            .unwrap();
        let options = PeriodicOptions::with_grid_points(5);
        let error = Solution::solve(&model, 1.0, &options, &mut |_, _| true).unwrap_err();
        (error.kind(), error.to_string())
    };
    let follower = LoadFrame::Follower;
    let nan = law(follower, false, |_, out| {
        out.forces[3][1] = f64::NAN;
        Ok(())
    });
    let infinite = law(follower, true, |_, out| {
        if let Some([_, by_velocity]) = &mut out.tangents {
            by_velocity[0][(2, 4)] = f64::INFINITY;
        }
        Ok(())
    });
    let failing = law(follower, false, |_, _| {
        Err(Error::new(ErrorKind::Callback, "no such wind"))
    });
    let growing = law(follower, false, |state, out| {
        out.forces[0][2] = state.time;
        Ok(())
    });
    for (law, kind, expected) in [
        (
            nan,
            ErrorKind::Callback,
            "finite force 2 on beam element 1 at 0.861",
        ),
        (
            infinite,
            ErrorKind::Callback,
            "derivative of force 3 on beam element 1 at -0.861",
        ),
        (failing, ErrorKind::Callback, "no such wind"),
        (growing, ErrorKind::NotPeriodic, "force 0"),
    ] {
        let (found, message) = refusal(law);
        assert!(found == kind && message.contains(expected), "{message}");
    }
}
