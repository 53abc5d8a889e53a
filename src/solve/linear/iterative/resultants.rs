//! Stress resultants in circulant preconditioners: unknowns of their own, which motions determine.
//!
//! ```text
//! [S Bᵀ; L −1] [x; f] = [b; r]   ⇔   (S + Bᵀ L) x = b + Bᵀ r,   f = L x − r
//! ```
//!
//! and transposed, with `L` and `B` in each other's place,
//!
//! ```text
//! [Sᵀ Lᵀ; B −1] [x; f] = [b; r]   ⇔   (Sᵀ + Lᵀ B) x = b + Lᵀ r,   f = B x − r
//! ```
//!
//! with `B` and `L` averaged over time. They are worth their memory because averages of a bent
//! beam's stiffness, `Bᵀ L`, would stretch it where it bends. See docs/theory.md, section 8.4.

use super::mean::MeanStrain;
use super::transform::Transform;
use crate::collocation::{Aliasing, Collocation, Station, Tangent};
use crate::system::Layout;
use crate::workers::{Workers, parts};
use nalgebra::{Complex, Matrix6, Vector6};
use std::ops::Range;

/// Averaged `B` and `L`, scaled.
pub(super) struct Resultants {
    layout: Layout,
    stations: Vec<Station>,
    strains: Vec<MeanStrain>,
    /// Of each node: the stations whose resultants act on it, and its strains there.
    acting: Vec<Vec<(usize, usize)>>,
    /// Where those of each station are among all.
    places: Vec<Range<usize>>,
    /// Grid points, from the first on, at which forces on each node are told. See
    /// [`Collocation::told`].
    told: Vec<usize>,
    /// What counts as 1 in their unknowns.
    pub scale: f64,
    workers: Workers,
}

impl Resultants {
    /// Those of `tangent`.
    pub fn new(equations: &Collocation, tangent: &Tangent, strains: &[MeanStrain]) -> Self {
        let layout = equations.layout();
        let scales = tangent.resultant_scales(equations.system());
        let stations = tangent.stations().to_vec();
        let mut acting = vec![Vec::new(); equations.system().nodes()];
        let mut scaled = strains.to_vec();
        for (index, station) in stations.iter().enumerate() {
            for (a, &node) in station.nodes.iter().enumerate() {
                acting[node].push((index, station.first + a));
                let at = layout.motion(node, 0);
                let row_scale = &equations.row_scale()[at.clone()];
                let column_scale = &equations.column_scale()[at];
                let mean = &mut scaled[station.first + a];
                let by_scale = |m: &Matrix6<f64>| {
                    m.map_with_location(|i, j, x| x * column_scale[j] / scales[i])
                };
                mean.orders = [by_scale(&mean.orders[0]), by_scale(&mean.orders[1])];
                mean.strain = mean
                    .strain
                    .map_with_location(|i, j, x| x * row_scale[j] * scales[i]);
            }
        }
        let of_nodes = (0..acting.len()).map(|node| equations.told(&[node]).0);
        let of_stations = (0..stations.len()).map(|station| tangent.resultants_of(station));
        Resultants {
            places: of_stations.collect(),
            told: of_nodes.collect(),
            layout,
            stations,
            strains: scaled,
            acting,
            scale: 1.0,
            workers: equations.workers().clone(),
        }
    }

    /// Whether any depends on rates.
    pub fn damped(&self) -> bool {
        self.stations.iter().any(|station| station.damped)
    }

    /// `x += Bᵀ r`.
    pub fn add_forces(&self, r: &[f64], x: &mut [f64]) {
        let (motions, of_node) = (self.layout.motions(), self.layout.of_node());
        let mut rows: Vec<_> = x[motions].chunks_mut(of_node).collect();
        let add = |node: usize, forces: &mut [f64]| {
            let told = self.told[node];
            for &(station, strain) in &self.acting[node] {
                let to_force = self.strains[strain].strain.transpose() * self.scale;
                let r = r[self.places[station].clone()].chunks_exact(6);
                for (force, r) in forces.chunks_exact_mut(6).zip(r) {
                    let sum = to_force * Vector6::from_column_slice(r);
                    force.iter_mut().zip(&sum).for_each(|(y, f)| *y += f);
                }
            }
            // The other parts of the period have the same.
            let (told, others) = forces.split_at_mut(6 * told);
            let parts = others.chunks_exact_mut(told.len());
            parts.for_each(|part| part.copy_from_slice(told));
        };
        self.workers
            .each(&mut rows, |node, forces| add(node, forces));
    }

    /// `x += Lᵀ r`, but for what depends on rates, if anything does: that is written to `rates`, to
    /// be differentiated and subtracted.
    pub fn add_transposed(&self, r: &[f64], x: &mut [f64], rates: &mut [f64]) {
        let (motions, of_node) = (self.layout.motions(), self.layout.of_node());
        rates.fill(0.0);
        let by_order = [(0, &mut x[motions]), (1, rates)];
        for (order, sums) in by_order {
            let mut rows: Vec<_> = sums.chunks_mut(of_node).collect();
            self.workers.each(&mut rows, |node, forces| {
                for &(station, strain) in &self.acting[node] {
                    let to_force = self.strains[strain].orders[order].transpose() / self.scale;
                    let r = r[self.places[station].clone()].chunks_exact(6);
                    for (force, r) in forces.chunks_exact_mut(6).zip(r) {
                        let sum = to_force * Vector6::from_column_slice(r);
                        force.iter_mut().zip(&sum).for_each(|(y, f)| *y += f);
                    }
                }
            });
        }
    }

    /// Takes the derivatives of the series in `rates`, if there are any, from forces, and adds what
    /// the grid adds to rates of nodes (`aliasing`), transposed.
    pub fn subtract_slopes(
        &self,
        (rates, frequency): (&[f64], f64),
        aliasing: &[Vec<Aliasing>],
        x: &mut [f64],
        transform: &Transform,
        workspaces: &mut Vec<Transform>,
    ) {
        let of_node = self.layout.of_node();
        let points = of_node / 6;
        let mut parts: Vec<_> = x[..rates.len()].chunks_mut(of_node).collect();
        let new = || transform.clone();
        self.workers
            .for_each(&mut parts, workspaces, new, |transform, node, forces| {
                let rates = &rates[node * of_node..][..of_node];
                let mut highest = vec![Vector6::zeros(); aliasing[node].len()];
                let analyse = |transform: &mut Transform, component: usize| {
                    let series = rates[component..].iter().step_by(6);
                    transform.analysis.read(series.copied());
                };
                for component in 0..if highest.is_empty() { 0 } else { 6 } {
                    analyse(transform, component);
                    for (below, values) in highest.iter_mut().enumerate() {
                        values[component] = transform.analysis.spectrum[points / 2 - below];
                    }
                }
                for component in 0..6 {
                    analyse(transform, component);
                    let spectrum = transform.synthesis.spectrum.iter_mut();
                    let harmonics = spectrum.zip(&transform.analysis.spectrum);
                    for (j, (slope, value)) in harmonics.enumerate() {
                        *slope = value * Complex::new(0.0, frequency * j as f64);
                    }
                    for (below, (values, added)) in highest.iter().zip(&aliasing[node]).enumerate()
                    {
                        let by_velocity = added.velocity.column(component).dotc(values);
                        transform.synthesis.spectrum[points / 2 - below] -= by_velocity;
                    }
                    let series = forces[component..].iter_mut().step_by(6);
                    let slopes = series.zip(transform.backward());
                    slopes.for_each(|(force, slope)| *force -= slope / points as f64);
                }
            });
    }

    /// `r = B x − r`.
    pub fn determine_transposed(&self, x: &[f64], r: &mut [f64]) {
        let mut all = self.by_station(r);
        self.workers.each(&mut all, |index, series| {
            let station = &self.stations[index];
            for (k, r) in series.chunks_exact_mut(6).enumerate() {
                let mut sum = Vector6::zeros();
                for (&node, mean) in station.nodes.iter().zip(&self.strains[station.first..]) {
                    let u = Vector6::from_column_slice(&x[self.layout.motion(node, k)]);
                    sum += mean.strain * u;
                }
                r.iter_mut()
                    .zip(&sum)
                    .for_each(|(r, e)| *r = e * self.scale - *r);
            }
        });
    }

    /// `r = L x − r`, for the derivatives of `x` at the same places, if any resultant depends on
    /// them.
    pub fn determine(&self, x: &[f64], rates: &[f64], r: &mut [f64]) {
        let of_node = |x: &[f64], node: usize, k: usize| {
            Vector6::from_column_slice(&x[self.layout.motion(node, k)])
        };
        let determine = |index: usize, series: &mut [f64]| {
            let station = &self.stations[index];
            for (k, r) in series.chunks_exact_mut(6).enumerate() {
                let mut sum = Vector6::zeros();
                for (&node, mean) in station.nodes.iter().zip(&self.strains[station.first..]) {
                    sum += mean.orders[0] * of_node(x, node, k);
                    if station.damped {
                        sum += mean.orders[1] * of_node(rates, node, k);
                    }
                }
                r.iter_mut()
                    .zip(&sum)
                    .for_each(|(r, f)| *r = f / self.scale - *r);
            }
        };
        let mut all = self.by_station(r);
        self.workers.each(&mut all, |index, r| determine(index, r));
    }

    /// All resultants, station by station.
    fn by_station<'r>(&self, r: &'r mut [f64]) -> Vec<&'r mut [f64]> {
        parts(r, self.places.iter().map(Range::len)).collect()
    }
}
