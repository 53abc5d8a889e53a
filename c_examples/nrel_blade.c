/* The blade of the NREL 5-MW reference turbine by itself, clamped to a hub that stands still or
 * turns at 12.1 rpm: 49 stations with their matrices and damping, as BeamDyn has them.
 *
 * Its modes, beside those of a linear model that has nothing of this library (small displacements
 * about the straight blade, no damping): python/tests/test_nrel_modes.py. The frequency of an
 * eigenvalue s is |s| / 2 pi, that without damping but for terms of second order.
 *
 *   nrel_blade [--elements E] [--order P] */

#include "example.h"
#include "nrel_5mw_blade.h"

enum { STATIONS = NREL_5MW_BLADE_STATIONS, MODES = 6, SPEEDS = 2 };

static const double PI = 3.14159265358979323846;
static const double ROOT[3] = {0, 0, 1.5}, DOWNWIND[3] = {1, 0, 0}; /* axis 3 along the blade */

static const char *const NAMES[MODES] = {"flap",        "edge",       "second flap",
                                         "second edge", "third flap", "torsion"};
static const double RPM[SPEEDS] = {0, 12.1};
static const double LINEAR[SPEEDS][MODES] = {{0.6858, 1.0806, 1.9468, 3.7393, 4.3851, 5.5759},
                                             {0.7366, 1.0887, 2.0055, 3.7607, 4.4409, 5.5789}};

/* The blade from its root on the hub, clamped there. */
static int add_blade(pdn_model *model, size_t elements, size_t order)
{
    const double tip[3] = {0, 0, ROOT[2] + nrel_5mw_blade_positions[STATIONS - 1][2]};
    pdn_section sections[STATIONS];
    pdn_line line;
    pdn_stations stations;
    pdn_beam beam;
    for (int i = 0; i < STATIONS; ++i) {
        PDN_INIT(pdn_section, &sections[i]);
        memcpy(sections[i].stiffness, nrel_5mw_blade_stiffness[i], sizeof sections[i].stiffness);
        memcpy(sections[i].mass, nrel_5mw_blade_mass[i], sizeof sections[i].mass);
        memcpy(sections[i].damping, nrel_5mw_blade_damping[i], sizeof sections[i].damping);
    }
    PDN_INIT(pdn_line, &line);
    PDN_INIT(pdn_stations, &stations);
    stations.count = STATIONS;
    stations.fractions = nrel_5mw_blade_fractions;
    stations.sections = sections;
    stations.twists = nrel_5mw_blade_twists;
    TRY(pdn_line_set_straight(&line, ROOT, tip, DOWNWIND));
    TRY(pdn_model_add_beam(model, &line, &stations, elements, order, &beam));
    TRY(pdn_model_add_rigid_joint(model, PDN_GROUND, beam.first, ROOT, NULL));
    return 0;
done:
    return 1;
}

/* Modes in steady rotation about the wind. */
static int print_modes(const pdn_model *model, double rpm, const double *linear)
{
    int failed = 1;
    pdn_modes *modes = NULL;
    pdn_static_options turning;
    pdn_modes_options options;
    pdn_mode mode;
    PDN_INIT(pdn_static_options, &turning);
    PDN_INIT(pdn_modes_options, &options);
    PDN_INIT(pdn_mode, &mode);
    turning.angular_velocity[0] = rpm * PI / 30;
    options.equilibrium = &turning;
    options.count = MODES;
    TRY(pdn_solve_modes(model, &options, &modes));
    printf("\nAt %.1f rpm     Hz  linear model  damping\n", rpm);
    for (int32_t i = 0; i < MODES; ++i) {
        TRY(pdn_modes_get(modes, i, &mode));
        printf("%-11s %7.4f %13.4f %6.2f %%\n", NAMES[i],
               hypot(mode.eigenvalue_real, mode.eigenvalue_imaginary) / (2 * PI), linear[i],
               100 * mode.damping_ratio);
    }
    failed = 0;
done:
    pdn_modes_free(modes);
    return failed;
}

int main(int argc, char **argv)
{
    check_options(argc, argv, "--elements --order");
    const size_t elements = option_count(argc, argv, "--elements", 16);
    const size_t order = option_count(argc, argv, "--order", 4);
    int failed = 1;
    double mass, centre[3];
    pdn_model *model = NULL;
    TRY(pdn_model_new(&model));
    if (add_blade(model, elements, order) != 0) {
        goto done;
    }
    TRY(pdn_model_mass(model, &mass, centre));
    printf("%.2f kg, centre %.3f m from the root\n", mass, centre[2] - ROOT[2]);
    failed = 0;
    for (int i = 0; i < SPEEDS && !failed; ++i) {
        failed = print_modes(model, RPM[i], LINEAR[i]);
    }
done:
    pdn_model_free(model);
    return failed;
}
