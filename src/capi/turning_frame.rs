//! A frame that turns steadily, in which a model is described.

use super::guard::guard;
use super::model::pdn_model;
use super::status::pdn_status;
use crate::error::{Error, ErrorKind};
use nalgebra::Vector3;

/// Describes everything in a frame that turns about a fixed axis at a constant rate, in place of
/// any set before: motions that repeat themselves but for a turn in each period are periodic there.
///
/// Positions, directions, rotations, prescribed motions and the ground are those in the frame, in
/// the model and in all results; at time zero its axes are the inertial ones. Velocities and
/// accelerations of nodes are those in the inertial frame, along the axes of the frame or of the
/// node, in results and in forces of yours on nodes and shells; rates of joints, and dampers, know
/// the motion in the frame only. Loads with PDN_FRAME_SPACE keep their directions in the frame.
/// Gravity must be along the axis: a solve refuses any other, unless the rate is zero.
///
/// A motion M of the frame is exp(axis rate t) M in the inertial one: it repeats itself after the
/// period T but for a turn of rate T. Supports that are no different when they turn about the axis,
/// such as a hinge along it, are those of the inertial frame; the turn in a period may be unknown:
/// a free parameter (PDN_NUMBER_FRAME_RATE) with a condition (::pdn_conditions_add_rotation_phase).
/// All analyses are in the frame: also statics, modes, marches and stability.
///
/// @param model  the model; not NULL
/// @param axis  array of length 3: direction of the axis, not zero
/// @param rate  angle in a unit of time \[rad/time\]; it may be zero
/// @param point  array of length 3: a point of the axis \[length\]; NULL for the origin
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_VALUE (no direction)
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_set_turning_frame(
    model: *mut pdn_model,
    axis: *const f64,
    rate: f64,
    point: *const f64,
) -> pdn_status {
    guard(|call| {
        let mut model = call.exclusive(model, "model")?;
        let axis = call.array::<3>(axis, "axis")?;
        let point = call.array_optional::<3>(point, "point")?;
        let rate = call.number(rate, "rate")?;
        let point = point.map_or(Vector3::zeros(), Vector3::from);
        model.set_turning_frame(&Vector3::from(axis), rate, &point)
    })
}

/// The frame that a model is described in, if it turns.
///
/// @param model  the model; not NULL
/// @param axis  array of length 3: direction of the axis, of length 1; written on success only
/// @param rate  angle in a unit of time \[rad/time\]; written on success only
/// @param point  array of length 3: a point of the axis \[length\]; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_AVAILABLE (it does not turn)
///
/// Threads: `model` is `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_turning_frame(
    model: *const pdn_model,
    axis: *mut f64,
    rate: *mut f64,
    point: *mut f64,
) -> pdn_status {
    guard(|call| {
        let model = call.shared(model, "model")?;
        let axis = call.out_slice(axis, 3, 3, "axis")?;
        let rate = call.out(rate, "rate")?;
        let point = call.out_slice(point, 3, 3, "point")?;
        let frame = model.turning_frame().ok_or_else(not_turning)?;
        axis.set(frame.axis().as_slice());
        rate.set(frame.rate());
        point.set(frame.point().as_slice());
        Ok(())
    })
}

/// Lets the frame that everything is described in advance along its axis at a constant speed, too:
/// motions that repeat themselves but for a translation in each period, or for a screw motion, are
/// periodic there. A frame of ::pdn_model_set_turning_frame with the rate zero only advances.
///
/// Inertial forces do not change by it. What sees it are velocities in the inertial frame: those of
/// nodes in results and in forces of yours on nodes, beams and shells, damping in proportion to
/// mass, energies and momenta. The ground that joints, springs and dampers hold on to moves along;
/// what stands still beside the way is described by forces of yours.
///
/// The speed may be unknown, a free parameter (PDN_NUMBER_FRAME_ADVANCE) with a condition
/// (::pdn_conditions_add_translation_phase): the drift of a motion that goes on.
///
/// @param model  the model, with a turning frame; not NULL
/// @param speed  speed along the axis \[length/time\]; zero after ::pdn_model_set_turning_frame
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_NOT_AVAILABLE (no turning frame)
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_set_frame_advance(
    model: *mut pdn_model,
    speed: f64,
) -> pdn_status {
    guard(|call| {
        let mut model = call.exclusive(model, "model")?;
        let speed = call.number(speed, "speed")?;
        model.set_frame_advance(speed)
    })
}

/// Speed along its axis of the frame that a model is described in.
///
/// @param model  the model; not NULL
/// @param speed  speed along the axis \[length/time\]; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_AVAILABLE (it is described in the inertial frame)
///
/// Threads: `model` is `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_frame_advance(
    model: *const pdn_model,
    speed: *mut f64,
) -> pdn_status {
    guard(|call| {
        let model = call.shared(model, "model")?;
        let speed = call.out(speed, "speed")?;
        let frame = model.turning_frame().ok_or_else(not_turning)?;
        speed.set(frame.advance());
        Ok(())
    })
}

fn not_turning() -> Error {
    let message = "model: it is described in the inertial frame";
    Error::new(ErrorKind::NotAvailable, message)
}
