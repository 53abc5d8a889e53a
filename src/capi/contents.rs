//! What a model holds: for those who load one, or have not built it themselves.

use super::bushing::angles_code;
use super::guard::{guard, init};
use super::id::Kind;
use super::joint::{coordinate_code, joint_code};
use super::model::{PDN_GROUND, choose, count, number, pdn_frame, pdn_model};
use super::options::Options;
use super::parameter::{PDN_NUMBER_DAMPING, PDN_NUMBER_REST, PDN_NUMBER_STIFFNESS, signal_place};
use super::section::pdn_section;
use super::shell::place_code;
use super::status::pdn_status;
use crate::elements::{Attachment, ForcePlace, JointKind};
use crate::error::{Error, ErrorKind, Result};
use crate::model::{ForceDefinition, ForceNumber, Model};

/// Kind of force: springs and dampers on a joint coordinate.
pub const PDN_FORCE_IS_SPRING_DAMPER: i32 = 1100;
/// Kind of force: an actuator on a joint coordinate.
pub const PDN_FORCE_IS_ACTUATOR: i32 = 1101;
/// Kind of force: a law of the user on a joint coordinate.
pub const PDN_FORCE_IS_COORDINATE_LAW: i32 = 1102;
/// Kind of force: a viscoelastic element on a joint coordinate.
pub const PDN_FORCE_IS_VISCOELASTIC: i32 = 1103;
/// Kind of force: a viscous damper between two bodies.
pub const PDN_FORCE_IS_VISCOUS_DAMPER: i32 = 1104;
/// Kind of force: a bushing between two frames.
pub const PDN_FORCE_IS_BUSHING: i32 = 1105;
/// Kind of force: forces of the user on nodes.
pub const PDN_FORCE_IS_USER_FORCE: i32 = 1106;
/// Kind of force: a controller.
pub const PDN_FORCE_IS_CONTROLLER: i32 = 1107;
/// Kind of force: forces of the user on a shell element.
pub const PDN_FORCE_IS_SURFACE_FORCE: i32 = 1108;
/// Kind of force: forces of the user along a beam element.
pub const PDN_FORCE_IS_LINE_FORCE: i32 = 1109;

/// Numbers of a force: relaxation times of the branches of a viscoelastic element. Parameters do
/// not move them.
pub const PDN_NUMBER_RELAXATION_TIME: i32 = 3608;

/// A joint of a model. Initialise with `PDN_INIT(pdn_joint_info, &info)`.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct pdn_joint_info {
    /// Set by the initialiser.
    pub struct_size: usize,
    /// PDN_JOINT_RIGID ... PDN_JOINT_STRUT.
    pub kind: i32,
    /// Id of the first node, or PDN_GROUND.
    pub first: i32,
    /// Id of the second node, or PDN_GROUND.
    pub second: i32,
    /// Zero.
    pub reserved: i32,
    /// Advance of a screw for one turn; zero of other joints.
    pub pitch: f64,
    /// Origin of the first frame in the reference configuration, global coordinates.
    pub first_position: [f64; 3],
    /// Axes of the first frame there, a rotation matrix, column by column.
    pub first_rotation: [f64; 9],
    /// Origin of the second frame, likewise.
    pub second_position: [f64; 3],
    /// Axes of the second frame, likewise.
    pub second_rotation: [f64; 9],
}

// SAFETY: all fields are plain numbers, `struct_size` is the first, no padding.
unsafe impl Options for pdn_joint_info {
    const SIZES: &'static [usize] = &[224];
}

/// A force of a model. Initialise with `PDN_INIT(pdn_force_info, &info)`.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct pdn_force_info {
    /// Set by the initialiser.
    pub struct_size: usize,
    /// PDN_FORCE_IS_SPRING_DAMPER ... PDN_FORCE_IS_LINE_FORCE; of a controller
    /// ::pdn_model_controller_counts tells more.
    pub kind: i32,
    /// Id of the joint on whose coordinate it acts, or -1.
    pub joint: i32,
    /// The coordinate: PDN_DISPLACEMENT, ...; -1 if it acts on none.
    pub coordinate: i32,
    /// Of what is between two bodies, id of the first node, or PDN_GROUND.
    pub first: i32,
    /// Id of the second node, or PDN_GROUND.
    pub second: i32,
    /// Of a bushing, PDN_ANGLES_ROTATION_VECTOR or PDN_ANGLES_TILT_AND_SPIN; else zero.
    pub angles: i32,
    /// How many numbers PDN_NUMBER_STIFFNESS it has, for ::pdn_model_force_number.
    pub stiffness_count: i32,
    /// The same of PDN_NUMBER_DAMPING.
    pub damping_count: i32,
    /// The same of PDN_NUMBER_RELAXATION_TIME: branches of a viscoelastic element.
    pub branch_count: i32,
    /// Nodes of forces of the user, for ::pdn_model_force_node.
    pub node_count: i32,
    /// Coordinate at which springs are free of effort.
    pub rest: f64,
    /// Of what is between two bodies, origin of the first frame in the reference configuration,
    /// global coordinates.
    pub first_position: [f64; 3],
    /// Axes of the first frame there, a rotation matrix, column by column.
    pub first_rotation: [f64; 9],
    /// Origin of the second frame, likewise.
    pub second_position: [f64; 3],
    /// Axes of the second frame, likewise.
    pub second_rotation: [f64; 9],
    /// Of forces of the user on a shell, id of the element; else -1.
    pub shell_element: i32,
    /// Where on it: PDN_SHELL_SURFACE or an edge; else -1.
    pub shell_place: i32,
    /// Of forces of the user along a beam, id of the element; else -1.
    pub beam_element: i32,
    /// Of forces of the user on nodes, 1 if these were declared apart; else 0.
    pub nodes_apart: i32,
    /// Of forces of the user along a beam with PDN_FRAME_UNTWISTED, the direction axis_2; else
    /// zero.
    pub axis_2: [f64; 3],
}

// SAFETY: all fields are plain numbers, `struct_size` is the first, no padding.
unsafe impl Options for pdn_force_info {
    const SIZES: &'static [usize] = &[248, 256, 264, 288];
}

/// Prepares a struct for ::pdn_model_joint; use `PDN_INIT(pdn_joint_info, &info)`.
///
/// @param info  the struct; not NULL
/// @param struct_size  `sizeof *info`
///
/// Threads: any.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_joint_info_init(info: *mut pdn_joint_info, struct_size: usize) {
    init(info, struct_size, "info");
}

/// Prepares a struct for ::pdn_model_force; use `PDN_INIT(pdn_force_info, &info)`.
///
/// @param info  the struct; not NULL
/// @param struct_size  `sizeof *info`
///
/// Threads: any.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_force_info_init(info: *mut pdn_force_info, struct_size: usize) {
    init(info, struct_size, "info");
}

/// An id, or what stands for the ground.
fn id_of(node: Option<usize>) -> i32 {
    node.map_or(PDN_GROUND, |node| Kind::Node.id(node))
}

fn frames_of(model: &Model, ends: [Attachment; 2]) -> [pdn_frame; 2] {
    ends.map(|end| pdn_frame::from(&model.reference_frame(&end)))
}

/// Kind, bodies and frames of a joint.
///
/// @param model  the model; not NULL
/// @param joint  id of the joint
/// @param out  the joint; initialised by PDN_INIT; filled on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE, PDN_ERR_ID
///
/// Threads: `model` is `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_joint(
    model: *const pdn_model,
    joint: i32,
    out: *mut pdn_joint_info,
) -> pdn_status {
    guard(|call| {
        let model = call.shared(model, "model")?;
        let id = Kind::Joint.index_in(&model, joint, "joint")?;
        let out = call.out_struct(out, "out")?;
        let joint = model.joint(id)?;
        let [first, second] = frames_of(&model, [joint.first, joint.second]);
        out.set(pdn_joint_info {
            kind: joint_code(joint.kind),
            first: id_of(joint.first.node),
            second: id_of(joint.second.node),
            pitch: match joint.kind {
                JointKind::Screw { pitch } => pitch,
                _ => 0.0,
            },
            first_position: first.position,
            first_rotation: first.rotation,
            second_position: second.position,
            second_rotation: second.rotation,
            ..pdn_joint_info::defaults()
        });
        Ok(())
    })
}

fn force_kind(force: &ForceDefinition) -> i32 {
    match force {
        ForceDefinition::SpringDamper { .. } => PDN_FORCE_IS_SPRING_DAMPER,
        ForceDefinition::Actuator { .. } => PDN_FORCE_IS_ACTUATOR,
        ForceDefinition::CoordinateLaw { .. } => PDN_FORCE_IS_COORDINATE_LAW,
        ForceDefinition::Viscoelastic { .. } => PDN_FORCE_IS_VISCOELASTIC,
        ForceDefinition::ViscousDamper { .. } => PDN_FORCE_IS_VISCOUS_DAMPER,
        ForceDefinition::Bushing(_) => PDN_FORCE_IS_BUSHING,
        ForceDefinition::NodeForces { .. } => PDN_FORCE_IS_USER_FORCE,
        ForceDefinition::Controller(_) => PDN_FORCE_IS_CONTROLLER,
        ForceDefinition::SurfaceForces { place, .. } => match place.on_shell() {
            None => PDN_FORCE_IS_LINE_FORCE,
            Some(_) => PDN_FORCE_IS_SURFACE_FORCE,
        },
    }
}

/// Kind of a force, where it acts, and how many numbers it has.
///
/// @param model  the model; not NULL
/// @param force  id of the force
/// @param out  the force; initialised by PDN_INIT; filled on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE, PDN_ERR_ID
///
/// Threads: `model` is `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_force(
    model: *const pdn_model,
    force: i32,
    out: *mut pdn_force_info,
) -> pdn_status {
    guard(|call| {
        let model = call.shared(model, "model")?;
        let id = Kind::Force.index_in(&model, force, "force")?;
        let out = call.out_struct(out, "out")?;
        let force = model.force(id)?;
        let numbers = |which| force.numbers(which).len() as i32;
        let at = force.at();
        let mut info = pdn_force_info {
            kind: force_kind(force),
            joint: at.map_or(-1, |at| Kind::Joint.id(at.joint)),
            coordinate: at.map_or(-1, |at| coordinate_code(at.coordinate)),
            first: PDN_GROUND,
            second: PDN_GROUND,
            stiffness_count: numbers(ForceNumber::Stiffness),
            damping_count: numbers(ForceNumber::Damping),
            branch_count: numbers(ForceNumber::RelaxationTime),
            node_count: force.user_nodes().len() as i32,
            rest: force
                .numbers(ForceNumber::Rest)
                .first()
                .copied()
                .unwrap_or(0.0),
            shell_element: -1,
            shell_place: -1,
            beam_element: -1,
            ..pdn_force_info::defaults()
        };
        if let ForceDefinition::SurfaceForces { element, place, .. } = force {
            match place.on_shell() {
                Some(place) => {
                    info.shell_element = Kind::ShellElement.id(*element);
                    info.shell_place = place_code(place);
                }
                None => {
                    info.beam_element = Kind::BeamElement.id(*element);
                    if let ForcePlace::UntwistedLine(axis_2) = place {
                        info.axis_2 = (*axis_2).into();
                    }
                }
            }
        }
        if let Some(ends) = force.ends() {
            let [first, second] = frames_of(&model, ends);
            [info.first, info.second] = ends.map(|end| id_of(end.node));
            (info.first_position, info.first_rotation) = (first.position, first.rotation);
            (info.second_position, info.second_rotation) = (second.position, second.rotation);
        }
        if let ForceDefinition::NodeForces { apart: true, .. } = force {
            info.nodes_apart = 1;
        }
        if let ForceDefinition::Bushing(bushing) = force {
            info.angles = angles_code(bushing.angles);
        }
        out.set(info);
        Ok(())
    })
}

/// A sort of numbers of forces.
pub(super) fn force_number(number: i32) -> Result<ForceNumber> {
    let table = [
        (PDN_NUMBER_STIFFNESS, ForceNumber::Stiffness),
        (PDN_NUMBER_DAMPING, ForceNumber::Damping),
        (PDN_NUMBER_RELAXATION_TIME, ForceNumber::RelaxationTime),
        (PDN_NUMBER_REST, ForceNumber::Rest),
    ];
    let expected = "PDN_NUMBER_STIFFNESS, PDN_NUMBER_DAMPING, PDN_NUMBER_RELAXATION_TIME or \
                    PDN_NUMBER_REST";
    choose(&table, number, "number", expected)
}

/// A number of a force, with the factors of parameters.
///
/// Of a spring-damper the coefficients of the powers of the growth and of the rate, from the first;
/// of a viscoelastic element as PDN_NUMBER_STIFFNESS the long-term stiffness, then that of each
/// branch; of viscous dampers and bushings their matrices, column by column. Of a spring-damper or
/// viscoelastic element as PDN_NUMBER_REST the one coordinate at which it is free of effort.
///
/// @param model  the model; not NULL
/// @param force  id of the force
/// @param number  PDN_NUMBER_STIFFNESS, PDN_NUMBER_DAMPING, PDN_NUMBER_RELAXATION_TIME or
///     PDN_NUMBER_REST
/// @param index  which of these, from 0; their count is in pdn_force_info
/// @param out  the number; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID, PDN_ERR_VALUE
///
/// Threads: `model` is `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_force_number(
    model: *const pdn_model,
    force: i32,
    number: i32,
    index: i32,
    out: *mut f64,
) -> pdn_status {
    guard(|call| {
        let model = call.shared(model, "model")?;
        let id = Kind::Force.index_in(&model, force, "force")?;
        let numbers = model.force(id)?.numbers(force_number(number)?);
        let place = super::model::number(index, numbers.len(), "index", "a number")?;
        call.out(out, "out")?.set(numbers[place]);
        Ok(())
    })
}

/// A node of forces of the user.
///
/// @param model  the model; not NULL
/// @param force  id of the force
/// @param index  which of its nodes, from 0; their count is in pdn_force_info
/// @param node  the node's id; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID
///
/// Threads: `model` is `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_force_node(
    model: *const pdn_model,
    force: i32,
    index: i32,
    node: *mut i32,
) -> pdn_status {
    guard(|call| {
        let model = call.shared(model, "model")?;
        let id = Kind::Force.index_in(&model, force, "force")?;
        let nodes = model.force(id)?.user_nodes();
        let place = number(index, nodes.len(), "index", "a node of the force")?;
        call.out(node, "node")?.set(Kind::Node.id(nodes[place]));
        Ok(())
    })
}

/// Number of nodes of a beam element.
///
/// @param model  the model; not NULL
/// @param element  id of the beam element
/// @param count  the number; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID
///
/// Threads: `model` is `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_beam_element_node_count(
    model: *const pdn_model,
    element: i32,
    count: *mut i32,
) -> pdn_status {
    guard(|call| {
        let model = call.shared(model, "model")?;
        let element = Kind::BeamElement.index_in(&model, element, "element")?;
        let nodes = &model.beam_definition(element)?.nodes;
        call.out(count, "count")?.set(nodes.len() as i32);
        Ok(())
    })
}

/// A node of a beam element, in order along the beam.
///
/// @param model  the model; not NULL
/// @param element  id of the beam element
/// @param index  which of its nodes, from 0
/// @param node  the node's id; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID
///
/// Threads: `model` is `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_beam_element_node(
    model: *const pdn_model,
    element: i32,
    index: i32,
    node: *mut i32,
) -> pdn_status {
    guard(|call| {
        let model = call.shared(model, "model")?;
        let element = Kind::BeamElement.index_in(&model, element, "element")?;
        let nodes = &model.beam_definition(element)?.nodes;
        let place = number(index, nodes.len(), "index", "a node of the element")?;
        call.out(node, "node")?.set(Kind::Node.id(nodes[place]));
        Ok(())
    })
}

/// Cross-section of a beam element at a place, with the factors of parameters.
///
/// @param model  the model; not NULL
/// @param element  id of the beam element
/// @param station  place along the element, from -1 at its first to 1 at its last node
/// @param out  the section, in its own axes; initialised by PDN_INIT; filled on success only
/// @param twist  angle by which its axes are turned about axis 1 from those between the nodes
///     [radian]; may be NULL if it is not wanted; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE, PDN_ERR_NOT_FINITE, PDN_ERR_ID, PDN_ERR_VALUE
///
/// Threads: `model` is `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_beam_section(
    model: *const pdn_model,
    element: i32,
    station: f64,
    out: *mut pdn_section,
    twist: *mut f64,
) -> pdn_status {
    guard(|call| {
        let model = call.shared(model, "model")?;
        let element = Kind::BeamElement.index_in(&model, element, "element")?;
        let out = call.out_struct(out, "out")?;
        let twist_out = call.out_optional(twist, "twist")?;
        let (section, twist) = model.beam_section(element, station)?;
        let mut filled = pdn_section::defaults();
        filled.fill([&section.stiffness, &section.mass, &section.damping]);
        out.set(filled);
        if let Some(twist_out) = twist_out {
            twist_out.set(twist);
        }
        Ok(())
    })
}

/// Number of inertias: bodies, masses and inertias on nodes; their ids follow each other from
/// PDN_FIRST_INERTIA on.
///
/// @param model  the model; not NULL
/// @param count  the number; written on success only
/// @return PDN_OK, PDN_ERR_NULL
///
/// Threads: `model` is `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_inertia_count(
    model: *const pdn_model,
    count: *mut i32,
) -> pdn_status {
    self::count(model, count, |model| model.object_count(Kind::Inertia))
}

/// The inertia of a body, or a mass or inertia on a node, with the factors of parameters.
///
/// @param model  the model; not NULL
/// @param inertia  id of the inertia
/// @param node  the node's id; written on success only
/// @param matrix  array of shape 6 x 6: inertia about the node, along its axes, as in
///     ::pdn_model_add_inertia; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID
///
/// Threads: `model` is `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_inertia(
    model: *const pdn_model,
    inertia: i32,
    node: *mut i32,
    matrix: *mut f64,
) -> pdn_status {
    guard(|call| {
        let model = call.shared(model, "model")?;
        let index = Kind::Inertia.index_in(&model, inertia, "inertia")?;
        let node_out = call.out(node, "node")?;
        let matrix_out = call.out_slice(matrix, 36, 36, "matrix")?;
        if let Some((node, inertia)) = model.inertias().nth(index) {
            node_out.set(Kind::Node.id(node));
            matrix_out.set(inertia.as_slice());
        }
        Ok(())
    })
}

/// The inertia of a node: of a rigid body its own, of others the one that was added first.
///
/// @param model  the model; not NULL
/// @param node  id of the node
/// @param inertia  id of the inertia; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID, PDN_ERR_NOT_AVAILABLE (the node has none)
///
/// Threads: `model` is `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_inertia_of(
    model: *const pdn_model,
    node: i32,
    inertia: *mut i32,
) -> pdn_status {
    guard(|call| {
        let model = call.shared(model, "model")?;
        let node = Kind::Node.index_in(&model, node, "node")?;
        let out = call.out(inertia, "inertia")?;
        let found = model.inertias().position(|(other, _)| other == node);
        let found = found.ok_or_else(|| {
            let message = format!("node: expected one that has inertia, got node {node}");
            Error::new(ErrorKind::NotAvailable, message)
        })?;
        out.set(Kind::Inertia.id(found));
        Ok(())
    })
}

/// A prescribed coordinate; ::pdn_model_summary tells how many there are, whose ids follow each
/// other from PDN_FIRST_PRESCRIBED on, and ::pdn_model_sample_signal what they follow.
///
/// @param model  the model; not NULL
/// @param prescribed  id of the prescribed coordinate
/// @param joint  id of its joint; written on success only
/// @param coordinate  PDN_DISPLACEMENT, ...; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID
///
/// Threads: `model` is `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_prescribed(
    model: *const pdn_model,
    prescribed: i32,
    joint: *mut i32,
    coordinate: *mut i32,
) -> pdn_status {
    guard(|call| {
        let model = call.shared(model, "model")?;
        let index = Kind::Prescribed.index_in(&model, prescribed, "prescribed")?;
        let joint_out = call.out(joint, "joint")?;
        let coordinate_out = call.out(coordinate, "coordinate")?;
        let (at, _) = &model.prescribed()[index];
        joint_out.set(Kind::Joint.id(at.joint));
        coordinate_out.set(coordinate_code(at.coordinate));
        Ok(())
    })
}

/// Number of coordinates of a linear relation.
///
/// @param model  the model; not NULL
/// @param relation  id of the relation
/// @param count  the number; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID
///
/// Threads: `model` is `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_relation_term_count(
    model: *const pdn_model,
    relation: i32,
    count: *mut i32,
) -> pdn_status {
    guard(|call| {
        let model = call.shared(model, "model")?;
        let relation = Kind::Relation.index_in(&model, relation, "relation")?;
        let terms = &model.relation(relation)?.terms;
        call.out(count, "count")?.set(terms.len() as i32);
        Ok(())
    })
}

/// A coordinate of a linear relation, and its coefficient.
///
/// @param model  the model; not NULL
/// @param relation  id of the relation
/// @param index  which of its coordinates, from 0
/// @param joint  id of the joint; written on success only
/// @param coordinate  PDN_DISPLACEMENT, ...; written on success only
/// @param coefficient  the coefficient; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID
///
/// Threads: `model` is `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_relation_term(
    model: *const pdn_model,
    relation: i32,
    index: i32,
    joint: *mut i32,
    coordinate: *mut i32,
    coefficient: *mut f64,
) -> pdn_status {
    guard(|call| {
        let model = call.shared(model, "model")?;
        let relation = Kind::Relation.index_in(&model, relation, "relation")?;
        let terms = &model.relation(relation)?.terms;
        let place = number(index, terms.len(), "index", "a coordinate of the relation")?;
        let joint_out = call.out(joint, "joint")?;
        let coordinate_out = call.out(coordinate, "coordinate")?;
        let coefficient_out = call.out(coefficient, "coefficient")?;
        let (at, given) = &terms[place];
        joint_out.set(Kind::Joint.id(at.joint));
        coordinate_out.set(coordinate_code(at.coordinate));
        coefficient_out.set(*given);
        Ok(())
    })
}

/// Values of a signal of the model in time.
///
/// @param model  the model; not NULL
/// @param id  what has the signal, as in ::pdn_model_move_signal
/// @param component  of a load PDN_FORCE_1, ... or PDN_MOMENT_3, of gravity from 0 to 2; 0 for all
///     else
/// @param period  period of the motion, that harmonics refer to [time]
/// @param times  array of length [count]: times
/// @param count  number of times
/// @param values  array of length [count]: the values there; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_SIZE, PDN_ERR_NOT_FINITE, PDN_ERR_ID, PDN_ERR_VALUE,
///     PDN_ERR_NOT_AVAILABLE (it has no such signal), PDN_ERR_CALLBACK
///
/// Threads: `model` is `const`. Signals' functions are called on this thread.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_sample_signal(
    model: *const pdn_model,
    id: i32,
    component: i32,
    period: f64,
    times: *const f64,
    count: usize,
    values: *mut f64,
) -> pdn_status {
    guard(|call| {
        let model = call.shared(model, "model")?;
        let place = signal_place(&model, id, component)?;
        let period = call.number(period, "period")?;
        let times = call.numbers(times, count, "times")?;
        let out = call.out_slice(values, count, count, "values")?;
        out.set(&model.sample_signal(place, period, times)?);
        Ok(())
    })
}
