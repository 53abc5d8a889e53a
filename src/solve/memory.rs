//! What a solve takes of memory, estimated before it is taken.

use crate::elements::NodeState;
use crate::error::{Error, ErrorKind, Result};
use crate::memory;
use crate::motion::Motion;
use crate::solve::linear::cost::tangent_bytes;
use crate::system::System;
use nalgebra::Complex;

/// States over the grid that a solve keeps at a time: where it is, came from, and tries to go.
const STATES: usize = 6;
/// Vectors of unknowns that it keeps: increments, residuals, scales, right sides.
const VECTORS: usize = 12;

/// Matrices like an instant's tangent that modes take: as read, and as complex factors.
const MODE_MATRICES: f64 = 6.0;
/// Complex vectors that each mode takes: itself, twice, and as a shape.
const MODE_VECTORS: usize = 6;
/// Vectors of the space that any number of modes is found in, and more for each.
const SPACE: (usize, usize) = (60, 6);
/// Bytes for each entry of a matrix in that space: real and complex ones of its eigenvectors.
const IN_SPACE: usize = 100;
/// Numbers of a node that a step starts from: motion, velocity, acceleration, and its average.
const STEP_STARTS: usize = 24;
/// Matrices of their derivatives, among them complex ones of the multipliers.
const SHOOTING_MATRICES: usize = 12;

/// Bytes of the states and vectors of so many nodes and own unknowns of elements, at so many
/// points.
fn states_and_vectors(nodes: usize, own: usize, points: usize) -> usize {
    let number = size_of::<f64>();
    let node = STATES * size_of::<Motion>() + 2 * size_of::<NodeState>() + VECTORS * 6 * number;
    let at_point = nodes.saturating_mul(node) + own.saturating_mul((STATES + VECTORS) * number);
    points.saturating_mul(at_point)
}

/// The bytes that a solve may take; any number if zero.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct MemoryLimit(pub usize);

impl MemoryLimit {
    /// Bytes that may be taken, as far as it is up to the user.
    pub fn bytes(self) -> f64 {
        match self.0 {
            0 => f64::INFINITY,
            bytes => bytes as f64,
        }
    }

    /// Checks that so many bytes may be taken, and are to be had.
    ///
    /// # Errors
    /// [`ErrorKind::OutOfMemory`], with the estimate.
    pub fn require(self, what: &str, bytes: usize) -> Result<()> {
        if bytes as f64 > self.bytes() {
            let message = format!(
                "{what} takes about {bytes} bytes of memory, more than options.memory_limit allows \
                 ({})",
                self.0
            );
            return Err(Error::new(ErrorKind::OutOfMemory, message));
        }
        memory::require(what, bytes)
    }

    /// Checks that a system's states on a grid of so many points are to be had.
    ///
    /// # Errors
    /// The same.
    pub fn require_grid(self, system: &System, points: usize) -> Result<()> {
        let what = format!("a grid of {points} points");
        self.require(&what, of_grid(system, points))
    }
}

/// Bytes that a system takes on a grid, without linear equations.
pub(crate) fn of_grid(system: &System, points: usize) -> usize {
    states_and_vectors(system.nodes(), system.own_unknowns(), points)
}

/// Bytes that so many modes of a system take, beside its equations at an instant: of these three
/// matrices and complex factors, vectors of the search and the modes.
pub(crate) fn bytes_of_modes(system: &System, count: usize) -> usize {
    let size = 6 * system.nodes() + system.own_unknowns();
    let (count, complex) = (count.min(size), size_of::<Complex<f64>>());
    let space = (SPACE.0 + SPACE.1 * count).min(2 * size);
    let modes = MODE_VECTORS * complex * count.saturating_mul(size);
    let matrices = (MODE_MATRICES * tangent_bytes(system, 1)) as usize;
    let search = bytes_of_space(space, 2 * size);
    matrices.saturating_add(modes).saturating_add(search)
}

/// Bytes of a space of so many vectors that modes are found in, all of a length, and of the map in
/// it.
pub(crate) fn bytes_of_space(space: usize, length: usize) -> usize {
    let vectors = space
        .saturating_mul(length)
        .saturating_mul(2 * size_of::<f64>());
    let matrices = space.saturating_mul(space).saturating_mul(IN_SPACE);
    vectors.saturating_add(matrices)
}

/// Bytes that a shooting solve of so many steps takes: its orbits, and matrices of all that a step
/// starts from.
pub(crate) fn bytes_of_shooting(system: &System, steps: usize) -> usize {
    let states = 3 * system.own_unknowns();
    let size = system
        .nodes()
        .saturating_mul(STEP_STARTS)
        .saturating_add(states);
    let entries = size.saturating_mul(size).saturating_mul(SHOOTING_MATRICES);
    let matrices = entries.saturating_mul(size_of::<f64>());
    let step = states_and_vectors(system.nodes(), system.own_unknowns(), 1);
    matrices.saturating_add(steps.saturating_mul(step))
}

/// Checks that states of so many nodes on a grid are to be had.
///
/// # Errors
/// [`ErrorKind::OutOfMemory`].
pub(crate) fn require_states(nodes: usize, points: usize) -> Result<()> {
    let what = format!("a grid of {points} points");
    memory::require(&what, states_and_vectors(nodes, 0, points))
}
