//! What a model is made ready for: a period, one time, or a march.

use crate::error::{Result, require_positive_number};
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// What a model is made ready for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Regime {
    /// Motions that repeat themselves with this period.
    Periodic(f64),
    /// One time, at which all signals are constant.
    Standstill(Standstill),
    /// A march in time, in which nothing needs to repeat itself.
    March(Transient),
}

impl Regime {
    /// Period that harmonics of signals refer to, or what stands for it where none matter.
    pub fn period(&self) -> f64 {
        match self {
            Regime::Periodic(period) => *period,
            Regime::Standstill(standstill) => standstill.period(),
            Regime::March(transient) => transient.period.unwrap_or(transient.duration),
        }
    }

    /// Whether signals are known to have a period.
    pub(super) fn knows_period(&self) -> bool {
        !matches!(self, Regime::March(transient) if transient.period.is_none())
    }

    /// The time at which everything stands still, if it does.
    pub fn standstill(&self) -> Option<&Standstill> {
        match self {
            Regime::Standstill(standstill) => Some(standstill),
            Regime::Periodic(_) | Regime::March(_) => None,
        }
    }

    /// Frequency that inertial forces are characterised by: that of the period or, of a march, of a
    /// step.
    pub(super) fn characteristic_frequency(&self) -> f64 {
        match self {
            Regime::March(transient) => 1.0 / transient.step,
            Regime::Periodic(_) | Regime::Standstill(_) => TAU / self.period(),
        }
    }
}

/// A time at which everything stands still, in a frame that may turn steadily.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Standstill {
    /// The time: signals keep the values that they have then.
    pub time: f64,
    /// Period that harmonics of signals refer to. It may be left out if no harmonics matter: at
    /// time zero, or if there are none.
    pub period: Option<f64>,
    /// Angular velocity of the frame, in which positions, directions and the ground are described.
    pub angular_velocity: Vector3<f64>,
    /// A point of the axis it turns about.
    pub axis_point: Vector3<f64>,
}

impl Default for Standstill {
    fn default() -> Self {
        Standstill {
            time: 0.0,
            period: None,
            angular_velocity: Vector3::zeros(),
            axis_point: Vector3::zeros(),
        }
    }
}

impl Standstill {
    /// The period, 1 where none matters.
    pub fn period(&self) -> f64 {
        self.period.unwrap_or(1.0)
    }
}

/// What is known of a march in time.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Transient {
    /// Period that harmonics of signals refer to; it may be left out if there are none.
    pub period: Option<f64>,
    /// How long the march is.
    pub duration: f64,
    /// Length of its steps.
    pub step: f64,
}

impl Transient {
    /// Checks that all of it are positive numbers.
    pub(crate) fn validate(&self) -> Result<()> {
        require_positive_number("period", self.period.unwrap_or(1.0))?;
        require_positive_number("duration", self.duration)?;
        require_positive_number("step", self.step)
    }
}
