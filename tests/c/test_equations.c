/* The equations below the solve: a solver of the test's own, Newton's method with GMRES, finds with
 * them what the library finds; and what is refused.
 */
#include "mechanisms.h"

/* Arguments, each of them good. */
static struct {
    const pdn_model *model;
    double period;
    pdn_equations_options options;
    pdn_equations *equations;
    double *x, *motions, *own_unknowns;
    size_t size, motion_count, own_count;
} in;

static struct {
    pdn_equations *equations;
    pdn_solution *solution;
    double values[8];
    int32_t numbers[2];
    double norms[2];
} out;

static int model_changed(void)
{
    return 0; /* the model is const */
}

#include "refusal.h"

enum { MOST = 120 };

static double dot(const double *x, const double *y, size_t n)
{
    double sum = 0;
    for (size_t i = 0; i < n; ++i) {
        sum += x[i] * y[i];
    }
    return sum;
}

/* x = J^-1 b by GMRES, preconditioned from the left; gives the number of products. */
static int gmres(pdn_equations *equations, const double *b, double *x, size_t n, double accuracy)
{
    double *v = malloc((MOST + 1) * n * sizeof *v);
    static double h[MOST + 1][MOST], c[MOST], s[MOST], g[MOST + 1], y[MOST];
    int k = 0, products = 0;
    CHECK(v != NULL);
    GOOD(pdn_equations_precondition(equations, b, v, n));
    const double norm = sqrt(dot(v, v, n));
    for (size_t i = 0; i < n; ++i) {
        v[i] /= norm;
    }
    g[0] = norm;
    while (k < MOST && fabs(g[k]) > accuracy * norm) {
        double *next = v + (size_t)(k + 1) * n;
        GOOD(pdn_equations_product(equations, v + (size_t)k * n, next, n));
        GOOD(pdn_equations_precondition(equations, next, next, n));
        products++;
        for (int twice = 0; twice < 2; ++twice) {
            for (int j = 0; j <= k; ++j) {
                const double along = dot(next, v + (size_t)j * n, n);
                h[j][k] = twice ? h[j][k] + along : along;
                for (size_t i = 0; i < n; ++i) {
                    next[i] -= along * v[(size_t)j * n + i];
                }
            }
        }
        const double length = sqrt(dot(next, next, n));
        for (size_t i = 0; i < n; ++i) {
            next[i] /= length;
        }
        for (int j = 0; j < k; ++j) {
            const double upper = c[j] * h[j][k] + s[j] * h[j + 1][k];
            h[j + 1][k] = c[j] * h[j + 1][k] - s[j] * h[j][k];
            h[j][k] = upper;
        }
        const double r = hypot(h[k][k], length);
        c[k] = h[k][k] / r;
        s[k] = length / r;
        h[k][k] = r;
        g[k + 1] = -s[k] * g[k];
        g[k] *= c[k];
        k++;
    }
    CHECK(k < MOST);
    for (int i = k - 1; i >= 0; --i) {
        y[i] = g[i];
        for (int j = i + 1; j < k; ++j) {
            y[i] -= h[i][j] * y[j];
        }
        y[i] /= h[i][i];
    }
    memset(x, 0, n * sizeof *x);
    for (int j = 0; j < k; ++j) {
        for (size_t i = 0; i < n; ++i) {
            x[i] += y[j] * v[(size_t)j * n + i];
        }
    }
    free(v);
    return products;
}

/* Newton's method in full steps, to the end. */
static int newton(pdn_equations *equations, size_t n)
{
    double *r = calloc(n, sizeof *r), *x = calloc(n, sizeof *x), *rest = calloc(n, sizeof *rest);
    double length = 1, own = 1, before = 1;
    int steps = 0;
    CHECK(r != NULL && x != NULL && rest != NULL);
    GOOD(pdn_equations_residual(equations, r, n));
    for (; steps < 12 && length > 1e-9; ++steps) {
        int32_t regular, compliant;
        for (size_t i = 0; i < n; ++i) {
            r[i] = -r[i];
        }
        GOOD(pdn_equations_linearise(equations));
        GOOD(pdn_equations_factor(equations, r, n, &regular));
        CHECK(regular == 1);
        gmres(equations, r, x, n, 1e-10);
        GOOD(pdn_equations_compliance(equations, x, rest, n, &compliant));
        if (compliant) {
            gmres(equations, rest, r, n, 1e-10);
            for (size_t i = 0; i < n; ++i) {
                x[i] += r[i];
            }
        }
        before = length;
        GOOD(pdn_equations_norms(equations, x, n, &length, &own));
        GOOD(pdn_equations_update(equations, x, n, 1.0));
        GOOD(pdn_equations_residual(equations, r, n));
    }
    CHECK(length <= 1e-9);
    /* The last step is as small as the square of the one before makes it, or rounding. */
    CHECK(length <= 100 * before * before || length < 1e-11);
    free(r);
    free(x);
    free(rest);
    return steps;
}

static double difference(const struct test_model *model, const pdn_solution *a,
                         const pdn_solution *b)
{
    double most = 0, size = 0;
    for (int i = 0; i < 25; ++i) {
        const double time = model->period * i / 25;
        double x[2][3];
        GOOD(pdn_solution_sample(
            a, PDN_QUANTITY(PDN_NODE_POSITION, model->node, PDN_ALL_COMPONENTS), &time, 1, x[0]));
        GOOD(pdn_solution_sample(
            b, PDN_QUANTITY(PDN_NODE_POSITION, model->node, PDN_ALL_COMPONENTS), &time, 1, x[1]));
        for (int j = 0; j < 3; ++j) {
            most = fmax(most, fabs(x[0][j] - x[1][j]));
            size = fmax(size, fabs(x[1][j]));
        }
    }
    return most / size;
}

static void own_solver(struct test_model model, int32_t preconditioner)
{
    pdn_periodic_options serial;
    pdn_equations_options options;
    pdn_equations_sizes sizes;
    pdn_equations *equations;
    pdn_solution *start, *expected, *found;
    PDN_INIT(pdn_periodic_options, &serial);
    serial.grid_points = 7;
    GOOD(pdn_solve_periodic(model.model, model.period, &serial, &start));
    serial.grid_points = model.points;
    GOOD(pdn_solve_periodic(model.model, model.period, &serial, &expected));
    PDN_INIT(pdn_equations_options, &options);
    options.grid_points = model.points;
    options.initial = start;
    options.preconditioner = preconditioner;
    GOOD(pdn_equations_new(model.model, model.period, &options, &equations));
    PDN_INIT(pdn_equations_sizes, &sizes);
    GOOD(pdn_equations_get_sizes(equations, &sizes));
    CHECK(sizes.size == sizes.total && sizes.halo == 0);
    CHECK(sizes.motions == 12 * sizes.nodes * model.points);
    CHECK(sizes.size >= 6 * sizes.nodes * model.points + sizes.own_unknowns);
    CHECK(preconditioner == PDN_LINEAR_AUTOMATIC || sizes.preconditioner == preconditioner);
    const int steps = newton(equations, sizes.size);
    GOOD(pdn_equations_solution(equations, 0, PDN_CONVERGED, &found));
    printf("%zu unknowns, %d steps, difference %.1e\n", sizes.size, steps,
           difference(&model, found, expected));
    CHECK(pdn_solution_outcome(found) == PDN_CONVERGED);
    CHECK(difference(&model, found, expected) < 1e-10);
    CHECK(difference(&model, start, expected) > 1e-6);
    pdn_solution_free(start);
    pdn_solution_free(expected);
    pdn_solution_free(found);
    pdn_equations_free(equations);
    pdn_model_free(model.model);
}

/* y . (J x) = x . (J^T y), with stress resultants as unknowns. */
static void transposes(void)
{
    struct test_model model = rotor(2, 9);
    pdn_equations_options options;
    pdn_equations_sizes sizes;
    pdn_equations *equations;
    int32_t regular;
    PDN_INIT(pdn_equations_options, &options);
    PDN_INIT(pdn_equations_sizes, &sizes);
    options.grid_points = model.points;
    options.preconditioner = PDN_LINEAR_BODY_CIRCULANT;
    GOOD(pdn_equations_new(model.model, model.period, &options, &equations));
    GOOD(pdn_equations_get_sizes(equations, &sizes));
    const size_t n = sizes.size;
    double *x = calloc(4 * n, sizeof *x), *y = x + n, *a = x + 2 * n, *b = x + 3 * n;
    CHECK(x != NULL);
    for (size_t i = 0; i < n; ++i) {
        x[i] = sin(0.37 * (double)i);
        y[i] = cos(0.23 * (double)i);
    }
    GOOD(pdn_equations_linearise(equations));
    /* Which gives resultants their size. */
    GOOD(pdn_equations_factor(equations, x, n, &regular));
    CHECK(regular == 1);
    GOOD(pdn_equations_product(equations, x, a, n));
    GOOD(pdn_equations_transposed_product(equations, y, b, n));
    CHECK(fabs(dot(y, a, n) - dot(x, b, n)) < 1e-12 * sqrt(dot(a, a, n) * dot(y, y, n)));
    free(x);
    pdn_equations_free(equations);
    pdn_model_free(model.model);
}

/* y . (J x) = x . (J^T y); states go out and come back; numbers are those of one rank. */
static void products_and_states(void)
{
    const size_t n = in.size;
    double *x = calloc(4 * n, sizeof *x), *y = x + n, *a = x + 2 * n, *b = x + 3 * n;
    double *motions = calloc(in.motion_count, sizeof *motions);
    double *own = calloc(in.own_count, sizeof *own);
    size_t *numbers = calloc(n, sizeof *numbers);
    CHECK(x != NULL && motions != NULL && own != NULL && numbers != NULL);
    for (size_t i = 0; i < n; ++i) {
        x[i] = sin(0.37 * (double)i);
        y[i] = cos(0.23 * (double)i);
    }
    GOOD(pdn_equations_linearise(in.equations));
    GOOD(pdn_equations_product(in.equations, x, a, n));
    GOOD(pdn_equations_transposed_product(in.equations, y, b, n));
    CHECK(fabs(dot(y, a, n) - dot(x, b, n)) < 1e-12 * sqrt(dot(a, a, n) * dot(y, y, n)));
    GOOD(pdn_equations_numbers(in.equations, numbers, n));
    for (size_t i = 0; i < n; ++i) {
        CHECK(numbers[i] == i);
    }
    GOOD(pdn_equations_residual(in.equations, a, n));
    GOOD(pdn_equations_update(in.equations, x, n, 1e-3));
    GOOD(pdn_equations_state(in.equations, motions, in.motion_count, own, in.own_count));
    CHECK(memcmp(motions, in.motions, in.motion_count * sizeof *motions) != 0);
    GOOD(pdn_equations_set_state(in.equations, in.motions, in.motion_count, in.own_unknowns,
                                 in.own_count));
    GOOD(pdn_equations_residual(in.equations, b, n));
    for (size_t i = 0; i < n; ++i) {
        CHECK(fabs(a[i] - b[i]) < 1e-12);
    }
    free(x);
    free(motions);
    free(own);
    free(numbers);
}

static int32_t no_exchange(const double *send, const size_t *send_counts, double *receive,
                           const size_t *receive_counts, void *user_data)
{
    (void)send, (void)send_counts, (void)receive, (void)receive_counts, (void)user_data;
    return 3;
}

static int32_t no_gather(const double *send, size_t send_count, double *receive,
                         const size_t *receive_counts, void *user_data)
{
    (void)send, (void)send_count, (void)receive, (void)receive_counts, (void)user_data;
    pdn_set_callback_error("the line is dead");
    return 4;
}

#define NEW pdn_equations_new(in.model, in.period, &in.options, &out.equations)
#define LIST(name) pdn_equations_##name

static void refused_options(void)
{
    static const size_t even[] = {0, 2, 20};
    static const int32_t no_rank[] = {-1, 1, 7, INT32_MIN};
    const pdn_equations_options good = in.options;
    const int32_t owners[2] = {0, -4};
    REFUSED(pdn_equations_new(NULL, in.period, &in.options, &out.equations), PDN_ERR_NULL,
            "model: ");
    REFUSED(pdn_equations_new(in.model, in.period, NULL, &out.equations), PDN_ERR_NULL,
            "options: ");
    REFUSED(pdn_equations_new(in.model, in.period, &in.options, NULL), PDN_ERR_NULL, "out: ");
    REFUSES_NOT_FINITE(in.period, NEW, "period");
    REFUSES_EACH(in.options.grid_points, size_t, even, NEW, PDN_ERR_SIZE,
                 "options.grid_points: expected an odd number");
    REFUSES_EACH(in.options.rank, int32_t, no_rank, NEW, PDN_ERR_VALUE,
                 "options.rank: expected from 0 to 0");
    in.options.preconditioner = PDN_LINEAR_DIRECT;
    REFUSED(NEW, PDN_ERR_VALUE, "options.preconditioner: ");
    in.options = good;
    REFUSES_EACH(in.options.preconditioner, int32_t, bad_enums, NEW, PDN_ERR_VALUE,
                 "options.preconditioner: ");
    in.options.threads = -1;
    REFUSED(NEW, PDN_ERR_VALUE, "options.threads: ");
    in.options = good;
    in.options.struct_size = 3;
    REFUSED(NEW, PDN_ERR_STRUCT_SIZE, "options: ");
    in.options = good;
    in.options.owners = owners;
    in.options.owner_count = 2;
    REFUSED(NEW, PDN_ERR_VALUE, "options.owners[1]: expected a rank, got -4");
    in.options.owner_count = 1;
    REFUSED(NEW, PDN_ERR_SIZE, "owners: ");
    in.options = good;
    in.options.ranks = 0;
    REFUSED(NEW, PDN_ERR_VALUE, "options.ranks: ");
    in.options.ranks = 2;
    REFUSED(NEW, PDN_ERR_NULL, "options.exchange: ");
    in.options.exchange = no_exchange;
    REFUSED(NEW, PDN_ERR_NULL, "options.gather: ");
    in.options.gather = no_gather;
    REFUSED(NEW, PDN_ERR_CALLBACK, "gather: the callback returned 4: the line is dead");
    in.options = good;
}

static void refused_calls(void)
{
    pdn_equations *const none = NULL, *const good = in.equations;
    const size_t n = in.size;
    REFUSED(LIST(residual)(none, in.x, n), PDN_ERR_NULL, "equations: ");
    REFUSED(LIST(residual)(good, NULL, n), PDN_ERR_NULL, "out: ");
    REFUSED(LIST(residual)(good, in.x, n - 1), PDN_ERR_SIZE, "out: expected ");
    REFUSED(LIST(linearise)(none), PDN_ERR_NULL, "equations: ");
    REFUSED(LIST(product)(none, in.x, in.x, n), PDN_ERR_NULL, "equations: ");
    REFUSED(LIST(product)(good, NULL, in.x, n), PDN_ERR_NULL, "x: ");
    REFUSED(LIST(product)(good, in.x, NULL, n), PDN_ERR_NULL, "out: ");
    REFUSED(LIST(product)(good, in.x, in.x, n - 1), PDN_ERR_SIZE, "x: expected ");
    REFUSED(LIST(transposed_product)(good, in.x, in.x, n - 1), PDN_ERR_SIZE, "x: expected ");
    REFUSED(LIST(power_product)(good, 0, in.x, in.x, n), PDN_ERR_VALUE, "power: expected 1 or 2");
    REFUSED(LIST(power_product)(good, 3, in.x, in.x, n), PDN_ERR_VALUE, "power: expected 1 or 2");
    REFUSED(LIST(power_product)(good, 1, in.x, in.x, n - 1), PDN_ERR_SIZE, "x: expected ");
    REFUSED(LIST(power_product)(good, 1, NULL, in.x, n), PDN_ERR_NULL, "x: ");
    REFUSED(LIST(precondition)(good, in.x, in.x, n), PDN_ERR_NOT_AVAILABLE, "equations: factor");
    REFUSED(LIST(factor)(good, in.x, n - 1, out.numbers), PDN_ERR_SIZE, "right_side: expected ");
    REFUSED(LIST(factor)(good, in.x, n, NULL), PDN_ERR_NULL, "regular: ");
    REFUSES_NOT_FINITE(in.x[3], LIST(factor)(good, in.x, n, out.numbers), "right_side[3]");
    REFUSED(LIST(compliance)(good, in.x, in.x, n - 1, out.numbers), PDN_ERR_SIZE,
            "increment: expected ");
    REFUSED(LIST(compliance)(good, in.x, in.x, n, NULL), PDN_ERR_NULL, "compliant: ");
    REFUSES_NOT_FINITE(in.x[2], LIST(update)(good, in.x, n, 1.0), "increment[2]");
    REFUSED(LIST(update)(good, in.x, n, (double)NAN), PDN_ERR_NOT_FINITE, "step: ");
    REFUSED(LIST(norms)(good, in.x, n - 1, out.norms, out.norms + 1), PDN_ERR_SIZE, "increment: ");
    REFUSED(LIST(norms)(good, in.x, n, NULL, out.norms), PDN_ERR_NULL, "motion: ");
    REFUSED(LIST(norms)(good, in.x, n, out.norms, NULL), PDN_ERR_NULL, "own_unknown: ");
    REFUSED(LIST(state)(good, out.values, 3, in.own_unknowns, in.own_count), PDN_ERR_SIZE,
            "motions: ");
    REFUSED(LIST(nodes)(good, out.numbers, 1), PDN_ERR_SIZE, "out: ");
    REFUSED(LIST(numbers)(good, NULL, n), PDN_ERR_NULL, "out: ");
    REFUSED(LIST(set_state)(good, in.motions, in.motion_count - 1, in.own_unknowns, in.own_count),
            PDN_ERR_SIZE, "motions: ");
    REFUSED(LIST(set_state)(good, in.motions, in.motion_count, in.own_unknowns, in.own_count + 1),
            PDN_ERR_SIZE, "own_unknowns: ");
    in.motions[4] += 0.5;
    REFUSED(LIST(set_state)(good, in.motions, in.motion_count, in.own_unknowns, in.own_count),
            PDN_ERR_VALUE, "motions[3]: expected a rotation matrix");
    in.motions[4] -= 0.5;
    REFUSED(LIST(solution)(good, 1, PDN_CONVERGED, &out.solution), PDN_ERR_VALUE, "root: ");
    REFUSED(LIST(solution)(good, -2, PDN_CONVERGED, &out.solution), PDN_ERR_VALUE, "root: ");
    REFUSED(LIST(solution)(good, 0, 99, &out.solution), PDN_ERR_VALUE, "outcome: ");
    REFUSED(LIST(solution)(good, 0, PDN_CONVERGED, NULL), PDN_ERR_NULL, "out: ");
    pdn_equations_free(NULL);
}

int main(void)
{
    struct test_model model = four_bar();
    pdn_equations_sizes sizes;
    in.model = model.model;
    in.period = model.period;
    PDN_INIT(pdn_equations_options, &in.options);
    CHECK(in.options.ranks == 1 && in.options.rank == 0 && in.options.threads == 1);
    in.options.grid_points = 5;
    in.options.preconditioner = PDN_LINEAR_TIME_LOCAL;
    refused_options();
    GOOD(NEW);
    in.equations = out.equations;
    PDN_INIT(pdn_equations_sizes, &sizes);
    GOOD(pdn_equations_get_sizes(in.equations, &sizes));
    in.size = sizes.size;
    in.motion_count = sizes.motions;
    in.own_count = sizes.own_unknowns;
    in.x = calloc(in.size, sizeof *in.x);
    in.motions = calloc(in.motion_count, sizeof *in.motions);
    in.own_unknowns = calloc(in.own_count + 1, sizeof *in.own_unknowns);
    CHECK(in.x != NULL && in.motions != NULL && in.own_unknowns != NULL);
    GOOD(pdn_equations_state(in.equations, in.motions, in.motion_count, in.own_unknowns,
                             in.own_count));
    refused_calls();
    products_and_states();
    transposes();
    pdn_equations_free(in.equations);
    pdn_model_free(model.model);
    free(in.x);
    free(in.motions);
    free(in.own_unknowns);

    own_solver(four_bar(), PDN_LINEAR_AUTOMATIC);
    own_solver(four_bar(), PDN_LINEAR_BODY_CIRCULANT);
    own_solver(slider_crank(), PDN_LINEAR_AUTOMATIC);
    own_solver(rotor(2, 15), PDN_LINEAR_AUTOMATIC);
    printf("%d calls refused\n", refusals);
    return 0;
}
