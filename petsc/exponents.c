/* Exponents of disturbances of a periodic solution, by SLEPc where that is. */

#include "linear.h"

#include <math.h>
#include <stdlib.h>

static pdn_status check(const pdn_model *model, const pdn_petsc_options *options, size_t wanted,
                        const double *real, const double *imaginary, const size_t *found)
{
    const char *const missing = model == NULL       ? "model"
                                : options == NULL   ? "options"
                                : real == NULL      ? "real"
                                : imaginary == NULL ? "imaginary"
                                : found == NULL     ? "found"
                                                    : NULL;
    if (missing != NULL) {
        return pdn_missing(missing);
    }
    const pdn_status status = pdn_check_size("options", options->struct_size, sizeof *options);
    if (status != PDN_OK) {
        return status;
    }
    if (options->initial == NULL) {
        return pdn_failure(PDN_ERR_VALUE, "options.initial: expected the solution, got NULL");
    }
    if (wanted == 0 || wanted > 100000) {
        return pdn_failure(PDN_ERR_SIZE, "wanted: expected from 1 to 100000, got %zu", wanted);
    }
    return PDN_OK;
}

#ifdef PDN_WITH_SLEPC

#include <slepceps.h>

/* Accuracy of the solves of a step, and of eigenvalues. */
static const double OF_SOLVES = 1e-10, OF_EXPONENTS = 1e-8;
/* Cycles of Krylov-Schur after which what is found has to do: far from zero copies lie dense. */
enum { MOST_CYCLES = 8 };
/* What rounding and the accuracy of solves leave of an imaginary part at the edge. */
static const double EDGE = 1e-6;
/* With z = (x, mu x): (J + mu J1 + mu^2 J2) x = 0 where 1/mu z = T z, with
 * T (x, w) = (-J^-1 (J1 x + J2 w), x). */
static PetscErrorCode step(Mat matrix, Vec from, Vec to)
{
    struct pdn_linear *s;
    const PetscScalar *x;
    PetscScalar *y;
    PetscFunctionBeginUser;
    PetscCall(MatShellGetContext(matrix, &s));
    PetscCall(VecGetArrayRead(from, &x));
    PetscCall(VecGetArrayWrite(to, &y));
    const size_t size = s->size;
    pdn_status status = pdn_equations_power_product(s->equations, 1, x, s->trial, size);
    if (status == PDN_OK) {
        status = pdn_equations_power_product(s->equations, 2, x + size, s->simplified, size);
    }
    if (status == PDN_OK) {
        for (size_t i = 0; i < size; ++i) {
            s->trial[i] = -s->trial[i] - s->simplified[i];
        }
        status = pdn_linear_solve(s, s->trial, s->increment, OF_SOLVES);
    }
    if (status == PDN_OK) {
        memcpy(y, s->increment, size * sizeof *y);
        memcpy(y + size, x, size * sizeof *y);
    }
    PetscCall(VecRestoreArrayWrite(to, &y));
    PetscCall(VecRestoreArrayRead(from, &x));
    s->status = status != PDN_OK ? status : s->status;
    PetscCheck(status == PDN_OK, PETSC_COMM_SELF, PETSC_ERR_LIB, "a step to exponents: %s",
               pdn_status_name(status));
    PetscFunctionReturn(0);
}

/* Exponents in the strip come before copies of others, those nearer to zero before others. */
static PetscErrorCode compare(PetscScalar a, PetscScalar a_imaginary, PetscScalar b,
                              PetscScalar b_imaginary, PetscInt *result, void *edge)
{
    const double square[2] = {a * a + a_imaginary * a_imaginary, b * b + b_imaginary * b_imaginary};
    const double most = *(const double *)edge * (1 + EDGE);
    const int within[2] = {fabs(a_imaginary) <= most * square[0],
                           fabs(b_imaginary) <= most * square[1]};
    PetscFunctionBeginUser;
    *result = within[0] != within[1]   ? (within[0] ? -1 : 1)
              : square[0] == square[1] ? 0
              : square[0] > square[1]  ? -1
                                       : 1;
    PetscFunctionReturn(0);
}

/* The eigenvalues 1/mu of T; `edge` is that of the strip. */
static PetscErrorCode find_eigenvalues(struct pdn_linear *s, size_t wanted, double *edge,
                                       Mat *matrix, EPS *eps)
{
    const PetscInt local = (PetscInt)(2 * s->size);
    PetscFunctionBeginUser;
    PetscCall(MatCreateShell(s->comm, local, local, PETSC_DETERMINE, PETSC_DETERMINE, s, matrix));
    PetscCall(MatShellSetOperation(*matrix, MATOP_MULT, (void (*)(void))step));
    PetscCall(EPSCreate(s->comm, eps));
    PetscCall(EPSSetOptionsPrefix(*eps, "pdn_"));
    PetscCall(EPSSetOperators(*eps, *matrix, NULL));
    PetscCall(EPSSetProblemType(*eps, EPS_NHEP));
    PetscCall(EPSSetWhichEigenpairs(*eps, EPS_WHICH_USER));
    PetscCall(EPSSetEigenvalueComparison(*eps, compare, edge));
    PetscCall(EPSSetDimensions(*eps, (PetscInt)wanted, PETSC_DEFAULT, PETSC_DEFAULT));
    PetscCall(EPSSetTolerances(*eps, OF_EXPONENTS, MOST_CYCLES));
    PetscCall(EPSSetFromOptions(*eps));
    PetscCall(EPSSolve(*eps));
    PetscFunctionReturn(0);
}

/* Takes those of the strip, in the order in which they are, and how many there are. */
static PetscErrorCode take(EPS eps, double half, size_t wanted, double *out[3], size_t *found)
{
    PetscInt count;
    PetscFunctionBeginUser;
    PetscCall(EPSGetConverged(eps, &count));
    for (PetscInt i = 0; i < count && *found < wanted; ++i) {
        PetscScalar real, imaginary;
        PetscReal error;
        PetscCall(EPSGetEigenvalue(eps, i, &real, &imaginary));
        PetscCall(EPSGetErrorEstimate(eps, i, &error));
        const double square = real * real + imaginary * imaginary;
        const double mu[2] = {real / square, -imaginary / square};
        if (mu[1] <= -half * (1 - EDGE) || mu[1] > half * (1 + EDGE)) {
            continue;
        }
        out[0][*found] = mu[0];
        out[1][*found] = mu[1];
        if (out[2] != NULL) {
            out[2][*found] = error * hypot(mu[0], mu[1]);
        }
        ++*found;
    }
    PetscFunctionReturn(0);
}

/* Linearises the equations at the solution. */
static pdn_status linearise(struct pdn_linear *s)
{
    int32_t regular = 0;
    pdn_status status = pdn_equations_linearise(s->equations);
    for (size_t i = 0; i < s->size; ++i) {
        s->trial[i] = 1;
    }
    if (status == PDN_OK) {
        status = pdn_equations_factor(s->equations, s->trial, s->size, &regular);
    }
    if (status == PDN_OK && !regular) {
        status = pdn_failure(PDN_ERR_NOT_AVAILABLE, "the Jacobian of the solution is singular");
    }
    return status;
}

static pdn_status find(struct pdn_linear *s, double period, size_t wanted, double *out[3],
                       size_t *found)
{
    double edge = acos(-1.0) / period;
    Mat matrix = NULL;
    EPS eps = NULL;
    pdn_status status = linearise(s);
    if (status != PDN_OK) {
        return status;
    }
    s->status = PDN_OK;
    if (find_eigenvalues(s, wanted, &edge, &matrix, &eps) != 0 ||
        take(eps, edge, wanted, out, found) != 0) {
        status = s->status != PDN_OK ? s->status : pdn_of_petsc("SLEPc");
    }
    EPSDestroy(&eps);
    MatDestroy(&matrix);
    return status;
}

/* SLEPc, if the program has not. */
static pdn_status begin(void)
{
    PetscBool is_there;
    SlepcInitialized(&is_there);
    return is_there || SlepcInitializeNoArguments() == 0 ? PDN_OK : pdn_of_petsc("SLEPc");
}

#else

static pdn_status begin(void)
{
    return pdn_failure(PDN_ERR_NOT_AVAILABLE, "exponents need SLEPc, without which this library "
                                              "was built");
}

static pdn_status find(struct pdn_linear *s, double period, size_t wanted, double *out[3],
                       size_t *found)
{
    (void)s, (void)period, (void)wanted, (void)out, (void)found;
    return PDN_ERR_NOT_AVAILABLE;
}

#endif

pdn_status pdn_petsc_exponents(MPI_Comm comm, const pdn_model *model, double period,
                               const pdn_petsc_options *options, size_t wanted, double *real,
                               double *imaginary, double *errors, size_t *found)
{
    struct pdn_linear s = {.comm = comm};
    pdn_status status =
        pdn_agreed(comm, check(model, options, wanted, real, imaginary, found));
    if (status == PDN_OK) {
        status = pdn_agreed(comm, begin());
    }
    if (status != PDN_OK) {
        return status;
    }
    double *values = malloc(3 * wanted * sizeof *values);
    status = values == NULL ? pdn_failure(PDN_ERR_MEMORY, "no memory for exponents") : PDN_OK;
    status = pdn_agreed(comm, status);
    size_t count = 0;
    if (status == PDN_OK) {
        status = pdn_linear_new(&s, model, period, options, options->initial);
    }
    if (status == PDN_OK) {
        double *out[3] = {values, values + wanted, values + 2 * wanted};
        status = find(&s, period, wanted, out, &count);
    }
    if (status == PDN_OK) {
        memcpy(real, values, count * sizeof *real);
        memcpy(imaginary, values + wanted, count * sizeof *imaginary);
        if (errors != NULL) {
            memcpy(errors, values + 2 * wanted, count * sizeof *errors);
        }
        *found = count;
    }
    free(values);
    pdn_linear_free(&s);
    return status;
}
