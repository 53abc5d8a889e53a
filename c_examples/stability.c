/* Ground resonance: a rotor of three blades on a hub on springs, over a range of speeds.
 *
 * The hub moves in its plane on springs that differ in axes 1 and 2; the blades are hinged to it
 * and swing in that plane (lag), held up by the rotation and by weak springs, with dampers too weak
 * for some speeds. If the plane is upright, weight shakes the blades once a turn: the motion is
 * periodic, and its stability a matter of Floquet multipliers. Metres, newtons, kilograms,
 * seconds, radians.
 *
 *   stability [--grid N] [--speeds COUNT] [--damper NMS] [--weight G] [--out FILE] [--chart FILE]
 *
 * FILE gets speeds, rates of growth and frequencies of the five pairs of modes; plot it by
 *
 *   script/plot.py --group FILE IMAGE
 *
 * The chart has the exponents with what the blades do in each mode, in one call; plot it by
 *
 *   script/plot.py FILE IMAGE
 */

#include <math.h>

#include "example.h"

enum { BLADES = 3, MODES = 5 };

static const double PI = 3.14159265358979323846;
static const double SLOWEST = 3, FASTEST = 20; /* rad/s */

/* A rotor that turns at this speed, and its blades; NULL if it cannot be built. */
static pdn_model *rotor(double speed, double lag_damper, double weight, int32_t blades[BLADES])
{
    const double centre[3] = {0, 0, 0}, shaft[3] = {0, 0, 1}, gravity[3] = {0, -weight, 0};
    const double ball[9] = {0.1, 0, 0, 0, 0.1, 0, 0, 0, 0.1};
    const double hinge_at = 0.3, mass_at = 2.3; /* from the shaft */
    pdn_model *model = NULL;
    int32_t hub, plane;
    pdn_signal turn;
    TRY(pdn_model_new(&model));
    TRY(pdn_model_add_rigid_body(model, 6, centre, ball, &hub));
    TRY(pdn_model_add_planar(model, PDN_GROUND, hub, centre, shaft, &plane));
    TRY(pdn_model_add_spring_damper(model, plane, PDN_DISPLACEMENT, 900, 4, 0, NULL));
    TRY(pdn_model_add_spring_damper(model, plane, PDN_DISPLACEMENT_2, 1300, 6, 0, NULL));
    PDN_INIT(pdn_signal, &turn);
    TRY(pdn_signal_set_harmonics(&turn, 0, speed, NULL, NULL, 0));
    TRY(pdn_model_prescribe(model, plane, PDN_ROTATION, &turn, NULL));
    for (int k = 0; k < BLADES; ++k) {
        const double azimuth = 2 * PI * k / BLADES;
        const double hinge[3] = {hinge_at * cos(azimuth), hinge_at * sin(azimuth), 0};
        const double mass[3] = {mass_at * cos(azimuth), mass_at * sin(azimuth), 0};
        int32_t *const blade = &blades[k], lag;
        TRY(pdn_model_add_rigid_body(model, 1, mass, ball, blade));
        TRY(pdn_model_add_revolute(model, hub, *blade, hinge, shaft, &lag));
        TRY(pdn_model_add_spring_damper(model, lag, PDN_ROTATION, 25, lag_damper, 0, NULL));
    }
    TRY(pdn_model_set_gravity(model, gravity));
    return model;

done:
    pdn_model_free(model);
    return NULL;
}

/* Modes with positive frequencies, by these; returns their number. */
static int modes_of(const pdn_stability *stability, double growth[MODES], double frequency[MODES])
{
    size_t count = 0;
    int found = 0;
    pdn_stability_count(stability, &count, NULL);
    for (size_t i = 0; i < count; ++i) {
        pdn_multiplier multiplier;
        PDN_INIT(pdn_multiplier, &multiplier);
        if (pdn_stability_get(stability, (int32_t)i, &multiplier) != PDN_OK ||
            multiplier.imaginary < 0 || found == MODES) {
            continue;
        }
        int at = found++;
        for (; at > 0 && frequency[at - 1] > multiplier.frequency; --at) {
            frequency[at] = frequency[at - 1];
            growth[at] = growth[at - 1];
        }
        frequency[at] = multiplier.frequency;
        growth[at] = multiplier.exponent_real;
    }
    return found;
}

/* Writes the chart of exponents over the speed, at so many speeds or a few more; 0 if it worked. */
static int write_chart(const char *path, const pdn_model *model, const int32_t blades[BLADES],
                       size_t speeds)
{
    int failed = 1;
    pdn_branch *branch = NULL;
    pdn_branch_options options;
    PDN_INIT(pdn_branch_options, &options);
    options.largest_step = 1 / (double)(speeds > 1 ? speeds - 1 : 1);
    options.first_step = options.largest_step;
    TRY(pdn_solve_frequency_response(model, SLOWEST, FASTEST, &options, &branch));
    TRY(pdn_branch_write_campbell(branch, NULL, blades, BLADES, path));
    failed = 0;
done:
    pdn_branch_free(branch);
    return failed;
}

int main(int argc, char **argv)
{
    check_options(argc, argv, "--grid --speeds --damper --weight --out --chart");
    const size_t grid = option_count(argc, argv, "--grid", 0); /* 0: as many as needed */
    const size_t speeds = option_count(argc, argv, "--speeds", 35);
    const double damper = option_number(argc, argv, "--damper", 0.6);
    const double weight = option_number(argc, argv, "--weight", 9.81); /* 0: the plane is level */
    const char *chart = option_text(argc, argv, "--chart", NULL);
    int32_t blades[BLADES];
    FILE *file = open_out(argc, argv);
    int failed = 1;
    pdn_model *model = NULL;
    pdn_solution *solution = NULL;
    pdn_stability *stability = NULL;

    if (file) {
        fputs("rotor speed [rad/s]", file);
        for (int i = 1; i <= MODES; ++i) {
            fprintf(file, ",rate of growth [1/s] %d", i);
        }
        for (int i = 1; i <= MODES; ++i) {
            fprintf(file, ",frequency [rad/s] %d", i);
        }
    }
    printf("rotor speed  largest multiplier  growth [1/s]  frequency [rad/s]  verdict\n");
    for (size_t k = 0; k < speeds; ++k) {
        const double part = speeds > 1 ? (double)k / (double)(speeds - 1) : 0;
        const double speed = SLOWEST + part * (FASTEST - SLOWEST);
        pdn_periodic_options options;
        PDN_INIT(pdn_periodic_options, &options);
        options.grid_points = grid;
        if (!(model = rotor(speed, damper, weight, blades))) {
            goto done;
        }
        TRY(pdn_solve_periodic(model, 2 * PI / speed, &options, &solution));
        if (pdn_solution_outcome(solution) != PDN_CONVERGED) {
            char report[4096];
            pdn_solution_report(solution, report, sizeof report);
            fputs(report, stderr);
            goto done;
        }
        TRY(pdn_solve_stability(solution, NULL, &stability));

        int32_t verdict;
        pdn_multiplier first;
        PDN_INIT(pdn_multiplier, &first);
        TRY(pdn_stability_verdict(stability, &verdict, NULL));
        TRY(pdn_stability_get(stability, 0, &first));
        printf("%11.3f %19.6f %13.6f %18.4f  %s\n", speed, hypot(first.real, first.imaginary),
               first.exponent_real, first.frequency,
               verdict == PDN_STABLE     ? "stable"
               : verdict == PDN_UNSTABLE ? "unstable"
                                         : "not known");
        double growth[MODES], frequency[MODES];
        if (file && modes_of(stability, growth, frequency) == MODES) {
            fprintf(file, "\n%.17g", speed);
            for (int i = 0; i < MODES; ++i) {
                fprintf(file, ",%.17g", growth[i]);
            }
            for (int i = 0; i < MODES; ++i) {
                fprintf(file, ",%.17g", frequency[i]);
            }
        }
        pdn_stability_free(stability);
        pdn_solution_free(solution);
        pdn_model_free(model);
        stability = NULL;
        solution = NULL;
        model = NULL;
    }
    if (file) {
        fputs("\n", file);
    }
    if (chart && (!(model = rotor(SLOWEST, damper, weight, blades)) ||
                  write_chart(chart, model, blades, speeds))) {
        goto done;
    }
    failed = 0;

done:
    if (file && fclose(file) != 0) {
        perror("--out");
        failed = 1;
    }
    pdn_stability_free(stability);
    pdn_solution_free(solution);
    pdn_model_free(model);
    return failed;
}
