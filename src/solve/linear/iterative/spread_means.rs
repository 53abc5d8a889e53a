//! Averages of the whole system over time, of which each rank knows those of its part.

use super::body_circulant::scaled_aliasing_of;
use super::constraints::{Class, RowRotation, row_rotations};
use super::mean::{MeanStrain, MeanTangent, scaled_means};
use super::spread::{COMPLEX, OwnPart, Spread};
use crate::collocation::{Aliasing, Item, Tangent};
use crate::error::Result;
use nalgebra::{Complex, Matrix6};

/// Numbers of what a node's harmonic is taken for.
const ALIASING: usize = COMPLEX * 2 * 36;

/// Rotations of the steady constraints of this rank, in vectors of its part.
pub(super) fn local_rotations(
    spread: &Spread,
    own: &OwnPart,
    classes: &[Class],
) -> Vec<RowRotation> {
    let mut rotations = row_rotations(&own.equations, classes);
    let layout = own.equations.layout();
    let placed = own.equations.system().elements();
    let index_at = |first: usize| placed.iter().position(|p| layout.element(p).start == first);
    rotations.retain_mut(|rotation| {
        let Some(local) = index_at(rotation.first) else {
            return false;
        };
        let index = own.elements[local];
        let owner = spread.partition.of_element(&spread.whole.elements()[index]);
        let is_own = owner == spread.ranks.rank();
        if is_own {
            rotation.first = spread.local_place((Item::Element(index), 0)).0;
        }
        is_own
    });
    rotations
}

/// Mean tangents of all couplings of the whole: each rank knows those in the rows of its nodes. By
/// all ranks.
pub(super) fn gathered_means(
    spread: &Spread,
    strains: &[MeanStrain],
    structure: &Tangent,
) -> Result<Vec<MeanTangent>> {
    let (part, owners) = (spread.part, spread.partition.owners());
    let here = scaled_means(spread.equations, spread.tangent, strains);
    let couplings = spread.tangent.couplings().iter().zip(here);
    let known = couplings.filter(|(c, _)| owners[part.nodes[c.row]] == spread.ranks.rank());
    let own: Vec<f64> = known
        .flat_map(|(_, mean)| mean.numbers().collect::<Vec<_>>())
        .collect();
    let mut counts = vec![0; spread.ranks.count()];
    for coupling in structure.couplings() {
        counts[owners[coupling.row]] += MeanTangent::NUMBERS;
    }
    let all = spread.ranks.gathered(&own, &counts)?;
    let mut next: Vec<usize> = Vec::with_capacity(counts.len());
    let mut first = 0;
    for count in counts {
        next.push(first);
        first += count;
    }
    let means = structure.couplings().iter().map(|coupling| {
        let at = &mut next[owners[coupling.row]];
        *at += MeanTangent::NUMBERS;
        MeanTangent::of_numbers(&all[*at - MeanTangent::NUMBERS..*at])
    });
    Ok(means.collect())
}

/// What the grid makes of the highest harmonics of all nodes. By all ranks.
pub(super) fn gathered_aliasing(spread: &Spread) -> Result<Vec<Vec<Aliasing>>> {
    let mut own = Vec::new();
    for &local in &spread.part.own_nodes {
        let all = scaled_aliasing_of(spread.equations, local);
        own.push(all.len() as f64);
        for aliasing in &all {
            let numbers = aliasing.velocity.iter().chain(&aliasing.acceleration);
            numbers.for_each(|number| own.extend([number.re, number.im]));
        }
    }
    let (all, counts) = spread.ranks.gathered_any(&own)?;
    let mut next: Vec<usize> = Vec::with_capacity(counts.len());
    let mut first = 0;
    for count in counts {
        next.push(first);
        first += count;
    }
    let matrix = |numbers: &[f64]| -> Matrix6<Complex<f64>> {
        let pairs = numbers.chunks_exact(COMPLEX);
        Matrix6::from_iterator(pairs.map(|pair| Complex::new(pair[0], pair[1])))
    };
    let owners = spread.partition.owners().iter();
    let of_nodes = owners.map(|owner| {
        let at = &mut next[*owner];
        let count = all[*at] as usize;
        let numbers = &all[*at + 1..][..ALIASING * count];
        *at += 1 + numbers.len();
        let all = numbers.chunks_exact(ALIASING).map(|numbers| Aliasing {
            velocity: matrix(&numbers[..ALIASING / 2]),
            acceleration: matrix(&numbers[ALIASING / 2..]),
        });
        all.collect()
    });
    Ok(of_nodes.collect())
}
