//! Forces on shells and along beams that a function of the caller computes.

use super::call::Call;
use super::callback::Callback;
use super::guard::guard;
use super::id::Kind;
use super::load::{beam_load_frame, load_frame};
use super::model::{element_count, pdn_model};
use super::shell::load_place;
use super::status::pdn_status;
use super::user_force::{gives_tangents, pdn_destroy_fn};
use crate::elements::{
    BeamLoadFrame, ForcePlace, LoadFrame, SurfaceForceInput, SurfaceForceLaw, SurfaceForceOutput,
};
use crate::error::Result;
use crate::model::Model;
use libc::c_void;
use std::sync::Arc;

/// What a user's forces on a shell or beam element may depend on: the points of a quadrature over
/// its surface, an edge or its line. The library makes it; a later one may add fields at its end.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct pdn_surface_state {
    /// Size of the struct that the library knows.
    pub struct_size: usize,
    /// Time, in [0, T) of the period T of the solve, but for the first calls of a solve
    /// (::pdn_surface_force_fn).
    pub time: f64,
    /// Id of the shell element, or of the beam element.
    pub element: i32,
    /// Zero.
    pub reserved: i32,
    /// Number of points.
    pub point_count: usize,
    /// Array of shape 2 x [point_count]: xi and eta of each, from -1 to 1; eta is 0 on beams.
    pub places: *const f64,
    /// Array of length [point_count]: the reference area, or length of an edge or beam, that each
    /// stands for: a force is this much of what the function gives.
    pub sizes: *const f64,
    /// Array of shape 3 x [point_count]: positions, global coordinates [length].
    pub positions: *const f64,
    /// Array of shape 9 x [point_count]: rotation matrices, column by column; the columns are the
    /// axes of the point in global coordinates, those of a follower load: on the surface axes 1, 2
    /// and the normal, on an edge 1 along it, 3 along the normal, and 2 = 3 * 1; along a beam those
    /// of its section, or with PDN_FRAME_UNTWISTED those without twist.
    pub rotations: *const f64,
    /// Array of shape 6 x [point_count]: velocity and angular velocity of each point relative to
    /// the inertial frame, also in a steady rotation (::pdn_solve_static), along the global axes
    /// (PDN_FRAME_SPACE) or the point's own (PDN_FRAME_MATERIAL).
    pub velocities: *const f64,
}

/// Where a user's forces on a shell or beam element go. The library makes it, with all arrays set
/// to zero; a later one may add fields.
///
/// Everything is along the same axes as the velocities, for each unit of reference area or length.
/// Rows and columns of the tangents are those of ::pdn_force_values, of one point.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct pdn_surface_values {
    /// Size of the struct that the library knows.
    pub struct_size: usize,
    /// Array of shape 6 x [point_count]: force at each point and moment about it.
    pub forces: *mut f64,
    /// Array of shape 6 x 6 x [point_count], each column by column: derivatives of the force at a
    /// point by displacements and turns of this point. NULL if tangents are not wanted, or were
    /// said not to be given.
    pub by_motion: *mut f64,
    /// The same by velocities and angular velocities; NULL where by_motion is.
    pub by_velocity: *mut f64,
}

const _: () =
    assert!(size_of::<pdn_surface_state>() == 72 && size_of::<pdn_surface_values>() == 32);

/// Forces on shells or along beams, to be computed by the caller, such as of a fluid: for all
/// points of one element at once, each by the motion of this point alone.
///
/// Called on the thread that solves; if two threads solve at once, on both at once. The same state
/// must give the same forces, and over time they must repeat with the period: solves call it first
/// a few times at one motion, at times in [0, 2 T), and refuse what does not with
/// PDN_ERR_NOT_PERIODIC. It must neither throw nor jump out, nor use the model it belongs to. It is
/// called many times at trial motions, which may be far from the solution.
///
/// @param state  time and motions of the points; valid during the call only
/// @param values  where the forces go, all zero at first; valid during the call only
/// @param user_data  as given to ::pdn_model_add_surface_force or ::pdn_model_add_line_force
/// @return 0 for success; anything else makes the solve fail with PDN_ERR_CALLBACK (see
///     ::pdn_set_callback_error and ::pdn_last_callback_code), as does a value that is not finite
pub type pdn_surface_force_fn = Option<
    unsafe extern "C" fn(
        state: *const pdn_surface_state,
        values: *mut pdn_surface_values,
        user_data: *mut c_void,
    ) -> i32,
>;

pub(super) type SurfaceFunction = unsafe extern "C" fn(
    state: *const pdn_surface_state,
    values: *mut pdn_surface_values,
    user_data: *mut c_void,
) -> i32;

/// Adds forces on shell elements that a function of the caller computes at the points of a
/// quadrature: a force, with an id of its own, for each element.
///
/// They act on the reference surface of the element, or on an edge of it, as loads do
/// (::pdn_model_add_shell_load): at as many points as it has nodes there.
///
/// @param model  the model; not NULL
/// @param first_element  id of the first shell element
/// @param elements  number of elements, from the first on; at least 1
/// @param place  PDN_SHELL_SURFACE, PDN_SHELL_EDGE_START_ETA, PDN_SHELL_EDGE_END_XI,
///     PDN_SHELL_EDGE_END_ETA or PDN_SHELL_EDGE_START_XI, of each of them
/// @param frame  PDN_FRAME_SPACE: velocities, forces and tangents are along the global axes;
///     PDN_FRAME_MATERIAL: along those of each point, so that a pressure is force 3 of a surface
/// @param tangents  PDN_TANGENTS_GIVEN if the function writes tangents, which
///     ::pdn_model_check_tangents checks; PDN_TANGENTS_DIFFERENCED if the library is to find them
///     by differences, at the price of 24 calls an element
/// @param function  the forces, see ::pdn_surface_force_fn for when it is called; not NULL
/// @param user_data  handed to the function; may be NULL
/// @param destroy  called once with user_data when the model, its copies in solutions included, no
///     longer needs it, on the thread that frees the last; may be NULL. It is not called if this
///     call fails
/// @param first_force  id of the force on the first element, which those on the others follow; may
///     be NULL if it is not wanted; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_SIZE, PDN_ERR_ID, PDN_ERR_VALUE
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_add_surface_force(
    model: *mut pdn_model,
    first_element: i32,
    elements: i32,
    place: i32,
    frame: i32,
    tangents: i32,
    function: pdn_surface_force_fn,
    user_data: *mut c_void,
    destroy: pdn_destroy_fn,
    first_force: *mut i32,
) -> pdn_status {
    let on = |_: &Call, model: &Model| {
        let first = Kind::ShellElement.index_in(model, first_element, "first_element")?;
        Ok((first, load_place(place)?.into(), load_frame(frame)?))
    };
    let law = (function, tangents, user_data, destroy);
    add(model, (on, elements), law, first_force)
}

/// Adds forces along beam elements that a function of the caller computes at the points of a
/// quadrature, such as those of the air on a blade: a force, with an id of its own, for each
/// element.
///
/// They act on the line of the beam, for each unit of its reference length, and move with the
/// sections, as loads do (::pdn_model_add_distributed_load): at as many points of Gauss as the
/// element has nodes. These are more while the error of the mesh is estimated, with elements of a
/// higher degree under the same ids. ::pdn_model_bind_surface_force gives a model from a file the
/// function again.
///
/// @param model  the model; not NULL
/// @param first_element  id of the first beam element, such as the first_element of a ::pdn_beam
/// @param elements  number of elements, from the first on, such as the elements of a ::pdn_beam; at
///     least 1
/// @param frame  PDN_FRAME_SPACE: velocities, forces and tangents are along the global axes;
///     PDN_FRAME_MATERIAL: along those of the section at each point, twisted as they are;
///     PDN_FRAME_UNTWISTED: along the axes of ::pdn_model_add_load_at_places, which rotations of
///     the points are then of, too
/// @param axis_2  array of length 3: direction, global coordinates, of any nonzero length, nowhere
///     along the line; read for PDN_FRAME_UNTWISTED only, else it may be NULL
/// @param tangents  PDN_TANGENTS_GIVEN if the function writes tangents, which
///     ::pdn_model_check_tangents checks; PDN_TANGENTS_DIFFERENCED if the library is to find them
///     by differences, at the price of 24 calls an element
/// @param function  the forces, see ::pdn_surface_force_fn for when it is called; not NULL
/// @param user_data  handed to the function; may be NULL
/// @param destroy  called once with user_data when the model, its copies in solutions included, no
///     longer needs it, on the thread that frees the last; may be NULL. It is not called if this
///     call fails
/// @param first_force  id of the force on the first element, which those on the others follow; may
///     be NULL if it is not wanted; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_SIZE, PDN_ERR_ID, PDN_ERR_VALUE
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_add_line_force(
    model: *mut pdn_model,
    first_element: i32,
    elements: i32,
    frame: i32,
    axis_2: *const f64,
    tangents: i32,
    function: pdn_surface_force_fn,
    user_data: *mut c_void,
    destroy: pdn_destroy_fn,
    first_force: *mut i32,
) -> pdn_status {
    let on = |call: &Call, model: &Model| {
        let first = Kind::BeamElement.index_in(model, first_element, "first_element")?;
        Ok(match beam_load_frame(call, frame, axis_2)? {
            BeamLoadFrame::Space => (first, ForcePlace::Line, LoadFrame::Space),
            BeamLoadFrame::Follower => (first, ForcePlace::Line, LoadFrame::Follower),
            BeamLoadFrame::Untwisted(axis_2) => {
                let place = ForcePlace::UntwistedLine(axis_2);
                (first, place, LoadFrame::Follower)
            }
        })
    };
    let law = (function, tangents, user_data, destroy);
    add(model, (on, elements), law, first_force)
}

/// Adds a force to each of so many elements, from the first on.
fn add(
    model: *mut pdn_model,
    (on, elements): (
        impl FnOnce(&Call, &Model) -> Result<(usize, ForcePlace, LoadFrame)>,
        i32,
    ),
    (function, tangents, user_data, destroy): (
        pdn_surface_force_fn,
        i32,
        *mut c_void,
        pdn_destroy_fn,
    ),
    first_force: *mut i32,
) -> pdn_status {
    guard(|call| {
        let mut model = call.exclusive(model, "model")?;
        let (first, place, frame) = on(call, &model)?;
        let elements = element_count(elements)?;
        let gives_tangents = gives_tangents(tangents)?;
        // All that could be refused comes before `user_data` is taken over.
        model.require_force_place((first, elements), place)?;
        let function = call.function(function, "function")?;
        let out = call.out_optional(first_force, "first_force")?;
        let id = Kind::Force.next(&model, elements, "force")?;
        let law = surface_force_law(function, (gives_tangents, frame), user_data, destroy);
        model.add_surface_forces(first, elements, place, law)?;
        if let Some(out) = out {
            out.set(id);
        }
        Ok(())
    })
}

/// Forces on an element that are the caller's function.
pub(super) fn surface_force_law(
    function: SurfaceFunction,
    (gives_tangents, frame): (bool, LoadFrame),
    user_data: *mut c_void,
    destroy: pdn_destroy_fn,
) -> SurfaceForceLaw {
    let callback = Callback::<SurfaceFunction>::new(function, user_data, destroy);
    SurfaceForceLaw {
        function: Arc::new(move |input, output| call_back(&callback, input, output)),
        gives_tangents,
        frame,
    }
}

fn call_back(
    callback: &Callback<SurfaceFunction>,
    input: &SurfaceForceInput,
    output: &mut SurfaceForceOutput,
) -> Result<()> {
    let kind = match input.place.on_shell() {
        None => Kind::BeamElement,
        Some(_) => Kind::ShellElement,
    };
    let state = pdn_surface_state {
        struct_size: size_of::<pdn_surface_state>(),
        time: input.time,
        element: kind.id(input.element),
        reserved: 0,
        point_count: input.positions.len(),
        places: input.places.as_ptr().cast(),
        sizes: input.sizes.as_ptr(),
        positions: input.positions.as_ptr().cast(),
        rotations: input.rotations.as_ptr().cast(),
        velocities: input.velocities.as_ptr().cast(),
    };
    let (by_motion, by_velocity) = match &mut output.tangents {
        Some([motion, velocity]) => (motion.as_mut_ptr().cast(), velocity.as_mut_ptr().cast()),
        None => (std::ptr::null_mut(), std::ptr::null_mut()),
    };
    let mut values = pdn_surface_values {
        struct_size: size_of::<pdn_surface_values>(),
        forces: output.forces.as_mut_ptr().cast(),
        by_motion,
        by_velocity,
    };
    callback.invoke("surface force", |function, user_data| {
        // SAFETY: the caller gave the function with its `user_data`; vectors and matrices of fixed
        // size are their numbers column by column, those of a slice one after the other.
        unsafe { function(&raw const state, &raw mut values, user_data) }
    })
}
