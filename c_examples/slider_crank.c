/* A slider-crank with a rigid rod and with a flexible one: what bending does to the torque.
 *
 * The crank turns evenly about axis 3, at a seventh of the rod's first bending frequency; the
 * slider moves along axis 1. Four simple joints hold the plane mechanism more than once: with the
 * rigid rod some of their reactions are not determined, the motion and the torque are. Metres,
 * newtons, kilograms, seconds.
 *
 *   slider_crank [--grid N] [--elements E] [--order P] [--out FILE]
 *
 * FILE gets times, acceleration of the slider and torque on the crank with either rod, and the
 * deflection of the flexible one's middle, at 401 times from 0 to T. */

#include <math.h>

#include "example.h"

enum { TIMES = 401, HARMONICS = 6, RIGID = 0, FLEXIBLE = 1 };

static const double PI = 3.14159265358979323846;

/* With one of the rods. */
typedef struct response {
    double acceleration[TIMES]; /* of the slider */
    double torque[TIMES], mean, cosines[HARMONICS], sines[HARMONICS];
    double deflection[TIMES]; /* of the rod's middle, to the left of the line from pin to wrist */
} response;

static int solve(int flexible, size_t grid, size_t elements, size_t order, const double t[TIMES],
                 double period, response *out)
{
    int failed = 1;
    pdn_model *model = NULL;
    pdn_solution *solution = NULL;

    /* Crank of 0.15 m, rod of 0.3 m. The crank is balanced; both of them stretched out at first. */
    const double shaft[3] = {0, 0, 0}, pin[3] = {0.15, 0, 0}, wrist[3] = {0.45, 0, 0};
    const double middle[3] = {0.30, 0, 0};
    const double i1[3] = {1, 0, 0}, i2[3] = {0, 1, 0}, i3[3] = {0, 0, 1};
    const double crank_inertia[9] = {1e-3, 0, 0, 0, 1e-3, 0, 0, 0, 1e-3};
    const double slider_inertia[9] = {1e-5, 0, 0, 0, 1e-5, 0, 0, 0, 1e-5};

    /* The rod: steel, 6 mm thick. */
    const double stiffness[6] = {5.85e6, 1.95e6, 1.95e6, 10.1, 13.2, 13.2};
    const double mass[4] = {0.222, 1.0e-6, 0.5e-6, 0.5e-6};
    const double rod_mass = 0.222 * 0.3, rod_inertia[9] = {3.0e-7, 0, 0, 0, 5e-4, 0, 0, 0, 5e-4};

    int32_t crank, slider, bearing, pin_joint, wrist_joint, slide;
    pdn_beam rod;
    TRY(pdn_model_new(&model));
    TRY(pdn_model_add_rigid_body(model, 0.5, shaft, crank_inertia, &crank));
    TRY(pdn_model_add_rigid_body(model, 0.04, wrist, slider_inertia, &slider));
    if (flexible) {
        pdn_section steel;
        PDN_INIT(pdn_section, &steel);
        TRY(pdn_section_set_diagonal(&steel, stiffness, mass));
        TRY(pdn_section_set_proportional_damping(&steel, 1e-4));
        TRY(pdn_model_add_straight_beam(model, pin, wrist, i2, &steel, elements, order, &rod));
    } else {
        TRY(pdn_model_add_rigid_body(model, rod_mass, middle, rod_inertia, &rod.first));
        rod.last = rod.first;
    }
    TRY(pdn_model_add_revolute(model, PDN_GROUND, crank, shaft, i3, &bearing));
    TRY(pdn_model_add_revolute(model, crank, rod.first, pin, i3, &pin_joint));
    TRY(pdn_model_add_revolute(model, rod.last, slider, wrist, i3, &wrist_joint));
    TRY(pdn_model_add_prismatic(model, PDN_GROUND, slider, wrist, i1, &slide));

    pdn_signal turn;
    PDN_INIT(pdn_signal, &turn);
    TRY(pdn_signal_set_harmonics(&turn, 0, 2 * PI / period, NULL, NULL, 0));
    TRY(pdn_model_prescribe(model, bearing, PDN_ROTATION, &turn, NULL));

    pdn_periodic_options options;
    PDN_INIT(pdn_periodic_options, &options);
    options.grid_points = grid;
    TRY(pdn_solve_periodic(model, period, &options, &solution));

    char report[4096];
    pdn_solution_report(solution, report, sizeof report);
    printf("%s rod\n%s\n", flexible ? "Flexible" : "Rigid", report);
    if (pdn_solution_outcome(solution) != PDN_CONVERGED) {
        goto done;
    }

    TRY(pdn_solution_sample(solution, PDN_QUANTITY(PDN_JOINT_ACCELERATION, slide, PDN_DISPLACEMENT),
                            t, TIMES, out->acceleration));
    TRY(pdn_solution_sample(solution, PDN_QUANTITY(PDN_JOINT_DRIVING_EFFORT, bearing, PDN_ROTATION),
                            t, TIMES, out->torque));
    TRY(pdn_solution_harmonics(solution,
                               PDN_QUANTITY(PDN_JOINT_DRIVING_EFFORT, bearing, PDN_ROTATION),
                               HARMONICS, &out->mean, NULL, out->cosines, out->sines));
    if (flexible) {
        static double a[TIMES][3], b[TIMES][3], m[TIMES][3];
        const int32_t middle_node = (rod.first + rod.last) / 2;
        TRY(pdn_solution_sample(solution,
                                PDN_QUANTITY(PDN_NODE_POSITION, rod.first, PDN_ALL_COMPONENTS), t,
                                TIMES, a[0]));
        TRY(pdn_solution_sample(solution,
                                PDN_QUANTITY(PDN_NODE_POSITION, rod.last, PDN_ALL_COMPONENTS), t,
                                TIMES, b[0]));
        TRY(pdn_solution_sample(solution,
                                PDN_QUANTITY(PDN_NODE_POSITION, middle_node, PDN_ALL_COMPONENTS), t,
                                TIMES, m[0]));
        for (int i = 0; i < TIMES; ++i) {
            const double x = b[i][0] - a[i][0], y = b[i][1] - a[i][1];
            out->deflection[i] = (x * (m[i][1] - a[i][1]) - y * (m[i][0] - a[i][0])) / hypot(x, y);
        }
    }
    failed = 0;

done:
    pdn_solution_free(solution);
    pdn_model_free(model);
    return failed;
}

int main(int argc, char **argv)
{
    check_options(argc, argv, "--grid --elements --order --out");
    const size_t grid = option_count(argc, argv, "--grid", 0); /* 0: as many as needed */
    const size_t elements =
        option_count(argc, argv, "--elements", 4); /* even: a node in the middle */
    const size_t order = option_count(argc, argv, "--order", 3);
    FILE *file = open_out(argc, argv);

    const double period = 2 * PI / 120; /* 120 rad/s */
    double t[TIMES];
    for (int i = 0; i < TIMES; ++i) {
        t[i] = period * i / (TIMES - 1);
    }
    static response with[2];
    int failed = solve(RIGID, grid, elements, order, t, period, &with[RIGID]) ||
                 solve(FLEXIBLE, grid, elements, order, t, period, &with[FLEXIBLE]);
    if (!failed) {
        printf("Torque on the crank, mean and amplitudes in N m\n"
               "per turn      rigid   flexible\n"
               "       0 %10.4f %10.4f\n",
               with[RIGID].mean, with[FLEXIBLE].mean);
        for (int h = 0; h < HARMONICS; ++h) {
            printf("%8d %10.4f %10.4f\n", h + 1,
                   hypot(with[RIGID].cosines[h], with[RIGID].sines[h]),
                   hypot(with[FLEXIBLE].cosines[h], with[FLEXIBLE].sines[h]));
        }
    }
    if (!failed && file) {
        fputs("time [s],acceleration with rigid rod [m/s^2],acceleration with flexible rod [m/s^2],"
              "torque with rigid rod [N m],torque with flexible rod [N m],deflection of the rod "
              "[m]\n",
              file);
        for (int i = 0; i < TIMES; ++i) {
            fprintf(file, "%.17g,%.17g,%.17g,%.17g,%.17g,%.17g\n", t[i],
                    with[RIGID].acceleration[i], with[FLEXIBLE].acceleration[i],
                    with[RIGID].torque[i], with[FLEXIBLE].torque[i], with[FLEXIBLE].deflection[i]);
        }
    }
    if (file && fclose(file) != 0) {
        perror("--out");
        failed = 1;
    }
    return failed;
}
