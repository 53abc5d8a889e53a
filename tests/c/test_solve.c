/* Periodic solves: values against closed forms, options, callbacks, outcomes, lifetimes, threads.
 */
#define _POSIX_C_SOURCE 200809L
#include "check.h"
#include <math.h>
#include <pthread.h>

static const double PI = 3.14159265358979323846;

/* A body on a hinge, driven by a moment: J a'' + damping a' + stiffness a = M cos wt. */
static const double ARM = 0.5, MASS = 2.0, INERTIA = 0.3, STIFFNESS = 9.0, DAMPING = 0.7;
static const double MOMENT = 2.0, PERIOD = 1.5;

static const double ORIGIN[3] = {0, 0, 0}, AXIS[3] = {0, 0, 1}, CENTRE[3] = {0.5, 0, 0};
static const double MOMENTS_OF_INERTIA[9] = {0.2, 0, 0, 0, 0.25, 0, 0, 0, 0.3};

static double exact_angle(double period, double time)
{
    const double w = 2 * PI / period, J = INERTIA + MASS * ARM * ARM;
    const double real = STIFFNESS - J * w * w, imaginary = DAMPING * w;
    const double square = real * real + imaginary * imaginary;
    return MOMENT * (real * cos(w * time) + imaginary * sin(w * time)) / square;
}

static void cosine_moment(pdn_signal *signal)
{
    static const double cosines[1] = {2.0}, sines[1] = {0.0};
    PDN_INIT(pdn_signal, signal);
    CHECK_STATUS(pdn_signal_set_harmonics(signal, 0, 0, cosines, sines, 1), PDN_OK);
}

/* The body with its hinge, driven by the signal. */
static pdn_model *pendulum_with(const pdn_signal *signal)
{
    int32_t node, joint;
    pdn_model *model = NULL;
    CHECK_STATUS(pdn_model_new(&model), PDN_OK);
    CHECK_STATUS(pdn_model_add_rigid_body(model, MASS, CENTRE, MOMENTS_OF_INERTIA, &node), PDN_OK);
    CHECK_STATUS(pdn_model_add_revolute(model, PDN_GROUND, node, ORIGIN, AXIS, &joint), PDN_OK);
    CHECK_STATUS(
        pdn_model_add_spring_damper(model, joint, PDN_ROTATION, STIFFNESS, DAMPING, 0.0, NULL),
        PDN_OK);
    CHECK_STATUS(pdn_model_add_load(model, node, PDN_FRAME_SPACE, PDN_MOMENT_3, signal, NULL),
                 PDN_OK);
    return model;
}

static pdn_model *pendulum(void)
{
    pdn_signal signal;
    cosine_moment(&signal);
    return pendulum_with(&signal);
}

static pdn_periodic_options on_grid(size_t points)
{
    pdn_periodic_options options;
    PDN_INIT(pdn_periodic_options, &options);
    options.grid_points = points;
    return options;
}

static pdn_solution *solve(const pdn_model *model, const pdn_periodic_options *options)
{
    pdn_solution *solution = NULL;
    CHECK_STATUS(pdn_solve_periodic(model, PERIOD, options, &solution), PDN_OK);
    CHECK(solution != NULL);
    return solution;
}

/* Solves, and frees the solution: how it ended. */
static int32_t outcome_of(const pdn_model *model, const pdn_periodic_options *options)
{
    pdn_solution *solution = solve(model, options);
    const int32_t outcome = pdn_solution_outcome(solution);
    pdn_solution_free(solution);
    return outcome;
}

static pdn_diagnostics diagnostics_of(const pdn_solution *solution)
{
    pdn_diagnostics diagnostics;
    PDN_INIT(pdn_diagnostics, &diagnostics);
    CHECK_STATUS(pdn_solution_diagnostics(solution, &diagnostics), PDN_OK);
    return diagnostics;
}

/* Whether the report of a solution contains the text. */
static int reports(const pdn_solution *solution, const char *text)
{
    char report[4096];
    CHECK(pdn_solution_report(solution, report, sizeof report) < sizeof report);
    return strstr(report, text) != NULL;
}

enum { TIMES = 7 };

/* The angle at some times, not those of a grid. */
static void angles(const pdn_solution *solution, double period, double *times, double *angle)
{
    int i;
    for (i = 0; i < TIMES; i++)
        times[i] = period * (0.03 + 0.17 * i);
    CHECK_STATUS(pdn_solution_sample(solution,
                                     PDN_QUANTITY(PDN_JOINT_COORDINATE, JOINT(0), PDN_ROTATION),
                                     times, TIMES, angle),
                 PDN_OK);
}

/* The angle is the exact one, as far as the grid can show it. */
static void check_exact(const pdn_solution *solution, double period)
{
    const size_t points = diagnostics_of(solution).grid_points;
    const double tolerance = points < 11 ? 1e-6 : points < 31 ? 1e-7 : 1e-12;
    double times[TIMES], angle[TIMES];
    int i;
    CHECK(pdn_solution_outcome(solution) == PDN_CONVERGED);
    angles(solution, period, times, angle);
    for (i = 0; i < TIMES; i++)
        CHECK(fabs(angle[i] - exact_angle(period, times[i])) < tolerance);
}

/* --- Values and options --- */

static void the_response_is_that_of_the_closed_form(void)
{
    pdn_model *model = pendulum();
    pdn_solution *solution = solve(model, NULL);
    const pdn_diagnostics diagnostics = diagnostics_of(solution);
    CHECK(fabs(exact_angle(PERIOD, 0.0)) > 0.1); /* the case is no trivial one */
    check_exact(solution, PERIOD);
    CHECK(diagnostics.grid_points % 2 == 1 && diagnostics.grids > 0);
    CHECK(diagnostics.unknowns == diagnostics.grid_points * (6 + 5));
    pdn_solution_free(solution);
    pdn_model_free(model);
}

/* A beam without mass follows the moment on its end at once, here with small curvature. */
static void a_cantilever_bends_by_its_end_moment(void)
{
    const double end[3] = {2, 0, 0}, axis_2[3] = {0, 1, 0};
    const double stiffness[6] = {1e7, 4e6, 4e6, 5e3, 8e3, 6e3}, mass[4] = {0, 0, 0, 0};
    double times[TIMES], rotation[9 * TIMES];
    int i;
    pdn_section section;
    pdn_beam beam;
    pdn_signal signal;
    pdn_model *model = NULL;
    pdn_solution *solution;
    int32_t clamp;
    const pdn_periodic_options options = on_grid(15);

    PDN_INIT(pdn_section, &section);
    CHECK_STATUS(pdn_section_set_diagonal(&section, stiffness, mass), PDN_OK);
    CHECK_STATUS(pdn_model_new(&model), PDN_OK);
    CHECK_STATUS(pdn_model_add_straight_beam(model, ORIGIN, end, axis_2, &section, 2, 1, &beam),
                 PDN_OK);
    CHECK_STATUS(pdn_model_add_rigid_joint(model, PDN_GROUND, beam.first, ORIGIN, &clamp), PDN_OK);
    cosine_moment(&signal);
    CHECK_STATUS(pdn_model_add_load(model, beam.last, PDN_FRAME_SPACE, PDN_MOMENT_3, &signal, NULL),
                 PDN_OK);
    solution = solve(model, &options);
    CHECK(pdn_solution_outcome(solution) == PDN_CONVERGED);
    for (i = 0; i < TIMES; i++)
        times[i] = 0.2 * i;
    CHECK_STATUS(pdn_solution_sample(solution,
                                     PDN_QUANTITY(PDN_NODE_ROTATION, beam.last, PDN_ALL_COMPONENTS),
                                     times, TIMES, rotation),
                 PDN_OK);
    for (i = 0; i < TIMES; i++) {
        const double expected = MOMENT * cos(2 * PI / PERIOD * times[i]) * end[0] / stiffness[5];
        CHECK(fabs(atan2(rotation[9 * i + 1], rotation[9 * i]) - expected) <
              1e-6 * MOMENT * end[0] / stiffness[5]);
    }
    pdn_solution_free(solution);
    pdn_model_free(model);
}

static void options_are_heeded(void)
{
    pdn_model *model = pendulum();
    pdn_periodic_options options;
    pdn_diagnostics tight, loose;
    pdn_solution *solution;

    memset(&options, 0x5a, sizeof options);
    PDN_INIT(pdn_periodic_options, &options);
    CHECK(options.struct_size == sizeof options);
    CHECK(options.grid_points == 0 && options.harmonics == 0);
    CHECK(options.error_tolerance == 1e-6 && options.largest_grid_points == 511);
    CHECK(options.oversampling == 1);
    CHECK(options.tolerance == 1e-9 && options.iteration_limit == 30);
    CHECK(options.initial == NULL && options.guess_positions == NULL);
    CHECK(options.guess_rotations == NULL && options.progress == NULL);
    CHECK(options.progress_data == NULL);

    options.harmonics = 5; /* goes before grid_points, here one that is refused */
    options.grid_points = 4;
    solution = solve(model, &options);
    check_exact(solution, PERIOD);
    tight = diagnostics_of(solution);
    CHECK(tight.grid_points == 11 && tight.last_increment <= 1e-9);
    pdn_solution_free(solution);

    options.tolerance = 0.1;
    solution = solve(model, &options);
    loose = diagnostics_of(solution);
    CHECK(pdn_solution_outcome(solution) == PDN_CONVERGED);
    CHECK(loose.last_increment <= 0.1 && loose.iterations <= tight.iterations);
    pdn_solution_free(solution);

    options.tolerance = 1e-9;
    options.iteration_limit = 1;
    solution = solve(model, &options);
    CHECK(pdn_solution_outcome(solution) == PDN_ITERATION_LIMIT);
    CHECK(diagnostics_of(solution).iterations == 1);
    CHECK(diagnostics_of(solution).outcome == PDN_ITERATION_LIMIT);
    CHECK(reports(solution, "iteration limit"));
    pdn_solution_free(solution);

    options = on_grid(1); /* a constant: the mean of the moment is zero */
    solution = solve(model, &options);
    CHECK(diagnostics_of(solution).grid_points == 1);
    pdn_solution_free(solution);
    pdn_model_free(model);
}

/* --- Starts --- */

static pdn_model *two_bodies(void)
{
    pdn_model *model = pendulum();
    int32_t node, joint;
    CHECK_STATUS(pdn_model_add_rigid_body(model, MASS, CENTRE, MOMENTS_OF_INERTIA, &node), PDN_OK);
    CHECK_STATUS(pdn_model_add_rigid_joint(model, PDN_GROUND, node, CENTRE, &joint), PDN_OK);
    return model;
}

/* Factors and iteration, one thread and two: the same motion. */
static void linear_solvers_and_threads_agree(void)
{
    static const int32_t solvers[] = {PDN_LINEAR_DIRECT, PDN_LINEAR_ITERATIVE,
                                      PDN_LINEAR_BODY_CIRCULANT, PDN_LINEAR_TIME_LOCAL};
    pdn_model *model = pendulum();
    pdn_periodic_options options;
    size_t i;

    PDN_INIT(pdn_periodic_options, &options);
    CHECK(options.linear_solver == PDN_LINEAR_AUTOMATIC && options.threads == 1);
    options.harmonics = 5;
    for (i = 0; i < sizeof solvers / sizeof *solvers; i++) {
        pdn_diagnostics told;
        pdn_solution *solution;
        options.linear_solver = solvers[i];
        options.threads = 1 + (int32_t)(i % 2);
        solution = solve(model, &options);
        check_exact(solution, PERIOD);
        told = diagnostics_of(solution);
        if (solvers[i] == PDN_LINEAR_DIRECT) {
            CHECK(told.linear_solver == PDN_LINEAR_DIRECT && told.linear_iterations == 0);
        } else {
            CHECK(told.linear_solver == solvers[i] || solvers[i] == PDN_LINEAR_ITERATIVE);
            CHECK(told.linear_solves > 0 && told.linear_iterations >= told.linear_solves);
            CHECK(told.most_linear_iterations > 0 && told.linear_bytes > 0);
        }
        pdn_solution_free(solution);
    }
    pdn_model_free(model);
}

static void a_solve_may_start_from_a_solution(void)
{
    pdn_model *model = pendulum(), *other = two_bodies();
    pdn_periodic_options options = on_grid(11);
    pdn_solution *coarse = solve(model, &options), *fine = NULL, *unset = NULL;
    pdn_diagnostics diagnostics;

    options = on_grid(15);
    options.initial = coarse;
    fine = solve(model, &options);
    check_exact(fine, PERIOD);
    diagnostics = diagnostics_of(fine);
    CHECK(diagnostics.grid_points == 15 && diagnostics.guess_iterations == 0);
    CHECK(diagnostics.iterations <= 2);
    pdn_solution_free(fine);

    options = on_grid(9); /* a coarser grid and another period */
    options.initial = coarse;
    CHECK_STATUS(pdn_solve_periodic(model, 0.8 * PERIOD, &options, &fine), PDN_OK);
    CHECK(pdn_solution_outcome(fine) == PDN_CONVERGED);
    check_exact(fine, 0.8 * PERIOD);
    pdn_solution_free(fine);

    CHECK_STATUS(pdn_solve_periodic(other, PERIOD, &options, &unset), PDN_ERR_VALUE);
    CHECK_MESSAGE("options.initial: expected a solution of a model with the same");
    CHECK(unset == NULL);

    /* One that has not converged will do as well. */
    options = on_grid(11);
    options.iteration_limit = 1;
    fine = solve(model, &options);
    CHECK(pdn_solution_outcome(fine) == PDN_ITERATION_LIMIT);
    options.iteration_limit = 30;
    options.initial = fine;
    pdn_solution_free(coarse);
    coarse = solve(model, &options);
    check_exact(coarse, PERIOD);
    pdn_solution_free(fine);
    pdn_solution_free(coarse);
    pdn_model_free(model);
    pdn_model_free(other);
}

enum { GUESS_POINTS = 11, GUESS_NODES = 2 };

/* Coordinates fastest, then grid points, then nodes: two nodes, to see the order. */
static void a_solve_may_start_from_given_motions(void)
{
    pdn_model *model = two_bodies();
    pdn_periodic_options options = on_grid(GUESS_POINTS);
    pdn_solution *first = solve(model, &options), *second;
    pdn_diagnostics diagnostics;
    double times[GUESS_POINTS];
    double positions[GUESS_NODES][3 * GUESS_POINTS], rotations[GUESS_NODES][9 * GUESS_POINTS];
    int32_t node;

    CHECK_STATUS(pdn_solution_grid_times(first, times, GUESS_POINTS), PDN_OK);
    for (node = 0; node < GUESS_NODES; node++) {
        CHECK_STATUS(pdn_solution_sample(
                         first, PDN_QUANTITY(PDN_NODE_POSITION, NODE(node), PDN_ALL_COMPONENTS),
                         times, GUESS_POINTS, positions[node]),
                     PDN_OK);
        CHECK_STATUS(pdn_solution_sample(
                         first, PDN_QUANTITY(PDN_NODE_ROTATION, NODE(node), PDN_ALL_COMPONENTS),
                         times, GUESS_POINTS, rotations[node]),
                     PDN_OK);
    }
    pdn_solution_free(first);
    options.guess_positions = positions[0];
    options.guess_rotations = rotations[0];
    second = solve(model, &options);
    check_exact(second, PERIOD);
    diagnostics = diagnostics_of(second);
    CHECK(diagnostics.guess_iterations == 0 && diagnostics.iterations <= 2);
    pdn_solution_free(second);
    pdn_model_free(model);
}

/* Grid points closer together about two events; a solve on others that goes on from there. */
static void grid_points_may_be_closer_together(void)
{
    enum { POINTS = 61, EVENTS = 2 };
    const double times[EVENTS] = {0.3 * PERIOD, 0.8 * PERIOD}, shares[EVENTS] = {0.8, 0.5};
    double widths[EVENTS] = {0.1 * PERIOD, 0.15 * PERIOD};
    double grid[POINTS], found_times[EVENTS], found_widths[EVENTS], found_shares[EVENTS];
    double at[TIMES], angle[TIMES];
    pdn_model *model = two_bodies();
    pdn_periodic_options options = on_grid(POINTS);
    pdn_solution *mapped, *unset = NULL;
    size_t count = 99;
    int i;

    options.time_map = PDN_TIME_MAP_EVENTS;
    options.event_count = EVENTS;
    options.event_times = times;
    options.event_widths = widths;
    options.event_shares = shares;
    mapped = solve(model, &options);
    angles(mapped, PERIOD, at, angle);
    /* A steady oscillation is not sharp: mapped points have half the digits for it. */
    for (i = 0; i < TIMES; i++)
        CHECK(fabs(angle[i] - exact_angle(PERIOD, at[i])) < 1e-6);
    CHECK_STATUS(pdn_solution_grid_times(mapped, grid, POINTS), PDN_OK);
    CHECK(grid[0] == 0);
    for (i = 1; i < POINTS; i++)
        CHECK(grid[i] > grid[i - 1] && grid[i] < PERIOD);
    CHECK_STATUS(pdn_solution_sharp_event_count(mapped, &count), PDN_OK);
    CHECK(count == EVENTS);
    CHECK_STATUS(pdn_solution_sharp_events(mapped, found_times, found_widths, found_shares, EVENTS),
                 PDN_OK);
    for (i = 0; i < EVENTS; i++) {
        CHECK(fabs(found_times[i] - times[i]) < 1e-12 * PERIOD);
        CHECK(fabs(found_widths[i] - widths[i]) < 1e-12 * PERIOD);
        CHECK(found_shares[i] == shares[i]);
    }
    CHECK_STATUS(pdn_solution_sharp_events(mapped, found_times, found_widths, found_shares, 1),
                 PDN_ERR_SIZE);
    pdn_solution_free(mapped);

    widths[1] = 0;
    CHECK_STATUS(pdn_solve_periodic(model, PERIOD, &options, &unset), PDN_ERR_VALUE);
    CHECK_MESSAGE("events[1].width");
    options.event_count = 0;
    CHECK_STATUS(pdn_solve_periodic(model, PERIOD, &options, &unset), PDN_ERR_SIZE);
    CHECK_MESSAGE("options.event_count");
    options.time_map = 3;
    CHECK_STATUS(pdn_solve_periodic(model, PERIOD, &options, &unset), PDN_ERR_VALUE);
    CHECK_MESSAGE("options.time_map");
    CHECK(unset == NULL);
    options.time_map = PDN_TIME_MAP_EQUISPACED;
    mapped = solve(model, &options);
    CHECK_STATUS(pdn_solution_sharp_event_count(mapped, &count), PDN_OK);
    CHECK(count == 0);
    pdn_solution_free(mapped);
    pdn_model_free(model);
}

/* --- Progress --- */

struct progress_log {
    int calls, cancel_at;
    int stages[2]; /* the initial guess, Newton's method */
    int32_t last_stage, last_iteration;
    double last_increment, elapsed;
};

static int32_t watch(const pdn_progress *progress, void *user_data)
{
    struct progress_log *log = user_data;
    CHECK(progress->struct_size == sizeof *progress);
    CHECK(progress->stage == PDN_STAGE_INITIAL_GUESS || progress->stage == PDN_STAGE_NEWTON);
    CHECK(progress->elapsed >= log->elapsed && progress->grid_points == 5);
    CHECK(progress->attempt == 1 && progress->start == PDN_START_QUASI_STATIC);
    log->elapsed = progress->elapsed;
    if (!progress->iterated) {
        return 0; /* where the machine is slow */
    }
    CHECK(progress->iteration == 1 ||
          (progress->stage == log->last_stage && progress->iteration == log->last_iteration + 1));
    CHECK(progress->residual >= 0 && progress->increment >= 0);
    CHECK(progress->step >= 0 && progress->step <= 1);
    log->last_stage = progress->stage;
    log->last_iteration = progress->iteration;
    log->last_increment = progress->increment;
    log->stages[progress->stage - PDN_STAGE_INITIAL_GUESS]++;
    log->calls++;
    return log->calls == log->cancel_at ? -3 : 0;
}

static void progress_is_told_and_may_cancel(void)
{
    pdn_model *model = pendulum();
    pdn_periodic_options options = on_grid(5);
    struct progress_log log = {0}, full;
    pdn_solution *solution;
    pdn_diagnostics diagnostics;
    int at;

    options.progress = watch;
    options.progress_data = &log;
    solution = solve(model, &options);
    diagnostics = diagnostics_of(solution);
    CHECK(pdn_solution_outcome(solution) == PDN_CONVERGED);
    CHECK(log.stages[1] == diagnostics.iterations);
    CHECK(log.stages[0] == diagnostics.guess_iterations);
    CHECK(log.last_stage == PDN_STAGE_NEWTON && log.last_increment == diagnostics.last_increment);
    CHECK(log.stages[0] > 0 && log.stages[1] > 1);
    pdn_solution_free(solution);

    /* Cancelled wherever it is asked for, and not called again. The last iteration has converged.
     */
    full = log;
    for (at = 1; at < full.calls; at += at < full.stages[0] - 3 ? 7 : 1) {
        memset(&log, 0, sizeof log);
        log.cancel_at = at;
        solution = solve(model, &options);
        CHECK(pdn_solution_outcome(solution) == PDN_CANCELLED);
        CHECK(log.calls == at);
        CHECK(reports(solution, "cancelled"));
        pdn_solution_free(solution);
    }
    memset(&log, 0, sizeof log);
    log.cancel_at = full.calls;
    CHECK(outcome_of(model, &options) == PDN_CANCELLED); /* before errors are estimated */
    pdn_model_free(model);
}

struct counter {
    int calls, within, cancel_at;
};

static int32_t count(const pdn_progress *progress, void *user_data)
{
    struct counter *counter = user_data;
    counter->within += !progress->iterated;
    return ++counter->calls == counter->cancel_at;
}

/* Also within iterations, at any opportunity. */
static void a_solve_is_cancelled_within_iterations(void)
{
    pdn_model *model = pendulum();
    pdn_periodic_options options = on_grid(5);
    struct counter all = {0};
    options.progress = count;
    options.progress_data = &all;
    options.progress_interval = 0;
    CHECK(outcome_of(model, &options) == PDN_CONVERGED);
    CHECK(all.within > all.calls - all.within);
    for (int at = 1; at <= all.calls; at += 1 + all.calls / 50) {
        struct counter counter = {0, 0, at};
        options.progress_data = &counter;
        CHECK(outcome_of(model, &options) == PDN_CANCELLED);
        CHECK(counter.calls == at);
    }
    options.progress_interval = -1;
    CHECK(pdn_solve_periodic(model, PERIOD, &options, &(pdn_solution *){NULL}) == PDN_ERR_VALUE);
    pdn_model_free(model);
}

static void the_start_may_be_chosen(void)
{
    pdn_model *model = pendulum();
    pdn_periodic_options options = on_grid(11);
    pdn_solution *solution, *none = NULL;
    CHECK(options.start == PDN_START_AUTOMATIC && options.progress_interval == 0.1);
    const int32_t starts[] = {PDN_START_QUASI_STATIC, PDN_START_RAISED_INERTIA, PDN_START_MARCH,
                              PDN_START_LOWERED_DAMPING, PDN_START_RAISED_LOADS};
    const char *const names[] = {"the quasi-static motion on", "raising inertial forces",
                                 "a dissipative march", "added damping", "raising loads"};
    for (int i = 0; i < 5; ++i) {
        options.start = starts[i];
        solution = solve(model, &options);
        check_exact(solution, PERIOD);
        const pdn_diagnostics found = diagnostics_of(solution);
        CHECK((i == 0 || found.attempts == 1) && found.total_iterations >= found.iterations);
        CHECK(i == 0 || reports(solution, names[i]));
        pdn_solution_free(solution);
    }
    options.start = PDN_START_RIGID_ROTATION; /* nothing turns */
    CHECK(outcome_of(model, &options) == PDN_NO_INITIAL_GUESS);
    options.start = 8;
    CHECK(pdn_solve_periodic(model, PERIOD, &options, &none) == PDN_ERR_VALUE);
    CHECK_MESSAGE("options.start: expected a constant PDN_START_...");
    options.start = PDN_START_AUTOMATIC;
    solution = solve(model, &options);
    options.start = PDN_START_MARCH;
    options.initial = solution;
    CHECK(pdn_solve_periodic(model, PERIOD, &options, &none) == PDN_ERR_VALUE && none == NULL);
    CHECK_MESSAGE("options.start: expected PDN_START_AUTOMATIC");
    pdn_solution_free(solution);
    pdn_model_free(model);
}

/* --- Signals that are functions --- */

struct function {
    double amplitude, phase, growth;
    int calls, fail_at;
    int32_t code;
    const char *text;
    int writes;
};

static int32_t drive(double time, double *value, void *user_data)
{
    struct function *function = user_data;
    function->calls++;
    if (function->fail_at == 0 || function->calls < function->fail_at) {
        *value = function->amplitude * cos(2 * PI * time / PERIOD - function->phase) +
                 function->growth * time;
        return 0;
    }
    if (function->text != NULL)
        CHECK_STATUS(pdn_set_callback_error(function->text), PDN_OK);
    if (function->writes)
        *value = (double)NAN;
    return function->code;
}

static pdn_model *pendulum_driven_by(struct function *function)
{
    pdn_signal signal;
    PDN_INIT(pdn_signal, &signal);
    CHECK_STATUS(pdn_signal_set_function(&signal, drive, function), PDN_OK);
    return pendulum_with(&signal);
}

static void a_function_drives(void)
{
    struct function function = {0};
    pdn_model *model;
    pdn_periodic_options options = on_grid(11);
    pdn_solution *solution;
    function.amplitude = MOMENT;
    model = pendulum_driven_by(&function);
    CHECK(function.calls == 0);
    solution = solve(model, &options);
    CHECK(function.calls > 0);
    check_exact(solution, PERIOD);
    pdn_solution_free(solution);
    pdn_model_free(model);
}

/* Rounding makes sin 2 pi differ from sin 0, where the function is zero. */
static void a_function_may_start_at_zero(void)
{
    struct function function = {0};
    pdn_model *model = pendulum_driven_by(&function);
    const pdn_periodic_options options = on_grid(5);
    CHECK(outcome_of(model, &options) == PDN_CONVERGED); /* zero all the time */
    function.amplitude = MOMENT;
    function.phase = 0.5 * PI;
    CHECK(outcome_of(model, &options) == PDN_CONVERGED);
    pdn_model_free(model);
}

static void a_failing_function_fails_the_solve(void)
{
    static const struct {
        int32_t code;
        const char *text;
        int writes;
        const char *said;
    } cases[] = {
        {1, NULL, 0, "the callback returned 1"},
        {-7, NULL, 1, "the callback returned -7"},
        {INT32_MIN, "no data before noon", 0, "returned -2147483648: no data before noon"},
        {5,
         "Stra\xc3\x9f"
         "e",
         0,
         "returned 5: Stra\xc3\x9f"
         "e"},
        {0, NULL, 1, "expected a finite number at t = "},
        {0, NULL, 0, "expected a finite number at t = "}, /* nothing written */
    };
    struct function function = {0};
    pdn_model *model;
    pdn_periodic_options options = on_grid(5);
    size_t i;
    int all, at, last = 0;

    function.amplitude = MOMENT;
    model = pendulum_driven_by(&function);
    CHECK(pdn_last_callback_code() == 0);
    CHECK(outcome_of(model, &options) == PDN_CONVERGED);
    all = function.calls;
    for (i = 0; i < sizeof cases / sizeof *cases; i++) {
        const int32_t before = pdn_last_callback_code();
        char canary;
        pdn_solution *const untouched = (pdn_solution *)(void *)&canary, *out = untouched;
        memset(&function, 0, sizeof function);
        function.fail_at = 1;
        function.code = cases[i].code;
        function.text = cases[i].text;
        function.writes = cases[i].writes;
        CHECK_STATUS(pdn_solve_periodic(model, PERIOD, &options, &out), PDN_ERR_CALLBACK);
        CHECK_MESSAGE(cases[i].said);
        CHECK_MESSAGE("load 0 on node 0: signal");
        CHECK(out == untouched && function.calls == 1);
        CHECK(pdn_last_callback_code() == (function.code != 0 ? function.code : before));
    }

    /* Wherever it fails. */
    for (at = 2; at <= all; at += at < 4 || at > all - 3 ? 1 : 9) {
        pdn_solution *out = NULL;
        memset(&function, 0, sizeof function);
        function.amplitude = MOMENT;
        function.fail_at = at;
        function.code = at;
        CHECK_STATUS(pdn_solve_periodic(model, PERIOD, &options, &out), PDN_ERR_CALLBACK);
        CHECK(out == NULL && function.calls == at && pdn_last_callback_code() == at);
        last = at;
    }

    /* It recovers, and success leaves the number. */
    memset(&function, 0, sizeof function);
    function.amplitude = MOMENT;
    CHECK(outcome_of(model, &options) == PDN_CONVERGED);
    CHECK(pdn_last_callback_code() == last);

    /* What grows is no load of this period. */
    function.growth = 0.5;
    {
        pdn_solution *out = NULL;
        CHECK_STATUS(pdn_solve_periodic(model, PERIOD, &options, &out), PDN_ERR_NOT_PERIODIC);
        CHECK(out == NULL);
    }
    pdn_model_free(model);
}

/* --- Outcomes that are no solution --- */

static void a_free_body_is_named(void)
{
    const double beside[3] = {3, 0, 0};
    pdn_model *model = pendulum();
    pdn_periodic_options options = on_grid(5);
    pdn_solution *solution;
    int32_t node;
    CHECK_STATUS(pdn_model_add_rigid_body(model, MASS, beside, MOMENTS_OF_INERTIA, &node), PDN_OK);
    solution = solve(model, &options);
    CHECK(pdn_solution_outcome(solution) == PDN_SINGULAR);
    CHECK(reports(solution, "singular") && reports(solution, "node 1 is free to move"));
    pdn_solution_free(solution);
    pdn_model_free(model);
}

/* The same hinge twice: its reactions are halved; about another axis it is a lock. */
static void joints_too_many_are_tolerated_or_named(void)
{
    const double across[3] = {1, 0, 0}, instant = 0.4;
    pdn_model *model = pendulum();
    pdn_periodic_options options = on_grid(5);
    pdn_solution *solution = solve(model, &options);
    pdn_signal swing;
    double single[6], half[6];
    int32_t joint, i;
    CHECK_STATUS(pdn_solution_sample(solution,
                                     PDN_QUANTITY(PDN_JOINT_REACTION, JOINT(0), PDN_ALL_COMPONENTS),
                                     &instant, 1, single),
                 PDN_OK);
    pdn_solution_free(solution);
    CHECK_STATUS(pdn_model_add_revolute(model, PDN_GROUND, NODE(0), ORIGIN, AXIS, &joint), PDN_OK);
    solution = solve(model, &options);
    CHECK(pdn_solution_outcome(solution) == PDN_CONVERGED);
    CHECK(reports(solution, "5 redundant constraints among joints 0, 1"));
    CHECK_STATUS(pdn_solution_sample(solution,
                                     PDN_QUANTITY(PDN_JOINT_REACTION, joint, PDN_ALL_COMPONENTS),
                                     &instant, 1, half),
                 PDN_OK);
    for (i = 0; i < 6; ++i)
        CHECK(fabs(half[i] - 0.5 * single[i]) < 1e-9 * (1.0 + fabs(single[i])));
    pdn_solution_free(solution);
    pdn_model_free(model);

    model = pendulum();
    CHECK_STATUS(pdn_model_add_revolute(model, PDN_GROUND, NODE(0), ORIGIN, across, &joint),
                 PDN_OK);
    cosine_moment(&swing);
    CHECK_STATUS(pdn_model_prescribe(model, JOINT(0), PDN_ROTATION, &swing, NULL), PDN_OK);
    solution = solve(model, &options);
    CHECK(pdn_solution_outcome(solution) == PDN_INCONSISTENT);
    CHECK(reports(solution, "locked") && reports(solution, "joints 0, 1"));
    pdn_solution_free(solution);
    pdn_model_free(model);
}

/* --- Lifetimes --- */

static void a_solution_outlives_its_model(void)
{
    pdn_model *model = pendulum();
    pdn_periodic_options options = on_grid(11);
    pdn_solution *solution = solve(model, &options), *later;
    double times[TIMES], before[TIMES], after[TIMES];
    const double gravity[3] = {0, -9.81, 0};
    int32_t node, joint;

    angles(solution, PERIOD, times, before);
    CHECK_STATUS(pdn_model_set_gravity(model, gravity), PDN_OK);
    CHECK_STATUS(pdn_model_add_spring_damper(model, JOINT(0), PDN_ROTATION, 100, 0, 0.4, NULL),
                 PDN_OK);
    CHECK_STATUS(pdn_model_add_rigid_body(model, MASS, CENTRE, MOMENTS_OF_INERTIA, &node), PDN_OK);
    CHECK_STATUS(pdn_model_add_rigid_joint(model, NODE(0), node, CENTRE, &joint), PDN_OK);
    angles(solution, PERIOD, times, after);
    CHECK(memcmp(before, after, sizeof before) == 0);
    CHECK_STATUS(pdn_solution_sample(solution,
                                     PDN_QUANTITY(PDN_NODE_POSITION, node, PDN_ALL_COMPONENTS),
                                     times, 0, NULL),
                 PDN_ERR_ID);

    later = solve(model, &options);
    pdn_model_free(model); /* before its solutions */
    angles(solution, PERIOD, times, after);
    CHECK(memcmp(before, after, sizeof before) == 0);
    check_exact(solution, PERIOD);
    pdn_solution_free(solution); /* before the later one */
    CHECK(pdn_solution_outcome(later) == PDN_CONVERGED);
    CHECK_STATUS(pdn_solution_sample(later,
                                     PDN_QUANTITY(PDN_NODE_POSITION, node, PDN_ALL_COMPONENTS),
                                     times, 0, NULL),
                 PDN_OK);
    pdn_solution_free(later);
}

static void freeing_goes_in_any_order(void)
{
    pdn_periodic_options options = on_grid(5);
    pdn_model *model = pendulum();
    pdn_solution *first = solve(model, &options), *second;
    options.initial = first;
    second = solve(model, &options);
    pdn_solution_free(first); /* before the solution that it started */
    CHECK(pdn_solution_outcome(second) == PDN_CONVERGED);
    pdn_solution_free(second);
    pdn_model_free(model); /* after */
    pdn_solution_free(NULL);
    pdn_model_free(NULL);
}

/* --- Structs of programs that are older or newer --- */

/* A struct with room behind it, which the library takes for the struct's own if told so. */
#define WITH_ROOM(type)                                                                            \
    struct {                                                                                       \
        type known;                                                                                \
        unsigned char room[32];                                                                    \
    }

/* The initialiser keeps to the size it is given, and sets what it does not know to zero. */
#define CHECK_INITIALISER(type)                                                                    \
    do {                                                                                           \
        WITH_ROOM(type) in;                                                                        \
        unsigned char *const bytes = (unsigned char *)&in;                                         \
        size_t size, i;                                                                            \
        for (size = sizeof(size_t); size <= sizeof in; size += sizeof(size_t)) {                   \
            memset(&in, 0x5a, sizeof in);                                                          \
            type##_init(&in.known, size);                                                          \
            CHECK(in.known.struct_size == size);                                                   \
            for (i = sizeof(type); i < size; i++)                                                  \
                CHECK(bytes[i] == 0);                                                              \
            for (i = size; i < sizeof in; i++)                                                     \
                CHECK(bytes[i] == 0x5a);                                                           \
        }                                                                                          \
    } while (0)

/* A shorter or unset struct is refused, a longer one only if it sets what is not known here. */
#define CHECK_READER(type, call)                                                                   \
    do {                                                                                           \
        static const size_t wrong[] = {0,    1,         7, 8, sizeof(type) - 4, sizeof(type) - 1,  \
                                       5000, (size_t)-1};                                          \
        size_t i;                                                                                  \
        memset(&in, 0x5a, sizeof in);                                                              \
        type##_init(&in.known, sizeof in);                                                         \
        CHECK_STATUS(call, PDN_OK);                                                                \
        CHECK(in.known.struct_size == sizeof in);                                                  \
        for (i = 0; i < sizeof in.room; i++) {                                                     \
            CHECK(in.room[i] == 0);                                                                \
            in.room[i] = 1;                                                                        \
            CHECK_STATUS(call, PDN_ERR_STRUCT_SIZE);                                               \
            CHECK_MESSAGE("an option is set that this version of the library does not know");      \
            in.room[i] = 0;                                                                        \
        }                                                                                          \
        memset(in.room, 0x5a, sizeof in.room);                                                     \
        type##_init(&in.known, sizeof in.known);                                                   \
        CHECK_STATUS(call, PDN_OK);                                                                \
        for (i = 0; i < sizeof in.room; i++)                                                       \
            CHECK(in.room[i] == 0x5a);                                                             \
        for (i = 0; i < sizeof wrong / sizeof *wrong; i++) {                                       \
            in.known.struct_size = wrong[i];                                                       \
            CHECK_STATUS(call, PDN_ERR_STRUCT_SIZE);                                               \
            CHECK_MESSAGE("expected struct_size ");                                                \
        }                                                                                          \
    } while (0)

static pdn_status solve_and_free(const pdn_model *model, const pdn_periodic_options *options)
{
    pdn_solution *solution = NULL;
    const pdn_status status = pdn_solve_periodic(model, PERIOD, options, &solution);
    CHECK((status == PDN_OK) == (solution != NULL));
    pdn_solution_free(solution);
    return status;
}

/* As a struct of options, but the library has to fill it. */
static pdn_status diagnose(const pdn_solution *solution, pdn_diagnostics *out)
{
    const pdn_status status = pdn_solution_diagnostics(solution, out);
    if (status == PDN_OK)
        CHECK(out->grid_points == 3 && out->iterations > 0);
    return status;
}

static void structs_may_grow(void)
{
    pdn_model *model = pendulum();
    const pdn_periodic_options options = on_grid(3);
    pdn_solution *solution = solve(model, &options);

    CHECK_INITIALISER(pdn_periodic_options);
    CHECK_INITIALISER(pdn_diagnostics);
    {
        WITH_ROOM(pdn_periodic_options) in;
        CHECK_READER(pdn_periodic_options, solve_and_free(model, &in.known));
    }
    {
        WITH_ROOM(pdn_diagnostics) in;
        CHECK_READER(pdn_diagnostics, diagnose(solution, &in.known));
    }
    pdn_solution_free(solution);
    pdn_model_free(model);
}

/* --- Threads --- */

struct work {
    pthread_t thread;
    const pdn_model *model;
    const pdn_solution *shared;
    double expected[TIMES];
};

static void *solve_and_read(void *argument)
{
    struct work *work = argument;
    pdn_model *own = pendulum();
    pdn_periodic_options options = on_grid(7);
    double times[TIMES], angle[TIMES];
    int round;
    CHECK(pdn_last_error(NULL, 0) == 0); /* each thread has its own message */
    for (round = 0; round < 3; round++) {
        pdn_solution *alone = solve(own, &options), *together = solve(work->model, &options);
        CHECK(pdn_solution_outcome(alone) == PDN_CONVERGED);
        angles(together, PERIOD, times, angle);
        CHECK(memcmp(angle, work->expected, sizeof angle) == 0);
        angles(alone, PERIOD, times, angle);
        CHECK(memcmp(angle, work->expected, sizeof angle) == 0);
        angles(work->shared, PERIOD, times, angle);
        CHECK(memcmp(angle, work->expected, sizeof angle) == 0);
        pdn_solution_free(alone);
        pdn_solution_free(together);
    }
    CHECK_STATUS(pdn_solve_periodic(own, 0.0, &options, NULL), PDN_ERR_NULL);
    pdn_model_free(own);
    return NULL;
}

/* Distinct handles, one model that both solve, and one solution that both read. */
static void threads_work_side_by_side(void)
{
    enum { THREADS = 2 };
    struct work work[THREADS];
    double times[TIMES], expected[TIMES];
    pdn_model *model = pendulum();
    pdn_periodic_options options = on_grid(7);
    pdn_solution *shared = solve(model, &options);
    char before[256], after[256];
    int i;

    angles(shared, PERIOD, times, expected);
    CHECK_STATUS(pdn_solve_periodic(NULL, PERIOD, NULL, NULL), PDN_ERR_NULL);
    pdn_last_error(before, sizeof before);
    for (i = 0; i < THREADS; i++) {
        work[i].model = model;
        work[i].shared = shared;
        memcpy(work[i].expected, expected, sizeof expected);
        CHECK(pthread_create(&work[i].thread, NULL, solve_and_read, &work[i]) == 0);
    }
    for (i = 0; i < THREADS; i++)
        CHECK(pthread_join(work[i].thread, NULL) == 0);
    pdn_last_error(after, sizeof after);
    CHECK(strcmp(before, after) == 0);
    pdn_solution_free(shared);
    pdn_model_free(model);
}

int main(void)
{
    the_response_is_that_of_the_closed_form();
    a_cantilever_bends_by_its_end_moment();
    options_are_heeded();
    linear_solvers_and_threads_agree();
    a_solve_may_start_from_a_solution();
    a_solve_may_start_from_given_motions();
    grid_points_may_be_closer_together();
    progress_is_told_and_may_cancel();
    a_solve_is_cancelled_within_iterations();
    the_start_may_be_chosen();
    a_function_drives();
    a_function_may_start_at_zero();
    a_failing_function_fails_the_solve();
    a_free_body_is_named();
    joints_too_many_are_tolerated_or_named();
    a_solution_outlives_its_model();
    freeing_goes_in_any_order();
    structs_may_grow();
    threads_work_side_by_side();
    return 0;
}
