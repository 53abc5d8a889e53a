//! What a model consists of, how it can move, and what looks like a mistake.

use super::guard::{guard, guard_or, init};
use super::last_error::copy_message;
use super::model::pdn_model;
use super::options::Options;
use super::status::pdn_status;
use crate::system::Summary;
use libc::c_char;

/// Counts, mass and mobility of a model. Initialise with `PDN_INIT(pdn_summary, &summary)`.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct pdn_summary {
    /// Set by the initialiser.
    pub struct_size: usize,
    /// Number of nodes.
    pub nodes: i32,
    /// Number of beam elements.
    pub beam_elements: i32,
    /// Number of joints.
    pub joints: i32,
    /// Number of prescribed joint coordinates.
    pub prescribed: i32,
    /// Number of constraints: those of the joints, and one for each prescribed coordinate and each
    /// relation between coordinates.
    pub constraints: i32,
    /// Number of these that depend on others in the reference configuration.
    pub redundant_constraints: i32,
    /// Degrees of freedom: six for each node, less the independent constraints.
    pub degrees_of_freedom: i32,
    /// Number of members: bodies, and connected beams, each taken as one rigid body.
    pub members: i32,
    /// Degrees of freedom that were left if all members were rigid: 0 is a structure, or a
    /// mechanism whose motion is prescribed; 6 more for each free body.
    pub mobility: i32,
    /// Constraints that would depend on others if all members were rigid.
    pub redundant_if_rigid: i32,
    /// Number of parts that nothing connects to each other, neither directly nor through the
    /// ground.
    pub parts: i32,
    /// Number of warnings, which ::pdn_model_describe writes out.
    pub warnings: i32,
    /// Total mass.
    pub mass: f64,
    /// Centre of mass, in global coordinates; zero if there is no mass.
    pub centre: [f64; 3],
}

// SAFETY: all fields are plain numbers, `struct_size` is the first, no padding.
unsafe impl Options for pdn_summary {
    const SIZES: &'static [usize] = &[88];
}

/// Prepares a struct for ::pdn_model_summary; use `PDN_INIT(pdn_summary, &summary)`.
///
/// @param summary  the struct; not NULL
/// @param struct_size  `sizeof *summary`
///
/// Threads: any.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_summary_init(summary: *mut pdn_summary, struct_size: usize) {
    init(summary, struct_size, "summary");
}

/// Counts, mass, degrees of freedom and mobility of a model in its reference configuration.
///
/// @param model  the model
/// @param out  initialised by PDN_INIT; filled on success only
/// @return PDN_OK; PDN_ERR_NULL; PDN_ERR_STRUCT_SIZE; PDN_ERR_MODEL (no node, a beam too
///     distorted); PDN_ERR_OVERFLOW (of the mass); PDN_ERR_CALLBACK (of a signal)
///
/// Threads: like `const`. Signals' functions are called on this thread.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_summary(
    model: *const pdn_model,
    out: *mut pdn_summary,
) -> pdn_status {
    guard(|call| {
        let model = call.shared(model, "model")?;
        let out = call.out_struct(out, "out")?;
        let summary = Summary::of(&model)?;
        let count = |n: usize| i32::try_from(n).unwrap_or(i32::MAX);
        out.set(pdn_summary {
            nodes: count(summary.nodes),
            beam_elements: count(summary.beam_elements),
            joints: count(summary.joints),
            prescribed: count(summary.prescribed),
            constraints: count(summary.constraints),
            redundant_constraints: count(summary.redundant),
            degrees_of_freedom: count(summary.freedoms),
            members: count(summary.members),
            mobility: count(summary.mobility),
            redundant_if_rigid: count(summary.redundant_if_rigid),
            parts: count(summary.parts),
            warnings: count(summary.warnings.len()),
            mass: summary.mass,
            centre: summary.centre.into(),
            ..pdn_summary::defaults()
        });
        Ok(())
    })
}

/// The same in readable lines, with warnings: parts that nothing connects or holds, ends of beams
/// without a joint, nodes without inertia, joints open in the reference configuration or far from
/// all else, impossible moments of inertia, sizes, masses and stiffnesses that do not fit each
/// other.
///
/// @param model  the model; not NULL
/// @param buffer  array of length [capacity] for the text, UTF-8, always ended by NUL; may be NULL
///     if capacity is 0
/// @param capacity  size of buffer in bytes
/// @return length of the whole text without the NUL, as snprintf does; 0 if the handle is not valid
///     or ::pdn_model_summary fails, see ::pdn_last_error
///
/// Threads: like `const`. Signals' functions are called on this thread.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_describe(
    model: *const pdn_model,
    buffer: *mut c_char,
    capacity: usize,
) -> usize {
    guard_or(0, |call| {
        let text = Summary::of(&*call.shared(model, "model")?)?.to_string();
        copy_message(&text, buffer, capacity);
        Ok(text.len())
    })
}
