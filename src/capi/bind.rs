//! Functions of the caller in the place of those of a model, which files do not hold.

use super::controller::{self, pdn_controller_fn};
use super::guard::guard;
use super::id::Kind;
use super::load::load_frame;
use super::model::pdn_model;
use super::status::pdn_status;
use super::surface_force::{pdn_surface_force_fn, surface_force_law};
use super::user_force::{
    coordinate_law, gives_tangents, node_force_law, pdn_coordinate_law_fn, pdn_destroy_fn,
    pdn_user_force_fn,
};
use crate::error::Error;
use libc::c_void;

/// Gives a controller its function, or another one: that of a model from a file is not there.
///
/// @param model  the model; not NULL
/// @param force  id of a force by ::pdn_model_add_controller; ::pdn_model_find_label finds it by
///     its label
/// @param tangents  PDN_TANGENTS_GIVEN or PDN_TANGENTS_DIFFERENCED
/// @param function  the controller, see ::pdn_controller_fn for when it is called; not NULL
/// @param user_data  handed to the function; may be NULL
/// @param destroy  called once with user_data as in ::pdn_model_add_controller; may be NULL. It is
///     not called if this call fails
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID, PDN_ERR_VALUE, PDN_ERR_NOT_AVAILABLE (the force is no
///     controller)
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_bind_controller(
    model: *mut pdn_model,
    force: i32,
    tangents: i32,
    function: pdn_controller_fn,
    user_data: *mut c_void,
    destroy: pdn_destroy_fn,
) -> pdn_status {
    guard(|call| {
        let mut model = call.exclusive(model, "model")?;
        let force = Kind::Force.index_in(&model, force, "force")?;
        model.controller_law_mut(force)?;
        let gives_tangents = gives_tangents(tangents)?;
        let function = call.function(function, "function")?;
        let law = controller::law(function, gives_tangents, user_data, destroy);
        model.bind_controller(force, law)
    })
}

/// Gives a coordinate law its function, or another one: that of a model from a file is not there.
///
/// @param model  the model; not NULL
/// @param force  id of a force by ::pdn_model_add_coordinate_law; ::pdn_model_find_label finds it
///     by its label
/// @param tangents  PDN_TANGENTS_GIVEN or PDN_TANGENTS_DIFFERENCED
/// @param function  the law, see ::pdn_coordinate_law_fn for when it is called; not NULL
/// @param user_data  handed to the function; may be NULL
/// @param destroy  called once with user_data as in ::pdn_model_add_coordinate_law; may be NULL.
///     It is not called if this call fails
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID, PDN_ERR_VALUE, PDN_ERR_NOT_AVAILABLE (the force is no
///     coordinate law)
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_bind_coordinate_law(
    model: *mut pdn_model,
    force: i32,
    tangents: i32,
    function: pdn_coordinate_law_fn,
    user_data: *mut c_void,
    destroy: pdn_destroy_fn,
) -> pdn_status {
    guard(|call| {
        let mut model = call.exclusive(model, "model")?;
        let force = Kind::Force.index_in(&model, force, "force")?;
        model.coordinate_law_mut(force)?;
        let gives_derivatives = gives_tangents(tangents)?;
        let function = call.function(function, "function")?;
        let law = coordinate_law(function, gives_derivatives, user_data, destroy);
        model.bind_coordinate_law(force, law)
    })
}

/// Gives forces on nodes their function, or another one: that of a model from a file is not there.
///
/// @param model  the model; not NULL
/// @param force  id of a force by ::pdn_model_add_user_force; ::pdn_model_find_label finds it by
///     its label
/// @param frame  PDN_FRAME_SPACE or PDN_FRAME_MATERIAL, as in ::pdn_model_add_user_force
/// @param tangents  PDN_TANGENTS_GIVEN or PDN_TANGENTS_DIFFERENCED
/// @param function  the forces, see ::pdn_user_force_fn for when it is called; not NULL
/// @param user_data  handed to the function; may be NULL
/// @param destroy  called once with user_data as in ::pdn_model_add_user_force; may be NULL. It is
///     not called if this call fails
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID, PDN_ERR_VALUE, PDN_ERR_NOT_AVAILABLE (the force is
///     none on nodes by a function)
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_bind_user_force(
    model: *mut pdn_model,
    force: i32,
    frame: i32,
    tangents: i32,
    function: pdn_user_force_fn,
    user_data: *mut c_void,
    destroy: pdn_destroy_fn,
) -> pdn_status {
    guard(|call| {
        let mut model = call.exclusive(model, "model")?;
        let force = Kind::Force.index_in(&model, force, "force")?;
        model.node_forces_mut(force)?;
        let frame = load_frame(frame)?;
        let gives_tangents = gives_tangents(tangents)?;
        let function = call.function(function, "function")?;
        let law = node_force_law(function, (gives_tangents, frame), user_data, destroy);
        model.bind_node_forces(force, law)
    })
}

/// Gives forces on shell or beam elements their function, or another one: that of a model from a
/// file is not there.
///
/// @param model  the model; not NULL
/// @param first_force  id of the first of the forces, by ::pdn_model_add_surface_force or
///     ::pdn_model_add_line_force; ::pdn_model_find_label finds it by its label
/// @param forces  number of forces, in order: one on each element, at least 1
/// @param frame  PDN_FRAME_SPACE or PDN_FRAME_MATERIAL, as in ::pdn_model_add_surface_force; the
///     latter, too, of forces along beams with PDN_FRAME_UNTWISTED, whose axes the model keeps
/// @param tangents  PDN_TANGENTS_GIVEN or PDN_TANGENTS_DIFFERENCED
/// @param function  the forces, see ::pdn_surface_force_fn for when it is called; not NULL
/// @param user_data  handed to the function; may be NULL
/// @param destroy  called once with user_data as in ::pdn_model_add_surface_force; may be NULL. It
///     is not called if this call fails
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_SIZE, PDN_ERR_ID, PDN_ERR_VALUE, PDN_ERR_NOT_AVAILABLE
///     (one of the forces is none on a shell or beam by a function)
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_bind_surface_force(
    model: *mut pdn_model,
    first_force: i32,
    forces: i32,
    frame: i32,
    tangents: i32,
    function: pdn_surface_force_fn,
    user_data: *mut c_void,
    destroy: pdn_destroy_fn,
) -> pdn_status {
    guard(|call| {
        let mut model = call.exclusive(model, "model")?;
        let first = Kind::Force.index_in(&model, first_force, "first_force")?;
        let count = usize::try_from(forces).unwrap_or(0);
        let left = model.force_count() - first;
        if count == 0 || count > left {
            let expected = format!("1 to {left} (forces from first_force on)");
            return Err(Error::size("forces", expected, forces));
        }
        let all = first..first + count;
        for force in all.clone() {
            model.surface_forces_mut(force)?;
        }
        let frame = load_frame(frame)?;
        let gives_tangents = gives_tangents(tangents)?;
        let function = call.function(function, "function")?;
        let law = surface_force_law(function, (gives_tangents, frame), user_data, destroy);
        all.into_iter()
            .try_for_each(|force| model.bind_surface_forces(force, law.clone()))
    })
}
