/* A wheel on a trailing arm, driven over waves of a road: a shock absorber as a function of ours.
 *
 * It resists rebound more than bump, as they all do, so that the vehicle rides lower on a wavy road
 * than it stands: the "jacking down" that the last table shows. Axis 3 points up; the chassis moves
 * along it, the arm turns in the plane 1-3. Metres, newtons, kilograms, seconds.
 *
 *   user_force [--grid N] [--out FILE]
 *
 * FILE gets times and, with either absorber, height and acceleration of the chassis and the
 * absorber's force, at 401 times from 0 to T. */

#include <math.h>

#include "example.h"

enum { TIMES = 401, HARMONICS = 3 };

/* Force `damping v (1 + bias v / sqrt(v^2 + soft^2))` for a rate v of the length. */
typedef struct absorber {
    double damping, bias, soft;
} absorber;

/* Acts on the two nodes along the line between them; everything along global axes. */
static int absorb(const pdn_force_state *state, pdn_force_values *values, void *user_data)
{
    const absorber *law = user_data;
    const double *x = state->positions, *u = state->velocities;
    const double r[3] = {x[3] - x[0], x[4] - x[1], x[5] - x[2]};
    const double w[3] = {u[6] - u[0], u[7] - u[1], u[8] - u[2]};
    const double length = sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2]);
    const double e[3] = {r[0] / length, r[1] / length, r[2] / length};
    const double v = e[0] * w[0] + e[1] * w[1] + e[2] * w[2];
    const double root = sqrt(v * v + law->soft * law->soft), s = v / root;
    const double tension = law->damping * v * (1 + law->bias * s);
    for (int i = 0; i < 3; ++i) {
        values->forces[i] = tension * e[i];
        values->forces[6 + i] = -tension * e[i];
    }
    if (!values->by_motion) {
        return 0;
    }
    /* Derivatives of the force on the first node by differences of displacement and velocity. */
    const double slope = law->damping * (1 + law->bias * s * (2 - s * s));
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            const double across = ((i == j) - e[i] * e[j]) / length;
            const double turned = (w[j] - v * e[j]) / length;
            const double by_motion = tension * across + slope * e[i] * turned;
            const double by_velocity = slope * e[i] * e[j];
            for (int column = 0; column < 2; ++column) {
                for (int row = 0; row < 2; ++row) {
                    const int at = (6 * row + i) + 12 * (6 * column + j);
                    const double sign = row == column ? -1 : 1;
                    values->by_motion[at] = sign * by_motion;
                    values->by_velocity[at] = sign * by_velocity;
                }
            }
        }
    }
    return 0;
}

typedef struct response {
    double height[TIMES], acceleration[TIMES], force[TIMES][6];
    double mean, cosines[HARMONICS], sines[HARMONICS]; /* of the height */
} response;

static int solve(absorber *law, size_t grid, const double t[TIMES], double period, response *out)
{
    int failed = 1;
    pdn_model *model = NULL;
    pdn_solution *solution = NULL;

    const double seat[3] = {0, 0, 0.7}, pivot[3] = {-0.4, 0, 0.35}, arm_centre[3] = {-0.1, 0, 0.31};
    const double wheel[3] = {0, 0, 0.3}, up[3] = {0, 0, 1}, across[3] = {0, 1, 0};
    const double chassis_inertia[9] = {20, 0, 0, 0, 20, 0, 0, 0, 20};
    const double arm_inertia[9] = {0.5, 0, 0, 0, 1.0, 0, 0, 0, 1.0}, gravity[3] = {0, 0, -9.81};

    int32_t chassis, arm, road, heave, track, hinge, tyre, damper;
    TRY(pdn_model_new(&model));
    TRY(pdn_model_set_gravity(model, gravity));
    TRY(pdn_model_add_rigid_body(model, 250, seat, chassis_inertia, &chassis));
    TRY(pdn_model_add_rigid_body(model, 30, arm_centre, arm_inertia, &arm));
    TRY(pdn_model_add_node(model, wheel, NULL, &road));
    TRY(pdn_model_add_prismatic(model, PDN_GROUND, chassis, seat, up, &heave));
    TRY(pdn_model_add_prismatic(model, PDN_GROUND, road, wheel, up, &track));
    TRY(pdn_model_add_revolute(model, chassis, arm, pivot, across, &hinge));
    TRY(pdn_model_add_free_joint(model, road, arm, wheel, &tyre));
    /* a torsion bar that carries the chassis, and the tyre */
    TRY(pdn_model_add_spring_damper(model, hinge, PDN_ROTATION, 3200, 0, 0.31, NULL));
    TRY(pdn_model_add_spring_damper(model, tyre, PDN_DISPLACEMENT_3, 200e3, 200, 0, NULL));

    const int32_t mounts[2] = {arm, chassis};
    TRY(pdn_model_add_user_force(model, mounts, 2, PDN_FRAME_SPACE, PDN_TANGENTS_GIVEN, absorb, law,
                                 NULL, &damper));
    pdn_tangent_check check;
    PDN_INIT(pdn_tangent_check, &check);
    TRY(pdn_model_check_tangents(model, damper, period, &check));
    printf("Tangents of the absorber are right to %.1e\n", check.error);

    pdn_signal waves;
    PDN_INIT(pdn_signal, &waves);
    const double cosines[2] = {0.02, 0}, sines[2] = {0, 0.005};
    TRY(pdn_signal_set_harmonics(&waves, 0, 0, cosines, sines, 2));
    TRY(pdn_model_prescribe(model, track, PDN_DISPLACEMENT, &waves, NULL));

    pdn_periodic_options options;
    PDN_INIT(pdn_periodic_options, &options);
    options.grid_points = grid;
    TRY(pdn_solve_periodic(model, period, &options, &solution));
    char report[4096];
    pdn_solution_report(solution, report, sizeof report);
    printf("%s\n", report);
    if (pdn_solution_outcome(solution) != PDN_CONVERGED) {
        goto done;
    }

    TRY(pdn_solution_sample(solution, PDN_QUANTITY(PDN_JOINT_COORDINATE, heave, PDN_DISPLACEMENT),
                            t, TIMES, out->height));
    TRY(pdn_solution_sample(solution, PDN_QUANTITY(PDN_JOINT_ACCELERATION, heave, PDN_DISPLACEMENT),
                            t, TIMES, out->acceleration));
    pdn_quantity force = pdn_quantity_of(PDN_FORCE_ON_NODE, damper, PDN_ALL_COMPONENTS);
    force.node = chassis;
    TRY(pdn_solution_sample(solution, &force, t, TIMES, out->force[0]));
    TRY(pdn_solution_harmonics(solution,
                               PDN_QUANTITY(PDN_JOINT_COORDINATE, heave, PDN_DISPLACEMENT),
                               HARMONICS, &out->mean, NULL, out->cosines, out->sines));
    failed = 0;

done:
    pdn_solution_free(solution);
    pdn_model_free(model);
    return failed;
}

int main(int argc, char **argv)
{
    check_options(argc, argv, "--grid --out");
    const size_t grid = option_count(argc, argv, "--grid", 0); /* 0: as many as needed */
    FILE *file = open_out(argc, argv);

    const double period = 0.5; /* s */
    double t[TIMES];
    for (int i = 0; i < TIMES; ++i) {
        t[i] = period * i / (TIMES - 1);
    }
    absorber even = {2000, 0, 0.1}, biased = {2000, 0.5, 0.1};
    static response with[2];
    int failed =
        solve(&even, grid, t, period, &with[0]) || solve(&biased, grid, t, period, &with[1]);
    if (!failed) {
        printf("Height of the chassis over its reference, mean and amplitudes in mm\n"
               "harmonic  even absorber  biased absorber\n"
               "       0 %14.4f %16.4f\n",
               1e3 * with[0].mean, 1e3 * with[1].mean);
        for (int h = 0; h < HARMONICS; ++h) {
            printf("%8d %14.4f %16.4f\n", h + 1, 1e3 * hypot(with[0].cosines[h], with[0].sines[h]),
                   1e3 * hypot(with[1].cosines[h], with[1].sines[h]));
        }
    }
    if (!failed && file) {
        fputs("time [s],height with even absorber [m],height with biased absorber [m],"
              "acceleration with even absorber [m/s^2],acceleration with biased absorber [m/s^2],"
              "upward force of the even absorber [N],upward force of the biased absorber [N]\n",
              file);
        for (int i = 0; i < TIMES; ++i) {
            fprintf(file, "%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g\n", t[i], with[0].height[i],
                    with[1].height[i], with[0].acceleration[i], with[1].acceleration[i],
                    with[0].force[i][2], with[1].force[i][2]);
        }
    }
    if (file && fclose(file) != 0) {
        perror("--out");
        failed = 1;
    }
    return failed;
}
