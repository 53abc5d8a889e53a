//! Functions of the user in a model that was loaded from a file, which cannot hold them.

use super::coordinate_force::{CoordinateFunction, Effort};
use super::user_force::NodeForceFunction;
use crate::error::{Error, ErrorKind, Result};
use serde::{Deserialize, Deserializer, Serializer};
use std::cell::Cell;
use std::sync::Arc;

thread_local! {
    static ZERO: Cell<bool> = const { Cell::new(false) };
}

/// Calls `work`, while absent functions give zero instead of failing: for a system whose loads do
/// not matter, since its solution is known.
pub(crate) fn with_zero_for_absent<T>(work: impl FnOnce() -> T) -> T {
    struct Reset(bool);
    impl Drop for Reset {
        fn drop(&mut self) {
            ZERO.set(self.0);
        }
    }
    let _reset = Reset(ZERO.replace(true));
    work()
}

/// What an absent function does: it fails.
pub(crate) fn call_absent() -> Result<()> {
    if ZERO.get() {
        return Ok(());
    }
    let message = "its function is not there, as the model was loaded from a file, which holds \
        none: build the model again to solve it";
    Err(Error::new(ErrorKind::Callback, message))
}

/// Writes that a function was here.
pub(crate) fn serialize<T, S: Serializer>(
    _: &T,
    serializer: S,
) -> std::result::Result<S::Ok, S::Error> {
    serializer.serialize_unit()
}

/// Puts a function that fails in its place.
pub(super) fn coordinate_function<'de, D: Deserializer<'de>>(
    deserializer: D,
) -> std::result::Result<CoordinateFunction, D::Error> {
    <()>::deserialize(deserializer)?;
    Ok(Arc::new(|_| call_absent().map(|()| Effort::default())))
}

/// Puts a function that fails in its place.
pub(super) fn node_force_function<'de, D: Deserializer<'de>>(
    deserializer: D,
) -> std::result::Result<NodeForceFunction, D::Error> {
    <()>::deserialize(deserializer)?;
    Ok(Arc::new(|_, _| call_absent()))
}
