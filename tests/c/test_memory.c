/* Memory that cannot be had, or that the caller does not allow, is PDN_ERR_MEMORY, with the bytes
   asked for; never the end of the process. Each case is a process of its own with little memory. */
/* For fork and setrlimit. */
#define _XOPEN_SOURCE 700
#include "driven_arm.h"
#include "near.h"
#include <stdint.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#define MIB ((size_t)1 << 20)

/* What this process has now. */
static size_t bytes_taken(void)
{
    size_t pages = 0;
    FILE *const file = fopen("/proc/self/statm", "r");
    CHECK(file != NULL && fscanf(file, "%zu", &pages) == 1);
    fclose(file);
    return pages * (size_t)sysconf(_SC_PAGESIZE);
}

/* Leaves this process so many bytes more than it has now. */
static void leave(size_t bytes)
{
    struct rlimit limit;
    limit.rlim_cur = limit.rlim_max = bytes_taken() + bytes;
    CHECK(setrlimit(RLIMIT_AS, &limit) == 0);
}

static pdn_model *model;
static driven_arm parts;

/* A solve of little still works. */
static void still_works(void)
{
    pdn_periodic_options options;
    pdn_solution *solution = NULL;
    PDN_INIT(pdn_periodic_options, &options);
    options.grid_points = 5;
    CHECK_STATUS(pdn_solve_periodic(model, 2, &options, &solution), PDN_OK);
    CHECK(pdn_solution_outcome(solution) == PDN_CONVERGED);
    pdn_solution_free(solution);
}

static void huge_grid(void)
{
    pdn_periodic_options options;
    pdn_solution *solution = NULL;
    PDN_INIT(pdn_periodic_options, &options);
    options.grid_points = ((size_t)1 << 24) - 1;
    CHECK_STATUS(pdn_solve_periodic(model, 2, &options, &solution), PDN_ERR_MEMORY);
    CHECK_MESSAGE("a grid of 16777215 points: ");
    CHECK_MESSAGE(" bytes of memory cannot be had");
    CHECK(solution == NULL);
}

static void huge_start(void)
{
    pdn_periodic_options options;
    pdn_solution *solution = NULL, *fine = NULL;
    PDN_INIT(pdn_periodic_options, &options);
    options.grid_points = 5;
    CHECK_STATUS(pdn_solve_periodic(model, 2, &options, &solution), PDN_OK);
    options.initial = solution;
    options.grid_points = ((size_t)1 << 24) - 1;
    CHECK_STATUS(pdn_solve_periodic(model, 2, &options, &fine), PDN_ERR_MEMORY);
    CHECK_MESSAGE("a grid of 16777215 points: ");
    pdn_solution_free(solution);
}

static void long_march(void)
{
    pdn_march_options options;
    pdn_solution *solution = NULL;
    PDN_INIT(pdn_march_options, &options);
    options.duration = 1e6;
    options.step = 0.1;
    options.period = 2;
    CHECK_STATUS(pdn_solve_march(model, &options, &solution), PDN_ERR_MEMORY);
    CHECK_MESSAGE("steps of the march: ");
}

static void many_elements(void)
{
    const double start[3] = {0, 5, 0}, end[3] = {1, 5, 0}, y[3] = {0, 1, 0};
    const double stiffness[6] = {1, 1, 1, 1, 1, 1}, mass[4] = {1, 1, 1, 1};
    pdn_section section;
    pdn_beam beam;
    int32_t before, after;
    PDN_INIT(pdn_section, &section);
    CHECK_STATUS(pdn_section_set_diagonal(&section, stiffness, mass), PDN_OK);
    CHECK_STATUS(pdn_model_node_count(model, &before), PDN_OK);
    CHECK_STATUS(pdn_model_add_straight_beam(model, start, end, y, &section, 1000000, 24, &beam),
                 PDN_ERR_MEMORY);
    CHECK_MESSAGE("nodes and elements of the beam: ");
    CHECK_STATUS(pdn_model_node_count(model, &after), PDN_OK);
    CHECK(before == after);
}

/* Of many nodes, for what takes little of few. */
static pdn_model *large;

static void many_modes(void)
{
    pdn_modes_options options;
    pdn_modes *modes = NULL;
    PDN_INIT(pdn_modes_options, &options);
    options.count = 100000;
    CHECK_STATUS(pdn_solve_modes(large, &options, &modes), PDN_ERR_MEMORY);
    CHECK_MESSAGE("a search for modes: ");
    CHECK_MESSAGE(" bytes of memory cannot be had");
}

static void many_steps_to_a_period(void)
{
    pdn_shooting_options options;
    pdn_solution *found = NULL;
    PDN_INIT(pdn_shooting_options, &options);
    options.steps_per_period = 1000000;
    CHECK_STATUS(pdn_solve_shooting(model, 2, &options, &found), PDN_ERR_MEMORY);
    CHECK_MESSAGE("shooting: ");
    CHECK_MESSAGE(" bytes of memory cannot be had");
}

static pdn_solution *solution;

static void many_times(void)
{
    const size_t count = 4 * MIB;
    /* The caller's own are 160 MiB of the 256. */
    double *const times = calloc(count, sizeof *times);
    double *const values = malloc(4 * count * sizeof *values);
    CHECK(times != NULL && values != NULL);
    CHECK_STATUS(pdn_solution_sample(
                     solution, PDN_QUANTITY(PDN_NODE_QUATERNION, parts.body, PDN_ALL_COMPONENTS),
                     times, count, values),
                 PDN_ERR_MEMORY);
    CHECK_MESSAGE("values at these times: ");
    free(times);
    free(values);
}

static void many_harmonics(void)
{
    const size_t count = MIB;
    double *const values = malloc(9 * count * sizeof *values);
    double *const room = malloc(100 * MIB);
    CHECK(values != NULL && room != NULL);
    CHECK_STATUS(pdn_solution_harmonics(
                     solution, PDN_QUANTITY(PDN_NODE_ROTATION, parts.body, PDN_ALL_COMPONENTS),
                     count, NULL, NULL, values, NULL),
                 PDN_ERR_MEMORY);
    CHECK_MESSAGE("harmonics: ");
    free(room);
    free(values);
}

/* What any_amount tries. */
static int32_t solver;
static size_t points;

static pdn_status try_periodic(void)
{
    pdn_periodic_options options;
    PDN_INIT(pdn_periodic_options, &options);
    options.grid_points = points;
    options.linear_solver = solver;
    options.iteration_limit = 3;
    return pdn_solve_periodic(model, 2, &options, &solution);
}

static pdn_status try_statics(void)
{
    return pdn_solve_static(large, NULL, &solution);
}

static pdn_status try_modes(void)
{
    pdn_modes_options options;
    pdn_modes *modes = NULL;
    PDN_INIT(pdn_modes_options, &options);
    options.count = 40;
    return pdn_solve_modes(model, &options, &modes);
}

static pdn_status try_shooting(void)
{
    pdn_shooting_options options;
    PDN_INIT(pdn_shooting_options, &options);
    options.steps_per_period = 5;
    options.iteration_limit = 1;
    return pdn_solve_shooting(model, 2, &options, &solution);
}

static pdn_status try_march(void)
{
    pdn_march_options options;
    PDN_INIT(pdn_march_options, &options);
    options.duration = 0.1;
    options.step = 0.05;
    options.period = 2;
    return pdn_solve_march(large, &options, &solution);
}

/* Whatever memory there is, a solve ends in its status. */
static void any_amount(const char *what, pdn_status (*attempt)(void))
{
    size_t refused = 0, solved = 0;
    for (size_t share = 0; share < 24; share++) {
        const pid_t child = fork();
        int status = 0;
        CHECK(child >= 0);
        if (child == 0) {
            pdn_status result;
            /* From 1 MiB on, by a third more each time, to 800 MiB. */
            size_t bytes = MIB;
            for (size_t i = 0; i < share; i++) {
                bytes += bytes / 3;
            }
            leave(bytes);
            result = attempt();
            if (result != PDN_OK && result != PDN_ERR_MEMORY) {
                fprintf(stderr, "%s: %s\n", what, pdn_status_name(result));
            }
            _exit(result == PDN_OK ? 0 : result == PDN_ERR_MEMORY ? 77 : 1);
        }
        CHECK(waitpid(child, &status, 0) == child);
        if (!WIFEXITED(status) || (WEXITSTATUS(status) != 0 && WEXITSTATUS(status) != 77)) {
            fprintf(stderr, "%s, share %zu: status %d\n", what, share, status);
            exit(1);
        }
        *(WEXITSTATUS(status) == 0 ? &solved : &refused) += 1;
    }
    printf("%s: %zu refused, %zu solved\n", what, refused, solved);
    CHECK(refused > 1 && solved > 1);
}

static void any_amount_of_a_grid(const char *what, int32_t by, size_t count)
{
    solver = by;
    points = count;
    any_amount(what, try_periodic);
}

/* What is kept for other solves is given back on request, and solves do without. */
static void kept_for_others(void)
{
    size_t before, after;
    solver = PDN_LINEAR_DIRECT;
    points = 31;
    CHECK_STATUS(try_periodic(), PDN_OK);
    pdn_solution_free(solution);
    before = bytes_taken();
    CHECK_STATUS(pdn_release_memory(), PDN_OK);
    after = bytes_taken();
    printf("kept: %zu bytes\n", before - after);
    CHECK(after + MIB < before && before < after + 512 * MIB);
    still_works();
}

/* The caller's own limit: refused with the estimate, which suffices if it is allowed. */
static void own_limit(void)
{
    pdn_periodic_options options;
    pdn_solution *found = NULL;
    char message[512];
    unsigned long long estimate = 0;
    PDN_INIT(pdn_periodic_options, &options);
    CHECK(options.memory_limit == 0);
    options.grid_points = 31;
    options.memory_limit = 1000;
    CHECK_STATUS(pdn_solve_periodic(model, 2, &options, &found), PDN_ERR_MEMORY);
    CHECK_MESSAGE("more than options.memory_limit allows (1000)");
    for (int i = 0; i < 4 && found == NULL; i++) {
        const char *about;
        pdn_last_error(message, sizeof message);
        about = strstr(message, "about ");
        CHECK(about != NULL && sscanf(about, "about %llu bytes", &estimate) == 1);
        CHECK(estimate > options.memory_limit && estimate < 1000 * MIB);
        options.memory_limit = (size_t)estimate;
        (void)pdn_solve_periodic(model, 2, &options, &found);
    }
    CHECK(pdn_solution_outcome(found) == PDN_CONVERGED);
    pdn_solution_free(found);

    /* Adaptive: as far as the limit goes. */
    found = NULL;
    options.grid_points = 0;
    options.error_tolerance = 1e-13;
    options.memory_limit = 0;
    CHECK_STATUS(pdn_solve_periodic(model, 2, &options, &found), PDN_OK);
    pdn_solution_free(found);
}

/* The estimate that the last error tells. */
static size_t told(void)
{
    char message[512];
    unsigned long long estimate = 0;
    const char *about;
    CHECK_MESSAGE("more than options.memory_limit allows (1000)");
    pdn_last_error(message, sizeof message);
    about = strstr(message, "about ");
    CHECK(about != NULL && sscanf(about, "about %llu bytes", &estimate) == 1);
    CHECK(estimate > 1000 && estimate < 1000 * MIB);
    return (size_t)estimate;
}

static int32_t note(const pdn_progress *progress, void *user_data)
{
    (void)progress;
    *(int *)user_data = 1;
    return 0;
}

/* Statics, modes and shooting: refused before they begin, with an estimate that suffices. */
static void own_limits_of_others(void)
{
    pdn_static_options at_rest;
    pdn_modes_options of_modes;
    pdn_shooting_options shooting;
    pdn_solution *found = NULL;
    pdn_modes *modes = NULL;
    int began = 0;
    PDN_INIT(pdn_static_options, &at_rest);
    CHECK(at_rest.memory_limit == 0);
    at_rest.memory_limit = 1000;
    at_rest.progress = note;
    at_rest.progress_data = &began;
    CHECK_STATUS(pdn_solve_static(model, &at_rest, &found), PDN_ERR_MEMORY);
    CHECK_MESSAGE("the equilibrium takes about ");
    CHECK(found == NULL && !began);
    at_rest.memory_limit = told();
    CHECK_STATUS(pdn_solve_static(model, &at_rest, &found), PDN_OK);
    CHECK(pdn_solution_outcome(found) == PDN_CONVERGED && began);
    pdn_solution_free(found);

    /* Modes take more than the equilibrium. */
    PDN_INIT(pdn_modes_options, &of_modes);
    of_modes.equilibrium = &at_rest;
    began = 0;
    CHECK_STATUS(pdn_solve_modes(model, &of_modes, &modes), PDN_ERR_MEMORY);
    CHECK_MESSAGE("a search for modes takes about ");
    at_rest.memory_limit = 1000;
    CHECK_STATUS(pdn_solve_modes(model, &of_modes, &modes), PDN_ERR_MEMORY);
    CHECK(modes == NULL && !began);
    at_rest.memory_limit = told();
    CHECK_STATUS(pdn_solve_modes(model, &of_modes, &modes), PDN_OK);
    CHECK(pdn_modes_outcome(modes) == PDN_CONVERGED);
    pdn_modes_free(modes);

    PDN_INIT(pdn_shooting_options, &shooting);
    CHECK(shooting.memory_limit == 0);
    shooting.steps_per_period = 5;
    shooting.iteration_limit = 1;
    shooting.memory_limit = 1000;
    began = 0;
    shooting.progress = note;
    shooting.progress_data = &began;
    found = NULL;
    CHECK_STATUS(pdn_solve_shooting(model, 2, &shooting, &found), PDN_ERR_MEMORY);
    CHECK_MESSAGE("shooting takes about ");
    CHECK(found == NULL && !began);
    shooting.memory_limit = told();
    CHECK_STATUS(pdn_solve_shooting(model, 2, &shooting, &found), PDN_OK);
    CHECK(began);
    pdn_solution_free(found);
}

/* The steps of a march: refused where their number is known, else kept as far as the limit goes. */
static void own_limit_of_a_march(void)
{
    pdn_march_options options;
    pdn_solution *found = NULL;
    char message[512];
    unsigned long long estimate = 0;
    const char *about;
    pdn_diagnostics diagnostics;
    PDN_INIT(pdn_march_options, &options);
    CHECK(options.memory_limit == 0);
    options.period = 2;
    options.duration = 2;
    options.step = 0.01;
    options.memory_limit = 1000;
    CHECK_STATUS(pdn_solve_march(model, &options, &found), PDN_ERR_MEMORY);
    CHECK_MESSAGE("more than options.memory_limit allows (1000)");
    CHECK(found == NULL);
    pdn_last_error(message, sizeof message);
    about = strstr(message, "about ");
    CHECK(about != NULL && sscanf(about, "about %llu bytes", &estimate) == 1);
    options.memory_limit = (size_t)estimate;
    CHECK_STATUS(pdn_solve_march(model, &options, &found), PDN_OK);
    CHECK(pdn_solution_outcome(found) == PDN_CONVERGED);
    pdn_solution_free(found);

    /* Steps chosen by their errors: memory of five steps is five steps. */
    found = NULL;
    options.error_tolerance = 1;
    options.step = 0.001;
    options.memory_limit = (size_t)estimate / 201 * 5;
    CHECK_STATUS(pdn_solve_march(model, &options, &found), PDN_OK);
    CHECK(pdn_solution_outcome(found) == PDN_WORK_LIMIT);
    PDN_INIT(pdn_diagnostics, &diagnostics);
    CHECK_STATUS(pdn_solution_diagnostics(found, &diagnostics), PDN_OK);
    CHECK(diagnostics.grid_points == 5);
    CHECK(reports(found, "options.memory_limit"));
    pdn_solution_free(found);
}

static void in_a_child(void (*test)(void), size_t bytes)
{
    int status = 0;
    const pid_t child = fork();
    CHECK(child >= 0);
    if (child == 0) {
        leave(bytes);
        test();
        still_works();
        exit(0);
    }
    CHECK(waitpid(child, &status, 0) == child);
    CHECK(WIFEXITED(status) && WEXITSTATUS(status) == 0);
}

int main(void)
{
    pdn_periodic_options options;
    driven_arm others;
    model = make_driven_arm(24, 4, &parts);
    large = make_driven_arm(1000, 4, &others);
    PDN_INIT(pdn_periodic_options, &options);
    options.grid_points = 5;
    CHECK_STATUS(pdn_solve_periodic(model, 2, &options, &solution), PDN_OK);

    in_a_child(kept_for_others, 1024 * MIB);
    in_a_child(huge_grid, 256 * MIB);
    in_a_child(huge_start, 256 * MIB);
    in_a_child(long_march, 256 * MIB);
    in_a_child(many_elements, 256 * MIB);
    in_a_child(many_times, 256 * MIB);
    in_a_child(many_harmonics, 256 * MIB);
    in_a_child(many_steps_to_a_period, 256 * MIB);
    in_a_child(many_modes, 256 * MIB);
    any_amount_of_a_grid("automatic", PDN_LINEAR_AUTOMATIC, 61);
    any_amount_of_a_grid("direct", PDN_LINEAR_DIRECT, 31);
    any_amount_of_a_grid("iterative", PDN_LINEAR_BODY_CIRCULANT, 61);
    any_amount("modes", try_modes);
    any_amount("statics", try_statics);
    any_amount("march", try_march);
    any_amount("shooting", try_shooting);
    own_limit();
    own_limit_of_a_march();
    own_limits_of_others();

    pdn_solution_free(solution);
    pdn_model_free(model);
    pdn_model_free(large);
    return 0;
}
