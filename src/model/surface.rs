//! Surfaces to mesh with shells: points for `(u, v)`, each from 0 to 1.

use super::validation::direction;
use crate::error::{Error, Result, require_finite, require_positive_number};
use crate::motion::rotation_from_vector;
use nalgebra::Vector3;

/// The parallelogram at `corner` with these sides, along `u` and `v`.
///
/// # Errors
/// If numbers are not finite, or the sides are zero or parallel.
pub fn rectangle(
    corner: &Vector3<f64>,
    along_u: &Vector3<f64>,
    along_v: &Vector3<f64>,
) -> Result<impl Fn([f64; 2]) -> Result<Vector3<f64>> + use<>> {
    require_finite("corner", corner.as_slice())?;
    let sides = [
        direction("along_u", along_u)?.normalize(),
        direction("along_v", along_v)?.normalize(),
    ];
    if sides[0].cross(&sides[1]).norm() < 1e-6 {
        let expected = "sides that are not parallel";
        return Err(Error::value("along_u, along_v", expected, "parallel ones"));
    }
    let (corner, along_u, along_v) = (*corner, *along_u, *along_v);
    Ok(move |[u, v]: [f64; 2]| Ok(corner + along_u * u + along_v * v))
}

/// Axis, first direction across it, and angle, checked.
fn turning(
    centre: &Vector3<f64>,
    axis: &Vector3<f64>,
    start: &Vector3<f64>,
    angle: f64,
) -> Result<impl Fn(f64) -> Vector3<f64> + use<>> {
    require_finite("centre", centre.as_slice())?;
    require_finite("angle", &[angle])?;
    if angle == 0.0 || angle.abs() > std::f64::consts::TAU * (1.0 + 1e-12) {
        let expected = "an angle other than zero, of one turn at most";
        return Err(Error::value("angle", expected, angle));
    }
    let axis = direction("axis", axis)?.normalize();
    let start = direction("start", start)?.normalize();
    let across = start - axis * axis.dot(&start);
    if across.norm() < 1e-6 {
        return Err(Error::value(
            "start",
            "a direction across the axis",
            "one along it",
        ));
    }
    let across = across.normalize();
    Ok(move |share: f64| rotation_from_vector(&(axis * (angle * share))) * across)
}

/// A sector of an annulus: `u` from the inner to the outer radius, `v` around `axis`, right-handed,
/// by `angle` from the part of `start` across the axis. The normal is along the axis for positive
/// angles.
///
/// # Errors
/// If numbers are out of their ranges: the inner radius is positive, the angle not zero and one
/// turn at most.
pub fn annulus_sector(
    centre: &Vector3<f64>,
    axis: &Vector3<f64>,
    start: &Vector3<f64>,
    [inner, outer]: [f64; 2],
    angle: f64,
) -> Result<impl Fn([f64; 2]) -> Result<Vector3<f64>> + use<>> {
    require_positive_number("inner radius", inner)?;
    require_positive_number("outer radius", outer)?;
    if inner >= outer {
        let expected = format!("less than the outer radius, {outer}");
        return Err(Error::value("inner radius", expected, inner));
    }
    let (outwards, centre) = (turning(centre, axis, start, angle)?, *centre);
    Ok(move |[u, v]: [f64; 2]| Ok(centre + outwards(v) * (inner + (outer - inner) * u)))
}

/// A cylinder: `u` around `axis`, right-handed, by `angle` from the part of `start` across the
/// axis, `v` along it by `length` from `centre`. The normal is outwards for positive angles.
///
/// # Errors
/// If numbers are out of their ranges: radius and length are positive, the angle not zero and one
/// turn at most.
pub fn cylinder(
    centre: &Vector3<f64>,
    axis: &Vector3<f64>,
    start: &Vector3<f64>,
    [radius, length]: [f64; 2],
    angle: f64,
) -> Result<impl Fn([f64; 2]) -> Result<Vector3<f64>> + use<>> {
    require_positive_number("radius", radius)?;
    require_positive_number("length", length)?;
    let (outwards, centre) = (turning(centre, axis, start, angle)?, *centre);
    let along = direction("axis", axis)?.normalize() * length;
    Ok(move |[u, v]: [f64; 2]| Ok(centre + outwards(u) * radius + along * v))
}
