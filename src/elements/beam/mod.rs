//! Geometrically exact beam of any order (docs/theory.md, section 6.2).
//!
//! Along the beam motions are interpolated exactly as in time: `G(ξ) = Σ N_a M_a`, polar
//! decomposition `G = R S`, and the strain is the "velocity in ξ": `A e = 2 axial(Rᵀ Σ N'_a M_a)`.
//! All of it is dual algebra; twists and wrenches enter as dual vectors.

mod forces;
mod law;
mod material;
mod reference;
mod station;
mod two_nodes;

pub(super) use forces::Scratch;
pub(super) use station::{Station, about_axis};

use super::NodeState;
use super::line_station::relative_to_first;
use super::section::{Section, SectionLine};
use super::shape::{gauss_legendre, lobatto_points, shape_functions};
use crate::error::{Error, Result, require_finite};
use crate::motion::{DualVector, Motion, turned as turn};
use law::{CoupledLaw, LawIntegrals};
use nalgebra::{Matrix6, Vector6};

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
    /// Rate at which its material spins about axis 1 of the sections relative to the nodes.
    spin: f64,
}

/// Lengths that are equal to this, relatively, are: rounding.
const EVEN: f64 = 1e-13;

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
            spin: 0.0,
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

    /// Lets the material spin at this rate about axis 1 of the sections, relative to the nodes. It
    /// must be straight and symmetric about the axis.
    pub fn spinning(mut self, rate: f64) -> Self {
        self.spin = rate;
        for station in &mut self.stations {
            let section = &mut station.section;
            section.stiffness += circulatory(&section.damping, rate);
        }
        if let Some(law) = &mut self.law {
            law.add_circulatory(rate);
        }
        self
    }

    /// Checks what damping adds to its stiffness where its material spins.
    ///
    /// # Errors
    /// If that is too large to be a number.
    pub fn require_finite(&self) -> Result<()> {
        self.stations.iter().try_for_each(|station| {
            let stiffness = station.section.stiffness;
            require_finite("damping times spin", stiffness.as_slice())
        })
    }

    /// How far, relatively, the reference shape is from one that is straight, with axis 1 along it.
    pub fn curvedness(&self) -> f64 {
        let across = |station: &Station| {
            let e = &station.reference;
            let strain = e[1].abs().max(e[2].abs()) / station.stretch;
            strain.max(e[4].abs()).max(e[5].abs())
        };
        self.stations.iter().map(across).fold(0.0, f64::max)
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

    /// Reference motions of the nodes.
    pub fn reference(&self) -> &[Motion] {
        &self.reference
    }

    /// Frame of the section at `xi` in `[−1, 1]`, for the element's nodes at `motions`.
    pub fn section_motion(&self, xi: f64, motions: &[Motion]) -> Result<Motion> {
        let station = self.station(xi, 0.0)?;
        let relative: Vec<_> = relative_to_first(motions.iter()).collect();
        let kinematics = station.line.motion(&relative)?;
        let motion = motions[0].compose(&kinematics.polar.motion());
        let turn = about_axis(station.turn);
        Ok(Motion::new(motion.rotation * turn, motion.position))
    }

    /// Strains `[γ; κ]` per unit of reference length, and stress resultants `[force; moment]`, in
    /// the section's frame at `xi` in `[−1, 1]`, for the element's nodes at `states`.
    ///
    /// Both are the polynomials through those at the Gauss points, where they are most accurate.
    pub fn strain_and_stress(
        &self,
        xi: f64,
        states: &[NodeState],
    ) -> Result<(Vector6<f64>, Vector6<f64>)> {
        let mut scratch = Scratch::default();
        self.find_strains(states, &mut scratch)?;
        let (mut strain, mut stress) = (Vector6::zeros(), Vector6::zeros());
        for (i, shape) in self.shapes_of_gauss_points(xi).iter().enumerate() {
            strain += scratch.strains[i] * (shape.0 / self.stations[i].stretch);
            stress += self.resultants(i, &scratch.strains, &scratch.rates) * shape.0;
        }
        let back = about_axis(-self.station(xi, 0.0)?.turn);
        Ok((turn(&back, &strain), turn(&back, &stress)))
    }

    /// Gives what factors of the strains and resultants at `xi` add up to: those of the increments
    /// of the motion and the velocity of each node.
    pub fn vary_strain_and_stress(
        &self,
        xi: f64,
        states: &[NodeState],
        [by_strain, by_stress]: &[Vector6<f64>; 2],
        mut add: impl FnMut(usize, [Vector6<f64>; 2]),
    ) -> Result<()> {
        let ahead = about_axis(self.station(xi, 0.0)?.turn);
        let (by_strain, by_stress) = (turn(&ahead, by_strain), turn(&ahead, by_stress));
        // By the "velocity in ξ" of each Gauss point, and by its rate.
        let mut by_points = vec![[Vector6::zeros(); 2]; self.stations.len()];
        for (i, shape) in self.shapes_of_gauss_points(xi).iter().enumerate() {
            let station = &self.stations[i];
            by_points[i][0] += by_strain * (shape.0 / station.stretch);
            // Of integrated resultants.
            let by_stress = by_stress * (shape.0 / station.weight);
            let mut add = |j: usize, (stiffness, damping): &(Matrix6<f64>, Matrix6<f64>)| {
                by_points[j][0] += stiffness.tr_mul(&by_stress);
                by_points[j][1] += damping.tr_mul(&by_stress);
            };
            match &self.law {
                Some(law) => (law.row(i).iter().enumerate()).for_each(|(j, law)| add(j, law)),
                None => add(i, &station.own_law()),
            }
        }
        let mut scratch = Scratch::default();
        scratch.begin(states);
        for (station, by) in self.stations.iter().zip(&by_points) {
            self.find_variations(station, states, &mut scratch)?;
            let [by_strain, by_rate] = by.map(|by| DualVector::from_wrench(&by));
            for (local, node) in scratch.variations.iter().enumerate() {
                let spread = node.strain.transpose();
                let by_motion = spread * by_strain + node.rate.transpose() * by_rate;
                add(
                    local,
                    [by_motion.to_wrench(), (spread * by_rate).to_wrench()],
                );
            }
        }
        Ok(())
    }

    /// Shape functions through the Gauss points, at `xi`.
    fn shapes_of_gauss_points(&self, xi: f64) -> Vec<(f64, f64)> {
        let rule = gauss_legendre(self.stations.len());
        let points: Vec<f64> = rule.iter().map(|p| p.0).collect();
        shape_functions(&points, xi)
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
}

/// Stiffness `−s 𝒟 ẽ`, `e` along axis 1: material that spins at the rate `s` sees strains `ε`
/// change by `ε̇ − s ẽ ε`.
fn circulatory(damping: &Matrix6<f64>, rate: f64) -> Matrix6<f64> {
    let mut turn = Matrix6::zeros();
    for i in [0, 3] {
        turn[(i + 2, i + 1)] = rate;
        turn[(i + 1, i + 2)] = -rate;
    }
    -damping * turn
}
