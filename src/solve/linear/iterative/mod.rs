//! Iterative solution of Newton's linear equations, without forming the Jacobian: GMRES with
//! preconditioners that know what is nearly constant, in time or in the frames of the bodies. See
//! docs/theory.md, section 8.3.
//!
//! * `gmres`: the iteration itself, on any operator, in `long_vectors` and `least_squares`.
//!   `iteration` is that on the equations, `operator` theirs, between borders, too, `learnt` what
//!   long solves leave to others, `first_part` what vectors have of like blades; `projected`
//!   iterates on oversampled equations.
//! * `body_circulant`: bodies averaged over time, joints as they are. In `constraints` which of
//!   these may be averaged too, in `mean` the averages, in `chunks` which harmonics are side by
//!   side, in `projection` those of like blades, in
//!   `resultants` those of stress resultants, in `interface` the system of the joints that turn.
//! * `transposed`: the transposed equations, by the transposes of these.
//! * `time_local`: equilibrium at each grid point by itself; in `soft_motions` what that leaves out
//!   of the softest motions there.
//! * Both factor small sparse matrices with blocks where `layout` says, by `block_lu`, several side
//!   by side in `lanes`, or by `fronts` where they fill as those of meshes do.
//! * `spread`: these over ranks, each with some of the nodes; `spread_harmonics`, `spread_time`.
//! * `record`: what solves took; `trial`: what one takes, measured.

mod banded;
mod block_lu;
#[cfg(test)]
mod block_lu_test;
mod body_circulant;
mod chunks;
mod constraints;
mod dense;
mod factors;
mod first_part;
mod front_lu;
mod fronts;
mod gmres;
mod harmonic_band;
mod interface;
mod iteration;
mod lane_blocks;
mod lanes;
mod layout;
mod learnt;
mod least_squares;
mod long_vectors;
mod mean;
mod operator;
mod outer;
mod part;
mod projected;
mod projection;
mod record;
mod resultants;
mod soft_motions;
mod spread;
mod spread_factors;
mod spread_harmonics;
mod spread_joints;
mod spread_means;
#[cfg(test)]
mod spread_test;
mod spread_time;
mod time_local;
mod transform;
mod transport;
mod transposed;
mod trial;

use crate::collocation::{Collocation, GridState, Tangent};
use crate::error::Result;
use crate::solve::linear::borders::Borders;
use crate::solve::linear::dense::{largest, probe};
use crate::solve::linear::diagnosis::Singularity;
use crate::solve::linear::slender::SLENDER;
use crate::solve::linear::solver::LinearSolver;
use crate::solve::report::{Timings, timed};
use crate::work::PRODUCT;
use factors::Factors;
use first_part::FirstPart;
pub(crate) use gmres::{GmresOptions, GmresWorkspace, Preconditioned, gmres};
use interface::{Bounds, LEFT_OUT, likely_work};
use learnt::Learnt;
pub(crate) use long_vectors::Parts;
use operator::Eliminated;
pub(crate) use outer::{Outer, SHARPEST, solve_around};
pub(crate) use projected::Projected;
pub use record::{IterativeRecord, Preconditioner};
pub(crate) use spread::{Spread, motion_of, numbers_of, suitable};
pub(crate) use spread_factors::SpreadFactors;
use std::time::{Duration, Instant};
pub(crate) use trial::missing_inertia;
pub use trial::{LinearTrial, try_linear_solve};

/// Most products of a linear solve: at least, and where nothing else is left or takes longer.
pub(super) const ITERATION_LIMIT: usize = 150;
pub(super) const LARGEST_ITERATION_LIMIT: usize = 400;
/// Vectors that are kept at least, and more while they take no more bytes than this.
const RESTART: usize = 60;
const KEPT: usize = 500_000_000;
/// Part of the work that is left which a preconditioner may take, if there are others.
const SHARE: f64 = 0.25;
/// Time-local preconditioning is cheap. It is kept where it takes no more products than take as
/// long as the system of the joints, and these, and no more than those.
const FEW: usize = 12;
const MOST_LOCALLY: usize = 60;
/// Growth of a preconditioner that means a Jacobian which may be singular.
const SUSPECT: f64 = 1e13;
/// The same for each time that a beam is stiffer in tension than in bending.
const SUSPECT_SLENDER: f64 = 1e7;
/// Accuracy of a closer look at that, and what is enough where rounding allows no more.
const ROUGH: f64 = 1e-2;

/// GMRES on the Jacobian as an operator.
pub(crate) struct Iterative {
    tangent: Tangent,
    /// Of the system.
    slenderness: f64,
    /// What was asked for, if anything was.
    wanted: Option<Preconditioner>,
    /// Multiply-adds that factors of the whole Jacobian would take, if they are to be had.
    direct_work: Option<f64>,
    /// Most products of a linear solve.
    iteration_limit: usize,
    /// Whether equilibrium at each grid point has turned out to be no preconditioner.
    pub fails_locally: bool,
    /// What the system of the joints may leave out of harmonics.
    pub left_out: f64,
    /// Growth from which on the Jacobian may be singular.
    pub suspect: f64,
    /// Growth of the present Jacobian, once it was asked for.
    growth: Option<f64>,
    /// What is in use, and what is left to be tried, each with the products that a solve may take.
    candidates: Vec<(Preconditioner, usize)>,
    factors: Option<Factors>,
    /// The same of the transposed equations, once they were wanted, and which of the candidates
    /// these are of.
    transposed: Option<Factors>,
    transposed_with: usize,
    /// Whether the factors are those of an earlier Jacobian.
    is_old: bool,
    /// Whether the size of stress resultants has been found for the factors.
    is_scaled: bool,
    /// What the factors make of borders.
    eliminated: Option<Eliminated>,
    /// Products of the first solve with the factors.
    first_products: Option<usize>,
    /// Smallest error that was found by a product at the end of a solve, with these factors and
    /// this Jacobian: that of rounding is no larger.
    verified: f64,
    /// Products that a solve may take.
    limit: usize,
    workspace: GmresWorkspace,
    /// What a long solve with the factors has found.
    learnt: Option<Learnt>,
    /// What vectors have of one blade of several.
    first_part: Option<FirstPart>,
    pub record: IterativeRecord,
}

impl Iterative {
    /// For `equations`, with this preconditioner or, if none is named, with what suits them.
    pub fn new(equations: &Collocation, wanted: Option<Preconditioner>) -> Self {
        let slenderness = equations.system().slenderness();
        Iterative {
            slenderness,
            tangent: Tangent::of_iteration(equations),
            wanted,
            direct_work: None,
            iteration_limit: LARGEST_ITERATION_LIMIT,
            fails_locally: false,
            left_out: LEFT_OUT,
            suspect: SUSPECT.max(SUSPECT_SLENDER * slenderness),
            growth: None,
            candidates: Vec::new(),
            factors: None,
            transposed: None,
            transposed_with: 0,
            is_old: false,
            is_scaled: false,
            eliminated: None,
            first_products: None,
            verified: f64::INFINITY,
            limit: ITERATION_LIMIT,
            workspace: GmresWorkspace::default(),
            learnt: None,
            first_part: FirstPart::of(equations),
            record: IterativeRecord::default(),
        }
    }

    /// Gives up for factors of the whole Jacobian, which take so many multiply-adds, where a dense
    /// system would take more, or a solve more than so many products.
    pub fn or_directly(mut self, work: f64, limit: usize) -> Self {
        self.direct_work = Some(work);
        self.iteration_limit = limit;
        self
    }

    /// Factors the first candidate that can be.
    fn prepare(&mut self, equations: &Collocation, timings: &mut Timings) -> Result<bool> {
        let began = Instant::now();
        let prepared = self.prepare_first(equations);
        let interface = match &self.factors {
            Some(Factors::Body(factors)) => factors.interface_time,
            _ => Duration::ZERO,
        };
        timings.interface += interface;
        timings.preconditioner += began.elapsed().saturating_sub(interface);
        prepared
    }

    fn prepare_first(&mut self, equations: &Collocation) -> Result<bool> {
        // The memory of the old ones first.
        self.factors = None;
        (self.transposed, self.transposed_with) = (None, 0);
        (self.first_products, self.learnt) = (None, None);
        self.verified = f64::INFINITY;
        self.is_scaled = false;
        self.eliminated = None;
        self.growth = None;
        self.tangent.set_resultant_scale(1.0);
        while let Some(&(preconditioner, limit)) = self.candidates.first() {
            equations.workers().pulse()?;
            // What takes much of the work that is left is put off while there is something else.
            let is_last = self.candidates.len() == 1;
            let affordable = match is_last {
                true => f64::INFINITY,
                false => SHARE * equations.workers().work().left(),
            };
            let bounds = Bounds {
                most_work: self.direct_work.unwrap_or(f64::INFINITY).min(affordable),
                any_band: is_last,
                left_out: self.left_out,
            };
            self.factors = Factors::new(equations, &self.tangent, preconditioner, (bounds, false))?;
            if let Some(Factors::Body(factors)) = &self.factors {
                self.left_out = factors.left_out().unwrap_or(self.left_out);
            }
            if let Some(factors) = &self.factors {
                self.is_old = false;
                self.limit = limit;
                self.record.preconditioner = Some(preconditioner);
                self.record.factorisations += 1;
                self.record.interface = match factors {
                    Factors::Body(factors) => factors.interface_size(),
                    Factors::Local(_) => 0,
                };
                return Ok(true);
            }
            self.candidates.remove(0);
        }
        Ok(false)
    }

    /// What to try, in this order, and the products that each may take.
    fn choose(&self, equations: &Collocation) -> Vec<(Preconditioner, usize)> {
        use Preconditioner::{BodyCirculant, TimeLocal};
        let most = self.iteration_limit;
        if let Some(wanted) = self.wanted {
            return vec![(wanted, most)];
        }
        let body = (BodyCirculant, most);
        let local = |most| (TimeLocal, most);
        let Some(free) = constraints::count_free(equations, &self.tangent) else {
            return vec![body, local(most)];
        };
        let work = likely_work(free, equations.grid().points());
        // What takes no longer than the system of the joints is no loss.
        let numbers = equations.layout().motions().len() as f64;
        let few = ((work / (PRODUCT * numbers)) as usize).clamp(FEW, MOST_LOCALLY);
        if self.direct_work.is_some_and(|direct| direct < work) {
            return vec![local(few)];
        }
        // At last with any band of the system of the joints.
        let thorough = [body, local(most), body];
        match self.fails_locally {
            true => thorough.to_vec(),
            false => [&[local(few)], &thorough[..]].concat(),
        }
    }
}

impl Iterative {
    /// Evaluates the operator at a state; factors are those of another one then.
    fn evaluate(
        &mut self,
        equations: &mut Collocation,
        state: &GridState,
        timings: &mut Timings,
    ) -> Result<()> {
        self.release();
        timed(&mut timings.assembly, || {
            self.tangent.evaluate(equations, state)
        })?;
        self.is_old = true;
        self.verified = f64::INFINITY;
        self.growth = None;
        (self.transposed, self.transposed_with) = (None, 0);
        self.eliminated = None;
        Ok(())
    }

    fn find_growth(&mut self, equations: &mut Collocation) -> f64 {
        let Some(factors) = &mut self.factors else {
            return f64::INFINITY;
        };
        let mut probe = probe(equations.size());
        let mut product = vec![0.0; probe.len()];
        equations.average(&mut probe);
        self.tangent.apply(equations, &probe, &mut product);
        equations.average(&mut product);
        let product = largest(&product);
        let mut response = probe.clone();
        factors.apply(&mut response, equations.size());
        let growth = largest(&response) * product;
        if growth <= self.suspect {
            return growth;
        }
        // The preconditioner may be nearly singular where the Jacobian is not.
        let mut timings = Timings::default();
        let solved = self.solve(equations, &mut probe, ROUGH, &mut timings);
        // What this one is like says nothing of others.
        (self.is_scaled, self.first_products) = (false, None);
        self.verified = f64::INFINITY;
        match solved {
            Ok(true) => largest(&probe) * product,
            _ => f64::INFINITY,
        }
    }
}

impl LinearSolver for Iterative {
    fn release(&mut self) {
        self.workspace = GmresWorkspace::default();
        if let Some(first_part) = &mut self.first_part {
            first_part.release();
        }
    }

    fn linearise(
        &mut self,
        equations: &mut Collocation,
        state: &GridState,
        timings: &mut Timings,
    ) -> Result<bool> {
        self.evaluate(equations, state, timings)?;
        if let Some(factors) = &self.factors
            && !factors.are_cheap(equations.size())
        {
            return Ok(true);
        }
        if self.factors.is_none() {
            self.candidates = timed(&mut timings.preconditioner, || self.choose(equations));
        }
        self.prepare(equations, timings)
    }

    fn move_to(
        &mut self,
        equations: &mut Collocation,
        state: &GridState,
        timings: &mut Timings,
    ) -> Result<bool> {
        if self.factors.is_none() {
            return self.linearise(equations, state, timings);
        }
        self.evaluate(equations, state, timings)?;
        Ok(true)
    }

    fn solve(
        &mut self,
        equations: &mut Collocation,
        rhs: &mut [f64],
        accuracy: f64,
        timings: &mut Timings,
    ) -> Result<bool> {
        self.iterate((equations, None), rhs, accuracy, timings)
    }

    fn solve_transposed(
        &mut self,
        equations: &mut Collocation,
        rhs: &mut [f64],
        accuracy: f64,
        timings: &mut Timings,
    ) -> Result<bool> {
        self.iterate_transposed(equations, rhs, accuracy, timings)
    }

    fn tangent(&mut self) -> Option<&mut Tangent> {
        Some(&mut self.tangent)
    }

    fn solve_bordered(
        &mut self,
        equations: &mut Collocation,
        borders: &Borders,
        rhs: &mut [f64],
        accuracy: f64,
        timings: &mut Timings,
    ) -> Result<Option<bool>> {
        let solved = self.iterate((equations, Some(borders)), rhs, accuracy, timings)?;
        Ok(Some(solved))
    }

    fn growth(&mut self, equations: &mut Collocation) -> f64 {
        if let Some(growth) = self.growth {
            return growth;
        }
        let growth = self.find_growth(equations);
        self.growth = Some(growth);
        growth
    }

    fn is_resisted(&mut self, _: &mut Collocation) -> bool {
        // What was solved to some accuracy was.
        self.slenderness > SLENDER
    }

    fn explain(&mut self, _: &mut Collocation, _: &GridState) -> Singularity {
        let tried = self
            .wanted
            .map_or("any preconditioner", Preconditioner::name);
        Singularity::Unsolved(format!(
            "the linear equations could not be solved by iteration with {tried}: they are \
             singular, or nearly so, or the preconditioner is unlike them; solve them directly, \
             or with fewer grid points"
        ))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Model;
    use crate::solve::{LinearMethod, Outcome, PeriodicOptions, Solved, solve_periodic};
    use crate::test_models::small::{crank_rocker, one_blade, whirled_beam};

    fn solve(model: &Model, period: f64, points: usize, linear: LinearMethod) -> Solved {
        let options = PeriodicOptions {
            linear,
            ..PeriodicOptions::with_grid_points(points)
        };
        let solve = solve_periodic(model, period, &options, &mut |_, _| true).unwrap();
        assert_eq!(solve.report.outcome, Outcome::Converged);
        solve
    }

    /// Products that a solution to 1e-8 takes at the periodic motion; none if it cannot be had. The
    /// error is measured.
    fn products(solve: &Solved, preconditioner: Preconditioner) -> Option<usize> {
        let trial = try_linear_solve(solve, preconditioner, 1e-8).unwrap();
        // The estimate may miss by the part of the error that the small system does not show.
        assert!(
            trial.products_of_noise.is_none() || trial.error_of_noise < 1e-7,
            "{:e}",
            trial.error_of_noise
        );
        trial.products_of_noise
    }

    #[test]
    fn the_body_circulant_preconditioner_serves_all_kinds_of_systems() {
        // A rotor; mechanisms that turn at 1/260, 1/43 and 1/13 of the coupler's first bending
        // frequency.
        let kinds = [
            (one_blade(4), 20),
            (crank_rocker(2, 2, 0.5), 14),
            (crank_rocker(2, 2, 3.0), 16),
            (crank_rocker(2, 2, 10.0), 45),
        ];
        for ((model, period), most) in kinds {
            for points in [15, 31, 63] {
                let solve = solve(&model, period, points, LinearMethod::Automatic);
                let found = products(&solve, Preconditioner::BodyCirculant);
                assert!(
                    found.is_some_and(|n| n <= most),
                    "{points}: {found:?} of {most}"
                );
            }
        }
    }

    #[test]
    fn each_of_the_others_serves_its_own() {
        let (model, period) = crank_rocker(2, 2, 0.05);
        let slow = solve(&model, period, 15, LinearMethod::Automatic);
        let found = products(&slow, Preconditioner::TimeLocal);
        assert!(found.is_some_and(|n| n <= 20), "{found:?}");
        let (model, period) = whirled_beam();
        let constant = solve(&model, period, 15, LinearMethod::Automatic);
        let found = products(&constant, Preconditioner::Circulant);
        assert!(found.is_some_and(|n| n <= 16), "{found:?}");
    }

    #[test]
    fn iteration_and_factors_give_the_same_solution() {
        for (model, period) in [one_blade(2), crank_rocker(1, 2, 3.0)] {
            let direct = solve(&model, period, 15, LinearMethod::Direct);
            for preconditioner in [Preconditioner::BodyCirculant, Preconditioner::TimeLocal] {
                let method = LinearMethod::Iterative(Some(preconditioner));
                let other = solve(&model, period, 15, method);
                assert!(direct.state.distance(&other.state, 1.0) < 1e-11);
                let largest = direct
                    .state
                    .multipliers
                    .iter()
                    .fold(0.0f64, |m, x| m.max(x.abs()));
                let multipliers = direct
                    .state
                    .multipliers
                    .iter()
                    .zip(&other.state.multipliers);
                for (a, b) in multipliers {
                    assert!((a - b).abs() < 1e-8 * largest, "{a} {b} of {largest}");
                }
            }
        }
    }
}
