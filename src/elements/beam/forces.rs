//! Forces and tangents of a beam element, summed over its Gauss points.

use super::Beam;
use super::law::CoupledLaw;
use super::material::{Damping, add_material_stiffness};
use super::station::Station;
use super::two_nodes::TwoNodes;
use crate::elements::line_station::{
    NodePlace, NodeTerms, SecondTerms, StationMotion, geometric_stiffness, rate_variations,
    relative_to_first, second_variations,
};
use crate::elements::{Contribution, Element, Instant, NodeState, StrainTangent, StressLaw};
use crate::error::Result;
use crate::motion::{DualMatrix, DualVector, product, vectorised};
use nalgebra::Vector6;
use std::ops::Range;

/// Scratch for what the element finds at its stations.
#[derive(Debug, Clone, Default)]
pub(in crate::elements) struct Scratch {
    /// Motions of the nodes relative to the first.
    pub(super) relative: Vec<DualMatrix>,
    /// Of the nodes, station by station.
    places: Vec<NodePlace>,
    motions: Vec<StationMotion>,
    /// Of the nodes, at one station.
    terms: Vec<NodeTerms>,
    second: Vec<SecondTerms>,
    /// Of the nodes, station by station.
    pub(super) variations: Vec<StrainTangent>,
    pub(super) strains: Vec<Vector6<f64>>,
    pub(super) rates: Vec<Vector6<f64>>,
}

impl Scratch {
    /// Begins anew with the nodes at `states`.
    pub(super) fn begin(&mut self, states: &[NodeState]) {
        self.relative.clear();
        // Two nodes have their own, see [`TwoNodes`].
        if states.len() > 2 {
            let motions = states.iter().map(|state| &state.motion);
            self.relative.extend(relative_to_first(motions));
        }
        self.motions.clear();
        self.strains.clear();
        self.rates.clear();
        self.forget_station();
    }

    /// Forgets the nodes' places and terms at stations so far.
    fn forget_station(&mut self) {
        self.places.clear();
        self.variations.clear();
    }

    /// Appends the places of the nodes seen from a station.
    fn add_places(&mut self, station: &Station) -> Result<StationMotion> {
        let at = station.line.motion(&self.relative)?;
        self.places.extend(station.line.places(&at, &self.relative));
        Ok(at)
    }

    /// Appends what strains vary by, with their rate if that varies, for nodes in these places.
    fn add_variations(
        &mut self,
        at: &StationMotion,
        places: Range<usize>,
        (states, rate): (&[NodeState], Option<&DualVector>),
    ) {
        let places = &self.places[places];
        self.terms.clear();
        self.terms.extend(at.node_terms(places.iter().copied()));
        if let Some(rate) = rate {
            rate_variations(at, rate, twists_of(states), places, &mut self.terms);
        }
        self.variations
            .extend(self.terms.iter().map(|node| StrainTangent {
                strain: node.strain,
                rate: node.rate,
            }));
    }

    /// The same, and adds the geometric stiffness of these resultants.
    fn add_tangents(
        &mut self,
        at: &StationMotion,
        places: Range<usize>,
        (stress, states, rate): (&DualVector, &[NodeState], Option<&DualVector>),
        out: &mut Contribution,
    ) {
        self.add_variations(at, places.clone(), (states, rate));
        let nodes = self.places[places].iter().zip(&self.terms);
        self.second.clear();
        self.second.extend(second_variations(at, stress, nodes));
        geometric_stiffness(&self.terms, &self.second, |a, b, block| {
            out.add_stiffness(a, b, block);
        });
    }
}

impl Element for Beam {
    fn nodes(&self) -> &[usize] {
        &self.nodes
    }

    fn has_damping(&self) -> bool {
        self.damped
    }

    fn stress_laws(&self) -> Vec<StressLaw> {
        if let Some(law) = &self.law {
            return law.stress_laws();
        }
        let own = |station: &Station| {
            let (stiffness, damping) = station.own_law();
            StressLaw {
                stiffness,
                damping,
                others: Vec::new(),
            }
        };
        self.stations.iter().map(own).collect()
    }

    fn stress_resultants(
        &self,
        nodes: &[NodeState],
        scratch: &mut Contribution,
        out: &mut [Vector6<f64>],
    ) -> Result<()> {
        let scratch = &mut scratch.scratch.beam;
        self.find_strains(nodes, scratch)?;
        self.write_resultants(scratch, out);
        Ok(())
    }

    /// None if its material spins with damping, which then acts at rest, too.
    fn potential(&self, instant: &Instant, scratch: &mut Contribution) -> Result<Option<f64>> {
        if self.damped && self.spin != 0.0 {
            return Ok(None);
        }
        let scratch = &mut scratch.scratch.beam;
        self.find_strains(instant.nodes, scratch)?;
        scratch.rates.fill(Vector6::zeros());
        let of_station = |(i, station): (usize, &Station)| {
            let stress = self.resultants(i, &scratch.strains, &scratch.rates);
            0.5 * station.weight * scratch.strains[i].dot(&stress)
        };
        let all = self.stations.iter().enumerate();
        Ok(Some(all.map(of_station).sum()))
    }

    fn extrapolate_resultants(
        &self,
        nodes: &[NodeState],
        increments: &[[Vector6<f64>; 2]],
        scratch: &mut Contribution,
        out: &mut [Vector6<f64>],
    ) -> Result<()> {
        let scratch = &mut scratch.scratch.beam;
        scratch.begin(nodes);
        let rates_vary = self.damping(nodes).rates_vary;
        for station in &self.stations {
            let (mut e, mut rate) = self.find_variations(station, nodes, scratch)?;
            for (node, [motion, velocity]) in scratch.variations.iter().zip(increments) {
                let motion = DualVector::from_twist(motion);
                e += node.strain * motion;
                rate += node.strain * DualVector::from_twist(velocity);
                if rates_vary {
                    rate += node.rate * motion;
                }
            }
            scratch.strains.push(e.to_twist() - station.reference);
            scratch.rates.push(rate.to_twist());
        }
        self.write_resultants(scratch, out);
        Ok(())
    }

    fn add_forces_of_resultants(
        &self,
        nodes: &[NodeState],
        resultants: &[Vector6<f64>],
        out: &mut Contribution,
    ) -> Result<()> {
        if let [first, second] = nodes {
            let between = TwoNodes::new([first, second])?;
            let stress = resultants[0] * self.stations[0].weight;
            add_forces(between.forces(&DualVector::from_wrench(&stress)), out);
            return Ok(());
        }
        let mut scratch = std::mem::take(&mut out.scratch.beam);
        scratch.begin(nodes);
        for (station, resultants) in self.stations.iter().zip(resultants) {
            scratch.forget_station();
            let at = scratch.add_places(station)?;
            let stress = DualVector::from_wrench(&(resultants * station.weight));
            add_forces(at.node_forces(&stress, scratch.places.iter()), out);
        }
        out.scratch.beam = scratch;
        Ok(())
    }

    fn evaluate(&self, instant: &Instant, out: &mut Contribution) -> Result<()> {
        if let [first, second] = instant.nodes {
            return vectorised(
                #[inline(always)]
                || self.add_two_nodes([first, second], instant, out),
            );
        }
        // Taken out while `out` is written to.
        let mut scratch = std::mem::take(&mut out.scratch.beam);
        scratch.begin(instant.nodes);
        let result = match &self.law {
            Some(law) => self.add_coupled(law, instant, &mut scratch, out),
            None => self.add_stations(instant, &mut scratch, out),
        };
        out.scratch.beam = scratch;
        result
    }
}

/// The nodes' velocities.
fn twists_of(states: &[NodeState]) -> impl Fn(usize) -> DualVector {
    |a| DualVector::from_twist(&states[a].twist)
}

/// Those of two.
fn twists_of_two(states: &[NodeState]) -> [DualVector; 2] {
    [0, 1].map(twists_of(states))
}

impl Beam {
    /// Finds "velocities in ξ" at the Gauss points, less those of the reference, and their rates,
    /// if resultants depend on them.
    pub(super) fn find_strains(&self, states: &[NodeState], scratch: &mut Scratch) -> Result<()> {
        scratch.begin(states);
        let has_rates = self.damping(states).rates_vary;
        for station in &self.stations {
            let (e, rate) = if let [first, second] = states {
                let between = TwoNodes::new([first, second])?;
                let rate = match has_rates {
                    true => between.strain_rate(twists_of_two(states)),
                    false => DualVector::zeros(),
                };
                (between.e, rate)
            } else if has_rates {
                scratch.forget_station();
                let at = scratch.add_places(station)?;
                (at.e, at.strain_rate(&scratch.places, twists_of(states)))
            } else {
                (
                    station.line.motion(&scratch.relative)?.e,
                    DualVector::zeros(),
                )
            };
            scratch.strains.push(e.to_twist() - station.reference);
            scratch.rates.push(rate.to_twist());
        }
        Ok(())
    }

    /// Finds what strains vary by at a station, with its "velocity in ξ" and its rate. Scratch has
    /// begun with these states.
    pub(super) fn find_variations(
        &self,
        station: &Station,
        states: &[NodeState],
        scratch: &mut Scratch,
    ) -> Result<(DualVector, DualVector)> {
        let rates_vary = self.damping(states).rates_vary;
        scratch.forget_station();
        if let [first, second] = states {
            let (between, twists) = (TwoNodes::new([first, second])?, twists_of_two(states));
            let variations = between.variations(rates_vary.then_some(twists));
            scratch.variations.extend(variations);
            return Ok((between.e, between.strain_rate(twists)));
        }
        let at = scratch.add_places(station)?;
        let rate = at.strain_rate(&scratch.places, twists_of(states));
        let varying = rates_vary.then_some(&rate);
        scratch.add_variations(&at, 0..states.len(), (states, varying));
        Ok((at.e, rate))
    }

    /// Writes the stress resultants at all Gauss points, for strains and rates that were found.
    fn write_resultants(&self, scratch: &Scratch, out: &mut [Vector6<f64>]) {
        for (i, resultants) in out.iter_mut().enumerate() {
            *resultants = self.resultants(i, &scratch.strains, &scratch.rates);
        }
    }

    fn damping(&self, states: &[NodeState]) -> Damping {
        let moves = states.iter().any(|state| state.twist != Vector6::zeros());
        Damping {
            damped: self.damped,
            rates_vary: self.damped && moves,
            symmetric: !self.damped || !moves && self.spin == 0.0,
        }
    }

    /// Forces and tangents of an element with two nodes, and so one station.
    #[inline(always)]
    fn add_two_nodes(
        &self,
        nodes: [&NodeState; 2],
        instant: &Instant,
        out: &mut Contribution,
    ) -> Result<()> {
        let (station, damping) = (&self.stations[0], self.damping(instant.nodes));
        let law = match &self.law {
            Some(law) => law.row(0)[0],
            None => station.own_law(),
        };
        let between = TwoNodes::new(nodes)?;
        let twists = twists_of_two(instant.nodes);
        let mut stress = product(&law.0, &(between.e.to_twist() - station.reference));
        if self.damped {
            stress += product(&law.1, &between.strain_rate(twists).to_twist());
        }
        add_forces(between.forces(&DualVector::from_wrench(&stress)), out);
        if out.with_tangents {
            let held = held_resultants(instant, 0, station, stress);
            let variations = between.variations(damping.rates_vary.then_some(twists));
            between.geometric_stiffness(&held, &variations, |a, b, block| {
                out.add_stiffness(a, b, block);
            });
            add_material_stiffness(&variations, &[law], &variations, damping, out);
        }
        Ok(())
    }

    /// Forces and tangents where each station has its own law.
    fn add_stations(
        &self,
        instant: &Instant,
        scratch: &mut Scratch,
        out: &mut Contribution,
    ) -> Result<()> {
        let states = instant.nodes;
        let damping = self.damping(states);
        for (place, station) in self.stations.iter().enumerate() {
            scratch.forget_station();
            let at = scratch.add_places(station)?;
            let section = &station.section;
            let mut stress = product(&section.stiffness, &station.strain(&at.e));
            let mut rate = DualVector::zeros();
            if self.damped {
                rate = at.strain_rate(&scratch.places, twists_of(states));
                stress += product(&section.damping, &(rate.to_twist() / station.stretch));
            }
            let stress = stress * station.weight;
            let wrench = DualVector::from_wrench(&stress);
            add_forces(at.node_forces(&wrench, scratch.places.iter()), out);
            if !out.with_tangents {
                continue;
            }
            let held = held_resultants(instant, place, station, stress);
            let rate = damping.rates_vary.then_some(&rate);
            scratch.add_tangents(&at, 0..states.len(), (&held, states, rate), out);
            let variations = &scratch.variations[..];
            let law = [station.own_law()];
            vectorised(
                #[inline(always)]
                || add_material_stiffness(variations, &law, variations, damping, out),
            );
        }
        Ok(())
    }

    /// Forces and tangents where resultants depend on the strains of all stations.
    fn add_coupled(
        &self,
        law: &CoupledLaw,
        instant: &Instant,
        scratch: &mut Scratch,
        out: &mut Contribution,
    ) -> Result<()> {
        let (states, count) = (instant.nodes, self.nodes.len());
        let damping = self.damping(states);
        for (place, station) in self.stations.iter().enumerate() {
            let at = scratch.add_places(station)?;
            let places = &scratch.places[place * count..];
            let rate = at.strain_rate(places, twists_of(states));
            scratch.strains.push(at.e.to_twist() - station.reference);
            scratch.rates.push(rate.to_twist());
            scratch.motions.push(at);
        }
        for (place, station) in self.stations.iter().enumerate() {
            let stress = law.resultants(place, &scratch.strains, &scratch.rates);
            let places = place * count..(place + 1) * count;
            let at = scratch.motions[place].clone();
            let wrench = DualVector::from_wrench(&stress);
            add_forces(
                at.node_forces(&wrench, scratch.places[places.clone()].iter()),
                out,
            );
            if !out.with_tangents {
                continue;
            }
            let held = held_resultants(instant, place, station, stress);
            let rate = DualVector::from_twist(&scratch.rates[place]);
            let rate = damping.rates_vary.then_some(&rate);
            scratch.add_tangents(&at, places, (&held, states, rate), out);
        }
        if out.with_tangents {
            for (place, rows) in scratch.variations.chunks_exact(count).enumerate() {
                let (laws, columns) = (law.row(place), &scratch.variations[..]);
                vectorised(
                    #[inline(always)]
                    || add_material_stiffness(rows, laws, columns, damping, out),
                );
            }
        }
        Ok(())
    }
}

/// Integrated resultants that the geometric stiffness of a station is taken at: those of `stress`,
/// unless others are given.
fn held_resultants(
    instant: &Instant,
    place: usize,
    station: &Station,
    stress: Vector6<f64>,
) -> DualVector {
    let given = instant.resultants.get(place);
    DualVector::from_wrench(&given.map_or(stress, |resultants| resultants * station.weight))
}

/// Adds forces on the nodes, one after the other.
#[inline(always)]
fn add_forces(forces: impl IntoIterator<Item = DualVector>, out: &mut Contribution) {
    for (a, force) in forces.into_iter().enumerate() {
        out.add_force(a, &force.to_wrench());
    }
}
