/* Functions of the caller that fail, give what is no number, or cancel, at each call that there
   is, in each kind of solve: a status, nothing given, and the model as good as before. */
#include "oscillator.h"
#include <math.h>

enum fault { NONE, FAILS, NO_NUMBER, INFINITE, CANCELS };

/* What is counted, from which call on it goes wrong, and how: laws and forces are also looked at at
   motions that are made up, which they may refuse. */
static struct {
    int calls, at;
    enum fault fault;
} plan;

static pdn_model *model;
static int32_t body, slide, law_id, force_id;

/* Whether this call goes wrong: of functions of the model, or of progress. */
static int now(int is_progress)
{
    return is_progress == (plan.fault == CANCELS) && ++plan.calls >= plan.at && plan.at > 0;
}

/* What a function gives instead of its value. */
static int32_t spoil(double *value)
{
    if (plan.fault == FAILS) {
        CHECK_STATUS(pdn_set_callback_error("as planned"), PDN_OK);
        return 7;
    }
    *value = plan.fault == NO_NUMBER ? (double)NAN : (double)INFINITY;
    return 0;
}

static int32_t drive(double time, double *value, void *user_data)
{
    *value = 0.5 * cos(OMEGA * time);
    (void)user_data;
    return now(0) ? spoil(value) : 0;
}

static int32_t law(double time, double coordinate, double rate, double *effort, double *derivatives,
                   void *user_data)
{
    (void)time;
    (void)user_data;
    *effort = 3 * coordinate * coordinate * coordinate + 0.1 * rate;
    if (derivatives != NULL) {
        derivatives[0] = 9 * coordinate * coordinate;
        derivatives[1] = 0.1;
    }
    if (!now(0)) {
        return 0;
    }
    return spoil(derivatives != NULL && plan.calls % 2 == 0 ? &derivatives[1] : effort);
}

static int32_t force(const pdn_force_state *state, pdn_force_values *values, void *user_data)
{
    (void)user_data;
    values->forces[2] = -2 * state->positions[2];
    if (!now(0)) {
        return 0;
    }
    return spoil(&values->forces[plan.calls % 6]);
}

static int32_t progress(const pdn_progress *told, void *user_data)
{
    (void)told;
    (void)user_data;
    return now(1);
}

static pdn_status periodic(pdn_solution **out)
{
    pdn_periodic_options options;
    PDN_INIT(pdn_periodic_options, &options);
    options.grid_points = 7;
    options.progress = progress;
    options.progress_interval = 0;
    return pdn_solve_periodic(model, 2 * PI / OMEGA, &options, out);
}

static pdn_status adaptive(pdn_solution **out)
{
    pdn_periodic_options options;
    PDN_INIT(pdn_periodic_options, &options);
    options.error_tolerance = 1e-3;
    options.progress = progress;
    options.progress_interval = 0;
    return pdn_solve_periodic(model, 2 * PI / OMEGA, &options, out);
}

static pdn_status statics(pdn_solution **out)
{
    pdn_static_options options;
    PDN_INIT(pdn_static_options, &options);
    options.period = 2 * PI / OMEGA;
    options.progress = progress;
    return pdn_solve_static(model, &options, out);
}

static pdn_status march(pdn_solution **out)
{
    pdn_march_options options;
    PDN_INIT(pdn_march_options, &options);
    options.period = 2 * PI / OMEGA;
    options.duration = 0.5;
    options.step = 0.05;
    options.progress = progress;
    return pdn_solve_march(model, &options, out);
}

static pdn_status shooting(pdn_solution **out)
{
    pdn_shooting_options options;
    PDN_INIT(pdn_shooting_options, &options);
    options.steps_per_period = 10;
    options.progress = progress;
    return pdn_solve_shooting(model, 2 * PI / OMEGA, &options, out);
}

/* The equilibrium of modes is what is looked at. */
static pdn_status modes(pdn_solution **out)
{
    pdn_static_options at_rest;
    pdn_modes_options options;
    pdn_modes *found = NULL;
    pdn_status status;
    PDN_INIT(pdn_static_options, &at_rest);
    at_rest.period = 2 * PI / OMEGA;
    at_rest.progress = progress;
    PDN_INIT(pdn_modes_options, &options);
    options.equilibrium = &at_rest;
    options.count = 2;
    status = pdn_solve_modes(model, &options, &found);
    if (status == PDN_OK) {
        CHECK_STATUS(pdn_modes_equilibrium(found, out), PDN_OK);
    }
    pdn_modes_free(found);
    return status;
}

typedef pdn_status (*solve_fn)(pdn_solution **out);

/* Positions at some times, of what is found without a fault. */
static void look(solve_fn solve, double *positions)
{
    const double times[3] = {0, 0.11, 0.4};
    pdn_solution *solution = NULL;
    memset(&plan, 0, sizeof plan);
    CHECK_STATUS(solve(&solution), PDN_OK);
    CHECK(pdn_solution_outcome(solution) == PDN_CONVERGED);
    CHECK_STATUS(pdn_solution_sample(solution,
                                     PDN_QUANTITY(PDN_JOINT_COORDINATE, slide, PDN_DISPLACEMENT),
                                     times, 3, positions),
                 PDN_OK);
    pdn_solution_free(solution);
}

/* Whether one of the forces tells that it failed where the solution was to keep it. */
static int is_told(const pdn_solution *solution)
{
    const double time = 0;
    double effort, forces[6];
    return pdn_solution_sample(solution, PDN_QUANTITY(PDN_FORCE_EFFORT, law_id, PDN_ALL_COMPONENTS),
                               &time, 1, &effort) == PDN_ERR_CALLBACK ||
           pdn_solution_sample(
               solution,
               PDN_QUANTITY(PDN_FORCE_ON_NODE, force_id, PDN_ALL_COMPONENTS, .node = body), &time,
               1, forces) == PDN_ERR_CALLBACK;
}

/* A fault at one call. */
static void one(const char *what, solve_fn solve, enum fault fault, int at)
{
    pdn_solution *solution = NULL;
    pdn_status status;
    memset(&plan, 0, sizeof plan);
    plan.fault = fault;
    plan.at = at;
    status = solve(&solution);
    if (fault == CANCELS) {
        /* Where the machine was slow before, it may be told less often now. */
        if (plan.calls < at) {
            CHECK_STATUS(status, PDN_OK);
            pdn_solution_free(solution);
            return;
        }
        /* Not called again after that. */
        if (status != PDN_OK || pdn_solution_outcome(solution) != PDN_CANCELLED ||
            plan.calls != at) {
            fprintf(stderr, "%s, cancelled at %d: %s, %d calls\n", what, at,
                    pdn_status_name(status), plan.calls);
            exit(1);
        }
        pdn_solution_free(solution);
        return;
    }
    if (status == PDN_OK && is_told(solution)) {
        pdn_solution_free(solution);
        return;
    }
    if (status != PDN_ERR_CALLBACK || solution != NULL) {
        char report[2000] = "";
        if (solution != NULL) {
            (void)pdn_solution_report(solution, report, sizeof report);
        }
        fprintf(stderr, "%s, fault %d at call %d of %d: %s\n%s\n", what, (int)fault, at, plan.calls,
                pdn_status_name(status), report);
        exit(1);
    }
    if (fault == FAILS) {
        CHECK(pdn_last_callback_code() == 7);
        CHECK_MESSAGE("as planned");
        /* No function of the caller is asked again in vain, but for such looks. */
        CHECK(plan.calls <= at + 4);
    } else {
        CHECK_MESSAGE("finite");
    }
}

static void each_call(const char *what, solve_fn solve)
{
    const enum fault faults[] = {FAILS, NO_NUMBER, INFINITE, CANCELS};
    double before[3], after[3];
    look(solve, before);
    for (size_t i = 0; i < sizeof faults / sizeof *faults; i++) {
        int calls, at;
        pdn_solution *solution = NULL;
        memset(&plan, 0, sizeof plan);
        plan.fault = faults[i];
        CHECK_STATUS(solve(&solution), PDN_OK);
        pdn_solution_free(solution);
        calls = plan.calls;
        CHECK(calls > 0);
        /* Each of the first, then one in so many, and the last. */
        for (at = 1; at <= calls; at += 1 + at / 16) {
            one(what, solve, faults[i], at);
        }
        if (faults[i] != CANCELS) {
            one(what, solve, faults[i], calls);
        }
        printf("%s, fault %d: %d calls\n", what, (int)faults[i], calls);
        look(solve, after);
        CHECK(memcmp(before, after, sizeof before) == 0);
    }
}

int main(void)
{
    pdn_signal signal;
    model = oscillator(&body, &slide);
    PDN_INIT(pdn_signal, &signal);
    CHECK_STATUS(pdn_signal_set_function(&signal, drive, NULL), PDN_OK);
    CHECK_STATUS(pdn_model_add_load(model, body, PDN_FRAME_SPACE, PDN_FORCE_3, &signal, NULL),
                 PDN_OK);
    CHECK_STATUS(pdn_model_add_coordinate_law(model, slide, PDN_DISPLACEMENT, PDN_TANGENTS_GIVEN,
                                              law, NULL, NULL, &law_id),
                 PDN_OK);
    CHECK_STATUS(pdn_model_add_user_force(model, &body, 1, PDN_FRAME_SPACE,
                                          PDN_TANGENTS_DIFFERENCED, force, NULL, NULL, &force_id),
                 PDN_OK);
    each_call("periodic", periodic);
    each_call("adaptive", adaptive);
    each_call("static", statics);
    each_call("march", march);
    each_call("shooting", shooting);
    each_call("modes", modes);
    pdn_model_free(model);
    return 0;
}
