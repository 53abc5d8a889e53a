/* Periodic motions on many processes: one model divided among the ranks of MPI and solved by PETSc,
 * and studies of many load cases.
 *
 * PETSc and MPI are not needed for anything but this companion of libperiodyn. docs/cluster.md tells
 * how to build and launch it. What is said to be called by all ranks must be called by all ranks of
 * the communicator; it then gives the same status on all. */
#ifndef PERIODYN_PETSC_H
#define PERIODYN_PETSC_H

#include <mpi.h>
#include <periodyn.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Status: a call of PETSc or MPI failed, which has told why. */
#define PDN_ERR_PETSC (-1000)

/* Options of pdn_petsc_solve. Set the defaults by PDN_INIT(pdn_petsc_options, &options). */
typedef struct pdn_petsc_options {
    /* Set by the initialiser. */
    size_t struct_size;
    /* Number N of grid points, odd; to be set. */
    size_t grid_points;
    /* Where Newton's method begins: a solution that each rank has, on any grid; NULL for one on
     * start_points that each rank finds by itself. Default NULL. */
    const pdn_solution *initial;
    /* Points of that grid, odd, not more than grid_points are used. Default 9. */
    size_t start_points;
    /* Largest increment of a converged solution, as pdn_periodic_options.tolerance. Default 1e-9. */
    double tolerance;
    /* Most Newton iterations. Default 30. */
    size_t iteration_limit;
    /* Rank of each node, of length [owner_count]; NULL for runs of nodes with about the same work.
     * Default NULL. */
    const int32_t *owners;
    size_t owner_count;
    /* As pdn_equations_options.preconditioner. Default PDN_LINEAR_AUTOMATIC. */
    int32_t preconditioner;
    /* Threads of each rank. Default 1. */
    int32_t threads;
    /* The rank that gets the solution, -1 for all. Default -1. */
    int32_t root;
    /* Zero. */
    int32_t reserved;
} pdn_petsc_options;

/* How it went; the same on all ranks but for bytes and size. */
typedef struct pdn_petsc_report {
    /* Set by the initialiser. */
    size_t struct_size;
    /* PDN_CONVERGED, PDN_ITERATION_LIMIT, PDN_STALLED or PDN_SINGULAR. */
    int32_t outcome;
    /* The preconditioner that was used: PDN_LINEAR_TIME_LOCAL, ... */
    int32_t preconditioner;
    /* Newton iterations. */
    size_t iterations;
    /* Iterations of KSP in all linear solves. */
    size_t products;
    /* Unknowns of all ranks, with those of stress resultants. */
    size_t unknowns;
    /* Those of this rank, and copies that it keeps of others'. */
    size_t size, halo;
    /* Bytes of this rank's tangents, factors and vectors, without those of KSP. */
    size_t bytes;
    /* Last increment of a motion. */
    double increment;
    /* Seconds of the start, of linearisations, of preconditioners' factors, of linear solves. */
    double start_time, linearisation_time, factor_time, solve_time;
} pdn_petsc_report;

/* Set defaults, or struct_size; use PDN_INIT. */
void pdn_petsc_options_init(pdn_petsc_options *options, size_t struct_size);
void pdn_petsc_report_init(pdn_petsc_report *report, size_t struct_size);

/* Finds the periodic response of a model, divided among the ranks of `comm`. By all ranks, after
 * PetscInitialize.
 *
 * Newton's method with exact products, and a line search by natural monotonicity, from a solution on
 * few points. Linear equations are solved by KSP with the prefix pdn_, so that -pdn_ksp_view,
 * -pdn_ksp_monitor, -pdn_ksp_type and the like work; GMRES preconditioned from the left unless told
 * otherwise, as its norm then is of motions rather than of forces.
 *
 * model, period, options: the same on all ranks, which is checked, but for threads.
 * report: may be NULL.
 * out: the solution, converged or not, on the ranks that get one, NULL on the others; to be freed by
 * pdn_solution_free; written on success only.
 * Returns PDN_OK, or what pdn_equations_new and the other functions of pdn_equations return;
 * pdn_last_error tells why, on all ranks; PDN_ERR_PETSC. */
pdn_status pdn_petsc_solve(MPI_Comm comm, const pdn_model *model, double period,
                           const pdn_petsc_options *options, pdn_petsc_report *report,
                           pdn_solution **out);

/* Finds exponents of the disturbances exp(mu t) phi(t) of a periodic solution, where phi has its
 * period: those with the smallest |mu|, from which exp(mu T) are Floquet multipliers. By all ranks.
 *
 * For models that are too large for pdn_solve_stability. By SLEPc, from the equations on the grid
 * (PDN_ERR_NOT_AVAILABLE where the library was built without it): the eigenvalues nearest to zero
 * of the pencil J + mu J1 + mu^2 J2 by Krylov-Schur, whose steps are solves with the Jacobian as
 * those of pdn_petsc_solve are. Each disturbance has as many copies mu + i j 2 pi / T as the grid
 * resolves; those with the imaginary part in (-pi / T, pi / T] are given, one for each multiplier.
 * A zero shift serves for all of these, as the copies of each mode are as near to it as to any. Of
 * multipliers that are equal, as those of blades that do not feel each other, one may be given.
 * Options of SLEPc have the prefix pdn_, as -pdn_eps_view; those of KSP too.
 *
 * options: as for pdn_petsc_solve; initial is the solution, on each rank, and needed.
 * wanted: how many exponents are asked for, each of a pair by itself.
 * real, imaginary: arrays of length [wanted] for mu, nearest to zero first; errors: of the same
 * length, estimated error of each; may be NULL.
 * found: how many there are, at most [wanted]; fewer where the iteration does not find them.
 * Returns PDN_OK, PDN_ERR_NULL, PDN_ERR_SIZE (none wanted), PDN_ERR_VALUE (no initial solution),
 * PDN_ERR_STRUCT_SIZE, PDN_ERR_NOT_AVAILABLE (also where the Jacobian is singular), PDN_ERR_PETSC,
 * or what the functions of pdn_equations return; pdn_last_error tells why, on all ranks. */
pdn_status pdn_petsc_exponents(MPI_Comm comm, const pdn_model *model, double period,
                               const pdn_petsc_options *options, size_t wanted, double *real,
                               double *imaginary, double *errors, size_t *found);

/* Sets rank, ranks, exchange, gather and ranks_data of the options for the ranks of `comm`, which
 * must outlive the equations; *comm is what ranks_data points to. */
void pdn_petsc_set_ranks(MPI_Comm *comm, pdn_equations_options *options);

/* One case of a study: writes [count] numbers to `results`, zero before. The case solves a model by
 * itself, on this rank; make it here of the number of the case, or load it. Returns PDN_OK, or any
 * other number, which is recorded. */
typedef int32_t (*pdn_sweep_fn)(size_t task, double *results, size_t count, void *user_data);

/* What a study did; the same on all ranks. */
typedef struct pdn_sweep_report {
    /* Set by the initialiser. */
    size_t struct_size;
    /* Cases that the file had already, that were solved now, and how many of all have failed. */
    size_t known, solved, failed;
    /* Cases that this rank solved. */
    size_t own;
} pdn_sweep_report;

void pdn_sweep_report_init(pdn_sweep_report *report, size_t struct_size);

/* Goes through `tasks` cases, each on the rank that is free next, and keeps their results in one
 * file. By all ranks.
 *
 * The file is a table in text, a line of one length for each case: its number, its status, [count]
 * numbers with 17 digits, and a check sum. A case is written when it is solved; a line that is not
 * whole does not count. Where the file is there already, of a study of as many cases and results
 * that was cut off, only what is missing is solved.
 *
 * path: where to, the same on all ranks, on a file system that they share.
 * report: may be NULL.
 * Returns PDN_OK also where cases failed; PDN_ERR_NULL; PDN_ERR_SIZE (no cases, or more than
 * 999999999); PDN_ERR_IO; PDN_ERR_FORMAT (a file of something else); PDN_ERR_PETSC (of MPI). */
pdn_status pdn_sweep(MPI_Comm comm, size_t tasks, size_t count, pdn_sweep_fn function,
                     void *user_data, const char *path, pdn_sweep_report *report);

/* Reads the results of a case from such a file. On one rank, or none.
 *
 * status: what the case returned; results: array of length [count].
 * Returns PDN_OK, PDN_ERR_NULL, PDN_ERR_IO, PDN_ERR_FORMAT, PDN_ERR_NOT_AVAILABLE (not solved yet),
 * PDN_ERR_SIZE (no such case, another number of results). */
pdn_status pdn_sweep_read(const char *path, size_t task, int32_t *status, double *results,
                          size_t count);

#ifdef __cplusplus
}
#endif

#endif
