/* A frame that turns steadily: the net rotation of a spherical pendulum, what can be read, and
 * calls that must be refused. */
#include "near.h"

enum { POINTS = 41 };

static struct {
    pdn_model *model;
    pdn_conditions *conditions;
    double axis[3], rate, point[3];
} in;
static struct {
    double axis[3], rate, point[3];
} out;

static int model_changed(void)
{
    double axis[3], rate, point[3];
    CHECK_STATUS(pdn_model_turning_frame(in.model, axis, &rate, point), PDN_OK);
    return rate != 3.3 || axis[0] != 0 || axis[1] != 0 || axis[2] != 1 || point[0] != 0;
}

#include "refusal.h"

/* Parameters: the rate of the frame, and what would change energy and angular momentum. */
static pdn_model *pendulum(int32_t *bob, int32_t *level, int32_t parameters[3])
{
    static const char *const names[3] = {"rate", "damping", "moment"};
    const double origin[3] = {0}, centre[3] = {0, 0, -1}, none[9] = {0};
    const double up[3] = {0, 0, 1}, twice_up[3] = {0, 0, 2}, across[3] = {0, 1, 0};
    const double gravity[3] = {0, 0, -9.81}, starts[3] = {3.3, 0, 0};
    int32_t cross, upright, moment;
    pdn_signal signal;
    pdn_model *model;
    CHECK_STATUS(pdn_model_new(&model), PDN_OK);
    CHECK_STATUS(pdn_model_add_node(model, origin, NULL, &cross), PDN_OK);
    CHECK_STATUS(pdn_model_add_rigid_body(model, 1, centre, none, bob), PDN_OK);
    CHECK_STATUS(pdn_model_add_revolute(model, PDN_GROUND, cross, origin, up, &upright), PDN_OK);
    CHECK_STATUS(pdn_model_add_revolute(model, cross, *bob, origin, across, level), PDN_OK);
    CHECK_STATUS(pdn_model_set_gravity(model, gravity), PDN_OK);
    PDN_INIT(pdn_signal, &signal);
    CHECK_STATUS(pdn_model_add_actuator(model, upright, PDN_ROTATION, &signal, &moment), PDN_OK);
    CHECK_STATUS(pdn_model_set_turning_frame(model, twice_up, 3.3, NULL), PDN_OK);
    for (int i = 0; i < 3; ++i)
        CHECK_STATUS(pdn_model_add_parameter(model, names[i], starts[i], 1, &parameters[i]),
                     PDN_OK);
    CHECK_STATUS(pdn_model_move_number(model, parameters[0], PDN_NUMBER_FRAME_RATE, 0, 0, 1),
                 PDN_OK);
    CHECK_STATUS(pdn_model_move_number(model, parameters[1], PDN_NUMBER_MASS_DAMPING, 0, 0, 1),
                 PDN_OK);
    CHECK_STATUS(pdn_model_move_signal(model, parameters[2], moment, 0, PDN_PART_MEAN, 1), PDN_OK);
    return model;
}

/* Released at 45 degrees with a horizontal speed of 1.5: that is given, or the angular momentum. */
static void a_pendulum_finds_its_net_rotation(int by_momentum)
{
    static double positions[2 * POINTS][3], rotations[2 * POINTS][9];
    const double up[3] = {0, 0, 1}, angle = PI / 4;
    int32_t bob, level, parameters[3];
    double frequency, rate, rest;
    pdn_conditions *conditions;
    pdn_quantity speed;
    pdn_solution *solution;
    pdn_model *model = pendulum(&bob, &level, parameters);
    CHECK_STATUS(pdn_conditions_new(&conditions), PDN_OK);
    CHECK_STATUS(pdn_conditions_release(conditions, PDN_FREQUENCY), PDN_OK);
    for (int i = 0; i < 3; ++i)
        CHECK_STATUS(pdn_conditions_release(conditions, parameters[i]), PDN_OK);
    PDN_INIT(pdn_quantity, &speed);
    speed.kind = PDN_NODE_VELOCITY;
    speed.object = bob;
    speed.component = 1;
    CHECK_STATUS(pdn_conditions_add_phase(conditions), PDN_OK);
    CHECK_STATUS(pdn_conditions_add_rotation_phase(conditions, up, NULL), PDN_OK);
    CHECK_STATUS(pdn_conditions_add_joint_coordinate(conditions, level, PDN_ROTATION, angle),
                 PDN_OK);
    if (by_momentum)
        CHECK_STATUS(pdn_conditions_add_angular_momentum(conditions, up, NULL, 1.5 * sin(angle)),
                     PDN_OK);
    else
        CHECK_STATUS(pdn_conditions_add_quantity(conditions, &speed, PDN_FEATURE_VALUE, 0, -1.5, 0),
                     PDN_OK);
    for (int k = 0; k < POINTS; ++k) {
        const double phase = 2 * PI * k / POINTS, p = -0.28 * sin(phase);
        const double q = 0.61 + 0.17 * cos(phase);
        const double about[9] = {cos(p), sin(p), 0, -sin(p), cos(p), 0, 0, 0, 1};
        const double turned[9] = {cos(p) * cos(q), sin(p) * cos(q), -sin(q), -sin(p), cos(p), 0,
                                  cos(p) * sin(q), sin(p) * sin(q), cos(q)};
        memcpy(rotations[k], about, sizeof about);
        memcpy(rotations[POINTS + k], turned, sizeof turned);
        for (int i = 0; i < 3; ++i)
            positions[POINTS + k][i] = -turned[6 + i];
    }
    pdn_periodic_options options;
    PDN_INIT(pdn_periodic_options, &options);
    options.grid_points = POINTS;
    options.guess_positions = positions[0];
    options.guess_rotations = rotations[0];
    CHECK_STATUS(pdn_solve_conditioned(model, 1.05, conditions, &options, &solution), PDN_OK);
    CHECK(pdn_solution_outcome(solution) == PDN_CONVERGED);
    CHECK_STATUS(pdn_solution_parameter(solution, PDN_FREQUENCY, &frequency), PDN_OK);
    CHECK_STATUS(pdn_solution_parameter(solution, parameters[0], &rate), PDN_OK);
    /* By quadrature. */
    CHECK_NEAR(2 * PI / frequency, 1.0512581114967, 2e-11);
    CHECK_NEAR(2 * PI / frequency * rate, 3.5928572620105, 2e-11);
    for (int i = 1; i < 3; ++i) {
        CHECK_STATUS(pdn_solution_parameter(solution, parameters[i], &rest), PDN_OK);
        CHECK_NEAR(rest, 0, 1e-10);
    }
    pdn_solution_free(solution);
    pdn_conditions_free(conditions);
    pdn_model_free(model);
}

/* A mass that a constant force pushes and damping by its momentum holds back drifts at the speed
 * where both are the same. */
static void a_mass_finds_its_drift(void)
{
    const double along[3] = {0, 2, 0}, origin[3] = {0}, none[9] = {0}, positions[9] = {0};
    const double rotations[27] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 0, 0, 1,
                                  0, 0, 0, 1, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    pdn_conditions *conditions;
    pdn_periodic_options options;
    pdn_solution *solution;
    pdn_signal push;
    pdn_model *model;
    int32_t mass, slide, speed;
    double found;
    CHECK_STATUS(pdn_model_new(&model), PDN_OK);
    CHECK_STATUS(pdn_model_add_rigid_body(model, 2, origin, none, &mass), PDN_OK);
    CHECK_STATUS(pdn_model_add_prismatic(model, PDN_GROUND, mass, origin, along, &slide), PDN_OK);
    PDN_INIT(pdn_signal, &push);
    push.mean = 3;
    CHECK_STATUS(pdn_model_add_load(model, mass, PDN_FRAME_SPACE, PDN_FORCE_2, &push, NULL),
                 PDN_OK);
    CHECK_STATUS(pdn_model_set_mass_damping(model, 0.5), PDN_OK);
    CHECK_STATUS(pdn_model_set_turning_frame(model, along, 0, NULL), PDN_OK);
    CHECK_STATUS(pdn_model_set_frame_advance(model, 0.25), PDN_OK);
    CHECK_STATUS(pdn_model_frame_advance(model, &found), PDN_OK);
    CHECK(found == 0.25);
    CHECK_STATUS(pdn_model_add_parameter(model, "drift", 0.1, 1, &speed), PDN_OK);
    CHECK_STATUS(pdn_model_move_number(model, speed, PDN_NUMBER_FRAME_ADVANCE, 0, 0, 1), PDN_OK);
    CHECK_STATUS(pdn_conditions_new(&conditions), PDN_OK);
    CHECK_STATUS(pdn_conditions_release(conditions, speed), PDN_OK);
    CHECK_STATUS(pdn_conditions_add_translation_phase(conditions, along), PDN_OK);
    PDN_INIT(pdn_periodic_options, &options);
    options.grid_points = 3;
    options.guess_positions = positions;
    options.guess_rotations = rotations;
    CHECK_STATUS(pdn_solve_conditioned(model, 1, conditions, &options, &solution), PDN_OK);
    CHECK(pdn_solution_outcome(solution) == PDN_CONVERGED);
    CHECK_STATUS(pdn_solution_parameter(solution, speed, &found), PDN_OK);
    CHECK_NEAR(found, 3, 1e-12);
    pdn_solution_free(solution);
    pdn_conditions_free(conditions);
    pdn_model_free(model);
}

static void begin(void)
{
    int32_t bob, level, parameters[3];
    in.model = pendulum(&bob, &level, parameters);
    CHECK_STATUS(pdn_conditions_new(&in.conditions), PDN_OK);
    in.axis[1] = 1;
    in.rate = 2;
}

static void bad_frames_are_refused(void)
{
    const double axis[3] = {0};
#define CALL pdn_model_set_turning_frame(in.model, in.axis, in.rate, in.point)
    REFUSED(pdn_model_set_turning_frame(NULL, in.axis, 1, NULL), PDN_ERR_NULL, "model: ");
    REFUSED(pdn_model_set_turning_frame(in.model, NULL, 1, NULL), PDN_ERR_NULL, "axis: ");
    REFUSED(pdn_model_set_turning_frame(in.model, axis, 1, NULL), PDN_ERR_VALUE, "axis: ");
    REFUSES_NOT_FINITE_ENTRIES(in.axis, 3, CALL, "axis");
    REFUSES_NOT_FINITE_ENTRIES(in.point, 3, CALL, "point");
    REFUSES_NOT_FINITE(in.rate, CALL, "rate");
#undef CALL
#define CALL pdn_model_turning_frame
    REFUSED(CALL(NULL, out.axis, &out.rate, out.point), PDN_ERR_NULL, "model: ");
    REFUSED(CALL(in.model, NULL, &out.rate, out.point), PDN_ERR_NULL, "axis: ");
    REFUSED(CALL(in.model, out.axis, NULL, out.point), PDN_ERR_NULL, "rate: ");
    REFUSED(CALL(in.model, out.axis, &out.rate, NULL), PDN_ERR_NULL, "point: ");
#undef CALL
    pdn_model *model;
#define CALL pdn_model_set_frame_advance(in.model, in.rate)
    REFUSED(pdn_model_set_frame_advance(NULL, 1), PDN_ERR_NULL, "model: ");
    REFUSES_NOT_FINITE(in.rate, CALL, "speed");
#undef CALL
    REFUSED(pdn_model_frame_advance(NULL, &out.rate), PDN_ERR_NULL, "model: ");
    REFUSED(pdn_model_frame_advance(in.model, NULL), PDN_ERR_NULL, "speed: ");
    CHECK_STATUS(pdn_model_new(&model), PDN_OK);
    REFUSED(pdn_model_set_frame_advance(model, 1), PDN_ERR_NOT_AVAILABLE, "model: expected one");
    REFUSED(pdn_model_frame_advance(model, &out.rate), PDN_ERR_NOT_AVAILABLE,
            "model: it is described in the inertial frame");
    REFUSED(pdn_model_turning_frame(model, out.axis, &out.rate, out.point), PDN_ERR_NOT_AVAILABLE,
            "model: it is described in the inertial frame");
    pdn_model_free(model);
}

static void bad_phases_are_refused(void)
{
    const double zero[3] = {0};
#define CALL pdn_conditions_add_rotation_phase
    REFUSED(CALL(NULL, in.axis, NULL), PDN_ERR_NULL, "conditions: ");
    REFUSED(CALL(in.conditions, NULL, NULL), PDN_ERR_NULL, "axis: ");
    REFUSED(CALL(in.conditions, zero, NULL), PDN_ERR_VALUE, "axis: ");
    REFUSES_NOT_FINITE_ENTRIES(in.axis, 3, CALL(in.conditions, in.axis, in.point), "axis");
    REFUSES_NOT_FINITE_ENTRIES(in.point, 3, CALL(in.conditions, in.axis, in.point), "point");
#undef CALL
#define CALL pdn_conditions_add_translation_phase
    REFUSED(CALL(NULL, in.axis), PDN_ERR_NULL, "conditions: ");
    REFUSED(CALL(in.conditions, NULL), PDN_ERR_NULL, "direction: ");
    REFUSED(CALL(in.conditions, zero), PDN_ERR_VALUE, "direction: ");
    REFUSES_NOT_FINITE_ENTRIES(in.axis, 3, CALL(in.conditions, in.axis), "direction");
#undef CALL
}

static void bad_momenta_are_refused(void)
{
    const double zero[3] = {0};
#define CALL pdn_conditions_add_momentum
    REFUSED(CALL(NULL, in.axis, 1), PDN_ERR_NULL, "conditions: ");
    REFUSED(CALL(in.conditions, NULL, 1), PDN_ERR_NULL, "direction: ");
    REFUSED(CALL(in.conditions, zero, 1), PDN_ERR_VALUE, "direction: ");
    REFUSES_NOT_FINITE_ENTRIES(in.axis, 3, CALL(in.conditions, in.axis, 1), "direction");
    REFUSES_NOT_FINITE(in.rate, CALL(in.conditions, in.axis, in.rate), "momentum");
#undef CALL
#define CALL pdn_conditions_add_angular_momentum
    REFUSED(CALL(NULL, in.axis, NULL, 1), PDN_ERR_NULL, "conditions: ");
    REFUSED(CALL(in.conditions, NULL, NULL, 1), PDN_ERR_NULL, "axis: ");
    REFUSED(CALL(in.conditions, zero, NULL, 1), PDN_ERR_VALUE, "axis: ");
    REFUSES_NOT_FINITE_ENTRIES(in.axis, 3, CALL(in.conditions, in.axis, in.point, 1), "axis");
    REFUSES_NOT_FINITE_ENTRIES(in.point, 3, CALL(in.conditions, in.axis, in.point, 1), "point");
    REFUSES_NOT_FINITE(in.rate, CALL(in.conditions, in.axis, in.point, in.rate), "momentum");
#undef CALL
}

int main(void)
{
    a_pendulum_finds_its_net_rotation(0);
    a_pendulum_finds_its_net_rotation(1);
    a_mass_finds_its_drift();
    begin();
    bad_frames_are_refused();
    bad_phases_are_refused();
    bad_momenta_are_refused();
    pdn_conditions_free(in.conditions);
    pdn_model_free(in.model);
    printf("%d calls refused\n", refusals);
    return 0;
}
