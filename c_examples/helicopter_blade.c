/* An articulated blade of a helicopter in forward flight.
 *
 * The rotor turns at 44 rad/s about axis 3, counter-clockwise from above, and flies along -axis 1;
 * at t = 0 the blade points aft. From hub to tip: flap and lag hinge with a damper of elastomer
 * (a Zener element) in lag, then the pitch bearing, which the swash plate turns by collective and
 * cyclic pitch, then the blade, of beams. Its airloads are those of blade elements, a function of
 * ours for each node. Nothing but its rotation holds the blade up. Metres, newtons, kilograms,
 * seconds.
 *
 *   helicopter_blade [--grid N] [--tolerance E] [--elements E] [--order P] [--march STEPS]
 *                    [--out FILE] [--animation FILE.pvd]
 *
 * Solves for flight at 0, 20, 40 and 60 m/s, each speed from the motion at the one before, and
 * prints flap and lag; FILE gets those of the last over 401 times. --march checks it by marching.
 */

#include <math.h>

#include "example.h"

enum { TIMES = 401, SPEEDS = 4, HARMONICS = 3, MOST_NODES = 400 };

static const double PI = 3.14159265358979323846, OMEGA = 44;
static const double HINGE = 0.25, BEARING = 0.45, RADIUS = 5.0, CHORD = 0.27,
                    TWIST = -0.14; /* rad */
static const double DENSITY = 1.225, SLOPE = 5.7, DRAG = 0.011, THRUST = 22e3, CONING = 0.035;

/* Wind as a body at rest feels it, along global axes; known to all blade elements. */
typedef struct wind {
    double velocity[3];
} wind;

typedef struct blade_element {
    double width;
    const wind *air;
} blade_element;

/* Lift across and drag along the wind in the plane of chord (axis 2, to the leading edge) and
 * thickness (axis 3), of a section whose lift grows with the sine of its angle to the wind. */
static int airload(const pdn_force_state *state, pdn_force_values *values, void *user_data)
{
    const blade_element *element = user_data;
    const double *R = state->rotations, *W = element->air->velocity, *v = state->velocities;
    double u[3]; /* the wind along the node's axes, before its own velocity is taken off */
    for (int i = 0; i < 3; ++i) {
        u[i] = R[3 * i] * W[0] + R[3 * i + 1] * W[1] + R[3 * i + 2] * W[2];
    }
    const double w2 = u[1] - v[1], w3 = u[2] - v[2], speed = sqrt(w2 * w2 + w3 * w3) + 1e-9;
    const double factor = 0.5 * DENSITY * CHORD * element->width;
    values->forces[1] = factor * (SLOPE * w3 * w3 + DRAG * speed * w2);
    values->forces[2] = factor * (-SLOPE * w3 * w2 + DRAG * speed * w3);
    if (!values->by_motion) {
        return 0;
    }
    const double by_wind[2][2] = {{factor * DRAG * (speed + w2 * w2 / speed),
                                   factor * (2 * SLOPE * w3 + DRAG * w2 * w3 / speed)},
                                  {factor * (-SLOPE * w3 + DRAG * w2 * w3 / speed),
                                   factor * (-SLOPE * w2 + DRAG * (speed + w3 * w3 / speed))}};
    /* a turn x of the node changes the wind along its axes by u cross x */
    const double turned[2][3] = {{u[2], 0, -u[0]}, {-u[1], u[0], 0}};
    for (int i = 0; i < 2; ++i) {
        for (int j = 0; j < 2; ++j) {
            values->by_velocity[(1 + i) + 6 * (1 + j)] = -by_wind[i][j];
            for (int k = 0; k < 3; ++k) {
                values->by_motion[(1 + i) + 6 * (3 + k)] += by_wind[i][j] * turned[j][k];
            }
        }
    }
    return 0;
}

typedef struct rotor {
    pdn_model *model;
    int32_t hinge, damper;
    pdn_beam blade;
    wind air;
    blade_element elements[MOST_NODES];
} rotor;

static int build(rotor *r, double speed, size_t elements, size_t order)
{
    const double centre[3] = {0, 0, 0}, hinge[3] = {HINGE, 0, 0}, root[3] = {BEARING, 0, 0};
    const double tip[3] = {RADIUS, 0, 0}, span[3] = {1, 0, 0}, flap[3] = {0, -1, 0},
                 up[3] = {0, 0, 1};
    const double chordwise[3] = {0, 1, 0}, gravity[3] = {0, 0, -9.81};
    const double cuff_centre[3] = {0.35, 0, 0},
                 cuff_inertia[9] = {0.02, 0, 0, 0, 0.05, 0, 0, 0, 0.05};

    /* Sections: bending about axis 2 is flap, about axis 3 lag. */
    const double stiffness[6] = {2e7, 4e6, 4e6, 1e4, 1.2e4, 2e5}, mass[4] = {6, 0.04, 0.002, 0.038};
    const double fractions[2] = {0, 1}, twists[2] = {0, TWIST};
    pdn_section sections[2];
    PDN_INIT(pdn_section, &sections[0]);
    TRY(pdn_section_set_diagonal(&sections[0], stiffness, mass));
    TRY(pdn_section_set_proportional_damping(&sections[0], 5e-4));
    sections[1] = sections[0];
    pdn_line line;
    pdn_stations stations;
    PDN_INIT(pdn_line, &line);
    PDN_INIT(pdn_stations, &stations);
    stations.count = 2;
    stations.fractions = fractions;
    stations.sections = sections;
    stations.twists = twists;
    TRY(pdn_line_set_straight(&line, root, tip, chordwise));

    int32_t hub, cuff, shaft, bearing;
    TRY(pdn_model_new(&r->model));
    TRY(pdn_model_set_gravity(r->model, gravity));
    TRY(pdn_model_add_node(r->model, centre, NULL, &hub));
    TRY(pdn_model_add_rigid_body(r->model, 5, cuff_centre, cuff_inertia, &cuff));
    TRY(pdn_model_add_beam(r->model, &line, &stations, elements, order, &r->blade));
    TRY(pdn_model_add_revolute(r->model, PDN_GROUND, hub, centre, up, &shaft));
    TRY(pdn_model_add_universal(r->model, hub, cuff, hinge, flap, up, &r->hinge));
    TRY(pdn_model_add_revolute(r->model, cuff, r->blade.first, root, span, &bearing));

    /* The lag damper: a spring, and beside it a spring and dashpot in series. */
    const double branch = 4e4, relaxation = 0.03;
    TRY(pdn_model_add_viscoelastic(r->model, r->hinge, PDN_ROTATION_2, 4e3, 0, &branch, &relaxation,
                                   1, &r->damper));

    /* The shaft leans forward by 4 degrees. Inflow by momentum theory, for a thrust that four
     * blades share; pitch by that of blade elements, for a blade that keeps to a cone. */
    const double tilt = 4 * PI / 180, disc = PI * RADIUS * RADIUS, tip_speed = OMEGA * RADIUS;
    const double hover = sqrt(THRUST / (2 * DENSITY * disc)),
                 ratio = speed * speed / (2 * hover * hover);
    const double down = speed * sin(tilt) + hover * sqrt(sqrt(ratio * ratio + 1) - ratio);
    const double advance = speed / tip_speed, inflow = down / tip_speed, period = 2 * PI / OMEGA;
    const double lift =
        THRUST / 4 / (0.5 * DENSITY * SLOPE * CHORD * RADIUS * tip_speed * tip_speed);
    const double middle =
        3 * (lift + inflow / 2) / (1 + 1.5 * advance * advance); /* at 3/4 of the span */
    const double collective = middle - 0.75 * TWIST, cosine = 4.0 / 3 * advance * CONING;
    const double sine = -2 * advance * (4.0 / 3 * middle - inflow) / (1 + 1.5 * advance * advance);
    r->air = (wind){{speed * cos(tilt), 0, -down}};
    pdn_signal turn, pitch;
    PDN_INIT(pdn_signal, &turn);
    PDN_INIT(pdn_signal, &pitch);
    TRY(pdn_signal_set_harmonics(&turn, 0, OMEGA, NULL, NULL, 0));
    TRY(pdn_signal_set_harmonics(&pitch, collective, 0, &cosine, &sine, 1));
    TRY(pdn_model_prescribe(r->model, shaft, PDN_ROTATION, &turn, NULL));
    TRY(pdn_model_prescribe(r->model, bearing, PDN_ROTATION, &pitch, NULL));

    for (int32_t node = r->blade.first; node <= r->blade.last; ++node) {
        /* half the way to either neighbour */
        pdn_frame before, after;
        TRY(pdn_model_node_frame(r->model, node - (node > r->blade.first), &before));
        TRY(pdn_model_node_frame(r->model, node + (node < r->blade.last), &after));
        blade_element *element = &r->elements[node - r->blade.first];
        *element = (blade_element){(after.position[0] - before.position[0]) / 2, &r->air};
        int32_t force;
        TRY(pdn_model_add_user_force(r->model, &node, 1, PDN_FRAME_MATERIAL, PDN_TANGENTS_GIVEN,
                                     airload, element, NULL, &force));
        if (node == r->blade.last) {
            pdn_tangent_check check;
            PDN_INIT(pdn_tangent_check, &check);
            TRY(pdn_model_check_tangents(r->model, force, period, &check));
            if (check.error > 1e-6) {
                fprintf(stderr, "tangents of the airloads are off by %.1e\n", check.error);
                goto done;
            }
        }
    }
    return 0;
done:
    return 1;
}

/* Mean and amplitudes of flap and lag in degrees. */
static int print_harmonics(const rotor *r, const pdn_solution *solution, double speed)
{
    pdn_diagnostics figures;
    PDN_INIT(pdn_diagnostics, &figures);
    TRY(pdn_solution_diagnostics(solution, &figures));
    printf("%5.0f %4d %4d %8.1e", speed, (int)figures.grid_points, (int)figures.iterations,
           figures.error_estimate);
    for (int32_t angle = PDN_ROTATION; angle <= PDN_ROTATION_2; ++angle) {
        double mean, c[HARMONICS], s[HARMONICS];
        TRY(pdn_solution_harmonics(solution, PDN_QUANTITY(PDN_JOINT_COORDINATE, r->hinge, angle),
                                   HARMONICS, &mean, NULL, c, s));
        printf("  %8.3f", mean * 180 / PI);
        for (int h = 0; h < HARMONICS; ++h) {
            printf(" %7.3f", hypot(c[h], s[h]) * 180 / PI);
        }
    }
    printf("\n");
    return 0;
done:
    return 1;
}

static int write_csv(const rotor *r, const pdn_solution *solution, FILE *file)
{
    static double t[TIMES], flap[TIMES], lag[TIMES], effort[TIMES], tip[TIMES][3];
    for (int i = 0; i < TIMES; ++i) {
        t[i] = 2 * PI / OMEGA * i / (TIMES - 1);
    }
    TRY(pdn_solution_sample(solution, PDN_QUANTITY(PDN_JOINT_COORDINATE, r->hinge, PDN_ROTATION), t,
                            TIMES, flap));
    TRY(pdn_solution_sample(solution, PDN_QUANTITY(PDN_JOINT_COORDINATE, r->hinge, PDN_ROTATION_2),
                            t, TIMES, lag));
    TRY(pdn_solution_sample(solution, PDN_QUANTITY(PDN_FORCE_EFFORT, r->damper, PDN_ALL_COMPONENTS),
                            t, TIMES, effort));
    TRY(pdn_solution_sample(solution,
                            PDN_QUANTITY(PDN_NODE_POSITION, r->blade.last, PDN_ALL_COMPONENTS), t,
                            TIMES, tip[0]));
    fputs(
        "azimuth [deg],flap [deg],lag [deg],moment of the lag damper [N m],height of the tip [m]\n",
        file);
    for (int i = 0; i < TIMES; ++i) {
        fprintf(file, "%.17g,%.17g,%.17g,%.17g,%.17g\n", 360.0 * i / (TIMES - 1),
                flap[i] * 180 / PI, lag[i] * 180 / PI, effort[i], tip[i][2]);
    }
    return 0;
done:
    return 1;
}

int main(int argc, char **argv)
{
    check_options(argc, argv, "--grid --tolerance --elements --order --march --out --animation");
    const size_t elements = option_count(argc, argv, "--elements", 6);
    const size_t order = option_count(argc, argv, "--order", 3);
    const size_t steps = (size_t)option_number(argc, argv, "--march", 0);
    const char *animation = option_text(argc, argv, "--animation", NULL);
    FILE *file = open_out(argc, argv);
    const double period = 2 * PI / OMEGA, speeds[SPEEDS] = {0, 20, 40, 60};
    int failed = 1;
    static rotor rotors[SPEEDS];
    pdn_solution *solutions[SPEEDS] = {NULL};

    pdn_periodic_options options;
    PDN_INIT(pdn_periodic_options, &options);
    options.grid_points = option_count(argc, argv, "--grid", 0); /* 0: as many as needed */
    options.error_tolerance = option_number(argc, argv, "--tolerance", options.error_tolerance);
    if (elements * order >= MOST_NODES) {
        fprintf(stderr, "at most %d nodes\n", MOST_NODES);
        goto done;
    }
    printf("Mean and amplitudes per revolution, degrees\n"
           "  m/s    N  it.    error      flap       1       2       3       lag       1       2   "
           "    3\n");
    for (int i = 0; i < SPEEDS; ++i) {
        if (build(&rotors[i], speeds[i], elements, order) != 0) {
            goto done;
        }
        options.initial = i > 0 ? solutions[i - 1] : NULL;
        TRY(pdn_solve_periodic(rotors[i].model, period, &options, &solutions[i]));
        if (pdn_solution_outcome(solutions[i]) != PDN_CONVERGED) {
            char report[4096];
            pdn_solution_report(solutions[i], report, sizeof report);
            fputs(report, stdout);
            goto done;
        }
        if (print_harmonics(&rotors[i], solutions[i], speeds[i]) != 0) {
            goto done;
        }
    }
    const rotor *last = &rotors[SPEEDS - 1];
    const pdn_solution *solution = solutions[SPEEDS - 1];
    if ((steps && check_by_march(last->model, solution, last->blade.last, period, steps) != 0) ||
        (file && write_csv(last, solution, file) != 0)) {
        goto done;
    }
    if (animation) {
        double t[73];
        for (int i = 0; i < 73; ++i) {
            t[i] = period * i / 72;
        }
        TRY(pdn_solution_write_vtk(solution, t, 73, 8, animation));
    }
    failed = 0;

done:
    if (file && fclose(file) != 0) {
        perror("--out");
        failed = 1;
    }
    for (int i = 0; i < SPEEDS; ++i) {
        pdn_solution_free(solutions[i]);
        pdn_model_free(rotors[i].model);
    }
    return failed;
}
