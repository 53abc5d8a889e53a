//! Preconditioners spread over ranks are those of one.

use super::factors::Factors;
use super::interface::{Bounds, LEFT_OUT};
use super::{Preconditioner, Spread, SpreadFactors, Tangent};
use crate::collocation::{Collocation, GridState, Item, Partition};
use crate::fourier::TimeGrid;
use crate::model::Model;
use crate::ranks::threads::on_ranks;
use crate::system::System;
use crate::test_models::beams::rotor;
use crate::test_models::small::{crank_rocker, one_blade};
use std::ops::Range;
use std::sync::Arc;

const POINTS: usize = 19;

fn wave(i: usize) -> f64 {
    (0.37 * i as f64 + 0.2).sin()
}

/// The solution of a preconditioner's equations on so many ranks, and on one.
fn solved(model: &Model, period: f64, which: Preconditioner, count: usize) -> [Vec<f64>; 2] {
    let whole = Arc::new(System::new(model, period).unwrap());
    let grid = TimeGrid::new(POINTS, period).unwrap();
    let mut equations = Collocation::new(whole.clone(), grid).unwrap();
    // A smooth motion.
    let layout = equations.layout();
    let mut increment = vec![0.0; equations.size()];
    for node in 0..whole.nodes() {
        for k in 0..POINTS {
            let phase = std::f64::consts::TAU * k as f64 / POINTS as f64;
            for (i, place) in layout.motion(node, k).enumerate() {
                increment[place] =
                    0.05 * equations.column_scale()[place] * (phase + i as f64).sin();
            }
        }
    }
    let state = GridState::reference(&whole, grid).incremented(&whole, &increment, 1.0);
    let mut tangent = Tangent::with_resultants_apart(&whole, POINTS);
    tangent.evaluate(&mut equations, &state).unwrap();
    let behind = match SpreadFactors::keeps_resultants(which) {
        true => tangent.resultants(),
        false => 0,
    };
    let right: Vec<f64> = (0..equations.size() + behind).map(wave).collect();
    let bounds = Bounds {
        most_work: f64::INFINITY,
        any_band: true,
        left_out: LEFT_OUT,
    };
    let mut factors = Factors::new(&equations, &tangent, which, (bounds, false))
        .unwrap()
        .unwrap();
    let mut alone = right.clone();
    factors.apply(&mut alone, equations.size());

    let partition = Partition::even(&whole, count).unwrap();
    let parts = on_ranks(count, |ranks| {
        let part = partition.part(&whole, ranks.rank());
        let mut own = Collocation::new(part.system.clone(), grid).unwrap();
        let mut own_state = GridState::at_points(&part.system, POINTS);
        for (local, &node) in part.nodes.iter().enumerate() {
            own_state.motions[local * POINTS..][..POINTS].copy_from_slice(state.node(node));
        }
        own_state.coordinates.clone_from(&state.coordinates);
        let mut tangent = Tangent::with_resultants_apart(&part.system, POINTS);
        tangent.evaluate(&mut own, &own_state).unwrap();
        let spread = Spread {
            ranks: &ranks,
            whole: &whole,
            partition: &partition,
            part: &part,
            equations: &own,
            tangent: &tangent,
            state: &own_state,
            coordinates: &state.coordinates,
        };
        let (size, all) = (own.size(), equations.size());
        // Places in the part, and in the whole.
        let places = |item: Item| -> Vec<[Range<usize>; 2]> {
            let stations = |first: usize, s: &Range<usize>| {
                first + 6 * POINTS * s.start..first + 6 * POINTS * s.end
            };
            match item {
                Item::Node(node) => {
                    let local = part.nodes.binary_search(&node).unwrap();
                    vec![[own.layout().node(local), layout.node(node)]]
                }
                Item::Element(index) => {
                    let local = part.elements.binary_search(&index).unwrap();
                    let (here, there) = (&part.system.elements()[local], &whole.elements()[index]);
                    let mut both = vec![[own.layout().element(here), layout.element(there)]];
                    if behind > 0 {
                        both.push([
                            stations(size, &here.stations),
                            stations(all, &there.stations),
                        ]);
                    }
                    both
                }
            }
        };
        let local = |item: Item| places(item).into_iter().map(|[here, _]| here).collect();
        let mut halo = partition.halo(&whole, ranks.rank(), local);
        let items = part.own_nodes.iter().map(|&l| Item::Node(part.nodes[l]));
        let elements = part
            .own_elements
            .iter()
            .map(|&l| Item::Element(part.elements[l]));
        let owned: Vec<_> = items.chain(elements).flat_map(places).collect();
        let mut x = vec![0.0; size + if behind > 0 { tangent.resultants() } else { 0 }];
        for [here, there] in &owned {
            x[here.clone()].copy_from_slice(&right[there.clone()]);
        }
        let mut factors = SpreadFactors::new(spread, which).unwrap().unwrap();
        factors.apply(&mut x, &mut halo).unwrap();
        let values = owned
            .into_iter()
            .map(|[here, there]| (there, x[here].to_vec()));
        values.collect::<Vec<_>>()
    });
    let mut together = vec![f64::NAN; right.len()];
    for (range, values) in parts.into_iter().flatten() {
        together[range].copy_from_slice(&values);
    }
    [together, alone]
}

#[test]
fn spread_preconditioners_are_those_of_one_rank() {
    use Preconditioner::{BodyCirculant, Circulant, TimeLocal};
    // With joints that turn and without, with stress resultants that depend on rates and without.
    let models = [crank_rocker(2, 2, 3.0), one_blade(2), rotor(2)];
    for (model, period) in &models {
        for which in [TimeLocal, BodyCirculant, Circulant] {
            for count in [1, 2, 3] {
                let [found, expected] = solved(model, *period, which, count);
                let norm = |x: &[f64]| x.iter().map(|x| x * x).sum::<f64>().sqrt();
                let difference: Vec<f64> =
                    found.iter().zip(&expected).map(|(a, b)| a - b).collect();
                let error = norm(&difference) / norm(&expected);
                // Rounding in systems whose condition is about 1e6.
                assert!(error < 1e-8, "{which:?} on {count} ranks: {error:e}");
            }
        }
    }
}
