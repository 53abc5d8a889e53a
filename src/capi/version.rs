//! Which library this is, and whether it fits the header that the caller was compiled with.

use super::guard::guard;
use super::status::{c_string, pdn_status};
use crate::error::Error;
use libc::c_char;
use std::ffi::CString;
use std::sync::OnceLock;

/// Version of this header, first number.
pub const PDN_VERSION_MAJOR: i32 = 0;
/// Version of this header, second number.
pub const PDN_VERSION_MINOR: i32 = 1;
/// Version of this header, third number.
pub const PDN_VERSION_PATCH: i32 = 0;

/// Version of the library, such as "0.1.0".
///
/// @return static string, never NULL
///
/// Threads: any.
/// @since 0.1
#[unsafe(no_mangle)]
pub extern "C" fn pdn_version() -> *const c_char {
    concat!(env!("CARGO_PKG_VERSION"), "\0").as_ptr().cast()
}

/// Whether the library serves a program compiled with the header of version major.minor.
///
/// Before 1.0 both numbers must be equal; from 1.0 on, a later minor version serves as well. Call
/// it as `pdn_version_check(PDN_VERSION_MAJOR, PDN_VERSION_MINOR)`.
///
/// @param major  PDN_VERSION_MAJOR of the header
/// @param minor  PDN_VERSION_MINOR of the header
/// @return PDN_OK, PDN_ERR_VALUE
///
/// Threads: any.
/// @since 0.1
#[unsafe(no_mangle)]
pub extern "C" fn pdn_version_check(major: i32, minor: i32) -> pdn_status {
    guard(|_| {
        let ours = (PDN_VERSION_MAJOR, PDN_VERSION_MINOR);
        if serves(ours, (major, minor)) {
            return Ok(());
        }
        let expected = format!("a header that fits library {}.{}", ours.0, ours.1);
        Err(Error::value(
            "version",
            expected,
            format!("{major}.{minor}"),
        ))
    })
}

/// How the library was built: version, profile and platform, for reports of defects.
///
/// @return static string, never NULL
///
/// Threads: any.
/// @since 0.1
#[unsafe(no_mangle)]
pub extern "C" fn pdn_build_info() -> *const c_char {
    static INFO: OnceLock<CString> = OnceLock::new();
    INFO.get_or_init(|| {
        let checks = if cfg!(debug_assertions) {
            "debug"
        } else {
            "release"
        };
        c_string(&format!(
            "periodyn {} ({checks}, {} {})",
            env!("CARGO_PKG_VERSION"),
            std::env::consts::OS,
            std::env::consts::ARCH,
        ))
    })
    .as_ptr()
}

fn serves(library: (i32, i32), header: (i32, i32)) -> bool {
    let minor_fits = if library.0 == 0 {
        library.1 == header.1
    } else {
        (0..=library.1).contains(&header.1)
    };
    library.0 == header.0 && minor_fits
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn macros_are_the_version_of_the_package() {
        let numbers = [PDN_VERSION_MAJOR, PDN_VERSION_MINOR, PDN_VERSION_PATCH];
        let package = [
            env!("CARGO_PKG_VERSION_MAJOR"),
            env!("CARGO_PKG_VERSION_MINOR"),
            env!("CARGO_PKG_VERSION_PATCH"),
        ];
        assert_eq!(numbers.map(|n| n.to_string()), package);
    }

    #[test]
    fn minor_versions_are_exact_before_one_and_upward_compatible_after() {
        assert!(serves((0, 1), (0, 1)));
        assert!(!serves((0, 2), (0, 1)));
        assert!(!serves((1, 0), (0, 0)));
        assert!(serves((1, 3), (1, 2)));
        assert!(!serves((1, 3), (1, 4)));
        assert!(!serves((1, 3), (1, -1)));
    }
}
