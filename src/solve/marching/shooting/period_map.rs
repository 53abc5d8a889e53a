//! The map of one period of a march, and its derivative, propagated through the linearised steps.

use super::propagation::Variations;
use crate::collocation::{
    AlphaStep, Conditions, GridState, MotionState, StepVariation, Variation, VariationScales,
};
use crate::elements::{Measure, Unknown};
use crate::error::Result;
use crate::solve::linear::eigenvalues::eigenvectors;
use crate::solve::marching::marcher::Marcher;
use crate::solve::marching::refused;
use faer::Mat;
use nalgebra::Complex;
use std::f64::consts::TAU;

/// One period: where each step starts, and where it ends.
pub(super) struct Orbit {
    pub starts: Vec<MotionState>,
    ends: Vec<GridState>,
    pub end: MotionState,
}

/// The map of one period.
pub(super) struct PeriodMap {
    pub marcher: Marcher,
    pub scales: VariationScales,
    steps: usize,
    period: f64,
}

impl PeriodMap {
    pub fn new(marcher: Marcher, steps: usize, period: f64) -> Self {
        PeriodMap {
            scales: VariationScales::new(&marcher.newton.equations, period / TAU),
            marcher,
            steps,
            period,
        }
    }

    /// Marches a period from `start`; why not, if a step does not converge.
    pub fn march(&mut self, start: &MotionState) -> Result<std::result::Result<Orbit, String>> {
        let mut orbit = Orbit {
            starts: Vec::with_capacity(self.steps),
            ends: Vec::with_capacity(self.steps),
            end: start.clone(),
        };
        let mut start = start.clone();
        start.time = 0.0;
        self.marcher.restart(start);
        for k in 1..=self.steps {
            orbit.starts.push(self.marcher.now().clone());
            self.marcher.newton.equations.workers().pulse()?;
            if let Err((_, why)) = refused(self.marcher.step(f64::INFINITY))? {
                let time = self.marcher.now().time;
                return Ok(Err(format!("the step from t = {time}: {why}")));
            }
            // No drift of the time by rounding.
            self.marcher
                .set_time(self.period * (k as f64 / self.steps as f64));
            orbit.ends.push(self.marcher.now().state.clone());
        }
        orbit.end = self.marcher.now().clone();
        Ok(Ok(orbit))
    }

    /// Whole turns that internal states gain over an orbit.
    fn gains(&self, orbit: &Orbit) -> Vec<f64> {
        let system = self.marcher.newton.equations.system();
        let (first, last) = (&orbit.starts[0].state, &orbit.end.state);
        let gain = |place: usize| match system.unknown(place) {
            Unknown::State {
                measure: Measure::Angle,
                tracked,
            } => {
                let change = last.coordinates[tracked] - first.coordinates[tracked];
                TAU * (change / TAU).round()
            }
            _ => 0.0,
        };
        (0..system.own_unknowns()).map(gain).collect()
    }

    /// What the end differs by from the start, scaled.
    pub fn miss(&self, orbit: &Orbit) -> Vec<f64> {
        let miss = orbit.starts[0].difference(&orbit.end, &self.gains(orbit));
        let mut entries = vec![0.0; self.scales.size()];
        self.scales.pack(&miss, &mut entries);
        entries
    }

    /// A unit variation of the start.
    fn unit(&self, j: usize) -> Variation {
        let mut unit = vec![0.0; self.scales.size()];
        unit[j] = 1.0;
        self.scales.unpack(&unit)
    }

    /// Derivative of the end of an orbit with respect to its start, scaled.
    pub fn monodromy(&mut self, orbit: &Orbit) -> Result<Option<Mat<f64>>> {
        let mut variations = Variations::of_all(&self.scales);
        let (method, length) = (self.marcher.method, self.period / self.steps as f64);
        let newton = &mut self.marcher.newton;
        for (k, (start, end)) in orbit.starts.iter().zip(&orbit.ends).enumerate() {
            let time = self.period * ((k + 1) as f64 / self.steps as f64);
            newton.equations.set_conditions(Conditions::at(time))?;
            let step = AlphaStep::new(method, length, start.clone());
            newton.equations.set_rule(Box::new(step.clone()));
            newton.linear.assemble(&mut newton.equations, end)?;
            if !newton.linear.factor_all(&newton.equations)? {
                return Ok(None);
            }
            let step = StepVariation::new(&step, &end.motions);
            let (equations, linear) = (&newton.equations, &newton.linear);
            if !variations.propagate(equations, linear, &step, &self.scales)? {
                return Ok(None);
            }
        }
        Ok(Some(variations.scaled(&self.scales)))
    }

    /// Largest increment of motions and velocities.
    pub fn norm(&self, entries: &[f64]) -> f64 {
        let nodes = 24 * self.marcher.newton.equations.system().nodes();
        entries[..nodes]
            .chunks_exact(24)
            .flat_map(|node| &node[..12])
            .fold(0.0, |m: f64, x| m.max(x.abs()))
    }

    /// `∂(end − start)/∂start`, from the derivative of the end, at the miss of the motions:
    /// increments of the end are taken to those of the logarithm of the motion from the start.
    pub fn tangent(&self, orbit: &Orbit, monodromy: &Mat<f64>) -> Mat<f64> {
        let size = self.scales.size();
        let mut tangent = Mat::zeros(size, size);
        let step = AlphaStep::new(self.marcher.method, 1.0, orbit.starts[0].clone());
        let ends = StepVariation::new(&step, &orbit.end.state.motions);
        for j in 0..size {
            let mut column = self.scales.unpack(monodromy.col_as_slice(j));
            ends.subtract(&self.unit(j), &mut column);
            self.scales.pack(&column, tangent.col_as_slice_mut(j));
        }
        tangent
    }

    /// Floquet multipliers, the largest first: as many as the system has states. Those of the
    /// scheme itself, which are of the order of `ρ∞` to the number of steps, are left out.
    pub fn multipliers(&self, monodromy: &Mat<f64>) -> Vec<[f64; 2]> {
        let system = self.marcher.newton.equations.system();
        let independent = system.constraint_count() - system.redundant_constraints();
        let freedoms = (6 * system.nodes()).saturating_sub(independent);
        let count = 2 * freedoms + self.scales.states().count();
        let Some((values, _)) = eigenvectors(monodromy) else {
            return Vec::new();
        };
        let mut values: Vec<Complex<f64>> =
            values.iter().map(|z| Complex::new(z.re, z.im)).collect();
        // Of a pair, that with the positive imaginary part first.
        values.sort_by(|a, b| b.norm().total_cmp(&a.norm()).then(b.im.total_cmp(&a.im)));
        values.truncate(count);
        values.iter().map(|z| [z.re, z.im]).collect()
    }
}
