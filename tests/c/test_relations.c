/* Linear relations between joint coordinates, and bushings: against closed forms, what can be read
 * of them, and calls that must be refused. */
#include "near.h"

enum { POINTS = 31, TIMES = 6 };

static const double OMEGA = 2.2, PERIOD = 2 * PI / 2.2;
static const double times[TIMES] = {-1.0, 0.0, 0.37, 1.1, 2.5, 9.3};

static struct {
    pdn_model *model;
    int32_t joints[3], coordinates[3], first, second, angles;
    double coefficients[3], stiffness[36], damping[36];
    size_t count;
    pdn_frame frame;
} in;
static struct {
    int32_t id;
} out;

static int model_changed(void)
{
    int32_t relations, forces;
    CHECK_STATUS(pdn_model_relation_count(in.model, &relations), PDN_OK);
    CHECK_STATUS(pdn_model_force_count(in.model, &forces), PDN_OK);
    return relations != 1 || forces != 1;
}

#include "refusal.h"

/* A wheel on a revolute joint about z; the joint. */
static int32_t wheel(pdn_model *model, double x, double inertia)
{
    const double centre[3] = {x, 0, 0}, axis[3] = {0, 0, 1};
    double moments[9] = {0};
    int32_t body, joint;
    moments[0] = moments[4] = moments[8] = inertia;
    CHECK_STATUS(pdn_model_add_rigid_body(model, 1.0, centre, moments, &body), PDN_OK);
    CHECK_STATUS(pdn_model_add_revolute(model, PDN_GROUND, body, centre, axis, &joint), PDN_OK);
    return joint;
}

static pdn_solution *solve(const pdn_model *model, double period)
{
    pdn_periodic_options options;
    pdn_solution *solution;
    PDN_INIT(pdn_periodic_options, &options);
    options.grid_points = POINTS;
    CHECK_STATUS(pdn_solve_periodic(model, period, &options, &solution), PDN_OK);
    CHECK(pdn_solution_outcome(solution) == PDN_CONVERGED);
    return solution;
}

/* Two geared wheels, the first on a spring: one inertia. */
static void geared_wheels_are_one_inertia(void)
{
    const double inertias[2] = {0.4, 0.15}, stiffness = 3, moment = 1.7, ratio = -2.5;
    const double joined = inertias[0] + ratio * ratio * inertias[1];
    const double amplitude = moment / (stiffness - OMEGA * OMEGA * joined);
    const double coefficients[2] = {ratio, -1}, cosines[1] = {1.7}, sines[1] = {0};
    const int32_t coordinates[2] = {PDN_ROTATION, PDN_ROTATION};
    double angle[TIMES], effort[TIMES];
    int32_t joints[2], relation, count;
    pdn_signal signal;
    pdn_quantity quantity;
    pdn_model *model;
    pdn_solution *solution;
    int i, k;
    CHECK_STATUS(pdn_model_new(&model), PDN_OK);
    for (i = 0; i < 2; i++)
        joints[i] = wheel(model, i, inertias[i]);
    CHECK_STATUS(pdn_model_add_spring_damper(model, joints[0], PDN_ROTATION, stiffness, 0, 0, NULL),
                 PDN_OK);
    PDN_INIT(pdn_signal, &signal);
    CHECK_STATUS(pdn_signal_set_harmonics(&signal, 0, 0, cosines, sines, 1), PDN_OK);
    CHECK_STATUS(pdn_model_add_actuator(model, joints[0], PDN_ROTATION, &signal, NULL), PDN_OK);
    CHECK_STATUS(
        pdn_model_add_relation(model, joints, coordinates, coefficients, 2, NULL, &relation),
        PDN_OK);
    CHECK_STATUS(pdn_model_relation_count(model, &count), PDN_OK);
    CHECK(relation == RELATION(0) && count == 1);
    solution = solve(model, PERIOD);
    PDN_INIT(pdn_quantity, &quantity);
    for (k = 0; k < 2; k++) {
        const double size = k == 0 ? amplitude : ratio * amplitude;
        const double second = -OMEGA * OMEGA * inertias[1] * ratio * amplitude;
        CHECK_STATUS(pdn_solution_sample(
                         solution, PDN_QUANTITY(PDN_JOINT_COORDINATE, joints[k], PDN_ROTATION),
                         times, TIMES, angle),
                     PDN_OK);
        quantity.kind = PDN_RELATION_EFFORT;
        quantity.object = relation;
        quantity.component = k;
        CHECK(pdn_quantity_components(&quantity) == 1);
        CHECK_STATUS(pdn_solution_sample(solution, &quantity, times, TIMES, effort), PDN_OK);
        for (i = 0; i < TIMES; i++) {
            const double c = cos(OMEGA * times[i]);
            CHECK_NEAR(angle[i], size * c, 1e-8);
            CHECK_NEAR(effort[i], (k == 0 ? -ratio : 1) * second * c, 1e-8);
        }
    }
    quantity.component = 2;
    CHECK_STATUS(pdn_solution_sample(solution, &quantity, times, TIMES, effort), PDN_ERR_VALUE);
    quantity.component = PDN_ALL_COMPONENTS;
    CHECK(pdn_quantity_components(&quantity) < 0);
    quantity.component = 0;
    quantity.object = RELATION(1);
    CHECK_STATUS(pdn_solution_sample(solution, &quantity, times, TIMES, effort), PDN_ERR_ID);
    pdn_solution_free(solution);
    pdn_model_free(model);
}

/* A relation's signal, and a parameter that moves it: the pinion of a drive that is shifted. */
static void a_signal_shifts_what_is_geared(void)
{
    const double coefficients[2] = {2, -1}, cosines[1] = {0.3}, sines[1] = {0};
    const int32_t coordinates[2] = {PDN_ROTATION, PDN_ROTATION};
    double angle[TIMES];
    int32_t joints[2], relation, parameter;
    pdn_signal signal;
    pdn_model *model;
    pdn_solution *solution;
    char message[256];
    int i;
    CHECK_STATUS(pdn_model_new(&model), PDN_OK);
    for (i = 0; i < 2; i++)
        joints[i] = wheel(model, i, 0.3);
    PDN_INIT(pdn_signal, &signal);
    CHECK_STATUS(pdn_signal_set_harmonics(&signal, 0, OMEGA, NULL, NULL, 0), PDN_OK);
    CHECK_STATUS(pdn_model_prescribe(model, joints[0], PDN_ROTATION, &signal, NULL), PDN_OK);
    CHECK_STATUS(pdn_signal_set_harmonics(&signal, 0.1, 0, cosines, sines, 1), PDN_OK);
    CHECK_STATUS(
        pdn_model_add_relation(model, joints, coordinates, coefficients, 2, &signal, &relation),
        PDN_OK);
    CHECK_STATUS(pdn_model_add_parameter(model, "shift", 2.0, 1.0, &parameter), PDN_OK);
    CHECK_STATUS(pdn_model_move_signal(model, parameter, relation, 0, PDN_PART_AMPLITUDE, 1.0),
                 PDN_OK);
    solution = solve(model, PERIOD);
    CHECK_STATUS(pdn_solution_sample(solution,
                                     PDN_QUANTITY(PDN_JOINT_COORDINATE, joints[1], PDN_ROTATION),
                                     times, TIMES, angle),
                 PDN_OK);
    for (i = 0; i < TIMES; i++)
        CHECK_NEAR(angle[i], 2 * OMEGA * times[i] - 0.1 - 0.6 * cos(OMEGA * times[i]), 1e-10);
    pdn_solution_free(solution);
    /* In half the time the drive turns by half a turn, which nothing can do for ever. */
    CHECK_STATUS(pdn_solve_periodic(model, PERIOD / 2, NULL, &solution), PDN_ERR_NOT_PERIODIC);
    pdn_model_free(model);

    CHECK_STATUS(pdn_model_new(&model), PDN_OK);
    for (i = 0; i < 2; i++)
        joints[i] = wheel(model, i, 0.3);
    CHECK_STATUS(pdn_signal_set_harmonics(&signal, 0, OMEGA, NULL, NULL, 0), PDN_OK);
    CHECK_STATUS(pdn_model_prescribe(model, joints[1], PDN_ROTATION, &signal, NULL), PDN_OK);
    CHECK_STATUS(pdn_model_add_relation(model, joints, coordinates, coefficients, 2, NULL, NULL),
                 PDN_OK);
    CHECK_STATUS(pdn_solve_periodic(model, PERIOD, NULL, &solution), PDN_ERR_NOT_PERIODIC);
    pdn_last_error(message, sizeof message);
    CHECK(strstr(message, "gains 0.500000000 turns in a period, not a whole number; a period 2 "
                          "times as long") != NULL);
    solution = solve(model, 2 * PERIOD);
    pdn_solution_free(solution);
    pdn_model_free(model);
}

/* A rotor on a journal bearing that is turned by its unbalance: an orbit of known size. */
static void a_bearing_carries_a_rotor(void)
{
    const double mass = 2, offset = 0.04, k = 50, c = 3, spin = 6.3, q = 0.5 * 6.3 * 3;
    const double centre[3] = {0.04, 0, 0}, moments[9] = {0.3, 0, 0, 0, 0.3, 0, 0, 0, 0.5};
    const pdn_frame frame = {{0, 0, 0}, {1, 0, 0, 0, 1, 0, 0, 0, 1}};
    const double a = k - mass * spin * spin, b = c * spin - q;
    const double size = mass * spin * spin * offset / (a * a + b * b);
    double stiffness[36] = {0}, damping[36] = {0}, position[2][TIMES], efforts[6 * TIMES];
    int32_t body, shaft, bearing, i;
    pdn_signal signal;
    pdn_quantity quantity;
    pdn_model *model;
    pdn_solution *solution;
    stiffness[0] = stiffness[7] = k;
    stiffness[6] = q; /* force along x for a displacement along y */
    stiffness[1] = -q;
    stiffness[21] = stiffness[28] = 40;
    damping[0] = damping[7] = c;
    damping[21] = damping[28] = 9;
    damping[35] = 0.7;
    CHECK_STATUS(pdn_model_new(&model), PDN_OK);
    CHECK_STATUS(pdn_model_add_rigid_body(model, mass, centre, moments, &body), PDN_OK);
    CHECK_STATUS(pdn_model_add_bushing(model, PDN_GROUND, body, &frame, &frame, stiffness, damping,
                                       PDN_ANGLES_TILT_AND_SPIN, &bearing),
                 PDN_OK);
    CHECK_STATUS(
        pdn_model_add_joint(model, PDN_JOINT_FREE, PDN_GROUND, body, &frame, &frame, &shaft),
        PDN_OK);
    PDN_INIT(pdn_signal, &signal);
    CHECK_STATUS(pdn_model_prescribe(model, shaft, PDN_DISPLACEMENT_3, &signal, NULL), PDN_OK);
    CHECK_STATUS(pdn_signal_set_harmonics(&signal, 0, spin, NULL, NULL, 0), PDN_OK);
    CHECK_STATUS(pdn_model_prescribe(model, shaft, PDN_ROTATION_3, &signal, NULL), PDN_OK);
    solution = solve(model, 2 * PI / spin);
    for (i = 0; i < 2; i++)
        CHECK_STATUS(pdn_solution_sample(
                         solution, PDN_QUANTITY(PDN_JOINT_COORDINATE, shaft, PDN_DISPLACEMENT + i),
                         times, TIMES, position[i]),
                     PDN_OK);
    PDN_INIT(pdn_quantity, &quantity);
    quantity.kind = PDN_FORCE_BUSHING_EFFORTS;
    quantity.object = bearing;
    CHECK(pdn_quantity_components(&quantity) == 6);
    CHECK_STATUS(pdn_solution_sample(solution, &quantity, times, TIMES, efforts), PDN_OK);
    for (i = 0; i < TIMES; i++) {
        const double p = spin * times[i], x = size * (a * cos(p) + b * sin(p));
        const double y = size * (a * sin(p) - b * cos(p));
        const double *const f = efforts + 6 * i;
        CHECK_NEAR(position[0][i], x, 1e-11);
        CHECK_NEAR(position[1][i], y, 1e-11);
        CHECK_NEAR(f[0], k * x + q * y - c * spin * y, 1e-9);
        CHECK_NEAR(f[1], k * y - q * x + c * spin * x, 1e-9);
        CHECK_NEAR(f[5], 0.7 * spin, 1e-9);
    }
    pdn_solution_free(solution);
    pdn_model_free(model);
}

static const int32_t bad_joints[] = {-1, NO_IDS};
static const int32_t bad_bodies[] = {NO_IDS};

static void relations_are_refused(void)
{
    pdn_signal wrong;
    PDN_INIT(pdn_signal, &wrong);
    wrong.kind = 77;
#define WITH(model, joints, coordinates, coefficients, signal)                                     \
    pdn_model_add_relation(model, joints, coordinates, coefficients, in.count, signal, &out.id)
#define CALL WITH(in.model, in.joints, in.coordinates, in.coefficients, NULL)
    REFUSED(WITH(NULL, in.joints, in.coordinates, in.coefficients, NULL), PDN_ERR_NULL, "model");
    REFUSED(WITH(in.model, NULL, in.coordinates, in.coefficients, NULL), PDN_ERR_NULL, "joints");
    REFUSED(WITH(in.model, in.joints, NULL, in.coefficients, NULL), PDN_ERR_NULL, "coordinates");
    REFUSED(WITH(in.model, in.joints, in.coordinates, NULL, NULL), PDN_ERR_NULL, "coefficients");
    REFUSES_EACH(in.joints[1], int32_t, bad_joints, CALL, PDN_ERR_ID,
                 "joints[1]: expected a joint");
    REFUSES_EACH(in.coordinates[1], int32_t, bad_enums, CALL, PDN_ERR_VALUE, "coordinates[1]: ");
    REFUSES_NOT_FINITE_ENTRIES(in.coefficients, 2, CALL, "coefficients");
    in.coefficients[1] = 0;
    REFUSED(CALL, PDN_ERR_VALUE, "coefficients[1]: expected a number other than zero");
    in.coefficients[1] = -3;
    in.coordinates[0] = PDN_DISPLACEMENT;
    REFUSED(CALL, PDN_ERR_NOT_AVAILABLE, "term 0");
    in.coordinates[0] = PDN_ROTATION;
    in.joints[1] = JOINT(0);
    REFUSED(CALL, PDN_ERR_VALUE, "coordinates: expected each at most once");
    in.joints[1] = JOINT(1);
    in.count = 1;
    REFUSED(CALL, PDN_ERR_SIZE, "count: expected at least 2 coordinates, got 1");
    in.count = 0;
    REFUSED(CALL, PDN_ERR_SIZE, "count: expected at least 2 coordinates, got 0");
    in.count = (size_t)-1;
    REFUSED(CALL, PDN_ERR_SIZE, "");
    in.count = 2;
    REFUSED(WITH(in.model, in.joints, in.coordinates, in.coefficients, &wrong), PDN_ERR_VALUE,
            "signal");
#undef CALL
#undef WITH
    REFUSED(pdn_model_relation_count(NULL, &out.id), PDN_ERR_NULL, "model");
    REFUSED(pdn_model_relation_count(in.model, NULL), PDN_ERR_NULL, "count");
}

static void bushings_are_refused(void)
{
#define WITH(model, one, two, k, c)                                                                \
    pdn_model_add_bushing(model, in.first, in.second, one, two, k, c, in.angles, &out.id)
#define CALL WITH(in.model, &in.frame, &in.frame, in.stiffness, in.damping)
    REFUSED(WITH(NULL, &in.frame, &in.frame, in.stiffness, in.damping), PDN_ERR_NULL, "model");
    REFUSED(WITH(in.model, NULL, &in.frame, in.stiffness, in.damping), PDN_ERR_NULL, "first_frame");
    REFUSED(WITH(in.model, &in.frame, NULL, in.stiffness, in.damping), PDN_ERR_NULL,
            "second_frame");
    REFUSED(WITH(in.model, &in.frame, &in.frame, NULL, in.damping), PDN_ERR_NULL, "stiffness");
    REFUSED(WITH(in.model, &in.frame, &in.frame, in.stiffness, NULL), PDN_ERR_NULL, "damping");
    REFUSES_EACH(in.first, int32_t, bad_bodies, CALL, PDN_ERR_ID, "first");
    REFUSES_EACH(in.second, int32_t, bad_bodies, CALL, PDN_ERR_ID, "second");
    in.second = in.first;
    REFUSED(CALL, PDN_ERR_VALUE, "first, second: expected two different bodies");
    in.second = NODE(1);
    REFUSES_EACH(in.angles, int32_t, bad_enums, CALL, PDN_ERR_VALUE, "angles: expected PDN_ANGLES");
    REFUSES_NOT_FINITE_ENTRIES(in.stiffness, 36, CALL, "stiffness");
    REFUSES_NOT_FINITE_ENTRIES(in.damping, 36, CALL, "damping");
    REFUSES_NOT_FINITE_ENTRIES(in.frame.position, 3, CALL, "first_frame position");
    in.angles = PDN_ANGLES_TILT_AND_SPIN;
    in.stiffness[33] = 1;
    REFUSED(CALL, PDN_ERR_VALUE, "stiffness: expected zeros in the last column");
    in.stiffness[33] = 0;
#undef CALL
#undef WITH
}

int main(void)
{
    const pdn_frame frame = {{0, 0, 0}, {1, 0, 0, 0, 1, 0, 0, 0, 1}};
    int i;
    geared_wheels_are_one_inertia();
    a_signal_shifts_what_is_geared();
    a_bearing_carries_a_rotor();

    CHECK_STATUS(pdn_model_new(&in.model), PDN_OK);
    for (i = 0; i < 2; i++) {
        in.joints[i] = wheel(in.model, i, 0.3);
        in.coordinates[i] = PDN_ROTATION;
        in.coefficients[i] = 1 - 4 * i;
    }
    in.count = 2;
    in.first = NODE(0);
    in.second = NODE(1);
    in.frame = frame;
    in.angles = PDN_ANGLES_ROTATION_VECTOR;
    in.stiffness[0] = in.damping[0] = 1;
    CHECK_STATUS(pdn_model_add_relation(in.model, in.joints, in.coordinates, in.coefficients,
                                        in.count, NULL, NULL),
                 PDN_OK);
    CHECK_STATUS(pdn_model_add_bushing(in.model, in.first, in.second, &in.frame, &in.frame,
                                       in.stiffness, in.damping, in.angles, NULL),
                 PDN_OK);
    relations_are_refused();
    bushings_are_refused();
    pdn_model_free(in.model);
    printf("%d calls refused\n", refusals);
    return 0;
}
