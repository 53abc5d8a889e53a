/* A blade of 10 m, clamped to a hub that turns once a second about a horizontal shaft.
 *
 * The shaft is axis 1, axis 3 points up; the blade starts upwards. Its weight bends it once per
 * revolution in the plane of rotation (lag), a harmonic force on its tip along the shaft (flap);
 * pitched by 8 degrees, it couples both. Natural frequencies are 1.8 (flap) and 2.5 (lag) per
 * revolution. Metres, newtons, kilograms, seconds.
 *
 *   rotor_blade [--grid N] [--elements E] [--order P] [--out FILE]
 *
 * FILE gets times, tip deflections and root moments in the turning frame, at 401 times from 0 to T.
 */

#include <math.h>

#include "example.h"

enum { TIMES = 401, HARMONICS = 4, CURVES = 5 };

static const double PI = 3.14159265358979323846;

/* Curve c at time i. Moments at the root are those on the blade's end, of the sign of the
 * deflections that go with them. */
typedef double curves[TIMES][CURVES];

static const char *const TITLE[CURVES] = {"tip flap [m]", "tip lag [m]", "flap moment [N m]",
                                          "lag moment [N m]", "torsion [N m]"};

/* Mean of curve c for h = 0, else the amplitude of harmonic h. */
static double amplitude(curves y, int c, int h)
{
    const int count = TIMES - 1; /* the last time repeats the first */
    double cosine = 0, sine = 0;
    for (int i = 0; i < count; ++i) {
        cosine += y[i][c] * cos(2 * PI * h * i / count) / count;
        sine += y[i][c] * sin(2 * PI * h * i / count) / count;
    }
    return h == 0 ? cosine : 2 * hypot(cosine, sine);
}

int main(int argc, char **argv)
{
    check_options(argc, argv, "--grid --elements --order --out");
    const size_t grid = option_count(argc, argv, "--grid", 0); /* 0: as many as needed */
    const size_t elements = option_count(argc, argv, "--elements", 4);
    const size_t order = option_count(argc, argv, "--order", 4);
    FILE *file = open_out(argc, argv);
    int failed = 1;
    pdn_model *model = NULL;
    pdn_solution *solution = NULL;

    const double centre[3] = {0, 0, 0}, root[3] = {0, 0, 0.5}, tip[3] = {0, 0, 10.5};
    const double shaft[3] = {1, 0, 0}, gravity[3] = {0, 0, -9.81};
    const double pitch = 8 * PI / 180, omega = 2 * PI, period = 1; /* rad, rad/s, s */
    const double flapwise[3] = {cos(pitch), sin(pitch), 0};

    /* [axial, shear, shear, torsion, bending in lag, in flap] stiffness; mass and its moments of
     * inertia [m, m11, m22, m33], for each unit of length. */
    const double stiffness[6] = {500e6, 100e6, 100e6, 500e3, 3.87e6, 1.30e6};
    const double mass[4] = {20.0, 0.20, 0.15, 0.05};

    pdn_section profile;
    PDN_INIT(pdn_section, &profile);
    TRY(pdn_section_set_diagonal(&profile, stiffness, mass));
    for (int i = 3; i < 6; ++i) { /* damping of torsion and bending, on the diagonal */
        profile.damping[7 * i] = 0.01 * stiffness[i];
    }

    pdn_beam blade;
    int32_t hub, bearing, clamp, gauge;
    TRY(pdn_model_new(&model));
    TRY(pdn_model_add_node(model, centre, NULL, &hub));
    TRY(pdn_model_add_straight_beam(model, root, tip, flapwise, &profile, elements, order, &blade));
    TRY(pdn_model_add_revolute(model, PDN_GROUND, hub, centre, shaft, &bearing));
    TRY(pdn_model_add_rigid_joint(model, hub, blade.first, root, &clamp));
    /* holds nothing: measures where the tip is in the hub's axes */
    TRY(pdn_model_add_free_joint(model, hub, blade.last, tip, &gauge));
    TRY(pdn_model_set_gravity(model, gravity));

    pdn_signal turn, lift;
    PDN_INIT(pdn_signal, &turn);
    PDN_INIT(pdn_signal, &lift);
    TRY(pdn_signal_set_harmonics(&turn, 0, omega, NULL, NULL, 0));
    TRY(pdn_model_prescribe(model, bearing, PDN_ROTATION, &turn, NULL));
    const double cosines[2] = {1000, 0}, sines[2] = {0, 200}; /* N */
    TRY(pdn_signal_set_harmonics(&lift, 3000, 0, cosines, sines, 2));
    TRY(pdn_model_add_load(model, blade.last, PDN_FRAME_SPACE, PDN_FORCE_1, &lift, NULL));

    pdn_periodic_options options;
    PDN_INIT(pdn_periodic_options, &options);
    options.grid_points = grid;
    TRY(pdn_solve_periodic(model, period, &options, &solution));

    char report[4096];
    pdn_solution_report(solution, report, sizeof report);
    fputs(report, stdout);
    if (pdn_solution_outcome(solution) != PDN_CONVERGED) {
        goto done;
    }

    static double t[TIMES], flap[TIMES], lag[TIMES], reaction[TIMES][6];
    static curves y;
    for (int i = 0; i < TIMES; ++i) {
        t[i] = period * i / (TIMES - 1);
    }
    TRY(pdn_solution_sample(solution, PDN_QUANTITY(PDN_JOINT_COORDINATE, gauge, PDN_DISPLACEMENT),
                            t, TIMES, flap));
    TRY(pdn_solution_sample(solution, PDN_QUANTITY(PDN_JOINT_COORDINATE, gauge, PDN_DISPLACEMENT_2),
                            t, TIMES, lag));
    pdn_quantity at_root = pdn_quantity_of(PDN_JOINT_REACTION, clamp, PDN_ALL_COMPONENTS);
    at_root.frame = PDN_FRAME_FIRST;
    TRY(pdn_solution_sample(solution, &at_root, t, TIMES, reaction[0]));
    for (int i = 0; i < TIMES; ++i) {
        y[i][0] = flap[i];
        y[i][1] = lag[i];
        y[i][2] = -reaction[i][4];
        y[i][3] = reaction[i][3];
        y[i][4] = reaction[i][5];
    }

    printf("\nIn the turning frame, means and amplitudes\nper rev");
    for (int c = 0; c < CURVES; ++c) {
        printf("%18s", TITLE[c]);
    }
    for (int h = 0; h <= HARMONICS; ++h) {
        printf("\n%7d", h);
        for (int c = 0; c < CURVES; ++c) {
            printf("%18.*f", c < 2 ? 5 : 2, amplitude(y, c, h));
        }
    }
    printf("\n");

    if (file) {
        fputs("time [s]", file);
        for (int c = 0; c < CURVES; ++c) {
            fprintf(file, ",%s", TITLE[c]);
        }
        for (int i = 0; i < TIMES; ++i) {
            fprintf(file, "\n%.17g", t[i]);
            for (int c = 0; c < CURVES; ++c) {
                fprintf(file, ",%.17g", y[i][c]);
            }
        }
        fputs("\n", file);
    }
    failed = 0;

done:
    if (file && fclose(file) != 0) {
        perror("--out");
        failed = 1;
    }
    pdn_solution_free(solution);
    pdn_model_free(model);
    return failed;
}
