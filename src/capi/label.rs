//! Labels of what a model is made of.

use super::guard::{guard, guard_or};
use super::id::{Kind, describe};
use super::last_error::copy_message;
use super::model::{choose, pdn_model};
use super::status::pdn_status;
use crate::error::{Error, ErrorKind, Result};
use crate::model::Model;
use libc::c_char;

/// What has a label: a node, or a rigid body, which is one.
pub const PDN_OBJECT_NODE: i32 = 1000;
/// What has a label: a joint.
pub const PDN_OBJECT_JOINT: i32 = 1001;
/// What has a label: a beam element.
pub const PDN_OBJECT_BEAM_ELEMENT: i32 = 1002;
/// What has a label: a shell element.
pub const PDN_OBJECT_SHELL_ELEMENT: i32 = 1003;
/// What has a label: a force, but not a load.
pub const PDN_OBJECT_FORCE: i32 = 1004;
/// What has a label: a linear relation between joint coordinates.
pub const PDN_OBJECT_RELATION: i32 = 1005;
/// What has a label: a load on a node or at a point.
pub const PDN_OBJECT_LOAD: i32 = 1006;
/// What has a label: a load along beam elements.
pub const PDN_OBJECT_BEAM_LOAD: i32 = 1007;
/// What has a label: a load on shell elements.
pub const PDN_OBJECT_SHELL_LOAD: i32 = 1008;
/// What has a label: the inertia of a rigid body, or a mass or inertia on a node.
pub const PDN_OBJECT_INERTIA: i32 = 1009;
/// What has a label: a prescribed coordinate.
pub const PDN_OBJECT_PRESCRIBED: i32 = 1010;

/// Bytes of a label at most, without the NUL.
pub const PDN_LABEL_LENGTH: i32 = 200;

const _: () = assert!(PDN_LABEL_LENGTH as usize == crate::model::LONGEST_LABEL);

fn object_kind(given: i32) -> Result<Kind> {
    let table = [
        (PDN_OBJECT_NODE, Kind::Node),
        (PDN_OBJECT_JOINT, Kind::Joint),
        (PDN_OBJECT_BEAM_ELEMENT, Kind::BeamElement),
        (PDN_OBJECT_SHELL_ELEMENT, Kind::ShellElement),
        (PDN_OBJECT_FORCE, Kind::Force),
        (PDN_OBJECT_RELATION, Kind::Relation),
        (PDN_OBJECT_LOAD, Kind::Load),
        (PDN_OBJECT_BEAM_LOAD, Kind::BeamLoad),
        (PDN_OBJECT_SHELL_LOAD, Kind::ShellLoad),
        (PDN_OBJECT_INERTIA, Kind::Inertia),
        (PDN_OBJECT_PRESCRIBED, Kind::Prescribed),
    ];
    let expected = "PDN_OBJECT_NODE to PDN_OBJECT_PRESCRIBED";
    choose(&table, given, "kind", expected)
}

/// What an id names; parameters have names of their own.
fn object(model: &Model, id: i32) -> Result<(Kind, usize)> {
    let kind = Kind::of(id).filter(|kind| *kind != Kind::Parameter);
    let kind = kind.ok_or_else(|| {
        let expected = "an id of what PDN_OBJECT_NODE to PDN_OBJECT_PRESCRIBED name";
        let message = format!("id: expected {expected}, got {}", describe(id));
        Error::new(ErrorKind::Identifier, message)
    })?;
    Ok((kind, kind.index_in(model, id, "id")?))
}

/// Gives a node, joint, element, force, load or the like a label, in place of the one that it has.
///
/// Messages and reports name it after its number, as in: joint 3 "crank pin". Labels are saved and
/// copied with the model, and solutions keep those that it has when it is solved.
///
/// @param model  the model; not NULL
/// @param id  its id
/// @param label  text in UTF-8 of at most PDN_LABEL_LENGTH bytes, without quotes (") and control
///     characters, that no other object of this kind has; empty or NULL to take the label away
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID, PDN_ERR_VALUE
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_set_label(
    model: *mut pdn_model,
    id: i32,
    label: *const c_char,
) -> pdn_status {
    guard(|call| {
        let mut model = call.exclusive(model, "model")?;
        let (kind, id) = object(&model, id)?;
        let label = match label.is_null() {
            true => "",
            false => call.text(label, "label")?,
        };
        model.set_label(kind, id, label)
    })
}

/// The label of a node, joint, element, force, load or the like.
///
/// @param model  the model; not NULL
/// @param id  its id
/// @param buffer  array of length [capacity] for the label, UTF-8, always ended by NUL; may be NULL
///     if capacity is 0
/// @param capacity  size of buffer in bytes
/// @return length of the label without the NUL, as snprintf does; 0 if there is none, or if
///     the handle or id is not valid, see ::pdn_last_error
///
/// Threads: `model` is `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_label(
    model: *const pdn_model,
    id: i32,
    buffer: *mut c_char,
    capacity: usize,
) -> usize {
    guard_or(0, |call| {
        let model = call.shared(model, "model")?;
        let (kind, id) = object(&model, id)?;
        let label = model.label(kind, id).unwrap_or("");
        copy_message(label, buffer, capacity);
        Ok(label.len())
    })
}

/// The node, joint, element, force, load or the like that has a label.
///
/// @param model  the model; not NULL
/// @param kind  PDN_OBJECT_NODE to PDN_OBJECT_PRESCRIBED
/// @param label  the label; not NULL
/// @param id  its id; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_VALUE, PDN_ERR_NOT_AVAILABLE (none has this label)
///
/// Threads: `model` is `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_find_label(
    model: *const pdn_model,
    kind: i32,
    label: *const c_char,
    id: *mut i32,
) -> pdn_status {
    guard(|call| {
        let model = call.shared(model, "model")?;
        let kind = object_kind(kind)?;
        let label = call.text(label, "label")?;
        let id = call.out(id, "id")?;
        let found = model.find_label(kind, label).ok_or_else(|| {
            let message = format!("label: no {kind} has the label \"{label}\"");
            Error::new(ErrorKind::NotAvailable, message)
        })?;
        id.set(kind.id(found));
        Ok(())
    })
}
