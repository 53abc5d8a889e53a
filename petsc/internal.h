/* What the files of periodyn_petsc share. */
#ifndef PERIODYN_PETSC_INTERNAL_H
#define PERIODYN_PETSC_INTERNAL_H

#include "periodyn_petsc.h"

#include <string.h>

/* Gives the status, and the text that pdn_last_error then has, as printf does. */
pdn_status pdn_failure(pdn_status status, const char *format, ...);

/* Of an argument that is NULL, or of a struct of another size; PDN_OK for one that fits. */
pdn_status pdn_missing(const char *name);
pdn_status pdn_check_size(const char *name, size_t given, size_t expected);

/* The least of the statuses of all ranks, the same on all, where that is none of success with the
 * message of the first rank that has it. By all ranks. */
pdn_status pdn_agreed(MPI_Comm comm, pdn_status status);

/* Writes as much of the defaults as fits, zero to the rest, and the size of the struct. */
void pdn_write_defaults(void *out, size_t out_size, const void *defaults, size_t size);

#endif
