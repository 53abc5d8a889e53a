//! Rigid edges: nodes along an edge of a shell that move with a body.

use super::call::Call;
use super::guard::guard;
use super::id::Kind;
use super::model::{self, body, choose, pdn_model};
use super::pointer::check_pointer;
use super::shell::{
    PDN_SHELL_EDGE_END_ETA, PDN_SHELL_EDGE_END_XI, PDN_SHELL_EDGE_START_ETA,
    PDN_SHELL_EDGE_START_XI, patch_node, pdn_shell,
};
use super::status::pdn_status;
use crate::error::{Error, Result};
use crate::model::Model;

/// Body of a function that joins nodes rigidly to a body.
fn add_rigid_joints(
    model: *mut pdn_model,
    body_id: i32,
    (first_joint, joints): (*mut i32, *mut i32),
    nodes: impl FnOnce(&Call, &Model) -> Result<Vec<usize>>,
) -> pdn_status {
    guard(|call| {
        let mut model = call.exclusive(model, "model")?;
        let body = body(&model, body_id, "body")?;
        let nodes = nodes(call, &model)?;
        let first_joint = call.out(first_joint, "first_joint")?;
        let joints = call.out(joints, "joints")?;
        Kind::Joint.next(&model, nodes.len(), "joint")?;
        let made = model.add_rigid_joints(body, &nodes)?;
        // In range, as was checked.
        first_joint.set(Kind::Joint.id(made.start));
        joints.set(made.len() as i32);
        Ok(())
    })
}

/// Fixes nodes to a body, by a rigid joint each as ::pdn_model_add_rigid_joint makes: such as the
/// nodes along an edge of a shell, which then moves as a part of the body.
///
/// The body is the first of each joint, whose frames are at the node. The body itself, if it is
/// among the nodes, and what a rigid joint fixes to it already, is left out, so that edges with a
/// common corner may be fixed to one body.
///
/// @param model  the model; not NULL
/// @param body  id of the node that the others are fixed to: of a body, an end of a beam, or one of
///     the nodes themselves; or PDN_GROUND
/// @param nodes  array of length [count]: ids of the nodes, all different
/// @param count  number of nodes, at least 1
/// @param first_joint  id of the first of the joints, which follow each other in the order of the
///     nodes; written on success only
/// @param joints  number of joints; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_SIZE, PDN_ERR_ID, PDN_ERR_VALUE (a node twice, or none
///     left to be fixed)
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_add_rigid_joints(
    model: *mut pdn_model,
    body: i32,
    nodes: *const i32,
    count: usize,
    first_joint: *mut i32,
    joints: *mut i32,
) -> pdn_status {
    add_rigid_joints(model, body, (first_joint, joints), |call, model| {
        check_pointer(nodes, 1, "nodes")?;
        if count == 0 || count > model.node_count() {
            let expected = format!("1 to {} (the number of nodes)", model.node_count());
            return Err(Error::size("count", expected, count));
        }
        model::nodes(call, model, (nodes, count), "nodes")
    })
}

/// Fixes a whole edge of a shell over a surface or a grid to a body: ::pdn_model_add_rigid_joints
/// with the nodes along it.
///
/// A rigid edge takes forces and couples in all directions, those about the normal too, from
/// bodies, beams and joints on the body.
///
/// @param model  the model; not NULL
/// @param body  id of the node that the edge is fixed to: of a body, an end of a beam, or one of
///     the edge; or PDN_GROUND
/// @param shell  the shell, as the function that added it has written it; not NULL
/// @param edge  PDN_SHELL_EDGE_START_ETA where v = 0, PDN_SHELL_EDGE_END_XI where u = 1,
///     PDN_SHELL_EDGE_END_ETA where v = 1 or PDN_SHELL_EDGE_START_XI where u = 0
/// @param first_joint  id of the first of the joints, which follow each other in the order of the
///     nodes along u or v; written on success only
/// @param joints  number of joints; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID, PDN_ERR_SIZE, PDN_ERR_VALUE (none left to be fixed,
///     too)
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_add_rigid_edge(
    model: *mut pdn_model,
    body: i32,
    shell: *const pdn_shell,
    edge: i32,
    first_joint: *mut i32,
    joints: *mut i32,
) -> pdn_status {
    add_rigid_joints(model, body, (first_joint, joints), |call, model| {
        let shell = *call.reference(shell, "shell")?;
        edge_nodes(model, &shell, edge)
    })
}

/// The nodes along an edge of a shell, each once.
fn edge_nodes(model: &Model, shell: &pdn_shell, edge: i32) -> Result<Vec<usize>> {
    let [last_u, last_v] = [shell.nodes_u, shell.nodes_v].map(|n| n.saturating_sub(1));
    // What runs along the edge, and what is fixed there.
    let table = [
        (PDN_SHELL_EDGE_START_ETA, (true, 0)),
        (PDN_SHELL_EDGE_END_XI, (false, last_u)),
        (PDN_SHELL_EDGE_END_ETA, (true, last_v)),
        (PDN_SHELL_EDGE_START_XI, (false, 0)),
    ];
    let (along_u, fixed) = choose(&table, edge, "edge", "a constant PDN_SHELL_EDGE_...")?;
    let last = if along_u { last_u } else { last_v };
    let place = |k: i32| if along_u { [k, fixed] } else { [fixed, k] };
    let first = patch_node(model, shell, place(0))?;
    let mut nodes = vec![first];
    for k in 1..=last {
        let node = patch_node(model, shell, place(k))?;
        // A closed edge ends where it starts.
        if k < last || node != first {
            nodes.push(node);
        }
    }
    Ok(nodes)
}
