/* What the parts of a solve on many ranks cost on this machine, and what ranks send each other: the
 * constants of the model of costs in docs/cluster.md, from which petsc/costs.py predicts.
 *
 *   mpirun -n 1 costs time ELEMENTS POINTS   seconds of the parts, on grids of up to so many points
 *   mpirun -n P costs send ELEMENTS POINTS   bytes and messages of a product, on P ranks
 *   mpirun -n 2 costs link                   seconds of messages of several sizes
 *
 * The model is the rotor of rotor_on_ranks.c. Lines are tables for costs.py, with a word for what
 * they have.
 */

#include "periodyn_petsc.h"

#include "rotor.h"

#include <stdlib.h>
#include <string.h>

/* Repetitions, of which the fastest counts: others are disturbed by what else runs. */
enum { TIMES = 7 };

/* Bytes that this rank has sent to others since it was set to zero, and messages. */
static double bytes, messages;
static pdn_exchange_fn real_exchange;
static pdn_gather_fn real_gather;
static int rank, ranks;

static void count(size_t numbers, int to)
{
    if (to != rank && numbers > 0) {
        bytes += 8.0 * (double)numbers;
        messages += 1;
    }
}

static int32_t counted_exchange(const double *send, const size_t *send_counts, double *receive,
                                const size_t *receive_counts, void *user_data)
{
    for (int to = 0; to < ranks; ++to) {
        count(send_counts[to], to);
    }
    return real_exchange(send, send_counts, receive, receive_counts, user_data);
}

static int32_t counted_gather(const double *send, size_t send_count, double *receive,
                              const size_t *receive_counts, void *user_data)
{
    for (int to = 0; to < ranks; ++to) {
        count(send_count, to);
    }
    return real_gather(send, send_count, receive, receive_counts, user_data);
}

/* The equations of ranks with the preconditioner of rotors. */
static pdn_equations *make(MPI_Comm *comm, const pdn_model *model, size_t points,
                           pdn_equations_sizes *sizes)
{
    pdn_equations_options options;
    pdn_equations *equations;
    PDN_INIT(pdn_equations_options, &options);
    PDN_INIT(pdn_equations_sizes, sizes);
    options.grid_points = points;
    options.preconditioner = PDN_LINEAR_BODY_CIRCULANT;
    pdn_petsc_set_ranks(comm, &options);
    real_exchange = options.exchange;
    real_gather = options.gather;
    options.exchange = counted_exchange;
    options.gather = counted_gather;
    TRY(pdn_equations_new(model, 1.0, &options, &equations));
    TRY(pdn_equations_get_sizes(equations, sizes));
    return equations;
}

/* The parts, in the order of a Newton iteration. */
enum { RESIDUAL, LINEARISE, FACTOR, PRODUCT, PRECONDITION, PARTS };
static const char *const NAME[PARTS] = {"residual", "linearise", "factor", "product",
                                        "precondition"};

static void do_part(int part, pdn_equations *equations, const double *x, double *y, size_t size)
{
    int32_t regular = 1;
    switch (part) {
    case RESIDUAL:
        TRY(pdn_equations_residual(equations, y, size));
        break;
    case LINEARISE:
        TRY(pdn_equations_linearise(equations));
        break;
    case FACTOR:
        TRY(pdn_equations_factor(equations, x, size, &regular));
        break;
    case PRODUCT:
        TRY(pdn_equations_product(equations, x, y, size));
        break;
    default:
        TRY(pdn_equations_precondition(equations, x, y, size));
    }
    if (!regular) {
        fprintf(stderr, "the preconditioner is singular\n");
        MPI_Abort(MPI_COMM_WORLD, 1);
    }
}

static double *wave(size_t size)
{
    double *x = malloc((size + 1) * sizeof *x);
    if (x == NULL) {
        MPI_Abort(MPI_COMM_WORLD, 1);
    }
    for (size_t i = 0; i < size; ++i) {
        x[i] = sin(0.37 * (double)i + 0.2);
    }
    return x;
}

static void measure_times(size_t elements, size_t most)
{
    static const size_t GRIDS[] = {3, 7, 15, 17, 31, 33, 47, 49, 63, 65};
    MPI_Comm self = MPI_COMM_SELF;
    int32_t tip;
    pdn_model *model = make_rotor(elements, &tip);
    for (size_t g = 0; g < sizeof GRIDS / sizeof *GRIDS && GRIDS[g] <= most; ++g) {
        pdn_equations_sizes sizes;
        const double made = MPI_Wtime();
        pdn_equations *equations = make(&self, model, GRIDS[g], &sizes);
        printf("time make %zu %zu %.6e\n", sizes.nodes, GRIDS[g], MPI_Wtime() - made);
        double *x = wave(sizes.size), *y = wave(sizes.size);
        for (int part = 0; part < PARTS; ++part) {
            double least = INFINITY;
            for (int i = 0; i < TIMES; ++i) {
                const double began = MPI_Wtime();
                do_part(part, equations, x, y, sizes.size);
                least = fmin(least, MPI_Wtime() - began);
            }
            printf("time %s %zu %zu %.6e\n", NAME[part], sizes.nodes, GRIDS[g], least);
            fflush(stdout);
        }
        free(x);
        free(y);
        pdn_equations_free(equations);
    }
    /* What GMRES does with a number of a vector: y += a x, and their product. */
    const size_t size = 4000000;
    double *x = wave(size), *y = wave(size), least = INFINITY, sum = 0;
    for (int i = 0; i < TIMES; ++i) {
        const double began = MPI_Wtime();
        for (size_t j = 0; j < size; ++j) {
            y[j] += 1e-9 * x[j];
        }
        for (size_t j = 0; j < size; ++j) {
            sum += x[j] * y[j];
        }
        least = fmin(least, MPI_Wtime() - began);
    }
    printf("time vectors %zu 1 %.6e\n", size, isfinite(sum) ? least : INFINITY);
    free(x);
    free(y);
    pdn_model_free(model);
}

static void measure_traffic(size_t elements, size_t points)
{
    MPI_Comm world = MPI_COMM_WORLD;
    int32_t tip;
    pdn_model *model = make_rotor(elements, &tip);
    pdn_equations_sizes sizes;
    pdn_equations *equations = make(&world, model, points, &sizes);
    double *x = wave(sizes.size), *y = wave(sizes.size);
    double own_nodes = (double)sizes.nodes, nodes;
    MPI_Allreduce(&own_nodes, &nodes, 1, MPI_DOUBLE, MPI_SUM, world);
    for (int part = 0; part < PARTS; ++part) {
        bytes = messages = 0;
        do_part(part, equations, x, y, sizes.size);
        double most[2] = {bytes, messages};
        MPI_Allreduce(MPI_IN_PLACE, most, 2, MPI_DOUBLE, MPI_MAX, world);
        if (rank == 0) {
            printf("send %s %d %.0f %zu %.0f %.0f\n", NAME[part], ranks, nodes, points, most[0],
                   most[1]);
        }
    }
    free(x);
    free(y);
    pdn_equations_free(equations);
    pdn_model_free(model);
}

/* Half the time of a message there and back. */
static void measure_link(void)
{
    const size_t largest = 4 << 20;
    char *buffer = calloc(largest, 1);
    if (buffer == NULL || ranks < 2) {
        fprintf(stderr, "two ranks are needed, and 4 MiB\n");
        MPI_Abort(MPI_COMM_WORLD, 1);
    }
    for (size_t size = 8; size <= largest; size *= 8) {
        const int times = size < 100000 ? 2000 : 200;
        double least = INFINITY;
        for (int i = 0; i < TIMES; ++i) {
            MPI_Barrier(MPI_COMM_WORLD);
            const double began = MPI_Wtime();
            for (int j = 0; j < times && rank < 2; ++j) {
                for (int sender = 0; sender < 2; ++sender) {
                    if (rank == sender) {
                        MPI_Send(buffer, (int)size, MPI_CHAR, 1 - rank, 0, MPI_COMM_WORLD);
                    } else {
                        MPI_Recv(buffer, (int)size, MPI_CHAR, 1 - rank, 0, MPI_COMM_WORLD,
                                 MPI_STATUS_IGNORE);
                    }
                }
            }
            least = fmin(least, (MPI_Wtime() - began) / (2 * times));
        }
        if (rank == 0) {
            printf("link message %zu %.6e\n", size, least);
        }
    }
    free(buffer);
}

int main(int argc, char **argv)
{
    MPI_Init(&argc, &argv);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &ranks);
    const char *const what = argc > 1 ? argv[1] : "";
    if (strcmp(what, "time") == 0 && argc > 3) {
        measure_times(strtoul(argv[2], NULL, 10), strtoul(argv[3], NULL, 10));
    } else if (strcmp(what, "send") == 0 && argc > 3) {
        measure_traffic(strtoul(argv[2], NULL, 10), strtoul(argv[3], NULL, 10));
    } else if (strcmp(what, "link") == 0) {
        measure_link();
    } else {
        fprintf(stderr, "costs time ELEMENTS POINTS | send ELEMENTS POINTS | link\n");
        MPI_Abort(MPI_COMM_WORLD, 1);
    }
    MPI_Finalize();
    return 0;
}
