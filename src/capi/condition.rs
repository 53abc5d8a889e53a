//! Free parameters, and conditions that determine them.

use super::call::Call;
use super::guard::{free, guard};
use super::handle::Handle;
use super::id::Kind;
use super::joint::coordinate;
use super::model::pdn_model;
use super::parameter::{PDN_FREQUENCY, any_parameter};
use super::periodic::{pdn_periodic_options, read_options};
use super::quantity::{pdn_quantity, selection};
use super::solution::pdn_solution;
use super::status::pdn_status;
use crate::error::{Error, Result};
use crate::model::{JointCoordinate, Model};
use crate::output::Solution;
use crate::quantity::Feature;
use crate::solve::{
    Condition, Energy, Free, JointCoordinateIs, Momentum, OutputIs, Phase, RigidMotion, RigidPhase,
};
use nalgebra::Vector3;
use std::sync::Arc;

/// Free parameters, and as many conditions. Made by ::pdn_conditions_new, freed by
/// ::pdn_conditions_free.
pub struct pdn_conditions {
    _private: [u8; 0],
}

/// Free parameters, and the conditions.
type Lists = (Vec<Free>, Vec<Arc<dyn Condition>>);

/// What a ::pdn_conditions holds.
#[derive(Debug, Clone, Default)]
pub struct Conditions {
    parameters: Vec<i32>,
    conditions: Vec<Arc<dyn Condition>>,
}

impl Handle for pdn_conditions {
    type Core = Conditions;
}

impl Conditions {
    /// The free parameters of a model, and the conditions.
    pub(super) fn of(&self, model: &Model) -> Result<Lists> {
        let all = self.parameters.iter().map(|&id| free_parameter(model, id));
        Ok((all.collect::<Result<_>>()?, self.conditions.clone()))
    }
}

/// The free parameter of an id, or the frequency.
pub(super) fn free_parameter(model: &Model, id: i32) -> Result<Free> {
    Ok(match id {
        PDN_FREQUENCY => Free::Frequency,
        id => Free::Parameter(Kind::Parameter.index_in(model, id, "parameter")?),
    })
}

/// Makes an empty list: no parameter is free.
///
/// It belongs to no model; ids are looked up when it is used.
///
/// @param out  the list; free it with ::pdn_conditions_free; written on success only
/// @return PDN_OK, PDN_ERR_NULL
///
/// Threads: any.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_conditions_new(out: *mut *mut pdn_conditions) -> pdn_status {
    guard(|call| {
        let out = call.out(out, "out")?;
        out.give(Conditions::default());
        Ok(())
    })
}

/// Frees a list; NULL does nothing.
///
/// @param conditions  the list, not to be used any more
///
/// Threads: exclusive use of `conditions`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_conditions_free(conditions: *mut pdn_conditions) {
    free(conditions);
}

/// Makes a parameter free: its value in the model is that to start from.
///
/// @param conditions  the list; not NULL
/// @param parameter  id of a parameter, or PDN_FREQUENCY for an unknown period
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID
///
/// Threads: exclusive use of `conditions`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_conditions_release(
    conditions: *mut pdn_conditions,
    parameter: i32,
) -> pdn_status {
    guard(|call| {
        let mut conditions = call.exclusive(conditions, "conditions")?;
        conditions.parameters.push(any_parameter(parameter)?);
        Ok(())
    })
}

/// Adds the condition on the phase: the motion is not ahead of that which the solve starts from.
///
/// For motions whose time nothing else tells: limit cycles, and free motions of a conservative
/// system.
///
/// @param conditions  the list; not NULL
/// @return PDN_OK, PDN_ERR_NULL
///
/// Threads: exclusive use of `conditions`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_conditions_add_phase(conditions: *mut pdn_conditions) -> pdn_status {
    guard(|call| {
        let mut conditions = call.exclusive(conditions, "conditions")?;
        conditions.conditions.push(Arc::new(Phase));
        Ok(())
    })
}

/// The turn of everything about the axis through `point`, or the origin.
fn rotation(call: &Call, axis: *const f64, point: *const f64) -> Result<RigidMotion> {
    let axis = Vector3::from(call.array::<3>(axis, "axis")?);
    let point = call.array_optional::<3>(point, "point")?;
    RigidMotion::rotation(&axis, &point.map_or(Vector3::zeros(), Vector3::from))
}

/// The translation of everything in this direction.
fn translation(call: &Call, direction: *const f64) -> Result<RigidMotion> {
    RigidMotion::translation(&Vector3::from(call.array::<3>(direction, "direction")?))
}

/// Adds the condition on the phase of a rotation: in the mean over the period and all nodes, the
/// motion is not turned about an axis from that which the solve starts from.
///
/// For mechanisms that nothing holds against it, such as a pendulum in a spherical joint, whose
/// turn in a period is unknown (::pdn_model_set_turning_frame).
///
/// @param conditions  the list; not NULL
/// @param axis  array of length 3: direction of the axis, not zero
/// @param point  array of length 3: a point of the axis \[length\]; NULL for the origin
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_VALUE (no direction)
///
/// Threads: exclusive use of `conditions`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_conditions_add_rotation_phase(
    conditions: *mut pdn_conditions,
    axis: *const f64,
    point: *const f64,
) -> pdn_status {
    guard(|call| {
        let mut conditions = call.exclusive(conditions, "conditions")?;
        let condition = RigidPhase(rotation(call, axis, point)?);
        conditions.conditions.push(Arc::new(condition));
        Ok(())
    })
}

/// Adds the condition on the phase of a translation: in the mean over the period and all nodes, the
/// motion is not moved in a direction from that which the solve starts from.
///
/// For mechanisms that nothing holds against it, such as a free body.
///
/// @param conditions  the list; not NULL
/// @param direction  array of length 3: the direction, not zero
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_VALUE (no direction)
///
/// Threads: exclusive use of `conditions`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_conditions_add_translation_phase(
    conditions: *mut pdn_conditions,
    direction: *const f64,
) -> pdn_status {
    guard(|call| {
        let mut conditions = call.exclusive(conditions, "conditions")?;
        let condition = RigidPhase(translation(call, direction)?);
        conditions.conditions.push(Arc::new(condition));
        Ok(())
    })
}

/// Feature of a quantity: its mean over the period, without what it gains.
pub const PDN_FEATURE_MEAN: i32 = 2900;
/// Feature of a quantity: coefficient of the cosine of a harmonic.
pub const PDN_FEATURE_COSINE: i32 = 2901;
/// Feature of a quantity: coefficient of the sine of a harmonic.
pub const PDN_FEATURE_SINE: i32 = 2902;
/// Feature of a quantity: value at a time, of the trigonometric polynomial through the values at
/// the grid points.
pub const PDN_FEATURE_VALUE: i32 = 2903;

/// The feature that C means.
pub(super) fn feature(call: &Call, feature: i32, at: f64) -> Result<Feature> {
    let harmonic = || match call.number(at, "at")? {
        j if j >= 1.0 && j <= f64::from(i32::MAX) && j.fract() == 0.0 => Ok(j as usize),
        j => Err(Error::value("at", "a harmonic, from 1", j)),
    };
    Ok(match feature {
        PDN_FEATURE_MEAN => Feature::Mean,
        PDN_FEATURE_COSINE => Feature::Cosine(harmonic()?),
        PDN_FEATURE_SINE => Feature::Sine(harmonic()?),
        PDN_FEATURE_VALUE => Feature::At(call.number(at, "at")?),
        other => {
            let expected = "PDN_FEATURE_MEAN, PDN_FEATURE_COSINE, PDN_FEATURE_SINE or \
                            PDN_FEATURE_VALUE (extremes are of sensitivities only)";
            return Err(Error::value("feature", expected, other));
        }
    })
}

/// Adds the condition that the mean, a harmonic, or the value at a time, of a quantity is this:
/// trim.
///
/// @param conditions  the list; not NULL
/// @param quantity  one component of a quantity, initialised by PDN_INIT; not NULL
/// @param feature  PDN_FEATURE_MEAN, PDN_FEATURE_COSINE, PDN_FEATURE_SINE or PDN_FEATURE_VALUE
/// @param at  the number of the harmonic, from 1, or the time; not looked at for the mean
/// @param value  the value
/// @param scale  what counts as 1 in it, such as the largest that it may be; usually 0, for what
///     does in such quantities of the mechanism
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE, PDN_ERR_NOT_FINITE, PDN_ERR_ID,
///     PDN_ERR_VALUE; that the model has no such quantity, or the grid no such harmonic, is told by
///     the solve
///
/// Threads: exclusive use of `conditions`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_conditions_add_quantity(
    conditions: *mut pdn_conditions,
    quantity: *const pdn_quantity,
    feature: i32,
    at: f64,
    value: f64,
    scale: f64,
) -> pdn_status {
    guard(|call| {
        let mut conditions = call.exclusive(conditions, "conditions")?;
        let output = selection(call, quantity)?;
        if output.components() != 1 {
            let got = output.components();
            return Err(Error::value("quantity.component", "a single one", got));
        }
        let feature = self::feature(call, feature, at)?;
        let scale = match call.number(scale, "scale")? {
            0.0 => None,
            scale if scale > 0.0 => Some(scale),
            scale => return Err(Error::value("scale", "a positive number, or 0", scale)),
        };
        conditions.conditions.push(Arc::new(OutputIs {
            output,
            feature,
            value: call.number(value, "value")?,
            scale,
        }));
        Ok(())
    })
}

/// Adds the condition that a joint coordinate has a value at the start of the period.
///
/// With ::pdn_conditions_add_phase, and a start that turns back at time zero, it is the amplitude
/// of a free motion.
///
/// @param conditions  the list; not NULL
/// @param joint  id of the joint
/// @param coordinate  PDN_DISPLACEMENT, ... or PDN_ROTATION, ...
/// @param value  the value
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_ID, PDN_ERR_VALUE
///
/// Threads: exclusive use of `conditions`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_conditions_add_joint_coordinate(
    conditions: *mut pdn_conditions,
    joint: i32,
    coordinate: i32,
    value: f64,
) -> pdn_status {
    guard(|call| {
        let mut conditions = call.exclusive(conditions, "conditions")?;
        let joint = Kind::Joint.index(joint, "joint")?;
        let at = JointCoordinate {
            joint,
            coordinate: self::coordinate(coordinate, "coordinate")?,
        };
        let value = call.number(value, "value")?;
        let condition = JointCoordinateIs { at, value };
        conditions.conditions.push(Arc::new(condition));
        Ok(())
    })
}

/// Adds the condition that the mean of the kinetic and the potential energy over the period is a
/// value.
///
/// Weights have no energy at the origin. The energy of weights, of springs on joint coordinates and
/// of beams is known; a model with other forces is refused.
///
/// @param conditions  the list; not NULL
/// @param energy  the value \[force * length\]
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE
///
/// Threads: exclusive use of `conditions`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_conditions_add_energy(
    conditions: *mut pdn_conditions,
    energy: f64,
) -> pdn_status {
    guard(|call| {
        let mut conditions = call.exclusive(conditions, "conditions")?;
        let value = call.number(energy, "energy")?;
        conditions.conditions.push(Arc::new(Energy { value }));
        Ok(())
    })
}

/// Adds the condition that the mean momentum in a direction is a value.
///
/// The momentum in the inertial frame is meant, also where the model is described in a frame that
/// turns.
///
/// @param conditions  the list; not NULL
/// @param direction  array of length 3: the direction, not zero
/// @param momentum  the value \[mass * length / time\]
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_VALUE (no direction)
///
/// Threads: exclusive use of `conditions`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_conditions_add_momentum(
    conditions: *mut pdn_conditions,
    direction: *const f64,
    momentum: f64,
) -> pdn_status {
    guard(|call| {
        let mut conditions = call.exclusive(conditions, "conditions")?;
        let motion = translation(call, direction)?;
        let value = call.number(momentum, "momentum")?;
        let condition = Momentum { motion, value };
        conditions.conditions.push(Arc::new(condition));
        Ok(())
    })
}

/// Adds the condition that the mean angular momentum about an axis is a value.
///
/// With ::pdn_model_set_turning_frame, of a free body that tumbles. The angular momentum in the
/// inertial frame is meant, also where the model is described in a frame that turns.
///
/// @param conditions  the list; not NULL
/// @param axis  array of length 3: direction of the axis, not zero
/// @param point  array of length 3: a point of the axis \[length\]; NULL for the origin
/// @param momentum  the value \[mass * length^2 / time\]
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_VALUE (no direction)
///
/// Threads: exclusive use of `conditions`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_conditions_add_angular_momentum(
    conditions: *mut pdn_conditions,
    axis: *const f64,
    point: *const f64,
    momentum: f64,
) -> pdn_status {
    guard(|call| {
        let mut conditions = call.exclusive(conditions, "conditions")?;
        let motion = rotation(call, axis, point)?;
        let value = call.number(momentum, "momentum")?;
        let condition = Momentum { motion, value };
        conditions.conditions.push(Arc::new(condition));
        Ok(())
    })
}

/// Finds a periodic response that meets conditions, and the values of as many free parameters.
///
/// Newton's method for motions and parameters together starts at a given solution or motion
/// (`options.initial`, `options.guess_positions`), or else at the response with the parameters as
/// they are. Where the period is free, `period` is the guess of it; loads and prescribed motions
/// are then functions of the phase: harmonics and samples are, rates are for whole turns, functions
/// must be declared such (::pdn_signal_set_function_of_phase, ::pdn_model_declare_of_phase).
///
/// @param model  the model; it is copied, so that later changes do not touch the solution
/// @param period  T, or a guess of it
/// @param conditions  free parameters and as many conditions; not NULL
/// @param options  may be NULL for the defaults
/// @param out  the solution, also if it has not converged: ::pdn_solution_parameter tells the
///     values found; free it with ::pdn_solution_free; written on success only
/// @return as ::pdn_solve_periodic; PDN_ERR_SIZE also if there are not as many conditions as free
///     parameters, PDN_ERR_VALUE if one is free twice, moves nothing, or if the phase is that of a
///     start at rest, PDN_ERR_NOT_PERIODIC if something has a frequency of its own
///
/// Threads: like a `const` use of `model`, `conditions` and `options.initial`. Functions of yours
/// are called on this thread.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_solve_conditioned(
    model: *const pdn_model,
    period: f64,
    conditions: *const pdn_conditions,
    options: *const pdn_periodic_options,
    out: *mut *mut pdn_solution,
) -> pdn_status {
    guard(|call| {
        let model = call.shared(model, "model")?;
        let period = call.number(period, "period")?;
        let conditions = call.shared(conditions, "conditions")?;
        let given = call.options(options, "options")?;
        let out = call.out(out, "out")?;
        let options = read_options(call, &given, &model, period)?;
        let (free, conditions) = conditions.of(&model)?;
        let lists = (&free[..], &conditions[..]);
        out.give(Solution::solve_conditioned(
            &model,
            period,
            lists,
            &options,
            &mut |_, _| true,
        )?);
        Ok(())
    })
}
