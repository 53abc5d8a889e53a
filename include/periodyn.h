/**
 * @file periodyn.h
 * Periodyn: periodic response of flexible multibody systems by Fourier spectral collocation.
 *
 * @par Errors
 * Functions that can fail return a ::pdn_status: PDN_OK, or a negative code. Then ::pdn_last_error
 * tells which argument was wrong, what was expected and what came; outputs are left untouched.
 * Whether a solve converged is no error but a part of its result.
 *
 * @par Threads
 * 1. Distinct handles may be used from distinct threads at once.
 * 2. On one handle, functions that take it as `const` may run at once; any other needs it alone.
 *    Handles may move between threads.
 * 3. The last error belongs to the thread.
 *
 * @par Memory
 * What a `_new` or an output of handle type gave is the caller's, to be freed by the `_free` of its
 * type, in any order; NULL may be freed. Arrays and texts are copied in and out.
 * Any function may return PDN_ERR_MEMORY, also where it is not named: then nothing has changed.
 */

/* Written by cbindgen from src/capi. To change it: PDN_BLESS=1 cargo test --test header */


#ifndef PERIODYN_H
#define PERIODYN_H

#include <stddef.h>
#include <stdint.h>

/** Marks the functions of the library: on Windows they come from a DLL, unless PDN_STATIC is set. */
#if defined(_WIN32) && !defined(PDN_STATIC)
#define PDN_API __declspec(dllimport)
#else
#define PDN_API
#endif

/** Sets the defaults of an option struct: `PDN_INIT(pdn_example_options, &options)`. */
#define PDN_INIT(type, pointer) type##_init((pointer), sizeof *(pointer))


/**
 * Version of this header, first number.
 */
#define PDN_VERSION_MAJOR 0

/**
 * Version of this header, second number.
 */
#define PDN_VERSION_MINOR 1

/**
 * Version of this header, third number.
 */
#define PDN_VERSION_PATCH 0

/**
 * The call did what it says.
 */
#define PDN_OK 0

/**
 * A pointer that must not be NULL is NULL.
 */
#define PDN_ERR_NULL -1

/**
 * A number is NaN or infinite.
 */
#define PDN_ERR_NOT_FINITE -2

/**
 * A length or count is not allowed.
 */
#define PDN_ERR_SIZE -3

/**
 * An id names nothing in this model.
 */
#define PDN_ERR_ID -4

/**
 * A value is not allowed.
 */
#define PDN_ERR_VALUE -5

/**
 * A struct was not initialised, or was made for another library.
 */
#define PDN_ERR_STRUCT_SIZE -6

/**
 * The quantity does not exist for this object.
 */
#define PDN_ERR_NOT_AVAILABLE -7

/**
 * The model cannot be solved as it stands.
 */
#define PDN_ERR_MODEL -100

/**
 * A prescribed motion or load does not repeat after one period.
 */
#define PDN_ERR_NOT_PERIODIC -101

/**
 * The grid is too coarse to interpolate this motion.
 */
#define PDN_ERR_GRID_TOO_COARSE -200

/**
 * A callback failed or returned a number that is not finite.
 */
#define PDN_ERR_CALLBACK -201

/**
 * A result is too large to be a number.
 */
#define PDN_ERR_OVERFLOW -202

/**
 * A file could not be read or written.
 */
#define PDN_ERR_IO -300

/**
 * A file is damaged, or not of the format or version expected.
 */
#define PDN_ERR_FORMAT -301

/**
 * Out of memory.
 */
#define PDN_ERR_MEMORY -900

/**
 * Internal error, a defect of the library.
 */
#define PDN_ERR_PANIC -901

/**
 * An internal error left this handle in an unknown state.
 */
#define PDN_ERR_POISONED -902

/**
 * Kind of a signal: mean, rate and harmonics. Also what a constant is.
 */
#define PDN_SIGNAL_HARMONICS 1200

/**
 * Kind of a signal: rate and samples over one period.
 */
#define PDN_SIGNAL_SAMPLES 1201

/**
 * Kind of a signal: a function of the caller.
 */
#define PDN_SIGNAL_FUNCTION 1202

/**
 * Kind of a signal: a function of the caller, of the phase.
 */
#define PDN_SIGNAL_FUNCTION_OF_PHASE 1203

/**
 * Id of the node that was added first, or of the rigid body, which is one.
 *
 * Those of the others of a kind follow, in the order in which they were added: the node that
 * messages and reports call node 3 is PDN_FIRST_NODE + 3. A kind has 100 million at most.
 */
#define PDN_FIRST_NODE 100000000

/**
 * Id of the joint that was added first.
 */
#define PDN_FIRST_JOINT 200000000

/**
 * Id of the beam element that was added first.
 */
#define PDN_FIRST_BEAM_ELEMENT 300000000

/**
 * Id of the shell element that was added first.
 */
#define PDN_FIRST_SHELL_ELEMENT 400000000

/**
 * Id of the force that was added first, which is no load.
 */
#define PDN_FIRST_FORCE 500000000

/**
 * Id of the linear relation between joint coordinates that was added first.
 */
#define PDN_FIRST_RELATION 600000000

/**
 * Id of the parameter that was added first.
 */
#define PDN_FIRST_PARAMETER 700000000

/**
 * Id of the load on a node, or at a point, that was added first.
 */
#define PDN_FIRST_LOAD 800000000

/**
 * Id of the load along beam elements that was added first.
 */
#define PDN_FIRST_BEAM_LOAD 900000000

/**
 * Id of the load on shell elements that was added first.
 */
#define PDN_FIRST_SHELL_LOAD 1000000000

/**
 * Id of the inertia that was added first: that of a rigid body, or a mass or inertia on a node.
 */
#define PDN_FIRST_INERTIA 1100000000

/**
 * Id of the coordinate that was prescribed first.
 */
#define PDN_FIRST_PRESCRIBED 1200000000

/**
 * In place of a node's id: the ground, which does not move.
 */
#define PDN_GROUND -1

/**
 * Joint that allows no relative motion.
 */
#define PDN_JOINT_RIGID 1300

/**
 * Joint that allows a rotation about axis 3 of its frames.
 */
#define PDN_JOINT_REVOLUTE 1301

/**
 * Joint that allows a rotation about axis 1 of its first frame, then about axis 2 of its second.
 */
#define PDN_JOINT_UNIVERSAL 1302

/**
 * Joint that allows all rotations.
 */
#define PDN_JOINT_SPHERICAL 1303

/**
 * Joint that allows a displacement along axis 3 of its frames.
 */
#define PDN_JOINT_PRISMATIC 1304

/**
 * Joint that allows a displacement along axis 3 of its frames and a rotation about it.
 */
#define PDN_JOINT_CYLINDRICAL 1305

/**
 * Joint that allows displacements along axes 1 and 2 of its first frame and a rotation about axis
 * 3.
 */
#define PDN_JOINT_PLANAR 1306

/**
 * Joint that allows everything: it carries springs, prescribed coordinates and measures.
 */
#define PDN_JOINT_FREE 1307

/**
 * Joint that allows a displacement along axis 3 of its frames, in proportion to the rotation about
 * it; made by functions of its own, for its pitch.
 */
#define PDN_JOINT_SCREW 1308

/**
 * The line between two points, which constrains nothing; made by ::pdn_model_add_strut.
 */
#define PDN_JOINT_STRUT 1309

/**
 * Joint coordinate: the displacement, or the first of several.
 */
#define PDN_DISPLACEMENT 1400

/**
 * Joint coordinate: second displacement of a planar or free joint.
 */
#define PDN_DISPLACEMENT_2 1401

/**
 * Joint coordinate: third displacement of a free joint.
 */
#define PDN_DISPLACEMENT_3 1402

/**
 * Joint coordinate: the angle, or the first of several.
 */
#define PDN_ROTATION 1403

/**
 * Joint coordinate: second angle of a universal, spherical or free joint.
 */
#define PDN_ROTATION_2 1404

/**
 * Joint coordinate: third angle of a spherical or free joint.
 */
#define PDN_ROTATION_3 1405

/**
 * Kind of a line: straight.
 */
#define PDN_LINE_STRAIGHT 1500

/**
 * Kind of a line: circular arc.
 */
#define PDN_LINE_ARC 1501

/**
 * Kind of a line: a curve that the caller computes.
 */
#define PDN_LINE_CURVE 1502

/**
 * Directions of a load, or axes of a velocity, force or reaction: the global axes.
 */
#define PDN_FRAME_SPACE 1600

/**
 * The same: the axes of the node, which a load follows.
 */
#define PDN_FRAME_MATERIAL 1601

/**
 * Directions of a load along a beam: the axes that its sections have without twist, which follow
 * the sections.
 */
#define PDN_FRAME_UNTWISTED 1602

/**
 * Component of a load: force along axis 1.
 */
#define PDN_FORCE_1 1700

/**
 * Component of a load: force along axis 2.
 */
#define PDN_FORCE_2 1701

/**
 * Component of a load: force along axis 3.
 */
#define PDN_FORCE_3 1702

/**
 * Component of a load: moment about axis 1.
 */
#define PDN_MOMENT_1 1703

/**
 * Component of a load: moment about axis 2.
 */
#define PDN_MOMENT_2 1704

/**
 * Component of a load: moment about axis 3.
 */
#define PDN_MOMENT_3 1705

/**
 * Kind of a surface: parallelogram.
 */
#define PDN_SURFACE_PARALLELOGRAM 1800

/**
 * Kind of a surface: sector of an annulus.
 */
#define PDN_SURFACE_ANNULUS 1801

/**
 * Kind of a surface: cylinder.
 */
#define PDN_SURFACE_CYLINDER 1802

/**
 * Kind of a surface: one that the caller computes.
 */
#define PDN_SURFACE_FUNCTION 1803

/**
 * Frames of a shell: along the normals of its surface at the nodes.
 */
#define PDN_SHELL_NORMALS 1900

/**
 * Frames of a shell: parallel at all nodes of an element. Somewhat better on curved elements of
 * three and more nodes a side; thin warped elements of two nodes a side lock.
 */
#define PDN_SHELL_PARALLEL 1901

/**
 * Frames of a shell: along the third axes of the nodes' own frames, as normals of a surface that
 * is known better than its elements show it; of use with two nodes a side.
 */
#define PDN_SHELL_NODE_AXES 1902

/**
 * Frames of a shell: those of the nodes themselves, with their third axes for normals, if they are
 * known from elsewhere. Those of an element should turn from node to node no more than it does.
 */
#define PDN_SHELL_NODE_FRAMES 1903

/**
 * Place of a load on a shell element: its edge where eta = -1, along xi.
 */
#define PDN_SHELL_EDGE_START_ETA 2000

/**
 * Place of a load on a shell element: its edge where xi = 1, along eta.
 */
#define PDN_SHELL_EDGE_END_XI 2001

/**
 * Place of a load on a shell element: its edge where eta = 1, along xi.
 */
#define PDN_SHELL_EDGE_END_ETA 2002

/**
 * Place of a load on a shell element: its edge where xi = -1, along eta.
 */
#define PDN_SHELL_EDGE_START_XI 2003

/**
 * Place of a load on a shell element: its surface.
 */
#define PDN_SHELL_SURFACE 2004

/**
 * A bushing measures rotations by the rotation vector; its angle stays below half a turn.
 */
#define PDN_ANGLES_ROTATION_VECTOR 2100

/**
 * A bushing measures the tilt of axis 3, as a rotation vector about axes 1 and 2, and the rate of
 * the spin about axis 3, which may go on and on: for journal bearings and seals.
 */
#define PDN_ANGLES_TILT_AND_SPIN 2101

/**
 * Tangents of a user's function: it gives none, and the library finds them by differences of its
 * forces.
 */
#define PDN_TANGENTS_DIFFERENCED 2200

/**
 * Tangents of a user's function: it gives them.
 */
#define PDN_TANGENTS_GIVEN 2201

/**
 * Which tangent: derivative by a motion or coordinate.
 */
#define PDN_TANGENT_MOTION 2300

/**
 * Which tangent: derivative by a velocity or rate.
 */
#define PDN_TANGENT_VELOCITY 2301

/**
 * What has a label: a node, or a rigid body, which is one.
 */
#define PDN_OBJECT_NODE 1000

/**
 * What has a label: a joint.
 */
#define PDN_OBJECT_JOINT 1001

/**
 * What has a label: a beam element.
 */
#define PDN_OBJECT_BEAM_ELEMENT 1002

/**
 * What has a label: a shell element.
 */
#define PDN_OBJECT_SHELL_ELEMENT 1003

/**
 * What has a label: a force, but not a load.
 */
#define PDN_OBJECT_FORCE 1004

/**
 * What has a label: a linear relation between joint coordinates.
 */
#define PDN_OBJECT_RELATION 1005

/**
 * What has a label: a load on a node or at a point.
 */
#define PDN_OBJECT_LOAD 1006

/**
 * What has a label: a load along beam elements.
 */
#define PDN_OBJECT_BEAM_LOAD 1007

/**
 * What has a label: a load on shell elements.
 */
#define PDN_OBJECT_SHELL_LOAD 1008

/**
 * What has a label: the inertia of a rigid body, or a mass or inertia on a node.
 */
#define PDN_OBJECT_INERTIA 1009

/**
 * What has a label: a prescribed coordinate.
 */
#define PDN_OBJECT_PRESCRIBED 1010

/**
 * Bytes of a label at most, without the NUL.
 */
#define PDN_LABEL_LENGTH 200

/**
 * Outcome: converged. With PDN_TOLERANCE_NOT_MET the only outcomes that are solutions.
 */
#define PDN_CONVERGED 2400

/**
 * Outcome: the iteration limit was reached.
 */
#define PDN_ITERATION_LIMIT 2401

/**
 * Outcome: no step along the Newton direction brings progress.
 */
#define PDN_STALLED 2402

/**
 * Outcome: the Jacobian is singular; something is free to move, or in resonance without damping.
 */
#define PDN_SINGULAR 2403

/**
 * Outcome: the progress callback cancelled the solve.
 */
#define PDN_CANCELLED 2404

/**
 * Outcome: no initial guess could be found.
 */
#define PDN_NO_INITIAL_GUESS 2405

/**
 * Outcome: constraints that depend on each other contradict each other; the mechanism is locked,
 * or cannot close.
 */
#define PDN_INCONSISTENT 2406

/**
 * Outcome: a joint has closed turned over, its axes against each other; the report names it.
 */
#define PDN_WRONG_ASSEMBLY 2407

/**
 * Outcome: converged on the last grid tried, but the estimated error misses the tolerance, as the
 * report explains; quantities are as good as pdn_diagnostics.error_estimate says.
 */
#define PDN_TOLERANCE_NOT_MET 2408

/**
 * Outcome: all work was done that pdn_periodic_options.work_limit allows, and the report tells
 * what was tried; or as many steps of a march are kept as pdn_march_options.memory_limit allows.
 */
#define PDN_WORK_LIMIT 2409

/**
 * Decay of harmonics: not known, as there are too few or the solve has not converged.
 */
#define PDN_DECAY_UNKNOWN 2500

/**
 * Decay of harmonics: fast, as of a smooth response that the grid resolves.
 */
#define PDN_DECAY_FAST 2501

/**
 * Decay of harmonics: no faster than the fourth power of their number. The response has a kink, or
 * a peak too narrow for the grid; forces may oscillate about their values.
 */
#define PDN_DECAY_SLOW 2502

/**
 * Decay of harmonics: they have fallen to rounding; a finer grid gains nothing.
 */
#define PDN_DECAY_ROUNDING 2503

/**
 * Axes of a joint reaction: the joint frame on the first body.
 */
#define PDN_FRAME_FIRST 1603

/**
 * Axes of a joint reaction: the joint frame on the second body.
 */
#define PDN_FRAME_SECOND 1604

/**
 * Kind of quantity: position of a node; 3 components \[length\].
 */
#define PDN_NODE_POSITION 100

/**
 * Kind of quantity: rotation matrix of a node, column by column; 9 components.
 */
#define PDN_NODE_ROTATION 101

/**
 * Kind of quantity: unit quaternion (w, x, y, z) of a node, of continuous sign; 4 components.
 */
#define PDN_NODE_QUATERNION 102

/**
 * Kind of quantity: velocity and angular velocity of a node, in a frame; 6 components.
 */
#define PDN_NODE_VELOCITY 103

/**
 * Kind of quantity: acceleration and angular acceleration of a node, in a frame; 6 components.
 */
#define PDN_NODE_ACCELERATION 104

/**
 * Kind of quantity: a coordinate of a joint, angles followed through whole turns.
 */
#define PDN_JOINT_COORDINATE 200

/**
 * Kind of quantity: rate of a coordinate of a joint.
 */
#define PDN_JOINT_RATE 201

/**
 * Kind of quantity: second derivative in time of a coordinate of a joint.
 */
#define PDN_JOINT_ACCELERATION 202

/**
 * Kind of quantity: force or torque that drives a prescribed coordinate of a joint.
 */
#define PDN_JOINT_DRIVING_EFFORT 203

/**
 * Kind of quantity: force and moment of a joint on its second body, along axes; 6 components.
 */
#define PDN_JOINT_REACTION 204

/**
 * Kind of quantity: strains and curvatures of a beam element; 6 components.
 */
#define PDN_BEAM_STRAIN 300

/**
 * Kind of quantity: internal forces and moments of a beam element; 6 components.
 */
#define PDN_BEAM_FORCE 301

/**
 * Kind of quantity: the same, at a node between two elements the mean of those of both.
 */
#define PDN_BEAM_FORCE_MEAN 302

/**
 * Kind of quantity: at a node between two elements, internal forces of the one beyond it less
 * those of the one before it; zero elsewhere; 6 components.
 */
#define PDN_BEAM_FORCE_JUMP 303

/**
 * Kind of quantity: effort of a force on its joint coordinate.
 */
#define PDN_FORCE_EFFORT 400

/**
 * Kind of quantity: effort of a branch of a viscoelastic element.
 */
#define PDN_FORCE_BRANCH_EFFORT 401

/**
 * Kind of quantity: elongation of the dashpot of a branch of a viscoelastic element.
 */
#define PDN_FORCE_BRANCH_ELONGATION 402

/**
 * Kind of quantity: what a force exerts on one of its nodes, in a frame: force and moment; 6
 * components.
 */
#define PDN_FORCE_ON_NODE 403

/**
 * Kind of quantity: the efforts of a bushing against its deformation, forces along the axes of its
 * first frame and moments; 6 components.
 */
#define PDN_FORCE_BUSHING_EFFORTS 404

/**
 * Kind of quantity: effort of a controller on one of the coordinates that it acts on, towards
 * growth.
 */
#define PDN_FORCE_CONTROL_EFFORT 405

/**
 * Kind of quantity: a state of a controller.
 */
#define PDN_FORCE_CONTROL_STATE 406

/**
 * Kind of quantity: strains of a shell element, in the order of ::pdn_shell_section; 12
 * components.
 */
#define PDN_SHELL_STRAIN 500

/**
 * Kind of quantity: forces and moments of a shell element per unit of reference length, in the
 * same order: N11 N12 Q1 M11 M12 M1n, N21 N22 Q2 M21 M22 M2n; 12 components.
 */
#define PDN_SHELL_RESULTANT 501

/**
 * Kind of quantity: stresses 11, 22, 12 at the surface of an isotropic shell that its normal
 * points out of, and von Mises' stress of these \[force / length^2\]; 4 components.
 */
#define PDN_SHELL_STRESS_TOP 502

/**
 * Kind of quantity: the same at the other surface; 4 components.
 */
#define PDN_SHELL_STRESS_BOTTOM 503

/**
 * Kind of quantity: effort of a linear relation on one of its joint coordinates, towards growth.
 */
#define PDN_RELATION_EFFORT 600

/**
 * All components of a quantity.
 */
#define PDN_ALL_COMPONENTS -2

/**
 * Spectral filter: Lanczos' factors, (sin(x) / x)^order with x = pi j / (H + 1) for harmonic j of
 * H. Of order 1 they are running means over two grid intervals; order 2 or 3 removes more.
 */
#define PDN_FILTER_LANCZOS 3100

/**
 * Spectral filter: exp(-36 (j / (H + 1))^order) for harmonic j of H. Order 2 smooths most; a high
 * order, as 8, spares all but the highest harmonics.
 */
#define PDN_FILTER_EXPONENTIAL 3101

/**
 * Stage of a solve: finding the initial guess, each iteration at a single instant.
 */
#define PDN_STAGE_INITIAL_GUESS 3200

/**
 * Stage of a solve: Newton iterations of the periodic problem.
 */
#define PDN_STAGE_NEWTON 3201

/**
 * Stage of a march: a step, with the last of its iterations.
 */
#define PDN_STAGE_MARCH 3202

/**
 * Stage of a modal analysis: looking for modes about the equilibrium.
 */
#define PDN_STAGE_MODES 3203

/**
 * Following disturbances of a periodic solution.
 */
#define PDN_STAGE_STABILITY 3204

/**
 * Start of a periodic solve: the library tries those that suit, cheapest first.
 */
#define PDN_START_AUTOMATIC 3300

/**
 * Start of a periodic solve: equilibrium at each time, without velocities.
 */
#define PDN_START_QUASI_STATIC 3301

/**
 * Start of a periodic solve: equilibrium at each time of what turns steadily with its drives, with
 * its centrifugal and gyroscopic forces.
 */
#define PDN_START_STEADY_ROTATION 3302

/**
 * Start of a periodic solve: all that hangs on drives turned with them, undeformed.
 */
#define PDN_START_RIGID_ROTATION 3303

/**
 * Start of a periodic solve: the quasi-static motion, and inertial forces raised in steps.
 */
#define PDN_START_RAISED_INERTIA 3304

/**
 * Start of a periodic solve: a march in time with strong numerical dissipation.
 */
#define PDN_START_MARCH 3305

/**
 * Start of a periodic solve: the quasi-static motion, and added damping taken away in steps.
 */
#define PDN_START_LOWERED_DAMPING 3306

/**
 * Start of a periodic solve: the reference configuration, and loads and prescribed motions raised
 * in steps; not where these gain whole turns in a period.
 */
#define PDN_START_RAISED_LOADS 3307

/**
 * Grid points are equispaced, but closer together where a solve to a tolerance finds the motion
 * sharp.
 */
#define PDN_TIME_MAP_AUTOMATIC 3400

/**
 * Grid points are equispaced.
 */
#define PDN_TIME_MAP_EQUISPACED 3401

/**
 * Grid points are closer together about events that are given.
 */
#define PDN_TIME_MAP_EVENTS 3402

/**
 * Linear equations: solved directly where that is quick, by iteration otherwise.
 */
#define PDN_LINEAR_AUTOMATIC 3500

/**
 * Linear equations: solved by factors of the whole Jacobian. Time grows with the third power of
 * the number of grid points, memory with the second.
 */
#define PDN_LINEAR_DIRECT 3501

/**
 * Linear equations: solved by iteration, with the preconditioner that suits; time and memory grow
 * in proportion to nodes and grid points, or little more.
 */
#define PDN_LINEAR_ITERATIVE 3502

/**
 * Linear equations: solved by iteration; bodies are averaged over time for the preconditioner,
 * joints are not.
 */
#define PDN_LINEAR_BODY_CIRCULANT 3503

/**
 * Linear equations: solved by iteration; the preconditioner is equilibrium at each grid point,
 * without inertia.
 */
#define PDN_LINEAR_TIME_LOCAL 3504

/**
 * Linear equations: solved by iteration; everything is averaged over time for the preconditioner.
 */
#define PDN_LINEAR_CIRCULANT 3505

/**
 * A parameter moves the coefficient of a power, from 1, of the growth of a spring-damper, or with
 * power 1 the long-term stiffness of a viscoelastic force or a factor of the stiffness of a
 * bushing.
 */
#define PDN_NUMBER_STIFFNESS 3600

/**
 * A parameter moves the coefficient of a power, from 1, of the rate of a spring-damper, or with
 * power 1 a factor of the damping of a bushing.
 */
#define PDN_NUMBER_DAMPING 3601

/**
 * A parameter moves the coordinate at which a spring-damper or viscoelastic force is free of
 * effort.
 */
#define PDN_NUMBER_REST 3602

/**
 * A parameter moves a factor of an inertia: that of a rigid body, or a mass or inertia on a node.
 */
#define PDN_NUMBER_INERTIA 3603

/**
 * A parameter moves a factor of the sections' stiffness along a beam element.
 */
#define PDN_NUMBER_BEAM_STIFFNESS 3604

/**
 * A parameter moves a factor of the sections' mass along a beam element.
 */
#define PDN_NUMBER_BEAM_MASS 3605

/**
 * A parameter moves a factor of the sections' damping along a beam element.
 */
#define PDN_NUMBER_BEAM_DAMPING 3606

/**
 * A parameter moves the damping in proportion to mass, ::pdn_model_set_mass_damping.
 */
#define PDN_NUMBER_MASS_DAMPING 3607

/**
 * A parameter moves a factor of the stiffness of a shell element.
 */
#define PDN_NUMBER_SHELL_STIFFNESS 3609

/**
 * A parameter moves a factor of the mass of a shell element.
 */
#define PDN_NUMBER_SHELL_MASS 3610

/**
 * A parameter moves a factor of the damping of a shell element.
 */
#define PDN_NUMBER_SHELL_DAMPING 3611

/**
 * A parameter moves a factor of the thickness of a shell element, more than zero, all its layers
 * alike: stiffness, damping and mass against stretching grow with it, against bending and turning
 * with its cube, what couples them with its square.
 */
#define PDN_NUMBER_SHELL_THICKNESS 3612

/**
 * A parameter moves the rate of the frame that everything is described in,
 * ::pdn_model_set_turning_frame.
 */
#define PDN_NUMBER_FRAME_RATE 3613

/**
 * A parameter moves the rate at which an inertia spins, ::pdn_model_set_spin.
 */
#define PDN_NUMBER_SPIN 3614

/**
 * A parameter moves the rate at which the material of a beam element spins,
 * ::pdn_model_set_beam_spin.
 */
#define PDN_NUMBER_BEAM_SPIN 3615

/**
 * A parameter moves the speed of the frame that everything is described in along its axis,
 * ::pdn_model_set_frame_advance.
 */
#define PDN_NUMBER_FRAME_ADVANCE 3616

/**
 * Part of a signal: the mean that is added to its shape.
 */
#define PDN_PART_MEAN 3800

/**
 * Part of a signal: growth in a unit of time.
 */
#define PDN_PART_RATE 3801

/**
 * Part of a signal: the factor of its shape, which is its harmonics, its samples or its function.
 */
#define PDN_PART_AMPLITUDE 3802

/**
 * Part of a signal: the phase by which its shape is ahead \[radians\].
 */
#define PDN_PART_PHASE 3803

/**
 * A parameter: the circular frequency 2 pi / T, which every model has.
 */
#define PDN_FREQUENCY -3

/**
 * In place of an id: gravity, whose components have signals.
 */
#define PDN_GRAVITY -4

/**
 * Kind of force: springs and dampers on a joint coordinate.
 */
#define PDN_FORCE_IS_SPRING_DAMPER 1100

/**
 * Kind of force: an actuator on a joint coordinate.
 */
#define PDN_FORCE_IS_ACTUATOR 1101

/**
 * Kind of force: a law of the user on a joint coordinate.
 */
#define PDN_FORCE_IS_COORDINATE_LAW 1102

/**
 * Kind of force: a viscoelastic element on a joint coordinate.
 */
#define PDN_FORCE_IS_VISCOELASTIC 1103

/**
 * Kind of force: a viscous damper between two bodies.
 */
#define PDN_FORCE_IS_VISCOUS_DAMPER 1104

/**
 * Kind of force: a bushing between two frames.
 */
#define PDN_FORCE_IS_BUSHING 1105

/**
 * Kind of force: forces of the user on nodes.
 */
#define PDN_FORCE_IS_USER_FORCE 1106

/**
 * Kind of force: a controller.
 */
#define PDN_FORCE_IS_CONTROLLER 1107

/**
 * Kind of force: forces of the user on a shell element.
 */
#define PDN_FORCE_IS_SURFACE_FORCE 1108

/**
 * Kind of force: forces of the user along a beam element.
 */
#define PDN_FORCE_IS_LINE_FORCE 1109

/**
 * Numbers of a force: relaxation times of the branches of a viscoelastic element. Parameters do
 * not move them.
 */
#define PDN_NUMBER_RELAXATION_TIME 3608

/**
 * Feature of a quantity: its mean over the period, without what it gains.
 */
#define PDN_FEATURE_MEAN 2900

/**
 * Feature of a quantity: coefficient of the cosine of a harmonic.
 */
#define PDN_FEATURE_COSINE 2901

/**
 * Feature of a quantity: coefficient of the sine of a harmonic.
 */
#define PDN_FEATURE_SINE 2902

/**
 * Feature of a quantity: value at a time, of the trigonometric polynomial through the values at
 * the grid points.
 */
#define PDN_FEATURE_VALUE 2903

/**
 * Feature of a quantity, for sensitivities: its largest value over the period.
 */
#define PDN_FEATURE_LARGEST 2904

/**
 * Feature of a quantity, for sensitivities: its smallest value over the period.
 */
#define PDN_FEATURE_SMALLEST 2905

/**
 * Sensitivities: with as few linear solves as can be, directly or adjoint.
 */
#define PDN_SENSITIVITY_AUTOMATIC 3900

/**
 * Sensitivities: a linear solve for each parameter.
 */
#define PDN_SENSITIVITY_DIRECT 3901

/**
 * Sensitivities: a transposed linear solve for each dependent, by factors of the whole Jacobian.
 */
#define PDN_SENSITIVITY_ADJOINT 3902

/**
 * A branch ended at an end of the parameter's range.
 */
#define PDN_BRANCH_RANGE 4000

/**
 * A branch ended as it came back to its first point.
 */
#define PDN_BRANCH_CLOSED 4001

/**
 * A branch ended as it has as many points as are allowed.
 */
#define PDN_BRANCH_POINT_LIMIT 4002

/**
 * A branch ended where the shortest step leads to no solution.
 */
#define PDN_BRANCH_SMALLEST_STEP 4003

/**
 * A branch ended as it was cancelled.
 */
#define PDN_BRANCH_CANCELLED 4004

/**
 * A branch has no points, as there is no solution to start from.
 */
#define PDN_BRANCH_NO_START 4005

/**
 * A branch ended with an error, such as that of a callback, which its report tells.
 */
#define PDN_BRANCH_FAILED 4006

/**
 * Nothing happens at a point of a branch.
 */
#define PDN_EVENT_NONE 4100

/**
 * The parameter turns back at a point of a branch: a fold.
 */
#define PDN_EVENT_FOLD 4101

/**
 * Another branch passes through a point of a branch.
 */
#define PDN_EVENT_BRANCH_POINT 4102

/**
 * A branch of twice the period begins at a point of a branch.
 */
#define PDN_EVENT_PERIOD_DOUBLING 4103

/**
 * A pair of complex multipliers is on the unit circle at a point of a branch: motions with a
 * second frequency begin there.
 */
#define PDN_EVENT_TORUS 4104

/**
 * Verdict on stability: it cannot be told, as multipliers are on the unit circle or not known well
 * enough.
 */
#define PDN_STABILITY_NOT_KNOWN 4200

/**
 * Verdict on stability: disturbances die away, but for those that only move the solution in time
 * or space.
 */
#define PDN_STABLE 4201

/**
 * Verdict on stability: a disturbance grows.
 */
#define PDN_UNSTABLE 4202

/**
 * Periodic motions along a parameter. Made by ::pdn_follow_branch, freed by ::pdn_branch_free.
 */
typedef struct pdn_branch pdn_branch;

/**
 * Free parameters, and as many conditions. Made by ::pdn_conditions_new, freed by
 * ::pdn_conditions_free.
 */
typedef struct pdn_conditions pdn_conditions;

/**
 * The equations of a periodic motion on a grid, or a rank's part of them. Made by
 * ::pdn_equations_new, freed by ::pdn_equations_free.
 *
 * They are for solvers of your own: residual, Jacobian as an operator, preconditioner, and steps
 * of the motions. With several ranks, such as those of MPI, each has the equations and unknowns of
 * its nodes, over the whole period; what they have to tell each other goes through functions that
 * you give. A function that is said to be called by all ranks must be called by all of them, in
 * the same order; if it fails on one it fails on all, with the same status, unless it is said
 * otherwise.
 *
 * Vectors hold the unknowns, or the equations, of the rank, scaled: first of each of its nodes,
 * in ascending order, the six components of the increment (displacement along the node's axes
 * relative to the characteristic length, then turn about them in radians) at one grid point after
 * the other. Then, for each element with multipliers or internal states whose first node is the
 * rank's, these at one grid point after the other. Then, with the preconditioner
 * PDN_LINEAR_BODY_CIRCULANT or PDN_LINEAR_CIRCULANT, stress resultants of beams, which are
 * unknowns of their own there: the residual has zeros for them, and steps do not look at them.
 */
typedef struct pdn_equations pdn_equations;

/**
 * A mechanism. Made by ::pdn_model_new, freed by ::pdn_model_free.
 *
 * It is described in its reference configuration: points, directions and frames are those of the
 * undeformed, assembled mechanism, all in the global axes, which are fixed to the ground. Any
 * consistent set of units will do (such as metre, newton, kilogram, second); angles are in
 * radians.
 *
 * All that is added has an id, in the order in which it was added: nodes from PDN_FIRST_NODE on,
 * joints from PDN_FIRST_JOINT on, and so on. A call that fails leaves the model as it was.
 */
typedef struct pdn_model pdn_model;

/**
 * An equilibrium and the modes about it. Made by ::pdn_solve_modes, freed by ::pdn_modes_free.
 */
typedef struct pdn_modes pdn_modes;

/**
 * What is differentiated, by what. Made by ::pdn_sensitivities_new, freed by
 * ::pdn_sensitivities_free.
 */
typedef struct pdn_sensitivities pdn_sensitivities;

/**
 * A solution, converged or not. Made by ::pdn_solve_periodic, ::pdn_solve_static,
 * ::pdn_solve_march and ::pdn_modes_motion, freed by ::pdn_solution_free.
 *
 * That of a march is a trajectory: the same functions give its quantities at times from its first
 * to its last (PDN_ERR_VALUE for any other), but it has no harmonics (PDN_ERR_NOT_AVAILABLE).
 */
typedef struct pdn_solution pdn_solution;

/**
 * Floquet multipliers of a periodic solution. Made by ::pdn_solve_stability, freed by
 * ::pdn_stability_free.
 */
typedef struct pdn_stability pdn_stability;

/**
 * Columns of numbers over the same times. Made by ::pdn_table_new, freed by ::pdn_table_free.
 */
typedef struct pdn_table pdn_table;

/**
 * What a call returns: PDN_OK, or the negative code of a failure.
 *
 * Whether a solve converged is not a status but a part of its result.
 */
typedef int32_t pdn_status;

/**
 * Cross-section of a beam, per unit of length.
 *
 * The matrices are 6 x 6, column-major, symmetric (damping need not be), and resolved in the axes
 * of the section: axis 1 is along the beam. Rows and columns are in the order force 1, 2, 3,
 * moment 1, 2, 3, which is axial, shear 2, shear 3, torsion, bending about axis 2, bending about
 * axis 3. Any consistent set of units.
 *
 * Start with `PDN_INIT(pdn_section, &section)`; then ::pdn_section_set_diagonal, or write the
 * matrices yourself. A section without stiffness is refused where it is used.
 */
typedef struct pdn_section {
    /**
     * Set by the initialiser.
     */
    size_t struct_size;
    /**
     * Forces and moments for unit strains and curvatures; positive definite.
     */
    double stiffness[36];
    /**
     * Momenta for unit velocities; positive semi-definite.
     */
    double mass[36];
    /**
     * Forces and moments for unit rates of strain and curvature. It may be unsymmetric, as a
     * diagonal matrix of times times the stiffness is for coupled sections; its symmetric part is
     * positive semi-definite, so that no motion gains energy.
     */
    double damping[36];
} pdn_section;

/**
 * A function of time, to be written by the caller.
 *
 * Called on the thread that solves, with times from 0 to the period T of the solve, or with the
 * times of a march; if two threads solve at once, on both at once. It must give the same value for
 * the same time, and must neither throw nor jump out, nor use the model it belongs to.
 *
 * @param time  in [0, T]
 * @param value  where the value goes; not NULL, valid during the call only
 * @param user_data  as given to ::pdn_signal_set_function
 * @return 0 for success; anything else makes the solve fail with PDN_ERR_CALLBACK (see
 *     ::pdn_set_callback_error and ::pdn_last_callback_code), as does a value that is not finite
 */
typedef int32_t (*pdn_signal_fn)(double time,
                                 double *value,
                                 void *user_data);

/**
 * A scalar function of time: a load's component or a prescribed coordinate.
 *
 * Start with `PDN_INIT(pdn_signal, &signal)`, which makes it zero; then one of the
 * `pdn_signal_set_...`, each of which replaces all that was set before. Leave the fields to them.
 *
 * The signal only points to the caller's arrays: they must be there until the signal has been
 * given to the model, which copies them. It can be given any number of times.
 */
typedef struct pdn_signal {
    /**
     * Set by the initialiser.
     */
    size_t struct_size;
    /**
     * PDN_SIGNAL_HARMONICS, PDN_SIGNAL_SAMPLES, PDN_SIGNAL_FUNCTION or
     * PDN_SIGNAL_FUNCTION_OF_PHASE.
     */
    int32_t kind;
    /**
     * Leave it zero.
     */
    int32_t reserved;
    /**
     * Mean; with harmonics only.
     */
    double mean;
    /**
     * Growth for a unit of time; with harmonics or samples.
     */
    double rate;
    /**
     * Array of length [harmonics].
     */
    const double *cosines;
    /**
     * Array of length [harmonics].
     */
    const double *sines;
    /**
     * Number of harmonics.
     */
    size_t harmonics;
    /**
     * Array of length [sample_count].
     */
    const double *samples;
    /**
     * Number of samples.
     */
    size_t sample_count;
    /**
     * The function.
     */
    pdn_signal_fn function;
    /**
     * Handed to the function.
     */
    void *user_data;
} pdn_signal;

/**
 * Position and axes of a frame. This struct will never change.
 */
typedef struct pdn_frame {
    /**
     * Its origin, in global coordinates [length].
     */
    double position[3];
    /**
     * Its axes, in global coordinates: a rotation matrix, 3 x 3, column by column, the columns
     * being axes 1, 2, 3. Rounding up to 1e-8 is tolerated, and removed.
     */
    double rotation[9];
} pdn_frame;

/**
 * A smooth curve in space, to be written by the caller.
 *
 * Called only during the call that takes the line, on its thread, many times and in any order. It
 * must neither throw nor jump out, nor use the model that the beam is added to.
 *
 * @param fraction  place along the curve, from 0 at its start to 1 at its end
 * @param position  array of length 3: where the position goes, global coordinates \[length\];
 *     valid during the call only
 * @param axis_2  array of length 3: where a direction goes, of any nonzero length, not along the
 *     curve; the part of it that is perpendicular to the curve is axis 2 of the line's frame there
 * @param user_data  as given to ::pdn_line_set_curve
 * @return 0 for success; anything else makes the call fail with PDN_ERR_CALLBACK (see
 *     ::pdn_set_callback_error and ::pdn_last_callback_code)
 */
typedef int32_t (*pdn_curve_fn)(double fraction,
                                double *position,
                                double *axis_2,
                                void *user_data);

/**
 * Reference line of a beam: a frame at each fraction of the span, with axis 1 along the line.
 *
 * Start with `PDN_INIT(pdn_line, &line)`; then one of the `pdn_line_set_...`, each of which
 * replaces all that was set before. Leave the fields to them.
 */
typedef struct pdn_line {
    /**
     * Set by the initialiser.
     */
    size_t struct_size;
    /**
     * PDN_LINE_STRAIGHT, PDN_LINE_ARC or PDN_LINE_CURVE.
     */
    int32_t kind;
    /**
     * Leave it zero.
     */
    int32_t reserved;
    /**
     * Start of a straight line or an arc.
     */
    double start[3];
    /**
     * A point of an arc.
     */
    double point[3];
    /**
     * End of a straight line or an arc.
     */
    double end[3];
    /**
     * Direction of axis 2 at the start of a straight line or an arc.
     */
    double axis_2[3];
    /**
     * The curve.
     */
    pdn_curve_fn curve;
    /**
     * Handed to the curve.
     */
    void *user_data;
} pdn_line;

/**
 * Cross-sections along a beam, at stations; linear in between, entry by entry.
 *
 * Start with `PDN_INIT(pdn_stations, &stations)`, then set the fields. The library reads the
 * arrays during the call that takes the stations.
 */
typedef struct pdn_stations {
    /**
     * Set by the initialiser.
     */
    size_t struct_size;
    /**
     * Number of stations; one alone stands for all of the beam.
     */
    size_t count;
    /**
     * Array of length [count]: places along the span, from 0 at the start to 1 at the end,
     * ascending; two stations at the same place make a jump. May be NULL if count is 1.
     */
    const double *fractions;
    /**
     * Array of length [count]: the sections, each initialised.
     */
    const struct pdn_section *sections;
    /**
     * Array of length [count]: structural twist, the angles by which axes 2 and 3 of the sections
     * are turned about axis 1 from those of the line, right-handed, linear between stations
     * [radian]. NULL for none. It has no jumps.
     */
    const double *twists;
} pdn_stations;

/**
 * What a beam was made of; written by the library. This struct will never change its size.
 *
 * The nodes along the beam are first, first + 1, ... last; the elements are first_element,
 * ... first_element + elements - 1.
 */
typedef struct pdn_beam {
    /**
     * Id of the node at the start.
     */
    int32_t first;
    /**
     * Id of the node at the end.
     */
    int32_t last;
    /**
     * Id of the element at the start.
     */
    int32_t first_element;
    /**
     * Number of elements.
     */
    int32_t elements;
    /**
     * Zero.
     */
    int32_t reserved[4];
} pdn_beam;

/**
 * A surface in space, to be written by the caller.
 *
 * Called only during the call that takes the surface, on its thread, once for each node. It must
 * neither throw nor jump out, nor use the model that the shell is added to.
 *
 * @param u  place in the first direction, from 0 to 1
 * @param v  place in the second direction, from 0 to 1
 * @param position  array of length 3: where the position goes, global coordinates \[length\];
 *     valid during the call only
 * @param user_data  as given to ::pdn_surface_set_function
 * @return 0 for success; anything else makes the call fail with PDN_ERR_CALLBACK (see
 *     ::pdn_set_callback_error and ::pdn_last_callback_code)
 */
typedef int32_t (*pdn_surface_fn)(double u,
                                  double v,
                                  double *position,
                                  void *user_data);

/**
 * A surface: a point for each pair (u, v), each from 0 to 1.
 *
 * Its normal is that of the tangents along u and v, in this order. Start with
 * `PDN_INIT(pdn_surface, &surface)`; then one of the `pdn_surface_set_...`, each of which replaces
 * all that was set before. Leave the fields to them.
 */
typedef struct pdn_surface {
    /**
     * Set by the initialiser.
     */
    size_t struct_size;
    /**
     * PDN_SURFACE_PARALLELOGRAM, PDN_SURFACE_ANNULUS, PDN_SURFACE_CYLINDER or
     * PDN_SURFACE_FUNCTION.
     */
    int32_t kind;
    /**
     * Leave it zero.
     */
    int32_t reserved;
    /**
     * Corner of a parallelogram, centre of an annulus or of the end of a cylinder.
     */
    double origin[3];
    /**
     * Side along u of a parallelogram, axis of the others.
     */
    double axis[3];
    /**
     * Side along v of a parallelogram, direction of where the others start.
     */
    double start[3];
    /**
     * Inner and outer radius, or radius and length.
     */
    double sizes[2];
    /**
     * Angle of an annulus or a cylinder.
     */
    double angle;
    /**
     * The function.
     */
    pdn_surface_fn function;
    /**
     * Handed to the function.
     */
    void *user_data;
} pdn_surface;

/**
 * Stiffness, damping and mass of a shell, per unit of its reference area.
 *
 * Strains are `[e11 e12 g1 k11 k12 k1n, e21 e22 g2 k21 k22 k2n]`: how position and frame of the
 * surface change along axis 1, then along axis 2, resolved in axes 1, 2 and the normal. Bending of
 * lines along axis 1 is k12, along axis 2 -k21; twist is -k11 and k22; e12 - e21 is the drilling
 * rotation against the surface. Forces and moments per length are in the same order. The matrices
 * are column-major and symmetric. Any consistent set of units.
 *
 * Start with `PDN_INIT(pdn_shell_section, &section)`; then ::pdn_shell_section_set_isotropic, or
 * write the matrices yourself, as of laminates. A section without stiffness is refused where it is
 * used.
 */
typedef struct pdn_shell_section {
    /**
     * Set by the initialiser.
     */
    size_t struct_size;
    /**
     * Forces and moments for unit strains, 12 x 12; positive definite.
     */
    double stiffness[144];
    /**
     * The same for unit rates of strain; positive semi-definite.
     */
    double damping[144];
    /**
     * Momenta for unit velocities, 6 x 6; positive semi-definite.
     */
    double mass[36];
} pdn_shell_section;

/**
 * How a shell lies on its nodes. Set the defaults by `PDN_INIT(pdn_shell_placement, &placement)`.
 */
typedef struct pdn_shell_placement {
    /**
     * Set by the initialiser.
     */
    size_t struct_size;
    /**
     * PDN_SHELL_NORMALS, PDN_SHELL_PARALLEL, PDN_SHELL_NODE_AXES or PDN_SHELL_NODE_FRAMES.
     */
    int32_t frames;
    /**
     * Leave it zero.
     */
    int32_t reserved;
    /**
     * Distance of the surface that the section belongs to from the nodes, along the normal
     * [length]; default: 0.
     */
    double offset;
    /**
     * Direction whose part in the surface is axis 1 of the section, global coordinates. If it is
     * zero, the default, axes 1 and 2 are as close to xi and eta as they can be at a right angle.
     */
    double direction[3];
} pdn_shell_placement;

/**
 * What a shell over a surface was made of; written by the library. This struct will never change
 * its size.
 *
 * Element i elements_v + j from the first on is the one at i along u and j along v; xi of each is
 * in the direction of u, eta in that of v. ::pdn_model_shell_patch_node tells the nodes.
 */
typedef struct pdn_shell {
    /**
     * Id of the first element.
     */
    int32_t first_element;
    /**
     * Number of elements along u.
     */
    int32_t elements_u;
    /**
     * Number of elements along v.
     */
    int32_t elements_v;
    /**
     * Number of nodes along u.
     */
    int32_t nodes_u;
    /**
     * Number of nodes along v.
     */
    int32_t nodes_v;
    /**
     * Zero.
     */
    int32_t reserved[3];
} pdn_shell;

/**
 * A law of effort on a joint coordinate, to be written by the caller.
 *
 * Called on the thread that solves, with times in [0, T) of the period T of the solve; if two
 * threads solve at once, on both at once. The same arguments must give the same values; over time
 * the law must repeat with the period, and where its coordinate gains whole turns in a period,
 * with these. Solves refuse what does not, with PDN_ERR_NOT_PERIODIC: for that they call it first
 * a few times at one motion, at times in [0, 2 T). It must neither throw nor jump out, nor use the
 * model it belongs to.
 *
 * @param time  in [0, T), but for these first calls
 * @param coordinate  of the joint, an angle with its whole turns [length or radian]
 * @param rate  its rate
 * @param effort  where the effort goes that resists growth of the coordinate
 *     [force on a displacement,     force * length on an angle]; not NULL
 * @param derivatives  array of length 2: where the derivatives of the effort by coordinate and
 *     rate go. NULL if they are not wanted, or the law was said to give none
 * @param user_data  as given to ::pdn_model_add_coordinate_law
 * @return 0 for success; anything else makes the solve fail with PDN_ERR_CALLBACK (see
 *     ::pdn_set_callback_error and ::pdn_last_callback_code), as does a value that is not finite
 */
typedef int32_t (*pdn_coordinate_law_fn)(double time,
                                         double coordinate,
                                         double rate,
                                         double *effort,
                                         double *derivatives,
                                         void *user_data);

/**
 * Disposes of the `user_data` of a force; see ::pdn_model_add_user_force for when it is called.
 */
typedef void (*pdn_destroy_fn)(void *user_data);

/**
 * What a user's forces on nodes may depend on. The library makes it; a later one may add fields at
 * its end.
 *
 * Nodes are in the order they were given to ::pdn_model_add_user_force.
 */
typedef struct pdn_force_state {
    /**
     * Size of the struct that the library knows.
     */
    size_t struct_size;
    /**
     * Time, in [0, T) of the period T of the solve, but for the first calls of a solve
     * (::pdn_user_force_fn).
     */
    double time;
    /**
     * Number of nodes.
     */
    size_t node_count;
    /**
     * Array of shape 3 x [node_count]: positions, global coordinates [length].
     */
    const double *positions;
    /**
     * Array of shape 9 x [node_count]: rotation matrices, column by column; the columns are the
     * nodes' axes in global coordinates.
     */
    const double *rotations;
    /**
     * Array of shape 6 x [node_count]: velocity and angular velocity of each node relative to the
     * inertial frame, also in a steady rotation (::pdn_solve_static), along the global axes
     * (PDN_FRAME_SPACE) or the node's own (PDN_FRAME_MATERIAL).
     */
    const double *velocities;
    /**
     * Nodes whose motions tangents are by: all, as many as [node_count], or 1, the own node of
     * each force, where nodes were declared apart (::pdn_model_declare_nodes_apart).
     */
    size_t column_count;
} pdn_force_state;

/**
 * Where a user's forces go. The library makes it, with all arrays set to zero; a later one may add
 * fields.
 *
 * Everything is along the same axes as the velocities. Row and column of the tangents count force
 * 1, 2, 3, moment 1, 2, 3 and displacement 1, 2, 3, turn 1, 2, 3 of each node together; a turn is
 * an infinitesimal rotation. Derivatives by motion are at fixed components of the velocities.
 */
typedef struct pdn_force_values {
    /**
     * Size of the struct that the library knows.
     */
    size_t struct_size;
    /**
     * Array of shape 6 x [node_count]: force on each node and moment about it
     * [force, force * length].
     */
    double *forces;
    /**
     * Array of shape 6 x [node_count] x 6 x [column_count], column by column: derivatives of
     * forces by displacements and turns: of all nodes or, where nodes were declared apart, of the
     * own node of each force. NULL if tangents are not wanted, or were said not to be given.
     */
    double *by_motion;
    /**
     * The same by velocities and angular velocities; NULL where by_motion is.
     */
    double *by_velocity;
} pdn_force_values;

/**
 * Forces on nodes, to be computed by the caller.
 *
 * Called on the thread that solves; if two threads solve at once, on both at once. The same state
 * must give the same forces, and over time they must repeat with the period: solves call it first
 * a few times at one motion, at times in [0, 2 T), and refuse what does not with
 * PDN_ERR_NOT_PERIODIC. It must neither throw nor jump out, nor use the model it belongs to. It is
 * called many times at trial motions, which may be far from the solution.
 *
 * @param state  time and motions of the nodes; valid during the call only
 * @param values  where the forces go, all zero at first; valid during the call only
 * @param user_data  as given to ::pdn_model_add_user_force
 * @return 0 for success; anything else makes the solve fail with PDN_ERR_CALLBACK (see
 *     ::pdn_set_callback_error and ::pdn_last_callback_code), as does a value that is not finite
 */
typedef int32_t (*pdn_user_force_fn)(const struct pdn_force_state *state,
                                     struct pdn_force_values *values,
                                     void *user_data);

/**
 * Where the tangents of a user's function differ most from differences of its forces.
 *
 * Initialise with `PDN_INIT(pdn_tangent_check, &check)`.
 */
typedef struct pdn_tangent_check {
    /**
     * Set by the initialiser.
     */
    size_t struct_size;
    /**
     * Largest difference, relative to the largest tangent; lengths, angles and velocities are
     * taken relative to what is characteristic of the model and the period. Tangents that are
     * right leave about 1e-8.
     */
    double error;
    /**
     * Time of the state it was found at.
     */
    double time;
    /**
     * The derivative that the function gives there.
     */
    double given;
    /**
     * What differences of its forces give.
     */
    double differenced;
    /**
     * PDN_TANGENT_MOTION or PDN_TANGENT_VELOCITY.
     */
    int32_t tangent;
    /**
     * Node of the force that is differentiated; of one on a shell, number of the point from 0; -1
     * for an effort on a joint coordinate.
     */
    int32_t row_node;
    /**
     * Its component, PDN_FORCE_1, ... PDN_MOMENT_3; 0 for an effort.
     */
    int32_t row_component;
    /**
     * Node of the motion or velocity that it is differentiated by, or point; -1 for a joint
     * coordinate.
     */
    int32_t column_node;
    /**
     * Its component: 0, 1, 2 linear, 3, 4, 5 angular; 0 for a joint coordinate.
     */
    int32_t column_component;
    /**
     * Zero.
     */
    int32_t reserved;
} pdn_tangent_check;

/**
 * What a controller reads. The library makes it; a later one may add fields at its end.
 */
typedef struct pdn_controller_state {
    /**
     * Size of the struct that the library knows.
     */
    size_t struct_size;
    /**
     * Time, in [0, T) of the period T of the solve, but for the first calls of a solve
     * (::pdn_controller_fn).
     */
    double time;
    /**
     * Number of coordinates that are read.
     */
    size_t input_count;
    /**
     * Array of length [input_count]: the coordinates, angles with their whole turns
     * [length or radian].
     */
    const double *inputs;
    /**
     * Array of length [input_count]: their rates.
     */
    const double *input_rates;
    /**
     * Number of states.
     */
    size_t state_count;
    /**
     * Array of length [state_count]: the states.
     */
    const double *states;
} pdn_controller_state;

/**
 * Where a controller writes. The library makes it, with all arrays set to zero; a later one may
 * add fields.
 *
 * Rows of the tangents are the efforts, then the rates of the states.
 */
typedef struct pdn_controller_values {
    /**
     * Size of the struct that the library knows.
     */
    size_t struct_size;
    /**
     * Number of coordinates that it acts on.
     */
    size_t output_count;
    /**
     * Array of length [output_count]: efforts on the coordinates that it acts on, towards growth
     * [force on a displacement, force * length on an angle].
     */
    double *efforts;
    /**
     * Array of length [state_count]: rates of the states.
     */
    double *state_rates;
    /**
     * Array of shape [output_count + state_count] x [input_count], column by column:
     * derivatives by the coordinates. NULL if tangents are not wanted, or were said not to be
     * given.
     */
    double *by_inputs;
    /**
     * The same by their rates; NULL where by_inputs is.
     */
    double *by_input_rates;
    /**
     * Array of shape [output_count + state_count] x [state_count], column by column:
     * derivatives by the states; NULL where by_inputs is.
     */
    double *by_states;
} pdn_controller_values;

/**
 * A controller, to be written by the caller.
 *
 * Called on the thread that solves; if two threads solve at once, on both at once. The same state
 * must give the same values, and over time they must repeat with the period: solves call it first
 * a few times at one motion, at times in [0, 2 T), and refuse what does not with
 * PDN_ERR_NOT_PERIODIC. Where a coordinate that it reads gains whole turns in a period, efforts
 * must repeat with these. It must neither throw nor jump out, nor use the model it belongs to. It
 * is called many times at trial motions, which may be far from the solution.
 *
 * @param state  time, coordinates and states; valid during the call only
 * @param values  where efforts and rates go, all zero at first; valid during the call only
 * @param user_data  as given to ::pdn_model_add_controller
 * @return 0 for success; anything else makes the solve fail with PDN_ERR_CALLBACK (see
 *     ::pdn_set_callback_error and ::pdn_last_callback_code), as does a value that is not finite
 */
typedef int32_t (*pdn_controller_fn)(const struct pdn_controller_state *state,
                                     struct pdn_controller_values *values,
                                     void *user_data);

/**
 * What a user's forces on a shell or beam element may depend on: the points of a quadrature over
 * its surface, an edge or its line. The library makes it; a later one may add fields at its end.
 */
typedef struct pdn_surface_state {
    /**
     * Size of the struct that the library knows.
     */
    size_t struct_size;
    /**
     * Time, in [0, T) of the period T of the solve, but for the first calls of a solve
     * (::pdn_surface_force_fn).
     */
    double time;
    /**
     * Id of the shell element, or of the beam element.
     */
    int32_t element;
    /**
     * Zero.
     */
    int32_t reserved;
    /**
     * Number of points.
     */
    size_t point_count;
    /**
     * Array of shape 2 x [point_count]: xi and eta of each, from -1 to 1; eta is 0 on beams.
     */
    const double *places;
    /**
     * Array of length [point_count]: the reference area, or length of an edge or beam, that each
     * stands for: a force is this much of what the function gives.
     */
    const double *sizes;
    /**
     * Array of shape 3 x [point_count]: positions, global coordinates [length].
     */
    const double *positions;
    /**
     * Array of shape 9 x [point_count]: rotation matrices, column by column; the columns are the
     * axes of the point in global coordinates, those of a follower load: on the surface axes 1, 2
     * and the normal, on an edge 1 along it, 3 along the normal, and 2 = 3 * 1; along a beam those
     * of its section, or with PDN_FRAME_UNTWISTED those without twist.
     */
    const double *rotations;
    /**
     * Array of shape 6 x [point_count]: velocity and angular velocity of each point relative to
     * the inertial frame, also in a steady rotation (::pdn_solve_static), along the global axes
     * (PDN_FRAME_SPACE) or the point's own (PDN_FRAME_MATERIAL).
     */
    const double *velocities;
} pdn_surface_state;

/**
 * Where a user's forces on a shell or beam element go. The library makes it, with all arrays set
 * to zero; a later one may add fields.
 *
 * Everything is along the same axes as the velocities, for each unit of reference area or length.
 * Rows and columns of the tangents are those of ::pdn_force_values, of one point.
 */
typedef struct pdn_surface_values {
    /**
     * Size of the struct that the library knows.
     */
    size_t struct_size;
    /**
     * Array of shape 6 x [point_count]: force at each point and moment about it.
     */
    double *forces;
    /**
     * Array of shape 6 x 6 x [point_count], each column by column: derivatives of the force at a
     * point by displacements and turns of this point. NULL if tangents are not wanted, or were
     * said not to be given.
     */
    double *by_motion;
    /**
     * The same by velocities and angular velocities; NULL where by_motion is.
     */
    double *by_velocity;
} pdn_surface_values;

/**
 * Forces on shells or along beams, to be computed by the caller, such as of a fluid: for all
 * points of one element at once, each by the motion of this point alone.
 *
 * Called on the thread that solves; if two threads solve at once, on both at once. The same state
 * must give the same forces, and over time they must repeat with the period: solves call it first
 * a few times at one motion, at times in [0, 2 T), and refuse what does not with
 * PDN_ERR_NOT_PERIODIC. It must neither throw nor jump out, nor use the model it belongs to. It is
 * called many times at trial motions, which may be far from the solution.
 *
 * @param state  time and motions of the points; valid during the call only
 * @param values  where the forces go, all zero at first; valid during the call only
 * @param user_data  as given to ::pdn_model_add_surface_force or ::pdn_model_add_line_force
 * @return 0 for success; anything else makes the solve fail with PDN_ERR_CALLBACK (see
 *     ::pdn_set_callback_error and ::pdn_last_callback_code), as does a value that is not finite
 */
typedef int32_t (*pdn_surface_force_fn)(const struct pdn_surface_state *state,
                                        struct pdn_surface_values *values,
                                        void *user_data);

/**
 * Figures of a solve. Initialise with `PDN_INIT(pdn_diagnostics, &diagnostics)`.
 */
typedef struct pdn_diagnostics {
    /**
     * Set by the initialiser.
     */
    size_t struct_size;
    /**
     * Outcome, as ::pdn_solution_outcome.
     */
    int32_t outcome;
    /**
     * Newton iterations of the periodic problem.
     */
    int32_t iterations;
    /**
     * Newton iterations of the initial guess, each at a single instant.
     */
    int32_t guess_iterations;
    /**
     * Constraints that depend on others, and are tolerated: the reactions given are those of least
     * norm.
     */
    int32_t redundant_constraints;
    /**
     * Number of grid points; of a march the number of times kept.
     */
    size_t grid_points;
    /**
     * Number of unknowns of the periodic problem, or of a step.
     */
    size_t unknowns;
    /**
     * Largest increment of the last iteration, as ::pdn_progress.
     */
    double last_increment;
    /**
     * Estimated error of the motions at all times: lengths relative to the size of the mechanism,
     * angles in radians; infinite if it cannot be had. From the decay of their harmonics, the
     * violation of constraints between grid points and, if several grids were tried, the
     * difference between two of them. Velocities and forces have larger errors: see
     * force_residual_between.
     */
    double error_estimate;
    /**
     * Largest residual force between grid points, relative to the largest force that any
     * element exerts; infinite if the motion cannot be interpolated. Large values mean aliasing.
     */
    double force_residual_between;
    /**
     * Largest violation of a constraint between grid points: lengths relative to the size of
     * the mechanism, angles in radians; infinite if the motion cannot be interpolated.
     */
    double constraint_residual_between;
    /**
     * Seconds spent on the initial guess: quasi-static motions, marches, and what is carried from
     * grid to grid.
     */
    double guess_seconds;
    /**
     * Seconds spent on elements and assembly, on all grids and in all attempts, as all that
     * follows.
     */
    double assembly_seconds;
    /**
     * Seconds spent on symbolic analysis.
     */
    double analysis_seconds;
    /**
     * Seconds spent on numeric factorisation of whole Jacobians.
     */
    double factorisation_seconds;
    /**
     * Seconds spent on forward and backward substitution, or on iteration.
     */
    double substitution_seconds;
    /**
     * How the upper half of the harmonics of motions falls: PDN_DECAY_FAST, PDN_DECAY_SLOW, ...
     */
    int32_t decay;
    /**
     * Number of grids that an adaptive solve tried; 0 if their number of points was given.
     */
    int32_t grids;
    /**
     * Exponent p of that fall, if harmonic j is as j^-p: 2 where velocities jump, 3 where
     * accelerations do; of a smooth response ever larger with more grid points. 0 if it is not
     * known.
     */
    double decay_order;
    /**
     * Time at which the upper half of the harmonics adds up to most: where a kink or narrow peak
     * is.
     */
    double least_resolved_time;
    /**
     * How the linear equations of the last grid were solved: PDN_LINEAR_DIRECT,
     * PDN_LINEAR_BODY_CIRCULANT, ...
     */
    int32_t linear_solver;
    /**
     * Products with the Jacobian that iteration took, in all linear solves on that grid.
     */
    int32_t linear_iterations;
    /**
     * Linear solves by iteration on that grid.
     */
    int32_t linear_solves;
    /**
     * Largest number of products of one of them.
     */
    int32_t most_linear_iterations;
    /**
     * Bytes that iteration took at most; 0 if there was none.
     */
    size_t linear_bytes;
    /**
     * Seconds spent on preconditioners, without the system of joints that turn.
     */
    double preconditioner_seconds;
    /**
     * Seconds spent on that system.
     */
    double interface_seconds;
    /**
     * Seconds spent on error estimates, and on why a Jacobian is singular.
     */
    double estimate_seconds;
    /**
     * Seconds of the whole solve: all of these, and the little that is none of them.
     */
    double total_seconds;
    /**
     * Newton iterations on all grids and in all attempts, without those of the initial guess.
     */
    int32_t total_iterations;
    /**
     * Attempts, each from another start, as the report lists them; 0 where the start was given.
     */
    int32_t attempts;
    /**
     * Estimated error of the motions of nodes by the mesh of beams, measured as error_estimate,
     * which says nothing of the mesh: what elements of a higher degree would make of them. 0
     * without beams; infinite unless asked for, of a march, of modes, and where it cannot be had.
     */
    double mesh_error;
} pdn_diagnostics;

/**
 * What is asked of a solution: of a node, a joint, a beam, a shell, a force or a relation.
 * Initialise with
 * `PDN_INIT(pdn_quantity, &quantity)`; fields that its kind does not have stay as they are.
 */
typedef struct pdn_quantity {
    /**
     * Set by the initialiser.
     */
    size_t struct_size;
    /**
     * PDN_NODE_POSITION, ...; there is no default.
     */
    int32_t kind;
    /**
     * Id of the node, joint, beam element, shell element, force or relation that it is of.
     */
    int32_t object;
    /**
     * The component, from 0, or PDN_ALL_COMPONENTS, the default. Of coordinates and driving
     * efforts, the coordinate: PDN_DISPLACEMENT, ..., PDN_ROTATION_3; of relations which of their
     * coordinates, from 0.
     */
    int32_t component;
    /**
     * PDN_FRAME_SPACE, the default, or PDN_FRAME_MATERIAL; of reactions PDN_FRAME_SPACE,
     * PDN_FRAME_FIRST or PDN_FRAME_SECOND.
     */
    int32_t frame;
    /**
     * Of what a force exerts on one of its nodes, the node.
     */
    int32_t node;
    /**
     * Of viscoelastic elements, the branch, from 0; of controllers, which of the coordinates that
     * they act on, or which state, from 0.
     */
    int32_t branch;
    /**
     * Of beams, the place along the element, from -1 at its first to 1 at its last node; of
     * shells, xi, from -1 to 1.
     */
    double station;
    /**
     * Of shells, eta, from -1 to 1.
     */
    double station_eta;
    /**
     * Of shells, a direction in the reference configuration, global coordinates, whose part in the
     * surface is axis 1. If it is zero, the default, axes are those of the section. They move with
     * the shell.
     */
    double direction[3];
} pdn_quantity;

/**
 * How far a solve is, as told to a ::pdn_progress_fn.
 */
typedef struct pdn_progress {
    /**
     * Size of the struct in this library.
     */
    size_t struct_size;
    /**
     * PDN_STAGE_INITIAL_GUESS, PDN_STAGE_NEWTON, PDN_STAGE_MARCH, PDN_STAGE_MODES or
     * PDN_STAGE_STABILITY.
     */
    int32_t stage;
    /**
     * Number of the last iteration, from 1, or 0 before the first; starts again with each Newton
     * solve. In a march, number of the step.
     */
    int32_t iteration;
    /**
     * Largest residual before the step: forces relative to the characteristic force (the largest
     * stiffness times the size of the mechanism), lengths relative to its size, angles in radians.
     */
    double residual;
    /**
     * Largest increment of a motion: displacements relative to the size of the mechanism, turns in
     * radians.
     */
    double increment;
    /**
     * Fraction of the increment that was taken.
     */
    double step;
    /**
     * In a march the end of the step; otherwise 0.
     */
    double time;
    /**
     * Seconds since the solve began.
     */
    double elapsed;
    /**
     * Number of points of the grid that is worked on; 1 of an equilibrium or a march.
     */
    size_t grid_points;
    /**
     * Number of the attempt of a periodic solve, from 1, as the report lists them; 0 where the
     * start was given, and before the first, as on a coarse grid that is to give a start.
     */
    int32_t attempt;
    /**
     * What it starts from: PDN_START_QUASI_STATIC, ...; 0 where the start was given.
     */
    int32_t start;
    /**
     * 1 where an iteration, or a step of a march, has just ended; 0 while one lasts, or what comes
     * between them.
     */
    int32_t iterated;
    /**
     * Zero.
     */
    int32_t reserved;
} pdn_progress;

/**
 * Called after each Newton iteration, or after each step of a march, and while one lasts about ten
 * times a second, on the solving thread.
 *
 * `progress` is valid during the call only. It must not use the model that is being solved, nor
 * throw or jump out. Return 0 to go on, anything else to cancel: the outcome is PDN_CANCELLED.
 */
typedef int32_t (*pdn_progress_fn)(const struct pdn_progress *progress,
                                   void *user_data);

/**
 * Options of ::pdn_solve_periodic. Set the defaults by `PDN_INIT(pdn_periodic_options, &options)`.
 */
typedef struct pdn_periodic_options {
    /**
     * Set by the initialiser.
     */
    size_t struct_size;
    /**
     * Number N of grid points, odd, or a multiple of the number of like blades
     * (pdn_model_set_rotor_symmetry): harmonics below N / 2 are resolved. 0 for as many as
     * error_tolerance needs. Default 0.
     */
    size_t grid_points;
    /**
     * If not 0, the number of harmonics that are resolved: grid_points is then 2 harmonics + 1.
     * Default 0.
     */
    size_t harmonics;
    /**
     * Newton's method has converged when the largest increment (lengths relative to the size of
     * the mechanism, angles in radians) is below this. Newton is quadratic: the error left in
     * motions is about its square, that in forces about it times their last change. Default 1e-9.
     */
    double tolerance;
    /**
     * Most Newton iterations on a grid. Default 30.
     */
    size_t iteration_limit;
    /**
     * Start from this solution, periodic or static, also on another grid or of another period, or
     * from the last period of this march; NULL to start otherwise. Its model is to have the same
     * bodies, joints, forces and prescribed coordinates, and the same beams, which may have other
     * meshes. If grid_points is 0, the first grid is that of this solution. Default NULL.
     */
    const struct pdn_solution *initial;
    /**
     * Start from these positions, an array of shape 3 x [N] x [nodes]: coordinates fastest, then
     * grid points, then nodes; NULL to start otherwise. Needs guess_rotations, and grid_points or
     * harmonics. Default NULL.
     */
    const double *guess_positions;
    /**
     * Rotation matrices of the same start, an array of shape 9 x [N] x [nodes], each column by
     * column. Default NULL.
     */
    const double *guess_rotations;
    /**
     * Told of each iteration, and while one lasts, see progress_interval; may cancel. Default
     * NULL.
     */
    pdn_progress_fn progress;
    /**
     * Handed to progress.
     */
    void *progress_data;
    /**
     * If grid_points is 0, grid points are added until the estimated error of the motions is below
     * this: positions relative to the size of the mechanism, angles in radians. Default 1e-6,
     * which leaves about three digits to forces and accelerations, which are second derivatives.
     */
    double error_tolerance;
    /**
     * If grid_points is 0, the largest number of grid points, at least 3; if the tolerance would
     * need more, the outcome is PDN_TOLERANCE_NOT_MET. Default 511.
     */
    size_t largest_grid_points;
    /**
     * How linear equations are solved: PDN_LINEAR_AUTOMATIC, PDN_LINEAR_DIRECT, ... Default
     * PDN_LINEAR_AUTOMATIC.
     */
    int32_t linear_solver;
    /**
     * Threads that share the work, of a pool that lasts as long as the call; 0 for as many as
     * there are processors. Signals' and other functions of yours are called on the calling thread
     * alone. Default 1.
     */
    int32_t threads;
    /**
     * The equations are sampled at this many times as many points (or one more), from 1 to 16,
     * where motions and multipliers are interpolated; their virtual work, and the harmonics of the
     * constraints up to those of the grid, are to vanish. 1: at the grid points alone. Default 1.
     */
    size_t oversampling;
    /**
     * If grid_points is 0 and this is not, the estimated error of the motions is also to be below
     * this times the amplitude of the response: the largest deviation of a node from its mean or,
     * if it makes whole turns in a period, from a steady turn, in the measure of error_tolerance.
     * For responses that are small beside the mechanism. Default 0.
     */
    double response_tolerance;
    /**
     * Where the library starts, unless a start is given: PDN_START_AUTOMATIC, or one way alone:
     * PDN_START_QUASI_STATIC, ... PDN_START_STEADY_ROTATION and PDN_START_RIGID_ROTATION need a
     * drive that turns. Default PDN_START_AUTOMATIC.
     */
    int32_t start;
    /**
     * 1 to estimate the error by the mesh of beams, too, pdn_diagnostics.mesh_error, which takes
     * about as long as an iteration; not with oversampling. Default 0.
     */
    int32_t estimate_mesh;
    /**
     * Least time between two calls of progress while an iteration lasts, in seconds; 0 to be
     * called at any opportunity. Default 0.1.
     */
    double progress_interval;
    /**
     * Most work, counted in operations and not in time, of all starts and grids: this many times
     * that of an easy Newton iteration on the finest grid so far, by few products or by factors,
     * and a constant for small models. What takes more ends as PDN_WORK_LIMIT or, where a coarser
     * grid had a solution, with that as PDN_TOLERANCE_NOT_MET. Twice that on a given grid. 0 for
     * no bound. Default 17.
     */
    double work_limit;
    /**
     * Bytes of memory that the solve may take, by an estimate that is made before it is begun on a
     * grid: one that would take more is PDN_ERR_MEMORY, and its message tells the estimate. If
     * grid_points is 0, only the first grid is refused so; finer ones that would take more end the
     * solve as PDN_TOLERANCE_NOT_MET. 0 for no limit but that of the system. Default 0.
     */
    size_t memory_limit;
    /**
     * Where the points of grids are: PDN_TIME_MAP_AUTOMATIC, PDN_TIME_MAP_EQUISPACED or
     * PDN_TIME_MAP_EVENTS. By PDN_TIME_MAP_AUTOMATIC, a given number of points is equispaced, and
     * a solve to a tolerance that starts from a solution goes on with the map of that. Default
     * PDN_TIME_MAP_AUTOMATIC.
     */
    int32_t time_map;
    /**
     * Zero.
     */
    int32_t reserved;
    /**
     * Number of the events of PDN_TIME_MAP_EVENTS, at most 16. Default 0.
     */
    size_t event_count;
    /**
     * Times of the events, which repeat themselves every period: an array of length
     * [event_count]. Default NULL.
     */
    const double *event_times;
    /**
     * Times from there to where the additional density of grid points is half as large, about as
     * long as the events last, from 1e-5 to half the period: an array of length [event_count].
     * Default NULL.
     */
    const double *event_widths;
    /**
     * Grid points that are there for each, beside those spread equally over the period, which
     * count as 1; above 0, at most 100: an array of length [event_count]. Default NULL.
     */
    const double *event_shares;
} pdn_periodic_options;

/**
 * Sends numbers from each rank to each, as MPI_Alltoallv does. Called by all ranks.
 *
 * Arrays are valid during the call only; those of counts have one for each rank. What goes to rank
 * r stands in `send` behind what goes to those before it, and what comes from it likewise in
 * `receive`. Counts may be zero, and pointers NULL where all are. Return 0, or anything else where
 * numbers cannot be sent: that call fails with PDN_ERR_CALLBACK.
 */
typedef int32_t (*pdn_exchange_fn)(const double *send,
                                   const size_t *send_counts,
                                   double *receive,
                                   const size_t *receive_counts,
                                   void *user_data);

/**
 * Sends numbers from each rank to all, itself too, as MPI_Allgatherv does. Called by all ranks.
 *
 * Arrays are valid during the call only. What comes from rank r, of the length
 * `receive_counts[r]`, stands in `receive` behind what comes from those before it; `send` has
 * `send_count` numbers, which is what the others expect from this rank. Return 0, or anything else
 * where numbers cannot be sent: that call fails with PDN_ERR_CALLBACK.
 */
typedef int32_t (*pdn_gather_fn)(const double *send,
                                 size_t send_count,
                                 double *receive,
                                 const size_t *receive_counts,
                                 void *user_data);

/**
 * Options of ::pdn_equations_new. Set the defaults by `PDN_INIT(pdn_equations_options, &options)`.
 */
typedef struct pdn_equations_options {
    /**
     * Set by the initialiser.
     */
    size_t struct_size;
    /**
     * Number N of grid points, odd; to be set.
     */
    size_t grid_points;
    /**
     * Where to begin: a solution as for pdn_periodic_options.initial; NULL for the reference
     * configuration. Default NULL.
     */
    const struct pdn_solution *initial;
    /**
     * Rank of each node, an array of length [owner_count]; NULL for runs of nodes with about the
     * same work. Each rank must have a node. Default NULL.
     */
    const int32_t *owners;
    /**
     * Number of nodes, if there are owners.
     */
    size_t owner_count;
    /**
     * Number of this rank, from 0. Default 0.
     */
    int32_t rank;
    /**
     * How many ranks there are. Default 1.
     */
    int32_t ranks;
    /**
     * The preconditioner: PDN_LINEAR_TIME_LOCAL, PDN_LINEAR_BODY_CIRCULANT, PDN_LINEAR_CIRCULANT,
     * or PDN_LINEAR_AUTOMATIC for the first where joints turn in the initial motion, the second
     * otherwise. Default PDN_LINEAR_AUTOMATIC.
     */
    int32_t preconditioner;
    /**
     * Threads of this rank that share its work; 0 for as many as there are processors. Default 1.
     */
    int32_t threads;
    /**
     * Sends numbers from each rank to each; needed with more than one rank. Default NULL.
     */
    pdn_exchange_fn exchange;
    /**
     * Sends numbers from each rank to all; needed with more than one rank. Default NULL.
     */
    pdn_gather_fn gather;
    /**
     * Handed to exchange and gather.
     */
    void *ranks_data;
} pdn_equations_options;

/**
 * Sizes of the equations, and of the vectors of this rank.
 */
typedef struct pdn_equations_sizes {
    /**
     * Set by the initialiser.
     */
    size_t struct_size;
    /**
     * Numbers of a vector of this rank.
     */
    size_t size;
    /**
     * Numbers of other ranks that it keeps copies of.
     */
    size_t halo;
    /**
     * Numbers of the vectors of all ranks.
     */
    size_t total;
    /**
     * Nodes of this rank.
     */
    size_t nodes;
    /**
     * Numbers of its motions, 12 for each node and grid point.
     */
    size_t motions;
    /**
     * Own unknowns of its elements, multipliers and internal states, at all grid points.
     */
    size_t own_unknowns;
    /**
     * Bytes that tangents, factors and vectors take here.
     */
    size_t bytes;
    /**
     * The preconditioner: PDN_LINEAR_TIME_LOCAL, PDN_LINEAR_BODY_CIRCULANT or
     * PDN_LINEAR_CIRCULANT.
     */
    int32_t preconditioner;
    /**
     * Zero.
     */
    int32_t reserved;
} pdn_equations_sizes;

/**
 * A joint of a model. Initialise with `PDN_INIT(pdn_joint_info, &info)`.
 */
typedef struct pdn_joint_info {
    /**
     * Set by the initialiser.
     */
    size_t struct_size;
    /**
     * PDN_JOINT_RIGID ... PDN_JOINT_STRUT.
     */
    int32_t kind;
    /**
     * Id of the first node, or PDN_GROUND.
     */
    int32_t first;
    /**
     * Id of the second node, or PDN_GROUND.
     */
    int32_t second;
    /**
     * Zero.
     */
    int32_t reserved;
    /**
     * Advance of a screw for one turn; zero of other joints.
     */
    double pitch;
    /**
     * Origin of the first frame in the reference configuration, global coordinates.
     */
    double first_position[3];
    /**
     * Axes of the first frame there, a rotation matrix, column by column.
     */
    double first_rotation[9];
    /**
     * Origin of the second frame, likewise.
     */
    double second_position[3];
    /**
     * Axes of the second frame, likewise.
     */
    double second_rotation[9];
} pdn_joint_info;

/**
 * A force of a model. Initialise with `PDN_INIT(pdn_force_info, &info)`.
 */
typedef struct pdn_force_info {
    /**
     * Set by the initialiser.
     */
    size_t struct_size;
    /**
     * PDN_FORCE_IS_SPRING_DAMPER ... PDN_FORCE_IS_LINE_FORCE; of a controller
     * ::pdn_model_controller_counts tells more.
     */
    int32_t kind;
    /**
     * Id of the joint on whose coordinate it acts, or -1.
     */
    int32_t joint;
    /**
     * The coordinate: PDN_DISPLACEMENT, ...; -1 if it acts on none.
     */
    int32_t coordinate;
    /**
     * Of what is between two bodies, id of the first node, or PDN_GROUND.
     */
    int32_t first;
    /**
     * Id of the second node, or PDN_GROUND.
     */
    int32_t second;
    /**
     * Of a bushing, PDN_ANGLES_ROTATION_VECTOR or PDN_ANGLES_TILT_AND_SPIN; else zero.
     */
    int32_t angles;
    /**
     * How many numbers PDN_NUMBER_STIFFNESS it has, for ::pdn_model_force_number.
     */
    int32_t stiffness_count;
    /**
     * The same of PDN_NUMBER_DAMPING.
     */
    int32_t damping_count;
    /**
     * The same of PDN_NUMBER_RELAXATION_TIME: branches of a viscoelastic element.
     */
    int32_t branch_count;
    /**
     * Nodes of forces of the user, for ::pdn_model_force_node.
     */
    int32_t node_count;
    /**
     * Coordinate at which springs are free of effort.
     */
    double rest;
    /**
     * Of what is between two bodies, origin of the first frame in the reference configuration,
     * global coordinates.
     */
    double first_position[3];
    /**
     * Axes of the first frame there, a rotation matrix, column by column.
     */
    double first_rotation[9];
    /**
     * Origin of the second frame, likewise.
     */
    double second_position[3];
    /**
     * Axes of the second frame, likewise.
     */
    double second_rotation[9];
    /**
     * Of forces of the user on a shell, id of the element; else -1.
     */
    int32_t shell_element;
    /**
     * Where on it: PDN_SHELL_SURFACE or an edge; else -1.
     */
    int32_t shell_place;
    /**
     * Of forces of the user along a beam, id of the element; else -1.
     */
    int32_t beam_element;
    /**
     * Of forces of the user on nodes, 1 if these were declared apart; else 0.
     */
    int32_t nodes_apart;
    /**
     * Of forces of the user along a beam with PDN_FRAME_UNTWISTED, the direction axis_2; else
     * zero.
     */
    double axis_2[3];
} pdn_force_info;

/**
 * Options of ::pdn_solution_sensitivities. Set the defaults by `PDN_INIT(pdn_sensitivity_options,
 * &options)`.
 */
typedef struct pdn_sensitivity_options {
    /**
     * Set by the initialiser.
     */
    size_t struct_size;
    /**
     * PDN_SENSITIVITY_AUTOMATIC, the default, PDN_SENSITIVITY_DIRECT or PDN_SENSITIVITY_ADJOINT.
     */
    int32_t method;
    /**
     * How linear equations are solved: PDN_LINEAR_AUTOMATIC, ... Default PDN_LINEAR_AUTOMATIC.
     */
    int32_t linear_solver;
    /**
     * Threads that share the work; 0 for as many as there are processors. Default 1.
     */
    int32_t threads;
    /**
     * Zero.
     */
    int32_t reserved;
} pdn_sensitivity_options;

/**
 * A point of a branch. Initialise with `PDN_INIT(pdn_branch_point, &point)`.
 */
typedef struct pdn_branch_point {
    /**
     * Set by the initialiser.
     */
    size_t struct_size;
    /**
     * Value of the parameter that is followed.
     */
    double parameter;
    /**
     * Its derivative by the length along the branch, over its range: zero at a fold.
     */
    double slope;
    /**
     * Period of the motion.
     */
    double period;
    /**
     * Length of the step from the point before.
     */
    double step;
    /**
     * Angle between the branch here and at the point before \[radians\].
     */
    double angle;
    /**
     * Number of grid points.
     */
    size_t grid_points;
    /**
     * Number of Newton iterations.
     */
    int32_t iterations;
    /**
     * PDN_EVENT_NONE, PDN_EVENT_FOLD, ...
     */
    int32_t event;
    /**
     * At a torus point, the angular frequency of the motions that begin there; else zero.
     */
    double second_frequency;
    /**
     * Size of the largest multiplier; zero if multipliers were not wanted.
     */
    double largest_multiplier;
    /**
     * Number of multipliers outside the unit circle; zero also if they were not wanted.
     */
    int32_t multipliers_outside;
    /**
     * PDN_STABLE, PDN_UNSTABLE or PDN_STABILITY_NOT_KNOWN, also if multipliers were not wanted.
     */
    int32_t stability;
} pdn_branch_point;

/**
 * Called with each point of a branch, on the thread that follows it; `number` counts from 1.
 *
 * `point` is valid during the call only. Return 0 to go on, anything else to end the branch there.
 */
typedef int32_t (*pdn_branch_fn)(const struct pdn_branch_point *point,
                                 int32_t number,
                                 void *user_data);

/**
 * Options of ::pdn_follow_branch. Set the defaults by `PDN_INIT(pdn_branch_options, &options)`.
 */
typedef struct pdn_branch_options {
    /**
     * Set by the initialiser.
     */
    size_t struct_size;
    /**
     * Grid, tolerance and linear solver, where the first solve starts, and who is told of the
     * iterations; NULL for the defaults. Grids are equispaced. Default NULL.
     */
    const struct pdn_periodic_options *periodic;
    /**
     * What else is free along the branch, and as many conditions; NULL for nothing. Default NULL.
     */
    const struct pdn_conditions *conditions;
    /**
     * Least value of the parameter, where the branch ends.
     */
    double from;
    /**
     * Largest value of the parameter, where the branch ends; more than `from`.
     */
    double to;
    /**
     * What counts as 1 in motions, relative to the size of the mechanism and in radians; as the
     * whole range does in the parameter. Default 1.
     */
    double motion_scale;
    /**
     * Length of the first step: 1 is the whole range, or a motion of motion_scale. Default 0.02.
     */
    double first_step;
    /**
     * Shortest step. Default 1e-6.
     */
    double smallest_step;
    /**
     * Longest step. Default 1.
     */
    double largest_step;
    /**
     * Angle between the branch at neighbouring points that steps aim at \[radians\]; steps by four
     * thirds of it are taken again by half. Default 0.3.
     */
    double angle;
    /**
     * Most points. Default 1000.
     */
    size_t point_limit;
    /**
     * Told of each point; may end the branch. Default NULL.
     */
    pdn_branch_fn progress;
    /**
     * Handed to progress.
     */
    void *progress_data;
    /**
     * 1 if the parameter decreases at first. Default 0.
     */
    int32_t downwards;
    /**
     * 1 to look for branch points (where there are no conditions) and period doublings, too, by
     * two more factorisations of the whole Jacobian a point. Default 0.
     */
    int32_t events;
    /**
     * 1 to find the multipliers of each point, and with them torus points. Default 0.
     */
    int32_t stability;
    /**
     * Leave it zero.
     */
    int32_t reserved;
} pdn_branch_options;

/**
 * Options of ::pdn_solve_stability. Set the defaults by `PDN_INIT(pdn_stability_options,
 * &options)`.
 */
typedef struct pdn_stability_options {
    /**
     * Set by the initialiser.
     */
    size_t struct_size;
    /**
     * Modes of up to this angular frequency matter \[angle/time\]; 0 for 20 times that of the
     * period. Default 0.
     */
    double highest_frequency;
    /**
     * Estimated error of the multipliers of these modes, in units of 1 or of the multiplier where
     * that is more. Default 1e-8.
     */
    double tolerance;
    /**
     * Told about ten times a second that work goes on; may cancel. Default NULL.
     */
    pdn_progress_fn progress;
    /**
     * Handed to progress.
     */
    void *progress_data;
} pdn_stability_options;

/**
 * Options of ::pdn_solve_static. Set the defaults by `PDN_INIT(pdn_static_options, &options)`.
 */
typedef struct pdn_static_options {
    /**
     * Set by the initialiser.
     */
    size_t struct_size;
    /**
     * Loads and prescribed motions have their values at this time. Default 0.
     */
    double time;
    /**
     * Period that harmonics and samples of signals refer to; 0 if not given, as at time 0, where
     * it does not matter. Default 0.
     */
    double period;
    /**
     * Load steps taken at least, from the unloaded reference configuration; a step that does not
     * converge is halved. More than one keeps to the branch that grows from the reference
     * configuration, where there are several. Not used with an initial solution. Default 1.
     */
    size_t load_steps;
    /**
     * As in ::pdn_periodic_options. Default 1e-9.
     */
    double tolerance;
    /**
     * Most Newton iterations at the full loads. Default 30.
     */
    size_t iteration_limit;
    /**
     * Angular velocity of the frame that everything turns with steadily, the ground too, inertial
     * frame \[angle/time\]. Default 0.
     */
    double angular_velocity[3];
    /**
     * A point of the axis it turns about \[length\]. Default 0.
     */
    double axis_point[3];
    /**
     * Start from this solution, at `time`, of a model with the same nodes and joints; NULL to
     * start from the reference configuration. Default NULL.
     */
    const struct pdn_solution *initial;
    /**
     * Told of each iteration, and about ten times a second while one lasts; may cancel. Default
     * NULL.
     */
    pdn_progress_fn progress;
    /**
     * Handed to progress.
     */
    void *progress_data;
    /**
     * Bytes of memory that the solve may take, by an estimate that is made before it begins, with
     * the modes of ::pdn_solve_modes: what would take more is PDN_ERR_MEMORY, and the message
     * tells the estimate. 0 for no limit but that of the system. Default 0.
     */
    size_t memory_limit;
} pdn_static_options;

/**
 * Options of ::pdn_solve_modes. Set the defaults by `PDN_INIT(pdn_modes_options, &options)`.
 */
typedef struct pdn_modes_options {
    /**
     * Set by the initialiser.
     */
    size_t struct_size;
    /**
     * The equilibrium, at rest or in steady rotation, how to find it, and who is told of the
     * iterations; NULL for the defaults of ::pdn_static_options. Default NULL.
     */
    const struct pdn_static_options *equilibrium;
    /**
     * Number of modes wanted. Default 10.
     */
    size_t count;
    /**
     * Angular frequency near which modes are wanted \[angle/time\]; 0 for those of the smallest
     * eigenvalues. Default 0.
     */
    double near_frequency;
} pdn_modes_options;

/**
 * A small motion `Re(x exp(s t))`. Initialise with `PDN_INIT(pdn_mode, &mode)`.
 */
typedef struct pdn_mode {
    /**
     * Set by the initialiser.
     */
    size_t struct_size;
    /**
     * Real part of the eigenvalue s \[1/time\]; negative if the motion decays.
     */
    double eigenvalue_real;
    /**
     * Imaginary part of s \[angle/time\], not negative.
     */
    double eigenvalue_imaginary;
    /**
     * Oscillations per unit of time, Im s / 2π.
     */
    double frequency;
    /**
     * Damping ratio, -Re s / |s|; 0 for a free motion.
     */
    double damping_ratio;
    /**
     * Product of the shape with M and its own conjugate, with the shape as ::pdn_modes_shape gives
     * it.
     */
    double modal_mass;
    /**
     * Largest entry of the equations of small motions, relative to the largest sum of the sizes of
     * their terms: rounding, if all is well.
     */
    double residual;
} pdn_mode;

/**
 * Options of ::pdn_solve_march. Set the defaults by `PDN_INIT(pdn_march_options, &options)`.
 *
 * There is no default of how long to march and in which steps: set duration or periodic_tolerance,
 * and step or steps_per_period.
 */
typedef struct pdn_march_options {
    /**
     * Set by the initialiser.
     */
    size_t struct_size;
    /**
     * When the march starts. Default 0.
     */
    double start_time;
    /**
     * How long it is; leave it 0 to march until periodic. Default 0.
     */
    double duration;
    /**
     * Period T that harmonics and samples of signals refer to, and that the motion may repeat
     * itself with; 0 if neither matters. Steps must not be longer, unless error_tolerance chooses
     * them. Default 0.
     */
    double period;
    /**
     * Length of the steps, made shorter by what lets a whole number of them fit the duration or
     * the period. With error_tolerance the length of the first. Default 0.
     */
    double step;
    /**
     * If not 0, the steps are period / steps_per_period. Default 0.
     */
    size_t steps_per_period;
    /**
     * Spectral radius at infinite frequency, from 0 to 1: the numerical damping. With 1 no energy
     * is lost, but the reactions of joints oscillate; 0 removes at once what the steps do not
     * resolve. Default 0.5.
     */
    double spectral_radius;
    /**
     * If not 0, steps are chosen so that each has at most this estimated error of a motion
     * (lengths relative to the size of the mechanism, angles in radians). Default 0.
     */
    double error_tolerance;
    /**
     * If not 0, march until motions and velocities differ by at most this from the periodic ones,
     * by how the differences from each period to the next decay: displacements relative to the
     * size of the mechanism, entries of rotation matrices, velocities likewise in the time T / (2
     * pi). Default 0.
     */
    double periodic_tolerance;
    /**
     * Most periods of a march until periodic; then its outcome is PDN_ITERATION_LIMIT. Default
     * 200.
     */
    size_t most_periods;
    /**
     * Keep the steps of only so many of the last periods; all steps if 0. Default 0.
     */
    size_t stored_periods;
    /**
     * Newton's method in a step has converged when the largest increment is below this, as in
     * ::pdn_periodic_options. Default 1e-9.
     */
    double tolerance;
    /**
     * Most Newton iterations in a step. Default 20.
     */
    size_t iteration_limit;
    /**
     * Start from this solution of a model with the same nodes and joints, at start_time: an
     * equilibrium, a periodic motion or another march; NULL to start otherwise. Default NULL.
     */
    const struct pdn_solution *initial;
    /**
     * Start from these positions, an array of shape 3 x [nodes]; NULL for those of the reference
     * configuration. Needs rotations. Default NULL.
     */
    const double *positions;
    /**
     * Rotation matrices of the same start, an array of shape 9 x [nodes], each column by column.
     * Default NULL.
     */
    const double *rotations;
    /**
     * Velocities of the same start, an array of shape 6 x [nodes]: velocity of each node and its
     * angular velocity, inertial frame; NULL for none. Default NULL.
     */
    const double *velocities;
    /**
     * Told of each step, and about ten times a second while one lasts; may cancel. Default NULL.
     */
    pdn_progress_fn progress;
    /**
     * Handed to progress.
     */
    void *progress_data;
    /**
     * Bytes of memory that the steps which are kept may take, by an estimate. A march whose
     * number of steps is known, and takes more, is PDN_ERR_MEMORY before it begins; another that
     * comes to take more ends there as PDN_WORK_LIMIT, with what was marched. 0 for no limit but
     * that of the system. Default 0.
     */
    size_t memory_limit;
} pdn_march_options;

/**
 * Figures of a march. Initialise with `PDN_INIT(pdn_march_diagnostics, &diagnostics)`.
 */
typedef struct pdn_march_diagnostics {
    /**
     * Set by the initialiser.
     */
    size_t struct_size;
    /**
     * Steps taken.
     */
    size_t steps;
    /**
     * Steps that were given up for shorter ones.
     */
    size_t rejected_steps;
    /**
     * Newton iterations over all steps.
     */
    size_t iterations;
    /**
     * Whole periods marched.
     */
    size_t periods;
    /**
     * First time of the trajectory: the start, or the oldest step that was kept.
     */
    double first_time;
    /**
     * Last time of the trajectory.
     */
    double last_time;
    /**
     * How much the last period differs from the one before, as
     * pdn_march_options.periodic_tolerance; infinite before the end of the first period.
     */
    double repetition;
    /**
     * Largest estimated error of a motion in one step, as pdn_march_options.error_tolerance.
     */
    double step_error;
    /**
     * How much motions were moved at the start to satisfy constraints and prescribed motions:
     * lengths relative to the size of the mechanism, entries of rotation matrices.
     */
    double start_moved;
    /**
     * How much velocities were changed at the start: lengths relative to the size of the
     * mechanism, or radians, in the unit of time.
     */
    double start_corrected;
} pdn_march_diagnostics;

/**
 * Options of ::pdn_solve_shooting. Set the defaults by `PDN_INIT(pdn_shooting_options, &options)`.
 */
typedef struct pdn_shooting_options {
    /**
     * Set by the initialiser.
     */
    size_t struct_size;
    /**
     * Number of equal steps to the period. Default 200.
     */
    size_t steps_per_period;
    /**
     * Periods marched for the first guess. Default 1.
     */
    size_t guess_periods;
    /**
     * Spectral radius at infinite frequency, from 0 to less than 1, as in ::pdn_march_options.
     * Default 0.5.
     */
    double spectral_radius;
    /**
     * Converged when the largest increment of a motion or velocity at the start (lengths relative
     * to the size of the mechanism, angles in radians, velocities in the time T / (2 pi)) is below
     * this. Default 1e-8.
     */
    double tolerance;
    /**
     * Most Newton iterations. Default 30.
     */
    size_t iteration_limit;
    /**
     * Start the march from this solution of a model with the same nodes and joints, at its time 0
     * or, of a march, at its first time; NULL for the reference configuration at rest. Default
     * NULL.
     */
    const struct pdn_solution *initial;
    /**
     * Told of each period of the guess and of each iteration, and about ten times a second while
     * one lasts; may cancel. Default NULL.
     */
    pdn_progress_fn progress;
    /**
     * Handed to progress.
     */
    void *progress_data;
    /**
     * Bytes of memory that the solve may take, by an estimate that is made before it begins: what
     * would take more is PDN_ERR_MEMORY, and the message tells the estimate. 0 for no limit but
     * that of the system. Default 0.
     */
    size_t memory_limit;
} pdn_shooting_options;

/**
 * A disturbance `exp(mu t) phi(t)` of a periodic solution, where phi has its period. Initialise
 * with `PDN_INIT(pdn_multiplier, &multiplier)`.
 */
typedef struct pdn_multiplier {
    /**
     * Set by the initialiser.
     */
    size_t struct_size;
    /**
     * Real part of the multiplier rho = exp(mu T).
     */
    double real;
    /**
     * Imaginary part of rho.
     */
    double imaginary;
    /**
     * Real part of the exponent mu \[1/time\]; negative if the disturbance dies away.
     */
    double exponent_real;
    /**
     * Imaginary part of mu \[angle/time\]: of the many that give rho that nearest to the frequency
     * of the mode.
     */
    double exponent_imaginary;
    /**
     * Angular frequency of the mode over the period, in the nodes' own axes.
     */
    double frequency;
    /**
     * Estimated error of rho, for this periodic solution.
     */
    double error;
    /**
     * 1 if rho is 1 because the disturbance only moves the solution in time, or all of the
     * mechanism in space; else 0.
     */
    int32_t trivial;
    /**
     * Zero.
     */
    int32_t reserved;
} pdn_multiplier;

/**
 * Counts, mass and mobility of a model. Initialise with `PDN_INIT(pdn_summary, &summary)`.
 */
typedef struct pdn_summary {
    /**
     * Set by the initialiser.
     */
    size_t struct_size;
    /**
     * Number of nodes.
     */
    int32_t nodes;
    /**
     * Number of beam elements.
     */
    int32_t beam_elements;
    /**
     * Number of joints.
     */
    int32_t joints;
    /**
     * Number of prescribed joint coordinates.
     */
    int32_t prescribed;
    /**
     * Number of constraints: those of the joints, and one for each prescribed coordinate and each
     * relation between coordinates.
     */
    int32_t constraints;
    /**
     * Number of these that depend on others in the reference configuration.
     */
    int32_t redundant_constraints;
    /**
     * Degrees of freedom: six for each node, less the independent constraints.
     */
    int32_t degrees_of_freedom;
    /**
     * Number of members: bodies, and connected beams, each taken as one rigid body.
     */
    int32_t members;
    /**
     * Degrees of freedom that were left if all members were rigid: 0 is a structure, or a
     * mechanism whose motion is prescribed; 6 more for each free body.
     */
    int32_t mobility;
    /**
     * Constraints that would depend on others if all members were rigid.
     */
    int32_t redundant_if_rigid;
    /**
     * Number of parts that nothing connects to each other, neither directly nor through the
     * ground.
     */
    int32_t parts;
    /**
     * Number of warnings, which ::pdn_model_describe writes out.
     */
    int32_t warnings;
    /**
     * Total mass.
     */
    double mass;
    /**
     * Centre of mass, in global coordinates; zero if there is no mass.
     */
    double centre[3];
} pdn_summary;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

/**
 * Version of the library, such as "0.1.0".
 *
 * @return static string, never NULL
 *
 * Threads: any.
 * @since 0.1
 */
PDN_API
const char *pdn_version(void);

/**
 * Whether the library serves a program compiled with the header of version major.minor.
 *
 * Before 1.0 both numbers must be equal; from 1.0 on, a later minor version serves as well. Call
 * it as `pdn_version_check(PDN_VERSION_MAJOR, PDN_VERSION_MINOR)`.
 *
 * @param major  PDN_VERSION_MAJOR of the header
 * @param minor  PDN_VERSION_MINOR of the header
 * @return PDN_OK, PDN_ERR_VALUE
 *
 * Threads: any.
 * @since 0.1
 */
PDN_API
pdn_status pdn_version_check(int32_t major,
                             int32_t minor);

/**
 * How the library was built: version, profile and platform, for reports of defects.
 *
 * @return static string, never NULL
 *
 * Threads: any.
 * @since 0.1
 */
PDN_API
const char *pdn_build_info(void);

/**
 * Name of a status, such as "PDN_ERR_NULL".
 *
 * @param status  any number
 * @return static string, never NULL; "PDN_ERR_UNKNOWN" for a number that is no status
 *
 * Threads: any.
 * @since 0.1
 */
PDN_API
const char *pdn_status_name(pdn_status status);

/**
 * One-line meaning of a status. What went wrong in a given call is told by ::pdn_last_error.
 *
 * @param status  any number
 * @return static string, never NULL; "unknown status" for a number that is no status
 *
 * Threads: any.
 * @since 0.1
 */
PDN_API
const char *pdn_status_message(pdn_status status);

/**
 * Message of the last call that failed on this thread: which argument, what was expected, what
 * came.
 *
 * Copies as much as fits, always ended by NUL; calls that succeed leave the message as it is.
 *
 * @param buffer  array of length [capacity] for the text, UTF-8; may be NULL if capacity is 0
 * @param capacity  size of buffer in bytes
 * @return length of the whole message without the NUL, as snprintf does; 0 if no call has failed
 *
 * Threads: any; each thread has its own message.
 * @since 0.1
 */
PDN_API
size_t pdn_last_error(char *buffer,
                      size_t capacity);

/**
 * Sets the message that ::pdn_last_error gives on this thread: for libraries on top of this one,
 * whose own functions fail.
 *
 * @param message  text in UTF-8, ended by NUL, copied; not NULL
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_VALUE (no UTF-8)
 *
 * Threads: any; each thread has its own message.
 * @since 0.1
 */
PDN_API
pdn_status pdn_set_last_error(const char *message);

/**
 * To be called by a callback that is about to report failure: says why.
 *
 * The text becomes a part of the message of the call that fails with PDN_ERR_CALLBACK.
 *
 * @param message  text in UTF-8, ended by NUL, copied; not NULL
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_VALUE
 *
 * Threads: any; holds for the callback running on the calling thread.
 * @since 0.1
 */
PDN_API
pdn_status pdn_set_callback_error(const char *message);

/**
 * What the last failing callback on this thread returned.
 *
 * @return the callback's own nonzero number; 0 if none has failed
 *
 * Threads: any; each thread has its own number.
 * @since 0.1
 */
PDN_API
int32_t pdn_last_callback_code(void);

/**
 * Chooses whether internal errors are also printed to stderr. They are, unless this is called.
 *
 * An internal error (PDN_ERR_PANIC) is a defect of the library; the printed text says where it is.
 * Holds for the whole process.
 *
 * @param enabled  1: they are printed; 0: they are not
 *
 * Threads: any.
 * @since 0.1
 */
PDN_API
void pdn_set_panic_printing(int32_t enabled);

/**
 * Gives the system back the memory that the library keeps for later solves.
 *
 * Up to 512 MiB of large lists are kept for others when a solve ends or a handle is freed, as the
 * system takes time to give them. Solves under way and handles keep all that they have.
 *
 * @return PDN_OK
 *
 * Threads: any.
 * @since 0.1
 */
PDN_API
pdn_status pdn_release_memory(void);

/**
 * Makes a section with no stiffness, mass or damping. Use it as `PDN_INIT(pdn_section, &section)`.
 *
 * @param section  the section; not NULL
 * @param struct_size  sizeof(pdn_section)
 *
 * Threads: any.
 * @since 0.1
 */
PDN_API
void pdn_section_init(struct pdn_section *section,
                      size_t struct_size);

/**
 * Describes a section without couplings: centroid, shear centre and centre of mass lie on the
 * beam's line, and axes 2 and 3 are principal.
 *
 * Sets stiffness and mass, and takes the damping away: give that afterwards.
 *
 * @param section  an initialised section; not NULL
 * @param stiffness  array of length 6, all positive: axial EA, shear 2, shear 3 [force], torsion,
 *     bending about axis 2, bending about axis 3 [force * length^2]
 * @param mass  array of length 4, none negative: mass [mass / length], and moments of inertia m11
 *     (about the beam's axis), m22, m33 [mass * length], all per unit of length
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE, PDN_ERR_NOT_FINITE, PDN_ERR_VALUE
 *
 * Threads: exclusive use of `section`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_section_set_diagonal(struct pdn_section *section,
                                    const double *stiffness,
                                    const double *mass);

/**
 * Gives a section damping with one time for each force and moment: damping = diag(seconds) *
 * stiffness, which must have been set.
 *
 * For coupled sections that is no symmetric matrix. It is taken if no motion gains energy by it:
 * if its symmetric part is positive semi-definite.
 *
 * @param section  an initialised section with stiffness; not NULL
 * @param seconds  array of length 6: times of axial force, shear 2, shear 3, torsion, bending 2,
 *     bending 3; none negative [time]
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE, PDN_ERR_NOT_FINITE, PDN_ERR_VALUE
 *
 * Threads: exclusive use of `section`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_section_set_component_damping(struct pdn_section *section,
                                             const double *seconds);

/**
 * Gives a section damping in proportion to its stiffness, which must have been set.
 *
 * A vibration of circular frequency w then has the damping ratio seconds * w / 2.
 *
 * @param section  an initialised section with stiffness; not NULL
 * @param seconds  damping = seconds * stiffness; zero or more [time]
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE, PDN_ERR_NOT_FINITE, PDN_ERR_VALUE
 *
 * Threads: exclusive use of `section`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_section_set_proportional_damping(struct pdn_section *section,
                                                double seconds);

/**
 * Makes a signal that is zero. Use it as `PDN_INIT(pdn_signal, &signal)`.
 *
 * @param signal  the signal; not NULL
 * @param struct_size  sizeof(pdn_signal)
 *
 * Threads: any.
 * @since 0.1
 */
PDN_API
void pdn_signal_init(struct pdn_signal *signal,
                     size_t struct_size);

/**
 * Makes a signal constant.
 *
 * @param signal  an initialised signal; not NULL
 * @param value  its value, in the unit of what it drives
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE, PDN_ERR_NOT_FINITE
 *
 * Threads: exclusive use of `signal`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_signal_set_constant(struct pdn_signal *signal,
                                   double value);

/**
 * Makes a signal of harmonics, mean and rate.
 *
 * Its value is mean + rate t + the sum over j = 1 ... count of cosines[j-1] cos(j w t) +
 * sines[j-1] sin(j w t), with w = 2 pi / T and the period T that is given to the solve. What
 * drives a rotation may have a rate if it grows by whole turns in a period (rate * T a multiple of
 * 2 pi); all else must have rate zero.
 *
 * @param signal  an initialised signal; not NULL
 * @param mean  mean, in the unit of what the signal drives; usually 0
 * @param rate  growth for a unit of time; usually 0
 * @param cosines  array of length [count]; may be NULL if count is 0. Read by the call that takes
 *     the signal: must be there until then
 * @param sines  array of length [count]; may be NULL if count is 0. Read by the call that takes
 *     the signal: must be there until then
 * @param count  number of harmonics
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE, PDN_ERR_SIZE, PDN_ERR_NOT_FINITE
 *
 * Threads: exclusive use of `signal`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_signal_set_harmonics(struct pdn_signal *signal,
                                    double mean,
                                    double rate,
                                    const double *cosines,
                                    const double *sines,
                                    size_t count);

/**
 * Makes a signal rate t plus the trigonometric interpolation of samples[k] at t = k T / count.
 *
 * The samples are equally spaced over one period T of the solve, the end of which is not repeated.
 *
 * @param signal  an initialised signal; not NULL
 * @param rate  growth for a unit of time, as in ::pdn_signal_set_harmonics; usually 0
 * @param samples  array of length [count], without the growth, in the unit of what the signal
 *     drives; not NULL. Read by the call that takes the signal: must be there until then
 * @param count  number of samples, at least 1, odd or even
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE, PDN_ERR_SIZE, PDN_ERR_NOT_FINITE
 *
 * Threads: exclusive use of `signal`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_signal_set_samples(struct pdn_signal *signal,
                                  double rate,
                                  const double *samples,
                                  size_t count);

/**
 * Makes a signal a function of the caller.
 *
 * Over a period it may grow by whole turns if it drives a rotation, and must not grow otherwise.
 *
 * @param signal  an initialised signal; not NULL
 * @param function  the function, see ::pdn_signal_fn for when it is called; not NULL
 * @param user_data  handed to the function; may be NULL. Must be valid until each model that was
 *     given the signal, and each solution of it, has been freed
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE
 *
 * Threads: exclusive use of `signal`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_signal_set_function(struct pdn_signal *signal,
                                   pdn_signal_fn function,
                                   void *user_data);

/**
 * Makes a signal a function of the caller, of the phase 2 pi t / T \[radians\], which it is told
 * in place of the time: it holds for any period T.
 *
 * Over a period it may grow by whole turns if it drives a rotation, and must not grow otherwise.
 *
 * @param signal  an initialised signal; not NULL
 * @param function  the function, see ::pdn_signal_fn for when it is called; not NULL
 * @param user_data  handed to the function; may be NULL. Must be valid until each model that was
 *     given the signal, and each solution of it, has been freed
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE
 *
 * Threads: exclusive use of `signal`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_signal_set_function_of_phase(struct pdn_signal *signal,
                                            pdn_signal_fn function,
                                            void *user_data);

/**
 * Makes an empty model.
 *
 * @param model  the model, to be freed by ::pdn_model_free; written on success only
 * @return PDN_OK, PDN_ERR_NULL
 *
 * Threads: any.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_new(struct pdn_model **model);

/**
 * Frees a model. Solutions made of it stay valid.
 *
 * @param model  the model; NULL does nothing
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
void pdn_model_free(struct pdn_model *model);

/**
 * Number of nodes; their ids follow each other from PDN_FIRST_NODE on.
 *
 * @param model  the model; not NULL
 * @param count  the number; written on success only
 * @return PDN_OK, PDN_ERR_NULL
 *
 * Threads: `model` is `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_node_count(const struct pdn_model *model,
                                int32_t *count);

/**
 * Number of joints; their ids follow each other from PDN_FIRST_JOINT on.
 *
 * @param model  the model; not NULL
 * @param count  the number; written on success only
 * @return PDN_OK, PDN_ERR_NULL
 *
 * Threads: `model` is `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_joint_count(const struct pdn_model *model,
                                 int32_t *count);

/**
 * Number of beam elements; their ids follow each other from PDN_FIRST_BEAM_ELEMENT on.
 *
 * @param model  the model; not NULL
 * @param count  the number; written on success only
 * @return PDN_OK, PDN_ERR_NULL
 *
 * Threads: `model` is `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_element_count(const struct pdn_model *model,
                                   int32_t *count);

/**
 * Total mass and centre of mass in the reference configuration.
 *
 * @param model  the model; not NULL
 * @param mass  total mass of bodies, masses and beams [mass]; written on success only
 * @param centre  array of length 3: centre of mass, global coordinates [length]; may be NULL if it
 *     is not wanted; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_AVAILABLE (a centre is wanted, and the mass is zero),
 *     PDN_ERR_OVERFLOW
 *
 * Threads: `model` is `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_mass(const struct pdn_model *model,
                          double *mass,
                          double *centre);

/**
 * Frame of a node in the reference configuration.
 *
 * @param model  the model; not NULL
 * @param node  id of the node
 * @param frame  its frame; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID
 *
 * Threads: `model` is `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_node_frame(const struct pdn_model *model,
                                int32_t node,
                                struct pdn_frame *frame);

/**
 * Adds a node: a frame that moves.
 *
 * A node needs something that holds or moves it: mass, a beam or a joint.
 *
 * @param model  the model; not NULL
 * @param position  array of length 3: its position, global coordinates [length]
 * @param rotation  array of shape 3 x 3: its axes, a rotation matrix column by column, the
 *     columns being axes 1, 2, 3 in global coordinates; NULL for axes parallel to the global
 *     ones
 * @param node  the node's id; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_VALUE
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_add_node(struct pdn_model *model,
                              const double *position,
                              const double *rotation,
                              int32_t *node);

/**
 * Adds a rigid body: a node at its centre of mass, with axes parallel to the global ones.
 *
 * Its inertia has an id, ::pdn_model_inertia_of, by which a parameter can move it.
 *
 * @param model  the model; not NULL
 * @param mass  mass, positive [mass]
 * @param centre  array of length 3: centre of mass, global coordinates [length]
 * @param inertia  array of shape 3 x 3: moments of inertia about the centre of mass, in global
 *     axes, symmetric and positive semi-definite [mass * length^2]
 * @param node  the node's id; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_VALUE
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_add_rigid_body(struct pdn_model *model,
                                    double mass,
                                    const double *centre,
                                    const double *inertia,
                                    int32_t *node);

/**
 * Fixes a mass to a node, in addition to what the node has.
 *
 * @param model  the model; not NULL
 * @param node  id of the node
 * @param mass  mass, zero or more [mass]
 * @param centre  array of length 3: its centre, global coordinates; need not be at the node
 *     [length]
 * @param inertia  array of shape 3 x 3: moments of inertia about the centre, in global axes,
 *     symmetric and positive semi-definite [mass * length^2]; NULL for a point mass
 * @param id  id of the inertia; may be NULL if it is not wanted; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_ID, PDN_ERR_VALUE
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_add_mass(struct pdn_model *model,
                              int32_t node,
                              double mass,
                              const double *centre,
                              const double *inertia,
                              int32_t *id);

/**
 * Fixes an inertia of any kind to a node, in addition to what the node has.
 *
 * A unit velocity of the frame (linear 1, 2, 3, angular 1, 2, 3) has the momentum (linear,
 * angular) of the matrix's column. A rigid body of mass m, with centre c and moments of inertia J
 * about the centre, both in the frame, has [m I, -m c~; m c~, J - m c~ c~], where c~ b = c * b.
 *
 * @param model  the model; not NULL
 * @param node  id of the node
 * @param frame  the frame that the matrix is about and resolved in; NULL for the node's own
 * @param matrix  array of shape 6 x 6: symmetric and positive semi-definite
 *     [mass, mass * length,     mass * length^2]
 * @param id  id of the inertia; may be NULL if it is not wanted; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_ID, PDN_ERR_VALUE
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_add_inertia(struct pdn_model *model,
                                 int32_t node,
                                 const struct pdn_frame *frame,
                                 const double *matrix,
                                 int32_t *id);

/**
 * Makes a joint coordinate follow a signal. Each coordinate can be prescribed once.
 *
 * The signal of an angle may grow by whole turns in a period, save that of a screw.
 *
 * @param model  the model; not NULL
 * @param joint  id of the joint
 * @param coordinate  PDN_DISPLACEMENT ... PDN_ROTATION_3; one that the joint has
 * @param signal  the coordinate in time [length, or radian], copied; not NULL
 * @param prescribed  id of the prescribed coordinate; may be NULL if it is not wanted; written on
 *     success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_SIZE, PDN_ERR_ID, PDN_ERR_VALUE,
 *     PDN_ERR_STRUCT_SIZE, PDN_ERR_NOT_AVAILABLE
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_prescribe(struct pdn_model *model,
                               int32_t joint,
                               int32_t coordinate,
                               const struct pdn_signal *signal,
                               int32_t *prescribed);

/**
 * Fixes two bodies to each other.
 *
 * Its frames are at the point, with axes parallel to the global ones in the reference
 * configuration. It has no coordinates.
 *
 * @param model  the model; not NULL
 * @param first  id of the first node, or PDN_GROUND
 * @param second  id of the second node, or PDN_GROUND; not the same body
 * @param point  array of length 3: where the reaction is reported, global coordinates [length]
 * @param joint  the joint's id; may be NULL if it is not wanted; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_ID, PDN_ERR_VALUE
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_add_rigid_joint(struct pdn_model *model,
                                     int32_t first,
                                     int32_t second,
                                     const double *point,
                                     int32_t *joint);

/**
 * Joins two bodies by a hinge.
 *
 * Its frames are at the point, with axis 3 along the axis. Its coordinate PDN_ROTATION is the
 * angle by which the second body has turned relative to the first, about the axis by the
 * right-hand rule, since the reference configuration, where it is zero; it counts whole turns.
 *
 * @param model  the model; not NULL
 * @param first  id of the first node, or PDN_GROUND
 * @param second  id of the second node, or PDN_GROUND; not the same body
 * @param point  array of length 3: a point of the axis, global coordinates [length]
 * @param axis  array of length 3: direction of the axis, global coordinates, of any nonzero length
 * @param joint  the joint's id; may be NULL if it is not wanted; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_ID, PDN_ERR_VALUE
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_add_revolute(struct pdn_model *model,
                                  int32_t first,
                                  int32_t second,
                                  const double *point,
                                  const double *axis,
                                  int32_t *joint);

/**
 * Joins two bodies by a slider.
 *
 * Its frames are at the point, with axis 3 along the axis. Its coordinate PDN_DISPLACEMENT is the
 * distance by which the second body has moved relative to the first, along the axis, since the
 * reference configuration, where it is zero. The bodies do not turn relative to each other.
 *
 * @param model  the model; not NULL
 * @param first  id of the first node, or PDN_GROUND
 * @param second  id of the second node, or PDN_GROUND; not the same body
 * @param point  array of length 3: a point of the axis, global coordinates [length]
 * @param axis  array of length 3: direction of the axis, global coordinates, of any nonzero length
 * @param joint  the joint's id; may be NULL if it is not wanted; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_ID, PDN_ERR_VALUE
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_add_prismatic(struct pdn_model *model,
                                   int32_t first,
                                   int32_t second,
                                   const double *point,
                                   const double *axis,
                                   int32_t *joint);

/**
 * Joins two bodies by a shaft in a sleeve: one slides along the axis and turns about it.
 *
 * Its frames are at the point, with axis 3 along the axis. Its coordinates PDN_DISPLACEMENT and
 * PDN_ROTATION are the distance and the angle by which the second body has moved relative to the
 * first, along the axis and about it by the right-hand rule, since the reference configuration,
 * where they are zero.
 *
 * @param model  the model; not NULL
 * @param first  id of the first node, or PDN_GROUND
 * @param second  id of the second node, or PDN_GROUND; not the same body
 * @param point  array of length 3: a point of the axis, global coordinates [length]
 * @param axis  array of length 3: direction of the axis, global coordinates, of any nonzero length
 * @param joint  the joint's id; may be NULL if it is not wanted; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_ID, PDN_ERR_VALUE
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_add_cylindrical(struct pdn_model *model,
                                     int32_t first,
                                     int32_t second,
                                     const double *point,
                                     const double *axis,
                                     int32_t *joint);

/**
 * Joins two bodies by a screw: the second advances along the axis as it turns about it.
 *
 * Its frames are at the point, with axis 3 along the axis. Its coordinates are those of a
 * cylindrical joint, and PDN_DISPLACEMENT = pitch PDN_ROTATION / (2 pi). The displacement tells
 * the whole turns of the angle, so that unlike other angles it cannot gain any in a period.
 *
 * @param model  the model; not NULL
 * @param first  id of the first node, or PDN_GROUND
 * @param second  id of the second node, or PDN_GROUND; not the same body
 * @param point  array of length 3: a point of the axis, global coordinates [length]
 * @param axis  array of length 3: direction of the axis, global coordinates, of any nonzero length
 * @param pitch  advance for one turn [length]; positive for a right-handed thread, negative for a
 *     left-handed one, not zero
 * @param joint  the joint's id; may be NULL if it is not wanted; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_ID, PDN_ERR_VALUE
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_add_screw(struct pdn_model *model,
                               int32_t first,
                               int32_t second,
                               const double *point,
                               const double *axis,
                               double pitch,
                               int32_t *joint);

/**
 * Joins two bodies by a pair of planes that slide and turn on each other.
 *
 * Its frames are at the point, with axis 3 along the normal; axes 1 and 2 are found by the
 * library, see ::pdn_model_add_joint to choose them. Its coordinates are the displacements of the
 * second body along axes 1 and 2 of the first frame (PDN_DISPLACEMENT, PDN_DISPLACEMENT_2) and the
 * angle by which it has turned relative to the first, about the normal by the right-hand rule
 * (PDN_ROTATION), since the reference configuration, where they are zero.
 *
 * @param model  the model; not NULL
 * @param first  id of the first node, or PDN_GROUND
 * @param second  id of the second node, or PDN_GROUND; not the same body
 * @param point  array of length 3: a point of the plane, whose displacement is measured, global
 *     coordinates [length]
 * @param normal  array of length 3: normal of the plane, global coordinates, of any nonzero length
 * @param joint  the joint's id; may be NULL if it is not wanted; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_ID, PDN_ERR_VALUE
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_add_planar(struct pdn_model *model,
                                int32_t first,
                                int32_t second,
                                const double *point,
                                const double *normal,
                                int32_t *joint);

/**
 * Joins two bodies by nothing: a joint that constrains no motion, but has coordinates.
 *
 * It carries springs and dampers, prescribed coordinates and measures between any two bodies. Its
 * frames are at the point, with axes parallel to the global ones in the reference configuration.
 * Its coordinates are the displacements of the second body along axes 1, 2, 3 of the first frame
 * (PDN_DISPLACEMENT, PDN_DISPLACEMENT_2, PDN_DISPLACEMENT_3), and the angles of a spherical joint
 * (PDN_ROTATION, PDN_ROTATION_2, PDN_ROTATION_3).
 *
 * @param model  the model; not NULL
 * @param first  id of the first node, or PDN_GROUND
 * @param second  id of the second node, or PDN_GROUND; not the same body
 * @param point  array of length 3: whose displacement is measured, global coordinates [length]
 * @param joint  the joint's id; may be NULL if it is not wanted; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_ID, PDN_ERR_VALUE
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_add_free_joint(struct pdn_model *model,
                                    int32_t first,
                                    int32_t second,
                                    const double *point,
                                    int32_t *joint);

/**
 * Joins two bodies by a ball.
 *
 * Its frames are at the point, with axes parallel to the global ones in the reference
 * configuration. Its coordinates PDN_ROTATION, PDN_ROTATION_2, PDN_ROTATION_3 are the angles by
 * which the second frame comes from the first by turning about axis 1, then about its own axis 2,
 * then about its own axis 3; zero in the reference configuration. The second must stay between
 * -pi/2 and pi/2.
 *
 * @param model  the model; not NULL
 * @param first  id of the first node, or PDN_GROUND
 * @param second  id of the second node, or PDN_GROUND; not the same body
 * @param point  array of length 3: centre of the ball, global coordinates [length]
 * @param joint  the joint's id; may be NULL if it is not wanted; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_ID, PDN_ERR_VALUE
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_add_spherical(struct pdn_model *model,
                                   int32_t first,
                                   int32_t second,
                                   const double *point,
                                   int32_t *joint);

/**
 * Joins two bodies by a cross (Cardan, Hooke).
 *
 * One arm of the cross turns in the first body, the other in the second. Its frames are at the
 * point, with axis 1 along the first arm, axis 2 along the second, in the reference configuration.
 * Its coordinates are the angle of the cross relative to the first body about first_arm
 * (PDN_ROTATION), and of the second body relative to the cross about second_arm (PDN_ROTATION_2),
 * both by the right-hand rule and zero in the reference configuration.
 *
 * @param model  the model; not NULL
 * @param first  id of the first node, or PDN_GROUND
 * @param second  id of the second node, or PDN_GROUND; not the same body
 * @param point  array of length 3: centre of the cross, global coordinates [length]
 * @param first_arm  array of length 3: direction of the arm fixed to the first body, global
 *     coordinates, of any nonzero length
 * @param second_arm  array of length 3: that of the arm fixed to the second body, perpendicular
 * @param joint  the joint's id; may be NULL if it is not wanted; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_ID, PDN_ERR_VALUE
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_add_universal(struct pdn_model *model,
                                   int32_t first,
                                   int32_t second,
                                   const double *point,
                                   const double *first_arm,
                                   const double *second_arm,
                                   int32_t *joint);

/**
 * Adds a strut: the line between a point of each of two bodies. It constrains nothing.
 *
 * Its coordinate PDN_DISPLACEMENT is the distance of the points. Springs, dampers, actuators and
 * other forces on that coordinate act along the line: an effort against its growth is a tension,
 * and the rest of a spring its free length. Prescribed, it is a rod without mass, of constant or
 * varying length. The points must not meet while a force acts.
 *
 * @param model  the model; not NULL
 * @param first  id of the first node, or PDN_GROUND
 * @param second  id of the second node, or PDN_GROUND; not the same body
 * @param first_point  array of length 3: the point of the first body in the reference
 *     configuration, global coordinates [length]
 * @param second_point  array of length 3: that of the second body, not the same
 * @param joint  the joint's id; may be NULL if it is not wanted; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_ID, PDN_ERR_VALUE
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_add_strut(struct pdn_model *model,
                               int32_t first,
                               int32_t second,
                               const double *first_point,
                               const double *second_point,
                               int32_t *joint);

/**
 * Joins two bodies by a joint of any kind, between a frame fixed to each.
 *
 * The frames need not fit each other in the reference configuration: the solver closes the joint.
 * With r = (r1, r2, r3) and R the position and rotation of the second frame relative to the first,
 * and resolved in it, the closed joint has
 *
 * | kind | r | R | coordinates |
 * |---|---|---|---|
 * | PDN_JOINT_RIGID | 0 | I | none |
 * | PDN_JOINT_REVOLUTE | 0 | R3(a) | a = PDN_ROTATION |
 * | PDN_JOINT_PRISMATIC | (0, 0, z) | I | z = PDN_DISPLACEMENT |
 * | PDN_JOINT_CYLINDRICAL | (0, 0, z) | R3(a) | z = PDN_DISPLACEMENT, a = PDN_ROTATION |
 * | PDN_JOINT_PLANAR | (x, y, 0) | R3(a) | x = PDN_DISPLACEMENT, y = PDN_DISPLACEMENT_2, and a |
 * | PDN_JOINT_UNIVERSAL | 0 | R1(a) R2(b) | a = PDN_ROTATION, b = PDN_ROTATION_2 |
 * | PDN_JOINT_SPHERICAL | 0 | R1(a) R2(b) R3(c) | and c = PDN_ROTATION_3 |
 * | PDN_JOINT_FREE | (x, y, z) | R1(a) R2(b) R3(c) | all of these, z = PDN_DISPLACEMENT_3 |
 *
 * where Rk(x) turns by x about axis k, right-handed. Angles count whole turns. A screw has a pitch
 * besides: ::pdn_model_add_screw_between.
 *
 * @param model  the model; not NULL
 * @param kind  PDN_JOINT_RIGID ... PDN_JOINT_FREE
 * @param first  id of the first node, or PDN_GROUND
 * @param second  id of the second node, or PDN_GROUND; not the same body
 * @param first_frame  frame fixed to the first body, where it is in the reference configuration;
 *     not NULL
 * @param second_frame  frame fixed to the second body, likewise; not NULL
 * @param joint  the joint's id; may be NULL if it is not wanted; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_ID, PDN_ERR_VALUE
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_add_joint(struct pdn_model *model,
                               int32_t kind,
                               int32_t first,
                               int32_t second,
                               const struct pdn_frame *first_frame,
                               const struct pdn_frame *second_frame,
                               int32_t *joint);

/**
 * Joins two bodies by a screw, between a frame fixed to each.
 *
 * As ::pdn_model_add_joint with frames: the closed joint has r = (0, 0, pitch a / (2 pi)) and R =
 * R3(a), with the coordinates PDN_DISPLACEMENT = r3 and PDN_ROTATION = a. Where the frames do not
 * fit each other in the reference configuration, the solver takes the thread's turn that is
 * nearest.
 *
 * @param model  the model; not NULL
 * @param first  id of the first node, or PDN_GROUND
 * @param second  id of the second node, or PDN_GROUND; not the same body
 * @param first_frame  frame fixed to the first body, where it is in the reference configuration;
 *     not NULL
 * @param second_frame  frame fixed to the second body, likewise; not NULL
 * @param pitch  advance for one turn [length]; positive for a right-handed thread, negative for a
 *     left-handed one, not zero
 * @param joint  the joint's id; may be NULL if it is not wanted; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_ID, PDN_ERR_VALUE
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_add_screw_between(struct pdn_model *model,
                                       int32_t first,
                                       int32_t second,
                                       const struct pdn_frame *first_frame,
                                       const struct pdn_frame *second_frame,
                                       double pitch,
                                       int32_t *joint);

/**
 * Number of linear relations between joint coordinates; their ids follow each other from
 * PDN_FIRST_RELATION on.
 *
 * @param model  the model; not NULL
 * @param count  the number; written on success only
 * @return PDN_OK, PDN_ERR_NULL
 *
 * Threads: `model` is `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_relation_count(const struct pdn_model *model,
                                    int32_t *count);

/**
 * Adds a linear relation between joint coordinates: gears, belts, racks, differentials.
 *
 * It keeps the sum of coefficients[i] * q[i] equal to a signal, with q[i] coordinate
 * coordinates[i] of joint joints[i], whole turns counted. Gears that turn q1 by n q2 have
 * coefficients 1 and -n, a rack on a pinion of radius r 1 and -r, a differential 1, 1 and -2. It
 * exerts an effort on each of the coordinates, in proportion to the coefficients:
 * PDN_RELATION_EFFORT. Where angles that are prescribed turn on and on, those that they
 * turn by relations must gain whole turns in a period as well; a solve refuses others with
 * PDN_ERR_NOT_PERIODIC, and tells a period that would do.
 *
 * @param model  the model; not NULL
 * @param joints  array of length [count]: ids of the joints
 * @param coordinates  array of length [count]: PDN_DISPLACEMENT ... PDN_ROTATION_3 of each, one
 *     that the joint has; each coordinate of a joint at most once
 * @param coefficients  array of length [count]: numbers other than zero, in units that make the
 *     terms of the sum alike
 * @param count  number of coordinates, at least 2
 * @param signal  what the sum is in time, copied; it must return to its value after a period. NULL
 *     for what the sum is in the reference configuration
 * @param relation  the relation's id; may be NULL if it is not wanted; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_SIZE, PDN_ERR_ID, PDN_ERR_VALUE,
 *     PDN_ERR_STRUCT_SIZE, PDN_ERR_NOT_AVAILABLE
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_add_relation(struct pdn_model *model,
                                  const int32_t *joints,
                                  const int32_t *coordinates,
                                  const double *coefficients,
                                  size_t count,
                                  const struct pdn_signal *signal,
                                  int32_t *relation);

/**
 * Makes a line that is still to be set. Use it as `PDN_INIT(pdn_line, &line)`.
 *
 * @param line  the line; not NULL
 * @param struct_size  sizeof(pdn_line)
 *
 * Threads: any.
 * @since 0.1
 */
PDN_API
void pdn_line_init(struct pdn_line *line,
                   size_t struct_size);

/**
 * Makes a line straight. Its axes are the same all along.
 *
 * @param line  an initialised line; not NULL
 * @param start  array of length 3: where it starts, global coordinates [length]
 * @param end  array of length 3: where it ends, not at start
 * @param axis_2  array of length 3: axis 2 is the part of this direction that is perpendicular to
 *     the line; of any nonzero length, not along the line
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE, PDN_ERR_NOT_FINITE
 *
 * Threads: exclusive use of `line`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_line_set_straight(struct pdn_line *line,
                                 const double *start,
                                 const double *end,
                                 const double *axis_2);

/**
 * Makes a line the circular arc from start through point to end, of up to a whole turn.
 *
 * Fractions are of its length. Its axes turn with it about the arc's own axis, so that their
 * curvature is constant.
 *
 * @param line  an initialised line; not NULL
 * @param start  array of length 3: where it starts, global coordinates [length]
 * @param point  array of length 3: a point between start and end; the three not on a straight line
 * @param end  array of length 3: where it ends, not at start
 * @param axis_2  array of length 3: axis 2 at the start is the part of this direction that is
 *     perpendicular to the arc there; of any nonzero length, not along the arc there
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE, PDN_ERR_NOT_FINITE
 *
 * Threads: exclusive use of `line`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_line_set_arc(struct pdn_line *line,
                            const double *start,
                            const double *point,
                            const double *end,
                            const double *axis_2);

/**
 * Makes a line a curve that the caller computes.
 *
 * The curve must be smooth, and its fraction advance steadily: it is differentiated by the
 * library, to rounding if it turns by less than half a radian in each 1/16 of the fraction. Join
 * pieces that meet in a corner by ::pdn_model_add_rigid_joint.
 *
 * @param line  an initialised line; not NULL
 * @param curve  the curve, see ::pdn_curve_fn for when it is called; not NULL
 * @param user_data  handed to the curve; may be NULL. Must be valid until the line is no longer
 *     used
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE
 *
 * Threads: exclusive use of `line`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_line_set_curve(struct pdn_line *line,
                              pdn_curve_fn curve,
                              void *user_data);

/**
 * Makes stations that are still to be set. Use it as `PDN_INIT(pdn_stations, &stations)`.
 *
 * @param stations  the stations; not NULL
 * @param struct_size  sizeof(pdn_stations)
 *
 * Threads: any.
 * @since 0.1
 */
PDN_API
void pdn_stations_init(struct pdn_stations *stations,
                       size_t struct_size);

/**
 * Adds a beam element over nodes that are there; it may be curved and twisted.
 *
 * The nodes stand, in order, at the Gauss-Lobatto points along the beam; two are its ends. Axis 1
 * of each node is along the beam (to within 60 degrees, for curved ones), axes 2 and 3 are those
 * of the section. The element's reference shape interpolates them, and is free of stress.
 *
 * Elements may share end nodes, in chains and where beams branch, but not otherwise; elements that
 * would lie on each other are refused.
 *
 * @param model  the model; not NULL
 * @param nodes  array of length [count]: ids of the nodes, all different
 * @param count  2 to 25
 * @param section  cross-section, with positive-definite stiffness; not NULL
 * @param element  the element's id; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_SIZE, PDN_ERR_ID, PDN_ERR_STRUCT_SIZE, PDN_ERR_NOT_FINITE,
 *     PDN_ERR_VALUE, PDN_ERR_MODEL (nodes that turn too much from one to the next)
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_add_beam_element(struct pdn_model *model,
                                      const int32_t *nodes,
                                      size_t count,
                                      const struct pdn_section *section,
                                      int32_t *element);

/**
 * Adds a straight beam: its nodes and elements.
 *
 * Axis 1 of every node is along the beam, from start to end; axis 2 is the part of axis_2 that is
 * perpendicular to it; axis 3 = axis 1 * axis 2. Beams are joined by joints between their nodes,
 * or by ::pdn_model_add_rigid_joint.
 *
 * @param model  the model; not NULL
 * @param start  array of length 3: where the beam starts, global coordinates [length]
 * @param end  array of length 3: where it ends, not at start
 * @param axis_2  array of length 3: direction of axis 2 of the section, global coordinates, of any
 *     nonzero length, not along the beam
 * @param section  cross-section, with positive-definite stiffness; not NULL
 * @param elements  number of elements, 1 to 1000000
 * @param degree  polynomial degree of the elements, 1 to 24; an element has degree + 1 nodes
 * @param beam  ids of what was made; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_SIZE, PDN_ERR_STRUCT_SIZE,
 *     PDN_ERR_VALUE
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_add_straight_beam(struct pdn_model *model,
                                       const double *start,
                                       const double *end,
                                       const double *axis_2,
                                       const struct pdn_section *section,
                                       size_t elements,
                                       size_t degree,
                                       struct pdn_beam *beam);

/**
 * Adds a beam along a line, with sections that may vary: its nodes and elements.
 *
 * Axis 1 of every node is along the line; axes 2 and 3 are those of the line, turned by the twist.
 * The mesh is even but for jumps of the section, where an element ends and the next begins; so
 * there must be more elements than jumps. Stations may lie anywhere: elements are integrated from
 * each to the next. Where slopes of section or twist jump inside an element, degrees gain less
 * accuracy all the same.
 *
 * Beams are joined by joints between their nodes. To fix a beam's end to a body at a distance, use
 * ::pdn_model_add_rigid_joint between the two nodes: they need not be at the same place.
 *
 * @param model  the model; not NULL
 * @param line  reference line; not NULL
 * @param stations  cross-sections along it; not NULL
 * @param elements  number of elements, 1 to 1000000
 * @param degree  polynomial degree of the elements, 1 to 24; an element has degree + 1 nodes
 * @param beam  ids of what was made; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_SIZE, PDN_ERR_STRUCT_SIZE,
 *     PDN_ERR_VALUE, PDN_ERR_CALLBACK, PDN_ERR_MODEL (nodes that turn too much from one to the
 *     next)
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_add_beam(struct pdn_model *model,
                              const struct pdn_line *line,
                              const struct pdn_stations *stations,
                              size_t elements,
                              size_t degree,
                              struct pdn_beam *beam);

/**
 * Adds a beam along a line as ::pdn_model_add_beam does, with elements between given places.
 *
 * For meshes that follow the stations of a section, give their fractions, each once; an element
 * ends and the next begins at every jump of the section.
 *
 * @param model  the model; not NULL
 * @param line  reference line; not NULL
 * @param stations  cross-sections along it; not NULL
 * @param boundaries  array of length [count]: places along the span where elements begin and end,
 *     from 0 at the start to 1 at the end, ascending, with all jumps among them
 * @param count  number of boundaries, 2 to 1000001: one more than there are elements
 * @param degree  polynomial degree of the elements, 1 to 24; an element has degree + 1 nodes
 * @param beam  ids of what was made; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_SIZE, PDN_ERR_STRUCT_SIZE,
 *     PDN_ERR_VALUE, PDN_ERR_CALLBACK, PDN_ERR_MODEL (nodes that turn too much from one to the
 *     next)
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_add_beam_between(struct pdn_model *model,
                                      const struct pdn_line *line,
                                      const struct pdn_stations *stations,
                                      const double *boundaries,
                                      size_t count,
                                      size_t degree,
                                      struct pdn_beam *beam);

/**
 * Adds one component of a force or moment on a node, in addition to those that are there.
 *
 * A force acts at the node's origin; ::pdn_model_add_load_at_point takes another point.
 *
 * @param model  the model; not NULL
 * @param node  id of the node
 * @param frame  PDN_FRAME_SPACE: directions of the global axes; PDN_FRAME_MATERIAL: of the node's
 *     axes, which the load follows
 * @param component  PDN_FORCE_1, PDN_FORCE_2, PDN_FORCE_3 [force], PDN_MOMENT_1, PDN_MOMENT_2 or
 *     PDN_MOMENT_3 [force * length]
 * @param signal  the component in time, copied; not NULL
 * @param load  the load's id; may be NULL if it is not wanted; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_SIZE, PDN_ERR_ID, PDN_ERR_VALUE,
 *     PDN_ERR_STRUCT_SIZE
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_add_load(struct pdn_model *model,
                              int32_t node,
                              int32_t frame,
                              int32_t component,
                              const struct pdn_signal *signal,
                              int32_t *load);

/**
 * Adds one component of a force or moment at a point that a node carries, in addition to those
 * that are there: such as a thrust that acts off the node of a body.
 *
 * The point moves with the node, and so does the arm of the force about the node.
 *
 * @param model  the model; not NULL
 * @param node  id of the node
 * @param offset  array of length 3: the point, from the node's origin, along the node's axes
 *     \[length\]
 * @param frame  PDN_FRAME_SPACE: directions of the global axes; PDN_FRAME_MATERIAL: of the node's
 *     axes, which the load follows
 * @param component  PDN_FORCE_1, PDN_FORCE_2, PDN_FORCE_3 [force], PDN_MOMENT_1, PDN_MOMENT_2 or
 *     PDN_MOMENT_3 [force * length]
 * @param signal  the component in time, copied; not NULL
 * @param load  the load's id; may be NULL if it is not wanted; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_SIZE, PDN_ERR_ID, PDN_ERR_VALUE,
 *     PDN_ERR_STRUCT_SIZE
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_add_load_at_point(struct pdn_model *model,
                                       int32_t node,
                                       const double *offset,
                                       int32_t frame,
                                       int32_t component,
                                       const struct pdn_signal *signal,
                                       int32_t *load);

/**
 * Adds one component of a force or moment at a fraction of the span of a beam, in addition to
 * those that are there.
 *
 * It moves with the section there. Internal forces jump at such a place, which an element smooths
 * unless a node is there: next to the load they are more accurate on a mesh with a boundary there,
 * as ::pdn_model_add_beam_between makes it. The ends of elements are nodes.
 *
 * @param model  the model; not NULL
 * @param first_element  id of the first beam element, such as the first_element of a ::pdn_beam
 * @param elements  number of elements, from the first on, such as the elements of a ::pdn_beam; at
 *     least 1
 * @param fraction  the place, as a fraction of the reference length of these elements, from 0 to 1
 * @param offset  array of length 3: the point, from the line of the beam, along the section's axes
 *     \[length\]; NULL for a point of the line
 * @param frame  PDN_FRAME_SPACE: directions of the global axes; PDN_FRAME_MATERIAL: of the
 *     section's axes, which the load follows
 * @param component  PDN_FORCE_1, PDN_FORCE_2, PDN_FORCE_3 [force], PDN_MOMENT_1, PDN_MOMENT_2 or
 *     PDN_MOMENT_3 [force * length]
 * @param signal  the component in time, copied; not NULL
 * @param load  the load's id, as of a load on a node; may be NULL if it is not wanted; written on
 *     success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_SIZE, PDN_ERR_ID, PDN_ERR_VALUE,
 *     PDN_ERR_STRUCT_SIZE
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_add_load_on_beam(struct pdn_model *model,
                                      int32_t first_element,
                                      int32_t elements,
                                      double fraction,
                                      const double *offset,
                                      int32_t frame,
                                      int32_t component,
                                      const struct pdn_signal *signal,
                                      int32_t *load);

/**
 * Sets the acceleration of gravity, in place of any set before. Without this call there is none.
 *
 * @param model  the model; not NULL
 * @param acceleration  array of length 3: such as {0, 0, -9.81}, global axes [length / time^2]
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_set_gravity(struct pdn_model *model,
                                 const double *acceleration);

/**
 * Sets an acceleration of gravity that varies in time, in place of any set before.
 *
 * So a shaking ground can be described in axes that shake with it.
 *
 * @param model  the model; not NULL
 * @param acceleration_1  component along global axis 1 [length / time^2], copied; NULL for none
 * @param acceleration_2  component along global axis 2, copied; NULL for none
 * @param acceleration_3  component along global axis 3, copied; NULL for none
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_SIZE, PDN_ERR_VALUE,
 *     PDN_ERR_STRUCT_SIZE
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_set_gravity_signals(struct pdn_model *model,
                                         const struct pdn_signal *acceleration_1,
                                         const struct pdn_signal *acceleration_2,
                                         const struct pdn_signal *acceleration_3);

/**
 * Adds one component of a force or moment distributed along beam elements, in addition to those
 * that are there.
 *
 * It acts on the line of the beam, for each unit of its reference length, and moves with the
 * sections: signal times factor.
 *
 * @param model  the model; not NULL
 * @param first_element  id of the first beam element, such as the first_element of a ::pdn_beam
 * @param elements  number of elements, from the first on, such as the elements of a ::pdn_beam; at
 *     least 1
 * @param frame  PDN_FRAME_SPACE: directions of the global axes; PDN_FRAME_MATERIAL: of the
 *     sections' axes, which the load follows
 * @param component  PDN_FORCE_1, PDN_FORCE_2, PDN_FORCE_3 [force / length], PDN_MOMENT_1,
 *     PDN_MOMENT_2 or PDN_MOMENT_3 [force]
 * @param signal  the component in time, copied; not NULL
 * @param fractions  array of length [count]: places, as fractions of the reference length of these
 *     elements, ascending from 0 to 1; two at the same place make a jump. NULL if count is 0
 * @param factors  array of length [count]: factors of the signal at these places, linear in
 *     between; NULL if count is 0
 * @param count  0 for a factor of 1 all along; or at least 2
 * @param load  the load's id, a beam load's; may be NULL if it is not wanted; written on success
 *     only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_SIZE, PDN_ERR_ID, PDN_ERR_VALUE,
 *     PDN_ERR_STRUCT_SIZE
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_add_distributed_load(struct pdn_model *model,
                                          int32_t first_element,
                                          int32_t elements,
                                          int32_t frame,
                                          int32_t component,
                                          const struct pdn_signal *signal,
                                          const double *fractions,
                                          const double *factors,
                                          size_t count,
                                          int32_t *load);

/**
 * Adds a force and moment distributed along beam elements, all components at all places at once,
 * in addition to those that are there: such as the air loads of a blade, at the places where these
 * are computed.
 *
 * It acts on the line of the beam, for each unit of its reference length, and moves with the
 * sections. It is linear between neighbouring places. However many there are, the beam is
 * evaluated as for one. Each place is a beam load with an id of its own.
 *
 * @param model  the model; not NULL
 * @param first_element  id of the first beam element, such as the first_element of a ::pdn_beam
 * @param elements  number of elements, from the first on, such as the elements of a ::pdn_beam; at
 *     least 1
 * @param frame  PDN_FRAME_SPACE: directions of the global axes; PDN_FRAME_MATERIAL: of the
 *     sections' axes, twisted as they are; PDN_FRAME_UNTWISTED: axis 1 along the reference line,
 *     axis 2 the part of axis_2 that is perpendicular to it, axis 3 = axis 1 * axis 2, all in the
 *     reference configuration, and each section takes these axes with it
 * @param axis_2  array of length 3: direction, global coordinates, of any nonzero length, nowhere
 *     along the line; read for PDN_FRAME_UNTWISTED only, else it may be NULL
 * @param fractions  array of length [count]: places, as fractions of the reference length of these
 *     elements, ascending from 0 to 1; two at the same place make a jump
 * @param signals  array of shape 6 x [count], each initialised, copied: those of the first place,
 *     PDN_FORCE_1 to PDN_FORCE_3 [force / length] and PDN_MOMENT_1 to PDN_MOMENT_3 [force], then
 *     those of the next. One that was only initialised is zero
 * @param count  number of places, at least 2
 * @param first_load  id of the beam load at the first place; those at the others follow; may be
 *     NULL if it is not wanted; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_SIZE, PDN_ERR_ID, PDN_ERR_VALUE,
 *     PDN_ERR_STRUCT_SIZE
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_add_load_at_places(struct pdn_model *model,
                                        int32_t first_element,
                                        int32_t elements,
                                        int32_t frame,
                                        const double *axis_2,
                                        const double *fractions,
                                        const struct pdn_signal *signals,
                                        size_t count,
                                        int32_t *first_load);

/**
 * Describes everything in a frame that turns about a fixed axis at a constant rate, in place of
 * any set before: motions that repeat themselves but for a turn in each period are periodic there.
 *
 * Positions, directions, rotations, prescribed motions and the ground are those in the frame, in
 * the model and in all results; at time zero its axes are the inertial ones. Velocities and
 * accelerations of nodes are those in the inertial frame, along the axes of the frame or of the
 * node, in results and in forces of yours on nodes and shells; rates of joints, and dampers, know
 * the motion in the frame only. Loads with PDN_FRAME_SPACE keep their directions in the frame.
 * Gravity must be along the axis: a solve refuses any other, unless the rate is zero.
 *
 * A motion M of the frame is exp(axis rate t) M in the inertial one: it repeats itself after the
 * period T but for a turn of rate T. Supports that are no different when they turn about the axis,
 * such as a hinge along it, are those of the inertial frame; the turn in a period may be unknown:
 * a free parameter (PDN_NUMBER_FRAME_RATE) with a condition (::pdn_conditions_add_rotation_phase).
 * All analyses are in the frame: also statics, modes, marches and stability.
 *
 * @param model  the model; not NULL
 * @param axis  array of length 3: direction of the axis, not zero
 * @param rate  angle in a unit of time \[rad/time\]; it may be zero
 * @param point  array of length 3: a point of the axis \[length\]; NULL for the origin
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_VALUE (no direction)
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_set_turning_frame(struct pdn_model *model,
                                       const double *axis,
                                       double rate,
                                       const double *point);

/**
 * The frame that a model is described in, if it turns.
 *
 * @param model  the model; not NULL
 * @param axis  array of length 3: direction of the axis, of length 1; written on success only
 * @param rate  angle in a unit of time \[rad/time\]; written on success only
 * @param point  array of length 3: a point of the axis \[length\]; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_AVAILABLE (it does not turn)
 *
 * Threads: `model` is `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_turning_frame(const struct pdn_model *model,
                                   double *axis,
                                   double *rate,
                                   double *point);

/**
 * Lets the frame that everything is described in advance along its axis at a constant speed, too:
 * motions that repeat themselves but for a translation in each period, or for a screw motion, are
 * periodic there. A frame of ::pdn_model_set_turning_frame with the rate zero only advances.
 *
 * Inertial forces do not change by it. What sees it are velocities in the inertial frame: those of
 * nodes in results and in forces of yours on nodes, beams and shells, damping in proportion to
 * mass, energies and momenta. The ground that joints, springs and dampers hold on to moves along;
 * what stands still beside the way is described by forces of yours.
 *
 * The speed may be unknown, a free parameter (PDN_NUMBER_FRAME_ADVANCE) with a condition
 * (::pdn_conditions_add_translation_phase): the drift of a motion that goes on.
 *
 * @param model  the model, with a turning frame; not NULL
 * @param speed  speed along the axis \[length/time\]; zero after ::pdn_model_set_turning_frame
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_NOT_AVAILABLE (no turning frame)
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_set_frame_advance(struct pdn_model *model,
                                       double speed);

/**
 * Speed along its axis of the frame that a model is described in.
 *
 * @param model  the model; not NULL
 * @param speed  speed along the axis \[length/time\]; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_AVAILABLE (it is described in the inertial frame)
 *
 * Threads: `model` is `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_frame_advance(const struct pdn_model *model,
                                   double *speed);

/**
 * Lets a rigid body, or a mass or inertia on a node, spin at a constant rate relative to its node,
 * about an axis through its centre of mass which is fixed in the node: a disk, a rotor, a flywheel
 * with its gyroscopic moments, on a node that does not turn with it. In place of any spin set
 * before.
 *
 * The node describes a frame in which the body spins: its motion in results, and all that is
 * attached to it, is without the spin. The body must be symmetric about the axis, so that its
 * inertia in the node's frame stays what it is; to 1e-8 of its masses and moments, so that numbers
 * written with 9 digits pass. What keeps the rate (a motor, or bearings of a shaft that turns
 * steadily) acts between node and body: about the axis the node feels the body's inertia and, with
 * damping in proportion to mass, what damps its spin. Momenta and kinetic energies
 * (::pdn_conditions_add_angular_momentum, ::pdn_conditions_add_energy) are those of the body. That
 * energy is constant in a free motion only if what keeps the rate does no work: where nothing acts
 * on the node about the axis.
 *
 * All analyses know of it, also modes and statics in a frame that turns. A parameter may move the
 * rate (PDN_NUMBER_SPIN).
 *
 * @param model  the model; not NULL
 * @param inertia  id of the inertia, as ::pdn_model_inertia_of tells of a rigid body
 * @param axis  array of length 3: direction of the axis, along the axes of the node, not zero
 * @param rate  angle in a unit of time \[rad/time\]; it may be zero
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_ID, PDN_ERR_VALUE (no direction, or
 *     the inertia is not symmetric about the axis)
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_set_spin(struct pdn_model *model,
                              int32_t inertia,
                              const double *axis,
                              double rate);

/**
 * How an inertia spins relative to its node, if it does.
 *
 * @param model  the model; not NULL
 * @param inertia  id of the inertia
 * @param axis  array of length 3: direction of the axis, of length 1, along the axes of the node;
 *     written on success only
 * @param rate  angle in a unit of time \[rad/time\]; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID, PDN_ERR_NOT_AVAILABLE (it was given no spin)
 *
 * Threads: `model` is `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_spin(const struct pdn_model *model,
                          int32_t inertia,
                          double *axis,
                          double *rate);

/**
 * Lets the material of beam elements spin about axis 1 of their sections at a constant rate
 * relative to their nodes, which do not spin along: a shaft that turns, and whirls by small angles
 * about where it stands, as ::pdn_model_set_spin lets a disk on it.
 *
 * Rotary inertia is that of sections that spin. Damping acts on the rates of strains that the
 * material sees, which change with each turn where the shaft is bent: it is a rotating damping,
 * which makes a shaft unstable that turns faster than its first critical speed, unless other
 * damping holds it. Such a beam has no energy that is known. What loads the beam, and beam
 * quantities, are in the axes that do not spin.
 *
 * The elements must be straight, axis 1 of their nodes along them, and stiffness, mass and damping
 * of their sections symmetric about axis 1, to 1e-8.
 *
 * @param model  the model; not NULL
 * @param first_element  id of the first beam element
 * @param elements  number of elements, in order, at least 1
 * @param rate  angle in a unit of time \[rad/time\]; 0 for beams that do not spin
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_SIZE, PDN_ERR_NOT_FINITE, PDN_ERR_ID, PDN_ERR_VALUE (a
 *     beam is not straight, or a section not symmetric)
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_set_beam_spin(struct pdn_model *model,
                                   int32_t first_element,
                                   int32_t elements,
                                   double rate);

/**
 * The rate at which the material of a beam element spins relative to its nodes.
 *
 * @param model  the model; not NULL
 * @param element  id of the beam element
 * @param rate  angle in a unit of time \[rad/time\], 0 if it does not spin; written on success
 *     only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID
 *
 * Threads: `model` is `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_beam_spin(const struct pdn_model *model,
                               int32_t element,
                               double *rate);

/**
 * Says that the blades of a rotor are alike, in place of what was said before: periodic solves,
 * also under conditions, then solve for one blade, the hub and the supports, and the others
 * follow.
 *
 * The rotor turns once in a period about its axis, in the positive sense. In the reference
 * configuration each blade is where the one before it gets by a turn of 1/blades; in the motion it
 * is where that one gets a part 1/blades of the period later, and so are the hub, but for that
 * turn, and all that does not turn. What acts on the model has to be so: blades with the same
 * sections, masses, joints and springs, loads and prescribed motions that each blade has a part of
 * the period before the one before it, a hub that is the same after that turn. Supports and
 * gravity may be any. A solve refuses what is not alike, and says what tells blades apart.
 *
 * Solutions are those of all blades, as without this. They are solved for so where the number of
 * grid points is a multiple of that of blades, as adaptive solves then choose it; not where time
 * is mapped, equations are oversampled, controllers act or beams are very slender, and only by
 * factors where blades act on each other. Loads and conditions that parameters make different at
 * the blades are solved for in whole. Nothing else takes notice: statics, modes, marches and
 * branches are those of the whole model; multipliers, too, but they are found over the part of
 * the period that one blade takes to the place of the next.
 *
 * @param model  the model; not NULL
 * @param axis  array of length 3: direction of the axis, not zero
 * @param blades  number of blades, at least 2
 * @param nodes  array of length [count]: ids of the nodes of all blades, blade after blade, those
 *     of each in the same order; all different
 * @param count  number of nodes, a multiple of blades
 * @param hub  array of length [hub_count]: ids of the nodes of the hub, and of whatever else turns
 *     with the blades
 * @param hub_count  number of these, maybe 0
 * @param point  array of length 3: a point of the axis \[length\]; NULL for the origin
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_SIZE, PDN_ERR_ID, PDN_ERR_VALUE (no
 *     direction, or a node twice)
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_set_rotor_symmetry(struct pdn_model *model,
                                        const double *axis,
                                        int32_t blades,
                                        const int32_t *nodes,
                                        size_t count,
                                        const int32_t *hub,
                                        size_t hub_count,
                                        const double *point);

/**
 * The rotor whose blades were said to be alike.
 *
 * @param model  the model; not NULL
 * @param axis  array of length 3: direction of the axis, of length 1; written on success only
 * @param point  array of length 3: a point of the axis \[length\]; written on success only
 * @param blades  number of blades; written on success only
 * @param nodes_of_blade  number of nodes of each, for ::pdn_model_rotor_node; written on success
 *     only
 * @param hub_nodes  number of nodes of the hub; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_AVAILABLE (nothing was said)
 *
 * Threads: `model` is `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_rotor_symmetry(const struct pdn_model *model,
                                    double *axis,
                                    double *point,
                                    int32_t *blades,
                                    int32_t *nodes_of_blade,
                                    int32_t *hub_nodes);

/**
 * A node of a rotor whose blades were said to be alike.
 *
 * @param model  the model; not NULL
 * @param blade  which blade, from 0 on; -1 for the hub
 * @param index  which of its nodes, from 0 on
 * @param node  the node's id; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID, PDN_ERR_NOT_AVAILABLE (nothing was said)
 *
 * Threads: `model` is `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_rotor_node(const struct pdn_model *model,
                                int32_t blade,
                                int32_t index,
                                int32_t *node);

/**
 * Makes a surface that is still to be set. Use it as `PDN_INIT(pdn_surface, &surface)`.
 *
 * @param surface  the surface; not NULL
 * @param struct_size  sizeof(pdn_surface)
 *
 * Threads: any.
 * @since 0.1
 */
PDN_API
void pdn_surface_init(struct pdn_surface *surface,
                      size_t struct_size);

/**
 * Makes a surface a parallelogram, such as a rectangle.
 *
 * @param surface  an initialised surface; not NULL
 * @param corner  array of length 3: the point at u = v = 0, global coordinates [length]
 * @param along_u  array of length 3: the side from there along u [length]
 * @param along_v  array of length 3: the side along v, not parallel to it [length]
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE, PDN_ERR_NOT_FINITE
 *
 * Threads: exclusive use of `surface`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_surface_set_parallelogram(struct pdn_surface *surface,
                                         const double *corner,
                                         const double *along_u,
                                         const double *along_v);

/**
 * Makes a surface an annulus or a sector of one: u from the inner to the outer radius, v around
 * the axis. The normal is along the axis for positive angles.
 *
 * @param surface  an initialised surface; not NULL
 * @param centre  array of length 3: its centre, global coordinates [length]
 * @param axis  array of length 3: direction of its axis, of any nonzero length
 * @param start  array of length 3: where v = 0 is, seen from the centre: the part of this
 *     direction across the axis; not along the axis
 * @param inner  inner radius, positive [length]
 * @param outer  outer radius, more than the inner [length]
 * @param angle  angle about the axis, right-handed; not zero, at most one turn [radian]
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE, PDN_ERR_NOT_FINITE
 *
 * Threads: exclusive use of `surface`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_surface_set_annulus(struct pdn_surface *surface,
                                   const double *centre,
                                   const double *axis,
                                   const double *start,
                                   double inner,
                                   double outer,
                                   double angle);

/**
 * Makes a surface a cylinder or a sector of one: u around the axis, v along it. The normal is
 * outwards for positive angles.
 *
 * @param surface  an initialised surface; not NULL
 * @param centre  array of length 3: the centre of its end, v = 0, global coordinates [length]
 * @param axis  array of length 3: direction of its axis, of any nonzero length
 * @param start  array of length 3: where u = 0 is, seen from the centre: the part of this
 *     direction across the axis; not along the axis
 * @param radius  radius, positive [length]
 * @param length  length along the axis, positive [length]
 * @param angle  angle about the axis, right-handed; not zero, at most one turn [radian]
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE, PDN_ERR_NOT_FINITE
 *
 * Threads: exclusive use of `surface`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_surface_set_cylinder(struct pdn_surface *surface,
                                    const double *centre,
                                    const double *axis,
                                    const double *start,
                                    double radius,
                                    double length,
                                    double angle);

/**
 * Makes a surface one that the caller computes, smooth within each element.
 *
 * @param surface  an initialised surface; not NULL
 * @param function  the surface, see ::pdn_surface_fn for when it is called; not NULL
 * @param user_data  handed to the function; may be NULL. Must be valid until the surface is no
 *     longer used
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE
 *
 * Threads: exclusive use of `surface`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_surface_set_function(struct pdn_surface *surface,
                                    pdn_surface_fn function,
                                    void *user_data);

/**
 * Makes a section with no stiffness, mass or damping. Use it as
 * `PDN_INIT(pdn_shell_section, &section)`.
 *
 * @param section  the section; not NULL
 * @param struct_size  sizeof(pdn_shell_section)
 *
 * Threads: any.
 * @since 0.1
 */
PDN_API
void pdn_shell_section_init(struct pdn_shell_section *section,
                            size_t struct_size);

/**
 * Makes a section that of one isotropic, linearly elastic material. Takes the damping away: give
 * that afterwards.
 *
 * @param section  an initialised section; not NULL
 * @param thickness  thickness, positive [length]
 * @param young  Young's modulus, positive [force / length^2]
 * @param poisson  Poisson's ratio, more than -1 and less than 1/2
 * @param density  zero or more [mass / length^3]
 * @param drilling  stiffness of the drilling rotation against the surface, relative to shear: 0.1
 *     to 1; usually 1
 * @param drilling_gradient  stiffness against gradients of the drilling rotation, which only
 *     regularises; positive, usually 0.1
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE, PDN_ERR_NOT_FINITE, PDN_ERR_VALUE
 *
 * Threads: exclusive use of `section`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_shell_section_set_isotropic(struct pdn_shell_section *section,
                                           double thickness,
                                           double young,
                                           double poisson,
                                           double density,
                                           double drilling,
                                           double drilling_gradient);

/**
 * Gives a section damping in proportion to its stiffness, which must have been set.
 *
 * A vibration of circular frequency w then has the damping ratio seconds * w / 2.
 *
 * @param section  an initialised section with stiffness; not NULL
 * @param seconds  damping = seconds * stiffness; zero or more [time]
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE, PDN_ERR_NOT_FINITE, PDN_ERR_VALUE
 *
 * Threads: exclusive use of `section`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_shell_section_set_proportional_damping(struct pdn_shell_section *section,
                                                      double seconds);

/**
 * Sets the defaults. Use it as `PDN_INIT(pdn_shell_placement, &placement)`.
 *
 * @param placement  the placement; not NULL
 * @param struct_size  sizeof(pdn_shell_placement)
 *
 * Threads: any.
 * @since 0.1
 */
PDN_API
void pdn_shell_placement_init(struct pdn_shell_placement *placement,
                              size_t struct_size);

/**
 * Adds a shell element over a grid of nodes that are there.
 *
 * The nodes stand at the Gauss-Lobatto points in both directions: node i n_eta + j of the array at
 * (xi_i, eta_j). How their frames are turned does not matter. The normal is that of the tangents
 * along xi and eta, in this order. The element's reference shape interpolates the nodes, and is
 * free of stress.
 *
 * Elements may share whole edges, with the same nodes along them, and single nodes; beams, bodies
 * and joints may share their nodes. Do not let a couple about the normal act on one node, such as
 * that of a beam that ends there: it turns the node the further, the finer the mesh. Connect
 * through an edge instead.
 *
 * @param model  the model; not NULL
 * @param nodes  array of length [count]: ids of the nodes, all different
 * @param count  number of nodes: n_xi n_eta
 * @param n_xi  nodes along xi, 2 to 16; so are those along eta, count / n_xi
 * @param section  the section; not NULL
 * @param placement  how it lies on the nodes; NULL for the defaults
 * @param element  the element's id; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_SIZE, PDN_ERR_ID, PDN_ERR_STRUCT_SIZE, PDN_ERR_NOT_FINITE,
 *     PDN_ERR_VALUE (inverted or overlapping elements, too), PDN_ERR_MODEL (nodes that turn too
 *     much from one to the next)
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_add_shell_element(struct pdn_model *model,
                                       const int32_t *nodes,
                                       size_t count,
                                       size_t n_xi,
                                       const struct pdn_shell_section *section,
                                       const struct pdn_shell_placement *placement,
                                       int32_t *element);

/**
 * Adds a shell over a surface, with elements in equal parts of u and v: its nodes and elements.
 *
 * Axis 1 of each new node's frame is along u, axis 3 along the normal.
 *
 * @param model  the model; not NULL
 * @param surface  the surface; not NULL
 * @param elements_u  number of elements along u, 1 to 100000
 * @param elements_v  number of elements along v, likewise
 * @param degree_u  polynomial degree along u, 1 to 15: nodes of an element, less one; 3 to 5 are
 *     good choices
 * @param degree_v  polynomial degree along v, likewise
 * @param join  1: nodes on the edges of the surface at the same place as nodes of shells that are
 *     there, or on another of its own edges, are these, so that shells are joined and closed; 0:
 *     all nodes are new; usually 1
 * @param section  the section; not NULL
 * @param placement  how it lies on the nodes; NULL for the defaults
 * @param shell  the shell's elements and numbers of nodes; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_SIZE, PDN_ERR_STRUCT_SIZE, PDN_ERR_NOT_FINITE,
 *     PDN_ERR_VALUE (inverted or overlapping elements, too), PDN_ERR_CALLBACK, PDN_ERR_MODEL
 *     (elements that turn too much)
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_add_shell(struct pdn_model *model,
                               const struct pdn_surface *surface,
                               size_t elements_u,
                               size_t elements_v,
                               size_t degree_u,
                               size_t degree_v,
                               int32_t join,
                               const struct pdn_shell_section *section,
                               const struct pdn_shell_placement *placement,
                               struct pdn_shell *shell);

/**
 * Adds a shell over given positions of its nodes, as ::pdn_model_add_shell does over a surface.
 *
 * The nodes of each element stand at the Gauss-Lobatto points in both directions: with degrees of
 * 1 and 2 evenly.
 *
 * @param model  the model; not NULL
 * @param points  array of shape 3 x [count]: positions of the nodes, global coordinates, those
 *     along v first [length]
 * @param count  number of nodes: (elements_u degree_u + 1) (elements_v degree_v + 1)
 * @param elements_u  number of elements along u, 1 to 100000
 * @param elements_v  number of elements along v, likewise
 * @param degree_u  polynomial degree along u, 1 to 15
 * @param degree_v  polynomial degree along v, likewise
 * @param join  0 or 1, as ::pdn_model_add_shell has it; usually 1
 * @param section  the section; not NULL
 * @param placement  how it lies on the nodes; NULL for the defaults
 * @param shell  the shell's elements and numbers of nodes; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_SIZE, PDN_ERR_STRUCT_SIZE, PDN_ERR_NOT_FINITE,
 *     PDN_ERR_VALUE (inverted or overlapping elements, too), PDN_ERR_MODEL (elements that turn too
 *     much)
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_add_shell_grid(struct pdn_model *model,
                                    const double *points,
                                    size_t count,
                                    size_t elements_u,
                                    size_t elements_v,
                                    size_t degree_u,
                                    size_t degree_v,
                                    int32_t join,
                                    const struct pdn_shell_section *section,
                                    const struct pdn_shell_placement *placement,
                                    struct pdn_shell *shell);

/**
 * Adds a shell element for each cell of a mesh of quadrilaterals, as mesh generators make them.
 *
 * A cell has four points, its corners in a row around it, seen from the side that the normal
 * points to; or nine: these, then the middles of its sides from the first corner to the second and
 * so on, then its centre. That is the order of Gmsh and VTK. With nine it is curved. xi is from
 * the first corner to the second, eta from there to the third. Cells that share a side have the
 * same nodes there; points that belong to no cell are left out. ::pdn_model_shell_node tells the
 * nodes.
 *
 * @param model  the model; not NULL
 * @param points  array of shape 3 x [point_count]: positions, global coordinates [length]
 * @param point_count  number of points
 * @param cells  array of length [count]: numbers of the points of each cell from 0 on, one cell
 *     after the other
 * @param count  how many these are: points_of_cell for each cell
 * @param points_of_cell  4 or 9
 * @param degree  polynomial degree of the elements in both directions, 1 to 15
 * @param section  the section; not NULL
 * @param placement  how it lies on the nodes; NULL for the defaults
 * @param first_element  id of the first element; the others follow in the order of the cells;
 *     written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_SIZE, PDN_ERR_ID, PDN_ERR_STRUCT_SIZE, PDN_ERR_NOT_FINITE,
 *     PDN_ERR_VALUE (inverted or overlapping elements, too), PDN_ERR_MODEL (elements that turn too
 *     much)
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_add_shell_quadrilaterals(struct pdn_model *model,
                                              const double *points,
                                              size_t point_count,
                                              const int32_t *cells,
                                              size_t count,
                                              size_t points_of_cell,
                                              size_t degree,
                                              const struct pdn_shell_section *section,
                                              const struct pdn_shell_placement *placement,
                                              int32_t *first_element);

/**
 * Node of a shell over a surface or a grid.
 *
 * @param model  the model; not NULL
 * @param shell  the shell, as the function that added it has written it; not NULL
 * @param u  number of the node along u, from 0 to nodes_u - 1
 * @param v  number of the node along v, from 0 to nodes_v - 1
 * @param node  the node's id; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID, PDN_ERR_VALUE
 *
 * Threads: `model` is `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_shell_patch_node(const struct pdn_model *model,
                                      const struct pdn_shell *shell,
                                      int32_t u,
                                      int32_t v,
                                      int32_t *node);

/**
 * Number of shell elements; their ids follow each other from PDN_FIRST_SHELL_ELEMENT on.
 *
 * @param model  the model; not NULL
 * @param count  the number; written on success only
 * @return PDN_OK, PDN_ERR_NULL
 *
 * Threads: `model` is `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_shell_element_count(const struct pdn_model *model,
                                         int32_t *count);

/**
 * Node of a shell element.
 *
 * @param model  the model; not NULL
 * @param element  id of the shell element
 * @param xi  number of the node along xi, from 0 where xi = -1
 * @param eta  number of the node along eta, from 0 where eta = -1
 * @param node  the node's id; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID, PDN_ERR_VALUE
 *
 * Threads: `model` is `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_shell_node(const struct pdn_model *model,
                                int32_t element,
                                int32_t xi,
                                int32_t eta,
                                int32_t *node);

/**
 * Adds one component of a force or moment on shell elements, in addition to those that are there:
 * for each unit of reference area, or of reference length of an edge.
 *
 * @param model  the model; not NULL
 * @param first_element  id of the first shell element
 * @param elements  number of elements, from the first on; at least 1
 * @param place  PDN_SHELL_SURFACE, PDN_SHELL_EDGE_START_ETA, PDN_SHELL_EDGE_END_XI,
 *     PDN_SHELL_EDGE_END_ETA or PDN_SHELL_EDGE_START_XI, of each of them
 * @param frame  PDN_FRAME_SPACE: directions of the global axes; PDN_FRAME_MATERIAL: of axes that
 *     follow the shell: on the surface those of the section, so that a pressure is PDN_FORCE_3, on
 *     an edge 1 along it, in the direction of xi or eta, 3 along the normal, and 2 = 3 * 1
 * @param component  PDN_FORCE_1, PDN_FORCE_2, PDN_FORCE_3 [force / length^2, or / length],
 *     PDN_MOMENT_1, PDN_MOMENT_2 or PDN_MOMENT_3 [times length]
 * @param signal  the component in time, copied; not NULL
 * @param load  the load's id, a shell load's; may be NULL if it is not wanted; written on success
 *     only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_SIZE, PDN_ERR_ID, PDN_ERR_VALUE,
 *     PDN_ERR_STRUCT_SIZE
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_add_shell_load(struct pdn_model *model,
                                    int32_t first_element,
                                    int32_t elements,
                                    int32_t place,
                                    int32_t frame,
                                    int32_t component,
                                    const struct pdn_signal *signal,
                                    int32_t *load);

/**
 * Gives shell elements forces and moments where nothing is strained: initial stress, in place of
 * any before.
 *
 * It makes them stiffer or softer, and moves them unless it is in equilibrium.
 *
 * @param model  the model; not NULL
 * @param first_element  id of the first shell element
 * @param elements  number of elements, from the first on; at least 1
 * @param resultants  array of length 12: along the axes of the section, in the order of
 *     ::pdn_shell_section [force / length, moment / length]
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_SIZE, PDN_ERR_ID
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_set_shell_prestress(struct pdn_model *model,
                                         int32_t first_element,
                                         int32_t elements,
                                         const double *resultants);

/**
 * Fixes nodes to a body, by a rigid joint each as ::pdn_model_add_rigid_joint makes: such as the
 * nodes along an edge of a shell, which then moves as a part of the body.
 *
 * The body is the first of each joint, whose frames are at the node. The body itself, if it is
 * among the nodes, and what a rigid joint fixes to it already, is left out, so that edges with a
 * common corner may be fixed to one body.
 *
 * @param model  the model; not NULL
 * @param body  id of the node that the others are fixed to: of a body, an end of a beam, or one of
 *     the nodes themselves; or PDN_GROUND
 * @param nodes  array of length [count]: ids of the nodes, all different
 * @param count  number of nodes, at least 1
 * @param first_joint  id of the first of the joints, which follow each other in the order of the
 *     nodes; written on success only
 * @param joints  number of joints; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_SIZE, PDN_ERR_ID, PDN_ERR_VALUE (a node twice, or none
 *     left to be fixed)
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_add_rigid_joints(struct pdn_model *model,
                                      int32_t body,
                                      const int32_t *nodes,
                                      size_t count,
                                      int32_t *first_joint,
                                      int32_t *joints);

/**
 * Fixes a whole edge of a shell over a surface or a grid to a body: ::pdn_model_add_rigid_joints
 * with the nodes along it.
 *
 * A rigid edge takes forces and couples in all directions, those about the normal too, from
 * bodies, beams and joints on the body.
 *
 * @param model  the model; not NULL
 * @param body  id of the node that the edge is fixed to: of a body, an end of a beam, or one of
 *     the edge; or PDN_GROUND
 * @param shell  the shell, as the function that added it has written it; not NULL
 * @param edge  PDN_SHELL_EDGE_START_ETA where v = 0, PDN_SHELL_EDGE_END_XI where u = 1,
 *     PDN_SHELL_EDGE_END_ETA where v = 1 or PDN_SHELL_EDGE_START_XI where u = 0
 * @param first_joint  id of the first of the joints, which follow each other in the order of the
 *     nodes along u or v; written on success only
 * @param joints  number of joints; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID, PDN_ERR_SIZE, PDN_ERR_VALUE (none left to be fixed,
 *     too)
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_add_rigid_edge(struct pdn_model *model,
                                    int32_t body,
                                    const struct pdn_shell *shell,
                                    int32_t edge,
                                    int32_t *first_joint,
                                    int32_t *joints);

/**
 * Number of forces: springs, dampers, actuators and the like, but not loads; their ids follow each
 * other from PDN_FIRST_FORCE on.
 *
 * @param model  the model; not NULL
 * @param count  the number; written on success only
 * @return PDN_OK, PDN_ERR_NULL
 *
 * Threads: `model` is `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_force_count(const struct pdn_model *model,
                                 int32_t *count);

/**
 * Adds a linear spring with a damper on a joint coordinate, in addition to those that are there.
 *
 * It resists with stiffness * (coordinate - rest) + damping * its rate: with a force on a
 * displacement, with a moment on an angle. Whole turns count.
 *
 * @param model  the model; not NULL
 * @param joint  id of the joint
 * @param coordinate  PDN_DISPLACEMENT, ... or PDN_ROTATION, ...; one that the joint has
 * @param stiffness  effort for a unit of the coordinate [force / length, or force * length]; may
 *     be negative
 * @param damping  effort for a unit of its rate [force * time / length, or force * length * time];
 *     may be negative, usually 0
 * @param rest  coordinate at which the spring is free of effort, usually 0 [length or radian]
 * @param force  the force's id; may be NULL if it is not wanted; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_ID, PDN_ERR_VALUE,
 *     PDN_ERR_NOT_AVAILABLE
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_add_spring_damper(struct pdn_model *model,
                                       int32_t joint,
                                       int32_t coordinate,
                                       double stiffness,
                                       double damping,
                                       double rest,
                                       int32_t *force);

/**
 * Adds a nonlinear spring with a damper on a joint coordinate: polynomials of the coordinate and
 * its rate.
 *
 * With u = coordinate - rest it resists with stiffness[0] u + stiffness[1] u^2 + ... + damping[0]
 * u' + damping[1] u'^2 + ..., so that {k, 0, k3} is a cubic spring. Whole turns count.
 *
 * @param model  the model; not NULL
 * @param joint  id of the joint
 * @param coordinate  PDN_DISPLACEMENT, ... or PDN_ROTATION, ...; one that the joint has
 * @param stiffness  array of length [stiffness_count], copied; may be NULL if there are none
 * @param stiffness_count  number of powers of the coordinate, from the first
 * @param damping  array of length [damping_count], copied; may be NULL if there are none
 * @param damping_count  number of powers of its rate, from the first
 * @param rest  coordinate at which the spring is free of effort, usually 0 [length or radian]
 * @param force  the force's id; may be NULL if it is not wanted; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_SIZE, PDN_ERR_NOT_FINITE, PDN_ERR_ID, PDN_ERR_VALUE,
 *     PDN_ERR_NOT_AVAILABLE
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_add_nonlinear_spring_damper(struct pdn_model *model,
                                                 int32_t joint,
                                                 int32_t coordinate,
                                                 const double *stiffness,
                                                 size_t stiffness_count,
                                                 const double *damping,
                                                 size_t damping_count,
                                                 double rest,
                                                 int32_t *force);

/**
 * Adds an actuator: a force on a displacement, or a torque on an angle, that follows a signal.
 *
 * It acts on the second body of the joint towards growth of the coordinate, and its reaction on
 * the first. To prescribe the coordinate itself, see ::pdn_model_prescribe.
 *
 * @param model  the model; not NULL
 * @param joint  id of the joint
 * @param coordinate  PDN_DISPLACEMENT, ... or PDN_ROTATION, ...; one that the joint has
 * @param signal  the effort in time [force, or force * length], copied; not NULL
 * @param force  the force's id; may be NULL if it is not wanted; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_SIZE, PDN_ERR_ID, PDN_ERR_VALUE,
 *     PDN_ERR_STRUCT_SIZE, PDN_ERR_NOT_AVAILABLE
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_add_actuator(struct pdn_model *model,
                                  int32_t joint,
                                  int32_t coordinate,
                                  const struct pdn_signal *signal,
                                  int32_t *force);

/**
 * Adds a viscoelastic element on a joint coordinate: a generalised Maxwell model.
 *
 * A spring, and beside it branches of spring and dashpot in series. With coordinate q it resists
 * with stiffness * (q - rest) + the sum over the branches b of branch_stiffness[b] a_b, where a_b,
 * the elongation of the branch's spring, relaxes: t_b a_b' + a_b = t_b q', with relaxation time
 * t_b. One branch makes it a Zener element, or standard linear solid. The internal states are
 * solved for with the motion, at the same grid points. Whole turns count; a coordinate that gains
 * turns needs stiffness 0.
 *
 * @param model  the model; not NULL
 * @param joint  id of the joint
 * @param coordinate  PDN_DISPLACEMENT, ... or PDN_ROTATION, ...; one that the joint has
 * @param stiffness  that of the spring alone, the long-term stiffness
 *     [force / length, or force * length]; may be negative
 * @param rest  coordinate at which it is free of effort [length or radian]
 * @param branch_stiffness  array of length [branches]: stiffness of each branch's spring, positive
 * @param relaxation_times  array of length [branches]: relaxation time of each branch, positive
 *     [time]
 * @param branches  number of branches, at least 1
 * @param force  the force's id; may be NULL if it is not wanted; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_SIZE, PDN_ERR_NOT_FINITE, PDN_ERR_ID, PDN_ERR_VALUE,
 *     PDN_ERR_NOT_AVAILABLE
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_add_viscoelastic(struct pdn_model *model,
                                      int32_t joint,
                                      int32_t coordinate,
                                      double stiffness,
                                      double rest,
                                      const double *branch_stiffness,
                                      const double *relaxation_times,
                                      size_t branches,
                                      int32_t *force);

/**
 * Adds a viscous damper between two bodies, with a full matrix of coefficients.
 *
 * It exerts -matrix * v on the second body, and the reaction on the first, where v is the velocity
 * (linear 1, 2, 3, angular 1, 2, 3) of the second body relative to the first, at the origin of a
 * frame that is fixed to the second body. Velocity, force and moment are about and resolved in
 * that frame, wherever it moves.
 *
 * @param model  the model; not NULL
 * @param first  id of the first node, or PDN_GROUND
 * @param second  id of the second node, or PDN_GROUND; not the same body
 * @param frame  the frame, where it is in the reference configuration; NULL for the second node's
 *     own
 * @param matrix  array of shape 6 x 6: symmetric and positive semi-definite [force * time /
 *     length, force * time, force * length * time]
 * @param force  the force's id; may be NULL if it is not wanted; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_ID, PDN_ERR_VALUE
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_add_viscous_damper(struct pdn_model *model,
                                        int32_t first,
                                        int32_t second,
                                        const struct pdn_frame *frame,
                                        const double *matrix,
                                        int32_t *force);

/**
 * Adds a bushing, a bearing or a seal: any matrices of stiffness and damping between two frames,
 * unsymmetric ones included.
 *
 * With e the displacement of the second frame's origin and the angles of its turn, both relative
 * to the first frame and along its axes, the efforts against e are f = stiffness e + damping e'.
 * The first three are forces along the axes of the first frame, that act at the second frame's
 * origin, on both bodies; the others are moments that do the work of the angles: for small turns
 * moments about the axes of the first frame. So the axes of a journal bearing, with axis 3 along
 * the shaft, are those of its housing if that is the first body.
 *
 * The matrices are column by column: stiffness[i + 6 j] is effort i for a unit of e[j]. Parameters
 * scale them: PDN_NUMBER_STIFFNESS and PDN_NUMBER_DAMPING with power 1 move a factor of each.
 *
 * @param model  the model; not NULL
 * @param first  id of the first node, or PDN_GROUND
 * @param second  id of the second node, or PDN_GROUND; not the same body
 * @param first_frame  frame fixed to the first body, where it is in the reference configuration;
 *     not NULL
 * @param second_frame  frame fixed to the second body, likewise; not NULL
 * @param stiffness  array of shape 6 x 6: stiffness [force / length, force, force * length]; with
 *     PDN_ANGLES_TILT_AND_SPIN its last column is zero
 * @param damping  array of shape 6 x 6: damping [the same times time]
 * @param angles  PDN_ANGLES_ROTATION_VECTOR or PDN_ANGLES_TILT_AND_SPIN
 * @param force  the force's id; may be NULL if it is not wanted; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_ID, PDN_ERR_VALUE
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_add_bushing(struct pdn_model *model,
                                 int32_t first,
                                 int32_t second,
                                 const struct pdn_frame *first_frame,
                                 const struct pdn_frame *second_frame,
                                 const double *stiffness,
                                 const double *damping,
                                 int32_t angles,
                                 int32_t *force);

/**
 * Adds a spring-damper on a joint coordinate whose law is a function of the caller.
 *
 * Its effort, a force on a displacement or a moment on an angle, resists growth of the coordinate
 * as that of ::pdn_model_add_spring_damper does. It may depend on coordinate, rate and time.
 *
 * @param model  the model; not NULL
 * @param joint  id of the joint
 * @param coordinate  PDN_DISPLACEMENT, ... or PDN_ROTATION, ...; one that the joint has
 * @param tangents  PDN_TANGENTS_GIVEN if the function writes derivatives, which
 *     ::pdn_model_check_tangents checks; PDN_TANGENTS_DIFFERENCED if the library is to find them
 *     by differences
 * @param function  the law, see ::pdn_coordinate_law_fn for when it is called; not NULL
 * @param user_data  handed to the function; may be NULL
 * @param destroy  called once with user_data when the model, its copies in solutions included, no
 *     longer needs it, on the thread that frees the last; may be NULL. It is not called if this
 *     call fails
 * @param force  the force's id; may be NULL if it is not wanted; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID, PDN_ERR_VALUE, PDN_ERR_NOT_AVAILABLE
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_add_coordinate_law(struct pdn_model *model,
                                        int32_t joint,
                                        int32_t coordinate,
                                        int32_t tangents,
                                        pdn_coordinate_law_fn function,
                                        void *user_data,
                                        pdn_destroy_fn destroy,
                                        int32_t *force);

/**
 * Adds forces on nodes that a function of the caller computes.
 *
 * @param model  the model; not NULL
 * @param nodes  array of length [count]: ids of the nodes, all different
 * @param count  number of nodes, at least 1
 * @param frame  PDN_FRAME_SPACE: velocities, forces and tangents are along the global axes;
 *     PDN_FRAME_MATERIAL: along those of each node
 * @param tangents  PDN_TANGENTS_GIVEN if the function writes tangents, which
 *     ::pdn_model_check_tangents checks; PDN_TANGENTS_DIFFERENCED if the library is to find them
 *     by differences, at the price of 24 calls a node, or 24 for all where
 *     ::pdn_model_declare_nodes_apart says that no node matters to others
 * @param function  the forces, see ::pdn_user_force_fn for when it is called; not NULL
 * @param user_data  handed to the function; may be NULL
 * @param destroy  called once with user_data when the model, its copies in solutions included, no
 *     longer needs it, on the thread that frees the last; may be NULL. It is not called if this
 *     call fails
 * @param force  the force's id; may be NULL if it is not wanted; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_SIZE, PDN_ERR_ID, PDN_ERR_VALUE
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_add_user_force(struct pdn_model *model,
                                    const int32_t *nodes,
                                    size_t count,
                                    int32_t frame,
                                    int32_t tangents,
                                    pdn_user_force_fn function,
                                    void *user_data,
                                    pdn_destroy_fn destroy,
                                    int32_t *force);

/**
 * Declares that the force on each node of a function's force depends on time and on the motion of
 * this node alone, as that of the air on points of a wing by strips does.
 *
 * Then the force couples no nodes with each other, so that solves take less time; tangents are of
 * each force by its own node (pdn_force_state), and differences of all nodes are found at once, by
 * 24 calls. Solves compare a few calls and refuse, with PDN_ERR_MODEL, forces that are not so.
 *
 * @param model  the model; not NULL
 * @param force  id of a force by ::pdn_model_add_user_force
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID, PDN_ERR_NOT_AVAILABLE (it is none of these)
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_declare_nodes_apart(struct pdn_model *model,
                                         int32_t force);

/**
 * Prepares a struct for ::pdn_model_check_tangents; use `PDN_INIT(pdn_tangent_check, &check)`.
 *
 * @param check  the struct; not NULL
 * @param struct_size  `sizeof *check`
 *
 * Threads: any.
 * @since 0.1
 */
PDN_API
void pdn_tangent_check_init(struct pdn_tangent_check *check,
                            size_t struct_size);

/**
 * Compares the tangents that a user's function gives with differences of its forces.
 *
 * At a few states: nodes near their reference configuration, or a coordinate near its own, with
 * velocities as they are in motions of the period; the same states in each call. Wrong tangents do
 * not make solutions wrong, but Newton's method slow, or fail.
 *
 * @param model  the model; not NULL
 * @param force  id of a force by ::pdn_model_add_coordinate_law, ::pdn_model_add_user_force,
 *     ::pdn_model_add_controller, ::pdn_model_add_surface_force or ::pdn_model_add_line_force
 * @param period  the period that the model is to be solved for, positive [time]
 * @param check  initialised by PDN_INIT; filled on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE, PDN_ERR_ID, PDN_ERR_VALUE,
 *     PDN_ERR_NOT_FINITE, PDN_ERR_MODEL, PDN_ERR_NOT_PERIODIC (as for a solve),
 *     PDN_ERR_NOT_AVAILABLE (it gives no tangents), PDN_ERR_CALLBACK
 *
 * Threads: like `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_check_tangents(const struct pdn_model *model,
                                    int32_t force,
                                    double period,
                                    struct pdn_tangent_check *check);

/**
 * Adds a controller: efforts on joint coordinates by a function of the caller that reads any joint
 * coordinates and their rates, and may have states of its own.
 *
 * Without states it is a law that reads other coordinates, such as the gas force on a piston by
 * the angle of the crank. States x follow x' = f(t, coordinates, rates, x), which the function
 * gives: integrals of controllers, filters, actuators that lag, inflow. They are solved for with
 * the motion in all analyses, and are among the states that multipliers and modes count.
 *
 * @param model  the model; not NULL
 * @param input_joints  array of length [input_count]: ids of the joints of the coordinates that
 *     are read; may be NULL if there are none
 * @param input_coordinates  array of length [input_count]: PDN_DISPLACEMENT ... PDN_ROTATION_3 of
 *     each, one that the joint has; each coordinate of a joint at most once; may be NULL if
 *     there are none
 * @param input_count  number of coordinates that are read
 * @param output_joints  array of length [output_count]: ids of the joints of the coordinates that
 *     it acts on
 * @param output_coordinates  array of length [output_count]: PDN_DISPLACEMENT ... PDN_ROTATION_3
 *     of each, as for what is read
 * @param output_count  number of coordinates that it acts on, at least 1
 * @param initial  array of length [state_count]: the states where a march begins; NULL for zero
 * @param sizes  array of length [state_count]: what each state is of the order of, positive, by
 *     which equations are scaled and differences taken; NULL for 1
 * @param state_count  number of states
 * @param tangents  PDN_TANGENTS_GIVEN if the function writes tangents, which
 *     ::pdn_model_check_tangents checks; PDN_TANGENTS_DIFFERENCED if the library is to find them
 *     by differences, with two calls for each coordinate, rate and state
 * @param function  the controller, see ::pdn_controller_fn for when it is called; not NULL
 * @param user_data  handed to the function; may be NULL
 * @param destroy  called once with user_data when the model, its copies in solutions included, no
 *     longer needs it, on the thread that frees the last; may be NULL. It is not called if this
 *     call fails
 * @param force  the force's id; may be NULL if it is not wanted; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_SIZE, PDN_ERR_NOT_FINITE, PDN_ERR_ID, PDN_ERR_VALUE,
 *     PDN_ERR_NOT_AVAILABLE
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_add_controller(struct pdn_model *model,
                                    const int32_t *input_joints,
                                    const int32_t *input_coordinates,
                                    size_t input_count,
                                    const int32_t *output_joints,
                                    const int32_t *output_coordinates,
                                    size_t output_count,
                                    const double *initial,
                                    const double *sizes,
                                    size_t state_count,
                                    int32_t tangents,
                                    pdn_controller_fn function,
                                    void *user_data,
                                    pdn_destroy_fn destroy,
                                    int32_t *force);

/**
 * Numbers of the coordinates that a controller reads, of those that it acts on, and of its states.
 *
 * @param model  the model; not NULL
 * @param force  id of a force by ::pdn_model_add_controller
 * @param input_count  number of coordinates that it reads; may be NULL
 * @param output_count  number of coordinates that it acts on; may be NULL
 * @param state_count  number of its states; may be NULL
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID, PDN_ERR_NOT_AVAILABLE (the force is no controller)
 *
 * Threads: `model` is `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_controller_counts(const struct pdn_model *model,
                                       int32_t force,
                                       int32_t *input_count,
                                       int32_t *output_count,
                                       int32_t *state_count);

/**
 * A coordinate that a controller reads or acts on.
 *
 * @param model  the model; not NULL
 * @param force  id of a force by ::pdn_model_add_controller
 * @param index  number of the coordinate, from 0: those that it reads, then those that it acts on
 * @param joint  id of its joint; written on success only
 * @param coordinate  the coordinate: PDN_DISPLACEMENT, ...; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID, PDN_ERR_NOT_AVAILABLE (the force is no controller)
 *
 * Threads: `model` is `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_controller_coordinate(const struct pdn_model *model,
                                           int32_t force,
                                           int32_t index,
                                           int32_t *joint,
                                           int32_t *coordinate);

/**
 * A state of a controller.
 *
 * @param model  the model; not NULL
 * @param force  id of a force by ::pdn_model_add_controller
 * @param index  number of the state, from 0
 * @param initial  its value where a march begins; may be NULL
 * @param size  what it is of the order of; may be NULL
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID, PDN_ERR_NOT_AVAILABLE (the force is no controller)
 *
 * Threads: `model` is `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_controller_state(const struct pdn_model *model,
                                      int32_t force,
                                      int32_t index,
                                      double *initial,
                                      double *size);

/**
 * Adds forces on shell elements that a function of the caller computes at the points of a
 * quadrature: a force, with an id of its own, for each element.
 *
 * They act on the reference surface of the element, or on an edge of it, as loads do
 * (::pdn_model_add_shell_load): at as many points as it has nodes there.
 *
 * @param model  the model; not NULL
 * @param first_element  id of the first shell element
 * @param elements  number of elements, from the first on; at least 1
 * @param place  PDN_SHELL_SURFACE, PDN_SHELL_EDGE_START_ETA, PDN_SHELL_EDGE_END_XI,
 *     PDN_SHELL_EDGE_END_ETA or PDN_SHELL_EDGE_START_XI, of each of them
 * @param frame  PDN_FRAME_SPACE: velocities, forces and tangents are along the global axes;
 *     PDN_FRAME_MATERIAL: along those of each point, so that a pressure is force 3 of a surface
 * @param tangents  PDN_TANGENTS_GIVEN if the function writes tangents, which
 *     ::pdn_model_check_tangents checks; PDN_TANGENTS_DIFFERENCED if the library is to find them
 *     by differences, at the price of 24 calls an element
 * @param function  the forces, see ::pdn_surface_force_fn for when it is called; not NULL
 * @param user_data  handed to the function; may be NULL
 * @param destroy  called once with user_data when the model, its copies in solutions included, no
 *     longer needs it, on the thread that frees the last; may be NULL. It is not called if this
 *     call fails
 * @param first_force  id of the force on the first element, which those on the others follow; may
 *     be NULL if it is not wanted; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_SIZE, PDN_ERR_ID, PDN_ERR_VALUE
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_add_surface_force(struct pdn_model *model,
                                       int32_t first_element,
                                       int32_t elements,
                                       int32_t place,
                                       int32_t frame,
                                       int32_t tangents,
                                       pdn_surface_force_fn function,
                                       void *user_data,
                                       pdn_destroy_fn destroy,
                                       int32_t *first_force);

/**
 * Adds forces along beam elements that a function of the caller computes at the points of a
 * quadrature, such as those of the air on a blade: a force, with an id of its own, for each
 * element.
 *
 * They act on the line of the beam, for each unit of its reference length, and move with the
 * sections, as loads do (::pdn_model_add_distributed_load): at as many points of Gauss as the
 * element has nodes. These are more while the error of the mesh is estimated, with elements of a
 * higher degree under the same ids. ::pdn_model_bind_surface_force gives a model from a file the
 * function again.
 *
 * @param model  the model; not NULL
 * @param first_element  id of the first beam element, such as the first_element of a ::pdn_beam
 * @param elements  number of elements, from the first on, such as the elements of a ::pdn_beam; at
 *     least 1
 * @param frame  PDN_FRAME_SPACE: velocities, forces and tangents are along the global axes;
 *     PDN_FRAME_MATERIAL: along those of the section at each point, twisted as they are;
 *     PDN_FRAME_UNTWISTED: along the axes of ::pdn_model_add_load_at_places, which rotations of
 *     the points are then of, too
 * @param axis_2  array of length 3: direction, global coordinates, of any nonzero length, nowhere
 *     along the line; read for PDN_FRAME_UNTWISTED only, else it may be NULL
 * @param tangents  PDN_TANGENTS_GIVEN if the function writes tangents, which
 *     ::pdn_model_check_tangents checks; PDN_TANGENTS_DIFFERENCED if the library is to find them
 *     by differences, at the price of 24 calls an element
 * @param function  the forces, see ::pdn_surface_force_fn for when it is called; not NULL
 * @param user_data  handed to the function; may be NULL
 * @param destroy  called once with user_data when the model, its copies in solutions included, no
 *     longer needs it, on the thread that frees the last; may be NULL. It is not called if this
 *     call fails
 * @param first_force  id of the force on the first element, which those on the others follow; may
 *     be NULL if it is not wanted; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_SIZE, PDN_ERR_ID, PDN_ERR_VALUE
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_add_line_force(struct pdn_model *model,
                                    int32_t first_element,
                                    int32_t elements,
                                    int32_t frame,
                                    const double *axis_2,
                                    int32_t tangents,
                                    pdn_surface_force_fn function,
                                    void *user_data,
                                    pdn_destroy_fn destroy,
                                    int32_t *first_force);

/**
 * Gives a controller its function, or another one: that of a model from a file is not there.
 *
 * @param model  the model; not NULL
 * @param force  id of a force by ::pdn_model_add_controller; ::pdn_model_find_label finds it by
 *     its label
 * @param tangents  PDN_TANGENTS_GIVEN or PDN_TANGENTS_DIFFERENCED
 * @param function  the controller, see ::pdn_controller_fn for when it is called; not NULL
 * @param user_data  handed to the function; may be NULL
 * @param destroy  called once with user_data as in ::pdn_model_add_controller; may be NULL. It is
 *     not called if this call fails
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID, PDN_ERR_VALUE, PDN_ERR_NOT_AVAILABLE (the force is no
 *     controller)
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_bind_controller(struct pdn_model *model,
                                     int32_t force,
                                     int32_t tangents,
                                     pdn_controller_fn function,
                                     void *user_data,
                                     pdn_destroy_fn destroy);

/**
 * Gives a coordinate law its function, or another one: that of a model from a file is not there.
 *
 * @param model  the model; not NULL
 * @param force  id of a force by ::pdn_model_add_coordinate_law; ::pdn_model_find_label finds it
 *     by its label
 * @param tangents  PDN_TANGENTS_GIVEN or PDN_TANGENTS_DIFFERENCED
 * @param function  the law, see ::pdn_coordinate_law_fn for when it is called; not NULL
 * @param user_data  handed to the function; may be NULL
 * @param destroy  called once with user_data as in ::pdn_model_add_coordinate_law; may be NULL.
 *     It is not called if this call fails
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID, PDN_ERR_VALUE, PDN_ERR_NOT_AVAILABLE (the force is no
 *     coordinate law)
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_bind_coordinate_law(struct pdn_model *model,
                                         int32_t force,
                                         int32_t tangents,
                                         pdn_coordinate_law_fn function,
                                         void *user_data,
                                         pdn_destroy_fn destroy);

/**
 * Gives forces on nodes their function, or another one: that of a model from a file is not there.
 *
 * @param model  the model; not NULL
 * @param force  id of a force by ::pdn_model_add_user_force; ::pdn_model_find_label finds it by
 *     its label
 * @param frame  PDN_FRAME_SPACE or PDN_FRAME_MATERIAL, as in ::pdn_model_add_user_force
 * @param tangents  PDN_TANGENTS_GIVEN or PDN_TANGENTS_DIFFERENCED
 * @param function  the forces, see ::pdn_user_force_fn for when it is called; not NULL
 * @param user_data  handed to the function; may be NULL
 * @param destroy  called once with user_data as in ::pdn_model_add_user_force; may be NULL. It is
 *     not called if this call fails
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID, PDN_ERR_VALUE, PDN_ERR_NOT_AVAILABLE (the force is
 *     none on nodes by a function)
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_bind_user_force(struct pdn_model *model,
                                     int32_t force,
                                     int32_t frame,
                                     int32_t tangents,
                                     pdn_user_force_fn function,
                                     void *user_data,
                                     pdn_destroy_fn destroy);

/**
 * Gives forces on shell or beam elements their function, or another one: that of a model from a
 * file is not there.
 *
 * @param model  the model; not NULL
 * @param first_force  id of the first of the forces, by ::pdn_model_add_surface_force or
 *     ::pdn_model_add_line_force; ::pdn_model_find_label finds it by its label
 * @param forces  number of forces, in order: one on each element, at least 1
 * @param frame  PDN_FRAME_SPACE or PDN_FRAME_MATERIAL, as in ::pdn_model_add_surface_force; the
 *     latter, too, of forces along beams with PDN_FRAME_UNTWISTED, whose axes the model keeps
 * @param tangents  PDN_TANGENTS_GIVEN or PDN_TANGENTS_DIFFERENCED
 * @param function  the forces, see ::pdn_surface_force_fn for when it is called; not NULL
 * @param user_data  handed to the function; may be NULL
 * @param destroy  called once with user_data as in ::pdn_model_add_surface_force; may be NULL. It
 *     is not called if this call fails
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_SIZE, PDN_ERR_ID, PDN_ERR_VALUE, PDN_ERR_NOT_AVAILABLE
 *     (one of the forces is none on a shell or beam by a function)
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_bind_surface_force(struct pdn_model *model,
                                        int32_t first_force,
                                        int32_t forces,
                                        int32_t frame,
                                        int32_t tangents,
                                        pdn_surface_force_fn function,
                                        void *user_data,
                                        pdn_destroy_fn destroy);

/**
 * Gives what follows a signal another one: a load, an actuator, a prescribed coordinate. In a
 * model from a file this brings back signals by functions, too.
 *
 * Parts of it that parameters move have the parameters' values again.
 *
 * @param model  the model; not NULL
 * @param id  what has the signal, as in ::pdn_model_move_signal
 * @param component  of a load PDN_FORCE_1, ... or PDN_MOMENT_3, one that has a signal; of gravity
 *     from 0 to 2; 0 for all else
 * @param signal  the other signal, copied; not NULL
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_ID, PDN_ERR_VALUE,
 *     PDN_ERR_NOT_AVAILABLE (it has no such signal)
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_set_signal(struct pdn_model *model,
                                int32_t id,
                                int32_t component,
                                const struct pdn_signal *signal);

/**
 * Gives a force other numbers of a sort, as many as it has: those that ::pdn_model_force_number
 * tells.
 *
 * @param model  the model; not NULL
 * @param force  id of the force
 * @param number  PDN_NUMBER_STIFFNESS, PDN_NUMBER_DAMPING, PDN_NUMBER_RELAXATION_TIME or
 *     PDN_NUMBER_REST
 * @param values  array of length [count]: the numbers, in the order of ::pdn_model_force_number
 * @param count  how many; pdn_force_info tells how many the force has; of PDN_NUMBER_REST 1
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_SIZE, PDN_ERR_NOT_FINITE, PDN_ERR_ID, PDN_ERR_VALUE (a
 *     parameter moves such a number of the force, or the numbers are none of such a force)
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_set_force_numbers(struct pdn_model *model,
                                       int32_t force,
                                       int32_t number,
                                       const double *values,
                                       size_t count);

/**
 * Gives a load, on a node, at a point, along beam elements or on shell elements, another frame;
 * its signals stay.
 *
 * @param model  the model; not NULL
 * @param load  id of the load, beam load or shell load
 * @param frame  PDN_FRAME_SPACE or PDN_FRAME_MATERIAL; along beams also PDN_FRAME_UNTWISTED
 * @param axis_2  array of length 3: as in ::pdn_model_add_load_at_places; read for
 *     PDN_FRAME_UNTWISTED only, else it may be NULL
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_ID, PDN_ERR_VALUE
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_set_load_frame(struct pdn_model *model,
                                    int32_t load,
                                    int32_t frame,
                                    const double *axis_2);

/**
 * Gives beam elements another section, the same all along them; their twist stays, and so do the
 * factors of parameters.
 *
 * @param model  the model; not NULL
 * @param first_element  id of the first beam element
 * @param elements  number of elements, in order, at least 1
 * @param section  the section; with mass where the elements' have some, without where they have
 *     none; not NULL
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE, PDN_ERR_SIZE, PDN_ERR_NOT_FINITE,
 *     PDN_ERR_ID, PDN_ERR_VALUE
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_set_beam_section(struct pdn_model *model,
                                      int32_t first_element,
                                      int32_t elements,
                                      const struct pdn_section *section);

/**
 * Gives shell elements another section; frames, offset and the direction of its axes stay, and so
 * do the factors of parameters.
 *
 * @param model  the model; not NULL
 * @param first_element  id of the first shell element
 * @param elements  number of elements, in order, at least 1
 * @param section  the section; with mass where the elements' have some, without where they have
 *     none; not NULL
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE, PDN_ERR_SIZE, PDN_ERR_NOT_FINITE,
 *     PDN_ERR_ID, PDN_ERR_VALUE
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_set_shell_section(struct pdn_model *model,
                                       int32_t first_element,
                                       int32_t elements,
                                       const struct pdn_shell_section *section);

/**
 * Gives a rigid body, or a mass or inertia on a node, another inertia; the factor of a parameter
 * stays.
 *
 * @param model  the model; not NULL
 * @param inertia  id of the inertia, as ::pdn_model_inertia_of tells of a rigid body
 * @param matrix  array of shape 6 x 6: inertia about the node, along its axes, as in
 *     ::pdn_model_add_inertia, symmetric and positive semi-definite
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_ID, PDN_ERR_VALUE
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_set_inertia(struct pdn_model *model,
                                 int32_t inertia,
                                 const double *matrix);

/**
 * Gives a node, joint, element, force, load or the like a label, in place of the one that it has.
 *
 * Messages and reports name it after its number, as in: joint 3 "crank pin". Labels are saved and
 * copied with the model, and solutions keep those that it has when it is solved.
 *
 * @param model  the model; not NULL
 * @param id  its id
 * @param label  text in UTF-8 of at most PDN_LABEL_LENGTH bytes, without quotes (") and control
 *     characters, that no other object of this kind has; empty or NULL to take the label away
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID, PDN_ERR_VALUE
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_set_label(struct pdn_model *model,
                               int32_t id,
                               const char *label);

/**
 * The label of a node, joint, element, force, load or the like.
 *
 * @param model  the model; not NULL
 * @param id  its id
 * @param buffer  array of length [capacity] for the label, UTF-8, always ended by NUL; may be NULL
 *     if capacity is 0
 * @param capacity  size of buffer in bytes
 * @return length of the label without the NUL, as snprintf does; 0 if there is none, or if
 *     the handle or id is not valid, see ::pdn_last_error
 *
 * Threads: `model` is `const`.
 * @since 0.1
 */
PDN_API
size_t pdn_model_label(const struct pdn_model *model,
                       int32_t id,
                       char *buffer,
                       size_t capacity);

/**
 * The node, joint, element, force, load or the like that has a label.
 *
 * @param model  the model; not NULL
 * @param kind  PDN_OBJECT_NODE to PDN_OBJECT_PRESCRIBED
 * @param label  the label; not NULL
 * @param id  its id; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_VALUE, PDN_ERR_NOT_AVAILABLE (none has this label)
 *
 * Threads: `model` is `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_find_label(const struct pdn_model *model,
                                int32_t kind,
                                const char *label,
                                int32_t *id);

/**
 * Frees a solution; NULL does nothing.
 *
 * @param solution  the solution, not to be used any more
 *
 * Threads: exclusive use of `solution`.
 * @since 0.1
 */
PDN_API
void pdn_solution_free(struct pdn_solution *solution);

/**
 * How the solve ended.
 *
 * Unless it is PDN_CONVERGED or PDN_TOLERANCE_NOT_MET the solution's quantities are those of the
 * last iterate.
 *
 * @param solution  the solution; not NULL
 * @return PDN_CONVERGED, PDN_ITERATION_LIMIT, PDN_STALLED, PDN_SINGULAR, PDN_CANCELLED,
 *     PDN_NO_INITIAL_GUESS, PDN_INCONSISTENT, PDN_WRONG_ASSEMBLY, PDN_TOLERANCE_NOT_MET or
 *     PDN_WORK_LIMIT; negative, as a ::pdn_status, if the handle is not valid
 *
 * Threads: like `const`.
 * @since 0.1
 */
PDN_API
int32_t pdn_solution_outcome(const struct pdn_solution *solution);

/**
 * A readable report: outcome and why, iterations, error estimates, time spent.
 *
 * @param solution  the solution; not NULL
 * @param buffer  array of length [capacity] for the text, UTF-8, always ended by NUL; may be NULL
 *     if capacity is 0
 * @param capacity  size of buffer in bytes
 * @return length of the whole report without the NUL, as snprintf does; 0 if the handle is not
 *     valid
 *
 * Threads: like `const`.
 * @since 0.1
 */
PDN_API
size_t pdn_solution_report(const struct pdn_solution *solution,
                           char *buffer,
                           size_t capacity);

/**
 * The report as JSON, for programs: an object with the texts `kind`, `outcome`, `explanation` and
 * `report`; sizes; `grids` and `attempts`; the Newton `iterations`; `estimates`, named as in
 * pdn_diagnostics; what iteration of `linear` equations took; and `seconds`. What is not known, or
 * does not apply, is null.
 *
 * @param solution  the solution; not NULL
 * @param buffer  array of length [capacity] for the text, UTF-8, always ended by NUL; may be NULL
 *     if capacity is 0
 * @param capacity  size of buffer in bytes
 * @return length of the whole text without the NUL, as snprintf does; 0 if the handle is not valid
 *
 * Threads: like `const`.
 * @since 0.1
 */
PDN_API
size_t pdn_solution_report_json(const struct pdn_solution *solution,
                                char *buffer,
                                size_t capacity);

/**
 * Prepares a struct for ::pdn_solution_diagnostics; use `PDN_INIT(pdn_diagnostics, &diagnostics)`.
 *
 * @param diagnostics  the struct; not NULL
 * @param struct_size  `sizeof *diagnostics`
 *
 * Threads: any.
 * @since 0.1
 */
PDN_API
void pdn_diagnostics_init(struct pdn_diagnostics *diagnostics,
                          size_t struct_size);

/**
 * Figures of a solve: iterations, error estimates, residuals between grid points, time spent.
 *
 * @param solution  the solution; not NULL
 * @param out  initialised by PDN_INIT; filled on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE
 *
 * Threads: like `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_solution_diagnostics(const struct pdn_solution *solution,
                                    struct pdn_diagnostics *out);

/**
 * History of the Newton iterations of the periodic problem.
 *
 * @param solution  the solution; not NULL
 * @param residuals  array of length [count] for the largest residual before each iteration; may be
 *     NULL
 * @param increments  array of length [count] for the largest increment of each; may be NULL
 * @param steps  array of length [count] for the fraction of the increment taken; may be NULL
 * @param count  number of iterations, as pdn_diagnostics.iterations tells
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_SIZE, PDN_ERR_OVERFLOW
 *
 * Threads: like `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_solution_history(const struct pdn_solution *solution,
                                double *residuals,
                                double *increments,
                                double *steps,
                                size_t count);

/**
 * Decay of the harmonics: largest amplitude of each over all nodes, of positions relative to the
 * size of the mechanism and of entries of rotation matrices.
 *
 * @param solution  the solution; not NULL
 * @param amplitudes  array of length [count], harmonics 0, 1, ..., (N - 1) / 2
 * @param count  (pdn_diagnostics.grid_points + 1) / 2
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_SIZE, PDN_ERR_OVERFLOW
 *
 * Threads: like `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_solution_decay(const struct pdn_solution *solution,
                              double *amplitudes,
                              size_t count);

/**
 * Number of events that the grid points of a solution are closer together about: 0 if they are
 * equispaced.
 *
 * @param solution  the solution; not NULL
 * @param out  the number; written on success only
 * @return PDN_OK, PDN_ERR_NULL
 *
 * Threads: like `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_solution_sharp_event_count(const struct pdn_solution *solution,
                                          size_t *out);

/**
 * Events that the grid points of a solution are closer together about, those of
 * pdn_periodic_options or such as a solve to a tolerance has found.
 *
 * @param solution  the solution; not NULL
 * @param times  array of length [count]: their times
 * @param widths  array of length [count]: half-widths of the additional density of grid points
 * @param shares  array of length [count]: shares of the grid points, beside 1 for the rest
 * @param count  their number, of ::pdn_solution_sharp_event_count
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_SIZE
 *
 * Threads: like `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_solution_sharp_events(const struct pdn_solution *solution,
                                     double *times,
                                     double *widths,
                                     double *shares,
                                     size_t count);

/**
 * Grid times t_k = k T / N, unless grid points are closer together about events; of a march the
 * times of its steps, from the start.
 *
 * @param solution  the solution; not NULL
 * @param times  array of length [count]
 * @param count  N, the number of grid points, as pdn_diagnostics.grid_points tells
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_SIZE
 *
 * Threads: like `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_solution_grid_times(const struct pdn_solution *solution,
                                   double *times,
                                   size_t count);

/**
 * Prepares a struct that tells a quantity; use `PDN_INIT(pdn_quantity, &quantity)`.
 *
 * @param quantity  the struct; not NULL
 * @param struct_size  `sizeof *quantity`
 *
 * Threads: any.
 * @since 0.1
 */
PDN_API
void pdn_quantity_init(struct pdn_quantity *quantity,
                       size_t struct_size);

/**
 * Number of components that are asked for: of values at a time, of means and of harmonics.
 *
 * @param quantity  initialised by PDN_INIT; not NULL
 * @return the number; negative, as a ::pdn_status (PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE, PDN_ERR_ID,
 *     PDN_ERR_VALUE), if there is no such quantity
 *
 * Threads: any.
 * @since 0.1
 */
PDN_API
int32_t pdn_quantity_components(const struct pdn_quantity *quantity);

/**
 * A quantity of a solution at any times.
 *
 * Motions of nodes are interpolated over the whole period by dual polar decomposition, all else
 * from its values at the grid points.
 *
 * @param solution  the solution; not NULL
 * @param quantity  what is asked for, C components; initialised by PDN_INIT; not NULL
 * @param times  array of length [count]: times, also outside the first period
 * @param count  number of times
 * @param out  array of shape C x [count], components of each time together
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE, PDN_ERR_NOT_FINITE, PDN_ERR_ID,
 *     PDN_ERR_VALUE, PDN_ERR_NOT_AVAILABLE, PDN_ERR_GRID_TOO_COARSE, PDN_ERR_OVERFLOW
 *
 * Threads: like `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_solution_sample(const struct pdn_solution *solution,
                               const struct pdn_quantity *quantity,
                               const double *times,
                               size_t count,
                               double *out);

/**
 * Fourier coefficients of a quantity: mean + rate t + sum of cosines[j] cos jwt + sines[j] sin
 * jwt.
 *
 * Those of the trigonometric polynomial through the values at the grid points.
 *
 * @param solution  the solution; not NULL
 * @param quantity  what is asked for, C components; initialised by PDN_INIT; not NULL
 * @param harmonics  number of harmonics wanted; those above (N - 1) / 2 are zero
 * @param mean  array of length C; may be NULL
 * @param rate  array of length C: growth per unit of time, of what gains turns; may be NULL
 * @param cosines  array of shape C x [harmonics], components of each harmonic together; may be
 *     NULL
 * @param sines  array of shape C x [harmonics], components of each harmonic together; may be NULL
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE, PDN_ERR_SIZE, PDN_ERR_NOT_FINITE, PDN_ERR_ID,
 *     PDN_ERR_VALUE, PDN_ERR_NOT_AVAILABLE (of a trajectory; the quaternion of a node that makes
 *     an odd number of turns), PDN_ERR_OVERFLOW
 *
 * Threads: like `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_solution_harmonics(const struct pdn_solution *solution,
                                  const struct pdn_quantity *quantity,
                                  size_t harmonics,
                                  double *mean,
                                  double *rate,
                                  double *cosines,
                                  double *sines);

/**
 * Smallest and largest values of a quantity, and their times.
 *
 * Over the period, of the trigonometric polynomial through the values at the grid points; of a
 * trajectory, among its times.
 *
 * @param solution  the solution; not NULL
 * @param quantity  what is asked for, C components; initialised by PDN_INIT; not NULL
 * @param smallest  array of length C; may be NULL
 * @param time_of_smallest  array of length C; may be NULL
 * @param largest  array of length C; may be NULL
 * @param time_of_largest  array of length C; may be NULL
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE, PDN_ERR_NOT_FINITE, PDN_ERR_ID,
 *     PDN_ERR_VALUE, PDN_ERR_NOT_AVAILABLE, PDN_ERR_OVERFLOW
 *
 * Threads: like `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_solution_extremes(const struct pdn_solution *solution,
                                 const struct pdn_quantity *quantity,
                                 double *smallest,
                                 double *time_of_smallest,
                                 double *largest,
                                 double *time_of_largest);

/**
 * Adds the columns of a quantity of a solution, named by the label and the component; or that of
 * one component, named by the label alone.
 *
 * @param table  the table; not NULL
 * @param solution  the solution; not NULL
 * @param quantity  what is asked for; one column for each component; initialised by PDN_INIT; not
 *     NULL
 * @param label  columns are called `label.x` and so on; NULL for a name such as `node3.position`
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE, PDN_ERR_NOT_FINITE, PDN_ERR_ID,
 *     PDN_ERR_VALUE (also of a name that a column has already), PDN_ERR_NOT_AVAILABLE,
 *     PDN_ERR_GRID_TOO_COARSE, PDN_ERR_OVERFLOW
 *
 * Threads: exclusive use of `table`; like `const` of `solution`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_table_add_quantity(struct pdn_table *table,
                                  const struct pdn_solution *solution,
                                  const struct pdn_quantity *quantity,
                                  const char *label);

/**
 * A copy of a solution whose quantities are seen through a spectral filter.
 *
 * Where a response has a kink or a narrow peak (PDN_DECAY_SLOW), forces oscillate about their
 * values over the whole period, as all Fourier sums do (Gibbs). A filter weakens the harmonics
 * towards the highest: the oscillations stay near the peak, which itself gets lower and wider.
 * Without one, nothing is filtered.
 *
 * It acts on values at any time, on harmonics, tables and animations. The motions of nodes are
 * filtered as motions, and velocities follow from them. The solve, its diagnostics and report, and
 * what starts from the copy are those of the solution. A filter that the solution has already is
 * replaced.
 *
 * @param solution  the solution; not NULL. The copy is one of its own, which may outlive it
 * @param filter  PDN_FILTER_LANCZOS or PDN_FILTER_EXPONENTIAL
 * @param order  from 1 to 32
 * @param out  the copy; free it with ::pdn_solution_free; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_VALUE, PDN_ERR_NOT_AVAILABLE (a march has no harmonics),
 *     PDN_ERR_MEMORY
 *
 * Threads: like a `const` use of `solution`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_solution_filtered(const struct pdn_solution *solution,
                                 int32_t filter,
                                 int32_t order,
                                 struct pdn_solution **out);

/**
 * Sets default options; use `PDN_INIT(pdn_periodic_options, &options)`.
 *
 * @param options  the options; not NULL
 * @param struct_size  `sizeof *options`
 *
 * Threads: any.
 * @since 0.1
 */
PDN_API
void pdn_periodic_options_init(struct pdn_periodic_options *options,
                               size_t struct_size);

/**
 * Finds the periodic response of a model directly, by Fourier spectral collocation.
 *
 * Newton's method with the exact tangent on the equations of motion at N times of a period, from
 * the quasi-static motion unless another start is given; where inertia takes the response far from
 * that, or N is large, from a solution on fewer points. Unless N is given, it is raised, each
 * solution starting the next, until the estimated error meets the tolerance. Not converging is no
 * error: PDN_OK says that the solve was carried out, ::pdn_solution_outcome how it ended,
 * ::pdn_solution_report why.
 *
 * @param model  the model; it is copied, so that later changes do not touch the solution
 * @param period  T, the period of the response; harmonics of signals are those of this period
 * @param options  may be NULL for the defaults
 * @param out  the solution, also if it has not converged; free it with ::pdn_solution_free;
 *     written on success only
 * @return PDN_OK; PDN_ERR_NULL; PDN_ERR_NOT_FINITE; PDN_ERR_SIZE (even number of grid points,
 *     a start of arrays without their number, events that are too many); PDN_ERR_VALUE;
 *     PDN_ERR_STRUCT_SIZE; PDN_ERR_MODEL (no node, a beam too distorted);
 *     PDN_ERR_NOT_PERIODIC (a prescribed motion or load that does not repeat, a spring on an
 *     angle that gains turns); PDN_ERR_GRID_TOO_COARSE (of the initial solution);
 *     PDN_ERR_CALLBACK (of a signal); PDN_ERR_OVERFLOW (numbers too large to compute with);
 *     PDN_ERR_MEMORY
 *
 * Threads: like a `const` use of `model` and of `options.initial`. Signals' functions and
 * `progress` are called on this thread.
 * @since 0.1
 */
PDN_API
pdn_status pdn_solve_periodic(const struct pdn_model *model,
                              double period,
                              const struct pdn_periodic_options *options,
                              struct pdn_solution **out);

/**
 * Sets default options; use `PDN_INIT(pdn_equations_options, &options)`.
 *
 * @param options  the options; not NULL
 * @param struct_size  `sizeof *options`
 *
 * Threads: any.
 * @since 0.1
 */
PDN_API
void pdn_equations_options_init(struct pdn_equations_options *options,
                                size_t struct_size);

/**
 * Sets `struct_size`; use `PDN_INIT(pdn_equations_sizes, &sizes)`.
 *
 * @param sizes  the sizes; not NULL
 * @param struct_size  `sizeof *sizes`
 *
 * Threads: any.
 * @since 0.1
 */
PDN_API
void pdn_equations_sizes_init(struct pdn_equations_sizes *sizes,
                              size_t struct_size);

/**
 * Makes the equations of a periodic motion on a grid, or a rank's part. By all ranks.
 *
 * @param model  the model; it is copied
 * @param period  T, the period of the response
 * @param options  not NULL, as the number of grid points has no default. Model, period, grid,
 *     owners, preconditioner and start must be the same on all ranks, which is checked
 * @param out  the equations at the start; free them with ::pdn_equations_free; written on success
 *     only
 * @return PDN_OK; PDN_ERR_NULL; PDN_ERR_NOT_FINITE; PDN_ERR_SIZE (even number of grid points,
 *     owners for another number of nodes); PDN_ERR_VALUE (what is not the same on all ranks, more
 *     ranks than nodes, a rank without nodes); PDN_ERR_STRUCT_SIZE; PDN_ERR_MODEL;
 *     PDN_ERR_NOT_PERIODIC; PDN_ERR_GRID_TOO_COARSE (of the initial solution); PDN_ERR_CALLBACK;
 *     PDN_ERR_OVERFLOW; PDN_ERR_MEMORY
 *
 * Threads: like a `const` use of `model` and of `options.initial`. Functions of signals and forces
 * and those of `options` are called on this thread, the latter in later calls, too.
 * @since 0.1
 */
PDN_API
pdn_status pdn_equations_new(const struct pdn_model *model,
                             double period,
                             const struct pdn_equations_options *options,
                             struct pdn_equations **out);

/**
 * Frees equations; NULL does nothing. By this rank alone.
 *
 * @param equations  the equations, not to be used any more
 *
 * Threads: exclusive use of `equations`.
 * @since 0.1
 */
PDN_API
void pdn_equations_free(struct pdn_equations *equations);

/**
 * Sizes of the equations, and of the vectors of this rank. By this rank alone.
 *
 * @param equations  the equations; not NULL
 * @param out  the sizes, initialised by `PDN_INIT(pdn_equations_sizes, &sizes)`; written on
 *     success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE, PDN_ERR_VALUE (a handle in use)
 *
 * Threads: exclusive use of `equations`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_equations_get_sizes(const struct pdn_equations *equations,
                                   struct pdn_equations_sizes *out);

/**
 * Nodes of this rank, in the order of its vectors. By this rank alone.
 *
 * @param equations  the equations; not NULL
 * @param out  array of length [count]
 * @param count  pdn_equations_sizes.nodes
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_SIZE, PDN_ERR_VALUE (a handle in use)
 *
 * Threads: exclusive use of `equations`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_equations_nodes(const struct pdn_equations *equations,
                               int32_t *out,
                               size_t count);

/**
 * Numbers of this rank's unknowns among those of all ranks: in the order that one rank alone has
 * them in, from 0. By this rank alone.
 *
 * @param equations  the equations; not NULL
 * @param out  array of length [count]
 * @param count  pdn_equations_sizes.size
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_SIZE, PDN_ERR_VALUE (a handle in use)
 *
 * Threads: exclusive use of `equations`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_equations_numbers(const struct pdn_equations *equations,
                                 size_t *out,
                                 size_t count);

/**
 * The present motions of this rank's nodes, and own unknowns of its elements. By this rank alone.
 *
 * @param equations  the equations; not NULL
 * @param motions  array of length [motion_count]: node by node, at one grid point after the other,
 *     position (3, inertial frame \[length\]), then rotation matrix (9, column by column)
 * @param motion_count  pdn_equations_sizes.motions
 * @param own_unknowns  array of length [own_count]: multipliers \[force or moment\] and internal
 *     states \[length or angle\], in the order of vectors
 * @param own_count  pdn_equations_sizes.own_unknowns
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_SIZE, PDN_ERR_VALUE (a handle in use)
 *
 * Threads: exclusive use of `equations`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_equations_state(const struct pdn_equations *equations,
                               double *motions,
                               size_t motion_count,
                               double *own_unknowns,
                               size_t own_count);

/**
 * Sets motions and own unknowns, as ::pdn_equations_state gives them. By all ranks.
 *
 * Angles of joints are followed from what they were, by less than half a turn.
 *
 * @param equations  the equations; not NULL
 * @param motions  array of length [motion_count]; what are to be rotation matrices are cleaned of
 *     rounding
 * @param motion_count  pdn_equations_sizes.motions
 * @param own_unknowns  array of length [own_count]
 * @param own_count  pdn_equations_sizes.own_unknowns
 * @return PDN_OK; PDN_ERR_NULL and PDN_ERR_VALUE (a handle in use), on this rank alone;
 *     PDN_ERR_NOT_FINITE, PDN_ERR_SIZE, PDN_ERR_VALUE (no rotation matrix), PDN_ERR_CALLBACK
 *
 * Threads: exclusive use of `equations`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_equations_set_state(struct pdn_equations *equations,
                                   const double *motions,
                                   size_t motion_count,
                                   const double *own_unknowns,
                                   size_t own_count);

/**
 * The scaled residual at the present state. By all ranks.
 *
 * Forces are relative to the characteristic force, moments to it times the characteristic length,
 * lengths of constraints to that.
 *
 * @param equations  the equations; not NULL
 * @param out  array of length [count]; written on success only
 * @param count  pdn_equations_sizes.size
 * @return PDN_OK; PDN_ERR_NULL and PDN_ERR_VALUE (a handle in use), on this rank alone;
 *     PDN_ERR_SIZE, PDN_ERR_MODEL (an element too distorted), PDN_ERR_CALLBACK
 *
 * Threads: exclusive use of `equations`; functions of forces are called on this thread.
 * @since 0.1
 */
PDN_API
pdn_status pdn_equations_residual(struct pdn_equations *equations,
                                  double *out,
                                  size_t count);

/**
 * Linearises the equations at the present state, which ::pdn_equations_update then begins at. By
 * all ranks.
 *
 * @param equations  the equations; not NULL
 * @return PDN_OK; PDN_ERR_NULL and PDN_ERR_VALUE (a handle in use), on this rank alone;
 *     PDN_ERR_MODEL (an element too distorted), PDN_ERR_CALLBACK
 *
 * Threads: exclusive use of `equations`; functions of forces are called on this thread.
 * @since 0.1
 */
PDN_API
pdn_status pdn_equations_linearise(struct pdn_equations *equations);

/**
 * The product of the scaled Jacobian of the last linearisation and a vector. By all ranks.
 *
 * Where constraints depend on each other they have a small compliance in it, see
 * ::pdn_equations_compliance.
 *
 * @param equations  the equations; not NULL
 * @param x  array of length [count]; NaN passes through
 * @param out  array of length [count], may be `x`; written on success only
 * @param count  pdn_equations_sizes.size
 * @return PDN_OK; PDN_ERR_CALLBACK; on this rank alone PDN_ERR_NULL, PDN_ERR_VALUE (a handle in
 *     use), PDN_ERR_SIZE, and PDN_ERR_NOT_AVAILABLE where the last linearisation failed
 *
 * Threads: exclusive use of `equations`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_equations_product(struct pdn_equations *equations,
                                 const double *x,
                                 double *out,
                                 size_t count);

/**
 * The product of the transposed scaled Jacobian and a vector. By all ranks.
 *
 * @param equations  the equations; not NULL
 * @param x  array of length [count]; NaN passes through
 * @param out  array of length [count], may be `x`; written on success only
 * @param count  pdn_equations_sizes.size
 * @return PDN_OK; PDN_ERR_CALLBACK; on this rank alone PDN_ERR_NULL, PDN_ERR_VALUE (a handle in
 *     use), PDN_ERR_SIZE, and PDN_ERR_NOT_AVAILABLE where the last linearisation failed
 *
 * Threads: exclusive use of `equations`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_equations_transposed_product(struct pdn_equations *equations,
                                            const double *x,
                                            double *out,
                                            size_t count);

/**
 * The product of a vector and what multiplies a power of mu in the scaled Jacobian for
 * disturbances exp(mu t) times increments of the period: J(mu) = J + mu J1 + mu^2 J2. Where that
 * is singular exp(mu T) is a Floquet multiplier. By all ranks.
 *
 * @param equations  the equations; not NULL
 * @param power  1 or 2
 * @param x  array of length [count]; NaN passes through
 * @param out  array of length [count], may be `x`; written on success only
 * @param count  pdn_equations_sizes.size
 * @return PDN_OK; PDN_ERR_CALLBACK; on this rank alone PDN_ERR_NULL, PDN_ERR_VALUE (another
 *     power, a handle in use), PDN_ERR_SIZE, and PDN_ERR_NOT_AVAILABLE where the last
 *     linearisation failed
 *
 * Threads: exclusive use of `equations`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_equations_power_product(struct pdn_equations *equations,
                                       int32_t power,
                                       const double *x,
                                       double *out,
                                       size_t count);

/**
 * Factors the preconditioner of the linearised equations. By all ranks.
 *
 * @param equations  the equations; not NULL
 * @param right_side  array of length [count]: a right side to come, by which unknown stress
 *     resultants get a size that suits; the Jacobian and the preconditioner are for that size
 * @param count  pdn_equations_sizes.size
 * @param regular  1, or 0 if the preconditioner is singular or cannot be had of this model;
 *     written on success only
 * @return PDN_OK; PDN_ERR_NOT_FINITE; PDN_ERR_SIZE; PDN_ERR_CALLBACK; PDN_ERR_MODEL;
 *     PDN_ERR_MEMORY; on this rank alone PDN_ERR_NULL, PDN_ERR_VALUE (a handle in use), and
 *     PDN_ERR_NOT_AVAILABLE where the last linearisation failed
 *
 * Threads: exclusive use of `equations`; functions of forces are called on this thread.
 * @since 0.1
 */
PDN_API
pdn_status pdn_equations_factor(struct pdn_equations *equations,
                                const double *right_side,
                                size_t count,
                                int32_t *regular);

/**
 * The solution of the preconditioner's equations with a right side. By all ranks.
 *
 * It is linear, and the same map until the preconditioner is factored anew.
 *
 * @param equations  the equations; not NULL
 * @param x  array of length [count]: the right side; NaN passes through
 * @param out  array of length [count], may be `x`; written on success only
 * @param count  pdn_equations_sizes.size
 * @return PDN_OK; PDN_ERR_CALLBACK; on this rank alone PDN_ERR_NULL, PDN_ERR_VALUE (a handle in
 *     use), PDN_ERR_SIZE, and PDN_ERR_NOT_AVAILABLE where nothing was factored
 *
 * Threads: exclusive use of `equations`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_equations_precondition(struct pdn_equations *equations,
                                      const double *x,
                                      double *out,
                                      size_t count);

/**
 * What a scaled increment leaves of the constraints by their compliance in the Jacobian, where
 * some depend on others. By this rank alone.
 *
 * Solve for it as a right side as well, and add the solution: motions are then those of the
 * constraints as they are.
 *
 * @param equations  the equations; not NULL
 * @param increment  array of length [count]
 * @param out  array of length [count], zeros if constraints have no compliance; written on success
 *     only
 * @param count  pdn_equations_sizes.size
 * @param compliant  1 if they have some, the same on all ranks, or 0; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_SIZE, PDN_ERR_VALUE (a handle in use)
 *
 * Threads: exclusive use of `equations`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_equations_compliance(struct pdn_equations *equations,
                                    const double *increment,
                                    double *out,
                                    size_t count,
                                    int32_t *compliant);

/**
 * Moves the state that the equations were linearised at last by a fraction of a scaled increment;
 * the present state is then that. By all ranks.
 *
 * Motions go on by their increments as rigid motions do, so that rotations remain such.
 *
 * @param equations  the equations; not NULL
 * @param increment  array of length [count]
 * @param count  pdn_equations_sizes.size
 * @param step  the fraction, usually 1
 * @return PDN_OK; PDN_ERR_NULL and PDN_ERR_VALUE (a handle in use), on this rank alone;
 *     PDN_ERR_NOT_FINITE, PDN_ERR_SIZE, PDN_ERR_NOT_AVAILABLE (not linearised), PDN_ERR_CALLBACK
 *
 * Threads: exclusive use of `equations`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_equations_update(struct pdn_equations *equations,
                                const double *increment,
                                size_t count,
                                double step);

/**
 * Sizes of a scaled increment of all ranks, the same on all. By all ranks.
 *
 * @param equations  the equations; not NULL
 * @param increment  array of length [count]; NaN gives NaN
 * @param count  pdn_equations_sizes.size
 * @param motion  largest increment of a motion: displacements relative to the characteristic
 *     length, turns in radians; written on success only
 * @param own_unknown  largest increment of a multiplier or internal state, relative to the largest
 *     of their values; written on success only
 * @return PDN_OK; PDN_ERR_NULL and PDN_ERR_VALUE (a handle in use), on this rank alone;
 *     PDN_ERR_SIZE, PDN_ERR_CALLBACK
 *
 * Threads: exclusive use of `equations`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_equations_norms(const struct pdn_equations *equations,
                               const double *increment,
                               size_t count,
                               double *motion,
                               double *own_unknown);

/**
 * The present state of all ranks as a solution, for results, files, and what else solutions are
 * for. By all ranks.
 *
 * @param equations  the equations; not NULL
 * @param root  the rank that gets the solution, which takes its memory there; usually -1, for all
 * @param outcome  how your solve ended: PDN_CONVERGED, ...
 * @param out  the solution, NULL on ranks that get none; free it with ::pdn_solution_free; written
 *     on success only
 * @return PDN_OK; PDN_ERR_NULL and PDN_ERR_VALUE (a handle in use), on this rank alone;
 *     PDN_ERR_VALUE (root, outcome); PDN_ERR_CALLBACK; PDN_ERR_GRID_TOO_COARSE; PDN_ERR_OVERFLOW;
 *     PDN_ERR_MEMORY
 *
 * Threads: exclusive use of `equations`; functions of the model are called on this thread.
 * @since 0.1
 */
PDN_API
pdn_status pdn_equations_solution(const struct pdn_equations *equations,
                                  int32_t root,
                                  int32_t outcome,
                                  struct pdn_solution **out);

/**
 * Adds a parameter: a named number that moves what ::pdn_model_move_number and
 * ::pdn_model_move_signal say. At first it moves nothing.
 *
 * A model can be solved at other values (::pdn_model_set_parameter), values can be found so that
 * conditions are met (::pdn_solve_conditioned), and followed (::pdn_follow_branch). They are saved
 * with the model.
 *
 * @param model  the model; not NULL
 * @param name  text in UTF-8 that no other parameter of the model has; not NULL, not empty
 * @param value  its value
 * @param scale  what counts as 1 in it, positive: its range, about
 * @param out  the parameter's id; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_VALUE
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_add_parameter(struct pdn_model *model,
                                   const char *name,
                                   double value,
                                   double scale,
                                   int32_t *out);

/**
 * Number of parameters; their ids follow each other from PDN_FIRST_PARAMETER on.
 *
 * @param model  the model; not NULL
 * @param count  the number; written on success only
 * @return PDN_OK, PDN_ERR_NULL
 *
 * Threads: `model` is `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_parameter_count(const struct pdn_model *model,
                                     int32_t *count);

/**
 * Value and scale of a parameter.
 *
 * @param model  the model; not NULL
 * @param parameter  id of the parameter
 * @param value  its value; written on success only
 * @param scale  what counts as 1 in it; may be NULL if it is not wanted; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID
 *
 * Threads: `model` is `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_parameter(const struct pdn_model *model,
                               int32_t parameter,
                               double *value,
                               double *scale);

/**
 * The name of a parameter.
 *
 * @param model  the model; not NULL
 * @param parameter  id of the parameter
 * @param buffer  array of length [capacity] for the name, UTF-8, always ended by NUL; may be NULL
 *     if capacity is 0
 * @param capacity  size of buffer in bytes
 * @return length of the name without the NUL, as snprintf does; 0 if the handle or id is not
 *     valid, see ::pdn_last_error
 *
 * Threads: `model` is `const`.
 * @since 0.1
 */
PDN_API
size_t pdn_model_parameter_name(const struct pdn_model *model,
                                int32_t parameter,
                                char *buffer,
                                size_t capacity);

/**
 * The parameter that has a name.
 *
 * @param model  the model; not NULL
 * @param name  the name; not NULL
 * @param parameter  id of the parameter; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_VALUE, PDN_ERR_NOT_AVAILABLE (none has this name)
 *
 * Threads: `model` is `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_find_parameter(const struct pdn_model *model,
                                    const char *name,
                                    int32_t *parameter);

/**
 * Lets a parameter move a number of the model: it becomes `factor` times the parameter's value,
 * now and whenever that changes.
 *
 * @param model  the model; not NULL
 * @param parameter  id of the parameter
 * @param number  PDN_NUMBER_STIFFNESS, ...
 * @param id  id of the force, inertia, beam element or shell element that has it; 0 for
 *     PDN_NUMBER_MASS_DAMPING, PDN_NUMBER_FRAME_RATE and PDN_NUMBER_FRAME_ADVANCE, which are of
 *     the whole model
 * @param power  power, from 1, of a stiffness or damping; 0 for all else
 * @param factor  the number for a unit of the parameter, not zero
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_ID (no such parameter or number),
 *     PDN_ERR_VALUE (another parameter moves it already, or a thickness is not positive)
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_move_number(struct pdn_model *model,
                                 int32_t parameter,
                                 int32_t number,
                                 int32_t id,
                                 int32_t power,
                                 double factor);

/**
 * Lets a parameter move a part of a signal: it becomes `factor` times the parameter's value, now
 * and whenever that changes.
 *
 * @param model  the model; not NULL
 * @param parameter  id of the parameter
 * @param id  what has the signal: id of an actuator (a force), prescribed coordinate, load (on a
 *     node, along beams, on shells) or relation; or PDN_GRAVITY
 * @param component  of a load PDN_FORCE_1, ... or PDN_MOMENT_3, of gravity from 0 to 2; 0 for all
 *     else
 * @param part  PDN_PART_MEAN, PDN_PART_RATE, PDN_PART_AMPLITUDE or PDN_PART_PHASE
 * @param factor  the part for a unit of the parameter, not zero
 * @return as ::pdn_model_move_number
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_move_signal(struct pdn_model *model,
                                 int32_t parameter,
                                 int32_t id,
                                 int32_t component,
                                 int32_t part,
                                 double factor);

/**
 * Gives a parameter another value, and all that it moves.
 *
 * @param model  the model; not NULL
 * @param parameter  id of the parameter
 * @param value  the value
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_ID
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_set_parameter(struct pdn_model *model,
                                   int32_t parameter,
                                   double value);

/**
 * Gives everything with mass a force against its motion relative to the inertial frame, `factor`
 * times its momentum: damping in proportion to mass.
 *
 * @param model  the model; not NULL
 * @param factor  force for a unit of momentum \[1/time\]; negative to excite
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_set_mass_damping(struct pdn_model *model,
                                      double factor);

/**
 * Declares that the function of a force is one of the phase, 2 pi t / T, which it is then told in
 * place of the time: it holds for any period T, as it must where that is unknown.
 *
 * A function that does not depend on time is one of the phase, too.
 *
 * @param model  the model; not NULL
 * @param force  id of a force that has a function
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID, PDN_ERR_NOT_AVAILABLE (it has none)
 *
 * Threads: exclusive use of `model`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_declare_of_phase(struct pdn_model *model,
                                      int32_t force);

/**
 * Value of a parameter in a solution: given, or found.
 *
 * @param solution  the solution; not NULL
 * @param parameter  id of the parameter, or PDN_FREQUENCY
 * @param out  the value; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID
 *
 * Threads: like `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_solution_parameter(const struct pdn_solution *solution,
                                  int32_t parameter,
                                  double *out);

/**
 * Prepares a struct for ::pdn_model_joint; use `PDN_INIT(pdn_joint_info, &info)`.
 *
 * @param info  the struct; not NULL
 * @param struct_size  `sizeof *info`
 *
 * Threads: any.
 * @since 0.1
 */
PDN_API
void pdn_joint_info_init(struct pdn_joint_info *info,
                         size_t struct_size);

/**
 * Prepares a struct for ::pdn_model_force; use `PDN_INIT(pdn_force_info, &info)`.
 *
 * @param info  the struct; not NULL
 * @param struct_size  `sizeof *info`
 *
 * Threads: any.
 * @since 0.1
 */
PDN_API
void pdn_force_info_init(struct pdn_force_info *info,
                         size_t struct_size);

/**
 * Kind, bodies and frames of a joint.
 *
 * @param model  the model; not NULL
 * @param joint  id of the joint
 * @param out  the joint; initialised by PDN_INIT; filled on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE, PDN_ERR_ID
 *
 * Threads: `model` is `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_joint(const struct pdn_model *model,
                           int32_t joint,
                           struct pdn_joint_info *out);

/**
 * Kind of a force, where it acts, and how many numbers it has.
 *
 * @param model  the model; not NULL
 * @param force  id of the force
 * @param out  the force; initialised by PDN_INIT; filled on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE, PDN_ERR_ID
 *
 * Threads: `model` is `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_force(const struct pdn_model *model,
                           int32_t force,
                           struct pdn_force_info *out);

/**
 * A number of a force, with the factors of parameters.
 *
 * Of a spring-damper the coefficients of the powers of the growth and of the rate, from the first;
 * of a viscoelastic element as PDN_NUMBER_STIFFNESS the long-term stiffness, then that of each
 * branch; of viscous dampers and bushings their matrices, column by column. Of a spring-damper or
 * viscoelastic element as PDN_NUMBER_REST the one coordinate at which it is free of effort.
 *
 * @param model  the model; not NULL
 * @param force  id of the force
 * @param number  PDN_NUMBER_STIFFNESS, PDN_NUMBER_DAMPING, PDN_NUMBER_RELAXATION_TIME or
 *     PDN_NUMBER_REST
 * @param index  which of these, from 0; their count is in pdn_force_info
 * @param out  the number; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID, PDN_ERR_VALUE
 *
 * Threads: `model` is `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_force_number(const struct pdn_model *model,
                                  int32_t force,
                                  int32_t number,
                                  int32_t index,
                                  double *out);

/**
 * A node of forces of the user.
 *
 * @param model  the model; not NULL
 * @param force  id of the force
 * @param index  which of its nodes, from 0; their count is in pdn_force_info
 * @param node  the node's id; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID
 *
 * Threads: `model` is `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_force_node(const struct pdn_model *model,
                                int32_t force,
                                int32_t index,
                                int32_t *node);

/**
 * Number of nodes of a beam element.
 *
 * @param model  the model; not NULL
 * @param element  id of the beam element
 * @param count  the number; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID
 *
 * Threads: `model` is `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_beam_element_node_count(const struct pdn_model *model,
                                             int32_t element,
                                             int32_t *count);

/**
 * A node of a beam element, in order along the beam.
 *
 * @param model  the model; not NULL
 * @param element  id of the beam element
 * @param index  which of its nodes, from 0
 * @param node  the node's id; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID
 *
 * Threads: `model` is `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_beam_element_node(const struct pdn_model *model,
                                       int32_t element,
                                       int32_t index,
                                       int32_t *node);

/**
 * Cross-section of a beam element at a place, with the factors of parameters.
 *
 * @param model  the model; not NULL
 * @param element  id of the beam element
 * @param station  place along the element, from -1 at its first to 1 at its last node
 * @param out  the section, in its own axes; initialised by PDN_INIT; filled on success only
 * @param twist  angle by which its axes are turned about axis 1 from those between the nodes
 *     [radian]; may be NULL if it is not wanted; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE, PDN_ERR_NOT_FINITE, PDN_ERR_ID, PDN_ERR_VALUE
 *
 * Threads: `model` is `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_beam_section(const struct pdn_model *model,
                                  int32_t element,
                                  double station,
                                  struct pdn_section *out,
                                  double *twist);

/**
 * Number of inertias: bodies, masses and inertias on nodes; their ids follow each other from
 * PDN_FIRST_INERTIA on.
 *
 * @param model  the model; not NULL
 * @param count  the number; written on success only
 * @return PDN_OK, PDN_ERR_NULL
 *
 * Threads: `model` is `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_inertia_count(const struct pdn_model *model,
                                   int32_t *count);

/**
 * The inertia of a body, or a mass or inertia on a node, with the factors of parameters.
 *
 * @param model  the model; not NULL
 * @param inertia  id of the inertia
 * @param node  the node's id; written on success only
 * @param matrix  array of shape 6 x 6: inertia about the node, along its axes, as in
 *     ::pdn_model_add_inertia; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID
 *
 * Threads: `model` is `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_inertia(const struct pdn_model *model,
                             int32_t inertia,
                             int32_t *node,
                             double *matrix);

/**
 * The inertia of a node: of a rigid body its own, of others the one that was added first.
 *
 * @param model  the model; not NULL
 * @param node  id of the node
 * @param inertia  id of the inertia; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID, PDN_ERR_NOT_AVAILABLE (the node has none)
 *
 * Threads: `model` is `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_inertia_of(const struct pdn_model *model,
                                int32_t node,
                                int32_t *inertia);

/**
 * A prescribed coordinate; ::pdn_model_summary tells how many there are, whose ids follow each
 * other from PDN_FIRST_PRESCRIBED on, and ::pdn_model_sample_signal what they follow.
 *
 * @param model  the model; not NULL
 * @param prescribed  id of the prescribed coordinate
 * @param joint  id of its joint; written on success only
 * @param coordinate  PDN_DISPLACEMENT, ...; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID
 *
 * Threads: `model` is `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_prescribed(const struct pdn_model *model,
                                int32_t prescribed,
                                int32_t *joint,
                                int32_t *coordinate);

/**
 * Number of coordinates of a linear relation.
 *
 * @param model  the model; not NULL
 * @param relation  id of the relation
 * @param count  the number; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID
 *
 * Threads: `model` is `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_relation_term_count(const struct pdn_model *model,
                                         int32_t relation,
                                         int32_t *count);

/**
 * A coordinate of a linear relation, and its coefficient.
 *
 * @param model  the model; not NULL
 * @param relation  id of the relation
 * @param index  which of its coordinates, from 0
 * @param joint  id of the joint; written on success only
 * @param coordinate  PDN_DISPLACEMENT, ...; written on success only
 * @param coefficient  the coefficient; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID
 *
 * Threads: `model` is `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_relation_term(const struct pdn_model *model,
                                   int32_t relation,
                                   int32_t index,
                                   int32_t *joint,
                                   int32_t *coordinate,
                                   double *coefficient);

/**
 * Values of a signal of the model in time.
 *
 * @param model  the model; not NULL
 * @param id  what has the signal, as in ::pdn_model_move_signal
 * @param component  of a load PDN_FORCE_1, ... or PDN_MOMENT_3, of gravity from 0 to 2; 0 for all
 *     else
 * @param period  period of the motion, that harmonics refer to [time]
 * @param times  array of length [count]: times
 * @param count  number of times
 * @param values  array of length [count]: the values there; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_SIZE, PDN_ERR_NOT_FINITE, PDN_ERR_ID, PDN_ERR_VALUE,
 *     PDN_ERR_NOT_AVAILABLE (it has no such signal), PDN_ERR_CALLBACK
 *
 * Threads: `model` is `const`. Signals' functions are called on this thread.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_sample_signal(const struct pdn_model *model,
                                   int32_t id,
                                   int32_t component,
                                   double period,
                                   const double *times,
                                   size_t count,
                                   double *values);

/**
 * Number of loads on nodes and at points; their ids follow each other from PDN_FIRST_LOAD on.
 *
 * @param model  the model; not NULL
 * @param count  the number; written on success only
 * @return PDN_OK, PDN_ERR_NULL
 *
 * Threads: `model` is `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_load_count(const struct pdn_model *model,
                                int32_t *count);

/**
 * A load on a node or at a point; its components are signals, ::pdn_model_sample_signal.
 *
 * @param model  the model; not NULL
 * @param load  id of the load
 * @param node  id of the node that carries it, or -1 if a beam does; written on success only
 * @param first_element  id of the first of the beam elements that carry it, or -1 if a node does;
 *     written on success only
 * @param elements  number of these, from the first on, 0 if there are none; written on success
 *     only
 * @param fraction  the place, as a fraction of the reference length of these elements, 0 if there
 *     are none; written on success only
 * @param offset  array of length 3: the point, from the node or the line of the beam, along the
 *     axes of the node or section; may be NULL if it is not wanted; written on success only
 * @param frame  PDN_FRAME_SPACE or PDN_FRAME_MATERIAL; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID
 *
 * Threads: `model` is `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_load_at(const struct pdn_model *model,
                             int32_t load,
                             int32_t *node,
                             int32_t *first_element,
                             int32_t *elements,
                             double *fraction,
                             double *offset,
                             int32_t *frame);

/**
 * Number of loads along beam elements; their ids follow each other from PDN_FIRST_BEAM_LOAD on.
 *
 * @param model  the model; not NULL
 * @param count  the number; written on success only
 * @return PDN_OK, PDN_ERR_NULL
 *
 * Threads: `model` is `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_beam_load_count(const struct pdn_model *model,
                                     int32_t *count);

/**
 * A load along beam elements; its components are signals, ::pdn_model_sample_signal, times the
 * factors of ::pdn_model_beam_load_factor.
 *
 * @param model  the model; not NULL
 * @param load  id of the beam load
 * @param first_element  id of the first beam element; written on success only
 * @param elements  number of elements, from the first on; written on success only
 * @param frame  PDN_FRAME_SPACE, PDN_FRAME_MATERIAL or PDN_FRAME_UNTWISTED; written on success
 *     only
 * @param axis_2  array of length 3: direction that was given with PDN_FRAME_UNTWISTED, else zero;
 *     may be NULL if it is not wanted; written on success only
 * @param places  number of places with factors, 0 for a factor of 1 all along; written on success
 *     only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID
 *
 * Threads: `model` is `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_beam_load(const struct pdn_model *model,
                               int32_t load,
                               int32_t *first_element,
                               int32_t *elements,
                               int32_t *frame,
                               double *axis_2,
                               int32_t *places);

/**
 * Factor of a load along beam elements at a place; it is linear in between.
 *
 * @param model  the model; not NULL
 * @param load  id of the beam load
 * @param index  which of its places, from 0, in order along the elements
 * @param fraction  the place, as a fraction of the reference length of its elements; written on
 *     success only
 * @param factor  the factor there; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID
 *
 * Threads: `model` is `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_beam_load_factor(const struct pdn_model *model,
                                      int32_t load,
                                      int32_t index,
                                      double *fraction,
                                      double *factor);

/**
 * Number of loads on shell elements; their ids follow each other from PDN_FIRST_SHELL_LOAD on.
 *
 * @param model  the model; not NULL
 * @param count  the number; written on success only
 * @return PDN_OK, PDN_ERR_NULL
 *
 * Threads: `model` is `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_shell_load_count(const struct pdn_model *model,
                                      int32_t *count);

/**
 * A load on shell elements; its components are signals, ::pdn_model_sample_signal.
 *
 * @param model  the model; not NULL
 * @param load  id of the shell load
 * @param first_element  id of the first shell element; written on success only
 * @param elements  number of elements, from the first on; written on success only
 * @param place  PDN_SHELL_SURFACE or an edge, of each of them; written on success only
 * @param frame  PDN_FRAME_SPACE or PDN_FRAME_MATERIAL; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID
 *
 * Threads: `model` is `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_shell_load(const struct pdn_model *model,
                                int32_t load,
                                int32_t *first_element,
                                int32_t *elements,
                                int32_t *place,
                                int32_t *frame);

/**
 * Makes an empty list: no parameter is free.
 *
 * It belongs to no model; ids are looked up when it is used.
 *
 * @param out  the list; free it with ::pdn_conditions_free; written on success only
 * @return PDN_OK, PDN_ERR_NULL
 *
 * Threads: any.
 * @since 0.1
 */
PDN_API
pdn_status pdn_conditions_new(struct pdn_conditions **out);

/**
 * Frees a list; NULL does nothing.
 *
 * @param conditions  the list, not to be used any more
 *
 * Threads: exclusive use of `conditions`.
 * @since 0.1
 */
PDN_API
void pdn_conditions_free(struct pdn_conditions *conditions);

/**
 * Makes a parameter free: its value in the model is that to start from.
 *
 * @param conditions  the list; not NULL
 * @param parameter  id of a parameter, or PDN_FREQUENCY for an unknown period
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID
 *
 * Threads: exclusive use of `conditions`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_conditions_release(struct pdn_conditions *conditions,
                                  int32_t parameter);

/**
 * Adds the condition on the phase: the motion is not ahead of that which the solve starts from.
 *
 * For motions whose time nothing else tells: limit cycles, and free motions of a conservative
 * system.
 *
 * @param conditions  the list; not NULL
 * @return PDN_OK, PDN_ERR_NULL
 *
 * Threads: exclusive use of `conditions`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_conditions_add_phase(struct pdn_conditions *conditions);

/**
 * Adds the condition on the phase of a rotation: in the mean over the period and all nodes, the
 * motion is not turned about an axis from that which the solve starts from.
 *
 * For mechanisms that nothing holds against it, such as a pendulum in a spherical joint, whose
 * turn in a period is unknown (::pdn_model_set_turning_frame).
 *
 * @param conditions  the list; not NULL
 * @param axis  array of length 3: direction of the axis, not zero
 * @param point  array of length 3: a point of the axis \[length\]; NULL for the origin
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_VALUE (no direction)
 *
 * Threads: exclusive use of `conditions`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_conditions_add_rotation_phase(struct pdn_conditions *conditions,
                                             const double *axis,
                                             const double *point);

/**
 * Adds the condition on the phase of a translation: in the mean over the period and all nodes, the
 * motion is not moved in a direction from that which the solve starts from.
 *
 * For mechanisms that nothing holds against it, such as a free body.
 *
 * @param conditions  the list; not NULL
 * @param direction  array of length 3: the direction, not zero
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_VALUE (no direction)
 *
 * Threads: exclusive use of `conditions`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_conditions_add_translation_phase(struct pdn_conditions *conditions,
                                                const double *direction);

/**
 * Adds the condition that the mean, a harmonic, or the value at a time, of a quantity is this:
 * trim.
 *
 * @param conditions  the list; not NULL
 * @param quantity  one component of a quantity, initialised by PDN_INIT; not NULL
 * @param feature  PDN_FEATURE_MEAN, PDN_FEATURE_COSINE, PDN_FEATURE_SINE or PDN_FEATURE_VALUE
 * @param at  the number of the harmonic, from 1, or the time; not looked at for the mean
 * @param value  the value
 * @param scale  what counts as 1 in it, such as the largest that it may be; usually 0, for what
 *     does in such quantities of the mechanism
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE, PDN_ERR_NOT_FINITE, PDN_ERR_ID,
 *     PDN_ERR_VALUE; that the model has no such quantity, or the grid no such harmonic, is told by
 *     the solve
 *
 * Threads: exclusive use of `conditions`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_conditions_add_quantity(struct pdn_conditions *conditions,
                                       const struct pdn_quantity *quantity,
                                       int32_t feature,
                                       double at,
                                       double value,
                                       double scale);

/**
 * Adds the condition that a joint coordinate has a value at the start of the period.
 *
 * With ::pdn_conditions_add_phase, and a start that turns back at time zero, it is the amplitude
 * of a free motion.
 *
 * @param conditions  the list; not NULL
 * @param joint  id of the joint
 * @param coordinate  PDN_DISPLACEMENT, ... or PDN_ROTATION, ...
 * @param value  the value
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_ID, PDN_ERR_VALUE
 *
 * Threads: exclusive use of `conditions`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_conditions_add_joint_coordinate(struct pdn_conditions *conditions,
                                               int32_t joint,
                                               int32_t coordinate,
                                               double value);

/**
 * Adds the condition that the mean of the kinetic and the potential energy over the period is a
 * value.
 *
 * Weights have no energy at the origin. The energy of weights, of springs on joint coordinates and
 * of beams is known; a model with other forces is refused.
 *
 * @param conditions  the list; not NULL
 * @param energy  the value \[force * length\]
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE
 *
 * Threads: exclusive use of `conditions`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_conditions_add_energy(struct pdn_conditions *conditions,
                                     double energy);

/**
 * Adds the condition that the mean momentum in a direction is a value.
 *
 * The momentum in the inertial frame is meant, also where the model is described in a frame that
 * turns.
 *
 * @param conditions  the list; not NULL
 * @param direction  array of length 3: the direction, not zero
 * @param momentum  the value \[mass * length / time\]
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_VALUE (no direction)
 *
 * Threads: exclusive use of `conditions`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_conditions_add_momentum(struct pdn_conditions *conditions,
                                       const double *direction,
                                       double momentum);

/**
 * Adds the condition that the mean angular momentum about an axis is a value.
 *
 * With ::pdn_model_set_turning_frame, of a free body that tumbles. The angular momentum in the
 * inertial frame is meant, also where the model is described in a frame that turns.
 *
 * @param conditions  the list; not NULL
 * @param axis  array of length 3: direction of the axis, not zero
 * @param point  array of length 3: a point of the axis \[length\]; NULL for the origin
 * @param momentum  the value \[mass * length^2 / time\]
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_VALUE (no direction)
 *
 * Threads: exclusive use of `conditions`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_conditions_add_angular_momentum(struct pdn_conditions *conditions,
                                               const double *axis,
                                               const double *point,
                                               double momentum);

/**
 * Finds a periodic response that meets conditions, and the values of as many free parameters.
 *
 * Newton's method for motions and parameters together starts at a given solution or motion
 * (`options.initial`, `options.guess_positions`), or else at the response with the parameters as
 * they are. Where the period is free, `period` is the guess of it; loads and prescribed motions
 * are then functions of the phase: harmonics and samples are, rates are for whole turns, functions
 * must be declared such (::pdn_signal_set_function_of_phase, ::pdn_model_declare_of_phase).
 *
 * @param model  the model; it is copied, so that later changes do not touch the solution
 * @param period  T, or a guess of it
 * @param conditions  free parameters and as many conditions; not NULL
 * @param options  may be NULL for the defaults
 * @param out  the solution, also if it has not converged: ::pdn_solution_parameter tells the
 *     values found; free it with ::pdn_solution_free; written on success only
 * @return as ::pdn_solve_periodic; PDN_ERR_SIZE also if there are not as many conditions as free
 *     parameters, PDN_ERR_VALUE if one is free twice, moves nothing, or if the phase is that of a
 *     start at rest, PDN_ERR_NOT_PERIODIC if something has a frequency of its own
 *
 * Threads: like a `const` use of `model`, `conditions` and `options.initial`. Functions of yours
 * are called on this thread.
 * @since 0.1
 */
PDN_API
pdn_status pdn_solve_conditioned(const struct pdn_model *model,
                                 double period,
                                 const struct pdn_conditions *conditions,
                                 const struct pdn_periodic_options *options,
                                 struct pdn_solution **out);

/**
 * Sets default options; use `PDN_INIT(pdn_sensitivity_options, &options)`.
 *
 * @param options  the options; not NULL
 * @param struct_size  `sizeof *options`
 *
 * Threads: any.
 * @since 0.1
 */
PDN_API
void pdn_sensitivity_options_init(struct pdn_sensitivity_options *options,
                                  size_t struct_size);

/**
 * Makes an empty list: nothing is differentiated.
 *
 * It belongs to no model; ids are looked up when it is used.
 *
 * @param out  the list; free it with ::pdn_sensitivities_free; written on success only
 * @return PDN_OK, PDN_ERR_NULL
 *
 * Threads: any.
 * @since 0.1
 */
PDN_API
pdn_status pdn_sensitivities_new(struct pdn_sensitivities **out);

/**
 * Frees a list; NULL does nothing.
 *
 * @param sensitivities  the list, not to be used any more
 *
 * Threads: exclusive use of `sensitivities`.
 * @since 0.1
 */
PDN_API
void pdn_sensitivities_free(struct pdn_sensitivities *sensitivities);

/**
 * Adds a dependent: the mean, a harmonic, the value at a time, or a peak of a quantity.
 *
 * @param sensitivities  the list; not NULL
 * @param quantity  one component of a quantity, initialised by PDN_INIT; not NULL
 * @param feature  PDN_FEATURE_MEAN, PDN_FEATURE_COSINE, PDN_FEATURE_SINE, PDN_FEATURE_VALUE,
 *     PDN_FEATURE_LARGEST or PDN_FEATURE_SMALLEST
 * @param at  the number of the harmonic, from 1, or the time; usually 0 for all else, where it is
 *     not looked at
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE, PDN_ERR_NOT_FINITE, PDN_ERR_ID,
 *     PDN_ERR_VALUE
 *
 * Threads: exclusive use of `sensitivities`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_sensitivities_add_quantity(struct pdn_sensitivities *sensitivities,
                                          const struct pdn_quantity *quantity,
                                          int32_t feature,
                                          double at);

/**
 * Adds a dependent: the value of a free parameter, which conditions determine.
 *
 * @param sensitivities  the list; not NULL
 * @param parameter  id of a parameter, or PDN_FREQUENCY
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID
 *
 * Threads: exclusive use of `sensitivities`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_sensitivities_add_found(struct pdn_sensitivities *sensitivities,
                                       int32_t parameter);

/**
 * Adds a parameter that all is differentiated by.
 *
 * @param sensitivities  the list; not NULL
 * @param parameter  id of a parameter, or PDN_FREQUENCY
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID
 *
 * Threads: exclusive use of `sensitivities`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_sensitivities_add_parameter(struct pdn_sensitivities *sensitivities,
                                           int32_t parameter);

/**
 * Derivatives of what comes out of a periodic solution by parameters of its model.
 *
 * All else stays, but for the free parameters of `conditions`, which follow so that these go on to
 * be met: sensitivities at trim, or along an unknown period. A condition on the phase is that of
 * this solution; values that conditions ask for are not looked at but as those of the solution. A
 * parameter that moves nothing has zeros. Peaks vary as the value at their time does; a quantity
 * that has its peak at two times has no sensitivity. The equations are linearised and factored
 * once; each parameter, or each dependent, takes a solve with the factors.
 *
 * @param solution  a converged solution of ::pdn_solve_periodic, ::pdn_solve_conditioned or one
 *     like it; not NULL
 * @param sensitivities  what is differentiated, by what; not NULL
 * @param conditions  free parameters and as many conditions; NULL for none
 * @param options  may be NULL for the defaults
 * @param derivatives  array of shape [dependents] x [parameters], those by a parameter together
 * @param dependents  number of the dependents
 * @param parameters  number of the parameters
 * @return PDN_OK; PDN_ERR_NULL; PDN_ERR_STRUCT_SIZE; PDN_ERR_SIZE; PDN_ERR_ID; PDN_ERR_VALUE (a
 *     parameter twice, or free); PDN_ERR_NOT_PERIODIC (PDN_FREQUENCY, and something has a
 *     frequency of its own); PDN_ERR_NOT_AVAILABLE (no periodic solution or one that has not
 *     converged, a fold, nothing that determines the phase, two equal peaks, what constraints that
 *     depend on each other leave open); PDN_ERR_CALLBACK; PDN_ERR_OVERFLOW; PDN_ERR_MEMORY
 *
 * Threads: like a `const` use of `solution`, `sensitivities` and `conditions`. Functions of yours
 * are called on this thread.
 * @since 0.1
 */
PDN_API
pdn_status pdn_solution_sensitivities(const struct pdn_solution *solution,
                                      const struct pdn_sensitivities *sensitivities,
                                      const struct pdn_conditions *conditions,
                                      const struct pdn_sensitivity_options *options,
                                      double *derivatives,
                                      size_t dependents,
                                      size_t parameters);

/**
 * Derivatives of a Floquet multiplier of a periodic solution by parameters of its model.
 *
 * The solution follows the parameters, and so do the free parameters of `conditions`, so that
 * these go on to be met. The multiplier is first found once more, from the equations on the grid
 * of the solution, whose derivatives these are: that takes a complex factorisation for each of a
 * few iterations. A multiplier that is not the only one of its value, or that is 1 because its
 * mode moves the solution in time or space, has no derivatives.
 *
 * @param solution  a converged solution of ::pdn_solve_periodic, ::pdn_solve_conditioned or one
 *     like it; not NULL
 * @param sensitivities  the parameters; what else it lists is of no account; not NULL
 * @param stability  the multipliers of this solution; not NULL
 * @param number  number of the multiplier among these, from 0
 * @param conditions  free parameters and as many conditions; NULL for none
 * @param options  may be NULL for the defaults; the method is of no account
 * @param re  array of length [parameters]: derivatives of the real part
 * @param im  array of length [parameters]: those of the imaginary part
 * @param parameters  number of the parameters
 * @return PDN_OK; PDN_ERR_NULL; PDN_ERR_STRUCT_SIZE; PDN_ERR_SIZE; PDN_ERR_ID; PDN_ERR_VALUE (a
 *     parameter twice, or free; multipliers of another period); PDN_ERR_NOT_PERIODIC
 *     (PDN_FREQUENCY, and something has a frequency of its own); PDN_ERR_NOT_AVAILABLE (as of
 *     ::pdn_solution_sensitivities; a multiplier that has no derivatives, or whose mode the grid
 *     does not resolve); PDN_ERR_CALLBACK; PDN_ERR_OVERFLOW; PDN_ERR_MEMORY
 *
 * Threads: like a `const` use of `solution`, `sensitivities`, `stability` and `conditions`.
 * Functions of yours are called on this thread.
 * @since 0.1
 */
PDN_API
pdn_status pdn_solution_multiplier_sensitivities(const struct pdn_solution *solution,
                                                 const struct pdn_sensitivities *sensitivities,
                                                 const struct pdn_stability *stability,
                                                 int32_t number,
                                                 const struct pdn_conditions *conditions,
                                                 const struct pdn_sensitivity_options *options,
                                                 double *re,
                                                 double *im,
                                                 size_t parameters);

/**
 * Sets a point to that of nothing; use `PDN_INIT(pdn_branch_point, &point)`.
 *
 * @param point  the point; not NULL
 * @param struct_size  `sizeof *point`
 *
 * Threads: any.
 * @since 0.1
 */
PDN_API
void pdn_branch_point_init(struct pdn_branch_point *point,
                           size_t struct_size);

/**
 * Sets default options; use `PDN_INIT(pdn_branch_options, &options)`.
 *
 * @param options  the options; not NULL
 * @param struct_size  `sizeof *options`
 *
 * Threads: any.
 * @since 0.1
 */
PDN_API
void pdn_branch_options_init(struct pdn_branch_options *options,
                             size_t struct_size);

/**
 * Follows periodic motions along a parameter, through folds, from the response at its value in the
 * model.
 *
 * Steps are as long as the branch allows: they aim at `options.angle` between the tangents of
 * neighbouring points. Folds are located exactly, and are points of their own. Unless a number of
 * grid points is given it grows along the branch. That the branch ends early is no error, whatever
 * happens after its first point: ::pdn_branch_end tells, and all its points are kept.
 *
 * @param model  the model; it is copied, so that later changes do not touch the branch
 * @param period  T of the first response, or a guess of it where the frequency is free
 * @param parameter  id of the parameter to be followed, or PDN_FREQUENCY
 * @param options  the range of the parameter, at least; not NULL
 * @param out  the branch; free it with ::pdn_branch_free; written on success only
 * @return as ::pdn_solve_conditioned; PDN_ERR_VALUE also if the parameter is not in its range
 *
 * Threads: like a `const` use of `model` and of what `options` points to. Functions of yours are
 * called on this thread.
 * @since 0.1
 */
PDN_API
pdn_status pdn_follow_branch(const struct pdn_model *model,
                             double period,
                             int32_t parameter,
                             const struct pdn_branch_options *options,
                             struct pdn_branch **out);

/**
 * Finds the response over a range of frequencies, through folds: ::pdn_follow_branch along
 * PDN_FREQUENCY.
 *
 * @param model  the model, whose loads and prescribed motions are functions of the phase; rates
 *     are those at the frequency `first`, and remain as many turns a period
 * @param first  circular frequency 2 pi / T at which it begins
 * @param last  circular frequency at which it ends, more or less than `first`
 * @param options  may be NULL for the defaults; its range, direction and conditions are not used
 * @param out  the branch; free it with ::pdn_branch_free; written on success only
 * @return as ::pdn_follow_branch
 *
 * Threads: as ::pdn_follow_branch.
 * @since 0.1
 */
PDN_API
pdn_status pdn_solve_frequency_response(const struct pdn_model *model,
                                        double first,
                                        double last,
                                        const struct pdn_branch_options *options,
                                        struct pdn_branch **out);

/**
 * Follows the other branch at a point where one begins: a branch point, or a period doubling, from
 * where motions have twice the period, on one grid point less than twice as many.
 *
 * It begins where motions are `amplitude` away in the direction in which it leaves, and goes on
 * away from there. That it cannot is no error: ::pdn_branch_end tells.
 *
 * @param branch  the branch; not NULL
 * @param point  number of the point, from 0
 * @param amplitude  length, of which 1 is a motion of `options.motion_scale`, of either sign; not
 *     zero
 * @param options  the range of the same parameter, at least, and conditions as those of the
 *     branch; its direction, and where solves start, are not used; not NULL
 * @param out  the other branch; free it with ::pdn_branch_free; written on success only
 * @return as ::pdn_follow_branch; PDN_ERR_ID (there is no such point), PDN_ERR_NOT_AVAILABLE (no
 *     other branch begins there), PDN_ERR_GRID_TOO_COARSE
 *
 * Threads: like a `const` use of `branch` and of what `options` points to. Functions of yours are
 * called on this thread.
 * @since 0.1
 */
PDN_API
pdn_status pdn_switch_branch(const struct pdn_branch *branch,
                             int32_t point,
                             double amplitude,
                             const struct pdn_branch_options *options,
                             struct pdn_branch **out);

/**
 * Follows folds, period doublings or torus points along a second parameter, from one of them on a
 * branch: that of the branch is free beside it.
 *
 * All points of what is returned are such points. Their `parameter` is the second one, that of the
 * branch is ::pdn_solution_parameter of their solutions. The CSV file has both.
 *
 * @param branch  the branch; not NULL
 * @param point  number of the point, from 0
 * @param parameter  id of the second parameter, or PDN_FREQUENCY
 * @param options  the range of the second parameter, at least, and conditions as those of the
 *     branch; where solves start is not used; not NULL
 * @param out  the points; free them with ::pdn_branch_free; written on success only
 * @return as ::pdn_follow_branch; PDN_ERR_ID (there is no such point), PDN_ERR_NOT_AVAILABLE
 *     (nothing happens there, or a branch point)
 *
 * Threads: like a `const` use of `branch` and of what `options` points to. Functions of yours are
 * called on this thread.
 * @since 0.1
 */
PDN_API
pdn_status pdn_follow_locus(const struct pdn_branch *branch,
                            int32_t point,
                            int32_t parameter,
                            const struct pdn_branch_options *options,
                            struct pdn_branch **out);

/**
 * Follows a branch on from its last point, in the direction in which it came there: with a wider
 * range, more points, a shorter smallest step.
 *
 * @param branch  the branch, as it was followed or loaded; not NULL
 * @param options  the range of the same parameter, at least, and conditions as those of the
 *     branch; its direction, and where solves start, are not used; not NULL
 * @param out  a branch with the points of the first and those that are new; free it with
 *     ::pdn_branch_free; written on success only
 * @return as ::pdn_follow_branch; PDN_ERR_NOT_AVAILABLE (it has no points, has come back to its
 *     first one, or is one of ::pdn_follow_locus)
 *
 * Threads: like a `const` use of `branch` and of what `options` points to. Functions of yours are
 * called on this thread.
 * @since 0.1
 */
PDN_API
pdn_status pdn_continue_branch(const struct pdn_branch *branch,
                               const struct pdn_branch_options *options,
                               struct pdn_branch **out);

/**
 * Saves a branch with its model and all its points.
 *
 * ::pdn_branch_load gives it back. Callbacks cannot be saved: see there. The format is the same on
 * all platforms, and later versions of the library read it.
 *
 * @param branch  the branch; not NULL
 * @param path  where to, UTF-8. A file that is there is replaced when all is written; if that
 *     fails it stays as it was
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_VALUE (text that is not UTF-8), PDN_ERR_IO
 *
 * Threads: like `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_branch_save(const struct pdn_branch *branch,
                           const char *path);

/**
 * Loads a branch that ::pdn_branch_save saved. It can be continued.
 *
 * If its model had callbacks, in signals or forces, solutions of its points and all that is
 * followed from it fail with PDN_ERR_CALLBACK, as they are not there.
 *
 * @param path  the file, UTF-8. It need not be trusted: its checksum and everything in it are
 *     checked
 * @param out  the branch; free it with ::pdn_branch_free; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_VALUE (text that is not UTF-8), PDN_ERR_IO, PDN_ERR_FORMAT
 *     (not a saved branch, cut off, damaged, or of a newer version), PDN_ERR_MEMORY
 *
 * Threads: any.
 * @since 0.1
 */
PDN_API
pdn_status pdn_branch_load(const char *path,
                           struct pdn_branch **out);

/**
 * Frees a branch; NULL does nothing. Solutions made from it stay.
 *
 * @param branch  the branch, not to be used any more
 *
 * Threads: exclusive use of `branch`.
 * @since 0.1
 */
PDN_API
void pdn_branch_free(struct pdn_branch *branch);

/**
 * Why a branch ended.
 *
 * @param branch  the branch; not NULL
 * @return PDN_BRANCH_RANGE, ...; or PDN_ERR_NULL
 *
 * Threads: like `const`.
 * @since 0.1
 */
PDN_API
int32_t pdn_branch_end(const struct pdn_branch *branch);

/**
 * A readable report: points, events, and why the branch ended.
 *
 * @param branch  the branch; not NULL
 * @param buffer  array of length [capacity] for the text, UTF-8, always ended by NUL; may be NULL
 * @param capacity  bytes in the buffer
 * @return bytes of the whole text, without the NUL; 0 if an error occurred
 *
 * Threads: like `const`.
 * @since 0.1
 */
PDN_API
size_t pdn_branch_report(const struct pdn_branch *branch,
                         char *buffer,
                         size_t capacity);

/**
 * Number of points of a branch.
 *
 * @param branch  the branch; not NULL
 * @param out  the number; written on success only
 * @return PDN_OK, PDN_ERR_NULL
 *
 * Threads: like `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_branch_count(const struct pdn_branch *branch,
                            int32_t *out);

/**
 * A point of a branch.
 *
 * @param branch  the branch; not NULL
 * @param point  its number, from 0
 * @param out  the point, initialised; not NULL
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID, PDN_ERR_STRUCT_SIZE
 *
 * Threads: like `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_branch_get(const struct pdn_branch *branch,
                          int32_t point,
                          struct pdn_branch_point *out);

/**
 * The solution at a point of a branch.
 *
 * @param branch  the branch; not NULL
 * @param point  its number, from 0
 * @param out  the solution; free it with ::pdn_solution_free; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID, PDN_ERR_CALLBACK, PDN_ERR_MEMORY
 *
 * Threads: like `const`. Functions of the model may be called on this thread.
 * @since 0.1
 */
PDN_API
pdn_status pdn_branch_solution(const struct pdn_branch *branch,
                               int32_t point,
                               struct pdn_solution **out);

/**
 * Writes a branch as CSV: a line for each point, with the parameter, how the step went, what
 * happens there, what multipliers say if they were wanted (`pdn_branch_options.stability`) and, of
 * each component of quantities, the mean, the size of the first harmonic, the least and the
 * largest value over the period. `script/plot.py` draws it.
 *
 * @param branch  the branch; not NULL
 * @param quantities  array of length [count] of quantities, each initialised by PDN_INIT; may be
 *     NULL if count is 0
 * @param count  number of quantities
 * @param path  name of the file, UTF-8; an existing file is replaced
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE, PDN_ERR_ID, PDN_ERR_VALUE,
 *     PDN_ERR_NOT_AVAILABLE (there are no points; no such quantity), PDN_ERR_GRID_TOO_COARSE,
 *     PDN_ERR_OVERFLOW, PDN_ERR_IO
 *
 * Threads: like `const`. Functions of the model may be called on this thread.
 * @since 0.1
 */
PDN_API
pdn_status pdn_branch_write_csv(const struct pdn_branch *branch,
                                const struct pdn_quantity *quantities,
                                size_t count,
                                const char *path);

/**
 * Writes a chart of the exponents of small disturbances along a branch as CSV, as of Campbell: of
 * each point that is no event a line for each multiplier, but for conjugates and for those that
 * only move the motion in time or space. `script/plot.py` draws it.
 *
 * A line has the parameter, the period, the rate of growth (real part of mu), the angular
 * frequency of the mode in its nodes' own axes and from the ground, the size of the multiplier,
 * the estimated error of that, and what moves: of a rotor with equal parts the pattern that is
 * largest, and its share of their motions. It is `collective`, `alternating` (each part against
 * its neighbours), or a number of nodal diameters, `progressive` where the pattern goes around in
 * the sense of the rotation, `regressive` where against it, seen from the parts, or `standing`.
 * Where no parts are named, or these hardly move, it is the node that moves most.
 *
 * @param branch  the branch; not NULL
 * @param options  may be NULL for the defaults
 * @param blades  array of length [count]: ids of nodes, one of each of the equal parts, the same
 *     on all of them, one after the other around the rotor; may be NULL if count is 0
 * @param count  number of parts: 0, or at least 2
 * @param path  name of the file, UTF-8; an existing file is replaced
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE, PDN_ERR_NOT_FINITE, PDN_ERR_ID,
 *     PDN_ERR_SIZE (one part), PDN_ERR_VALUE (parts that are not around an axis, or twice there),
 *     PDN_ERR_NOT_AVAILABLE (there are no points; cancelled), PDN_ERR_GRID_TOO_COARSE,
 *     PDN_ERR_CALLBACK, PDN_ERR_MEMORY, PDN_ERR_IO
 *
 * Threads: like `const`. Functions of the model and `options.progress` are called on this thread.
 * @since 0.1
 */
PDN_API
pdn_status pdn_branch_write_campbell(const struct pdn_branch *branch,
                                     const struct pdn_stability_options *options,
                                     const int32_t *blades,
                                     size_t count,
                                     const char *path);

/**
 * Sets default options; use `PDN_INIT(pdn_static_options, &options)`.
 *
 * @param options  the options; not NULL
 * @param struct_size  `sizeof *options`
 *
 * Threads: any.
 * @since 0.1
 */
PDN_API
void pdn_static_options_init(struct pdn_static_options *options,
                             size_t struct_size);

/**
 * Finds an equilibrium at one time: of forces at rest, or in steady rotation.
 *
 * Newton's method with the exact tangent, after load steps from the unloaded reference
 * configuration. Where these lead nowhere, as for a pendulum that is not in a position of
 * equilibrium yet, the masses creep downhill. Not converging is no error: PDN_OK says that the
 * solve was carried out, ::pdn_solution_outcome how it ended, ::pdn_solution_report why. A
 * position that nothing determines, such as that of a free body, is PDN_SINGULAR.
 *
 * The solution has a grid of one point and the same values at any time.
 *
 * With options.angular_velocity everything turns steadily, the ground too: the solution is the
 * equilibrium in the turning frame, under centrifugal and gyroscopic forces. Positions and
 * directions are those in that frame, at a moment at which its axes are the inertial ones;
 * velocities and accelerations of nodes are those in the inertial frame, in forces of yours on
 * nodes, too; rates of joints, and dampers, know the motion in the frame only. Loads with
 * PDN_FRAME_SPACE keep their directions in the turning frame, as the ground does. Gravity must be
 * along the axis.
 *
 * @param model  the model; it is copied, so that later changes do not touch the solution
 * @param options  may be NULL for the defaults
 * @param out  the solution, also if it has not converged; free it with ::pdn_solution_free;
 *     written on success only
 * @return PDN_OK; PDN_ERR_NULL; PDN_ERR_NOT_FINITE; PDN_ERR_VALUE (no load step, a period that is
 *     needed but not given, an initial solution of another model); PDN_ERR_STRUCT_SIZE;
 *     PDN_ERR_MODEL (no node, a beam too distorted); PDN_ERR_NOT_PERIODIC (gravity across the axis
 *     of rotation); PDN_ERR_GRID_TOO_COARSE (of the initial solution); PDN_ERR_CALLBACK (of a
 *     signal); PDN_ERR_OVERFLOW (numbers too large to compute with); PDN_ERR_MEMORY
 *
 * Threads: like a `const` use of `model` and of `options.initial`. Signals' functions and
 * `progress` are called on this thread.
 * @since 0.1
 */
PDN_API
pdn_status pdn_solve_static(const struct pdn_model *model,
                            const struct pdn_static_options *options,
                            struct pdn_solution **out);

/**
 * Sets default options; use `PDN_INIT(pdn_modes_options, &options)`.
 *
 * @param options  the options; not NULL
 * @param struct_size  `sizeof *options`
 *
 * Threads: any.
 * @since 0.1
 */
PDN_API
void pdn_modes_options_init(struct pdn_modes_options *options,
                            size_t struct_size);

/**
 * Finds an equilibrium and the modes of small motions `Re(x exp(s t))` about it.
 *
 * The equations of motion with their exact tangents are linearised to `(s² M + s C + K) x = 0`,
 * constraints, internal states of viscoelastic forces, and in a turning frame gyroscopic and
 * centrifugal terms included. Of conjugate pairs of eigenvalues s one is given; constraints make
 * no modes. Each free motion is a mode whose s is exactly 0.
 *
 * That there is no equilibrium is no error: ::pdn_modes_outcome tells, and there are no modes.
 *
 * @param model  the model; it is copied, so that later changes do not touch the modes
 * @param options  may be NULL for the defaults
 * @param out  the modes; free them with ::pdn_modes_free; written on success only
 * @return PDN_OK; PDN_ERR_SIZE (no modes or too many wanted); PDN_ERR_OVERFLOW (stiffnesses and
 *     masses too far apart); else as ::pdn_solve_static
 *
 * Threads: like a `const` use of `model` and of `options.equilibrium.initial`. Signals' functions
 * and `progress` are called on this thread.
 * @since 0.1
 */
PDN_API
pdn_status pdn_solve_modes(const struct pdn_model *model,
                           const struct pdn_modes_options *options,
                           struct pdn_modes **out);

/**
 * Frees modes; NULL does nothing. Solutions made from them stay.
 *
 * @param modes  the modes, not to be used any more
 *
 * Threads: exclusive use of `modes`.
 * @since 0.1
 */
PDN_API
void pdn_modes_free(struct pdn_modes *modes);

/**
 * How the search for the equilibrium ended.
 *
 * @param modes  the modes; not NULL
 * @return as ::pdn_solution_outcome; unless it is PDN_CONVERGED there are no modes
 *
 * Threads: like `const`.
 * @since 0.1
 */
PDN_API
int32_t pdn_modes_outcome(const struct pdn_modes *modes);

/**
 * A readable report: outcome of the equilibrium and why, and a table of the modes.
 *
 * @param modes  the modes; not NULL
 * @param buffer  array of length [capacity] for the text, UTF-8, always ended by NUL; may be NULL
 *     if capacity is 0
 * @param capacity  size of buffer in bytes
 * @return length of the whole report without the NUL, as snprintf does; 0 if the handle is not
 *     valid
 *
 * Threads: like `const`.
 * @since 0.1
 */
PDN_API
size_t pdn_modes_report(const struct pdn_modes *modes,
                        char *buffer,
                        size_t capacity);

/**
 * Number of modes: as many as were wanted, if there are and they were found.
 *
 * @param modes  the modes; not NULL
 * @param out  the number; written on success only
 * @param complete  1 if the wanted number was found, or all that there are, else 0; may be NULL;
 *     written on success only
 * @return PDN_OK, PDN_ERR_NULL
 *
 * Threads: like `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_modes_count(const struct pdn_modes *modes,
                           int32_t *out,
                           int32_t *complete);

/**
 * Prepares a struct for ::pdn_modes_get; use `PDN_INIT(pdn_mode, &mode)`.
 *
 * @param mode  the struct; not NULL
 * @param struct_size  `sizeof *mode`
 *
 * Threads: any.
 * @since 0.1
 */
PDN_API
void pdn_mode_init(struct pdn_mode *mode,
                   size_t struct_size);

/**
 * Eigenvalue, frequency and damping of a mode.
 *
 * @param modes  the modes; not NULL
 * @param mode  number of the mode, from 0; the smallest eigenvalue, or the nearest to the wanted
 *     frequency, is first
 * @param out  initialised by PDN_INIT; filled on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID, PDN_ERR_STRUCT_SIZE
 *
 * Threads: like `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_modes_get(const struct pdn_modes *modes,
                         int32_t mode,
                         struct pdn_mode *out);

/**
 * Shape x of a mode at some nodes.
 *
 * For each node its small displacement and rotation along the node's own axes, as they are in the
 * equilibrium. The largest component of all nodes is 1, with displacements relative to the size of
 * the mechanism and rotations in radians.
 *
 * @param modes  the modes; not NULL
 * @param mode  number of the mode, from 0
 * @param nodes  array of length [count]: ids of the nodes
 * @param count  number of nodes
 * @param real  array of shape 6 x [count]: real part, components fastest
 * @param imaginary  array of shape 6 x [count]: imaginary part; may be NULL
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID, PDN_ERR_SIZE
 *
 * Threads: like `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_modes_shape(const struct pdn_modes *modes,
                           int32_t mode,
                           const int32_t *nodes,
                           size_t count,
                           double *real,
                           double *imaginary);

/**
 * The motion in a mode, to be looked at as any other solution.
 *
 * From the equilibrium each node moves by the exponential of `amplitude Re(x exp(i ω t))`, with ω
 * = Im s: it neither decays nor grows, and repeats after 2π/ω. For a real s, ω is its size; for a
 * free motion the period is that of the options, or 1. The equations hold but for the square of
 * the amplitude.
 *
 * @param modes  the modes; not NULL
 * @param mode  number of the mode, from 0
 * @param amplitude  factor of the shape
 * @param out  the solution; free it with ::pdn_solution_free; written on success only
 * @return PDN_OK; PDN_ERR_NULL; PDN_ERR_ID; PDN_ERR_NOT_FINITE; PDN_ERR_MODEL or
 *     PDN_ERR_GRID_TOO_COARSE (an amplitude so large that beams fold or turns cannot be followed);
 *     PDN_ERR_OVERFLOW (one larger still); PDN_ERR_CALLBACK; PDN_ERR_MEMORY
 *
 * Threads: like `const`; signals' functions are called on this thread.
 * @since 0.1
 */
PDN_API
pdn_status pdn_modes_motion(const struct pdn_modes *modes,
                            int32_t mode,
                            double amplitude,
                            struct pdn_solution **out);

/**
 * The equilibrium, as ::pdn_solve_static gives it, converged or not.
 *
 * @param modes  the modes; not NULL
 * @param out  the solution; free it with ::pdn_solution_free; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_CALLBACK, PDN_ERR_MEMORY
 *
 * Threads: like `const`; signals' functions are called on this thread.
 * @since 0.1
 */
PDN_API
pdn_status pdn_modes_equilibrium(const struct pdn_modes *modes,
                                 struct pdn_solution **out);

/**
 * Sets default options; use `PDN_INIT(pdn_march_options, &options)`.
 *
 * @param options  the options; not NULL
 * @param struct_size  `sizeof *options`
 *
 * Threads: any.
 * @since 0.1
 */
PDN_API
void pdn_march_options_init(struct pdn_march_options *options,
                            size_t struct_size);

/**
 * Marches a model in time, for a given duration or until its motion repeats itself.
 *
 * The generalised-alpha method on SE(3) for the equations of index 3 (Arnold and Bruels 2007;
 * Bruels, Cardona and Arnold 2012), of second order: motions are updated by the exponential map,
 * equilibrium and constraints hold at the end of each step. It starts in the reference
 * configuration at rest unless another start is given, but what hangs on a prescribed rotation
 * turns with it as one rigid body, if the joints let it: a blade is not left behind a hub that
 * spins. Then motions are moved and velocities changed by the least, by inertia, that satisfies
 * the constraints and prescribed motions, and accelerations and reactions follow. Internal states
 * of viscoelastic elements start relaxed, or as they are in the initial solution.
 *
 * The solution is a trajectory: the functions of solutions give its quantities at any times from
 * its first to its last. Between steps motions, velocities and joint coordinates are interpolated
 * by cubic polynomials, all else linearly. It has no harmonics. Not reaching the end is no error:
 * ::pdn_solution_outcome tells, and the trajectory is there as far as it came. It serves as
 * `initial` of other solves; of a periodic one, its last period does.
 *
 * @param model  the model; it is copied, so that later changes do not touch the solution. Signals
 *     that are functions are called with the times of the march, and need not be periodic
 * @param options  not NULL: how long, and in which steps
 * @param out  the solution, also if the march ended early; free it with ::pdn_solution_free;
 *     written on success only
 * @return PDN_OK; PDN_ERR_NULL; PDN_ERR_NOT_FINITE; PDN_ERR_VALUE (no duration or step, a period
 *     that is needed but not given, an initial solution of another model, rotations that are
 *     none); PDN_ERR_STRUCT_SIZE; PDN_ERR_MODEL (no node, a beam too distorted);
 *     PDN_ERR_GRID_TOO_COARSE (of the initial solution); PDN_ERR_CALLBACK (of a signal or force);
 *     PDN_ERR_OVERFLOW (numbers too large to compute with); PDN_ERR_MEMORY
 *
 * Threads: like a `const` use of `model` and of `options.initial`. Signals' functions and
 * `progress` are called on this thread.
 * @since 0.1
 */
PDN_API
pdn_status pdn_solve_march(const struct pdn_model *model,
                           const struct pdn_march_options *options,
                           struct pdn_solution **out);

/**
 * Prepares a struct for ::pdn_solution_march; use `PDN_INIT(pdn_march_diagnostics, &diagnostics)`.
 *
 * @param diagnostics  the struct; not NULL
 * @param struct_size  `sizeof *diagnostics`
 *
 * Threads: any.
 * @since 0.1
 */
PDN_API
void pdn_march_diagnostics_init(struct pdn_march_diagnostics *diagnostics,
                                size_t struct_size);

/**
 * Figures of a march: steps, periods, how much the last of them differ, how much the start was
 * changed.
 *
 * @param solution  a solution of ::pdn_solve_march; not NULL
 * @param out  initialised by PDN_INIT; filled on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE, PDN_ERR_NOT_AVAILABLE (the solution is no
 *     trajectory)
 *
 * Threads: like `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_solution_march(const struct pdn_solution *solution,
                              struct pdn_march_diagnostics *out);

/**
 * Sets default options; use `PDN_INIT(pdn_shooting_options, &options)`.
 *
 * @param options  the options; not NULL
 * @param struct_size  `sizeof *options`
 *
 * Threads: any.
 * @since 0.1
 */
PDN_API
void pdn_shooting_options_init(struct pdn_shooting_options *options,
                               size_t struct_size);

/**
 * Finds the periodic response of a model by shooting: Newton's method on the period map of
 * ::pdn_solve_march.
 *
 * What is found is the periodic motion of the marching scheme, of second order in its step; the
 * derivative of the map is exact. It needs time and memory that grow with the square of the number
 * of nodes; it is there to compare with, and for the Floquet multipliers, which tell whether the
 * motion is stable.
 *
 * The solution is a trajectory over one period, from 0 to T. Not converging is no error:
 * ::pdn_solution_outcome tells. A motion that may be shifted in time or space, as without a drive
 * or without damping, is PDN_SINGULAR.
 *
 * @param model  the model; it is copied, so that later changes do not touch the solution
 * @param period  T, the period of the response; harmonics of signals are those of this period
 * @param options  may be NULL for the defaults
 * @param out  the solution, also if it has not converged; free it with ::pdn_solution_free;
 *     written on success only
 * @return PDN_OK; PDN_ERR_NULL; PDN_ERR_NOT_FINITE; PDN_ERR_VALUE; PDN_ERR_STRUCT_SIZE;
 *     PDN_ERR_MODEL (no node, a beam too distorted); PDN_ERR_NOT_PERIODIC (a prescribed motion or
 *     load that does not repeat); PDN_ERR_GRID_TOO_COARSE (of the initial solution);
 *     PDN_ERR_CALLBACK (of a signal or force); PDN_ERR_MEMORY
 *
 * Threads: like a `const` use of `model` and of `options.initial`. Signals' functions and
 * `progress` are called on this thread.
 * @since 0.1
 */
PDN_API
pdn_status pdn_solve_shooting(const struct pdn_model *model,
                              double period,
                              const struct pdn_shooting_options *options,
                              struct pdn_solution **out);

/**
 * Number of Floquet multipliers of a solution: as many as the system has states, if
 * ::pdn_solve_shooting found them; of a periodic solution as many as ::pdn_solve_stability finds,
 * which is called with default options unless it has been before.
 *
 * @param solution  a solution of ::pdn_solve_periodic, or one like it, that has converged, of
 *     ::pdn_solve_shooting or of ::pdn_solve_march; not NULL
 * @param out  the number; zero of a march; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_AVAILABLE (of an equilibrium or a small motion, and of
 *     what has not converged); else as ::pdn_solve_stability
 *
 * Threads: like `const`. Functions of the model may be called on this thread.
 * @since 0.1
 */
PDN_API
pdn_status pdn_solution_floquet_count(const struct pdn_solution *solution,
                                      size_t *out);

/**
 * Floquet multipliers: what disturbances of the motion are multiplied by in a period, the largest
 * first.
 *
 * The motion is stable if all are smaller than 1 in magnitude. Those of shooting are of the
 * marching scheme, with its error and its numerical damping; ::pdn_solve_stability tells more of
 * those of periodic solutions.
 *
 * @param solution  as for ::pdn_solution_floquet_count; not NULL
 * @param real  array of length [count] for the real parts
 * @param imaginary  array of length [count] for the imaginary parts
 * @param count  their number, as ::pdn_solution_floquet_count tells
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_SIZE, PDN_ERR_NOT_AVAILABLE as there; else as
 *     ::pdn_solve_stability
 *
 * Threads: like `const`. Functions of the model may be called on this thread.
 * @since 0.1
 */
PDN_API
pdn_status pdn_solution_floquet(const struct pdn_solution *solution,
                                double *real,
                                double *imaginary,
                                size_t count);

/**
 * Sets default options; use `PDN_INIT(pdn_stability_options, &options)`.
 *
 * @param options  the options; not NULL
 * @param struct_size  `sizeof *options`
 *
 * Threads: any.
 * @since 0.1
 */
PDN_API
void pdn_stability_options_init(struct pdn_stability_options *options,
                                size_t struct_size);

/**
 * Finds the Floquet multipliers of a periodic solution: what small disturbances are multiplied by
 * in a period.
 *
 * Disturbances obey the exact linearised equations, constraints, redundant ones too, and internal
 * states included, about the solution interpolated between its grid points. They are integrated
 * over the period in steps that are halved until the multipliers of modes up to the highest
 * frequency stand still. The error of the periodic solution itself comes with theirs.
 *
 * @param solution  a converged solution of ::pdn_solve_periodic or one like it; not NULL
 * @param options  may be NULL for the defaults
 * @param out  the multipliers; free them with ::pdn_stability_free; written on success only
 * @return PDN_OK; PDN_ERR_NULL; PDN_ERR_NOT_FINITE; PDN_ERR_VALUE; PDN_ERR_STRUCT_SIZE;
 *     PDN_ERR_NOT_AVAILABLE (no periodic solution, or one that has not converged);
 *     PDN_ERR_GRID_TOO_COARSE (a motion that cannot be interpolated); PDN_ERR_CALLBACK (of a
 *     signal or force); PDN_ERR_MEMORY
 *
 * Threads: like a `const` use of `solution`. Signals' functions, forces and `progress` are called
 * on this thread.
 * @since 0.1
 */
PDN_API
pdn_status pdn_solve_stability(const struct pdn_solution *solution,
                               const struct pdn_stability_options *options,
                               struct pdn_stability **out);

/**
 * Frees multipliers; NULL does nothing.
 *
 * @param stability  the multipliers, not to be used any more
 *
 * Threads: exclusive use of `stability`.
 * @since 0.1
 */
PDN_API
void pdn_stability_free(struct pdn_stability *stability);

/**
 * How the analysis ended.
 *
 * @param stability  the multipliers; not NULL
 * @return PDN_CONVERGED; PDN_TOLERANCE_NOT_MET (not all multipliers up to the highest frequency
 *     that was asked for are known to the tolerance); PDN_SINGULAR or PDN_CANCELLED (there are no
 *     multipliers); or an error as ::pdn_solution_outcome
 *
 * Threads: like `const`.
 * @since 0.1
 */
PDN_API
int32_t pdn_stability_outcome(const struct pdn_stability *stability);

/**
 * What the multipliers say.
 *
 * @param stability  the multipliers; not NULL
 * @param verdict  PDN_STABLE, PDN_UNSTABLE or PDN_STABILITY_NOT_KNOWN; written on success only
 * @param frequency_limit  angular frequency of modes up to which the verdict holds; infinite if
 *     all multipliers are known; may be NULL; written on success only
 * @return PDN_OK, PDN_ERR_NULL
 *
 * Threads: like `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_stability_verdict(const struct pdn_stability *stability,
                                 int32_t *verdict,
                                 double *frequency_limit);

/**
 * Number of multipliers that are known, and of those that the system has, one for each state.
 *
 * Multipliers of modes far above the highest frequency that was asked for may be left out.
 *
 * @param stability  the multipliers; not NULL
 * @param out  the number that are known; written on success only
 * @param states  the number that the system has; may be NULL; written on success only
 * @return PDN_OK, PDN_ERR_NULL
 *
 * Threads: like `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_stability_count(const struct pdn_stability *stability,
                               size_t *out,
                               size_t *states);

/**
 * Prepares a struct for ::pdn_stability_get; use `PDN_INIT(pdn_multiplier, &multiplier)`.
 *
 * @param multiplier  the struct; not NULL
 * @param struct_size  `sizeof *multiplier`
 *
 * Threads: any.
 * @since 0.1
 */
PDN_API
void pdn_multiplier_init(struct pdn_multiplier *multiplier,
                         size_t struct_size);

/**
 * A multiplier.
 *
 * @param stability  the multipliers; not NULL
 * @param number  its number, from 0: the largest is first, of a conjugate pair that with the
 *     positive imaginary part
 * @param out  initialised by PDN_INIT; filled on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID, PDN_ERR_STRUCT_SIZE
 *
 * Threads: like `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_stability_get(const struct pdn_stability *stability,
                             int32_t number,
                             struct pdn_multiplier *out);

/**
 * Number of times of the shapes of modes.
 *
 * @param stability  the multipliers; not NULL
 * @param out  the number; written on success only
 * @return PDN_OK, PDN_ERR_NULL
 *
 * Threads: like `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_stability_time_count(const struct pdn_stability *stability,
                                    size_t *out);

/**
 * Times of the shapes of modes: ends of equal steps over the period, the last is the period.
 *
 * @param stability  the multipliers; not NULL
 * @param times  array of length [count]
 * @param count  their number, as ::pdn_stability_time_count tells
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_SIZE
 *
 * Threads: like `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_stability_times(const struct pdn_stability *stability,
                               double *times,
                               size_t count);

/**
 * The mode phi of a multiplier at a node over the period.
 *
 * Small displacements and rotations along the node's own axes, at the times of
 * ::pdn_stability_times. The largest component of all nodes over the period is 1, with
 * displacements relative to the size of the mechanism and rotations in radians.
 *
 * @param stability  the multipliers; not NULL
 * @param number  number of the multiplier, from 0
 * @param node  id of the node
 * @param steps  number of times, as ::pdn_stability_time_count tells
 * @param real  array of shape 6 x [steps]: real part, components fastest
 * @param imaginary  array of shape 6 x [steps]: imaginary part; may be NULL
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID, PDN_ERR_SIZE
 *
 * Threads: like `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_stability_shape(const struct pdn_stability *stability,
                               int32_t number,
                               int32_t node,
                               size_t steps,
                               double *real,
                               double *imaginary);

/**
 * A readable report: the verdict, how far it holds, and a table of the multipliers.
 *
 * @param stability  the multipliers; not NULL
 * @param buffer  array of length [capacity] for the text, UTF-8, always ended by NUL; may be NULL
 *     if capacity is 0
 * @param capacity  size of buffer in bytes
 * @return length of the whole report without the NUL, as snprintf does; 0 if the handle is not
 *     valid
 *
 * Threads: like `const`.
 * @since 0.1
 */
PDN_API
size_t pdn_stability_report(const struct pdn_stability *stability,
                            char *buffer,
                            size_t capacity);

/**
 * Interpolates a periodic motion given at N equispaced times, by dual polar decomposition.
 *
 * Exponentially accurate as N grows, for rotations and translations of any size (section 4 of Han
 * and Bauchau, Nonlinear Dynamics 92, 2018).
 *
 * @param period  T, the period of the motion
 * @param positions  array of shape 3 x [points]: positions at t = k T / N
 * @param rotations  array of shape 9 x [points]: rotation matrices, each column by column
 * @param points  N, odd
 * @param times  array of length [count]: times wanted, anywhere
 * @param count  number of times
 * @param position  array of shape 3 x [count]; may be NULL
 * @param rotation  array of shape 9 x [count], each matrix column by column; may
 *     be NULL
 * @param velocity  array of shape 6 x [count]: linear and angular velocity along the moving axes;
 *     may be NULL
 * @param acceleration  array of shape 6 x [count]: time derivative of velocity; may be NULL
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_SIZE, PDN_ERR_VALUE,
 *     PDN_ERR_GRID_TOO_COARSE
 *
 * Threads: any.
 * @since 0.1
 */
PDN_API
pdn_status pdn_motion_interpolate(double period,
                                  const double *positions,
                                  const double *rotations,
                                  size_t points,
                                  const double *times,
                                  size_t count,
                                  double *position,
                                  double *rotation,
                                  double *velocity,
                                  double *acceleration);

/**
 * Velocities and accelerations of a motion at its own grid points, and their exact linearisation.
 *
 * With the material increments u = (R^T dr, dpsi) of the motions, ordered as 6 for each point, d
 * velocity = velocity_tangent u and d acceleration = acceleration_tangent u (eqs. 24 to 29 of the
 * paper).
 *
 * @param period  T, the period of the motion
 * @param positions  array of shape 3 x [points]: positions at t = k T / N
 * @param rotations  array of shape 9 x [points]: rotation matrices, each column by column
 * @param points  N, odd
 * @param velocity  array of shape 6 x [points]: linear and angular velocity along the moving axes;
 *     may be NULL
 * @param acceleration  array of shape 6 x [points]: time derivative of velocity; may be NULL
 * @param velocity_tangent  array of shape [6 * points] x [6 * points]: derivatives of
 *     velocity by u, column by column; may be NULL
 * @param acceleration_tangent  array of shape [6 * points] x [6 * points]: derivatives of
 *     acceleration by u, column by column; may be NULL
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_SIZE, PDN_ERR_VALUE
 *
 * Threads: any.
 * @since 0.1
 */
PDN_API
pdn_status pdn_motion_grid_kinematics(double period,
                                      const double *positions,
                                      const double *rotations,
                                      size_t points,
                                      double *velocity,
                                      double *acceleration,
                                      double *velocity_tangent,
                                      double *acceleration_tangent);

/**
 * A frame from a point and two directions, such as that of a joint or a bushing.
 *
 * @param point  array of length 3: its origin, global coordinates [length]
 * @param axis_3  array of length 3: direction of its axis 3, global coordinates, of any nonzero
 *     length
 * @param axis_1  array of length 3: direction whose part across axis 3 is its axis 1, global
 *     coordinates; not along axis 3
 * @param frame  the frame; axis 2 is what makes it right-handed; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_VALUE
 *
 * Threads: any.
 * @since 0.1
 */
PDN_API
pdn_status pdn_joint_frame(const double *point,
                           const double *axis_3,
                           const double *axis_1,
                           struct pdn_frame *frame);

/**
 * Prepares a struct for ::pdn_model_summary; use `PDN_INIT(pdn_summary, &summary)`.
 *
 * @param summary  the struct; not NULL
 * @param struct_size  `sizeof *summary`
 *
 * Threads: any.
 * @since 0.1
 */
PDN_API
void pdn_summary_init(struct pdn_summary *summary,
                      size_t struct_size);

/**
 * Counts, mass, degrees of freedom and mobility of a model in its reference configuration.
 *
 * @param model  the model
 * @param out  initialised by PDN_INIT; filled on success only
 * @return PDN_OK; PDN_ERR_NULL; PDN_ERR_STRUCT_SIZE; PDN_ERR_MODEL (no node, a beam too
 *     distorted); PDN_ERR_OVERFLOW (of the mass); PDN_ERR_CALLBACK (of a signal)
 *
 * Threads: like `const`. Signals' functions are called on this thread.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_summary(const struct pdn_model *model,
                             struct pdn_summary *out);

/**
 * The same in readable lines, with warnings: parts that nothing connects or holds, ends of beams
 * without a joint, nodes without inertia, joints open in the reference configuration or far from
 * all else, impossible moments of inertia, sizes, masses and stiffnesses that do not fit each
 * other.
 *
 * @param model  the model; not NULL
 * @param buffer  array of length [capacity] for the text, UTF-8, always ended by NUL; may be NULL
 *     if capacity is 0
 * @param capacity  size of buffer in bytes
 * @return length of the whole text without the NUL, as snprintf does; 0 if the handle is not valid
 *     or ::pdn_model_summary fails, see ::pdn_last_error
 *
 * Threads: like `const`. Signals' functions are called on this thread.
 * @since 0.1
 */
PDN_API
size_t pdn_model_describe(const struct pdn_model *model,
                          char *buffer,
                          size_t capacity);

/**
 * A table over these times, to choose columns for and to write as CSV.
 *
 * Its first column, `t`, are the times. Columns come from one solution or from several, which are
 * sampled as they are added and may then be freed.
 *
 * @param times  array of length [count]: times, also outside the first period, in any order
 * @param count  number of times, at least 1
 * @param out  the table; free it with ::pdn_table_free; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_SIZE
 *
 * Threads: any.
 * @since 0.1
 */
PDN_API
pdn_status pdn_table_new(const double *times,
                         size_t count,
                         struct pdn_table **out);

/**
 * Frees a table; NULL does nothing.
 *
 * @param table  the table, not to be used any more
 *
 * Threads: exclusive use of `table`.
 * @since 0.1
 */
PDN_API
void pdn_table_free(struct pdn_table *table);

/**
 * Adds a column of values of your own, such as one computed from several quantities.
 *
 * @param table  the table; not NULL
 * @param label  name of the column; not NULL
 * @param values  array of length [count]: a value for each time
 * @param count  number of values: that of the times
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_SIZE, PDN_ERR_VALUE (a name that a
 *     column has already)
 *
 * Threads: exclusive use of `table`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_table_add_values(struct pdn_table *table,
                                const char *label,
                                const double *values,
                                size_t count);

/**
 * Writes a table as a CSV file: a line of names, then a line for each time.
 *
 * Columns are separated by commas, names with commas or quotes are quoted. Numbers have as many
 * digits as it takes to read them back exactly.
 *
 * @param table  the table; not NULL
 * @param path  where to, UTF-8. A file that is there is replaced when all is written; if that
 *     fails it stays as it was. A terminal or pipe, such as "/dev/stdout", is written to directly
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_VALUE (text that is not UTF-8), PDN_ERR_IO
 *
 * Threads: like a `const` use of `table`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_table_write_csv(const struct pdn_table *table,
                               const char *path);

/**
 * Writes an animation of a solution that ParaView opens: VTK's XML files, and a list of them.
 *
 * `path` names the list; the files are put into a directory beside it that has its name without
 * `.pvd`. For each time there is one file for each of these parts that the model has:
 *
 * - `beams`: a line of `points_per_element` points for each beam element (draw it with the filter
 *   Tube). Each point has displacement, axes of the section (axis_1, axis_2, axis_3), and force,
 *   moment, strain, curvature along these axes; each line its element;
 * - `shells`: a curved quadrilateral of its own order for each shell element, with displacement,
 *   axes (those of the section and the normal), strains and resultants along these, and of
 *   isotropic shells stress_top and stress_bottom with von Mises' stresses; each its element;
 * - `bodies`: the nodes that carry a rigid body or belong to no beam and no shell, with node,
 *   displacement, axes, velocity, angular_velocity;
 * - `joints`: the origins of the joint frames on the second bodies, with joint, displacement,
 *   axes, reaction_force, reaction_moment.
 *
 * Displacements are from the reference configuration. Vectors are along the inertial axes, but for
 * the internal forces and strains of beams.
 *
 * @param solution  the solution; not NULL
 * @param times  array of length [count]: times of the animation, ascending, also outside the first
 *     period
 * @param count  number of times, at least 1
 * @param points_per_element  points along each beam element, 2 to 1000
 * @param path  where to, UTF-8, ending in `.pvd`. Files of these names are replaced; if writing
 *     fails, they stay as they were
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_SIZE, PDN_ERR_VALUE (times that do not
 *     ascend, a path that does not end in `.pvd`, or whose name has control characters),
 *     PDN_ERR_GRID_TOO_COARSE, PDN_ERR_OVERFLOW, PDN_ERR_IO
 *
 * Threads: like a `const` use of `solution`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_solution_write_vtk(const struct pdn_solution *solution,
                                  const double *times,
                                  size_t count,
                                  size_t points_per_element,
                                  const char *path);

/**
 * Saves a solution with its model, whether it has converged or not.
 *
 * ::pdn_solution_load gives it back, to the last bit. Callbacks cannot be saved: see there. The
 * format is the same on all platforms, and later versions of the library read it.
 *
 * @param solution  the solution; not NULL
 * @param path  where to, UTF-8. A file that is there is replaced when all is written; if that
 *     fails it stays as it was
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_VALUE (text that is not UTF-8), PDN_ERR_IO
 *
 * Threads: like a `const` use of `solution`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_solution_save(const struct pdn_solution *solution,
                             const char *path);

/**
 * Loads a solution that ::pdn_solution_save saved: its quantities, diagnostics and report are what
 * they were.
 *
 * A solve may start from it (the option `initial`), of your model or of the one that
 * ::pdn_solution_model gives. If the solved model had callbacks, in signals or forces, the
 * quantities of the solution are there all the same; but a solve of the model that was loaded with
 * it fails with PDN_ERR_CALLBACK, as its callbacks are not.
 *
 * @param path  the file, UTF-8. It need not be trusted: its checksum and everything in it are
 *     checked
 * @param out  the solution; free it with ::pdn_solution_free; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_VALUE (text that is not UTF-8), PDN_ERR_IO, PDN_ERR_FORMAT
 *     (not a saved solution, cut off, damaged, or of a newer version), PDN_ERR_MEMORY
 *
 * Threads: any.
 * @since 0.1
 */
PDN_API
pdn_status pdn_solution_load(const char *path,
                             struct pdn_solution **out);

/**
 * A copy of the model that a solution is of, as it was when it was solved.
 *
 * @param solution  the solution; not NULL
 * @param out  the model; free it with ::pdn_model_free; written on success only
 * @return PDN_OK, PDN_ERR_NULL
 *
 * Threads: like a `const` use of `solution`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_solution_model(const struct pdn_solution *solution,
                              struct pdn_model **out);

/**
 * A copy of a model, which may be changed and solved apart from it.
 *
 * @param model  the model; not NULL
 * @param out  the copy; free it with ::pdn_model_free; written on success only. It shares the
 *     callbacks of the model and their user_data
 * @return PDN_OK, PDN_ERR_NULL
 *
 * Threads: `model` is `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_copy(const struct pdn_model *model,
                          struct pdn_model **out);

/**
 * Saves a model.
 *
 * ::pdn_model_load gives it back. Callbacks cannot be saved: see there. The format is the same on
 * all platforms, and later versions of the library read it.
 *
 * @param model  the model; not NULL
 * @param path  where to, UTF-8. A file that is there is replaced when all is written; if that
 *     fails it stays as it was
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_VALUE (text that is not UTF-8), PDN_ERR_IO
 *
 * Threads: `model` is `const`.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_save(const struct pdn_model *model,
                          const char *path);

/**
 * Loads a model that ::pdn_model_save saved; its ids are what they were.
 *
 * If it had callbacks, in signals or forces, a solve of it fails with PDN_ERR_CALLBACK, as they
 * are not there.
 *
 * @param path  the file, UTF-8. It need not be trusted: its checksum and everything in it are
 *     checked
 * @param out  the model; free it with ::pdn_model_free; written on success only
 * @return PDN_OK, PDN_ERR_NULL, PDN_ERR_VALUE (text that is not UTF-8), PDN_ERR_IO, PDN_ERR_FORMAT
 *     (not a saved model, cut off, damaged, or of a newer version), PDN_ERR_MEMORY
 *
 * Threads: any.
 * @since 0.1
 */
PDN_API
pdn_status pdn_model_load(const char *path,
                          struct pdn_model **out);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* PERIODYN_H */

#ifndef PERIODYN_H_INLINE
/** @cond */
#define PERIODYN_H_INLINE
/** @endcond */
/**
 * What is asked of a solution: a kind of quantity of an object, one of its components (or coordinate
 * of a joint) or PDN_ALL_COMPONENTS. Other fields may be set then.
 */
static inline pdn_quantity pdn_quantity_of(int32_t kind, int32_t object, int32_t component)
{
    pdn_quantity quantity;
    PDN_INIT(pdn_quantity, &quantity);
    quantity.kind = kind;
    quantity.object = object;
    quantity.component = component;
    return quantity;
}

#ifndef __cplusplus
/**
 * A quantity of these fields; a frame that is not given is the default.
 */
static inline pdn_quantity pdn_quantity_with(pdn_quantity fields)
{
    pdn_quantity quantity;
    PDN_INIT(pdn_quantity, &quantity);
    fields.struct_size = quantity.struct_size;
    if (fields.frame == 0)
        fields.frame = quantity.frame;
    return fields;
}

/**
 * A pointer to a quantity, valid in the block where it stands: kind, object, component and, by name,
 * other fields, as in PDN_QUANTITY(PDN_BEAM_FORCE, element, PDN_ALL_COMPONENTS, .station = -1).
 */
#define PDN_QUANTITY(of_kind, of_object, ...) \
    ((const pdn_quantity[]){pdn_quantity_with((pdn_quantity){ \
        .kind = (of_kind), .object = (of_object), .component = __VA_ARGS__})})
#endif

#endif  /* PERIODYN_H_INLINE */
