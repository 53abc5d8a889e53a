//! Solutions and models in files.

use super::guard::guard;
use super::model::pdn_model;
use super::solution::pdn_solution;
use super::status::pdn_status;
use crate::model::Model;
use crate::output::Solution;
use libc::c_char;
use std::path::Path;

/// Writes an animation of a solution that ParaView opens: VTK's XML files, and a list of them.
///
/// `path` names the list; the files are put into a directory beside it that has its name without
/// `.pvd`. For each time there is one file for each of these parts that the model has:
///
/// - `beams`: a line of `points_per_element` points for each beam element (draw it with the filter
///   Tube). Each point has displacement, axes of the section (axis_1, axis_2, axis_3), and force,
///   moment, strain, curvature along these axes; each line its element;
/// - `shells`: a curved quadrilateral of its own order for each shell element, with displacement,
///   axes (those of the section and the normal), strains and resultants along these, and of
///   isotropic shells stress_top and stress_bottom with von Mises' stresses; each its element;
/// - `bodies`: the nodes that carry a rigid body or belong to no beam and no shell, with node,
///   displacement, axes, velocity, angular_velocity;
/// - `joints`: the origins of the joint frames on the second bodies, with joint, displacement,
///   axes, reaction_force, reaction_moment.
///
/// Displacements are from the reference configuration. Vectors are along the inertial axes, but for
/// the internal forces and strains of beams.
///
/// @param solution  the solution; not NULL
/// @param times  array of length [count]: times of the animation, ascending, also outside the first
///     period
/// @param count  number of times, at least 1
/// @param points_per_element  points along each beam element, 2 to 1000
/// @param path  where to, UTF-8, ending in `.pvd`. Files of these names are replaced; if writing
///     fails, they stay as they were
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_SIZE, PDN_ERR_VALUE (times that do not
///     ascend, a path that does not end in `.pvd`, or whose name has control characters),
///     PDN_ERR_GRID_TOO_COARSE, PDN_ERR_OVERFLOW, PDN_ERR_IO
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

/// Saves a solution with its model, whether it has converged or not.
///
/// ::pdn_solution_load gives it back, to the last bit. Callbacks cannot be saved: see there. The
/// format is the same on all platforms, and later versions of the library read it.
///
/// @param solution  the solution; not NULL
/// @param path  where to, UTF-8. A file that is there is replaced when all is written; if that
///     fails it stays as it was
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_VALUE (text that is not UTF-8), PDN_ERR_IO
///
/// Threads: like a `const` use of `solution`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_solution_save(
    solution: *const pdn_solution,
    path: *const c_char,
) -> pdn_status {
    guard(|call| {
        let solution = call.shared(solution, "solution")?;
        let path = call.text(path, "path")?;
        solution.save(Path::new(path))
    })
}

/// Loads a solution that ::pdn_solution_save saved: its quantities, diagnostics and report are what
/// they were.
///
/// A solve may start from it (the option `initial`), of your model or of the one that
/// ::pdn_solution_model gives. If the solved model had callbacks, in signals or forces, the
/// quantities of the solution are there all the same; but a solve of the model that was loaded with
/// it fails with PDN_ERR_CALLBACK, as its callbacks are not.
///
/// @param path  the file, UTF-8. It need not be trusted: its checksum and everything in it are
///     checked
/// @param out  the solution; free it with ::pdn_solution_free; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_VALUE (text that is not UTF-8), PDN_ERR_IO, PDN_ERR_FORMAT
///     (not a saved solution, cut off, damaged, or of a newer version), PDN_ERR_MEMORY
///
/// Threads: any.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_solution_load(
    path: *const c_char,
    out: *mut *mut pdn_solution,
) -> pdn_status {
    guard(|call| {
        let path = call.text(path, "path")?;
        let out = call.out(out, "out")?;
        out.give(Solution::load(Path::new(path))?);
        Ok(())
    })
}

/// A copy of the model that a solution is of, as it was when it was solved.
///
/// @param solution  the solution; not NULL
/// @param out  the model; free it with ::pdn_model_free; written on success only
/// @return PDN_OK, PDN_ERR_NULL
///
/// Threads: like a `const` use of `solution`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_solution_model(
    solution: *const pdn_solution,
    out: *mut *mut pdn_model,
) -> pdn_status {
    guard(|call| {
        let solution = call.shared(solution, "solution")?;
        let out = call.out(out, "out")?;
        out.give(solution.model().clone());
        Ok(())
    })
}

/// A copy of a model, which may be changed and solved apart from it.
///
/// @param model  the model; not NULL
/// @param out  the copy; free it with ::pdn_model_free; written on success only. It shares the
///     callbacks of the model and their user_data
/// @return PDN_OK, PDN_ERR_NULL
///
/// Threads: `model` is `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_copy(
    model: *const pdn_model,
    out: *mut *mut pdn_model,
) -> pdn_status {
    guard(|call| {
        let model = call.shared(model, "model")?;
        let out = call.out(out, "out")?;
        out.give(Model::clone(&model));
        Ok(())
    })
}

/// Saves a model.
///
/// ::pdn_model_load gives it back. Callbacks cannot be saved: see there. The format is the same on
/// all platforms, and later versions of the library read it.
///
/// @param model  the model; not NULL
/// @param path  where to, UTF-8. A file that is there is replaced when all is written; if that
///     fails it stays as it was
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_VALUE (text that is not UTF-8), PDN_ERR_IO
///
/// Threads: `model` is `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_save(
    model: *const pdn_model,
    path: *const c_char,
) -> pdn_status {
    guard(|call| {
        let model = call.shared(model, "model")?;
        let path = call.text(path, "path")?;
        model.save(Path::new(path))
    })
}

/// Loads a model that ::pdn_model_save saved; its ids are what they were.
///
/// If it had callbacks, in signals or forces, a solve of it fails with PDN_ERR_CALLBACK, as they
/// are not there.
///
/// @param path  the file, UTF-8. It need not be trusted: its checksum and everything in it are
///     checked
/// @param out  the model; free it with ::pdn_model_free; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_VALUE (text that is not UTF-8), PDN_ERR_IO, PDN_ERR_FORMAT
///     (not a saved model, cut off, damaged, or of a newer version), PDN_ERR_MEMORY
///
/// Threads: any.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_load(
    path: *const c_char,
    out: *mut *mut pdn_model,
) -> pdn_status {
    guard(|call| {
        let path = call.text(path, "path")?;
        let out = call.out(out, "out")?;
        out.give(Model::load(Path::new(path))?);
        Ok(())
    })
}
