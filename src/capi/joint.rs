//! Joints: lower pairs and others, between two bodies or a body and the ground.

use super::call::Call;
use super::guard::guard;
use super::handle::Exclusive;
use super::id::Kind;
use super::model::{add_object, body, choose, motion, pdn_frame, pdn_model, vector};
use super::signal::{self, pdn_signal};
use super::status::pdn_status;
use crate::elements::{Coordinate, JointKind};
use crate::error::Result;
use crate::model::{JointCoordinate, Model, Signal};
use crate::motion::Motion;
use nalgebra::Matrix3;

/// Joint that allows no relative motion.
pub const PDN_JOINT_RIGID: i32 = 1300;
/// Joint that allows a rotation about axis 3 of its frames.
pub const PDN_JOINT_REVOLUTE: i32 = 1301;
/// Joint that allows a rotation about axis 1 of its first frame, then about axis 2 of its second.
pub const PDN_JOINT_UNIVERSAL: i32 = 1302;
/// Joint that allows all rotations.
pub const PDN_JOINT_SPHERICAL: i32 = 1303;
/// Joint that allows a displacement along axis 3 of its frames.
pub const PDN_JOINT_PRISMATIC: i32 = 1304;
/// Joint that allows a displacement along axis 3 of its frames and a rotation about it.
pub const PDN_JOINT_CYLINDRICAL: i32 = 1305;
/// Joint that allows displacements along axes 1 and 2 of its first frame and a rotation about axis
/// 3.
pub const PDN_JOINT_PLANAR: i32 = 1306;
/// Joint that allows everything: it carries springs, prescribed coordinates and measures.
pub const PDN_JOINT_FREE: i32 = 1307;

/// Joint that allows a displacement along axis 3 of its frames, in proportion to the rotation about
/// it; made by functions of its own, for its pitch.
pub const PDN_JOINT_SCREW: i32 = 1308;
/// The line between two points, which constrains nothing; made by ::pdn_model_add_strut.
pub const PDN_JOINT_STRUT: i32 = 1309;

/// Joint coordinate: the displacement, or the first of several.
pub const PDN_DISPLACEMENT: i32 = 1400;
/// Joint coordinate: second displacement of a planar or free joint.
pub const PDN_DISPLACEMENT_2: i32 = 1401;
/// Joint coordinate: third displacement of a free joint.
pub const PDN_DISPLACEMENT_3: i32 = 1402;
/// Joint coordinate: the angle, or the first of several.
pub const PDN_ROTATION: i32 = 1403;
/// Joint coordinate: second angle of a universal, spherical or free joint.
pub const PDN_ROTATION_2: i32 = 1404;
/// Joint coordinate: third angle of a spherical or free joint.
pub const PDN_ROTATION_3: i32 = 1405;

/// The joint coordinate that a `PDN_DISPLACEMENT...` or `PDN_ROTATION...` names; whether the joint
/// has it is for the core.
pub(super) fn coordinate(given: i32, name: &str) -> Result<Coordinate> {
    use Coordinate::{
        Displacement1, Displacement2, Displacement3, Rotation1, Rotation2, Rotation3,
    };
    let all = [
        Displacement1,
        Displacement2,
        Displacement3,
        Rotation1,
        Rotation2,
        Rotation3,
    ];
    let table = all.map(|coordinate| (coordinate_code(coordinate), coordinate));
    let expected = "PDN_DISPLACEMENT, _2, _3 or PDN_ROTATION, _2, _3";
    choose(&table, given, name, expected)
}

/// What C calls a joint coordinate.
pub(super) fn coordinate_code(coordinate: Coordinate) -> i32 {
    match coordinate {
        Coordinate::Displacement1 => PDN_DISPLACEMENT,
        Coordinate::Displacement2 => PDN_DISPLACEMENT_2,
        Coordinate::Displacement3 => PDN_DISPLACEMENT_3,
        Coordinate::Rotation1 => PDN_ROTATION,
        Coordinate::Rotation2 => PDN_ROTATION_2,
        Coordinate::Rotation3 => PDN_ROTATION_3,
    }
}

/// What C calls a kind of joint.
pub(super) fn joint_code(kind: JointKind) -> i32 {
    match kind {
        JointKind::Rigid => PDN_JOINT_RIGID,
        JointKind::Revolute => PDN_JOINT_REVOLUTE,
        JointKind::Universal => PDN_JOINT_UNIVERSAL,
        JointKind::Spherical => PDN_JOINT_SPHERICAL,
        JointKind::Prismatic => PDN_JOINT_PRISMATIC,
        JointKind::Cylindrical => PDN_JOINT_CYLINDRICAL,
        JointKind::Planar => PDN_JOINT_PLANAR,
        JointKind::Free => PDN_JOINT_FREE,
        JointKind::Screw { .. } => PDN_JOINT_SCREW,
        JointKind::Strut => PDN_JOINT_STRUT,
    }
}

fn joint_kind(given: i32) -> Result<JointKind> {
    let all = [
        JointKind::Rigid,
        JointKind::Revolute,
        JointKind::Universal,
        JointKind::Spherical,
        JointKind::Prismatic,
        JointKind::Cylindrical,
        JointKind::Planar,
        JointKind::Free,
    ];
    let table = all.map(|kind| (joint_code(kind), kind));
    choose(&table, given, "kind", "PDN_JOINT_RIGID to PDN_JOINT_FREE")
}

/// The bodies of a joint, by the ids that C gave.
struct Bodies {
    first: i32,
    second: i32,
}

/// Body of a function that adds a joint, between the two frames that `frames` gives.
fn add_joint(
    model: *mut pdn_model,
    bodies: Bodies,
    joint: *mut i32,
    frames: impl FnOnce(&Call) -> Result<(JointKind, Motion, Motion)>,
) -> pdn_status {
    add_object(
        model,
        Kind::Joint,
        (joint, "joint"),
        |call, model| {
            let first = body(model, bodies.first, "first")?;
            let second = body(model, bodies.second, "second")?;
            Ok((first, second, frames(call)?))
        },
        |model, (first, second, (kind, first_frame, second_frame))| {
            model.add_joint(kind, first, second, &first_frame, &second_frame)
        },
    )
}

/// The frame at a point with axis 3 along an axis.
fn axis_frame(call: &Call, point: *const f64, axis: *const f64, name: &str) -> Result<Motion> {
    let point = vector(call, point, "point")?;
    let axis = vector(call, axis, name)?;
    Model::frame_at(name, &point, &axis)
}

/// The joint coordinate that two arguments give.
pub(super) fn joint_coordinate(
    model: &Model,
    joint: i32,
    coordinate: i32,
) -> Result<JointCoordinate> {
    Ok(JointCoordinate {
        joint: Kind::Joint.index_in(model, joint, "joint")?,
        coordinate: self::coordinate(coordinate, "coordinate")?,
    })
}

/// Makes a joint coordinate follow a signal. Each coordinate can be prescribed once.
///
/// The signal of an angle may grow by whole turns in a period, save that of a screw.
///
/// @param model  the model; not NULL
/// @param joint  id of the joint
/// @param coordinate  PDN_DISPLACEMENT ... PDN_ROTATION_3; one that the joint has
/// @param signal  the coordinate in time [length, or radian], copied; not NULL
/// @param prescribed  id of the prescribed coordinate; may be NULL if it is not wanted; written on
///     success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_SIZE, PDN_ERR_ID, PDN_ERR_VALUE,
///     PDN_ERR_STRUCT_SIZE, PDN_ERR_NOT_AVAILABLE
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_prescribe(
    model: *mut pdn_model,
    joint: i32,
    coordinate: i32,
    signal: *const pdn_signal,
    prescribed: *mut i32,
) -> pdn_status {
    let read = |call: &Call, model: &Model| {
        let at = joint_coordinate(model, joint, coordinate)?;
        Ok((at, signal::read(call, signal, "signal")?))
    };
    let add = |model: &mut Model, (at, signal): (_, Signal)| model.prescribe(at, &signal);
    add_object(
        model,
        Kind::Prescribed,
        (prescribed, "prescribed"),
        read,
        add,
    )
}

/// Fixes two bodies to each other.
///
/// Its frames are at the point, with axes parallel to the global ones in the reference
/// configuration. It has no coordinates.
///
/// @param model  the model; not NULL
/// @param first  id of the first node, or PDN_GROUND
/// @param second  id of the second node, or PDN_GROUND; not the same body
/// @param point  array of length 3: where the reaction is reported, global coordinates [length]
/// @param joint  the joint's id; may be NULL if it is not wanted; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_ID, PDN_ERR_VALUE
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_add_rigid_joint(
    model: *mut pdn_model,
    first: i32,
    second: i32,
    point: *const f64,
    joint: *mut i32,
) -> pdn_status {
    add_joint(model, Bodies { first, second }, joint, |call| {
        let point = vector(call, point, "point")?;
        let frame = Motion::new(Matrix3::identity(), point);
        Ok((JointKind::Rigid, frame, frame))
    })
}

/// Joins two bodies by a hinge.
///
/// Its frames are at the point, with axis 3 along the axis. Its coordinate PDN_ROTATION is the
/// angle by which the second body has turned relative to the first, about the axis by the
/// right-hand rule, since the reference configuration, where it is zero; it counts whole turns.
///
/// @param model  the model; not NULL
/// @param first  id of the first node, or PDN_GROUND
/// @param second  id of the second node, or PDN_GROUND; not the same body
/// @param point  array of length 3: a point of the axis, global coordinates [length]
/// @param axis  array of length 3: direction of the axis, global coordinates, of any nonzero length
/// @param joint  the joint's id; may be NULL if it is not wanted; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_ID, PDN_ERR_VALUE
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_add_revolute(
    model: *mut pdn_model,
    first: i32,
    second: i32,
    point: *const f64,
    axis: *const f64,
    joint: *mut i32,
) -> pdn_status {
    add_joint(model, Bodies { first, second }, joint, |call| {
        let frame = axis_frame(call, point, axis, "axis")?;
        Ok((JointKind::Revolute, frame, frame))
    })
}

/// Joins two bodies by a slider.
///
/// Its frames are at the point, with axis 3 along the axis. Its coordinate PDN_DISPLACEMENT is the
/// distance by which the second body has moved relative to the first, along the axis, since the
/// reference configuration, where it is zero. The bodies do not turn relative to each other.
///
/// @param model  the model; not NULL
/// @param first  id of the first node, or PDN_GROUND
/// @param second  id of the second node, or PDN_GROUND; not the same body
/// @param point  array of length 3: a point of the axis, global coordinates [length]
/// @param axis  array of length 3: direction of the axis, global coordinates, of any nonzero length
/// @param joint  the joint's id; may be NULL if it is not wanted; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_ID, PDN_ERR_VALUE
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_add_prismatic(
    model: *mut pdn_model,
    first: i32,
    second: i32,
    point: *const f64,
    axis: *const f64,
    joint: *mut i32,
) -> pdn_status {
    add_joint(model, Bodies { first, second }, joint, |call| {
        let frame = axis_frame(call, point, axis, "axis")?;
        Ok((JointKind::Prismatic, frame, frame))
    })
}

/// Joins two bodies by a shaft in a sleeve: one slides along the axis and turns about it.
///
/// Its frames are at the point, with axis 3 along the axis. Its coordinates PDN_DISPLACEMENT and
/// PDN_ROTATION are the distance and the angle by which the second body has moved relative to the
/// first, along the axis and about it by the right-hand rule, since the reference configuration,
/// where they are zero.
///
/// @param model  the model; not NULL
/// @param first  id of the first node, or PDN_GROUND
/// @param second  id of the second node, or PDN_GROUND; not the same body
/// @param point  array of length 3: a point of the axis, global coordinates [length]
/// @param axis  array of length 3: direction of the axis, global coordinates, of any nonzero length
/// @param joint  the joint's id; may be NULL if it is not wanted; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_ID, PDN_ERR_VALUE
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_add_cylindrical(
    model: *mut pdn_model,
    first: i32,
    second: i32,
    point: *const f64,
    axis: *const f64,
    joint: *mut i32,
) -> pdn_status {
    add_joint(model, Bodies { first, second }, joint, |call| {
        let frame = axis_frame(call, point, axis, "axis")?;
        Ok((JointKind::Cylindrical, frame, frame))
    })
}

/// Joins two bodies by a screw: the second advances along the axis as it turns about it.
///
/// Its frames are at the point, with axis 3 along the axis. Its coordinates are those of a
/// cylindrical joint, and PDN_DISPLACEMENT = pitch PDN_ROTATION / (2 pi). The displacement tells
/// the whole turns of the angle, so that unlike other angles it cannot gain any in a period.
///
/// @param model  the model; not NULL
/// @param first  id of the first node, or PDN_GROUND
/// @param second  id of the second node, or PDN_GROUND; not the same body
/// @param point  array of length 3: a point of the axis, global coordinates [length]
/// @param axis  array of length 3: direction of the axis, global coordinates, of any nonzero length
/// @param pitch  advance for one turn [length]; positive for a right-handed thread, negative for a
///     left-handed one, not zero
/// @param joint  the joint's id; may be NULL if it is not wanted; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_ID, PDN_ERR_VALUE
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_add_screw(
    model: *mut pdn_model,
    first: i32,
    second: i32,
    point: *const f64,
    axis: *const f64,
    pitch: f64,
    joint: *mut i32,
) -> pdn_status {
    add_joint(model, Bodies { first, second }, joint, |call| {
        let frame = axis_frame(call, point, axis, "axis")?;
        let pitch = call.number(pitch, "pitch")?;
        Ok((JointKind::Screw { pitch }, frame, frame))
    })
}

/// Joins two bodies by a pair of planes that slide and turn on each other.
///
/// Its frames are at the point, with axis 3 along the normal; axes 1 and 2 are found by the
/// library, see ::pdn_model_add_joint to choose them. Its coordinates are the displacements of the
/// second body along axes 1 and 2 of the first frame (PDN_DISPLACEMENT, PDN_DISPLACEMENT_2) and the
/// angle by which it has turned relative to the first, about the normal by the right-hand rule
/// (PDN_ROTATION), since the reference configuration, where they are zero.
///
/// @param model  the model; not NULL
/// @param first  id of the first node, or PDN_GROUND
/// @param second  id of the second node, or PDN_GROUND; not the same body
/// @param point  array of length 3: a point of the plane, whose displacement is measured, global
///     coordinates [length]
/// @param normal  array of length 3: normal of the plane, global coordinates, of any nonzero length
/// @param joint  the joint's id; may be NULL if it is not wanted; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_ID, PDN_ERR_VALUE
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_add_planar(
    model: *mut pdn_model,
    first: i32,
    second: i32,
    point: *const f64,
    normal: *const f64,
    joint: *mut i32,
) -> pdn_status {
    add_joint(model, Bodies { first, second }, joint, |call| {
        let frame = axis_frame(call, point, normal, "normal")?;
        Ok((JointKind::Planar, frame, frame))
    })
}

/// Joins two bodies by nothing: a joint that constrains no motion, but has coordinates.
///
/// It carries springs and dampers, prescribed coordinates and measures between any two bodies. Its
/// frames are at the point, with axes parallel to the global ones in the reference configuration.
/// Its coordinates are the displacements of the second body along axes 1, 2, 3 of the first frame
/// (PDN_DISPLACEMENT, PDN_DISPLACEMENT_2, PDN_DISPLACEMENT_3), and the angles of a spherical joint
/// (PDN_ROTATION, PDN_ROTATION_2, PDN_ROTATION_3).
///
/// @param model  the model; not NULL
/// @param first  id of the first node, or PDN_GROUND
/// @param second  id of the second node, or PDN_GROUND; not the same body
/// @param point  array of length 3: whose displacement is measured, global coordinates [length]
/// @param joint  the joint's id; may be NULL if it is not wanted; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_ID, PDN_ERR_VALUE
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_add_free_joint(
    model: *mut pdn_model,
    first: i32,
    second: i32,
    point: *const f64,
    joint: *mut i32,
) -> pdn_status {
    add_joint(model, Bodies { first, second }, joint, |call| {
        let frame = Motion::new(Matrix3::identity(), vector(call, point, "point")?);
        Ok((JointKind::Free, frame, frame))
    })
}

/// Joins two bodies by a ball.
///
/// Its frames are at the point, with axes parallel to the global ones in the reference
/// configuration. Its coordinates PDN_ROTATION, PDN_ROTATION_2, PDN_ROTATION_3 are the angles by
/// which the second frame comes from the first by turning about axis 1, then about its own axis 2,
/// then about its own axis 3; zero in the reference configuration. The second must stay between
/// -pi/2 and pi/2.
///
/// @param model  the model; not NULL
/// @param first  id of the first node, or PDN_GROUND
/// @param second  id of the second node, or PDN_GROUND; not the same body
/// @param point  array of length 3: centre of the ball, global coordinates [length]
/// @param joint  the joint's id; may be NULL if it is not wanted; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_ID, PDN_ERR_VALUE
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_add_spherical(
    model: *mut pdn_model,
    first: i32,
    second: i32,
    point: *const f64,
    joint: *mut i32,
) -> pdn_status {
    add_joint(model, Bodies { first, second }, joint, |call| {
        let point = vector(call, point, "point")?;
        let frame = Motion::new(Matrix3::identity(), point);
        Ok((JointKind::Spherical, frame, frame))
    })
}

/// Joins two bodies by a cross (Cardan, Hooke).
///
/// One arm of the cross turns in the first body, the other in the second. Its frames are at the
/// point, with axis 1 along the first arm, axis 2 along the second, in the reference configuration.
/// Its coordinates are the angle of the cross relative to the first body about first_arm
/// (PDN_ROTATION), and of the second body relative to the cross about second_arm (PDN_ROTATION_2),
/// both by the right-hand rule and zero in the reference configuration.
///
/// @param model  the model; not NULL
/// @param first  id of the first node, or PDN_GROUND
/// @param second  id of the second node, or PDN_GROUND; not the same body
/// @param point  array of length 3: centre of the cross, global coordinates [length]
/// @param first_arm  array of length 3: direction of the arm fixed to the first body, global
///     coordinates, of any nonzero length
/// @param second_arm  array of length 3: that of the arm fixed to the second body, perpendicular
/// @param joint  the joint's id; may be NULL if it is not wanted; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_ID, PDN_ERR_VALUE
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_add_universal(
    model: *mut pdn_model,
    first: i32,
    second: i32,
    point: *const f64,
    first_arm: *const f64,
    second_arm: *const f64,
    joint: *mut i32,
) -> pdn_status {
    add_joint(model, Bodies { first, second }, joint, |call| {
        let point = vector(call, point, "point")?;
        let first_arm = vector(call, first_arm, "first_arm")?;
        let second_arm = vector(call, second_arm, "second_arm")?;
        let frame = Model::cross_frame(&point, &first_arm, &second_arm)?;
        Ok((JointKind::Universal, frame, frame))
    })
}

/// Adds a strut: the line between a point of each of two bodies. It constrains nothing.
///
/// Its coordinate PDN_DISPLACEMENT is the distance of the points. Springs, dampers, actuators and
/// other forces on that coordinate act along the line: an effort against its growth is a tension,
/// and the rest of a spring its free length. Prescribed, it is a rod without mass, of constant or
/// varying length. The points must not meet while a force acts.
///
/// @param model  the model; not NULL
/// @param first  id of the first node, or PDN_GROUND
/// @param second  id of the second node, or PDN_GROUND; not the same body
/// @param first_point  array of length 3: the point of the first body in the reference
///     configuration, global coordinates [length]
/// @param second_point  array of length 3: that of the second body, not the same
/// @param joint  the joint's id; may be NULL if it is not wanted; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_ID, PDN_ERR_VALUE
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_add_strut(
    model: *mut pdn_model,
    first: i32,
    second: i32,
    first_point: *const f64,
    second_point: *const f64,
    joint: *mut i32,
) -> pdn_status {
    guard(|call| {
        let mut model: Exclusive<Model> = call.exclusive(model, "model")?;
        let first = body(&model, first, "first")?;
        let second = body(&model, second, "second")?;
        let first_point = vector(call, first_point, "first_point")?;
        let second_point = vector(call, second_point, "second_point")?;
        let joint = call.out(joint, "joint")?;
        let id = Kind::Joint.next(&model, 1, "joint")?;
        model.add_strut(first, second, &first_point, &second_point)?;
        joint.set(id);
        Ok(())
    })
}

/// Joins two bodies by a joint of any kind, between a frame fixed to each.
///
/// The frames need not fit each other in the reference configuration: the solver closes the joint.
/// With r = (r1, r2, r3) and R the position and rotation of the second frame relative to the first,
/// and resolved in it, the closed joint has
///
/// | kind | r | R | coordinates |
/// |---|---|---|---|
/// | PDN_JOINT_RIGID | 0 | I | none |
/// | PDN_JOINT_REVOLUTE | 0 | R3(a) | a = PDN_ROTATION |
/// | PDN_JOINT_PRISMATIC | (0, 0, z) | I | z = PDN_DISPLACEMENT |
/// | PDN_JOINT_CYLINDRICAL | (0, 0, z) | R3(a) | z = PDN_DISPLACEMENT, a = PDN_ROTATION |
/// | PDN_JOINT_PLANAR | (x, y, 0) | R3(a) | x = PDN_DISPLACEMENT, y = PDN_DISPLACEMENT_2, and a |
/// | PDN_JOINT_UNIVERSAL | 0 | R1(a) R2(b) | a = PDN_ROTATION, b = PDN_ROTATION_2 |
/// | PDN_JOINT_SPHERICAL | 0 | R1(a) R2(b) R3(c) | and c = PDN_ROTATION_3 |
/// | PDN_JOINT_FREE | (x, y, z) | R1(a) R2(b) R3(c) | all of these, z = PDN_DISPLACEMENT_3 |
///
/// where Rk(x) turns by x about axis k, right-handed. Angles count whole turns. A screw has a pitch
/// besides: ::pdn_model_add_screw_between.
///
/// @param model  the model; not NULL
/// @param kind  PDN_JOINT_RIGID ... PDN_JOINT_FREE
/// @param first  id of the first node, or PDN_GROUND
/// @param second  id of the second node, or PDN_GROUND; not the same body
/// @param first_frame  frame fixed to the first body, where it is in the reference configuration;
///     not NULL
/// @param second_frame  frame fixed to the second body, likewise; not NULL
/// @param joint  the joint's id; may be NULL if it is not wanted; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_ID, PDN_ERR_VALUE
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_add_joint(
    model: *mut pdn_model,
    kind: i32,
    first: i32,
    second: i32,
    first_frame: *const pdn_frame,
    second_frame: *const pdn_frame,
    joint: *mut i32,
) -> pdn_status {
    add_joint(model, Bodies { first, second }, joint, |call| {
        Ok((
            joint_kind(kind)?,
            motion(call, first_frame, "first_frame")?,
            motion(call, second_frame, "second_frame")?,
        ))
    })
}

/// Joins two bodies by a screw, between a frame fixed to each.
///
/// As ::pdn_model_add_joint with frames: the closed joint has r = (0, 0, pitch a / (2 pi)) and R =
/// R3(a), with the coordinates PDN_DISPLACEMENT = r3 and PDN_ROTATION = a. Where the frames do not
/// fit each other in the reference configuration, the solver takes the thread's turn that is
/// nearest.
///
/// @param model  the model; not NULL
/// @param first  id of the first node, or PDN_GROUND
/// @param second  id of the second node, or PDN_GROUND; not the same body
/// @param first_frame  frame fixed to the first body, where it is in the reference configuration;
///     not NULL
/// @param second_frame  frame fixed to the second body, likewise; not NULL
/// @param pitch  advance for one turn [length]; positive for a right-handed thread, negative for a
///     left-handed one, not zero
/// @param joint  the joint's id; may be NULL if it is not wanted; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_ID, PDN_ERR_VALUE
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_add_screw_between(
    model: *mut pdn_model,
    first: i32,
    second: i32,
    first_frame: *const pdn_frame,
    second_frame: *const pdn_frame,
    pitch: f64,
    joint: *mut i32,
) -> pdn_status {
    add_joint(model, Bodies { first, second }, joint, |call| {
        let first_frame = motion(call, first_frame, "first_frame")?;
        let second_frame = motion(call, second_frame, "second_frame")?;
        let pitch = call.number(pitch, "pitch")?;
        Ok((JointKind::Screw { pitch }, first_frame, second_frame))
    })
}
