//! Surfaces to mesh with shells, by value.

use super::call::Call;
use super::callback::Callback;
use super::guard::{guard, init};
use super::options::Options;
use super::pointer::null;
use super::section::{read_struct, update_struct};
use super::status::pdn_status;
use crate::error::{Error, Result};
use crate::model::{annulus_sector, cylinder, rectangle};
use libc::c_void;
use nalgebra::Vector3;
use std::mem::offset_of;

/// Kind of a surface: parallelogram.
pub const PDN_SURFACE_PARALLELOGRAM: i32 = 1800;
/// Kind of a surface: sector of an annulus.
pub const PDN_SURFACE_ANNULUS: i32 = 1801;
/// Kind of a surface: cylinder.
pub const PDN_SURFACE_CYLINDER: i32 = 1802;
/// Kind of a surface: one that the caller computes.
pub const PDN_SURFACE_FUNCTION: i32 = 1803;

/// A surface in space, to be written by the caller.
///
/// Called only during the call that takes the surface, on its thread, once for each node. It must
/// neither throw nor jump out, nor use the model that the shell is added to.
///
/// @param u  place in the first direction, from 0 to 1
/// @param v  place in the second direction, from 0 to 1
/// @param position  array of length 3: where the position goes, global coordinates \[length\];
///     valid during the call only
/// @param user_data  as given to ::pdn_surface_set_function
/// @return 0 for success; anything else makes the call fail with PDN_ERR_CALLBACK (see
///     ::pdn_set_callback_error and ::pdn_last_callback_code)
pub type pdn_surface_fn =
    Option<unsafe extern "C" fn(u: f64, v: f64, position: *mut f64, user_data: *mut c_void) -> i32>;

/// The function pointer without its `Option`.
type Function = unsafe extern "C" fn(f64, f64, *mut f64, *mut c_void) -> i32;

/// A surface: a point for each pair (u, v), each from 0 to 1.
///
/// Its normal is that of the tangents along u and v, in this order. Start with
/// `PDN_INIT(pdn_surface, &surface)`; then one of the `pdn_surface_set_...`, each of which replaces
/// all that was set before. Leave the fields to them.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct pdn_surface {
    /// Set by the initialiser.
    pub struct_size: usize,
    /// PDN_SURFACE_PARALLELOGRAM, PDN_SURFACE_ANNULUS, PDN_SURFACE_CYLINDER or
    /// PDN_SURFACE_FUNCTION.
    pub kind: i32,
    /// Leave it zero.
    pub reserved: i32,
    /// Corner of a parallelogram, centre of an annulus or of the end of a cylinder.
    pub origin: [f64; 3],
    /// Side along u of a parallelogram, axis of the others.
    pub axis: [f64; 3],
    /// Side along v of a parallelogram, direction of where the others start.
    pub start: [f64; 3],
    /// Inner and outer radius, or radius and length.
    pub sizes: [f64; 2],
    /// Angle of an annulus or a cylinder.
    pub angle: f64,
    /// The function.
    pub function: pdn_surface_fn,
    /// Handed to the function.
    pub user_data: *mut c_void,
}

// SAFETY: numbers and pointers only, `struct_size` is the first, and there is no padding.
unsafe impl Options for pdn_surface {
    // A release that adds a field adds where that field ends.
    const SIZES: &'static [usize] =
        &[offset_of!(pdn_surface, user_data) + size_of::<*mut c_void>()];

    fn defaults() -> Self {
        pdn_surface {
            kind: PDN_SURFACE_PARALLELOGRAM,
            ..Self::blank()
        }
    }
}

/// Points of a surface.
pub(super) type Surface = Box<dyn Fn([f64; 2]) -> Result<Vector3<f64>>>;

/// The surface that an argument gives. What it calls is the caller's, and there during the call
/// only.
pub(super) fn read(call: &Call, surface: *const pdn_surface, name: &str) -> Result<Surface> {
    let given = read_struct(call, surface, name)?;
    given.core().map_err(|error| error.within(name))
}

impl pdn_surface {
    fn core(&self) -> Result<Surface> {
        if self.reserved != 0 {
            return Err(Error::value("reserved", "zero", self.reserved));
        }
        let (origin, axis) = (self.origin.into(), self.axis.into());
        let (start, sizes, angle) = (self.start.into(), self.sizes, self.angle);
        Ok(match self.kind {
            PDN_SURFACE_PARALLELOGRAM => Box::new(rectangle(&origin, &axis, &start)?),
            PDN_SURFACE_ANNULUS => Box::new(annulus_sector(&origin, &axis, &start, sizes, angle)?),
            PDN_SURFACE_CYLINDER => Box::new(cylinder(&origin, &axis, &start, sizes, angle)?),
            PDN_SURFACE_FUNCTION => {
                let function = self.function.ok_or_else(|| null("function"))?;
                let callback = Callback::<Function>::new(function, self.user_data, None);
                Box::new(move |[u, v]| {
                    // What the function leaves unwritten is found out.
                    let mut position = [f64::NAN; 3];
                    callback.invoke("function", |function, user_data| {
                        // SAFETY: the caller gave the function with its `user_data`; it writes
                        // three numbers.
                        unsafe { function(u, v, position.as_mut_ptr(), user_data) }
                    })?;
                    Ok(Vector3::from(position))
                })
            }
            other => {
                let expected = "a constant PDN_SURFACE_...";
                return Err(Error::value("kind", expected, other));
            }
        })
    }
}

/// Changes the surface to `new`, but for its size.
fn replace(surface: &mut pdn_surface, new: pdn_surface) {
    *surface = pdn_surface {
        struct_size: surface.struct_size,
        ..new
    };
}

/// Makes a surface that is still to be set. Use it as `PDN_INIT(pdn_surface, &surface)`.
///
/// @param surface  the surface; not NULL
/// @param struct_size  sizeof(pdn_surface)
///
/// Threads: any.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_surface_init(surface: *mut pdn_surface, struct_size: usize) {
    init(surface, struct_size, "surface");
}

/// Makes a surface a parallelogram, such as a rectangle.
///
/// @param surface  an initialised surface; not NULL
/// @param corner  array of length 3: the point at u = v = 0, global coordinates [length]
/// @param along_u  array of length 3: the side from there along u [length]
/// @param along_v  array of length 3: the side along v, not parallel to it [length]
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE, PDN_ERR_NOT_FINITE
///
/// Threads: exclusive use of `surface`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_surface_set_parallelogram(
    surface: *mut pdn_surface,
    corner: *const f64,
    along_u: *const f64,
    along_v: *const f64,
) -> pdn_status {
    guard(|call| {
        update_struct(call, surface, "surface", |surface| {
            let new = pdn_surface {
                origin: call.array::<3>(corner, "corner")?,
                axis: call.array::<3>(along_u, "along_u")?,
                start: call.array::<3>(along_v, "along_v")?,
                ..pdn_surface::defaults()
            };
            replace(surface, new);
            Ok(())
        })
    })
}

/// Makes a surface an annulus or a sector of one: u from the inner to the outer radius, v around
/// the axis. The normal is along the axis for positive angles.
///
/// @param surface  an initialised surface; not NULL
/// @param centre  array of length 3: its centre, global coordinates [length]
/// @param axis  array of length 3: direction of its axis, of any nonzero length
/// @param start  array of length 3: where v = 0 is, seen from the centre: the part of this
///     direction across the axis; not along the axis
/// @param inner  inner radius, positive [length]
/// @param outer  outer radius, more than the inner [length]
/// @param angle  angle about the axis, right-handed; not zero, at most one turn [radian]
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE, PDN_ERR_NOT_FINITE
///
/// Threads: exclusive use of `surface`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_surface_set_annulus(
    surface: *mut pdn_surface,
    centre: *const f64,
    axis: *const f64,
    start: *const f64,
    inner: f64,
    outer: f64,
    angle: f64,
) -> pdn_status {
    guard(|call| {
        update_struct(call, surface, "surface", |surface| {
            let new = pdn_surface {
                kind: PDN_SURFACE_ANNULUS,
                origin: call.array::<3>(centre, "centre")?,
                axis: call.array::<3>(axis, "axis")?,
                start: call.array::<3>(start, "start")?,
                sizes: [call.number(inner, "inner")?, call.number(outer, "outer")?],
                angle: call.number(angle, "angle")?,
                ..pdn_surface::defaults()
            };
            replace(surface, new);
            Ok(())
        })
    })
}

/// Makes a surface a cylinder or a sector of one: u around the axis, v along it. The normal is
/// outwards for positive angles.
///
/// @param surface  an initialised surface; not NULL
/// @param centre  array of length 3: the centre of its end, v = 0, global coordinates [length]
/// @param axis  array of length 3: direction of its axis, of any nonzero length
/// @param start  array of length 3: where u = 0 is, seen from the centre: the part of this
///     direction across the axis; not along the axis
/// @param radius  radius, positive [length]
/// @param length  length along the axis, positive [length]
/// @param angle  angle about the axis, right-handed; not zero, at most one turn [radian]
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE, PDN_ERR_NOT_FINITE
///
/// Threads: exclusive use of `surface`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_surface_set_cylinder(
    surface: *mut pdn_surface,
    centre: *const f64,
    axis: *const f64,
    start: *const f64,
    radius: f64,
    length: f64,
    angle: f64,
) -> pdn_status {
    guard(|call| {
        update_struct(call, surface, "surface", |surface| {
            let new = pdn_surface {
                kind: PDN_SURFACE_CYLINDER,
                origin: call.array::<3>(centre, "centre")?,
                axis: call.array::<3>(axis, "axis")?,
                start: call.array::<3>(start, "start")?,
                sizes: [
                    call.number(radius, "radius")?,
                    call.number(length, "length")?,
                ],
                angle: call.number(angle, "angle")?,
                ..pdn_surface::defaults()
            };
            replace(surface, new);
            Ok(())
        })
    })
}

/// Makes a surface one that the caller computes, smooth within each element.
///
/// @param surface  an initialised surface; not NULL
/// @param function  the surface, see ::pdn_surface_fn for when it is called; not NULL
/// @param user_data  handed to the function; may be NULL. Must be valid until the surface is no
///     longer used
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE
///
/// Threads: exclusive use of `surface`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_surface_set_function(
    surface: *mut pdn_surface,
    function: pdn_surface_fn,
    user_data: *mut c_void,
) -> pdn_status {
    guard(|call| {
        update_struct(call, surface, "surface", |surface| {
            call.function(function, "function")?;
            let new = pdn_surface {
                kind: PDN_SURFACE_FUNCTION,
                function,
                user_data,
                ..pdn_surface::defaults()
            };
            replace(surface, new);
            Ok(())
        })
    })
}
