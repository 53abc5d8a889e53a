/* Stability of periodic solutions, as users of C meet it, and what is refused. */
#include "oscillator.h"
#include <math.h>

/* Arguments, each of them good. */
static struct {
    const pdn_solution *solution;
    pdn_stability_options options;
} in;

static struct {
    pdn_stability *stability;
    pdn_multiplier multiplier;
    int32_t verdict;
    size_t count;
    double limit, values[6];
} out;

static int model_changed(void)
{
    return 0; /* there is none */
}

#include "refusal.h"

static pdn_solution *solution;
static int32_t body, slide;

static void set_up(void)
{
    pdn_model *model = oscillator(&body, &slide);
    pdn_periodic_options options;
    PDN_INIT(pdn_periodic_options, &options);
    options.grid_points = 5;
    CHECK_STATUS(pdn_solve_periodic(model, 2 * PI / OMEGA, &options, &solution), PDN_OK);
    CHECK(pdn_solution_outcome(solution) == PDN_CONVERGED);
    pdn_model_free(model);
    in.solution = solution;
    PDN_INIT(pdn_stability_options, &in.options);
    CHECK(in.options.struct_size == sizeof in.options && in.options.highest_frequency == 0);
    CHECK(in.options.tolerance == 1e-8);
}

static int32_t told;

static int32_t stop_at_once(const pdn_progress *progress, void *data)
{
    CHECK(progress->struct_size == sizeof *progress && data == &told);
    CHECK(progress->stage == PDN_STAGE_STABILITY);
    told++;
    return 1;
}

static void closed_form(void)
{
    const double period = 2 * PI / OMEGA, decay = DAMPING / (2 * MASS);
    const double w = sqrt(STIFFNESS / MASS - decay * decay), size = exp(-decay * period);
    static double times[5000], real[6 * 5000], imaginary[6 * 5000];
    pdn_stability *stability;
    pdn_multiplier multiplier;
    size_t count, states, steps, k;
    int32_t verdict;
    double limit;
    char report[4096];

    CHECK_STATUS(pdn_solve_stability(solution, NULL, &stability), PDN_OK);
    CHECK(pdn_stability_outcome(stability) == PDN_CONVERGED);
    CHECK_STATUS(pdn_stability_verdict(stability, &verdict, &limit), PDN_OK);
    CHECK(verdict == PDN_STABLE && limit > 1e300);
    CHECK_STATUS(pdn_stability_verdict(stability, &verdict, NULL), PDN_OK);
    CHECK_STATUS(pdn_stability_count(stability, &count, &states), PDN_OK);
    CHECK(count == 2 && states == 2);
    CHECK_STATUS(pdn_stability_count(stability, &count, NULL), PDN_OK);
    PDN_INIT(pdn_multiplier, &multiplier);
    CHECK(multiplier.struct_size == sizeof multiplier);
    CHECK_STATUS(pdn_stability_get(stability, 0, &multiplier), PDN_OK);
    CHECK(fabs(multiplier.real - size * cos(w * period)) < 1e-8);
    CHECK(fabs(multiplier.imaginary - size * fabs(sin(w * period))) < 1e-8);
    CHECK(fabs(multiplier.exponent_real + decay) < 1e-7);
    CHECK(fabs(fabs(multiplier.exponent_imaginary) - w) < 1e-7);
    CHECK(fabs(multiplier.frequency - w) < 0.05 * w);
    CHECK(multiplier.error < 1e-8 && multiplier.trivial == 0);

    /* The mode is constant: the exponent tells all. */
    CHECK_STATUS(pdn_stability_time_count(stability, &steps), PDN_OK);
    CHECK(steps > 5 && steps <= 5000);
    CHECK_STATUS(pdn_stability_times(stability, times, steps), PDN_OK);
    CHECK(fabs(times[steps - 1] - period) < 1e-12);
    CHECK_STATUS(pdn_stability_shape(stability, 0, body, steps, real, imaginary), PDN_OK);
    for (k = 0; k < steps; k++) {
        CHECK(fabs(real[6 * k + 2] - 1) < 1e-5 && fabs(imaginary[6 * k + 2]) < 1e-5);
        CHECK(fabs(real[6 * k]) < 1e-10 && fabs(real[6 * k + 4]) < 1e-10);
    }
    CHECK_STATUS(pdn_stability_shape(stability, 0, body, steps, real, NULL), PDN_OK);
    CHECK(pdn_stability_report(stability, report, sizeof report) > 100);
    CHECK(strstr(report, "Stability: stable\n  2 of 2 multipliers, largest 0.53") != NULL);

    PDN_INIT(pdn_multiplier, &out.multiplier);
    REFUSED(pdn_stability_verdict(stability, NULL, &out.limit), PDN_ERR_NULL, "verdict: ");
    REFUSED(pdn_stability_count(stability, NULL, &out.count), PDN_ERR_NULL, "out: ");
    REFUSED(pdn_stability_get(stability, 2, &multiplier), PDN_ERR_ID, "number: ");
    REFUSED(pdn_stability_get(stability, -1, &multiplier), PDN_ERR_ID, "number: ");
    REFUSED(pdn_stability_get(stability, 0, NULL), PDN_ERR_NULL, "out: ");
    REFUSED(pdn_stability_time_count(stability, NULL), PDN_ERR_NULL, "out: ");
    REFUSED(pdn_stability_times(stability, NULL, steps), PDN_ERR_NULL, "times: ");
    REFUSED(pdn_stability_times(stability, times, steps + 1), PDN_ERR_SIZE, "count: ");
    REFUSED(pdn_stability_times(stability, times, 1), PDN_ERR_SIZE, "count: ");
    REFUSED(pdn_stability_shape(stability, 2, body, steps, real, NULL), PDN_ERR_ID, "number: ");
    REFUSED(pdn_stability_shape(stability, 0, NODE(1), steps, real, NULL), PDN_ERR_ID, "node: ");
    REFUSED(pdn_stability_shape(stability, body, 0, steps, real, NULL), PDN_ERR_ID, "number: ");
    REFUSED(pdn_stability_shape(stability, 0, body, 1, real, NULL), PDN_ERR_SIZE, "steps: ");
    REFUSED(pdn_stability_shape(stability, 0, body, steps, NULL, NULL), PDN_ERR_NULL, "real: ");
    pdn_stability_free(stability);

    in.options.progress = stop_at_once;
    in.options.progress_data = &told;
    /* So little work may end before it is told of. */
    CHECK_STATUS(pdn_solve_stability(solution, &in.options, &stability), PDN_OK);
    CHECK(told == 0 || pdn_stability_outcome(stability) == PDN_CANCELLED);
    pdn_stability_free(stability);
    pdn_stability_free(NULL);
    in.options.progress = NULL;
    in.options.progress_data = NULL;
}

static pdn_status analyse(void)
{
    return pdn_solve_stability(in.solution, &in.options, &out.stability);
}

static void refusals_of_each_argument(void)
{
    static const double negative[] = {-1.0}, not_positive[] = {0.0, -1.0};
    static const size_t bad_struct_sizes[] = {0, 1, 7, 8, 32, 5000, (size_t)-1};
    const double centre[3] = {0, 0, 0}, inertia[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    pdn_stability_options options;
    pdn_multiplier multiplier;
    pdn_solution *still;
    pdn_model *model;
    int32_t node;

    pdn_stability_options_init(NULL, sizeof options);
    CHECK_MESSAGE("options: expected a pointer, got NULL");
    pdn_stability_options_init(&options, 7);
    CHECK_MESSAGE("struct_size: expected between");
    pdn_multiplier_init(NULL, sizeof multiplier);
    CHECK_MESSAGE("multiplier: expected a pointer, got NULL");
    REFUSED(pdn_solve_stability(NULL, &in.options, &out.stability), PDN_ERR_NULL,
            "solution: expected a pointer, got NULL");
    REFUSED(pdn_solve_stability(in.solution, &in.options, NULL), PDN_ERR_NULL,
            "out: expected a pointer, got NULL");
    REFUSES_EACH(in.options.struct_size, size_t, bad_struct_sizes, analyse(), PDN_ERR_STRUCT_SIZE,
                 "options: expected struct_size ");
    REFUSES_NOT_FINITE(in.options.highest_frequency, analyse(), "options.highest_frequency");
    REFUSES_EACH(in.options.highest_frequency, double, negative, analyse(), PDN_ERR_VALUE,
                 "options.highest_frequency: expected a positive");
    REFUSES_NOT_FINITE(in.options.tolerance, analyse(), "options.tolerance");
    REFUSES_EACH(in.options.tolerance, double, not_positive, analyse(), PDN_ERR_VALUE,
                 "options.tolerance: expected a positive");
    CHECK(pdn_stability_outcome(NULL) == PDN_ERR_NULL);
    CHECK(pdn_stability_report(NULL, NULL, 0) == 0);

    /* An equilibrium is no periodic solution. */
    CHECK_STATUS(pdn_model_new(&model), PDN_OK);
    CHECK_STATUS(pdn_model_add_rigid_body(model, 1, centre, inertia, &node), PDN_OK);
    CHECK_STATUS(pdn_solve_static(model, NULL, &still), PDN_OK);
    in.solution = still;
    REFUSED(analyse(), PDN_ERR_NOT_AVAILABLE, "stability: expected a periodic solution");
    in.solution = solution;
    pdn_solution_free(still);
    pdn_model_free(model);
}

int main(void)
{
    set_up();
    closed_form();
    refusals_of_each_argument();
    pdn_solution_free(solution);
    printf("%d refusals\n", refusals);
    return 0;
}
