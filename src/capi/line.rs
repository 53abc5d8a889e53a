//! Reference lines of beams, by value.

use super::call::Call;
use super::callback::Callback;
use super::guard::{guard, init};
use super::options::Options;
use super::pointer::null;
use super::section::{read_struct, update_struct};
use super::status::pdn_status;
use crate::error::{Error, Result};
use crate::model::{circular_arc, smooth_curve, straight_line};
use crate::motion::Motion;
use libc::c_void;
use nalgebra::Vector3;
use std::mem::offset_of;

/// Kind of a line: straight.
pub const PDN_LINE_STRAIGHT: i32 = 1500;
/// Kind of a line: circular arc.
pub const PDN_LINE_ARC: i32 = 1501;
/// Kind of a line: a curve that the caller computes.
pub const PDN_LINE_CURVE: i32 = 1502;

/// A smooth curve in space, to be written by the caller.
///
/// Called only during the call that takes the line, on its thread, many times and in any order. It
/// must neither throw nor jump out, nor use the model that the beam is added to.
///
/// @param fraction  place along the curve, from 0 at its start to 1 at its end
/// @param position  array of length 3: where the position goes, global coordinates \[length\];
///     valid during the call only
/// @param axis_2  array of length 3: where a direction goes, of any nonzero length, not along the
///     curve; the part of it that is perpendicular to the curve is axis 2 of the line's frame there
/// @param user_data  as given to ::pdn_line_set_curve
/// @return 0 for success; anything else makes the call fail with PDN_ERR_CALLBACK (see
///     ::pdn_set_callback_error and ::pdn_last_callback_code)
pub type pdn_curve_fn = Option<
    unsafe extern "C" fn(
        fraction: f64,
        position: *mut f64,
        axis_2: *mut f64,
        user_data: *mut c_void,
    ) -> i32,
>;

/// The function pointer without its `Option`.
type Function = unsafe extern "C" fn(f64, *mut f64, *mut f64, *mut c_void) -> i32;

/// Reference line of a beam: a frame at each fraction of the span, with axis 1 along the line.
///
/// Start with `PDN_INIT(pdn_line, &line)`; then one of the `pdn_line_set_...`, each of which
/// replaces all that was set before. Leave the fields to them.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct pdn_line {
    /// Set by the initialiser.
    pub struct_size: usize,
    /// PDN_LINE_STRAIGHT, PDN_LINE_ARC or PDN_LINE_CURVE.
    pub kind: i32,
    /// Leave it zero.
    pub reserved: i32,
    /// Start of a straight line or an arc.
    pub start: [f64; 3],
    /// A point of an arc.
    pub point: [f64; 3],
    /// End of a straight line or an arc.
    pub end: [f64; 3],
    /// Direction of axis 2 at the start of a straight line or an arc.
    pub axis_2: [f64; 3],
    /// The curve.
    pub curve: pdn_curve_fn,
    /// Handed to the curve.
    pub user_data: *mut c_void,
}

// SAFETY: numbers and pointers only, `struct_size` is the first, and there is no padding.
unsafe impl Options for pdn_line {
    // A release that adds a field adds where that field ends.
    const SIZES: &'static [usize] = &[offset_of!(pdn_line, user_data) + size_of::<*mut c_void>()];

    fn defaults() -> Self {
        pdn_line {
            kind: PDN_LINE_STRAIGHT,
            ..Self::blank()
        }
    }
}

/// Frames along a line.
pub(super) type Line = Box<dyn Fn(f64) -> Result<Motion>>;

/// The line that an argument gives. What it calls is the caller's, and there during the call only.
pub(super) fn read(call: &Call, line: *const pdn_line, name: &str) -> Result<Line> {
    let given = read_struct(call, line, name)?;
    given.core().map_err(|error| error.within(name))
}

impl pdn_line {
    fn core(&self) -> Result<Line> {
        if self.reserved != 0 {
            return Err(Error::value("reserved", "zero", self.reserved));
        }
        let (start, point) = (self.start.into(), self.point.into());
        let (end, axis_2) = (self.end.into(), self.axis_2.into());
        Ok(match self.kind {
            PDN_LINE_STRAIGHT => Box::new(straight_line(&start, &end, &axis_2)?),
            PDN_LINE_ARC => Box::new(circular_arc(&start, &point, &end, &axis_2)?),
            PDN_LINE_CURVE => {
                let function = self.curve.ok_or_else(|| null("curve"))?;
                let callback = Callback::<Function>::new(function, self.user_data, None);
                Box::new(smooth_curve(move |fraction| {
                    // What the function leaves unwritten is found out.
                    let mut position = [f64::NAN; 3];
                    let mut axis_2 = [f64::NAN; 3];
                    callback.invoke("curve", |function, user_data| {
                        let (position, axis_2) = (position.as_mut_ptr(), axis_2.as_mut_ptr());
                        // SAFETY: the caller gave the function with its `user_data`; it writes
                        // three numbers to each place.
                        unsafe { function(fraction, position, axis_2, user_data) }
                    })?;
                    Ok((Vector3::from(position), Vector3::from(axis_2)))
                }))
            }
            other => {
                let expected = "PDN_LINE_STRAIGHT, PDN_LINE_ARC or PDN_LINE_CURVE";
                return Err(Error::value("kind", expected, other));
            }
        })
    }
}

/// Changes the line to `new`, but for its size.
fn replace(line: &mut pdn_line, new: pdn_line) {
    *line = pdn_line {
        struct_size: line.struct_size,
        ..new
    };
}

/// Makes a line that is still to be set. Use it as `PDN_INIT(pdn_line, &line)`.
///
/// @param line  the line; not NULL
/// @param struct_size  sizeof(pdn_line)
///
/// Threads: any.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_line_init(line: *mut pdn_line, struct_size: usize) {
    init(line, struct_size, "line");
}

/// Makes a line straight. Its axes are the same all along.
///
/// @param line  an initialised line; not NULL
/// @param start  array of length 3: where it starts, global coordinates [length]
/// @param end  array of length 3: where it ends, not at start
/// @param axis_2  array of length 3: axis 2 is the part of this direction that is perpendicular to
///     the line; of any nonzero length, not along the line
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE, PDN_ERR_NOT_FINITE
///
/// Threads: exclusive use of `line`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_line_set_straight(
    line: *mut pdn_line,
    start: *const f64,
    end: *const f64,
    axis_2: *const f64,
) -> pdn_status {
    guard(|call| {
        update_struct(call, line, "line", |line| {
            let new = pdn_line {
                start: call.array::<3>(start, "start")?,
                end: call.array::<3>(end, "end")?,
                axis_2: call.array::<3>(axis_2, "axis_2")?,
                ..pdn_line::defaults()
            };
            replace(line, new);
            Ok(())
        })
    })
}

/// Makes a line the circular arc from start through point to end, of up to a whole turn.
///
/// Fractions are of its length. Its axes turn with it about the arc's own axis, so that their
/// curvature is constant.
///
/// @param line  an initialised line; not NULL
/// @param start  array of length 3: where it starts, global coordinates [length]
/// @param point  array of length 3: a point between start and end; the three not on a straight line
/// @param end  array of length 3: where it ends, not at start
/// @param axis_2  array of length 3: axis 2 at the start is the part of this direction that is
///     perpendicular to the arc there; of any nonzero length, not along the arc there
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE, PDN_ERR_NOT_FINITE
///
/// Threads: exclusive use of `line`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_line_set_arc(
    line: *mut pdn_line,
    start: *const f64,
    point: *const f64,
    end: *const f64,
    axis_2: *const f64,
) -> pdn_status {
    guard(|call| {
        update_struct(call, line, "line", |line| {
            let new = pdn_line {
                kind: PDN_LINE_ARC,
                start: call.array::<3>(start, "start")?,
                point: call.array::<3>(point, "point")?,
                end: call.array::<3>(end, "end")?,
                axis_2: call.array::<3>(axis_2, "axis_2")?,
                ..pdn_line::defaults()
            };
            replace(line, new);
            Ok(())
        })
    })
}

/// Makes a line a curve that the caller computes.
///
/// The curve must be smooth, and its fraction advance steadily: it is differentiated by the
/// library, to rounding if it turns by less than half a radian in each 1/16 of the fraction. Join
/// pieces that meet in a corner by ::pdn_model_add_rigid_joint.
///
/// @param line  an initialised line; not NULL
/// @param curve  the curve, see ::pdn_curve_fn for when it is called; not NULL
/// @param user_data  handed to the curve; may be NULL. Must be valid until the line is no longer
///     used
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE
///
/// Threads: exclusive use of `line`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_line_set_curve(
    line: *mut pdn_line,
    curve: pdn_curve_fn,
    user_data: *mut c_void,
) -> pdn_status {
    guard(|call| {
        update_struct(call, line, "line", |line| {
            call.function(curve, "curve")?;
            let new = pdn_line {
                kind: PDN_LINE_CURVE,
                curve,
                user_data,
                ..pdn_line::defaults()
            };
            replace(line, new);
            Ok(())
        })
    })
}
