//! What lies between two points of a branch, located along the arc (docs/theory.md, section 13.5).

use super::Event;
use super::walk::{Place, Stepped, Walk};
use crate::collocation::{Antiperiodic, Spectral};
use crate::error::Result;

/// Most points on the way to an event.
const MOST: usize = 30;
/// Length of what is left to search, over the step, that is none.
const NARROW: f64 = 1e-14;
/// Logarithms of ratios of determinants that are told apart.
const LARGEST_RATIO: f64 = 200.0;

/// What tells of events, for what is looked for: it changes sign at one.
#[derive(Debug, Clone, Default)]
pub(super) struct Tests {
    /// Derivative of the parameter by the arc length.
    slope: f64,
    /// Sign, and logarithm of the size, of the determinant of what borders make of the Jacobian.
    bordered: Option<(f64, f64)>,
    /// The same of the Jacobian for increments that change sign after a period.
    antiperiodic: Option<(f64, f64)>,
}

impl Tests {
    fn of(&self, event: Event) -> Option<(f64, f64)> {
        match event {
            Event::Fold => Some((self.slope.signum(), self.slope.abs().ln())),
            Event::BranchPoint => self.bordered,
            Event::PeriodDoubling => self.antiperiodic,
        }
    }

    /// Sign of the test for an event here times that at `other`; positive where one is not known.
    fn product(&self, other: &Tests, event: Event) -> f64 {
        match (self.of(event), other.of(event)) {
            (Some((here, _)), Some((there, _))) => here * there,
            _ => 1.0,
        }
    }

    /// The test for an event, relative to its size at `other`.
    fn relative(&self, other: &Tests, event: Event) -> Option<f64> {
        let ((sign, size), (_, reference)) = (self.of(event)?, other.of(event)?);
        let ratio = (size - reference).clamp(-LARGEST_RATIO, LARGEST_RATIO);
        Some(sign * ratio.exp())
    }
}

impl Walk<'_> {
    /// What tells of events at a place.
    pub fn tests(&mut self, place: &Place) -> Result<Tests> {
        let slope = self.slope(place);
        let with_branch_points = self.options.conditions.is_empty();
        let Some(determinants) = &mut self.determinants else {
            return Ok(Tests {
                slope,
                ..Tests::default()
            });
        };
        let equations = determinants.equations();
        equations.apply_scalars(&place.state)?;
        let (grid, nodes) = (equations.grid(), equations.system().nodes());
        let antiperiodic = Box::new(Antiperiodic::new(grid, nodes));
        let antiperiodic = determinants.with(antiperiodic, &place.state)?;
        let spectral = Box::new(Spectral::new(grid, nodes));
        let bordered = match with_branch_points {
            // Bordered by the tangent, the determinant is that of J over the slope.
            true => determinants
                .with(spectral, &place.state)?
                .map(|(sign, size)| (sign * slope.signum(), size - slope.abs().ln())),
            false => {
                determinants.equations().set_rule(spectral);
                None
            }
        };
        Ok(Tests {
            slope,
            bordered,
            antiperiodic,
        })
    }

    /// The events between a place and another, `length` further, in order: each with its place, and
    /// how far it is.
    pub fn events(
        &mut self,
        (from, here): (&Place, &Tests),
        (there, length): (&Tests, f64),
    ) -> Result<Vec<(Event, Stepped, f64)>> {
        let mut found = Vec::new();
        for event in [Event::Fold, Event::BranchPoint, Event::PeriodDoubling] {
            if here.product(there, event) < 0.0
                && let Some((stepped, at)) = self.locate(event, (from, here), (there, length))?
            {
                found.push((event, stepped, at));
            }
        }
        found.sort_by(|a, b| a.2.total_cmp(&b.2));
        Ok(found)
    }

    /// Where the test for an event vanishes: by the secant method of Illinois, each time at a point
    /// of the branch. None where that fails.
    fn locate(
        &mut self,
        event: Event,
        (from, here): (&Place, &Tests),
        (there, length): (&Tests, f64),
    ) -> Result<Option<(Stepped, f64)>> {
        let (Some(first), Some(last)) = (here.relative(here, event), there.relative(here, event))
        else {
            return Ok(None);
        };
        let (mut low, mut high) = ((0.0, first), (length, last));
        let mut best: Option<(Stepped, f64, f64)> = None;
        for _ in 0..MOST {
            let at: f64 = (low.0 * high.1 - high.0 * low.1) / (high.1 - low.1);
            if !at.is_finite() || at <= 0.0 || at >= length {
                break;
            }
            let Ok(found) = self.step(from, at)? else {
                break;
            };
            let tests = match event {
                Event::Fold => Tests {
                    slope: self.slope(&found.to),
                    ..Tests::default()
                },
                _ => self.tests(&found.to)?,
            };
            // Singular to rounding: it is there.
            let value = tests.relative(here, event).unwrap_or(0.0);
            if best.as_ref().is_none_or(|best| value.abs() <= best.2.abs()) {
                best = Some((found, at, value));
            }
            if value == 0.0 || f64::abs(high.0 - low.0) <= NARROW * length {
                break;
            }
            if value * high.1 < 0.0 {
                low = high;
            } else {
                low.1 *= 0.5;
            }
            // No nearer than rounding allows.
            let stands = (at - high.0).abs() <= NARROW * length;
            high = (at, value);
            if stands {
                break;
            }
        }
        Ok(best.map(|(stepped, at, _)| (stepped, at)))
    }
}
