/* Mechanisms whose periodic motions are looked for. */
#ifndef PDN_TEST_MECHANISMS_H
#define PDN_TEST_MECHANISMS_H

#include "check.h"

#include <math.h>

static const double PI = 3.14159265358979323846;
#define GOOD(call) CHECK_STATUS(call, PDN_OK)

/* A model, and what is looked at: a node, and the effort on a joint's coordinate. */
struct test_model {
    pdn_model *model;
    double period;
    size_t points;
    int32_t node, joint;
};

static inline void turn(struct test_model *out, double rate)
{
    pdn_signal signal;
    PDN_INIT(pdn_signal, &signal);
    GOOD(pdn_signal_set_harmonics(&signal, 0, rate, NULL, NULL, 0));
    GOOD(pdn_model_prescribe(out->model, out->joint, PDN_ROTATION, &signal, NULL));
}

/* The planar four-bar mechanism of c_examples/planar_four_bar.c. */
static inline struct test_model four_bar(void)
{
    struct test_model out = {.period = 2 * PI / 0.6, .points = 21};
    const double A[3] = {0, 0, 0}, B[3] = {0, 0.12, 0}, C[3] = {0.24, 0.12, 0}, D[3] = {0.24, 0, 0};
    const double i2[3] = {0, 1, 0}, i3[3] = {0, 0, 1}, back[3] = {-1, 0, 0};
    const double crooked = 5 * PI / 180, axis_C[3] = {sin(crooked), 0, cos(crooked)};
    const double stiff[6] = {52.99e6, 16.88e6, 16.88e6, 733.5, 1131, 1131};
    const double soft[6] = {13.25e6, 4.220e6, 4.220e6, 45.84, 70.66, 70.66};
    const double heavy[4] = {1.997, 85.20e-6, 42.60e-6, 42.60e-6};
    const double light[4] = {0.4992, 5.324e-6, 2.662e-6, 2.662e-6};
    pdn_section thick, thin;
    pdn_beam crank, coupler, rocker;
    int32_t hinge;
    PDN_INIT(pdn_section, &thick);
    PDN_INIT(pdn_section, &thin);
    GOOD(pdn_section_set_diagonal(&thick, stiff, heavy));
    GOOD(pdn_section_set_diagonal(&thin, soft, light));
    GOOD(pdn_model_new(&out.model));
    GOOD(pdn_model_add_straight_beam(out.model, A, B, back, &thick, 5, 2, &crank));
    GOOD(pdn_model_add_straight_beam(out.model, B, C, i2, &thick, 5, 2, &coupler));
    GOOD(pdn_model_add_straight_beam(out.model, C, D, back, &thin, 5, 2, &rocker));
    GOOD(pdn_model_add_revolute(out.model, PDN_GROUND, crank.first, A, i3, &out.joint));
    GOOD(pdn_model_add_revolute(out.model, crank.last, coupler.first, B, i3, &hinge));
    GOOD(pdn_model_add_revolute(out.model, coupler.last, rocker.first, C, axis_C, &hinge));
    GOOD(pdn_model_add_revolute(out.model, PDN_GROUND, rocker.last, D, i3, &hinge));
    turn(&out, -0.6);
    out.node = coupler.last;
    return out;
}

/* Three damped blades like that of c_examples/rotor_blade.c, in gravity, with so many elements each
 * of degree 3. */
static inline struct test_model rotor(size_t elements, size_t points)
{
    struct test_model out = {.period = 1, .points = points};
    const double centre[3] = {0, 0, 0}, shaft[3] = {1, 0, 0}, gravity[3] = {0, 0, -9.81};
    const double pitch = 8 * PI / 180;
    const double stiffness[6] = {500e6, 100e6, 100e6, 500e3, 3.87e6, 1.30e6};
    const double mass[4] = {20.0, 0.20, 0.15, 0.05};
    const double cosines[2] = {1000, 0}, sines[2] = {0, 200};
    pdn_section profile;
    pdn_signal lift;
    pdn_beam blade;
    int32_t hub, clamp;
    PDN_INIT(pdn_section, &profile);
    GOOD(pdn_section_set_diagonal(&profile, stiffness, mass));
    for (int i = 3; i < 6; ++i) {
        profile.damping[7 * i] = 0.01 * stiffness[i];
    }
    PDN_INIT(pdn_signal, &lift);
    GOOD(pdn_signal_set_harmonics(&lift, 3000, 0, cosines, sines, 2));
    GOOD(pdn_model_new(&out.model));
    GOOD(pdn_model_add_node(out.model, centre, NULL, &hub));
    for (int b = 0; b < 3; ++b) {
        const double angle = 2 * PI * b / 3, y = -sin(angle), z = cos(angle);
        const double root[3] = {0, 0.5 * y, 0.5 * z}, tip[3] = {0, 10.5 * y, 10.5 * z};
        const double flap[3] = {cos(pitch), sin(pitch) * z, -sin(pitch) * y};
        GOOD(
            pdn_model_add_straight_beam(out.model, root, tip, flap, &profile, elements, 3, &blade));
        GOOD(pdn_model_add_rigid_joint(out.model, hub, blade.first, root, &clamp));
        GOOD(pdn_model_add_load(out.model, blade.last, PDN_FRAME_SPACE, PDN_FORCE_1, &lift, NULL));
    }
    GOOD(pdn_model_add_revolute(out.model, PDN_GROUND, hub, centre, shaft, &out.joint));
    GOOD(pdn_model_set_gravity(out.model, gravity));
    turn(&out, 2 * PI);
    out.node = blade.last;
    return out;
}

/* The slider-crank of c_examples/slider_crank.c, some of whose constraints depend on others. */
static inline struct test_model slider_crank(void)
{
    struct test_model out = {.period = 2 * PI / 120, .points = 21};
    const double shaft[3] = {0, 0, 0}, pin[3] = {0.15, 0, 0}, wrist[3] = {0.45, 0, 0};
    const double i1[3] = {1, 0, 0}, i2[3] = {0, 1, 0}, i3[3] = {0, 0, 1};
    const double crank_inertia[9] = {1e-3, 0, 0, 0, 1e-3, 0, 0, 0, 1e-3};
    const double slider_inertia[9] = {1e-5, 0, 0, 0, 1e-5, 0, 0, 0, 1e-5};
    const double stiffness[6] = {5.85e6, 1.95e6, 1.95e6, 10.1, 13.2, 13.2};
    const double mass[4] = {0.222, 1.0e-6, 0.5e-6, 0.5e-6};
    int32_t crank, slider, joint;
    pdn_section steel;
    pdn_beam rod;
    GOOD(pdn_model_new(&out.model));
    GOOD(pdn_model_add_rigid_body(out.model, 0.5, shaft, crank_inertia, &crank));
    GOOD(pdn_model_add_rigid_body(out.model, 0.04, wrist, slider_inertia, &slider));
    PDN_INIT(pdn_section, &steel);
    GOOD(pdn_section_set_diagonal(&steel, stiffness, mass));
    GOOD(pdn_section_set_proportional_damping(&steel, 1e-4));
    GOOD(pdn_model_add_straight_beam(out.model, pin, wrist, i2, &steel, 4, 3, &rod));
    GOOD(pdn_model_add_revolute(out.model, PDN_GROUND, crank, shaft, i3, &out.joint));
    GOOD(pdn_model_add_revolute(out.model, crank, rod.first, pin, i3, &joint));
    GOOD(pdn_model_add_revolute(out.model, rod.last, slider, wrist, i3, &joint));
    GOOD(pdn_model_add_prismatic(out.model, PDN_GROUND, slider, wrist, i1, &joint));
    turn(&out, 120);
    out.node = slider;
    return out;
}

#endif
