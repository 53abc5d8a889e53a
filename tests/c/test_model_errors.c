/* Every function of models, sections and signals refuses what it must: it says which argument was
 * wrong, writes nothing, and leaves the model as it was. */
#include "check.h"
#include <math.h>
#include <stddef.h>

static int32_t constant(double time, double *value, void *user_data)
{
    (void)time;
    (void)user_data;
    *value = 1.0;
    return 0;
}

/* Arguments, each of them good. */
static struct {
    pdn_model *model;
    pdn_section section, unset;
    pdn_signal signal;
    pdn_frame frame, second_frame;
    double point[3], end[3], axis[3], arm[3];
    double rotation[9], inertia[9], matrix[36];
    double stiffness[6], mass_properties[4];
    double number, mass, cosines[3], sines[3];
    size_t count, elements, degree;
    int32_t node, other, joint, rigid, coordinate, kind, load_frame, component;
    int32_t nodes[2];
    pdn_beam beam;
} in;

/* Where results go; filled with a pattern. */
static struct {
    pdn_model *model;
    pdn_frame frame;
    pdn_beam beam;
    double mass, centre[3];
    int32_t id;
} out;

/* All that can be seen of the model. */
static struct summary {
    double mass, centre[3];
    int32_t nodes, joints, elements;
} expected;

static void summarise(struct summary *seen)
{
    memset(seen, 0, sizeof *seen);
    CHECK_STATUS(pdn_model_node_count(in.model, &seen->nodes), PDN_OK);
    CHECK_STATUS(pdn_model_joint_count(in.model, &seen->joints), PDN_OK);
    CHECK_STATUS(pdn_model_element_count(in.model, &seen->elements), PDN_OK);
    CHECK_STATUS(pdn_model_mass(in.model, &seen->mass, seen->centre), PDN_OK);
}

static int model_changed(void)
{
    struct summary seen;
    summarise(&seen);
    return memcmp(&seen, &expected, sizeof seen) != 0;
}

#include "refusal.h"

/* The call with NULL for the argument `name`. */
#define REFUSES_NULL(call, name) REFUSED(call, PDN_ERR_NULL, name ": expected a pointer, got NULL")

static const int32_t bad_ids[] = {-1, NO_IDS};
static const int32_t bad_bodies[] = {NO_IDS};
static const size_t bad_struct_sizes[] = {0, 7, 8, 80, 5000, (size_t)-1};

#define REFUSES_IDS(variable, ids, call, name)                                                     \
    REFUSES_EACH(variable, int32_t, ids, call, PDN_ERR_ID, name ": expected ")
#define REFUSES_ENUMS(variable, call, name)                                                        \
    do {                                                                                           \
        REFUSES_EACH(variable, int32_t, bad_enums, call, PDN_ERR_VALUE, name ": expected ");       \
        REFUSES_OTHER_ROLES(variable, call, name ": expected ");                                   \
    } while (0)
#define REFUSES_STRUCT_SIZES(variable, call, name)                                                 \
    REFUSES_EACH(variable.struct_size, size_t, bad_struct_sizes, call, PDN_ERR_STRUCT_SIZE,        \
                 name ": expected struct_size ")

#define REFUSES_BAD_FRAMES(frame, call, name)                                                      \
    do {                                                                                           \
        static const double stretched[] = {2.0, -1.0, 1.0001};                                     \
        REFUSES_NOT_FINITE_ENTRIES((frame).position, LENGTH((frame).position), call,               \
                                   name " position");                                              \
        REFUSES_NOT_FINITE_ENTRIES((frame).rotation, LENGTH((frame).rotation), call,               \
                                   name " rotation");                                              \
        REFUSES_EACH((frame).rotation[0], double, stretched, call, PDN_ERR_VALUE,                  \
                     name " rotation: expected a rotation matrix");                                \
    } while (0)

#define REFUSES_BAD_SECTIONS(call)                                                                 \
    do {                                                                                           \
        static const double not_positive[] = {0.0, -1e-9, -1.0};                                   \
        static const double negative[] = {-1e-12, -1.0};                                           \
        static const double lopsided[] = {1.0};                                                    \
        static const double gaining[] = {1e30};                                                    \
        REFUSES_STRUCT_SIZES(in.section, call, "section");                                         \
        REFUSES_NOT_FINITE_ENTRIES(in.section.stiffness, LENGTH(in.section.stiffness), call,       \
                                   "section stiffness");                                           \
        REFUSES_NOT_FINITE_ENTRIES(in.section.mass, LENGTH(in.section.mass), call,                 \
                                   "section mass");                                                \
        REFUSES_NOT_FINITE_ENTRIES(in.section.damping, LENGTH(in.section.damping), call,           \
                                   "section damping");                                             \
        REFUSES_EACH(in.section.stiffness[28], double, not_positive, call, PDN_ERR_VALUE,          \
                     "section stiffness: expected a positive-definite matrix");                    \
        REFUSES_EACH(in.section.mass[28], double, negative, call, PDN_ERR_VALUE,                   \
                     "section mass: expected a positive semi-definite matrix");                    \
        REFUSES_EACH(in.section.damping[28], double, negative, call, PDN_ERR_VALUE,                \
                     "section damping: expected a matrix whose symmetric part is positive");       \
        REFUSES_EACH(in.section.stiffness[1], double, lopsided, call, PDN_ERR_VALUE,               \
                     "section stiffness: expected a symmetric matrix");                            \
        REFUSES_EACH(in.section.mass[1], double, lopsided, call, PDN_ERR_VALUE,                    \
                     "section mass: expected a symmetric matrix");                                 \
        REFUSES_EACH(in.section.damping[1], double, gaining, call, PDN_ERR_VALUE,                  \
                     "section damping: expected a matrix whose symmetric part is positive");       \
    } while (0)

/* Signals that the setters would not have made. */
#define REFUSES_BAD_SIGNALS(call)                                                                  \
    do {                                                                                           \
        static const int32_t one[] = {1};                                                          \
        const pdn_signal good_ = in.signal;                                                        \
        REFUSES_STRUCT_SIZES(in.signal, call, "signal");                                           \
        REFUSES_ENUMS(in.signal.kind, call, "signal: kind");                                       \
        REFUSES_EACH(in.signal.reserved, int32_t, one, call, PDN_ERR_VALUE,                        \
                     "signal: reserved: expected zero");                                           \
        REFUSES_NOT_FINITE(in.signal.mean, call, "signal: mean");                                  \
        REFUSES_NOT_FINITE(in.signal.rate, call, "signal: rate");                                  \
        in.signal.harmonics = 3;                                                                   \
        REFUSES_NULL(call, "signal: cosines");                                                     \
        in.signal.cosines = in.cosines;                                                            \
        REFUSES_NULL(call, "signal: sines");                                                       \
        in.signal.sines = in.sines;                                                                \
        REFUSES_NOT_FINITE_ENTRIES(in.cosines, LENGTH(in.cosines), call, "signal: cosines");       \
        REFUSES_NOT_FINITE_ENTRIES(in.sines, LENGTH(in.sines), call, "signal: sines");             \
        in.signal.kind = PDN_SIGNAL_SAMPLES;                                                       \
        REFUSED(call, PDN_ERR_SIZE, "signal: samples: expected at least one sample");              \
        in.signal.sample_count = 3;                                                                \
        REFUSES_NULL(call, "signal: samples");                                                     \
        in.signal.samples = in.cosines;                                                            \
        REFUSES_NOT_FINITE_ENTRIES(in.cosines, LENGTH(in.cosines), call, "signal: samples");       \
        REFUSES_NOT_FINITE(in.signal.rate, call, "signal: rate");                                  \
        in.signal.kind = PDN_SIGNAL_FUNCTION;                                                      \
        REFUSES_NULL(call, "signal: function");                                                    \
        in.signal = good_;                                                                         \
    } while (0)

static void set_up(void)
{
    const double eye[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    const double inertia[9] = {2, 0, 0, 0, 3, 0, 0, 0, 4};
    int i;
    memset(&in, 0, sizeof in);
    PDN_INIT(pdn_section, &in.section);
    PDN_INIT(pdn_section, &in.unset);
    PDN_INIT(pdn_signal, &in.signal);
    for (i = 0; i < 6; i++)
        in.stiffness[i] = 100.0 + i;
    for (i = 0; i < 4; i++)
        in.mass_properties[i] = 1.0 + i;
    CHECK_STATUS(pdn_section_set_diagonal(&in.section, in.stiffness, in.mass_properties), PDN_OK);
    CHECK_STATUS(pdn_section_set_proportional_damping(&in.section, 0.01), PDN_OK);
    for (i = 0; i < 3; i++) {
        in.frame.position[i] = 1.0;
        in.second_frame.position[i] = 2.0;
        in.point[i] = 0.1 * i;
        in.end[i] = 1.0 + i;
    }
    memcpy(in.frame.rotation, eye, sizeof eye);
    memcpy(in.second_frame.rotation, eye, sizeof eye);
    memcpy(in.rotation, eye, sizeof eye);
    memcpy(in.inertia, inertia, sizeof inertia);
    for (i = 0; i < 6; i++)
        in.matrix[7 * i] = 1.0;
    in.axis[1] = 1.0;
    in.arm[2] = 1.0;
    in.number = 1.0;
    in.mass = 2.0;
    in.count = 2;
    in.elements = 2;
    in.degree = 2;
    in.component = PDN_MOMENT_2;
    in.load_frame = PDN_FRAME_MATERIAL;
    in.coordinate = PDN_ROTATION;
    in.kind = PDN_JOINT_SPHERICAL;

    CHECK_STATUS(pdn_model_new(&in.model), PDN_OK);
    CHECK_STATUS(pdn_model_add_straight_beam(in.model, in.point, in.end, in.axis, &in.section, 2, 1,
                                             &in.beam),
                 PDN_OK);
    in.node = in.nodes[0] = in.beam.first;
    in.other = in.nodes[1] = in.beam.last;
    CHECK_STATUS(
        pdn_model_add_revolute(in.model, PDN_GROUND, in.node, in.point, in.axis, &in.joint),
        PDN_OK);
    CHECK_STATUS(pdn_model_add_rigid_joint(in.model, in.node, in.other, in.point, &in.rigid),
                 PDN_OK);
    CHECK(in.joint == JOINT(0) && in.rigid == JOINT(1));
    summarise(&expected);
    CHECK(expected.nodes == 3 && expected.joints == 2 && expected.elements == 2);
}

static void sections(void)
{
    static const double not_positive[] = {0.0, -1.0};
    static const double negative[] = {-1.0};
    size_t k;
    pdn_section section;

    memset(&section, 0x5a, sizeof section);
    pdn_section_init(NULL, sizeof section);
    CHECK_MESSAGE("section: expected a pointer, got NULL");
    for (k = 0; k < 3; k++) {
        const size_t sizes[] = {0, 7, 5000};
        pdn_section_init(&section, sizes[k]);
        CHECK_MESSAGE("struct_size: expected between");
        CHECK(section.damping[35] == section.stiffness[0] && section.struct_size != sizeof section);
    }

#define CALL pdn_section_set_diagonal(&in.section, in.stiffness, in.mass_properties)
    REFUSES_NULL(pdn_section_set_diagonal(NULL, in.stiffness, in.mass_properties), "section");
    REFUSES_NULL(pdn_section_set_diagonal(&in.section, NULL, in.mass_properties), "stiffness");
    REFUSES_NULL(pdn_section_set_diagonal(&in.section, in.stiffness, NULL), "mass");
    REFUSES_STRUCT_SIZES(in.section, CALL, "section");
    REFUSES_NOT_FINITE_ENTRIES(in.stiffness, LENGTH(in.stiffness), CALL, "stiffness");
    REFUSES_NOT_FINITE_ENTRIES(in.mass_properties, LENGTH(in.mass_properties), CALL, "mass");
    for (k = 0; k < 6; k++)
        REFUSES_EACH(in.stiffness[k], double, not_positive, CALL, PDN_ERR_VALUE, "stiffness[");
    for (k = 0; k < 4; k++)
        REFUSES_EACH(in.mass_properties[k], double, negative, CALL, PDN_ERR_VALUE, "mass[");
#undef CALL

#define CALL pdn_section_set_proportional_damping(&in.section, in.number)
    REFUSES_NULL(pdn_section_set_proportional_damping(NULL, 1.0), "section");
    REFUSES_STRUCT_SIZES(in.section, CALL, "section");
    REFUSES_NOT_FINITE(in.number, CALL, "seconds");
    REFUSES_EACH(in.number, double, negative, CALL, PDN_ERR_VALUE,
                 "seconds: expected zero or more");
    REFUSED(pdn_section_set_proportional_damping(&in.unset, 1.0), PDN_ERR_VALUE,
            "section stiffness: expected a positive-definite matrix");
#undef CALL

#define CALL pdn_section_set_component_damping(&in.section, in.stiffness)
    REFUSES_NULL(pdn_section_set_component_damping(NULL, in.stiffness), "section");
    REFUSES_NULL(pdn_section_set_component_damping(&in.section, NULL), "seconds");
    REFUSES_STRUCT_SIZES(in.section, CALL, "section");
    REFUSES_NOT_FINITE_ENTRIES(in.stiffness, LENGTH(in.stiffness), CALL, "seconds");
    REFUSES_EACH(in.stiffness[3], double, negative, CALL, PDN_ERR_VALUE,
                 "seconds[3]: expected zero or more");
    REFUSED(pdn_section_set_component_damping(&in.unset, in.stiffness), PDN_ERR_VALUE,
            "section stiffness: expected a positive-definite matrix");
#undef CALL
}

/* A section that couples bending and torsion: times may differ, but not so much that a motion gains
 * energy. */
static void damping_by_component(void)
{
    const double times[6] = {1e-5, 1e-5, 1e-5, 2e-5, 1.4e-5, 2.2e-5};
    const double wild[6] = {1e-3, 1e-3, 1e-3, 0, 1e-3, 1e-3};
    pdn_section section = in.section;
    section.stiffness[4 + 6 * 3] = section.stiffness[3 + 6 * 4] = 20;
    CHECK_STATUS(pdn_section_set_component_damping(&section, times), PDN_OK);
    CHECK(section.damping[3 + 6 * 4] == 2e-5 * 20 && section.damping[4 + 6 * 3] == 1.4e-5 * 20);
    CHECK(section.damping[0] == 1e-5 * section.stiffness[0]);
    REFUSED(pdn_section_set_component_damping(&section, wild), PDN_ERR_VALUE, "section damping: ");
    CHECK(section.damping[3 + 6 * 4] == 2e-5 * 20);
}

static void signals(void)
{
    size_t k;
    pdn_signal signal;

    memset(&signal, 0x5a, sizeof signal);
    pdn_signal_init(NULL, sizeof signal);
    CHECK_MESSAGE("signal: expected a pointer, got NULL");
    for (k = 0; k < 3; k++) {
        const size_t sizes[] = {0, 7, 5000};
        pdn_signal_init(&signal, sizes[k]);
        CHECK_MESSAGE("struct_size: expected between");
        CHECK(signal.reserved == 0x5a5a5a5a && signal.kind == 0x5a5a5a5a);
    }

#define CALL pdn_signal_set_constant(&in.signal, in.number)
    REFUSES_NULL(pdn_signal_set_constant(NULL, 1.0), "signal");
    REFUSES_STRUCT_SIZES(in.signal, CALL, "signal");
    REFUSES_NOT_FINITE(in.number, CALL, "value");
#undef CALL

#define CALL pdn_signal_set_harmonics(&in.signal, in.mass, in.number, in.cosines, in.sines, 3)
    REFUSES_NULL(pdn_signal_set_harmonics(NULL, 0, 0, in.cosines, in.sines, 3), "signal");
    REFUSES_NULL(pdn_signal_set_harmonics(&in.signal, 0, 0, NULL, in.sines, 3), "cosines");
    REFUSES_NULL(pdn_signal_set_harmonics(&in.signal, 0, 0, in.cosines, NULL, 3), "sines");
    REFUSED(pdn_signal_set_harmonics(&in.signal, 0, 0, in.cosines, in.sines, (size_t)-1),
            PDN_ERR_SIZE, "cosines: expected at most ");
    REFUSES_STRUCT_SIZES(in.signal, CALL, "signal");
    REFUSES_NOT_FINITE(in.mass, CALL, "mean");
    REFUSES_NOT_FINITE(in.number, CALL, "rate");
    REFUSES_NOT_FINITE_ENTRIES(in.cosines, LENGTH(in.cosines), CALL, "cosines");
    REFUSES_NOT_FINITE_ENTRIES(in.sines, LENGTH(in.sines), CALL, "sines");
#undef CALL

#define CALL pdn_signal_set_samples(&in.signal, in.number, in.cosines, 3)
    REFUSES_NULL(pdn_signal_set_samples(NULL, 0, in.cosines, 3), "signal");
    REFUSES_NULL(pdn_signal_set_samples(&in.signal, 0, NULL, 3), "samples");
    REFUSED(pdn_signal_set_samples(&in.signal, 0, in.cosines, 0), PDN_ERR_SIZE,
            "count: expected at least 1, got 0");
    REFUSED(pdn_signal_set_samples(&in.signal, 0, in.cosines, (size_t)-1), PDN_ERR_SIZE,
            "samples: expected at most ");
    REFUSES_STRUCT_SIZES(in.signal, CALL, "signal");
    REFUSES_NOT_FINITE(in.number, CALL, "rate");
    REFUSES_NOT_FINITE_ENTRIES(in.cosines, LENGTH(in.cosines), CALL, "samples");
#undef CALL

#define CALL pdn_signal_set_function(&in.signal, constant, &in)
    REFUSES_NULL(pdn_signal_set_function(NULL, constant, &in), "signal");
    REFUSES_NULL(pdn_signal_set_function(&in.signal, NULL, &in), "function");
    REFUSES_STRUCT_SIZES(in.signal, CALL, "signal");
#undef CALL
}

static void queries(void)
{
    REFUSES_NULL(pdn_model_new(NULL), "model");
    REFUSES_NULL(pdn_model_node_count(NULL, &out.id), "model");
    REFUSES_NULL(pdn_model_node_count(in.model, NULL), "count");
    REFUSES_NULL(pdn_model_joint_count(NULL, &out.id), "model");
    REFUSES_NULL(pdn_model_joint_count(in.model, NULL), "count");
    REFUSES_NULL(pdn_model_element_count(NULL, &out.id), "model");
    REFUSES_NULL(pdn_model_element_count(in.model, NULL), "count");
    REFUSES_NULL(pdn_model_mass(NULL, &out.mass, out.centre), "model");
    REFUSES_NULL(pdn_model_mass(in.model, NULL, out.centre), "mass");
    REFUSES_NULL(pdn_model_node_frame(NULL, in.node, &out.frame), "model");
    REFUSES_NULL(pdn_model_node_frame(in.model, in.node, NULL), "frame");
    REFUSES_IDS(in.node, bad_ids, pdn_model_node_frame(in.model, in.node, &out.frame), "node");
}

static void nodes_and_masses(void)
{
    static const double not_positive[] = {0.0, -1.0};
    static const double negative[] = {-1.0};
    static const double negative_inertia[] = {-1e-12, -1.0};
    static const double lopsided[] = {1.0}, far_away[] = {1e160, -1e300};
    static const double stretched[] = {2.0, -1.0, 1.0001};

#define CALL pdn_model_add_node(in.model, in.point, in.rotation, &out.id)
    REFUSES_NULL(pdn_model_add_node(NULL, in.point, in.rotation, &out.id), "model");
    REFUSES_NULL(pdn_model_add_node(in.model, NULL, in.rotation, &out.id), "position");
    REFUSES_NULL(pdn_model_add_node(in.model, in.point, NULL, NULL), "node");
    REFUSES_NOT_FINITE_ENTRIES(in.point, LENGTH(in.point), CALL, "position");
    REFUSES_NOT_FINITE_ENTRIES(in.rotation, LENGTH(in.rotation), CALL, "rotation");
    REFUSES_EACH(in.rotation[4], double, stretched, CALL, PDN_ERR_VALUE,
                 "rotation: expected a rotation matrix");
#undef CALL

#define CALL pdn_model_add_rigid_body(in.model, in.mass, in.point, in.inertia, &out.id)
    REFUSES_NULL(pdn_model_add_rigid_body(NULL, 1, in.point, in.inertia, &out.id), "model");
    REFUSES_NULL(pdn_model_add_rigid_body(in.model, 1, NULL, in.inertia, &out.id), "centre");
    REFUSES_NULL(pdn_model_add_rigid_body(in.model, 1, in.point, NULL, &out.id), "inertia");
    REFUSES_NULL(pdn_model_add_rigid_body(in.model, 1, in.point, in.inertia, NULL), "node");
    REFUSES_NOT_FINITE(in.mass, CALL, "mass");
    REFUSES_EACH(in.mass, double, not_positive, CALL, PDN_ERR_VALUE, "mass: expected ");
    REFUSES_NOT_FINITE_ENTRIES(in.point, LENGTH(in.point), CALL, "centre");
    REFUSES_NOT_FINITE_ENTRIES(in.inertia, LENGTH(in.inertia), CALL, "inertia");
    REFUSES_EACH(in.inertia[4], double, negative_inertia, CALL, PDN_ERR_VALUE,
                 "inertia: expected a positive semi-definite matrix");
    REFUSES_EACH(in.inertia[5], double, lopsided, CALL, PDN_ERR_VALUE,
                 "inertia: expected a symmetric matrix");
#undef CALL

#define CALL pdn_model_add_mass(in.model, in.node, in.mass, in.point, in.inertia, NULL)
    REFUSES_NULL(pdn_model_add_mass(NULL, in.node, 1, in.point, in.inertia, NULL), "model");
    REFUSES_NULL(pdn_model_add_mass(in.model, in.node, 1, NULL, in.inertia, NULL), "centre");
    REFUSES_IDS(in.node, bad_ids, CALL, "node");
    REFUSES_NOT_FINITE(in.mass, CALL, "mass");
    REFUSES_EACH(in.mass, double, negative, CALL, PDN_ERR_VALUE, "mass: expected ");
    REFUSES_NOT_FINITE_ENTRIES(in.point, LENGTH(in.point), CALL, "centre");
    REFUSES_NOT_FINITE_ENTRIES(in.inertia, LENGTH(in.inertia), CALL, "inertia");
    REFUSES_EACH(in.inertia[4], double, negative_inertia, CALL, PDN_ERR_VALUE,
                 "inertia: expected a positive semi-definite matrix");
    REFUSES_EACH(in.inertia[5], double, lopsided, CALL, PDN_ERR_VALUE,
                 "inertia: expected a symmetric matrix");
    REFUSES_EACH(in.point[0], double, far_away, CALL, PDN_ERR_NOT_FINITE,
                 "inertia about the node[");
#undef CALL

#define CALL pdn_model_add_inertia(in.model, in.node, &in.frame, in.matrix, NULL)
    REFUSES_NULL(pdn_model_add_inertia(NULL, in.node, &in.frame, in.matrix, NULL), "model");
    REFUSES_NULL(pdn_model_add_inertia(in.model, in.node, &in.frame, NULL, NULL), "matrix");
    REFUSES_IDS(in.node, bad_ids, CALL, "node");
    REFUSES_BAD_FRAMES(in.frame, CALL, "frame");
    REFUSES_NOT_FINITE_ENTRIES(in.matrix, LENGTH(in.matrix), CALL, "matrix");
    REFUSES_EACH(in.matrix[35], double, negative_inertia, CALL, PDN_ERR_VALUE,
                 "matrix: expected a positive semi-definite matrix");
    REFUSES_EACH(in.matrix[5], double, lopsided, CALL, PDN_ERR_VALUE,
                 "matrix: expected a symmetric matrix");
#undef CALL
}

static void beams(void)
{
    static const size_t bad_counts[] = {0, 1, 26, 1000000, (size_t)-1};
    static const size_t bad_elements[] = {0, 1000001, (size_t)-1};
    static const size_t bad_degrees[] = {0, 25, (size_t)-1};
    int32_t saved;
    double turned[9] = {0, 1, 0, -1, 0, 0, 0, 0, 1};
    const double along[3] = {2, 0, 0};
    int32_t apart[2];

#define CALL pdn_model_add_beam_element(in.model, in.nodes, in.count, &in.section, &out.id)
    REFUSES_NULL(pdn_model_add_beam_element(NULL, in.nodes, 2, &in.section, &out.id), "model");
    REFUSES_NULL(pdn_model_add_beam_element(in.model, NULL, 2, &in.section, &out.id), "nodes");
    REFUSES_NULL(pdn_model_add_beam_element(in.model, in.nodes, 2, NULL, &out.id), "section");
    REFUSES_NULL(pdn_model_add_beam_element(in.model, in.nodes, 2, &in.section, NULL), "element");
    REFUSES_EACH(in.count, size_t, bad_counts, CALL, PDN_ERR_SIZE, "count: expected 2 to 25");
    REFUSES_IDS(in.nodes[0], bad_ids, CALL, "nodes[0]");
    REFUSES_IDS(in.nodes[1], bad_ids, CALL, "nodes[1]");
    saved = in.nodes[1];
    in.nodes[1] = in.nodes[0];
    REFUSED(CALL, PDN_ERR_VALUE, "nodes: expected distinct nodes");
    in.nodes[1] = saved;
    REFUSES_BAD_SECTIONS(CALL);
#undef CALL

    /* Axis 1 across the beam, and nodes at one place. */
    CHECK_STATUS(pdn_model_add_node(in.model, in.point, turned, &apart[0]), PDN_OK);
    CHECK_STATUS(pdn_model_add_node(in.model, along, turned, &apart[1]), PDN_OK);
    summarise(&expected);
    REFUSED(pdn_model_add_beam_element(in.model, apart, 2, &in.section, &out.id), PDN_ERR_VALUE,
            "nodes: expected axis 1 of each node's frame along the beam");
    CHECK_STATUS(pdn_model_add_node(in.model, along, NULL, &apart[0]), PDN_OK);
    summarise(&expected);
    REFUSED(pdn_model_add_beam_element(in.model, apart, 2, &in.section, &out.id), PDN_ERR_VALUE,
            "nodes: a beam element needs nodes at distinct positions");

#define CALL                                                                                       \
    pdn_model_add_straight_beam(in.model, in.point, in.end, in.axis, &in.section, in.elements,     \
                                in.degree, &out.beam)
#define WITH(model, start, end, axis, section, beam)                                               \
    pdn_model_add_straight_beam(model, start, end, axis, section, 2, 2, beam)
    REFUSES_NULL(WITH(NULL, in.point, in.end, in.axis, &in.section, &out.beam), "model");
    REFUSES_NULL(WITH(in.model, NULL, in.end, in.axis, &in.section, &out.beam), "start");
    REFUSES_NULL(WITH(in.model, in.point, NULL, in.axis, &in.section, &out.beam), "end");
    REFUSES_NULL(WITH(in.model, in.point, in.end, NULL, &in.section, &out.beam), "axis_2");
    REFUSES_NULL(WITH(in.model, in.point, in.end, in.axis, NULL, &out.beam), "section");
    REFUSES_NULL(WITH(in.model, in.point, in.end, in.axis, &in.section, NULL), "beam");
    REFUSES_NOT_FINITE_ENTRIES(in.point, LENGTH(in.point), CALL, "start");
    REFUSES_NOT_FINITE_ENTRIES(in.end, LENGTH(in.end), CALL, "end");
    REFUSES_NOT_FINITE_ENTRIES(in.axis, LENGTH(in.axis), CALL, "axis_2");
    REFUSED(WITH(in.model, in.point, in.point, in.axis, &in.section, &out.beam), PDN_ERR_VALUE,
            "end: expected a point away from start");
    {
        const double origin[3] = {0, 0, 0};
        REFUSED(WITH(in.model, in.point, in.end, origin, &in.section, &out.beam), PDN_ERR_VALUE,
                "axis_2: expected a vector that is not zero");
        REFUSED(WITH(in.model, origin, in.axis, in.axis, &in.section, &out.beam), PDN_ERR_VALUE,
                "axis_2: expected a vector across the beam");
    }
    REFUSES_BAD_SECTIONS(CALL);
    REFUSES_EACH(in.elements, size_t, bad_elements, CALL, PDN_ERR_SIZE, "elements: expected 1 to");
    REFUSES_EACH(in.degree, size_t, bad_degrees, CALL, PDN_ERR_SIZE, "degree: expected 1 to");
#undef WITH
#undef CALL
}

#define REFUSES_BAD_BODIES(call)                                                                   \
    do {                                                                                           \
        const int32_t second_ = in.other;                                                          \
        REFUSES_IDS(in.node, bad_bodies, call, "first");                                           \
        REFUSES_IDS(in.other, bad_bodies, call, "second");                                         \
        in.other = in.node;                                                                        \
        REFUSED(call, PDN_ERR_VALUE, "first, second: expected two different bodies");              \
        in.other = second_;                                                                        \
    } while (0)

static void joints(void)
{
    const double zero[3] = {0, 0, 0}, oblique[3] = {0, 1, 1};
    pdn_model *const model = in.model;
    const int32_t ground = PDN_GROUND;

#define CALL pdn_model_add_rigid_joint(in.model, in.node, in.other, in.point, &out.id)
    REFUSES_NULL(pdn_model_add_rigid_joint(NULL, NODE(0), NODE(1), in.point, &out.id), "model");
    REFUSES_NULL(pdn_model_add_rigid_joint(model, NODE(0), NODE(1), NULL, &out.id), "point");
    REFUSES_NOT_FINITE_ENTRIES(in.point, LENGTH(in.point), CALL, "point");
    REFUSES_BAD_BODIES(CALL);
    REFUSED(pdn_model_add_rigid_joint(model, ground, ground, in.point, &out.id), PDN_ERR_VALUE,
            "first, second: expected two different bodies, got the ground twice");
#undef CALL

#define CALL pdn_model_add_revolute(in.model, in.node, in.other, in.point, in.axis, &out.id)
    REFUSES_NULL(pdn_model_add_revolute(NULL, NODE(0), NODE(1), in.point, in.axis, &out.id),
                 "model");
    REFUSES_NULL(pdn_model_add_revolute(model, NODE(0), NODE(1), NULL, in.axis, &out.id), "point");
    REFUSES_NULL(pdn_model_add_revolute(model, NODE(0), NODE(1), in.point, NULL, &out.id), "axis");
    REFUSES_NOT_FINITE_ENTRIES(in.point, LENGTH(in.point), CALL, "point");
    REFUSES_NOT_FINITE_ENTRIES(in.axis, LENGTH(in.axis), CALL, "axis");
    REFUSES_BAD_BODIES(CALL);
    REFUSED(pdn_model_add_revolute(model, NODE(0), NODE(1), in.point, zero, &out.id), PDN_ERR_VALUE,
            "axis: expected a vector that is not zero");
#undef CALL

#define CALL pdn_model_add_spherical(in.model, in.node, in.other, in.point, &out.id)
    REFUSES_NULL(pdn_model_add_spherical(NULL, NODE(0), NODE(1), in.point, &out.id), "model");
    REFUSES_NULL(pdn_model_add_spherical(model, NODE(0), NODE(1), NULL, &out.id), "point");
    REFUSES_NOT_FINITE_ENTRIES(in.point, LENGTH(in.point), CALL, "point");
    REFUSES_BAD_BODIES(CALL);
#undef CALL

#define CALL                                                                                       \
    pdn_model_add_universal(in.model, in.node, in.other, in.point, in.axis, in.arm, &out.id)
#define WITH(model, point, first_arm, second_arm, joint)                                           \
    pdn_model_add_universal(model, NODE(0), NODE(1), point, first_arm, second_arm, joint)
    REFUSES_NULL(WITH(NULL, in.point, in.axis, in.arm, &out.id), "model");
    REFUSES_NULL(WITH(model, NULL, in.axis, in.arm, &out.id), "point");
    REFUSES_NULL(WITH(model, in.point, NULL, in.arm, &out.id), "first_arm");
    REFUSES_NULL(WITH(model, in.point, in.axis, NULL, &out.id), "second_arm");
    REFUSES_NOT_FINITE_ENTRIES(in.point, LENGTH(in.point), CALL, "point");
    REFUSES_NOT_FINITE_ENTRIES(in.axis, LENGTH(in.axis), CALL, "first_arm");
    REFUSES_NOT_FINITE_ENTRIES(in.arm, LENGTH(in.arm), CALL, "second_arm");
    REFUSES_BAD_BODIES(CALL);
    REFUSED(WITH(model, in.point, zero, in.arm, &out.id), PDN_ERR_VALUE,
            "first_arm: expected a vector that is not zero");
    REFUSED(WITH(model, in.point, in.axis, zero, &out.id), PDN_ERR_VALUE,
            "second_arm: expected a vector that is not zero");
    REFUSED(WITH(model, in.point, in.axis, oblique, &out.id), PDN_ERR_VALUE,
            "first_arm, second_arm: expected perpendicular arms, got arms at 45.0");
#undef WITH
#undef CALL

#define CALL                                                                                       \
    pdn_model_add_joint(in.model, in.kind, in.node, in.other, &in.frame, &in.second_frame, &out.id)
#define WITH(model, first, second, joint)                                                          \
    pdn_model_add_joint(model, in.kind, NODE(0), NODE(1), first, second, joint)
    REFUSES_NULL(WITH(NULL, &in.frame, &in.second_frame, &out.id), "model");
    REFUSES_NULL(WITH(model, NULL, &in.second_frame, &out.id), "first_frame");
    REFUSES_NULL(WITH(model, &in.frame, NULL, &out.id), "second_frame");
    REFUSES_ENUMS(in.kind, CALL, "kind");
    REFUSES_BAD_FRAMES(in.frame, CALL, "first_frame");
    REFUSES_BAD_FRAMES(in.second_frame, CALL, "second_frame");
    REFUSES_BAD_BODIES(CALL);
#undef WITH
#undef CALL
}

static void forces(void)
{
    pdn_model *const model = in.model;

#define CALL pdn_model_add_spring_damper(in.model, in.joint, in.coordinate, in.number, 0, 0, NULL)
    REFUSES_NULL(pdn_model_add_spring_damper(NULL, JOINT(0), in.coordinate, 1, 0, 0, NULL),
                 "model");
    REFUSES_IDS(in.joint, bad_ids, CALL, "joint");
    REFUSES_ENUMS(in.coordinate, CALL, "coordinate");
    REFUSES_NOT_FINITE(in.number, CALL, "stiffness");
    REFUSES_NOT_FINITE(
        in.number,
        pdn_model_add_spring_damper(model, JOINT(0), in.coordinate, 1, in.number, 0, NULL),
        "damping");
    REFUSES_NOT_FINITE(
        in.number,
        pdn_model_add_spring_damper(model, JOINT(0), in.coordinate, 1, 0, in.number, NULL), "rest");
    REFUSED(pdn_model_add_spring_damper(model, JOINT(0), PDN_ROTATION_2, 1, 0, 0, NULL),
            PDN_ERR_NOT_AVAILABLE, "coordinate: expected one of a revolute joint ");
    REFUSED(pdn_model_add_spring_damper(model, in.rigid, PDN_ROTATION, 1, 0, 0, NULL),
            PDN_ERR_NOT_AVAILABLE, "coordinate: expected one of a rigid joint ");
#undef CALL

#define CALL pdn_model_prescribe(in.model, in.joint, in.coordinate, &in.signal, NULL)
    REFUSES_NULL(pdn_model_prescribe(NULL, JOINT(0), in.coordinate, &in.signal, NULL), "model");
    REFUSES_NULL(pdn_model_prescribe(model, JOINT(0), in.coordinate, NULL, NULL), "signal");
    REFUSES_IDS(in.joint, bad_ids, CALL, "joint");
    REFUSES_ENUMS(in.coordinate, CALL, "coordinate");
    REFUSES_BAD_SIGNALS(CALL);
    REFUSED(pdn_model_prescribe(model, JOINT(0), PDN_ROTATION_3, &in.signal, NULL),
            PDN_ERR_NOT_AVAILABLE, "coordinate: expected one of a revolute joint ");
    CHECK_STATUS(CALL, PDN_OK);
    REFUSED(CALL, PDN_ERR_VALUE, "coordinate: expected one that is not prescribed yet");
#undef CALL

#define CALL pdn_model_add_load(in.model, in.node, in.load_frame, in.component, &in.signal, NULL)
    REFUSES_NULL(pdn_model_add_load(NULL, NODE(0), in.load_frame, in.component, &in.signal, NULL),
                 "model");
    REFUSES_NULL(pdn_model_add_load(model, NODE(0), in.load_frame, in.component, NULL, NULL),
                 "signal");
    REFUSES_IDS(in.node, bad_ids, CALL, "node");
    REFUSES_ENUMS(in.load_frame, CALL, "frame");
    REFUSES_ENUMS(in.component, CALL, "component");
    REFUSES_BAD_SIGNALS(CALL);
#undef CALL

    REFUSES_NULL(pdn_model_set_gravity(NULL, in.point), "model");
    REFUSES_NULL(pdn_model_set_gravity(model, NULL), "acceleration");
    REFUSES_NOT_FINITE_ENTRIES(in.point, LENGTH(in.point),
                               pdn_model_set_gravity(in.model, in.point), "acceleration");
}

int main(void)
{
    set_up();
    sections();
    damping_by_component();
    signals();
    queries();
    nodes_and_masses();
    beams();
    joints();
    forces();
    pdn_model_free(in.model);
    return 0;
}
