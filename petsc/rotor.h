/* The rotor of rotor_on_ranks.c and costs.c. */
#ifndef PERIODYN_PETSC_ROTOR_H
#define PERIODYN_PETSC_ROTOR_H

#include <math.h>
#include <mpi.h>
#include <periodyn.h>
#include <stdio.h>

/* Ends all ranks with the library's message if a call fails. */
#define TRY(call)                                                                                  \
    do {                                                                                           \
        if ((call) != PDN_OK) {                                                                    \
            char text[500];                                                                        \
            pdn_last_error(text, sizeof text);                                                     \
            fprintf(stderr, "%s: %s\n", #call, text);                                              \
            MPI_Abort(MPI_COMM_WORLD, 1);                                                        \
        }                                                                                          \
    } while (0)

static const double PI = 3.14159265358979323846;

/* Three damped blades of 10 m in gravity, with so many elements of degree 3 each. */
static pdn_model *make_rotor(size_t elements, int32_t *tip_node)
{
    const double centre[3] = {0, 0, 0}, shaft[3] = {1, 0, 0}, gravity[3] = {0, 0, -9.81};
    const double pitch = 8 * PI / 180;
    const double stiffness[6] = {500e6, 100e6, 100e6, 500e3, 3.87e6, 1.30e6};
    const double mass[4] = {20.0, 0.20, 0.15, 0.05};
    const double cosines[2] = {1000, 0}, sines[2] = {0, 200};
    pdn_model *model;
    pdn_section profile;
    pdn_signal lift, turn;
    pdn_beam blade;
    int32_t hub, clamp, bearing;
    PDN_INIT(pdn_section, &profile);
    PDN_INIT(pdn_signal, &lift);
    PDN_INIT(pdn_signal, &turn);
    TRY(pdn_section_set_diagonal(&profile, stiffness, mass));
    for (int i = 3; i < 6; ++i) {
        profile.damping[7 * i] = 0.01 * stiffness[i];
    }
    TRY(pdn_signal_set_harmonics(&lift, 3000, 0, cosines, sines, 2));
    TRY(pdn_signal_set_harmonics(&turn, 0, 2 * PI, NULL, NULL, 0));
    TRY(pdn_model_new(&model));
    TRY(pdn_model_add_node(model, centre, NULL, &hub));
    for (int b = 0; b < 3; ++b) {
        const double angle = 2 * PI * b / 3, y = -sin(angle), z = cos(angle);
        const double root[3] = {0, 0.5 * y, 0.5 * z}, tip[3] = {0, 10.5 * y, 10.5 * z};
        const double flap[3] = {cos(pitch), sin(pitch) * z, -sin(pitch) * y};
        TRY(pdn_model_add_straight_beam(model, root, tip, flap, &profile, elements, 3, &blade));
        TRY(pdn_model_add_rigid_joint(model, hub, blade.first, root, &clamp));
        TRY(pdn_model_add_load(model, blade.last, PDN_FRAME_SPACE, PDN_FORCE_1, &lift, NULL));
    }
    TRY(pdn_model_add_revolute(model, PDN_GROUND, hub, centre, shaft, &bearing));
    TRY(pdn_model_set_gravity(model, gravity));
    TRY(pdn_model_prescribe(model, bearing, PDN_ROTATION, &turn, NULL));
    *tip_node = blade.last;
    return model;
}

#endif
