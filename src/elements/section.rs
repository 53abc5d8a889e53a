//! Cross-sections, and how they change along a beam element.

use crate::error::{Error, ErrorKind, Result, require_finite};
use crate::motion::{rotation_from_vector, turn_of_both};
use nalgebra::{Matrix6, Vector3};
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

    /// This section with factors of stiffness, mass and damping.
    fn scaled(&self, [stiffness, mass, damping]: &[f64; 3]) -> Section {
        Section {
            stiffness: self.stiffness * *stiffness,
            mass: self.mass * *mass,
            damping: self.damping * *damping,
        }
    }

    /// This section in axes from which its own are turned by `angle` about axis 1.
    pub(super) fn turned(&self, angle: f64) -> Section {
        let both = turn_of_both(&rotation_from_vector(&(Vector3::x() * angle)));
        let turned = |m: &Matrix6<f64>| both * m * both.transpose();
        Section {
            stiffness: turned(&self.stiffness),
            mass: turned(&self.mass),
            damping: turned(&self.damping),
        }
    }
}

/// The cross-section along an element: given at places in `[−1, 1]`, linear between neighbours, and
/// constant beyond the first and the last. So is its twist.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SectionLine {
    #[serde(rename = "sections")]
    places: Vec<(f64, Section)>,
    /// Angle about axis 1 at each place, as part of the reference motions; none at all if empty.
    #[serde(default)]
    twists: Vec<f64>,
}

impl From<Section> for SectionLine {
    fn from(section: Section) -> Self {
        SectionLine {
            places: vec![(0.0, section)],
            twists: Vec::new(),
        }
    }
}

/// Twists this far off a straight line make a corner.
const CORNER: f64 = 1e-12;

impl SectionLine {
    /// The same twist, with this section everywhere.
    pub fn with_section(&self, section: Section) -> Self {
        SectionLine {
            places: self.places.iter().map(|(at, _)| (*at, section)).collect(),
            twists: self.twists.clone(),
        }
    }

    /// From the sections at the element's ends, and at ascending places in between.
    pub fn new(start: Section, inside: &[(f64, Section)], end: Section) -> Self {
        let mut places = vec![(-1.0, start)];
        places.extend_from_slice(inside);
        places.push((1.0, end));
        SectionLine {
            places,
            twists: Vec::new(),
        }
    }

    /// The same with factors of stiffness, mass and damping.
    pub fn scaled(&self, factors: &[f64; 3]) -> Self {
        let mut scaled = self.clone();
        for (_, section) in &mut scaled.places {
            *section = section.scaled(factors);
        }
        scaled
    }

    /// Number of places inside the element, where the slope of the section may jump.
    pub fn inner_places(&self) -> usize {
        self.places.len().saturating_sub(2)
    }

    /// The same with these twists, one for each place, that are part of the reference motions of
    /// the nodes.
    pub fn twisted(self, twists: Vec<f64>) -> Self {
        SectionLine { twists, ..self }
    }

    /// Checks what a file says, which may be anything.
    ///
    /// # Errors
    /// If places are not in order, twists are of another number, or anything is not finite.
    pub fn validate(&self) -> Result<()> {
        if self.places.is_empty() || !self.places.is_sorted_by(|a, b| a.0 <= b.0) {
            let message = "sections: not at one or more ascending places";
            return Err(Error::new(ErrorKind::Value, message));
        }
        for (place, section) in &self.places {
            require_finite("section", &[*place])?;
            require_finite("section stiffness", section.stiffness.as_slice())?;
            require_finite("section mass", section.mass.as_slice())?;
            require_finite("section damping", section.damping.as_slice())?;
        }
        require_finite("twists", &self.twists)?;
        if !self.twists.is_empty() && self.twists.len() != self.places.len() {
            let expected = format!("none, or {}", self.places.len());
            return Err(Error::size("twists", expected, self.twists.len()));
        }
        Ok(())
    }

    /// Whether there is any twist.
    pub(super) fn is_twisted(&self) -> bool {
        self.twists.iter().any(|&twist| twist != 0.0)
    }

    /// Whether twist has a corner inside, which the motions of the nodes cannot follow.
    pub(super) fn has_corners(&self) -> bool {
        let (Some(first), Some(last)) = (self.twists.first(), self.twists.last()) else {
            return false;
        };
        let (start, end) = (self.places[0].0, self.places[self.places.len() - 1].0);
        let off = |(twist, place): (&f64, &(f64, Section))| {
            let t = (place.0 - start) / (end - start);
            (twist - first - (last - first) * t).abs() > CORNER
        };
        self.twists.iter().zip(&self.places).any(off)
    }

    /// Whether sections differ, or turn otherwise than the nodes do.
    pub(super) fn changes(&self) -> bool {
        self.places.iter().any(|(_, s)| *s != self.places[0].1) || self.has_corners()
    }

    /// Ends of the pieces in which all is linear, from −1 to 1.
    pub(super) fn pieces(&self) -> Vec<f64> {
        let inside = self.places.iter().map(|place| place.0);
        let mut ends = vec![-1.0];
        ends.extend(inside.filter(|&xi| xi > -1.0 && xi < 1.0 && self.changes()));
        ends.push(1.0);
        ends.dedup();
        ends
    }

    /// The piece that `xi` is in: the place before, and how far on to the next.
    fn locate(&self, xi: f64) -> (usize, f64) {
        let places = &self.places;
        let next = places.partition_point(|(place, _)| *place < xi);
        match (next.checked_sub(1), places.get(next)) {
            (Some(before), Some((end, _))) => {
                let start = places[before].0;
                (before, (xi - start) / (end - start))
            }
            (Some(before), None) => (before, 0.0),
            (None, _) => (0, 0.0),
        }
    }

    /// The sections at all places.
    pub fn all(&self) -> impl Iterator<Item = &Section> {
        self.places.iter().map(|(_, section)| section)
    }

    /// The section at `xi`, in its own axes.
    pub fn at(&self, xi: f64) -> Section {
        let (before, t) = self.locate(xi);
        match (t > 0.0, self.places.get(before + 1)) {
            (true, Some((_, next))) => self.places[before].1.towards(next, t),
            _ => self.places[before].1,
        }
    }

    /// The twist at `xi`.
    pub fn twist(&self, xi: f64) -> f64 {
        if self.twists.is_empty() {
            return 0.0;
        }
        let (before, t) = self.locate(xi);
        let here = self.twists[before];
        match self.twists.get(before + 1) {
            Some(next) => here + (next - here) * t,
            None => here,
        }
    }

    /// Whether any section has an entry in the matrix that `which` gives.
    pub fn has(&self, which: impl Fn(&Section) -> &Matrix6<f64>) -> bool {
        self.places
            .iter()
            .any(|(_, s)| *which(s) != Matrix6::zeros())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn twist_has_corners_where_it_is_not_linear() {
        let section = Section {
            stiffness: Matrix6::identity(),
            mass: Matrix6::identity(),
            damping: Matrix6::zeros(),
        };
        let line = |twists: [f64; 3]| {
            SectionLine::new(section, &[(0.5, section)], section).twisted(twists.to_vec())
        };
        assert!(!line([0.1, 0.7, 0.9]).has_corners());
        assert!(!line([0.3; 3]).has_corners());
        assert!(line([0.1, 0.6, 0.9]).has_corners());
    }
}
