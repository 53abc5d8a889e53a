//! Bushings and bearings.

use super::call::Call;
use super::id::Kind;
use super::model::{add_object, body, choose, motion, pdn_frame, pdn_model};
use super::status::pdn_status;
use crate::elements::BushingAngles;
use crate::model::Model;
use nalgebra::Matrix6;

/// A bushing measures rotations by the rotation vector; its angle stays below half a turn.
pub const PDN_ANGLES_ROTATION_VECTOR: i32 = 2100;
/// A bushing measures the tilt of axis 3, as a rotation vector about axes 1 and 2, and the rate of
/// the spin about axis 3, which may go on and on: for journal bearings and seals.
pub const PDN_ANGLES_TILT_AND_SPIN: i32 = 2101;

/// What C calls a way to measure rotations.
pub(super) fn angles_code(angles: BushingAngles) -> i32 {
    match angles {
        BushingAngles::RotationVector => PDN_ANGLES_ROTATION_VECTOR,
        BushingAngles::TiltAndSpin => PDN_ANGLES_TILT_AND_SPIN,
    }
}

/// Adds a bushing, a bearing or a seal: any matrices of stiffness and damping between two frames,
/// unsymmetric ones included.
///
/// With e the displacement of the second frame's origin and the angles of its turn, both relative
/// to the first frame and along its axes, the efforts against e are f = stiffness e + damping e'.
/// The first three are forces along the axes of the first frame, that act at the second frame's
/// origin, on both bodies; the others are moments that do the work of the angles: for small turns
/// moments about the axes of the first frame. So the axes of a journal bearing, with axis 3 along
/// the shaft, are those of its housing if that is the first body.
///
/// The matrices are column by column: stiffness[i + 6 j] is effort i for a unit of e[j]. Parameters
/// scale them: PDN_NUMBER_STIFFNESS and PDN_NUMBER_DAMPING with power 1 move a factor of each.
///
/// @param model  the model; not NULL
/// @param first  id of the first node, or PDN_GROUND
/// @param second  id of the second node, or PDN_GROUND; not the same body
/// @param first_frame  frame fixed to the first body, where it is in the reference configuration;
///     not NULL
/// @param second_frame  frame fixed to the second body, likewise; not NULL
/// @param stiffness  array of shape 6 x 6: stiffness [force / length, force, force * length]; with
///     PDN_ANGLES_TILT_AND_SPIN its last column is zero
/// @param damping  array of shape 6 x 6: damping [the same times time]
/// @param angles  PDN_ANGLES_ROTATION_VECTOR or PDN_ANGLES_TILT_AND_SPIN
/// @param force  the force's id; may be NULL if it is not wanted; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_ID, PDN_ERR_VALUE
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_add_bushing(
    model: *mut pdn_model,
    first: i32,
    second: i32,
    first_frame: *const pdn_frame,
    second_frame: *const pdn_frame,
    stiffness: *const f64,
    damping: *const f64,
    angles: i32,
    force: *mut i32,
) -> pdn_status {
    let read = |call: &Call, model: &Model| {
        let bodies = [body(model, first, "first")?, body(model, second, "second")?];
        let frames = [
            motion(call, first_frame, "first_frame")?,
            motion(call, second_frame, "second_frame")?,
        ];
        let matrices = [
            Matrix6::from_column_slice(&call.array::<36>(stiffness, "stiffness")?),
            Matrix6::from_column_slice(&call.array::<36>(damping, "damping")?),
        ];
        let table = [BushingAngles::RotationVector, BushingAngles::TiltAndSpin];
        let table = table.map(|angles| (angles_code(angles), angles));
        let expected = "PDN_ANGLES_ROTATION_VECTOR or PDN_ANGLES_TILT_AND_SPIN";
        let angles = choose(&table, angles, "angles", expected)?;
        Ok((bodies, frames, matrices, angles))
    };
    let add = |model: &mut Model,
               (bodies, [first, second], [k, c], angles): (_, [_; 2], [_; 2], _)| {
        model.add_bushing(bodies, [&first, &second], [&k, &c], angles)
    };
    add_object(model, Kind::Force, (force, "force"), read, add)
}
