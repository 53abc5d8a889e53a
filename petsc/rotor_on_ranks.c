/* A rotor of three damped blades of 10 m in gravity, on as many ranks as mpirun starts: what it
 * takes, and how its tip moves.
 *
 *   mpirun -n 2 rotor_on_ranks [elements of a blade] [grid points] [threads] [options of PETSc]
 */

#include "periodyn_petsc.h"

#include "rotor.h"

#include <petscsys.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>

static double largest_megabytes(void)
{
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    return (double)usage.ru_maxrss / 1024; /* kilobytes on Linux */
}

int main(int argc, char **argv)
{
    int rank, ranks;
    PetscInitialize(&argc, &argv, NULL, NULL);
    MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
    MPI_Comm_size(PETSC_COMM_WORLD, &ranks);
    const size_t elements = argc > 1 ? strtoul(argv[1], NULL, 10) : 8;
    pdn_petsc_options options;
    pdn_petsc_report report;
    pdn_solution *solution;
    int32_t tip;
    pdn_model *model = make_rotor(elements, &tip);
    PDN_INIT(pdn_petsc_options, &options);
    PDN_INIT(pdn_petsc_report, &report);
    options.grid_points = argc > 2 ? strtoul(argv[2], NULL, 10) : 15;
    options.threads = argc > 3 ? atoi(argv[3]) : 1;
    options.start_points = 5;
    options.root = 0;
    const double began = MPI_Wtime();
    TRY(pdn_petsc_solve(PETSC_COMM_WORLD, model, 1.0, &options, &report, &solution));
    const double seconds = MPI_Wtime() - began;
    double memory = largest_megabytes(), most;
    MPI_Reduce(&memory, &most, 1, MPI_DOUBLE, MPI_MAX, 0, PETSC_COMM_WORLD);
    if (rank == 0) {
        double position[3];
        const double time = 0.25;
        TRY(pdn_solution_sample(solution, PDN_QUANTITY(PDN_NODE_POSITION, tip, PDN_ALL_COMPONENTS),
                                &time, 1, position));
        printf("%d ranks: %s, %zu unknowns, %zu iterations, %zu products, %.1f s, of which "
               "start %.1f, linearisations %.1f, factors %.1f, linear solves %.1f\n",
               ranks, report.outcome == PDN_CONVERGED ? "converged" : "not converged",
               report.unknowns, report.iterations, report.products, seconds, report.start_time,
               report.linearisation_time, report.factor_time, report.solve_time);
        printf("memory of a rank: %.0f MB, of which equations %.0f MB; tip at %.12f %.12f %.12f\n",
               most, (double)report.bytes / 1e6, position[0], position[1], position[2]);
        pdn_solution_free(solution);
    }
    pdn_model_free(model);
    return PetscFinalize();
}
