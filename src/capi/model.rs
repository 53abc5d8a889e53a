//! Models: the mechanism in its reference configuration, in global coordinates.

use super::call::Call;
use super::guard::{free, guard};
use super::handle::Handle;
use super::id::Kind;
use super::status::pdn_status;
use crate::error::{Error, ErrorKind, Result, require_finite};
use crate::model::{Labels, Model};
use crate::motion::Motion;
use nalgebra::{Matrix3, Matrix6, Vector3};

/// In place of a node's id: the ground, which does not move.
pub const PDN_GROUND: i32 = -1;

/// A mechanism. Made by ::pdn_model_new, freed by ::pdn_model_free.
///
/// It is described in its reference configuration: points, directions and frames are those of the
/// undeformed, assembled mechanism, all in the global axes, which are fixed to the ground. Any
/// consistent set of units will do (such as metre, newton, kilogram, second); angles are in
/// radians.
///
/// All that is added has an id, in the order in which it was added: nodes from PDN_FIRST_NODE on,
/// joints from PDN_FIRST_JOINT on, and so on. A call that fails leaves the model as it was.
pub struct pdn_model {
    _private: [u8; 0],
}

impl Handle for pdn_model {
    type Core = Model;

    fn labels(core: &Model) -> Option<&Labels> {
        Some(core.labels())
    }
}

/// Position and axes of a frame. This struct will never change.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct pdn_frame {
    /// Its origin, in global coordinates [length].
    pub position: [f64; 3],
    /// Its axes, in global coordinates: a rotation matrix, 3 x 3, column by column, the columns
    /// being axes 1, 2, 3. Rounding up to 1e-8 is tolerated, and removed.
    pub rotation: [f64; 9],
}

const _: () = assert!(size_of::<pdn_frame>() == 96);

/// The nodes that an array of ids names, which may be of length 0.
pub(super) fn nodes(
    call: &Call,
    model: &Model,
    (ids, count): (*const i32, usize),
    name: &str,
) -> Result<Vec<usize>> {
    let ids = call.slice(ids, count, name)?.iter().enumerate();
    ids.map(|(i, &id)| Kind::Node.index_in(model, id, &format!("{name}[{i}]")))
        .collect()
}

/// The node that an id names, or the ground.
pub(super) fn body(model: &Model, id: i32, name: &str) -> Result<Option<usize>> {
    if id == PDN_GROUND {
        return Ok(None);
    }
    let node = Kind::Node.index_or("PDN_GROUND or ", id, model.node_count(), name);
    node.map(Some)
}

/// How many elements a function is about; that there are so many is for the model to say.
pub(super) fn element_count(elements: i32) -> Result<usize> {
    usize::try_from(elements).map_err(|_| Error::size("elements", "at least 1", elements))
}

/// Body of a function that adds a thing of a kind, which `add` makes of what it reads, and gives
/// its id where that is wanted.
pub(super) fn add_object<T>(
    model: *mut pdn_model,
    kind: Kind,
    (id, name): (*mut i32, &str),
    read: impl FnOnce(&Call, &Model) -> Result<T>,
    add: impl FnOnce(&mut Model, T) -> Result<usize>,
) -> pdn_status {
    guard(|call| {
        let mut model = call.exclusive(model, "model")?;
        let given = read(call, &model)?;
        let out = call.out_optional(id, name)?;
        let id = kind.next(&model, 1, name)?;
        add(&mut model, given)?;
        if let Some(out) = out {
            out.set(id);
        }
        Ok(())
    })
}

/// Number `given` of `count` things that have no ids.
pub(super) fn number(given: i32, count: usize, name: &str, what: &str) -> Result<usize> {
    match usize::try_from(given) {
        Ok(index) if index < count => Ok(index),
        _ => {
            let limit = match count {
                0 => "though there is none yet".to_owned(),
                n => format!("from 0 to {}", n - 1),
            };
            let message = format!("{name}: expected {what} {limit}, got {given}");
            Err(Error::new(ErrorKind::Identifier, message))
        }
    }
}

/// The item of `table` that `given` names.
pub(super) fn choose<T: Copy>(
    table: &[(i32, T)],
    given: i32,
    name: &str,
    expected: &str,
) -> Result<T> {
    table
        .iter()
        .find(|(code, _)| *code == given)
        .map(|(_, item)| *item)
        .ok_or_else(|| Error::value(name, expected, given))
}

pub(super) fn vector(call: &Call, x: *const f64, name: &str) -> Result<Vector3<f64>> {
    call.array::<3>(x, name).map(Vector3::from)
}

pub(super) fn motion(call: &Call, frame: *const pdn_frame, name: &str) -> Result<Motion> {
    let frame = call.reference(frame, name)?;
    require_finite(&format!("{name} position"), &frame.position)?;
    require_finite(&format!("{name} rotation"), &frame.rotation)?;
    Ok(Motion::new(
        Matrix3::from_column_slice(&frame.rotation),
        frame.position.into(),
    ))
}

impl From<&Motion> for pdn_frame {
    fn from(motion: &Motion) -> Self {
        pdn_frame {
            position: motion.position.into(),
            rotation: std::array::from_fn(|i| motion.rotation[i]),
        }
    }
}

/// Makes an empty model.
///
/// @param model  the model, to be freed by ::pdn_model_free; written on success only
/// @return PDN_OK, PDN_ERR_NULL
///
/// Threads: any.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_new(model: *mut *mut pdn_model) -> pdn_status {
    guard(|call| {
        call.out(model, "model")?.give(Model::new());
        Ok(())
    })
}

/// Frees a model. Solutions made of it stay valid.
///
/// @param model  the model; NULL does nothing
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_free(model: *mut pdn_model) {
    free(model);
}

/// Body of a function that gives a count.
pub(super) fn count(
    model: *const pdn_model,
    out: *mut i32,
    counted: impl FnOnce(&Model) -> usize,
) -> pdn_status {
    guard(|call| {
        let model = call.shared(model, "model")?;
        // No more were made than ids can name.
        call.out(out, "count")?.set(counted(&model) as i32);
        Ok(())
    })
}

/// Number of nodes; their ids follow each other from PDN_FIRST_NODE on.
///
/// @param model  the model; not NULL
/// @param count  the number; written on success only
/// @return PDN_OK, PDN_ERR_NULL
///
/// Threads: `model` is `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_node_count(
    model: *const pdn_model,
    count: *mut i32,
) -> pdn_status {
    self::count(model, count, Model::node_count)
}

/// Number of joints; their ids follow each other from PDN_FIRST_JOINT on.
///
/// @param model  the model; not NULL
/// @param count  the number; written on success only
/// @return PDN_OK, PDN_ERR_NULL
///
/// Threads: `model` is `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_joint_count(
    model: *const pdn_model,
    count: *mut i32,
) -> pdn_status {
    self::count(model, count, Model::joint_count)
}

/// Number of beam elements; their ids follow each other from PDN_FIRST_BEAM_ELEMENT on.
///
/// @param model  the model; not NULL
/// @param count  the number; written on success only
/// @return PDN_OK, PDN_ERR_NULL
///
/// Threads: `model` is `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_element_count(
    model: *const pdn_model,
    count: *mut i32,
) -> pdn_status {
    self::count(model, count, Model::beam_element_count)
}

/// Total mass and centre of mass in the reference configuration.
///
/// @param model  the model; not NULL
/// @param mass  total mass of bodies, masses and beams [mass]; written on success only
/// @param centre  array of length 3: centre of mass, global coordinates [length]; may be NULL if it
///     is not wanted; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_AVAILABLE (a centre is wanted, and the mass is zero),
///     PDN_ERR_OVERFLOW
///
/// Threads: `model` is `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_mass(
    model: *const pdn_model,
    mass: *mut f64,
    centre: *mut f64,
) -> pdn_status {
    guard(|call| {
        let model = call.shared(model, "model")?;
        let mass_out = call.out(mass, "mass")?;
        let centre_out = call.out_optional(centre.cast::<[f64; 3]>(), "centre")?;
        let (mass, moment) = model.mass_and_moment()?;
        if let Some(centre_out) = centre_out {
            if mass <= 0.0 {
                let message = "centre: expected a model that has mass, got one without";
                return Err(Error::new(ErrorKind::NotAvailable, message));
            }
            centre_out.set((moment / mass).into());
        }
        mass_out.set(mass);
        Ok(())
    })
}

/// Frame of a node in the reference configuration.
///
/// @param model  the model; not NULL
/// @param node  id of the node
/// @param frame  its frame; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID
///
/// Threads: `model` is `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_node_frame(
    model: *const pdn_model,
    node: i32,
    frame: *mut pdn_frame,
) -> pdn_status {
    guard(|call| {
        let model = call.shared(model, "model")?;
        let node = Kind::Node.index_in(&model, node, "node")?;
        let frame = call.out(frame, "frame")?;
        if let Some(motion) = model.node(node) {
            frame.set(motion.into());
        }
        Ok(())
    })
}

/// Adds a node: a frame that moves.
///
/// A node needs something that holds or moves it: mass, a beam or a joint.
///
/// @param model  the model; not NULL
/// @param position  array of length 3: its position, global coordinates [length]
/// @param rotation  array of shape 3 x 3: its axes, a rotation matrix column by column, the
///     columns being axes 1, 2, 3 in global coordinates; NULL for axes parallel to the global
///     ones
/// @param node  the node's id; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_VALUE
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_add_node(
    model: *mut pdn_model,
    position: *const f64,
    rotation: *const f64,
    node: *mut i32,
) -> pdn_status {
    guard(|call| {
        let mut model = call.exclusive(model, "model")?;
        let position = vector(call, position, "position")?;
        let rotation = call
            .array_optional::<9>(rotation, "rotation")?
            .map_or_else(Matrix3::identity, |r| Matrix3::from_column_slice(&r));
        let node = call.out(node, "node")?;
        let id = Kind::Node.next(&model, 1, "node")?;
        model.add_node(&Motion::new(rotation, position))?;
        node.set(id);
        Ok(())
    })
}

/// Adds a rigid body: a node at its centre of mass, with axes parallel to the global ones.
///
/// Its inertia has an id, ::pdn_model_inertia_of, by which a parameter can move it.
///
/// @param model  the model; not NULL
/// @param mass  mass, positive [mass]
/// @param centre  array of length 3: centre of mass, global coordinates [length]
/// @param inertia  array of shape 3 x 3: moments of inertia about the centre of mass, in global
///     axes, symmetric and positive semi-definite [mass * length^2]
/// @param node  the node's id; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_VALUE
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_add_rigid_body(
    model: *mut pdn_model,
    mass: f64,
    centre: *const f64,
    inertia: *const f64,
    node: *mut i32,
) -> pdn_status {
    guard(|call| {
        let mut model = call.exclusive(model, "model")?;
        let mass = call.number(mass, "mass")?;
        let centre = vector(call, centre, "centre")?;
        let inertia = Matrix3::from_column_slice(&call.array::<9>(inertia, "inertia")?);
        let node = call.out(node, "node")?;
        let id = Kind::Node.next(&model, 1, "node")?;
        model.add_rigid_body(mass, &centre, &inertia)?;
        node.set(id);
        Ok(())
    })
}

/// Fixes a mass to a node, in addition to what the node has.
///
/// @param model  the model; not NULL
/// @param node  id of the node
/// @param mass  mass, zero or more [mass]
/// @param centre  array of length 3: its centre, global coordinates; need not be at the node
///     [length]
/// @param inertia  array of shape 3 x 3: moments of inertia about the centre, in global axes,
///     symmetric and positive semi-definite [mass * length^2]; NULL for a point mass
/// @param id  id of the inertia; may be NULL if it is not wanted; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_ID, PDN_ERR_VALUE
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_add_mass(
    model: *mut pdn_model,
    node: i32,
    mass: f64,
    centre: *const f64,
    inertia: *const f64,
    id: *mut i32,
) -> pdn_status {
    let read = |call: &Call, model: &Model| {
        let node = Kind::Node.index_in(model, node, "node")?;
        let mass = call.number(mass, "mass")?;
        let centre = vector(call, centre, "centre")?;
        let inertia = call
            .array_optional::<9>(inertia, "inertia")?
            .map_or_else(Matrix3::zeros, |j| Matrix3::from_column_slice(&j));
        Ok((node, mass, centre, inertia))
    };
    add_object(model, Kind::Inertia, (id, "id"), read, |model, given| {
        let (node, mass, centre, inertia) = given;
        model.add_mass(node, mass, &centre, &inertia)
    })
}

/// Fixes an inertia of any kind to a node, in addition to what the node has.
///
/// A unit velocity of the frame (linear 1, 2, 3, angular 1, 2, 3) has the momentum (linear,
/// angular) of the matrix's column. A rigid body of mass m, with centre c and moments of inertia J
/// about the centre, both in the frame, has [m I, -m c~; m c~, J - m c~ c~], where c~ b = c * b.
///
/// @param model  the model; not NULL
/// @param node  id of the node
/// @param frame  the frame that the matrix is about and resolved in; NULL for the node's own
/// @param matrix  array of shape 6 x 6: symmetric and positive semi-definite
///     [mass, mass * length,     mass * length^2]
/// @param id  id of the inertia; may be NULL if it is not wanted; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_ID, PDN_ERR_VALUE
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_add_inertia(
    model: *mut pdn_model,
    node: i32,
    frame: *const pdn_frame,
    matrix: *const f64,
    id: *mut i32,
) -> pdn_status {
    let read = |call: &Call, model: &Model| {
        let node = Kind::Node.index_in(model, node, "node")?;
        let frame = if frame.is_null() {
            None
        } else {
            Some(motion(call, frame, "frame")?)
        };
        let matrix = Matrix6::from_column_slice(&call.array::<36>(matrix, "matrix")?);
        Ok((node, frame, matrix))
    };
    add_object(model, Kind::Inertia, (id, "id"), read, |model, given| {
        let (node, frame, matrix) = given;
        model.add_inertia(node, frame.as_ref(), &matrix)
    })
}
