//! When a march starts and ends, and how long its steps are.

use crate::error::{Error, Result, require_finite, require_positive_number};
use crate::motion::Motion;
use crate::solve::report::NewtonOptions;
use crate::solve::watch::Watch;
use nalgebra::Vector6;

/// Motions and velocities that a march starts from; what the constraints do not allow is projected
/// out.
#[derive(Debug, Clone)]
pub struct StartState {
    /// Motion of each node.
    pub motions: Vec<Motion>,
    /// Material velocity of each node in the inertial frame; if there are none, all is at rest in
    /// the frame that motions are described in.
    pub twists: Vec<Vector6<f64>>,
    /// Internal states of all elements, at the places of the own unknowns of an instant, and the
    /// last values of the tracked coordinates. Without them internal states are relaxed.
    pub internal: Option<(Vec<f64>, Vec<f64>)>,
}

/// Where a march starts.
#[derive(Debug, Clone, Default)]
pub enum MarchStart {
    /// The reference configuration, at rest but for what is prescribed and what hangs on drives
    /// that turn, which turns with them if the joints let it.
    #[default]
    Reference,
    /// These motions and velocities.
    State(StartState),
}

/// When a march ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum MarchEnd {
    /// After this time.
    Duration(f64),
    /// When motions and velocities are those of the periodic motion.
    Periodic {
        /// Largest difference from it, by how the differences between neighbouring periods decay:
        /// displacements relative to the characteristic length, rotation matrices entry by entry,
        /// velocities likewise in units of a radian of the period.
        tolerance: f64,
        /// Periods after which it is given up.
        most_periods: usize,
    },
}

/// Options of a march.
#[derive(Debug, Clone)]
pub struct MarchOptions {
    /// Where it starts.
    pub start: MarchStart,
    /// When it starts.
    pub start_time: f64,
    /// When it ends.
    pub end: MarchEnd,
    /// Period that harmonics of signals refer to, and that the motion may repeat itself with.
    pub period: Option<f64>,
    /// Length of the steps, the first at least. Steps are shortened so that a whole number of them
    /// fits the period (marching until periodic) or the duration.
    pub step: f64,
    /// If given, steps are chosen so that each has at most this estimated error of a motion:
    /// displacements relative to the characteristic length, turns in radians.
    pub error_tolerance: Option<f64>,
    /// Spectral radius at infinite frequency, from 0 to 1: 1 keeps all vibrations, 0 removes at
    /// once what the steps do not resolve.
    pub spectral_radius: f64,
    /// When Newton's method stops in each step.
    pub newton: NewtonOptions,
    /// Keep only this number of the last periods; all if zero.
    pub stored_periods: usize,
    /// Bytes that the steps which are kept may take, by an estimate; no limit if zero.
    pub memory_limit: usize,
    /// Who is told how the march goes on, and may cancel it.
    pub watch: Watch,
}

impl MarchOptions {
    /// Default numerical dissipation. What steps of a mechanism do not resolve, in the constraints
    /// above all, must decay (1 is unstable for index 3); half in a step does, and costs a resolved
    /// vibration of 20 steps no more than some 0.4 % of its amplitude in a cycle.
    pub const SPECTRAL_RADIUS: f64 = 0.5;

    /// The defaults, with steps of this length.
    pub fn with_step(step: f64, end: MarchEnd) -> Self {
        MarchOptions {
            start: MarchStart::Reference,
            start_time: 0.0,
            end,
            period: None,
            step,
            error_tolerance: None,
            spectral_radius: Self::SPECTRAL_RADIUS,
            newton: NewtonOptions {
                tolerance: 1e-9,
                iteration_limit: 20,
            },
            stored_periods: 0,
            memory_limit: 0,
            watch: Watch::default(),
        }
    }

    pub(super) fn validate(&self) -> Result<()> {
        self.newton.validate()?;
        require_finite("options.start_time", &[self.start_time])?;
        if let Some(period) = self.period {
            require_positive_number("options.period", period)?;
        }
        require_positive_number("options.step", self.step)?;
        if let Some(tolerance) = self.error_tolerance {
            require_positive_number("options.error_tolerance", tolerance)?;
        }
        if !(0.0..=1.0).contains(&self.spectral_radius) {
            let (name, expected) = ("options.spectral_radius", "a number from 0 to 1");
            return Err(Error::value(name, expected, self.spectral_radius));
        }
        match self.end {
            MarchEnd::Duration(duration) => require_positive_number("options.duration", duration)?,
            MarchEnd::Periodic {
                tolerance,
                most_periods,
            } => {
                require_positive_number("options.periodic_tolerance", tolerance)?;
                if self.period.is_none() {
                    let expected = "the period that the motion repeats itself with";
                    return Err(Error::value("options.period", expected, "none"));
                }
                if most_periods == 0 {
                    return Err(Error::value("options.most_periods", "at least 1", 0));
                }
            }
        }
        if self.stored_periods > 0 && self.period.is_none() {
            let expected = "the period, to store the last of them";
            return Err(Error::value("options.period", expected, "none"));
        }
        self.validate_times()
    }

    /// Steps must be neither too many nor lost in the rounding of time, and must not skip periods.
    fn validate_times(&self) -> Result<()> {
        if self.span() / self.step > MOST_STEPS {
            let expected = format!(
                "at least {:.3e}, a part of {MOST_STEPS:e} of the march's or period's length",
                self.span() / MOST_STEPS
            );
            return Err(Error::value("options.step", expected, self.step));
        }
        let latest = MOST_STEPS_AWAY * self.step;
        if self.start_time.abs() > latest {
            let expected = format!("at most {latest:.3e} in size, to tell its steps apart");
            let name = "options.start_time";
            return Err(Error::value(name, expected, self.start_time));
        }
        if let (Some(period), MarchEnd::Duration(duration)) = (self.period, self.end) {
            let (least, why) = match self.error_tolerance {
                None => (self.step.min(duration), "steps must not skip periods"),
                Some(_) => (duration / MOST_STEPS, "the duration has too many of them"),
            };
            if period < (1.0 - END) * least {
                let expected = format!("at least {least:.3e}, as {why}");
                return Err(Error::value("options.period", expected, period));
            }
        }
        Ok(())
    }

    /// Length of time that a whole number of steps fits.
    pub(super) fn span(&self) -> f64 {
        match (self.end, self.period) {
            (MarchEnd::Duration(duration), _) => duration,
            (MarchEnd::Periodic { .. }, period) => period.unwrap_or(self.step),
        }
    }
}

/// More steps to a duration or period than this are a mistake.
const MOST_STEPS: f64 = 1e8;
/// Farther from time zero steps drown in the rounding of time, by more than [`END`].
const MOST_STEPS_AWAY: f64 = 1e10;
/// Steps of constant length that end within this part of one are ends.
pub(super) const END: f64 = 1e-6;
