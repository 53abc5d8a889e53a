! Periodyn for Fortran 2018: periodic response of flexible multibody systems.
!
! Compile this file with your program. It is written by script/fortran_interface from periodyn.h; do
! not edit it. It has two modules:
!
!   periodyn_c   the functions, structs and constants of periodyn.h, under their names; its
!                documentation holds. Pointers that may be NULL are optional arguments; texts end
!                with c_null_char.
!   periodyn     the same as derived types that free themselves, with optional stat and errmsg; it
!                passes periodyn_c on.

module periodyn_c
    use, intrinsic :: iso_c_binding
    implicit none
    public

    integer(c_int32_t), parameter :: PDN_VERSION_MAJOR = 0
    integer(c_int32_t), parameter :: PDN_VERSION_MINOR = 1
    integer(c_int32_t), parameter :: PDN_VERSION_PATCH = 0
    integer(c_int32_t), parameter :: PDN_OK = 0
    integer(c_int32_t), parameter :: PDN_ERR_NULL = -1
    integer(c_int32_t), parameter :: PDN_ERR_NOT_FINITE = -2
    integer(c_int32_t), parameter :: PDN_ERR_SIZE = -3
    integer(c_int32_t), parameter :: PDN_ERR_ID = -4
    integer(c_int32_t), parameter :: PDN_ERR_VALUE = -5
    integer(c_int32_t), parameter :: PDN_ERR_STRUCT_SIZE = -6
    integer(c_int32_t), parameter :: PDN_ERR_NOT_AVAILABLE = -7
    integer(c_int32_t), parameter :: PDN_ERR_MODEL = -100
    integer(c_int32_t), parameter :: PDN_ERR_NOT_PERIODIC = -101
    integer(c_int32_t), parameter :: PDN_ERR_GRID_TOO_COARSE = -200
    integer(c_int32_t), parameter :: PDN_ERR_CALLBACK = -201
    integer(c_int32_t), parameter :: PDN_ERR_OVERFLOW = -202
    integer(c_int32_t), parameter :: PDN_ERR_IO = -300
    integer(c_int32_t), parameter :: PDN_ERR_FORMAT = -301
    integer(c_int32_t), parameter :: PDN_ERR_MEMORY = -900
    integer(c_int32_t), parameter :: PDN_ERR_PANIC = -901
    integer(c_int32_t), parameter :: PDN_ERR_POISONED = -902
    integer(c_int32_t), parameter :: PDN_SIGNAL_HARMONICS = 1200
    integer(c_int32_t), parameter :: PDN_SIGNAL_SAMPLES = 1201
    integer(c_int32_t), parameter :: PDN_SIGNAL_FUNCTION = 1202
    integer(c_int32_t), parameter :: PDN_SIGNAL_FUNCTION_OF_PHASE = 1203
    integer(c_int32_t), parameter :: PDN_FIRST_NODE = 100000000
    integer(c_int32_t), parameter :: PDN_FIRST_JOINT = 200000000
    integer(c_int32_t), parameter :: PDN_FIRST_BEAM_ELEMENT = 300000000
    integer(c_int32_t), parameter :: PDN_FIRST_SHELL_ELEMENT = 400000000
    integer(c_int32_t), parameter :: PDN_FIRST_FORCE = 500000000
    integer(c_int32_t), parameter :: PDN_FIRST_RELATION = 600000000
    integer(c_int32_t), parameter :: PDN_FIRST_PARAMETER = 700000000
    integer(c_int32_t), parameter :: PDN_FIRST_LOAD = 800000000
    integer(c_int32_t), parameter :: PDN_FIRST_BEAM_LOAD = 900000000
    integer(c_int32_t), parameter :: PDN_FIRST_SHELL_LOAD = 1000000000
    integer(c_int32_t), parameter :: PDN_FIRST_INERTIA = 1100000000
    integer(c_int32_t), parameter :: PDN_FIRST_PRESCRIBED = 1200000000
    integer(c_int32_t), parameter :: PDN_GROUND = -1
    integer(c_int32_t), parameter :: PDN_JOINT_RIGID = 1300
    integer(c_int32_t), parameter :: PDN_JOINT_REVOLUTE = 1301
    integer(c_int32_t), parameter :: PDN_JOINT_UNIVERSAL = 1302
    integer(c_int32_t), parameter :: PDN_JOINT_SPHERICAL = 1303
    integer(c_int32_t), parameter :: PDN_JOINT_PRISMATIC = 1304
    integer(c_int32_t), parameter :: PDN_JOINT_CYLINDRICAL = 1305
    integer(c_int32_t), parameter :: PDN_JOINT_PLANAR = 1306
    integer(c_int32_t), parameter :: PDN_JOINT_FREE = 1307
    integer(c_int32_t), parameter :: PDN_JOINT_SCREW = 1308
    integer(c_int32_t), parameter :: PDN_JOINT_STRUT = 1309
    integer(c_int32_t), parameter :: PDN_DISPLACEMENT = 1400
    integer(c_int32_t), parameter :: PDN_DISPLACEMENT_2 = 1401
    integer(c_int32_t), parameter :: PDN_DISPLACEMENT_3 = 1402
    integer(c_int32_t), parameter :: PDN_ROTATION = 1403
    integer(c_int32_t), parameter :: PDN_ROTATION_2 = 1404
    integer(c_int32_t), parameter :: PDN_ROTATION_3 = 1405
    integer(c_int32_t), parameter :: PDN_LINE_STRAIGHT = 1500
    integer(c_int32_t), parameter :: PDN_LINE_ARC = 1501
    integer(c_int32_t), parameter :: PDN_LINE_CURVE = 1502
    integer(c_int32_t), parameter :: PDN_FRAME_SPACE = 1600
    integer(c_int32_t), parameter :: PDN_FRAME_MATERIAL = 1601
    integer(c_int32_t), parameter :: PDN_FRAME_UNTWISTED = 1602
    integer(c_int32_t), parameter :: PDN_FORCE_1 = 1700
    integer(c_int32_t), parameter :: PDN_FORCE_2 = 1701
    integer(c_int32_t), parameter :: PDN_FORCE_3 = 1702
    integer(c_int32_t), parameter :: PDN_MOMENT_1 = 1703
    integer(c_int32_t), parameter :: PDN_MOMENT_2 = 1704
    integer(c_int32_t), parameter :: PDN_MOMENT_3 = 1705
    integer(c_int32_t), parameter :: PDN_SURFACE_PARALLELOGRAM = 1800
    integer(c_int32_t), parameter :: PDN_SURFACE_ANNULUS = 1801
    integer(c_int32_t), parameter :: PDN_SURFACE_CYLINDER = 1802
    integer(c_int32_t), parameter :: PDN_SURFACE_FUNCTION = 1803
    integer(c_int32_t), parameter :: PDN_SHELL_NORMALS = 1900
    integer(c_int32_t), parameter :: PDN_SHELL_PARALLEL = 1901
    integer(c_int32_t), parameter :: PDN_SHELL_NODE_AXES = 1902
    integer(c_int32_t), parameter :: PDN_SHELL_NODE_FRAMES = 1903
    integer(c_int32_t), parameter :: PDN_SHELL_EDGE_START_ETA = 2000
    integer(c_int32_t), parameter :: PDN_SHELL_EDGE_END_XI = 2001
    integer(c_int32_t), parameter :: PDN_SHELL_EDGE_END_ETA = 2002
    integer(c_int32_t), parameter :: PDN_SHELL_EDGE_START_XI = 2003
    integer(c_int32_t), parameter :: PDN_SHELL_SURFACE = 2004
    integer(c_int32_t), parameter :: PDN_ANGLES_ROTATION_VECTOR = 2100
    integer(c_int32_t), parameter :: PDN_ANGLES_TILT_AND_SPIN = 2101
    integer(c_int32_t), parameter :: PDN_TANGENTS_DIFFERENCED = 2200
    integer(c_int32_t), parameter :: PDN_TANGENTS_GIVEN = 2201
    integer(c_int32_t), parameter :: PDN_TANGENT_MOTION = 2300
    integer(c_int32_t), parameter :: PDN_TANGENT_VELOCITY = 2301
    integer(c_int32_t), parameter :: PDN_OBJECT_NODE = 1000
    integer(c_int32_t), parameter :: PDN_OBJECT_JOINT = 1001
    integer(c_int32_t), parameter :: PDN_OBJECT_BEAM_ELEMENT = 1002
    integer(c_int32_t), parameter :: PDN_OBJECT_SHELL_ELEMENT = 1003
    integer(c_int32_t), parameter :: PDN_OBJECT_FORCE = 1004
    integer(c_int32_t), parameter :: PDN_OBJECT_RELATION = 1005
    integer(c_int32_t), parameter :: PDN_OBJECT_LOAD = 1006
    integer(c_int32_t), parameter :: PDN_OBJECT_BEAM_LOAD = 1007
    integer(c_int32_t), parameter :: PDN_OBJECT_SHELL_LOAD = 1008
    integer(c_int32_t), parameter :: PDN_OBJECT_INERTIA = 1009
    integer(c_int32_t), parameter :: PDN_OBJECT_PRESCRIBED = 1010
    integer(c_int32_t), parameter :: PDN_LABEL_LENGTH = 200
    integer(c_int32_t), parameter :: PDN_CONVERGED = 2400
    integer(c_int32_t), parameter :: PDN_ITERATION_LIMIT = 2401
    integer(c_int32_t), parameter :: PDN_STALLED = 2402
    integer(c_int32_t), parameter :: PDN_SINGULAR = 2403
    integer(c_int32_t), parameter :: PDN_CANCELLED = 2404
    integer(c_int32_t), parameter :: PDN_NO_INITIAL_GUESS = 2405
    integer(c_int32_t), parameter :: PDN_INCONSISTENT = 2406
    integer(c_int32_t), parameter :: PDN_WRONG_ASSEMBLY = 2407
    integer(c_int32_t), parameter :: PDN_TOLERANCE_NOT_MET = 2408
    integer(c_int32_t), parameter :: PDN_WORK_LIMIT = 2409
    integer(c_int32_t), parameter :: PDN_DECAY_UNKNOWN = 2500
    integer(c_int32_t), parameter :: PDN_DECAY_FAST = 2501
    integer(c_int32_t), parameter :: PDN_DECAY_SLOW = 2502
    integer(c_int32_t), parameter :: PDN_DECAY_ROUNDING = 2503
    integer(c_int32_t), parameter :: PDN_FRAME_FIRST = 1603
    integer(c_int32_t), parameter :: PDN_FRAME_SECOND = 1604
    integer(c_int32_t), parameter :: PDN_NODE_POSITION = 100
    integer(c_int32_t), parameter :: PDN_NODE_ROTATION = 101
    integer(c_int32_t), parameter :: PDN_NODE_QUATERNION = 102
    integer(c_int32_t), parameter :: PDN_NODE_VELOCITY = 103
    integer(c_int32_t), parameter :: PDN_NODE_ACCELERATION = 104
    integer(c_int32_t), parameter :: PDN_JOINT_COORDINATE = 200
    integer(c_int32_t), parameter :: PDN_JOINT_RATE = 201
    integer(c_int32_t), parameter :: PDN_JOINT_ACCELERATION = 202
    integer(c_int32_t), parameter :: PDN_JOINT_DRIVING_EFFORT = 203
    integer(c_int32_t), parameter :: PDN_JOINT_REACTION = 204
    integer(c_int32_t), parameter :: PDN_BEAM_STRAIN = 300
    integer(c_int32_t), parameter :: PDN_BEAM_FORCE = 301
    integer(c_int32_t), parameter :: PDN_BEAM_FORCE_MEAN = 302
    integer(c_int32_t), parameter :: PDN_BEAM_FORCE_JUMP = 303
    integer(c_int32_t), parameter :: PDN_FORCE_EFFORT = 400
    integer(c_int32_t), parameter :: PDN_FORCE_BRANCH_EFFORT = 401
    integer(c_int32_t), parameter :: PDN_FORCE_BRANCH_ELONGATION = 402
    integer(c_int32_t), parameter :: PDN_FORCE_ON_NODE = 403
    integer(c_int32_t), parameter :: PDN_FORCE_BUSHING_EFFORTS = 404
    integer(c_int32_t), parameter :: PDN_FORCE_CONTROL_EFFORT = 405
    integer(c_int32_t), parameter :: PDN_FORCE_CONTROL_STATE = 406
    integer(c_int32_t), parameter :: PDN_SHELL_STRAIN = 500
    integer(c_int32_t), parameter :: PDN_SHELL_RESULTANT = 501
    integer(c_int32_t), parameter :: PDN_SHELL_STRESS_TOP = 502
    integer(c_int32_t), parameter :: PDN_SHELL_STRESS_BOTTOM = 503
    integer(c_int32_t), parameter :: PDN_RELATION_EFFORT = 600
    integer(c_int32_t), parameter :: PDN_ALL_COMPONENTS = -2
    integer(c_int32_t), parameter :: PDN_FILTER_LANCZOS = 3100
    integer(c_int32_t), parameter :: PDN_FILTER_EXPONENTIAL = 3101
    integer(c_int32_t), parameter :: PDN_STAGE_INITIAL_GUESS = 3200
    integer(c_int32_t), parameter :: PDN_STAGE_NEWTON = 3201
    integer(c_int32_t), parameter :: PDN_STAGE_MARCH = 3202
    integer(c_int32_t), parameter :: PDN_STAGE_MODES = 3203
    integer(c_int32_t), parameter :: PDN_STAGE_STABILITY = 3204
    integer(c_int32_t), parameter :: PDN_START_AUTOMATIC = 3300
    integer(c_int32_t), parameter :: PDN_START_QUASI_STATIC = 3301
    integer(c_int32_t), parameter :: PDN_START_STEADY_ROTATION = 3302
    integer(c_int32_t), parameter :: PDN_START_RIGID_ROTATION = 3303
    integer(c_int32_t), parameter :: PDN_START_RAISED_INERTIA = 3304
    integer(c_int32_t), parameter :: PDN_START_MARCH = 3305
    integer(c_int32_t), parameter :: PDN_START_LOWERED_DAMPING = 3306
    integer(c_int32_t), parameter :: PDN_START_RAISED_LOADS = 3307
    integer(c_int32_t), parameter :: PDN_TIME_MAP_AUTOMATIC = 3400
    integer(c_int32_t), parameter :: PDN_TIME_MAP_EQUISPACED = 3401
    integer(c_int32_t), parameter :: PDN_TIME_MAP_EVENTS = 3402
    integer(c_int32_t), parameter :: PDN_LINEAR_AUTOMATIC = 3500
    integer(c_int32_t), parameter :: PDN_LINEAR_DIRECT = 3501
    integer(c_int32_t), parameter :: PDN_LINEAR_ITERATIVE = 3502
    integer(c_int32_t), parameter :: PDN_LINEAR_BODY_CIRCULANT = 3503
    integer(c_int32_t), parameter :: PDN_LINEAR_TIME_LOCAL = 3504
    integer(c_int32_t), parameter :: PDN_LINEAR_CIRCULANT = 3505
    integer(c_int32_t), parameter :: PDN_NUMBER_STIFFNESS = 3600
    integer(c_int32_t), parameter :: PDN_NUMBER_DAMPING = 3601
    integer(c_int32_t), parameter :: PDN_NUMBER_REST = 3602
    integer(c_int32_t), parameter :: PDN_NUMBER_INERTIA = 3603
    integer(c_int32_t), parameter :: PDN_NUMBER_BEAM_STIFFNESS = 3604
    integer(c_int32_t), parameter :: PDN_NUMBER_BEAM_MASS = 3605
    integer(c_int32_t), parameter :: PDN_NUMBER_BEAM_DAMPING = 3606
    integer(c_int32_t), parameter :: PDN_NUMBER_MASS_DAMPING = 3607
    integer(c_int32_t), parameter :: PDN_NUMBER_SHELL_STIFFNESS = 3609
    integer(c_int32_t), parameter :: PDN_NUMBER_SHELL_MASS = 3610
    integer(c_int32_t), parameter :: PDN_NUMBER_SHELL_DAMPING = 3611
    integer(c_int32_t), parameter :: PDN_NUMBER_SHELL_THICKNESS = 3612
    integer(c_int32_t), parameter :: PDN_NUMBER_FRAME_RATE = 3613
    integer(c_int32_t), parameter :: PDN_NUMBER_SPIN = 3614
    integer(c_int32_t), parameter :: PDN_NUMBER_BEAM_SPIN = 3615
    integer(c_int32_t), parameter :: PDN_NUMBER_FRAME_ADVANCE = 3616
    integer(c_int32_t), parameter :: PDN_PART_MEAN = 3800
    integer(c_int32_t), parameter :: PDN_PART_RATE = 3801
    integer(c_int32_t), parameter :: PDN_PART_AMPLITUDE = 3802
    integer(c_int32_t), parameter :: PDN_PART_PHASE = 3803
    integer(c_int32_t), parameter :: PDN_FREQUENCY = -3
    integer(c_int32_t), parameter :: PDN_GRAVITY = -4
    integer(c_int32_t), parameter :: PDN_FORCE_IS_SPRING_DAMPER = 1100
    integer(c_int32_t), parameter :: PDN_FORCE_IS_ACTUATOR = 1101
    integer(c_int32_t), parameter :: PDN_FORCE_IS_COORDINATE_LAW = 1102
    integer(c_int32_t), parameter :: PDN_FORCE_IS_VISCOELASTIC = 1103
    integer(c_int32_t), parameter :: PDN_FORCE_IS_VISCOUS_DAMPER = 1104
    integer(c_int32_t), parameter :: PDN_FORCE_IS_BUSHING = 1105
    integer(c_int32_t), parameter :: PDN_FORCE_IS_USER_FORCE = 1106
    integer(c_int32_t), parameter :: PDN_FORCE_IS_CONTROLLER = 1107
    integer(c_int32_t), parameter :: PDN_FORCE_IS_SURFACE_FORCE = 1108
    integer(c_int32_t), parameter :: PDN_FORCE_IS_LINE_FORCE = 1109
    integer(c_int32_t), parameter :: PDN_NUMBER_RELAXATION_TIME = 3608
    integer(c_int32_t), parameter :: PDN_FEATURE_MEAN = 2900
    integer(c_int32_t), parameter :: PDN_FEATURE_COSINE = 2901
    integer(c_int32_t), parameter :: PDN_FEATURE_SINE = 2902
    integer(c_int32_t), parameter :: PDN_FEATURE_VALUE = 2903
    integer(c_int32_t), parameter :: PDN_FEATURE_LARGEST = 2904
    integer(c_int32_t), parameter :: PDN_FEATURE_SMALLEST = 2905
    integer(c_int32_t), parameter :: PDN_SENSITIVITY_AUTOMATIC = 3900
    integer(c_int32_t), parameter :: PDN_SENSITIVITY_DIRECT = 3901
    integer(c_int32_t), parameter :: PDN_SENSITIVITY_ADJOINT = 3902
    integer(c_int32_t), parameter :: PDN_BRANCH_RANGE = 4000
    integer(c_int32_t), parameter :: PDN_BRANCH_CLOSED = 4001
    integer(c_int32_t), parameter :: PDN_BRANCH_POINT_LIMIT = 4002
    integer(c_int32_t), parameter :: PDN_BRANCH_SMALLEST_STEP = 4003
    integer(c_int32_t), parameter :: PDN_BRANCH_CANCELLED = 4004
    integer(c_int32_t), parameter :: PDN_BRANCH_NO_START = 4005
    integer(c_int32_t), parameter :: PDN_BRANCH_FAILED = 4006
    integer(c_int32_t), parameter :: PDN_EVENT_NONE = 4100
    integer(c_int32_t), parameter :: PDN_EVENT_FOLD = 4101
    integer(c_int32_t), parameter :: PDN_EVENT_BRANCH_POINT = 4102
    integer(c_int32_t), parameter :: PDN_EVENT_PERIOD_DOUBLING = 4103
    integer(c_int32_t), parameter :: PDN_EVENT_TORUS = 4104
    integer(c_int32_t), parameter :: PDN_STABILITY_NOT_KNOWN = 4200
    integer(c_int32_t), parameter :: PDN_STABLE = 4201
    integer(c_int32_t), parameter :: PDN_UNSTABLE = 4202

    type, bind(C) :: pdn_section
        integer(c_size_t) :: struct_size = 0
        real(c_double) :: stiffness(36)
        real(c_double) :: mass(36)
        real(c_double) :: damping(36)
    end type pdn_section

    type, bind(C) :: pdn_signal
        integer(c_size_t) :: struct_size = 0
        integer(c_int32_t) :: kind
        integer(c_int32_t) :: reserved
        real(c_double) :: mean
        real(c_double) :: rate
        type(c_ptr) :: cosines = c_null_ptr
        type(c_ptr) :: sines = c_null_ptr
        integer(c_size_t) :: harmonics
        type(c_ptr) :: samples = c_null_ptr
        integer(c_size_t) :: sample_count
        type(c_funptr) :: function = c_null_funptr
        type(c_ptr) :: user_data = c_null_ptr
    end type pdn_signal

    type, bind(C) :: pdn_frame
        real(c_double) :: position(3)
        real(c_double) :: rotation(9)
    end type pdn_frame

    type, bind(C) :: pdn_line
        integer(c_size_t) :: struct_size = 0
        integer(c_int32_t) :: kind
        integer(c_int32_t) :: reserved
        real(c_double) :: start(3)
        real(c_double) :: point(3)
        real(c_double) :: end(3)
        real(c_double) :: axis_2(3)
        type(c_funptr) :: curve = c_null_funptr
        type(c_ptr) :: user_data = c_null_ptr
    end type pdn_line

    type, bind(C) :: pdn_stations
        integer(c_size_t) :: struct_size = 0
        integer(c_size_t) :: count
        type(c_ptr) :: fractions = c_null_ptr
        type(c_ptr) :: sections = c_null_ptr
        type(c_ptr) :: twists = c_null_ptr
    end type pdn_stations

    type, bind(C) :: pdn_beam
        integer(c_int32_t) :: first
        integer(c_int32_t) :: last
        integer(c_int32_t) :: first_element
        integer(c_int32_t) :: elements
        integer(c_int32_t) :: reserved(4)
    end type pdn_beam

    type, bind(C) :: pdn_surface
        integer(c_size_t) :: struct_size = 0
        integer(c_int32_t) :: kind
        integer(c_int32_t) :: reserved
        real(c_double) :: origin(3)
        real(c_double) :: axis(3)
        real(c_double) :: start(3)
        real(c_double) :: sizes(2)
        real(c_double) :: angle
        type(c_funptr) :: function = c_null_funptr
        type(c_ptr) :: user_data = c_null_ptr
    end type pdn_surface

    type, bind(C) :: pdn_shell_section
        integer(c_size_t) :: struct_size = 0
        real(c_double) :: stiffness(144)
        real(c_double) :: damping(144)
        real(c_double) :: mass(36)
    end type pdn_shell_section

    type, bind(C) :: pdn_shell_placement
        integer(c_size_t) :: struct_size = 0
        integer(c_int32_t) :: frames
        integer(c_int32_t) :: reserved
        real(c_double) :: offset
        real(c_double) :: direction(3)
    end type pdn_shell_placement

    type, bind(C) :: pdn_shell
        integer(c_int32_t) :: first_element
        integer(c_int32_t) :: elements_u
        integer(c_int32_t) :: elements_v
        integer(c_int32_t) :: nodes_u
        integer(c_int32_t) :: nodes_v
        integer(c_int32_t) :: reserved(3)
    end type pdn_shell

    type, bind(C) :: pdn_force_state
        integer(c_size_t) :: struct_size = 0
        real(c_double) :: time
        integer(c_size_t) :: node_count
        type(c_ptr) :: positions = c_null_ptr
        type(c_ptr) :: rotations = c_null_ptr
        type(c_ptr) :: velocities = c_null_ptr
        integer(c_size_t) :: column_count
    end type pdn_force_state

    type, bind(C) :: pdn_force_values
        integer(c_size_t) :: struct_size = 0
        type(c_ptr) :: forces = c_null_ptr
        type(c_ptr) :: by_motion = c_null_ptr
        type(c_ptr) :: by_velocity = c_null_ptr
    end type pdn_force_values

    type, bind(C) :: pdn_tangent_check
        integer(c_size_t) :: struct_size = 0
        real(c_double) :: error
        real(c_double) :: time
        real(c_double) :: given
        real(c_double) :: differenced
        integer(c_int32_t) :: tangent
        integer(c_int32_t) :: row_node
        integer(c_int32_t) :: row_component
        integer(c_int32_t) :: column_node
        integer(c_int32_t) :: column_component
        integer(c_int32_t) :: reserved
    end type pdn_tangent_check

    type, bind(C) :: pdn_controller_state
        integer(c_size_t) :: struct_size = 0
        real(c_double) :: time
        integer(c_size_t) :: input_count
        type(c_ptr) :: inputs = c_null_ptr
        type(c_ptr) :: input_rates = c_null_ptr
        integer(c_size_t) :: state_count
        type(c_ptr) :: states = c_null_ptr
    end type pdn_controller_state

    type, bind(C) :: pdn_controller_values
        integer(c_size_t) :: struct_size = 0
        integer(c_size_t) :: output_count
        type(c_ptr) :: efforts = c_null_ptr
        type(c_ptr) :: state_rates = c_null_ptr
        type(c_ptr) :: by_inputs = c_null_ptr
        type(c_ptr) :: by_input_rates = c_null_ptr
        type(c_ptr) :: by_states = c_null_ptr
    end type pdn_controller_values

    type, bind(C) :: pdn_surface_state
        integer(c_size_t) :: struct_size = 0
        real(c_double) :: time
        integer(c_int32_t) :: element
        integer(c_int32_t) :: reserved
        integer(c_size_t) :: point_count
        type(c_ptr) :: places = c_null_ptr
        type(c_ptr) :: sizes = c_null_ptr
        type(c_ptr) :: positions = c_null_ptr
        type(c_ptr) :: rotations = c_null_ptr
        type(c_ptr) :: velocities = c_null_ptr
    end type pdn_surface_state

    type, bind(C) :: pdn_surface_values
        integer(c_size_t) :: struct_size = 0
        type(c_ptr) :: forces = c_null_ptr
        type(c_ptr) :: by_motion = c_null_ptr
        type(c_ptr) :: by_velocity = c_null_ptr
    end type pdn_surface_values

    type, bind(C) :: pdn_diagnostics
        integer(c_size_t) :: struct_size = 0
        integer(c_int32_t) :: outcome
        integer(c_int32_t) :: iterations
        integer(c_int32_t) :: guess_iterations
        integer(c_int32_t) :: redundant_constraints
        integer(c_size_t) :: grid_points
        integer(c_size_t) :: unknowns
        real(c_double) :: last_increment
        real(c_double) :: error_estimate
        real(c_double) :: force_residual_between
        real(c_double) :: constraint_residual_between
        real(c_double) :: guess_seconds
        real(c_double) :: assembly_seconds
        real(c_double) :: analysis_seconds
        real(c_double) :: factorisation_seconds
        real(c_double) :: substitution_seconds
        integer(c_int32_t) :: decay
        integer(c_int32_t) :: grids
        real(c_double) :: decay_order
        real(c_double) :: least_resolved_time
        integer(c_int32_t) :: linear_solver
        integer(c_int32_t) :: linear_iterations
        integer(c_int32_t) :: linear_solves
        integer(c_int32_t) :: most_linear_iterations
        integer(c_size_t) :: linear_bytes
        real(c_double) :: preconditioner_seconds
        real(c_double) :: interface_seconds
        real(c_double) :: estimate_seconds
        real(c_double) :: total_seconds
        integer(c_int32_t) :: total_iterations
        integer(c_int32_t) :: attempts
        real(c_double) :: mesh_error
    end type pdn_diagnostics

    type, bind(C) :: pdn_quantity
        integer(c_size_t) :: struct_size = 0
        integer(c_int32_t) :: kind
        integer(c_int32_t) :: object
        integer(c_int32_t) :: component
        integer(c_int32_t) :: frame
        integer(c_int32_t) :: node
        integer(c_int32_t) :: branch
        real(c_double) :: station
        real(c_double) :: station_eta
        real(c_double) :: direction(3)
    end type pdn_quantity

    type, bind(C) :: pdn_progress
        integer(c_size_t) :: struct_size = 0
        integer(c_int32_t) :: stage
        integer(c_int32_t) :: iteration
        real(c_double) :: residual
        real(c_double) :: increment
        real(c_double) :: step
        real(c_double) :: time
        real(c_double) :: elapsed
        integer(c_size_t) :: grid_points
        integer(c_int32_t) :: attempt
        integer(c_int32_t) :: start
        integer(c_int32_t) :: iterated
        integer(c_int32_t) :: reserved
    end type pdn_progress

    type, bind(C) :: pdn_periodic_options
        integer(c_size_t) :: struct_size = 0
        integer(c_size_t) :: grid_points
        integer(c_size_t) :: harmonics
        real(c_double) :: tolerance
        integer(c_size_t) :: iteration_limit
        type(c_ptr) :: initial = c_null_ptr
        type(c_ptr) :: guess_positions = c_null_ptr
        type(c_ptr) :: guess_rotations = c_null_ptr
        type(c_funptr) :: progress = c_null_funptr
        type(c_ptr) :: progress_data = c_null_ptr
        real(c_double) :: error_tolerance
        integer(c_size_t) :: largest_grid_points
        integer(c_int32_t) :: linear_solver
        integer(c_int32_t) :: threads
        integer(c_size_t) :: oversampling
        real(c_double) :: response_tolerance
        integer(c_int32_t) :: start
        integer(c_int32_t) :: estimate_mesh
        real(c_double) :: progress_interval
        real(c_double) :: work_limit
        integer(c_size_t) :: memory_limit
        integer(c_int32_t) :: time_map
        integer(c_int32_t) :: reserved
        integer(c_size_t) :: event_count
        type(c_ptr) :: event_times = c_null_ptr
        type(c_ptr) :: event_widths = c_null_ptr
        type(c_ptr) :: event_shares = c_null_ptr
    end type pdn_periodic_options

    type, bind(C) :: pdn_equations_options
        integer(c_size_t) :: struct_size = 0
        integer(c_size_t) :: grid_points
        type(c_ptr) :: initial = c_null_ptr
        type(c_ptr) :: owners = c_null_ptr
        integer(c_size_t) :: owner_count
        integer(c_int32_t) :: rank
        integer(c_int32_t) :: ranks
        integer(c_int32_t) :: preconditioner
        integer(c_int32_t) :: threads
        type(c_funptr) :: exchange = c_null_funptr
        type(c_funptr) :: gather = c_null_funptr
        type(c_ptr) :: ranks_data = c_null_ptr
    end type pdn_equations_options

    type, bind(C) :: pdn_equations_sizes
        integer(c_size_t) :: struct_size = 0
        integer(c_size_t) :: size
        integer(c_size_t) :: halo
        integer(c_size_t) :: total
        integer(c_size_t) :: nodes
        integer(c_size_t) :: motions
        integer(c_size_t) :: own_unknowns
        integer(c_size_t) :: bytes
        integer(c_int32_t) :: preconditioner
        integer(c_int32_t) :: reserved
    end type pdn_equations_sizes

    type, bind(C) :: pdn_joint_info
        integer(c_size_t) :: struct_size = 0
        integer(c_int32_t) :: kind
        integer(c_int32_t) :: first
        integer(c_int32_t) :: second
        integer(c_int32_t) :: reserved
        real(c_double) :: pitch
        real(c_double) :: first_position(3)
        real(c_double) :: first_rotation(9)
        real(c_double) :: second_position(3)
        real(c_double) :: second_rotation(9)
    end type pdn_joint_info

    type, bind(C) :: pdn_force_info
        integer(c_size_t) :: struct_size = 0
        integer(c_int32_t) :: kind
        integer(c_int32_t) :: joint
        integer(c_int32_t) :: coordinate
        integer(c_int32_t) :: first
        integer(c_int32_t) :: second
        integer(c_int32_t) :: angles
        integer(c_int32_t) :: stiffness_count
        integer(c_int32_t) :: damping_count
        integer(c_int32_t) :: branch_count
        integer(c_int32_t) :: node_count
        real(c_double) :: rest
        real(c_double) :: first_position(3)
        real(c_double) :: first_rotation(9)
        real(c_double) :: second_position(3)
        real(c_double) :: second_rotation(9)
        integer(c_int32_t) :: shell_element
        integer(c_int32_t) :: shell_place
        integer(c_int32_t) :: beam_element
        integer(c_int32_t) :: nodes_apart
        real(c_double) :: axis_2(3)
    end type pdn_force_info

    type, bind(C) :: pdn_sensitivity_options
        integer(c_size_t) :: struct_size = 0
        integer(c_int32_t) :: method
        integer(c_int32_t) :: linear_solver
        integer(c_int32_t) :: threads
        integer(c_int32_t) :: reserved
    end type pdn_sensitivity_options

    type, bind(C) :: pdn_branch_point
        integer(c_size_t) :: struct_size = 0
        real(c_double) :: parameter
        real(c_double) :: slope
        real(c_double) :: period
        real(c_double) :: step
        real(c_double) :: angle
        integer(c_size_t) :: grid_points
        integer(c_int32_t) :: iterations
        integer(c_int32_t) :: event
        real(c_double) :: second_frequency
        real(c_double) :: largest_multiplier
        integer(c_int32_t) :: multipliers_outside
        integer(c_int32_t) :: stability
    end type pdn_branch_point

    type, bind(C) :: pdn_branch_options
        integer(c_size_t) :: struct_size = 0
        type(c_ptr) :: periodic = c_null_ptr
        type(c_ptr) :: conditions = c_null_ptr
        real(c_double) :: from
        real(c_double) :: to
        real(c_double) :: motion_scale
        real(c_double) :: first_step
        real(c_double) :: smallest_step
        real(c_double) :: largest_step
        real(c_double) :: angle
        integer(c_size_t) :: point_limit
        type(c_funptr) :: progress = c_null_funptr
        type(c_ptr) :: progress_data = c_null_ptr
        integer(c_int32_t) :: downwards
        integer(c_int32_t) :: events
        integer(c_int32_t) :: stability
        integer(c_int32_t) :: reserved
    end type pdn_branch_options

    type, bind(C) :: pdn_stability_options
        integer(c_size_t) :: struct_size = 0
        real(c_double) :: highest_frequency
        real(c_double) :: tolerance
        type(c_funptr) :: progress = c_null_funptr
        type(c_ptr) :: progress_data = c_null_ptr
    end type pdn_stability_options

    type, bind(C) :: pdn_static_options
        integer(c_size_t) :: struct_size = 0
        real(c_double) :: time
        real(c_double) :: period
        integer(c_size_t) :: load_steps
        real(c_double) :: tolerance
        integer(c_size_t) :: iteration_limit
        real(c_double) :: angular_velocity(3)
        real(c_double) :: axis_point(3)
        type(c_ptr) :: initial = c_null_ptr
        type(c_funptr) :: progress = c_null_funptr
        type(c_ptr) :: progress_data = c_null_ptr
        integer(c_size_t) :: memory_limit
    end type pdn_static_options

    type, bind(C) :: pdn_modes_options
        integer(c_size_t) :: struct_size = 0
        type(c_ptr) :: equilibrium = c_null_ptr
        integer(c_size_t) :: count
        real(c_double) :: near_frequency
    end type pdn_modes_options

    type, bind(C) :: pdn_mode
        integer(c_size_t) :: struct_size = 0
        real(c_double) :: eigenvalue_real
        real(c_double) :: eigenvalue_imaginary
        real(c_double) :: frequency
        real(c_double) :: damping_ratio
        real(c_double) :: modal_mass
        real(c_double) :: residual
    end type pdn_mode

    type, bind(C) :: pdn_march_options
        integer(c_size_t) :: struct_size = 0
        real(c_double) :: start_time
        real(c_double) :: duration
        real(c_double) :: period
        real(c_double) :: step
        integer(c_size_t) :: steps_per_period
        real(c_double) :: spectral_radius
        real(c_double) :: error_tolerance
        real(c_double) :: periodic_tolerance
        integer(c_size_t) :: most_periods
        integer(c_size_t) :: stored_periods
        real(c_double) :: tolerance
        integer(c_size_t) :: iteration_limit
        type(c_ptr) :: initial = c_null_ptr
        type(c_ptr) :: positions = c_null_ptr
        type(c_ptr) :: rotations = c_null_ptr
        type(c_ptr) :: velocities = c_null_ptr
        type(c_funptr) :: progress = c_null_funptr
        type(c_ptr) :: progress_data = c_null_ptr
        integer(c_size_t) :: memory_limit
    end type pdn_march_options

    type, bind(C) :: pdn_march_diagnostics
        integer(c_size_t) :: struct_size = 0
        integer(c_size_t) :: steps
        integer(c_size_t) :: rejected_steps
        integer(c_size_t) :: iterations
        integer(c_size_t) :: periods
        real(c_double) :: first_time
        real(c_double) :: last_time
        real(c_double) :: repetition
        real(c_double) :: step_error
        real(c_double) :: start_moved
        real(c_double) :: start_corrected
    end type pdn_march_diagnostics

    type, bind(C) :: pdn_shooting_options
        integer(c_size_t) :: struct_size = 0
        integer(c_size_t) :: steps_per_period
        integer(c_size_t) :: guess_periods
        real(c_double) :: spectral_radius
        real(c_double) :: tolerance
        integer(c_size_t) :: iteration_limit
        type(c_ptr) :: initial = c_null_ptr
        type(c_funptr) :: progress = c_null_funptr
        type(c_ptr) :: progress_data = c_null_ptr
        integer(c_size_t) :: memory_limit
    end type pdn_shooting_options

    type, bind(C) :: pdn_multiplier
        integer(c_size_t) :: struct_size = 0
        real(c_double) :: real
        real(c_double) :: imaginary
        real(c_double) :: exponent_real
        real(c_double) :: exponent_imaginary
        real(c_double) :: frequency
        real(c_double) :: error
        integer(c_int32_t) :: trivial
        integer(c_int32_t) :: reserved
    end type pdn_multiplier

    type, bind(C) :: pdn_summary
        integer(c_size_t) :: struct_size = 0
        integer(c_int32_t) :: nodes
        integer(c_int32_t) :: beam_elements
        integer(c_int32_t) :: joints
        integer(c_int32_t) :: prescribed
        integer(c_int32_t) :: constraints
        integer(c_int32_t) :: redundant_constraints
        integer(c_int32_t) :: degrees_of_freedom
        integer(c_int32_t) :: members
        integer(c_int32_t) :: mobility
        integer(c_int32_t) :: redundant_if_rigid
        integer(c_int32_t) :: parts
        integer(c_int32_t) :: warnings
        real(c_double) :: mass
        real(c_double) :: centre(3)
    end type pdn_summary

    ! Functions of the caller; they are handed over as c_funloc(function).
    abstract interface
        ! A function of time, to be written by the caller
        function pdn_signal_fn(time, value, user_data) bind(C)
            import
            real(c_double), value :: time
            real(c_double), intent(inout) :: value
            type(c_ptr), value :: user_data
            integer(c_int32_t) :: pdn_signal_fn
        end function pdn_signal_fn

        ! A smooth curve in space, to be written by the caller
        function pdn_curve_fn(fraction, position, axis_2, user_data) bind(C)
            import
            real(c_double), value :: fraction
            real(c_double), intent(inout) :: position(*)
            real(c_double), intent(inout) :: axis_2(*)
            type(c_ptr), value :: user_data
            integer(c_int32_t) :: pdn_curve_fn
        end function pdn_curve_fn

        ! A surface in space, to be written by the caller
        function pdn_surface_fn(u, v, position, user_data) bind(C)
            import
            real(c_double), value :: u
            real(c_double), value :: v
            real(c_double), intent(inout) :: position(*)
            type(c_ptr), value :: user_data
            integer(c_int32_t) :: pdn_surface_fn
        end function pdn_surface_fn

        ! A law of effort on a joint coordinate, to be written by the caller
        function pdn_coordinate_law_fn(time, coordinate, rate, effort, derivatives, &
            user_data) bind(C)
            import
            real(c_double), value :: time
            real(c_double), value :: coordinate
            real(c_double), value :: rate
            real(c_double), intent(inout) :: effort
            real(c_double), intent(inout), optional :: derivatives(*)
            type(c_ptr), value :: user_data
            integer(c_int32_t) :: pdn_coordinate_law_fn
        end function pdn_coordinate_law_fn

        ! Disposes of the `user_data` of a force; see ::pdn_model_add_user_force for when it is
        ! called
        subroutine pdn_destroy_fn(user_data) bind(C)
            import
            type(c_ptr), value :: user_data
        end subroutine pdn_destroy_fn

        ! Forces on nodes, to be computed by the caller
        function pdn_user_force_fn(state, values, user_data) bind(C)
            import
            type(pdn_force_state), intent(in) :: state
            type(pdn_force_values), intent(inout) :: values
            type(c_ptr), value :: user_data
            integer(c_int32_t) :: pdn_user_force_fn
        end function pdn_user_force_fn

        ! A controller, to be written by the caller
        function pdn_controller_fn(state, values, user_data) bind(C)
            import
            type(pdn_controller_state), intent(in) :: state
            type(pdn_controller_values), intent(inout) :: values
            type(c_ptr), value :: user_data
            integer(c_int32_t) :: pdn_controller_fn
        end function pdn_controller_fn

        ! Forces on shells or along beams, to be computed by the caller, such as of a fluid: for
        ! all points of one element at once, each by the motion of this point alone
        function pdn_surface_force_fn(state, values, user_data) bind(C)
            import
            type(pdn_surface_state), intent(in) :: state
            type(pdn_surface_values), intent(inout) :: values
            type(c_ptr), value :: user_data
            integer(c_int32_t) :: pdn_surface_force_fn
        end function pdn_surface_force_fn

        ! Called after each Newton iteration, or after each step of a march, and while one lasts
        ! about ten times a second, on the solving thread
        function pdn_progress_fn(progress, user_data) bind(C)
            import
            type(pdn_progress), intent(in) :: progress
            type(c_ptr), value :: user_data
            integer(c_int32_t) :: pdn_progress_fn
        end function pdn_progress_fn

        ! Sends numbers from each rank to each, as MPI_Alltoallv does
        function pdn_exchange_fn(send, send_counts, receive, receive_counts, user_data) bind(C)
            import
            real(c_double), intent(in) :: send(*)
            integer(c_size_t), intent(in) :: send_counts(*)
            real(c_double), intent(inout) :: receive
            integer(c_size_t), intent(in) :: receive_counts(*)
            type(c_ptr), value :: user_data
            integer(c_int32_t) :: pdn_exchange_fn
        end function pdn_exchange_fn

        ! Sends numbers from each rank to all, itself too, as MPI_Allgatherv does
        function pdn_gather_fn(send, send_count, receive, receive_counts, user_data) bind(C)
            import
            real(c_double), intent(in) :: send(*)
            integer(c_size_t), value :: send_count
            real(c_double), intent(inout) :: receive
            integer(c_size_t), intent(in) :: receive_counts(*)
            type(c_ptr), value :: user_data
            integer(c_int32_t) :: pdn_gather_fn
        end function pdn_gather_fn

        ! Called with each point of a branch, on the thread that follows it; `number` counts from
        ! 1
        function pdn_branch_fn(point, number, user_data) bind(C)
            import
            type(pdn_branch_point), intent(in) :: point
            integer(c_int32_t), value :: number
            type(c_ptr), value :: user_data
            integer(c_int32_t) :: pdn_branch_fn
        end function pdn_branch_fn
    end interface

    interface
        ! Version of the library, such as "0.1.0"
        function pdn_version() bind(C, name="pdn_version")
            import
            type(c_ptr) :: pdn_version
        end function pdn_version

        ! Whether the library serves a program compiled with the header of version major.minor
        function pdn_version_check(major, minor) bind(C, name="pdn_version_check")
            import
            integer(c_int32_t), value :: major
            integer(c_int32_t), value :: minor
            integer(c_int32_t) :: pdn_version_check
        end function pdn_version_check

        ! How the library was built: version, profile and platform, for reports of defects
        function pdn_build_info() bind(C, name="pdn_build_info")
            import
            type(c_ptr) :: pdn_build_info
        end function pdn_build_info

        ! Name of a status, such as "PDN_ERR_NULL"
        function pdn_status_name(status) bind(C, name="pdn_status_name")
            import
            integer(c_int32_t), value :: status
            type(c_ptr) :: pdn_status_name
        end function pdn_status_name

        ! One-line meaning of a status
        function pdn_status_message(status) bind(C, name="pdn_status_message")
            import
            integer(c_int32_t), value :: status
            type(c_ptr) :: pdn_status_message
        end function pdn_status_message

        ! Message of the last call that failed on this thread: which argument, what was expected,
        ! what came
        function pdn_last_error(buffer, capacity) bind(C, name="pdn_last_error")
            import
            character(kind=c_char), intent(inout), optional :: buffer(*)
            integer(c_size_t), value :: capacity
            integer(c_size_t) :: pdn_last_error
        end function pdn_last_error

        ! Sets the message that ::pdn_last_error gives on this thread: for libraries on top of
        ! this one, whose own functions fail
        function pdn_set_last_error(message) bind(C, name="pdn_set_last_error")
            import
            character(kind=c_char), intent(in) :: message(*)
            integer(c_int32_t) :: pdn_set_last_error
        end function pdn_set_last_error

        ! To be called by a callback that is about to report failure: says why
        function pdn_set_callback_error(message) bind(C, name="pdn_set_callback_error")
            import
            character(kind=c_char), intent(in) :: message(*)
            integer(c_int32_t) :: pdn_set_callback_error
        end function pdn_set_callback_error

        ! What the last failing callback on this thread returned
        function pdn_last_callback_code() bind(C, name="pdn_last_callback_code")
            import
            integer(c_int32_t) :: pdn_last_callback_code
        end function pdn_last_callback_code

        ! Chooses whether internal errors are also printed to stderr
        subroutine pdn_set_panic_printing(enabled) bind(C, name="pdn_set_panic_printing")
            import
            integer(c_int32_t), value :: enabled
        end subroutine pdn_set_panic_printing

        ! Gives the system back the memory that the library keeps for later solves
        function pdn_release_memory() bind(C, name="pdn_release_memory")
            import
            integer(c_int32_t) :: pdn_release_memory
        end function pdn_release_memory

        ! Makes a section with no stiffness, mass or damping
        subroutine pdn_section_init(section, struct_size) bind(C, name="pdn_section_init")
            import
            type(pdn_section), intent(inout) :: section
            integer(c_size_t), value :: struct_size
        end subroutine pdn_section_init

        ! Describes a section without couplings: centroid, shear centre and centre of mass lie on
        ! the beam's line, and axes 2 and 3 are principal
        function pdn_section_set_diagonal(section, stiffness, &
            mass) bind(C, name="pdn_section_set_diagonal")
            import
            type(pdn_section), intent(inout) :: section
            real(c_double), intent(in) :: stiffness(*)
            real(c_double), intent(in) :: mass(*)
            integer(c_int32_t) :: pdn_section_set_diagonal
        end function pdn_section_set_diagonal

        ! Gives a section damping with one time for each force and moment: damping = diag(seconds)
        ! * stiffness, which must have been set
        function pdn_section_set_component_damping(section, &
            seconds) bind(C, name="pdn_section_set_component_damping")
            import
            type(pdn_section), intent(inout) :: section
            real(c_double), intent(in) :: seconds(*)
            integer(c_int32_t) :: pdn_section_set_component_damping
        end function pdn_section_set_component_damping

        ! Gives a section damping in proportion to its stiffness, which must have been set
        function pdn_section_set_proportional_damping(section, &
            seconds) bind(C, name="pdn_section_set_proportional_damping")
            import
            type(pdn_section), intent(inout) :: section
            real(c_double), value :: seconds
            integer(c_int32_t) :: pdn_section_set_proportional_damping
        end function pdn_section_set_proportional_damping

        ! Makes a signal that is zero
        subroutine pdn_signal_init(signal, struct_size) bind(C, name="pdn_signal_init")
            import
            type(pdn_signal), intent(inout) :: signal
            integer(c_size_t), value :: struct_size
        end subroutine pdn_signal_init

        ! Makes a signal constant
        function pdn_signal_set_constant(signal, value) bind(C, name="pdn_signal_set_constant")
            import
            type(pdn_signal), intent(inout) :: signal
            real(c_double), value :: value
            integer(c_int32_t) :: pdn_signal_set_constant
        end function pdn_signal_set_constant

        ! Makes a signal of harmonics, mean and rate
        function pdn_signal_set_harmonics(signal, mean, rate, cosines, sines, &
            count) bind(C, name="pdn_signal_set_harmonics")
            import
            type(pdn_signal), intent(inout) :: signal
            real(c_double), value :: mean
            real(c_double), value :: rate
            real(c_double), intent(in), optional :: cosines(*)
            real(c_double), intent(in), optional :: sines(*)
            integer(c_size_t), value :: count
            integer(c_int32_t) :: pdn_signal_set_harmonics
        end function pdn_signal_set_harmonics

        ! Makes a signal rate t plus the trigonometric interpolation of samples[k] at t = k T /
        ! count
        function pdn_signal_set_samples(signal, rate, samples, &
            count) bind(C, name="pdn_signal_set_samples")
            import
            type(pdn_signal), intent(inout) :: signal
            real(c_double), value :: rate
            real(c_double), intent(in) :: samples(*)
            integer(c_size_t), value :: count
            integer(c_int32_t) :: pdn_signal_set_samples
        end function pdn_signal_set_samples

        ! Makes a signal a function of the caller
        function pdn_signal_set_function(signal, function, &
            user_data) bind(C, name="pdn_signal_set_function")
            import
            type(pdn_signal), intent(inout) :: signal
            type(c_funptr), value :: function
            type(c_ptr), value :: user_data
            integer(c_int32_t) :: pdn_signal_set_function
        end function pdn_signal_set_function

        ! Makes a signal a function of the caller, of the phase 2 pi t / T \[radians\], which it
        ! is told in place of the time: it holds for any period T
        function pdn_signal_set_function_of_phase(signal, function, &
            user_data) bind(C, name="pdn_signal_set_function_of_phase")
            import
            type(pdn_signal), intent(inout) :: signal
            type(c_funptr), value :: function
            type(c_ptr), value :: user_data
            integer(c_int32_t) :: pdn_signal_set_function_of_phase
        end function pdn_signal_set_function_of_phase

        ! Makes an empty model
        function pdn_model_new(model) bind(C, name="pdn_model_new")
            import
            type(c_ptr), intent(inout) :: model
            integer(c_int32_t) :: pdn_model_new
        end function pdn_model_new

        ! Frees a model
        subroutine pdn_model_free(model) bind(C, name="pdn_model_free")
            import
            type(c_ptr), value :: model
        end subroutine pdn_model_free

        ! Number of nodes; their ids follow each other from PDN_FIRST_NODE on
        function pdn_model_node_count(model, count) bind(C, name="pdn_model_node_count")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), intent(inout) :: count
            integer(c_int32_t) :: pdn_model_node_count
        end function pdn_model_node_count

        ! Number of joints; their ids follow each other from PDN_FIRST_JOINT on
        function pdn_model_joint_count(model, count) bind(C, name="pdn_model_joint_count")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), intent(inout) :: count
            integer(c_int32_t) :: pdn_model_joint_count
        end function pdn_model_joint_count

        ! Number of beam elements; their ids follow each other from PDN_FIRST_BEAM_ELEMENT on
        function pdn_model_element_count(model, count) bind(C, name="pdn_model_element_count")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), intent(inout) :: count
            integer(c_int32_t) :: pdn_model_element_count
        end function pdn_model_element_count

        ! Total mass and centre of mass in the reference configuration
        function pdn_model_mass(model, mass, centre) bind(C, name="pdn_model_mass")
            import
            type(c_ptr), value :: model
            real(c_double), intent(inout) :: mass
            real(c_double), intent(inout), optional :: centre(*)
            integer(c_int32_t) :: pdn_model_mass
        end function pdn_model_mass

        ! Frame of a node in the reference configuration
        function pdn_model_node_frame(model, node, frame) bind(C, name="pdn_model_node_frame")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: node
            type(pdn_frame), intent(inout) :: frame
            integer(c_int32_t) :: pdn_model_node_frame
        end function pdn_model_node_frame

        ! Adds a node: a frame that moves
        function pdn_model_add_node(model, position, rotation, &
            node) bind(C, name="pdn_model_add_node")
            import
            type(c_ptr), value :: model
            real(c_double), intent(in) :: position(*)
            real(c_double), intent(in), optional :: rotation(*)
            integer(c_int32_t), intent(inout) :: node
            integer(c_int32_t) :: pdn_model_add_node
        end function pdn_model_add_node

        ! Adds a rigid body: a node at its centre of mass, with axes parallel to the global ones
        function pdn_model_add_rigid_body(model, mass, centre, inertia, &
            node) bind(C, name="pdn_model_add_rigid_body")
            import
            type(c_ptr), value :: model
            real(c_double), value :: mass
            real(c_double), intent(in) :: centre(*)
            real(c_double), intent(in) :: inertia(*)
            integer(c_int32_t), intent(inout) :: node
            integer(c_int32_t) :: pdn_model_add_rigid_body
        end function pdn_model_add_rigid_body

        ! Fixes a mass to a node, in addition to what the node has
        function pdn_model_add_mass(model, node, mass, centre, inertia, &
            id) bind(C, name="pdn_model_add_mass")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: node
            real(c_double), value :: mass
            real(c_double), intent(in) :: centre(*)
            real(c_double), intent(in), optional :: inertia(*)
            integer(c_int32_t), intent(inout), optional :: id
            integer(c_int32_t) :: pdn_model_add_mass
        end function pdn_model_add_mass

        ! Fixes an inertia of any kind to a node, in addition to what the node has
        function pdn_model_add_inertia(model, node, frame, matrix, &
            id) bind(C, name="pdn_model_add_inertia")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: node
            type(pdn_frame), intent(in), optional :: frame
            real(c_double), intent(in) :: matrix(*)
            integer(c_int32_t), intent(inout), optional :: id
            integer(c_int32_t) :: pdn_model_add_inertia
        end function pdn_model_add_inertia

        ! Makes a joint coordinate follow a signal
        function pdn_model_prescribe(model, joint, coordinate, signal, &
            prescribed) bind(C, name="pdn_model_prescribe")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: joint
            integer(c_int32_t), value :: coordinate
            type(pdn_signal), intent(in) :: signal
            integer(c_int32_t), intent(inout), optional :: prescribed
            integer(c_int32_t) :: pdn_model_prescribe
        end function pdn_model_prescribe

        ! Fixes two bodies to each other
        function pdn_model_add_rigid_joint(model, first, second, point, &
            joint) bind(C, name="pdn_model_add_rigid_joint")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: first
            integer(c_int32_t), value :: second
            real(c_double), intent(in) :: point(*)
            integer(c_int32_t), intent(inout), optional :: joint
            integer(c_int32_t) :: pdn_model_add_rigid_joint
        end function pdn_model_add_rigid_joint

        ! Joins two bodies by a hinge
        function pdn_model_add_revolute(model, first, second, point, axis, &
            joint) bind(C, name="pdn_model_add_revolute")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: first
            integer(c_int32_t), value :: second
            real(c_double), intent(in) :: point(*)
            real(c_double), intent(in) :: axis(*)
            integer(c_int32_t), intent(inout), optional :: joint
            integer(c_int32_t) :: pdn_model_add_revolute
        end function pdn_model_add_revolute

        ! Joins two bodies by a slider
        function pdn_model_add_prismatic(model, first, second, point, axis, &
            joint) bind(C, name="pdn_model_add_prismatic")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: first
            integer(c_int32_t), value :: second
            real(c_double), intent(in) :: point(*)
            real(c_double), intent(in) :: axis(*)
            integer(c_int32_t), intent(inout), optional :: joint
            integer(c_int32_t) :: pdn_model_add_prismatic
        end function pdn_model_add_prismatic

        ! Joins two bodies by a shaft in a sleeve: one slides along the axis and turns about it
        function pdn_model_add_cylindrical(model, first, second, point, axis, &
            joint) bind(C, name="pdn_model_add_cylindrical")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: first
            integer(c_int32_t), value :: second
            real(c_double), intent(in) :: point(*)
            real(c_double), intent(in) :: axis(*)
            integer(c_int32_t), intent(inout), optional :: joint
            integer(c_int32_t) :: pdn_model_add_cylindrical
        end function pdn_model_add_cylindrical

        ! Joins two bodies by a screw: the second advances along the axis as it turns about it
        function pdn_model_add_screw(model, first, second, point, axis, pitch, &
            joint) bind(C, name="pdn_model_add_screw")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: first
            integer(c_int32_t), value :: second
            real(c_double), intent(in) :: point(*)
            real(c_double), intent(in) :: axis(*)
            real(c_double), value :: pitch
            integer(c_int32_t), intent(inout), optional :: joint
            integer(c_int32_t) :: pdn_model_add_screw
        end function pdn_model_add_screw

        ! Joins two bodies by a pair of planes that slide and turn on each other
        function pdn_model_add_planar(model, first, second, point, normal, &
            joint) bind(C, name="pdn_model_add_planar")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: first
            integer(c_int32_t), value :: second
            real(c_double), intent(in) :: point(*)
            real(c_double), intent(in) :: normal(*)
            integer(c_int32_t), intent(inout), optional :: joint
            integer(c_int32_t) :: pdn_model_add_planar
        end function pdn_model_add_planar

        ! Joins two bodies by nothing: a joint that constrains no motion, but has coordinates
        function pdn_model_add_free_joint(model, first, second, point, &
            joint) bind(C, name="pdn_model_add_free_joint")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: first
            integer(c_int32_t), value :: second
            real(c_double), intent(in) :: point(*)
            integer(c_int32_t), intent(inout), optional :: joint
            integer(c_int32_t) :: pdn_model_add_free_joint
        end function pdn_model_add_free_joint

        ! Joins two bodies by a ball
        function pdn_model_add_spherical(model, first, second, point, &
            joint) bind(C, name="pdn_model_add_spherical")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: first
            integer(c_int32_t), value :: second
            real(c_double), intent(in) :: point(*)
            integer(c_int32_t), intent(inout), optional :: joint
            integer(c_int32_t) :: pdn_model_add_spherical
        end function pdn_model_add_spherical

        ! Joins two bodies by a cross (Cardan, Hooke)
        function pdn_model_add_universal(model, first, second, point, first_arm, second_arm, &
            joint) bind(C, name="pdn_model_add_universal")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: first
            integer(c_int32_t), value :: second
            real(c_double), intent(in) :: point(*)
            real(c_double), intent(in) :: first_arm(*)
            real(c_double), intent(in) :: second_arm(*)
            integer(c_int32_t), intent(inout), optional :: joint
            integer(c_int32_t) :: pdn_model_add_universal
        end function pdn_model_add_universal

        ! Adds a strut: the line between a point of each of two bodies
        function pdn_model_add_strut(model, first, second, first_point, second_point, &
            joint) bind(C, name="pdn_model_add_strut")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: first
            integer(c_int32_t), value :: second
            real(c_double), intent(in) :: first_point(*)
            real(c_double), intent(in) :: second_point(*)
            integer(c_int32_t), intent(inout), optional :: joint
            integer(c_int32_t) :: pdn_model_add_strut
        end function pdn_model_add_strut

        ! Joins two bodies by a joint of any kind, between a frame fixed to each
        function pdn_model_add_joint(model, kind, first, second, first_frame, second_frame, &
            joint) bind(C, name="pdn_model_add_joint")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: kind
            integer(c_int32_t), value :: first
            integer(c_int32_t), value :: second
            type(pdn_frame), intent(in) :: first_frame
            type(pdn_frame), intent(in) :: second_frame
            integer(c_int32_t), intent(inout), optional :: joint
            integer(c_int32_t) :: pdn_model_add_joint
        end function pdn_model_add_joint

        ! Joins two bodies by a screw, between a frame fixed to each
        function pdn_model_add_screw_between(model, first, second, first_frame, second_frame, &
            pitch, joint) bind(C, name="pdn_model_add_screw_between")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: first
            integer(c_int32_t), value :: second
            type(pdn_frame), intent(in) :: first_frame
            type(pdn_frame), intent(in) :: second_frame
            real(c_double), value :: pitch
            integer(c_int32_t), intent(inout), optional :: joint
            integer(c_int32_t) :: pdn_model_add_screw_between
        end function pdn_model_add_screw_between

        ! Number of linear relations between joint coordinates; their ids follow each other from
        ! PDN_FIRST_RELATION on
        function pdn_model_relation_count(model, count) bind(C, name="pdn_model_relation_count")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), intent(inout) :: count
            integer(c_int32_t) :: pdn_model_relation_count
        end function pdn_model_relation_count

        ! Adds a linear relation between joint coordinates: gears, belts, racks, differentials
        function pdn_model_add_relation(model, joints, coordinates, coefficients, count, signal, &
            relation) bind(C, name="pdn_model_add_relation")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), intent(in) :: joints(*)
            integer(c_int32_t), intent(in) :: coordinates(*)
            real(c_double), intent(in) :: coefficients(*)
            integer(c_size_t), value :: count
            type(pdn_signal), intent(in), optional :: signal
            integer(c_int32_t), intent(inout), optional :: relation
            integer(c_int32_t) :: pdn_model_add_relation
        end function pdn_model_add_relation

        ! Makes a line that is still to be set
        subroutine pdn_line_init(line, struct_size) bind(C, name="pdn_line_init")
            import
            type(pdn_line), intent(inout) :: line
            integer(c_size_t), value :: struct_size
        end subroutine pdn_line_init

        ! Makes a line straight
        function pdn_line_set_straight(line, start, end, &
            axis_2) bind(C, name="pdn_line_set_straight")
            import
            type(pdn_line), intent(inout) :: line
            real(c_double), intent(in) :: start(*)
            real(c_double), intent(in) :: end(*)
            real(c_double), intent(in) :: axis_2(*)
            integer(c_int32_t) :: pdn_line_set_straight
        end function pdn_line_set_straight

        ! Makes a line the circular arc from start through point to end, of up to a whole turn
        function pdn_line_set_arc(line, start, point, end, &
            axis_2) bind(C, name="pdn_line_set_arc")
            import
            type(pdn_line), intent(inout) :: line
            real(c_double), intent(in) :: start(*)
            real(c_double), intent(in) :: point(*)
            real(c_double), intent(in) :: end(*)
            real(c_double), intent(in) :: axis_2(*)
            integer(c_int32_t) :: pdn_line_set_arc
        end function pdn_line_set_arc

        ! Makes a line a curve that the caller computes
        function pdn_line_set_curve(line, curve, user_data) bind(C, name="pdn_line_set_curve")
            import
            type(pdn_line), intent(inout) :: line
            type(c_funptr), value :: curve
            type(c_ptr), value :: user_data
            integer(c_int32_t) :: pdn_line_set_curve
        end function pdn_line_set_curve

        ! Makes stations that are still to be set
        subroutine pdn_stations_init(stations, struct_size) bind(C, name="pdn_stations_init")
            import
            type(pdn_stations), intent(inout) :: stations
            integer(c_size_t), value :: struct_size
        end subroutine pdn_stations_init

        ! Adds a beam element over nodes that are there; it may be curved and twisted
        function pdn_model_add_beam_element(model, nodes, count, section, &
            element) bind(C, name="pdn_model_add_beam_element")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), intent(in) :: nodes(*)
            integer(c_size_t), value :: count
            type(pdn_section), intent(in) :: section
            integer(c_int32_t), intent(inout) :: element
            integer(c_int32_t) :: pdn_model_add_beam_element
        end function pdn_model_add_beam_element

        ! Adds a straight beam: its nodes and elements
        function pdn_model_add_straight_beam(model, start, end, axis_2, section, elements, &
            degree, beam) bind(C, name="pdn_model_add_straight_beam")
            import
            type(c_ptr), value :: model
            real(c_double), intent(in) :: start(*)
            real(c_double), intent(in) :: end(*)
            real(c_double), intent(in) :: axis_2(*)
            type(pdn_section), intent(in) :: section
            integer(c_size_t), value :: elements
            integer(c_size_t), value :: degree
            type(pdn_beam), intent(inout) :: beam
            integer(c_int32_t) :: pdn_model_add_straight_beam
        end function pdn_model_add_straight_beam

        ! Adds a beam along a line, with sections that may vary: its nodes and elements
        function pdn_model_add_beam(model, line, stations, elements, degree, &
            beam) bind(C, name="pdn_model_add_beam")
            import
            type(c_ptr), value :: model
            type(pdn_line), intent(in) :: line
            type(pdn_stations), intent(in) :: stations
            integer(c_size_t), value :: elements
            integer(c_size_t), value :: degree
            type(pdn_beam), intent(inout) :: beam
            integer(c_int32_t) :: pdn_model_add_beam
        end function pdn_model_add_beam

        ! Adds a beam along a line as ::pdn_model_add_beam does, with elements between given
        ! places
        function pdn_model_add_beam_between(model, line, stations, boundaries, count, degree, &
            beam) bind(C, name="pdn_model_add_beam_between")
            import
            type(c_ptr), value :: model
            type(pdn_line), intent(in) :: line
            type(pdn_stations), intent(in) :: stations
            real(c_double), intent(in) :: boundaries(*)
            integer(c_size_t), value :: count
            integer(c_size_t), value :: degree
            type(pdn_beam), intent(inout) :: beam
            integer(c_int32_t) :: pdn_model_add_beam_between
        end function pdn_model_add_beam_between

        ! Adds one component of a force or moment on a node, in addition to those that are there
        function pdn_model_add_load(model, node, frame, component, signal, &
            load) bind(C, name="pdn_model_add_load")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: node
            integer(c_int32_t), value :: frame
            integer(c_int32_t), value :: component
            type(pdn_signal), intent(in) :: signal
            integer(c_int32_t), intent(inout), optional :: load
            integer(c_int32_t) :: pdn_model_add_load
        end function pdn_model_add_load

        ! Adds one component of a force or moment at a point that a node carries, in addition to
        ! those that are there: such as a thrust that acts off the node of a body
        function pdn_model_add_load_at_point(model, node, offset, frame, component, signal, &
            load) bind(C, name="pdn_model_add_load_at_point")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: node
            real(c_double), intent(in) :: offset(*)
            integer(c_int32_t), value :: frame
            integer(c_int32_t), value :: component
            type(pdn_signal), intent(in) :: signal
            integer(c_int32_t), intent(inout), optional :: load
            integer(c_int32_t) :: pdn_model_add_load_at_point
        end function pdn_model_add_load_at_point

        ! Adds one component of a force or moment at a fraction of the span of a beam, in addition
        ! to those that are there
        function pdn_model_add_load_on_beam(model, first_element, elements, fraction, offset, &
            frame, component, signal, load) bind(C, name="pdn_model_add_load_on_beam")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: first_element
            integer(c_int32_t), value :: elements
            real(c_double), value :: fraction
            real(c_double), intent(in), optional :: offset(*)
            integer(c_int32_t), value :: frame
            integer(c_int32_t), value :: component
            type(pdn_signal), intent(in) :: signal
            integer(c_int32_t), intent(inout), optional :: load
            integer(c_int32_t) :: pdn_model_add_load_on_beam
        end function pdn_model_add_load_on_beam

        ! Sets the acceleration of gravity, in place of any set before
        function pdn_model_set_gravity(model, &
            acceleration) bind(C, name="pdn_model_set_gravity")
            import
            type(c_ptr), value :: model
            real(c_double), intent(in) :: acceleration(*)
            integer(c_int32_t) :: pdn_model_set_gravity
        end function pdn_model_set_gravity

        ! Sets an acceleration of gravity that varies in time, in place of any set before
        function pdn_model_set_gravity_signals(model, acceleration_1, acceleration_2, &
            acceleration_3) bind(C, name="pdn_model_set_gravity_signals")
            import
            type(c_ptr), value :: model
            type(pdn_signal), intent(in), optional :: acceleration_1
            type(pdn_signal), intent(in), optional :: acceleration_2
            type(pdn_signal), intent(in), optional :: acceleration_3
            integer(c_int32_t) :: pdn_model_set_gravity_signals
        end function pdn_model_set_gravity_signals

        ! Adds one component of a force or moment distributed along beam elements, in addition to
        ! those that are there
        function pdn_model_add_distributed_load(model, first_element, elements, frame, &
            component, signal, fractions, factors, count, &
            load) bind(C, name="pdn_model_add_distributed_load")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: first_element
            integer(c_int32_t), value :: elements
            integer(c_int32_t), value :: frame
            integer(c_int32_t), value :: component
            type(pdn_signal), intent(in) :: signal
            real(c_double), intent(in), optional :: fractions(*)
            real(c_double), intent(in), optional :: factors(*)
            integer(c_size_t), value :: count
            integer(c_int32_t), intent(inout), optional :: load
            integer(c_int32_t) :: pdn_model_add_distributed_load
        end function pdn_model_add_distributed_load

        ! Adds a force and moment distributed along beam elements, all components at all places at
        ! once, in addition to those that are there: such as the air loads of a blade, at the
        ! places where these are computed
        function pdn_model_add_load_at_places(model, first_element, elements, frame, axis_2, &
            fractions, signals, count, first_load) bind(C, name="pdn_model_add_load_at_places")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: first_element
            integer(c_int32_t), value :: elements
            integer(c_int32_t), value :: frame
            real(c_double), intent(in), optional :: axis_2(*)
            real(c_double), intent(in) :: fractions(*)
            type(pdn_signal), intent(in) :: signals(*)
            integer(c_size_t), value :: count
            integer(c_int32_t), intent(inout), optional :: first_load
            integer(c_int32_t) :: pdn_model_add_load_at_places
        end function pdn_model_add_load_at_places

        ! Describes everything in a frame that turns about a fixed axis at a constant rate, in
        ! place of any set before: motions that repeat themselves but for a turn in each period
        ! are periodic there
        function pdn_model_set_turning_frame(model, axis, rate, &
            point) bind(C, name="pdn_model_set_turning_frame")
            import
            type(c_ptr), value :: model
            real(c_double), intent(in) :: axis(*)
            real(c_double), value :: rate
            real(c_double), intent(in), optional :: point(*)
            integer(c_int32_t) :: pdn_model_set_turning_frame
        end function pdn_model_set_turning_frame

        ! The frame that a model is described in, if it turns
        function pdn_model_turning_frame(model, axis, rate, &
            point) bind(C, name="pdn_model_turning_frame")
            import
            type(c_ptr), value :: model
            real(c_double), intent(inout) :: axis(*)
            real(c_double), intent(inout) :: rate
            real(c_double), intent(inout) :: point(*)
            integer(c_int32_t) :: pdn_model_turning_frame
        end function pdn_model_turning_frame

        ! Lets the frame that everything is described in advance along its axis at a constant
        ! speed, too: motions that repeat themselves but for a translation in each period, or for
        ! a screw motion, are periodic there
        function pdn_model_set_frame_advance(model, &
            speed) bind(C, name="pdn_model_set_frame_advance")
            import
            type(c_ptr), value :: model
            real(c_double), value :: speed
            integer(c_int32_t) :: pdn_model_set_frame_advance
        end function pdn_model_set_frame_advance

        ! Speed along its axis of the frame that a model is described in
        function pdn_model_frame_advance(model, speed) bind(C, name="pdn_model_frame_advance")
            import
            type(c_ptr), value :: model
            real(c_double), intent(inout) :: speed
            integer(c_int32_t) :: pdn_model_frame_advance
        end function pdn_model_frame_advance

        ! Lets a rigid body, or a mass or inertia on a node, spin at a constant rate relative to
        ! its node, about an axis through its centre of mass which is fixed in the node: a disk, a
        ! rotor, a flywheel with its gyroscopic moments, on a node that does not turn with it
        function pdn_model_set_spin(model, inertia, axis, &
            rate) bind(C, name="pdn_model_set_spin")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: inertia
            real(c_double), intent(in) :: axis(*)
            real(c_double), value :: rate
            integer(c_int32_t) :: pdn_model_set_spin
        end function pdn_model_set_spin

        ! How an inertia spins relative to its node, if it does
        function pdn_model_spin(model, inertia, axis, rate) bind(C, name="pdn_model_spin")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: inertia
            real(c_double), intent(inout) :: axis(*)
            real(c_double), intent(inout) :: rate
            integer(c_int32_t) :: pdn_model_spin
        end function pdn_model_spin

        ! Lets the material of beam elements spin about axis 1 of their sections at a constant
        ! rate relative to their nodes, which do not spin along: a shaft that turns, and whirls by
        ! small angles about where it stands, as ::pdn_model_set_spin lets a disk on it
        function pdn_model_set_beam_spin(model, first_element, elements, &
            rate) bind(C, name="pdn_model_set_beam_spin")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: first_element
            integer(c_int32_t), value :: elements
            real(c_double), value :: rate
            integer(c_int32_t) :: pdn_model_set_beam_spin
        end function pdn_model_set_beam_spin

        ! The rate at which the material of a beam element spins relative to its nodes
        function pdn_model_beam_spin(model, element, rate) bind(C, name="pdn_model_beam_spin")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: element
            real(c_double), intent(inout) :: rate
            integer(c_int32_t) :: pdn_model_beam_spin
        end function pdn_model_beam_spin

        ! Says that the blades of a rotor are alike, in place of what was said before: periodic
        ! solves, also under conditions, then solve for one blade, the hub and the supports, and
        ! the others follow
        function pdn_model_set_rotor_symmetry(model, axis, blades, nodes, count, hub, hub_count, &
            point) bind(C, name="pdn_model_set_rotor_symmetry")
            import
            type(c_ptr), value :: model
            real(c_double), intent(in) :: axis(*)
            integer(c_int32_t), value :: blades
            integer(c_int32_t), intent(in) :: nodes(*)
            integer(c_size_t), value :: count
            integer(c_int32_t), intent(in) :: hub(*)
            integer(c_size_t), value :: hub_count
            real(c_double), intent(in), optional :: point(*)
            integer(c_int32_t) :: pdn_model_set_rotor_symmetry
        end function pdn_model_set_rotor_symmetry

        ! The rotor whose blades were said to be alike
        function pdn_model_rotor_symmetry(model, axis, point, blades, nodes_of_blade, &
            hub_nodes) bind(C, name="pdn_model_rotor_symmetry")
            import
            type(c_ptr), value :: model
            real(c_double), intent(inout) :: axis(*)
            real(c_double), intent(inout) :: point(*)
            integer(c_int32_t), intent(inout) :: blades
            integer(c_int32_t), intent(inout) :: nodes_of_blade
            integer(c_int32_t), intent(inout) :: hub_nodes
            integer(c_int32_t) :: pdn_model_rotor_symmetry
        end function pdn_model_rotor_symmetry

        ! A node of a rotor whose blades were said to be alike
        function pdn_model_rotor_node(model, blade, index, &
            node) bind(C, name="pdn_model_rotor_node")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: blade
            integer(c_int32_t), value :: index
            integer(c_int32_t), intent(inout) :: node
            integer(c_int32_t) :: pdn_model_rotor_node
        end function pdn_model_rotor_node

        ! Makes a surface that is still to be set
        subroutine pdn_surface_init(surface, struct_size) bind(C, name="pdn_surface_init")
            import
            type(pdn_surface), intent(inout) :: surface
            integer(c_size_t), value :: struct_size
        end subroutine pdn_surface_init

        ! Makes a surface a parallelogram, such as a rectangle
        function pdn_surface_set_parallelogram(surface, corner, along_u, &
            along_v) bind(C, name="pdn_surface_set_parallelogram")
            import
            type(pdn_surface), intent(inout) :: surface
            real(c_double), intent(in) :: corner(*)
            real(c_double), intent(in) :: along_u(*)
            real(c_double), intent(in) :: along_v(*)
            integer(c_int32_t) :: pdn_surface_set_parallelogram
        end function pdn_surface_set_parallelogram

        ! Makes a surface an annulus or a sector of one: u from the inner to the outer radius, v
        ! around the axis
        function pdn_surface_set_annulus(surface, centre, axis, start, inner, outer, &
            angle) bind(C, name="pdn_surface_set_annulus")
            import
            type(pdn_surface), intent(inout) :: surface
            real(c_double), intent(in) :: centre(*)
            real(c_double), intent(in) :: axis(*)
            real(c_double), intent(in) :: start(*)
            real(c_double), value :: inner
            real(c_double), value :: outer
            real(c_double), value :: angle
            integer(c_int32_t) :: pdn_surface_set_annulus
        end function pdn_surface_set_annulus

        ! Makes a surface a cylinder or a sector of one: u around the axis, v along it
        function pdn_surface_set_cylinder(surface, centre, axis, start, radius, length, &
            angle) bind(C, name="pdn_surface_set_cylinder")
            import
            type(pdn_surface), intent(inout) :: surface
            real(c_double), intent(in) :: centre(*)
            real(c_double), intent(in) :: axis(*)
            real(c_double), intent(in) :: start(*)
            real(c_double), value :: radius
            real(c_double), value :: length
            real(c_double), value :: angle
            integer(c_int32_t) :: pdn_surface_set_cylinder
        end function pdn_surface_set_cylinder

        ! Makes a surface one that the caller computes, smooth within each element
        function pdn_surface_set_function(surface, function, &
            user_data) bind(C, name="pdn_surface_set_function")
            import
            type(pdn_surface), intent(inout) :: surface
            type(c_funptr), value :: function
            type(c_ptr), value :: user_data
            integer(c_int32_t) :: pdn_surface_set_function
        end function pdn_surface_set_function

        ! Makes a section with no stiffness, mass or damping
        subroutine pdn_shell_section_init(section, &
            struct_size) bind(C, name="pdn_shell_section_init")
            import
            type(pdn_shell_section), intent(inout) :: section
            integer(c_size_t), value :: struct_size
        end subroutine pdn_shell_section_init

        ! Makes a section that of one isotropic, linearly elastic material
        function pdn_shell_section_set_isotropic(section, thickness, young, poisson, density, &
            drilling, drilling_gradient) bind(C, name="pdn_shell_section_set_isotropic")
            import
            type(pdn_shell_section), intent(inout) :: section
            real(c_double), value :: thickness
            real(c_double), value :: young
            real(c_double), value :: poisson
            real(c_double), value :: density
            real(c_double), value :: drilling
            real(c_double), value :: drilling_gradient
            integer(c_int32_t) :: pdn_shell_section_set_isotropic
        end function pdn_shell_section_set_isotropic

        ! Gives a section damping in proportion to its stiffness, which must have been set
        function pdn_shell_section_set_proportional_damping(section, &
            seconds) bind(C, name="pdn_shell_section_set_proportional_damping")
            import
            type(pdn_shell_section), intent(inout) :: section
            real(c_double), value :: seconds
            integer(c_int32_t) :: pdn_shell_section_set_proportional_damping
        end function pdn_shell_section_set_proportional_damping

        ! Sets the defaults
        subroutine pdn_shell_placement_init(placement, &
            struct_size) bind(C, name="pdn_shell_placement_init")
            import
            type(pdn_shell_placement), intent(inout) :: placement
            integer(c_size_t), value :: struct_size
        end subroutine pdn_shell_placement_init

        ! Adds a shell element over a grid of nodes that are there
        function pdn_model_add_shell_element(model, nodes, count, n_xi, section, placement, &
            element) bind(C, name="pdn_model_add_shell_element")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), intent(in) :: nodes(*)
            integer(c_size_t), value :: count
            integer(c_size_t), value :: n_xi
            type(pdn_shell_section), intent(in) :: section
            type(pdn_shell_placement), intent(in), optional :: placement
            integer(c_int32_t), intent(inout) :: element
            integer(c_int32_t) :: pdn_model_add_shell_element
        end function pdn_model_add_shell_element

        ! Adds a shell over a surface, with elements in equal parts of u and v: its nodes and
        ! elements
        function pdn_model_add_shell(model, surface, elements_u, elements_v, degree_u, degree_v, &
            join, section, placement, shell) bind(C, name="pdn_model_add_shell")
            import
            type(c_ptr), value :: model
            type(pdn_surface), intent(in) :: surface
            integer(c_size_t), value :: elements_u
            integer(c_size_t), value :: elements_v
            integer(c_size_t), value :: degree_u
            integer(c_size_t), value :: degree_v
            integer(c_int32_t), value :: join
            type(pdn_shell_section), intent(in) :: section
            type(pdn_shell_placement), intent(in), optional :: placement
            type(pdn_shell), intent(inout) :: shell
            integer(c_int32_t) :: pdn_model_add_shell
        end function pdn_model_add_shell

        ! Adds a shell over given positions of its nodes, as ::pdn_model_add_shell does over a
        ! surface
        function pdn_model_add_shell_grid(model, points, count, elements_u, elements_v, &
            degree_u, degree_v, join, section, placement, &
            shell) bind(C, name="pdn_model_add_shell_grid")
            import
            type(c_ptr), value :: model
            real(c_double), intent(in) :: points(*)
            integer(c_size_t), value :: count
            integer(c_size_t), value :: elements_u
            integer(c_size_t), value :: elements_v
            integer(c_size_t), value :: degree_u
            integer(c_size_t), value :: degree_v
            integer(c_int32_t), value :: join
            type(pdn_shell_section), intent(in) :: section
            type(pdn_shell_placement), intent(in), optional :: placement
            type(pdn_shell), intent(inout) :: shell
            integer(c_int32_t) :: pdn_model_add_shell_grid
        end function pdn_model_add_shell_grid

        ! Adds a shell element for each cell of a mesh of quadrilaterals, as mesh generators make
        ! them
        function pdn_model_add_shell_quadrilaterals(model, points, point_count, cells, count, &
            points_of_cell, degree, section, placement, &
            first_element) bind(C, name="pdn_model_add_shell_quadrilaterals")
            import
            type(c_ptr), value :: model
            real(c_double), intent(in) :: points(*)
            integer(c_size_t), value :: point_count
            integer(c_int32_t), intent(in) :: cells(*)
            integer(c_size_t), value :: count
            integer(c_size_t), value :: points_of_cell
            integer(c_size_t), value :: degree
            type(pdn_shell_section), intent(in) :: section
            type(pdn_shell_placement), intent(in), optional :: placement
            integer(c_int32_t), intent(inout) :: first_element
            integer(c_int32_t) :: pdn_model_add_shell_quadrilaterals
        end function pdn_model_add_shell_quadrilaterals

        ! Node of a shell over a surface or a grid
        function pdn_model_shell_patch_node(model, shell, u, v, &
            node) bind(C, name="pdn_model_shell_patch_node")
            import
            type(c_ptr), value :: model
            type(pdn_shell), intent(in) :: shell
            integer(c_int32_t), value :: u
            integer(c_int32_t), value :: v
            integer(c_int32_t), intent(inout) :: node
            integer(c_int32_t) :: pdn_model_shell_patch_node
        end function pdn_model_shell_patch_node

        ! Number of shell elements; their ids follow each other from PDN_FIRST_SHELL_ELEMENT on
        function pdn_model_shell_element_count(model, &
            count) bind(C, name="pdn_model_shell_element_count")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), intent(inout) :: count
            integer(c_int32_t) :: pdn_model_shell_element_count
        end function pdn_model_shell_element_count

        ! Node of a shell element
        function pdn_model_shell_node(model, element, xi, eta, &
            node) bind(C, name="pdn_model_shell_node")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: element
            integer(c_int32_t), value :: xi
            integer(c_int32_t), value :: eta
            integer(c_int32_t), intent(inout) :: node
            integer(c_int32_t) :: pdn_model_shell_node
        end function pdn_model_shell_node

        ! Adds one component of a force or moment on shell elements, in addition to those that are
        ! there: for each unit of reference area, or of reference length of an edge
        function pdn_model_add_shell_load(model, first_element, elements, place, frame, &
            component, signal, load) bind(C, name="pdn_model_add_shell_load")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: first_element
            integer(c_int32_t), value :: elements
            integer(c_int32_t), value :: place
            integer(c_int32_t), value :: frame
            integer(c_int32_t), value :: component
            type(pdn_signal), intent(in) :: signal
            integer(c_int32_t), intent(inout), optional :: load
            integer(c_int32_t) :: pdn_model_add_shell_load
        end function pdn_model_add_shell_load

        ! Gives shell elements forces and moments where nothing is strained: initial stress, in
        ! place of any before
        function pdn_model_set_shell_prestress(model, first_element, elements, &
            resultants) bind(C, name="pdn_model_set_shell_prestress")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: first_element
            integer(c_int32_t), value :: elements
            real(c_double), intent(in) :: resultants(*)
            integer(c_int32_t) :: pdn_model_set_shell_prestress
        end function pdn_model_set_shell_prestress

        ! Fixes nodes to a body, by a rigid joint each as ::pdn_model_add_rigid_joint makes: such
        ! as the nodes along an edge of a shell, which then moves as a part of the body
        function pdn_model_add_rigid_joints(model, body, nodes, count, first_joint, &
            joints) bind(C, name="pdn_model_add_rigid_joints")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: body
            integer(c_int32_t), intent(in) :: nodes(*)
            integer(c_size_t), value :: count
            integer(c_int32_t), intent(inout) :: first_joint
            integer(c_int32_t), intent(inout) :: joints
            integer(c_int32_t) :: pdn_model_add_rigid_joints
        end function pdn_model_add_rigid_joints

        ! Fixes a whole edge of a shell over a surface or a grid to a body:
        ! ::pdn_model_add_rigid_joints with the nodes along it
        function pdn_model_add_rigid_edge(model, body, shell, edge, first_joint, &
            joints) bind(C, name="pdn_model_add_rigid_edge")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: body
            type(pdn_shell), intent(in) :: shell
            integer(c_int32_t), value :: edge
            integer(c_int32_t), intent(inout) :: first_joint
            integer(c_int32_t), intent(inout) :: joints
            integer(c_int32_t) :: pdn_model_add_rigid_edge
        end function pdn_model_add_rigid_edge

        ! Number of forces: springs, dampers, actuators and the like, but not loads; their ids
        ! follow each other from PDN_FIRST_FORCE on
        function pdn_model_force_count(model, count) bind(C, name="pdn_model_force_count")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), intent(inout) :: count
            integer(c_int32_t) :: pdn_model_force_count
        end function pdn_model_force_count

        ! Adds a linear spring with a damper on a joint coordinate, in addition to those that are
        ! there
        function pdn_model_add_spring_damper(model, joint, coordinate, stiffness, damping, rest, &
            force) bind(C, name="pdn_model_add_spring_damper")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: joint
            integer(c_int32_t), value :: coordinate
            real(c_double), value :: stiffness
            real(c_double), value :: damping
            real(c_double), value :: rest
            integer(c_int32_t), intent(inout), optional :: force
            integer(c_int32_t) :: pdn_model_add_spring_damper
        end function pdn_model_add_spring_damper

        ! Adds a nonlinear spring with a damper on a joint coordinate: polynomials of the
        ! coordinate and its rate
        function pdn_model_add_nonlinear_spring_damper(model, joint, coordinate, stiffness, &
            stiffness_count, damping, damping_count, rest, &
            force) bind(C, name="pdn_model_add_nonlinear_spring_damper")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: joint
            integer(c_int32_t), value :: coordinate
            real(c_double), intent(in), optional :: stiffness(*)
            integer(c_size_t), value :: stiffness_count
            real(c_double), intent(in), optional :: damping(*)
            integer(c_size_t), value :: damping_count
            real(c_double), value :: rest
            integer(c_int32_t), intent(inout), optional :: force
            integer(c_int32_t) :: pdn_model_add_nonlinear_spring_damper
        end function pdn_model_add_nonlinear_spring_damper

        ! Adds an actuator: a force on a displacement, or a torque on an angle, that follows a
        ! signal
        function pdn_model_add_actuator(model, joint, coordinate, signal, &
            force) bind(C, name="pdn_model_add_actuator")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: joint
            integer(c_int32_t), value :: coordinate
            type(pdn_signal), intent(in) :: signal
            integer(c_int32_t), intent(inout), optional :: force
            integer(c_int32_t) :: pdn_model_add_actuator
        end function pdn_model_add_actuator

        ! Adds a viscoelastic element on a joint coordinate: a generalised Maxwell model
        function pdn_model_add_viscoelastic(model, joint, coordinate, stiffness, rest, &
            branch_stiffness, relaxation_times, branches, &
            force) bind(C, name="pdn_model_add_viscoelastic")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: joint
            integer(c_int32_t), value :: coordinate
            real(c_double), value :: stiffness
            real(c_double), value :: rest
            real(c_double), intent(in) :: branch_stiffness(*)
            real(c_double), intent(in) :: relaxation_times(*)
            integer(c_size_t), value :: branches
            integer(c_int32_t), intent(inout), optional :: force
            integer(c_int32_t) :: pdn_model_add_viscoelastic
        end function pdn_model_add_viscoelastic

        ! Adds a viscous damper between two bodies, with a full matrix of coefficients
        function pdn_model_add_viscous_damper(model, first, second, frame, matrix, &
            force) bind(C, name="pdn_model_add_viscous_damper")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: first
            integer(c_int32_t), value :: second
            type(pdn_frame), intent(in), optional :: frame
            real(c_double), intent(in) :: matrix(*)
            integer(c_int32_t), intent(inout), optional :: force
            integer(c_int32_t) :: pdn_model_add_viscous_damper
        end function pdn_model_add_viscous_damper

        ! Adds a bushing, a bearing or a seal: any matrices of stiffness and damping between two
        ! frames, unsymmetric ones included
        function pdn_model_add_bushing(model, first, second, first_frame, second_frame, &
            stiffness, damping, angles, force) bind(C, name="pdn_model_add_bushing")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: first
            integer(c_int32_t), value :: second
            type(pdn_frame), intent(in) :: first_frame
            type(pdn_frame), intent(in) :: second_frame
            real(c_double), intent(in) :: stiffness(*)
            real(c_double), intent(in) :: damping(*)
            integer(c_int32_t), value :: angles
            integer(c_int32_t), intent(inout), optional :: force
            integer(c_int32_t) :: pdn_model_add_bushing
        end function pdn_model_add_bushing

        ! Adds a spring-damper on a joint coordinate whose law is a function of the caller
        function pdn_model_add_coordinate_law(model, joint, coordinate, tangents, function, &
            user_data, destroy, force) bind(C, name="pdn_model_add_coordinate_law")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: joint
            integer(c_int32_t), value :: coordinate
            integer(c_int32_t), value :: tangents
            type(c_funptr), value :: function
            type(c_ptr), value :: user_data
            type(c_funptr), value :: destroy
            integer(c_int32_t), intent(inout), optional :: force
            integer(c_int32_t) :: pdn_model_add_coordinate_law
        end function pdn_model_add_coordinate_law

        ! Adds forces on nodes that a function of the caller computes
        function pdn_model_add_user_force(model, nodes, count, frame, tangents, function, &
            user_data, destroy, force) bind(C, name="pdn_model_add_user_force")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), intent(in) :: nodes(*)
            integer(c_size_t), value :: count
            integer(c_int32_t), value :: frame
            integer(c_int32_t), value :: tangents
            type(c_funptr), value :: function
            type(c_ptr), value :: user_data
            type(c_funptr), value :: destroy
            integer(c_int32_t), intent(inout), optional :: force
            integer(c_int32_t) :: pdn_model_add_user_force
        end function pdn_model_add_user_force

        ! Declares that the force on each node of a function's force depends on time and on the
        ! motion of this node alone, as that of the air on points of a wing by strips does
        function pdn_model_declare_nodes_apart(model, &
            force) bind(C, name="pdn_model_declare_nodes_apart")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: force
            integer(c_int32_t) :: pdn_model_declare_nodes_apart
        end function pdn_model_declare_nodes_apart

        ! Prepares a struct for ::pdn_model_check_tangents; use `PDN_INIT(pdn_tangent_check,
        ! &check)`
        subroutine pdn_tangent_check_init(check, &
            struct_size) bind(C, name="pdn_tangent_check_init")
            import
            type(pdn_tangent_check), intent(inout) :: check
            integer(c_size_t), value :: struct_size
        end subroutine pdn_tangent_check_init

        ! Compares the tangents that a user's function gives with differences of its forces
        function pdn_model_check_tangents(model, force, period, &
            check) bind(C, name="pdn_model_check_tangents")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: force
            real(c_double), value :: period
            type(pdn_tangent_check), intent(inout) :: check
            integer(c_int32_t) :: pdn_model_check_tangents
        end function pdn_model_check_tangents

        ! Adds a controller: efforts on joint coordinates by a function of the caller that reads
        ! any joint coordinates and their rates, and may have states of its own
        function pdn_model_add_controller(model, input_joints, input_coordinates, input_count, &
            output_joints, output_coordinates, output_count, initial, sizes, state_count, &
            tangents, function, user_data, destroy, &
            force) bind(C, name="pdn_model_add_controller")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), intent(in), optional :: input_joints(*)
            integer(c_int32_t), intent(in), optional :: input_coordinates(*)
            integer(c_size_t), value :: input_count
            integer(c_int32_t), intent(in) :: output_joints(*)
            integer(c_int32_t), intent(in) :: output_coordinates(*)
            integer(c_size_t), value :: output_count
            real(c_double), intent(in), optional :: initial(*)
            real(c_double), intent(in), optional :: sizes(*)
            integer(c_size_t), value :: state_count
            integer(c_int32_t), value :: tangents
            type(c_funptr), value :: function
            type(c_ptr), value :: user_data
            type(c_funptr), value :: destroy
            integer(c_int32_t), intent(inout), optional :: force
            integer(c_int32_t) :: pdn_model_add_controller
        end function pdn_model_add_controller

        ! Numbers of the coordinates that a controller reads, of those that it acts on, and of its
        ! states
        function pdn_model_controller_counts(model, force, input_count, output_count, &
            state_count) bind(C, name="pdn_model_controller_counts")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: force
            integer(c_int32_t), intent(inout), optional :: input_count
            integer(c_int32_t), intent(inout), optional :: output_count
            integer(c_int32_t), intent(inout), optional :: state_count
            integer(c_int32_t) :: pdn_model_controller_counts
        end function pdn_model_controller_counts

        ! A coordinate that a controller reads or acts on
        function pdn_model_controller_coordinate(model, force, index, joint, &
            coordinate) bind(C, name="pdn_model_controller_coordinate")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: force
            integer(c_int32_t), value :: index
            integer(c_int32_t), intent(inout) :: joint
            integer(c_int32_t), intent(inout) :: coordinate
            integer(c_int32_t) :: pdn_model_controller_coordinate
        end function pdn_model_controller_coordinate

        ! A state of a controller
        function pdn_model_controller_state(model, force, index, initial, &
            size) bind(C, name="pdn_model_controller_state")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: force
            integer(c_int32_t), value :: index
            real(c_double), intent(inout), optional :: initial
            real(c_double), intent(inout), optional :: size
            integer(c_int32_t) :: pdn_model_controller_state
        end function pdn_model_controller_state

        ! Adds forces on shell elements that a function of the caller computes at the points of a
        ! quadrature: a force, with an id of its own, for each element
        function pdn_model_add_surface_force(model, first_element, elements, place, frame, &
            tangents, function, user_data, destroy, &
            first_force) bind(C, name="pdn_model_add_surface_force")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: first_element
            integer(c_int32_t), value :: elements
            integer(c_int32_t), value :: place
            integer(c_int32_t), value :: frame
            integer(c_int32_t), value :: tangents
            type(c_funptr), value :: function
            type(c_ptr), value :: user_data
            type(c_funptr), value :: destroy
            integer(c_int32_t), intent(inout), optional :: first_force
            integer(c_int32_t) :: pdn_model_add_surface_force
        end function pdn_model_add_surface_force

        ! Adds forces along beam elements that a function of the caller computes at the points of
        ! a quadrature, such as those of the air on a blade: a force, with an id of its own, for
        ! each element
        function pdn_model_add_line_force(model, first_element, elements, frame, axis_2, &
            tangents, function, user_data, destroy, &
            first_force) bind(C, name="pdn_model_add_line_force")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: first_element
            integer(c_int32_t), value :: elements
            integer(c_int32_t), value :: frame
            real(c_double), intent(in), optional :: axis_2(*)
            integer(c_int32_t), value :: tangents
            type(c_funptr), value :: function
            type(c_ptr), value :: user_data
            type(c_funptr), value :: destroy
            integer(c_int32_t), intent(inout), optional :: first_force
            integer(c_int32_t) :: pdn_model_add_line_force
        end function pdn_model_add_line_force

        ! Gives a controller its function, or another one: that of a model from a file is not
        ! there
        function pdn_model_bind_controller(model, force, tangents, function, user_data, &
            destroy) bind(C, name="pdn_model_bind_controller")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: force
            integer(c_int32_t), value :: tangents
            type(c_funptr), value :: function
            type(c_ptr), value :: user_data
            type(c_funptr), value :: destroy
            integer(c_int32_t) :: pdn_model_bind_controller
        end function pdn_model_bind_controller

        ! Gives a coordinate law its function, or another one: that of a model from a file is not
        ! there
        function pdn_model_bind_coordinate_law(model, force, tangents, function, user_data, &
            destroy) bind(C, name="pdn_model_bind_coordinate_law")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: force
            integer(c_int32_t), value :: tangents
            type(c_funptr), value :: function
            type(c_ptr), value :: user_data
            type(c_funptr), value :: destroy
            integer(c_int32_t) :: pdn_model_bind_coordinate_law
        end function pdn_model_bind_coordinate_law

        ! Gives forces on nodes their function, or another one: that of a model from a file is not
        ! there
        function pdn_model_bind_user_force(model, force, frame, tangents, function, user_data, &
            destroy) bind(C, name="pdn_model_bind_user_force")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: force
            integer(c_int32_t), value :: frame
            integer(c_int32_t), value :: tangents
            type(c_funptr), value :: function
            type(c_ptr), value :: user_data
            type(c_funptr), value :: destroy
            integer(c_int32_t) :: pdn_model_bind_user_force
        end function pdn_model_bind_user_force

        ! Gives forces on shell or beam elements their function, or another one: that of a model
        ! from a file is not there
        function pdn_model_bind_surface_force(model, first_force, forces, frame, tangents, &
            function, user_data, destroy) bind(C, name="pdn_model_bind_surface_force")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: first_force
            integer(c_int32_t), value :: forces
            integer(c_int32_t), value :: frame
            integer(c_int32_t), value :: tangents
            type(c_funptr), value :: function
            type(c_ptr), value :: user_data
            type(c_funptr), value :: destroy
            integer(c_int32_t) :: pdn_model_bind_surface_force
        end function pdn_model_bind_surface_force

        ! Gives what follows a signal another one: a load, an actuator, a prescribed coordinate
        function pdn_model_set_signal(model, id, component, &
            signal) bind(C, name="pdn_model_set_signal")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: id
            integer(c_int32_t), value :: component
            type(pdn_signal), intent(in) :: signal
            integer(c_int32_t) :: pdn_model_set_signal
        end function pdn_model_set_signal

        ! Gives a force other numbers of a sort, as many as it has: those that
        ! ::pdn_model_force_number tells
        function pdn_model_set_force_numbers(model, force, number, values, &
            count) bind(C, name="pdn_model_set_force_numbers")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: force
            integer(c_int32_t), value :: number
            real(c_double), intent(in) :: values(*)
            integer(c_size_t), value :: count
            integer(c_int32_t) :: pdn_model_set_force_numbers
        end function pdn_model_set_force_numbers

        ! Gives a load, on a node, at a point, along beam elements or on shell elements, another
        ! frame; its signals stay
        function pdn_model_set_load_frame(model, load, frame, &
            axis_2) bind(C, name="pdn_model_set_load_frame")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: load
            integer(c_int32_t), value :: frame
            real(c_double), intent(in), optional :: axis_2(*)
            integer(c_int32_t) :: pdn_model_set_load_frame
        end function pdn_model_set_load_frame

        ! Gives beam elements another section, the same all along them; their twist stays, and so
        ! do the factors of parameters
        function pdn_model_set_beam_section(model, first_element, elements, &
            section) bind(C, name="pdn_model_set_beam_section")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: first_element
            integer(c_int32_t), value :: elements
            type(pdn_section), intent(in) :: section
            integer(c_int32_t) :: pdn_model_set_beam_section
        end function pdn_model_set_beam_section

        ! Gives shell elements another section; frames, offset and the direction of its axes stay,
        ! and so do the factors of parameters
        function pdn_model_set_shell_section(model, first_element, elements, &
            section) bind(C, name="pdn_model_set_shell_section")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: first_element
            integer(c_int32_t), value :: elements
            type(pdn_shell_section), intent(in) :: section
            integer(c_int32_t) :: pdn_model_set_shell_section
        end function pdn_model_set_shell_section

        ! Gives a rigid body, or a mass or inertia on a node, another inertia; the factor of a
        ! parameter stays
        function pdn_model_set_inertia(model, inertia, &
            matrix) bind(C, name="pdn_model_set_inertia")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: inertia
            real(c_double), intent(in) :: matrix(*)
            integer(c_int32_t) :: pdn_model_set_inertia
        end function pdn_model_set_inertia

        ! Gives a node, joint, element, force, load or the like a label, in place of the one that
        ! it has
        function pdn_model_set_label(model, id, label) bind(C, name="pdn_model_set_label")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: id
            character(kind=c_char), intent(in), optional :: label(*)
            integer(c_int32_t) :: pdn_model_set_label
        end function pdn_model_set_label

        ! The label of a node, joint, element, force, load or the like
        function pdn_model_label(model, id, buffer, capacity) bind(C, name="pdn_model_label")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: id
            character(kind=c_char), intent(inout), optional :: buffer(*)
            integer(c_size_t), value :: capacity
            integer(c_size_t) :: pdn_model_label
        end function pdn_model_label

        ! The node, joint, element, force, load or the like that has a label
        function pdn_model_find_label(model, kind, label, &
            id) bind(C, name="pdn_model_find_label")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: kind
            character(kind=c_char), intent(in) :: label(*)
            integer(c_int32_t), intent(inout) :: id
            integer(c_int32_t) :: pdn_model_find_label
        end function pdn_model_find_label

        ! Frees a solution; NULL does nothing
        subroutine pdn_solution_free(solution) bind(C, name="pdn_solution_free")
            import
            type(c_ptr), value :: solution
        end subroutine pdn_solution_free

        ! How the solve ended
        function pdn_solution_outcome(solution) bind(C, name="pdn_solution_outcome")
            import
            type(c_ptr), value :: solution
            integer(c_int32_t) :: pdn_solution_outcome
        end function pdn_solution_outcome

        ! A readable report: outcome and why, iterations, error estimates, time spent
        function pdn_solution_report(solution, buffer, &
            capacity) bind(C, name="pdn_solution_report")
            import
            type(c_ptr), value :: solution
            character(kind=c_char), intent(inout), optional :: buffer(*)
            integer(c_size_t), value :: capacity
            integer(c_size_t) :: pdn_solution_report
        end function pdn_solution_report

        ! The report as JSON, for programs: an object with the texts `kind`, `outcome`,
        ! `explanation` and `report`; sizes; `grids` and `attempts`; the Newton `iterations`;
        ! `estimates`, named as in pdn_diagnostics; what iteration of `linear` equations took; and
        ! `seconds`
        function pdn_solution_report_json(solution, buffer, &
            capacity) bind(C, name="pdn_solution_report_json")
            import
            type(c_ptr), value :: solution
            character(kind=c_char), intent(inout), optional :: buffer(*)
            integer(c_size_t), value :: capacity
            integer(c_size_t) :: pdn_solution_report_json
        end function pdn_solution_report_json

        ! Prepares a struct for ::pdn_solution_diagnostics; use `PDN_INIT(pdn_diagnostics,
        ! &diagnostics)`
        subroutine pdn_diagnostics_init(diagnostics, &
            struct_size) bind(C, name="pdn_diagnostics_init")
            import
            type(pdn_diagnostics), intent(inout) :: diagnostics
            integer(c_size_t), value :: struct_size
        end subroutine pdn_diagnostics_init

        ! Figures of a solve: iterations, error estimates, residuals between grid points, time
        ! spent
        function pdn_solution_diagnostics(solution, &
            out) bind(C, name="pdn_solution_diagnostics")
            import
            type(c_ptr), value :: solution
            type(pdn_diagnostics), intent(inout) :: out
            integer(c_int32_t) :: pdn_solution_diagnostics
        end function pdn_solution_diagnostics

        ! History of the Newton iterations of the periodic problem
        function pdn_solution_history(solution, residuals, increments, steps, &
            count) bind(C, name="pdn_solution_history")
            import
            type(c_ptr), value :: solution
            real(c_double), intent(inout), optional :: residuals(*)
            real(c_double), intent(inout), optional :: increments(*)
            real(c_double), intent(inout), optional :: steps(*)
            integer(c_size_t), value :: count
            integer(c_int32_t) :: pdn_solution_history
        end function pdn_solution_history

        ! Decay of the harmonics: largest amplitude of each over all nodes, of positions relative
        ! to the size of the mechanism and of entries of rotation matrices
        function pdn_solution_decay(solution, amplitudes, &
            count) bind(C, name="pdn_solution_decay")
            import
            type(c_ptr), value :: solution
            real(c_double), intent(inout) :: amplitudes(*)
            integer(c_size_t), value :: count
            integer(c_int32_t) :: pdn_solution_decay
        end function pdn_solution_decay

        ! Number of events that the grid points of a solution are closer together about: 0 if they
        ! are equispaced
        function pdn_solution_sharp_event_count(solution, &
            out) bind(C, name="pdn_solution_sharp_event_count")
            import
            type(c_ptr), value :: solution
            integer(c_size_t), intent(inout) :: out
            integer(c_int32_t) :: pdn_solution_sharp_event_count
        end function pdn_solution_sharp_event_count

        ! Events that the grid points of a solution are closer together about, those of
        ! pdn_periodic_options or such as a solve to a tolerance has found
        function pdn_solution_sharp_events(solution, times, widths, shares, &
            count) bind(C, name="pdn_solution_sharp_events")
            import
            type(c_ptr), value :: solution
            real(c_double), intent(inout) :: times(*)
            real(c_double), intent(inout) :: widths(*)
            real(c_double), intent(inout) :: shares(*)
            integer(c_size_t), value :: count
            integer(c_int32_t) :: pdn_solution_sharp_events
        end function pdn_solution_sharp_events

        ! Grid times t_k = k T / N, unless grid points are closer together about events; of a
        ! march the times of its steps, from the start
        function pdn_solution_grid_times(solution, times, &
            count) bind(C, name="pdn_solution_grid_times")
            import
            type(c_ptr), value :: solution
            real(c_double), intent(inout) :: times(*)
            integer(c_size_t), value :: count
            integer(c_int32_t) :: pdn_solution_grid_times
        end function pdn_solution_grid_times

        ! Prepares a struct that tells a quantity; use `PDN_INIT(pdn_quantity, &quantity)`
        subroutine pdn_quantity_init(quantity, struct_size) bind(C, name="pdn_quantity_init")
            import
            type(pdn_quantity), intent(inout) :: quantity
            integer(c_size_t), value :: struct_size
        end subroutine pdn_quantity_init

        ! Number of components that are asked for: of values at a time, of means and of harmonics
        function pdn_quantity_components(quantity) bind(C, name="pdn_quantity_components")
            import
            type(pdn_quantity), intent(in) :: quantity
            integer(c_int32_t) :: pdn_quantity_components
        end function pdn_quantity_components

        ! A quantity of a solution at any times
        function pdn_solution_sample(solution, quantity, times, count, &
            out) bind(C, name="pdn_solution_sample")
            import
            type(c_ptr), value :: solution
            type(pdn_quantity), intent(in) :: quantity
            real(c_double), intent(in) :: times(*)
            integer(c_size_t), value :: count
            real(c_double), intent(inout) :: out(*)
            integer(c_int32_t) :: pdn_solution_sample
        end function pdn_solution_sample

        ! Fourier coefficients of a quantity: mean + rate t + sum of cosines[j] cos jwt + sines[j]
        ! sin jwt
        function pdn_solution_harmonics(solution, quantity, harmonics, mean, rate, cosines, &
            sines) bind(C, name="pdn_solution_harmonics")
            import
            type(c_ptr), value :: solution
            type(pdn_quantity), intent(in) :: quantity
            integer(c_size_t), value :: harmonics
            real(c_double), intent(inout), optional :: mean(*)
            real(c_double), intent(inout), optional :: rate(*)
            real(c_double), intent(inout), optional :: cosines(*)
            real(c_double), intent(inout), optional :: sines(*)
            integer(c_int32_t) :: pdn_solution_harmonics
        end function pdn_solution_harmonics

        ! Smallest and largest values of a quantity, and their times
        function pdn_solution_extremes(solution, quantity, smallest, time_of_smallest, largest, &
            time_of_largest) bind(C, name="pdn_solution_extremes")
            import
            type(c_ptr), value :: solution
            type(pdn_quantity), intent(in) :: quantity
            real(c_double), intent(inout), optional :: smallest(*)
            real(c_double), intent(inout), optional :: time_of_smallest(*)
            real(c_double), intent(inout), optional :: largest(*)
            real(c_double), intent(inout), optional :: time_of_largest(*)
            integer(c_int32_t) :: pdn_solution_extremes
        end function pdn_solution_extremes

        ! Adds the columns of a quantity of a solution, named by the label and the component; or
        ! that of one component, named by the label alone
        function pdn_table_add_quantity(table, solution, quantity, &
            label) bind(C, name="pdn_table_add_quantity")
            import
            type(c_ptr), value :: table
            type(c_ptr), value :: solution
            type(pdn_quantity), intent(in) :: quantity
            character(kind=c_char), intent(in), optional :: label(*)
            integer(c_int32_t) :: pdn_table_add_quantity
        end function pdn_table_add_quantity

        ! A copy of a solution whose quantities are seen through a spectral filter
        function pdn_solution_filtered(solution, filter, order, &
            out) bind(C, name="pdn_solution_filtered")
            import
            type(c_ptr), value :: solution
            integer(c_int32_t), value :: filter
            integer(c_int32_t), value :: order
            type(c_ptr), intent(inout) :: out
            integer(c_int32_t) :: pdn_solution_filtered
        end function pdn_solution_filtered

        ! Sets default options; use `PDN_INIT(pdn_periodic_options, &options)`
        subroutine pdn_periodic_options_init(options, &
            struct_size) bind(C, name="pdn_periodic_options_init")
            import
            type(pdn_periodic_options), intent(inout) :: options
            integer(c_size_t), value :: struct_size
        end subroutine pdn_periodic_options_init

        ! Finds the periodic response of a model directly, by Fourier spectral collocation
        function pdn_solve_periodic(model, period, options, &
            out) bind(C, name="pdn_solve_periodic")
            import
            type(c_ptr), value :: model
            real(c_double), value :: period
            type(pdn_periodic_options), intent(in), optional :: options
            type(c_ptr), intent(inout) :: out
            integer(c_int32_t) :: pdn_solve_periodic
        end function pdn_solve_periodic

        ! Sets default options; use `PDN_INIT(pdn_equations_options, &options)`
        subroutine pdn_equations_options_init(options, &
            struct_size) bind(C, name="pdn_equations_options_init")
            import
            type(pdn_equations_options), intent(inout) :: options
            integer(c_size_t), value :: struct_size
        end subroutine pdn_equations_options_init

        ! Sets `struct_size`; use `PDN_INIT(pdn_equations_sizes, &sizes)`
        subroutine pdn_equations_sizes_init(sizes, &
            struct_size) bind(C, name="pdn_equations_sizes_init")
            import
            type(pdn_equations_sizes), intent(inout) :: sizes
            integer(c_size_t), value :: struct_size
        end subroutine pdn_equations_sizes_init

        ! Makes the equations of a periodic motion on a grid, or a rank's part
        function pdn_equations_new(model, period, options, &
            out) bind(C, name="pdn_equations_new")
            import
            type(c_ptr), value :: model
            real(c_double), value :: period
            type(pdn_equations_options), intent(in) :: options
            type(c_ptr), intent(inout) :: out
            integer(c_int32_t) :: pdn_equations_new
        end function pdn_equations_new

        ! Frees equations; NULL does nothing
        subroutine pdn_equations_free(equations) bind(C, name="pdn_equations_free")
            import
            type(c_ptr), value :: equations
        end subroutine pdn_equations_free

        ! Sizes of the equations, and of the vectors of this rank
        function pdn_equations_get_sizes(equations, out) bind(C, name="pdn_equations_get_sizes")
            import
            type(c_ptr), value :: equations
            type(pdn_equations_sizes), intent(inout) :: out
            integer(c_int32_t) :: pdn_equations_get_sizes
        end function pdn_equations_get_sizes

        ! Nodes of this rank, in the order of its vectors
        function pdn_equations_nodes(equations, out, count) bind(C, name="pdn_equations_nodes")
            import
            type(c_ptr), value :: equations
            integer(c_int32_t), intent(inout) :: out(*)
            integer(c_size_t), value :: count
            integer(c_int32_t) :: pdn_equations_nodes
        end function pdn_equations_nodes

        ! Numbers of this rank's unknowns among those of all ranks: in the order that one rank
        ! alone has them in, from 0
        function pdn_equations_numbers(equations, out, &
            count) bind(C, name="pdn_equations_numbers")
            import
            type(c_ptr), value :: equations
            integer(c_size_t), intent(inout) :: out(*)
            integer(c_size_t), value :: count
            integer(c_int32_t) :: pdn_equations_numbers
        end function pdn_equations_numbers

        ! The present motions of this rank's nodes, and own unknowns of its elements
        function pdn_equations_state(equations, motions, motion_count, own_unknowns, &
            own_count) bind(C, name="pdn_equations_state")
            import
            type(c_ptr), value :: equations
            real(c_double), intent(inout) :: motions(*)
            integer(c_size_t), value :: motion_count
            real(c_double), intent(inout) :: own_unknowns(*)
            integer(c_size_t), value :: own_count
            integer(c_int32_t) :: pdn_equations_state
        end function pdn_equations_state

        ! Sets motions and own unknowns, as ::pdn_equations_state gives them
        function pdn_equations_set_state(equations, motions, motion_count, own_unknowns, &
            own_count) bind(C, name="pdn_equations_set_state")
            import
            type(c_ptr), value :: equations
            real(c_double), intent(in) :: motions(*)
            integer(c_size_t), value :: motion_count
            real(c_double), intent(in) :: own_unknowns(*)
            integer(c_size_t), value :: own_count
            integer(c_int32_t) :: pdn_equations_set_state
        end function pdn_equations_set_state

        ! The scaled residual at the present state
        function pdn_equations_residual(equations, out, &
            count) bind(C, name="pdn_equations_residual")
            import
            type(c_ptr), value :: equations
            real(c_double), intent(inout) :: out(*)
            integer(c_size_t), value :: count
            integer(c_int32_t) :: pdn_equations_residual
        end function pdn_equations_residual

        ! Linearises the equations at the present state, which ::pdn_equations_update then begins
        ! at
        function pdn_equations_linearise(equations) bind(C, name="pdn_equations_linearise")
            import
            type(c_ptr), value :: equations
            integer(c_int32_t) :: pdn_equations_linearise
        end function pdn_equations_linearise

        ! The product of the scaled Jacobian of the last linearisation and a vector
        function pdn_equations_product(equations, x, out, &
            count) bind(C, name="pdn_equations_product")
            import
            type(c_ptr), value :: equations
            real(c_double), intent(in) :: x(*)
            real(c_double), intent(inout) :: out(*)
            integer(c_size_t), value :: count
            integer(c_int32_t) :: pdn_equations_product
        end function pdn_equations_product

        ! The product of the transposed scaled Jacobian and a vector
        function pdn_equations_transposed_product(equations, x, out, &
            count) bind(C, name="pdn_equations_transposed_product")
            import
            type(c_ptr), value :: equations
            real(c_double), intent(in) :: x(*)
            real(c_double), intent(inout) :: out(*)
            integer(c_size_t), value :: count
            integer(c_int32_t) :: pdn_equations_transposed_product
        end function pdn_equations_transposed_product

        ! The product of a vector and what multiplies a power of mu in the scaled Jacobian for
        ! disturbances exp(mu t) times increments of the period: J(mu) = J + mu J1 + mu^2 J2
        function pdn_equations_power_product(equations, power, x, out, &
            count) bind(C, name="pdn_equations_power_product")
            import
            type(c_ptr), value :: equations
            integer(c_int32_t), value :: power
            real(c_double), intent(in) :: x(*)
            real(c_double), intent(inout) :: out(*)
            integer(c_size_t), value :: count
            integer(c_int32_t) :: pdn_equations_power_product
        end function pdn_equations_power_product

        ! Factors the preconditioner of the linearised equations
        function pdn_equations_factor(equations, right_side, count, &
            regular) bind(C, name="pdn_equations_factor")
            import
            type(c_ptr), value :: equations
            real(c_double), intent(in) :: right_side(*)
            integer(c_size_t), value :: count
            integer(c_int32_t), intent(inout) :: regular
            integer(c_int32_t) :: pdn_equations_factor
        end function pdn_equations_factor

        ! The solution of the preconditioner's equations with a right side
        function pdn_equations_precondition(equations, x, out, &
            count) bind(C, name="pdn_equations_precondition")
            import
            type(c_ptr), value :: equations
            real(c_double), intent(in) :: x(*)
            real(c_double), intent(inout) :: out(*)
            integer(c_size_t), value :: count
            integer(c_int32_t) :: pdn_equations_precondition
        end function pdn_equations_precondition

        ! What a scaled increment leaves of the constraints by their compliance in the Jacobian,
        ! where some depend on others
        function pdn_equations_compliance(equations, increment, out, count, &
            compliant) bind(C, name="pdn_equations_compliance")
            import
            type(c_ptr), value :: equations
            real(c_double), intent(in) :: increment(*)
            real(c_double), intent(inout) :: out(*)
            integer(c_size_t), value :: count
            integer(c_int32_t), intent(inout) :: compliant
            integer(c_int32_t) :: pdn_equations_compliance
        end function pdn_equations_compliance

        ! Moves the state that the equations were linearised at last by a fraction of a scaled
        ! increment; the present state is then that
        function pdn_equations_update(equations, increment, count, &
            step) bind(C, name="pdn_equations_update")
            import
            type(c_ptr), value :: equations
            real(c_double), intent(in) :: increment(*)
            integer(c_size_t), value :: count
            real(c_double), value :: step
            integer(c_int32_t) :: pdn_equations_update
        end function pdn_equations_update

        ! Sizes of a scaled increment of all ranks, the same on all
        function pdn_equations_norms(equations, increment, count, motion, &
            own_unknown) bind(C, name="pdn_equations_norms")
            import
            type(c_ptr), value :: equations
            real(c_double), intent(in) :: increment(*)
            integer(c_size_t), value :: count
            real(c_double), intent(inout) :: motion
            real(c_double), intent(inout) :: own_unknown
            integer(c_int32_t) :: pdn_equations_norms
        end function pdn_equations_norms

        ! The present state of all ranks as a solution, for results, files, and what else
        ! solutions are for
        function pdn_equations_solution(equations, root, outcome, &
            out) bind(C, name="pdn_equations_solution")
            import
            type(c_ptr), value :: equations
            integer(c_int32_t), value :: root
            integer(c_int32_t), value :: outcome
            type(c_ptr), intent(inout) :: out
            integer(c_int32_t) :: pdn_equations_solution
        end function pdn_equations_solution

        ! Adds a parameter: a named number that moves what ::pdn_model_move_number and
        ! ::pdn_model_move_signal say
        function pdn_model_add_parameter(model, name, value, scale, &
            out) bind(C, name="pdn_model_add_parameter")
            import
            type(c_ptr), value :: model
            character(kind=c_char), intent(in) :: name(*)
            real(c_double), value :: value
            real(c_double), value :: scale
            integer(c_int32_t), intent(inout) :: out
            integer(c_int32_t) :: pdn_model_add_parameter
        end function pdn_model_add_parameter

        ! Number of parameters; their ids follow each other from PDN_FIRST_PARAMETER on
        function pdn_model_parameter_count(model, &
            count) bind(C, name="pdn_model_parameter_count")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), intent(inout) :: count
            integer(c_int32_t) :: pdn_model_parameter_count
        end function pdn_model_parameter_count

        ! Value and scale of a parameter
        function pdn_model_parameter(model, parameter, value, &
            scale) bind(C, name="pdn_model_parameter")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: parameter
            real(c_double), intent(inout) :: value
            real(c_double), intent(inout), optional :: scale
            integer(c_int32_t) :: pdn_model_parameter
        end function pdn_model_parameter

        ! The name of a parameter
        function pdn_model_parameter_name(model, parameter, buffer, &
            capacity) bind(C, name="pdn_model_parameter_name")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: parameter
            character(kind=c_char), intent(inout), optional :: buffer(*)
            integer(c_size_t), value :: capacity
            integer(c_size_t) :: pdn_model_parameter_name
        end function pdn_model_parameter_name

        ! The parameter that has a name
        function pdn_model_find_parameter(model, name, &
            parameter) bind(C, name="pdn_model_find_parameter")
            import
            type(c_ptr), value :: model
            character(kind=c_char), intent(in) :: name(*)
            integer(c_int32_t), intent(inout) :: parameter
            integer(c_int32_t) :: pdn_model_find_parameter
        end function pdn_model_find_parameter

        ! Lets a parameter move a number of the model: it becomes `factor` times the parameter's
        ! value, now and whenever that changes
        function pdn_model_move_number(model, parameter, number, id, power, &
            factor) bind(C, name="pdn_model_move_number")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: parameter
            integer(c_int32_t), value :: number
            integer(c_int32_t), value :: id
            integer(c_int32_t), value :: power
            real(c_double), value :: factor
            integer(c_int32_t) :: pdn_model_move_number
        end function pdn_model_move_number

        ! Lets a parameter move a part of a signal: it becomes `factor` times the parameter's
        ! value, now and whenever that changes
        function pdn_model_move_signal(model, parameter, id, component, part, &
            factor) bind(C, name="pdn_model_move_signal")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: parameter
            integer(c_int32_t), value :: id
            integer(c_int32_t), value :: component
            integer(c_int32_t), value :: part
            real(c_double), value :: factor
            integer(c_int32_t) :: pdn_model_move_signal
        end function pdn_model_move_signal

        ! Gives a parameter another value, and all that it moves
        function pdn_model_set_parameter(model, parameter, &
            value) bind(C, name="pdn_model_set_parameter")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: parameter
            real(c_double), value :: value
            integer(c_int32_t) :: pdn_model_set_parameter
        end function pdn_model_set_parameter

        ! Gives everything with mass a force against its motion relative to the inertial frame,
        ! `factor` times its momentum: damping in proportion to mass
        function pdn_model_set_mass_damping(model, &
            factor) bind(C, name="pdn_model_set_mass_damping")
            import
            type(c_ptr), value :: model
            real(c_double), value :: factor
            integer(c_int32_t) :: pdn_model_set_mass_damping
        end function pdn_model_set_mass_damping

        ! Declares that the function of a force is one of the phase, 2 pi t / T, which it is then
        ! told in place of the time: it holds for any period T, as it must where that is unknown
        function pdn_model_declare_of_phase(model, &
            force) bind(C, name="pdn_model_declare_of_phase")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: force
            integer(c_int32_t) :: pdn_model_declare_of_phase
        end function pdn_model_declare_of_phase

        ! Value of a parameter in a solution: given, or found
        function pdn_solution_parameter(solution, parameter, &
            out) bind(C, name="pdn_solution_parameter")
            import
            type(c_ptr), value :: solution
            integer(c_int32_t), value :: parameter
            real(c_double), intent(inout) :: out
            integer(c_int32_t) :: pdn_solution_parameter
        end function pdn_solution_parameter

        ! Prepares a struct for ::pdn_model_joint; use `PDN_INIT(pdn_joint_info, &info)`
        subroutine pdn_joint_info_init(info, struct_size) bind(C, name="pdn_joint_info_init")
            import
            type(pdn_joint_info), intent(inout) :: info
            integer(c_size_t), value :: struct_size
        end subroutine pdn_joint_info_init

        ! Prepares a struct for ::pdn_model_force; use `PDN_INIT(pdn_force_info, &info)`
        subroutine pdn_force_info_init(info, struct_size) bind(C, name="pdn_force_info_init")
            import
            type(pdn_force_info), intent(inout) :: info
            integer(c_size_t), value :: struct_size
        end subroutine pdn_force_info_init

        ! Kind, bodies and frames of a joint
        function pdn_model_joint(model, joint, out) bind(C, name="pdn_model_joint")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: joint
            type(pdn_joint_info), intent(inout) :: out
            integer(c_int32_t) :: pdn_model_joint
        end function pdn_model_joint

        ! Kind of a force, where it acts, and how many numbers it has
        function pdn_model_force(model, force, out) bind(C, name="pdn_model_force")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: force
            type(pdn_force_info), intent(inout) :: out
            integer(c_int32_t) :: pdn_model_force
        end function pdn_model_force

        ! A number of a force, with the factors of parameters
        function pdn_model_force_number(model, force, number, index, &
            out) bind(C, name="pdn_model_force_number")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: force
            integer(c_int32_t), value :: number
            integer(c_int32_t), value :: index
            real(c_double), intent(inout) :: out
            integer(c_int32_t) :: pdn_model_force_number
        end function pdn_model_force_number

        ! A node of forces of the user
        function pdn_model_force_node(model, force, index, &
            node) bind(C, name="pdn_model_force_node")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: force
            integer(c_int32_t), value :: index
            integer(c_int32_t), intent(inout) :: node
            integer(c_int32_t) :: pdn_model_force_node
        end function pdn_model_force_node

        ! Number of nodes of a beam element
        function pdn_model_beam_element_node_count(model, element, &
            count) bind(C, name="pdn_model_beam_element_node_count")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: element
            integer(c_int32_t), intent(inout) :: count
            integer(c_int32_t) :: pdn_model_beam_element_node_count
        end function pdn_model_beam_element_node_count

        ! A node of a beam element, in order along the beam
        function pdn_model_beam_element_node(model, element, index, &
            node) bind(C, name="pdn_model_beam_element_node")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: element
            integer(c_int32_t), value :: index
            integer(c_int32_t), intent(inout) :: node
            integer(c_int32_t) :: pdn_model_beam_element_node
        end function pdn_model_beam_element_node

        ! Cross-section of a beam element at a place, with the factors of parameters
        function pdn_model_beam_section(model, element, station, out, &
            twist) bind(C, name="pdn_model_beam_section")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: element
            real(c_double), value :: station
            type(pdn_section), intent(inout) :: out
            real(c_double), intent(inout), optional :: twist
            integer(c_int32_t) :: pdn_model_beam_section
        end function pdn_model_beam_section

        ! Number of inertias: bodies, masses and inertias on nodes; their ids follow each other
        ! from PDN_FIRST_INERTIA on
        function pdn_model_inertia_count(model, count) bind(C, name="pdn_model_inertia_count")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), intent(inout) :: count
            integer(c_int32_t) :: pdn_model_inertia_count
        end function pdn_model_inertia_count

        ! The inertia of a body, or a mass or inertia on a node, with the factors of parameters
        function pdn_model_inertia(model, inertia, node, &
            matrix) bind(C, name="pdn_model_inertia")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: inertia
            integer(c_int32_t), intent(inout) :: node
            real(c_double), intent(inout) :: matrix(*)
            integer(c_int32_t) :: pdn_model_inertia
        end function pdn_model_inertia

        ! The inertia of a node: of a rigid body its own, of others the one that was added first
        function pdn_model_inertia_of(model, node, inertia) bind(C, name="pdn_model_inertia_of")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: node
            integer(c_int32_t), intent(inout) :: inertia
            integer(c_int32_t) :: pdn_model_inertia_of
        end function pdn_model_inertia_of

        ! A prescribed coordinate; ::pdn_model_summary tells how many there are, whose ids follow
        ! each other from PDN_FIRST_PRESCRIBED on, and ::pdn_model_sample_signal what they follow
        function pdn_model_prescribed(model, prescribed, joint, &
            coordinate) bind(C, name="pdn_model_prescribed")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: prescribed
            integer(c_int32_t), intent(inout) :: joint
            integer(c_int32_t), intent(inout) :: coordinate
            integer(c_int32_t) :: pdn_model_prescribed
        end function pdn_model_prescribed

        ! Number of coordinates of a linear relation
        function pdn_model_relation_term_count(model, relation, &
            count) bind(C, name="pdn_model_relation_term_count")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: relation
            integer(c_int32_t), intent(inout) :: count
            integer(c_int32_t) :: pdn_model_relation_term_count
        end function pdn_model_relation_term_count

        ! A coordinate of a linear relation, and its coefficient
        function pdn_model_relation_term(model, relation, index, joint, coordinate, &
            coefficient) bind(C, name="pdn_model_relation_term")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: relation
            integer(c_int32_t), value :: index
            integer(c_int32_t), intent(inout) :: joint
            integer(c_int32_t), intent(inout) :: coordinate
            real(c_double), intent(inout) :: coefficient
            integer(c_int32_t) :: pdn_model_relation_term
        end function pdn_model_relation_term

        ! Values of a signal of the model in time
        function pdn_model_sample_signal(model, id, component, period, times, count, &
            values) bind(C, name="pdn_model_sample_signal")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: id
            integer(c_int32_t), value :: component
            real(c_double), value :: period
            real(c_double), intent(in) :: times(*)
            integer(c_size_t), value :: count
            real(c_double), intent(inout) :: values(*)
            integer(c_int32_t) :: pdn_model_sample_signal
        end function pdn_model_sample_signal

        ! Number of loads on nodes and at points; their ids follow each other from PDN_FIRST_LOAD
        ! on
        function pdn_model_load_count(model, count) bind(C, name="pdn_model_load_count")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), intent(inout) :: count
            integer(c_int32_t) :: pdn_model_load_count
        end function pdn_model_load_count

        ! A load on a node or at a point; its components are signals, ::pdn_model_sample_signal
        function pdn_model_load_at(model, load, node, first_element, elements, fraction, offset, &
            frame) bind(C, name="pdn_model_load_at")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: load
            integer(c_int32_t), intent(inout) :: node
            integer(c_int32_t), intent(inout) :: first_element
            integer(c_int32_t), intent(inout) :: elements
            real(c_double), intent(inout) :: fraction
            real(c_double), intent(inout), optional :: offset(*)
            integer(c_int32_t), intent(inout) :: frame
            integer(c_int32_t) :: pdn_model_load_at
        end function pdn_model_load_at

        ! Number of loads along beam elements; their ids follow each other from
        ! PDN_FIRST_BEAM_LOAD on
        function pdn_model_beam_load_count(model, &
            count) bind(C, name="pdn_model_beam_load_count")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), intent(inout) :: count
            integer(c_int32_t) :: pdn_model_beam_load_count
        end function pdn_model_beam_load_count

        ! A load along beam elements; its components are signals, ::pdn_model_sample_signal, times
        ! the factors of ::pdn_model_beam_load_factor
        function pdn_model_beam_load(model, load, first_element, elements, frame, axis_2, &
            places) bind(C, name="pdn_model_beam_load")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: load
            integer(c_int32_t), intent(inout) :: first_element
            integer(c_int32_t), intent(inout) :: elements
            integer(c_int32_t), intent(inout) :: frame
            real(c_double), intent(inout), optional :: axis_2(*)
            integer(c_int32_t), intent(inout) :: places
            integer(c_int32_t) :: pdn_model_beam_load
        end function pdn_model_beam_load

        ! Factor of a load along beam elements at a place; it is linear in between
        function pdn_model_beam_load_factor(model, load, index, fraction, &
            factor) bind(C, name="pdn_model_beam_load_factor")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: load
            integer(c_int32_t), value :: index
            real(c_double), intent(inout) :: fraction
            real(c_double), intent(inout) :: factor
            integer(c_int32_t) :: pdn_model_beam_load_factor
        end function pdn_model_beam_load_factor

        ! Number of loads on shell elements; their ids follow each other from PDN_FIRST_SHELL_LOAD
        ! on
        function pdn_model_shell_load_count(model, &
            count) bind(C, name="pdn_model_shell_load_count")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), intent(inout) :: count
            integer(c_int32_t) :: pdn_model_shell_load_count
        end function pdn_model_shell_load_count

        ! A load on shell elements; its components are signals, ::pdn_model_sample_signal
        function pdn_model_shell_load(model, load, first_element, elements, place, &
            frame) bind(C, name="pdn_model_shell_load")
            import
            type(c_ptr), value :: model
            integer(c_int32_t), value :: load
            integer(c_int32_t), intent(inout) :: first_element
            integer(c_int32_t), intent(inout) :: elements
            integer(c_int32_t), intent(inout) :: place
            integer(c_int32_t), intent(inout) :: frame
            integer(c_int32_t) :: pdn_model_shell_load
        end function pdn_model_shell_load

        ! Makes an empty list: no parameter is free
        function pdn_conditions_new(out) bind(C, name="pdn_conditions_new")
            import
            type(c_ptr), intent(inout) :: out
            integer(c_int32_t) :: pdn_conditions_new
        end function pdn_conditions_new

        ! Frees a list; NULL does nothing
        subroutine pdn_conditions_free(conditions) bind(C, name="pdn_conditions_free")
            import
            type(c_ptr), value :: conditions
        end subroutine pdn_conditions_free

        ! Makes a parameter free: its value in the model is that to start from
        function pdn_conditions_release(conditions, &
            parameter) bind(C, name="pdn_conditions_release")
            import
            type(c_ptr), value :: conditions
            integer(c_int32_t), value :: parameter
            integer(c_int32_t) :: pdn_conditions_release
        end function pdn_conditions_release

        ! Adds the condition on the phase: the motion is not ahead of that which the solve starts
        ! from
        function pdn_conditions_add_phase(conditions) bind(C, name="pdn_conditions_add_phase")
            import
            type(c_ptr), value :: conditions
            integer(c_int32_t) :: pdn_conditions_add_phase
        end function pdn_conditions_add_phase

        ! Adds the condition on the phase of a rotation: in the mean over the period and all
        ! nodes, the motion is not turned about an axis from that which the solve starts from
        function pdn_conditions_add_rotation_phase(conditions, axis, &
            point) bind(C, name="pdn_conditions_add_rotation_phase")
            import
            type(c_ptr), value :: conditions
            real(c_double), intent(in) :: axis(*)
            real(c_double), intent(in), optional :: point(*)
            integer(c_int32_t) :: pdn_conditions_add_rotation_phase
        end function pdn_conditions_add_rotation_phase

        ! Adds the condition on the phase of a translation: in the mean over the period and all
        ! nodes, the motion is not moved in a direction from that which the solve starts from
        function pdn_conditions_add_translation_phase(conditions, &
            direction) bind(C, name="pdn_conditions_add_translation_phase")
            import
            type(c_ptr), value :: conditions
            real(c_double), intent(in) :: direction(*)
            integer(c_int32_t) :: pdn_conditions_add_translation_phase
        end function pdn_conditions_add_translation_phase

        ! Adds the condition that the mean, a harmonic, or the value at a time, of a quantity is
        ! this: trim
        function pdn_conditions_add_quantity(conditions, quantity, feature, at, value, &
            scale) bind(C, name="pdn_conditions_add_quantity")
            import
            type(c_ptr), value :: conditions
            type(pdn_quantity), intent(in) :: quantity
            integer(c_int32_t), value :: feature
            real(c_double), value :: at
            real(c_double), value :: value
            real(c_double), value :: scale
            integer(c_int32_t) :: pdn_conditions_add_quantity
        end function pdn_conditions_add_quantity

        ! Adds the condition that a joint coordinate has a value at the start of the period
        function pdn_conditions_add_joint_coordinate(conditions, joint, coordinate, &
            value) bind(C, name="pdn_conditions_add_joint_coordinate")
            import
            type(c_ptr), value :: conditions
            integer(c_int32_t), value :: joint
            integer(c_int32_t), value :: coordinate
            real(c_double), value :: value
            integer(c_int32_t) :: pdn_conditions_add_joint_coordinate
        end function pdn_conditions_add_joint_coordinate

        ! Adds the condition that the mean of the kinetic and the potential energy over the period
        ! is a value
        function pdn_conditions_add_energy(conditions, &
            energy) bind(C, name="pdn_conditions_add_energy")
            import
            type(c_ptr), value :: conditions
            real(c_double), value :: energy
            integer(c_int32_t) :: pdn_conditions_add_energy
        end function pdn_conditions_add_energy

        ! Adds the condition that the mean momentum in a direction is a value
        function pdn_conditions_add_momentum(conditions, direction, &
            momentum) bind(C, name="pdn_conditions_add_momentum")
            import
            type(c_ptr), value :: conditions
            real(c_double), intent(in) :: direction(*)
            real(c_double), value :: momentum
            integer(c_int32_t) :: pdn_conditions_add_momentum
        end function pdn_conditions_add_momentum

        ! Adds the condition that the mean angular momentum about an axis is a value
        function pdn_conditions_add_angular_momentum(conditions, axis, point, &
            momentum) bind(C, name="pdn_conditions_add_angular_momentum")
            import
            type(c_ptr), value :: conditions
            real(c_double), intent(in) :: axis(*)
            real(c_double), intent(in), optional :: point(*)
            real(c_double), value :: momentum
            integer(c_int32_t) :: pdn_conditions_add_angular_momentum
        end function pdn_conditions_add_angular_momentum

        ! Finds a periodic response that meets conditions, and the values of as many free
        ! parameters
        function pdn_solve_conditioned(model, period, conditions, options, &
            out) bind(C, name="pdn_solve_conditioned")
            import
            type(c_ptr), value :: model
            real(c_double), value :: period
            type(c_ptr), value :: conditions
            type(pdn_periodic_options), intent(in), optional :: options
            type(c_ptr), intent(inout) :: out
            integer(c_int32_t) :: pdn_solve_conditioned
        end function pdn_solve_conditioned

        ! Sets default options; use `PDN_INIT(pdn_sensitivity_options, &options)`
        subroutine pdn_sensitivity_options_init(options, &
            struct_size) bind(C, name="pdn_sensitivity_options_init")
            import
            type(pdn_sensitivity_options), intent(inout) :: options
            integer(c_size_t), value :: struct_size
        end subroutine pdn_sensitivity_options_init

        ! Makes an empty list: nothing is differentiated
        function pdn_sensitivities_new(out) bind(C, name="pdn_sensitivities_new")
            import
            type(c_ptr), intent(inout) :: out
            integer(c_int32_t) :: pdn_sensitivities_new
        end function pdn_sensitivities_new

        ! Frees a list; NULL does nothing
        subroutine pdn_sensitivities_free(sensitivities) bind(C, name="pdn_sensitivities_free")
            import
            type(c_ptr), value :: sensitivities
        end subroutine pdn_sensitivities_free

        ! Adds a dependent: the mean, a harmonic, the value at a time, or a peak of a quantity
        function pdn_sensitivities_add_quantity(sensitivities, quantity, feature, &
            at) bind(C, name="pdn_sensitivities_add_quantity")
            import
            type(c_ptr), value :: sensitivities
            type(pdn_quantity), intent(in) :: quantity
            integer(c_int32_t), value :: feature
            real(c_double), value :: at
            integer(c_int32_t) :: pdn_sensitivities_add_quantity
        end function pdn_sensitivities_add_quantity

        ! Adds a dependent: the value of a free parameter, which conditions determine
        function pdn_sensitivities_add_found(sensitivities, &
            parameter) bind(C, name="pdn_sensitivities_add_found")
            import
            type(c_ptr), value :: sensitivities
            integer(c_int32_t), value :: parameter
            integer(c_int32_t) :: pdn_sensitivities_add_found
        end function pdn_sensitivities_add_found

        ! Adds a parameter that all is differentiated by
        function pdn_sensitivities_add_parameter(sensitivities, &
            parameter) bind(C, name="pdn_sensitivities_add_parameter")
            import
            type(c_ptr), value :: sensitivities
            integer(c_int32_t), value :: parameter
            integer(c_int32_t) :: pdn_sensitivities_add_parameter
        end function pdn_sensitivities_add_parameter

        ! Derivatives of what comes out of a periodic solution by parameters of its model
        function pdn_solution_sensitivities(solution, sensitivities, conditions, options, &
            derivatives, dependents, parameters) bind(C, name="pdn_solution_sensitivities")
            import
            type(c_ptr), value :: solution
            type(c_ptr), value :: sensitivities
            type(c_ptr), value :: conditions
            type(pdn_sensitivity_options), intent(in), optional :: options
            real(c_double), intent(inout) :: derivatives(*)
            integer(c_size_t), value :: dependents
            integer(c_size_t), value :: parameters
            integer(c_int32_t) :: pdn_solution_sensitivities
        end function pdn_solution_sensitivities

        ! Derivatives of a Floquet multiplier of a periodic solution by parameters of its model
        function pdn_solution_multiplier_sensitivities(solution, sensitivities, stability, &
            number, conditions, options, re, im, &
            parameters) bind(C, name="pdn_solution_multiplier_sensitivities")
            import
            type(c_ptr), value :: solution
            type(c_ptr), value :: sensitivities
            type(c_ptr), value :: stability
            integer(c_int32_t), value :: number
            type(c_ptr), value :: conditions
            type(pdn_sensitivity_options), intent(in), optional :: options
            real(c_double), intent(inout) :: re(*)
            real(c_double), intent(inout) :: im(*)
            integer(c_size_t), value :: parameters
            integer(c_int32_t) :: pdn_solution_multiplier_sensitivities
        end function pdn_solution_multiplier_sensitivities

        ! Sets a point to that of nothing; use `PDN_INIT(pdn_branch_point, &point)`
        subroutine pdn_branch_point_init(point, &
            struct_size) bind(C, name="pdn_branch_point_init")
            import
            type(pdn_branch_point), intent(inout) :: point
            integer(c_size_t), value :: struct_size
        end subroutine pdn_branch_point_init

        ! Sets default options; use `PDN_INIT(pdn_branch_options, &options)`
        subroutine pdn_branch_options_init(options, &
            struct_size) bind(C, name="pdn_branch_options_init")
            import
            type(pdn_branch_options), intent(inout) :: options
            integer(c_size_t), value :: struct_size
        end subroutine pdn_branch_options_init

        ! Follows periodic motions along a parameter, through folds, from the response at its
        ! value in the model
        function pdn_follow_branch(model, period, parameter, options, &
            out) bind(C, name="pdn_follow_branch")
            import
            type(c_ptr), value :: model
            real(c_double), value :: period
            integer(c_int32_t), value :: parameter
            type(pdn_branch_options), intent(in) :: options
            type(c_ptr), intent(inout) :: out
            integer(c_int32_t) :: pdn_follow_branch
        end function pdn_follow_branch

        ! Finds the response over a range of frequencies, through folds: ::pdn_follow_branch along
        ! PDN_FREQUENCY
        function pdn_solve_frequency_response(model, first, last, options, &
            out) bind(C, name="pdn_solve_frequency_response")
            import
            type(c_ptr), value :: model
            real(c_double), value :: first
            real(c_double), value :: last
            type(pdn_branch_options), intent(in), optional :: options
            type(c_ptr), intent(inout) :: out
            integer(c_int32_t) :: pdn_solve_frequency_response
        end function pdn_solve_frequency_response

        ! Follows the other branch at a point where one begins: a branch point, or a period
        ! doubling, from where motions have twice the period, on one grid point less than twice as
        ! many
        function pdn_switch_branch(branch, point, amplitude, options, &
            out) bind(C, name="pdn_switch_branch")
            import
            type(c_ptr), value :: branch
            integer(c_int32_t), value :: point
            real(c_double), value :: amplitude
            type(pdn_branch_options), intent(in) :: options
            type(c_ptr), intent(inout) :: out
            integer(c_int32_t) :: pdn_switch_branch
        end function pdn_switch_branch

        ! Follows folds, period doublings or torus points along a second parameter, from one of
        ! them on a branch: that of the branch is free beside it
        function pdn_follow_locus(branch, point, parameter, options, &
            out) bind(C, name="pdn_follow_locus")
            import
            type(c_ptr), value :: branch
            integer(c_int32_t), value :: point
            integer(c_int32_t), value :: parameter
            type(pdn_branch_options), intent(in) :: options
            type(c_ptr), intent(inout) :: out
            integer(c_int32_t) :: pdn_follow_locus
        end function pdn_follow_locus

        ! Follows a branch on from its last point, in the direction in which it came there: with a
        ! wider range, more points, a shorter smallest step
        function pdn_continue_branch(branch, options, out) bind(C, name="pdn_continue_branch")
            import
            type(c_ptr), value :: branch
            type(pdn_branch_options), intent(in) :: options
            type(c_ptr), intent(inout) :: out
            integer(c_int32_t) :: pdn_continue_branch
        end function pdn_continue_branch

        ! Saves a branch with its model and all its points
        function pdn_branch_save(branch, path) bind(C, name="pdn_branch_save")
            import
            type(c_ptr), value :: branch
            character(kind=c_char), intent(in) :: path(*)
            integer(c_int32_t) :: pdn_branch_save
        end function pdn_branch_save

        ! Loads a branch that ::pdn_branch_save saved
        function pdn_branch_load(path, out) bind(C, name="pdn_branch_load")
            import
            character(kind=c_char), intent(in) :: path(*)
            type(c_ptr), intent(inout) :: out
            integer(c_int32_t) :: pdn_branch_load
        end function pdn_branch_load

        ! Frees a branch; NULL does nothing
        subroutine pdn_branch_free(branch) bind(C, name="pdn_branch_free")
            import
            type(c_ptr), value :: branch
        end subroutine pdn_branch_free

        ! Why a branch ended
        function pdn_branch_end(branch) bind(C, name="pdn_branch_end")
            import
            type(c_ptr), value :: branch
            integer(c_int32_t) :: pdn_branch_end
        end function pdn_branch_end

        ! A readable report: points, events, and why the branch ended
        function pdn_branch_report(branch, buffer, capacity) bind(C, name="pdn_branch_report")
            import
            type(c_ptr), value :: branch
            character(kind=c_char), intent(inout), optional :: buffer(*)
            integer(c_size_t), value :: capacity
            integer(c_size_t) :: pdn_branch_report
        end function pdn_branch_report

        ! Number of points of a branch
        function pdn_branch_count(branch, out) bind(C, name="pdn_branch_count")
            import
            type(c_ptr), value :: branch
            integer(c_int32_t), intent(inout) :: out
            integer(c_int32_t) :: pdn_branch_count
        end function pdn_branch_count

        ! A point of a branch
        function pdn_branch_get(branch, point, out) bind(C, name="pdn_branch_get")
            import
            type(c_ptr), value :: branch
            integer(c_int32_t), value :: point
            type(pdn_branch_point), intent(inout) :: out
            integer(c_int32_t) :: pdn_branch_get
        end function pdn_branch_get

        ! The solution at a point of a branch
        function pdn_branch_solution(branch, point, out) bind(C, name="pdn_branch_solution")
            import
            type(c_ptr), value :: branch
            integer(c_int32_t), value :: point
            type(c_ptr), intent(inout) :: out
            integer(c_int32_t) :: pdn_branch_solution
        end function pdn_branch_solution

        ! Writes a branch as CSV: a line for each point, with the parameter, how the step went,
        ! what happens there, what multipliers say if they were wanted
        ! (`pdn_branch_options.stability`) and, of each component of quantities, the mean, the
        ! size of the first harmonic, the least and the largest value over the period
        function pdn_branch_write_csv(branch, quantities, count, &
            path) bind(C, name="pdn_branch_write_csv")
            import
            type(c_ptr), value :: branch
            type(pdn_quantity), intent(in), optional :: quantities(*)
            integer(c_size_t), value :: count
            character(kind=c_char), intent(in) :: path(*)
            integer(c_int32_t) :: pdn_branch_write_csv
        end function pdn_branch_write_csv

        ! Writes a chart of the exponents of small disturbances along a branch as CSV, as of
        ! Campbell: of each point that is no event a line for each multiplier, but for conjugates
        ! and for those that only move the motion in time or space
        function pdn_branch_write_campbell(branch, options, blades, count, &
            path) bind(C, name="pdn_branch_write_campbell")
            import
            type(c_ptr), value :: branch
            type(pdn_stability_options), intent(in), optional :: options
            integer(c_int32_t), intent(in), optional :: blades(*)
            integer(c_size_t), value :: count
            character(kind=c_char), intent(in) :: path(*)
            integer(c_int32_t) :: pdn_branch_write_campbell
        end function pdn_branch_write_campbell

        ! Sets default options; use `PDN_INIT(pdn_static_options, &options)`
        subroutine pdn_static_options_init(options, &
            struct_size) bind(C, name="pdn_static_options_init")
            import
            type(pdn_static_options), intent(inout) :: options
            integer(c_size_t), value :: struct_size
        end subroutine pdn_static_options_init

        ! Finds an equilibrium at one time: of forces at rest, or in steady rotation
        function pdn_solve_static(model, options, out) bind(C, name="pdn_solve_static")
            import
            type(c_ptr), value :: model
            type(pdn_static_options), intent(in), optional :: options
            type(c_ptr), intent(inout) :: out
            integer(c_int32_t) :: pdn_solve_static
        end function pdn_solve_static

        ! Sets default options; use `PDN_INIT(pdn_modes_options, &options)`
        subroutine pdn_modes_options_init(options, &
            struct_size) bind(C, name="pdn_modes_options_init")
            import
            type(pdn_modes_options), intent(inout) :: options
            integer(c_size_t), value :: struct_size
        end subroutine pdn_modes_options_init

        ! Finds an equilibrium and the modes of small motions `Re(x exp(s t))` about it
        function pdn_solve_modes(model, options, out) bind(C, name="pdn_solve_modes")
            import
            type(c_ptr), value :: model
            type(pdn_modes_options), intent(in), optional :: options
            type(c_ptr), intent(inout) :: out
            integer(c_int32_t) :: pdn_solve_modes
        end function pdn_solve_modes

        ! Frees modes; NULL does nothing
        subroutine pdn_modes_free(modes) bind(C, name="pdn_modes_free")
            import
            type(c_ptr), value :: modes
        end subroutine pdn_modes_free

        ! How the search for the equilibrium ended
        function pdn_modes_outcome(modes) bind(C, name="pdn_modes_outcome")
            import
            type(c_ptr), value :: modes
            integer(c_int32_t) :: pdn_modes_outcome
        end function pdn_modes_outcome

        ! A readable report: outcome of the equilibrium and why, and a table of the modes
        function pdn_modes_report(modes, buffer, capacity) bind(C, name="pdn_modes_report")
            import
            type(c_ptr), value :: modes
            character(kind=c_char), intent(inout), optional :: buffer(*)
            integer(c_size_t), value :: capacity
            integer(c_size_t) :: pdn_modes_report
        end function pdn_modes_report

        ! Number of modes: as many as were wanted, if there are and they were found
        function pdn_modes_count(modes, out, complete) bind(C, name="pdn_modes_count")
            import
            type(c_ptr), value :: modes
            integer(c_int32_t), intent(inout) :: out
            integer(c_int32_t), intent(inout), optional :: complete
            integer(c_int32_t) :: pdn_modes_count
        end function pdn_modes_count

        ! Prepares a struct for ::pdn_modes_get; use `PDN_INIT(pdn_mode, &mode)`
        subroutine pdn_mode_init(mode, struct_size) bind(C, name="pdn_mode_init")
            import
            type(pdn_mode), intent(inout) :: mode
            integer(c_size_t), value :: struct_size
        end subroutine pdn_mode_init

        ! Eigenvalue, frequency and damping of a mode
        function pdn_modes_get(modes, mode, out) bind(C, name="pdn_modes_get")
            import
            type(c_ptr), value :: modes
            integer(c_int32_t), value :: mode
            type(pdn_mode), intent(inout) :: out
            integer(c_int32_t) :: pdn_modes_get
        end function pdn_modes_get

        ! Shape x of a mode at some nodes
        function pdn_modes_shape(modes, mode, nodes, count, real, &
            imaginary) bind(C, name="pdn_modes_shape")
            import
            type(c_ptr), value :: modes
            integer(c_int32_t), value :: mode
            integer(c_int32_t), intent(in) :: nodes(*)
            integer(c_size_t), value :: count
            real(c_double), intent(inout) :: real(*)
            real(c_double), intent(inout), optional :: imaginary(*)
            integer(c_int32_t) :: pdn_modes_shape
        end function pdn_modes_shape

        ! The motion in a mode, to be looked at as any other solution
        function pdn_modes_motion(modes, mode, amplitude, out) bind(C, name="pdn_modes_motion")
            import
            type(c_ptr), value :: modes
            integer(c_int32_t), value :: mode
            real(c_double), value :: amplitude
            type(c_ptr), intent(inout) :: out
            integer(c_int32_t) :: pdn_modes_motion
        end function pdn_modes_motion

        ! The equilibrium, as ::pdn_solve_static gives it, converged or not
        function pdn_modes_equilibrium(modes, out) bind(C, name="pdn_modes_equilibrium")
            import
            type(c_ptr), value :: modes
            type(c_ptr), intent(inout) :: out
            integer(c_int32_t) :: pdn_modes_equilibrium
        end function pdn_modes_equilibrium

        ! Sets default options; use `PDN_INIT(pdn_march_options, &options)`
        subroutine pdn_march_options_init(options, &
            struct_size) bind(C, name="pdn_march_options_init")
            import
            type(pdn_march_options), intent(inout) :: options
            integer(c_size_t), value :: struct_size
        end subroutine pdn_march_options_init

        ! Marches a model in time, for a given duration or until its motion repeats itself
        function pdn_solve_march(model, options, out) bind(C, name="pdn_solve_march")
            import
            type(c_ptr), value :: model
            type(pdn_march_options), intent(in) :: options
            type(c_ptr), intent(inout) :: out
            integer(c_int32_t) :: pdn_solve_march
        end function pdn_solve_march

        ! Prepares a struct for ::pdn_solution_march; use `PDN_INIT(pdn_march_diagnostics,
        ! &diagnostics)`
        subroutine pdn_march_diagnostics_init(diagnostics, &
            struct_size) bind(C, name="pdn_march_diagnostics_init")
            import
            type(pdn_march_diagnostics), intent(inout) :: diagnostics
            integer(c_size_t), value :: struct_size
        end subroutine pdn_march_diagnostics_init

        ! Figures of a march: steps, periods, how much the last of them differ, how much the start
        ! was changed
        function pdn_solution_march(solution, out) bind(C, name="pdn_solution_march")
            import
            type(c_ptr), value :: solution
            type(pdn_march_diagnostics), intent(inout) :: out
            integer(c_int32_t) :: pdn_solution_march
        end function pdn_solution_march

        ! Sets default options; use `PDN_INIT(pdn_shooting_options, &options)`
        subroutine pdn_shooting_options_init(options, &
            struct_size) bind(C, name="pdn_shooting_options_init")
            import
            type(pdn_shooting_options), intent(inout) :: options
            integer(c_size_t), value :: struct_size
        end subroutine pdn_shooting_options_init

        ! Finds the periodic response of a model by shooting: Newton's method on the period map of
        ! ::pdn_solve_march
        function pdn_solve_shooting(model, period, options, &
            out) bind(C, name="pdn_solve_shooting")
            import
            type(c_ptr), value :: model
            real(c_double), value :: period
            type(pdn_shooting_options), intent(in), optional :: options
            type(c_ptr), intent(inout) :: out
            integer(c_int32_t) :: pdn_solve_shooting
        end function pdn_solve_shooting

        ! Number of Floquet multipliers of a solution: as many as the system has states, if
        ! ::pdn_solve_shooting found them; of a periodic solution as many as ::pdn_solve_stability
        ! finds, which is called with default options unless it has been before
        function pdn_solution_floquet_count(solution, &
            out) bind(C, name="pdn_solution_floquet_count")
            import
            type(c_ptr), value :: solution
            integer(c_size_t), intent(inout) :: out
            integer(c_int32_t) :: pdn_solution_floquet_count
        end function pdn_solution_floquet_count

        ! Floquet multipliers: what disturbances of the motion are multiplied by in a period, the
        ! largest first
        function pdn_solution_floquet(solution, real, imaginary, &
            count) bind(C, name="pdn_solution_floquet")
            import
            type(c_ptr), value :: solution
            real(c_double), intent(inout) :: real(*)
            real(c_double), intent(inout) :: imaginary(*)
            integer(c_size_t), value :: count
            integer(c_int32_t) :: pdn_solution_floquet
        end function pdn_solution_floquet

        ! Sets default options; use `PDN_INIT(pdn_stability_options, &options)`
        subroutine pdn_stability_options_init(options, &
            struct_size) bind(C, name="pdn_stability_options_init")
            import
            type(pdn_stability_options), intent(inout) :: options
            integer(c_size_t), value :: struct_size
        end subroutine pdn_stability_options_init

        ! Finds the Floquet multipliers of a periodic solution: what small disturbances are
        ! multiplied by in a period
        function pdn_solve_stability(solution, options, out) bind(C, name="pdn_solve_stability")
            import
            type(c_ptr), value :: solution
            type(pdn_stability_options), intent(in), optional :: options
            type(c_ptr), intent(inout) :: out
            integer(c_int32_t) :: pdn_solve_stability
        end function pdn_solve_stability

        ! Frees multipliers; NULL does nothing
        subroutine pdn_stability_free(stability) bind(C, name="pdn_stability_free")
            import
            type(c_ptr), value :: stability
        end subroutine pdn_stability_free

        ! How the analysis ended
        function pdn_stability_outcome(stability) bind(C, name="pdn_stability_outcome")
            import
            type(c_ptr), value :: stability
            integer(c_int32_t) :: pdn_stability_outcome
        end function pdn_stability_outcome

        ! What the multipliers say
        function pdn_stability_verdict(stability, verdict, &
            frequency_limit) bind(C, name="pdn_stability_verdict")
            import
            type(c_ptr), value :: stability
            integer(c_int32_t), intent(inout) :: verdict
            real(c_double), intent(inout), optional :: frequency_limit
            integer(c_int32_t) :: pdn_stability_verdict
        end function pdn_stability_verdict

        ! Number of multipliers that are known, and of those that the system has, one for each
        ! state
        function pdn_stability_count(stability, out, states) bind(C, name="pdn_stability_count")
            import
            type(c_ptr), value :: stability
            integer(c_size_t), intent(inout) :: out
            integer(c_size_t), intent(inout), optional :: states
            integer(c_int32_t) :: pdn_stability_count
        end function pdn_stability_count

        ! Prepares a struct for ::pdn_stability_get; use `PDN_INIT(pdn_multiplier, &multiplier)`
        subroutine pdn_multiplier_init(multiplier, &
            struct_size) bind(C, name="pdn_multiplier_init")
            import
            type(pdn_multiplier), intent(inout) :: multiplier
            integer(c_size_t), value :: struct_size
        end subroutine pdn_multiplier_init

        ! A multiplier
        function pdn_stability_get(stability, number, out) bind(C, name="pdn_stability_get")
            import
            type(c_ptr), value :: stability
            integer(c_int32_t), value :: number
            type(pdn_multiplier), intent(inout) :: out
            integer(c_int32_t) :: pdn_stability_get
        end function pdn_stability_get

        ! Number of times of the shapes of modes
        function pdn_stability_time_count(stability, &
            out) bind(C, name="pdn_stability_time_count")
            import
            type(c_ptr), value :: stability
            integer(c_size_t), intent(inout) :: out
            integer(c_int32_t) :: pdn_stability_time_count
        end function pdn_stability_time_count

        ! Times of the shapes of modes: ends of equal steps over the period, the last is the
        ! period
        function pdn_stability_times(stability, times, &
            count) bind(C, name="pdn_stability_times")
            import
            type(c_ptr), value :: stability
            real(c_double), intent(inout) :: times(*)
            integer(c_size_t), value :: count
            integer(c_int32_t) :: pdn_stability_times
        end function pdn_stability_times

        ! The mode phi of a multiplier at a node over the period
        function pdn_stability_shape(stability, number, node, steps, real, &
            imaginary) bind(C, name="pdn_stability_shape")
            import
            type(c_ptr), value :: stability
            integer(c_int32_t), value :: number
            integer(c_int32_t), value :: node
            integer(c_size_t), value :: steps
            real(c_double), intent(inout) :: real(*)
            real(c_double), intent(inout), optional :: imaginary(*)
            integer(c_int32_t) :: pdn_stability_shape
        end function pdn_stability_shape

        ! A readable report: the verdict, how far it holds, and a table of the multipliers
        function pdn_stability_report(stability, buffer, &
            capacity) bind(C, name="pdn_stability_report")
            import
            type(c_ptr), value :: stability
            character(kind=c_char), intent(inout), optional :: buffer(*)
            integer(c_size_t), value :: capacity
            integer(c_size_t) :: pdn_stability_report
        end function pdn_stability_report

        ! Interpolates a periodic motion given at N equispaced times, by dual polar decomposition
        function pdn_motion_interpolate(period, positions, rotations, points, times, count, &
            position, rotation, velocity, acceleration) bind(C, name="pdn_motion_interpolate")
            import
            real(c_double), value :: period
            real(c_double), intent(in) :: positions(*)
            real(c_double), intent(in) :: rotations(*)
            integer(c_size_t), value :: points
            real(c_double), intent(in) :: times(*)
            integer(c_size_t), value :: count
            real(c_double), intent(inout), optional :: position(*)
            real(c_double), intent(inout), optional :: rotation(*)
            real(c_double), intent(inout), optional :: velocity(*)
            real(c_double), intent(inout), optional :: acceleration(*)
            integer(c_int32_t) :: pdn_motion_interpolate
        end function pdn_motion_interpolate

        ! Velocities and accelerations of a motion at its own grid points, and their exact
        ! linearisation
        function pdn_motion_grid_kinematics(period, positions, rotations, points, velocity, &
            acceleration, velocity_tangent, &
            acceleration_tangent) bind(C, name="pdn_motion_grid_kinematics")
            import
            real(c_double), value :: period
            real(c_double), intent(in) :: positions(*)
            real(c_double), intent(in) :: rotations(*)
            integer(c_size_t), value :: points
            real(c_double), intent(inout), optional :: velocity(*)
            real(c_double), intent(inout), optional :: acceleration(*)
            real(c_double), intent(inout), optional :: velocity_tangent(*)
            real(c_double), intent(inout), optional :: acceleration_tangent(*)
            integer(c_int32_t) :: pdn_motion_grid_kinematics
        end function pdn_motion_grid_kinematics

        ! A frame from a point and two directions, such as that of a joint or a bushing
        function pdn_joint_frame(point, axis_3, axis_1, frame) bind(C, name="pdn_joint_frame")
            import
            real(c_double), intent(in) :: point(*)
            real(c_double), intent(in) :: axis_3(*)
            real(c_double), intent(in) :: axis_1(*)
            type(pdn_frame), intent(inout) :: frame
            integer(c_int32_t) :: pdn_joint_frame
        end function pdn_joint_frame

        ! Prepares a struct for ::pdn_model_summary; use `PDN_INIT(pdn_summary, &summary)`
        subroutine pdn_summary_init(summary, struct_size) bind(C, name="pdn_summary_init")
            import
            type(pdn_summary), intent(inout) :: summary
            integer(c_size_t), value :: struct_size
        end subroutine pdn_summary_init

        ! Counts, mass, degrees of freedom and mobility of a model in its reference configuration
        function pdn_model_summary(model, out) bind(C, name="pdn_model_summary")
            import
            type(c_ptr), value :: model
            type(pdn_summary), intent(inout) :: out
            integer(c_int32_t) :: pdn_model_summary
        end function pdn_model_summary

        ! The same in readable lines, with warnings: parts that nothing connects or holds, ends of
        ! beams without a joint, nodes without inertia, joints open in the reference configuration
        ! or far from all else, impossible moments of inertia, sizes, masses and stiffnesses that
        ! do not fit each other
        function pdn_model_describe(model, buffer, capacity) bind(C, name="pdn_model_describe")
            import
            type(c_ptr), value :: model
            character(kind=c_char), intent(inout), optional :: buffer(*)
            integer(c_size_t), value :: capacity
            integer(c_size_t) :: pdn_model_describe
        end function pdn_model_describe

        ! A table over these times, to choose columns for and to write as CSV
        function pdn_table_new(times, count, out) bind(C, name="pdn_table_new")
            import
            real(c_double), intent(in) :: times(*)
            integer(c_size_t), value :: count
            type(c_ptr), intent(inout) :: out
            integer(c_int32_t) :: pdn_table_new
        end function pdn_table_new

        ! Frees a table; NULL does nothing
        subroutine pdn_table_free(table) bind(C, name="pdn_table_free")
            import
            type(c_ptr), value :: table
        end subroutine pdn_table_free

        ! Adds a column of values of your own, such as one computed from several quantities
        function pdn_table_add_values(table, label, values, &
            count) bind(C, name="pdn_table_add_values")
            import
            type(c_ptr), value :: table
            character(kind=c_char), intent(in) :: label(*)
            real(c_double), intent(in) :: values(*)
            integer(c_size_t), value :: count
            integer(c_int32_t) :: pdn_table_add_values
        end function pdn_table_add_values

        ! Writes a table as a CSV file: a line of names, then a line for each time
        function pdn_table_write_csv(table, path) bind(C, name="pdn_table_write_csv")
            import
            type(c_ptr), value :: table
            character(kind=c_char), intent(in) :: path(*)
            integer(c_int32_t) :: pdn_table_write_csv
        end function pdn_table_write_csv

        ! Writes an animation of a solution that ParaView opens: VTK's XML files, and a list of
        ! them
        function pdn_solution_write_vtk(solution, times, count, points_per_element, &
            path) bind(C, name="pdn_solution_write_vtk")
            import
            type(c_ptr), value :: solution
            real(c_double), intent(in) :: times(*)
            integer(c_size_t), value :: count
            integer(c_size_t), value :: points_per_element
            character(kind=c_char), intent(in) :: path(*)
            integer(c_int32_t) :: pdn_solution_write_vtk
        end function pdn_solution_write_vtk

        ! Saves a solution with its model, whether it has converged or not
        function pdn_solution_save(solution, path) bind(C, name="pdn_solution_save")
            import
            type(c_ptr), value :: solution
            character(kind=c_char), intent(in) :: path(*)
            integer(c_int32_t) :: pdn_solution_save
        end function pdn_solution_save

        ! Loads a solution that ::pdn_solution_save saved: its quantities, diagnostics and report
        ! are what they were
        function pdn_solution_load(path, out) bind(C, name="pdn_solution_load")
            import
            character(kind=c_char), intent(in) :: path(*)
            type(c_ptr), intent(inout) :: out
            integer(c_int32_t) :: pdn_solution_load
        end function pdn_solution_load

        ! A copy of the model that a solution is of, as it was when it was solved
        function pdn_solution_model(solution, out) bind(C, name="pdn_solution_model")
            import
            type(c_ptr), value :: solution
            type(c_ptr), intent(inout) :: out
            integer(c_int32_t) :: pdn_solution_model
        end function pdn_solution_model

        ! A copy of a model, which may be changed and solved apart from it
        function pdn_model_copy(model, out) bind(C, name="pdn_model_copy")
            import
            type(c_ptr), value :: model
            type(c_ptr), intent(inout) :: out
            integer(c_int32_t) :: pdn_model_copy
        end function pdn_model_copy

        ! Saves a model
        function pdn_model_save(model, path) bind(C, name="pdn_model_save")
            import
            type(c_ptr), value :: model
            character(kind=c_char), intent(in) :: path(*)
            integer(c_int32_t) :: pdn_model_save
        end function pdn_model_save

        ! Loads a model that ::pdn_model_save saved; its ids are what they were
        function pdn_model_load(path, out) bind(C, name="pdn_model_load")
            import
            character(kind=c_char), intent(in) :: path(*)
            type(c_ptr), intent(inout) :: out
            integer(c_int32_t) :: pdn_model_load
        end function pdn_model_load
    end interface
end module periodyn_c

module periodyn
    use periodyn_c, c_signal => pdn_signal, c_version => pdn_version, &
        c_version_check => pdn_version_check, c_build_info => pdn_build_info, &
        c_status_name => pdn_status_name, c_status_message => pdn_status_message, &
        c_last_error => pdn_last_error, c_set_last_error => pdn_set_last_error, &
        c_set_callback_error => pdn_set_callback_error, c_release_memory => pdn_release_memory, &
        c_section_set_component_damping => pdn_section_set_component_damping, &
        c_section_set_proportional_damping => pdn_section_set_proportional_damping, &
        c_shell_section_set_proportional_damping => pdn_shell_section_set_proportional_damping, &
        c_motion_interpolate => pdn_motion_interpolate, &
        c_motion_grid_kinematics => pdn_motion_grid_kinematics, c_joint_frame => pdn_joint_frame
    use, intrinsic :: iso_fortran_env, only: error_unit
    implicit none
    public
    private :: report, fits, nodes_of, raw_of, text_at, error_unit

    ! In every procedure: without stat, a failure ends the program with the message. With it, stat
    ! is 0 or the negative status (PDN_ERR_VALUE, ...), and errmsg, blank-padded, tells which
    ! argument was wrong, what was expected and what came; other outputs are then left as they are.
    ! Not converging is no failure, but an outcome of the solution.
    !
    ! Ids and counts are integer(c_int32_t), which is the default integer.

    ! A handle with shared ownership: an assignment makes a second name for the same object, which
    ! is freed when its last variable goes. (Variables of the main program never go; call free, or
    ! use a block.)
    type :: pdn_handle
        type(c_ptr), private :: c = c_null_ptr
        integer, pointer, private :: owners => null()
        procedure(pdn_destroy_fn), pointer, nopass, private :: release_with => null()
    contains
        procedure, public :: free => handle_free
        procedure, public :: handle => handle_raw
        procedure, private :: share
        procedure, private :: adopt
        generic, public :: assignment(=) => share
        final :: handle_finalise
    end type pdn_handle

    ! A function of time, from pdn_constant_signal, pdn_harmonics_signal, ..., with the numbers that
    ! it was given.
    type :: pdn_signal
        private
        type(c_signal) :: raw
        real(c_double), allocatable :: cosines(:), sines(:), samples(:)
    end type pdn_signal

    ! Periodic motions along a parameter.
    type, extends(pdn_handle) :: pdn_branch
    contains
        procedure, public :: switch_branch => branch_switch_branch
        procedure, public :: follow_locus => branch_follow_locus
        procedure, public :: continue_branch => branch_continue_branch
        procedure, public :: save => branch_save
        procedure, public :: load => branch_load
        procedure, public :: end => branch_end
        procedure, public :: report => branch_report
        procedure, public :: count => branch_count
        procedure, public :: get => branch_get
        procedure, public :: solution => branch_solution
        procedure, public :: write_csv => branch_write_csv
        procedure, public :: write_campbell => branch_write_campbell
    end type pdn_branch

    ! Free parameters, and as many conditions.
    type, extends(pdn_handle) :: pdn_conditions
    contains
        procedure, public :: new => conditions_new
        procedure, public :: release => conditions_release
        procedure, public :: add_phase => conditions_add_phase
        procedure, public :: add_rotation_phase => conditions_add_rotation_phase
        procedure, public :: add_translation_phase => conditions_add_translation_phase
        procedure, public :: add_quantity => conditions_add_quantity
        procedure, public :: add_joint_coordinate => conditions_add_joint_coordinate
        procedure, public :: add_energy => conditions_add_energy
        procedure, public :: add_momentum => conditions_add_momentum
        procedure, public :: add_angular_momentum => conditions_add_angular_momentum
    end type pdn_conditions

    ! The equations of a periodic motion on a grid, or a rank's part of them.
    type, extends(pdn_handle) :: pdn_equations
    contains
        procedure, public :: new => equations_new
        procedure, public :: get_sizes => equations_get_sizes
        procedure, public :: nodes => equations_nodes
        procedure, public :: numbers => equations_numbers
        procedure, public :: state => equations_state
        procedure, public :: set_state => equations_set_state
        procedure, public :: residual => equations_residual
        procedure, public :: linearise => equations_linearise
        procedure, public :: product => equations_product
        procedure, public :: transposed_product => equations_transposed_product
        procedure, public :: power_product => equations_power_product
        procedure, public :: factor => equations_factor
        procedure, public :: precondition => equations_precondition
        procedure, public :: compliance => equations_compliance
        procedure, public :: update => equations_update
        procedure, public :: norms => equations_norms
        procedure, public :: solution => equations_solution
    end type pdn_equations

    ! A mechanism.
    type, extends(pdn_handle) :: pdn_model
    contains
        procedure, public :: new => model_new
        procedure, public :: node_count => model_node_count
        procedure, public :: joint_count => model_joint_count
        procedure, public :: element_count => model_element_count
        procedure, public :: mass => model_mass
        procedure, public :: node_frame => model_node_frame
        procedure, public :: add_node => model_add_node
        procedure, public :: add_rigid_body => model_add_rigid_body
        procedure, public :: add_mass => model_add_mass
        procedure, public :: add_inertia => model_add_inertia
        procedure, public :: prescribe => model_prescribe
        procedure, public :: add_rigid_joint => model_add_rigid_joint
        procedure, public :: add_revolute => model_add_revolute
        procedure, public :: add_prismatic => model_add_prismatic
        procedure, public :: add_cylindrical => model_add_cylindrical
        procedure, public :: add_screw => model_add_screw
        procedure, public :: add_planar => model_add_planar
        procedure, public :: add_free_joint => model_add_free_joint
        procedure, public :: add_spherical => model_add_spherical
        procedure, public :: add_universal => model_add_universal
        procedure, public :: add_strut => model_add_strut
        procedure, public :: add_joint => model_add_joint
        procedure, public :: add_screw_between => model_add_screw_between
        procedure, public :: relation_count => model_relation_count
        procedure, public :: add_relation => model_add_relation
        procedure, public :: add_beam_element => model_add_beam_element
        procedure, public :: add_straight_beam => model_add_straight_beam
        procedure, public :: add_beam => model_add_beam
        procedure, public :: add_beam_between => model_add_beam_between
        procedure, public :: add_load => model_add_load
        procedure, public :: add_load_at_point => model_add_load_at_point
        procedure, public :: add_load_on_beam => model_add_load_on_beam
        procedure, public :: set_gravity => model_set_gravity
        procedure, public :: set_gravity_signals => model_set_gravity_signals
        procedure, public :: add_distributed_load => model_add_distributed_load
        procedure, public :: add_load_at_places => model_add_load_at_places
        procedure, public :: set_turning_frame => model_set_turning_frame
        procedure, public :: turning_frame => model_turning_frame
        procedure, public :: set_frame_advance => model_set_frame_advance
        procedure, public :: frame_advance => model_frame_advance
        procedure, public :: set_spin => model_set_spin
        procedure, public :: spin => model_spin
        procedure, public :: set_beam_spin => model_set_beam_spin
        procedure, public :: beam_spin => model_beam_spin
        procedure, public :: set_rotor_symmetry => model_set_rotor_symmetry
        procedure, public :: rotor_symmetry => model_rotor_symmetry
        procedure, public :: rotor_node => model_rotor_node
        procedure, public :: add_shell_element => model_add_shell_element
        procedure, public :: add_shell => model_add_shell
        procedure, public :: add_shell_grid => model_add_shell_grid
        procedure, public :: add_shell_quadrilaterals => model_add_shell_quadrilaterals
        procedure, public :: shell_patch_node => model_shell_patch_node
        procedure, public :: shell_element_count => model_shell_element_count
        procedure, public :: shell_node => model_shell_node
        procedure, public :: add_shell_load => model_add_shell_load
        procedure, public :: set_shell_prestress => model_set_shell_prestress
        procedure, public :: add_rigid_joints => model_add_rigid_joints
        procedure, public :: add_rigid_edge => model_add_rigid_edge
        procedure, public :: force_count => model_force_count
        procedure, public :: add_spring_damper => model_add_spring_damper
        procedure, public :: add_nonlinear_spring_damper => model_add_nonlinear_spring_damper
        procedure, public :: add_actuator => model_add_actuator
        procedure, public :: add_viscoelastic => model_add_viscoelastic
        procedure, public :: add_viscous_damper => model_add_viscous_damper
        procedure, public :: add_bushing => model_add_bushing
        procedure, public :: add_coordinate_law => model_add_coordinate_law
        procedure, public :: add_user_force => model_add_user_force
        procedure, public :: declare_nodes_apart => model_declare_nodes_apart
        procedure, public :: check_tangents => model_check_tangents
        procedure, public :: add_controller => model_add_controller
        procedure, public :: controller_counts => model_controller_counts
        procedure, public :: controller_coordinate => model_controller_coordinate
        procedure, public :: controller_state => model_controller_state
        procedure, public :: add_surface_force => model_add_surface_force
        procedure, public :: add_line_force => model_add_line_force
        procedure, public :: bind_controller => model_bind_controller
        procedure, public :: bind_coordinate_law => model_bind_coordinate_law
        procedure, public :: bind_user_force => model_bind_user_force
        procedure, public :: bind_surface_force => model_bind_surface_force
        procedure, public :: set_signal => model_set_signal
        procedure, public :: set_force_numbers => model_set_force_numbers
        procedure, public :: set_load_frame => model_set_load_frame
        procedure, public :: set_beam_section => model_set_beam_section
        procedure, public :: set_shell_section => model_set_shell_section
        procedure, public :: set_inertia => model_set_inertia
        procedure, public :: set_label => model_set_label
        procedure, public :: label => model_label
        procedure, public :: find_label => model_find_label
        procedure, public :: solve_periodic => model_solve_periodic
        procedure, public :: add_parameter => model_add_parameter
        procedure, public :: parameter_count => model_parameter_count
        procedure, public :: parameter => model_parameter
        procedure, public :: parameter_name => model_parameter_name
        procedure, public :: find_parameter => model_find_parameter
        procedure, public :: move_number => model_move_number
        procedure, public :: move_signal => model_move_signal
        procedure, public :: set_parameter => model_set_parameter
        procedure, public :: set_mass_damping => model_set_mass_damping
        procedure, public :: declare_of_phase => model_declare_of_phase
        procedure, public :: joint => model_joint
        procedure, public :: force => model_force
        procedure, public :: force_number => model_force_number
        procedure, public :: force_node => model_force_node
        procedure, public :: beam_element_node_count => model_beam_element_node_count
        procedure, public :: beam_element_node => model_beam_element_node
        procedure, public :: beam_section => model_beam_section
        procedure, public :: inertia_count => model_inertia_count
        procedure, public :: inertia => model_inertia
        procedure, public :: inertia_of => model_inertia_of
        procedure, public :: prescribed => model_prescribed
        procedure, public :: relation_term_count => model_relation_term_count
        procedure, public :: relation_term => model_relation_term
        procedure, public :: sample_signal => model_sample_signal
        procedure, public :: load_count => model_load_count
        procedure, public :: load_at => model_load_at
        procedure, public :: beam_load_count => model_beam_load_count
        procedure, public :: beam_load => model_beam_load
        procedure, public :: beam_load_factor => model_beam_load_factor
        procedure, public :: shell_load_count => model_shell_load_count
        procedure, public :: shell_load => model_shell_load
        procedure, public :: solve_conditioned => model_solve_conditioned
        procedure, public :: follow_branch => model_follow_branch
        procedure, public :: solve_frequency_response => model_solve_frequency_response
        procedure, public :: solve_static => model_solve_static
        procedure, public :: solve_modes => model_solve_modes
        procedure, public :: solve_march => model_solve_march
        procedure, public :: solve_shooting => model_solve_shooting
        procedure, public :: summary => model_summary
        procedure, public :: describe => model_describe
        procedure, public :: copy => model_copy
        procedure, public :: save => model_save
        procedure, public :: load => model_load
    end type pdn_model

    ! An equilibrium and the modes about it.
    type, extends(pdn_handle) :: pdn_modes
    contains
        procedure, public :: outcome => modes_outcome
        procedure, public :: converged => modes_converged
        procedure, public :: report => modes_report
        procedure, public :: count => modes_count
        procedure, public :: get => modes_get
        procedure, public :: shape => modes_shape
        procedure, public :: motion => modes_motion
        procedure, public :: equilibrium => modes_equilibrium
    end type pdn_modes

    ! What is differentiated, by what.
    type, extends(pdn_handle) :: pdn_sensitivities
    contains
        procedure, public :: new => sensitivities_new
        procedure, public :: add_quantity => sensitivities_add_quantity
        procedure, public :: add_found => sensitivities_add_found
        procedure, public :: add_parameter => sensitivities_add_parameter
    end type pdn_sensitivities

    ! A solution, converged or not.
    type, extends(pdn_handle) :: pdn_solution
    contains
        procedure, public :: outcome => solution_outcome
        procedure, public :: converged => solution_converged
        procedure, public :: report => solution_report
        procedure, public :: report_json => solution_report_json
        procedure, public :: diagnostics => solution_diagnostics
        procedure, public :: history => solution_history
        procedure, public :: decay => solution_decay
        procedure, public :: sharp_event_count => solution_sharp_event_count
        procedure, public :: sharp_events => solution_sharp_events
        procedure, public :: grid_times => solution_grid_times
        procedure, private :: solution_sample, solution_sample_flat
        generic, public :: sample => solution_sample, solution_sample_flat
        procedure, public :: harmonics => solution_harmonics
        procedure, public :: extremes => solution_extremes
        procedure, public :: filtered => solution_filtered
        procedure, public :: parameter => solution_parameter
        procedure, public :: sensitivities => solution_sensitivities
        procedure, public :: multiplier_sensitivities => solution_multiplier_sensitivities
        procedure, public :: march => solution_march
        procedure, public :: floquet_count => solution_floquet_count
        procedure, public :: floquet => solution_floquet
        procedure, public :: solve_stability => solution_solve_stability
        procedure, public :: write_vtk => solution_write_vtk
        procedure, public :: save => solution_save
        procedure, public :: load => solution_load
        procedure, public :: model => solution_model
    end type pdn_solution

    ! Floquet multipliers of a periodic solution.
    type, extends(pdn_handle) :: pdn_stability
    contains
        procedure, public :: outcome => stability_outcome
        procedure, public :: converged => stability_converged
        procedure, public :: verdict => stability_verdict
        procedure, public :: count => stability_count
        procedure, public :: get => stability_get
        procedure, public :: time_count => stability_time_count
        procedure, public :: times => stability_times
        procedure, public :: shape => stability_shape
        procedure, public :: report => stability_report
    end type pdn_stability

    ! Columns of numbers over the same times.
    type, extends(pdn_handle) :: pdn_table
    contains
        procedure, public :: add_quantity => table_add_quantity
        procedure, public :: new => table_new
        procedure, public :: add_values => table_add_values
        procedure, public :: write_csv => table_write_csv
    end type pdn_table

    ! Sets the defaults of a struct.
    interface pdn_init
        procedure init_section, init_line, init_stations, init_surface, init_shell_section, &
            init_shell_placement, init_tangent_check, init_diagnostics, init_quantity, &
            init_periodic_options, init_equations_options, init_equations_sizes, &
            init_joint_info, init_force_info, init_sensitivity_options, init_branch_point, &
            init_branch_options, init_stability_options, init_static_options, &
            init_modes_options, init_mode, init_march_options, init_march_diagnostics, &
            init_shooting_options, init_multiplier, init_summary
    end interface pdn_init

    interface pdn_version
        procedure version
    end interface pdn_version
    interface pdn_version_check
        procedure version_check
    end interface pdn_version_check
    interface pdn_build_info
        procedure build_info
    end interface pdn_build_info
    interface pdn_status_name
        procedure status_name
    end interface pdn_status_name
    interface pdn_status_message
        procedure status_message
    end interface pdn_status_message
    interface pdn_last_error
        procedure last_error
    end interface pdn_last_error
    interface pdn_set_last_error
        procedure set_last_error
    end interface pdn_set_last_error
    interface pdn_set_callback_error
        procedure set_callback_error
    end interface pdn_set_callback_error
    interface pdn_release_memory
        procedure release_memory
    end interface pdn_release_memory
    interface pdn_section_set_component_damping
        procedure section_set_component_damping
    end interface pdn_section_set_component_damping
    interface pdn_section_set_proportional_damping
        procedure section_set_proportional_damping
    end interface pdn_section_set_proportional_damping
    interface pdn_shell_section_set_proportional_damping
        procedure shell_section_set_proportional_damping
    end interface pdn_shell_section_set_proportional_damping
    interface pdn_motion_interpolate
        procedure motion_interpolate
    end interface pdn_motion_interpolate
    interface pdn_motion_grid_kinematics
        procedure motion_grid_kinematics
    end interface pdn_motion_grid_kinematics
    interface pdn_joint_frame
        procedure joint_frame
    end interface pdn_joint_frame

    private :: init_section, init_line, init_stations, init_surface, init_shell_section, &
        init_shell_placement, init_tangent_check, init_diagnostics, init_quantity, &
        init_periodic_options, init_equations_options, init_equations_sizes, init_joint_info, &
        init_force_info, init_sensitivity_options, init_branch_point, init_branch_options, &
        init_stability_options, init_static_options, init_modes_options, init_mode, &
        init_march_options, init_march_diagnostics, init_shooting_options, init_multiplier, &
        init_summary, version, version_check, build_info, status_name, status_message, &
        last_error, set_last_error, set_callback_error, release_memory, &
        section_set_component_damping, section_set_proportional_damping, &
        shell_section_set_proportional_damping, motion_interpolate, motion_grid_kinematics, &
        joint_frame, branch_switch_branch, branch_follow_locus, branch_continue_branch, &
        branch_save, branch_load, branch_end, branch_report, branch_count, branch_get, &
        branch_solution, branch_write_csv, branch_write_campbell, conditions_new, &
        conditions_release, conditions_add_phase, conditions_add_rotation_phase, &
        conditions_add_translation_phase, conditions_add_quantity, &
        conditions_add_joint_coordinate, conditions_add_energy, conditions_add_momentum, &
        conditions_add_angular_momentum, equations_new, equations_get_sizes, equations_nodes, &
        equations_numbers, equations_state, equations_set_state, equations_residual, &
        equations_linearise, equations_product, equations_transposed_product, &
        equations_power_product, equations_factor, equations_precondition, equations_compliance, &
        equations_update, equations_norms, equations_solution, model_new, model_node_count, &
        model_joint_count, model_element_count, model_mass, model_node_frame, model_add_node, &
        model_add_rigid_body, model_add_mass, model_add_inertia, model_prescribe, &
        model_add_rigid_joint, model_add_revolute, model_add_prismatic, model_add_cylindrical, &
        model_add_screw, model_add_planar, model_add_free_joint, model_add_spherical, &
        model_add_universal, model_add_strut, model_add_joint, model_add_screw_between, &
        model_relation_count, model_add_relation, model_add_beam_element, &
        model_add_straight_beam, model_add_beam, model_add_beam_between, model_add_load, &
        model_add_load_at_point, model_add_load_on_beam, model_set_gravity, &
        model_set_gravity_signals, model_add_distributed_load, model_add_load_at_places, &
        model_set_turning_frame, model_turning_frame, model_set_frame_advance, &
        model_frame_advance, model_set_spin, model_spin, model_set_beam_spin, model_beam_spin, &
        model_set_rotor_symmetry, model_rotor_symmetry, model_rotor_node, &
        model_add_shell_element, model_add_shell, model_add_shell_grid, &
        model_add_shell_quadrilaterals, model_shell_patch_node, model_shell_element_count, &
        model_shell_node, model_add_shell_load, model_set_shell_prestress, &
        model_add_rigid_joints, model_add_rigid_edge, model_force_count, &
        model_add_spring_damper, model_add_nonlinear_spring_damper, model_add_actuator, &
        model_add_viscoelastic, model_add_viscous_damper, model_add_bushing, &
        model_add_coordinate_law, model_add_user_force, model_declare_nodes_apart, &
        model_check_tangents, model_add_controller, model_controller_counts, &
        model_controller_coordinate, model_controller_state, model_add_surface_force, &
        model_add_line_force, model_bind_controller, model_bind_coordinate_law, &
        model_bind_user_force, model_bind_surface_force, model_set_signal, &
        model_set_force_numbers, model_set_load_frame, model_set_beam_section, &
        model_set_shell_section, model_set_inertia, model_set_label, model_label, &
        model_find_label, model_solve_periodic, model_add_parameter, model_parameter_count, &
        model_parameter, model_parameter_name, model_find_parameter, model_move_number, &
        model_move_signal, model_set_parameter, model_set_mass_damping, model_declare_of_phase, &
        model_joint, model_force, model_force_number, model_force_node, &
        model_beam_element_node_count, model_beam_element_node, model_beam_section, &
        model_inertia_count, model_inertia, model_inertia_of, model_prescribed, &
        model_relation_term_count, model_relation_term, model_sample_signal, model_load_count, &
        model_load_at, model_beam_load_count, model_beam_load, model_beam_load_factor, &
        model_shell_load_count, model_shell_load, model_solve_conditioned, model_follow_branch, &
        model_solve_frequency_response, model_solve_static, model_solve_modes, &
        model_solve_march, model_solve_shooting, model_summary, model_describe, model_copy, &
        model_save, model_load, modes_outcome, modes_converged, modes_report, modes_count, &
        modes_get, modes_shape, modes_motion, modes_equilibrium, sensitivities_new, &
        sensitivities_add_quantity, sensitivities_add_found, sensitivities_add_parameter, &
        solution_outcome, solution_converged, solution_report, solution_report_json, &
        solution_diagnostics, solution_history, solution_decay, solution_sharp_event_count, &
        solution_sharp_events, solution_grid_times, solution_sample, solution_sample_flat, &
        solution_harmonics, solution_extremes, solution_filtered, solution_parameter, &
        solution_sensitivities, solution_multiplier_sensitivities, solution_march, &
        solution_floquet_count, solution_floquet, solution_solve_stability, solution_write_vtk, &
        solution_save, solution_load, solution_model, stability_outcome, stability_converged, &
        stability_verdict, stability_count, stability_get, stability_time_count, &
        stability_times, stability_shape, stability_report, table_add_quantity, table_new, &
        table_add_values, table_write_csv

contains

    ! Failure ----------------------------------------------------------------------------------

    ! Hands a status on to the caller, with the library's message if it is a failure.
    subroutine report(status, stat, errmsg)
        integer(c_int32_t), intent(in) :: status
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg

        if (present(stat)) stat = status
        if (status == PDN_OK) return
        if (present(errmsg)) errmsg = pdn_last_error()
        if (present(stat)) return
        write (error_unit, '(4a)') 'periodyn: ', pdn_status_name(status), ': ', pdn_last_error()
        error stop 1
    end subroutine report

    ! Whether an array has the shape that it must have; otherwise refuses it. What is negative is
    ! not known, for a reason that the call tells.
    logical function fits(name, found, expected, stat, errmsg)
        character(*), intent(in) :: name
        integer, intent(in) :: found(:), expected(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        character(200) :: message

        fits = any(expected < 0) .or. all(found == expected)
        if (fits) return
        write (message, '(2a, *(i0, :, " x "))') name, ': expected the shape ', expected
        write (message(len_trim(message) + 1:), '(a, *(i0, :, " x "))') ', got ', found
        call set_last_error(message)
        call report(PDN_ERR_SIZE, stat, errmsg)
    end function fits

    ! Number of nodes of a model; negative if there is no model.
    integer function nodes_of(model)
        class(pdn_handle), intent(in) :: model

        if (pdn_model_node_count(model%c, nodes_of) /= PDN_OK) nodes_of = -1
    end function nodes_of

    ! Signals ----------------------------------------------------------------------------------

    ! A signal as the library takes it, while it is there.
    impure elemental type(c_signal) function raw_of(signal)
        type(pdn_signal), intent(in), target :: signal

        raw_of = signal%raw
        if (allocated(signal%cosines)) raw_of%cosines = c_loc(signal%cosines)
        if (allocated(signal%sines)) raw_of%sines = c_loc(signal%sines)
        if (allocated(signal%samples)) raw_of%samples = c_loc(signal%samples)
    end function raw_of

    ! Quantities -------------------------------------------------------------------------------

    ! What is asked of a solution, of one of the kinds PDN_NODE_POSITION, ..., of a node, joint,
    ! beam element or force; other fields may then be set.
    function pdn_quantity_of(kind, object, component, frame, node, branch, station) &
        result(quantity)
        integer(c_int32_t), intent(in) :: kind, object
        integer(c_int32_t), intent(in), optional :: component, frame, node, branch
        real(c_double), intent(in), optional :: station
        type(pdn_quantity) :: quantity

        call pdn_init(quantity)
        quantity%kind = kind
        quantity%object = object
        if (present(component)) quantity%component = component
        if (present(frame)) quantity%frame = frame
        if (present(node)) quantity%node = node
        if (present(branch)) quantity%branch = branch
        if (present(station)) quantity%station = station
    end function pdn_quantity_of

    ! Texts ---------------------------------------------------------------------------------------

    function text_at(pointer) result(text)
        type(c_ptr), intent(in) :: pointer
        character(:), allocatable :: text
        character(kind=c_char), pointer :: characters(:)

        call c_f_pointer(pointer, characters, [huge(1)])
        text = ''
        do while (characters(len(text) + 1) /= c_null_char)
            text = text//characters(len(text) + 1)
        end do
    end function text_at

    ! Handles ----------------------------------------------------------------------------------

    ! Gives up the object; frees it if this was its last variable.
    subroutine handle_free(self)
        class(pdn_handle), intent(inout) :: self

        if (associated(self%owners)) then
            self%owners = self%owners - 1
            if (self%owners == 0) then
                deallocate (self%owners)
                call self%release_with(self%c)
            end if
        end if
        self%c = c_null_ptr
        self%owners => null()
    end subroutine handle_free

    subroutine handle_finalise(self)
        type(pdn_handle), intent(inout) :: self

        call self%free()
    end subroutine handle_finalise

    ! The handle for procedures of periodyn_c; null if there is none.
    type(c_ptr) function handle_raw(self)
        class(pdn_handle), intent(in) :: self

        handle_raw = self%c
    end function handle_raw

    ! Takes over a handle of the library, if it gave one, in place of what was held.
    subroutine adopt(self, c, release_with)
        class(pdn_handle), intent(inout) :: self
        type(c_ptr), intent(in) :: c
        procedure(pdn_destroy_fn) :: release_with

        if (.not. c_associated(c)) return
        call self%free()
        self%c = c
        self%release_with => release_with
        allocate (self%owners, source=1)
    end subroutine adopt

    subroutine share(left, right)
        class(pdn_handle), intent(inout) :: left
        class(pdn_handle), intent(in) :: right

        if (.not. same_type_as(left, right)) then
            call set_last_error('assignment: expected objects of the same type')
            call report(PDN_ERR_VALUE)
        end if
        if (associated(right%owners)) right%owners = right%owners + 1
        call left%free()
        left%c = right%c
        left%owners => right%owners
        left%release_with => right%release_with
    end subroutine share

    ! The functions of periodyn.h --------------------------------------------------------------

    ! Makes a section with no stiffness, mass or damping.
    subroutine init_section(section)
        type(pdn_section), intent(out) :: section

        call pdn_section_init(section, c_sizeof(section))
    end subroutine init_section

    ! Makes a line that is still to be set.
    subroutine init_line(line)
        type(pdn_line), intent(out) :: line

        call pdn_line_init(line, c_sizeof(line))
    end subroutine init_line

    ! Makes stations that are still to be set.
    subroutine init_stations(stations)
        type(pdn_stations), intent(out) :: stations

        call pdn_stations_init(stations, c_sizeof(stations))
    end subroutine init_stations

    ! Makes a surface that is still to be set.
    subroutine init_surface(surface)
        type(pdn_surface), intent(out) :: surface

        call pdn_surface_init(surface, c_sizeof(surface))
    end subroutine init_surface

    ! Makes a section with no stiffness, mass or damping.
    subroutine init_shell_section(shell_section)
        type(pdn_shell_section), intent(out) :: shell_section

        call pdn_shell_section_init(shell_section, c_sizeof(shell_section))
    end subroutine init_shell_section

    ! Sets the defaults.
    subroutine init_shell_placement(shell_placement)
        type(pdn_shell_placement), intent(out) :: shell_placement

        call pdn_shell_placement_init(shell_placement, c_sizeof(shell_placement))
    end subroutine init_shell_placement

    ! Prepares a struct for check_tangents; use PDN_INIT(pdn_tangent_check, &check).
    subroutine init_tangent_check(tangent_check)
        type(pdn_tangent_check), intent(out) :: tangent_check

        call pdn_tangent_check_init(tangent_check, c_sizeof(tangent_check))
    end subroutine init_tangent_check

    ! Prepares a struct for diagnostics; use PDN_INIT(pdn_diagnostics, &diagnostics).
    subroutine init_diagnostics(diagnostics)
        type(pdn_diagnostics), intent(out) :: diagnostics

        call pdn_diagnostics_init(diagnostics, c_sizeof(diagnostics))
    end subroutine init_diagnostics

    ! Prepares a struct that tells a quantity; use PDN_INIT(pdn_quantity, &quantity).
    subroutine init_quantity(quantity)
        type(pdn_quantity), intent(out) :: quantity

        call pdn_quantity_init(quantity, c_sizeof(quantity))
    end subroutine init_quantity

    ! Sets default options; use PDN_INIT(pdn_periodic_options, &options).
    subroutine init_periodic_options(periodic_options)
        type(pdn_periodic_options), intent(out) :: periodic_options

        call pdn_periodic_options_init(periodic_options, c_sizeof(periodic_options))
    end subroutine init_periodic_options

    ! Sets default options; use PDN_INIT(pdn_equations_options, &options).
    subroutine init_equations_options(equations_options)
        type(pdn_equations_options), intent(out) :: equations_options

        call pdn_equations_options_init(equations_options, c_sizeof(equations_options))
    end subroutine init_equations_options

    ! Sets struct_size; use PDN_INIT(pdn_equations_sizes, &sizes).
    subroutine init_equations_sizes(equations_sizes)
        type(pdn_equations_sizes), intent(out) :: equations_sizes

        call pdn_equations_sizes_init(equations_sizes, c_sizeof(equations_sizes))
    end subroutine init_equations_sizes

    ! Prepares a struct for joint; use PDN_INIT(pdn_joint_info, &info).
    subroutine init_joint_info(joint_info)
        type(pdn_joint_info), intent(out) :: joint_info

        call pdn_joint_info_init(joint_info, c_sizeof(joint_info))
    end subroutine init_joint_info

    ! Prepares a struct for force; use PDN_INIT(pdn_force_info, &info).
    subroutine init_force_info(force_info)
        type(pdn_force_info), intent(out) :: force_info

        call pdn_force_info_init(force_info, c_sizeof(force_info))
    end subroutine init_force_info

    ! Sets default options; use PDN_INIT(pdn_sensitivity_options, &options).
    subroutine init_sensitivity_options(sensitivity_options)
        type(pdn_sensitivity_options), intent(out) :: sensitivity_options

        call pdn_sensitivity_options_init(sensitivity_options, c_sizeof(sensitivity_options))
    end subroutine init_sensitivity_options

    ! Sets a point to that of nothing; use PDN_INIT(pdn_branch_point, &point).
    subroutine init_branch_point(branch_point)
        type(pdn_branch_point), intent(out) :: branch_point

        call pdn_branch_point_init(branch_point, c_sizeof(branch_point))
    end subroutine init_branch_point

    ! Sets default options; use PDN_INIT(pdn_branch_options, &options).
    subroutine init_branch_options(branch_options)
        type(pdn_branch_options), intent(out) :: branch_options

        call pdn_branch_options_init(branch_options, c_sizeof(branch_options))
    end subroutine init_branch_options

    ! Sets default options; use PDN_INIT(pdn_stability_options, &options).
    subroutine init_stability_options(stability_options)
        type(pdn_stability_options), intent(out) :: stability_options

        call pdn_stability_options_init(stability_options, c_sizeof(stability_options))
    end subroutine init_stability_options

    ! Sets default options; use PDN_INIT(pdn_static_options, &options).
    subroutine init_static_options(static_options)
        type(pdn_static_options), intent(out) :: static_options

        call pdn_static_options_init(static_options, c_sizeof(static_options))
    end subroutine init_static_options

    ! Sets default options; use PDN_INIT(pdn_modes_options, &options).
    subroutine init_modes_options(modes_options)
        type(pdn_modes_options), intent(out) :: modes_options

        call pdn_modes_options_init(modes_options, c_sizeof(modes_options))
    end subroutine init_modes_options

    ! Prepares a struct for get; use PDN_INIT(pdn_mode, &mode).
    subroutine init_mode(mode)
        type(pdn_mode), intent(out) :: mode

        call pdn_mode_init(mode, c_sizeof(mode))
    end subroutine init_mode

    ! Sets default options; use PDN_INIT(pdn_march_options, &options).
    subroutine init_march_options(march_options)
        type(pdn_march_options), intent(out) :: march_options

        call pdn_march_options_init(march_options, c_sizeof(march_options))
    end subroutine init_march_options

    ! Prepares a struct for march; use PDN_INIT(pdn_march_diagnostics, &diagnostics).
    subroutine init_march_diagnostics(march_diagnostics)
        type(pdn_march_diagnostics), intent(out) :: march_diagnostics

        call pdn_march_diagnostics_init(march_diagnostics, c_sizeof(march_diagnostics))
    end subroutine init_march_diagnostics

    ! Sets default options; use PDN_INIT(pdn_shooting_options, &options).
    subroutine init_shooting_options(shooting_options)
        type(pdn_shooting_options), intent(out) :: shooting_options

        call pdn_shooting_options_init(shooting_options, c_sizeof(shooting_options))
    end subroutine init_shooting_options

    ! Prepares a struct for get; use PDN_INIT(pdn_multiplier, &multiplier).
    subroutine init_multiplier(multiplier)
        type(pdn_multiplier), intent(out) :: multiplier

        call pdn_multiplier_init(multiplier, c_sizeof(multiplier))
    end subroutine init_multiplier

    ! Prepares a struct for summary; use PDN_INIT(pdn_summary, &summary).
    subroutine init_summary(summary)
        type(pdn_summary), intent(out) :: summary

        call pdn_summary_init(summary, c_sizeof(summary))
    end subroutine init_summary

    ! Describes a section without couplings: centroid, shear centre and centre of mass lie on the
    ! beam's line, and axes 2 and 3 are principal.
    function pdn_diagonal_section(stiffness, mass, stat, errmsg) result(section)
        real(c_double), intent(in) :: stiffness(6), mass(4)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(pdn_section) :: section
        integer(c_int32_t) :: status

        call pdn_section_init(section, c_sizeof(section))
        status = pdn_section_set_diagonal(section, stiffness, mass)
        call report(status, stat, errmsg)
    end function pdn_diagonal_section

    ! Makes a signal constant.
    function pdn_constant_signal(value, stat, errmsg) result(signal)
        real(c_double), intent(in) :: value
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(pdn_signal) :: signal
        integer(c_int32_t) :: status

        call pdn_signal_init(signal%raw, c_sizeof(signal%raw))
        status = pdn_signal_set_constant(signal%raw, value)
        call report(status, stat, errmsg)
    end function pdn_constant_signal

    ! Makes a signal of harmonics, mean and rate.
    function pdn_harmonics_signal(mean, rate, cosines, sines, stat, errmsg) result(signal)
        real(c_double), intent(in), optional :: mean, rate
        real(c_double), intent(in), contiguous, optional :: cosines(:), sines(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(pdn_signal) :: signal
        integer(c_size_t) :: count
        real(c_double) :: raw_mean, raw_rate
        integer(c_int32_t) :: status

        call pdn_signal_init(signal%raw, c_sizeof(signal%raw))
        count = 0
        if (present(sines)) count = size(sines, 1, c_size_t)
        if (present(cosines)) count = size(cosines, 1, c_size_t)
        raw_mean = 0.0_c_double
        if (present(mean)) raw_mean = mean
        raw_rate = 0.0_c_double
        if (present(rate)) raw_rate = rate
        if (present(cosines)) signal%cosines = cosines
        if (present(sines)) then
            if (.not. fits('sines', shape(sines), [int(count)], stat, errmsg)) return
        end if
        if (present(sines)) signal%sines = sines
        status = pdn_signal_set_harmonics(signal%raw, raw_mean, raw_rate, cosines, sines, count)
        call report(status, stat, errmsg)
    end function pdn_harmonics_signal

    ! Makes a signal rate t plus the trigonometric interpolation of samples[k] at t = k T / count.
    function pdn_samples_signal(samples, rate, stat, errmsg) result(signal)
        real(c_double), intent(in), contiguous :: samples(:)
        real(c_double), intent(in), optional :: rate
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(pdn_signal) :: signal
        integer(c_size_t) :: count
        real(c_double) :: raw_rate
        integer(c_int32_t) :: status

        call pdn_signal_init(signal%raw, c_sizeof(signal%raw))
        count = size(samples, 1, c_size_t)
        raw_rate = 0.0_c_double
        if (present(rate)) raw_rate = rate
        signal%samples = samples
        status = pdn_signal_set_samples(signal%raw, raw_rate, samples, count)
        call report(status, stat, errmsg)
    end function pdn_samples_signal

    ! Makes a signal a function of the caller.
    function pdn_function_signal(function, user_data, stat, errmsg) result(signal)
        procedure(pdn_signal_fn) :: function
        type(c_ptr), intent(in), optional :: user_data
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(pdn_signal) :: signal
        type(c_ptr) :: raw_user_data
        integer(c_int32_t) :: status

        call pdn_signal_init(signal%raw, c_sizeof(signal%raw))
        raw_user_data = c_null_ptr
        if (present(user_data)) raw_user_data = user_data
        status = pdn_signal_set_function(signal%raw, c_funloc(function), raw_user_data)
        call report(status, stat, errmsg)
    end function pdn_function_signal

    ! Makes a signal a function of the caller, of the phase 2 pi t / T [radians], which it is told
    ! in place of the time: it holds for any period T.
    function pdn_function_of_phase_signal(function, user_data, stat, errmsg) result(signal)
        procedure(pdn_signal_fn) :: function
        type(c_ptr), intent(in), optional :: user_data
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(pdn_signal) :: signal
        type(c_ptr) :: raw_user_data
        integer(c_int32_t) :: status

        call pdn_signal_init(signal%raw, c_sizeof(signal%raw))
        raw_user_data = c_null_ptr
        if (present(user_data)) raw_user_data = user_data
        status = pdn_signal_set_function_of_phase(signal%raw, c_funloc(function), raw_user_data)
        call report(status, stat, errmsg)
    end function pdn_function_of_phase_signal

    ! Makes a line straight.
    function pdn_straight_line(start, end, axis_2, stat, errmsg) result(line)
        real(c_double), intent(in) :: start(3), end(3), axis_2(3)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(pdn_line) :: line
        integer(c_int32_t) :: status

        call pdn_line_init(line, c_sizeof(line))
        status = pdn_line_set_straight(line, start, end, axis_2)
        call report(status, stat, errmsg)
    end function pdn_straight_line

    ! Makes a line the circular arc from start through point to end, of up to a whole turn.
    function pdn_arc_line(start, point, end, axis_2, stat, errmsg) result(line)
        real(c_double), intent(in) :: start(3), point(3), end(3), axis_2(3)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(pdn_line) :: line
        integer(c_int32_t) :: status

        call pdn_line_init(line, c_sizeof(line))
        status = pdn_line_set_arc(line, start, point, end, axis_2)
        call report(status, stat, errmsg)
    end function pdn_arc_line

    ! Makes a line a curve that the caller computes.
    function pdn_curve_line(curve, user_data, stat, errmsg) result(line)
        procedure(pdn_curve_fn) :: curve
        type(c_ptr), intent(in), optional :: user_data
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(pdn_line) :: line
        type(c_ptr) :: raw_user_data
        integer(c_int32_t) :: status

        call pdn_line_init(line, c_sizeof(line))
        raw_user_data = c_null_ptr
        if (present(user_data)) raw_user_data = user_data
        status = pdn_line_set_curve(line, c_funloc(curve), raw_user_data)
        call report(status, stat, errmsg)
    end function pdn_curve_line

    ! Makes a surface a parallelogram, such as a rectangle.
    function pdn_parallelogram_surface(corner, along_u, along_v, stat, errmsg) result(surface)
        real(c_double), intent(in) :: corner(3), along_u(3), along_v(3)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(pdn_surface) :: surface
        integer(c_int32_t) :: status

        call pdn_surface_init(surface, c_sizeof(surface))
        status = pdn_surface_set_parallelogram(surface, corner, along_u, along_v)
        call report(status, stat, errmsg)
    end function pdn_parallelogram_surface

    ! Makes a surface an annulus or a sector of one: u from the inner to the outer radius, v
    ! around the axis.
    function pdn_annulus_surface(centre, axis, start, inner, outer, angle, stat, &
        errmsg) result(surface)
        real(c_double), intent(in) :: centre(3), axis(3), start(3), inner, outer, angle
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(pdn_surface) :: surface
        integer(c_int32_t) :: status

        call pdn_surface_init(surface, c_sizeof(surface))
        status = pdn_surface_set_annulus(surface, centre, axis, start, inner, outer, angle)
        call report(status, stat, errmsg)
    end function pdn_annulus_surface

    ! Makes a surface a cylinder or a sector of one: u around the axis, v along it.
    function pdn_cylinder_surface(centre, axis, start, radius, length, angle, stat, &
        errmsg) result(surface)
        real(c_double), intent(in) :: centre(3), axis(3), start(3), radius, length, angle
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(pdn_surface) :: surface
        integer(c_int32_t) :: status

        call pdn_surface_init(surface, c_sizeof(surface))
        status = pdn_surface_set_cylinder(surface, centre, axis, start, radius, length, angle)
        call report(status, stat, errmsg)
    end function pdn_cylinder_surface

    ! Makes a surface one that the caller computes, smooth within each element.
    function pdn_function_surface(function, user_data, stat, errmsg) result(surface)
        procedure(pdn_surface_fn) :: function
        type(c_ptr), intent(in), optional :: user_data
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(pdn_surface) :: surface
        type(c_ptr) :: raw_user_data
        integer(c_int32_t) :: status

        call pdn_surface_init(surface, c_sizeof(surface))
        raw_user_data = c_null_ptr
        if (present(user_data)) raw_user_data = user_data
        status = pdn_surface_set_function(surface, c_funloc(function), raw_user_data)
        call report(status, stat, errmsg)
    end function pdn_function_surface

    ! Makes a section that of one isotropic, linearly elastic material.
    function pdn_isotropic_shell_section(thickness, young, poisson, density, drilling, &
        drilling_gradient, stat, errmsg) result(shell_section)
        real(c_double), intent(in) :: thickness, young, poisson, density
        real(c_double), intent(in), optional :: drilling, drilling_gradient
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(pdn_shell_section) :: shell_section
        real(c_double) :: raw_drilling, raw_drilling_gradient
        integer(c_int32_t) :: status

        call pdn_shell_section_init(shell_section, c_sizeof(shell_section))
        raw_drilling = 1.0_c_double
        if (present(drilling)) raw_drilling = drilling
        raw_drilling_gradient = 0.1_c_double
        if (present(drilling_gradient)) raw_drilling_gradient = drilling_gradient
        status = pdn_shell_section_set_isotropic(shell_section, thickness, young, poisson, &
            density, raw_drilling, raw_drilling_gradient)
        call report(status, stat, errmsg)
    end function pdn_isotropic_shell_section

    ! Version of the library, such as "0.1.0".
    function version() result(text)
        character(:), allocatable :: text

        text = text_at(c_version())
    end function version

    ! Whether the library serves a program compiled with the header of version major.minor.
    subroutine version_check(major, minor, stat, errmsg)
        integer(c_int32_t), intent(in) :: major, minor
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: status

        status = c_version_check(major, minor)
        call report(status, stat, errmsg)
    end subroutine version_check

    ! How the library was built: version, profile and platform, for reports of defects.
    function build_info() result(text)
        character(:), allocatable :: text

        text = text_at(c_build_info())
    end function build_info

    ! Name of a status, such as "PDN_ERR_NULL".
    function status_name(status) result(text)
        integer(c_int32_t), intent(in) :: status
        character(:), allocatable :: text

        text = text_at(c_status_name(status))
    end function status_name

    ! One-line meaning of a status.
    function status_message(status) result(text)
        integer(c_int32_t), intent(in) :: status
        character(:), allocatable :: text

        text = text_at(c_status_message(status))
    end function status_message

    ! Message of the last call that failed on this thread: which argument, what was expected, what
    ! came.
    function last_error() result(text)
        character(:), allocatable :: text
        integer(c_size_t) :: length

        allocate (character(c_last_error(capacity=0_c_size_t) + 1) :: text)
        length = c_last_error(text, len(text, c_size_t))
        text = text(:length)
    end function last_error

    ! Sets the message that pdn_last_error gives on this thread: for libraries on top of this one,
    ! whose own functions fail.
    subroutine set_last_error(message, stat, errmsg)
        character(*), intent(in) :: message
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: status

        status = c_set_last_error(trim(message)//c_null_char)
        call report(status, stat, errmsg)
    end subroutine set_last_error

    ! To be called by a callback that is about to report failure: says why.
    subroutine set_callback_error(message, stat, errmsg)
        character(*), intent(in) :: message
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: status

        status = c_set_callback_error(trim(message)//c_null_char)
        call report(status, stat, errmsg)
    end subroutine set_callback_error

    ! Gives the system back the memory that the library keeps for later solves.
    subroutine release_memory(stat, errmsg)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: status

        status = c_release_memory()
        call report(status, stat, errmsg)
    end subroutine release_memory

    ! Gives a section damping with one time for each force and moment: damping = diag(seconds) *
    ! stiffness, which must have been set.
    subroutine section_set_component_damping(section, seconds, stat, errmsg)
        type(pdn_section), intent(inout) :: section
        real(c_double), intent(in) :: seconds(6)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: status

        status = c_section_set_component_damping(section, seconds)
        call report(status, stat, errmsg)
    end subroutine section_set_component_damping

    ! Gives a section damping in proportion to its stiffness, which must have been set.
    subroutine section_set_proportional_damping(section, seconds, stat, errmsg)
        type(pdn_section), intent(inout) :: section
        real(c_double), intent(in) :: seconds
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: status

        status = c_section_set_proportional_damping(section, seconds)
        call report(status, stat, errmsg)
    end subroutine section_set_proportional_damping

    ! Gives a section damping in proportion to its stiffness, which must have been set.
    subroutine shell_section_set_proportional_damping(section, seconds, stat, errmsg)
        type(pdn_shell_section), intent(inout) :: section
        real(c_double), intent(in) :: seconds
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: status

        status = c_shell_section_set_proportional_damping(section, seconds)
        call report(status, stat, errmsg)
    end subroutine shell_section_set_proportional_damping

    ! Interpolates a periodic motion given at N equispaced times, by dual polar decomposition.
    subroutine motion_interpolate(period, positions, rotations, times, position, rotation, &
        velocity, acceleration, stat, errmsg)
        real(c_double), intent(in) :: period
        real(c_double), intent(in), contiguous :: positions(:, :), rotations(:, :), times(:)
        real(c_double), intent(inout), contiguous, optional :: position(:, :), rotation(:, :), &
            velocity(:, :), acceleration(:, :)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_size_t) :: points, count
        integer(c_int32_t) :: status

        points = size(positions, 2, c_size_t)
        count = size(times, 1, c_size_t)
        if (.not. fits('positions', shape(positions), [3, int(points)], stat, errmsg)) return
        if (.not. fits('rotations', shape(rotations), [9, int(points)], stat, errmsg)) return
        if (present(position)) then
            if (.not. fits('position', shape(position), [3, int(count)], stat, errmsg)) return
        end if
        if (present(rotation)) then
            if (.not. fits('rotation', shape(rotation), [9, int(count)], stat, errmsg)) return
        end if
        if (present(velocity)) then
            if (.not. fits('velocity', shape(velocity), [6, int(count)], stat, errmsg)) return
        end if
        if (present(acceleration)) then
            if (.not. fits('acceleration', shape(acceleration), [6, int(count)], stat, &
                errmsg)) return
        end if
        status = c_motion_interpolate(period, positions, rotations, points, times, count, &
            position, rotation, velocity, acceleration)
        call report(status, stat, errmsg)
    end subroutine motion_interpolate

    ! Velocities and accelerations of a motion at its own grid points, and their exact
    ! linearisation.
    subroutine motion_grid_kinematics(period, positions, rotations, velocity, acceleration, &
        velocity_tangent, acceleration_tangent, stat, errmsg)
        real(c_double), intent(in) :: period
        real(c_double), intent(in), contiguous :: positions(:, :), rotations(:, :)
        real(c_double), intent(inout), contiguous, optional :: velocity(:, :), &
            acceleration(:, :), velocity_tangent(:, :), acceleration_tangent(:, :)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_size_t) :: points
        integer(c_int32_t) :: status

        points = size(positions, 2, c_size_t)
        if (.not. fits('positions', shape(positions), [3, int(points)], stat, errmsg)) return
        if (.not. fits('rotations', shape(rotations), [9, int(points)], stat, errmsg)) return
        if (present(velocity)) then
            if (.not. fits('velocity', shape(velocity), [6, int(points)], stat, errmsg)) return
        end if
        if (present(acceleration)) then
            if (.not. fits('acceleration', shape(acceleration), [6, int(points)], stat, &
                errmsg)) return
        end if
        if (present(velocity_tangent)) then
            if (.not. fits('velocity_tangent', shape(velocity_tangent), [6 * int(points), &
                6 * int(points)], stat, errmsg)) return
        end if
        if (present(acceleration_tangent)) then
            if (.not. fits('acceleration_tangent', shape(acceleration_tangent), &
                [6 * int(points), 6 * int(points)], stat, errmsg)) return
        end if
        status = c_motion_grid_kinematics(period, positions, rotations, points, velocity, &
            acceleration, velocity_tangent, acceleration_tangent)
        call report(status, stat, errmsg)
    end subroutine motion_grid_kinematics

    ! A frame from a point and two directions, such as that of a joint or a bushing.
    subroutine joint_frame(point, axis_3, axis_1, frame, stat, errmsg)
        real(c_double), intent(in) :: point(3), axis_3(3), axis_1(3)
        type(pdn_frame), intent(inout) :: frame
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(pdn_frame) :: found_frame
        integer(c_int32_t) :: status

        status = c_joint_frame(point, axis_3, axis_1, found_frame)
        if (status == PDN_OK) frame = found_frame
        call report(status, stat, errmsg)
    end subroutine joint_frame

    ! Follows the other branch at a point where one begins: a branch point, or a period doubling,
    ! from where motions have twice the period, on one grid point less than twice as many.
    subroutine branch_switch_branch(self, point, amplitude, branch, options, periodic, &
        conditions, stat, errmsg)
        class(pdn_branch), intent(in) :: self
        integer(c_int32_t), intent(in) :: point
        real(c_double), intent(in) :: amplitude
        type(pdn_branch), intent(inout) :: branch
        type(pdn_branch_options), intent(in) :: options
        type(pdn_periodic_options), intent(in), target, optional :: periodic
        type(pdn_conditions), intent(in), optional :: conditions
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(pdn_branch_options) :: chosen
        type(c_ptr) :: made
        integer(c_int32_t) :: status

        chosen = options
        if (present(periodic)) chosen%periodic = c_loc(periodic)
        if (present(conditions)) chosen%conditions = conditions%c
        status = pdn_switch_branch(self%c, point, amplitude, chosen, made)
        if (status == PDN_OK) call branch%adopt(made, pdn_branch_free)
        call report(status, stat, errmsg)
    end subroutine branch_switch_branch

    ! Follows folds, period doublings or torus points along a second parameter, from one of them
    ! on a branch: that of the branch is free beside it.
    subroutine branch_follow_locus(self, point, parameter, branch, options, periodic, &
        conditions, stat, errmsg)
        class(pdn_branch), intent(in) :: self
        integer(c_int32_t), intent(in) :: point, parameter
        type(pdn_branch), intent(inout) :: branch
        type(pdn_branch_options), intent(in) :: options
        type(pdn_periodic_options), intent(in), target, optional :: periodic
        type(pdn_conditions), intent(in), optional :: conditions
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(pdn_branch_options) :: chosen
        type(c_ptr) :: made
        integer(c_int32_t) :: status

        chosen = options
        if (present(periodic)) chosen%periodic = c_loc(periodic)
        if (present(conditions)) chosen%conditions = conditions%c
        status = pdn_follow_locus(self%c, point, parameter, chosen, made)
        if (status == PDN_OK) call branch%adopt(made, pdn_branch_free)
        call report(status, stat, errmsg)
    end subroutine branch_follow_locus

    ! Follows a branch on from its last point, in the direction in which it came there: with a
    ! wider range, more points, a shorter smallest step.
    subroutine branch_continue_branch(self, branch, options, periodic, conditions, stat, errmsg)
        class(pdn_branch), intent(in) :: self
        type(pdn_branch), intent(inout) :: branch
        type(pdn_branch_options), intent(in) :: options
        type(pdn_periodic_options), intent(in), target, optional :: periodic
        type(pdn_conditions), intent(in), optional :: conditions
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(pdn_branch_options) :: chosen
        type(c_ptr) :: made
        integer(c_int32_t) :: status

        chosen = options
        if (present(periodic)) chosen%periodic = c_loc(periodic)
        if (present(conditions)) chosen%conditions = conditions%c
        status = pdn_continue_branch(self%c, chosen, made)
        if (status == PDN_OK) call branch%adopt(made, pdn_branch_free)
        call report(status, stat, errmsg)
    end subroutine branch_continue_branch

    ! Saves a branch with its model and all its points.
    subroutine branch_save(self, path, stat, errmsg)
        class(pdn_branch), intent(in) :: self
        character(*), intent(in) :: path
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: status

        status = pdn_branch_save(self%c, trim(path)//c_null_char)
        call report(status, stat, errmsg)
    end subroutine branch_save

    ! Loads a branch that save saved.
    subroutine branch_load(self, path, stat, errmsg)
        class(pdn_branch), intent(inout) :: self
        character(*), intent(in) :: path
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(c_ptr) :: made
        integer(c_int32_t) :: status

        status = pdn_branch_load(trim(path)//c_null_char, made)
        if (status == PDN_OK) call self%adopt(made, pdn_branch_free)
        call report(status, stat, errmsg)
    end subroutine branch_load

    ! Why a branch ended.
    subroutine branch_end(self, end, stat, errmsg)
        class(pdn_branch), intent(in) :: self
        integer(c_int32_t), intent(inout) :: end
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: status

        status = pdn_branch_end(self%c)
        if (status >= 0) end = status
        call report(min(status, PDN_OK), stat, errmsg)
    end subroutine branch_end

    ! A readable report: points, events, and why the branch ended.
    function branch_report(self) result(text)
        class(pdn_branch), intent(in) :: self
        character(:), allocatable :: text
        integer(c_size_t) :: length

        allocate (character(pdn_branch_report(self%c, capacity=0_c_size_t) + 1) :: text)
        length = pdn_branch_report(self%c, text, len(text, c_size_t))
        text = text(:length)
    end function branch_report

    ! Number of points of a branch.
    subroutine branch_count(self, out, stat, errmsg)
        class(pdn_branch), intent(in) :: self
        integer(c_int32_t), intent(inout) :: out
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: found_out, status

        status = pdn_branch_count(self%c, found_out)
        if (status == PDN_OK) out = found_out
        call report(status, stat, errmsg)
    end subroutine branch_count

    ! A point of a branch.
    subroutine branch_get(self, point, out, stat, errmsg)
        class(pdn_branch), intent(in) :: self
        integer(c_int32_t), intent(in) :: point
        type(pdn_branch_point), intent(inout) :: out
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(pdn_branch_point) :: found_out
        integer(c_int32_t) :: status

        call pdn_init(found_out)
        status = pdn_branch_get(self%c, point, found_out)
        if (status == PDN_OK) out = found_out
        call report(status, stat, errmsg)
    end subroutine branch_get

    ! The solution at a point of a branch.
    subroutine branch_solution(self, point, solution, stat, errmsg)
        class(pdn_branch), intent(in) :: self
        integer(c_int32_t), intent(in) :: point
        type(pdn_solution), intent(inout) :: solution
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(c_ptr) :: made
        integer(c_int32_t) :: status

        status = pdn_branch_solution(self%c, point, made)
        if (status == PDN_OK) call solution%adopt(made, pdn_solution_free)
        call report(status, stat, errmsg)
    end subroutine branch_solution

    ! Writes a branch as CSV: a line for each point, with the parameter, how the step went, what
    ! happens there, what multipliers say if they were wanted (pdn_branch_options%stability) and,
    ! of each component of quantities, the mean, the size of the first harmonic, the least and the
    ! largest value over the period.
    subroutine branch_write_csv(self, path, quantities, stat, errmsg)
        class(pdn_branch), intent(in) :: self
        character(*), intent(in) :: path
        type(pdn_quantity), intent(in), optional :: quantities(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_size_t) :: count
        integer(c_int32_t) :: status

        count = 0
        if (present(quantities)) count = size(quantities, 1, c_size_t)
        status = pdn_branch_write_csv(self%c, quantities, count, trim(path)//c_null_char)
        call report(status, stat, errmsg)
    end subroutine branch_write_csv

    ! Writes a chart of the exponents of small disturbances along a branch as CSV, as of Campbell:
    ! of each point that is no event a line for each multiplier, but for conjugates and for those
    ! that only move the motion in time or space.
    subroutine branch_write_campbell(self, path, options, blades, stat, errmsg)
        class(pdn_branch), intent(in) :: self
        character(*), intent(in) :: path
        type(pdn_stability_options), intent(in), optional :: options
        integer(c_int32_t), intent(in), contiguous, optional :: blades(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_size_t) :: count
        integer(c_int32_t) :: status

        count = 0
        if (present(blades)) count = size(blades, 1, c_size_t)
        status = pdn_branch_write_campbell(self%c, options, blades, count, &
            trim(path)//c_null_char)
        call report(status, stat, errmsg)
    end subroutine branch_write_campbell

    ! Makes an empty list: no parameter is free.
    subroutine conditions_new(self, stat, errmsg)
        class(pdn_conditions), intent(inout) :: self
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(c_ptr) :: made
        integer(c_int32_t) :: status

        status = c_version_check(PDN_VERSION_MAJOR, PDN_VERSION_MINOR)
        if (status == PDN_OK) status = pdn_conditions_new(made)
        if (status == PDN_OK) call self%adopt(made, pdn_conditions_free)
        call report(status, stat, errmsg)
    end subroutine conditions_new

    ! Makes a parameter free: its value in the model is that to start from.
    subroutine conditions_release(self, parameter, stat, errmsg)
        class(pdn_conditions), intent(inout) :: self
        integer(c_int32_t), intent(in) :: parameter
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: status

        status = pdn_conditions_release(self%c, parameter)
        call report(status, stat, errmsg)
    end subroutine conditions_release

    ! Adds the condition on the phase: the motion is not ahead of that which the solve starts
    ! from.
    subroutine conditions_add_phase(self, stat, errmsg)
        class(pdn_conditions), intent(inout) :: self
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: status

        status = pdn_conditions_add_phase(self%c)
        call report(status, stat, errmsg)
    end subroutine conditions_add_phase

    ! Adds the condition on the phase of a rotation: in the mean over the period and all nodes,
    ! the motion is not turned about an axis from that which the solve starts from.
    subroutine conditions_add_rotation_phase(self, axis, point, stat, errmsg)
        class(pdn_conditions), intent(inout) :: self
        real(c_double), intent(in) :: axis(3)
        real(c_double), intent(in), optional :: point(3)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: status

        status = pdn_conditions_add_rotation_phase(self%c, axis, point)
        call report(status, stat, errmsg)
    end subroutine conditions_add_rotation_phase

    ! Adds the condition on the phase of a translation: in the mean over the period and all nodes,
    ! the motion is not moved in a direction from that which the solve starts from.
    subroutine conditions_add_translation_phase(self, direction, stat, errmsg)
        class(pdn_conditions), intent(inout) :: self
        real(c_double), intent(in) :: direction(3)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: status

        status = pdn_conditions_add_translation_phase(self%c, direction)
        call report(status, stat, errmsg)
    end subroutine conditions_add_translation_phase

    ! Adds the condition that the mean, a harmonic, or the value at a time, of a quantity is this:
    ! trim.
    subroutine conditions_add_quantity(self, quantity, feature, at, value, scale, stat, errmsg)
        class(pdn_conditions), intent(inout) :: self
        type(pdn_quantity), intent(in) :: quantity
        integer(c_int32_t), intent(in) :: feature
        real(c_double), intent(in) :: at, value
        real(c_double), intent(in), optional :: scale
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        real(c_double) :: raw_scale
        integer(c_int32_t) :: status

        raw_scale = 0.0_c_double
        if (present(scale)) raw_scale = scale
        status = pdn_conditions_add_quantity(self%c, quantity, feature, at, value, raw_scale)
        call report(status, stat, errmsg)
    end subroutine conditions_add_quantity

    ! Adds the condition that a joint coordinate has a value at the start of the period.
    subroutine conditions_add_joint_coordinate(self, joint, coordinate, value, stat, errmsg)
        class(pdn_conditions), intent(inout) :: self
        integer(c_int32_t), intent(in) :: joint, coordinate
        real(c_double), intent(in) :: value
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: status

        status = pdn_conditions_add_joint_coordinate(self%c, joint, coordinate, value)
        call report(status, stat, errmsg)
    end subroutine conditions_add_joint_coordinate

    ! Adds the condition that the mean of the kinetic and the potential energy over the period is
    ! a value.
    subroutine conditions_add_energy(self, energy, stat, errmsg)
        class(pdn_conditions), intent(inout) :: self
        real(c_double), intent(in) :: energy
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: status

        status = pdn_conditions_add_energy(self%c, energy)
        call report(status, stat, errmsg)
    end subroutine conditions_add_energy

    ! Adds the condition that the mean momentum in a direction is a value.
    subroutine conditions_add_momentum(self, direction, momentum, stat, errmsg)
        class(pdn_conditions), intent(inout) :: self
        real(c_double), intent(in) :: direction(3), momentum
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: status

        status = pdn_conditions_add_momentum(self%c, direction, momentum)
        call report(status, stat, errmsg)
    end subroutine conditions_add_momentum

    ! Adds the condition that the mean angular momentum about an axis is a value.
    subroutine conditions_add_angular_momentum(self, axis, momentum, point, stat, errmsg)
        class(pdn_conditions), intent(inout) :: self
        real(c_double), intent(in) :: axis(3), momentum
        real(c_double), intent(in), optional :: point(3)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: status

        status = pdn_conditions_add_angular_momentum(self%c, axis, point, momentum)
        call report(status, stat, errmsg)
    end subroutine conditions_add_angular_momentum

    ! Makes the equations of a periodic motion on a grid, or a rank's part.
    subroutine equations_new(self, model, period, options, initial, owners, stat, errmsg)
        class(pdn_equations), intent(inout) :: self
        type(pdn_model), intent(in) :: model
        real(c_double), intent(in) :: period
        type(pdn_equations_options), intent(in) :: options
        type(pdn_solution), intent(in), optional :: initial
        integer(c_int32_t), intent(in), target, contiguous, optional :: owners(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(pdn_equations_options) :: chosen
        type(c_ptr) :: made
        integer(c_int32_t) :: status

        chosen = options
        if (present(initial)) chosen%initial = initial%c
        if (present(owners)) then
            chosen%owner_count = size(owners, kind=c_size_t)
            chosen%owners = c_loc(owners)
        end if
        status = c_version_check(PDN_VERSION_MAJOR, PDN_VERSION_MINOR)
        if (status == PDN_OK) status = pdn_equations_new(model%c, period, chosen, made)
        if (status == PDN_OK) call self%adopt(made, pdn_equations_free)
        call report(status, stat, errmsg)
    end subroutine equations_new

    ! Sizes of the equations, and of the vectors of this rank.
    subroutine equations_get_sizes(self, out, stat, errmsg)
        class(pdn_equations), intent(in) :: self
        type(pdn_equations_sizes), intent(inout) :: out
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(pdn_equations_sizes) :: found_out
        integer(c_int32_t) :: status

        call pdn_init(found_out)
        status = pdn_equations_get_sizes(self%c, found_out)
        if (status == PDN_OK) out = found_out
        call report(status, stat, errmsg)
    end subroutine equations_get_sizes

    ! Nodes of this rank, in the order of its vectors.
    subroutine equations_nodes(self, out, stat, errmsg)
        class(pdn_equations), intent(in) :: self
        integer(c_int32_t), intent(inout), contiguous :: out(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_size_t) :: count
        integer(c_int32_t) :: status

        count = size(out, 1, c_size_t)
        status = pdn_equations_nodes(self%c, out, count)
        call report(status, stat, errmsg)
    end subroutine equations_nodes

    ! Numbers of this rank's unknowns among those of all ranks: in the order that one rank alone
    ! has them in, from 0.
    subroutine equations_numbers(self, out, stat, errmsg)
        class(pdn_equations), intent(in) :: self
        integer(c_size_t), intent(inout), contiguous :: out(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_size_t) :: count
        integer(c_int32_t) :: status

        count = size(out, 1, c_size_t)
        status = pdn_equations_numbers(self%c, out, count)
        call report(status, stat, errmsg)
    end subroutine equations_numbers

    ! The present motions of this rank's nodes, and own unknowns of its elements.
    subroutine equations_state(self, motions, own_unknowns, stat, errmsg)
        class(pdn_equations), intent(in) :: self
        real(c_double), intent(inout), contiguous :: motions(:), own_unknowns(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_size_t) :: motion_count, own_count
        integer(c_int32_t) :: status

        motion_count = size(motions, 1, c_size_t)
        own_count = size(own_unknowns, 1, c_size_t)
        status = pdn_equations_state(self%c, motions, motion_count, own_unknowns, own_count)
        call report(status, stat, errmsg)
    end subroutine equations_state

    ! Sets motions and own unknowns, as state gives them.
    subroutine equations_set_state(self, motions, own_unknowns, stat, errmsg)
        class(pdn_equations), intent(inout) :: self
        real(c_double), intent(in), contiguous :: motions(:), own_unknowns(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_size_t) :: motion_count, own_count
        integer(c_int32_t) :: status

        motion_count = size(motions, 1, c_size_t)
        own_count = size(own_unknowns, 1, c_size_t)
        status = pdn_equations_set_state(self%c, motions, motion_count, own_unknowns, own_count)
        call report(status, stat, errmsg)
    end subroutine equations_set_state

    ! The scaled residual at the present state.
    subroutine equations_residual(self, out, stat, errmsg)
        class(pdn_equations), intent(inout) :: self
        real(c_double), intent(inout), contiguous :: out(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_size_t) :: count
        integer(c_int32_t) :: status

        count = size(out, 1, c_size_t)
        status = pdn_equations_residual(self%c, out, count)
        call report(status, stat, errmsg)
    end subroutine equations_residual

    ! Linearises the equations at the present state, which update then begins at.
    subroutine equations_linearise(self, stat, errmsg)
        class(pdn_equations), intent(inout) :: self
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: status

        status = pdn_equations_linearise(self%c)
        call report(status, stat, errmsg)
    end subroutine equations_linearise

    ! The product of the scaled Jacobian of the last linearisation and a vector.
    subroutine equations_product(self, x, out, stat, errmsg)
        class(pdn_equations), intent(inout) :: self
        real(c_double), intent(in), contiguous :: x(:)
        real(c_double), intent(inout), contiguous :: out(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_size_t) :: count
        integer(c_int32_t) :: status

        count = size(x, 1, c_size_t)
        if (.not. fits('out', shape(out), [int(count)], stat, errmsg)) return
        status = pdn_equations_product(self%c, x, out, count)
        call report(status, stat, errmsg)
    end subroutine equations_product

    ! The product of the transposed scaled Jacobian and a vector.
    subroutine equations_transposed_product(self, x, out, stat, errmsg)
        class(pdn_equations), intent(inout) :: self
        real(c_double), intent(in), contiguous :: x(:)
        real(c_double), intent(inout), contiguous :: out(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_size_t) :: count
        integer(c_int32_t) :: status

        count = size(x, 1, c_size_t)
        if (.not. fits('out', shape(out), [int(count)], stat, errmsg)) return
        status = pdn_equations_transposed_product(self%c, x, out, count)
        call report(status, stat, errmsg)
    end subroutine equations_transposed_product

    ! The product of a vector and what multiplies a power of mu in the scaled Jacobian for
    ! disturbances exp(mu t) times increments of the period: J(mu) = J + mu J1 + mu^2 J2.
    subroutine equations_power_product(self, power, x, out, stat, errmsg)
        class(pdn_equations), intent(inout) :: self
        integer(c_int32_t), intent(in) :: power
        real(c_double), intent(in), contiguous :: x(:)
        real(c_double), intent(inout), contiguous :: out(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_size_t) :: count
        integer(c_int32_t) :: status

        count = size(x, 1, c_size_t)
        if (.not. fits('out', shape(out), [int(count)], stat, errmsg)) return
        status = pdn_equations_power_product(self%c, power, x, out, count)
        call report(status, stat, errmsg)
    end subroutine equations_power_product

    ! Factors the preconditioner of the linearised equations.
    subroutine equations_factor(self, right_side, regular, stat, errmsg)
        class(pdn_equations), intent(inout) :: self
        real(c_double), intent(in), contiguous :: right_side(:)
        logical, intent(inout) :: regular
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_size_t) :: count
        integer(c_int32_t) :: found_regular, status

        count = size(right_side, 1, c_size_t)
        status = pdn_equations_factor(self%c, right_side, count, found_regular)
        if (status == PDN_OK) regular = found_regular /= 0
        call report(status, stat, errmsg)
    end subroutine equations_factor

    ! The solution of the preconditioner's equations with a right side.
    subroutine equations_precondition(self, x, out, stat, errmsg)
        class(pdn_equations), intent(inout) :: self
        real(c_double), intent(in), contiguous :: x(:)
        real(c_double), intent(inout), contiguous :: out(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_size_t) :: count
        integer(c_int32_t) :: status

        count = size(x, 1, c_size_t)
        if (.not. fits('out', shape(out), [int(count)], stat, errmsg)) return
        status = pdn_equations_precondition(self%c, x, out, count)
        call report(status, stat, errmsg)
    end subroutine equations_precondition

    ! What a scaled increment leaves of the constraints by their compliance in the Jacobian, where
    ! some depend on others.
    subroutine equations_compliance(self, increment, out, compliant, stat, errmsg)
        class(pdn_equations), intent(inout) :: self
        real(c_double), intent(in), contiguous :: increment(:)
        real(c_double), intent(inout), contiguous :: out(:)
        logical, intent(inout) :: compliant
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_size_t) :: count
        integer(c_int32_t) :: found_compliant, status

        count = size(increment, 1, c_size_t)
        if (.not. fits('out', shape(out), [int(count)], stat, errmsg)) return
        status = pdn_equations_compliance(self%c, increment, out, count, found_compliant)
        if (status == PDN_OK) compliant = found_compliant /= 0
        call report(status, stat, errmsg)
    end subroutine equations_compliance

    ! Moves the state that the equations were linearised at last by a fraction of a scaled
    ! increment; the present state is then that.
    subroutine equations_update(self, increment, step, stat, errmsg)
        class(pdn_equations), intent(inout) :: self
        real(c_double), intent(in), contiguous :: increment(:)
        real(c_double), intent(in), optional :: step
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_size_t) :: count
        real(c_double) :: raw_step
        integer(c_int32_t) :: status

        count = size(increment, 1, c_size_t)
        raw_step = 1.0_c_double
        if (present(step)) raw_step = step
        status = pdn_equations_update(self%c, increment, count, raw_step)
        call report(status, stat, errmsg)
    end subroutine equations_update

    ! Sizes of a scaled increment of all ranks, the same on all.
    subroutine equations_norms(self, increment, motion, own_unknown, stat, errmsg)
        class(pdn_equations), intent(in) :: self
        real(c_double), intent(in), contiguous :: increment(:)
        real(c_double), intent(inout) :: motion, own_unknown
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_size_t) :: count
        real(c_double) :: found_motion, found_own_unknown
        integer(c_int32_t) :: status

        count = size(increment, 1, c_size_t)
        status = pdn_equations_norms(self%c, increment, count, found_motion, found_own_unknown)
        if (status == PDN_OK) then
            motion = found_motion
            own_unknown = found_own_unknown
        end if
        call report(status, stat, errmsg)
    end subroutine equations_norms

    ! The present state of all ranks as a solution, for results, files, and what else solutions
    ! are for.
    subroutine equations_solution(self, outcome, solution, root, stat, errmsg)
        class(pdn_equations), intent(in) :: self
        integer(c_int32_t), intent(in) :: outcome
        type(pdn_solution), intent(inout) :: solution
        integer(c_int32_t), intent(in), optional :: root
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: raw_root
        type(c_ptr) :: made
        integer(c_int32_t) :: status

        raw_root = -1_c_int32_t
        if (present(root)) raw_root = root
        status = pdn_equations_solution(self%c, raw_root, outcome, made)
        if (status == PDN_OK) call solution%adopt(made, pdn_solution_free)
        call report(status, stat, errmsg)
    end subroutine equations_solution

    ! Makes an empty model.
    subroutine model_new(self, stat, errmsg)
        class(pdn_model), intent(inout) :: self
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(c_ptr) :: made
        integer(c_int32_t) :: status

        status = c_version_check(PDN_VERSION_MAJOR, PDN_VERSION_MINOR)
        if (status == PDN_OK) status = pdn_model_new(made)
        if (status == PDN_OK) call self%adopt(made, pdn_model_free)
        call report(status, stat, errmsg)
    end subroutine model_new

    ! Number of nodes; their ids follow each other from PDN_FIRST_NODE on.
    subroutine model_node_count(self, count, stat, errmsg)
        class(pdn_model), intent(in) :: self
        integer(c_int32_t), intent(inout) :: count
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: found_count, status

        status = pdn_model_node_count(self%c, found_count)
        if (status == PDN_OK) count = found_count
        call report(status, stat, errmsg)
    end subroutine model_node_count

    ! Number of joints; their ids follow each other from PDN_FIRST_JOINT on.
    subroutine model_joint_count(self, count, stat, errmsg)
        class(pdn_model), intent(in) :: self
        integer(c_int32_t), intent(inout) :: count
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: found_count, status

        status = pdn_model_joint_count(self%c, found_count)
        if (status == PDN_OK) count = found_count
        call report(status, stat, errmsg)
    end subroutine model_joint_count

    ! Number of beam elements; their ids follow each other from PDN_FIRST_BEAM_ELEMENT on.
    subroutine model_element_count(self, count, stat, errmsg)
        class(pdn_model), intent(in) :: self
        integer(c_int32_t), intent(inout) :: count
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: found_count, status

        status = pdn_model_element_count(self%c, found_count)
        if (status == PDN_OK) count = found_count
        call report(status, stat, errmsg)
    end subroutine model_element_count

    ! Total mass and centre of mass in the reference configuration.
    subroutine model_mass(self, mass, centre, stat, errmsg)
        class(pdn_model), intent(in) :: self
        real(c_double), intent(inout) :: mass
        real(c_double), intent(inout), optional :: centre(3)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        real(c_double) :: found_mass
        integer(c_int32_t) :: status

        status = pdn_model_mass(self%c, found_mass, centre)
        if (status == PDN_OK) mass = found_mass
        call report(status, stat, errmsg)
    end subroutine model_mass

    ! Frame of a node in the reference configuration.
    subroutine model_node_frame(self, node, frame, stat, errmsg)
        class(pdn_model), intent(in) :: self
        integer(c_int32_t), intent(in) :: node
        type(pdn_frame), intent(inout) :: frame
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(pdn_frame) :: found_frame
        integer(c_int32_t) :: status

        status = pdn_model_node_frame(self%c, node, found_frame)
        if (status == PDN_OK) frame = found_frame
        call report(status, stat, errmsg)
    end subroutine model_node_frame

    ! Adds a node: a frame that moves.
    subroutine model_add_node(self, position, rotation, node, stat, errmsg)
        class(pdn_model), intent(inout) :: self
        real(c_double), intent(in) :: position(3)
        real(c_double), intent(in), optional :: rotation(3, 3)
        integer(c_int32_t), intent(inout), optional :: node
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: found_node, status

        status = pdn_model_add_node(self%c, position, rotation, found_node)
        if (status == PDN_OK) then
            if (present(node)) node = found_node
        end if
        call report(status, stat, errmsg)
    end subroutine model_add_node

    ! Adds a rigid body: a node at its centre of mass, with axes parallel to the global ones.
    subroutine model_add_rigid_body(self, mass, centre, inertia, node, stat, errmsg)
        class(pdn_model), intent(inout) :: self
        real(c_double), intent(in) :: mass, centre(3), inertia(3, 3)
        integer(c_int32_t), intent(inout), optional :: node
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: found_node, status

        status = pdn_model_add_rigid_body(self%c, mass, centre, inertia, found_node)
        if (status == PDN_OK) then
            if (present(node)) node = found_node
        end if
        call report(status, stat, errmsg)
    end subroutine model_add_rigid_body

    ! Fixes a mass to a node, in addition to what the node has.
    subroutine model_add_mass(self, node, mass, centre, inertia, id, stat, errmsg)
        class(pdn_model), intent(inout) :: self
        integer(c_int32_t), intent(in) :: node
        real(c_double), intent(in) :: mass, centre(3)
        real(c_double), intent(in), optional :: inertia(3, 3)
        integer(c_int32_t), intent(inout), optional :: id
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: found_id, status

        status = pdn_model_add_mass(self%c, node, mass, centre, inertia, found_id)
        if (status == PDN_OK) then
            if (present(id)) id = found_id
        end if
        call report(status, stat, errmsg)
    end subroutine model_add_mass

    ! Fixes an inertia of any kind to a node, in addition to what the node has.
    subroutine model_add_inertia(self, node, matrix, frame, id, stat, errmsg)
        class(pdn_model), intent(inout) :: self
        integer(c_int32_t), intent(in) :: node
        real(c_double), intent(in) :: matrix(6, 6)
        type(pdn_frame), intent(in), optional :: frame
        integer(c_int32_t), intent(inout), optional :: id
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: found_id, status

        status = pdn_model_add_inertia(self%c, node, frame, matrix, found_id)
        if (status == PDN_OK) then
            if (present(id)) id = found_id
        end if
        call report(status, stat, errmsg)
    end subroutine model_add_inertia

    ! Makes a joint coordinate follow a signal.
    subroutine model_prescribe(self, joint, coordinate, signal, prescribed, stat, errmsg)
        class(pdn_model), intent(inout) :: self
        integer(c_int32_t), intent(in) :: joint, coordinate
        type(pdn_signal), intent(in), target :: signal
        integer(c_int32_t), intent(inout), optional :: prescribed
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: found_prescribed, status

        status = pdn_model_prescribe(self%c, joint, coordinate, raw_of(signal), &
            found_prescribed)
        if (status == PDN_OK) then
            if (present(prescribed)) prescribed = found_prescribed
        end if
        call report(status, stat, errmsg)
    end subroutine model_prescribe

    ! Fixes two bodies to each other.
    subroutine model_add_rigid_joint(self, first, second, point, joint, stat, errmsg)
        class(pdn_model), intent(inout) :: self
        integer(c_int32_t), intent(in) :: first, second
        real(c_double), intent(in) :: point(3)
        integer(c_int32_t), intent(inout), optional :: joint
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: found_joint, status

        status = pdn_model_add_rigid_joint(self%c, first, second, point, found_joint)
        if (status == PDN_OK) then
            if (present(joint)) joint = found_joint
        end if
        call report(status, stat, errmsg)
    end subroutine model_add_rigid_joint

    ! Joins two bodies by a hinge.
    subroutine model_add_revolute(self, first, second, point, axis, joint, stat, errmsg)
        class(pdn_model), intent(inout) :: self
        integer(c_int32_t), intent(in) :: first, second
        real(c_double), intent(in) :: point(3), axis(3)
        integer(c_int32_t), intent(inout), optional :: joint
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: found_joint, status

        status = pdn_model_add_revolute(self%c, first, second, point, axis, found_joint)
        if (status == PDN_OK) then
            if (present(joint)) joint = found_joint
        end if
        call report(status, stat, errmsg)
    end subroutine model_add_revolute

    ! Joins two bodies by a slider.
    subroutine model_add_prismatic(self, first, second, point, axis, joint, stat, errmsg)
        class(pdn_model), intent(inout) :: self
        integer(c_int32_t), intent(in) :: first, second
        real(c_double), intent(in) :: point(3), axis(3)
        integer(c_int32_t), intent(inout), optional :: joint
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: found_joint, status

        status = pdn_model_add_prismatic(self%c, first, second, point, axis, found_joint)
        if (status == PDN_OK) then
            if (present(joint)) joint = found_joint
        end if
        call report(status, stat, errmsg)
    end subroutine model_add_prismatic

    ! Joins two bodies by a shaft in a sleeve: one slides along the axis and turns about it.
    subroutine model_add_cylindrical(self, first, second, point, axis, joint, stat, errmsg)
        class(pdn_model), intent(inout) :: self
        integer(c_int32_t), intent(in) :: first, second
        real(c_double), intent(in) :: point(3), axis(3)
        integer(c_int32_t), intent(inout), optional :: joint
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: found_joint, status

        status = pdn_model_add_cylindrical(self%c, first, second, point, axis, found_joint)
        if (status == PDN_OK) then
            if (present(joint)) joint = found_joint
        end if
        call report(status, stat, errmsg)
    end subroutine model_add_cylindrical

    ! Joins two bodies by a screw: the second advances along the axis as it turns about it.
    subroutine model_add_screw(self, first, second, point, axis, pitch, joint, stat, errmsg)
        class(pdn_model), intent(inout) :: self
        integer(c_int32_t), intent(in) :: first, second
        real(c_double), intent(in) :: point(3), axis(3), pitch
        integer(c_int32_t), intent(inout), optional :: joint
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: found_joint, status

        status = pdn_model_add_screw(self%c, first, second, point, axis, pitch, found_joint)
        if (status == PDN_OK) then
            if (present(joint)) joint = found_joint
        end if
        call report(status, stat, errmsg)
    end subroutine model_add_screw

    ! Joins two bodies by a pair of planes that slide and turn on each other.
    subroutine model_add_planar(self, first, second, point, normal, joint, stat, errmsg)
        class(pdn_model), intent(inout) :: self
        integer(c_int32_t), intent(in) :: first, second
        real(c_double), intent(in) :: point(3), normal(3)
        integer(c_int32_t), intent(inout), optional :: joint
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: found_joint, status

        status = pdn_model_add_planar(self%c, first, second, point, normal, found_joint)
        if (status == PDN_OK) then
            if (present(joint)) joint = found_joint
        end if
        call report(status, stat, errmsg)
    end subroutine model_add_planar

    ! Joins two bodies by nothing: a joint that constrains no motion, but has coordinates.
    subroutine model_add_free_joint(self, first, second, point, joint, stat, errmsg)
        class(pdn_model), intent(inout) :: self
        integer(c_int32_t), intent(in) :: first, second
        real(c_double), intent(in) :: point(3)
        integer(c_int32_t), intent(inout), optional :: joint
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: found_joint, status

        status = pdn_model_add_free_joint(self%c, first, second, point, found_joint)
        if (status == PDN_OK) then
            if (present(joint)) joint = found_joint
        end if
        call report(status, stat, errmsg)
    end subroutine model_add_free_joint

    ! Joins two bodies by a ball.
    subroutine model_add_spherical(self, first, second, point, joint, stat, errmsg)
        class(pdn_model), intent(inout) :: self
        integer(c_int32_t), intent(in) :: first, second
        real(c_double), intent(in) :: point(3)
        integer(c_int32_t), intent(inout), optional :: joint
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: found_joint, status

        status = pdn_model_add_spherical(self%c, first, second, point, found_joint)
        if (status == PDN_OK) then
            if (present(joint)) joint = found_joint
        end if
        call report(status, stat, errmsg)
    end subroutine model_add_spherical

    ! Joins two bodies by a cross (Cardan, Hooke).
    subroutine model_add_universal(self, first, second, point, first_arm, second_arm, joint, &
        stat, errmsg)
        class(pdn_model), intent(inout) :: self
        integer(c_int32_t), intent(in) :: first, second
        real(c_double), intent(in) :: point(3), first_arm(3), second_arm(3)
        integer(c_int32_t), intent(inout), optional :: joint
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: found_joint, status

        status = pdn_model_add_universal(self%c, first, second, point, first_arm, second_arm, &
            found_joint)
        if (status == PDN_OK) then
            if (present(joint)) joint = found_joint
        end if
        call report(status, stat, errmsg)
    end subroutine model_add_universal

    ! Adds a strut: the line between a point of each of two bodies.
    subroutine model_add_strut(self, first, second, first_point, second_point, joint, stat, &
        errmsg)
        class(pdn_model), intent(inout) :: self
        integer(c_int32_t), intent(in) :: first, second
        real(c_double), intent(in) :: first_point(3), second_point(3)
        integer(c_int32_t), intent(inout), optional :: joint
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: found_joint, status

        status = pdn_model_add_strut(self%c, first, second, first_point, second_point, &
            found_joint)
        if (status == PDN_OK) then
            if (present(joint)) joint = found_joint
        end if
        call report(status, stat, errmsg)
    end subroutine model_add_strut

    ! Joins two bodies by a joint of any kind, between a frame fixed to each.
    subroutine model_add_joint(self, kind, first, second, first_frame, second_frame, joint, &
        stat, errmsg)
        class(pdn_model), intent(inout) :: self
        integer(c_int32_t), intent(in) :: kind, first, second
        type(pdn_frame), intent(in) :: first_frame, second_frame
        integer(c_int32_t), intent(inout), optional :: joint
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: found_joint, status

        status = pdn_model_add_joint(self%c, kind, first, second, first_frame, second_frame, &
            found_joint)
        if (status == PDN_OK) then
            if (present(joint)) joint = found_joint
        end if
        call report(status, stat, errmsg)
    end subroutine model_add_joint

    ! Joins two bodies by a screw, between a frame fixed to each.
    subroutine model_add_screw_between(self, first, second, first_frame, second_frame, pitch, &
        joint, stat, errmsg)
        class(pdn_model), intent(inout) :: self
        integer(c_int32_t), intent(in) :: first, second
        type(pdn_frame), intent(in) :: first_frame, second_frame
        real(c_double), intent(in) :: pitch
        integer(c_int32_t), intent(inout), optional :: joint
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: found_joint, status

        status = pdn_model_add_screw_between(self%c, first, second, first_frame, second_frame, &
            pitch, found_joint)
        if (status == PDN_OK) then
            if (present(joint)) joint = found_joint
        end if
        call report(status, stat, errmsg)
    end subroutine model_add_screw_between

    ! Number of linear relations between joint coordinates; their ids follow each other from
    ! PDN_FIRST_RELATION on.
    subroutine model_relation_count(self, count, stat, errmsg)
        class(pdn_model), intent(in) :: self
        integer(c_int32_t), intent(inout) :: count
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: found_count, status

        status = pdn_model_relation_count(self%c, found_count)
        if (status == PDN_OK) count = found_count
        call report(status, stat, errmsg)
    end subroutine model_relation_count

    ! Adds a linear relation between joint coordinates: gears, belts, racks, differentials.
    subroutine model_add_relation(self, joints, coordinates, coefficients, signal, relation, &
        stat, errmsg)
        class(pdn_model), intent(inout) :: self
        integer(c_int32_t), intent(in), contiguous :: joints(:), coordinates(:)
        real(c_double), intent(in), contiguous :: coefficients(:)
        type(pdn_signal), intent(in), target, optional :: signal
        integer(c_int32_t), intent(inout), optional :: relation
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_size_t) :: count
        type(c_signal), allocatable :: raw_signal
        integer(c_int32_t) :: found_relation, status

        count = size(joints, 1, c_size_t)
        if (.not. fits('coordinates', shape(coordinates), [int(count)], stat, errmsg)) return
        if (.not. fits('coefficients', shape(coefficients), [int(count)], stat, errmsg)) return
        if (present(signal)) raw_signal = raw_of(signal)
        status = pdn_model_add_relation(self%c, joints, coordinates, coefficients, count, &
            raw_signal, found_relation)
        if (status == PDN_OK) then
            if (present(relation)) relation = found_relation
        end if
        call report(status, stat, errmsg)
    end subroutine model_add_relation

    ! Adds a beam element over nodes that are there; it may be curved and twisted.
    subroutine model_add_beam_element(self, nodes, section, element, stat, errmsg)
        class(pdn_model), intent(inout) :: self
        integer(c_int32_t), intent(in), contiguous :: nodes(:)
        type(pdn_section), intent(in) :: section
        integer(c_int32_t), intent(inout), optional :: element
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_size_t) :: count
        integer(c_int32_t) :: found_element, status

        count = size(nodes, 1, c_size_t)
        status = pdn_model_add_beam_element(self%c, nodes, count, section, found_element)
        if (status == PDN_OK) then
            if (present(element)) element = found_element
        end if
        call report(status, stat, errmsg)
    end subroutine model_add_beam_element

    ! Adds a straight beam: its nodes and elements.
    subroutine model_add_straight_beam(self, start, end, axis_2, section, elements, degree, &
        beam, stat, errmsg)
        class(pdn_model), intent(inout) :: self
        real(c_double), intent(in) :: start(3), end(3), axis_2(3)
        type(pdn_section), intent(in) :: section
        integer(c_int32_t), intent(in) :: elements, degree
        type(pdn_beam), intent(inout) :: beam
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(pdn_beam) :: found_beam
        integer(c_int32_t) :: status

        status = pdn_model_add_straight_beam(self%c, start, end, axis_2, section, &
            int(max(elements, 0), c_size_t), int(max(degree, 0), c_size_t), found_beam)
        if (status == PDN_OK) beam = found_beam
        call report(status, stat, errmsg)
    end subroutine model_add_straight_beam

    ! Adds a beam along a line, with sections that may vary: its nodes and elements.
    subroutine model_add_beam(self, line, sections, elements, degree, beam, fractions, twists, &
        stat, errmsg)
        class(pdn_model), intent(inout) :: self
        type(pdn_line), intent(in) :: line
        type(pdn_section), intent(in), target, contiguous :: sections(:)
        integer(c_int32_t), intent(in) :: elements, degree
        type(pdn_beam), intent(inout) :: beam
        real(c_double), intent(in), target, contiguous, optional :: fractions(:), twists(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(pdn_stations) :: chosen
        type(pdn_beam) :: found_beam
        integer(c_int32_t) :: status

        call pdn_init(chosen)
        chosen%count = size(sections, kind=c_size_t)
        chosen%sections = c_loc(sections)
        if (present(fractions)) then
            if (.not. fits('fractions', shape(fractions), [int(chosen%count)], stat, &
                errmsg)) return
            chosen%fractions = c_loc(fractions)
        end if
        if (present(twists)) then
            if (.not. fits('twists', shape(twists), [int(chosen%count)], stat, errmsg)) return
            chosen%twists = c_loc(twists)
        end if
        status = pdn_model_add_beam(self%c, line, chosen, int(max(elements, 0), c_size_t), &
            int(max(degree, 0), c_size_t), found_beam)
        if (status == PDN_OK) beam = found_beam
        call report(status, stat, errmsg)
    end subroutine model_add_beam

    ! Adds a beam along a line as add_beam does, with elements between given places.
    subroutine model_add_beam_between(self, line, sections, boundaries, degree, beam, fractions, &
        twists, stat, errmsg)
        class(pdn_model), intent(inout) :: self
        type(pdn_line), intent(in) :: line
        type(pdn_section), intent(in), target, contiguous :: sections(:)
        real(c_double), intent(in), contiguous :: boundaries(:)
        integer(c_int32_t), intent(in) :: degree
        type(pdn_beam), intent(inout) :: beam
        real(c_double), intent(in), target, contiguous, optional :: fractions(:), twists(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_size_t) :: count
        type(pdn_stations) :: chosen
        type(pdn_beam) :: found_beam
        integer(c_int32_t) :: status

        count = size(boundaries, 1, c_size_t)
        call pdn_init(chosen)
        chosen%count = size(sections, kind=c_size_t)
        chosen%sections = c_loc(sections)
        if (present(fractions)) then
            if (.not. fits('fractions', shape(fractions), [int(chosen%count)], stat, &
                errmsg)) return
            chosen%fractions = c_loc(fractions)
        end if
        if (present(twists)) then
            if (.not. fits('twists', shape(twists), [int(chosen%count)], stat, errmsg)) return
            chosen%twists = c_loc(twists)
        end if
        status = pdn_model_add_beam_between(self%c, line, chosen, boundaries, count, &
            int(max(degree, 0), c_size_t), found_beam)
        if (status == PDN_OK) beam = found_beam
        call report(status, stat, errmsg)
    end subroutine model_add_beam_between

    ! Adds one component of a force or moment on a node, in addition to those that are there.
    subroutine model_add_load(self, node, frame, component, signal, load, stat, errmsg)
        class(pdn_model), intent(inout) :: self
        integer(c_int32_t), intent(in) :: node, frame, component
        type(pdn_signal), intent(in), target :: signal
        integer(c_int32_t), intent(inout), optional :: load
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: found_load, status

        status = pdn_model_add_load(self%c, node, frame, component, raw_of(signal), found_load)
        if (status == PDN_OK) then
            if (present(load)) load = found_load
        end if
        call report(status, stat, errmsg)
    end subroutine model_add_load

    ! Adds one component of a force or moment at a point that a node carries, in addition to those
    ! that are there: such as a thrust that acts off the node of a body.
    subroutine model_add_load_at_point(self, node, offset, frame, component, signal, load, stat, &
        errmsg)
        class(pdn_model), intent(inout) :: self
        integer(c_int32_t), intent(in) :: node
        real(c_double), intent(in) :: offset(3)
        integer(c_int32_t), intent(in) :: frame, component
        type(pdn_signal), intent(in), target :: signal
        integer(c_int32_t), intent(inout), optional :: load
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: found_load, status

        status = pdn_model_add_load_at_point(self%c, node, offset, frame, component, &
            raw_of(signal), found_load)
        if (status == PDN_OK) then
            if (present(load)) load = found_load
        end if
        call report(status, stat, errmsg)
    end subroutine model_add_load_at_point

    ! Adds one component of a force or moment at a fraction of the span of a beam, in addition to
    ! those that are there.
    subroutine model_add_load_on_beam(self, first_element, elements, fraction, frame, component, &
        signal, offset, load, stat, errmsg)
        class(pdn_model), intent(inout) :: self
        integer(c_int32_t), intent(in) :: first_element, elements
        real(c_double), intent(in) :: fraction
        integer(c_int32_t), intent(in) :: frame, component
        type(pdn_signal), intent(in), target :: signal
        real(c_double), intent(in), optional :: offset(3)
        integer(c_int32_t), intent(inout), optional :: load
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: found_load, status

        status = pdn_model_add_load_on_beam(self%c, first_element, elements, fraction, offset, &
            frame, component, raw_of(signal), found_load)
        if (status == PDN_OK) then
            if (present(load)) load = found_load
        end if
        call report(status, stat, errmsg)
    end subroutine model_add_load_on_beam

    ! Sets the acceleration of gravity, in place of any set before.
    subroutine model_set_gravity(self, acceleration, stat, errmsg)
        class(pdn_model), intent(inout) :: self
        real(c_double), intent(in) :: acceleration(3)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: status

        status = pdn_model_set_gravity(self%c, acceleration)
        call report(status, stat, errmsg)
    end subroutine model_set_gravity

    ! Sets an acceleration of gravity that varies in time, in place of any set before.
    subroutine model_set_gravity_signals(self, acceleration_1, acceleration_2, acceleration_3, &
        stat, errmsg)
        class(pdn_model), intent(inout) :: self
        type(pdn_signal), intent(in), target, optional :: acceleration_1, acceleration_2, &
            acceleration_3
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(c_signal), allocatable :: raw_acceleration_1, raw_acceleration_2, &
            raw_acceleration_3
        integer(c_int32_t) :: status

        if (present(acceleration_1)) raw_acceleration_1 = raw_of(acceleration_1)
        if (present(acceleration_2)) raw_acceleration_2 = raw_of(acceleration_2)
        if (present(acceleration_3)) raw_acceleration_3 = raw_of(acceleration_3)
        status = pdn_model_set_gravity_signals(self%c, raw_acceleration_1, raw_acceleration_2, &
            raw_acceleration_3)
        call report(status, stat, errmsg)
    end subroutine model_set_gravity_signals

    ! Adds one component of a force or moment distributed along beam elements, in addition to
    ! those that are there.
    subroutine model_add_distributed_load(self, first_element, elements, frame, component, &
        signal, fractions, factors, load, stat, errmsg)
        class(pdn_model), intent(inout) :: self
        integer(c_int32_t), intent(in) :: first_element, elements, frame, component
        type(pdn_signal), intent(in), target :: signal
        real(c_double), intent(in), contiguous, optional :: fractions(:), factors(:)
        integer(c_int32_t), intent(inout), optional :: load
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_size_t) :: count
        integer(c_int32_t) :: found_load, status

        count = 0
        if (present(factors)) count = size(factors, 1, c_size_t)
        if (present(fractions)) count = size(fractions, 1, c_size_t)
        if (present(factors)) then
            if (.not. fits('factors', shape(factors), [int(count)], stat, errmsg)) return
        end if
        status = pdn_model_add_distributed_load(self%c, first_element, elements, frame, &
            component, raw_of(signal), fractions, factors, count, found_load)
        if (status == PDN_OK) then
            if (present(load)) load = found_load
        end if
        call report(status, stat, errmsg)
    end subroutine model_add_distributed_load

    ! Adds a force and moment distributed along beam elements, all components at all places at
    ! once, in addition to those that are there: such as the air loads of a blade, at the places
    ! where these are computed.
    subroutine model_add_load_at_places(self, first_element, elements, frame, fractions, &
        signals, axis_2, first_load, stat, errmsg)
        class(pdn_model), intent(inout) :: self
        integer(c_int32_t), intent(in) :: first_element, elements, frame
        real(c_double), intent(in), contiguous :: fractions(:)
        type(pdn_signal), intent(in), target :: signals(:, :)
        real(c_double), intent(in), optional :: axis_2(3)
        integer(c_int32_t), intent(inout), optional :: first_load
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_size_t) :: count
        integer(c_int32_t) :: found_first_load, status

        count = size(fractions, 1, c_size_t)
        if (.not. fits('signals', shape(signals), [6, int(count)], stat, errmsg)) return
        status = pdn_model_add_load_at_places(self%c, first_element, elements, frame, axis_2, &
            fractions, raw_of(signals), count, found_first_load)
        if (status == PDN_OK) then
            if (present(first_load)) first_load = found_first_load
        end if
        call report(status, stat, errmsg)
    end subroutine model_add_load_at_places

    ! Describes everything in a frame that turns about a fixed axis at a constant rate, in place
    ! of any set before: motions that repeat themselves but for a turn in each period are periodic
    ! there.
    subroutine model_set_turning_frame(self, axis, rate, point, stat, errmsg)
        class(pdn_model), intent(inout) :: self
        real(c_double), intent(in) :: axis(3), rate
        real(c_double), intent(in), optional :: point(3)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: status

        status = pdn_model_set_turning_frame(self%c, axis, rate, point)
        call report(status, stat, errmsg)
    end subroutine model_set_turning_frame

    ! The frame that a model is described in, if it turns.
    subroutine model_turning_frame(self, axis, rate, point, stat, errmsg)
        class(pdn_model), intent(in) :: self
        real(c_double), intent(inout) :: axis(3), rate, point(3)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        real(c_double) :: found_rate
        integer(c_int32_t) :: status

        status = pdn_model_turning_frame(self%c, axis, found_rate, point)
        if (status == PDN_OK) rate = found_rate
        call report(status, stat, errmsg)
    end subroutine model_turning_frame

    ! Lets the frame that everything is described in advance along its axis at a constant speed,
    ! too: motions that repeat themselves but for a translation in each period, or for a screw
    ! motion, are periodic there.
    subroutine model_set_frame_advance(self, speed, stat, errmsg)
        class(pdn_model), intent(inout) :: self
        real(c_double), intent(in) :: speed
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: status

        status = pdn_model_set_frame_advance(self%c, speed)
        call report(status, stat, errmsg)
    end subroutine model_set_frame_advance

    ! Speed along its axis of the frame that a model is described in.
    subroutine model_frame_advance(self, speed, stat, errmsg)
        class(pdn_model), intent(in) :: self
        real(c_double), intent(inout) :: speed
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        real(c_double) :: found_speed
        integer(c_int32_t) :: status

        status = pdn_model_frame_advance(self%c, found_speed)
        if (status == PDN_OK) speed = found_speed
        call report(status, stat, errmsg)
    end subroutine model_frame_advance

    ! Lets a rigid body, or a mass or inertia on a node, spin at a constant rate relative to its
    ! node, about an axis through its centre of mass which is fixed in the node: a disk, a rotor,
    ! a flywheel with its gyroscopic moments, on a node that does not turn with it.
    subroutine model_set_spin(self, inertia, axis, rate, stat, errmsg)
        class(pdn_model), intent(inout) :: self
        integer(c_int32_t), intent(in) :: inertia
        real(c_double), intent(in) :: axis(3), rate
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: status

        status = pdn_model_set_spin(self%c, inertia, axis, rate)
        call report(status, stat, errmsg)
    end subroutine model_set_spin

    ! How an inertia spins relative to its node, if it does.
    subroutine model_spin(self, inertia, axis, rate, stat, errmsg)
        class(pdn_model), intent(in) :: self
        integer(c_int32_t), intent(in) :: inertia
        real(c_double), intent(inout) :: axis(3), rate
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        real(c_double) :: found_rate
        integer(c_int32_t) :: status

        status = pdn_model_spin(self%c, inertia, axis, found_rate)
        if (status == PDN_OK) rate = found_rate
        call report(status, stat, errmsg)
    end subroutine model_spin

    ! Lets the material of beam elements spin about axis 1 of their sections at a constant rate
    ! relative to their nodes, which do not spin along: a shaft that turns, and whirls by small
    ! angles about where it stands, as set_spin lets a disk on it.
    subroutine model_set_beam_spin(self, first_element, elements, rate, stat, errmsg)
        class(pdn_model), intent(inout) :: self
        integer(c_int32_t), intent(in) :: first_element, elements
        real(c_double), intent(in) :: rate
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: status

        status = pdn_model_set_beam_spin(self%c, first_element, elements, rate)
        call report(status, stat, errmsg)
    end subroutine model_set_beam_spin

    ! The rate at which the material of a beam element spins relative to its nodes.
    subroutine model_beam_spin(self, element, rate, stat, errmsg)
        class(pdn_model), intent(in) :: self
        integer(c_int32_t), intent(in) :: element
        real(c_double), intent(inout) :: rate
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        real(c_double) :: found_rate
        integer(c_int32_t) :: status

        status = pdn_model_beam_spin(self%c, element, found_rate)
        if (status == PDN_OK) rate = found_rate
        call report(status, stat, errmsg)
    end subroutine model_beam_spin

    ! Says that the blades of a rotor are alike, in place of what was said before: periodic
    ! solves, also under conditions, then solve for one blade, the hub and the supports, and the
    ! others follow.
    subroutine model_set_rotor_symmetry(self, axis, blades, nodes, hub, point, stat, errmsg)
        class(pdn_model), intent(inout) :: self
        real(c_double), intent(in) :: axis(3)
        integer(c_int32_t), intent(in) :: blades
        integer(c_int32_t), intent(in), contiguous :: nodes(:), hub(:)
        real(c_double), intent(in), optional :: point(3)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_size_t) :: count, hub_count
        integer(c_int32_t) :: status

        count = size(nodes, 1, c_size_t)
        hub_count = size(hub, 1, c_size_t)
        status = pdn_model_set_rotor_symmetry(self%c, axis, blades, nodes, count, hub, &
            hub_count, point)
        call report(status, stat, errmsg)
    end subroutine model_set_rotor_symmetry

    ! The rotor whose blades were said to be alike.
    subroutine model_rotor_symmetry(self, axis, point, blades, nodes_of_blade, hub_nodes, stat, &
        errmsg)
        class(pdn_model), intent(in) :: self
        real(c_double), intent(inout) :: axis(3), point(3)
        integer(c_int32_t), intent(inout) :: blades, nodes_of_blade, hub_nodes
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: found_blades, found_nodes_of_blade, found_hub_nodes, status

        status = pdn_model_rotor_symmetry(self%c, axis, point, found_blades, &
            found_nodes_of_blade, found_hub_nodes)
        if (status == PDN_OK) then
            blades = found_blades
            nodes_of_blade = found_nodes_of_blade
            hub_nodes = found_hub_nodes
        end if
        call report(status, stat, errmsg)
    end subroutine model_rotor_symmetry

    ! A node of a rotor whose blades were said to be alike.
    subroutine model_rotor_node(self, blade, index, node, stat, errmsg)
        class(pdn_model), intent(in) :: self
        integer(c_int32_t), intent(in) :: blade, index
        integer(c_int32_t), intent(inout) :: node
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: found_node, status

        status = pdn_model_rotor_node(self%c, blade, index, found_node)
        if (status == PDN_OK) node = found_node
        call report(status, stat, errmsg)
    end subroutine model_rotor_node

    ! Adds a shell element over a grid of nodes that are there.
    subroutine model_add_shell_element(self, nodes, n_xi, section, placement, element, stat, &
        errmsg)
        class(pdn_model), intent(inout) :: self
        integer(c_int32_t), intent(in), contiguous :: nodes(:)
        integer(c_int32_t), intent(in) :: n_xi
        type(pdn_shell_section), intent(in) :: section
        type(pdn_shell_placement), intent(in), optional :: placement
        integer(c_int32_t), intent(inout), optional :: element
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_size_t) :: count
        integer(c_int32_t) :: found_element, status

        count = size(nodes, 1, c_size_t)
        status = pdn_model_add_shell_element(self%c, nodes, count, int(max(n_xi, 0), c_size_t), &
            section, placement, found_element)
        if (status == PDN_OK) then
            if (present(element)) element = found_element
        end if
        call report(status, stat, errmsg)
    end subroutine model_add_shell_element

    ! Adds a shell over a surface, with elements in equal parts of u and v: its nodes and
    ! elements.
    subroutine model_add_shell(self, surface, elements_u, elements_v, degree_u, degree_v, &
        section, shell, join, placement, stat, errmsg)
        class(pdn_model), intent(inout) :: self
        type(pdn_surface), intent(in) :: surface
        integer(c_int32_t), intent(in) :: elements_u, elements_v, degree_u, degree_v
        type(pdn_shell_section), intent(in) :: section
        type(pdn_shell), intent(inout) :: shell
        logical, intent(in), optional :: join
        type(pdn_shell_placement), intent(in), optional :: placement
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: raw_join
        type(pdn_shell) :: found_shell
        integer(c_int32_t) :: status

        raw_join = 1_c_int32_t
        if (present(join)) raw_join = merge(1_c_int32_t, 0_c_int32_t, join)
        status = pdn_model_add_shell(self%c, surface, int(max(elements_u, 0), c_size_t), &
            int(max(elements_v, 0), c_size_t), int(max(degree_u, 0), c_size_t), &
            int(max(degree_v, 0), c_size_t), raw_join, section, placement, found_shell)
        if (status == PDN_OK) shell = found_shell
        call report(status, stat, errmsg)
    end subroutine model_add_shell

    ! Adds a shell over given positions of its nodes, as add_shell does over a surface.
    subroutine model_add_shell_grid(self, points, elements_u, elements_v, degree_u, degree_v, &
        section, shell, join, placement, stat, errmsg)
        class(pdn_model), intent(inout) :: self
        real(c_double), intent(in), contiguous :: points(:, :)
        integer(c_int32_t), intent(in) :: elements_u, elements_v, degree_u, degree_v
        type(pdn_shell_section), intent(in) :: section
        type(pdn_shell), intent(inout) :: shell
        logical, intent(in), optional :: join
        type(pdn_shell_placement), intent(in), optional :: placement
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_size_t) :: count
        integer(c_int32_t) :: raw_join
        type(pdn_shell) :: found_shell
        integer(c_int32_t) :: status

        count = size(points, 2, c_size_t)
        if (.not. fits('points', shape(points), [3, int(count)], stat, errmsg)) return
        raw_join = 1_c_int32_t
        if (present(join)) raw_join = merge(1_c_int32_t, 0_c_int32_t, join)
        status = pdn_model_add_shell_grid(self%c, points, count, int(max(elements_u, 0), &
            c_size_t), int(max(elements_v, 0), c_size_t), int(max(degree_u, 0), c_size_t), &
            int(max(degree_v, 0), c_size_t), raw_join, section, placement, found_shell)
        if (status == PDN_OK) shell = found_shell
        call report(status, stat, errmsg)
    end subroutine model_add_shell_grid

    ! Adds a shell element for each cell of a mesh of quadrilaterals, as mesh generators make
    ! them.
    subroutine model_add_shell_quadrilaterals(self, points, cells, points_of_cell, degree, &
        section, placement, first_element, stat, errmsg)
        class(pdn_model), intent(inout) :: self
        real(c_double), intent(in), contiguous :: points(:, :)
        integer(c_int32_t), intent(in), contiguous :: cells(:)
        integer(c_int32_t), intent(in) :: points_of_cell, degree
        type(pdn_shell_section), intent(in) :: section
        type(pdn_shell_placement), intent(in), optional :: placement
        integer(c_int32_t), intent(inout), optional :: first_element
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_size_t) :: point_count, count
        integer(c_int32_t) :: found_first_element, status

        point_count = size(points, 2, c_size_t)
        count = size(cells, 1, c_size_t)
        if (.not. fits('points', shape(points), [3, int(point_count)], stat, errmsg)) return
        status = pdn_model_add_shell_quadrilaterals(self%c, points, point_count, cells, count, &
            int(max(points_of_cell, 0), c_size_t), int(max(degree, 0), c_size_t), section, &
            placement, found_first_element)
        if (status == PDN_OK) then
            if (present(first_element)) first_element = found_first_element
        end if
        call report(status, stat, errmsg)
    end subroutine model_add_shell_quadrilaterals

    ! Node of a shell over a surface or a grid.
    subroutine model_shell_patch_node(self, shell, u, v, node, stat, errmsg)
        class(pdn_model), intent(in) :: self
        type(pdn_shell), intent(in) :: shell
        integer(c_int32_t), intent(in) :: u, v
        integer(c_int32_t), intent(inout) :: node
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: found_node, status

        status = pdn_model_shell_patch_node(self%c, shell, u, v, found_node)
        if (status == PDN_OK) node = found_node
        call report(status, stat, errmsg)
    end subroutine model_shell_patch_node

    ! Number of shell elements; their ids follow each other from PDN_FIRST_SHELL_ELEMENT on.
    subroutine model_shell_element_count(self, count, stat, errmsg)
        class(pdn_model), intent(in) :: self
        integer(c_int32_t), intent(inout) :: count
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: found_count, status

        status = pdn_model_shell_element_count(self%c, found_count)
        if (status == PDN_OK) count = found_count
        call report(status, stat, errmsg)
    end subroutine model_shell_element_count

    ! Node of a shell element.
    subroutine model_shell_node(self, element, xi, eta, node, stat, errmsg)
        class(pdn_model), intent(in) :: self
        integer(c_int32_t), intent(in) :: element, xi, eta
        integer(c_int32_t), intent(inout) :: node
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: found_node, status

        status = pdn_model_shell_node(self%c, element, xi, eta, found_node)
        if (status == PDN_OK) node = found_node
        call report(status, stat, errmsg)
    end subroutine model_shell_node

    ! Adds one component of a force or moment on shell elements, in addition to those that are
    ! there: for each unit of reference area, or of reference length of an edge.
    subroutine model_add_shell_load(self, first_element, elements, place, frame, component, &
        signal, load, stat, errmsg)
        class(pdn_model), intent(inout) :: self
        integer(c_int32_t), intent(in) :: first_element, elements, place, frame, component
        type(pdn_signal), intent(in), target :: signal
        integer(c_int32_t), intent(inout), optional :: load
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: found_load, status

        status = pdn_model_add_shell_load(self%c, first_element, elements, place, frame, &
            component, raw_of(signal), found_load)
        if (status == PDN_OK) then
            if (present(load)) load = found_load
        end if
        call report(status, stat, errmsg)
    end subroutine model_add_shell_load

    ! Gives shell elements forces and moments where nothing is strained: initial stress, in place
    ! of any before.
    subroutine model_set_shell_prestress(self, first_element, elements, resultants, stat, &
        errmsg)
        class(pdn_model), intent(inout) :: self
        integer(c_int32_t), intent(in) :: first_element, elements
        real(c_double), intent(in) :: resultants(12)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: status

        status = pdn_model_set_shell_prestress(self%c, first_element, elements, resultants)
        call report(status, stat, errmsg)
    end subroutine model_set_shell_prestress

    ! Fixes nodes to a body, by a rigid joint each as add_rigid_joint makes: such as the nodes
    ! along an edge of a shell, which then moves as a part of the body.
    subroutine model_add_rigid_joints(self, body, nodes, first_joint, joints, stat, errmsg)
        class(pdn_model), intent(inout) :: self
        integer(c_int32_t), intent(in) :: body
        integer(c_int32_t), intent(in), contiguous :: nodes(:)
        integer(c_int32_t), intent(inout), optional :: first_joint, joints
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_size_t) :: count
        integer(c_int32_t) :: found_first_joint, found_joints, status

        count = size(nodes, 1, c_size_t)
        status = pdn_model_add_rigid_joints(self%c, body, nodes, count, found_first_joint, &
            found_joints)
        if (status == PDN_OK) then
            if (present(first_joint)) first_joint = found_first_joint
            if (present(joints)) joints = found_joints
        end if
        call report(status, stat, errmsg)
    end subroutine model_add_rigid_joints

    ! Fixes a whole edge of a shell over a surface or a grid to a body: add_rigid_joints with the
    ! nodes along it.
    subroutine model_add_rigid_edge(self, body, shell, edge, first_joint, joints, stat, errmsg)
        class(pdn_model), intent(inout) :: self
        integer(c_int32_t), intent(in) :: body
        type(pdn_shell), intent(in) :: shell
        integer(c_int32_t), intent(in) :: edge
        integer(c_int32_t), intent(inout), optional :: first_joint, joints
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: found_first_joint, found_joints, status

        status = pdn_model_add_rigid_edge(self%c, body, shell, edge, found_first_joint, &
            found_joints)
        if (status == PDN_OK) then
            if (present(first_joint)) first_joint = found_first_joint
            if (present(joints)) joints = found_joints
        end if
        call report(status, stat, errmsg)
    end subroutine model_add_rigid_edge

    ! Number of forces: springs, dampers, actuators and the like, but not loads; their ids follow
    ! each other from PDN_FIRST_FORCE on.
    subroutine model_force_count(self, count, stat, errmsg)
        class(pdn_model), intent(in) :: self
        integer(c_int32_t), intent(inout) :: count
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: found_count, status

        status = pdn_model_force_count(self%c, found_count)
        if (status == PDN_OK) count = found_count
        call report(status, stat, errmsg)
    end subroutine model_force_count

    ! Adds a linear spring with a damper on a joint coordinate, in addition to those that are
    ! there.
    subroutine model_add_spring_damper(self, joint, coordinate, stiffness, damping, rest, force, &
        stat, errmsg)
        class(pdn_model), intent(inout) :: self
        integer(c_int32_t), intent(in) :: joint, coordinate
        real(c_double), intent(in) :: stiffness
        real(c_double), intent(in), optional :: damping, rest
        integer(c_int32_t), intent(inout), optional :: force
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        real(c_double) :: raw_damping, raw_rest
        integer(c_int32_t) :: found_force, status

        raw_damping = 0.0_c_double
        if (present(damping)) raw_damping = damping
        raw_rest = 0.0_c_double
        if (present(rest)) raw_rest = rest
        status = pdn_model_add_spring_damper(self%c, joint, coordinate, stiffness, raw_damping, &
            raw_rest, found_force)
        if (status == PDN_OK) then
            if (present(force)) force = found_force
        end if
        call report(status, stat, errmsg)
    end subroutine model_add_spring_damper

    ! Adds a nonlinear spring with a damper on a joint coordinate: polynomials of the coordinate
    ! and its rate.
    subroutine model_add_nonlinear_spring_damper(self, joint, coordinate, stiffness, damping, &
        rest, force, stat, errmsg)
        class(pdn_model), intent(inout) :: self
        integer(c_int32_t), intent(in) :: joint, coordinate
        real(c_double), intent(in), contiguous, optional :: stiffness(:), damping(:)
        real(c_double), intent(in), optional :: rest
        integer(c_int32_t), intent(inout), optional :: force
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_size_t) :: stiffness_count, damping_count
        real(c_double) :: raw_rest
        integer(c_int32_t) :: found_force, status

        stiffness_count = 0
        if (present(stiffness)) stiffness_count = size(stiffness, 1, c_size_t)
        damping_count = 0
        if (present(damping)) damping_count = size(damping, 1, c_size_t)
        raw_rest = 0.0_c_double
        if (present(rest)) raw_rest = rest
        status = pdn_model_add_nonlinear_spring_damper(self%c, joint, coordinate, stiffness, &
            stiffness_count, damping, damping_count, raw_rest, found_force)
        if (status == PDN_OK) then
            if (present(force)) force = found_force
        end if
        call report(status, stat, errmsg)
    end subroutine model_add_nonlinear_spring_damper

    ! Adds an actuator: a force on a displacement, or a torque on an angle, that follows a signal.
    subroutine model_add_actuator(self, joint, coordinate, signal, force, stat, errmsg)
        class(pdn_model), intent(inout) :: self
        integer(c_int32_t), intent(in) :: joint, coordinate
        type(pdn_signal), intent(in), target :: signal
        integer(c_int32_t), intent(inout), optional :: force
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: found_force, status

        status = pdn_model_add_actuator(self%c, joint, coordinate, raw_of(signal), found_force)
        if (status == PDN_OK) then
            if (present(force)) force = found_force
        end if
        call report(status, stat, errmsg)
    end subroutine model_add_actuator

    ! Adds a viscoelastic element on a joint coordinate: a generalised Maxwell model.
    subroutine model_add_viscoelastic(self, joint, coordinate, stiffness, rest, &
        branch_stiffness, relaxation_times, force, stat, errmsg)
        class(pdn_model), intent(inout) :: self
        integer(c_int32_t), intent(in) :: joint, coordinate
        real(c_double), intent(in) :: stiffness, rest
        real(c_double), intent(in), contiguous :: branch_stiffness(:), relaxation_times(:)
        integer(c_int32_t), intent(inout), optional :: force
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_size_t) :: branches
        integer(c_int32_t) :: found_force, status

        branches = size(branch_stiffness, 1, c_size_t)
        if (.not. fits('relaxation_times', shape(relaxation_times), [int(branches)], stat, &
            errmsg)) return
        status = pdn_model_add_viscoelastic(self%c, joint, coordinate, stiffness, rest, &
            branch_stiffness, relaxation_times, branches, found_force)
        if (status == PDN_OK) then
            if (present(force)) force = found_force
        end if
        call report(status, stat, errmsg)
    end subroutine model_add_viscoelastic

    ! Adds a viscous damper between two bodies, with a full matrix of coefficients.
    subroutine model_add_viscous_damper(self, first, second, matrix, frame, force, stat, errmsg)
        class(pdn_model), intent(inout) :: self
        integer(c_int32_t), intent(in) :: first, second
        real(c_double), intent(in) :: matrix(6, 6)
        type(pdn_frame), intent(in), optional :: frame
        integer(c_int32_t), intent(inout), optional :: force
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: found_force, status

        status = pdn_model_add_viscous_damper(self%c, first, second, frame, matrix, found_force)
        if (status == PDN_OK) then
            if (present(force)) force = found_force
        end if
        call report(status, stat, errmsg)
    end subroutine model_add_viscous_damper

    ! Adds a bushing, a bearing or a seal: any matrices of stiffness and damping between two
    ! frames, unsymmetric ones included.
    subroutine model_add_bushing(self, first, second, first_frame, second_frame, stiffness, &
        damping, angles, force, stat, errmsg)
        class(pdn_model), intent(inout) :: self
        integer(c_int32_t), intent(in) :: first, second
        type(pdn_frame), intent(in) :: first_frame, second_frame
        real(c_double), intent(in) :: stiffness(6, 6), damping(6, 6)
        integer(c_int32_t), intent(in) :: angles
        integer(c_int32_t), intent(inout), optional :: force
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: found_force, status

        status = pdn_model_add_bushing(self%c, first, second, first_frame, second_frame, &
            stiffness, damping, angles, found_force)
        if (status == PDN_OK) then
            if (present(force)) force = found_force
        end if
        call report(status, stat, errmsg)
    end subroutine model_add_bushing

    ! Adds a spring-damper on a joint coordinate whose law is a function of the caller.
    subroutine model_add_coordinate_law(self, joint, coordinate, tangents, function, user_data, &
        destroy, force, stat, errmsg)
        class(pdn_model), intent(inout) :: self
        integer(c_int32_t), intent(in) :: joint, coordinate, tangents
        procedure(pdn_coordinate_law_fn) :: function
        type(c_ptr), intent(in), optional :: user_data
        procedure(pdn_destroy_fn), optional :: destroy
        integer(c_int32_t), intent(inout), optional :: force
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(c_ptr) :: raw_user_data
        type(c_funptr) :: raw_destroy
        integer(c_int32_t) :: found_force, status

        raw_user_data = c_null_ptr
        if (present(user_data)) raw_user_data = user_data
        raw_destroy = c_null_funptr
        if (present(destroy)) raw_destroy = c_funloc(destroy)
        status = pdn_model_add_coordinate_law(self%c, joint, coordinate, tangents, &
            c_funloc(function), raw_user_data, raw_destroy, found_force)
        if (status == PDN_OK) then
            if (present(force)) force = found_force
        end if
        call report(status, stat, errmsg)
    end subroutine model_add_coordinate_law

    ! Adds forces on nodes that a function of the caller computes.
    subroutine model_add_user_force(self, nodes, frame, tangents, function, user_data, destroy, &
        force, stat, errmsg)
        class(pdn_model), intent(inout) :: self
        integer(c_int32_t), intent(in), contiguous :: nodes(:)
        integer(c_int32_t), intent(in) :: frame, tangents
        procedure(pdn_user_force_fn) :: function
        type(c_ptr), intent(in), optional :: user_data
        procedure(pdn_destroy_fn), optional :: destroy
        integer(c_int32_t), intent(inout), optional :: force
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_size_t) :: count
        type(c_ptr) :: raw_user_data
        type(c_funptr) :: raw_destroy
        integer(c_int32_t) :: found_force, status

        count = size(nodes, 1, c_size_t)
        raw_user_data = c_null_ptr
        if (present(user_data)) raw_user_data = user_data
        raw_destroy = c_null_funptr
        if (present(destroy)) raw_destroy = c_funloc(destroy)
        status = pdn_model_add_user_force(self%c, nodes, count, frame, tangents, &
            c_funloc(function), raw_user_data, raw_destroy, found_force)
        if (status == PDN_OK) then
            if (present(force)) force = found_force
        end if
        call report(status, stat, errmsg)
    end subroutine model_add_user_force

    ! Declares that the force on each node of a function's force depends on time and on the motion
    ! of this node alone, as that of the air on points of a wing by strips does.
    subroutine model_declare_nodes_apart(self, force, stat, errmsg)
        class(pdn_model), intent(inout) :: self
        integer(c_int32_t), intent(in) :: force
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: status

        status = pdn_model_declare_nodes_apart(self%c, force)
        call report(status, stat, errmsg)
    end subroutine model_declare_nodes_apart

    ! Compares the tangents that a user's function gives with differences of its forces.
    subroutine model_check_tangents(self, force, period, check, stat, errmsg)
        class(pdn_model), intent(in) :: self
        integer(c_int32_t), intent(in) :: force
        real(c_double), intent(in) :: period
        type(pdn_tangent_check), intent(inout) :: check
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(pdn_tangent_check) :: found_check
        integer(c_int32_t) :: status

        call pdn_init(found_check)
        status = pdn_model_check_tangents(self%c, force, period, found_check)
        if (status == PDN_OK) check = found_check
        call report(status, stat, errmsg)
    end subroutine model_check_tangents

    ! Adds a controller: efforts on joint coordinates by a function of the caller that reads any
    ! joint coordinates and their rates, and may have states of its own.
    subroutine model_add_controller(self, output_joints, output_coordinates, tangents, function, &
        input_joints, input_coordinates, initial, sizes, user_data, destroy, force, stat, &
        errmsg)
        class(pdn_model), intent(inout) :: self
        integer(c_int32_t), intent(in), contiguous :: output_joints(:), output_coordinates(:)
        integer(c_int32_t), intent(in) :: tangents
        procedure(pdn_controller_fn) :: function
        integer(c_int32_t), intent(in), contiguous, optional :: input_joints(:), &
            input_coordinates(:)
        real(c_double), intent(in), contiguous, optional :: initial(:), sizes(:)
        type(c_ptr), intent(in), optional :: user_data
        procedure(pdn_destroy_fn), optional :: destroy
        integer(c_int32_t), intent(inout), optional :: force
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_size_t) :: input_count, output_count, state_count
        type(c_ptr) :: raw_user_data
        type(c_funptr) :: raw_destroy
        integer(c_int32_t) :: found_force, status

        input_count = 0
        if (present(input_coordinates)) input_count = size(input_coordinates, 1, c_size_t)
        if (present(input_joints)) input_count = size(input_joints, 1, c_size_t)
        output_count = size(output_joints, 1, c_size_t)
        state_count = 0
        if (present(sizes)) state_count = size(sizes, 1, c_size_t)
        if (present(initial)) state_count = size(initial, 1, c_size_t)
        if (present(input_coordinates)) then
            if (.not. fits('input_coordinates', shape(input_coordinates), [int(input_count)], &
                stat, errmsg)) return
        end if
        if (.not. fits('output_coordinates', shape(output_coordinates), [int(output_count)], &
            stat, errmsg)) return
        if (present(sizes)) then
            if (.not. fits('sizes', shape(sizes), [int(state_count)], stat, errmsg)) return
        end if
        raw_user_data = c_null_ptr
        if (present(user_data)) raw_user_data = user_data
        raw_destroy = c_null_funptr
        if (present(destroy)) raw_destroy = c_funloc(destroy)
        status = pdn_model_add_controller(self%c, input_joints, input_coordinates, input_count, &
            output_joints, output_coordinates, output_count, initial, sizes, state_count, &
            tangents, c_funloc(function), raw_user_data, raw_destroy, found_force)
        if (status == PDN_OK) then
            if (present(force)) force = found_force
        end if
        call report(status, stat, errmsg)
    end subroutine model_add_controller

    ! Numbers of the coordinates that a controller reads, of those that it acts on, and of its
    ! states.
    subroutine model_controller_counts(self, force, input_count, output_count, state_count, &
        stat, errmsg)
        class(pdn_model), intent(in) :: self
        integer(c_int32_t), intent(in) :: force
        integer(c_int32_t), intent(inout), optional :: input_count, output_count, state_count
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: found_input_count, found_output_count, found_state_count, status

        status = pdn_model_controller_counts(self%c, force, found_input_count, &
            found_output_count, found_state_count)
        if (status == PDN_OK) then
            if (present(input_count)) input_count = found_input_count
            if (present(output_count)) output_count = found_output_count
            if (present(state_count)) state_count = found_state_count
        end if
        call report(status, stat, errmsg)
    end subroutine model_controller_counts

    ! A coordinate that a controller reads or acts on.
    subroutine model_controller_coordinate(self, force, index, joint, coordinate, stat, errmsg)
        class(pdn_model), intent(in) :: self
        integer(c_int32_t), intent(in) :: force, index
        integer(c_int32_t), intent(inout) :: joint, coordinate
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: found_joint, found_coordinate, status

        status = pdn_model_controller_coordinate(self%c, force, index, found_joint, &
            found_coordinate)
        if (status == PDN_OK) then
            joint = found_joint
            coordinate = found_coordinate
        end if
        call report(status, stat, errmsg)
    end subroutine model_controller_coordinate

    ! A state of a controller.
    subroutine model_controller_state(self, force, index, initial, size, stat, errmsg)
        class(pdn_model), intent(in) :: self
        integer(c_int32_t), intent(in) :: force, index
        real(c_double), intent(inout), optional :: initial, size
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        real(c_double) :: found_initial, found_size
        integer(c_int32_t) :: status

        status = pdn_model_controller_state(self%c, force, index, found_initial, found_size)
        if (status == PDN_OK) then
            if (present(initial)) initial = found_initial
            if (present(size)) size = found_size
        end if
        call report(status, stat, errmsg)
    end subroutine model_controller_state

    ! Adds forces on shell elements that a function of the caller computes at the points of a
    ! quadrature: a force, with an id of its own, for each element.
    subroutine model_add_surface_force(self, first_element, elements, place, frame, tangents, &
        function, user_data, destroy, first_force, stat, errmsg)
        class(pdn_model), intent(inout) :: self
        integer(c_int32_t), intent(in) :: first_element, elements, place, frame, tangents
        procedure(pdn_surface_force_fn) :: function
        type(c_ptr), intent(in), optional :: user_data
        procedure(pdn_destroy_fn), optional :: destroy
        integer(c_int32_t), intent(inout), optional :: first_force
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(c_ptr) :: raw_user_data
        type(c_funptr) :: raw_destroy
        integer(c_int32_t) :: found_first_force, status

        raw_user_data = c_null_ptr
        if (present(user_data)) raw_user_data = user_data
        raw_destroy = c_null_funptr
        if (present(destroy)) raw_destroy = c_funloc(destroy)
        status = pdn_model_add_surface_force(self%c, first_element, elements, place, frame, &
            tangents, c_funloc(function), raw_user_data, raw_destroy, found_first_force)
        if (status == PDN_OK) then
            if (present(first_force)) first_force = found_first_force
        end if
        call report(status, stat, errmsg)
    end subroutine model_add_surface_force

    ! Adds forces along beam elements that a function of the caller computes at the points of a
    ! quadrature, such as those of the air on a blade: a force, with an id of its own, for each
    ! element.
    subroutine model_add_line_force(self, first_element, elements, frame, tangents, function, &
        axis_2, user_data, destroy, first_force, stat, errmsg)
        class(pdn_model), intent(inout) :: self
        integer(c_int32_t), intent(in) :: first_element, elements, frame, tangents
        procedure(pdn_surface_force_fn) :: function
        real(c_double), intent(in), optional :: axis_2(3)
        type(c_ptr), intent(in), optional :: user_data
        procedure(pdn_destroy_fn), optional :: destroy
        integer(c_int32_t), intent(inout), optional :: first_force
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(c_ptr) :: raw_user_data
        type(c_funptr) :: raw_destroy
        integer(c_int32_t) :: found_first_force, status

        raw_user_data = c_null_ptr
        if (present(user_data)) raw_user_data = user_data
        raw_destroy = c_null_funptr
        if (present(destroy)) raw_destroy = c_funloc(destroy)
        status = pdn_model_add_line_force(self%c, first_element, elements, frame, axis_2, &
            tangents, c_funloc(function), raw_user_data, raw_destroy, found_first_force)
        if (status == PDN_OK) then
            if (present(first_force)) first_force = found_first_force
        end if
        call report(status, stat, errmsg)
    end subroutine model_add_line_force

    ! Gives a controller its function, or another one: that of a model from a file is not there.
    subroutine model_bind_controller(self, force, tangents, function, user_data, destroy, stat, &
        errmsg)
        class(pdn_model), intent(inout) :: self
        integer(c_int32_t), intent(in) :: force, tangents
        procedure(pdn_controller_fn) :: function
        type(c_ptr), intent(in), optional :: user_data
        procedure(pdn_destroy_fn), optional :: destroy
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(c_ptr) :: raw_user_data
        type(c_funptr) :: raw_destroy
        integer(c_int32_t) :: status

        raw_user_data = c_null_ptr
        if (present(user_data)) raw_user_data = user_data
        raw_destroy = c_null_funptr
        if (present(destroy)) raw_destroy = c_funloc(destroy)
        status = pdn_model_bind_controller(self%c, force, tangents, c_funloc(function), &
            raw_user_data, raw_destroy)
        call report(status, stat, errmsg)
    end subroutine model_bind_controller

    ! Gives a coordinate law its function, or another one: that of a model from a file is not
    ! there.
    subroutine model_bind_coordinate_law(self, force, tangents, function, user_data, destroy, &
        stat, errmsg)
        class(pdn_model), intent(inout) :: self
        integer(c_int32_t), intent(in) :: force, tangents
        procedure(pdn_coordinate_law_fn) :: function
        type(c_ptr), intent(in), optional :: user_data
        procedure(pdn_destroy_fn), optional :: destroy
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(c_ptr) :: raw_user_data
        type(c_funptr) :: raw_destroy
        integer(c_int32_t) :: status

        raw_user_data = c_null_ptr
        if (present(user_data)) raw_user_data = user_data
        raw_destroy = c_null_funptr
        if (present(destroy)) raw_destroy = c_funloc(destroy)
        status = pdn_model_bind_coordinate_law(self%c, force, tangents, c_funloc(function), &
            raw_user_data, raw_destroy)
        call report(status, stat, errmsg)
    end subroutine model_bind_coordinate_law

    ! Gives forces on nodes their function, or another one: that of a model from a file is not
    ! there.
    subroutine model_bind_user_force(self, force, frame, tangents, function, user_data, destroy, &
        stat, errmsg)
        class(pdn_model), intent(inout) :: self
        integer(c_int32_t), intent(in) :: force, frame, tangents
        procedure(pdn_user_force_fn) :: function
        type(c_ptr), intent(in), optional :: user_data
        procedure(pdn_destroy_fn), optional :: destroy
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(c_ptr) :: raw_user_data
        type(c_funptr) :: raw_destroy
        integer(c_int32_t) :: status

        raw_user_data = c_null_ptr
        if (present(user_data)) raw_user_data = user_data
        raw_destroy = c_null_funptr
        if (present(destroy)) raw_destroy = c_funloc(destroy)
        status = pdn_model_bind_user_force(self%c, force, frame, tangents, c_funloc(function), &
            raw_user_data, raw_destroy)
        call report(status, stat, errmsg)
    end subroutine model_bind_user_force

    ! Gives forces on shell or beam elements their function, or another one: that of a model from
    ! a file is not there.
    subroutine model_bind_surface_force(self, first_force, forces, frame, tangents, function, &
        user_data, destroy, stat, errmsg)
        class(pdn_model), intent(inout) :: self
        integer(c_int32_t), intent(in) :: first_force, forces, frame, tangents
        procedure(pdn_surface_force_fn) :: function
        type(c_ptr), intent(in), optional :: user_data
        procedure(pdn_destroy_fn), optional :: destroy
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(c_ptr) :: raw_user_data
        type(c_funptr) :: raw_destroy
        integer(c_int32_t) :: status

        raw_user_data = c_null_ptr
        if (present(user_data)) raw_user_data = user_data
        raw_destroy = c_null_funptr
        if (present(destroy)) raw_destroy = c_funloc(destroy)
        status = pdn_model_bind_surface_force(self%c, first_force, forces, frame, tangents, &
            c_funloc(function), raw_user_data, raw_destroy)
        call report(status, stat, errmsg)
    end subroutine model_bind_surface_force

    ! Gives what follows a signal another one: a load, an actuator, a prescribed coordinate.
    subroutine model_set_signal(self, id, component, signal, stat, errmsg)
        class(pdn_model), intent(inout) :: self
        integer(c_int32_t), intent(in) :: id, component
        type(pdn_signal), intent(in), target :: signal
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: status

        status = pdn_model_set_signal(self%c, id, component, raw_of(signal))
        call report(status, stat, errmsg)
    end subroutine model_set_signal

    ! Gives a force other numbers of a sort, as many as it has: those that force_number tells.
    subroutine model_set_force_numbers(self, force, number, values, stat, errmsg)
        class(pdn_model), intent(inout) :: self
        integer(c_int32_t), intent(in) :: force, number
        real(c_double), intent(in), contiguous :: values(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_size_t) :: count
        integer(c_int32_t) :: status

        count = size(values, 1, c_size_t)
        status = pdn_model_set_force_numbers(self%c, force, number, values, count)
        call report(status, stat, errmsg)
    end subroutine model_set_force_numbers

    ! Gives a load, on a node, at a point, along beam elements or on shell elements, another
    ! frame; its signals stay.
    subroutine model_set_load_frame(self, load, frame, axis_2, stat, errmsg)
        class(pdn_model), intent(inout) :: self
        integer(c_int32_t), intent(in) :: load, frame
        real(c_double), intent(in), optional :: axis_2(3)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: status

        status = pdn_model_set_load_frame(self%c, load, frame, axis_2)
        call report(status, stat, errmsg)
    end subroutine model_set_load_frame

    ! Gives beam elements another section, the same all along them; their twist stays, and so do
    ! the factors of parameters.
    subroutine model_set_beam_section(self, first_element, elements, section, stat, errmsg)
        class(pdn_model), intent(inout) :: self
        integer(c_int32_t), intent(in) :: first_element, elements
        type(pdn_section), intent(in) :: section
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: status

        status = pdn_model_set_beam_section(self%c, first_element, elements, section)
        call report(status, stat, errmsg)
    end subroutine model_set_beam_section

    ! Gives shell elements another section; frames, offset and the direction of its axes stay, and
    ! so do the factors of parameters.
    subroutine model_set_shell_section(self, first_element, elements, section, stat, errmsg)
        class(pdn_model), intent(inout) :: self
        integer(c_int32_t), intent(in) :: first_element, elements
        type(pdn_shell_section), intent(in) :: section
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: status

        status = pdn_model_set_shell_section(self%c, first_element, elements, section)
        call report(status, stat, errmsg)
    end subroutine model_set_shell_section

    ! Gives a rigid body, or a mass or inertia on a node, another inertia; the factor of a
    ! parameter stays.
    subroutine model_set_inertia(self, inertia, matrix, stat, errmsg)
        class(pdn_model), intent(inout) :: self
        integer(c_int32_t), intent(in) :: inertia
        real(c_double), intent(in) :: matrix(6, 6)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: status

        status = pdn_model_set_inertia(self%c, inertia, matrix)
        call report(status, stat, errmsg)
    end subroutine model_set_inertia

    ! Gives a node, joint, element, force, load or the like a label, in place of the one that it
    ! has.
    subroutine model_set_label(self, id, label, stat, errmsg)
        class(pdn_model), intent(inout) :: self
        integer(c_int32_t), intent(in) :: id
        character(*), intent(in), optional :: label
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        character(:), allocatable :: raw_label
        integer(c_int32_t) :: status

        if (present(label)) raw_label = trim(label)//c_null_char
        status = pdn_model_set_label(self%c, id, raw_label)
        call report(status, stat, errmsg)
    end subroutine model_set_label

    ! The label of a node, joint, element, force, load or the like.
    function model_label(self, id) result(text)
        class(pdn_model), intent(in) :: self
        integer(c_int32_t), intent(in) :: id
        character(:), allocatable :: text
        integer(c_size_t) :: length

        allocate (character(pdn_model_label(self%c, id, capacity=0_c_size_t) + 1) :: text)
        length = pdn_model_label(self%c, id, text, len(text, c_size_t))
        text = text(:length)
    end function model_label

    ! The node, joint, element, force, load or the like that has a label.
    subroutine model_find_label(self, kind, label, id, stat, errmsg)
        class(pdn_model), intent(in) :: self
        integer(c_int32_t), intent(in) :: kind
        character(*), intent(in) :: label
        integer(c_int32_t), intent(inout) :: id
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: found_id, status

        status = pdn_model_find_label(self%c, kind, trim(label)//c_null_char, found_id)
        if (status == PDN_OK) id = found_id
        call report(status, stat, errmsg)
    end subroutine model_find_label

    ! Finds the periodic response of a model directly, by Fourier spectral collocation.
    subroutine model_solve_periodic(self, period, solution, options, initial, guess_positions, &
        guess_rotations, event_times, event_widths, event_shares, stat, errmsg)
        class(pdn_model), intent(in) :: self
        real(c_double), intent(in) :: period
        type(pdn_solution), intent(inout) :: solution
        type(pdn_periodic_options), intent(in), optional :: options
        type(pdn_solution), intent(in), optional :: initial
        real(c_double), intent(in), target, contiguous, optional :: guess_positions(:, :, :), &
            guess_rotations(:, :, :), event_times(:), event_widths(:), event_shares(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(pdn_periodic_options) :: chosen
        type(c_ptr) :: made
        integer(c_int32_t) :: status

        call pdn_init(chosen)
        if (present(options)) chosen = options
        if (present(initial)) chosen%initial = initial%c
        if (present(guess_positions)) then
            if (.not. fits('guess_positions', shape(guess_positions), [3, &
                int(merge(2*chosen%harmonics + 1, chosen%grid_points, chosen%harmonics > 0)), &
                nodes_of(self)], stat, errmsg)) return
            chosen%guess_positions = c_loc(guess_positions)
        end if
        if (present(guess_rotations)) then
            if (.not. fits('guess_rotations', shape(guess_rotations), [9, &
                int(merge(2*chosen%harmonics + 1, chosen%grid_points, chosen%harmonics > 0)), &
                nodes_of(self)], stat, errmsg)) return
            chosen%guess_rotations = c_loc(guess_rotations)
        end if
        if (present(event_times)) then
            chosen%event_count = size(event_times, kind=c_size_t)
            chosen%event_times = c_loc(event_times)
        end if
        if (present(event_widths)) then
            if (.not. fits('event_widths', shape(event_widths), [int(chosen%event_count)], stat, &
                errmsg)) return
            chosen%event_widths = c_loc(event_widths)
        end if
        if (present(event_shares)) then
            if (.not. fits('event_shares', shape(event_shares), [int(chosen%event_count)], stat, &
                errmsg)) return
            chosen%event_shares = c_loc(event_shares)
        end if
        status = pdn_solve_periodic(self%c, period, chosen, made)
        if (status == PDN_OK) call solution%adopt(made, pdn_solution_free)
        call report(status, stat, errmsg)
    end subroutine model_solve_periodic

    ! Adds a parameter: a named number that moves what move_number and move_signal say.
    subroutine model_add_parameter(self, name, value, scale, out, stat, errmsg)
        class(pdn_model), intent(inout) :: self
        character(*), intent(in) :: name
        real(c_double), intent(in) :: value, scale
        integer(c_int32_t), intent(inout), optional :: out
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: found_out, status

        status = pdn_model_add_parameter(self%c, trim(name)//c_null_char, value, scale, &
            found_out)
        if (status == PDN_OK) then
            if (present(out)) out = found_out
        end if
        call report(status, stat, errmsg)
    end subroutine model_add_parameter

    ! Number of parameters; their ids follow each other from PDN_FIRST_PARAMETER on.
    subroutine model_parameter_count(self, count, stat, errmsg)
        class(pdn_model), intent(in) :: self
        integer(c_int32_t), intent(inout) :: count
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: found_count, status

        status = pdn_model_parameter_count(self%c, found_count)
        if (status == PDN_OK) count = found_count
        call report(status, stat, errmsg)
    end subroutine model_parameter_count

    ! Value and scale of a parameter.
    subroutine model_parameter(self, parameter, value, scale, stat, errmsg)
        class(pdn_model), intent(in) :: self
        integer(c_int32_t), intent(in) :: parameter
        real(c_double), intent(inout) :: value
        real(c_double), intent(inout), optional :: scale
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        real(c_double) :: found_value, found_scale
        integer(c_int32_t) :: status

        status = pdn_model_parameter(self%c, parameter, found_value, found_scale)
        if (status == PDN_OK) then
            value = found_value
            if (present(scale)) scale = found_scale
        end if
        call report(status, stat, errmsg)
    end subroutine model_parameter

    ! The name of a parameter.
    function model_parameter_name(self, parameter) result(text)
        class(pdn_model), intent(in) :: self
        integer(c_int32_t), intent(in) :: parameter
        character(:), allocatable :: text
        integer(c_size_t) :: length

        allocate (character(pdn_model_parameter_name(self%c, parameter, &
            capacity=0_c_size_t) + 1) :: text)
        length = pdn_model_parameter_name(self%c, parameter, text, len(text, c_size_t))
        text = text(:length)
    end function model_parameter_name

    ! The parameter that has a name.
    subroutine model_find_parameter(self, name, parameter, stat, errmsg)
        class(pdn_model), intent(in) :: self
        character(*), intent(in) :: name
        integer(c_int32_t), intent(inout) :: parameter
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: found_parameter, status

        status = pdn_model_find_parameter(self%c, trim(name)//c_null_char, found_parameter)
        if (status == PDN_OK) parameter = found_parameter
        call report(status, stat, errmsg)
    end subroutine model_find_parameter

    ! Lets a parameter move a number of the model: it becomes factor times the parameter's value,
    ! now and whenever that changes.
    subroutine model_move_number(self, parameter, number, id, power, factor, stat, errmsg)
        class(pdn_model), intent(inout) :: self
        integer(c_int32_t), intent(in) :: parameter, number, id, power
        real(c_double), intent(in) :: factor
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: status

        status = pdn_model_move_number(self%c, parameter, number, id, power, factor)
        call report(status, stat, errmsg)
    end subroutine model_move_number

    ! Lets a parameter move a part of a signal: it becomes factor times the parameter's value, now
    ! and whenever that changes.
    subroutine model_move_signal(self, parameter, id, component, part, factor, stat, errmsg)
        class(pdn_model), intent(inout) :: self
        integer(c_int32_t), intent(in) :: parameter, id, component, part
        real(c_double), intent(in) :: factor
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: status

        status = pdn_model_move_signal(self%c, parameter, id, component, part, factor)
        call report(status, stat, errmsg)
    end subroutine model_move_signal

    ! Gives a parameter another value, and all that it moves.
    subroutine model_set_parameter(self, parameter, value, stat, errmsg)
        class(pdn_model), intent(inout) :: self
        integer(c_int32_t), intent(in) :: parameter
        real(c_double), intent(in) :: value
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: status

        status = pdn_model_set_parameter(self%c, parameter, value)
        call report(status, stat, errmsg)
    end subroutine model_set_parameter

    ! Gives everything with mass a force against its motion relative to the inertial frame, factor
    ! times its momentum: damping in proportion to mass.
    subroutine model_set_mass_damping(self, factor, stat, errmsg)
        class(pdn_model), intent(inout) :: self
        real(c_double), intent(in) :: factor
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: status

        status = pdn_model_set_mass_damping(self%c, factor)
        call report(status, stat, errmsg)
    end subroutine model_set_mass_damping

    ! Declares that the function of a force is one of the phase, 2 pi t / T, which it is then told
    ! in place of the time: it holds for any period T, as it must where that is unknown.
    subroutine model_declare_of_phase(self, force, stat, errmsg)
        class(pdn_model), intent(inout) :: self
        integer(c_int32_t), intent(in) :: force
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: status

        status = pdn_model_declare_of_phase(self%c, force)
        call report(status, stat, errmsg)
    end subroutine model_declare_of_phase

    ! Kind, bodies and frames of a joint.
    subroutine model_joint(self, joint, out, stat, errmsg)
        class(pdn_model), intent(in) :: self
        integer(c_int32_t), intent(in) :: joint
        type(pdn_joint_info), intent(inout) :: out
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(pdn_joint_info) :: found_out
        integer(c_int32_t) :: status

        call pdn_init(found_out)
        status = pdn_model_joint(self%c, joint, found_out)
        if (status == PDN_OK) out = found_out
        call report(status, stat, errmsg)
    end subroutine model_joint

    ! Kind of a force, where it acts, and how many numbers it has.
    subroutine model_force(self, force, out, stat, errmsg)
        class(pdn_model), intent(in) :: self
        integer(c_int32_t), intent(in) :: force
        type(pdn_force_info), intent(inout) :: out
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(pdn_force_info) :: found_out
        integer(c_int32_t) :: status

        call pdn_init(found_out)
        status = pdn_model_force(self%c, force, found_out)
        if (status == PDN_OK) out = found_out
        call report(status, stat, errmsg)
    end subroutine model_force

    ! A number of a force, with the factors of parameters.
    subroutine model_force_number(self, force, number, index, out, stat, errmsg)
        class(pdn_model), intent(in) :: self
        integer(c_int32_t), intent(in) :: force, number, index
        real(c_double), intent(inout) :: out
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        real(c_double) :: found_out
        integer(c_int32_t) :: status

        status = pdn_model_force_number(self%c, force, number, index, found_out)
        if (status == PDN_OK) out = found_out
        call report(status, stat, errmsg)
    end subroutine model_force_number

    ! A node of forces of the user.
    subroutine model_force_node(self, force, index, node, stat, errmsg)
        class(pdn_model), intent(in) :: self
        integer(c_int32_t), intent(in) :: force, index
        integer(c_int32_t), intent(inout) :: node
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: found_node, status

        status = pdn_model_force_node(self%c, force, index, found_node)
        if (status == PDN_OK) node = found_node
        call report(status, stat, errmsg)
    end subroutine model_force_node

    ! Number of nodes of a beam element.
    subroutine model_beam_element_node_count(self, element, count, stat, errmsg)
        class(pdn_model), intent(in) :: self
        integer(c_int32_t), intent(in) :: element
        integer(c_int32_t), intent(inout) :: count
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: found_count, status

        status = pdn_model_beam_element_node_count(self%c, element, found_count)
        if (status == PDN_OK) count = found_count
        call report(status, stat, errmsg)
    end subroutine model_beam_element_node_count

    ! A node of a beam element, in order along the beam.
    subroutine model_beam_element_node(self, element, index, node, stat, errmsg)
        class(pdn_model), intent(in) :: self
        integer(c_int32_t), intent(in) :: element, index
        integer(c_int32_t), intent(inout) :: node
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: found_node, status

        status = pdn_model_beam_element_node(self%c, element, index, found_node)
        if (status == PDN_OK) node = found_node
        call report(status, stat, errmsg)
    end subroutine model_beam_element_node

    ! Cross-section of a beam element at a place, with the factors of parameters.
    subroutine model_beam_section(self, element, station, out, twist, stat, errmsg)
        class(pdn_model), intent(in) :: self
        integer(c_int32_t), intent(in) :: element
        real(c_double), intent(in) :: station
        type(pdn_section), intent(inout) :: out
        real(c_double), intent(inout), optional :: twist
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(pdn_section) :: found_out
        real(c_double) :: found_twist
        integer(c_int32_t) :: status

        call pdn_init(found_out)
        status = pdn_model_beam_section(self%c, element, station, found_out, found_twist)
        if (status == PDN_OK) then
            out = found_out
            if (present(twist)) twist = found_twist
        end if
        call report(status, stat, errmsg)
    end subroutine model_beam_section

    ! Number of inertias: bodies, masses and inertias on nodes; their ids follow each other from
    ! PDN_FIRST_INERTIA on.
    subroutine model_inertia_count(self, count, stat, errmsg)
        class(pdn_model), intent(in) :: self
        integer(c_int32_t), intent(inout) :: count
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: found_count, status

        status = pdn_model_inertia_count(self%c, found_count)
        if (status == PDN_OK) count = found_count
        call report(status, stat, errmsg)
    end subroutine model_inertia_count

    ! The inertia of a body, or a mass or inertia on a node, with the factors of parameters.
    subroutine model_inertia(self, inertia, node, matrix, stat, errmsg)
        class(pdn_model), intent(in) :: self
        integer(c_int32_t), intent(in) :: inertia
        integer(c_int32_t), intent(inout) :: node
        real(c_double), intent(inout) :: matrix(6, 6)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: found_node, status

        status = pdn_model_inertia(self%c, inertia, found_node, matrix)
        if (status == PDN_OK) node = found_node
        call report(status, stat, errmsg)
    end subroutine model_inertia

    ! The inertia of a node: of a rigid body its own, of others the one that was added first.
    subroutine model_inertia_of(self, node, inertia, stat, errmsg)
        class(pdn_model), intent(in) :: self
        integer(c_int32_t), intent(in) :: node
        integer(c_int32_t), intent(inout) :: inertia
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: found_inertia, status

        status = pdn_model_inertia_of(self%c, node, found_inertia)
        if (status == PDN_OK) inertia = found_inertia
        call report(status, stat, errmsg)
    end subroutine model_inertia_of

    ! A prescribed coordinate; summary tells how many there are, whose ids follow each other from
    ! PDN_FIRST_PRESCRIBED on, and sample_signal what they follow.
    subroutine model_prescribed(self, prescribed, joint, coordinate, stat, errmsg)
        class(pdn_model), intent(in) :: self
        integer(c_int32_t), intent(in) :: prescribed
        integer(c_int32_t), intent(inout) :: joint, coordinate
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: found_joint, found_coordinate, status

        status = pdn_model_prescribed(self%c, prescribed, found_joint, found_coordinate)
        if (status == PDN_OK) then
            joint = found_joint
            coordinate = found_coordinate
        end if
        call report(status, stat, errmsg)
    end subroutine model_prescribed

    ! Number of coordinates of a linear relation.
    subroutine model_relation_term_count(self, relation, count, stat, errmsg)
        class(pdn_model), intent(in) :: self
        integer(c_int32_t), intent(in) :: relation
        integer(c_int32_t), intent(inout) :: count
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: found_count, status

        status = pdn_model_relation_term_count(self%c, relation, found_count)
        if (status == PDN_OK) count = found_count
        call report(status, stat, errmsg)
    end subroutine model_relation_term_count

    ! A coordinate of a linear relation, and its coefficient.
    subroutine model_relation_term(self, relation, index, joint, coordinate, coefficient, stat, &
        errmsg)
        class(pdn_model), intent(in) :: self
        integer(c_int32_t), intent(in) :: relation, index
        integer(c_int32_t), intent(inout) :: joint, coordinate
        real(c_double), intent(inout) :: coefficient
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: found_joint, found_coordinate
        real(c_double) :: found_coefficient
        integer(c_int32_t) :: status

        status = pdn_model_relation_term(self%c, relation, index, found_joint, found_coordinate, &
            found_coefficient)
        if (status == PDN_OK) then
            joint = found_joint
            coordinate = found_coordinate
            coefficient = found_coefficient
        end if
        call report(status, stat, errmsg)
    end subroutine model_relation_term

    ! Values of a signal of the model in time.
    subroutine model_sample_signal(self, id, component, period, times, values, stat, errmsg)
        class(pdn_model), intent(in) :: self
        integer(c_int32_t), intent(in) :: id, component
        real(c_double), intent(in) :: period
        real(c_double), intent(in), contiguous :: times(:)
        real(c_double), intent(inout), contiguous :: values(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_size_t) :: count
        integer(c_int32_t) :: status

        count = size(times, 1, c_size_t)
        if (.not. fits('values', shape(values), [int(count)], stat, errmsg)) return
        status = pdn_model_sample_signal(self%c, id, component, period, times, count, values)
        call report(status, stat, errmsg)
    end subroutine model_sample_signal

    ! Number of loads on nodes and at points; their ids follow each other from PDN_FIRST_LOAD on.
    subroutine model_load_count(self, count, stat, errmsg)
        class(pdn_model), intent(in) :: self
        integer(c_int32_t), intent(inout) :: count
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: found_count, status

        status = pdn_model_load_count(self%c, found_count)
        if (status == PDN_OK) count = found_count
        call report(status, stat, errmsg)
    end subroutine model_load_count

    ! A load on a node or at a point; its components are signals, sample_signal.
    subroutine model_load_at(self, load, node, first_element, elements, fraction, frame, offset, &
        stat, errmsg)
        class(pdn_model), intent(in) :: self
        integer(c_int32_t), intent(in) :: load
        integer(c_int32_t), intent(inout) :: node, first_element, elements
        real(c_double), intent(inout) :: fraction
        integer(c_int32_t), intent(inout) :: frame
        real(c_double), intent(inout), optional :: offset(3)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: found_node, found_first_element, found_elements
        real(c_double) :: found_fraction
        integer(c_int32_t) :: found_frame, status

        status = pdn_model_load_at(self%c, load, found_node, found_first_element, &
            found_elements, found_fraction, offset, found_frame)
        if (status == PDN_OK) then
            node = found_node
            first_element = found_first_element
            elements = found_elements
            fraction = found_fraction
            frame = found_frame
        end if
        call report(status, stat, errmsg)
    end subroutine model_load_at

    ! Number of loads along beam elements; their ids follow each other from PDN_FIRST_BEAM_LOAD
    ! on.
    subroutine model_beam_load_count(self, count, stat, errmsg)
        class(pdn_model), intent(in) :: self
        integer(c_int32_t), intent(inout) :: count
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: found_count, status

        status = pdn_model_beam_load_count(self%c, found_count)
        if (status == PDN_OK) count = found_count
        call report(status, stat, errmsg)
    end subroutine model_beam_load_count

    ! A load along beam elements; its components are signals, sample_signal, times the factors of
    ! beam_load_factor.
    subroutine model_beam_load(self, load, first_element, elements, frame, places, axis_2, stat, &
        errmsg)
        class(pdn_model), intent(in) :: self
        integer(c_int32_t), intent(in) :: load
        integer(c_int32_t), intent(inout) :: first_element, elements, frame, places
        real(c_double), intent(inout), optional :: axis_2(3)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: found_first_element, found_elements, found_frame, found_places, &
            status

        status = pdn_model_beam_load(self%c, load, found_first_element, found_elements, &
            found_frame, axis_2, found_places)
        if (status == PDN_OK) then
            first_element = found_first_element
            elements = found_elements
            frame = found_frame
            places = found_places
        end if
        call report(status, stat, errmsg)
    end subroutine model_beam_load

    ! Factor of a load along beam elements at a place; it is linear in between.
    subroutine model_beam_load_factor(self, load, index, fraction, factor, stat, errmsg)
        class(pdn_model), intent(in) :: self
        integer(c_int32_t), intent(in) :: load, index
        real(c_double), intent(inout) :: fraction, factor
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        real(c_double) :: found_fraction, found_factor
        integer(c_int32_t) :: status

        status = pdn_model_beam_load_factor(self%c, load, index, found_fraction, found_factor)
        if (status == PDN_OK) then
            fraction = found_fraction
            factor = found_factor
        end if
        call report(status, stat, errmsg)
    end subroutine model_beam_load_factor

    ! Number of loads on shell elements; their ids follow each other from PDN_FIRST_SHELL_LOAD on.
    subroutine model_shell_load_count(self, count, stat, errmsg)
        class(pdn_model), intent(in) :: self
        integer(c_int32_t), intent(inout) :: count
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: found_count, status

        status = pdn_model_shell_load_count(self%c, found_count)
        if (status == PDN_OK) count = found_count
        call report(status, stat, errmsg)
    end subroutine model_shell_load_count

    ! A load on shell elements; its components are signals, sample_signal.
    subroutine model_shell_load(self, load, first_element, elements, place, frame, stat, errmsg)
        class(pdn_model), intent(in) :: self
        integer(c_int32_t), intent(in) :: load
        integer(c_int32_t), intent(inout) :: first_element, elements, place, frame
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: found_first_element, found_elements, found_place, found_frame, &
            status

        status = pdn_model_shell_load(self%c, load, found_first_element, found_elements, &
            found_place, found_frame)
        if (status == PDN_OK) then
            first_element = found_first_element
            elements = found_elements
            place = found_place
            frame = found_frame
        end if
        call report(status, stat, errmsg)
    end subroutine model_shell_load

    ! Finds a periodic response that meets conditions, and the values of as many free parameters.
    subroutine model_solve_conditioned(self, period, conditions, solution, options, initial, &
        guess_positions, guess_rotations, event_times, event_widths, event_shares, stat, errmsg)
        class(pdn_model), intent(in) :: self
        real(c_double), intent(in) :: period
        type(pdn_conditions), intent(in) :: conditions
        type(pdn_solution), intent(inout) :: solution
        type(pdn_periodic_options), intent(in), optional :: options
        type(pdn_solution), intent(in), optional :: initial
        real(c_double), intent(in), target, contiguous, optional :: guess_positions(:, :, :), &
            guess_rotations(:, :, :), event_times(:), event_widths(:), event_shares(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(pdn_periodic_options) :: chosen
        type(c_ptr) :: made
        integer(c_int32_t) :: status

        call pdn_init(chosen)
        if (present(options)) chosen = options
        if (present(initial)) chosen%initial = initial%c
        if (present(guess_positions)) then
            if (.not. fits('guess_positions', shape(guess_positions), [3, &
                int(merge(2*chosen%harmonics + 1, chosen%grid_points, chosen%harmonics > 0)), &
                nodes_of(self)], stat, errmsg)) return
            chosen%guess_positions = c_loc(guess_positions)
        end if
        if (present(guess_rotations)) then
            if (.not. fits('guess_rotations', shape(guess_rotations), [9, &
                int(merge(2*chosen%harmonics + 1, chosen%grid_points, chosen%harmonics > 0)), &
                nodes_of(self)], stat, errmsg)) return
            chosen%guess_rotations = c_loc(guess_rotations)
        end if
        if (present(event_times)) then
            chosen%event_count = size(event_times, kind=c_size_t)
            chosen%event_times = c_loc(event_times)
        end if
        if (present(event_widths)) then
            if (.not. fits('event_widths', shape(event_widths), [int(chosen%event_count)], stat, &
                errmsg)) return
            chosen%event_widths = c_loc(event_widths)
        end if
        if (present(event_shares)) then
            if (.not. fits('event_shares', shape(event_shares), [int(chosen%event_count)], stat, &
                errmsg)) return
            chosen%event_shares = c_loc(event_shares)
        end if
        status = pdn_solve_conditioned(self%c, period, conditions%c, chosen, made)
        if (status == PDN_OK) call solution%adopt(made, pdn_solution_free)
        call report(status, stat, errmsg)
    end subroutine model_solve_conditioned

    ! Follows periodic motions along a parameter, through folds, from the response at its value in
    ! the model.
    subroutine model_follow_branch(self, period, parameter, branch, options, periodic, &
        conditions, stat, errmsg)
        class(pdn_model), intent(in) :: self
        real(c_double), intent(in) :: period
        integer(c_int32_t), intent(in) :: parameter
        type(pdn_branch), intent(inout) :: branch
        type(pdn_branch_options), intent(in) :: options
        type(pdn_periodic_options), intent(in), target, optional :: periodic
        type(pdn_conditions), intent(in), optional :: conditions
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(pdn_branch_options) :: chosen
        type(c_ptr) :: made
        integer(c_int32_t) :: status

        chosen = options
        if (present(periodic)) chosen%periodic = c_loc(periodic)
        if (present(conditions)) chosen%conditions = conditions%c
        status = pdn_follow_branch(self%c, period, parameter, chosen, made)
        if (status == PDN_OK) call branch%adopt(made, pdn_branch_free)
        call report(status, stat, errmsg)
    end subroutine model_follow_branch

    ! Finds the response over a range of frequencies, through folds: follow_branch along
    ! PDN_FREQUENCY.
    subroutine model_solve_frequency_response(self, first, last, branch, options, periodic, &
        conditions, stat, errmsg)
        class(pdn_model), intent(in) :: self
        real(c_double), intent(in) :: first, last
        type(pdn_branch), intent(inout) :: branch
        type(pdn_branch_options), intent(in), optional :: options
        type(pdn_periodic_options), intent(in), target, optional :: periodic
        type(pdn_conditions), intent(in), optional :: conditions
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(pdn_branch_options) :: chosen
        type(c_ptr) :: made
        integer(c_int32_t) :: status

        call pdn_init(chosen)
        if (present(options)) chosen = options
        if (present(periodic)) chosen%periodic = c_loc(periodic)
        if (present(conditions)) chosen%conditions = conditions%c
        status = pdn_solve_frequency_response(self%c, first, last, chosen, made)
        if (status == PDN_OK) call branch%adopt(made, pdn_branch_free)
        call report(status, stat, errmsg)
    end subroutine model_solve_frequency_response

    ! Finds an equilibrium at one time: of forces at rest, or in steady rotation.
    subroutine model_solve_static(self, solution, options, initial, stat, errmsg)
        class(pdn_model), intent(in) :: self
        type(pdn_solution), intent(inout) :: solution
        type(pdn_static_options), intent(in), optional :: options
        type(pdn_solution), intent(in), optional :: initial
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(pdn_static_options) :: chosen
        type(c_ptr) :: made
        integer(c_int32_t) :: status

        call pdn_init(chosen)
        if (present(options)) chosen = options
        if (present(initial)) chosen%initial = initial%c
        status = pdn_solve_static(self%c, chosen, made)
        if (status == PDN_OK) call solution%adopt(made, pdn_solution_free)
        call report(status, stat, errmsg)
    end subroutine model_solve_static

    ! Finds an equilibrium and the modes of small motions Re(x exp(s t)) about it.
    subroutine model_solve_modes(self, modes, options, equilibrium, stat, errmsg)
        class(pdn_model), intent(in) :: self
        type(pdn_modes), intent(inout) :: modes
        type(pdn_modes_options), intent(in), optional :: options
        type(pdn_static_options), intent(in), target, optional :: equilibrium
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(pdn_modes_options) :: chosen
        type(c_ptr) :: made
        integer(c_int32_t) :: status

        call pdn_init(chosen)
        if (present(options)) chosen = options
        if (present(equilibrium)) chosen%equilibrium = c_loc(equilibrium)
        status = pdn_solve_modes(self%c, chosen, made)
        if (status == PDN_OK) call modes%adopt(made, pdn_modes_free)
        call report(status, stat, errmsg)
    end subroutine model_solve_modes

    ! Marches a model in time, for a given duration or until its motion repeats itself.
    subroutine model_solve_march(self, solution, options, initial, positions, rotations, &
        velocities, stat, errmsg)
        class(pdn_model), intent(in) :: self
        type(pdn_solution), intent(inout) :: solution
        type(pdn_march_options), intent(in) :: options
        type(pdn_solution), intent(in), optional :: initial
        real(c_double), intent(in), target, contiguous, optional :: positions(:, :), &
            rotations(:, :), velocities(:, :)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(pdn_march_options) :: chosen
        type(c_ptr) :: made
        integer(c_int32_t) :: status

        chosen = options
        if (present(initial)) chosen%initial = initial%c
        if (present(positions)) then
            if (.not. fits('positions', shape(positions), [3, nodes_of(self)], stat, &
                errmsg)) return
            chosen%positions = c_loc(positions)
        end if
        if (present(rotations)) then
            if (.not. fits('rotations', shape(rotations), [9, nodes_of(self)], stat, &
                errmsg)) return
            chosen%rotations = c_loc(rotations)
        end if
        if (present(velocities)) then
            if (.not. fits('velocities', shape(velocities), [6, nodes_of(self)], stat, &
                errmsg)) return
            chosen%velocities = c_loc(velocities)
        end if
        status = pdn_solve_march(self%c, chosen, made)
        if (status == PDN_OK) call solution%adopt(made, pdn_solution_free)
        call report(status, stat, errmsg)
    end subroutine model_solve_march

    ! Finds the periodic response of a model by shooting: Newton's method on the period map of
    ! solve_march.
    subroutine model_solve_shooting(self, period, solution, options, initial, stat, errmsg)
        class(pdn_model), intent(in) :: self
        real(c_double), intent(in) :: period
        type(pdn_solution), intent(inout) :: solution
        type(pdn_shooting_options), intent(in), optional :: options
        type(pdn_solution), intent(in), optional :: initial
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(pdn_shooting_options) :: chosen
        type(c_ptr) :: made
        integer(c_int32_t) :: status

        call pdn_init(chosen)
        if (present(options)) chosen = options
        if (present(initial)) chosen%initial = initial%c
        status = pdn_solve_shooting(self%c, period, chosen, made)
        if (status == PDN_OK) call solution%adopt(made, pdn_solution_free)
        call report(status, stat, errmsg)
    end subroutine model_solve_shooting

    ! Counts, mass, degrees of freedom and mobility of a model in its reference configuration.
    subroutine model_summary(self, out, stat, errmsg)
        class(pdn_model), intent(in) :: self
        type(pdn_summary), intent(inout) :: out
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(pdn_summary) :: found_out
        integer(c_int32_t) :: status

        call pdn_init(found_out)
        status = pdn_model_summary(self%c, found_out)
        if (status == PDN_OK) out = found_out
        call report(status, stat, errmsg)
    end subroutine model_summary

    ! The same in readable lines, with warnings: parts that nothing connects or holds, ends of
    ! beams without a joint, nodes without inertia, joints open in the reference configuration or
    ! far from all else, impossible moments of inertia, sizes, masses and stiffnesses that do not
    ! fit each other.
    function model_describe(self) result(text)
        class(pdn_model), intent(in) :: self
        character(:), allocatable :: text
        integer(c_size_t) :: length

        allocate (character(pdn_model_describe(self%c, capacity=0_c_size_t) + 1) :: text)
        length = pdn_model_describe(self%c, text, len(text, c_size_t))
        text = text(:length)
    end function model_describe

    ! A copy of a model, which may be changed and solved apart from it.
    subroutine model_copy(self, model, stat, errmsg)
        class(pdn_model), intent(in) :: self
        type(pdn_model), intent(inout) :: model
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(c_ptr) :: made
        integer(c_int32_t) :: status

        status = pdn_model_copy(self%c, made)
        if (status == PDN_OK) call model%adopt(made, pdn_model_free)
        call report(status, stat, errmsg)
    end subroutine model_copy

    ! Saves a model.
    subroutine model_save(self, path, stat, errmsg)
        class(pdn_model), intent(in) :: self
        character(*), intent(in) :: path
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: status

        status = pdn_model_save(self%c, trim(path)//c_null_char)
        call report(status, stat, errmsg)
    end subroutine model_save

    ! Loads a model that save saved; its ids are what they were.
    subroutine model_load(self, path, stat, errmsg)
        class(pdn_model), intent(inout) :: self
        character(*), intent(in) :: path
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(c_ptr) :: made
        integer(c_int32_t) :: status

        status = pdn_model_load(trim(path)//c_null_char, made)
        if (status == PDN_OK) call self%adopt(made, pdn_model_free)
        call report(status, stat, errmsg)
    end subroutine model_load

    ! How the search for the equilibrium ended.
    subroutine modes_outcome(self, outcome, stat, errmsg)
        class(pdn_modes), intent(in) :: self
        integer(c_int32_t), intent(inout) :: outcome
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: status

        status = pdn_modes_outcome(self%c)
        if (status >= 0) outcome = status
        call report(min(status, PDN_OK), stat, errmsg)
    end subroutine modes_outcome

    ! Whether it is there, and has converged.
    function modes_converged(self) result(converged)
        class(pdn_modes), intent(in) :: self
        logical :: converged

        converged = pdn_modes_outcome(self%c) == PDN_CONVERGED
    end function modes_converged

    ! A readable report: outcome of the equilibrium and why, and a table of the modes.
    function modes_report(self) result(text)
        class(pdn_modes), intent(in) :: self
        character(:), allocatable :: text
        integer(c_size_t) :: length

        allocate (character(pdn_modes_report(self%c, capacity=0_c_size_t) + 1) :: text)
        length = pdn_modes_report(self%c, text, len(text, c_size_t))
        text = text(:length)
    end function modes_report

    ! Number of modes: as many as were wanted, if there are and they were found.
    subroutine modes_count(self, out, complete, stat, errmsg)
        class(pdn_modes), intent(in) :: self
        integer(c_int32_t), intent(inout) :: out
        logical, intent(inout), optional :: complete
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: found_out, found_complete, status

        status = pdn_modes_count(self%c, found_out, found_complete)
        if (status == PDN_OK) then
            out = found_out
            if (present(complete)) complete = found_complete /= 0
        end if
        call report(status, stat, errmsg)
    end subroutine modes_count

    ! Eigenvalue, frequency and damping of a mode.
    subroutine modes_get(self, mode, out, stat, errmsg)
        class(pdn_modes), intent(in) :: self
        integer(c_int32_t), intent(in) :: mode
        type(pdn_mode), intent(inout) :: out
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(pdn_mode) :: found_out
        integer(c_int32_t) :: status

        call pdn_init(found_out)
        status = pdn_modes_get(self%c, mode, found_out)
        if (status == PDN_OK) out = found_out
        call report(status, stat, errmsg)
    end subroutine modes_get

    ! Shape x of a mode at some nodes.
    subroutine modes_shape(self, mode, nodes, real, imaginary, stat, errmsg)
        class(pdn_modes), intent(in) :: self
        integer(c_int32_t), intent(in) :: mode
        integer(c_int32_t), intent(in), contiguous :: nodes(:)
        real(c_double), intent(inout), contiguous :: real(:, :)
        real(c_double), intent(inout), contiguous, optional :: imaginary(:, :)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_size_t) :: count
        integer(c_int32_t) :: status

        count = size(nodes, 1, c_size_t)
        if (.not. fits('real', shape(real), [6, int(count)], stat, errmsg)) return
        if (present(imaginary)) then
            if (.not. fits('imaginary', shape(imaginary), [6, int(count)], stat, errmsg)) return
        end if
        status = pdn_modes_shape(self%c, mode, nodes, count, real, imaginary)
        call report(status, stat, errmsg)
    end subroutine modes_shape

    ! The motion in a mode, to be looked at as any other solution.
    subroutine modes_motion(self, mode, amplitude, solution, stat, errmsg)
        class(pdn_modes), intent(in) :: self
        integer(c_int32_t), intent(in) :: mode
        real(c_double), intent(in) :: amplitude
        type(pdn_solution), intent(inout) :: solution
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(c_ptr) :: made
        integer(c_int32_t) :: status

        status = pdn_modes_motion(self%c, mode, amplitude, made)
        if (status == PDN_OK) call solution%adopt(made, pdn_solution_free)
        call report(status, stat, errmsg)
    end subroutine modes_motion

    ! The equilibrium, as solve_static gives it, converged or not.
    subroutine modes_equilibrium(self, solution, stat, errmsg)
        class(pdn_modes), intent(in) :: self
        type(pdn_solution), intent(inout) :: solution
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(c_ptr) :: made
        integer(c_int32_t) :: status

        status = pdn_modes_equilibrium(self%c, made)
        if (status == PDN_OK) call solution%adopt(made, pdn_solution_free)
        call report(status, stat, errmsg)
    end subroutine modes_equilibrium

    ! Makes an empty list: nothing is differentiated.
    subroutine sensitivities_new(self, stat, errmsg)
        class(pdn_sensitivities), intent(inout) :: self
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(c_ptr) :: made
        integer(c_int32_t) :: status

        status = c_version_check(PDN_VERSION_MAJOR, PDN_VERSION_MINOR)
        if (status == PDN_OK) status = pdn_sensitivities_new(made)
        if (status == PDN_OK) call self%adopt(made, pdn_sensitivities_free)
        call report(status, stat, errmsg)
    end subroutine sensitivities_new

    ! Adds a dependent: the mean, a harmonic, the value at a time, or a peak of a quantity.
    subroutine sensitivities_add_quantity(self, quantity, feature, at, stat, errmsg)
        class(pdn_sensitivities), intent(inout) :: self
        type(pdn_quantity), intent(in) :: quantity
        integer(c_int32_t), intent(in) :: feature
        real(c_double), intent(in), optional :: at
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        real(c_double) :: raw_at
        integer(c_int32_t) :: status

        raw_at = 0.0_c_double
        if (present(at)) raw_at = at
        status = pdn_sensitivities_add_quantity(self%c, quantity, feature, raw_at)
        call report(status, stat, errmsg)
    end subroutine sensitivities_add_quantity

    ! Adds a dependent: the value of a free parameter, which conditions determine.
    subroutine sensitivities_add_found(self, parameter, stat, errmsg)
        class(pdn_sensitivities), intent(inout) :: self
        integer(c_int32_t), intent(in) :: parameter
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: status

        status = pdn_sensitivities_add_found(self%c, parameter)
        call report(status, stat, errmsg)
    end subroutine sensitivities_add_found

    ! Adds a parameter that all is differentiated by.
    subroutine sensitivities_add_parameter(self, parameter, stat, errmsg)
        class(pdn_sensitivities), intent(inout) :: self
        integer(c_int32_t), intent(in) :: parameter
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: status

        status = pdn_sensitivities_add_parameter(self%c, parameter)
        call report(status, stat, errmsg)
    end subroutine sensitivities_add_parameter

    ! How the solve ended.
    subroutine solution_outcome(self, outcome, stat, errmsg)
        class(pdn_solution), intent(in) :: self
        integer(c_int32_t), intent(inout) :: outcome
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: status

        status = pdn_solution_outcome(self%c)
        if (status >= 0) outcome = status
        call report(min(status, PDN_OK), stat, errmsg)
    end subroutine solution_outcome

    ! Whether it is there, and has converged.
    function solution_converged(self) result(converged)
        class(pdn_solution), intent(in) :: self
        logical :: converged

        converged = pdn_solution_outcome(self%c) == PDN_CONVERGED
    end function solution_converged

    ! A readable report: outcome and why, iterations, error estimates, time spent.
    function solution_report(self) result(text)
        class(pdn_solution), intent(in) :: self
        character(:), allocatable :: text
        integer(c_size_t) :: length

        allocate (character(pdn_solution_report(self%c, capacity=0_c_size_t) + 1) :: text)
        length = pdn_solution_report(self%c, text, len(text, c_size_t))
        text = text(:length)
    end function solution_report

    ! The report as JSON, for programs: an object with the texts kind, outcome, explanation and
    ! report; sizes; grids and attempts; the Newton iterations; estimates, named as in
    ! pdn_diagnostics; what iteration of linear equations took; and seconds.
    function solution_report_json(self) result(text)
        class(pdn_solution), intent(in) :: self
        character(:), allocatable :: text
        integer(c_size_t) :: length

        allocate (character(pdn_solution_report_json(self%c, capacity=0_c_size_t) + 1) :: text)
        length = pdn_solution_report_json(self%c, text, len(text, c_size_t))
        text = text(:length)
    end function solution_report_json

    ! Figures of a solve: iterations, error estimates, residuals between grid points, time spent.
    subroutine solution_diagnostics(self, out, stat, errmsg)
        class(pdn_solution), intent(in) :: self
        type(pdn_diagnostics), intent(inout) :: out
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(pdn_diagnostics) :: found_out
        integer(c_int32_t) :: status

        call pdn_init(found_out)
        status = pdn_solution_diagnostics(self%c, found_out)
        if (status == PDN_OK) out = found_out
        call report(status, stat, errmsg)
    end subroutine solution_diagnostics

    ! History of the Newton iterations of the periodic problem.
    subroutine solution_history(self, residuals, increments, steps, stat, errmsg)
        class(pdn_solution), intent(in) :: self
        real(c_double), allocatable, intent(inout), optional :: residuals(:), increments(:), &
            steps(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_size_t) :: count
        type(pdn_diagnostics) :: asked
        real(c_double), allocatable :: found_residuals(:), found_increments(:), found_steps(:)
        integer(c_int32_t) :: status

        count = 0
        call pdn_init(asked)
        status = pdn_solution_diagnostics(self%c, asked)
        count = asked%iterations
        allocate (found_residuals(count))
        allocate (found_increments(count))
        allocate (found_steps(count))
        if (status == PDN_OK) status = pdn_solution_history(self%c, found_residuals, &
            found_increments, found_steps, count)
        if (status == PDN_OK) then
            if (present(residuals)) call move_alloc(found_residuals, residuals)
            if (present(increments)) call move_alloc(found_increments, increments)
            if (present(steps)) call move_alloc(found_steps, steps)
        end if
        call report(status, stat, errmsg)
    end subroutine solution_history

    ! Decay of the harmonics: largest amplitude of each over all nodes, of positions relative to
    ! the size of the mechanism and of entries of rotation matrices.
    subroutine solution_decay(self, amplitudes, stat, errmsg)
        class(pdn_solution), intent(in) :: self
        real(c_double), allocatable, intent(inout) :: amplitudes(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_size_t) :: count
        type(pdn_diagnostics) :: asked
        real(c_double), allocatable :: found_amplitudes(:)
        integer(c_int32_t) :: status

        count = 0
        call pdn_init(asked)
        status = pdn_solution_diagnostics(self%c, asked)
        count = (asked%grid_points + 1) / 2
        allocate (found_amplitudes(count))
        if (status == PDN_OK) status = pdn_solution_decay(self%c, found_amplitudes, count)
        if (status == PDN_OK) call move_alloc(found_amplitudes, amplitudes)
        call report(status, stat, errmsg)
    end subroutine solution_decay

    ! Number of events that the grid points of a solution are closer together about: 0 if they are
    ! equispaced.
    subroutine solution_sharp_event_count(self, out, stat, errmsg)
        class(pdn_solution), intent(in) :: self
        integer(c_int32_t), intent(inout) :: out
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_size_t) :: found_out
        integer(c_int32_t) :: status

        status = pdn_solution_sharp_event_count(self%c, found_out)
        if (status == PDN_OK) out = int(found_out, c_int32_t)
        call report(status, stat, errmsg)
    end subroutine solution_sharp_event_count

    ! Events that the grid points of a solution are closer together about, those of
    ! pdn_periodic_options or such as a solve to a tolerance has found.
    subroutine solution_sharp_events(self, times, widths, shares, stat, errmsg)
        class(pdn_solution), intent(in) :: self
        real(c_double), allocatable, intent(inout) :: times(:), widths(:), shares(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_size_t) :: count
        real(c_double), allocatable :: found_times(:), found_widths(:), found_shares(:)
        integer(c_int32_t) :: status

        count = 0
        status = pdn_solution_sharp_event_count(self%c, count)
        allocate (found_times(count))
        allocate (found_widths(count))
        allocate (found_shares(count))
        if (status == PDN_OK) status = pdn_solution_sharp_events(self%c, found_times, &
            found_widths, found_shares, count)
        if (status == PDN_OK) then
            call move_alloc(found_times, times)
            call move_alloc(found_widths, widths)
            call move_alloc(found_shares, shares)
        end if
        call report(status, stat, errmsg)
    end subroutine solution_sharp_events

    ! Grid times t_k = k T / N, unless grid points are closer together about events; of a march
    ! the times of its steps, from the start.
    subroutine solution_grid_times(self, times, stat, errmsg)
        class(pdn_solution), intent(in) :: self
        real(c_double), allocatable, intent(inout) :: times(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_size_t) :: count
        type(pdn_diagnostics) :: asked
        real(c_double), allocatable :: found_times(:)
        integer(c_int32_t) :: status

        count = 0
        call pdn_init(asked)
        status = pdn_solution_diagnostics(self%c, asked)
        count = asked%grid_points
        allocate (found_times(count))
        if (status == PDN_OK) status = pdn_solution_grid_times(self%c, found_times, count)
        if (status == PDN_OK) call move_alloc(found_times, times)
        call report(status, stat, errmsg)
    end subroutine solution_grid_times

    ! A quantity of a solution at any times.
    subroutine solution_sample(self, quantity, times, out, stat, errmsg)
        class(pdn_solution), intent(in) :: self
        type(pdn_quantity), intent(in) :: quantity
        real(c_double), intent(in), contiguous :: times(:)
        real(c_double), intent(inout), contiguous :: out(:, :)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_size_t) :: count
        integer :: components
        integer(c_int32_t) :: status

        count = size(times, 1, c_size_t)
        components = pdn_quantity_components(quantity)
        if (.not. fits('out', shape(out), [components, int(count)], stat, errmsg)) return
        status = pdn_solution_sample(self%c, quantity, times, count, out)
        call report(status, stat, errmsg)
    end subroutine solution_sample

    ! A quantity of a solution at any times.
    subroutine solution_sample_flat(self, quantity, times, out, stat, errmsg)
        class(pdn_solution), intent(in) :: self
        type(pdn_quantity), intent(in) :: quantity
        real(c_double), intent(in), contiguous :: times(:)
        real(c_double), intent(inout), contiguous :: out(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_size_t) :: count
        integer :: components
        integer(c_int32_t) :: status

        count = size(times, 1, c_size_t)
        components = pdn_quantity_components(quantity)
        if (.not. fits('out', shape(out), [components*int(count)], stat, errmsg)) return
        status = pdn_solution_sample(self%c, quantity, times, count, out)
        call report(status, stat, errmsg)
    end subroutine solution_sample_flat

    ! Fourier coefficients of a quantity: mean + rate t + sum of cosines[j] cos jwt + sines[j] sin
    ! jwt.
    subroutine solution_harmonics(self, quantity, mean, rate, cosines, sines, stat, errmsg)
        class(pdn_solution), intent(in) :: self
        type(pdn_quantity), intent(in) :: quantity
        real(c_double), intent(inout), contiguous, optional :: mean(:), rate(:), cosines(:, :), &
            sines(:, :)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_size_t) :: harmonics
        integer :: components
        integer(c_int32_t) :: status

        harmonics = 0
        if (present(sines)) harmonics = size(sines, 2, c_size_t)
        if (present(cosines)) harmonics = size(cosines, 2, c_size_t)
        components = pdn_quantity_components(quantity)
        if (present(mean)) then
            if (.not. fits('mean', shape(mean), [components], stat, errmsg)) return
        end if
        if (present(rate)) then
            if (.not. fits('rate', shape(rate), [components], stat, errmsg)) return
        end if
        if (present(cosines)) then
            if (.not. fits('cosines', shape(cosines), [components, int(harmonics)], stat, &
                errmsg)) return
        end if
        if (present(sines)) then
            if (.not. fits('sines', shape(sines), [components, int(harmonics)], stat, &
                errmsg)) return
        end if
        status = pdn_solution_harmonics(self%c, quantity, harmonics, mean, rate, cosines, sines)
        call report(status, stat, errmsg)
    end subroutine solution_harmonics

    ! Smallest and largest values of a quantity, and their times.
    subroutine solution_extremes(self, quantity, smallest, time_of_smallest, largest, &
        time_of_largest, stat, errmsg)
        class(pdn_solution), intent(in) :: self
        type(pdn_quantity), intent(in) :: quantity
        real(c_double), intent(inout), contiguous, optional :: smallest(:), time_of_smallest(:), &
            largest(:), time_of_largest(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer :: components
        integer(c_int32_t) :: status

        components = pdn_quantity_components(quantity)
        if (present(smallest)) then
            if (.not. fits('smallest', shape(smallest), [components], stat, errmsg)) return
        end if
        if (present(time_of_smallest)) then
            if (.not. fits('time_of_smallest', shape(time_of_smallest), [components], stat, &
                errmsg)) return
        end if
        if (present(largest)) then
            if (.not. fits('largest', shape(largest), [components], stat, errmsg)) return
        end if
        if (present(time_of_largest)) then
            if (.not. fits('time_of_largest', shape(time_of_largest), [components], stat, &
                errmsg)) return
        end if
        status = pdn_solution_extremes(self%c, quantity, smallest, time_of_smallest, largest, &
            time_of_largest)
        call report(status, stat, errmsg)
    end subroutine solution_extremes

    ! A copy of a solution whose quantities are seen through a spectral filter.
    subroutine solution_filtered(self, filter, order, solution, stat, errmsg)
        class(pdn_solution), intent(in) :: self
        integer(c_int32_t), intent(in) :: filter, order
        type(pdn_solution), intent(inout) :: solution
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(c_ptr) :: made
        integer(c_int32_t) :: status

        status = pdn_solution_filtered(self%c, filter, order, made)
        if (status == PDN_OK) call solution%adopt(made, pdn_solution_free)
        call report(status, stat, errmsg)
    end subroutine solution_filtered

    ! Value of a parameter in a solution: given, or found.
    subroutine solution_parameter(self, parameter, out, stat, errmsg)
        class(pdn_solution), intent(in) :: self
        integer(c_int32_t), intent(in) :: parameter
        real(c_double), intent(inout) :: out
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        real(c_double) :: found_out
        integer(c_int32_t) :: status

        status = pdn_solution_parameter(self%c, parameter, found_out)
        if (status == PDN_OK) out = found_out
        call report(status, stat, errmsg)
    end subroutine solution_parameter

    ! Derivatives of what comes out of a periodic solution by parameters of its model.
    subroutine solution_sensitivities(self, sensitivities, derivatives, conditions, options, &
        stat, errmsg)
        class(pdn_solution), intent(in) :: self
        type(pdn_sensitivities), intent(in) :: sensitivities
        real(c_double), intent(inout), contiguous :: derivatives(:, :)
        type(pdn_conditions), intent(in), optional :: conditions
        type(pdn_sensitivity_options), intent(in), optional :: options
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_size_t) :: dependents, parameters
        type(c_ptr) :: raw_conditions
        integer(c_int32_t) :: status

        dependents = size(derivatives, 1, c_size_t)
        parameters = size(derivatives, 2, c_size_t)
        raw_conditions = c_null_ptr
        if (present(conditions)) raw_conditions = conditions%c
        status = pdn_solution_sensitivities(self%c, sensitivities%c, raw_conditions, options, &
            derivatives, dependents, parameters)
        call report(status, stat, errmsg)
    end subroutine solution_sensitivities

    ! Derivatives of a Floquet multiplier of a periodic solution by parameters of its model.
    subroutine solution_multiplier_sensitivities(self, sensitivities, stability, number, re, im, &
        conditions, options, stat, errmsg)
        class(pdn_solution), intent(in) :: self
        type(pdn_sensitivities), intent(in) :: sensitivities
        type(pdn_stability), intent(in) :: stability
        integer(c_int32_t), intent(in) :: number
        real(c_double), intent(inout), contiguous :: re(:), im(:)
        type(pdn_conditions), intent(in), optional :: conditions
        type(pdn_sensitivity_options), intent(in), optional :: options
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_size_t) :: parameters
        type(c_ptr) :: raw_conditions
        integer(c_int32_t) :: status

        parameters = size(re, 1, c_size_t)
        raw_conditions = c_null_ptr
        if (present(conditions)) raw_conditions = conditions%c
        if (.not. fits('im', shape(im), [int(parameters)], stat, errmsg)) return
        status = pdn_solution_multiplier_sensitivities(self%c, sensitivities%c, stability%c, &
            number, raw_conditions, options, re, im, parameters)
        call report(status, stat, errmsg)
    end subroutine solution_multiplier_sensitivities

    ! Figures of a march: steps, periods, how much the last of them differ, how much the start was
    ! changed.
    subroutine solution_march(self, out, stat, errmsg)
        class(pdn_solution), intent(in) :: self
        type(pdn_march_diagnostics), intent(inout) :: out
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(pdn_march_diagnostics) :: found_out
        integer(c_int32_t) :: status

        call pdn_init(found_out)
        status = pdn_solution_march(self%c, found_out)
        if (status == PDN_OK) out = found_out
        call report(status, stat, errmsg)
    end subroutine solution_march

    ! Number of Floquet multipliers of a solution: as many as the system has states, if
    ! solve_shooting found them; of a periodic solution as many as solve_stability finds, which is
    ! called with default options unless it has been before.
    subroutine solution_floquet_count(self, out, stat, errmsg)
        class(pdn_solution), intent(in) :: self
        integer(c_int32_t), intent(inout) :: out
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_size_t) :: found_out
        integer(c_int32_t) :: status

        status = pdn_solution_floquet_count(self%c, found_out)
        if (status == PDN_OK) out = int(found_out, c_int32_t)
        call report(status, stat, errmsg)
    end subroutine solution_floquet_count

    ! Floquet multipliers: what disturbances of the motion are multiplied by in a period, the
    ! largest first.
    subroutine solution_floquet(self, real, imaginary, stat, errmsg)
        class(pdn_solution), intent(in) :: self
        real(c_double), allocatable, intent(inout) :: real(:), imaginary(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_size_t) :: count
        real(c_double), allocatable :: found_real(:), found_imaginary(:)
        integer(c_int32_t) :: status

        count = 0
        status = pdn_solution_floquet_count(self%c, count)
        allocate (found_real(count))
        allocate (found_imaginary(count))
        if (status == PDN_OK) status = pdn_solution_floquet(self%c, found_real, found_imaginary, &
            count)
        if (status == PDN_OK) then
            call move_alloc(found_real, real)
            call move_alloc(found_imaginary, imaginary)
        end if
        call report(status, stat, errmsg)
    end subroutine solution_floquet

    ! Finds the Floquet multipliers of a periodic solution: what small disturbances are multiplied
    ! by in a period.
    subroutine solution_solve_stability(self, stability, options, stat, errmsg)
        class(pdn_solution), intent(in) :: self
        type(pdn_stability), intent(inout) :: stability
        type(pdn_stability_options), intent(in), optional :: options
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(c_ptr) :: made
        integer(c_int32_t) :: status

        status = pdn_solve_stability(self%c, options, made)
        if (status == PDN_OK) call stability%adopt(made, pdn_stability_free)
        call report(status, stat, errmsg)
    end subroutine solution_solve_stability

    ! Writes an animation of a solution that ParaView opens: VTK's XML files, and a list of them.
    subroutine solution_write_vtk(self, times, points_per_element, path, stat, errmsg)
        class(pdn_solution), intent(in) :: self
        real(c_double), intent(in), contiguous :: times(:)
        integer(c_int32_t), intent(in) :: points_per_element
        character(*), intent(in) :: path
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_size_t) :: count
        integer(c_int32_t) :: status

        count = size(times, 1, c_size_t)
        status = pdn_solution_write_vtk(self%c, times, count, int(max(points_per_element, 0), &
            c_size_t), trim(path)//c_null_char)
        call report(status, stat, errmsg)
    end subroutine solution_write_vtk

    ! Saves a solution with its model, whether it has converged or not.
    subroutine solution_save(self, path, stat, errmsg)
        class(pdn_solution), intent(in) :: self
        character(*), intent(in) :: path
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: status

        status = pdn_solution_save(self%c, trim(path)//c_null_char)
        call report(status, stat, errmsg)
    end subroutine solution_save

    ! Loads a solution that save saved: its quantities, diagnostics and report are what they were.
    subroutine solution_load(self, path, stat, errmsg)
        class(pdn_solution), intent(inout) :: self
        character(*), intent(in) :: path
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(c_ptr) :: made
        integer(c_int32_t) :: status

        status = pdn_solution_load(trim(path)//c_null_char, made)
        if (status == PDN_OK) call self%adopt(made, pdn_solution_free)
        call report(status, stat, errmsg)
    end subroutine solution_load

    ! A copy of the model that a solution is of, as it was when it was solved.
    subroutine solution_model(self, model, stat, errmsg)
        class(pdn_solution), intent(in) :: self
        type(pdn_model), intent(inout) :: model
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(c_ptr) :: made
        integer(c_int32_t) :: status

        status = pdn_solution_model(self%c, made)
        if (status == PDN_OK) call model%adopt(made, pdn_model_free)
        call report(status, stat, errmsg)
    end subroutine solution_model

    ! How the analysis ended.
    subroutine stability_outcome(self, outcome, stat, errmsg)
        class(pdn_stability), intent(in) :: self
        integer(c_int32_t), intent(inout) :: outcome
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: status

        status = pdn_stability_outcome(self%c)
        if (status >= 0) outcome = status
        call report(min(status, PDN_OK), stat, errmsg)
    end subroutine stability_outcome

    ! Whether it is there, and has converged.
    function stability_converged(self) result(converged)
        class(pdn_stability), intent(in) :: self
        logical :: converged

        converged = pdn_stability_outcome(self%c) == PDN_CONVERGED
    end function stability_converged

    ! What the multipliers say.
    subroutine stability_verdict(self, verdict, frequency_limit, stat, errmsg)
        class(pdn_stability), intent(in) :: self
        integer(c_int32_t), intent(inout) :: verdict
        real(c_double), intent(inout), optional :: frequency_limit
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: found_verdict
        real(c_double) :: found_frequency_limit
        integer(c_int32_t) :: status

        status = pdn_stability_verdict(self%c, found_verdict, found_frequency_limit)
        if (status == PDN_OK) then
            verdict = found_verdict
            if (present(frequency_limit)) frequency_limit = found_frequency_limit
        end if
        call report(status, stat, errmsg)
    end subroutine stability_verdict

    ! Number of multipliers that are known, and of those that the system has, one for each state.
    subroutine stability_count(self, out, states, stat, errmsg)
        class(pdn_stability), intent(in) :: self
        integer(c_int32_t), intent(inout) :: out
        integer(c_int32_t), intent(inout), optional :: states
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_size_t) :: found_out, found_states
        integer(c_int32_t) :: status

        status = pdn_stability_count(self%c, found_out, found_states)
        if (status == PDN_OK) then
            out = int(found_out, c_int32_t)
            if (present(states)) states = int(found_states, c_int32_t)
        end if
        call report(status, stat, errmsg)
    end subroutine stability_count

    ! A multiplier.
    subroutine stability_get(self, number, out, stat, errmsg)
        class(pdn_stability), intent(in) :: self
        integer(c_int32_t), intent(in) :: number
        type(pdn_multiplier), intent(inout) :: out
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(pdn_multiplier) :: found_out
        integer(c_int32_t) :: status

        call pdn_init(found_out)
        status = pdn_stability_get(self%c, number, found_out)
        if (status == PDN_OK) out = found_out
        call report(status, stat, errmsg)
    end subroutine stability_get

    ! Number of times of the shapes of modes.
    subroutine stability_time_count(self, out, stat, errmsg)
        class(pdn_stability), intent(in) :: self
        integer(c_int32_t), intent(inout) :: out
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_size_t) :: found_out
        integer(c_int32_t) :: status

        status = pdn_stability_time_count(self%c, found_out)
        if (status == PDN_OK) out = int(found_out, c_int32_t)
        call report(status, stat, errmsg)
    end subroutine stability_time_count

    ! Times of the shapes of modes: ends of equal steps over the period, the last is the period.
    subroutine stability_times(self, times, stat, errmsg)
        class(pdn_stability), intent(in) :: self
        real(c_double), allocatable, intent(inout) :: times(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_size_t) :: count
        real(c_double), allocatable :: found_times(:)
        integer(c_int32_t) :: status

        count = 0
        status = pdn_stability_time_count(self%c, count)
        allocate (found_times(count))
        if (status == PDN_OK) status = pdn_stability_times(self%c, found_times, count)
        if (status == PDN_OK) call move_alloc(found_times, times)
        call report(status, stat, errmsg)
    end subroutine stability_times

    ! The mode phi of a multiplier at a node over the period.
    subroutine stability_shape(self, number, node, real, imaginary, stat, errmsg)
        class(pdn_stability), intent(in) :: self
        integer(c_int32_t), intent(in) :: number, node
        real(c_double), allocatable, intent(inout) :: real(:, :)
        real(c_double), allocatable, intent(inout), optional :: imaginary(:, :)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_size_t) :: steps
        real(c_double), allocatable :: found_real(:, :), found_imaginary(:, :)
        integer(c_int32_t) :: status

        steps = 0
        status = pdn_stability_time_count(self%c, steps)
        allocate (found_real(6, steps))
        allocate (found_imaginary(6, steps))
        if (status == PDN_OK) status = pdn_stability_shape(self%c, number, node, steps, &
            found_real, found_imaginary)
        if (status == PDN_OK) then
            call move_alloc(found_real, real)
            if (present(imaginary)) call move_alloc(found_imaginary, imaginary)
        end if
        call report(status, stat, errmsg)
    end subroutine stability_shape

    ! A readable report: the verdict, how far it holds, and a table of the multipliers.
    function stability_report(self) result(text)
        class(pdn_stability), intent(in) :: self
        character(:), allocatable :: text
        integer(c_size_t) :: length

        allocate (character(pdn_stability_report(self%c, capacity=0_c_size_t) + 1) :: text)
        length = pdn_stability_report(self%c, text, len(text, c_size_t))
        text = text(:length)
    end function stability_report

    ! Adds the columns of a quantity of a solution, named by the label and the component; or that
    ! of one component, named by the label alone.
    subroutine table_add_quantity(self, solution, quantity, label, stat, errmsg)
        class(pdn_table), intent(inout) :: self
        type(pdn_solution), intent(in) :: solution
        type(pdn_quantity), intent(in) :: quantity
        character(*), intent(in), optional :: label
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        character(:), allocatable :: raw_label
        integer(c_int32_t) :: status

        if (present(label)) raw_label = trim(label)//c_null_char
        status = pdn_table_add_quantity(self%c, solution%c, quantity, raw_label)
        call report(status, stat, errmsg)
    end subroutine table_add_quantity

    ! A table over these times, to choose columns for and to write as CSV.
    subroutine table_new(self, times, stat, errmsg)
        class(pdn_table), intent(inout) :: self
        real(c_double), intent(in), contiguous :: times(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_size_t) :: count
        type(c_ptr) :: made
        integer(c_int32_t) :: status

        count = size(times, 1, c_size_t)
        status = c_version_check(PDN_VERSION_MAJOR, PDN_VERSION_MINOR)
        if (status == PDN_OK) status = pdn_table_new(times, count, made)
        if (status == PDN_OK) call self%adopt(made, pdn_table_free)
        call report(status, stat, errmsg)
    end subroutine table_new

    ! Adds a column of values of your own, such as one computed from several quantities.
    subroutine table_add_values(self, label, values, stat, errmsg)
        class(pdn_table), intent(inout) :: self
        character(*), intent(in) :: label
        real(c_double), intent(in), contiguous :: values(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_size_t) :: count
        integer(c_int32_t) :: status

        count = size(values, 1, c_size_t)
        status = pdn_table_add_values(self%c, trim(label)//c_null_char, values, count)
        call report(status, stat, errmsg)
    end subroutine table_add_values

    ! Writes a table as a CSV file: a line of names, then a line for each time.
    subroutine table_write_csv(self, path, stat, errmsg)
        class(pdn_table), intent(in) :: self
        character(*), intent(in) :: path
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        integer(c_int32_t) :: status

        status = pdn_table_write_csv(self%c, trim(path)//c_null_char)
        call report(status, stat, errmsg)
    end subroutine table_write_csv
end module periodyn
