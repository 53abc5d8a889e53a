//! Changes of what a model holds, by ids.

use super::contents::force_number;
use super::guard::guard;
use super::id::Kind;
use super::load::{beam_load_frame, load_frame};
use super::model::{element_count, pdn_model};
use super::parameter::signal_place;
use super::section::{self, pdn_section, read_struct};
use super::shell::pdn_shell_section;
use super::signal::{self, pdn_signal};
use super::status::pdn_status;
use nalgebra::Matrix6;

/// Gives what follows a signal another one: a load, an actuator, a prescribed coordinate. In a
/// model from a file this brings back signals by functions, too.
///
/// Parts of it that parameters move have the parameters' values again.
///
/// @param model  the model; not NULL
/// @param id  what has the signal, as in ::pdn_model_move_signal
/// @param component  of a load PDN_FORCE_1, ... or PDN_MOMENT_3, one that has a signal; of gravity
///     from 0 to 2; 0 for all else
/// @param signal  the other signal, copied; not NULL
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_ID, PDN_ERR_VALUE,
///     PDN_ERR_NOT_AVAILABLE (it has no such signal)
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_set_signal(
    model: *mut pdn_model,
    id: i32,
    component: i32,
    signal: *const pdn_signal,
) -> pdn_status {
    guard(|call| {
        let mut model = call.exclusive(model, "model")?;
        let place = signal_place(&model, id, component)?;
        let signal = signal::read(call, signal, "signal")?;
        model.set_signal(place, &signal)
    })
}

/// Gives a force other numbers of a sort, as many as it has: those that ::pdn_model_force_number
/// tells.
///
/// @param model  the model; not NULL
/// @param force  id of the force
/// @param number  PDN_NUMBER_STIFFNESS, PDN_NUMBER_DAMPING, PDN_NUMBER_RELAXATION_TIME or
///     PDN_NUMBER_REST
/// @param values  array of length [count]: the numbers, in the order of ::pdn_model_force_number
/// @param count  how many; pdn_force_info tells how many the force has; of PDN_NUMBER_REST 1
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_SIZE, PDN_ERR_NOT_FINITE, PDN_ERR_ID, PDN_ERR_VALUE (a
///     parameter moves such a number of the force, or the numbers are none of such a force)
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_set_force_numbers(
    model: *mut pdn_model,
    force: i32,
    number: i32,
    values: *const f64,
    count: usize,
) -> pdn_status {
    guard(|call| {
        let mut model = call.exclusive(model, "model")?;
        let force = Kind::Force.index_in(&model, force, "force")?;
        let which = force_number(number)?;
        let values = call.numbers(values, count, "values")?;
        model.set_force_numbers(force, which, values)
    })
}

/// Gives a load, on a node, at a point, along beam elements or on shell elements, another frame;
/// its signals stay.
///
/// @param model  the model; not NULL
/// @param load  id of the load, beam load or shell load
/// @param frame  PDN_FRAME_SPACE or PDN_FRAME_MATERIAL; along beams also PDN_FRAME_UNTWISTED
/// @param axis_2  array of length 3: as in ::pdn_model_add_load_at_places; read for
///     PDN_FRAME_UNTWISTED only, else it may be NULL
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_ID, PDN_ERR_VALUE
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_set_load_frame(
    model: *mut pdn_model,
    load: i32,
    frame: i32,
    axis_2: *const f64,
) -> pdn_status {
    guard(|call| {
        let mut model = call.exclusive(model, "model")?;
        match Kind::of(load) {
            Some(Kind::BeamLoad) => {
                let load = Kind::BeamLoad.index_in(&model, load, "load")?;
                model.set_beam_load_frame(load, beam_load_frame(call, frame, axis_2)?)
            }
            Some(Kind::ShellLoad) => {
                let load = Kind::ShellLoad.index_in(&model, load, "load")?;
                model.set_shell_load_frame(load, load_frame(frame)?)
            }
            _ => {
                let count = model.object_count(Kind::Load);
                let other = "a beam load id, a shell load id or ";
                let load = Kind::Load.index_or(other, load, count, "load")?;
                model.set_load_frame(load, load_frame(frame)?)
            }
        }
    })
}

/// Gives beam elements another section, the same all along them; their twist stays, and so do the
/// factors of parameters.
///
/// @param model  the model; not NULL
/// @param first_element  id of the first beam element
/// @param elements  number of elements, in order, at least 1
/// @param section  the section; with mass where the elements' have some, without where they have
///     none; not NULL
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE, PDN_ERR_SIZE, PDN_ERR_NOT_FINITE,
///     PDN_ERR_ID, PDN_ERR_VALUE
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_set_beam_section(
    model: *mut pdn_model,
    first_element: i32,
    elements: i32,
    section: *const pdn_section,
) -> pdn_status {
    guard(|call| {
        let mut model = call.exclusive(model, "model")?;
        let first = Kind::BeamElement.index_in(&model, first_element, "first_element")?;
        let count = element_count(elements)?;
        let section = section::read(call, section, "section")?;
        model.set_beam_section(first, count, &section)
    })
}

/// Gives shell elements another section; frames, offset and the direction of its axes stay, and so
/// do the factors of parameters.
///
/// @param model  the model; not NULL
/// @param first_element  id of the first shell element
/// @param elements  number of elements, in order, at least 1
/// @param section  the section; with mass where the elements' have some, without where they have
///     none; not NULL
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE, PDN_ERR_SIZE, PDN_ERR_NOT_FINITE,
///     PDN_ERR_ID, PDN_ERR_VALUE
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_set_shell_section(
    model: *mut pdn_model,
    first_element: i32,
    elements: i32,
    section: *const pdn_shell_section,
) -> pdn_status {
    guard(|call| {
        let mut model = call.exclusive(model, "model")?;
        let first = Kind::ShellElement.index_in(&model, first_element, "first_element")?;
        let count = element_count(elements)?;
        let section = read_struct(call, section, "section")?.core();
        model.set_shell_section(first, count, &section)
    })
}

/// Gives a rigid body, or a mass or inertia on a node, another inertia; the factor of a parameter
/// stays.
///
/// @param model  the model; not NULL
/// @param inertia  id of the inertia, as ::pdn_model_inertia_of tells of a rigid body
/// @param matrix  array of shape 6 x 6: inertia about the node, along its axes, as in
///     ::pdn_model_add_inertia, symmetric and positive semi-definite
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_ID, PDN_ERR_VALUE
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_set_inertia(
    model: *mut pdn_model,
    inertia: i32,
    matrix: *const f64,
) -> pdn_status {
    guard(|call| {
        let mut model = call.exclusive(model, "model")?;
        let inertia = Kind::Inertia.index_in(&model, inertia, "inertia")?;
        let matrix = Matrix6::from_column_slice(&call.array::<36>(matrix, "matrix")?);
        model.set_inertia(inertia, &matrix)
    })
}
