/* The ranks of MPI, for pdn_equations. */

#include "internal.h"

#include <limits.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

/* Bytes of what is told of a failure. */
enum { MESSAGE = 500 };

/* Counts as MPI wants them, and where each part begins; 0 if they are too many. */
static int counts_of(int ranks, const size_t *counts, int *out, int *first)
{
    size_t sum = 0;
    for (int r = 0; r < ranks; ++r) {
        if (counts[r] > INT_MAX || sum > INT_MAX) {
            return 0;
        }
        out[r] = (int)counts[r];
        first[r] = (int)sum;
        sum += counts[r];
    }
    return 1;
}

static int32_t exchange(const double *send, const size_t *send_counts, double *receive,
                        const size_t *receive_counts, void *user_data)
{
    const MPI_Comm comm = *(MPI_Comm *)user_data;
    int ranks, code = 1;
    MPI_Comm_size(comm, &ranks);
    int *numbers = malloc(4 * (size_t)ranks * sizeof *numbers);
    if (numbers == NULL) {
        return 1;
    }
    int *from = numbers + 2 * ranks;
    if (counts_of(ranks, send_counts, numbers, numbers + ranks) &&
        counts_of(ranks, receive_counts, from, from + ranks)) {
        code = MPI_Alltoallv(send, numbers, numbers + ranks, MPI_DOUBLE, receive, from,
                             from + ranks, MPI_DOUBLE, comm);
    } else {
        pdn_set_callback_error("more numbers between two ranks than MPI counts");
    }
    free(numbers);
    return code;
}

static int32_t gather(const double *send, size_t send_count, double *receive,
                      const size_t *receive_counts, void *user_data)
{
    const MPI_Comm comm = *(MPI_Comm *)user_data;
    int ranks, code = 1;
    MPI_Comm_size(comm, &ranks);
    int *numbers = malloc(2 * (size_t)ranks * sizeof *numbers);
    if (numbers == NULL) {
        return 1;
    }
    if (send_count <= INT_MAX && counts_of(ranks, receive_counts, numbers, numbers + ranks)) {
        code = MPI_Allgatherv(send, (int)send_count, MPI_DOUBLE, receive, numbers, numbers + ranks,
                              MPI_DOUBLE, comm);
    } else {
        pdn_set_callback_error("more numbers of a rank than MPI counts");
    }
    free(numbers);
    return code;
}

void pdn_petsc_set_ranks(MPI_Comm *comm, pdn_equations_options *options)
{
    int rank, ranks;
    MPI_Comm_rank(*comm, &rank);
    MPI_Comm_size(*comm, &ranks);
    options->rank = rank;
    options->ranks = ranks;
    options->exchange = exchange;
    options->gather = gather;
    options->ranks_data = comm;
}

pdn_status pdn_failure(pdn_status status, const char *format, ...)
{
    char text[MESSAGE];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    pdn_set_last_error(text);
    return status;
}

pdn_status pdn_missing(const char *name)
{
    return pdn_failure(PDN_ERR_NULL, "%s: expected a pointer, got NULL", name);
}

pdn_status pdn_check_size(const char *name, size_t given, size_t expected)
{
    return given == expected ? PDN_OK
                             : pdn_failure(PDN_ERR_STRUCT_SIZE,
                                           "%s: expected struct_size %zu, got %zu", name, expected,
                                           given);
}

pdn_status pdn_agreed(MPI_Comm comm, pdn_status status)
{
    struct {
        int status, rank;
    } own, worst;
    char text[MESSAGE];
    int ranks;
    MPI_Comm_size(comm, &ranks);
    MPI_Comm_rank(comm, &own.rank);
    own.status = status;
    worst = own;
    MPI_Allreduce(&own, &worst, 1, MPI_2INT, MPI_MINLOC, comm);
    if (worst.status == PDN_OK || ranks == 1) {
        return worst.status;
    }
    pdn_last_error(text, sizeof text);
    MPI_Bcast(text, sizeof text, MPI_CHAR, worst.rank, comm);
    return pdn_failure(worst.status, "rank %d: %s", worst.rank, text);
}

void pdn_write_defaults(void *out, size_t out_size, const void *defaults, size_t size)
{
    const size_t known = out_size < size ? out_size : size;
    if (out == NULL || out_size < sizeof(size_t)) {
        return;
    }
    memset(out, 0, out_size);
    memcpy(out, defaults, known);
    *(size_t *)out = out_size;
}
