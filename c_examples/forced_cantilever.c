/* A nylon rod, clamped at one end, shaken at the other: vibrations as large as half its length.
 *
 * It lies along axis 1 in gravity. A force along axis 3 on the tip swings below the first natural
 * frequency, which is 4.1 Hz. Metres, newtons, kilograms, seconds.
 *
 *   forced_cantilever [--grid N] [--elements E] [--order P] [--out FILE]
 *
 * FILE gets times, tip's displacements and root's bending moment at 401 times from 0 to T. */

#include <math.h>

#include "example.h"

enum { TIMES = 401, HARMONICS = 6 };

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

    /* A rod 20 mm thick; E = 2.5 GPa, 1150 kg/m^3. */
    const double root[3] = {0, 0, 0}, tip[3] = {1, 0, 0}, axis_2[3] = {0, 1, 0};
    const double gravity[3] = {0, 0, -9.81};
    const double stiffness[6] = {785e3, 250e3, 250e3, 14.0, 19.6, 19.6};
    const double mass[4] = {0.361, 18.0e-6, 9.0e-6, 9.0e-6};
    const double period = 0.3, cosine = 12.0, sine = 0.0; /* s, N, N */

    pdn_section nylon;
    PDN_INIT(pdn_section, &nylon);
    TRY(pdn_section_set_diagonal(&nylon, stiffness, mass));
    for (int i = 3; i < 6; ++i) { /* damping of torsion and bending, on the diagonal */
        nylon.damping[7 * i] = 5e-3 * stiffness[i];
    }

    pdn_beam rod;
    int32_t clamp;
    TRY(pdn_model_new(&model));
    TRY(pdn_model_add_straight_beam(model, root, tip, axis_2, &nylon, elements, order, &rod));
    TRY(pdn_model_add_rigid_joint(model, PDN_GROUND, rod.first, root, &clamp));
    TRY(pdn_model_set_gravity(model, gravity));

    pdn_signal shake;
    PDN_INIT(pdn_signal, &shake);
    TRY(pdn_signal_set_harmonics(&shake, 0, 0, &cosine, &sine, 1));
    TRY(pdn_model_add_load(model, rod.last, PDN_FRAME_SPACE, PDN_FORCE_3, &shake, NULL));

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

    double mean[3], cosines[HARMONICS][3], sines[HARMONICS][3];
    TRY(pdn_solution_harmonics(solution,
                               PDN_QUANTITY(PDN_NODE_POSITION, rod.last, PDN_ALL_COMPONENTS),
                               HARMONICS, mean, NULL, cosines[0], sines[0]));
    printf("\nTip displacement, amplitudes in mm\n"
           "harmonic      along    upwards\n"
           "       0 %10.3f %10.3f\n",
           1e3 * (mean[0] - tip[0]), 1e3 * (mean[2] - tip[2]));
    for (int h = 0; h < HARMONICS; ++h) {
        printf("%8d %10.3f %10.3f\n", h + 1, 1e3 * hypot(cosines[h][0], sines[h][0]),
               1e3 * hypot(cosines[h][2], sines[h][2]));
    }

    double t[TIMES], position[TIMES][3], reaction[TIMES][6];
    for (int i = 0; i < TIMES; ++i) {
        t[i] = period * i / (TIMES - 1);
    }
    TRY(pdn_solution_sample(solution, PDN_QUANTITY(PDN_NODE_POSITION, rod.last, PDN_ALL_COMPONENTS),
                            t, TIMES, position[0]));
    TRY(pdn_solution_sample(solution, PDN_QUANTITY(PDN_JOINT_REACTION, clamp, PDN_ALL_COMPONENTS),
                            t, TIMES, reaction[0]));
    if (file) {
        fputs("time [s],tip along [m],tip upwards [m],root bending moment [N m]\n", file);
        for (int i = 0; i < TIMES; ++i) {
            fprintf(file, "%.17g,%.17g,%.17g,%.17g\n", t[i], position[i][0] - tip[0],
                    position[i][2] - tip[2], reaction[i][4]);
        }
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
