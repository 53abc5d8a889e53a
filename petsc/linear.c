/* The linearised equations of the ranks, solved by KSP. */

#include "linear.h"

#include <math.h>
#include <stdlib.h>

/* Where KSP measures forces, of which stiff beams have large ones for small errors: relative to
 * these, and the finest. */
static const double OF_FORCES = 1e-2, FINEST_OF_FORCES = 1e-12;
/* Vectors that GMRES keeps, and most iterations of a linear solve. */
enum { RESTART = 100, MOST_PRODUCTS = 400 };

pdn_status pdn_of_petsc(const char *what)
{
    return pdn_failure(PDN_ERR_PETSC, "%s failed, PETSc has told why", what);
}

static pdn_status of_memory(void)
{
    return pdn_failure(PDN_ERR_MEMORY, "no memory for vectors");
}

/* A map of the equations, which is called `name`, from vector to vector. */
static PetscErrorCode apply(struct pdn_linear *s, const char *name,
                            pdn_status (*map)(pdn_equations *, const double *, double *, size_t),
                            Vec x, Vec y)
{
    const PetscScalar *from;
    PetscScalar *to;
    PetscFunctionBeginUser;
    PetscCall(VecGetArrayRead(x, &from));
    PetscCall(VecGetArrayWrite(y, &to));
    const pdn_status status = map(s->equations, from, to, s->size);
    PetscCall(VecRestoreArrayWrite(y, &to));
    PetscCall(VecRestoreArrayRead(x, &from));
    s->status = status != PDN_OK ? status : s->status;
    PetscCheck(status == PDN_OK, PETSC_COMM_SELF, PETSC_ERR_LIB, "%s: %s", name,
               pdn_status_name(status));
    PetscFunctionReturn(0);
}

static PetscErrorCode multiply(Mat matrix, Vec x, Vec y)
{
    struct pdn_linear *s;
    PetscFunctionBeginUser;
    PetscCall(MatShellGetContext(matrix, &s));
    PetscCall(apply(s, "pdn_equations_product", pdn_equations_product, x, y));
    PetscFunctionReturn(0);
}

static PetscErrorCode precondition(PC pc, Vec x, Vec y)
{
    struct pdn_linear *s;
    PetscFunctionBeginUser;
    PetscCall(PCShellGetContext(pc, &s));
    PetscCall(apply(s, "pdn_equations_precondition", pdn_equations_precondition, x, y));
    PetscFunctionReturn(0);
}

static PetscErrorCode set_up(struct pdn_linear *s)
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
static PetscErrorCode solve_once(struct pdn_linear *s, const double *right_side, double *out,
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

pdn_status pdn_linear_solve(struct pdn_linear *s, const double *right_side, double *out,
                            double accuracy)
{
    const double began = MPI_Wtime();
    int32_t compliant = 0;
    s->status = PDN_OK;
    if (solve_once(s, right_side, out, accuracy) != 0) {
        return s->status != PDN_OK ? s->status : pdn_of_petsc("KSP");
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
            status = s->status != PDN_OK ? s->status : pdn_of_petsc("KSP");
        }
        for (size_t i = 0; status == PDN_OK && i < s->size; ++i) {
            out[i] += second[i];
        }
        free(second);
    }
    s->report.solve_time += MPI_Wtime() - began;
    return status;
}

pdn_status pdn_linear_new(struct pdn_linear *s, const pdn_model *model, double period,
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
    status = pdn_agreed(s->comm, status);
    if (status == PDN_OK && set_up(s) != 0) {
        status = pdn_of_petsc("setting KSP up");
    }
    return status;
}

void pdn_linear_free(struct pdn_linear *s)
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
