//! What the header promises, and what is made sure of after each call.

use periodyn::capi::last_error::pdn_last_error;
use periodyn::capi::status::{PDN_ERR_MEMORY, PDN_OK, pdn_status_name};
use std::collections::{BTreeMap, HashMap, HashSet};
use std::ffi::CStr;
use std::sync::{Mutex, OnceLock, PoisonError};

const HEADER: &str = include_str!("../../include/periodyn.h");

/// The statuses that the header names for each function.
fn named() -> &'static HashMap<&'static str, HashSet<&'static str>> {
    static NAMED: OnceLock<HashMap<&str, HashSet<&str>>> = OnceLock::new();
    NAMED.get_or_init(|| {
        let mut all = HashMap::new();
        for part in HEADER.split("/**\n").skip(1) {
            let Some((comment, code)) = part.split_once("*/\n") else {
                continue;
            };
            let Some((before, _)) = code.trim_start_matches("PDN_API\n").split_once('(') else {
                continue;
            };
            let returns = comment.split("@return").nth(1).unwrap_or_default();
            let returns = returns.split("\n *\n").next().unwrap_or_default();
            let words = returns.split(|c: char| !(c.is_ascii_alphanumeric() || c == '_'));
            let statuses = words.filter(|word| word.starts_with("PDN_ERR_"));
            let name = before.rsplit([' ', '*', '\n']).next().unwrap_or_default();
            let mut named: HashSet<&str> = statuses.collect();
            // "as ::another_function"
            let others = returns.split("::").skip(1);
            let end = |c: char| !(c.is_ascii_alphanumeric() || c == '_');
            named.extend(others.filter_map(|other| other.split(end).next()));
            all.insert(name, named);
        }
        let single = all.clone();
        for named in all.values_mut() {
            let others: Vec<&str> = named.iter().copied().collect();
            for other in others {
                named.extend(single.get(other).into_iter().flatten());
            }
        }
        all
    })
}

/// Whether any call of each function was taken.
static TAKEN: Mutex<BTreeMap<String, bool>> = Mutex::new(BTreeMap::new());

/// The functions that refused all their calls.
pub fn always_refused() -> Vec<String> {
    let taken = TAKEN.lock().unwrap_or_else(PoisonError::into_inner);
    let refused = taken.iter().filter(|(_, taken)| !**taken);
    refused.map(|(name, _)| name.clone()).collect()
}

/// The message of the last call that failed.
pub fn last_message() -> String {
    let mut message = [0; 600];
    // SAFETY: as long as told; the library never gives more than it has room for.
    let message = unsafe {
        pdn_last_error(message.as_mut_ptr(), message.len());
        CStr::from_ptr(message.as_ptr())
    };
    message.to_string_lossy().into_owned()
}

/// Checks what a call gave: PDN_OK, out of memory, or a status that the header names for it, with
/// a message.
pub fn check_status(function: &str, status: i32) {
    let mut all = TAKEN.lock().unwrap_or_else(PoisonError::into_inner);
    *all.entry(function.to_string()).or_insert(false) |= status == PDN_OK;
    drop(all);
    if status == PDN_OK {
        return;
    }
    let message = last_message();
    // SAFETY: a text for each number.
    let name = unsafe { CStr::from_ptr(pdn_status_name(status)) }.to_string_lossy();
    assert!(
        !message.is_empty(),
        "{function} gave {name} without a message"
    );
    let named = named()
        .get(function)
        .unwrap_or_else(|| panic!("{function} is not in the header"));
    assert!(
        status == PDN_ERR_MEMORY || named.contains(&*name),
        "{function} gave {name}, which the header does not name: {message}"
    );
}

/// Checks that what was given with PDN_OK are numbers.
pub fn check_numbers(function: &str, status: i32, values: &[f64]) {
    if status == PDN_OK {
        let bad = values.iter().find(|x| !x.is_finite());
        assert!(bad.is_none(), "{function} gave {bad:?} with PDN_OK");
    }
}
