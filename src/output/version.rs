//! The version of the format that a file takes: see [`super::file`].

use crate::model::Model;
use serde::Serialize;

/// The latest version that can be read.
pub(super) const VERSION: u32 = 3;
/// The version that is written of models that its readers know all of.
const COMMON_VERSION: u32 = 2;

/// What a file holds.
pub(super) trait Saved: Serialize {
    /// The model in it.
    fn model(&self) -> &Model;

    /// The version that can hold it.
    fn version(&self) -> u32 {
        match self.model().has_newer_parts() {
            true => VERSION,
            false => COMMON_VERSION,
        }
    }
}

impl Saved for Model {
    fn model(&self) -> &Model {
        self
    }
}
