//! Loads: forces and moments at points and along beams, and gravity.

use super::call::Call;
use super::guard::guard;
use super::id::Kind;
use super::model::{add_object, choose, element_count, pdn_model};
use super::signal::{self, pdn_signal};
use super::status::pdn_status;
use crate::elements::{BeamLoadFrame, LoadFrame};
use crate::error::{Error, Result};
use crate::model::{
    DistributedLoadDefinition, LoadDefinition, LoadPlace, LoadPoint, Model, Signal,
};

/// Directions of a load, or axes of a velocity, force or reaction: the global axes.
pub const PDN_FRAME_SPACE: i32 = 1600;
/// The same: the axes of the node, which a load follows.
pub const PDN_FRAME_MATERIAL: i32 = 1601;
/// Directions of a load along a beam: the axes that its sections have without twist, which follow
/// the sections.
pub const PDN_FRAME_UNTWISTED: i32 = 1602;

/// Component of a load: force along axis 1.
pub const PDN_FORCE_1: i32 = 1700;
/// Component of a load: force along axis 2.
pub const PDN_FORCE_2: i32 = 1701;
/// Component of a load: force along axis 3.
pub const PDN_FORCE_3: i32 = 1702;
/// Component of a load: moment about axis 1.
pub const PDN_MOMENT_1: i32 = 1703;
/// Component of a load: moment about axis 2.
pub const PDN_MOMENT_2: i32 = 1704;
/// Component of a load: moment about axis 3.
pub const PDN_MOMENT_3: i32 = 1705;

pub(super) fn load_frame(given: i32) -> Result<LoadFrame> {
    let table = [
        (PDN_FRAME_SPACE, LoadFrame::Space),
        (PDN_FRAME_MATERIAL, LoadFrame::Follower),
    ];
    choose(
        &table,
        given,
        "frame",
        "PDN_FRAME_SPACE or PDN_FRAME_MATERIAL",
    )
}

/// The frame of a load along a beam, for which `axis_2` is read if it is that of the untwisted
/// beam.
pub(super) fn beam_load_frame(
    call: &Call,
    given: i32,
    axis_2: *const f64,
) -> Result<BeamLoadFrame> {
    if given == PDN_FRAME_UNTWISTED {
        let axis_2 = call.array::<3>(axis_2, "axis_2")?;
        return Ok(BeamLoadFrame::Untwisted(axis_2.into()));
    }
    let table = [
        (PDN_FRAME_SPACE, BeamLoadFrame::Space),
        (PDN_FRAME_MATERIAL, BeamLoadFrame::Follower),
    ];
    let names = "PDN_FRAME_SPACE, PDN_FRAME_MATERIAL or PDN_FRAME_UNTWISTED";
    choose(&table, given, "frame", names)
}

/// The place of a component that a `PDN_FORCE_...` or `PDN_MOMENT_...` names among six.
pub(super) fn component_place(component: i32) -> Option<usize> {
    (PDN_FORCE_1..=PDN_MOMENT_3)
        .contains(&component)
        .then_some((component.wrapping_sub(PDN_FORCE_1)) as usize)
}

/// A load with one component, that a `PDN_FORCE_...` or `PDN_MOMENT_...` names.
pub(super) fn components(
    call: &Call,
    component: i32,
    signal: *const pdn_signal,
) -> Result<[Option<Signal>; 6]> {
    let mut components = [const { None }; 6];
    let place = component_place(component)
        .and_then(|index| components.get_mut(index))
        .ok_or_else(|| {
            let expected = "PDN_FORCE_1 to PDN_FORCE_3 or PDN_MOMENT_1 to PDN_MOMENT_3";
            Error::value("component", expected, component)
        })?;
    *place = Some(signal::read(call, signal, "signal")?);
    Ok(components)
}

/// Adds one component of a force or moment on a node, in addition to those that are there.
///
/// A force acts at the node's origin; ::pdn_model_add_load_at_point takes another point.
///
/// @param model  the model; not NULL
/// @param node  id of the node
/// @param frame  PDN_FRAME_SPACE: directions of the global axes; PDN_FRAME_MATERIAL: of the node's
///     axes, which the load follows
/// @param component  PDN_FORCE_1, PDN_FORCE_2, PDN_FORCE_3 [force], PDN_MOMENT_1, PDN_MOMENT_2 or
///     PDN_MOMENT_3 [force * length]
/// @param signal  the component in time, copied; not NULL
/// @param load  the load's id; may be NULL if it is not wanted; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_SIZE, PDN_ERR_ID, PDN_ERR_VALUE,
///     PDN_ERR_STRUCT_SIZE
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_add_load(
    model: *mut pdn_model,
    node: i32,
    frame: i32,
    component: i32,
    signal: *const pdn_signal,
    load: *mut i32,
) -> pdn_status {
    let read = |call: &Call, model: &Model| {
        let node = Kind::Node.index_in(model, node, "node")?;
        let frame = load_frame(frame)?;
        Ok((node, frame, components(call, component, signal)?))
    };
    add_object(model, Kind::Load, (load, "load"), read, |model, given| {
        let (node, frame, components) = given;
        model.add_load(node, frame, components)
    })
}

/// Adds one component of a force or moment at a point that a node carries, in addition to those
/// that are there: such as a thrust that acts off the node of a body.
///
/// The point moves with the node, and so does the arm of the force about the node.
///
/// @param model  the model; not NULL
/// @param node  id of the node
/// @param offset  array of length 3: the point, from the node's origin, along the node's axes
///     \[length\]
/// @param frame  PDN_FRAME_SPACE: directions of the global axes; PDN_FRAME_MATERIAL: of the node's
///     axes, which the load follows
/// @param component  PDN_FORCE_1, PDN_FORCE_2, PDN_FORCE_3 [force], PDN_MOMENT_1, PDN_MOMENT_2 or
///     PDN_MOMENT_3 [force * length]
/// @param signal  the component in time, copied; not NULL
/// @param load  the load's id; may be NULL if it is not wanted; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_SIZE, PDN_ERR_ID, PDN_ERR_VALUE,
///     PDN_ERR_STRUCT_SIZE
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_add_load_at_point(
    model: *mut pdn_model,
    node: i32,
    offset: *const f64,
    frame: i32,
    component: i32,
    signal: *const pdn_signal,
    load: *mut i32,
) -> pdn_status {
    let read = |call: &Call, model: &Model| {
        Ok(LoadDefinition {
            at: LoadPoint::Node(Kind::Node.index_in(model, node, "node")?),
            offset: call.array::<3>(offset, "offset")?.into(),
            frame: load_frame(frame)?,
            components: components(call, component, signal)?,
        })
    };
    let add = |model: &mut Model, load| model.add_point_load(load);
    add_object(model, Kind::Load, (load, "load"), read, add)
}

/// Adds one component of a force or moment at a fraction of the span of a beam, in addition to
/// those that are there.
///
/// It moves with the section there. Internal forces jump at such a place, which an element smooths
/// unless a node is there: next to the load they are more accurate on a mesh with a boundary there,
/// as ::pdn_model_add_beam_between makes it. The ends of elements are nodes.
///
/// @param model  the model; not NULL
/// @param first_element  id of the first beam element, such as the first_element of a ::pdn_beam
/// @param elements  number of elements, from the first on, such as the elements of a ::pdn_beam; at
///     least 1
/// @param fraction  the place, as a fraction of the reference length of these elements, from 0 to 1
/// @param offset  array of length 3: the point, from the line of the beam, along the section's axes
///     \[length\]; NULL for a point of the line
/// @param frame  PDN_FRAME_SPACE: directions of the global axes; PDN_FRAME_MATERIAL: of the
///     section's axes, which the load follows
/// @param component  PDN_FORCE_1, PDN_FORCE_2, PDN_FORCE_3 [force], PDN_MOMENT_1, PDN_MOMENT_2 or
///     PDN_MOMENT_3 [force * length]
/// @param signal  the component in time, copied; not NULL
/// @param load  the load's id, as of a load on a node; may be NULL if it is not wanted; written on
///     success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_SIZE, PDN_ERR_ID, PDN_ERR_VALUE,
///     PDN_ERR_STRUCT_SIZE
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_add_load_on_beam(
    model: *mut pdn_model,
    first_element: i32,
    elements: i32,
    fraction: f64,
    offset: *const f64,
    frame: i32,
    component: i32,
    signal: *const pdn_signal,
    load: *mut i32,
) -> pdn_status {
    let read = |call: &Call, model: &Model| {
        let offset = match offset.is_null() {
            true => [0.0; 3],
            false => call.array::<3>(offset, "offset")?,
        };
        Ok(LoadDefinition {
            at: LoadPoint::Beam {
                first_element: Kind::BeamElement.index_in(model, first_element, "first_element")?,
                elements: element_count(elements)?,
                fraction: call.number(fraction, "fraction")?,
            },
            offset: offset.into(),
            frame: load_frame(frame)?,
            components: components(call, component, signal)?,
        })
    };
    let add = |model: &mut Model, load| model.add_point_load(load);
    add_object(model, Kind::Load, (load, "load"), read, add)
}

/// Sets the acceleration of gravity, in place of any set before. Without this call there is none.
///
/// @param model  the model; not NULL
/// @param acceleration  array of length 3: such as {0, 0, -9.81}, global axes [length / time^2]
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_set_gravity(
    model: *mut pdn_model,
    acceleration: *const f64,
) -> pdn_status {
    guard(|call| {
        let mut model = call.exclusive(model, "model")?;
        let [x, y, z] = call.array::<3>(acceleration, "acceleration")?;
        model.set_gravity([
            Signal::constant(x)?,
            Signal::constant(y)?,
            Signal::constant(z)?,
        ]);
        Ok(())
    })
}

/// Sets an acceleration of gravity that varies in time, in place of any set before.
///
/// So a shaking ground can be described in axes that shake with it.
///
/// @param model  the model; not NULL
/// @param acceleration_1  component along global axis 1 [length / time^2], copied; NULL for none
/// @param acceleration_2  component along global axis 2, copied; NULL for none
/// @param acceleration_3  component along global axis 3, copied; NULL for none
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_SIZE, PDN_ERR_VALUE,
///     PDN_ERR_STRUCT_SIZE
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_set_gravity_signals(
    model: *mut pdn_model,
    acceleration_1: *const pdn_signal,
    acceleration_2: *const pdn_signal,
    acceleration_3: *const pdn_signal,
) -> pdn_status {
    guard(|call| {
        let mut model = call.exclusive(model, "model")?;
        let component = |given: *const pdn_signal, name: &str| {
            if given.is_null() {
                Signal::constant(0.0)
            } else {
                signal::read(call, given, name)
            }
        };
        model.set_gravity([
            component(acceleration_1, "acceleration_1")?,
            component(acceleration_2, "acceleration_2")?,
            component(acceleration_3, "acceleration_3")?,
        ]);
        Ok(())
    })
}

/// Adds one component of a force or moment distributed along beam elements, in addition to those
/// that are there.
///
/// It acts on the line of the beam, for each unit of its reference length, and moves with the
/// sections: signal times factor.
///
/// @param model  the model; not NULL
/// @param first_element  id of the first beam element, such as the first_element of a ::pdn_beam
/// @param elements  number of elements, from the first on, such as the elements of a ::pdn_beam; at
///     least 1
/// @param frame  PDN_FRAME_SPACE: directions of the global axes; PDN_FRAME_MATERIAL: of the
///     sections' axes, which the load follows
/// @param component  PDN_FORCE_1, PDN_FORCE_2, PDN_FORCE_3 [force / length], PDN_MOMENT_1,
///     PDN_MOMENT_2 or PDN_MOMENT_3 [force]
/// @param signal  the component in time, copied; not NULL
/// @param fractions  array of length [count]: places, as fractions of the reference length of these
///     elements, ascending from 0 to 1; two at the same place make a jump. NULL if count is 0
/// @param factors  array of length [count]: factors of the signal at these places, linear in
///     between; NULL if count is 0
/// @param count  0 for a factor of 1 all along; or at least 2
/// @param load  the load's id, a beam load's; may be NULL if it is not wanted; written on success
///     only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_SIZE, PDN_ERR_ID, PDN_ERR_VALUE,
///     PDN_ERR_STRUCT_SIZE
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_add_distributed_load(
    model: *mut pdn_model,
    first_element: i32,
    elements: i32,
    frame: i32,
    component: i32,
    signal: *const pdn_signal,
    fractions: *const f64,
    factors: *const f64,
    count: usize,
    load: *mut i32,
) -> pdn_status {
    let read = |call: &Call, model: &Model| {
        let first_element = Kind::BeamElement.index_in(model, first_element, "first_element")?;
        let elements = element_count(elements)?;
        let frame = load_frame(frame)?;
        let components = components(call, component, signal)?;
        let fractions = call.numbers(fractions, count, "fractions")?;
        let factors = call.numbers(factors, count, "factors")?;
        Ok(DistributedLoadDefinition {
            first_element,
            elements,
            frame: frame.into(),
            components,
            factors: fractions
                .iter()
                .copied()
                .zip(factors.iter().copied())
                .collect(),
        })
    };
    let add = |model: &mut Model, load| model.add_distributed_load(load);
    add_object(model, Kind::BeamLoad, (load, "load"), read, add)
}

/// Adds a force and moment distributed along beam elements, all components at all places at once,
/// in addition to those that are there: such as the air loads of a blade, at the places where these
/// are computed.
///
/// It acts on the line of the beam, for each unit of its reference length, and moves with the
/// sections. It is linear between neighbouring places. However many there are, the beam is
/// evaluated as for one. Each place is a beam load with an id of its own.
///
/// @param model  the model; not NULL
/// @param first_element  id of the first beam element, such as the first_element of a ::pdn_beam
/// @param elements  number of elements, from the first on, such as the elements of a ::pdn_beam; at
///     least 1
/// @param frame  PDN_FRAME_SPACE: directions of the global axes; PDN_FRAME_MATERIAL: of the
///     sections' axes, twisted as they are; PDN_FRAME_UNTWISTED: axis 1 along the reference line,
///     axis 2 the part of axis_2 that is perpendicular to it, axis 3 = axis 1 * axis 2, all in the
///     reference configuration, and each section takes these axes with it
/// @param axis_2  array of length 3: direction, global coordinates, of any nonzero length, nowhere
///     along the line; read for PDN_FRAME_UNTWISTED only, else it may be NULL
/// @param fractions  array of length [count]: places, as fractions of the reference length of these
///     elements, ascending from 0 to 1; two at the same place make a jump
/// @param signals  array of shape 6 x [count], each initialised, copied: those of the first place,
///     PDN_FORCE_1 to PDN_FORCE_3 [force / length] and PDN_MOMENT_1 to PDN_MOMENT_3 [force], then
///     those of the next. One that was only initialised is zero
/// @param count  number of places, at least 2
/// @param first_load  id of the beam load at the first place; those at the others follow; may be
///     NULL if it is not wanted; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_SIZE, PDN_ERR_ID, PDN_ERR_VALUE,
///     PDN_ERR_STRUCT_SIZE
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_add_load_at_places(
    model: *mut pdn_model,
    first_element: i32,
    elements: i32,
    frame: i32,
    axis_2: *const f64,
    fractions: *const f64,
    signals: *const pdn_signal,
    count: usize,
    first_load: *mut i32,
) -> pdn_status {
    guard(|call| {
        const MOST: usize = 100_000;
        let mut model = call.exclusive(model, "model")?;
        let first_element = Kind::BeamElement.index_in(&model, first_element, "first_element")?;
        let elements = element_count(elements)?;
        let frame = beam_load_frame(call, frame, axis_2)?;
        if !(2..=MOST).contains(&count) {
            return Err(Error::size("count", format!("2 to {MOST}"), count));
        }
        let fractions = call.numbers(fractions, count, "fractions")?;
        let signals = signal::read_array(call, signals, 6 * count, "signals")?;
        let places: Vec<LoadPlace> = fractions
            .iter()
            .zip(signals.chunks_exact(6))
            .map(|(&fraction, given)| LoadPlace {
                fraction,
                components: std::array::from_fn(|i| {
                    (!given[i].is_zero()).then(|| given[i].clone())
                }),
            })
            .collect();
        let out = call.out_optional(first_load, "first_load")?;
        let id = Kind::BeamLoad.next(&model, count, "count")?;
        model.add_load_at_places(first_element, elements, frame, &places)?;
        if let Some(out) = out {
            out.set(id);
        }
        Ok(())
    })
}
