//! Bodies averaged over time (`body_circulant`), with the harmonics divided among ranks: each rank
//! factors the averaged matrices of the whole system for its own. The system of the joints that
//! turn, which is small, is solved by all ranks alike.

use super::block_lu::{BlockLanes, Scratch};
use super::body_circulant::{LARGEST_BLOCK, NEIGHBOURS, scaled_aliasing_of};
use super::chunks::Chunks;
use super::constraints::{Class, Joints, RowRotation, classify, keep_neighbours, turning_nodes};
use super::lanes::{ComplexLanes, LANES, Lanes};
use super::layout::Layout;
use super::mean::{Averages, MeanStrain, MeanTangent, own_means};
use super::resultants::Resultants;
use super::spread::{COMPLEX, OwnPart, Series, Spread};
use super::spread_joints::Closure;
use super::spread_means::{gathered_aliasing, gathered_means, local_rotations};
use super::transform::Transform;
use crate::collocation::{Aliasing, Collocation, Halo, Item, Tangent};
use crate::error::Result;
use crate::fourier::TimeGrid;
use crate::ranks::{Ranks, Transposition};
use crate::system::System;
use crate::workers::Workers;
use nalgebra::Complex;
use std::ops::Range;
use std::sync::Arc;

/// The preconditioner, factored.
pub(crate) struct SpreadHarmonics {
    ranks: Arc<dyn Ranks>,
    points: usize,
    frequency: f64,
    layout: Layout,
    /// Harmonics of this rank, and their factors.
    harmonics: Range<usize>,
    factors: Vec<BlockLanes<ComplexLanes>>,
    lanes: Vec<Vec<ComplexLanes>>,
    workspaces: Vec<Scratch<ComplexLanes>>,
    transposition: Transposition,
    /// Places of this rank's series in its part, at the first grid point and from one to the next.
    own: Vec<(usize, usize)>,
    /// Unknown of a harmonic that each series is, of all ranks.
    unknowns: Vec<usize>,
    rows: Vec<f64>,
    columns: Vec<f64>,
    transform: Transform,
    transforms: Vec<Transform>,
    workers: Workers,
    /// Of the constraints of this rank, in vectors of its part.
    rotations: Vec<RowRotation>,
    resultants: Resultants,
    /// Numbers of a vector of the part without stress resultants.
    size: usize,
    /// Places of motions in the part, node by node.
    motions: usize,
    /// Derivatives of these, if resultants depend on them.
    rates: Vec<f64>,
    /// Of each node of the part.
    aliasing: Vec<Vec<Aliasing>>,
    joints: Option<Closure>,
}

/// What all attempts to factor have in common.
struct Parts {
    own: OwnPart,
    strains: Vec<MeanStrain>,
    means: Vec<MeanTangent>,
    /// Of all nodes of the whole.
    aliasing: Vec<Vec<Aliasing>>,
    /// The whole system on a grid of one point, for its structure.
    structure: (Collocation, Tangent),
}

impl Parts {
    /// What becomes of the own unknowns of all elements, and which nodes stand alone.
    fn of_whole(
        &self,
        whole: &System,
        own_classes: &[Class],
        kept_alone: &[bool],
    ) -> (Vec<Class>, Vec<bool>) {
        let mut classes = vec![Class::None; whole.elements().len()];
        for (&index, class) in self.own.elements.iter().zip(own_classes) {
            classes[index] = class.clone();
        }
        let mut alone = vec![false; whole.nodes()];
        for (&node, &is_alone) in self.own.nodes.iter().zip(kept_alone) {
            alone[node] = is_alone;
        }
        (classes, alone)
    }

    /// Means of own tangents of all elements.
    fn own_means(&self, whole: &System) -> Vec<[Vec<f64>; 2]> {
        let mut all = vec![[Vec::new(), Vec::new()]; whole.elements().len()];
        let means = own_means(&self.own.equations, &self.own.tangent);
        for (&index, means) in self.own.elements.iter().zip(means) {
            all[index] = means;
        }
        all
    }
}

impl SpreadHarmonics {
    /// Averages and factors the Jacobian; none if that cannot be done, as
    /// [`super::body_circulant::BodyCirculant::new`]. By all ranks.
    ///
    /// # Errors
    /// If numbers cannot be told, or elements cannot be evaluated.
    pub(super) fn new(spread: Spread, joints: Joints) -> Result<Option<Self>> {
        let (ranks, own) = (spread.ranks, spread.with_own_unknowns()?);
        let strains = MeanStrain::all(spread.equations, spread.tangent);
        let instant = TimeGrid::new(1, spread.equations.grid().period())?;
        let structure = (
            ranks.agreed(Collocation::new(spread.whole.clone(), instant))?,
            Tangent::with_resultants_apart(spread.whole, 1),
        );
        let parts = Parts {
            means: gathered_means(&spread, &strains, &structure.1)?,
            aliasing: gathered_aliasing(&spread)?,
            own,
            strains,
            structure,
        };
        let (equations, tangent) = (&parts.own.equations, &parts.own.tangent);
        let mut classes = classify(equations, tangent, joints);
        let mut turning = turning_nodes(equations.system(), &classes);
        for _ in 0..NEIGHBOURS {
            let few = Self::factored(&spread, &parts, &classes, &turning)?;
            if few.is_some() || !turning.contains(&true) {
                return Ok(few);
            }
            if !keep_neighbours(equations, tangent, &mut classes) {
                break;
            }
            turning = turning_nodes(equations.system(), &classes);
        }
        let together = vec![false; turning.len()];
        Self::factored(&spread, &parts, &classes, &together)
    }

    fn factored(
        spread: &Spread,
        parts: &Parts,
        own_classes: &[Class],
        kept_alone: &[bool],
    ) -> Result<Option<Self>> {
        let (ranks, whole, equations) = (spread.ranks, spread.whole, spread.equations);
        let (grid, (once, structure)) = (equations.grid(), &parts.structure);
        let (classes, alone) = parts.of_whole(whole, own_classes, kept_alone);
        let layout = Layout::new(once, structure, &classes, &alone);
        if layout.largest_block() > LARGEST_BLOCK {
            return Ok(None);
        }
        let count = grid.harmonics() + 1;
        let series = |rank: usize| {
            spread.series_of(rank, |index| matches!(classes[index], Class::Averaged(_)))
        };
        let all: Vec<Vec<Series>> = (0..ranks.count()).map(series).collect();
        let rows = all.iter().map(Vec::len).collect();
        let transposition = Transposition::new(ranks, rows, count, COMPLEX);
        let harmonics = transposition.own_columns();
        let averages = Averages {
            system: whole,
            grid,
            couplings: structure.couplings(),
            layout: &layout,
            classes: &classes,
            means: &parts.means,
            own: &parts.own_means(whole),
            aliasing: &parts.aliasing,
            compliance: equations.regularisation(),
            alike: None,
            transposed: false,
            workers: equations.workers(),
        };
        let factors = averages.factor(&Chunks::of_all(harmonics.clone()));
        let is_missing = f64::from(u8::from(factors.is_none()));
        let (Some(factors), true) = (factors, ranks.largest([is_missing])? == [0.0]) else {
            return Ok(None);
        };
        let own = all[ranks.rank()]
            .iter()
            .map(|series| spread.local_place(*series));
        let resultants = Resultants::new(equations, spread.tangent, &parts.strains);
        let motions = equations.layout().motions().len();
        let nodes = 0..equations.system().nodes();
        let mut spread_factors = SpreadHarmonics {
            ranks: ranks.clone(),
            points: grid.points(),
            frequency: grid.frequency(),
            harmonics,
            lanes: vec![vec![ComplexLanes::zero(); layout.structure.unknowns()]; factors.len()],
            factors,
            workspaces: Vec::new(),
            own: own.collect(),
            unknowns: all
                .iter()
                .flatten()
                .map(|s| unknown_of(&layout, s))
                .collect(),
            rows: vec![0.0; transposition.by_rows()],
            columns: vec![0.0; transposition.by_columns()],
            transposition,
            transform: Transform::new(grid.points()),
            transforms: Vec::new(),
            workers: equations.workers().clone(),
            rotations: local_rotations(spread, &parts.own, own_classes),
            size: equations.size(),
            motions,
            rates: vec![0.0; if resultants.damped() { motions } else { 0 }],
            aliasing: nodes
                .map(|node| scaled_aliasing_of(equations, node))
                .collect(),
            resultants,
            joints: None,
            layout,
        };
        let closed = spread_factors.close(spread, (&parts.own, own_classes))?;
        Ok(closed.then_some(spread_factors))
    }

    /// Closes the joints that turn, if there are any. `false` if that cannot be done.
    fn close(&mut self, spread: &Spread, own: (&OwnPart, &[Class])) -> Result<bool> {
        if self.layout.kept().next().is_none() {
            return Ok(true);
        }
        self.joints = Closure::new(spread, own, &self.layout, &self.factors, &self.harmonics)?;
        Ok(self.joints.is_some())
    }

    /// Sets the size of stress resultants.
    pub fn set_resultant_scale(&mut self, scale: f64) {
        self.resultants.scale = scale;
    }

    /// Bytes that the factors take.
    pub fn bytes(&self) -> usize {
        let harmonics: usize = self.factors.iter().map(BlockLanes::bytes).sum();
        harmonics + self.joints.as_ref().map_or(0, |j| j.interface.bytes())
    }

    /// `x = P⁻¹ x`, with stress resultants behind it, whose halo is filled. By all ranks.
    ///
    /// # Errors
    /// If numbers cannot be told.
    pub fn apply(&mut self, x: &mut [f64], halo: &mut Halo) -> Result<()> {
        let apart = x.len() > self.size;
        if apart {
            halo.fill(&*self.ranks, x)?;
            let (x, resultants) = x.split_at_mut(self.size);
            self.resultants.add_forces(resultants, x);
        }
        for rotation in &self.rotations {
            rotation.apply(x, false);
        }
        self.analyse(x)?;
        let (structure, factors) = (&self.layout.structure, &self.factors);
        let workers = &self.workers;
        workers.for_each(
            &mut self.lanes,
            &mut self.workspaces,
            Scratch::default,
            |scratch, chunk, lanes| factors[chunk].forward(structure, lanes, (scratch, workers)),
        );
        if let Some(joints) = &mut self.joints {
            let (lanes, transform) = (&mut self.lanes, &mut self.transform);
            joints.solve(&*self.ranks, &self.harmonics, lanes, transform, x)?;
        }
        let (structure, factors) = (&self.layout.structure, &self.factors);
        let workers = &self.workers;
        workers.for_each(
            &mut self.lanes,
            &mut self.workspaces,
            Scratch::default,
            |scratch, chunk, lanes| factors[chunk].backward(structure, lanes, (scratch, workers)),
        );
        self.synthesise(x)?;
        if apart {
            halo.fill(&*self.ranks, x)?;
            let (x, resultants) = x.split_at_mut(self.size);
            self.find_rates(x);
            self.resultants.determine(x, &self.rates, resultants);
        }
        for rotation in &self.rotations {
            rotation.apply(x, true);
        }
        Ok(())
    }

    /// This rank's harmonics of everything that is averaged.
    fn analyse(&mut self, x: &[f64]) -> Result<()> {
        let length = COMPLEX * (self.points / 2 + 1);
        let (own, points) = (&self.own, self.points);
        let mut rows: Vec<_> = self.rows.chunks_mut(length).collect();
        self.workers.for_each(
            &mut rows,
            &mut self.transforms,
            || self.transform.clone(),
            |transform, index, row| {
                let (first, stride) = own[index];
                let series = x[first..].iter().step_by(stride);
                transform.analysis.read(series.copied().take(points));
                let pairs = row
                    .chunks_exact_mut(COMPLEX)
                    .zip(&transform.analysis.spectrum);
                pairs.for_each(|(to, value)| to.copy_from_slice(&[value.re, value.im]));
            },
        );
        self.transposition
            .to_columns(&self.rows, &mut self.columns)?;
        let count = self.harmonics.len();
        if count == 0 {
            return Ok(());
        }
        for (row, &unknown) in self.columns.chunks(COMPLEX * count).zip(&self.unknowns) {
            for (chunk, lanes) in self.lanes.iter_mut().enumerate() {
                for lane in 0..LANES {
                    let h = (LANES * chunk + lane).min(count - 1);
                    let value = &row[COMPLEX * h..][..COMPLEX];
                    lanes[unknown].set(lane, Complex::new(value[0], value[1]));
                }
            }
        }
        Ok(())
    }

    /// Everything that is averaged, from its harmonics.
    fn synthesise(&mut self, x: &mut [f64]) -> Result<()> {
        let count = self.harmonics.len();
        if count > 0 {
            let rows = self.columns.chunks_mut(COMPLEX * count);
            for (row, &unknown) in rows.zip(&self.unknowns) {
                for (h, to) in row.chunks_exact_mut(COMPLEX).enumerate() {
                    let value = self.lanes[h / LANES][unknown].get(h % LANES);
                    to.copy_from_slice(&[value.re, value.im]);
                }
            }
        }
        self.transposition.to_rows(&self.columns, &mut self.rows)?;
        let scale = 1.0 / self.points as f64;
        let length = COMPLEX * (self.points / 2 + 1);
        let mut rows: Vec<_> = self.rows.chunks_mut(length).collect();
        self.workers.for_each(
            &mut rows,
            &mut self.transforms,
            || self.transform.clone(),
            |transform, _, row| {
                let values = row
                    .chunks_exact(COMPLEX)
                    .map(|v| Complex::new(v[0], v[1]) * scale);
                let spectrum = transform.synthesis.spectrum.iter_mut();
                spectrum.zip(values).for_each(|(to, value)| *to = value);
                row[..self.points].copy_from_slice(transform.backward());
            },
        );
        for (&(first, stride), row) in self.own.iter().zip(self.rows.chunks(length)) {
            let series = x[first..].iter_mut().step_by(stride);
            let samples = &row[..self.points];
            series.zip(samples).for_each(|(x, sample)| *x = *sample);
        }
        Ok(())
    }

    /// Derivatives of the motions of the part, and what the grid adds to them.
    fn find_rates(&mut self, x: &[f64]) {
        if self.rates.is_empty() {
            return;
        }
        let (points, transform) = (self.points, &mut self.transform);
        let scale = 1.0 / points as f64;
        let of_node = 6 * points;
        let nodes = x[..self.motions].chunks_exact(of_node);
        let nodes = nodes.zip(self.rates.chunks_exact_mut(of_node));
        for ((motions, rates), aliasing) in nodes.zip(&self.aliasing) {
            let spectra: Vec<Vec<Complex<f64>>> = (0..6)
                .map(|component| {
                    let series = motions[component..].iter().step_by(6);
                    transform.analysis.read(series.copied());
                    transform
                        .analysis
                        .spectrum
                        .iter()
                        .map(|value| value * scale)
                        .collect()
                })
                .collect();
            for (component, own) in spectra.iter().enumerate() {
                let spectrum = &mut transform.synthesis.spectrum;
                for (j, value) in spectrum.iter_mut().enumerate() {
                    *value = own[j] * Complex::new(0.0, self.frequency * j as f64);
                }
                for (below, added) in aliasing.iter().enumerate() {
                    let j = points / 2 - below;
                    spectrum[j] += (0..6)
                        .map(|other| added.velocity[(component, other)] * spectra[other][j])
                        .sum::<Complex<f64>>();
                }
                let series = rates[component..].iter_mut().step_by(6);
                series
                    .zip(transform.backward())
                    .for_each(|(rate, sample)| *rate = *sample);
            }
        }
    }
}

/// Unknown of a harmonic that a series is.
fn unknown_of(layout: &Layout, &(item, component): &Series) -> usize {
    let (row, first) = match item {
        Item::Node(node) => layout.node_at[node],
        Item::Element(index) => layout.own_at[index],
    };
    layout.structure.first(row) + first + component
}
