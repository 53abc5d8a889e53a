//! Natural modes and damped eigenvalues.

use super::guard::{free, guard, guard_or, init};
use super::handle::Handle;
use super::id::Kind;
use super::last_error::copy_message;
use super::model::{number, pdn_model};
use super::options::Options;
use super::solution::{outcome_code, pdn_solution};
use super::statics::{pdn_static_options, read_static_options};
use super::status::pdn_status;
use crate::error::Result;
use crate::memory;
use crate::model::Labels;
use crate::output::Modes;
use crate::solve::ModesOptions;
use libc::c_char;

/// An equilibrium and the modes about it. Made by ::pdn_solve_modes, freed by ::pdn_modes_free.
pub struct pdn_modes {
    _private: [u8; 0],
}

impl Handle for pdn_modes {
    type Core = Modes;

    fn labels(core: &Modes) -> Option<&Labels> {
        Some(core.model().labels())
    }
}

/// Options of ::pdn_solve_modes. Set the defaults by `PDN_INIT(pdn_modes_options, &options)`.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct pdn_modes_options {
    /// Set by the initialiser.
    pub struct_size: usize,
    /// The equilibrium, at rest or in steady rotation, how to find it, and who is told of the
    /// iterations; NULL for the defaults of ::pdn_static_options. Default NULL.
    pub equilibrium: *const pdn_static_options,
    /// Number of modes wanted. Default 10.
    pub count: usize,
    /// Angular frequency near which modes are wanted \[angle/time\]; 0 for those of the smallest
    /// eigenvalues. Default 0.
    pub near_frequency: f64,
}

// SAFETY: all fields are plain numbers or pointers, `struct_size` is the first, no padding.
unsafe impl Options for pdn_modes_options {
    const SIZES: &'static [usize] = &[32];

    fn defaults() -> Self {
        pdn_modes_options {
            count: ModesOptions::default().count,
            ..Self::blank()
        }
    }
}

/// Sets default options; use `PDN_INIT(pdn_modes_options, &options)`.
///
/// @param options  the options; not NULL
/// @param struct_size  `sizeof *options`
///
/// Threads: any.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_modes_options_init(
    options: *mut pdn_modes_options,
    struct_size: usize,
) {
    init(options, struct_size, "options");
}

/// Finds an equilibrium and the modes of small motions `Re(x exp(s t))` about it.
///
/// The equations of motion with their exact tangents are linearised to `(s² M + s C + K) x = 0`,
/// constraints, internal states of viscoelastic forces, and in a turning frame gyroscopic and
/// centrifugal terms included. Of conjugate pairs of eigenvalues s one is given; constraints make
/// no modes. Each free motion is a mode whose s is exactly 0.
///
/// That there is no equilibrium is no error: ::pdn_modes_outcome tells, and there are no modes.
///
/// @param model  the model; it is copied, so that later changes do not touch the modes
/// @param options  may be NULL for the defaults
/// @param out  the modes; free them with ::pdn_modes_free; written on success only
/// @return PDN_OK; PDN_ERR_SIZE (no modes or too many wanted); PDN_ERR_OVERFLOW (stiffnesses and
///     masses too far apart); else as ::pdn_solve_static
///
/// Threads: like a `const` use of `model` and of `options.equilibrium.initial`. Signals' functions
/// and `progress` are called on this thread.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_solve_modes(
    model: *const pdn_model,
    options: *const pdn_modes_options,
    out: *mut *mut pdn_modes,
) -> pdn_status {
    guard(|call| {
        let model = call.shared(model, "model")?;
        let given = call.options(options, "options")?;
        let name = "options.equilibrium";
        let equilibrium = call.options(given.equilibrium, name)?;
        let near = call.number(given.near_frequency, "options.near_frequency")?;
        let out = call.out(out, "out")?;
        let options = ModesOptions {
            equilibrium: read_static_options(call, &equilibrium, &model, name)?,
            count: given.count,
            near_frequency: (near != 0.0).then_some(near),
        };
        out.give(Modes::solve(&model, &options, &mut |_, _| true)?);
        Ok(())
    })
}

/// Frees modes; NULL does nothing. Solutions made from them stay.
///
/// @param modes  the modes, not to be used any more
///
/// Threads: exclusive use of `modes`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_modes_free(modes: *mut pdn_modes) {
    free(modes);
}

/// How the search for the equilibrium ended.
///
/// @param modes  the modes; not NULL
/// @return as ::pdn_solution_outcome; unless it is PDN_CONVERGED there are no modes
///
/// Threads: like `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_modes_outcome(modes: *const pdn_modes) -> i32 {
    let mut outcome = 0;
    let status = guard(|call| {
        outcome = outcome_code(call.shared(modes, "modes")?.outcome());
        Ok(())
    });
    if status < 0 { status } else { outcome }
}

/// A readable report: outcome of the equilibrium and why, and a table of the modes.
///
/// @param modes  the modes; not NULL
/// @param buffer  array of length [capacity] for the text, UTF-8, always ended by NUL; may be NULL
///     if capacity is 0
/// @param capacity  size of buffer in bytes
/// @return length of the whole report without the NUL, as snprintf does; 0 if the handle is not
///     valid
///
/// Threads: like `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_modes_report(
    modes: *const pdn_modes,
    buffer: *mut c_char,
    capacity: usize,
) -> usize {
    guard_or(0, |call| {
        let report = call.shared(modes, "modes")?.report();
        copy_message(&report, buffer, capacity);
        Ok(report.len())
    })
}

/// Number of modes: as many as were wanted, if there are and they were found.
///
/// @param modes  the modes; not NULL
/// @param out  the number; written on success only
/// @param complete  1 if the wanted number was found, or all that there are, else 0; may be NULL;
///     written on success only
/// @return PDN_OK, PDN_ERR_NULL
///
/// Threads: like `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_modes_count(
    modes: *const pdn_modes,
    out: *mut i32,
    complete: *mut i32,
) -> pdn_status {
    guard(|call| {
        let modes = call.shared(modes, "modes")?;
        let out = call.out(out, "out")?;
        let complete = call.out_optional(complete, "complete")?;
        // No more than options.count can be, which is limited.
        out.set(modes.modes().len() as i32);
        if let Some(complete) = complete {
            complete.set(i32::from(modes.is_complete()));
        }
        Ok(())
    })
}

/// A small motion `Re(x exp(s t))`. Initialise with `PDN_INIT(pdn_mode, &mode)`.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct pdn_mode {
    /// Set by the initialiser.
    pub struct_size: usize,
    /// Real part of the eigenvalue s \[1/time\]; negative if the motion decays.
    pub eigenvalue_real: f64,
    /// Imaginary part of s \[angle/time\], not negative.
    pub eigenvalue_imaginary: f64,
    /// Oscillations per unit of time, Im s / 2π.
    pub frequency: f64,
    /// Damping ratio, -Re s / |s|; 0 for a free motion.
    pub damping_ratio: f64,
    /// Product of the shape with M and its own conjugate, with the shape as ::pdn_modes_shape gives
    /// it.
    pub modal_mass: f64,
    /// Largest entry of the equations of small motions, relative to the largest sum of the sizes of
    /// their terms: rounding, if all is well.
    pub residual: f64,
}

// SAFETY: all fields are plain numbers, `struct_size` is the first, no padding.
unsafe impl Options for pdn_mode {
    const SIZES: &'static [usize] = &[56];
}

/// Prepares a struct for ::pdn_modes_get; use `PDN_INIT(pdn_mode, &mode)`.
///
/// @param mode  the struct; not NULL
/// @param struct_size  `sizeof *mode`
///
/// Threads: any.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_mode_init(mode: *mut pdn_mode, struct_size: usize) {
    init(mode, struct_size, "mode");
}

/// Eigenvalue, frequency and damping of a mode.
///
/// @param modes  the modes; not NULL
/// @param mode  number of the mode, from 0; the smallest eigenvalue, or the nearest to the wanted
///     frequency, is first
/// @param out  initialised by PDN_INIT; filled on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID, PDN_ERR_STRUCT_SIZE
///
/// Threads: like `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_modes_get(
    modes: *const pdn_modes,
    mode: i32,
    out: *mut pdn_mode,
) -> pdn_status {
    guard(|call| {
        let modes = call.shared(modes, "modes")?;
        let mode = modes.mode(mode_index(&modes, mode)?)?;
        let out = call.out_struct(out, "out")?;
        out.set(pdn_mode {
            eigenvalue_real: mode.eigenvalue.re,
            eigenvalue_imaginary: mode.eigenvalue.im,
            frequency: mode.frequency(),
            damping_ratio: mode.damping_ratio(),
            modal_mass: mode.modal_mass,
            residual: mode.residual,
            ..pdn_mode::defaults()
        });
        Ok(())
    })
}

/// Shape x of a mode at some nodes.
///
/// For each node its small displacement and rotation along the node's own axes, as they are in the
/// equilibrium. The largest component of all nodes is 1, with displacements relative to the size of
/// the mechanism and rotations in radians.
///
/// @param modes  the modes; not NULL
/// @param mode  number of the mode, from 0
/// @param nodes  array of length [count]: ids of the nodes
/// @param count  number of nodes
/// @param real  array of shape 6 x [count]: real part, components fastest
/// @param imaginary  array of shape 6 x [count]: imaginary part; may be NULL
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID, PDN_ERR_SIZE
///
/// Threads: like `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_modes_shape(
    modes: *const pdn_modes,
    mode: i32,
    nodes: *const i32,
    count: usize,
    real: *mut f64,
    imaginary: *mut f64,
) -> pdn_status {
    guard(|call| {
        let modes = call.shared(modes, "modes")?;
        let mode = mode_index(&modes, mode)?;
        let nodes = call.slice(nodes, count, "nodes")?;
        let length = count.saturating_mul(6);
        let real = call.out_slice(real, length, length, "real")?;
        let imaginary = call.out_slice_optional(imaginary, length, "imaginary")?;
        let mut re = memory::room("the shape", length)?;
        let mut im = memory::room("the shape", length)?;
        let total = modes.mode(mode)?.shape.len();
        for (k, &node) in nodes.iter().enumerate() {
            let node = Kind::Node.index_below(node, total, &format!("nodes[{k}]"))?;
            let shape = modes.shape(mode, node)?;
            re.extend(shape.map(|x| x.re));
            im.extend(shape.map(|x| x.im));
        }
        real.set(&re);
        if let Some(imaginary) = imaginary {
            imaginary.set(&im);
        }
        Ok(())
    })
}

/// The motion in a mode, to be looked at as any other solution.
///
/// From the equilibrium each node moves by the exponential of `amplitude Re(x exp(i ω t))`, with ω
/// = Im s: it neither decays nor grows, and repeats after 2π/ω. For a real s, ω is its size; for a
/// free motion the period is that of the options, or 1. The equations hold but for the square of
/// the amplitude.
///
/// @param modes  the modes; not NULL
/// @param mode  number of the mode, from 0
/// @param amplitude  factor of the shape
/// @param out  the solution; free it with ::pdn_solution_free; written on success only
/// @return PDN_OK; PDN_ERR_NULL; PDN_ERR_ID; PDN_ERR_NOT_FINITE; PDN_ERR_MODEL or
///     PDN_ERR_GRID_TOO_COARSE (an amplitude so large that beams fold or turns cannot be followed);
///     PDN_ERR_OVERFLOW (one larger still); PDN_ERR_CALLBACK; PDN_ERR_MEMORY
///
/// Threads: like `const`; signals' functions are called on this thread.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_modes_motion(
    modes: *const pdn_modes,
    mode: i32,
    amplitude: f64,
    out: *mut *mut pdn_solution,
) -> pdn_status {
    guard(|call| {
        let modes = call.shared(modes, "modes")?;
        let mode = mode_index(&modes, mode)?;
        let amplitude = call.number(amplitude, "amplitude")?;
        let out = call.out(out, "out")?;
        out.give(modes.motion(mode, amplitude)?);
        Ok(())
    })
}

/// The equilibrium, as ::pdn_solve_static gives it, converged or not.
///
/// @param modes  the modes; not NULL
/// @param out  the solution; free it with ::pdn_solution_free; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_CALLBACK, PDN_ERR_MEMORY
///
/// Threads: like `const`; signals' functions are called on this thread.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_modes_equilibrium(
    modes: *const pdn_modes,
    out: *mut *mut pdn_solution,
) -> pdn_status {
    guard(|call| {
        let modes = call.shared(modes, "modes")?;
        let out = call.out(out, "out")?;
        out.give(modes.equilibrium()?);
        Ok(())
    })
}

fn mode_index(modes: &Modes, mode: i32) -> Result<usize> {
    number(mode, modes.modes().len(), "mode", "a mode's number")
}
