//! What the benchmarks share.

#![allow(dead_code)] // no benchmark needs all of it

pub mod elements;
pub mod fits;
#[path = "../../tests/models/mod.rs"]
pub mod models;
pub mod table;
pub mod timing;
