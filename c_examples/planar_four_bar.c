/* The planar four-bar mechanism with a crooked axis of Han and Bauchau, Nonlinear Dynamics 92
 * (2018), section 7.3.
 *
 * Crank AB, coupler BC and rocker CD. The axis at C is turned by 5 degrees out of the normal of the
 * plane: rigid bars would lock, flexible ones give way, with large, sudden forces as the mechanism
 * passes the two positions where all bars lie in a line, at T/4 and 3T/4. Metres, newtons,
 * kilograms, seconds.
 *
 *   planar_four_bar [--grid N] [--elements E] [--order P] [--damping BETA] [--out FILE]
 *   planar_four_bar --march STEPS_PER_PERIOD [--elements E] [--order P] [--damping BETA] [--out
 * FILE]
 *
 * The second marches three revolutions from rest and shows the third. BETA is the time constant of
 * stiffness-proportional damping. FILE gets
 * `t,u1_C,phi_C,theta_D,F1,M2` at 2001 times from 0 to T: displacement of C along axis 1, first
 * angle of the sequence 3-1-2 of the coupler's end at C, angle at D, and axial force and bending
 * moment (along and about the first and second axis of the section) in the middle of the crank. */

#include <math.h>

#include "example.h"

enum { TIMES = 2001 };

int main(int argc, char **argv)
{
    check_options(argc, argv, "--grid --march --elements --order --damping --out");
    const size_t grid = option_count(argc, argv, "--grid", 21);
    const size_t elements = option_count(argc, argv, "--elements", 5);
    const size_t order = option_count(argc, argv, "--order", 2);
    const size_t steps = option_count(argc, argv, "--march", 1);
    const int marches = option_text(argc, argv, "--march", NULL) != NULL;
    const double damping = option_number(argc, argv, "--damping", 0);
    FILE *file = open_out(argc, argv);
    int failed = 1;
    pdn_model *model = NULL;
    pdn_solution *solution = NULL;

    const double A[3] = {0, 0, 0}, B[3] = {0, 0.12, 0}, C[3] = {0.24, 0.12, 0}, D[3] = {0.24, 0, 0};
    const double i2[3] = {0, 1, 0}, i3[3] = {0, 0, 1}, back[3] = {-1, 0, 0};
    const double crooked = 5 * 3.14159265358979323846 / 180;
    const double axis_C[3] = {sin(crooked), 0, cos(crooked)};

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
    TRY(pdn_section_set_proportional_damping(&steel16, damping));
    TRY(pdn_section_set_proportional_damping(&steel8, damping));

    pdn_beam crank, coupler, rocker;
    TRY(pdn_model_new(&model));
    TRY(pdn_model_add_straight_beam(model, A, B, back, &steel16, elements, order, &crank));
    TRY(pdn_model_add_straight_beam(model, B, C, i2, &steel16, elements, order, &coupler));
    TRY(pdn_model_add_straight_beam(model, C, D, back, &steel8, elements, order, &rocker));

    int32_t motor_A, hinge_B, hinge_C, hinge_D;
    TRY(pdn_model_add_revolute(model, PDN_GROUND, crank.first, A, i3, &motor_A));
    TRY(pdn_model_add_revolute(model, crank.last, coupler.first, B, i3, &hinge_B));
    TRY(pdn_model_add_revolute(model, coupler.last, rocker.first, C, axis_C, &hinge_C));
    TRY(pdn_model_add_revolute(model, PDN_GROUND, rocker.last, D, i3, &hinge_D));

    const double omega = 0.6, period = 10.471975511965977462; /* 2 pi / omega */
    pdn_signal turn;
    PDN_INIT(pdn_signal, &turn);
    TRY(pdn_signal_set_harmonics(&turn, 0, -omega, NULL, NULL, 0));
    TRY(pdn_model_prescribe(model, motor_A, PDN_ROTATION, &turn, NULL));

    double start = 0; /* of the period that is shown */
    if (marches) {
        pdn_march_options options;
        PDN_INIT(pdn_march_options, &options);
        options.period = period;
        options.steps_per_period = steps;
        options.duration = 3 * period;
        start = 2 * period;
        TRY(pdn_solve_march(model, &options, &solution));
    } else {
        pdn_periodic_options options;
        PDN_INIT(pdn_periodic_options, &options);
        options.grid_points = grid;
        TRY(pdn_solve_periodic(model, period, &options, &solution));
    }

    char report[4096];
    pdn_solution_report(solution, report, sizeof report);
    fputs(report, stdout);
    if (pdn_solution_outcome(solution) != PDN_CONVERGED) {
        goto done;
    }

    static double t[TIMES], position[TIMES][3], axes[TIMES][9], theta[TIMES], force[TIMES][6];
    for (int i = 0; i < TIMES; ++i) {
        t[i] = start + period * i / (TIMES - 1);
    }
    TRY(pdn_solution_sample(solution,
                            PDN_QUANTITY(PDN_NODE_POSITION, coupler.last, PDN_ALL_COMPONENTS), t,
                            TIMES, position[0]));
    TRY(pdn_solution_sample(solution,
                            PDN_QUANTITY(PDN_NODE_ROTATION, coupler.last, PDN_ALL_COMPONENTS), t,
                            TIMES, axes[0]));
    TRY(pdn_solution_sample(solution, PDN_QUANTITY(PDN_JOINT_COORDINATE, hinge_D, PDN_ROTATION), t,
                            TIMES, theta));
    /* The middle of an element, or where two meet. */
    const int32_t middle = crank.first_element + (int32_t)(elements / 2);
    pdn_quantity forces = pdn_quantity_of(PDN_BEAM_FORCE, middle, PDN_ALL_COMPONENTS);
    forces.station = elements % 2 == 1 ? 0 : -1;
    TRY(pdn_solution_sample(solution, &forces, t, TIMES, force[0]));

    int lowest = 0, highest = 0;
    for (int i = 0; i < TIMES; ++i) {
        lowest = force[i][0] < force[lowest][0] ? i : lowest;
        highest = force[i][0] > force[highest][0] ? i : highest;
    }
    printf("Axial force in the crank: %.4f kN at %.4f T to %.4f kN at %.4f T\n",
           1e-3 * force[lowest][0], (t[lowest] - start) / period, 1e-3 * force[highest][0],
           (t[highest] - start) / period);

    if (file) {
        fputs("t,u1_C,phi_C,theta_D,F1,M2\n", file);
        for (int i = 0; i < TIMES; ++i) {
            /* R = R3(phi) R1 R2, stored column by column */
            const double phi = atan2(-axes[i][3], axes[i][4]);
            fprintf(file, "%.17g,%.17g,%.17g,%.17g,%.17g,%.17g\n", t[i] - start,
                    position[i][0] - C[0], phi, theta[i], force[i][0], force[i][4]);
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
