/* A spatial mechanism described with every function of models, sections and signals. */
#include "check.h"
#include <math.h>
#include <stddef.h>

static const double pi = 3.14159265358979323846;

static int near(double a, double b)
{
    return fabs(a - b) <= 1e-12 * (1.0 + fabs(b));
}

static int32_t nodes(const pdn_model *model)
{
    int32_t count = -7;
    CHECK_STATUS(pdn_model_node_count(model, &count), PDN_OK);
    return count;
}

static int32_t joints(const pdn_model *model)
{
    int32_t count = -7;
    CHECK_STATUS(pdn_model_joint_count(model, &count), PDN_OK);
    return count;
}

static int32_t elements(const pdn_model *model)
{
    int32_t count = -7;
    CHECK_STATUS(pdn_model_element_count(model, &count), PDN_OK);
    return count;
}

/* Bars of steel, 16 mm thick. */
static pdn_section bar_section(void)
{
    const double stiffness[6] = {52.99e6, 16.88e6, 16.88e6, 733.5, 1131.0, 1131.0};
    const double mass[4] = {1.997, 85.2e-6, 42.6e-6, 42.6e-6};
    pdn_section section;
    int i;
    PDN_INIT(pdn_section, &section);
    CHECK(section.struct_size == sizeof section);
    CHECK_STATUS(pdn_section_set_diagonal(&section, stiffness, mass), PDN_OK);
    for (i = 0; i < 36; i++) {
        const int row = i % 6;
        const int diagonal = row == i / 6;
        CHECK(section.stiffness[i] == (diagonal ? stiffness[row] : 0.0));
        CHECK(section.mass[i] == (diagonal ? mass[row < 3 ? 0 : row - 2] : 0.0));
        CHECK(section.damping[i] == 0.0);
    }
    CHECK_STATUS(pdn_section_set_proportional_damping(&section, 1e-4), PDN_OK);
    CHECK(near(section.damping[7], 1e-4 * stiffness[1]) && section.damping[1] == 0.0);
    CHECK(section.stiffness[35] == stiffness[5] && section.mass[0] == mass[0]);
    /* Describing it anew takes the damping away. */
    CHECK_STATUS(pdn_section_set_diagonal(&section, stiffness, mass), PDN_OK);
    CHECK(section.damping[7] == 0.0);
    CHECK_STATUS(pdn_section_set_proportional_damping(&section, 1e-4), PDN_OK);
    return section;
}

static int32_t ramp(double time, double *value, void *user_data)
{
    *value = time * *(const double *)user_data;
    return 0;
}

/* A program compiled with a later header initialises and hands in a longer struct. */
static void longer_structs_pass_if_unused(void)
{
    struct {
        pdn_signal known;
        double unknown;
    } later;
    memset(&later, 0xff, sizeof later);
    pdn_signal_init(&later.known, sizeof later);
    CHECK(later.known.struct_size == sizeof later && later.unknown == 0.0);
    CHECK_STATUS(pdn_signal_set_constant(&later.known, 2.0), PDN_OK);
    CHECK(later.known.mean == 2.0 && later.known.struct_size == sizeof later);
    later.unknown = 1.0;
    CHECK_STATUS(pdn_signal_set_constant(&later.known, 3.0), PDN_ERR_STRUCT_SIZE);
    CHECK(later.known.mean == 2.0);
}

static void signals_replace_what_was_set(void)
{
    const double cosines[3] = {1.0, 2.0, 3.0}, sines[3] = {0.0};
    double slope = 2.0;
    pdn_signal signal;
    PDN_INIT(pdn_signal, &signal);
    CHECK(signal.struct_size == sizeof signal && signal.kind == PDN_SIGNAL_HARMONICS);
    CHECK(signal.mean == 0.0 && signal.harmonics == 0);
    CHECK_STATUS(pdn_signal_set_harmonics(&signal, 1.0, 2.0, cosines, sines, 3), PDN_OK);
    CHECK(signal.mean == 1.0 && signal.rate == 2.0 && signal.harmonics == 3);
    CHECK_STATUS(pdn_signal_set_samples(&signal, 4.0, cosines, 3), PDN_OK);
    CHECK(signal.kind == PDN_SIGNAL_SAMPLES && signal.mean == 0.0 && signal.rate == 4.0);
    CHECK(signal.harmonics == 0 && signal.cosines == NULL && signal.samples == cosines);
    CHECK_STATUS(pdn_signal_set_function(&signal, ramp, &slope), PDN_OK);
    CHECK(signal.kind == PDN_SIGNAL_FUNCTION && signal.samples == NULL);
    CHECK(signal.function == ramp && signal.user_data == &slope);
    CHECK_STATUS(pdn_signal_set_constant(&signal, 5.0), PDN_OK);
    CHECK(signal.kind == PDN_SIGNAL_HARMONICS && signal.mean == 5.0);
    CHECK(signal.function == NULL && signal.user_data == NULL);
}

/* Only the direction of an axis counts. */
static void directions_may_have_any_length(void)
{
    const double lengths[3] = {1e-300, 1.0, 1e300};
    const double start[3] = {0, 0, 0}, end[3] = {1, 0, 0};
    const pdn_section section = bar_section();
    pdn_model *model = NULL;
    pdn_beam beam;
    pdn_frame frame;
    int32_t joint, i;
    CHECK_STATUS(pdn_model_new(&model), PDN_OK);
    for (i = 0; i < 3; i++) {
        const double axis[3] = {0, 0, lengths[i]}, across[3] = {0, -lengths[2 - i], 0};
        CHECK_STATUS(pdn_model_add_straight_beam(model, start, end, axis, &section, 1, 2, &beam),
                     PDN_OK);
        CHECK_STATUS(pdn_model_node_frame(model, beam.last, &frame), PDN_OK);
        CHECK(near(frame.rotation[5], 1.0) && near(frame.rotation[7], -1.0));
        CHECK_STATUS(pdn_model_add_revolute(model, PDN_GROUND, beam.first, start, axis, &joint),
                     PDN_OK);
        CHECK_STATUS(
            pdn_model_add_universal(model, beam.last, PDN_GROUND, end, axis, across, &joint),
            PDN_OK);
    }
    pdn_model_free(model);
}

/* Crank, coupler and rocker with a flywheel, a tool and a strut. */
static void spatial_mechanism(void)
{
    const double A[3] = {-0.40, 0, 0}, B[3] = {-0.75, 0, 0.652};
    const double C[3] = {0, 0.85, 0.2}, D[3] = {0, 0.85, 0};
    const double i1[3] = {1, 0, 0}, i2[3] = {0, 2, 0}, arm[3] = {0, 0.18, 0.85};
    const double down[3] = {0, 0, -9.81};
    const double cosines[3] = {-1.0 / 3, 0, -1.0 / 21}, sines[3] = {0, 0.1, 0};
    const double samples[4] = {1, 2, 3, 2};
    const double flywheel_inertia[9] = {0.02, 0, 0, 0, 0.01, 0, 0, 0, 0.01};
    const double flywheel_centre[3] = {0.1, 0.85, 0};
    const double tool_centre[3] = {-0.75, 0.05, 0.7};
    /* Columns are axes: axis 1 along global 2, axis 2 along global 3, axis 3 along global 1. */
    const double turned[9] = {0, 1, 0, 0, 0, 1, 1, 0, 0};
    double slope = 0.0, mass = -1.0, centre[3] = {-1, -1, -1}, matrix[36] = {0};
    double before, moment[3];
    int32_t hinge_A, ball_B, cardan_C, motor_D, wheel_joint, strut_joint, free_joint;
    int32_t flywheel, tool, strut[3], element, i;
    const pdn_section section = bar_section();
    pdn_frame frame, other;
    pdn_beam rocker, coupler, crank;
    pdn_signal signal;
    pdn_model *model = NULL;

    CHECK_STATUS(pdn_model_new(&model), PDN_OK);
    CHECK(model != NULL && nodes(model) == 0 && joints(model) == 0 && elements(model) == 0);

    /* Without mass there is no centre, yet a mass: zero. */
    CHECK_STATUS(pdn_model_mass(model, &mass, NULL), PDN_OK);
    CHECK(mass == 0.0);
    mass = -1.0;
    CHECK_STATUS(pdn_model_mass(model, &mass, centre), PDN_ERR_NOT_AVAILABLE);
    CHECK_MESSAGE("centre: expected a model that has mass");
    CHECK(mass == -1.0 && centre[0] == -1.0);

    /* Masses that are numbers, with a sum that is none. */
    const double far[3] = {0, 0, 0}, none[9] = {0};
    pdn_model *heavy = NULL;
    CHECK_STATUS(pdn_model_new(&heavy), PDN_OK);
    for (int i = 0; i < 2; ++i) {
        int32_t node;
        CHECK_STATUS(pdn_model_add_rigid_body(heavy, 1e308, far, none, &node), PDN_OK);
    }
    CHECK_STATUS(pdn_model_mass(heavy, &mass, NULL), PDN_ERR_OVERFLOW);
    CHECK(mass == -1.0);
    pdn_model_free(heavy);

    CHECK_STATUS(pdn_model_add_straight_beam(model, A, B, i2, &section, 8, 1, &rocker), PDN_OK);
    CHECK(rocker.first == NODE(0) && rocker.last == NODE(8) &&
          rocker.first_element == BEAM_ELEMENT(0));
    CHECK(rocker.elements == 8 && rocker.reserved[0] == 0 && rocker.reserved[3] == 0);
    CHECK_STATUS(pdn_model_add_straight_beam(model, B, C, i1, &section, 3, 3, &coupler), PDN_OK);
    CHECK(coupler.first == NODE(9) && coupler.last == NODE(18) &&
          coupler.first_element == BEAM_ELEMENT(8));
    CHECK_STATUS(pdn_model_add_straight_beam(model, C, D, i1, &section, 1, 6, &crank), PDN_OK);
    CHECK(crank.first == NODE(19) && crank.last == NODE(25) &&
          crank.first_element == BEAM_ELEMENT(11));
    CHECK(nodes(model) == 26 && elements(model) == 12);

    /* Frames: axis 1 along the beam, axis 2 as asked, the last node at the end. */
    CHECK_STATUS(pdn_model_node_frame(model, crank.first, &frame), PDN_OK);
    CHECK(near(frame.position[1], 0.85) && near(frame.position[2], 0.2));
    CHECK(near(frame.rotation[2], -1.0) && near(frame.rotation[3], 1.0));
    CHECK(near(frame.rotation[7], -1.0));
    CHECK_STATUS(pdn_model_node_frame(model, rocker.last, &frame), PDN_OK);
    for (i = 0; i < 3; i++)
        CHECK(near(frame.position[i], B[i]));
    CHECK(near(frame.rotation[4], 1.0));

    /* The mass of bars, and its centre. */
    {
        const double *ends[3][2] = {{A, B}, {B, C}, {C, D}};
        double length, total = 0.0, sum[3] = {0, 0, 0};
        int bar;
        for (bar = 0; bar < 3; bar++) {
            length = 0.0;
            for (i = 0; i < 3; i++)
                length += pow(ends[bar][1][i] - ends[bar][0][i], 2);
            length = sqrt(length);
            total += 1.997 * length;
            for (i = 0; i < 3; i++)
                sum[i] += 1.997 * length * 0.5 * (ends[bar][0][i] + ends[bar][1][i]);
        }
        CHECK_STATUS(pdn_model_mass(model, &mass, centre), PDN_OK);
        CHECK(near(mass, total));
        for (i = 0; i < 3; i++)
            CHECK(near(centre[i], sum[i] / total));
        before = mass;
        for (i = 0; i < 3; i++)
            moment[i] = sum[i];
    }

    /* Joints of each kind. */
    CHECK_STATUS(pdn_model_add_revolute(model, PDN_GROUND, rocker.first, A, i2, &hinge_A), PDN_OK);
    CHECK_STATUS(pdn_model_add_spherical(model, rocker.last, coupler.first, B, &ball_B), PDN_OK);
    CHECK_STATUS(pdn_model_add_universal(model, coupler.last, crank.first, C, arm, i1, &cardan_C),
                 PDN_OK);
    CHECK_STATUS(pdn_model_add_revolute(model, PDN_GROUND, crank.last, D, i1, &motor_D), PDN_OK);
    CHECK(hinge_A == JOINT(0) && ball_B == JOINT(1) && cardan_C == JOINT(2) && motor_D == JOINT(3));

    /* A rigid flywheel on the crank, an eccentric mass and an inertia on the rocker. */
    CHECK_STATUS(pdn_model_add_rigid_body(model, 2.0, flywheel_centre, flywheel_inertia, &flywheel),
                 PDN_OK);
    CHECK(flywheel == NODE(26));
    CHECK_STATUS(pdn_model_add_rigid_joint(model, crank.last, flywheel, D, &wheel_joint), PDN_OK);
    CHECK(wheel_joint == JOINT(4));
    CHECK_STATUS(pdn_model_add_mass(model, rocker.last, 0.5, tool_centre, flywheel_inertia, NULL),
                 PDN_OK);
    CHECK_STATUS(pdn_model_add_mass(model, rocker.last, 0.25, tool_centre, NULL, NULL), PDN_OK);
    CHECK_STATUS(pdn_model_mass(model, &mass, centre), PDN_OK);
    CHECK(near(mass, before + 2.75));
    for (i = 0; i < 3; i++) {
        moment[i] += 2.0 * flywheel_centre[i] + 0.75 * tool_centre[i];
        CHECK(near(centre[i] * mass, moment[i]));
    }
    for (i = 0; i < 3; i++) {
        matrix[7 * i] = 0.125;
        matrix[7 * i + 21] = 0.001;
    }
    frame.position[0] = 1.0;
    frame.position[1] = 2.0;
    frame.position[2] = 3.0;
    memcpy(frame.rotation, turned, sizeof turned);
    CHECK_STATUS(pdn_model_add_inertia(model, flywheel, &frame, matrix, NULL), PDN_OK);
    CHECK_STATUS(pdn_model_add_inertia(model, flywheel, NULL, matrix, NULL), PDN_OK);
    CHECK_STATUS(pdn_model_mass(model, &mass, centre), PDN_OK);
    CHECK(near(mass, before + 3.0));
    for (i = 0; i < 3; i++)
        CHECK(near(centre[i] * mass, moment[i] + 0.125 * (frame.position[i] + flywheel_centre[i])));

    /* A node of its own axes, fixed by a joint whose frames are apart until the solver
     * closes it. */
    CHECK_STATUS(pdn_model_add_node(model, tool_centre, turned, &tool), PDN_OK);
    CHECK(tool == NODE(27));
    CHECK_STATUS(pdn_model_node_frame(model, tool, &other), PDN_OK);
    for (i = 0; i < 9; i++)
        CHECK(near(other.rotation[i], turned[i]) &&
              near(other.position[i % 3], tool_centre[i % 3]));
    frame = other;
    other.position[0] += 0.01;
    CHECK_STATUS(pdn_model_add_joint(model, PDN_JOINT_RIGID, rocker.last, tool, &frame, &other,
                                     &strut_joint),
                 PDN_OK);
    CHECK_STATUS(pdn_model_add_mass(model, tool, 0.1, tool_centre, flywheel_inertia, NULL), PDN_OK);

    /* A curved strut of three nodes, on a joint of each further kind in turn. */
    for (i = 0; i < 3; i++) {
        const double angle = 0.2 * (i - 1);
        const double position[3] = {sin(angle), 0.0, 2.0 - cos(angle)};
        const double axes[9] = {cos(angle), 0.0,         sin(angle), 0.0,       1.0,
                                0.0,        -sin(angle), 0.0,        cos(angle)};
        CHECK_STATUS(pdn_model_add_node(model, position, axes, &strut[i]), PDN_OK);
    }
    CHECK_STATUS(pdn_model_add_beam_element(model, strut, 3, &section, &element), PDN_OK);
    CHECK(element == BEAM_ELEMENT(12) && elements(model) == 13);
    CHECK_STATUS(pdn_model_node_frame(model, strut[0], &frame), PDN_OK);
    CHECK_STATUS(
        pdn_model_add_joint(model, PDN_JOINT_REVOLUTE, tool, strut[0], &frame, &frame, &free_joint),
        PDN_OK);
    CHECK_STATUS(pdn_model_add_joint(model, PDN_JOINT_UNIVERSAL, PDN_GROUND, strut[1], &frame,
                                     &other, &free_joint),
                 PDN_OK);
    CHECK_STATUS(pdn_model_add_joint(model, PDN_JOINT_SPHERICAL, strut[2], PDN_GROUND, &frame,
                                     &other, &free_joint),
                 PDN_OK);
    CHECK(free_joint == JOINT(8) && joints(model) == 9);

    /* Springs, drives, loads. */
    CHECK_STATUS(pdn_model_add_spring_damper(model, hinge_A, PDN_ROTATION, 18.0, 0.1, 0.2, NULL),
                 PDN_OK);
    CHECK_STATUS(pdn_model_add_spring_damper(model, hinge_A, PDN_ROTATION, 1.0, 0, 0, NULL),
                 PDN_OK);
    CHECK_STATUS(pdn_model_add_spring_damper(model, ball_B, PDN_ROTATION_3, 1.0, 0, 0, NULL),
                 PDN_OK);
    CHECK_STATUS(pdn_model_add_spring_damper(model, cardan_C, PDN_ROTATION_2, 1.0, 0, 0, NULL),
                 PDN_OK);
    PDN_INIT(pdn_signal, &signal);
    CHECK_STATUS(pdn_signal_set_harmonics(&signal, 0.4, 0.3, cosines, sines, 3), PDN_OK);
    CHECK_STATUS(pdn_model_prescribe(model, motor_D, PDN_ROTATION, &signal, NULL), PDN_OK);
    CHECK_STATUS(pdn_signal_set_samples(&signal, 0.0, samples, 4), PDN_OK);
    CHECK_STATUS(
        pdn_model_add_load(model, rocker.last, PDN_FRAME_SPACE, PDN_FORCE_1, &signal, NULL),
        PDN_OK);
    CHECK_STATUS(pdn_signal_set_function(&signal, ramp, &slope), PDN_OK);
    CHECK_STATUS(
        pdn_model_add_load(model, flywheel, PDN_FRAME_MATERIAL, PDN_MOMENT_3, &signal, NULL),
        PDN_OK);
    CHECK_STATUS(pdn_signal_set_constant(&signal, 2.0 * pi), PDN_OK);
    for (i = PDN_FORCE_1; i <= PDN_MOMENT_3; i++)
        CHECK_STATUS(pdn_model_add_load(model, tool, PDN_FRAME_SPACE, i, &signal, NULL), PDN_OK);
    CHECK_STATUS(pdn_model_prescribe(model, cardan_C, PDN_ROTATION_2, &signal, NULL), PDN_OK);
    CHECK_STATUS(pdn_model_set_gravity(model, down), PDN_OK);

    CHECK(nodes(model) == 31 && joints(model) == 9 && elements(model) == 13);
    /* An id that is not wanted. */
    CHECK_STATUS(pdn_model_add_spherical(model, rocker.first, crank.first, B, NULL), PDN_OK);
    CHECK(joints(model) == 10);
    pdn_model_free(model);
    pdn_model_free(NULL);
}

int main(void)
{
    longer_structs_pass_if_unused();
    signals_replace_what_was_set();
    directions_may_have_any_length();
    spatial_mechanism();
    return 0;
}
