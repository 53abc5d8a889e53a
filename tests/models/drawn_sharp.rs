//! Machines drawn at random whose motions are sharp in a small part of their period: stops, pulses
//! and mechanisms that snap.

use crate::common::Random;
use crate::common::models::beams::crooked_four_bar;
use crate::common::models::sharp::{EndStop, Pulse};
use periodyn::model::Model;

pub const FAMILIES: [&str; 3] = ["end stop", "pulse", "snap"];

/// A machine of a family, and its period.
pub fn drawn(family: usize, seed: u64, number: u64) -> (Model, f64) {
    let r = &mut Random::of(&[seed, family as u64, number]);
    match family {
        0 => {
            let stop = EndStop {
                elements: r.pick(&[1, 2, 3]),
                period: r.decades(0.06, 0.4),
                stiffness: r.decades(3e4, 1e6),
                engaged: r.decades(5e-4, 6e-3),
                softness: r.decades(3e-5, 3e-4),
            };
            (stop.model(), stop.period)
        }
        1 => {
            let pulse = Pulse {
                elements: r.pick(&[1, 2, 3]),
                damping: r.decades(5e-4, 5e-3),
                force: r.decades(3.0, 60.0),
                width: r.decades(0.005, 0.03),
            };
            (pulse.model(), r.decades(0.3, 3.0))
        }
        _ => {
            let (elements, damping) = (r.pick(&[2, 3, 4]), r.decades(5e-4, 5e-3));
            let tilt = r.between(2.0, 8.0).to_radians();
            crooked_four_bar(elements, 2, damping, tilt)
        }
    }
}
