//! Status codes. [`ErrorKind`] is the table; the constants repeat it because cbindgen reads
//! literals only.

use crate::error::ErrorKind;
use libc::c_char;
use std::ffi::CString;
use std::sync::OnceLock;

/// What a call returns: PDN_OK, or the negative code of a failure.
///
/// Whether a solve converged is not a status but a part of its result.
pub type pdn_status = i32;

/// The call did what it says.
pub const PDN_OK: i32 = 0;
/// A pointer that must not be NULL is NULL.
pub const PDN_ERR_NULL: i32 = -1;
/// A number is NaN or infinite.
pub const PDN_ERR_NOT_FINITE: i32 = -2;
/// A length or count is not allowed.
pub const PDN_ERR_SIZE: i32 = -3;
/// An id names nothing in this model.
pub const PDN_ERR_ID: i32 = -4;
/// A value is not allowed.
pub const PDN_ERR_VALUE: i32 = -5;
/// A struct was not initialised, or was made for another library.
pub const PDN_ERR_STRUCT_SIZE: i32 = -6;
/// The quantity does not exist for this object.
pub const PDN_ERR_NOT_AVAILABLE: i32 = -7;
/// The model cannot be solved as it stands.
pub const PDN_ERR_MODEL: i32 = -100;
/// A prescribed motion or load does not repeat after one period.
pub const PDN_ERR_NOT_PERIODIC: i32 = -101;
/// The grid is too coarse to interpolate this motion.
pub const PDN_ERR_GRID_TOO_COARSE: i32 = -200;
/// A callback failed or returned a number that is not finite.
pub const PDN_ERR_CALLBACK: i32 = -201;
/// A result is too large to be a number.
pub const PDN_ERR_OVERFLOW: i32 = -202;
/// A file could not be read or written.
pub const PDN_ERR_IO: i32 = -300;
/// A file is damaged, or not of the format or version expected.
pub const PDN_ERR_FORMAT: i32 = -301;
/// Out of memory.
pub const PDN_ERR_MEMORY: i32 = -900;
/// Internal error, a defect of the library.
pub const PDN_ERR_PANIC: i32 = -901;
/// An internal error left this handle in an unknown state.
pub const PDN_ERR_POISONED: i32 = -902;

/// Name of a status, such as "PDN_ERR_NULL".
///
/// @param status  any number
/// @return static string, never NULL; "PDN_ERR_UNKNOWN" for a number that is no status
///
/// Threads: any.
/// @since 0.1
#[unsafe(no_mangle)]
pub extern "C" fn pdn_status_name(status: pdn_status) -> *const c_char {
    row(status).name.as_ptr()
}

/// One-line meaning of a status. What went wrong in a given call is told by ::pdn_last_error.
///
/// @param status  any number
/// @return static string, never NULL; "unknown status" for a number that is no status
///
/// Threads: any.
/// @since 0.1
#[unsafe(no_mangle)]
pub extern "C" fn pdn_status_message(status: pdn_status) -> *const c_char {
    row(status).message.as_ptr()
}

/// A row of the table with its texts ended by NUL, as C wants them.
struct Row {
    code: i32,
    name: CString,
    message: CString,
}

fn row(status: i32) -> &'static Row {
    static ROWS: OnceLock<Vec<Row>> = OnceLock::new();
    let rows = ROWS.get_or_init(|| {
        let row = |code, name: &str, message: &str| Row {
            code,
            name: c_string(name),
            message: c_string(message),
        };
        let ends = [
            row(PDN_OK, "PDN_OK", "success"),
            // Last, and found by no code: stands for every number that is no status.
            row(i32::MIN, "PDN_ERR_UNKNOWN", "unknown status"),
        ];
        let [first, last] = ends;
        let errors = ErrorKind::ALL.map(|kind| row(kind.code(), kind.name(), kind.meaning()));
        std::iter::once(first)
            .chain(errors)
            .chain(std::iter::once(last))
            .collect()
    });
    rows.iter()
        .find(|row| row.code == status)
        .unwrap_or(&rows[rows.len() - 1])
}

/// `text` for C, up to the first NUL if it has one.
pub(super) fn c_string(text: &str) -> CString {
    let end = text.find('\0').unwrap_or(text.len());
    CString::new(&text[..end]).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::ffi::CStr;

    fn text(pointer: *const c_char) -> &'static str {
        // SAFETY: both functions return static strings.
        unsafe { CStr::from_ptr(pointer) }.to_str().unwrap()
    }

    /// `(name, code)` of every constant, as they stand in this file.
    fn constants() -> Vec<(String, i32)> {
        include_str!("status.rs")
            .lines()
            .filter_map(|line| line.strip_prefix("pub const PDN_ERR_"))
            .map(|rest| {
                let (name, code) = rest.split_once(": i32 = ").unwrap();
                let code = code.trim_end_matches(';').parse().unwrap();
                (format!("PDN_ERR_{name}"), code)
            })
            .collect()
    }

    #[test]
    fn constants_are_the_table_of_error_kinds() {
        let table = ErrorKind::ALL.map(|kind| (kind.name().to_owned(), kind.code()));
        assert_eq!(constants(), table);
    }

    #[test]
    fn names_and_messages_are_the_table_of_error_kinds() {
        for kind in ErrorKind::ALL {
            assert_eq!(text(pdn_status_name(kind.code())), kind.name());
            assert_eq!(text(pdn_status_message(kind.code())), kind.meaning());
        }
        assert_eq!(text(pdn_status_name(PDN_OK)), "PDN_OK");
        assert_eq!(text(pdn_status_message(PDN_OK)), "success");
        assert_eq!(text(pdn_status_name(77)), "PDN_ERR_UNKNOWN");
        assert_eq!(text(pdn_status_message(-77)), "unknown status");
    }
}
