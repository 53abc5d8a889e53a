//! When a motion is sharp, and the map of time under which its harmonics end early.
//! See docs/theory.md, section 10.7.

use crate::collocation::GridState;
use crate::fourier::{Analysis, Resampling, SharpEvent, TimeGrid, TimeMap};
use crate::system::System;

/// Maps of time that are tried in an adaptive solve, one after the other.
pub(super) const MOST_MAPS: usize = 5;
/// Curves of the motion that are looked at: those with most in their highest harmonics.
const CURVES: usize = 8;
/// Points of their tables for each of the grid: thirty for the shortest wave, which leave a
/// millionth of it.
const TABLE: usize = 16;
/// Points of a grid that is tried for each of the present one.
const TRIED: usize = 2;
/// Harmonics are to end where those of the present grid have come down to what is above this part
/// of them: what is above all of them is well below that, the more so where the motion is right at
/// the points, or nearly so.
const SEEN: f64 = 0.25;
const SEEN_WHERE_NEAR: f64 = 0.5;
/// A map is worth a change of grid that lets harmonics end this much earlier: linear equations are
/// harder to precondition there.
const GAIN: f64 = 2.0;
/// The same where the motion may be quite another.
const GAIN_BLINDLY: f64 = 3.0;
/// The same of another map than the present one.
const GAIN_MORE: f64 = 1.25;
/// A map is to let harmonics that it was not chosen for end this much later at most.
pub(super) const HARM: f64 = 1.3;
/// An event is worth its points that lets them end this much earlier.
const WORTH: f64 = 1.1;
/// Most events that are looked for.
const EVENTS: usize = 4;
/// Widths, in periods, and shares that are tried first.
const WIDTHS: [f64; 6] = [0.1, 0.04, 0.016, 0.006, 0.0025, 0.001];
const SHARES: [f64; 3] = [0.5, 1.5, 4.0];
/// Factor of a width or a share, or part of a width that a time is moved by, from one trial to the
/// next, at first and at last.
const STEPS: [f64; 2] = [1.6, 1.15];
/// Times serve alike that let harmonics end this much later at most; they are looked for in moves
/// of this part of a width, so many each way.
const ALIKE: f64 = 1.04;
const MOVE: f64 = 0.125;
const MOST_MOVES: u32 = 8;
/// Bounds of widths, in periods, and of shares.
const NARROWEST: f64 = 3e-4;
const WIDEST: f64 = 0.3;
const LARGEST_SHARE: f64 = 12.0;
const LEAST_SHARE: f64 = 0.05;

/// A map, and how many times earlier harmonics end.
#[derive(Clone)]
pub(super) struct Sharper {
    pub map: TimeMap,
    pub gain: f64,
    /// Points that hold the harmonics up to there, if the motion was right.
    pub holding: Option<usize>,
}

/// A map under which the harmonics of the quasi-static motion in `state` end much earlier than on
/// its grid; none if that gains little.
pub(super) fn of_rest(system: &System, grid: TimeGrid, state: &GridState) -> Option<Sharper> {
    let mut search = Search::new(system, grid, state, (SEEN_WHERE_NEAR, 1));
    let (found, ends) = search.from(Vec::new(), GAIN)?;
    let holding = Some((2.0 * ends).ceil() as usize);
    let mut events = found.map.events(1.0);
    search.centre(&mut events, ends);
    let map = TimeMap::new(&events, 1.0).ok()?;
    Some(Sharper {
        map,
        holding,
        ..found
    })
}

/// The same of a solution, which may resolve little.
pub(super) fn of_solution(system: &System, grid: TimeGrid, state: &GridState) -> Option<Sharper> {
    let mut search = Search::new(system, grid, state, (SEEN, TRIED));
    Some(search.from(Vec::new(), GAIN_BLINDLY)?.0)
}

/// The map of a grid changed for the motion in `state`, without harm to the motion that is right at
/// the points of its own grid; none if that gains little.
pub(super) fn sharper_still(
    system: &System,
    (grid, state): (TimeGrid, &GridState),
    (fine, exact): (TimeGrid, &GridState),
) -> Option<Sharper> {
    let mut search = Search::new(system, grid, state, (SEEN_WHERE_NEAR, TRIED));
    let mut other = Search::new(system, fine, exact, (SEEN_WHERE_NEAR, 1));
    let events = grid.map().events(1.0);
    let most = other.ends_with(&events) * HARM;
    search.spared = Some((Box::new(other), most));
    Some(search.from(events, GAIN_MORE)?.0)
}

/// How many times earlier the harmonics of the motion in `state` end under a map.
pub(super) fn gain(system: &System, grid: TimeGrid, state: &GridState, map: &TimeMap) -> f64 {
    let mut search = Search::new(system, grid, state, (SEEN, TRIED));
    search.present / search.ends_with(&map.events(1.0))
}

/// One of the curves over the period of the present grid, in its pseudo-time.
struct Curve {
    values: Vec<f64>,
    /// Slopes by steps of the table.
    slopes: Vec<f64>,
}

impl Curve {
    /// At a pseudo-time in periods, by Hermite's cubics.
    fn at(&self, pseudo: f64) -> f64 {
        let count = self.values.len();
        let place = (pseudo - pseudo.floor()) * count as f64;
        let before = (place as usize).min(count - 1);
        let after = (before + 1) % count;
        let x = place - before as f64;
        let rest = 1.0 - x;
        let values = [self.values[before], self.values[after]];
        let slopes = [self.slopes[before], self.slopes[after]];
        values[0] * rest * rest * (1.0 + 2.0 * x)
            + slopes[0] * x * rest * rest
            + values[1] * x * x * (3.0 - 2.0 * x)
            - slopes[1] * x * x * rest
    }
}

struct Search {
    grid: TimeGrid,
    /// Points of a grid that is tried, an odd number.
    tried: usize,
    curves: Vec<Curve>,
    /// Other curves, and where their harmonics are to end at most.
    spared: Option<(Box<Search>, f64)>,
    analysis: Analysis,
    /// Sum of squares of the harmonics above where they end.
    left: f64,
    /// Where those of the present grid do.
    present: f64,
}

impl Search {
    fn new(
        system: &System,
        grid: TimeGrid,
        state: &GridState,
        (seen, tried): (f64, usize),
    ) -> Self {
        let tried = (tried * grid.points()) | 1;
        let curves = curves(system, grid, state);
        let mut search = Search {
            grid,
            tried,
            curves,
            spared: None,
            analysis: Analysis::new(tried),
            left: 0.0,
            present: seen * grid.harmonics() as f64,
        };
        let squares = search.squares(grid.map());
        let first = search.present.ceil() as usize + 1;
        search.left = squares.iter().skip(first).sum();
        search.present = search.ends(&squares);
        search
    }

    /// The map of these events improved, and of more while each gains much, and where harmonics end
    /// under it; none if all that gains little. No more where other curves are to be spared.
    fn from(&mut self, mut events: Vec<SharpEvent>, least: f64) -> Option<(Sharper, f64)> {
        let (present, mut best) = (self.present, self.present);
        if !events.is_empty() {
            let ends = self.ends_with(&events);
            (events, best) = self.improved(events, ends);
        }
        while events.len() < EVENTS && self.spared.is_none() {
            let map = TimeMap::new(&events, 1.0).ok()?;
            let time = self.sharpest(&map);
            let (with, ends) = self.with_event(&events, time);
            let (with, ends) = self.improved(with, ends);
            if ends * WORTH > best {
                break;
            }
            (events, best) = (with, ends);
        }
        let gain = present / best;
        if gain <= least {
            return None;
        }
        let map = TimeMap::new(&events, 1.0).ok()?;
        let holding = None;
        Some((Sharper { map, gain, holding }, best))
    }

    /// The curves at the points of a grid that is tried.
    fn sampled(&self, map: &TimeMap) -> Vec<Vec<f64>> {
        let times = map.times(self.tried);
        let own = self.grid.map();
        let places: Vec<f64> = times.iter().map(|time| own.pseudo(*time)).collect();
        let samples = |curve: &Curve| places.iter().map(|place| curve.at(*place)).collect();
        self.curves.iter().map(samples).collect()
    }

    /// Sums of squares of the harmonics of all curves under a map.
    fn squares(&mut self, map: &TimeMap) -> Vec<f64> {
        let scale = 1.0 / self.tried as f64;
        let mut squares = vec![0.0; self.analysis.spectrum.len()];
        for samples in self.sampled(map) {
            self.analysis.read(samples.into_iter());
            for (sum, harmonic) in squares.iter_mut().zip(&self.analysis.spectrum) {
                *sum += (harmonic * scale).norm_sqr();
            }
        }
        squares
    }

    /// The harmonic above which no more is left than is to be, with a fraction.
    fn ends(&self, squares: &[f64]) -> f64 {
        let mut above = 0.0;
        for (harmonic, square) in squares.iter().enumerate().rev() {
            let with = above + square;
            if with > self.left {
                let part = (with / self.left).ln() / (with / f64::max(above, 1e-30)).ln();
                return harmonic as f64 - 1.0 + part.clamp(0.0, 1.0);
            }
            above = with;
        }
        0.0
    }

    /// Where they end with these events; the largest number if one is none.
    fn ends_with(&mut self, events: &[SharpEvent]) -> f64 {
        match TimeMap::new(events, 1.0) {
            Ok(map) => {
                let squares = self.squares(&map);
                let ends = self.ends(&squares);
                let harms = |(other, most): &mut (Box<Search>, f64)| {
                    let squares = other.squares(&map);
                    other.ends(&squares) > *most
                };
                match self.spared.as_mut().is_some_and(harms) {
                    true => f64::MAX,
                    false => ends,
                }
            }
            Err(_) => f64::MAX,
        }
    }

    /// Time, in periods, at which the upper harmonics of the curves under a map add up to most.
    fn sharpest(&self, map: &TimeMap) -> f64 {
        let points = self.tried;
        let Ok(grid) = TimeGrid::new(points, 1.0) else {
            return 0.0;
        };
        let mut resampling = Resampling::new(grid, 0.0, points);
        let (mut upper, mut sums) = (vec![0.0; points], vec![0.0; points]);
        for samples in self.sampled(map) {
            resampling.read(samples.into_iter());
            let first = self.present as usize + 1;
            resampling.truncate(self.grid.harmonics());
            resampling.write(0, first, &mut upper);
            for (sum, x) in sums.iter_mut().zip(&upper) {
                *sum += x * x;
            }
        }
        let most = (0..sums.len()).max_by(|&a, &b| sums[a].total_cmp(&sums[b]));
        map.time(most.unwrap_or(0) as f64 / points as f64)
    }

    /// These events and the best of some at another time, and where harmonics end then.
    fn with_event(&mut self, events: &[SharpEvent], time: f64) -> (Vec<SharpEvent>, f64) {
        let mut best = (events.to_vec(), f64::MAX);
        for width in WIDTHS {
            for share in SHARES {
                let mut with = events.to_vec();
                with.push(SharpEvent { time, width, share });
                let ends = self.ends_with(&with);
                if ends < best.1 {
                    best = (with, ends);
                }
            }
        }
        best
    }

    /// Moves each event to the middle of the times that serve alike: this motion tells no better
    /// when others are sharpest.
    fn centre(&mut self, events: &mut [SharpEvent], best: f64) {
        for i in 0..events.len() {
            let SharpEvent { time, width, .. } = events[i];
            let mut reach = |direction: f64| {
                let mut reached = 0.0;
                for step in 1..=MOST_MOVES {
                    let moved = direction * MOVE * f64::from(step);
                    events[i].time = time + moved * width;
                    if self.ends_with(events) > ALIKE * best {
                        break;
                    }
                    reached = moved;
                }
                reached
            };
            let both = reach(-1.0) + reach(1.0);
            events[i].time = time + 0.5 * both * width;
        }
    }

    /// Events changed one number after the other while harmonics end earlier.
    fn improved(&mut self, mut events: Vec<SharpEvent>, mut ends: f64) -> (Vec<SharpEvent>, f64) {
        for step in STEPS {
            let mut better = true;
            while better {
                better = false;
                for i in 0..events.len() {
                    for change in changes(step) {
                        let mut tried = events.clone();
                        change(&mut tried[i]);
                        let found = self.ends_with(&tried);
                        // Less is no reason to go on for long.
                        if found < 0.99 * ends {
                            (events, ends) = (tried, found);
                            better = true;
                        }
                    }
                }
            }
        }
        (events, ends)
    }
}

/// Small changes of an event.
fn changes(step: f64) -> [impl Fn(&mut SharpEvent); 6] {
    let change = |width: f64, share: f64, moved: f64| {
        move |event: &mut SharpEvent| {
            event.time += moved * event.width;
            event.width = (event.width * width).clamp(NARROWEST, WIDEST);
            event.share = (event.share * share).clamp(LEAST_SHARE, LARGEST_SHARE);
        }
    };
    let part = step - 1.0;
    [
        change(step, 1.0, 0.0),
        change(1.0 / step, 1.0, 0.0),
        change(1.0, step, 0.0),
        change(1.0, 1.0 / step, 0.0),
        change(1.0, 1.0, part),
        change(1.0, 1.0, -part),
    ]
}

/// Positions, relative to the characteristic length, and entries of rotation matrices that have
/// most in the highest harmonics.
fn curves(system: &System, grid: TimeGrid, state: &GridState) -> Vec<Curve> {
    let length = system.scales().length;
    let entry = |node: usize, i: usize| {
        let motions = state.node(node).iter();
        motions.map(move |m| match i {
            0..3 => m.position[i] / length,
            _ => m.rotation[i - 3],
        })
    };
    let mut resampling = Resampling::new(grid, 0.0, (TABLE * grid.points()) | 1);
    let mut all: Vec<(f64, usize, usize)> = Vec::new();
    for node in 0..system.nodes() {
        for i in 0..12 {
            resampling.read(entry(node, i));
            let upper = resampling.amplitudes().skip(grid.harmonics() / 2);
            all.push((upper.map(|a| a * a).sum(), node, i));
        }
    }
    all.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut table = |&(_, node, i): &(f64, usize, usize)| {
        let count = resampling.points();
        let mut curve = Curve {
            values: vec![0.0; count],
            slopes: vec![0.0; count],
        };
        resampling.read(entry(node, i));
        resampling.write(0, 0, &mut curve.values);
        resampling.write(1, 0, &mut curve.slopes);
        let step = grid.period() / count as f64;
        curve.slopes.iter_mut().for_each(|slope| *slope *= step);
        curve
    };
    all.iter().take(CURVES).map(&mut table).collect()
}
