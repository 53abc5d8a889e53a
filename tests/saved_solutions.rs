//! Saved solutions: they come back to the last bit, or not at all.

mod common;

use common::*;
use nalgebra::{Matrix3, Matrix6, Vector3};
use periodyn::elements::*;
use periodyn::error::{Error, ErrorKind};
use periodyn::model::*;
use periodyn::output::*;
use periodyn::solve::*;
use periodyn::system::Standstill;
use std::fs;
use std::path::Path;
use std::sync::Arc;

/// Forged files that are tried.
const ROUNDS: usize = 2000;

/// The loaded four-bar with a body and forces of all kinds; with functions of the user, or without.
fn mechanism(elements: usize, with_functions: bool) -> FourBarModel {
    let bars = FourBar {
        elements,
        loaded: true,
        ..FourBar::default()
    };
    let mut mechanism = bars.build();
    let (b, middle) = (mechanism.b, mechanism.middle);
    let hinge = rotation1(mechanism.joints[0]);
    let model = &mut mechanism.model;
    let at = *model.node(b).unwrap();
    let centre = at.position + Vector3::new(0.02, 0.0, 0.03);
    let body = model.add_rigid_body(0.2, &centre, &(Matrix3::identity() * 1e-3));
    let (first, second) = (Some(b), Some(body.unwrap()));
    let fixed = model.add_joint(JointKind::Rigid, first, second, &at, &at);
    fixed.unwrap();
    let strut = model.add_strut(None, second, &Vector3::new(0.0, 0.0, 3.0), &centre);
    let strut = JointCoordinate {
        joint: strut.unwrap(),
        coordinate: Coordinate::Displacement1,
    };
    let (stiffness, damping) = ([0.3, 0.0, 0.2], [0.1]);
    let spring = model.add_polynomial_spring_damper(strut, &stiffness, &damping, 0.4);
    spring.unwrap();
    let branches = [(2.0, 0.3), (0.5, 4.0)].map(|(stiffness, relaxation_time)| MaxwellBranch {
        stiffness,
        relaxation_time,
    });
    model.add_viscoelastic(hinge, 0.4, 0.1, &branches).unwrap();
    let samples = Signal::samples(0.0, &[0.1, 0.2, -0.3, 0.05]).unwrap();
    model.add_actuator(hinge, &samples).unwrap();
    let matrix = Matrix6::identity() * 0.02;
    model
        .add_viscous_damper(None, second, Some(&at), &matrix)
        .unwrap();
    let mut components = [const { None }; 6];
    components[1] = Some(cosine(0.7));
    let along = DistributedLoadDefinition {
        first_element: mechanism.bars[0],
        elements: 1,
        frame: LoadFrame::Follower.into(),
        components: components.clone(),
        factors: vec![(0.0, 1.0), (1.0, 0.5)],
    };
    model.add_distributed_load(along).unwrap();
    if with_functions {
        let frequency = std::f64::consts::TAU / mechanism.period;
        let wave = move |t: f64| Ok(0.4 * (frequency * t).sin());
        components[1] = Some(Signal::function(Arc::new(wave)));
        model
            .add_load(middle, LoadFrame::Space, components)
            .unwrap();
        let law = CoordinateLaw {
            function: Arc::new(|at| {
                Ok(Effort {
                    value: 0.2 * at.value.sin() + 0.1 * at.rate,
                    ..Effort::default()
                })
            }),
            gives_derivatives: false,
        };
        model.add_coordinate_law(hinge, law).unwrap();
        let law = NodeForceLaw {
            function: Arc::new(|state, out| {
                out.forces[0] = state.velocities[0] * -0.1;
                Ok(())
            }),
            gives_tangents: false,
            frame: LoadFrame::Space,
        };
        model.add_node_forces(&[b], law).unwrap();
    }
    mechanism
}

/// Everything that a solution gives, as bits.
fn everything(solution: &Solution) -> Vec<u64> {
    let model = solution.model();
    let period = solution.grid().period();
    let times: Vec<f64> = match solution.details().march() {
        None => [-0.7, 0.0, 0.31, 0.5, 1.9].map(|t| t * period).into(),
        Some(record) => {
            let end = |time: Option<&f64>| time.copied().unwrap_or(0.0);
            let (first, last) = (end(record.times.first()), end(record.times.last()));
            [0.0, 0.31, 0.5, 0.9, 1.0]
                .map(|part| first + part * (last - first))
                .into()
        }
    };
    let mut bits = Vec::new();
    let mut add = |values: periodyn::error::Result<Vec<f64>>| match values {
        Ok(values) => bits.extend(values.iter().map(|x| x.to_bits())),
        Err(error) => bits.push(error.kind().code() as u64),
    };
    use NodeQuantity::*;
    for node in 0..model.node_count() {
        for quantity in [
            Position,
            RotationMatrix,
            Quaternion,
            Velocity,
            MaterialAcceleration,
        ] {
            add(solution.node(node, quantity, &times));
        }
    }
    use Coordinate::*;
    for joint in 0..model.joint_count() {
        add(solution.joint(joint, JointQuantity::Reaction(ResolvedIn::Second), &times));
        for c in [
            Displacement1,
            Displacement2,
            Displacement3,
            Rotation1,
            Rotation2,
            Rotation3,
        ] {
            add(solution.joint(joint, JointQuantity::Coordinate(c), &times));
            add(solution.joint(joint, JointQuantity::Acceleration(c), &times));
            add(solution.joint(joint, JointQuantity::DrivingEffort(c), &times));
        }
    }
    for element in 0..model.beam_element_count() {
        add(solution.beam(element, 0.3, BeamQuantity::Strain, &times));
        add(solution.beam(element, -1.0, BeamQuantity::Force, &times));
    }
    for force in 0..model.force_count() {
        add(solution.force(force, ForceQuantity::Effort, &times));
        add(solution.force(force, ForceQuantity::BranchEffort(1), &times));
        add(solution.force(force, ForceQuantity::BranchElongation(0), &times));
        for node in 0..model.node_count() {
            add(solution.force(force, ForceQuantity::OnNode(node, LoadFrame::Space), &times));
        }
    }
    let diagnostics = solution.diagnostics();
    add(Ok(diagnostics.harmonics.clone()));
    add(Ok(vec![
        diagnostics.error_estimate,
        diagnostics.between.force,
        diagnostics.between.constraint,
    ]));
    bits
}

fn saved_and_loaded(solution: &Solution) -> Solution {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("solution.pdn");
    solution.save(&path).unwrap();
    Solution::load(&path).unwrap()
}

fn assert_same(loaded: &Solution, solution: &Solution) {
    assert!(everything(loaded) == everything(solution));
    assert_eq!(loaded.report(), solution.report());
    assert_eq!(loaded.outcome(), solution.outcome());
    assert_eq!(
        loaded.details().report.iterations,
        solution.details().report.iterations
    );
}

#[test]
fn a_loaded_solution_is_the_saved_one() {
    let mechanism = mechanism(3, false);
    let solution = mechanism.solve(9);
    let loaded = saved_and_loaded(&solution);
    assert_same(&loaded, &solution);
    // Again, so that nothing is lost on the way.
    assert_same(&saved_and_loaded(&loaded), &solution);

    // The model is whole: it has the same solution.
    let again = solve(loaded.model(), mechanism.period, 9);
    assert!(everything(&again) == everything(&solution));

    // On a finer grid, from the loaded solution and from the saved.
    let grid = periodyn::fourier::TimeGrid::new(15, mechanism.period).unwrap();
    let from = |start: &Solution| {
        let mut options = options(15);
        options.guess = InitialGuess::State(start.prolonged(grid).unwrap());
        Solution::solve(&mechanism.model, mechanism.period, &options, &mut |_, _| {
            true
        })
        .unwrap()
    };
    let (first, second) = (from(&loaded), from(&solution));
    assert_eq!(first.outcome(), Outcome::Converged);
    assert_eq!(first.details().guess_iterations, 0);
    assert!(everything(&first) == everything(&second));
}

#[test]
fn a_loaded_model_has_the_same_solution() {
    let mechanism = mechanism(3, false);
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("model");
    mechanism.model.save(&path).unwrap();
    let loaded = Model::load(&path).unwrap();
    let (wanted, found) = (mechanism.solve(9), solve(&loaded, mechanism.period, 9));
    assert!(everything(&found) == everything(&wanted));
    let error = Solution::load(&path).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Format);

    // Whatever byte is changed is noticed.
    let bytes = fs::read(&path).unwrap();
    for at in (0..bytes.len()).step_by(97) {
        let mut damaged = bytes.clone();
        damaged[at] ^= 0x10;
        fs::write(&path, damaged).unwrap();
        assert_eq!(Model::load(&path).unwrap_err().kind(), ErrorKind::Format);
    }
}

/// A march of the mechanism in steps of 0.01 s.
fn trajectory(
    mechanism: &FourBarModel,
    model: &Model,
    start: MarchStart,
    from: f64,
    duration: f64,
) -> Solution {
    let mut options = MarchOptions::with_step(0.01, MarchEnd::Duration(duration));
    options.period = Some(mechanism.period);
    options.start_time = from;
    options.start = start;
    Solution::march(model, &options, &mut |_, _| true).unwrap()
}

#[test]
fn a_loaded_trajectory_is_the_saved_one_and_goes_on() {
    let mechanism = mechanism(2, false);
    let solution = trajectory(
        &mechanism,
        &mechanism.model,
        MarchStart::Reference,
        0.0,
        0.5,
    );
    assert_eq!(
        solution.outcome(),
        Outcome::Converged,
        "{}",
        solution.report()
    );
    let loaded = saved_and_loaded(&solution);
    assert_same(&loaded, &solution);
    let position = |s: &Solution, t: f64| s.node(3, NodeQuantity::Position, &[t]);
    assert!(position(&solution, 0.25).is_ok() && position(&solution, 0.6).is_err());

    let on = |from: &Solution| {
        let start = MarchStart::State(from.start_state(0.5).unwrap());
        trajectory(&mechanism, from.model(), start, 0.5, 0.1)
    };
    assert!(everything(&on(&loaded)) == everything(&on(&solution)));

    // ParaView shows it like any other.
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("march.pvd");
    loaded.write_vtk(&[0.0, 0.2, 0.5], 5, &path).unwrap();
    assert_eq!(
        fs::read_dir(directory.path().join("march"))
            .unwrap()
            .count(),
        9
    );
    assert!(loaded.write_vtk(&[0.6], 5, &path).is_err());
}

#[test]
fn without_its_functions_a_solution_is_whole_and_its_model_is_not() {
    let mechanism = mechanism(1, true);
    let solution = mechanism.solve(9);
    let loaded = saved_and_loaded(&solution);
    assert_same(&loaded, &solution);
    assert_same(&saved_and_loaded(&loaded), &solution);

    let refused = try_solve(loaded.model(), mechanism.period, 9).unwrap_err();
    assert_eq!(refused.kind(), ErrorKind::Callback);
    assert!(
        refused
            .to_string()
            .contains("the model was loaded from a file, which holds none: bind it again"),
        "{refused}"
    );

    // With the functions it is solved at once.
    let mut options = options(9);
    options.guess = InitialGuess::State(loaded.prolonged(loaded.grid()).unwrap());
    let (model, period) = (&mechanism.model, mechanism.period);
    let again = Solution::solve(model, period, &options, &mut |_, _| true).unwrap();
    assert_eq!(again.outcome(), Outcome::Converged);
    assert_eq!(again.details().report.iterations.len(), 1);
}

#[test]
fn steady_rotations_and_failures_come_back_too() {
    let mut model = Model::new();
    let section = SectionInput::diagonal(&[1e6, 5e5, 5e5, 1e3, 2e3, 2e3], &[1.0, 1e-3, 1e-3, 1e-3]);
    let (origin, tip) = (Vector3::zeros(), Vector3::x() * 2.0);
    let blade = model
        .add_straight_beam(&origin, &tip, &Vector3::y(), &section.unwrap(), 2, 3)
        .unwrap();
    let frame = Model::frame_at("axis", &origin, &Vector3::z()).unwrap();
    let root = Some(blade.first_node);
    model
        .add_joint(JointKind::Rigid, None, root, &frame, &frame)
        .unwrap();
    let push = Signal::function(Arc::new(|t| Ok(3.0 + t)));
    let components = [None, None, Some(push), None, None, None];
    model
        .add_load(blade.last_node, LoadFrame::Follower, components)
        .unwrap();
    let options = StaticOptions {
        standstill: Standstill {
            time: 0.5,
            angular_velocity: Vector3::z() * 7.0,
            ..Standstill::default()
        },
        ..StaticOptions::default()
    };
    let turning = Solution::solve_static(&model, &options, &mut |_, _| true).unwrap();
    assert_eq!(turning.outcome(), Outcome::Converged);
    assert_same(&saved_and_loaded(&turning), &turning);

    let mechanism = mechanism(1, false);
    let (model, period, options) = (&mechanism.model, mechanism.period, common::options(5));
    for limit in [0, 3, 200] {
        let mut calls = 0;
        let mut observe = |_: Stage, _: &Iteration| {
            calls += 1;
            calls <= limit
        };
        let cancelled = Solution::solve(model, period, &options, &mut observe).unwrap();
        assert_same(&saved_and_loaded(&cancelled), &cancelled);
    }
}

/// Loading is refused as of the wrong format, with this in the message.
fn assert_refused(path: &Path, bytes: &[u8], part: &str) {
    fs::write(path, bytes).unwrap();
    let error = Solution::load(path).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Format, "{error}");
    let start = format!("path: \"{}\" ", path.display());
    let message = error.to_string();
    assert!(
        message.starts_with(&start) && message.contains(part),
        "{message}"
    );
}

#[test]
fn damaged_and_foreign_files_are_refused() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("solution.pdn");
    let error = Solution::load(&path).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Io);
    assert!(error.to_string().contains("cannot read"), "{error}");
    assert_eq!(
        Solution::load(directory.path()).unwrap_err().kind(),
        ErrorKind::Io
    );

    mechanism(1, true).solve(3).save(&path).unwrap();
    let good = fs::read(&path).unwrap();
    assert_refused(&path, b"", "is not a saved solution");
    assert_refused(&path, b"t,x\n0,1\n", "is not a saved solution");
    assert_refused(&path, &vec![0; 1 << 20], "is not a saved solution");
    assert_refused(&path, &[&good[..], b"x"].concat(), "goes on after its end");
    let newer = [&good[..8], &4u32.to_le_bytes(), &good[12..]].concat();
    assert_refused(
        &path,
        &newer,
        "version 4 of the format; this library reads up to 3",
    );
    // As long as it gets: nothing is set aside for what is not there.
    let endless = [&good[..16], &u64::MAX.to_le_bytes(), &good[24..]].concat();
    assert_refused(&path, &endless, "is cut off");
    // As text it would have other line ends.
    let as_text: Vec<u8> = good.iter().copied().filter(|b| *b != b'\r').collect();
    assert_refused(&path, &as_text, "is not a saved solution");

    for length in (1..good.len()).step_by(1 + good.len() / 500) {
        assert_refused(
            &path,
            &good[..length],
            if length < 24 { "" } else { "is cut off" },
        );
    }
    for bit in (0..8 * good.len()).step_by(1 + 8 * good.len() / 2000) {
        let mut bytes = good.clone();
        bytes[bit / 8] ^= 1 << (bit % 8);
        assert_refused(&path, &bytes, "");
    }
    fs::write(&path, &good).unwrap();
    Solution::load(&path).unwrap();
    let error = Error::new(ErrorKind::Io, "");
    assert_eq!(error.kind().code(), -300);
}

/// A file of the format with this body, and a checksum that fits.
fn with_body(original: &[u8], body: &[u8]) -> Vec<u8> {
    let mut header = original[..24].to_vec();
    header[16..].copy_from_slice(&(body.len() as u64).to_le_bytes());
    let covered = [&header[8..12], &header[16..], body].concat();
    header[12..16].copy_from_slice(&crc32fast::hash(&covered).to_le_bytes());
    [&header, body].concat()
}

#[test]
fn forged_files_take_neither_memory_nor_stack_out_of_proportion() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("forged.pdn");
    mechanism(1, false).solve(3).save(&path).unwrap();
    let original = fs::read(&path).unwrap();
    // A list of numbers of one byte each, which are read into eight.
    let name = |name: &str| [&[0xa0 | name.len() as u8], name.as_bytes()].concat();
    let count = 8_000_000u32;
    let start = [
        &[0x81],
        &name("prescribed_start")[..],
        &[0xdd],
        &count.to_be_bytes(),
    ]
    .concat();
    let dense = [start, vec![1; count as usize]].concat();
    let what = "values, too many for its 8000023 bytes";
    assert_refused(&path, &with_body(&original, &dense), what);
    // Lists within lists, of a field that is not known and so skipped.
    for depth in [65, 1000, 50_000] {
        let deep = [&[0x81], &name("unknown")[..], &vec![0x91; depth], &[0xc0]].concat();
        let file = with_body(&original, &deep);
        let path = path.clone();
        // Of the least stack that docs/abi.md promises to suffice.
        let least = std::thread::Builder::new().stack_size(256 << 10);
        let thread = least.spawn(move || assert_refused(&path, &file, "depth limit exceeded"));
        thread.unwrap().join().unwrap();
    }
}

/// Files that were changed on purpose, with a checksum that fits: refused, or harmless.
#[test]
fn forged_files_do_no_harm() {
    forge(&mechanism(1, true).solve(3));
}

#[test]
fn forged_trajectories_do_no_harm() {
    let mechanism = mechanism(1, false);
    forge(&trajectory(
        &mechanism,
        &mechanism.model,
        MarchStart::Reference,
        0.0,
        0.04,
    ));
}

fn forge(solution: &Solution) {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("forged.pdn");
    solution.save(&path).unwrap();
    let original = fs::read(&path).unwrap();
    let checked = |body: &[u8]| with_body(&original, body);
    let body = &original[24..];
    assert!(checked(body) == original, "the header is not as described");

    let mut state = 1u64;
    let mut random = |below: usize| {
        state = state
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (state >> 33) as usize % below
    };
    let (mut refused, mut loaded) = (0, 0);
    for round in 0..ROUNDS {
        let mut forged = body.to_vec();
        if round % 5 == 0 {
            forged.truncate(random(body.len()));
        }
        for _ in 0..=random(3) {
            let at = random(forged.len().max(1));
            if let Some(byte) = forged.get_mut(at) {
                *byte = match round % 2 {
                    0 => *byte ^ (1 << random(8)),
                    _ => random(256) as u8,
                };
            }
        }
        fs::write(&path, checked(&forged)).unwrap();
        match Solution::load(&path) {
            Err(error) => {
                assert_eq!(error.kind(), ErrorKind::Format, "{error}");
                refused += 1;
            }
            // Numbers may be absurd; what counts is that no call panics.
            Ok(solution) => {
                everything(&solution);
                solution.report();
                loaded += 1;
            }
        }
    }
    // Both happen, or the test tests nothing.
    assert!(
        refused > ROUNDS / 10 && loaded > ROUNDS / 10,
        "{refused} {loaded}"
    );
}

/// A file that the first version wrote can still be read.
#[test]
fn files_of_version_1_are_read() {
    assert_file_is_read("tests/data/solution_v1.pdn");
}

/// `PDN_BLESS=1` writes it anew.
#[test]
fn files_of_version_2_are_read() {
    let path = "tests/data/solution_v2.pdn";
    if std::env::var_os("PDN_BLESS").is_some() {
        mechanism(1, true).solve(5).save(Path::new(path)).unwrap();
    }
    assert_file_is_read(path);
}

fn assert_file_is_read(path: &str) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(path);
    let mechanism = mechanism(1, true);
    let solution = Solution::load(&path).unwrap();
    assert_eq!(solution.outcome(), Outcome::Converged);
    assert_eq!(
        solution.model().force_count(),
        mechanism.model.force_count()
    );
    // The motor turned with the prescribed angle, whatever computes the rest today.
    let angle = JointQuantity::Coordinate(Coordinate::Rotation1);
    let period = solution.grid().period();
    let turn = four_bar_input(1.0).bind(period);
    for time in solution.grid().times().collect::<Vec<_>>() {
        let found = solution.joint(mechanism.joints[3], angle, &[time]).unwrap()[0];
        assert!(
            (found - turn.value(time).unwrap()).abs() < 1e-9,
            "{time} {found}"
        );
    }
    // And so did the rest: the same model, solved today.
    let today = mechanism.solve(5);
    let positions = |s: &Solution| s.node(mechanism.b, NodeQuantity::Position, &[0.3]).unwrap();
    assert!(largest_difference(&positions(&solution), &positions(&today)) < 1e-9);
}
