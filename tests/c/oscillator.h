/* A mass that slides along z on a spring and a damper, with a harmonic force on it. */
#ifndef PDN_TEST_OSCILLATOR_H
#define PDN_TEST_OSCILLATOR_H

#include "check.h"

static const double PI = 3.14159265358979323846;
static const double MASS = 2.0, STIFFNESS = 50.0, DAMPING = 1.2, FORCE = 3.0, OMEGA = 3.0;

static pdn_model *oscillator(int32_t *body, int32_t *slide)
{
    const double origin[3] = {0, 0, 0}, axis[3] = {0, 0, 1}, sines[1] = {0};
    const double inertia[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    pdn_model *model = NULL;
    pdn_signal force;
    PDN_INIT(pdn_signal, &force);
    CHECK_STATUS(pdn_signal_set_harmonics(&force, 0, 0, &FORCE, sines, 1), PDN_OK);
    CHECK_STATUS(pdn_model_new(&model), PDN_OK);
    CHECK_STATUS(pdn_model_add_rigid_body(model, MASS, origin, inertia, body), PDN_OK);
    CHECK_STATUS(pdn_model_add_prismatic(model, PDN_GROUND, *body, origin, axis, slide), PDN_OK);
    CHECK_STATUS(
        pdn_model_add_spring_damper(model, *slide, PDN_DISPLACEMENT, STIFFNESS, DAMPING, 0, NULL),
        PDN_OK);
    CHECK_STATUS(pdn_model_add_load(model, *body, PDN_FRAME_SPACE, PDN_FORCE_3, &force, NULL),
                 PDN_OK);
    return model;
}

#endif
