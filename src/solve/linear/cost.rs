//! What factors take, as planned. See docs/theory.md, section 8.7.

use crate::elements::StrainTangent;
use crate::motion::DualVector;
use crate::solve::linear::critical_path::path;
use crate::solve::linear::front::elimination_work;
use crate::solve::linear::ordering::FrontPlan;
use crate::solve::linear::two_branches::plan_for;
use crate::system::System;
use crate::work::{LINEARISATION, OF_FACTORS, PRODUCT, RESIDUAL};
use nalgebra::Matrix6;
use std::collections::BTreeSet;

/// Multiply-adds that a factorisation may take for each number that is stored at a node and grid
/// point, where iteration is the alternative: about what its products take.
pub(crate) const AFFORDABLE: f64 = 1e4;
/// Products of an iteration of Newton's method that is easy.
const EASY_PRODUCTS: f64 = 30.0;

/// What factors of the whole Jacobian take, as planned.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DirectCost {
    /// Multiply-adds of one factorisation.
    pub work: f64,
    /// Bytes.
    pub bytes: f64,
}

impl DirectCost {
    /// Of nothing.
    pub(crate) const NONE: Self = DirectCost {
        work: 0.0,
        bytes: 0.0,
    };

    /// Of the Jacobian of a system on a grid of so many points.
    pub fn of(system: &System, points: usize) -> Self {
        let (sizes, fronts) = fronts(system, points, 1);
        let size = |groups: &[usize]| groups.iter().map(|&g| sizes[g]).sum::<usize>();
        Self::of_fronts(fronts.iter().map(|f| (size(&f.own), size(&f.boundary))))
    }

    /// Multiply-adds of the factorisation one after the other, where so many workers share them.
    pub fn shared(system: &System, points: usize, workers: usize) -> f64 {
        let (sizes, fronts) = fronts(system, points, workers);
        let size = |groups: &[usize]| groups.iter().map(|&g| sizes[g]).sum::<usize>();
        path(&fronts, size, workers)
    }

    /// Of fronts that eliminate so many unknowns, and leave so many others.
    pub(crate) fn of_fronts(fronts: impl Iterator<Item = (usize, usize)>) -> Self {
        let (mut work, mut numbers) = (0.0, 0.0);
        for (own, rest) in fronts {
            work += elimination_work(own, rest);
            numbers += (own * (own + 2 * rest)) as f64;
        }
        // The values themselves, and the largest fronts, come to about as much again.
        DirectCost {
            work,
            bytes: 2.0 * numbers * size_of::<f64>() as f64,
        }
    }

    /// Values of the Jacobian, at most.
    pub(crate) fn values(&self) -> f64 {
        0.5 * self.bytes / size_of::<f64>() as f64
    }
}

/// Sizes of the groups of unknowns, and the fronts that eliminate them by so many workers.
fn fronts(system: &System, points: usize, workers: usize) -> (Vec<usize>, Vec<FrontPlan>) {
    let nodes = system.nodes();
    let mut sizes = vec![system.layout(points).of_node(); nodes];
    let mut coupled = vec![BTreeSet::new(); nodes];
    for placed in system.elements() {
        let mut members = placed.element.nodes().to_vec();
        if placed.element.own_unknowns() > 0 {
            members.push(sizes.len());
            sizes.push(placed.own_over(points).len());
            coupled.push(BTreeSet::new());
        }
        for &a in &members {
            coupled[a].extend(&members);
        }
    }
    let fronts = plan_for(workers, &sizes, &coupled, nodes);
    (sizes, fronts)
}

/// Multiply-adds of an iteration of Newton's method on a grid of so many points that is easy: by
/// `factors` of the whole Jacobian or by few products, as costs less.
pub(crate) fn easy_iteration(system: &System, points: usize, factors: DirectCost) -> f64 {
    let numbers = system.layout(points).motions().len() as f64;
    let by_factors = factors.work;
    let solved = match by_factors < AFFORDABLE * numbers {
        true => OF_FACTORS * by_factors,
        false => by_factors.min(EASY_PRODUCTS * PRODUCT * numbers),
    };
    solved + (LINEARISATION + 2.0 * RESIDUAL) * numbers
}

/// Vectors that iteration keeps at least, and those that a solve takes beside them.
const VECTORS: f64 = 40.0;
/// Matrices of harmonics, or of grid points, that are filled side by side.
const SIDE_BY_SIDE: usize = 8;
/// Means over time of a pair of nodes, and of a node and a station, in matrices.
const MEANS: (f64, f64) = (5.0, 3.0);
/// Bytes for each pair of nodes of a station, by which one finds the other.
const FOUND: f64 = 40.0;
/// What allocations take beyond what is asked for, and what is not counted.
const MARGIN: f64 = 1.2;

/// Bytes of a solve by iteration, at most about: of tangents, of those of stress resultants, of a
/// preconditioner and of few vectors. `factors` are those of the whole Jacobian.
pub(crate) fn iteration_bytes(system: &System, points: usize, factors: DirectCost) -> f64 {
    let instants = points as f64;
    let (mut pairs, mut strains, mut stations) = (0.0, 0.0, 0.0);
    let mut found = 0.0;
    let mut coupled = vec![BTreeSet::<usize>::new(); system.nodes()];
    for placed in system.elements() {
        let nodes = placed.element.nodes();
        let laws = placed.element.stress_laws().len() as f64;
        let count = nodes.len() as f64;
        strains += laws * count;
        stations += laws;
        found += (laws + 1.0) * count * count;
        pairs += count * placed.element.own_unknowns() as f64 / 6.0;
        for &node in nodes {
            coupled[node].extend(nodes);
        }
    }
    pairs += coupled
        .iter()
        .map(|others| others.len() as f64)
        .sum::<f64>();
    let (matrix, number) = (size_of::<Matrix6<f64>>() as f64, size_of::<f64>() as f64);
    let tangents = pairs * 3.0 * matrix
        + strains * size_of::<StrainTangent>() as f64
        + stations * size_of::<DualVector>() as f64;
    let means = matrix * (pairs * MEANS.0 + strains * MEANS.1);
    // Complex matrices of half as many harmonics as there are grid points, or real ones of all.
    // Fronts in single precision and those that wait, or small matrices in double precision, take
    // about the same.
    let side_by_side = (points / 2 + 1).next_multiple_of(SIDE_BY_SIDE) as f64;
    let of_entry = 2.0 * number * side_by_side;
    let preconditioner = factors.values() / (instants * instants) * of_entry;
    let filled = pairs * 36.0 * 2.0 * number * SIDE_BY_SIDE as f64;
    let unknowns = system.layout(points).motions().len() as f64 + 6.0 * stations * instants;
    let vectors = VECTORS * unknowns * number;
    MARGIN * (instants * tangents + means + preconditioner + filled + found * FOUND + vectors)
}

/// Bytes of the tangents of all elements, about.
pub(crate) fn tangent_bytes(system: &System, points: usize) -> f64 {
    let pairs = system.elements().iter().map(|placed| {
        let nodes = placed.element.nodes().len() as f64;
        nodes * (nodes + placed.element.own_unknowns() as f64 / 6.0)
    });
    let matrices = 3.0 * size_of::<Matrix6<f64>>() as f64;
    pairs.sum::<f64>() * matrices * points as f64
}
