/* All kinds of solves on a thread with the least stack that docs/abi.md promises to suffice. */
#include "driven_arm.h"
#include <pthread.h>

/* As docs/abi.md says. */
#define LEAST_STACK ((size_t)256 * 1024)

static pdn_model *model;
static driven_arm parts;

static void *solves(void *unused)
{
    pdn_periodic_options periodic;
    pdn_march_options march;
    pdn_modes_options modes;
    pdn_stability_options stability;
    pdn_solution *solution = NULL, *loaded = NULL, *marched = NULL, *still = NULL;
    pdn_modes *found = NULL;
    pdn_stability *verdict = NULL;
    char report[200];
    const int32_t solvers[] = {PDN_LINEAR_AUTOMATIC, PDN_LINEAR_DIRECT, PDN_LINEAR_ITERATIVE};
    (void)unused;
    for (size_t i = 0; i < sizeof solvers / sizeof *solvers; i++) {
        pdn_solution_free(solution);
        PDN_INIT(pdn_periodic_options, &periodic);
        periodic.linear_solver = solvers[i];
        CHECK_STATUS(pdn_solve_periodic(model, 2, &periodic, &solution), PDN_OK);
        CHECK(pdn_solution_outcome(solution) == PDN_CONVERGED);
    }
    CHECK(pdn_solution_report(solution, report, sizeof report) > 0);
    CHECK_STATUS(pdn_solution_save(solution, "test_stack.pdn"), PDN_OK);
    CHECK_STATUS(pdn_solution_load("test_stack.pdn", &loaded), PDN_OK);
    PDN_INIT(pdn_stability_options, &stability);
    CHECK_STATUS(pdn_solve_stability(solution, &stability, &verdict), PDN_OK);
    PDN_INIT(pdn_march_options, &march);
    march.duration = march.period = 2;
    march.step = 0.05;
    CHECK_STATUS(pdn_solve_march(model, &march, &marched), PDN_OK);
    CHECK_STATUS(pdn_solve_static(model, NULL, &still), PDN_OK);
    PDN_INIT(pdn_modes_options, &modes);
    (void)pdn_solve_modes(model, &modes, &found);
    pdn_modes_free(found);
    pdn_stability_free(verdict);
    pdn_solution_free(still);
    pdn_solution_free(marched);
    pdn_solution_free(loaded);
    pdn_solution_free(solution);
    return NULL;
}

int main(void)
{
    pthread_attr_t attributes;
    pthread_t thread;
    model = make_driven_arm(3, 4, &parts);
    CHECK(pthread_attr_init(&attributes) == 0);
    CHECK(pthread_attr_setstacksize(&attributes, LEAST_STACK) == 0);
    CHECK(pthread_create(&thread, &attributes, solves, NULL) == 0);
    CHECK(pthread_join(thread, NULL) == 0);
    CHECK(pthread_attr_destroy(&attributes) == 0);
    pdn_model_free(model);
    return 0;
}
