/* Every function of solves, solutions and motions refuses what it must: it says which argument was
 * wrong, and writes nothing. */
#include "check.h"
#include <math.h>

static const double PI = 3.14159265358979323846;

enum { POINTS = 3, TIMES = 3, NODES = 2 };

/* Arguments, each of them good. */
static struct {
    const pdn_model *model;
    const pdn_solution *solution;
    pdn_periodic_options options;
    pdn_diagnostics diagnostics;
    double period;
    double times[TIMES];
    size_t count, grid_count, decay_count, iterations, harmonics, points;
    pdn_quantity asked;
    double positions[3 * POINTS * NODES], rotations[9 * POINTS * NODES];
} in;

/* Where results go; filled with a pattern. */
static struct {
    pdn_solution *solution;
    double values[64], rate[8], cosines[64], sines[64];
    double tangent[36 * POINTS * POINTS], other_tangent[36 * POINTS * POINTS];
} out;

static int model_changed(void)
{
    return 0; /* none of these functions can change a model: it is const */
}

#include "refusal.h"

static const double not_positive[] = {0.0, -0.0, -1.0};
static const int32_t bad_ids[] = {-1, NO_IDS};
static const size_t bad_counts[] = {0, 1, 2, 4, 5, (size_t)-1};
static const size_t huge_counts[] = {(size_t)-1, (size_t)-1 / 2, (size_t)-1 / 8};
static const size_t even[] = {0, 2, 30, (size_t)-2};
static const size_t bad_struct_sizes[] = {0, 1, 7, 8, 72, 5000, (size_t)-1};

#define REFUSES_IDS(variable, call, name)                                                          \
    REFUSES_EACH(variable, int32_t, bad_ids, call, PDN_ERR_ID, name ": expected ")
#define REFUSES_ENUMS(variable, call, name)                                                        \
    do {                                                                                           \
        REFUSES_EACH(variable, int32_t, bad_enums, call, PDN_ERR_VALUE, name ": expected PDN_");   \
        REFUSES_OTHER_ROLES(variable, call, name ": expected PDN_");                               \
    } while (0)
#define REFUSES_SIZES(variable, sizes, call, name)                                                 \
    REFUSES_EACH(variable, size_t, sizes, call, PDN_ERR_SIZE, name ": expected ")
#define REFUSES_STRUCT_SIZES(variable, call, name)                                                 \
    REFUSES_EACH(variable.struct_size, size_t, bad_struct_sizes, call, PDN_ERR_STRUCT_SIZE,        \
                 name ": expected struct_size ")

/* The call, with NULL for a pointer variable. */
#define REFUSES_NULL(variable, call, name)                                                         \
    do {                                                                                           \
        variable = NULL;                                                                           \
        REFUSED(call, PDN_ERR_NULL, name ": expected a pointer, got NULL");                        \
    } while (0)

/* Pointer arguments that the calls below use by name, good again at the start of each block. */
#define POINTERS                                                                                   \
    const pdn_solution *solution = in.solution;                                                    \
    const double *times = in.times;                                                                \
    double *values = out.values;

/* --- The model, and its solution --- */

static pdn_model *model;
static pdn_solution *good;

/* Node 0 on a hinge (joint 0) with spring and damper, a driven one (joint 1) that carries a beam.
 */
static void set_up(void)
{
    const double origin[3] = {0, 0, 0}, end[3] = {1, 0, 0}, axis[3] = {0, 0, 1}, up[3] = {0, 1, 0};
    const double inertia[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1}, cosines[1] = {0.3}, sines[1] = {0};
    const double stiffness[6] = {1e5, 1e5, 1e5, 1e3, 1e3, 1e3}, mass[4] = {1, 0.1, 0.1, 0.1};
    int32_t node, joint;
    size_t i;
    pdn_section section;
    pdn_signal signal;
    pdn_beam beam;

    PDN_INIT(pdn_section, &section);
    PDN_INIT(pdn_signal, &signal);
    CHECK_STATUS(pdn_section_set_diagonal(&section, stiffness, mass), PDN_OK);
    CHECK_STATUS(pdn_signal_set_harmonics(&signal, 0, 0, cosines, sines, 1), PDN_OK);
    CHECK_STATUS(pdn_model_new(&model), PDN_OK);
    CHECK_STATUS(pdn_model_add_straight_beam(model, origin, end, up, &section, 1, 1, &beam),
                 PDN_OK);
    CHECK_STATUS(pdn_model_add_revolute(model, PDN_GROUND, NODE(0), origin, axis, &joint), PDN_OK);
    CHECK_STATUS(pdn_model_add_spring_damper(model, JOINT(0), PDN_ROTATION, 10, 1, 0, NULL),
                 PDN_OK);
    CHECK_STATUS(pdn_model_add_load(model, NODE(1), PDN_FRAME_MATERIAL, PDN_FORCE_2, &signal, NULL),
                 PDN_OK);
    CHECK_STATUS(pdn_model_add_rigid_body(model, 1, end, inertia, &node), PDN_OK);
    CHECK_STATUS(pdn_model_add_revolute(model, PDN_GROUND, node, end, axis, &joint), PDN_OK);
    CHECK_STATUS(pdn_model_prescribe(model, joint, PDN_ROTATION, &signal, NULL), PDN_OK);

    memset(&in, 0, sizeof in);
    PDN_INIT(pdn_periodic_options, &in.options);
    PDN_INIT(pdn_diagnostics, &in.diagnostics);
    in.options.grid_points = POINTS;
    in.period = 2.0;
    CHECK_STATUS(pdn_solve_periodic(model, in.period, &in.options, &good), PDN_OK);
    CHECK(pdn_solution_outcome(good) == PDN_CONVERGED);
    CHECK_STATUS(pdn_solution_diagnostics(good, &in.diagnostics), PDN_OK);
    in.model = model;
    in.solution = good;
    in.iterations = (size_t)in.diagnostics.iterations;
    in.count = TIMES;
    in.grid_count = in.points = POINTS;
    in.decay_count = (POINTS + 1) / 2;
    in.harmonics = (POINTS - 1) / 2;
    for (i = 0; i < TIMES; i++)
        in.times[i] = 0.3 * (double)i;
    for (i = 0; i < LENGTH(in.rotations); i += 9)
        in.rotations[i] = in.rotations[i + 4] = in.rotations[i + 8] = 1;
}

/* --- The solve --- */

static pdn_status solve(void)
{
    return pdn_solve_periodic(in.model, in.period, &in.options, &out.solution);
}

static void solves(void)
{
    static const size_t even_grids[] = {2, 30, (size_t)-2}; /* 0 is adaptive */
    static const size_t zero[] = {0}, too_few[] = {0, 1, 2};
    static const size_t too_many[] = {((size_t)1 << 24) + 1, (size_t)-1};
    static const size_t no_oversampling[] = {0, 17, (size_t)-1};
    static const size_t too_many_harmonics[] = {(size_t)1 << 23, (size_t)-1 / 2, (size_t)-1};
    pdn_periodic_options options;

    memset(&options, 0x5a, sizeof options);
    pdn_periodic_options_init(NULL, sizeof options);
    CHECK_MESSAGE("options: expected a pointer, got NULL");
    {
        const size_t sizes[] = {0, 7, 5000};
        size_t k;
        for (k = 0; k < LENGTH(sizes); k++) {
            pdn_periodic_options_init(&options, sizes[k]);
            CHECK_MESSAGE("struct_size: expected between");
            CHECK(options.struct_size == options.grid_points); /* the pattern */
        }
    }

    REFUSED(pdn_solve_periodic(NULL, in.period, &in.options, &out.solution), PDN_ERR_NULL,
            "model: expected a pointer, got NULL");
    REFUSED(pdn_solve_periodic(in.model, in.period, &in.options, NULL), PDN_ERR_NULL,
            "out: expected a pointer, got NULL");
    REFUSED(pdn_solve_periodic(in.model, in.period, NULL, NULL), PDN_ERR_NULL,
            "out: expected a pointer, got NULL");
    REFUSES_NOT_FINITE(in.period, solve(), "period");
    REFUSES_EACH(in.period, double, not_positive, solve(), PDN_ERR_VALUE,
                 "period: expected a positive, finite number");
    REFUSES_STRUCT_SIZES(in.options, solve(), "options");
    REFUSES_SIZES(in.options.grid_points, even_grids, solve(), "options.grid_points");
    REFUSES_SIZES(in.options.grid_points, too_many, solve(), "options.grid_points");
    REFUSES_SIZES(in.options.harmonics, too_many_harmonics, solve(), "options.harmonics");
    REFUSES_NOT_FINITE(in.options.tolerance, solve(), "options.tolerance");
    REFUSES_EACH(in.options.tolerance, double, not_positive, solve(), PDN_ERR_VALUE,
                 "options.tolerance: expected a positive");
    REFUSES_EACH(in.options.iteration_limit, size_t, zero, solve(), PDN_ERR_VALUE,
                 "options.iteration_limit: expected at least 1");

    static const int32_t no_solvers[] = {-1, 6, INT32_MAX}, no_threads[] = {-1, 1025, INT32_MIN};
    REFUSES_EACH(in.options.linear_solver, int32_t, no_solvers, solve(), PDN_ERR_VALUE,
                 "options.linear_solver: expected a constant PDN_LINEAR_");
    REFUSES_EACH(in.options.threads, int32_t, no_threads, solve(), PDN_ERR_VALUE,
                 "options.threads: expected from 0 to 1024");

    in.options.grid_points = 0; /* adapted */
    REFUSES_NOT_FINITE(in.options.error_tolerance, solve(), "options.error_tolerance");
    REFUSES_EACH(in.options.error_tolerance, double, not_positive, solve(), PDN_ERR_VALUE,
                 "options.error_tolerance: expected a positive, finite number");
    REFUSES_EACH(in.options.oversampling, size_t, no_oversampling, solve(), PDN_ERR_VALUE,
                 "options.oversampling: expected a number from 1 to 16");
    REFUSES_SIZES(in.options.largest_grid_points, too_few, solve(), "options.largest_grid_points");
    REFUSES_SIZES(in.options.largest_grid_points, too_many, solve(), "options.largest_grid_points");
    in.options.guess_positions = in.positions;
    in.options.guess_rotations = in.rotations;
    REFUSED(solve(), PDN_ERR_SIZE,
            "options.grid_points: expected the number of points of options.guess_positions, got 0");
    in.options.guess_positions = in.options.guess_rotations = NULL;
    in.options.grid_points = POINTS;

    in.options.guess_positions = in.positions;
    REFUSED(solve(), PDN_ERR_NULL, "options.guess_rotations: expected a pointer, got NULL");
    in.options.guess_positions = NULL;
    in.options.guess_rotations = in.rotations;
    REFUSED(solve(), PDN_ERR_NULL, "options.guess_positions: expected a pointer, got NULL");
    in.options.guess_rotations = NULL;
}

/* A model of two nodes, so that the arrays of the start are long enough. */
static void starts(void)
{
    static const double no_rotation[] = {0.0, -1.0, 1.0001};
    const pdn_model *const saved = in.model;
    const double origin[3] = {0, 0, 0}, eye[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    pdn_model *small = NULL;
    int32_t node, joint, i;
    CHECK_STATUS(pdn_model_new(&small), PDN_OK);
    in.model = small;
    REFUSED(solve(), PDN_ERR_MODEL, "");
    for (i = 0; i < NODES; i++) {
        CHECK_STATUS(pdn_model_add_rigid_body(small, 1, origin, eye, &node), PDN_OK);
        CHECK_STATUS(pdn_model_add_rigid_joint(small, PDN_GROUND, node, origin, &joint), PDN_OK);
    }
    in.options.guess_positions = in.positions;
    in.options.guess_rotations = in.rotations;
    REFUSES_NOT_FINITE_ENTRIES(in.positions, LENGTH(in.positions), solve(),
                               "options.guess_positions");
    REFUSES_NOT_FINITE_ENTRIES(in.rotations, LENGTH(in.rotations), solve(),
                               "options.guess_rotations");
    REFUSES_EACH(in.rotations[0], double, no_rotation, solve(), PDN_ERR_VALUE,
                 "options.guess_rotations: expected rotation matrices");
    REFUSES_EACH(in.rotations[LENGTH(in.rotations) - 1], double, no_rotation, solve(),
                 PDN_ERR_VALUE, "options.guess_rotations: expected rotation matrices");
    in.options.guess_positions = in.options.guess_rotations = NULL;
    in.options.initial = in.solution;
    REFUSED(solve(), PDN_ERR_VALUE,
            "options.initial: expected a solution of a model with the same");
    in.options.initial = NULL;
    in.model = saved;
    pdn_model_free(small);
}

/* A wheel whose motor, or whose load, does as the signal says. */
static pdn_model *wheel(const pdn_signal *motor, const pdn_signal *load, double stiffness)
{
    const double origin[3] = {0, 0, 0}, axis[3] = {0, 0, 1};
    const double inertia[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    pdn_model *made = NULL;
    int32_t node, joint;
    CHECK_STATUS(pdn_model_new(&made), PDN_OK);
    CHECK_STATUS(pdn_model_add_rigid_body(made, 1, origin, inertia, &node), PDN_OK);
    CHECK_STATUS(pdn_model_add_revolute(made, PDN_GROUND, node, origin, axis, &joint), PDN_OK);
    CHECK_STATUS(pdn_model_add_spring_damper(made, joint, PDN_ROTATION, stiffness, 1, 0, NULL),
                 PDN_OK);
    if (motor != NULL)
        CHECK_STATUS(pdn_model_prescribe(made, joint, PDN_ROTATION, motor, NULL), PDN_OK);
    if (load != NULL)
        CHECK_STATUS(pdn_model_add_load(made, node, PDN_FRAME_SPACE, PDN_FORCE_1, load, NULL),
                     PDN_OK);
    return made;
}

static void what_does_not_repeat(void)
{
    const pdn_model *const saved = in.model;
    pdn_signal signal;
    pdn_model *made;
    PDN_INIT(pdn_signal, &signal);

    CHECK_STATUS(pdn_signal_set_harmonics(&signal, 0, PI / in.period, NULL, NULL, 0), PDN_OK);
    in.model = made = wheel(&signal, NULL, 0); /* half a turn */
    REFUSED(solve(), PDN_ERR_NOT_PERIODIC, "prescribed");
    pdn_model_free(made);

    in.model = made = wheel(NULL, &signal, 1);
    REFUSED(solve(), PDN_ERR_NOT_PERIODIC, "load 0 on node 0");
    pdn_model_free(made);

    CHECK_STATUS(pdn_signal_set_harmonics(&signal, 0, 2 * PI / in.period, NULL, NULL, 0), PDN_OK);
    in.model = made = wheel(&signal, NULL, 1); /* a whole turn, against a spring */
    REFUSED(solve(), PDN_ERR_NOT_PERIODIC, "force 0 on joint 0");
    pdn_model_free(made);
    in.model = saved;
}

/* --- The solution as a whole --- */

static void wholes(void)
{
    const size_t limit = sizeof out.values;
    unsigned char pattern[sizeof(pdn_diagnostics)];
    pdn_diagnostics diagnostics;
    size_t k;

    pdn_solution_free(NULL);
    CHECK(pdn_solution_outcome(NULL) == PDN_ERR_NULL);
    CHECK_MESSAGE("solution: expected a pointer, got NULL");
    memset(&out, 0x5a, sizeof out);
    CHECK_STATUS(pdn_set_callback_error(NULL), PDN_ERR_NULL); /* another message */
    CHECK(pdn_solution_report(NULL, (char *)out.values, limit) == 0);
    CHECK_MESSAGE("solution: expected a pointer, got NULL");
    for (k = 0; k < limit; k++)
        CHECK(((unsigned char *)out.values)[k] == 0x5a);
    CHECK(pdn_solution_report(in.solution, NULL, 100) > 100);

    memset(&diagnostics, 0x5a, sizeof diagnostics);
    memset(pattern, 0x5a, sizeof pattern);
    pdn_diagnostics_init(NULL, sizeof diagnostics);
    CHECK_MESSAGE("diagnostics: expected a pointer, got NULL");
    for (k = 0; k < 3; k++) {
        const size_t sizes[] = {0, 7, 5000};
        pdn_diagnostics_init(&diagnostics, sizes[k]);
        CHECK_MESSAGE("struct_size: expected between");
        CHECK(memcmp(&diagnostics, pattern, sizeof pattern) == 0);
    }
    REFUSED(pdn_solution_diagnostics(NULL, &in.diagnostics), PDN_ERR_NULL, "solution: expected");
    REFUSED(pdn_solution_diagnostics(in.solution, NULL), PDN_ERR_NULL, "out: expected a pointer");
    REFUSES_STRUCT_SIZES(in.diagnostics, pdn_solution_diagnostics(in.solution, &in.diagnostics),
                         "out");

    {
        const size_t wrong[] = {0, in.iterations - 1, in.iterations + 1, (size_t)-1};
        REFUSED(pdn_solution_history(NULL, out.values, NULL, NULL, in.iterations), PDN_ERR_NULL,
                "solution: expected a pointer, got NULL");
        REFUSES_SIZES(
            in.iterations, wrong,
            pdn_solution_history(in.solution, out.values, out.cosines, out.sines, in.iterations),
            "count");
        REFUSES_SIZES(in.iterations, wrong,
                      pdn_solution_history(in.solution, NULL, NULL, NULL, in.iterations), "count");
    }
    {
        const size_t wrong[] = {0, 1, 3, (size_t)-1};
        REFUSED(pdn_solution_decay(NULL, out.values, in.decay_count), PDN_ERR_NULL,
                "solution: expected a pointer, got NULL");
        REFUSED(pdn_solution_decay(in.solution, NULL, in.decay_count), PDN_ERR_NULL,
                "amplitudes: expected a pointer, got NULL");
        REFUSES_SIZES(in.decay_count, wrong,
                      pdn_solution_decay(in.solution, out.values, in.decay_count), "count");
    }
    REFUSED(pdn_solution_grid_times(NULL, out.values, in.grid_count), PDN_ERR_NULL,
            "solution: expected a pointer, got NULL");
    REFUSED(pdn_solution_grid_times(in.solution, NULL, in.grid_count), PDN_ERR_NULL,
            "times: expected a pointer, got NULL");
    REFUSES_SIZES(in.grid_count, bad_counts,
                  pdn_solution_grid_times(in.solution, out.values, in.grid_count), "count");
}

/* --- Samples: a call with the arguments in `in`, each of which is spoilt in turn --- */

#define REFUSES_BAD_SAMPLING(call)                                                                 \
    do {                                                                                           \
        {                                                                                          \
            POINTERS                                                                               \
            REFUSES_NULL(solution, call, "solution");                                              \
        }                                                                                          \
        {                                                                                          \
            POINTERS                                                                               \
            REFUSES_NULL(times, call, "times");                                                    \
        }                                                                                          \
        {                                                                                          \
            POINTERS                                                                               \
            REFUSES_NULL(values, call, "out");                                                     \
        }                                                                                          \
        {                                                                                          \
            POINTERS                                                                               \
            REFUSES_SIZES(in.count, huge_counts, call, "times");                                   \
            REFUSES_NOT_FINITE_ENTRIES(in.times, TIMES, call, "times");                            \
            CHECK_STATUS(call, PDN_OK); /* all is good again */                                    \
        }                                                                                          \
    } while (0)

static pdn_quantity asked_of(int32_t kind, int32_t object)
{
    return pdn_quantity_of(kind, object, PDN_ALL_COMPONENTS);
}

#define SAMPLE pdn_solution_sample(solution, &in.asked, times, in.count, values)

static void samples_of_nodes(void)
{
    int32_t kind;
    for (kind = PDN_NODE_POSITION; kind <= PDN_NODE_ACCELERATION; kind++) {
        POINTERS
        in.asked = asked_of(kind, NODE(0));
        REFUSES_BAD_SAMPLING(SAMPLE);
        REFUSES_OBJECTS(in.asked.object, SAMPLE, "node", "object");
        REFUSES_EACH(in.asked.kind, int32_t, bad_enums, SAMPLE, PDN_ERR_VALUE,
                     "quantity.kind: expected PDN_");
        if (kind >= PDN_NODE_VELOCITY)
            REFUSES_ENUMS(in.asked.frame, SAMPLE, "quantity.frame");
        REFUSED(pdn_solution_sample(solution, NULL, times, in.count, values), PDN_ERR_NULL,
                "quantity: expected a pointer, got NULL");
    }
}

static const int32_t lacking[] = {PDN_ROTATION_2, PDN_ROTATION_3};

static void samples_of_joints(void)
{
    int32_t kind;
    POINTERS
    for (kind = PDN_JOINT_COORDINATE; kind <= PDN_JOINT_DRIVING_EFFORT; kind++) {
        in.asked = pdn_quantity_of(kind, JOINT(1), PDN_ROTATION);
        REFUSES_BAD_SAMPLING(SAMPLE);
        REFUSES_OBJECTS(in.asked.object, SAMPLE, "joint", "object");
        REFUSES_ENUMS(in.asked.component, SAMPLE, "quantity.component");
        REFUSES_EACH(in.asked.component, int32_t, lacking, SAMPLE, PDN_ERR_NOT_AVAILABLE,
                     "coordinate: expected one of a revolute joint");
        in.asked.object = JOINT(0);
        if (kind == PDN_JOINT_DRIVING_EFFORT)
            REFUSED(SAMPLE, PDN_ERR_NOT_AVAILABLE, "");
    }
    in.asked = asked_of(PDN_JOINT_REACTION, JOINT(0));
    REFUSES_BAD_SAMPLING(SAMPLE);
    REFUSES_OBJECTS(in.asked.object, SAMPLE, "joint", "object");
    REFUSES_ENUMS(in.asked.frame, SAMPLE, "quantity.frame");
}

static const double outside[] = {-1.0000001, 1.0000001, 1e300};

static void samples_of_beams(void)
{
    int32_t kind;
    POINTERS
    for (kind = PDN_BEAM_STRAIN; kind <= PDN_BEAM_FORCE_JUMP; kind++) {
        in.asked = asked_of(kind, BEAM_ELEMENT(0));
        REFUSES_BAD_SAMPLING(SAMPLE);
        REFUSES_OBJECTS(in.asked.object, SAMPLE, "element", "object");
        REFUSES_NOT_FINITE(in.asked.station, SAMPLE, "station");
        REFUSES_EACH(in.asked.station, double, outside, SAMPLE, PDN_ERR_VALUE,
                     "station: expected ");
    }
}

/* --- Harmonics --- */

static const size_t too_many_harmonics[] = {((size_t)1 << 20) + 1, (size_t)-1 / 2, (size_t)-1};

#define SERIES(solution)                                                                           \
    pdn_solution_harmonics(solution, &in.asked, in.harmonics, out.values, out.rate, out.cosines,   \
                           out.sines)
#define REFUSES_BAD_SERIES(own)                                                                    \
    do {                                                                                           \
        REFUSED(SERIES(NULL), PDN_ERR_NULL, "solution: expected a pointer, got NULL");             \
        REFUSES_OBJECTS(in.asked.object, SERIES(in.solution), own, "object");                      \
        REFUSES_EACH(in.asked.kind, int32_t, bad_enums, SERIES(in.solution), PDN_ERR_VALUE,        \
                     "quantity.kind: expected PDN_");                                              \
        REFUSES_SIZES(in.harmonics, too_many_harmonics, SERIES(in.solution), "harmonics");         \
        CHECK_STATUS(SERIES(in.solution), PDN_OK);                                                 \
    } while (0)

static void harmonics(void)
{
    int32_t kind;
    REFUSED(pdn_solution_harmonics(in.solution, NULL, 1, NULL, NULL, NULL, NULL), PDN_ERR_NULL,
            "quantity: expected a pointer, got NULL");
    for (kind = PDN_NODE_POSITION; kind <= PDN_NODE_ACCELERATION; kind++) {
        in.asked = asked_of(kind, NODE(0));
        REFUSES_BAD_SERIES("node");
    }
    for (kind = PDN_JOINT_COORDINATE; kind <= PDN_JOINT_DRIVING_EFFORT; kind++) {
        in.asked = pdn_quantity_of(kind, JOINT(1), PDN_ROTATION);
        REFUSES_BAD_SERIES("joint");
        REFUSES_ENUMS(in.asked.component, SERIES(in.solution), "quantity.component");
        REFUSES_EACH(in.asked.component, int32_t, lacking, SERIES(in.solution),
                     PDN_ERR_NOT_AVAILABLE, "coordinate: ");
        in.asked.object = JOINT(0);
        if (kind == PDN_JOINT_DRIVING_EFFORT)
            REFUSED(SERIES(in.solution), PDN_ERR_NOT_AVAILABLE, "");
    }
    in.asked = asked_of(PDN_JOINT_REACTION, JOINT(1));
    REFUSES_BAD_SERIES("joint");
    REFUSES_ENUMS(in.asked.frame, SERIES(in.solution), "quantity.frame");
    for (kind = PDN_BEAM_STRAIN; kind <= PDN_BEAM_FORCE_JUMP; kind++) {
        in.asked = asked_of(kind, BEAM_ELEMENT(0));
        REFUSES_BAD_SERIES("element");
        REFUSES_NOT_FINITE(in.asked.station, SERIES(in.solution), "station");
        REFUSES_EACH(in.asked.station, double, outside, SERIES(in.solution), PDN_ERR_VALUE,
                     "station: expected ");
    }
}

/* --- Motions without a model --- */

#define REFUSES_BAD_MOTIONS(call)                                                                  \
    do {                                                                                           \
        static const double no_rotation[] = {0.0, -1.0, 1.0001};                                   \
        const double *positions = in.positions, *rotations = in.rotations;                         \
        REFUSES_NOT_FINITE(in.period, call, "period");                                             \
        REFUSES_EACH(in.period, double, not_positive, call, PDN_ERR_VALUE, "period: expected ");   \
        REFUSES_SIZES(in.points, even, call, "points");                                            \
        REFUSES_SIZES(in.points, odd_and_huge, call, "positions");                                 \
        REFUSES_NOT_FINITE_ENTRIES(in.positions, 3 * POINTS, call, "positions");                   \
        REFUSES_NOT_FINITE_ENTRIES(in.rotations, 9 * POINTS, call, "rotations");                   \
        REFUSES_EACH(in.rotations[0], double, no_rotation, call, PDN_ERR_VALUE,                    \
                     "rotations: expected rotation matrices");                                     \
        REFUSES_NULL(positions, call, "positions");                                                \
        positions = in.positions;                                                                  \
        REFUSES_NULL(rotations, call, "rotations");                                                \
        rotations = in.rotations;                                                                  \
        CHECK_STATUS(call, PDN_OK);                                                                \
    } while (0)

static const size_t odd_and_huge[] = {(size_t)-1, (size_t)-1 / 2, (size_t)-1 / 16};

static void motions(void)
{
    const double *times = in.times;

#define CALL                                                                                       \
    pdn_motion_interpolate(in.period, positions, rotations, in.points, times, in.count,            \
                           out.values, out.cosines, out.sines, out.tangent)
    REFUSES_BAD_MOTIONS(CALL);
    {
        const double *positions = in.positions, *rotations = in.rotations;
        REFUSES_NOT_FINITE_ENTRIES(in.times, TIMES, CALL, "times");
        REFUSES_SIZES(in.count, huge_counts, CALL, "times");
        REFUSES_NULL(times, CALL, "times");
    }
#undef CALL
    CHECK_STATUS(pdn_motion_interpolate(in.period, in.positions, in.rotations, POINTS, in.times,
                                        TIMES, NULL, NULL, NULL, NULL),
                 PDN_OK);
    CHECK_STATUS(pdn_motion_interpolate(in.period, in.positions, in.rotations, POINTS, NULL, 0,
                                        NULL, NULL, NULL, NULL),
                 PDN_OK);

#define CALL                                                                                       \
    pdn_motion_grid_kinematics(in.period, positions, rotations, in.points, out.values,             \
                               out.cosines, out.tangent, out.other_tangent)
    REFUSES_BAD_MOTIONS(CALL);
#undef CALL
    CHECK_STATUS(pdn_motion_grid_kinematics(in.period, in.positions, in.rotations, POINTS, NULL,
                                            NULL, NULL, NULL),
                 PDN_OK);
}

/* Angles at three times whose interpolation has no direction at T / 5. */
static void indefinite_angles(double angle[POINTS])
{
    double g[POINTS], x, y;
    int k;
    for (k = 0; k < POINTS; k++)
        g[k] = (1 + 2 * cos(2 * PI * (0.2 - k / 3.0))) / 3; /* cardinal functions there */
    angle[0] = 0;
    angle[1] = acos((g[2] * g[2] - g[0] * g[0] - g[1] * g[1]) / (2 * g[0] * g[1]));
    x = g[0] + g[1] * cos(angle[1]);
    y = g[1] * sin(angle[1]);
    angle[2] = atan2(-y / g[2], -x / g[2]);
}

static void grids_too_coarse(void)
{
    const pdn_model *const saved = in.model;
    double angle[POINTS], time = 0.2 * in.period;
    int32_t kind;
    int k;
    pdn_signal signal;
    pdn_model *made;
    pdn_solution *coarse = NULL;

    indefinite_angles(angle);
    for (k = 0; k < POINTS; k++) {
        double *const R = in.rotations + 9 * k;
        R[0] = R[4] = cos(angle[k]);
        R[1] = sin(angle[k]);
        R[3] = -R[1];
    }
    REFUSED(pdn_motion_interpolate(in.period, in.positions, in.rotations, POINTS, &time, 1,
                                   out.values, out.cosines, out.sines, out.tangent),
            PDN_ERR_GRID_TOO_COARSE, "points: 3 grid points are too coarse");

    PDN_INIT(pdn_signal, &signal);
    CHECK_STATUS(pdn_signal_set_samples(&signal, 0, angle, POINTS), PDN_OK);
    in.model = made = wheel(&signal, NULL, 0);
    CHECK_STATUS(pdn_solve_periodic(made, in.period, &in.options, &coarse), PDN_OK);
    CHECK(pdn_solution_outcome(coarse) == PDN_CONVERGED);
    for (kind = PDN_NODE_POSITION; kind <= PDN_NODE_ACCELERATION; kind++) {
        in.asked = asked_of(kind, NODE(0));
        REFUSED(pdn_solution_sample(coarse, &in.asked, &time, 1, out.values),
                PDN_ERR_GRID_TOO_COARSE, "");
    }
    in.options.grid_points = 5;
    in.options.initial = coarse;
    REFUSED(solve(), PDN_ERR_GRID_TOO_COARSE, "");
    in.options.grid_points = POINTS;
    in.options.initial = NULL;
    in.model = saved;
    pdn_solution_free(coarse);
    pdn_model_free(made);
}

int main(void)
{
    set_up();
    solves();
    starts();
    what_does_not_repeat();
    wholes();
    samples_of_nodes();
    samples_of_joints();
    samples_of_beams();
    harmonics();
    motions();
    grids_too_coarse();
    pdn_solution_free(good);
    pdn_model_free(model);
    printf("%d refusals\n", refusals);
    return 0;
}
