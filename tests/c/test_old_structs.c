/* Programs that were compiled with an older header: their structs are shorter, and end where the
   heap's next block may begin. Under valgrind and sanitizers nothing beyond them is touched. */
#include "driven_arm.h"

static driven_arm parts;

/* A size that the compiler does not know: it would say that structs of today do not fit. */
static void *block(size_t size)
{
    volatile size_t of = size;
    return malloc(of);
}

/* The same of a solve, whatever size its options have. */
static void periodic(const pdn_model *model)
{
    static const size_t sizes[] = {80, 96, 104, 112, 120, 136, sizeof(pdn_periodic_options)};
    double expected[3] = {0};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        pdn_periodic_options *const options = block(sizes[i]);
        pdn_solution *solution = NULL;
        double position[3];
        const double time = 0.7;
        CHECK(options != NULL);
        pdn_periodic_options_init(options, sizes[i]);
        CHECK(options->struct_size == sizes[i]);
        options->grid_points = 7;
        CHECK_STATUS(pdn_solve_periodic(model, 2, options, &solution), PDN_OK);
        CHECK(pdn_solution_outcome(solution) == PDN_CONVERGED);
        CHECK_STATUS(pdn_solution_sample(
                         solution, PDN_QUANTITY(PDN_NODE_POSITION, parts.body, PDN_ALL_COMPONENTS),
                         &time, 1, position),
                     PDN_OK);
        if (i == 0) {
            memcpy(expected, position, sizeof expected);
        }
        CHECK(memcmp(position, expected, sizeof expected) == 0);
        pdn_solution_free(solution);
        free(options);
    }
}

static void other_solves(const pdn_model *model)
{
    pdn_static_options *const at_rest = block(120);
    pdn_shooting_options *const shooting = block(72);
    pdn_march_options *const march = block(152);
    pdn_modes_options modes;
    pdn_modes *found = NULL;
    pdn_solution *solution = NULL;
    CHECK(at_rest != NULL && shooting != NULL && march != NULL);
    pdn_static_options_init(at_rest, 120);
    at_rest->period = 2;
    CHECK_STATUS(pdn_solve_static(model, at_rest, &solution), PDN_OK);
    pdn_solution_free(solution);
    /* As a part of another struct, too. */
    PDN_INIT(pdn_modes_options, &modes);
    modes.equilibrium = at_rest;
    modes.count = 1;
    CHECK_STATUS(pdn_solve_modes(model, &modes, &found), PDN_OK);
    pdn_modes_free(found);
    pdn_shooting_options_init(shooting, 72);
    shooting->steps_per_period = 5;
    shooting->iteration_limit = 1;
    CHECK_STATUS(pdn_solve_shooting(model, 2, shooting, &solution), PDN_OK);
    pdn_solution_free(solution);
    pdn_march_options_init(march, 152);
    march->duration = 0.1;
    march->period = 2;
    march->step = 0.05;
    CHECK_STATUS(pdn_solve_march(model, march, &solution), PDN_OK);
    pdn_solution_free(solution);
    free(march);
    free(shooting);
    free(at_rest);
}

static void results(const pdn_model *model)
{
    static const size_t sizes[] = {112, 136, 160, sizeof(pdn_diagnostics)};
    pdn_periodic_options options;
    pdn_solution *solution = NULL;
    PDN_INIT(pdn_periodic_options, &options);
    options.grid_points = 7;
    CHECK_STATUS(pdn_solve_periodic(model, 2, &options, &solution), PDN_OK);
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        pdn_diagnostics *const diagnostics = block(sizes[i]);
        CHECK(diagnostics != NULL);
        pdn_diagnostics_init(diagnostics, sizes[i]);
        CHECK_STATUS(pdn_solution_diagnostics(solution, diagnostics), PDN_OK);
        CHECK(diagnostics->struct_size == sizes[i] && diagnostics->grid_points == 7);
        free(diagnostics);
    }
    pdn_solution_free(solution);
}

int main(void)
{
    pdn_model *const model = make_driven_arm(1, 2, &parts);
    periodic(model);
    other_solves(model);
    results(model);
    pdn_model_free(model);
    return 0;
}
