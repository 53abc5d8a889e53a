//! Random machines of eleven families, as an engineer might build them: periodic by construction,
//! and all drawn from a seed.
//!
//! Nothing here looks at what the solver makes of them.

// Each program uses its own part of this module.
#![allow(dead_code)]

mod cantilevers;
mod chains;
mod drivelines;
mod four_bars;
pub mod judge;
mod plates;
mod rotors;
mod shafts;
mod slider_cranks;
mod trees;
mod waves;
mod workshop;

use crate::common::Random;
use periodyn::model::Model;
use workshop::Workshop;

/// A model, the period of what drives it, and what it is.
pub struct Machine {
    pub model: Model,
    pub period: f64,
    pub what: String,
    /// Nothing in it damps.
    pub undamped: bool,
}

/// A family's name, and what builds one of it.
type Family = (&'static str, fn(&mut Workshop));

pub const FAMILIES: [Family; 11] = [
    ("chains", chains::build),
    ("planar four-bars", four_bars::planar),
    ("spatial four-bars", four_bars::spatial),
    ("slider-cranks", slider_cranks::build),
    ("blades", rotors::blade),
    ("rotors", rotors::rotor),
    ("shafts", shafts::build),
    ("cantilevers", cantilevers::build),
    ("trees", trees::build),
    ("drivelines and laws", drivelines::build),
    ("plates and shells", plates::build),
];

/// Machine number `index` of a family.
pub fn machine(seed: u64, family: usize, index: usize) -> Machine {
    let random = Random::of(&[seed, family as u64, index as u64]);
    let mut workshop = Workshop::new(random);
    FAMILIES[family].1(&mut workshop);
    workshop.finish()
}

/// The first machines of a family that have no more nodes and are not loaded by pulses, which take
/// many grid points, with their numbers.
pub fn small(
    seed: u64,
    family: usize,
    most_nodes: usize,
) -> impl Iterator<Item = (usize, Machine)> {
    (0..)
        .map(move |index| (index, machine(seed, family, index)))
        .filter(move |(_, machine)| {
            machine.model.node_count() <= most_nodes && !machine.what.contains("pulse")
        })
}
