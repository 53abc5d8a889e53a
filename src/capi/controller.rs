//! Controllers: functions of the caller that read joint coordinates, have states, and act on joint
//! coordinates.

use super::call::Call;
use super::callback::Callback;
use super::guard::guard;
use super::id::Kind;
use super::joint::{coordinate, coordinate_code};
use super::model::{add_object, number, pdn_model};
use super::status::pdn_status;
use super::user_force::{gives_tangents, pdn_destroy_fn};
use crate::elements::{ControllerInput, ControllerLaw, ControllerOutput, ControllerState};
use crate::error::{Error, Result};
use crate::model::{JointCoordinate, Model};
use libc::c_void;
use std::ptr::null_mut;
use std::sync::Arc;

/// What a controller reads. The library makes it; a later one may add fields at its end.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct pdn_controller_state {
    /// Size of the struct that the library knows.
    pub struct_size: usize,
    /// Time, in [0, T) of the period T of the solve, but for the first calls of a solve
    /// (::pdn_controller_fn).
    pub time: f64,
    /// Number of coordinates that are read.
    pub input_count: usize,
    /// Array of length [input_count]: the coordinates, angles with their whole turns
    /// [length or radian].
    pub inputs: *const f64,
    /// Array of length [input_count]: their rates.
    pub input_rates: *const f64,
    /// Number of states.
    pub state_count: usize,
    /// Array of length [state_count]: the states.
    pub states: *const f64,
}

/// Where a controller writes. The library makes it, with all arrays set to zero; a later one may
/// add fields.
///
/// Rows of the tangents are the efforts, then the rates of the states.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct pdn_controller_values {
    /// Size of the struct that the library knows.
    pub struct_size: usize,
    /// Number of coordinates that it acts on.
    pub output_count: usize,
    /// Array of length [output_count]: efforts on the coordinates that it acts on, towards growth
    /// [force on a displacement, force * length on an angle].
    pub efforts: *mut f64,
    /// Array of length [state_count]: rates of the states.
    pub state_rates: *mut f64,
    /// Array of shape [output_count + state_count] x [input_count], column by column:
    /// derivatives by the coordinates. NULL if tangents are not wanted, or were said not to be
    /// given.
    pub by_inputs: *mut f64,
    /// The same by their rates; NULL where by_inputs is.
    pub by_input_rates: *mut f64,
    /// Array of shape [output_count + state_count] x [state_count], column by column:
    /// derivatives by the states; NULL where by_inputs is.
    pub by_states: *mut f64,
}

const _: () =
    assert!(size_of::<pdn_controller_state>() == 56 && size_of::<pdn_controller_values>() == 56);

/// A controller, to be written by the caller.
///
/// Called on the thread that solves; if two threads solve at once, on both at once. The same state
/// must give the same values, and over time they must repeat with the period: solves call it first
/// a few times at one motion, at times in [0, 2 T), and refuse what does not with
/// PDN_ERR_NOT_PERIODIC. Where a coordinate that it reads gains whole turns in a period, efforts
/// must repeat with these. It must neither throw nor jump out, nor use the model it belongs to. It
/// is called many times at trial motions, which may be far from the solution.
///
/// @param state  time, coordinates and states; valid during the call only
/// @param values  where efforts and rates go, all zero at first; valid during the call only
/// @param user_data  as given to ::pdn_model_add_controller
/// @return 0 for success; anything else makes the solve fail with PDN_ERR_CALLBACK (see
///     ::pdn_set_callback_error and ::pdn_last_callback_code), as does a value that is not finite
pub type pdn_controller_fn = Option<
    unsafe extern "C" fn(
        state: *const pdn_controller_state,
        values: *mut pdn_controller_values,
        user_data: *mut c_void,
    ) -> i32,
>;

pub(super) type Function = unsafe extern "C" fn(
    state: *const pdn_controller_state,
    values: *mut pdn_controller_values,
    user_data: *mut c_void,
) -> i32;

/// Coordinates that arrays give.
fn coordinates(
    call: &Call,
    model: &Model,
    [joints, coordinates]: [*const i32; 2],
    count: usize,
    what: &str,
) -> Result<Vec<JointCoordinate>> {
    let (joint_list, coordinate_list) = (format!("{what}_joints"), format!("{what}_coordinates"));
    let joints = call.slice(joints, count, &joint_list)?;
    let coordinates = call.slice(coordinates, count, &coordinate_list)?;
    let pairs = joints.iter().zip(coordinates).enumerate();
    pairs
        .map(|(i, (&id, &which))| {
            Ok(JointCoordinate {
                joint: Kind::Joint.index_in(model, id, &format!("{joint_list}[{i}]"))?,
                coordinate: coordinate(which, &format!("{coordinate_list}[{i}]"))?,
            })
        })
        .collect()
}

/// The states that arrays give, which may be NULL.
fn states(
    call: &Call,
    initial: *const f64,
    sizes: *const f64,
    count: usize,
) -> Result<Vec<ControllerState>> {
    let list = |given: *const f64, name: &str| match given.is_null() {
        true => Ok(None),
        false => Ok(Some(call.numbers(given, count, name)?)),
    };
    let (initial, sizes) = (list(initial, "initial")?, list(sizes, "sizes")?);
    let fits = i32::try_from(count).is_ok();
    if !fits {
        return Err(Error::size(
            "state_count",
            "no more than an int32_t holds",
            count,
        ));
    }
    let none = ControllerState::default();
    let state = |k: usize| ControllerState {
        initial: initial.map_or(none.initial, |list| list[k]),
        size: sizes.map_or(none.size, |list| list[k]),
    };
    Ok((0..count).map(state).collect())
}

pub(super) fn law(
    function: Function,
    gives_tangents: bool,
    user_data: *mut c_void,
    destroy: pdn_destroy_fn,
) -> ControllerLaw {
    let callback = Callback::<Function>::new(function, user_data, destroy);
    ControllerLaw {
        function: Arc::new(move |input, output| call_back(&callback, input, output)),
        gives_tangents,
    }
}

fn call_back(
    callback: &Callback<Function>,
    input: &ControllerInput,
    output: &mut ControllerOutput,
) -> Result<()> {
    let state = pdn_controller_state {
        struct_size: size_of::<pdn_controller_state>(),
        time: input.time,
        input_count: input.values.len(),
        inputs: input.values.as_ptr(),
        input_rates: input.rates.as_ptr(),
        state_count: input.states.len(),
        states: input.states.as_ptr(),
    };
    let tangents = match &mut output.tangents {
        Some(all) => all.each_mut().map(|m| m.as_mut_slice().as_mut_ptr()),
        None => [null_mut(); 3],
    };
    let mut values = pdn_controller_values {
        struct_size: size_of::<pdn_controller_values>(),
        output_count: output.efforts.len(),
        efforts: output.efforts.as_mut_ptr(),
        state_rates: output.state_rates.as_mut_ptr(),
        by_inputs: tangents[0],
        by_input_rates: tangents[1],
        by_states: tangents[2],
    };
    callback.invoke("controller", |function, user_data| {
        // SAFETY: the caller gave the function with its `user_data`; the arrays are as long as they
        // are said to be, matrices column by column.
        unsafe { function(&raw const state, &raw mut values, user_data) }
    })
}

/// Adds a controller: efforts on joint coordinates by a function of the caller that reads any joint
/// coordinates and their rates, and may have states of its own.
///
/// Without states it is a law that reads other coordinates, such as the gas force on a piston by
/// the angle of the crank. States x follow x' = f(t, coordinates, rates, x), which the function
/// gives: integrals of controllers, filters, actuators that lag, inflow. They are solved for with
/// the motion in all analyses, and are among the states that multipliers and modes count.
///
/// @param model  the model; not NULL
/// @param input_joints  array of length [input_count]: ids of the joints of the coordinates that
///     are read; may be NULL if there are none
/// @param input_coordinates  array of length [input_count]: PDN_DISPLACEMENT ... PDN_ROTATION_3 of
///     each, one that the joint has; each coordinate of a joint at most once; may be NULL if
///     there are none
/// @param input_count  number of coordinates that are read
/// @param output_joints  array of length [output_count]: ids of the joints of the coordinates that
///     it acts on
/// @param output_coordinates  array of length [output_count]: PDN_DISPLACEMENT ... PDN_ROTATION_3
///     of each, as for what is read
/// @param output_count  number of coordinates that it acts on, at least 1
/// @param initial  array of length [state_count]: the states where a march begins; NULL for zero
/// @param sizes  array of length [state_count]: what each state is of the order of, positive, by
///     which equations are scaled and differences taken; NULL for 1
/// @param state_count  number of states
/// @param tangents  PDN_TANGENTS_GIVEN if the function writes tangents, which
///     ::pdn_model_check_tangents checks; PDN_TANGENTS_DIFFERENCED if the library is to find them
///     by differences, with two calls for each coordinate, rate and state
/// @param function  the controller, see ::pdn_controller_fn for when it is called; not NULL
/// @param user_data  handed to the function; may be NULL
/// @param destroy  called once with user_data when the model, its copies in solutions included, no
///     longer needs it, on the thread that frees the last; may be NULL. It is not called if this
///     call fails
/// @param force  the force's id; may be NULL if it is not wanted; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_SIZE, PDN_ERR_NOT_FINITE, PDN_ERR_ID, PDN_ERR_VALUE,
///     PDN_ERR_NOT_AVAILABLE
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_add_controller(
    model: *mut pdn_model,
    input_joints: *const i32,
    input_coordinates: *const i32,
    input_count: usize,
    output_joints: *const i32,
    output_coordinates: *const i32,
    output_count: usize,
    initial: *const f64,
    sizes: *const f64,
    state_count: usize,
    tangents: i32,
    function: pdn_controller_fn,
    user_data: *mut c_void,
    destroy: pdn_destroy_fn,
    force: *mut i32,
) -> pdn_status {
    let read = |call: &Call, model: &Model| {
        let inputs = [input_joints, input_coordinates];
        let inputs = coordinates(call, model, inputs, input_count, "input")?;
        let outputs = [output_joints, output_coordinates];
        let outputs = coordinates(call, model, outputs, output_count, "output")?;
        let states = states(call, initial, sizes, state_count)?;
        // All that could be refused comes before `user_data` is taken over.
        model.require_controller_of(&inputs, &outputs, &states)?;
        let gives_tangents = gives_tangents(tangents)?;
        let function = call.function(function, "function")?;
        Ok((inputs, outputs, states, gives_tangents, function))
    };
    add_object(
        model,
        Kind::Force,
        (force, "force"),
        read,
        |model, (inputs, outputs, states, gives_tangents, function)| {
            let law = law(function, gives_tangents, user_data, destroy);
            model.add_controller(&inputs, &outputs, &states, law)
        },
    )
}

/// Numbers of the coordinates that a controller reads, of those that it acts on, and of its states.
///
/// @param model  the model; not NULL
/// @param force  id of a force by ::pdn_model_add_controller
/// @param input_count  number of coordinates that it reads; may be NULL
/// @param output_count  number of coordinates that it acts on; may be NULL
/// @param state_count  number of its states; may be NULL
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID, PDN_ERR_NOT_AVAILABLE (the force is no controller)
///
/// Threads: `model` is `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_controller_counts(
    model: *const pdn_model,
    force: i32,
    input_count: *mut i32,
    output_count: *mut i32,
    state_count: *mut i32,
) -> pdn_status {
    guard(|call| {
        let model = call.shared(model, "model")?;
        let force = Kind::Force.index_in(&model, force, "force")?;
        let controller = model.require_controller(force)?;
        let lists = [
            (input_count, controller.inputs.len(), "input_count"),
            (output_count, controller.outputs.len(), "output_count"),
            (state_count, controller.states.len(), "state_count"),
        ];
        for (out, count, name) in lists {
            if let Some(out) = call.out_optional(out, name)? {
                // No more were given than fit.
                out.set(count as i32);
            }
        }
        Ok(())
    })
}

/// A coordinate that a controller reads or acts on.
///
/// @param model  the model; not NULL
/// @param force  id of a force by ::pdn_model_add_controller
/// @param index  number of the coordinate, from 0: those that it reads, then those that it acts on
/// @param joint  id of its joint; written on success only
/// @param coordinate  the coordinate: PDN_DISPLACEMENT, ...; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID, PDN_ERR_NOT_AVAILABLE (the force is no controller)
///
/// Threads: `model` is `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_controller_coordinate(
    model: *const pdn_model,
    force: i32,
    index: i32,
    joint: *mut i32,
    coordinate: *mut i32,
) -> pdn_status {
    guard(|call| {
        let model = call.shared(model, "model")?;
        let force = Kind::Force.index_in(&model, force, "force")?;
        let controller = model.require_controller(force)?;
        let all: Vec<_> = controller
            .inputs
            .iter()
            .chain(&controller.outputs)
            .collect();
        let at = all[number(index, all.len(), "index", "a coordinate of the controller")?];
        let (joint, coordinate) = (
            call.out(joint, "joint")?,
            call.out(coordinate, "coordinate")?,
        );
        joint.set(Kind::Joint.id(at.joint));
        coordinate.set(coordinate_code(at.coordinate));
        Ok(())
    })
}

/// A state of a controller.
///
/// @param model  the model; not NULL
/// @param force  id of a force by ::pdn_model_add_controller
/// @param index  number of the state, from 0
/// @param initial  its value where a march begins; may be NULL
/// @param size  what it is of the order of; may be NULL
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID, PDN_ERR_NOT_AVAILABLE (the force is no controller)
///
/// Threads: `model` is `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_controller_state(
    model: *const pdn_model,
    force: i32,
    index: i32,
    initial: *mut f64,
    size: *mut f64,
) -> pdn_status {
    guard(|call| {
        let model = call.shared(model, "model")?;
        let force = Kind::Force.index_in(&model, force, "force")?;
        let states = &model.require_controller(force)?.states;
        let state = states[number(index, states.len(), "index", "a state of the controller")?];
        let out = [
            (call.out_optional(initial, "initial")?, state.initial),
            (call.out_optional(size, "size")?, state.size),
        ];
        for (out, value) in out {
            if let Some(out) = out {
                out.set(value);
            }
        }
        Ok(())
    })
}
