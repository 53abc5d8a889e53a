//! Factors of meshes against dense ones.

use super::block_lu::{BlockLanes, BlockStructure, Scratch};
use super::lanes::{ComplexLanes, LANES, Lanes, RealLanes};
use crate::solve::linear::ordering::{NEVER, elimination};
use crate::workers::Workers;
use nalgebra::{Complex, ComplexField, DMatrix, DVector};
use std::collections::BTreeSet;

/// Couplings of a mesh of so many squares a side, and of a row with all nodes of one side.
fn mesh(side: usize) -> Vec<BTreeSet<usize>> {
    let count = (side + 1) * (side + 1);
    let mut coupled = vec![BTreeSet::new(); count + 1];
    let mut couple = |nodes: &[usize]| {
        for &a in nodes {
            coupled[a].extend(nodes);
        }
    };
    for i in 0..side {
        for j in 0..side {
            let corner = i * (side + 1) + j;
            couple(&[corner, corner + 1, corner + side + 1, corner + side + 2]);
        }
    }
    (0..=side).for_each(|a| couple(&[a, count]));
    coupled
}

/// Factors a mesh's matrices of `number`, block by block or in fronts, and compares with dense
/// ones: solutions where `kept` rows are known, and what is left at these.
fn check<T: Lanes>(kept: &[usize], in_fronts: bool, number: impl Fn(f64, f64) -> T::Number) {
    let coupled = mesh(5);
    let sizes: Vec<usize> = (0..coupled.len()).map(|g| [3, 6, 2][g % 3]).collect();
    let is_kept: Vec<bool> = (0..sizes.len()).map(|g| kept.contains(&g)).collect();
    let waiting = is_kept.iter().map(|kept| if *kept { NEVER } else { 0 });
    let order = elimination(&sizes, &coupled, waiting.collect());
    let rows = (sizes, coupled.clone());
    let structure = BlockStructure::in_order(rows, &is_kept, order, in_fronts);
    let (count, used) = (structure.unknowns(), LANES - 1);
    let workers = Workers::new(2).unwrap();
    let mut lanes = BlockLanes::<T>::new(&structure, used);
    let zero = T::Number::default();
    let mut dense = vec![DMatrix::from_element(count, count, zero); used];
    // Some hundred times the rounding of entries of order ten; fronts are kept in single precision.
    let tolerance = if in_fronts { 3e-5 } else { 1e-12 };
    let noise = |i: usize, j: usize| (4e4 * (1.7 * i as f64 + 0.3 * j as f64).sin()).fract();
    for (row, others) in coupled.iter().enumerate() {
        for &column in others {
            for i in 0..structure.size(row) {
                for j in 0..structure.size(column) {
                    let (a, b) = (structure.first(row) + i, structure.first(column) + j);
                    let place = structure.entry((row, column), (i, j));
                    let diagonal = if a == b { 9.0 } else { 0.0 };
                    // Lanes that are not used are like the last one.
                    for lane in 0..LANES {
                        let of = lane.min(used - 1);
                        let value = number(noise(a + 31 * of, b) + diagonal, noise(b, a + of));
                        lanes.at(place).set(lane, value);
                        dense[of][(a, b)] = value;
                    }
                }
            }
        }
    }
    assert!(lanes.factor(&structure, &workers));
    let of_row = |row: usize| structure.first(row)..structure.first(row) + structure.size(row);
    let left: Vec<usize> = kept.iter().flat_map(|&row| of_row(row)).collect();
    let gone: Vec<usize> = (0..count).filter(|i| !left.contains(i)).collect();
    let exact: Vec<DVector<T::Number>> = (0..used)
        .map(|lane| DVector::from_fn(count, |i, _| number(noise(i, lane), noise(lane, i + 7))))
        .collect();
    let mut x = vec![T::zero(); count];
    for (lane, (dense, exact)) in dense.iter().zip(&exact).enumerate() {
        let rhs = dense * exact;
        x.iter_mut()
            .zip(rhs.iter())
            .for_each(|(x, b)| x.set(lane, *b));
    }
    let mut scratch = Scratch::default();
    lanes.forward(&structure, &mut x, (&mut scratch, &workers));
    // At kept rows there is left what their Schur complements make of the solution.
    let mut product = vec![T::zero(); count];
    let mut given = vec![T::zero(); count];
    for (lane, exact) in exact.iter().enumerate() {
        left.iter().for_each(|&i| given[i].set(lane, exact[i]));
    }
    lanes.add_kept_product(&structure, &given, &mut product);
    for (lane, (dense, exact)) in dense.iter().zip(&exact).enumerate() {
        let part = |rows: &[usize], columns: &[usize]| {
            DMatrix::from_fn(rows.len(), columns.len(), |i, j| {
                dense[(rows[i], columns[j])]
            })
        };
        let eliminated = part(&gone, &gone).lu().solve(&part(&gone, &left)).unwrap();
        let schur = part(&left, &left) - part(&left, &gone) * eliminated;
        let known = DVector::from_fn(left.len(), |i, _| exact[left[i]]);
        for (&i, expected) in left.iter().zip((schur * known).iter()) {
            for found in [product[i].get(lane), x[i].get(lane)] {
                let error = (found - *expected).modulus();
                assert!(error < 10.0 * tolerance, "{found} {expected}");
            }
            x[i].set(lane, exact[i]);
        }
    }
    lanes.backward(&structure, &mut x, (&mut scratch, &workers));
    for (lane, exact) in exact.iter().enumerate() {
        for (x, exact) in x.iter().zip(exact.iter()) {
            let error = (x.get(lane) - *exact).modulus();
            assert!(error < tolerance, "{lane}: {error:e}");
        }
    }
}

#[test]
fn blocks_and_fronts_solve_as_dense_factors_do() {
    // None kept; rows in a corner and amid the mesh, and the one with a whole side.
    for kept in [&[][..], &[0, 1], &[14, 36], &[36]] {
        for in_fronts in [false, true] {
            check::<RealLanes>(kept, in_fronts, |re, _| re);
            check::<ComplexLanes>(kept, in_fronts, Complex::new);
        }
    }
}

#[test]
fn singular_matrices_are_found_out_in_fronts() {
    let coupled = mesh(3);
    let (sizes, kept) = (vec![2; coupled.len()], vec![false; coupled.len()]);
    let order = elimination(&sizes, &coupled, vec![0; coupled.len()]);
    let structure = BlockStructure::in_order((sizes, coupled.clone()), &kept, order, true);
    let workers = Workers::default();
    // The Laplacian of the mesh, without and with something that holds it.
    for (held, is_regular) in [(0.0, false), (1.0, true), (f64::NAN, false)] {
        let mut lanes = BlockLanes::<RealLanes>::new(&structure, 1);
        for (row, others) in coupled.iter().enumerate() {
            for &column in others {
                let own = (others.len() - 1) as f64 + if row == 4 { held } else { 0.0 };
                let value = if row == column { own } else { -1.0 };
                for i in 0..2 {
                    let place = structure.entry((row, column), (i, i));
                    (0..LANES).for_each(|lane| lanes.at(place).set(lane, value));
                }
            }
        }
        assert_eq!(lanes.factor(&structure, &workers), is_regular, "{held}");
    }
}
