//! The grid of collocation points.

use crate::error::{Error, Result, require_positive_number};
use std::f64::consts::TAU;

/// `N` odd, equispaced times `t_k = k T / N` over one period.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TimeGrid {
    points: usize,
    period: f64,
}

impl TimeGrid {
    /// A grid of `points` (odd, at least 1) over `period` (positive, finite).
    pub fn new(points: usize, period: f64) -> Result<Self> {
        if points.is_multiple_of(2) {
            return Err(Error::size("grid_points", "an odd number", points));
        }
        require_positive_number("period", period)?;
        Ok(TimeGrid { points, period })
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

    /// Highest harmonic, `(N − 1) / 2`.
    pub fn harmonics(&self) -> usize {
        (self.points - 1) / 2
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
        self.period * k as f64 / self.points as f64
    }

    /// All grid times.
    pub fn times(&self) -> impl Iterator<Item = f64> + '_ {
        (0..self.points).map(|k| self.time(k))
    }
}
