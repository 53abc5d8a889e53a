//! Equilibrium at each grid point by itself (`time_local`), with the grid points divided among
//! ranks: each rank evaluates the whole system at its own.

use super::spread::{Spread, motion_of, numbers_of};
use super::time_local::TimeLocal;
use crate::collocation::{Collocation, GridState, Item, RuleWorkspace, Tangent, TimeRule};
use crate::elements::NodeState;
use crate::error::Result;
use crate::fourier::TimeGrid;
use crate::motion::DualMatrix;
use crate::ranks::Transposition;
use crate::workers::Workers;
use nalgebra::Vector6;

/// Numbers of what a node does at a grid point: motion, velocity, acceleration.
const STATE: usize = 24;

/// The preconditioner, factored.
pub(crate) struct SpreadTime {
    transposition: Transposition,
    /// Places of this rank's series in its part, at the first grid point and from one to the next.
    own: Vec<(usize, usize)>,
    /// Places of all series in the system at this rank's grid points, likewise.
    all: Vec<(usize, usize)>,
    /// Of this rank's grid points; none where it has none.
    factors: Option<TimeLocal>,
    rows: Vec<f64>,
    columns: Vec<f64>,
    x: Vec<f64>,
}

impl SpreadTime {
    /// Factors the static part of the Jacobian at the state of `spread`; none if it is singular. By
    /// all ranks.
    ///
    /// # Errors
    /// If numbers cannot be told, or elements cannot be evaluated.
    pub fn new(spread: Spread) -> Result<Option<Self>> {
        let ranks = spread.ranks;
        let points = spread.equations.grid().points();
        let series: Vec<_> = (0..ranks.count())
            .map(|r| spread.series_of(r, |_| true))
            .collect();
        let rows = series.iter().map(Vec::len).collect();
        let transposition = Transposition::new(ranks, rows, points, 1);
        let columns = transposition.own_columns();
        // Grids have odd numbers of points: the last one once more.
        let count = columns.len() | 1;
        let layout = spread.whole.layout(count);
        let factors = Self::factors(&spread, &series, count)?;
        let is_missing = !columns.is_empty() && factors.is_none();
        if ranks.largest([f64::from(u8::from(is_missing))])? != [0.0] {
            return Ok(None);
        }
        let all = series
            .iter()
            .flatten()
            .map(|(item, component)| match *item {
                Item::Node(node) => (layout.motion(node, 0).start + component, 6),
                Item::Element(index) => {
                    let placed = &spread.whole.elements()[index];
                    let own = placed.element.own_unknowns();
                    (layout.element_at(placed, 0).start + component, own)
                }
            });
        let own = series[ranks.rank()]
            .iter()
            .map(|series| spread.local_place(*series));
        Ok(Some(SpreadTime {
            own: own.collect(),
            all: all.collect(),
            factors,
            rows: vec![0.0; transposition.by_rows()],
            columns: vec![0.0; transposition.by_columns()],
            x: vec![0.0; layout.size()],
            transposition,
        }))
    }

    /// Factors of the whole system at this rank's grid points; none if they are singular, or it has
    /// none.
    fn factors(
        spread: &Spread,
        series: &[Vec<(Item, usize)>],
        count: usize,
    ) -> Result<Option<TimeLocal>> {
        let (ranks, whole, equations) = (spread.ranks, spread.whole, spread.equations);
        let points = equations.grid().points();
        let at = Gathered::new(spread, series)?;
        let columns = at.columns.clone();
        let found = || -> Result<Option<TimeLocal>> {
            if columns.is_empty() {
                return Ok(None);
            }
            let global = |k: usize| (columns.start + k).min(columns.end - 1);
            let mut state = GridState::at_points(whole, count);
            let mut rule = GivenAtPoints {
                states: Vec::with_capacity(whole.nodes() * count),
                rates: vec![0.0; whole.own_unknowns() * count],
                points: count,
            };
            for node in 0..whole.nodes() {
                for k in 0..count {
                    let node_state = at.state(node, global(k) - columns.start);
                    state.motions[node * count + k] = node_state.motion;
                    rule.states.push(node_state);
                }
            }
            for (index, placed) in whole.elements().iter().enumerate() {
                for k in 0..count {
                    for row in 0..placed.element.own_unknowns() {
                        let [value, rate] = at.own(index, row, global(k) - columns.start);
                        state.multipliers[placed.own_at(count, k).start + row] = value;
                        rule.rates[(placed.first_own + row) * count + k] = rate;
                    }
                }
            }
            let tracked = whole.tracked();
            for k in 0..count {
                let from = &spread.coordinates[global(k) * tracked..][..tracked];
                state.coordinates[k * tracked..][..tracked].copy_from_slice(from);
            }
            state.track(whole);
            let grid = TimeGrid::new(count, equations.grid().period())?;
            let mut here = Collocation::new(whole.clone(), grid)?;
            here.set_workers(equations.workers().clone());
            if equations.is_regularised() {
                here.regularise();
            }
            let times = equations.times();
            let times: Vec<f64> = (0..count).map(|k| times[global(k)]).collect();
            here.set_times(&times)?;
            here.set_rule(Box::new(rule));
            let mut tangent = Tangent::new(whole, count);
            tangent.evaluate(&mut here, &state)?;
            Ok(TimeLocal::new(&here, &tangent, false))
        };
        debug_assert!(columns.end <= points);
        ranks.agreed(found())
    }

    /// Bytes that the factors take.
    pub fn bytes(&self) -> usize {
        self.factors.as_ref().map_or(0, TimeLocal::bytes)
    }

    /// `x = P⁻¹ x`. By all ranks.
    ///
    /// # Errors
    /// If numbers cannot be told.
    pub fn apply(&mut self, x: &mut [f64]) -> Result<()> {
        let columns = self.transposition.own_columns().len();
        let rows = self.own.len().max(1);
        let points = self.rows.len() / rows;
        for (&(first, stride), row) in self.own.iter().zip(self.rows.chunks_mut(points.max(1))) {
            let series = x[first..].iter().step_by(stride);
            row.iter_mut().zip(series).for_each(|(to, x)| *to = *x);
        }
        self.transposition
            .to_columns(&self.rows, &mut self.columns)?;
        if let Some(factors) = &mut self.factors {
            let count = columns | 1;
            for (&(first, stride), row) in self.all.iter().zip(self.columns.chunks(columns)) {
                for k in 0..count {
                    self.x[first + stride * k] = row[k.min(columns - 1)];
                }
            }
            factors.apply(&mut self.x);
            let rows = self.columns.chunks_mut(columns);
            for (&(first, stride), row) in self.all.iter().zip(rows) {
                for (k, value) in row.iter_mut().enumerate() {
                    *value = self.x[first + stride * k];
                }
            }
        }
        self.transposition.to_rows(&self.columns, &mut self.rows)?;
        for (&(first, stride), row) in self.own.iter().zip(self.rows.chunks(points.max(1))) {
            let series = x[first..].iter_mut().step_by(stride);
            series.zip(row).for_each(|(x, value)| *x = *value);
        }
        Ok(())
    }
}

/// What the whole system does at the grid points of this rank.
struct Gathered {
    columns: std::ops::Range<usize>,
    /// Of each node and of each element: its first row.
    nodes: Vec<usize>,
    elements: Vec<usize>,
    states: Vec<f64>,
    own: Vec<f64>,
}

impl Gathered {
    /// Of all ranks, which have these series. By all ranks.
    fn new(spread: &Spread, series: &[Vec<(Item, usize)>]) -> Result<Self> {
        let (ranks, part, equations) = (spread.ranks, spread.part, spread.equations);
        let points = equations.grid().points();
        let count = |which: fn(&Item) -> bool| -> Vec<usize> {
            let of_rank = |list: &Vec<(Item, usize)>| list.iter().filter(|s| which(&s.0)).count();
            series.iter().map(of_rank).collect()
        };
        let nodes = count(|item| matches!(item, Item::Node(_)));
        let nodes: Vec<usize> = nodes.into_iter().map(|motions| motions / 6).collect();
        let own = count(|item| matches!(item, Item::Element(_)));
        let mut of_nodes = Transposition::new(ranks, nodes, points, STATE);
        let mut of_own = Transposition::new(ranks, own, points, 2);
        let mut rows = Vec::with_capacity(of_nodes.by_rows());
        for &local in &part.own_nodes {
            for state in &equations.node_states()[local * points..][..points] {
                rows.extend(numbers_of(&state.motion));
                rows.extend(state.twist.iter().chain(&state.twist_rate));
            }
        }
        let mut states = vec![0.0; of_nodes.by_columns()];
        of_nodes.to_columns(&rows, &mut states)?;
        rows.clear();
        for &local in &part.own_elements {
            let placed = &part.system.elements()[local];
            for row in 0..placed.element.own_unknowns() {
                for k in 0..points {
                    let at = placed.own_at(points, k).start + row;
                    rows.extend([spread.state.multipliers[at], equations.own_rates()[at]]);
                }
            }
        }
        let mut own = vec![0.0; of_own.by_columns()];
        of_own.to_columns(&rows, &mut own)?;
        let mut gathered = Gathered {
            columns: of_nodes.own_columns(),
            nodes: vec![0; spread.whole.nodes()],
            elements: vec![0; spread.whole.elements().len()],
            states,
            own,
        };
        let (mut nodes, mut own) = (0, 0);
        for (item, component) in series.iter().flatten() {
            match *item {
                Item::Node(node) if *component == 0 => {
                    gathered.nodes[node] = nodes;
                    nodes += 1;
                }
                Item::Element(index) => {
                    if *component == 0 {
                        gathered.elements[index] = own;
                    }
                    own += 1;
                }
                Item::Node(_) => {}
            }
        }
        Ok(gathered)
    }

    fn state(&self, node: usize, k: usize) -> NodeState {
        let row = self.nodes[node] * self.columns.len();
        let numbers = &self.states[(row + k) * STATE..][..STATE];
        NodeState {
            motion: motion_of(numbers),
            twist: Vector6::from_column_slice(&numbers[12..18]),
            twist_rate: Vector6::from_column_slice(&numbers[18..24]),
        }
    }

    /// Value and rate of an own unknown.
    fn own(&self, element: usize, row: usize, k: usize) -> [f64; 2] {
        let at = ((self.elements[element] + row) * self.columns.len() + k) * 2;
        [self.own[at], self.own[at + 1]]
    }
}

/// What nodes do at some grid points of a larger grid; nothing there depends on the others.
#[derive(Debug, Clone)]
struct GivenAtPoints {
    /// Node `a` at grid point `k`, at `a N + k`.
    states: Vec<NodeState>,
    /// Own unknown `i` at grid point `k`, at `i N + k`.
    rates: Vec<f64>,
    points: usize,
}

impl TimeRule for GivenAtPoints {
    fn evaluate(&mut self, _: &GridState, _: &Workers, nodes: &mut [NodeState]) {
        nodes.copy_from_slice(&self.states);
    }

    fn rates(&mut self, place: usize, _: &[f64], _: f64, rates: &mut [f64]) {
        rates.copy_from_slice(&self.rates[place * self.points..][..self.points]);
    }

    fn tangent(&self, _: usize, _: usize, _: usize, _: usize) -> [DualMatrix; 2] {
        [DualMatrix::zeros(); 2]
    }

    fn rate_weight(&self, _: usize, _: usize, _: usize) -> f64 {
        0.0
    }

    fn vary_rates(&self, _: &[f64], _: &mut RuleWorkspace, rates: &mut [f64]) {
        rates.fill(0.0);
    }
}
