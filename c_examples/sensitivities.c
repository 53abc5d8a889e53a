/* What the moments at the root of a blade depend on: their harmonics by the stiffness of the flap
 * hinge and others, from one solution.
 *
 * A flexible blade hangs on a hub that turns, by a flap hinge with a spring and a damper, under a
 * lift that changes over the turn. Each derivative is compared with a difference of two solves.
 * Metres, newtons, kilograms, seconds.
 *
 *   sensitivities [--elements N] [--harmonics H] */

#include "example.h"

static const double PI = 3.14159265358979323846;

enum { DEPENDENTS = 7, PARAMETERS = 6 };

static const char *const NAMES[DEPENDENTS] = {"mean",   "cosine 1", "sine 1",  "cosine 2",
                                              "sine 2", "largest",  "flapping"};

/* What is asked of a solution: moments at the root, and the flap angle. */
static int values(const pdn_solution *solution, const pdn_quantity *moment, int32_t hinge,
                  double *out)
{
    double cosines[2], sines[2], flap;
    TRY(pdn_solution_harmonics(solution, moment, 2, &out[0], NULL, cosines, sines));
    out[1] = cosines[0];
    out[2] = sines[0];
    out[3] = cosines[1];
    out[4] = sines[1];
    TRY(pdn_solution_extremes(solution, moment, NULL, NULL, &out[5], NULL));
    TRY(pdn_solution_harmonics(solution, PDN_QUANTITY(PDN_JOINT_COORDINATE, hinge, PDN_ROTATION), 1,
                               NULL, NULL, NULL, &flap));
    out[6] = flap;
    return 0;
done:
    return 1;
}

int main(int argc, char **argv)
{
    check_options(argc, argv, "--elements --harmonics");
    const size_t elements = option_count(argc, argv, "--elements", 4);
    const double turning = 25, gravity[3] = {0, 0, -9.81};
    const double origin[3] = {0, 0, 0}, up[3] = {0, 0, 1}, across[3] = {0, 1, 0};
    const double root[3] = {0.4, 0, 0}, tip[3] = {6.4, 0, 0};
    const double hub_inertia[9] = {5, 0, 0, 0, 5, 0, 0, 0, 5};
    const double stiffness[6] = {2e8, 4e7, 4e7, 1.5e5, 2e5, 2e6};
    const double mass[4] = {6, 0.1, 0.01, 0.09};
    const double hinge_stiffness = 2e3, hinge_damping = 150, lift = 2500;
    const double cosines[2] = {300, 0}, sines[2] = {-500, 120};
    const double period = 2 * PI / turning;

    int failed = 1;
    pdn_model *model = NULL;
    pdn_solution *solution = NULL, *beside[2] = {NULL, NULL};
    pdn_sensitivities *sensitivities = NULL;
    pdn_section section;
    pdn_signal turn, force;
    pdn_beam blade;
    int32_t hub, shaft, hinge, spring, load;
    PDN_INIT(pdn_section, &section);
    PDN_INIT(pdn_signal, &turn);
    PDN_INIT(pdn_signal, &force);
    TRY(pdn_section_set_diagonal(&section, stiffness, mass));
    TRY(pdn_signal_set_harmonics(&turn, 0, turning, NULL, NULL, 0));
    TRY(pdn_signal_set_harmonics(&force, lift, 0, cosines, sines, 2));
    TRY(pdn_model_new(&model));
    TRY(pdn_model_set_gravity(model, gravity));
    TRY(pdn_model_add_rigid_body(model, 50, origin, hub_inertia, &hub));
    TRY(pdn_model_add_straight_beam(model, root, tip, across, &section, elements, 3, &blade));
    TRY(pdn_model_add_revolute(model, PDN_GROUND, hub, origin, up, &shaft));
    TRY(pdn_model_add_revolute(model, hub, blade.first, root, across, &hinge));
    TRY(pdn_model_prescribe(model, shaft, PDN_ROTATION, &turn, NULL));
    TRY(pdn_model_add_spring_damper(model, hinge, PDN_ROTATION, hinge_stiffness, hinge_damping, 0,
                                    &spring));
    TRY(pdn_model_add_load(model, blade.last, PDN_FRAME_SPACE, PDN_FORCE_3, &force, &load));

    /* Whatever may change is a parameter. Sections are of all elements alike. */
    int32_t p[PARAMETERS] = {0, 0, 0, 0, 0, PDN_FREQUENCY};
    const char *const names[PARAMETERS] = {"hinge stiffness", "hinge damping", "blade stiffness",
                                           "blade mass",      "lift",          "speed"};
    const double start[PARAMETERS] = {hinge_stiffness, hinge_damping, 1, 1, lift, turning};
    for (int i = 0; i < PARAMETERS - 1; ++i) {
        TRY(pdn_model_add_parameter(model, names[i], start[i], start[i], &p[i]));
    }
    TRY(pdn_model_move_number(model, p[0], PDN_NUMBER_STIFFNESS, spring, 1, 1));
    TRY(pdn_model_move_number(model, p[1], PDN_NUMBER_DAMPING, spring, 1, 1));
    for (int32_t k = 0; k < blade.elements; ++k) {
        const int32_t element = blade.first_element + k;
        TRY(pdn_model_move_number(model, p[2], PDN_NUMBER_BEAM_STIFFNESS, element, 0, 1));
        TRY(pdn_model_move_number(model, p[3], PDN_NUMBER_BEAM_MASS, element, 0, 1));
    }
    TRY(pdn_model_move_signal(model, p[4], load, PDN_FORCE_3, PDN_PART_MEAN, 1));

    pdn_periodic_options options;
    PDN_INIT(pdn_periodic_options, &options);
    options.harmonics = option_count(argc, argv, "--harmonics", 10);
    TRY(pdn_solve_periodic(model, period, &options, &solution));
    if (pdn_solution_outcome(solution) != PDN_CONVERGED) {
        fprintf(stderr, "no solution\n");
        goto done;
    }

    /* Flapwise moment in the middle of the first element, and the flap angle. */
    const pdn_quantity moment = pdn_quantity_of(PDN_BEAM_FORCE, blade.first_element, 4);
    const pdn_quantity flap = pdn_quantity_of(PDN_JOINT_COORDINATE, hinge, PDN_ROTATION);
    TRY(pdn_sensitivities_new(&sensitivities));
    TRY(pdn_sensitivities_add_quantity(sensitivities, &moment, PDN_FEATURE_MEAN, 0));
    TRY(pdn_sensitivities_add_quantity(sensitivities, &moment, PDN_FEATURE_COSINE, 1));
    TRY(pdn_sensitivities_add_quantity(sensitivities, &moment, PDN_FEATURE_SINE, 1));
    TRY(pdn_sensitivities_add_quantity(sensitivities, &moment, PDN_FEATURE_COSINE, 2));
    TRY(pdn_sensitivities_add_quantity(sensitivities, &moment, PDN_FEATURE_SINE, 2));
    TRY(pdn_sensitivities_add_quantity(sensitivities, &moment, PDN_FEATURE_LARGEST, 0));
    TRY(pdn_sensitivities_add_quantity(sensitivities, &flap, PDN_FEATURE_SINE, 1));
    for (int i = 0; i < PARAMETERS; ++i) {
        TRY(pdn_sensitivities_add_parameter(sensitivities, p[i]));
    }
    double d[PARAMETERS][DEPENDENTS], here[DEPENDENTS];
    TRY(pdn_solution_sensitivities(solution, sensitivities, NULL, NULL, d[0], DEPENDENTS,
                                   PARAMETERS));
    if (values(solution, &moment, hinge, here) != 0) {
        goto done;
    }
    printf("Change for 1 %% more of each; moments in N m, flapping in degrees\n%-16s", "");
    for (int j = 0; j < DEPENDENTS; ++j) {
        printf("%11s", NAMES[j]);
    }
    printf("\n%-16s", "value");
    for (int j = 0; j < DEPENDENTS; ++j) {
        printf("%11.4f", here[j] * (j == 6 ? 180 / PI : 1));
    }
    for (int i = 0; i < PARAMETERS; ++i) {
        printf("\n%-16s", names[i]);
        for (int j = 0; j < DEPENDENTS; ++j) {
            printf("%11.4f", 0.01 * start[i] * d[i][j] * (j == 6 ? 180 / PI : 1));
        }
    }

    /* By differences: two more solves for each parameter, to half as many digits. */
    double worst = 0;
    options.initial = solution;
    for (int i = 0; i < PARAMETERS - 1; ++i) {
        const double step = 1e-4 * start[i];
        double y[2][DEPENDENTS];
        for (int side = 0; side < 2; ++side) {
            TRY(pdn_model_set_parameter(model, p[i], start[i] + (side == 0 ? step : -step)));
            TRY(pdn_solve_periodic(model, period, &options, &beside[side]));
            if (values(beside[side], &moment, hinge, y[side]) != 0) {
                goto done;
            }
            pdn_solution_free(beside[side]);
            beside[side] = NULL;
        }
        TRY(pdn_model_set_parameter(model, p[i], start[i]));
        for (int j = 0; j < DEPENDENTS; ++j) {
            const double difference = (y[0][j] - y[1][j]) / (2 * step);
            worst = fmax(worst, fabs(difference - d[i][j]) * start[i] / fabs(here[j]));
        }
    }
    printf("\nDifferences of solves agree to %.0e of the values\n", worst);
    failed = !(worst < 1e-6);
done:
    pdn_sensitivities_free(sensitivities);
    pdn_solution_free(beside[0]);
    pdn_solution_free(beside[1]);
    pdn_solution_free(solution);
    pdn_model_free(model);
    return failed;
}
