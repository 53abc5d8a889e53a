/* Solutions seen through a spectral filter, and what is refused. */
#include "check.h"
#include "oscillator.h"
#include <math.h>

static struct {
    const pdn_solution *solution;
    int32_t filter, order;
} in;
static struct {
    pdn_solution *solution;
} out;
static int model_changed(void)
{
    return 0;
}
#include "refusal.h"

enum { POINTS = 21, HARMONICS = 10 };

static void harmonics_are_weakened(void)
{
    int32_t body, slide, filter;
    pdn_model *model = oscillator(&body, &slide);
    pdn_periodic_options options;
    pdn_solution *plain = NULL, *filtered = NULL;
    pdn_diagnostics before, after;
    const double period = 2 * PI / OMEGA;
    PDN_INIT(pdn_periodic_options, &options);
    PDN_INIT(pdn_diagnostics, &before);
    PDN_INIT(pdn_diagnostics, &after);
    options.grid_points = POINTS;
    CHECK_STATUS(pdn_solve_periodic(model, period, &options, &plain), PDN_OK);
    CHECK_STATUS(pdn_solution_diagnostics(plain, &before), PDN_OK);
    in.solution = plain;
    for (filter = PDN_FILTER_LANCZOS; filter <= PDN_FILTER_EXPONENTIAL; filter++) {
        const double place = 1.0 / (HARMONICS + 1), order = 2;
        const double lanczos = pow(sin(PI * place) / (PI * place), order);
        const double factor = filter == PDN_FILTER_LANCZOS ? lanczos : exp(-36 * pow(place, order));
        double cosines[2][HARMONICS], sines[2][HARMONICS], position[2][3];
        const double time = 0.4;
        CHECK_STATUS(pdn_solution_filtered(plain, filter, 2, &filtered), PDN_OK);
        CHECK_STATUS(pdn_solution_harmonics(
                         plain, PDN_QUANTITY(PDN_JOINT_COORDINATE, slide, PDN_DISPLACEMENT),
                         HARMONICS, NULL, NULL, cosines[0], sines[0]),
                     PDN_OK);
        CHECK_STATUS(pdn_solution_harmonics(
                         filtered, PDN_QUANTITY(PDN_JOINT_COORDINATE, slide, PDN_DISPLACEMENT),
                         HARMONICS, NULL, NULL, cosines[1], sines[1]),
                     PDN_OK);
        CHECK(fabs(cosines[0][0]) > 0.05);
        CHECK(fabs(cosines[1][0] - factor * cosines[0][0]) < 1e-14);
        CHECK(fabs(sines[1][0] - factor * sines[0][0]) < 1e-14);
        /* The same in the node's position: a pure translation. */
        CHECK_STATUS(pdn_solution_sample(plain,
                                         PDN_QUANTITY(PDN_NODE_POSITION, body, PDN_ALL_COMPONENTS),
                                         &time, 1, position[0]),
                     PDN_OK);
        CHECK_STATUS(pdn_solution_sample(filtered,
                                         PDN_QUANTITY(PDN_NODE_POSITION, body, PDN_ALL_COMPONENTS),
                                         &time, 1, position[1]),
                     PDN_OK);
        CHECK(fabs(position[0][2]) > 0.01);
        CHECK(fabs(position[1][2] - factor * position[0][2]) < 1e-13);
        /* The solve is the same. */
        CHECK_STATUS(pdn_solution_diagnostics(filtered, &after), PDN_OK);
        CHECK(memcmp(&before, &after, sizeof before) == 0);
        pdn_solution_free(filtered);
    }
    /* One outlives the other, and another filter replaces the first. */
    {
        pdn_solution *again = NULL;
        double first[HARMONICS], second[HARMONICS];
        CHECK_STATUS(pdn_solution_filtered(plain, PDN_FILTER_LANCZOS, 1, &filtered), PDN_OK);
        CHECK_STATUS(pdn_solution_filtered(filtered, PDN_FILTER_LANCZOS, 1, &again), PDN_OK);
        CHECK_STATUS(pdn_solution_harmonics(
                         filtered, PDN_QUANTITY(PDN_JOINT_COORDINATE, slide, PDN_DISPLACEMENT),
                         HARMONICS, NULL, NULL, first, NULL),
                     PDN_OK);
        pdn_solution_free(filtered);
        CHECK_STATUS(pdn_solution_harmonics(
                         again, PDN_QUANTITY(PDN_JOINT_COORDINATE, slide, PDN_DISPLACEMENT),
                         HARMONICS, NULL, NULL, second, NULL),
                     PDN_OK);
        CHECK(memcmp(first, second, sizeof first) == 0);
        pdn_solution_free(again);
    }

    /* --- What is refused --- */
    {
        static const int32_t orders[] = {0, -1, 33, INT32_MAX, INT32_MIN};
        pdn_march_options stepwise;
        pdn_solution *march = NULL;
        in.filter = PDN_FILTER_LANCZOS;
        in.order = 2;
#define FILTERED pdn_solution_filtered(in.solution, in.filter, in.order, &out.solution)
        REFUSED(pdn_solution_filtered(NULL, 0, 1, &out.solution), PDN_ERR_NULL,
                "solution: expected a pointer, got NULL");
        REFUSED(pdn_solution_filtered(in.solution, 0, 1, NULL), PDN_ERR_NULL,
                "out: expected a pointer, got NULL");
        REFUSES_EACH(in.filter, int32_t, bad_enums, FILTERED, PDN_ERR_VALUE,
                     "filter: expected PDN_FILTER_LANCZOS or PDN_FILTER_EXPONENTIAL, got ");
        REFUSES_EACH(in.order, int32_t, orders, FILTERED, PDN_ERR_VALUE,
                     "order: expected an order from 1 to 32, got ");
        PDN_INIT(pdn_march_options, &stepwise);
        stepwise.period = stepwise.duration = period;
        stepwise.steps_per_period = 50;
        CHECK_STATUS(pdn_solve_march(model, &stepwise, &march), PDN_OK);
        in.solution = march;
        REFUSED(FILTERED, PDN_ERR_NOT_AVAILABLE, "a trajectory has no harmonics");
        pdn_solution_free(march);
    }
    pdn_solution_free(plain);
    pdn_model_free(model);
}

int main(void)
{
    harmonics_are_weakened();
    printf("%d refusals\n", refusals);
    return 0;
}
