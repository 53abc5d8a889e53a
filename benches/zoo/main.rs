//! Random machines of eleven families, solved by default options and judged (docs/robustness.md).
//!
//!     script/zoo [--seed S] [--count N] [--only FAMILY:INDEX] [--limit SECONDS]
//!                [--verbose] [--docs]

#[path = "../../tests/common/mod.rs"]
mod common;
#[path = "../../tests/models/machines/mod.rs"]
mod machines;

mod keeper;
mod table;
mod visit;

fn value<T: std::str::FromStr>(arguments: &[String], name: &str) -> Option<T> {
    let at = arguments.iter().position(|a| a == name)?;
    let text = arguments
        .get(at + 1)
        .unwrap_or_else(|| panic!("{name}: expected a value"));
    let parsed = text.parse().ok();
    Some(parsed.unwrap_or_else(|| panic!("{name}: {text} will not do")))
}

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    let seed = value(&arguments, "--seed").unwrap_or(1);
    let count = value(&arguments, "--count").unwrap_or(50);
    let limit = value(&arguments, "--limit").unwrap_or(60);
    let verbose = arguments.iter().any(|a| a == "--verbose");
    let only: Option<String> = value(&arguments, "--only");
    let Some(only) = only else {
        let records = keeper::visit_all(seed, count, limit);
        let docs = arguments.iter().any(|a| a == "--docs");
        table::write(seed, count, &records, docs);
        return;
    };
    let place = only.split_once(':').and_then(|(family, index)| {
        let family: usize = family.parse().ok()?;
        Some((family.checked_sub(1)?, index.parse().ok()?))
    });
    let (family, index) =
        place.unwrap_or_else(|| panic!("--only: expected FAMILY:INDEX, got {only}"));
    visit::visit(seed, family, index, limit, verbose);
}
