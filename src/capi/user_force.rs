//! Forces that functions of the caller compute, and the check of their tangents.

use super::call::Call;
use super::callback::Callback;
use super::guard::{guard, init};
use super::id::Kind;
use super::joint::joint_coordinate;
use super::load::{PDN_FORCE_1, load_frame};
use super::model::{self, add_object, pdn_model};
use super::options::Options;
use super::pointer::check_pointer;
use super::status::pdn_status;
use crate::elements::{
    CoordinateLaw, Effort, LoadFrame, NodeForceInput, NodeForceLaw, NodeForceOutput, Tangent,
};
use crate::error::{Error, Result};
use crate::model::Model;
use crate::system::{TangentCheck, check_tangents};
use libc::c_void;
use std::sync::Arc;

/// Tangents of a user's function: it gives none, and the library finds them by differences of its
/// forces.
pub const PDN_TANGENTS_DIFFERENCED: i32 = 2200;
/// Tangents of a user's function: it gives them.
pub const PDN_TANGENTS_GIVEN: i32 = 2201;

/// Which tangent: derivative by a motion or coordinate.
pub const PDN_TANGENT_MOTION: i32 = 2300;
/// Which tangent: derivative by a velocity or rate.
pub const PDN_TANGENT_VELOCITY: i32 = 2301;

/// A law of effort on a joint coordinate, to be written by the caller.
///
/// Called on the thread that solves, with times in [0, T) of the period T of the solve; if two
/// threads solve at once, on both at once. The same arguments must give the same values; over time
/// the law must repeat with the period, and where its coordinate gains whole turns in a period,
/// with these. Solves refuse what does not, with PDN_ERR_NOT_PERIODIC: for that they call it first
/// a few times at one motion, at times in [0, 2 T). It must neither throw nor jump out, nor use the
/// model it belongs to.
///
/// @param time  in [0, T), but for these first calls
/// @param coordinate  of the joint, an angle with its whole turns [length or radian]
/// @param rate  its rate
/// @param effort  where the effort goes that resists growth of the coordinate
///     [force on a displacement,     force * length on an angle]; not NULL
/// @param derivatives  array of length 2: where the derivatives of the effort by coordinate and
///     rate go. NULL if they are not wanted, or the law was said to give none
/// @param user_data  as given to ::pdn_model_add_coordinate_law
/// @return 0 for success; anything else makes the solve fail with PDN_ERR_CALLBACK (see
///     ::pdn_set_callback_error and ::pdn_last_callback_code), as does a value that is not finite
pub type pdn_coordinate_law_fn = Option<
    unsafe extern "C" fn(
        time: f64,
        coordinate: f64,
        rate: f64,
        effort: *mut f64,
        derivatives: *mut f64,
        user_data: *mut c_void,
    ) -> i32,
>;

pub(super) type CoordinateFunction =
    unsafe extern "C" fn(f64, f64, f64, *mut f64, *mut f64, *mut c_void) -> i32;

/// What a user's forces on nodes may depend on. The library makes it; a later one may add fields at
/// its end.
///
/// Nodes are in the order they were given to ::pdn_model_add_user_force.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct pdn_force_state {
    /// Size of the struct that the library knows.
    pub struct_size: usize,
    /// Time, in [0, T) of the period T of the solve, but for the first calls of a solve
    /// (::pdn_user_force_fn).
    pub time: f64,
    /// Number of nodes.
    pub node_count: usize,
    /// Array of shape 3 x [node_count]: positions, global coordinates [length].
    pub positions: *const f64,
    /// Array of shape 9 x [node_count]: rotation matrices, column by column; the columns are the
    /// nodes' axes in global coordinates.
    pub rotations: *const f64,
    /// Array of shape 6 x [node_count]: velocity and angular velocity of each node relative to the
    /// inertial frame, also in a steady rotation (::pdn_solve_static), along the global axes
    /// (PDN_FRAME_SPACE) or the node's own (PDN_FRAME_MATERIAL).
    pub velocities: *const f64,
    /// Nodes whose motions tangents are by: all, as many as [node_count], or 1, the own node of
    /// each force, where nodes were declared apart (::pdn_model_declare_nodes_apart).
    pub column_count: usize,
}

/// Where a user's forces go. The library makes it, with all arrays set to zero; a later one may add
/// fields.
///
/// Everything is along the same axes as the velocities. Row and column of the tangents count force
/// 1, 2, 3, moment 1, 2, 3 and displacement 1, 2, 3, turn 1, 2, 3 of each node together; a turn is
/// an infinitesimal rotation. Derivatives by motion are at fixed components of the velocities.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct pdn_force_values {
    /// Size of the struct that the library knows.
    pub struct_size: usize,
    /// Array of shape 6 x [node_count]: force on each node and moment about it
    /// [force, force * length].
    pub forces: *mut f64,
    /// Array of shape 6 x [node_count] x 6 x [column_count], column by column: derivatives of
    /// forces by displacements and turns: of all nodes or, where nodes were declared apart, of the
    /// own node of each force. NULL if tangents are not wanted, or were said not to be given.
    pub by_motion: *mut f64,
    /// The same by velocities and angular velocities; NULL where by_motion is.
    pub by_velocity: *mut f64,
}

const _: () = assert!(size_of::<pdn_force_state>() == 56 && size_of::<pdn_force_values>() == 32);

/// Forces on nodes, to be computed by the caller.
///
/// Called on the thread that solves; if two threads solve at once, on both at once. The same state
/// must give the same forces, and over time they must repeat with the period: solves call it first
/// a few times at one motion, at times in [0, 2 T), and refuse what does not with
/// PDN_ERR_NOT_PERIODIC. It must neither throw nor jump out, nor use the model it belongs to. It is
/// called many times at trial motions, which may be far from the solution.
///
/// @param state  time and motions of the nodes; valid during the call only
/// @param values  where the forces go, all zero at first; valid during the call only
/// @param user_data  as given to ::pdn_model_add_user_force
/// @return 0 for success; anything else makes the solve fail with PDN_ERR_CALLBACK (see
///     ::pdn_set_callback_error and ::pdn_last_callback_code), as does a value that is not finite
pub type pdn_user_force_fn = Option<
    unsafe extern "C" fn(
        state: *const pdn_force_state,
        values: *mut pdn_force_values,
        user_data: *mut c_void,
    ) -> i32,
>;

pub(super) type UserForceFunction = unsafe extern "C" fn(
    state: *const pdn_force_state,
    values: *mut pdn_force_values,
    user_data: *mut c_void,
) -> i32;

/// Disposes of the `user_data` of a force; see ::pdn_model_add_user_force for when it is called.
pub type pdn_destroy_fn = Option<unsafe extern "C" fn(user_data: *mut c_void)>;

pub(super) fn gives_tangents(given: i32) -> Result<bool> {
    match given {
        PDN_TANGENTS_DIFFERENCED => Ok(false),
        PDN_TANGENTS_GIVEN => Ok(true),
        _ => {
            let expected = "PDN_TANGENTS_DIFFERENCED or PDN_TANGENTS_GIVEN";
            Err(Error::value("tangents", expected, given))
        }
    }
}

/// Adds a spring-damper on a joint coordinate whose law is a function of the caller.
///
/// Its effort, a force on a displacement or a moment on an angle, resists growth of the coordinate
/// as that of ::pdn_model_add_spring_damper does. It may depend on coordinate, rate and time.
///
/// @param model  the model; not NULL
/// @param joint  id of the joint
/// @param coordinate  PDN_DISPLACEMENT, ... or PDN_ROTATION, ...; one that the joint has
/// @param tangents  PDN_TANGENTS_GIVEN if the function writes derivatives, which
///     ::pdn_model_check_tangents checks; PDN_TANGENTS_DIFFERENCED if the library is to find them
///     by differences
/// @param function  the law, see ::pdn_coordinate_law_fn for when it is called; not NULL
/// @param user_data  handed to the function; may be NULL
/// @param destroy  called once with user_data when the model, its copies in solutions included, no
///     longer needs it, on the thread that frees the last; may be NULL. It is not called if this
///     call fails
/// @param force  the force's id; may be NULL if it is not wanted; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID, PDN_ERR_VALUE, PDN_ERR_NOT_AVAILABLE
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_add_coordinate_law(
    model: *mut pdn_model,
    joint: i32,
    coordinate: i32,
    tangents: i32,
    function: pdn_coordinate_law_fn,
    user_data: *mut c_void,
    destroy: pdn_destroy_fn,
    force: *mut i32,
) -> pdn_status {
    let read = |call: &Call, model: &Model| {
        let at = joint_coordinate(model, joint, coordinate)?;
        // All that could be refused comes before `user_data` is taken over.
        model.require_coordinate(&at)?;
        let gives_derivatives = gives_tangents(tangents)?;
        Ok((at, gives_derivatives, call.function(function, "function")?))
    };
    add_object(
        model,
        Kind::Force,
        (force, "force"),
        read,
        |model, (at, gives_derivatives, function)| {
            let law = coordinate_law(function, gives_derivatives, user_data, destroy);
            model.add_coordinate_law(at, law)
        },
    )
}

/// Adds forces on nodes that a function of the caller computes.
///
/// @param model  the model; not NULL
/// @param nodes  array of length [count]: ids of the nodes, all different
/// @param count  number of nodes, at least 1
/// @param frame  PDN_FRAME_SPACE: velocities, forces and tangents are along the global axes;
///     PDN_FRAME_MATERIAL: along those of each node
/// @param tangents  PDN_TANGENTS_GIVEN if the function writes tangents, which
///     ::pdn_model_check_tangents checks; PDN_TANGENTS_DIFFERENCED if the library is to find them
///     by differences, at the price of 24 calls a node, or 24 for all where
///     ::pdn_model_declare_nodes_apart says that no node matters to others
/// @param function  the forces, see ::pdn_user_force_fn for when it is called; not NULL
/// @param user_data  handed to the function; may be NULL
/// @param destroy  called once with user_data when the model, its copies in solutions included, no
///     longer needs it, on the thread that frees the last; may be NULL. It is not called if this
///     call fails
/// @param force  the force's id; may be NULL if it is not wanted; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_SIZE, PDN_ERR_ID, PDN_ERR_VALUE
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_add_user_force(
    model: *mut pdn_model,
    nodes: *const i32,
    count: usize,
    frame: i32,
    tangents: i32,
    function: pdn_user_force_fn,
    user_data: *mut c_void,
    destroy: pdn_destroy_fn,
    force: *mut i32,
) -> pdn_status {
    let read = |call: &Call, model: &Model| {
        check_pointer(nodes, 1, "nodes")?;
        if count == 0 || count > model.node_count() {
            let expected = format!("1 to {} (the number of nodes)", model.node_count());
            return Err(Error::size("count", expected, count));
        }
        let nodes = model::nodes(call, model, (nodes, count), "nodes")?;
        // All that could be refused comes before `user_data` is taken over.
        model.require_distinct_nodes(&nodes)?;
        let frame = load_frame(frame)?;
        let gives_tangents = gives_tangents(tangents)?;
        let function = call.function(function, "function")?;
        Ok((nodes, frame, gives_tangents, function))
    };
    add_object(
        model,
        Kind::Force,
        (force, "force"),
        read,
        |model, (nodes, frame, gives_tangents, function)| {
            let law = node_force_law(function, (gives_tangents, frame), user_data, destroy);
            model.add_node_forces(&nodes, law)
        },
    )
}

/// Declares that the force on each node of a function's force depends on time and on the motion of
/// this node alone, as that of the air on points of a wing by strips does.
///
/// Then the force couples no nodes with each other, so that solves take less time; tangents are of
/// each force by its own node (pdn_force_state), and differences of all nodes are found at once, by
/// 24 calls. Solves compare a few calls and refuse, with PDN_ERR_MODEL, forces that are not so.
///
/// @param model  the model; not NULL
/// @param force  id of a force by ::pdn_model_add_user_force
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID, PDN_ERR_NOT_AVAILABLE (it is none of these)
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_declare_nodes_apart(
    model: *mut pdn_model,
    force: i32,
) -> pdn_status {
    guard(|call| {
        let mut model = call.exclusive(model, "model")?;
        let force = Kind::Force.index_in(&model, force, "force")?;
        model.declare_nodes_apart(force)
    })
}

/// A law of effort that is the caller's function.
pub(super) fn coordinate_law(
    function: CoordinateFunction,
    gives_derivatives: bool,
    user_data: *mut c_void,
    destroy: pdn_destroy_fn,
) -> CoordinateLaw {
    let callback = Callback::<CoordinateFunction>::new(function, user_data, destroy);
    let function = move |at: &crate::elements::CoordinateState| {
        // What the function leaves unwritten is found out.
        let mut effort = f64::NAN;
        let mut derivatives = [f64::NAN; 2];
        callback.invoke("coordinate law", |function, user_data| {
            let wanted = match gives_derivatives {
                true => derivatives.as_mut_ptr(),
                false => std::ptr::null_mut(),
            };
            let effort = &raw mut effort;
            // SAFETY: the caller gave the function with its `user_data`; it writes three numbers.
            unsafe { function(at.time, at.value, at.rate, effort, wanted, user_data) }
        })?;
        Ok(Effort {
            value: effort,
            by_coordinate: derivatives[0],
            by_rate: derivatives[1],
        })
    };
    CoordinateLaw {
        function: Arc::new(function),
        gives_derivatives,
    }
}

/// Forces on nodes that are the caller's function.
pub(super) fn node_force_law(
    function: UserForceFunction,
    (gives_tangents, frame): (bool, LoadFrame),
    user_data: *mut c_void,
    destroy: pdn_destroy_fn,
) -> NodeForceLaw {
    let callback = Callback::<UserForceFunction>::new(function, user_data, destroy);
    NodeForceLaw {
        function: Arc::new(move |input, output| call_back(&callback, input, output)),
        gives_tangents,
        frame,
    }
}

fn call_back(
    callback: &Callback<UserForceFunction>,
    input: &NodeForceInput,
    output: &mut NodeForceOutput,
) -> Result<()> {
    let state = pdn_force_state {
        struct_size: size_of::<pdn_force_state>(),
        time: input.time,
        node_count: input.positions.len(),
        positions: input.positions.as_ptr().cast(),
        rotations: input.rotations.as_ptr().cast(),
        velocities: input.velocities.as_ptr().cast(),
        column_count: input.columns,
    };
    let (by_motion, by_velocity) = match &mut output.tangents {
        Some((motion, velocity)) => (
            motion.as_mut_slice().as_mut_ptr(),
            velocity.as_mut_slice().as_mut_ptr(),
        ),
        None => (std::ptr::null_mut(), std::ptr::null_mut()),
    };
    let mut values = pdn_force_values {
        struct_size: size_of::<pdn_force_values>(),
        forces: output.forces.as_mut_ptr().cast(),
        by_motion,
        by_velocity,
    };
    callback.invoke("user force", |function, user_data| {
        // SAFETY: the caller gave the function with its `user_data`; vectors and matrices of fixed
        // size are their numbers column by column, those of a slice one after the other.
        unsafe { function(&raw const state, &raw mut values, user_data) }
    })
}

/// Where the tangents of a user's function differ most from differences of its forces.
///
/// Initialise with `PDN_INIT(pdn_tangent_check, &check)`.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct pdn_tangent_check {
    /// Set by the initialiser.
    pub struct_size: usize,
    /// Largest difference, relative to the largest tangent; lengths, angles and velocities are
    /// taken relative to what is characteristic of the model and the period. Tangents that are
    /// right leave about 1e-8.
    pub error: f64,
    /// Time of the state it was found at.
    pub time: f64,
    /// The derivative that the function gives there.
    pub given: f64,
    /// What differences of its forces give.
    pub differenced: f64,
    /// PDN_TANGENT_MOTION or PDN_TANGENT_VELOCITY.
    pub tangent: i32,
    /// Node of the force that is differentiated; of one on a shell, number of the point from 0; -1
    /// for an effort on a joint coordinate.
    pub row_node: i32,
    /// Its component, PDN_FORCE_1, ... PDN_MOMENT_3; 0 for an effort.
    pub row_component: i32,
    /// Node of the motion or velocity that it is differentiated by, or point; -1 for a joint
    /// coordinate.
    pub column_node: i32,
    /// Its component: 0, 1, 2 linear, 3, 4, 5 angular; 0 for a joint coordinate.
    pub column_component: i32,
    /// Zero.
    pub reserved: i32,
}

// SAFETY: all fields are plain numbers, `struct_size` is the first, no padding.
unsafe impl Options for pdn_tangent_check {
    const SIZES: &'static [usize] = &[64];

    fn defaults() -> Self {
        pdn_tangent_check {
            tangent: PDN_TANGENT_MOTION,
            ..Self::blank()
        }
    }
}

/// Prepares a struct for ::pdn_model_check_tangents; use `PDN_INIT(pdn_tangent_check, &check)`.
///
/// @param check  the struct; not NULL
/// @param struct_size  `sizeof *check`
///
/// Threads: any.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_tangent_check_init(check: *mut pdn_tangent_check, struct_size: usize) {
    init(check, struct_size, "check");
}

/// Compares the tangents that a user's function gives with differences of its forces.
///
/// At a few states: nodes near their reference configuration, or a coordinate near its own, with
/// velocities as they are in motions of the period; the same states in each call. Wrong tangents do
/// not make solutions wrong, but Newton's method slow, or fail.
///
/// @param model  the model; not NULL
/// @param force  id of a force by ::pdn_model_add_coordinate_law, ::pdn_model_add_user_force,
///     ::pdn_model_add_controller, ::pdn_model_add_surface_force or ::pdn_model_add_line_force
/// @param period  the period that the model is to be solved for, positive [time]
/// @param check  initialised by PDN_INIT; filled on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE, PDN_ERR_ID, PDN_ERR_VALUE,
///     PDN_ERR_NOT_FINITE, PDN_ERR_MODEL, PDN_ERR_NOT_PERIODIC (as for a solve),
///     PDN_ERR_NOT_AVAILABLE (it gives no tangents), PDN_ERR_CALLBACK
///
/// Threads: like `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_check_tangents(
    model: *const pdn_model,
    force: i32,
    period: f64,
    check: *mut pdn_tangent_check,
) -> pdn_status {
    guard(|call| {
        let model = call.shared(model, "model")?;
        let force = Kind::Force.index_in(&model, force, "force")?;
        let period = call.number(period, "period")?;
        let out = call.out_struct(check, "check")?;
        let TangentCheck {
            error,
            time,
            tangent,
            row,
            column,
            given,
            differenced,
        } = check_tangents(&model, force, period)?;
        let place =
            |at: Option<(usize, usize)>| at.map_or((-1, 0), |(n, i)| (Kind::Node.id(n), i as i32));
        let ((row_node, _), (column_node, column_component)) = (place(row), place(column));
        out.set(pdn_tangent_check {
            error,
            time,
            given,
            differenced,
            tangent: match tangent {
                Tangent::Stiffness => PDN_TANGENT_MOTION,
                Tangent::Damping => PDN_TANGENT_VELOCITY,
            },
            row_node,
            // Of an effort it is none.
            row_component: row.map_or(0, |(_, i)| PDN_FORCE_1 + i as i32),
            column_node,
            column_component,
            ..pdn_tangent_check::defaults()
        });
        Ok(())
    })
}
