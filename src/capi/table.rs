//! Tables of sampled quantities, and CSV.

use super::call::Call;
use super::guard::{free, guard};
use super::handle::Handle;
use super::status::pdn_status;
use crate::error::Result;
use crate::output::Table;
use libc::c_char;
use std::path::Path;

/// Columns of numbers over the same times. Made by ::pdn_table_new, freed by ::pdn_table_free.
pub struct pdn_table {
    _private: [u8; 0],
}

impl Handle for pdn_table {
    type Core = Table;
}

/// A table over these times, to choose columns for and to write as CSV.
///
/// Its first column, `t`, are the times. Columns come from one solution or from several, which are
/// sampled as they are added and may then be freed.
///
/// @param times  array of length [count]: times, also outside the first period, in any order
/// @param count  number of times, at least 1
/// @param out  the table; free it with ::pdn_table_free; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_SIZE
///
/// Threads: any.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_table_new(
    times: *const f64,
    count: usize,
    out: *mut *mut pdn_table,
) -> pdn_status {
    guard(|call| {
        let times = call.numbers(times, count, "times")?;
        let out = call.out(out, "out")?;
        out.give(Table::new(times)?);
        Ok(())
    })
}

/// Frees a table; NULL does nothing.
///
/// @param table  the table, not to be used any more
///
/// Threads: exclusive use of `table`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_table_free(table: *mut pdn_table) {
    free(table);
}

/// Text, where NULL stands for "not given".
pub(super) fn text_optional<'call>(
    call: &'call Call,
    text: *const c_char,
    name: &str,
) -> Result<Option<&'call str>> {
    if text.is_null() {
        return Ok(None);
    }
    call.text(text, name).map(Some)
}

/// Adds a column of values of your own, such as one computed from several quantities.
///
/// @param table  the table; not NULL
/// @param label  name of the column; not NULL
/// @param values  array of length [count]: a value for each time
/// @param count  number of values: that of the times
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_SIZE, PDN_ERR_VALUE (a name that a
///     column has already)
///
/// Threads: exclusive use of `table`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_table_add_values(
    table: *mut pdn_table,
    label: *const c_char,
    values: *const f64,
    count: usize,
) -> pdn_status {
    guard(|call| {
        let mut table = call.exclusive(table, "table")?;
        let label = call.text(label, "label")?;
        let values = call.numbers(values, count, "values")?;
        table.add_values(label, values)
    })
}

/// Writes a table as a CSV file: a line of names, then a line for each time.
///
/// Columns are separated by commas, names with commas or quotes are quoted. Numbers have as many
/// digits as it takes to read them back exactly.
///
/// @param table  the table; not NULL
/// @param path  where to, UTF-8. A file that is there is replaced when all is written; if that
///     fails it stays as it was. A terminal or pipe, such as "/dev/stdout", is written to directly
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_VALUE (text that is not UTF-8), PDN_ERR_IO
///
/// Threads: like a `const` use of `table`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_table_write_csv(
    table: *const pdn_table,
    path: *const c_char,
) -> pdn_status {
    guard(|call| {
        let table = call.shared(table, "table")?;
        let path = call.text(path, "path")?;
        table.write_csv(Path::new(path))
    })
}
