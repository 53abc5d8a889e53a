//! A system divided among ranks, by nodes: each rank keeps the whole time histories of its nodes.
//!
//! A rank evaluates all elements that act on its nodes, those on a cut as their other ranks do too.
//! For that it keeps copies of what else these elements need, its halo: their other nodes, and
//! their own unknowns. Own unknowns of an element (multipliers, internal states), and its stress
//! resultants where they are unknowns, belong to the rank of the first of its nodes; those of one
//! without nodes to the first rank.

use super::division::ranges_of_even_work;
use crate::error::{Error, Result};
use crate::ranks::Ranks;
use crate::system::{Placed, System};
use std::collections::BTreeSet;
use std::ops::Range;
use std::sync::Arc;

/// Which rank each node belongs to.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Partition {
    owners: Vec<usize>,
    ranks: usize,
}

/// The part of a system that a rank works on.
#[derive(Debug, Clone)]
pub struct RankPart {
    /// It, as a system with numbers of its own.
    pub system: Arc<System>,
    /// Nodes of the whole that are there, in ascending order: the rank's own and those of its halo.
    pub nodes: Vec<usize>,
    /// Elements of the whole that are there.
    pub elements: Vec<usize>,
    /// Places of the rank's own nodes among these.
    pub own_nodes: Vec<usize>,
    /// Likewise of the elements whose own unknowns belong to it.
    pub own_elements: Vec<usize>,
}

/// What a rank has unknowns of: a node, or an element, of the whole.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Item {
    /// Motions of a node.
    Node(usize),
    /// Own unknowns of an element.
    Element(usize),
}

impl Partition {
    /// Among so many ranks, with runs of nodes that have about the same work.
    ///
    /// # Errors
    /// If there are more ranks than nodes.
    pub fn even(system: &System, ranks: usize) -> Result<Self> {
        let mut owners = Vec::with_capacity(system.nodes());
        for (rank, nodes) in ranges_of_even_work(system, ranks).into_iter().enumerate() {
            owners.extend(nodes.map(|_| rank));
        }
        Self::given(system, ranks, owners)
    }

    /// With the rank of each node.
    ///
    /// # Errors
    /// If there is not one for each node, or a rank has no node.
    pub fn given(system: &System, ranks: usize, owners: Vec<usize>) -> Result<Self> {
        if ranks == 0 {
            return Err(Error::value("ranks", "at least one", ranks));
        }
        if ranks > system.nodes() {
            let expected = format!("at most {}, one for each node", system.nodes());
            return Err(Error::value("ranks", expected, ranks));
        }
        if owners.len() != system.nodes() {
            return Err(Error::size("owners", system.nodes(), owners.len()));
        }
        let mut nodes = vec![0; ranks];
        for (node, &owner) in owners.iter().enumerate() {
            match nodes.get_mut(owner) {
                Some(count) => *count += 1,
                None => {
                    let name = format!("owners[{node}]");
                    return Err(Error::value(&name, format!("a rank below {ranks}"), owner));
                }
            }
        }
        if let Some(empty) = nodes.iter().position(|count| *count == 0) {
            let got = format!("none for rank {empty}");
            return Err(Error::value("owners", "a node for each rank", got));
        }
        Ok(Partition { owners, ranks })
    }

    /// Rank that each node belongs to.
    pub fn owners(&self) -> &[usize] {
        &self.owners
    }

    /// Rank that own unknowns of an element belong to.
    pub fn of_element(&self, placed: &Placed) -> usize {
        let first = placed.element.nodes().first();
        first.map_or(0, |&node| self.owners[node])
    }

    /// Ranks that evaluate an element.
    fn of_evaluation(&self, placed: &Placed) -> BTreeSet<usize> {
        let nodes = placed.element.nodes().iter().map(|&n| self.owners[n]);
        nodes.chain([self.of_element(placed)]).collect()
    }

    /// The part of a rank.
    pub fn part(&self, system: &System, rank: usize) -> RankPart {
        let mut nodes: BTreeSet<usize> = (0..system.nodes())
            .filter(|&n| self.owners[n] == rank)
            .collect();
        let mut elements = Vec::new();
        for (index, placed) in system.elements().iter().enumerate() {
            if self.of_evaluation(placed).contains(&rank) {
                nodes.extend(placed.element.nodes());
                elements.push(index);
            }
        }
        let nodes: Vec<usize> = nodes.into_iter().collect();
        let is_own = |&place: &usize| self.owners[nodes[place]] == rank;
        let own = |&place: &usize| self.of_element(&system.elements()[elements[place]]) == rank;
        RankPart {
            own_nodes: (0..nodes.len()).filter(is_own).collect(),
            own_elements: (0..elements.len()).filter(own).collect(),
            system: Arc::new(system.part(&nodes, &elements)),
            nodes,
            elements,
        }
    }

    /// What a rank sends to each, and receives from each, of its halo: in the same order on both
    /// sides.
    fn traffic(&self, system: &System, rank: usize) -> [Vec<BTreeSet<Item>>; 2] {
        let mut both = [
            vec![BTreeSet::new(); self.ranks],
            vec![BTreeSet::new(); self.ranks],
        ];
        for (index, placed) in system.elements().iter().enumerate() {
            let here = self.of_evaluation(placed);
            if here.len() == 1 {
                continue;
            }
            let nodes = placed.element.nodes().iter();
            let nodes = nodes.map(|&node| (Item::Node(node), self.owners[node]));
            let own = (Item::Element(index), self.of_element(placed));
            for (item, owner) in nodes.chain([own]) {
                for &other in here.iter().filter(|&&other| other != owner) {
                    if owner == rank {
                        both[0][other].insert(item);
                    } else if other == rank {
                        both[1][owner].insert(item);
                    }
                }
            }
        }
        both
    }

    /// The halo of a rank, in vectors that have an item at these `places`.
    pub fn halo(
        &self,
        system: &System,
        rank: usize,
        places: impl Fn(Item) -> Vec<Range<usize>>,
    ) -> Halo {
        let [sent, received] = self.traffic(system, rank).map(|traffic| {
            let places = |items: &BTreeSet<Item>| items.iter().flat_map(|i| places(*i)).collect();
            traffic
                .iter()
                .map(places)
                .collect::<Vec<Vec<Range<usize>>>>()
        });
        Halo {
            sent,
            received,
            letters: Default::default(),
        }
    }
}

/// Copies that ranks keep of what belongs to others.
#[derive(Debug, Clone)]
pub struct Halo {
    /// Places of what goes to each rank.
    sent: Vec<Vec<Range<usize>>>,
    /// And of what comes from each.
    received: Vec<Vec<Range<usize>>>,
    letters: [Vec<f64>; 2],
}

impl Halo {
    /// Writes what belongs to other ranks to its places among `values`. By all ranks.
    ///
    /// # Errors
    /// If numbers cannot be told.
    pub fn fill(&mut self, ranks: &dyn Ranks, values: &mut [f64]) -> Result<()> {
        let count = |places: &[Vec<Range<usize>>]| -> Vec<usize> {
            let numbers = |ranges: &Vec<Range<usize>>| ranges.iter().map(Range::len).sum();
            places.iter().map(numbers).collect()
        };
        let (sent, received) = (count(&self.sent), count(&self.received));
        let [send, receive] = &mut self.letters;
        send.clear();
        for range in self.sent.iter().flatten() {
            send.extend_from_slice(&values[range.clone()]);
        }
        receive.resize(received.iter().sum(), 0.0);
        ranks.exchange(send, &sent, receive, &received)?;
        let mut rest = &receive[..];
        for range in self.received.iter().flatten() {
            let (part, next) = rest.split_at(range.len());
            values[range.clone()].copy_from_slice(part);
            rest = next;
        }
        Ok(())
    }

    /// Places of the copies.
    pub fn received(&self) -> impl Iterator<Item = &Range<usize>> {
        self.received.iter().flatten()
    }
}
