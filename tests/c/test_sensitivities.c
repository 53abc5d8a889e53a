/* Sensitivities of a forced oscillator against closed forms: held, and at resonance; and what has
 * none. */
#include "near.h"

enum { MASS = 1, STIFFNESS = 4 };

static const double DAMPING = 0.1, FORCE = 0.3;
static const double ORIGIN[3] = {0, 0, 0}, AXIS[3] = {1, 0, 0};
static const double BALL[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};

static pdn_model *model;
static int32_t body, joint, spring, stiffness, load, nothing;

/* A mass on a slide with a spring, a damper and a force. */
static void begin(void)
{
    const double cosines[1] = {FORCE}, sines[1] = {0};
    int32_t actuator;
    pdn_signal push;
    CHECK_STATUS(pdn_model_new(&model), PDN_OK);
    CHECK_STATUS(pdn_model_add_rigid_body(model, MASS, ORIGIN, BALL, &body), PDN_OK);
    CHECK_STATUS(pdn_model_add_prismatic(model, PDN_GROUND, body, ORIGIN, AXIS, &joint), PDN_OK);
    CHECK_STATUS(
        pdn_model_add_spring_damper(model, joint, PDN_DISPLACEMENT, STIFFNESS, DAMPING, 0, &spring),
        PDN_OK);
    PDN_INIT(pdn_signal, &push);
    CHECK_STATUS(pdn_signal_set_harmonics(&push, 0, 0, cosines, sines, 1), PDN_OK);
    CHECK_STATUS(pdn_model_add_actuator(model, joint, PDN_DISPLACEMENT, &push, &actuator), PDN_OK);
    CHECK_STATUS(pdn_model_add_parameter(model, "stiffness", STIFFNESS, 4, &stiffness), PDN_OK);
    CHECK_STATUS(pdn_model_move_number(model, stiffness, PDN_NUMBER_STIFFNESS, spring, 1, 1),
                 PDN_OK);
    CHECK_STATUS(pdn_model_add_parameter(model, "load", 1, 1, &load), PDN_OK);
    CHECK_STATUS(pdn_model_move_signal(model, load, actuator, 0, PDN_PART_AMPLITUDE, 1), PDN_OK);
    CHECK_STATUS(pdn_model_add_parameter(model, "nothing", 1, 1, &nothing), PDN_OK);
}

static pdn_quantity coordinate(int32_t kind)
{
    return pdn_quantity_of(kind, joint, PDN_DISPLACEMENT);
}

/* Coefficients of x = a cos wt + b sin wt. */
static void response(double k, double w, double force, double *a, double *b)
{
    const double d = k - MASS * w * w, c = DAMPING * w, size = d * d + c * c;
    *a = force * d / size;
    *b = force * c / size;
}

static void held(void)
{
    const double w = 1.7, h = 1e-4;
    double found[4][4];
    pdn_quantity x;
    pdn_periodic_options options;
    pdn_sensitivity_options how;
    pdn_sensitivities *s;
    pdn_solution *solution;
    begin();
    x = coordinate(PDN_JOINT_COORDINATE);
    PDN_INIT(pdn_periodic_options, &options);
    options.grid_points = 7;
    CHECK_STATUS(pdn_solve_periodic(model, 2 * PI / w, &options, &solution), PDN_OK);
    CHECK_STATUS(pdn_sensitivities_new(&s), PDN_OK);
    CHECK_STATUS(pdn_sensitivities_add_quantity(s, &x, PDN_FEATURE_COSINE, 1), PDN_OK);
    CHECK_STATUS(pdn_sensitivities_add_quantity(s, &x, PDN_FEATURE_SINE, 1), PDN_OK);
    CHECK_STATUS(pdn_sensitivities_add_quantity(s, &x, PDN_FEATURE_LARGEST, 0), PDN_OK);
    CHECK_STATUS(pdn_sensitivities_add_quantity(s, &x, PDN_FEATURE_VALUE, 0.9), PDN_OK);
    CHECK_STATUS(pdn_sensitivities_add_parameter(s, PDN_FREQUENCY), PDN_OK);
    CHECK_STATUS(pdn_sensitivities_add_parameter(s, stiffness), PDN_OK);
    CHECK_STATUS(pdn_sensitivities_add_parameter(s, load), PDN_OK);
    CHECK_STATUS(pdn_sensitivities_add_parameter(s, nothing), PDN_OK);
    PDN_INIT(pdn_sensitivity_options, &how);
    CHECK(how.threads == 1);
    for (how.method = PDN_SENSITIVITY_AUTOMATIC; how.method <= PDN_SENSITIVITY_ADJOINT;
         ++how.method) {
        CHECK_STATUS(pdn_solution_sensitivities(solution, s, NULL, &how, found[0], 4, 4), PDN_OK);
        for (int i = 0; i < 4; ++i) {
            /* Fourth-order differences of the closed form. */
            const double places[4] = {-2, -1, 1, 2}, weights[4] = {1, -8, 8, -1};
            double slopes[4] = {0, 0, 0, 0};
            for (int k = 0; k < 4; ++k) {
                double a, b, step[4] = {0, 0, 0, 0};
                step[i] = places[k] * h;
                response(STIFFNESS + step[1], w + step[0], FORCE * (1 + step[2]), &a, &b);
                const double phase = (w + step[0]) * 0.9, of = weights[k] / (12 * h);
                slopes[0] += of * a;
                slopes[1] += of * b;
                slopes[2] += of * hypot(a, b);
                slopes[3] += of * (a * cos(phase) + b * sin(phase));
            }
            for (int j = 0; j < 4; ++j) {
                CHECK_NEAR(found[i][j], slopes[j], 1e-10);
            }
        }
    }

    /* What is asked for wrongly. */
    double before = found[0][0];
    CHECK_STATUS(pdn_solution_sensitivities(solution, s, NULL, NULL, found[0], 3, 4), PDN_ERR_SIZE);
    CHECK_STATUS(pdn_solution_sensitivities(solution, s, NULL, NULL, found[0], 4, 5), PDN_ERR_SIZE);
    CHECK_STATUS(pdn_solution_sensitivities(solution, s, NULL, NULL, NULL, 4, 4), PDN_ERR_NULL);
    CHECK_STATUS(pdn_solution_sensitivities(NULL, s, NULL, NULL, found[0], 4, 4), PDN_ERR_NULL);
    CHECK_STATUS(pdn_solution_sensitivities(solution, NULL, NULL, NULL, found[0], 4, 4),
                 PDN_ERR_NULL);
    CHECK_STATUS(pdn_solution_sensitivities(solution, s, NULL, &how, found[0], 4, 4),
                 PDN_ERR_VALUE);
    CHECK_MESSAGE("PDN_SENSITIVITY_");
    CHECK_STATUS(pdn_sensitivities_add_parameter(s, -2), PDN_ERR_ID);
    CHECK_STATUS(pdn_sensitivities_add_found(s, -2), PDN_ERR_ID);
    CHECK_STATUS(pdn_sensitivities_add_quantity(s, &x, 499, 0), PDN_ERR_VALUE);
    CHECK_STATUS(pdn_sensitivities_add_quantity(s, &x, PDN_FEATURE_COSINE, 0), PDN_ERR_VALUE);
    CHECK_STATUS(pdn_sensitivities_add_quantity(s, NULL, PDN_FEATURE_MEAN, 0), PDN_ERR_NULL);
    CHECK_STATUS(pdn_sensitivities_add_parameter(s, PARAMETER(9)), PDN_OK);
    CHECK_STATUS(pdn_solution_sensitivities(solution, s, NULL, NULL, found[0], 4, 5), PDN_ERR_ID);
    CHECK(found[0][0] == before);
    pdn_sensitivities_free(s);
    pdn_sensitivities_free(NULL);

    /* Multipliers exp(s T), s = -c / 2m + i sqrt(k / m - (c / 2m)^2). */
    pdn_stability *stability;
    CHECK_STATUS(pdn_sensitivities_new(&s), PDN_OK);
    CHECK_STATUS(pdn_sensitivities_add_parameter(s, stiffness), PDN_OK);
    CHECK_STATUS(pdn_sensitivities_add_parameter(s, nothing), PDN_OK);
    CHECK_STATUS(pdn_sensitivities_add_parameter(s, PDN_FREQUENCY), PDN_OK);
    CHECK_STATUS(pdn_solve_stability(solution, NULL, &stability), PDN_OK);
    double by[3][2] = {{0, 0}, {0, 0}, {0, 0}};
    for (int i = 0; i < 3; i += 2) {
        const double places[4] = {-2, -1, 1, 2}, weights[4] = {1, -8, 8, -1};
        for (int k = 0; k < 4; ++k) {
            double step[3] = {0, 0, 0};
            step[i] = places[k] * h;
            const double damping = DAMPING / (2 * MASS), of = weights[k] / (12 * h);
            const double turning = sqrt((STIFFNESS + step[0]) / MASS - damping * damping);
            const double period = 2 * PI / (w + step[2]), size = exp(-damping * period);
            by[i][0] += of * size * cos(turning * period);
            by[i][1] += of * size * sin(turning * period);
        }
    }
    double re[3], im[3];
    CHECK_STATUS(
        pdn_solution_multiplier_sensitivities(solution, s, stability, 0, NULL, NULL, re, im, 3),
        PDN_OK);
    for (int i = 0; i < 3; ++i) {
        CHECK_NEAR(re[i], by[i][0], 1e-8);
        CHECK_NEAR(im[i], by[i][1], 1e-8);
    }
    CHECK_STATUS(
        pdn_solution_multiplier_sensitivities(solution, s, stability, 2, NULL, NULL, re, im, 3),
        PDN_ERR_ID);
    CHECK_STATUS(
        pdn_solution_multiplier_sensitivities(solution, s, stability, 0, NULL, NULL, re, im, 2),
        PDN_ERR_SIZE);
    CHECK_STATUS(pdn_solution_multiplier_sensitivities(solution, s, NULL, 0, NULL, NULL, re, im, 3),
                 PDN_ERR_NULL);
    pdn_stability_free(stability);
    pdn_sensitivities_free(s);

    /* A constant has no peak; a statical solution no sensitivities. */
    pdn_quantity y;
    PDN_INIT(pdn_quantity, &y);
    y.kind = PDN_NODE_POSITION;
    y.object = body;
    CHECK_STATUS(pdn_sensitivities_new(&s), PDN_OK);
    CHECK_STATUS(pdn_sensitivities_add_quantity(s, &y, PDN_FEATURE_LARGEST, 0), PDN_ERR_VALUE);
    y.component = 1;
    CHECK_STATUS(pdn_sensitivities_add_quantity(s, &y, PDN_FEATURE_LARGEST, 0), PDN_OK);
    CHECK_STATUS(pdn_sensitivities_add_parameter(s, load), PDN_OK);
    CHECK_STATUS(pdn_solution_sensitivities(solution, s, NULL, NULL, found[0], 1, 1),
                 PDN_ERR_NOT_AVAILABLE);
    CHECK_MESSAGE("it is constant");
    pdn_solution_free(solution);
    CHECK_STATUS(pdn_solve_static(model, NULL, &solution), PDN_OK);
    CHECK_STATUS(pdn_solution_sensitivities(solution, s, NULL, NULL, found[0], 1, 1),
                 PDN_ERR_NOT_AVAILABLE);
    CHECK_MESSAGE("periodic solution");
    pdn_sensitivities_free(s);
    pdn_solution_free(solution);
    pdn_model_free(model);
}

/* At resonance, where the velocity has no sine: its frequency is that of the spring, and the
 * velocity the force over the damping. */
static void at_resonance(void)
{
    double found[2][2];
    pdn_quantity rate = coordinate(PDN_JOINT_RATE);
    pdn_periodic_options options;
    pdn_conditions *conditions;
    pdn_sensitivities *s;
    pdn_solution *solution;
    begin();
    CHECK_STATUS(pdn_conditions_new(&conditions), PDN_OK);
    CHECK_STATUS(pdn_conditions_release(conditions, PDN_FREQUENCY), PDN_OK);
    rate.object = joint;
    CHECK_STATUS(pdn_conditions_add_quantity(conditions, &rate, PDN_FEATURE_SINE, 1, 0, 0), PDN_OK);
    PDN_INIT(pdn_periodic_options, &options);
    options.grid_points = 7;
    CHECK_STATUS(pdn_solve_conditioned(model, 2 * PI / 1.98, conditions, &options, &solution),
                 PDN_OK);
    CHECK(pdn_solution_outcome(solution) == PDN_CONVERGED);
    CHECK_STATUS(pdn_sensitivities_new(&s), PDN_OK);
    CHECK_STATUS(pdn_sensitivities_add_found(s, PDN_FREQUENCY), PDN_OK);
    CHECK_STATUS(pdn_sensitivities_add_quantity(s, &rate, PDN_FEATURE_COSINE, 1), PDN_OK);
    CHECK_STATUS(pdn_sensitivities_add_parameter(s, stiffness), PDN_OK);
    CHECK_STATUS(pdn_sensitivities_add_parameter(s, load), PDN_OK);
    CHECK_STATUS(pdn_solution_sensitivities(solution, s, conditions, NULL, found[0], 2, 2), PDN_OK);
    CHECK_NEAR(found[0][0], 0.25, 1e-9);
    CHECK_NEAR(found[0][1], 0, 1e-9);
    CHECK_NEAR(found[1][0], 0, 1e-9);
    CHECK_NEAR(found[1][1], FORCE / DAMPING, 1e-9);

    /* Free, and asked for. */
    CHECK_STATUS(pdn_sensitivities_add_parameter(s, PDN_FREQUENCY), PDN_OK);
    double more[6];
    CHECK_STATUS(pdn_solution_sensitivities(solution, s, conditions, NULL, more, 2, 3),
                 PDN_ERR_VALUE);
    CHECK_MESSAGE("which is free");
    CHECK_STATUS(pdn_solution_sensitivities(solution, s, NULL, NULL, more, 2, 3), PDN_ERR_VALUE);
    CHECK_MESSAGE("a parameter that is free");
    pdn_sensitivities_free(s);
    pdn_conditions_free(conditions);
    pdn_solution_free(solution);
    pdn_model_free(model);
}

int main(void)
{
    held();
    at_resonance();
    return 0;
}
