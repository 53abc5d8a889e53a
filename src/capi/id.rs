//! Ids: what C calls the things of a model. Those of one kind follow each other in the order in
//! which they were added, in a range of their own: an id where one of another kind belongs, or a
//! number that is none, is refused.

use crate::error::{Error, ErrorKind, Result};

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

/// Most things of a kind.
const MOST: i32 = 100_000_000;

/// What has ids.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Node,
    Joint,
    BeamElement,
    ShellElement,
    Force,
    Relation,
    Parameter,
}

/// All kinds, the first id of each, and what it is called.
const KINDS: [(Kind, i32, &str); 7] = [
    (Kind::Node, PDN_FIRST_NODE, "node"),
    (Kind::Joint, PDN_FIRST_JOINT, "joint"),
    (Kind::BeamElement, PDN_FIRST_BEAM_ELEMENT, "beam element"),
    (Kind::ShellElement, PDN_FIRST_SHELL_ELEMENT, "shell element"),
    (Kind::Force, PDN_FIRST_FORCE, "force"),
    (Kind::Relation, PDN_FIRST_RELATION, "relation"),
    (Kind::Parameter, PDN_FIRST_PARAMETER, "parameter"),
];

impl Kind {
    fn row(self) -> &'static (Kind, i32, &'static str) {
        &KINDS[self as usize]
    }

    /// What messages call an id of this kind.
    pub fn expected(self) -> String {
        format!("a {} id", self.row().2)
    }

    /// The id of the thing with this index, of which there is one.
    pub fn id(self, index: usize) -> i32 {
        // No more are made than `next` allows.
        self.row().1 + index as i32
    }

    /// The id that the next of `count` things gets; `more` of them are to be made.
    pub fn next(self, count: usize, more: usize, name: &str) -> Result<i32> {
        let total = count.saturating_add(more);
        if total > MOST as usize {
            let expected = format!("at most {MOST} in a model");
            return Err(Error::size(name, expected, total));
        }
        Ok(self.id(count))
    }

    /// The index of the thing with this id, in whatever model.
    pub fn index(self, id: i32, name: &str) -> Result<usize> {
        self.read(id).ok_or_else(|| {
            let got = describe(id);
            let first = self.row().1;
            let message = format!(
                "{name}: expected {} ({first} for the first), got {got}",
                self.expected()
            );
            Error::new(ErrorKind::Identifier, message)
        })
    }

    /// The index of the thing with this id, of `count`; `expected` tells what it may be.
    pub fn index_below(self, id: i32, count: usize, name: &str, expected: &str) -> Result<usize> {
        self.read(id).filter(|&index| index < count).ok_or_else(|| {
            let limit = match count {
                0 => "though there is none yet".to_owned(),
                n => format!("from {} to {}", self.id(0), self.id(n - 1)),
            };
            let message = format!("{name}: expected {expected} {limit}, got {}", describe(id));
            Error::new(ErrorKind::Identifier, message)
        })
    }

    fn read(self, id: i32) -> Option<usize> {
        let index = id.checked_sub(self.row().1)?;
        (0..MOST).contains(&index).then_some(index as usize)
    }
}

/// An id, and what it would name.
fn describe(id: i32) -> String {
    let named = KINDS.iter().find_map(|(kind, _, what)| {
        let index = kind.read(id)?;
        Some(format!("{id}, which is the id of {what} {index}"))
    });
    named.unwrap_or_else(|| id.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kinds_are_in_order_and_their_ids_are_apart() {
        for (number, (kind, first, _)) in KINDS.iter().enumerate() {
            assert_eq!((*kind as usize, kind.id(0)), (number, *first));
            let last = kind.id(MOST as usize - 1);
            for (other, ..) in KINDS {
                for (id, index) in [(*first, 0), (last, MOST as usize - 1)] {
                    let expected = (other == *kind).then_some(index);
                    assert_eq!(other.index(id, "id").ok(), expected);
                }
            }
        }
        for none in [i32::MIN, -1, 0, 99_999_999, 800_000_000, i32::MAX] {
            assert!(KINDS.iter().all(|(kind, ..)| kind.read(none).is_none()));
        }
    }

    #[test]
    fn messages_name_what_came() {
        let message = |id| {
            Kind::Node
                .index_below(id, 3, "node", "a node id")
                .unwrap_err()
        };
        let expected = "node: expected a node id from 100000000 to 100000002, got ";
        let got = format!("{expected}200000001, which is the id of joint 1");
        assert_eq!(message(200_000_001).to_string(), got);
        assert_eq!(message(3).to_string(), format!("{expected}3"));
        assert!(Kind::Node.next(0, MOST as usize, "node").is_ok());
        assert!(Kind::Node.next(1, MOST as usize, "node").is_err());
    }
}
