//! Ids: what C calls the things of a model. Those of one kind follow each other in the order in
//! which they were added, in a range of their own: an id where one of another kind belongs, or a
//! number that is none, is refused.

use crate::error::{Error, ErrorKind, Result};
use crate::model::Model;
pub(super) use crate::model::ObjectKind as Kind;

/// Id of the node that was added first, or of the rigid body, which is one.
///
/// Those of the others of a kind follow, in the order in which they were added: the node that
/// messages and reports call node 3 is PDN_FIRST_NODE + 3. A kind has 100 million at most.
pub const PDN_FIRST_NODE: i32 = 100000000;
/// Id of the joint that was added first.
pub const PDN_FIRST_JOINT: i32 = 200000000;
/// Id of the beam element that was added first.
pub const PDN_FIRST_BEAM_ELEMENT: i32 = 300000000;
/// Id of the shell element that was added first.
pub const PDN_FIRST_SHELL_ELEMENT: i32 = 400000000;
/// Id of the force that was added first, which is no load.
pub const PDN_FIRST_FORCE: i32 = 500000000;
/// Id of the linear relation between joint coordinates that was added first.
pub const PDN_FIRST_RELATION: i32 = 600000000;
/// Id of the parameter that was added first.
pub const PDN_FIRST_PARAMETER: i32 = 700000000;
/// Id of the load on a node, or at a point, that was added first.
pub const PDN_FIRST_LOAD: i32 = 800000000;
/// Id of the load along beam elements that was added first.
pub const PDN_FIRST_BEAM_LOAD: i32 = 900000000;
/// Id of the load on shell elements that was added first.
pub const PDN_FIRST_SHELL_LOAD: i32 = 1000000000;
/// Id of the inertia that was added first: that of a rigid body, or a mass or inertia on a node.
pub const PDN_FIRST_INERTIA: i32 = 1100000000;
/// Id of the coordinate that was prescribed first.
pub const PDN_FIRST_PRESCRIBED: i32 = 1200000000;

/// Most things of a kind.
const MOST: i32 = 100_000_000;

/// Ids of a kind.
impl Kind {
    /// The id of the first.
    fn first(self) -> i32 {
        match self {
            Kind::Node => PDN_FIRST_NODE,
            Kind::Joint => PDN_FIRST_JOINT,
            Kind::BeamElement => PDN_FIRST_BEAM_ELEMENT,
            Kind::ShellElement => PDN_FIRST_SHELL_ELEMENT,
            Kind::Force => PDN_FIRST_FORCE,
            Kind::Relation => PDN_FIRST_RELATION,
            Kind::Parameter => PDN_FIRST_PARAMETER,
            Kind::Load => PDN_FIRST_LOAD,
            Kind::BeamLoad => PDN_FIRST_BEAM_LOAD,
            Kind::ShellLoad => PDN_FIRST_SHELL_LOAD,
            Kind::Inertia => PDN_FIRST_INERTIA,
            Kind::Prescribed => PDN_FIRST_PRESCRIBED,
        }
    }

    /// The kind that has this id, in whatever model.
    pub(super) fn of(id: i32) -> Option<Kind> {
        Kind::ALL.into_iter().find(|kind| kind.read(id).is_some())
    }

    /// What messages call an id of this kind.
    fn expected(self) -> String {
        let noun = self.noun();
        let article = match noun.starts_with('i') {
            true => "an",
            false => "a",
        };
        format!("{article} {noun} id")
    }

    /// The id of the thing with this index, of which there is one.
    pub(super) fn id(self, index: usize) -> i32 {
        // No more are made than `next` allows.
        self.first() + index as i32
    }

    /// The id that the next of its kind gets in a model; `more` are to be made.
    pub(super) fn next(self, model: &Model, more: usize, name: &str) -> Result<i32> {
        let count = model.object_count(self);
        let total = count.saturating_add(more);
        if total > MOST as usize {
            let expected = format!("at most {MOST} in a model");
            return Err(Error::size(name, expected, total));
        }
        Ok(self.id(count))
    }

    /// The index of the thing with this id, in whatever model.
    pub(super) fn index(self, id: i32, name: &str) -> Result<usize> {
        self.read(id).ok_or_else(|| {
            let (first, expected) = (self.first(), self.expected());
            let got = describe(id);
            let message = format!("{name}: expected {expected} ({first} for the first), got {got}");
            Error::new(ErrorKind::Identifier, message)
        })
    }

    /// The index of the thing with this id in a model.
    pub(super) fn index_in(self, model: &Model, id: i32, name: &str) -> Result<usize> {
        self.index_below(id, model.object_count(self), name)
    }

    /// The index of the thing with this id, of `count`.
    pub(super) fn index_below(self, id: i32, count: usize, name: &str) -> Result<usize> {
        self.index_or("", id, count, name)
    }

    /// The same, where something else would do, that a message names before.
    pub(super) fn index_or(self, other: &str, id: i32, count: usize, name: &str) -> Result<usize> {
        self.read(id).filter(|&index| index < count).ok_or_else(|| {
            let limit = match count {
                0 => "though there is none yet".to_owned(),
                n => format!("from {} to {}", self.id(0), self.id(n - 1)),
            };
            let (expected, got) = (self.expected(), describe(id));
            let message = format!("{name}: expected {other}{expected} {limit}, got {got}");
            Error::new(ErrorKind::Identifier, message)
        })
    }

    fn read(self, id: i32) -> Option<usize> {
        let index = id.checked_sub(self.first())?;
        (0..MOST).contains(&index).then_some(index as usize)
    }
}

/// An id, and what it would name.
pub(super) fn describe(id: i32) -> String {
    let named = Kind::ALL.into_iter().find_map(|kind| {
        let index = kind.read(id)?;
        Some(format!("{id}, which is the id of {kind} {index}"))
    });
    named.unwrap_or_else(|| id.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ids_of_kinds_are_apart() {
        for kind in Kind::ALL {
            let (first, last) = (kind.id(0), kind.id(MOST as usize - 1));
            for other in Kind::ALL {
                for (id, index) in [(first, 0), (last, MOST as usize - 1)] {
                    let expected = (other == kind).then_some(index);
                    assert_eq!(other.index(id, "id").ok(), expected);
                }
            }
        }
        for none in [i32::MIN, -1, 0, 99_999_999, 1_300_000_000, i32::MAX] {
            assert!(Kind::ALL.iter().all(|kind| kind.read(none).is_none()));
        }
    }

    #[test]
    fn messages_name_what_came() {
        let message = |kind: Kind, id| kind.index_below(id, 3, "it").unwrap_err().to_string();
        let expected = "it: expected a node id from 100000000 to 100000002, got ";
        let got = format!("{expected}200000001, which is the id of joint 1");
        assert_eq!(message(Kind::Node, 200_000_001), got);
        assert_eq!(message(Kind::Node, 3), format!("{expected}3"));
        let expected = "it: expected an inertia id from 1100000000 to 1100000002, got ";
        let got = format!("{expected}900000002, which is the id of beam load 2");
        assert_eq!(message(Kind::Inertia, 900_000_002), got);
    }

    #[test]
    fn no_more_are_made_than_ids_can_name() {
        let model = Model::new();
        let most = MOST as usize;
        assert_eq!(
            Kind::Prescribed.next(&model, most, "it").unwrap(),
            PDN_FIRST_PRESCRIBED
        );
        assert!(Kind::Prescribed.next(&model, most + 1, "it").is_err());
    }
}
