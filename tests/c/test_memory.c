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

/* Leaves this process so many bytes more than it has now. */
static void leave(size_t bytes)
{
    size_t pages = 0;
    struct rlimit limit;
    FILE *const file = fopen("/proc/self/statm", "r");
    CHECK(file != NULL && fscanf(file, "%zu", &pages) == 1);
    fclose(file);
    limit.rlim_cur = limit.rlim_max = pages * (size_t)sysconf(_SC_PAGESIZE) + bytes;
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
    CHECK_STATUS(pdn_march(model, &options, &solution), PDN_ERR_MEMORY);
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
    CHECK_STATUS(
        pdn_model_add_straight_beam(model, start, end, y, &section, 1000000, 24, &beam),
        PDN_ERR_MEMORY);
    CHECK_MESSAGE("nodes and elements of the beam: ");
    CHECK_STATUS(pdn_model_node_count(model, &after), PDN_OK);
    CHECK(before == after);
}

static pdn_solution *solution;

static void many_times(void)
{
    const size_t count = 4 * MIB;
    /* The caller's own are 160 MiB of the 256. */
    double *const times = calloc(count, sizeof *times);
    double *const values = malloc(4 * count * sizeof *values);
    CHECK(times != NULL && values != NULL);
    CHECK_STATUS(pdn_solution_node_quaternion(solution, parts.body, times, count, values),
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
    CHECK_STATUS(pdn_solution_node_harmonics(solution, parts.body, PDN_NODE_ROTATION, count,
                                             NULL, values, NULL),
                 PDN_ERR_MEMORY);
    CHECK_MESSAGE("harmonics: ");
    free(room);
    free(values);
}

/* Whatever memory there is, a solve ends in its status. */
static void any_amount(int32_t solver, size_t points, size_t *refused, size_t *solved)
{
    for (size_t share = 0; share < 24; share++) {
        const pid_t child = fork();
        int status = 0;
        CHECK(child >= 0);
        if (child == 0) {
            pdn_periodic_options options;
            pdn_status result;
            PDN_INIT(pdn_periodic_options, &options);
            options.grid_points = points;
            options.linear_solver = solver;
            options.iteration_limit = 3;
            /* From 1 MiB on, by a third more each time, to 800 MiB. */
            size_t bytes = MIB;
            for (size_t i = 0; i < share; i++) {
                bytes += bytes / 3;
            }
            leave(bytes);
            result = pdn_solve_periodic(model, 2, &options, &solution);
            _exit(result == PDN_OK ? 0 : result == PDN_ERR_MEMORY ? 77 : 1);
        }
        CHECK(waitpid(child, &status, 0) == child);
        if (!WIFEXITED(status) || (WEXITSTATUS(status) != 0 && WEXITSTATUS(status) != 77)) {
            fprintf(stderr, "solver %d, %zu points, share %zu: status %d\n", (int)solver, points,
                    share, status);
            exit(1);
        }
        *(WEXITSTATUS(status) == 0 ? solved : refused) += 1;
    }
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
    CHECK_STATUS(pdn_march(model, &options, &found), PDN_ERR_MEMORY);
    CHECK_MESSAGE("more than options.memory_limit allows (1000)");
    CHECK(found == NULL);
    pdn_last_error(message, sizeof message);
    about = strstr(message, "about ");
    CHECK(about != NULL && sscanf(about, "about %llu bytes", &estimate) == 1);
    options.memory_limit = (size_t)estimate;
    CHECK_STATUS(pdn_march(model, &options, &found), PDN_OK);
    CHECK(pdn_solution_outcome(found) == PDN_CONVERGED);
    pdn_solution_free(found);

    /* Steps chosen by their errors: memory of five steps is five steps. */
    found = NULL;
    options.error_tolerance = 1;
    options.step = 0.001;
    options.memory_limit = (size_t)estimate / 201 * 5;
    CHECK_STATUS(pdn_march(model, &options, &found), PDN_OK);
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
    size_t refused = 0, solved = 0;
    model = make_driven_arm(24, 4, &parts);
    PDN_INIT(pdn_periodic_options, &options);
    options.grid_points = 5;
    CHECK_STATUS(pdn_solve_periodic(model, 2, &options, &solution), PDN_OK);

    in_a_child(huge_grid, 256 * MIB);
    in_a_child(huge_start, 256 * MIB);
    in_a_child(long_march, 256 * MIB);
    in_a_child(many_elements, 256 * MIB);
    in_a_child(many_times, 256 * MIB);
    in_a_child(many_harmonics, 256 * MIB);
    any_amount(PDN_LINEAR_AUTOMATIC, 61, &refused, &solved);
    any_amount(PDN_LINEAR_DIRECT, 31, &refused, &solved);
    any_amount(PDN_LINEAR_BODY_CIRCULANT, 61, &refused, &solved);
    printf("%zu refused, %zu solved\n", refused, solved);
    CHECK(refused > 10 && solved > 10);
    own_limit();
    own_limit_of_a_march();

    pdn_solution_free(solution);
    pdn_model_free(model);
    return 0;
}
