/* Every function of lines, stations, beams, and loads and forces along them refuses what it must:
 * it says which argument was wrong, writes nothing, and leaves the model as it was. */
#include "check.h"
#include <math.h>
#include <stddef.h>

/* What the curve does wrong: nothing, or one of these. */
enum { GOOD, FAILS, LEAVES_POSITION, LEAVES_AXIS, CORNER, STANDS_STILL, AXIS_ALONG };

static int32_t curve(double fraction, double *position, double *axis_2, void *user_data)
{
    const int32_t wrong = *(const int32_t *)user_data;
    if (wrong == FAILS) {
        pdn_set_callback_error("no such curve");
        return 7;
    }
    if (wrong != LEAVES_POSITION) {
        position[0] = wrong == STANDS_STILL ? 1 : fraction;
        position[1] = wrong == CORNER ? fabs(fraction - 0.5) : 0;
        position[2] = 0;
    }
    if (wrong != LEAVES_AXIS) {
        axis_2[0] = wrong == AXIS_ALONG;
        axis_2[1] = wrong != AXIS_ALONG;
        axis_2[2] = 0;
    }
    return 0;
}

/* Arguments, each of them good. */
static struct {
    pdn_model *model;
    pdn_line line;
    pdn_stations stations;
    pdn_section sections[4];
    pdn_signal signal;
    double start[3], point[3], end[3], axis[3];
    double fractions[4], twists[4], factors[4];
    size_t elements, degree, count;
    int32_t first_element, loaded, frame, component, wrong;
    int32_t nodes[3];
} in;

/* Where results go; filled with a pattern. */
static struct {
    pdn_beam beam;
    int32_t id;
} out;

/* All that can be seen of the model. */
static struct summary {
    double mass, centre[3];
    int32_t nodes, elements;
} expected;

static void summarise(struct summary *seen)
{
    memset(seen, 0, sizeof *seen);
    CHECK_STATUS(pdn_model_node_count(in.model, &seen->nodes), PDN_OK);
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

#define REFUSES_NULL(call, name) REFUSED(call, PDN_ERR_NULL, name ": expected a pointer, got NULL")

static const size_t bad_struct_sizes[] = {0, 7, 8, 5000, (size_t)-1};
static const int32_t bad_ids[] = {-1, NO_IDS};

#define REFUSES_STRUCT_SIZES(variable, call, name)                                                 \
    REFUSES_EACH(variable.struct_size, size_t, bad_struct_sizes, call, PDN_ERR_STRUCT_SIZE,        \
                 name ": expected struct_size ")
#define REFUSES_ENUMS(variable, call, name)                                                        \
    do {                                                                                           \
        REFUSES_EACH(variable, int32_t, bad_enums, call, PDN_ERR_VALUE, name ": expected ");       \
        REFUSES_OTHER_ROLES(variable, call, name ": expected ");                                   \
    } while (0)

static void set_up(void)
{
    const double stiffness[6] = {9e4, 4e4, 3e4, 3e2, 5e2, 8e2}, mass[4] = {1, 0.1, 0.1, 0.1};
    const double end[3] = {1, 0, 0}, axis[3] = {0, 1, 0}, point[3] = {0.5, 0.2, 0};
    const double fractions[4] = {0, 0.5, 0.5, 1}, factors[4] = {0, 1, 2, 3};
    pdn_beam beam;
    int i;
    memset(&in, 0, sizeof in);
    CHECK_STATUS(pdn_model_new(&in.model), PDN_OK);
    for (i = 0; i < 4; i++) {
        PDN_INIT(pdn_section, &in.sections[i]);
        CHECK_STATUS(pdn_section_set_diagonal(&in.sections[i], stiffness, mass), PDN_OK);
    }
    memcpy(in.end, end, sizeof end);
    memcpy(in.axis, axis, sizeof axis);
    memcpy(in.point, point, sizeof point);
    memcpy(in.fractions, fractions, sizeof fractions);
    memcpy(in.factors, factors, sizeof factors);
    PDN_INIT(pdn_line, &in.line);
    CHECK_STATUS(pdn_line_set_straight(&in.line, in.start, in.end, in.axis), PDN_OK);
    PDN_INIT(pdn_stations, &in.stations);
    in.stations.count = 4;
    in.stations.fractions = in.fractions;
    in.stations.sections = in.sections;
    in.stations.twists = in.twists;
    PDN_INIT(pdn_signal, &in.signal);
    CHECK_STATUS(pdn_signal_set_constant(&in.signal, 1), PDN_OK);
    in.elements = 2;
    in.degree = 3;
    in.count = 4;
    in.first_element = BEAM_ELEMENT(0);
    in.loaded = 2;
    in.frame = PDN_FRAME_SPACE;
    in.component = PDN_FORCE_1;
    CHECK_STATUS(pdn_model_add_beam(in.model, &in.line, &in.stations, 2, 3, &beam), PDN_OK);
    summarise(&expected);
}

static void initialisers(void)
{
    static const size_t sizes[] = {0, 7, 5000, (size_t)-1};
    pdn_line line;
    pdn_stations stations;
    size_t k;
    pdn_line_init(NULL, sizeof line);
    CHECK_MESSAGE("line: expected a pointer, got NULL");
    pdn_stations_init(NULL, sizeof stations);
    CHECK_MESSAGE("stations: expected a pointer, got NULL");
    memset(&line, 0x5a, sizeof line);
    memset(&stations, 0x5a, sizeof stations);
    for (k = 0; k < LENGTH(sizes); k++) {
        pdn_line_init(&line, sizes[k]);
        pdn_stations_init(&stations, sizes[k]);
        CHECK(line.kind == 0x5a5a5a5a && stations.struct_size == (size_t)0x5a5a5a5a5a5a5a5a);
    }
}

static void lines(void)
{
#define CALL pdn_line_set_straight(&in.line, in.start, in.end, in.axis)
    REFUSES_NULL(pdn_line_set_straight(NULL, in.start, in.end, in.axis), "line");
    REFUSES_NULL(pdn_line_set_straight(&in.line, NULL, in.end, in.axis), "start");
    REFUSES_NULL(pdn_line_set_straight(&in.line, in.start, NULL, in.axis), "end");
    REFUSES_NULL(pdn_line_set_straight(&in.line, in.start, in.end, NULL), "axis_2");
    REFUSES_NOT_FINITE_ENTRIES(in.start, 3, CALL, "start");
    REFUSES_NOT_FINITE_ENTRIES(in.end, 3, CALL, "end");
    REFUSES_NOT_FINITE_ENTRIES(in.axis, 3, CALL, "axis_2");
    REFUSES_STRUCT_SIZES(in.line, CALL, "line");
#undef CALL
#define CALL pdn_line_set_arc(&in.line, in.start, in.point, in.end, in.axis)
    REFUSES_NULL(pdn_line_set_arc(NULL, in.start, in.point, in.end, in.axis), "line");
    REFUSES_NULL(pdn_line_set_arc(&in.line, NULL, in.point, in.end, in.axis), "start");
    REFUSES_NULL(pdn_line_set_arc(&in.line, in.start, NULL, in.end, in.axis), "point");
    REFUSES_NULL(pdn_line_set_arc(&in.line, in.start, in.point, NULL, in.axis), "end");
    REFUSES_NULL(pdn_line_set_arc(&in.line, in.start, in.point, in.end, NULL), "axis_2");
    REFUSES_NOT_FINITE_ENTRIES(in.start, 3, CALL, "start");
    REFUSES_NOT_FINITE_ENTRIES(in.point, 3, CALL, "point");
    REFUSES_NOT_FINITE_ENTRIES(in.end, 3, CALL, "end");
    REFUSES_NOT_FINITE_ENTRIES(in.axis, 3, CALL, "axis_2");
    REFUSES_STRUCT_SIZES(in.line, CALL, "line");
#undef CALL
#define CALL pdn_line_set_curve(&in.line, curve, &in.wrong)
    REFUSES_NULL(pdn_line_set_curve(NULL, curve, NULL), "line");
    REFUSES_NULL(pdn_line_set_curve(&in.line, NULL, NULL), "curve");
    REFUSES_STRUCT_SIZES(in.line, CALL, "line");
#undef CALL
}

#define ADD pdn_model_add_beam(in.model, &in.line, &in.stations, in.elements, in.degree, &out.beam)

/* Lines that a beam cannot be made along. */
static void beams_along_lines(void)
{
    static const int32_t one[] = {1};
    const pdn_line good = in.line;
    const struct {
        int32_t wrong;
        pdn_status status;
        const char *message;
    } curves[] = {
        {FAILS, PDN_ERR_CALLBACK, "curve: the callback returned 7: no such curve"},
        {LEAVES_POSITION, PDN_ERR_NOT_FINITE, "line at fraction 0.000000: position[0]: expected a"},
        {LEAVES_AXIS, PDN_ERR_NOT_FINITE,
         "line at fraction 0.000000: axis_2[0]: expected a finite"},
        {CORNER, PDN_ERR_VALUE, "line at fraction 0.500000: expected a smooth line, got a corner"},
        {STANDS_STILL, PDN_ERR_VALUE, "line at fraction 0.000000: expected a line that goes on"},
        {AXIS_ALONG, PDN_ERR_VALUE, "line at fraction 0.000000: axis_2: expected a vector across"},
    };
    size_t k;
    REFUSES_STRUCT_SIZES(in.line, ADD, "line");
    REFUSES_ENUMS(in.line.kind, ADD, "line: kind");
    REFUSES_EACH(in.line.reserved, int32_t, one, ADD, PDN_ERR_VALUE,
                 "line: reserved: expected zero");
    PDN_INIT(pdn_line, &in.line);
    REFUSED(ADD, PDN_ERR_VALUE, "line: end: expected a point away from start");
    CHECK_STATUS(pdn_line_set_straight(&in.line, in.start, in.end, in.end), PDN_OK);
    REFUSED(ADD, PDN_ERR_VALUE, "line: axis_2: expected a vector across the beam, got one along");
    CHECK_STATUS(pdn_line_set_straight(&in.line, in.start, in.end, in.start), PDN_OK);
    REFUSED(ADD, PDN_ERR_VALUE, "line: axis_2: expected a vector that is not zero");

    CHECK_STATUS(pdn_line_set_arc(&in.line, in.start, in.end, in.end, in.axis), PDN_OK);
    REFUSED(ADD, PDN_ERR_VALUE, "line: end: expected a point away from point");
    CHECK_STATUS(pdn_line_set_arc(&in.line, in.start, in.start, in.end, in.axis), PDN_OK);
    REFUSED(ADD, PDN_ERR_VALUE, "line: point: expected a point away from start");
    CHECK_STATUS(pdn_line_set_arc(&in.line, in.start, in.point, in.end, in.axis), PDN_OK);
    in.line.point[1] = 0;
    REFUSED(ADD, PDN_ERR_VALUE, "line: point: expected a point off the line from start to end");
    in.line.point[1] = NAN;
    REFUSED(ADD, PDN_ERR_NOT_FINITE, "line: point[1]: expected a finite number");

    CHECK_STATUS(pdn_line_set_curve(&in.line, curve, &in.wrong), PDN_OK);
    for (k = 0; k < LENGTH(curves); k++) {
        in.wrong = curves[k].wrong;
        REFUSED(ADD, curves[k].status, curves[k].message);
    }
    CHECK(pdn_last_callback_code() == 7);
    in.line.curve = NULL;
    REFUSES_NULL(ADD, "line: curve");
    in.line = good;
    in.wrong = GOOD;
}

static void stations_and_meshes(void)
{
    static const size_t no_counts[] = {0, 100001, (size_t)-1};
    static const size_t bad_elements[] = {0, 1000001, (size_t)-1}, few_elements[] = {1};
    static const size_t bad_degrees[] = {0, 25, (size_t)-1};
    static const double off[] = {0.1, -0.1, 1.5}, back[] = {-0.5, -1e-9};
    static const double turned[] = {0.1};
    static const double not_positive[] = {0.0, -1.0};
    double saved;
    REFUSES_NULL(pdn_model_add_beam(NULL, &in.line, &in.stations, 2, 3, &out.beam), "model");
    REFUSES_NULL(pdn_model_add_beam(in.model, NULL, &in.stations, 2, 3, &out.beam), "line");
    REFUSES_NULL(pdn_model_add_beam(in.model, &in.line, NULL, 2, 3, &out.beam), "stations");
    REFUSES_NULL(pdn_model_add_beam(in.model, &in.line, &in.stations, 2, 3, NULL), "beam");
    REFUSES_STRUCT_SIZES(in.stations, ADD, "stations");
    REFUSES_EACH(in.stations.count, size_t, no_counts, ADD, PDN_ERR_SIZE,
                 "stations: count: expected 1 to ");
    REFUSES_EACH(in.elements, size_t, bad_elements, ADD, PDN_ERR_SIZE, "elements: expected 1 to ");
    REFUSES_EACH(in.elements, size_t, few_elements, ADD, PDN_ERR_SIZE,
                 "elements: expected at least 2, as the section jumps");
    REFUSES_EACH(in.degree, size_t, bad_degrees, ADD, PDN_ERR_SIZE, "degree: expected 1 to 24");

    in.stations.fractions = NULL;
    REFUSES_NULL(ADD, "stations: fractions");
    in.stations.fractions = in.fractions;
    in.stations.sections = NULL;
    REFUSES_NULL(ADD, "stations: sections");
    in.stations.sections = in.sections;
    REFUSES_NOT_FINITE_ENTRIES(in.fractions, 4, ADD, "stations: fractions");
    REFUSES_NOT_FINITE_ENTRIES(in.twists, 4, ADD, "stations: twists");
    REFUSES_EACH(in.fractions[0], double, off, ADD, PDN_ERR_VALUE,
                 "fractions[0]: expected 0 at the start");
    REFUSES_EACH(in.fractions[3], double, off, ADD, PDN_ERR_VALUE,
                 "fractions[3]: expected 1 at the end");
    REFUSES_EACH(in.fractions[1], double, back, ADD, PDN_ERR_VALUE,
                 "fractions[1]: expected at least 0, the one before");
    saved = in.fractions[2];
    in.fractions[2] = in.fractions[1] = 0;
    REFUSED(ADD, PDN_ERR_VALUE, "fractions[1]: expected jumps inside the beam only");
    in.fractions[2] = in.fractions[1] = saved;
    REFUSES_EACH(in.twists[2], double, turned, ADD, PDN_ERR_VALUE,
                 "twists[2]: expected 0 as on the other side of the jump");
    REFUSES_STRUCT_SIZES(in.sections[0], ADD, "stations: sections");
    REFUSES_STRUCT_SIZES(in.sections[2], ADD, "stations: sections[2]");
    REFUSES_EACH(in.sections[2].stiffness[28], double, not_positive, ADD, PDN_ERR_VALUE,
                 "station 2: section stiffness: expected a positive-definite matrix");
    REFUSES_EACH(in.sections[1].mass[0], double, not_finite, ADD, PDN_ERR_NOT_FINITE,
                 "station 1: section mass[0]: expected a finite number");
}

/* The nodes of the beam that is there are 0 to 6; its elements 0 (0 to 3) and 1 (3 to 6). */
static void elements_that_overlap(void)
{
    const struct {
        int32_t nodes[3];
        size_t count;
        const char *message;
    } overlaps[] = {
        {{NODE(1), NODE(2)}, 2, "node 1, inside beam element 0: elements 0 and 2 would overlap"},
        {{NODE(0), NODE(3)},
         2,
         "node 0, where beam element 0 starts, with the same end: elements 0 and 2"},
        {{NODE(0), NODE(3), NODE(6)},
         3,
         "node 3, an end of beam element 0: elements 0 and 2 would overlap"},
        {{NODE(0), NODE(6)},
         2,
         "node 0, which beam element 0 leaves in the same direction: elements 0 and"},
    };
    size_t k;
    for (k = 0; k < LENGTH(overlaps); k++) {
        char start[200];
        snprintf(start, sizeof start,
                 "nodes: expected nodes that share no more than an end with another beam element, "
                 "got %s",
                 overlaps[k].message);
        memcpy(in.nodes, overlaps[k].nodes, sizeof in.nodes);
        REFUSED(pdn_model_add_beam_element(in.model, in.nodes, overlaps[k].count, &in.sections[0],
                                           &out.id),
                PDN_ERR_VALUE, start);
    }
}

static void loads_at_places(void)
{
    static const int32_t bad_counts[] = {0, 3, INT32_MAX};
    static const size_t few[] = {0, 1, (size_t)-1};
    static const double off[] = {0.1, -0.1, 1.5};
    const double zero[3] = {0, 0, 0};
    pdn_signal signals[24];
    int i;
    for (i = 0; i < 24; i++)
        signals[i] = in.signal;
#define WITH(model, axis_2, fractions, signals)                                                    \
    pdn_model_add_load_at_places(model, in.first_element, in.loaded, in.frame, axis_2, fractions,  \
                                 signals, in.count, NULL)
#define CALL WITH(in.model, in.axis, in.fractions, signals)
    REFUSES_NULL(WITH(NULL, in.axis, in.fractions, signals), "model");
    REFUSES_NULL(WITH(in.model, in.axis, NULL, signals), "fractions");
    REFUSES_NULL(WITH(in.model, in.axis, in.fractions, NULL), "signals");
    REFUSES_EACH(in.first_element, int32_t, bad_ids, CALL, PDN_ERR_ID,
                 "first_element: expected a beam element id from 300000000 to 300000001, got ");
    REFUSES_EACH(in.loaded, int32_t, bad_counts, CALL, PDN_ERR_SIZE,
                 "elements: expected 1 to 2 from element 0 on, got ");
    REFUSES_EACH(in.count, size_t, few, CALL, PDN_ERR_SIZE, "count: expected 2 to 100000, got ");
    REFUSES_EACH(in.fractions[0], double, off, CALL, PDN_ERR_VALUE,
                 "fractions[0]: expected 0 at the start");
    REFUSES_NOT_FINITE_ENTRIES(in.fractions, 4, CALL, "fractions");
    REFUSES_STRUCT_SIZES(signals[0], CALL, "signals");
    REFUSES_STRUCT_SIZES(signals[7], CALL, "signals[7]");
    REFUSES_NOT_FINITE(signals[7].mean, CALL, "signals[7]: mean");
    in.frame = PDN_FRAME_FIRST;
    REFUSED(CALL, PDN_ERR_VALUE,
            "frame: expected PDN_FRAME_SPACE, PDN_FRAME_MATERIAL or PDN_FRAME_UNTWISTED, got 1603");
    in.frame = PDN_FRAME_UNTWISTED;
    REFUSES_NULL(WITH(in.model, NULL, in.fractions, signals), "axis_2");
    REFUSES_NOT_FINITE_ENTRIES(in.axis, 3, CALL, "axis_2");
    REFUSED(WITH(in.model, zero, in.fractions, signals), PDN_ERR_VALUE,
            "axis_2: expected a vector that is not zero");
    REFUSED(WITH(in.model, in.end, in.fractions, signals), PDN_ERR_VALUE,
            "axis_2: expected a direction across the beam, all along it, got one along it");
    in.frame = PDN_FRAME_SPACE;
#undef CALL
#undef WITH
}

static void loads(void)
{
    static const int32_t bad_counts[] = {0, 3, INT32_MAX}, negative[] = {-1, INT32_MIN};
    static const double off[] = {0.1, -0.1, 1.5}, back[] = {-0.5, -1e-9};
#define CALL                                                                                       \
    pdn_model_add_distributed_load(in.model, in.first_element, in.loaded, in.frame, in.component,  \
                                   &in.signal, in.fractions, in.factors, in.count, NULL)
#define WITH(model, signal, fractions, factors, count)                                             \
    pdn_model_add_distributed_load(model, BEAM_ELEMENT(0), 2, in.frame, in.component, signal,      \
                                   fractions, factors, count, NULL)
    REFUSES_NULL(WITH(NULL, &in.signal, in.fractions, in.factors, 4), "model");
    REFUSES_NULL(WITH(in.model, NULL, in.fractions, in.factors, 4), "signal");
    REFUSES_NULL(WITH(in.model, &in.signal, NULL, in.factors, 4), "fractions");
    REFUSES_NULL(WITH(in.model, &in.signal, in.fractions, NULL, 4), "factors");
    REFUSED(WITH(in.model, &in.signal, in.fractions, in.factors, 1), PDN_ERR_SIZE,
            "factors: expected none, or at least 2, got 1");
    REFUSED(WITH(in.model, &in.signal, in.fractions, in.factors, (size_t)-1), PDN_ERR_SIZE,
            "fractions: expected at most ");
#undef WITH
    REFUSES_EACH(in.first_element, int32_t, bad_ids, CALL, PDN_ERR_ID,
                 "first_element: expected a beam element id from 300000000 to 300000001, got ");
    REFUSES_EACH(in.loaded, int32_t, bad_counts, CALL, PDN_ERR_SIZE,
                 "elements: expected 1 to 2 from element 0 on, got ");
    REFUSES_EACH(in.loaded, int32_t, negative, CALL, PDN_ERR_SIZE,
                 "elements: expected at least 1, got ");
    REFUSES_ENUMS(in.frame, CALL, "frame");
    REFUSES_ENUMS(in.component, CALL, "component");
    REFUSES_STRUCT_SIZES(in.signal, CALL, "signal");
    REFUSES_NOT_FINITE(in.signal.mean, CALL, "signal: mean");
    REFUSES_NOT_FINITE_ENTRIES(in.fractions, 4, CALL, "fractions");
    REFUSES_NOT_FINITE_ENTRIES(in.factors, 4, CALL, "factors");
    REFUSES_EACH(in.fractions[0], double, off, CALL, PDN_ERR_VALUE,
                 "fractions[0]: expected 0 at the start");
    REFUSES_EACH(in.fractions[3], double, off, CALL, PDN_ERR_VALUE,
                 "fractions[3]: expected 1 at the end");
    REFUSES_EACH(in.fractions[2], double, back, CALL, PDN_ERR_VALUE,
                 "fractions[2]: expected at least 0.5, the one before");
#undef CALL
    loads_at_places();

#define CALL pdn_model_set_gravity_signals(in.model, NULL, &in.signal, NULL)
    REFUSES_NULL(pdn_model_set_gravity_signals(NULL, NULL, NULL, NULL), "model");
    REFUSES_STRUCT_SIZES(in.signal, CALL, "acceleration_2");
    REFUSES_ENUMS(in.signal.kind, CALL, "acceleration_2: kind");
    REFUSES_NOT_FINITE(in.signal.mean, CALL, "acceleration_2: mean");
    REFUSES_NOT_FINITE(in.signal.mean,
                       pdn_model_set_gravity_signals(in.model, &in.signal, NULL, NULL),
                       "acceleration_1: mean");
    REFUSES_NOT_FINITE(in.signal.mean,
                       pdn_model_set_gravity_signals(in.model, NULL, NULL, &in.signal),
                       "acceleration_3: mean");
#undef CALL
}

static int32_t nothing(const pdn_surface_state *state, pdn_surface_values *values, void *user_data)
{
    (void)state, (void)values, (void)user_data;
    return 0;
}

static void forces(void)
{
    static const int32_t bad_counts[] = {0, 3, INT32_MAX}, negative[] = {-1, INT32_MIN};
    int32_t tangents = PDN_TANGENTS_DIFFERENCED;
#define WITH(model, function)                                                                      \
    pdn_model_add_line_force(model, in.first_element, in.loaded, in.frame, NULL, tangents,         \
                             function, NULL, NULL, &out.id)
#define CALL WITH(in.model, nothing)
    REFUSES_NULL(WITH(NULL, nothing), "model");
    REFUSED(WITH(in.model, NULL), PDN_ERR_NULL, "function: expected a ");
    REFUSES_EACH(in.first_element, int32_t, bad_ids, CALL, PDN_ERR_ID,
                 "first_element: expected a beam element id from 300000000 to 300000001, got ");
    REFUSES_EACH(in.loaded, int32_t, bad_counts, CALL, PDN_ERR_SIZE,
                 "elements: expected 1 to 2 from element 0 on, got ");
    REFUSES_EACH(in.loaded, int32_t, negative, CALL, PDN_ERR_SIZE,
                 "elements: expected at least 1, got ");
    REFUSES_ENUMS(in.frame, CALL, "frame");
    REFUSES_ENUMS(tangents, CALL, "tangents");
    in.frame = PDN_FRAME_UNTWISTED;
    REFUSED(CALL, PDN_ERR_NULL, "axis_2: expected a ");
    in.frame = PDN_FRAME_SPACE;
#undef CALL
#undef WITH
}

int main(void)
{
    set_up();
    initialisers();
    lines();
    beams_along_lines();
    stations_and_meshes();
    elements_that_overlap();
    loads();
    forces();
    /* The tables above were gone through. */
    CHECK(refusals >= 270);
    CHECK_STATUS(ADD, PDN_OK);
    pdn_model_free(in.model);
    return 0;
}
