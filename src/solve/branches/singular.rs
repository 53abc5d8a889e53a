//! Where increments of a kind meet no resistance, as a scalar equation: minimally augmented systems
//! (docs/theory.md, section 13.7).

use super::Event;
use crate::collocation::{
    Antiperiodic, Collocation, GridState, Linearisation, Pattern, Tangent, over,
};
use crate::error::{Error, ErrorKind, Result};
use crate::solve::linear::dense::probe;
use crate::solve::modes::pencil::{C64, Inverse, Pencil};
use std::f64::consts::TAU;

/// Solves with the borders that make them follow the vectors that are nearly singular.
const RENEWALS: usize = 3;
/// Step of differences, of which 1 is a motion as large as the mechanism or the parameter's range.
pub(super) const STEP: f64 = 1e-5;
/// The same of differences of fourth order, which amplify rounding less.
const LONG_STEP: f64 = 3e-4;
/// Shift, over the frequency, where the equations are singular to rounding.
const BESIDE: f64 = 1e-9;

/// `σ`, of which `J(μ) v + σ a = 0` and `b·v = 1`: zero where the Jacobian `J` for increments
/// `exp(μt) Δu`, with `μ = iω` at events, is singular.
pub(in crate::solve) struct Singular {
    pub event: Event,
    /// `ω`: zero but at torus points, and for exponents.
    pub frequency: f64,
    /// Real part of the exponent beside `iω`: zero at events.
    pub growth: f64,
    equations: Collocation,
    /// For products at other states.
    tangent: Tangent,
    pencil: Pencil,
    /// `a` and `b`, of motions and forces alone: what is least in constraints are high harmonics.
    borders: [Vec<C64>; 2],
    /// `v` and `w`, of `wᵀ J + σ bᵀ = 0` and `a·w = 1`.
    vectors: [Vec<C64>; 2],
}

impl Singular {
    /// For an event near `state`, where `equations` have its free parameters; none if the equations
    /// cannot be factored there.
    pub fn new(
        event: Event,
        frequency: f64,
        equations: &Collocation,
        state: &GridState,
    ) -> Result<Option<Self>> {
        Self::with_exponent(event, C64::new(0.0, frequency), equations, state)
    }

    /// For an exponent of disturbances, which is nearly this.
    pub fn of_exponent(
        exponent: C64,
        equations: &Collocation,
        state: &GridState,
    ) -> Result<Option<Self>> {
        Self::with_exponent(Event::Torus, exponent, equations, state)
    }

    fn with_exponent(
        event: Event,
        exponent: C64,
        equations: &Collocation,
        state: &GridState,
    ) -> Result<Option<Self>> {
        let mut equations = equations.clone();
        equations.ground(0.0);
        let pattern = Pattern::new(equations.system(), equations.grid().points());
        let matrices = linearised(event, &mut equations, state, &pattern)?;
        let motions = equations.layout().motions();
        let (size, workers) = (equations.size(), equations.workers().clone());
        let mut border: Vec<C64> = probe(size).into_iter().map(C64::from).collect();
        normalise(&mut border, motions.end);
        let mut singular = Singular {
            event,
            frequency: exponent.im,
            growth: exponent.re,
            pencil: Pencil::new(pattern, matrices, workers)?,
            borders: [border.clone(), border],
            vectors: [Vec::new(), Vec::new()],
            tangent: Tangent::new(equations.system(), equations.grid().points()),
            equations,
        };
        for _ in 0..RENEWALS {
            if !singular.solve()? || !singular.renew()? {
                return Ok(None);
            }
        }
        Ok(Some(singular))
    }

    /// Makes borders of the vectors. `false` if these are none.
    pub fn renew(&mut self) -> Result<bool> {
        let motions = self.equations.layout().motions();
        let [v, w] = &self.vectors;
        self.borders = [w, v].map(|vector| {
            let mut border: Vec<C64> = vector.iter().map(|x| x.conj()).collect();
            normalise(&mut border, motions.end);
            border
        });
        let mut all = self.borders.iter().flatten();
        Ok(all.all(|x| x.is_finite()))
    }

    /// Whether `ω` is unknown, too, and the equation a complex one.
    pub fn is_complex(&self) -> bool {
        self.event == Event::Torus
    }

    /// `μ`.
    pub fn exponent(&self) -> C64 {
        C64::new(self.growth, self.frequency)
    }

    /// Finds the vectors with the present borders. `false` if that cannot be done.
    fn solve(&mut self) -> Result<bool> {
        let s = self.exponent();
        let beside = C64::from(BESIDE * TAU / self.equations.grid().period());
        let mut inverse = Inverse::new(&self.pencil, s)?;
        if inverse.is_none() {
            inverse = Inverse::new(&self.pencil, s + beside)?;
        }
        let Some(inverse) = inverse else {
            return Ok(false);
        };
        // Where J is nearly singular these are large, and their direction is all that counts.
        let [a, b] = &self.borders;
        let (Some(v), Some(w)) = (inverse.solve_once(a), inverse.solve_transposed(b)) else {
            return Ok(false);
        };
        let normed = |x: Vec<C64>, border: &[C64]| -> Option<Vec<C64>> {
            let size = product(&x, border);
            let scaled: Vec<C64> = x.into_iter().map(|x| x / size).collect();
            scaled.iter().all(|x| x.is_finite()).then_some(scaled)
        };
        let (Some(v), Some(w)) = (normed(v, b), normed(w, a)) else {
            return Ok(false);
        };
        self.vectors = [v, w];
        Ok(true)
    }

    /// Linearises at `state` and finds `σ`; none if that cannot be done.
    pub fn value(&mut self, state: &GridState) -> Result<Option<C64>> {
        let pattern = &self.pencil.pattern;
        let matrices = linearised(self.event, &mut self.equations, state, pattern)?;
        self.pencil.matrices = matrices;
        if !self.solve()? {
            return Ok(None);
        }
        let [v, w] = &self.vectors;
        // Of second order in the errors of both.
        Ok(Some(-product(w, &self.pencil.product(self.exponent(), v))))
    }

    /// Number of unknowns, with free parameters.
    pub fn unknowns(&self) -> usize {
        self.equations.layout().size()
    }

    /// Derivative of `σ` by `μ` at the state of the last value.
    pub fn by_exponent(&self) -> C64 {
        self.by_frequency() / C64::i()
    }

    /// Derivative of `σ` by `ω` at the state of the last value.
    pub fn by_frequency(&self) -> C64 {
        let [v, w] = &self.vectors;
        let (i, matrices) = (C64::i(), &self.pencil.matrices);
        let mut rate = vec![C64::default(); v.len()];
        self.pencil.add_product(&matrices.damping, i, v, &mut rate);
        let twice = 2.0 * i * self.exponent();
        self.pencil.add_product(&matrices.mass, twice, v, &mut rate);
        -product(w, &rate)
    }

    /// Derivative of `σ` in a direction of all unknowns, not scaled and of the length `size`, at
    /// the state of the last value, by central differences of fourth order.
    pub fn along(&mut self, state: &GridState, direction: &[f64], size: f64) -> Result<C64> {
        if size == 0.0 {
            return Ok(C64::default());
        }
        let step = LONG_STEP / size;
        let system = self.equations.system().clone();
        let mut change = C64::default();
        for (steps, weight) in [(1.0, 8.0), (-1.0, -8.0), (2.0, -1.0), (-2.0, 1.0)] {
            let beside = state.incremented(&system, direction, steps * step);
            change -= self.form_at(&beside)? * weight;
        }
        Ok(change / (12.0 * step))
    }

    /// `wᵀ J v` at another state; but for the compliance of constraints, which is the same at all.
    fn form_at(&mut self, state: &GridState) -> Result<C64> {
        let [v, w] = &self.vectors;
        if !self.is_complex() {
            prepare(self.event, &mut self.equations, state)?;
            self.tangent.evaluate(&mut self.equations, state)?;
            let real: Vec<f64> = v.iter().map(|x| x.re).collect();
            let mut rest = vec![0.0; real.len()];
            self.tangent.apply(&self.equations, &real, &mut rest);
            let terms = w.iter().zip(&rest).map(|(w, y)| w.re * y);
            return Ok(C64::from(terms.sum::<f64>()));
        }
        let pattern = &self.pencil.pattern;
        let there = linearised(self.event, &mut self.equations, state, pattern)?;
        let here = std::mem::replace(&mut self.pencil.matrices, there);
        let form = product(w, &self.pencil.product(self.exponent(), v));
        self.pencil.matrices = here;
        Ok(form)
    }

    /// The direction of motions that meets no resistance, not scaled: its real part.
    pub fn direction(&self) -> Vec<f64> {
        let scales = self.equations.column_scale().iter();
        let motions = self.equations.layout().motions();
        let [v, _] = &self.vectors;
        let scaled = v[motions].iter().zip(scales);
        scaled.map(|(x, scale)| x.re * scale).collect()
    }
}

/// Matrices of the pencil for increments of an event.
fn linearised(
    event: Event,
    equations: &mut Collocation,
    state: &GridState,
    pattern: &Pattern,
) -> Result<Linearisation> {
    prepare(event, equations, state)?;
    equations.linearise(state, pattern)
}

/// Gives the equations the parameters of a state, and the rule of increments of an event.
fn prepare(event: Event, equations: &mut Collocation, state: &GridState) -> Result<()> {
    equations.apply_scalars(state)?;
    let (grid, nodes) = (equations.grid(), equations.system().nodes());
    equations.set_rule(match event {
        Event::PeriodDoubling => Box::new(Antiperiodic::new(grid, nodes)),
        Event::Fold | Event::Torus => over(grid, nodes),
        Event::BranchPoint => {
            let message = "branch points have no equation of their own";
            return Err(Error::new(ErrorKind::NotAvailable, message));
        }
    });
    Ok(())
}

/// `Σ x y`, without a conjugate.
fn product(x: &[C64], y: &[C64]) -> C64 {
    x.iter().zip(y).map(|(x, y)| x * y).sum()
}

/// Of length 1, and of the first `motions` unknowns alone.
fn normalise(x: &mut [C64], motions: usize) {
    x[motions..].fill(C64::default());
    let size = x.iter().map(|x| x.norm_sqr()).sum::<f64>().sqrt();
    x.iter_mut().for_each(|x| *x /= size);
}
