/* test_sweep FILE [kill | resume]: a study of oscillators with other springs, against their closed
 * form. In `kill` a rank is killed in the middle of a case, while the other works; `resume` tears
 * the last line of what is there then, and goes on. */

#include "mechanisms.h"
#include "periodyn_petsc.h"

#include <petscsys.h>
#include <time.h>

#include <signal.h>
#include <unistd.h>

enum { TASKS = 40, KILLED = 12, FAILS = 5 };
static const double MASS = 2, DAMPING = 0.3, FORCE = 1.5, OMEGA = 2;

static int rank, kills;
static size_t own;
/* How often this rank was asked for each case. */
static int asked[TASKS];

static double stiffness_of(size_t task)
{
    return 5 + 0.5 * (double)task;
}

/* Amplitude of an oscillator under a harmonic force. */
static int32_t oscillator(size_t task, double *results, size_t count, void *user_data)
{
    const double origin[3] = {0, 0, 0}, inertia[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    const double axis[3] = {1, 0, 0}, cosines[1] = {FORCE}, sines[1] = {0};
    pdn_model *model;
    pdn_signal push;
    pdn_periodic_options options;
    pdn_solution *solution;
    int32_t body, slide, spring;
    double mean, cosine, sine;
    CHECK(count == 2 && user_data == &own);
    /* As long as a small solve, so that both ranks have their share. */
    const struct timespec pause = {.tv_nsec = 5000000};
    nanosleep(&pause, NULL);
    asked[task]++;
    if (kills && rank == 1 && ++own == KILLED) {
        raise(SIGKILL);
    }
    if (task == FAILS) {
        return 42;
    }
    GOOD(pdn_model_new(&model));
    GOOD(pdn_model_add_rigid_body(model, MASS, origin, inertia, &body));
    GOOD(pdn_model_add_prismatic(model, PDN_GROUND, body, origin, axis, &slide));
    GOOD(pdn_model_add_spring_damper(model, slide, PDN_DISPLACEMENT, stiffness_of(task), DAMPING, 0,
                                     &spring));
    PDN_INIT(pdn_signal, &push);
    GOOD(pdn_signal_set_harmonics(&push, 0, 0, cosines, sines, 1));
    GOOD(pdn_model_add_load(model, body, PDN_FRAME_SPACE, PDN_FORCE_1, &push, NULL));
    PDN_INIT(pdn_periodic_options, &options);
    options.grid_points = 7;
    GOOD(pdn_solve_periodic(model, 2 * PI / OMEGA, &options, &solution));
    GOOD(pdn_solution_harmonics(solution,
                                PDN_QUANTITY(PDN_JOINT_COORDINATE, slide, PDN_DISPLACEMENT), 1,
                                &mean, NULL, &cosine, &sine));
    results[0] = hypot(cosine, sine);
    results[1] = stiffness_of(task);
    pdn_solution_free(solution);
    pdn_model_free(model);
    return PDN_OK;
}

/* Which cases the file has. */
static size_t read_known(const char *file, int *known)
{
    size_t count = 0;
    for (size_t task = 0; task < TASKS; ++task) {
        double results[2];
        int32_t status;
        known[task] = pdn_sweep_read(file, task, &status, results, 2) == PDN_OK;
        count += (size_t)known[task];
    }
    return count;
}

/* Leaves only half of the last line, and another digit in the first: two cases less. */
static void tear(const char *file)
{
    int before[TASKS], after[TASKS];
    const size_t count = read_known(file, before);
    FILE *stream = fopen(file, "r+b");
    char line[200];
    CHECK(stream != NULL && fgets(line, sizeof line, stream) != NULL);
    const long length = (long)strlen(line);
    /* The third digit of the first result of the first case. */
    const long place = length + 9 + 1 + 11 + 1 + 6;
    fseek(stream, place, SEEK_SET);
    const int digit = fgetc(stream);
    CHECK(digit >= '0' && digit <= '9');
    fseek(stream, place, SEEK_SET);
    fputc(digit == '9' ? '8' : digit + 1, stream);
    fclose(stream);
    size_t last = TASKS - 1;
    while (!before[last]) {
        CHECK(last-- > 1);
    }
    CHECK(truncate(file, length * (long)(last + 1) + length / 2) == 0);
    CHECK(read_known(file, after) == count - 2 && !after[0] && !after[last]);
}

int main(int argc, char **argv)
{
    PetscInitialize(&argc, &argv, NULL, NULL);
    CHECK(argc >= 2);
    const char *file = argv[1];
    const int resumes = argc > 2 && strcmp(argv[2], "resume") == 0;
    kills = argc > 2 && !resumes;
    MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
    if (rank == 0 && argc == 2) {
        remove(file);
    }
    int known[TASKS] = {0};
    if (rank == 0 && resumes) {
        tear(file);
        /* All that the killed rank had solved before, and some of the other. */
        CHECK(read_known(file, known) >= KILLED - 1 - 2);
    }
    MPI_Bcast(known, TASKS, MPI_INT, 0, PETSC_COMM_WORLD);
    pdn_sweep_report report;
    PDN_INIT(pdn_sweep_report, &report);
    GOOD(pdn_sweep(PETSC_COMM_WORLD, TASKS, 2, oscillator, &own, file, &report));
    printf("rank %d: %zu known, %zu solved, %zu here\n", rank, report.known, report.solved,
           report.own);
    CHECK(report.known + report.solved == TASKS && report.failed == 1);
    /* Each case that was missing was solved once, and no other. */
    MPI_Allreduce(MPI_IN_PLACE, asked, TASKS, MPI_INT, MPI_SUM, PETSC_COMM_WORLD);
    size_t solved = 0;
    for (size_t task = 0; task < TASKS; ++task) {
        CHECK(asked[task] == !known[task]);
        solved += !known[task];
    }
    CHECK(report.solved == solved && (resumes || solved == TASKS) && solved > 0);
    for (size_t task = 0; task < TASKS; ++task) {
        const double imaginary = DAMPING * OMEGA, real = stiffness_of(task) - MASS * OMEGA * OMEGA;
        double results[2];
        int32_t status;
        GOOD(pdn_sweep_read(file, task, &status, results, 2));
        CHECK(status == (task == FAILS ? 42 : PDN_OK));
        if (task != FAILS) {
            /* Rounding, and what Newton's method leaves. */
            CHECK(fabs(results[0] - FORCE / hypot(real, imaginary)) < 1e-9);
            CHECK(results[1] == stiffness_of(task));
        }
    }
    int32_t status;
    double results[3];
    CHECK(pdn_sweep_read(file, TASKS, &status, results, 2) == PDN_ERR_SIZE);
    CHECK(pdn_sweep_read(file, 0, &status, results, 3) == PDN_ERR_SIZE);
    CHECK(pdn_sweep_read("nowhere/sweep.csv", 0, &status, results, 2) == PDN_ERR_IO);
    MPI_Barrier(PETSC_COMM_WORLD);

    /* Again: nothing is solved. Another study in the same file is refused. */
    GOOD(pdn_sweep(PETSC_COMM_WORLD, TASKS, 2, oscillator, &own, file, &report));
    CHECK(report.solved == 0 && report.known == TASKS && report.failed == 1);
    CHECK(pdn_sweep(PETSC_COMM_WORLD, TASKS, 3, oscillator, &own, file, NULL) == PDN_ERR_FORMAT);
    CHECK(pdn_sweep(PETSC_COMM_WORLD, 0, 2, oscillator, &own, file, NULL) == PDN_ERR_SIZE);
    CHECK(pdn_sweep(PETSC_COMM_WORLD, 1, 2, NULL, NULL, file, NULL) == PDN_ERR_NULL);
    CHECK(pdn_sweep(PETSC_COMM_WORLD, 1, 2, oscillator, &own, "nowhere/sweep.csv", NULL) ==
          PDN_ERR_IO);
    return PetscFinalize();
}
