/* Newton's method on the manifold of motions, with linear equations solved by KSP. */

#include "internal.h"

#include <math.h>
#include <petscksp.h>
#include <stdlib.h>

/* Accuracy of linear solves, relative to the right side in the preconditioned norm: that of the
 * last increment, so that convergence stays quadratic, between these. */
static const double FORCING = 0.01, COARSE = 1e-4, FINEST = 1e-10;
/* Where KSP measures forces, of which stiff beams have large ones for small errors: relative to
 * these, and the finest. */
static const double OF_FORCES = 1e-2, FINEST_OF_FORCES = 1e-12;
/* Of simplified increments, which the line search looks at. */
static const double ROUGH = 1e-2;
/* Error that the last step may leave in multipliers, relative to the tolerance. */
static const double ERROR_LEFT = 1e-3;
/* The shortest step. */
static const double SHORTEST = 1e-3;
/* Vectors that GMRES keeps, and most iterations of a linear solve. */
enum { RESTART = 100, MOST_PRODUCTS = 400 };

struct solve {
    MPI_Comm comm;
    pdn_equations *equations;
    size_t size;
    /* Of the Jacobian and its preconditioner, once they have failed. */
    pdn_status status;
    Mat jacobian;
    KSP ksp;
    PCSide side;
    Vec right_side, solution;
    double *residual, *trial, *increment, *simplified, *rest;
    pdn_petsc_report report;
};

static pdn_status of_petsc(const char *what)
{
    return pdn_failure(PDN_ERR_PETSC, "%s failed, PETSc has told why", what);
}

static pdn_status of_memory(void)
{
    return pdn_failure(PDN_ERR_MEMORY, "no memory for vectors");
}

static PetscErrorCode multiply(Mat matrix, Vec x, Vec y)
{
    struct solve *s;
    const PetscScalar *from;
    PetscScalar *to;
    PetscFunctionBeginUser;
    PetscCall(MatShellGetContext(matrix, &s));
    PetscCall(VecGetArrayRead(x, &from));
    PetscCall(VecGetArrayWrite(y, &to));
    const pdn_status status = pdn_equations_product(s->equations, from, to, s->size);
    PetscCall(VecRestoreArrayWrite(y, &to));
    PetscCall(VecRestoreArrayRead(x, &from));
    s->status = status != PDN_OK ? status : s->status;
    PetscCheck(status == PDN_OK, PETSC_COMM_SELF, PETSC_ERR_LIB, "pdn_equations_product: %s",
               pdn_status_name(status));
    PetscFunctionReturn(0);
}

static PetscErrorCode precondition(PC pc, Vec x, Vec y)
{
    struct solve *s;
    const PetscScalar *from;
    PetscScalar *to;
    PetscFunctionBeginUser;
    PetscCall(PCShellGetContext(pc, &s));
    PetscCall(VecGetArrayRead(x, &from));
    PetscCall(VecGetArrayWrite(y, &to));
    const pdn_status status = pdn_equations_precondition(s->equations, from, to, s->size);
    PetscCall(VecRestoreArrayWrite(y, &to));
    PetscCall(VecRestoreArrayRead(x, &from));
    s->status = status != PDN_OK ? status : s->status;
    PetscCheck(status == PDN_OK, PETSC_COMM_SELF, PETSC_ERR_LIB, "pdn_equations_precondition: %s",
               pdn_status_name(status));
    PetscFunctionReturn(0);
}

static PetscErrorCode set_up(struct solve *s)
{
    PC pc;
    PetscFunctionBeginUser;
    PetscCall(MatCreateShell(s->comm, (PetscInt)s->size, (PetscInt)s->size, PETSC_DETERMINE,
                             PETSC_DETERMINE, s, &s->jacobian));
    PetscCall(MatShellSetOperation(s->jacobian, MATOP_MULT, (void (*)(void))multiply));
    PetscCall(MatCreateVecs(s->jacobian, &s->solution, &s->right_side));
    PetscCall(KSPCreate(s->comm, &s->ksp));
    PetscCall(KSPSetOptionsPrefix(s->ksp, "pdn_"));
    PetscCall(KSPSetOperators(s->ksp, s->jacobian, s->jacobian));
    PetscCall(KSPSetType(s->ksp, KSPGMRES));
    PetscCall(KSPGMRESSetRestart(s->ksp, RESTART));
    PetscCall(KSPGMRESSetCGSRefinementType(s->ksp, KSP_GMRES_CGS_REFINE_IFNEEDED));
    PetscCall(KSPGetPC(s->ksp, &pc));
    PetscCall(PCSetType(pc, PCSHELL));
    PetscCall(PCShellSetContext(pc, s));
    PetscCall(PCShellSetApply(pc, precondition));
    PetscCall(PCShellSetName(pc, "periodyn"));
    PetscCall(KSPSetFromOptions(s->ksp));
    PetscCall(KSPSetUp(s->ksp));
    PetscCall(KSPGetPCSide(s->ksp, &s->side));
    PetscFunctionReturn(0);
}

/* Solves once, as accurately as that. */
static PetscErrorCode solve_once(struct solve *s, const double *right_side, double *out,
                                 double accuracy)
{
    PetscScalar *to;
    const PetscScalar *from;
    PetscInt products;
    PetscFunctionBeginUser;
    if (s->side == PC_RIGHT) {
        accuracy = fmax(OF_FORCES * accuracy, FINEST_OF_FORCES);
    }
    PetscCall(KSPSetTolerances(s->ksp, accuracy, 0.0, PETSC_DEFAULT, MOST_PRODUCTS));
    PetscCall(VecGetArrayWrite(s->right_side, &to));
    memcpy(to, right_side, s->size * sizeof *to);
    PetscCall(VecRestoreArrayWrite(s->right_side, &to));
    PetscCall(KSPSolve(s->ksp, s->right_side, s->solution));
    PetscCall(KSPGetIterationNumber(s->ksp, &products));
    s->report.products += (size_t)products;
    PetscCall(VecGetArrayRead(s->solution, &from));
    memcpy(out, from, s->size * sizeof *out);
    PetscCall(VecRestoreArrayRead(s->solution, &from));
    PetscFunctionReturn(0);
}

/* Solves, and takes back what the compliance of constraints leaves of them. */
static pdn_status solve_linear(struct solve *s, const double *right_side, double *out,
                               double accuracy)
{
    const double began = MPI_Wtime();
    int32_t compliant = 0;
    s->status = PDN_OK;
    if (solve_once(s, right_side, out, accuracy) != 0) {
        return s->status != PDN_OK ? s->status : of_petsc("KSP");
    }
    double motion, own;
    pdn_status status = pdn_equations_norms(s->equations, out, s->size, &motion, &own);
    if (status == PDN_OK && isfinite(motion)) {
        status = pdn_agreed(s->comm, pdn_equations_compliance(s->equations, out, s->rest, s->size,
                                                             &compliant));
    }
    if (status == PDN_OK && compliant) {
        double *second = malloc(s->size * sizeof *second + 1);
        status = pdn_agreed(s->comm, second == NULL ? of_memory() : PDN_OK);
        if (status == PDN_OK && solve_once(s, s->rest, second, accuracy) != 0) {
            status = s->status != PDN_OK ? s->status : of_petsc("KSP");
        }
        for (size_t i = 0; status == PDN_OK && i < s->size; ++i) {
            out[i] += second[i];
        }
        free(second);
    }
    s->report.solve_time += MPI_Wtime() - began;
    return status;
}

static void negate(size_t size, const double *x, double *out)
{
    for (size_t i = 0; i < size; ++i) {
        out[i] = -x[i];
    }
}

/* Linearises and finds the increment; `regular` is 0 where that cannot be. */
static pdn_status find_increment(struct solve *s, double accuracy, int32_t *regular)
{
    double began = MPI_Wtime();
    pdn_status status = pdn_equations_linearise(s->equations);
    s->report.linearisation_time += MPI_Wtime() - began;
    negate(s->size, s->residual, s->trial);
    began = MPI_Wtime();
    if (status == PDN_OK) {
        status = pdn_equations_factor(s->equations, s->trial, s->size, regular);
    }
    s->report.factor_time += MPI_Wtime() - began;
    if (status == PDN_OK && *regular) {
        status = solve_linear(s, s->trial, s->increment, accuracy);
    }
    return status;
}

/* Looks for a step along the increment, whose largest motion is `length`: one after which the
 * simplified increment is shorter. `step` is 0 if there is none. */
static pdn_status search(struct solve *s, double length, int is_last, double *step)
{
    for (*step = 1; *step >= SHORTEST; *step /= 2) {
        double next, own;
        pdn_status status = pdn_equations_update(s->equations, s->increment, s->size, *step);
        if (status != PDN_OK) {
            return status;
        }
        status = pdn_equations_residual(s->equations, s->trial, s->size);
        if (status == PDN_ERR_CALLBACK || status == PDN_ERR_PANIC) {
            return status;
        }
        if (status != PDN_OK) {
            continue; /* too distorted there */
        }
        if (is_last) {
            return PDN_OK;
        }
        negate(s->size, s->trial, s->simplified);
        status = solve_linear(s, s->simplified, s->simplified, ROUGH);
        if (status == PDN_OK) {
            status = pdn_equations_norms(s->equations, s->simplified, s->size, &next, &own);
        }
        if (status != PDN_OK || next <= (1 - *step / 2) * length) {
            return status;
        }
    }
    *step = 0;
    return PDN_OK;
}

static pdn_status iterate(struct solve *s, const pdn_petsc_options *options)
{
    double accuracy = COARSE;
    s->report.outcome = PDN_ITERATION_LIMIT;
    pdn_status status = pdn_equations_residual(s->equations, s->residual, s->size);
    while (status == PDN_OK && s->report.iterations < options->iteration_limit) {
        double length, own, step;
        int32_t regular = 0;
        status = find_increment(s, accuracy, &regular);
        if (status != PDN_OK) {
            return status;
        }
        length = NAN;
        if (regular) {
            status = pdn_equations_norms(s->equations, s->increment, s->size, &length, &own);
        }
        if (status != PDN_OK) {
            return status;
        }
        if (!isfinite(length)) {
            s->report.outcome = PDN_SINGULAR;
            return PDN_OK;
        }
        s->report.increment = length;
        accuracy = fmin(fmax(FORCING * length, FINEST), COARSE);
        const int is_last =
            length <= options->tolerance && length * own <= ERROR_LEFT * options->tolerance;
        status = search(s, length, is_last, &step);
        if (status != PDN_OK) {
            return status;
        }
        s->report.iterations++;
        if (step == 0) {
            s->report.outcome = PDN_STALLED;
            return pdn_equations_update(s->equations, s->increment, s->size, 0.0);
        }
        double *const residual = s->residual;
        s->residual = s->trial;
        s->trial = residual;
        if (is_last) {
            s->report.outcome = PDN_CONVERGED;
            return PDN_OK;
        }
    }
    return status;
}

/* A start on few points, or the one given. */
static pdn_status find_start(MPI_Comm comm, const pdn_model *model, double period,
                             const pdn_petsc_options *options, pdn_solution **own)
{
    pdn_periodic_options coarse;
    if (options->initial != NULL) {
        return PDN_OK;
    }
    PDN_INIT(pdn_periodic_options, &coarse);
    coarse.grid_points = options->start_points < options->grid_points ? options->start_points
                                                                     : options->grid_points;
    coarse.threads = options->threads;
    pdn_status status = pdn_solve_periodic(model, period, &coarse, own);
    return pdn_agreed(comm, status);
}

static pdn_status make_equations(struct solve *s, const pdn_model *model, double period,
                                 const pdn_petsc_options *options, const pdn_solution *start)
{
    pdn_equations_options wanted;
    pdn_equations_sizes sizes;
    PDN_INIT(pdn_equations_options, &wanted);
    wanted.grid_points = options->grid_points;
    wanted.initial = start;
    wanted.owners = options->owners;
    wanted.owner_count = options->owner_count;
    wanted.preconditioner = options->preconditioner;
    wanted.threads = options->threads;
    pdn_petsc_set_ranks(&s->comm, &wanted);
    pdn_status status = pdn_equations_new(model, period, &wanted, &s->equations);
    if (status != PDN_OK) {
        return status;
    }
    PDN_INIT(pdn_equations_sizes, &sizes);
    status = pdn_equations_get_sizes(s->equations, &sizes);
    s->size = sizes.size;
    s->report.size = sizes.size;
    s->report.halo = sizes.halo;
    s->report.unknowns = sizes.total;
    s->report.preconditioner = sizes.preconditioner;
    double **const vectors[] = {&s->residual, &s->trial, &s->increment, &s->simplified, &s->rest};
    for (size_t i = 0; i < sizeof vectors / sizeof *vectors; ++i) {
        *vectors[i] = calloc(s->size + 1, sizeof **vectors[i]);
        if (*vectors[i] == NULL) {
            status = of_memory();
        }
    }
    return pdn_agreed(s->comm, status);
}

static void tear_down(struct solve *s)
{
    KSPDestroy(&s->ksp);
    MatDestroy(&s->jacobian);
    VecDestroy(&s->right_side);
    VecDestroy(&s->solution);
    pdn_equations_free(s->equations);
    free(s->residual);
    free(s->trial);
    free(s->increment);
    free(s->simplified);
    free(s->rest);
}

void pdn_petsc_options_init(pdn_petsc_options *options, size_t struct_size)
{
    const pdn_petsc_options defaults = {.start_points = 9,
                                        .tolerance = 1e-9,
                                        .iteration_limit = 30,
                                        .threads = 1,
                                        .root = -1};
    pdn_write_defaults(options, struct_size, &defaults, sizeof defaults);
}

void pdn_petsc_report_init(pdn_petsc_report *report, size_t struct_size)
{
    const pdn_petsc_report blank = {0};
    pdn_write_defaults(report, struct_size, &blank, sizeof blank);
}

static pdn_status check(const pdn_model *model, const pdn_petsc_options *options,
                        const pdn_petsc_report *report, pdn_solution **out)
{
    const char *const missing = model == NULL     ? "model"
                                : options == NULL ? "options"
                                : out == NULL     ? "out"
                                                  : NULL;
    if (missing != NULL) {
        return pdn_failure(PDN_ERR_NULL, "%s: expected a pointer, got NULL", missing);
    }
    if (options->struct_size != sizeof *options) {
        return pdn_failure(PDN_ERR_STRUCT_SIZE, "options: expected struct_size %zu, got %zu",
                           sizeof *options, options->struct_size);
    }
    if (report != NULL && report->struct_size != sizeof *report) {
        return pdn_failure(PDN_ERR_STRUCT_SIZE, "report: expected struct_size %zu, got %zu",
                           sizeof *report, report->struct_size);
    }
    return PDN_OK;
}

pdn_status pdn_petsc_solve(MPI_Comm comm, const pdn_model *model, double period,
                           const pdn_petsc_options *options, pdn_petsc_report *report,
                           pdn_solution **out)
{
    struct solve s = {.comm = comm};
    pdn_equations_sizes sizes;
    pdn_solution *start = NULL;
    pdn_status status = pdn_agreed(comm, check(model, options, report, out));
    if (status != PDN_OK) {
        return status;
    }
    const double began = MPI_Wtime();
    status = find_start(comm, model, period, options, &start);
    s.report.start_time = MPI_Wtime() - began;
    if (status == PDN_OK) {
        status = make_equations(&s, model, period, options,
                                options->initial != NULL ? options->initial : start);
    }
    pdn_solution_free(start);
    if (status == PDN_OK && set_up(&s) != 0) {
        status = of_petsc("setting KSP up");
    }
    if (status == PDN_OK) {
        status = iterate(&s, options);
    }
    if (status == PDN_OK) {
        PDN_INIT(pdn_equations_sizes, &sizes);
        pdn_equations_get_sizes(s.equations, &sizes);
        s.report.bytes = sizes.bytes;
        status = pdn_equations_solution(s.equations, options->root, s.report.outcome, out);
    }
    if (status == PDN_OK && report != NULL) {
        s.report.struct_size = report->struct_size;
        *report = s.report;
    }
    tear_down(&s);
    return status;
}
