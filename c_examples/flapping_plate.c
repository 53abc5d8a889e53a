/* A plate of rubber, welded to a shaft that turns to and fro: it flaps through large angles.
 *
 * It is 1 m long and 0.5 m wide, in gravity, and lies along axis 1; the shaft is along axis 2.
 * Metres, newtons, kilograms, seconds.
 *
 *   flapping_plate [--grid N] [--elements E] [--degree P] [--out FILE]
 *
 * FILE gets times and the positions of the free edge's middle at 401 times from 0 to T. */

#include <math.h>

#include "example.h"

enum { TIMES = 401, HARMONICS = 4 };

int main(int argc, char **argv)
{
    check_options(argc, argv, "--grid --elements --degree --out");
    const size_t grid = option_count(argc, argv, "--grid", 0); /* 0: as many as needed */
    const size_t elements = option_count(argc, argv, "--elements", 2);
    const size_t degree = option_count(argc, argv, "--degree", 4);
    FILE *file = open_out(argc, argv);
    int failed = 1;
    pdn_model *model = NULL;
    pdn_solution *solution = NULL;

    /* 20 mm thick; E = 0.2 GPa, 1100 kg/m^3, damping of 2 ms times the stiffness. */
    pdn_shell_section rubber;
    PDN_INIT(pdn_shell_section, &rubber);
    TRY(pdn_shell_section_set_isotropic(&rubber, 0.02, 2e8, 0.3, 1100, 1, 0.1));
    TRY(pdn_shell_section_set_proportional_damping(&rubber, 2e-3));

    const double origin[3] = {0, 0, 0}, length[3] = {1, 0, 0}, width[3] = {0, 0.5, 0}; /* m */
    pdn_surface rectangle;
    PDN_INIT(pdn_surface, &rectangle);
    TRY(pdn_surface_set_parallelogram(&rectangle, origin, length, width));

    int32_t root, tip, shaft, hinge, weld;
    pdn_shell plate;
    TRY(pdn_model_new(&model));
    TRY(pdn_model_add_shell(model, &rectangle, elements, 1, degree, degree, 0, &rubber, NULL,
                            &plate));

    const double axis[3] = {0, 1, 0}, gravity[3] = {0, 0, -9.81};
    const double inertia[9] = {1e-3, 0, 0, 0, 1e-3, 0, 0, 0, 1e-3};
    TRY(pdn_model_add_rigid_body(model, 0.1, origin, inertia, &shaft));
    for (int32_t v = 0; v < plate.nodes_v; ++v) { /* the whole edge is welded */
        TRY(pdn_model_shell_patch_node(model, &plate, 0, v, &root));
        TRY(pdn_model_add_rigid_joint(model, shaft, root, origin, &weld));
    }
    TRY(pdn_model_add_revolute(model, PDN_GROUND, shaft, origin, axis, &hinge));
    TRY(pdn_model_set_gravity(model, gravity));

    const double period = 1.6, cosine = 0.6, sine = 0; /* s, radians */
    pdn_signal swing;
    PDN_INIT(pdn_signal, &swing);
    TRY(pdn_signal_set_harmonics(&swing, 0, 0, &cosine, &sine, 1));
    TRY(pdn_model_prescribe(model, hinge, PDN_ROTATION, &swing, NULL));

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

    TRY(pdn_model_shell_patch_node(model, &plate, plate.nodes_u - 1, plate.nodes_v / 2, &tip));
    double mean[3], cosines[HARMONICS][3], sines[HARMONICS][3];
    TRY(pdn_solution_harmonics(solution, PDN_QUANTITY(PDN_NODE_POSITION, tip, PDN_ALL_COMPONENTS),
                               HARMONICS, mean, NULL, cosines[0], sines[0]));
    printf("\nMiddle of the free edge, amplitudes in mm\n"
           "harmonic      along    upwards\n"
           "       0 %10.3f %10.3f\n",
           1e3 * mean[0], 1e3 * mean[2]);
    for (int h = 0; h < HARMONICS; ++h) {
        printf("%8d %10.3f %10.3f\n", h + 1, 1e3 * hypot(cosines[h][0], sines[h][0]),
               1e3 * hypot(cosines[h][2], sines[h][2]));
    }

    double t[TIMES], position[TIMES][3];
    for (int i = 0; i < TIMES; ++i) {
        t[i] = period * i / (TIMES - 1);
    }
    TRY(pdn_solution_sample(solution, PDN_QUANTITY(PDN_NODE_POSITION, tip, PDN_ALL_COMPONENTS), t,
                            TIMES, position[0]));
    if (file) {
        fputs("time [s],tip along [m],tip across [m],tip upwards [m]\n", file);
        for (int i = 0; i < TIMES; ++i) {
            fprintf(file, "%.17g,%.17g,%.17g,%.17g\n", t[i], position[i][0], position[i][1],
                    position[i][2]);
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
