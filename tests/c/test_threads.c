/* What may be done at once: anything with distinct handles, `const` functions on one handle. All
   give the same bits as one thread alone. Under a sanitizer of threads it shows that nothing is
   touched by two of them. */
#include "driven_arm.h"
#include <pthread.h>

enum { THREADS = 4, ROUNDS = 2, VALUES = 64 };

/* What all share. */
static pdn_model *model;
static pdn_solution *solution;
static driven_arm parts;

static void periodic(const pdn_model *of, int32_t threads, int32_t solver, double *out)
{
    const double times[2] = {0.3, 1.7};
    pdn_periodic_options options;
    pdn_solution *found = NULL;
    PDN_INIT(pdn_periodic_options, &options);
    options.grid_points = 9;
    options.threads = threads;
    options.linear_solver = solver;
    CHECK_STATUS(pdn_solve_periodic(of, 2, &options, &found), PDN_OK);
    CHECK(pdn_solution_outcome(found) == PDN_CONVERGED);
    CHECK_STATUS(
        pdn_solution_sample(found, PDN_QUANTITY(PDN_NODE_POSITION, parts.body, PDN_ALL_COMPONENTS),
                            times, 2, out),
        PDN_OK);
    CHECK_STATUS(pdn_solution_sample(
                     found, PDN_QUANTITY(PDN_NODE_VELOCITY, parts.beam.last, PDN_ALL_COMPONENTS),
                     times, 2, out + 6),
                 PDN_OK);
    pdn_solution_free(found);
}

static void others(const pdn_model *of, double *out)
{
    const double times[1] = {0.1};
    pdn_march_options march;
    pdn_static_options at_rest;
    pdn_solution *found = NULL;
    PDN_INIT(pdn_march_options, &march);
    march.duration = 0.2;
    march.step = 0.05;
    march.period = 2;
    CHECK_STATUS(pdn_solve_march(of, &march, &found), PDN_OK);
    CHECK_STATUS(pdn_solution_sample(
                     found, PDN_QUANTITY(PDN_NODE_POSITION, parts.beam.last, PDN_ALL_COMPONENTS),
                     times, 1, out),
                 PDN_OK);
    pdn_solution_free(found);
    PDN_INIT(pdn_static_options, &at_rest);
    at_rest.period = 2;
    at_rest.time = 0.5;
    CHECK_STATUS(pdn_solve_static(of, &at_rest, &found), PDN_OK);
    CHECK_STATUS(
        pdn_solution_sample(found, PDN_QUANTITY(PDN_NODE_POSITION, parts.body, PDN_ALL_COMPONENTS),
                            times, 1, out + 3),
        PDN_OK);
    pdn_solution_free(found);
}

static void read_all(double *out)
{
    const double times[2] = {0.3, 1.7};
    char report[4000];
    pdn_diagnostics diagnostics;
    pdn_stability *stability = NULL;
    pdn_stability_options options;
    CHECK_STATUS(pdn_solution_sample(solution,
                                     PDN_QUANTITY(PDN_JOINT_COORDINATE, parts.hinge, PDN_ROTATION),
                                     times, 2, out),
                 PDN_OK);
    CHECK_STATUS(pdn_solution_harmonics(
                     solution, PDN_QUANTITY(PDN_NODE_POSITION, parts.beam.last, PDN_ALL_COMPONENTS),
                     2, out + 2, NULL, out + 5, out + 11),
                 PDN_OK);
    PDN_INIT(pdn_diagnostics, &diagnostics);
    CHECK_STATUS(pdn_solution_diagnostics(solution, &diagnostics), PDN_OK);
    out[20] = diagnostics.last_increment;
    CHECK(pdn_solution_report(solution, report, sizeof report) > 0);
    /* Found by whoever asks first, and kept. */
    CHECK_STATUS(pdn_solution_floquet_count(solution, &(size_t){0}), PDN_OK);
    PDN_INIT(pdn_stability_options, &options);
    CHECK_STATUS(pdn_solve_stability(solution, &options, &stability), PDN_OK);
    pdn_stability_free(stability);
}

/* All of it. */
static void work(const pdn_model *own, double *out)
{
    memset(out, 0, VALUES * sizeof *out);
    periodic(own, 1, PDN_LINEAR_DIRECT, out);
    periodic(model, 2, PDN_LINEAR_BODY_CIRCULANT, out + 12);
    others(model, out + 24);
    read_all(out + 30);
}

static double expected[VALUES];

static void *thread(void *unused)
{
    driven_arm same;
    (void)unused;
    for (int round = 0; round < ROUNDS; round++) {
        pdn_model *const own = make_driven_arm(2, 3, &same);
        double found[VALUES];
        work(own, found);
        CHECK(memcmp(found, expected, sizeof found) == 0);
        /* Each has its own message. */
        CHECK_STATUS(pdn_model_add_rigid_joint(own, NODE(99), NODE(98), expected, NULL),
                     PDN_ERR_ID);
        CHECK_MESSAGE("99");
        pdn_model_free(own);
    }
    return NULL;
}

int main(void)
{
    pthread_t threads[THREADS];
    pdn_periodic_options options;
    model = make_driven_arm(2, 3, &parts);
    PDN_INIT(pdn_periodic_options, &options);
    options.grid_points = 9;
    CHECK_STATUS(pdn_solve_periodic(model, 2, &options, &solution), PDN_OK);
    work(model, expected);
    /* A fresh one, of which nothing is known yet. */
    pdn_solution_free(solution);
    CHECK_STATUS(pdn_solve_periodic(model, 2, &options, &solution), PDN_OK);
    for (int i = 0; i < THREADS; i++) {
        CHECK(pthread_create(&threads[i], NULL, thread, NULL) == 0);
    }
    for (int i = 0; i < THREADS; i++) {
        CHECK(pthread_join(threads[i], NULL) == 0);
    }
    pdn_solution_free(solution);
    pdn_model_free(model);
    return 0;
}
