/* A rotor of three damped blades of 10 m in gravity, on as many ranks as mpirun starts: what it
 * takes, and how its tip moves.
 *
 *   mpirun -n 2 rotor_on_ranks [elements of a blade] [grid points] [threads] [options of PETSc]
 */

#include "periodyn_petsc.h"

#include <math.h>
#include <petscsys.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>

/* Ends all ranks with the library's message if a call fails. */
#define TRY(call)                                                                                  \
    do {                                                                                           \
        if ((call) != PDN_OK) {                                                                    \
            char text[500];                                                                        \
            pdn_last_error(text, sizeof text);                                                     \
            fprintf(stderr, "%s: %s\n", #call, text);                                              \
            MPI_Abort(PETSC_COMM_WORLD, 1);                                                        \
        }                                                                                          \
    } while (0)

static const double PI = 3.14159265358979323846;

static pdn_model *make_rotor(size_t elements, int32_t *tip_node)
{
    const double centre[3] = {0, 0, 0}, shaft[3] = {1, 0, 0}, gravity[3] = {0, 0, -9.81};
    const double pitch = 8 * PI / 180;
    const double stiffness[6] = {500e6, 100e6, 100e6, 500e3, 3.87e6, 1.30e6};
    const double mass[4] = {20.0, 0.20, 0.15, 0.05};
    const double cosines[2] = {1000, 0}, sines[2] = {0, 200};
    pdn_model *model;
    pdn_section profile;
    pdn_signal lift, turn;
    pdn_beam blade;
    int32_t hub, clamp, bearing;
    PDN_INIT(pdn_section, &profile);
    PDN_INIT(pdn_signal, &lift);
    PDN_INIT(pdn_signal, &turn);
    TRY(pdn_section_set_diagonal(&profile, stiffness, mass));
    for (int i = 3; i < 6; ++i) {
        profile.damping[7 * i] = 0.01 * stiffness[i];
    }
    TRY(pdn_signal_set_harmonics(&lift, 3000, 0, cosines, sines, 2));
    TRY(pdn_signal_set_harmonics(&turn, 0, 2 * PI, NULL, NULL, 0));
    TRY(pdn_model_new(&model));
    TRY(pdn_model_add_node(model, centre, NULL, &hub));
    for (int b = 0; b < 3; ++b) {
        const double angle = 2 * PI * b / 3, y = -sin(angle), z = cos(angle);
        const double root[3] = {0, 0.5 * y, 0.5 * z}, tip[3] = {0, 10.5 * y, 10.5 * z};
        const double flap[3] = {cos(pitch), sin(pitch) * z, -sin(pitch) * y};
        TRY(pdn_model_add_straight_beam(model, root, tip, flap, &profile, elements, 3, &blade));
        TRY(pdn_model_add_rigid_joint(model, hub, blade.first, root, &clamp));
        TRY(pdn_model_add_load(model, blade.last, PDN_FRAME_SPACE, PDN_FORCE_1, &lift));
    }
    TRY(pdn_model_add_revolute(model, PDN_GROUND, hub, centre, shaft, &bearing));
    TRY(pdn_model_set_gravity(model, gravity));
    TRY(pdn_model_prescribe(model, bearing, PDN_ROTATION, &turn));
    *tip_node = blade.last;
    return model;
}

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
        TRY(pdn_solution_node_position(solution, tip, &time, 1, position));
        printf("%d ranks: outcome %d, %zu unknowns, %zu iterations, %zu products, %.1f s, of which "
               "start %.1f, linearisations %.1f, factors %.1f, linear solves %.1f\n",
               ranks, report.outcome, report.unknowns, report.iterations, report.products, seconds,
               report.start_time, report.linearisation_time, report.factor_time,
               report.solve_time);
        printf("memory of a rank: %.0f MB, of which equations %.0f MB; tip at %.12f %.12f %.12f\n",
               most, (double)report.bytes / 1e6, position[0], position[1], position[2]);
        pdn_solution_free(solution);
    }
    pdn_model_free(model);
    return PetscFinalize();
}
