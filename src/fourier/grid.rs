//! The grid of collocation points.

use super::time_map::{Slope, TimeMap};
use crate::error::{Error, Result, require_positive_number};
use std::f64::consts::TAU;

/// Times `t_k = g(k T / N)` over one period: equispaced but for a map `g` of time, which brings
/// them closer together where that is wanted.
///
/// `N` is odd, but where like blades share an even number of points. Then the highest harmonic
/// is a cosine: at the points it has no first derivative, but a second one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TimeGrid {
    points: usize,
    period: f64,
    map: TimeMap,
}

impl TimeGrid {
    /// An equispaced grid of `points` (odd, at least 1) over `period` (positive, finite).
    pub fn new(points: usize, period: f64) -> Result<Self> {
        if points.is_multiple_of(2) {
            return Err(Error::size("grid_points", "an odd number", points));
        }
        TimeGrid::even_or_odd(points, period)
    }

    /// The same of an even number of points, too.
    pub fn even_or_odd(points: usize, period: f64) -> Result<Self> {
        if points == 0 {
            return Err(Error::size("grid_points", "at least 1", points));
        }
        require_positive_number("period", period)?;
        Ok(TimeGrid {
            points,
            period,
            map: TimeMap::default(),
        })
    }

    /// So many of the points, as a grid of the part of the period that they cover.
    pub(crate) fn part(&self, points: usize) -> Self {
        TimeGrid {
            points,
            period: self.period * points as f64 / self.points as f64,
            map: self.map,
        }
    }

    /// The same number of points, equispaced in the pseudo-time of a map.
    pub fn mapped(self, map: TimeMap) -> Self {
        TimeGrid { map, ..self }
    }

    /// Another number of points over the same period by the same map.
    ///
    /// # Errors
    /// If there are none.
    pub fn with_points(self, points: usize) -> Result<Self> {
        Ok(TimeGrid::even_or_odd(points, self.period)?.mapped(self.map))
    }

    /// The same points in another period, each at the same phase.
    ///
    /// # Errors
    /// If it is none.
    pub fn with_period(self, period: f64) -> Result<Self> {
        Ok(TimeGrid::even_or_odd(self.points, period)?.mapped(self.map))
    }

    /// The map of time, counted in periods.
    pub fn map(&self) -> &TimeMap {
        &self.map
    }

    /// Number of points `N`.
    pub fn points(&self) -> usize {
        self.points
    }

    /// Period `T`.
    pub fn period(&self) -> f64 {
        self.period
    }

    /// Fundamental frequency `Ω = 2π / T`, in radians per unit of time.
    pub fn frequency(&self) -> f64 {
        TAU / self.period
    }

    /// Highest harmonic, `(N − 1) / 2`, or `N / 2` of an even number of points.
    pub fn harmonics(&self) -> usize {
        self.points / 2
    }

    /// Highest harmonic of which the grid has cosine and sine.
    pub fn whole_harmonics(&self) -> usize {
        (self.points - 1) / 2
    }

    /// The part of a harmonic that the grid has: half of the highest of an even number of points,
    /// which has a cosine alone.
    pub fn part_of_harmonic(&self, harmonic: usize) -> f64 {
        if 2 * harmonic == self.points {
            0.5
        } else {
            1.0
        }
    }

    /// The same number of points, equispaced in time.
    pub fn equispaced(self) -> Self {
        self.mapped(TimeMap::default())
    }

    /// Over the same period, with half the harmonics, or half of one more.
    pub fn of_half_the_harmonics(&self) -> Self {
        TimeGrid {
            points: 2 * self.harmonics().div_ceil(2) + 1,
            ..*self
        }
    }

    /// Time of grid point `k`.
    pub fn time(&self, k: usize) -> f64 {
        self.at(k as f64 / self.points as f64)
    }

    /// Time at a pseudo-time that is counted in periods.
    pub fn at(&self, pseudo: f64) -> f64 {
        self.period * self.map.time(pseudo)
    }

    /// Pseudo-time, counted in periods, at a time.
    pub fn pseudo(&self, time: f64) -> f64 {
        self.map.pseudo(time / self.period)
    }

    /// Whether the points of `other`, `start` periods later, are equispaced in this one's
    /// pseudo-time.
    pub fn is_shifted(&self, start: f64, other: TimeGrid) -> bool {
        self.map == other.map && (start == 0.0 || self.map.is_identity())
    }

    /// How derivatives by time follow at a pseudo-time that is counted in periods.
    pub fn slope(&self, pseudo: f64) -> Slope {
        let [first, second] = self.map.time_derivatives(self.map.time(pseudo));
        Slope {
            rate: 1.0 / first,
            bend: second / (self.period * first * first),
        }
    }

    /// The same at all grid points; none if these are equispaced.
    pub fn all_slopes(&self) -> Vec<Slope> {
        if self.map.is_identity() {
            return Vec::new();
        }
        let places = (0..self.points).map(|k| k as f64 / self.points as f64);
        places.map(|pseudo| self.slope(pseudo)).collect()
    }

    /// Shares of the grid points in a mean over the period: `g'/N`.
    pub fn shares(&self) -> Vec<f64> {
        let equal = 1.0 / self.points as f64;
        let slopes = self.all_slopes();
        let share = |k: usize| slopes.get(k).map_or(equal, |slope| equal / slope.rate);
        (0..self.points).map(share).collect()
    }

    /// Times from point `k` to the one after, and to it from the one before.
    pub fn intervals(&self, k: usize) -> [f64; 2] {
        if self.map.is_identity() {
            return [self.period / self.points as f64; 2];
        }
        let at = |steps: f64| self.at((k as f64 + steps) / self.points as f64);
        [at(1.0) - at(0.0), at(0.0) - at(-1.0)]
    }

    /// All grid times.
    pub fn times(&self) -> impl Iterator<Item = f64> + '_ {
        let mapped = match self.map.is_identity() {
            true => Vec::new(),
            false => self.map.times(self.points),
        };
        let time = move |k: usize| {
            mapped
                .get(k)
                .map_or_else(|| self.time(k), |t| self.period * t)
        };
        (0..self.points).map(time)
    }
}
