//! Cross-sections along a whole beam, at stations.

use super::SectionInput;
use super::validation::require_ascending;
use crate::elements::{Section, SectionLine};
use crate::error::{Error, Result, require_finite};
use std::f64::consts::PI;

/// The cross-section at one place of a beam.
#[derive(Debug, Clone, Copy)]
pub struct SectionStation {
    /// Place along the beam, from 0 at the start to 1 at the end.
    pub fraction: f64,
    /// The section, in its own axes.
    pub section: SectionInput,
    /// Angle by which its axes 2 and 3 are turned about axis 1 from those of the reference line.
    pub twist: f64,
}

impl SectionStation {
    /// The stations of a beam that is the same all along.
    pub fn uniform(section: &SectionInput) -> [SectionStation; 1] {
        [SectionStation {
            fraction: 0.0,
            section: *section,
            twist: 0.0,
        }]
    }
}

/// Cross-sections along a whole beam, checked: sections and twists are linear between stations.
pub(super) struct Stations(Vec<(f64, Section, f64)>);

impl Stations {
    pub fn new(stations: &[SectionStation]) -> Result<Self> {
        if stations.len() > 1 {
            let fractions: Vec<f64> = stations.iter().map(|station| station.fraction).collect();
            require_ascending("fractions", &fractions, true)?;
        }
        let mut checked: Vec<(f64, Section, f64)> = Vec::with_capacity(stations.len());
        for (i, station) in stations.iter().enumerate() {
            let fraction = station.fraction;
            let name = format!("fractions[{i}]");
            require_finite(&name, &[fraction])?;
            let twist = within_a_turn(station.twist, stations[0].twist, i)?;
            let section = match station.section.validated() {
                Err(error) if stations.len() > 1 => {
                    return Err(error.within(format!("station {i}")));
                }
                checked => checked?,
            };
            if let Some((before, _, twist_before)) = checked.last() {
                if fraction == *before && (fraction == 0.0 || fraction == 1.0) {
                    let got = format!("{fraction} twice");
                    return Err(Error::value(&name, "jumps inside the beam only", got));
                }
                if fraction == *before && twist != *twist_before {
                    let there = stations[i - 1].twist;
                    let expected = format!("{there} as on the other side of the jump");
                    let got = station.twist;
                    return Err(Error::value(&format!("twists[{i}]"), expected, got));
                }
                let jumps = checked.iter().filter(|s| s.0 == fraction).count();
                if jumps > 1 {
                    let got = format!("{fraction} three times");
                    return Err(Error::value(&name, "at most two stations at a place", got));
                }
            }
            checked.push((fraction, section, twist));
        }
        if checked.is_empty() {
            return Err(Error::size("stations", "at least one", 0));
        }
        Ok(Stations(checked))
    }

    /// Section at `fraction` by the stations `i` and `i + 1`.
    fn between(&self, i: usize, fraction: f64) -> (Section, f64) {
        let (start, first, twist) = self.0[i];
        match self.0.get(i + 1) {
            Some((end, second, end_twist)) if *end > start => {
                let t = (fraction - start) / (end - start);
                let section = first.towards(second, t);
                (section, twist + (end_twist - twist) * t)
            }
            _ => (first, twist),
        }
    }

    /// The last station at or before `fraction`.
    fn before(&self, fraction: f64) -> usize {
        let next = self.0.partition_point(|s| s.0 <= fraction);
        next.saturating_sub(1)
    }

    pub fn twist(&self, fraction: f64) -> f64 {
        self.between(self.before(fraction), fraction).1
    }

    /// Checks that sections turn by less than half a turn from one node to the next, at these
    /// fractions: the motions of nodes do not tell by how many turns they do.
    pub fn require_slow_twist(&self, start: f64, end: f64) -> Result<()> {
        let first = self.0.partition_point(|s| s.0 <= start);
        let last = self.0.partition_point(|s| s.0 < end).max(first);
        let inside = self.0[first..last].iter().map(|station| station.2);
        let ends = [self.twist(start), self.twist(end)];
        let (low, high) = inside.fold(
            (ends[0].min(ends[1]), ends[0].max(ends[1])),
            |(low, high), twist| (low.min(twist), high.max(twist)),
        );
        if high - low < PI {
            return Ok(());
        }
        Err(Error::value(
            "twists",
            "less than half a turn (3.1416) from each node to the next",
            format!(
                "{:.4} from fraction {start:.6} to {end:.6}: use more elements or a higher degree",
                high - low
            ),
        ))
    }

    /// The sections of an element from `start` to `end`, between which there is no jump.
    pub fn over(&self, start: f64, end: f64) -> SectionLine {
        let first = self.before(start);
        if let [(_, section, twist)] = &self.0[..] {
            return SectionLine::from(*section).twisted(vec![*twist]);
        }
        // The last station before the end is on its near side, if there is a jump.
        let last = self.0.partition_point(|s| s.0 < end).saturating_sub(1);
        let between = &self.0[first + 1..last.max(first) + 1];
        let inside: Vec<(f64, Section)> = between
            .iter()
            .map(|(fraction, section, _)| {
                let xi = 2.0 * (fraction - start) / (end - start) - 1.0;
                (xi, *section)
            })
            .collect();
        let ends = (self.between(first, start), self.between(last, end));
        let mut twists = vec![ends.0.1];
        twists.extend(between.iter().map(|station| station.2));
        twists.push(ends.1.1);
        SectionLine::new(ends.0.0, &inside, ends.1.0).twisted(twists)
    }

    /// Fractions of the element boundaries: some where the section jumps, and the others so that
    /// the elements between jumps are equally long, and all about so.
    pub fn boundaries(&self, elements: usize) -> Result<Vec<f64>> {
        let jumps = self.0.windows(2).filter(|pair| pair[0].0 == pair[1].0);
        let mut ends: Vec<f64> = vec![0.0];
        ends.extend(jumps.map(|pair| pair[0].0));
        ends.push(1.0);
        let parts: Vec<(f64, f64)> = ends.windows(2).map(|e| (e[0], e[1])).collect();
        if elements < parts.len() {
            let expected = format!(
                "at least {}, as the section jumps inside the beam",
                parts.len()
            );
            return Err(Error::size("elements", expected, elements));
        }
        let mut counts = vec![1usize; parts.len()];
        for _ in parts.len()..elements {
            let length = |i: usize| (parts[i].1 - parts[i].0) / counts[i] as f64;
            let longest =
                (0..parts.len()).fold(0, |a, b| if length(b) > length(a) { b } else { a });
            counts[longest] += 1;
        }
        let mut boundaries = vec![0.0];
        for ((start, end), &count) in parts.iter().zip(&counts) {
            for k in 1..count {
                boundaries.push(start + (end - start) * k as f64 / count as f64);
            }
            boundaries.push(*end);
        }
        Ok(boundaries)
    }

    /// Checks the fractions of element boundaries that a user gives.
    pub fn check_boundaries(&self, boundaries: &[f64]) -> Result<()> {
        let count = boundaries.len();
        if count < 2 {
            return Err(Error::size("boundaries", "at least two", count));
        }
        require_ascending("boundaries", boundaries, false)?;
        let jumps = self.0.windows(2).filter(|pair| pair[0].0 == pair[1].0);
        for (fraction, ..) in jumps.map(|pair| pair[0]) {
            if !boundaries.contains(&fraction) {
                let expected = format!("one at {fraction}, where the section jumps");
                return Err(Error::value("boundaries", expected, "none"));
            }
        }
        Ok(())
    }
}

/// The twist of station `i` less whole turns of that of the first station: what is left of large
/// angles, which is all that matters, is not rounded again.
fn within_a_turn(twist: f64, first: f64, i: usize) -> Result<f64> {
    let name = format!("twists[{i}]");
    require_finite(&name, &[twist])?;
    if first.abs() <= PI {
        return Ok(twist);
    }
    let (sine, cosine) = first.sin_cos();
    let twist = sine.atan2(cosine) + (twist - first);
    if !twist.is_finite() {
        return Err(Error::value(
            &name,
            format!("a number nearer to {first}"),
            twist,
        ));
    }
    Ok(twist)
}
