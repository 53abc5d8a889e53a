//! Which tangents there are, for all grid points.

use crate::collocation::coupling::Couplings;
use crate::elements::StressLaw;
use crate::system::System;
use std::ops::Range;

/// Where an element's tangents go.
#[derive(Debug, Clone)]
pub(super) struct ElementPlace {
    /// Each pair of its nodes that it couples, row by row, their coupling, and whether no element
    /// before it has a part in that.
    pub couplings: Vec<((usize, usize), usize, bool)>,
    /// Its stations' strain tangents at a grid point.
    pub strains: Range<usize>,
}

/// A station of an element, with stress resultants.
#[derive(Debug, Clone)]
pub struct Station {
    /// Their law.
    pub law: StressLaw,
    /// Whether they depend on rates.
    pub damped: bool,
    /// Nodes of the element.
    pub nodes: Vec<usize>,
    /// Its first strain tangent at a grid point: one for each of the nodes.
    pub first: usize,
    /// Coupling of each pair of the nodes, row by row.
    pub couplings: Vec<usize>,
}

impl Station {
    /// The first strain tangent of another station of the element, so many further.
    pub fn first_of(&self, offset: isize) -> usize {
        self.first
            .saturating_add_signed(offset * self.nodes.len() as isize)
    }
}

/// Which tangents there are.
#[derive(Debug, Clone)]
pub(super) struct TangentLayout {
    pub couplings: Couplings,
    pub places: Vec<ElementPlace>,
    /// Those whose stress resultants are kept apart.
    pub stations: Vec<Station>,
    /// Strain tangents at a grid point.
    pub strains: usize,
    /// Of each node: the stations whose resultants act on it, and its strain tangents there.
    pub acting: Vec<Vec<(usize, usize)>>,
    /// Of each coupling: the stations that it is a part of, and the strain tangents of its row and
    /// column there.
    pub within: Vec<Vec<(usize, usize, usize)>>,
}

impl TangentLayout {
    /// That of a system, with stress resultants apart or not.
    pub fn new(system: &System, resultants_apart: bool) -> Self {
        let couplings = Couplings::new(system);
        let count = couplings.all().len();
        let mut layout = TangentLayout {
            couplings,
            places: Vec::new(),
            stations: Vec::new(),
            strains: 0,
            acting: vec![Vec::new(); system.nodes()],
            within: vec![Vec::new(); count],
        };
        let mut begun = vec![false; count];
        for placed in system.elements() {
            let nodes = placed.element.nodes();
            let coupled = placed.element.couples_nodes();
            let pairs = (0..nodes.len()).flat_map(|a| (0..nodes.len()).map(move |b| (a, b)));
            let pairs: Vec<_> = pairs.filter(|(a, b)| coupled || a == b).collect();
            let number = |(a, b): (usize, usize)| layout.couplings.number(nodes[a], nodes[b]);
            let numbers: Vec<usize> = pairs.iter().map(|&pair| number(pair)).collect();
            let first = layout.strains;
            let laws = match resultants_apart {
                true => placed.element.stress_laws(),
                false => Vec::new(),
            };
            for law in laws {
                layout.add_station(Station {
                    law,
                    damped: placed.element.has_damping(),
                    nodes: nodes.to_vec(),
                    first: layout.strains,
                    couplings: numbers.clone(),
                });
            }
            let begins = |(pair, number): (_, usize)| {
                (pair, number, !std::mem::replace(&mut begun[number], true))
            };
            layout.places.push(ElementPlace {
                couplings: pairs.into_iter().zip(numbers).map(begins).collect(),
                strains: first..layout.strains,
            });
        }
        layout
    }

    fn add_station(&mut self, station: Station) {
        let (index, count) = (self.stations.len(), station.nodes.len());
        for (a, &node) in station.nodes.iter().enumerate() {
            self.acting[node].push((index, station.first + a));
            for b in 0..count {
                let pair = (index, station.first + a, station.first + b);
                self.within[station.couplings[a * count + b]].push(pair);
            }
        }
        self.strains += count;
        self.stations.push(station);
    }
}
