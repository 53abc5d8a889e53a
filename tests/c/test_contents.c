/* Labels, and what a model that was loaded holds: as it was given, and calls that are refused. */
#include "near.h"

static struct {
    pdn_model *model;
    int32_t kind, id, index, number;
    double station, period, times[2];
} in;
static struct {
    int32_t id, other, first, elements;
    double number, numbers[36];
} out;

static int model_changed(void)
{
    char label[PDN_LABEL_LENGTH + 1];
    return pdn_model_label(in.model, NODE(0), label, sizeof label) != 5 ||
           strcmp(label, "crank") != 0 ||
           pdn_model_label(in.model, NODE(1), label, sizeof label) != 0;
}

#include "refusal.h"

static const double ORIGIN[3] = {0, 0, 0}, AXIS[3] = {0, 0, 1}, FAR_END[3] = {1, 0, 0};
static const double ACROSS[3] = {0, 1, 0};

/* Two bodies on joints, with forces of several kinds, a beam and a load. */
static pdn_model *build(void)
{
    const double moments[9] = {0.3, 0, 0, 0, 0.4, 0, 0, 0, 0.5}, stiff[2] = {3, 0.5};
    const double branch[1] = {2}, relaxation[1] = {0.1}, cosines[1] = {0.3}, sines[1] = {0.1};
    const double sizes[6] = {100, 40, 40, 2, 3, 4}, masses[4] = {1.5, 0.01, 0.005, 0.006};
    const int32_t joints[2] = {JOINT(0), JOINT(1)}, coordinates[2] = {PDN_ROTATION, PDN_ROTATION};
    const double coefficients[2] = {2, -1};
    const pdn_frame frame = {{0.1, 0.2, 0.3}, {0, 1, 0, -1, 0, 0, 0, 0, 1}};
    double matrix[36] = {0};
    pdn_section section;
    pdn_signal signal;
    pdn_beam beam;
    pdn_model *model;
    int32_t bodies[2], joint, id, i;
    CHECK_STATUS(pdn_model_new(&model), PDN_OK);
    for (i = 0; i < 2; i++) {
        CHECK_STATUS(pdn_model_add_rigid_body(model, 2 + i, ORIGIN, moments, &bodies[i]), PDN_OK);
        CHECK_STATUS(pdn_model_add_revolute(model, i == 0 ? PDN_GROUND : bodies[0], bodies[i],
                                            ORIGIN, AXIS, &joint),
                     PDN_OK);
    }
    CHECK_STATUS(pdn_model_add_screw(model, PDN_GROUND, bodies[1], ORIGIN, AXIS, -0.2, &joint),
                 PDN_OK);
    PDN_INIT(pdn_signal, &signal);
    CHECK_STATUS(pdn_signal_set_harmonics(&signal, 0.2, 0, cosines, sines, 1), PDN_OK);
    CHECK_STATUS(pdn_model_add_nonlinear_spring_damper(model, JOINT(1), PDN_ROTATION, stiff, 2,
                                                       stiff, 1, 0.7, NULL),
                 PDN_OK);
    CHECK_STATUS(pdn_model_add_actuator(model, JOINT(1), PDN_ROTATION, &signal, NULL), PDN_OK);
    CHECK_STATUS(pdn_model_add_viscoelastic(model, JOINT(1), PDN_ROTATION, 1.5, 0.1, branch,
                                            relaxation, 1, NULL),
                 PDN_OK);
    matrix[0] = 5;
    matrix[6] = 1; /* row 0 of column 1 */
    CHECK_STATUS(pdn_model_add_bushing(model, bodies[0], bodies[1], &frame, &frame, matrix, matrix,
                                       PDN_ANGLES_TILT_AND_SPIN, NULL),
                 PDN_OK);
    CHECK_STATUS(pdn_model_add_relation(model, joints, coordinates, coefficients, 2, NULL, NULL),
                 PDN_OK);
    CHECK_STATUS(pdn_model_prescribe(model, JOINT(0), PDN_ROTATION, &signal, NULL), PDN_OK);
    CHECK_STATUS(
        pdn_model_add_load(model, bodies[1], PDN_FRAME_MATERIAL, PDN_FORCE_2, &signal, NULL),
        PDN_OK);
    PDN_INIT(pdn_section, &section);
    CHECK_STATUS(pdn_section_set_diagonal(&section, sizes, masses), PDN_OK);
    CHECK_STATUS(pdn_model_add_straight_beam(model, ORIGIN, FAR_END, ACROSS, &section, 2, 3, &beam),
                 PDN_OK);
    CHECK_STATUS(pdn_model_add_load_at_point(model, bodies[1], FAR_END, PDN_FRAME_SPACE,
                                             PDN_FORCE_2, &signal, &id),
                 PDN_OK);
    CHECK(id == LOAD(1));
    CHECK_STATUS(pdn_model_add_load_on_beam(model, beam.first_element, 2, 0.7, NULL,
                                            PDN_FRAME_MATERIAL, PDN_MOMENT_1, &signal, &id),
                 PDN_OK);
    CHECK(id == LOAD(2));
    CHECK_STATUS(pdn_model_set_label(model, NODE(0), "crank"), PDN_OK);
    CHECK_STATUS(pdn_model_set_label(model, JOINT(0), "main bearing"), PDN_OK);
    CHECK_STATUS(pdn_model_set_label(model, RELATION(0), "G\xc3\xa4nge"), PDN_OK);
    return model;
}

static void joints_and_forces_are_those_given(void)
{
    const double times[2] = {0, 0.5};
    double value, values[2], fraction, offset[3];
    int32_t count, id, other, first, elements, i;
    pdn_joint_info joint;
    pdn_force_info force;
    PDN_INIT(pdn_joint_info, &joint);
    CHECK_STATUS(pdn_model_joint(in.model, JOINT(1), &joint), PDN_OK);
    CHECK(joint.kind == PDN_JOINT_REVOLUTE && joint.first == NODE(0) && joint.second == NODE(1));
    CHECK_NEAR(joint.second_rotation[8], 1, 1e-15);
    CHECK_NEAR(joint.first_position[0], 0, 1e-15);
    CHECK_STATUS(pdn_model_joint(in.model, JOINT(2), &joint), PDN_OK);
    CHECK(joint.kind == PDN_JOINT_SCREW && joint.first == PDN_GROUND && joint.pitch == -0.2);

    PDN_INIT(pdn_force_info, &force);
    CHECK_STATUS(pdn_model_force(in.model, FORCE(0), &force), PDN_OK);
    CHECK(force.kind == PDN_FORCE_IS_SPRING_DAMPER && force.joint == JOINT(1) &&
          force.coordinate == PDN_ROTATION && force.stiffness_count == 2 &&
          force.damping_count == 1 && force.rest == 0.7);
    CHECK_STATUS(pdn_model_force_number(in.model, FORCE(0), PDN_NUMBER_STIFFNESS, 1, &value),
                 PDN_OK);
    CHECK(value == 0.5);
    CHECK_STATUS(pdn_model_force(in.model, FORCE(1), &force), PDN_OK);
    CHECK(force.kind == PDN_FORCE_IS_ACTUATOR && force.stiffness_count == 0);
    CHECK_STATUS(pdn_model_force(in.model, FORCE(2), &force), PDN_OK);
    CHECK(force.kind == PDN_FORCE_IS_VISCOELASTIC && force.branch_count == 1 &&
          force.stiffness_count == 2);
    CHECK_STATUS(pdn_model_force_number(in.model, FORCE(2), PDN_NUMBER_RELAXATION_TIME, 0, &value),
                 PDN_OK);
    CHECK(value == 0.1);
    CHECK_STATUS(pdn_model_force_number(in.model, FORCE(2), PDN_NUMBER_REST, 0, &value), PDN_OK);
    CHECK(value == 0.1);
    CHECK_STATUS(pdn_model_force(in.model, FORCE(3), &force), PDN_OK);
    CHECK(force.kind == PDN_FORCE_IS_BUSHING && force.joint == -1 && force.coordinate == -1 &&
          force.first == NODE(0) && force.second == NODE(1) &&
          force.angles == PDN_ANGLES_TILT_AND_SPIN);
    CHECK_NEAR(force.second_position[2], 0.3, 1e-15);
    CHECK_NEAR(force.first_rotation[1], 1, 1e-15);
    CHECK_STATUS(pdn_model_force_number(in.model, FORCE(3), PDN_NUMBER_STIFFNESS, 6, &value),
                 PDN_OK);
    CHECK(value == 1);

    CHECK_STATUS(pdn_model_relation_term_count(in.model, RELATION(0), &count), PDN_OK);
    CHECK(count == 2);
    CHECK_STATUS(pdn_model_relation_term(in.model, RELATION(0), 1, &id, &other, &value), PDN_OK);
    CHECK(id == JOINT(1) && other == PDN_ROTATION && value == -1);
    CHECK_STATUS(pdn_model_prescribed(in.model, PRESCRIBED(0), &id, &other), PDN_OK);
    CHECK(id == JOINT(0) && other == PDN_ROTATION);
    CHECK_STATUS(pdn_model_load_count(in.model, &count), PDN_OK);
    CHECK(count == 3);
    for (i = 0; i < 2; i++) {
        CHECK_STATUS(
            pdn_model_load_at(in.model, LOAD(i), &id, &first, &elements, &fraction, offset, &other),
            PDN_OK);
        CHECK(id == NODE(1) && other == (i == 0 ? PDN_FRAME_MATERIAL : PDN_FRAME_SPACE));
        CHECK(first == -1 && elements == 0 && fraction == 0);
        CHECK(offset[0] == i * FAR_END[0] && offset[1] == 0 && offset[2] == 0);
    }
    CHECK_STATUS(
        pdn_model_load_at(in.model, LOAD(2), &id, &first, &elements, &fraction, NULL, &other),
        PDN_OK);
    CHECK(id == -1 && first == BEAM_ELEMENT(0) && elements == 2 && fraction == 0.7);
    for (i = 0; i < 2; i++) {
        const int32_t component = i == 0 ? 0 : PDN_FORCE_2;
        id = i == 0 ? PRESCRIBED(0) : LOAD(0);
        CHECK_STATUS(pdn_model_sample_signal(in.model, id, component, 2.0, times, 2, values),
                     PDN_OK);
        CHECK_NEAR(values[0], 0.5, 1e-15);
        CHECK_NEAR(values[1], 0.3, 1e-15);
    }
}

static void beams_and_masses_are_those_given(void)
{
    double twist, matrix[36];
    int32_t count, node, i;
    pdn_section section;
    CHECK_STATUS(pdn_model_beam_element_node_count(in.model, BEAM_ELEMENT(1), &count), PDN_OK);
    CHECK(count == 4);
    for (i = 0; i < 4; i++) {
        CHECK_STATUS(pdn_model_beam_element_node(in.model, BEAM_ELEMENT(1), i, &node), PDN_OK);
        CHECK(node == NODE(5 + i));
    }
    PDN_INIT(pdn_section, &section);
    CHECK_STATUS(pdn_model_beam_section(in.model, BEAM_ELEMENT(1), 0.3, &section, &twist), PDN_OK);
    CHECK_NEAR(section.stiffness[0], 100, 1e-12);
    CHECK_NEAR(section.stiffness[35], 4, 1e-12);
    CHECK_NEAR(section.mass[0], 1.5, 1e-12);
    CHECK(twist == 0);
    CHECK_STATUS(pdn_model_inertia_count(in.model, &count), PDN_OK);
    CHECK(count == 2);
    CHECK_STATUS(pdn_model_inertia(in.model, INERTIA(1), &node, matrix), PDN_OK);
    CHECK(node == NODE(1));
    CHECK_STATUS(pdn_model_inertia_of(in.model, NODE(1), &count), PDN_OK);
    CHECK(count == INERTIA(1));
    CHECK_NEAR(matrix[0], 3, 1e-15);
    CHECK_NEAR(matrix[28], 0.4, 1e-15);
}

/* Labels are found, and a message and the summary name what has one. */
static void labels_name_things(void)
{
    char text[4096];
    int32_t id;
    CHECK_STATUS(pdn_model_find_label(in.model, PDN_OBJECT_NODE, "crank", &id), PDN_OK);
    CHECK(id == NODE(0));
    CHECK(pdn_model_label(in.model, RELATION(0), text, sizeof text) == 6);
    CHECK(strcmp(text, "G\xc3\xa4nge") == 0);
    /* Cut where a character ends. */
    CHECK(pdn_model_label(in.model, RELATION(0), text, 3) == 6);
    CHECK(strcmp(text, "G") == 0);
    CHECK(pdn_model_label(in.model, RELATION(0), NULL, 0) == 6);
    CHECK(pdn_model_describe(in.model, text, sizeof text) < sizeof text);
    CHECK(strstr(text, "joints 0 \"main bearing\"") != NULL);
}

static void wrong_calls_are_refused(void)
{
    static const int32_t none[] = {-1, 99, INT32_MAX, INT32_MIN};
    char longer[PDN_LABEL_LENGTH + 2];
    memset(longer, 'x', sizeof longer);
    longer[PDN_LABEL_LENGTH + 1] = 0;
#define SET(model, label) pdn_model_set_label(model, in.id, label)
    in.id = NODE(1);
    REFUSED(SET(NULL, "a"), PDN_ERR_NULL, "model");
    REFUSED(SET(in.model, "crank"), PDN_ERR_VALUE,
            "label: expected one that no other node has, got that of node 0");
    REFUSED(SET(in.model, longer), PDN_ERR_VALUE, "label: expected at most 200 bytes, got 201");
    REFUSED(SET(in.model, "two\nlines"), PDN_ERR_VALUE, "label: expected text without");
    REFUSED(SET(in.model, "a \"b\""), PDN_ERR_VALUE, "label: expected text without");
    REFUSED(SET(in.model, "\xff"), PDN_ERR_VALUE, "label: expected text in UTF-8");
    REFUSES_EACH(in.id, int32_t, none, SET(in.model, "a"), PDN_ERR_ID, "id: expected an id of");
    in.id = NODE(99);
    REFUSED(SET(in.model, "a"), PDN_ERR_ID, "id: expected a node id from 100000000 to ");
    in.id = PARAMETER(0);
    REFUSED(SET(in.model, "a"), PDN_ERR_ID, "id: expected an id of what PDN_OBJECT_NODE to ");
#undef SET
    in.kind = PDN_OBJECT_NODE;
#define FIND(model, label, id) pdn_model_find_label(model, in.kind, label, id)
    REFUSED(FIND(NULL, "a", &out.id), PDN_ERR_NULL, "model");
    REFUSED(FIND(in.model, NULL, &out.id), PDN_ERR_NULL, "label");
    REFUSED(FIND(in.model, "crank", NULL), PDN_ERR_NULL, "id");
    REFUSED(FIND(in.model, "pin", &out.id), PDN_ERR_NOT_AVAILABLE, "label: no node has");
    REFUSES_EACH(in.kind, int32_t, none, FIND(in.model, "a", &out.id), PDN_ERR_VALUE, "kind: ");
#undef FIND
    in.id = FORCE(0);
    REFUSES_EACH(in.id, int32_t, none,
                 pdn_model_force_number(in.model, in.id, PDN_NUMBER_STIFFNESS, 0, &out.number),
                 PDN_ERR_ID, "force: ");
    REFUSES_EACH(
        in.index, int32_t, none,
        pdn_model_force_number(in.model, FORCE(0), PDN_NUMBER_STIFFNESS, in.index, &out.number),
        PDN_ERR_ID, "index: ");
    REFUSES_EACH(in.number, int32_t, none,
                 pdn_model_force_number(in.model, FORCE(0), in.number, 0, &out.number),
                 PDN_ERR_VALUE, "number: ");
    REFUSED(pdn_model_force_number(in.model, FORCE(0), PDN_NUMBER_STIFFNESS, 0, NULL), PDN_ERR_NULL,
            "out");
    REFUSED(pdn_model_force_node(in.model, FORCE(0), 0, &out.id), PDN_ERR_ID, "index: ");
    REFUSES_EACH(in.id, int32_t, none, pdn_model_beam_element_node_count(in.model, in.id, &out.id),
                 PDN_ERR_ID, "element: ");
    REFUSES_EACH(in.index, int32_t, none,
                 pdn_model_beam_element_node(in.model, BEAM_ELEMENT(0), in.index, &out.id),
                 PDN_ERR_ID, "index: ");
    in.id = INERTIA(2);
    REFUSES_EACH(in.id, int32_t, none, pdn_model_inertia(in.model, in.id, &out.id, out.numbers),
                 PDN_ERR_ID, "inertia: expected an inertia id from 1100000000 to 1100000001, got ");
    REFUSED(pdn_model_inertia(in.model, INERTIA(2), &out.id, out.numbers), PDN_ERR_ID, "inertia: ");
    REFUSED(pdn_model_inertia(in.model, INERTIA(0), NULL, out.numbers), PDN_ERR_NULL, "node");
    REFUSED(pdn_model_inertia(in.model, INERTIA(0), &out.id, NULL), PDN_ERR_NULL, "matrix");
    REFUSED(pdn_model_inertia_of(in.model, INERTIA(0), &out.id), PDN_ERR_ID,
            "node: expected a node id from 100000000 to 100000008, got 1100000000, which is the "
            "id of inertia 0");
    REFUSED(pdn_model_inertia_of(in.model, NODE(2), &out.id), PDN_ERR_NOT_AVAILABLE,
            "node: expected one that has inertia, got node 2");
    REFUSED(pdn_model_inertia_of(in.model, NODE(0), NULL), PDN_ERR_NULL, "inertia");
    in.id = PRESCRIBED(1);
    REFUSES_EACH(in.id, int32_t, none, pdn_model_prescribed(in.model, in.id, &out.id, &out.other),
                 PDN_ERR_ID, "prescribed: expected a prescribed coordinate id from 1200000000 to ");
    REFUSED(pdn_model_prescribed(in.model, PRESCRIBED(1), &out.id, &out.other), PDN_ERR_ID,
            "prescribed: ");
    REFUSED(pdn_model_prescribed(in.model, PRESCRIBED(0), &out.id, NULL), PDN_ERR_NULL,
            "coordinate");
#define LOAD_AT(load, offset)                                                                      \
    pdn_model_load_at(in.model, load, &out.id, &out.first, &out.elements, &out.number, offset,     \
                      &out.other)
    REFUSES_EACH(in.id, int32_t, none, LOAD_AT(in.id, NULL), PDN_ERR_ID,
                 "load: expected a load id from 800000000 to 800000002, got ");
    REFUSED(LOAD_AT(BEAM_LOAD(0), out.numbers), PDN_ERR_ID,
            "load: expected a load id from 800000000 to 800000002, got 900000000, which is the id "
            "of beam load 0");
    REFUSED(pdn_model_load_at(in.model, LOAD(0), &out.id, &out.first, NULL, &out.number, NULL,
                              &out.other),
            PDN_ERR_NULL, "elements");
#undef LOAD_AT
    REFUSED(pdn_model_relation_term_count(in.model, RELATION(1), &out.id), PDN_ERR_ID,
            "relation: ");
    REFUSED(pdn_model_relation_term(in.model, RELATION(0), 2, &out.id, &out.other, &out.number),
            PDN_ERR_ID, "index: ");
#define SAMPLE(id, component)                                                                      \
    pdn_model_sample_signal(in.model, id, component, in.period, in.times, 2, out.numbers)
    in.period = 2;
    REFUSED(SAMPLE(PDN_GRAVITY, 0), PDN_ERR_NOT_AVAILABLE, "id: ");
    REFUSED(SAMPLE(PDN_GRAVITY, -1), PDN_ERR_VALUE, "component: ");
    REFUSED(SAMPLE(BEAM_LOAD(0), PDN_FORCE_1), PDN_ERR_ID,
            "id: expected a beam load id though there is none yet, got 900000000");
    REFUSED(SAMPLE(SHELL_LOAD(0), PDN_FORCE_1), PDN_ERR_ID,
            "id: expected a shell load id though there is none yet, got 1000000000");
    REFUSES_EACH(in.id, int32_t, none, SAMPLE(in.id, PDN_FORCE_2), PDN_ERR_ID,
                 "id: expected an id of an actuator");
    REFUSED(SAMPLE(NODE(0), 0), PDN_ERR_ID, "id: expected an id of an actuator");
    REFUSED(SAMPLE(FORCE(0), 0), PDN_ERR_NOT_AVAILABLE,
            "id: expected what has a signal there, got force 0");
    REFUSED(SAMPLE(LOAD(0), PDN_FORCE_1), PDN_ERR_NOT_AVAILABLE, "id: ");
    REFUSED(SAMPLE(LOAD(0), -1), PDN_ERR_VALUE, "component: ");
    REFUSED(SAMPLE(PRESCRIBED(0), PDN_FORCE_1), PDN_ERR_VALUE, "component: expected 0");
    REFUSES_NOT_FINITE(in.period, SAMPLE(PRESCRIBED(0), 0), "period");
    REFUSES_NOT_FINITE_ENTRIES(in.times, 2, SAMPLE(PRESCRIBED(0), 0), "times");
    in.period = 0;
    REFUSED(SAMPLE(PRESCRIBED(0), 0), PDN_ERR_VALUE, "period: ");
#undef SAMPLE
}

/* Structs that were not initialised, or of things that are not there. */
static void structs_are_refused(void)
{
    pdn_joint_info joint;
    pdn_force_info force;
    pdn_section section;
    PDN_INIT(pdn_joint_info, &joint);
    PDN_INIT(pdn_force_info, &force);
    PDN_INIT(pdn_section, &section);
    CHECK_STATUS(pdn_model_joint(in.model, JOINT(3), &joint), PDN_ERR_ID);
    CHECK_STATUS(pdn_model_joint(in.model, JOINT(0), NULL), PDN_ERR_NULL);
    CHECK_STATUS(pdn_model_force(in.model, -1, &force), PDN_ERR_ID);
    CHECK_STATUS(pdn_model_beam_section(in.model, BEAM_ELEMENT(2), 0, &section, NULL), PDN_ERR_ID);
    CHECK_STATUS(pdn_model_beam_section(in.model, BEAM_ELEMENT(0), 1.01, &section, NULL),
                 PDN_ERR_VALUE);
    CHECK_STATUS(pdn_model_beam_section(in.model, BEAM_ELEMENT(0), NAN, &section, NULL),
                 PDN_ERR_NOT_FINITE);
    joint.struct_size = force.struct_size = 8;
    CHECK_STATUS(pdn_model_joint(in.model, JOINT(0), &joint), PDN_ERR_STRUCT_SIZE);
    CHECK_STATUS(pdn_model_force(in.model, FORCE(0), &force), PDN_ERR_STRUCT_SIZE);
}

/* A beam with a load of its own factors and one that is given at places, a plate with loads on its
 * surface and on an edge, and two parameters. */
static pdn_model *build_loaded(void)
{
    const double sizes[6] = {100, 40, 40, 2, 3, 4}, masses[4] = {1.5, 0.01, 0.005, 0.006};
    const double fractions[3] = {0, 0.5, 1}, factors[3] = {1, -2, 0.5}, up[3] = {0, 0, 2};
    pdn_section section;
    pdn_shell_section plate;
    pdn_surface surface;
    pdn_signal signal, signals[18];
    pdn_beam beam;
    pdn_shell shell;
    pdn_model *model;
    int32_t id, i;
    CHECK_STATUS(pdn_model_new(&model), PDN_OK);
    PDN_INIT(pdn_section, &section);
    CHECK_STATUS(pdn_section_set_diagonal(&section, sizes, masses), PDN_OK);
    CHECK_STATUS(pdn_model_add_straight_beam(model, ORIGIN, FAR_END, ACROSS, &section, 3, 2, &beam),
                 PDN_OK);
    PDN_INIT(pdn_signal, &signal);
    CHECK_STATUS(pdn_signal_set_constant(&signal, 0.5), PDN_OK);
    CHECK_STATUS(pdn_model_add_distributed_load(model, beam.first_element + 1, 2,
                                                PDN_FRAME_MATERIAL, PDN_MOMENT_1, &signal,
                                                fractions, factors, 3, &id),
                 PDN_OK);
    CHECK(id == BEAM_LOAD(0));
    CHECK_STATUS(pdn_model_add_distributed_load(model, beam.first_element, 1, PDN_FRAME_SPACE,
                                                PDN_FORCE_1, &signal, NULL, NULL, 0, NULL),
                 PDN_OK);
    for (i = 0; i < 18; i++)
        PDN_INIT(pdn_signal, &signals[i]);
    /* Nothing at the first place. */
    CHECK_STATUS(pdn_signal_set_constant(&signals[6 + 2], 3), PDN_OK);
    CHECK_STATUS(pdn_signal_set_constant(&signals[12 + 1], 4), PDN_OK);
    CHECK_STATUS(pdn_model_add_load_at_places(model, beam.first_element, 3, PDN_FRAME_UNTWISTED, up,
                                              fractions, signals, 3, &id),
                 PDN_OK);
    CHECK(id == BEAM_LOAD(2));
    PDN_INIT(pdn_surface, &surface);
    CHECK_STATUS(pdn_surface_set_parallelogram(&surface, AXIS, FAR_END, ACROSS), PDN_OK);
    PDN_INIT(pdn_shell_section, &plate);
    CHECK_STATUS(pdn_shell_section_set_isotropic(&plate, 0.1, 1e6, 0.3, 1000, 1, 0.1), PDN_OK);
    CHECK_STATUS(pdn_model_add_shell(model, &surface, 2, 1, 1, 1, 0, &plate, NULL, &shell), PDN_OK);
    CHECK_STATUS(pdn_model_add_shell_load(model, shell.first_element, 2, PDN_SHELL_SURFACE,
                                          PDN_FRAME_MATERIAL, PDN_FORCE_3, &signal, NULL),
                 PDN_OK);
    CHECK_STATUS(pdn_model_add_shell_load(model, shell.first_element + 1, 1, PDN_SHELL_EDGE_END_XI,
                                          PDN_FRAME_SPACE, PDN_FORCE_2, &signal, &id),
                 PDN_OK);
    CHECK(id == SHELL_LOAD(1));
    CHECK_STATUS(pdn_model_add_parameter(model, "pressure", 1.5, 2, &id), PDN_OK);
    CHECK_STATUS(pdn_model_add_parameter(model,
                                         "Dr\xc3\xbc"
                                         "cke",
                                         -3, 7, &id),
                 PDN_OK);
    CHECK_STATUS(pdn_model_set_label(model, SHELL_LOAD(1), "pull"), PDN_OK);
    return model;
}

static double first_value(int32_t id, int32_t component)
{
    const double time = 0.3;
    double value;
    CHECK_STATUS(pdn_model_sample_signal(in.model, id, component, 2, &time, 1, &value), PDN_OK);
    return value;
}

static void loads_are_those_given(void)
{
    const double fractions[3] = {0, 0.5, 1}, factors[3] = {1, -2, 0.5};
    double axis_2[3], fraction, factor;
    int32_t count, first, elements, frame, places, i;
    CHECK_STATUS(pdn_model_beam_load_count(in.model, &count), PDN_OK);
    CHECK(count == 5);
    CHECK_STATUS(
        pdn_model_beam_load(in.model, BEAM_LOAD(0), &first, &elements, &frame, axis_2, &places),
        PDN_OK);
    CHECK(first == BEAM_ELEMENT(1) && elements == 2 && frame == PDN_FRAME_MATERIAL && places == 3);
    CHECK(axis_2[0] == 0 && axis_2[1] == 0 && axis_2[2] == 0);
    for (i = 0; i < 3; i++) {
        CHECK_STATUS(pdn_model_beam_load_factor(in.model, BEAM_LOAD(0), i, &fraction, &factor),
                     PDN_OK);
        CHECK(fraction == fractions[i] && factor == factors[i]);
    }
    CHECK(first_value(BEAM_LOAD(0), PDN_MOMENT_1) == 0.5);
    CHECK_STATUS(
        pdn_model_beam_load(in.model, BEAM_LOAD(1), &first, &elements, &frame, NULL, &places),
        PDN_OK);
    CHECK(first == BEAM_ELEMENT(0) && elements == 1 && frame == PDN_FRAME_SPACE && places == 0);
    /* The third place of the last. */
    CHECK_STATUS(
        pdn_model_beam_load(in.model, BEAM_LOAD(4), &first, &elements, &frame, axis_2, &places),
        PDN_OK);
    CHECK(first == BEAM_ELEMENT(0) && elements == 3 && frame == PDN_FRAME_UNTWISTED);
    CHECK(axis_2[0] == 0 && axis_2[1] == 0 && axis_2[2] == 2);
    CHECK(first_value(BEAM_LOAD(3), PDN_FORCE_3) == 3);
    CHECK(first_value(BEAM_LOAD(4), PDN_FORCE_2) == 4);
    CHECK_STATUS(pdn_model_beam_load_factor(in.model, BEAM_LOAD(4), places - 1, &fraction, &factor),
                 PDN_OK);
    CHECK(fraction == 1 && factor == 1);

    CHECK_STATUS(pdn_model_shell_load_count(in.model, &count), PDN_OK);
    CHECK(count == 2);
    CHECK_STATUS(pdn_model_shell_load(in.model, SHELL_LOAD(0), &first, &elements, &places, &frame),
                 PDN_OK);
    CHECK(first == SHELL_ELEMENT(0) && elements == 2 && places == PDN_SHELL_SURFACE &&
          frame == PDN_FRAME_MATERIAL);
    CHECK_STATUS(pdn_model_shell_load(in.model, SHELL_LOAD(1), &first, &elements, &places, &frame),
                 PDN_OK);
    CHECK(first == SHELL_ELEMENT(1) && elements == 1 && places == PDN_SHELL_EDGE_END_XI &&
          frame == PDN_FRAME_SPACE);
    CHECK(first_value(SHELL_LOAD(1), PDN_FORCE_2) == 0.5);
    CHECK_STATUS(pdn_model_find_label(in.model, PDN_OBJECT_SHELL_LOAD, "pull", &first), PDN_OK);
    CHECK(first == SHELL_LOAD(1));
}

static void parameters_are_those_given(void)
{
    char name[20];
    double value, scale;
    int32_t count, id;
    CHECK_STATUS(pdn_model_parameter_count(in.model, &count), PDN_OK);
    CHECK(count == 2);
    CHECK_STATUS(pdn_model_find_parameter(in.model, "pressure", &id), PDN_OK);
    CHECK(id == PARAMETER(0));
    CHECK_STATUS(pdn_model_parameter(in.model, PARAMETER(1), &value, &scale), PDN_OK);
    CHECK(value == -3 && scale == 7);
    CHECK_STATUS(pdn_model_parameter(in.model, PARAMETER(0), &value, NULL), PDN_OK);
    CHECK(value == 1.5);
    CHECK(pdn_model_parameter_name(in.model, PARAMETER(1), name, sizeof name) == 7);
    CHECK(strcmp(name, "Dr\xc3\xbc"
                       "cke") == 0);
    CHECK(pdn_model_parameter_name(in.model, PARAMETER(0), NULL, 0) == 8);
    CHECK(pdn_model_parameter_name(in.model, NODE(0), name, sizeof name) == 0);
    CHECK_MESSAGE("parameter: expected a parameter id from 700000000 to 700000001, got 100000000, "
                  "which is the id of node 0");
}

static void wrong_calls_of_loads_are_refused(void)
{
#define BEAM_LOAD_OF(id, first, elements, frame, places)                                           \
    pdn_model_beam_load(in.model, id, first, elements, frame, NULL, places)
    int32_t one, two, three, four;
    const int32_t none[] = {-1, NO_IDS};
    REFUSES_EACH(in.id, int32_t, none, BEAM_LOAD_OF(in.id, &out.id, &one, &two, &three), PDN_ERR_ID,
                 "load: expected a beam load id from 900000000 to 900000004, got ");
    REFUSED(BEAM_LOAD_OF(BEAM_LOAD(0), NULL, &one, &two, &three), PDN_ERR_NULL, "first_element");
    REFUSED(BEAM_LOAD_OF(BEAM_LOAD(0), &one, NULL, &two, &three), PDN_ERR_NULL, "elements");
    REFUSED(BEAM_LOAD_OF(BEAM_LOAD(0), &one, &two, NULL, &three), PDN_ERR_NULL, "frame");
    REFUSED(BEAM_LOAD_OF(BEAM_LOAD(0), &one, &two, &three, NULL), PDN_ERR_NULL, "places");
#undef BEAM_LOAD_OF
#define FACTOR(id, index, fraction, factor)                                                        \
    pdn_model_beam_load_factor(in.model, id, index, fraction, factor)
    REFUSES_EACH(in.id, int32_t, none, FACTOR(in.id, 0, &out.number, out.numbers), PDN_ERR_ID,
                 "load: expected a beam load id");
    REFUSED(FACTOR(BEAM_LOAD(0), 3, &out.number, out.numbers), PDN_ERR_ID,
            "index: expected a place of the load from 0 to 2, got 3");
    REFUSED(FACTOR(BEAM_LOAD(1), 0, &out.number, out.numbers), PDN_ERR_ID, "index: ");
    REFUSED(FACTOR(BEAM_LOAD(0), 0, NULL, out.numbers), PDN_ERR_NULL, "fraction");
    REFUSED(FACTOR(BEAM_LOAD(0), 0, &out.number, NULL), PDN_ERR_NULL, "factor");
#undef FACTOR
#define SHELL(id, first, elements, place, frame)                                                   \
    pdn_model_shell_load(in.model, id, first, elements, place, frame)
    REFUSES_EACH(in.id, int32_t, none, SHELL(in.id, &one, &two, &three, &four), PDN_ERR_ID,
                 "load: expected a shell load id from 1000000000 to 1000000001, got ");
    REFUSED(SHELL(SHELL_LOAD(0), NULL, &one, &two, &three), PDN_ERR_NULL, "first_element");
    REFUSED(SHELL(SHELL_LOAD(0), &one, NULL, &two, &three), PDN_ERR_NULL, "elements");
    REFUSED(SHELL(SHELL_LOAD(0), &one, &two, NULL, &three), PDN_ERR_NULL, "place");
    REFUSED(SHELL(SHELL_LOAD(0), &one, &two, &three, NULL), PDN_ERR_NULL, "frame");
#undef SHELL
    REFUSES_EACH(in.id, int32_t, none,
                 pdn_model_parameter(in.model, in.id, &out.number, out.numbers), PDN_ERR_ID,
                 "parameter: expected a parameter id");
    REFUSED(pdn_model_parameter(in.model, PARAMETER(0), NULL, NULL), PDN_ERR_NULL, "value");
    REFUSED(pdn_model_find_parameter(in.model, "drag", &out.id), PDN_ERR_NOT_AVAILABLE,
            "name: no parameter is called \"drag\"");
    REFUSED(pdn_model_find_parameter(in.model, NULL, &out.id), PDN_ERR_NULL, "name");
    REFUSED(pdn_model_find_parameter(in.model, "pressure", NULL), PDN_ERR_NULL, "parameter");
}

/* The model, and what its file gives back. */
static void loaded_models_tell_their_loads(void)
{
    pdn_model *model = build_loaded();
    CHECK_STATUS(pdn_model_set_label(model, NODE(0), "crank"), PDN_OK);
    CHECK_STATUS(pdn_model_save(model, "test_contents.pdm"), PDN_OK);
    in.model = model;
    loads_are_those_given();
    parameters_are_those_given();
    CHECK_STATUS(pdn_model_load("test_contents.pdm", &in.model), PDN_OK);
    pdn_model_free(model);
    loads_are_those_given();
    parameters_are_those_given();
    wrong_calls_of_loads_are_refused();
    pdn_model_free(in.model);
}

int main(void)
{
    pdn_model *model = build();
    int pass;
    /* As built, as copied, and as loaded. */
    for (pass = 0; pass < 3; pass++) {
        in.model = NULL;
        if (pass == 0)
            in.model = model;
        else if (pass == 1)
            CHECK_STATUS(pdn_model_copy(model, &in.model), PDN_OK);
        else {
            CHECK_STATUS(pdn_model_save(model, "test_contents.pdm"), PDN_OK);
            CHECK_STATUS(pdn_model_load("test_contents.pdm", &in.model), PDN_OK);
        }
        joints_and_forces_are_those_given();
        beams_and_masses_are_those_given();
        labels_name_things();
        structs_are_refused();
        if (pass == 2)
            wrong_calls_are_refused();
        if (pass > 0)
            pdn_model_free(in.model);
    }
    pdn_model_free(model);
    loaded_models_tell_their_loads();
    printf("%d calls refused\n", refusals);
    return 0;
}
