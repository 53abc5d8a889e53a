/* The planar mechanism with a damped joint of Han and Bauchau, Nonlinear Dynamics 92 (2018),
 * section 7.1: at once periodic for the one method, slowly for the other.
 *
 * Bar 1 turns evenly about O; bar 2 hangs on its end A by a hinge with a Zener element: a spring,
 * and beside it a spring and a dashpot in series with the relaxation time TAU. Their periodic
 * motion is to turn as one. Started from rest, bar 2 swings about that until the dashpot has spent
 * the energy. Feet, pounds of mass, seconds.
 *
 *   damped_mechanism [--grid N] [--out FILE]
 *       finds the periodic motion for six TAU; FILE gets that for TAU = T/10
 *   damped_mechanism --march TAU_OVER_T [--step SECONDS] [--turns TURNS] [--out FILE]
 *       marches instead, for one TAU
 *
 * FILE gets `t,theta2,u2_B`: angle of the hinge, and displacement of the end B of bar 2 across
 * bar 1. */

#include <math.h>

#include "example.h"

enum { NODES = 3, POINTS_PER_TURN = 200 };

static const double PI = 3.14159265358979323846, OMEGA = 50, LENGTH_1 = 0.5, LENGTH_2 = 14.3;

typedef struct mechanism {
    pdn_model *model;
    int32_t bar_2, end, hinge;
} mechanism;

static int build(double tau, mechanism *out)
{
    const double O[3] = {0, 0, 0}, A[3] = {LENGTH_1, 0, 0}, B[3] = {LENGTH_1 + LENGTH_2, 0, 0};
    const double centre_1[3] = {LENGTH_1 / 2, 0, 0}, centre_2[3] = {LENGTH_1 + LENGTH_2 / 2, 0, 0};
    const double axis[3] = {0, 0, 1}, mass_1 = 0.12 * LENGTH_1, mass_2 = 0.12 * LENGTH_2;
    const double I1 = mass_1 * LENGTH_1 * LENGTH_1 / 12, I2 = mass_2 * LENGTH_2 * LENGTH_2 / 12;
    const double inertia_1[9] = {0, 0, 0, 0, I1, 0, 0, 0, I1}; /* thin rods */
    const double inertia_2[9] = {0, 0, 0, 0, I2, 0, 0, 0, I2};
    const double spring = 2.0e5, branch = 1.5e5; /* lb ft^2/s^2 a radian */
    int32_t bar_1, drive, clamp;
    pdn_signal turn;
    PDN_INIT(pdn_signal, &turn);

    TRY(pdn_model_new(&out->model));
    TRY(pdn_model_add_rigid_body(out->model, mass_1, centre_1, inertia_1, &bar_1));
    TRY(pdn_model_add_rigid_body(out->model, mass_2, centre_2, inertia_2, &out->bar_2));
    TRY(pdn_model_add_node(out->model, B, NULL, &out->end));
    TRY(pdn_model_add_revolute(out->model, PDN_GROUND, bar_1, O, axis, &drive));
    TRY(pdn_model_add_revolute(out->model, bar_1, out->bar_2, A, axis, &out->hinge));
    TRY(pdn_model_add_rigid_joint(out->model, out->bar_2, out->end, B, &clamp));
    TRY(pdn_model_add_viscoelastic(out->model, out->hinge, PDN_ROTATION, spring, 0, &branch, &tau,
                                   1, NULL));
    TRY(pdn_signal_set_harmonics(&turn, 0, OMEGA, NULL, NULL, 0));
    TRY(pdn_model_prescribe(out->model, drive, PDN_ROTATION, &turn, NULL));
    return 0;
done:
    return 1;
}

/* Samples the angle and writes it, with the displacement of B; returns the angle, NULL on failure.
 */
static double *sample(const mechanism *m, const pdn_solution *solution, double end, size_t count,
                      FILE *file)
{
    double *t = malloc(count * sizeof *t), *theta = malloc(count * sizeof *theta);
    double(*B)[3] = malloc(count * sizeof *B);
    double *result = NULL;
    if (!t || !theta || !B) {
        fprintf(stderr, "out of memory\n");
        goto done;
    }
    for (size_t i = 0; i < count; ++i) {
        t[i] = end * (double)i / (double)(count - 1);
    }
    TRY(pdn_solution_sample(solution, PDN_QUANTITY(PDN_JOINT_COORDINATE, m->hinge, PDN_ROTATION), t,
                            count, theta));
    TRY(pdn_solution_sample(solution, PDN_QUANTITY(PDN_NODE_POSITION, m->end, PDN_ALL_COMPONENTS),
                            t, count, B[0]));
    if (file) {
        fputs("t,theta2,u2_B\n", file);
        for (size_t i = 0; i < count; ++i) {
            const double u2 = B[i][1] * cos(OMEGA * t[i]) - B[i][0] * sin(OMEGA * t[i]);
            fprintf(file, "%.17g,%.17g,%.17g\n", t[i], theta[i], u2);
        }
    }
    result = theta;
    theta = NULL;
done:
    free(t);
    free(theta);
    free(B);
    return result;
}

/* The vibration of bar 2 about the periodic motion: decay [1/s] and frequency [rad/s]. */
static int eigenvalue(const mechanism *m, double *decay, double *frequency)
{
    int failed = 1;
    pdn_modes *modes = NULL;
    pdn_static_options turning;
    pdn_modes_options options;
    pdn_mode mode;
    PDN_INIT(pdn_static_options, &turning);
    PDN_INIT(pdn_modes_options, &options);
    PDN_INIT(pdn_mode, &mode);
    turning.angular_velocity[2] = OMEGA;
    options.equilibrium = &turning;
    int32_t count;
    TRY(pdn_solve_modes(m->model, &options, &modes));
    TRY(pdn_modes_count(modes, &count, NULL));
    *decay = *frequency = 0;
    for (int32_t i = 0; i < count; ++i) {
        TRY(pdn_modes_get(modes, i, &mode));
        if (mode.eigenvalue_imaginary > 0) {
            *decay = -mode.eigenvalue_real;
            *frequency = mode.eigenvalue_imaginary;
        }
    }
    failed = 0;
done:
    pdn_modes_free(modes);
    return failed;
}

static int periodic(double tau_over_T, size_t grid, FILE *file)
{
    int failed = 1;
    const double period = 2 * PI / OMEGA;
    mechanism m = {0};
    pdn_solution *solution = NULL;
    double *theta = NULL, largest = 0, decay, frequency;
    pdn_periodic_options options;
    pdn_diagnostics diagnostics;
    PDN_INIT(pdn_periodic_options, &options);
    PDN_INIT(pdn_diagnostics, &diagnostics);
    options.grid_points = grid;
    if (build(tau_over_T * period, &m) != 0) {
        goto done;
    }
    TRY(pdn_solve_periodic(m.model, period, &options, &solution));
    TRY(pdn_solution_diagnostics(solution, &diagnostics));
    if (pdn_solution_outcome(solution) != PDN_CONVERGED ||
        !(theta = sample(&m, solution, period, POINTS_PER_TURN + 1, file)) ||
        eigenvalue(&m, &decay, &frequency) != 0) {
        goto done;
    }
    for (int i = 0; i <= POINTS_PER_TURN; ++i) {
        largest = fmax(largest, fabs(theta[i]));
    }
    printf("%8.3f %10d %14.1e %12.4f %12.4f %14.1f\n", tau_over_T, (int)diagnostics.iterations,
           largest, decay, frequency, log(1e6) / (decay * period));
    failed = 0;
done:
    free(theta);
    pdn_solution_free(solution);
    pdn_model_free(m.model);
    return failed;
}

static int march(double tau_over_T, double step, size_t turns, FILE *file)
{
    int failed = 1;
    const double period = 2 * PI / OMEGA;
    const size_t count = turns * POINTS_PER_TURN + 1;
    mechanism m = {0};
    pdn_solution *solution = NULL;
    double *theta = NULL, decay, frequency;
    pdn_march_options options;
    PDN_INIT(pdn_march_options, &options);
    options.duration = (double)turns * period;
    options.period = period;
    options.step = step;
    if (build(tau_over_T * period, &m) != 0 || eigenvalue(&m, &decay, &frequency) != 0) {
        goto done;
    }
    /* From rest, where all bars are; else bar 2 would start turning with bar 1, and not swing. */
    double positions[NODES][3], rotations[NODES][9];
    for (int32_t i = 0; i < NODES; ++i) {
        pdn_frame frame;
        TRY(pdn_model_node_frame(m.model, PDN_FIRST_NODE + i, &frame));
        memcpy(positions[i], frame.position, sizeof frame.position);
        memcpy(rotations[i], frame.rotation, sizeof frame.rotation);
    }
    options.positions = positions[0];
    options.rotations = rotations[0];
    TRY(pdn_solve_march(m.model, &options, &solution));
    if (pdn_solution_outcome(solution) != PDN_CONVERGED ||
        !(theta = sample(&m, solution, options.duration, count, file))) {
        fprintf(stderr, "the march ended early\n");
        goto done;
    }

    /* Largest angle in each turn. */
    printf("  turn     largest |theta2|\n");
    size_t within_3 = 0, within_6 = 0;
    for (size_t k = 0; k < turns; ++k) {
        double largest = 0;
        for (size_t i = k * POINTS_PER_TURN; i <= (k + 1) * POINTS_PER_TURN; ++i) {
            largest = fmax(largest, fabs(theta[i]));
        }
        printf("%6d %20.3e\n", (int)(k + 1), largest);
        within_3 = largest > 1e-3 ? k + 1 : within_3;
        within_6 = largest > 1e-6 ? k + 1 : within_6;
    }
    printf("Revolutions until within 1e-3 rad: %d%s; 1e-6 rad: %d%s\n", (int)within_3,
           within_3 == turns ? " or more" : "", (int)within_6, within_6 == turns ? " or more" : "");

    /* Amplitude C exp(-decay t) of a vibration of one frequency, from angle and rate at two times.
     */
    const double t[2] = {(double)(turns / 2) * period, options.duration};
    double angle[2], rate[2], amplitude[2];
    TRY(pdn_solution_sample(solution, PDN_QUANTITY(PDN_JOINT_COORDINATE, m.hinge, PDN_ROTATION), t,
                            2, angle));
    TRY(pdn_solution_sample(solution, PDN_QUANTITY(PDN_JOINT_RATE, m.hinge, PDN_ROTATION), t, 2,
                            rate));
    for (int i = 0; i < 2; ++i) {
        amplitude[i] = hypot(angle[i], (rate[i] + decay * angle[i]) / frequency);
    }
    printf("Decay in the second half: %.4f 1/s; of the vibration's eigenvalue: %.4f 1/s\n",
           log(amplitude[0] / amplitude[1]) / (t[1] - t[0]), decay);
    failed = 0;
done:
    free(theta);
    pdn_solution_free(solution);
    pdn_model_free(m.model);
    return failed;
}

int main(int argc, char **argv)
{
    check_options(argc, argv, "--grid --march --step --turns --out");
    const size_t grid = option_count(argc, argv, "--grid", 5);
    const double tau = option_number(argc, argv, "--march", 0);
    const double step = option_number(argc, argv, "--step", 3e-3);
    const size_t turns = option_count(argc, argv, "--turns", 8);
    const double taus[6] = {0.05, 0.10, 0.15, 0.20, 0.25, 0.30};
    FILE *file = open_out(argc, argv);
    int failed = 0;
    if (tau > 0) {
        failed = march(tau, step, turns, file);
    } else {
        printf("   TAU/T iterations largest theta2    decay 1/s  freq. rad/s  turns for 1e-6\n");
        for (int i = 0; i < 6 && !failed; ++i) {
            failed = periodic(taus[i], grid, i == 1 ? file : NULL);
        }
    }
    if (file && fclose(file) != 0) {
        perror("--out");
        failed = 1;
    }
    return failed;
}
