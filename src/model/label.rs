//! Labels: what the user calls the things of a model.

use super::{Model, ObjectKind};
use crate::error::{Error, Result};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::sync::Arc;

/// Bytes of a label, at most.
pub const LONGEST_LABEL: usize = 200;

/// Labels of a model, both ways.
#[derive(Debug, Clone, Default)]
struct Both {
    of: BTreeMap<(ObjectKind, usize), String>,
    named: BTreeMap<(ObjectKind, String), usize>,
}

/// The labels of a model, which solutions share with it.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
#[serde(from = "Vec<Saved>", into = "Vec<Saved>")]
pub struct Labels(Arc<Both>);

/// A label in a file.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Saved {
    kind: ObjectKind,
    id: usize,
    label: String,
}

impl From<Labels> for Vec<Saved> {
    fn from(labels: Labels) -> Self {
        let all = labels.0.of.iter();
        let saved = |(&(kind, id), label): (&(ObjectKind, usize), &String)| Saved {
            kind,
            id,
            label: label.clone(),
        };
        all.map(saved).collect()
    }
}

impl From<Vec<Saved>> for Labels {
    fn from(all: Vec<Saved>) -> Self {
        let mut labels = Labels::default();
        for Saved { kind, id, label } in all {
            labels.set(kind, id, &label);
        }
        labels
    }
}

impl Labels {
    fn set(&mut self, kind: ObjectKind, id: usize, label: &str) {
        let both = Arc::make_mut(&mut self.0);
        if let Some(before) = both.of.remove(&(kind, id)) {
            both.named.remove(&(kind, before));
        }
        if !label.is_empty() {
            both.of.insert((kind, id), label.to_string());
            both.named.insert((kind, label.to_string()), id);
        }
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.0.of.is_empty()
    }

    /// A label.
    pub fn get(&self, kind: ObjectKind, id: usize) -> Option<&str> {
        self.0.of.get(&(kind, id)).map(String::as_str)
    }

    /// The same text with labels after the ids that it names: `joint 3 "crank pin"`. What is in
    /// quotes stays as it is, and so does what has its label already.
    pub fn annotate(&self, text: &str) -> String {
        if self.is_empty() {
            return text.to_string();
        }
        let mut out = String::with_capacity(text.len());
        let mut rest = text;
        while let Some(first) = rest.chars().next() {
            if let Some(quoted) = quoted(rest) {
                out.push_str(quoted);
                rest = &rest[quoted.len()..];
                continue;
            }
            let starts_word = !out.ends_with(|c: char| c.is_alphanumeric() || c == '_');
            let noun = starts_word.then(|| noun_with_ids(rest)).flatten();
            if let Some((kind, length)) = noun {
                out.push_str(&rest[..length]);
                rest = self.annotate_ids(kind, &rest[length..], &mut out);
            } else {
                out.push(first);
                rest = &rest[first.len_utf8()..];
            }
        }
        out
    }

    /// Copies ids that are separated by commas, with their labels; gives what comes after them.
    fn annotate_ids<'t>(&self, kind: ObjectKind, text: &'t str, out: &mut String) -> &'t str {
        let mut rest = text;
        loop {
            let digits = leading_digits(rest);
            out.push_str(&rest[..digits]);
            let label = rest[..digits]
                .parse()
                .ok()
                .and_then(|id| self.get(kind, id));
            rest = &rest[digits..];
            if let Some(label) = label {
                let named = format!(" \"{label}\"");
                out.push_str(&named);
                rest = rest.strip_prefix(&named).unwrap_or(rest);
            }
            match rest.strip_prefix(", ") {
                Some(next) if leading_digits(next) > 0 => {
                    out.push_str(", ");
                    rest = next;
                }
                _ => return rest,
            }
        }
    }
}

/// Text in quotes that another one begins with.
fn quoted(text: &str) -> Option<&str> {
    let inside = text.strip_prefix('"')?;
    let end = inside.find('"')?;
    Some(&text[..end + 2])
}

/// The noun that a text begins with, if ids follow it, and the length up to these.
fn noun_with_ids(text: &str) -> Option<(ObjectKind, usize)> {
    ObjectKind::ALL.into_iter().find_map(|kind| {
        let after = text.strip_prefix(kind.noun())?;
        let after = after.strip_prefix('s').unwrap_or(after).strip_prefix(' ')?;
        (leading_digits(after) > 0).then_some((kind, text.len() - after.len()))
    })
}

/// Digits that a text begins with, if they are a whole number.
fn leading_digits(text: &str) -> usize {
    let end = text
        .find(|c: char| !c.is_ascii_digit())
        .unwrap_or(text.len());
    let mut after = text[end..].chars();
    let goes_on = match after.next() {
        Some('.') => after.next().is_some_and(|c| c.is_ascii_digit()),
        Some(c) => c.is_alphanumeric() || c == '_',
        None => false,
    };
    if goes_on { 0 } else { end }
}

impl Model {
    /// Gives something a label, which messages, reports and files tell, in place of the one that it
    /// has; none if it is empty.
    ///
    /// # Errors
    /// If there is no such thing; if the label is longer than [`LONGEST_LABEL`] bytes, has control
    /// characters or quotes `"`, or is that of another thing of this kind.
    pub fn set_label(&mut self, kind: ObjectKind, id: usize, label: &str) -> Result<()> {
        self.require_object(kind, id)?;
        let length = label.len();
        if length > LONGEST_LABEL {
            let expected = format!("at most {LONGEST_LABEL} bytes");
            return Err(Error::value("label", expected, length));
        }
        let is_odd = |c: &char| c.is_control() || *c == '"';
        if let Some(odd) = label.chars().find(is_odd) {
            let expected = "text without quotes and control characters";
            return Err(Error::value("label", expected, format!("{odd:?}")));
        }
        match self.find_label(kind, label) {
            Some(other) if other != id => Err(Error::value(
                "label",
                format!("one that no other {kind} has"),
                format!("that of {kind} {other}"),
            )),
            _ => {
                self.labels.set(kind, id, label);
                Ok(())
            }
        }
    }

    /// The label of something, if it has one.
    pub fn label(&self, kind: ObjectKind, id: usize) -> Option<&str> {
        self.labels.get(kind, id)
    }

    /// What has a label.
    pub fn find_label(&self, kind: ObjectKind, label: &str) -> Option<usize> {
        let key = (kind, label.to_string());
        self.labels.0.named.get(&key).copied()
    }

    /// All labels.
    pub fn labels(&self) -> &Labels {
        &self.labels
    }

    /// Takes the labels of a file, with all checks.
    pub(super) fn take_labels(&mut self, labels: Labels) -> Result<()> {
        let all: Vec<Saved> = labels.into();
        let mut all = all.into_iter();
        all.try_for_each(|Saved { kind, id, label }| self.set_label(kind, id, &label))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels() -> Labels {
        let mut labels = Labels::default();
        for (kind, id, label) in [
            (ObjectKind::Joint, 3, "crank pin"),
            (ObjectKind::Joint, 13, "knee"),
            (ObjectKind::Node, 3, "Kolben ø 80, node 3"),
            (ObjectKind::BeamElement, 0, "blade"),
        ] {
            labels.set(kind, id, label);
        }
        labels
    }

    #[test]
    fn texts_name_what_has_a_label() {
        let labels = labels();
        for (text, named) in [
            ("joint 3 is open", "joint 3 \"crank pin\" is open"),
            (
                "joints 0, 3, 13 and prescribed coordinate 3",
                "joints 0, 3 \"crank pin\", 13 \"knee\" and prescribed coordinate 3",
            ),
            ("(joint 13)", "(joint 13 \"knee\")"),
            ("node 3: no", "node 3 \"Kolben ø 80, node 3\": no"),
            ("beam element 0.", "beam element 0 \"blade\"."),
            // Numbers of something else, and names that only end so.
            ("joint id below 3, got 3", "joint id below 3, got 3"),
            ("shell element 0, element 0", "shell element 0, element 0"),
            (
                "midnode 3, node3.position, node_3, node 3.5",
                "midnode 3, node3.position, node_3, node 3.5",
            ),
            ("3 joints, 13 nodes", "3 joints, 13 nodes"),
            ("\"joint 3\" is no joint", "\"joint 3\" is no joint"),
            ("", ""),
        ] {
            assert_eq!(labels.annotate(text), named);
            // Once is enough.
            assert_eq!(labels.annotate(named), named);
            assert_eq!(Labels::default().annotate(text), text);
        }
    }
}
