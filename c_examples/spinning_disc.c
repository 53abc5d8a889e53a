/* A thin steel disc that spins past a stationary transverse load, as a saw blade or a storage disc.
 *
 * It is clamped to a hub at its inner radius. Its frequencies grow with speed, as it is stretched;
 * where n times the speed comes near one of n nodal diameters, the wave that travels backwards
 * stands still beside the load. Metres, newtons, kilograms, seconds.
 *
 *   spinning_disc [--sectors S] [--out FILE]
 *
 * FILE gets the deflection of the rim around the circle, as an observer beside the load sees it. */

#include "example.h"

enum { DIAMETERS = 4, MODES = 14, POWER = 6, SPEEDS = 2, DEGREE = 4, MOST = 50 * DEGREE };

static const double PI = 3.14159265358979323846;
static const double inner = 0.04, outer = 0.2, thickness = 1.5e-3;           /* m */
static const double young = 2.1e11, poisson = 0.3, density = 7850, load = 1; /* the last: N */

/* A disc, its hub, and the nodes around its rim. */
typedef struct disc {
    pdn_model *model;
    int32_t hub, rim[MOST], count;
    double angle[MOST]; /* of the nodes of the rim */
} disc;

static int build(size_t sectors, disc *d)
{
    int built = 0;
    const double centre[3] = {0, 0, 0}, axis[3] = {0, 0, 1}, start[3] = {1, 0, 0};
    const double inertia[9] = {1e-4, 0, 0, 0, 1e-4, 0, 0, 0, 1e-4};
    pdn_shell_section steel;
    PDN_INIT(pdn_shell_section, &steel);
    TRY(pdn_shell_section_set_isotropic(&steel, thickness, young, poisson, density, 1, 0.1));
    TRY(pdn_shell_section_set_proportional_damping(&steel, 2e-5));
    pdn_surface annulus;
    PDN_INIT(pdn_surface, &annulus);
    TRY(pdn_surface_set_annulus(&annulus, centre, axis, start, inner, outer, 2 * PI));

    pdn_shell shell;
    int32_t node, weld;
    TRY(pdn_model_new(&d->model));
    TRY(pdn_model_add_shell(d->model, &annulus, 1, sectors, DEGREE, DEGREE, 1, &steel, NULL,
                            &shell));
    TRY(pdn_model_add_rigid_body(d->model, 0.1, centre, inertia, &d->hub));
    d->count = shell.nodes_v - 1; /* the last one closes the circle */
    for (int32_t v = 0; v < d->count && v < MOST; ++v) {
        TRY(pdn_model_shell_patch_node(d->model, &shell, 0, v, &node));
        TRY(pdn_model_add_rigid_joint(d->model, d->hub, node, centre, &weld));
        TRY(pdn_model_shell_patch_node(d->model, &shell, shell.nodes_u - 1, v, &d->rim[v]));
        pdn_frame frame;
        TRY(pdn_model_node_frame(d->model, d->rim[v], &frame));
        d->angle[v] = atan2(frame.position[1], frame.position[0]);
    }
    built = 1;
done:
    return built;
}

/* Of a motion of the rim along the axis: how many nodal diameters it has. */
static int diameters_of(const disc *d, double (*shape)[6])
{
    int found = 0;
    double most = 0;
    for (int n = 0; n <= 2 * DIAMETERS; ++n) {
        double cosine = 0, sine = 0;
        for (int32_t k = 0; k < d->count; ++k) {
            cosine += shape[k][2] * cos(n * d->angle[k]);
            sine += shape[k][2] * sin(n * d->angle[k]);
        }
        if (hypot(cosine, sine) > most) {
            most = hypot(cosine, sine);
            found = n;
        }
    }
    return found;
}

/* The lowest frequencies of the disc that spins, as it feels them, by nodal diameters. */
static int frequencies(disc *d, double speed, double lowest[DIAMETERS + 1])
{
    int solved = 0;
    pdn_modes *modes = NULL;
    pdn_static_options steady;
    PDN_INIT(pdn_static_options, &steady);
    steady.angular_velocity[2] = speed;
    pdn_modes_options options;
    PDN_INIT(pdn_modes_options, &options);
    options.equilibrium = &steady;
    options.count = MODES;
    TRY(pdn_solve_modes(d->model, &options, &modes));
    int32_t count, complete;
    TRY(pdn_modes_count(modes, &count, &complete));
    memset(lowest, 0, (DIAMETERS + 1) * sizeof *lowest);
    for (int32_t i = 0; i < count; ++i) {
        double shape[MOST][6], out_of_phase[MOST][6];
        pdn_mode mode;
        PDN_INIT(pdn_mode, &mode);
        TRY(pdn_modes_get(modes, i, &mode));
        TRY(pdn_modes_shape(modes, i, d->rim, (size_t)d->count, shape[0], out_of_phase[0]));
        const int n = diameters_of(d, shape);
        if (n <= DIAMETERS && lowest[n] == 0) {
            lowest[n] = mode.frequency;
        }
    }
    solved = 1;
done:
    pdn_modes_free(modes);
    return solved;
}

/* The load at an angle before a node, ((1 + cos) / 2)^POWER of the angle, moves past the node: in
 * its time it has harmonics, which are binomials. */
static int add_stationary_load(disc *d)
{
    int added = 0;
    /* Parts of a sector's edge that its nodes stand for: Lobatto's rule. */
    static const double parts[DEGREE] = {1.0 / 10, 49.0 / 180, 16.0 / 45, 49.0 / 180};
    for (int32_t k = 0; k < d->count; ++k) {
        const double whole = load * parts[k % DEGREE] * DEGREE / d->count;
        double cosines[POWER], sines[POWER], binomial = 1;
        for (int j = 0; j < POWER; ++j) { /* of 2 POWER over POWER + j + 1, relative to the mean */
            binomial *= (double)(POWER - j) / (POWER + j + 1);
            cosines[j] = 2 * whole * binomial * cos((j + 1) * d->angle[k]);
            sines[j] = -2 * whole * binomial * sin((j + 1) * d->angle[k]);
        }
        pdn_signal past;
        PDN_INIT(pdn_signal, &past);
        TRY(pdn_signal_set_harmonics(&past, whole, 0, cosines, sines, POWER));
        TRY(pdn_model_add_load(d->model, d->rim[k], PDN_FRAME_SPACE, PDN_FORCE_3, &past, NULL));
    }
    added = 1;
done:
    return added;
}

int main(int argc, char **argv)
{
    check_options(argc, argv, "--sectors --out");
    const size_t sectors = option_count(argc, argv, "--sectors", 6);
    FILE *file = open_out(argc, argv);
    int failed = 1;
    disc fixed = {0}, spun[SPEEDS] = {{0}};
    pdn_solution *solutions[SPEEDS] = {NULL};
    if (sectors * DEGREE > MOST || sectors < 5) {
        fprintf(stderr, "--sectors: expected 5 to %d\n", MOST / DEGREE);
        return 2;
    }

    /* Frequencies: the disc in its own frame, in which the hub stands still. */
    const double origin[3] = {0, 0, 0}, axis[3] = {0, 0, 1};
    int32_t held, hinge;
    if (!build(sectors, &fixed)) {
        goto done;
    }
    TRY(pdn_model_add_rigid_joint(fixed.model, PDN_GROUND, fixed.hub, origin, &held));
    double at_rest[DIAMETERS + 1], spinning[DIAMETERS + 1];
    const double speeds[] = {0, 1200, 2000, 4000}; /* rpm */
    puts("Frequencies in Hz by nodal diameters, as the disc feels them; in brackets Southwell's\n"
         "sum: of those at rest, and those of a membrane (Lamb and Southwell, without a clamp)\n"
         "      rpm                0                 1                 2                 3"
         "                 4");
    for (int s = 0; s < 4; ++s) {
        const double speed = speeds[s] * PI / 30;
        if (!frequencies(&fixed, speed, s == 0 ? at_rest : spinning)) {
            goto done;
        }
        printf("%9.0f", speeds[s]);
        for (int n = 0; n <= DIAMETERS; ++n) {
            const double stretched = (n * (n + 2) * (3 + poisson) - n * n * (1 + 3 * poisson)) / 8;
            const double bound =
                sqrt(at_rest[n] * at_rest[n] + stretched * speed * speed / (4 * PI * PI));
            printf(" %8.2f (%6.2f)", (s == 0 ? at_rest : spinning)[n], bound);
        }
        puts("");
    }

    /* The motion under the load: to a point of the disc the load passes once a turn. */
    pdn_signal turns;
    PDN_INIT(pdn_signal, &turns);
    pdn_periodic_options options; /* deflections are small: as many points as harmonics need */
    PDN_INIT(pdn_periodic_options, &options);
    options.grid_points = 2 * POWER + 3;
    const double rpm[SPEEDS] = {1200, 2000};
    puts("\nRim, seen beside the load, in micrometres: mean, and waves that stand still there\n"
         "      rpm     mean        1        2        3        4   seen at all nodes alike to");
    for (int s = 0; s < SPEEDS; ++s) {
        const double speed = rpm[s] * PI / 30;
        if (!build(sectors, &spun[s]) || !add_stationary_load(&spun[s])) {
            goto done;
        }
        pdn_model *model = spun[s].model;
        TRY(pdn_model_add_revolute(model, PDN_GROUND, spun[s].hub, origin, axis, &hinge));
        TRY(pdn_signal_set_harmonics(&turns, 0, speed, NULL, NULL, 0));
        TRY(pdn_model_prescribe(model, hinge, PDN_ROTATION, &turns, NULL));
        TRY(pdn_solve_periodic(model, 2 * PI / speed, &options, &solutions[s]));
        if (pdn_solution_outcome(solutions[s]) != PDN_CONVERGED) {
            char report[4096];
            pdn_solution_report(solutions[s], report, sizeof report);
            fputs(report, stderr);
            goto done;
        }
        double mean[3], cosines[DIAMETERS][3], sines[DIAMETERS][3], first[DIAMETERS], apart = 0;
        double amplitudes[DIAMETERS];
        for (int32_t k = 0; k < spun[s].count; ++k) {
            TRY(pdn_solution_harmonics(
                solutions[s], PDN_QUANTITY(PDN_NODE_POSITION, spun[s].rim[k], PDN_ALL_COMPONENTS),
                DIAMETERS, mean, NULL, cosines[0], sines[0]));
            for (int n = 0; n < DIAMETERS; ++n) {
                amplitudes[n] = hypot(cosines[n][2], sines[n][2]);
                first[n] = k == 0 ? amplitudes[n] : first[n];
                apart = fmax(apart, fabs(amplitudes[n] - first[n]));
            }
        }
        printf("%9.0f %8.2f", rpm[s], 1e6 * mean[2]);
        for (int n = 0; n < DIAMETERS; ++n) {
            printf(" %8.2f", 1e6 * first[n]);
        }
        printf("   %.1e\n", 1e6 * apart);
    }
    if (file) {
        fputs("angle from the load [deg],at 1200 rpm [m],at 2000 rpm [m]\n", file);
        for (int i = 0; i <= 360; ++i) {
            /* Node 0 passes the load at time 0. */
            fprintf(file, "%d", i);
            for (int s = 0; s < SPEEDS; ++s) {
                const double time = i / 6.0 / rpm[s];
                double position[3];
                TRY(pdn_solution_sample(
                    solutions[s],
                    PDN_QUANTITY(PDN_NODE_POSITION, spun[s].rim[0], PDN_ALL_COMPONENTS), &time, 1,
                    position));
                fprintf(file, ",%.17g", position[2]);
            }
            fputs("\n", file);
        }
    }
    failed = 0;

done:
    if (file && fclose(file) != 0) {
        perror("--out");
        failed = 1;
    }
    for (int s = 0; s < SPEEDS; ++s) {
        pdn_solution_free(solutions[s]);
        pdn_model_free(spun[s].model);
    }
    pdn_model_free(fixed.model);
    return failed;
}
