//! Beams: their elements and nodes.

use super::call::check_pointer;
use super::guard::guard;
use super::model::{next_id, node, pdn_model, vector};
use super::section::{self, pdn_section};
use super::status::pdn_status;
use crate::error::Result;
use crate::model::Model;

/// What a beam was made of; written by the library. This struct will never change its size.
///
/// The nodes along the beam are first, first + 1, ... last; the elements are first_element,
/// ... first_element + elements - 1.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct pdn_beam {
    /// Id of the node at the start.
    pub first: i32,
    /// Id of the node at the end.
    pub last: i32,
    /// Id of the element at the start.
    pub first_element: i32,
    /// Number of elements.
    pub elements: i32,
    /// Zero.
    pub reserved: [i32; 4],
}

const _: () = assert!(size_of::<pdn_beam>() == 32);

/// Adds a beam element over nodes that are there; it may be curved and twisted.
///
/// The nodes stand, in order, at the Gauss-Lobatto points along the beam; two are its ends. Axis 1 of
/// each node is along the beam (to within 60 degrees, for curved ones), axes 2 and 3 are those of the
/// section. The element's reference shape interpolates them, and is free of stress.
///
/// @param model  the model; not NULL
/// @param nodes  array of length [count]: ids of the nodes, all different
/// @param count  2 to 25
/// @param section  cross-section, with positive-definite stiffness; not NULL
/// @param element  the element's id; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_SIZE, PDN_ERR_ID, PDN_ERR_STRUCT_SIZE, PDN_ERR_NOT_FINITE,
///     PDN_ERR_VALUE, PDN_ERR_MODEL (nodes that turn too much from one to the next)
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_add_beam_element(
    model: *mut pdn_model,
    nodes: *const i32,
    count: usize,
    section: *const pdn_section,
    element: *mut i32,
) -> pdn_status {
    guard(|call| {
        let mut model = call.exclusive(model, "model")?;
        check_pointer(nodes, 1, "nodes")?;
        Model::require_element_size("count", count)?;
        let nodes = call
            .slice(nodes, count, "nodes")?
            .iter()
            .enumerate()
            .map(|(i, &id)| node(&model, id, &format!("nodes[{i}]")))
            .collect::<Result<Vec<_>>>()?;
        let section = section::read(call, section, "section")?;
        let element = call.out(element, "element")?;
        let id = next_id(model.beam_element_count(), 1, "element")?;
        model.add_beam_element(&nodes, &section)?;
        element.set(id);
        Ok(())
    })
}

/// Adds a straight beam: its nodes and elements.
///
/// Axis 1 of every node is along the beam, from start to end; axis 2 is the part of axis_2 that is
/// perpendicular to it; axis 3 = axis 1 * axis 2. Beams are joined by joints between their nodes, or by
/// ::pdn_model_add_rigid_joint.
///
/// @param model  the model; not NULL
/// @param start  array of length 3: where the beam starts, global coordinates [length]
/// @param end  array of length 3: where it ends, not at start
/// @param axis_2  array of length 3: direction of axis 2 of the section, global coordinates, of any
///     nonzero length, not along the beam
/// @param section  cross-section, with positive-definite stiffness; not NULL
/// @param elements  number of elements, 1 to 1000000
/// @param degree  polynomial degree of the elements, 1 to 24; an element has degree + 1 nodes
/// @param beam  ids of what was made; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_SIZE, PDN_ERR_STRUCT_SIZE, PDN_ERR_VALUE
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_add_straight_beam(
    model: *mut pdn_model,
    start: *const f64,
    end: *const f64,
    axis_2: *const f64,
    section: *const pdn_section,
    elements: usize,
    degree: usize,
    beam: *mut pdn_beam,
) -> pdn_status {
    guard(|call| {
        let mut model = call.exclusive(model, "model")?;
        let start = vector(call, start, "start")?;
        let end = vector(call, end, "end")?;
        let axis_2 = vector(call, axis_2, "axis_2")?;
        let section = section::read(call, section, "section")?;
        let beam = call.out(beam, "beam")?;
        Model::require_mesh(elements, degree)?;
        let first = next_id(model.node_count(), elements * degree + 1, "elements")?;
        let first_element = next_id(model.beam_element_count(), elements, "elements")?;
        let ids = model.add_straight_beam(&start, &end, &axis_2, &section, elements, degree)?;
        // In range, as `next_id` has found out.
        beam.set(pdn_beam {
            first,
            last: ids.last_node as i32,
            first_element,
            elements: elements as i32,
            reserved: [0; 4],
        });
        Ok(())
    })
}
