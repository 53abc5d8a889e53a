/* Static equilibrium and steady rotation, as users of C meet them, and what is refused. */
#include "check.h"
#include <math.h>

static const double PI = 3.14159265358979323846;
static const double MASS = 1.7, ARM = 0.8, WEIGHT = 1.7 * 9.81;

/* Arguments, each of them good. */
static struct {
    const pdn_model *model;
    pdn_static_options options;
} in;

static struct {
    pdn_solution *solution;
} out;

static int model_changed(void)
{
    return 0; /* the model is const */
}

#include "refusal.h"

static pdn_model *model;
static int32_t body, hinge;

/* A pendulum that hangs from a hinge about y, with gravity along z and a force along x. */
static void set_up(void)
{
    const double centre[3] = {0, 0, -ARM}, origin[3] = {0, 0, 0}, axis[3] = {0, -1, 0};
    const double inertia[9] = {1e-3, 0, 0, 0, 1e-3, 0, 0, 0, 1e-3}, cosines[1] = {2.0},
                 sines[1] = {5.0};
    const double gravity[3] = {0, 0, -9.81};
    pdn_signal force;
    PDN_INIT(pdn_signal, &force);
    CHECK_STATUS(pdn_signal_set_harmonics(&force, 1.0, 0, cosines, sines, 1), PDN_OK);
    CHECK_STATUS(pdn_model_new(&model), PDN_OK);
    CHECK_STATUS(pdn_model_add_rigid_body(model, MASS, centre, inertia, &body), PDN_OK);
    CHECK_STATUS(pdn_model_add_revolute(model, PDN_GROUND, body, origin, axis, &hinge), PDN_OK);
    CHECK_STATUS(pdn_model_add_load(model, body, PDN_FRAME_SPACE, PDN_FORCE_1, &force, NULL),
                 PDN_OK);
    CHECK_STATUS(pdn_model_set_gravity(model, gravity), PDN_OK);
    in.model = model;
    PDN_INIT(pdn_static_options, &in.options);
    CHECK(in.options.struct_size == sizeof in.options && in.options.load_steps == 1);
    CHECK(in.options.tolerance == 1e-9 && in.options.iteration_limit == 30);
}

static double angle_of(const pdn_solution *solution)
{
    const double time = 0.2;
    double angle;
    CHECK_STATUS(pdn_solution_sample(solution,
                                     PDN_QUANTITY(PDN_JOINT_COORDINATE, hinge, PDN_ROTATION), &time,
                                     1, &angle),
                 PDN_OK);
    return angle;
}

static int32_t iterations_told;

static int32_t stop_at_once(const pdn_progress *progress, void *data)
{
    CHECK(progress->struct_size == sizeof *progress && data == &iterations_told);
    iterations_told++;
    return 1;
}

static void equilibria(void)
{
    pdn_solution *solution, *next;
    pdn_diagnostics diagnostics;
    char report[400];
    double time;
    CHECK_STATUS(pdn_solve_static(model, NULL, &solution), PDN_OK);
    CHECK(pdn_solution_outcome(solution) == PDN_CONVERGED);
    CHECK(fabs(angle_of(solution) - atan(3.0 / WEIGHT)) < 1e-13);
    CHECK(pdn_solution_report(solution, report, sizeof report) > 0);
    CHECK(strncmp(report, "Static solve: converged", 23) == 0);
    PDN_INIT(pdn_diagnostics, &diagnostics);
    CHECK_STATUS(pdn_solution_diagnostics(solution, &diagnostics), PDN_OK);
    CHECK(diagnostics.grid_points == 1 && diagnostics.unknowns == 11);
    CHECK(diagnostics.force_residual_between < 1e-12 && diagnostics.guess_iterations > 0);
    CHECK_STATUS(pdn_solution_grid_times(solution, &time, 1), PDN_OK);

    /* The load at another time, from the solution found, with no load steps. */
    in.options.time = 0.7;
    in.options.period = 4.0;
    in.options.initial = solution;
    CHECK_STATUS(pdn_solve_static(model, &in.options, &next), PDN_OK);
    CHECK(pdn_solution_outcome(next) == PDN_CONVERGED);
    CHECK(fabs(angle_of(next) - atan((1 + 2 * cos(0.35 * PI) + 5 * sin(0.35 * PI)) / WEIGHT)) <
          1e-13);
    CHECK_STATUS(pdn_solution_diagnostics(next, &diagnostics), PDN_OK);
    CHECK(diagnostics.guess_iterations == 0);
    pdn_solution_free(next);
    pdn_solution_free(solution);

    PDN_INIT(pdn_static_options, &in.options);
    in.options.progress = stop_at_once;
    in.options.progress_data = &iterations_told;
    in.options.load_steps = 5;
    CHECK_STATUS(pdn_solve_static(model, &in.options, &solution), PDN_OK);
    CHECK(pdn_solution_outcome(solution) == PDN_CANCELLED && iterations_told == 1);
    pdn_solution_free(solution);
    PDN_INIT(pdn_static_options, &in.options);
}

/* Turning about the vertical, m l² Ω² sin q cos q + l F cos q = m g l sin q. */
static void steady_rotation(void)
{
    const double time = 0.0, speed = 3.0;
    pdn_solution *solution;
    double q, velocity[6], position[3];
    in.options.angular_velocity[2] = speed;
    CHECK_STATUS(pdn_solve_static(model, &in.options, &solution), PDN_OK);
    CHECK(pdn_solution_outcome(solution) == PDN_CONVERGED);
    q = angle_of(solution);
    CHECK(fabs(MASS * ARM * speed * speed * sin(q) * cos(q) + 3 * cos(q) - WEIGHT * sin(q)) <
          1e-12 * WEIGHT);
    CHECK(q > 0.1);
    CHECK_STATUS(pdn_solution_sample(solution,
                                     PDN_QUANTITY(PDN_NODE_POSITION, body, PDN_ALL_COMPONENTS),
                                     &time, 1, position),
                 PDN_OK);
    CHECK_STATUS(pdn_solution_sample(solution,
                                     PDN_QUANTITY(PDN_NODE_VELOCITY, body, PDN_ALL_COMPONENTS),
                                     &time, 1, velocity),
                 PDN_OK);
    CHECK(fabs(velocity[1] - speed * position[0]) < 1e-13 && fabs(velocity[0]) < 1e-13);
    CHECK(fabs(velocity[5] - speed) < 1e-13);
    pdn_solution_free(solution);
    PDN_INIT(pdn_static_options, &in.options);
}

static pdn_status solve(void)
{
    return pdn_solve_static(in.model, &in.options, &out.solution);
}

static void refusals_of_each_argument(void)
{
    static const double not_positive[] = {0.0, -1.0}, negative[] = {-1.0, -1e-300};
    static const size_t zero[] = {0}, bad_steps[] = {0, 1000001, (size_t)-1};
    static const size_t bad_struct_sizes[] = {0, 1, 7, 8, 112, 5000, (size_t)-1};
    pdn_static_options options;
    pdn_model *other;
    pdn_solution *solution;
    const double origin[3] = {0, 0, 0}, inertia[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    int32_t node;

    memset(&options, 0x5a, sizeof options);
    pdn_static_options_init(NULL, sizeof options);
    CHECK_MESSAGE("options: expected a pointer, got NULL");
    pdn_static_options_init(&options, 7);
    CHECK_MESSAGE("struct_size: expected between");

    REFUSED(pdn_solve_static(NULL, &in.options, &out.solution), PDN_ERR_NULL,
            "model: expected a pointer, got NULL");
    REFUSED(pdn_solve_static(in.model, &in.options, NULL), PDN_ERR_NULL,
            "out: expected a pointer, got NULL");
    REFUSES_EACH(in.options.struct_size, size_t, bad_struct_sizes, solve(), PDN_ERR_STRUCT_SIZE,
                 "options: expected struct_size ");
    REFUSES_NOT_FINITE(in.options.time, solve(), "options.time");
    REFUSES_NOT_FINITE(in.options.period, solve(), "options.period");
    REFUSES_EACH(in.options.period, double, negative, solve(), PDN_ERR_VALUE,
                 "options.period: expected a positive, finite number");
    REFUSES_NOT_FINITE(in.options.tolerance, solve(), "options.tolerance");
    REFUSES_EACH(in.options.tolerance, double, not_positive, solve(), PDN_ERR_VALUE,
                 "options.tolerance: expected a positive");
    REFUSES_EACH(in.options.iteration_limit, size_t, zero, solve(), PDN_ERR_VALUE,
                 "options.iteration_limit: expected at least 1");
    REFUSES_EACH(in.options.load_steps, size_t, bad_steps, solve(), PDN_ERR_VALUE,
                 "options.load_steps: expected 1 to ");
    REFUSES_NOT_FINITE_ENTRIES(in.options.angular_velocity, 3, solve(), "options.angular_velocity");
    REFUSES_NOT_FINITE_ENTRIES(in.options.axis_point, 3, solve(), "options.axis_point");

    /* Harmonics at a time of a period that was not given. */
    in.options.time = 0.3;
    REFUSED(
        solve(), PDN_ERR_VALUE,
        "options.period: expected the period of the harmonics of the signal of load 0 on node 0");
    in.options.time = 0;
    /* Gravity across the axis. */
    in.options.angular_velocity[0] = 1;
    REFUSED(solve(), PDN_ERR_NOT_PERIODIC, "gravity: expected a direction along the axis");
    in.options.angular_velocity[0] = 0;
    /* A solution of another model. */
    CHECK_STATUS(pdn_model_new(&other), PDN_OK);
    REFUSED(pdn_solve_static(other, NULL, &out.solution), PDN_ERR_MODEL,
            "model: expected at least one node, got none");
    CHECK_STATUS(pdn_model_add_rigid_body(other, 1, origin, inertia, &node), PDN_OK);
    CHECK_STATUS(pdn_solve_static(other, NULL, &solution), PDN_OK);
    CHECK(pdn_solution_outcome(solution) == PDN_SINGULAR);
    in.options.initial = solution;
    REFUSED(solve(), PDN_ERR_VALUE,
            "options.initial: expected a solution of a model with the same");
    in.options.initial = NULL;
    pdn_solution_free(solution);
    pdn_model_free(other);
}

int main(void)
{
    set_up();
    equilibria();
    steady_rotation();
    refusals_of_each_argument();
    pdn_model_free(model);
    printf("%d calls refused as they must be\n", refusals);
    return 0;
}
