//! Forces and moments per unit of a beam's reference length, and of a shell's area or edges.
//!
//! They act on the sections between the nodes, whose motion the element interpolates: the work is
//! done through the section's turn `A Δρ = Σ N_a C_a Δu_a` (see `beam`), so that a node's share of
//! the load `w` is `N_a C_aᵀ μ` with `μ = A⁻¹ w`.

use super::beam::{Beam, about_axis};
use super::line_station::{LineStation, relative_to_first, spread_variation, turned};
use super::shape::{gauss_legendre, shape_functions};
use super::{Contribution, Element, Instant, LoadFrame, NodeState};
use crate::error::{Error, Result};
use crate::motion::{DualMatrix, DualPolar, DualVector, Motion, halves, skew};
use nalgebra::{Matrix3, Vector3, Vector6};
use serde::{Deserialize, Serialize};

/// How the components of a load along a beam are directed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum BeamLoadFrame {
    /// Along the inertial axes.
    Space,
    /// Along the axes of the sections: the load follows them.
    Follower,
    /// As of an untwisted beam: axis 1 along the reference line, axis 2 the part of this direction
    /// that is perpendicular to it in the reference configuration; each section takes these axes
    /// with it.
    Untwisted(Vector3<f64>),
}

impl From<LoadFrame> for BeamLoadFrame {
    fn from(frame: LoadFrame) -> Self {
        match frame {
            LoadFrame::Space => BeamLoadFrame::Space,
            LoadFrame::Follower => BeamLoadFrame::Follower,
        }
    }
}

/// Loads along one beam element, taken together; or on a shell.
///
/// Each acts at one quadrature point for each node, with its integral times the point's Lagrange
/// polynomial, so that however many components and places there are, the beam is interpolated there
/// only.
#[derive(Debug, Clone)]
pub struct DistributedLoad {
    nodes: Vec<usize>,
    /// Frames that are interpolated, in those of the nodes; none if they are these.
    frames: Vec<Motion>,
    stations: Vec<LineStation>,
    /// Where the loads act, from each station, in the axes that the nodes give the section; none if
    /// there.
    arms: Vec<Vector3<f64>>,
    parts: Vec<LoadPart>,
    /// Axes of the load that was added last: many have the same.
    last_axes: Option<(BeamLoadFrame, Vec<Matrix3<f64>>)>,
}

/// One component of a load, where it is not zero all along the element.
#[derive(Debug, Clone)]
struct LoadPart {
    /// Along the inertial axes, not those of the section.
    in_space: bool,
    /// Number of the signal.
    signal: usize,
    /// Force and moment at each station for a signal of 1.
    loads: Vec<Vector6<f64>>,
}

/// What the tangent needs of one node at one station.
#[derive(Debug, Clone)]
pub(super) struct PointTerms {
    pub shape: f64,
    /// Motion of the node relative to the section, `X = RᵀM`.
    pub x: DualMatrix,
    /// Section's turn `T`, and `A Δμ` of the load, for a unit increment of the node.
    pub turn: DualMatrix,
    gain: DualMatrix,
}

impl PointTerms {
    pub fn new(shape: f64, x: DualMatrix, turn: DualMatrix) -> Self {
        let gain = DualMatrix::zeros();
        PointTerms {
            shape,
            x,
            turn,
            gain,
        }
    }
}

/// Tangent of one node's force by one node, summed over the stations.
#[derive(Debug, Clone)]
struct Block {
    /// As a dual matrix, which takes twists to wrenches.
    dual: DualMatrix,
    /// What is not: moments by displacements.
    rest: Matrix3<f64>,
}

impl Block {
    fn zeros() -> Self {
        Block {
            dual: DualMatrix::zeros(),
            rest: Matrix3::zeros(),
        }
    }
}

/// Points of a shell or beam at which loads act, as of a quadrature.
#[derive(Debug, Clone)]
pub(super) struct LoadPoints {
    /// The nodes that move them, and the frames that these carry and that are interpolated.
    pub nodes: Vec<usize>,
    pub frames: Vec<Motion>,
    pub stations: Vec<LineStation>,
    /// Axes of followers, in those that are interpolated.
    pub axes: Vec<Matrix3<f64>>,
    /// Reference areas or lengths that they stand for.
    pub sizes: Vec<f64>,
    /// Places `(ξ, η)`; of a beam `(ξ, 0)`.
    pub places: Vec<[f64; 2]>,
}

impl LoadPoints {
    /// Those along the line of a beam; followers have axes of a frame.
    ///
    /// # Errors
    /// As [`DistributedLoad::new`] and [`DistributedLoad::axes`].
    pub fn along(beam: &Beam, frame: BeamLoadFrame) -> Result<Self> {
        let load = DistributedLoad::new(beam)?;
        let points = gauss_legendre(load.nodes.len()).into_iter();
        Ok(LoadPoints {
            frames: vec![Motion::identity(); load.nodes.len()],
            axes: load.axes(beam, frame)?,
            sizes: lengths(beam, &[(-1.0, 1.0), (1.0, 1.0)])?,
            places: points.map(|(xi, _)| [xi, 0.0]).collect(),
            nodes: load.nodes,
            stations: load.stations,
        })
    }
}

/// Integrals over the reference length of a beam of a factor, linear between places `(ξ, factor)`
/// that ascend, times the Lagrange polynomial of each Gauss point, as many as there are nodes.
fn lengths(beam: &Beam, places: &[(f64, f64)]) -> Result<Vec<f64>> {
    let count = beam.nodes().len();
    let rule = gauss_legendre(count + 1);
    let points: Vec<f64> = gauss_legendre(count).iter().map(|point| point.0).collect();
    let mut lengths = vec![0.0; count];
    for pair in places.windows(2) {
        let ((start, first), (end, second)) = (pair[0], pair[1]);
        let half = 0.5 * (end - start);
        if half <= 0.0 || (first == 0.0 && second == 0.0) {
            continue;
        }
        for (point, weight) in &rule {
            let t = 0.5 * (point + 1.0);
            let xi = start + half * (point + 1.0);
            let factor = first + t * (second - first);
            let length = beam.stretch_at(xi)? * weight * half * factor;
            let shapes = shape_functions(&points, xi);
            for (sum, shape) in lengths.iter_mut().zip(shapes) {
                *sum += shape.0 * length;
            }
        }
    }
    Ok(lengths)
}

/// Scratch for what loads along an element find.
#[derive(Debug, Clone, Default)]
pub(super) struct Scratch {
    /// Motions of the nodes relative to the first.
    relative: Vec<DualMatrix>,
    /// Loads at each station, along the inertial axes and along those that the nodes give the
    /// section.
    loads: Vec<[Vector6<f64>; 2]>,
    pub(super) terms: Vec<PointTerms>,
    /// Row by row.
    blocks: Vec<Block>,
}

impl DistributedLoad {
    /// No load on `beam` yet.
    ///
    /// # Errors
    /// If the beam cannot be evaluated at its quadrature points.
    pub fn new(beam: &Beam) -> Result<Self> {
        let stations = gauss_legendre(beam.nodes().len());
        Ok(DistributedLoad {
            nodes: beam.nodes().to_vec(),
            frames: Vec::new(),
            stations: stations
                .into_iter()
                .map(|(xi, weight)| Ok(beam.station(xi, weight)?.line))
                .collect::<Result<_>>()?,
            arms: Vec::new(),
            parts: Vec::new(),
            last_axes: None,
        })
    }

    /// A load at one place of `beam`, at `offset` from its line along the axes of the section
    /// there, with the signals of `[force; moment]` (`None` is zero).
    ///
    /// # Errors
    /// If the beam cannot be evaluated there.
    pub fn at_place(
        beam: &Beam,
        xi: f64,
        offset: &Vector3<f64>,
        frame: LoadFrame,
        signals: [Option<usize>; 6],
    ) -> Result<Self> {
        let station = beam.station(xi, 0.0)?;
        let axes = about_axis(station.turn);
        let points = LoadPoints {
            nodes: beam.nodes().to_vec(),
            frames: Vec::new(),
            stations: vec![station.line],
            axes: vec![axes],
            sizes: vec![1.0],
            places: vec![[xi, 0.0]],
        };
        let mut load = Self::at_points(points, frame == LoadFrame::Space, signals);
        load.arms.push(axes * offset);
        Ok(load)
    }

    /// Whether there is no load.
    pub fn is_empty(&self) -> bool {
        self.parts.is_empty()
    }

    /// Adds a load of the signals of `[force; moment]` (`None` is zero) times a factor that is
    /// linear between the given places `(ξ, factor)`, which ascend from −1 to 1; two at the same ξ
    /// make a jump.
    ///
    /// # Errors
    /// As [`DistributedLoad::new`].
    pub fn add(
        &mut self,
        beam: &Beam,
        frame: BeamLoadFrame,
        signals: [Option<usize>; 6],
        places: &[(f64, f64)],
    ) -> Result<()> {
        let lengths = lengths(beam, places)?;
        if lengths.iter().all(|&length| length == 0.0) {
            return Ok(());
        }
        let axes = match self.last_axes.take() {
            Some((last, axes)) if last == frame => axes,
            _ => self.axes(beam, frame)?,
        };
        self.add_parts(frame == BeamLoadFrame::Space, signals, &axes, &lengths);
        self.last_axes = Some((frame, axes));
        Ok(())
    }

    /// Adds the components, along `axes` at each station, that stands for so much length or area.
    fn add_parts(
        &mut self,
        in_space: bool,
        signals: [Option<usize>; 6],
        axes: &[Matrix3<f64>],
        sizes: &[f64],
    ) {
        for (component, signal) in signals.into_iter().enumerate() {
            if let Some(signal) = signal {
                let unit = Vector6::ith(component, 1.0);
                let loads = axes.iter().zip(sizes);
                self.parts.push(LoadPart {
                    in_space,
                    signal,
                    loads: loads
                        .map(|(axes, size)| crate::motion::turned(axes, &unit) * *size)
                        .collect(),
                });
            }
        }
    }

    /// Loads at points of a shell, along the inertial axes or along those of the points.
    pub(super) fn at_points(
        points: LoadPoints,
        in_space: bool,
        signals: [Option<usize>; 6],
    ) -> Self {
        let axes = match in_space {
            true => vec![Matrix3::identity(); points.axes.len()],
            false => points.axes,
        };
        let mut load = DistributedLoad {
            nodes: points.nodes,
            frames: points.frames,
            stations: points.stations,
            arms: Vec::new(),
            parts: Vec::new(),
            last_axes: None,
        };
        load.add_parts(in_space, signals, &axes, &points.sizes);
        load
    }

    /// Axes of a load at each station, in those of the section; in the inertial frame if they are
    /// fixed there.
    ///
    /// # Errors
    /// If the direction of an untwisted beam is along its line.
    pub fn axes(&self, beam: &Beam, frame: BeamLoadFrame) -> Result<Vec<Matrix3<f64>>> {
        let points = gauss_legendre(self.nodes.len());
        let turn = |xi: f64| Ok(about_axis(beam.station(xi, 0.0)?.turn));
        let axes = points.into_iter().map(|(xi, _)| match frame {
            BeamLoadFrame::Space => Ok(Matrix3::identity()),
            BeamLoadFrame::Follower => turn(xi),
            BeamLoadFrame::Untwisted(direction) => {
                let line = beam.axes_along_line(xi, &direction)?.ok_or_else(|| {
                    let expected = "a direction across the beam, all along it";
                    Error::value("axis_2", expected, "one along it")
                })?;
                let section = beam.section_motion(xi, beam.reference())?.rotation;
                Ok(turn(xi)? * section.tr_mul(&line))
            }
        });
        axes.collect()
    }

    /// Writes the loads of all parts at each station.
    fn sum(&self, signals: &[f64], loads: &mut Vec<[Vector6<f64>; 2]>) {
        loads.clear();
        loads.resize(self.stations.len(), [Vector6::zeros(); 2]);
        for part in &self.parts {
            let signal = signals[part.signal];
            let axes = usize::from(!part.in_space);
            for (sum, load) in loads.iter_mut().zip(&part.loads) {
                sum[axes] += load * signal;
            }
        }
    }
}

impl Scratch {
    /// Sets the blocks of so many nodes to zero.
    pub(super) fn clear_blocks(&mut self, count: usize) {
        self.blocks.clear();
        self.blocks.resize(count * count, Block::zeros());
    }

    /// Adds the blocks, which are those of `frames` on the nodes, or of these if there are none.
    pub(super) fn add_blocks(&self, frames: &[Motion], count: usize, out: &mut Contribution) {
        for (place, block) in self.blocks.iter().enumerate() {
            let mut k = -block.dual.to_stiffness_matrix();
            let mut moments = k.fixed_view_mut::<3, 3>(3, 0);
            moments += block.rest;
            let (a, b) = (place / count, place % count);
            if let (Some(row), Some(column)) = (frames.get(a), frames.get(b)) {
                let [row, column] = [row, column].map(|frame| frame.inverse().adjoint());
                k = row.tr_mul(&k) * column;
            }
            out.add_stiffness(a, b, &k);
        }
    }

    /// Adds the tangents of a station's load to the blocks, from the terms of the nodes: `mu` is
    /// that of the load, and `space` what the section's turn does to the part that does not turn
    /// with it: `w̃` of a part `w` in the section's axes.
    pub(super) fn add_tangents(&mut self, polar: &DualPolar, mu: &DualVector, space: &DualMatrix) {
        // A Δμ = Δw − ΔA μ. In dual algebra Δw is w̃ Δρ, but for the moment that a force would
        // get by being moved: it moves with the section.
        let by_turn = (polar.factor * *mu).skew() + *space;
        for node in &mut self.terms {
            node.gain = by_turn * node.turn + spread_variation(&node.x, mu) * node.shape;
        }
        let force = space.primal;
        let in_space = force != Matrix3::zeros();
        let count = self.terms.len();
        for ((a, node), row) in self
            .terms
            .iter()
            .enumerate()
            .zip(self.blocks.chunks_exact_mut(count))
        {
            let own = turned(&node.x, mu) * node.shape;
            let turn = node.turn.transpose();
            let lost = turn.primal * force;
            for (other, block) in self.terms.iter().zip(row.iter_mut()) {
                block.dual += own * other.turn + turn * other.gain;
                if in_space {
                    block.rest += lost * other.turn.primal;
                    block.dual.dual -= lost * other.turn.dual;
                }
            }
            row[a].dual = row[a].dual - spread_variation(&node.x, mu) * node.shape;
        }
    }
}

impl Element for DistributedLoad {
    fn nodes(&self) -> &[usize] {
        &self.nodes
    }

    fn evaluate(&self, instant: &Instant, out: &mut Contribution) -> Result<()> {
        // Taken out while `out` is written to.
        let mut scratch = std::mem::take(&mut out.scratch.load);
        let result = self.add_to(instant, &mut scratch, out);
        out.scratch.load = scratch;
        result
    }
}

impl DistributedLoad {
    /// Writes the motions of the interpolated frames relative to the first, and gives that.
    fn start(&self, states: &[NodeState], scratch: &mut Scratch) -> Motion {
        scratch.relative.clear();
        if self.frames.is_empty() {
            let motions = states.iter().map(|state| &state.motion);
            scratch.relative.extend(relative_to_first(motions));
            return states[0].motion;
        }
        let first = states[0].motion.compose(&self.frames[0]);
        let frames = states.iter().zip(&self.frames);
        let relative = frames.map(|(state, frame)| {
            let carried = state.motion.compose(frame);
            first.relative(&carried).to_dual()
        });
        scratch.relative.extend(relative);
        first
    }

    /// A force on a frame as one on its node.
    fn carried(&self, node: usize, force: DualVector) -> DualVector {
        match self.frames.get(node) {
            Some(frame) => frame.to_dual() * force,
            None => force,
        }
    }

    fn add_to(
        &self,
        instant: &Instant,
        scratch: &mut Scratch,
        out: &mut Contribution,
    ) -> Result<()> {
        let states = instant.nodes;
        let first = self.start(states, scratch);
        self.sum(instant.signals, &mut scratch.loads);
        if out.with_tangents {
            scratch.clear_blocks(states.len());
        }
        for (place, station) in self.stations.iter().enumerate() {
            let polar = station.polar(&scratch.relative)?;
            let [space, follower] = &scratch.loads[place];
            let (force, moment) = halves(space);
            let section = first.rotation * polar.rotation.primal;
            let space = DualVector {
                primal: section.tr_mul(&force),
                dual: section.tr_mul(&moment),
            };
            let mut load = space + DualVector::from_wrench(follower);
            let mut turned = space.skew();
            if let Some(arm) = self.arms.get(place) {
                load.dual += arm.cross(&load.primal);
                turned.dual += skew(arm) * turned.primal;
            }
            let mu = polar.spread_inverse * load;
            scratch.terms.clear();
            for (a, (y, shape)) in scratch.relative.iter().zip(station.shapes()).enumerate() {
                let x = polar.rotation.tr_mul(y);
                let c = x.trace_minus_transpose() * shape;
                out.add_force(a, &-self.carried(a, c.transpose() * mu).to_wrench());
                if out.with_tangents {
                    let turn = polar.spread_inverse * c;
                    scratch.terms.push(PointTerms::new(shape, x, turn));
                }
            }
            if out.with_tangents {
                scratch.add_tangents(&polar, &mu, &turned);
            }
        }
        if out.with_tangents {
            scratch.add_blocks(&self.frames, states.len(), out);
        }
        Ok(())
    }
}
