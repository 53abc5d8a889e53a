/* The flexible spatial four-bar mechanism of Han and Bauchau, Nonlinear Dynamics 92 (2018),
 * section 7.2.
 *
 * Rocker AB (revolute at A, spherical at B), coupler BC (universal at C) and crank CD, which a
 * motor at D turns once in a period. Metres, newtons, kilograms, seconds.
 *
 *   spatial_four_bar [--grid N] [--elements E] [--order P] [--out FILE]
 *
 * FILE gets `t,x3_B,v3_B,torque_D` at 401 times from 0 to T: height and vertical velocity of B, and
 * the torque of the motor. */

#include "example.h"

enum { TIMES = 401 };

int main(int argc, char **argv)
{
    check_options(argc, argv, "--grid --elements --order --out");
    const size_t grid = option_count(argc, argv, "--grid", 21);
    const size_t elements = option_count(argc, argv, "--elements", 8);
    const size_t order = option_count(argc, argv, "--order", 1);
    FILE *file = open_out(argc, argv);
    int failed = 1;
    pdn_model *model = NULL;
    pdn_solution *solution = NULL;

    /* The reference configuration, in which nothing is strained. */
    const double A[3] = {-0.40, 0.00, 0.000}, B[3] = {-0.75, 0.00, 0.652};
    const double C[3] = {0.00, 0.85, 0.200}, D[3] = {0.00, 0.85, 0.000};
    const double i1[3] = {1, 0, 0}, i2[3] = {0, 1, 0};
    const double cross[3] = {0, 0.452, 0.85}; /* i1 x BC: arm of the universal joint fixed to BC */

    /* Steel, 16 x 16 mm and 8 x 8 mm: [axial, shear, shear, torsion, bending, bending] stiffness;
     * mass and its moments of inertia [m, m11, m22, m33], for each unit of length. */
    const double stiffness16[6] = {52.99e6, 16.88e6, 16.88e6, 733.5, 1131, 1131};
    const double stiffness8[6] = {13.25e6, 4.220e6, 4.220e6, 45.84, 70.66, 70.66};
    const double mass16[4] = {1.997, 85.20e-6, 42.60e-6, 42.60e-6};
    const double mass8[4] = {0.4992, 5.324e-6, 2.662e-6, 2.662e-6};

    pdn_section steel16, steel8;
    PDN_INIT(pdn_section, &steel16);
    PDN_INIT(pdn_section, &steel8);
    TRY(pdn_section_set_diagonal(&steel16, stiffness16, mass16));
    TRY(pdn_section_set_diagonal(&steel8, stiffness8, mass8));

    pdn_beam rocker, coupler, crank;
    TRY(pdn_model_new(&model));
    TRY(pdn_model_add_straight_beam(model, A, B, i2, &steel16, elements, order, &rocker));
    TRY(pdn_model_add_straight_beam(model, B, C, i1, &steel16, elements, order, &coupler));
    TRY(pdn_model_add_straight_beam(model, C, D, i1, &steel8, elements, order, &crank));

    int32_t hinge_A, ball_B, cardan_C, motor_D;
    TRY(pdn_model_add_revolute(model, PDN_GROUND, rocker.first, A, i2, &hinge_A));
    TRY(pdn_model_add_spherical(model, rocker.last, coupler.first, B, &ball_B));
    TRY(pdn_model_add_universal(model, coupler.last, crank.first, C, cross, i1, &cardan_C));
    TRY(pdn_model_add_revolute(model, PDN_GROUND, crank.last, D, i1, &motor_D));

    TRY(pdn_model_add_spring_damper(model, hinge_A, PDN_ROTATION, 18.0, 0.0, 0.0, NULL));

    /* theta(t) = 0.3 t + (1 - cos 0.3 t) / 3 + sin(0.6 t) / 10 + (1 - cos 0.9 t) / 21 */
    const double omega = 0.3, period = 20.943951023931954923; /* 2 pi / omega */
    const double mean = 1.0 / 3 + 1.0 / 21;
    const double cosines[3] = {-1.0 / 3, 0, -1.0 / 21}, sines[3] = {0, 0.1, 0};
    pdn_signal turn;
    PDN_INIT(pdn_signal, &turn);
    TRY(pdn_signal_set_harmonics(&turn, mean, omega, cosines, sines, 3));
    TRY(pdn_model_prescribe(model, motor_D, PDN_ROTATION, &turn, NULL));

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

    double t[TIMES], position[TIMES][3], velocity[TIMES][6], torque[TIMES];
    for (int i = 0; i < TIMES; ++i) {
        t[i] = period * i / (TIMES - 1);
    }
    TRY(pdn_solution_sample(solution,
                            PDN_QUANTITY(PDN_NODE_POSITION, rocker.last, PDN_ALL_COMPONENTS), t,
                            TIMES, position[0]));
    TRY(pdn_solution_sample(solution,
                            PDN_QUANTITY(PDN_NODE_VELOCITY, rocker.last, PDN_ALL_COMPONENTS), t,
                            TIMES, velocity[0]));
    TRY(pdn_solution_sample(solution, PDN_QUANTITY(PDN_JOINT_DRIVING_EFFORT, motor_D, PDN_ROTATION),
                            t, TIMES, torque));

    int lowest = 0, highest = 0;
    for (int i = 0; i < TIMES; ++i) {
        lowest = torque[i] < torque[lowest] ? i : lowest;
        highest = torque[i] > torque[highest] ? i : highest;
    }
    printf("Torque of the motor: %.4f N m at %.3f T to %.4f N m at %.3f T\n", torque[lowest],
           t[lowest] / period, torque[highest], t[highest] / period);

    if (file) {
        fputs("t,x3_B,v3_B,torque_D\n", file);
        for (int i = 0; i < TIMES; ++i) {
            fprintf(file, "%.17g,%.17g,%.17g,%.17g\n", t[i], position[i][2], velocity[i][2],
                    torque[i]);
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
