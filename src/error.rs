//! The one error type of the library: what kind of failure, and a message for the engineer.

use serde::{Deserialize, Serialize};
use std::fmt;

/// Kinds of failed calls. Each has one status code in the C ABI, see [`ErrorKind::code`].
///
/// Not converging is *not* an error: it is the outcome of a solve, with diagnostics.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum ErrorKind {
    /// A pointer that must not be NULL is NULL.
    Null,
    /// A number is NaN or infinite.
    NotFinite,
    /// An array or buffer has the wrong length, or a count is out of range.
    Size,
    /// An id names no node, joint, beam or section of this model.
    Identifier,
    /// A value is finite but not allowed (negative stiffness, zero axis, unknown option, …).
    Value,
    /// The `struct_size` of a struct is not one that this library knows.
    StructSize,
    /// The quantity asked for does not exist for this object (say, an angle of a rigid joint).
    NotAvailable,
    /// The model cannot be solved as it stands (no node, a joint that cannot close, …).
    Model,
    /// A prescribed coordinate or load does not return to itself after one period.
    NotPeriodic,
    /// The grid is too coarse to interpolate this motion.
    GridTooCoarse,
    /// A user's callback reported failure or gave a number that is not finite.
    Callback,
    /// A result is too large to be a number.
    Overflow,
    /// A file could not be read or written.
    Io,
    /// A file is damaged, or not of the format or version expected.
    Format,
    /// Memory could not be had.
    OutOfMemory,
    /// A defect of the library: a panic was caught at the C boundary.
    Panic,
    /// The handle was left in an unknown state by an earlier panic.
    Poisoned,
}

impl ErrorKind {
    /// All kinds, in the order of their codes.
    pub const ALL: [ErrorKind; 17] = [
        ErrorKind::Null,
        ErrorKind::NotFinite,
        ErrorKind::Size,
        ErrorKind::Identifier,
        ErrorKind::Value,
        ErrorKind::StructSize,
        ErrorKind::NotAvailable,
        ErrorKind::Model,
        ErrorKind::NotPeriodic,
        ErrorKind::GridTooCoarse,
        ErrorKind::Callback,
        ErrorKind::Overflow,
        ErrorKind::Io,
        ErrorKind::Format,
        ErrorKind::OutOfMemory,
        ErrorKind::Panic,
        ErrorKind::Poisoned,
    ];

    /// Code, C name and one-line meaning: the table that everything else is read from.
    const fn row(self) -> (i32, &'static str, &'static str) {
        match self {
            ErrorKind::Null => (
                -1,
                "PDN_ERR_NULL",
                "a pointer that must not be NULL is NULL",
            ),
            ErrorKind::NotFinite => (-2, "PDN_ERR_NOT_FINITE", "a number is NaN or infinite"),
            ErrorKind::Size => (-3, "PDN_ERR_SIZE", "a length or count is not allowed"),
            ErrorKind::Identifier => (-4, "PDN_ERR_ID", "an id names nothing in this model"),
            ErrorKind::Value => (-5, "PDN_ERR_VALUE", "a value is not allowed"),
            ErrorKind::StructSize => (
                -6,
                "PDN_ERR_STRUCT_SIZE",
                "a struct was not initialised, or was made for another library",
            ),
            ErrorKind::NotAvailable => (
                -7,
                "PDN_ERR_NOT_AVAILABLE",
                "the quantity does not exist for this object",
            ),
            ErrorKind::Model => (
                -100,
                "PDN_ERR_MODEL",
                "the model cannot be solved as it stands",
            ),
            ErrorKind::NotPeriodic => (
                -101,
                "PDN_ERR_NOT_PERIODIC",
                "a prescribed motion or load does not repeat after one period",
            ),
            ErrorKind::GridTooCoarse => (
                -200,
                "PDN_ERR_GRID_TOO_COARSE",
                "the grid is too coarse to interpolate this motion",
            ),
            ErrorKind::Callback => (
                -201,
                "PDN_ERR_CALLBACK",
                "a callback failed or returned a number that is not finite",
            ),
            ErrorKind::Overflow => (
                -202,
                "PDN_ERR_OVERFLOW",
                "a result is too large to be a number",
            ),
            ErrorKind::Io => (-300, "PDN_ERR_IO", "a file could not be read or written"),
            ErrorKind::Format => (
                -301,
                "PDN_ERR_FORMAT",
                "a file is damaged, or not of the format or version expected",
            ),
            ErrorKind::OutOfMemory => (-900, "PDN_ERR_MEMORY", "out of memory"),
            ErrorKind::Panic => (
                -901,
                "PDN_ERR_PANIC",
                "internal error, a defect of the library",
            ),
            ErrorKind::Poisoned => (
                -902,
                "PDN_ERR_POISONED",
                "an internal error left this handle in an unknown state",
            ),
        }
    }

    /// Status code in the C ABI; negative, never reused.
    pub const fn code(self) -> i32 {
        self.row().0
    }

    /// Name of the status constant in the C header.
    pub const fn name(self) -> &'static str {
        self.row().1
    }

    /// One-line meaning.
    pub const fn meaning(self) -> &'static str {
        self.row().2
    }
}

/// A failed call: its kind, and a message that names the argument, what was expected and what came.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Error {
    kind: ErrorKind,
    message: String,
}

/// Result of everything that can fail.
pub type Result<T> = std::result::Result<T, Error>;

impl Error {
    /// An error of `kind` with `message`.
    pub fn new(kind: ErrorKind, message: impl Into<String>) -> Self {
        Error {
            kind,
            message: message.into(),
        }
    }

    /// Argument `name` is not what was expected.
    pub fn value(name: &str, expected: impl fmt::Display, got: impl fmt::Display) -> Self {
        Error::new(ErrorKind::Value, mismatch(name, expected, got))
    }

    /// Argument `name` has a length or count that is not allowed.
    pub fn size(name: &str, expected: impl fmt::Display, got: impl fmt::Display) -> Self {
        Error::new(ErrorKind::Size, mismatch(name, expected, got))
    }

    /// What kind of failure this is.
    pub fn kind(&self) -> ErrorKind {
        self.kind
    }

    /// The same error, with its message as `change` makes it.
    pub(crate) fn reworded(mut self, change: impl FnOnce(&str) -> String) -> Self {
        self.message = change(&self.message);
        self
    }

    /// The same error, with where it happened put before the message.
    pub fn within(mut self, place: impl fmt::Display) -> Self {
        self.message = format!("{place}: {}", self.message);
        self
    }
}

fn mismatch(name: &str, expected: impl fmt::Display, got: impl fmt::Display) -> String {
    format!("{name}: expected {expected}, got {got}")
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for Error {}

/// Checks that a number is positive, and finite.
pub fn require_positive_number(name: &str, x: f64) -> Result<()> {
    if x.is_finite() && x > 0.0 {
        return Ok(());
    }
    Err(Error::value(name, "a positive, finite number", x))
}

/// Checks that there is a thing of this id among so many.
pub(crate) fn require_id(name: &str, what: &str, count: usize, id: usize) -> Result<()> {
    if id < count {
        return Ok(());
    }
    let message = format!("{name}: expected a {what} id below {count}, got {id}");
    Err(Error::new(ErrorKind::Identifier, message))
}

/// Checks that `values` are finite; the message names the first that is not.
pub fn require_finite(name: &str, values: &[f64]) -> Result<()> {
    match values.iter().position(|x| !x.is_finite()) {
        None => Ok(()),
        Some(_) if values.len() == 1 => Err(Error::new(
            ErrorKind::NotFinite,
            mismatch(name, "a finite number", values[0]),
        )),
        Some(i) => Err(Error::new(
            ErrorKind::NotFinite,
            mismatch(&format!("{name}[{i}]"), "a finite number", values[i]),
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashSet;

    #[test]
    fn codes_and_names_are_unique_and_negative() {
        let codes: HashSet<i32> = ErrorKind::ALL.iter().map(|k| k.code()).collect();
        let names: HashSet<&str> = ErrorKind::ALL.iter().map(|k| k.name()).collect();
        assert_eq!(codes.len(), ErrorKind::ALL.len());
        assert_eq!(names.len(), ErrorKind::ALL.len());
        assert!(codes.iter().all(|&c| c < 0));
    }

    #[test]
    fn the_first_number_that_is_not_finite_is_named() {
        let error = require_finite("axis", &[0.0, f64::NAN, 1.0]).unwrap_err();
        assert_eq!(
            error.to_string(),
            "axis[1]: expected a finite number, got NaN"
        );
        assert_eq!(error.kind(), ErrorKind::NotFinite);
    }
}
