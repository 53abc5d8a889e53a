//! Natural modes and damped eigenvalues about an equilibrium, at rest or in steady rotation.
//! See docs/theory.md, section 11.3.

pub(crate) mod eigen;
mod free_motions;
pub(crate) mod krylov;
pub(crate) mod pencil;

use crate::collocation::{Collocation, Pattern};
use crate::error::{Error, ErrorKind, Result, require_finite};
use crate::model::Model;
use crate::solve::equilibrium::{Purpose, StaticOptions, find_equilibrium};
use crate::solve::modes::eigen::{EigenPair, Search, Target};
use crate::solve::modes::free_motions::without_free_motions;
use crate::solve::modes::pencil::{C64, Pencil};
use crate::solve::report::{Iteration, Outcome};
use crate::solve::result::Solved;
use crate::solve::watch::{Stage, Watching};
use crate::workers::Workers;
use nalgebra::Complex;

/// Parts of a mode that are rounding, relative to its largest.
const ROUNDING: f64 = 1e-12;

/// Options of a modal analysis.
#[derive(Debug, Clone)]
pub struct ModesOptions {
    /// The equilibrium, and how to find it.
    pub equilibrium: StaticOptions,
    /// Number of modes wanted.
    pub count: usize,
    /// Angular frequency near which they are wanted; those of the smallest eigenvalues otherwise.
    pub near_frequency: Option<f64>,
}

impl Default for ModesOptions {
    fn default() -> Self {
        ModesOptions {
            equilibrium: StaticOptions::default(),
            count: 10,
            near_frequency: None,
        }
    }
}

/// A small motion `Re(x exp(st))`.
#[derive(Debug, Clone)]
pub struct Mode {
    /// `s`, of a conjugate pair that with the positive imaginary part.
    pub eigenvalue: Complex<f64>,
    /// Largest entry of the equations of small motions, relative to the largest sum of the sizes of
    /// their terms; for a free motion relative to the largest stiffness.
    pub residual: f64,
    /// `φᴴ M φ`, with the shape as it is scaled here.
    pub modal_mass: f64,
    /// Material increments `[linear; angular]` of each node. The largest is 1, of displacements
    /// relative to the size of the mechanism and of turns in radians.
    pub shape: Vec<[Complex<f64>; 6]>,
    /// Multipliers and internal states, in the order of those of an instant.
    pub(crate) own: Vec<Complex<f64>>,
}

impl Mode {
    /// Oscillations per unit of time, `|Im s| / 2π`.
    pub fn frequency(&self) -> f64 {
        self.eigenvalue.im.abs() / std::f64::consts::TAU
    }

    /// `−Re s / |s|`; zero for a free motion.
    pub fn damping_ratio(&self) -> f64 {
        match self.eigenvalue.norm() {
            0.0 => 0.0,
            size => -self.eigenvalue.re / size,
        }
    }
}

/// Result of a modal analysis.
#[derive(Debug, Clone)]
pub struct ModesSolve {
    /// The equilibrium, converged or not.
    pub equilibrium: Solved,
    /// The modes, the smallest eigenvalue or that nearest to the wanted frequency first; none if
    /// there is no equilibrium.
    pub modes: Vec<Mode>,
    /// Whether the wanted number was found, or all that there are.
    pub complete: bool,
}

/// Finds an equilibrium of `model` and the modes of small motions about it.
///
/// The equations of motion with their exact tangents, constraints included, are linearised to
/// `(s² M + s C + K) x = 0`; in a turning frame `C` and `K` contain gyroscopic and centrifugal
/// terms.
///
/// `observe` sees each iteration of the equilibrium and returns `false` to cancel.
///
/// # Errors
/// If options or model are not valid, memory runs out or numbers overflow. Where there is no
/// equilibrium there are no modes; that is an outcome, not an error.
pub fn solve_modes(
    model: &Model,
    options: &ModesOptions,
    observe: &mut dyn FnMut(Stage, &Iteration) -> bool,
) -> Result<ModesSolve> {
    const MOST: usize = 100_000;
    if !(1..=MOST).contains(&options.count) {
        return Err(Error::size(
            "options.count",
            format!("1 to {MOST}"),
            options.count,
        ));
    }
    if let Some(near) = options.near_frequency {
        require_finite("options.near_frequency", &[near])?;
        if near <= 0.0 {
            return Err(Error::value(
                "options.near_frequency",
                "a positive angular frequency",
                near,
            ));
        }
    }
    let mut cancelled = false;
    let mut watch = |stage, iteration: &Iteration| {
        cancelled |= !observe(stage, iteration);
        !cancelled
    };
    let watching = options.equilibrium.watch.begin(Stage::InitialGuess, 1);
    let mut equilibrium = find_equilibrium(
        model,
        &options.equilibrium,
        Purpose::Modes(options.count),
        &watching,
        &mut watch,
    )?;
    if cancelled || watching.is_stopped() {
        // Also if the iteration was the last one: the modes are not wanted any more.
        equilibrium.report.outcome = Outcome::Cancelled;
    }
    let mut solve = ModesSolve {
        equilibrium,
        modes: Vec::new(),
        complete: false,
    };
    if solve.equilibrium.report.outcome != Outcome::Converged {
        return Ok(solve);
    }
    watching.stage(Stage::Modes);
    match find_modes(&mut solve, options, &watching) {
        Err(error) if watching.cancels(&error) => {
            solve.equilibrium.report.outcome = Outcome::Cancelled;
        }
        found => found?,
    }
    let outcome = &mut solve.equilibrium.report.outcome;
    *outcome = watching.outcome(*outcome);
    Ok(solve)
}

/// Finds modes about an equilibrium.
fn find_modes(solve: &mut ModesSolve, options: &ModesOptions, watching: &Watching) -> Result<()> {
    let Solved {
        system,
        grid,
        state,
        ..
    } = &solve.equilibrium;
    let mut equations = Collocation::new(system.clone(), *grid)?;
    let pattern = Pattern::new(system, 1);
    let matrices = equations.linearise(state, &pattern)?;
    let workers = Workers::default().telling(watching.pulse());
    let pencil = Pencil::new(pattern, matrices, workers)?;
    let numbers = [
        &pencil.matrices.stiffness,
        &pencil.matrices.damping,
        &pencil.matrices.mass,
    ];
    if numbers
        .iter()
        .any(|values| values.iter().any(|v| !v.is_finite()))
    {
        let message = "modes: the model's stiffnesses and masses are too far apart to compute with";
        return Err(Error::new(ErrorKind::Overflow, message));
    }
    let target = options
        .near_frequency
        .map_or(Target::Smallest, Target::Near);
    let search = Search::new(&pencil)?;
    let found = search.run(target, options.count)?;
    solve.complete = found.complete;
    let mut pairs = without_free_motions(&search, found.pairs)?;
    pairs.sort_by(|a, b| {
        target
            .distance(a.value)
            .total_cmp(&target.distance(b.value))
    });
    pairs.truncate(options.count);
    let energy = system.scales().force * system.scales().length;
    let modes = pairs.into_iter().map(|pair| {
        mode(
            &pencil,
            pair,
            equations.layout().motions().end,
            equations.column_scale(),
            energy,
        )
    });
    solve.modes = modes.collect::<Result<_>>()?;
    Ok(())
}

/// Unscaled mode of a scaled pair.
///
/// # Errors
/// [`ErrorKind::Overflow`].
fn mode(
    pencil: &Pencil,
    pair: EigenPair,
    motions: usize,
    scales: &[f64],
    energy: f64,
) -> Result<Mode> {
    let EigenPair { value, mut vector } = pair;
    let largest = vector[..motions].iter().fold(C64::default(), |m, x| {
        // Of equal ones the first, whatever their rounding.
        if x.norm() > m.norm() * (1.0 + 1e-6) {
            *x
        } else {
            m
        }
    });
    if largest.norm() > 0.0 {
        vector.iter_mut().for_each(|x| *x /= largest);
    }
    let mut momentum = vec![C64::default(); vector.len()];
    pencil.add_product(
        &pencil.matrices.mass,
        C64::from(1.0),
        &vector,
        &mut momentum,
    );
    let modal_mass = vector
        .iter()
        .zip(&momentum)
        .map(|(x, p)| (x.conj() * p).re)
        .sum::<f64>();
    let residual = if value == C64::default() {
        pencil.resistance(&vector)
    } else {
        pencil.relative_residual(value, &vector)
    };
    // A motion in a plane is to be one, to the last digit.
    let (motion, own) = vector.split_at_mut(motions);
    without_rounding(motion);
    without_rounding(own);
    let unscaled: Vec<C64> = vector.iter().zip(scales).map(|(x, s)| x * *s).collect();
    let (motion, own) = unscaled.split_at(motions);
    let node = |u: &[C64]| std::array::from_fn(|i| u[i]);
    let modal_mass = modal_mass * energy;
    let numbers = [value.re, value.im, residual, modal_mass];
    if !(numbers.iter().all(|x| x.is_finite()) && unscaled.iter().all(|x| x.is_finite())) {
        let message = "a mode is too large to be numbers";
        return Err(Error::new(ErrorKind::Overflow, message));
    }
    Ok(Mode {
        eigenvalue: value,
        residual,
        modal_mass,
        shape: motion.chunks_exact(6).map(node).collect(),
        own: own.to_vec(),
    })
}

/// Puts zero where there is rounding only.
fn without_rounding(parts: &mut [C64]) {
    let largest = parts.iter().fold(0.0f64, |most, x| most.max(x.norm()));
    for x in parts {
        if x.norm() < ROUNDING * largest {
            *x = C64::default();
        }
    }
}
