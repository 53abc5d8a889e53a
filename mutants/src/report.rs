//! What came out.

use crate::binaries::Test;
use crate::find::Mutant;
use crate::trial::Results;
use std::collections::BTreeMap;

/// The interval of Wilson's score for a share, at 95 in a hundred.
fn wilson(part: usize, all: usize) -> (f64, f64) {
    let (n, z) = (all.max(1) as f64, 1.96);
    let p = part as f64 / n;
    let middle = p + z * z / (2.0 * n);
    let half = z * (p * (1.0 - p) / n + z * z / (4.0 * n * n)).sqrt();
    let whole = 1.0 + z * z / n;
    ((middle - half) / whole, (middle + half) / whole)
}

/// The text of a report on these numbers.
pub fn text(mutants: &[Mutant], numbers: &[usize], tests: &[Test], results: &Results) -> String {
    let (mut caught, mut missed, mut open) = (0, Vec::new(), Vec::new());
    let mut parts: BTreeMap<&str, [usize; 2]> = BTreeMap::new();
    for &number in numbers {
        let mutant = &mutants[number];
        let part = mutant.file.split('/').nth(1).unwrap_or_default();
        let of_part = parts.entry(part).or_default();
        of_part[1] += 1;
        if results.caught.contains_key(&mutant.name) {
            caught += 1;
            of_part[0] += 1;
            continue;
        }
        let reaching = tests.iter().filter(|test| test.reached.contains(&number));
        let (name, line) = (&mutant.name, mutant.line);
        let left = results.left(name, number, tests).len();
        let line = format!("  line {line}, {name} ({} tests reach it", reaching.count());
        match left {
            0 => missed.push(format!("{line})")),
            _ => open.push(format!("{line}, {left} of them not run yet)")),
        }
    }
    let tried = caught + missed.len();
    let (low, high) = wilson(caught, tried);
    let mut text = format!(
        "{caught} of {tried} caught: {:.1} % (95 %: {:.1} to {:.1} %), {} not finished\n",
        100.0 * caught as f64 / tried.max(1) as f64,
        100.0 * low,
        100.0 * high,
        open.len()
    );
    for (part, [caught, all]) in parts {
        text += &format!("  {part}: {caught} of {all}\n");
    }
    for (what, lines) in [("Missed", missed), ("Not finished", open)] {
        if !lines.is_empty() {
            text += &format!("{what}:\n{}\n", lines.join("\n"));
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_interval_is_wilsons() {
        // Newcombe, Statistics in Medicine 17 (1998), table I: 81 of 263, 15 of 148.
        for (part, all, low, high) in [(81, 263, 0.2553, 0.3662), (15, 148, 0.0624, 0.1605)] {
            let found = wilson(part, all);
            assert!(
                (found.0 - low).abs() < 1e-4 && (found.1 - high).abs() < 1e-4,
                "{found:?}"
            );
        }
    }
}
