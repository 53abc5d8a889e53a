//! Cross-sections, and how they change along a beam element.

use crate::error::{Error, ErrorKind, Result, require_finite};
use nalgebra::Matrix6;
use serde::{Deserialize, Serialize};

/// Properties of a beam's cross-section, per unit of length, in the order
/// `[axial, shear 2, shear 3, torsion, bending 2, bending 3]`; axis 1 is along the beam.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Section {
    /// Stiffness: stress resultants `[force; moment]` for unit strains `[γ; κ]`.
    pub stiffness: Matrix6<f64>,
    /// Mass: momentum for unit section velocity.
    pub mass: Matrix6<f64>,
    /// Damping: stress resultants for unit strain rates.
    pub damping: Matrix6<f64>,
}

impl Section {
    /// The section that lies the fraction `t` of the way from this one to `other`, entry by entry.
    pub fn towards(&self, other: &Section, t: f64) -> Section {
        let between = |a: &Matrix6<f64>, b: &Matrix6<f64>| a + (b - a) * t;
        Section {
            stiffness: between(&self.stiffness, &other.stiffness),
            mass: between(&self.mass, &other.mass),
            damping: between(&self.damping, &other.damping),
        }
    }
}

/// The cross-section along an element: given at places in `[−1, 1]`, linear between neighbours, and
/// constant beyond the first and the last.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Vec<(f64, Section)>", into = "Vec<(f64, Section)>")]
pub struct SectionLine(Vec<(f64, Section)>);

impl From<Section> for SectionLine {
    fn from(section: Section) -> Self {
        SectionLine(vec![(0.0, section)])
    }
}

impl From<SectionLine> for Vec<(f64, Section)> {
    fn from(line: SectionLine) -> Self {
        line.0
    }
}

impl TryFrom<Vec<(f64, Section)>> for SectionLine {
    type Error = Error;

    /// From what a file says, which may be anything.
    fn try_from(places: Vec<(f64, Section)>) -> Result<Self> {
        if places.is_empty() || !places.is_sorted_by(|a, b| a.0 <= b.0) {
            let message = "sections: not at one or more ascending places";
            return Err(Error::new(ErrorKind::Value, message));
        }
        for (place, section) in &places {
            require_finite("section", &[*place])?;
            require_finite("section stiffness", section.stiffness.as_slice())?;
            require_finite("section mass", section.mass.as_slice())?;
            require_finite("section damping", section.damping.as_slice())?;
        }
        Ok(SectionLine(places))
    }
}

impl SectionLine {
    /// From the sections at the element's ends, and at ascending places in between.
    pub fn new(start: Section, inside: &[(f64, Section)], end: Section) -> Self {
        let mut places = vec![(-1.0, start)];
        places.extend_from_slice(inside);
        places.push((1.0, end));
        SectionLine(places)
    }

    /// The section at `xi`.
    pub fn at(&self, xi: f64) -> Section {
        let places = &self.0;
        let next = places.partition_point(|(place, _)| *place < xi);
        if next == 0 {
            return places[0].1;
        }
        let (start, first) = places[next - 1];
        match places.get(next) {
            Some((end, second)) => first.towards(second, (xi - start) / (end - start)),
            None => first,
        }
    }

    /// Whether any section has an entry in the matrix that `which` gives.
    pub fn has(&self, which: impl Fn(&Section) -> &Matrix6<f64>) -> bool {
        self.0.iter().any(|(_, s)| *which(s) != Matrix6::zeros())
    }
}
