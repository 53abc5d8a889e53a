/* Every function of surfaces and shells refuses what it must: it says which argument was wrong,
 * writes nothing, and leaves the model as it was. */
#include "check.h"
#include <math.h>

/* What the surface does wrong: nothing, or one of these. */
enum { GOOD, FAILS, LEAVES_POSITION, A_POINT, A_LINE, FOLDS };

static int32_t surface(double u, double v, double *position, void *user_data)
{
    const int32_t wrong = *(const int32_t *)user_data;
    if (wrong == FAILS) {
        pdn_set_callback_error("no such surface");
        return 7;
    }
    if (wrong != LEAVES_POSITION) {
        position[0] = wrong == A_POINT ? 1 : wrong == FOLDS ? u * (1 - u) : u;
        position[1] = wrong == A_POINT || wrong == A_LINE ? 1 : v;
        position[2] = 0;
    }
    return 0;
}

/* Arguments, each of them good. */
static struct {
    pdn_model *model;
    pdn_surface surface;
    pdn_shell_section section;
    pdn_shell_placement placement;
    pdn_shell shell;
    pdn_signal signal;
    double centre[3], axis[3], start[3], radii[2], angle;
    double thickness, young, poisson, density, drilling, gradient, seconds;
    double points[4][3], resultants[12];
    size_t elements_u, elements_v, degree_u, degree_v, count, n_xi, points_of_cell;
    int32_t nodes[4], cells[8];
    int32_t join, first_element, loaded, place, frame, component, wrong, u, v;
} in;

/* Where results go; filled with a pattern. */
static struct {
    pdn_shell shell;
    int32_t id, number;
} out;

/* All that can be seen of the model. */
static struct summary {
    double mass, centre[3];
    int32_t nodes, elements, joints, forces;
} expected;

static void summarise(struct summary *seen)
{
    memset(seen, 0, sizeof *seen);
    CHECK_STATUS(pdn_model_node_count(in.model, &seen->nodes), PDN_OK);
    CHECK_STATUS(pdn_model_shell_element_count(in.model, &seen->elements), PDN_OK);
    CHECK_STATUS(pdn_model_joint_count(in.model, &seen->joints), PDN_OK);
    CHECK_STATUS(pdn_model_force_count(in.model, &seen->forces), PDN_OK);
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

static const size_t bad_struct_sizes[] = {0, 7, 8, 50000, (size_t)-1};
static const int32_t bad_ids[] = {-1, NO_IDS};
static const int32_t one[] = {1};

#define REFUSES_STRUCT_SIZES(variable, call, name)                                                 \
    REFUSES_EACH(variable.struct_size, size_t, bad_struct_sizes, call, PDN_ERR_STRUCT_SIZE,        \
                 name ": expected struct_size ")
#define REFUSES_ENUMS(variable, call, name)                                                        \
    do {                                                                                           \
        REFUSES_EACH(variable, int32_t, bad_enums, call, PDN_ERR_VALUE, name ": expected ");       \
        REFUSES_OTHER_ROLES(variable, call, name ": expected ");                                   \
    } while (0)

/* A model with a shell of 2 x 1 elements of 3 x 3 nodes, at x = 5, and four nodes. */
static void set_up(void)
{
    const double axis[3] = {0, 0, 1}, start[3] = {1, 0, 0}, along_v[3] = {0, 1, 0};
    const double corner[3] = {5, 0, 0}, turn[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    const double points[4][3] = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}};
    const int32_t cells[8] = {0, 2, 3, 1, 0, 2, 3, 1};
    pdn_surface plate;
    int i;
    memset(&in, 0, sizeof in);
    memcpy(in.axis, axis, sizeof axis);
    memcpy(in.start, start, sizeof start);
    memcpy(in.points, points, sizeof points);
    memcpy(in.cells, cells, sizeof cells);
    in.radii[0] = 1;
    in.radii[1] = 2;
    in.angle = 1;
    in.thickness = 0.1;
    in.young = 1e6;
    in.poisson = 0.3;
    in.density = 1000;
    in.drilling = 1;
    in.gradient = 0.1;
    in.elements_u = 2;
    in.elements_v = 1;
    in.degree_u = in.degree_v = 2;
    in.first_element = SHELL_ELEMENT(0);
    in.loaded = 2;
    in.place = PDN_SHELL_SURFACE;
    in.frame = PDN_FRAME_SPACE;
    in.component = PDN_FORCE_1;
    in.n_xi = 2;
    in.points_of_cell = 4;
    in.count = 4;
    CHECK_STATUS(pdn_model_new(&in.model), PDN_OK);
    PDN_INIT(pdn_shell_section, &in.section);
    CHECK_STATUS(pdn_shell_section_set_isotropic(&in.section, 0.1, 1e6, 0.3, 1000, 1, 0.1), PDN_OK);
    PDN_INIT(pdn_shell_placement, &in.placement);
    PDN_INIT(pdn_signal, &in.signal);
    CHECK_STATUS(pdn_signal_set_constant(&in.signal, 1), PDN_OK);
    PDN_INIT(pdn_surface, &plate);
    CHECK_STATUS(pdn_surface_set_parallelogram(&plate, corner, start, along_v), PDN_OK);
    CHECK_STATUS(pdn_model_add_shell(in.model, &plate, 2, 1, 2, 2, 1, &in.section, NULL, &in.shell),
                 PDN_OK);
    for (i = 0; i < 4; i++)
        CHECK_STATUS(pdn_model_add_node(in.model, points[i], turn, &in.nodes[i]), PDN_OK);
    PDN_INIT(pdn_surface, &in.surface);
    CHECK_STATUS(pdn_surface_set_function(&in.surface, surface, &in.wrong), PDN_OK);
    summarise(&expected);
}

static void initialisers(void)
{
    static const size_t sizes[] = {0, 7, 50000, (size_t)-1};
    pdn_surface new_surface;
    pdn_shell_section section;
    pdn_shell_placement placement;
    size_t k;
    pdn_surface_init(NULL, sizeof new_surface);
    CHECK_MESSAGE("surface: expected a pointer, got NULL");
    pdn_shell_section_init(NULL, sizeof section);
    CHECK_MESSAGE("section: expected a pointer, got NULL");
    pdn_shell_placement_init(NULL, sizeof placement);
    CHECK_MESSAGE("placement: expected a pointer, got NULL");
    memset(&new_surface, 0x5a, sizeof new_surface);
    memset(&section, 0x5a, sizeof section);
    memset(&placement, 0x5a, sizeof placement);
    for (k = 0; k < LENGTH(sizes); k++) {
        pdn_surface_init(&new_surface, sizes[k]);
        pdn_shell_section_init(&section, sizes[k]);
        pdn_shell_placement_init(&placement, sizes[k]);
        CHECK(new_surface.kind == 0x5a5a5a5a && placement.frames == 0x5a5a5a5a);
        CHECK(section.struct_size == (size_t)0x5a5a5a5a5a5a5a5a);
    }
}

static void surfaces(void)
{
#define CALL pdn_surface_set_parallelogram(&in.surface, in.centre, in.axis, in.start)
    REFUSES_NULL(pdn_surface_set_parallelogram(NULL, in.centre, in.axis, in.start), "surface");
    REFUSES_NULL(pdn_surface_set_parallelogram(&in.surface, NULL, in.axis, in.start), "corner");
    REFUSES_NULL(pdn_surface_set_parallelogram(&in.surface, in.centre, NULL, in.start), "along_u");
    REFUSES_NULL(pdn_surface_set_parallelogram(&in.surface, in.centre, in.axis, NULL), "along_v");
    REFUSES_NOT_FINITE_ENTRIES(in.centre, 3, CALL, "corner");
    REFUSES_NOT_FINITE_ENTRIES(in.axis, 3, CALL, "along_u");
    REFUSES_NOT_FINITE_ENTRIES(in.start, 3, CALL, "along_v");
    REFUSES_STRUCT_SIZES(in.surface, CALL, "surface");
#undef CALL
#define WITH(function, surface, centre, axis, start)                                               \
    function(surface, centre, axis, start, in.radii[0], in.radii[1], in.angle)
#define REFUSES_OF(function, first, second, origin)                                                \
    REFUSES_NULL(WITH(function, NULL, in.centre, in.axis, in.start), "surface");                   \
    REFUSES_NULL(WITH(function, &in.surface, NULL, in.axis, in.start), origin);                    \
    REFUSES_NULL(WITH(function, &in.surface, in.centre, NULL, in.start), "axis");                  \
    REFUSES_NULL(WITH(function, &in.surface, in.centre, in.axis, NULL), "start");                  \
    REFUSES_NOT_FINITE(in.radii[0], CALL, first);                                                  \
    REFUSES_NOT_FINITE(in.radii[1], CALL, second);                                                 \
    REFUSES_NOT_FINITE(in.angle, CALL, "angle");                                                   \
    REFUSES_NOT_FINITE_ENTRIES(in.centre, 3, CALL, origin);                                        \
    REFUSES_NOT_FINITE_ENTRIES(in.axis, 3, CALL, "axis");                                          \
    REFUSES_NOT_FINITE_ENTRIES(in.start, 3, CALL, "start");                                        \
    REFUSES_STRUCT_SIZES(in.surface, CALL, "surface")
#define CALL WITH(pdn_surface_set_annulus, &in.surface, in.centre, in.axis, in.start)
    REFUSES_OF(pdn_surface_set_annulus, "inner", "outer", "centre");
#undef CALL
#define CALL WITH(pdn_surface_set_cylinder, &in.surface, in.centre, in.axis, in.start)
    REFUSES_OF(pdn_surface_set_cylinder, "radius", "length", "centre");
#undef CALL
#undef WITH
    REFUSES_NULL(pdn_surface_set_function(NULL, surface, NULL), "surface");
    REFUSES_NULL(pdn_surface_set_function(&in.surface, NULL, NULL), "function");
    REFUSES_STRUCT_SIZES(in.surface, pdn_surface_set_function(&in.surface, surface, NULL),
                         "surface");
}

static void sections(void)
{
    static const double not_positive[] = {0.0, -1.0}, negative[] = {-1.0, -1e-300};
    static const double ratios[] = {-1.0, 0.5, 2.0};
#define CALL                                                                                       \
    pdn_shell_section_set_isotropic(&in.section, in.thickness, in.young, in.poisson, in.density,   \
                                    in.drilling, in.gradient)
    REFUSES_NULL(pdn_shell_section_set_isotropic(NULL, 1, 1, 0, 1, 1, 1), "section");
    REFUSES_STRUCT_SIZES(in.section, CALL, "section");
    REFUSES_NOT_FINITE(in.thickness, CALL, "thickness");
    REFUSES_NOT_FINITE(in.poisson, CALL, "poisson");
    REFUSES_EACH(in.thickness, double, not_positive, CALL, PDN_ERR_VALUE, "thickness: expected ");
    REFUSES_EACH(in.young, double, not_positive, CALL, PDN_ERR_VALUE, "young: expected ");
    REFUSES_EACH(in.poisson, double, ratios, CALL, PDN_ERR_VALUE, "poisson: expected ");
    REFUSES_EACH(in.density, double, negative, CALL, PDN_ERR_VALUE, "density: expected ");
    REFUSES_EACH(in.drilling, double, not_positive, CALL, PDN_ERR_VALUE, "drilling: expected ");
    REFUSES_EACH(in.gradient, double, not_positive, CALL, PDN_ERR_VALUE,
                 "drilling_gradient: expected ");
#undef CALL
#define CALL pdn_shell_section_set_proportional_damping(&in.section, in.seconds)
    REFUSES_NULL(pdn_shell_section_set_proportional_damping(NULL, 1), "section");
    REFUSES_STRUCT_SIZES(in.section, CALL, "section");
    REFUSES_NOT_FINITE(in.seconds, CALL, "seconds");
    REFUSES_EACH(in.seconds, double, negative, CALL, PDN_ERR_VALUE, "seconds: expected zero or");
    {
        const pdn_shell_section good = in.section;
        PDN_INIT(pdn_shell_section, &in.section);
        in.seconds = 1;
        REFUSED(CALL, PDN_ERR_VALUE, "shell stiffness: expected ");
        in.section = good;
    }
#undef CALL
}

#define ADD                                                                                        \
    pdn_model_add_shell(in.model, &in.surface, in.elements_u, in.elements_v, in.degree_u,          \
                        in.degree_v, in.join, &in.section, &in.placement, &out.shell)

static void shells_over_surfaces(void)
{
    static const size_t bad_elements[] = {0, 100001, (size_t)-1};
    static const size_t bad_degrees[] = {0, 16, (size_t)-1};
    static const double not_positive[] = {0.0, -1.0};
    const pdn_surface good = in.surface;
    const struct {
        int32_t wrong;
        pdn_status status;
        const char *message;
    } wrongs[] = {
        {FAILS, PDN_ERR_CALLBACK, "function: the callback returned 7: no such surface"},
        {LEAVES_POSITION, PDN_ERR_NOT_FINITE, "surface at (0, 0)[0]: expected a finite"},
        {A_POINT, PDN_ERR_VALUE, "element at 0, 0: "},
        {A_LINE, PDN_ERR_VALUE, "element at 0, 0: "},
    };
    size_t k;
    REFUSES_NULL(
        pdn_model_add_shell(NULL, &in.surface, 1, 1, 2, 2, 0, &in.section, NULL, &out.shell),
        "model");
    REFUSES_NULL(pdn_model_add_shell(in.model, NULL, 1, 1, 2, 2, 0, &in.section, NULL, &out.shell),
                 "surface");
    REFUSES_NULL(pdn_model_add_shell(in.model, &in.surface, 1, 1, 2, 2, 0, NULL, NULL, &out.shell),
                 "section");
    REFUSES_NULL(pdn_model_add_shell(in.model, &in.surface, 1, 1, 2, 2, 0, &in.section, NULL, NULL),
                 "shell");
    REFUSES_STRUCT_SIZES(in.surface, ADD, "surface");
    REFUSES_STRUCT_SIZES(in.section, ADD, "section");
    REFUSES_STRUCT_SIZES(in.placement, ADD, "placement");
    REFUSES_ENUMS(in.surface.kind, ADD, "surface: kind");
    REFUSES_EACH(in.surface.reserved, int32_t, one, ADD, PDN_ERR_VALUE, "surface: reserved: ");
    REFUSES_ENUMS(in.placement.frames, ADD, "placement: frames");
    REFUSES_EACH(in.placement.reserved, int32_t, one, ADD, PDN_ERR_VALUE, "placement: reserved: ");
    REFUSES_NOT_FINITE(in.placement.offset, ADD, "placement: offset");
    REFUSES_NOT_FINITE_ENTRIES(in.placement.direction, 3, ADD, "placement: direction");
    REFUSES_EACH(in.join, int32_t, bad_enums, ADD, PDN_ERR_VALUE, "join: expected ");
    REFUSES_EACH(in.join, int32_t, all_constants, ADD, PDN_ERR_VALUE, "join: expected ");
    REFUSES_EACH(in.elements_u, size_t, bad_elements, ADD, PDN_ERR_SIZE, "elements: expected 1 to");
    REFUSES_EACH(in.elements_v, size_t, bad_elements, ADD, PDN_ERR_SIZE, "elements: expected 1 to");
    REFUSES_EACH(in.degree_u, size_t, bad_degrees, ADD, PDN_ERR_SIZE, "degrees: expected 1 to 15");
    REFUSES_EACH(in.degree_v, size_t, bad_degrees, ADD, PDN_ERR_SIZE, "degrees: expected 1 to 15");
    REFUSES_EACH(in.section.stiffness[13], double, not_positive, ADD, PDN_ERR_VALUE,
                 "shell stiffness: expected a positive-definite");
    for (k = 0; k < LENGTH(wrongs); k++) {
        in.wrong = wrongs[k].wrong;
        REFUSED(ADD, wrongs[k].status, wrongs[k].message);
    }
    in.wrong = FOLDS;
    in.degree_u = 3;
    in.elements_u = 1;
    REFUSED(ADD, PDN_ERR_VALUE, "element at 0, 0: ");
    in.degree_u = in.elements_u = 2;
    in.wrong = GOOD;
    PDN_INIT(pdn_surface, &in.surface);
    REFUSED(ADD, PDN_ERR_VALUE, "surface: along_u: expected a vector that is not zero");
    CHECK_STATUS(pdn_surface_set_parallelogram(&in.surface, in.centre, in.axis, in.axis), PDN_OK);
    REFUSED(ADD, PDN_ERR_VALUE, "surface: along_u, along_v: expected sides that are not parallel");
    CHECK_STATUS(pdn_surface_set_annulus(&in.surface, in.centre, in.axis, in.start, 2, 1, 1),
                 PDN_OK);
    REFUSED(ADD, PDN_ERR_VALUE, "surface: inner radius: expected less than the outer radius, 1");
    CHECK_STATUS(pdn_surface_set_cylinder(&in.surface, in.centre, in.axis, in.axis, 2, 1, 1),
                 PDN_OK);
    REFUSED(ADD, PDN_ERR_VALUE, "surface: start: expected a direction across the axis");
    CHECK_STATUS(pdn_surface_set_cylinder(&in.surface, in.centre, in.axis, in.start, 2, 1, 7),
                 PDN_OK);
    REFUSED(ADD, PDN_ERR_VALUE, "surface: angle: expected an angle other than zero");
    in.surface = good;
    in.surface.function = NULL;
    REFUSES_NULL(ADD, "surface: function");
    in.surface = good;
}

static void shells_over_points(void)
{
    static const size_t counts[] = {0, 3, 5, (size_t)-1}, cells_counts[] = {0, 3, 5};
    static const size_t no_cells[] = {0, 3, 8, (size_t)-1}, bad_degrees[] = {0, 16, (size_t)-1};
    static const int32_t bad_points[] = {-1, 4, INT32_MAX, INT32_MIN};
    static const double moved[] = {-2.0};
    const double *points = in.points[0];
#define GRID(model, points, section, shell)                                                        \
    pdn_model_add_shell_grid(model, points, in.count, 1, 1, 1, 1, in.join, section, &in.placement, \
                             shell)
#define CALL GRID(in.model, points, &in.section, &out.shell)
    REFUSES_NULL(GRID(NULL, points, &in.section, &out.shell), "model");
    REFUSES_NULL(GRID(in.model, NULL, &in.section, &out.shell), "points");
    REFUSES_NULL(GRID(in.model, points, NULL, &out.shell), "section");
    REFUSES_NULL(GRID(in.model, points, &in.section, NULL), "shell");
    REFUSES_EACH(in.count, size_t, counts, CALL, PDN_ERR_SIZE, "count: expected 2 times 2 nodes");
    REFUSES_NOT_FINITE_ENTRIES(in.points[0], 3, CALL, "points");
    REFUSES_EACH(in.points[3][0], double, moved, CALL, PDN_ERR_VALUE, "element at 0, 0: ");
    REFUSES_STRUCT_SIZES(in.section, CALL, "section");
    REFUSES_STRUCT_SIZES(in.placement, CALL, "placement");
    REFUSES_EACH(in.join, int32_t, bad_enums, CALL, PDN_ERR_VALUE, "join: expected ");
    REFUSES_EACH(in.join, int32_t, all_constants, CALL, PDN_ERR_VALUE, "join: expected ");
#undef CALL
    in.degree_u = 1;
#define CELLS(model, points, cells, section, id)                                                   \
    pdn_model_add_shell_quadrilaterals(model, points, 4, cells, in.count, in.points_of_cell,       \
                                       in.degree_u, section, &in.placement, id)
#define CALL CELLS(in.model, points, in.cells, &in.section, &out.id)
    REFUSES_NULL(CELLS(NULL, points, in.cells, &in.section, &out.id), "model");
    REFUSES_NULL(CELLS(in.model, NULL, in.cells, &in.section, &out.id), "points");
    REFUSES_NULL(CELLS(in.model, points, NULL, &in.section, &out.id), "cells");
    REFUSES_NULL(CELLS(in.model, points, in.cells, NULL, &out.id), "section");
    REFUSES_NULL(CELLS(in.model, points, in.cells, &in.section, NULL), "first_element");
    REFUSES_EACH(in.count, size_t, cells_counts, CALL, PDN_ERR_SIZE, "cells: expected one or more");
    REFUSES_EACH(in.points_of_cell, size_t, no_cells, CALL, PDN_ERR_SIZE,
                 "points_of_cell: expected 4 or 9");
    REFUSES_EACH(in.degree_u, size_t, bad_degrees, CALL, PDN_ERR_SIZE, "degree: expected 1 to 15");
    REFUSES_EACH(in.cells[2], int32_t, bad_points, CALL, PDN_ERR_ID,
                 "cells[2]: expected a number of a point from 0 to 3");
    REFUSES_NOT_FINITE_ENTRIES(in.points[0], 3, CALL, "points");
    REFUSES_EACH(in.points[3][0], double, moved, CALL, PDN_ERR_VALUE, "cell 0: ");
    REFUSES_EACH(in.cells[2], int32_t, one, CALL, PDN_ERR_VALUE, "cell 0: ");
    in.count = 8;
    REFUSED(CALL, PDN_ERR_VALUE, "cell 1: nodes: expected nodes that share no more than edges");
    in.count = 4;
#undef CALL
    in.degree_u = 2;
}

static void shells_over_nodes(void)
{
    static const size_t no_rows[] = {0, 3, 5}, one_row[] = {1, 4};
#define WITH(model, nodes, section, id)                                                            \
    pdn_model_add_shell_element(model, nodes, in.count, in.n_xi, section, &in.placement, id)
#define CALL WITH(in.model, in.nodes, &in.section, &out.id)
    REFUSES_NULL(WITH(NULL, in.nodes, &in.section, &out.id), "model");
    REFUSES_NULL(WITH(in.model, NULL, &in.section, &out.id), "nodes");
    REFUSES_NULL(WITH(in.model, in.nodes, NULL, &out.id), "section");
    REFUSES_NULL(WITH(in.model, in.nodes, &in.section, NULL), "element");
    REFUSES_EACH(in.nodes[2], int32_t, bad_ids, CALL, PDN_ERR_ID, "nodes[2]: expected a node id");
    {
        const int32_t twice[] = {in.nodes[1]};
        REFUSES_EACH(in.nodes[2], int32_t, twice, CALL, PDN_ERR_VALUE, "nodes: expected ");
    }
    REFUSES_EACH(in.n_xi, size_t, no_rows, CALL, PDN_ERR_SIZE, "n_xi: expected ");
    REFUSES_EACH(in.n_xi, size_t, one_row, CALL, PDN_ERR_SIZE, "sides: expected 2 to 16");
    {
        /* A bow tie. */
        const int32_t saved = in.nodes[2];
        in.nodes[2] = in.nodes[3];
        in.nodes[3] = saved;
        REFUSED(CALL, PDN_ERR_VALUE, "nodes: expected ");
        in.nodes[3] = in.nodes[2];
        in.nodes[2] = saved;
    }
#undef CALL
#undef WITH
}

static void nodes_of_shells(void)
{
    static const int32_t off[] = {-1, 5, INT32_MAX, INT32_MIN}, off_side[] = {-1, 3, INT32_MAX};
#define CALL pdn_model_shell_patch_node(in.model, &in.shell, in.u, in.v, &out.id)
    REFUSES_NULL(pdn_model_shell_patch_node(NULL, &in.shell, 0, 0, &out.id), "model");
    REFUSES_NULL(pdn_model_shell_patch_node(in.model, NULL, 0, 0, &out.id), "shell");
    REFUSES_NULL(pdn_model_shell_patch_node(in.model, &in.shell, 0, 0, NULL), "node");
    REFUSES_EACH(in.u, int32_t, off, CALL, PDN_ERR_VALUE, "u: expected 0 to 4");
    REFUSES_EACH(in.v, int32_t, off_side, CALL, PDN_ERR_VALUE, "v: expected 0 to 2");
    in.u = 4;
    in.shell.first_element = SHELL_ELEMENT(1);
    REFUSED(CALL, PDN_ERR_VALUE, "shell: expected a shell of this model");
    in.shell.first_element = SHELL_ELEMENT(0);
    in.u = 0;
    REFUSES_EACH(in.shell.first_element, int32_t, bad_ids, CALL, PDN_ERR_ID,
                 "shell: first_element: expected a shell element id");
    in.shell.elements_u = 0;
    REFUSED(CALL, PDN_ERR_VALUE, "shell: elements_u: expected 1 or more");
    in.shell.elements_u = 2;
#undef CALL
#define CALL pdn_model_shell_node(in.model, in.first_element, in.u, in.v, &out.id)
    REFUSES_NULL(pdn_model_shell_node(NULL, SHELL_ELEMENT(0), 0, 0, &out.id), "model");
    REFUSES_NULL(pdn_model_shell_node(in.model, SHELL_ELEMENT(0), 0, 0, NULL), "node");
    REFUSES_EACH(in.first_element, int32_t, bad_ids, CALL, PDN_ERR_ID,
                 "element: expected a shell element id from 400000000 to 400000001");
    REFUSES_EACH(in.u, int32_t, off_side, CALL, PDN_ERR_VALUE, "xi: expected 0 to 2");
    REFUSES_EACH(in.v, int32_t, off_side, CALL, PDN_ERR_VALUE, "eta: expected 0 to 2");
#undef CALL
    REFUSES_NULL(pdn_model_shell_element_count(NULL, &out.id), "model");
    REFUSES_NULL(pdn_model_shell_element_count(in.model, NULL), "count");
}

static void rigid_edges(void)
{
    static const int32_t off[] = {-2, 19, INT32_MAX, INT32_MIN};
    int32_t body = PDN_GROUND, edge = PDN_SHELL_EDGE_END_XI, saved;
    size_t count = 2;
#define WITH(model, shell, first, joints)                                                          \
    pdn_model_add_rigid_edge(model, body, shell, edge, first, joints)
#define CALL WITH(in.model, &in.shell, &out.id, &out.number)
    REFUSES_NULL(WITH(NULL, &in.shell, &out.id, &out.number), "model");
    REFUSES_NULL(WITH(in.model, NULL, &out.id, &out.number), "shell");
    REFUSES_NULL(WITH(in.model, &in.shell, NULL, &out.number), "first_joint");
    REFUSES_NULL(WITH(in.model, &in.shell, &out.id, NULL), "joints");
    REFUSES_EACH(body, int32_t, off, CALL, PDN_ERR_ID, "body: expected ");
    REFUSES_EACH(in.shell.first_element, int32_t, bad_ids, CALL, PDN_ERR_ID,
                 "shell: first_element: expected a shell element id");
    edge = PDN_SHELL_SURFACE;
    REFUSED(CALL, PDN_ERR_VALUE, "edge: expected a constant PDN_SHELL_EDGE_...");
    edge = PDN_SHELL_EDGE_START_XI;
    in.shell.elements_v = 0;
    REFUSED(CALL, PDN_ERR_VALUE, "shell: elements_v: expected 1 or more");
    in.shell.elements_v = 1;
    in.shell.nodes_v = 0;
    REFUSED(CALL, PDN_ERR_VALUE, "v: expected ");
    in.shell.nodes_v = 3;
#undef CALL
#undef WITH
#define WITH(model, nodes, first, joints)                                                          \
    pdn_model_add_rigid_joints(model, body, nodes, count, first, joints)
#define CALL WITH(in.model, in.nodes, &out.id, &out.number)
    REFUSES_NULL(WITH(NULL, in.nodes, &out.id, &out.number), "model");
    REFUSES_NULL(WITH(in.model, NULL, &out.id, &out.number), "nodes");
    REFUSES_NULL(WITH(in.model, in.nodes, NULL, &out.number), "first_joint");
    REFUSES_NULL(WITH(in.model, in.nodes, &out.id, NULL), "joints");
    REFUSES_EACH(body, int32_t, off, CALL, PDN_ERR_ID, "body: expected ");
    REFUSES_EACH(in.nodes[1], int32_t, bad_ids, CALL, PDN_ERR_ID, "nodes[1]: expected ");
    saved = in.nodes[1];
    in.nodes[1] = in.nodes[0];
    REFUSED(CALL, PDN_ERR_VALUE, "nodes: expected distinct nodes");
    in.nodes[1] = saved;
    count = 0;
    REFUSED(CALL, PDN_ERR_SIZE, "count: expected 1 to ");
    count = SIZE_MAX;
    REFUSED(CALL, PDN_ERR_SIZE, "count: expected 1 to ");
    count = 1;
    body = in.nodes[0];
    REFUSED(CALL, PDN_ERR_VALUE, "nodes: expected at least one that is not joined");
#undef CALL
#undef WITH
}

static void loads(void)
{
    static const int32_t bad_counts[] = {0, 3, -1, INT32_MAX, INT32_MIN};
#define WITH(model, signal)                                                                        \
    pdn_model_add_shell_load(model, in.first_element, in.loaded, in.place, in.frame, in.component, \
                             signal, NULL)
#define CALL WITH(in.model, &in.signal)
    REFUSES_NULL(WITH(NULL, &in.signal), "model");
    REFUSES_NULL(WITH(in.model, NULL), "signal");
    REFUSES_EACH(in.first_element, int32_t, bad_ids, CALL, PDN_ERR_ID,
                 "first_element: expected a shell element id from 400000000 to 400000001");
    REFUSES_EACH(in.loaded, int32_t, bad_counts, CALL, PDN_ERR_SIZE, "elements: expected ");
    REFUSES_ENUMS(in.place, CALL, "place");
    REFUSES_ENUMS(in.frame, CALL, "frame");
    REFUSES_ENUMS(in.component, CALL, "component");
    REFUSES_STRUCT_SIZES(in.signal, CALL, "signal");
    REFUSES_NOT_FINITE(in.signal.mean, CALL, "signal: mean");
#undef CALL
#undef WITH
#define CALL pdn_model_set_shell_prestress(in.model, in.first_element, in.loaded, in.resultants)
    REFUSES_NULL(pdn_model_set_shell_prestress(NULL, SHELL_ELEMENT(0), 1, in.resultants), "model");
    REFUSES_NULL(pdn_model_set_shell_prestress(in.model, SHELL_ELEMENT(0), 1, NULL), "resultants");
    REFUSES_EACH(in.first_element, int32_t, bad_ids, CALL, PDN_ERR_ID,
                 "first_element: expected a shell element id from 400000000 to 400000001");
    REFUSES_EACH(in.loaded, int32_t, bad_counts, CALL, PDN_ERR_SIZE, "elements: expected 1 to 2");
    REFUSES_NOT_FINITE_ENTRIES(in.resultants, 12, CALL, "resultants");
#undef CALL
}

static int32_t nothing(const pdn_surface_state *state, pdn_surface_values *values, void *user_data)
{
    (void)state, (void)values, (void)user_data;
    return 0;
}

static void surface_forces(void)
{
    static const int32_t bad_counts[] = {0, 3, -1, INT32_MAX, INT32_MIN};
    int32_t tangents = PDN_TANGENTS_DIFFERENCED;
#define WITH(model, function)                                                                      \
    pdn_model_add_surface_force(model, in.first_element, in.loaded, in.place, in.frame, tangents,  \
                                function, NULL, NULL, &out.id)
#define CALL WITH(in.model, nothing)
    REFUSES_NULL(WITH(NULL, nothing), "model");
    REFUSED(WITH(in.model, NULL), PDN_ERR_NULL, "function: expected a ");
    REFUSES_EACH(in.first_element, int32_t, bad_ids, CALL, PDN_ERR_ID,
                 "first_element: expected a shell element id from 400000000 to 400000001");
    REFUSES_EACH(in.loaded, int32_t, bad_counts, CALL, PDN_ERR_SIZE, "elements: expected ");
    REFUSES_ENUMS(in.place, CALL, "place");
    REFUSES_ENUMS(in.frame, CALL, "frame");
    REFUSES_ENUMS(tangents, CALL, "tangents");
#undef CALL
#undef WITH
}

int main(void)
{
    pdn_shell shell;
    int32_t id;
    set_up();
    initialisers();
    surfaces();
    CHECK_STATUS(pdn_surface_set_function(&in.surface, surface, &in.wrong), PDN_OK);
    sections();
    shells_over_surfaces();
    shells_over_points();
    shells_over_nodes();
    nodes_of_shells();
    rigid_edges();
    loads();
    surface_forces();

    /* What was refused for one wrong argument is accepted without it. */
    CHECK_STATUS(pdn_model_add_shell(in.model, &in.surface, 1, 1, 2, 2, 0, &in.section,
                                     &in.placement, &shell),
                 PDN_OK);
    CHECK_STATUS(pdn_model_add_shell_element(in.model, in.nodes, 4, 2, &in.section, NULL, &id),
                 PDN_OK);
    CHECK(shell.first_element == SHELL_ELEMENT(2) && id == SHELL_ELEMENT(3));
    pdn_model_free(in.model);
    printf("%d refusals, nothing changed\n", refusals);
    return 0;
}
