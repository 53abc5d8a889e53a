//! Linear relations between joint coordinates.

use super::{JointCoordinate, Model, Signal};
use crate::elements::Measure;
use crate::error::{Error, Result, require_finite, require_id};
use serde::{Deserialize, Serialize};

/// `Σ aᵢ qᵢ = s(t)` of joint coordinates `qᵢ`, whole turns counted.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct RelationDefinition {
    /// The coordinates, each with its coefficient.
    pub terms: Vec<(JointCoordinate, f64)>,
    /// What their sum is.
    pub signal: Signal,
}

impl RelationDefinition {
    /// What the sum measures once it is divided by the returned number: a length if a displacement
    /// is among the coordinates. Then the largest coefficient of those is 1, else that of all.
    pub(crate) fn unit(&self) -> (Measure, f64) {
        let largest = |measure: Measure| {
            let of = self.terms.iter();
            let of = of.filter(|(at, _)| at.coordinate.measure() == measure);
            of.map(|(_, a)| a.abs()).fold(0.0, f64::max)
        };
        match largest(Measure::Length) {
            0.0 => (Measure::Angle, largest(Measure::Angle)),
            largest => (Measure::Length, largest),
        }
    }

    fn require_valid(&self) -> Result<()> {
        let count = self.terms.len();
        if count < 2 {
            return Err(Error::size("count", "at least 2 coordinates", count));
        }
        for (i, (at, a)) in self.terms.iter().enumerate() {
            let name = format!("coefficients[{i}]");
            require_finite(&name, &[*a])?;
            if *a == 0.0 {
                return Err(Error::value(&name, "a number other than zero", a));
            }
            if self.terms[..i].iter().any(|(other, _)| other == at) {
                let got = format!("{} of joint {} again", at.coordinate, at.joint);
                return Err(Error::value("coordinates", "each at most once", got));
            }
        }
        let unit = self.unit().1;
        let parts = self.terms.iter().map(|(_, a)| a / unit).chain([1.0 / unit]);
        let is_none = |x: f64| !x.is_finite() || x == 0.0;
        if parts.into_iter().any(is_none) {
            let expected = "numbers of comparable size";
            return Err(Error::value("coefficients", expected, unit));
        }
        Ok(())
    }
}

impl Model {
    /// Adds a linear relation `Σ aᵢ qᵢ = s(t)` between joint coordinates, whole turns counted:
    /// gears, belts, racks, differentials. `signal` is `s`; without it the sum stays what it is in
    /// the reference configuration. Returns the relation's id.
    ///
    /// # Errors
    /// If there are fewer than two coordinates, one of them twice, or one that its joint has not;
    /// if a coefficient is zero or not finite.
    pub fn add_relation(
        &mut self,
        terms: &[(JointCoordinate, f64)],
        signal: Option<&Signal>,
    ) -> Result<usize> {
        for (i, (at, _)) in terms.iter().enumerate() {
            let checked = self.require_coordinate(at);
            checked.map_err(|e| e.within(format!("term {i}")))?;
        }
        let mut relation = RelationDefinition {
            terms: terms.to_vec(),
            signal: Signal::constant(0.0)?,
        };
        relation.require_valid()?;
        relation.signal = match signal {
            Some(signal) => signal.clone(),
            None => {
                let values = terms
                    .iter()
                    .map(|(at, a)| a * self.reference_coordinate(at));
                Signal::constant(values.sum()).map_err(|e| e.within("coefficients"))?
            }
        };
        self.place_relation(relation)
    }

    /// Adds a relation of which each coordinate is there.
    pub(super) fn place_relation(&mut self, relation: RelationDefinition) -> Result<usize> {
        relation.require_valid()?;
        self.relations.push(relation);
        Ok(self.relations.len() - 1)
    }

    /// Adds a relation of a file.
    pub(super) fn take_relation(&mut self, relation: RelationDefinition) -> Result<()> {
        let mut terms = relation.terms.iter();
        terms.try_for_each(|(at, _)| self.require_coordinate(at))?;
        self.place_relation(relation).map(|_| ())
    }

    /// Number of relations between joint coordinates.
    pub fn relation_count(&self) -> usize {
        self.relations.len()
    }

    /// The relation of this id.
    ///
    /// # Errors
    /// [`crate::error::ErrorKind::Identifier`].
    pub fn relation(&self, relation: usize) -> Result<&RelationDefinition> {
        require_id("relation", "relation", self.relations.len(), relation)?;
        Ok(&self.relations[relation])
    }
}
