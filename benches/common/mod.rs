//! What the benchmarks share.

#![allow(dead_code)] // no benchmark needs all of it

pub mod elements;
pub mod fits;
#[path = "../../tests/models/mod.rs"]
pub mod models;
#[path = "../../tests/common/random.rs"]
mod random;
pub mod table;
pub mod timing;

#[allow(unused_imports)] // nor does each draw at random
pub use random::Random;
