/* What the files of periodyn_petsc share. */
#ifndef PERIODYN_PETSC_INTERNAL_H
#define PERIODYN_PETSC_INTERNAL_H

#include "periodyn_petsc.h"

#include <string.h>

/* The first of the statuses of all ranks that is none of success, the same on all. By all ranks. */
pdn_status pdn_agreed(MPI_Comm comm, pdn_status status);

/* Writes as much of the defaults as fits, zero to the rest, and the size of the struct. */
void pdn_write_defaults(void *out, size_t out_size, const void *defaults, size_t size);

#endif
