/* A study of a rotor blade: how its tip moves and what its root bears at many rotor speeds and
 * thrusts, each case on the rank that is free next. Cases near resonance take longer than others.
 *
 *   mpirun -n 2 study [cases] [file] [loop | compare]
 *
 * `file` gets the results, and a study that was cut off goes on from there; see docs/cluster.md.
 * `loop` goes through the cases one after the other on one rank and without a file. `compare` does
 * so after the study, and fails if a result differs.
 */

#include "periodyn_petsc.h"

#include <math.h>
#include <mpi.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Ends a case with the status of a call that fails. */
#define TRY(call)                                                                                  \
    do {                                                                                           \
        const pdn_status status_of_call = (call);                                                  \
        if (status_of_call != PDN_OK) {                                                            \
            status = status_of_call;                                                               \
            goto done;                                                                             \
        }                                                                                          \
    } while (0)

static const double PI = 3.14159265358979323846;
/* A case that is solved, but has no periodic motion. */
enum { NOT_CONVERGED = 1 };
/* Mean and amplitude at once a revolution of the tip's flap; the same of the root's flap moment;
 * grid points. */
enum { RESULTS = 5, GRID_POINTS = RESULTS - 1 };
/* Speeds for each thrust. */
enum { SPEEDS = 20 };
static const size_t ELEMENTS = 24, DEGREE = 4;

/* What a rank has seen of its cases: seconds in all, and of the longest. */
struct seen {
    double all, longest;
};

/* Revolutions a second, and mean thrust on the tip. */
static double speed_of(size_t task)
{
    return 0.5 + 0.05 * (double)(task % SPEEDS);
}

static double thrust_of(size_t task)
{
    return 500 + 400 * (double)(task / SPEEDS);
}

/* The blade of c_examples/rotor_blade.c. */
static pdn_status make_blade(size_t task, pdn_model **out, int32_t *clamp, int32_t *gauge)
{
    const double centre[3] = {0, 0, 0}, root[3] = {0, 0, 0.5}, tip[3] = {0, 0, 10.5};
    const double shaft[3] = {1, 0, 0}, gravity[3] = {0, 0, -9.81};
    const double pitch = 8 * PI / 180, flapwise[3] = {cos(pitch), sin(pitch), 0};
    const double stiffness[6] = {500e6, 100e6, 100e6, 500e3, 3.87e6, 1.30e6};
    const double mass[4] = {20.0, 0.20, 0.15, 0.05};
    const double thrust = thrust_of(task);
    const double cosines[2] = {thrust / 3, 0}, sines[2] = {0, thrust / 15};
    pdn_status status = PDN_OK;
    pdn_model *model = NULL;
    pdn_section profile;
    pdn_signal turn, lift;
    pdn_beam blade;
    int32_t hub, bearing;
    PDN_INIT(pdn_section, &profile);
    PDN_INIT(pdn_signal, &turn);
    PDN_INIT(pdn_signal, &lift);
    TRY(pdn_section_set_diagonal(&profile, stiffness, mass));
    for (int i = 3; i < 6; ++i) {
        profile.damping[7 * i] = 0.01 * stiffness[i];
    }
    TRY(pdn_model_new(&model));
    TRY(pdn_model_add_node(model, centre, NULL, &hub));
    TRY(pdn_model_add_straight_beam(model, root, tip, flapwise, &profile, ELEMENTS, DEGREE,
                                    &blade));
    TRY(pdn_model_add_revolute(model, PDN_GROUND, hub, centre, shaft, &bearing));
    TRY(pdn_model_add_rigid_joint(model, hub, blade.first, root, clamp));
    TRY(pdn_model_add_free_joint(model, hub, blade.last, tip, gauge));
    TRY(pdn_model_set_gravity(model, gravity));
    TRY(pdn_signal_set_harmonics(&turn, 0, 2 * PI * speed_of(task), NULL, NULL, 0));
    TRY(pdn_model_prescribe(model, bearing, PDN_ROTATION, &turn, NULL));
    TRY(pdn_signal_set_harmonics(&lift, thrust, 0, cosines, sines, 2));
    TRY(pdn_model_add_load(model, blade.last, PDN_FRAME_SPACE, PDN_FORCE_1, &lift, NULL));
    *out = model;
    return PDN_OK;
done:
    pdn_model_free(model);
    return status;
}

static int32_t solve_case(size_t task, double *results, size_t count, void *user_data)
{
    struct seen *seen = user_data;
    const double began = MPI_Wtime();
    pdn_status status = PDN_OK;
    pdn_model *model = NULL;
    pdn_solution *solution = NULL;
    pdn_periodic_options options;
    double cosine, sine;
    int32_t clamp, gauge;
    PDN_INIT(pdn_periodic_options, &options);
    TRY(make_blade(task, &model, &clamp, &gauge));
    TRY(pdn_solve_periodic(model, 1 / speed_of(task), &options, &solution));
    if (pdn_solution_outcome(solution) != PDN_CONVERGED) {
        status = NOT_CONVERGED;
        goto done;
    }
    TRY(pdn_solution_harmonics(solution,
                               PDN_QUANTITY(PDN_JOINT_COORDINATE, gauge, PDN_DISPLACEMENT), 1,
                               &results[0], NULL, &cosine, &sine));
    results[1] = hypot(cosine, sine);
    double means[6], cosines[6], sines[6];
    pdn_quantity reaction = pdn_quantity_of(PDN_JOINT_REACTION, clamp, PDN_ALL_COMPONENTS);
    reaction.frame = PDN_FRAME_FIRST;
    TRY(pdn_solution_harmonics(solution, &reaction, 1, means, NULL, cosines, sines));
    results[2] = means[4];
    results[3] = hypot(cosines[4], sines[4]);
    pdn_diagnostics diagnostics;
    PDN_INIT(pdn_diagnostics, &diagnostics);
    TRY(pdn_solution_diagnostics(solution, &diagnostics));
    results[GRID_POINTS] = (double)diagnostics.grid_points;
done:
    pdn_solution_free(solution);
    pdn_model_free(model);
    const double seconds = MPI_Wtime() - began;
    seen->all += seconds;
    seen->longest = fmax(seen->longest, seconds);
    (void)count;
    return status;
}

/* Solves the cases again, and says whether they have the results that the file has of them. */
static int compare(const char *path, size_t cases)
{
    struct seen seen = {0, 0};
    int same = 1;
    for (size_t task = 0; task < cases; ++task) {
        double found[RESULTS], kept[RESULTS] = {0};
        int32_t status;
        same = pdn_sweep_read(path, task, &status, kept, RESULTS) == PDN_OK && same;
        memset(found, 0, sizeof found);
        same = solve_case(task, found, RESULTS, &seen) == status && same;
        same = memcmp(found, kept, sizeof found) == 0 && same;
    }
    return same;
}

/* One after the other; the number that failed. */
static size_t loop(size_t cases, struct seen *seen)
{
    size_t failed = 0;
    for (size_t task = 0; task < cases; ++task) {
        double results[RESULTS];
        failed += solve_case(task, results, RESULTS, seen) != PDN_OK;
    }
    return failed;
}

int main(int argc, char **argv)
{
    int rank, ranks, code = 0;
    MPI_Init(&argc, &argv);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &ranks);
    const size_t cases = argc > 1 ? strtoul(argv[1], NULL, 10) : 200;
    const char *const path = argc > 2 ? argv[2] : "study.csv";
    const char *const mode = argc > 3 ? argv[3] : "";
    struct seen seen = {0, 0};
    pdn_sweep_report report;
    PDN_INIT(pdn_sweep_report, &report);
    const double began = MPI_Wtime();
    if (strcmp(mode, "loop") == 0) {
        report.failed = rank == 0 ? loop(cases, &seen) : 0;
        report.solved = report.own = cases;
    } else {
        const pdn_status status =
            pdn_sweep(MPI_COMM_WORLD, cases, RESULTS, solve_case, &seen, path, &report);
        if (status != PDN_OK) {
            fprintf(stderr, "rank %d: the study: %s\n", rank, pdn_status_name(status));
            MPI_Abort(MPI_COMM_WORLD, 1);
        }
    }
    const double seconds = MPI_Wtime() - began;
    printf("rank %d: %zu cases, busy for %.2f s, the longest case %.2f s\n", rank, report.own,
           seen.all, seen.longest);
    MPI_Barrier(MPI_COMM_WORLD);
    if (rank == 0) {
        printf("%d ranks: %zu cases known, %zu solved, %zu failed, in %.2f s\n", ranks,
               report.known, report.solved, report.failed, seconds);
        code = report.failed > 0;
        if (strcmp(mode, "compare") == 0) {
            const int same = compare(path, cases);
            printf("one after the other: %s\n", same ? "the same results" : "other results");
            code = code || !same;
        }
    }
    MPI_Finalize();
    return code;
}
