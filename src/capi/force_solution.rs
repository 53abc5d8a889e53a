//! Solutions: what forces do at any time.

use super::id::Kind;
use super::load::load_frame;
use super::solution::{Samples, SeriesOut, harmonics_of, pdn_solution, place};
use super::status::pdn_status;
use crate::elements::LoadFrame;
use crate::error::{Error, Result};
use crate::output::{ForceQuantity, Quantity};

/// Quantity of a force on a joint coordinate: its effort; 1 component.
pub const PDN_FORCE_EFFORT: i32 = 3000;
/// Quantity of a viscoelastic element: effort of one of its branches; 1 component.
pub const PDN_FORCE_BRANCH_EFFORT: i32 = 3001;
/// Quantity of a viscoelastic element: elongation of the dashpot of one of its branches; 1
/// component.
pub const PDN_FORCE_BRANCH_ELONGATION: i32 = 3002;
/// Quantity of a force: force and moment on one of its nodes, along the inertial axes; 6
/// components.
pub const PDN_FORCE_ON_NODE: i32 = 3003;
/// Quantity of a force: force and moment on one of its nodes, along the node's own axes; 6
/// components.
pub const PDN_FORCE_ON_NODE_MATERIAL: i32 = 3004;

fn force_at(
    to: Samples,
    force: i32,
    quantity: impl FnOnce() -> Result<ForceQuantity>,
) -> pdn_status {
    to.take(|_| {
        Ok(Quantity::Force(
            Kind::Force.index(force, "force")?,
            quantity()?,
        ))
    })
}

/// The quantity of a force that C means.
pub(super) fn force_quantity(quantity: i32, detail: i32) -> Result<ForceQuantity> {
    let branch = || place(detail, "detail");
    let node = || Kind::Node.index(detail, "detail");
    match quantity {
        PDN_FORCE_EFFORT if detail != 0 => Err(Error::value("detail", "zero", detail)),
        PDN_FORCE_EFFORT => Ok(ForceQuantity::Effort),
        PDN_FORCE_BRANCH_EFFORT => Ok(ForceQuantity::BranchEffort(branch()?)),
        PDN_FORCE_BRANCH_ELONGATION => Ok(ForceQuantity::BranchElongation(branch()?)),
        PDN_FORCE_ON_NODE => Ok(ForceQuantity::OnNode(node()?, LoadFrame::Space)),
        PDN_FORCE_ON_NODE_MATERIAL => Ok(ForceQuantity::OnNode(node()?, LoadFrame::Follower)),
        _ => {
            let expected = "PDN_FORCE_EFFORT to PDN_FORCE_ON_NODE_MATERIAL";
            Err(Error::value("quantity", expected, quantity))
        }
    }
}

/// Effort of a force on a joint coordinate, at any times.
///
/// The effort of an actuator is positive where it acts towards growth of the coordinate; that of
/// all others (springs, dampers, viscoelastic elements, the user's laws) where it acts against.
/// Interpolated from its values at the grid points.
///
/// @param solution  the solution; not NULL
/// @param force  id of the force
/// @param times  array of length [count]: times, also outside the first period
/// @param count  number of times
/// @param out  array of length [count] \[force on a displacement, force x length on an angle\]
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_ID, PDN_ERR_NOT_AVAILABLE (the force
///     is not on a joint coordinate), PDN_ERR_OVERFLOW
///
/// Threads: like `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_solution_force_effort(
    solution: *const pdn_solution,
    force: i32,
    times: *const f64,
    count: usize,
    out: *mut f64,
) -> pdn_status {
    let to = Samples::new(solution, times, count, out);
    force_at(to, force, || Ok(ForceQuantity::Effort))
}

/// Effort of one branch of a viscoelastic element, at any times: positive against growth.
///
/// @param solution  the solution; not NULL
/// @param force  id of the viscoelastic element
/// @param branch  number of the branch, from 0, in the order they were given
/// @param times  array of length [count]: times, also outside the first period
/// @param count  number of times
/// @param out  array of length [count] \[force on a displacement, force x length on an angle\]
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_ID, PDN_ERR_NOT_AVAILABLE (there is no
///     such branch), PDN_ERR_OVERFLOW
///
/// Threads: like `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_solution_force_branch_effort(
    solution: *const pdn_solution,
    force: i32,
    branch: i32,
    times: *const f64,
    count: usize,
    out: *mut f64,
) -> pdn_status {
    let quantity = || Ok(ForceQuantity::BranchEffort(place(branch, "branch")?));
    let to = Samples::new(solution, times, count, out);
    force_at(to, force, quantity)
}

/// Elongation of the dashpot of one branch of a viscoelastic element, at any times: its internal
/// state.
///
/// The branch's spring is elongated by the coordinate less this.
///
/// @param solution  the solution; not NULL
/// @param force  id of the viscoelastic element
/// @param branch  number of the branch, from 0, in the order they were given
/// @param times  array of length [count]: times, also outside the first period
/// @param count  number of times
/// @param out  array of length [count] \[length or radian\]
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_ID, PDN_ERR_NOT_AVAILABLE (there is no
///     such branch), PDN_ERR_OVERFLOW
///
/// Threads: like `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_solution_force_branch_elongation(
    solution: *const pdn_solution,
    force: i32,
    branch: i32,
    times: *const f64,
    count: usize,
    out: *mut f64,
) -> pdn_status {
    let quantity = || Ok(ForceQuantity::BranchElongation(place(branch, "branch")?));
    let to = Samples::new(solution, times, count, out);
    force_at(to, force, quantity)
}

/// What a force exerts on one of its nodes, at any times: force, and moment about the node.
///
/// Interpolated from its values at the grid points. For forces of all kinds: those on a joint
/// coordinate act on the nodes of the joint.
///
/// @param solution  the solution; not NULL
/// @param force  id of the force
/// @param node  id of a node that it acts on
/// @param frame  PDN_FRAME_SPACE: components along the inertial axes; PDN_FRAME_MATERIAL: along the
///     node's own
/// @param times  array of length [count]: times, also outside the first period
/// @param count  number of times
/// @param out  array of shape 6 x [count]: force, then moment of each time
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_ID, PDN_ERR_VALUE,
///     PDN_ERR_NOT_AVAILABLE (it does not act on the node), PDN_ERR_OVERFLOW
///
/// Threads: like `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_solution_force_on_node(
    solution: *const pdn_solution,
    force: i32,
    node: i32,
    frame: i32,
    times: *const f64,
    count: usize,
    out: *mut f64,
) -> pdn_status {
    let quantity = || {
        let node = Kind::Node.index(node, "node")?;
        Ok(ForceQuantity::OnNode(node, load_frame(frame)?))
    };
    let to = Samples::new(solution, times, count, out);
    force_at(to, force, quantity)
}

/// Fourier coefficients of a force's quantity: mean + rate t + sum of cosines[j] cos jwt + sines[j]
/// sin jwt.
///
/// Those of the trigonometric polynomial through the values at the grid points.
///
/// @param solution  the solution; not NULL
/// @param force  id of the force
/// @param quantity  PDN_FORCE_EFFORT, ...; it has C components
/// @param detail  the branch (PDN_FORCE_BRANCH_...) or the node (PDN_FORCE_ON_NODE...); otherwise 0
/// @param harmonics  number of harmonics wanted; those above (N - 1) / 2 are zero
/// @param mean  array of length C; may be NULL
/// @param rate  array of length C: growth per unit of time, of a dashpot that gains turns; may be
///     NULL
/// @param cosines  array of shape C x [harmonics], components of each harmonic together; may be
///     NULL
/// @param sines  as cosines; may be NULL
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_SIZE, PDN_ERR_ID, PDN_ERR_VALUE, PDN_ERR_NOT_AVAILABLE,
///     PDN_ERR_OVERFLOW
///
/// Threads: like `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_solution_force_harmonics(
    solution: *const pdn_solution,
    force: i32,
    quantity: i32,
    detail: i32,
    harmonics: usize,
    mean: *mut f64,
    rate: *mut f64,
    cosines: *mut f64,
    sines: *mut f64,
) -> pdn_status {
    let to = SeriesOut::new(harmonics, mean, rate, [cosines, sines]);
    harmonics_of(solution, &to, |_| {
        let quantity = force_quantity(quantity, detail)?;
        Ok(Quantity::Force(
            Kind::Force.index(force, "force")?,
            quantity,
        ))
    })
}
