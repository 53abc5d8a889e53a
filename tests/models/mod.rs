//! The zoo: models that unit tests, tests and benchmarks share, with their periods, and the parts
//! that they are built of. `machines` draws others at random.

// No program uses all of it.
#![allow(dead_code)]

pub mod beams;
pub mod elements;
pub mod four_bar;
pub mod linkages;
pub mod oscillators;
pub mod parts;
pub mod pendulums;
pub mod rotors;
pub mod sharp;
pub mod shells;
pub mod small;
