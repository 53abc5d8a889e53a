//! Elements divided among threads.
//!
//! Each share is some of the nodes, with all elements that act on them: those between the nodes of
//! two shares are evaluated for both. So threads write nothing of each other's, and sums are over
//! the same elements in the same order, whatever the number of threads.

use crate::elements::Contribution;
use crate::system::System;
use crate::workers::{Workers, parts};
use std::ops::Range;

/// Multiply-adds of the evaluation of an element with its tangents, about.
const WORK: usize = 3000;
/// Shares for each thread, so that one that the system slows down can take fewer,
const SHARES: usize = 4;
/// where there are so many nodes for each share that few elements are evaluated twice.
const NODES: usize = 32;

/// All nodes in so many runs, if there are as many, that have about the same work each.
pub(super) fn ranges_of_even_work(system: &System, count: usize) -> Vec<Range<usize>> {
    // Work on an element goes with the square of its nodes.
    let mut work = vec![0; system.nodes()];
    for placed in system.elements() {
        let nodes = placed.element.nodes();
        nodes.iter().for_each(|&node| work[node] += nodes.len());
    }
    let total: usize = work.iter().sum();
    let mut ranges: Vec<Range<usize>> = Vec::with_capacity(count);
    let (mut first, mut done) = (0, 0);
    for (node, work) in work.iter().enumerate() {
        done += work;
        let left = system.nodes() - (node + 1);
        // None is left without nodes.
        let is_full = done * count >= total * (ranges.len() + 1);
        if left == 0 || (is_full || left < count - ranges.len()) && ranges.len() + 1 < count {
            ranges.push(first..node + 1);
            first = node + 1;
        }
    }
    ranges
}

/// Some of the nodes, and the elements that act on them.
#[derive(Debug, Clone)]
pub(super) struct Share {
    /// The nodes.
    pub nodes: Range<usize>,
    /// The elements, in ascending order.
    pub elements: Vec<usize>,
}

impl Share {
    /// Adds the forces of an element at grid point `k` of so many to those on its nodes that are of
    /// this share.
    #[inline]
    pub fn add_forces(
        &self,
        element: &Contribution,
        nodes: &[usize],
        (k, points): (usize, usize),
        forces: &mut [f64],
    ) {
        let of_nodes = element.force.as_slice().chunks_exact(6);
        for (node, force) in nodes.iter().zip(of_nodes) {
            if self.nodes.contains(node) {
                let place = (node - self.nodes.start) * points + k;
                let rows = &mut forces[6 * place..][..6];
                rows.iter_mut().zip(force).for_each(|(row, f)| *row += f);
            }
        }
    }
}

/// All nodes in shares, and the threads that work on them.
#[derive(Debug, Clone)]
pub(super) struct Division {
    pub workers: Workers,
    pub shares: Vec<Share>,
    /// Share that has the own unknowns of each element.
    owners: Vec<usize>,
}

impl Division {
    /// Divides the work on a grid of so many points, if that pays.
    pub fn new(system: &System, points: usize, workers: &Workers) -> Self {
        let elements = system.elements();
        let workers = system
            .element_workers(workers)
            .for_work(WORK * points * elements.len());
        let count = match workers.threads() {
            1 => 1,
            threads => threads * (system.nodes() / (NODES * threads)).clamp(1, SHARES),
        };
        let nodes = ranges_of_even_work(system, count).into_iter();
        let mut shares: Vec<Share> = nodes
            .map(|nodes| Share {
                nodes,
                elements: Vec::new(),
            })
            .collect();
        let share_of = |node: usize| shares.partition_point(|share| share.nodes.end <= node);
        let of_nodes: Vec<Vec<usize>> = elements
            .iter()
            .map(|placed| {
                placed
                    .element
                    .nodes()
                    .iter()
                    .map(|&n| share_of(n))
                    .collect()
            })
            .collect();
        let owners = of_nodes.iter().map(|all| all.first().copied().unwrap_or(0));
        let owners: Vec<usize> = owners.collect();
        for (index, mut all) in of_nodes.into_iter().enumerate() {
            all.push(owners[index]);
            all.sort_unstable();
            all.dedup();
            for share in all {
                shares[share].elements.push(index);
            }
        }
        Division {
            workers,
            shares,
            owners,
        }
    }

    /// Values of the nodes, so many for each, by shares.
    pub fn split<'v, T>(&self, values: &'v mut [T], of_a_node: usize) -> Vec<&'v mut [T]> {
        self.split_by(values, |share| of_a_node * share.nodes.len())
    }

    /// Values that come in the order of nodes, by shares of a given number of them.
    pub fn split_by<'v, T>(
        &self,
        values: &'v mut [T],
        count: impl Fn(&Share) -> usize,
    ) -> Vec<&'v mut [T]> {
        parts(values, self.shares.iter().map(count)).collect()
    }

    /// What the elements have of their own, one after the other: for each share, that of each of
    /// its elements, if the share has it.
    pub fn deal<T>(&self, of_elements: impl IntoIterator<Item = T>) -> Vec<Vec<Option<T>>> {
        let mut own: Vec<Option<T>> = of_elements.into_iter().map(Some).collect();
        let dealt = self
            .shares
            .iter()
            .enumerate()
            .map(|(share, Share { elements, .. })| {
                let mut take = |index: usize| match self.owners[index] == share {
                    true => own[index].take(),
                    false => None,
                };
                elements.iter().map(|&index| take(index)).collect()
            });
        dealt.collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collocation::{Collocation, GridState, Pattern, Tangent};
    use crate::fourier::TimeGrid;
    use crate::test_models::small::{moving_models, one_blade};
    use std::sync::Arc;

    #[test]
    fn each_node_and_each_element_has_its_share() {
        let (model, period) = one_blade(40);
        let system = System::new(&model, period).unwrap();
        for threads in [1, 2, 3] {
            let division = Division::new(&system, 5, &Workers::new(threads).unwrap());
            let shares = &division.shares;
            assert_eq!(shares.len() > 1, threads > 1);
            assert_eq!(shares[0].nodes.start, 0);
            assert_eq!(shares.last().unwrap().nodes.end, system.nodes());
            assert!(
                shares
                    .windows(2)
                    .all(|s| s[0].nodes.end == s[1].nodes.start)
            );
            let own = division.deal(0..system.elements().len()).into_iter();
            let mut own: Vec<usize> = own.flatten().flatten().collect();
            own.sort_unstable();
            assert_eq!(own, (0..system.elements().len()).collect::<Vec<_>>());
            for (index, placed) in system.elements().iter().enumerate() {
                for node in placed.element.nodes() {
                    let share = shares
                        .iter()
                        .find(|share| share.nodes.contains(node))
                        .unwrap();
                    assert!(share.elements.contains(&index));
                }
            }
            let evaluated: usize = shares.iter().map(|share| share.elements.len()).sum();
            assert!(evaluated <= system.elements().len() + 4 * (shares.len() - 1));
        }
    }

    #[test]
    fn sums_do_not_depend_on_the_number_of_threads() {
        for (model, period) in moving_models() {
            let points = 35;
            let system = Arc::new(System::new(&model, period).unwrap());
            let grid = TimeGrid::new(points, period).unwrap();
            let pattern = Pattern::new(&system, points);
            let wave = |i: usize| (0.37 * i as f64).sin();
            let evaluate = |threads: usize| {
                let mut equations = Collocation::new(system.clone(), grid).unwrap();
                equations.set_workers(Workers::new(threads).unwrap());
                let scales = equations.column_scale().iter().enumerate();
                let increment: Vec<f64> = scales.map(|(i, s)| 0.05 * wave(i) * s).collect();
                let state =
                    GridState::reference(&system, grid).incremented(&system, &increment, 1.0);
                let mut residual = vec![0.0; equations.size()];
                equations.residual(&state, &mut residual).unwrap();
                let mut values = vec![0.0; pattern.entries()];
                let mut tangent = Tangent::new(&system, points);
                equations
                    .jacobian(&state, &pattern, &mut tangent, &mut values)
                    .unwrap();
                let mut tangent = Tangent::with_resultants_apart(&system, points);
                // Twice, as what is there from before is to be overwritten.
                for _ in 0..2 {
                    tangent.evaluate(&mut equations, &state).unwrap();
                }
                let mut product = vec![0.0; equations.size()];
                let x: Vec<f64> = (0..equations.size()).map(|i| wave(3 * i + 1)).collect();
                tangent.apply(&equations, &x, &mut product);
                (equations.division.shares.len(), [residual, values, product])
            };
            let (_, alone) = evaluate(1);
            for threads in [2, 3] {
                let (shares, together) = evaluate(threads);
                assert!(shares > 1);
                assert!(together == alone, "{threads} threads");
            }
        }
    }
}
