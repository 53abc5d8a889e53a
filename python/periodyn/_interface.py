"""The functions, structs and constants of periodyn.h as classes and methods.

Written by script/python_interface; do not edit it.
"""

from . import _callbacks
from ._abi import ffi
from ._call import LIBRARY as lib
from ._call import call, text
from ._extras import (
    BranchExtras,
    Handle,
    ModelExtras,
    ModesExtras,
    SolutionExtras,
    StabilityExtras,
    TableExtras
)
from ._numbers import ids, like, reals, together, whole
from ._structs import (
    Array, Number, Reference, Struct, Structs, as_signal, as_signals, as_structs, of_type,
    pointer, points_of
)

VERSION_MAJOR = 0
"""Version of this header, first number."""
VERSION_MINOR = 1
"""Version of this header, second number."""
VERSION_PATCH = 0
"""Version of this header, third number."""
OK = 0
"""The call did what it says."""
ERR_NULL = -1
"""A pointer that must not be None is None."""
ERR_NOT_FINITE = -2
"""A number is NaN or infinite."""
ERR_SIZE = -3
"""A length or count is not allowed."""
ERR_ID = -4
"""An id names nothing in this model."""
ERR_VALUE = -5
"""A value is not allowed."""
ERR_STRUCT_SIZE = -6
"""A struct was not initialised, or was made for another library."""
ERR_NOT_AVAILABLE = -7
"""The quantity does not exist for this object."""
ERR_MODEL = -100
"""The model cannot be solved as it stands."""
ERR_NOT_PERIODIC = -101
"""A prescribed motion or load does not repeat after one period."""
ERR_GRID_TOO_COARSE = -200
"""The grid is too coarse to interpolate this motion."""
ERR_CALLBACK = -201
"""A callback failed or returned a number that is not finite."""
ERR_OVERFLOW = -202
"""A result is too large to be a number."""
ERR_IO = -300
"""A file could not be read or written."""
ERR_FORMAT = -301
"""A file is damaged, or not of the format or version expected."""
ERR_MEMORY = -900
"""Out of memory."""
ERR_PANIC = -901
"""Internal error, a defect of the library."""
ERR_POISONED = -902
"""An internal error left this handle in an unknown state."""
SIGNAL_HARMONICS = 1200
"""Kind of a signal: mean, rate and harmonics. Also what a constant is."""
SIGNAL_SAMPLES = 1201
"""Kind of a signal: rate and samples over one period."""
SIGNAL_FUNCTION = 1202
"""Kind of a signal: a function of the caller."""
SIGNAL_FUNCTION_OF_PHASE = 1203
"""Kind of a signal: a function of the caller, of the phase."""
FIRST_NODE = 100000000
"""Id of the node that was added first, or of the rigid body, which is one. Those of the others of
a kind follow, in the order in which they were added: the node that messages and reports call
node 3 is FIRST_NODE + 3. A kind has 100 million at most.
"""
FIRST_JOINT = 200000000
"""Id of the joint that was added first."""
FIRST_BEAM_ELEMENT = 300000000
"""Id of the beam element that was added first."""
FIRST_SHELL_ELEMENT = 400000000
"""Id of the shell element that was added first."""
FIRST_FORCE = 500000000
"""Id of the force that was added first, which is no load."""
FIRST_RELATION = 600000000
"""Id of the linear relation between joint coordinates that was added first."""
FIRST_PARAMETER = 700000000
"""Id of the parameter that was added first."""
FIRST_LOAD = 800000000
"""Id of the load on a node, or at a point, that was added first."""
FIRST_BEAM_LOAD = 900000000
"""Id of the load along beam elements that was added first."""
FIRST_SHELL_LOAD = 1000000000
"""Id of the load on shell elements that was added first."""
FIRST_INERTIA = 1100000000
"""Id of the inertia that was added first: that of a rigid body, or a mass or inertia on a node.
"""
FIRST_PRESCRIBED = 1200000000
"""Id of the coordinate that was prescribed first."""
GROUND = -1
"""In place of a node's id: the ground, which does not move."""
JOINT_RIGID = 1300
"""Joint that allows no relative motion."""
JOINT_REVOLUTE = 1301
"""Joint that allows a rotation about axis 3 of its frames."""
JOINT_UNIVERSAL = 1302
"""Joint that allows a rotation about axis 1 of its first frame, then about axis 2 of its second.
"""
JOINT_SPHERICAL = 1303
"""Joint that allows all rotations."""
JOINT_PRISMATIC = 1304
"""Joint that allows a displacement along axis 3 of its frames."""
JOINT_CYLINDRICAL = 1305
"""Joint that allows a displacement along axis 3 of its frames and a rotation about it."""
JOINT_PLANAR = 1306
"""Joint that allows displacements along axes 1 and 2 of its first frame and a rotation about axis
3.
"""
JOINT_FREE = 1307
"""Joint that allows everything: it carries springs, prescribed coordinates and measures."""
JOINT_SCREW = 1308
"""Joint that allows a displacement along axis 3 of its frames, in proportion to the rotation about
it; made by functions of its own, for its pitch.
"""
JOINT_STRUT = 1309
"""The line between two points, which constrains nothing; made by Model.add_strut."""
DISPLACEMENT = 1400
"""Joint coordinate: the displacement, or the first of several."""
DISPLACEMENT_2 = 1401
"""Joint coordinate: second displacement of a planar or free joint."""
DISPLACEMENT_3 = 1402
"""Joint coordinate: third displacement of a free joint."""
ROTATION = 1403
"""Joint coordinate: the angle, or the first of several."""
ROTATION_2 = 1404
"""Joint coordinate: second angle of a universal, spherical or free joint."""
ROTATION_3 = 1405
"""Joint coordinate: third angle of a spherical or free joint."""
LINE_STRAIGHT = 1500
"""Kind of a line: straight."""
LINE_ARC = 1501
"""Kind of a line: circular arc."""
LINE_CURVE = 1502
"""Kind of a line: a curve that the caller computes."""
FRAME_SPACE = 1600
"""Directions of a load, or axes of a velocity, force or reaction: the global axes."""
FRAME_MATERIAL = 1601
"""The same: the axes of the node, which a load follows."""
FRAME_UNTWISTED = 1602
"""Directions of a load along a beam: the axes that its sections have without twist, which follow
the sections.
"""
FORCE_1 = 1700
"""Component of a load: force along axis 1."""
FORCE_2 = 1701
"""Component of a load: force along axis 2."""
FORCE_3 = 1702
"""Component of a load: force along axis 3."""
MOMENT_1 = 1703
"""Component of a load: moment about axis 1."""
MOMENT_2 = 1704
"""Component of a load: moment about axis 2."""
MOMENT_3 = 1705
"""Component of a load: moment about axis 3."""
SURFACE_PARALLELOGRAM = 1800
"""Kind of a surface: parallelogram."""
SURFACE_ANNULUS = 1801
"""Kind of a surface: sector of an annulus."""
SURFACE_CYLINDER = 1802
"""Kind of a surface: cylinder."""
SURFACE_FUNCTION = 1803
"""Kind of a surface: one that the caller computes."""
SHELL_NORMALS = 1900
"""Frames of a shell: along the normals of its surface at the nodes."""
SHELL_PARALLEL = 1901
"""Frames of a shell: parallel at all nodes of an element. Somewhat better on curved elements of
three and more nodes a side; thin warped elements of two nodes a side lock.
"""
SHELL_NODE_AXES = 1902
"""Frames of a shell: along the third axes of the nodes' own frames, as normals of a surface that
is known better than its elements show it; of use with two nodes a side.
"""
SHELL_NODE_FRAMES = 1903
"""Frames of a shell: those of the nodes themselves, with their third axes for normals, if they are
known from elsewhere. Those of an element should turn from node to node no more than it does.
"""
SHELL_EDGE_START_ETA = 2000
"""Place of a load on a shell element: its edge where eta = -1, along xi."""
SHELL_EDGE_END_XI = 2001
"""Place of a load on a shell element: its edge where xi = 1, along eta."""
SHELL_EDGE_END_ETA = 2002
"""Place of a load on a shell element: its edge where eta = 1, along xi."""
SHELL_EDGE_START_XI = 2003
"""Place of a load on a shell element: its edge where xi = -1, along eta."""
SHELL_SURFACE = 2004
"""Place of a load on a shell element: its surface."""
ANGLES_ROTATION_VECTOR = 2100
"""A bushing measures rotations by the rotation vector; its angle stays below half a turn."""
ANGLES_TILT_AND_SPIN = 2101
"""A bushing measures the tilt of axis 3, as a rotation vector about axes 1 and 2, and the rate of
the spin about axis 3, which may go on and on: for journal bearings and seals.
"""
TANGENTS_DIFFERENCED = 2200
"""Tangents of a user's function: it gives none, and the library finds them by differences of its
forces.
"""
TANGENTS_GIVEN = 2201
"""Tangents of a user's function: it gives them."""
TANGENT_MOTION = 2300
"""Which tangent: derivative by a motion or coordinate."""
TANGENT_VELOCITY = 2301
"""Which tangent: derivative by a velocity or rate."""
OBJECT_NODE = 1000
"""What has a label: a node, or a rigid body, which is one."""
OBJECT_JOINT = 1001
"""What has a label: a joint."""
OBJECT_BEAM_ELEMENT = 1002
"""What has a label: a beam element."""
OBJECT_SHELL_ELEMENT = 1003
"""What has a label: a shell element."""
OBJECT_FORCE = 1004
"""What has a label: a force, but not a load."""
OBJECT_RELATION = 1005
"""What has a label: a linear relation between joint coordinates."""
OBJECT_LOAD = 1006
"""What has a label: a load on a node or at a point."""
OBJECT_BEAM_LOAD = 1007
"""What has a label: a load along beam elements."""
OBJECT_SHELL_LOAD = 1008
"""What has a label: a load on shell elements."""
OBJECT_INERTIA = 1009
"""What has a label: the inertia of a rigid body, or a mass or inertia on a node."""
OBJECT_PRESCRIBED = 1010
"""What has a label: a prescribed coordinate."""
LABEL_LENGTH = 200
"""Bytes of a label at most, without the NUL."""
CONVERGED = 2400
"""Outcome: converged. With TOLERANCE_NOT_MET the only outcomes that are solutions."""
ITERATION_LIMIT = 2401
"""Outcome: the iteration limit was reached."""
STALLED = 2402
"""Outcome: no step along the Newton direction brings progress."""
SINGULAR = 2403
"""Outcome: the Jacobian is singular; something is free to move, or in resonance without damping.
"""
CANCELLED = 2404
"""Outcome: the progress callback cancelled the solve."""
NO_INITIAL_GUESS = 2405
"""Outcome: no initial guess could be found."""
INCONSISTENT = 2406
"""Outcome: constraints that depend on each other contradict each other; the mechanism is locked,
or cannot close.
"""
WRONG_ASSEMBLY = 2407
"""Outcome: a joint has closed turned over, its axes against each other; the report names it."""
TOLERANCE_NOT_MET = 2408
"""Outcome: converged on the last grid tried, but the estimated error misses the tolerance, as the
report explains; quantities are as good as Diagnostics.error_estimate says.
"""
WORK_LIMIT = 2409
"""Outcome: all work was done that PeriodicOptions.work_limit allows, and the report tells what was
tried; or as many steps of a march are kept as MarchOptions.memory_limit allows.
"""
DECAY_UNKNOWN = 2500
"""Decay of harmonics: not known, as there are too few or the solve has not converged."""
DECAY_FAST = 2501
"""Decay of harmonics: fast, as of a smooth response that the grid resolves."""
DECAY_SLOW = 2502
"""Decay of harmonics: no faster than the fourth power of their number. The response has a kink, or
a peak too narrow for the grid; forces may oscillate about their values.
"""
DECAY_ROUNDING = 2503
"""Decay of harmonics: they have fallen to rounding; a finer grid gains nothing."""
FRAME_FIRST = 1603
"""Axes of a joint reaction: the joint frame on the first body."""
FRAME_SECOND = 1604
"""Axes of a joint reaction: the joint frame on the second body."""
NODE_POSITION = 100
"""Kind of quantity: position of a node; 3 components [length]."""
NODE_ROTATION = 101
"""Kind of quantity: rotation matrix of a node, column by column; 9 components."""
NODE_QUATERNION = 102
"""Kind of quantity: unit quaternion (w, x, y, z) of a node, of continuous sign; 4 components."""
NODE_VELOCITY = 103
"""Kind of quantity: velocity and angular velocity of a node, in a frame; 6 components."""
NODE_ACCELERATION = 104
"""Kind of quantity: acceleration and angular acceleration of a node, in a frame; 6 components."""
JOINT_COORDINATE = 200
"""Kind of quantity: a coordinate of a joint, angles followed through whole turns."""
JOINT_RATE = 201
"""Kind of quantity: rate of a coordinate of a joint."""
JOINT_ACCELERATION = 202
"""Kind of quantity: second derivative in time of a coordinate of a joint."""
JOINT_DRIVING_EFFORT = 203
"""Kind of quantity: force or torque that drives a prescribed coordinate of a joint."""
JOINT_REACTION = 204
"""Kind of quantity: force and moment of a joint on its second body, along axes; 6 components."""
BEAM_STRAIN = 300
"""Kind of quantity: strains and curvatures of a beam element; 6 components."""
BEAM_FORCE = 301
"""Kind of quantity: internal forces and moments of a beam element; 6 components."""
BEAM_FORCE_MEAN = 302
"""Kind of quantity: the same, at a node between two elements the mean of those of both."""
BEAM_FORCE_JUMP = 303
"""Kind of quantity: at a node between two elements, internal forces of the one beyond it less
those of the one before it; zero elsewhere; 6 components.
"""
FORCE_EFFORT = 400
"""Kind of quantity: effort of a force on its joint coordinate."""
FORCE_BRANCH_EFFORT = 401
"""Kind of quantity: effort of a branch of a viscoelastic element."""
FORCE_BRANCH_ELONGATION = 402
"""Kind of quantity: elongation of the dashpot of a branch of a viscoelastic element."""
FORCE_ON_NODE = 403
"""Kind of quantity: what a force exerts on one of its nodes, in a frame: force and moment; 6
components.
"""
FORCE_BUSHING_EFFORTS = 404
"""Kind of quantity: the efforts of a bushing against its deformation, forces along the axes of its
first frame and moments; 6 components.
"""
FORCE_CONTROL_EFFORT = 405
"""Kind of quantity: effort of a controller on one of the coordinates that it acts on, towards
growth.
"""
FORCE_CONTROL_STATE = 406
"""Kind of quantity: a state of a controller."""
SHELL_STRAIN = 500
"""Kind of quantity: strains of a shell element, in the order of ShellSection; 12 components."""
SHELL_RESULTANT = 501
"""Kind of quantity: forces and moments of a shell element per unit of reference length, in the
same order: N11 N12 Q1 M11 M12 M1n, N21 N22 Q2 M21 M22 M2n; 12 components.
"""
SHELL_STRESS_TOP = 502
"""Kind of quantity: stresses 11, 22, 12 at the surface of an isotropic shell that its normal
points out of, and von Mises' stress of these [force / length^2]; 4 components.
"""
SHELL_STRESS_BOTTOM = 503
"""Kind of quantity: the same at the other surface; 4 components."""
RELATION_EFFORT = 600
"""Kind of quantity: effort of a linear relation on one of its joint coordinates, towards growth.
"""
ALL_COMPONENTS = -2
"""All components of a quantity."""
FILTER_LANCZOS = 3100
"""Spectral filter: Lanczos' factors, (sin(x) / x)^order with x = pi j / (H + 1) for harmonic j of
H. Of order 1 they are running means over two grid intervals; order 2 or 3 removes more.
"""
FILTER_EXPONENTIAL = 3101
"""Spectral filter: exp(-36 (j / (H + 1))^order) for harmonic j of H. Order 2 smooths most; a high
order, as 8, spares all but the highest harmonics.
"""
STAGE_INITIAL_GUESS = 3200
"""Stage of a solve: finding the initial guess, each iteration at a single instant."""
STAGE_NEWTON = 3201
"""Stage of a solve: Newton iterations of the periodic problem."""
STAGE_MARCH = 3202
"""Stage of a march: a step, with the last of its iterations."""
STAGE_MODES = 3203
"""Stage of a modal analysis: looking for modes about the equilibrium."""
STAGE_STABILITY = 3204
"""Following disturbances of a periodic solution."""
START_AUTOMATIC = 3300
"""Start of a periodic solve: the library tries those that suit, cheapest first."""
START_QUASI_STATIC = 3301
"""Start of a periodic solve: equilibrium at each time, without velocities."""
START_STEADY_ROTATION = 3302
"""Start of a periodic solve: equilibrium at each time of what turns steadily with its drives, with
its centrifugal and gyroscopic forces.
"""
START_RIGID_ROTATION = 3303
"""Start of a periodic solve: all that hangs on drives turned with them, undeformed."""
START_RAISED_INERTIA = 3304
"""Start of a periodic solve: the quasi-static motion, and inertial forces raised in steps."""
START_MARCH = 3305
"""Start of a periodic solve: a march in time with strong numerical dissipation."""
START_LOWERED_DAMPING = 3306
"""Start of a periodic solve: the quasi-static motion, and added damping taken away in steps."""
START_RAISED_LOADS = 3307
"""Start of a periodic solve: the reference configuration, and loads and prescribed motions raised
in steps; not where these gain whole turns in a period.
"""
TIME_MAP_AUTOMATIC = 3400
"""Grid points are equispaced, but closer together where a solve to a tolerance finds the motion
sharp.
"""
TIME_MAP_EQUISPACED = 3401
"""Grid points are equispaced."""
TIME_MAP_EVENTS = 3402
"""Grid points are closer together about events that are given."""
LINEAR_AUTOMATIC = 3500
"""Linear equations: solved directly where that is quick, by iteration otherwise."""
LINEAR_DIRECT = 3501
"""Linear equations: solved by factors of the whole Jacobian. Time grows with the third power of
the number of grid points, memory with the second.
"""
LINEAR_ITERATIVE = 3502
"""Linear equations: solved by iteration, with the preconditioner that suits; time and memory grow
in proportion to nodes and grid points, or little more.
"""
LINEAR_BODY_CIRCULANT = 3503
"""Linear equations: solved by iteration; bodies are averaged over time for the preconditioner,
joints are not.
"""
LINEAR_TIME_LOCAL = 3504
"""Linear equations: solved by iteration; the preconditioner is equilibrium at each grid point,
without inertia.
"""
LINEAR_CIRCULANT = 3505
"""Linear equations: solved by iteration; everything is averaged over time for the preconditioner.
"""
NUMBER_STIFFNESS = 3600
"""A parameter moves the coefficient of a power, from 1, of the growth of a spring-damper, or with
power 1 the long-term stiffness of a viscoelastic force or a factor of the stiffness of a
bushing.
"""
NUMBER_DAMPING = 3601
"""A parameter moves the coefficient of a power, from 1, of the rate of a spring-damper, or with
power 1 a factor of the damping of a bushing.
"""
NUMBER_REST = 3602
"""A parameter moves the coordinate at which a spring-damper or viscoelastic force is free of
effort.
"""
NUMBER_INERTIA = 3603
"""A parameter moves a factor of an inertia: that of a rigid body, or a mass or inertia on a node.
"""
NUMBER_BEAM_STIFFNESS = 3604
"""A parameter moves a factor of the sections' stiffness along a beam element."""
NUMBER_BEAM_MASS = 3605
"""A parameter moves a factor of the sections' mass along a beam element."""
NUMBER_BEAM_DAMPING = 3606
"""A parameter moves a factor of the sections' damping along a beam element."""
NUMBER_MASS_DAMPING = 3607
"""A parameter moves the damping in proportion to mass, Model.set_mass_damping."""
NUMBER_SHELL_STIFFNESS = 3609
"""A parameter moves a factor of the stiffness of a shell element."""
NUMBER_SHELL_MASS = 3610
"""A parameter moves a factor of the mass of a shell element."""
NUMBER_SHELL_DAMPING = 3611
"""A parameter moves a factor of the damping of a shell element."""
NUMBER_SHELL_THICKNESS = 3612
"""A parameter moves a factor of the thickness of a shell element, more than zero, all its layers
alike: stiffness, damping and mass against stretching grow with it, against bending and turning
with its cube, what couples them with its square.
"""
NUMBER_FRAME_RATE = 3613
"""A parameter moves the rate of the frame that everything is described in,
Model.set_turning_frame.
"""
NUMBER_SPIN = 3614
"""A parameter moves the rate at which an inertia spins, Model.set_spin."""
NUMBER_BEAM_SPIN = 3615
"""A parameter moves the rate at which the material of a beam element spins, Model.set_beam_spin.
"""
NUMBER_FRAME_ADVANCE = 3616
"""A parameter moves the speed of the frame that everything is described in along its axis,
Model.set_frame_advance.
"""
PART_MEAN = 3800
"""Part of a signal: the mean that is added to its shape."""
PART_RATE = 3801
"""Part of a signal: growth in a unit of time."""
PART_AMPLITUDE = 3802
"""Part of a signal: the factor of its shape, which is its harmonics, its samples or its function.
"""
PART_PHASE = 3803
"""Part of a signal: the phase by which its shape is ahead [radians]."""
FREQUENCY = -3
"""A parameter: the circular frequency 2 pi / T, which every model has."""
GRAVITY = -4
"""In place of an id: gravity, whose components have signals."""
FORCE_IS_SPRING_DAMPER = 1100
"""Kind of force: springs and dampers on a joint coordinate."""
FORCE_IS_ACTUATOR = 1101
"""Kind of force: an actuator on a joint coordinate."""
FORCE_IS_COORDINATE_LAW = 1102
"""Kind of force: a law of the user on a joint coordinate."""
FORCE_IS_VISCOELASTIC = 1103
"""Kind of force: a viscoelastic element on a joint coordinate."""
FORCE_IS_VISCOUS_DAMPER = 1104
"""Kind of force: a viscous damper between two bodies."""
FORCE_IS_BUSHING = 1105
"""Kind of force: a bushing between two frames."""
FORCE_IS_USER_FORCE = 1106
"""Kind of force: forces of the user on nodes."""
FORCE_IS_CONTROLLER = 1107
"""Kind of force: a controller."""
FORCE_IS_SURFACE_FORCE = 1108
"""Kind of force: forces of the user on a shell element."""
FORCE_IS_LINE_FORCE = 1109
"""Kind of force: forces of the user along a beam element."""
NUMBER_RELAXATION_TIME = 3608
"""Numbers of a force: relaxation times of the branches of a viscoelastic element. Parameters do
not move them.
"""
FEATURE_MEAN = 2900
"""Feature of a quantity: its mean over the period, without what it gains."""
FEATURE_COSINE = 2901
"""Feature of a quantity: coefficient of the cosine of a harmonic."""
FEATURE_SINE = 2902
"""Feature of a quantity: coefficient of the sine of a harmonic."""
FEATURE_VALUE = 2903
"""Feature of a quantity: value at a time, of the trigonometric polynomial through the values at
the grid points.
"""
FEATURE_LARGEST = 2904
"""Feature of a quantity, for sensitivities: its largest value over the period."""
FEATURE_SMALLEST = 2905
"""Feature of a quantity, for sensitivities: its smallest value over the period."""
SENSITIVITY_AUTOMATIC = 3900
"""Sensitivities: with as few linear solves as can be, directly or adjoint."""
SENSITIVITY_DIRECT = 3901
"""Sensitivities: a linear solve for each parameter."""
SENSITIVITY_ADJOINT = 3902
"""Sensitivities: a transposed linear solve for each dependent, by factors of the whole Jacobian.
"""
BRANCH_RANGE = 4000
"""A branch ended at an end of the parameter's range."""
BRANCH_CLOSED = 4001
"""A branch ended as it came back to its first point."""
BRANCH_POINT_LIMIT = 4002
"""A branch ended as it has as many points as are allowed."""
BRANCH_SMALLEST_STEP = 4003
"""A branch ended where the shortest step leads to no solution."""
BRANCH_CANCELLED = 4004
"""A branch ended as it was cancelled."""
BRANCH_NO_START = 4005
"""A branch has no points, as there is no solution to start from."""
BRANCH_FAILED = 4006
"""A branch ended with an error, such as that of a callback, which its report tells."""
EVENT_NONE = 4100
"""Nothing happens at a point of a branch."""
EVENT_FOLD = 4101
"""The parameter turns back at a point of a branch: a fold."""
EVENT_BRANCH_POINT = 4102
"""Another branch passes through a point of a branch."""
EVENT_PERIOD_DOUBLING = 4103
"""A branch of twice the period begins at a point of a branch."""
EVENT_TORUS = 4104
"""A pair of complex multipliers is on the unit circle at a point of a branch: motions with a
second frequency begin there.
"""
STABILITY_NOT_KNOWN = 4200
"""Verdict on stability: it cannot be told, as multipliers are on the unit circle or not known well
enough.
"""
STABLE = 4201
"""Verdict on stability: disturbances die away, but for those that only move the solution in time
or space.
"""
UNSTABLE = 4202
"""Verdict on stability: a disturbance grows."""

OUTCOMES = {
    2400: "CONVERGED",
    2401: "ITERATION_LIMIT",
    2402: "STALLED",
    2403: "SINGULAR",
    2404: "CANCELLED",
    2405: "NO_INITIAL_GUESS",
    2406: "INCONSISTENT",
    2407: "WRONG_ASSEMBLY",
    2408: "TOLERANCE_NOT_MET",
    2409: "WORK_LIMIT",
}
"""Names of the outcomes of a solve."""


class Section(Struct):
    """Cross-section of a beam, per unit of length.

    The matrices are 6 x 6, column-major, symmetric (damping need not be), and resolved in the
    axes of the section: axis 1 is along the beam. Rows and columns are in the order force 1, 2,
    3, moment 1, 2, 3, which is axial, shear 2, shear 3, torsion, bending about axis 2, bending
    about axis 3. Any consistent set of units.

    Start with `Section()`; then Section.set_diagonal, or write the matrices yourself. A section
    without stiffness is refused where it is used.
    """

    _type = "pdn_section"
    _initialise = lib.pdn_section_init
    stiffness = Array("stiffness", (6, 6))
    """Forces and moments for unit strains and curvatures; positive definite."""
    mass = Array("mass", (6, 6))
    """Momenta for unit velocities; positive semi-definite."""
    damping = Array("damping", (6, 6))
    """Forces and moments for unit rates of strain and curvature. It may be unsymmetric, as a
    diagonal matrix of times times the stiffness is for coupled sections; its symmetric part is
    positive semi-definite, so that no motion gains energy.
    """

    def set_diagonal(self, stiffness, mass):
        """Describes a section without couplings: centroid, shear centre and centre of mass lie on
        the beam's line, and axes 2 and 3 are principal.

        Sets stiffness and mass, and takes the damping away: give that afterwards.

        Args:
            stiffness: array of shape (6): all positive: axial EA, shear 2, shear 3 [force],
                torsion, bending about axis 2, bending about axis 3 [force * length^2]
            mass: array of shape (4): none negative: mass [mass / length], and moments of
                inertia m11 (about the beam's axis), m22, m33 [mass * length], all per unit of
                length
        """
        stiffness = reals("stiffness", stiffness, (6,))
        mass = reals("mass", mass, (4,))
        call(lib.pdn_section_set_diagonal, self._c, pointer(stiffness), pointer(mass))
        self._kept.append((stiffness, mass))
        return self

    def set_component_damping(self, seconds):
        """Gives a section damping with one time for each force and moment: damping = diag(seconds)
        * stiffness, which must have been set.

        For coupled sections that is no symmetric matrix. It is taken if no motion gains energy
        by it: if its symmetric part is positive semi-definite.

        Args:
            seconds: array of shape (6): times of axial force, shear 2, shear 3, torsion,
                bending 2, bending 3; none negative [time]
        """
        seconds = reals("seconds", seconds, (6,))
        call(lib.pdn_section_set_component_damping, self._c, pointer(seconds))
        self._kept.append((seconds,))
        return self

    def set_proportional_damping(self, seconds):
        """Gives a section damping in proportion to its stiffness, which must have been set.

        A vibration of circular frequency w then has the damping ratio seconds * w / 2.

        Args:
            seconds: damping = seconds * stiffness; zero or more [time]
        """
        call(lib.pdn_section_set_proportional_damping, self._c, seconds)
        return self


class Signal(Struct):
    """A scalar function of time: a load's component or a prescribed coordinate.

    Start with `Signal()`, which makes it zero; then one of the `set_...`, each of which
    replaces all that was set before. Leave the fields to them.

    The signal only points to the caller's arrays: they must be there until the signal has been
    given to the model, which copies them. It can be given any number of times.
    """

    _type = "pdn_signal"
    _initialise = lib.pdn_signal_init

    def set_constant(self, value):
        """Makes a signal constant.

        Args:
            value: its value, in the unit of what it drives
        """
        call(lib.pdn_signal_set_constant, self._c, value)
        return self

    def set_harmonics(self, mean=0.0, rate=0.0, cosines=None, sines=None):
        """Makes a signal of harmonics, mean and rate.

        Its value is mean + rate t + the sum over j = 1 ... count of cosines[j-1] cos(j w t) +
        sines[j-1] sin(j w t), with w = 2 pi / T and the period T that is given to the solve.
        What drives a rotation may have a rate if it grows by whole turns in a period (rate * T
        a multiple of 2 pi); all else must have rate zero.

        Args:
            mean: mean, in the unit of what the signal drives; usually 0
            rate: growth for a unit of time; usually 0
            cosines: array of shape (count)
            sines: array of shape (count)
        """
        cosines, sines, _count = together(cosines=cosines, sines=sines)
        call(
            lib.pdn_signal_set_harmonics,
            self._c,
            mean,
            rate,
            pointer(cosines),
            pointer(sines),
            _count,
        )
        self._kept.append((cosines, sines))
        return self

    def set_samples(self, samples, rate=0.0):
        """Makes a signal rate t plus the trigonometric interpolation of samples[k] at t = k T /
        count.

        The samples are equally spaced over one period T of the solve, the end of which is not
        repeated.

        Args:
            rate: growth for a unit of time, as in Signal.set_harmonics; usually 0
            samples: array of shape (count): without the growth, in the unit of what the signal
                drives
        """
        samples = reals("samples", samples, (None,))
        _count = len(samples)
        call(lib.pdn_signal_set_samples, self._c, rate, pointer(samples), _count)
        self._kept.append((samples,))
        return self

    def set_function(self, function):
        """Makes a signal a function of the caller.

        Over a period it may grow by whole turns if it drives a rotation, and must not grow
        otherwise.

        Args:
            function: the function
        """
        function = _callbacks.signal(function, self._kept)
        call(lib.pdn_signal_set_function, self._c, function.function, function.data)
        return self

    def set_function_of_phase(self, function):
        """Makes a signal a function of the caller, of the phase 2 pi t / T [radians], which it is
        told in place of the time: it holds for any period T.

        Over a period it may grow by whole turns if it drives a rotation, and must not grow
        otherwise.

        Args:
            function: the function
        """
        function = _callbacks.signal(function, self._kept)
        call(lib.pdn_signal_set_function_of_phase, self._c, function.function, function.data)
        return self


class Frame(Struct):
    """Position and axes of a frame. This struct will never change."""

    _type = "pdn_frame"
    position = Array("position", (3,))
    """Its origin, in global coordinates [length]."""
    rotation = Array("rotation", (3, 3))
    """Its axes, in global coordinates: a rotation matrix, 3 x 3, column by column, the columns
    being axes 1, 2, 3. Rounding up to 1e-8 is tolerated, and removed.
    """


class Line(Struct):
    """Reference line of a beam: a frame at each fraction of the span, with axis 1 along the line.

    Start with `Line()`; then one of the `set_...`, each of which replaces all that was set
    before. Leave the fields to them.
    """

    _type = "pdn_line"
    _initialise = lib.pdn_line_init

    def set_straight(self, start, end, axis_2):
        """Makes a line straight. Its axes are the same all along.

        Args:
            start: array of shape (3): where it starts, global coordinates [length]
            end: array of shape (3): where it ends, not at start
            axis_2: array of shape (3): axis 2 is the part of this direction that is
                perpendicular to the line; of any nonzero length, not along the line
        """
        start = reals("start", start, (3,))
        end = reals("end", end, (3,))
        axis_2 = reals("axis_2", axis_2, (3,))
        call(lib.pdn_line_set_straight, self._c, pointer(start), pointer(end), pointer(axis_2))
        self._kept.append((start, end, axis_2))
        return self

    def set_arc(self, start, point, end, axis_2):
        """Makes a line the circular arc from start through point to end, of up to a whole turn.

        Fractions are of its length. Its axes turn with it about the arc's own axis, so that
        their curvature is constant.

        Args:
            start: array of shape (3): where it starts, global coordinates [length]
            point: array of shape (3): a point between start and end; the three not on a
                straight line
            end: array of shape (3): where it ends, not at start
            axis_2: array of shape (3): axis 2 at the start is the part of this direction that
                is perpendicular to the arc there; of any nonzero length, not along the arc
                there
        """
        start = reals("start", start, (3,))
        point = reals("point", point, (3,))
        end = reals("end", end, (3,))
        axis_2 = reals("axis_2", axis_2, (3,))
        call(
            lib.pdn_line_set_arc,
            self._c,
            pointer(start),
            pointer(point),
            pointer(end),
            pointer(axis_2),
        )
        self._kept.append((start, point, end, axis_2))
        return self

    def set_curve(self, curve):
        """Makes a line a curve that the caller computes.

        The curve must be smooth, and its fraction advance steadily: it is differentiated by the
        library, to rounding if it turns by less than half a radian in each 1/16 of the
        fraction. Join pieces that meet in a corner by Model.add_rigid_joint.

        Args:
            curve: the curve
        """
        curve = _callbacks.curve(curve, self._kept)
        call(lib.pdn_line_set_curve, self._c, curve.function, curve.data)
        return self


class Stations(Struct):
    """Cross-sections along a beam, at stations; linear in between, entry by entry.

    Start with `Stations()`, then set the fields. The library reads the arrays during the call
    that takes the stations.
    """

    _type = "pdn_stations"
    _initialise = lib.pdn_stations_init
    count = Number("count")
    """Number of stations; one alone stands for all of the beam."""
    fractions = Array("fractions", pointed=True, counted="count")
    """Array of length [count]: places along the span, from 0 at the start to 1 at the end,
    ascending; two stations at the same place make a jump. May be None if count is 1.
    """
    sections = Structs("sections", "Section", "count")
    """Array of length [count]: the sections, each initialised."""
    twists = Array("twists", pointed=True, counted="count")
    """Array of length [count]: structural twist, the angles by which axes 2 and 3 of the sections
    are turned about axis 1 from those of the line, right-handed, linear between stations
    [radian]. None for none. It has no jumps.
    """


class Beam(Struct):
    """What a beam was made of; written by the library. This struct will never change its size.

    The nodes along the beam are first, first + 1, ... last; the elements are first_element, ...
    first_element + elements - 1.
    """

    _type = "pdn_beam"
    first = Number("first")
    """Id of the node at the start."""
    last = Number("last")
    """Id of the node at the end."""
    first_element = Number("first_element")
    """Id of the element at the start."""
    elements = Number("elements")
    """Number of elements."""


class Surface(Struct):
    """A surface: a point for each pair (u, v), each from 0 to 1.

    Its normal is that of the tangents along u and v, in this order. Start with `Surface()`;
    then one of the `set_...`, each of which replaces all that was set before. Leave the fields
    to them.
    """

    _type = "pdn_surface"
    _initialise = lib.pdn_surface_init

    def set_parallelogram(self, corner, along_u, along_v):
        """Makes a surface a parallelogram, such as a rectangle.

        Args:
            corner: array of shape (3): the point at u = v = 0, global coordinates [length]
            along_u: array of shape (3): the side from there along u [length]
            along_v: array of shape (3): the side along v, not parallel to it [length]
        """
        corner = reals("corner", corner, (3,))
        along_u = reals("along_u", along_u, (3,))
        along_v = reals("along_v", along_v, (3,))
        call(
            lib.pdn_surface_set_parallelogram,
            self._c,
            pointer(corner),
            pointer(along_u),
            pointer(along_v),
        )
        self._kept.append((corner, along_u, along_v))
        return self

    def set_annulus(self, centre, axis, start, inner, outer, angle):
        """Makes a surface an annulus or a sector of one: u from the inner to the outer radius, v
        around the axis. The normal is along the axis for positive angles.

        Args:
            centre: array of shape (3): its centre, global coordinates [length]
            axis: array of shape (3): direction of its axis, of any nonzero length
            start: array of shape (3): where v = 0 is, seen from the centre: the part of this
                direction across the axis; not along the axis
            inner: inner radius, positive [length]
            outer: outer radius, more than the inner [length]
            angle: angle about the axis, right-handed; not zero, at most one turn [radian]
        """
        centre = reals("centre", centre, (3,))
        axis = reals("axis", axis, (3,))
        start = reals("start", start, (3,))
        call(
            lib.pdn_surface_set_annulus,
            self._c,
            pointer(centre),
            pointer(axis),
            pointer(start),
            inner,
            outer,
            angle,
        )
        self._kept.append((centre, axis, start))
        return self

    def set_cylinder(self, centre, axis, start, radius, length, angle):
        """Makes a surface a cylinder or a sector of one: u around the axis, v along it. The normal
        is outwards for positive angles.

        Args:
            centre: array of shape (3): the centre of its end, v = 0, global coordinates
                [length]
            axis: array of shape (3): direction of its axis, of any nonzero length
            start: array of shape (3): where u = 0 is, seen from the centre: the part of this
                direction across the axis; not along the axis
            radius: radius, positive [length]
            length: length along the axis, positive [length]
            angle: angle about the axis, right-handed; not zero, at most one turn [radian]
        """
        centre = reals("centre", centre, (3,))
        axis = reals("axis", axis, (3,))
        start = reals("start", start, (3,))
        call(
            lib.pdn_surface_set_cylinder,
            self._c,
            pointer(centre),
            pointer(axis),
            pointer(start),
            radius,
            length,
            angle,
        )
        self._kept.append((centre, axis, start))
        return self

    def set_function(self, function):
        """Makes a surface one that the caller computes, smooth within each element.

        Args:
            function: the surface
        """
        function = _callbacks.surface(function, self._kept)
        call(lib.pdn_surface_set_function, self._c, function.function, function.data)
        return self


class ShellSection(Struct):
    """Stiffness, damping and mass of a shell, per unit of its reference area.

    Strains are `[e11 e12 g1 k11 k12 k1n, e21 e22 g2 k21 k22 k2n]`: how position and frame of
    the surface change along axis 1, then along axis 2, resolved in axes 1, 2 and the normal.
    Bending of lines along axis 1 is k12, along axis 2 -k21; twist is -k11 and k22; e12 - e21 is
    the drilling rotation against the surface. Forces and moments per length are in the same
    order. The matrices are column-major and symmetric. Any consistent set of units.

    Start with `ShellSection()`; then ShellSection.set_isotropic, or write the matrices
    yourself, as of laminates. A section without stiffness is refused where it is used.
    """

    _type = "pdn_shell_section"
    _initialise = lib.pdn_shell_section_init
    stiffness = Array("stiffness", (12, 12))
    """Forces and moments for unit strains, 12 x 12; positive definite."""
    damping = Array("damping", (12, 12))
    """The same for unit rates of strain; positive semi-definite."""
    mass = Array("mass", (6, 6))
    """Momenta for unit velocities, 6 x 6; positive semi-definite."""

    def set_isotropic(
        self,
        thickness,
        young,
        poisson,
        density,
        drilling=1.0,
        drilling_gradient=0.1,
    ):
        """Makes a section that of one isotropic, linearly elastic material. Takes the damping
        away: give that afterwards.

        Args:
            thickness: thickness, positive [length]
            young: Young's modulus, positive [force / length^2]
            poisson: Poisson's ratio, more than -1 and less than 1/2
            density: zero or more [mass / length^3]
            drilling: stiffness of the drilling rotation against the surface, relative to shear:
                0.1 to 1; usually 1
            drilling_gradient: stiffness against gradients of the drilling rotation, which only
                regularises; positive, usually 0.1
        """
        call(
            lib.pdn_shell_section_set_isotropic,
            self._c,
            thickness,
            young,
            poisson,
            density,
            drilling,
            drilling_gradient,
        )
        return self

    def set_proportional_damping(self, seconds):
        """Gives a section damping in proportion to its stiffness, which must have been set.

        A vibration of circular frequency w then has the damping ratio seconds * w / 2.

        Args:
            seconds: damping = seconds * stiffness; zero or more [time]
        """
        call(lib.pdn_shell_section_set_proportional_damping, self._c, seconds)
        return self


class ShellPlacement(Struct):
    """How a shell lies on its nodes. Set the defaults by `ShellPlacement()`."""

    _type = "pdn_shell_placement"
    _initialise = lib.pdn_shell_placement_init
    frames = Number("frames")
    """SHELL_NORMALS, SHELL_PARALLEL, SHELL_NODE_AXES or SHELL_NODE_FRAMES."""
    offset = Number("offset")
    """Distance of the surface that the section belongs to from the nodes, along the normal
    [length]; default: 0.
    """
    direction = Array("direction", (3,))
    """Direction whose part in the surface is axis 1 of the section, global coordinates. If it is
    zero, the default, axes 1 and 2 are as close to xi and eta as they can be at a right angle.
    """


class Shell(Struct):
    """What a shell over a surface was made of; written by the library. This struct will never
    change its size.

    Element i elements_v + j from the first on is the one at i along u and j along v; xi of each
    is in the direction of u, eta in that of v. Model.shell_patch_node tells the nodes.
    """

    _type = "pdn_shell"
    first_element = Number("first_element")
    """Id of the first element."""
    elements_u = Number("elements_u")
    """Number of elements along u."""
    elements_v = Number("elements_v")
    """Number of elements along v."""
    nodes_u = Number("nodes_u")
    """Number of nodes along u."""
    nodes_v = Number("nodes_v")
    """Number of nodes along v."""


class TangentCheck(Struct):
    """Where the tangents of a user's function differ most from differences of its forces.

    Initialise with `TangentCheck()`.
    """

    _type = "pdn_tangent_check"
    _initialise = lib.pdn_tangent_check_init
    error = Number("error")
    """Largest difference, relative to the largest tangent; lengths, angles and velocities are
    taken relative to what is characteristic of the model and the period. Tangents that are
    right leave about 1e-8.
    """
    time = Number("time")
    """Time of the state it was found at."""
    given = Number("given")
    """The derivative that the function gives there."""
    differenced = Number("differenced")
    """What differences of its forces give."""
    tangent = Number("tangent")
    """TANGENT_MOTION or TANGENT_VELOCITY."""
    row_node = Number("row_node")
    """Node of the force that is differentiated; of one on a shell, number of the point from 0; -1
    for an effort on a joint coordinate.
    """
    row_component = Number("row_component")
    """Its component, FORCE_1, ... MOMENT_3; 0 for an effort."""
    column_node = Number("column_node")
    """Node of the motion or velocity that it is differentiated by, or point; -1 for a joint
    coordinate.
    """
    column_component = Number("column_component")
    """Its component: 0, 1, 2 linear, 3, 4, 5 angular; 0 for a joint coordinate."""


class Diagnostics(Struct):
    """Figures of a solve. Initialise with `Diagnostics()`."""

    _type = "pdn_diagnostics"
    _initialise = lib.pdn_diagnostics_init
    outcome = Number("outcome")
    """Outcome, as Solution.outcome."""
    iterations = Number("iterations")
    """Newton iterations of the periodic problem."""
    guess_iterations = Number("guess_iterations")
    """Newton iterations of the initial guess, each at a single instant."""
    redundant_constraints = Number("redundant_constraints")
    """Constraints that depend on others, and are tolerated: the reactions given are those of least
    norm.
    """
    grid_points = Number("grid_points")
    """Number of grid points; of a march the number of times kept."""
    unknowns = Number("unknowns")
    """Number of unknowns of the periodic problem, or of a step."""
    last_increment = Number("last_increment")
    """Largest increment of the last iteration, as Progress."""
    error_estimate = Number("error_estimate")
    """Estimated error of the motions at all times: lengths relative to the size of the mechanism,
    angles in radians; infinite if it cannot be had. From the decay of their harmonics, the
    violation of constraints between grid points and, if several grids were tried, the
    difference between two of them. Velocities and forces have larger errors: see
    force_residual_between.
    """
    force_residual_between = Number("force_residual_between")
    """Largest residual force between grid points, relative to the largest force that any element
    exerts; infinite if the motion cannot be interpolated. Large values mean aliasing.
    """
    constraint_residual_between = Number("constraint_residual_between")
    """Largest violation of a constraint between grid points: lengths relative to the size of the
    mechanism, angles in radians; infinite if the motion cannot be interpolated.
    """
    guess_seconds = Number("guess_seconds")
    """Seconds spent on the initial guess: quasi-static motions, marches, and what is carried from
    grid to grid.
    """
    assembly_seconds = Number("assembly_seconds")
    """Seconds spent on elements and assembly, on all grids and in all attempts, as all that
    follows.
    """
    analysis_seconds = Number("analysis_seconds")
    """Seconds spent on symbolic analysis."""
    factorisation_seconds = Number("factorisation_seconds")
    """Seconds spent on numeric factorisation of whole Jacobians."""
    substitution_seconds = Number("substitution_seconds")
    """Seconds spent on forward and backward substitution, or on iteration."""
    decay = Number("decay")
    """How the upper half of the harmonics of motions falls: DECAY_FAST, DECAY_SLOW, ..."""
    grids = Number("grids")
    """Number of grids that an adaptive solve tried; 0 if their number of points was given."""
    decay_order = Number("decay_order")
    """Exponent p of that fall, if harmonic j is as j^-p: 2 where velocities jump, 3 where
    accelerations do; of a smooth response ever larger with more grid points. 0 if it is not
    known.
    """
    least_resolved_time = Number("least_resolved_time")
    """Time at which the upper half of the harmonics adds up to most: where a kink or narrow peak
    is.
    """
    linear_solver = Number("linear_solver")
    """How the linear equations of the last grid were solved: LINEAR_DIRECT, LINEAR_BODY_CIRCULANT,
    ...
    """
    linear_iterations = Number("linear_iterations")
    """Products with the Jacobian that iteration took, in all linear solves on that grid."""
    linear_solves = Number("linear_solves")
    """Linear solves by iteration on that grid."""
    most_linear_iterations = Number("most_linear_iterations")
    """Largest number of products of one of them."""
    linear_bytes = Number("linear_bytes")
    """Bytes that iteration took at most; 0 if there was none."""
    preconditioner_seconds = Number("preconditioner_seconds")
    """Seconds spent on preconditioners, without the system of joints that turn."""
    interface_seconds = Number("interface_seconds")
    """Seconds spent on that system."""
    estimate_seconds = Number("estimate_seconds")
    """Seconds spent on error estimates, and on why a Jacobian is singular."""
    total_seconds = Number("total_seconds")
    """Seconds of the whole solve: all of these, and the little that is none of them."""
    total_iterations = Number("total_iterations")
    """Newton iterations on all grids and in all attempts, without those of the initial guess."""
    attempts = Number("attempts")
    """Attempts, each from another start, as the report lists them; 0 where the start was given.
    """
    mesh_error = Number("mesh_error")
    """Estimated error of the motions of nodes by the mesh of beams, measured as error_estimate,
    which says nothing of the mesh: what elements of a higher degree would make of them. 0
    without beams; infinite unless asked for, of a march, of modes, and where it cannot be had.
    """


class Quantity(Struct):
    """What is asked of a solution: of a node, a joint, a beam, a shell, a force or a relation.
    Initialise with `Quantity()`; fields that its kind does not have stay as they are.
    """

    _type = "pdn_quantity"
    _initialise = lib.pdn_quantity_init
    kind = Number("kind")
    """NODE_POSITION, ...; there is no default."""
    object = Number("object")
    """Id of the node, joint, beam element, shell element, force or relation that it is of."""
    component = Number("component")
    """The component, from 0, or ALL_COMPONENTS, the default. Of coordinates and driving efforts,
    the coordinate: DISPLACEMENT, ..., ROTATION_3; of relations which of their coordinates, from
    0.
    """
    frame = Number("frame")
    """FRAME_SPACE, the default, or FRAME_MATERIAL; of reactions FRAME_SPACE, FRAME_FIRST or
    FRAME_SECOND.
    """
    node = Number("node")
    """Of what a force exerts on one of its nodes, the node."""
    branch = Number("branch")
    """Of viscoelastic elements, the branch, from 0; of controllers, which of the coordinates that
    they act on, or which state, from 0.
    """
    station = Number("station")
    """Of beams, the place along the element, from -1 at its first to 1 at its last node; of
    shells, xi, from -1 to 1.
    """
    station_eta = Number("station_eta")
    """Of shells, eta, from -1 to 1."""
    direction = Array("direction", (3,))
    """Of shells, a direction in the reference configuration, global coordinates, whose part in the
    surface is axis 1. If it is zero, the default, axes are those of the section. They move with
    the shell.
    """


class Progress(Struct):
    """How far a solve is, as told to a the function."""

    _type = "pdn_progress"
    stage = Number("stage")
    """STAGE_INITIAL_GUESS, STAGE_NEWTON, STAGE_MARCH, STAGE_MODES or STAGE_STABILITY."""
    iteration = Number("iteration")
    """Number of the last iteration, from 1, or 0 before the first; starts again with each Newton
    solve. In a march, number of the step.
    """
    residual = Number("residual")
    """Largest residual before the step: forces relative to the characteristic force (the largest
    stiffness times the size of the mechanism), lengths relative to its size, angles in radians.
    """
    increment = Number("increment")
    """Largest increment of a motion: displacements relative to the size of the mechanism, turns in
    radians.
    """
    step = Number("step")
    """Fraction of the increment that was taken."""
    time = Number("time")
    """In a march the end of the step; otherwise 0."""
    elapsed = Number("elapsed")
    """Seconds since the solve began."""
    grid_points = Number("grid_points")
    """Number of points of the grid that is worked on; 1 of an equilibrium or a march."""
    attempt = Number("attempt")
    """Number of the attempt of a periodic solve, from 1, as the report lists them; 0 where the
    start was given, and before the first, as on a coarse grid that is to give a start.
    """
    start = Number("start")
    """What it starts from: START_QUASI_STATIC, ...; 0 where the start was given."""
    iterated = Number("iterated")
    """1 where an iteration, or a step of a march, has just ended; 0 while one lasts, or what comes
    between them.
    """


class PeriodicOptions(Struct):
    """Options of Model.solve_periodic. Set the defaults by `PeriodicOptions()`."""

    _type = "pdn_periodic_options"
    _initialise = lib.pdn_periodic_options_init
    grid_points = Number("grid_points")
    """Number N of grid points, odd, or a multiple of the number of like blades
    (pdn_model_set_rotor_symmetry): harmonics below N / 2 are resolved. 0 for as many as
    error_tolerance needs. Default 0.
    """
    harmonics = Number("harmonics")
    """If not 0, the number of harmonics that are resolved: grid_points is then 2 harmonics + 1.
    Default 0.
    """
    tolerance = Number("tolerance")
    """Newton's method has converged when the largest increment (lengths relative to the size of
    the mechanism, angles in radians) is below this. Newton is quadratic: the error left in
    motions is about its square, that in forces about it times their last change. Default 1e-9.
    """
    iteration_limit = Number("iteration_limit")
    """Most Newton iterations on a grid. Default 30."""
    initial = Reference("initial", pointer)
    """Start from this solution, periodic or static, also on another grid or of another period, or
    from the last period of this march; None to start otherwise. Its model is to have the same
    bodies, joints, forces and prescribed coordinates, and the same beams, which may have other
    meshes. If grid_points is 0, the first grid is that of this solution. Default None.
    """
    guess_positions = Array("guess_positions", pointed=True)
    """Start from these positions, an array of shape 3 x [N] x [nodes]: coordinates fastest, then
    grid points, then nodes; None to start otherwise. Needs guess_rotations, and grid_points or
    harmonics. Default None.
    """
    guess_rotations = Array("guess_rotations", pointed=True, turned=True)
    """Rotation matrices of the same start, an array of shape 9 x [N] x [nodes], each column by
    column. Default None.
    """
    progress = Reference("progress", _callbacks.progress, "progress_data")
    """Told of each iteration, and while one lasts, see progress_interval; may cancel. Default
    None.
    """
    error_tolerance = Number("error_tolerance")
    """If grid_points is 0, grid points are added until the estimated error of the motions is below
    this: positions relative to the size of the mechanism, angles in radians. Default 1e-6,
    which leaves about three digits to forces and accelerations, which are second derivatives.
    """
    largest_grid_points = Number("largest_grid_points")
    """If grid_points is 0, the largest number of grid points, at least 3; if the tolerance would
    need more, the outcome is TOLERANCE_NOT_MET. Default 511.
    """
    linear_solver = Number("linear_solver")
    """How linear equations are solved: LINEAR_AUTOMATIC, LINEAR_DIRECT, ... Default
    LINEAR_AUTOMATIC.
    """
    threads = Number("threads")
    """Threads that share the work, of a pool that lasts as long as the call; 0 for as many as
    there are processors. Signals' and other functions of yours are called on the calling thread
    alone. Default 1.
    """
    oversampling = Number("oversampling")
    """The equations are sampled at this many times as many points (or one more), from 1 to 16,
    where motions and multipliers are interpolated; their virtual work, and the harmonics of the
    constraints up to those of the grid, are to vanish. 1: at the grid points alone. Default 1.
    """
    response_tolerance = Number("response_tolerance")
    """If grid_points is 0 and this is not, the estimated error of the motions is also to be below
    this times the amplitude of the response: the largest deviation of a node from its mean or,
    if it makes whole turns in a period, from a steady turn, in the measure of error_tolerance.
    For responses that are small beside the mechanism. Default 0.
    """
    start = Number("start")
    """Where the library starts, unless a start is given: START_AUTOMATIC, or one way alone:
    START_QUASI_STATIC, ... START_STEADY_ROTATION and START_RIGID_ROTATION need a drive that
    turns. Default START_AUTOMATIC.
    """
    estimate_mesh = Number("estimate_mesh")
    """1 to estimate the error by the mesh of beams, too, Diagnostics.mesh_error, which takes about
    as long as an iteration; not with oversampling. Default 0.
    """
    progress_interval = Number("progress_interval")
    """Least time between two calls of progress while an iteration lasts, in seconds; 0 to be
    called at any opportunity. Default 0.1.
    """
    work_limit = Number("work_limit")
    """Most work, counted in operations and not in time, of all starts and grids: this many times
    that of an easy Newton iteration on the finest grid so far, by few products or by factors,
    and a constant for small models. What takes more ends as WORK_LIMIT or, where a coarser grid
    had a solution, with that as TOLERANCE_NOT_MET. Twice that on a given grid. 0 for no bound.
    Default 17.
    """
    memory_limit = Number("memory_limit")
    """Bytes of memory that the solve may take, by an estimate that is made before it is begun on a
    grid: one that would take more is ERR_MEMORY, and its message tells the estimate. If
    grid_points is 0, only the first grid is refused so; finer ones that would take more end the
    solve as TOLERANCE_NOT_MET. 0 for no limit but that of the system. Default 0.
    """
    time_map = Number("time_map")
    """Where the points of grids are: TIME_MAP_AUTOMATIC, TIME_MAP_EQUISPACED or TIME_MAP_EVENTS.
    By TIME_MAP_AUTOMATIC, a given number of points is equispaced, and a solve to a tolerance
    that starts from a solution goes on with the map of that. Default TIME_MAP_AUTOMATIC.
    """
    event_count = Number("event_count")
    """Number of the events of TIME_MAP_EVENTS, at most 16. Default 0."""
    event_times = Array("event_times", pointed=True, counted="event_count")
    """Times of the events, which repeat themselves every period: an array of length [event_count].
    Default None.
    """
    event_widths = Array("event_widths", pointed=True, counted="event_count")
    """Times from there to where the additional density of grid points is half as large, about as
    long as the events last, from 1e-5 to half the period: an array of length [event_count].
    Default None.
    """
    event_shares = Array("event_shares", pointed=True, counted="event_count")
    """Grid points that are there for each, beside those spread equally over the period, which
    count as 1; above 0, at most 100: an array of length [event_count]. Default None.
    """


class EquationsOptions(Struct):
    """Options of EquationsNew. Set the defaults by `EquationsOptions()`."""

    _type = "pdn_equations_options"
    _initialise = lib.pdn_equations_options_init
    grid_points = Number("grid_points")
    """Number N of grid points, odd; to be set."""
    initial = Reference("initial", pointer)
    """Where to begin: a solution as for PeriodicOptions.initial; None for the reference
    configuration. Default None.
    """
    owners = Array("owners", pointed=True, counted="owner_count")
    """Rank of each node, an array of length [owner_count]; None for runs of nodes with about the
    same work. Each rank must have a node. Default None.
    """
    owner_count = Number("owner_count")
    """Number of nodes, if there are owners."""
    rank = Number("rank")
    """Number of this rank, from 0. Default 0."""
    ranks = Number("ranks")
    """How many ranks there are. Default 1."""
    preconditioner = Number("preconditioner")
    """The preconditioner: LINEAR_TIME_LOCAL, LINEAR_BODY_CIRCULANT, LINEAR_CIRCULANT, or
    LINEAR_AUTOMATIC for the first where joints turn in the initial motion, the second
    otherwise. Default LINEAR_AUTOMATIC.
    """
    threads = Number("threads")
    """Threads of this rank that share its work; 0 for as many as there are processors. Default 1.
    """


class EquationsSizes(Struct):
    """Sizes of the equations, and of the vectors of this rank."""

    _type = "pdn_equations_sizes"
    _initialise = lib.pdn_equations_sizes_init
    size = Number("size")
    """Numbers of a vector of this rank."""
    halo = Number("halo")
    """Numbers of other ranks that it keeps copies of."""
    total = Number("total")
    """Numbers of the vectors of all ranks."""
    nodes = Number("nodes")
    """Nodes of this rank."""
    motions = Number("motions")
    """Numbers of its motions, 12 for each node and grid point."""
    own_unknowns = Number("own_unknowns")
    """Own unknowns of its elements, multipliers and internal states, at all grid points."""
    bytes = Number("bytes")
    """Bytes that tangents, factors and vectors take here."""
    preconditioner = Number("preconditioner")
    """The preconditioner: LINEAR_TIME_LOCAL, LINEAR_BODY_CIRCULANT or LINEAR_CIRCULANT."""


class JointInfo(Struct):
    """A joint of a model. Initialise with `JointInfo()`."""

    _type = "pdn_joint_info"
    _initialise = lib.pdn_joint_info_init
    kind = Number("kind")
    """JOINT_RIGID ... JOINT_STRUT."""
    first = Number("first")
    """Id of the first node, or GROUND."""
    second = Number("second")
    """Id of the second node, or GROUND."""
    pitch = Number("pitch")
    """Advance of a screw for one turn; zero of other joints."""
    first_position = Array("first_position", (3,))
    """Origin of the first frame in the reference configuration, global coordinates."""
    first_rotation = Array("first_rotation", (3, 3))
    """Axes of the first frame there, a rotation matrix, column by column."""
    second_position = Array("second_position", (3,))
    """Origin of the second frame, likewise."""
    second_rotation = Array("second_rotation", (3, 3))
    """Axes of the second frame, likewise."""


class ForceInfo(Struct):
    """A force of a model. Initialise with `ForceInfo()`."""

    _type = "pdn_force_info"
    _initialise = lib.pdn_force_info_init
    kind = Number("kind")
    """FORCE_IS_SPRING_DAMPER ... FORCE_IS_LINE_FORCE; of a controller Model.controller_counts
    tells more.
    """
    joint = Number("joint")
    """Id of the joint on whose coordinate it acts, or -1."""
    coordinate = Number("coordinate")
    """The coordinate: DISPLACEMENT, ...; -1 if it acts on none."""
    first = Number("first")
    """Of what is between two bodies, id of the first node, or GROUND."""
    second = Number("second")
    """Id of the second node, or GROUND."""
    angles = Number("angles")
    """Of a bushing, ANGLES_ROTATION_VECTOR or ANGLES_TILT_AND_SPIN; else zero."""
    stiffness_count = Number("stiffness_count")
    """How many numbers NUMBER_STIFFNESS it has, for Model.force_number."""
    damping_count = Number("damping_count")
    """The same of NUMBER_DAMPING."""
    branch_count = Number("branch_count")
    """The same of NUMBER_RELAXATION_TIME: branches of a viscoelastic element."""
    node_count = Number("node_count")
    """Nodes of forces of the user, for Model.force_node."""
    rest = Number("rest")
    """Coordinate at which springs are free of effort."""
    first_position = Array("first_position", (3,))
    """Of what is between two bodies, origin of the first frame in the reference configuration,
    global coordinates.
    """
    first_rotation = Array("first_rotation", (3, 3))
    """Axes of the first frame there, a rotation matrix, column by column."""
    second_position = Array("second_position", (3,))
    """Origin of the second frame, likewise."""
    second_rotation = Array("second_rotation", (3, 3))
    """Axes of the second frame, likewise."""
    shell_element = Number("shell_element")
    """Of forces of the user on a shell, id of the element; else -1."""
    shell_place = Number("shell_place")
    """Where on it: SHELL_SURFACE or an edge; else -1."""
    beam_element = Number("beam_element")
    """Of forces of the user along a beam, id of the element; else -1."""
    nodes_apart = Number("nodes_apart")
    """Of forces of the user on nodes, 1 if these were declared apart; else 0."""
    axis_2 = Array("axis_2", (3,))
    """Of forces of the user along a beam with FRAME_UNTWISTED, the direction axis_2; else zero.
    """


class SensitivityOptions(Struct):
    """Options of Solution.sensitivities. Set the defaults by `SensitivityOptions()`."""

    _type = "pdn_sensitivity_options"
    _initialise = lib.pdn_sensitivity_options_init
    method = Number("method")
    """SENSITIVITY_AUTOMATIC, the default, SENSITIVITY_DIRECT or SENSITIVITY_ADJOINT."""
    linear_solver = Number("linear_solver")
    """How linear equations are solved: LINEAR_AUTOMATIC, ... Default LINEAR_AUTOMATIC."""
    threads = Number("threads")
    """Threads that share the work; 0 for as many as there are processors. Default 1."""


class BranchPoint(Struct):
    """A point of a branch. Initialise with `BranchPoint()`."""

    _type = "pdn_branch_point"
    _initialise = lib.pdn_branch_point_init
    parameter = Number("parameter")
    """Value of the parameter that is followed."""
    slope = Number("slope")
    """Its derivative by the length along the branch, over its range: zero at a fold."""
    period = Number("period")
    """Period of the motion."""
    step = Number("step")
    """Length of the step from the point before."""
    angle = Number("angle")
    """Angle between the branch here and at the point before [radians]."""
    grid_points = Number("grid_points")
    """Number of grid points."""
    iterations = Number("iterations")
    """Number of Newton iterations."""
    event = Number("event")
    """EVENT_NONE, EVENT_FOLD, ..."""
    second_frequency = Number("second_frequency")
    """At a torus point, the angular frequency of the motions that begin there; else zero."""
    largest_multiplier = Number("largest_multiplier")
    """Size of the largest multiplier; zero if multipliers were not wanted."""
    multipliers_outside = Number("multipliers_outside")
    """Number of multipliers outside the unit circle; zero also if they were not wanted."""
    stability = Number("stability")
    """STABLE, UNSTABLE or STABILITY_NOT_KNOWN, also if multipliers were not wanted."""


class BranchOptions(Struct):
    """Options of FollowBranch. Set the defaults by `BranchOptions()`."""

    _type = "pdn_branch_options"
    _initialise = lib.pdn_branch_options_init
    periodic = Reference("periodic", of_type("PeriodicOptions"))
    """Grid, tolerance and linear solver, where the first solve starts, and who is told of the
    iterations; None for the defaults. Grids are equispaced. Default None.
    """
    conditions = Reference("conditions", pointer)
    """What else is free along the branch, and as many conditions; None for nothing. Default None.
    """
    from_ = Number("from")
    """Least value of the parameter, where the branch ends."""
    to = Number("to")
    """Largest value of the parameter, where the branch ends; more than `from`."""
    motion_scale = Number("motion_scale")
    """What counts as 1 in motions, relative to the size of the mechanism and in radians; as the
    whole range does in the parameter. Default 1.
    """
    first_step = Number("first_step")
    """Length of the first step: 1 is the whole range, or a motion of motion_scale. Default 0.02.
    """
    smallest_step = Number("smallest_step")
    """Shortest step. Default 1e-6."""
    largest_step = Number("largest_step")
    """Longest step. Default 1."""
    angle = Number("angle")
    """Angle between the branch at neighbouring points that steps aim at [radians]; steps by four
    thirds of it are taken again by half. Default 0.3.
    """
    point_limit = Number("point_limit")
    """Most points. Default 1000."""
    progress = Reference("progress", _callbacks.branch, "progress_data")
    """Told of each point; may end the branch. Default None."""
    downwards = Number("downwards")
    """1 if the parameter decreases at first. Default 0."""
    events = Number("events")
    """1 to look for branch points (where there are no conditions) and period doublings, too, by
    two more factorisations of the whole Jacobian a point. Default 0.
    """
    stability = Number("stability")
    """1 to find the multipliers of each point, and with them torus points. Default 0."""


class StabilityOptions(Struct):
    """Options of Solution.solve_stability. Set the defaults by `StabilityOptions()`."""

    _type = "pdn_stability_options"
    _initialise = lib.pdn_stability_options_init
    highest_frequency = Number("highest_frequency")
    """Modes of up to this angular frequency matter [angle/time]; 0 for 20 times that of the
    period. Default 0.
    """
    tolerance = Number("tolerance")
    """Estimated error of the multipliers of these modes, in units of 1 or of the multiplier where
    that is more. Default 1e-8.
    """
    progress = Reference("progress", _callbacks.progress, "progress_data")
    """Told about ten times a second that work goes on; may cancel. Default None."""


class StaticOptions(Struct):
    """Options of Model.solve_static. Set the defaults by `StaticOptions()`."""

    _type = "pdn_static_options"
    _initialise = lib.pdn_static_options_init
    time = Number("time")
    """Loads and prescribed motions have their values at this time. Default 0."""
    period = Number("period")
    """Period that harmonics and samples of signals refer to; 0 if not given, as at time 0, where
    it does not matter. Default 0.
    """
    load_steps = Number("load_steps")
    """Load steps taken at least, from the unloaded reference configuration; a step that does not
    converge is halved. More than one keeps to the branch that grows from the reference
    configuration, where there are several. Not used with an initial solution. Default 1.
    """
    tolerance = Number("tolerance")
    """As in PeriodicOptions. Default 1e-9."""
    iteration_limit = Number("iteration_limit")
    """Most Newton iterations at the full loads. Default 30."""
    angular_velocity = Array("angular_velocity", (3,))
    """Angular velocity of the frame that everything turns with steadily, the ground too, inertial
    frame [angle/time]. Default 0.
    """
    axis_point = Array("axis_point", (3,))
    """A point of the axis it turns about [length]. Default 0."""
    initial = Reference("initial", pointer)
    """Start from this solution, at `time`, of a model with the same nodes and joints; None to
    start from the reference configuration. Default None.
    """
    progress = Reference("progress", _callbacks.progress, "progress_data")
    """Told of each iteration, and about ten times a second while one lasts; may cancel. Default
    None.
    """
    memory_limit = Number("memory_limit")
    """Bytes of memory that the solve may take, by an estimate that is made before it begins, with
    the modes of Model.solve_modes: what would take more is ERR_MEMORY, and the message tells
    the estimate. 0 for no limit but that of the system. Default 0.
    """


class ModesOptions(Struct):
    """Options of Model.solve_modes. Set the defaults by `ModesOptions()`."""

    _type = "pdn_modes_options"
    _initialise = lib.pdn_modes_options_init
    equilibrium = Reference("equilibrium", of_type("StaticOptions"))
    """The equilibrium, at rest or in steady rotation, how to find it, and who is told of the
    iterations; None for the defaults of StaticOptions. Default None.
    """
    count = Number("count")
    """Number of modes wanted. Default 10."""
    near_frequency = Number("near_frequency")
    """Angular frequency near which modes are wanted [angle/time]; 0 for those of the smallest
    eigenvalues. Default 0.
    """


class Mode(Struct):
    """A small motion `Re(x exp(s t))`. Initialise with `Mode()`."""

    _type = "pdn_mode"
    _initialise = lib.pdn_mode_init
    eigenvalue_real = Number("eigenvalue_real")
    """Real part of the eigenvalue s [1/time]; negative if the motion decays."""
    eigenvalue_imaginary = Number("eigenvalue_imaginary")
    """Imaginary part of s [angle/time], not negative."""
    frequency = Number("frequency")
    """Oscillations per unit of time, Im s / 2π."""
    damping_ratio = Number("damping_ratio")
    """Damping ratio, -Re s / |s|; 0 for a free motion."""
    modal_mass = Number("modal_mass")
    """Product of the shape with M and its own conjugate, with the shape as Modes.shape gives it.
    """
    residual = Number("residual")
    """Largest entry of the equations of small motions, relative to the largest sum of the sizes of
    their terms: rounding, if all is well.
    """


class MarchOptions(Struct):
    """Options of Model.solve_march. Set the defaults by `MarchOptions()`.

    There is no default of how long to march and in which steps: set duration or
    periodic_tolerance, and step or steps_per_period.
    """

    _type = "pdn_march_options"
    _initialise = lib.pdn_march_options_init
    start_time = Number("start_time")
    """When the march starts. Default 0."""
    duration = Number("duration")
    """How long it is; leave it 0 to march until periodic. Default 0."""
    period = Number("period")
    """Period T that harmonics and samples of signals refer to, and that the motion may repeat
    itself with; 0 if neither matters. Steps must not be longer, unless error_tolerance chooses
    them. Default 0.
    """
    step = Number("step")
    """Length of the steps, made shorter by what lets a whole number of them fit the duration or
    the period. With error_tolerance the length of the first. Default 0.
    """
    steps_per_period = Number("steps_per_period")
    """If not 0, the steps are period / steps_per_period. Default 0."""
    spectral_radius = Number("spectral_radius")
    """Spectral radius at infinite frequency, from 0 to 1: the numerical damping. With 1 no energy
    is lost, but the reactions of joints oscillate; 0 removes at once what the steps do not
    resolve. Default 0.5.
    """
    error_tolerance = Number("error_tolerance")
    """If not 0, steps are chosen so that each has at most this estimated error of a motion
    (lengths relative to the size of the mechanism, angles in radians). Default 0.
    """
    periodic_tolerance = Number("periodic_tolerance")
    """If not 0, march until motions and velocities differ by at most this from the periodic ones,
    by how the differences from each period to the next decay: displacements relative to the
    size of the mechanism, entries of rotation matrices, velocities likewise in the time T / (2
    pi). Default 0.
    """
    most_periods = Number("most_periods")
    """Most periods of a march until periodic; then its outcome is ITERATION_LIMIT. Default 200.
    """
    stored_periods = Number("stored_periods")
    """Keep the steps of only so many of the last periods; all steps if 0. Default 0."""
    tolerance = Number("tolerance")
    """Newton's method in a step has converged when the largest increment is below this, as in
    PeriodicOptions. Default 1e-9.
    """
    iteration_limit = Number("iteration_limit")
    """Most Newton iterations in a step. Default 20."""
    initial = Reference("initial", pointer)
    """Start from this solution of a model with the same nodes and joints, at start_time: an
    equilibrium, a periodic motion or another march; None to start otherwise. Default None.
    """
    positions = Array("positions", pointed=True)
    """Start from these positions, an array of shape 3 x [nodes]; None for those of the reference
    configuration. Needs rotations. Default None.
    """
    rotations = Array("rotations", pointed=True, turned=True)
    """Rotation matrices of the same start, an array of shape 9 x [nodes], each column by column.
    Default None.
    """
    velocities = Array("velocities", pointed=True)
    """Velocities of the same start, an array of shape 6 x [nodes]: velocity of each node and its
    angular velocity, inertial frame; None for none. Default None.
    """
    progress = Reference("progress", _callbacks.progress, "progress_data")
    """Told of each step, and about ten times a second while one lasts; may cancel. Default None.
    """
    memory_limit = Number("memory_limit")
    """Bytes of memory that the steps which are kept may take, by an estimate. A march whose number
    of steps is known, and takes more, is ERR_MEMORY before it begins; another that comes to
    take more ends there as WORK_LIMIT, with what was marched. 0 for no limit but that of the
    system. Default 0.
    """


class MarchDiagnostics(Struct):
    """Figures of a march. Initialise with `MarchDiagnostics()`."""

    _type = "pdn_march_diagnostics"
    _initialise = lib.pdn_march_diagnostics_init
    steps = Number("steps")
    """Steps taken."""
    rejected_steps = Number("rejected_steps")
    """Steps that were given up for shorter ones."""
    iterations = Number("iterations")
    """Newton iterations over all steps."""
    periods = Number("periods")
    """Whole periods marched."""
    first_time = Number("first_time")
    """First time of the trajectory: the start, or the oldest step that was kept."""
    last_time = Number("last_time")
    """Last time of the trajectory."""
    repetition = Number("repetition")
    """How much the last period differs from the one before, as MarchOptions.periodic_tolerance;
    infinite before the end of the first period.
    """
    step_error = Number("step_error")
    """Largest estimated error of a motion in one step, as MarchOptions.error_tolerance."""
    start_moved = Number("start_moved")
    """How much motions were moved at the start to satisfy constraints and prescribed motions:
    lengths relative to the size of the mechanism, entries of rotation matrices.
    """
    start_corrected = Number("start_corrected")
    """How much velocities were changed at the start: lengths relative to the size of the
    mechanism, or radians, in the unit of time.
    """


class ShootingOptions(Struct):
    """Options of Model.solve_shooting. Set the defaults by `ShootingOptions()`."""

    _type = "pdn_shooting_options"
    _initialise = lib.pdn_shooting_options_init
    steps_per_period = Number("steps_per_period")
    """Number of equal steps to the period. Default 200."""
    guess_periods = Number("guess_periods")
    """Periods marched for the first guess. Default 1."""
    spectral_radius = Number("spectral_radius")
    """Spectral radius at infinite frequency, from 0 to less than 1, as in MarchOptions. Default
    0.5.
    """
    tolerance = Number("tolerance")
    """Converged when the largest increment of a motion or velocity at the start (lengths relative
    to the size of the mechanism, angles in radians, velocities in the time T / (2 pi)) is below
    this. Default 1e-8.
    """
    iteration_limit = Number("iteration_limit")
    """Most Newton iterations. Default 30."""
    initial = Reference("initial", pointer)
    """Start the march from this solution of a model with the same nodes and joints, at its time 0
    or, of a march, at its first time; None for the reference configuration at rest. Default
    None.
    """
    progress = Reference("progress", _callbacks.progress, "progress_data")
    """Told of each period of the guess and of each iteration, and about ten times a second while
    one lasts; may cancel. Default None.
    """
    memory_limit = Number("memory_limit")
    """Bytes of memory that the solve may take, by an estimate that is made before it begins: what
    would take more is ERR_MEMORY, and the message tells the estimate. 0 for no limit but that
    of the system. Default 0.
    """


class Multiplier(Struct):
    """A disturbance `exp(mu t) phi(t)` of a periodic solution, where phi has its period.
    Initialise with `Multiplier()`.
    """

    _type = "pdn_multiplier"
    _initialise = lib.pdn_multiplier_init
    real = Number("real")
    """Real part of the multiplier rho = exp(mu T)."""
    imaginary = Number("imaginary")
    """Imaginary part of rho."""
    exponent_real = Number("exponent_real")
    """Real part of the exponent mu [1/time]; negative if the disturbance dies away."""
    exponent_imaginary = Number("exponent_imaginary")
    """Imaginary part of mu [angle/time]: of the many that give rho that nearest to the frequency
    of the mode.
    """
    frequency = Number("frequency")
    """Angular frequency of the mode over the period, in the nodes' own axes."""
    error = Number("error")
    """Estimated error of rho, for this periodic solution."""
    trivial = Number("trivial")
    """1 if rho is 1 because the disturbance only moves the solution in time, or all of the
    mechanism in space; else 0.
    """


class Summary(Struct):
    """Counts, mass and mobility of a model. Initialise with `Summary()`."""

    _type = "pdn_summary"
    _initialise = lib.pdn_summary_init
    nodes = Number("nodes")
    """Number of nodes."""
    beam_elements = Number("beam_elements")
    """Number of beam elements."""
    joints = Number("joints")
    """Number of joints."""
    prescribed = Number("prescribed")
    """Number of prescribed joint coordinates."""
    constraints = Number("constraints")
    """Number of constraints: those of the joints, and one for each prescribed coordinate and each
    relation between coordinates.
    """
    redundant_constraints = Number("redundant_constraints")
    """Number of these that depend on others in the reference configuration."""
    degrees_of_freedom = Number("degrees_of_freedom")
    """Degrees of freedom: six for each node, less the independent constraints."""
    members = Number("members")
    """Number of members: bodies, and connected beams, each taken as one rigid body."""
    mobility = Number("mobility")
    """Degrees of freedom that were left if all members were rigid: 0 is a structure, or a
    mechanism whose motion is prescribed; 6 more for each free body.
    """
    redundant_if_rigid = Number("redundant_if_rigid")
    """Constraints that would depend on others if all members were rigid."""
    parts = Number("parts")
    """Number of parts that nothing connects to each other, neither directly nor through the
    ground.
    """
    warnings = Number("warnings")
    """Number of warnings, which Model.describe writes out."""
    mass = Number("mass")
    """Total mass."""
    centre = Array("centre", (3,))
    """Centre of mass, in global coordinates; zero if there is no mass."""


class Branch(BranchExtras):
    """Periodic motions along a parameter. Made by FollowBranch, freed by BranchFree."""

    _free = lib.pdn_branch_free

    def switch_branch(
        self,
        point,
        amplitude,
        *,
        periodic=None,
        conditions=None,
        from_=None,
        to=None,
        motion_scale=None,
        first_step=None,
        smallest_step=None,
        largest_step=None,
        angle=None,
        point_limit=None,
        progress=None,
        downwards=None,
        events=None,
        stability=None,
    ):
        """Follows the other branch at a point where one begins: a branch point, or a period
        doubling, from where motions have twice the period, on one grid point less than twice as
        many.

        It begins where motions are `amplitude` away in the direction in which it leaves, and
        goes on away from there. That it cannot is no error: BranchEnd tells.

        Args:
            point: number of the point, from 0
            amplitude: length, of which 1 is a motion of `options.motion_scale`, of either sign;
                not zero
            periodic: Grid, tolerance and linear solver, where the first solve starts, and who
                is told of the iterations; None for the defaults. Grids are equispaced. Default
                None.
            conditions: What else is free along the branch, and as many conditions; None for
                nothing. Default None.
            from_: Least value of the parameter, where the branch ends.
            to: Largest value of the parameter, where the branch ends; more than `from`.
            motion_scale: What counts as 1 in motions, relative to the size of the mechanism and
                in radians; as the whole range does in the parameter. Default 1.
            first_step: Length of the first step: 1 is the whole range, or a motion of
                motion_scale. Default 0.02.
            smallest_step: Shortest step. Default 1e-6.
            largest_step: Longest step. Default 1.
            angle: Angle between the branch at neighbouring points that steps aim at [radians];
                steps by four thirds of it are taken again by half. Default 0.3.
            point_limit: Most points. Default 1000.
            progress: Told of each point; may end the branch. Default None.
            downwards: 1 if the parameter decreases at first. Default 0.
            events: 1 to look for branch points (where there are no conditions) and period
                doublings, too, by two more factorisations of the whole Jacobian a point.
                Default 0.
            stability: 1 to find the multipliers of each point, and with them torus points.
                Default 0.

        Returns:
            Branch: the other branch
        """
        options = BranchOptions(
            periodic=periodic,
            conditions=conditions,
            from_=from_,
            to=to,
            motion_scale=motion_scale,
            first_step=first_step,
            smallest_step=smallest_step,
            largest_step=largest_step,
            angle=angle,
            point_limit=point_limit,
            progress=progress,
            downwards=downwards,
            events=events,
            stability=stability,
        )
        out = ffi.new("pdn_branch **")
        call(lib.pdn_switch_branch, self._c, point, amplitude, options._c, out)
        return Branch._made(out[0], self._kept)

    def follow_locus(
        self,
        point,
        parameter,
        *,
        periodic=None,
        conditions=None,
        from_=None,
        to=None,
        motion_scale=None,
        first_step=None,
        smallest_step=None,
        largest_step=None,
        angle=None,
        point_limit=None,
        progress=None,
        downwards=None,
        events=None,
        stability=None,
    ):
        """Follows folds, period doublings or torus points along a second parameter, from one of
        them on a branch: that of the branch is free beside it.

        All points of what is returned are such points. Their `parameter` is the second one,
        that of the branch is Solution.parameter of their solutions. The CSV file has both.

        Args:
            point: number of the point, from 0
            parameter: id of the second parameter, or FREQUENCY
            periodic: Grid, tolerance and linear solver, where the first solve starts, and who
                is told of the iterations; None for the defaults. Grids are equispaced. Default
                None.
            conditions: What else is free along the branch, and as many conditions; None for
                nothing. Default None.
            from_: Least value of the parameter, where the branch ends.
            to: Largest value of the parameter, where the branch ends; more than `from`.
            motion_scale: What counts as 1 in motions, relative to the size of the mechanism and
                in radians; as the whole range does in the parameter. Default 1.
            first_step: Length of the first step: 1 is the whole range, or a motion of
                motion_scale. Default 0.02.
            smallest_step: Shortest step. Default 1e-6.
            largest_step: Longest step. Default 1.
            angle: Angle between the branch at neighbouring points that steps aim at [radians];
                steps by four thirds of it are taken again by half. Default 0.3.
            point_limit: Most points. Default 1000.
            progress: Told of each point; may end the branch. Default None.
            downwards: 1 if the parameter decreases at first. Default 0.
            events: 1 to look for branch points (where there are no conditions) and period
                doublings, too, by two more factorisations of the whole Jacobian a point.
                Default 0.
            stability: 1 to find the multipliers of each point, and with them torus points.
                Default 0.

        Returns:
            Branch: the points
        """
        options = BranchOptions(
            periodic=periodic,
            conditions=conditions,
            from_=from_,
            to=to,
            motion_scale=motion_scale,
            first_step=first_step,
            smallest_step=smallest_step,
            largest_step=largest_step,
            angle=angle,
            point_limit=point_limit,
            progress=progress,
            downwards=downwards,
            events=events,
            stability=stability,
        )
        out = ffi.new("pdn_branch **")
        call(lib.pdn_follow_locus, self._c, point, parameter, options._c, out)
        return Branch._made(out[0], self._kept)

    def continue_branch(
        self,
        *,
        periodic=None,
        conditions=None,
        from_=None,
        to=None,
        motion_scale=None,
        first_step=None,
        smallest_step=None,
        largest_step=None,
        angle=None,
        point_limit=None,
        progress=None,
        downwards=None,
        events=None,
        stability=None,
    ):
        """Follows a branch on from its last point, in the direction in which it came there: with a
        wider range, more points, a shorter smallest step.

        Args:
            periodic: Grid, tolerance and linear solver, where the first solve starts, and who
                is told of the iterations; None for the defaults. Grids are equispaced. Default
                None.
            conditions: What else is free along the branch, and as many conditions; None for
                nothing. Default None.
            from_: Least value of the parameter, where the branch ends.
            to: Largest value of the parameter, where the branch ends; more than `from`.
            motion_scale: What counts as 1 in motions, relative to the size of the mechanism and
                in radians; as the whole range does in the parameter. Default 1.
            first_step: Length of the first step: 1 is the whole range, or a motion of
                motion_scale. Default 0.02.
            smallest_step: Shortest step. Default 1e-6.
            largest_step: Longest step. Default 1.
            angle: Angle between the branch at neighbouring points that steps aim at [radians];
                steps by four thirds of it are taken again by half. Default 0.3.
            point_limit: Most points. Default 1000.
            progress: Told of each point; may end the branch. Default None.
            downwards: 1 if the parameter decreases at first. Default 0.
            events: 1 to look for branch points (where there are no conditions) and period
                doublings, too, by two more factorisations of the whole Jacobian a point.
                Default 0.
            stability: 1 to find the multipliers of each point, and with them torus points.
                Default 0.

        Returns:
            Branch: a branch with the points of the first and those that are new
        """
        options = BranchOptions(
            periodic=periodic,
            conditions=conditions,
            from_=from_,
            to=to,
            motion_scale=motion_scale,
            first_step=first_step,
            smallest_step=smallest_step,
            largest_step=largest_step,
            angle=angle,
            point_limit=point_limit,
            progress=progress,
            downwards=downwards,
            events=events,
            stability=stability,
        )
        out = ffi.new("pdn_branch **")
        call(lib.pdn_continue_branch, self._c, options._c, out)
        return Branch._made(out[0], self._kept)

    def save(self, path):
        """Saves a branch with its model and all its points.

        BranchLoad gives it back. Callbacks cannot be saved: see there. The format is the same
        on all platforms, and later versions of the library read it.

        Args:
            path: where to, UTF-8. A file that is there is replaced when all is written; if that
                fails it stays as it was
        """
        call(lib.pdn_branch_save, self._c, text(path))

    @staticmethod
    def load(path):
        """Loads a branch that BranchSave saved. It can be continued.

        If its model had callbacks, in signals or forces, solutions of its points and all that
        is followed from it fail with ERR_CALLBACK, as they are not there.

        Args:
            path: the file, UTF-8. It need not be trusted: its checksum and everything in it are
                checked

        Returns:
            Branch: the branch
        """
        out = ffi.new("pdn_branch **")
        call(lib.pdn_branch_load, text(path), out)
        return Branch._made(out[0], [])

    def end(self):
        """Why a branch ended."""
        return lib.pdn_branch_end(self._c)

    def report(self):
        """A readable report: points, events, and why the branch ended."""
        return text.of(lib.pdn_branch_report, self._c)

    def count(self):
        """Number of points of a branch.

        Returns:
            out: the number
        """
        out = ffi.new("int32_t *")
        call(lib.pdn_branch_count, self._c, out)
        return out[0]

    def get(self, point):
        """A point of a branch.

        Args:
            point: its number, from 0

        Returns:
            BranchPoint: the point, initialised
        """
        out = BranchPoint()
        call(lib.pdn_branch_get, self._c, point, out._c)
        return out

    def solution(self, point):
        """The solution at a point of a branch.

        Args:
            point: its number, from 0

        Returns:
            Solution: the solution
        """
        out = ffi.new("pdn_solution **")
        call(lib.pdn_branch_solution, self._c, point, out)
        return Solution._made(out[0], self._kept)

    def write_csv(self, path, quantities=None):
        """Writes a branch as CSV: a line for each point, with the parameter, how the step went,
        what happens there, what multipliers say if they were wanted (`BranchOptions.stability`)
        and, of each component of quantities, the mean, the size of the first harmonic, the
        least and the largest value over the period. `script/plot.py` draws it.

        Args:
            quantities: quantities, each
            path: name of the file, UTF-8; an existing file is replaced
        """
        quantities, _count = as_structs("Quantity", quantities or [], self._kept, "quantities")
        call(lib.pdn_branch_write_csv, self._c, quantities, _count, text(path))

    def write_campbell(
        self,
        path,
        blades=None,
        *,
        highest_frequency=None,
        tolerance=None,
        progress=None,
    ):
        """Writes a chart of the exponents of small disturbances along a branch as CSV, as of
        Campbell: of each point that is no event a line for each multiplier, but for conjugates
        and for those that only move the motion in time or space. `script/plot.py` draws it.

        A line has the parameter, the period, the rate of growth (real part of mu), the angular
        frequency of the mode in its nodes' own axes and from the ground, the size of the
        multiplier, the estimated error of that, and what moves: of a rotor with equal parts the
        pattern that is largest, and its share of their motions. It is `collective`,
        `alternating` (each part against its neighbours), or a number of nodal diameters,
        `progressive` where the pattern goes around in the sense of the rotation, `regressive`
        where against it, seen from the parts, or `standing`. Where no parts are named, or these
        hardly move, it is the node that moves most.

        Args:
            highest_frequency: Modes of up to this angular frequency matter [angle/time]; 0 for
                20 times that of the period. Default 0.
            tolerance: Estimated error of the multipliers of these modes, in units of 1 or of
                the multiplier where that is more. Default 1e-8.
            progress: Told about ten times a second that work goes on; may cancel. Default None.
            blades: ids of nodes, one of each of the equal parts, the same on all of them, one
                after the other around the rotor
            path: name of the file, UTF-8; an existing file is replaced
        """
        options = StabilityOptions(
            highest_frequency=highest_frequency,
            tolerance=tolerance,
            progress=progress,
        )
        blades = ids("blades", blades)
        _count = len(blades)
        call(
            lib.pdn_branch_write_campbell,
            self._c,
            options._c,
            ffi.from_buffer("int32_t[]", blades),
            _count,
            text(path),
        )


class Conditions(Handle):
    """Free parameters, and as many conditions. Made by Conditions.new, freed by Conditions.free.
    """

    _free = lib.pdn_conditions_free

    def __init__(self):
        """Makes an empty list: no parameter is free.

        It belongs to no model; ids are looked up when it is used.
        """
        out = ffi.new("pdn_conditions **")
        call(lib.pdn_conditions_new, out)
        self._own(out[0])

    def release(self, parameter):
        """Makes a parameter free: its value in the model is that to start from.

        Args:
            parameter: id of a parameter, or FREQUENCY for an unknown period
        """
        call(lib.pdn_conditions_release, self._c, parameter)

    def add_phase(self):
        """Adds the condition on the phase: the motion is not ahead of that which the solve starts
        from.

        For motions whose time nothing else tells: limit cycles, and free motions of a
        conservative system.
        """
        call(lib.pdn_conditions_add_phase, self._c)

    def add_rotation_phase(self, axis, point=None):
        """Adds the condition on the phase of a rotation: in the mean over the period and all
        nodes, the motion is not turned about an axis from that which the solve starts from.

        For mechanisms that nothing holds against it, such as a pendulum in a spherical joint,
        whose turn in a period is unknown (Model.set_turning_frame).

        Args:
            axis: array of shape (3): direction of the axis, not zero
            point: array of shape (3): a point of the axis [length]; None for the origin
        """
        axis = reals("axis", axis, (3,))
        point = reals("point", point, (3,))
        call(lib.pdn_conditions_add_rotation_phase, self._c, pointer(axis), pointer(point))

    def add_translation_phase(self, direction):
        """Adds the condition on the phase of a translation: in the mean over the period and all
        nodes, the motion is not moved in a direction from that which the solve starts from.

        For mechanisms that nothing holds against it, such as a free body.

        Args:
            direction: array of shape (3): the direction, not zero
        """
        direction = reals("direction", direction, (3,))
        call(lib.pdn_conditions_add_translation_phase, self._c, pointer(direction))

    def add_quantity(self, quantity, feature, at, value, scale=0.0):
        """Adds the condition that the mean, a harmonic, or the value at a time, of a quantity is
        this: trim.

        Args:
            quantity: one component of a quantity,
            feature: FEATURE_MEAN, FEATURE_COSINE, FEATURE_SINE or FEATURE_VALUE
            at: the number of the harmonic, from 1, or the time; not looked at for the mean
            value: the value
            scale: what counts as 1 in it, such as the largest that it may be; usually 0, for
                what does in such quantities of the mechanism
        """
        quantity = of_type("Quantity")(quantity, self._kept, "quantity")
        call(lib.pdn_conditions_add_quantity, self._c, quantity, feature, at, value, scale)

    def add_joint_coordinate(self, joint, coordinate, value):
        """Adds the condition that a joint coordinate has a value at the start of the period.

        With Conditions.add_phase, and a start that turns back at time zero, it is the amplitude
        of a free motion.

        Args:
            joint: id of the joint
            coordinate: DISPLACEMENT, ... or ROTATION,
            value: the value
        """
        call(lib.pdn_conditions_add_joint_coordinate, self._c, joint, coordinate, value)

    def add_energy(self, energy):
        """Adds the condition that the mean of the kinetic and the potential energy over the period
        is a value.

        Weights have no energy at the origin. The energy of weights, of springs on joint
        coordinates and of beams is known; a model with other forces is refused.

        Args:
            energy: the value [force * length]
        """
        call(lib.pdn_conditions_add_energy, self._c, energy)

    def add_momentum(self, direction, momentum):
        """Adds the condition that the mean momentum in a direction is a value.

        The momentum in the inertial frame is meant, also where the model is described in a
        frame that turns.

        Args:
            direction: array of shape (3): the direction, not zero
            momentum: the value [mass * length / time]
        """
        direction = reals("direction", direction, (3,))
        call(lib.pdn_conditions_add_momentum, self._c, pointer(direction), momentum)

    def add_angular_momentum(self, axis, momentum, point=None):
        """Adds the condition that the mean angular momentum about an axis is a value.

        With Model.set_turning_frame, of a free body that tumbles. The angular momentum in the
        inertial frame is meant, also where the model is described in a frame that turns.

        Args:
            axis: array of shape (3): direction of the axis, not zero
            point: array of shape (3): a point of the axis [length]; None for the origin
            momentum: the value [mass * length^2 / time]
        """
        axis = reals("axis", axis, (3,))
        point = reals("point", point, (3,))
        call(
            lib.pdn_conditions_add_angular_momentum,
            self._c,
            pointer(axis),
            pointer(point),
            momentum,
        )


class Model(ModelExtras):
    """A mechanism. Made by Model.new, freed by Model.free.

    It is described in its reference configuration: points, directions and frames are those of
    the undeformed, assembled mechanism, all in the global axes, which are fixed to the ground.
    Any consistent set of units will do (such as metre, newton, kilogram, second); angles are in
    radians.

    All that is added has an id, in the order in which it was added: nodes from FIRST_NODE on,
    joints from FIRST_JOINT on, and so on. A call that fails leaves the model as it was.
    """

    _free = lib.pdn_model_free

    def __init__(self):
        """Makes an empty model."""
        model = ffi.new("pdn_model **")
        call(lib.pdn_model_new, model)
        self._own(model[0])

    def node_count(self):
        """Number of nodes; their ids follow each other from FIRST_NODE on.

        Returns:
            count: the number
        """
        count = ffi.new("int32_t *")
        call(lib.pdn_model_node_count, self._c, count)
        return count[0]

    def joint_count(self):
        """Number of joints; their ids follow each other from FIRST_JOINT on.

        Returns:
            count: the number
        """
        count = ffi.new("int32_t *")
        call(lib.pdn_model_joint_count, self._c, count)
        return count[0]

    def element_count(self):
        """Number of beam elements; their ids follow each other from FIRST_BEAM_ELEMENT on.

        Returns:
            count: the number
        """
        count = ffi.new("int32_t *")
        call(lib.pdn_model_element_count, self._c, count)
        return count[0]

    def mass(self):
        """Total mass and centre of mass in the reference configuration.

        Returns:
            mass: total mass of bodies, masses and beams [mass]
            centre, of shape (3): centre of mass, global coordinates [length]
        """
        mass = ffi.new("double *")
        centre = reals.empty((3,))
        call(lib.pdn_model_mass, self._c, mass, pointer(centre))
        return mass[0], centre

    def node_frame(self, node):
        """Frame of a node in the reference configuration.

        Args:
            node: id of the node

        Returns:
            Frame: its frame
        """
        frame = Frame()
        call(lib.pdn_model_node_frame, self._c, node, frame._c)
        return frame

    def add_node(self, position, rotation=None):
        """Adds a node: a frame that moves.

        A node needs something that holds or moves it: mass, a beam or a joint.

        Args:
            position: array of shape (3): its position, global coordinates [length]
            rotation: array of shape (3, 3): its axes, a rotation matrix column by column, the
                columns being axes 1, 2, 3 in global coordinates; None for axes parallel to the
                global ones

        Returns:
            node: the node's id
        """
        position = reals("position", position, (3,))
        rotation = reals("rotation", rotation, (3, 3), turned=True)
        node = ffi.new("int32_t *")
        call(lib.pdn_model_add_node, self._c, pointer(position), pointer(rotation), node)
        return node[0]

    def add_rigid_body(self, mass, centre, inertia):
        """Adds a rigid body: a node at its centre of mass, with axes parallel to the global ones.

        Its inertia has an id, Model.inertia_of, by which a parameter can move it.

        Args:
            mass: mass, positive [mass]
            centre: array of shape (3): centre of mass, global coordinates [length]
            inertia: array of shape (3, 3): moments of inertia about the centre of mass, in
                global axes, symmetric and positive semi-definite [mass * length^2]

        Returns:
            node: the node's id
        """
        centre = reals("centre", centre, (3,))
        inertia = reals("inertia", inertia, (3, 3))
        node = ffi.new("int32_t *")
        call(lib.pdn_model_add_rigid_body, self._c, mass, pointer(centre), pointer(inertia), node)
        return node[0]

    def add_mass(self, node, mass, centre, inertia=None):
        """Fixes a mass to a node, in addition to what the node has.

        Args:
            node: id of the node
            mass: mass, zero or more [mass]
            centre: array of shape (3): its centre, global coordinates; need not be at the node
                [length]
            inertia: array of shape (3, 3): moments of inertia about the centre, in global axes,
                symmetric and positive semi-definite [mass * length^2]; None for a point mass

        Returns:
            id: id of the inertia
        """
        centre = reals("centre", centre, (3,))
        inertia = reals("inertia", inertia, (3, 3))
        id = ffi.new("int32_t *")
        call(lib.pdn_model_add_mass, self._c, node, mass, pointer(centre), pointer(inertia), id)
        return id[0]

    def add_inertia(self, node, matrix, frame=None):
        """Fixes an inertia of any kind to a node, in addition to what the node has.

        A unit velocity of the frame (linear 1, 2, 3, angular 1, 2, 3) has the momentum (linear,
        angular) of the matrix's column. A rigid body of mass m, with centre c and moments of
        inertia J about the centre, both in the frame, has [m I, -m c~; m c~, J - m c~ c~],
        where c~ b = c * b.

        Args:
            node: id of the node
            frame: the frame that the matrix is about and resolved in; None for the node's own
            matrix: array of shape (6, 6): symmetric and positive semi-definite [mass, mass *
                length, mass * length^2]

        Returns:
            id: id of the inertia
        """
        frame = of_type("Frame")(frame, self._kept, "frame")
        matrix = reals("matrix", matrix, (6, 6), turned=True)
        id = ffi.new("int32_t *")
        call(lib.pdn_model_add_inertia, self._c, node, frame, pointer(matrix), id)
        return id[0]

    def prescribe(self, joint, coordinate, signal):
        """Makes a joint coordinate follow a signal. Each coordinate can be prescribed once.

        The signal of an angle may grow by whole turns in a period, save that of a screw.

        Args:
            joint: id of the joint
            coordinate: DISPLACEMENT ... ROTATION_3; one that the joint has
            signal: the coordinate in time [length, or radian], copied; a number, a Signal, or a
                function of time

        Returns:
            prescribed: id of the prescribed coordinate
        """
        signal = as_signal(signal, self._kept, "signal")
        prescribed = ffi.new("int32_t *")
        call(lib.pdn_model_prescribe, self._c, joint, coordinate, signal, prescribed)
        return prescribed[0]

    def add_rigid_joint(self, first, second, point):
        """Fixes two bodies to each other.

        Its frames are at the point, with axes parallel to the global ones in the reference
        configuration. It has no coordinates.

        Args:
            first: id of the first node, or GROUND
            second: id of the second node, or GROUND; not the same body
            point: array of shape (3): where the reaction is reported, global coordinates
                [length]

        Returns:
            joint: the joint's id
        """
        point = reals("point", point, (3,))
        joint = ffi.new("int32_t *")
        call(lib.pdn_model_add_rigid_joint, self._c, first, second, pointer(point), joint)
        return joint[0]

    def add_revolute(self, first, second, point, axis):
        """Joins two bodies by a hinge.

        Its frames are at the point, with axis 3 along the axis. Its coordinate ROTATION is the
        angle by which the second body has turned relative to the first, about the axis by the
        right-hand rule, since the reference configuration, where it is zero; it counts whole
        turns.

        Args:
            first: id of the first node, or GROUND
            second: id of the second node, or GROUND; not the same body
            point: array of shape (3): a point of the axis, global coordinates [length]
            axis: array of shape (3): direction of the axis, global coordinates, of any nonzero
                length

        Returns:
            joint: the joint's id
        """
        point = reals("point", point, (3,))
        axis = reals("axis", axis, (3,))
        joint = ffi.new("int32_t *")
        call(
            lib.pdn_model_add_revolute,
            self._c,
            first,
            second,
            pointer(point),
            pointer(axis),
            joint,
        )
        return joint[0]

    def add_prismatic(self, first, second, point, axis):
        """Joins two bodies by a slider.

        Its frames are at the point, with axis 3 along the axis. Its coordinate DISPLACEMENT is
        the distance by which the second body has moved relative to the first, along the axis,
        since the reference configuration, where it is zero. The bodies do not turn relative to
        each other.

        Args:
            first: id of the first node, or GROUND
            second: id of the second node, or GROUND; not the same body
            point: array of shape (3): a point of the axis, global coordinates [length]
            axis: array of shape (3): direction of the axis, global coordinates, of any nonzero
                length

        Returns:
            joint: the joint's id
        """
        point = reals("point", point, (3,))
        axis = reals("axis", axis, (3,))
        joint = ffi.new("int32_t *")
        call(
            lib.pdn_model_add_prismatic,
            self._c,
            first,
            second,
            pointer(point),
            pointer(axis),
            joint,
        )
        return joint[0]

    def add_cylindrical(self, first, second, point, axis):
        """Joins two bodies by a shaft in a sleeve: one slides along the axis and turns about it.

        Its frames are at the point, with axis 3 along the axis. Its coordinates DISPLACEMENT
        and ROTATION are the distance and the angle by which the second body has moved relative
        to the first, along the axis and about it by the right-hand rule, since the reference
        configuration, where they are zero.

        Args:
            first: id of the first node, or GROUND
            second: id of the second node, or GROUND; not the same body
            point: array of shape (3): a point of the axis, global coordinates [length]
            axis: array of shape (3): direction of the axis, global coordinates, of any nonzero
                length

        Returns:
            joint: the joint's id
        """
        point = reals("point", point, (3,))
        axis = reals("axis", axis, (3,))
        joint = ffi.new("int32_t *")
        call(
            lib.pdn_model_add_cylindrical,
            self._c,
            first,
            second,
            pointer(point),
            pointer(axis),
            joint,
        )
        return joint[0]

    def add_screw(self, first, second, point, axis, pitch):
        """Joins two bodies by a screw: the second advances along the axis as it turns about it.

        Its frames are at the point, with axis 3 along the axis. Its coordinates are those of a
        cylindrical joint, and DISPLACEMENT = pitch ROTATION / (2 pi). The displacement tells
        the whole turns of the angle, so that unlike other angles it cannot gain any in a
        period.

        Args:
            first: id of the first node, or GROUND
            second: id of the second node, or GROUND; not the same body
            point: array of shape (3): a point of the axis, global coordinates [length]
            axis: array of shape (3): direction of the axis, global coordinates, of any nonzero
                length
            pitch: advance for one turn [length]; positive for a right-handed thread, negative
                for a left-handed one, not zero

        Returns:
            joint: the joint's id
        """
        point = reals("point", point, (3,))
        axis = reals("axis", axis, (3,))
        joint = ffi.new("int32_t *")
        call(
            lib.pdn_model_add_screw,
            self._c,
            first,
            second,
            pointer(point),
            pointer(axis),
            pitch,
            joint,
        )
        return joint[0]

    def add_planar(self, first, second, point, normal):
        """Joins two bodies by a pair of planes that slide and turn on each other.

        Its frames are at the point, with axis 3 along the normal; axes 1 and 2 are found by the
        library, see Model.add_joint to choose them. Its coordinates are the displacements of
        the second body along axes 1 and 2 of the first frame (DISPLACEMENT, DISPLACEMENT_2) and
        the angle by which it has turned relative to the first, about the normal by the
        right-hand rule (ROTATION), since the reference configuration, where they are zero.

        Args:
            first: id of the first node, or GROUND
            second: id of the second node, or GROUND; not the same body
            point: array of shape (3): a point of the plane, whose displacement is measured,
                global coordinates [length]
            normal: array of shape (3): normal of the plane, global coordinates, of any nonzero
                length

        Returns:
            joint: the joint's id
        """
        point = reals("point", point, (3,))
        normal = reals("normal", normal, (3,))
        joint = ffi.new("int32_t *")
        call(
            lib.pdn_model_add_planar,
            self._c,
            first,
            second,
            pointer(point),
            pointer(normal),
            joint,
        )
        return joint[0]

    def add_free_joint(self, first, second, point):
        """Joins two bodies by nothing: a joint that constrains no motion, but has coordinates.

        It carries springs and dampers, prescribed coordinates and measures between any two
        bodies. Its frames are at the point, with axes parallel to the global ones in the
        reference configuration. Its coordinates are the displacements of the second body along
        axes 1, 2, 3 of the first frame (DISPLACEMENT, DISPLACEMENT_2, DISPLACEMENT_3), and the
        angles of a spherical joint (ROTATION, ROTATION_2, ROTATION_3).

        Args:
            first: id of the first node, or GROUND
            second: id of the second node, or GROUND; not the same body
            point: array of shape (3): whose displacement is measured, global coordinates
                [length]

        Returns:
            joint: the joint's id
        """
        point = reals("point", point, (3,))
        joint = ffi.new("int32_t *")
        call(lib.pdn_model_add_free_joint, self._c, first, second, pointer(point), joint)
        return joint[0]

    def add_spherical(self, first, second, point):
        """Joins two bodies by a ball.

        Its frames are at the point, with axes parallel to the global ones in the reference
        configuration. Its coordinates ROTATION, ROTATION_2, ROTATION_3 are the angles by which
        the second frame comes from the first by turning about axis 1, then about its own axis
        2, then about its own axis 3; zero in the reference configuration. The second must stay
        between -pi/2 and pi/2.

        Args:
            first: id of the first node, or GROUND
            second: id of the second node, or GROUND; not the same body
            point: array of shape (3): centre of the ball, global coordinates [length]

        Returns:
            joint: the joint's id
        """
        point = reals("point", point, (3,))
        joint = ffi.new("int32_t *")
        call(lib.pdn_model_add_spherical, self._c, first, second, pointer(point), joint)
        return joint[0]

    def add_universal(self, first, second, point, first_arm, second_arm):
        """Joins two bodies by a cross (Cardan, Hooke).

        One arm of the cross turns in the first body, the other in the second. Its frames are at
        the point, with axis 1 along the first arm, axis 2 along the second, in the reference
        configuration. Its coordinates are the angle of the cross relative to the first body
        about first_arm (ROTATION), and of the second body relative to the cross about
        second_arm (ROTATION_2), both by the right-hand rule and zero in the reference
        configuration.

        Args:
            first: id of the first node, or GROUND
            second: id of the second node, or GROUND; not the same body
            point: array of shape (3): centre of the cross, global coordinates [length]
            first_arm: array of shape (3): direction of the arm fixed to the first body, global
                coordinates, of any nonzero length
            second_arm: array of shape (3): that of the arm fixed to the second body,
                perpendicular

        Returns:
            joint: the joint's id
        """
        point = reals("point", point, (3,))
        first_arm = reals("first_arm", first_arm, (3,))
        second_arm = reals("second_arm", second_arm, (3,))
        joint = ffi.new("int32_t *")
        call(
            lib.pdn_model_add_universal,
            self._c,
            first,
            second,
            pointer(point),
            pointer(first_arm),
            pointer(second_arm),
            joint,
        )
        return joint[0]

    def add_strut(self, first, second, first_point, second_point):
        """Adds a strut: the line between a point of each of two bodies. It constrains nothing.

        Its coordinate DISPLACEMENT is the distance of the points. Springs, dampers, actuators
        and other forces on that coordinate act along the line: an effort against its growth is
        a tension, and the rest of a spring its free length. Prescribed, it is a rod without
        mass, of constant or varying length. The points must not meet while a force acts.

        Args:
            first: id of the first node, or GROUND
            second: id of the second node, or GROUND; not the same body
            first_point: array of shape (3): the point of the first body in the reference
                configuration, global coordinates [length]
            second_point: array of shape (3): that of the second body, not the same

        Returns:
            joint: the joint's id
        """
        first_point = reals("first_point", first_point, (3,))
        second_point = reals("second_point", second_point, (3,))
        joint = ffi.new("int32_t *")
        call(
            lib.pdn_model_add_strut,
            self._c,
            first,
            second,
            pointer(first_point),
            pointer(second_point),
            joint,
        )
        return joint[0]

    def add_joint(self, kind, first, second, first_frame, second_frame):
        """Joins two bodies by a joint of any kind, between a frame fixed to each.

        The frames need not fit each other in the reference configuration: the solver closes the
        joint. With r = (r1, r2, r3) and R the position and rotation of the second frame
        relative to the first, and resolved in it, the closed joint has

        | kind | r | R | coordinates |
        |---|---|---|---|
        | JOINT_RIGID | 0 | I | none |
        | JOINT_REVOLUTE | 0 | R3(a) | a = ROTATION |
        | JOINT_PRISMATIC | (0, 0, z) | I | z = DISPLACEMENT |
        | JOINT_CYLINDRICAL | (0, 0, z) | R3(a) | z = DISPLACEMENT, a = ROTATION |
        | JOINT_PLANAR | (x, y, 0) | R3(a) | x = DISPLACEMENT, y = DISPLACEMENT_2, and a |
        | JOINT_UNIVERSAL | 0 | R1(a) R2(b) | a = ROTATION, b = ROTATION_2 |
        | JOINT_SPHERICAL | 0 | R1(a) R2(b) R3(c) | and c = ROTATION_3 |
        | JOINT_FREE | (x, y, z) | R1(a) R2(b) R3(c) | all of these, z = DISPLACEMENT_3 |

        where Rk(x) turns by x about axis k, right-handed. Angles count whole turns. A screw has
        a pitch besides: Model.add_screw_between.

        Args:
            kind: JOINT_RIGID ... JOINT_FREE
            first: id of the first node, or GROUND
            second: id of the second node, or GROUND; not the same body
            first_frame: frame fixed to the first body, where it is in the reference
                configuration
            second_frame: frame fixed to the second body, likewise

        Returns:
            joint: the joint's id
        """
        first_frame = of_type("Frame")(first_frame, self._kept, "first_frame")
        second_frame = of_type("Frame")(second_frame, self._kept, "second_frame")
        joint = ffi.new("int32_t *")
        call(
            lib.pdn_model_add_joint,
            self._c,
            kind,
            first,
            second,
            first_frame,
            second_frame,
            joint,
        )
        return joint[0]

    def add_screw_between(self, first, second, first_frame, second_frame, pitch):
        """Joins two bodies by a screw, between a frame fixed to each.

        As Model.add_joint with frames: the closed joint has r = (0, 0, pitch a / (2 pi)) and R
        = R3(a), with the coordinates DISPLACEMENT = r3 and ROTATION = a. Where the frames do
        not fit each other in the reference configuration, the solver takes the thread's turn
        that is nearest.

        Args:
            first: id of the first node, or GROUND
            second: id of the second node, or GROUND; not the same body
            first_frame: frame fixed to the first body, where it is in the reference
                configuration
            second_frame: frame fixed to the second body, likewise
            pitch: advance for one turn [length]; positive for a right-handed thread, negative
                for a left-handed one, not zero

        Returns:
            joint: the joint's id
        """
        first_frame = of_type("Frame")(first_frame, self._kept, "first_frame")
        second_frame = of_type("Frame")(second_frame, self._kept, "second_frame")
        joint = ffi.new("int32_t *")
        call(
            lib.pdn_model_add_screw_between,
            self._c,
            first,
            second,
            first_frame,
            second_frame,
            pitch,
            joint,
        )
        return joint[0]

    def relation_count(self):
        """Number of linear relations between joint coordinates; their ids follow each other from
        FIRST_RELATION on.

        Returns:
            count: the number
        """
        count = ffi.new("int32_t *")
        call(lib.pdn_model_relation_count, self._c, count)
        return count[0]

    def add_relation(self, joints, coordinates, coefficients, signal=None):
        """Adds a linear relation between joint coordinates: gears, belts, racks, differentials.

        It keeps the sum of coefficients[i] * q[i] equal to a signal, with q[i] coordinate
        coordinates[i] of joint joints[i], whole turns counted. Gears that turn q1 by n q2 have
        coefficients 1 and -n, a rack on a pinion of radius r 1 and -r, a differential 1, 1 and
        -2. It exerts an effort on each of the coordinates, in proportion to the coefficients:
        RELATION_EFFORT. Where angles that are prescribed turn on and on, those that they turn
        by relations must gain whole turns in a period as well; a solve refuses others with
        ERR_NOT_PERIODIC, and tells a period that would do.

        Args:
            joints: ids of the joints
            coordinates: DISPLACEMENT ... ROTATION_3 of each, one that the joint has; each
                coordinate of a joint at most once
            coefficients: array of shape (count): numbers other than zero, in units that make
                the terms of the sum alike
            signal: what the sum is in time, copied; it must return to its value after a period.
                None for what the sum is in the reference configuration; a number, a Signal, or
                a function of time

        Returns:
            relation: the relation's id
        """
        joints = ids("joints", joints)
        _count = len(joints)
        coordinates = ids("coordinates", coordinates)
        like("coordinates", coordinates, (_count,))
        coefficients = reals("coefficients", coefficients, (_count,))
        signal = as_signal(signal, self._kept, "signal")
        relation = ffi.new("int32_t *")
        call(
            lib.pdn_model_add_relation,
            self._c,
            ffi.from_buffer("int32_t[]", joints),
            ffi.from_buffer("int32_t[]", coordinates),
            pointer(coefficients),
            _count,
            signal,
            relation,
        )
        return relation[0]

    def add_beam_element(self, nodes, section):
        """Adds a beam element over nodes that are there; it may be curved and twisted.

        The nodes stand, in order, at the Gauss-Lobatto points along the beam; two are its ends.
        Axis 1 of each node is along the beam (to within 60 degrees, for curved ones), axes 2
        and 3 are those of the section. The element's reference shape interpolates them, and is
        free of stress.

        Elements may share end nodes, in chains and where beams branch, but not otherwise;
        elements that would lie on each other are refused.

        Args:
            nodes: ids of the nodes, all different
            section: cross-section, with positive-definite stiffness

        Returns:
            element: the element's id
        """
        nodes = ids("nodes", nodes)
        _count = len(nodes)
        section = of_type("Section")(section, self._kept, "section")
        element = ffi.new("int32_t *")
        call(
            lib.pdn_model_add_beam_element,
            self._c,
            ffi.from_buffer("int32_t[]", nodes),
            _count,
            section,
            element,
        )
        return element[0]

    def add_straight_beam(self, start, end, axis_2, section, elements, degree):
        """Adds a straight beam: its nodes and elements.

        Axis 1 of every node is along the beam, from start to end; axis 2 is the part of axis_2
        that is perpendicular to it; axis 3 = axis 1 * axis 2. Beams are joined by joints
        between their nodes, or by Model.add_rigid_joint.

        Args:
            start: array of shape (3): where the beam starts, global coordinates [length]
            end: array of shape (3): where it ends, not at start
            axis_2: array of shape (3): direction of axis 2 of the section, global coordinates,
                of any nonzero length, not along the beam
            section: cross-section, with positive-definite stiffness
            elements: number of elements, 1 to 1000000
            degree: polynomial degree of the elements, 1 to 24; an element has degree + 1 nodes

        Returns:
            Beam: ids of what was made
        """
        start = reals("start", start, (3,))
        end = reals("end", end, (3,))
        axis_2 = reals("axis_2", axis_2, (3,))
        section = of_type("Section")(section, self._kept, "section")
        elements = whole("elements", elements)
        degree = whole("degree", degree)
        beam = Beam()
        call(
            lib.pdn_model_add_straight_beam,
            self._c,
            pointer(start),
            pointer(end),
            pointer(axis_2),
            section,
            elements,
            degree,
            beam._c,
        )
        return beam

    def add_beam(self, line, stations, elements, degree):
        """Adds a beam along a line, with sections that may vary: its nodes and elements.

        Axis 1 of every node is along the line; axes 2 and 3 are those of the line, turned by
        the twist. The mesh is even but for jumps of the section, where an element ends and the
        next begins; so there must be more elements than jumps. Stations may lie anywhere:
        elements are integrated from each to the next. Where slopes of section or twist jump
        inside an element, degrees gain less accuracy all the same.

        Beams are joined by joints between their nodes. To fix a beam's end to a body at a
        distance, use Model.add_rigid_joint between the two nodes: they need not be at the same
        place.

        Args:
            line: reference line
            stations: cross-sections along it
            elements: number of elements, 1 to 1000000
            degree: polynomial degree of the elements, 1 to 24; an element has degree + 1 nodes

        Returns:
            Beam: ids of what was made
        """
        line = of_type("Line")(line, self._kept, "line")
        stations = of_type("Stations")(stations, self._kept, "stations")
        elements = whole("elements", elements)
        degree = whole("degree", degree)
        beam = Beam()
        call(lib.pdn_model_add_beam, self._c, line, stations, elements, degree, beam._c)
        return beam

    def add_beam_between(self, line, stations, boundaries, degree):
        """Adds a beam along a line as Model.add_beam does, with elements between given places.

        For meshes that follow the stations of a section, give their fractions, each once; an
        element ends and the next begins at every jump of the section.

        Args:
            line: reference line
            stations: cross-sections along it
            boundaries: array of shape (count): places along the span where elements begin and
                end, from 0 at the start to 1 at the end, ascending, with all jumps among them
            degree: polynomial degree of the elements, 1 to 24; an element has degree + 1 nodes

        Returns:
            Beam: ids of what was made
        """
        line = of_type("Line")(line, self._kept, "line")
        stations = of_type("Stations")(stations, self._kept, "stations")
        boundaries = reals("boundaries", boundaries, (None,))
        _count = len(boundaries)
        degree = whole("degree", degree)
        beam = Beam()
        call(
            lib.pdn_model_add_beam_between,
            self._c,
            line,
            stations,
            pointer(boundaries),
            _count,
            degree,
            beam._c,
        )
        return beam

    def add_load(self, node, frame, component, signal):
        """Adds one component of a force or moment on a node, in addition to those that are there.

        A force acts at the node's origin; Model.add_load_at_point takes another point.

        Args:
            node: id of the node
            frame: FRAME_SPACE: directions of the global axes; FRAME_MATERIAL: of the node's
                axes, which the load follows
            component: FORCE_1, FORCE_2, FORCE_3 [force], MOMENT_1, MOMENT_2 or MOMENT_3 [force
                * length]
            signal: the component in time, copied; a number, a Signal, or a function of time

        Returns:
            load: the load's id
        """
        signal = as_signal(signal, self._kept, "signal")
        load = ffi.new("int32_t *")
        call(lib.pdn_model_add_load, self._c, node, frame, component, signal, load)
        return load[0]

    def add_load_at_point(self, node, offset, frame, component, signal):
        """Adds one component of a force or moment at a point that a node carries, in addition to
        those that are there: such as a thrust that acts off the node of a body.

        The point moves with the node, and so does the arm of the force about the node.

        Args:
            node: id of the node
            offset: array of shape (3): the point, from the node's origin, along the node's axes
                [length]
            frame: FRAME_SPACE: directions of the global axes; FRAME_MATERIAL: of the node's
                axes, which the load follows
            component: FORCE_1, FORCE_2, FORCE_3 [force], MOMENT_1, MOMENT_2 or MOMENT_3 [force
                * length]
            signal: the component in time, copied; a number, a Signal, or a function of time

        Returns:
            load: the load's id
        """
        offset = reals("offset", offset, (3,))
        signal = as_signal(signal, self._kept, "signal")
        load = ffi.new("int32_t *")
        call(
            lib.pdn_model_add_load_at_point,
            self._c,
            node,
            pointer(offset),
            frame,
            component,
            signal,
            load,
        )
        return load[0]

    def add_load_on_beam(
        self,
        first_element,
        elements,
        fraction,
        frame,
        component,
        signal,
        offset=None,
    ):
        """Adds one component of a force or moment at a fraction of the span of a beam, in addition
        to those that are there.

        It moves with the section there. Internal forces jump at such a place, which an element
        smooths unless a node is there: next to the load they are more accurate on a mesh with a
        boundary there, as Model.add_beam_between makes it. The ends of elements are nodes.

        Args:
            first_element: id of the first beam element, such as the first_element of a Beam
            elements: number of elements, from the first on, such as the elements of a Beam; at
                least 1
            fraction: the place, as a fraction of the reference length of these elements, from 0
                to 1
            offset: array of shape (3): the point, from the line of the beam, along the
                section's axes [length]; None for a point of the line
            frame: FRAME_SPACE: directions of the global axes; FRAME_MATERIAL: of the section's
                axes, which the load follows
            component: FORCE_1, FORCE_2, FORCE_3 [force], MOMENT_1, MOMENT_2 or MOMENT_3 [force
                * length]
            signal: the component in time, copied; a number, a Signal, or a function of time

        Returns:
            load: the load's id, as of a load on a node
        """
        offset = reals("offset", offset, (3,))
        signal = as_signal(signal, self._kept, "signal")
        load = ffi.new("int32_t *")
        call(
            lib.pdn_model_add_load_on_beam,
            self._c,
            first_element,
            elements,
            fraction,
            pointer(offset),
            frame,
            component,
            signal,
            load,
        )
        return load[0]

    def set_gravity(self, acceleration):
        """Sets the acceleration of gravity, in place of any set before. Without this call there is
        none.

        Args:
            acceleration: array of shape (3): such as {0, 0, -9.81}, global axes [length /
                time^2]
        """
        acceleration = reals("acceleration", acceleration, (3,))
        call(lib.pdn_model_set_gravity, self._c, pointer(acceleration))

    def set_gravity_signals(self, acceleration_1=None, acceleration_2=None, acceleration_3=None):
        """Sets an acceleration of gravity that varies in time, in place of any set before.

        So a shaking ground can be described in axes that shake with it.

        Args:
            acceleration_1: component along global axis 1 [length / time^2], copied; None for
                none; a number, a Signal, or a function of time
            acceleration_2: component along global axis 2, copied; None for none; a number, a
                Signal, or a function of time
            acceleration_3: component along global axis 3, copied; None for none; a number, a
                Signal, or a function of time
        """
        acceleration_1 = as_signal(acceleration_1, self._kept, "acceleration_1")
        acceleration_2 = as_signal(acceleration_2, self._kept, "acceleration_2")
        acceleration_3 = as_signal(acceleration_3, self._kept, "acceleration_3")
        call(
            lib.pdn_model_set_gravity_signals,
            self._c,
            acceleration_1,
            acceleration_2,
            acceleration_3,
        )

    def add_distributed_load(
        self,
        first_element,
        elements,
        frame,
        component,
        signal,
        fractions=None,
        factors=None,
    ):
        """Adds one component of a force or moment distributed along beam elements, in addition to
        those that are there.

        It acts on the line of the beam, for each unit of its reference length, and moves with
        the sections: signal times factor.

        Args:
            first_element: id of the first beam element, such as the first_element of a Beam
            elements: number of elements, from the first on, such as the elements of a Beam; at
                least 1
            frame: FRAME_SPACE: directions of the global axes; FRAME_MATERIAL: of the sections'
                axes, which the load follows
            component: FORCE_1, FORCE_2, FORCE_3 [force / length], MOMENT_1, MOMENT_2 or
                MOMENT_3 [force]
            signal: the component in time, copied; a number, a Signal, or a function of time
            fractions: array of shape (count): places, as fractions of the reference length of
                these elements, ascending from 0 to 1; two at the same place make a jump. None
                if count is 0
            factors: array of shape (count): factors of the signal at these places, linear in
                between; None if count is 0

        Returns:
            load: the load's id, a beam load's
        """
        signal = as_signal(signal, self._kept, "signal")
        fractions, factors, _count = together(fractions=fractions, factors=factors)
        load = ffi.new("int32_t *")
        call(
            lib.pdn_model_add_distributed_load,
            self._c,
            first_element,
            elements,
            frame,
            component,
            signal,
            pointer(fractions),
            pointer(factors),
            _count,
            load,
        )
        return load[0]

    def add_load_at_places(self, first_element, elements, frame, fractions, signals, axis_2=None):
        """Adds a force and moment distributed along beam elements, all components at all places at
        once, in addition to those that are there: such as the air loads of a blade, at the
        places where these are computed.

        It acts on the line of the beam, for each unit of its reference length, and moves with
        the sections. It is linear between neighbouring places. However many there are, the beam
        is evaluated as for one. Each place is a beam load with an id of its own.

        Args:
            first_element: id of the first beam element, such as the first_element of a Beam
            elements: number of elements, from the first on, such as the elements of a Beam; at
                least 1
            frame: FRAME_SPACE: directions of the global axes; FRAME_MATERIAL: of the sections'
                axes, twisted as they are; FRAME_UNTWISTED: axis 1 along the reference line,
                axis 2 the part of axis_2 that is perpendicular to it, axis 3 = axis 1 * axis 2,
                all in the reference configuration, and each section takes these axes with it
            axis_2: array of shape (3): direction, global coordinates, of any nonzero length,
                nowhere along the line; read for FRAME_UNTWISTED only, else it
            fractions: array of shape (count): places, as fractions of the reference length of
                these elements, ascending from 0 to 1; two at the same place make a jump
            signals: array of shape 6 x [count], each initialised, copied: those of the first
                place, FORCE_1 to FORCE_3 [force / length] and MOMENT_1 to MOMENT_3 [force],
                then those of the next. One that was only initialised is zero; numbers, Signals,
                or functions of time

        Returns:
            first_load: id of the beam load at the first place; those at the others follow
        """
        axis_2 = reals("axis_2", axis_2, (3,))
        fractions = reals("fractions", fractions, (None,))
        _count = len(fractions)
        signals = as_signals(signals, (_count, 6), self._kept)
        first_load = ffi.new("int32_t *")
        call(
            lib.pdn_model_add_load_at_places,
            self._c,
            first_element,
            elements,
            frame,
            pointer(axis_2),
            pointer(fractions),
            signals,
            _count,
            first_load,
        )
        return first_load[0]

    def set_turning_frame(self, axis, rate, point=None):
        """Describes everything in a frame that turns about a fixed axis at a constant rate, in
        place of any set before: motions that repeat themselves but for a turn in each period
        are periodic there.

        Positions, directions, rotations, prescribed motions and the ground are those in the
        frame, in the model and in all results; at time zero its axes are the inertial ones.
        Velocities and accelerations of nodes are those in the inertial frame, along the axes of
        the frame or of the node, in results and in forces of yours on nodes and shells; rates
        of joints, and dampers, know the motion in the frame only. Loads with FRAME_SPACE keep
        their directions in the frame. Gravity must be along the axis: a solve refuses any
        other, unless the rate is zero.

        A motion M of the frame is exp(axis rate t) M in the inertial one: it repeats itself
        after the period T but for a turn of rate T. Supports that are no different when they
        turn about the axis, such as a hinge along it, are those of the inertial frame; the turn
        in a period may be unknown: a free parameter (NUMBER_FRAME_RATE) with a condition
        (Conditions.add_rotation_phase). All analyses are in the frame: also statics, modes,
        marches and stability.

        Args:
            axis: array of shape (3): direction of the axis, not zero
            rate: angle in a unit of time [rad/time]; it may be zero
            point: array of shape (3): a point of the axis [length]; None for the origin
        """
        axis = reals("axis", axis, (3,))
        point = reals("point", point, (3,))
        call(lib.pdn_model_set_turning_frame, self._c, pointer(axis), rate, pointer(point))

    def turning_frame(self):
        """The frame that a model is described in, if it turns.

        Returns:
            axis, of shape (3): direction of the axis, of length 1
            rate: angle in a unit of time [rad/time]
            point, of shape (3): a point of the axis [length]
        """
        axis = reals.empty((3,))
        rate = ffi.new("double *")
        point = reals.empty((3,))
        call(lib.pdn_model_turning_frame, self._c, pointer(axis), rate, pointer(point))
        return axis, rate[0], point

    def set_frame_advance(self, speed):
        """Lets the frame that everything is described in advance along its axis at a constant
        speed, too: motions that repeat themselves but for a translation in each period, or for
        a screw motion, are periodic there. A frame of Model.set_turning_frame with the rate
        zero only advances.

        Inertial forces do not change by it. What sees it are velocities in the inertial frame:
        those of nodes in results and in forces of yours on nodes, beams and shells, damping in
        proportion to mass, energies and momenta. The ground that joints, springs and dampers
        hold on to moves along; what stands still beside the way is described by forces of
        yours.

        The speed may be unknown, a free parameter (NUMBER_FRAME_ADVANCE) with a condition
        (Conditions.add_translation_phase): the drift of a motion that goes on.

        Args:
            speed: speed along the axis [length/time]; zero after Model.set_turning_frame
        """
        call(lib.pdn_model_set_frame_advance, self._c, speed)

    def frame_advance(self):
        """Speed along its axis of the frame that a model is described in.

        Returns:
            speed: speed along the axis [length/time]
        """
        speed = ffi.new("double *")
        call(lib.pdn_model_frame_advance, self._c, speed)
        return speed[0]

    def set_spin(self, inertia, axis, rate):
        """Lets a rigid body, or a mass or inertia on a node, spin at a constant rate relative to
        its node, about an axis through its centre of mass which is fixed in the node: a disk, a
        rotor, a flywheel with its gyroscopic moments, on a node that does not turn with it. In
        place of any spin set before.

        The node describes a frame in which the body spins: its motion in results, and all that
        is attached to it, is without the spin. The body must be symmetric about the axis, so
        that its inertia in the node's frame stays what it is; to 1e-8 of its masses and
        moments, so that numbers written with 9 digits pass. What keeps the rate (a motor, or
        bearings of a shaft that turns steadily) acts between node and body: about the axis the
        node feels the body's inertia and, with damping in proportion to mass, what damps its
        spin. Momenta and kinetic energies (Conditions.add_angular_momentum,
        Conditions.add_energy) are those of the body. That energy is constant in a free motion
        only if what keeps the rate does no work: where nothing acts on the node about the axis.

        All analyses know of it, also modes and statics in a frame that turns. A parameter may
        move the rate (NUMBER_SPIN).

        Args:
            inertia: id of the inertia, as Model.inertia_of tells of a rigid body
            axis: array of shape (3): direction of the axis, along the axes of the node, not
                zero
            rate: angle in a unit of time [rad/time]; it may be zero
        """
        axis = reals("axis", axis, (3,))
        call(lib.pdn_model_set_spin, self._c, inertia, pointer(axis), rate)

    def spin(self, inertia):
        """How an inertia spins relative to its node, if it does.

        Args:
            inertia: id of the inertia

        Returns:
            axis, of shape (3): direction of the axis, of length 1, along the axes of the node
            rate: angle in a unit of time [rad/time]
        """
        axis = reals.empty((3,))
        rate = ffi.new("double *")
        call(lib.pdn_model_spin, self._c, inertia, pointer(axis), rate)
        return axis, rate[0]

    def set_beam_spin(self, first_element, elements, rate):
        """Lets the material of beam elements spin about axis 1 of their sections at a constant
        rate relative to their nodes, which do not spin along: a shaft that turns, and whirls by
        small angles about where it stands, as Model.set_spin lets a disk on it.

        Rotary inertia is that of sections that spin. Damping acts on the rates of strains that
        the material sees, which change with each turn where the shaft is bent: it is a rotating
        damping, which makes a shaft unstable that turns faster than its first critical speed,
        unless other damping holds it. Such a beam has no energy that is known. What loads the
        beam, and beam quantities, are in the axes that do not spin.

        The elements must be straight, axis 1 of their nodes along them, and stiffness, mass and
        damping of their sections symmetric about axis 1, to 1e-8.

        Args:
            first_element: id of the first beam element
            elements: number of elements, in order, at least 1
            rate: angle in a unit of time [rad/time]; 0 for beams that do not spin
        """
        call(lib.pdn_model_set_beam_spin, self._c, first_element, elements, rate)

    def beam_spin(self, element):
        """The rate at which the material of a beam element spins relative to its nodes.

        Args:
            element: id of the beam element

        Returns:
            rate: angle in a unit of time [rad/time], 0 if it does not spin
        """
        rate = ffi.new("double *")
        call(lib.pdn_model_beam_spin, self._c, element, rate)
        return rate[0]

    def set_rotor_symmetry(self, axis, blades, nodes, hub, point=None):
        """Says that the blades of a rotor are alike, in place of what was said before: periodic
        solves, also under conditions, then solve for one blade, the hub and the supports, and
        the others follow.

        The rotor turns once in a period about its axis, in the positive sense. In the reference
        configuration each blade is where the one before it gets by a turn of 1/blades; in the
        motion it is where that one gets a part 1/blades of the period later, and so are the
        hub, but for that turn, and all that does not turn. What acts on the model has to be so:
        blades with the same sections, masses, joints and springs, loads and prescribed motions
        that each blade has a part of the period before the one before it, a hub that is the
        same after that turn. Supports and gravity may be any. A solve refuses what is not
        alike, and says what tells blades apart.

        Solutions are those of all blades, as without this. They are solved for so where the
        number of grid points is a multiple of that of blades, as adaptive solves then choose
        it; not where time is mapped, equations are oversampled, controllers act or beams are
        very slender, and only by factors where blades act on each other. Loads and conditions
        that parameters make different at the blades are solved for in whole. Nothing else takes
        notice: statics, modes, marches and branches are those of the whole model; multipliers,
        too, but they are found over the part of the period that one blade takes to the place of
        the next.

        Args:
            axis: array of shape (3): direction of the axis, not zero
            blades: number of blades, at least 2
            nodes: ids of the nodes of all blades, blade after blade, those of each in the same
                order; all different
            hub: ids of the nodes of the hub, and of whatever else turns with the blades
            point: array of shape (3): a point of the axis [length]; None for the origin
        """
        axis = reals("axis", axis, (3,))
        nodes = ids("nodes", nodes)
        _count = len(nodes)
        hub = ids("hub", hub)
        _hub_count = len(hub)
        point = reals("point", point, (3,))
        call(
            lib.pdn_model_set_rotor_symmetry,
            self._c,
            pointer(axis),
            blades,
            ffi.from_buffer("int32_t[]", nodes),
            _count,
            ffi.from_buffer("int32_t[]", hub),
            _hub_count,
            pointer(point),
        )

    def rotor_symmetry(self):
        """The rotor whose blades were said to be alike.

        Returns:
            axis, of shape (3): direction of the axis, of length 1
            point, of shape (3): a point of the axis [length]
            blades: number of blades
            nodes_of_blade: number of nodes of each, for Model.rotor_node
            hub_nodes: number of nodes of the hub
        """
        axis = reals.empty((3,))
        point = reals.empty((3,))
        blades = ffi.new("int32_t *")
        nodes_of_blade = ffi.new("int32_t *")
        hub_nodes = ffi.new("int32_t *")
        call(
            lib.pdn_model_rotor_symmetry,
            self._c,
            pointer(axis),
            pointer(point),
            blades,
            nodes_of_blade,
            hub_nodes,
        )
        return axis, point, blades[0], nodes_of_blade[0], hub_nodes[0]

    def rotor_node(self, blade, index):
        """A node of a rotor whose blades were said to be alike.

        Args:
            blade: which blade, from 0 on; -1 for the hub
            index: which of its nodes, from 0 on

        Returns:
            node: the node's id
        """
        node = ffi.new("int32_t *")
        call(lib.pdn_model_rotor_node, self._c, blade, index, node)
        return node[0]

    def add_shell_element(self, nodes, n_xi, section, placement=None):
        """Adds a shell element over a grid of nodes that are there.

        The nodes stand at the Gauss-Lobatto points in both directions: node i n_eta + j of the
        array at (xi_i, eta_j). How their frames are turned does not matter. The normal is that
        of the tangents along xi and eta, in this order. The element's reference shape
        interpolates the nodes, and is free of stress.

        Elements may share whole edges, with the same nodes along them, and single nodes; beams,
        bodies and joints may share their nodes. Do not let a couple about the normal act on one
        node, such as that of a beam that ends there: it turns the node the further, the finer
        the mesh. Connect through an edge instead.

        Args:
            nodes: ids of the nodes, all different
            n_xi: nodes along xi, 2 to 16; so are those along eta, count / n_xi
            section: the section
            placement: how it lies on the nodes; None for the defaults

        Returns:
            element: the element's id
        """
        nodes = ids("nodes", nodes)
        _count = len(nodes)
        n_xi = whole("n_xi", n_xi)
        section = of_type("ShellSection")(section, self._kept, "section")
        placement = of_type("ShellPlacement")(placement, self._kept, "placement")
        element = ffi.new("int32_t *")
        call(
            lib.pdn_model_add_shell_element,
            self._c,
            ffi.from_buffer("int32_t[]", nodes),
            _count,
            n_xi,
            section,
            placement,
            element,
        )
        return element[0]

    def add_shell(
        self,
        surface,
        elements_u,
        elements_v,
        degree_u,
        degree_v,
        section,
        join=1,
        placement=None,
    ):
        """Adds a shell over a surface, with elements in equal parts of u and v: its nodes and
        elements.

        Axis 1 of each new node's frame is along u, axis 3 along the normal.

        Args:
            surface: the surface
            elements_u: number of elements along u, 1 to 100000
            elements_v: number of elements along v, likewise
            degree_u: polynomial degree along u, 1 to 15: nodes of an element, less one; 3 to 5
                are good choices
            degree_v: polynomial degree along v, likewise
            join: 1: nodes on the edges of the surface at the same place as nodes of shells that
                are there, or on another of its own edges, are these, so that shells are joined
                and closed; 0: all nodes are new; usually 1
            section: the section
            placement: how it lies on the nodes; None for the defaults

        Returns:
            Shell: the shell's elements and numbers of nodes
        """
        surface = of_type("Surface")(surface, self._kept, "surface")
        elements_u = whole("elements_u", elements_u)
        elements_v = whole("elements_v", elements_v)
        degree_u = whole("degree_u", degree_u)
        degree_v = whole("degree_v", degree_v)
        section = of_type("ShellSection")(section, self._kept, "section")
        placement = of_type("ShellPlacement")(placement, self._kept, "placement")
        shell = Shell()
        call(
            lib.pdn_model_add_shell,
            self._c,
            surface,
            elements_u,
            elements_v,
            degree_u,
            degree_v,
            join,
            section,
            placement,
            shell._c,
        )
        return shell

    def add_shell_grid(
        self,
        points,
        elements_u,
        elements_v,
        degree_u,
        degree_v,
        section,
        join=1,
        placement=None,
    ):
        """Adds a shell over given positions of its nodes, as Model.add_shell does over a surface.

        The nodes of each element stand at the Gauss-Lobatto points in both directions: with
        degrees of 1 and 2 evenly.

        Args:
            points: array of shape (count, 3): positions of the nodes, global coordinates, those
                along v first [length]
            elements_u: number of elements along u, 1 to 100000
            elements_v: number of elements along v, likewise
            degree_u: polynomial degree along u, 1 to 15
            degree_v: polynomial degree along v, likewise
            join: 0 or 1, as Model.add_shell has it; usually 1
            section: the section
            placement: how it lies on the nodes; None for the defaults

        Returns:
            Shell: the shell's elements and numbers of nodes
        """
        points = reals("points", points, (None, 3))
        _count = len(points)
        elements_u = whole("elements_u", elements_u)
        elements_v = whole("elements_v", elements_v)
        degree_u = whole("degree_u", degree_u)
        degree_v = whole("degree_v", degree_v)
        section = of_type("ShellSection")(section, self._kept, "section")
        placement = of_type("ShellPlacement")(placement, self._kept, "placement")
        shell = Shell()
        call(
            lib.pdn_model_add_shell_grid,
            self._c,
            pointer(points),
            _count,
            elements_u,
            elements_v,
            degree_u,
            degree_v,
            join,
            section,
            placement,
            shell._c,
        )
        return shell

    def add_shell_quadrilaterals(
        self,
        points,
        cells,
        points_of_cell,
        degree,
        section,
        placement=None,
    ):
        """Adds a shell element for each cell of a mesh of quadrilaterals, as mesh generators make
        them.

        A cell has four points, its corners in a row around it, seen from the side that the
        normal points to; or nine: these, then the middles of its sides from the first corner to
        the second and so on, then its centre. That is the order of Gmsh and VTK. With nine it
        is curved. xi is from the first corner to the second, eta from there to the third. Cells
        that share a side have the same nodes there; points that belong to no cell are left out.
        Model.shell_node tells the nodes.

        Args:
            points: array of shape (pointcount, 3): positions, global coordinates [length]
            cells: numbers of the points of each cell from 0 on, one cell after the other
            points_of_cell: 4 or 9
            degree: polynomial degree of the elements in both directions, 1 to 15
            section: the section
            placement: how it lies on the nodes; None for the defaults

        Returns:
            first_element: id of the first element; the others follow in the order of the cells
        """
        points = reals("points", points, (None, 3))
        _point_count = len(points)
        cells = ids("cells", cells)
        _count = len(cells)
        points_of_cell = whole("points_of_cell", points_of_cell)
        degree = whole("degree", degree)
        section = of_type("ShellSection")(section, self._kept, "section")
        placement = of_type("ShellPlacement")(placement, self._kept, "placement")
        first_element = ffi.new("int32_t *")
        call(
            lib.pdn_model_add_shell_quadrilaterals,
            self._c,
            pointer(points),
            _point_count,
            ffi.from_buffer("int32_t[]", cells),
            _count,
            points_of_cell,
            degree,
            section,
            placement,
            first_element,
        )
        return first_element[0]

    def shell_patch_node(self, shell, u, v):
        """Node of a shell over a surface or a grid.

        Args:
            shell: the shell, as the function that added it has written it
            u: number of the node along u, from 0 to nodes_u - 1
            v: number of the node along v, from 0 to nodes_v - 1

        Returns:
            node: the node's id
        """
        shell = of_type("Shell")(shell, self._kept, "shell")
        node = ffi.new("int32_t *")
        call(lib.pdn_model_shell_patch_node, self._c, shell, u, v, node)
        return node[0]

    def shell_element_count(self):
        """Number of shell elements; their ids follow each other from FIRST_SHELL_ELEMENT on.

        Returns:
            count: the number
        """
        count = ffi.new("int32_t *")
        call(lib.pdn_model_shell_element_count, self._c, count)
        return count[0]

    def shell_node(self, element, xi, eta):
        """Node of a shell element.

        Args:
            element: id of the shell element
            xi: number of the node along xi, from 0 where xi = -1
            eta: number of the node along eta, from 0 where eta = -1

        Returns:
            node: the node's id
        """
        node = ffi.new("int32_t *")
        call(lib.pdn_model_shell_node, self._c, element, xi, eta, node)
        return node[0]

    def add_shell_load(self, first_element, elements, place, frame, component, signal):
        """Adds one component of a force or moment on shell elements, in addition to those that are
        there: for each unit of reference area, or of reference length of an edge.

        Args:
            first_element: id of the first shell element
            elements: number of elements, from the first on; at least 1
            place: SHELL_SURFACE, SHELL_EDGE_START_ETA, SHELL_EDGE_END_XI, SHELL_EDGE_END_ETA or
                SHELL_EDGE_START_XI, of each of them
            frame: FRAME_SPACE: directions of the global axes; FRAME_MATERIAL: of axes that
                follow the shell: on the surface those of the section, so that a pressure is
                FORCE_3, on an edge 1 along it, in the direction of xi or eta, 3 along the
                normal, and 2 = 3 * 1
            component: FORCE_1, FORCE_2, FORCE_3 [force / length^2, or / length], MOMENT_1,
                MOMENT_2 or MOMENT_3 [times length]
            signal: the component in time, copied; a number, a Signal, or a function of time

        Returns:
            load: the load's id, a shell load's
        """
        signal = as_signal(signal, self._kept, "signal")
        load = ffi.new("int32_t *")
        call(
            lib.pdn_model_add_shell_load,
            self._c,
            first_element,
            elements,
            place,
            frame,
            component,
            signal,
            load,
        )
        return load[0]

    def set_shell_prestress(self, first_element, elements, resultants):
        """Gives shell elements forces and moments where nothing is strained: initial stress, in
        place of any before.

        It makes them stiffer or softer, and moves them unless it is in equilibrium.

        Args:
            first_element: id of the first shell element
            elements: number of elements, from the first on; at least 1
            resultants: array of shape (12): along the axes of the section, in the order of
                ShellSection [force / length, moment / length]
        """
        resultants = reals("resultants", resultants, (12,))
        call(
            lib.pdn_model_set_shell_prestress,
            self._c,
            first_element,
            elements,
            pointer(resultants),
        )

    def add_rigid_joints(self, body, nodes):
        """Fixes nodes to a body, by a rigid joint each as Model.add_rigid_joint makes: such as the
        nodes along an edge of a shell, which then moves as a part of the body.

        The body is the first of each joint, whose frames are at the node. The body itself, if
        it is among the nodes, and what a rigid joint fixes to it already, is left out, so that
        edges with a common corner may be fixed to one body.

        Args:
            body: id of the node that the others are fixed to: of a body, an end of a beam, or
                one of the nodes themselves; or GROUND
            nodes: ids of the nodes, all different

        Returns:
            first_joint: id of the first of the joints, which follow each other in the order of
                the nodes
            joints: number of joints
        """
        nodes = ids("nodes", nodes)
        _count = len(nodes)
        first_joint = ffi.new("int32_t *")
        joints = ffi.new("int32_t *")
        call(
            lib.pdn_model_add_rigid_joints,
            self._c,
            body,
            ffi.from_buffer("int32_t[]", nodes),
            _count,
            first_joint,
            joints,
        )
        return first_joint[0], joints[0]

    def add_rigid_edge(self, body, shell, edge):
        """Fixes a whole edge of a shell over a surface or a grid to a body: Model.add_rigid_joints
        with the nodes along it.

        A rigid edge takes forces and couples in all directions, those about the normal too,
        from bodies, beams and joints on the body.

        Args:
            body: id of the node that the edge is fixed to: of a body, an end of a beam, or one
                of the edge; or GROUND
            shell: the shell, as the function that added it has written it
            edge: SHELL_EDGE_START_ETA where v = 0, SHELL_EDGE_END_XI where u = 1,
                SHELL_EDGE_END_ETA where v = 1 or SHELL_EDGE_START_XI where u = 0

        Returns:
            first_joint: id of the first of the joints, which follow each other in the order of
                the nodes along u or v
            joints: number of joints
        """
        shell = of_type("Shell")(shell, self._kept, "shell")
        first_joint = ffi.new("int32_t *")
        joints = ffi.new("int32_t *")
        call(lib.pdn_model_add_rigid_edge, self._c, body, shell, edge, first_joint, joints)
        return first_joint[0], joints[0]

    def force_count(self):
        """Number of forces: springs, dampers, actuators and the like, but not loads; their ids
        follow each other from FIRST_FORCE on.

        Returns:
            count: the number
        """
        count = ffi.new("int32_t *")
        call(lib.pdn_model_force_count, self._c, count)
        return count[0]

    def add_spring_damper(self, joint, coordinate, stiffness, damping=0.0, rest=0.0):
        """Adds a linear spring with a damper on a joint coordinate, in addition to those that are
        there.

        It resists with stiffness * (coordinate - rest) + damping * its rate: with a force on a
        displacement, with a moment on an angle. Whole turns count.

        Args:
            joint: id of the joint
            coordinate: DISPLACEMENT, ... or ROTATION, ...; one that the joint has
            stiffness: effort for a unit of the coordinate [force / length, or force * length];
                may be negative
            damping: effort for a unit of its rate [force * time / length, or force * length *
                time]; may be negative, usually 0
            rest: coordinate at which the spring is free of effort, usually 0 [length or radian]

        Returns:
            force: the force's id
        """
        force = ffi.new("int32_t *")
        call(
            lib.pdn_model_add_spring_damper,
            self._c,
            joint,
            coordinate,
            stiffness,
            damping,
            rest,
            force,
        )
        return force[0]

    def add_nonlinear_spring_damper(
        self,
        joint,
        coordinate,
        stiffness=None,
        damping=None,
        rest=0.0,
    ):
        """Adds a nonlinear spring with a damper on a joint coordinate: polynomials of the
        coordinate and its rate.

        With u = coordinate - rest it resists with stiffness[0] u + stiffness[1] u^2 + ... +
        damping[0] u' + damping[1] u'^2 + ..., so that {k, 0, k3} is a cubic spring. Whole turns
        count.

        Args:
            joint: id of the joint
            coordinate: DISPLACEMENT, ... or ROTATION, ...; one that the joint has
            stiffness: array of shape (stiffnesscount): copied; may be None if there are none
            damping: array of shape (dampingcount): copied; may be None if there are none
            rest: coordinate at which the spring is free of effort, usually 0 [length or radian]

        Returns:
            force: the force's id
        """
        stiffness, _stiffness_count = together(stiffness=stiffness)
        damping, _damping_count = together(damping=damping)
        force = ffi.new("int32_t *")
        call(
            lib.pdn_model_add_nonlinear_spring_damper,
            self._c,
            joint,
            coordinate,
            pointer(stiffness),
            _stiffness_count,
            pointer(damping),
            _damping_count,
            rest,
            force,
        )
        return force[0]

    def add_actuator(self, joint, coordinate, signal):
        """Adds an actuator: a force on a displacement, or a torque on an angle, that follows a
        signal.

        It acts on the second body of the joint towards growth of the coordinate, and its
        reaction on the first. To prescribe the coordinate itself, see Model.prescribe.

        Args:
            joint: id of the joint
            coordinate: DISPLACEMENT, ... or ROTATION, ...; one that the joint has
            signal: the effort in time [force, or force * length], copied; a number, a Signal,
                or a function of time

        Returns:
            force: the force's id
        """
        signal = as_signal(signal, self._kept, "signal")
        force = ffi.new("int32_t *")
        call(lib.pdn_model_add_actuator, self._c, joint, coordinate, signal, force)
        return force[0]

    def add_viscoelastic(
        self,
        joint,
        coordinate,
        stiffness,
        rest,
        branch_stiffness,
        relaxation_times,
    ):
        """Adds a viscoelastic element on a joint coordinate: a generalised Maxwell model.

        A spring, and beside it branches of spring and dashpot in series. With coordinate q it
        resists with stiffness * (q - rest) + the sum over the branches b of branch_stiffness[b]
        a_b, where a_b, the elongation of the branch's spring, relaxes: t_b a_b' + a_b = t_b q',
        with relaxation time t_b. One branch makes it a Zener element, or standard linear solid.
        The internal states are solved for with the motion, at the same grid points. Whole turns
        count; a coordinate that gains turns needs stiffness 0.

        Args:
            joint: id of the joint
            coordinate: DISPLACEMENT, ... or ROTATION, ...; one that the joint has
            stiffness: that of the spring alone, the long-term stiffness [force / length, or
                force * length]; may be negative
            rest: coordinate at which it is free of effort [length or radian]
            branch_stiffness: array of shape (branches): stiffness of each branch's spring,
                positive
            relaxation_times: array of shape (branches): relaxation time of each branch,
                positive [time]

        Returns:
            force: the force's id
        """
        branch_stiffness = reals("branch_stiffness", branch_stiffness, (None,))
        _branches = len(branch_stiffness)
        relaxation_times = reals("relaxation_times", relaxation_times, (_branches,))
        force = ffi.new("int32_t *")
        call(
            lib.pdn_model_add_viscoelastic,
            self._c,
            joint,
            coordinate,
            stiffness,
            rest,
            pointer(branch_stiffness),
            pointer(relaxation_times),
            _branches,
            force,
        )
        return force[0]

    def add_viscous_damper(self, first, second, matrix, frame=None):
        """Adds a viscous damper between two bodies, with a full matrix of coefficients.

        It exerts -matrix * v on the second body, and the reaction on the first, where v is the
        velocity (linear 1, 2, 3, angular 1, 2, 3) of the second body relative to the first, at
        the origin of a frame that is fixed to the second body. Velocity, force and moment are
        about and resolved in that frame, wherever it moves.

        Args:
            first: id of the first node, or GROUND
            second: id of the second node, or GROUND; not the same body
            frame: the frame, where it is in the reference configuration; None for the second
                node's own
            matrix: array of shape (6, 6): symmetric and positive semi-definite [force * time /
                length, force * time, force * length * time]

        Returns:
            force: the force's id
        """
        frame = of_type("Frame")(frame, self._kept, "frame")
        matrix = reals("matrix", matrix, (6, 6), turned=True)
        force = ffi.new("int32_t *")
        call(
            lib.pdn_model_add_viscous_damper,
            self._c,
            first,
            second,
            frame,
            pointer(matrix),
            force,
        )
        return force[0]

    def add_bushing(self, first, second, first_frame, second_frame, stiffness, damping, angles):
        """Adds a bushing, a bearing or a seal: any matrices of stiffness and damping between two
        frames, unsymmetric ones included.

        With e the displacement of the second frame's origin and the angles of its turn, both
        relative to the first frame and along its axes, the efforts against e are f = stiffness
        e + damping e'. The first three are forces along the axes of the first frame, that act
        at the second frame's origin, on both bodies; the others are moments that do the work of
        the angles: for small turns moments about the axes of the first frame. So the axes of a
        journal bearing, with axis 3 along the shaft, are those of its housing if that is the
        first body.

        The matrices are column by column: stiffness[i + 6 j] is effort i for a unit of e[j].
        Parameters scale them: NUMBER_STIFFNESS and NUMBER_DAMPING with power 1 move a factor of
        each.

        Args:
            first: id of the first node, or GROUND
            second: id of the second node, or GROUND; not the same body
            first_frame: frame fixed to the first body, where it is in the reference
                configuration
            second_frame: frame fixed to the second body, likewise
            stiffness: array of shape (6, 6): stiffness [force / length, force, force * length];
                with ANGLES_TILT_AND_SPIN its last column is zero
            damping: array of shape (6, 6): damping [the same times time]
            angles: ANGLES_ROTATION_VECTOR or ANGLES_TILT_AND_SPIN

        Returns:
            force: the force's id
        """
        first_frame = of_type("Frame")(first_frame, self._kept, "first_frame")
        second_frame = of_type("Frame")(second_frame, self._kept, "second_frame")
        stiffness = reals("stiffness", stiffness, (6, 6), turned=True)
        damping = reals("damping", damping, (6, 6), turned=True)
        force = ffi.new("int32_t *")
        call(
            lib.pdn_model_add_bushing,
            self._c,
            first,
            second,
            first_frame,
            second_frame,
            pointer(stiffness),
            pointer(damping),
            angles,
            force,
        )
        return force[0]

    def add_coordinate_law(self, joint, coordinate, tangents, function):
        """Adds a spring-damper on a joint coordinate whose law is a function of the caller.

        Its effort, a force on a displacement or a moment on an angle, resists growth of the
        coordinate as that of Model.add_spring_damper does. It may depend on coordinate, rate
        and time.

        Args:
            joint: id of the joint
            coordinate: DISPLACEMENT, ... or ROTATION, ...; one that the joint has
            tangents: TANGENTS_GIVEN if the function writes derivatives, which
                Model.check_tangents checks; TANGENTS_DIFFERENCED if the library is to find them
                by differences
            function: the law

        Returns:
            force: the force's id
        """
        function = _callbacks.coordinate_law(function, self._kept)
        force = ffi.new("int32_t *")
        call(
            lib.pdn_model_add_coordinate_law,
            self._c,
            joint,
            coordinate,
            tangents,
            function.function,
            function.data,
            ffi.NULL,
            force,
        )
        return force[0]

    def add_user_force(self, nodes, frame, tangents, function):
        """Adds forces on nodes that a function of the caller computes.

        Args:
            nodes: ids of the nodes, all different
            frame: FRAME_SPACE: velocities, forces and tangents are along the global axes;
                FRAME_MATERIAL: along those of each node
            tangents: TANGENTS_GIVEN if the function writes tangents, which Model.check_tangents
                checks; TANGENTS_DIFFERENCED if the library is to find them by differences, at
                the price of 24 calls a node, or 24 for all where Model.declare_nodes_apart says
                that no node matters to others
            function: the forces

        Returns:
            force: the force's id
        """
        nodes = ids("nodes", nodes)
        _count = len(nodes)
        function = _callbacks.user_force(function, self._kept)
        force = ffi.new("int32_t *")
        call(
            lib.pdn_model_add_user_force,
            self._c,
            ffi.from_buffer("int32_t[]", nodes),
            _count,
            frame,
            tangents,
            function.function,
            function.data,
            ffi.NULL,
            force,
        )
        return force[0]

    def declare_nodes_apart(self, force):
        """Declares that the force on each node of a function's force depends on time and on the
        motion of this node alone, as that of the air on points of a wing by strips does.

        Then the force couples no nodes with each other, so that solves take less time; tangents
        are of each force by its own node (pdn_force_state), and differences of all nodes are
        found at once, by 24 calls. Solves compare a few calls and refuse, with ERR_MODEL,
        forces that are not so.

        Args:
            force: id of a force by Model.add_user_force
        """
        call(lib.pdn_model_declare_nodes_apart, self._c, force)

    def check_tangents(self, force, period):
        """Compares the tangents that a user's function gives with differences of its forces.

        At a few states: nodes near their reference configuration, or a coordinate near its own,
        with velocities as they are in motions of the period; the same states in each call.
        Wrong tangents do not make solutions wrong, but Newton's method slow, or fail.

        Args:
            force: id of a force by Model.add_coordinate_law, Model.add_user_force,
                Model.add_controller, Model.add_surface_force or Model.add_line_force
            period: the period that the model is to be solved for, positive [time]

        Returns:
            TangentCheck
        """
        check = TangentCheck()
        call(lib.pdn_model_check_tangents, self._c, force, period, check._c)
        return check

    def add_controller(
        self,
        output_joints,
        output_coordinates,
        tangents,
        function,
        input_joints=None,
        input_coordinates=None,
        initial=None,
        sizes=None,
    ):
        """Adds a controller: efforts on joint coordinates by a function of the caller that reads
        any joint coordinates and their rates, and may have states of its own.

        Without states it is a law that reads other coordinates, such as the gas force on a
        piston by the angle of the crank. States x follow x' = f(t, coordinates, rates, x),
        which the function gives: integrals of controllers, filters, actuators that lag, inflow.
        They are solved for with the motion in all analyses, and are among the states that
        multipliers and modes count.

        Args:
            input_joints: ids of the joints of the coordinates that are read; may be None if
                there are none
            input_coordinates: DISPLACEMENT ... ROTATION_3 of each, one that the joint has; each
                coordinate of a joint at most once; may be None if there are none
            output_joints: ids of the joints of the coordinates that it acts on
            output_coordinates: DISPLACEMENT ... ROTATION_3 of each, as for what is read
            initial: array of shape (statecount): the states where a march begins; None for zero
            sizes: array of shape (statecount): what each state is of the order of, positive, by
                which equations are scaled and differences taken; None for 1
            tangents: TANGENTS_GIVEN if the function writes tangents, which Model.check_tangents
                checks; TANGENTS_DIFFERENCED if the library is to find them by differences, with
                two calls for each coordinate, rate and state
            function: the controller

        Returns:
            force: the force's id
        """
        input_joints = ids("input_joints", input_joints)
        _input_count = len(input_joints)
        input_coordinates = ids("input_coordinates", input_coordinates)
        like("input_coordinates", input_coordinates, (_input_count,))
        output_joints = ids("output_joints", output_joints)
        _output_count = len(output_joints)
        output_coordinates = ids("output_coordinates", output_coordinates)
        like("output_coordinates", output_coordinates, (_output_count,))
        initial, sizes, _state_count = together(initial=initial, sizes=sizes)
        function = _callbacks.controller(function, self._kept)
        force = ffi.new("int32_t *")
        call(
            lib.pdn_model_add_controller,
            self._c,
            ffi.from_buffer("int32_t[]", input_joints),
            ffi.from_buffer("int32_t[]", input_coordinates),
            _input_count,
            ffi.from_buffer("int32_t[]", output_joints),
            ffi.from_buffer("int32_t[]", output_coordinates),
            _output_count,
            pointer(initial),
            pointer(sizes),
            _state_count,
            tangents,
            function.function,
            function.data,
            ffi.NULL,
            force,
        )
        return force[0]

    def controller_counts(self, force):
        """Numbers of the coordinates that a controller reads, of those that it acts on, and of its
        states.

        Args:
            force: id of a force by Model.add_controller

        Returns:
            input_count: number of coordinates that it reads
            output_count: number of coordinates that it acts on
            state_count: number of its states
        """
        input_count = ffi.new("int32_t *")
        output_count = ffi.new("int32_t *")
        state_count = ffi.new("int32_t *")
        call(
            lib.pdn_model_controller_counts,
            self._c,
            force,
            input_count,
            output_count,
            state_count,
        )
        return input_count[0], output_count[0], state_count[0]

    def controller_coordinate(self, force, index):
        """A coordinate that a controller reads or acts on.

        Args:
            force: id of a force by Model.add_controller
            index: number of the coordinate, from 0: those that it reads, then those that it
                acts on

        Returns:
            joint: id of its joint
            coordinate: the coordinate: DISPLACEMENT,
        """
        joint = ffi.new("int32_t *")
        coordinate = ffi.new("int32_t *")
        call(lib.pdn_model_controller_coordinate, self._c, force, index, joint, coordinate)
        return joint[0], coordinate[0]

    def controller_state(self, force, index):
        """A state of a controller.

        Args:
            force: id of a force by Model.add_controller
            index: number of the state, from 0

        Returns:
            initial: its value where a march begins
            size: what it is of the order of
        """
        initial = ffi.new("double *")
        size = ffi.new("double *")
        call(lib.pdn_model_controller_state, self._c, force, index, initial, size)
        return initial[0], size[0]

    def add_surface_force(self, first_element, elements, place, frame, tangents, function):
        """Adds forces on shell elements that a function of the caller computes at the points of a
        quadrature: a force, with an id of its own, for each element.

        They act on the reference surface of the element, or on an edge of it, as loads do
        (Model.add_shell_load): at as many points as it has nodes there.

        Args:
            first_element: id of the first shell element
            elements: number of elements, from the first on; at least 1
            place: SHELL_SURFACE, SHELL_EDGE_START_ETA, SHELL_EDGE_END_XI, SHELL_EDGE_END_ETA or
                SHELL_EDGE_START_XI, of each of them
            frame: FRAME_SPACE: velocities, forces and tangents are along the global axes;
                FRAME_MATERIAL: along those of each point, so that a pressure is force 3 of a
                surface
            tangents: TANGENTS_GIVEN if the function writes tangents, which Model.check_tangents
                checks; TANGENTS_DIFFERENCED if the library is to find them by differences, at
                the price of 24 calls an element
            function: the forces

        Returns:
            first_force: id of the force on the first element, which those on the others follow
        """
        function = _callbacks.surface_force(function, self._kept)
        first_force = ffi.new("int32_t *")
        call(
            lib.pdn_model_add_surface_force,
            self._c,
            first_element,
            elements,
            place,
            frame,
            tangents,
            function.function,
            function.data,
            ffi.NULL,
            first_force,
        )
        return first_force[0]

    def add_line_force(self, first_element, elements, frame, tangents, function, axis_2=None):
        """Adds forces along beam elements that a function of the caller computes at the points of
        a quadrature, such as those of the air on a blade: a force, with an id of its own, for
        each element.

        They act on the line of the beam, for each unit of its reference length, and move with
        the sections, as loads do (Model.add_distributed_load): at as many points of Gauss as
        the element has nodes. These are more while the error of the mesh is estimated, with
        elements of a higher degree under the same ids. Model.bind_surface_force gives a model
        from a file the function again.

        Args:
            first_element: id of the first beam element, such as the first_element of a Beam
            elements: number of elements, from the first on, such as the elements of a Beam; at
                least 1
            frame: FRAME_SPACE: velocities, forces and tangents are along the global axes;
                FRAME_MATERIAL: along those of the section at each point, twisted as they are;
                FRAME_UNTWISTED: along the axes of Model.add_load_at_places, which rotations of
                the points are then of, too
            axis_2: array of shape (3): direction, global coordinates, of any nonzero length,
                nowhere along the line; read for FRAME_UNTWISTED only, else it
            tangents: TANGENTS_GIVEN if the function writes tangents, which Model.check_tangents
                checks; TANGENTS_DIFFERENCED if the library is to find them by differences, at
                the price of 24 calls an element
            function: the forces

        Returns:
            first_force: id of the force on the first element, which those on the others follow
        """
        axis_2 = reals("axis_2", axis_2, (3,))
        function = _callbacks.surface_force(function, self._kept)
        first_force = ffi.new("int32_t *")
        call(
            lib.pdn_model_add_line_force,
            self._c,
            first_element,
            elements,
            frame,
            pointer(axis_2),
            tangents,
            function.function,
            function.data,
            ffi.NULL,
            first_force,
        )
        return first_force[0]

    def bind_controller(self, force, tangents, function):
        """Gives a controller its function, or another one: that of a model from a file is not
        there.

        Args:
            force: id of a force by Model.add_controller; Model.find_label finds it by its label
            tangents: TANGENTS_GIVEN or TANGENTS_DIFFERENCED
            function: the controller
        """
        function = _callbacks.controller(function, self._kept)
        call(
            lib.pdn_model_bind_controller,
            self._c,
            force,
            tangents,
            function.function,
            function.data,
            ffi.NULL,
        )

    def bind_coordinate_law(self, force, tangents, function):
        """Gives a coordinate law its function, or another one: that of a model from a file is not
        there.

        Args:
            force: id of a force by Model.add_coordinate_law; Model.find_label finds it by its
                label
            tangents: TANGENTS_GIVEN or TANGENTS_DIFFERENCED
            function: the law
        """
        function = _callbacks.coordinate_law(function, self._kept)
        call(
            lib.pdn_model_bind_coordinate_law,
            self._c,
            force,
            tangents,
            function.function,
            function.data,
            ffi.NULL,
        )

    def bind_user_force(self, force, frame, tangents, function):
        """Gives forces on nodes their function, or another one: that of a model from a file is not
        there.

        Args:
            force: id of a force by Model.add_user_force; Model.find_label finds it by its label
            frame: FRAME_SPACE or FRAME_MATERIAL, as in Model.add_user_force
            tangents: TANGENTS_GIVEN or TANGENTS_DIFFERENCED
            function: the forces
        """
        function = _callbacks.user_force(function, self._kept)
        call(
            lib.pdn_model_bind_user_force,
            self._c,
            force,
            frame,
            tangents,
            function.function,
            function.data,
            ffi.NULL,
        )

    def bind_surface_force(self, first_force, forces, frame, tangents, function):
        """Gives forces on shell or beam elements their function, or another one: that of a model
        from a file is not there.

        Args:
            first_force: id of the first of the forces, by Model.add_surface_force or
                Model.add_line_force; Model.find_label finds it by its label
            forces: number of forces, in order: one on each element, at least 1
            frame: FRAME_SPACE or FRAME_MATERIAL, as in Model.add_surface_force; the latter,
                too, of forces along beams with FRAME_UNTWISTED, whose axes the model keeps
            tangents: TANGENTS_GIVEN or TANGENTS_DIFFERENCED
            function: the forces
        """
        function = _callbacks.surface_force(function, self._kept)
        call(
            lib.pdn_model_bind_surface_force,
            self._c,
            first_force,
            forces,
            frame,
            tangents,
            function.function,
            function.data,
            ffi.NULL,
        )

    def set_signal(self, id, component, signal):
        """Gives what follows a signal another one: a load, an actuator, a prescribed coordinate.
        In a model from a file this brings back signals by functions, too.

        Parts of it that parameters move have the parameters' values again.

        Args:
            id: what has the signal, as in Model.move_signal
            component: of a load FORCE_1, ... or MOMENT_3, one that has a signal; of gravity
                from 0 to 2; 0 for all else
            signal: the other signal, copied; a number, a Signal, or a function of time
        """
        signal = as_signal(signal, self._kept, "signal")
        call(lib.pdn_model_set_signal, self._c, id, component, signal)

    def set_force_numbers(self, force, number, values):
        """Gives a force other numbers of a sort, as many as it has: those that Model.force_number
        tells.

        Args:
            force: id of the force
            number: NUMBER_STIFFNESS, NUMBER_DAMPING, NUMBER_RELAXATION_TIME or NUMBER_REST
            values: array of shape (count): the numbers, in the order of Model.force_number
        """
        values = reals("values", values, (None,))
        _count = len(values)
        call(lib.pdn_model_set_force_numbers, self._c, force, number, pointer(values), _count)

    def set_load_frame(self, load, frame, axis_2=None):
        """Gives a load, on a node, at a point, along beam elements or on shell elements, another
        frame; its signals stay.

        Args:
            load: id of the load, beam load or shell load
            frame: FRAME_SPACE or FRAME_MATERIAL; along beams also FRAME_UNTWISTED
            axis_2: array of shape (3): as in Model.add_load_at_places; read for FRAME_UNTWISTED
                only, else it
        """
        axis_2 = reals("axis_2", axis_2, (3,))
        call(lib.pdn_model_set_load_frame, self._c, load, frame, pointer(axis_2))

    def set_beam_section(self, first_element, elements, section):
        """Gives beam elements another section, the same all along them; their twist stays, and so
        do the factors of parameters.

        Args:
            first_element: id of the first beam element
            elements: number of elements, in order, at least 1
            section: the section; with mass where the elements' have some, without where they
                have none
        """
        section = of_type("Section")(section, self._kept, "section")
        call(lib.pdn_model_set_beam_section, self._c, first_element, elements, section)

    def set_shell_section(self, first_element, elements, section):
        """Gives shell elements another section; frames, offset and the direction of its axes stay,
        and so do the factors of parameters.

        Args:
            first_element: id of the first shell element
            elements: number of elements, in order, at least 1
            section: the section; with mass where the elements' have some, without where they
                have none
        """
        section = of_type("ShellSection")(section, self._kept, "section")
        call(lib.pdn_model_set_shell_section, self._c, first_element, elements, section)

    def set_inertia(self, inertia, matrix):
        """Gives a rigid body, or a mass or inertia on a node, another inertia; the factor of a
        parameter stays.

        Args:
            inertia: id of the inertia, as Model.inertia_of tells of a rigid body
            matrix: array of shape (6, 6): inertia about the node, along its axes, as in
                Model.add_inertia, symmetric and positive semi-definite
        """
        matrix = reals("matrix", matrix, (6, 6), turned=True)
        call(lib.pdn_model_set_inertia, self._c, inertia, pointer(matrix))

    def set_label(self, id, label=None):
        """Gives a node, joint, element, force, load or the like a label, in place of the one that
        it has.

        Messages and reports name it after its number, as in: joint 3 "crank pin". Labels are
        saved and copied with the model, and solutions keep those that it has when it is solved.

        Args:
            id: its id
            label: text in UTF-8 of at most LABEL_LENGTH bytes, without quotes (") and control
                characters, that no other object of this kind has; empty or None to take the
                label away
        """
        call(lib.pdn_model_set_label, self._c, id, text(label))

    def label(self, id):
        """The label of a node, joint, element, force, load or the like.

        Args:
            id: its id
        """
        return text.of(lib.pdn_model_label, self._c, id)

    def find_label(self, kind, label):
        """The node, joint, element, force, load or the like that has a label.

        Args:
            kind: OBJECT_NODE to OBJECT_PRESCRIBED
            label: the label

        Returns:
            id: its id
        """
        id = ffi.new("int32_t *")
        call(lib.pdn_model_find_label, self._c, kind, text(label), id)
        return id[0]

    def solve_periodic(
        self,
        period,
        *,
        grid_points=None,
        harmonics=None,
        tolerance=None,
        iteration_limit=None,
        initial=None,
        guess_positions=None,
        guess_rotations=None,
        progress=None,
        error_tolerance=None,
        largest_grid_points=None,
        linear_solver=None,
        threads=None,
        oversampling=None,
        response_tolerance=None,
        start=None,
        estimate_mesh=None,
        progress_interval=None,
        work_limit=None,
        memory_limit=None,
        time_map=None,
        event_count=None,
        event_times=None,
        event_widths=None,
        event_shares=None,
    ):
        """Finds the periodic response of a model directly, by Fourier spectral collocation.

        Newton's method with the exact tangent on the equations of motion at N times of a
        period, from the quasi-static motion unless another start is given; where inertia takes
        the response far from that, or N is large, from a solution on fewer points. Unless N is
        given, it is raised, each solution starting the next, until the estimated error meets
        the tolerance. Not converging is no error: OK says that the solve was carried out,
        Solution.outcome how it ended, Solution.report why.

        Args:
            period: T, the period of the response; harmonics of signals are those of this period
            grid_points: Number N of grid points, odd, or a multiple of the number of like
                blades (pdn_model_set_rotor_symmetry): harmonics below N / 2 are resolved. 0 for
                as many as error_tolerance needs. Default 0.
            harmonics: If not 0, the number of harmonics that are resolved: grid_points is then
                2 harmonics + 1. Default 0.
            tolerance: Newton's method has converged when the largest increment (lengths
                relative to the size of the mechanism, angles in radians) is below this. Newton
                is quadratic: the error left in motions is about its square, that in forces
                about it times their last change. Default 1e-9.
            iteration_limit: Most Newton iterations on a grid. Default 30.
            initial: Start from this solution, periodic or static, also on another grid or of
                another period, or from the last period of this march; None to start otherwise.
                Its model is to have the same bodies, joints, forces and prescribed coordinates,
                and the same beams, which may have other meshes. If grid_points is 0, the first
                grid is that of this solution. Default None.
            guess_positions: Start from these positions, an array of shape 3 x [N] x [nodes]:
                coordinates fastest, then grid points, then nodes; None to start otherwise.
                Needs guess_rotations, and grid_points or harmonics. Default None.
            guess_rotations: Rotation matrices of the same start, an array of shape 9 x [N] x
                [nodes], each column by column. Default None.
            progress: Told of each iteration, and while one lasts, see progress_interval; may
                cancel. Default None.
            error_tolerance: If grid_points is 0, grid points are added until the estimated
                error of the motions is below this: positions relative to the size of the
                mechanism, angles in radians. Default 1e-6, which leaves about three digits to
                forces and accelerations, which are second derivatives.
            largest_grid_points: If grid_points is 0, the largest number of grid points, at
                least 3; if the tolerance would need more, the outcome is TOLERANCE_NOT_MET.
                Default 511.
            linear_solver: How linear equations are solved: LINEAR_AUTOMATIC, LINEAR_DIRECT, ...
                Default LINEAR_AUTOMATIC.
            threads: Threads that share the work, of a pool that lasts as long as the call; 0
                for as many as there are processors. Signals' and other functions of yours are
                called on the calling thread alone. Default 1.
            oversampling: The equations are sampled at this many times as many points (or one
                more), from 1 to 16, where motions and multipliers are interpolated; their
                virtual work, and the harmonics of the constraints up to those of the grid, are
                to vanish. 1: at the grid points alone. Default 1.
            response_tolerance: If grid_points is 0 and this is not, the estimated error of the
                motions is also to be below this times the amplitude of the response: the
                largest deviation of a node from its mean or, if it makes whole turns in a
                period, from a steady turn, in the measure of error_tolerance. For responses
                that are small beside the mechanism. Default 0.
            start: Where the library starts, unless a start is given: START_AUTOMATIC, or one
                way alone: START_QUASI_STATIC, ... START_STEADY_ROTATION and
                START_RIGID_ROTATION need a drive that turns. Default START_AUTOMATIC.
            estimate_mesh: 1 to estimate the error by the mesh of beams, too,
                Diagnostics.mesh_error, which takes about as long as an iteration; not with
                oversampling. Default 0.
            progress_interval: Least time between two calls of progress while an iteration
                lasts, in seconds; 0 to be called at any opportunity. Default 0.1.
            work_limit: Most work, counted in operations and not in time, of all starts and
                grids: this many times that of an easy Newton iteration on the finest grid so
                far, by few products or by factors, and a constant for small models. What takes
                more ends as WORK_LIMIT or, where a coarser grid had a solution, with that as
                TOLERANCE_NOT_MET. Twice that on a given grid. 0 for no bound. Default 17.
            memory_limit: Bytes of memory that the solve may take, by an estimate that is made
                before it is begun on a grid: one that would take more is ERR_MEMORY, and its
                message tells the estimate. If grid_points is 0, only the first grid is refused
                so; finer ones that would take more end the solve as TOLERANCE_NOT_MET. 0 for no
                limit but that of the system. Default 0.
            time_map: Where the points of grids are: TIME_MAP_AUTOMATIC, TIME_MAP_EQUISPACED or
                TIME_MAP_EVENTS. By TIME_MAP_AUTOMATIC, a given number of points is equispaced,
                and a solve to a tolerance that starts from a solution goes on with the map of
                that. Default TIME_MAP_AUTOMATIC.
            event_count: Number of the events of TIME_MAP_EVENTS, at most 16. Default 0.
            event_times: Times of the events, which repeat themselves every period: an array of
                length [event_count]. Default None.
            event_widths: Times from there to where the additional density of grid points is
                half as large, about as long as the events last, from 1e-5 to half the period:
                an array of length [event_count]. Default None.
            event_shares: Grid points that are there for each, beside those spread equally over
                the period, which count as 1; above 0, at most 100: an array of length
                [event_count]. Default None.

        Returns:
            Solution: the solution, also if it has not converged
        """
        options = PeriodicOptions(
            grid_points=grid_points,
            harmonics=harmonics,
            tolerance=tolerance,
            iteration_limit=iteration_limit,
            initial=initial,
            guess_positions=guess_positions,
            guess_rotations=guess_rotations,
            progress=progress,
            error_tolerance=error_tolerance,
            largest_grid_points=largest_grid_points,
            linear_solver=linear_solver,
            threads=threads,
            oversampling=oversampling,
            response_tolerance=response_tolerance,
            start=start,
            estimate_mesh=estimate_mesh,
            progress_interval=progress_interval,
            work_limit=work_limit,
            memory_limit=memory_limit,
            time_map=time_map,
            event_count=event_count,
            event_times=event_times,
            event_widths=event_widths,
            event_shares=event_shares,
        )
        like("guess_positions", guess_positions, (self.node_count(), points_of(options), 3))
        like("guess_rotations", guess_rotations, (self.node_count(), points_of(options), 3, 3))
        out = ffi.new("pdn_solution **")
        call(lib.pdn_solve_periodic, self._c, period, options._c, out)
        return Solution._made(out[0], self._kept)

    def equations_new(
        self,
        period,
        *,
        grid_points=None,
        initial=None,
        owners=None,
        owner_count=None,
        rank=None,
        ranks=None,
        preconditioner=None,
        threads=None,
    ):
        """Makes the equations of a periodic motion on a grid, or a rank's part. By all ranks.

        Args:
            period: T, the period of the response
            grid_points: Number N of grid points, odd; to be set.
            initial: Where to begin: a solution as for PeriodicOptions.initial; None for the
                reference configuration. Default None.
            owners: Rank of each node, an array of length [owner_count]; None for runs of nodes
                with about the same work. Each rank must have a node. Default None.
            owner_count: Number of nodes, if there are owners.
            rank: Number of this rank, from 0. Default 0.
            ranks: How many ranks there are. Default 1.
            preconditioner: The preconditioner: LINEAR_TIME_LOCAL, LINEAR_BODY_CIRCULANT,
                LINEAR_CIRCULANT, or LINEAR_AUTOMATIC for the first where joints turn in the
                initial motion, the second otherwise. Default LINEAR_AUTOMATIC.
            threads: Threads of this rank that share its work; 0 for as many as there are
                processors. Default 1.

        Returns:
            Equations: the equations at the start
        """
        options = EquationsOptions(
            grid_points=grid_points,
            initial=initial,
            owners=owners,
            owner_count=owner_count,
            rank=rank,
            ranks=ranks,
            preconditioner=preconditioner,
            threads=threads,
        )
        out = ffi.new("pdn_equations **")
        call(lib.pdn_equations_new, self._c, period, options._c, out)
        return Equations._made(out[0], self._kept)

    def add_parameter(self, name, value, scale):
        """Adds a parameter: a named number that moves what Model.move_number and Model.move_signal
        say. At first it moves nothing.

        A model can be solved at other values (Model.set_parameter), values can be found so that
        conditions are met (Model.solve_conditioned), and followed (FollowBranch). They are
        saved with the model.

        Args:
            name: text in UTF-8 that no other parameter of the model has, not empty
            value: its value
            scale: what counts as 1 in it, positive: its range, about

        Returns:
            out: the parameter's id
        """
        out = ffi.new("int32_t *")
        call(lib.pdn_model_add_parameter, self._c, text(name), value, scale, out)
        return out[0]

    def parameter_count(self):
        """Number of parameters; their ids follow each other from FIRST_PARAMETER on.

        Returns:
            count: the number
        """
        count = ffi.new("int32_t *")
        call(lib.pdn_model_parameter_count, self._c, count)
        return count[0]

    def parameter(self, parameter):
        """Value and scale of a parameter.

        Args:
            parameter: id of the parameter

        Returns:
            value: its value
            scale: what counts as 1 in it
        """
        value = ffi.new("double *")
        scale = ffi.new("double *")
        call(lib.pdn_model_parameter, self._c, parameter, value, scale)
        return value[0], scale[0]

    def parameter_name(self, parameter):
        """The name of a parameter.

        Args:
            parameter: id of the parameter
        """
        return text.of(lib.pdn_model_parameter_name, self._c, parameter)

    def find_parameter(self, name):
        """The parameter that has a name.

        Args:
            name: the name

        Returns:
            parameter: id of the parameter
        """
        parameter = ffi.new("int32_t *")
        call(lib.pdn_model_find_parameter, self._c, text(name), parameter)
        return parameter[0]

    def move_number(self, parameter, number, id, power, factor):
        """Lets a parameter move a number of the model: it becomes `factor` times the parameter's
        value, now and whenever that changes.

        Args:
            parameter: id of the parameter
            number: NUMBER_STIFFNESS,
            id: id of the force, inertia, beam element or shell element that has it; 0 for
                NUMBER_MASS_DAMPING, NUMBER_FRAME_RATE and NUMBER_FRAME_ADVANCE, which are of
                the whole model
            power: power, from 1, of a stiffness or damping; 0 for all else
            factor: the number for a unit of the parameter, not zero
        """
        call(lib.pdn_model_move_number, self._c, parameter, number, id, power, factor)

    def move_signal(self, parameter, id, component, part, factor):
        """Lets a parameter move a part of a signal: it becomes `factor` times the parameter's
        value, now and whenever that changes.

        Args:
            parameter: id of the parameter
            id: what has the signal: id of an actuator (a force), prescribed coordinate, load
                (on a node, along beams, on shells) or relation; or GRAVITY
            component: of a load FORCE_1, ... or MOMENT_3, of gravity from 0 to 2; 0 for all
                else
            part: PART_MEAN, PART_RATE, PART_AMPLITUDE or PART_PHASE
            factor: the part for a unit of the parameter, not zero
        """
        call(lib.pdn_model_move_signal, self._c, parameter, id, component, part, factor)

    def set_parameter(self, parameter, value):
        """Gives a parameter another value, and all that it moves.

        Args:
            parameter: id of the parameter
            value: the value
        """
        call(lib.pdn_model_set_parameter, self._c, parameter, value)

    def set_mass_damping(self, factor):
        """Gives everything with mass a force against its motion relative to the inertial frame,
        `factor` times its momentum: damping in proportion to mass.

        Args:
            factor: force for a unit of momentum [1/time]; negative to excite
        """
        call(lib.pdn_model_set_mass_damping, self._c, factor)

    def declare_of_phase(self, force):
        """Declares that the function of a force is one of the phase, 2 pi t / T, which it is then
        told in place of the time: it holds for any period T, as it must where that is unknown.

        A function that does not depend on time is one of the phase, too.

        Args:
            force: id of a force that has a function
        """
        call(lib.pdn_model_declare_of_phase, self._c, force)

    def joint(self, joint):
        """Kind, bodies and frames of a joint.

        Args:
            joint: id of the joint

        Returns:
            JointInfo: the joint
        """
        out = JointInfo()
        call(lib.pdn_model_joint, self._c, joint, out._c)
        return out

    def force(self, force):
        """Kind of a force, where it acts, and how many numbers it has.

        Args:
            force: id of the force

        Returns:
            ForceInfo: the force
        """
        out = ForceInfo()
        call(lib.pdn_model_force, self._c, force, out._c)
        return out

    def force_number(self, force, number, index):
        """A number of a force, with the factors of parameters.

        Of a spring-damper the coefficients of the powers of the growth and of the rate, from
        the first; of a viscoelastic element as NUMBER_STIFFNESS the long-term stiffness, then
        that of each branch; of viscous dampers and bushings their matrices, column by column.
        Of a spring-damper or viscoelastic element as NUMBER_REST the one coordinate at which it
        is free of effort.

        Args:
            force: id of the force
            number: NUMBER_STIFFNESS, NUMBER_DAMPING, NUMBER_RELAXATION_TIME or NUMBER_REST
            index: which of these, from 0; their count is in pdn_force_info

        Returns:
            out: the number
        """
        out = ffi.new("double *")
        call(lib.pdn_model_force_number, self._c, force, number, index, out)
        return out[0]

    def force_node(self, force, index):
        """A node of forces of the user.

        Args:
            force: id of the force
            index: which of its nodes, from 0; their count is in pdn_force_info

        Returns:
            node: the node's id
        """
        node = ffi.new("int32_t *")
        call(lib.pdn_model_force_node, self._c, force, index, node)
        return node[0]

    def beam_element_node_count(self, element):
        """Number of nodes of a beam element.

        Args:
            element: id of the beam element

        Returns:
            count: the number
        """
        count = ffi.new("int32_t *")
        call(lib.pdn_model_beam_element_node_count, self._c, element, count)
        return count[0]

    def beam_element_node(self, element, index):
        """A node of a beam element, in order along the beam.

        Args:
            element: id of the beam element
            index: which of its nodes, from 0

        Returns:
            node: the node's id
        """
        node = ffi.new("int32_t *")
        call(lib.pdn_model_beam_element_node, self._c, element, index, node)
        return node[0]

    def beam_section(self, element, station):
        """Cross-section of a beam element at a place, with the factors of parameters.

        Args:
            element: id of the beam element
            station: place along the element, from -1 at its first to 1 at its last node

        Returns:
            Section: the section, in its own axes
            twist: angle by which its axes are turned about axis 1 from those between the nodes
                [radian]
        """
        out = Section()
        twist = ffi.new("double *")
        call(lib.pdn_model_beam_section, self._c, element, station, out._c, twist)
        return out, twist[0]

    def inertia_count(self):
        """Number of inertias: bodies, masses and inertias on nodes; their ids follow each other
        from FIRST_INERTIA on.

        Returns:
            count: the number
        """
        count = ffi.new("int32_t *")
        call(lib.pdn_model_inertia_count, self._c, count)
        return count[0]

    def inertia(self, inertia):
        """The inertia of a body, or a mass or inertia on a node, with the factors of parameters.

        Args:
            inertia: id of the inertia

        Returns:
            node: the node's id
            matrix, of shape (6, 6): inertia about the node, along its axes, as in
                Model.add_inertia
        """
        node = ffi.new("int32_t *")
        matrix = reals.empty((6, 6))
        call(lib.pdn_model_inertia, self._c, inertia, node, pointer(matrix))
        return node[0], matrix.swapaxes(-1, -2)

    def inertia_of(self, node):
        """The inertia of a node: of a rigid body its own, of others the one that was added first.

        Args:
            node: id of the node

        Returns:
            inertia: id of the inertia
        """
        inertia = ffi.new("int32_t *")
        call(lib.pdn_model_inertia_of, self._c, node, inertia)
        return inertia[0]

    def prescribed(self, prescribed):
        """A prescribed coordinate; Model.summary tells how many there are, whose ids follow each
        other from FIRST_PRESCRIBED on, and Model.sample_signal what they follow.

        Args:
            prescribed: id of the prescribed coordinate

        Returns:
            joint: id of its joint
            coordinate: DISPLACEMENT,
        """
        joint = ffi.new("int32_t *")
        coordinate = ffi.new("int32_t *")
        call(lib.pdn_model_prescribed, self._c, prescribed, joint, coordinate)
        return joint[0], coordinate[0]

    def relation_term_count(self, relation):
        """Number of coordinates of a linear relation.

        Args:
            relation: id of the relation

        Returns:
            count: the number
        """
        count = ffi.new("int32_t *")
        call(lib.pdn_model_relation_term_count, self._c, relation, count)
        return count[0]

    def relation_term(self, relation, index):
        """A coordinate of a linear relation, and its coefficient.

        Args:
            relation: id of the relation
            index: which of its coordinates, from 0

        Returns:
            joint: id of the joint
            coordinate: DISPLACEMENT,
            coefficient: the coefficient
        """
        joint = ffi.new("int32_t *")
        coordinate = ffi.new("int32_t *")
        coefficient = ffi.new("double *")
        call(
            lib.pdn_model_relation_term,
            self._c,
            relation,
            index,
            joint,
            coordinate,
            coefficient,
        )
        return joint[0], coordinate[0], coefficient[0]

    def sample_signal(self, id, component, period, times):
        """Values of a signal of the model in time.

        Args:
            id: what has the signal, as in Model.move_signal
            component: of a load FORCE_1, ... or MOMENT_3, of gravity from 0 to 2; 0 for all
                else
            period: period of the motion, that harmonics refer to [time]
            times: array of shape (count): times

        Returns:
            values, of shape (count): the values there
        """
        times = reals("times", times, (None,))
        _count = len(times)
        values = reals.empty((_count,))
        call(
            lib.pdn_model_sample_signal,
            self._c,
            id,
            component,
            period,
            pointer(times),
            _count,
            pointer(values),
        )
        return values

    def load_count(self):
        """Number of loads on nodes and at points; their ids follow each other from FIRST_LOAD on.

        Returns:
            count: the number
        """
        count = ffi.new("int32_t *")
        call(lib.pdn_model_load_count, self._c, count)
        return count[0]

    def load_at(self, load):
        """A load on a node or at a point; its components are signals, Model.sample_signal.

        Args:
            load: id of the load

        Returns:
            node: id of the node that carries it, or -1 if a beam does
            first_element: id of the first of the beam elements that carry it, or -1 if a node
                does
            elements: number of these, from the first on, 0 if there are none
            fraction: the place, as a fraction of the reference length of these elements, 0 if
                there are none
            offset, of shape (3): the point, from the node or the line of the beam, along the
                axes of the node or section
            frame: FRAME_SPACE or FRAME_MATERIAL
        """
        node = ffi.new("int32_t *")
        first_element = ffi.new("int32_t *")
        elements = ffi.new("int32_t *")
        fraction = ffi.new("double *")
        offset = reals.empty((3,))
        frame = ffi.new("int32_t *")
        call(
            lib.pdn_model_load_at,
            self._c,
            load,
            node,
            first_element,
            elements,
            fraction,
            pointer(offset),
            frame,
        )
        return node[0], first_element[0], elements[0], fraction[0], offset, frame[0]

    def beam_load_count(self):
        """Number of loads along beam elements; their ids follow each other from FIRST_BEAM_LOAD
        on.

        Returns:
            count: the number
        """
        count = ffi.new("int32_t *")
        call(lib.pdn_model_beam_load_count, self._c, count)
        return count[0]

    def beam_load(self, load):
        """A load along beam elements; its components are signals, Model.sample_signal, times the
        factors of Model.beam_load_factor.

        Args:
            load: id of the beam load

        Returns:
            first_element: id of the first beam element
            elements: number of elements, from the first on
            frame: FRAME_SPACE, FRAME_MATERIAL or FRAME_UNTWISTED
            axis_2, of shape (3): direction that was given with FRAME_UNTWISTED, else zero
            places: number of places with factors, 0 for a factor of 1 all along
        """
        first_element = ffi.new("int32_t *")
        elements = ffi.new("int32_t *")
        frame = ffi.new("int32_t *")
        axis_2 = reals.empty((3,))
        places = ffi.new("int32_t *")
        call(
            lib.pdn_model_beam_load,
            self._c,
            load,
            first_element,
            elements,
            frame,
            pointer(axis_2),
            places,
        )
        return first_element[0], elements[0], frame[0], axis_2, places[0]

    def beam_load_factor(self, load, index):
        """Factor of a load along beam elements at a place; it is linear in between.

        Args:
            load: id of the beam load
            index: which of its places, from 0, in order along the elements

        Returns:
            fraction: the place, as a fraction of the reference length of its elements
            factor: the factor there
        """
        fraction = ffi.new("double *")
        factor = ffi.new("double *")
        call(lib.pdn_model_beam_load_factor, self._c, load, index, fraction, factor)
        return fraction[0], factor[0]

    def shell_load_count(self):
        """Number of loads on shell elements; their ids follow each other from FIRST_SHELL_LOAD on.

        Returns:
            count: the number
        """
        count = ffi.new("int32_t *")
        call(lib.pdn_model_shell_load_count, self._c, count)
        return count[0]

    def shell_load(self, load):
        """A load on shell elements; its components are signals, Model.sample_signal.

        Args:
            load: id of the shell load

        Returns:
            first_element: id of the first shell element
            elements: number of elements, from the first on
            place: SHELL_SURFACE or an edge, of each of them
            frame: FRAME_SPACE or FRAME_MATERIAL
        """
        first_element = ffi.new("int32_t *")
        elements = ffi.new("int32_t *")
        place = ffi.new("int32_t *")
        frame = ffi.new("int32_t *")
        call(lib.pdn_model_shell_load, self._c, load, first_element, elements, place, frame)
        return first_element[0], elements[0], place[0], frame[0]

    def solve_conditioned(
        self,
        period,
        conditions,
        *,
        grid_points=None,
        harmonics=None,
        tolerance=None,
        iteration_limit=None,
        initial=None,
        guess_positions=None,
        guess_rotations=None,
        progress=None,
        error_tolerance=None,
        largest_grid_points=None,
        linear_solver=None,
        threads=None,
        oversampling=None,
        response_tolerance=None,
        start=None,
        estimate_mesh=None,
        progress_interval=None,
        work_limit=None,
        memory_limit=None,
        time_map=None,
        event_count=None,
        event_times=None,
        event_widths=None,
        event_shares=None,
    ):
        """Finds a periodic response that meets conditions, and the values of as many free
        parameters.

        Newton's method for motions and parameters together starts at a given solution or motion
        (`options.initial`, `options.guess_positions`), or else at the response with the
        parameters as they are. Where the period is free, `period` is the guess of it; loads and
        prescribed motions are then functions of the phase: harmonics and samples are, rates are
        for whole turns, functions must be declared such (Signal.set_function_of_phase,
        Model.declare_of_phase).

        Args:
            period: T, or a guess of it
            conditions: free parameters and as many conditions
            grid_points: Number N of grid points, odd, or a multiple of the number of like
                blades (pdn_model_set_rotor_symmetry): harmonics below N / 2 are resolved. 0 for
                as many as error_tolerance needs. Default 0.
            harmonics: If not 0, the number of harmonics that are resolved: grid_points is then
                2 harmonics + 1. Default 0.
            tolerance: Newton's method has converged when the largest increment (lengths
                relative to the size of the mechanism, angles in radians) is below this. Newton
                is quadratic: the error left in motions is about its square, that in forces
                about it times their last change. Default 1e-9.
            iteration_limit: Most Newton iterations on a grid. Default 30.
            initial: Start from this solution, periodic or static, also on another grid or of
                another period, or from the last period of this march; None to start otherwise.
                Its model is to have the same bodies, joints, forces and prescribed coordinates,
                and the same beams, which may have other meshes. If grid_points is 0, the first
                grid is that of this solution. Default None.
            guess_positions: Start from these positions, an array of shape 3 x [N] x [nodes]:
                coordinates fastest, then grid points, then nodes; None to start otherwise.
                Needs guess_rotations, and grid_points or harmonics. Default None.
            guess_rotations: Rotation matrices of the same start, an array of shape 9 x [N] x
                [nodes], each column by column. Default None.
            progress: Told of each iteration, and while one lasts, see progress_interval; may
                cancel. Default None.
            error_tolerance: If grid_points is 0, grid points are added until the estimated
                error of the motions is below this: positions relative to the size of the
                mechanism, angles in radians. Default 1e-6, which leaves about three digits to
                forces and accelerations, which are second derivatives.
            largest_grid_points: If grid_points is 0, the largest number of grid points, at
                least 3; if the tolerance would need more, the outcome is TOLERANCE_NOT_MET.
                Default 511.
            linear_solver: How linear equations are solved: LINEAR_AUTOMATIC, LINEAR_DIRECT, ...
                Default LINEAR_AUTOMATIC.
            threads: Threads that share the work, of a pool that lasts as long as the call; 0
                for as many as there are processors. Signals' and other functions of yours are
                called on the calling thread alone. Default 1.
            oversampling: The equations are sampled at this many times as many points (or one
                more), from 1 to 16, where motions and multipliers are interpolated; their
                virtual work, and the harmonics of the constraints up to those of the grid, are
                to vanish. 1: at the grid points alone. Default 1.
            response_tolerance: If grid_points is 0 and this is not, the estimated error of the
                motions is also to be below this times the amplitude of the response: the
                largest deviation of a node from its mean or, if it makes whole turns in a
                period, from a steady turn, in the measure of error_tolerance. For responses
                that are small beside the mechanism. Default 0.
            start: Where the library starts, unless a start is given: START_AUTOMATIC, or one
                way alone: START_QUASI_STATIC, ... START_STEADY_ROTATION and
                START_RIGID_ROTATION need a drive that turns. Default START_AUTOMATIC.
            estimate_mesh: 1 to estimate the error by the mesh of beams, too,
                Diagnostics.mesh_error, which takes about as long as an iteration; not with
                oversampling. Default 0.
            progress_interval: Least time between two calls of progress while an iteration
                lasts, in seconds; 0 to be called at any opportunity. Default 0.1.
            work_limit: Most work, counted in operations and not in time, of all starts and
                grids: this many times that of an easy Newton iteration on the finest grid so
                far, by few products or by factors, and a constant for small models. What takes
                more ends as WORK_LIMIT or, where a coarser grid had a solution, with that as
                TOLERANCE_NOT_MET. Twice that on a given grid. 0 for no bound. Default 17.
            memory_limit: Bytes of memory that the solve may take, by an estimate that is made
                before it is begun on a grid: one that would take more is ERR_MEMORY, and its
                message tells the estimate. If grid_points is 0, only the first grid is refused
                so; finer ones that would take more end the solve as TOLERANCE_NOT_MET. 0 for no
                limit but that of the system. Default 0.
            time_map: Where the points of grids are: TIME_MAP_AUTOMATIC, TIME_MAP_EQUISPACED or
                TIME_MAP_EVENTS. By TIME_MAP_AUTOMATIC, a given number of points is equispaced,
                and a solve to a tolerance that starts from a solution goes on with the map of
                that. Default TIME_MAP_AUTOMATIC.
            event_count: Number of the events of TIME_MAP_EVENTS, at most 16. Default 0.
            event_times: Times of the events, which repeat themselves every period: an array of
                length [event_count]. Default None.
            event_widths: Times from there to where the additional density of grid points is
                half as large, about as long as the events last, from 1e-5 to half the period:
                an array of length [event_count]. Default None.
            event_shares: Grid points that are there for each, beside those spread equally over
                the period, which count as 1; above 0, at most 100: an array of length
                [event_count]. Default None.

        Returns:
            Solution: the solution, also if it has not converged: Solution.parameter tells the
                values found
        """
        options = PeriodicOptions(
            grid_points=grid_points,
            harmonics=harmonics,
            tolerance=tolerance,
            iteration_limit=iteration_limit,
            initial=initial,
            guess_positions=guess_positions,
            guess_rotations=guess_rotations,
            progress=progress,
            error_tolerance=error_tolerance,
            largest_grid_points=largest_grid_points,
            linear_solver=linear_solver,
            threads=threads,
            oversampling=oversampling,
            response_tolerance=response_tolerance,
            start=start,
            estimate_mesh=estimate_mesh,
            progress_interval=progress_interval,
            work_limit=work_limit,
            memory_limit=memory_limit,
            time_map=time_map,
            event_count=event_count,
            event_times=event_times,
            event_widths=event_widths,
            event_shares=event_shares,
        )
        like("guess_positions", guess_positions, (self.node_count(), points_of(options), 3))
        like("guess_rotations", guess_rotations, (self.node_count(), points_of(options), 3, 3))
        out = ffi.new("pdn_solution **")
        call(lib.pdn_solve_conditioned, self._c, period, pointer(conditions), options._c, out)
        return Solution._made(out[0], self._kept)

    def follow_branch(
        self,
        period,
        parameter,
        *,
        periodic=None,
        conditions=None,
        from_=None,
        to=None,
        motion_scale=None,
        first_step=None,
        smallest_step=None,
        largest_step=None,
        angle=None,
        point_limit=None,
        progress=None,
        downwards=None,
        events=None,
        stability=None,
    ):
        """Follows periodic motions along a parameter, through folds, from the response at its
        value in the model.

        Steps are as long as the branch allows: they aim at `options.angle` between the tangents
        of neighbouring points. Folds are located exactly, and are points of their own. Unless a
        number of grid points is given it grows along the branch. That the branch ends early is
        no error, whatever happens after its first point: BranchEnd tells, and all its points
        are kept.

        Args:
            period: T of the first response, or a guess of it where the frequency is free
            parameter: id of the parameter to be followed, or FREQUENCY
            periodic: Grid, tolerance and linear solver, where the first solve starts, and who
                is told of the iterations; None for the defaults. Grids are equispaced. Default
                None.
            conditions: What else is free along the branch, and as many conditions; None for
                nothing. Default None.
            from_: Least value of the parameter, where the branch ends.
            to: Largest value of the parameter, where the branch ends; more than `from`.
            motion_scale: What counts as 1 in motions, relative to the size of the mechanism and
                in radians; as the whole range does in the parameter. Default 1.
            first_step: Length of the first step: 1 is the whole range, or a motion of
                motion_scale. Default 0.02.
            smallest_step: Shortest step. Default 1e-6.
            largest_step: Longest step. Default 1.
            angle: Angle between the branch at neighbouring points that steps aim at [radians];
                steps by four thirds of it are taken again by half. Default 0.3.
            point_limit: Most points. Default 1000.
            progress: Told of each point; may end the branch. Default None.
            downwards: 1 if the parameter decreases at first. Default 0.
            events: 1 to look for branch points (where there are no conditions) and period
                doublings, too, by two more factorisations of the whole Jacobian a point.
                Default 0.
            stability: 1 to find the multipliers of each point, and with them torus points.
                Default 0.

        Returns:
            Branch: the branch
        """
        options = BranchOptions(
            periodic=periodic,
            conditions=conditions,
            from_=from_,
            to=to,
            motion_scale=motion_scale,
            first_step=first_step,
            smallest_step=smallest_step,
            largest_step=largest_step,
            angle=angle,
            point_limit=point_limit,
            progress=progress,
            downwards=downwards,
            events=events,
            stability=stability,
        )
        out = ffi.new("pdn_branch **")
        call(lib.pdn_follow_branch, self._c, period, parameter, options._c, out)
        return Branch._made(out[0], self._kept)

    def solve_frequency_response(
        self,
        first,
        last,
        *,
        periodic=None,
        conditions=None,
        from_=None,
        to=None,
        motion_scale=None,
        first_step=None,
        smallest_step=None,
        largest_step=None,
        angle=None,
        point_limit=None,
        progress=None,
        downwards=None,
        events=None,
        stability=None,
    ):
        """Finds the response over a range of frequencies, through folds: FollowBranch along
        FREQUENCY.

        Args:
            first: circular frequency 2 pi / T at which it begins
            last: circular frequency at which it ends, more or less than `first`
            periodic: Grid, tolerance and linear solver, where the first solve starts, and who
                is told of the iterations; None for the defaults. Grids are equispaced. Default
                None.
            conditions: What else is free along the branch, and as many conditions; None for
                nothing. Default None.
            from_: Least value of the parameter, where the branch ends.
            to: Largest value of the parameter, where the branch ends; more than `from`.
            motion_scale: What counts as 1 in motions, relative to the size of the mechanism and
                in radians; as the whole range does in the parameter. Default 1.
            first_step: Length of the first step: 1 is the whole range, or a motion of
                motion_scale. Default 0.02.
            smallest_step: Shortest step. Default 1e-6.
            largest_step: Longest step. Default 1.
            angle: Angle between the branch at neighbouring points that steps aim at [radians];
                steps by four thirds of it are taken again by half. Default 0.3.
            point_limit: Most points. Default 1000.
            progress: Told of each point; may end the branch. Default None.
            downwards: 1 if the parameter decreases at first. Default 0.
            events: 1 to look for branch points (where there are no conditions) and period
                doublings, too, by two more factorisations of the whole Jacobian a point.
                Default 0.
            stability: 1 to find the multipliers of each point, and with them torus points.
                Default 0.

        Returns:
            Branch: the branch
        """
        options = BranchOptions(
            periodic=periodic,
            conditions=conditions,
            from_=from_,
            to=to,
            motion_scale=motion_scale,
            first_step=first_step,
            smallest_step=smallest_step,
            largest_step=largest_step,
            angle=angle,
            point_limit=point_limit,
            progress=progress,
            downwards=downwards,
            events=events,
            stability=stability,
        )
        out = ffi.new("pdn_branch **")
        call(lib.pdn_solve_frequency_response, self._c, first, last, options._c, out)
        return Branch._made(out[0], self._kept)

    def solve_static(
        self,
        *,
        time=None,
        period=None,
        load_steps=None,
        tolerance=None,
        iteration_limit=None,
        angular_velocity=None,
        axis_point=None,
        initial=None,
        progress=None,
        memory_limit=None,
    ):
        """Finds an equilibrium at one time: of forces at rest, or in steady rotation.

        Newton's method with the exact tangent, after load steps from the unloaded reference
        configuration. Where these lead nowhere, as for a pendulum that is not in a position of
        equilibrium yet, the masses creep downhill. Not converging is no error: OK says that the
        solve was carried out, Solution.outcome how it ended, Solution.report why. A position
        that nothing determines, such as that of a free body, is SINGULAR.

        The solution has a grid of one point and the same values at any time.

        With options.angular_velocity everything turns steadily, the ground too: the solution is
        the equilibrium in the turning frame, under centrifugal and gyroscopic forces. Positions
        and directions are those in that frame, at a moment at which its axes are the inertial
        ones; velocities and accelerations of nodes are those in the inertial frame, in forces
        of yours on nodes, too; rates of joints, and dampers, know the motion in the frame only.
        Loads with FRAME_SPACE keep their directions in the turning frame, as the ground does.
        Gravity must be along the axis.

        Args:
            time: Loads and prescribed motions have their values at this time. Default 0.
            period: Period that harmonics and samples of signals refer to; 0 if not given, as at
                time 0, where it does not matter. Default 0.
            load_steps: Load steps taken at least, from the unloaded reference configuration; a
                step that does not converge is halved. More than one keeps to the branch that
                grows from the reference configuration, where there are several. Not used with
                an initial solution. Default 1.
            tolerance: As in PeriodicOptions. Default 1e-9.
            iteration_limit: Most Newton iterations at the full loads. Default 30.
            angular_velocity: Angular velocity of the frame that everything turns with steadily,
                the ground too, inertial frame [angle/time]. Default 0.
            axis_point: A point of the axis it turns about [length]. Default 0.
            initial: Start from this solution, at `time`, of a model with the same nodes and
                joints; None to start from the reference configuration. Default None.
            progress: Told of each iteration, and about ten times a second while one lasts; may
                cancel. Default None.
            memory_limit: Bytes of memory that the solve may take, by an estimate that is made
                before it begins, with the modes of Model.solve_modes: what would take more is
                ERR_MEMORY, and the message tells the estimate. 0 for no limit but that of the
                system. Default 0.

        Returns:
            Solution: the solution, also if it has not converged
        """
        options = StaticOptions(
            time=time,
            period=period,
            load_steps=load_steps,
            tolerance=tolerance,
            iteration_limit=iteration_limit,
            angular_velocity=angular_velocity,
            axis_point=axis_point,
            initial=initial,
            progress=progress,
            memory_limit=memory_limit,
        )
        out = ffi.new("pdn_solution **")
        call(lib.pdn_solve_static, self._c, options._c, out)
        return Solution._made(out[0], self._kept)

    def solve_modes(self, *, equilibrium=None, count=None, near_frequency=None):
        """Finds an equilibrium and the modes of small motions `Re(x exp(s t))` about it.

        The equations of motion with their exact tangents are linearised to `(s² M + s C + K) x
        = 0`, constraints, internal states of viscoelastic forces, and in a turning frame
        gyroscopic and centrifugal terms included. Of conjugate pairs of eigenvalues s one is
        given; constraints make no modes. Each free motion is a mode whose s is exactly 0.

        That there is no equilibrium is no error: Modes.outcome tells, and there are no modes.

        Args:
            equilibrium: The equilibrium, at rest or in steady rotation, how to find it, and who
                is told of the iterations; None for the defaults of StaticOptions. Default None.
            count: Number of modes wanted. Default 10.
            near_frequency: Angular frequency near which modes are wanted [angle/time]; 0 for
                those of the smallest eigenvalues. Default 0.

        Returns:
            Modes: the modes
        """
        options = ModesOptions(
            equilibrium=equilibrium,
            count=count,
            near_frequency=near_frequency,
        )
        out = ffi.new("pdn_modes **")
        call(lib.pdn_solve_modes, self._c, options._c, out)
        return Modes._made(out[0], self._kept)

    def solve_march(
        self,
        *,
        start_time=None,
        duration=None,
        period=None,
        step=None,
        steps_per_period=None,
        spectral_radius=None,
        error_tolerance=None,
        periodic_tolerance=None,
        most_periods=None,
        stored_periods=None,
        tolerance=None,
        iteration_limit=None,
        initial=None,
        positions=None,
        rotations=None,
        velocities=None,
        progress=None,
        memory_limit=None,
    ):
        """Marches a model in time, for a given duration or until its motion repeats itself.

        The generalised-alpha method on SE(3) for the equations of index 3 (Arnold and Bruels
        2007; Bruels, Cardona and Arnold 2012), of second order: motions are updated by the
        exponential map, equilibrium and constraints hold at the end of each step. It starts in
        the reference configuration at rest unless another start is given, but what hangs on a
        prescribed rotation turns with it as one rigid body, if the joints let it: a blade is
        not left behind a hub that spins. Then motions are moved and velocities changed by the
        least, by inertia, that satisfies the constraints and prescribed motions, and
        accelerations and reactions follow. Internal states of viscoelastic elements start
        relaxed, or as they are in the initial solution.

        The solution is a trajectory: the functions of solutions give its quantities at any
        times from its first to its last. Between steps motions, velocities and joint
        coordinates are interpolated by cubic polynomials, all else linearly. It has no
        harmonics. Not reaching the end is no error: Solution.outcome tells, and the trajectory
        is there as far as it came. It serves as `initial` of other solves; of a periodic one,
        its last period does.

        Args:
            start_time: When the march starts. Default 0.
            duration: How long it is; leave it 0 to march until periodic. Default 0.
            period: Period T that harmonics and samples of signals refer to, and that the motion
                may repeat itself with; 0 if neither matters. Steps must not be longer, unless
                error_tolerance chooses them. Default 0.
            step: Length of the steps, made shorter by what lets a whole number of them fit the
                duration or the period. With error_tolerance the length of the first. Default 0.
            steps_per_period: If not 0, the steps are period / steps_per_period. Default 0.
            spectral_radius: Spectral radius at infinite frequency, from 0 to 1: the numerical
                damping. With 1 no energy is lost, but the reactions of joints oscillate; 0
                removes at once what the steps do not resolve. Default 0.5.
            error_tolerance: If not 0, steps are chosen so that each has at most this estimated
                error of a motion (lengths relative to the size of the mechanism, angles in
                radians). Default 0.
            periodic_tolerance: If not 0, march until motions and velocities differ by at most
                this from the periodic ones, by how the differences from each period to the next
                decay: displacements relative to the size of the mechanism, entries of rotation
                matrices, velocities likewise in the time T / (2 pi). Default 0.
            most_periods: Most periods of a march until periodic; then its outcome is
                ITERATION_LIMIT. Default 200.
            stored_periods: Keep the steps of only so many of the last periods; all steps if 0.
                Default 0.
            tolerance: Newton's method in a step has converged when the largest increment is
                below this, as in PeriodicOptions. Default 1e-9.
            iteration_limit: Most Newton iterations in a step. Default 20.
            initial: Start from this solution of a model with the same nodes and joints, at
                start_time: an equilibrium, a periodic motion or another march; None to start
                otherwise. Default None.
            positions: Start from these positions, an array of shape 3 x [nodes]; None for those
                of the reference configuration. Needs rotations. Default None.
            rotations: Rotation matrices of the same start, an array of shape 9 x [nodes], each
                column by column. Default None.
            velocities: Velocities of the same start, an array of shape 6 x [nodes]: velocity of
                each node and its angular velocity, inertial frame; None for none. Default None.
            progress: Told of each step, and about ten times a second while one lasts; may
                cancel. Default None.
            memory_limit: Bytes of memory that the steps which are kept may take, by an
                estimate. A march whose number of steps is known, and takes more, is ERR_MEMORY
                before it begins; another that comes to take more ends there as WORK_LIMIT, with
                what was marched. 0 for no limit but that of the system. Default 0.

        Returns:
            Solution: the solution, also if the march ended early
        """
        options = MarchOptions(
            start_time=start_time,
            duration=duration,
            period=period,
            step=step,
            steps_per_period=steps_per_period,
            spectral_radius=spectral_radius,
            error_tolerance=error_tolerance,
            periodic_tolerance=periodic_tolerance,
            most_periods=most_periods,
            stored_periods=stored_periods,
            tolerance=tolerance,
            iteration_limit=iteration_limit,
            initial=initial,
            positions=positions,
            rotations=rotations,
            velocities=velocities,
            progress=progress,
            memory_limit=memory_limit,
        )
        like("positions", positions, (self.node_count(), 3))
        like("rotations", rotations, (self.node_count(), 3, 3))
        like("velocities", velocities, (self.node_count(), 6))
        out = ffi.new("pdn_solution **")
        call(lib.pdn_solve_march, self._c, options._c, out)
        return Solution._made(out[0], self._kept)

    def solve_shooting(
        self,
        period,
        *,
        steps_per_period=None,
        guess_periods=None,
        spectral_radius=None,
        tolerance=None,
        iteration_limit=None,
        initial=None,
        progress=None,
        memory_limit=None,
    ):
        """Finds the periodic response of a model by shooting: Newton's method on the period map of
        Model.solve_march.

        What is found is the periodic motion of the marching scheme, of second order in its
        step; the derivative of the map is exact. It needs time and memory that grow with the
        square of the number of nodes; it is there to compare with, and for the Floquet
        multipliers, which tell whether the motion is stable.

        The solution is a trajectory over one period, from 0 to T. Not converging is no error:
        Solution.outcome tells. A motion that may be shifted in time or space, as without a
        drive or without damping, is SINGULAR.

        Args:
            period: T, the period of the response; harmonics of signals are those of this period
            steps_per_period: Number of equal steps to the period. Default 200.
            guess_periods: Periods marched for the first guess. Default 1.
            spectral_radius: Spectral radius at infinite frequency, from 0 to less than 1, as in
                MarchOptions. Default 0.5.
            tolerance: Converged when the largest increment of a motion or velocity at the start
                (lengths relative to the size of the mechanism, angles in radians, velocities in
                the time T / (2 pi)) is below this. Default 1e-8.
            iteration_limit: Most Newton iterations. Default 30.
            initial: Start the march from this solution of a model with the same nodes and
                joints, at its time 0 or, of a march, at its first time; None for the reference
                configuration at rest. Default None.
            progress: Told of each period of the guess and of each iteration, and about ten
                times a second while one lasts; may cancel. Default None.
            memory_limit: Bytes of memory that the solve may take, by an estimate that is made
                before it begins: what would take more is ERR_MEMORY, and the message tells the
                estimate. 0 for no limit but that of the system. Default 0.

        Returns:
            Solution: the solution, also if it has not converged
        """
        options = ShootingOptions(
            steps_per_period=steps_per_period,
            guess_periods=guess_periods,
            spectral_radius=spectral_radius,
            tolerance=tolerance,
            iteration_limit=iteration_limit,
            initial=initial,
            progress=progress,
            memory_limit=memory_limit,
        )
        out = ffi.new("pdn_solution **")
        call(lib.pdn_solve_shooting, self._c, period, options._c, out)
        return Solution._made(out[0], self._kept)

    def summary(self):
        """Counts, mass, degrees of freedom and mobility of a model in its reference configuration.

        Returns:
            Summary
        """
        out = Summary()
        call(lib.pdn_model_summary, self._c, out._c)
        return out

    def describe(self):
        """The same in readable lines, with warnings: parts that nothing connects or holds, ends of
        beams without a joint, nodes without inertia, joints open in the reference configuration
        or far from all else, impossible moments of inertia, sizes, masses and stiffnesses that
        do not fit each other.
        """
        return text.of(lib.pdn_model_describe, self._c)

    def copy(self):
        """A copy of a model, which may be changed and solved apart from it.

        Returns:
            Model: the copy. It shares the callbacks of the model and their user_data
        """
        out = ffi.new("pdn_model **")
        call(lib.pdn_model_copy, self._c, out)
        return Model._made(out[0], self._kept)

    def save(self, path):
        """Saves a model.

        Model.load gives it back. Callbacks cannot be saved: see there. The format is the same
        on all platforms, and later versions of the library read it.

        Args:
            path: where to, UTF-8. A file that is there is replaced when all is written; if that
                fails it stays as it was
        """
        call(lib.pdn_model_save, self._c, text(path))

    @staticmethod
    def load(path):
        """Loads a model that Model.save saved; its ids are what they were.

        If it had callbacks, in signals or forces, a solve of it fails with ERR_CALLBACK, as
        they are not there.

        Args:
            path: the file, UTF-8. It need not be trusted: its checksum and everything in it are
                checked

        Returns:
            Model: the model
        """
        out = ffi.new("pdn_model **")
        call(lib.pdn_model_load, text(path), out)
        return Model._made(out[0], [])


class Modes(ModesExtras):
    """An equilibrium and the modes about it. Made by Model.solve_modes, freed by Modes.free."""

    _free = lib.pdn_modes_free

    def outcome(self):
        """How the search for the equilibrium ended."""
        return lib.pdn_modes_outcome(self._c)

    def report(self):
        """A readable report: outcome of the equilibrium and why, and a table of the modes."""
        return text.of(lib.pdn_modes_report, self._c)

    def count(self):
        """Number of modes: as many as were wanted, if there are and they were found.

        Returns:
            out: the number
            complete: 1 if the wanted number was found, or all that there are, else 0
        """
        out = ffi.new("int32_t *")
        complete = ffi.new("int32_t *")
        call(lib.pdn_modes_count, self._c, out, complete)
        return out[0], complete[0]

    def get(self, mode):
        """Eigenvalue, frequency and damping of a mode.

        Args:
            mode: number of the mode, from 0; the smallest eigenvalue, or the nearest to the
                wanted frequency, is first

        Returns:
            Mode
        """
        out = Mode()
        call(lib.pdn_modes_get, self._c, mode, out._c)
        return out

    def shape(self, mode, nodes):
        """Shape x of a mode at some nodes.

        For each node its small displacement and rotation along the node's own axes, as they are
        in the equilibrium. The largest component of all nodes is 1, with displacements relative
        to the size of the mechanism and rotations in radians.

        Args:
            mode: number of the mode, from 0
            nodes: ids of the nodes

        Returns:
            real, of shape (count, 6): real part, components fastest
            imaginary, of shape (count, 6): imaginary part
        """
        nodes = ids("nodes", nodes)
        _count = len(nodes)
        real = reals.empty((_count, 6))
        imaginary = reals.empty((_count, 6))
        call(
            lib.pdn_modes_shape,
            self._c,
            mode,
            ffi.from_buffer("int32_t[]", nodes),
            _count,
            pointer(real),
            pointer(imaginary),
        )
        return real, imaginary

    def motion(self, mode, amplitude):
        """The motion in a mode, to be looked at as any other solution.

        From the equilibrium each node moves by the exponential of `amplitude Re(x exp(i ω t))`,
        with ω = Im s: it neither decays nor grows, and repeats after 2π/ω. For a real s, ω is
        its size; for a free motion the period is that of the options, or 1. The equations hold
        but for the square of the amplitude.

        Args:
            mode: number of the mode, from 0
            amplitude: factor of the shape

        Returns:
            Solution: the solution
        """
        out = ffi.new("pdn_solution **")
        call(lib.pdn_modes_motion, self._c, mode, amplitude, out)
        return Solution._made(out[0], self._kept)

    def equilibrium(self):
        """The equilibrium, as Model.solve_static gives it, converged or not.

        Returns:
            Solution: the solution
        """
        out = ffi.new("pdn_solution **")
        call(lib.pdn_modes_equilibrium, self._c, out)
        return Solution._made(out[0], self._kept)


class Sensitivities(Handle):
    """What is differentiated, by what. Made by SensitivitiesNew, freed by SensitivitiesFree."""

    _free = lib.pdn_sensitivities_free

    def __init__(self):
        """Makes an empty list: nothing is differentiated.

        It belongs to no model; ids are looked up when it is used.
        """
        out = ffi.new("pdn_sensitivities **")
        call(lib.pdn_sensitivities_new, out)
        self._own(out[0])

    def add_quantity(self, quantity, feature, at=0.0):
        """Adds a dependent: the mean, a harmonic, the value at a time, or a peak of a quantity.

        Args:
            quantity: one component of a quantity,
            feature: FEATURE_MEAN, FEATURE_COSINE, FEATURE_SINE, FEATURE_VALUE, FEATURE_LARGEST
                or FEATURE_SMALLEST
            at: the number of the harmonic, from 1, or the time; usually 0 for all else, where
                it is not looked at
        """
        quantity = of_type("Quantity")(quantity, self._kept, "quantity")
        call(lib.pdn_sensitivities_add_quantity, self._c, quantity, feature, at)

    def add_found(self, parameter):
        """Adds a dependent: the value of a free parameter, which conditions determine.

        Args:
            parameter: id of a parameter, or FREQUENCY
        """
        call(lib.pdn_sensitivities_add_found, self._c, parameter)

    def add_parameter(self, parameter):
        """Adds a parameter that all is differentiated by.

        Args:
            parameter: id of a parameter, or FREQUENCY
        """
        call(lib.pdn_sensitivities_add_parameter, self._c, parameter)


class Solution(SolutionExtras):
    """A solution, converged or not. Made by Model.solve_periodic, Model.solve_static,
    Model.solve_march and Modes.motion, freed by Solution.free.

    That of a march is a trajectory: the same functions give its quantities at times from its
    first to its last (ERR_VALUE for any other), but it has no harmonics (ERR_NOT_AVAILABLE).
    """

    _free = lib.pdn_solution_free

    def outcome(self):
        """How the solve ended.

        Unless it is CONVERGED or TOLERANCE_NOT_MET the solution's quantities are those of the
        last iterate.
        """
        return lib.pdn_solution_outcome(self._c)

    def report(self):
        """A readable report: outcome and why, iterations, error estimates, time spent."""
        return text.of(lib.pdn_solution_report, self._c)

    def report_json(self):
        """The report as JSON, for programs: an object with the texts `kind`, `outcome`,
        `explanation` and `report`; sizes; `grids` and `attempts`; the Newton `iterations`;
        `estimates`, named as in pdn_diagnostics; what iteration of `linear` equations took; and
        `seconds`. What is not known, or does not apply, is null.
        """
        return text.of(lib.pdn_solution_report_json, self._c)

    def diagnostics(self):
        """Figures of a solve: iterations, error estimates, residuals between grid points, time
        spent.

        Returns:
            Diagnostics
        """
        out = Diagnostics()
        call(lib.pdn_solution_diagnostics, self._c, out._c)
        return out

    def history(self):
        """History of the Newton iterations of the periodic problem.

        Returns:
            residuals, of shape (count)
            increments, of shape (count)
            steps, of shape (count)
        """
        _count = self.diagnostics().iterations
        residuals = reals.empty((_count,))
        increments = reals.empty((_count,))
        steps = reals.empty((_count,))
        call(
            lib.pdn_solution_history,
            self._c,
            pointer(residuals),
            pointer(increments),
            pointer(steps),
            _count,
        )
        return residuals, increments, steps

    def decay(self):
        """Decay of the harmonics: largest amplitude of each over all nodes, of positions relative
        to the size of the mechanism and of entries of rotation matrices.

        Returns:
            amplitudes, of shape (count): harmonics 0, 1, ..., (N - 1) / 2
        """
        _count = (self.diagnostics().grid_points + 1) // 2
        amplitudes = reals.empty((_count,))
        call(lib.pdn_solution_decay, self._c, pointer(amplitudes), _count)
        return amplitudes

    def sharp_event_count(self):
        """Number of events that the grid points of a solution are closer together about: 0 if they
        are equispaced.

        Returns:
            out: the number
        """
        out = ffi.new("size_t *")
        call(lib.pdn_solution_sharp_event_count, self._c, out)
        return out[0]

    def sharp_events(self):
        """Events that the grid points of a solution are closer together about, those of
        pdn_periodic_options or such as a solve to a tolerance has found.

        Returns:
            times, of shape (count): their times
            widths, of shape (count): half-widths of the additional density of grid points
            shares, of shape (count): shares of the grid points, beside 1 for the rest
        """
        _count = self.sharp_event_count()
        times = reals.empty((_count,))
        widths = reals.empty((_count,))
        shares = reals.empty((_count,))
        call(
            lib.pdn_solution_sharp_events,
            self._c,
            pointer(times),
            pointer(widths),
            pointer(shares),
            _count,
        )
        return times, widths, shares

    def grid_times(self):
        """Grid times t_k = k T / N, unless grid points are closer together about events; of a
        march the times of its steps, from the start.

        Returns:
            times, of shape (count)
        """
        _count = self.diagnostics().grid_points
        times = reals.empty((_count,))
        call(lib.pdn_solution_grid_times, self._c, pointer(times), _count)
        return times

    def sample(self, quantity, times):
        """A quantity of a solution at any times.

        Motions of nodes are interpolated over the whole period by dual polar decomposition, all
        else from its values at the grid points.

        Args:
            quantity: what is asked for, C components
            times: array of shape (count): times, also outside the first period

        Returns:
            out, of shape (count, components): components of each time together
        """
        quantity = of_type("Quantity")(quantity, self._kept, "quantity")
        times = reals("times", times, (None,))
        _count = len(times)
        components = max(lib.pdn_quantity_components(quantity), 1)
        out = reals.empty((_count, components))
        call(lib.pdn_solution_sample, self._c, quantity, pointer(times), _count, pointer(out))
        return out[..., 0] if components == 1 else out

    def harmonics(self, quantity, harmonics):
        """Fourier coefficients of a quantity: mean + rate t + sum of cosines[j] cos jwt + sines[j]
        sin jwt.

        Those of the trigonometric polynomial through the values at the grid points.

        Args:
            quantity: what is asked for, C components
            harmonics: number of harmonics wanted; those above (N - 1) / 2 are zero

        Returns:
            mean, of shape (components)
            rate, of shape (components): growth per unit of time, of what gains turns
            cosines, of shape (harmonics, components): components of each harmonic together
            sines, of shape (harmonics, components): components of each harmonic together
        """
        quantity = of_type("Quantity")(quantity, self._kept, "quantity")
        harmonics = whole("harmonics", harmonics)
        components = max(lib.pdn_quantity_components(quantity), 1)
        mean = reals.empty((components,))
        rate = reals.empty((components,))
        cosines = reals.empty((harmonics, components))
        sines = reals.empty((harmonics, components))
        call(
            lib.pdn_solution_harmonics,
            self._c,
            quantity,
            harmonics,
            pointer(mean),
            pointer(rate),
            pointer(cosines),
            pointer(sines),
        )
        return (
            mean[..., 0] if components == 1 else mean,
            rate[..., 0] if components == 1 else rate,
            cosines[..., 0] if components == 1 else cosines,
            sines[..., 0] if components == 1 else sines,
        )

    def extremes(self, quantity):
        """Smallest and largest values of a quantity, and their times.

        Over the period, of the trigonometric polynomial through the values at the grid points;
        of a trajectory, among its times.

        Args:
            quantity: what is asked for, C components

        Returns:
            smallest, of shape (components)
            time_of_smallest, of shape (components)
            largest, of shape (components)
            time_of_largest, of shape (components)
        """
        quantity = of_type("Quantity")(quantity, self._kept, "quantity")
        components = max(lib.pdn_quantity_components(quantity), 1)
        smallest = reals.empty((components,))
        time_of_smallest = reals.empty((components,))
        largest = reals.empty((components,))
        time_of_largest = reals.empty((components,))
        call(
            lib.pdn_solution_extremes,
            self._c,
            quantity,
            pointer(smallest),
            pointer(time_of_smallest),
            pointer(largest),
            pointer(time_of_largest),
        )
        return (
            smallest[..., 0] if components == 1 else smallest,
            time_of_smallest[..., 0] if components == 1 else time_of_smallest,
            largest[..., 0] if components == 1 else largest,
            time_of_largest[..., 0] if components == 1 else time_of_largest,
        )

    def filtered(self, filter, order):
        """A copy of a solution whose quantities are seen through a spectral filter.

        Where a response has a kink or a narrow peak (DECAY_SLOW), forces oscillate about their
        values over the whole period, as all Fourier sums do (Gibbs). A filter weakens the
        harmonics towards the highest: the oscillations stay near the peak, which itself gets
        lower and wider. Without one, nothing is filtered.

        It acts on values at any time, on harmonics, tables and animations. The motions of nodes
        are filtered as motions, and velocities follow from them. The solve, its diagnostics and
        report, and what starts from the copy are those of the solution. A filter that the
        solution has already is replaced.

        Args:
            filter: FILTER_LANCZOS or FILTER_EXPONENTIAL
            order: from 1 to 32

        Returns:
            Solution: the copy
        """
        out = ffi.new("pdn_solution **")
        call(lib.pdn_solution_filtered, self._c, filter, order, out)
        return Solution._made(out[0], self._kept)

    def parameter(self, parameter):
        """Value of a parameter in a solution: given, or found.

        Args:
            parameter: id of the parameter, or FREQUENCY

        Returns:
            out: the value
        """
        out = ffi.new("double *")
        call(lib.pdn_solution_parameter, self._c, parameter, out)
        return out[0]

    def sensitivities(
        self,
        sensitivities,
        dependents,
        parameters,
        conditions=None,
        *,
        method=None,
        linear_solver=None,
        threads=None,
    ):
        """Derivatives of what comes out of a periodic solution by parameters of its model.

        All else stays, but for the free parameters of `conditions`, which follow so that these
        go on to be met: sensitivities at trim, or along an unknown period. A condition on the
        phase is that of this solution; values that conditions ask for are not looked at but as
        those of the solution. A parameter that moves nothing has zeros. Peaks vary as the value
        at their time does; a quantity that has its peak at two times has no sensitivity. The
        equations are linearised and factored once; each parameter, or each dependent, takes a
        solve with the factors.

        Args:
            sensitivities: what is differentiated, by what
            conditions: free parameters and as many conditions; None for none
            method: SENSITIVITY_AUTOMATIC, the default, SENSITIVITY_DIRECT or
                SENSITIVITY_ADJOINT.
            linear_solver: How linear equations are solved: LINEAR_AUTOMATIC, ... Default
                LINEAR_AUTOMATIC.
            threads: Threads that share the work; 0 for as many as there are processors. Default
                1.
            dependents: number of the dependents
            parameters: number of the parameters

        Returns:
            derivatives, of shape (parameters, dependents): those by a parameter together
        """
        options = SensitivityOptions(
            method=method,
            linear_solver=linear_solver,
            threads=threads,
        )
        derivatives = reals.empty((parameters, dependents))
        dependents = whole("dependents", dependents)
        parameters = whole("parameters", parameters)
        call(
            lib.pdn_solution_sensitivities,
            self._c,
            pointer(sensitivities),
            pointer(conditions),
            options._c,
            pointer(derivatives),
            dependents,
            parameters,
        )
        return derivatives

    def multiplier_sensitivities(
        self,
        sensitivities,
        stability,
        number,
        parameters,
        conditions=None,
        *,
        method=None,
        linear_solver=None,
        threads=None,
    ):
        """Derivatives of a Floquet multiplier of a periodic solution by parameters of its model.

        The solution follows the parameters, and so do the free parameters of `conditions`, so
        that these go on to be met. The multiplier is first found once more, from the equations
        on the grid of the solution, whose derivatives these are: that takes a complex
        factorisation for each of a few iterations. A multiplier that is not the only one of its
        value, or that is 1 because its mode moves the solution in time or space, has no
        derivatives.

        Args:
            sensitivities: the parameters; what else it lists is of no account
            stability: the multipliers of this solution
            number: number of the multiplier among these, from 0
            conditions: free parameters and as many conditions; None for none
            method: SENSITIVITY_AUTOMATIC, the default, SENSITIVITY_DIRECT or
                SENSITIVITY_ADJOINT.
            linear_solver: How linear equations are solved: LINEAR_AUTOMATIC, ... Default
                LINEAR_AUTOMATIC.
            threads: Threads that share the work; 0 for as many as there are processors. Default
                1.
            parameters: number of the parameters

        Returns:
            re, of shape (parameters): derivatives of the real part
            im, of shape (parameters): those of the imaginary part
        """
        options = SensitivityOptions(
            method=method,
            linear_solver=linear_solver,
            threads=threads,
        )
        re = reals.empty((parameters,))
        im = reals.empty((parameters,))
        parameters = whole("parameters", parameters)
        call(
            lib.pdn_solution_multiplier_sensitivities,
            self._c,
            pointer(sensitivities),
            pointer(stability),
            number,
            pointer(conditions),
            options._c,
            pointer(re),
            pointer(im),
            parameters,
        )
        return re, im

    def march(self):
        """Figures of a march: steps, periods, how much the last of them differ, how much the start
        was changed.

        Returns:
            MarchDiagnostics
        """
        out = MarchDiagnostics()
        call(lib.pdn_solution_march, self._c, out._c)
        return out

    def floquet_count(self):
        """Number of Floquet multipliers of a solution: as many as the system has states, if
        Model.solve_shooting found them; of a periodic solution as many as
        Solution.solve_stability finds, which is called with default options unless it has been
        before.

        Returns:
            out: the number; zero of a march
        """
        out = ffi.new("size_t *")
        call(lib.pdn_solution_floquet_count, self._c, out)
        return out[0]

    def floquet(self):
        """Floquet multipliers: what disturbances of the motion are multiplied by in a period, the
        largest first.

        The motion is stable if all are smaller than 1 in magnitude. Those of shooting are of
        the marching scheme, with its error and its numerical damping; Solution.solve_stability
        tells more of those of periodic solutions.

        Returns:
            real, of shape (count)
            imaginary, of shape (count)
        """
        _count = self.floquet_count()
        real = reals.empty((_count,))
        imaginary = reals.empty((_count,))
        call(lib.pdn_solution_floquet, self._c, pointer(real), pointer(imaginary), _count)
        return real, imaginary

    def solve_stability(self, *, highest_frequency=None, tolerance=None, progress=None):
        """Finds the Floquet multipliers of a periodic solution: what small disturbances are
        multiplied by in a period.

        Disturbances obey the exact linearised equations, constraints, redundant ones too, and
        internal states included, about the solution interpolated between its grid points. They
        are integrated over the period in steps that are halved until the multipliers of modes
        up to the highest frequency stand still. The error of the periodic solution itself comes
        with theirs.

        Args:
            highest_frequency: Modes of up to this angular frequency matter [angle/time]; 0 for
                20 times that of the period. Default 0.
            tolerance: Estimated error of the multipliers of these modes, in units of 1 or of
                the multiplier where that is more. Default 1e-8.
            progress: Told about ten times a second that work goes on; may cancel. Default None.

        Returns:
            Stability: the multipliers
        """
        options = StabilityOptions(
            highest_frequency=highest_frequency,
            tolerance=tolerance,
            progress=progress,
        )
        out = ffi.new("pdn_stability **")
        call(lib.pdn_solve_stability, self._c, options._c, out)
        return Stability._made(out[0], self._kept)

    def write_vtk(self, times, points_per_element, path):
        """Writes an animation of a solution that ParaView opens: VTK's XML files, and a list of
        them.

        `path` names the list; the files are put into a directory beside it that has its name
        without `.pvd`. For each time there is one file for each of these parts that the model
        has:

        - `beams`: a line of `points_per_element` points for each beam element (draw it with the
          filter Tube). Each point has displacement, axes of the section (axis_1, axis_2,
          axis_3), and force, moment, strain, curvature along these axes; each line its element;
        - `shells`: a curved quadrilateral of its own order for each shell element, with
          displacement, axes (those of the section and the normal), strains and resultants along
          these, and of isotropic shells stress_top and stress_bottom with von Mises' stresses;
          each its element;
        - `bodies`: the nodes that carry a rigid body or belong to no beam and no shell, with
          node, displacement, axes, velocity, angular_velocity;
        - `joints`: the origins of the joint frames on the second bodies, with joint,
          displacement, axes, reaction_force, reaction_moment.

        Displacements are from the reference configuration. Vectors are along the inertial axes,
        but for the internal forces and strains of beams.

        Args:
            times: array of shape (count): times of the animation, ascending, also outside the
                first period
            points_per_element: points along each beam element, 2 to 1000
            path: where to, UTF-8, ending in `.pvd`. Files of these names are replaced; if
                writing fails, they stay as they were
        """
        times = reals("times", times, (None,))
        _count = len(times)
        points_per_element = whole("points_per_element", points_per_element)
        call(
            lib.pdn_solution_write_vtk,
            self._c,
            pointer(times),
            _count,
            points_per_element,
            text(path),
        )

    def save(self, path):
        """Saves a solution with its model, whether it has converged or not.

        Solution.load gives it back, to the last bit. Callbacks cannot be saved: see there. The
        format is the same on all platforms, and later versions of the library read it.

        Args:
            path: where to, UTF-8. A file that is there is replaced when all is written; if that
                fails it stays as it was
        """
        call(lib.pdn_solution_save, self._c, text(path))

    @staticmethod
    def load(path):
        """Loads a solution that Solution.save saved: its quantities, diagnostics and report are
        what they were.

        A solve may start from it (the option `initial`), of your model or of the one that
        Solution.model gives. If the solved model had callbacks, in signals or forces, the
        quantities of the solution are there all the same; but a solve of the model that was
        loaded with it fails with ERR_CALLBACK, as its callbacks are not.

        Args:
            path: the file, UTF-8. It need not be trusted: its checksum and everything in it are
                checked

        Returns:
            Solution: the solution
        """
        out = ffi.new("pdn_solution **")
        call(lib.pdn_solution_load, text(path), out)
        return Solution._made(out[0], [])

    def model(self):
        """A copy of the model that a solution is of, as it was when it was solved.

        Returns:
            Model: the model
        """
        out = ffi.new("pdn_model **")
        call(lib.pdn_solution_model, self._c, out)
        return Model._made(out[0], self._kept)


class Stability(StabilityExtras):
    """Floquet multipliers of a periodic solution. Made by Solution.solve_stability, freed by
    Stability.free.
    """

    _free = lib.pdn_stability_free

    def outcome(self):
        """How the analysis ended."""
        return lib.pdn_stability_outcome(self._c)

    def verdict(self):
        """What the multipliers say.

        Returns:
            verdict: STABLE, UNSTABLE or STABILITY_NOT_KNOWN
            frequency_limit: angular frequency of modes up to which the verdict holds; infinite
                if all multipliers are known
        """
        verdict = ffi.new("int32_t *")
        frequency_limit = ffi.new("double *")
        call(lib.pdn_stability_verdict, self._c, verdict, frequency_limit)
        return verdict[0], frequency_limit[0]

    def count(self):
        """Number of multipliers that are known, and of those that the system has, one for each
        state.

        Multipliers of modes far above the highest frequency that was asked for may be left out.

        Returns:
            out: the number that are known
            states: the number that the system has
        """
        out = ffi.new("size_t *")
        states = ffi.new("size_t *")
        call(lib.pdn_stability_count, self._c, out, states)
        return out[0], states[0]

    def get(self, number):
        """A multiplier.

        Args:
            number: its number, from 0: the largest is first, of a conjugate pair that with the
                positive imaginary part

        Returns:
            Multiplier
        """
        out = Multiplier()
        call(lib.pdn_stability_get, self._c, number, out._c)
        return out

    def time_count(self):
        """Number of times of the shapes of modes.

        Returns:
            out: the number
        """
        out = ffi.new("size_t *")
        call(lib.pdn_stability_time_count, self._c, out)
        return out[0]

    def times(self):
        """Times of the shapes of modes: ends of equal steps over the period, the last is the
        period.

        Returns:
            times, of shape (count)
        """
        _count = self.time_count()
        times = reals.empty((_count,))
        call(lib.pdn_stability_times, self._c, pointer(times), _count)
        return times

    def shape(self, number, node):
        """The mode phi of a multiplier at a node over the period.

        Small displacements and rotations along the node's own axes, at the times of
        Stability.times. The largest component of all nodes over the period is 1, with
        displacements relative to the size of the mechanism and rotations in radians.

        Args:
            number: number of the multiplier, from 0
            node: id of the node

        Returns:
            real, of shape (steps, 6): real part, components fastest
            imaginary, of shape (steps, 6): imaginary part
        """
        _steps = self.time_count()
        real = reals.empty((_steps, 6))
        imaginary = reals.empty((_steps, 6))
        call(
            lib.pdn_stability_shape,
            self._c,
            number,
            node,
            _steps,
            pointer(real),
            pointer(imaginary),
        )
        return real, imaginary

    def report(self):
        """A readable report: the verdict, how far it holds, and a table of the multipliers."""
        return text.of(lib.pdn_stability_report, self._c)


class Table(TableExtras):
    """Columns of numbers over the same times. Made by Table.new, freed by Table.free."""

    _free = lib.pdn_table_free

    def add_quantity(self, solution, quantity, label=None):
        """Adds the columns of a quantity of a solution, named by the label and the component; or
        that of one component, named by the label alone.

        Args:
            solution: the solution
            quantity: what is asked for; one column for each component
            label: columns are called `label.x` and so on; None for a name such as
                `node3.position`
        """
        quantity = of_type("Quantity")(quantity, self._kept, "quantity")
        call(lib.pdn_table_add_quantity, self._c, pointer(solution), quantity, text(label))

    def __init__(self, times):
        """A table over these times, to choose columns for and to write as CSV.

        Its first column, `t`, are the times. Columns come from one solution or from several,
        which are sampled as they are added and may then be freed.

        Args:
            times: array of shape (count): times, also outside the first period, in any order
        """
        times = reals("times", times, (None,))
        _count = len(times)
        out = ffi.new("pdn_table **")
        call(lib.pdn_table_new, pointer(times), _count, out)
        self._own(out[0])

    def add_values(self, label, values):
        """Adds a column of values of your own, such as one computed from several quantities.

        Args:
            label: name of the column
            values: array of shape (count): a value for each time
        """
        values = reals("values", values, (None,))
        _count = len(values)
        call(lib.pdn_table_add_values, self._c, text(label), pointer(values), _count)

    def write_csv(self, path):
        """Writes a table as a CSV file: a line of names, then a line for each time.

        Columns are separated by commas, names with commas or quotes are quoted. Numbers have as
        many digits as it takes to read them back exactly.

        Args:
            path: where to, UTF-8. A file that is there is replaced when all is written; if that
                fails it stays as it was. A terminal or pipe, such as "/dev/stdout", is written
                to directly
        """
        call(lib.pdn_table_write_csv, self._c, text(path))


def version():
    """Version of the library, such as "0.1.0"."""
    return ffi.string(lib.pdn_version()).decode()


def build_info():
    """How the library was built: version, profile and platform, for reports of defects."""
    return ffi.string(lib.pdn_build_info()).decode()


def status_name(status):
    """Name of a status, such as "ERR_None".

    Args:
        status: any number
    """
    return ffi.string(lib.pdn_status_name(status)).decode()


def release_memory():
    """Gives the system back the memory that the library keeps for later solves.

    Up to 512 MiB of large lists are kept for others when a solve ends or a handle is freed, as
    the system takes time to give them. Solves under way and handles keep all that they have.
    """
    call(lib.pdn_release_memory)


def motion_interpolate(period, positions, rotations, times):
    """Interpolates a periodic motion given at N equispaced times, by dual polar decomposition.

    Exponentially accurate as N grows, for rotations and translations of any size (section 4 of
    Han and Bauchau, Nonlinear Dynamics 92, 2018).

    Args:
        period: T, the period of the motion
        positions: array of shape (points, 3): positions at t = k T / N
        rotations: array of shape (points, 3, 3): rotation matrices, each column by column
        times: array of shape (count): times wanted, anywhere

    Returns:
        position, of shape (count, 3)
        rotation, of shape (count, 3, 3): each matrix column by column
        velocity, of shape (count, 6): linear and angular velocity along the moving axes
        acceleration, of shape (count, 6): time derivative of velocity
    """
    positions = reals("positions", positions, (None, 3))
    _points = len(positions)
    rotations = reals("rotations", rotations, (_points, 3, 3), turned=True)
    times = reals("times", times, (None,))
    _count = len(times)
    position = reals.empty((_count, 3))
    rotation = reals.empty((_count, 3, 3))
    velocity = reals.empty((_count, 6))
    acceleration = reals.empty((_count, 6))
    call(
        lib.pdn_motion_interpolate,
        period,
        pointer(positions),
        pointer(rotations),
        _points,
        pointer(times),
        _count,
        pointer(position),
        pointer(rotation),
        pointer(velocity),
        pointer(acceleration),
    )
    return position, rotation.swapaxes(-1, -2), velocity, acceleration


def motion_grid_kinematics(period, positions, rotations):
    """Velocities and accelerations of a motion at its own grid points, and their exact
    linearisation.

    With the material increments u = (R^T dr, dpsi) of the motions, ordered as 6 for each point,
    d velocity = velocity_tangent u and d acceleration = acceleration_tangent u (eqs. 24 to 29
    of the paper).

    Args:
        period: T, the period of the motion
        positions: array of shape (points, 3): positions at t = k T / N
        rotations: array of shape (points, 3, 3): rotation matrices, each column by column

    Returns:
        velocity, of shape (points, 6): linear and angular velocity along the moving axes
        acceleration, of shape (points, 6): time derivative of velocity
        velocity_tangent, of shape (6 * points, 6 * points): derivatives of velocity by u
        acceleration_tangent, of shape (6 * points, 6 * points): derivatives of acceleration by
            u
    """
    positions = reals("positions", positions, (None, 3))
    _points = len(positions)
    rotations = reals("rotations", rotations, (_points, 3, 3), turned=True)
    velocity = reals.empty((_points, 6))
    acceleration = reals.empty((_points, 6))
    velocity_tangent = reals.empty((6 * _points, 6 * _points))
    acceleration_tangent = reals.empty((6 * _points, 6 * _points))
    call(
        lib.pdn_motion_grid_kinematics,
        period,
        pointer(positions),
        pointer(rotations),
        _points,
        pointer(velocity),
        pointer(acceleration),
        pointer(velocity_tangent),
        pointer(acceleration_tangent),
    )
    return (
        velocity,
        acceleration,
        velocity_tangent.swapaxes(-1, -2),
        acceleration_tangent.swapaxes(-1, -2),
    )


def joint_frame(point, axis_3, axis_1):
    """A frame from a point and two directions, such as that of a joint or a bushing.

    Args:
        point: array of shape (3): its origin, global coordinates [length]
        axis_3: array of shape (3): direction of its axis 3, global coordinates, of any nonzero
            length
        axis_1: array of shape (3): direction whose part across axis 3 is its axis 1, global
            coordinates; not along axis 3

    Returns:
        Frame: the frame; axis 2 is what makes it right-handed
    """
    point = reals("point", point, (3,))
    axis_3 = reals("axis_3", axis_3, (3,))
    axis_1 = reals("axis_1", axis_1, (3,))
    frame = Frame()
    call(lib.pdn_joint_frame, pointer(point), pointer(axis_3), pointer(axis_1), frame._c)
    return frame
