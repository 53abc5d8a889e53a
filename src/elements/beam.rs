//! Geometrically exact beam of any order (docs/theory.md, section 6.2).
//!
//! Along the beam motions are interpolated exactly as in time: `G(ξ) = Σ N_a M_a`, polar
//! decomposition `G = R S`, and the strain is the "velocity in ξ": `A e = 2 axial(Rᵀ Σ N'_a M_a)`.
//! All of it is dual algebra; twists and wrenches enter as dual vectors.

use super::beam_law::{CoupledLaw, LawIntegrals};
use super::inertia::Inertia;
use super::section::{Section, SectionLine};
use super::shape::{gauss_legendre, lobatto_points, shape_functions};
use super::{Contribution, Element, Instant, NodeState, StrainTangent, StressLaw};
use crate::error::{Error, ErrorKind, Result};
use crate::motion::{DualMatrix, DualPolar, DualVector, Motion, rotation_from_vector};
use nalgebra::{DMatrix, Matrix3, Matrix6, Vector3, Vector6};

/// One quadrature point, or any other station, of a beam element.
#[derive(Debug, Clone)]
pub(super) struct Station {
    /// Shape functions and their derivatives in ξ, one pair for each node.
    shapes: Vec<(f64, f64)>,
    /// Quadrature weight in ξ.
    pub weight: f64,
    /// Reference length for each unit of ξ.
    pub stretch: f64,
    /// In the axes that the element's nodes give it.
    section: Section,
    /// Angle by which the section's own axes are turned about axis 1 from these: where twist has a
    /// corner.
    pub turn: f64,
    /// "Velocity in ξ" of the reference configuration.
    reference: Vector6<f64>,
}

/// Kinematics of a station: polar factors, and `G'` in the section's frame.
#[derive(Debug, Clone)]
pub(super) struct StationMotion {
    pub polar: DualPolar,
    q: DualMatrix,
    /// "Velocity in ξ".
    e: DualVector,
}

/// What the tangent needs of one node at one station.
#[derive(Debug, Clone, Copy)]
pub(super) struct NodeTerms {
    shape: (f64, f64),
    /// Motion of the node relative to the section, `X = RᵀM`.
    x: DualMatrix,
    x_axial: DualVector,
    /// `C = tr(X) I − Xᵀ`.
    c: DualMatrix,
    /// Section's turn, strain, and the multipliers `μ`, `ν` for a unit increment of the node.
    pub turn: DualMatrix,
    strain: DualMatrix,
    mu: DualMatrix,
    nu: DualMatrix,
    /// Strain rate, at constant nodal velocities, for a unit increment of the node.
    rate: DualMatrix,
}

/// Elastic and damping forces of one beam element with nodes at the Gauss–Lobatto points.
#[derive(Debug, Clone)]
pub struct Beam {
    nodes: Vec<usize>,
    points: Vec<f64>,
    reference: Vec<Motion>,
    sections: SectionLine,
    damped: bool,
    /// The Gauss points.
    stations: Vec<Station>,
    /// Reference length for each unit of ξ, if it is the same all along.
    even: Option<f64>,
    /// Of all Gauss points, where the section changes; else each has that of its own section.
    law: Option<CoupledLaw>,
}

/// Room for what the element finds at its stations.
#[derive(Debug, Clone, Default)]
pub(super) struct Scratch {
    terms: Vec<NodeTerms>,
    motions: Vec<StationMotion>,
    strains: Vec<Vector6<f64>>,
    rates: Vec<Vector6<f64>>,
}

/// Lengths that are equal to this, relatively, are: rounding.
const EVEN: f64 = 1e-13;

/// A direction with less across a line than this part of it is along that.
const ACROSS: f64 = 1e-9;

/// Quadrature points of a section's flexibility in a piece, more than nodes: it is a rational
/// function of the length.
const FLEXIBILITY_POINTS: usize = 3;

impl Beam {
    /// A beam over `nodes` (two or more, at the Gauss–Lobatto points along the beam), whose
    /// reference shape interpolates the `reference` motions of its nodes, with a [`Section`] that
    /// is the same all along, or changes.
    ///
    /// # Errors
    /// If neighbouring nodes coincide, or the reference shape is too distorted to interpolate.
    pub fn new(
        nodes: Vec<usize>,
        reference: Vec<Motion>,
        sections: impl Into<SectionLine>,
    ) -> Result<Self> {
        let sections = sections.into();
        let count = nodes.len();
        if count < 2 || reference.len() != count {
            return Err(Error::size("nodes", "at least 2 nodes for a beam", count));
        }
        let mut beam = Beam {
            nodes,
            points: lobatto_points(count),
            reference,
            damped: sections.has(|s| &s.damping),
            sections,
            stations: Vec::new(),
            even: None,
            law: None,
        };
        // One point fewer than nodes: no shear locking, no spurious mode.
        beam.stations = gauss_legendre(count - 1)
            .into_iter()
            .map(|(xi, weight)| beam.station(xi, weight))
            .collect::<Result<_>>()?;
        let stretch = beam.stations[0].stretch;
        let mut places = beam.points.iter().map(|&xi| beam.stretch_at(xi));
        if places.all(|here| here.is_ok_and(|x| (x - stretch).abs() <= EVEN * stretch)) {
            beam.even = Some(stretch);
        }
        if beam.sections.changes() {
            beam.law = Some(beam.coupled_law()?);
        }
        Ok(beam)
    }

    /// The law where the section changes: integrated from station to station of the section table.
    fn coupled_law(&self) -> Result<CoupledLaw> {
        let count = self.nodes.len();
        let mut integrals = LawIntegrals::new(gauss_legendre(count - 1));
        for (xi, weight) in self.pieces(count + FLEXIBILITY_POINTS) {
            let station = self.station(xi, weight)?;
            integrals.add(xi, &station.section, station.stretch, weight)?;
        }
        integrals.law()
    }

    /// Quadrature points and weights, so many from each station of the section table to the next.
    fn pieces(&self, points: usize) -> Vec<(f64, f64)> {
        let rule = gauss_legendre(points);
        let ends = self.sections.pieces();
        let piece = |ends: &[f64]| {
            let (middle, half) = (0.5 * (ends[0] + ends[1]), 0.5 * (ends[1] - ends[0]));
            rule.iter()
                .map(move |(x, weight)| (middle + half * x, half * weight))
                .collect::<Vec<_>>()
        };
        ends.windows(2).flat_map(piece).collect()
    }

    /// Reference motions of the nodes without their twist.
    fn untwisted(&self, node: usize) -> Motion {
        let twist = Vector3::x() * -self.sections.twist(self.points[node]);
        let motion = &self.reference[node];
        Motion::new(
            motion.rotation * rotation_from_vector(&twist),
            motion.position,
        )
    }

    /// Frame in which the section at `xi` is described, in the reference configuration, without and
    /// with its twist.
    fn reference_frames(&self, xi: f64) -> Result<(Motion, Motion)> {
        let station = Station::bare(shape_functions(&self.points, xi));
        let first = self.untwisted(0);
        let line = station.motion(|a| first.relative(&self.untwisted(a)))?;
        let line = first.compose(&line.polar.motion());
        let twist = rotation_from_vector(&(Vector3::x() * self.sections.twist(xi)));
        let section = Motion::new(line.rotation * twist, line.position);
        Ok((line, section))
    }

    /// Axes at `xi` in the reference configuration: axis 1 along the line, axis 2 the part of
    /// `direction` that is perpendicular to it. None if it has no such part.
    pub(super) fn axes_along_line(
        &self,
        xi: f64,
        direction: &Vector3<f64>,
    ) -> Result<Option<Matrix3<f64>>> {
        // Of moderate length, whatever it was given.
        let direction = direction / direction.amax();
        let along: Vector3<f64> = self.reference_frames(xi)?.0.rotation.column(0).into();
        let across = direction - along * along.dot(&direction);
        if across.norm() <= ACROSS * direction.norm() {
            return Ok(None);
        }
        let across = across.normalize();
        let axes = [along, across, along.cross(&across)];
        Ok(Some(Matrix3::from_columns(&axes)))
    }

    /// The station at `xi`, with this weight.
    pub(super) fn station(&self, xi: f64, weight: f64) -> Result<Station> {
        let mut station = Station {
            weight,
            section: self.sections.at(xi),
            ..Station::bare(shape_functions(&self.points, xi))
        };
        let kinematics = station.motion(|a| self.reference[0].relative(&self.reference[a]))?;
        station.reference = kinematics.e.to_twist();
        station.stretch = self.stretch_at(xi)?;
        if self.sections.has_corners() {
            let own = self.reference_frames(xi)?.1.rotation;
            let given = self.reference[0].compose(&kinematics.polar.motion());
            let turn = given.rotation.tr_mul(&own);
            station.turn = (turn[(2, 1)] - turn[(1, 2)]).atan2(turn[(1, 1)] + turn[(2, 2)]);
            station.section = station.section.turned(station.turn);
        }
        let span = self
            .reference
            .iter()
            .map(|m| (m.position - self.reference[0].position).norm())
            .fold(0.0, f64::max);
        if station.stretch <= 1e-9 * span {
            return Err(Error::new(
                ErrorKind::Value,
                "nodes: a beam element needs nodes at distinct positions, in order along the beam",
            ));
        }
        Ok(station)
    }

    /// Reference length for each unit of ξ at `xi`: that of the line, whatever twist does to its
    /// interpolation.
    ///
    /// # Errors
    /// If the reference shape is too distorted there.
    pub fn stretch_at(&self, xi: f64) -> Result<f64> {
        if let Some(stretch) = self.even {
            return Ok(stretch);
        }
        let station = Station::bare(shape_functions(&self.points, xi));
        let line = if self.sections.is_twisted() {
            let first = self.untwisted(0);
            station.motion(|a| first.relative(&self.untwisted(a)))?
        } else {
            station.motion(|a| self.reference[0].relative(&self.reference[a]))?
        };
        Ok(line.e.to_twist().fixed_rows::<3>(0).norm())
    }

    /// Length of the reference line.
    pub fn length(&self) -> f64 {
        self.stations.iter().map(|s| s.weight * s.stretch).sum()
    }

    /// Sections along the element.
    pub fn sections(&self) -> &SectionLine {
        &self.sections
    }

    /// The section half-way along the element.
    pub fn middle_section(&self) -> Section {
        self.sections.at(0.0)
    }

    /// Whether its sections have mass.
    pub fn has_mass(&self) -> bool {
        self.sections.has(|s| &s.mass)
    }

    /// The element's inertia, integrated by one quadrature point for each node from station to
    /// station of the section table.
    ///
    /// Nodal velocities are first carried to the section's reference frame, then interpolated, so
    /// that the matrix is constant and a rigid motion has exact inertia.
    pub fn inertia(&self) -> Result<Inertia> {
        let count = self.nodes.len();
        let mut mass = DMatrix::zeros(6 * count, 6 * count);
        for (xi, weight) in self.pieces(count) {
            let station = self.station(xi, weight)?;
            let section = if self.sections.is_twisted() {
                self.reference_frames(xi)?.1
            } else {
                let relative =
                    station.motion(|a| self.reference[0].relative(&self.reference[a]))?;
                self.reference[0].compose(&relative.polar.motion())
            };
            let carry: Vec<Matrix6<f64>> = self
                .reference
                .iter()
                .zip(&station.shapes)
                .map(|(node, shape)| section.relative(node).adjoint() * shape.0)
                .collect();
            let length = weight * station.stretch;
            let own = self.sections.at(xi).mass;
            for a in 0..count {
                let left = carry[a].transpose() * own * length;
                for (b, right) in carry.iter().enumerate() {
                    let mut block = mass.fixed_view_mut::<6, 6>(6 * a, 6 * b);
                    block += left * right;
                }
            }
        }
        Ok(Inertia::consistent(
            self.nodes.clone(),
            mass,
            &self.reference,
        ))
    }

    /// Reference motions of the nodes.
    pub fn reference(&self) -> &[Motion] {
        &self.reference
    }

    /// Frame of the section at `xi` in `[−1, 1]`, for the element's nodes at `motions`.
    pub fn section_motion(&self, xi: f64, motions: &[Motion]) -> Result<Motion> {
        let station = self.station(xi, 0.0)?;
        let kinematics = station.motion(|a| motions[0].relative(&motions[a]))?;
        let motion = motions[0].compose(&kinematics.polar.motion());
        let turn = rotation_from_vector(&(Vector3::x() * station.turn));
        Ok(Motion::new(motion.rotation * turn, motion.position))
    }

    /// Strains `[γ; κ]` per unit of reference length, and stress resultants `[force; moment]`, in
    /// the section's frame at `xi` in `[−1, 1]`, for the element's nodes at `motions` with
    /// `twists`.
    ///
    /// Both are the polynomials through those at the Gauss points, where they are most accurate.
    pub fn strain_and_stress(
        &self,
        xi: f64,
        motions: &[Motion],
        twists: &[Vector6<f64>],
    ) -> Result<(Vector6<f64>, Vector6<f64>)> {
        let mut room = Scratch::default();
        let states: Vec<NodeState> = motions
            .iter()
            .zip(twists)
            .map(|(motion, twist)| NodeState {
                twist: *twist,
                ..NodeState::at_rest(*motion)
            })
            .collect();
        for station in &self.stations {
            room.terms.clear();
            let at = room.add_terms(station, &states)?;
            room.strains.push(at.e.to_twist() - station.reference);
            room.rates
                .push(strain_rate(&room.terms, &states).to_twist());
        }
        let points: Vec<f64> = gauss_legendre(self.stations.len())
            .iter()
            .map(|p| p.0)
            .collect();
        let (mut strain, mut stress) = (Vector6::zeros(), Vector6::zeros());
        for (i, shape) in shape_functions(&points, xi).iter().enumerate() {
            strain += room.strains[i] * (shape.0 / self.stations[i].stretch);
            stress += self.resultants(i, &room.strains, &room.rates) * shape.0;
        }
        let turn = self.station(xi, 0.0)?.turn;
        let own = |v: &Vector6<f64>| turned_about_axis(v, -turn);
        Ok((own(&strain), own(&stress)))
    }

    /// Stress resultants at Gauss point `i`, for all "velocities in ξ" less those of the reference,
    /// and their rates.
    fn resultants(
        &self,
        i: usize,
        strains: &[Vector6<f64>],
        rates: &[Vector6<f64>],
    ) -> Vector6<f64> {
        let station = &self.stations[i];
        match &self.law {
            Some(law) => law.resultants(i, strains, rates) / station.weight,
            None => {
                let section = &station.section;
                (section.stiffness * strains[i] + section.damping * rates[i]) / station.stretch
            }
        }
    }

    /// Reference length from the element's start to `xi`.
    pub fn length_to(&self, xi: f64) -> Result<f64> {
        let half = 0.5 * (xi + 1.0);
        if let Some(stretch) = self.even {
            return Ok(2.0 * half * stretch);
        }
        // A smooth integrand, exact for straight elements; two points more for curved ones.
        gauss_legendre(self.nodes.len() + 2)
            .into_iter()
            .map(|(x, weight)| Ok(weight * half * self.stretch_at(half * (x + 1.0) - 1.0)?))
            .sum()
    }

    /// Where a share, from 0 to 1, of the reference length is reached.
    pub fn xi_at(&self, share: f64) -> Result<f64> {
        if share <= 0.0 || share >= 1.0 || self.even.is_some() {
            return Ok(2.0 * share.clamp(0.0, 1.0) - 1.0);
        }
        let length = self.length_to(1.0)? * share;
        let mut xi = 2.0 * share - 1.0;
        for _ in 0..20 {
            let change = (self.length_to(xi)? - length) / self.stretch_at(xi)?;
            xi = (xi - change).clamp(-1.0, 1.0);
            if change.abs() < 1e-14 {
                break;
            }
        }
        Ok(xi)
    }
}

/// A turn about axis 1.
pub(super) fn about_axis(angle: f64) -> Matrix3<f64> {
    rotation_from_vector(&(Vector3::x() * angle))
}

/// A 6-vector of a section in axes that are turned by `angle` about axis 1.
fn turned_about_axis(v: &Vector6<f64>, angle: f64) -> Vector6<f64> {
    let turn = about_axis(angle);
    let (first, second) = (v.fixed_rows::<3>(0), v.fixed_rows::<3>(3));
    let (first, second) = (turn * first, turn * second);
    Vector6::new(first.x, first.y, first.z, second.x, second.y, second.z)
}

/// `ė = Σ B_a V_a`.
fn strain_rate(terms: &[NodeTerms], states: &[NodeState]) -> DualVector {
    let mut rate = DualVector::zeros();
    for (node, state) in terms.iter().zip(states) {
        rate += node.strain * DualVector::from_twist(&state.twist);
    }
    rate
}

impl Scratch {
    /// Appends the terms of a station.
    fn add_terms(&mut self, station: &Station, states: &[NodeState]) -> Result<StationMotion> {
        let relative = |a: usize| states[0].motion.relative(&states[a].motion);
        let at = station.motion(relative)?;
        self.terms.extend(station.node_terms(&at, relative));
        Ok(at)
    }
}

impl Station {
    /// Shape functions alone.
    fn bare(shapes: Vec<(f64, f64)>) -> Self {
        Station {
            shapes,
            weight: 0.0,
            stretch: 0.0,
            section: Section {
                stiffness: Matrix6::zeros(),
                mass: Matrix6::zeros(),
                damping: Matrix6::zeros(),
            },
            turn: 0.0,
            reference: Vector6::zeros(),
        }
    }

    /// Strain, for the "velocity in ξ" `e`.
    fn strain(&self, e: &DualVector) -> Vector6<f64> {
        (e.to_twist() - self.reference) / self.stretch
    }

    /// Stiffness and damping of the resultants, integrated.
    fn own_law(&self) -> (Matrix6<f64>, Matrix6<f64>) {
        let factor = self.weight / self.stretch;
        (
            self.section.stiffness * factor,
            self.section.damping * factor,
        )
    }

    /// Kinematics, for node motions given relative to some common frame.
    pub fn motion(&self, relative: impl Fn(usize) -> Motion) -> Result<StationMotion> {
        let mut g = DualMatrix::zeros();
        let mut g_prime = DualMatrix::zeros();
        for (a, shape) in self.shapes.iter().enumerate() {
            let y = relative(a).to_dual();
            g += y * shape.0;
            g_prime += y * shape.1;
        }
        let polar = polar_factors(&g)?;
        let q = polar.rotation.tr_mul(&g_prime);
        let e = polar.spread_inverse * (q.axial() * 2.0);
        Ok(StationMotion { polar, q, e })
    }

    /// Shape functions.
    pub fn shapes(&self) -> impl Iterator<Item = f64> + '_ {
        self.shapes.iter().map(|shape| shape.0)
    }

    /// Polar factors alone, for node motions `relative` to some common frame.
    pub fn polar(&self, relative: &[DualMatrix]) -> Result<DualPolar> {
        let mut g = DualMatrix::zeros();
        for (y, shape) in relative.iter().zip(self.shapes()) {
            g += *y * shape;
        }
        polar_factors(&g)
    }

    /// First variations: section turn `A Δρ = Σ N_a C_a Δu_a` and strain
    /// `A Δe = Σ (N'_a C_a + N_a (2 e x_aᵀ − X_a ẽ)) Δu_a + ((S e)~ − tr(Q) I + Q) Δρ`.
    pub fn node_terms<'a>(
        &'a self,
        at: &'a StationMotion,
        relative: impl Fn(usize) -> Motion + 'a,
    ) -> impl Iterator<Item = NodeTerms> + 'a {
        let a_inverse = at.polar.spread_inverse;
        let turn_to_strain = at.turn_to_strain();
        let e_skew = at.e.skew();
        self.shapes.iter().enumerate().map(move |(a, &shape)| {
            let x = at.polar.rotation.tr_mul(&relative(a).to_dual());
            let x_axial = x.axial();
            let c = x.trace_minus_transpose();
            let turn = a_inverse * c * shape.0;
            let direct = c * shape.1 + (at.e.outer(&x_axial) * 2.0 - x * e_skew) * shape.0;
            NodeTerms {
                shape,
                x,
                x_axial,
                c,
                turn,
                strain: a_inverse * (direct + turn_to_strain * turn),
                mu: DualMatrix::zeros(),
                nu: DualMatrix::zeros(),
                rate: DualMatrix::zeros(),
            }
        })
    }
}

fn polar_factors(g: &DualMatrix) -> Result<DualPolar> {
    DualPolar::new(g).ok_or_else(|| {
        Error::new(
            ErrorKind::Model,
            "a beam element turns by more than its order can follow: use more or shorter elements",
        )
    })
}

impl StationMotion {
    /// `P = (S e)~ − tr(Q) I + Q`.
    fn turn_to_strain(&self) -> DualMatrix {
        (self.polar.factor * self.e).skew() - self.q.trace_minus()
    }
}

/// `2 w xᵀ − X w̃` with `x = axial(X)`: the part of `−ΔA w` that a node's own increment causes.
pub(super) fn spread_variation(x: &DualMatrix, w: &DualVector) -> DualMatrix {
    w.outer(&x.axial()) * 2.0 - *x * w.skew()
}

/// `2 w xᵀ − (X w)~`: the part of `ΔCᵀ w` that the section's turn causes; a node's own increment
/// causes minus its [`spread_variation`].
pub(super) fn turned(x: &DualMatrix, w: &DualVector) -> DualMatrix {
    w.outer(&x.axial()) * 2.0 - (*x * *w).skew()
}

/// Second variation of `σᵀ Δe` at constant `σ` (docs/theory.md, section 6.4): fills `mu` and `nu`
/// of every node and returns `(μ, ν)`.
///
/// With `μ = A⁻¹ σ` and `ν = A⁻¹ Pᵀ μ`, a node's force is
/// `N' Cᵀ μ + N (Cᵀ ν + 2 (μᵀe) x + ẽ Xᵀ μ)`; its variation needs those of `μ`, `ν`, `e` and `ρ`.
fn adjoint_variations(
    at: &StationMotion,
    stress: &DualVector,
    nodes: &mut [NodeTerms],
) -> (DualVector, DualVector) {
    let a_inverse = at.polar.spread_inverse;
    let s = at.polar.factor;
    let p_transposed = at.turn_to_strain().transpose();
    let mu = a_inverse * *stress;
    let nu = a_inverse * (p_transposed * mu);
    let (mu_skew, e_skew) = (mu.skew(), at.e.skew());
    let s_mu = (s * mu).skew();
    // Part of A Δν that comes through the section's turn.
    let nu_by_turn = mu_skew * (s * at.e).skew() + (s * nu).skew()
        - mu.outer(&at.q.axial()) * 2.0
        - at.q.transpose() * mu_skew;
    let mu_s = mu_skew * s;
    for node in nodes {
        let (n, n_prime) = node.shape;
        node.mu = a_inverse * (s_mu * node.turn + spread_variation(&node.x, &mu) * n);
        let x_mu = (node.x.transpose() * mu).skew();
        let direct = (mu.outer(&node.x_axial) * 2.0 + x_mu) * n_prime
            + (spread_variation(&node.x, &nu) - mu_skew * (node.x * e_skew)) * n;
        node.nu = a_inverse
            * (nu_by_turn * node.turn + direct + mu_s * node.strain + p_transposed * node.mu);
    }
    (mu, nu)
}

/// Geometric stiffness, block by block: passed to `add(a, b, block)`.
///
/// Increments of two nodes commute, so that blocks on both sides of the diagonal are transposes of
/// each other.
fn geometric_stiffness(
    at: &StationMotion,
    (mu, nu): (&DualVector, &DualVector),
    nodes: &[NodeTerms],
    mut add: impl FnMut(usize, usize, &Matrix6<f64>),
) {
    let e_skew = at.e.skew();
    let mu_e = mu.dot(&at.e);
    let mu_skew = mu.skew();
    for (a, node) in nodes.iter().enumerate() {
        let (n, n_prime) = node.shape;
        let c_transposed = node.c.transpose();
        let x_transposed = node.x.transpose();
        let x_mu = (x_transposed * *mu).skew();
        let by_mu =
            c_transposed * n_prime + (node.x_axial.outer(&at.e) * 2.0 + e_skew * x_transposed) * n;
        let by_nu = c_transposed * n;
        let by_strain = (node.x_axial.outer(mu) * 2.0 - x_mu) * n;
        let by_turn = turned(&node.x, mu) * n_prime
            + (turned(&node.x, nu)
                - node.x.trace_minus() * mu_e
                - e_skew * (x_transposed * mu_skew))
                * n;
        for (b, other) in nodes.iter().enumerate().skip(a) {
            let block = by_mu * other.mu
                + by_nu * other.nu
                + by_strain * other.strain
                + by_turn * other.turn;
            if a == b {
                let own = (node.c * mu_e + e_skew * x_mu - spread_variation(&node.x, nu)) * n
                    - spread_variation(&node.x, mu) * n_prime;
                add(a, a, &(block + own).to_stiffness_matrix());
            } else {
                let block = block.to_stiffness_matrix();
                add(a, b, &block);
                add(b, a, &block.transpose());
            }
        }
    }
}

/// Variation of the strain rate `ė = Σ B_a V_a` at constant nodal velocities (docs/theory.md,
/// section 6.5): fills `rate`.
fn rate_variations(
    at: &StationMotion,
    rate: &DualVector,
    twists: impl Fn(usize) -> DualVector,
    nodes: &mut [NodeTerms],
) {
    let a_inverse = at.polar.spread_inverse;
    let (s, e) = (at.polar.factor, at.e);
    let p = at.turn_to_strain();
    let e_skew = e.skew();
    let mut omega = DualVector::zeros();
    for (a, node) in nodes.iter().enumerate() {
        omega += node.turn * twists(a);
    }
    let omega_skew = omega.skew();

    // Sums over the nodes of what multiplies Δρ and Δe.
    let mut omega_by_turn = (s * omega).skew();
    let mut rate_by_turn = (s * *rate).skew() + (at.q * omega).skew()
        - omega.outer(&at.q.axial()) * 2.0
        - omega_skew * (s * e).skew();
    let mut rate_by_strain = -(omega_skew * s);
    for (a, node) in nodes.iter().enumerate() {
        let (n, n_prime) = node.shape;
        let v = twists(a);
        let c_by_turn = v.outer(&node.x_axial) * 2.0 + node.x.transpose() * v.skew();
        omega_by_turn += c_by_turn * n;
        let ev = e_skew * v;
        let half = node.x.trace_minus().transpose() * v;
        rate_by_turn += c_by_turn * n_prime - (e.outer(&half) + (node.x * ev).skew()) * n;
        let xv = node.x_axial.dot(&v);
        let mut double = DualMatrix::zeros();
        double.primal.fill_diagonal(2.0 * xv.primal);
        double.dual.fill_diagonal(2.0 * xv.dual);
        rate_by_strain += (double + node.x * v.skew()) * n;
    }
    for (b, node) in nodes.iter_mut().enumerate() {
        let (n, n_prime) = node.shape;
        let v = twists(b);
        let c_own = -(v.outer(&node.x_axial) * 2.0 + (node.x.transpose() * v).skew());
        let omega_variation = a_inverse
            * (omega_by_turn * node.turn + (spread_variation(&node.x, &omega) + c_own) * n);
        let own_rate = e.outer(&(node.c.transpose() * v)) + node.x * (e_skew * v).skew();
        let direct = (c_own + spread_variation(&node.x, &omega)) * n_prime
            + (spread_variation(&node.x, rate) + own_rate + omega_skew * node.x * e_skew) * n;
        node.rate = a_inverse
            * (direct
                + rate_by_turn * node.turn
                + rate_by_strain * node.strain
                + p * omega_variation);
    }
}

impl Element for Beam {
    fn nodes(&self) -> &[usize] {
        &self.nodes
    }

    fn has_damping(&self) -> bool {
        self.damped
    }

    fn stress_laws(&self) -> Vec<StressLaw> {
        if let Some(law) = &self.law {
            return law.stress_laws();
        }
        let own = |station: &Station| {
            let (stiffness, damping) = station.own_law();
            StressLaw {
                stiffness,
                damping,
                others: Vec::new(),
            }
        };
        self.stations.iter().map(own).collect()
    }

    fn extrapolate_resultants(
        &self,
        nodes: &[NodeState],
        increments: &[[Vector6<f64>; 2]],
        out: &mut [Vector6<f64>],
    ) -> Result<()> {
        let (mut strains, mut rates) = (Vec::new(), Vec::new());
        let mut terms = Vec::new();
        for station in &self.stations {
            let relative = |a: usize| nodes[0].motion.relative(&nodes[a].motion);
            let twist = |a: usize| DualVector::from_twist(&nodes[a].twist);
            let at = station.motion(relative)?;
            terms.clear();
            terms.extend(station.node_terms(&at, relative));
            let (mut e, mut rate) = (at.e, DualVector::zeros());
            for (a, (node, [motion, velocity])) in terms.iter().zip(increments).enumerate() {
                e += node.strain * DualVector::from_twist(motion);
                rate += node.strain * (twist(a) + DualVector::from_twist(velocity));
            }
            if self.damped {
                let present = strain_rate(&terms, nodes);
                rate_variations(&at, &present, twist, &mut terms);
                for (node, [motion, _]) in terms.iter().zip(increments) {
                    rate += node.rate * DualVector::from_twist(motion);
                }
            }
            strains.push(e.to_twist() - station.reference);
            rates.push(rate.to_twist());
        }
        for (i, resultants) in out.iter_mut().enumerate() {
            *resultants = self.resultants(i, &strains, &rates);
        }
        Ok(())
    }

    fn add_forces_of_resultants(
        &self,
        nodes: &[NodeState],
        resultants: &[Vector6<f64>],
        out: &mut Contribution,
    ) -> Result<()> {
        let mut room = std::mem::take(&mut out.beam);
        for (station, resultants) in self.stations.iter().zip(resultants) {
            room.terms.clear();
            room.add_terms(station, nodes)?;
            add_forces(&room.terms, &(resultants * station.weight), out);
        }
        out.beam = room;
        Ok(())
    }

    fn evaluate(&self, instant: &Instant, out: &mut Contribution) -> Result<()> {
        // Taken out while `out` is written to.
        let mut room = std::mem::take(&mut out.beam);
        let result = match &self.law {
            Some(law) => self.add_coupled(law, instant, &mut room, out),
            None => self.add_stations(instant, &mut room, out),
        };
        out.beam = room;
        result
    }
}

/// Whether strain rates matter, and whether they vary with the motion.
#[derive(Debug, Clone, Copy)]
struct Damping {
    damped: bool,
    rates_vary: bool,
}

impl Beam {
    fn damping(&self, states: &[NodeState]) -> Damping {
        let moves = states.iter().any(|state| state.twist != Vector6::zeros());
        Damping {
            damped: self.damped,
            rates_vary: self.damped && moves,
        }
    }

    /// Forces and tangents where each station has its own law.
    fn add_stations(
        &self,
        instant: &Instant,
        room: &mut Scratch,
        out: &mut Contribution,
    ) -> Result<()> {
        let states = instant.nodes;
        let damping = self.damping(states);
        for (place, station) in self.stations.iter().enumerate() {
            room.terms.clear();
            let at = room.add_terms(station, states)?;
            let section = &station.section;
            let mut stress = section.stiffness * station.strain(&at.e);
            let mut rate = DualVector::zeros();
            if self.damped {
                rate = strain_rate(&room.terms, states);
                stress += section.damping * (rate.to_twist() / station.stretch);
            }
            let stress = stress * station.weight;
            add_forces(&room.terms, &stress, out);
            if !out.with_tangents {
                continue;
            }
            let held = instant.resultants.get(place);
            let held = held.map_or(stress, |resultants| resultants * station.weight);
            add_geometric_stiffness(&at, &held, &mut room.terms, out);
            if damping.rates_vary {
                let twist = |a: usize| DualVector::from_twist(&states[a].twist);
                rate_variations(&at, &rate, twist, &mut room.terms);
            }
            add_material_stiffness(&room.terms, &[station.own_law()], &room.terms, damping, out);
        }
        Ok(())
    }

    /// Forces and tangents where resultants depend on the strains of all stations.
    fn add_coupled(
        &self,
        law: &CoupledLaw,
        instant: &Instant,
        room: &mut Scratch,
        out: &mut Contribution,
    ) -> Result<()> {
        let (states, count) = (instant.nodes, self.nodes.len());
        let damping = self.damping(states);
        room.terms.clear();
        room.motions.clear();
        room.strains.clear();
        room.rates.clear();
        for (place, station) in self.stations.iter().enumerate() {
            let at = room.add_terms(station, states)?;
            let rate = strain_rate(&room.terms[place * count..], states);
            room.strains.push(at.e.to_twist() - station.reference);
            room.rates.push(rate.to_twist());
            room.motions.push(at);
        }
        for (place, station) in self.stations.iter().enumerate() {
            let stress = law.resultants(place, &room.strains, &room.rates);
            let terms = &mut room.terms[place * count..][..count];
            add_forces(terms, &stress, out);
            if !out.with_tangents {
                continue;
            }
            let held = instant.resultants.get(place);
            let held = held.map_or(stress, |resultants| resultants * station.weight);
            let at = &room.motions[place];
            add_geometric_stiffness(at, &held, terms, out);
            if damping.rates_vary {
                let rate = DualVector::from_twist(&room.rates[place]);
                let twist = |a: usize| DualVector::from_twist(&states[a].twist);
                rate_variations(at, &rate, twist, terms);
            }
        }
        if out.with_tangents {
            for (place, rows) in room.terms.chunks_exact(count).enumerate() {
                add_material_stiffness(rows, law.row(place), &room.terms, damping, out);
            }
        }
        Ok(())
    }
}

/// Adds the forces of integrated resultants.
fn add_forces(terms: &[NodeTerms], stress: &Vector6<f64>, out: &mut Contribution) {
    let stress = DualVector::from_wrench(stress);
    for (a, node) in terms.iter().enumerate() {
        out.add_force(a, &(node.strain.transpose() * stress).to_wrench());
    }
}

/// Adds the geometric stiffness of integrated resultants.
fn add_geometric_stiffness(
    at: &StationMotion,
    stress: &Vector6<f64>,
    terms: &mut [NodeTerms],
    out: &mut Contribution,
) {
    let (mu, nu) = adjoint_variations(at, &DualVector::from_wrench(stress), terms);
    geometric_stiffness(at, (&mu, &nu), terms, |a, b, block| {
        out.add_stiffness(a, b, block);
    });
}

/// Adds `K_ab = B_aᵀ Σ (S B_b + D R_b)` and `C_ab = B_aᵀ Σ D B_b`, sums over the stations that the
/// `laws` of this one are of, whose `columns` follow each other; or puts `B` and `R` aside, if they
/// are wanted apart.
fn add_material_stiffness(
    rows: &[NodeTerms],
    laws: &[(Matrix6<f64>, Matrix6<f64>)],
    columns: &[NodeTerms],
    Damping { damped, rates_vary }: Damping,
    out: &mut Contribution,
) {
    if out.with_resultants_apart {
        out.strains.extend(rows.iter().map(|node| StrainTangent {
            strain: node.strain,
            rate: node.rate,
        }));
        return;
    }
    let count = rows.len();
    // All transposed.
    for b in 0..count {
        let (mut by_motion, mut by_velocity) = (Matrix6::zeros(), Matrix6::zeros());
        for ((stiffness, damping), columns) in laws.iter().zip(columns.chunks_exact(count)) {
            let column = &columns[b];
            column.strain.add_product_to(stiffness, &mut by_motion);
            if rates_vary {
                column.rate.add_product_to(damping, &mut by_motion);
            }
            if damped {
                column.strain.add_product_to(damping, &mut by_velocity);
            }
        }
        let (by_motion, by_velocity) = (by_motion.transpose(), by_velocity.transpose());
        for (a, row) in rows.iter().enumerate() {
            let mut k = Matrix6::zeros();
            row.strain.add_product_to(&by_motion, &mut k);
            out.add_stiffness(a, b, &k.transpose());
            if damped {
                let mut c = Matrix6::zeros();
                row.strain.add_product_to(&by_velocity, &mut c);
                out.add_damping(a, b, &c.transpose());
            }
        }
    }
}
