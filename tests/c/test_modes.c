/* Modes, as users of C meet them: a pendulum with a spring and a damper, at rest and
 * in rotation. */
#include "check.h"
#include <math.h>

static const double PI = 3.14159265358979323846;
static const double MASS = 1.7, ARM = 0.8, GRAVITY = 9.81, INERTIA = 0.02;
static const double STIFFNESS = 5.0, DAMPING = 0.6;

static pdn_model *model;
static int32_t body, hinge;

/* A pendulum that hangs from a hinge about y. */
static void set_up(void)
{
    const double centre[3] = {0, 0, -ARM}, origin[3] = {0, 0, 0}, axis[3] = {0, -1, 0};
    const double gravity[3] = {0, 0, -GRAVITY};
    const double inertia[9] = {INERTIA, 0, 0, 0, INERTIA, 0, 0, 0, INERTIA};
    CHECK_STATUS(pdn_model_new(&model), PDN_OK);
    CHECK_STATUS(pdn_model_add_rigid_body(model, MASS, centre, inertia, &body), PDN_OK);
    CHECK_STATUS(pdn_model_add_revolute(model, PDN_GROUND, body, origin, axis, &hinge), PDN_OK);
    CHECK_STATUS(pdn_model_set_gravity(model, gravity), PDN_OK);
    CHECK_STATUS(
        pdn_model_add_spring_damper(model, hinge, PDN_ROTATION, STIFFNESS, DAMPING, 0, NULL),
        PDN_OK);
}

/* J s² + c s + k = 0 for the turn of the pendulum. */
static void check_mode(const pdn_modes *modes, double k)
{
    const double j = INERTIA + MASS * ARM * ARM, decay = -0.5 * DAMPING / j;
    const double size = sqrt(k / j), omega = sqrt(size * size - decay * decay);
    pdn_mode mode;
    PDN_INIT(pdn_mode, &mode);
    CHECK(mode.struct_size == sizeof mode);
    CHECK_STATUS(pdn_modes_get(modes, 0, &mode), PDN_OK);
    CHECK(fabs(mode.eigenvalue_real - decay) < 1e-12 * size);
    CHECK(fabs(mode.eigenvalue_imaginary - omega) < 1e-12 * size);
    CHECK(fabs(mode.frequency - omega / (2 * PI)) < 1e-12 * size);
    CHECK(fabs(mode.damping_ratio + decay / size) < 1e-12);
    CHECK(mode.residual < 1e-12 && mode.modal_mass > 0);
}

static void at_rest(void)
{
    const double times[2] = {0, 0.3};
    pdn_modes_options options;
    pdn_modes *modes;
    pdn_solution *still, *motion;
    pdn_mode mode;
    int32_t count, complete, nodes[2];
    double real[12], imaginary[12], position[6], angle[2], period_time[2];
    char report[600];

    PDN_INIT(pdn_modes_options, &options);
    CHECK(options.struct_size == sizeof options && options.equilibrium == NULL);
    CHECK(options.count == 10 && options.near_frequency == 0);
    CHECK_STATUS(pdn_solve_modes(model, NULL, &modes), PDN_OK);
    CHECK(pdn_modes_outcome(modes) == PDN_CONVERGED);
    CHECK_STATUS(pdn_modes_count(modes, &count, &complete), PDN_OK);
    CHECK(count == 1 && complete == 1);
    CHECK_STATUS(pdn_modes_count(modes, &count, NULL), PDN_OK);
    check_mode(modes, STIFFNESS + MASS * GRAVITY * ARM);
    CHECK(pdn_modes_report(modes, report, sizeof report) > 100);
    CHECK(strstr(report, "Modal analysis: equilibrium converged, 1 modes") != NULL);

    /* The body turns by -y, so that its centre moves by -ARM cross to it. */
    nodes[0] = nodes[1] = body;
    CHECK_STATUS(pdn_modes_shape(modes, 0, nodes, 2, real, imaginary), PDN_OK);
    CHECK(fabs(real[0] + ARM * -real[4]) < 1e-12 || fabs(real[0] - ARM * -real[4]) < 1e-12);
    CHECK(fabs(real[4]) > 0.1 && fabs(real[1]) + fabs(real[2]) + fabs(real[3]) < 1e-12);
    CHECK(memcmp(real, real + 6, 6 * sizeof *real) == 0);
    CHECK(memcmp(imaginary, imaginary + 6, 6 * sizeof *imaginary) == 0);
    CHECK_STATUS(pdn_modes_shape(modes, 0, NULL, 0, NULL, NULL), PDN_OK);

    CHECK_STATUS(pdn_modes_equilibrium(modes, &still), PDN_OK);
    CHECK_STATUS(pdn_solution_sample(still,
                                     PDN_QUANTITY(PDN_NODE_POSITION, body, PDN_ALL_COMPONENTS),
                                     times, 1, position),
                 PDN_OK);
    CHECK(fabs(position[0]) < 1e-14 && fabs(position[2] + ARM) < 1e-14);

    /* Half a period later the pendulum is on the other side. */
    PDN_INIT(pdn_mode, &mode);
    CHECK_STATUS(pdn_modes_get(modes, 0, &mode), PDN_OK);
    CHECK_STATUS(pdn_modes_motion(modes, 0, 0.1, &motion), PDN_OK);
    pdn_modes_free(modes); /* solutions stay */
    period_time[0] = 0;
    period_time[1] = 0.5 / mode.frequency;
    CHECK_STATUS(pdn_solution_sample(motion,
                                     PDN_QUANTITY(PDN_JOINT_COORDINATE, hinge, PDN_ROTATION),
                                     period_time, 2, angle),
                 PDN_OK);
    CHECK(fabs(fabs(angle[0]) - 0.1 * fabs(real[4])) < 1e-12);
    CHECK(fabs(angle[0] + angle[1]) < 1e-12);
    pdn_solution_free(still);
    pdn_solution_free(motion);
}

/* Turning about the vertical softens the pendulum by the square of the speed. */
static void in_steady_rotation(void)
{
    const double speed = 2.0;
    pdn_static_options equilibrium;
    pdn_modes_options options;
    pdn_modes *modes;
    PDN_INIT(pdn_static_options, &equilibrium);
    PDN_INIT(pdn_modes_options, &options);
    equilibrium.angular_velocity[2] = speed;
    options.equilibrium = &equilibrium;
    options.count = 1;
    options.near_frequency = 3.0;
    CHECK_STATUS(pdn_solve_modes(model, &options, &modes), PDN_OK);
    check_mode(modes, STIFFNESS + MASS * GRAVITY * ARM - MASS * ARM * ARM * speed * speed);
    pdn_modes_free(modes);
}

static int32_t told;

static int32_t stop_at_once(const pdn_progress *progress, void *data)
{
    CHECK(progress->struct_size == sizeof *progress && data == &told);
    told++;
    return 1;
}

/* Without an equilibrium there are no modes, and that is no error. */
static void no_equilibrium(void)
{
    const double origin[3] = {0, 0, 0}, inertia[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    const double gravity[3] = {0, 0, -GRAVITY};
    pdn_static_options equilibrium;
    pdn_modes_options options;
    pdn_model *falling;
    pdn_modes *modes;
    pdn_solution *last;
    int32_t node, count;
    char report[600];

    PDN_INIT(pdn_static_options, &equilibrium);
    PDN_INIT(pdn_modes_options, &options);
    equilibrium.progress = stop_at_once;
    equilibrium.progress_data = &told;
    options.equilibrium = &equilibrium;
    CHECK_STATUS(pdn_solve_modes(model, &options, &modes), PDN_OK);
    CHECK(pdn_modes_outcome(modes) == PDN_CANCELLED && told == 1);
    pdn_modes_free(modes);

    CHECK_STATUS(pdn_model_new(&falling), PDN_OK);
    CHECK_STATUS(pdn_model_add_rigid_body(falling, 1, origin, inertia, &node), PDN_OK);
    CHECK_STATUS(pdn_solve_modes(falling, NULL, &modes), PDN_OK);
    CHECK_STATUS(pdn_modes_count(modes, &count, NULL), PDN_OK);
    CHECK(pdn_modes_outcome(modes) == PDN_CONVERGED && count == 6); /* free, but nothing pulls */
    pdn_modes_free(modes);
    CHECK_STATUS(pdn_model_set_gravity(falling, gravity), PDN_OK);
    CHECK_STATUS(pdn_solve_modes(falling, NULL, &modes), PDN_OK);
    CHECK(pdn_modes_outcome(modes) == PDN_SINGULAR);
    CHECK_STATUS(pdn_modes_count(modes, &count, NULL), PDN_OK);
    CHECK(count == 0);
    CHECK(pdn_modes_report(modes, report, sizeof report) > 0);
    CHECK(strstr(report, "free to move") != NULL);
    CHECK_STATUS(pdn_modes_equilibrium(modes, &last), PDN_OK);
    CHECK(pdn_solution_outcome(last) == PDN_SINGULAR);
    pdn_solution_free(last);
    pdn_modes_free(modes);
    pdn_model_free(falling);
}

int main(void)
{
    set_up();
    at_rest();
    in_steady_rotation();
    no_equilibrium();
    pdn_model_free(model);
    pdn_modes_free(NULL);
    return 0;
}
