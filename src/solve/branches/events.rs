//! What lies between two points of a branch, located along the arc (docs/theory.md, section 13.5).

use super::augmented::Located;
use super::event_equation::EventEquation;
use super::multipliers::Multipliers;
use super::step::Shown;
use super::walk::{Place, Stepped, Walk, found_or_none};
use super::{Event, PointStability};
use crate::collocation::{Antiperiodic, Spectral};
use crate::error::Result;

/// Most points on the way to an event.
const MOST: usize = 30;
/// Length of what is left to search, over the step, that is none.
const NARROW: f64 = 1e-14;
/// The same of folds: tangents tell no better, and the parameter changes by the square of that.
const FLAT: f64 = 1e-10;
/// What is left of a test, relative to that at the last point, where Newton's method is tried.
const NEAR: f64 = 0.3;
/// Logarithms of ratios of determinants that are told apart.
const LARGEST_RATIO: f64 = 200.0;

/// What tells of events: for what is looked for it changes sign at one.
#[derive(Debug, Clone, Default)]
pub(super) struct Tests {
    /// Derivative of the parameter by the arc length.
    slope: f64,
    /// Sign, and logarithm of the size, of the determinant of what borders make of the Jacobian.
    bordered: Option<(f64, f64)>,
    /// The same of the Jacobian for increments that change sign after a period.
    antiperiodic: Option<(f64, f64)>,
    multipliers: Option<Multipliers>,
}

/// What is looked for.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Sought {
    Event(Event),
    /// A torus point, at which the pair of complex multipliers of this number, by size, is on the
    /// unit circle.
    Torus(usize),
}

/// Sign, and logarithm of the size, of a number.
fn split(x: f64) -> (f64, f64) {
    (x.signum(), x.abs().ln())
}

impl Tests {
    /// What multipliers say.
    pub fn stability(&self) -> Option<PointStability> {
        self.multipliers.as_ref().map(|found| found.stability)
    }

    fn of(&self, sought: Sought) -> Option<(f64, f64)> {
        match sought {
            Sought::Event(Event::Fold) => Some(split(self.slope)),
            Sought::Event(Event::BranchPoint) => self.bordered,
            Sought::Event(Event::PeriodDoubling) => self.antiperiodic,
            Sought::Event(Event::Torus) => None,
            Sought::Torus(number) => {
                let pair = self.multipliers.as_ref()?.pairs.get(number)?;
                Some(split(pair.size - 1.0))
            }
        }
    }

    /// Sign of the test for an event here times that at `other`; positive where one is not known.
    fn product(&self, other: &Tests, sought: Sought) -> f64 {
        match (self.of(sought), other.of(sought)) {
            (Some((here, _)), Some((there, _))) => here * there,
            _ => 1.0,
        }
    }

    /// The test for an event, relative to its size at `other`.
    fn relative(&self, other: &Tests, sought: Sought) -> Option<f64> {
        let ((sign, size), (_, reference)) = (self.of(sought)?, other.of(sought)?);
        let ratio = (size - reference).clamp(-LARGEST_RATIO, LARGEST_RATIO);
        Some(sign * ratio.exp())
    }

    /// The pair of multipliers that crosses the unit circle on the way to `other`, where so many
    /// other events explain what else does.
    fn torus(&self, other: &Tests, others: usize) -> Option<Sought> {
        let (here, there) = (self.multipliers.as_ref()?, other.multipliers.as_ref()?);
        let pairs = [here, there].map(Multipliers::pairs_outside);
        let [before, after] = pairs;
        // Two real ones that meet outside become a pair there.
        let real = |found: &Multipliers, pairs| found.stability.outside.abs_diff(2 * pairs);
        let met = real(here, before).abs_diff(real(there, after)) > others;
        let number = before.min(after);
        (before != after && !met).then_some(Sought::Torus(number))
    }
}

/// Where a test changes sign.
struct Bracket {
    /// The newest point, and the other end: places, and values there.
    newest: (f64, f64),
    other: (f64, f64),
    /// How far from the newest to the other the next point is.
    part: f64,
}

impl Bracket {
    fn new(first: (f64, f64), last: (f64, f64)) -> Self {
        Bracket {
            newest: first,
            other: last,
            part: first.1 / (first.1 - last.1),
        }
    }

    /// Where the test is evaluated next.
    fn next(&self) -> f64 {
        self.newest.0 + self.part * (self.other.0 - self.newest.0)
    }

    /// Takes a value there, and gives the way to the next place.
    fn take(&mut self, found: (f64, f64)) -> f64 {
        // The one before that is no end any more.
        let third = match found.1 * self.newest.1 > 0.0 {
            true => self.newest,
            false => std::mem::replace(&mut self.other, self.newest),
        };
        self.newest = found;
        let ([a, b, c], [fa, fb, fc]) = (
            [found.0, self.other.0, third.0],
            [found.1, self.other.1, third.1],
        );
        // By the inverse of a parabola through all three where that is between the ends.
        let (way, value) = ((a - b) / (c - b), (fa - fb) / (fc - fb));
        let is_smooth = value * value < way && (1.0 - value).powi(2) < 1.0 - way;
        self.part = match is_smooth {
            true => {
                fa / (fb - fa) * fc / (fb - fc)
                    + (c - a) / (b - a) * fa / (fc - fa) * fb / (fc - fb)
            }
            false => 0.5,
        };
        (self.next() - a).abs()
    }
}

/// An event between two points of a branch.
pub(super) struct Found {
    pub event: Event,
    pub stepped: Stepped,
    /// How far from the first of the points.
    pub at: f64,
    pub increments: Vec<f64>,
    pub second_frequency: Option<f64>,
}

impl Walk<'_> {
    /// What tells of events at a place.
    pub fn tests(&mut self, place: &Place) -> Result<Tests> {
        let tests = Tests {
            slope: self.slope(place),
            multipliers: self.multipliers(place)?,
            ..Tests::default()
        };
        self.with_determinants(place, tests)
    }

    fn with_determinants(&mut self, place: &Place, tests: Tests) -> Result<Tests> {
        let slope = tests.slope;
        let with_branch_points = self.options.conditions.is_empty();
        let Some(determinants) = &mut self.determinants else {
            return Ok(tests);
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
            bordered,
            antiperiodic,
            ..tests
        })
    }

    /// What tells of one event at a place.
    fn test(&mut self, place: &Place, sought: Sought) -> Result<Tests> {
        let slope = self.slope(place);
        let multipliers = match sought {
            Sought::Torus(_) => self.multipliers(place)?,
            Sought::Event(_) => None,
        };
        let tests = Tests {
            slope,
            multipliers,
            ..Tests::default()
        };
        match sought {
            Sought::Event(Event::BranchPoint | Event::PeriodDoubling) => {
                self.with_determinants(place, tests)
            }
            _ => Ok(tests),
        }
    }

    /// The events between a place and another, `length` further, in order.
    pub fn events(
        &mut self,
        (from, here): (&Place, &Tests),
        (to, there, length): (&Place, &Tests, f64),
    ) -> Result<Vec<Found>> {
        let all = [Event::Fold, Event::BranchPoint, Event::PeriodDoubling];
        let all = all.map(Sought::Event).into_iter();
        let mut sought: Vec<Sought> = all.filter(|&s| here.product(there, s) < 0.0).collect();
        sought.extend(here.torus(there, sought.len()));
        let mut found = Vec::new();
        for one in sought {
            found.extend(self.locate(one, (from, here), (to, there, length))?);
        }
        found.sort_by(|a: &Found, b: &Found| a.at.total_cmp(&b.at));
        Ok(found)
    }

    /// Where the test for an event vanishes: by Chandrupatla's method, each time at a point of the
    /// branch, and where the event has an equation of its own by Newton's method from near there.
    /// None where that fails.
    fn locate(
        &mut self,
        sought: Sought,
        (from, here): (&Place, &Tests),
        (to, there, length): (&Place, &Tests, f64),
    ) -> Result<Option<Found>> {
        let (Some(first), Some(last)) = (here.relative(here, sought), there.relative(here, sought))
        else {
            return Ok(None);
        };
        let is_fold = sought == Sought::Event(Event::Fold);
        let (mut bracket, narrow) = (
            Bracket::new((0.0, first), (length, last)),
            match is_fold {
                true => FLAT * length,
                false => NARROW * length,
            },
        );
        if is_fold {
            bracket.part = self.turn_between((from, here), (to, there, length));
        }
        let mut best: Option<(Found, f64)> = None;
        let mut tried = false;
        for _ in 0..MOST {
            let at = bracket.next();
            if !at.is_finite() || at <= 0.0 || at >= length {
                break;
            }
            let near = match &best {
                Some((found, _)) => (&found.stepped.to, found.at),
                None if length - at < at => (to, length),
                None => (from, 0.0),
            };
            let Ok(stepped) = self.step_near(from, at, near)? else {
                break;
            };
            let tests = self.test(&stepped.to, sought)?;
            // Singular to rounding: it is there.
            let value = tests.relative(here, sought).unwrap_or(0.0);
            let frequency = tests.frequency(sought);
            if value.abs() < NEAR && !tried {
                tried = true;
                let near = (&stepped.to, frequency.unwrap_or(0.0));
                let newton = self.pinpoint(sought.event(), (from, length), near);
                let newton = found_or_none(newton)?;
                if newton.is_some() {
                    return Ok(newton);
                }
            }
            if best.as_ref().is_none_or(|best| value.abs() <= best.1.abs()) {
                let found = Found {
                    event: sought.event(),
                    stepped,
                    at,
                    increments: Vec::new(),
                    second_frequency: frequency,
                };
                best = Some((found, value));
            }
            // No nearer than rounding allows.
            if value == 0.0 || bracket.take((at, value)) <= narrow {
                break;
            }
        }
        Ok(best.map(|(found, _)| found))
    }

    /// Where between two places a fold is, as a part of the way, if the parameter is a cubic
    /// between them.
    fn turn_between(
        &self,
        (from, here): (&Place, &Tests),
        (to, there, length): (&Place, &Tests, f64),
    ) -> f64 {
        let scale = self.scales[self.scales.len() - 1] * length;
        let mean = (self.parameter(&to.state) - self.parameter(&from.state)) / scale;
        let cosine = self.inner(&from.tangent, &to.tangent);
        let (first, last) = (here.slope, there.slope / cosine);
        // first + linear t + square t², which is of different signs at the ends.
        let linear = 6.0 * mean - 4.0 * first - 2.0 * last;
        let square = 3.0 * (first + last) - 6.0 * mean;
        let root = (linear * linear - 4.0 * square * first).sqrt();
        let sum = -0.5 * (linear + root.copysign(linear));
        let roots = [sum / square, first / sum];
        let within = roots.into_iter().find(|t| *t > 0.0 && *t < 1.0);
        within.unwrap_or(first / (first - last))
    }

    /// The event near a place, by its own equation; none if it has none, or is not found within
    /// `length` of the place where the step began.
    fn pinpoint(
        &mut self,
        event: Event,
        (from, length): (&Place, f64),
        (near, frequency): (&Place, f64),
    ) -> Result<Option<Found>> {
        let is_own = match event {
            Event::Fold => self.options.events,
            Event::PeriodDoubling | Event::Torus => true,
            Event::BranchPoint => false,
        };
        if !is_own {
            return Ok(None);
        }
        let own = EventEquation::new(event, frequency, self, &near.state)?;
        let Some(mut own) = own else {
            return Ok(None);
        };
        let along = vec![near.tangent.clone()];
        let located = self.locate_from(near.state.clone(), &mut own, along, None)?;
        let Some(Located {
            state,
            mut tangents,
            increments,
        }) = located
        else {
            return Ok(None);
        };
        let Some(mut tangent) = tangents.pop() else {
            return Ok(None);
        };
        if self.inner(&tangent, &from.tangent) < 0.0 {
            tangent.iter_mut().for_each(|x| *x = -*x);
        }
        let at = self.inner(&self.away(&from.state, &state), &from.tangent);
        if !(0.0..=length).contains(&at) {
            return Ok(None);
        }
        let cosine = self.inner(&tangent, &from.tangent).clamp(-1.0, 1.0);
        let to = Place::new(state, tangent);
        Ok(Some(Found {
            event,
            stepped: Stepped {
                to,
                shown: Shown {
                    angle: cosine.acos(),
                    prediction: 0.0,
                },
                iterations: increments.len(),
            },
            at,
            increments,
            second_frequency: own.by_frequency().map(|_| own.frequency()),
        }))
    }
}

impl Sought {
    fn event(self) -> Event {
        match self {
            Sought::Event(event) => event,
            Sought::Torus(_) => Event::Torus,
        }
    }
}

impl Tests {
    /// Frequency of the pair of multipliers that is looked for.
    fn frequency(&self, sought: Sought) -> Option<f64> {
        match sought {
            Sought::Torus(number) => {
                let pair = self.multipliers.as_ref()?.pairs.get(number)?;
                Some(pair.frequency)
            }
            Sought::Event(_) => None,
        }
    }
}
