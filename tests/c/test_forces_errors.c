/* Every function of forces refuses what it must, and functions of the user that fail, or return
 * what is no number, are named: nothing is written, and the model stays as it was. */
#include "near.h"

#define PERIOD 1.4

/* What a function of the user does wrong: nothing, or one of these. */
enum { GOOD, FAILS, LEAVES, NO_NUMBER, INFINITE, NO_DERIVATIVE, RANDOM, DRIFTS };

/* Arguments, each of them good. */
static struct {
    pdn_model *model;
    pdn_signal signal;
    pdn_frame frame;
    double matrix[36], stiffness[3], damping[2], branches[2], relaxation[2], number, period;
    double times[2];
    int32_t nodes[2];
    int32_t node, other, joint, rigid, coordinate, place, axes, tangents, force, wrong, law_wrong;
    pdn_tangent_check check;
    pdn_quantity asked;
} in;

/* Where results go; filled with a pattern. */
static struct {
    pdn_solution *solution;
    double values[12], mean[6], rate[6], cosines[6], sines[6];
    int32_t id;
} out;

static pdn_solution *good;
static int32_t expected_forces, destroyed;

static int model_changed(void)
{
    int32_t count;
    CHECK_STATUS(pdn_model_force_count(in.model, &count), PDN_OK);
    return count != expected_forces || destroyed != 0;
}

#include "refusal.h"

#define REFUSES_NULL(call, name) REFUSED(call, PDN_ERR_NULL, name ": expected a pointer, got NULL")
#define REFUSES_IDS(variable, ids, call, name)                                                     \
    REFUSES_EACH(variable, int32_t, ids, call, PDN_ERR_ID, name ": expected ")
#define REFUSES_ENUMS(variable, call, name)                                                        \
    do {                                                                                           \
        REFUSES_EACH(variable, int32_t, bad_enums, call, PDN_ERR_VALUE, name ": expected ");       \
        REFUSES_OTHER_ROLES(variable, call, name ": expected ");                                   \
    } while (0)

static const int32_t bad_ids[] = {-1, NO_IDS};
static const int32_t bad_bodies[] = {NO_IDS};
static const size_t too_many = (size_t)-1;

static void destroy(void *user_data)
{
    (void)user_data;
    destroyed++;
}

/* Another one in each call, or one that grows with time. */
static double astray(int32_t wrong, double time)
{
    static double calls;
    calls++;
    return wrong == RANDOM ? sin(calls) : wrong == DRIFTS ? time : 0;
}

static int32_t law(double time, double coordinate, double rate, double *effort, double *derivatives,
                   void *user_data)
{
    const int32_t wrong = *(const int32_t *)user_data;
    if (wrong == FAILS) {
        pdn_set_callback_error("out of range");
        return 7;
    }
    if (wrong != LEAVES)
        *effort = wrong == NO_NUMBER  ? (double)NAN
                  : wrong == INFINITE ? (double)INFINITY
                                      : 20 * coordinate + rate + astray(wrong, time);
    if (derivatives != NULL) {
        derivatives[0] = 20;
        if (wrong != NO_DERIVATIVE)
            derivatives[1] = 1;
    }
    return 0;
}

static int32_t force(const pdn_force_state *state, pdn_force_values *values, void *user_data)
{
    const int32_t wrong = *(const int32_t *)user_data;
    int k;
    if (wrong == FAILS)
        return -3;
    for (k = 0; k < 6; k++)
        values->forces[6 + k] = -state->velocities[6 + k];
    values->forces[2] = astray(wrong, state->time);
    if (wrong == NO_NUMBER)
        values->forces[7] = NAN;
    if (wrong == INFINITE)
        values->forces[4] = -INFINITY;
    if (values->by_velocity != NULL) {
        for (k = 6; k < 12; k++)
            values->by_velocity[13 * k] = -1;
        if (wrong == NO_DERIVATIVE)
            values->by_motion[12 * 3 + 8] = NAN;
    }
    return 0;
}

/* Two bodies: one on a hinge, with forces on it, one held by a rigid joint. */
static void set_up(void)
{
    static const double eye[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    static const double origin[3] = {0, 0, 0}, beside[3] = {1, 0, 0}, up[3] = {0, 0, 1};
    const pdn_periodic_options *const defaults = NULL;
    static const double cosine = 1, sine = 0;
    int k;
    memset(&in, 0, sizeof in);
    PDN_INIT(pdn_signal, &in.signal);
    CHECK_STATUS(pdn_signal_set_harmonics(&in.signal, 0, 0, &cosine, &sine, 1), PDN_OK);
    PDN_INIT(pdn_tangent_check, &in.check);
    memcpy(in.frame.rotation, eye, sizeof eye);
    for (k = 0; k < 6; k++)
        in.matrix[7 * k] = 1;
    in.stiffness[0] = in.damping[0] = in.branches[0] = in.branches[1] = 2;
    in.relaxation[0] = in.relaxation[1] = in.number = 0.5;
    in.period = PERIOD;
    in.coordinate = PDN_ROTATION;
    in.axes = PDN_FRAME_SPACE;
    in.tangents = PDN_TANGENTS_GIVEN;
    in.times[1] = 0.3;
    CHECK_STATUS(pdn_model_new(&in.model), PDN_OK);
    CHECK_STATUS(pdn_model_add_rigid_body(in.model, 1, origin, eye, &in.node), PDN_OK);
    CHECK_STATUS(pdn_model_add_rigid_body(in.model, 1, beside, eye, &in.other), PDN_OK);
    CHECK_STATUS(pdn_model_add_revolute(in.model, PDN_GROUND, in.node, origin, up, &in.joint),
                 PDN_OK);
    CHECK_STATUS(pdn_model_add_rigid_joint(in.model, PDN_GROUND, in.other, beside, &in.rigid),
                 PDN_OK);
    in.nodes[0] = in.other;
    in.nodes[1] = in.node;
    CHECK_STATUS(pdn_model_add_spring_damper(in.model, JOINT(0), PDN_ROTATION, 20, 1, 0, NULL),
                 PDN_OK);
    CHECK_STATUS(pdn_model_add_actuator(in.model, JOINT(0), PDN_ROTATION, &in.signal, NULL),
                 PDN_OK);
    CHECK_STATUS(pdn_model_add_viscoelastic(in.model, JOINT(0), PDN_ROTATION, 1, 0, in.branches,
                                            in.relaxation, 2, NULL),
                 PDN_OK);
    CHECK_STATUS(pdn_model_add_viscous_damper(in.model, NODE(0), PDN_GROUND, NULL, in.matrix, NULL),
                 PDN_OK);
    CHECK_STATUS(pdn_solve_periodic(in.model, PERIOD, defaults, &good), PDN_OK);
    CHECK(pdn_solution_outcome(good) == PDN_CONVERGED);
    expected_forces = 4;
}

/* What all forces on coordinates refuse; the call is CALL, or WITH another model. */
#define REFUSES_BAD_PLACES                                                                         \
    do {                                                                                           \
        const int32_t saved_ = in.joint;                                                           \
        REFUSES_NULL(WITH(NULL), "model");                                                         \
        REFUSES_IDS(in.joint, bad_ids, WITH(in.model), "joint");                                   \
        REFUSES_ENUMS(in.coordinate, WITH(in.model), "coordinate");                                \
        in.coordinate = PDN_DISPLACEMENT;                                                          \
        REFUSED(WITH(in.model), PDN_ERR_NOT_AVAILABLE,                                             \
                "coordinate: expected one of a revolute joint ");                                  \
        in.coordinate = PDN_ROTATION;                                                              \
        in.joint = in.rigid;                                                                       \
        REFUSED(WITH(in.model), PDN_ERR_NOT_AVAILABLE,                                             \
                "coordinate: expected one of a rigid joint ");                                     \
        in.joint = saved_;                                                                         \
    } while (0)

static void forces_on_coordinates(void)
{
    static const double not_positive[] = {0.0, -1.0};
    static const int32_t one[] = {1};
    static const size_t bad_struct_sizes[] = {0, 7, 8, 5000, (size_t)-1};

#define WITH(model)                                                                                \
    pdn_model_add_nonlinear_spring_damper(model, in.joint, in.coordinate, in.stiffness, 3,         \
                                          in.damping, 2, in.number, &out.id)
#define SIZED(stiffness, count, damping, other)                                                    \
    pdn_model_add_nonlinear_spring_damper(in.model, JOINT(0), in.coordinate, stiffness, count,     \
                                          damping, other, 0, &out.id)
    REFUSES_BAD_PLACES;
    REFUSES_NULL(SIZED(NULL, 3, in.damping, 2), "stiffness");
    REFUSES_NULL(SIZED(in.stiffness, 3, NULL, 2), "damping");
    REFUSED(SIZED(in.stiffness, too_many, in.damping, 2), PDN_ERR_SIZE,
            "stiffness: expected at most ");
    REFUSED(SIZED(in.stiffness, 3, in.damping, too_many), PDN_ERR_SIZE,
            "damping: expected at most ");
    REFUSES_NOT_FINITE_ENTRIES(in.stiffness, 3, WITH(in.model), "stiffness");
    REFUSES_NOT_FINITE_ENTRIES(in.damping, 2, WITH(in.model), "damping");
    REFUSES_NOT_FINITE(in.number, WITH(in.model), "rest");
#undef SIZED
#undef WITH

#define WITH(model)                                                                                \
    pdn_model_add_spring_damper(model, in.joint, in.coordinate, in.number, 1, 0, &out.id)
    REFUSES_BAD_PLACES;
    REFUSES_NOT_FINITE(in.number, WITH(in.model), "stiffness");
#undef WITH

#define WITH(model) pdn_model_add_actuator(model, in.joint, in.coordinate, &in.signal, &out.id)
    REFUSES_BAD_PLACES;
    REFUSES_NULL(pdn_model_add_actuator(in.model, JOINT(0), in.coordinate, NULL, &out.id),
                 "signal");
    REFUSES_EACH(in.signal.struct_size, size_t, bad_struct_sizes, WITH(in.model),
                 PDN_ERR_STRUCT_SIZE, "signal: expected struct_size ");
    REFUSES_ENUMS(in.signal.kind, WITH(in.model), "signal: kind");
    REFUSES_EACH(in.signal.reserved, int32_t, one, WITH(in.model), PDN_ERR_VALUE,
                 "signal: reserved: expected zero");
    REFUSES_NOT_FINITE(in.signal.mean, WITH(in.model), "signal: mean");
#undef WITH

#define WITH(model)                                                                                \
    pdn_model_add_viscoelastic(model, in.joint, in.coordinate, in.number, in.number, in.branches,  \
                               in.relaxation, 2, &out.id)
#define SIZED(branches, times, count)                                                              \
    pdn_model_add_viscoelastic(in.model, JOINT(0), in.coordinate, 1, 0, branches, times, count,    \
                               &out.id)
    REFUSES_BAD_PLACES;
    REFUSES_NULL(SIZED(NULL, in.relaxation, 2), "branch_stiffness");
    REFUSES_NULL(SIZED(in.branches, NULL, 2), "relaxation_times");
    REFUSED(SIZED(in.branches, in.relaxation, too_many), PDN_ERR_SIZE,
            "branch_stiffness: expected at most ");
    REFUSES_NOT_FINITE(in.number, WITH(in.model), "stiffness");
    REFUSES_NOT_FINITE(in.number,
                       pdn_model_add_viscoelastic(in.model, JOINT(0), in.coordinate, 1, in.number,
                                                  in.branches, in.relaxation, 2, &out.id),
                       "rest");
    REFUSES_NOT_FINITE_ENTRIES(in.branches, 2, WITH(in.model), "branch_stiffness");
    REFUSES_NOT_FINITE_ENTRIES(in.relaxation, 2, WITH(in.model), "relaxation_times");
    REFUSES_EACH(in.branches[1], double, not_positive, WITH(in.model), PDN_ERR_VALUE,
                 "branch_stiffness[1]: expected a positive number");
    REFUSES_EACH(in.relaxation[1], double, not_positive, WITH(in.model), PDN_ERR_VALUE,
                 "relaxation_times[1]: expected a positive number");
#undef SIZED
#undef WITH

#define WITH(model)                                                                                \
    pdn_model_add_coordinate_law(model, in.joint, in.coordinate, in.tangents, law, &in.wrong,      \
                                 destroy, &out.id)
    REFUSES_BAD_PLACES;
    REFUSES_ENUMS(in.tangents, WITH(in.model), "tangents");
    REFUSES_NULL(pdn_model_add_coordinate_law(in.model, JOINT(0), in.coordinate, in.tangents, NULL,
                                              NULL, destroy, &out.id),
                 "function");
#undef WITH
}

static void dampers(void)
{
    static const double stretched[] = {2.0, -1.0, 1.0001};
    static const double negative[] = {-1e-9, -1.0}, lopsided[] = {0.5, -0.5};
    const int32_t other = in.other;

#define WITH(model, frame, matrix)                                                                 \
    pdn_model_add_viscous_damper(model, in.node, in.other, frame, matrix, &out.id)
#define CALL WITH(in.model, &in.frame, in.matrix)
    REFUSES_NULL(WITH(NULL, NULL, in.matrix), "model");
    REFUSES_NULL(WITH(in.model, NULL, NULL), "matrix");
    REFUSES_IDS(in.node, bad_bodies, CALL, "first");
    REFUSES_IDS(in.other, bad_bodies, CALL, "second");
    in.other = in.node;
    REFUSED(CALL, PDN_ERR_VALUE, "first, second: expected two different bodies");
    in.other = other;
    REFUSES_NOT_FINITE_ENTRIES(in.matrix, 36, CALL, "matrix");
    REFUSES_NOT_FINITE_ENTRIES(in.frame.position, 3, CALL, "frame position");
    REFUSES_NOT_FINITE_ENTRIES(in.frame.rotation, 9, CALL, "frame rotation");
    REFUSES_EACH(in.frame.rotation[4], double, stretched, CALL, PDN_ERR_VALUE,
                 "frame rotation: expected a rotation matrix");
    REFUSES_EACH(in.matrix[14], double, negative, CALL, PDN_ERR_VALUE,
                 "matrix: expected a positive semi-definite matrix");
    REFUSES_EACH(in.matrix[9], double, lopsided, CALL, PDN_ERR_VALUE,
                 "matrix: expected a symmetric matrix");
    /* Symmetric, with positive entries on the diagonal, and yet not definite. */
    in.matrix[1] = in.matrix[6] = 1.5;
    REFUSED(CALL, PDN_ERR_VALUE, "matrix: expected a positive semi-definite matrix");
    in.matrix[1] = in.matrix[6] = 0;
#undef CALL
#undef WITH
}

static void user_forces(void)
{
    static const size_t bad_counts[] = {0, 3, 1000000, (size_t)-1};
    size_t count = 2;
    int32_t saved;
#define WITH(model, nodes, function)                                                               \
    pdn_model_add_user_force(model, nodes, count, in.axes, in.tangents, function, &in.wrong,       \
                             destroy, &out.id)
#define CALL WITH(in.model, in.nodes, force)
    REFUSES_NULL(WITH(NULL, in.nodes, force), "model");
    REFUSES_NULL(WITH(in.model, NULL, force), "nodes");
    REFUSES_NULL(WITH(in.model, in.nodes, NULL), "function");
    REFUSES_EACH(count, size_t, bad_counts, CALL, PDN_ERR_SIZE, "count: expected 1 to 2");
    REFUSES_IDS(in.nodes[0], bad_ids, CALL, "nodes[0]");
    REFUSES_IDS(in.nodes[1], bad_ids, CALL, "nodes[1]");
    saved = in.nodes[1];
    in.nodes[1] = in.nodes[0];
    REFUSED(CALL, PDN_ERR_VALUE, "nodes: expected distinct nodes, got node 1 twice");
    in.nodes[1] = saved;
    REFUSES_ENUMS(in.axes, CALL, "frame");
    REFUSES_ENUMS(in.tangents, CALL, "tangents");
#undef CALL
#undef WITH
    REFUSES_NULL(pdn_model_force_count(NULL, &out.id), "model");
    REFUSES_NULL(pdn_model_force_count(in.model, NULL), "count");
}

/* --- Functions of the user that go wrong --- */

#define SOLVE pdn_solve_periodic(in.model, in.period, NULL, &out.solution)
#define CHECK_TANGENTS pdn_model_check_tangents(in.model, in.force, in.period, &in.check)

static void laws_that_go_wrong(void)
{
    static const struct {
        int32_t wrong;
        const char *message;
    } cases[] = {
        {FAILS, "force 4: coordinate law: the callback returned 7: out of range"},
        {LEAVES, "force 4: callback: expected a finite effort at t = "},
        {NO_NUMBER, "force 4: callback: expected a finite effort at t = "},
        {INFINITE, "force 4: callback: expected a finite effort at t = "},
        {NO_DERIVATIVE, "force 4: callback: expected a finite derivative by the rate at t = "},
    };
    size_t k;
    CHECK_STATUS(pdn_model_add_coordinate_law(in.model, JOINT(0), PDN_ROTATION, PDN_TANGENTS_GIVEN,
                                              law, &in.law_wrong, NULL, &in.force),
                 PDN_OK);
    expected_forces = 5;
    for (k = 0; k < LENGTH(cases); k++) {
        in.law_wrong = cases[k].wrong;
        REFUSED(SOLVE, PDN_ERR_CALLBACK, cases[k].message);
        REFUSED(CHECK_TANGENTS, PDN_ERR_CALLBACK, cases[k].message);
        if (in.law_wrong == FAILS)
            CHECK(pdn_last_callback_code() == 7);
    }
    in.law_wrong = RANDOM;
    REFUSED(SOLVE, PDN_ERR_NOT_PERIODIC,
            "force 4 on joint 0: the function gives different values at the same time and "
            "motion: ");
    in.law_wrong = DRIFTS;
    REFUSED(SOLVE, PDN_ERR_NOT_PERIODIC,
            "force 4 on joint 0: the function does not repeat with the period ");
    in.law_wrong = GOOD;
}

static void user_forces_that_go_wrong(void)
{
    static const struct {
        int32_t wrong;
        const char *message;
    } cases[] = {
        {FAILS, "force 5: user force: the callback returned -3"},
        {NO_NUMBER, "force 5: callback: expected a finite force 2 on node 0 at t = "},
        {INFINITE, "force 5: callback: expected a finite moment 2 on node 1 at t = "},
        {NO_DERIVATIVE,
         "force 5: callback: expected a finite derivative of force 3 on node 0 by component 4 of "
         "the motion of node 1 at t = "},
    };
    size_t k;
    CHECK_STATUS(pdn_model_add_user_force(in.model, in.nodes, 2, PDN_FRAME_SPACE,
                                          PDN_TANGENTS_GIVEN, force, &in.wrong, NULL, &in.force),
                 PDN_OK);
    expected_forces = 6;
    for (k = 0; k < LENGTH(cases); k++) {
        in.wrong = cases[k].wrong;
        REFUSED(CHECK_TANGENTS, PDN_ERR_CALLBACK, cases[k].message);
    }
    in.wrong = GOOD;
}

/* The same in a solve, where nothing else goes wrong. */
static void solves_with_forces_that_go_wrong(void)
{
    static const double origin[3] = {0, 0, 0}, eye[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    static const int32_t tangents[] = {PDN_TANGENTS_GIVEN, PDN_TANGENTS_DIFFERENCED};
    pdn_model *const saved = in.model;
    const int32_t saved_count = expected_forces;
    int k;
    for (k = 0; k < 2; k++) {
        int32_t nodes[2], joint;
        CHECK_STATUS(pdn_model_new(&in.model), PDN_OK);
        CHECK_STATUS(pdn_model_add_rigid_body(in.model, 1, origin, eye, &nodes[0]), PDN_OK);
        CHECK_STATUS(pdn_model_add_rigid_body(in.model, 1, origin, eye, &nodes[1]), PDN_OK);
        CHECK_STATUS(pdn_model_add_rigid_joint(in.model, PDN_GROUND, nodes[0], origin, &joint),
                     PDN_OK);
        CHECK_STATUS(pdn_model_add_user_force(in.model, nodes, 2, PDN_FRAME_SPACE, tangents[k],
                                              force, &in.wrong, NULL, NULL),
                     PDN_OK);
        expected_forces = 1;
        in.wrong = FAILS;
        REFUSED(SOLVE, PDN_ERR_CALLBACK, "force 0: user force: the callback returned -3");
        CHECK(pdn_last_callback_code() == -3);
        in.wrong = NO_NUMBER;
        REFUSED(SOLVE, PDN_ERR_CALLBACK,
                "force 0: callback: expected a finite force 2 on node 1 at t = ");
        in.wrong = INFINITE;
        REFUSED(SOLVE, PDN_ERR_CALLBACK,
                "force 0: callback: expected a finite moment 2 on node 0 at t = ");
        if (tangents[k] == PDN_TANGENTS_GIVEN) {
            in.wrong = NO_DERIVATIVE;
            REFUSED(SOLVE, PDN_ERR_CALLBACK,
                    "force 0: callback: expected a finite derivative of force 3 on node 1 ");
        }
        in.wrong = RANDOM;
        REFUSED(SOLVE, PDN_ERR_NOT_PERIODIC,
                "force 0: the function gives different values at the same time and motion: ");
        in.wrong = DRIFTS;
        REFUSED(SOLVE, PDN_ERR_NOT_PERIODIC,
                "force 0: the function does not repeat with the period ");
        in.wrong = GOOD;
        pdn_model_free(in.model);
    }
    in.model = saved;
    expected_forces = saved_count;
}

static int32_t no_number(double time, double *value, void *user_data)
{
    (void)user_data;
    *value = time > 0.5 ? (double)NAN : 0.0;
    return 0;
}

/* Signals that are no number at times: of an actuator, a drive and a load. */
static void signals_that_go_wrong(void)
{
    static const double origin[3] = {0, 0, 0}, eye[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    static const double up[3] = {0, 0, 1};
    static const char *const messages[] = {
        "force 0: signal callback: expected a finite number at t = ",
        "prescribed rotation 1 of joint 0: signal callback: expected a finite number at t = ",
        "load 0 on node 0: signal callback: expected a finite number at t = "};
    pdn_model *const saved = in.model;
    const int32_t saved_count = expected_forces;
    pdn_signal signal;
    size_t k;
    PDN_INIT(pdn_signal, &signal);
    CHECK_STATUS(pdn_signal_set_function(&signal, no_number, NULL), PDN_OK);
    for (k = 0; k < LENGTH(messages); k++) {
        int32_t node, joint;
        CHECK_STATUS(pdn_model_new(&in.model), PDN_OK);
        CHECK_STATUS(pdn_model_add_rigid_body(in.model, 1, origin, eye, &node), PDN_OK);
        CHECK_STATUS(pdn_model_add_revolute(in.model, PDN_GROUND, node, origin, up, &joint),
                     PDN_OK);
        if (k == 0)
            CHECK_STATUS(pdn_model_add_actuator(in.model, joint, PDN_ROTATION, &signal, NULL),
                         PDN_OK);
        else if (k == 1)
            CHECK_STATUS(pdn_model_prescribe(in.model, joint, PDN_ROTATION, &signal, NULL), PDN_OK);
        else
            CHECK_STATUS(
                pdn_model_add_load(in.model, node, PDN_FRAME_SPACE, PDN_MOMENT_3, &signal, NULL),
                PDN_OK);
        expected_forces = k == 0;
        REFUSED(SOLVE, PDN_ERR_CALLBACK, messages[k]);
        pdn_model_free(in.model);
    }
    in.model = saved;
    expected_forces = saved_count;
}

static void checks_of_tangents(void)
{
    static const size_t bad_struct_sizes[] = {0, 7, 8, 5000, (size_t)-1};
    static const double not_positive[] = {0.0, -1.0};
    pdn_tangent_check check;
    int32_t force_id;
    size_t k;
    memset(&check, 0x5a, sizeof check);
    pdn_tangent_check_init(NULL, sizeof check);
    CHECK_MESSAGE("check: expected a pointer, got NULL");
    for (k = 0; k < 3; k++) {
        const size_t sizes[] = {0, 7, 5000};
        pdn_tangent_check_init(&check, sizes[k]);
        CHECK_MESSAGE("struct_size: expected between");
        CHECK(check.reserved == 0x5a5a5a5a && check.tangent == 0x5a5a5a5a);
    }
    REFUSES_NULL(pdn_model_check_tangents(NULL, FORCE(4), PERIOD, &in.check), "model");
    REFUSES_NULL(pdn_model_check_tangents(in.model, FORCE(4), PERIOD, NULL), "check");
    REFUSES_IDS(in.force, bad_ids, CHECK_TANGENTS, "force");
    REFUSES_NOT_FINITE(in.period, CHECK_TANGENTS, "period");
    REFUSES_EACH(in.period, double, not_positive, CHECK_TANGENTS, PDN_ERR_VALUE, "period: ");
    REFUSES_EACH(in.check.struct_size, size_t, bad_struct_sizes, CHECK_TANGENTS,
                 PDN_ERR_STRUCT_SIZE, "check: expected struct_size ");
    force_id = in.force;
    for (in.force = FORCE(0); in.force < FORCE(4); in.force++)
        REFUSED(CHECK_TANGENTS, PDN_ERR_NOT_AVAILABLE, "force ");
    CHECK_STATUS(pdn_model_add_coordinate_law(in.model, JOINT(0), PDN_ROTATION,
                                              PDN_TANGENTS_DIFFERENCED, law, &in.wrong, NULL,
                                              &in.force),
                 PDN_OK);
    expected_forces++;
    REFUSED(CHECK_TANGENTS, PDN_ERR_NOT_AVAILABLE,
            "force 6: its tangents are found by differences: there is nothing to compare");
    in.force = force_id;
    CHECK_STATUS(CHECK_TANGENTS, PDN_OK);
}

/* --- What is read of them --- */

static void readings(void)
{
    static const int32_t negative[] = {-1, INT32_MIN}, absent[] = {2, 99, INT32_MAX};
    const double *const t = in.times;

    /* Those that take a force, times and a place for values. */
#define WITH(solution, times, count, values)                                                       \
    pdn_solution_sample(solution, PDN_QUANTITY(PDN_FORCE_EFFORT, in.force, PDN_ALL_COMPONENTS),    \
                        times, count, values)
#define REFUSES_BAD_SAMPLES                                                                        \
    do {                                                                                           \
        REFUSES_NULL(WITH(NULL, t, 2, out.values), "solution");                                    \
        REFUSES_NULL(WITH(good, NULL, 2, out.values), "times");                                    \
        REFUSES_NULL(WITH(good, t, 2, NULL), "out");                                               \
        REFUSES_NOT_FINITE_ENTRIES(in.times, 2, WITH(good, t, 2, out.values), "times");            \
        REFUSES_OBJECTS(in.force, WITH(good, t, 2, out.values), "force", "object");                \
        REFUSED(WITH(good, t, too_many, out.values), PDN_ERR_SIZE, "times: expected at most ");    \
    } while (0)
    in.force = FORCE(0);
    REFUSES_BAD_SAMPLES;
    in.force = FORCE(3); /* on no coordinate */
    REFUSED(WITH(good, t, 2, out.values), PDN_ERR_NOT_AVAILABLE, "");
#undef WITH

#define WITH(solution, times, count, values)                                                       \
    pdn_solution_sample(                                                                           \
        solution,                                                                                  \
        PDN_QUANTITY(PDN_FORCE_BRANCH_EFFORT, in.force, PDN_ALL_COMPONENTS, .branch = in.place),   \
        times, count, values)
    in.force = FORCE(2);
    REFUSES_BAD_SAMPLES;
    REFUSES_IDS(in.place, negative, WITH(good, t, 2, out.values), "quantity.branch");
    REFUSES_EACH(in.place, int32_t, absent, WITH(good, t, 2, out.values), PDN_ERR_NOT_AVAILABLE,
                 "branch: force 2 has 2 Maxwell branches, got ");
    in.force = FORCE(0);
    REFUSED(WITH(good, t, 2, out.values), PDN_ERR_NOT_AVAILABLE, "");
#undef WITH

#define WITH(solution, times, count, values)                                                       \
    pdn_solution_sample(solution,                                                                  \
                        PDN_QUANTITY(PDN_FORCE_BRANCH_ELONGATION, in.force, PDN_ALL_COMPONENTS,    \
                                     .branch = in.place),                                          \
                        times, count, values)
    in.force = FORCE(2);
    REFUSES_BAD_SAMPLES;
    REFUSES_IDS(in.place, negative, WITH(good, t, 2, out.values), "quantity.branch");
    REFUSES_EACH(in.place, int32_t, absent, WITH(good, t, 2, out.values), PDN_ERR_NOT_AVAILABLE,
                 "branch: force 2 has 2 Maxwell branches, got ");
    in.force = FORCE(1);
    REFUSED(WITH(good, t, 2, out.values), PDN_ERR_NOT_AVAILABLE, "");
#undef WITH

#define WITH(solution, times, count, values)                                                       \
    pdn_solution_sample(solution,                                                                  \
                        PDN_QUANTITY(PDN_FORCE_ON_NODE, in.force, PDN_ALL_COMPONENTS,              \
                                     .node = in.place, .frame = in.axes),                          \
                        times, count, values)
    in.force = FORCE(0);
    in.place = in.node;
    REFUSES_BAD_SAMPLES;
    REFUSES_OBJECTS(in.place, WITH(good, t, 2, out.values), "node", "node");
    REFUSES_ENUMS(in.axes, WITH(good, t, 2, out.values), "quantity: frame");
    in.place = in.other;
    REFUSED(WITH(good, t, 2, out.values), PDN_ERR_NOT_AVAILABLE, "");
    in.place = 0;
#undef WITH
#undef REFUSES_BAD_SAMPLES

    in.asked = pdn_quantity_of(PDN_FORCE_EFFORT, FORCE(0), PDN_ALL_COMPONENTS);
#define WITH(solution, count)                                                                      \
    pdn_solution_harmonics(solution, &in.asked, count, out.mean, out.rate, out.cosines, out.sines)
    REFUSES_NULL(WITH(NULL, 1), "solution");
    REFUSES_OBJECTS(in.asked.object, WITH(good, 1), "force", "object");
    REFUSES_EACH(in.asked.kind, int32_t, bad_enums, WITH(good, 1), PDN_ERR_VALUE,
                 "quantity.kind: expected PDN_");
    REFUSED(WITH(good, 1048577), PDN_ERR_SIZE, "harmonics: expected at most 1048576, got 1048577");
    in.asked.kind = PDN_FORCE_BRANCH_EFFORT;
    in.asked.object = FORCE(2);
    REFUSES_IDS(in.asked.branch, negative, WITH(good, 1), "quantity.branch");
    REFUSES_EACH(in.asked.branch, int32_t, absent, WITH(good, 1), PDN_ERR_NOT_AVAILABLE,
                 "branch: ");
    in.asked.kind = PDN_FORCE_ON_NODE;
    in.asked.node = in.other;
    REFUSED(WITH(good, 1), PDN_ERR_NOT_AVAILABLE, "");
#undef WITH
}

int main(void)
{
    set_up();
    forces_on_coordinates();
    dampers();
    user_forces();
    laws_that_go_wrong();
    user_forces_that_go_wrong();
    solves_with_forces_that_go_wrong();
    signals_that_go_wrong();
    checks_of_tangents();
    readings();
    /* The tables above were gone through. */
    CHECK(refusals >= 460);
    /* And the model can be solved. */
    CHECK_STATUS(SOLVE, PDN_OK);
    CHECK(pdn_solution_outcome(out.solution) == PDN_CONVERGED);
    pdn_solution_free(out.solution);
    pdn_solution_free(good);
    pdn_model_free(in.model);
    printf("%d refusals\n", refusals);
    return 0;
}
