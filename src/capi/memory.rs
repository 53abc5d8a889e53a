//! Memory that outlasts solves.

use super::guard::guard;
use super::status::pdn_status;
use crate::pages::let_go;

/// Gives the system back the memory that the library keeps for later solves.
///
/// Up to 512 MiB of large lists are kept for others when a solve ends or a handle is freed, as the
/// system takes time to give them. Solves under way and handles keep all that they have.
///
/// @return PDN_OK
///
/// Threads: any.
/// @since 0.1
#[unsafe(no_mangle)]
pub extern "C" fn pdn_release_memory() -> pdn_status {
    guard(|_| {
        let_go();
        Ok(())
    })
}
