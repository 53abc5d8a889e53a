//! What a model holds: loads.

use super::guard::guard;
use super::id::Kind;
use super::load::{PDN_FRAME_MATERIAL, PDN_FRAME_SPACE, PDN_FRAME_UNTWISTED};
use super::model::{number, pdn_model};
use super::shell::place_code;
use super::status::pdn_status;
use crate::elements::BeamLoadFrame;
use crate::model::LoadPoint;

/// What C calls a frame.
fn frame_code(frame: BeamLoadFrame) -> i32 {
    match frame {
        BeamLoadFrame::Space => PDN_FRAME_SPACE,
        BeamLoadFrame::Follower => PDN_FRAME_MATERIAL,
        BeamLoadFrame::Untwisted(_) => PDN_FRAME_UNTWISTED,
    }
}

/// Number of loads on nodes and at points; their ids follow each other from PDN_FIRST_LOAD on.
///
/// @param model  the model; not NULL
/// @param count  the number; written on success only
/// @return PDN_OK, PDN_ERR_NULL
///
/// Threads: `model` is `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_load_count(
    model: *const pdn_model,
    count: *mut i32,
) -> pdn_status {
    super::model::count(model, count, |model| model.object_count(Kind::Load))
}

/// A load on a node or at a point; its components are signals, ::pdn_model_sample_signal.
///
/// @param model  the model; not NULL
/// @param load  id of the load
/// @param node  id of the node that carries it, or -1 if a beam does; written on success only
/// @param first_element  id of the first of the beam elements that carry it, or -1 if a node does;
///     written on success only
/// @param elements  number of these, from the first on, 0 if there are none; written on success
///     only
/// @param fraction  the place, as a fraction of the reference length of these elements, 0 if there
///     are none; written on success only
/// @param offset  array of length 3: the point, from the node or the line of the beam, along the
///     axes of the node or section; may be NULL if it is not wanted; written on success only
/// @param frame  PDN_FRAME_SPACE or PDN_FRAME_MATERIAL; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID
///
/// Threads: `model` is `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_load_at(
    model: *const pdn_model,
    load: i32,
    node: *mut i32,
    first_element: *mut i32,
    elements: *mut i32,
    fraction: *mut f64,
    offset: *mut f64,
    frame: *mut i32,
) -> pdn_status {
    guard(|call| {
        let model = call.shared(model, "model")?;
        let load = &model.loads()[Kind::Load.index_in(&model, load, "load")?];
        let node_out = call.out(node, "node")?;
        let first_out = call.out(first_element, "first_element")?;
        let elements_out = call.out(elements, "elements")?;
        let fraction_out = call.out(fraction, "fraction")?;
        let offset_out = call.out_slice_optional(offset, 3, "offset")?;
        let frame_out = call.out(frame, "frame")?;
        let (node, first, elements, fraction) = match load.at {
            LoadPoint::Node(node) => (Kind::Node.id(node), -1, 0, 0.0),
            LoadPoint::Beam {
                first_element,
                elements,
                fraction,
            } => (
                -1,
                Kind::BeamElement.id(first_element),
                elements as i32,
                fraction,
            ),
        };
        node_out.set(node);
        first_out.set(first);
        elements_out.set(elements);
        fraction_out.set(fraction);
        if let Some(offset_out) = offset_out {
            offset_out.set(load.offset.as_slice());
        }
        frame_out.set(frame_code(load.frame.into()));
        Ok(())
    })
}

/// Number of loads along beam elements; their ids follow each other from PDN_FIRST_BEAM_LOAD on.
///
/// @param model  the model; not NULL
/// @param count  the number; written on success only
/// @return PDN_OK, PDN_ERR_NULL
///
/// Threads: `model` is `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_beam_load_count(
    model: *const pdn_model,
    count: *mut i32,
) -> pdn_status {
    super::model::count(model, count, |model| model.object_count(Kind::BeamLoad))
}

/// A load along beam elements; its components are signals, ::pdn_model_sample_signal, times the
/// factors of ::pdn_model_beam_load_factor.
///
/// @param model  the model; not NULL
/// @param load  id of the beam load
/// @param first_element  id of the first beam element; written on success only
/// @param elements  number of elements, from the first on; written on success only
/// @param frame  PDN_FRAME_SPACE, PDN_FRAME_MATERIAL or PDN_FRAME_UNTWISTED; written on success
///     only
/// @param axis_2  array of length 3: direction that was given with PDN_FRAME_UNTWISTED, else zero;
///     may be NULL if it is not wanted; written on success only
/// @param places  number of places with factors, 0 for a factor of 1 all along; written on success
///     only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID
///
/// Threads: `model` is `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_beam_load(
    model: *const pdn_model,
    load: i32,
    first_element: *mut i32,
    elements: *mut i32,
    frame: *mut i32,
    axis_2: *mut f64,
    places: *mut i32,
) -> pdn_status {
    guard(|call| {
        let model = call.shared(model, "model")?;
        let load = &model.beam_loads()[Kind::BeamLoad.index_in(&model, load, "load")?];
        let first_element = call.out(first_element, "first_element")?;
        let elements = call.out(elements, "elements")?;
        let frame = call.out(frame, "frame")?;
        let axis_2 = call.out_slice_optional(axis_2, 3, "axis_2")?;
        let places = call.out(places, "places")?;
        first_element.set(Kind::BeamElement.id(load.first_element));
        // Numbers of elements are, as their ids; places are fewer than memory holds.
        elements.set(load.elements as i32);
        frame.set(frame_code(load.frame));
        places.set(load.factors.len() as i32);
        if let Some(axis_2) = axis_2 {
            axis_2.set(&match load.frame {
                BeamLoadFrame::Untwisted(direction) => direction.into(),
                _ => [0.0; 3],
            });
        }
        Ok(())
    })
}

/// Factor of a load along beam elements at a place; it is linear in between.
///
/// @param model  the model; not NULL
/// @param load  id of the beam load
/// @param index  which of its places, from 0, in order along the elements
/// @param fraction  the place, as a fraction of the reference length of its elements; written on
///     success only
/// @param factor  the factor there; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID
///
/// Threads: `model` is `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_beam_load_factor(
    model: *const pdn_model,
    load: i32,
    index: i32,
    fraction: *mut f64,
    factor: *mut f64,
) -> pdn_status {
    guard(|call| {
        let model = call.shared(model, "model")?;
        let load = &model.beam_loads()[Kind::BeamLoad.index_in(&model, load, "load")?];
        let index = number(index, load.factors.len(), "index", "a place of the load")?;
        let fraction_out = call.out(fraction, "fraction")?;
        let factor_out = call.out(factor, "factor")?;
        let (fraction, factor) = load.factors[index];
        fraction_out.set(fraction);
        factor_out.set(factor);
        Ok(())
    })
}

/// Number of loads on shell elements; their ids follow each other from PDN_FIRST_SHELL_LOAD on.
///
/// @param model  the model; not NULL
/// @param count  the number; written on success only
/// @return PDN_OK, PDN_ERR_NULL
///
/// Threads: `model` is `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_shell_load_count(
    model: *const pdn_model,
    count: *mut i32,
) -> pdn_status {
    super::model::count(model, count, |model| model.object_count(Kind::ShellLoad))
}

/// A load on shell elements; its components are signals, ::pdn_model_sample_signal.
///
/// @param model  the model; not NULL
/// @param load  id of the shell load
/// @param first_element  id of the first shell element; written on success only
/// @param elements  number of elements, from the first on; written on success only
/// @param place  PDN_SHELL_SURFACE or an edge, of each of them; written on success only
/// @param frame  PDN_FRAME_SPACE or PDN_FRAME_MATERIAL; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID
///
/// Threads: `model` is `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_shell_load(
    model: *const pdn_model,
    load: i32,
    first_element: *mut i32,
    elements: *mut i32,
    place: *mut i32,
    frame: *mut i32,
) -> pdn_status {
    guard(|call| {
        let model = call.shared(model, "model")?;
        let load = &model.shell_loads()[Kind::ShellLoad.index_in(&model, load, "load")?];
        let first_element = call.out(first_element, "first_element")?;
        let elements = call.out(elements, "elements")?;
        let place = call.out(place, "place")?;
        let frame = call.out(frame, "frame")?;
        first_element.set(Kind::ShellElement.id(load.first_element));
        elements.set(load.elements as i32);
        place.set(place_code(load.place));
        frame.set(frame_code(load.frame.into()));
        Ok(())
    })
}
