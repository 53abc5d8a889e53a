/* The same rotor blade as a shell and as a beam: frequencies in rotation, and its flapping under a
 * lift that changes once a turn, as in forward flight.
 *
 * A flat plate of aluminium, clamped to a hub that turns about axis 3; flapping is along axis 3.
 * The clamp holds the shell's chord from curving and from warping, which beams know nothing of:
 * bending becomes a little stiffer, torsion more. Metres, newtons, kilograms, seconds.
 *
 *   shell_blade [--elements E] [--out FILE]
 *
 * FILE gets times and the flapping of both tips over a turn. */

#include "example.h"

enum { DEGREE = 4, MODES = 6, HARMONICS = 3, TIMES = 181 };

static const double PI = 3.14159265358979323846;
static const double root = 0.2, length = 2, chord = 0.2, thickness = 0.012;  /* m */
static const double young = 7e10, poisson = 0.3, density = 2700, speed = 30; /* the last: rad/s */
static const double lift[2] = {60, 40}; /* N/m along the span: mean and once a turn */

/* A blade on its hub; nodes at the tip. */
typedef struct blade {
    pdn_model *model;
    int32_t hub, tip;
} blade;

static int add_hub(blade *b)
{
    const double centre[3] = {0, 0, 0}, inertia[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    return pdn_model_new(&b->model) == PDN_OK &&
           pdn_model_add_rigid_body(b->model, 10, centre, inertia, &b->hub) == PDN_OK;
}

static int build_shell(size_t elements, const pdn_signal *along_span, blade *b)
{
    int built = 0;
    const double corner[3] = {root, -chord / 2, 0}, origin[3] = {0, 0, 0};
    const double span[3] = {length, 0, 0}, across[3] = {0, chord, 0};
    pdn_shell_section plate;
    PDN_INIT(pdn_shell_section, &plate);
    TRY(pdn_shell_section_set_isotropic(&plate, thickness, young, poisson, density, 1, 0.1));
    TRY(pdn_shell_section_set_proportional_damping(&plate, 2e-4));
    pdn_surface surface;
    PDN_INIT(pdn_surface, &surface);
    TRY(pdn_surface_set_parallelogram(&surface, corner, span, across));

    pdn_shell shell;
    int32_t node, weld;
    TRY(pdn_model_add_shell(b->model, &surface, elements, 1, DEGREE, DEGREE, 0, &plate, NULL,
                            &shell));
    for (int32_t v = 0; v < shell.nodes_v; ++v) {
        TRY(pdn_model_shell_patch_node(b->model, &shell, 0, v, &node));
        TRY(pdn_model_add_rigid_joint(b->model, b->hub, node, origin, &weld));
    }
    pdn_signal over_area = *along_span;
    double cosine = along_span->cosines[0] / chord;
    const double zero = 0;
    TRY(pdn_signal_set_harmonics(&over_area, along_span->mean / chord, 0, &cosine, &zero, 1));
    TRY(pdn_model_add_shell_load(b->model, shell.first_element, (int32_t)elements,
                                 PDN_SHELL_SURFACE, PDN_FRAME_MATERIAL, PDN_FORCE_3, &over_area,
                                 NULL));
    TRY(pdn_model_shell_patch_node(b->model, &shell, shell.nodes_u - 1, DEGREE / 2, &b->tip));
    built = 1;
done:
    return built;
}

static int build_beam(size_t elements, const pdn_signal *along_span, blade *b)
{
    int built = 0;
    const double start[3] = {root, 0, 0}, end[3] = {root + length, 0, 0}, axis_2[3] = {0, 1, 0};
    const double area = chord * thickness, shear = young / 2 / (1 + poisson);
    const double flap = chord * pow(thickness, 3) / 12, lag = thickness * pow(chord, 3) / 12;
    const double torsion = 4 * flap * (1 - 0.63 * thickness / chord); /* Saint-Venant */
    const double stiffness[6] = {young * area,    shear * area * 5 / 6, shear * area * 5 / 6,
                                 shear * torsion, young * flap,         young * lag};
    const double mass[4] = {density * area, density * (flap + lag), density * flap, density * lag};
    pdn_section section;
    PDN_INIT(pdn_section, &section);
    TRY(pdn_section_set_diagonal(&section, stiffness, mass));
    TRY(pdn_section_set_proportional_damping(&section, 2e-4));

    pdn_beam beam;
    int32_t weld;
    TRY(pdn_model_add_straight_beam(b->model, start, end, axis_2, &section, elements, DEGREE,
                                    &beam));
    TRY(pdn_model_add_rigid_joint(b->model, b->hub, beam.first, start, &weld));
    TRY(pdn_model_add_distributed_load(b->model, beam.first_element, (int32_t)elements,
                                       PDN_FRAME_MATERIAL, PDN_FORCE_3, along_span, NULL, NULL, 0,
                                       NULL));
    b->tip = beam.last;
    built = 1;
done:
    return built;
}

/* Frequencies of the blade in steady rotation, and its motion over a turn. */
static int solve(blade *b, double frequencies[MODES], pdn_solution **solution)
{
    int solved = 0;
    const double origin[3] = {0, 0, 0}, axis[3] = {0, 0, 1};
    pdn_modes *modes = NULL;
    pdn_model *held = NULL;
    int32_t joint;

    /* In its own frame the hub stands still. */
    TRY(pdn_model_copy(b->model, &held));
    TRY(pdn_model_add_rigid_joint(held, PDN_GROUND, b->hub, origin, &joint));
    pdn_static_options steady;
    PDN_INIT(pdn_static_options, &steady);
    steady.angular_velocity[2] = speed;
    pdn_modes_options wanted;
    PDN_INIT(pdn_modes_options, &wanted);
    wanted.equilibrium = &steady;
    wanted.count = MODES;
    TRY(pdn_solve_modes(held, &wanted, &modes));
    for (int32_t i = 0; i < MODES; ++i) {
        pdn_mode mode;
        PDN_INIT(pdn_mode, &mode);
        TRY(pdn_modes_get(modes, i, &mode));
        frequencies[i] = mode.frequency;
    }

    pdn_signal turns;
    PDN_INIT(pdn_signal, &turns);
    TRY(pdn_signal_set_harmonics(&turns, 0, speed, NULL, NULL, 0));
    TRY(pdn_model_add_revolute(b->model, PDN_GROUND, b->hub, origin, axis, &joint));
    TRY(pdn_model_prescribe(b->model, joint, PDN_ROTATION, &turns, NULL));
    TRY(pdn_solve_periodic(b->model, 2 * PI / speed, NULL, solution));
    char report[4096];
    pdn_solution_report(*solution, report, sizeof report);
    fputs(report, stdout);
    solved = pdn_solution_outcome(*solution) == PDN_CONVERGED;
done:
    pdn_modes_free(modes);
    pdn_model_free(held);
    return solved;
}

int main(int argc, char **argv)
{
    check_options(argc, argv, "--elements --out");
    const size_t elements = option_count(argc, argv, "--elements", 4);
    FILE *file = open_out(argc, argv);
    int failed = 1;
    blade blades[2] = {{0}, {0}};
    pdn_solution *solutions[2] = {NULL, NULL};

    const double zero = 0;
    pdn_signal along_span;
    PDN_INIT(pdn_signal, &along_span);
    TRY(pdn_signal_set_harmonics(&along_span, lift[0], 0, &lift[1], &zero, 1));
    double frequencies[2][MODES], mean[2][3], cosines[2][HARMONICS][3], sines[2][HARMONICS][3];
    for (int k = 0; k < 2; ++k) {
        puts(k == 0 ? "Shell" : "\nBeam");
        if (!add_hub(&blades[k]) ||
            !(k == 0 ? build_shell : build_beam)(elements, &along_span, &blades[k]) ||
            !solve(&blades[k], frequencies[k], &solutions[k])) {
            goto done;
        }
        TRY(pdn_solution_harmonics(
            solutions[k], PDN_QUANTITY(PDN_NODE_POSITION, blades[k].tip, PDN_ALL_COMPONENTS),
            HARMONICS, mean[k], NULL, cosines[k][0], sines[k][0]));
    }

    puts("\nFrequencies in Hz at 30 rad/s\n mode      shell       beam  difference");
    for (int i = 0; i < MODES; ++i) {
        printf("%5d %10.4f %10.4f %10.2f %%\n", i + 1, frequencies[0][i], frequencies[1][i],
               100 * (frequencies[0][i] / frequencies[1][i] - 1));
    }
    puts("\nFlapping of the tip, amplitudes in mm\nharmonic      shell       beam");
    printf("%8d %10.3f %10.3f\n", 0, 1e3 * mean[0][2], 1e3 * mean[1][2]);
    for (int h = 0; h < HARMONICS; ++h) {
        printf("%8d %10.3f %10.3f\n", h + 1, 1e3 * hypot(cosines[0][h][2], sines[0][h][2]),
               1e3 * hypot(cosines[1][h][2], sines[1][h][2]));
    }
    if (file) {
        fputs("time [s],shell [m],beam [m],difference [m]\n", file);
        for (int i = 0; i < TIMES; ++i) {
            const double time = 2 * PI / speed * i / (TIMES - 1);
            double positions[2][3];
            for (int k = 0; k < 2; ++k) {
                TRY(pdn_solution_sample(
                    solutions[k],
                    PDN_QUANTITY(PDN_NODE_POSITION, blades[k].tip, PDN_ALL_COMPONENTS), &time, 1,
                    positions[k]));
            }
            fprintf(file, "%.17g,%.17g,%.17g,%.17g\n", time, positions[0][2], positions[1][2],
                    positions[0][2] - positions[1][2]);
        }
    }
    failed = 0;

done:
    if (file && fclose(file) != 0) {
        perror("--out");
        failed = 1;
    }
    for (int k = 0; k < 2; ++k) {
        pdn_solution_free(solutions[k]);
        pdn_model_free(blades[k].model);
    }
    return failed;
}
