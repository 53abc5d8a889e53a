//! Motions by harmonics above those of the grid: waves about single grid points of a solution,
//! during which the mechanism hardly moves otherwise.

use crate::collocation::{Collocation, Defect, GridState, Wave};
use crate::error::Result;
use crate::fourier::TimeGrid;
use crate::solve::newton::Newton;
use crate::solve::periodic::loads::Loads;
use std::f64::consts::TAU;

/// Harmonics of the loads that are looked at one by one.
const HARMONICS: usize = 6;
/// What is lightly damped may answer that much more to a harmonic than to one below its natural
/// frequencies.
const RESONANCE: f64 = 1e3;
/// A harmonic answered by so many times what is expected is near a natural frequency.
const RESOUNDS: f64 = 3.0;
/// Natural frequencies vary over the period: on the whole, harmonics may come so many times nearer
/// to them than at one point.
const MISTUNED: f64 = 30.0;
/// What may add less than this part of the error is not looked at.
const SLIGHT: f64 = 0.2;

/// What is left out of the equations on a grid, as motions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct LeftOut {
    /// Largest of the motions.
    pub error: f64,
    /// The harmonic further up that is so near a natural frequency that a finer grid alone can tell
    /// what it adds.
    pub resounding: Option<usize>,
}

impl LeftOut {
    /// As much as what the grid has taken for its own harmonics.
    pub fn like(aliased: f64) -> Self {
        LeftOut {
            error: aliased,
            resounding: None,
        }
    }
}

/// Equations of a wave about a grid point.
pub(crate) struct Waves<'a> {
    /// On two points, cosine and sine.
    newton: Newton,
    grid: TimeGrid,
    state: &'a GridState,
}

impl<'a> Waves<'a> {
    /// About grid points of a solution `state` of these equations.
    pub fn new(equations: &Collocation, state: &'a GridState) -> Result<Self> {
        let grid = TimeGrid::even_or_odd(2, equations.grid().period())?;
        let mut wave = Collocation::new(equations.system().clone(), grid)?;
        wave.set_rule(Box::new(Wave::new(grid.frequency())));
        wave.set_workers(equations.workers().alone());
        if equations.is_regularised() {
            wave.regularise();
        }
        let mut newton = Newton::new(wave);
        newton.linear.tangent.hold_constant();
        Ok(Waves {
            newton,
            grid: equations.grid(),
            state,
        })
    }

    /// The state at grid point `k`, of cosine and sine.
    fn frozen(&self, k: usize) -> GridState {
        let equations = &self.newton.equations;
        let mut at = GridState::reference(equations.system(), equations.grid());
        for point in 0..2 {
            at.copy_point(equations.system(), point, self.state, k);
        }
        at
    }

    /// Linearises the equations of a wave of this harmonic about grid point `k`. `false` if they
    /// are singular.
    fn freeze(&mut self, harmonic: usize, k: usize) -> Result<bool> {
        let at = self.frozen(k);
        let equations = &mut self.newton.equations;
        let system = equations.system().clone();
        let stretch = system.period() / self.grid.period();
        let time = self.grid.time(k) * stretch;
        // As fast as it is there in time.
        let pseudo = k as f64 / self.grid.points() as f64;
        let rate = harmonic as f64 * self.grid.slope(pseudo).rate;
        equations.set_rule(Box::new(Wave::new(rate * TAU / system.period())));
        equations.set_times(&[time; 2])?;
        self.newton.linearise(&at)
    }

    /// Motions by what is left out of the equations after grid point `k`, as a wave of this
    /// harmonic; none where that is singular.
    fn response(&mut self, defect: &Defect, harmonic: usize, k: usize) -> Result<Option<f64>> {
        if !self.freeze(harmonic, k)? {
            return Ok(None);
        }
        let mut rows = defect.left_out(&self.newton.equations, k);
        self.newton.response_of_wave(&mut rows)
    }

    /// Motions by what is left out of the equations of the elements after grid point `k`, as a wave
    /// about the point looked at last.
    fn response_of_own(&mut self, defect: &Defect, k: usize) -> Result<Option<f64>> {
        let mut rows = defect.left_out(&self.newton.equations, k);
        rows[self.newton.equations.layout().motions()].fill(0.0);
        self.newton.response_of_wave(&mut rows)
    }

    /// Motions by what is left out of the equations, as a wave next above the harmonics of the
    /// grid, at the worst points; and, where the error would otherwise be accepted, what harmonics
    /// further up add, as one of them may resound.
    ///
    /// `aliased` is the error by what the grid has taken for its own harmonics.
    pub fn left_out(
        &mut self,
        defect: &Defect,
        aliased: f64,
        accepted: f64,
    ) -> Result<Option<LeftOut>> {
        let points = self.state.points();
        let first = points / 2 + 1;
        let [force, own] = defect.worst(&self.newton.equations);
        let Some(mut most) = self.response(defect, first, force)? else {
            return Ok(None);
        };
        // Turned into motions by the equations at the other point, too rough to add, but telling
        // whether it may count.
        if own != force
            && self
                .response_of_own(defect, own)?
                .is_none_or(|x| x > SLIGHT * most)
        {
            let Some(response) = self.response(defect, first, own)? else {
                return Ok(None);
            };
            most = most.max(response);
        }
        let mut left = LeftOut {
            error: most,
            resounding: None,
        };
        if aliased + most > accepted {
            return Ok(Some(left));
        }
        let amplitudes = defect.high_harmonics(&self.newton.equations);
        let largest = amplitudes.iter().fold(0.0f64, |largest, x| largest.max(*x));
        let counts = SLIGHT * (aliased + most);
        let mut strongest = 0.0;
        for (harmonic, amplitude) in (first..points).zip(amplitudes).skip(1) {
            let part = amplitude / largest;
            // Written so that what is no number is not looked at.
            let may_count = RESONANCE * part * most > counts;
            if !may_count {
                continue;
            }
            let Some(response) = self.response(defect, harmonic, force)? else {
                continue;
            };
            if response < RESOUNDS * most {
                continue;
            }
            left.error += part * response;
            if MISTUNED * part * response > counts && part * response > strongest {
                strongest = part * response;
                left.resounding = Some(harmonic);
            }
        }
        Ok(Some(left))
    }

    /// Motions by the harmonics of the loads that the grid cannot hold, where most is left of the
    /// equations.
    pub fn unheld(&mut self, defect: &Defect, loads: &Loads) -> Result<Option<f64>> {
        let (harmonics, part) = loads.strongest((self.state.points() - 1) / 2, HARMONICS);
        let [k, _] = defect.worst(&self.newton.equations);
        let at = self.frozen(k);
        let mut sum = 0.0;
        for harmonic in harmonics {
            if !self.freeze(harmonic, k)? {
                return Ok(None);
            }
            let equations = &mut self.newton.equations;
            let count = equations.system().signals();
            let mut moving = equations.signals().to_vec();
            let (cosines, sines) = moving.split_at_mut(count);
            loads.add_wave(harmonic, cosines, sines);
            let size = equations.size();
            let (mut rest, mut rows) = (vec![0.0; size], vec![0.0; size]);
            equations.residual(&at, &mut rest)?;
            equations.set_signals(&moving);
            equations.residual(&at, &mut rows)?;
            rows.iter_mut().zip(&rest).for_each(|(x, rest)| *x -= rest);
            let Some(response) = self.newton.response_of_wave(&mut rows)? else {
                return Ok(None);
            };
            sum += response;
        }
        Ok(Some(sum / part))
    }
}
