//! Beams: elements over nodes, and meshes along a reference line.

use super::stations::{SectionStation, Stations};
use super::{InertiaDefinition, Model, SectionInput, straight_line};
use crate::elements::{Beam, Section, SectionLine, lobatto_points};
use crate::error::{Error, Result};
use crate::memory;
use crate::motion::{Motion, rotation_from_vector};
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Highest polynomial degree of a beam element.
const HIGHEST_DEGREE: usize = 24;

/// A beam element over nodes, whose reference motions tell its shape.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct BeamDefinition {
    /// The nodes, in order along the beam, at its Gauss–Lobatto points.
    pub nodes: Vec<usize>,
    /// Cross-sections along the element.
    #[serde(flatten)]
    pub sections: SectionLine,
    /// Factors of stiffness, mass and damping of all of them.
    #[serde(default = "no_factors")]
    pub factors: [f64; 3],
    /// Angle in a unit of time that its material spins about axis 1 relative to the nodes.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub spin: f64,
}

fn is_zero(number: &f64) -> bool {
    *number == 0.0
}

fn no_factors() -> [f64; 3] {
    [1.0; 3]
}

/// What a meshed beam consists of: its nodes and elements, in order and numbered consecutively.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct BeamIds {
    /// Node at the start.
    pub first_node: usize,
    /// Node at the end.
    pub last_node: usize,
    /// First element.
    pub first_element: usize,
    /// Number of elements.
    pub elements: usize,
}

/// Length of an element for each unit of the distances from node to node: an arc has up to 1.21 of
/// it, with axis 1 within the angle that nodes are allowed.
const LENGTH: std::ops::Range<f64> = 0.8..1.25;

/// Checks that an element is about as long as the way over its nodes. Where these are turned about
/// the line by much it is not: what is interpolated between them runs there and back.
fn require_length(beam: &Beam) -> Result<()> {
    let pairs = beam.reference().windows(2);
    let way: f64 = pairs
        .map(|pair| (pair[1].position - pair[0].position).norm())
        .sum();
    let length = beam.length();
    if LENGTH.contains(&(length / way)) {
        return Ok(());
    }
    let expected = "frames that turn little from each node to the next";
    let got = format!(
        "an element of length {length:.4} over nodes that are {way:.4} apart in all: use more \
         nodes, and for twist stations"
    );
    Err(Error::value("nodes", expected, got))
}

/// Shares of the way from a node to the next at which the mesh is compared with what it stands for:
/// whole turns from the one to the other, which nodes do not tell, show there.
const LOOKED_AT: [f64; 2] = [1.0 / 3.0, 0.5];

/// Checks that the sections of an element over nodes at `points` are directed as they should be
/// between these, too, but for less than a right angle. `frame` gives their fraction of the span
/// and their frames.
fn require_followed(
    beam: &Beam,
    points: &[f64],
    frame: impl Fn(f64) -> Result<(f64, Motion)>,
) -> Result<()> {
    for pair in points.windows(2) {
        for share in LOOKED_AT {
            let xi = pair[0] + share * (pair[1] - pair[0]);
            let (fraction, wanted) = frame(xi)?;
            let own = beam.section_motion(xi, beam.reference())?;
            // One more than twice the cosine of the angle.
            let trace = wanted.rotation.tr_mul(&own.rotation).trace();
            if trace < 1.0 {
                let angle = (0.5 * (trace - 1.0)).max(-1.0).acos().to_degrees();
                let expected = "sections that turn by less than half a turn between nodes";
                let got = format!(
                    "{angle:.0} degrees at fraction {fraction:.6} off what the nodes there tell: \
                     use more elements"
                );
                return Err(Error::value("line", expected, got));
            }
        }
    }
    Ok(())
}

impl Model {
    /// Checks the number of nodes of a beam element.
    pub(crate) fn require_element_size(name: &str, nodes: usize) -> Result<()> {
        if (2..=HIGHEST_DEGREE + 1).contains(&nodes) {
            return Ok(());
        }
        let expected = format!("2 to {} nodes", HIGHEST_DEGREE + 1);
        Err(Error::size(name, expected, nodes))
    }

    /// Checks the numbers that a beam is meshed by.
    pub(crate) fn require_mesh(elements: usize, degree: usize) -> Result<()> {
        const MOST: usize = 1_000_000;
        if !(1..=MOST).contains(&elements) {
            return Err(Error::size("elements", format!("1 to {MOST}"), elements));
        }
        if !(1..=HIGHEST_DEGREE).contains(&degree) {
            let expected = format!("1 to {HIGHEST_DEGREE}");
            return Err(Error::size("degree", expected, degree));
        }
        Ok(())
    }

    /// Adds one beam element over existing nodes, given in order along the beam and placed at its
    /// Gauss–Lobatto points; axis 1 of each node's frame is along the beam. Returns its id.
    ///
    /// Elements may share end nodes: in chains, and where beams branch.
    ///
    /// # Errors
    /// If nodes do not exist, are out of order, or belong to another beam element in a way that
    /// makes the two overlap; if the section is not valid.
    pub fn add_beam_element(&mut self, nodes: &[usize], section: &SectionInput) -> Result<usize> {
        Self::require_element_size("nodes", nodes.len())?;
        self.require_distinct_nodes(nodes)?;
        let section = section.validated()?;
        self.require_not_shared(nodes)?;
        self.place_beam_element(nodes, section.into())?;
        Ok(self.beams.len() - 1)
    }

    fn place_beam_element(&mut self, nodes: &[usize], sections: SectionLine) -> Result<Beam> {
        self.require_axis_along(nodes)?;
        // Between stations they may be too large to be numbers.
        sections.validate()?;
        let nodes = nodes.to_vec();
        let definition = BeamDefinition {
            nodes,
            sections,
            factors: no_factors(),
            spin: 0.0,
        };
        let beam = self.element_of(&definition)?;
        require_length(&beam)?;
        if beam.has_mass() {
            beam.inertia()?;
            self.inertias.push(InertiaDefinition::Beam);
        }
        self.beams.push(definition);
        Ok(beam)
    }

    /// The element of a beam.
    pub(super) fn element_of(&self, beam: &BeamDefinition) -> Result<Beam> {
        let reference = beam.nodes.iter().map(|&n| self.nodes[n]).collect();
        let sections = beam.sections.scaled(&beam.factors);
        let element = Beam::new(beam.nodes.clone(), reference, sections)?;
        Ok(match beam.spin == 0.0 {
            true => element,
            false => element.spinning(beam.spin),
        })
    }

    /// The beam element of this number.
    pub(super) fn beam_element(&self, element: usize) -> Result<Beam> {
        self.element_of(&self.beams[element])
    }

    /// All beam elements.
    ///
    /// # Errors
    /// If a beam is too distorted.
    pub(crate) fn beam_elements(&self) -> Result<Vec<Arc<Beam>>> {
        let elements = self.beams.iter();
        elements
            .map(|beam| Ok(Arc::new(self.element_of(beam)?)))
            .collect()
    }

    /// Checks that axis 1 of each node points along the beam, roughly, as the beam may be curved: a
    /// section turned by mistake would bend where it should stretch.
    fn require_axis_along(&self, nodes: &[usize]) -> Result<()> {
        for pair in nodes.windows(2) {
            let chord = self.nodes[pair[1]].position - self.nodes[pair[0]].position;
            for &node in pair {
                let angle = self.nodes[node]
                    .rotation
                    .column(0)
                    .angle(&chord)
                    .to_degrees();
                if angle > 60.0 {
                    return Err(Error::value(
                        "nodes",
                        "axis 1 of each node's frame along the beam",
                        format!("node {node}, whose axis 1 is {angle:.1} degrees off"),
                    ));
                }
            }
        }
        Ok(())
    }

    /// Checks that a new element over `nodes` shares no more than an end node with each element
    /// that is there, and does not run along it.
    fn require_not_shared(&self, nodes: &[usize]) -> Result<()> {
        let new = self.beams.len();
        let ends = |nodes: &[usize]| (nodes[0], nodes[nodes.len() - 1]);
        let refuse = |node: usize, element: usize, how: &str| {
            let got = format!("node {node}, {how}: elements {element} and {new} would overlap");
            let expected = "nodes that share no more than an end with another beam element";
            Err(Error::value("nodes", expected, got))
        };
        for (element, beam) in self.beams.iter().enumerate() {
            let there = &beam.nodes;
            let end_of_there = ends(there);
            let inner = |nodes: &[usize], node: usize| nodes[1..nodes.len() - 1].contains(&node);
            for &node in nodes {
                if inner(there, node) {
                    return refuse(node, element, &format!("inside beam element {element}"));
                }
                if inner(nodes, node) && (node == end_of_there.0 || node == end_of_there.1) {
                    return refuse(node, element, &format!("an end of beam element {element}"));
                }
            }
            if end_of_there == ends(nodes) {
                let how = format!("where beam element {element} starts, with the same end");
                return refuse(nodes[0], element, &how);
            }
            // Two that leave a node in the same direction, one beyond the other.
            let direction = |from: usize, to: usize| {
                let span = self.nodes[to].position - self.nodes[from].position;
                span.normalize()
            };
            let (a, b) = (end_of_there, ends(nodes));
            let leaving = [(a.0 == b.0, there[1], nodes[1], b.0), {
                let last = |nodes: &[usize]| nodes[nodes.len() - 2];
                (a.1 == b.1, last(there), last(nodes), b.1)
            }];
            for (meet, one, other, node) in leaving {
                if meet && (direction(node, one) - direction(node, other)).norm() < 1e-6 {
                    let how = format!("which beam element {element} leaves in the same direction");
                    return refuse(node, element, &how);
                }
            }
        }
        Ok(())
    }

    /// Meshes a beam along a reference line with `elements` elements of polynomial degree `degree`
    /// (nodes of an element, less one).
    ///
    /// `line` gives, for each fraction of the span from 0 to 1, a frame with axis 1 along the line,
    /// such as [`straight_line`], [`circular_arc`](super::circular_arc) and
    /// [`smooth_curve`](super::smooth_curve) make. Sections and twist are linear in the fraction
    /// between `stations`, which ascend from 0 to 1; two stations at the same fraction make a jump
    /// of the section, where the mesh gets a boundary. One station alone stands for all. Stations
    /// may lie anywhere: elements are integrated from each to the next. Where the slope of section
    /// or twist jumps inside an element, convergence with the degree is slower all the same.
    ///
    /// From each node to the next sections turn by less than half a turn: nodes do not tell more.
    ///
    /// # Errors
    /// If the line, the stations or the numbers of the mesh are not valid; the model is then as it
    /// was.
    pub fn add_beam_along(
        &mut self,
        line: impl Fn(f64) -> Result<Motion>,
        stations: &[SectionStation],
        elements: usize,
        degree: usize,
    ) -> Result<BeamIds> {
        Self::require_mesh(elements, degree)?;
        let stations = Stations::new(stations)?;
        let boundaries = stations.boundaries(elements)?;
        self.mesh_beam(line, &stations, &boundaries, degree)
    }

    /// The same with elements from each of the `boundaries` to the next, fractions from 0 to 1:
    /// those of the stations, for a mesh that follows them, or others. The section jumps at
    /// boundaries only.
    ///
    /// # Errors
    /// If the line, the stations, the boundaries or the degree are not valid; the model is then as
    /// it was.
    pub fn add_beam_between(
        &mut self,
        line: impl Fn(f64) -> Result<Motion>,
        stations: &[SectionStation],
        boundaries: &[f64],
        degree: usize,
    ) -> Result<BeamIds> {
        let stations = Stations::new(stations)?;
        stations.check_boundaries(boundaries)?;
        Self::require_mesh(boundaries.len() - 1, degree)?;
        self.mesh_beam(line, &stations, boundaries, degree)
    }

    fn mesh_beam(
        &mut self,
        line: impl Fn(f64) -> Result<Motion>,
        stations: &Stations,
        boundaries: &[f64],
        degree: usize,
    ) -> Result<BeamIds> {
        let before = (self.nodes.len(), self.beams.len(), self.inertias.len());
        let elements = boundaries.len() - 1;
        let node = size_of::<Motion>() + size_of::<usize>();
        // Lists grow to twice their length at times.
        let bytes = 2 * (degree * node + size_of::<BeamDefinition>() + 3 * size_of::<Section>());
        memory::require_items("nodes and elements of the beam", elements, bytes)?;
        let mesh = |model: &mut Model| -> Result<BeamIds> {
            let frame_at = |fraction: f64| -> Result<Motion> {
                let frame = line(fraction)?;
                let twist = Vector3::x() * stations.twist(fraction);
                let rotation = frame.rotation * rotation_from_vector(&twist);
                Ok(Motion::new(rotation, frame.position))
            };
            let points = lobatto_points(degree + 1);
            let first_node = model.add_node(&frame_at(0.0)?)?;
            let mut previous = first_node;
            for ends in boundaries.windows(2) {
                let (start, end) = (ends[0], ends[1]);
                let fraction = |xi: f64| match xi {
                    1.0 => end,
                    _ => start + 0.5 * (xi + 1.0) * (end - start),
                };
                let mut nodes = vec![previous];
                for pair in points.windows(2) {
                    stations.require_slow_twist(fraction(pair[0]), fraction(pair[1]))?;
                    nodes.push(model.add_node(&frame_at(fraction(pair[1]))?)?);
                }
                let beam = model.place_beam_element(&nodes, stations.over(start, end))?;
                require_followed(&beam, &points, |xi| {
                    Ok((fraction(xi), frame_at(fraction(xi))?))
                })?;
                previous += degree;
            }
            Ok(BeamIds {
                first_node,
                last_node: previous,
                first_element: before.1,
                elements: boundaries.len() - 1,
            })
        };
        let ids = mesh(self);
        if ids.is_err() {
            self.nodes.truncate(before.0);
            self.beams.truncate(before.1);
            self.inertias.truncate(before.2);
        }
        ids
    }

    /// Meshes a straight beam of the same section all along; see [`Model::add_beam_along`].
    pub fn add_straight_beam(
        &mut self,
        start: &Vector3<f64>,
        end: &Vector3<f64>,
        axis_2: &Vector3<f64>,
        section: &SectionInput,
        elements: usize,
        degree: usize,
    ) -> Result<BeamIds> {
        let line = straight_line(start, end, axis_2)?;
        self.add_beam_along(line, &SectionStation::uniform(section), elements, degree)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Matrix3;

    fn section(scale: f64) -> SectionInput {
        SectionInput::diagonal(&[scale; 6], &[scale; 4]).unwrap()
    }

    fn station(fraction: f64, scale: f64, twist: f64) -> SectionStation {
        SectionStation {
            fraction,
            section: section(scale),
            twist,
        }
    }

    /// Nodes along axis 1 at these places.
    fn nodes(places: &[f64]) -> Model {
        let mut model = Model::new();
        for &x in places {
            let motion = Motion::new(Matrix3::identity(), Vector3::x() * x);
            model.add_node(&motion).unwrap();
        }
        model
    }

    #[test]
    fn elements_may_share_ends_but_not_overlap() {
        let mut model = nodes(&[0.0, 1.0, 2.0, 3.0, 4.0]);
        let uniform = section(1.0);
        let mut add = |nodes: &[usize]| {
            let added = model.add_beam_element(nodes, &uniform);
            added.map_err(|e| e.to_string())
        };
        let overlap = |nodes: &str, element: usize, new: usize| {
            format!("{nodes}: elements {element} and {new} would overlap")
        };
        assert_eq!(add(&[0, 1, 2]), Ok(0));
        let inside = add(&[1, 3]).unwrap_err();
        assert!(inside.ends_with(&overlap("node 1, inside beam element 0", 0, 1)));
        assert_eq!(add(&[2, 3]), Ok(1));
        let through = add(&[1, 2, 3]).unwrap_err();
        assert!(
            through.contains("node 1, inside beam element 0"),
            "{through}"
        );
        let twice = add(&[2, 3]).unwrap_err();
        let how = "node 2, where beam element 1 starts, with the same end";
        assert!(twice.ends_with(&overlap(how, 1, 2)), "{twice}");
        let beyond = add(&[2, 4]).unwrap_err();
        let how = "node 2, which beam element 1 leaves in the same direction";
        assert!(beyond.ends_with(&overlap(how, 1, 2)), "{beyond}");
        assert_eq!(add(&[3, 4]), Ok(2));
        let end = add(&[2, 3, 4]).unwrap_err();
        assert!(end.contains("node 3, an end of beam element 1"), "{end}");

        // A branch, and the same pair of ends the other way round as a ring needs them, are
        // allowed.
        let aside = Motion::new(Matrix3::identity(), Vector3::new(3.0, 0.4, 0.0));
        let aside = model.add_node(&aside).unwrap();
        assert_eq!(model.add_beam_element(&[2, aside], &uniform), Ok(3));
    }

    #[test]
    fn a_ring_of_two_half_circles_shares_both_ends() {
        let on = |x: f64| Vector3::new(x.cos(), x.sin(), 0.0);
        let mut model = Model::new();
        let points = lobatto_points(9);
        let mut half = |start: f64, first: Option<usize>, last: Option<usize>| -> Vec<usize> {
            (0..9)
                .map(|i| {
                    let x = start + std::f64::consts::FRAC_PI_2 * (points[i] + 1.0);
                    let along = Vector3::new(-x.sin(), x.cos(), 0.0);
                    let axes = Matrix3::from_columns(&[along, -on(x), Vector3::z()]);
                    match (i, first, last) {
                        (0, Some(node), _) | (8, _, Some(node)) => node,
                        _ => model.add_node(&Motion::new(axes, on(x))).unwrap(),
                    }
                })
                .collect()
        };
        let upper = half(0.0, None, None);
        let lower = half(std::f64::consts::PI, Some(upper[8]), Some(upper[0]));
        assert_eq!(model.add_beam_element(&upper, &section(1.0)), Ok(0));
        assert_eq!(model.add_beam_element(&lower, &section(1.0)), Ok(1));
        let mass = model.mass_and_moment().unwrap().0;
        assert!((mass - std::f64::consts::TAU).abs() < 1e-9, "{mass}");
    }

    #[test]
    fn stations_must_be_in_order_from_end_to_end() {
        let refusal = |stations: &[SectionStation]| match Stations::new(stations) {
            Ok(_) => String::new(),
            Err(error) => error.to_string(),
        };
        let at = |fractions: &[f64]| {
            let stations: Vec<_> = fractions.iter().map(|&f| station(f, 1.0, 0.0)).collect();
            refusal(&stations)
        };
        assert_eq!(at(&[0.0, 0.5, 0.5, 1.0]), "");
        assert_eq!(at(&[0.0]), "");
        assert!(at(&[]).starts_with("stations: expected at least one"));
        assert!(at(&[0.1, 1.0]).starts_with("fractions[0]: expected 0 at the start"));
        assert!(at(&[0.0, 0.9]).starts_with("fractions[1]: expected 1 at the end"));
        assert!(at(&[0.0, 0.6, 0.5, 1.0]).starts_with("fractions[2]: expected at least 0.6"));
        assert!(at(&[0.0, 1.5, 1.0]).starts_with("fractions[2]: expected at least 1.5"));
        assert!(at(&[0.0, f64::NAN, 1.0]).starts_with("fractions[1]: expected a finite"));
        assert!(at(&[0.0, 0.0, 1.0]).starts_with("fractions[1]: expected jumps inside"));
        assert!(at(&[0.0, 1.0, 1.0]).starts_with("fractions[2]: expected jumps inside"));
        assert!(at(&[0.0, 0.5, 0.5, 0.5, 1.0]).starts_with("fractions[3]: expected at most two"));
        let mut stations = [station(0.0, 1.0, 0.3), station(1.0, 1.0, f64::INFINITY)];
        assert!(refusal(&stations).starts_with("twists[1]: expected a finite"));
        stations[1].twist = 0.0;
        stations[1].section.stiffness[(2, 2)] = -1.0;
        assert!(refusal(&stations).starts_with("station 1: section stiffness"));
        let twisted = [
            station(0.0, 1.0, 0.0),
            station(0.5, 1.0, 0.1),
            station(0.5, 2.0, 0.2),
            station(1.0, 1.0, 0.0),
        ];
        assert!(refusal(&twisted).starts_with("twists[2]: expected 0.1"));
    }

    #[test]
    fn sections_are_linear_between_stations_and_jumps_are_element_boundaries() {
        let stations = [
            station(0.0, 1.0, 0.0),
            station(0.2, 3.0, 0.4),
            station(0.4, 2.0, 0.2),
            station(0.4, 5.0, 0.2),
            station(1.0, 8.0, 0.8),
        ];
        let stations = Stations::new(&stations).unwrap();
        assert!(stations.boundaries(1).is_err());
        let close = |a: &[f64], b: &[f64]| {
            assert_eq!(a.len(), b.len());
            assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-15), "{a:?}");
        };
        close(&stations.boundaries(2).unwrap(), &[0.0, 0.4, 1.0]);
        close(&stations.boundaries(3).unwrap(), &[0.0, 0.4, 0.7, 1.0]);
        close(
            &stations.boundaries(5).unwrap(),
            &[0.0, 0.2, 0.4, 0.6, 0.8, 1.0],
        );
        let scale = |line: &SectionLine, xi: f64| line.at(xi).stiffness[(3, 3)];
        let first = stations.over(0.0, 0.4);
        let second = stations.over(0.4, 1.0);
        for (line, xi, exact) in [
            (&first, -1.0, 1.0),
            (&first, -0.5, 2.0),
            (&first, 0.0, 3.0),
            (&first, 1.0, 2.0),
            (&second, -1.0, 5.0),
            (&second, 0.5, 7.25),
            (&second, 1.0, 8.0),
            (&stations.over(0.1, 0.3), -1.0, 2.0),
            (&stations.over(0.1, 0.3), 0.0, 3.0),
            (&stations.over(0.1, 0.3), 1.0, 2.5),
            (&stations.over(0.5, 0.6), 0.0, 5.75),
        ] {
            assert!((scale(line, xi) - exact).abs() < 1e-14, "{xi} {exact}");
        }
        for (fraction, twist) in [(0.0, 0.0), (0.1, 0.2), (0.3, 0.3), (0.4, 0.2), (1.0, 0.8)] {
            assert!((stations.twist(fraction) - twist).abs() < 1e-15);
        }
    }

    #[test]
    fn a_tapered_beam_has_its_mass() {
        let mut model = Model::new();
        let line = straight_line(&Vector3::zeros(), &(Vector3::x() * 3.0), &Vector3::y()).unwrap();
        let stations = [
            station(0.0, 4.0, 0.0),
            station(0.5, 2.0, 0.0),
            station(0.5, 1.0, 0.0),
            station(1.0, 0.0001, 0.0),
        ];
        model.add_beam_along(&line, &stations, 4, 2).unwrap();
        let (mass, moment) = model.mass_and_moment().unwrap();
        assert!(
            (mass - 3.0 * (0.5 * 3.0 + 0.25 * 1.0001)).abs() < 1e-13,
            "{mass}"
        );
        // ∫ (4 − 4 s) s ds to 1/2, and ∫ (1 − 0.9999 (2 s − 1)) s ds from there, times length
        // squared.
        let exact = 9.0 * ((0.5 - 1.0 / 6.0) + (0.375 - 0.9999 * 5.0 / 24.0));
        assert!((moment.x - exact).abs() < 1e-12, "{moment} {exact}");
        // Refused lines leave the model as it was.
        let count = model.node_count();
        let broken = |fraction: f64| {
            let motion = line(fraction)?;
            Ok(if fraction > 0.8 {
                turned_across(&motion)
            } else {
                motion
            })
        };
        assert!(model.add_beam_along(broken, &stations, 4, 2).is_err());
        assert_eq!((model.node_count(), model.beam_element_count()), (count, 4));
    }

    #[test]
    fn elements_lie_between_the_boundaries_that_are_given() {
        let line = straight_line(&Vector3::zeros(), &(Vector3::x() * 3.0), &Vector3::y()).unwrap();
        let stations = [
            station(0.0, 4.0, 0.0),
            station(0.3, 2.0, 0.0),
            station(0.3, 1.0, 0.0),
            station(1.0, 0.5, 0.0),
        ];
        let mut model = Model::new();
        let mut add = |boundaries: &[f64]| {
            let added = model.add_beam_between(&line, &stations, boundaries, 2);
            added.map_err(|e| e.to_string())
        };
        for (boundaries, refusal) in [
            (&[][..], "boundaries: expected at least two"),
            (&[0.1, 0.3, 1.0], "boundaries[0]: expected 0 at the start"),
            (&[0.0, 0.3], "boundaries[1]: expected 1 at the end"),
            (
                &[0.0, 0.3, 0.3, 1.0],
                "boundaries[2]: expected more than 0.3",
            ),
            (&[0.0, f64::NAN, 1.0], "boundaries[1]: expected a finite"),
            (&[0.0, 0.4, 1.0], "boundaries: expected one at 0.3"),
        ] {
            let error = add(boundaries).unwrap_err();
            assert!(error.starts_with(refusal), "{error}");
        }
        let ids = add(&[0.0, 0.1, 0.3, 1.0]).unwrap();
        assert_eq!((ids.first_node, ids.last_node, ids.elements), (0, 6, 3));
        let places: Vec<f64> = [0, 2, 4, 6].map(|n| model.nodes[n].position.x).into();
        assert_eq!(places, [0.0, 3.0 * 0.1, 3.0 * 0.3, 3.0]);
        let (mass, _) = model.mass_and_moment().unwrap();
        let exact = 3.0 * (0.3 * 3.0 + 0.7 * 0.75);
        assert!((mass - exact).abs() < 1e-14 * exact, "{mass} {exact}");
    }

    /// Turned by a right angle: axis 1 is across the line.
    fn turned_across(motion: &Motion) -> Motion {
        let turn = rotation_from_vector(&(Vector3::y() * std::f64::consts::FRAC_PI_2));
        Motion::new(motion.rotation * turn, motion.position)
    }
}
