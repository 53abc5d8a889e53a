//! Where the next point of a branch is expected (docs/theory.md, section 13.3).

use super::course::{Course, Resultants};
use super::walk::{Place, Walk};
use crate::error::Result;
use std::sync::Arc;

impl Walk<'_> {
    /// The cubic through two places, and how long it is between them.
    pub(super) fn course(&self, from: &Place, to: &Place) -> (Course, f64) {
        // Of an arc, by its chord.
        let away = self.away(&from.state, &to.state);
        let cosine = self.inner(&from.tangent, &to.tangent).clamp(-1.0, 1.0);
        let arc = self.length(&away) * (1.0 + cosine.acos().powi(2) / 24.0);
        let layout = self.newton.equations.layout();
        let ends = [from, to].map(|place| (&place.state, &place.tangent[..]));
        (Course::through(ends[0], ends[1], layout, arc), arc)
    }

    /// Stress resultants at a place, and their rates along the branch, if there are any.
    pub(super) fn resultants_at(&mut self, place: &Place) -> Result<Option<Resultants>> {
        let equations = &mut self.newton.equations;
        if !equations.has_stations() {
            return Ok(None);
        }
        equations.apply_scalars(&place.state)?;
        equations.update_kinematics(&place.state);
        let now = equations.resultants_of_strains()?;
        let mut rates = equations.extrapolated_resultants(&place.tangent)?;
        rates.iter_mut().zip(&now).for_each(|(x, now)| *x -= now);
        Ok(Some(Arc::new([now, rates])))
    }

    /// Takes the geometric stiffness where a step from the present motions leads at the stress
    /// resultants that follow from them along an increment. Those of the strains there are mostly
    /// what beams and shells that turn stretch by terms of higher order.
    pub(super) fn predict_resultants(&mut self, increment: &[f64]) {
        let equations = &mut self.newton.equations;
        if !equations.has_stations() {
            return;
        }
        // Where they cannot be found, as where elements are too distorted, those of strains serve.
        if let Ok(resultants) = equations.extrapolated_resultants(increment) {
            equations.set_resultants(resultants);
        }
    }
}
