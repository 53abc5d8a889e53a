//! The equations of a periodic motion, below the solve, for solvers of others.

use super::call::Call;
use super::guard::{free, guard, init};
use super::handle::Handle;
use super::id::Kind;
use super::linear_solver::{PDN_LINEAR_AUTOMATIC, preconditioner_code, read_linear_solver};
use super::model::pdn_model;
use super::options::Options;
use super::periodic::read_threads;
use super::pointer::null;
use super::ranks::CallerRanks;
use super::solution::{pdn_solution, read_outcome};
use super::status::pdn_status;
use crate::error::{Error, ErrorKind, Result};
use crate::fourier::TimeGrid;
use crate::output::Solution;
use crate::ranks::{Alone, Ranks};
use crate::solve::{LinearMethod, Preconditioner, RankEquations, RankOptions, require_states};
use libc::c_void;
use std::ptr::null_mut;
use std::sync::{Arc, Mutex, MutexGuard, TryLockError};

/// The equations of a periodic motion on a grid, or a rank's part of them. Made by
/// ::pdn_equations_new, freed by ::pdn_equations_free.
///
/// They are for solvers of your own: residual, Jacobian as an operator, preconditioner, and steps
/// of the motions. With several ranks, such as those of MPI, each has the equations and unknowns of
/// its nodes, over the whole period; what they have to tell each other goes through functions that
/// you give. A function that is said to be called by all ranks must be called by all of them, in
/// the same order; if it fails on one it fails on all, with the same status, unless it is said
/// otherwise.
///
/// Vectors hold the unknowns, or the equations, of the rank, scaled: first of each of its nodes,
/// in ascending order, the six components of the increment (displacement along the node's axes
/// relative to the characteristic length, then turn about them in radians) at one grid point after
/// the other. Then, for each element with multipliers or internal states whose first node is the
/// rank's, these at one grid point after the other. Then, with the preconditioner
/// PDN_LINEAR_BODY_CIRCULANT or PDN_LINEAR_CIRCULANT, stress resultants of beams, which are
/// unknowns of their own there: the residual has zeros for them, and steps do not look at them.
pub struct pdn_equations {
    _private: [u8; 0],
}

impl Handle for pdn_equations {
    type Core = Mutex<RankEquations>;
}

/// Sends numbers from each rank to each, as MPI_Alltoallv does. Called by all ranks.
///
/// Arrays are valid during the call only; those of counts have one for each rank. What goes to rank
/// r stands in `send` behind what goes to those before it, and what comes from it likewise in
/// `receive`. Counts may be zero, and pointers NULL where all are. Return 0, or anything else where
/// numbers cannot be sent: that call fails with PDN_ERR_CALLBACK.
pub type pdn_exchange_fn = Option<
    unsafe extern "C" fn(
        send: *const f64,
        send_counts: *const usize,
        receive: *mut f64,
        receive_counts: *const usize,
        user_data: *mut c_void,
    ) -> i32,
>;

/// Sends numbers from each rank to all, itself too, as MPI_Allgatherv does. Called by all ranks.
///
/// Arrays are valid during the call only. What comes from rank r, of the length
/// `receive_counts[r]`, stands in `receive` behind what comes from those before it; `send` has
/// `send_count` numbers, which is what the others expect from this rank. Return 0, or anything else
/// where numbers cannot be sent: that call fails with PDN_ERR_CALLBACK.
pub type pdn_gather_fn = Option<
    unsafe extern "C" fn(
        send: *const f64,
        send_count: usize,
        receive: *mut f64,
        receive_counts: *const usize,
        user_data: *mut c_void,
    ) -> i32,
>;

/// Options of ::pdn_equations_new. Set the defaults by `PDN_INIT(pdn_equations_options, &options)`.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct pdn_equations_options {
    /// Set by the initialiser.
    pub struct_size: usize,
    /// Number N of grid points, odd; to be set.
    pub grid_points: usize,
    /// Where to begin: a solution as for pdn_periodic_options.initial; NULL for the reference
    /// configuration. Default NULL.
    pub initial: *const pdn_solution,
    /// Rank of each node, an array of length [owner_count]; NULL for runs of nodes with about the
    /// same work. Each rank must have a node. Default NULL.
    pub owners: *const i32,
    /// Number of nodes, if there are owners.
    pub owner_count: usize,
    /// Number of this rank, from 0. Default 0.
    pub rank: i32,
    /// How many ranks there are. Default 1.
    pub ranks: i32,
    /// The preconditioner: PDN_LINEAR_TIME_LOCAL, PDN_LINEAR_BODY_CIRCULANT, PDN_LINEAR_CIRCULANT,
    /// or PDN_LINEAR_AUTOMATIC for the first where joints turn in the initial motion, the second
    /// otherwise. Default PDN_LINEAR_AUTOMATIC.
    pub preconditioner: i32,
    /// Threads of this rank that share its work; 0 for as many as there are processors. Default 1.
    pub threads: i32,
    /// Sends numbers from each rank to each; needed with more than one rank. Default NULL.
    pub exchange: pdn_exchange_fn,
    /// Sends numbers from each rank to all; needed with more than one rank. Default NULL.
    pub gather: pdn_gather_fn,
    /// Handed to exchange and gather.
    pub ranks_data: *mut c_void,
}

// SAFETY: all fields are plain numbers or pointers, `struct_size` is the first, no padding.
unsafe impl Options for pdn_equations_options {
    const SIZES: &'static [usize] = &[80];

    fn defaults() -> Self {
        pdn_equations_options {
            ranks: 1,
            threads: 1,
            preconditioner: PDN_LINEAR_AUTOMATIC,
            ..Self::blank()
        }
    }
}

/// Sets default options; use `PDN_INIT(pdn_equations_options, &options)`.
///
/// @param options  the options; not NULL
/// @param struct_size  `sizeof *options`
///
/// Threads: any.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_equations_options_init(
    options: *mut pdn_equations_options,
    struct_size: usize,
) {
    init(options, struct_size, "options");
}

/// Sizes of the equations, and of the vectors of this rank.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct pdn_equations_sizes {
    /// Set by the initialiser.
    pub struct_size: usize,
    /// Numbers of a vector of this rank.
    pub size: usize,
    /// Numbers of other ranks that it keeps copies of.
    pub halo: usize,
    /// Numbers of the vectors of all ranks.
    pub total: usize,
    /// Nodes of this rank.
    pub nodes: usize,
    /// Numbers of its motions, 12 for each node and grid point.
    pub motions: usize,
    /// Own unknowns of its elements, multipliers and internal states, at all grid points.
    pub own_unknowns: usize,
    /// Bytes that tangents, factors and vectors take here.
    pub bytes: usize,
    /// The preconditioner: PDN_LINEAR_TIME_LOCAL, PDN_LINEAR_BODY_CIRCULANT or
    /// PDN_LINEAR_CIRCULANT.
    pub preconditioner: i32,
    /// Zero.
    pub reserved: i32,
}

// SAFETY: all fields are plain numbers, `struct_size` is the first, no padding.
unsafe impl Options for pdn_equations_sizes {
    const SIZES: &'static [usize] = &[72];
}

/// Sets `struct_size`; use `PDN_INIT(pdn_equations_sizes, &sizes)`.
///
/// @param sizes  the sizes; not NULL
/// @param struct_size  `sizeof *sizes`
///
/// Threads: any.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_equations_sizes_init(
    sizes: *mut pdn_equations_sizes,
    struct_size: usize,
) {
    init(sizes, struct_size, "sizes");
}

/// Makes the equations of a periodic motion on a grid, or a rank's part. By all ranks.
///
/// @param model  the model; it is copied
/// @param period  T, the period of the response
/// @param options  not NULL, as the number of grid points has no default. Model, period, grid,
///     owners, preconditioner and start must be the same on all ranks, which is checked
/// @param out  the equations at the start; free them with ::pdn_equations_free; written on success
///     only
/// @return PDN_OK; PDN_ERR_NULL; PDN_ERR_NOT_FINITE; PDN_ERR_SIZE (even number of grid points,
///     owners for another number of nodes); PDN_ERR_VALUE (what is not the same on all ranks, more
///     ranks than nodes, a rank without nodes); PDN_ERR_STRUCT_SIZE; PDN_ERR_MODEL;
///     PDN_ERR_NOT_PERIODIC; PDN_ERR_GRID_TOO_COARSE (of the initial solution); PDN_ERR_CALLBACK;
///     PDN_ERR_OVERFLOW; PDN_ERR_MEMORY
///
/// Threads: like a `const` use of `model` and of `options.initial`. Functions of signals and forces
/// and those of `options` are called on this thread, the latter in later calls, too.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_equations_new(
    model: *const pdn_model,
    period: f64,
    options: *const pdn_equations_options,
    out: *mut *mut pdn_equations,
) -> pdn_status {
    guard(|call| {
        if options.is_null() {
            return Err(null("options"));
        }
        let given = call.options(options, "options")?;
        let ranks = read_ranks(call, &given)?;
        // What else is wrong on one rank is an error on all.
        let found = (|| {
            let model = call.shared(model, "model")?;
            let period = call.number(period, "period")?;
            let out = call.out(out, "out")?;
            let grid = TimeGrid::new(given.grid_points, period).map_err(|e| match e.kind() {
                ErrorKind::Size => {
                    Error::size("options.grid_points", "an odd number", given.grid_points)
                }
                _ => e,
            })?;
            require_states(model.node_count(), grid.points())?;
            let start = match given.initial.is_null() {
                true => None,
                false => {
                    let initial = call.shared(given.initial, "options.initial")?;
                    Some(initial.prolonged_to(&model, grid)?)
                }
            };
            let options = RankOptions {
                ranks: ranks.clone(),
                owners: read_owners(call, &given)?,
                preconditioner: read_preconditioner(given.preconditioner)?,
                threads: read_threads(given.threads)?,
                start,
            };
            Ok((model, out, grid, options))
        })();
        let (model, out, grid, options) = ranks.agreed(found)?;
        let equations = RankEquations::new(&model, grid.period(), grid.points(), options)?;
        out.give(Mutex::new(equations));
        Ok(())
    })
}

fn read_ranks(call: &Call, given: &pdn_equations_options) -> Result<Arc<dyn Ranks>> {
    let count = usize::try_from(given.ranks).ok().filter(|count| *count > 0);
    let Some(count) = count else {
        return Err(Error::value("options.ranks", "at least 1", given.ranks));
    };
    let rank = usize::try_from(given.rank)
        .ok()
        .filter(|rank| *rank < count);
    let Some(rank) = rank else {
        let expected = format!("from 0 to {}", count - 1);
        return Err(Error::value("options.rank", expected, given.rank));
    };
    if count == 1 {
        return Ok(Arc::new(Alone));
    }
    let exchange = call.function(given.exchange, "options.exchange")?;
    let gather = call.function(given.gather, "options.gather")?;
    let ranks = CallerRanks::new((rank, count), (exchange, gather), given.ranks_data);
    Ok(Arc::new(ranks))
}

/// The preconditioner of this constant; none where one that suits is to be chosen.
fn read_preconditioner(value: i32) -> Result<Option<Preconditioner>> {
    match read_linear_solver(value) {
        Ok(LinearMethod::Automatic) => Ok(None),
        Ok(LinearMethod::Iterative(Some(which))) => Ok(Some(which)),
        _ => {
            let expected = "PDN_LINEAR_AUTOMATIC or a preconditioner";
            Err(Error::value("options.preconditioner", expected, value))
        }
    }
}

fn read_owners(call: &Call, given: &pdn_equations_options) -> Result<Option<Vec<usize>>> {
    if given.owners.is_null() {
        return Ok(None);
    }
    let owners = call.slice(given.owners, given.owner_count, "options.owners")?;
    let owner = |(node, &owner): (usize, &i32)| {
        let name = format!("options.owners[{node}]");
        usize::try_from(owner).map_err(|_| Error::value(&name, "a rank", owner))
    };
    let owners: Result<_> = owners.iter().enumerate().map(owner).collect();
    owners.map(Some)
}

/// The equations, for this call alone.
fn locked(core: &Mutex<RankEquations>) -> Result<MutexGuard<'_, RankEquations>> {
    core.try_lock().map_err(|error| match error {
        TryLockError::WouldBlock => Error::value(
            "equations",
            "a handle that no other call is using",
            "one in use, by a call around this callback or by another thread",
        ),
        TryLockError::Poisoned(_) => Error::new(
            ErrorKind::Poisoned,
            "equations: an internal error left it in an unknown state; free it",
        ),
    })
}

/// Frees equations; NULL does nothing. By this rank alone.
///
/// @param equations  the equations, not to be used any more
///
/// Threads: exclusive use of `equations`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_equations_free(equations: *mut pdn_equations) {
    free(equations);
}

/// Sizes of the equations, and of the vectors of this rank. By this rank alone.
///
/// @param equations  the equations; not NULL
/// @param out  the sizes, initialised by `PDN_INIT(pdn_equations_sizes, &sizes)`; written on
///     success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE, PDN_ERR_VALUE (a handle in use)
///
/// Threads: exclusive use of `equations`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_equations_get_sizes(
    equations: *const pdn_equations,
    out: *mut pdn_equations_sizes,
) -> pdn_status {
    guard(|call| {
        let core = call.shared(equations, "equations")?;
        let equations = locked(&core)?;
        let out = call.out_struct(out, "out")?;
        out.set(pdn_equations_sizes {
            size: equations.size(),
            halo: equations.halo_size(),
            total: equations.total(),
            nodes: equations.nodes().len(),
            motions: equations.motions().len(),
            own_unknowns: equations.own_unknowns().len(),
            bytes: equations.bytes(),
            preconditioner: preconditioner_code(equations.preconditioner()),
            ..pdn_equations_sizes::blank()
        });
        Ok(())
    })
}

/// Nodes of this rank, in the order of its vectors. By this rank alone.
///
/// @param equations  the equations; not NULL
/// @param out  array of length [count]
/// @param count  pdn_equations_sizes.nodes
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_SIZE, PDN_ERR_VALUE (a handle in use)
///
/// Threads: exclusive use of `equations`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_equations_nodes(
    equations: *const pdn_equations,
    out: *mut i32,
    count: usize,
) -> pdn_status {
    guard(|call| {
        let core = call.shared(equations, "equations")?;
        let nodes = locked(&core)?.nodes();
        let out = call.out_slice(out, count, nodes.len(), "out")?;
        let nodes = nodes.into_iter().map(|node| Kind::Node.id(node));
        out.set(&nodes.collect::<Vec<_>>());
        Ok(())
    })
}

/// Numbers of this rank's unknowns among those of all ranks: in the order that one rank alone has
/// them in, from 0. By this rank alone.
///
/// @param equations  the equations; not NULL
/// @param out  array of length [count]
/// @param count  pdn_equations_sizes.size
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_SIZE, PDN_ERR_VALUE (a handle in use)
///
/// Threads: exclusive use of `equations`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_equations_numbers(
    equations: *const pdn_equations,
    out: *mut usize,
    count: usize,
) -> pdn_status {
    guard(|call| {
        let core = call.shared(equations, "equations")?;
        let numbers = locked(&core)?.numbers();
        let out = call.out_slice(out, count, numbers.len(), "out")?;
        out.set(&numbers);
        Ok(())
    })
}

/// The present motions of this rank's nodes, and own unknowns of its elements. By this rank alone.
///
/// @param equations  the equations; not NULL
/// @param motions  array of length [motion_count]: node by node, at one grid point after the other,
///     position (3, inertial frame \[length\]), then rotation matrix (9, column by column)
/// @param motion_count  pdn_equations_sizes.motions
/// @param own_unknowns  array of length [own_count]: multipliers \[force or moment\] and internal
///     states \[length or angle\], in the order of vectors
/// @param own_count  pdn_equations_sizes.own_unknowns
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_SIZE, PDN_ERR_VALUE (a handle in use)
///
/// Threads: exclusive use of `equations`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_equations_state(
    equations: *const pdn_equations,
    motions: *mut f64,
    motion_count: usize,
    own_unknowns: *mut f64,
    own_count: usize,
) -> pdn_status {
    guard(|call| {
        let core = call.shared(equations, "equations")?;
        let equations = locked(&core)?;
        let (present, own) = (equations.motions(), equations.own_unknowns());
        let motions = call.out_slice(motions, motion_count, present.len(), "motions")?;
        let own_out = call.out_slice(own_unknowns, own_count, own.len(), "own_unknowns")?;
        motions.set(&present);
        own_out.set(&own);
        Ok(())
    })
}

/// Sets motions and own unknowns, as ::pdn_equations_state gives them. By all ranks.
///
/// Angles of joints are followed from what they were, by less than half a turn.
///
/// @param equations  the equations; not NULL
/// @param motions  array of length [motion_count]; what are to be rotation matrices are cleaned of
///     rounding
/// @param motion_count  pdn_equations_sizes.motions
/// @param own_unknowns  array of length [own_count]
/// @param own_count  pdn_equations_sizes.own_unknowns
/// @return PDN_OK; PDN_ERR_NULL and PDN_ERR_VALUE (a handle in use), on this rank alone;
///     PDN_ERR_NOT_FINITE, PDN_ERR_SIZE, PDN_ERR_VALUE (no rotation matrix), PDN_ERR_CALLBACK
///
/// Threads: exclusive use of `equations`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_equations_set_state(
    equations: *mut pdn_equations,
    motions: *const f64,
    motion_count: usize,
    own_unknowns: *const f64,
    own_count: usize,
) -> pdn_status {
    guard(|call| {
        let core = call.shared(equations, "equations")?;
        let mut equations = locked(&core)?;
        let motions = call.slice(motions, motion_count, "motions")?;
        let own = call.slice(own_unknowns, own_count, "own_unknowns")?;
        equations.set_state(motions, own)
    })
}

/// The scaled residual at the present state. By all ranks.
///
/// Forces are relative to the characteristic force, moments to it times the characteristic length,
/// lengths of constraints to that.
///
/// @param equations  the equations; not NULL
/// @param out  array of length [count]; written on success only
/// @param count  pdn_equations_sizes.size
/// @return PDN_OK; PDN_ERR_NULL and PDN_ERR_VALUE (a handle in use), on this rank alone;
///     PDN_ERR_SIZE, PDN_ERR_MODEL (an element too distorted), PDN_ERR_CALLBACK
///
/// Threads: exclusive use of `equations`; functions of forces are called on this thread.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_equations_residual(
    equations: *mut pdn_equations,
    out: *mut f64,
    count: usize,
) -> pdn_status {
    guard(|call| {
        let core = call.shared(equations, "equations")?;
        let mut equations = locked(&core)?;
        let out = call.out_slice(out, count, count, "out")?;
        let mut values = vec![0.0; count];
        equations.residual(&mut values)?;
        out.set(&values);
        Ok(())
    })
}

/// Linearises the equations at the present state, which ::pdn_equations_update then begins at. By
/// all ranks.
///
/// @param equations  the equations; not NULL
/// @return PDN_OK; PDN_ERR_NULL and PDN_ERR_VALUE (a handle in use), on this rank alone;
///     PDN_ERR_MODEL (an element too distorted), PDN_ERR_CALLBACK
///
/// Threads: exclusive use of `equations`; functions of forces are called on this thread.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_equations_linearise(equations: *mut pdn_equations) -> pdn_status {
    guard(|call| {
        let core = call.shared(equations, "equations")?;
        locked(&core)?.linearise()
    })
}

/// What is done with a vector and gives another one of the same length.
fn map(
    equations: *mut pdn_equations,
    (x, out, count): (*const f64, *mut f64, usize),
    map: impl FnOnce(&mut RankEquations, &[f64], &mut [f64]) -> Result<()>,
) -> pdn_status {
    guard(|call| {
        let core = call.shared(equations, "equations")?;
        let mut equations = locked(&core)?;
        let x = call.slice(x, count, "x")?;
        let out = call.out_slice(out, count, count, "out")?;
        let mut values = vec![0.0; count];
        map(&mut equations, x, &mut values)?;
        out.set(&values);
        Ok(())
    })
}

/// The product of the scaled Jacobian of the last linearisation and a vector. By all ranks.
///
/// Where constraints depend on each other they have a small compliance in it, see
/// ::pdn_equations_compliance.
///
/// @param equations  the equations; not NULL
/// @param x  array of length [count]; NaN passes through
/// @param out  array of length [count], may be `x`; written on success only
/// @param count  pdn_equations_sizes.size
/// @return PDN_OK; PDN_ERR_CALLBACK; on this rank alone PDN_ERR_NULL, PDN_ERR_VALUE (a handle in
///     use), PDN_ERR_SIZE, and PDN_ERR_NOT_AVAILABLE where the last linearisation failed
///
/// Threads: exclusive use of `equations`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_equations_product(
    equations: *mut pdn_equations,
    x: *const f64,
    out: *mut f64,
    count: usize,
) -> pdn_status {
    map(equations, (x, out, count), RankEquations::product)
}

/// The product of the transposed scaled Jacobian and a vector. By all ranks.
///
/// @param equations  the equations; not NULL
/// @param x  array of length [count]; NaN passes through
/// @param out  array of length [count], may be `x`; written on success only
/// @param count  pdn_equations_sizes.size
/// @return PDN_OK; PDN_ERR_CALLBACK; on this rank alone PDN_ERR_NULL, PDN_ERR_VALUE (a handle in
///     use), PDN_ERR_SIZE, and PDN_ERR_NOT_AVAILABLE where the last linearisation failed
///
/// Threads: exclusive use of `equations`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_equations_transposed_product(
    equations: *mut pdn_equations,
    x: *const f64,
    out: *mut f64,
    count: usize,
) -> pdn_status {
    map(
        equations,
        (x, out, count),
        RankEquations::transposed_product,
    )
}

/// The product of a vector and what multiplies a power of mu in the scaled Jacobian for
/// disturbances exp(mu t) times increments of the period: J(mu) = J + mu J1 + mu^2 J2. Where that
/// is singular exp(mu T) is a Floquet multiplier. By all ranks.
///
/// @param equations  the equations; not NULL
/// @param power  1 or 2
/// @param x  array of length [count]; NaN passes through
/// @param out  array of length [count], may be `x`; written on success only
/// @param count  pdn_equations_sizes.size
/// @return PDN_OK; PDN_ERR_CALLBACK; on this rank alone PDN_ERR_NULL, PDN_ERR_VALUE (another
///     power, a handle in use), PDN_ERR_SIZE, and PDN_ERR_NOT_AVAILABLE where the last
///     linearisation failed
///
/// Threads: exclusive use of `equations`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_equations_power_product(
    equations: *mut pdn_equations,
    power: i32,
    x: *const f64,
    out: *mut f64,
    count: usize,
) -> pdn_status {
    map(equations, (x, out, count), |equations, x, out| {
        equations.power_product(usize::try_from(power).unwrap_or(0), x, out)
    })
}

/// Factors the preconditioner of the linearised equations. By all ranks.
///
/// @param equations  the equations; not NULL
/// @param right_side  array of length [count]: a right side to come, by which unknown stress
///     resultants get a size that suits; the Jacobian and the preconditioner are for that size
/// @param count  pdn_equations_sizes.size
/// @param regular  1, or 0 if the preconditioner is singular or cannot be had of this model;
///     written on success only
/// @return PDN_OK; PDN_ERR_NOT_FINITE; PDN_ERR_SIZE; PDN_ERR_CALLBACK; PDN_ERR_MODEL;
///     PDN_ERR_MEMORY; on this rank alone PDN_ERR_NULL, PDN_ERR_VALUE (a handle in use), and
///     PDN_ERR_NOT_AVAILABLE where the last linearisation failed
///
/// Threads: exclusive use of `equations`; functions of forces are called on this thread.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_equations_factor(
    equations: *mut pdn_equations,
    right_side: *const f64,
    count: usize,
    regular: *mut i32,
) -> pdn_status {
    guard(|call| {
        let core = call.shared(equations, "equations")?;
        let mut equations = locked(&core)?;
        let right_side = call.slice(right_side, count, "right_side")?;
        let regular = call.out(regular, "regular")?;
        regular.set(i32::from(equations.factor(right_side)?));
        Ok(())
    })
}

/// The solution of the preconditioner's equations with a right side. By all ranks.
///
/// It is linear, and the same map until the preconditioner is factored anew.
///
/// @param equations  the equations; not NULL
/// @param x  array of length [count]: the right side; NaN passes through
/// @param out  array of length [count], may be `x`; written on success only
/// @param count  pdn_equations_sizes.size
/// @return PDN_OK; PDN_ERR_CALLBACK; on this rank alone PDN_ERR_NULL, PDN_ERR_VALUE (a handle in
///     use), PDN_ERR_SIZE, and PDN_ERR_NOT_AVAILABLE where nothing was factored
///
/// Threads: exclusive use of `equations`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_equations_precondition(
    equations: *mut pdn_equations,
    x: *const f64,
    out: *mut f64,
    count: usize,
) -> pdn_status {
    map(equations, (x, out, count), RankEquations::precondition)
}

/// What a scaled increment leaves of the constraints by their compliance in the Jacobian, where
/// some depend on others. By this rank alone.
///
/// Solve for it as a right side as well, and add the solution: motions are then those of the
/// constraints as they are.
///
/// @param equations  the equations; not NULL
/// @param increment  array of length [count]
/// @param out  array of length [count], zeros if constraints have no compliance; written on success
///     only
/// @param count  pdn_equations_sizes.size
/// @param compliant  1 if they have some, the same on all ranks, or 0; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_SIZE, PDN_ERR_VALUE (a handle in use)
///
/// Threads: exclusive use of `equations`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_equations_compliance(
    equations: *mut pdn_equations,
    increment: *const f64,
    out: *mut f64,
    count: usize,
    compliant: *mut i32,
) -> pdn_status {
    guard(|call| {
        let core = call.shared(equations, "equations")?;
        let mut equations = locked(&core)?;
        let increment = call.slice(increment, count, "increment")?;
        let out = call.out_slice(out, count, count, "out")?;
        let compliant = call.out(compliant, "compliant")?;
        let mut values = vec![0.0; count];
        let has = equations.compliance(increment, &mut values)?;
        out.set(&values);
        compliant.set(i32::from(has));
        Ok(())
    })
}

/// Moves the state that the equations were linearised at last by a fraction of a scaled increment;
/// the present state is then that. By all ranks.
///
/// Motions go on by their increments as rigid motions do, so that rotations remain such.
///
/// @param equations  the equations; not NULL
/// @param increment  array of length [count]
/// @param count  pdn_equations_sizes.size
/// @param step  the fraction, usually 1
/// @return PDN_OK; PDN_ERR_NULL and PDN_ERR_VALUE (a handle in use), on this rank alone;
///     PDN_ERR_NOT_FINITE, PDN_ERR_SIZE, PDN_ERR_NOT_AVAILABLE (not linearised), PDN_ERR_CALLBACK
///
/// Threads: exclusive use of `equations`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_equations_update(
    equations: *mut pdn_equations,
    increment: *const f64,
    count: usize,
    step: f64,
) -> pdn_status {
    guard(|call| {
        let core = call.shared(equations, "equations")?;
        let mut equations = locked(&core)?;
        let increment = call.slice(increment, count, "increment")?;
        equations.update(increment, step)
    })
}

/// Sizes of a scaled increment of all ranks, the same on all. By all ranks.
///
/// @param equations  the equations; not NULL
/// @param increment  array of length [count]; NaN gives NaN
/// @param count  pdn_equations_sizes.size
/// @param motion  largest increment of a motion: displacements relative to the characteristic
///     length, turns in radians; written on success only
/// @param own_unknown  largest increment of a multiplier or internal state, relative to the largest
///     of their values; written on success only
/// @return PDN_OK; PDN_ERR_NULL and PDN_ERR_VALUE (a handle in use), on this rank alone;
///     PDN_ERR_SIZE, PDN_ERR_CALLBACK
///
/// Threads: exclusive use of `equations`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_equations_norms(
    equations: *const pdn_equations,
    increment: *const f64,
    count: usize,
    motion: *mut f64,
    own_unknown: *mut f64,
) -> pdn_status {
    guard(|call| {
        let core = call.shared(equations, "equations")?;
        let equations = locked(&core)?;
        let increment = call.slice(increment, count, "increment")?;
        let motion = call.out(motion, "motion")?;
        let own_unknown = call.out(own_unknown, "own_unknown")?;
        let [largest, change] = equations.norms(increment)?;
        motion.set(largest);
        own_unknown.set(change);
        Ok(())
    })
}

/// The present state of all ranks as a solution, for results, files, and what else solutions are
/// for. By all ranks.
///
/// @param equations  the equations; not NULL
/// @param root  the rank that gets the solution, which takes its memory there; usually -1, for all
/// @param outcome  how your solve ended: PDN_CONVERGED, ...
/// @param out  the solution, NULL on ranks that get none; free it with ::pdn_solution_free; written
///     on success only
/// @return PDN_OK; PDN_ERR_NULL and PDN_ERR_VALUE (a handle in use), on this rank alone;
///     PDN_ERR_VALUE (root, outcome); PDN_ERR_CALLBACK; PDN_ERR_GRID_TOO_COARSE; PDN_ERR_OVERFLOW;
///     PDN_ERR_MEMORY
///
/// Threads: exclusive use of `equations`; functions of the model are called on this thread.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_equations_solution(
    equations: *const pdn_equations,
    root: i32,
    outcome: i32,
    out: *mut *mut pdn_solution,
) -> pdn_status {
    guard(|call| {
        let core = call.shared(equations, "equations")?;
        let equations = locked(&core)?;
        let out = call.out(out, "out")?;
        let root = match root {
            -1 => None,
            root => {
                let got = usize::try_from(root);
                Some(got.map_err(|_| Error::value("root", "a rank, or -1", root))?)
            }
        };
        let outcome = read_outcome(outcome)?;
        let found = equations.solution(root, (outcome, Vec::new()))?;
        let solution = found
            .map(|(model, solved)| Solution::of(&model, solved))
            .transpose();
        match equations.agreed(solution)? {
            Some(solution) => out.give(solution),
            None => out.set(null_mut()),
        }
        Ok(())
    })
}
