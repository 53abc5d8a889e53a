/* test_solve MODEL [body_circulant] [options of PETSc]: the solution of all ranks is that of one,
 * found without PETSc, and takes as many products as PETSc does on one rank. */

#include "mechanisms.h"
#include "periodyn_petsc.h"

#include <petscsys.h>

enum { TIMES = 41 };

static double largest(const double *x, const double *y, size_t count)
{
    double most = 0;
    for (size_t i = 0; i < count; ++i) {
        most = fmax(most, fabs(x[i] - (y == NULL ? 0 : y[i])));
    }
    return most;
}

static void compare(const struct test_model *model, const pdn_solution *found,
                    const pdn_solution *expected)
{
    double t[TIMES], position[2][TIMES][3], effort[2][TIMES];
    for (int i = 0; i < TIMES; ++i) {
        t[i] = model->period * i / TIMES;
    }
    for (int which = 0; which < 2; ++which) {
        const pdn_solution *solution = which == 0 ? found : expected;
        GOOD(pdn_solution_sample(solution,
                                 PDN_QUANTITY(PDN_NODE_POSITION, model->node, PDN_ALL_COMPONENTS),
                                 t, TIMES, position[which][0]));
        GOOD(pdn_solution_sample(solution,
                                 PDN_QUANTITY(PDN_JOINT_DRIVING_EFFORT, model->joint, PDN_ROTATION),
                                 t, TIMES, effort[which]));
    }
    const double size = largest(position[1][0], NULL, 3 * TIMES);
    const double force = largest(effort[1], NULL, TIMES);
    const double error = largest(position[0][0], position[1][0], 3 * TIMES) / size;
    const double of_force = largest(effort[0], effort[1], TIMES) / force;
    printf("positions differ by %.1e, efforts by %.1e\n", error, of_force);
    CHECK(error <= 1e-10);
    /* Efforts are what rounding in stiff beams leaves of them. */
    CHECK(of_force <= 1e-8);
}

int main(int argc, char **argv)
{
    PetscInitialize(&argc, &argv, NULL, NULL);
    CHECK(argc >= 2);
    const int blades = strcmp(argv[1], "rotor") == 0;
    const int bodies = argc > 2 && strcmp(argv[2], "body_circulant") == 0;
    struct test_model model = blades                             ? rotor(4, 15)
                              : strcmp(argv[1], "four_bar") == 0 ? four_bar()
                                                                 : slider_crank();
    pdn_periodic_options serial;
    pdn_petsc_options options;
    pdn_petsc_report report, alone;
    pdn_solution *expected, *found;
    int ranks;
    MPI_Comm_size(PETSC_COMM_WORLD, &ranks);

    PDN_INIT(pdn_periodic_options, &serial);
    serial.grid_points = model.points;
    GOOD(pdn_solve_periodic(model.model, model.period, &serial, &expected));
    CHECK(pdn_solution_outcome(expected) == PDN_CONVERGED);

    PDN_INIT(pdn_petsc_options, &options);
    PDN_INIT(pdn_petsc_report, &report);
    PDN_INIT(pdn_petsc_report, &alone);
    options.grid_points = model.points;
    if (bodies) {
        options.preconditioner = PDN_LINEAR_BODY_CIRCULANT;
    }
    GOOD(pdn_petsc_solve(PETSC_COMM_WORLD, model.model, model.period, &options, &report, &found));
    printf("%d ranks: outcome %d, %zu iterations, %zu products, %zu unknowns, %zu and %zu here\n",
           ranks, report.outcome, report.iterations, report.products, report.unknowns, report.size,
           report.halo);
    CHECK(report.outcome == PDN_CONVERGED && pdn_solution_outcome(found) == PDN_CONVERGED);
    CHECK(report.preconditioner ==
          (blades || bodies ? PDN_LINEAR_BODY_CIRCULANT : PDN_LINEAR_TIME_LOCAL));
    compare(&model, found, expected);

    /* Iterations do not depend on the number of ranks. */
    pdn_solution_free(found);
    GOOD(pdn_petsc_solve(PETSC_COMM_SELF, model.model, model.period, &options, &alone, &found));
    CHECK(report.iterations == alone.iterations);
    const double ratio = (double)report.products / (double)alone.products;
    printf("%zu products on one rank\n", alone.products);
    CHECK(ratio <= 1.2 && ratio >= 1 / 1.2);
    CHECK(report.size + report.halo <= alone.size && (ranks == 1 || report.size < alone.size));

    /* What was asked of PETSc was heard. */
    PetscBool is_given, is_used = PETSC_TRUE;
    PetscOptionsHasName(NULL, NULL, "-pdn_ksp_type", &is_given);
    if (is_given) {
        PetscOptionsUsed(NULL, "pdn_ksp_type", &is_used);
    }
    CHECK(is_used);

    pdn_solution_free(found);
    pdn_solution_free(expected);
    pdn_model_free(model.model);
    return PetscFinalize();
}
