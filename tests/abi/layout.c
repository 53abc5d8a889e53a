/* Sizes, offsets and numbers that no release of this soname may change, on 64-bit platforms.
 *
 * A struct with struct_size may grow, at its end only: then its new size goes here and to its SIZES
 * in src/capi. All others stay as they are. */
#include <periodyn.h>
#include <stddef.h>

#define SIZE(type, size) _Static_assert(sizeof(type) == (size), #type)
#define AT(type, field, offset) _Static_assert(offsetof(type, field) == (offset), #type "." #field)
#define IS(name, value) _Static_assert(name == (value), #name)

SIZE(pdn_status, 4);
SIZE(pdn_signal_fn, sizeof(void *));
SIZE(pdn_progress_fn, sizeof(void *));
SIZE(pdn_curve_fn, sizeof(void *));

SIZE(pdn_section, 872);
AT(pdn_section, struct_size, 0);
AT(pdn_section, stiffness, 8);
AT(pdn_section, mass, 296);
AT(pdn_section, damping, 584);

SIZE(pdn_signal, 88);
AT(pdn_signal, struct_size, 0);
AT(pdn_signal, kind, 8);
AT(pdn_signal, reserved, 12);
AT(pdn_signal, mean, 16);
AT(pdn_signal, rate, 24);
AT(pdn_signal, cosines, 32);
AT(pdn_signal, sines, 40);
AT(pdn_signal, harmonics, 48);
AT(pdn_signal, samples, 56);
AT(pdn_signal, sample_count, 64);
AT(pdn_signal, function, 72);
AT(pdn_signal, user_data, 80);

SIZE(pdn_frame, 96);
AT(pdn_frame, position, 0);
AT(pdn_frame, rotation, 24);

SIZE(pdn_beam, 32);
AT(pdn_beam, first, 0);
AT(pdn_beam, last, 4);
AT(pdn_beam, first_element, 8);
AT(pdn_beam, elements, 12);
AT(pdn_beam, reserved, 16);

SIZE(pdn_line, 128);
AT(pdn_line, struct_size, 0);
AT(pdn_line, kind, 8);
AT(pdn_line, reserved, 12);
AT(pdn_line, start, 16);
AT(pdn_line, point, 40);
AT(pdn_line, end, 64);
AT(pdn_line, axis_2, 88);
AT(pdn_line, curve, 112);
AT(pdn_line, user_data, 120);

SIZE(pdn_stations, 40);
AT(pdn_stations, struct_size, 0);
AT(pdn_stations, count, 8);
AT(pdn_stations, fractions, 16);
AT(pdn_stations, sections, 24);
AT(pdn_stations, twists, 32);

SIZE(pdn_quantity, 40);
AT(pdn_quantity, struct_size, 0);
AT(pdn_quantity, kind, 8);
AT(pdn_quantity, object, 12);
AT(pdn_quantity, component, 16);
AT(pdn_quantity, frame, 20);
AT(pdn_quantity, node, 24);
AT(pdn_quantity, branch, 28);
AT(pdn_quantity, station, 32);

SIZE(pdn_diagnostics, 208);
AT(pdn_diagnostics, struct_size, 0);
AT(pdn_diagnostics, outcome, 8);
AT(pdn_diagnostics, iterations, 12);
AT(pdn_diagnostics, guess_iterations, 16);
AT(pdn_diagnostics, redundant_constraints, 20);
AT(pdn_diagnostics, grid_points, 24);
AT(pdn_diagnostics, unknowns, 32);
AT(pdn_diagnostics, last_increment, 40);
AT(pdn_diagnostics, error_estimate, 48);
AT(pdn_diagnostics, force_residual_between, 56);
AT(pdn_diagnostics, constraint_residual_between, 64);
AT(pdn_diagnostics, guess_seconds, 72);
AT(pdn_diagnostics, assembly_seconds, 80);
AT(pdn_diagnostics, analysis_seconds, 88);
AT(pdn_diagnostics, factorisation_seconds, 96);
AT(pdn_diagnostics, substitution_seconds, 104);
AT(pdn_diagnostics, decay, 112);
AT(pdn_diagnostics, grids, 116);
AT(pdn_diagnostics, decay_order, 120);
AT(pdn_diagnostics, least_resolved_time, 128);
AT(pdn_diagnostics, linear_solver, 136);
AT(pdn_diagnostics, linear_iterations, 140);
AT(pdn_diagnostics, linear_solves, 144);
AT(pdn_diagnostics, most_linear_iterations, 148);
AT(pdn_diagnostics, linear_bytes, 152);
AT(pdn_diagnostics, preconditioner_seconds, 160);
AT(pdn_diagnostics, interface_seconds, 168);
AT(pdn_diagnostics, estimate_seconds, 176);
AT(pdn_diagnostics, total_seconds, 184);
AT(pdn_diagnostics, total_iterations, 192);
AT(pdn_diagnostics, attempts, 196);
AT(pdn_diagnostics, mesh_error, 200);

SIZE(pdn_progress, 80);
AT(pdn_progress, struct_size, 0);
AT(pdn_progress, stage, 8);
AT(pdn_progress, iteration, 12);
AT(pdn_progress, residual, 16);
AT(pdn_progress, increment, 24);
AT(pdn_progress, step, 32);
AT(pdn_progress, time, 40);
AT(pdn_progress, elapsed, 48);
AT(pdn_progress, grid_points, 56);
AT(pdn_progress, attempt, 64);
AT(pdn_progress, start, 68);
AT(pdn_progress, iterated, 72);
AT(pdn_progress, reserved, 76);

SIZE(pdn_periodic_options, 136);
AT(pdn_periodic_options, struct_size, 0);
AT(pdn_periodic_options, grid_points, 8);
AT(pdn_periodic_options, harmonics, 16);
AT(pdn_periodic_options, tolerance, 24);
AT(pdn_periodic_options, iteration_limit, 32);
AT(pdn_periodic_options, initial, 40);
AT(pdn_periodic_options, guess_positions, 48);
AT(pdn_periodic_options, guess_rotations, 56);
AT(pdn_periodic_options, progress, 64);
AT(pdn_periodic_options, progress_data, 72);
AT(pdn_periodic_options, error_tolerance, 80);
AT(pdn_periodic_options, largest_grid_points, 88);
AT(pdn_periodic_options, linear_solver, 96);
AT(pdn_periodic_options, threads, 100);
AT(pdn_periodic_options, oversampling, 104);
AT(pdn_periodic_options, response_tolerance, 112);
AT(pdn_periodic_options, start, 120);
AT(pdn_periodic_options, estimate_mesh, 124);
AT(pdn_periodic_options, progress_interval, 128);

IS(PDN_OK, 0);
IS(PDN_ERR_NULL, -1);
IS(PDN_ERR_NOT_FINITE, -2);
IS(PDN_ERR_SIZE, -3);
IS(PDN_ERR_ID, -4);
IS(PDN_ERR_VALUE, -5);
IS(PDN_ERR_STRUCT_SIZE, -6);
IS(PDN_ERR_NOT_AVAILABLE, -7);
IS(PDN_ERR_MODEL, -100);
IS(PDN_ERR_NOT_PERIODIC, -101);
IS(PDN_ERR_GRID_TOO_COARSE, -200);
IS(PDN_ERR_CALLBACK, -201);
IS(PDN_ERR_OVERFLOW, -202);
IS(PDN_ERR_IO, -300);
IS(PDN_ERR_FORMAT, -301);
IS(PDN_ERR_MEMORY, -900);
IS(PDN_ERR_PANIC, -901);
IS(PDN_ERR_POISONED, -902);

IS(PDN_LINE_STRAIGHT, 0);
IS(PDN_LINE_ARC, 1);
IS(PDN_LINE_CURVE, 2);
IS(PDN_SIGNAL_HARMONICS, 0);
IS(PDN_SIGNAL_SAMPLES, 1);
IS(PDN_SIGNAL_FUNCTION, 2);

IS(PDN_GROUND, -1);

IS(PDN_JOINT_RIGID, 0);
IS(PDN_JOINT_REVOLUTE, 1);
IS(PDN_JOINT_UNIVERSAL, 2);
IS(PDN_JOINT_SPHERICAL, 3);
IS(PDN_JOINT_PRISMATIC, 4);
IS(PDN_JOINT_CYLINDRICAL, 5);
IS(PDN_JOINT_PLANAR, 6);
IS(PDN_JOINT_FREE, 7);

IS(PDN_DISPLACEMENT, 0);
IS(PDN_DISPLACEMENT_2, 1);
IS(PDN_DISPLACEMENT_3, 2);
IS(PDN_ROTATION, 3);
IS(PDN_ROTATION_2, 4);
IS(PDN_ROTATION_3, 5);

IS(PDN_FRAME_SPACE, 0);
IS(PDN_FRAME_MATERIAL, 1);
IS(PDN_FRAME_UNTWISTED, 2);

IS(PDN_FORCE_1, 0);
IS(PDN_FORCE_2, 1);
IS(PDN_FORCE_3, 2);
IS(PDN_MOMENT_1, 3);
IS(PDN_MOMENT_2, 4);
IS(PDN_MOMENT_3, 5);

IS(PDN_CONVERGED, 0);
IS(PDN_ITERATION_LIMIT, 1);
IS(PDN_STALLED, 2);
IS(PDN_SINGULAR, 3);
IS(PDN_CANCELLED, 4);
IS(PDN_NO_INITIAL_GUESS, 5);
IS(PDN_INCONSISTENT, 6);
IS(PDN_WRONG_ASSEMBLY, 7);
IS(PDN_TOLERANCE_NOT_MET, 8);
IS(PDN_DECAY_UNKNOWN, 0);
IS(PDN_DECAY_FAST, 1);
IS(PDN_DECAY_SLOW, 2);
IS(PDN_DECAY_ROUNDING, 3);
IS(PDN_FILTER_LANCZOS, 0);
IS(PDN_FILTER_EXPONENTIAL, 1);
IS(PDN_LINEAR_AUTOMATIC, 0);
IS(PDN_LINEAR_DIRECT, 1);
IS(PDN_LINEAR_ITERATIVE, 2);
IS(PDN_LINEAR_BODY_CIRCULANT, 3);
IS(PDN_LINEAR_TIME_LOCAL, 4);
IS(PDN_LINEAR_CIRCULANT, 5);

IS(PDN_AXES_SPACE, 0);
IS(PDN_AXES_FIRST, 1);
IS(PDN_AXES_SECOND, 2);

IS(PDN_NODE_POSITION, 0);
IS(PDN_NODE_ROTATION, 1);
IS(PDN_NODE_QUATERNION, 2);
IS(PDN_NODE_VELOCITY, 3);
IS(PDN_NODE_ACCELERATION, 4);
IS(PDN_NODE_MATERIAL_VELOCITY, 5);
IS(PDN_NODE_MATERIAL_ACCELERATION, 6);

IS(PDN_JOINT_COORDINATE, 0);
IS(PDN_JOINT_RATE, 1);
IS(PDN_JOINT_ACCELERATION, 2);
IS(PDN_JOINT_DRIVING_EFFORT, 3);
IS(PDN_JOINT_REACTION, 4);

IS(PDN_BEAM_STRAIN, 0);
IS(PDN_BEAM_FORCE, 1);
IS(PDN_BEAM_FORCE_MEAN, 2);
IS(PDN_BEAM_FORCE_JUMP, 3);

IS(PDN_STAGE_INITIAL_GUESS, 0);
IS(PDN_STAGE_NEWTON, 1);

SIZE(pdn_static_options, 120);
AT(pdn_static_options, struct_size, 0);
AT(pdn_static_options, time, 8);
AT(pdn_static_options, period, 16);
AT(pdn_static_options, load_steps, 24);
AT(pdn_static_options, tolerance, 32);
AT(pdn_static_options, iteration_limit, 40);
AT(pdn_static_options, angular_velocity, 48);
AT(pdn_static_options, axis_point, 72);
AT(pdn_static_options, initial, 96);
AT(pdn_static_options, progress, 104);
AT(pdn_static_options, progress_data, 112);
SIZE(pdn_modes_options, 32);
AT(pdn_modes_options, struct_size, 0);
AT(pdn_modes_options, equilibrium, 8);
AT(pdn_modes_options, count, 16);
AT(pdn_modes_options, near_frequency, 24);
SIZE(pdn_mode, 56);
AT(pdn_mode, struct_size, 0);
AT(pdn_mode, eigenvalue_real, 8);
AT(pdn_mode, eigenvalue_imaginary, 16);
AT(pdn_mode, frequency, 24);
AT(pdn_mode, damping_ratio, 32);
AT(pdn_mode, modal_mass, 40);
AT(pdn_mode, residual, 48);

IS(PDN_STAGE_MARCH, 2);
IS(PDN_STAGE_STABILITY, 4);
IS(PDN_STABILITY_NOT_KNOWN, 0);
IS(PDN_STABLE, 1);
IS(PDN_UNSTABLE, 2);
IS(PDN_STAGE_MODES, 3);
IS(PDN_START_AUTOMATIC, 0);
IS(PDN_START_QUASI_STATIC, 1);
IS(PDN_START_STEADY_ROTATION, 2);
IS(PDN_START_RIGID_ROTATION, 3);
IS(PDN_START_RAISED_INERTIA, 4);
IS(PDN_START_MARCH, 5);

SIZE(pdn_march_options, 152);
AT(pdn_march_options, struct_size, 0);
AT(pdn_march_options, start_time, 8);
AT(pdn_march_options, duration, 16);
AT(pdn_march_options, period, 24);
AT(pdn_march_options, step, 32);
AT(pdn_march_options, steps_per_period, 40);
AT(pdn_march_options, spectral_radius, 48);
AT(pdn_march_options, error_tolerance, 56);
AT(pdn_march_options, periodic_tolerance, 64);
AT(pdn_march_options, most_periods, 72);
AT(pdn_march_options, stored_periods, 80);
AT(pdn_march_options, tolerance, 88);
AT(pdn_march_options, iteration_limit, 96);
AT(pdn_march_options, initial, 104);
AT(pdn_march_options, positions, 112);
AT(pdn_march_options, rotations, 120);
AT(pdn_march_options, velocities, 128);
AT(pdn_march_options, progress, 136);
AT(pdn_march_options, progress_data, 144);

SIZE(pdn_shooting_options, 72);
AT(pdn_shooting_options, struct_size, 0);
AT(pdn_shooting_options, steps_per_period, 8);
AT(pdn_shooting_options, guess_periods, 16);
AT(pdn_shooting_options, spectral_radius, 24);
AT(pdn_shooting_options, tolerance, 32);
AT(pdn_shooting_options, iteration_limit, 40);
AT(pdn_shooting_options, initial, 48);
AT(pdn_shooting_options, progress, 56);
AT(pdn_shooting_options, progress_data, 64);

SIZE(pdn_stability_options, 40);
AT(pdn_stability_options, struct_size, 0);
AT(pdn_stability_options, highest_frequency, 8);
AT(pdn_stability_options, tolerance, 16);
AT(pdn_stability_options, progress, 24);
AT(pdn_stability_options, progress_data, 32);

SIZE(pdn_multiplier, 64);
AT(pdn_multiplier, struct_size, 0);
AT(pdn_multiplier, real, 8);
AT(pdn_multiplier, imaginary, 16);
AT(pdn_multiplier, exponent_real, 24);
AT(pdn_multiplier, exponent_imaginary, 32);
AT(pdn_multiplier, frequency, 40);
AT(pdn_multiplier, error, 48);
AT(pdn_multiplier, trivial, 56);
AT(pdn_multiplier, reserved, 60);

SIZE(pdn_march_diagnostics, 88);
AT(pdn_march_diagnostics, struct_size, 0);
AT(pdn_march_diagnostics, steps, 8);
AT(pdn_march_diagnostics, rejected_steps, 16);
AT(pdn_march_diagnostics, iterations, 24);
AT(pdn_march_diagnostics, periods, 32);
AT(pdn_march_diagnostics, first_time, 40);
AT(pdn_march_diagnostics, last_time, 48);
AT(pdn_march_diagnostics, repetition, 56);
AT(pdn_march_diagnostics, step_error, 64);
AT(pdn_march_diagnostics, start_moved, 72);
AT(pdn_march_diagnostics, start_corrected, 80);
SIZE(pdn_summary, 88);
AT(pdn_summary, struct_size, 0);
AT(pdn_summary, nodes, 8);
AT(pdn_summary, beam_elements, 12);
AT(pdn_summary, joints, 16);
AT(pdn_summary, prescribed, 20);
AT(pdn_summary, constraints, 24);
AT(pdn_summary, redundant_constraints, 28);
AT(pdn_summary, degrees_of_freedom, 32);
AT(pdn_summary, members, 36);
AT(pdn_summary, mobility, 40);
AT(pdn_summary, redundant_if_rigid, 44);
AT(pdn_summary, parts, 48);
AT(pdn_summary, warnings, 52);
AT(pdn_summary, mass, 56);
AT(pdn_summary, centre, 64);

IS(PDN_QUANTITY_POSITION, 100);
IS(PDN_QUANTITY_ROTATION, 101);
IS(PDN_QUANTITY_QUATERNION, 102);
IS(PDN_QUANTITY_VELOCITY, 103);
IS(PDN_QUANTITY_ACCELERATION, 104);
IS(PDN_QUANTITY_COORDINATE, 200);
IS(PDN_QUANTITY_COORDINATE_RATE, 201);
IS(PDN_QUANTITY_COORDINATE_ACCELERATION, 202);
IS(PDN_QUANTITY_DRIVING_EFFORT, 203);
IS(PDN_QUANTITY_REACTION, 204);
IS(PDN_QUANTITY_STRAIN, 300);
IS(PDN_QUANTITY_BEAM_FORCE, 301);
IS(PDN_QUANTITY_BEAM_FORCE_MEAN, 302);
IS(PDN_QUANTITY_BEAM_FORCE_JUMP, 303);
IS(PDN_QUANTITY_EFFORT, 400);
IS(PDN_QUANTITY_BRANCH_EFFORT, 401);
IS(PDN_QUANTITY_BRANCH_ELONGATION, 402);
IS(PDN_QUANTITY_FORCE_ON_NODE, 403);
IS(PDN_ALL_COMPONENTS, -1);
