/* Forces on joint coordinates and on nodes against closed forms: what they do to the motion, and
 * what can be read of them. A body of mass MASS slides along AXIS. */
#include "near.h"

#define PERIOD 1.4
#define OMEGA (2 * PI / PERIOD)

enum { POINTS = 31, TIMES = 7 };

static const double POINT[3] = {0.3, -0.2, 0.5}, ORIGIN[3] = {0, 0, 0};
static const double AXIS[3] = {2. / 3, -1. / 3, 2. / 3};
static const double MASS = 2.5, INERTIA = 0.4;
static const double SPIN[9] = {0.4, 0, 0, 0, 0.4, 0, 0, 0, 0.4};
static const double STIFFNESS = 30.0, DAMPING = 4.0, FORCE = 12.0;

static const double times[TIMES] = {-1.3 * PERIOD, 0.0,          0.123 * PERIOD, 0.31 * PERIOD,
                                    0.5 * PERIOD,  0.9 * PERIOD, 3.77 * PERIOD};

static pdn_model *model;
static pdn_solution *solution;
static int32_t body, joint;

/* How often callbacks were called, and their data disposed of. */
struct law {
    double stiffness, damping, wrong;
    int32_t calls, destroyed;
};

static pdn_signal harmonic(double mean, double cosine, double sine)
{
    static double kept[16][2]; /* a signal points to its harmonics */
    static int count;
    double *const harmonics = kept[count++ % 16];
    pdn_signal signal;
    PDN_INIT(pdn_signal, &signal);
    harmonics[0] = cosine;
    harmonics[1] = sine;
    CHECK_STATUS(pdn_signal_set_harmonics(&signal, mean, 0, harmonics, harmonics + 1, 1), PDN_OK);
    return signal;
}

static void begin(void)
{
    CHECK_STATUS(pdn_model_new(&model), PDN_OK);
    CHECK_STATUS(pdn_model_add_rigid_body(model, MASS, POINT, SPIN, &body), PDN_OK);
}

static void begin_slider(void)
{
    begin();
    CHECK_STATUS(pdn_model_add_prismatic(model, PDN_GROUND, body, POINT, AXIS, &joint), PDN_OK);
}

static void prescribe(int32_t coordinate, double mean, double cosine, double sine)
{
    const pdn_signal signal = harmonic(mean, cosine, sine);
    CHECK_STATUS(pdn_model_prescribe(model, joint, coordinate, &signal, NULL), PDN_OK);
}

static void solve(void)
{
    pdn_periodic_options options;
    PDN_INIT(pdn_periodic_options, &options);
    options.grid_points = POINTS;
    options.tolerance = 1e-11;
    CHECK_STATUS(pdn_solve_periodic(model, PERIOD, &options, &solution), PDN_OK);
    CHECK(reports(solution, "converged"));
    CHECK(pdn_solution_outcome(solution) == PDN_CONVERGED);
}

static void end(void)
{
    pdn_solution_free(solution);
    pdn_model_free(model);
}

static void check_force_count(int32_t expected)
{
    int32_t count = -1;
    CHECK_STATUS(pdn_model_force_count(model, &count), PDN_OK);
    CHECK(count == expected);
}

/* What the force exerts on the body is the force along the axis, in space and along the node's
 * axes, which do not turn on a slider. */
static void check_on_body(int32_t force, const double *along)
{
    double wrench[6 * TIMES], own[6 * TIMES];
    int i, k;
    CHECK_STATUS(pdn_solution_sample(
                     solution,
                     PDN_QUANTITY(PDN_FORCE_ON_NODE, force, PDN_ALL_COMPONENTS, .node = body),
                     times, TIMES, wrench),
                 PDN_OK);
    CHECK_STATUS(pdn_solution_sample(solution,
                                     PDN_QUANTITY(PDN_FORCE_ON_NODE, force, PDN_ALL_COMPONENTS,
                                                  .node = body, .frame = PDN_FRAME_MATERIAL),
                                     times, TIMES, own),
                 PDN_OK);
    for (i = 0; i < TIMES; i++)
        for (k = 0; k < 3; k++) {
            CHECK_NEAR(wrench[6 * i + k], along[i] * AXIS[k], 1e-9);
            CHECK_NEAR(wrench[6 * i + 3 + k], 0, 1e-9);
            CHECK_NEAR(own[6 * i + k], wrench[6 * i + k], 1e-9);
        }
}

/* The response of m u'' + c u' + k u = F cos wt. */
static double response(double mass, double damping, double stiffness, double force, double t,
                       double *rate)
{
    const double a = stiffness - mass * OMEGA * OMEGA, b = damping * OMEGA;
    const double size = force / (a * a + b * b), c = cos(OMEGA * t), s = sin(OMEGA * t);
    *rate = size * OMEGA * (b * c - a * s);
    return size * (a * c + b * s);
}

/* The slider answers as the oscillator, with the coordinate's mean at `rest`. */
static void check_oscillation(double rest)
{
    double u[TIMES], v[TIMES];
    int i;
    CHECK_STATUS(pdn_solution_sample(solution,
                                     PDN_QUANTITY(PDN_JOINT_COORDINATE, joint, PDN_DISPLACEMENT),
                                     times, TIMES, u),
                 PDN_OK);
    CHECK_STATUS(pdn_solution_sample(solution,
                                     PDN_QUANTITY(PDN_JOINT_RATE, joint, PDN_DISPLACEMENT), times,
                                     TIMES, v),
                 PDN_OK);
    for (i = 0; i < TIMES; i++) {
        double rate;
        const double exact = response(MASS, DAMPING, STIFFNESS, FORCE, times[i], &rate);
        CHECK_NEAR(u[i], rest + exact, 1e-10);
        CHECK_NEAR(v[i], rate, 1e-9);
    }
}

/* --- Forces on coordinates --- */

static void an_actuator_drives_an_oscillator(void)
{
    const double rest = 0.15;
    const pdn_signal push = harmonic(0, FORCE, 0);
    double effort[TIMES], along[TIMES], mean, slope, cosines[2], sines[2];
    int32_t spring, actuator;
    int i;
    begin_slider();
    check_force_count(0);
    CHECK_STATUS(pdn_model_add_spring_damper(model, joint, PDN_DISPLACEMENT, STIFFNESS, DAMPING,
                                             rest, &spring),
                 PDN_OK);
    CHECK_STATUS(pdn_model_add_actuator(model, joint, PDN_DISPLACEMENT, &push, &actuator), PDN_OK);
    CHECK(spring == FORCE(0) && actuator == FORCE(1));
    check_force_count(2);
    solve();
    check_oscillation(rest);
    CHECK_STATUS(pdn_solution_sample(solution,
                                     PDN_QUANTITY(PDN_FORCE_EFFORT, actuator, PDN_ALL_COMPONENTS),
                                     times, TIMES, effort),
                 PDN_OK);
    for (i = 0; i < TIMES; i++)
        CHECK_NEAR(effort[i], along[i] = FORCE * cos(OMEGA * times[i]), 1e-10);
    check_on_body(actuator, along);
    /* The spring's effort is against growth: its force on the body is the opposite. */
    CHECK_STATUS(pdn_solution_sample(solution,
                                     PDN_QUANTITY(PDN_FORCE_EFFORT, spring, PDN_ALL_COMPONENTS),
                                     times, TIMES, effort),
                 PDN_OK);
    for (i = 0; i < TIMES; i++) {
        double rate;
        const double u = response(MASS, DAMPING, STIFFNESS, FORCE, times[i], &rate);
        CHECK_NEAR(effort[i], STIFFNESS * u + DAMPING * rate, 1e-9);
        along[i] = -effort[i];
    }
    check_on_body(spring, along);
    CHECK_STATUS(pdn_solution_harmonics(
                     solution, PDN_QUANTITY(PDN_FORCE_EFFORT, actuator, PDN_ALL_COMPONENTS), 2,
                     &mean, &slope, cosines, sines),
                 PDN_OK);
    CHECK_NEAR(mean, 0, 1e-12);
    CHECK_NEAR(slope, 0, 1e-12);
    CHECK_NEAR(cosines[0], FORCE, 1e-11);
    CHECK_NEAR(sines[0], 0, 1e-11);
    CHECK_NEAR(cosines[1], 0, 1e-11);
    end();
}

static void polynomials_are_those_of_coordinate_and_rate(void)
{
    const double stiffness[3] = {3, -0.5, 2}, damping[2] = {0.7, 0.2}, rest = 0.1;
    double effort[TIMES], along[TIMES];
    int32_t force;
    int i;
    begin_slider();
    prescribe(PDN_DISPLACEMENT, 0.2, 0.5, -0.3);
    CHECK_STATUS(pdn_model_add_nonlinear_spring_damper(model, joint, PDN_DISPLACEMENT, stiffness, 3,
                                                       damping, 2, rest, &force),
                 PDN_OK);
    /* Neither needs to be there. */
    CHECK_STATUS(pdn_model_add_nonlinear_spring_damper(model, joint, PDN_DISPLACEMENT, NULL, 0,
                                                       NULL, 0, 0, NULL),
                 PDN_OK);
    check_force_count(2);
    solve();
    CHECK_STATUS(pdn_solution_sample(solution,
                                     PDN_QUANTITY(PDN_FORCE_EFFORT, force, PDN_ALL_COMPONENTS),
                                     times, TIMES, effort),
                 PDN_OK);
    for (i = 0; i < TIMES; i++) {
        const double c = cos(OMEGA * times[i]), s = sin(OMEGA * times[i]);
        const double u = 0.2 + 0.5 * c - 0.3 * s - rest, v = -OMEGA * (0.5 * s + 0.3 * c);
        CHECK_NEAR(effort[i], u * (3 + u * (-0.5 + u * 2)) + v * (0.7 + v * 0.2), 1e-9);
        along[i] = -effort[i];
    }
    check_on_body(force, along);
    CHECK_STATUS(pdn_solution_sample(solution,
                                     PDN_QUANTITY(PDN_FORCE_EFFORT, FORCE(1), PDN_ALL_COMPONENTS),
                                     times, TIMES, effort),
                 PDN_OK);
    for (i = 0; i < TIMES; i++)
        CHECK(effort[i] == 0.0);
    end();
}

/* Of a prescribed q = U cos wt each branch has t a' + a = t q'. */
static void maxwell_branches_relax(void)
{
    const double stiffness = 5, rest = 0.1, swing = 0.6;
    const double branch_stiffness[2] = {8, 3}, relaxation[2] = {0.2, 1.5};
    double effort[TIMES], branch[TIMES], dashpot[TIMES], total[TIMES], along[TIMES];
    double mean, slope, cosine, sine;
    int32_t force;
    int i, b;
    begin_slider();
    prescribe(PDN_DISPLACEMENT, 0, swing, 0);
    CHECK_STATUS(pdn_model_add_viscoelastic(model, joint, PDN_DISPLACEMENT, stiffness, rest,
                                            branch_stiffness, relaxation, 2, &force),
                 PDN_OK);
    solve();
    for (i = 0; i < TIMES; i++)
        total[i] = stiffness * (swing * cos(OMEGA * times[i]) - rest);
    for (b = 0; b < 2; b++) {
        const double wt = OMEGA * relaxation[b], size = swing * wt / (1 + wt * wt);
        CHECK_STATUS(pdn_solution_sample(solution,
                                         PDN_QUANTITY(PDN_FORCE_BRANCH_EFFORT, force,
                                                      PDN_ALL_COMPONENTS, .branch = b),
                                         times, TIMES, branch),
                     PDN_OK);
        CHECK_STATUS(pdn_solution_sample(solution,
                                         PDN_QUANTITY(PDN_FORCE_BRANCH_ELONGATION, force,
                                                      PDN_ALL_COMPONENTS, .branch = b),
                                         times, TIMES, dashpot),
                     PDN_OK);
        for (i = 0; i < TIMES; i++) {
            const double c = cos(OMEGA * times[i]), s = sin(OMEGA * times[i]);
            const double a = size * (wt * c - s);
            CHECK_NEAR(branch[i], branch_stiffness[b] * a, 1e-10);
            /* The dashpot's mean is free: it moves as what the spring leaves. */
            CHECK_NEAR(dashpot[i] - dashpot[0],
                       swing * (c - cos(OMEGA * times[0])) - a +
                           size * (wt * cos(OMEGA * times[0]) - sin(OMEGA * times[0])),
                       1e-10);
            total[i] += branch_stiffness[b] * a;
        }
        CHECK_STATUS(pdn_solution_harmonics(solution,
                                            PDN_QUANTITY(PDN_FORCE_BRANCH_EFFORT, force,
                                                         PDN_ALL_COMPONENTS, .branch = b),
                                            1, &mean, &slope, &cosine, &sine),
                     PDN_OK);
        CHECK_NEAR(mean, 0, 1e-10);
        CHECK_NEAR(cosine, branch_stiffness[b] * size * wt, 1e-10);
        CHECK_NEAR(sine, -branch_stiffness[b] * size, 1e-10);
        CHECK_STATUS(pdn_solution_harmonics(solution,
                                            PDN_QUANTITY(PDN_FORCE_BRANCH_ELONGATION, force,
                                                         PDN_ALL_COMPONENTS, .branch = b),
                                            1, &mean, &slope, &cosine, &sine),
                     PDN_OK);
        CHECK_NEAR(cosine, swing - size * wt, 1e-10);
        CHECK_NEAR(sine, size, 1e-10);
    }
    CHECK_STATUS(pdn_solution_sample(solution,
                                     PDN_QUANTITY(PDN_FORCE_EFFORT, force, PDN_ALL_COMPONENTS),
                                     times, TIMES, effort),
                 PDN_OK);
    for (i = 0; i < TIMES; i++) {
        CHECK_NEAR(effort[i], total[i], 1e-10);
        along[i] = -total[i];
    }
    check_on_body(force, along);
    end();
}

/* A full matrix couples one velocity with all forces and moments. */
static void a_damper_resists_by_its_matrix(void)
{
    const double sizes[6] = {3, 2, 4, 0.5, 0.7, 0.6};
    const pdn_frame turned = {{0.3, -0.2, 0.5}, {0, 1, 0, -1, 0, 0, 0, 0, 1}};
    double matrix[36], wrench[6 * TIMES], harmonics[6], mean[6], slope[6], sines[6];
    int32_t own, other;
    int i, k, l;
    for (k = 0; k < 6; k++)
        for (l = 0; l < 6; l++)
            matrix[6 * k + l] = sqrt(sizes[k] * sizes[l]) * (k == l ? 1 : 0.1 + 0.01 * (k + l));
    begin();
    CHECK_STATUS(pdn_model_add_free_joint(model, PDN_GROUND, body, POINT, &joint), PDN_OK);
    prescribe(PDN_DISPLACEMENT, 0, 0, 0.4);
    for (k = 1; k < 6; k++)
        prescribe(PDN_DISPLACEMENT + k, 0, 0, 0);
    CHECK_STATUS(pdn_model_add_viscous_damper(model, PDN_GROUND, body, NULL, matrix, &own), PDN_OK);
    /* Axes turned by a quarter of a turn: global axis 1 is the opposite of axis 2 there. */
    CHECK_STATUS(pdn_model_add_viscous_damper(model, body, PDN_GROUND, &turned, matrix, &other),
                 PDN_OK);
    CHECK(own == FORCE(0) && other == FORCE(1));
    solve();
    CHECK_STATUS(
        pdn_solution_sample(solution,
                            PDN_QUANTITY(PDN_FORCE_ON_NODE, own, PDN_ALL_COMPONENTS, .node = body),
                            times, TIMES, wrench),
        PDN_OK);
    for (i = 0; i < TIMES; i++)
        for (k = 0; k < 6; k++)
            CHECK_NEAR(wrench[6 * i + k], -matrix[k] * 0.4 * OMEGA * cos(OMEGA * times[i]), 1e-9);
    CHECK_STATUS(pdn_solution_harmonics(
                     solution,
                     PDN_QUANTITY(PDN_FORCE_ON_NODE, own, PDN_ALL_COMPONENTS, .node = body), 1,
                     mean, slope, harmonics, sines),
                 PDN_OK);
    for (k = 0; k < 6; k++) {
        CHECK_NEAR(mean[k], 0, 1e-9);
        CHECK_NEAR(harmonics[k], -matrix[k] * 0.4 * OMEGA, 1e-9);
        CHECK_NEAR(sines[k], 0, 1e-9);
    }
    CHECK_STATUS(pdn_solution_harmonics(solution,
                                        PDN_QUANTITY(PDN_FORCE_ON_NODE, own, PDN_ALL_COMPONENTS,
                                                     .node = body, .frame = PDN_FRAME_MATERIAL),
                                        1, mean, slope, harmonics, sines),
                 PDN_OK);
    for (k = 0; k < 6; k++)
        CHECK_NEAR(harmonics[k], -matrix[k] * 0.4 * OMEGA, 1e-9);
    /* The frame is fixed to the ground here, and the body passes over it: the wrench at its origin
     * is the matrix' column of axis 2, and the body's moment is about where the body is. */
    CHECK_STATUS(pdn_solution_sample(
                     solution,
                     PDN_QUANTITY(PDN_FORCE_ON_NODE, other, PDN_ALL_COMPONENTS, .node = body),
                     times, TIMES, wrench),
                 PDN_OK);
    for (i = 0; i < TIMES; i++) {
        const double v = 0.4 * OMEGA * cos(OMEGA * times[i]), u = 0.4 * sin(OMEGA * times[i]);
        const double *const w = wrench + 6 * i, *const column = matrix + 6;
        const double force[3] = {-column[1] * v, column[0] * v, column[2] * v};
        CHECK_NEAR(w[0], force[0], 1e-9);
        CHECK_NEAR(w[1], force[1], 1e-9);
        CHECK_NEAR(w[2], force[2], 1e-9);
        CHECK_NEAR(w[3], -column[4] * v, 1e-9);
        CHECK_NEAR(w[4], column[3] * v + u * force[2], 1e-9);
        CHECK_NEAR(w[5], column[5] * v - u * force[1], 1e-9);
    }
    end();
}

/* --- Laws of the user --- */

static void destroy(void *user_data)
{
    ((struct law *)user_data)->destroyed++;
}

/* Spring, damper and force in one, the force by time. */
static int32_t linear_law(double time, double coordinate, double rate, double *effort,
                          double *derivatives, void *user_data)
{
    struct law *const law = user_data;
    *effort = law->stiffness * coordinate + law->damping * rate - FORCE * cos(OMEGA * time);
    if (derivatives != NULL) {
        derivatives[0] = law->stiffness + law->wrong;
        derivatives[1] = law->damping;
    }
    law->calls++;
    return 0;
}

static void a_law_is_the_users(void)
{
    static const int32_t tangents[] = {PDN_TANGENTS_GIVEN, PDN_TANGENTS_DIFFERENCED};
    int k, i;
    for (k = 0; k < 2; k++) {
        struct law law = {30.0, 4.0, 0, 0, 0};
        double effort[TIMES], along[TIMES];
        int32_t force;
        begin_slider();
        CHECK_STATUS(pdn_model_add_coordinate_law(model, joint, PDN_DISPLACEMENT, tangents[k],
                                                  linear_law, &law, destroy, &force),
                     PDN_OK);
        solve();
        check_oscillation(0);
        CHECK(law.calls > 0);
        CHECK_STATUS(pdn_solution_sample(solution,
                                         PDN_QUANTITY(PDN_FORCE_EFFORT, force, PDN_ALL_COMPONENTS),
                                         times, TIMES, effort),
                     PDN_OK);
        for (i = 0; i < TIMES; i++) {
            double rate;
            const double u = response(MASS, DAMPING, STIFFNESS, FORCE, times[i], &rate);
            CHECK_NEAR(effort[i], STIFFNESS * u + DAMPING * rate - FORCE * cos(OMEGA * times[i]),
                       1e-9);
            along[i] = -effort[i];
        }
        check_on_body(force, along);
        /* The solution keeps it, whatever becomes of the model. */
        pdn_model_free(model);
        CHECK(law.destroyed == 0);
        CHECK_STATUS(pdn_solution_sample(solution,
                                         PDN_QUANTITY(PDN_FORCE_EFFORT, force, PDN_ALL_COMPONENTS),
                                         times, TIMES, effort),
                     PDN_OK);
        pdn_solution_free(solution);
        CHECK(law.destroyed == 1);
    }
}

static void derivatives_of_a_law_are_checked(void)
{
    struct law law = {30.0, 4.0, 0, 0, 0};
    pdn_tangent_check check;
    begin_slider();
    CHECK_STATUS(pdn_model_add_coordinate_law(model, joint, PDN_DISPLACEMENT, PDN_TANGENTS_GIVEN,
                                              linear_law, &law, NULL, NULL),
                 PDN_OK);
    PDN_INIT(pdn_tangent_check, &check);
    CHECK_STATUS(pdn_model_check_tangents(model, FORCE(0), PERIOD, &check), PDN_OK);
    CHECK(check.error < 1e-7 && check.row_node == -1 && check.column_node == -1);
    law.wrong = 3.0;
    CHECK_STATUS(pdn_model_check_tangents(model, FORCE(0), PERIOD, &check), PDN_OK);
    CHECK(check.error > 0.02 && check.tangent == PDN_TANGENT_MOTION);
    CHECK_NEAR(check.given, 33.0, 1e-12);
    CHECK_NEAR(check.differenced, 30.0, 1e-5);
    CHECK(check.time >= 0 && check.time < PERIOD && check.reserved == 0);
    CHECK(check.struct_size == sizeof check);
    pdn_model_free(model);
    CHECK(law.destroyed == 0); /* nobody asked for that */
}

/* --- Forces of the user on nodes --- */

/* Two nodes at a spring with a damper along AXIS; in space. */
static int32_t two_nodes(const pdn_force_state *state, pdn_force_values *values, void *user_data)
{
    struct law *const law = user_data;
    double stretch = 0, rate = 0, effort;
    int k, l, row, column;
    CHECK(state->struct_size >= sizeof *state && values->struct_size >= sizeof *values);
    CHECK(state->node_count == 2 && state->time >= 0 && state->time < 2 * PERIOD);
    for (k = 0; k < 3; k++) {
        stretch += AXIS[k] * (state->positions[3 + k] - state->positions[k] - POINT[k]);
        rate += AXIS[k] * (state->velocities[6 + k] - state->velocities[k]);
    }
    for (k = 0; k < 18; k += 3) {
        const double *const axis = state->rotations + k;
        CHECK_NEAR(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2], 1, 1e-12);
    }
    effort = law->stiffness * stretch + law->damping * rate - FORCE * cos(OMEGA * state->time);
    for (k = 0; k < 3; k++) {
        values->forces[k] = effort * AXIS[k];
        values->forces[6 + k] = -effort * AXIS[k];
    }
    if (values->by_motion != NULL) {
        for (row = 0; row < 2; row++)
            for (column = 0; column < 2; column++)
                for (k = 0; k < 3; k++)
                    for (l = 0; l < 3; l++) {
                        const double sign = row == column ? -1 : 1;
                        const int at = 12 * (6 * column + l) + 6 * row + k;
                        values->by_motion[at] = sign * law->stiffness * AXIS[k] * AXIS[l];
                        values->by_velocity[at] = sign * law->damping * AXIS[k] * AXIS[l];
                    }
        values->by_velocity[12 * 5 + 6 + 4] += law->wrong;
    }
    law->calls++;
    return 0;
}

/* A node held at the origin, and the slider. */
static void begin_two_nodes(struct law *law, int32_t tangents)
{
    int32_t nodes[2], held, force;
    begin_slider();
    nodes[1] = body;
    CHECK_STATUS(pdn_model_add_rigid_body(model, MASS, ORIGIN, SPIN, &nodes[0]), PDN_OK);
    CHECK_STATUS(pdn_model_add_rigid_joint(model, PDN_GROUND, nodes[0], ORIGIN, &held), PDN_OK);
    CHECK_STATUS(pdn_model_add_user_force(model, nodes, 2, PDN_FRAME_SPACE, tangents, two_nodes,
                                          law, destroy, &force),
                 PDN_OK);
    CHECK(force == FORCE(0));
}

static void forces_on_two_nodes_are_the_users(void)
{
    static const int32_t tangents[] = {PDN_TANGENTS_GIVEN, PDN_TANGENTS_DIFFERENCED};
    int k, i;
    for (k = 0; k < 2; k++) {
        struct law law = {30.0, 4.0, 0, 0, 0};
        double along[TIMES], wrench[6 * TIMES];
        begin_two_nodes(&law, tangents[k]);
        solve();
        check_oscillation(0);
        for (i = 0; i < TIMES; i++) {
            double rate;
            const double u = response(MASS, DAMPING, STIFFNESS, FORCE, times[i], &rate);
            along[i] = FORCE * cos(OMEGA * times[i]) - STIFFNESS * u - DAMPING * rate;
        }
        check_on_body(FORCE(0), along);
        CHECK_STATUS(pdn_solution_sample(solution,
                                         PDN_QUANTITY(PDN_FORCE_ON_NODE, FORCE(0),
                                                      PDN_ALL_COMPONENTS, .node = NODE(1)),
                                         times, TIMES, wrench),
                     PDN_OK);
        for (i = 0; i < TIMES; i++)
            CHECK_NEAR(wrench[6 * i], -along[i] * AXIS[0], 1e-9);
        end();
        CHECK(law.destroyed == 1 && law.calls > 0);
    }
}

static void tangents_on_nodes_are_checked(void)
{
    struct law law = {30.0, 4.0, 0, 0, 0};
    pdn_tangent_check check;
    begin_two_nodes(&law, PDN_TANGENTS_GIVEN);
    PDN_INIT(pdn_tangent_check, &check);
    /* Of moment 2 of the body by angular velocity 3 of the other node. */
    law.wrong = 100.0;
    CHECK_STATUS(pdn_model_check_tangents(model, FORCE(0), PERIOD, &check), PDN_OK);
    CHECK(check.error > 0.1 && check.tangent == PDN_TANGENT_VELOCITY);
    CHECK(check.row_node == body && check.row_component == PDN_MOMENT_2);
    CHECK(check.column_node == NODE(1) && check.column_component == 5);
    CHECK_NEAR(check.given, 100.0, 1e-12);
    CHECK_NEAR(check.differenced, 0.0, 1e-6);
    law.wrong = 0.0;
    CHECK_STATUS(pdn_model_check_tangents(model, FORCE(0), PERIOD, &check), PDN_OK);
    CHECK(check.error < 1e-7);
    pdn_model_free(model);
    CHECK(law.destroyed == 1);
}

/* A moment that follows the body, about its own axis 3: -damping w3 - stiffness turn + M cos wt. */
static int32_t own_moment(const pdn_force_state *state, pdn_force_values *values, void *user_data)
{
    struct law *const law = user_data;
    const double *const R = state->rotations;
    const double turn = atan2(R[1], R[0]);
    CHECK(state->node_count == 1);
    values->forces[5] = -law->stiffness * turn - law->damping * state->velocities[5] +
                        FORCE * cos(OMEGA * state->time);
    if (values->by_motion != NULL) {
        values->by_motion[35] = -law->stiffness;
        values->by_velocity[35] = -law->damping;
    }
    law->calls++;
    return 0;
}

static void moments_may_follow_a_node(void)
{
    static const double up[3] = {0, 0, 1};
    struct law law = {30.0, 4.0, 0, 0, 0};
    double angle[TIMES], own[6 * TIMES], space[6 * TIMES];
    int i;
    begin();
    CHECK_STATUS(pdn_model_add_revolute(model, PDN_GROUND, body, POINT, up, &joint), PDN_OK);
    CHECK_STATUS(pdn_model_add_user_force(model, &body, 1, PDN_FRAME_MATERIAL, PDN_TANGENTS_GIVEN,
                                          own_moment, &law, NULL, NULL),
                 PDN_OK);
    solve();
    CHECK_STATUS(pdn_solution_sample(solution,
                                     PDN_QUANTITY(PDN_JOINT_COORDINATE, joint, PDN_ROTATION), times,
                                     TIMES, angle),
                 PDN_OK);
    CHECK_STATUS(pdn_solution_sample(solution,
                                     PDN_QUANTITY(PDN_FORCE_ON_NODE, FORCE(0), PDN_ALL_COMPONENTS,
                                                  .node = body, .frame = PDN_FRAME_MATERIAL),
                                     times, TIMES, own),
                 PDN_OK);
    CHECK_STATUS(pdn_solution_sample(
                     solution,
                     PDN_QUANTITY(PDN_FORCE_ON_NODE, FORCE(0), PDN_ALL_COMPONENTS, .node = body),
                     times, TIMES, space),
                 PDN_OK);
    for (i = 0; i < TIMES; i++) {
        double rate, moment;
        const double a = response(INERTIA, DAMPING, STIFFNESS, FORCE, times[i], &rate);
        moment = FORCE * cos(OMEGA * times[i]) - STIFFNESS * a - DAMPING * rate;
        CHECK_NEAR(angle[i], a, 1e-10);
        CHECK_NEAR(own[6 * i + 5], moment, 1e-9);
        CHECK_NEAR(space[6 * i + 5], moment, 1e-9);
    }
    end();
}

int main(void)
{
    an_actuator_drives_an_oscillator();
    polynomials_are_those_of_coordinate_and_rate();
    maxwell_branches_relax();
    a_damper_resists_by_its_matrix();
    a_law_is_the_users();
    derivatives_of_a_law_are_checked();
    forces_on_two_nodes_are_the_users();
    tangents_on_nodes_are_checked();
    moments_may_follow_a_node();
    return 0;
}
