//! Tables of sampled quantities, and CSV.

use super::call::Call;
use super::force_solution::force_quantity;
use super::guard::{free, guard};
use super::handle::Handle;
use super::id::Kind;
use super::solution::{beam_at, beam_quantity, joint_quantity, node_quantity, pdn_solution};
use super::status::pdn_status;
use crate::error::Result;
use crate::output::{Quantity, Selection, Table};
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

/// Adds the columns of a quantity of a solution.
pub(super) fn add<Q: Into<Selection>>(
    table: *mut pdn_table,
    solution: *const pdn_solution,
    label: *const c_char,
    quantity: impl FnOnce(&Call) -> Result<Q>,
) -> pdn_status {
    guard(|call| {
        let mut table = call.exclusive(table, "table")?;
        let solution = call.shared(solution, "solution")?;
        let label = text_optional(call, label, "label")?;
        table.add(&solution, quantity(call)?, label)
    })
}

/// Text, where NULL stands for "not given".
fn text_optional<'call>(
    call: &'call Call,
    text: *const c_char,
    name: &str,
) -> Result<Option<&'call str>> {
    if text.is_null() {
        return Ok(None);
    }
    call.text(text, name).map(Some)
}

/// Adds the columns of a quantity of a node, named by the label and the component.
///
/// Components are x, y, z (position, and along the inertial axes), 1, 2, 3 (along the node's own),
/// 11, 21, 31, 12, ... (rotation matrix, row and column), w, x, y, z (quaternion); angular_x, ...
/// of velocities and accelerations.
///
/// @param table  the table; not NULL
/// @param solution  the solution; not NULL
/// @param node  id of the node
/// @param quantity  PDN_NODE_POSITION, ...; one column for each component
/// @param label  columns are called `label.x` and so on; NULL for a name such as `node3.position`
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID, PDN_ERR_VALUE (no such quantity; a name that a column
///     has already), PDN_ERR_GRID_TOO_COARSE, PDN_ERR_OVERFLOW
///
/// Threads: exclusive use of `table`; like `const` of `solution`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_table_add_node(
    table: *mut pdn_table,
    solution: *const pdn_solution,
    node: i32,
    quantity: i32,
    label: *const c_char,
) -> pdn_status {
    add(table, solution, label, |_| {
        let quantity = node_quantity(quantity)?;
        Ok(Quantity::Node(Kind::Node.index(node, "node")?, quantity))
    })
}

/// Adds the columns of a quantity of a joint: one of that name or, for reactions, six with
/// components force_x, ..., moment_x, ... (force_1, ... along joint frames).
///
/// @param table  the table; not NULL
/// @param solution  the solution; not NULL
/// @param joint  id of the joint
/// @param quantity  PDN_JOINT_COORDINATE, ...
/// @param detail  the coordinate (PDN_DISPLACEMENT, ...) or, for PDN_JOINT_REACTION, the axes
///     (PDN_FRAME_SPACE, ...)
/// @param label  name of the column or, followed by a dot and the component, of the columns; NULL
///     for a name such as `joint2.rotation_1.rate`
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID, PDN_ERR_VALUE (no such quantity; a name that a column
///     has already), PDN_ERR_NOT_AVAILABLE, PDN_ERR_OVERFLOW
///
/// Threads: exclusive use of `table`; like `const` of `solution`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_table_add_joint(
    table: *mut pdn_table,
    solution: *const pdn_solution,
    joint: i32,
    quantity: i32,
    detail: i32,
    label: *const c_char,
) -> pdn_status {
    add(table, solution, label, |_| {
        let quantity = joint_quantity(quantity, detail, "detail")?;
        Ok(Quantity::Joint(
            Kind::Joint.index(joint, "joint")?,
            quantity,
        ))
    })
}

/// Adds the six columns of strains or internal forces of a beam element at a station.
///
/// Components are axial, shear_2, shear_3, and twist, curvature_2, curvature_3 of strains or
/// torque, bending_2, bending_3 of forces.
///
/// @param table  the table; not NULL
/// @param solution  the solution; not NULL
/// @param element  id of the beam element
/// @param station  place along the element, from -1 at its first to 1 at its last node
/// @param quantity  PDN_BEAM_STRAIN, PDN_BEAM_FORCE, PDN_BEAM_FORCE_MEAN or PDN_BEAM_FORCE_JUMP
/// @param label  columns are called `label.axial` and so on; NULL for a name such as
///     `beam4(0.5).force`
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_ID, PDN_ERR_VALUE (no such quantity or
///     station; a name that a column has already), PDN_ERR_OVERFLOW
///
/// Threads: exclusive use of `table`; like `const` of `solution`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_table_add_beam(
    table: *mut pdn_table,
    solution: *const pdn_solution,
    element: i32,
    station: f64,
    quantity: i32,
    label: *const c_char,
) -> pdn_status {
    add(table, solution, label, |_| {
        beam_at((element, "element"), station, beam_quantity(quantity)?)
    })
}

/// Adds the columns of a quantity of a force: one of that name or, for what it exerts on a node,
/// six with components force_x, ..., moment_x, ... (force_1, ... along the node's own axes).
///
/// @param table  the table; not NULL
/// @param solution  the solution; not NULL
/// @param force  id of the force
/// @param quantity  PDN_FORCE_EFFORT, ...
/// @param detail  the branch (PDN_FORCE_BRANCH_...) or the node (PDN_FORCE_ON_NODE...); otherwise 0
/// @param label  name of the column or, followed by a dot and the component, of the columns; NULL
///     for a name such as `force1.effort`
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID, PDN_ERR_VALUE (no such quantity; a name that a column
///     has already), PDN_ERR_NOT_AVAILABLE, PDN_ERR_OVERFLOW
///
/// Threads: exclusive use of `table`; like `const` of `solution`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_table_add_force(
    table: *mut pdn_table,
    solution: *const pdn_solution,
    force: i32,
    quantity: i32,
    detail: i32,
    label: *const c_char,
) -> pdn_status {
    add(table, solution, label, |_| {
        let quantity = force_quantity(quantity, detail)?;
        Ok(Quantity::Force(
            Kind::Force.index(force, "force")?,
            quantity,
        ))
    })
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
