//! What the fuzz targets do with bytes, whoever makes these up: libFuzzer, or `tests/fuzz.rs` from
//! seeds and the corpus.

pub mod bytes;
pub mod calls;
pub mod files;
mod given;
pub mod models;
pub mod promises;
pub mod signals;
