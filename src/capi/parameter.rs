//! Parameters of a model.

use super::guard::{guard, guard_or};
use super::id::{self, Kind};
use super::last_error::copy_message;
use super::load::component_place;
use super::model::{choose, pdn_model};
use super::solution::pdn_solution;
use super::status::pdn_status;
use crate::error::{Error, ErrorKind, Result};
use crate::model::{Model, SignalPart, SignalPlace, Target};
use libc::c_char;

/// A parameter moves the coefficient of a power, from 1, of the growth of a spring-damper, or with
/// power 1 the long-term stiffness of a viscoelastic force or a factor of the stiffness of a
/// bushing.
pub const PDN_NUMBER_STIFFNESS: i32 = 3600;
/// A parameter moves the coefficient of a power, from 1, of the rate of a spring-damper, or with
/// power 1 a factor of the damping of a bushing.
pub const PDN_NUMBER_DAMPING: i32 = 3601;
/// A parameter moves the coordinate at which a spring-damper or viscoelastic force is free of
/// effort.
pub const PDN_NUMBER_REST: i32 = 3602;
/// A parameter moves a factor of an inertia: that of a rigid body, or a mass or inertia on a node.
pub const PDN_NUMBER_INERTIA: i32 = 3603;
/// A parameter moves a factor of the sections' stiffness along a beam element.
pub const PDN_NUMBER_BEAM_STIFFNESS: i32 = 3604;
/// A parameter moves a factor of the sections' mass along a beam element.
pub const PDN_NUMBER_BEAM_MASS: i32 = 3605;
/// A parameter moves a factor of the sections' damping along a beam element.
pub const PDN_NUMBER_BEAM_DAMPING: i32 = 3606;
/// A parameter moves the damping in proportion to mass, ::pdn_model_set_mass_damping.
pub const PDN_NUMBER_MASS_DAMPING: i32 = 3607;
/// A parameter moves a factor of the stiffness of a shell element.
pub const PDN_NUMBER_SHELL_STIFFNESS: i32 = 3609;
/// A parameter moves a factor of the mass of a shell element.
pub const PDN_NUMBER_SHELL_MASS: i32 = 3610;
/// A parameter moves a factor of the damping of a shell element.
pub const PDN_NUMBER_SHELL_DAMPING: i32 = 3611;
/// A parameter moves a factor of the thickness of a shell element, more than zero, all its layers
/// alike: stiffness, damping and mass against stretching grow with it, against bending and turning
/// with its cube, what couples them with its square.
pub const PDN_NUMBER_SHELL_THICKNESS: i32 = 3612;
/// A parameter moves the rate of the frame that everything is described in,
/// ::pdn_model_set_turning_frame.
pub const PDN_NUMBER_FRAME_RATE: i32 = 3613;
/// A parameter moves the rate at which an inertia spins, ::pdn_model_set_spin.
pub const PDN_NUMBER_SPIN: i32 = 3614;
/// A parameter moves the rate at which the material of a beam element spins,
/// ::pdn_model_set_beam_spin.
pub const PDN_NUMBER_BEAM_SPIN: i32 = 3615;
/// A parameter moves the speed of the frame that everything is described in along its axis,
/// ::pdn_model_set_frame_advance.
pub const PDN_NUMBER_FRAME_ADVANCE: i32 = 3616;

/// Part of a signal: the mean that is added to its shape.
pub const PDN_PART_MEAN: i32 = 3800;
/// Part of a signal: growth in a unit of time.
pub const PDN_PART_RATE: i32 = 3801;
/// Part of a signal: the factor of its shape, which is its harmonics, its samples or its function.
pub const PDN_PART_AMPLITUDE: i32 = 3802;
/// Part of a signal: the phase by which its shape is ahead \[radians\].
pub const PDN_PART_PHASE: i32 = 3803;

/// A parameter: the circular frequency 2 pi / T, which every model has.
pub const PDN_FREQUENCY: i32 = -3;

/// In place of an id: gravity, whose components have signals.
pub const PDN_GRAVITY: i32 = -4;

/// Adds a parameter: a named number that moves what ::pdn_model_move_number and
/// ::pdn_model_move_signal say. At first it moves nothing.
///
/// A model can be solved at other values (::pdn_model_set_parameter), values can be found so that
/// conditions are met (::pdn_solve_conditioned), and followed (::pdn_follow_branch). They are saved
/// with the model.
///
/// @param model  the model; not NULL
/// @param name  text in UTF-8 that no other parameter of the model has; not NULL, not empty
/// @param value  its value
/// @param scale  what counts as 1 in it, positive: its range, about
/// @param out  the parameter's id; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_VALUE
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_add_parameter(
    model: *mut pdn_model,
    name: *const c_char,
    value: f64,
    scale: f64,
    out: *mut i32,
) -> pdn_status {
    guard(|call| {
        let mut model = call.exclusive(model, "model")?;
        let name = call.text(name, "name")?;
        let out = call.out(out, "out")?;
        let id = Kind::Parameter.next(&model, 1, "parameters")?;
        model.add_parameter(name, value, scale)?;
        out.set(id);
        Ok(())
    })
}

/// Number of parameters; their ids follow each other from PDN_FIRST_PARAMETER on.
///
/// @param model  the model; not NULL
/// @param count  the number; written on success only
/// @return PDN_OK, PDN_ERR_NULL
///
/// Threads: `model` is `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_parameter_count(
    model: *const pdn_model,
    count: *mut i32,
) -> pdn_status {
    super::model::count(model, count, |model| model.object_count(Kind::Parameter))
}

/// Value and scale of a parameter.
///
/// @param model  the model; not NULL
/// @param parameter  id of the parameter
/// @param value  its value; written on success only
/// @param scale  what counts as 1 in it; may be NULL if it is not wanted; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID
///
/// Threads: `model` is `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_parameter(
    model: *const pdn_model,
    parameter: i32,
    value: *mut f64,
    scale: *mut f64,
) -> pdn_status {
    guard(|call| {
        let model = call.shared(model, "model")?;
        let found =
            &model.parameters()[Kind::Parameter.index_in(&model, parameter, "parameter")?];
        let value = call.out(value, "value")?;
        if let Some(scale) = call.out_optional(scale, "scale")? {
            scale.set(found.scale);
        }
        value.set(found.value);
        Ok(())
    })
}

/// The name of a parameter.
///
/// @param model  the model; not NULL
/// @param parameter  id of the parameter
/// @param buffer  array of length [capacity] for the name, UTF-8, always ended by NUL; may be NULL
///     if capacity is 0
/// @param capacity  size of buffer in bytes
/// @return length of the name without the NUL, as snprintf does; 0 if the handle or id is not
///     valid, see ::pdn_last_error
///
/// Threads: `model` is `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_parameter_name(
    model: *const pdn_model,
    parameter: i32,
    buffer: *mut c_char,
    capacity: usize,
) -> usize {
    guard_or(0, |call| {
        let model = call.shared(model, "model")?;
        let found =
            &model.parameters()[Kind::Parameter.index_in(&model, parameter, "parameter")?];
        copy_message(&found.name, buffer, capacity);
        Ok(found.name.len())
    })
}

/// The parameter that has a name.
///
/// @param model  the model; not NULL
/// @param name  the name; not NULL
/// @param parameter  id of the parameter; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_VALUE, PDN_ERR_NOT_AVAILABLE (none has this name)
///
/// Threads: `model` is `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_find_parameter(
    model: *const pdn_model,
    name: *const c_char,
    parameter: *mut i32,
) -> pdn_status {
    guard(|call| {
        let model = call.shared(model, "model")?;
        let name = call.text(name, "name")?;
        let out = call.out(parameter, "parameter")?;
        let found = model.parameters().iter().position(|it| it.name == name);
        let found = found.ok_or_else(|| {
            let message = format!("name: no parameter is called \"{name}\"");
            Error::new(ErrorKind::NotAvailable, message)
        })?;
        out.set(Kind::Parameter.id(found));
        Ok(())
    })
}

/// An id that may be that of a parameter of some model, or the frequency.
pub(super) fn any_parameter(id: i32) -> Result<i32> {
    if id == PDN_FREQUENCY || Kind::Parameter.index(id, "parameter").is_ok() {
        return Ok(id);
    }
    let message = format!("parameter: expected a parameter id or PDN_FREQUENCY, got {id}");
    Err(Error::new(ErrorKind::Identifier, message))
}

/// A number of an argument that counts something.
fn count(value: i32, name: &str) -> Result<usize> {
    usize::try_from(value).map_err(|_| Error::value(name, "zero or more", value))
}

/// Lets a parameter move a number of the model: it becomes `factor` times the parameter's value,
/// now and whenever that changes.
///
/// @param model  the model; not NULL
/// @param parameter  id of the parameter
/// @param number  PDN_NUMBER_STIFFNESS, ...
/// @param id  id of the force, inertia, beam element or shell element that has it; 0 for
///     PDN_NUMBER_MASS_DAMPING, PDN_NUMBER_FRAME_RATE and PDN_NUMBER_FRAME_ADVANCE, which are of
///     the whole model
/// @param power  power, from 1, of a stiffness or damping; 0 for all else
/// @param factor  the number for a unit of the parameter, not zero
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_ID (no such parameter or number),
///     PDN_ERR_VALUE (another parameter moves it already, or a thickness is not positive)
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_move_number(
    model: *mut pdn_model,
    parameter: i32,
    number: i32,
    id: i32,
    power: i32,
    factor: f64,
) -> pdn_status {
    guard(|call| {
        let mut model = call.exclusive(model, "model")?;
        let parameter = Kind::Parameter.index_in(&model, parameter, "parameter")?;
        let power = count(power, "power")?;
        let target = target(&model, number, id, power)?;
        model.move_by_parameter(parameter, target, factor)
    })
}

/// The number that arguments name.
fn target(model: &Model, number: i32, id: i32, power: usize) -> Result<Target> {
    let of = |kind: Kind| kind.index_in(model, id, "id");
    let (force, beam, shell) = (Kind::Force, Kind::BeamElement, Kind::ShellElement);
    Ok(match number {
        PDN_NUMBER_STIFFNESS => Target::Stiffness(of(force)?, power),
        PDN_NUMBER_DAMPING => Target::Damping(of(force)?, power),
        PDN_NUMBER_REST => Target::Rest(of(force)?),
        PDN_NUMBER_INERTIA => Target::Inertia(of(Kind::Inertia)?),
        PDN_NUMBER_BEAM_STIFFNESS => Target::BeamStiffness(of(beam)?),
        PDN_NUMBER_BEAM_MASS => Target::BeamMass(of(beam)?),
        PDN_NUMBER_BEAM_DAMPING => Target::BeamDamping(of(beam)?),
        PDN_NUMBER_BEAM_SPIN => Target::BeamSpin(of(beam)?),
        PDN_NUMBER_MASS_DAMPING => of_the_whole(id, Target::MassDamping)?,
        PDN_NUMBER_SHELL_STIFFNESS => Target::ShellStiffness(of(shell)?),
        PDN_NUMBER_SHELL_MASS => Target::ShellMass(of(shell)?),
        PDN_NUMBER_SHELL_DAMPING => Target::ShellDamping(of(shell)?),
        PDN_NUMBER_SHELL_THICKNESS => Target::ShellThickness(of(shell)?),
        PDN_NUMBER_FRAME_RATE => of_the_whole(id, Target::FrameRate)?,
        PDN_NUMBER_FRAME_ADVANCE => of_the_whole(id, Target::FrameAdvance)?,
        PDN_NUMBER_SPIN => Target::Spin(of(Kind::Inertia)?),
        other => return Err(Error::value("number", "a constant PDN_NUMBER_...", other)),
    })
}

/// What belongs to the whole model, and so to nothing that has an id.
fn of_the_whole<T>(id: i32, what: T) -> Result<T> {
    match id {
        0 => Ok(what),
        _ => Err(Error::value("id", "0 for what is of the whole model", id)),
    }
}

/// The signal that arguments name.
pub(super) fn signal_place(model: &Model, id: i32, component: i32) -> Result<SignalPlace> {
    if id == PDN_GRAVITY {
        return Ok(SignalPlace::Gravity(count(component, "component")?));
    }
    let index = |kind: Kind| kind.index_in(model, id, "id");
    let of_load = || load_component(component);
    Ok(match Kind::of(id) {
        Some(kind @ Kind::Load) => SignalPlace::Load(index(kind)?, of_load()?),
        Some(kind @ Kind::BeamLoad) => SignalPlace::DistributedLoad(index(kind)?, of_load()?),
        Some(kind @ Kind::ShellLoad) => SignalPlace::ShellLoad(index(kind)?, of_load()?),
        Some(kind @ Kind::Force) => only_one(component, SignalPlace::Actuator(index(kind)?))?,
        Some(kind @ Kind::Prescribed) => {
            only_one(component, SignalPlace::Prescribed(index(kind)?))?
        }
        Some(kind @ Kind::Relation) => only_one(component, SignalPlace::Relation(index(kind)?))?,
        _ => {
            let expected = "an id of an actuator (a force), prescribed coordinate, relation or \
                            load, or PDN_GRAVITY";
            let message = format!("id: expected {expected}, got {}", id::describe(id));
            return Err(Error::new(ErrorKind::Identifier, message));
        }
    })
}

/// What has one signal, and no components.
fn only_one(component: i32, place: SignalPlace) -> Result<SignalPlace> {
    match component {
        0 => Ok(place),
        _ => {
            let expected = "0, but for loads and gravity";
            Err(Error::value("component", expected, component))
        }
    }
}

/// The place of a component of a load among six.
fn load_component(component: i32) -> Result<usize> {
    component_place(component).ok_or_else(|| {
        let expected = "PDN_FORCE_1 to PDN_FORCE_3 or PDN_MOMENT_1 to PDN_MOMENT_3";
        Error::value("component", expected, component)
    })
}

/// Lets a parameter move a part of a signal: it becomes `factor` times the parameter's value, now
/// and whenever that changes.
///
/// @param model  the model; not NULL
/// @param parameter  id of the parameter
/// @param id  what has the signal: id of an actuator (a force), prescribed coordinate, load (on a
///     node, along beams, on shells) or relation; or PDN_GRAVITY
/// @param component  of a load PDN_FORCE_1, ... or PDN_MOMENT_3, of gravity from 0 to 2; 0 for all
///     else
/// @param part  PDN_PART_MEAN, PDN_PART_RATE, PDN_PART_AMPLITUDE or PDN_PART_PHASE
/// @param factor  the part for a unit of the parameter, not zero
/// @return as ::pdn_model_move_number
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_move_signal(
    model: *mut pdn_model,
    parameter: i32,
    id: i32,
    component: i32,
    part: i32,
    factor: f64,
) -> pdn_status {
    guard(|call| {
        let mut model = call.exclusive(model, "model")?;
        let parameter = Kind::Parameter.index_in(&model, parameter, "parameter")?;
        let place = signal_place(&model, id, component)?;
        let parts = [
            (PDN_PART_MEAN, SignalPart::Mean),
            (PDN_PART_RATE, SignalPart::Rate),
            (PDN_PART_AMPLITUDE, SignalPart::Amplitude),
            (PDN_PART_PHASE, SignalPart::Phase),
        ];
        let part = choose(&parts, part, "part", "a constant PDN_PART_...")?;
        model.move_by_parameter(parameter, Target::Signal(place, part), factor)
    })
}

/// Gives a parameter another value, and all that it moves.
///
/// @param model  the model; not NULL
/// @param parameter  id of the parameter
/// @param value  the value
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_ID
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_set_parameter(
    model: *mut pdn_model,
    parameter: i32,
    value: f64,
) -> pdn_status {
    guard(|call| {
        let mut model = call.exclusive(model, "model")?;
        let id = Kind::Parameter.index_in(&model, parameter, "parameter")?;
        model.set_parameter(id, value)
    })
}

/// Gives everything with mass a force against its motion relative to the inertial frame, `factor`
/// times its momentum: damping in proportion to mass.
///
/// @param model  the model; not NULL
/// @param factor  force for a unit of momentum \[1/time\]; negative to excite
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_set_mass_damping(
    model: *mut pdn_model,
    factor: f64,
) -> pdn_status {
    guard(|call| call.exclusive(model, "model")?.set_mass_damping(factor))
}

/// Declares that the function of a force is one of the phase, 2 pi t / T, which it is then told in
/// place of the time: it holds for any period T, as it must where that is unknown.
///
/// A function that does not depend on time is one of the phase, too.
///
/// @param model  the model; not NULL
/// @param force  id of a force that has a function
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID, PDN_ERR_NOT_AVAILABLE (it has none)
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_declare_of_phase(
    model: *mut pdn_model,
    force: i32,
) -> pdn_status {
    guard(|call| {
        let mut model = call.exclusive(model, "model")?;
        let force = Kind::Force.index_in(&model, force, "force")?;
        model.declare_of_phase(force)
    })
}

/// Value of a parameter in a solution: given, or found.
///
/// @param solution  the solution; not NULL
/// @param parameter  id of the parameter, or PDN_FREQUENCY
/// @param out  the value; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID
///
/// Threads: like `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_solution_parameter(
    solution: *const pdn_solution,
    parameter: i32,
    out: *mut f64,
) -> pdn_status {
    guard(|call| {
        let solution = call.shared(solution, "solution")?;
        let out = call.out(out, "out")?;
        out.set(match parameter {
            PDN_FREQUENCY => std::f64::consts::TAU / solution.grid().period(),
            id => {
                let model = solution.model();
                model.parameters()[Kind::Parameter.index_in(model, id, "parameter")?].value
            }
        });
        Ok(())
    })
}
