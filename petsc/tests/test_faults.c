/* test_faults FAULT: what is wrong on one rank of 2 to 4 ends all, with the same status and the same
 * message. */

#include "mechanisms.h"
#include "periodyn_petsc.h"

#include <petscsys.h>

enum { LATE = 90 };

static int rank, ranks;

/* Gives up on rank 1 after so many calls; elsewhere it does nothing. */
static long calls, most_calls = -1;

static int32_t force(double time, double *value, void *user_data)
{
    (void)user_data;
    *value = sin(2 * PI * time);
    if (most_calls >= 0 && ++calls > most_calls) {
        pdn_set_callback_error("the wind has gone");
        return 7;
    }
    return 0;
}

static void all_fail(pdn_status status, pdn_status expected, const char *text)
{
    int least, most;
    char message[600];
    pdn_last_error(message, sizeof message);
    printf("rank %d: %s: %s\n", rank, pdn_status_name(status), message);
    MPI_Allreduce(&status, &least, 1, MPI_INT, MPI_MIN, PETSC_COMM_WORLD);
    MPI_Allreduce(&status, &most, 1, MPI_INT, MPI_MAX, PETSC_COMM_WORLD);
    CHECK(least == most && status == expected);
    CHECK(strstr(message, text) != NULL);
}

int main(int argc, char **argv)
{
    PetscInitialize(&argc, &argv, NULL, NULL);
    CHECK(argc == 2);
    const char *fault = argv[1];
    MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
    MPI_Comm_size(PETSC_COMM_WORLD, &ranks);
    struct test_model model = rotor(2, 9);
    pdn_petsc_options options;
    pdn_periodic_options serial;
    pdn_solution *start, *untouched = (pdn_solution *)&calls, *out = untouched;
    PDN_INIT(pdn_petsc_options, &options);
    PDN_INIT(pdn_periodic_options, &serial);
    options.grid_points = model.points;
    serial.grid_points = 5;

    if (strncmp(fault, "callback", 8) == 0) {
        pdn_signal push;
        PDN_INIT(pdn_signal, &push);
        GOOD(pdn_signal_set_function(&push, force, NULL));
        GOOD(
            pdn_model_add_load(model.model, model.node, PDN_FRAME_SPACE, PDN_FORCE_2, &push, NULL));
        /* While each rank looks for a start, when there is one, or in the middle of the solve. */
        start = NULL;
        if (strcmp(fault, "callback_start") != 0) {
            GOOD(pdn_solve_periodic(model.model, model.period, &serial, &start));
        }
        options.initial = start;
        most_calls = rank == 1 ? (strcmp(fault, "callback_late") == 0 ? LATE : 3) : -1;
        all_fail(pdn_petsc_solve(PETSC_COMM_WORLD, model.model, model.period, &options, NULL, &out),
                 PDN_ERR_CALLBACK, "rank 1: ");
        char message[600];
        pdn_last_error(message, sizeof message);
        CHECK(strstr(message, "the wind has gone") != NULL);
        CHECK(rank != 1 || calls > 3);
        most_calls = -1;
        pdn_solution_free(start);
        options.initial = NULL;
    } else if (strcmp(fault, "empty_rank") == 0) {
        int32_t owners[64] = {0};
        options.owner_count = 1 + 3 * (2 * 3 + 1);
        for (size_t i = 0; i < options.owner_count; ++i) {
            const int32_t owner = (int32_t)i % ranks;
            owners[i] = owner == 1 ? 0 : owner;
        }
        options.owners = owners;
        all_fail(pdn_petsc_solve(PETSC_COMM_WORLD, model.model, model.period, &options, NULL, &out),
                 PDN_ERR_VALUE, "none for rank 1");
        options.owners = NULL;
    } else if (strcmp(fault, "many_ranks") == 0) {
        const double centre[3] = {0.5, 0, 0}, inertia[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
        const double origin[3] = {0, 0, 0}, axis[3] = {0, 0, 1};
        struct test_model small = {.period = 1};
        int32_t body;
        GOOD(pdn_model_new(&small.model));
        GOOD(pdn_model_add_rigid_body(small.model, 1, centre, inertia, &body));
        GOOD(pdn_model_add_revolute(small.model, PDN_GROUND, body, origin, axis, &small.joint));
        turn(&small, 2 * PI);
        all_fail(pdn_petsc_solve(PETSC_COMM_WORLD, small.model, 1, &options, NULL, &out),
                 PDN_ERR_VALUE, "at most 1, one for each node");
        pdn_model_free(small.model);
    } else if (strcmp(fault, "other_model") == 0) {
        const double gravity[3] = {0, 0, rank == ranks - 1 ? -9.8 : -9.81};
        char last[40];
        snprintf(last, sizeof last, "another one on rank %d", ranks - 1);
        GOOD(pdn_model_set_gravity(model.model, gravity));
        all_fail(pdn_petsc_solve(PETSC_COMM_WORLD, model.model, model.period, &options, NULL, &out),
                 PDN_ERR_VALUE, last);
        const double same[3] = {0, 0, -9.81};
        GOOD(pdn_model_set_gravity(model.model, same));
    } else if (strcmp(fault, "other_period") == 0) {
        const double period = rank == 1 ? 2 * model.period : model.period;
        all_fail(pdn_petsc_solve(PETSC_COMM_WORLD, model.model, period, &options, NULL, &out),
                 PDN_ERR_VALUE, "another one on rank 1");
    } else {
        CHECK(strcmp(fault, "null") == 0);
        all_fail(pdn_petsc_solve(PETSC_COMM_WORLD, rank == 1 ? NULL : model.model, model.period,
                                 &options, NULL, &out),
                 PDN_ERR_NULL, "rank 1: model: ");
    }
    CHECK(out == untouched);

    /* Nothing is broken: the same is solved afterwards. */
    out = NULL;
    options.root = 1;
    GOOD(pdn_petsc_solve(PETSC_COMM_WORLD, model.model, model.period, &options, NULL, &out));
    CHECK((out != NULL) == (rank == 1));
    CHECK(out == NULL || pdn_solution_outcome(out) == PDN_CONVERGED);
    pdn_solution_free(out);
    pdn_model_free(model.model);
    return PetscFinalize();
}
