//! Exponents from the equations on the grid itself, for disturbances `exp(μt) φ` with `φ` of the
//! period: eigenvalues of `J(μ)` by shift and invert. See docs/theory.md, section 12.5.

use crate::collocation::{Collocation, Pattern};
use crate::error::Result;
use crate::fourier::TimeGrid;
use crate::solve::modes::eigen::{EigenPair, Search, Target};
use crate::solve::modes::pencil::{C64, Pencil};
use crate::solve::result::Solved;
use crate::workers::Workers;
use std::f64::consts::TAU;

/// Eigenvalues wanted about each shift, at first and at most.
const FIRST: usize = 24;
const MOST: usize = 2000;
/// Distance from each shift, in frequencies of the period, up to which all eigenvalues are to be
/// found.
const REACH: f64 = 0.75;
/// Shifts are as far apart as one of so many of the harmonics of the grid.
const APART: usize = 2;
/// The highest harmonics, one of so many, by which it is judged how well a mode is resolved.
const EDGE: usize = 8;
/// Share of a mode in these of one that is not resolved.
const UNRESOLVED: f64 = 1e-2;
/// Error of a multiplier by the square of that share; seen in several models.
const ERROR: f64 = 20.0;
/// Rounding.
const ROUNDING: f64 = 1e-12;
/// Copies of a multiplier differ by so many times their errors at most.
const COPIES: f64 = 100.0;
/// Product of unit vectors of one mode.
const SAME: f64 = 0.9;

/// An exponent with its mode over the grid.
pub(super) struct Exponent {
    pub value: C64,
    pub frequency: f64,
    pub error: f64,
    mode: Vec<C64>,
}

/// What was found.
pub(super) struct Exponents {
    /// One of each pair.
    pub found: Vec<Exponent>,
    /// Whether all that there are about each shift were.
    pub complete: bool,
}

/// The modes of a periodic solution whose frequencies are up to `highest` or a little more.
pub(super) fn exponents(solve: &Solved, highest: f64, workers: &Workers) -> Result<Exponents> {
    let (system, grid) = (&solve.system, solve.grid);
    let mut equations = Collocation::new(system.clone(), grid)?;
    equations.set_workers(workers.clone());
    let pattern = Pattern::new(system, grid.points());
    let matrices = equations.linearise(&solve.state, &pattern)?;
    let pencil = Pencil::new(pattern, matrices, workers.clone())?;
    let search = Search::new(&pencil)?;
    let motions = equations.layout().motions().end;
    let mut all = Exponents {
        found: Vec::new(),
        complete: true,
    };
    let mut candidates = Vec::new();
    let last = (highest / grid.frequency()).ceil() as usize;
    // A mode has copies about each shift; those with few harmonics are well resolved.
    let apart = (grid.harmonics() / APART).max(1);
    for harmonic in (0..last + apart).step_by(apart) {
        // Off the axis of real exponents, where both of a pair would be as near.
        let shift = (harmonic as f64).max(0.25) * grid.frequency();
        let (pairs, complete) = about(&search, shift, grid)?;
        all.complete &= complete;
        let reach = REACH * grid.frequency();
        let within = |pair: &EigenPair| Target::Near(shift).distance(pair.value) < reach;
        let pairs = pairs.into_iter().filter(within);
        candidates.extend(pairs.map(|pair| exponent(pair, motions, grid)));
    }
    candidates.retain(|c| c.error < ERROR * UNRESOLVED * UNRESOLVED);
    candidates.sort_by(|a, b| a.error.total_cmp(&b.error));
    for candidate in candidates {
        if !all
            .found
            .iter()
            .any(|known| known.is_copy(&candidate, grid))
        {
            all.found.push(candidate);
        }
    }
    Ok(all)
}

/// Eigenvalues about `iω`, until all within reach are among them; and whether they are.
fn about(search: &Search, shift: f64, grid: TimeGrid) -> Result<(Vec<EigenPair>, bool)> {
    let mut count = FIRST;
    loop {
        let target = Target::Near(shift);
        let found = search.run(target, count)?;
        let furthest = found.pairs.iter().map(|pair| target.distance(pair.value));
        let beyond = furthest.fold(0.0, f64::max) > REACH * grid.frequency();
        if beyond || count >= MOST || found.pairs.len() < count {
            return Ok((found.pairs, found.complete && (beyond || count < MOST)));
        }
        count *= 2;
    }
}

/// What an eigenvalue and its vector say.
fn exponent(pair: EigenPair, motions: usize, grid: TimeGrid) -> Exponent {
    let EigenPair { value, mut vector } = pair;
    vector.truncate(motions);
    let points = grid.points();
    let edge_from = grid.harmonics() - grid.harmonics().div_ceil(EDGE);
    let phases: Vec<C64> = (0..points)
        .map(|k| C64::from_polar(1.0, -TAU * k as f64 / points as f64))
        .collect();
    let (mut sum, mut edge, mut square) = (0.0, 0.0, 0.0);
    for node in vector.chunks_exact(6 * points) {
        for component in 0..6 {
            for j in 0..points {
                let terms = (0..points).map(|k| node[6 * k + component] * phases[j * k % points]);
                let size = terms.sum::<C64>().norm_sqr();
                let folded = if 2 * j > points { points } else { 0 };
                let harmonic = j as f64 - folded as f64;
                let frequency = value.im + harmonic * grid.frequency();
                sum += size;
                square += size * frequency * frequency;
                if harmonic.abs() >= edge_from as f64 {
                    edge += size;
                }
            }
        }
    }
    let size = (value.re * grid.period()).exp();
    Exponent {
        value,
        frequency: (square / sum).sqrt(),
        error: (ERROR * edge / sum + ROUNDING) * size.max(1.0),
        mode: vector,
    }
}

impl Exponent {
    /// Whether there is a conjugate that is not the same.
    pub fn is_paired(&self, grid: TimeGrid) -> bool {
        !self.matches(self, true, grid)
    }

    /// Whether `other` is the same mode with its harmonics shifted, or its conjugate.
    fn is_copy(&self, other: &Exponent, grid: TimeGrid) -> bool {
        [false, true]
            .into_iter()
            .any(|conjugate| self.matches(other, conjugate, grid))
    }

    fn matches(&self, other: &Exponent, conjugate: bool, grid: TimeGrid) -> bool {
        let turned = |z: C64| if conjugate { z.conj() } else { z };
        let multiplier = |s: C64| (s * grid.period()).exp();
        let value = turned(other.value);
        let distance = (multiplier(value) - multiplier(self.value)).norm();
        if distance > COPIES * (self.error + other.error) {
            return false;
        }
        let turns = ((value - self.value).im / grid.frequency()).round();
        let points = grid.points();
        let phase = |k: usize| C64::from_polar(1.0, turns * TAU * k as f64 / points as f64);
        let (mut product, mut sizes) = (C64::default(), [0.0; 2]);
        for (i, (a, b)) in self.mode.iter().zip(&other.mode).enumerate() {
            product += a.conj() * turned(*b) * phase(i / 6 % points);
            sizes[0] += a.norm_sqr();
            sizes[1] += b.norm_sqr();
        }
        product.norm() > SAME * (sizes[0] * sizes[1]).sqrt()
    }
}
