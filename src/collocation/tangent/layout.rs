//! Which tangents there are, for all grid points.

use crate::collocation::coupling::Couplings;
use crate::elements::StressLaw;
use crate::system::System;
use std::ops::Range;

/// Where what belongs to one thing after the other begins, at one grid point after the other: at as
/// many as tell it.
#[derive(Debug, Clone, Default)]
pub(super) struct Told {
    first: Vec<usize>,
}

impl Told {
    fn new(counts: impl Iterator<Item = usize>) -> Self {
        let mut told = Told { first: vec![0] };
        let mut end = 0;
        told.first.extend(counts.map(|count| {
            end += count;
            end
        }));
        told
    }

    /// Where a thing is, at the grid points that tell it.
    pub fn of(&self, thing: usize) -> Range<usize> {
        self.of_all(thing..thing + 1)
    }

    /// The same of several.
    pub fn of_all(&self, things: Range<usize>) -> Range<usize> {
        self.first[things.start]..self.first[things.end]
    }

    /// How much all are.
    pub fn total(&self) -> usize {
        self.first.last().copied().unwrap_or(0)
    }
}

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
    /// Where couplings, strain tangents and stations are over the grid.
    pub coupling_at: Told,
    pub strain_at: Told,
    pub station_at: Told,
    /// Of each node: the stations whose resultants act on it, and its strain tangents there.
    pub acting: Vec<Vec<(usize, usize)>>,
    /// Of each coupling: the stations that it is a part of, and the strain tangents of its row and
    /// column there.
    pub within: Vec<Vec<(usize, usize, usize)>>,
    /// Couplings that no element has: of nodes without any.
    pub bare: Vec<usize>,
}

impl TangentLayout {
    /// That of a system, with stress resultants apart or not; `told` says at how many grid points,
    /// from the first on, what acts between nodes is told.
    pub fn new(system: &System, resultants_apart: bool, told: &dyn Fn(&[usize]) -> usize) -> Self {
        let couplings = Couplings::new(system);
        let count = couplings.all().len();
        let mut layout = TangentLayout {
            couplings,
            places: Vec::new(),
            stations: Vec::new(),
            strains: 0,
            coupling_at: Told::default(),
            strain_at: Told::default(),
            station_at: Told::default(),
            acting: vec![Vec::new(); system.nodes()],
            within: vec![Vec::new(); count],
            bare: Vec::new(),
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
        layout.bare = (0..count).filter(|&number| !begun[number]).collect();
        let couplings = layout.couplings.all().iter();
        layout.coupling_at = Told::new(couplings.map(|c| told(&[c.row, c.column])));
        let stations = layout.stations.iter();
        let counts = stations.map(|station| (station.nodes.len(), told(&station.nodes)));
        let counts: Vec<_> = counts.collect();
        layout.station_at = Told::new(counts.iter().map(|&(_, told)| told));
        let of_strains = |&(nodes, told): &(usize, usize)| std::iter::repeat_n(told, nodes);
        layout.strain_at = Told::new(counts.iter().flat_map(of_strains));
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
