//! Solutions in files: tables as CSV, animations for ParaView.

mod common;
#[path = "common/vtk.rs"]
mod vtk;

use common::*;
use nalgebra::{Matrix3, Vector3};
use periodyn::elements::{Coordinate, JointKind, LoadFrame};
use periodyn::error::ErrorKind;
use periodyn::output::*;
use std::fs;
use std::path::Path;
use vtk::Piece;

/// The four-bar, with a body fixed to its node B.
fn mechanism() -> (FourBarModel, Solution) {
    let mut mechanism = FourBar::default().build();
    let model = &mut mechanism.model;
    let at = *model.node(mechanism.b).unwrap();
    let centre = at.position + Vector3::new(0.02, 0.0, 0.03);
    let inertia = Matrix3::identity() * 1e-3;
    let body = model.add_rigid_body(0.2, &centre, &inertia).unwrap();
    let bodies = (Some(mechanism.b), Some(body));
    let fixed = model.add_joint(JointKind::Rigid, bodies.0, bodies.1, &at, &at);
    fixed.unwrap();
    let solution = mechanism.solve(9);
    (mechanism, solution)
}

/// Names in a directory, in order.
fn names(directory: &Path) -> Vec<String> {
    let entries = fs::read_dir(directory).unwrap();
    let mut names: Vec<String> = entries
        .map(|e| e.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

#[test]
fn tables_hold_what_the_solution_gives_to_the_last_bit() {
    let (mechanism, solution) = mechanism();
    let coarse = mechanism.solve(7);
    let times = times(1.3 * mechanism.period, 14);
    let (b, motor, bar) = (mechanism.b, mechanism.joints[3], mechanism.bars[1]);
    let rate = JointQuantity::Rate(Coordinate::Rotation1);
    let reaction = JointQuantity::Reaction(ResolvedIn::First);
    let position = NodeQuantity::Position;
    let mut table = Table::new(&times).unwrap();
    let strain = Quantity::Beam {
        element: bar,
        station: -0.5,
        quantity: BeamQuantity::Strain,
    };
    let quaternion = Quantity::Node(b, NodeQuantity::Quaternion);
    let on_node = ForceQuantity::OnNode(0, LoadFrame::Space);
    for (solution, quantity, label) in [
        (&solution, Quantity::Node(b, position), Some("B, \"left\"")),
        (&coarse, quaternion, None),
        (&solution, Quantity::Joint(motor, rate), None),
        (&solution, Quantity::Joint(motor, reaction), None),
        (&solution, strain, None),
        (&solution, Quantity::Force(0, ForceQuantity::Effort), None),
        (&solution, Quantity::Force(0, on_node), Some("spring")),
    ] {
        table.add(solution, quantity, label).unwrap();
    }
    let own: Vec<f64> = times.iter().map(|t| (1e-30 * t).exp() / 3e-200).collect();
    table.add_values("own", &own).unwrap();

    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("curves.csv");
    table.write_csv(&path).unwrap();
    let mut file = csv::Reader::from_path(&path).unwrap();
    let header: Vec<String> = file.headers().unwrap().iter().map(str::to_owned).collect();
    let mut expected = vec!["t".to_owned()];
    expected.extend(["x", "y", "z"].map(|c| format!("B, \"left\".{c}")));
    expected.extend(["w", "x", "y", "z"].map(|c| format!("node{b}.quaternion.{c}")));
    expected.push(format!("joint{motor}.rotation_1.rate"));
    for part in ["force", "moment"] {
        expected.extend([1, 2, 3].map(|c| format!("joint{motor}.reaction.first.{part}_{c}")));
    }
    let strains = [
        "axial",
        "shear_2",
        "shear_3",
        "twist",
        "curvature_2",
        "curvature_3",
    ];
    expected.extend(strains.map(|c| format!("beam{bar}(-0.5).strain.{c}")));
    expected.push("force0.effort".into());
    for part in ["force", "moment"] {
        expected.extend(["x", "y", "z"].map(|c| format!("spring.{part}_{c}")));
    }
    expected.push("own".into());
    assert_eq!(header, expected);

    let rows: Vec<Vec<f64>> = file
        .records()
        .map(|row| row.unwrap().iter().map(|x| x.parse().unwrap()).collect())
        .collect();
    assert_eq!(rows.len(), times.len());
    let sampled = [
        (3, solution.node(b, position, &times)),
        (4, coarse.node(b, NodeQuantity::Quaternion, &times)),
        (1, solution.joint(motor, rate, &times)),
        (6, solution.joint(motor, reaction, &times)),
        (6, solution.sample(strain, &times)),
        (1, solution.force(0, ForceQuantity::Effort, &times)),
        (6, solution.force(0, on_node, &times)),
        (1, Ok(own)),
    ];
    for (k, row) in rows.iter().enumerate() {
        let mut exact = vec![times[k]];
        for (components, values) in &sampled {
            exact.extend(&values.as_ref().unwrap()[components * k..][..*components]);
        }
        assert_eq!(row, &exact);
    }
}

#[test]
fn what_a_table_refuses_leaves_it_as_it_was() {
    let (mechanism, solution) = mechanism();
    let (b, position) = (mechanism.b, NodeQuantity::Position);
    assert_eq!(Table::new(&[]).unwrap_err().kind(), ErrorKind::Size);
    let error = Table::new(&[0.0, f64::NAN]).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::NotFinite);
    let mut table = Table::new(&[0.0, 1.0]).unwrap();
    table.add_values("p.y", &[1.0, 2.0]).unwrap();
    let error = table
        .add(&solution, Quantity::Node(b, position), Some("p"))
        .unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Value);
    assert!(error.to_string().contains("\"p.y\" again"), "{error}");
    assert!(table.add_values("t", &[1.0, 2.0]).is_err());
    assert!(table.add_values("", &[1.0, 2.0]).is_err());
    let error = table.add_values("q", &[1.0]).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Size);
    let error = table.add_values("q", &[1.0, f64::INFINITY]).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::NotFinite);
    let error = table
        .add(&solution, Quantity::Node(999, position), None)
        .unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Identifier);
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("small.csv");
    table.write_csv(&path).unwrap();
    assert_eq!(
        fs::read_to_string(&path).unwrap(),
        "t,p.y\n0.0,1.0\n1.0,2.0\n"
    );
}

#[test]
fn files_come_whole_or_not_at_all() {
    let mut table = Table::new(&[0.0]).unwrap();
    table.add_values("x", &[1.0]).unwrap();
    let directory = tempfile::tempdir().unwrap();
    let at = |name: &str| directory.path().join(name);

    // A directory that is not there, one in place of the file, no name.
    for path in [at("none/x.csv"), directory.path().to_owned(), "".into()] {
        let error = table.write_csv(&path).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Io);
        let named = format!("path: cannot write \"{}\": ", path.display());
        assert!(error.to_string().starts_with(&named), "{error}");
    }
    // Of reading and writing alike.
    let nowhere = at("none/x.csv");
    let why = "there is no such file or directory";
    let written = table.write_csv(&nowhere).unwrap_err().to_string();
    assert!(written.ends_with(&format!("x.csv\": {why}")), "{written}");
    let read = Solution::load(&nowhere).unwrap_err().to_string();
    assert_eq!(read, written.replace("cannot write", "cannot read"));
    assert!(names(directory.path()).is_empty());

    // What is there is replaced, through a link too, and nothing is left beside it.
    fs::write(at("x.csv"), "old").unwrap();
    table.write_csv(&at("x.csv")).unwrap();
    assert_eq!(fs::read_to_string(at("x.csv")).unwrap(), "t,x\n0.0,1.0\n");
    #[cfg(unix)]
    {
        use std::os::unix::fs::{MetadataExt, symlink};
        fs::write(at("target.csv"), "old").unwrap();
        symlink(at("target.csv"), at("link.csv")).unwrap();
        table.write_csv(&at("link.csv")).unwrap();
        assert!(fs::symlink_metadata(at("link.csv")).unwrap().is_symlink());
        assert_eq!(
            fs::read_to_string(at("target.csv")).unwrap(),
            "t,x\n0.0,1.0\n"
        );
        // What a link leads to is made where it is not there yet.
        symlink("later.csv", at("early.csv")).unwrap();
        table.write_csv(&at("early.csv")).unwrap();
        assert!(fs::symlink_metadata(at("early.csv")).unwrap().is_symlink());
        assert!(fs::symlink_metadata(at("later.csv")).unwrap().is_file());
        symlink("round.csv", at("round.csv")).unwrap();
        let error = table.write_csv(&at("round.csv")).unwrap_err().to_string();
        assert!(error.contains("too many"), "{error}");
        // Names as long as the system allows.
        table.write_csv(&at(&"x".repeat(255))).unwrap();
        // A new file has the permissions of new files.
        fs::File::create(at("plain")).unwrap();
        table.write_csv(&at("new.csv")).unwrap();
        let mode = |name: &str| fs::metadata(at(name)).unwrap().mode();
        assert_eq!(mode("new.csv"), mode("plain"));
        // A device is written to, not replaced.
        table.write_csv(Path::new("/dev/null")).unwrap();
        assert!(!fs::metadata("/dev/null").unwrap().is_file());
        // A disk without room: the file stays as it was.
        if Path::new("/dev/full").exists() {
            let error = table.write_csv(Path::new("/dev/full")).unwrap_err();
            assert_eq!(error.kind(), ErrorKind::Io);
        }
    }
    assert!(
        names(directory.path())
            .iter()
            .all(|name| !name.starts_with('.'))
    );
}

#[test]
fn an_animation_shows_what_the_solution_gives() {
    let (mechanism, solution) = mechanism();
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("four bar & co.pvd");
    const POINTS: usize = 5;
    let times = times(mechanism.period, 4);
    // Written twice: what was there is replaced.
    solution.write_vtk(&times[..2], POINTS, &path).unwrap();
    solution.write_vtk(&times, POINTS, &path).unwrap();

    let files = directory.path().join("four bar & co");
    assert_eq!(
        names(directory.path()),
        ["four bar & co", "four bar & co.pvd"]
    );
    assert_eq!(names(&files).len(), 3 * times.len());
    let list = fs::read_to_string(&path).unwrap();
    assert_eq!(list.matches("<DataSet ").count(), 3 * times.len());
    assert!(list.contains("file=\"four bar &amp; co/beams_000003.vtp\""));
    assert!(list.contains(&format!(
        "timestep=\"{:?}\" part=\"2\" name=\"joints\"",
        times[2]
    )));

    let model = &mechanism.model;
    let elements = model.beam_element_count();
    for (k, time) in times.iter().enumerate() {
        let at = [*time];
        let beams = Piece::read(&files.join(format!("beams_{k:06}.vtp")));
        let points = &beams.points;
        assert_eq!(points.len(), 3 * elements * POINTS);
        assert_eq!((beams.lines, beams.verts), (elements, 0));
        let all: Vec<f64> = (0..elements * POINTS).map(|i| i as f64).collect();
        assert_eq!(beams.connectivity, all);
        let ends: Vec<f64> = (1..=elements).map(|e| (e * POINTS) as f64).collect();
        assert_eq!(beams.offsets, ends);
        let expected: Vec<f64> = (0..elements).map(|e| e as f64).collect();
        assert_eq!(beams.cell_data["element"], expected);
        let names = [
            "axis_1",
            "axis_2",
            "axis_3",
            "force",
            "moment",
            "strain",
            "curvature",
        ];
        let vectors = names.map(|name| beams.at_points(name));
        let displacements = beams.at_points("displacement");
        for element in 0..elements {
            for i in 0..POINTS {
                let station = -1.0 + 2.0 * i as f64 / (POINTS - 1) as f64;
                let at_point = |values: &[f64]| values[3 * (element * POINTS + i)..][..3].to_vec();
                let force = solution
                    .beam(element, station, BeamQuantity::Force, &at)
                    .unwrap();
                let strain = solution
                    .beam(element, station, BeamQuantity::Strain, &at)
                    .unwrap();
                assert_eq!([at_point(vectors[3]), at_point(vectors[4])].concat(), force);
                assert_eq!(
                    [at_point(vectors[5]), at_point(vectors[6])].concat(),
                    strain
                );
                let frame = solution.beam_frames(element, &[station], &at).unwrap()[0];
                assert_eq!(at_point(points), frame.position.as_slice());
                for (axis, drawn) in vectors[..3].iter().enumerate() {
                    let column = frame.rotation.column(axis).into_owned();
                    assert_eq!(at_point(drawn), column.as_slice());
                }
            }
        }
        // Ends of elements are at their nodes: B is the last of bar 1.
        let b = solution
            .node(mechanism.b, NodeQuantity::Position, &at)
            .unwrap();
        let last = 3 * (mechanism.bars[1] * POINTS - 1);
        assert!(largest_difference(&points[last..][..3], &b) < 1e-14);
        let moved = Vector3::from_row_slice(&b) - model.node(mechanism.b).unwrap().position;
        let drawn = &displacements[last..][..3];
        assert!(largest_difference(drawn, moved.as_slice()) < 1e-14);

        let joints = Piece::read(&files.join(format!("joints_{k:06}.vtp")));
        assert_eq!((joints.lines, joints.verts), (0, 5));
        assert_eq!(joints.offsets, [1.0, 2.0, 3.0, 4.0, 5.0]);
        assert_eq!(joints.at_points("joint"), [0.0, 1.0, 2.0, 3.0, 4.0]);
        let positions = &joints.points;
        assert!(largest_difference(&positions[3..6], &b) < 1e-12);
        let (forces, moments) = (
            joints.at_points("reaction_force"),
            joints.at_points("reaction_moment"),
        );
        for joint in 0..5 {
            let space = JointQuantity::Reaction(ResolvedIn::Space);
            let reaction = solution.joint(joint, space, &at).unwrap();
            let drawn = [&forces[3 * joint..][..3], &moments[3 * joint..][..3]].concat();
            assert_eq!(drawn, reaction);
        }
        let bodies = Piece::read(&files.join(format!("bodies_{k:06}.vtp")));
        let ids = bodies.at_points("node");
        assert_eq!(ids, [(model.node_count() - 1) as f64]);
        let velocities = bodies.at_points("velocity");
        let turning = bodies.at_points("angular_velocity");
        for (i, id) in ids.iter().enumerate() {
            let node = *id as usize;
            let exact = solution.node(node, NodeQuantity::Velocity, &at).unwrap();
            let drawn = [&velocities[3 * i..][..3], &turning[3 * i..][..3]].concat();
            assert_eq!(drawn, exact);
        }
    }
}

#[test]
fn what_an_animation_refuses_writes_nothing() {
    let (_, solution) = mechanism();
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("x.pvd");
    let refused = |times: &[f64], points: usize, path: &Path, kind: ErrorKind, part: &str| {
        let error = solution.write_vtk(times, points, path).unwrap_err();
        assert_eq!(error.kind(), kind, "{error}");
        assert!(error.to_string().starts_with(part), "{error}");
        assert!(names(directory.path()).is_empty());
    };
    refused(
        &[],
        5,
        &path,
        ErrorKind::Size,
        "count: expected at least one",
    );
    refused(&[f64::NAN], 5, &path, ErrorKind::NotFinite, "times: ");
    refused(
        &[0.0, 0.0],
        5,
        &path,
        ErrorKind::Value,
        "times[1]: expected a time after",
    );
    refused(
        &[0.0],
        1,
        &path,
        ErrorKind::Size,
        "points_per_element: expected 2 to",
    );
    refused(&[0.0], 1001, &path, ErrorKind::Size, "points_per_element: ");
    let vtk = directory.path().join("x.vtk");
    refused(
        &[0.0],
        5,
        &vtk,
        ErrorKind::Value,
        "path: expected a name that ends in .pvd",
    );
    refused(&[0.0], 5, Path::new(".pvd"), ErrorKind::Value, "path: ");
    let bell = directory.path().join("x\u{7}.pvd");
    let expected = "path: expected a name without control characters";
    refused(&[0.0], 5, &bell, ErrorKind::Value, expected);
    let nowhere = directory.path().join("none").join("x.pvd");
    refused(&[0.0], 5, &nowhere, ErrorKind::Io, "path: cannot write \"");
    // A file where the directory should be.
    fs::write(directory.path().join("x"), "mine").unwrap();
    let error = solution.write_vtk(&[0.0], 5, &path).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Io);
    let why = "x\", but that is a file";
    assert!(error.to_string().ends_with(why), "{error}");
    assert_eq!(names(directory.path()), ["x"]);
}
