//! Motions that are sharp in a small part of their period, all analytic.

use super::beams::{cantilever, crooked_four_bar, slider_crank};
use super::parts::*;
use periodyn::elements::CoordinateLaw;
use periodyn::elements::{Coordinate, Effort};
use periodyn::fourier::SharpEvent;
use periodyn::model::*;
use std::f64::consts::TAU;
use std::sync::Arc;

/// A model, its period, and events that suit it.
pub struct Sharp {
    pub name: &'static str,
    pub model: Model,
    pub period: f64,
    pub events: Vec<SharpEvent>,
}

fn event(time: f64, width: f64, share: f64) -> SharpEvent {
    SharpEvent { time, width, share }
}

/// A slider-crank with a flexible rod, whose slider meets a stop at the end of its stroke of 0.3 m:
/// a spring whose force begins softly, `k δ ln(1 + exp(x/δ))`.
#[derive(Clone, Copy, Debug)]
pub struct EndStop {
    pub elements: usize,
    pub period: f64,
    pub stiffness: f64,
    /// Length that the slider would go on from where it meets the stop.
    pub engaged: f64,
    /// `δ`.
    pub softness: f64,
}

impl EndStop {
    pub fn model(&self) -> Model {
        let EndStop {
            stiffness,
            softness,
            ..
        } = *self;
        let at = self.engaged - 0.3;
        let mut model = slider_crank(self.elements, 2, self.period);
        let law = CoordinateLaw {
            function: Arc::new(move |state| {
                let depth = (at - state.value) / softness;
                // Without overflow far away.
                let softplus = depth.max(0.0) + (-depth.abs()).exp().ln_1p();
                Ok(Effort {
                    value: -stiffness * softness * softplus,
                    by_coordinate: stiffness / (1.0 + (-depth).exp()),
                    by_rate: 0.0,
                })
            }),
            gives_derivatives: true,
        };
        let slide = JointCoordinate {
            joint: 3,
            coordinate: Coordinate::Displacement1,
        };
        model.add_coordinate_law(slide, law).unwrap();
        model
    }
}

/// The stop reaches half of a hundredth of the stroke. Events are where it is met and left.
pub fn end_stop() -> Sharp {
    let period = 0.1;
    let stop = EndStop {
        elements: 2,
        period,
        stiffness: 3e5,
        engaged: 1.5e-3,
        softness: 2e-4,
    };
    Sharp {
        name: "slider-crank with a stiff end stop",
        model: stop.model(),
        period,
        events: vec![
            event(0.4756 * period, 0.0194 * period, 0.463),
            event(0.5419 * period, 0.0381 * period, 0.896),
        ],
    }
}

/// A damped steel strip of 1 m, clamped, under a pulse at its tip: a Gaussian made periodic,
/// `exp((cos x − 1)/w²)`.
#[derive(Clone, Copy, Debug)]
pub struct Pulse {
    pub elements: usize,
    /// Times the stiffness.
    pub damping: f64,
    pub force: f64,
    /// Full width at half of the largest force, in periods.
    pub width: f64,
}

impl Pulse {
    pub fn model(&self) -> Model {
        let force = self.force;
        let stiffness = [2.1e7, 6.7e6, 6.7e6, 35.0, 43.75, 43.75];
        let steel = damped_section(&stiffness, &[0.785, 8e-6, 4e-6, 4e-6], self.damping);
        let (mut model, tip) = cantilever(&steel, self.elements, 3);
        // exp(-y²/2w²) is a half at y = w √(2 ln 2).
        let w = 0.5 * TAU * self.width / (2.0 * 2f64.ln()).sqrt();
        let pulse = Signal::function_of_phase(Arc::new(move |phase: f64| {
            let x = phase - 0.4 * TAU;
            Ok(force * ((x.cos() - 1.0) / (w * w)).exp())
        }));
        push(&mut model, tip, 2, pulse);
        model
    }
}

/// A pulse a hundredth of the period wide. Events are the pulse and the vibration after it.
pub fn pulsed_strip() -> Sharp {
    let period = 1.0;
    let pulse = Pulse {
        elements: 2,
        damping: 2e-3,
        force: 10.0,
        width: 0.01,
    };
    Sharp {
        name: "strip under a pulse",
        model: pulse.model(),
        period,
        events: vec![
            event(0.4007 * period, 0.0307 * period, 1.52),
            event(0.5134 * period, 0.1237 * period, 2.01),
            event(0.8089 * period, 0.1993 * period, 1.0),
        ],
    }
}

/// The planar four-bar of section 7.3 of the paper, with this damping, in seconds.
pub fn snapping_four_bar(elements: usize, damping: f64) -> Sharp {
    let tilt = 5f64.to_radians();
    let (model, period) = crooked_four_bar(elements, 2, damping, tilt);
    Sharp {
        name: "planar four-bar with a crooked axis",
        model,
        period,
        events: vec![
            event(0.25 * period, 0.008 * period, 2.0),
            event(0.75 * period, 0.008 * period, 2.0),
        ],
    }
}
