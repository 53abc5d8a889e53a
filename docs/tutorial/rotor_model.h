#include "try.h"
#include <math.h>

/* Metres, kilograms, seconds. The shaft is along x, as is the wind; blades of 10 m reach from the
 * hub, the first one upwards at first. WIND is that at the rotor, which slows it down. */
static const double PI = 3.14159265358979323846;
static const double RADIUS = 10, HUB = 1, CHORD = 0.6, WIND = 6, SHEAR = 0.02;
static const double HALF_DENSITY = 0.6, LIFT_SLOPE = 5.7, DRAG = 0.01;

enum { BLADES = 3, NODES = 7 };

typedef struct rotor {
    pdn_model *model;
    double period;
    int32_t shaft, pitches[BLADES];
    pdn_beam blades[BLADES];
    double widths[NODES]; /* of the pieces of a blade, which its nodes stand for */
} rotor;

/* Lift across and drag along the air that meets a piece of a blade. Axis 2 of its node points to
 * the leading edge, axis 3 downwind. */
static int32_t airload(const pdn_force_state *state, pdn_force_values *values, void *width)
{
    const double *axes = state->rotations, *velocity = state->velocities;
    const double wind = WIND * (1 + SHEAR * state->positions[2]);
    const double along = wind * axes[3] - velocity[1], across = wind * axes[6] - velocity[2];
    const double factor = HALF_DENSITY * CHORD * *(const double *)width;
    const double speed = hypot(along, across);
    values->forces[1] = factor * (LIFT_SLOPE * across * across + DRAG * speed * along);
    values->forces[2] = factor * (-LIFT_SLOPE * across * along + DRAG * speed * across);
    return 0;
}

static void build_rotor(rotor *r, double speed, double pitch)
{
    const double origin[3] = {0, 0, 0}, x[3] = {1, 0, 0}, gravity[3] = {0, 0, -9.81};
    const double inertia[9] = {100, 0, 0, 0, 60, 0, 0, 0, 60};
    const double stiffness[6] = {4e8, 1e8, 1e8, 6e5, 6e6, 1e6}, mass[4] = {16, 0.5, 0.05, 0.45};
    pdn_signal turning, pitching;
    pdn_section section;
    int32_t hub, bearing;
    PDN_INIT(pdn_signal, &turning);
    PDN_INIT(pdn_signal, &pitching);
    PDN_INIT(pdn_section, &section);
    TRY(pdn_signal_set_harmonics(&turning, 0, speed, NULL, NULL, 0));
    TRY(pdn_signal_set_constant(&pitching, pitch));
    TRY(pdn_section_set_diagonal(&section, stiffness, mass));
    TRY(pdn_section_set_proportional_damping(&section, 2e-3));

    r->model = NULL;
    r->period = 2 * PI / speed;
    TRY(pdn_model_new(&r->model));
    TRY(pdn_model_set_gravity(r->model, gravity));
    TRY(pdn_model_add_rigid_body(r->model, 200, origin, inertia, &hub));
    TRY(pdn_model_add_revolute(r->model, PDN_GROUND, hub, origin, x, &r->shaft));
    TRY(pdn_model_prescribe(r->model, r->shaft, PDN_ROTATION, &turning, NULL));
    for (int b = 0; b < BLADES; ++b) {
        const double azimuth = 2 * PI * b / BLADES, s = sin(azimuth), c = cos(azimuth);
        const double root[3] = {0, -HUB * s, HUB * c}, tip[3] = {0, -RADIUS * s, RADIUS * c};
        const double forward[3] = {0, -c, -s}, inwards[3] = {0, s, -c};
        pdn_beam *blade = &r->blades[b];
        TRY(pdn_model_add_straight_beam(r->model, root, tip, forward, &section, 2, 3, blade));
        TRY(pdn_model_add_revolute(r->model, hub, blade->first, root, inwards, &bearing));
        TRY(pdn_model_prescribe(r->model, bearing, PDN_ROTATION, &pitching, &r->pitches[b]));
        for (int32_t node = blade->first; node <= blade->last; ++node) {
            pdn_frame before, after;
            TRY(pdn_model_node_frame(r->model, node - (node > blade->first), &before));
            TRY(pdn_model_node_frame(r->model, node + (node < blade->last), &after));
            const double *p = before.position, *q = after.position;
            double *width = &r->widths[node - blade->first];
            *width = hypot(q[1] - p[1], q[2] - p[2]) / 2;
            TRY(pdn_model_add_user_force(r->model, &node, 1, PDN_FRAME_MATERIAL,
                                         PDN_TANGENTS_DIFFERENCED, airload, width, NULL, NULL));
        }
    }
}
