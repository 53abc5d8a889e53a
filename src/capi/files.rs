//! Solutions in files.

use super::guard::guard;
use super::solution::pdn_solution;
use super::status::pdn_status;
use std::ffi::c_char;
use std::path::Path;

/// Writes an animation of a solution that ParaView opens: VTK's XML files, and a list of them.
///
/// `path` names the list; the files are put into a directory beside it that has its name without `.pvd`. For
/// each time there is one file for each of these parts that the model has:
///
/// - `beams`: a line of `points_per_element` points for each beam element (draw it with the filter Tube). Each
///   point has displacement, axes of the section (axis_1, axis_2, axis_3), and force, moment, strain,
///   curvature along these axes; each line its element;
/// - `bodies`: the nodes that carry a rigid body or belong to no beam, with node, displacement, axes,
///   velocity, angular_velocity;
/// - `joints`: the origins of the joint frames on the second bodies, with joint, displacement, axes,
///   reaction_force, reaction_moment.
///
/// Displacements are from the reference configuration. Vectors are along the inertial axes, but for the
/// internal forces and strains of beams.
///
/// @param solution  the solution; not NULL
/// @param times  array of length [count]: times of the animation, ascending, also outside the first period
/// @param count  number of times, at least 1
/// @param points_per_element  points along each beam element, 2 to 1000
/// @param path  where to, UTF-8, ending in `.pvd`. Files of these names are replaced; if writing fails,
///     they stay as they were
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_SIZE, PDN_ERR_VALUE (times that do not ascend,
///     a path that does not end in `.pvd`), PDN_ERR_GRID_TOO_COARSE, PDN_ERR_OVERFLOW, PDN_ERR_IO
///
/// Threads: like a `const` use of `solution`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_solution_write_vtk(
    solution: *const pdn_solution,
    times: *const f64,
    count: usize,
    points_per_element: usize,
    path: *const c_char,
) -> pdn_status {
    guard(|call| {
        let solution = call.shared(solution, "solution")?;
        let times = call.numbers(times, count, "times")?;
        let path = call.text(path, "path")?;
        solution.write_vtk(times, points_per_element, Path::new(path))
    })
}
