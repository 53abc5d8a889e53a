/* Prints numbers of several solves with all their digits, for machines.py to compare between kinds
   of processors. */
#include "driven_arm.h"

static driven_arm parts;

static void print(const char *what, const double *values, size_t count)
{
    printf("%s", what);
    for (size_t i = 0; i < count; i++) {
        printf(" %.17g", values[i]);
    }
    printf("\n");
}

static void show(const char *what, pdn_solution *solution)
{
    const double times[3] = {0.05, 0.1, 0.17};
    double values[9];
    CHECK(pdn_solution_outcome(solution) == PDN_CONVERGED);
    CHECK_STATUS(pdn_solution_sample(
                     solution, PDN_QUANTITY(PDN_NODE_POSITION, parts.beam.last, PDN_ALL_COMPONENTS),
                     times, 3, values),
                 PDN_OK);
    print(what, values, 9);
    CHECK_STATUS(pdn_solution_sample(solution,
                                     PDN_QUANTITY(PDN_JOINT_COORDINATE, parts.hinge, PDN_ROTATION),
                                     times, 3, values),
                 PDN_OK);
    print(what, values, 3);
    pdn_solution_free(solution);
}

int main(void)
{
    static const int32_t solvers[] = {PDN_LINEAR_DIRECT, PDN_LINEAR_BODY_CIRCULANT};
    const double weight = -50;
    pdn_model *const model = make_driven_arm(2, 3, &parts);
    pdn_periodic_options periodic;
    pdn_march_options march;
    pdn_static_options at_rest;
    pdn_solution *solution = NULL;
    pdn_signal load;
    PDN_INIT(pdn_signal, &load);
    CHECK_STATUS(pdn_signal_set_harmonics(&load, 10, 0, &weight, &(double){0}, 1), PDN_OK);
    CHECK_STATUS(
        pdn_model_add_load(model, parts.beam.last, PDN_FRAME_SPACE, PDN_FORCE_2, &load, NULL),
        PDN_OK);
    for (int32_t i = 0; i < 2; i++) {
        for (int32_t threads = 1; threads <= 2; threads++) {
            PDN_INIT(pdn_periodic_options, &periodic);
            periodic.grid_points = 9;
            periodic.tolerance = 1e-12;
            periodic.linear_solver = solvers[i];
            periodic.threads = threads;
            CHECK_STATUS(pdn_solve_periodic(model, 2, &periodic, &solution), PDN_OK);
            show(i == 0 ? "direct" : "iterative", solution);
        }
    }
    PDN_INIT(pdn_static_options, &at_rest);
    at_rest.period = 2;
    at_rest.time = 0.3;
    CHECK_STATUS(pdn_solve_static(model, &at_rest, &solution), PDN_OK);
    show("static", solution);
    PDN_INIT(pdn_march_options, &march);
    march.duration = 0.2;
    march.step = 0.02;
    march.period = 2;
    CHECK_STATUS(pdn_solve_march(model, &march, &solution), PDN_OK);
    show("march", solution);
    pdn_model_free(model);
    return 0;
}
