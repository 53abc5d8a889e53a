/* Marching in time, as users of C meet it, and what is refused. */
#include "oscillator.h"
#include <math.h>

/* Arguments, each of them good. */
static struct {
    const pdn_model *model;
    pdn_march_options options;
    double positions[3], rotations[9], velocities[6];
} in;

static struct {
    pdn_solution *solution;
    pdn_march_diagnostics figures;
} out;

static int model_changed(void)
{
    return 0; /* the model is const */
}

#include "refusal.h"

static pdn_model *model;
static int32_t body, slide;

static void set_up(void)
{
    model = oscillator(&body, &slide);
    in.model = model;
    PDN_INIT(pdn_march_options, &in.options);
    CHECK(in.options.struct_size == sizeof in.options && in.options.spectral_radius == 0.5);
    CHECK(in.options.most_periods == 200 && in.options.tolerance == 1e-9);
    in.options.duration = 6;
    in.options.step = 0.005;
    in.options.period = 2 * PI / OMEGA;
}

/* From x(0) = x0, x'(0) = v0, in closed form. */
static double exact(double x0, double v0, double t)
{
    const double real = STIFFNESS - MASS * OMEGA * OMEGA, imaginary = DAMPING * OMEGA;
    const double size = real * real + imaginary * imaginary;
    const double a = FORCE * real / size, b = FORCE * imaginary / size;
    const double sigma = DAMPING / (2 * MASS), w = sqrt(STIFFNESS / MASS - sigma * sigma);
    const double p = x0 - a, q = (v0 - b * OMEGA + sigma * p) / w;
    return a * cos(OMEGA * t) + b * sin(OMEGA * t) +
           exp(-sigma * t) * (p * cos(w * t) + q * sin(w * t));
}

static size_t steps_told;
static size_t stop_after;

static int32_t watch(const pdn_progress *progress, void *data)
{
    CHECK(progress->struct_size == sizeof *progress && data == &steps_told);
    if (!progress->iterated) {
        return 0; /* where the machine is slow */
    }
    CHECK(progress->stage == PDN_STAGE_MARCH && (size_t)progress->iteration == steps_told + 1);
    CHECK(progress->time > 0 && progress->residual >= 0 && progress->increment < 1);
    steps_told++;
    return steps_told == stop_after;
}

/* The largest error of the coordinate over the trajectory. */
static double error_of(const pdn_solution *solution, double x0, double v0)
{
    double worst = 0;
    int i;
    for (i = 0; i <= 150; i++) {
        const double time = 0.04 * i;
        double x, rate, position[3], velocity[6];
        CHECK_STATUS(pdn_solution_sample(
                         solution, PDN_QUANTITY(PDN_JOINT_COORDINATE, slide, PDN_DISPLACEMENT),
                         &time, 1, &x),
                     PDN_OK);
        CHECK_STATUS(pdn_solution_sample(solution,
                                         PDN_QUANTITY(PDN_JOINT_RATE, slide, PDN_DISPLACEMENT),
                                         &time, 1, &rate),
                     PDN_OK);
        CHECK_STATUS(pdn_solution_sample(solution,
                                         PDN_QUANTITY(PDN_NODE_POSITION, body, PDN_ALL_COMPONENTS),
                                         &time, 1, position),
                     PDN_OK);
        CHECK_STATUS(pdn_solution_sample(solution,
                                         PDN_QUANTITY(PDN_NODE_VELOCITY, body, PDN_ALL_COMPONENTS),
                                         &time, 1, velocity),
                     PDN_OK);
        CHECK(fabs(position[2] - x) < 1e-13 && fabs(velocity[2] - rate) < 1e-12);
        worst = fmax(worst, fabs(x - exact(x0, v0, time)));
    }
    return worst;
}

static void trajectories(void)
{
    pdn_solution *solution, *next;
    pdn_march_diagnostics figures;
    pdn_diagnostics diagnostics;
    pdn_periodic_options periodic;
    char report[600];
    double times[1201], x, mean;
    const double end = 6.0, late = 6.001;
    in.options.progress = watch;
    in.options.progress_data = &steps_told;
    CHECK_STATUS(pdn_solve_march(model, &in.options, &solution), PDN_OK);
    CHECK(pdn_solution_outcome(solution) == PDN_CONVERGED && steps_told == 1200);
    /* Second order, with steps of 0.025 radians of the free vibration. */
    CHECK(error_of(solution, 0, 0) < 1e-4);
    PDN_INIT(pdn_march_diagnostics, &figures);
    CHECK_STATUS(pdn_solution_march(solution, &figures), PDN_OK);
    CHECK(figures.steps == 1200 && figures.rejected_steps == 0 && figures.periods == 0);
    CHECK(figures.first_time == 0 && figures.last_time == 6 && figures.iterations >= 1200);
    PDN_INIT(pdn_diagnostics, &diagnostics);
    CHECK_STATUS(pdn_solution_diagnostics(solution, &diagnostics), PDN_OK);
    CHECK(diagnostics.grid_points == 1201 && diagnostics.unknowns == 11);
    CHECK_STATUS(pdn_solution_grid_times(solution, times, 1201), PDN_OK);
    CHECK(times[0] == 0 && times[1200] == 6 && fabs(times[600] - 3) < 1e-12);
    CHECK_STATUS(pdn_solution_decay(solution, NULL, 0), PDN_OK);
    CHECK(pdn_solution_report(solution, report, sizeof report) > 0);
    CHECK(strncmp(report, "March: converged", 16) == 0);
    /* No harmonics, and nothing beyond the end. */
    CHECK_STATUS(pdn_solution_harmonics(solution,
                                        PDN_QUANTITY(PDN_NODE_POSITION, body, PDN_ALL_COMPONENTS),
                                        0, &mean, NULL, NULL, NULL),
                 PDN_ERR_NOT_AVAILABLE);
    CHECK_MESSAGE("a trajectory has no harmonics");
    CHECK_STATUS(pdn_solution_sample(solution,
                                     PDN_QUANTITY(PDN_JOINT_COORDINATE, slide, PDN_DISPLACEMENT),
                                     &late, 1, &x),
                 PDN_ERR_VALUE);
    CHECK_MESSAGE("times: expected times of the trajectory, from 0 to 6, got 6.001");

    /* Its last period starts a periodic solve, its end another march, and its middle an
     * equilibrium. */
    PDN_INIT(pdn_periodic_options, &periodic);
    periodic.initial = solution;
    CHECK_STATUS(pdn_solve_periodic(model, in.options.period, &periodic, &next), PDN_OK);
    CHECK(pdn_solution_outcome(next) == PDN_CONVERGED);
    CHECK_STATUS(pdn_solution_march(next, &figures), PDN_ERR_NOT_AVAILABLE);
    pdn_solution_free(next);
    in.options.progress = NULL;
    in.options.initial = solution;
    in.options.start_time = 6;
    in.options.duration = 1;
    CHECK_STATUS(pdn_solve_march(model, &in.options, &next), PDN_OK);
    CHECK_STATUS(pdn_solution_grid_times(next, times, 201), PDN_OK);
    CHECK(times[0] == 6 && times[200] == 7);
    x = 0;
    CHECK_STATUS(pdn_solution_sample(next,
                                     PDN_QUANTITY(PDN_JOINT_COORDINATE, slide, PDN_DISPLACEMENT),
                                     &times[200], 1, &x),
                 PDN_OK);
    CHECK(fabs(x - exact(0, 0, 7)) < 1e-4);
    pdn_solution_free(next);
    in.options.start_time = 6.5;
    REFUSED(pdn_solve_march(in.model, &in.options, &out.solution), PDN_ERR_VALUE,
            "options.start_time: times: expected times of the trajectory, from 0 to 6");
    in.options.start_time = 0;
    in.options.duration = 6;

    /* From the periodic solution there is no transient. */
    CHECK_STATUS(pdn_solve_periodic(model, in.options.period, NULL, &next), PDN_OK);
    in.options.initial = next;
    pdn_solution_free(solution);
    CHECK_STATUS(pdn_solve_march(model, &in.options, &solution), PDN_OK);
    {
        double kept, other;
        CHECK_STATUS(pdn_solution_sample(
                         solution, PDN_QUANTITY(PDN_JOINT_COORDINATE, slide, PDN_DISPLACEMENT),
                         &end, 1, &kept),
                     PDN_OK);
        CHECK_STATUS(
            pdn_solution_sample(next, PDN_QUANTITY(PDN_JOINT_COORDINATE, slide, PDN_DISPLACEMENT),
                                &end, 1, &other),
            PDN_OK);
        CHECK(fabs(kept - other) < 1e-4);
    }
    pdn_solution_free(next);
    pdn_solution_free(solution);
    in.options.initial = NULL;

    /* From given motions and velocities. */
    in.positions[2] = 0.2;
    in.rotations[0] = in.rotations[4] = in.rotations[8] = 1;
    in.velocities[2] = -0.7;
    in.options.positions = in.positions;
    in.options.rotations = in.rotations;
    in.options.velocities = in.velocities;
    CHECK_STATUS(pdn_solve_march(model, &in.options, &solution), PDN_OK);
    CHECK(error_of(solution, 0.2, -0.7) < 1e-3);
    pdn_solution_free(solution);
    in.options.positions = in.options.rotations = NULL;
    CHECK_STATUS(pdn_solve_march(model, &in.options, &solution), PDN_OK);
    CHECK(error_of(solution, 0, -0.7) < 1e-3);
    pdn_solution_free(solution);
    in.options.velocities = NULL;

    /* Steps by their error. */
    in.options.error_tolerance = 1e-8;
    CHECK_STATUS(pdn_solve_march(model, &in.options, &solution), PDN_OK);
    CHECK(error_of(solution, 0, 0) < 2e-5);
    CHECK_STATUS(pdn_solution_march(solution, &figures), PDN_OK);
    CHECK(figures.step_error <= 1e-8 && figures.steps > 1200 && figures.steps < 6000);
    pdn_solution_free(solution);
    in.options.error_tolerance = 0;
}

static void until_periodic(void)
{
    pdn_solution *solution;
    pdn_march_diagnostics figures;
    in.options.duration = 0;
    in.options.step = 0;
    in.options.steps_per_period = 200;
    in.options.periodic_tolerance = 1e-5;
    in.options.stored_periods = 1;
    CHECK_STATUS(pdn_solve_march(model, &in.options, &solution), PDN_OK);
    CHECK(pdn_solution_outcome(solution) == PDN_CONVERGED);
    PDN_INIT(pdn_march_diagnostics, &figures);
    CHECK_STATUS(pdn_solution_march(solution, &figures), PDN_OK);
    CHECK(figures.periods > 10 && figures.steps == 200 * figures.periods);
    CHECK(figures.repetition <= 1e-5);
    CHECK(fabs(figures.last_time - figures.first_time - in.options.period) < 1e-9);
    pdn_solution_free(solution);

    in.options.most_periods = 2;
    CHECK_STATUS(pdn_solve_march(model, &in.options, &solution), PDN_OK);
    CHECK(pdn_solution_outcome(solution) == PDN_ITERATION_LIMIT);
    pdn_solution_free(solution);
    in.options.progress = watch;
    in.options.progress_data = &steps_told;
    steps_told = 0;
    stop_after = 5;
    CHECK_STATUS(pdn_solve_march(model, &in.options, &solution), PDN_OK);
    CHECK(pdn_solution_outcome(solution) == PDN_CANCELLED && steps_told == 5);
    pdn_solution_free(solution);
    in.options.progress = NULL;
    in.options.progress_data = NULL;
    in.options.most_periods = 200;
    in.options.periodic_tolerance = 0;
    in.options.steps_per_period = 0;
    in.options.stored_periods = 0;
    in.options.step = 0.01;
    in.options.duration = 1;
}

static pdn_status march(void)
{
    return pdn_solve_march(in.model, &in.options, &out.solution);
}

static void refusals_of_each_argument(void)
{
    static const double not_positive[] = {0.0, -1.0}, negative[] = {-1.0, -1e-300};
    static const double no_radius[] = {-0.1, 1.1}, skipped[] = {1e-7, 1e-9, 1e-300};
    static const double far_away[] = {1e17, -1e300};
    static const size_t zero[] = {0}, some[] = {10};
    static const size_t bad_struct_sizes[] = {0, 1, 7, 8, 144, 5000, (size_t)-1};
    static const size_t bad_figure_sizes[] = {0, 1, 7, 8, 80, 5000, (size_t)-1};
    pdn_march_options options;
    pdn_model *other;
    pdn_solution *solution;
    static struct {
        pdn_march_diagnostics figures;
    } figures;
    size_t i;
    const double origin[3] = {0, 0, 0}, inertia[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    int32_t node;

    memset(&options, 0x5a, sizeof options);
    pdn_march_options_init(NULL, sizeof options);
    CHECK_MESSAGE("options: expected a pointer, got NULL");
    pdn_march_options_init(&options, 7);
    CHECK_MESSAGE("struct_size: expected between");
    pdn_march_diagnostics_init(NULL, sizeof figures.figures);
    CHECK_MESSAGE("diagnostics: expected a pointer, got NULL");

    REFUSED(pdn_solve_march(NULL, &in.options, &out.solution), PDN_ERR_NULL,
            "model: expected a pointer, got NULL");
    REFUSED(pdn_solve_march(in.model, NULL, &out.solution), PDN_ERR_NULL,
            "options: expected a pointer, got NULL");
    REFUSED(pdn_solve_march(in.model, &in.options, NULL), PDN_ERR_NULL,
            "out: expected a pointer, got NULL");
    REFUSES_EACH(in.options.struct_size, size_t, bad_struct_sizes, march(), PDN_ERR_STRUCT_SIZE,
                 "options: expected struct_size ");
    REFUSES_NOT_FINITE(in.options.start_time, march(), "options.start_time");
    REFUSES_NOT_FINITE(in.options.duration, march(), "options.duration");
    REFUSES_EACH(in.options.duration, double, not_positive, march(), PDN_ERR_VALUE,
                 "options.duration: expected a positive");
    REFUSES_NOT_FINITE(in.options.period, march(), "options.period");
    REFUSES_EACH(in.options.period, double, negative, march(), PDN_ERR_VALUE,
                 "options.period: expected a positive");
    REFUSES_EACH(in.options.period, double, skipped, march(), PDN_ERR_VALUE,
                 "options.period: expected at least 1.000e-2, as steps must not skip periods");
    REFUSES_EACH(in.options.start_time, double, far_away, march(), PDN_ERR_VALUE,
                 "options.start_time: expected at most 1.000e8 in size");
    REFUSES_NOT_FINITE(in.options.step, march(), "options.step");
    REFUSES_EACH(in.options.step, double, not_positive, march(), PDN_ERR_VALUE,
                 "options.step: expected a positive");
    REFUSES_EACH(in.options.steps_per_period, size_t, some, march(), PDN_ERR_VALUE,
                 "options.step: expected zero, as options.steps_per_period is given");
    REFUSES_NOT_FINITE(in.options.spectral_radius, march(), "options.spectral_radius");
    REFUSES_EACH(in.options.spectral_radius, double, no_radius, march(), PDN_ERR_VALUE,
                 "options.spectral_radius: expected a number from 0 to 1");
    REFUSES_NOT_FINITE(in.options.error_tolerance, march(), "options.error_tolerance");
    REFUSES_EACH(in.options.error_tolerance, double, negative, march(), PDN_ERR_VALUE,
                 "options.error_tolerance: expected a positive");
    REFUSES_NOT_FINITE(in.options.periodic_tolerance, march(), "options.periodic_tolerance");
    REFUSES_EACH(in.options.periodic_tolerance, double, negative, march(), PDN_ERR_VALUE,
                 "options.duration: expected zero, as options.periodic_tolerance is given");
    in.options.duration = 0;
    REFUSES_EACH(in.options.periodic_tolerance, double, negative, march(), PDN_ERR_VALUE,
                 "options.periodic_tolerance: expected a positive");
    in.options.periodic_tolerance = 1e-3;
    REFUSES_EACH(in.options.most_periods, size_t, zero, march(), PDN_ERR_VALUE,
                 "options.most_periods: expected at least 1");
    in.options.period = 0;
    REFUSED(march(), PDN_ERR_VALUE, "options.period: expected the period that the motion repeats");
    in.options.periodic_tolerance = 0;
    in.options.duration = 1;
    REFUSED(
        march(), PDN_ERR_VALUE,
        "options.period: expected the period of the harmonics of the signal of load 0 on node 0");
    in.options.stored_periods = 1;
    REFUSED(march(), PDN_ERR_VALUE, "options.period: expected the period, to store the last");
    in.options.stored_periods = 0;
    in.options.step = 0;
    in.options.steps_per_period = 10;
    REFUSED(march(), PDN_ERR_VALUE,
            "options.period: expected the period of options.steps_per_period");
    in.options.steps_per_period = 0;
    in.options.step = 0.01;
    in.options.period = 2;
    REFUSES_NOT_FINITE(in.options.tolerance, march(), "options.tolerance");
    REFUSES_EACH(in.options.tolerance, double, not_positive, march(), PDN_ERR_VALUE,
                 "options.tolerance: expected a positive");
    REFUSES_EACH(in.options.iteration_limit, size_t, zero, march(), PDN_ERR_VALUE,
                 "options.iteration_limit: expected at least 1");

    in.options.positions = in.positions;
    REFUSED(march(), PDN_ERR_NULL, "options.rotations: expected a pointer, got NULL");
    in.options.positions = NULL;
    in.options.rotations = in.rotations;
    REFUSED(march(), PDN_ERR_NULL, "options.positions: expected a pointer, got NULL");
    in.options.positions = in.positions;
    in.options.velocities = in.velocities;
    REFUSES_NOT_FINITE_ENTRIES(in.positions, 3, march(), "options.positions");
    REFUSES_NOT_FINITE_ENTRIES(in.rotations, 9, march(), "options.rotations");
    REFUSES_NOT_FINITE_ENTRIES(in.velocities, 6, march(), "options.velocities");
    in.rotations[0] = 1.1;
    REFUSED(march(), PDN_ERR_VALUE, "options.rotations: expected rotation matrices");
    in.options.positions = in.options.rotations = in.options.velocities = NULL;

    /* A solution of another model, and the figures of one that was not marched. */
    CHECK_STATUS(pdn_model_new(&other), PDN_OK);
    REFUSED(pdn_solve_march(other, &in.options, &out.solution), PDN_ERR_MODEL,
            "model: expected at least one node, got none");
    CHECK_STATUS(pdn_model_add_rigid_body(other, 1, origin, inertia, &node), PDN_OK);
    CHECK_STATUS(pdn_solve_march(other, &in.options, &solution), PDN_OK);
    CHECK(pdn_solution_outcome(solution) == PDN_CONVERGED);
    in.options.initial = solution;
    REFUSED(march(), PDN_ERR_VALUE,
            "options.initial: expected a solution of a model with the same");
    in.options.initial = NULL;
    PDN_INIT(pdn_march_diagnostics, &figures.figures);
    REFUSED(pdn_solution_march(NULL, &figures.figures), PDN_ERR_NULL,
            "solution: expected a pointer, got NULL");
    REFUSED(pdn_solution_march(solution, NULL), PDN_ERR_NULL, "out: expected a pointer, got NULL");
    for (i = 0; i < LENGTH(bad_figure_sizes); i++) {
        figures.figures.struct_size = bad_figure_sizes[i];
        REFUSED(pdn_solution_march(solution, &figures.figures), PDN_ERR_STRUCT_SIZE,
                "out: expected struct_size ");
    }
    pdn_solution_free(solution);
    CHECK_STATUS(pdn_solve_static(in.model, NULL, &solution), PDN_OK);
    PDN_INIT(pdn_march_diagnostics, &figures.figures);
    REFUSED(pdn_solution_march(solution, &figures.figures), PDN_ERR_NOT_AVAILABLE,
            "solution: expected one of a march");
    pdn_solution_free(solution);
    pdn_model_free(other);
}

int main(void)
{
    set_up();
    trajectories();
    until_periodic();
    refusals_of_each_argument();
    pdn_model_free(model);
    printf("%d calls refused as they must be\n", refusals);
    return 0;
}
