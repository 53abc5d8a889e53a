//! Reference lines of beams: a frame for each fraction of the span, from 0 at the start to 1 at the
//! end, with axis 1 along the line.

use super::validation::direction;
use crate::elements::{lobatto_points, shape_functions};
use crate::error::{Error, ErrorKind, Result, require_finite};
use crate::motion::{Motion, rotation_from_vector};
use nalgebra::{Matrix3, Vector3};
use std::f64::consts::TAU;

/// Axes with axis 1 along `axis_1` (a unit vector) and axis 2 along the part of `axis_2` across it.
fn axes(axis_1: &Vector3<f64>, axis_2: &Vector3<f64>) -> Result<Matrix3<f64>> {
    let axis_2 = direction("axis_2", axis_2)?;
    let across = axis_2 - axis_1 * axis_1.dot(&axis_2);
    if across.norm() <= 1e-9 * axis_2.norm() {
        return Err(Error::value(
            "axis_2",
            "a vector across the beam",
            "one along it",
        ));
    }
    let axis_2 = across.normalize();
    Ok(Matrix3::from_columns(&[
        *axis_1,
        axis_2,
        axis_1.cross(&axis_2),
    ]))
}

/// A straight line from `start` to `end`. Axis 2 is the part of `axis_2` that is perpendicular to
/// it.
///
/// # Errors
/// If the points coincide, or `axis_2` is along the line.
pub fn straight_line(
    start: &Vector3<f64>,
    end: &Vector3<f64>,
    axis_2: &Vector3<f64>,
) -> Result<impl Fn(f64) -> Result<Motion> + use<>> {
    require_finite("start", start.as_slice())?;
    require_finite("end", end.as_slice())?;
    require_apart("start", start, "end", end)?;
    let (start, span) = (*start, end - start);
    let rotation = axes(&span.normalize(), axis_2)?;
    Ok(move |fraction| Ok(Motion::new(rotation, start + span * fraction)))
}

/// The circular arc from `start` through `point` to `end`. Axis 2 at the start is the part of
/// `axis_2` that is perpendicular to the arc; the axes then turn with the arc about its axis, so
/// that their curvature is constant. Fractions are of the arc's length.
///
/// # Errors
/// If the points are on a straight line, or `axis_2` is along the arc's start.
pub fn circular_arc(
    start: &Vector3<f64>,
    point: &Vector3<f64>,
    end: &Vector3<f64>,
    axis_2: &Vector3<f64>,
) -> Result<impl Fn(f64) -> Result<Motion> + use<>> {
    require_finite("start", start.as_slice())?;
    require_finite("point", point.as_slice())?;
    require_finite("end", end.as_slice())?;
    require_apart("start", start, "point", point)?;
    require_apart("point", point, "end", end)?;
    require_apart("start", start, "end", end)?;
    // In units of the largest distance, as squares of the points' own coordinates may overflow.
    let size = (point - start).norm().max((end - start).norm());
    let (a, b) = ((point - start) / size, (end - start) / size);
    let normal = a.cross(&b);
    if normal.norm() <= 1e-9 * a.norm() * b.norm() {
        let got = "three points on a straight line";
        return Err(Error::value(
            "point",
            "a point off the line from start to end",
            got,
        ));
    }
    let to_centre = (normal.cross(&a) * b.norm_squared() + b.cross(&normal) * a.norm_squared())
        / (2.0 * normal.norm_squared());
    let centre = start + to_centre * size;
    let normal = normal.normalize();
    let (first, last) = (-to_centre, b - to_centre);
    let angle = normal.dot(&first.cross(&last)).atan2(first.dot(&last));
    let angle = if angle > 0.0 { angle } else { angle + TAU };
    let first = first * size;
    let rotation = axes(&normal.cross(&first).normalize(), axis_2)?;
    Ok(move |fraction: f64| {
        let turn = rotation_from_vector(&(normal * (angle * fraction)));
        Ok(Motion::new(turn * rotation, centre + turn * first))
    })
}

fn require_apart(from: &str, a: &Vector3<f64>, name: &str, b: &Vector3<f64>) -> Result<()> {
    let size = a.amax().max(b.amax());
    let distance = (b - a).norm();
    if distance <= 1e-12 * size || distance == 0.0 {
        let expected = format!("a point away from {from}");
        return Err(Error::value(name, expected, "the same point"));
    }
    Ok(())
}

/// Share of the line over which a curve is differentiated.
const WINDOW: f64 = 1.0 / 16.0;
/// Points at which it is evaluated there: a turn of half a radian is resolved to rounding, one of
/// two to 1e-9.
const SAMPLES: usize = 14;
/// Largest deviation of a curve from the polynomial through these points, relative to the window's
/// length: a corner of 10 degrees has about as much.
const SMOOTH: f64 = 1e-3;

/// A curve given by its position and a direction, the part of which across the curve is axis 2, at
/// each fraction of the span. Axis 1 is found by differentiation.
///
/// `curve` is called several times for each frame, with fractions from 0 to 1.
pub fn smooth_curve(
    curve: impl Fn(f64) -> Result<(Vector3<f64>, Vector3<f64>)>,
) -> impl Fn(f64) -> Result<Motion> {
    let points = lobatto_points(SAMPLES);
    let position = move |fraction: f64| -> Result<(Vector3<f64>, Vector3<f64>)> {
        let (position, axis_2) = curve(fraction)?;
        let place = |e: Error| e.within(format!("line at fraction {fraction:.6}"));
        require_finite("position", position.as_slice()).map_err(place)?;
        require_finite("axis_2", axis_2.as_slice()).map_err(place)?;
        Ok((position, axis_2))
    };
    move |fraction| {
        let start = (fraction - 0.5 * WINDOW).clamp(0.0, 1.0 - WINDOW);
        let at = |x: f64| start + 0.5 * WINDOW * (x + 1.0);
        let samples = points
            .iter()
            .map(|&x| Ok(position(at(x).min(1.0))?.0))
            .collect::<Result<Vec<_>>>()?;
        let interpolate = |x: f64| {
            let mut sums = (Vector3::zeros(), Vector3::zeros());
            for (shape, sample) in shape_functions(&points, x).iter().zip(&samples) {
                sums.0 += (sample - samples[0]) * shape.0;
                sums.1 += (sample - samples[0]) * shape.1;
            }
            sums
        };
        let (here, axis_2) = position(fraction)?;
        let tangent = interpolate(2.0 * (fraction - start) / WINDOW - 1.0).1;
        let place = || format!("line at fraction {fraction:.6}");
        let length = tangent.norm();
        if length <= 1e-12 * here.amax() || length == 0.0 {
            let message = "expected a line that goes on, got one that stands still";
            return Err(Error::new(ErrorKind::Value, message).within(place()));
        }
        // Half-way between the two middle points, where the polynomial follows a corner worst.
        let deviation = position(at(0.0))?.0 - samples[0] - interpolate(0.0).0;
        if deviation.norm() > SMOOTH * length {
            let message = "expected a smooth line, got a corner: use two beams with a rigid joint";
            return Err(Error::new(ErrorKind::Value, message).within(place()));
        }
        let rotation = axes(&(tangent / length), &axis_2).map_err(|e| e.within(place()))?;
        Ok(Motion::new(rotation, here))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arcs_pass_their_points_with_the_axis_along() {
        let (centre, radius) = (Vector3::new(1.0, -2.0, 0.5), 3.0);
        let tilt = rotation_from_vector(&Vector3::new(0.4, -0.9, 0.3));
        for angle in [0.1f64, 1.0, 3.0, 3.2, 5.0, 6.2] {
            let on = |x: f64| centre + tilt * Vector3::new(x.cos(), x.sin(), 0.0) * radius;
            let (start, point, end) = (on(0.0), on(0.3 * angle), on(angle));
            let across = tilt * Vector3::new(0.2, 0.7, 1.0);
            let arc = circular_arc(&start, &point, &end, &across).unwrap();
            for k in 0..=20 {
                let fraction = f64::from(k) / 20.0;
                let x = angle * fraction;
                let frame = arc(fraction).unwrap();
                assert!(
                    (frame.position - on(x)).amax() < 1e-11,
                    "{angle} {fraction}"
                );
                let along = tilt * Vector3::new(-x.sin(), x.cos(), 0.0);
                assert!((frame.rotation.column(0) - along).amax() < 1e-11);
            }
        }
    }

    #[test]
    fn curves_are_differentiated_to_rounding() {
        // A helix of two turns.
        let angle = 2.0 * TAU;
        let curve = |s: f64| {
            let x = angle * s;
            let position = Vector3::new(x.cos(), x.sin(), 0.3 * x) * 2.0;
            Ok((position, Vector3::new(x.cos(), x.sin(), 0.0)))
        };
        let line = smooth_curve(curve);
        for k in 0..=40 {
            let x = angle * f64::from(k) / 40.0;
            let frame = line(f64::from(k) / 40.0).unwrap();
            let along = Vector3::new(-x.sin(), x.cos(), 0.3).normalize();
            let error = (frame.rotation.column(0) - along).amax();
            assert!(error < 1e-11, "{error:e}");
            let across = Vector3::new(x.cos(), x.sin(), 0.0);
            assert!((frame.rotation.column(1) - across).amax() < 1e-11);
        }
    }

    #[test]
    fn corners_and_stops_are_refused() {
        let message = |curve: fn(f64) -> Vector3<f64>| {
            let line = smooth_curve(move |s| Ok((curve(s), Vector3::z())));
            let failed = (0..=100).find_map(|k| line(f64::from(k) / 100.0).err());
            failed.map(|e| e.to_string()).unwrap_or_default()
        };
        let corner = message(|s| Vector3::new(s, (s - 0.5).abs(), 0.0));
        assert!(corner.contains("corner"), "{corner}");
        assert!(message(|_| Vector3::x()).contains("stands still"));
        assert!(message(|s| Vector3::new(0.0, 0.0, s)).contains("axis_2"));
        assert!(message(|s| Vector3::new(s, f64::NAN, s)).contains("position[1]"));
        assert_eq!(message(|s| Vector3::new(s, s * s, 0.0)), "");
    }
}
