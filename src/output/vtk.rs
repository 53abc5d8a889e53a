//! Animations for ParaView and other programs that read VTK's XML files.
//!
//! A collection (`.pvd`) lists the times, and for each up to four parts, each a file of its own:
//! beams as lines, bodies and joints as points (`.vtp`), shells as curved quadrilaterals (`.vtu`).

use super::poly_data::{BYTE_ORDER, Cells, DECLARATION, Field, PolyData, escaped};
use super::write::{directory_of, plain, refused, write_file};
use super::{BeamQuantity, JointQuantity, NodeQuantity, ResolvedIn, Solution};
use crate::elements::{Element, NodeState};
use crate::error::{Error, Result, require_finite};
use crate::memory;
use crate::model::InertiaDefinition;
use crate::motion::Motion;
use crate::quantity::{Neighbours, require_station};
use nalgebra::{Matrix3, Vector3};
use std::fs;
use std::io::{self, BufWriter, Write};
use std::path::Path;

/// Most points drawn on one beam element.
const MOST_POINTS: usize = 1000;
/// Bytes that a point takes at a time, at most: a frame, and up to nine vectors, twice.
const DRAWN: usize = 2 * (size_of::<Motion>() + 9 * size_of::<[f64; 3]>());

/// What is drawn of a beam element at one time: points in a row.
struct BeamPoints {
    /// Section frames of each time together.
    frames: Vec<Motion>,
    /// Strains and stress resultants at each point, six components of each time together.
    strains: Vec<Vec<f64>>,
    stresses: Vec<Vec<f64>>,
    /// Of both elements that meet at a point: mean and difference.
    means: Vec<Vec<f64>>,
    jumps: Vec<Vec<f64>>,
}

/// A point with its frame at each time, and vectors that belong to it.
struct DrawnPoint {
    id: usize,
    reference: Motion,
    frames: Vec<Motion>,
    /// Two vectors of each time together.
    vectors: Vec<f64>,
}

impl Solution {
    /// Writes an animation over `times`, which ascend: a collection at `path`, which ends in
    /// `.pvd`, and the files that it lists in a directory beside it, which has its name without the
    /// ending.
    ///
    /// Parts, and what is known at their points:
    ///
    /// * `beams`, a line of `points_per_element` points for each element, with cell data `element`:
    ///   `displacement`, section axes `axis_1` to `axis_3`, `force`, `moment`, `strain`,
    ///   `curvature`, all of the element itself; where two elements meet, `force_mean`,
    ///   `moment_mean` of both, and `force_jump`, `moment_jump` from one to the other, see
    ///   [`BeamQuantity::ForceJump`]; components of all these along the section's axes.
    /// * `bodies`, the nodes that carry a body or belong to no beam or shell: `node`,
    ///   `displacement`, `axis_1` to `axis_3`, `velocity`, `angular_velocity`.
    /// * `joints`, the origins of the joint frames on the second bodies: `joint`, `displacement`,
    ///   `axis_1` to `axis_3` of these frames, `reaction_force`, `reaction_moment`.
    ///
    /// * `shells`, a curved quadrilateral of its own order for each element, with cell data
    ///   `element`: `displacement`, `axis_1` to `axis_3` of the section, resultants `force_1`,
    ///   `moment_1` of the cut across axis 1 and `force_2`, `moment_2`, strains likewise, see
    ///   [`ShellQuantity`](super::ShellQuantity); of isotropic shells `stress_top` and
    ///   `stress_bottom`, each σ11, σ22, σ12, and von Mises' of these.
    ///
    /// All vectors but the internal forces and strains are along the inertial axes.
    ///
    /// # Errors
    /// Times that are not finite or do not ascend, a path that does not end in `.pvd` or whose name
    /// has control characters, a quantity that is too large to be a number,
    /// [`ErrorKind::Io`](crate::error::ErrorKind::Io); then nothing has been written.
    pub fn write_vtk(&self, times: &[f64], points_per_element: usize, path: &Path) -> Result<()> {
        require_finite("times", times)?;
        if times.is_empty() {
            return Err(Error::size("count", "at least one time", 0));
        }
        if let Some(k) = times.windows(2).position(|pair| pair[0] >= pair[1]) {
            let (name, expected) = (format!("times[{}]", k + 1), "a time after the one before");
            return Err(Error::value(&name, expected, times[k + 1]));
        }
        if !(2..=MOST_POINTS).contains(&points_per_element) {
            let expected = format!("2 to {MOST_POINTS}");
            return Err(Error::size(
                "points_per_element",
                expected,
                points_per_element,
            ));
        }
        let names = (
            path.file_stem().and_then(|name| name.to_str()),
            path.extension().and_then(|name| name.to_str()),
        );
        let (Some(stem), Some("pvd")) = names else {
            let got = format!("\"{}\"", path.display());
            return Err(Error::value("path", "a name that ends in .pvd", got));
        };
        let Some(directory) = escaped(stem) else {
            let expected = "a name without control characters";
            return Err(Error::value("path", expected, format!("{stem:?}")));
        };
        let drawn = self.model().beams.len() * points_per_element
            + self.model().nodes.len()
            + self.model().joints.len();
        let on_shells = self.solve.system.shells().iter();
        let on_shells = on_shells
            .map(|shell| 2 * shell.nodes().len())
            .sum::<usize>();
        let drawn = (drawn + on_shells).saturating_mul(times.len());
        memory::require_items("an animation", drawn, DRAWN)?;
        let mut parts = vec![
            ("beams", self.beams_drawn(times, points_per_element)?),
            ("bodies", self.bodies_drawn(times)?),
            ("joints", self.joints_drawn(times)?),
            (SHELLS, self.shells_drawn(times)?),
        ];
        parts.retain(|(_, pieces)| !pieces.is_empty());
        let names: Vec<&str> = parts.iter().map(|part| part.0).collect();
        let written = write_pieces(path, stem, &parts);
        written.map_err(|e| refused("write", path, &e))?;
        write_file(path, |file| {
            write_collection(file, &directory, times, &names)
        })
    }

    /// Motions of a node, as its public quantities tell.
    pub(super) fn node_motions(&self, node: usize, times: &[f64]) -> Result<Vec<Motion>> {
        let positions = self.node(node, NodeQuantity::Position, times)?;
        let rotations = self.node(node, NodeQuantity::RotationMatrix, times)?;
        let pairs = positions.chunks_exact(3).zip(rotations.chunks_exact(9));
        let motion = |(r, axes): (&[f64], &[f64])| {
            let rotation = Matrix3::from_column_slice(axes);
            Motion::new(rotation, Vector3::from_column_slice(r))
        };
        Ok(pairs.map(motion).collect())
    }

    /// Section frames of a beam element at `stations` in `[−1, 1]`; those of each time together.
    ///
    /// # Errors
    /// An unknown element, or a motion that cannot be interpolated.
    pub fn beam_frames(
        &self,
        element: usize,
        stations: &[f64],
        times: &[f64],
    ) -> Result<Vec<Motion>> {
        let mut frames = Vec::with_capacity(stations.len() * times.len());
        let beam = require_station(&self.solve.system, element, 0.0)?;
        let nodes = beam.nodes().iter();
        let nodes: Vec<Vec<Motion>> = nodes
            .map(|&n| self.node_motions(n, times))
            .collect::<Result<_>>()?;
        for k in 0..times.len() {
            let motions: Vec<Motion> = nodes.iter().map(|node| node[k]).collect();
            for &station in stations {
                require_station(&self.solve.system, element, station)?;
                let frame = beam.section_motion(station, &motions);
                frames.push(frame.map_err(|e| e.within(format!("beam element {element}")))?);
            }
        }
        Ok(frames)
    }

    fn beams_drawn(&self, times: &[f64], points: usize) -> Result<Vec<PolyData>> {
        let elements = self.model().beam_element_count();
        if elements == 0 {
            return Ok(Vec::new());
        }
        let last = (points - 1) as f64;
        let stations: Vec<f64> = (0..points).map(|i| 2.0 * i as f64 / last - 1.0).collect();
        let mut reference = Vec::with_capacity(elements * points);
        let mut drawn = Vec::with_capacity(elements);
        let system = &self.solve.system;
        let neighbours = Neighbours::of(system);
        for element in 0..elements {
            let beam = require_station(&self.solve.system, element, 0.0)?;
            for &station in &stations {
                reference.push(beam.section_motion(station, beam.reference())?);
            }
            let each = |quantity: BeamQuantity| -> Result<Vec<Vec<f64>>> {
                let at = |&station: &f64| {
                    let probe = quantity.probe(system, Some(&neighbours), element, station)?;
                    self.sample_probe(&*probe, times)
                };
                stations.iter().map(at).collect()
            };
            drawn.push(BeamPoints {
                frames: self.beam_frames(element, &stations, times)?,
                strains: each(BeamQuantity::Strain)?,
                stresses: each(BeamQuantity::Force)?,
                means: each(BeamQuantity::MeanForce)?,
                jumps: each(BeamQuantity::ForceJump)?,
            });
        }
        let frame_of = |k: usize| {
            let of_beam = |beam: &BeamPoints| beam.frames[k * points..][..points].to_vec();
            let frames: Vec<Motion> = drawn.iter().flat_map(of_beam).collect();
            let half = |six: &dyn Fn(&BeamPoints) -> &[Vec<f64>], first: usize| -> Vec<f64> {
                let of_beam = |beam| six(beam).iter().flat_map(|x| &x[6 * k + first..][..3]);
                drawn.iter().flat_map(of_beam).copied().collect()
            };
            let mut data = frame_data(&reference, &frames);
            data.extend([
                Field::vectors("force", half(&|b| &b.stresses, 0)),
                Field::vectors("moment", half(&|b| &b.stresses, 3)),
                Field::vectors("strain", half(&|b| &b.strains, 0)),
                Field::vectors("curvature", half(&|b| &b.strains, 3)),
                Field::vectors("force_mean", half(&|b| &b.means, 0)),
                Field::vectors("moment_mean", half(&|b| &b.means, 3)),
                Field::vectors("force_jump", half(&|b| &b.jumps, 0)),
                Field::vectors("moment_jump", half(&|b| &b.jumps, 3)),
            ]);
            PolyData {
                positions: positions(&frames),
                cells: Cells::Lines(points),
                point_data: data,
                cell_data: vec![Field::ids("element", 0..elements)],
            }
        };
        Ok((0..times.len()).map(frame_of).collect())
    }

    fn bodies_drawn(&self, times: &[f64]) -> Result<Vec<PolyData>> {
        let model = self.model();
        let mut shown = vec![true; model.nodes.len()];
        let of_beams = model.beams.iter().flat_map(|beam| &beam.nodes);
        for &node in of_beams.chain(model.shells.iter().flat_map(|shell| &shell.nodes)) {
            shown[node] = false;
        }
        for inertia in &model.inertias {
            if let InertiaDefinition::Body { node, .. } = inertia {
                shown[*node] = true;
            }
        }
        let nodes = (0..shown.len()).filter(|&node| shown[node]);
        let drawn = nodes
            .map(|id| {
                Ok(DrawnPoint {
                    id,
                    reference: model.nodes[id],
                    frames: self.node_motions(id, times)?,
                    vectors: self.node(id, NodeQuantity::Velocity, times)?,
                })
            })
            .collect::<Result<Vec<_>>>()?;
        Ok(points_drawn(
            times,
            &drawn,
            "node",
            ["velocity", "angular_velocity"],
        ))
    }

    fn joints_drawn(&self, times: &[f64]) -> Result<Vec<PolyData>> {
        let joints = self.solve.system.joints().iter().enumerate();
        let drawn = joints
            .map(|(id, joint)| {
                let nodes = joint.nodes().iter();
                let nodes: Vec<Vec<Motion>> = nodes
                    .map(|&n| self.node_motions(n, times))
                    .collect::<Result<_>>()?;
                let frame = |motions: &mut dyn Iterator<Item = Motion>| {
                    joint.second_frame(&motions.map(NodeState::at_rest).collect::<Vec<_>>())
                };
                let reference = &self.model().nodes;
                let times_of = 0..times.len();
                Ok(DrawnPoint {
                    id,
                    reference: frame(&mut joint.nodes().iter().map(|&n| reference[n])),
                    frames: times_of
                        .map(|k| frame(&mut nodes.iter().map(|node| node[k])))
                        .collect(),
                    vectors: self.joint(id, JointQuantity::Reaction(ResolvedIn::Space), times)?,
                })
            })
            .collect::<Result<Vec<_>>>()?;
        let names = ["reaction_force", "reaction_moment"];
        Ok(points_drawn(times, &drawn, "joint", names))
    }
}

/// A piece for each time; none if there are no points.
fn points_drawn(
    times: &[f64],
    drawn: &[DrawnPoint],
    id: &'static str,
    names: [&'static str; 2],
) -> Vec<PolyData> {
    if drawn.is_empty() {
        return Vec::new();
    }
    let reference: Vec<Motion> = drawn.iter().map(|point| point.reference).collect();
    let frame_of = |k: usize| {
        let frames: Vec<Motion> = drawn.iter().map(|point| point.frames[k]).collect();
        let half = |first: usize| {
            let of_point = |point: &'_ DrawnPoint| {
                <[f64; 3]>::try_from(&point.vectors[6 * k + first..][..3]).unwrap_or_default()
            };
            drawn.iter().flat_map(of_point).collect()
        };
        let mut data = vec![Field::ids(id, drawn.iter().map(|point| point.id))];
        data.extend(frame_data(&reference, &frames));
        data.extend([
            Field::vectors(names[0], half(0)),
            Field::vectors(names[1], half(3)),
        ]);
        PolyData {
            positions: positions(&frames),
            cells: Cells::Points,
            point_data: data,
            cell_data: Vec::new(),
        }
    };
    (0..times.len()).map(frame_of).collect()
}

pub(super) fn positions(frames: &[Motion]) -> Vec<f64> {
    let coordinates = frames.iter().flat_map(|m| m.position.data.0[0]);
    coordinates.collect()
}

/// Displacements from the reference, and axes.
pub(super) fn frame_data(reference: &[Motion], frames: &[Motion]) -> Vec<Field> {
    let moved = frames.iter().zip(reference);
    let displacement = moved.flat_map(|(m, r)| (m.position - r.position).data.0[0]);
    let mut data = vec![Field::vectors("displacement", displacement.collect())];
    for (column, name) in ["axis_1", "axis_2", "axis_3"].into_iter().enumerate() {
        let axes = frames.iter().flat_map(|m| m.rotation.data.0[column]);
        data.push(Field::vectors(name, axes.collect()));
    }
    data
}

/// The part of curved quadrilaterals, which are no polygonal data.
const SHELLS: &str = "shells";

fn file_name(part: &str, k: usize) -> String {
    let ending = if part == SHELLS { "vtu" } else { "vtp" };
    format!("{part}_{k:06}.{ending}")
}

/// Writes all pieces, of each part one for each time, to a temporary directory, and moves them to
/// that of the collection when all are there.
fn write_pieces(path: &Path, stem: &str, parts: &[(&str, Vec<PolyData>)]) -> io::Result<()> {
    let parent = directory_of(path);
    let temporary = tempfile::Builder::new()
        // Not of its own name, which may be as long as names can be.
        .prefix(".periodyn.")
        .tempdir_in(&parent)
        .map_err(plain)?;
    let mut names = Vec::new();
    for (part, pieces) in parts {
        for (k, piece) in pieces.iter().enumerate() {
            let name = file_name(part, k);
            write_piece(&temporary.path().join(&name), piece)?;
            names.push(name);
        }
    }
    let directory = parent.join(stem);
    match fs::create_dir(&directory) {
        Err(e) if e.kind() == io::ErrorKind::AlreadyExists && directory.is_dir() => {}
        Err(e) if e.kind() == io::ErrorKind::AlreadyExists => {
            let reason = format!(
                "its files go to the directory \"{}\", but that is a file",
                directory.display()
            );
            return Err(io::Error::other(reason));
        }
        other => other?,
    }
    for name in names {
        fs::rename(temporary.path().join(&name), directory.join(&name))?;
    }
    Ok(())
}

fn write_piece(path: &Path, piece: &PolyData) -> io::Result<()> {
    let mut buffer = BufWriter::new(fs::File::create(path)?);
    piece.write(&mut buffer)?;
    buffer.flush()
}

/// The list of files and times, in the format of ParaView's data files.
fn write_collection(
    file: &mut dyn Write,
    directory: &str,
    times: &[f64],
    parts: &[&str],
) -> io::Result<()> {
    writeln!(file, "{DECLARATION}")?;
    writeln!(
        file,
        r#"<VTKFile type="Collection" version="1.0" {BYTE_ORDER}>"#
    )?;
    writeln!(file, "  <Collection>")?;
    for (k, time) in times.iter().enumerate() {
        for (number, part) in parts.iter().enumerate() {
            let name = file_name(part, k);
            let when = format!(r#"timestep="{time:?}" part="{number}" name="{part}""#);
            writeln!(file, r#"    <DataSet {when} file="{directory}/{name}"/>"#)?;
        }
    }
    writeln!(file, "  </Collection>\n</VTKFile>")
}
