/* Periodic motions by shooting, as users of C meet them, and what is refused. */
#include "oscillator.h"
#include <math.h>

/* Arguments, each of them good. */
static struct {
    const pdn_model *model;
    double period;
    pdn_shooting_options options;
} in;

static struct {
    pdn_solution *solution;
    double real[2], imaginary[2];
    size_t count;
} out;

static int model_changed(void)
{
    return 0; /* the model is const */
}

#include "refusal.h"

static pdn_model *model;
static int32_t body, slide;

static void set_up(void)
{
    model = oscillator(&body, &slide);
    in.model = model;
    in.period = 2 * PI / OMEGA;
    PDN_INIT(pdn_shooting_options, &in.options);
    CHECK(in.options.struct_size == sizeof in.options && in.options.steps_per_period == 200);
    CHECK(in.options.guess_periods == 1 && in.options.spectral_radius == 0.5);
    CHECK(in.options.tolerance == 1e-8 && in.options.iteration_limit == 30);
}

static int32_t told;

static int32_t stop_at_once(const pdn_progress *progress, void *data)
{
    CHECK(progress->struct_size == sizeof *progress && data == &told);
    told++;
    return 1;
}

static void closed_form(void)
{
    const double real = STIFFNESS - MASS * OMEGA * OMEGA, imaginary = DAMPING * OMEGA;
    const double amplitude = FORCE / hypot(real, imaginary), lag = atan2(imaginary, real);
    const double decay = DAMPING / (2 * MASS), w = sqrt(STIFFNESS / MASS - decay * decay);
    pdn_solution *solution, *next;
    pdn_march_diagnostics figures;
    int i;
    CHECK_STATUS(pdn_solve_shooting(model, in.period, NULL, &solution), PDN_OK);
    CHECK(pdn_solution_outcome(solution) == PDN_CONVERGED);
    for (i = 0; i <= 20; i++) {
        const double time = in.period * i / 20;
        double x;
        CHECK_STATUS(pdn_solution_sample(
                         solution, PDN_QUANTITY(PDN_JOINT_COORDINATE, slide, PDN_DISPLACEMENT),
                         &time, 1, &x),
                     PDN_OK);
        /* Second order: 200 steps leave some 1e-4 of the amplitude. */
        CHECK(fabs(x - amplitude * cos(OMEGA * time - lag)) < 3e-4 * amplitude);
    }
    CHECK_STATUS(pdn_solution_floquet_count(solution, &out.count), PDN_OK);
    CHECK(out.count == 2);
    CHECK_STATUS(pdn_solution_floquet(solution, out.real, out.imaginary, 2), PDN_OK);
    CHECK(fabs(out.real[0] - exp(-decay * in.period) * cos(w * in.period)) < 5e-3);
    CHECK(fabs(fabs(out.imaginary[0]) - exp(-decay * in.period) * fabs(sin(w * in.period))) < 5e-3);
    CHECK(fabs(out.real[0] - out.real[1]) < 1e-9 &&
          fabs(out.imaginary[0] + out.imaginary[1]) < 1e-9);
    PDN_INIT(pdn_march_diagnostics, &figures);
    CHECK_STATUS(pdn_solution_march(solution, &figures), PDN_OK);
    CHECK(figures.first_time == 0 && fabs(figures.last_time - in.period) < 1e-15);
    CHECK(figures.repetition < 1e-9 && figures.periods == 1);

    /* Started from what was found, with other steps. */
    in.options.initial = solution;
    in.options.steps_per_period = 100;
    CHECK_STATUS(pdn_solve_shooting(model, in.period, &in.options, &next), PDN_OK);
    CHECK(pdn_solution_outcome(next) == PDN_CONVERGED);
    pdn_solution_free(next);
    pdn_solution_free(solution);
    in.options.initial = NULL;
    in.options.progress = stop_at_once;
    in.options.progress_data = &told;
    CHECK_STATUS(pdn_solve_shooting(model, in.period, &in.options, &solution), PDN_OK);
    CHECK(pdn_solution_outcome(solution) == PDN_CANCELLED && told == 1);
    pdn_solution_free(solution);
    in.options.progress = NULL;
    in.options.progress_data = NULL;
}

static pdn_status shoot(void)
{
    return pdn_solve_shooting(in.model, in.period, &in.options, &out.solution);
}

static void refusals_of_each_argument(void)
{
    static const double not_positive[] = {0.0, -1.0}, no_radius[] = {-0.1, 1.0, 1.1};
    static const size_t zero[] = {0}, bad_steps[] = {0, 1000001, (size_t)-1};
    static const size_t bad_struct_sizes[] = {0, 1, 7, 8, 64, 5000, (size_t)-1};
    pdn_shooting_options options;
    pdn_solution *solution;
    pdn_model *other;
    const double origin[3] = {0, 0, 0}, inertia[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    int32_t node;

    memset(&options, 0x5a, sizeof options);
    pdn_shooting_options_init(NULL, sizeof options);
    CHECK_MESSAGE("options: expected a pointer, got NULL");
    pdn_shooting_options_init(&options, 7);
    CHECK_MESSAGE("struct_size: expected between");
    REFUSED(pdn_solve_shooting(NULL, in.period, &in.options, &out.solution), PDN_ERR_NULL,
            "model: expected a pointer, got NULL");
    REFUSED(pdn_solve_shooting(in.model, in.period, &in.options, NULL), PDN_ERR_NULL,
            "out: expected a pointer, got NULL");
    REFUSES_NOT_FINITE(in.period, shoot(), "period");
    REFUSES_EACH(in.period, double, not_positive, shoot(), PDN_ERR_VALUE,
                 "period: expected a positive, finite number");
    REFUSES_EACH(in.options.struct_size, size_t, bad_struct_sizes, shoot(), PDN_ERR_STRUCT_SIZE,
                 "options: expected struct_size ");
    REFUSES_EACH(in.options.steps_per_period, size_t, bad_steps, shoot(), PDN_ERR_VALUE,
                 "options.steps_per_period: expected from 1 to ");
    REFUSES_NOT_FINITE(in.options.spectral_radius, shoot(), "options.spectral_radius");
    REFUSES_EACH(in.options.spectral_radius, double, no_radius, shoot(), PDN_ERR_VALUE,
                 "options.spectral_radius: expected a number from 0 to less than 1");
    REFUSES_NOT_FINITE(in.options.tolerance, shoot(), "options.tolerance");
    REFUSES_EACH(in.options.tolerance, double, not_positive, shoot(), PDN_ERR_VALUE,
                 "options.tolerance: expected a positive");
    REFUSES_EACH(in.options.iteration_limit, size_t, zero, shoot(), PDN_ERR_VALUE,
                 "options.iteration_limit: expected at least 1");

    /* A free body: nothing determines where it is. */
    CHECK_STATUS(pdn_model_new(&other), PDN_OK);
    REFUSED(pdn_solve_shooting(other, 1.0, NULL, &out.solution), PDN_ERR_MODEL,
            "model: expected at least one node, got none");
    CHECK_STATUS(pdn_model_add_rigid_body(other, 1, origin, inertia, &node), PDN_OK);
    CHECK_STATUS(pdn_solve_shooting(other, 1.0, NULL, &solution), PDN_OK);
    CHECK(pdn_solution_outcome(solution) != PDN_CONVERGED);
    in.options.initial = solution;
    REFUSED(shoot(), PDN_ERR_VALUE,
            "options.initial: expected a solution of a model with the same");
    in.options.initial = NULL;
    REFUSED(pdn_solution_floquet_count(NULL, &out.count), PDN_ERR_NULL,
            "solution: expected a pointer, got NULL");
    REFUSED(pdn_solution_floquet_count(solution, NULL), PDN_ERR_NULL,
            "out: expected a pointer, got NULL");
    pdn_solution_free(solution);
    pdn_model_free(other);
    CHECK_STATUS(shoot(), PDN_OK);
    solution = out.solution;
    REFUSED(pdn_solution_floquet(NULL, out.real, out.imaginary, 2), PDN_ERR_NULL,
            "solution: expected a pointer, got NULL");
    REFUSED(pdn_solution_floquet(solution, NULL, out.imaginary, 2), PDN_ERR_NULL,
            "real: expected a pointer, got NULL");
    REFUSED(pdn_solution_floquet(solution, out.real, NULL, 2), PDN_ERR_NULL,
            "imaginary: expected a pointer, got NULL");
    REFUSED(pdn_solution_floquet(solution, out.real, out.imaginary, 3), PDN_ERR_SIZE,
            "count: expected 2, got 3");
    pdn_solution_free(solution);
    CHECK_STATUS(pdn_solve_static(in.model, NULL, &solution), PDN_OK);
    REFUSED(pdn_solution_floquet_count(solution, &out.count), PDN_ERR_NOT_AVAILABLE,
            "stability: expected a periodic solution");
    REFUSED(pdn_solution_floquet(solution, out.real, out.imaginary, 2), PDN_ERR_NOT_AVAILABLE,
            "stability: expected a periodic solution");
    pdn_solution_free(solution);
}

int main(void)
{
    set_up();
    closed_form();
    refusals_of_each_argument();
    pdn_model_free(model);
    printf("%d calls refused as they must be\n", refusals);
    return 0;
}
