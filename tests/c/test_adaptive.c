/* Grids that the library chooses: the tolerance is met, or it is said plainly that it is not. */
#include "check.h"
#include <math.h>
#include <stddef.h>

static const double PERIOD = 1.7;

/* A rod on a hinge that swings far in gravity, driven by a moment of one harmonic. */
static pdn_model *pendulum(void)
{
    const double origin[3] = {0, 0, 0}, centre[3] = {0, 0, -0.5}, axis[3] = {0, 1, 0};
    const double inertia[9] = {0.2, 0, 0, 0, 0.2, 0, 0, 0, 0.01}, down[3] = {0, 0, -9.81};
    const double cosines[1] = {9.0}, sines[1] = {0.0};
    int32_t rod, hinge;
    pdn_signal moment;
    pdn_model *model = NULL;
    PDN_INIT(pdn_signal, &moment);
    CHECK_STATUS(pdn_signal_set_harmonics(&moment, 0, 0, cosines, sines, 1), PDN_OK);
    CHECK_STATUS(pdn_model_new(&model), PDN_OK);
    CHECK_STATUS(pdn_model_add_rigid_body(model, 2, centre, inertia, &rod), PDN_OK);
    CHECK_STATUS(pdn_model_add_revolute(model, PDN_GROUND, rod, origin, axis, &hinge), PDN_OK);
    CHECK_STATUS(pdn_model_add_spring_damper(model, hinge, PDN_ROTATION, 0, 0.8, 0, NULL), PDN_OK);
    CHECK_STATUS(pdn_model_add_load(model, rod, PDN_FRAME_SPACE, PDN_MOMENT_2, &moment, NULL),
                 PDN_OK);
    CHECK_STATUS(pdn_model_set_gravity(model, down), PDN_OK);
    return model;
}

static pdn_periodic_options with_tolerance(double tolerance)
{
    pdn_periodic_options options;
    PDN_INIT(pdn_periodic_options, &options);
    CHECK(options.grid_points == 0);
    options.error_tolerance = tolerance;
    return options;
}

static pdn_solution *solve(const pdn_model *model, const pdn_periodic_options *options)
{
    pdn_solution *solution = NULL;
    CHECK_STATUS(pdn_solve_periodic(model, PERIOD, options, &solution), PDN_OK);
    return solution;
}

static pdn_diagnostics diagnostics_of(const pdn_solution *solution)
{
    pdn_diagnostics diagnostics;
    PDN_INIT(pdn_diagnostics, &diagnostics);
    CHECK_STATUS(pdn_solution_diagnostics(solution, &diagnostics), PDN_OK);
    return diagnostics;
}

static int reports(const pdn_solution *solution, const char *text)
{
    char report[4096];
    CHECK(pdn_solution_report(solution, report, sizeof report) < sizeof report);
    return strstr(report, text) != NULL;
}

/* Largest difference of the rod's position, relative to its size. */
static double difference(const pdn_solution *a, const pdn_solution *b)
{
    enum { TIMES = 50 };
    double times[TIMES], x[3 * TIMES], y[3 * TIMES], largest = 0;
    int i;
    for (i = 0; i < TIMES; i++)
        times[i] = PERIOD * i / TIMES;
    CHECK_STATUS(pdn_solution_sample(a,
                                     PDN_QUANTITY(PDN_NODE_POSITION, NODE(0), PDN_ALL_COMPONENTS),
                                     times, TIMES, x),
                 PDN_OK);
    CHECK_STATUS(pdn_solution_sample(b,
                                     PDN_QUANTITY(PDN_NODE_POSITION, NODE(0), PDN_ALL_COMPONENTS),
                                     times, TIMES, y),
                 PDN_OK);
    for (i = 0; i < 3 * TIMES; i++)
        largest = fmax(largest, fabs(x[i] - y[i]));
    return largest;
}

static void tolerances_are_met(void)
{
    pdn_model *model = pendulum();
    pdn_periodic_options fine;
    pdn_solution *exact;
    size_t before = 0;
    double tolerance;
    PDN_INIT(pdn_periodic_options, &fine);
    fine.grid_points = 75;
    exact = solve(model, &fine);
    CHECK(diagnostics_of(exact).grids == 0);
    CHECK(diagnostics_of(exact).decay == PDN_DECAY_ROUNDING);
    for (tolerance = 1e-4; tolerance > 1e-9; tolerance *= 1e-2) {
        const pdn_periodic_options options = with_tolerance(tolerance);
        pdn_solution *solution = solve(model, &options);
        const pdn_diagnostics diagnostics = diagnostics_of(solution);
        const double error = difference(solution, exact);
        CHECK(pdn_solution_outcome(solution) == PDN_CONVERGED);
        CHECK(diagnostics.error_estimate <= tolerance && diagnostics.grids >= 2);
        CHECK(error <= tolerance && error <= 10 * diagnostics.error_estimate);
        CHECK(diagnostics.grid_points > before && diagnostics.grid_points < 75);
        CHECK(diagnostics.decay == PDN_DECAY_FAST && diagnostics.decay_order > 4);
        CHECK(diagnostics.least_resolved_time >= 0 && diagnostics.least_resolved_time < PERIOD);
        CHECK(diagnostics.iterations <= (before ? 3 : 6)); /* from the grid before */
        before = diagnostics.grid_points;
        pdn_solution_free(solution);
    }
    pdn_solution_free(exact);
    pdn_model_free(model);
}

static void work_is_bounded(void)
{
    pdn_model *model = pendulum();
    pdn_periodic_options options = with_tolerance(1e-6);
    pdn_solution *solution, *none = NULL;

    CHECK(options.work_limit == 17);
    options.work_limit = 1e-9;
    solution = solve(model, &options);
    CHECK(pdn_solution_outcome(solution) == PDN_WORK_LIMIT);
    CHECK(reports(solution, "all work was done") && reports(solution, "options.work_limit"));
    pdn_solution_free(solution);

    options.work_limit = 0;
    solution = solve(model, &options);
    CHECK(pdn_solution_outcome(solution) == PDN_CONVERGED);
    pdn_solution_free(solution);

    options.work_limit = -1;
    CHECK_STATUS(pdn_solve_periodic(model, PERIOD, &options, &none), PDN_ERR_VALUE);
    pdn_model_free(model);
}

static void a_tolerance_that_is_not_met_is_said_so(void)
{
    pdn_model *model = pendulum();
    pdn_periodic_options options = with_tolerance(1e-9);
    pdn_solution *solution, *from;
    double time = 0.3, position[3];

    options.largest_grid_points = 20; /* 19 is odd */
    solution = solve(model, &options);
    CHECK(pdn_solution_outcome(solution) == PDN_TOLERANCE_NOT_MET);
    CHECK(diagnostics_of(solution).outcome == PDN_TOLERANCE_NOT_MET);
    CHECK(diagnostics_of(solution).grid_points == 19);
    CHECK(diagnostics_of(solution).error_estimate > 1e-9);
    CHECK(diagnostics_of(solution).error_estimate < 1e-1);
    CHECK(reports(solution, "tolerance is not met") && reports(solution, "1.0e-9"));
    CHECK(reports(solution, "no more than 20 grid points"));
    CHECK_STATUS(pdn_solution_sample(solution,
                                     PDN_QUANTITY(PDN_NODE_POSITION, NODE(0), PDN_ALL_COMPONENTS),
                                     &time, 1, position),
                 PDN_OK);
    pdn_solution_free(solution);

    options = with_tolerance(1e-18);
    solution = solve(model, &options);
    CHECK(pdn_solution_outcome(solution) == PDN_TOLERANCE_NOT_MET);
    CHECK(diagnostics_of(solution).decay == PDN_DECAY_ROUNDING);
    CHECK(diagnostics_of(solution).grid_points < 255);
    CHECK(reports(solution, "rounding allows no less"));

    /* The first grid is that of the given solution. */
    options = with_tolerance(1e-9);
    options.initial = solution;
    from = solve(model, &options);
    CHECK(pdn_solution_outcome(from) == PDN_CONVERGED);
    CHECK(diagnostics_of(from).grids == 1 && diagnostics_of(from).guess_iterations == 0);
    CHECK(diagnostics_of(from).grid_points == diagnostics_of(solution).grid_points);
    pdn_solution_free(from);
    pdn_solution_free(solution);
    pdn_model_free(model);
}

/* Programs of before: their struct ends where the tolerance is now. */
static void older_options_are_adaptive_with_the_defaults(void)
{
    pdn_model *model = pendulum();
    pdn_periodic_options options;
    pdn_solution *solution;
    PDN_INIT(pdn_periodic_options, &options);
    options.struct_size = offsetof(pdn_periodic_options, error_tolerance);
    options.error_tolerance = -1;
    solution = solve(model, &options);
    CHECK(pdn_solution_outcome(solution) == PDN_CONVERGED);
    CHECK(diagnostics_of(solution).error_estimate <= 1e-6);
    pdn_solution_free(solution);
    pdn_model_free(model);
}

/* Far from resolved, most of the error of collocation is what its equations alias. */
static void oversampling_leaves_out_aliases(void)
{
    pdn_model *model = pendulum();
    pdn_periodic_options options;
    pdn_solution *exact, *solution;
    double plain, sampled;
    PDN_INIT(pdn_periodic_options, &options);
    options.grid_points = 75;
    exact = solve(model, &options);
    options.grid_points = 11;
    solution = solve(model, &options);
    plain = difference(solution, exact);
    pdn_solution_free(solution);
    options.oversampling = 2;
    solution = solve(model, &options);
    sampled = difference(solution, exact);
    CHECK(pdn_solution_outcome(solution) == PDN_CONVERGED);
    CHECK(diagnostics_of(solution).grid_points == 11);
    printf("errors at 11 points: %.2e, oversampled %.2e\n", plain, sampled);
    CHECK(sampled > 1e-12 && sampled < 0.7 * plain);
    pdn_solution_free(solution);

    /* Programs that know no such option. */
    options.struct_size = offsetof(pdn_periodic_options, oversampling);
    options.oversampling = 0;
    solution = solve(model, &options);
    CHECK(difference(solution, exact) == plain);
    pdn_solution_free(solution);

    /* With grids that the library chooses. */
    options = with_tolerance(1e-6);
    options.oversampling = 3;
    solution = solve(model, &options);
    CHECK(pdn_solution_outcome(solution) == PDN_CONVERGED);
    CHECK(difference(solution, exact) <= 1e-6 && diagnostics_of(solution).grids >= 2);
    pdn_solution_free(solution);
    pdn_solution_free(exact);
    pdn_model_free(model);
}

/* At the first iteration on the second grid. */
static int32_t stop(const pdn_progress *progress, void *data)
{
    const int is_first = progress->stage == PDN_STAGE_NEWTON && progress->iteration == 1;
    return progress->iterated && is_first && ++*(int *)data > 1;
}

static void it_can_be_cancelled_on_any_grid(void)
{
    pdn_model *model = pendulum();
    pdn_periodic_options options = with_tolerance(1e-10);
    pdn_solution *solution;
    int grids = 0;
    options.progress = stop;
    options.progress_data = &grids;
    solution = solve(model, &options);
    CHECK(pdn_solution_outcome(solution) == PDN_CANCELLED && grids == 2);
    CHECK(diagnostics_of(solution).grids == 1);
    CHECK(isinf(diagnostics_of(solution).error_estimate));
    CHECK(diagnostics_of(solution).decay == PDN_DECAY_UNKNOWN);
    pdn_solution_free(solution);
    pdn_model_free(model);
}

int main(void)
{
    tolerances_are_met();
    work_is_bounded();
    a_tolerance_that_is_not_met_is_said_so();
    older_options_are_adaptive_with_the_defaults();
    oversampling_leaves_out_aliases();
    it_can_be_cancelled_on_any_grid();
    return 0;
}
