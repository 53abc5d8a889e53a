//! What spins about an axis of its own in the frame of its node.

use super::guard::guard;
use super::id::Kind;
use super::model::{element_count, pdn_model};
use super::status::pdn_status;
use crate::error::{Error, ErrorKind};
use nalgebra::Vector3;

/// Lets a rigid body, or a mass or inertia on a node, spin at a constant rate relative to its node,
/// about an axis through its centre of mass which is fixed in the node: a disk, a rotor, a flywheel
/// with its gyroscopic moments, on a node that does not turn with it. In place of any spin set
/// before.
///
/// The node describes a frame in which the body spins: its motion in results, and all that is
/// attached to it, is without the spin. The body must be symmetric about the axis, so that its
/// inertia in the node's frame stays what it is; to 1e-8 of its masses and moments, so that numbers
/// written with 9 digits pass. What keeps the rate (a motor, or bearings of a shaft that turns
/// steadily) acts between node and body: about the axis the node feels the body's inertia and, with
/// damping in proportion to mass, what damps its spin. Momenta and kinetic energies
/// (::pdn_conditions_add_angular_momentum, ::pdn_conditions_add_energy) are those of the body. That
/// energy is constant in a free motion only if what keeps the rate does no work: where nothing acts
/// on the node about the axis.
///
/// All analyses know of it, also modes and statics in a frame that turns. A parameter may move the
/// rate (PDN_NUMBER_SPIN).
///
/// @param model  the model; not NULL
/// @param inertia  id of the inertia, as ::pdn_model_inertia_of tells of a rigid body
/// @param axis  array of length 3: direction of the axis, along the axes of the node, not zero
/// @param rate  angle in a unit of time \[rad/time\]; it may be zero
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_ID, PDN_ERR_VALUE (no direction, or
///     the inertia is not symmetric about the axis)
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_set_spin(
    model: *mut pdn_model,
    inertia: i32,
    axis: *const f64,
    rate: f64,
) -> pdn_status {
    guard(|call| {
        let mut model = call.exclusive(model, "model")?;
        let inertia = Kind::Inertia.index_in(&model, inertia, "inertia")?;
        let axis = call.array::<3>(axis, "axis")?;
        let rate = call.number(rate, "rate")?;
        model.set_spin(inertia, &Vector3::from(axis), rate)
    })
}

/// How an inertia spins relative to its node, if it does.
///
/// @param model  the model; not NULL
/// @param inertia  id of the inertia
/// @param axis  array of length 3: direction of the axis, of length 1, along the axes of the node;
///     written on success only
/// @param rate  angle in a unit of time \[rad/time\]; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID, PDN_ERR_NOT_AVAILABLE (it was given no spin)
///
/// Threads: `model` is `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_spin(
    model: *const pdn_model,
    inertia: i32,
    axis: *mut f64,
    rate: *mut f64,
) -> pdn_status {
    guard(|call| {
        let model = call.shared(model, "model")?;
        let index = Kind::Inertia.index_in(&model, inertia, "inertia")?;
        let axis = call.out_slice(axis, 3, 3, "axis")?;
        let rate = call.out(rate, "rate")?;
        let spin = model.spin(index).ok_or_else(|| {
            let message = format!("inertia: expected one that spins, got inertia {index}");
            Error::new(ErrorKind::NotAvailable, message)
        })?;
        axis.set(spin.axis().as_slice());
        rate.set(spin.rate());
        Ok(())
    })
}

/// Lets the material of beam elements spin about axis 1 of their sections at a constant rate
/// relative to their nodes, which do not spin along: a shaft that turns, and whirls by small angles
/// about where it stands, as ::pdn_model_set_spin lets a disk on it.
///
/// Rotary inertia is that of sections that spin. Damping acts on the rates of strains that the
/// material sees, which change with each turn where the shaft is bent: it is a rotating damping,
/// which makes a shaft unstable that turns faster than its first critical speed, unless other
/// damping holds it. Such a beam has no energy that is known. What loads the beam, and beam
/// quantities, are in the axes that do not spin.
///
/// The elements must be straight, axis 1 of their nodes along them, and stiffness, mass and damping
/// of their sections symmetric about axis 1, to 1e-8.
///
/// @param model  the model; not NULL
/// @param first_element  id of the first beam element
/// @param elements  number of elements, in order, at least 1
/// @param rate  angle in a unit of time \[rad/time\]; 0 for beams that do not spin
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_SIZE, PDN_ERR_NOT_FINITE, PDN_ERR_ID, PDN_ERR_VALUE (a
///     beam is not straight, or a section not symmetric)
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_set_beam_spin(
    model: *mut pdn_model,
    first_element: i32,
    elements: i32,
    rate: f64,
) -> pdn_status {
    guard(|call| {
        let mut model = call.exclusive(model, "model")?;
        let first = Kind::BeamElement.index_in(&model, first_element, "first_element")?;
        let count = element_count(elements)?;
        let rate = call.number(rate, "rate")?;
        model.set_beam_spin(first, count, rate)
    })
}

/// The rate at which the material of a beam element spins relative to its nodes.
///
/// @param model  the model; not NULL
/// @param element  id of the beam element
/// @param rate  angle in a unit of time \[rad/time\], 0 if it does not spin; written on success
///     only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID
///
/// Threads: `model` is `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_beam_spin(
    model: *const pdn_model,
    element: i32,
    rate: *mut f64,
) -> pdn_status {
    guard(|call| {
        let model = call.shared(model, "model")?;
        let element = Kind::BeamElement.index_in(&model, element, "element")?;
        let rate = call.out(rate, "rate")?;
        rate.set(model.beam_definition(element)?.spin);
        Ok(())
    })
}
