/**
 * @file periodyn.hpp
 * Periodyn for C++17: periodyn.h with handles that free themselves, exceptions and std containers.
 *
 * Functions have the names of periodyn.h without the prefix, and its documentation holds. In short:
 *
 * - A function of a handle is a method of its class. What it writes, it returns: several outputs as
 *   a struct. What may be left out comes last.
 * - What fails throws periodyn::error. That a solve did not converge is no error, but an Outcome.
 * - Callbacks may be lambdas, and may throw: the exception comes out of the call that needed them.
 * - Handles can be moved, not copied; using one that was moved from throws PDN_ERR_NULL.
 * - Arrays come as std::vector, those of fixed size as std::array; components of each time
 *   together.
 * - With PERIODYN_EIGEN defined, or Eigen/Core included before, periodyn::array and periodyn::view
 *   convert between these and Eigen's matrices.
 *
 * What stands between lines "WRITTEN BY script/cpp_interface" and "END" follows from periodyn.h;
 * do not edit it.
 */

#ifndef PERIODYN_HPP
#define PERIODYN_HPP

#include <periodyn.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <initializer_list>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace periodyn
{

// WRITTEN BY script/cpp_interface: constants
/** @name Constants of periodyn.h */
///@{
/** Id of the node that was added first, or of the rigid body, which is one. */
constexpr std::int32_t first_node = PDN_FIRST_NODE;
/** Id of the joint that was added first. */
constexpr std::int32_t first_joint = PDN_FIRST_JOINT;
/** Id of the beam element that was added first. */
constexpr std::int32_t first_beam_element = PDN_FIRST_BEAM_ELEMENT;
/** Id of the shell element that was added first. */
constexpr std::int32_t first_shell_element = PDN_FIRST_SHELL_ELEMENT;
/** Id of the force that was added first, which is no load. */
constexpr std::int32_t first_force = PDN_FIRST_FORCE;
/** Id of the linear relation between joint coordinates that was added first. */
constexpr std::int32_t first_relation = PDN_FIRST_RELATION;
/** Id of the parameter that was added first. */
constexpr std::int32_t first_parameter = PDN_FIRST_PARAMETER;
/** Id of the load on a node, or at a point, that was added first. */
constexpr std::int32_t first_load = PDN_FIRST_LOAD;
/** Id of the load along beam elements that was added first. */
constexpr std::int32_t first_beam_load = PDN_FIRST_BEAM_LOAD;
/** Id of the load on shell elements that was added first. */
constexpr std::int32_t first_shell_load = PDN_FIRST_SHELL_LOAD;
/** Id of the inertia that was added first: that of a rigid body, or a mass or inertia on a node. */
constexpr std::int32_t first_inertia = PDN_FIRST_INERTIA;
/** Id of the coordinate that was prescribed first. */
constexpr std::int32_t first_prescribed = PDN_FIRST_PRESCRIBED;
/** In place of a node's id: the ground, which does not move. */
constexpr std::int32_t ground = PDN_GROUND;
/** Bytes of a label at most, without the NUL. */
constexpr std::int32_t label_length = PDN_LABEL_LENGTH;
/** All components of a quantity. */
constexpr std::int32_t all_components = PDN_ALL_COMPONENTS;
/** A parameter: the circular frequency 2 pi / T, which every model has. */
constexpr std::int32_t frequency = PDN_FREQUENCY;
/** In place of an id: gravity, whose components have signals. */
constexpr std::int32_t gravity = PDN_GRAVITY;
///@}

/** @name Roles of constants */
///@{
/** Kind of quantity. */
enum class Kind : std::int32_t {
    /** Kind of quantity: position of a node; 3 components \[length\]. */
    node_position = PDN_NODE_POSITION,
    /** Kind of quantity: rotation matrix of a node, column by column; 9 components. */
    node_rotation = PDN_NODE_ROTATION,
    /** Kind of quantity: unit quaternion (w, x, y, z) of a node, of continuous sign; 4
     * components. */
    node_quaternion = PDN_NODE_QUATERNION,
    /** Kind of quantity: velocity and angular velocity of a node, in a frame; 6 components. */
    node_velocity = PDN_NODE_VELOCITY,
    /** Kind of quantity: acceleration and angular acceleration of a node, in a frame; 6
     * components. */
    node_acceleration = PDN_NODE_ACCELERATION,
    /** Kind of quantity: a coordinate of a joint, angles followed through whole turns. */
    joint_coordinate = PDN_JOINT_COORDINATE,
    /** Kind of quantity: rate of a coordinate of a joint. */
    joint_rate = PDN_JOINT_RATE,
    /** Kind of quantity: second derivative in time of a coordinate of a joint. */
    joint_acceleration = PDN_JOINT_ACCELERATION,
    /** Kind of quantity: force or torque that drives a prescribed coordinate of a joint. */
    joint_driving_effort = PDN_JOINT_DRIVING_EFFORT,
    /** Kind of quantity: force and moment of a joint on its second body, along axes; 6
     * components. */
    joint_reaction = PDN_JOINT_REACTION,
    /** Kind of quantity: strains and curvatures of a beam element; 6 components. */
    beam_strain = PDN_BEAM_STRAIN,
    /** Kind of quantity: internal forces and moments of a beam element; 6 components. */
    beam_force = PDN_BEAM_FORCE,
    /** Kind of quantity: the same, at a node between two elements the mean of those of both. */
    beam_force_mean = PDN_BEAM_FORCE_MEAN,
    /** Kind of quantity: at a node between two elements, internal forces of the one beyond it less
     * those of the one before it; zero elsewhere; 6 components. */
    beam_force_jump = PDN_BEAM_FORCE_JUMP,
    /** Kind of quantity: effort of a force on its joint coordinate. */
    force_effort = PDN_FORCE_EFFORT,
    /** Kind of quantity: effort of a branch of a viscoelastic element. */
    force_branch_effort = PDN_FORCE_BRANCH_EFFORT,
    /** Kind of quantity: elongation of the dashpot of a branch of a viscoelastic element. */
    force_branch_elongation = PDN_FORCE_BRANCH_ELONGATION,
    /** Kind of quantity: what a force exerts on one of its nodes, in a frame: force and moment; 6
     * components. */
    force_on_node = PDN_FORCE_ON_NODE,
    /** Kind of quantity: the efforts of a bushing against its deformation, forces along the axes of
     * its first frame and moments; 6 components. */
    force_bushing_efforts = PDN_FORCE_BUSHING_EFFORTS,
    /** Kind of quantity: effort of a controller on one of the coordinates that it acts on, towards
     * growth. */
    force_control_effort = PDN_FORCE_CONTROL_EFFORT,
    /** Kind of quantity: a state of a controller. */
    force_control_state = PDN_FORCE_CONTROL_STATE,
    /** Kind of quantity: strains of a shell element, in the order of ::pdn_shell_section; 12
     * components. */
    shell_strain = PDN_SHELL_STRAIN,
    /** Kind of quantity: forces and moments of a shell element per unit of reference length, in the
     * same order: N11 N12 Q1 M11 M12 M1n, N21 N22 Q2 M21 M22 M2n; 12 components. */
    shell_resultant = PDN_SHELL_RESULTANT,
    /** Kind of quantity: stresses 11, 22, 12 at the surface of an isotropic shell that its normal
     * points out of, and von Mises' stress of these \[force / length^2\]; 4 components. */
    shell_stress_top = PDN_SHELL_STRESS_TOP,
    /** Kind of quantity: the same at the other surface; 4 components. */
    shell_stress_bottom = PDN_SHELL_STRESS_BOTTOM,
    /** Kind of quantity: effort of a linear relation on one of its joint coordinates, towards
     * growth. */
    relation_effort = PDN_RELATION_EFFORT,
};
/** What has a label. */
enum class ObjectKind : std::int32_t {
    /** What has a label: a node, or a rigid body, which is one. */
    node = PDN_OBJECT_NODE,
    /** What has a label: a joint. */
    joint = PDN_OBJECT_JOINT,
    /** What has a label: a beam element. */
    beam_element = PDN_OBJECT_BEAM_ELEMENT,
    /** What has a label: a shell element. */
    shell_element = PDN_OBJECT_SHELL_ELEMENT,
    /** What has a label: a force, but not a load. */
    force = PDN_OBJECT_FORCE,
    /** What has a label: a linear relation between joint coordinates. */
    relation = PDN_OBJECT_RELATION,
    /** What has a label: a load on a node or at a point. */
    load = PDN_OBJECT_LOAD,
    /** What has a label: a load along beam elements. */
    beam_load = PDN_OBJECT_BEAM_LOAD,
    /** What has a label: a load on shell elements. */
    shell_load = PDN_OBJECT_SHELL_LOAD,
    /** What has a label: the inertia of a rigid body, or a mass or inertia on a node. */
    inertia = PDN_OBJECT_INERTIA,
    /** What has a label: a prescribed coordinate. */
    prescribed = PDN_OBJECT_PRESCRIBED,
};
/** Kind of force. */
enum class ForceKind : std::int32_t {
    /** Kind of force: springs and dampers on a joint coordinate. */
    spring_damper = PDN_FORCE_IS_SPRING_DAMPER,
    /** Kind of force: an actuator on a joint coordinate. */
    actuator = PDN_FORCE_IS_ACTUATOR,
    /** Kind of force: a law of the user on a joint coordinate. */
    coordinate_law = PDN_FORCE_IS_COORDINATE_LAW,
    /** Kind of force: a viscoelastic element on a joint coordinate. */
    viscoelastic = PDN_FORCE_IS_VISCOELASTIC,
    /** Kind of force: a viscous damper between two bodies. */
    viscous_damper = PDN_FORCE_IS_VISCOUS_DAMPER,
    /** Kind of force: a bushing between two frames. */
    bushing = PDN_FORCE_IS_BUSHING,
    /** Kind of force: forces of the user on nodes. */
    user_force = PDN_FORCE_IS_USER_FORCE,
    /** Kind of force: a controller. */
    controller = PDN_FORCE_IS_CONTROLLER,
    /** Kind of force: forces of the user on a shell element. */
    surface_force = PDN_FORCE_IS_SURFACE_FORCE,
    /** Kind of force: forces of the user along a beam element. */
    line_force = PDN_FORCE_IS_LINE_FORCE,
};
/** JointKind: Joint that allows no relative motion. */
enum class JointKind : std::int32_t {
    /** Joint that allows no relative motion. */
    rigid = PDN_JOINT_RIGID,
    /** Joint that allows a rotation about axis 3 of its frames. */
    revolute = PDN_JOINT_REVOLUTE,
    /** Joint that allows a rotation about axis 1 of its first frame, then about axis 2 of its
     * second. */
    universal = PDN_JOINT_UNIVERSAL,
    /** Joint that allows all rotations. */
    spherical = PDN_JOINT_SPHERICAL,
    /** Joint that allows a displacement along axis 3 of its frames. */
    prismatic = PDN_JOINT_PRISMATIC,
    /** Joint that allows a displacement along axis 3 of its frames and a rotation about it. */
    cylindrical = PDN_JOINT_CYLINDRICAL,
    /** Joint that allows displacements along axes 1 and 2 of its first frame and a rotation about
     * axis 3. */
    planar = PDN_JOINT_PLANAR,
    /** Joint that allows everything: it carries springs, prescribed coordinates and measures. */
    free = PDN_JOINT_FREE,
    /** Joint that allows a displacement along axis 3 of its frames, in proportion to the rotation
     * about it; made by functions of its own, for its pitch. */
    screw = PDN_JOINT_SCREW,
    /** The line between two points, which constrains nothing; made by ::pdn_model_add_strut. */
    strut = PDN_JOINT_STRUT,
};
/** Joint coordinate. */
enum class Coordinate : std::int32_t {
    /** Joint coordinate: the displacement, or the first of several. */
    displacement = PDN_DISPLACEMENT,
    /** Joint coordinate: second displacement of a planar or free joint. */
    displacement_2 = PDN_DISPLACEMENT_2,
    /** Joint coordinate: third displacement of a free joint. */
    displacement_3 = PDN_DISPLACEMENT_3,
    /** Joint coordinate: the angle, or the first of several. */
    rotation = PDN_ROTATION,
    /** Joint coordinate: second angle of a universal, spherical or free joint. */
    rotation_2 = PDN_ROTATION_2,
    /** Joint coordinate: third angle of a spherical or free joint. */
    rotation_3 = PDN_ROTATION_3,
};
/** Directions of a load, or axes of a velocity, force or reaction. */
enum class Frame : std::int32_t {
    /** Directions of a load, or axes of a velocity, force or reaction: the global axes. */
    space = PDN_FRAME_SPACE,
    /** The same: the axes of the node, which a load follows. */
    material = PDN_FRAME_MATERIAL,
    /** Directions of a load along a beam: the axes that its sections have without twist, which
     * follow the sections. */
    untwisted = PDN_FRAME_UNTWISTED,
    /** Axes of a joint reaction: the joint frame on the first body. */
    first = PDN_FRAME_FIRST,
    /** Axes of a joint reaction: the joint frame on the second body. */
    second = PDN_FRAME_SECOND,
};
/** Component of a load. */
enum class Component : std::int32_t {
    /** Component of a load: force along axis 1. */
    force_1 = PDN_FORCE_1,
    /** Component of a load: force along axis 2. */
    force_2 = PDN_FORCE_2,
    /** Component of a load: force along axis 3. */
    force_3 = PDN_FORCE_3,
    /** Component of a load: moment about axis 1. */
    moment_1 = PDN_MOMENT_1,
    /** Component of a load: moment about axis 2. */
    moment_2 = PDN_MOMENT_2,
    /** Component of a load: moment about axis 3. */
    moment_3 = PDN_MOMENT_3,
};
/** Frames of a shell. */
enum class ShellFrames : std::int32_t {
    /** Frames of a shell: along the normals of its surface at the nodes. */
    normals = PDN_SHELL_NORMALS,
    /** Frames of a shell: parallel at all nodes of an element. */
    parallel = PDN_SHELL_PARALLEL,
    /** Frames of a shell: along the third axes of the nodes' own frames, as normals of a surface
     * that is known better than its elements show it; of use with two nodes a side. */
    node_axes = PDN_SHELL_NODE_AXES,
    /** Frames of a shell: those of the nodes themselves, with their third axes for normals, if they
     * are known from elsewhere. */
    node_frames = PDN_SHELL_NODE_FRAMES,
};
/** Place of a load on a shell element. */
enum class ShellPlace : std::int32_t {
    /** Place of a load on a shell element: its edge where eta = -1, along xi. */
    edge_start_eta = PDN_SHELL_EDGE_START_ETA,
    /** Place of a load on a shell element: its edge where xi = 1, along eta. */
    edge_end_xi = PDN_SHELL_EDGE_END_XI,
    /** Place of a load on a shell element: its edge where eta = 1, along xi. */
    edge_end_eta = PDN_SHELL_EDGE_END_ETA,
    /** Place of a load on a shell element: its edge where xi = -1, along eta. */
    edge_start_xi = PDN_SHELL_EDGE_START_XI,
    /** Place of a load on a shell element: its surface. */
    surface = PDN_SHELL_SURFACE,
};
/** BushingAngles: A bushing measures rotations by the rotation vector; its angle stays below half a
 * turn. */
enum class BushingAngles : std::int32_t {
    /** A bushing measures rotations by the rotation vector; its angle stays below half a turn. */
    rotation_vector = PDN_ANGLES_ROTATION_VECTOR,
    /** A bushing measures the tilt of axis 3, as a rotation vector about axes 1 and 2, and the rate
     * of the spin about axis 3, which may go on and on: for journal bearings and seals. */
    tilt_and_spin = PDN_ANGLES_TILT_AND_SPIN,
};
/** Tangents of a user's function. */
enum class Tangents : std::int32_t {
    /** Tangents of a user's function: it gives none, and the library finds them by differences of
     * its forces. */
    differenced = PDN_TANGENTS_DIFFERENCED,
    /** Tangents of a user's function: it gives them. */
    given = PDN_TANGENTS_GIVEN,
};
/** Which tangent. */
enum class Tangent : std::int32_t {
    /** Which tangent: derivative by a motion or coordinate. */
    motion = PDN_TANGENT_MOTION,
    /** Which tangent: derivative by a velocity or rate. */
    velocity = PDN_TANGENT_VELOCITY,
};
/** Outcome. */
enum class Outcome : std::int32_t {
    /** Outcome: converged. */
    converged = PDN_CONVERGED,
    /** Outcome: the iteration limit was reached. */
    iteration_limit = PDN_ITERATION_LIMIT,
    /** Outcome: no step along the Newton direction brings progress. */
    stalled = PDN_STALLED,
    /** Outcome: the Jacobian is singular; something is free to move, or in resonance without
     * damping. */
    singular = PDN_SINGULAR,
    /** Outcome: the progress callback cancelled the solve. */
    cancelled = PDN_CANCELLED,
    /** Outcome: no initial guess could be found. */
    no_initial_guess = PDN_NO_INITIAL_GUESS,
    /** Outcome: constraints that depend on each other contradict each other; the mechanism is
     * locked, or cannot close. */
    inconsistent = PDN_INCONSISTENT,
    /** Outcome: a joint has closed turned over, its axes against each other; the report names
     * it. */
    wrong_assembly = PDN_WRONG_ASSEMBLY,
    /** Outcome: converged on the last grid tried, but the estimated error misses the tolerance, as
     * the report explains; quantities are as good as pdn_diagnostics.error_estimate says. */
    tolerance_not_met = PDN_TOLERANCE_NOT_MET,
    /** Outcome: all work was done that pdn_periodic_options.work_limit allows, and the report tells
     * what was tried; or as many steps of a march are kept as pdn_march_options.memory_limit
     * allows. */
    work_limit = PDN_WORK_LIMIT,
};
/** Decay of harmonics. */
enum class Decay : std::int32_t {
    /** Decay of harmonics: not known, as there are too few or the solve has not converged. */
    unknown = PDN_DECAY_UNKNOWN,
    /** Decay of harmonics: fast, as of a smooth response that the grid resolves. */
    fast = PDN_DECAY_FAST,
    /** Decay of harmonics: no faster than the fourth power of their number. */
    slow = PDN_DECAY_SLOW,
    /** Decay of harmonics: they have fallen to rounding; a finer grid gains nothing. */
    rounding = PDN_DECAY_ROUNDING,
};
/** Feature of a quantity. */
enum class Feature : std::int32_t {
    /** Feature of a quantity: its mean over the period, without what it gains. */
    mean = PDN_FEATURE_MEAN,
    /** Feature of a quantity: coefficient of the cosine of a harmonic. */
    cosine = PDN_FEATURE_COSINE,
    /** Feature of a quantity: coefficient of the sine of a harmonic. */
    sine = PDN_FEATURE_SINE,
    /** Feature of a quantity: value at a time, of the trigonometric polynomial through the values
     * at the grid points. */
    value = PDN_FEATURE_VALUE,
    /** Feature of a quantity, for sensitivities: its largest value over the period. */
    largest = PDN_FEATURE_LARGEST,
    /** Feature of a quantity, for sensitivities: its smallest value over the period. */
    smallest = PDN_FEATURE_SMALLEST,
};
/** Spectral filter. */
enum class Filter : std::int32_t {
    /** Spectral filter: Lanczos' factors, (sin(x) / x)^order with x = pi j / (H + 1) for harmonic j
     * of H. */
    lanczos = PDN_FILTER_LANCZOS,
    /** Spectral filter: exp(-36 (j / (H + 1))^order) for harmonic j of H. */
    exponential = PDN_FILTER_EXPONENTIAL,
};
/** Stage of a solve. */
enum class Stage : std::int32_t {
    /** Stage of a solve: finding the initial guess, each iteration at a single instant. */
    initial_guess = PDN_STAGE_INITIAL_GUESS,
    /** Stage of a solve: Newton iterations of the periodic problem. */
    newton = PDN_STAGE_NEWTON,
    /** Stage of a march: a step, with the last of its iterations. */
    march = PDN_STAGE_MARCH,
    /** Stage of a modal analysis: looking for modes about the equilibrium. */
    modes = PDN_STAGE_MODES,
    /** Following disturbances of a periodic solution. */
    stability = PDN_STAGE_STABILITY,
};
/** Start of a periodic solve. */
enum class Start : std::int32_t {
    /** Start of a periodic solve: the library tries those that suit, cheapest first. */
    automatic = PDN_START_AUTOMATIC,
    /** Start of a periodic solve: equilibrium at each time, without velocities. */
    quasi_static = PDN_START_QUASI_STATIC,
    /** Start of a periodic solve: equilibrium at each time of what turns steadily with its drives,
     * with its centrifugal and gyroscopic forces. */
    steady_rotation = PDN_START_STEADY_ROTATION,
    /** Start of a periodic solve: all that hangs on drives turned with them, undeformed. */
    rigid_rotation = PDN_START_RIGID_ROTATION,
    /** Start of a periodic solve: the quasi-static motion, and inertial forces raised in steps. */
    raised_inertia = PDN_START_RAISED_INERTIA,
    /** Start of a periodic solve: a march in time with strong numerical dissipation. */
    march = PDN_START_MARCH,
    /** Start of a periodic solve: the quasi-static motion, and added damping taken away in
     * steps. */
    lowered_damping = PDN_START_LOWERED_DAMPING,
    /** Start of a periodic solve: the reference configuration, and loads and prescribed motions
     * raised in steps; not where these gain whole turns in a period. */
    raised_loads = PDN_START_RAISED_LOADS,
};
/** TimeMap: Grid points are equispaced, but closer together where a solve to a tolerance finds the
 * motion sharp. */
enum class TimeMap : std::int32_t {
    /** Grid points are equispaced, but closer together where a solve to a tolerance finds the
     * motion sharp. */
    automatic = PDN_TIME_MAP_AUTOMATIC,
    /** Grid points are equispaced. */
    equispaced = PDN_TIME_MAP_EQUISPACED,
    /** Grid points are closer together about events that are given. */
    events = PDN_TIME_MAP_EVENTS,
};
/** Linear equations. */
enum class Linear : std::int32_t {
    /** Linear equations: solved directly where that is quick, by iteration otherwise. */
    automatic = PDN_LINEAR_AUTOMATIC,
    /** Linear equations: solved by factors of the whole Jacobian. */
    direct = PDN_LINEAR_DIRECT,
    /** Linear equations: solved by iteration, with the preconditioner that suits; time and memory
     * grow in proportion to nodes and grid points, or little more. */
    iterative = PDN_LINEAR_ITERATIVE,
    /** Linear equations: solved by iteration; bodies are averaged over time for the preconditioner,
     * joints are not. */
    body_circulant = PDN_LINEAR_BODY_CIRCULANT,
    /** Linear equations: solved by iteration; the preconditioner is equilibrium at each grid point,
     * without inertia. */
    time_local = PDN_LINEAR_TIME_LOCAL,
    /** Linear equations: solved by iteration; everything is averaged over time for the
     * preconditioner. */
    circulant = PDN_LINEAR_CIRCULANT,
};
/** Number: A parameter moves the coefficient of a power, from 1, of the growth of a spring-damper,
 * or with power 1 the long-term stiffness of a viscoelastic force or a factor of the stiffness of a
 * bushing. */
enum class Number : std::int32_t {
    /** A parameter moves the coefficient of a power, from 1, of the growth of a spring-damper, or
     * with power 1 the long-term stiffness of a viscoelastic force or a factor of the stiffness of
     * a bushing. */
    stiffness = PDN_NUMBER_STIFFNESS,
    /** A parameter moves the coefficient of a power, from 1, of the rate of a spring-damper, or
     * with power 1 a factor of the damping of a bushing. */
    damping = PDN_NUMBER_DAMPING,
    /** A parameter moves the coordinate at which a spring-damper or viscoelastic force is free of
     * effort. */
    rest = PDN_NUMBER_REST,
    /** A parameter moves a factor of an inertia: that of a rigid body, or a mass or inertia on a
     * node. */
    inertia = PDN_NUMBER_INERTIA,
    /** A parameter moves a factor of the sections' stiffness along a beam element. */
    beam_stiffness = PDN_NUMBER_BEAM_STIFFNESS,
    /** A parameter moves a factor of the sections' mass along a beam element. */
    beam_mass = PDN_NUMBER_BEAM_MASS,
    /** A parameter moves a factor of the sections' damping along a beam element. */
    beam_damping = PDN_NUMBER_BEAM_DAMPING,
    /** A parameter moves the damping in proportion to mass, ::pdn_model_set_mass_damping. */
    mass_damping = PDN_NUMBER_MASS_DAMPING,
    /** A parameter moves a factor of the stiffness of a shell element. */
    shell_stiffness = PDN_NUMBER_SHELL_STIFFNESS,
    /** A parameter moves a factor of the mass of a shell element. */
    shell_mass = PDN_NUMBER_SHELL_MASS,
    /** A parameter moves a factor of the damping of a shell element. */
    shell_damping = PDN_NUMBER_SHELL_DAMPING,
    /** A parameter moves a factor of the thickness of a shell element, more than zero, all its
     * layers alike: stiffness, damping and mass against stretching grow with it, against bending
     * and turning with its cube, what couples them with its square. */
    shell_thickness = PDN_NUMBER_SHELL_THICKNESS,
    /** A parameter moves the rate of the frame that everything is described in,
     * ::pdn_model_set_turning_frame. */
    frame_rate = PDN_NUMBER_FRAME_RATE,
    /** A parameter moves the rate at which an inertia spins, ::pdn_model_set_spin. */
    spin = PDN_NUMBER_SPIN,
    /** A parameter moves the rate at which the material of a beam element spins,
     * ::pdn_model_set_beam_spin. */
    beam_spin = PDN_NUMBER_BEAM_SPIN,
    /** A parameter moves the speed of the frame that everything is described in along its axis,
     * ::pdn_model_set_frame_advance. */
    frame_advance = PDN_NUMBER_FRAME_ADVANCE,
    /** Numbers of a force: relaxation times of the branches of a viscoelastic element. */
    relaxation_time = PDN_NUMBER_RELAXATION_TIME,
};
/** Part of a signal. */
enum class SignalPart : std::int32_t {
    /** Part of a signal: the mean that is added to its shape. */
    mean = PDN_PART_MEAN,
    /** Part of a signal: growth in a unit of time. */
    rate = PDN_PART_RATE,
    /** Part of a signal: the factor of its shape, which is its harmonics, its samples or its
     * function. */
    amplitude = PDN_PART_AMPLITUDE,
    /** Part of a signal: the phase by which its shape is ahead \[radians\]. */
    phase = PDN_PART_PHASE,
};
/** Sensitivities. */
enum class SensitivityMethod : std::int32_t {
    /** Sensitivities: with as few linear solves as can be, directly or adjoint. */
    automatic = PDN_SENSITIVITY_AUTOMATIC,
    /** Sensitivities: a linear solve for each parameter. */
    direct = PDN_SENSITIVITY_DIRECT,
    /** Sensitivities: a transposed linear solve for each dependent, by factors of the whole
     * Jacobian. */
    adjoint = PDN_SENSITIVITY_ADJOINT,
};
/** BranchEnd: A branch ended at an end of the parameter's range. */
enum class BranchEnd : std::int32_t {
    /** A branch ended at an end of the parameter's range. */
    range = PDN_BRANCH_RANGE,
    /** A branch ended as it came back to its first point. */
    closed = PDN_BRANCH_CLOSED,
    /** A branch ended as it has as many points as are allowed. */
    point_limit = PDN_BRANCH_POINT_LIMIT,
    /** A branch ended where the shortest step leads to no solution. */
    smallest_step = PDN_BRANCH_SMALLEST_STEP,
    /** A branch ended as it was cancelled. */
    cancelled = PDN_BRANCH_CANCELLED,
    /** A branch has no points, as there is no solution to start from. */
    no_start = PDN_BRANCH_NO_START,
    /** A branch ended with an error, such as that of a callback, which its report tells. */
    failed = PDN_BRANCH_FAILED,
};
/** BranchEvent: Nothing happens at a point of a branch. */
enum class BranchEvent : std::int32_t {
    /** Nothing happens at a point of a branch. */
    none = PDN_EVENT_NONE,
    /** The parameter turns back at a point of a branch: a fold. */
    fold = PDN_EVENT_FOLD,
    /** Another branch passes through a point of a branch. */
    branch_point = PDN_EVENT_BRANCH_POINT,
    /** A branch of twice the period begins at a point of a branch. */
    period_doubling = PDN_EVENT_PERIOD_DOUBLING,
    /** A pair of complex multipliers is on the unit circle at a point of a branch: motions with a
     * second frequency begin there. */
    torus = PDN_EVENT_TORUS,
};
/** Verdict on stability. */
enum class Verdict : std::int32_t {
    /** Verdict on stability: it cannot be told, as multipliers are on the unit circle or not known
     * well enough. */
    stability_not_known = PDN_STABILITY_NOT_KNOWN,
    /** Verdict on stability: disturbances die away, but for those that only move the solution in
     * time or space. */
    stable = PDN_STABLE,
    /** Verdict on stability: a disturbance grows. */
    unstable = PDN_UNSTABLE,
};
///@}
// END

/** A point or a direction. */
using Vector3 = std::array<double, 3>;
/** A 3 x 3 matrix, column by column. */
using Matrix3 = std::array<double, 9>;
/** Linear and angular velocity, or force and moment. */
using Vector6 = std::array<double, 6>;
/** A 6 x 6 matrix, column by column. */
using Matrix6 = std::array<double, 36>;
/** C components at each of many times, or for each of many harmonics. */
template <std::size_t C> using Series = std::vector<std::array<double, C>>;

/** What a call that fails throws: the status, and what was expected and what came. */
class error : public std::runtime_error
{
  public:
    /** An error as of the library. */
    error(pdn_status status, const std::string &message)
        : std::runtime_error(message), status_(status)
    {
    }
    /** PDN_ERR_VALUE, ... */
    pdn_status status() const noexcept
    {
        return status_;
    }

  private:
    pdn_status status_;
};

/** An effort on a joint coordinate, with its derivatives. */
struct Effort {
    double effort;        ///< that resists growth
    double by_coordinate; ///< its derivative by the coordinate
    double by_rate;       ///< and by the rate of the coordinate
};

/** Told of progress: true to go on, false to cancel. */
using Progress = std::function<bool(const pdn_progress &)>;
/** Told of each point of a branch, and its number; likewise. */
using BranchProgress = std::function<bool(const pdn_branch_point &, std::int32_t)>;

/** An array of the library's, with an index for each extent of the shape that C tells, in its
 * order: of shape 3 x [node_count] (component, node). */
template <class T, std::size_t N> class Entries
{
  public:
    /** Numbers, the first index fastest. */
    Entries(T *data, const std::array<std::size_t, N> &extents) : data_(data), extents_(extents)
    {
    }
    /** Whether they are wanted, as tangents may not be. */
    explicit operator bool() const
    {
        return data_ != nullptr;
    }
    /** An entry; throws std::out_of_range if there is none, std::logic_error if none is wanted. */
    template <class... Index> T &operator()(Index... index) const
    {
        static_assert(sizeof...(index) == N, "an index of each kind");
        if (data_ == nullptr) {
            throw std::logic_error("Entries: tangents that are not wanted are asked for");
        }
        std::size_t place = 0, stride = 1, i = 0;
        for (const std::size_t given : {static_cast<std::size_t>(index)...}) {
            if (given >= extents_[i]) {
                throw std::out_of_range("Entries: index " + std::to_string(given) +
                                        " is not below " + std::to_string(extents_[i]));
            }
            place += given * stride;
            stride *= extents_[i++];
        }
        return data_[place];
    }

  private:
    T *data_;
    std::array<std::size_t, N> extents_;
};

/** How functions of the library are called. */
namespace detail
{

/** What a callback threw on this thread, on its way to the call that failed by it, or that progress
 * cancelled by it. */
inline thread_local std::exception_ptr carried, cancelling;

/** The text that a function with a buffer writes. */
template <class Write> std::string text(Write write)
{
    std::string text(write(nullptr, 0), '\0');
    text.resize(write(text.data(), text.size() + 1));
    return text;
}

/** Throws what a failed call has to say. */
inline void check(pdn_status status)
{
    const std::exception_ptr thrown = std::exchange(carried, nullptr);
    const std::exception_ptr from_progress = std::exchange(cancelling, nullptr);
    if (from_progress) {
        std::rethrow_exception(from_progress);
    }
    if (status == PDN_ERR_CALLBACK && thrown) {
        std::rethrow_exception(thrown);
    }
    if (status < 0) {
        throw error(status, text(pdn_last_error));
    }
}

/** What a function of the caller tells, or 1 after it threw. */
template <class Function>
std::int32_t guarded(std::exception_ptr &thrown, Function function) noexcept
{
    try {
        return function();
    } catch (const std::exception &exception) {
        thrown = std::current_exception();
        pdn_set_callback_error(exception.what());
    } catch (...) {
        thrown = std::current_exception();
    }
    return 1;
}

/** Disposes of a Function that the library owns. */
template <class Function> void destroy(void *function) noexcept
{
    delete static_cast<Function *>(function);
}

/** Hands a Function over to the library, for the time the call succeeds. */
template <class Call, class Function> void hand_over(Call call, Function function)
{
    auto owned = std::make_unique<Function>(std::move(function));
    check(call(owned.get(), &destroy<Function>));
    owned.release();
}

/** A struct with its defaults. */
template <class T> T initialised(void (*initialise)(T *, std::size_t))
{
    T made;
    initialise(&made, sizeof made);
    return made;
}

/** Throws if an array has another number of entries than it must have. */
inline void check_size(const std::string &name, std::size_t expected, std::size_t got,
                       const char *of = "entries")
{
    if (got != expected) {
        throw error(PDN_ERR_SIZE, name + ": expected " + std::to_string(expected) + " " + of +
                                      ", got " + std::to_string(got));
    }
}

/** The length that arrays have in common; those that may be left out may also be empty. */
inline std::size_t
common(std::initializer_list<std::pair<const char *, std::size_t>> arrays, bool may_be_empty)
{
    std::size_t length = 0;
    for (const auto &[name, size] : arrays) {
        length = std::max(length, size);
    }
    for (const auto &[name, size] : arrays) {
        check_size(name, may_be_empty && size == 0 ? 0 : length, size);
    }
    return length;
}

/** Entries of fixed size as the plain numbers that they are. */
template <class Arrays> auto flat(Arrays &arrays) -> decltype(arrays.front().data())
{
    return arrays.empty() ? nullptr : arrays.front().data();
}

/** The same of options about all nodes, or NULL if there are none; of as many as there must be. */
template <std::size_t C>
const double *flat(const Series<C> &series, std::size_t nodes, std::size_t points, const char *name)
{
    if (series.empty() || nodes == 0) {
        return nullptr;
    }
    check_size(std::string("options.") + name, nodes * points, series.size());
    return flat(series);
}

/** @name What C++ has, as the library takes it */
///@{
template <class Choice, class = std::enable_if_t<!std::is_class_v<Choice>>>
constexpr std::int32_t in(Choice enumerator_or_bool)
{
    return static_cast<std::int32_t>(enumerator_or_bool);
}
template <class Fixed> auto in(const Fixed &text_or_array) -> decltype(text_or_array.data())
{
    return text_or_array.data();
}
template <class T> const T *in(const std::vector<T> &array)
{
    static constexpr T nothing{}; // so that none is no NULL
    return array.empty() ? &nothing : array.data();
}
template <std::size_t C> const double *in(const Series<C> &series)
{
    return flat(series);
}
template <class T> auto in(const std::optional<T> &value) -> decltype(in(*value))
{
    return value ? in(*value) : nullptr;
}
/** The handle of an object that may be left out, but not moved from. */
template <class T> auto in(const T *object, const char *name) -> decltype(object->get())
{
    if (object != nullptr && object->get() == nullptr) {
        throw error(PDN_ERR_NULL,
                    std::string(name) + ": expected an object, got one that was moved from");
    }
    return object == nullptr ? nullptr : object->get();
}
template <class T> const T *in_or_null(const std::vector<T> &array)
{
    return array.empty() ? nullptr : array.data();
}
/** What is converted one by one, and there until the call has ended. */
template <class T> struct Converted : std::vector<T> {
    operator const T *() const
    {
        return this->data();
    }
};
inline Converted<std::int32_t> in(const std::vector<Coordinate> &coordinates)
{
    Converted<std::int32_t> codes;
    for (const Coordinate coordinate : coordinates) {
        codes.push_back(in(coordinate));
    }
    return codes;
}
///@}

/** Functions of signals that the library may still call, kept by models and solutions. */
using Kept = std::vector<std::shared_ptr<const void>>;

/** Whether a law gives derivatives. */
template <class Law>
constexpr Tangents tangents_of =
    std::is_convertible_v<std::invoke_result_t<Law &, double, double, double>, Effort>
        ? Tangents::given
        : Tangents::differenced;

/** @name What functions of the caller return, written to where the library wants it */
///@{
inline void write(double value, double *out, const double * /* no derivatives */ = nullptr)
{
    *out = value;
}
inline void write(const Vector3 &point, double *out)
{
    std::copy(point.begin(), point.end(), out);
}
inline void write(const std::pair<Vector3, Vector3> &point_and_axis, double *point, double *axis)
{
    write(point_and_axis.first, point);
    write(point_and_axis.second, axis);
}
inline void write(const Effort &given, double *effort, double *derivatives)
{
    *effort = given.effort;
    if (derivatives != nullptr) {
        derivatives[0] = given.by_coordinate;
        derivatives[1] = given.by_rate;
    }
}
///@}

} // namespace detail

// WRITTEN BY script/cpp_interface: callbacks
/** What a user's forces on nodes may depend on. */
struct ForceState {
    /** As the library made it. */
    const pdn_force_state &state;
    /** Time, in [0, T) of the period T of the solve, but for the first calls of a solve
     * (::pdn_user_force_fn). */
    const double time = state.time;
    /** Number of nodes. */
    const std::size_t node_count = state.node_count;
    /** Positions, global coordinates [length]. */
    const Entries<const double, 2> positions{state.positions, {3, state.node_count}};
    /** Rotation matrices, column by column; the columns are the nodes' axes in global
     * coordinates. */
    const Entries<const double, 2> rotations{state.rotations, {9, state.node_count}};
    /** Velocity and angular velocity of each node relative to the inertial frame, also in a steady
     * rotation (::pdn_solve_static), along the global axes (PDN_FRAME_SPACE) or the node's own
     * (PDN_FRAME_MATERIAL). */
    const Entries<const double, 2> velocities{state.velocities, {6, state.node_count}};
    /** Nodes whose motions tangents are by: all, as many as [node_count], or 1, the own node of
     * each force, where nodes were declared apart (::pdn_model_declare_nodes_apart). */
    const std::size_t column_count = state.column_count;
};

/** Where a user's forces go. */
struct ForceValues {
    /** As the library made it. */
    const pdn_force_state &state;
    /** The same. */
    const pdn_force_values &values;
    /** Force on each node and moment about it [force, force * length]. */
    const Entries<double, 2> forces{values.forces, {6, state.node_count}};
    /** Derivatives of forces by displacements and turns: of all nodes or, where nodes were declared
     * apart, of the own node of each force. NULL if tangents are not wanted, or were said not to be
     * given. */
    const Entries<double, 4> by_motion{values.by_motion, {6, state.node_count, 6,
        state.column_count}};
    /** The same by velocities and angular velocities. */
    const Entries<double, 4> by_velocity{values.by_velocity, {6, state.node_count, 6,
        state.column_count}};
};

/** What a controller reads. */
struct ControllerState {
    /** As the library made it. */
    const pdn_controller_state &state;
    /** Time, in [0, T) of the period T of the solve, but for the first calls of a solve
     * (::pdn_controller_fn). */
    const double time = state.time;
    /** Number of coordinates that are read. */
    const std::size_t input_count = state.input_count;
    /** The coordinates, angles with their whole turns [length or radian]. */
    const Entries<const double, 1> inputs{state.inputs, {state.input_count}};
    /** Their rates. */
    const Entries<const double, 1> input_rates{state.input_rates, {state.input_count}};
    /** Number of states. */
    const std::size_t state_count = state.state_count;
    /** The states. */
    const Entries<const double, 1> states{state.states, {state.state_count}};
};

/** Where a controller writes. */
struct ControllerValues {
    /** As the library made it. */
    const pdn_controller_state &state;
    /** The same. */
    const pdn_controller_values &values;
    /** Number of coordinates that it acts on. */
    const std::size_t output_count = values.output_count;
    /** Efforts on the coordinates that it acts on, towards growth [force on a displacement, force *
     * length on an angle]. */
    const Entries<double, 1> efforts{values.efforts, {values.output_count}};
    /** Rates of the states. */
    const Entries<double, 1> state_rates{values.state_rates, {state.state_count}};
    /** Derivatives by the coordinates. NULL if tangents are not wanted, or were said not to be
     * given. */
    const Entries<double, 2> by_inputs{values.by_inputs, {values.output_count + state.state_count,
        state.input_count}};
    /** The same by their rates. */
    const Entries<double, 2> by_input_rates{values.by_input_rates,
        {values.output_count + state.state_count, state.input_count}};
    /** Derivatives by the states. */
    const Entries<double, 2> by_states{values.by_states, {values.output_count + state.state_count,
        state.state_count}};
};

/** What a user's forces on a shell or beam element may depend on: the points of a quadrature over
 * its surface, an edge or its line. */
struct SurfaceState {
    /** As the library made it. */
    const pdn_surface_state &state;
    /** Time, in [0, T) of the period T of the solve, but for the first calls of a solve
     * (::pdn_surface_force_fn). */
    const double time = state.time;
    /** Id of the shell element, or of the beam element. */
    const std::int32_t element = state.element;
    /** Number of points. */
    const std::size_t point_count = state.point_count;
    /** Xi and eta of each, from -1 to 1; eta is 0 on beams. */
    const Entries<const double, 2> places{state.places, {2, state.point_count}};
    /** The reference area, or length of an edge or beam, that each stands for: a force is this much
     * of what the function gives. */
    const Entries<const double, 1> sizes{state.sizes, {state.point_count}};
    /** Positions, global coordinates [length]. */
    const Entries<const double, 2> positions{state.positions, {3, state.point_count}};
    /** Rotation matrices, column by column; the columns are the axes of the point in global
     * coordinates, those of a follower load: on the surface axes 1, 2 and the normal, on an edge 1
     * along it, 3 along the normal, and 2 = 3 * 1; along a beam those of its section, or with
     * PDN_FRAME_UNTWISTED those without twist. */
    const Entries<const double, 2> rotations{state.rotations, {9, state.point_count}};
    /** Velocity and angular velocity of each point relative to the inertial frame, also in a steady
     * rotation (::pdn_solve_static), along the global axes (PDN_FRAME_SPACE) or the point's own
     * (PDN_FRAME_MATERIAL). */
    const Entries<const double, 2> velocities{state.velocities, {6, state.point_count}};
};

/** Where a user's forces on a shell or beam element go. */
struct SurfaceValues {
    /** As the library made it. */
    const pdn_surface_state &state;
    /** The same. */
    const pdn_surface_values &values;
    /** Force at each point and moment about it. */
    const Entries<double, 2> forces{values.forces, {6, state.point_count}};
    /** Derivatives of the force at a point by displacements and turns of this point. NULL if
     * tangents are not wanted, or were said not to be given. */
    const Entries<double, 3> by_motion{values.by_motion, {6, 6, state.point_count}};
    /** The same by velocities and angular velocities. */
    const Entries<double, 3> by_velocity{values.by_velocity, {6, 6, state.point_count}};
};

namespace detail
{

/** A function of time, to be written by the caller. */
template <class Function>
std::int32_t signal_fn(double time, double *value, void *function) noexcept
{
    return guarded(carried, [=] {
        write((*static_cast<Function *>(function))(time), value);
        return 0;
    });
}

/** A smooth curve in space, to be written by the caller. */
template <class Function>
std::int32_t curve_fn(double fraction, double *position, double *axis_2, void *function) noexcept
{
    return guarded(carried, [=] {
        write((*static_cast<Function *>(function))(fraction), position, axis_2);
        return 0;
    });
}

/** A surface in space, to be written by the caller. */
template <class Function>
std::int32_t surface_fn(double u, double v, double *position, void *function) noexcept
{
    return guarded(carried, [=] {
        write((*static_cast<Function *>(function))(u, v), position);
        return 0;
    });
}

/** A law of effort on a joint coordinate, to be written by the caller. */
template <class Function>
std::int32_t coordinate_law_fn(double time, double coordinate, double rate, double *effort,
    double *derivatives, void *function) noexcept
{
    return guarded(carried, [=] {
        write((*static_cast<Function *>(function))(time, coordinate, rate), effort, derivatives);
        return 0;
    });
}

/** Forces on nodes, to be computed by the caller. */
template <class Function>
std::int32_t user_force_fn(const pdn_force_state *state, pdn_force_values *values,
    void *function) noexcept
{
    return guarded(carried, [=] {
        ForceValues out{*state, *values};
        (*static_cast<Function *>(function))(ForceState{*state}, out);
        return 0;
    });
}

/** A controller, to be written by the caller. */
template <class Function>
std::int32_t controller_fn(const pdn_controller_state *state, pdn_controller_values *values,
    void *function) noexcept
{
    return guarded(carried, [=] {
        ControllerValues out{*state, *values};
        (*static_cast<Function *>(function))(ControllerState{*state}, out);
        return 0;
    });
}

/** Forces on shells or along beams, to be computed by the caller, such as of a fluid: for all
 * points of one element at once, each by the motion of this point alone. */
template <class Function>
std::int32_t surface_force_fn(const pdn_surface_state *state, pdn_surface_values *values,
    void *function) noexcept
{
    return guarded(carried, [=] {
        SurfaceValues out{*state, *values};
        (*static_cast<Function *>(function))(SurfaceState{*state}, out);
        return 0;
    });
}

/** Called after each Newton iteration, or after each step of a march, and while one lasts about ten
 * times a second, on the solving thread. */
template <class Function>
std::int32_t progress_fn(const pdn_progress *progress, void *function) noexcept
{
    return guarded(cancelling, [=] {
        return !(*static_cast<Function *>(function))(*progress);
    });
}

/** Called with each point of a branch, on the thread that follows it; `number` counts from 1. */
template <class Function>
std::int32_t branch_fn(const pdn_branch_point *point, int32_t number, void *function) noexcept
{
    return guarded(cancelling, [=] {
        return !(*static_cast<Function *>(function))(*point, number);
    });
}

} // namespace detail
// END

/** A scalar function of time. A number, or a function of time, is a signal too. */
struct Signal : pdn_signal {
    // WRITTEN BY script/cpp_interface: pdn_signal
    /** With its defaults. */
    Signal()
        : pdn_signal(detail::initialised(pdn_signal_init))
    {
    }
    /** Makes a signal constant. */
    Signal &set_constant(double value)
    {
        detail::check(pdn_signal_set_constant(this, value));
        return *this;
    }
    /** Makes a signal of harmonics, mean and rate. */
    Signal &set_harmonics(double mean_ = 0.0, double rate_ = 0.0, std::vector<double> cosines_ = {},
        std::vector<double> sines_ = {})
    {
        const std::size_t count = detail::common({{"cosines", cosines_.size()},
            {"sines", sines_.size()}}, true);
        auto owned = std::make_shared<std::tuple<std::vector<double>,
            std::vector<double>>>(std::move(cosines_), std::move(sines_));
        detail::check(pdn_signal_set_harmonics(this, mean_, rate_, std::get<0>(*owned).data(),
            std::get<1>(*owned).data(), count));
        kept = std::move(owned);
        return *this;
    }
    /** Makes a signal rate t plus the trigonometric interpolation of samples[k] at t = k T /
     * count. */
    Signal &set_samples(std::vector<double> samples_, double rate_ = 0.0)
    {
        const std::size_t count = samples_.size();
        auto owned = std::make_shared<std::tuple<std::vector<double>>>(std::move(samples_));
        detail::check(pdn_signal_set_samples(this, rate_, std::get<0>(*owned).data(), count));
        kept = std::move(owned);
        return *this;
    }
    /** Makes a signal a function of the caller. */
    template <class Function>
    Signal &set_function(Function function_)
    {
        auto owned = std::make_shared<Function>(std::move(function_));
        detail::check(pdn_signal_set_function(this, &detail::signal_fn<Function>, owned.get()));
        kept = std::move(owned);
        return *this;
    }
    /** Makes a signal a function of the caller, of the phase 2 pi t / T \[radians\], which it is
     * told in place of the time: it holds for any period T. */
    template <class Function>
    Signal &set_function_of_phase(Function function_)
    {
        auto owned = std::make_shared<Function>(std::move(function_));
        detail::check(pdn_signal_set_function_of_phase(this, &detail::signal_fn<Function>,
            owned.get()));
        kept = std::move(owned);
        return *this;
    }
    /** What the library is to find as long as it needs this. */
    std::shared_ptr<const void> kept;
    // END

    /** A constant. */
    Signal(double value) : Signal()
    {
        set_constant(value);
    }
    /** A function double(double time), kept as long as models and solutions need it. */
    template <class Function,
              class = std::enable_if_t<std::is_invocable_r_v<double, Function &, double>>>
    Signal(Function of_time) : Signal()
    {
        set_function(std::move(of_time));
    }
};

// WRITTEN BY script/cpp_interface: structs
/** Cross-section of a beam, per unit of length. */
struct Section : pdn_section {
    /** With its defaults. */
    Section()
        : pdn_section(detail::initialised(pdn_section_init))
    {
    }
    /** Describes a section without couplings: centroid, shear centre and centre of mass lie on the
     * beam's line, and axes 2 and 3 are principal. */
    Section &set_diagonal(const Vector6 &stiffness_, const std::array<double, 4> &mass_)
    {
        detail::check(pdn_section_set_diagonal(this, detail::in(stiffness_), detail::in(mass_)));
        return *this;
    }
    /** Gives a section damping with one time for each force and moment: damping = diag(seconds) *
     * stiffness, which must have been set. */
    Section &set_component_damping(const Vector6 &seconds)
    {
        detail::check(pdn_section_set_component_damping(this, detail::in(seconds)));
        return *this;
    }
    /** Gives a section damping in proportion to its stiffness, which must have been set. */
    Section &set_proportional_damping(double seconds)
    {
        detail::check(pdn_section_set_proportional_damping(this, seconds));
        return *this;
    }
};

/** Reference line of a beam: a frame at each fraction of the span, with axis 1 along the line. */
struct Line : pdn_line {
    /** With its defaults. */
    Line()
        : pdn_line(detail::initialised(pdn_line_init))
    {
    }
    /** Makes a line straight. */
    Line &set_straight(const Vector3 &start_, const Vector3 &end_, const Vector3 &axis_2_)
    {
        detail::check(pdn_line_set_straight(this, detail::in(start_), detail::in(end_),
            detail::in(axis_2_)));
        return *this;
    }
    /** Makes a line the circular arc from start through point to end, of up to a whole turn. */
    Line &set_arc(const Vector3 &start_, const Vector3 &point_, const Vector3 &end_,
        const Vector3 &axis_2_)
    {
        detail::check(pdn_line_set_arc(this, detail::in(start_), detail::in(point_),
            detail::in(end_), detail::in(axis_2_)));
        return *this;
    }
    /** Makes a line a curve that the caller computes. */
    template <class Function>
    Line &set_curve(Function curve_)
    {
        auto owned = std::make_shared<Function>(std::move(curve_));
        detail::check(pdn_line_set_curve(this, &detail::curve_fn<Function>, owned.get()));
        kept = std::move(owned);
        return *this;
    }
    /** What the library is to find as long as it needs this. */
    std::shared_ptr<const void> kept;
};

/** A surface: a point for each pair (u, v), each from 0 to 1. */
struct Surface : pdn_surface {
    /** With its defaults. */
    Surface()
        : pdn_surface(detail::initialised(pdn_surface_init))
    {
    }
    /** Makes a surface a parallelogram, such as a rectangle. */
    Surface &set_parallelogram(const Vector3 &corner, const Vector3 &along_u,
        const Vector3 &along_v)
    {
        detail::check(pdn_surface_set_parallelogram(this, detail::in(corner), detail::in(along_u),
            detail::in(along_v)));
        return *this;
    }
    /** Makes a surface an annulus or a sector of one: u from the inner to the outer radius, v
     * around the axis. */
    Surface &set_annulus(const Vector3 &centre, const Vector3 &axis_, const Vector3 &start_,
        double inner, double outer, double angle_)
    {
        detail::check(pdn_surface_set_annulus(this, detail::in(centre), detail::in(axis_),
            detail::in(start_), inner, outer, angle_));
        return *this;
    }
    /** Makes a surface a cylinder or a sector of one: u around the axis, v along it. */
    Surface &set_cylinder(const Vector3 &centre, const Vector3 &axis_, const Vector3 &start_,
        double radius, double length, double angle_)
    {
        detail::check(pdn_surface_set_cylinder(this, detail::in(centre), detail::in(axis_),
            detail::in(start_), radius, length, angle_));
        return *this;
    }
    /** Makes a surface one that the caller computes, smooth within each element. */
    template <class Function>
    Surface &set_function(Function function_)
    {
        auto owned = std::make_shared<Function>(std::move(function_));
        detail::check(pdn_surface_set_function(this, &detail::surface_fn<Function>, owned.get()));
        kept = std::move(owned);
        return *this;
    }
    /** What the library is to find as long as it needs this. */
    std::shared_ptr<const void> kept;
};

/** Stiffness, damping and mass of a shell, per unit of its reference area. */
struct ShellSection : pdn_shell_section {
    /** With its defaults. */
    ShellSection()
        : pdn_shell_section(detail::initialised(pdn_shell_section_init))
    {
    }
    /** Makes a section that of one isotropic, linearly elastic material. */
    ShellSection &set_isotropic(double thickness, double young, double poisson, double density,
        double drilling = 1.0, double drilling_gradient = 0.1)
    {
        detail::check(pdn_shell_section_set_isotropic(this, thickness, young, poisson, density,
            drilling, drilling_gradient));
        return *this;
    }
    /** Gives a section damping in proportion to its stiffness, which must have been set. */
    ShellSection &set_proportional_damping(double seconds)
    {
        detail::check(pdn_shell_section_set_proportional_damping(this, seconds));
        return *this;
    }
};

/** How a shell lies on its nodes. */
struct ShellPlacement : pdn_shell_placement {
    /** With its defaults. */
    ShellPlacement()
        : pdn_shell_placement(detail::initialised(pdn_shell_placement_init))
    {
    }
    /** PDN_SHELL_NORMALS, PDN_SHELL_PARALLEL, PDN_SHELL_NODE_AXES or PDN_SHELL_NODE_FRAMES. */
    ShellFrames frames = static_cast<ShellFrames>(pdn_shell_placement::frames);
    /** As the library takes it, valid while this object stays as it is. */
    const pdn_shell_placement *get([[maybe_unused]] std::size_t nodes = 0)
    {
        pdn_shell_placement::frames = detail::in(frames);
        return this;
    }
};
// END

/** Sections along a beam, linear between stations. */
struct Stations : pdn_stations {
    // WRITTEN BY script/cpp_interface: pdn_stations
    /** With its defaults. */
    Stations()
        : pdn_stations(detail::initialised(pdn_stations_init))
    {
    }
    /** Places along the span, from 0 at the start to 1 at the end, ascending; two stations at the
     * same place make a jump. May be NULL if count is 1. */
    std::vector<double> fractions;
    /** The sections, each initialised. */
    std::vector<Section> sections;
    /** Structural twist, the angles by which axes 2 and 3 of the sections are turned about axis 1
     * from those of the line, right-handed, linear between stations [radian]. NULL for none. It has
     * no jumps. */
    std::vector<double> twists;
    /** As the library takes it, valid while this object stays as it is. */
    const pdn_stations *get([[maybe_unused]] std::size_t nodes = 0)
    {
        pdn_stations::fractions = detail::in_or_null(fractions);
        pdn_stations::sections = detail::in_or_null(sections);
        pdn_stations::twists = detail::in_or_null(twists);
        pdn_stations::count = detail::common({{"fractions", fractions.size()},
            {"sections", sections.size()}, {"twists", twists.size()}}, true);
        return this;
    }
    // END

    /** One section for all of the beam. */
    Stations(const Section &section) : Stations({}, {section})
    {
    }
    /** At fractions of the span; with structural twist if there are as many angles. */
    Stations(std::vector<double> at, std::vector<Section> of, std::vector<double> twisted = {})
        : Stations()
    {
        fractions = std::move(at);
        sections = std::move(of);
        twists = std::move(twisted);
    }
};

/** What is asked of a solution, with the fields of ::pdn_quantity; `component` is
 * PDN_ALL_COMPONENTS at first. */
struct Quantity : pdn_quantity {
    // WRITTEN BY script/cpp_interface: pdn_quantity
    /** With its defaults. */
    Quantity()
        : pdn_quantity(detail::initialised(pdn_quantity_init))
    {
    }
    /** Number of components that are asked for: of values at a time, of means and of harmonics. */
    std::size_t components() const
    {
        const std::int32_t told = pdn_quantity_components(this);
        detail::check(told);
        return static_cast<std::size_t>(told);
    }
    /** The component, from 0, or PDN_ALL_COMPONENTS, the default. Of coordinates and driving
     * efforts, the coordinate: PDN_DISPLACEMENT, ..., PDN_ROTATION_3; of relations which of their
     * coordinates, from 0. */
    Quantity with_component(std::int32_t value) const
    {
        Quantity other(*this);
        other.component = value;
        return other;
    }
    /** PDN_FRAME_SPACE, the default, or PDN_FRAME_MATERIAL; of reactions PDN_FRAME_SPACE,
     * PDN_FRAME_FIRST or PDN_FRAME_SECOND. */
    Quantity with_frame(Frame value) const
    {
        Quantity other(*this);
        other.frame = detail::in(value);
        return other;
    }
    /** Of what a force exerts on one of its nodes, the node. */
    Quantity with_node(std::int32_t value) const
    {
        Quantity other(*this);
        other.node = value;
        return other;
    }
    /** Of viscoelastic elements, the branch, from 0; of controllers, which of the coordinates that
     * they act on, or which state, from 0. */
    Quantity with_branch(std::int32_t value) const
    {
        Quantity other(*this);
        other.branch = value;
        return other;
    }
    /** Of beams, the place along the element, from -1 at its first to 1 at its last node; of
     * shells, xi, from -1 to 1. */
    Quantity with_station(double value) const
    {
        Quantity other(*this);
        other.station = value;
        return other;
    }
    /** Of shells, eta, from -1 to 1. */
    Quantity with_station_eta(double value) const
    {
        Quantity other(*this);
        other.station_eta = value;
        return other;
    }
    /** Of shells, a direction in the reference configuration, global coordinates, whose part in the
     * surface is axis 1. If it is zero, the default, axes are those of the section. They move with
     * the shell. */
    Quantity with_direction(const Vector3 &value) const
    {
        Quantity other(*this);
        std::copy(value.begin(), value.end(), other.direction);
        return other;
    }
    // END

    /** Of a node, joint, beam element, shell element, force or relation; of a joint also for one
     * coordinate: it, its rate or acceleration, or what drives it. */
    Quantity(Kind of_kind, std::int32_t of_object, std::optional<Coordinate> coordinate = {})
        : Quantity()
    {
        kind = detail::in(of_kind);
        object = of_object;
        component = coordinate ? detail::in(*coordinate) : component;
    }
};
static_assert(sizeof(Quantity) == sizeof(pdn_quantity) && sizeof(Section) == sizeof(pdn_section),
              "arrays of these are arrays of those");

namespace detail
{

inline Converted<pdn_signal> in(const std::vector<std::array<Signal, 6>> &places)
{
    Converted<pdn_signal> signals;
    for (const auto &place : places) {
        signals.insert(signals.end(), place.begin(), place.end());
    }
    return signals;
}

/** Numbers, each time's together, as an array for each. */
template <std::size_t C>
Series<C> as_series(const std::vector<double> &numbers, std::size_t components)
{
    check_size("quantity", C, components, "components");
    Series<C> series(numbers.size() / C);
    std::copy(numbers.begin(), numbers.end(), flat(series));
    return series;
}

/** What the library has made: freed with the object, which can be moved, not copied. */
template <class T, void (*free)(T *)> class Handle
{
  public:
    /** Takes over a handle of periodyn.h; keeps the functions of signals that it may call. */
    Handle(T *handle, Kept kept) : kept_(std::move(kept)), handle_(handle, free)
    {
    }
    /** The handle, for functions of periodyn.h; NULL if moved from. */
    T *get() const noexcept
    {
        return handle_.get();
    }
    /** The functions of signals that it may call. */
    const Kept &kept() const noexcept
    {
        return kept_;
    }

  protected:
    /** A call that takes signals: functions among them are kept, as all else is copied. */
    template <class Call, class... Signals> void take(Call call, const Signals &...signals)
    {
        const std::size_t before = kept_.size();
        (keep(signals), ...);
        const pdn_status status = call();
        if (status != PDN_OK) {
            kept_.resize(before);
        }
        check(status);
    }

  private:
    void keep(const std::optional<Signal> &signal)
    {
        if (signal && (signal->kind == PDN_SIGNAL_FUNCTION ||
                       signal->kind == PDN_SIGNAL_FUNCTION_OF_PHASE)) {
            kept_.push_back(signal->kept);
        }
    }
    void keep(const std::vector<std::array<Signal, 6>> &places)
    {
        for (const auto &place : places) {
            for (const Signal &signal : place) {
                keep(signal);
            }
        }
    }

    Kept kept_; // outlives the handle
    std::unique_ptr<T, void (*)(T *)> handle_;
};

} // namespace detail

// WRITTEN BY script/cpp_interface: classes
/** Options of ::pdn_solve_stability. */
struct StabilityOptions : pdn_stability_options {
    /** With its defaults. */
    StabilityOptions()
        : pdn_stability_options(detail::initialised(pdn_stability_options_init))
    {
    }
    /** Told about ten times a second that work goes on; may cancel. */
    Progress progress;
    /** As the library takes it, valid while this object stays as it is. */
    const pdn_stability_options *get([[maybe_unused]] std::size_t nodes = 0)
    {
        pdn_stability_options::progress = progress ? &detail::progress_fn<Progress> : nullptr;
        pdn_stability_options::progress_data = &progress;
        return this;
    }
};

/** Free parameters, and as many conditions. */
class Conditions : public detail::Handle<pdn_conditions, pdn_conditions_free>
{
  public:
    using Handle::Handle;
    /** Makes an empty list: no parameter is free. */
    Conditions() : Handle(nullptr, {})
    {
        pdn_conditions *out = nullptr;
        detail::check(pdn_version_check(PDN_VERSION_MAJOR, PDN_VERSION_MINOR));
        const pdn_status status = pdn_conditions_new(&out);
        *this = Conditions(out, {});
        detail::check(status);
    }
    /** Makes a parameter free: its value in the model is that to start from. */
    void release(std::int32_t parameter)
    {
        detail::check(pdn_conditions_release(get(), parameter));
    }
    /** Adds the condition on the phase: the motion is not ahead of that which the solve starts
     * from. */
    void add_phase()
    {
        detail::check(pdn_conditions_add_phase(get()));
    }
    /** Adds the condition on the phase of a rotation: in the mean over the period and all nodes,
     * the motion is not turned about an axis from that which the solve starts from. */
    void add_rotation_phase(const Vector3 &axis, const std::optional<Vector3> &point = {})
    {
        detail::check(pdn_conditions_add_rotation_phase(get(), detail::in(axis),
            detail::in(point)));
    }
    /** Adds the condition on the phase of a translation: in the mean over the period and all nodes,
     * the motion is not moved in a direction from that which the solve starts from. */
    void add_translation_phase(const Vector3 &direction)
    {
        detail::check(pdn_conditions_add_translation_phase(get(), detail::in(direction)));
    }
    /** Adds the condition that the mean, a harmonic, or the value at a time, of a quantity is this:
     * trim. */
    void add_quantity(const Quantity &quantity, Feature feature, double at, double value,
        double scale = 0.0)
    {
        detail::check(pdn_conditions_add_quantity(get(), &quantity, detail::in(feature), at, value,
            scale));
    }
    /** Adds the condition that a joint coordinate has a value at the start of the period. */
    void add_joint_coordinate(std::int32_t joint, Coordinate coordinate, double value)
    {
        detail::check(pdn_conditions_add_joint_coordinate(get(), joint, detail::in(coordinate),
            value));
    }
    /** Adds the condition that the mean of the kinetic and the potential energy over the period is
     * a value. */
    void add_energy(double energy)
    {
        detail::check(pdn_conditions_add_energy(get(), energy));
    }
    /** Adds the condition that the mean momentum in a direction is a value. */
    void add_momentum(const Vector3 &direction, double momentum)
    {
        detail::check(pdn_conditions_add_momentum(get(), detail::in(direction), momentum));
    }
    /** Adds the condition that the mean angular momentum about an axis is a value. */
    void add_angular_momentum(const Vector3 &axis, double momentum,
        const std::optional<Vector3> &point = {})
    {
        detail::check(pdn_conditions_add_angular_momentum(get(), detail::in(axis),
            detail::in(point), momentum));
    }
};

/** What model_mass gives. */
struct ModelMass {
    /** Total mass of bodies, masses and beams [mass]. */
    double mass;
    /** Centre of mass, global coordinates [length]. */
    Vector3 centre;
};

/** What model_turning_frame gives. */
struct ModelTurningFrame {
    /** Direction of the axis, of length 1. */
    Vector3 axis;
    /** Angle in a unit of time \[rad/time\]. */
    double rate;
    /** A point of the axis \[length\]. */
    Vector3 point;
};

/** What model_spin gives. */
struct ModelSpin {
    /** Direction of the axis, of length 1, along the axes of the node. */
    Vector3 axis;
    /** Angle in a unit of time \[rad/time\]. */
    double rate;
};

/** What model_rotor_symmetry gives. */
struct ModelRotorSymmetry {
    /** Direction of the axis, of length 1. */
    Vector3 axis;
    /** A point of the axis \[length\]. */
    Vector3 point;
    /** Number of blades. */
    std::int32_t blades;
    /** Number of nodes of each, for ::pdn_model_rotor_node. */
    std::int32_t nodes_of_blade;
    /** Number of nodes of the hub. */
    std::int32_t hub_nodes;
};

/** What model_add_rigid_joints gives. */
struct ModelRigidJoints {
    /** Id of the first of the joints, which follow each other in the order of the nodes. */
    std::int32_t first_joint;
    /** Number of joints. */
    std::int32_t joints;
};

/** What model_add_rigid_edge gives. */
struct ModelRigidEdge {
    /** Id of the first of the joints, which follow each other in the order of the nodes along u or
     * v. */
    std::int32_t first_joint;
    /** Number of joints. */
    std::int32_t joints;
};

/** What model_controller_counts gives. */
struct ModelControllerCounts {
    /** Number of coordinates that it reads. */
    std::int32_t input_count;
    /** Number of coordinates that it acts on. */
    std::int32_t output_count;
    /** Number of its states. */
    std::int32_t state_count;
};

/** What model_controller_coordinate gives. */
struct ModelControllerCoordinate {
    /** Id of its joint. */
    std::int32_t joint;
    /** The coordinate: PDN_DISPLACEMENT,. */
    Coordinate coordinate;
};

/** What model_controller_state gives. */
struct ModelControllerState {
    /** Its value where a march begins. */
    double initial;
    /** What it is of the order of. */
    double size;
};

/** What model_parameter gives. */
struct ModelParameter {
    /** Its value. */
    double value;
    /** What counts as 1 in it. */
    double scale;
};

/** What model_beam_section gives. */
struct ModelBeamSection {
    /** The section, in its own axes. */
    pdn_section section;
    /** Angle by which its axes are turned about axis 1 from those between the nodes [radian]. */
    double twist;
};

/** What model_inertia gives. */
struct ModelInertia {
    /** The node's id. */
    std::int32_t node;
    /** Inertia about the node, along its axes, as in ::pdn_model_add_inertia. */
    Matrix6 matrix;
};

/** What model_prescribed gives. */
struct ModelPrescribed {
    /** Id of its joint. */
    std::int32_t joint;
    /** PDN_DISPLACEMENT,. */
    Coordinate coordinate;
};

/** What model_relation_term gives. */
struct ModelRelationTerm {
    /** Id of the joint. */
    std::int32_t joint;
    /** PDN_DISPLACEMENT,. */
    Coordinate coordinate;
    /** The coefficient. */
    double coefficient;
};

/** What model_load_at gives. */
struct ModelLoadAt {
    /** Id of the node that carries it, or -1 if a beam does. */
    std::int32_t node;
    /** Id of the first of the beam elements that carry it, or -1 if a node does. */
    std::int32_t first_element;
    /** Number of these, from the first on, 0 if there are none. */
    std::int32_t elements;
    /** The place, as a fraction of the reference length of these elements, 0 if there are none. */
    double fraction;
    /** The point, from the node or the line of the beam, along the axes of the node or section. */
    Vector3 offset;
    /** PDN_FRAME_SPACE or PDN_FRAME_MATERIAL. */
    Frame frame;
};

/** What model_beam_load gives. */
struct ModelBeamLoad {
    /** Id of the first beam element. */
    std::int32_t first_element;
    /** Number of elements, from the first on. */
    std::int32_t elements;
    /** PDN_FRAME_SPACE, PDN_FRAME_MATERIAL or PDN_FRAME_UNTWISTED. */
    Frame frame;
    /** Direction that was given with PDN_FRAME_UNTWISTED, else zero. */
    Vector3 axis_2;
    /** Number of places with factors, 0 for a factor of 1 all along. */
    std::int32_t places;
};

/** What model_beam_load_factor gives. */
struct ModelBeamLoadFactor {
    /** The place, as a fraction of the reference length of its elements. */
    double fraction;
    /** The factor there. */
    double factor;
};

/** What model_shell_load gives. */
struct ModelShellLoad {
    /** Id of the first shell element. */
    std::int32_t first_element;
    /** Number of elements, from the first on. */
    std::int32_t elements;
    /** PDN_SHELL_SURFACE or an edge, of each of them. */
    ShellPlace place;
    /** PDN_FRAME_SPACE or PDN_FRAME_MATERIAL. */
    Frame frame;
};

/** A mechanism. */
class Model : public detail::Handle<pdn_model, pdn_model_free>
{
  public:
    using Handle::Handle;
    /** Makes an empty model. */
    Model() : Handle(nullptr, {})
    {
        pdn_model *model = nullptr;
        detail::check(pdn_version_check(PDN_VERSION_MAJOR, PDN_VERSION_MINOR));
        const pdn_status status = pdn_model_new(&model);
        *this = Model(model, {});
        detail::check(status);
    }
    /** Number of nodes; their ids follow each other from PDN_FIRST_NODE on. */
    std::int32_t node_count() const
    {
        std::int32_t count = 0;
        detail::check(pdn_model_node_count(get(), &count));
        return count;
    }
    /** Number of joints; their ids follow each other from PDN_FIRST_JOINT on. */
    std::int32_t joint_count() const
    {
        std::int32_t count = 0;
        detail::check(pdn_model_joint_count(get(), &count));
        return count;
    }
    /** Number of beam elements; their ids follow each other from PDN_FIRST_BEAM_ELEMENT on. */
    std::int32_t element_count() const
    {
        std::int32_t count = 0;
        detail::check(pdn_model_element_count(get(), &count));
        return count;
    }
    /** Total mass and centre of mass in the reference configuration. */
    ModelMass mass() const
    {
        double mass = 0;
        Vector3 centre{};
        detail::check(pdn_model_mass(get(), &mass, centre.data()));
        return {mass, centre};
    }
    /** Frame of a node in the reference configuration. */
    pdn_frame node_frame(std::int32_t node) const
    {
        pdn_frame frame{};
        detail::check(pdn_model_node_frame(get(), node, &frame));
        return frame;
    }
    /** Adds a node: a frame that moves. */
    std::int32_t add_node(const Vector3 &position, const std::optional<Matrix3> &rotation = {})
    {
        std::int32_t node = 0;
        detail::check(pdn_model_add_node(get(), detail::in(position), detail::in(rotation), &node));
        return node;
    }
    /** Adds a rigid body: a node at its centre of mass, with axes parallel to the global ones. */
    std::int32_t add_rigid_body(double mass, const Vector3 &centre, const Matrix3 &inertia)
    {
        std::int32_t node = 0;
        detail::check(pdn_model_add_rigid_body(get(), mass, detail::in(centre), detail::in(inertia),
            &node));
        return node;
    }
    /** Fixes a mass to a node, in addition to what the node has. */
    std::int32_t add_mass(std::int32_t node, double mass, const Vector3 &centre,
        const std::optional<Matrix3> &inertia = {})
    {
        std::int32_t id = 0;
        detail::check(pdn_model_add_mass(get(), node, mass, detail::in(centre), detail::in(inertia),
            &id));
        return id;
    }
    /** Fixes an inertia of any kind to a node, in addition to what the node has. */
    std::int32_t add_inertia(std::int32_t node, const Matrix6 &matrix,
        const std::optional<pdn_frame> &frame = {})
    {
        std::int32_t id = 0;
        detail::check(pdn_model_add_inertia(get(), node, frame ? &*frame : nullptr,
            detail::in(matrix), &id));
        return id;
    }
    /** Makes a joint coordinate follow a signal. */
    std::int32_t prescribe(std::int32_t joint, Coordinate coordinate, const Signal &signal)
    {
        std::int32_t prescribed = 0;
        take([&] {
            return pdn_model_prescribe(get(), joint, detail::in(coordinate), &signal, &prescribed);
        }, signal);
        return prescribed;
    }
    /** Fixes two bodies to each other. */
    std::int32_t add_rigid_joint(std::int32_t first, std::int32_t second, const Vector3 &point)
    {
        std::int32_t joint = 0;
        detail::check(pdn_model_add_rigid_joint(get(), first, second, detail::in(point), &joint));
        return joint;
    }
    /** Joins two bodies by a hinge. */
    std::int32_t add_revolute(std::int32_t first, std::int32_t second, const Vector3 &point,
        const Vector3 &axis)
    {
        std::int32_t joint = 0;
        detail::check(pdn_model_add_revolute(get(), first, second, detail::in(point),
            detail::in(axis), &joint));
        return joint;
    }
    /** Joins two bodies by a slider. */
    std::int32_t add_prismatic(std::int32_t first, std::int32_t second, const Vector3 &point,
        const Vector3 &axis)
    {
        std::int32_t joint = 0;
        detail::check(pdn_model_add_prismatic(get(), first, second, detail::in(point),
            detail::in(axis), &joint));
        return joint;
    }
    /** Joins two bodies by a shaft in a sleeve: one slides along the axis and turns about it. */
    std::int32_t add_cylindrical(std::int32_t first, std::int32_t second, const Vector3 &point,
        const Vector3 &axis)
    {
        std::int32_t joint = 0;
        detail::check(pdn_model_add_cylindrical(get(), first, second, detail::in(point),
            detail::in(axis), &joint));
        return joint;
    }
    /** Joins two bodies by a screw: the second advances along the axis as it turns about it. */
    std::int32_t add_screw(std::int32_t first, std::int32_t second, const Vector3 &point,
        const Vector3 &axis, double pitch)
    {
        std::int32_t joint = 0;
        detail::check(pdn_model_add_screw(get(), first, second, detail::in(point), detail::in(axis),
            pitch, &joint));
        return joint;
    }
    /** Joins two bodies by a pair of planes that slide and turn on each other. */
    std::int32_t add_planar(std::int32_t first, std::int32_t second, const Vector3 &point,
        const Vector3 &normal)
    {
        std::int32_t joint = 0;
        detail::check(pdn_model_add_planar(get(), first, second, detail::in(point),
            detail::in(normal), &joint));
        return joint;
    }
    /** Joins two bodies by nothing: a joint that constrains no motion, but has coordinates. */
    std::int32_t add_free_joint(std::int32_t first, std::int32_t second, const Vector3 &point)
    {
        std::int32_t joint = 0;
        detail::check(pdn_model_add_free_joint(get(), first, second, detail::in(point), &joint));
        return joint;
    }
    /** Joins two bodies by a ball. */
    std::int32_t add_spherical(std::int32_t first, std::int32_t second, const Vector3 &point)
    {
        std::int32_t joint = 0;
        detail::check(pdn_model_add_spherical(get(), first, second, detail::in(point), &joint));
        return joint;
    }
    /** Joins two bodies by a cross (Cardan, Hooke). */
    std::int32_t add_universal(std::int32_t first, std::int32_t second, const Vector3 &point,
        const Vector3 &first_arm, const Vector3 &second_arm)
    {
        std::int32_t joint = 0;
        detail::check(pdn_model_add_universal(get(), first, second, detail::in(point),
            detail::in(first_arm), detail::in(second_arm), &joint));
        return joint;
    }
    /** Adds a strut: the line between a point of each of two bodies. */
    std::int32_t add_strut(std::int32_t first, std::int32_t second, const Vector3 &first_point,
        const Vector3 &second_point)
    {
        std::int32_t joint = 0;
        detail::check(pdn_model_add_strut(get(), first, second, detail::in(first_point),
            detail::in(second_point), &joint));
        return joint;
    }
    /** Joins two bodies by a joint of any kind, between a frame fixed to each. */
    std::int32_t add_joint(JointKind kind, std::int32_t first, std::int32_t second,
        const pdn_frame &first_frame, const pdn_frame &second_frame)
    {
        std::int32_t joint = 0;
        detail::check(pdn_model_add_joint(get(), detail::in(kind), first, second, &first_frame,
            &second_frame, &joint));
        return joint;
    }
    /** Joins two bodies by a screw, between a frame fixed to each. */
    std::int32_t add_screw_between(std::int32_t first, std::int32_t second,
        const pdn_frame &first_frame, const pdn_frame &second_frame, double pitch)
    {
        std::int32_t joint = 0;
        detail::check(pdn_model_add_screw_between(get(), first, second, &first_frame, &second_frame,
            pitch, &joint));
        return joint;
    }
    /** Number of linear relations between joint coordinates; their ids follow each other from
     * PDN_FIRST_RELATION on. */
    std::int32_t relation_count() const
    {
        std::int32_t count = 0;
        detail::check(pdn_model_relation_count(get(), &count));
        return count;
    }
    /** Adds a linear relation between joint coordinates: gears, belts, racks, differentials. */
    std::int32_t add_relation(const std::vector<std::int32_t> &joints,
        const std::vector<Coordinate> &coordinates, const std::vector<double> &coefficients,
        const std::optional<Signal> &signal = {})
    {
        const std::size_t count = detail::common({{"joints", joints.size()},
            {"coordinates", coordinates.size()}, {"coefficients", coefficients.size()}}, false);
        std::int32_t relation = 0;
        take([&] {
            return pdn_model_add_relation(get(), detail::in(joints), detail::in(coordinates),
                detail::in(coefficients), count, signal ? &*signal : nullptr, &relation);
        }, signal);
        return relation;
    }
    /** Adds a beam element over nodes that are there; it may be curved and twisted. */
    std::int32_t add_beam_element(const std::vector<std::int32_t> &nodes, const Section &section)
    {
        const std::size_t count = nodes.size();
        std::int32_t element = 0;
        detail::check(pdn_model_add_beam_element(get(), detail::in(nodes), count, &section,
            &element));
        return element;
    }
    /** Adds a straight beam: its nodes and elements. */
    pdn_beam add_straight_beam(const Vector3 &start, const Vector3 &end, const Vector3 &axis_2,
        const Section &section, std::size_t elements, std::size_t degree)
    {
        pdn_beam beam{};
        detail::check(pdn_model_add_straight_beam(get(), detail::in(start), detail::in(end),
            detail::in(axis_2), &section, elements, degree, &beam));
        return beam;
    }
    /** Adds a beam along a line, with sections that may vary: its nodes and elements. */
    pdn_beam add_beam(const Line &line, Stations stations, std::size_t elements, std::size_t degree)
    {
        pdn_beam beam{};
        detail::check(pdn_model_add_beam(get(), &line, stations.get(), elements, degree, &beam));
        return beam;
    }
    /** Adds a beam along a line as ::pdn_model_add_beam does, with elements between given
     * places. */
    pdn_beam add_beam_between(const Line &line, Stations stations,
        const std::vector<double> &boundaries, std::size_t degree)
    {
        const std::size_t count = boundaries.size();
        pdn_beam beam{};
        detail::check(pdn_model_add_beam_between(get(), &line, stations.get(),
            detail::in(boundaries), count, degree, &beam));
        return beam;
    }
    /** Adds one component of a force or moment on a node, in addition to those that are there. */
    std::int32_t add_load(std::int32_t node, Frame frame, Component component, const Signal &signal)
    {
        std::int32_t load = 0;
        take([&] {
            return pdn_model_add_load(get(), node, detail::in(frame), detail::in(component),
                &signal, &load);
        }, signal);
        return load;
    }
    /** Adds one component of a force or moment at a point that a node carries, in addition to those
     * that are there: such as a thrust that acts off the node of a body. */
    std::int32_t add_load_at_point(std::int32_t node, const Vector3 &offset, Frame frame,
        Component component, const Signal &signal)
    {
        std::int32_t load = 0;
        take([&] {
            return pdn_model_add_load_at_point(get(), node, detail::in(offset), detail::in(frame),
                detail::in(component), &signal, &load);
        }, signal);
        return load;
    }
    /** Adds one component of a force or moment at a fraction of the span of a beam, in addition to
     * those that are there. */
    std::int32_t add_load_on_beam(std::int32_t first_element, std::int32_t elements,
        double fraction, Frame frame, Component component, const Signal &signal,
        const std::optional<Vector3> &offset = {})
    {
        std::int32_t load = 0;
        take([&] {
            return pdn_model_add_load_on_beam(get(), first_element, elements, fraction,
                detail::in(offset), detail::in(frame), detail::in(component), &signal, &load);
        }, signal);
        return load;
    }
    /** Sets the acceleration of gravity, in place of any set before. */
    void set_gravity(const Vector3 &acceleration)
    {
        detail::check(pdn_model_set_gravity(get(), detail::in(acceleration)));
    }
    /** Sets an acceleration of gravity that varies in time, in place of any set before. */
    void set_gravity_signals(const std::optional<Signal> &acceleration_1 = {},
        const std::optional<Signal> &acceleration_2 = {},
        const std::optional<Signal> &acceleration_3 = {})
    {
        take([&] {
            return pdn_model_set_gravity_signals(get(), acceleration_1 ? &*acceleration_1 : nullptr,
                acceleration_2 ? &*acceleration_2 : nullptr,
                acceleration_3 ? &*acceleration_3 : nullptr);
        }, acceleration_1, acceleration_2, acceleration_3);
    }
    /** Adds one component of a force or moment distributed along beam elements, in addition to
     * those that are there. */
    std::int32_t add_distributed_load(std::int32_t first_element, std::int32_t elements,
        Frame frame, Component component, const Signal &signal,
        const std::vector<double> &fractions = {}, const std::vector<double> &factors = {})
    {
        const std::size_t count = detail::common({{"fractions", fractions.size()},
            {"factors", factors.size()}}, true);
        std::int32_t load = 0;
        take([&] {
            return pdn_model_add_distributed_load(get(), first_element, elements, detail::in(frame),
                detail::in(component), &signal, detail::in_or_null(fractions),
                detail::in_or_null(factors), count, &load);
        }, signal);
        return load;
    }
    /** Adds a force and moment distributed along beam elements, all components at all places at
     * once, in addition to those that are there: such as the air loads of a blade, at the places
     * where these are computed. */
    std::int32_t add_load_at_places(std::int32_t first_element, std::int32_t elements, Frame frame,
        const std::vector<double> &fractions, const std::vector<std::array<Signal, 6>> &signals,
        const std::optional<Vector3> &axis_2 = {})
    {
        const std::size_t count = detail::common({{"fractions", fractions.size()},
            {"signals", signals.size()}}, false);
        std::int32_t first_load_ = 0;
        take([&] {
            return pdn_model_add_load_at_places(get(), first_element, elements, detail::in(frame),
                detail::in(axis_2), detail::in(fractions), detail::in(signals), count,
                &first_load_);
        }, signals);
        return first_load_;
    }
    /** Describes everything in a frame that turns about a fixed axis at a constant rate, in place
     * of any set before: motions that repeat themselves but for a turn in each period are periodic
     * there. */
    void set_turning_frame(const Vector3 &axis, double rate,
        const std::optional<Vector3> &point = {})
    {
        detail::check(pdn_model_set_turning_frame(get(), detail::in(axis), rate,
            detail::in(point)));
    }
    /** The frame that a model is described in, if it turns. */
    ModelTurningFrame turning_frame() const
    {
        Vector3 axis{};
        double rate = 0;
        Vector3 point{};
        detail::check(pdn_model_turning_frame(get(), axis.data(), &rate, point.data()));
        return {axis, rate, point};
    }
    /** Lets the frame that everything is described in advance along its axis at a constant speed,
     * too: motions that repeat themselves but for a translation in each period, or for a screw
     * motion, are periodic there. */
    void set_frame_advance(double speed)
    {
        detail::check(pdn_model_set_frame_advance(get(), speed));
    }
    /** Speed along its axis of the frame that a model is described in. */
    double frame_advance() const
    {
        double speed = 0;
        detail::check(pdn_model_frame_advance(get(), &speed));
        return speed;
    }
    /** Lets a rigid body, or a mass or inertia on a node, spin at a constant rate relative to its
     * node, about an axis through its centre of mass which is fixed in the node: a disk, a rotor, a
     * flywheel with its gyroscopic moments, on a node that does not turn with it. */
    void set_spin(std::int32_t inertia, const Vector3 &axis, double rate)
    {
        detail::check(pdn_model_set_spin(get(), inertia, detail::in(axis), rate));
    }
    /** How an inertia spins relative to its node, if it does. */
    ModelSpin spin(std::int32_t inertia) const
    {
        Vector3 axis{};
        double rate = 0;
        detail::check(pdn_model_spin(get(), inertia, axis.data(), &rate));
        return {axis, rate};
    }
    /** Lets the material of beam elements spin about axis 1 of their sections at a constant rate
     * relative to their nodes, which do not spin along: a shaft that turns, and whirls by small
     * angles about where it stands, as ::pdn_model_set_spin lets a disk on it. */
    void set_beam_spin(std::int32_t first_element, std::int32_t elements, double rate)
    {
        detail::check(pdn_model_set_beam_spin(get(), first_element, elements, rate));
    }
    /** The rate at which the material of a beam element spins relative to its nodes. */
    double beam_spin(std::int32_t element) const
    {
        double rate = 0;
        detail::check(pdn_model_beam_spin(get(), element, &rate));
        return rate;
    }
    /** Says that the blades of a rotor are alike, in place of what was said before: periodic
     * solves, also under conditions, then solve for one blade, the hub and the supports, and the
     * others follow. */
    void set_rotor_symmetry(const Vector3 &axis, std::int32_t blades,
        const std::vector<std::int32_t> &nodes, const std::vector<std::int32_t> &hub,
        const std::optional<Vector3> &point = {})
    {
        const std::size_t count = nodes.size();
        const std::size_t hub_count = hub.size();
        detail::check(pdn_model_set_rotor_symmetry(get(), detail::in(axis), blades,
            detail::in(nodes), count, detail::in(hub), hub_count, detail::in(point)));
    }
    /** The rotor whose blades were said to be alike. */
    ModelRotorSymmetry rotor_symmetry() const
    {
        Vector3 axis{};
        Vector3 point{};
        std::int32_t blades = 0;
        std::int32_t nodes_of_blade = 0;
        std::int32_t hub_nodes = 0;
        detail::check(pdn_model_rotor_symmetry(get(), axis.data(), point.data(), &blades,
            &nodes_of_blade, &hub_nodes));
        return {axis, point, blades, nodes_of_blade, hub_nodes};
    }
    /** A node of a rotor whose blades were said to be alike. */
    std::int32_t rotor_node(std::int32_t blade, std::int32_t index) const
    {
        std::int32_t node = 0;
        detail::check(pdn_model_rotor_node(get(), blade, index, &node));
        return node;
    }
    /** Adds a shell element over a grid of nodes that are there. */
    std::int32_t add_shell_element(const std::vector<std::int32_t> &nodes, std::size_t n_xi,
        const ShellSection &section, ShellPlacement placement = {})
    {
        const std::size_t count = nodes.size();
        std::int32_t element = 0;
        detail::check(pdn_model_add_shell_element(get(), detail::in(nodes), count, n_xi, &section,
            placement.get(), &element));
        return element;
    }
    /** Adds a shell over a surface, with elements in equal parts of u and v: its nodes and
     * elements. */
    pdn_shell add_shell(const Surface &surface, std::size_t elements_u, std::size_t elements_v,
        std::size_t degree_u, std::size_t degree_v, const ShellSection &section, bool join = true,
        ShellPlacement placement = {})
    {
        pdn_shell shell{};
        detail::check(pdn_model_add_shell(get(), &surface, elements_u, elements_v, degree_u,
            degree_v, detail::in(join), &section, placement.get(), &shell));
        return shell;
    }
    /** Adds a shell over given positions of its nodes, as ::pdn_model_add_shell does over a
     * surface. */
    pdn_shell add_shell_grid(const Series<3> &points, std::size_t elements_u,
        std::size_t elements_v, std::size_t degree_u, std::size_t degree_v,
        const ShellSection &section, bool join = true, ShellPlacement placement = {})
    {
        const std::size_t count = points.size();
        pdn_shell shell{};
        detail::check(pdn_model_add_shell_grid(get(), detail::in(points), count, elements_u,
            elements_v, degree_u, degree_v, detail::in(join), &section, placement.get(), &shell));
        return shell;
    }
    /** Adds a shell element for each cell of a mesh of quadrilaterals, as mesh generators make
     * them. */
    std::int32_t add_shell_quadrilaterals(const Series<3> &points,
        const std::vector<std::int32_t> &cells, std::size_t points_of_cell, std::size_t degree,
        const ShellSection &section, ShellPlacement placement = {})
    {
        const std::size_t point_count = points.size();
        const std::size_t count = cells.size();
        std::int32_t first_element = 0;
        detail::check(pdn_model_add_shell_quadrilaterals(get(), detail::in(points), point_count,
            detail::in(cells), count, points_of_cell, degree, &section, placement.get(),
            &first_element));
        return first_element;
    }
    /** Node of a shell over a surface or a grid. */
    std::int32_t shell_patch_node(const pdn_shell &shell, std::int32_t u, std::int32_t v) const
    {
        std::int32_t node = 0;
        detail::check(pdn_model_shell_patch_node(get(), &shell, u, v, &node));
        return node;
    }
    /** Number of shell elements; their ids follow each other from PDN_FIRST_SHELL_ELEMENT on. */
    std::int32_t shell_element_count() const
    {
        std::int32_t count = 0;
        detail::check(pdn_model_shell_element_count(get(), &count));
        return count;
    }
    /** Node of a shell element. */
    std::int32_t shell_node(std::int32_t element, std::int32_t xi, std::int32_t eta) const
    {
        std::int32_t node = 0;
        detail::check(pdn_model_shell_node(get(), element, xi, eta, &node));
        return node;
    }
    /** Adds one component of a force or moment on shell elements, in addition to those that are
     * there: for each unit of reference area, or of reference length of an edge. */
    std::int32_t add_shell_load(std::int32_t first_element, std::int32_t elements, ShellPlace place,
        Frame frame, Component component, const Signal &signal)
    {
        std::int32_t load = 0;
        take([&] {
            return pdn_model_add_shell_load(get(), first_element, elements, detail::in(place),
                detail::in(frame), detail::in(component), &signal, &load);
        }, signal);
        return load;
    }
    /** Gives shell elements forces and moments where nothing is strained: initial stress, in place
     * of any before. */
    void set_shell_prestress(std::int32_t first_element, std::int32_t elements,
        const std::array<double, 12> &resultants)
    {
        detail::check(pdn_model_set_shell_prestress(get(), first_element, elements,
            detail::in(resultants)));
    }
    /** Fixes nodes to a body, by a rigid joint each as ::pdn_model_add_rigid_joint makes: such as
     * the nodes along an edge of a shell, which then moves as a part of the body. */
    ModelRigidJoints add_rigid_joints(std::int32_t body, const std::vector<std::int32_t> &nodes)
    {
        const std::size_t count = nodes.size();
        std::int32_t first_joint_ = 0;
        std::int32_t joints = 0;
        detail::check(pdn_model_add_rigid_joints(get(), body, detail::in(nodes), count,
            &first_joint_, &joints));
        return {first_joint_, joints};
    }
    /** Fixes a whole edge of a shell over a surface or a grid to a body:
     * ::pdn_model_add_rigid_joints with the nodes along it. */
    ModelRigidEdge add_rigid_edge(std::int32_t body, const pdn_shell &shell, ShellPlace edge)
    {
        std::int32_t first_joint_ = 0;
        std::int32_t joints = 0;
        detail::check(pdn_model_add_rigid_edge(get(), body, &shell, detail::in(edge), &first_joint_,
            &joints));
        return {first_joint_, joints};
    }
    /** Number of forces: springs, dampers, actuators and the like, but not loads; their ids follow
     * each other from PDN_FIRST_FORCE on. */
    std::int32_t force_count() const
    {
        std::int32_t count = 0;
        detail::check(pdn_model_force_count(get(), &count));
        return count;
    }
    /** Adds a linear spring with a damper on a joint coordinate, in addition to those that are
     * there. */
    std::int32_t add_spring_damper(std::int32_t joint, Coordinate coordinate, double stiffness,
        double damping = 0.0, double rest = 0.0)
    {
        std::int32_t force = 0;
        detail::check(pdn_model_add_spring_damper(get(), joint, detail::in(coordinate), stiffness,
            damping, rest, &force));
        return force;
    }
    /** Adds a nonlinear spring with a damper on a joint coordinate: polynomials of the coordinate
     * and its rate. */
    std::int32_t add_nonlinear_spring_damper(std::int32_t joint, Coordinate coordinate,
        const std::vector<double> &stiffness = {}, const std::vector<double> &damping = {},
        double rest = 0.0)
    {
        const std::size_t stiffness_count = stiffness.size();
        const std::size_t damping_count = damping.size();
        std::int32_t force = 0;
        detail::check(pdn_model_add_nonlinear_spring_damper(get(), joint, detail::in(coordinate),
            detail::in_or_null(stiffness), stiffness_count, detail::in_or_null(damping),
            damping_count, rest, &force));
        return force;
    }
    /** Adds an actuator: a force on a displacement, or a torque on an angle, that follows a
     * signal. */
    std::int32_t add_actuator(std::int32_t joint, Coordinate coordinate, const Signal &signal)
    {
        std::int32_t force = 0;
        take([&] {
            return pdn_model_add_actuator(get(), joint, detail::in(coordinate), &signal, &force);
        }, signal);
        return force;
    }
    /** Adds a viscoelastic element on a joint coordinate: a generalised Maxwell model. */
    std::int32_t add_viscoelastic(std::int32_t joint, Coordinate coordinate, double stiffness,
        double rest, const std::vector<double> &branch_stiffness,
        const std::vector<double> &relaxation_times)
    {
        const std::size_t branches = detail::common({{"branch_stiffness", branch_stiffness.size()},
            {"relaxation_times", relaxation_times.size()}}, false);
        std::int32_t force = 0;
        detail::check(pdn_model_add_viscoelastic(get(), joint, detail::in(coordinate), stiffness,
            rest, detail::in(branch_stiffness), detail::in(relaxation_times), branches, &force));
        return force;
    }
    /** Adds a viscous damper between two bodies, with a full matrix of coefficients. */
    std::int32_t add_viscous_damper(std::int32_t first, std::int32_t second, const Matrix6 &matrix,
        const std::optional<pdn_frame> &frame = {})
    {
        std::int32_t force = 0;
        detail::check(pdn_model_add_viscous_damper(get(), first, second, frame ? &*frame : nullptr,
            detail::in(matrix), &force));
        return force;
    }
    /** Adds a bushing, a bearing or a seal: any matrices of stiffness and damping between two
     * frames, unsymmetric ones included. */
    std::int32_t add_bushing(std::int32_t first, std::int32_t second, const pdn_frame &first_frame,
        const pdn_frame &second_frame, const Matrix6 &stiffness, const Matrix6 &damping,
        BushingAngles angles)
    {
        std::int32_t force = 0;
        detail::check(pdn_model_add_bushing(get(), first, second, &first_frame, &second_frame,
            detail::in(stiffness), detail::in(damping), detail::in(angles), &force));
        return force;
    }
    /** Adds a spring-damper on a joint coordinate whose law is a function of the caller. */
    template <class Function>
    std::int32_t add_coordinate_law(std::int32_t joint, Coordinate coordinate, Function function)
    {
        std::int32_t force = 0;
        detail::hand_over([&](void *owned, pdn_destroy_fn destroy) {
            return pdn_model_add_coordinate_law(get(), joint, detail::in(coordinate),
                detail::in(detail::tangents_of<Function>), &detail::coordinate_law_fn<Function>,
                owned, destroy, &force);
        }, std::move(function));
        return force;
    }
    /** Adds forces on nodes that a function of the caller computes. */
    template <class Function>
    std::int32_t add_user_force(const std::vector<std::int32_t> &nodes, Frame frame,
        Tangents tangents, Function function)
    {
        const std::size_t count = nodes.size();
        std::int32_t force = 0;
        detail::hand_over([&](void *owned, pdn_destroy_fn destroy) {
            return pdn_model_add_user_force(get(), detail::in(nodes), count, detail::in(frame),
                detail::in(tangents), &detail::user_force_fn<Function>, owned, destroy, &force);
        }, std::move(function));
        return force;
    }
    /** Declares that the force on each node of a function's force depends on time and on the motion
     * of this node alone, as that of the air on points of a wing by strips does. */
    void declare_nodes_apart(std::int32_t force)
    {
        detail::check(pdn_model_declare_nodes_apart(get(), force));
    }
    /** Compares the tangents that a user's function gives with differences of its forces. */
    pdn_tangent_check check_tangents(std::int32_t force, double period) const
    {
        pdn_tangent_check check = detail::initialised(pdn_tangent_check_init);
        detail::check(pdn_model_check_tangents(get(), force, period, &check));
        return check;
    }
    /** Adds a controller: efforts on joint coordinates by a function of the caller that reads any
     * joint coordinates and their rates, and may have states of its own. */
    template <class Function>
    std::int32_t add_controller(const std::vector<std::int32_t> &input_joints,
        const std::vector<Coordinate> &input_coordinates,
        const std::vector<std::int32_t> &output_joints,
        const std::vector<Coordinate> &output_coordinates, const std::vector<double> &initial,
        const std::vector<double> &sizes, Tangents tangents, Function function)
    {
        const std::size_t input_count = detail::common({{"input_joints", input_joints.size()},
            {"input_coordinates", input_coordinates.size()}}, true);
        const std::size_t output_count = detail::common({{"output_joints", output_joints.size()},
            {"output_coordinates", output_coordinates.size()}}, false);
        const std::size_t state_count = detail::common({{"initial", initial.size()},
            {"sizes", sizes.size()}}, true);
        std::int32_t force = 0;
        detail::hand_over([&](void *owned, pdn_destroy_fn destroy) {
            return pdn_model_add_controller(get(), detail::in_or_null(input_joints),
                detail::in(input_coordinates), input_count, detail::in(output_joints),
                detail::in(output_coordinates), output_count, detail::in_or_null(initial),
                detail::in_or_null(sizes), state_count, detail::in(tangents),
                &detail::controller_fn<Function>, owned, destroy, &force);
        }, std::move(function));
        return force;
    }
    /** Numbers of the coordinates that a controller reads, of those that it acts on, and of its
     * states. */
    ModelControllerCounts controller_counts(std::int32_t force) const
    {
        std::int32_t input_count = 0;
        std::int32_t output_count = 0;
        std::int32_t state_count = 0;
        detail::check(pdn_model_controller_counts(get(), force, &input_count, &output_count,
            &state_count));
        return {input_count, output_count, state_count};
    }
    /** A coordinate that a controller reads or acts on. */
    ModelControllerCoordinate controller_coordinate(std::int32_t force, std::int32_t index) const
    {
        std::int32_t joint = 0;
        std::int32_t coordinate = 0;
        detail::check(pdn_model_controller_coordinate(get(), force, index, &joint, &coordinate));
        return {joint, static_cast<Coordinate>(coordinate)};
    }
    /** A state of a controller. */
    ModelControllerState controller_state(std::int32_t force, std::int32_t index) const
    {
        double initial = 0;
        double size = 0;
        detail::check(pdn_model_controller_state(get(), force, index, &initial, &size));
        return {initial, size};
    }
    /** Adds forces on shell elements that a function of the caller computes at the points of a
     * quadrature: a force, with an id of its own, for each element. */
    template <class Function>
    std::int32_t add_surface_force(std::int32_t first_element, std::int32_t elements,
        ShellPlace place, Frame frame, Tangents tangents, Function function)
    {
        std::int32_t first_force_ = 0;
        detail::hand_over([&](void *owned, pdn_destroy_fn destroy) {
            return pdn_model_add_surface_force(get(), first_element, elements, detail::in(place),
                detail::in(frame), detail::in(tangents), &detail::surface_force_fn<Function>, owned,
                destroy, &first_force_);
        }, std::move(function));
        return first_force_;
    }
    /** Adds forces along beam elements that a function of the caller computes at the points of a
     * quadrature, such as those of the air on a blade: a force, with an id of its own, for each
     * element. */
    template <class Function>
    std::int32_t add_line_force(std::int32_t first_element, std::int32_t elements, Frame frame,
        const std::optional<Vector3> &axis_2, Tangents tangents, Function function)
    {
        std::int32_t first_force_ = 0;
        detail::hand_over([&](void *owned, pdn_destroy_fn destroy) {
            return pdn_model_add_line_force(get(), first_element, elements, detail::in(frame),
                detail::in(axis_2), detail::in(tangents), &detail::surface_force_fn<Function>,
                owned, destroy, &first_force_);
        }, std::move(function));
        return first_force_;
    }
    /** Gives a controller its function, or another one: that of a model from a file is not
     * there. */
    template <class Function>
    void bind_controller(std::int32_t force, Tangents tangents, Function function)
    {
        detail::hand_over([&](void *owned, pdn_destroy_fn destroy) {
            return pdn_model_bind_controller(get(), force, detail::in(tangents),
                &detail::controller_fn<Function>, owned, destroy);
        }, std::move(function));
    }
    /** Gives a coordinate law its function, or another one: that of a model from a file is not
     * there. */
    template <class Function>
    void bind_coordinate_law(std::int32_t force, Tangents tangents, Function function)
    {
        detail::hand_over([&](void *owned, pdn_destroy_fn destroy) {
            return pdn_model_bind_coordinate_law(get(), force, detail::in(tangents),
                &detail::coordinate_law_fn<Function>, owned, destroy);
        }, std::move(function));
    }
    /** Gives forces on nodes their function, or another one: that of a model from a file is not
     * there. */
    template <class Function>
    void bind_user_force(std::int32_t force, Frame frame, Tangents tangents, Function function)
    {
        detail::hand_over([&](void *owned, pdn_destroy_fn destroy) {
            return pdn_model_bind_user_force(get(), force, detail::in(frame), detail::in(tangents),
                &detail::user_force_fn<Function>, owned, destroy);
        }, std::move(function));
    }
    /** Gives forces on shell or beam elements their function, or another one: that of a model from
     * a file is not there. */
    template <class Function>
    void bind_surface_force(std::int32_t first_force_, std::int32_t forces, Frame frame,
        Tangents tangents, Function function)
    {
        detail::hand_over([&](void *owned, pdn_destroy_fn destroy) {
            return pdn_model_bind_surface_force(get(), first_force_, forces, detail::in(frame),
                detail::in(tangents), &detail::surface_force_fn<Function>, owned, destroy);
        }, std::move(function));
    }
    /** Gives what follows a signal another one: a load, an actuator, a prescribed coordinate. */
    void set_signal(std::int32_t id, std::int32_t component, const Signal &signal)
    {
        take([&] {
            return pdn_model_set_signal(get(), id, component, &signal);
        }, signal);
    }
    /** Gives a force other numbers of a sort, as many as it has: those that
     * ::pdn_model_force_number tells. */
    void set_force_numbers(std::int32_t force, Number number, const std::vector<double> &values)
    {
        const std::size_t count = values.size();
        detail::check(pdn_model_set_force_numbers(get(), force, detail::in(number),
            detail::in(values), count));
    }
    /** Gives a load, on a node, at a point, along beam elements or on shell elements, another
     * frame; its signals stay. */
    void set_load_frame(std::int32_t load, Frame frame, const std::optional<Vector3> &axis_2 = {})
    {
        detail::check(pdn_model_set_load_frame(get(), load, detail::in(frame), detail::in(axis_2)));
    }
    /** Gives beam elements another section, the same all along them; their twist stays, and so do
     * the factors of parameters. */
    void set_beam_section(std::int32_t first_element, std::int32_t elements, const Section &section)
    {
        detail::check(pdn_model_set_beam_section(get(), first_element, elements, &section));
    }
    /** Gives shell elements another section; frames, offset and the direction of its axes stay, and
     * so do the factors of parameters. */
    void set_shell_section(std::int32_t first_element, std::int32_t elements,
        const ShellSection &section)
    {
        detail::check(pdn_model_set_shell_section(get(), first_element, elements, &section));
    }
    /** Gives a rigid body, or a mass or inertia on a node, another inertia; the factor of a
     * parameter stays. */
    void set_inertia(std::int32_t inertia, const Matrix6 &matrix)
    {
        detail::check(pdn_model_set_inertia(get(), inertia, detail::in(matrix)));
    }
    /** Gives a node, joint, element, force, load or the like a label, in place of the one that it
     * has. */
    void set_label(std::int32_t id, const std::optional<std::string> &label = {})
    {
        detail::check(pdn_model_set_label(get(), id, detail::in(label)));
    }
    /** The label of a node, joint, element, force, load or the like. */
    std::string label(std::int32_t id) const
    {
        detail::in(this, "model");
        return detail::text([&](char *buffer, std::size_t capacity) {
            return pdn_model_label(get(), id, buffer, capacity);
        });
    }
    /** The node, joint, element, force, load or the like that has a label. */
    std::int32_t find_label(ObjectKind kind, const std::string &label) const
    {
        std::int32_t id = 0;
        detail::check(pdn_model_find_label(get(), detail::in(kind), detail::in(label), &id));
        return id;
    }
    /** Adds a parameter: a named number that moves what ::pdn_model_move_number and
     * ::pdn_model_move_signal say. */
    std::int32_t add_parameter(const std::string &name, double value, double scale)
    {
        std::int32_t out = 0;
        detail::check(pdn_model_add_parameter(get(), detail::in(name), value, scale, &out));
        return out;
    }
    /** Number of parameters; their ids follow each other from PDN_FIRST_PARAMETER on. */
    std::int32_t parameter_count() const
    {
        std::int32_t count = 0;
        detail::check(pdn_model_parameter_count(get(), &count));
        return count;
    }
    /** Value and scale of a parameter. */
    ModelParameter parameter(std::int32_t parameter) const
    {
        double value = 0;
        double scale = 0;
        detail::check(pdn_model_parameter(get(), parameter, &value, &scale));
        return {value, scale};
    }
    /** The name of a parameter. */
    std::string parameter_name(std::int32_t parameter) const
    {
        detail::in(this, "model");
        return detail::text([&](char *buffer, std::size_t capacity) {
            return pdn_model_parameter_name(get(), parameter, buffer, capacity);
        });
    }
    /** The parameter that has a name. */
    std::int32_t find_parameter(const std::string &name) const
    {
        std::int32_t parameter = 0;
        detail::check(pdn_model_find_parameter(get(), detail::in(name), &parameter));
        return parameter;
    }
    /** Lets a parameter move a number of the model: it becomes `factor` times the parameter's
     * value, now and whenever that changes. */
    void move_number(std::int32_t parameter, Number number, std::int32_t id, std::int32_t power,
        double factor)
    {
        detail::check(pdn_model_move_number(get(), parameter, detail::in(number), id, power,
            factor));
    }
    /** Lets a parameter move a part of a signal: it becomes `factor` times the parameter's value,
     * now and whenever that changes. */
    void move_signal(std::int32_t parameter, std::int32_t id, std::int32_t component,
        SignalPart part, double factor)
    {
        detail::check(pdn_model_move_signal(get(), parameter, id, component, detail::in(part),
            factor));
    }
    /** Gives a parameter another value, and all that it moves. */
    void set_parameter(std::int32_t parameter, double value)
    {
        detail::check(pdn_model_set_parameter(get(), parameter, value));
    }
    /** Gives everything with mass a force against its motion relative to the inertial frame,
     * `factor` times its momentum: damping in proportion to mass. */
    void set_mass_damping(double factor)
    {
        detail::check(pdn_model_set_mass_damping(get(), factor));
    }
    /** Declares that the function of a force is one of the phase, 2 pi t / T, which it is then told
     * in place of the time: it holds for any period T, as it must where that is unknown. */
    void declare_of_phase(std::int32_t force)
    {
        detail::check(pdn_model_declare_of_phase(get(), force));
    }
    /** Kind, bodies and frames of a joint. */
    pdn_joint_info joint(std::int32_t joint) const
    {
        pdn_joint_info out = detail::initialised(pdn_joint_info_init);
        detail::check(pdn_model_joint(get(), joint, &out));
        return out;
    }
    /** Kind of a force, where it acts, and how many numbers it has. */
    pdn_force_info force(std::int32_t force) const
    {
        pdn_force_info out = detail::initialised(pdn_force_info_init);
        detail::check(pdn_model_force(get(), force, &out));
        return out;
    }
    /** A number of a force, with the factors of parameters. */
    double force_number(std::int32_t force, Number number, std::int32_t index) const
    {
        double out = 0;
        detail::check(pdn_model_force_number(get(), force, detail::in(number), index, &out));
        return out;
    }
    /** A node of forces of the user. */
    std::int32_t force_node(std::int32_t force, std::int32_t index) const
    {
        std::int32_t node = 0;
        detail::check(pdn_model_force_node(get(), force, index, &node));
        return node;
    }
    /** Number of nodes of a beam element. */
    std::int32_t beam_element_node_count(std::int32_t element) const
    {
        std::int32_t count = 0;
        detail::check(pdn_model_beam_element_node_count(get(), element, &count));
        return count;
    }
    /** A node of a beam element, in order along the beam. */
    std::int32_t beam_element_node(std::int32_t element, std::int32_t index) const
    {
        std::int32_t node = 0;
        detail::check(pdn_model_beam_element_node(get(), element, index, &node));
        return node;
    }
    /** Cross-section of a beam element at a place, with the factors of parameters. */
    ModelBeamSection beam_section(std::int32_t element, double station) const
    {
        pdn_section out = detail::initialised(pdn_section_init);
        double twist = 0;
        detail::check(pdn_model_beam_section(get(), element, station, &out, &twist));
        return {out, twist};
    }
    /** Number of inertias: bodies, masses and inertias on nodes; their ids follow each other from
     * PDN_FIRST_INERTIA on. */
    std::int32_t inertia_count() const
    {
        std::int32_t count = 0;
        detail::check(pdn_model_inertia_count(get(), &count));
        return count;
    }
    /** The inertia of a body, or a mass or inertia on a node, with the factors of parameters. */
    ModelInertia inertia(std::int32_t inertia) const
    {
        std::int32_t node = 0;
        Matrix6 matrix{};
        detail::check(pdn_model_inertia(get(), inertia, &node, matrix.data()));
        return {node, matrix};
    }
    /** The inertia of a node: of a rigid body its own, of others the one that was added first. */
    std::int32_t inertia_of(std::int32_t node) const
    {
        std::int32_t inertia = 0;
        detail::check(pdn_model_inertia_of(get(), node, &inertia));
        return inertia;
    }
    /** A prescribed coordinate; ::pdn_model_summary tells how many there are, whose ids follow each
     * other from PDN_FIRST_PRESCRIBED on, and ::pdn_model_sample_signal what they follow. */
    ModelPrescribed prescribed(std::int32_t prescribed) const
    {
        std::int32_t joint = 0;
        std::int32_t coordinate = 0;
        detail::check(pdn_model_prescribed(get(), prescribed, &joint, &coordinate));
        return {joint, static_cast<Coordinate>(coordinate)};
    }
    /** Number of coordinates of a linear relation. */
    std::int32_t relation_term_count(std::int32_t relation) const
    {
        std::int32_t count = 0;
        detail::check(pdn_model_relation_term_count(get(), relation, &count));
        return count;
    }
    /** A coordinate of a linear relation, and its coefficient. */
    ModelRelationTerm relation_term(std::int32_t relation, std::int32_t index) const
    {
        std::int32_t joint = 0;
        std::int32_t coordinate = 0;
        double coefficient = 0;
        detail::check(pdn_model_relation_term(get(), relation, index, &joint, &coordinate,
            &coefficient));
        return {joint, static_cast<Coordinate>(coordinate), coefficient};
    }
    /** Values of a signal of the model in time. */
    std::vector<double> sample_signal(std::int32_t id, std::int32_t component, double period,
        const std::vector<double> &times) const
    {
        const std::size_t count = times.size();
        std::vector<double> values(count);
        detail::check(pdn_model_sample_signal(get(), id, component, period, detail::in(times),
            count, values.data()));
        return values;
    }
    /** Number of loads on nodes and at points; their ids follow each other from PDN_FIRST_LOAD
     * on. */
    std::int32_t load_count() const
    {
        std::int32_t count = 0;
        detail::check(pdn_model_load_count(get(), &count));
        return count;
    }
    /** A load on a node or at a point; its components are signals, ::pdn_model_sample_signal. */
    ModelLoadAt load_at(std::int32_t load) const
    {
        std::int32_t node = 0;
        std::int32_t first_element = 0;
        std::int32_t elements = 0;
        double fraction = 0;
        Vector3 offset{};
        std::int32_t frame = 0;
        detail::check(pdn_model_load_at(get(), load, &node, &first_element, &elements, &fraction,
            offset.data(), &frame));
        return {node, first_element, elements, fraction, offset, static_cast<Frame>(frame)};
    }
    /** Number of loads along beam elements; their ids follow each other from PDN_FIRST_BEAM_LOAD
     * on. */
    std::int32_t beam_load_count() const
    {
        std::int32_t count = 0;
        detail::check(pdn_model_beam_load_count(get(), &count));
        return count;
    }
    /** A load along beam elements; its components are signals, ::pdn_model_sample_signal, times the
     * factors of ::pdn_model_beam_load_factor. */
    ModelBeamLoad beam_load(std::int32_t load) const
    {
        std::int32_t first_element = 0;
        std::int32_t elements = 0;
        std::int32_t frame = 0;
        Vector3 axis_2{};
        std::int32_t places = 0;
        detail::check(pdn_model_beam_load(get(), load, &first_element, &elements, &frame,
            axis_2.data(), &places));
        return {first_element, elements, static_cast<Frame>(frame), axis_2, places};
    }
    /** Factor of a load along beam elements at a place; it is linear in between. */
    ModelBeamLoadFactor beam_load_factor(std::int32_t load, std::int32_t index) const
    {
        double fraction = 0;
        double factor = 0;
        detail::check(pdn_model_beam_load_factor(get(), load, index, &fraction, &factor));
        return {fraction, factor};
    }
    /** Number of loads on shell elements; their ids follow each other from PDN_FIRST_SHELL_LOAD
     * on. */
    std::int32_t shell_load_count() const
    {
        std::int32_t count = 0;
        detail::check(pdn_model_shell_load_count(get(), &count));
        return count;
    }
    /** A load on shell elements; its components are signals, ::pdn_model_sample_signal. */
    ModelShellLoad shell_load(std::int32_t load) const
    {
        std::int32_t first_element = 0;
        std::int32_t elements = 0;
        std::int32_t place = 0;
        std::int32_t frame = 0;
        detail::check(pdn_model_shell_load(get(), load, &first_element, &elements, &place, &frame));
        return {first_element, elements, static_cast<ShellPlace>(place), static_cast<Frame>(frame)};
    }
    /** Counts, mass, degrees of freedom and mobility of a model in its reference configuration. */
    pdn_summary summary() const
    {
        pdn_summary out = detail::initialised(pdn_summary_init);
        detail::check(pdn_model_summary(get(), &out));
        return out;
    }
    /** The same in readable lines, with warnings: parts that nothing connects or holds, ends of
     * beams without a joint, nodes without inertia, joints open in the reference configuration or
     * far from all else, impossible moments of inertia, sizes, masses and stiffnesses that do not
     * fit each other. */
    std::string describe() const
    {
        summary();
        return detail::text([&](char *buffer, std::size_t capacity) {
            return pdn_model_describe(get(), buffer, capacity);
        });
    }
    /** A copy of a model, which may be changed and solved apart from it. */
    Model copy() const
    {
        pdn_model *out = nullptr;
        const pdn_status status = pdn_model_copy(get(), &out);
        Model made(out, kept());
        detail::check(status);
        return made;
    }
    /** Saves a model. */
    void save(const std::string &path) const
    {
        detail::check(pdn_model_save(get(), detail::in(path)));
    }
    /** Loads a model that ::pdn_model_save saved; its ids are what they were. */
    static Model load(const std::string &path)
    {
        pdn_model *out = nullptr;
        const pdn_status status = pdn_model_load(detail::in(path), &out);
        Model made(out, {});
        detail::check(status);
        return made;
    }
};

/** What is differentiated, by what. */
class Sensitivities : public detail::Handle<pdn_sensitivities, pdn_sensitivities_free>
{
  public:
    using Handle::Handle;
    /** Makes an empty list: nothing is differentiated. */
    Sensitivities() : Handle(nullptr, {})
    {
        pdn_sensitivities *out = nullptr;
        detail::check(pdn_version_check(PDN_VERSION_MAJOR, PDN_VERSION_MINOR));
        const pdn_status status = pdn_sensitivities_new(&out);
        *this = Sensitivities(out, {});
        detail::check(status);
    }
    /** Adds a dependent: the mean, a harmonic, the value at a time, or a peak of a quantity. */
    void add_quantity(const Quantity &quantity, Feature feature, double at = 0.0)
    {
        detail::check(pdn_sensitivities_add_quantity(get(), &quantity, detail::in(feature), at));
    }
    /** Adds a dependent: the value of a free parameter, which conditions determine. */
    void add_found(std::int32_t parameter)
    {
        detail::check(pdn_sensitivities_add_found(get(), parameter));
    }
    /** Adds a parameter that all is differentiated by. */
    void add_parameter(std::int32_t parameter)
    {
        detail::check(pdn_sensitivities_add_parameter(get(), parameter));
    }
};

/** Options of ::pdn_solution_sensitivities. */
struct SensitivityOptions : pdn_sensitivity_options {
    /** With its defaults. */
    SensitivityOptions()
        : pdn_sensitivity_options(detail::initialised(pdn_sensitivity_options_init))
    {
    }
    /** PDN_SENSITIVITY_AUTOMATIC, the default, PDN_SENSITIVITY_DIRECT or
     * PDN_SENSITIVITY_ADJOINT. */
    SensitivityMethod method = static_cast<SensitivityMethod>(pdn_sensitivity_options::method);
    /** How linear equations are solved: PDN_LINEAR_AUTOMATIC, ... Default PDN_LINEAR_AUTOMATIC. */
    Linear linear_solver = static_cast<Linear>(pdn_sensitivity_options::linear_solver);
    /** As the library takes it, valid while this object stays as it is. */
    const pdn_sensitivity_options *get([[maybe_unused]] std::size_t nodes = 0)
    {
        pdn_sensitivity_options::method = detail::in(method);
        pdn_sensitivity_options::linear_solver = detail::in(linear_solver);
        return this;
    }
};

/** What stability_verdict gives. */
struct StabilityVerdict {
    /** PDN_STABLE, PDN_UNSTABLE or PDN_STABILITY_NOT_KNOWN. */
    Verdict verdict;
    /** Angular frequency of modes up to which the verdict holds; infinite if all multipliers are
     * known. */
    double frequency_limit;
};

/** What stability_count gives. */
struct StabilityCount {
    /** The number that are known. */
    std::size_t count;
    /** The number that the system has. */
    std::size_t states;
};

/** What stability_shape gives. */
struct StabilityShape {
    /** Real part, components fastest. */
    Series<6> real;
    /** Imaginary part. */
    Series<6> imaginary;
};

/** Floquet multipliers of a periodic solution. */
class Stability : public detail::Handle<pdn_stability, pdn_stability_free>
{
  public:
    using Handle::Handle;
    /** How the analysis ended. */
    Outcome outcome() const
    {
        const std::int32_t told = pdn_stability_outcome(get());
        detail::check(told);
        return static_cast<Outcome>(told);
    }
    /** Whether it converged. */
    bool converged() const
    {
        return outcome() == Outcome::converged;
    }
    /** What the multipliers say. */
    StabilityVerdict verdict() const
    {
        std::int32_t verdict = 0;
        double frequency_limit = 0;
        detail::check(pdn_stability_verdict(get(), &verdict, &frequency_limit));
        return {static_cast<Verdict>(verdict), frequency_limit};
    }
    /** Number of multipliers that are known, and of those that the system has, one for each
     * state. */
    StabilityCount count() const
    {
        std::size_t out = 0;
        std::size_t states = 0;
        detail::check(pdn_stability_count(get(), &out, &states));
        return {out, states};
    }
    /** A multiplier. */
    pdn_multiplier multiplier(std::int32_t number) const
    {
        pdn_multiplier out = detail::initialised(pdn_multiplier_init);
        detail::check(pdn_stability_get(get(), number, &out));
        return out;
    }
    /** Number of times of the shapes of modes. */
    std::size_t time_count() const
    {
        std::size_t out = 0;
        detail::check(pdn_stability_time_count(get(), &out));
        return out;
    }
    /** Times of the shapes of modes: ends of equal steps over the period, the last is the
     * period. */
    std::vector<double> times() const
    {
        const std::size_t count = time_count();
        std::vector<double> times(count);
        detail::check(pdn_stability_times(get(), times.data(), count));
        return times;
    }
    /** The mode phi of a multiplier at a node over the period. */
    StabilityShape shape(std::int32_t number, std::int32_t node) const
    {
        const std::size_t steps = time_count();
        Series<6> real(steps);
        Series<6> imaginary(steps);
        detail::check(pdn_stability_shape(get(), number, node, steps, detail::flat(real),
            detail::flat(imaginary)));
        return {std::move(real), std::move(imaginary)};
    }
    /** A readable report: the verdict, how far it holds, and a table of the multipliers. */
    std::string report() const
    {
        detail::in(this, "stability");
        return detail::text([&](char *buffer, std::size_t capacity) {
            return pdn_stability_report(get(), buffer, capacity);
        });
    }
};

/** What solution_history gives. */
struct SolutionHistory {
    /** Residuals. */
    std::vector<double> residuals;
    /** Increments. */
    std::vector<double> increments;
    /** Steps. */
    std::vector<double> steps;
};

/** What solution_sharp_events gives. */
struct SolutionSharpEvents {
    /** Their times. */
    std::vector<double> times;
    /** Half-widths of the additional density of grid points. */
    std::vector<double> widths;
    /** Shares of the grid points, beside 1 for the rest. */
    std::vector<double> shares;
};

/** What solution_harmonics gives. */
struct SolutionHarmonics {
    /** Mean. */
    std::vector<double> mean;
    /** Growth per unit of time, of what gains turns. */
    std::vector<double> rate;
    /** Components of each harmonic together. */
    std::vector<double> cosines;
    /** Components of each harmonic together. */
    std::vector<double> sines;
};

/** What solution_extremes gives. */
struct SolutionExtremes {
    /** Smallest. */
    std::vector<double> smallest;
    /** Time of smallest. */
    std::vector<double> time_of_smallest;
    /** Largest. */
    std::vector<double> largest;
    /** Time of largest. */
    std::vector<double> time_of_largest;
};

/** What solution_multiplier_sensitivities gives. */
struct SolutionMultiplierSensitivities {
    /** Derivatives of the real part. */
    std::vector<double> re;
    /** Those of the imaginary part. */
    std::vector<double> im;
};

/** What solution_floquet gives. */
struct SolutionFloquet {
    /** Real. */
    std::vector<double> real;
    /** Imaginary. */
    std::vector<double> imaginary;
};

/** A solution, converged or not. */
class Solution : public detail::Handle<pdn_solution, pdn_solution_free>
{
  public:
    using Handle::Handle;
    /** How the solve ended. */
    Outcome outcome() const
    {
        const std::int32_t told = pdn_solution_outcome(get());
        detail::check(told);
        return static_cast<Outcome>(told);
    }
    /** Whether it converged. */
    bool converged() const
    {
        return outcome() == Outcome::converged;
    }
    /** A readable report: outcome and why, iterations, error estimates, time spent. */
    std::string report() const
    {
        detail::in(this, "solution");
        return detail::text([&](char *buffer, std::size_t capacity) {
            return pdn_solution_report(get(), buffer, capacity);
        });
    }
    /** The report as JSON, for programs: an object with the texts `kind`, `outcome`, `explanation`
     * and `report`; sizes; `grids` and `attempts`; the Newton `iterations`; `estimates`, named as
     * in pdn_diagnostics; what iteration of `linear` equations took; and `seconds`. */
    std::string report_json() const
    {
        detail::in(this, "solution");
        return detail::text([&](char *buffer, std::size_t capacity) {
            return pdn_solution_report_json(get(), buffer, capacity);
        });
    }
    /** Figures of a solve: iterations, error estimates, residuals between grid points, time
     * spent. */
    pdn_diagnostics diagnostics() const
    {
        pdn_diagnostics out = detail::initialised(pdn_diagnostics_init);
        detail::check(pdn_solution_diagnostics(get(), &out));
        return out;
    }
    /** History of the Newton iterations of the periodic problem. */
    SolutionHistory history() const
    {
        const std::size_t count = static_cast<std::size_t>(diagnostics().iterations);
        std::vector<double> residuals(count);
        std::vector<double> increments(count);
        std::vector<double> steps(count);
        detail::check(pdn_solution_history(get(), residuals.data(), increments.data(), steps.data(),
            count));
        return {std::move(residuals), std::move(increments), std::move(steps)};
    }
    /** Decay of the harmonics: largest amplitude of each over all nodes, of positions relative to
     * the size of the mechanism and of entries of rotation matrices. */
    std::vector<double> decay() const
    {
        const std::size_t count = static_cast<std::size_t>((diagnostics().grid_points + 1) / 2);
        std::vector<double> amplitudes(count);
        detail::check(pdn_solution_decay(get(), amplitudes.data(), count));
        return amplitudes;
    }
    /** Number of events that the grid points of a solution are closer together about: 0 if they are
     * equispaced. */
    std::size_t sharp_event_count() const
    {
        std::size_t out = 0;
        detail::check(pdn_solution_sharp_event_count(get(), &out));
        return out;
    }
    /** Events that the grid points of a solution are closer together about, those of
     * pdn_periodic_options or such as a solve to a tolerance has found. */
    SolutionSharpEvents sharp_events() const
    {
        const std::size_t count = sharp_event_count();
        std::vector<double> times(count);
        std::vector<double> widths(count);
        std::vector<double> shares(count);
        detail::check(pdn_solution_sharp_events(get(), times.data(), widths.data(), shares.data(),
            count));
        return {std::move(times), std::move(widths), std::move(shares)};
    }
    /** Grid times t_k = k T / N, unless grid points are closer together about events; of a march
     * the times of its steps, from the start. */
    std::vector<double> grid_times() const
    {
        const std::size_t count = static_cast<std::size_t>(diagnostics().grid_points);
        std::vector<double> times(count);
        detail::check(pdn_solution_grid_times(get(), times.data(), count));
        return times;
    }
    /** A quantity of a solution at any times. */
    std::vector<double> sample(const Quantity &quantity, const std::vector<double> &times) const
    {
        const std::size_t count = times.size();
        std::vector<double> out(count *quantity.components());
        detail::check(pdn_solution_sample(get(), &quantity, detail::in(times), count, out.data()));
        return out;
    }
    /** The same of a quantity of C components: an array for each. */
    template <std::size_t C>
    Series<C> sample(const Quantity &quantity, const std::vector<double> &times) const
    {
        return detail::as_series<C>(sample(quantity, times), quantity.components());
    }
    /** Fourier coefficients of a quantity: mean + rate t + sum of cosines[j] cos jwt + sines[j] sin
     * jwt. */
    SolutionHarmonics harmonics(const Quantity &quantity, std::size_t harmonics) const
    {
        detail::check(pdn_solution_harmonics(get(), &quantity, harmonics, nullptr, nullptr, nullptr,
            nullptr));
        std::vector<double> mean(quantity.components());
        std::vector<double> rate(quantity.components());
        std::vector<double> cosines(harmonics *quantity.components());
        std::vector<double> sines(harmonics *quantity.components());
        detail::check(pdn_solution_harmonics(get(), &quantity, harmonics, mean.data(), rate.data(),
            cosines.data(), sines.data()));
        return {std::move(mean), std::move(rate), std::move(cosines), std::move(sines)};
    }
    /** Smallest and largest values of a quantity, and their times. */
    SolutionExtremes extremes(const Quantity &quantity) const
    {
        std::vector<double> smallest(quantity.components());
        std::vector<double> time_of_smallest(quantity.components());
        std::vector<double> largest(quantity.components());
        std::vector<double> time_of_largest(quantity.components());
        detail::check(pdn_solution_extremes(get(), &quantity, smallest.data(),
            time_of_smallest.data(), largest.data(), time_of_largest.data()));
        return {std::move(smallest), std::move(time_of_smallest), std::move(largest),
            std::move(time_of_largest)};
    }
    /** A copy of a solution whose quantities are seen through a spectral filter. */
    Solution filtered(Filter filter, std::int32_t order) const
    {
        pdn_solution *out = nullptr;
        const pdn_status status = pdn_solution_filtered(get(), detail::in(filter), order, &out);
        Solution made(out, kept());
        detail::check(status);
        return made;
    }
    /** Value of a parameter in a solution: given, or found. */
    double parameter(std::int32_t parameter) const
    {
        double out = 0;
        detail::check(pdn_solution_parameter(get(), parameter, &out));
        return out;
    }
    /** Derivatives of what comes out of a periodic solution by parameters of its model. */
    std::vector<double> sensitivities(const Sensitivities &sensitivities, std::size_t dependents,
        std::size_t parameters, const Conditions *conditions = nullptr,
        SensitivityOptions options = {}) const
    {
        std::vector<double> derivatives(parameters *dependents);
        detail::check(pdn_solution_sensitivities(get(), sensitivities.get(), detail::in(conditions,
            "conditions"), options.get(), derivatives.data(), dependents, parameters));
        return derivatives;
    }
    /** Derivatives of a Floquet multiplier of a periodic solution by parameters of its model. */
    SolutionMultiplierSensitivities multiplier_sensitivities(const Sensitivities &sensitivities,
        const Stability &stability, std::int32_t number, std::size_t parameters,
        const Conditions *conditions = nullptr, SensitivityOptions options = {}) const
    {
        std::vector<double> re(parameters);
        std::vector<double> im(parameters);
        detail::check(pdn_solution_multiplier_sensitivities(get(), sensitivities.get(),
            stability.get(), number, detail::in(conditions, "conditions"), options.get(), re.data(),
            im.data(), parameters));
        return {std::move(re), std::move(im)};
    }
    /** Figures of a march: steps, periods, how much the last of them differ, how much the start was
     * changed. */
    pdn_march_diagnostics march() const
    {
        pdn_march_diagnostics out = detail::initialised(pdn_march_diagnostics_init);
        detail::check(pdn_solution_march(get(), &out));
        return out;
    }
    /** Number of Floquet multipliers of a solution: as many as the system has states, if
     * ::pdn_solve_shooting found them; of a periodic solution as many as ::pdn_solve_stability
     * finds, which is called with default options unless it has been before. */
    std::size_t floquet_count() const
    {
        std::size_t out = 0;
        detail::check(pdn_solution_floquet_count(get(), &out));
        return out;
    }
    /** Floquet multipliers: what disturbances of the motion are multiplied by in a period, the
     * largest first. */
    SolutionFloquet floquet() const
    {
        const std::size_t count = floquet_count();
        std::vector<double> real(count);
        std::vector<double> imaginary(count);
        detail::check(pdn_solution_floquet(get(), real.data(), imaginary.data(), count));
        return {std::move(real), std::move(imaginary)};
    }
    /** Writes an animation of a solution that ParaView opens: VTK's XML files, and a list of
     * them. */
    void write_vtk(const std::vector<double> &times, std::size_t points_per_element,
        const std::string &path) const
    {
        const std::size_t count = times.size();
        detail::check(pdn_solution_write_vtk(get(), detail::in(times), count, points_per_element,
            detail::in(path)));
    }
    /** Saves a solution with its model, whether it has converged or not. */
    void save(const std::string &path) const
    {
        detail::check(pdn_solution_save(get(), detail::in(path)));
    }
    /** Loads a solution that ::pdn_solution_save saved: its quantities, diagnostics and report are
     * what they were. */
    static Solution load(const std::string &path)
    {
        pdn_solution *out = nullptr;
        const pdn_status status = pdn_solution_load(detail::in(path), &out);
        Solution made(out, {});
        detail::check(status);
        return made;
    }
    /** A copy of the model that a solution is of, as it was when it was solved. */
    Model model() const
    {
        pdn_model *out = nullptr;
        const pdn_status status = pdn_solution_model(get(), &out);
        Model made(out, kept());
        detail::check(status);
        return made;
    }
};

/** Periodic motions along a parameter. */
class Branch : public detail::Handle<pdn_branch, pdn_branch_free>
{
  public:
    using Handle::Handle;
    /** Saves a branch with its model and all its points. */
    void save(const std::string &path) const
    {
        detail::check(pdn_branch_save(get(), detail::in(path)));
    }
    /** Loads a branch that ::pdn_branch_save saved. */
    static Branch load(const std::string &path)
    {
        pdn_branch *out = nullptr;
        const pdn_status status = pdn_branch_load(detail::in(path), &out);
        Branch made(out, {});
        detail::check(status);
        return made;
    }
    /** Why a branch ended. */
    BranchEnd end() const
    {
        const std::int32_t told = pdn_branch_end(get());
        detail::check(told);
        return static_cast<BranchEnd>(told);
    }
    /** A readable report: points, events, and why the branch ended. */
    std::string report() const
    {
        detail::in(this, "branch");
        return detail::text([&](char *buffer, std::size_t capacity) {
            return pdn_branch_report(get(), buffer, capacity);
        });
    }
    /** Number of points of a branch. */
    std::int32_t count() const
    {
        std::int32_t out = 0;
        detail::check(pdn_branch_count(get(), &out));
        return out;
    }
    /** A point of a branch. */
    pdn_branch_point point(std::int32_t point) const
    {
        pdn_branch_point out = detail::initialised(pdn_branch_point_init);
        detail::check(pdn_branch_get(get(), point, &out));
        return out;
    }
    /** The solution at a point of a branch. */
    Solution solution(std::int32_t point) const
    {
        pdn_solution *out = nullptr;
        const pdn_status status = pdn_branch_solution(get(), point, &out);
        Solution made(out, kept());
        detail::check(status);
        return made;
    }
    /** Writes a branch as CSV: a line for each point, with the parameter, how the step went, what
     * happens there, what multipliers say if they were wanted (`pdn_branch_options.stability`) and,
     * of each component of quantities, the mean, the size of the first harmonic, the least and the
     * largest value over the period. */
    void write_csv(const std::string &path, const std::vector<Quantity> &quantities = {}) const
    {
        const std::size_t count = quantities.size();
        detail::check(pdn_branch_write_csv(get(), detail::in_or_null(quantities), count,
            detail::in(path)));
    }
    /** Writes a chart of the exponents of small disturbances along a branch as CSV, as of Campbell:
     * of each point that is no event a line for each multiplier, but for conjugates and for those
     * that only move the motion in time or space. */
    void write_campbell(const std::string &path, const std::vector<std::int32_t> &blades = {},
        StabilityOptions options = {}) const
    {
        const std::size_t count = blades.size();
        detail::check(pdn_branch_write_campbell(get(), options.get(), detail::in_or_null(blades),
            count, detail::in(path)));
    }
};

/** What modes_count gives. */
struct ModesCount {
    /** The number. */
    std::int32_t count;
    /** 1 if the wanted number was found, or all that there are, else 0. */
    bool complete;
};

/** What modes_shape gives. */
struct ModesShape {
    /** Real part, components fastest. */
    Series<6> real;
    /** Imaginary part. */
    Series<6> imaginary;
};

/** An equilibrium and the modes about it. */
class Modes : public detail::Handle<pdn_modes, pdn_modes_free>
{
  public:
    using Handle::Handle;
    /** How the search for the equilibrium ended. */
    Outcome outcome() const
    {
        const std::int32_t told = pdn_modes_outcome(get());
        detail::check(told);
        return static_cast<Outcome>(told);
    }
    /** Whether it converged. */
    bool converged() const
    {
        return outcome() == Outcome::converged;
    }
    /** A readable report: outcome of the equilibrium and why, and a table of the modes. */
    std::string report() const
    {
        detail::in(this, "modes");
        return detail::text([&](char *buffer, std::size_t capacity) {
            return pdn_modes_report(get(), buffer, capacity);
        });
    }
    /** Number of modes: as many as were wanted, if there are and they were found. */
    ModesCount count() const
    {
        std::int32_t out = 0;
        std::int32_t complete = 0;
        detail::check(pdn_modes_count(get(), &out, &complete));
        return {out, complete != 0};
    }
    /** Eigenvalue, frequency and damping of a mode. */
    pdn_mode mode(std::int32_t mode) const
    {
        pdn_mode out = detail::initialised(pdn_mode_init);
        detail::check(pdn_modes_get(get(), mode, &out));
        return out;
    }
    /** Shape x of a mode at some nodes. */
    ModesShape shape(std::int32_t mode, const std::vector<std::int32_t> &nodes) const
    {
        const std::size_t count = nodes.size();
        Series<6> real(count);
        Series<6> imaginary(count);
        detail::check(pdn_modes_shape(get(), mode, detail::in(nodes), count, detail::flat(real),
            detail::flat(imaginary)));
        return {std::move(real), std::move(imaginary)};
    }
    /** The motion in a mode, to be looked at as any other solution. */
    Solution motion(std::int32_t mode, double amplitude) const
    {
        pdn_solution *out = nullptr;
        const pdn_status status = pdn_modes_motion(get(), mode, amplitude, &out);
        Solution made(out, kept());
        detail::check(status);
        return made;
    }
    /** The equilibrium, as ::pdn_solve_static gives it, converged or not. */
    Solution equilibrium() const
    {
        pdn_solution *out = nullptr;
        const pdn_status status = pdn_modes_equilibrium(get(), &out);
        Solution made(out, kept());
        detail::check(status);
        return made;
    }
};

/** Columns of numbers over the same times. */
class Table : public detail::Handle<pdn_table, pdn_table_free>
{
  public:
    using Handle::Handle;
    /** Adds the columns of a quantity of a solution, named by the label and the component; or that
     * of one component, named by the label alone. */
    void add_quantity(const Solution &solution, const Quantity &quantity,
        const std::optional<std::string> &label = {})
    {
        detail::check(pdn_table_add_quantity(get(), solution.get(), &quantity, detail::in(label)));
    }
    /** A table over these times, to choose columns for and to write as CSV. */
    explicit Table(const std::vector<double> &times) : Handle(nullptr, {})
    {
        const std::size_t count = times.size();
        pdn_table *out = nullptr;
        detail::check(pdn_version_check(PDN_VERSION_MAJOR, PDN_VERSION_MINOR));
        const pdn_status status = pdn_table_new(detail::in(times), count, &out);
        *this = Table(out, {});
        detail::check(status);
    }
    /** Adds a column of values of your own, such as one computed from several quantities. */
    void add_values(const std::string &label, const std::vector<double> &values)
    {
        const std::size_t count = values.size();
        detail::check(pdn_table_add_values(get(), detail::in(label), detail::in(values), count));
    }
    /** Writes a table as a CSV file: a line of names, then a line for each time. */
    void write_csv(const std::string &path) const
    {
        detail::check(pdn_table_write_csv(get(), detail::in(path)));
    }
};

/** Options of ::pdn_solve_periodic. */
struct PeriodicOptions : pdn_periodic_options {
    /** With its defaults. */
    PeriodicOptions()
        : pdn_periodic_options(detail::initialised(pdn_periodic_options_init))
    {
    }
    /** Start from this solution, periodic or static, also on another grid or of another period, or
     * from the last period of this march. Its model is to have the same bodies, joints, forces and
     * prescribed coordinates, and the same beams, which may have other meshes. If grid_points is 0,
     * the first grid is that of this solution. */
    const Solution *initial = nullptr;
    /** Start from these positions, an array of shape 3 x [N] x [nodes]: coordinates fastest, then
     * grid points, then nodes. Needs guess_rotations, and grid_points or harmonics. */
    Series<3> guess_positions;
    /** Rotation matrices of the same start, an array of shape 9 x [N] x [nodes], each column by
     * column. */
    Series<9> guess_rotations;
    /** Told of each iteration, and while one lasts, see progress_interval; may cancel. */
    Progress progress;
    /** How linear equations are solved: PDN_LINEAR_AUTOMATIC, PDN_LINEAR_DIRECT, ... Default
     * PDN_LINEAR_AUTOMATIC. */
    Linear linear_solver = static_cast<Linear>(pdn_periodic_options::linear_solver);
    /** Where the library starts, unless a start is given: PDN_START_AUTOMATIC, or one way alone:
     * PDN_START_QUASI_STATIC, ... PDN_START_STEADY_ROTATION and PDN_START_RIGID_ROTATION need a
     * drive that turns. Default PDN_START_AUTOMATIC. */
    Start start = static_cast<Start>(pdn_periodic_options::start);
    /** Where the points of grids are: PDN_TIME_MAP_AUTOMATIC, PDN_TIME_MAP_EQUISPACED or
     * PDN_TIME_MAP_EVENTS. By PDN_TIME_MAP_AUTOMATIC, a given number of points is equispaced, and a
     * solve to a tolerance that starts from a solution goes on with the map of that. Default
     * PDN_TIME_MAP_AUTOMATIC. */
    TimeMap time_map = static_cast<TimeMap>(pdn_periodic_options::time_map);
    /** Times of the events, which repeat themselves every period: an array of length
     * [event_count]. */
    std::vector<double> event_times;
    /** Times from there to where the additional density of grid points is half as large, about as
     * long as the events last, from 1e-5 to half the period: an array of length [event_count]. */
    std::vector<double> event_widths;
    /** Grid points that are there for each, beside those spread equally over the period, which
     * count as 1; above 0, at most 100: an array of length [event_count]. */
    std::vector<double> event_shares;
    /** As the library takes it, valid while this object stays as it is. */
    const pdn_periodic_options *get([[maybe_unused]] std::size_t nodes = 0)
    {
        pdn_periodic_options::initial = detail::in(initial, "options.initial");
        pdn_periodic_options::guess_positions = detail::flat(guess_positions, nodes,
            harmonics != 0 ? 2 * harmonics + 1 : grid_points, "guess_positions");
        pdn_periodic_options::guess_rotations = detail::flat(guess_rotations, nodes,
            harmonics != 0 ? 2 * harmonics + 1 : grid_points, "guess_rotations");
        pdn_periodic_options::progress = progress ? &detail::progress_fn<Progress> : nullptr;
        pdn_periodic_options::progress_data = &progress;
        pdn_periodic_options::linear_solver = detail::in(linear_solver);
        pdn_periodic_options::start = detail::in(start);
        pdn_periodic_options::time_map = detail::in(time_map);
        pdn_periodic_options::event_times = detail::in_or_null(event_times);
        pdn_periodic_options::event_widths = detail::in_or_null(event_widths);
        pdn_periodic_options::event_shares = detail::in_or_null(event_shares);
        pdn_periodic_options::event_count = detail::common({{"event_times", event_times.size()},
            {"event_widths", event_widths.size()}, {"event_shares", event_shares.size()}}, true);
        return this;
    }
};

/** Options of ::pdn_equations_new. */
struct EquationsOptions : pdn_equations_options {
    /** With its defaults. */
    EquationsOptions()
        : pdn_equations_options(detail::initialised(pdn_equations_options_init))
    {
    }
    /** Where to begin: a solution as for pdn_periodic_options.initial. */
    const Solution *initial = nullptr;
    /** Rank of each node, an array of length [owner_count]. Each rank must have a node. */
    std::vector<std::int32_t> owners;
    /** The preconditioner: PDN_LINEAR_TIME_LOCAL, PDN_LINEAR_BODY_CIRCULANT, PDN_LINEAR_CIRCULANT,
     * or PDN_LINEAR_AUTOMATIC for the first where joints turn in the initial motion, the second
     * otherwise. Default PDN_LINEAR_AUTOMATIC. */
    Linear preconditioner = static_cast<Linear>(pdn_equations_options::preconditioner);
    /** As the library takes it, valid while this object stays as it is. */
    const pdn_equations_options *get([[maybe_unused]] std::size_t nodes = 0)
    {
        pdn_equations_options::initial = detail::in(initial, "options.initial");
        pdn_equations_options::owners = detail::in_or_null(owners);
        pdn_equations_options::preconditioner = detail::in(preconditioner);
        pdn_equations_options::owner_count = detail::common({{"owners", owners.size()}}, true);
        return this;
    }
};

/** Options of ::pdn_solve_static. */
struct StaticOptions : pdn_static_options {
    /** With its defaults. */
    StaticOptions()
        : pdn_static_options(detail::initialised(pdn_static_options_init))
    {
    }
    /** Start from this solution, at `time`, of a model with the same nodes and joints. */
    const Solution *initial = nullptr;
    /** Told of each iteration, and about ten times a second while one lasts; may cancel. */
    Progress progress;
    /** As the library takes it, valid while this object stays as it is. */
    const pdn_static_options *get([[maybe_unused]] std::size_t nodes = 0)
    {
        pdn_static_options::initial = detail::in(initial, "options.initial");
        pdn_static_options::progress = progress ? &detail::progress_fn<Progress> : nullptr;
        pdn_static_options::progress_data = &progress;
        return this;
    }
};

/** Options of ::pdn_solve_march. */
struct MarchOptions : pdn_march_options {
    /** With its defaults. */
    MarchOptions()
        : pdn_march_options(detail::initialised(pdn_march_options_init))
    {
    }
    /** Start from this solution of a model with the same nodes and joints, at start_time: an
     * equilibrium, a periodic motion or another march. */
    const Solution *initial = nullptr;
    /** Start from these positions, an array of shape 3 x [nodes]. Needs rotations. */
    Series<3> positions;
    /** Rotation matrices of the same start, an array of shape 9 x [nodes], each column by
     * column. */
    Series<9> rotations;
    /** Velocities of the same start, an array of shape 6 x [nodes]: velocity of each node and its
     * angular velocity, inertial frame. */
    Series<6> velocities;
    /** Told of each step, and about ten times a second while one lasts; may cancel. */
    Progress progress;
    /** As the library takes it, valid while this object stays as it is. */
    const pdn_march_options *get([[maybe_unused]] std::size_t nodes = 0)
    {
        pdn_march_options::initial = detail::in(initial, "options.initial");
        pdn_march_options::positions = detail::flat(positions, nodes, 1, "positions");
        pdn_march_options::rotations = detail::flat(rotations, nodes, 1, "rotations");
        pdn_march_options::velocities = detail::flat(velocities, nodes, 1, "velocities");
        pdn_march_options::progress = progress ? &detail::progress_fn<Progress> : nullptr;
        pdn_march_options::progress_data = &progress;
        return this;
    }
};

/** Options of ::pdn_solve_shooting. */
struct ShootingOptions : pdn_shooting_options {
    /** With its defaults. */
    ShootingOptions()
        : pdn_shooting_options(detail::initialised(pdn_shooting_options_init))
    {
    }
    /** Start the march from this solution of a model with the same nodes and joints, at its time 0
     * or, of a march, at its first time. */
    const Solution *initial = nullptr;
    /** Told of each period of the guess and of each iteration, and about ten times a second while
     * one lasts; may cancel. */
    Progress progress;
    /** As the library takes it, valid while this object stays as it is. */
    const pdn_shooting_options *get([[maybe_unused]] std::size_t nodes = 0)
    {
        pdn_shooting_options::initial = detail::in(initial, "options.initial");
        pdn_shooting_options::progress = progress ? &detail::progress_fn<Progress> : nullptr;
        pdn_shooting_options::progress_data = &progress;
        return this;
    }
};

/** Options of ::pdn_follow_branch. */
struct BranchOptions : pdn_branch_options {
    /** With its defaults. */
    BranchOptions()
        : pdn_branch_options(detail::initialised(pdn_branch_options_init))
    {
    }
    /** Grid, tolerance and linear solver, where the first solve starts, and who is told of the
     * iterations. Grids are equispaced. */
    PeriodicOptions periodic;
    /** What else is free along the branch, and as many conditions. */
    const Conditions *conditions = nullptr;
    /** Told of each point; may end the branch. */
    BranchProgress progress;
    /** As the library takes it, valid while this object stays as it is. */
    const pdn_branch_options *get([[maybe_unused]] std::size_t nodes = 0)
    {
        pdn_branch_options::periodic = periodic.get(nodes);
        pdn_branch_options::conditions = detail::in(conditions, "options.conditions");
        pdn_branch_options::progress = progress ? &detail::branch_fn<BranchProgress> : nullptr;
        pdn_branch_options::progress_data = &progress;
        return this;
    }
};

/** What equations_state gives. */
struct EquationsState {
    /** Node by node, at one grid point after the other, position (3, inertial frame \[length\]),
     * then rotation matrix (9, column by column). */
    std::vector<double> motions;
    /** Multipliers \[force or moment\] and internal states \[length or angle\], in the order of
     * vectors. */
    std::vector<double> own_unknowns;
};

/** What equations_compliance gives. */
struct EquationsCompliance {
    /** Zeros if constraints have no compliance. */
    std::vector<double> compliance;
    /** 1 if they have some, the same on all ranks, or 0. */
    bool compliant;
};

/** What equations_norms gives. */
struct EquationsNorms {
    /** Largest increment of a motion: displacements relative to the characteristic length, turns in
     * radians. */
    double motion;
    /** Largest increment of a multiplier or internal state, relative to the largest of their
     * values. */
    double own_unknown;
};

/** The equations of a periodic motion on a grid, or a rank's part of them. */
class Equations : public detail::Handle<pdn_equations, pdn_equations_free>
{
  public:
    using Handle::Handle;
    /** Makes the equations of a periodic motion on a grid, or a rank's part. */
    Equations(const Model &model, double period, EquationsOptions options) : Handle(nullptr, {})
    {
        pdn_equations *out = nullptr;
        detail::check(pdn_version_check(PDN_VERSION_MAJOR, PDN_VERSION_MINOR));
        const pdn_status status = pdn_equations_new(model.get(), period,
            options.get(static_cast<std::size_t>(model.node_count())), &out);
        *this = Equations(out, model.kept());
        detail::check(status);
    }
    /** Sizes of the equations, and of the vectors of this rank. */
    pdn_equations_sizes sizes() const
    {
        pdn_equations_sizes out = detail::initialised(pdn_equations_sizes_init);
        detail::check(pdn_equations_get_sizes(get(), &out));
        return out;
    }
    /** Nodes of this rank, in the order of its vectors. */
    std::vector<std::int32_t> nodes() const
    {
        const std::size_t count = sizes().nodes;
        std::vector<std::int32_t> out(count);
        detail::check(pdn_equations_nodes(get(), out.data(), count));
        return out;
    }
    /** Numbers of this rank's unknowns among those of all ranks: in the order that one rank alone
     * has them in, from 0. */
    std::vector<std::size_t> numbers() const
    {
        const std::size_t count = sizes().size;
        std::vector<std::size_t> out(count);
        detail::check(pdn_equations_numbers(get(), out.data(), count));
        return out;
    }
    /** The present motions of this rank's nodes, and own unknowns of its elements. */
    EquationsState state() const
    {
        const std::size_t motion_count = sizes().motions;
        const std::size_t own_count = sizes().own_unknowns;
        std::vector<double> motions(motion_count);
        std::vector<double> own_unknowns(own_count);
        detail::check(pdn_equations_state(get(), motions.data(), motion_count, own_unknowns.data(),
            own_count));
        return {std::move(motions), std::move(own_unknowns)};
    }
    /** Sets motions and own unknowns, as ::pdn_equations_state gives them. */
    void set_state(const std::vector<double> &motions, const std::vector<double> &own_unknowns)
    {
        const std::size_t motion_count = sizes().motions;
        const std::size_t own_count = sizes().own_unknowns;
        detail::check(pdn_equations_set_state(get(), detail::in(motions), motion_count,
            detail::in(own_unknowns), own_count));
    }
    /** The scaled residual at the present state. */
    std::vector<double> residual()
    {
        const std::size_t count = sizes().size;
        std::vector<double> out(count);
        detail::check(pdn_equations_residual(get(), out.data(), count));
        return out;
    }
    /** Linearises the equations at the present state, which ::pdn_equations_update then begins
     * at. */
    void linearise()
    {
        detail::check(pdn_equations_linearise(get()));
    }
    /** The product of the scaled Jacobian of the last linearisation and a vector. */
    std::vector<double> product(const std::vector<double> &x)
    {
        const std::size_t count = sizes().size;
        std::vector<double> out(count);
        detail::check(pdn_equations_product(get(), detail::in(x), out.data(), count));
        return out;
    }
    /** The product of the transposed scaled Jacobian and a vector. */
    std::vector<double> transposed_product(const std::vector<double> &x)
    {
        const std::size_t count = sizes().size;
        std::vector<double> out(count);
        detail::check(pdn_equations_transposed_product(get(), detail::in(x), out.data(), count));
        return out;
    }
    /** The product of a vector and what multiplies a power of mu in the scaled Jacobian for
     * disturbances exp(mu t) times increments of the period: J(mu) = J + mu J1 + mu^2 J2. */
    std::vector<double> power_product(std::int32_t power, const std::vector<double> &x)
    {
        const std::size_t count = sizes().size;
        std::vector<double> out(count);
        detail::check(pdn_equations_power_product(get(), power, detail::in(x), out.data(), count));
        return out;
    }
    /** Factors the preconditioner of the linearised equations. */
    bool factor(const std::vector<double> &right_side)
    {
        const std::size_t count = sizes().size;
        std::int32_t regular = 0;
        detail::check(pdn_equations_factor(get(), detail::in(right_side), count, &regular));
        return regular != 0;
    }
    /** The solution of the preconditioner's equations with a right side. */
    std::vector<double> precondition(const std::vector<double> &x)
    {
        const std::size_t count = sizes().size;
        std::vector<double> out(count);
        detail::check(pdn_equations_precondition(get(), detail::in(x), out.data(), count));
        return out;
    }
    /** What a scaled increment leaves of the constraints by their compliance in the Jacobian, where
     * some depend on others. */
    EquationsCompliance compliance(const std::vector<double> &increment)
    {
        const std::size_t count = sizes().size;
        std::vector<double> out(count);
        std::int32_t compliant = 0;
        detail::check(pdn_equations_compliance(get(), detail::in(increment), out.data(), count,
            &compliant));
        return {std::move(out), compliant != 0};
    }
    /** Moves the state that the equations were linearised at last by a fraction of a scaled
     * increment; the present state is then that. */
    void update(const std::vector<double> &increment, double step = 1.0)
    {
        const std::size_t count = sizes().size;
        detail::check(pdn_equations_update(get(), detail::in(increment), count, step));
    }
    /** Sizes of a scaled increment of all ranks, the same on all. */
    EquationsNorms norms(const std::vector<double> &increment) const
    {
        const std::size_t count = sizes().size;
        double motion = 0;
        double own_unknown = 0;
        detail::check(pdn_equations_norms(get(), detail::in(increment), count, &motion,
            &own_unknown));
        return {motion, own_unknown};
    }
    /** The present state of all ranks as a solution, for results, files, and what else solutions
     * are for. */
    std::optional<Solution> solution(Outcome outcome, std::int32_t root = -1) const
    {
        pdn_solution *out = nullptr;
        const pdn_status status = pdn_equations_solution(get(), root, detail::in(outcome), &out);
        Solution made(out, kept());
        detail::check(status);
        return made.get() ? std::optional<Solution>(std::move(made)) : std::nullopt;
    }
};

/** Options of ::pdn_solve_modes. */
struct ModesOptions : pdn_modes_options {
    /** With its defaults. */
    ModesOptions()
        : pdn_modes_options(detail::initialised(pdn_modes_options_init))
    {
    }
    /** The equilibrium, at rest or in steady rotation, how to find it, and who is told of the
     * iterations. */
    StaticOptions equilibrium;
    /** As the library takes it, valid while this object stays as it is. */
    const pdn_modes_options *get([[maybe_unused]] std::size_t nodes = 0)
    {
        pdn_modes_options::equilibrium = equilibrium.get(nodes);
        return this;
    }
};

/** Version of the library, such as "0.1.0". */
inline std::string version()
{
    return pdn_version();
}

/** How the library was built: version, profile and platform, for reports of defects. */
inline std::string build_info()
{
    return pdn_build_info();
}

/** Name of a status, such as "PDN_ERR_NULL". */
inline std::string status_name(pdn_status status)
{
    return pdn_status_name(status);
}

/** One-line meaning of a status. */
inline std::string status_message(pdn_status status)
{
    return pdn_status_message(status);
}

/** Sets the message that ::pdn_last_error gives on this thread: for libraries on top of this one,
 * whose own functions fail. */
inline void set_last_error(const std::string &message)
{
    detail::check(pdn_set_last_error(detail::in(message)));
}

/** What the last failing callback on this thread returned. */
inline std::int32_t last_callback_code()
{
    return pdn_last_callback_code();
}

/** Chooses whether internal errors are also printed to stderr. */
inline void set_panic_printing(bool enabled)
{
    pdn_set_panic_printing(detail::in(enabled));
}

/** Gives the system back the memory that the library keeps for later solves. */
inline void release_memory()
{
    detail::check(pdn_release_memory());
}

/** Finds the periodic response of a model directly, by Fourier spectral collocation. */
inline Solution solve_periodic(const Model &model, double period, PeriodicOptions options = {})
{
    pdn_solution *out = nullptr;
    const pdn_status status = pdn_solve_periodic(model.get(), period,
        options.get(static_cast<std::size_t>(model.node_count())), &out);
    Solution made(out, model.kept());
    detail::check(status);
    return made;
}

/** Finds a periodic response that meets conditions, and the values of as many free parameters. */
inline Solution solve_conditioned(const Model &model, double period, const Conditions &conditions,
    PeriodicOptions options = {})
{
    pdn_solution *out = nullptr;
    const pdn_status status = pdn_solve_conditioned(model.get(), period, conditions.get(),
        options.get(static_cast<std::size_t>(model.node_count())), &out);
    Solution made(out, model.kept());
    detail::check(status);
    return made;
}

/** Follows periodic motions along a parameter, through folds, from the response at its value in the
 * model. */
inline Branch follow_branch(const Model &model, double period, std::int32_t parameter,
    BranchOptions options)
{
    pdn_branch *out = nullptr;
    const pdn_status status = pdn_follow_branch(model.get(), period, parameter,
        options.get(static_cast<std::size_t>(model.node_count())), &out);
    Branch made(out, model.kept());
    detail::check(status);
    return made;
}

/** Finds the response over a range of frequencies, through folds: ::pdn_follow_branch along
 * PDN_FREQUENCY. */
inline Branch solve_frequency_response(const Model &model, double first, double last,
    BranchOptions options = {})
{
    pdn_branch *out = nullptr;
    const pdn_status status = pdn_solve_frequency_response(model.get(), first, last,
        options.get(static_cast<std::size_t>(model.node_count())), &out);
    Branch made(out, model.kept());
    detail::check(status);
    return made;
}

/** Follows the other branch at a point where one begins: a branch point, or a period doubling, from
 * where motions have twice the period, on one grid point less than twice as many. */
inline Branch switch_branch(const Branch &branch, std::int32_t point, double amplitude,
    BranchOptions options)
{
    pdn_branch *out = nullptr;
    const pdn_status status = pdn_switch_branch(branch.get(), point, amplitude, options.get(),
        &out);
    Branch made(out, branch.kept());
    detail::check(status);
    return made;
}

/** Follows folds, period doublings or torus points along a second parameter, from one of them on a
 * branch: that of the branch is free beside it. */
inline Branch follow_locus(const Branch &branch, std::int32_t point, std::int32_t parameter,
    BranchOptions options)
{
    pdn_branch *out = nullptr;
    const pdn_status status = pdn_follow_locus(branch.get(), point, parameter, options.get(), &out);
    Branch made(out, branch.kept());
    detail::check(status);
    return made;
}

/** Follows a branch on from its last point, in the direction in which it came there: with a wider
 * range, more points, a shorter smallest step. */
inline Branch continue_branch(const Branch &branch, BranchOptions options)
{
    pdn_branch *out = nullptr;
    const pdn_status status = pdn_continue_branch(branch.get(), options.get(), &out);
    Branch made(out, branch.kept());
    detail::check(status);
    return made;
}

/** Finds an equilibrium at one time: of forces at rest, or in steady rotation. */
inline Solution solve_static(const Model &model, StaticOptions options = {})
{
    pdn_solution *out = nullptr;
    const pdn_status status = pdn_solve_static(model.get(),
        options.get(static_cast<std::size_t>(model.node_count())), &out);
    Solution made(out, model.kept());
    detail::check(status);
    return made;
}

/** Finds an equilibrium and the modes of small motions `Re(x exp(s t))` about it. */
inline Modes solve_modes(const Model &model, ModesOptions options = {})
{
    pdn_modes *out = nullptr;
    const pdn_status status = pdn_solve_modes(model.get(),
        options.get(static_cast<std::size_t>(model.node_count())), &out);
    Modes made(out, model.kept());
    detail::check(status);
    return made;
}

/** Marches a model in time, for a given duration or until its motion repeats itself. */
inline Solution solve_march(const Model &model, MarchOptions options)
{
    pdn_solution *out = nullptr;
    const pdn_status status = pdn_solve_march(model.get(),
        options.get(static_cast<std::size_t>(model.node_count())), &out);
    Solution made(out, model.kept());
    detail::check(status);
    return made;
}

/** Finds the periodic response of a model by shooting: Newton's method on the period map of
 * ::pdn_solve_march. */
inline Solution solve_shooting(const Model &model, double period, ShootingOptions options = {})
{
    pdn_solution *out = nullptr;
    const pdn_status status = pdn_solve_shooting(model.get(), period,
        options.get(static_cast<std::size_t>(model.node_count())), &out);
    Solution made(out, model.kept());
    detail::check(status);
    return made;
}

/** Finds the Floquet multipliers of a periodic solution: what small disturbances are multiplied by
 * in a period. */
inline Stability solve_stability(const Solution &solution, StabilityOptions options = {})
{
    pdn_stability *out = nullptr;
    const pdn_status status = pdn_solve_stability(solution.get(), options.get(), &out);
    Stability made(out, solution.kept());
    detail::check(status);
    return made;
}

/** What motion_interpolate gives. */
struct MotionInterpolate {
    /** Position. */
    Series<3> position;
    /** Each matrix column by column. */
    Series<9> rotation;
    /** Linear and angular velocity along the moving axes. */
    Series<6> velocity;
    /** Time derivative of velocity. */
    Series<6> acceleration;
};

/** Interpolates a periodic motion given at N equispaced times, by dual polar decomposition. */
inline MotionInterpolate motion_interpolate(double period, const Series<3> &positions,
    const Series<9> &rotations, const std::vector<double> &times)
{
    const std::size_t points = detail::common({{"positions", positions.size()},
        {"rotations", rotations.size()}}, false);
    const std::size_t count = times.size();
    Series<3> position(count);
    Series<9> rotation(count);
    Series<6> velocity(count);
    Series<6> acceleration(count);
    detail::check(pdn_motion_interpolate(period, detail::in(positions), detail::in(rotations),
        points, detail::in(times), count, detail::flat(position), detail::flat(rotation),
        detail::flat(velocity), detail::flat(acceleration)));
    return {std::move(position), std::move(rotation), std::move(velocity), std::move(acceleration)};
}

/** What motion_grid_kinematics gives. */
struct MotionGridKinematics {
    /** Linear and angular velocity along the moving axes. */
    Series<6> velocity;
    /** Time derivative of velocity. */
    Series<6> acceleration;
    /** Derivatives of velocity by u, column by column. */
    std::vector<double> velocity_tangent;
    /** Derivatives of acceleration by u, column by column. */
    std::vector<double> acceleration_tangent;
};

/** Velocities and accelerations of a motion at its own grid points, and their exact
 * linearisation. */
inline MotionGridKinematics motion_grid_kinematics(double period, const Series<3> &positions,
    const Series<9> &rotations)
{
    const std::size_t points = detail::common({{"positions", positions.size()},
        {"rotations", rotations.size()}}, false);
    Series<6> velocity(points);
    Series<6> acceleration(points);
    std::vector<double> velocity_tangent(6 *points *6 *points);
    std::vector<double> acceleration_tangent(6 *points *6 *points);
    detail::check(pdn_motion_grid_kinematics(period, detail::in(positions), detail::in(rotations),
        points, detail::flat(velocity), detail::flat(acceleration), velocity_tangent.data(),
        acceleration_tangent.data()));
    return {std::move(velocity), std::move(acceleration), std::move(velocity_tangent),
        std::move(acceleration_tangent)};
}

/** A frame from a point and two directions, such as that of a joint or a bushing. */
inline pdn_frame joint_frame(const Vector3 &point, const Vector3 &axis_3, const Vector3 &axis_1)
{
    pdn_frame frame{};
    detail::check(pdn_joint_frame(detail::in(point), detail::in(axis_3), detail::in(axis_1),
        &frame));
    return frame;
}
// END

} // namespace periodyn

#if defined(PERIODYN_EIGEN)
#include <Eigen/Core>
#endif
#if defined(EIGEN_WORLD_VERSION)
namespace periodyn
{

/** The entries of a small matrix or vector, column by column: what functions above take. */
template <class Derived>
std::array<double, Derived::RowsAtCompileTime * Derived::ColsAtCompileTime>
array(const Eigen::MatrixBase<Derived> &matrix)
{
    constexpr int rows = Derived::RowsAtCompileTime, columns = Derived::ColsAtCompileTime;
    std::array<double, rows * columns> out;
    Eigen::Map<Eigen::Matrix<double, rows, columns>>(out.data()) = matrix;
    return out;
}

/** A series as a matrix with one column for each time. */
template <std::size_t C>
Eigen::Map<const Eigen::Matrix<double, C, Eigen::Dynamic>> view(const Series<C> &series)
{
    return {detail::flat(series), static_cast<Eigen::Index>(C),
            static_cast<Eigen::Index>(series.size())};
}

/** Numbers as a vector. */
inline Eigen::Map<const Eigen::VectorXd> view(const std::vector<double> &numbers)
{
    return {numbers.data(), static_cast<Eigen::Index>(numbers.size())};
}

/** A rotation matrix, or other 3 x 3 matrix. */
inline Eigen::Map<const Eigen::Matrix3d> view(const Matrix3 &matrix)
{
    return Eigen::Map<const Eigen::Matrix3d>(matrix.data());
}

} // namespace periodyn
#endif

#endif // PERIODYN_HPP
