/* Every quantity of a solution against closed forms, against the others, and against its harmonics.
 *
 * One model has it all: a rotor that a motor turns once in a period, a beam without mass that bends
 * under a moment on its end, and a top whose three angles are prescribed. */
#include "check.h"
#include <math.h>

#define PI 3.14159265358979323846

/* The period, and the frequency that belongs to it. */
#define PERIOD 2.5
#define OMEGA (2 * PI / PERIOD)

enum { POINTS = 17, HARMONICS = 8, TIMES = 9 };

/* The model. */
static const double ORIGIN[3] = {0, 0, 0};

/* Rotor: turns about global axis 3 by turn(t), its hinge at ORIGIN, its centre at an arm from
 * there. */
static const double ARM = 0.4, ROTOR_MASS = 3.0, SWING = 0.2;
static const double ROTOR_INERTIA[9] = {0.2, 0, 0, 0, 0.25, 0, 0, 0, 0.3};

/* Beam along global axis 1 from ORIGIN: moment MOMENT cos wt about axis 3 of its end. */
static const double LENGTH = 2.0, MOMENT = 2.0, DELAY = 0.15; /* damping = DELAY * stiffness */
static const double STIFFNESS[6] = {1e7, 4e6, 4e6, 5e3, 8e3, 6e3};

/* Top: a body that turns about its centre, at TOP. */
static const double TOP[3] = {0.5, -0.25, 1.5}, TOP_MASS = 1.5;
static const double TOP_INERTIA[9] = {0.1, 0.02, 0, 0.02, 0.2, 0, 0, 0, 0.15};
static const double TOP_SWING[3] = {0.1, -0.05, 0.02};
static const double GRAVITY = 9.81;

static int32_t rotor, top, motor, clamp, ball;
static pdn_beam beam;
static pdn_model *model;
static pdn_solution *solution;

/* Times before, inside and after the period: a grid point and others. */
static const double times[TIMES] = {-2.3 * PERIOD,  -0.31 * PERIOD,      0.0,
                                    0.123 * PERIOD, 3 * PERIOD / POINTS, 0.5 * PERIOD,
                                    0.9 * PERIOD,   1.77 * PERIOD,       12.4 * PERIOD};

static double turn(double t)
{
    return OMEGA * t + SWING * sin(OMEGA * t);
}

static double turn_rate(double t)
{
    return OMEGA * (1 + SWING * cos(OMEGA * t));
}

static double turn_acceleration(double t)
{
    return -OMEGA * OMEGA * SWING * sin(OMEGA * t);
}

/* Angle number i of the top: harmonic i + 1. */
static double top_angle(int i, double t)
{
    return TOP_SWING[i] * sin((i + 1) * OMEGA * t);
}

/* Axes of the rotor's joint in the reference configuration: axis 3 is global axis 3. */
static void joint_axes(double axes[9])
{
    const double c = cos(0.7), s = sin(0.7);
    const double columns[9] = {c, s, 0, -s, c, 0, 0, 0, 1};
    memcpy(axes, columns, sizeof columns);
}

static void build(void)
{
    const double centre[3] = {ARM, 0, 0}, end[3] = {LENGTH, 0, 0}, axis_2[3] = {0, 1, 0};
    const double gravity[3] = {0, 0, -GRAVITY}, no_mass[4] = {0, 0, 0, 0};
    static const double zeros[3] = {0, 0, 0};
    double one[3] = {0, 0, 0};
    int i;
    pdn_frame frame;
    pdn_section section;
    pdn_signal signal;

    PDN_INIT(pdn_signal, &signal);
    CHECK_STATUS(pdn_model_new(&model), PDN_OK);
    CHECK_STATUS(pdn_model_set_gravity(model, gravity), PDN_OK);

    CHECK_STATUS(pdn_model_add_rigid_body(model, ROTOR_MASS, centre, ROTOR_INERTIA, &rotor),
                 PDN_OK);
    memcpy(frame.position, ORIGIN, sizeof ORIGIN);
    joint_axes(frame.rotation);
    CHECK_STATUS(
        pdn_model_add_joint(model, PDN_JOINT_REVOLUTE, PDN_GROUND, rotor, &frame, &frame, &motor),
        PDN_OK);
    one[0] = SWING;
    CHECK_STATUS(pdn_signal_set_harmonics(&signal, 0, OMEGA, zeros, one, 1), PDN_OK);
    CHECK_STATUS(pdn_model_prescribe(model, motor, PDN_ROTATION, &signal, NULL), PDN_OK);

    PDN_INIT(pdn_section, &section);
    CHECK_STATUS(pdn_section_set_diagonal(&section, STIFFNESS, no_mass), PDN_OK);
    CHECK_STATUS(pdn_section_set_proportional_damping(&section, DELAY), PDN_OK);
    CHECK_STATUS(pdn_model_add_straight_beam(model, ORIGIN, end, axis_2, &section, 2, 1, &beam),
                 PDN_OK);
    CHECK_STATUS(pdn_model_add_rigid_joint(model, PDN_GROUND, beam.first, ORIGIN, &clamp), PDN_OK);
    one[0] = MOMENT;
    CHECK_STATUS(pdn_signal_set_harmonics(&signal, 0, 0, one, zeros, 1), PDN_OK);
    CHECK_STATUS(
        pdn_model_add_load(model, beam.last, PDN_FRAME_MATERIAL, PDN_MOMENT_3, &signal, NULL),
        PDN_OK);

    CHECK_STATUS(pdn_model_add_rigid_body(model, TOP_MASS, TOP, TOP_INERTIA, &top), PDN_OK);
    CHECK_STATUS(pdn_model_add_spherical(model, PDN_GROUND, top, TOP, &ball), PDN_OK);
    for (i = 0; i < 3; i++) {
        memset(one, 0, sizeof one);
        one[i] = TOP_SWING[i];
        CHECK_STATUS(pdn_signal_set_harmonics(&signal, 0, 0, zeros, one, 3), PDN_OK);
        CHECK_STATUS(pdn_model_prescribe(model, ball, PDN_ROTATION + i, &signal, NULL), PDN_OK);
    }
}

static void solve(void)
{
    pdn_periodic_options options;
    PDN_INIT(pdn_periodic_options, &options);
    options.grid_points = POINTS;
    CHECK_STATUS(pdn_solve_periodic(model, PERIOD, &options, &solution), PDN_OK);
    CHECK(pdn_solution_outcome(solution) == PDN_CONVERGED);
}

/* --- Small helpers --- */

static int near(double a, double b, double tolerance)
{
    return fabs(a - b) <= tolerance;
}

#define CHECK_NEAR(a, b, tolerance)                                                                \
    do {                                                                                           \
        const double a_ = (a), b_ = (b);                                                           \
        if (!near(a_, b_, tolerance)) {                                                            \
            fprintf(stderr, "%s:%d: %s = %.15g, %s = %.15g\n", __FILE__, __LINE__, #a, a_, #b,     \
                    b_);                                                                           \
            exit(1);                                                                               \
        }                                                                                          \
    } while (0)

/* to = R v, or to = R^T v; R column by column. */
static void rotate(const double *R, const double *v, double *to)
{
    int i;
    for (i = 0; i < 3; i++)
        to[i] = R[i] * v[0] + R[3 + i] * v[1] + R[6 + i] * v[2];
}

static void rotate_back(const double *R, const double *v, double *to)
{
    int i;
    for (i = 0; i < 3; i++)
        to[i] = R[3 * i] * v[0] + R[3 * i + 1] * v[1] + R[3 * i + 2] * v[2];
}

static void cross(const double *a, const double *b, double *to)
{
    to[0] = a[1] * b[2] - a[2] * b[1];
    to[1] = a[2] * b[0] - a[0] * b[2];
    to[2] = a[0] * b[1] - a[1] * b[0];
}

/* --- Nodes --- */

/* All quantities of a node at some times. */
struct node_samples {
    double position[3 * TIMES], rotation[9 * TIMES], quaternion[4 * TIMES];
    double velocity[6 * TIMES], acceleration[6 * TIMES];
    double material_velocity[6 * TIMES], material_acceleration[6 * TIMES];
};

static void sample_node(int32_t node, const double *at, struct node_samples *to)
{
    const int32_t space = PDN_FRAME_SPACE, material = PDN_FRAME_MATERIAL;
    CHECK_STATUS(pdn_solution_sample(solution,
                                     PDN_QUANTITY(PDN_NODE_POSITION, node, PDN_ALL_COMPONENTS), at,
                                     TIMES, to->position),
                 PDN_OK);
    CHECK_STATUS(pdn_solution_sample(solution,
                                     PDN_QUANTITY(PDN_NODE_ROTATION, node, PDN_ALL_COMPONENTS), at,
                                     TIMES, to->rotation),
                 PDN_OK);
    CHECK_STATUS(pdn_solution_sample(solution,
                                     PDN_QUANTITY(PDN_NODE_QUATERNION, node, PDN_ALL_COMPONENTS),
                                     at, TIMES, to->quaternion),
                 PDN_OK);
    CHECK_STATUS(pdn_solution_sample(
                     solution,
                     PDN_QUANTITY(PDN_NODE_VELOCITY, node, PDN_ALL_COMPONENTS, .frame = space), at,
                     TIMES, to->velocity),
                 PDN_OK);
    CHECK_STATUS(pdn_solution_sample(
                     solution,
                     PDN_QUANTITY(PDN_NODE_ACCELERATION, node, PDN_ALL_COMPONENTS, .frame = space),
                     at, TIMES, to->acceleration),
                 PDN_OK);
    CHECK_STATUS(pdn_solution_sample(
                     solution,
                     PDN_QUANTITY(PDN_NODE_VELOCITY, node, PDN_ALL_COMPONENTS, .frame = material),
                     at, TIMES, to->material_velocity),
                 PDN_OK);
    CHECK_STATUS(pdn_solution_sample(solution,
                                     PDN_QUANTITY(PDN_NODE_ACCELERATION, node, PDN_ALL_COMPONENTS,
                                                  .frame = material),
                                     at, TIMES, to->material_acceleration),
                 PDN_OK);
}

static void the_rotor_moves_as_prescribed(void)
{
    struct node_samples s;
    int i;
    sample_node(rotor, times, &s);
    for (i = 0; i < TIMES; i++) {
        const double c = cos(turn(times[i])), d = sin(turn(times[i]));
        const double w = turn_rate(times[i]), a = turn_acceleration(times[i]);
        const double rotation[9] = {c, d, 0, -d, c, 0, 0, 0, 1};
        int k;
        for (k = 0; k < 9; k++)
            CHECK_NEAR(s.rotation[9 * i + k], rotation[k], 1e-9);
        CHECK_NEAR(s.position[3 * i], ARM * c, 1e-9);
        CHECK_NEAR(s.position[3 * i + 1], ARM * d, 1e-9);
        CHECK_NEAR(s.position[3 * i + 2], 0, 1e-12);
        CHECK_NEAR(s.velocity[6 * i], -ARM * w * d, 1e-8);
        CHECK_NEAR(s.velocity[6 * i + 1], ARM * w * c, 1e-8);
        CHECK_NEAR(s.velocity[6 * i + 5], w, 1e-8);
        CHECK_NEAR(s.material_velocity[6 * i], 0, 1e-8);
        CHECK_NEAR(s.material_velocity[6 * i + 1], ARM * w, 1e-8);
        CHECK_NEAR(s.acceleration[6 * i], -ARM * (a * d + w * w * c), 1e-7);
        CHECK_NEAR(s.acceleration[6 * i + 1], ARM * (a * c - w * w * d), 1e-7);
        CHECK_NEAR(s.acceleration[6 * i + 5], a, 1e-7);
        CHECK_NEAR(s.material_acceleration[6 * i], 0, 1e-7);
        CHECK_NEAR(s.material_acceleration[6 * i + 1], ARM * a, 1e-7);
    }
}

/* Rotation matrices by the top's angles, R1(a) R2(b) R3(c). */
static void the_top_turns_by_its_angles(void)
{
    struct node_samples s;
    int i, k;
    sample_node(top, times, &s);
    for (i = 0; i < TIMES; i++) {
        const double a = top_angle(0, times[i]), b = top_angle(1, times[i]);
        const double c = top_angle(2, times[i]);
        const double rotation[9] = {cos(b) * cos(c),
                                    cos(a) * sin(c) + sin(a) * sin(b) * cos(c),
                                    sin(a) * sin(c) - cos(a) * sin(b) * cos(c),
                                    -cos(b) * sin(c),
                                    cos(a) * cos(c) - sin(a) * sin(b) * sin(c),
                                    sin(a) * cos(c) + cos(a) * sin(b) * sin(c),
                                    sin(b),
                                    -sin(a) * cos(b),
                                    cos(a) * cos(b)};
        for (k = 0; k < 9; k++)
            CHECK_NEAR(s.rotation[9 * i + k], rotation[k], 1e-6);
        for (k = 0; k < 3; k++)
            CHECK_NEAR(s.position[3 * i + k], TOP[k], 1e-12);
    }
}

/* Rotation, quaternion, velocities and accelerations of a node belong together. */
static void quantities_of_a_node_fit(int32_t node)
{
    static const double STEP = 1e-4;
    struct node_samples s, before, after;
    double earlier[TIMES], later[TIMES];
    int i, k;

    for (i = 0; i < TIMES; i++) {
        earlier[i] = times[i] - STEP;
        later[i] = times[i] + STEP;
    }
    sample_node(node, times, &s);
    sample_node(node, earlier, &before);
    sample_node(node, later, &after);
    CHECK(s.quaternion[0] >= 0);
    for (i = 0; i < TIMES; i++) {
        const double *R = s.rotation + 9 * i, *q = s.quaternion + 4 * i;
        const double *v = s.velocity + 6 * i, *V = s.material_velocity + 6 * i;
        const double *a = s.acceleration + 6 * i, *A = s.material_acceleration + 6 * i;
        double moved[3], whirl[3], total[3];

        CHECK_NEAR(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3], 1, 1e-14);
        CHECK_NEAR(R[0], 1 - 2 * (q[2] * q[2] + q[3] * q[3]), 1e-14);
        CHECK_NEAR(R[1], 2 * (q[1] * q[2] + q[0] * q[3]), 1e-14);
        CHECK_NEAR(R[5], 2 * (q[2] * q[3] + q[0] * q[1]), 1e-14);
        CHECK_NEAR(R[6], 2 * (q[1] * q[3] + q[0] * q[2]), 1e-14);
        if (i > 0) { /* of the two quaternions, the one that is nearer to the one before */
            const double *p = q - 4;
            CHECK(p[0] * q[0] + p[1] * q[1] + p[2] * q[2] + p[3] * q[3] >= 0);
        }

        /* Material and inertial components. */
        for (k = 0; k < 6; k += 3) {
            int j;
            rotate(R, V + k, moved);
            for (j = 0; j < 3; j++)
                CHECK_NEAR(v[k + j], moved[j], 1e-12);
        }
        cross(V + 3, V, whirl);
        for (k = 0; k < 3; k++)
            total[k] = A[k] + whirl[k];
        rotate(R, total, moved);
        for (k = 0; k < 3; k++)
            CHECK_NEAR(a[k], moved[k], 1e-11);
        rotate(R, A + 3, moved);
        for (k = 0; k < 3; k++)
            CHECK_NEAR(a[3 + k], moved[k], 1e-11);

        /* Derivatives by differences, whose error is of the order of STEP^2 times high harmonics.
         */
        for (k = 0; k < 3; k++)
            CHECK_NEAR((after.position[3 * i + k] - before.position[3 * i + k]) / (2 * STEP), v[k],
                       1e-5);
        for (k = 0; k < 6; k++) {
            CHECK_NEAR((after.velocity[6 * i + k] - before.velocity[6 * i + k]) / (2 * STEP), a[k],
                       1e-5);
            CHECK_NEAR((after.material_velocity[6 * i + k] - before.material_velocity[6 * i + k]) /
                           (2 * STEP),
                       A[k], 1e-5);
        }
        for (k = 0; k < 9; k += 3) { /* the columns turn with the angular velocity */
            double rate[3];
            int j;
            cross(v + 3, R + k, rate);
            for (j = 0; j < 3; j++)
                CHECK_NEAR((after.rotation[9 * i + k + j] - before.rotation[9 * i + k + j]) /
                               (2 * STEP),
                           rate[j], 1e-5);
        }
    }
}

/* A time of another period gives the same, up to rounding; so do more times at once, or none. */
static void times_may_be_any(void)
{
    double grid[POINTS], here[3 * POINTS], there[3 * POINTS], one[3], canary = 7;
    int i, k;
    CHECK_STATUS(pdn_solution_grid_times(solution, grid, POINTS), PDN_OK);
    for (i = 0; i < POINTS; i++)
        CHECK_NEAR(grid[i], PERIOD * i / POINTS, 1e-15);
    CHECK_STATUS(pdn_solution_sample(solution,
                                     PDN_QUANTITY(PDN_NODE_POSITION, rotor, PDN_ALL_COMPONENTS),
                                     grid, POINTS, here),
                 PDN_OK);
    for (i = 0; i < POINTS; i++) {
        CHECK_STATUS(pdn_solution_sample(solution,
                                         PDN_QUANTITY(PDN_NODE_POSITION, rotor, PDN_ALL_COMPONENTS),
                                         grid + i, 1, one),
                     PDN_OK);
        CHECK(memcmp(one, here + 3 * i, sizeof one) == 0);
        CHECK_NEAR(one[0], ARM * cos(turn(grid[i])), 1e-12); /* to rounding at grid points */
        grid[i] -= 1000 * PERIOD;
    }
    CHECK_STATUS(pdn_solution_sample(solution,
                                     PDN_QUANTITY(PDN_NODE_POSITION, rotor, PDN_ALL_COMPONENTS),
                                     grid, POINTS, there),
                 PDN_OK);
    for (k = 0; k < 3 * POINTS; k++)
        CHECK_NEAR(here[k], there[k], 1e-11);

    CHECK_STATUS(pdn_solution_sample(solution,
                                     PDN_QUANTITY(PDN_NODE_POSITION, rotor, PDN_ALL_COMPONENTS),
                                     NULL, 0, NULL),
                 PDN_OK);
    CHECK_STATUS(pdn_solution_sample(solution,
                                     PDN_QUANTITY(PDN_NODE_POSITION, rotor, PDN_ALL_COMPONENTS),
                                     grid, 0, &canary),
                 PDN_OK);
    CHECK_STATUS(pdn_solution_sample(solution,
                                     PDN_QUANTITY(PDN_JOINT_COORDINATE, motor, PDN_ROTATION), NULL,
                                     0, NULL),
                 PDN_OK);
    CHECK_STATUS(pdn_solution_sample(solution,
                                     PDN_QUANTITY(PDN_JOINT_REACTION, motor, PDN_ALL_COMPONENTS),
                                     NULL, 0, NULL),
                 PDN_OK);
    CHECK_STATUS(pdn_solution_sample(
                     solution, PDN_QUANTITY(PDN_BEAM_FORCE, BEAM_ELEMENT(0), PDN_ALL_COMPONENTS),
                     NULL, 0, NULL),
                 PDN_OK);
    CHECK(canary == 7);
}

/* --- Joints --- */

struct joint_samples {
    double coordinate[TIMES], rate[TIMES], acceleration[TIMES], effort[TIMES];
};

static void sample_joint(int32_t joint, int32_t coordinate, struct joint_samples *to)
{
    CHECK_STATUS(pdn_solution_sample(solution,
                                     PDN_QUANTITY(PDN_JOINT_COORDINATE, joint, coordinate), times,
                                     TIMES, to->coordinate),
                 PDN_OK);
    CHECK_STATUS(pdn_solution_sample(solution, PDN_QUANTITY(PDN_JOINT_RATE, joint, coordinate),
                                     times, TIMES, to->rate),
                 PDN_OK);
    CHECK_STATUS(pdn_solution_sample(solution,
                                     PDN_QUANTITY(PDN_JOINT_ACCELERATION, joint, coordinate), times,
                                     TIMES, to->acceleration),
                 PDN_OK);
    CHECK_STATUS(pdn_solution_sample(solution,
                                     PDN_QUANTITY(PDN_JOINT_DRIVING_EFFORT, joint, coordinate),
                                     times, TIMES, to->effort),
                 PDN_OK);
}

/* Also through whole turns. */
static void the_motor_drives_its_angle(void)
{
    const double J = ROTOR_INERTIA[8] + ROTOR_MASS * ARM * ARM;
    struct joint_samples s;
    int i;
    sample_joint(motor, PDN_ROTATION, &s);
    for (i = 0; i < TIMES; i++) {
        CHECK_NEAR(s.coordinate[i], turn(times[i]), 1e-9);
        CHECK_NEAR(s.rate[i], turn_rate(times[i]), 1e-8);
        CHECK_NEAR(s.acceleration[i], turn_acceleration(times[i]), 1e-7);
        CHECK_NEAR(s.effort[i], J * turn_acceleration(times[i]), 1e-7);
    }
}

/* The angles of the top, and its efforts: their power is the growth of its energy. */
static void the_ball_drives_three_angles(void)
{
    double grid[POINTS], power[POINTS] = {0}, velocity[6 * POINTS], acceleration[6 * POINTS];
    int i, k;
    CHECK_STATUS(pdn_solution_grid_times(solution, grid, POINTS), PDN_OK);
    for (k = 0; k < 3; k++) {
        const double w = (k + 1) * OMEGA;
        double effort[POINTS], rate[POINTS];
        struct joint_samples s;
        sample_joint(ball, PDN_ROTATION + k, &s);
        for (i = 0; i < TIMES; i++) {
            CHECK_NEAR(s.coordinate[i], top_angle(k, times[i]), 1e-9);
            CHECK_NEAR(s.rate[i], w * TOP_SWING[k] * cos(w * times[i]), 1e-8);
            CHECK_NEAR(s.acceleration[i], -w * w * top_angle(k, times[i]), 1e-7);
        }
        CHECK_STATUS(pdn_solution_sample(
                         solution, PDN_QUANTITY(PDN_JOINT_DRIVING_EFFORT, ball, PDN_ROTATION + k),
                         grid, POINTS, effort),
                     PDN_OK);
        CHECK_STATUS(pdn_solution_sample(solution,
                                         PDN_QUANTITY(PDN_JOINT_RATE, ball, PDN_ROTATION + k), grid,
                                         POINTS, rate),
                     PDN_OK);
        for (i = 0; i < POINTS; i++)
            power[i] += effort[i] * rate[i];
    }
    CHECK_STATUS(pdn_solution_sample(solution,
                                     PDN_QUANTITY(PDN_NODE_VELOCITY, top, PDN_ALL_COMPONENTS,
                                                  .frame = PDN_FRAME_MATERIAL),
                                     grid, POINTS, velocity),
                 PDN_OK);
    CHECK_STATUS(pdn_solution_sample(solution,
                                     PDN_QUANTITY(PDN_NODE_ACCELERATION, top, PDN_ALL_COMPONENTS,
                                                  .frame = PDN_FRAME_MATERIAL),
                                     grid, POINTS, acceleration),
                 PDN_OK);
    for (i = 0; i < POINTS; i++) {
        double growth = 0;
        for (k = 0; k < 9; k++)
            growth +=
                velocity[6 * i + 3 + k / 3] * TOP_INERTIA[k] * acceleration[6 * i + 3 + k % 3];
        CHECK_NEAR(power[i], growth, 1e-5);
    }
}

/* What the hinge exerts on the rotor: what accelerates its centre, and the moment of that about
 * ORIGIN. */
static void reactions_are_those_of_newton(void)
{
    double space[6 * TIMES], first[6 * TIMES], second[6 * TIMES], rotation[9 * TIMES], axes[9];
    int i, k;
    joint_axes(axes);
    CHECK_STATUS(pdn_solution_sample(solution,
                                     PDN_QUANTITY(PDN_NODE_ROTATION, rotor, PDN_ALL_COMPONENTS),
                                     times, TIMES, rotation),
                 PDN_OK);
    CHECK_STATUS(pdn_solution_sample(solution,
                                     PDN_QUANTITY(PDN_JOINT_REACTION, motor, PDN_ALL_COMPONENTS),
                                     times, TIMES, space),
                 PDN_OK);
    CHECK_STATUS(pdn_solution_sample(solution,
                                     PDN_QUANTITY(PDN_JOINT_REACTION, motor, PDN_ALL_COMPONENTS,
                                                  .frame = PDN_FRAME_FIRST),
                                     times, TIMES, first),
                 PDN_OK);
    CHECK_STATUS(pdn_solution_sample(solution,
                                     PDN_QUANTITY(PDN_JOINT_REACTION, motor, PDN_ALL_COMPONENTS,
                                                  .frame = PDN_FRAME_SECOND),
                                     times, TIMES, second),
                 PDN_OK);
    for (i = 0; i < TIMES; i++) {
        const double c = cos(turn(times[i])), d = sin(turn(times[i]));
        const double w = turn_rate(times[i]), a = turn_acceleration(times[i]);
        const double weight = ROTOR_MASS * GRAVITY;
        const double expected[6] = {-ROTOR_MASS * ARM * (a * d + w * w * c),
                                    ROTOR_MASS * ARM * (a * c - w * w * d),
                                    weight,
                                    weight * ARM * d,
                                    -weight * ARM * c,
                                    0};
        for (k = 0; k < 6; k++)
            CHECK_NEAR(space[6 * i + k], expected[k], 1e-6);
        for (k = 0; k < 6; k += 3) {
            double in_node[3], in_first[3], in_second[3];
            int j;
            rotate_back(axes, space + 6 * i + k, in_first);
            rotate_back(rotation + 9 * i, space + 6 * i + k, in_node);
            rotate_back(axes, in_node, in_second);
            for (j = 0; j < 3; j++) {
                CHECK_NEAR(first[6 * i + k + j], in_first[j], 1e-6);
                CHECK_NEAR(second[6 * i + k + j], in_second[j], 1e-6);
            }
        }
    }

    /* The ball carries the weight, and no moment. The clamp carries the moment on the beam's end.
     */
    CHECK_STATUS(pdn_solution_sample(solution,
                                     PDN_QUANTITY(PDN_JOINT_REACTION, ball, PDN_ALL_COMPONENTS),
                                     times, TIMES, space),
                 PDN_OK);
    CHECK_STATUS(pdn_solution_sample(solution,
                                     PDN_QUANTITY(PDN_JOINT_REACTION, clamp, PDN_ALL_COMPONENTS,
                                                  .frame = PDN_FRAME_FIRST),
                                     times, TIMES, first),
                 PDN_OK);
    for (i = 0; i < TIMES; i++) {
        const double weight[6] = {0, 0, TOP_MASS * GRAVITY, 0, 0, 0};
        for (k = 0; k < 6; k++)
            CHECK_NEAR(space[6 * i + k], weight[k], 1e-9);
        for (k = 0; k < 5; k++)
            CHECK_NEAR(first[6 * i + k], 0, 1e-5);
        CHECK_NEAR(first[6 * i + 5], -MOMENT * cos(OMEGA * times[i]), 1e-5);
    }
}

/* --- Beams --- */

/* The same moment everywhere; the curvature lags, as the section is damped. */
static void the_beam_bends_evenly(void)
{
    static const double stations[] = {-1, -0.5, 0, 0.7, 1};
    const double lag = 1 + pow(DELAY * OMEGA, 2);
    double strain[6 * TIMES], force[6 * TIMES], mean[6 * TIMES], jump[6 * TIMES];
    int32_t element;
    size_t s;
    int i, k;
    for (element = BEAM_ELEMENT(0); element < BEAM_ELEMENT(beam.elements); element++) {
        for (s = 0; s < sizeof stations / sizeof *stations; s++) {
            CHECK_STATUS(
                pdn_solution_sample(solution,
                                    PDN_QUANTITY(PDN_BEAM_STRAIN, element, PDN_ALL_COMPONENTS,
                                                 .station = stations[s]),
                                    times, TIMES, strain),
                PDN_OK);
            CHECK_STATUS(
                pdn_solution_sample(solution,
                                    PDN_QUANTITY(PDN_BEAM_FORCE, element, PDN_ALL_COMPONENTS,
                                                 .station = stations[s]),
                                    times, TIMES, force),
                PDN_OK);
            CHECK_STATUS(
                pdn_solution_sample(solution,
                                    PDN_QUANTITY(PDN_BEAM_FORCE_MEAN, element, PDN_ALL_COMPONENTS,
                                                 .station = stations[s]),
                                    times, TIMES, mean),
                PDN_OK);
            CHECK_STATUS(
                pdn_solution_sample(solution,
                                    PDN_QUANTITY(PDN_BEAM_FORCE_JUMP, element, PDN_ALL_COMPONENTS,
                                                 .station = stations[s]),
                                    times, TIMES, jump),
                PDN_OK);
            for (i = 0; i < 6 * TIMES; i++) {
                const double side = fabs(stations[s]) == 1 ? 0.5 * stations[s] : 0;
                CHECK_NEAR(mean[i], force[i] + side * jump[i], 1e-12 * MOMENT);
                if (side == 0)
                    CHECK(jump[i] == 0);
            }
            for (i = 0; i < TIMES; i++) {
                const double c = cos(OMEGA * times[i]), d = sin(OMEGA * times[i]);
                const double curvature = MOMENT / STIFFNESS[5] * (c + DELAY * OMEGA * d) / lag;
                for (k = 0; k < 5; k++) {
                    if (stations[s] == 0) /* two nodes: exact at the Gauss point, the middle */
                        CHECK_NEAR(force[6 * i + k], 0, 1e-4 * MOMENT);
                    if (k > 1) /* strains within the plane are of second order */
                        CHECK_NEAR(strain[6 * i + k], 0, 1e-12);
                }
                CHECK_NEAR(strain[6 * i + 5], curvature, 1e-6 * MOMENT / STIFFNESS[5]);
                CHECK_NEAR(force[6 * i + 5], MOMENT * c, 1e-6 * MOMENT);
            }
        }
    }
}

/* --- Harmonics --- */

enum { COMPONENTS = 9 }; /* at most */

/* Checks mean + rate t + ... against samples, and that less may be asked for. */
struct series {
    double mean[COMPONENTS], rate[COMPONENTS];
    double cosines[COMPONENTS * HARMONICS], sines[COMPONENTS * HARMONICS];
};

static void check_series(const struct series *series, int components, const double *at, int count,
                         const double *samples, double tolerance)
{
    int i, k, j;
    for (i = 0; i < count; i++) {
        for (k = 0; k < components; k++) {
            double value = series->mean[k] + series->rate[k] * at[i];
            for (j = 0; j < HARMONICS; j++)
                value += series->cosines[components * j + k] * cos((j + 1) * OMEGA * at[i]) +
                         series->sines[components * j + k] * sin((j + 1) * OMEGA * at[i]);
            CHECK_NEAR(value, samples[components * i + k], tolerance);
        }
    }
}

/* The same call with fewer harmonics, and with outputs left out, gives a part of the same. */
#define CHECK_PARTS(series, components, call)                                                      \
    do {                                                                                           \
        struct series part;                                                                        \
        double *mean = part.mean, *cosines = part.cosines, *sines = NULL;                          \
        size_t harmonics = 2;                                                                      \
        memset(&part, 0, sizeof part);                                                             \
        CHECK_STATUS(call, PDN_OK);                                                                \
        CHECK(memcmp(part.mean, (series).mean, (components) * sizeof(double)) == 0);               \
        CHECK(memcmp(part.cosines, (series).cosines, 2 * (components) * sizeof(double)) == 0);     \
        CHECK(part.cosines[2 * (components)] == 0 && part.sines[0] == 0);                          \
        mean = cosines = NULL;                                                                     \
        sines = part.sines;                                                                        \
        harmonics = 1;                                                                             \
        CHECK_STATUS(call, PDN_OK);                                                                \
        CHECK(memcmp(part.sines, (series).sines, (components) * sizeof(double)) == 0);             \
        CHECK(part.sines[(components)] == 0);                                                      \
        sines = NULL;                                                                              \
        CHECK_STATUS(call, PDN_OK);                                                                \
        harmonics = 0;                                                                             \
        cosines = sines = part.cosines;                                                            \
        memset(&part, 0, sizeof part);                                                             \
        CHECK_STATUS(call, PDN_OK);                                                                \
        CHECK(part.cosines[0] == 0);                                                               \
    } while (0)

/* More than the grid has are given, zeros above. */
static void harmonics_beyond_those_of_the_grid_are_zero(void)
{
    enum { MORE = HARMONICS + 3 };
    double cosines[3 * MORE], sines[3 * MORE], fewer[3 * HARMONICS];
    size_t i;
    CHECK_STATUS(pdn_solution_harmonics(solution,
                                        PDN_QUANTITY(PDN_NODE_POSITION, rotor, PDN_ALL_COMPONENTS),
                                        HARMONICS, NULL, NULL, fewer, NULL),
                 PDN_OK);
    for (i = 0; i < 3 * MORE; i++)
        cosines[i] = sines[i] = 7;
    CHECK_STATUS(pdn_solution_harmonics(solution,
                                        PDN_QUANTITY(PDN_NODE_POSITION, rotor, PDN_ALL_COMPONENTS),
                                        MORE, NULL, NULL, cosines, sines),
                 PDN_OK);
    CHECK(memcmp(cosines, fewer, sizeof fewer) == 0);
    for (i = 3 * HARMONICS; i < 3 * MORE; i++)
        CHECK(cosines[i] == 0 && sines[i] == 0);
}

static void node_harmonics_are_those_of_the_samples(void)
{
    static const struct {
        int32_t kind;
        int components;
        int32_t frame;
    } cases[] = {
        {PDN_NODE_POSITION, 3, PDN_FRAME_SPACE},       {PDN_NODE_ROTATION, 9, PDN_FRAME_SPACE},
        {PDN_NODE_QUATERNION, 4, PDN_FRAME_SPACE},     {PDN_NODE_VELOCITY, 6, PDN_FRAME_SPACE},
        {PDN_NODE_ACCELERATION, 6, PDN_FRAME_SPACE},   {PDN_NODE_VELOCITY, 6, PDN_FRAME_MATERIAL},
        {PDN_NODE_ACCELERATION, 6, PDN_FRAME_MATERIAL}};
    const int32_t nodes[] = {rotor, beam.last, top};
    double grid[POINTS], samples[COMPONENTS * POINTS];
    size_t n, c;
    CHECK_STATUS(pdn_solution_grid_times(solution, grid, POINTS), PDN_OK);
    for (n = 0; n < 3; n++) {
        for (c = 0; c < sizeof cases / sizeof *cases; c++) {
            const pdn_quantity *const asked =
                PDN_QUANTITY(cases[c].kind, nodes[n], PDN_ALL_COMPONENTS, .frame = cases[c].frame);
            struct series series;
            memset(&series, 0, sizeof series);
            if (cases[c].kind == PDN_NODE_QUATERNION && nodes[n] == rotor) {
                CHECK_STATUS(pdn_solution_harmonics(solution, asked, HARMONICS, series.mean, NULL,
                                                    series.cosines, series.sines),
                             PDN_ERR_NOT_AVAILABLE);
                CHECK_MESSAGE("odd number of turns");
                CHECK(series.mean[0] == 0 && series.cosines[0] == 0 && series.sines[0] == 0);
                continue;
            }
            CHECK_STATUS(pdn_solution_harmonics(solution, asked, HARMONICS, series.mean, NULL,
                                                series.cosines, series.sines),
                         PDN_OK);
            CHECK_STATUS(pdn_solution_sample(solution, asked, grid, POINTS, samples), PDN_OK);
            check_series(&series, cases[c].components, grid, POINTS, samples, 1e-11);
            CHECK_PARTS(
                series, (size_t)cases[c].components,
                pdn_solution_harmonics(solution, asked, harmonics, mean, NULL, cosines, sines));
        }
    }
}

static void joint_harmonics_are_those_of_the_samples(void)
{
    const int32_t joints[] = {motor, clamp, ball};
    double samples[6 * TIMES];
    size_t n;
    int32_t kind, detail;
    for (n = 0; n < 3; n++) {
        const int32_t joint = joints[n];
        for (kind = PDN_JOINT_COORDINATE; kind <= PDN_JOINT_REACTION; kind++) {
            const int reaction = kind == PDN_JOINT_REACTION;
            const int components = reaction ? 6 : 1;
            const int32_t first = reaction ? PDN_FRAME_SPACE : PDN_ROTATION;
            const int32_t last = reaction ? PDN_FRAME_SECOND : PDN_ROTATION_3;
            for (detail = first; detail <= last;
                 detail = detail == PDN_FRAME_SPACE ? PDN_FRAME_FIRST : detail + 1) {
                const int exists =
                    reaction || joint == ball || (joint == motor && detail == PDN_ROTATION);
                const pdn_quantity *const asked =
                    reaction ? PDN_QUANTITY(kind, joint, PDN_ALL_COMPONENTS, .frame = detail)
                             : PDN_QUANTITY(kind, joint, detail);
                struct series series;
                memset(&series, 0, sizeof series);
                CHECK_STATUS(pdn_solution_harmonics(solution, asked, HARMONICS, series.mean,
                                                    series.rate, series.cosines, series.sines),
                             exists ? PDN_OK : PDN_ERR_NOT_AVAILABLE);
                CHECK_STATUS(pdn_solution_sample(solution, asked, times, TIMES, samples),
                             exists ? PDN_OK : PDN_ERR_NOT_AVAILABLE);
                if (!exists)
                    continue;
                check_series(&series, components, times, TIMES, samples, 1e-10);
                CHECK_NEAR(series.rate[0],
                           joint == motor && kind == PDN_JOINT_COORDINATE ? OMEGA : 0, 1e-15);
                CHECK_PARTS(
                    series, (size_t)components,
                    pdn_solution_harmonics(solution, asked, harmonics, mean, NULL, cosines, sines));
            }
        }
    }
}

static void beam_harmonics_are_those_of_the_samples(void)
{
    double samples[6 * TIMES];
    int32_t element, kind;
    for (element = BEAM_ELEMENT(0); element < BEAM_ELEMENT(beam.elements); element++) {
        for (kind = PDN_BEAM_STRAIN; kind <= PDN_BEAM_FORCE; kind++) {
            const pdn_quantity *const asked =
                PDN_QUANTITY(kind, element, PDN_ALL_COMPONENTS, .station = 0.4);
            struct series series;
            memset(&series, 0, sizeof series);
            CHECK_STATUS(pdn_solution_harmonics(solution, asked, HARMONICS, series.mean, NULL,
                                                series.cosines, series.sines),
                         PDN_OK);
            CHECK_STATUS(pdn_solution_sample(solution, asked, times, TIMES, samples), PDN_OK);
            check_series(&series, 6, times, TIMES, samples, 1e-10);
            CHECK_PARTS(
                series, 6,
                pdn_solution_harmonics(solution, asked, harmonics, mean, NULL, cosines, sines));
        }
    }
}

/* --- The solve itself --- */

static void history_and_decay_are_told(void)
{
    enum { MOST = 32 };
    double residuals[MOST], increments[MOST], steps[MOST], alone[MOST], decay[HARMONICS + 1];
    double rotation[9], cosines[9 * HARMONICS], sines[9 * HARMONICS];
    size_t count, i;
    pdn_diagnostics diagnostics;

    PDN_INIT(pdn_diagnostics, &diagnostics);
    CHECK_STATUS(pdn_solution_diagnostics(solution, &diagnostics), PDN_OK);
    CHECK(diagnostics.struct_size == sizeof diagnostics && diagnostics.redundant_constraints == 0);
    CHECK(diagnostics.outcome == PDN_CONVERGED && diagnostics.grid_points == POINTS);
    /* 5 nodes; 5 + 6 + 3 constraints of joints, 1 + 3 of prescribed angles. */
    CHECK(diagnostics.unknowns == POINTS * (5 * 6 + 14 + 4));
    CHECK(diagnostics.iterations > 0 && diagnostics.iterations < MOST);
    CHECK(diagnostics.guess_iterations > 0);
    CHECK(diagnostics.error_estimate > 0 && diagnostics.error_estimate < 1e-3);
    CHECK(diagnostics.force_residual_between > 0 && diagnostics.force_residual_between < 1e-2);
    CHECK(diagnostics.constraint_residual_between > 0);
    CHECK(diagnostics.constraint_residual_between < 1e-3);
    CHECK(diagnostics.guess_seconds > 0 && diagnostics.assembly_seconds > 0);
    CHECK(diagnostics.analysis_seconds > 0 && diagnostics.factorisation_seconds > 0);
    CHECK(diagnostics.substitution_seconds > 0);

    count = (size_t)diagnostics.iterations;
    CHECK_STATUS(pdn_solution_history(solution, residuals, increments, steps, count), PDN_OK);
    for (i = 0; i < count; i++)
        CHECK(residuals[i] >= 0 && increments[i] >= 0 && steps[i] > 0 && steps[i] <= 1);
    CHECK(increments[count - 1] == diagnostics.last_increment &&
          diagnostics.last_increment <= 1e-9);
    CHECK_STATUS(pdn_solution_history(solution, NULL, alone, NULL, count), PDN_OK);
    CHECK(memcmp(alone, increments, count * sizeof *alone) == 0);
    CHECK_STATUS(pdn_solution_history(solution, alone, NULL, NULL, count), PDN_OK);
    CHECK(memcmp(alone, residuals, count * sizeof *alone) == 0);
    CHECK_STATUS(pdn_solution_history(solution, NULL, NULL, alone, count), PDN_OK);
    CHECK(memcmp(alone, steps, count * sizeof *alone) == 0);
    CHECK_STATUS(pdn_solution_history(solution, NULL, NULL, NULL, count), PDN_OK);

    /* The rotor has the largest first harmonic of all. */
    CHECK_STATUS(pdn_solution_decay(solution, decay, HARMONICS + 1), PDN_OK);
    CHECK_STATUS(pdn_solution_harmonics(solution,
                                        PDN_QUANTITY(PDN_NODE_ROTATION, rotor, PDN_ALL_COMPONENTS),
                                        HARMONICS, rotation, NULL, cosines, sines),
                 PDN_OK);
    CHECK_NEAR(decay[1], sqrt(cosines[0] * cosines[0] + sines[0] * sines[0]), 1e-12);
    CHECK_NEAR(decay[0], 1, 1e-2); /* the axis that stands still */
    CHECK(decay[HARMONICS] < 1e-3 * decay[1]);
}

static void reports_fit_their_buffers(void)
{
    enum { LONG = 4096 };
    char whole[LONG], part[LONG];
    const size_t length = pdn_solution_report(solution, whole, sizeof whole);
    size_t capacity;
    CHECK(length > 100 && length < sizeof whole && strlen(whole) == length);
    CHECK(strstr(whole, "Periodic solve: converged\n") == whole);
    CHECK(strstr(whole, "17 grid points") != NULL);
    CHECK(pdn_solution_report(solution, NULL, 0) == length);
    for (capacity = 0; capacity <= length + 2; capacity += capacity < 4 ? 1 : length / 5) {
        const size_t fits = capacity == 0 ? 0 : capacity - 1 < length ? capacity - 1 : length;
        memset(part, 'x', sizeof part);
        CHECK(pdn_solution_report(solution, part, capacity) == length);
        CHECK(memcmp(part, whole, fits) == 0);
        CHECK(capacity == 0 || part[fits] == '\0');
        CHECK(part[capacity == 0 ? 0 : fits + 1] == 'x');
    }
    CHECK(pdn_solution_report(solution, part, length + 1) == length && strcmp(part, whole) == 0);
    CHECK(pdn_solution_report(solution, part, length) == length && strlen(part) == length - 1);

    static char json[1 << 16];
    const size_t json_length = pdn_solution_report_json(solution, json, sizeof json);
    CHECK(json_length == strlen(json) && json[0] == '{' && json[json_length - 1] == '}');
    CHECK(strstr(json, "\"outcome\":\"converged\"") && strstr(json, "\"kind\":\"periodic\""));
    CHECK(pdn_solution_report_json(solution, NULL, 0) == json_length);
    CHECK(pdn_solution_report_json(NULL, json, sizeof json) == 0);
}

int main(void)
{
    int32_t node;
    build();
    solve();
    pdn_model_free(model);
    the_rotor_moves_as_prescribed();
    the_top_turns_by_its_angles();
    for (node = NODE(0); node <= top; node++)
        quantities_of_a_node_fit(node);
    times_may_be_any();
    the_motor_drives_its_angle();
    the_ball_drives_three_angles();
    reactions_are_those_of_newton();
    the_beam_bends_evenly();
    node_harmonics_are_those_of_the_samples();
    harmonics_beyond_those_of_the_grid_are_zero();
    joint_harmonics_are_those_of_the_samples();
    beam_harmonics_are_those_of_the_samples();
    history_and_decay_are_told();
    reports_fit_their_buffers();
    pdn_solution_free(solution);
    return 0;
}
