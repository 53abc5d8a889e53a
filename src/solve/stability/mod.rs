//! Stability of periodic solutions: what a small disturbance is multiplied by in a period.
//! See docs/theory.md, section 12.4.

mod analysis;
mod hill;
mod judgement;
mod next_blade;
mod period_map;
mod resolution;
mod shifts;
mod spectrum;
mod step_map;

use crate::error::{Error, ErrorKind, Result, require_finite};
use crate::solve::report::Outcome;
use crate::solve::result::{Kind, Solved};
pub(crate) use crate::solve::stability::analysis::Experience;
use crate::solve::stability::analysis::find;
use crate::solve::stability::hill::exponents;
use crate::solve::stability::judgement::judge_exponents;
use crate::solve::stability::spectrum::Spectrum;
use crate::solve::watch::{Stage, Watch, Watching};
use crate::workers::Workers;
use nalgebra::Complex;
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;
use std::time::{Duration, Instant};

/// Frequencies that matter unless others are asked for, in those of the period.
const HARMONICS: f64 = 20.0;

/// How multipliers are found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StabilityMethod {
    /// By integrating disturbances over the period.
    PeriodMap,
    /// As exponents from the equations on the solution's grid: to compare with, where that is not
    /// too large.
    Grid,
}

/// Options of an analysis of stability.
#[derive(Debug, Clone)]
pub struct StabilityOptions {
    /// How multipliers are found.
    pub method: StabilityMethod,
    /// Modes of up to this angular frequency matter; none for 20 times that of the period.
    pub highest_frequency: Option<f64>,
    /// Estimated error of the multipliers of these modes, in units of 1 or of the multiplier where
    /// that is more.
    pub tolerance: f64,
    /// Who is told that work goes on, and may cancel it.
    pub watch: Watch,
}

impl Default for StabilityOptions {
    fn default() -> Self {
        StabilityOptions {
            method: StabilityMethod::PeriodMap,
            highest_frequency: None,
            tolerance: 1e-8,
            watch: Watch::default(),
        }
    }
}

/// Whether disturbances of a periodic solution die away.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Verdict {
    /// Those of all frequencies up to the limit do, but for those that only move the solution in
    /// time or space.
    Stable,
    /// One of them grows.
    Unstable,
    /// It cannot be told: multipliers are on the unit circle, or not known well enough.
    NotKnown,
}

/// What a disturbance is multiplied by in a period.
#[derive(Debug, Clone)]
pub struct Multiplier {
    /// `ρ`.
    pub value: Complex<f64>,
    /// `μ`, with `ρ = exp(μT)`; of the many such `μ` that whose imaginary part is nearest to the
    /// frequency of the mode.
    pub exponent: Complex<f64>,
    /// Angular frequency of the mode over the period, in its nodes' own axes.
    pub frequency: f64,
    /// Estimated error of `ρ` for this periodic motion.
    pub error: f64,
    /// Whether it is 1 because the disturbance moves the solution in time, or all of the mechanism
    /// in space.
    pub trivial: bool,
}

/// Multipliers of a periodic solution, and what they say.
#[derive(Debug, Clone)]
pub struct Stability {
    /// `Converged`, or `Cancelled` or `Singular` with nothing known, or `ToleranceNotMet`.
    pub outcome: Outcome,
    /// Whether disturbances die away.
    pub verdict: Verdict,
    /// Angular frequency of modes up to which the verdict holds, and of exponents in size; infinite
    /// if all multipliers are known.
    pub frequency_limit: f64,
    /// The multipliers, the largest first, of a pair that with the positive imaginary part; those
    /// of modes that the steps do not resolve are left out if they seem to die away at once.
    pub multipliers: Vec<Multiplier>,
    /// Number of the multipliers that the system has.
    pub states: usize,
    /// The period.
    pub period: f64,
    /// Steps to the period; zero if there were none, and then modes are not given.
    pub steps: usize,
    /// Time that it took.
    pub time: Duration,
    shapes: Shapes,
}

/// Modes over the period.
#[derive(Debug, Clone, Default)]
struct Shapes {
    spectrum: Spectrum,
    /// Column of the spectrum for each multiplier.
    order: Vec<usize>,
}

impl Stability {
    /// Nothing known.
    fn unknown(solve: &Solved, outcome: Outcome) -> Self {
        Stability {
            outcome,
            verdict: Verdict::NotKnown,
            frequency_limit: 0.0,
            multipliers: Vec::new(),
            states: state_count(solve),
            period: solve.grid.period(),
            steps: 0,
            time: Duration::ZERO,
            shapes: Shapes::default(),
        }
    }

    /// The same without the modes.
    pub(crate) fn without_shapes(&self) -> Self {
        Stability {
            multipliers: self.multipliers.clone(),
            shapes: Shapes::default(),
            ..*self
        }
    }

    /// Size of the largest multiplier that is not trivial; zero if there is none.
    pub fn largest(&self) -> f64 {
        let sizes = self.multipliers.iter().filter(|m| !m.trivial);
        sizes.fold(0.0, |most, m| most.max(m.value.norm()))
    }

    /// Number of those outside the unit circle by more than their errors, without the trivial.
    pub fn outside(&self) -> usize {
        let others = self.multipliers.iter().filter(|m| !m.trivial);
        others.filter(|m| m.value.norm() - m.error > 1.0).count()
    }

    /// Number of nodes that modes are known at.
    pub fn nodes(&self) -> usize {
        self.shapes.spectrum.nodes()
    }

    /// Mode `number` at the end of each step, as a material increment `[linear; angular]` of a
    /// node: `φ`, where the disturbance is `exp(μt) φ` and `φ` has the period. The largest
    /// component of all nodes over the period is 1, of displacements relative to the characteristic
    /// length.
    ///
    /// # Errors
    /// If there is no such mode or node.
    pub fn shape(&self, number: usize, node: usize) -> Result<Vec<[Complex<f64>; 6]>> {
        let count = self.multipliers.len();
        let unknown = |what: &str, count: usize, got: usize| {
            let message = format!("{what}: expected a number below {count}, got {got}");
            Error::new(ErrorKind::Identifier, message)
        };
        let Some(multiplier) = self.multipliers.get(number) else {
            return Err(unknown("mode", count, number));
        };
        let spectrum = &self.shapes.spectrum;
        if node >= spectrum.nodes() {
            return Err(unknown("node", spectrum.nodes(), node));
        }
        let column = self.shapes.order[number];
        Ok(spectrum.shape(column, node, multiplier.exponent, self.period))
    }

    /// The times of a mode's shape: ends of the steps.
    pub fn times(&self) -> Vec<f64> {
        let step = |k: usize| self.period * ((k + 1) as f64 / self.steps as f64);
        (0..self.steps).map(step).collect()
    }
}

/// Multipliers of all states: of the freedoms that constraints leave, and internal ones.
fn state_count(solve: &Solved) -> usize {
    let system = &solve.system;
    let independent = system.constraint_count() - system.redundant_constraints();
    let freedoms = (6 * system.nodes()).saturating_sub(independent);
    let internal = system.elements().iter().filter(|p| p.has_states);
    2 * freedoms + internal.map(|p| p.element.own_unknowns()).sum::<usize>()
}

/// Finds the multipliers of small disturbances of a periodic solution.
///
/// Disturbances are integrated over the period about the motion interpolated between the grid
/// points, in steps that are halved until the multipliers of modes up to the highest frequency
/// stand still. That counts the error of these steps; that of the periodic solution comes with it.
///
/// # Errors
/// [`ErrorKind::NotAvailable`] if `solve` is no periodic motion that has converged; those of
/// elements and signals.
pub fn solve_stability(solve: &Solved, options: &StabilityOptions) -> Result<Stability> {
    solve_stability_after(&mut None, solve, options)
}

/// The same, with what the analysis of a motion nearby has taken, which becomes what this one took.
pub(crate) fn solve_stability_after(
    before: &mut Option<Experience>,
    solve: &Solved,
    options: &StabilityOptions,
) -> Result<Stability> {
    validate(solve, options)?;
    let began = Instant::now();
    let watching = options.watch.begin(Stage::Stability, solve.grid.points());
    let found = match options.method {
        StabilityMethod::PeriodMap => find(solve, options, before, &watching),
        StabilityMethod::Grid => find_on_grid(solve, options, &watching),
    };
    let found = watching.unless_cancelled(found)?;
    let mut stability = found.unwrap_or_else(|| Stability::unknown(solve, Outcome::Cancelled));
    stability.time = began.elapsed();
    Ok(stability)
}

impl StabilityOptions {
    fn highest(&self, period: f64) -> f64 {
        self.highest_frequency.unwrap_or(HARMONICS * TAU / period)
    }
}

fn validate(solve: &Solved, options: &StabilityOptions) -> Result<()> {
    if !matches!(solve.kind, Kind::Periodic(_)) || !solve.report.outcome.is_solution() {
        let message = "stability: expected a periodic solution that has converged";
        return Err(Error::new(ErrorKind::NotAvailable, message));
    }
    if options.method == StabilityMethod::Grid && !solve.grid.map().is_identity() {
        let message = "options.method: multipliers from the equations on the grid take an \
            equispaced one; those by the period map take any";
        return Err(Error::new(ErrorKind::NotAvailable, message));
    }
    let numbers = [
        ("options.tolerance", Some(options.tolerance)),
        ("options.highest_frequency", options.highest_frequency),
    ];
    for (name, number) in numbers {
        let Some(number) = number else { continue };
        require_finite(name, &[number])?;
        if number <= 0.0 {
            return Err(Error::value(name, "a positive number", number));
        }
    }
    Ok(())
}

/// Finds exponents from the equations on the grid.
fn find_on_grid(
    solve: &Solved,
    options: &StabilityOptions,
    watching: &Watching,
) -> Result<Stability> {
    let workers = Workers::default().telling(watching.pulse());
    let highest = options.highest(solve.grid.period());
    let exponents = exponents(solve, highest, &workers)?;
    Ok(judge_exponents(
        solve,
        exponents,
        highest,
        options.tolerance,
    ))
}
