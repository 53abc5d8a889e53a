/* A four-cylinder engine of two litres, at full load.
 *
 * The crankshaft, along axis 1, is of 32 beams joined by rigid joints (journals, webs and pins), on
 * five main bearings that are springs and dampers; it ends in a flywheel that turns evenly. Four
 * flexible rods drive it, each from a piston under the gas pressure of a four-stroke cycle, which
 * is given once a degree over two turns: the period. Cylinders stand along axis 3 and fire in the
 * order 1-3-4-2. Metres, newtons, kilograms, seconds.
 *
 *   engine [--grid N] [--tolerance E] [--march STEPS] [--out FILE] [--animation FILE.pvd]
 *
 * Solves at 1000, 3000 and 6000 rpm, each speed from the motion at the one before; FILE gets
 * torque, twist and forces of the last at 721 times. --march checks it by marching. */

#include <math.h>

#include "example.h"

enum { CYLINDERS = 4, BEARINGS = 5, SAMPLES = 720, TIMES = 721, SPEEDS = 3, FIRING = 4 };

static const double PI = 3.14159265358979323846;
static const double BORE = 0.086, CRANK = 0.043, ROD = 0.143, PITCH = 0.096; /* of the cylinders */
static const double E_STEEL = 210e9, G_STEEL = 81e9, DENSITY = 7850;

/* Pressure over that in the crankcase, at a crank angle in degrees from -360 to 360: intake,
 * compression from -180, combustion about 0 (Wiebe's law for the part that is burnt), expansion,
 * and exhaust, whose valve opens at 140. */
static double gas_pressure(double degrees)
{
    const double ambient = 1e5, ratio = 10, exponent = 1.32, heat = 2.5;
    const double begins = -15, lasts = 60, opens = 140;
    if (fabs(degrees) >= 180) {
        return 0;
    }
    const double angle = degrees * PI / 180, clearance = 2 * CRANK / (ratio - 1);
    const double across = CRANK * sin(angle);
    const double down = CRANK + ROD - CRANK * cos(angle) - sqrt(ROD * ROD - across * across);
    const double compressed = pow((2 * CRANK + clearance) / (down + clearance), exponent);
    const double x = degrees > begins ? (degrees - begins) / lasts : 0;
    const double over = ambient * (compressed * (1 + heat * (1 - exp(-6.9 * x * x * x))) - 1);
    const double open = degrees > opens ? (degrees - opens) / (180 - opens) : 0;
    return over * 0.5 * (1 + cos(PI * open));
}

/* A section of area A whose second moments are I2 and I3, with the torsion constant J. */
static pdn_status set_section(pdn_section *section, double A, double I2, double I3, double J)
{
    const double shear = 0.85 * G_STEEL * A;
    const double stiffness[6] = {E_STEEL * A, shear,        shear,
                                 G_STEEL * J, E_STEEL * I2, E_STEEL * I3};
    const double mass[4] = {DENSITY * A, DENSITY * (I2 + I3), DENSITY * I2, DENSITY * I3};
    PDN_INIT(pdn_section, section);
    const pdn_status status = pdn_section_set_diagonal(section, stiffness, mass);
    return status != PDN_OK ? status : pdn_section_set_proportional_damping(section, 2e-5);
}

static pdn_status set_round(pdn_section *section, double diameter)
{
    const double I = PI / 64 * pow(diameter, 4);
    return set_section(section, PI / 4 * diameter * diameter, I, I, 2 * I);
}

typedef struct engine {
    pdn_model *model;
    int32_t front, drive, gauge; /* node; joints of the flywheel: with the ground, with the front */
    int32_t pistons[CYLINDERS], bearings[BEARINGS][2];
} engine;

static int add_bearing(engine *e, int i, int32_t node, const double *at)
{
    int32_t joint;
    TRY(pdn_model_add_free_joint(e->model, PDN_GROUND, node, at, &joint));
    for (int k = 0; k < 2; ++k) {
        TRY(pdn_model_add_spring_damper(e->model, joint, PDN_DISPLACEMENT_2 + k, 5e8, 5e4, 0,
                                        &e->bearings[i][k]));
    }
    return 0;
done:
    return 1;
}

/* Rod and piston of cylinder i, on the crank pin `node`, with its gas force. */
static int add_cylinder(engine *e, int i, int32_t node, const double *pin)
{
    static const int fires[CYLINDERS] = {0, 540, 180, 360}; /* degrees */
    const double wrist[3] = {pin[0], 0, pin[2] + ROD}, x[3] = {1, 0, 0}, z[3] = {0, 0, 1};
    const double big_end[9] = {3e-4, 0, 0, 0, 3e-4, 0, 0, 0, 3e-4};
    const double piston[9] = {5e-4, 0, 0, 0, 5e-4, 0, 0, 0, 5e-4};
    double force[SAMPLES];
    for (int k = 0; k < SAMPLES; ++k) {
        const double angle = fmod(k * 720.0 / SAMPLES - fires[i] + 1080, 720) - 360;
        force[k] = -PI / 4 * BORE * BORE * gas_pressure(angle);
    }
    pdn_section shank;
    pdn_signal gas;
    pdn_beam rod;
    int32_t joint;
    PDN_INIT(pdn_signal, &gas);
    TRY(pdn_signal_set_samples(&gas, 0, force, SAMPLES));
    TRY(set_section(&shank, 2.4e-4, 1.6e-8, 0.6e-8, 0.4e-8));
    TRY(pdn_model_add_straight_beam(e->model, pin, wrist, x, &shank, 2, 2, &rod));
    TRY(pdn_model_add_mass(e->model, rod.first, 0.3, pin, big_end, NULL));
    TRY(pdn_model_add_rigid_body(e->model, 0.5, wrist, piston, &e->pistons[i]));
    TRY(pdn_model_add_revolute(e->model, node, rod.first, pin, x, &joint));
    TRY(pdn_model_add_spherical(e->model, rod.last, e->pistons[i], wrist, &joint));
    TRY(pdn_model_add_prismatic(e->model, PDN_GROUND, e->pistons[i], wrist, z, &joint));
    TRY(pdn_model_add_load(e->model, e->pistons[i], PDN_FRAME_SPACE, PDN_FORCE_3, &gas, NULL));
    return 0;
done:
    return 1;
}

static int build(engine *e, double speed)
{
    static const double throws[CYLINDERS] = {CRANK, -CRANK, -CRANK, CRANK}; /* along axis 3 */
    const double half_journal = 0.024, half_pin = PITCH / 2 - half_journal;
    const double thick = 0.02, wide = 0.075, y[3] = {0, 1, 0}, gravity[3] = {0, 0, -9.81};
    const double wheel[9] = {0.08, 0, 0, 0, 0.045, 0, 0, 0, 0.045};
    pdn_section journal, pin, web;
    TRY(set_round(&journal, 0.055));
    TRY(set_round(&pin, 0.048));
    TRY(set_section(&web, thick * wide, wide * pow(thick, 3) / 12, thick * pow(wide, 3) / 12,
                    0.28 * wide * pow(thick, 3)));
    TRY(pdn_model_new(&e->model));
    TRY(pdn_model_set_gravity(e->model, gravity));

    double at[3] = {0, 0, 0};
    int32_t end = -1, joint; /* the node at the end of the shaft so far */
    for (int i = 0; i < CYLINDERS; ++i) {
        const double up = throws[i] / 2;
        const struct {
            double dx, dz;
            const pdn_section *section;
        } parts[8] = {{half_journal, 0, &journal},
                      {0, up, &web},
                      {0, up, &web},
                      {half_pin, 0, &pin},
                      {half_pin, 0, &pin},
                      {0, -up, &web},
                      {0, -up, &web},
                      {half_journal, 0, &journal}};
        for (int k = 0; k < 8; ++k) {
            const double to[3] = {at[0] + parts[k].dx, 0, at[2] + parts[k].dz};
            const double opposite[3] = {at[0], 0, -0.8 * throws[i]};
            pdn_beam beam;
            TRY(pdn_model_add_straight_beam(e->model, at, to, y, parts[k].section, 1, 2, &beam));
            if (end < 0) {
                e->front = beam.first;
            } else {
                TRY(pdn_model_add_rigid_joint(e->model, end, beam.first, at, &joint));
            }
            if (k == 0 && add_bearing(e, i, beam.first, at) != 0) {
                goto done;
            }
            if (k == 1 || k == 7) { /* counterweight */
                TRY(pdn_model_add_mass(e->model, beam.first, 0.6, opposite, NULL, NULL));
            }
            if (k == 4 && add_cylinder(e, i, beam.first, at) != 0) {
                goto done;
            }
            end = beam.last;
            memcpy(at, to, sizeof at);
        }
    }
    if (add_bearing(e, CYLINDERS, end, at) != 0) {
        goto done;
    }

    const double behind[3] = {at[0] + 0.04, 0, 0}, origin[3] = {0, 0, 0};
    int32_t flywheel, thrust;
    pdn_signal turn;
    PDN_INIT(pdn_signal, &turn);
    TRY(pdn_signal_set_harmonics(&turn, 0, speed, NULL, NULL, 0));
    TRY(pdn_model_add_rigid_body(e->model, 8, behind, wheel, &flywheel));
    TRY(pdn_model_add_rigid_joint(e->model, end, flywheel, at, &joint));
    TRY(pdn_model_add_free_joint(e->model, PDN_GROUND, flywheel, behind, &e->drive));
    TRY(pdn_model_prescribe(e->model, e->drive, PDN_ROTATION, &turn, NULL));
    TRY(pdn_model_add_spring_damper(e->model, e->drive, PDN_DISPLACEMENT, 1e8, 2e4, 0, &thrust));
    TRY(pdn_model_add_free_joint(e->model, flywheel, e->front, origin,
                                 &e->gauge)); /* measures only */
    return 0;
done:
    return 1;
}

/* What is asked of an engine, at TIMES times of the period. */
typedef struct response {
    double t[TIMES], torque[TIMES], twist[TIMES], force[TIMES]; /* of the middle bearing */
    double piston[TIMES][6];
} response;

static int sample(const engine *e, const pdn_solution *solution, double period, response *out)
{
    static double side[2][TIMES];
    for (int i = 0; i < TIMES; ++i) {
        out->t[i] = period * i / (TIMES - 1);
    }
    TRY(pdn_solution_sample(solution,
                            PDN_QUANTITY(PDN_JOINT_DRIVING_EFFORT, e->drive, PDN_ROTATION), out->t,
                            TIMES, out->torque));
    TRY(pdn_solution_sample(solution, PDN_QUANTITY(PDN_JOINT_COORDINATE, e->gauge, PDN_ROTATION),
                            out->t, TIMES, out->twist));
    TRY(pdn_solution_sample(solution,
                            PDN_QUANTITY(PDN_NODE_ACCELERATION, e->pistons[0], PDN_ALL_COMPONENTS),
                            out->t, TIMES, out->piston[0]));
    for (int k = 0; k < 2; ++k) {
        TRY(pdn_solution_sample(
            solution,
            PDN_QUANTITY(PDN_FORCE_EFFORT, e->bearings[BEARINGS / 2][k], PDN_ALL_COMPONENTS),
            out->t, TIMES, side[k]));
    }
    for (int i = 0; i < TIMES; ++i) {
        out->torque[i] = -out->torque[i]; /* that of the engine on what holds its speed */
        out->twist[i] *= 180 / PI;
        out->force[i] = hypot(side[0][i], side[1][i]);
    }
    return 0;
done:
    return 1;
}

/* A line of the table: mean torque, its amplitude at the firing frequency, largest twist and force.
 */
static int print_line(const engine *e, const pdn_solution *solution, int rpm, const response *r)
{
    double mean, cosines[FIRING], sines[FIRING], twist = 0, force = 0;
    pdn_diagnostics figures;
    PDN_INIT(pdn_diagnostics, &figures);
    TRY(pdn_solution_diagnostics(solution, &figures));
    TRY(pdn_solution_harmonics(solution,
                               PDN_QUANTITY(PDN_JOINT_DRIVING_EFFORT, e->drive, PDN_ROTATION),
                               FIRING, &mean, NULL, cosines, sines));
    for (int i = 0; i < TIMES; ++i) {
        twist = fmax(twist, fabs(r->twist[i]));
        force = fmax(force, r->force[i]);
    }
    printf("%5d %4d %4d %8.1e %10.2f %10.2f %10.4f %10.3f\n", rpm, (int)figures.grid_points,
           (int)figures.iterations, figures.error_estimate, -mean,
           hypot(cosines[FIRING - 1], sines[FIRING - 1]), twist, force / 1000);
    return 0;
done:
    return 1;
}

int main(int argc, char **argv)
{
    check_options(argc, argv, "--grid --tolerance --march --out --animation");
    const size_t steps = (size_t)option_number(argc, argv, "--march", 0);
    const char *animation = option_text(argc, argv, "--animation", NULL);
    FILE *file = open_out(argc, argv);
    const int rpm[SPEEDS] = {1000, 3000, 6000};
    int failed = 1;
    engine engines[SPEEDS];
    pdn_solution *solutions[SPEEDS] = {NULL};
    static response r;
    memset(engines, 0, sizeof engines);

    pdn_periodic_options options;
    PDN_INIT(pdn_periodic_options, &options);
    options.grid_points = option_count(argc, argv, "--grid", 0); /* 0: as many as needed */
    options.error_tolerance = option_number(argc, argv, "--tolerance", 1e-4);
    printf(
        "  rpm    N  it.    error  torque [N m]  twice a turn  twist [deg]  middle bearing [kN]\n");
    for (int i = 0; i < SPEEDS; ++i) {
        const double speed = rpm[i] * PI / 30, period = 4 * PI / speed;
        if (build(&engines[i], speed) != 0) {
            goto done;
        }
        options.initial = i > 0 ? solutions[i - 1] : NULL;
        TRY(pdn_solve_periodic(engines[i].model, period, &options, &solutions[i]));
        if (pdn_solution_outcome(solutions[i]) != PDN_CONVERGED) {
            char report[4096];
            pdn_solution_report(solutions[i], report, sizeof report);
            fputs(report, stdout);
            goto done;
        }
        if (sample(&engines[i], solutions[i], period, &r) != 0 ||
            print_line(&engines[i], solutions[i], rpm[i], &r) != 0) {
            goto done;
        }
    }
    const engine *last = &engines[SPEEDS - 1];
    const pdn_solution *solution = solutions[SPEEDS - 1];
    const double period = r.t[TIMES - 1];
    if (steps && check_by_march(last->model, solution, last->front, period, steps) != 0) {
        goto done;
    }
    if (file) {
        fputs("crank angle [deg],torque [N m],twist of the front end [deg],"
              "force on the middle bearing [N],acceleration of piston 1 [m/s^2]\n",
              file);
        for (int i = 0; i < TIMES; ++i) {
            fprintf(file, "%.17g,%.17g,%.17g,%.17g,%.17g\n", 720.0 * i / (TIMES - 1), r.torque[i],
                    r.twist[i], r.force[i], r.piston[i][2]);
        }
    }
    if (animation) {
        TRY(pdn_solution_write_vtk(solution, r.t, TIMES, 4, animation));
    }
    failed = 0;

done:
    if (file && fclose(file) != 0) {
        perror("--out");
        failed = 1;
    }
    for (int i = 0; i < SPEEDS; ++i) {
        pdn_solution_free(solutions[i]);
        pdn_model_free(engines[i].model);
    }
    return failed;
}
