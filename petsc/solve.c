/* Newton's method on the manifold of motions, with linear equations solved by KSP. */

#include "linear.h"

#include <math.h>

/* Accuracy of linear solves, relative to the right side in the preconditioned norm: that of the
 * last increment, so that convergence stays quadratic, between these. */
static const double FORCING = 0.01, COARSE = 1e-4, FINEST = 1e-10;
/* Of simplified increments, which the line search looks at. */
static const double ROUGH = 1e-2;
/* Error that the last step may leave in multipliers, relative to the tolerance. */
static const double ERROR_LEFT = 1e-3;
/* The shortest step. */
static const double SHORTEST = 1e-3;

static void negate(size_t size, const double *x, double *out)
{
    for (size_t i = 0; i < size; ++i) {
        out[i] = -x[i];
    }
}

/* Linearises and finds the increment; `regular` is 0 where that cannot be. */
static pdn_status find_increment(struct pdn_linear *s, double accuracy, int32_t *regular)
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
        status = pdn_linear_solve(s, s->trial, s->increment, accuracy);
    }
    return status;
}

/* Looks for a step along the increment, whose largest motion is `length`: one after which the
 * simplified increment is shorter. `step` is 0 if there is none. */
static pdn_status search(struct pdn_linear *s, double length, int is_last, double *step)
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
        status = pdn_linear_solve(s, s->simplified, s->simplified, ROUGH);
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

static pdn_status iterate(struct pdn_linear *s, const pdn_petsc_options *options)
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

void pdn_petsc_options_init(pdn_petsc_options *options, size_t struct_size)
{
    const pdn_petsc_options defaults = {.preconditioner = PDN_LINEAR_AUTOMATIC,
                                        .start_points = 9,
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
        return pdn_missing(missing);
    }
    const pdn_status status = pdn_check_size("options", options->struct_size, sizeof *options);
    if (status != PDN_OK || report == NULL) {
        return status;
    }
    return pdn_check_size("report", report->struct_size, sizeof *report);
}

pdn_status pdn_petsc_solve(MPI_Comm comm, const pdn_model *model, double period,
                           const pdn_petsc_options *options, pdn_petsc_report *report,
                           pdn_solution **out)
{
    struct pdn_linear s = {.comm = comm};
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
        status = pdn_linear_new(&s, model, period, options,
                                options->initial != NULL ? options->initial : start);
    }
    pdn_solution_free(start);
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
    pdn_linear_free(&s);
    return status;
}
