//! What lies between two points of a branch, located along the arc (docs/theory.md, section 13.3).

use super::walk::{Place, Stepped, Walk};
use crate::error::Result;

/// Most points on the way.
const MOST: usize = 30;
/// Slope of the parameter that is none.
const FLAT: f64 = 1e-11;

/// Where the slope of the parameter, which has another sign `length` further, vanishes: by the
/// secant method of Illinois, each time at a point of the branch. None where that fails.
pub(super) fn locate_fold(
    walk: &mut Walk,
    from: &Place,
    (length, there): (f64, f64),
) -> Result<Option<(Stepped, f64)>> {
    let mut low = (0.0, walk.slope(from));
    let mut high = (length, there);
    let mut best: Option<(Stepped, f64)> = None;
    for _ in 0..MOST {
        let at = (low.0 * high.1 - high.0 * low.1) / (high.1 - low.1);
        if !at.is_finite() || at <= 0.0 || at >= length {
            break;
        }
        let Ok(found) = walk.step(from, at)? else {
            break;
        };
        let slope = walk.slope(&found.to);
        best = Some((found, at));
        if slope.abs() <= FLAT || (high.0 - low.0).abs() <= 1e-14 * length {
            break;
        }
        if slope * high.1 < 0.0 {
            low = high;
        } else {
            low.1 *= 0.5;
        }
        high = (at, slope);
    }
    Ok(best)
}
