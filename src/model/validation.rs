//! Checks of what the user, or a file, says.

use super::Model;
use crate::error::{Error, Result, require_finite, require_id};
use crate::motion::{Motion, is_rotation};
use nalgebra::{DMatrix, Matrix3, SMatrix, Vector3};

/// How far `RᵀR` may be from the identity: input written with 9 digits passes, and is then cleaned.
const ROTATION_TOLERANCE: f64 = 1e-8;

fn require_symmetric<const N: usize>(name: &str, m: &SMatrix<f64, N, N>) -> Result<()> {
    require_finite(name, m.as_slice())?;
    let asymmetry = (m - m.transpose()).amax();
    if asymmetry > 1e-9 * m.amax() {
        return Err(Error::value(
            name,
            "a symmetric matrix",
            format!("entries that differ from their mirror by up to {asymmetry:.3e}"),
        ));
    }
    Ok(())
}

/// Smallest eigenvalue after scaling to a unit diagonal, so that it does not depend on units.
pub(super) fn smallest_scaled_eigenvalue<const N: usize>(m: &SMatrix<f64, N, N>) -> f64 {
    let scale = m
        .diagonal()
        .map(|d| if d == 0.0 { 1.0 } else { 1.0 / d.abs().sqrt() });
    let scale = SMatrix::from_diagonal(&scale);
    let scaled: SMatrix<f64, N, N> = scale * m * scale;
    let scaled = DMatrix::from_column_slice(N, N, scaled.as_slice());
    scaled.symmetric_eigenvalues().min()
}

pub(super) fn require_positive<const N: usize>(
    name: &str,
    m: &SMatrix<f64, N, N>,
    definite: bool,
) -> Result<SMatrix<f64, N, N>> {
    require_symmetric(name, m)?;
    let smallest = smallest_scaled_eigenvalue(m);
    let (wrong, expected) = if definite {
        (smallest <= 1e-14, "a positive-definite matrix")
    } else {
        (smallest < -1e-9, "a positive semi-definite matrix")
    };
    if wrong {
        let got = format!("one with the scaled eigenvalue {smallest:.3e}");
        return Err(Error::value(name, expected, got));
    }
    Ok(0.5 * m + 0.5 * m.transpose()) // the sum of large entries would overflow
}

/// Checks `elements` elements of a kind from `first` on, of which there are `count`.
pub(super) fn require_elements(
    what: &str,
    count: usize,
    (first, elements): (usize, usize),
) -> Result<()> {
    require_id("first_element", what, count, first)?;
    let most = count - first;
    if !(1..=most).contains(&elements) {
        let expected = format!("1 to {most} from element {first} on");
        return Err(Error::size("elements", expected, elements));
    }
    Ok(())
}

/// Checks a rotation matrix and removes the rounding of its input.
pub(super) fn require_rotation(name: &str, r: &Matrix3<f64>) -> Result<Matrix3<f64>> {
    require_finite(name, r.as_slice())?;
    if !is_rotation(r, ROTATION_TOLERANCE) {
        let got = format!(
            "RᵀR off the identity by {:.3e}, determinant {:.6}",
            (r.transpose() * r - Matrix3::identity()).amax(),
            r.determinant()
        );
        return Err(Error::value(name, "a rotation matrix", got));
    }
    Ok(crate::motion::polar_rotation(r))
}

/// A vector of the direction of `v`, of moderate length whatever that of `v`.
pub(crate) fn direction(name: &str, v: &Vector3<f64>) -> Result<Vector3<f64>> {
    require_finite(name, v.as_slice())?;
    let size = v.amax();
    if size == 0.0 {
        return Err(Error::value(
            name,
            "a vector that is not zero",
            "the zero vector",
        ));
    }
    Ok(v / size)
}

/// Checks a motion and removes the rounding of its rotation.
pub(super) fn require_motion(name: &str, motion: &Motion) -> Result<Motion> {
    require_finite(&format!("{name} position"), motion.position.as_slice())?;
    let rotation = require_rotation(&format!("{name} rotation"), &motion.rotation)?;
    Ok(Motion::new(rotation, motion.position))
}

/// Checks that places ascend from 0 to 1; strictly, if there may be no `jumps`.
pub(super) fn require_ascending(name: &str, places: &[f64], jumps: bool) -> Result<()> {
    for (i, &place) in places.iter().enumerate() {
        let name = format!("{name}[{i}]");
        require_finite(&name, &[place])?;
        let before = i.checked_sub(1).map(|before| places[before]);
        let expected = match before {
            None if place != 0.0 => "0 at the start".to_owned(),
            _ if i + 1 == places.len() && place != 1.0 => "1 at the end".to_owned(),
            Some(before) if jumps && place < before => format!("at least {before}, the one before"),
            Some(before) if !jumps && place <= before => {
                format!("more than {before}, the one before")
            }
            _ => continue,
        };
        return Err(Error::value(&name, expected, place));
    }
    Ok(())
}

/// Checks that something connects two bodies.
pub(super) fn require_two_bodies(first: Option<usize>, second: Option<usize>) -> Result<()> {
    if first != second {
        return Ok(());
    }
    let got = first.map_or("the ground twice".into(), |n| format!("node {n} twice"));
    Err(Error::value("first, second", "two different bodies", got))
}

impl Model {
    pub(crate) fn require_node(&self, name: &str, node: usize) -> Result<()> {
        require_id(name, "node", self.nodes.len(), node)
    }

    /// Checks the nodes of an element: at least one, and all different.
    pub(crate) fn require_distinct_nodes(&self, nodes: &[usize]) -> Result<()> {
        if nodes.is_empty() {
            return Err(Error::size("nodes", "at least one node", 0));
        }
        for (i, &node) in nodes.iter().enumerate() {
            self.require_node("nodes", node)?;
            if nodes[..i].contains(&node) {
                let got = format!("node {node} twice");
                return Err(Error::value("nodes", "distinct nodes", got));
            }
        }
        Ok(())
    }
}
