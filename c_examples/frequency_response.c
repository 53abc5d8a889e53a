/* The frequency response of a beam clamped at both ends: it stretches where it bends, so that it
 * gets stiffer, and its resonance leans over.
 *
 * A steel strip of 0.5 m x 20 mm x 2 mm is pushed sideways at its middle by a harmonic force.
 * Between two folds there are three responses at one frequency, of which the middle one is not
 * stable: with rising frequency the strip falls off the upper fold, with falling frequency it jumps
 * up from the lower one. Metres, newtons, kilograms, seconds.
 *
 *   frequency_response [--force F] [--elements E] [--grid N] [--out FILE]
 *
 * FILE gets a line for each point of the branch; `script/plot.py FILE IMAGE` draws it. */

#include "example.h"

int main(int argc, char **argv)
{
    check_options(argc, argv, "--force --elements --grid --out");
    const double size = option_number(argc, argv, "--force", 0.08);
    const size_t elements = option_count(argc, argv, "--elements", 4); /* even */
    const size_t grid = option_count(argc, argv, "--grid", 15);
    const char *out = option_text(argc, argv, "--out", NULL);

    int failed = 1;
    pdn_model *model = NULL;
    pdn_branch *branch = NULL;
    const double left[3] = {0, 0, 0}, right[3] = {0.5, 0, 0}, i2[3] = {0, 1, 0};
    const double young = 2.1e11, shear = 8.1e10, density = 7850, width = 0.02, height = 0.002;
    const double area = width * height, thin = width * height * height * height / 12;
    const double wide = height * width * width * width / 12;
    const double stiffness[6] = {young * area,     shear * area * 5 / 6, shear * area * 5 / 6,
                                 4 * shear * thin, young * wide,         young * thin};
    const double mass[4] = {density * area, density * (thin + wide), density * wide,
                            density * thin};
    const double none[1] = {0};
    const double first_mode = 22.3733 * sqrt(young * thin / (density * area * pow(0.5, 4)));

    int32_t clamp;
    pdn_section strip;
    pdn_beam beam;
    pdn_signal push;
    PDN_INIT(pdn_section, &strip);
    PDN_INIT(pdn_signal, &push);
    TRY(pdn_model_new(&model));
    TRY(pdn_section_set_diagonal(&strip, stiffness, mass));
    /* A damping ratio of 0.5 % at the first mode. */
    TRY(pdn_section_set_proportional_damping(&strip, 2 * 0.005 / first_mode));
    TRY(pdn_model_add_straight_beam(model, left, right, i2, &strip, elements, 3, &beam));
    TRY(pdn_model_add_rigid_joint(model, PDN_GROUND, beam.first, left, &clamp));
    TRY(pdn_model_add_rigid_joint(model, PDN_GROUND, beam.last, right, &clamp));
    TRY(pdn_signal_set_harmonics(&push, 0, 0, &size, none, 1));
    const int32_t middle = (beam.first + beam.last) / 2;
    TRY(pdn_model_add_load(model, middle, PDN_FRAME_SPACE, PDN_FORCE_2, &push, NULL));

    pdn_periodic_options periodic;
    pdn_branch_options options;
    PDN_INIT(pdn_periodic_options, &periodic);
    PDN_INIT(pdn_branch_options, &options);
    periodic.grid_points = grid;
    options.periodic = &periodic;
    /* Motions of some millimetres count as much as the range of frequencies. */
    options.motion_scale = 0.01;
    TRY(pdn_solve_frequency_response(model, 0.9 * first_mode, 1.25 * first_mode, &options,
                                     &branch));
    char report[2048];
    pdn_branch_report(branch, report, sizeof report);
    printf("%s", report);

    int32_t count;
    TRY(pdn_branch_count(branch, &count));
    for (int32_t i = 0; i < count; ++i) {
        pdn_branch_point point;
        PDN_INIT(pdn_branch_point, &point);
        TRY(pdn_branch_get(branch, i, &point));
        if (point.event == PDN_EVENT_FOLD) {
            printf("Fold at %.6f of the first natural frequency of small motions\n",
                   point.parameter / first_mode);
        }
    }
    if (out) {
        TRY(pdn_branch_write_csv(branch, PDN_QUANTITY(PDN_NODE_POSITION, middle, 1), 1, out));
    }
    failed = pdn_branch_end(branch) != PDN_BRANCH_RANGE;
done:
    pdn_branch_free(branch);
    pdn_model_free(model);
    return failed;
}
