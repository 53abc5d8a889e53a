//! The blade of the NREL 5-MW reference turbine; see `tests/data/README.md`.

#![allow(dead_code)]

use nalgebra::{Matrix6, Vector3};
use periodyn::model::*;

/// Length of the blade.
pub const LENGTH: f64 = 61.5;
/// Damping of BeamDyn: times that multiply rows of the stiffness, in the order of [`SectionInput`].
pub const DAMPING: [f64; 6] = [1e-3, 1e-3, 1e-3, 2.2e-3, 1.4e-3, 2.2e-3];

/// A symmetric matrix from its upper triangle in BeamDyn's order.
fn matrix(triangle: &[f64]) -> Matrix6<f64> {
    const ORDER: [usize; 6] = [2, 0, 1, 5, 3, 4];
    let entry = |i: usize, j: usize| {
        let (i, j) = (i.min(j), i.max(j));
        triangle[i * 6 - i * (i + 1) / 2 + j]
    };
    Matrix6::from_fn(|i, j| entry(ORDER[i], ORDER[j]))
}

/// Its 49 stations, twisted as given or not at all.
pub fn stations(twisted: bool) -> Vec<SectionStation> {
    let rows = include_str!("../data/nrel_5mw_blade.csv").lines().skip(1);
    rows.map(|row| {
        let values: Vec<f64> = row.split(',').map(|x| x.parse().unwrap()).collect();
        SectionStation {
            fraction: values[0],
            section: SectionInput {
                stiffness: matrix(&values[5..26]),
                mass: matrix(&values[26..47]),
                damping: Matrix6::zeros(),
            },
            twist: if twisted {
                -values[4].to_radians()
            } else {
                0.0
            },
        }
    })
    .collect()
}

/// The blade along z from the origin, axis 2 of its reference line along x.
pub fn add(
    model: &mut Model,
    stations: &[SectionStation],
    elements: usize,
    degree: usize,
) -> BeamIds {
    let tip = Vector3::z() * LENGTH;
    let line = straight_line(&Vector3::zeros(), &tip, &Vector3::x()).unwrap();
    model
        .add_beam_along(line, stations, elements, degree)
        .unwrap()
}
