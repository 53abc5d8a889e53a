/* The backbone of a beam: its free motions, from the linear mode to large ones.
 *
 * A flat strip is clamped at one end, or at both. What it does by itself, without load and damping,
 * are families of periodic motions, one from each linear mode, whose frequency changes with the
 * amplitude. At the frequency of the linear mode itself only the strip at rest is found, or any
 * amplitude that is small: so the first motion is given its amplitude, and the frequency is
 * unknown. From there on the family is a branch over the frequency. A damping in proportion to mass
 * is unknown all along: it is found to be zero, to rounding, as energy is conserved. Metres,
 * newtons, kilograms, seconds.
 *
 *   backbone [--clamps 1 OR 2] [--elements COUNT] [--degree P] [--harmonics H] [--amplitude A]
 *            [--to FACTOR] [--out FILE]
 *
 * It begins where the tip, or the middle of two clamps, moves by A, and ends at FACTOR times the
 * frequency of the first mode. FILE gets a line for each point; `script/plot.py FILE IMAGE` draws
 * it. */

#include <time.h>

#include "example.h"

static const double PI = 3.14159265358979323846;

/* A steel strip of 1 m, 20 mm wide and 2 mm thick, with a damping of zero that is a parameter, and
 * the node that moves most in the first mode; NULL if it cannot be built. */
static pdn_model *strip(size_t elements, size_t degree, int both, int32_t *damping, int32_t *node)
{
    const double left[3] = {0, 0, 0}, right[3] = {1, 0, 0}, i2[3] = {0, 1, 0};
    const double young = 2.1e11, shear = 8.1e10, density = 7850, width = 0.02, height = 0.002;
    const double area = width * height, thin = width * height * height * height / 12;
    const double wide = height * width * width * width / 12;
    const double stiffness[6] = {young * area,     shear * area * 5 / 6, shear * area * 5 / 6,
                                 4 * shear * thin, young * wide,         young * thin};
    const double mass[4] = {density * area, density * (thin + wide), density * wide,
                            density * thin};
    pdn_model *model = NULL;
    pdn_section section;
    pdn_beam beam;
    int32_t clamp;
    PDN_INIT(pdn_section, &section);
    TRY(pdn_model_new(&model));
    TRY(pdn_section_set_diagonal(&section, stiffness, mass));
    TRY(pdn_model_add_straight_beam(model, left, right, i2, &section, elements, (int32_t)degree,
                                    &beam));
    TRY(pdn_model_add_rigid_joint(model, PDN_GROUND, beam.first, left, &clamp));
    if (both) {
        TRY(pdn_model_add_rigid_joint(model, PDN_GROUND, beam.last, right, &clamp));
    }
    *node = both ? (beam.first + beam.last) / 2 : beam.last;
    TRY(pdn_model_add_parameter(model, "damping", 0, 1, damping));
    TRY(pdn_model_move_number(model, *damping, PDN_NUMBER_MASS_DAMPING, 0, 0, 1));
    return model;

done:
    pdn_model_free(model);
    return NULL;
}

/* Conditions of a free motion: the phase, and the amplitude of a quantity where the frequency is
 * unknown, too. */
static pdn_status free_motion(int32_t damping, const pdn_quantity *moves, double amplitude,
                              pdn_conditions **out)
{
    pdn_status status = pdn_conditions_new(out);
    status = status ? status : pdn_conditions_release(*out, damping);
    status = status ? status : pdn_conditions_add_phase(*out);
    if (amplitude > 0) {
        status = status ? status : pdn_conditions_release(*out, PDN_FREQUENCY);
        status = status ? status
                        : pdn_conditions_add_quantity(*out, moves, PDN_FEATURE_COSINE, 1, amplitude,
                                                      amplitude);
    }
    return status;
}

/* Prints how far frequencies, damping and the angle between points go, and the time for a point. */
static pdn_status print_branch(const pdn_branch *branch, double linear, double seconds)
{
    int32_t count;
    double largest_angle = 0, largest_damping = 0;
    pdn_branch_point point;
    pdn_status status = pdn_branch_count(branch, &count);
    PDN_INIT(pdn_branch_point, &point);
    for (int32_t i = 0; status == PDN_OK && i < count; ++i) {
        pdn_solution *solution;
        double damping = 0;
        status = pdn_branch_get(branch, i, &point);
        status = status ? status : pdn_branch_solution(branch, i, &solution);
        if (status == PDN_OK) {
            status = pdn_solution_parameter(solution, PDN_FIRST_PARAMETER, &damping);
            pdn_solution_free(solution);
        }
        largest_angle = point.angle > largest_angle ? point.angle : largest_angle;
        largest_damping = fabs(damping) > largest_damping ? fabs(damping) : largest_damping;
    }
    printf("Linear frequency %.6f rad/s, at the last point %.6f of it\n", linear,
           2 * PI / point.period / linear);
    printf("%d points, largest angle between them %.3f rad, largest damping found %.1e 1/s\n",
           (int)count, largest_angle, largest_damping);
    printf("%.1f ms of processor a point\n", 1e3 * seconds / count);
    return status;
}

int main(int argc, char **argv)
{
    check_options(argc, argv, "--clamps --elements --degree --harmonics --amplitude --to --out");
    const int both = option_count(argc, argv, "--clamps", 1) == 2;
    const size_t elements = option_count(argc, argv, "--elements", 40);
    const size_t degree = option_count(argc, argv, "--degree", 1);
    const size_t harmonics = option_count(argc, argv, "--harmonics", 8);
    const double amplitude = option_number(argc, argv, "--amplitude", both ? 5e-4 : 0.05);
    const double factor = option_number(argc, argv, "--to", both ? 1.5 : 1.05);
    const char *out = option_text(argc, argv, "--out", NULL);

    int failed = 1;
    int32_t damping, node;
    pdn_model *model = strip(elements, degree, both, &damping, &node);
    pdn_modes *modes = NULL;
    pdn_solution *linear = NULL, *first = NULL;
    pdn_conditions *given = NULL, *along = NULL;
    pdn_branch *branch = NULL;
    if (!model) {
        goto done;
    }
    const pdn_quantity moves = pdn_quantity_of(PDN_NODE_POSITION, node, 1);

    /* The linear mode, as large as is wanted. */
    double shape[6], start;
    pdn_mode mode;
    PDN_INIT(pdn_mode, &mode);
    pdn_modes_options few;
    PDN_INIT(pdn_modes_options, &few);
    few.count = 1;
    TRY(pdn_solve_modes(model, &few, &modes));
    TRY(pdn_modes_shape(modes, 0, &node, 1, shape, NULL));
    TRY(pdn_modes_motion(modes, 0, amplitude / shape[1], &linear));
    TRY(pdn_modes_get(modes, 0, &mode));
    const double frequency = mode.eigenvalue_imaginary;

    /* The motion with this amplitude, whatever its frequency is. */
    pdn_periodic_options periodic;
    PDN_INIT(pdn_periodic_options, &periodic);
    periodic.grid_points = 2 * harmonics + 1;
    periodic.initial = linear;
    TRY(free_motion(damping, &moves, amplitude, &given));
    TRY(pdn_solve_conditioned(model, 2 * PI / frequency, given, &periodic, &first));
    if (pdn_solution_outcome(first) != PDN_CONVERGED) {
        char report[2048];
        pdn_solution_report(first, report, sizeof report);
        fputs(report, stderr);
        goto done;
    }

    /* And on, along the frequency. */
    pdn_branch_options options;
    PDN_INIT(pdn_branch_options, &options);
    TRY(free_motion(damping, &moves, 0, &along));
    TRY(pdn_solution_parameter(first, PDN_FREQUENCY, &start));
    periodic.initial = first;
    options.periodic = &periodic;
    options.conditions = along;
    options.from = start;
    options.to = factor * frequency;
    options.motion_scale = both ? 0.01 : 0.5;
    const clock_t before = clock();
    TRY(pdn_follow_branch(model, 2 * PI / start, PDN_FREQUENCY, &options, &branch));
    const double seconds = (double)(clock() - before) / CLOCKS_PER_SEC;
    char report[2048];
    pdn_branch_report(branch, report, sizeof report);
    printf("%s", report);
    TRY(print_branch(branch, frequency, seconds));
    if (out) {
        TRY(pdn_branch_write_csv(branch, &moves, 1, out));
    }
    failed = pdn_branch_end(branch) == PDN_BRANCH_NO_START;

done:
    pdn_branch_free(branch);
    pdn_conditions_free(along);
    pdn_conditions_free(given);
    pdn_solution_free(first);
    pdn_solution_free(linear);
    pdn_modes_free(modes);
    pdn_model_free(model);
    return failed;
}
