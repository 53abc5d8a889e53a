//! A preconditioner for slow mechanisms, and for heavily constrained ones: equilibrium at each grid
//! point by itself, without inertia. See docs/theory.md, section 8.6.

use super::block_lu::{BlockLanes, BlockPlace, Scratch};
use super::constraints::{Class, classify_at};
use super::lanes::{LANES, Lanes, RealLanes};
use super::layout::{Layout, Position, Region};
use super::soft_motions::SoftMotions;
use crate::collocation::{Collocation, Coupling, Tangent};
use crate::error::Result;
use crate::workers::Workers;

/// The preconditioner, factored.
pub(super) struct TimeLocal {
    points: usize,
    layout: Layout,
    workers: Workers,
    factors: Vec<BlockLanes<RealLanes>>,
    lanes: Vec<Vec<RealLanes>>,
    workspaces: Vec<Scratch<RealLanes>>,
    soft: Option<SoftMotions>,
}

impl TimeLocal {
    /// Factors the static part of the Jacobian `tangent`, or its transpose. None if it is singular.
    pub fn new(equations: &Collocation, tangent: &Tangent, transposed: bool) -> Option<Self> {
        let points = equations.grid().points();
        let classes = classify_at(equations, tangent, 0);
        let layout = Layout::new(
            equations,
            tangent,
            &classes,
            &vec![false; equations.system().nodes()],
        );
        let workers = equations.workers().clone();
        let of_couplings = places_of_couplings(&layout, tangent, transposed);
        let mut factors: Vec<Option<BlockLanes<RealLanes>>> = vec![None; points.div_ceil(LANES)];
        workers.each(&mut factors, |chunk, place| {
            let first = LANES * chunk;
            let mut lanes = BlockLanes::<RealLanes>::new(&layout.structure, points - first);
            for (lane, k) in (first..points).take(LANES).enumerate() {
                let target = (&mut lanes, lane);
                add_couplings(target, &of_couplings, (equations, tangent), k);
                let target = (&mut lanes, lane, transposed);
                add_own(target, &layout, (equations, tangent), k);
            }
            lanes.repeat_last();
            if lanes.factor(&layout.structure, &workers) {
                *place = Some(lanes);
            }
        });
        let factors: Vec<_> = factors.into_iter().collect::<Option<_>>()?;
        Some(TimeLocal {
            points,
            lanes: vec![vec![RealLanes::zero(); layout.structure.unknowns()]; factors.len()],
            workspaces: Vec::new(),
            workers,
            layout,
            factors,
            soft: None,
        })
    }

    /// Takes inertia and damping of the softest motions into account, if that can be done.
    ///
    /// # Errors
    /// If memory runs out, or work is to end.
    pub fn with_soft_motions(mut self, equations: &Collocation, tangent: &Tangent) -> Result<Self> {
        self.soft = SoftMotions::new(equations, tangent, &mut |x| self.apply_alone(x))?;
        Ok(self)
    }

    /// Bytes that the factors take.
    pub fn bytes(&self) -> usize {
        let soft = self.soft.as_ref().map_or(0, SoftMotions::bytes);
        soft + self.factors.iter().map(BlockLanes::bytes).sum::<usize>()
    }

    /// `x = P⁻¹ x`.
    pub fn apply(&mut self, x: &mut [f64]) {
        if let Some(soft) = &mut self.soft {
            soft.find(x);
        }
        self.apply_alone(x);
        if let Some(soft) = &self.soft {
            soft.add(x);
        }
    }

    /// The same of equilibrium alone.
    pub fn apply_alone(&mut self, x: &mut [f64]) {
        let (layout, factors, last) = (&self.layout, &self.factors, self.points - 1);
        let (given, workers) = (&*x, &self.workers);
        workers.for_each(
            &mut self.lanes,
            &mut self.workspaces,
            Scratch::default,
            |workspace, chunk, lanes| {
                for (number, &(first, stride)) in lanes.iter_mut().zip(&layout.places) {
                    for lane in 0..LANES {
                        number.set(
                            lane,
                            given[first + stride * (LANES * chunk + lane).min(last)],
                        );
                    }
                }
                factors[chunk].forward(&layout.structure, lanes, (workspace, workers));
                factors[chunk].backward(&layout.structure, lanes, (workspace, workers));
            },
        );
        let (regions, lanes) = (&self.layout.regions, &self.lanes);
        let mut parts = Region::split(regions, x);
        self.workers.each(&mut parts, |i, x| {
            let unknowns = &regions[i].unknowns;
            for (k, x) in x.chunks_exact_mut(unknowns.len()).enumerate() {
                for (x, unknown) in x.iter_mut().zip(unknowns.clone()) {
                    *x = lanes[k / LANES][unknown].get(k % LANES);
                }
            }
        });
    }
}

/// Where a block stands, or its transpose.
fn place_of(layout: &Layout, (row, column): (Position, Position), transposed: bool) -> BlockPlace {
    match transposed {
        false => layout.structure.block_at(row, column),
        true => layout.structure.transposed_block_at(row, column),
    }
}

/// Where the entries of each coupling stand, or of its transpose.
fn places_of_couplings(layout: &Layout, tangent: &Tangent, transposed: bool) -> Vec<BlockPlace> {
    let place = |coupling: &Coupling| {
        let [row, column] = [coupling.row, coupling.column].map(|node| layout.node_at[node]);
        place_of(layout, (row, column), transposed)
    };
    tangent.couplings().iter().map(place).collect()
}

/// Adds the stiffness between nodes at grid point `k` to the matrix in a lane.
fn add_couplings(
    (lanes, lane): (&mut BlockLanes<RealLanes>, usize),
    places: &[BlockPlace],
    (equations, tangent): (&Collocation, &Tangent),
    k: usize,
) {
    for (pair, (coupling, place)) in tangent.couplings().iter().zip(places).enumerate() {
        let [stiffness, _] = tangent.whole_pair(pair, k);
        let row_scale = &equations.row_scale()[equations.layout().node(coupling.row)];
        let column_scale = &equations.column_scale()[equations.layout().node(coupling.column)];
        for (j, column_scale) in column_scale.iter().take(6).enumerate() {
            for (i, row_scale) in row_scale.iter().take(6).enumerate() {
                let value = stiffness[(i, j)] * row_scale * column_scale;
                lanes.at(place.entry(i, j)).add_to(lane, value);
            }
        }
    }
}

/// Adds what belongs to the elements' own unknowns at grid point `k` to the matrix in a lane, or
/// the transpose of that.
fn add_own(
    (lanes, lane, transposed): (&mut BlockLanes<RealLanes>, usize, bool),
    layout: &Layout,
    (equations, tangent): (&Collocation, &Tangent),
    k: usize,
) {
    let system = equations.system();
    let place = |row: Position, column: Position| place_of(layout, (row, column), transposed);
    for (index, class) in classify_at(equations, tangent, k).iter().enumerate() {
        let Class::Averaged(own) = class else {
            continue;
        };
        let placed = &system.elements()[index];
        let at = layout.own_at[index];
        let count = own.gradient.nrows();
        for (local, &node) in placed.element.nodes().iter().enumerate() {
            let node = layout.node_at[node];
            let (gradients, effects) = (place(at, node), place(node, at));
            for row in 0..count {
                for component in 0..6 {
                    let of = (row, 6 * local + component);
                    let g = own.gradient[of];
                    let effect = own.feedback.as_ref().map_or(g, |own| own.effect[of]);
                    lanes.at(gradients.entry(row, component)).add_to(lane, g);
                    lanes.at(effects.entry(component, row)).add_to(lane, effect);
                }
            }
        }
        let among = place(at, at);
        if placed.has_states {
            let first = equations.layout().element_at(placed, 0).start;
            let (stiffness, _) = tangent.own(system, index, k);
            for column in 0..count {
                for row in 0..count {
                    let scale = equations.row_scale()[first + row]
                        * equations.column_scale()[first + column];
                    let value = stiffness[column * count + row] * scale;
                    lanes.at(among.entry(row, column)).add_to(lane, value);
                }
            }
        } else {
            for i in 0..count {
                let value = -equations.regularisation();
                lanes.at(among.entry(i, i)).add_to(lane, value);
            }
        }
    }
}
