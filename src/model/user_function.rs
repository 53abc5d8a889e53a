//! Functions of the user, which no file holds.

use crate::error::{Error, ErrorKind, Result};
use serde::de::IgnoredAny;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::fmt;

/// A function of the user, with what belongs to it; nothing in a model that was loaded from a file.
#[derive(Clone)]
pub struct UserFunction<F>(Option<F>);

impl<F> UserFunction<F> {
    /// This one.
    pub fn new(function: F) -> Self {
        UserFunction(Some(function))
    }

    /// Whether it is not there.
    pub fn is_absent(&self) -> bool {
        self.0.is_none()
    }

    /// The function.
    ///
    /// # Errors
    /// [`ErrorKind::Callback`] if it is not there.
    pub fn get(&self) -> Result<&F> {
        self.0.as_ref().ok_or_else(absent)
    }
}

/// Why a model without its functions cannot be solved.
pub(crate) fn absent() -> Error {
    let message = "its function is not there, as the model was loaded from a file, which holds \
        none: bind it again, or build the model again";
    Error::new(ErrorKind::Callback, message)
}

impl<F> fmt::Debug for UserFunction<F> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(if self.is_absent() {
            "an absent function"
        } else {
            "a function"
        })
    }
}

impl<F> Serialize for UserFunction<F> {
    /// That a function was here.
    fn serialize<S: Serializer>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error> {
        serializer.serialize_unit()
    }
}

impl<'de, F> Deserialize<'de> for UserFunction<F> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> std::result::Result<Self, D::Error> {
        IgnoredAny::deserialize(deserializer).map(|_| UserFunction(None))
    }
}
