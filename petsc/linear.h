/* Equations of the ranks, and what KSP needs to solve them linearised. */
#ifndef PERIODYN_PETSC_LINEAR_H
#define PERIODYN_PETSC_LINEAR_H

#include "internal.h"

#include <petscksp.h>

struct pdn_linear {
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

/* Makes the equations of these options at the start, vectors, and KSP. By all ranks. */
pdn_status pdn_linear_new(struct pdn_linear *s, const pdn_model *model, double period,
                          const pdn_petsc_options *options, const pdn_solution *start);

/* Solves the equations as they were linearised and factored last, and takes back what the
 * compliance of constraints leaves of them; `out` may be `right_side`. By all ranks. */
pdn_status pdn_linear_solve(struct pdn_linear *s, const double *right_side, double *out,
                            double accuracy);

/* Of PETSc, which has told why. */
pdn_status pdn_of_petsc(const char *what);

/* Frees all of it, however far it came. */
void pdn_linear_free(struct pdn_linear *s);

#endif
