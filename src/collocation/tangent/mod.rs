//! The equations linearised at one state (docs/theory.md, section 5.3): tangents of the elements at
//! each grid point, filled by one loop. From them come the assembled Jacobian, for any rule in time
//! and for modulated increments, its products and those of its transpose, and means over time.
//!
//! Stress resultants `f` of beams may be kept apart: with their increments as unknowns of their
//! own, the Jacobian is the Schur complement of
//!
//! ```text
//! [A Bᵀ; L −1]
//! ```
//!
//! where `Bᵀ` takes resultants to forces and `L` motions to resultants.

mod assembly;
mod evaluation;
mod layout;
mod like_blades;
mod like_blades_pattern;
mod product;
#[cfg(test)]
mod tangent_test;
mod transposed;

pub use super::coupling::Coupling;
pub use assembly::Linearisation;
pub use layout::Station;
pub use like_blades_pattern::LikeBladesPattern;
pub use product::Increment;

use super::division::Share;
use super::instants::Instants;
use super::like_blades::AlikeMotions;
use super::problem::Collocation;
use super::rule::{RuleWorkspace, TimeRule};
use super::state::GridState;
use crate::elements::{Contribution, StrainTangent, StressLaw};
use crate::error::Result;
use crate::motion::{self, DualVector};
use crate::numbers::Numbers;
use crate::system::{Layout, System, Workspace};
use crate::workers::{Workers, parts};
use layout::TangentLayout;
use nalgebra::{Matrix6, Vector6};
use std::ops::Range;

/// `∂force/∂u`, `∂force/∂V` and `∂force/∂V̇` of one coupling at one grid point, without the part of
/// stress resultants that are kept apart.
#[derive(Debug, Clone, Copy)]
pub struct PairTangent<'a> {
    /// `K`.
    pub stiffness: &'a Matrix6<f64>,
    /// `C`.
    pub damping: &'a Matrix6<f64>,
    /// `M`.
    pub mass: &'a Matrix6<f64>,
}

impl PairTangent<'_> {
    /// `K Δu + C Δv + M Δv̇`.
    #[inline(always)]
    pub(super) fn force(&self, moving: bool, u: &[f64], rates: &[Vector6<f64>; 2]) -> Vector6<f64> {
        let mut sum = motion::product(self.stiffness, &Vector6::from_column_slice(u));
        if moving {
            sum += motion::product(self.damping, &rates[0]) + motion::product(self.mass, &rates[1]);
        }
        sum
    }
}

/// Tangents of an element's own unknowns, at one grid point after the other.
#[derive(Debug, Clone, Default)]
struct OwnTangent {
    /// `∂constraint/∂u`, column by column.
    gradients: Vec<f64>,
    /// `(∂force/∂λ)ᵀ`, likewise, of elements with feedback.
    effects: Vec<f64>,
    /// `∂constraint/∂V`, likewise.
    gradient_rates: Vec<f64>,
    /// `∂constraint/∂λ` and then `∂constraint/∂λ̇`, of internal states only.
    own: Vec<f64>,
}

impl OwnTangent {
    /// Appends those at the next grid point; if internal states are held, of their rates alone.
    fn push(&mut self, out: &Contribution, has_states: bool, held: bool) {
        let append = |list: &mut Vec<f64>, values: &[f64]| match held {
            true => list.resize(list.len() + values.len(), 0.0),
            false => list.extend_from_slice(values),
        };
        append(&mut self.gradients, out.gradient.as_slice());
        append(&mut self.effects, out.effect.as_slice());
        append(&mut self.gradient_rates, out.gradient_rate.as_slice());
        if has_states {
            append(&mut self.own, out.own.as_slice());
            self.own.extend_from_slice(out.own_rate.as_slice());
        }
    }
}

/// The equations linearised at one state.
#[derive(Debug)]
pub struct Tangent {
    layout: TangentLayout,
    unknowns: Layout,
    points: usize,
    /// Grid points, from the first on, at which each element is evaluated; all if empty.
    wanted: Vec<usize>,
    /// Whether all grid points are the same.
    is_constant: bool,
    /// `K`, `C` and `M` of one coupling after the other, at one grid point after the other.
    pairs: [Numbers<Matrix6<f64>>; 3],
    /// Of each element.
    own: Vec<OwnTangent>,
    /// One strain tangent after the other, likewise.
    strains: Vec<StrainTangent>,
    /// Stress resultants of one station after the other, likewise, that act on the nodes in a
    /// product.
    stresses: Vec<DualVector>,
    /// Size of the resultants' unknowns.
    resultant_scale: f64,
    increment: Increment,
    /// Of products: velocities and accelerations at the state, as equations may be evaluated
    /// elsewhere meanwhile.
    rule: Option<Box<dyn TimeRule>>,
    keeps_rule: bool,
    evaluation: Vec<Workspace>,
    variation: Vec<RuleWorkspace>,
    assembly: Vec<assembly::Scratch>,
}

/// What belongs to the columns of a share's nodes.
struct Part<'a> {
    pairs: [&'a mut [Matrix6<f64>]; 3],
    /// Forces on the nodes.
    forces: &'a mut [f64],
    /// Of each element that has its own here.
    own: Vec<Option<OwnPart<'a>>>,
}

/// What belongs to an element's own unknowns: strain tangents, tangents, and what the element asks
/// of them.
type OwnPart<'a> = ((&'a mut [StrainTangent], &'a mut OwnTangent), &'a mut [f64]);

/// What elements are linearised at.
struct Evaluation<'a> {
    instants: &'a Instants,
    rule: &'a dyn TimeRule,
    workers: &'a Workers,
    state: &'a GridState,
    wanted: &'a [usize],
    /// Of one blade of several: how the rest moves.
    alike: Option<&'a AlikeMotions>,
    is_constant: bool,
}

impl Tangent {
    /// For a system on a grid of so many points.
    pub fn new(system: &System, points: usize) -> Self {
        let layout = TangentLayout::new(system, false, &|_| points);
        Self::with(layout, system.layout(points), &Workers::default())
    }

    /// The same with each element at so many grid points only, from the first on.
    pub fn at_points(system: &System, points: usize, wanted: Vec<usize>) -> Self {
        Tangent {
            wanted,
            ..Self::new(system, points)
        }
    }

    /// The same with stress resultants apart.
    pub fn with_resultants_apart(system: &System, points: usize) -> Self {
        Self::apart(system, points, &|_| points, &Workers::default())
    }

    /// The same of equations, of which part of the period may tell what acts between some nodes.
    pub fn of_iteration(equations: &Collocation) -> Self {
        let points = equations.grid().points();
        let told = |nodes: &[usize]| equations.told(nodes).0;
        Self::apart(equations.system(), points, &told, equations.workers())
    }

    fn apart(
        system: &System,
        points: usize,
        told: &dyn Fn(&[usize]) -> usize,
        workers: &Workers,
    ) -> Self {
        let layout = TangentLayout::new(system, true, told);
        Tangent {
            keeps_rule: true,
            ..Self::with(layout, system.layout(points), workers)
        }
    }

    fn with(layout: TangentLayout, unknowns: Layout, workers: &Workers) -> Self {
        let points = unknowns.points();
        Tangent {
            unknowns,
            points,
            wanted: Vec::new(),
            is_constant: false,
            pairs: Default::default(),
            own: vec![OwnTangent::default(); layout.places.len()],
            strains: workers.list(layout.strain_at.total(), StrainTangent::default()),
            stresses: workers.list(layout.station_at.total(), DualVector::zeros()),
            resultant_scale: 1.0,
            increment: Increment::default(),
            rule: None,
            keeps_rule: false,
            evaluation: Vec::new(),
            variation: Vec::new(),
            assembly: Vec::new(),
            layout,
        }
    }

    /// From now on takes all grid points for the same, which are those of what does not move.
    pub(crate) fn hold_constant(&mut self) {
        self.is_constant = true;
    }

    /// The rule that velocities and accelerations of products follow.
    pub fn rule<'a>(&'a self, equations: &'a Collocation) -> &'a dyn TimeRule {
        self.rule.as_deref().unwrap_or(&*equations.rule)
    }

    /// The pairs of coupled nodes.
    pub fn couplings(&self) -> &[Coupling] {
        self.layout.couplings.all()
    }

    /// Those in the rows of a node, by number.
    pub fn couplings_of_row(&self, node: usize) -> &[usize] {
        self.layout.couplings.of_row(node)
    }

    /// Tangents of the coupling `pair` at grid point `k`, not scaled.
    #[inline(always)]
    pub fn pair(&self, pair: usize, k: usize) -> PairTangent<'_> {
        let at = self.layout.coupling_at.of(pair).start + k;
        let [stiffness, damping, mass] = self.pairs.each_ref().map(|list| &list[at]);
        PairTangent {
            stiffness,
            damping,
            mass,
        }
    }

    /// `∂force/∂u` and `∂force/∂V` of the coupling `pair` at grid point `k`, stress resultants
    /// included, not scaled.
    pub fn whole_pair(&self, pair: usize, k: usize) -> [Matrix6<f64>; 2] {
        let held = self.pair(pair, k);
        let mut sums = [*held.stiffness, *held.damping];
        for &(station, row, column) in &self.layout.within[pair] {
            let station = &self.layout.stations[station];
            let mut stresses = [Matrix6::zeros(); 2];
            let mut add = |place: usize, stiffness: &Matrix6<f64>, damping: &Matrix6<f64>| {
                let column = self.strain(place, k);
                column.strain.add_product_to(stiffness, &mut stresses[0]);
                if station.damped {
                    column.rate.add_product_to(damping, &mut stresses[0]);
                    column.strain.add_product_to(damping, &mut stresses[1]);
                }
            };
            let StressLaw {
                stiffness,
                damping,
                others,
            } = &station.law;
            add(column, stiffness, damping);
            for other in others {
                let place = station.first_of(other.offset) + column - station.first;
                add(place, &other.stiffness, &other.damping);
            }
            let row = self.strain(row, k);
            let count = if station.damped { 2 } else { 1 };
            for (sum, stress) in sums.iter_mut().zip(&stresses).take(count) {
                let mut product = Matrix6::zeros();
                let stress = motion::transpose(stress);
                row.strain.add_product_to(&stress, &mut product);
                *sum += motion::transpose(&product);
            }
        }
        sums
    }

    /// Stations whose stress resultants are apart, six each.
    pub fn stations(&self) -> &[Station] {
        &self.layout.stations
    }

    /// Strain tangent `index` of those of all stations at grid point `k`.
    #[inline(always)]
    pub fn strain(&self, index: usize, k: usize) -> &StrainTangent {
        &self.strains[self.layout.strain_at.of(index).start + k]
    }

    /// Number of stress resultants over the grid: unknowns in the order of stations, then of grid
    /// points.
    pub fn resultants(&self) -> usize {
        6 * self.layout.station_at.total()
    }

    /// Where the stress resultants of a station are among those.
    pub fn resultants_of(&self, station: usize) -> Range<usize> {
        let at = self.layout.station_at.of(station);
        6 * at.start..6 * at.end
    }

    /// Forces and moments that count as 1 in the unknowns of stress resultants, the moments' for
    /// arms of the characteristic length.
    pub fn resultant_scales(&self, system: &System) -> Vector6<f64> {
        let (force, moment) = (
            self.resultant_scale,
            self.resultant_scale * system.scales().length,
        );
        Vector6::new(force, force, force, moment, moment, moment)
    }

    /// Size of the resultants' unknowns.
    pub fn resultant_scale(&self) -> f64 {
        self.resultant_scale
    }

    /// Sets the size of the resultants' unknowns.
    pub fn set_resultant_scale(&mut self, scale: f64) {
        self.resultant_scale = scale;
    }

    /// `∂constraint/∂u` of element `index` at grid point `k`, column by column, not scaled.
    pub fn gradient(&self, system: &System, index: usize, k: usize) -> &[f64] {
        at_point(&self.own[index].gradients, system, index, k)
    }

    /// `(∂force/∂λ)ᵀ` of element `index` at grid point `k`, likewise.
    pub fn effect(&self, system: &System, index: usize, k: usize) -> &[f64] {
        let own = &self.own[index];
        match system.elements()[index].has_feedback {
            true => at_point(&own.effects, system, index, k),
            false => at_point(&own.gradients, system, index, k),
        }
    }

    /// `∂constraint/∂V` of element `index`, which has feedback, at grid point `k`, likewise.
    pub fn gradient_rate(&self, system: &System, index: usize, k: usize) -> &[f64] {
        at_point(&self.own[index].gradient_rates, system, index, k)
    }

    /// `∂constraint/∂λ` and `∂constraint/∂λ̇` of element `index`, which has internal states, at
    /// grid point `k`, column by column, not scaled.
    pub fn own(&self, system: &System, index: usize, k: usize) -> (&[f64], &[f64]) {
        let count = system.elements()[index].element.own_unknowns();
        self.own[index].own[2 * count * count * k..][..2 * count * count].split_at(count * count)
    }

    /// Bytes that the tangents take.
    pub fn bytes(&self) -> usize {
        let own = self
            .own
            .iter()
            .map(|own| own.gradients.len() + 2 * own.effects.len() + own.own.len());
        3 * size_of_val(&self.pairs[0][..])
            + size_of_val(&self.strains[..])
            + size_of_val(&self.stresses[..])
            + own.sum::<usize>() * size_of::<f64>()
            + self.increment.bytes()
    }

    /// Evaluates the elements at `state`; `equations` keep what is left of them there. Where stress
    /// resultants are not apart, they keep their velocities and accelerations at this state until
    /// the last use of these tangents.
    pub fn evaluate(&mut self, equations: &mut Collocation, state: &GridState) -> Result<()> {
        let total = self.layout.coupling_at.total();
        for list in self.pairs.iter_mut().filter(|list| list.len() != total) {
            *list = Numbers::room("tangents", total)?;
            for &coupling in &self.layout.bare {
                list[self.layout.coupling_at.of(coupling)].fill(Matrix6::zeros());
            }
        }
        equations.update_kinematics(state);
        // Not two of them at a time.
        self.rule = None;
        self.rule = self.keeps_rule.then(|| equations.rule.clone());
        let mut residual = std::mem::take(&mut equations.linearised_residual);
        residual.resize(equations.size(), 0.0);
        let (system, division) = (equations.system(), &equations.division);
        let (layout, points) = (&self.layout, self.points);
        let counts = layout.places.iter();
        let counts = counts.map(|p| layout.strain_at.of_all(p.strains.clone()).len());
        let (forces, asked) = residual.split_at_mut(self.unknowns.motions().end);
        let forces = division.split(forces, self.unknowns.of_node());
        let elements = system.elements().iter();
        let asked = parts(asked, elements.map(|p| points * p.element.own_unknowns()));
        let strains = parts(&mut self.strains, counts);
        let own = division.deal(strains.zip(&mut self.own).zip(asked));
        let [stiffness, damping, mass] = self.pairs.each_mut().map(|list| {
            let columns = |share: &Share| layout.couplings.of_columns(share.nodes.clone());
            let count = |share: &Share| layout.coupling_at.of_all(columns(share)).len();
            division.split_by(list, count).into_iter()
        });
        let lists = stiffness.zip(damping).zip(mass).zip(forces).zip(own);
        let mut all: Vec<_> = lists
            .map(|((((stiffness, damping), mass), forces), own)| Part {
                pairs: [stiffness, damping, mass],
                forces,
                own,
            })
            .collect();
        let at = Evaluation {
            instants: &equations.instants,
            rule: &*equations.rule,
            workers: &division.workers,
            state,
            wanted: &self.wanted,
            alike: equations.alike(),
            is_constant: self.is_constant,
        };
        division.workers.try_for_each(
            &mut all,
            &mut self.evaluation,
            || match layout.stations.is_empty() {
                true => system.workspace(true),
                false => system.workspace_with_resultants_apart(),
            },
            |workspace, i, part| layout.evaluate(&at, &division.shares[i], workspace, part),
        )?;
        equations.linearised_residual = residual;
        self.ground(equations);
        Ok(())
    }

    /// Adds the stiffness of the nodes against the ground.
    fn ground(&mut self, equations: &Collocation) {
        if equations.grounding() == 0.0 {
            return;
        }
        for node in 0..equations.system().nodes() {
            let at = self.unknowns.motion(node, 0);
            let rows = &equations.row_scale()[at.clone()];
            let scales = rows.iter().zip(&equations.column_scale()[at]);
            let added = scales.map(|(row, column)| equations.grounding() / (row * column));
            let added = Matrix6::from_diagonal(&Vector6::from_iterator(added));
            let pair = self.layout.couplings.number(node, node);
            let blocks = &mut self.pairs[0][self.layout.coupling_at.of(pair)];
            blocks.iter_mut().for_each(|block| *block += added);
        }
    }
}

/// What belongs to grid point `k` of a list of matrices `m × 6 n`.
fn at_point<'a>(list: &'a [f64], system: &System, index: usize, k: usize) -> &'a [f64] {
    let element = &system.elements()[index].element;
    let length = 6 * element.nodes().len() * element.own_unknowns();
    &list[length * k..][..length]
}
