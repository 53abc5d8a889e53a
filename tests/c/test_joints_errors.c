/* Joints that are refused, drives that do not repeat, and mechanisms that cannot move or have
 * closed the wrong way round: each is named, and the model stays as it was. */
#include "near.h"

static const double PERIOD = 1.5;

/* Arguments, each of them good. */
static struct {
    pdn_model *model;
    pdn_frame frame, second_frame;
    double point[3], end[3], axis[3], pitch;
    int32_t node, other;
} in;

/* Where results go; filled with a pattern. */
static struct {
    pdn_solution *solution;
    int32_t id;
} out;

/* All that can be seen of the model. */
static struct summary {
    int32_t nodes, joints, forces;
} expected;

static void summarise(struct summary *seen)
{
    CHECK_STATUS(pdn_model_node_count(in.model, &seen->nodes), PDN_OK);
    CHECK_STATUS(pdn_model_joint_count(in.model, &seen->joints), PDN_OK);
    CHECK_STATUS(pdn_model_force_count(in.model, &seen->forces), PDN_OK);
}

static int model_changed(void)
{
    struct summary seen;
    summarise(&seen);
    return memcmp(&seen, &expected, sizeof seen) != 0;
}

#include "refusal.h"

#define REFUSES_NULL(call, name) REFUSED(call, PDN_ERR_NULL, name ": expected a pointer, got NULL")

static const int32_t bad_bodies[] = {NO_IDS};
static const double no_pitch[] = {0.0, -0.0};

#define REFUSES_BAD_BODIES(call)                                                                   \
    do {                                                                                           \
        const int32_t second_ = in.other;                                                          \
        REFUSES_EACH(in.node, int32_t, bad_bodies, call, PDN_ERR_ID, "first: expected ");          \
        REFUSES_EACH(in.other, int32_t, bad_bodies, call, PDN_ERR_ID, "second: expected ");        \
        in.other = in.node;                                                                        \
        REFUSED(call, PDN_ERR_VALUE, "first, second: expected two different bodies");              \
        in.other = second_;                                                                        \
    } while (0)

/* What all joints by point and axis refuse; the call uses `in`, and MODEL, POINT, AXIS
 * and JOINT. */
#define REFUSES_BY_AXIS(axis_name)                                                                 \
    do {                                                                                           \
        static const double zero_[3] = {0, 0, 0};                                                  \
        REFUSES_NULL(WITH(NULL, in.point, in.axis, &out.id), "model");                             \
        REFUSES_NULL(WITH(in.model, NULL, in.axis, &out.id), "point");                             \
        REFUSES_NULL(WITH(in.model, in.point, NULL, &out.id), axis_name);                          \
        REFUSES_NOT_FINITE_ENTRIES(in.point, 3, CALL, "point");                                    \
        REFUSES_NOT_FINITE_ENTRIES(in.axis, 3, CALL, axis_name);                                   \
        REFUSED(WITH(in.model, in.point, zero_, &out.id), PDN_ERR_VALUE,                           \
                axis_name ": expected a vector that is not zero");                                 \
        REFUSES_BAD_BODIES(CALL);                                                                  \
    } while (0)
#define CALL WITH(in.model, in.point, in.axis, &out.id)

static void set_up(void)
{
    static const double eye[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1}, beside[3] = {1, 0, 0};
    in.axis[2] = 1;
    in.end[1] = 2;
    in.pitch = 0.5;
    memcpy(in.frame.rotation, eye, sizeof eye);
    memcpy(in.second_frame.rotation, eye, sizeof eye);
    CHECK_STATUS(pdn_model_new(&in.model), PDN_OK);
    CHECK_STATUS(pdn_model_add_rigid_body(in.model, 1, in.point, eye, &in.node), PDN_OK);
    CHECK_STATUS(pdn_model_add_rigid_body(in.model, 1, beside, eye, &in.other), PDN_OK);
    summarise(&expected);
}

static void joints(void)
{
    static const double stretched[] = {2.0, -1.0, 1.0001};

#define WITH(model, point, axis, joint)                                                            \
    pdn_model_add_prismatic(model, in.node, in.other, point, axis, joint)
    REFUSES_BY_AXIS("axis");
#undef WITH
#define WITH(model, point, axis, joint)                                                            \
    pdn_model_add_cylindrical(model, in.node, in.other, point, axis, joint)
    REFUSES_BY_AXIS("axis");
#undef WITH
#define WITH(model, point, axis, joint)                                                            \
    pdn_model_add_planar(model, in.node, in.other, point, axis, joint)
    REFUSES_BY_AXIS("normal");
#undef WITH
#define WITH(model, point, axis, joint)                                                            \
    pdn_model_add_screw(model, in.node, in.other, point, axis, in.pitch, joint)
    REFUSES_BY_AXIS("axis");
    REFUSES_NOT_FINITE(in.pitch, CALL, "pitch");
    REFUSES_EACH(in.pitch, double, no_pitch, CALL, PDN_ERR_VALUE, "pitch: expected ");
#undef WITH
#undef CALL

#define CALL pdn_joint_frame(in.point, in.axis, in.end, &frame)
    pdn_frame frame;
    const double along[3] = {-2 * in.axis[0], -2 * in.axis[1], -2 * in.axis[2]};
    const double none[3] = {0, 0, 0};
    CHECK_STATUS(CALL, PDN_OK);
    REFUSES_NULL(pdn_joint_frame(NULL, in.axis, in.end, &frame), "point");
    REFUSES_NULL(pdn_joint_frame(in.point, NULL, in.end, &frame), "axis_3");
    REFUSES_NULL(pdn_joint_frame(in.point, in.axis, NULL, &frame), "axis_1");
    REFUSES_NULL(pdn_joint_frame(in.point, in.axis, in.end, NULL), "frame");
    REFUSES_NOT_FINITE_ENTRIES(in.point, 3, CALL, "point");
    REFUSES_NOT_FINITE_ENTRIES(in.axis, 3, CALL, "axis_3");
    REFUSES_NOT_FINITE_ENTRIES(in.end, 3, CALL, "axis_1");
    REFUSED(pdn_joint_frame(in.point, none, in.end, &frame), PDN_ERR_VALUE,
            "axis_3: expected a vector that is not zero");
    REFUSED(pdn_joint_frame(in.point, in.axis, none, &frame), PDN_ERR_VALUE,
            "axis_1: expected a vector that is not zero");
    REFUSED(pdn_joint_frame(in.point, in.axis, along, &frame), PDN_ERR_VALUE,
            "axis_1: expected a direction away from axis_3");
#undef CALL

#define CALL pdn_model_add_free_joint(in.model, in.node, in.other, in.point, &out.id)
    REFUSES_NULL(pdn_model_add_free_joint(NULL, NODE(0), NODE(1), in.point, &out.id), "model");
    REFUSES_NULL(pdn_model_add_free_joint(in.model, NODE(0), NODE(1), NULL, &out.id), "point");
    REFUSES_NOT_FINITE_ENTRIES(in.point, 3, CALL, "point");
    REFUSES_BAD_BODIES(CALL);
#undef CALL

#define CALL pdn_model_add_strut(in.model, in.node, in.other, in.point, in.end, &out.id)
    REFUSES_NULL(pdn_model_add_strut(NULL, NODE(0), NODE(1), in.point, in.end, &out.id), "model");
    REFUSES_NULL(pdn_model_add_strut(in.model, NODE(0), NODE(1), NULL, in.end, &out.id),
                 "first_point");
    REFUSES_NULL(pdn_model_add_strut(in.model, NODE(0), NODE(1), in.point, NULL, &out.id),
                 "second_point");
    REFUSES_NOT_FINITE_ENTRIES(in.point, 3, CALL, "first_point");
    REFUSES_NOT_FINITE_ENTRIES(in.end, 3, CALL, "second_point");
    REFUSES_BAD_BODIES(CALL);
    REFUSED(pdn_model_add_strut(in.model, NODE(0), NODE(1), in.end, in.end, &out.id), PDN_ERR_VALUE,
            "second_point: expected a point away from first_point");
#undef CALL

#define WITH(model, first, second, joint)                                                          \
    pdn_model_add_screw_between(model, in.node, in.other, first, second, in.pitch, joint)
#define CALL WITH(in.model, &in.frame, &in.second_frame, &out.id)
    REFUSES_NULL(WITH(NULL, &in.frame, &in.second_frame, &out.id), "model");
    REFUSES_NULL(WITH(in.model, NULL, &in.second_frame, &out.id), "first_frame");
    REFUSES_NULL(WITH(in.model, &in.frame, NULL, &out.id), "second_frame");
    REFUSES_NOT_FINITE(in.pitch, CALL, "pitch");
    REFUSES_EACH(in.pitch, double, no_pitch, CALL, PDN_ERR_VALUE, "pitch: expected ");
    REFUSES_NOT_FINITE_ENTRIES(in.frame.position, 3, CALL, "first_frame position");
    REFUSES_NOT_FINITE_ENTRIES(in.frame.rotation, 9, CALL, "first_frame rotation");
    REFUSES_NOT_FINITE_ENTRIES(in.second_frame.position, 3, CALL, "second_frame position");
    REFUSES_NOT_FINITE_ENTRIES(in.second_frame.rotation, 9, CALL, "second_frame rotation");
    REFUSES_EACH(in.frame.rotation[4], double, stretched, CALL, PDN_ERR_VALUE,
                 "first_frame rotation: expected a rotation matrix");
    REFUSES_EACH(in.second_frame.rotation[8], double, stretched, CALL, PDN_ERR_VALUE,
                 "second_frame rotation: expected a rotation matrix");
    REFUSES_BAD_BODIES(CALL);
#undef CALL
#undef WITH
}

/* --- Mechanisms --- */

static pdn_periodic_options on_grid(void)
{
    pdn_periodic_options options;
    PDN_INIT(pdn_periodic_options, &options);
    options.grid_points = 7;
    return options;
}

/* How the solve of a model ends; the report must contain the text. */
static int32_t outcome_of(const pdn_model *model, const char *text)
{
    const pdn_periodic_options options = on_grid();
    pdn_solution *solution = NULL;
    int32_t outcome;
    CHECK_STATUS(pdn_solve_periodic(model, PERIOD, &options, &solution), PDN_OK);
    CHECK(reports(solution, text));
    outcome = pdn_solution_outcome(solution);
    pdn_solution_free(solution);
    return outcome;
}

static pdn_signal steady(double rate)
{
    pdn_signal signal;
    PDN_INIT(pdn_signal, &signal);
    CHECK_STATUS(pdn_signal_set_harmonics(&signal, 0, rate, NULL, NULL, 0), PDN_OK);
    return signal;
}

/* A body between two joints to the ground; the second is the last of the model. */
static pdn_model *body_on(int32_t *body)
{
    static const double eye[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    pdn_model *model = NULL;
    CHECK_STATUS(pdn_model_new(&model), PDN_OK);
    CHECK_STATUS(pdn_model_add_rigid_body(model, 1, in.point, eye, body), PDN_OK);
    return model;
}

/* Drives that do not repeat: half a turn, or a displacement that goes on for ever. */
static void drives_that_do_not_repeat_are_named(void)
{
    const struct {
        int32_t coordinate;
        double rate;
        const char *message;
    } drives[] = {
        {PDN_ROTATION, PI / 1.5, "prescribed rotation 1 of joint 1: the signal grows by 3.14159"},
        {PDN_DISPLACEMENT, 2 * PI / 1.5,
         "prescribed displacement 1 of joint 1: the signal grows by 6.28"},
    };
    const pdn_periodic_options options = on_grid();
    pdn_model *const saved = in.model;
    size_t k;
    for (k = 0; k < LENGTH(drives); k++) {
        const pdn_signal signal = steady(drives[k].rate);
        int32_t body, joint;
        in.model = body_on(&body);
        CHECK_STATUS(pdn_model_add_free_joint(in.model, PDN_GROUND, body, in.point, &joint),
                     PDN_OK);
        CHECK_STATUS(
            pdn_model_add_cylindrical(in.model, PDN_GROUND, body, in.point, in.axis, &joint),
            PDN_OK);
        CHECK_STATUS(pdn_model_prescribe(in.model, joint, drives[k].coordinate, &signal, NULL),
                     PDN_OK);
        summarise(&expected);
        REFUSED(pdn_solve_periodic(in.model, PERIOD, &options, &out.solution), PDN_ERR_NOT_PERIODIC,
                drives[k].message);
        pdn_model_free(in.model);
    }
    /* The angle of a screw gains no turns: its displacement would not come back. */
    {
        const pdn_signal signal = steady(2 * PI / PERIOD);
        int32_t body, joint;
        in.model = body_on(&body);
        CHECK_STATUS(
            pdn_model_add_screw(in.model, PDN_GROUND, body, in.point, in.axis, 0.1, &joint),
            PDN_OK);
        CHECK_STATUS(pdn_model_prescribe(in.model, joint, PDN_ROTATION, &signal, NULL), PDN_OK);
        summarise(&expected);
        REFUSED(pdn_solve_periodic(in.model, PERIOD, &options, &out.solution), PDN_ERR_NOT_PERIODIC,
                "prescribed rotation 1 of joint 0: the signal grows by 6.28");
        pdn_model_free(in.model);
    }
    in.model = saved;
    summarise(&expected);
}

/* A slider that two guides hold: free along neither, and driven. */
static void a_locked_mechanism_is_named(void)
{
    const double across[3] = {1, 0, 0};
    pdn_signal signal;
    const double one = 0.1, none = 0;
    int32_t body, joint;
    pdn_model *model = body_on(&body);
    CHECK_STATUS(pdn_model_add_prismatic(model, PDN_GROUND, body, in.point, in.axis, &joint),
                 PDN_OK);
    CHECK_STATUS(pdn_model_add_prismatic(model, PDN_GROUND, body, in.point, across, &joint),
                 PDN_OK);
    PDN_INIT(pdn_signal, &signal);
    CHECK_STATUS(pdn_signal_set_harmonics(&signal, 0, 0, &one, &none, 1), PDN_OK);
    CHECK_STATUS(pdn_model_prescribe(model, JOINT(0), PDN_DISPLACEMENT, &signal, NULL), PDN_OK);
    CHECK(outcome_of(model, "locked: prescribed coordinate 0 cannot move as prescribed, since "
                            "joints 0, 1 leave no freedom") == PDN_INCONSISTENT);
    pdn_model_free(model);
}

/* A frame upside down: the hinge closes turned over. */
static void a_joint_turned_over_is_named(void)
{
    static const int32_t kinds[] = {PDN_JOINT_REVOLUTE, PDN_JOINT_PRISMATIC, PDN_JOINT_CYLINDRICAL,
                                    PDN_JOINT_PLANAR, PDN_JOINT_RIGID};
    static const char *const names[] = {"joint 0 (revolute)", "joint 0 (prismatic)",
                                        "joint 0 (cylindrical)", "joint 0 (planar)",
                                        "joint 0 (rigid)"};
    pdn_frame over = in.frame;
    size_t k;
    over.rotation[4] = over.rotation[8] = -1;
    for (k = 0; k < LENGTH(kinds); k++) {
        int32_t body, joint;
        char text[80];
        pdn_model *model = body_on(&body);
        CHECK_STATUS(
            pdn_model_add_joint(model, kinds[k], PDN_GROUND, body, &in.frame, &over, &joint),
            PDN_OK);
        if (kinds[k] == PDN_JOINT_REVOLUTE || kinds[k] == PDN_JOINT_CYLINDRICAL ||
            kinds[k] == PDN_JOINT_PLANAR)
            CHECK_STATUS(pdn_model_add_spring_damper(model, JOINT(0), PDN_ROTATION, 50, 1, 0, NULL),
                         PDN_OK);
        if (kinds[k] == PDN_JOINT_PRISMATIC || kinds[k] == PDN_JOINT_CYLINDRICAL ||
            kinds[k] == PDN_JOINT_PLANAR)
            CHECK_STATUS(
                pdn_model_add_spring_damper(model, JOINT(0), PDN_DISPLACEMENT, 50, 1, 0, NULL),
                PDN_OK);
        if (kinds[k] == PDN_JOINT_PLANAR)
            CHECK_STATUS(
                pdn_model_add_spring_damper(model, JOINT(0), PDN_DISPLACEMENT_2, 50, 1, 0, NULL),
                PDN_OK);
        snprintf(text, sizeof text, "%s has closed turned over", names[k]);
        CHECK(outcome_of(model, text) == PDN_WRONG_ASSEMBLY);
        pdn_model_free(model);
    }
}

/* A spring on a strut whose points meet has no direction. */
static void a_strut_without_length_is_named(void)
{
    const pdn_periodic_options options = on_grid();
    pdn_model *const saved = in.model;
    pdn_signal signal;
    int32_t body, slider, strut;
    in.model = body_on(&body);
    CHECK_STATUS(pdn_model_add_prismatic(in.model, PDN_GROUND, body, in.point, in.axis, &slider),
                 PDN_OK);
    /* From below the body, which is driven down to there. */
    in.end[1] = 0;
    in.end[2] = -0.25;
    CHECK_STATUS(pdn_model_add_strut(in.model, PDN_GROUND, body, in.end, in.point, &strut), PDN_OK);
    CHECK_STATUS(pdn_model_add_spring_damper(in.model, strut, PDN_DISPLACEMENT, 1, 0, 0.1, NULL),
                 PDN_OK);
    PDN_INIT(pdn_signal, &signal);
    CHECK_STATUS(pdn_signal_set_constant(&signal, -0.25), PDN_OK);
    CHECK_STATUS(pdn_model_prescribe(in.model, slider, PDN_DISPLACEMENT, &signal, NULL), PDN_OK);
    summarise(&expected);
    {
        pdn_solution *solution = NULL;
        const pdn_status status = pdn_solve_periodic(in.model, PERIOD, &options, &solution);
        /* Whether it is hit exactly is a matter of rounding: there is no solution either way. */
        if (status == PDN_OK) {
            CHECK(pdn_solution_outcome(solution) != PDN_CONVERGED);
            pdn_solution_free(solution);
        } else {
            CHECK_MESSAGE("force 0: the points of its strut coincide");
        }
    }
    pdn_model_free(in.model);
    in.model = saved;
    summarise(&expected);
}

int main(void)
{
    set_up();
    joints();
    drives_that_do_not_repeat_are_named();
    a_locked_mechanism_is_named();
    a_joint_turned_over_is_named();
    a_strut_without_length_is_named();
    /* The tables above were gone through. */
    CHECK(refusals >= 280);
    CHECK_STATUS(
        pdn_model_add_screw(in.model, in.node, in.other, in.point, in.axis, in.pitch, &out.id),
        PDN_OK);
    pdn_model_free(in.model);
    printf("%d refusals\n", refusals);
    return 0;
}
