//! A preconditioner for bodies that move fast, and joints that turn: each body's own operator is
//! averaged over time in its own frame, where it hardly changes, so that harmonics separate; joints
//! stay exact.
//!
//! ```text
//! P = [S̄ Gᵀ; G 0]
//! ```
//!
//! with `S̄` circulant, made of averages that leave stress resultants apart: see [`MeanStrain`].
//! Constraints that are the same at all times in the frames of their bodies, up to a combination of
//! their rows, are circulant as well, and are eliminated with the bodies, harmonic by harmonic:
//! `G_k = Q_k Ḡ`. At the nodes of other joints there remains the dynamic stiffness of the bodies
//! between them, and a system over all grid points. See docs/theory.md, section 8.5.

use super::block_lu::{BlockLanes, BlockPlace, Scratch};
use super::chunks::Chunks;
use super::constraints::{
    Class, Joints, RowRotation, classify, keep_neighbours, row_rotations, turning_nodes,
};
use super::harmonic_band::Spectra;
use super::interface::{Bounds, Interface};
use super::lanes::{ComplexLanes, LANES, Lanes};
use super::layout::{Layout, Region};
use super::mean::{Averages, MeanStrain, own_means, scaled_means};
use super::resultants::Resultants;
use super::transform::Transform;
use crate::collocation::{Aliasing, Collocation, Tangent};
use crate::error::Result;
use crate::fourier::Analysis;
use crate::system;
use crate::workers::{Workers, parts};
use nalgebra::{Complex, Matrix6};
use std::time::{Duration, Instant};

/// Most unknowns of a dense system of one harmonic.
pub(super) const LARGEST_BLOCK: usize = 240;
/// Times that it is tried to eliminate what is beside joints that turn, each time less of it.
pub(super) const NEIGHBOURS: usize = 3;

/// The preconditioner, factored.
pub(super) struct BodyCirculant {
    points: usize,
    unknowns: system::Layout,
    layout: Layout,
    factors: Vec<BlockLanes<ComplexLanes>>,
    chunks: Chunks,
    rotations: Vec<RowRotation>,
    /// Unknowns that are not eliminated.
    kept: Vec<usize>,
    pub(super) interface: Option<Interface>,
    transform: Transform,
    workers: Workers,
    workspaces: Vec<Transform>,
    /// Harmonics of each unknown, region by region.
    spectra: Vec<Complex<f64>>,
    /// Where those of each unknown start.
    spectrum_at: Vec<usize>,
    lanes: Vec<Vec<ComplexLanes>>,
    /// Of each thread.
    scratches: Vec<Scratch<ComplexLanes>>,
    products: Vec<Vec<ComplexLanes>>,
    /// Forces on what is kept, motions of it, and forces by these motions, over the grid.
    series: [Vec<Vec<f64>>; 3],
    pub resultants: Resultants,
    /// Derivatives of the motions, if resultants depend on them.
    rates: Vec<f64>,
    frequency: f64,
    /// Of each node, scaled: what the grid adds to changes of velocity of the highest harmonic, the
    /// one below, and so on.
    aliasing: Vec<Vec<Aliasing>>,
    /// Whether it is that of the transposed equations.
    transposed: bool,
    /// Time that the system of the joints took.
    pub interface_time: Duration,
}

impl BodyCirculant {
    /// Averages and factors the Jacobian `tangent`, or its transpose. None if that cannot be done:
    /// a body by itself is singular, or the system of the joints would take more than it may.
    ///
    /// # Errors
    /// If memory runs out.
    pub fn new(
        equations: &Collocation,
        tangent: &Tangent,
        joints: Joints,
        (bounds, transposed): (Bounds, bool),
    ) -> Result<Option<Self>> {
        let bounds = (bounds, transposed);
        let mut classes = classify(equations, tangent, joints);
        // What is joined rigidly to a node of a joint that turns is eliminated, if it can be
        // without that node.
        let mut turning = turning_nodes(equations.system(), &classes);
        for _ in 0..NEIGHBOURS {
            let few = Self::factored(equations, tangent, &classes, &turning, bounds)?;
            if few.is_some() || !turning.contains(&true) {
                return Ok(few);
            }
            if !keep_neighbours(equations, tangent, &mut classes) {
                break;
            }
            turning = turning_nodes(equations.system(), &classes);
        }
        let together = vec![false; turning.len()];
        Self::factored(equations, tangent, &classes, &together, bounds)
    }

    fn factored(
        equations: &Collocation,
        tangent: &Tangent,
        classes: &[Class],
        kept_alone: &[bool],
        (bounds, transposed): (Bounds, bool),
    ) -> Result<Option<Self>> {
        let layout = Layout::new(equations, tangent, classes, kept_alone);
        if layout.largest_block() > LARGEST_BLOCK {
            return Ok(None);
        }
        let kept: Vec<usize> = layout.kept().collect();
        let places: Vec<_> = kept.iter().map(|&i| layout.places[i]).collect();
        let new = || Interface::new(equations, classes, &places, bounds);
        let interface = (!kept.is_empty()).then(new).flatten();
        if interface.is_some() == kept.is_empty() {
            return Ok(None);
        }
        let strains = MeanStrain::all(equations, tangent);
        let points = equations.grid().points();
        let (aliasing, harmonics) = (scaled_aliasing(equations), points / 2 + 1);
        let averages = Averages {
            system: equations.system(),
            grid: equations.grid(),
            couplings: tangent.couplings(),
            layout: &layout,
            classes,
            means: &scaled_means(equations, tangent, &strains),
            own: &own_means(equations, tangent),
            aliasing: &aliasing,
            compliance: equations.regularisation(),
            alike: equations.alike(),
            transposed,
            workers: equations.workers(),
        };
        let chunks = layout.chunks(equations, harmonics);
        let Some(factors) = averages.factor(&chunks) else {
            return Ok(None);
        };
        let resultants = Resultants::new(equations, tangent, &strains);
        let lanes = vec![vec![ComplexLanes::zero(); layout.structure.unknowns()]; factors.len()];
        let series = || vec![vec![0.0; points]; kept.len()];
        let motions = equations.layout().motions().len();
        let mut circulant = BodyCirculant {
            points,
            unknowns: equations.layout(),
            rotations: row_rotations(equations, classes),
            interface: None,
            transform: Transform::new(points),
            products: lanes[..if kept.is_empty() { 0 } else { lanes.len() }].to_vec(),
            lanes,
            scratches: Vec::new(),
            workers: equations.workers().clone(),
            workspaces: Vec::new(),
            spectra: vec![Complex::default(); layout.structure.unknowns() * harmonics],
            spectrum_at: spectra_of(&layout, harmonics),
            series: [series(), series(), series()],
            rates: vec![0.0; if resultants.damped() { motions } else { 0 }],
            aliasing,
            transposed,
            resultants,
            frequency: equations.grid().frequency(),
            factors,
            chunks,
            layout,
            kept,
            interface_time: Duration::ZERO,
        };
        let factored = match interface {
            Some(interface) => circulant.factor_interface(interface)?,
            None => true,
        };
        Ok(factored.then_some(circulant))
    }

    /// Factors the system of the joints. `false` if it is singular.
    fn factor_interface(&mut self, mut interface: Interface) -> Result<bool> {
        let (began, workers) = (Instant::now(), self.workers.clone());
        let stiffness = self.kept_stiffness();
        let multiply = &mut |motions: &[Vec<f64>], forces: &mut [Vec<f64>]| {
            self.multiply_kept(motions, forces);
        };
        let factored = interface.factor(&stiffness, multiply, &workers)?;
        self.interface = Some(interface);
        self.interface_time = began.elapsed();
        Ok(factored)
    }

    /// Unknowns of the system of the joints.
    pub fn interface_size(&self) -> usize {
        self.interface.as_ref().map_or(0, Interface::size)
    }

    /// What it may leave out of harmonics, as it has turned out; none if there is no such system.
    pub fn left_out(&self) -> Option<f64> {
        self.interface.as_ref().map(Interface::left_out)
    }

    /// Multiply-adds that it took.
    pub fn interface_work(&self) -> f64 {
        self.interface.as_ref().map_or(0.0, Interface::work)
    }

    /// Bytes that the factors take.
    pub fn bytes(&self) -> usize {
        let harmonics: usize = self.factors.iter().map(BlockLanes::bytes).sum();
        harmonics + self.interface.as_ref().map_or(0, Interface::bytes)
    }

    /// `x = P⁻¹ x`, where the unknowns go on with `resultants`, if any are given.
    pub fn apply(&mut self, x: &mut [f64], resultants: &mut [f64]) {
        if !resultants.is_empty() && self.transposed {
            let (rates, transform) = (&mut self.rates, &self.transform);
            self.resultants.add_transposed(resultants, x, rates);
            let rates = (&self.rates[..], self.frequency);
            let spaces = &mut self.workspaces;
            self.resultants
                .subtract_slopes(rates, &self.aliasing, x, transform, spaces);
        } else if !resultants.is_empty() {
            self.resultants.add_forces(resultants, x);
        }
        for rotation in &self.rotations {
            rotation.apply(x, false);
        }
        self.transform_all(x);
        let (layout, spectra, spectrum_at) = (&self.layout, &self.spectra, &self.spectrum_at);
        let (factors, chunks) = (&self.factors, &self.chunks);
        let workers = &self.workers;
        workers.for_each(
            &mut self.lanes,
            &mut self.scratches,
            Scratch::default,
            |scratch, chunk, lanes| {
                for (number, &at) in lanes.iter_mut().zip(spectrum_at) {
                    for lane in 0..LANES {
                        number.set(lane, spectra[at + chunks.harmonic(chunk, lane)]);
                    }
                }
                let structure = layout.structure_of(chunks.is_whole(chunk));
                factors[chunk].forward(structure, lanes, (scratch, workers));
            },
        );
        if let Some(mut interface) = self.interface.take() {
            self.close_joints(&mut interface, x);
            self.interface = Some(interface);
        }
        let (layout, factors, chunks) = (&self.layout, &self.factors, &self.chunks);
        let workers = &self.workers;
        workers.for_each(
            &mut self.lanes,
            &mut self.scratches,
            Scratch::default,
            |scratch, chunk, lanes| {
                let structure = layout.structure_of(chunks.is_whole(chunk));
                factors[chunk].backward(structure, lanes, (scratch, workers));
                structure.silence(lanes);
            },
        );
        self.transform_back(x);
        if !resultants.is_empty() && self.transposed {
            self.resultants.determine_transposed(x, resultants);
        } else if !resultants.is_empty() {
            if self.resultants.damped() {
                self.find_rates();
            }
            self.resultants.determine(x, &self.rates, resultants);
        }
        for rotation in &self.rotations {
            rotation.apply(x, true);
        }
    }

    /// Derivatives of the motions, from their harmonics, and what the grid adds to them.
    fn find_rates(&mut self) {
        let (layout, lanes, aliasing) = (&self.layout, &self.lanes, &self.aliasing);
        let chunks = &self.chunks;
        let (points, frequency) = (self.points, self.frequency);
        let scale = 1.0 / points as f64;
        let mut parts: Vec<_> = self.rates.chunks_mut(self.unknowns.of_node()).collect();
        let new = || self.transform.clone();
        self.workers.for_each(
            &mut parts,
            &mut self.workspaces,
            new,
            |transform, node, rates| {
                let (row, first) = layout.node_at[node];
                let first = layout.structure.first(row) + first;
                let harmonic = |j: usize, component: usize| {
                    let (chunk, lane) = chunks.place(j);
                    lanes[chunk][first + component].get(lane) * scale
                };
                for component in 0..6 {
                    let spectrum = &mut transform.synthesis.spectrum;
                    for (j, value) in spectrum.iter_mut().enumerate() {
                        let rate = Complex::new(0.0, frequency * j as f64);
                        *value = harmonic(j, component) * rate;
                    }
                    for (below, added) in aliasing[node].iter().enumerate() {
                        let j = points / 2 - below;
                        spectrum[j] += (0..6)
                            .map(|other| added.velocity[(component, other)] * harmonic(j, other))
                            .sum::<Complex<f64>>();
                    }
                    let series = rates[component..].iter_mut().step_by(6);
                    series
                        .zip(transform.backward())
                        .for_each(|(rate, sample)| *rate = *sample);
                }
            },
        );
    }

    /// Solves for the motions that are kept, and the multipliers of joints that turn.
    fn close_joints(&mut self, interface: &mut Interface, x: &mut [f64]) {
        let [mut forces, mut motions, mut products] = std::mem::take(&mut self.series);
        for (&unknown, series) in self.kept.iter().zip(&mut forces) {
            let lanes = (&self.chunks, &self.lanes[..]);
            series.copy_from_slice(collect(&mut self.transform, lanes, unknown));
        }
        interface.determined(x, &mut motions);
        self.multiply_kept(&motions, &mut products);
        for (product, force) in products.iter_mut().zip(&forces) {
            product.iter_mut().zip(force).for_each(|(p, f)| *p = f - *p);
        }
        interface.add_free(&products, &mut motions);
        self.multiply_kept(&motions, &mut products);
        for (product, force) in products.iter_mut().zip(&forces) {
            product.iter_mut().zip(force).for_each(|(p, f)| *p = f - *p);
        }
        interface.write_multipliers(&products, x);
        self.series = [forces, motions, products];
    }

    /// Forces by `motions` of what is kept; the motions' harmonics stay where they are kept.
    pub(super) fn multiply_kept(&mut self, motions: &[Vec<f64>], forces: &mut [Vec<f64>]) {
        for (&unknown, series) in self.kept.iter().zip(motions) {
            self.transform.analysis.read(series.iter().copied());
            let lanes = (&self.chunks, &mut self.lanes[..]);
            spread(&self.transform.analysis, lanes, unknown);
        }
        let all = self.factors.iter().zip(&self.lanes).zip(&mut self.products);
        for (chunk, ((factors, lanes), products)) in all.enumerate() {
            self.kept
                .iter()
                .for_each(|&i| products[i] = ComplexLanes::zero());
            let structure = self.layout.structure_of(self.chunks.is_whole(chunk));
            factors.add_kept_product(structure, lanes, products);
        }
        for (&unknown, series) in self.kept.iter().zip(forces) {
            let products = (&self.chunks, &self.products[..]);
            series.copy_from_slice(collect(&mut self.transform, products, unknown));
        }
    }

    /// Harmonics of everything that is averaged.
    fn transform_all(&mut self, x: &[f64]) {
        let harmonics = self.points / 2 + 1;
        let regions = &self.layout.regions;
        let counts = regions
            .iter()
            .map(|region| region.unknowns.len() * harmonics);
        let mut parts: Vec<_> = parts(&mut self.spectra, counts).collect();
        let new = || self.transform.clone();
        self.workers.for_each(
            &mut parts,
            &mut self.workspaces,
            new,
            |transform, i, spectra| {
                let (region, count) = (regions[i].of(x), regions[i].unknowns.len());
                for (component, spectrum) in spectra.chunks_exact_mut(harmonics).enumerate() {
                    let series = region[component..].iter().step_by(count);
                    transform.analysis.read(series.copied());
                    spectrum.copy_from_slice(&transform.analysis.spectrum);
                }
            },
        );
    }

    /// Everything that is averaged, from its harmonics.
    fn transform_back(&mut self, x: &mut [f64]) {
        let regions = &self.layout.regions;
        let lanes = (&self.chunks, &self.lanes[..]);
        let mut parts = Region::split(regions, x);
        let new = || self.transform.clone();
        self.workers
            .for_each(&mut parts, &mut self.workspaces, new, |transform, i, x| {
                let count = regions[i].unknowns.len();
                for (component, unknown) in regions[i].unknowns.clone().enumerate() {
                    let series = x[component..].iter_mut().step_by(count);
                    series
                        .zip(collect(transform, lanes, unknown))
                        .for_each(|(x, sample)| *x = *sample);
                }
            });
    }

    /// Dynamic stiffness of what is kept.
    pub(super) fn kept_stiffness(&self) -> Spectra {
        let count = self.kept.len();
        let mut stiffness = vec![vec![Vec::new(); count]; count];
        let structure = &self.layout.structure;
        let number = |unknown: usize| self.kept.partition_point(|&k| k < unknown);
        for &(row, column, _) in structure.kept() {
            let _ = self.workers.pulse();
            for i in 0..structure.size(row) {
                for j in 0..structure.size(column) {
                    let (a, b) = (structure.first(row) + i, structure.first(column) + j);
                    let harmonics = 0..=self.points / 2;
                    let of_harmonic = |h: usize| {
                        let (chunk, lane) = self.chunks.place(h);
                        let structure = self.layout.structure_of(self.chunks.is_whole(chunk));
                        let place = structure.find((row, i), (column, j));
                        let value =
                            |p: BlockPlace| self.factors[chunk].get(p.entry(0, 0)).get(lane);
                        place.map_or(Complex::default(), value)
                    };
                    stiffness[number(a)][number(b)] = harmonics.map(of_harmonic).collect();
                }
            }
        }
        stiffness
    }
}

/// Where the spectrum of each unknown begins, region after region.
fn spectra_of(layout: &Layout, harmonics: usize) -> Vec<usize> {
    let mut spectrum_at = vec![0; layout.structure.unknowns()];
    let unknowns = layout.regions.iter().flat_map(|r| r.unknowns.clone());
    for (i, unknown) in unknowns.enumerate() {
        spectrum_at[unknown] = i * harmonics;
    }
    spectrum_at
}

/// Writes harmonics to the lanes of an unknown.
fn spread(
    analysis: &Analysis,
    (chunks, lanes): (&Chunks, &mut [Vec<ComplexLanes>]),
    unknown: usize,
) {
    for (chunk, lanes) in lanes.iter_mut().enumerate() {
        for lane in 0..LANES {
            let harmonic = chunks.harmonic(chunk, lane);
            lanes[unknown].set(lane, analysis.spectrum[harmonic]);
        }
    }
}

/// Transforms the harmonics of an unknown back, to samples.
fn collect<'t>(
    transform: &'t mut Transform,
    (chunks, lanes): (&Chunks, &[Vec<ComplexLanes>]),
    unknown: usize,
) -> &'t [f64] {
    let scale = 1.0 / transform.analysis.samples.len() as f64;
    for (j, value) in transform.synthesis.spectrum.iter_mut().enumerate() {
        let (chunk, lane) = chunks.place(j);
        *value = lanes[chunk][unknown].get(lane) * scale;
    }
    transform.backward()
}

/// What the grid makes of each node's highest harmonics, for scaled increments and their scaled
/// changes.
fn scaled_aliasing(equations: &Collocation) -> Vec<Vec<Aliasing>> {
    let mut aliasing = vec![Vec::new(); equations.system().nodes()];
    equations.workers().each(&mut aliasing, |node, all| {
        *all = scaled_aliasing_of(equations, node)
    });
    aliasing
}

pub(super) fn scaled_aliasing_of(equations: &Collocation, node: usize) -> Vec<Aliasing> {
    let scale = &equations.column_scale()[equations.layout().motion(node, 0)];
    let scaled = |m: Matrix6<Complex<f64>>| m.map_with_location(|i, j, x| x * scale[j] / scale[i]);
    let all = equations.rule().aliasing(node).into_iter();
    all.map(|aliasing| Aliasing {
        velocity: scaled(aliasing.velocity),
        acceleration: scaled(aliasing.acceleration),
    })
    .collect()
}
