//! The equations of a periodic motion below the solve, for solvers of others: residual,
//! linearisation, products, preconditioner, steps on the manifold of motions. Divided among ranks,
//! each of which has the equations and unknowns of its nodes; see `collocation/partition.rs`.

mod products;
mod state;
#[cfg(test)]
mod tests;

use super::linear::iterative::{Preconditioner, Spread, SpreadFactors, numbers_of, suitable};
use crate::collocation::{Collocation, GridState, Halo, Item, Partition, RankPart, Tangent};
use crate::error::{Error, ErrorKind, Result, require_finite};
use crate::fourier::TimeGrid;
use crate::model::Model;
use crate::ranks::Ranks;
use crate::system::{System, require_periodic_forces};
use crate::workers::Workers;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::ops::Range;
use std::sync::Arc;

/// Numbers of a motion: position, then rotation matrix column by column.
pub const MOTION: usize = 12;
/// Size of the unknowns of stress resultants relative to the others, as in serial solves.
const RESULTANT_SHARE: f64 = 0.03;

/// How equations are made.
#[derive(Debug, Clone)]
pub struct RankOptions {
    /// The ranks.
    pub ranks: Arc<dyn Ranks>,
    /// Rank of each node; none for runs of nodes with about the same work.
    pub owners: Option<Vec<usize>>,
    /// The preconditioner; none for one that suits the start, see
    /// [`RankEquations::preconditioner`].
    pub preconditioner: Option<Preconditioner>,
    /// Threads of each rank, 0 for as many as there are processors.
    pub threads: usize,
    /// Where to start, at the points of the grid; none for the reference configuration.
    pub start: Option<GridState>,
}

/// The equations of a periodic motion, of one rank.
///
/// Vectors hold what belongs to the rank, scaled: of each of its nodes the six components of the
/// increment at one grid point after the other, then of each element whose first node is the rank's
/// the own unknowns likewise, then, with a preconditioner that has stress resultants as unknowns of
/// their own, those.
#[derive(Debug)]
pub struct RankEquations {
    ranks: Arc<dyn Ranks>,
    model: Model,
    whole: Arc<System>,
    partition: Partition,
    part: RankPart,
    equations: Collocation,
    tangent: Tangent,
    /// Now, and where the equations were linearised last.
    state: GridState,
    base: GridState,
    is_linear: bool,
    /// Tracked coordinates of the whole at the start.
    coordinates: Vec<f64>,
    halo: Halo,
    /// Places of what belongs to the rank in vectors of its part.
    owned: Vec<Range<usize>>,
    size: usize,
    preconditioner: Preconditioner,
    factors: Option<SpreadFactors>,
    /// Vectors of the part.
    x: Vec<f64>,
    y: Vec<f64>,
}

impl std::fmt::Debug for SpreadFactors {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} bytes", self.bytes())
    }
}

/// Places of an item in vectors of a part, with stress resultants behind.
fn places(
    part: &RankPart,
    equations: &Collocation,
    resultants: bool,
    item: Item,
) -> Vec<Range<usize>> {
    let (layout, points) = (equations.layout(), equations.grid().points());
    match item {
        Item::Node(node) => vec![layout.node(part.nodes.partition_point(|n| *n < node))],
        Item::Element(index) => {
            let local = part.elements.partition_point(|e| *e < index);
            let placed = &part.system.elements()[local];
            let mut ranges = vec![layout.element(placed)];
            if resultants {
                let at = |station: usize| equations.size() + 6 * points * station;
                ranges.push(at(placed.stations.start)..at(placed.stations.end));
            }
            ranges
        }
    }
}

/// What ranks have to agree on: a number that differs, most likely, where any of it does.
fn fingerprint(model: &Model, period: f64, points: usize, options: &RankOptions) -> Result<u64> {
    let saved = rmp_serde::to_vec(model);
    let saved = saved.map_err(|e| Error::new(ErrorKind::Value, format!("model: {e}")))?;
    let mut hasher = DefaultHasher::new();
    saved.hash(&mut hasher);
    (period.to_bits(), points, &options.owners).hash(&mut hasher);
    options.preconditioner.map(|p| p.name()).hash(&mut hasher);
    if let Some(start) = &options.start {
        for motion in &start.motions {
            numbers_of(motion).map(f64::to_bits).hash(&mut hasher);
        }
    }
    Ok(hasher.finish())
}

impl RankEquations {
    /// Those of `model` on a grid. By all ranks.
    ///
    /// # Errors
    /// If model, period, grid or options are not valid, or not the same on all ranks; if numbers
    /// cannot be told. All ranks get the same error.
    pub fn new(model: &Model, period: f64, points: usize, options: RankOptions) -> Result<Self> {
        let ranks = options.ranks.clone();
        let prepared = fingerprint(model, period, points, &options);
        ranks.require_same(
            ranks.agreed(prepared)?,
            "model, period, grid, partition and start",
        )?;
        let made = Self::made(model, period, points, &options);
        let mut made = ranks.agreed(made)?;
        let at_start = made.linearise_tangent();
        ranks.agreed(at_start)?;
        if options.preconditioner.is_none() {
            made.preconditioner = suitable(made.spread())?;
        }
        made.lay_out();
        Ok(made)
    }

    fn made(model: &Model, period: f64, points: usize, options: &RankOptions) -> Result<Self> {
        let grid = TimeGrid::new(points, period)?;
        let whole = Arc::new(System::new(model, period)?);
        require_periodic_forces(model, whole.scales().length, period)?;
        let (rank, count) = (options.ranks.rank(), options.ranks.count());
        let partition = match &options.owners {
            Some(owners) => Partition::given(&whole, count, owners.clone())?,
            None => Partition::even(&whole, count)?,
        };
        let part = partition.part(&whole, rank);
        let mut equations = Collocation::new(part.system.clone(), grid)?;
        equations.set_workers(Workers::new(options.threads)?);
        if !whole.dependencies().is_empty() {
            equations.regularise();
        }
        let reference = || GridState::reference(&whole, grid);
        let start = options.start.clone().unwrap_or_else(reference);
        if start.points() != points || start.motions.len() != whole.nodes() * points {
            return Err(Error::size(
                "start",
                whole.nodes() * points,
                start.motions.len(),
            ));
        }
        let mut state = GridState::at_points(&part.system, points);
        for (local, &node) in part.nodes.iter().enumerate() {
            let motions = &mut state.motions[local * points..][..points];
            motions.copy_from_slice(start.node(node));
        }
        for (local, &index) in part.elements.iter().enumerate() {
            let over = part.system.elements()[local].own_over(points);
            let from = whole.elements()[index].own_over(points);
            state.multipliers[over].copy_from_slice(&start.multipliers[from]);
        }
        state.coordinates.clone_from(&start.coordinates);
        let halo = partition.halo(&whole, rank, |_| Vec::new());
        Ok(RankEquations {
            ranks: options.ranks.clone(),
            model: model.clone(),
            tangent: Tangent::with_resultants_apart(&part.system, points),
            whole,
            partition,
            part,
            equations,
            base: state.clone(),
            state,
            is_linear: false,
            coordinates: start.coordinates,
            halo,
            owned: Vec::new(),
            size: 0,
            preconditioner: options.preconditioner.unwrap_or(Preconditioner::TimeLocal),
            factors: None,
            x: Vec::new(),
            y: Vec::new(),
        })
    }

    /// Finds places in vectors, once it is known what they hold.
    fn lay_out(&mut self) {
        let (part, equations) = (&self.part, &self.equations);
        let apart = SpreadFactors::keeps_resultants(self.preconditioner);
        let places = |item: Item| places(part, equations, apart, item);
        let items = part
            .own_nodes
            .iter()
            .map(|&local| Item::Node(part.nodes[local]));
        let elements = part
            .own_elements
            .iter()
            .map(|&local| Item::Element(part.elements[local]));
        let elements: Vec<Item> = elements.collect();
        // Motions and own unknowns before all stress resultants.
        let mut owned: Vec<Range<usize>> = items.flat_map(&places).collect();
        owned.extend(elements.iter().map(|&item| places(item)[0].clone()));
        if apart {
            owned.extend(elements.iter().map(|&item| places(item)[1].clone()));
        }
        owned.retain(|range| !range.is_empty());
        self.halo = self.partition.halo(&self.whole, self.ranks.rank(), places);
        self.size = owned.iter().map(Range::len).sum();
        self.owned = owned;
        let resultants = if apart { self.tangent.resultants() } else { 0 };
        self.x = vec![0.0; self.equations.size() + resultants];
        self.y = self.x.clone();
    }

    fn spread(&self) -> Spread<'_> {
        Spread {
            ranks: &self.ranks,
            whole: &self.whole,
            partition: &self.partition,
            part: &self.part,
            equations: &self.equations,
            tangent: &self.tangent,
            state: &self.base,
            coordinates: &self.coordinates,
        }
    }

    /// What this rank has found, if none has failed, see [`crate::ranks`]. By all ranks.
    ///
    /// # Errors
    /// If it failed on any rank.
    pub fn agreed<T>(&self, found: Result<T>) -> Result<T> {
        self.ranks.agreed(found)
    }

    /// Numbers of this rank's vectors.
    pub fn size(&self) -> usize {
        self.size
    }

    /// Numbers that it keeps copies of, which belong to other ranks.
    pub fn halo_size(&self) -> usize {
        self.halo.received().map(Range::len).sum()
    }

    /// Nodes of this rank, in the order of its vectors.
    pub fn nodes(&self) -> Vec<usize> {
        let local = self.part.own_nodes.iter();
        local.map(|&local| self.part.nodes[local]).collect()
    }

    /// Elements of this rank's own unknowns, in the order of its vectors.
    fn own_elements(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        let local = self.part.own_elements.iter();
        local.map(|&local| (local, self.part.elements[local]))
    }

    /// The preconditioner that was asked for or, where none was, that suits the start: where no
    /// joint turns, bodies averaged over time, otherwise equilibrium at each grid point.
    pub fn preconditioner(&self) -> Preconditioner {
        self.preconditioner
    }

    /// Numbers of this rank's unknowns among those of all, in the order of vectors: in the order of
    /// the layout of a solve on one rank, stress resultants behind.
    pub fn numbers(&self) -> Vec<usize> {
        let points = self.equations.grid().points();
        let layout = self.whole.layout(points);
        let mut numbers = Vec::with_capacity(self.size);
        for node in self.nodes() {
            numbers.extend(layout.node(node));
        }
        for (_, index) in self.own_elements() {
            numbers.extend(layout.element(&self.whole.elements()[index]));
        }
        if SpreadFactors::keeps_resultants(self.preconditioner) {
            for (_, index) in self.own_elements() {
                let stations = &self.whole.elements()[index].stations;
                let at = |station: usize| layout.size() + 6 * points * station;
                numbers.extend(at(stations.start)..at(stations.end));
            }
        }
        numbers
    }

    /// Numbers of all unknowns of all ranks.
    pub fn total(&self) -> usize {
        let points = self.equations.grid().points();
        let resultants = match SpreadFactors::keeps_resultants(self.preconditioner) {
            true => 6 * points * self.whole.stations(),
            false => 0,
        };
        self.whole.layout(points).size() + resultants
    }

    /// Bytes that tangents, factors and vectors take on this rank.
    pub fn bytes(&self) -> usize {
        let vectors = size_of_val(&self.x[..]) + size_of_val(&self.y[..]);
        let motions = size_of_val(&self.state.motions[..]);
        let factors = self.factors.as_ref().map_or(0, SpreadFactors::bytes);
        self.tangent.bytes() + factors + vectors + 2 * motions
    }

    fn require(&self, name: &str, x: &[f64]) -> Result<()> {
        if x.len() != self.size {
            return Err(Error::size(name, self.size, x.len()));
        }
        require_finite(name, x)
    }

    fn require_linear(&self) -> Result<()> {
        if self.is_linear {
            return Ok(());
        }
        let message = "equations: linearise them first";
        Err(Error::new(ErrorKind::NotAvailable, message))
    }

    /// Puts a vector of the rank to its places in `x`, the vector of its part.
    fn put(&mut self, x: &[f64]) {
        let mut rest = x;
        for range in &self.owned {
            let (part, next) = rest.split_at(range.len());
            self.x[range.clone()].copy_from_slice(part);
            rest = next;
        }
    }

    /// Takes the rank's vector from that of its part.
    fn take(owned: &[Range<usize>], from: &[f64], out: &mut [f64]) {
        let mut rest = out;
        for range in owned {
            let (part, next) = std::mem::take(&mut rest).split_at_mut(range.len());
            part.copy_from_slice(&from[range.clone()]);
            rest = next;
        }
    }

    /// Writes the scaled residual at the present state. By all ranks.
    ///
    /// # Errors
    /// If it cannot be evaluated on a rank: all get its error.
    pub fn residual(&mut self, out: &mut [f64]) -> Result<()> {
        let size = self.equations.size();
        self.y[size..].fill(0.0);
        let found = self
            .require_length("out", out.len())
            .and_then(|()| self.equations.residual(&self.state, &mut self.y[..size]));
        let ranks = self.ranks.clone();
        ranks.agreed(found)?;
        Self::take(&self.owned, &self.y, out);
        Ok(())
    }

    fn require_length(&self, name: &str, length: usize) -> Result<()> {
        match length == self.size {
            true => Ok(()),
            false => Err(Error::size(name, self.size, length)),
        }
    }

    fn linearise_tangent(&mut self) -> Result<()> {
        self.is_linear = false;
        self.base.clone_from(&self.state);
        self.tangent.evaluate(&mut self.equations, &self.state)?;
        self.is_linear = true;
        Ok(())
    }

    /// Linearises the equations at the present state, which steps then begin at. By all ranks.
    ///
    /// # Errors
    /// If they cannot be evaluated on a rank: all get its error.
    pub fn linearise(&mut self) -> Result<()> {
        let found = self.linearise_tangent();
        let agreed = self.ranks.agreed(found);
        self.is_linear = agreed.is_ok();
        agreed
    }

    /// Factors the preconditioner of the linearised equations, for right sides as large as `rhs`,
    /// which gives stress resultants their size. `false` if it is singular. By all ranks.
    ///
    /// # Errors
    /// If sizes do not fit, elements cannot be evaluated, or numbers cannot be told.
    pub fn factor(&mut self, rhs: &[f64]) -> Result<bool> {
        self.require_linear()?;
        let ranks = self.ranks.clone();
        ranks.agreed(self.require("right_side", rhs))?;
        self.factors = None;
        self.tangent.set_resultant_scale(1.0);
        self.equations.update_kinematics(&self.base);
        let Some(factors) = SpreadFactors::new(self.spread(), self.preconditioner)? else {
            return Ok(false);
        };
        self.factors = Some(factors);
        if !SpreadFactors::keeps_resultants(self.preconditioner) {
            return Ok(true);
        }
        let mut solved = rhs.to_vec();
        self.precondition(rhs, &mut solved)?;
        let motions = 6 * self.equations.grid().points() * self.part.own_nodes.len();
        let layout = self.equations.layout();
        let own = self
            .owned
            .iter()
            .filter(|range| (layout.motions().end..layout.size()).contains(&range.start));
        let essential = motions + own.map(Range::len).sum::<usize>();
        let (x, resultants) = solved.split_at(essential);
        let square = |x: &[f64]| x.iter().map(|x| x * x).sum::<f64>();
        let [x, resultants] = ranks.sums([square(x), square(resultants)])?;
        let scale = (resultants / x).sqrt() / RESULTANT_SHARE;
        if scale.is_finite() && scale > 0.0 {
            self.tangent.set_resultant_scale(scale);
            if let Some(factors) = &mut self.factors {
                factors.set_resultant_scale(scale);
            }
        }
        Ok(true)
    }

    /// Writes the solution of the preconditioner's equations with the right side `x`. By all ranks.
    ///
    /// # Errors
    /// If sizes do not fit, it was not factored, or numbers cannot be told.
    pub fn precondition(&mut self, x: &[f64], out: &mut [f64]) -> Result<()> {
        self.require_length("x", x.len())?;
        self.require_length("out", out.len())?;
        if self.factors.is_none() {
            let message = "equations: factor the preconditioner first";
            return Err(Error::new(ErrorKind::NotAvailable, message));
        }
        self.put(x);
        if let Some(factors) = &mut self.factors {
            factors.apply(&mut self.x, &mut self.halo)?;
        }
        Self::take(&self.owned, &self.x, out);
        Ok(())
    }
}
