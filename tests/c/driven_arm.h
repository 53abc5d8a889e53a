/* A driven arm with a spring at its hinge, and beside it a clamped beam. */
#ifndef PDN_TEST_DRIVEN_ARM_H
#define PDN_TEST_DRIVEN_ARM_H

#include "check.h"

typedef struct driven_arm {
    int32_t body, hinge, spring;
    pdn_beam beam;
} driven_arm;

static pdn_model *make_driven_arm(size_t elements, size_t order, driven_arm *out)
{
    const double centre[3] = {0.5, 0, 0}, inertia[9] = {0.1, 0, 0, 0, 0.1, 0, 0, 0, 0.1};
    const double origin[3] = {0, 0, 0}, z[3] = {0, 0, 1}, y[3] = {0, 1, 0};
    const double start[3] = {3, 0, 0}, end[3] = {5, 0, 0};
    const double stiffness[6] = {1e6, 5e5, 5e5, 1e3, 2e3, 2e3}, mass[4] = {0.5, 1e-3, 1e-3, 1e-3};
    const double cosines[1] = {0}, sines[1] = {0.3};
    pdn_model *model = NULL;
    pdn_section section;
    pdn_signal swing;
    int32_t clamp;
    CHECK_STATUS(pdn_model_new(&model), PDN_OK);
    CHECK_STATUS(pdn_model_add_rigid_body(model, 2.0, centre, inertia, &out->body), PDN_OK);
    CHECK_STATUS(pdn_model_add_revolute(model, PDN_GROUND, out->body, origin, z, &out->hinge),
                 PDN_OK);
    PDN_INIT(pdn_signal, &swing);
    CHECK_STATUS(pdn_signal_set_harmonics(&swing, 0, 0, cosines, sines, 1), PDN_OK);
    CHECK_STATUS(pdn_model_prescribe(model, out->hinge, PDN_ROTATION, &swing, NULL), PDN_OK);
    CHECK_STATUS(
        pdn_model_add_spring_damper(model, out->hinge, PDN_ROTATION, 7.0, 0.2, 0.0, &out->spring),
        PDN_OK);
    PDN_INIT(pdn_section, &section);
    CHECK_STATUS(pdn_section_set_diagonal(&section, stiffness, mass), PDN_OK);
    CHECK_STATUS(
        pdn_model_add_straight_beam(model, start, end, y, &section, elements, order, &out->beam),
        PDN_OK);
    CHECK_STATUS(pdn_model_add_rigid_joint(model, PDN_GROUND, out->beam.first, start, &clamp),
                 PDN_OK);
    return model;
}

#endif
