//! Source text in which each change waits for its switch.

use crate::find::{Edit, Mutant};
use std::cmp::Reverse;
use std::ops::Range;

/// A mutant and the number of its switch.
pub type Numbered<'a> = (usize, &'a Mutant);

/// Where a mutant is in the text that was written.
#[derive(Debug, Clone)]
pub struct Place {
    pub number: usize,
    /// What is only there because of it.
    pub own: Range<usize>,
    /// With what it takes the place of.
    pub whole: Range<usize>,
}

/// Changes of one place.
struct Site<'a> {
    range: Range<usize>,
    mutants: Vec<Numbered<'a>>,
}

struct Writer<'a> {
    source: &'a str,
    text: String,
    places: Vec<Place>,
}

/// The text of a file with the switches of these mutants, all of this file.
pub fn write(source: &str, mutants: &[Numbered]) -> (String, Vec<Place>) {
    let mut sites: Vec<Site> = Vec::new();
    for &(number, mutant) in mutants {
        let range = match &mutant.edit {
            Edit::Expression(range, _) => range.clone(),
            Edit::Body(at, _) | Edit::Arm(at) => *at..*at,
        };
        match sites.iter_mut().find(|site| site.range == range) {
            Some(site) => site.mutants.push((number, mutant)),
            None => sites.push(Site {
                range,
                mutants: vec![(number, mutant)],
            }),
        }
    }
    // What contains others comes before them.
    sites.sort_by_key(|site| {
        let Range { start, end } = site.range;
        (start, start != end, Reverse(end))
    });
    let mut writer = Writer {
        source,
        text: String::new(),
        places: Vec::new(),
    };
    writer.copy(0..source.len(), &sites);
    (writer.text, writer.places)
}

impl Writer<'_> {
    /// Copies a range, with the sites in it.
    fn copy(&mut self, range: Range<usize>, sites: &[Site]) {
        let mut at = range.start;
        let mut next = 0;
        while next < sites.len() {
            let site = &sites[next];
            let inner = sites[next + 1..].iter();
            let inside = inner
                .take_while(|other| other.range.start < site.range.end)
                .count();
            self.text.push_str(&self.source[at..site.range.start]);
            self.site(site, &sites[next + 1..next + 1 + inside]);
            at = site.range.end;
            next += 1 + inside;
        }
        self.text.push_str(&self.source[at..range.end]);
    }

    fn site(&mut self, site: &Site, inside: &[Site]) {
        let first_place = self.places.len();
        let start = self.text.len();
        let mut is_expression = false;
        for &(number, mutant) in &site.mutants {
            let before = self.text.len();
            match &mutant.edit {
                Edit::Body(_, value) => self.text.push_str(&format!(
                    " if crate::mutant::is({number}) {{ return {value}; }}"
                )),
                Edit::Arm(_) => {
                    self.text
                        .push_str(&format!(" if !crate::mutant::is({number})"));
                }
                Edit::Expression(_, text) => {
                    let word = if is_expression { " else" } else { "(" };
                    is_expression = true;
                    self.text.push_str(&format!(
                        "{word} if crate::mutant::is({number}) {{ {text} }}"
                    ));
                }
            }
            let end = self.text.len();
            self.places.push(Place {
                number,
                own: before..end,
                whole: start..end,
            });
        }
        let last_place = self.places.len();
        if is_expression {
            self.text.push_str(" else { ");
            self.copy(site.range.clone(), inside);
            self.text.push_str(" })");
        }
        let end = self.text.len();
        for place in &mut self.places[first_place..last_place] {
            place.whole.end = end;
        }
    }
}

/// The module that the switches are in.
pub const MODULE: &str = r#"//! Switches of changes made on purpose: which one is on is told by the environment.

use std::io::Write;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering::Relaxed};

const UNKNOWN: usize = usize::MAX;
const REACHED: usize = usize::MAX - 1;
static ON: AtomicUsize = AtomicUsize::new(UNKNOWN);
static SEEN: [AtomicBool; COUNT] = [const { AtomicBool::new(false) }; COUNT];

#[inline]
pub(crate) fn is(number: usize) -> bool {
    let on = ON.load(Relaxed);
    on == number || (on >= REACHED && asked(number))
}

#[cold]
fn asked(number: usize) -> bool {
    if ON.load(Relaxed) == UNKNOWN {
        let text = std::env::var("PDN_MUTANT").unwrap_or_default();
        let on = match text.as_str() {
            "reached" => REACHED,
            // None has this number.
            number => number.parse().unwrap_or(REACHED - 1),
        };
        ON.store(on, Relaxed);
    }
    if ON.load(Relaxed) == REACHED && !SEEN[number].swap(true, Relaxed) {
        let path = std::env::var("PDN_MUTANT_REACHED").expect("PDN_MUTANT_REACHED");
        let file = std::fs::File::options().append(true).create(true).open(path);
        writeln!(file.expect("a file"), "{number}").expect("to be written");
    }
    ON.load(Relaxed) == number
}
"#;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::find;

    #[test]
    fn places_within_places_keep_their_switches() {
        let source = "fn f(a: f64, b: f64) -> f64 { -(a + b) * 2.0 }\n";
        let found = find::mutants("f.rs", source).unwrap();
        let names: Vec<&str> = found.iter().map(|m| m.name.as_str()).collect();
        assert_eq!(names[0], "f.rs: f: return 0.0 #1");
        assert_eq!(found.len(), 3 + 2 + 1 + 2);
        let numbered: Vec<Numbered> = found.iter().enumerate().collect();
        let (text, places) = write(source, &numbered);
        syn::parse_file(&text).unwrap();
        assert_eq!(places.len(), found.len());
        assert_eq!(text.matches("crate::mutant::is").count(), found.len());
        let (same, _) = write(source, &[]);
        assert_eq!(same, source);
        for place in &places {
            let own = &text[place.own.clone()];
            assert!(own.contains(&format!("is({})", place.number)), "{own}");
        }
        assert!(
            text.contains("{ (a + b) * 2.0 }") || text.contains("{ (a + b) }"),
            "{text}"
        );
    }

    #[test]
    fn arms_and_guards() {
        let source = "fn f(a: u8) { match a { 0 => g(), 1 if a > b => h(), _ => {} } }\n";
        let found = find::mutants("f.rs", source).unwrap();
        let numbered: Vec<Numbered> = found.iter().enumerate().collect();
        let (text, _) = write(source, &numbered);
        syn::parse_file(&text).unwrap();
        assert!(text.contains("0 if !crate::mutant::is("), "{text}");
    }
}
