/* A wind turbine of 5 MW: tower, nacelle and three blades, whose lift dips in the tower's shadow.
 *
 * Axis 3 points up, the wind blows along axis 1. The rotor is upwind of the tower, on a shaft
 * tilted by 5 degrees, and turns evenly; blade 1 points up at first. Lift and thrust come with the
 * azimuth of each blade, once a degree: more of it high up (shear), less before the tower. They
 * grow with the square of the speed, and dampers between blades and air stand for the change of
 * lift with the blades' own velocity. Round numbers of the size of the NREL 5-MW reference turbine
 * (Jonkman et al., NREL/TP-500-38060, 2009). Metres, newtons, kilograms, seconds.
 *
 *   wind_turbine [--grid N] [--tolerance E] [--elements E] [--order P] [--whole 1]
 *                [--march STEPS] [--out FILE] [--animation FILE.pvd]
 *
 * One blade is solved for, as the others do the same a third of a turn later; all of them with
 * --whole 1. Solves at 8, 10 and 12 rpm, each speed from the motion at the one before; FILE gets
 * deflections and moments of the last over 721 times. --march checks it by marching. */

#include <math.h>

#include "example.h"

enum { BLADES = 3, SAMPLES = 360, TIMES = 721, SPEEDS = 3, PER_TURN = 3 };
enum { STATIONS = 9, TOWER_STATIONS = 5, MOST_NODES = 1000 };

static const double PI = 3.14159265358979323846, RATED = 12.1; /* rpm */
static const double HEIGHT = 87.6, OVERHANG = 5, HUB_RADIUS = 1.5, LENGTH = 61.5, TILT = 0.0873;
/* Across the blades at full load: lift and thrust [N/m], where the distribution is 1. */
static const double LIFT = 5800, DRIVE = 620;

/* The blade, at fractions of its length: mass [kg/m], stiffness in tension [N], in torsion, against
 * edgewise and flap bending [N m^2], twist [deg], chord [m], distribution of lift. */
enum { PLACE, MASS, TENSION, TORSION, EDGE, FLAP, TWIST, CHORD, SHARE, COLUMNS };
static const double BLADE[STATIONS][COLUMNS] = {
    {0.00, 680, 9.7e9, 5.6e9, 1.8e10, 1.8e10, 13.3, 3.5, 0.00},
    {0.10, 425, 5.0e9, 1.9e9, 9.2e9, 6.4e9, 13.3, 4.0, 0.10},
    {0.20, 400, 4.0e9, 5.4e8, 7.0e9, 3.3e9, 12.8, 4.6, 0.40},
    {0.30, 340, 2.6e9, 2.6e8, 4.5e9, 2.0e9, 10.2, 4.4, 0.55},
    {0.45, 290, 1.5e9, 1.3e8, 3.2e9, 9.4e8, 7.5, 3.8, 0.75},
    {0.60, 215, 7.2e8, 4.2e7, 1.7e9, 2.9e8, 4.8, 3.2, 0.90},
    {0.75, 140, 3.8e8, 1.6e7, 8.1e8, 9.2e7, 2.5, 2.8, 1.00},
    {0.90, 80, 1.5e8, 6.0e6, 3.5e8, 3.4e7, 0.7, 2.2, 0.90},
    {1.00, 20, 2.0e7, 1.0e6, 3.0e7, 2.0e6, 0.0, 1.4, 0.30},
};

/* A column of that table, linear between stations. */
static double blade_value(double fraction, int column)
{
    int i = 0;
    while (i + 2 < STATIONS && fraction > BLADE[i + 1][PLACE]) {
        ++i;
    }
    const double *a = BLADE[i], *b = BLADE[i + 1];
    return a[column] + (b[column] - a[column]) * (fraction - a[PLACE]) / (b[PLACE] - a[PLACE]);
}

typedef struct turbine {
    pdn_model *model;
    int32_t hub, tower_top, bearing, roots[BLADES], gauge; /* of the tip of blade 1 in the hub */
    double centre[3], axis[3];                             /* of the rotor */
    pdn_beam blades[BLADES];
} turbine;

/* A beam on a straight line, its sections at fractions of the length. */
static int add_beam(turbine *e, const double *start, const double *end, const double *axis_2,
                    const double *fractions, const pdn_section *sections, const double *twists,
                    size_t count, size_t elements, size_t order, pdn_beam *beam)
{
    pdn_line line;
    pdn_stations stations;
    PDN_INIT(pdn_line, &line);
    PDN_INIT(pdn_stations, &stations);
    stations.count = count;
    stations.fractions = fractions;
    stations.sections = sections;
    stations.twists = twists;
    TRY(pdn_line_set_straight(&line, start, end, axis_2));
    TRY(pdn_model_add_beam(e->model, &line, &stations, elements, order, beam));
    return 0;
done:
    return 1;
}

/* The tower, a steel tube on the ground. */
static int add_tower(turbine *e)
{
    const double foot[3] = {0, 0, 0}, top[3] = {0, 0, HEIGHT}, wind[3] = {1, 0, 0};
    const double young = 210e9, shear = 80.8e9, density = 8500; /* with bolts, welds and paint */
    pdn_section sections[TOWER_STATIONS];
    double fractions[TOWER_STATIONS];
    pdn_beam tower;
    int32_t clamp;
    for (int i = 0; i < TOWER_STATIONS; ++i) {
        const double x = fractions[i] = (double)i / (TOWER_STATIONS - 1);
        const double radius = 3 - 1.065 * x, thick = 0.035 - 0.010 * x;
        const double A = 2 * PI * radius * thick, I = PI * pow(radius, 3) * thick;
        const double stiffness[6] = {young * A,     shear * A / 2, shear * A / 2,
                                     shear * 2 * I, young * I,     young * I};
        const double mass[4] = {density * A, density * 2 * I, density * I, density * I};
        PDN_INIT(pdn_section, &sections[i]);
        TRY(pdn_section_set_diagonal(&sections[i], stiffness, mass));
        TRY(pdn_section_set_proportional_damping(&sections[i], 0.01)); /* 1 % in the first mode */
    }
    if (add_beam(e, foot, top, wind, fractions, sections, NULL, TOWER_STATIONS, 4, 3, &tower) !=
        0) {
        goto done;
    }
    TRY(pdn_model_add_rigid_joint(e->model, PDN_GROUND, tower.first, foot, &clamp));
    e->tower_top = tower.last;
    return 0;
done:
    return 1;
}

/* Nacelle and hub, which turns by `speed`. */
static int add_head(turbine *e, double speed)
{
    const double top[3] = {0, 0, HEIGHT}, nacelle_centre[3] = {1.9, 0, HEIGHT + 1.75};
    const double nacelle_inertia[9] = {8e5, 0, 0, 0, 2.6e6, 0, 0, 0, 2.6e6};
    double hub_inertia[9]; /* 1.16e5 about the shaft, 1e5 across it */
    for (int k = 0; k < 9; ++k) {
        hub_inertia[k] = (k % 4 == 0 ? 1e5 : 0) + 0.16e5 * e->axis[k % 3] * e->axis[k / 3];
    }
    int32_t nacelle, yaw;
    pdn_signal turn;
    PDN_INIT(pdn_signal, &turn);
    TRY(pdn_signal_set_harmonics(&turn, 0, speed, NULL, NULL, 0));
    TRY(pdn_model_add_rigid_body(e->model, 240e3, nacelle_centre, nacelle_inertia, &nacelle));
    TRY(pdn_model_add_rigid_body(e->model, 57e3, e->centre, hub_inertia, &e->hub));
    TRY(pdn_model_add_rigid_joint(e->model, e->tower_top, nacelle, top, &yaw));
    TRY(pdn_model_add_revolute(e->model, nacelle, e->hub, e->centre, e->axis, &e->bearing));
    TRY(pdn_model_prescribe(e->model, e->bearing, PDN_ROTATION, &turn, NULL));
    return 0;
done:
    return 1;
}

/* What is left of the lift of a blade at an azimuth: it grows upwards, and dips before the tower.
 */
static double wind_at(double azimuth)
{
    const double before_tower = fabs(remainder(azimuth - PI, 2 * PI)), wide = PI / 9;
    const double shadow = before_tower < wide ? 0.5 * (1 + cos(PI * before_tower / wide)) : 0;
    return 1 + 0.12 * cos(azimuth) - 0.25 * shadow;
}

/* Lift and thrust on blade i, by samples over a turn, and dampers in its nodes between it and air.
 */
static int add_airloads(turbine *e, int i, double speed)
{
    const pdn_beam *blade = &e->blades[i];
    const double part = speed / (RATED * PI / 30);
    const double loads[2] = {part * part * LIFT, -part * part * DRIVE};
    double fractions[STATIONS], shares[STATIONS], samples[SAMPLES];
    pdn_signal signal;
    PDN_INIT(pdn_signal, &signal);
    for (int k = 0; k < STATIONS; ++k) {
        fractions[k] = BLADE[k][PLACE];
        shares[k] = BLADE[k][SHARE];
    }
    for (int k = 0; k < 2; ++k) {
        for (int n = 0; n < SAMPLES; ++n) {
            samples[n] = loads[k] * wind_at(2 * PI * ((double)n / SAMPLES + (double)i / BLADES));
        }
        TRY(pdn_signal_set_samples(&signal, 0, samples, SAMPLES));
        TRY(pdn_model_add_distributed_load(e->model, blade->first_element, blade->elements,
                                           PDN_FRAME_MATERIAL, PDN_FORCE_2 + k, &signal, fractions,
                                           shares, STATIONS, NULL));
    }
    for (int32_t node = blade->first; node <= blade->last; ++node) {
        pdn_frame frames[3]; /* of the node before, this one, and the next */
        double radius[3], matrix[36] = {0};
        for (int k = 0; k < 3; ++k) {
            int32_t at = node - 1 + k;
            at = at < blade->first ? blade->first : at > blade->last ? blade->last : at;
            TRY(pdn_model_node_frame(e->model, at, &frames[k]));
            const double *x = frames[k].position, *o = e->centre;
            radius[k] = sqrt(pow(x[0] - o[0], 2) + pow(x[1] - o[1], 2) + pow(x[2] - o[2], 2));
        }
        const double chord = blade_value((radius[1] - HUB_RADIUS) / LENGTH, CHORD);
        const double c = 1.225 * PI * chord * speed * radius[1] * (radius[2] - radius[0]) / 2;
        const double straight[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
        memcpy(frames[1].rotation, straight, sizeof straight);
        for (int k = 0; k < 9; ++k) {
            matrix[k % 3 + 6 * (k / 3)] = c * e->axis[k % 3] * e->axis[k / 3];
        }
        TRY(pdn_model_add_viscous_damper(e->model, PDN_GROUND, node, &frames[1], matrix, NULL));
    }
    return 0;
done:
    return 1;
}

/* Blade i; axis 2 of its line is downwind, before twist turns it. */
static int add_blade(turbine *e, int i, size_t elements, size_t order)
{
    const double azimuth = 2 * PI * i / BLADES, s = sin(azimuth), c = cos(azimuth);
    /* up in the plane of rotation, and the direction that the top moves to */
    const double up[3] = {sin(TILT), 0, cos(TILT)}, ahead[3] = {0, -1, 0};
    double root[3], tip[3], fractions[STATIONS], twists[STATIONS];
    pdn_section sections[STATIONS];
    for (int k = 0; k < 3; ++k) {
        root[k] = e->centre[k] + HUB_RADIUS * (c * up[k] + s * ahead[k]);
        tip[k] = e->centre[k] + (HUB_RADIUS + LENGTH) * (c * up[k] + s * ahead[k]);
    }
    for (int k = 0; k < STATIONS; ++k) {
        const double *b = BLADE[k], edge = b[MASS] * b[CHORD] * b[CHORD] / 16, flap = edge / 20;
        const double stiffness[6] = {b[TENSION], b[TENSION] / 10, b[TENSION] / 10,
                                     b[TORSION], b[EDGE],         b[FLAP]};
        const double mass[4] = {b[MASS], edge + flap, edge, flap};
        fractions[k] = b[PLACE];
        twists[k] = -b[TWIST] * PI / 180;
        PDN_INIT(pdn_section, &sections[k]);
        TRY(pdn_section_set_diagonal(&sections[k], stiffness, mass));
        TRY(pdn_section_set_proportional_damping(&sections[k], 2e-3));
    }
    if (add_beam(e, root, tip, e->axis, fractions, sections, twists, STATIONS, elements, order,
                 &e->blades[i]) != 0) {
        goto done;
    }
    TRY(pdn_model_add_rigid_joint(e->model, e->hub, e->blades[i].first, root, &e->roots[i]));
    return 0;
done:
    return 1;
}

/* Says that the blades are alike. */
static int set_symmetry(turbine *e)
{
    int32_t nodes[MOST_NODES];
    size_t count = 0;
    for (int i = 0; i < BLADES; ++i) {
        for (int32_t node = e->blades[i].first; node <= e->blades[i].last; ++node) {
            if (count == MOST_NODES) {
                fprintf(stderr, "no more than %d nodes of blades\n", MOST_NODES);
                goto done;
            }
            nodes[count++] = node;
        }
    }
    TRY(pdn_model_set_rotor_symmetry(e->model, e->axis, BLADES, nodes, count, &e->hub, 1,
                                     e->centre));
    return 0;
done:
    return 1;
}

static int build(turbine *e, double speed, size_t elements, size_t order)
{
    const double gravity[3] = {0, 0, -9.81}, s = sin(TILT), c = cos(TILT);
    const double centre[3] = {-OVERHANG, 0, HEIGHT + 2.4}, axis[3] = {c, 0, -s};
    memcpy(e->centre, centre, sizeof centre);
    memcpy(e->axis, axis, sizeof axis);
    TRY(pdn_model_new(&e->model));
    TRY(pdn_model_set_gravity(e->model, gravity));
    if (add_tower(e) != 0 || add_head(e, speed) != 0) {
        goto done;
    }
    for (int i = 0; i < BLADES; ++i) {
        if (add_blade(e, i, elements, order) != 0 || add_airloads(e, i, speed) != 0) {
            goto done;
        }
    }
    /* Holds nothing: where the tip of blade 1 is, downwind and back in the plane of rotation. */
    const double far = HUB_RADIUS + LENGTH;
    const pdn_frame tip = {{centre[0] + far * s, 0, centre[2] + far * c},
                           {c, 0, -s, 0, 1, 0, s, 0, c}};
    TRY(pdn_model_add_joint(e->model, PDN_JOINT_FREE, e->hub, e->blades[0].last, &tip, &tip,
                            &e->gauge));
    return 0;
done:
    return 1;
}

/* Curves over TIMES times of a turn. */
enum { TIP, BACK, TOP, FLAP_MOMENT, EDGE_MOMENT, TORQUE, CURVES };
static const char *const TITLE[CURVES] = {"tip of blade 1 downwind [m]",
                                          "tip of blade 1 back in its plane [m]",
                                          "tower top downwind [m]",
                                          "flap moment at the root [N m]",
                                          "edgewise moment at the root [N m]",
                                          "torque of the rotor [N m]"};
typedef struct response {
    double t[TIMES], curve[CURVES][TIMES];
} response;

static int sample(const turbine *e, const pdn_solution *solution, double period, response *out)
{
    static double root[TIMES][6], top[TIMES][3];
    for (int i = 0; i < TIMES; ++i) {
        out->t[i] = period * i / (TIMES - 1);
    }
    TRY(pdn_solution_sample(solution,
                            PDN_QUANTITY(PDN_JOINT_COORDINATE, e->gauge, PDN_DISPLACEMENT), out->t,
                            TIMES, out->curve[TIP]));
    TRY(pdn_solution_sample(solution,
                            PDN_QUANTITY(PDN_JOINT_COORDINATE, e->gauge, PDN_DISPLACEMENT_2),
                            out->t, TIMES, out->curve[BACK]));
    TRY(pdn_solution_sample(solution,
                            PDN_QUANTITY(PDN_NODE_POSITION, e->tower_top, PDN_ALL_COMPONENTS),
                            out->t, TIMES, top[0]));
    pdn_quantity at_root = pdn_quantity_of(PDN_JOINT_REACTION, e->roots[0], PDN_ALL_COMPONENTS);
    at_root.frame = PDN_FRAME_FIRST;
    TRY(pdn_solution_sample(solution, &at_root, out->t, TIMES, root[0]));
    TRY(pdn_solution_sample(solution,
                            PDN_QUANTITY(PDN_JOINT_DRIVING_EFFORT, e->bearing, PDN_ROTATION),
                            out->t, TIMES, out->curve[TORQUE]));
    for (int i = 0; i < TIMES; ++i) {
        out->curve[TOP][i] = top[i][0];
        out->curve[FLAP_MOMENT][i] = -root[i][4];
        out->curve[EDGE_MOMENT][i] = -(root[i][3] * e->axis[0] + root[i][5] * e->axis[2]);
        out->curve[TORQUE][i] = -out->curve[TORQUE][i]; /* on what holds the speed */
    }
    return 0;
done:
    return 1;
}

/* Mean of a curve for h = 0, else the amplitude of h per turn. */
static double amplitude(const double *y, int h)
{
    const int count = TIMES - 1; /* the last time repeats the first */
    double cosine = 0, sine = 0;
    for (int i = 0; i < count; ++i) {
        cosine += y[i] * cos(2 * PI * h * i / count) / count;
        sine += y[i] * sin(2 * PI * h * i / count) / count;
    }
    return h == 0 ? cosine : 2 * hypot(cosine, sine);
}

static int print_line(const pdn_solution *solution, int rpm, const response *r)
{
    pdn_diagnostics figures;
    PDN_INIT(pdn_diagnostics, &figures);
    TRY(pdn_solution_diagnostics(solution, &figures));
    printf("%4d %4d %4d %8.1e %9.3f %7.3f %9.4f %8.5f %10.0f %7.0f %10.0f\n", rpm,
           (int)figures.grid_points, (int)figures.iterations, figures.error_estimate,
           amplitude(r->curve[TIP], 0), amplitude(r->curve[TIP], 1), amplitude(r->curve[TOP], 0),
           amplitude(r->curve[TOP], PER_TURN), amplitude(r->curve[FLAP_MOMENT], 0) / 1000,
           amplitude(r->curve[FLAP_MOMENT], 1) / 1000, amplitude(r->curve[TORQUE], 0) / 1000);
    return 0;
done:
    return 1;
}

int main(int argc, char **argv)
{
    check_options(argc, argv,
                  "--grid --tolerance --elements --order --whole --march --out --animation");
    const size_t elements = option_count(argc, argv, "--elements", 8);
    const size_t order = option_count(argc, argv, "--order", 3);
    const int whole = option_number(argc, argv, "--whole", 0) != 0;
    const size_t steps = (size_t)option_number(argc, argv, "--march", 0);
    const char *animation = option_text(argc, argv, "--animation", NULL);
    FILE *file = open_out(argc, argv);
    const int rpm[SPEEDS] = {8, 10, 12};
    int failed = 1;
    turbine turbines[SPEEDS];
    pdn_solution *solutions[SPEEDS] = {NULL};
    static response r;
    memset(turbines, 0, sizeof turbines);

    pdn_periodic_options options;
    PDN_INIT(pdn_periodic_options, &options);
    options.grid_points = option_count(argc, argv, "--grid", 0); /* 0: as many as needed */
    options.error_tolerance = option_number(argc, argv, "--tolerance", options.error_tolerance);
    printf("Means, and amplitudes of 1 or 3 per turn\n rpm    N  it.    error   tip [m]       1   "
           "top [m]        3  flap [kN m]     1  torque [kN m]\n");
    for (int i = 0; i < SPEEDS; ++i) {
        const double speed = rpm[i] * PI / 30, period = 2 * PI / speed;
        if (build(&turbines[i], speed, elements, order) != 0 ||
            (!whole && set_symmetry(&turbines[i]) != 0)) {
            goto done;
        }
        options.initial = i > 0 ? solutions[i - 1] : NULL;
        TRY(pdn_solve_periodic(turbines[i].model, period, &options, &solutions[i]));
        if (pdn_solution_outcome(solutions[i]) != PDN_CONVERGED) {
            char report[4096];
            pdn_solution_report(solutions[i], report, sizeof report);
            fputs(report, stdout);
            goto done;
        }
        if (sample(&turbines[i], solutions[i], period, &r) != 0 ||
            print_line(solutions[i], rpm[i], &r) != 0) {
            goto done;
        }
    }
    const turbine *last = &turbines[SPEEDS - 1];
    const pdn_solution *solution = solutions[SPEEDS - 1];
    if (steps &&
        check_by_march(last->model, solution, last->blades[0].last, r.t[TIMES - 1], steps) != 0) {
        goto done;
    }
    if (file) {
        fputs("time [s]", file);
        for (int c = 0; c < CURVES; ++c) {
            fprintf(file, ",%s", TITLE[c]);
        }
        for (int i = 0; i < TIMES; ++i) {
            fprintf(file, "\n%.17g", r.t[i]);
            for (int c = 0; c < CURVES; ++c) {
                fprintf(file, ",%.17g", r.curve[c][i]);
            }
        }
        fputs("\n", file);
    }
    if (animation) {
        double t[121];
        for (int i = 0; i < 121; ++i) {
            t[i] = r.t[TIMES - 1] * i / 120;
        }
        TRY(pdn_solution_write_vtk(solution, t, 121, 6, animation));
    }
    failed = 0;

done:
    if (file && fclose(file) != 0) {
        perror("--out");
        failed = 1;
    }
    for (int i = 0; i < SPEEDS; ++i) {
        pdn_solution_free(solutions[i]);
        pdn_model_free(turbines[i].model);
    }
    return failed;
}
