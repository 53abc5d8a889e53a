//! Forces on joint coordinates and between bodies: springs, dampers, actuators, viscoelastic
//! elements.
//!
//! All forces of a model, those of the user too, are numbered together.

use super::call::Call;
use super::id::Kind;
use super::joint::joint_coordinate;
use super::model::{add_object, body, motion, pdn_frame, pdn_model};
use super::signal::{self, pdn_signal};
use super::status::pdn_status;
use crate::elements::MaxwellBranch;
use crate::error::Result;
use crate::model::{JointCoordinate, Model, SpringDefinition};
use nalgebra::Matrix6;

/// Number of forces: springs, dampers, actuators and the like, but not loads; their ids follow each
/// other from PDN_FIRST_FORCE on.
///
/// @param model  the model; not NULL
/// @param count  the number; written on success only
/// @return PDN_OK, PDN_ERR_NULL
///
/// Threads: `model` is `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_force_count(
    model: *const pdn_model,
    count: *mut i32,
) -> pdn_status {
    super::model::count(model, count, Model::force_count)
}

/// Body of a function that adds a force on a joint coordinate.
fn add_on_coordinate<T>(
    model: *mut pdn_model,
    joint: i32,
    coordinate: i32,
    force: *mut i32,
    read: impl FnOnce(&Call) -> Result<T>,
    add: impl FnOnce(&mut Model, JointCoordinate, T) -> Result<usize>,
) -> pdn_status {
    add_object(
        model,
        Kind::Force,
        (force, "force"),
        |call, model| Ok((joint_coordinate(model, joint, coordinate)?, read(call)?)),
        |model, (at, given)| add(model, at, given),
    )
}

/// Adds a linear spring with a damper on a joint coordinate, in addition to those that are there.
///
/// It resists with stiffness * (coordinate - rest) + damping * its rate: with a force on a
/// displacement, with a moment on an angle. Whole turns count.
///
/// @param model  the model; not NULL
/// @param joint  id of the joint
/// @param coordinate  PDN_DISPLACEMENT, ... or PDN_ROTATION, ...; one that the joint has
/// @param stiffness  effort for a unit of the coordinate [force / length, or force * length]; may
///     be negative
/// @param damping  effort for a unit of its rate [force * time / length, or force * length * time];
///     may be negative, usually 0
/// @param rest  coordinate at which the spring is free of effort, usually 0 [length or radian]
/// @param force  the force's id; may be NULL if it is not wanted; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_ID, PDN_ERR_VALUE,
///     PDN_ERR_NOT_AVAILABLE
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_add_spring_damper(
    model: *mut pdn_model,
    joint: i32,
    coordinate: i32,
    stiffness: f64,
    damping: f64,
    rest: f64,
    force: *mut i32,
) -> pdn_status {
    let read = |call: &Call| {
        Ok([
            call.number(stiffness, "stiffness")?,
            call.number(damping, "damping")?,
            call.number(rest, "rest")?,
        ])
    };
    let add = |model: &mut Model, at, [stiffness, damping, rest]: [f64; 3]| {
        model.add_spring_damper(SpringDefinition {
            at,
            stiffness,
            damping,
            rest,
        })
    };
    add_on_coordinate(model, joint, coordinate, force, read, add)
}

/// Adds a nonlinear spring with a damper on a joint coordinate: polynomials of the coordinate and
/// its rate.
///
/// With u = coordinate - rest it resists with stiffness[0] u + stiffness[1] u^2 + ... + damping[0]
/// u' + damping[1] u'^2 + ..., so that {k, 0, k3} is a cubic spring. Whole turns count.
///
/// @param model  the model; not NULL
/// @param joint  id of the joint
/// @param coordinate  PDN_DISPLACEMENT, ... or PDN_ROTATION, ...; one that the joint has
/// @param stiffness  array of length [stiffness_count], copied; may be NULL if there are none
/// @param stiffness_count  number of powers of the coordinate, from the first
/// @param damping  array of length [damping_count], copied; may be NULL if there are none
/// @param damping_count  number of powers of its rate, from the first
/// @param rest  coordinate at which the spring is free of effort, usually 0 [length or radian]
/// @param force  the force's id; may be NULL if it is not wanted; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_SIZE, PDN_ERR_NOT_FINITE, PDN_ERR_ID, PDN_ERR_VALUE,
///     PDN_ERR_NOT_AVAILABLE
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_add_nonlinear_spring_damper(
    model: *mut pdn_model,
    joint: i32,
    coordinate: i32,
    stiffness: *const f64,
    stiffness_count: usize,
    damping: *const f64,
    damping_count: usize,
    rest: f64,
    force: *mut i32,
) -> pdn_status {
    let read = |call: &Call| {
        Ok((
            call.numbers(stiffness, stiffness_count, "stiffness")?
                .to_vec(),
            call.numbers(damping, damping_count, "damping")?.to_vec(),
            call.number(rest, "rest")?,
        ))
    };
    let add = |model: &mut Model, at, (stiffness, damping, rest): (Vec<f64>, Vec<f64>, f64)| {
        model.add_polynomial_spring_damper(at, &stiffness, &damping, rest)
    };
    add_on_coordinate(model, joint, coordinate, force, read, add)
}

/// Adds an actuator: a force on a displacement, or a torque on an angle, that follows a signal.
///
/// It acts on the second body of the joint towards growth of the coordinate, and its reaction on
/// the first. To prescribe the coordinate itself, see ::pdn_model_prescribe.
///
/// @param model  the model; not NULL
/// @param joint  id of the joint
/// @param coordinate  PDN_DISPLACEMENT, ... or PDN_ROTATION, ...; one that the joint has
/// @param signal  the effort in time [force, or force * length], copied; not NULL
/// @param force  the force's id; may be NULL if it is not wanted; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_SIZE, PDN_ERR_ID, PDN_ERR_VALUE,
///     PDN_ERR_STRUCT_SIZE, PDN_ERR_NOT_AVAILABLE
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_add_actuator(
    model: *mut pdn_model,
    joint: i32,
    coordinate: i32,
    signal: *const pdn_signal,
    force: *mut i32,
) -> pdn_status {
    let read = |call: &Call| signal::read(call, signal, "signal");
    let add = |model: &mut Model, at, signal| model.add_actuator(at, &signal);
    add_on_coordinate(model, joint, coordinate, force, read, add)
}

/// Adds a viscoelastic element on a joint coordinate: a generalised Maxwell model.
///
/// A spring, and beside it branches of spring and dashpot in series. With coordinate q it resists
/// with stiffness * (q - rest) + the sum over the branches b of branch_stiffness[b] a_b, where a_b,
/// the elongation of the branch's spring, relaxes: t_b a_b' + a_b = t_b q', with relaxation time
/// t_b. One branch makes it a Zener element, or standard linear solid. The internal states are
/// solved for with the motion, at the same grid points. Whole turns count; a coordinate that gains
/// turns needs stiffness 0.
///
/// @param model  the model; not NULL
/// @param joint  id of the joint
/// @param coordinate  PDN_DISPLACEMENT, ... or PDN_ROTATION, ...; one that the joint has
/// @param stiffness  that of the spring alone, the long-term stiffness
///     [force / length, or force * length]; may be negative
/// @param rest  coordinate at which it is free of effort [length or radian]
/// @param branch_stiffness  array of length [branches]: stiffness of each branch's spring, positive
/// @param relaxation_times  array of length [branches]: relaxation time of each branch, positive
///     [time]
/// @param branches  number of branches, at least 1
/// @param force  the force's id; may be NULL if it is not wanted; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_SIZE, PDN_ERR_NOT_FINITE, PDN_ERR_ID, PDN_ERR_VALUE,
///     PDN_ERR_NOT_AVAILABLE
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_add_viscoelastic(
    model: *mut pdn_model,
    joint: i32,
    coordinate: i32,
    stiffness: f64,
    rest: f64,
    branch_stiffness: *const f64,
    relaxation_times: *const f64,
    branches: usize,
    force: *mut i32,
) -> pdn_status {
    let read = |call: &Call| {
        let stiffness = call.number(stiffness, "stiffness")?;
        let rest = call.number(rest, "rest")?;
        let each = call.numbers(branch_stiffness, branches, "branch_stiffness")?;
        let times = call.numbers(relaxation_times, branches, "relaxation_times")?;
        let branches = each.iter().zip(times);
        let branches: Vec<_> = branches
            .map(|(&stiffness, &relaxation_time)| MaxwellBranch {
                stiffness,
                relaxation_time,
            })
            .collect();
        Ok((stiffness, rest, branches))
    };
    let add = |model: &mut Model, at, (stiffness, rest, branches): (f64, f64, Vec<_>)| {
        model.add_viscoelastic(at, stiffness, rest, &branches)
    };
    add_on_coordinate(model, joint, coordinate, force, read, add)
}

/// Adds a viscous damper between two bodies, with a full matrix of coefficients.
///
/// It exerts -matrix * v on the second body, and the reaction on the first, where v is the velocity
/// (linear 1, 2, 3, angular 1, 2, 3) of the second body relative to the first, at the origin of a
/// frame that is fixed to the second body. Velocity, force and moment are about and resolved in
/// that frame, wherever it moves.
///
/// @param model  the model; not NULL
/// @param first  id of the first node, or PDN_GROUND
/// @param second  id of the second node, or PDN_GROUND; not the same body
/// @param frame  the frame, where it is in the reference configuration; NULL for the second node's
///     own
/// @param matrix  array of shape 6 x 6: symmetric and positive semi-definite [force * time /
///     length, force * time, force * length * time]
/// @param force  the force's id; may be NULL if it is not wanted; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_ID, PDN_ERR_VALUE
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_add_viscous_damper(
    model: *mut pdn_model,
    first: i32,
    second: i32,
    frame: *const pdn_frame,
    matrix: *const f64,
    force: *mut i32,
) -> pdn_status {
    let read = |call: &Call, model: &Model| {
        let first = body(model, first, "first")?;
        let second = body(model, second, "second")?;
        let frame = if frame.is_null() {
            None
        } else {
            Some(motion(call, frame, "frame")?)
        };
        let matrix = Matrix6::from_column_slice(&call.array::<36>(matrix, "matrix")?);
        Ok((first, second, frame, matrix))
    };
    add_object(
        model,
        Kind::Force,
        (force, "force"),
        read,
        |model, (first, second, frame, matrix)| {
            model.add_viscous_damper(first, second, frame.as_ref(), &matrix)
        },
    )
}
