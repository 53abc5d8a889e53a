//! Linear relations between joint coordinates.

use super::call::Call;
use super::guard::guard;
use super::id::Kind;
use super::joint::coordinate;
use super::model::{self, pdn_model};
use super::signal::{self, pdn_signal};
use super::status::pdn_status;
use crate::error::Result;
use crate::model::{JointCoordinate, Model};

/// Number of linear relations between joint coordinates; their ids follow each other from
/// PDN_FIRST_RELATION on.
///
/// @param model  the model; not NULL
/// @param count  the number; written on success only
/// @return PDN_OK, PDN_ERR_NULL
///
/// Threads: `model` is `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_relation_count(
    model: *const pdn_model,
    count: *mut i32,
) -> pdn_status {
    model::count(model, count, Model::relation_count)
}

/// The coordinates and coefficients that arrays give.
fn terms(
    call: &Call,
    model: &Model,
    [joints, coordinates]: [*const i32; 2],
    coefficients: *const f64,
    count: usize,
) -> Result<Vec<(JointCoordinate, f64)>> {
    let joints = call.slice(joints, count, "joints")?;
    let coordinates = call.slice(coordinates, count, "coordinates")?;
    let coefficients = call.numbers(coefficients, count, "coefficients")?;
    let pairs = joints.iter().zip(coordinates).zip(coefficients);
    let term = |(i, ((&joint, &which), &coefficient)): (usize, ((&i32, &i32), &f64))| {
        let at = JointCoordinate {
            joint: Kind::Joint.index_in(model, joint, &format!("joints[{i}]"))?,
            coordinate: coordinate(which, &format!("coordinates[{i}]"))?,
        };
        Ok((at, coefficient))
    };
    pairs.enumerate().map(term).collect()
}

/// Adds a linear relation between joint coordinates: gears, belts, racks, differentials.
///
/// It keeps the sum of coefficients[i] * q[i] equal to a signal, with q[i] coordinate
/// coordinates[i] of joint joints[i], whole turns counted. Gears that turn q1 by n q2 have
/// coefficients 1 and -n, a rack on a pinion of radius r 1 and -r, a differential 1, 1 and -2. It
/// exerts an effort on each of the coordinates, in proportion to the coefficients:
/// PDN_RELATION_EFFORT. Where angles that are prescribed turn on and on, those that they
/// turn by relations must gain whole turns in a period as well; a solve refuses others with
/// PDN_ERR_NOT_PERIODIC, and tells a period that would do.
///
/// @param model  the model; not NULL
/// @param joints  array of length [count]: ids of the joints
/// @param coordinates  array of length [count]: PDN_DISPLACEMENT ... PDN_ROTATION_3 of each, one
///     that the joint has; each coordinate of a joint at most once
/// @param coefficients  array of length [count]: numbers other than zero, in units that make the
///     terms of the sum alike
/// @param count  number of coordinates, at least 2
/// @param signal  what the sum is in time, copied; it must return to its value after a period. NULL
///     for what the sum is in the reference configuration
/// @param relation  the relation's id; may be NULL if it is not wanted; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_SIZE, PDN_ERR_ID, PDN_ERR_VALUE,
///     PDN_ERR_STRUCT_SIZE, PDN_ERR_NOT_AVAILABLE
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_add_relation(
    model: *mut pdn_model,
    joints: *const i32,
    coordinates: *const i32,
    coefficients: *const f64,
    count: usize,
    signal: *const pdn_signal,
    relation: *mut i32,
) -> pdn_status {
    guard(|call| {
        let mut model = call.exclusive(model, "model")?;
        let terms = terms(call, &model, [joints, coordinates], coefficients, count)?;
        let signal = match signal.is_null() {
            true => None,
            false => Some(signal::read(call, signal, "signal")?),
        };
        let out = call.out_optional(relation, "relation")?;
        let id = Kind::Relation.next(&model, 1, "relation")?;
        model.add_relation(&terms, signal.as_ref())?;
        if let Some(out) = out {
            out.set(id);
        }
        Ok(())
    })
}
