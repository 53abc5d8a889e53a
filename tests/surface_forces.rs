//! Forces on shells by functions of the user: the same as loads where they are such, and closed
//! forms of plates that a fluid damps.

mod common;

use common::models::shells::{add_strip, clamp_edge, mesh, rubber_plate};
use common::*;
use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};
use periodyn::elements::*;
use periodyn::error::{Error, ErrorKind, Result};
use periodyn::model::*;
use periodyn::output::{JointQuantity, Modes, NodeQuantity, Solution};
use periodyn::solve::*;
use periodyn::system::check_tangents;
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

fn positions(solution: &Solution) -> Vec<f64> {
    let nodes = 0..solution.model().node_count();
    let position = |node| solution.node(node, NodeQuantity::Position, &[0.0]).unwrap();
    nodes.flat_map(position).collect()
}

#[test]
fn constant_functions_are_loads() {
    let load = [30.0, -20.0, 50.0, 2.0, 4.0, -3.0];
    let shell = || {
        let (mut model, patch) = rubber_plate([1.0, 0.5], 0.3, &mesh([2, 1], [4, 4]));
        clamp_edge(&mut model, &patch.edge(PatchEdge::StartU));
        model
    };
    for place in [
        ShellLoadPlace::Surface,
        ShellLoadPlace::Edge(1),
        ShellLoadPlace::Edge(2),
    ] {
        for frame in [LoadFrame::Space, LoadFrame::Follower] {
            let mut expected = shell();
            let component = |i: usize| Some(Signal::constant(load[i]).unwrap());
            let definition = ShellLoadDefinition {
                first_element: 1,
                elements: 1,
                place,
                frame,
                components: std::array::from_fn(component),
            };
            expected.add_shell_load(definition).unwrap();
            let expected = positions(&statics(&expected));
            for gives_tangents in [true, false] {
                let mut model = shell();
                // The tangents of a constant are zero.
                let law = law(frame, gives_tangents, move |_, out| {
                    out.forces.fill(Vector6::from(load));
                    Ok(())
                });
                assert_eq!(model.add_surface_forces(1, 1, place, law).unwrap(), 0);
                let found = positions(&statics(&model));
                let moved = largest_difference(&found, &positions_of(&model));
                let apart = largest_difference(&found, &expected);
                println!("{place:?} {frame:?} {gives_tangents}: {apart:e} of {moved}");
                assert!(moved > 1e-2 && apart < 1e-12, "{moved} {apart:e}");
            }
        }
    }
}

fn positions_of(model: &Model) -> Vec<f64> {
    let motions = model.reference_motions().iter();
    motions
        .flat_map(|m| m.position.iter().copied().collect::<Vec<_>>())
        .collect()
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
    let [h, young, density] = [0.02, 2e8, 1100.0];
    let section = IsotropicShell::new(h, young, 0.3, density)
        .section()
        .unwrap();
    let rate = 6.0;
    let per_area = density * h * rate;
    let plate = |nodes: usize| {
        let mut model = Model::new();
        let mesh = mesh([2, 1], [nodes, nodes]);
        let patch = add_strip(&mut model, [1.0, 0.6], &section, &mesh);
        clamp_edge(&mut model, &patch.edge(PatchEdge::StartU));
        model
    };
    let error = |nodes: usize, frame: LoadFrame, gives_tangents: bool| {
        let free = eigenvalues(&plate(nodes));
        let mut model = plate(nodes);
        let law = law(frame, gives_tangents, move |state, out| {
            let turning = h * h / 12.0;
            let factors = Vector6::new(1.0, 1.0, 1.0, turning, turning, turning) * -per_area;
            for (force, velocity) in out.forces.iter_mut().zip(state.velocities) {
                *force = factors.component_mul(velocity);
            }
            if let Some([_, by_velocity]) = &mut out.tangents {
                by_velocity.fill(Matrix6::from_diagonal(&factors));
            }
            Ok(())
        });
        let surface = ShellLoadPlace::Surface;
        model.add_surface_forces(0, 2, surface, law).unwrap();
        let damped = eigenvalues(&model);
        let errors = damped.iter().zip(&free).map(|(damped, free)| {
            // λ² + rate λ + ω² = 0.
            let exact = [-0.5 * rate, (free[1] * free[1] - 0.25 * rate * rate).sqrt()];
            (damped[0] - exact[0]).hypot(damped[1] - exact[1]) / free[1]
        });
        let errors: Vec<f64> = errors.collect();
        println!("{nodes} nodes, {frame:?}, {gives_tangents}: {errors:?}");
        largest(errors)
    };
    // Inertia interpolates velocities, the force motions: these differ by what the mesh leaves.
    let errors = [4, 6, 8].map(|nodes| error(nodes, LoadFrame::Space, true));
    let differenced = error(8, LoadFrame::Follower, false);
    assert!(
        errors[1] < 0.1 * errors[0] && errors[2] < 0.1 * errors[1],
        "{errors:?}"
    );
    assert!(
        errors[2] < 1e-6 && differenced < 1e-6,
        "{errors:?} {differenced:e}"
    );
}

/// A plate, all but rigid, that a shaft along its edge turns to and fro by large angles in a fluid
/// with the pressure `drag(v)` against the normal velocity; the shaft's joint.
fn swung_plate(swing: f64, law: SurfaceForceLaw) -> (Model, usize) {
    // So stiff that it bends by 1e-8.
    let section = IsotropicShell::new(0.05, 2e13, 0.3, 1e-3)
        .section()
        .unwrap();
    let mut model = Model::new();
    let patch = add_strip(&mut model, [LENGTH, WIDTH], &section, &mesh([2, 1], [4, 3]));
    let origin = Vector3::y() * 0.5 * WIDTH;
    let shaft = ball(&mut model, 0.1, 1e-3, &origin);
    let edge = patch.edge(PatchEdge::StartU);
    model.add_rigid_joints(Some(shaft), &edge).unwrap();
    let joint = revolute(&mut model, None, Some(shaft), &origin, &Vector3::y());
    model.prescribe(rotation1(joint), &cosine(swing)).unwrap();
    let surface = ShellLoadPlace::Surface;
    model.add_surface_forces(0, 2, surface, law).unwrap();
    (model, joint)
}

const LENGTH: f64 = 1.0;
const WIDTH: f64 = 0.4;

#[test]
fn drag_on_a_plate_that_swings_widely_is_its_closed_form() {
    let (swing, period, c) = (1.2, 1.6, 40.0);
    let times: Vec<f64> = (0..7).map(|k| period * f64::from(k) / 7.0).collect();
    // Pressure −c vₙ, by the velocity in space, with tangents: v_n = nᵀ v, f = −c n nᵀ v.
    let in_space = law(LoadFrame::Space, true, move |state, out| {
        for (k, velocity) in state.velocities.iter().enumerate() {
            let n: Vector3<f64> = state.rotations[k].column(2).into();
            let v: Vector3<f64> = velocity.fixed_rows::<3>(0).into();
            let force = n * (-c * n.dot(&v));
            out.forces[k].fixed_rows_mut::<3>(0).copy_from(&force);
            if let Some([by_motion, by_velocity]) = &mut out.tangents {
                // n turns with the point.
                let turn = -periodyn::motion::skew(&n);
                let by_n = (Matrix3::identity() * n.dot(&v) + n * v.transpose()) * -c;
                by_motion[k]
                    .fixed_view_mut::<3, 3>(0, 3)
                    .copy_from(&(by_n * turn));
                let by_v = n * n.transpose() * -c;
                by_velocity[k].fixed_view_mut::<3, 3>(0, 0).copy_from(&by_v);
            }
        }
        Ok(())
    });
    // The same along the axes of the plate, by differences.
    let along = law(LoadFrame::Follower, false, move |state, out| {
        for (force, velocity) in out.forces.iter_mut().zip(state.velocities) {
            force[2] = -c * velocity[2];
        }
        Ok(())
    });
    for (drag, given) in [(in_space, true), (along, false)] {
        let (model, joint) = swung_plate(swing, drag);
        match given {
            true => {
                let check = check_tangents(&model, 1, period).unwrap();
                println!("{check:?}");
                assert!(check.error < 1e-7, "{check:?}");
            }
            false => {
                let error = check_tangents(&model, 1, period).unwrap_err();
                assert_eq!(error.kind(), ErrorKind::NotAvailable);
            }
        }
        let solution = solve(&model, period, 31);
        let effort = JointQuantity::DrivingEffort(Coordinate::Rotation1);
        let found = solution.joint(joint, effort, &times).unwrap();
        let inertia = 1e-3 + 1e-3 * 0.05 * WIDTH * LENGTH.powi(3) / 3.0;
        let omega = std::f64::consts::TAU / period;
        let exact: Vec<f64> = times
            .iter()
            .map(|t| {
                let (sine, cosine) = (omega * t).sin_cos();
                let rate = -swing * omega * sine;
                let drag = c * WIDTH * LENGTH.powi(3) / 3.0 * rate;
                drag - inertia * omega * omega * swing * cosine
            })
            .collect();
        let error = largest_difference(&found, &exact) / largest(exact);
        println!("{error:e}");
        // What the plate bends by, and thickness beside length² in its inertia.
        assert!(error < 1e-6, "{error:e}");
    }
}

#[test]
fn newton_converges_quadratically_with_drag() {
    // Drag as the cube of the velocity, on rubber that bends, near its first natural frequency, so
    // that steps with the last matrix are not good enough.
    let drag = |gives_tangents| {
        law(LoadFrame::Follower, gives_tangents, |state, out| {
            const FACTOR: f64 = 20.0;
            for (k, velocity) in state.velocities.iter().enumerate() {
                let v = velocity[2];
                out.forces[k][2] = -FACTOR * v * v * v;
                if let Some([_, by_velocity]) = &mut out.tangents {
                    by_velocity[k][(2, 2)] = -3.0 * FACTOR * v * v;
                }
            }
            Ok(())
        })
    };
    let found = [true, false].map(|gives_tangents| {
        let mut model = common::models::shells::flapping_plate(0.6, [2, 1], 4).0;
        let surface = ShellLoadPlace::Surface;
        let law = drag(gives_tangents);
        model.add_surface_forces(0, 2, surface, law).unwrap();
        let solution = solve(&model, 0.8, 21);
        let iterations = &solution.details().report.iterations;
        let increments: Vec<f64> = iterations.iter().map(|i| i.increment).collect();
        println!("{increments:?}");
        for pair in increments.windows(2).rev().take(2) {
            assert!(
                pair[1] <= 10.0 * pair[0] * pair[0] + 1e-11,
                "{increments:?}"
            );
        }
        positions(&solution)
    });
    let apart = largest_difference(&found[0], &found[1]);
    println!("{apart:e}");
    assert!(apart < 1e-9, "{apart:e}");
}

#[test]
fn what_cannot_be_is_refused() {
    let plate = || {
        let (mut model, patch) = rubber_plate([1.0, 0.5], 0.3, &mesh([2, 1], [3, 3]));
        clamp_edge(&mut model, &patch.edge(PatchEdge::StartU));
        model
    };
    let surface = ShellLoadPlace::Surface;
    let zero = || law(LoadFrame::Space, true, |_, _| Ok(()));
    let mut model = plate();
    for (first, elements, place, kind) in [
        (2, 1, surface, ErrorKind::Identifier),
        (1, 2, surface, ErrorKind::Size),
        (0, 0, surface, ErrorKind::Size),
        (0, 1, ShellLoadPlace::Edge(4), ErrorKind::Value),
    ] {
        let error = model
            .add_surface_forces(first, elements, place, zero())
            .unwrap_err();
        assert_eq!(error.kind(), kind, "{error}");
        assert_eq!(model.force_count(), 0);
    }
    let solve = |law: SurfaceForceLaw| {
        let mut model = plate();
        model.add_surface_forces(1, 1, surface, law).unwrap();
        let options = PeriodicOptions::with_grid_points(5);
        let solved = Solution::solve(&model, 1.0, &options, &mut |_, _| true);
        solved.err().map(|error| (error.kind(), error.to_string()))
    };
    let follower = LoadFrame::Follower;
    let (kind, message) = solve(law(follower, false, |_, out| {
        out.forces[3][1] = f64::NAN;
        Ok(())
    }))
    .unwrap();
    assert_eq!(kind, ErrorKind::Callback);
    assert!(
        message.contains("finite force 2 on shell element 1 at ("),
        "{message}"
    );
    let (kind, message) = solve(law(follower, true, |_, out| {
        if let Some([_, by_velocity]) = &mut out.tangents {
            by_velocity[0][(2, 4)] = f64::INFINITY;
        }
        Ok(())
    }))
    .unwrap();
    assert_eq!(kind, ErrorKind::Callback);
    assert!(
        message.contains("derivative of force 3 on shell element 1"),
        "{message}"
    );
    let (kind, message) = solve(law(follower, false, |_, _| {
        Err(Error::new(ErrorKind::Callback, "no such wind"))
    }))
    .unwrap();
    assert!(
        kind == ErrorKind::Callback && message.contains("no such wind"),
        "{message}"
    );
    let (kind, message) = solve(law(follower, false, |state, out| {
        out.forces[0][2] = state.time;
        Ok(())
    }))
    .unwrap();
    assert!(
        kind == ErrorKind::NotPeriodic && message.contains("force 0"),
        "{message}"
    );
    // Of the phase it is one for any period.
    let mut model = plate();
    let gust = law(follower, false, |state, out| {
        out.forces.fill(Vector6::z() * (50.0 * state.time.sin()));
        Ok(())
    });
    let force = model.add_surface_forces(1, 1, surface, gust).unwrap();
    model.declare_of_phase(force).unwrap();
    let ends = [0.7, 1.4].map(|period| {
        let solution = common::solve(&model, period, 9);
        let mid = solution.node(
            model.node_count() - 1,
            NodeQuantity::Position,
            &[0.25 * period],
        );
        mid.unwrap()[2]
    });
    assert!(
        ends.iter().all(|z| z.abs() > 1e-3) && ends[0] != ends[1],
        "{ends:?}"
    );
}
