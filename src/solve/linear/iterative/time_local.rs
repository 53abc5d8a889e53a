//! A preconditioner for slow mechanisms, and for heavily constrained ones: equilibrium at each grid
//! point by itself, without inertia. See docs/theory.md, section 8.6.

use super::block_lu::{BlockLanes, Scratch};
use super::constraints::{Class, classify_at};
use super::lanes::{LANES, Lanes, RealLanes};
use super::layout::{Layout, Region};
use super::soft_motions::SoftMotions;
use crate::collocation::{Collocation, Tangent};
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
        let mut factors: Vec<Option<BlockLanes<RealLanes>>> = vec![None; points.div_ceil(LANES)];
        workers.each(&mut factors, |chunk, place| {
            let used = points - LANES * chunk;
            let mut lanes = BlockLanes::<RealLanes>::new(&layout.structure, used);
            for lane in 0..LANES {
                let k = (LANES * chunk + lane).min(points - 1);
                fill(
                    (&mut lanes, lane, transposed),
                    &layout,
                    equations,
                    tangent,
                    k,
                );
            }
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

/// Writes the matrix of grid point `k`, or its transpose.
fn fill(
    (lanes, lane, transposed): (&mut BlockLanes<RealLanes>, usize, bool),
    layout: &Layout,
    equations: &Collocation,
    tangent: &Tangent,
    k: usize,
) {
    let system = equations.system();
    let mut add = |at: ((usize, usize), (usize, usize)), (i, j), value: f64| {
        let ((row, first_row), (column, first_column)) = at;
        let (i, j) = (first_row + i, first_column + j);
        let entry = lanes.at(match transposed {
            false => layout.structure.entry((row, column), (i, j)),
            true => layout.structure.entry((column, row), (j, i)),
        });
        entry.set(lane, entry.get(lane) + value);
    };
    for (pair, coupling) in tangent.couplings().iter().enumerate() {
        let [stiffness, _] = tangent.whole_pair(pair, k);
        let row_scale = &equations.row_scale()[equations.layout().node(coupling.row)];
        let column_scale = &equations.column_scale()[equations.layout().node(coupling.column)];
        let at = (
            layout.node_at[coupling.row],
            layout.node_at[coupling.column],
        );
        for i in 0..6 {
            for j in 0..6 {
                add(
                    at,
                    (i, j),
                    stiffness[(i, j)] * row_scale[i] * column_scale[j],
                );
            }
        }
    }
    for (index, class) in classify_at(equations, tangent, k).iter().enumerate() {
        let Class::Averaged(own) = class else {
            continue;
        };
        let placed = &system.elements()[index];
        let at = layout.own_at[index];
        for (local, &node) in placed.element.nodes().iter().enumerate() {
            for row in 0..own.gradient.nrows() {
                for component in 0..6 {
                    let place = (row, 6 * local + component);
                    let g = own.gradient[place];
                    let effect = own.feedback.as_ref().map_or(g, |of| of.effect[place]);
                    add((at, layout.node_at[node]), (row, component), g);
                    add((layout.node_at[node], at), (component, row), effect);
                }
            }
        }
        let count = own.gradient.nrows();
        if placed.has_states {
            let first = equations.layout().element_at(placed, 0).start;
            let (stiffness, _) = tangent.own(system, index, k);
            for column in 0..count {
                for row in 0..count {
                    let scale = equations.row_scale()[first + row]
                        * equations.column_scale()[first + column];
                    add(
                        (at, at),
                        (row, column),
                        stiffness[column * count + row] * scale,
                    );
                }
            }
        } else {
            (0..count).for_each(|i| add((at, at), (i, i), -equations.regularisation()));
        }
    }
}
