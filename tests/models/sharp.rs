//! Motions that are sharp in a small part of their period, all analytic.

use super::beams::{cantilever, planar_four_bar, slider_crank};
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

/// The slider-crank with a flexible rod, whose slider meets a stop in the last half of a hundredth
/// of its stroke: a spring whose force begins softly, `k δ ln(1 + exp(x/δ))`.
pub fn end_stop() -> Sharp {
    let period = 0.1;
    let mut model = slider_crank(2, 2, period);
    let (stiffness, at, soft) = (3e5, -0.2985, 2e-4);
    let law = CoordinateLaw {
        function: Arc::new(move |state| {
            let depth = (at - state.value) / soft;
            // Without overflow far away.
            let softplus = depth.max(0.0) + (-depth.abs()).exp().ln_1p();
            Ok(Effort {
                value: -stiffness * soft * softplus,
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
    Sharp {
        name: "slider-crank with a stiff end stop",
        model,
        period,
        events: vec![event(0.5 * period, 0.03 * period, 1.5)],
    }
}

/// A damped steel strip under a pulse at its tip with a width of 1 % of the period: a Gaussian made
/// periodic, `exp((cos x − 1)/w²)`.
pub fn pulsed_strip() -> Sharp {
    let stiffness = [2.1e7, 6.7e6, 6.7e6, 35.0, 43.75, 43.75];
    let steel = damped_section(&stiffness, &[0.785, 8e-6, 4e-6, 4e-6], 2e-3);
    let (mut model, tip) = cantilever(&steel, 2, 3);
    let period = 1.0;
    let width = TAU * 0.01;
    let pulse = Signal::function_of_phase(Arc::new(move |phase: f64| {
        let x = phase - 0.4 * TAU;
        Ok(30.0 * ((x.cos() - 1.0) / (width * width)).exp())
    }));
    push(&mut model, tip, 2, pulse);
    Sharp {
        name: "strip under a pulse",
        model,
        period,
        events: vec![event(0.41 * period, 0.05 * period, 2.0)],
    }
}

/// The planar four-bar of section 7.3 of the paper, with this damping, in seconds.
pub fn snapping_four_bar(elements: usize, damping: f64) -> Sharp {
    let (model, period) = planar_four_bar(elements, 2, damping);
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
