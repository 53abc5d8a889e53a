# The types of _interface.py. Written by script/python_interface; do not edit it.
from collections.abc import Callable, Sequence
from typing import Any, Self

import numpy
from numpy.typing import ArrayLike, NDArray

from ._extras import (
    BranchExtras,
    Handle,
    ModelExtras,
    ModesExtras,
    SolutionExtras,
    StabilityExtras,
    TableExtras
)
from ._structs import Struct
from .equations import Equations

_SignalLike = Signal | float | Callable[[float], float]


VERSION_MAJOR: int
VERSION_MINOR: int
VERSION_PATCH: int
OK: int
ERR_NULL: int
ERR_NOT_FINITE: int
ERR_SIZE: int
ERR_ID: int
ERR_VALUE: int
ERR_STRUCT_SIZE: int
ERR_NOT_AVAILABLE: int
ERR_MODEL: int
ERR_NOT_PERIODIC: int
ERR_GRID_TOO_COARSE: int
ERR_CALLBACK: int
ERR_OVERFLOW: int
ERR_IO: int
ERR_FORMAT: int
ERR_MEMORY: int
ERR_PANIC: int
ERR_POISONED: int
SIGNAL_HARMONICS: int
SIGNAL_SAMPLES: int
SIGNAL_FUNCTION: int
SIGNAL_FUNCTION_OF_PHASE: int
FIRST_NODE: int
FIRST_JOINT: int
FIRST_BEAM_ELEMENT: int
FIRST_SHELL_ELEMENT: int
FIRST_FORCE: int
FIRST_RELATION: int
FIRST_PARAMETER: int
FIRST_LOAD: int
FIRST_BEAM_LOAD: int
FIRST_SHELL_LOAD: int
FIRST_INERTIA: int
FIRST_PRESCRIBED: int
GROUND: int
JOINT_RIGID: int
JOINT_REVOLUTE: int
JOINT_UNIVERSAL: int
JOINT_SPHERICAL: int
JOINT_PRISMATIC: int
JOINT_CYLINDRICAL: int
JOINT_PLANAR: int
JOINT_FREE: int
JOINT_SCREW: int
JOINT_STRUT: int
DISPLACEMENT: int
DISPLACEMENT_2: int
DISPLACEMENT_3: int
ROTATION: int
ROTATION_2: int
ROTATION_3: int
LINE_STRAIGHT: int
LINE_ARC: int
LINE_CURVE: int
FRAME_SPACE: int
FRAME_MATERIAL: int
FRAME_UNTWISTED: int
FORCE_1: int
FORCE_2: int
FORCE_3: int
MOMENT_1: int
MOMENT_2: int
MOMENT_3: int
SURFACE_PARALLELOGRAM: int
SURFACE_ANNULUS: int
SURFACE_CYLINDER: int
SURFACE_FUNCTION: int
SHELL_NORMALS: int
SHELL_PARALLEL: int
SHELL_NODE_AXES: int
SHELL_NODE_FRAMES: int
SHELL_EDGE_START_ETA: int
SHELL_EDGE_END_XI: int
SHELL_EDGE_END_ETA: int
SHELL_EDGE_START_XI: int
SHELL_SURFACE: int
ANGLES_ROTATION_VECTOR: int
ANGLES_TILT_AND_SPIN: int
TANGENTS_DIFFERENCED: int
TANGENTS_GIVEN: int
TANGENT_MOTION: int
TANGENT_VELOCITY: int
OBJECT_NODE: int
OBJECT_JOINT: int
OBJECT_BEAM_ELEMENT: int
OBJECT_SHELL_ELEMENT: int
OBJECT_FORCE: int
OBJECT_RELATION: int
OBJECT_LOAD: int
OBJECT_BEAM_LOAD: int
OBJECT_SHELL_LOAD: int
OBJECT_INERTIA: int
OBJECT_PRESCRIBED: int
LABEL_LENGTH: int
CONVERGED: int
ITERATION_LIMIT: int
STALLED: int
SINGULAR: int
CANCELLED: int
NO_INITIAL_GUESS: int
INCONSISTENT: int
WRONG_ASSEMBLY: int
TOLERANCE_NOT_MET: int
WORK_LIMIT: int
DECAY_UNKNOWN: int
DECAY_FAST: int
DECAY_SLOW: int
DECAY_ROUNDING: int
FRAME_FIRST: int
FRAME_SECOND: int
NODE_POSITION: int
NODE_ROTATION: int
NODE_QUATERNION: int
NODE_VELOCITY: int
NODE_ACCELERATION: int
JOINT_COORDINATE: int
JOINT_RATE: int
JOINT_ACCELERATION: int
JOINT_DRIVING_EFFORT: int
JOINT_REACTION: int
BEAM_STRAIN: int
BEAM_FORCE: int
BEAM_FORCE_MEAN: int
BEAM_FORCE_JUMP: int
FORCE_EFFORT: int
FORCE_BRANCH_EFFORT: int
FORCE_BRANCH_ELONGATION: int
FORCE_ON_NODE: int
FORCE_BUSHING_EFFORTS: int
FORCE_CONTROL_EFFORT: int
FORCE_CONTROL_STATE: int
SHELL_STRAIN: int
SHELL_RESULTANT: int
SHELL_STRESS_TOP: int
SHELL_STRESS_BOTTOM: int
RELATION_EFFORT: int
ALL_COMPONENTS: int
FILTER_LANCZOS: int
FILTER_EXPONENTIAL: int
STAGE_INITIAL_GUESS: int
STAGE_NEWTON: int
STAGE_MARCH: int
STAGE_MODES: int
STAGE_STABILITY: int
START_AUTOMATIC: int
START_QUASI_STATIC: int
START_STEADY_ROTATION: int
START_RIGID_ROTATION: int
START_RAISED_INERTIA: int
START_MARCH: int
START_LOWERED_DAMPING: int
START_RAISED_LOADS: int
TIME_MAP_AUTOMATIC: int
TIME_MAP_EQUISPACED: int
TIME_MAP_EVENTS: int
LINEAR_AUTOMATIC: int
LINEAR_DIRECT: int
LINEAR_ITERATIVE: int
LINEAR_BODY_CIRCULANT: int
LINEAR_TIME_LOCAL: int
LINEAR_CIRCULANT: int
NUMBER_STIFFNESS: int
NUMBER_DAMPING: int
NUMBER_REST: int
NUMBER_INERTIA: int
NUMBER_BEAM_STIFFNESS: int
NUMBER_BEAM_MASS: int
NUMBER_BEAM_DAMPING: int
NUMBER_MASS_DAMPING: int
NUMBER_SHELL_STIFFNESS: int
NUMBER_SHELL_MASS: int
NUMBER_SHELL_DAMPING: int
NUMBER_SHELL_THICKNESS: int
NUMBER_FRAME_RATE: int
NUMBER_SPIN: int
NUMBER_BEAM_SPIN: int
NUMBER_FRAME_ADVANCE: int
PART_MEAN: int
PART_RATE: int
PART_AMPLITUDE: int
PART_PHASE: int
FREQUENCY: int
GRAVITY: int
FORCE_IS_SPRING_DAMPER: int
FORCE_IS_ACTUATOR: int
FORCE_IS_COORDINATE_LAW: int
FORCE_IS_VISCOELASTIC: int
FORCE_IS_VISCOUS_DAMPER: int
FORCE_IS_BUSHING: int
FORCE_IS_USER_FORCE: int
FORCE_IS_CONTROLLER: int
FORCE_IS_SURFACE_FORCE: int
FORCE_IS_LINE_FORCE: int
NUMBER_RELAXATION_TIME: int
FEATURE_MEAN: int
FEATURE_COSINE: int
FEATURE_SINE: int
FEATURE_VALUE: int
FEATURE_LARGEST: int
FEATURE_SMALLEST: int
SENSITIVITY_AUTOMATIC: int
SENSITIVITY_DIRECT: int
SENSITIVITY_ADJOINT: int
BRANCH_RANGE: int
BRANCH_CLOSED: int
BRANCH_POINT_LIMIT: int
BRANCH_SMALLEST_STEP: int
BRANCH_CANCELLED: int
BRANCH_NO_START: int
BRANCH_FAILED: int
EVENT_NONE: int
EVENT_FOLD: int
EVENT_BRANCH_POINT: int
EVENT_PERIOD_DOUBLING: int
EVENT_TORUS: int
STABILITY_NOT_KNOWN: int
STABLE: int
UNSTABLE: int
OUTCOMES: dict[int, str]


class Section(Struct):
    stiffness: NDArray[numpy.float64]
    mass: NDArray[numpy.float64]
    damping: NDArray[numpy.float64]
    def set_diagonal(self, stiffness: ArrayLike, mass: ArrayLike) -> Self: ...
    def set_component_damping(self, seconds: ArrayLike) -> Self: ...
    def set_proportional_damping(self, seconds: float) -> Self: ...


class Signal(Struct):
    def set_constant(self, value: float) -> Self: ...
    def set_harmonics(
        self,
        mean: float = ...,
        rate: float = ...,
        cosines: ArrayLike | None = ...,
        sines: ArrayLike | None = ...,
    ) -> Self: ...
    def set_samples(self, samples: ArrayLike, rate: float = ...) -> Self: ...
    def set_function(self, function: Callable[..., object]) -> Self: ...
    def set_function_of_phase(self, function: Callable[..., object]) -> Self: ...


class Frame(Struct):
    position: NDArray[numpy.float64]
    rotation: NDArray[numpy.float64]


class Line(Struct):
    def set_straight(self, start: ArrayLike, end: ArrayLike, axis_2: ArrayLike) -> Self: ...
    def set_arc(
        self,
        start: ArrayLike,
        point: ArrayLike,
        end: ArrayLike,
        axis_2: ArrayLike,
    ) -> Self: ...
    def set_curve(self, curve: Callable[..., object]) -> Self: ...


class Stations(Struct):
    count: int
    fractions: NDArray[numpy.float64]
    sections: Sequence[Section]
    twists: NDArray[numpy.float64]


class Beam(Struct):
    first: int
    last: int
    first_element: int
    elements: int


class Surface(Struct):
    def set_parallelogram(
        self,
        corner: ArrayLike,
        along_u: ArrayLike,
        along_v: ArrayLike,
    ) -> Self: ...
    def set_annulus(
        self,
        centre: ArrayLike,
        axis: ArrayLike,
        start: ArrayLike,
        inner: float,
        outer: float,
        angle: float,
    ) -> Self: ...
    def set_cylinder(
        self,
        centre: ArrayLike,
        axis: ArrayLike,
        start: ArrayLike,
        radius: float,
        length: float,
        angle: float,
    ) -> Self: ...
    def set_function(self, function: Callable[..., object]) -> Self: ...


class ShellSection(Struct):
    stiffness: NDArray[numpy.float64]
    damping: NDArray[numpy.float64]
    mass: NDArray[numpy.float64]
    def set_isotropic(
        self,
        thickness: float,
        young: float,
        poisson: float,
        density: float,
        drilling: float = ...,
        drilling_gradient: float = ...,
    ) -> Self: ...
    def set_proportional_damping(self, seconds: float) -> Self: ...


class ShellPlacement(Struct):
    frames: int
    offset: float
    direction: NDArray[numpy.float64]


class Shell(Struct):
    first_element: int
    elements_u: int
    elements_v: int
    nodes_u: int
    nodes_v: int


class TangentCheck(Struct):
    error: float
    time: float
    given: float
    differenced: float
    tangent: int
    row_node: int
    row_component: int
    column_node: int
    column_component: int


class Diagnostics(Struct):
    outcome: int
    iterations: int
    guess_iterations: int
    redundant_constraints: int
    grid_points: int
    unknowns: int
    last_increment: float
    error_estimate: float
    force_residual_between: float
    constraint_residual_between: float
    guess_seconds: float
    assembly_seconds: float
    analysis_seconds: float
    factorisation_seconds: float
    substitution_seconds: float
    decay: int
    grids: int
    decay_order: float
    least_resolved_time: float
    linear_solver: int
    linear_iterations: int
    linear_solves: int
    most_linear_iterations: int
    linear_bytes: int
    preconditioner_seconds: float
    interface_seconds: float
    estimate_seconds: float
    total_seconds: float
    total_iterations: int
    attempts: int
    mesh_error: float


class Quantity(Struct):
    kind: int
    object: int
    component: int
    frame: int
    node: int
    branch: int
    station: float
    station_eta: float
    direction: NDArray[numpy.float64]


class Progress(Struct):
    stage: int
    iteration: int
    residual: float
    increment: float
    step: float
    time: float
    elapsed: float
    grid_points: int
    attempt: int
    start: int
    iterated: int


class PeriodicOptions(Struct):
    grid_points: int
    harmonics: int
    tolerance: float
    iteration_limit: int
    initial: Solution
    guess_positions: NDArray[numpy.float64]
    guess_rotations: NDArray[numpy.float64]
    progress: bool | Callable[..., object]
    error_tolerance: float
    largest_grid_points: int
    linear_solver: int
    threads: int
    oversampling: int
    response_tolerance: float
    start: int
    estimate_mesh: int
    progress_interval: float
    work_limit: float
    memory_limit: int
    time_map: int
    event_count: int
    event_times: NDArray[numpy.float64]
    event_widths: NDArray[numpy.float64]
    event_shares: NDArray[numpy.float64]


class EquationsOptions(Struct):
    grid_points: int
    initial: Solution
    owners: NDArray[numpy.float64]
    owner_count: int
    rank: int
    ranks: int
    preconditioner: int
    threads: int


class EquationsSizes(Struct):
    size: int
    halo: int
    total: int
    nodes: int
    motions: int
    own_unknowns: int
    bytes: int
    preconditioner: int


class JointInfo(Struct):
    kind: int
    first: int
    second: int
    pitch: float
    first_position: NDArray[numpy.float64]
    first_rotation: NDArray[numpy.float64]
    second_position: NDArray[numpy.float64]
    second_rotation: NDArray[numpy.float64]


class ForceInfo(Struct):
    kind: int
    joint: int
    coordinate: int
    first: int
    second: int
    angles: int
    stiffness_count: int
    damping_count: int
    branch_count: int
    node_count: int
    rest: float
    first_position: NDArray[numpy.float64]
    first_rotation: NDArray[numpy.float64]
    second_position: NDArray[numpy.float64]
    second_rotation: NDArray[numpy.float64]
    shell_element: int
    shell_place: int
    beam_element: int
    nodes_apart: int
    axis_2: NDArray[numpy.float64]


class SensitivityOptions(Struct):
    method: int
    linear_solver: int
    threads: int


class BranchPoint(Struct):
    parameter: float
    slope: float
    period: float
    step: float
    angle: float
    grid_points: int
    iterations: int
    event: int
    second_frequency: float
    largest_multiplier: float
    multipliers_outside: int
    stability: int


class BranchOptions(Struct):
    periodic: PeriodicOptions
    conditions: Conditions
    from_: float
    to: float
    motion_scale: float
    first_step: float
    smallest_step: float
    largest_step: float
    angle: float
    point_limit: int
    progress: bool | Callable[..., object]
    downwards: int
    events: int
    stability: int


class StabilityOptions(Struct):
    highest_frequency: float
    tolerance: float
    progress: bool | Callable[..., object]


class StaticOptions(Struct):
    time: float
    period: float
    load_steps: int
    tolerance: float
    iteration_limit: int
    angular_velocity: NDArray[numpy.float64]
    axis_point: NDArray[numpy.float64]
    initial: Solution
    progress: bool | Callable[..., object]
    memory_limit: int


class ModesOptions(Struct):
    equilibrium: StaticOptions
    count: int
    near_frequency: float


class Mode(Struct):
    eigenvalue_real: float
    eigenvalue_imaginary: float
    frequency: float
    damping_ratio: float
    modal_mass: float
    residual: float


class MarchOptions(Struct):
    start_time: float
    duration: float
    period: float
    step: float
    steps_per_period: int
    spectral_radius: float
    error_tolerance: float
    periodic_tolerance: float
    most_periods: int
    stored_periods: int
    tolerance: float
    iteration_limit: int
    initial: Solution
    positions: NDArray[numpy.float64]
    rotations: NDArray[numpy.float64]
    velocities: NDArray[numpy.float64]
    progress: bool | Callable[..., object]
    memory_limit: int


class MarchDiagnostics(Struct):
    steps: int
    rejected_steps: int
    iterations: int
    periods: int
    first_time: float
    last_time: float
    repetition: float
    step_error: float
    start_moved: float
    start_corrected: float


class ShootingOptions(Struct):
    steps_per_period: int
    guess_periods: int
    spectral_radius: float
    tolerance: float
    iteration_limit: int
    initial: Solution
    progress: bool | Callable[..., object]
    memory_limit: int


class Multiplier(Struct):
    real: float
    imaginary: float
    exponent_real: float
    exponent_imaginary: float
    frequency: float
    error: float
    trivial: int


class Summary(Struct):
    nodes: int
    beam_elements: int
    joints: int
    prescribed: int
    constraints: int
    redundant_constraints: int
    degrees_of_freedom: int
    members: int
    mobility: int
    redundant_if_rigid: int
    parts: int
    warnings: int
    mass: float
    centre: NDArray[numpy.float64]


class Branch(BranchExtras):

    def switch_branch(
        self,
        point: int,
        amplitude: float,
        *,
        periodic: PeriodicOptions | dict[str, Any] | None = ...,
        conditions: Conditions | None = ...,
        from_: float | None = ...,
        to: float | None = ...,
        motion_scale: float | None = ...,
        first_step: float | None = ...,
        smallest_step: float | None = ...,
        largest_step: float | None = ...,
        angle: float | None = ...,
        point_limit: int | None = ...,
        progress: bool | Callable[..., object] | None = ...,
        downwards: int | None = ...,
        events: int | None = ...,
        stability: int | None = ...,
    ) -> Branch: ...

    def follow_locus(
        self,
        point: int,
        parameter: int,
        *,
        periodic: PeriodicOptions | dict[str, Any] | None = ...,
        conditions: Conditions | None = ...,
        from_: float | None = ...,
        to: float | None = ...,
        motion_scale: float | None = ...,
        first_step: float | None = ...,
        smallest_step: float | None = ...,
        largest_step: float | None = ...,
        angle: float | None = ...,
        point_limit: int | None = ...,
        progress: bool | Callable[..., object] | None = ...,
        downwards: int | None = ...,
        events: int | None = ...,
        stability: int | None = ...,
    ) -> Branch: ...

    def continue_branch(
        self,
        *,
        periodic: PeriodicOptions | dict[str, Any] | None = ...,
        conditions: Conditions | None = ...,
        from_: float | None = ...,
        to: float | None = ...,
        motion_scale: float | None = ...,
        first_step: float | None = ...,
        smallest_step: float | None = ...,
        largest_step: float | None = ...,
        angle: float | None = ...,
        point_limit: int | None = ...,
        progress: bool | Callable[..., object] | None = ...,
        downwards: int | None = ...,
        events: int | None = ...,
        stability: int | None = ...,
    ) -> Branch: ...

    def save(self, path: str) -> None: ...

    @staticmethod
    def load(path: str) -> Branch: ...

    def end(self) -> int: ...
    def report(self) -> str: ...

    def count(self) -> int: ...

    def get(self, point: int) -> BranchPoint: ...

    def solution(self, point: int) -> Solution: ...

    def write_csv(self, path: str, quantities: Sequence[Quantity] | None = ...) -> None: ...

    def write_campbell(
        self,
        path: str,
        blades: Sequence[int] | NDArray[numpy.integer] | None = ...,
        *,
        highest_frequency: float | None = ...,
        tolerance: float | None = ...,
        progress: bool | Callable[..., object] | None = ...,
    ) -> None: ...


class Conditions(Handle):

    def __init__(self) -> None: ...

    def release(self, parameter: int) -> None: ...

    def add_phase(self) -> None: ...

    def add_rotation_phase(self, axis: ArrayLike, point: ArrayLike | None = ...) -> None: ...

    def add_translation_phase(self, direction: ArrayLike) -> None: ...

    def add_quantity(
        self,
        quantity: Quantity | dict[str, Any],
        feature: int,
        at: float,
        value: float,
        scale: float = ...,
    ) -> None: ...

    def add_joint_coordinate(self, joint: int, coordinate: int, value: float) -> None: ...

    def add_energy(self, energy: float) -> None: ...

    def add_momentum(self, direction: ArrayLike, momentum: float) -> None: ...

    def add_angular_momentum(
        self,
        axis: ArrayLike,
        momentum: float,
        point: ArrayLike | None = ...,
    ) -> None: ...


class Model(ModelExtras):

    def __init__(self) -> None: ...

    def node_count(self) -> int: ...

    def joint_count(self) -> int: ...

    def element_count(self) -> int: ...

    def mass(self) -> tuple[float, NDArray[numpy.float64]]: ...

    def node_frame(self, node: int) -> Frame: ...

    def add_node(self, position: ArrayLike, rotation: ArrayLike | None = ...) -> int: ...

    def add_rigid_body(self, mass: float, centre: ArrayLike, inertia: ArrayLike) -> int: ...

    def add_mass(
        self,
        node: int,
        mass: float,
        centre: ArrayLike,
        inertia: ArrayLike | None = ...,
    ) -> int: ...

    def add_inertia(
        self,
        node: int,
        matrix: ArrayLike,
        frame: Frame | dict[str, Any] | None = ...,
    ) -> int: ...

    def prescribe(self, joint: int, coordinate: int, signal: _SignalLike) -> int: ...

    def add_rigid_joint(self, first: int, second: int, point: ArrayLike) -> int: ...

    def add_revolute(self, first: int, second: int, point: ArrayLike, axis: ArrayLike) -> int: ...

    def add_prismatic(
        self,
        first: int,
        second: int,
        point: ArrayLike,
        axis: ArrayLike,
    ) -> int: ...

    def add_cylindrical(
        self,
        first: int,
        second: int,
        point: ArrayLike,
        axis: ArrayLike,
    ) -> int: ...

    def add_screw(
        self,
        first: int,
        second: int,
        point: ArrayLike,
        axis: ArrayLike,
        pitch: float,
    ) -> int: ...

    def add_planar(self, first: int, second: int, point: ArrayLike, normal: ArrayLike) -> int: ...

    def add_free_joint(self, first: int, second: int, point: ArrayLike) -> int: ...

    def add_spherical(self, first: int, second: int, point: ArrayLike) -> int: ...

    def add_universal(
        self,
        first: int,
        second: int,
        point: ArrayLike,
        first_arm: ArrayLike,
        second_arm: ArrayLike,
    ) -> int: ...

    def add_strut(
        self,
        first: int,
        second: int,
        first_point: ArrayLike,
        second_point: ArrayLike,
    ) -> int: ...

    def add_joint(
        self,
        kind: int,
        first: int,
        second: int,
        first_frame: Frame | dict[str, Any],
        second_frame: Frame | dict[str, Any],
    ) -> int: ...

    def add_screw_between(
        self,
        first: int,
        second: int,
        first_frame: Frame | dict[str, Any],
        second_frame: Frame | dict[str, Any],
        pitch: float,
    ) -> int: ...

    def relation_count(self) -> int: ...

    def add_relation(
        self,
        joints: Sequence[int] | NDArray[numpy.integer],
        coordinates: Sequence[int] | NDArray[numpy.integer],
        coefficients: ArrayLike,
        signal: _SignalLike | None = ...,
    ) -> int: ...

    def add_beam_element(
        self,
        nodes: Sequence[int] | NDArray[numpy.integer],
        section: Section | dict[str, Any],
    ) -> int: ...

    def add_straight_beam(
        self,
        start: ArrayLike,
        end: ArrayLike,
        axis_2: ArrayLike,
        section: Section | dict[str, Any],
        elements: int,
        degree: int,
    ) -> Beam: ...

    def add_beam(
        self,
        line: Line | dict[str, Any],
        stations: Stations | dict[str, Any],
        elements: int,
        degree: int,
    ) -> Beam: ...

    def add_beam_between(
        self,
        line: Line | dict[str, Any],
        stations: Stations | dict[str, Any],
        boundaries: ArrayLike,
        degree: int,
    ) -> Beam: ...

    def add_load(self, node: int, frame: int, component: int, signal: _SignalLike) -> int: ...

    def add_load_at_point(
        self,
        node: int,
        offset: ArrayLike,
        frame: int,
        component: int,
        signal: _SignalLike,
    ) -> int: ...

    def add_load_on_beam(
        self,
        first_element: int,
        elements: int,
        fraction: float,
        frame: int,
        component: int,
        signal: _SignalLike,
        offset: ArrayLike | None = ...,
    ) -> int: ...

    def set_gravity(self, acceleration: ArrayLike) -> None: ...

    def set_gravity_signals(
        self,
        acceleration_1: _SignalLike | None = ...,
        acceleration_2: _SignalLike | None = ...,
        acceleration_3: _SignalLike | None = ...,
    ) -> None: ...

    def add_distributed_load(
        self,
        first_element: int,
        elements: int,
        frame: int,
        component: int,
        signal: _SignalLike,
        fractions: ArrayLike | None = ...,
        factors: ArrayLike | None = ...,
    ) -> int: ...

    def add_load_at_places(
        self,
        first_element: int,
        elements: int,
        frame: int,
        fractions: ArrayLike,
        signals: Sequence[Sequence[_SignalLike]],
        axis_2: ArrayLike | None = ...,
    ) -> int: ...

    def set_turning_frame(
        self,
        axis: ArrayLike,
        rate: float,
        point: ArrayLike | None = ...,
    ) -> None: ...

    def turning_frame(self) -> tuple[NDArray[numpy.float64], float, NDArray[numpy.float64]]: ...

    def set_frame_advance(self, speed: float) -> None: ...

    def frame_advance(self) -> float: ...

    def set_spin(self, inertia: int, axis: ArrayLike, rate: float) -> None: ...

    def spin(self, inertia: int) -> tuple[NDArray[numpy.float64], float]: ...

    def set_beam_spin(self, first_element: int, elements: int, rate: float) -> None: ...

    def beam_spin(self, element: int) -> float: ...

    def set_rotor_symmetry(
        self,
        axis: ArrayLike,
        blades: int,
        nodes: Sequence[int] | NDArray[numpy.integer],
        hub: Sequence[int] | NDArray[numpy.integer],
        point: ArrayLike | None = ...,
    ) -> None: ...

    def rotor_symmetry(
        self,
    ) -> tuple[NDArray[numpy.float64], NDArray[numpy.float64], int, int, int]: ...

    def rotor_node(self, blade: int, index: int) -> int: ...

    def add_shell_element(
        self,
        nodes: Sequence[int] | NDArray[numpy.integer],
        n_xi: int,
        section: ShellSection | dict[str, Any],
        placement: ShellPlacement | dict[str, Any] | None = ...,
    ) -> int: ...

    def add_shell(
        self,
        surface: Surface | dict[str, Any],
        elements_u: int,
        elements_v: int,
        degree_u: int,
        degree_v: int,
        section: ShellSection | dict[str, Any],
        join: int = ...,
        placement: ShellPlacement | dict[str, Any] | None = ...,
    ) -> Shell: ...

    def add_shell_grid(
        self,
        points: ArrayLike,
        elements_u: int,
        elements_v: int,
        degree_u: int,
        degree_v: int,
        section: ShellSection | dict[str, Any],
        join: int = ...,
        placement: ShellPlacement | dict[str, Any] | None = ...,
    ) -> Shell: ...

    def add_shell_quadrilaterals(
        self,
        points: ArrayLike,
        cells: Sequence[int] | NDArray[numpy.integer],
        points_of_cell: int,
        degree: int,
        section: ShellSection | dict[str, Any],
        placement: ShellPlacement | dict[str, Any] | None = ...,
    ) -> int: ...

    def shell_patch_node(self, shell: Shell | dict[str, Any], u: int, v: int) -> int: ...

    def shell_element_count(self) -> int: ...

    def shell_node(self, element: int, xi: int, eta: int) -> int: ...

    def add_shell_load(
        self,
        first_element: int,
        elements: int,
        place: int,
        frame: int,
        component: int,
        signal: _SignalLike,
    ) -> int: ...

    def set_shell_prestress(
        self,
        first_element: int,
        elements: int,
        resultants: ArrayLike,
    ) -> None: ...

    def add_rigid_joints(
        self,
        body: int,
        nodes: Sequence[int] | NDArray[numpy.integer],
    ) -> tuple[int, int]: ...

    def add_rigid_edge(
        self,
        body: int,
        shell: Shell | dict[str, Any],
        edge: int,
    ) -> tuple[int, int]: ...

    def force_count(self) -> int: ...

    def add_spring_damper(
        self,
        joint: int,
        coordinate: int,
        stiffness: float,
        damping: float = ...,
        rest: float = ...,
    ) -> int: ...

    def add_nonlinear_spring_damper(
        self,
        joint: int,
        coordinate: int,
        stiffness: ArrayLike | None = ...,
        damping: ArrayLike | None = ...,
        rest: float = ...,
    ) -> int: ...

    def add_actuator(self, joint: int, coordinate: int, signal: _SignalLike) -> int: ...

    def add_viscoelastic(
        self,
        joint: int,
        coordinate: int,
        stiffness: float,
        rest: float,
        branch_stiffness: ArrayLike,
        relaxation_times: ArrayLike,
    ) -> int: ...

    def add_viscous_damper(
        self,
        first: int,
        second: int,
        matrix: ArrayLike,
        frame: Frame | dict[str, Any] | None = ...,
    ) -> int: ...

    def add_bushing(
        self,
        first: int,
        second: int,
        first_frame: Frame | dict[str, Any],
        second_frame: Frame | dict[str, Any],
        stiffness: ArrayLike,
        damping: ArrayLike,
        angles: int,
    ) -> int: ...

    def add_coordinate_law(
        self,
        joint: int,
        coordinate: int,
        tangents: int,
        function: Callable[..., object],
    ) -> int: ...

    def add_user_force(
        self,
        nodes: Sequence[int] | NDArray[numpy.integer],
        frame: int,
        tangents: int,
        function: Callable[..., object],
    ) -> int: ...

    def declare_nodes_apart(self, force: int) -> None: ...

    def check_tangents(self, force: int, period: float) -> TangentCheck: ...

    def add_controller(
        self,
        output_joints: Sequence[int] | NDArray[numpy.integer],
        output_coordinates: Sequence[int] | NDArray[numpy.integer],
        tangents: int,
        function: Callable[..., object],
        input_joints: Sequence[int] | NDArray[numpy.integer] | None = ...,
        input_coordinates: Sequence[int] | NDArray[numpy.integer] | None = ...,
        initial: ArrayLike | None = ...,
        sizes: ArrayLike | None = ...,
    ) -> int: ...

    def controller_counts(self, force: int) -> tuple[int, int, int]: ...

    def controller_coordinate(self, force: int, index: int) -> tuple[int, int]: ...

    def controller_state(self, force: int, index: int) -> tuple[float, float]: ...

    def add_surface_force(
        self,
        first_element: int,
        elements: int,
        place: int,
        frame: int,
        tangents: int,
        function: Callable[..., object],
    ) -> int: ...

    def add_line_force(
        self,
        first_element: int,
        elements: int,
        frame: int,
        tangents: int,
        function: Callable[..., object],
        axis_2: ArrayLike | None = ...,
    ) -> int: ...

    def bind_controller(
        self,
        force: int,
        tangents: int,
        function: Callable[..., object],
    ) -> None: ...

    def bind_coordinate_law(
        self,
        force: int,
        tangents: int,
        function: Callable[..., object],
    ) -> None: ...

    def bind_user_force(
        self,
        force: int,
        frame: int,
        tangents: int,
        function: Callable[..., object],
    ) -> None: ...

    def bind_surface_force(
        self,
        first_force: int,
        forces: int,
        frame: int,
        tangents: int,
        function: Callable[..., object],
    ) -> None: ...

    def set_signal(self, id: int, component: int, signal: _SignalLike) -> None: ...

    def set_force_numbers(self, force: int, number: int, values: ArrayLike) -> None: ...

    def set_load_frame(self, load: int, frame: int, axis_2: ArrayLike | None = ...) -> None: ...

    def set_beam_section(
        self,
        first_element: int,
        elements: int,
        section: Section | dict[str, Any],
    ) -> None: ...

    def set_shell_section(
        self,
        first_element: int,
        elements: int,
        section: ShellSection | dict[str, Any],
    ) -> None: ...

    def set_inertia(self, inertia: int, matrix: ArrayLike) -> None: ...

    def set_label(self, id: int, label: str | None = ...) -> None: ...
    def label(self, id: int) -> str: ...

    def find_label(self, kind: int, label: str) -> int: ...

    def solve_periodic(
        self,
        period: float,
        *,
        grid_points: int | None = ...,
        harmonics: int | None = ...,
        tolerance: float | None = ...,
        iteration_limit: int | None = ...,
        initial: Solution | None = ...,
        guess_positions: ArrayLike | None = ...,
        guess_rotations: ArrayLike | None = ...,
        progress: bool | Callable[..., object] | None = ...,
        error_tolerance: float | None = ...,
        largest_grid_points: int | None = ...,
        linear_solver: int | None = ...,
        threads: int | None = ...,
        oversampling: int | None = ...,
        response_tolerance: float | None = ...,
        start: int | None = ...,
        estimate_mesh: int | None = ...,
        progress_interval: float | None = ...,
        work_limit: float | None = ...,
        memory_limit: int | None = ...,
        time_map: int | None = ...,
        event_count: int | None = ...,
        event_times: ArrayLike | None = ...,
        event_widths: ArrayLike | None = ...,
        event_shares: ArrayLike | None = ...,
    ) -> Solution: ...

    def equations_new(
        self,
        period: float,
        *,
        grid_points: int | None = ...,
        initial: Solution | None = ...,
        owners: ArrayLike | None = ...,
        owner_count: int | None = ...,
        rank: int | None = ...,
        ranks: int | None = ...,
        preconditioner: int | None = ...,
        threads: int | None = ...,
    ) -> Equations: ...

    def add_parameter(self, name: str, value: float, scale: float) -> int: ...

    def parameter_count(self) -> int: ...

    def parameter(self, parameter: int) -> tuple[float, float]: ...
    def parameter_name(self, parameter: int) -> str: ...

    def find_parameter(self, name: str) -> int: ...

    def move_number(
        self,
        parameter: int,
        number: int,
        id: int,
        power: int,
        factor: float,
    ) -> None: ...

    def move_signal(
        self,
        parameter: int,
        id: int,
        component: int,
        part: int,
        factor: float,
    ) -> None: ...

    def set_parameter(self, parameter: int, value: float) -> None: ...

    def set_mass_damping(self, factor: float) -> None: ...

    def declare_of_phase(self, force: int) -> None: ...

    def joint(self, joint: int) -> JointInfo: ...

    def force(self, force: int) -> ForceInfo: ...

    def force_number(self, force: int, number: int, index: int) -> float: ...

    def force_node(self, force: int, index: int) -> int: ...

    def beam_element_node_count(self, element: int) -> int: ...

    def beam_element_node(self, element: int, index: int) -> int: ...

    def beam_section(self, element: int, station: float) -> tuple[Section, float]: ...

    def inertia_count(self) -> int: ...

    def inertia(self, inertia: int) -> tuple[int, NDArray[numpy.float64]]: ...

    def inertia_of(self, node: int) -> int: ...

    def prescribed(self, prescribed: int) -> tuple[int, int]: ...

    def relation_term_count(self, relation: int) -> int: ...

    def relation_term(self, relation: int, index: int) -> tuple[int, int, float]: ...

    def sample_signal(
        self,
        id: int,
        component: int,
        period: float,
        times: ArrayLike,
    ) -> NDArray[numpy.float64]: ...

    def load_count(self) -> int: ...

    def load_at(self, load: int) -> tuple[int, int, int, float, NDArray[numpy.float64], int]: ...

    def beam_load_count(self) -> int: ...

    def beam_load(self, load: int) -> tuple[int, int, int, NDArray[numpy.float64], int]: ...

    def beam_load_factor(self, load: int, index: int) -> tuple[float, float]: ...

    def shell_load_count(self) -> int: ...

    def shell_load(self, load: int) -> tuple[int, int, int, int]: ...

    def solve_conditioned(
        self,
        period: float,
        conditions: Conditions,
        *,
        grid_points: int | None = ...,
        harmonics: int | None = ...,
        tolerance: float | None = ...,
        iteration_limit: int | None = ...,
        initial: Solution | None = ...,
        guess_positions: ArrayLike | None = ...,
        guess_rotations: ArrayLike | None = ...,
        progress: bool | Callable[..., object] | None = ...,
        error_tolerance: float | None = ...,
        largest_grid_points: int | None = ...,
        linear_solver: int | None = ...,
        threads: int | None = ...,
        oversampling: int | None = ...,
        response_tolerance: float | None = ...,
        start: int | None = ...,
        estimate_mesh: int | None = ...,
        progress_interval: float | None = ...,
        work_limit: float | None = ...,
        memory_limit: int | None = ...,
        time_map: int | None = ...,
        event_count: int | None = ...,
        event_times: ArrayLike | None = ...,
        event_widths: ArrayLike | None = ...,
        event_shares: ArrayLike | None = ...,
    ) -> Solution: ...

    def follow_branch(
        self,
        period: float,
        parameter: int,
        *,
        periodic: PeriodicOptions | dict[str, Any] | None = ...,
        conditions: Conditions | None = ...,
        from_: float | None = ...,
        to: float | None = ...,
        motion_scale: float | None = ...,
        first_step: float | None = ...,
        smallest_step: float | None = ...,
        largest_step: float | None = ...,
        angle: float | None = ...,
        point_limit: int | None = ...,
        progress: bool | Callable[..., object] | None = ...,
        downwards: int | None = ...,
        events: int | None = ...,
        stability: int | None = ...,
    ) -> Branch: ...

    def solve_frequency_response(
        self,
        first: float,
        last: float,
        *,
        periodic: PeriodicOptions | dict[str, Any] | None = ...,
        conditions: Conditions | None = ...,
        from_: float | None = ...,
        to: float | None = ...,
        motion_scale: float | None = ...,
        first_step: float | None = ...,
        smallest_step: float | None = ...,
        largest_step: float | None = ...,
        angle: float | None = ...,
        point_limit: int | None = ...,
        progress: bool | Callable[..., object] | None = ...,
        downwards: int | None = ...,
        events: int | None = ...,
        stability: int | None = ...,
    ) -> Branch: ...

    def solve_static(
        self,
        *,
        time: float | None = ...,
        period: float | None = ...,
        load_steps: int | None = ...,
        tolerance: float | None = ...,
        iteration_limit: int | None = ...,
        angular_velocity: ArrayLike | None = ...,
        axis_point: ArrayLike | None = ...,
        initial: Solution | None = ...,
        progress: bool | Callable[..., object] | None = ...,
        memory_limit: int | None = ...,
    ) -> Solution: ...

    def solve_modes(
        self,
        *,
        equilibrium: StaticOptions | dict[str, Any] | None = ...,
        count: int | None = ...,
        near_frequency: float | None = ...,
    ) -> Modes: ...

    def solve_march(
        self,
        *,
        start_time: float | None = ...,
        duration: float | None = ...,
        period: float | None = ...,
        step: float | None = ...,
        steps_per_period: int | None = ...,
        spectral_radius: float | None = ...,
        error_tolerance: float | None = ...,
        periodic_tolerance: float | None = ...,
        most_periods: int | None = ...,
        stored_periods: int | None = ...,
        tolerance: float | None = ...,
        iteration_limit: int | None = ...,
        initial: Solution | None = ...,
        positions: ArrayLike | None = ...,
        rotations: ArrayLike | None = ...,
        velocities: ArrayLike | None = ...,
        progress: bool | Callable[..., object] | None = ...,
        memory_limit: int | None = ...,
    ) -> Solution: ...

    def solve_shooting(
        self,
        period: float,
        *,
        steps_per_period: int | None = ...,
        guess_periods: int | None = ...,
        spectral_radius: float | None = ...,
        tolerance: float | None = ...,
        iteration_limit: int | None = ...,
        initial: Solution | None = ...,
        progress: bool | Callable[..., object] | None = ...,
        memory_limit: int | None = ...,
    ) -> Solution: ...

    def summary(self) -> Summary: ...
    def describe(self) -> str: ...

    def copy(self) -> Model: ...

    def save(self, path: str) -> None: ...

    @staticmethod
    def load(path: str) -> Model: ...


class Modes(ModesExtras):

    def outcome(self) -> int: ...
    def report(self) -> str: ...

    def count(self) -> tuple[int, int]: ...

    def get(self, mode: int) -> Mode: ...

    def shape(
        self,
        mode: int,
        nodes: Sequence[int] | NDArray[numpy.integer],
    ) -> tuple[NDArray[numpy.float64], NDArray[numpy.float64]]: ...

    def motion(self, mode: int, amplitude: float) -> Solution: ...

    def equilibrium(self) -> Solution: ...


class Sensitivities(Handle):

    def __init__(self) -> None: ...

    def add_quantity(
        self,
        quantity: Quantity | dict[str, Any],
        feature: int,
        at: float = ...,
    ) -> None: ...

    def add_found(self, parameter: int) -> None: ...

    def add_parameter(self, parameter: int) -> None: ...


class Solution(SolutionExtras):

    def outcome(self) -> int: ...
    def report(self) -> str: ...
    def report_json(self) -> str: ...

    def diagnostics(self) -> Diagnostics: ...

    def history(
        self,
    ) -> tuple[NDArray[numpy.float64], NDArray[numpy.float64], NDArray[numpy.float64]]: ...

    def decay(self) -> NDArray[numpy.float64]: ...

    def sharp_event_count(self) -> int: ...

    def sharp_events(
        self,
    ) -> tuple[NDArray[numpy.float64], NDArray[numpy.float64], NDArray[numpy.float64]]: ...

    def grid_times(self) -> NDArray[numpy.float64]: ...

    def sample(
        self,
        quantity: Quantity | dict[str, Any],
        times: ArrayLike,
    ) -> NDArray[numpy.float64]: ...

    def harmonics(
        self,
        quantity: Quantity | dict[str, Any],
        harmonics: int,
    ) -> tuple[NDArray[numpy.float64], NDArray[numpy.float64], NDArray[numpy.float64], NDArray[numpy.float64]]: ...

    def extremes(
        self,
        quantity: Quantity | dict[str, Any],
    ) -> tuple[NDArray[numpy.float64], NDArray[numpy.float64], NDArray[numpy.float64], NDArray[numpy.float64]]: ...

    def filtered(self, filter: int, order: int) -> Solution: ...

    def parameter(self, parameter: int) -> float: ...

    def sensitivities(
        self,
        sensitivities: Sensitivities,
        dependents: int,
        parameters: int,
        conditions: Conditions | None = ...,
        *,
        method: int | None = ...,
        linear_solver: int | None = ...,
        threads: int | None = ...,
    ) -> NDArray[numpy.float64]: ...

    def multiplier_sensitivities(
        self,
        sensitivities: Sensitivities,
        stability: Stability,
        number: int,
        parameters: int,
        conditions: Conditions | None = ...,
        *,
        method: int | None = ...,
        linear_solver: int | None = ...,
        threads: int | None = ...,
    ) -> tuple[NDArray[numpy.float64], NDArray[numpy.float64]]: ...

    def march(self) -> MarchDiagnostics: ...

    def floquet_count(self) -> int: ...

    def floquet(self) -> tuple[NDArray[numpy.float64], NDArray[numpy.float64]]: ...

    def solve_stability(
        self,
        *,
        highest_frequency: float | None = ...,
        tolerance: float | None = ...,
        progress: bool | Callable[..., object] | None = ...,
    ) -> Stability: ...

    def write_vtk(self, times: ArrayLike, points_per_element: int, path: str) -> None: ...

    def save(self, path: str) -> None: ...

    @staticmethod
    def load(path: str) -> Solution: ...

    def model(self) -> Model: ...


class Stability(StabilityExtras):

    def outcome(self) -> int: ...

    def verdict(self) -> tuple[int, float]: ...

    def count(self) -> tuple[int, int]: ...

    def get(self, number: int) -> Multiplier: ...

    def time_count(self) -> int: ...

    def times(self) -> NDArray[numpy.float64]: ...

    def shape(
        self,
        number: int,
        node: int,
    ) -> tuple[NDArray[numpy.float64], NDArray[numpy.float64]]: ...
    def report(self) -> str: ...


class Table(TableExtras):

    def add_quantity(
        self,
        solution: Solution,
        quantity: Quantity | dict[str, Any],
        label: str | None = ...,
    ) -> None: ...

    def __init__(self, times: ArrayLike) -> None: ...

    def add_values(self, label: str, values: ArrayLike) -> None: ...

    def write_csv(self, path: str) -> None: ...


def version() -> str: ...


def build_info() -> str: ...


def status_name(status: int) -> str: ...


def release_memory() -> None: ...


def motion_interpolate(
    period: float,
    positions: ArrayLike,
    rotations: ArrayLike,
    times: ArrayLike,
) -> tuple[NDArray[numpy.float64], NDArray[numpy.float64], NDArray[numpy.float64], NDArray[numpy.float64]]: ...


def motion_grid_kinematics(
    period: float,
    positions: ArrayLike,
    rotations: ArrayLike,
) -> tuple[NDArray[numpy.float64], NDArray[numpy.float64], NDArray[numpy.float64], NDArray[numpy.float64]]: ...


def joint_frame(point: ArrayLike, axis_3: ArrayLike, axis_1: ArrayLike) -> Frame: ...
