/* Shells that cannot be, or not as they are meant: refused or warned of, each with the reason. */
#include "check.h"
#include <math.h>

static const double UNTURNED[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};

static pdn_shell_section section_of(double thickness)
{
    pdn_shell_section section;
    PDN_INIT(pdn_shell_section, &section);
    CHECK_STATUS(pdn_shell_section_set_isotropic(&section, thickness, 1e7, 0.3, 1000, 1, 0.1),
                 PDN_OK);
    return section;
}

static int32_t node_at(pdn_model *model, double x, double y, double z)
{
    const double place[3] = {x, y, z};
    int32_t node;
    CHECK_STATUS(pdn_model_add_node(model, place, UNTURNED, &node), PDN_OK);
    return node;
}

/* A model of nodes in rows of three, two of which a square takes. */
static pdn_model *square(int32_t *nodes)
{
    const pdn_shell_section section = section_of(0.01);
    pdn_model *model;
    int32_t element, k;
    CHECK_STATUS(pdn_model_new(&model), PDN_OK);
    for (k = 0; k < 6; k++)
        nodes[k] = node_at(model, k / 2, k % 2, 0);
    CHECK_STATUS(pdn_model_add_shell_element(model, nodes, 4, 2, &section, NULL, &element), PDN_OK);
    CHECK(element == SHELL_ELEMENT(0));
    return model;
}

static void refuses(pdn_model *model, const int32_t *nodes, size_t count, size_t rows,
                    const char *reason)
{
    const pdn_shell_section section = section_of(0.01);
    int32_t element = 77, elements;
    CHECK_STATUS(pdn_model_add_shell_element(model, nodes, count, rows, &section, NULL, &element),
                 PDN_ERR_VALUE);
    CHECK_MESSAGE("nodes: expected ");
    CHECK_MESSAGE(reason);
    CHECK_STATUS(pdn_model_shell_element_count(model, &elements), PDN_OK);
    CHECK(element == 77 && elements == 1);
}

static void overlapping_and_inverted(void)
{
    int32_t n[6], row[9], k, element;
    pdn_model *model = square(n);
    {
        const int32_t other_order[4] = {n[2], n[0], n[3], n[1]};
        const int32_t longer[4] = {n[0], n[1], n[4], n[5]};
        const int32_t over_both[6] = {n[0], n[2], n[4], n[1], n[3], n[5]};
        const int32_t bow_tie[4] = {n[2], n[5], n[4], n[3]}, twice[4] = {n[2], n[3], n[4], n[4]};
        refuses(model, n, 4, 2, "on the same side of which shell element 0 lies");
        refuses(model, other_order, 4, 2, "elements 0 and 1 would overlap");
        refuses(model, longer, 4, 2, "elements 0 and 1 would overlap");
        refuses(model, over_both, 6, 2, "overlap");
        refuses(model, bow_tie, 4, 2, "it is inverted, folded, or turns too much");
        refuses(model, twice, 4, 2, "twice");
    }
    /* Rows out of order: the surface turns over between them. */
    for (k = 0; k < 9; k++) {
        static const double order[3] = {0, 1, 0.5};
        row[k] = node_at(model, 5 + order[k / 3], k % 3, 0);
    }
    refuses(model, row, 9, 3, "it is inverted, folded, or turns too much");
    {
        /* In order, it is taken, and no other on a node inside it. */
        const pdn_shell_section section = section_of(0.01);
        const int32_t good[9] = {row[0], row[1], row[2], row[6], row[7],
                                 row[8], row[3], row[4], row[5]};
        int32_t inside[4] = {n[4], n[5], row[0], row[7]};
        CHECK_STATUS(pdn_model_add_shell_element(model, good, 9, 3, &section, NULL, &element),
                     PDN_OK);
        element = 77;
        CHECK_STATUS(pdn_model_add_shell_element(model, inside, 4, 2, &section, NULL, &element),
                     PDN_ERR_VALUE);
        CHECK_MESSAGE("inside shell element 1");
        CHECK(element == 77);
    }
    pdn_model_free(model);
}

/* Nodes on a line, and a triangle, whose sides meet at no angle at one corner. */
static void normals_that_vanish(void)
{
    int32_t n[6], line[4], k, cells[4] = {0, 1, 2, 3};
    const double triangle[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0.5, 0.5, 0}};
    const double collapsed[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, 0}};
    const pdn_shell_section section = section_of(0.01);
    pdn_model *model = square(n);
    for (k = 0; k < 4; k++)
        line[k] = node_at(model, 3 + k, 0, 0);
    refuses(model, line, 4, 2, "a normal at each, got one that vanishes at node 0");
    for (k = 0; k < 2; k++) {
        int32_t first = 77;
        CHECK_STATUS(pdn_model_add_shell_quadrilaterals(model, k == 0 ? triangle[0] : collapsed[0],
                                                        4, cells, 4, 4, 3, &section, NULL, &first),
                     PDN_ERR_VALUE);
        CHECK_MESSAGE("cell 0: nodes: expected nodes in rows that span a surface, with a normal");
        CHECK_MESSAGE("vanishes at node");
        CHECK(first == 77);
    }
    pdn_model_free(model);
}

/* Whether the description has the text; the summary counts as many warnings as it has. */
static int describes(const pdn_model *model, const char *text)
{
    char description[8192];
    const char *at = description;
    pdn_summary summary;
    int32_t warnings = 0;
    CHECK(pdn_model_describe(model, description, sizeof description) < sizeof description);
    while ((at = strstr(at, "warning: ")) != NULL) {
        at++;
        warnings++;
    }
    PDN_INIT(pdn_summary, &summary);
    CHECK_STATUS(pdn_model_summary(model, &summary), PDN_OK);
    CHECK(summary.warnings == warnings);
    return strstr(description, text) != NULL;
}

static void clamp(pdn_model *model, const pdn_shell *shell)
{
    int32_t first, joints;
    CHECK_STATUS(pdn_model_add_rigid_edge(model, PDN_GROUND, shell, PDN_SHELL_EDGE_START_XI, &first,
                                          &joints),
                 PDN_OK);
}

/* A strip that is twisted by a right angle. */
static int32_t twisted(double u, double v, double *position, void *user_data)
{
    (void)user_data;
    position[0] = 12 * u;
    position[1] = 1.1 * (v - 0.5) * cos(1.5707963267948966 * u);
    position[2] = 1.1 * (v - 0.5) * sin(1.5707963267948966 * u);
    return 0;
}

static void thin_and_warped(void)
{
    static const struct {
        double thickness;
        size_t degree;
        int32_t frames, locks;
    } cases[] = {
        {0.0032, 1, PDN_SHELL_PARALLEL, 1},
        {0.32, 1, PDN_SHELL_PARALLEL, 0},
        {0.0032, 2, PDN_SHELL_PARALLEL, 0},
        {0.0032, 1, PDN_SHELL_NORMALS, 0},
    };
    size_t k;
    for (k = 0; k < sizeof cases / sizeof *cases; k++) {
        const pdn_shell_section section = section_of(cases[k].thickness);
        pdn_shell_placement placement;
        pdn_surface surface;
        pdn_shell shell;
        pdn_model *model;
        PDN_INIT(pdn_surface, &surface);
        CHECK_STATUS(pdn_surface_set_function(&surface, twisted, NULL), PDN_OK);
        PDN_INIT(pdn_shell_placement, &placement);
        placement.frames = cases[k].frames;
        CHECK_STATUS(pdn_model_new(&model), PDN_OK);
        CHECK_STATUS(pdn_model_add_shell(model, &surface, 12, 2, cases[k].degree, cases[k].degree,
                                         1, &section, &placement, &shell),
                     PDN_OK);
        clamp(model, &shell);
        CHECK(describes(model,
                        "thin and warped, with two nodes a side, which is far too stiff: "
                        "take three or more nodes a side, or smaller elements") == cases[k].locks);
        CHECK(describes(model, "warning: ") == cases[k].locks);
        pdn_model_free(model);
    }
}

/* A clamped plate, and the node in the middle of its other end. */
static pdn_model *plate(pdn_shell *shell, int32_t *middle, double *place)
{
    const double corner[3] = {0, 0, 0}, along_u[3] = {2, 0, 0}, along_v[3] = {0, 1, 0};
    const pdn_shell_section section = section_of(0.02);
    pdn_surface surface;
    pdn_model *model;
    pdn_frame frame;
    PDN_INIT(pdn_surface, &surface);
    CHECK_STATUS(pdn_surface_set_parallelogram(&surface, corner, along_u, along_v), PDN_OK);
    CHECK_STATUS(pdn_model_new(&model), PDN_OK);
    CHECK_STATUS(pdn_model_add_shell(model, &surface, 2, 2, 2, 2, 1, &section, NULL, shell),
                 PDN_OK);
    clamp(model, shell);
    CHECK_STATUS(pdn_model_shell_patch_node(model, shell, 4, 2, middle), PDN_OK);
    CHECK_STATUS(pdn_model_node_frame(model, *middle, &frame), PDN_OK);
    memcpy(place, frame.position, sizeof frame.position);
    return model;
}

static const char ALONE[] = "a couple about the normal of a shell acts on node";

static void load(pdn_model *model, int32_t node, int32_t component)
{
    pdn_signal signal;
    PDN_INIT(pdn_signal, &signal);
    CHECK_STATUS(pdn_signal_set_constant(&signal, 1), PDN_OK);
    CHECK_STATUS(pdn_model_add_load(model, node, PDN_FRAME_SPACE, component, &signal, NULL),
                 PDN_OK);
}

static void couples_of_loads(void)
{
    pdn_shell shell;
    double place[3];
    int32_t middle, beside, far;
    char text[256];
    pdn_model *model = plate(&shell, &middle, place);
    load(model, middle, PDN_FORCE_3);
    load(model, middle, PDN_MOMENT_2);
    CHECK(!describes(model, "warning: "));
    load(model, middle, PDN_MOMENT_3);
    snprintf(text, sizeof text,
             "%s %d alone: the turn there grows without bound as the mesh becomes finer; join an "
             "edge, or several nodes",
             ALONE, middle - NODE(0));
    CHECK(describes(model, text));
    /* Of two far from each other each is alone, of neighbours neither. */
    CHECK_STATUS(pdn_model_shell_patch_node(model, &shell, 1, 0, &far), PDN_OK);
    load(model, far, PDN_MOMENT_3);
    CHECK(describes(model, ALONE));
    CHECK_STATUS(pdn_model_shell_patch_node(model, &shell, 4, 1, &beside), PDN_OK);
    load(model, beside, PDN_MOMENT_3);
    snprintf(text, sizeof text, "%s %d alone", ALONE, far - NODE(0));
    CHECK(describes(model, text));
    pdn_model_free(model);
}

enum { RIGID, ACROSS, ALONG, MOTOR, SOFT, TWO_NODES };

/* Joins a body to the middle of the end, or to two nodes there. */
static int joint_is_warned_of(int kind)
{
    const double inertia[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    const double normal[3] = {0, 0, 1}, across[3] = {0, 1, 0};
    double place[3], stiffness[36] = {0};
    pdn_shell shell;
    pdn_signal swing;
    pdn_frame frames[2];
    int32_t middle, body, joint, other, k, warned;
    pdn_model *model = plate(&shell, &middle, place);
    CHECK_STATUS(pdn_model_add_rigid_body(model, 1, place, inertia, &body), PDN_OK);
    switch (kind) {
    case SOFT:
        for (k = 0; k < 6; k++)
            stiffness[7 * k] = 10;
        for (k = 0; k < 2; k++) {
            CHECK_STATUS(pdn_model_node_frame(model, k == 0 ? body : middle, &frames[k]), PDN_OK);
        }
        CHECK_STATUS(pdn_model_add_bushing(model, body, middle, &frames[0], &frames[1], stiffness,
                                           stiffness, PDN_ANGLES_ROTATION_VECTOR, NULL),
                     PDN_OK);
        break;
    case ACROSS:
        CHECK_STATUS(pdn_model_add_revolute(model, body, middle, place, across, &joint), PDN_OK);
        break;
    case ALONG:
    case MOTOR:
        CHECK_STATUS(pdn_model_add_revolute(model, body, middle, place, normal, &joint), PDN_OK);
        break;
    default:
        CHECK_STATUS(pdn_model_add_rigid_joint(model, body, middle, place, &joint), PDN_OK);
    }
    if (kind == MOTOR) {
        PDN_INIT(pdn_signal, &swing);
        CHECK_STATUS(pdn_signal_set_constant(&swing, 0), PDN_OK);
        CHECK_STATUS(pdn_model_prescribe(model, joint, PDN_ROTATION, &swing, NULL), PDN_OK);
    }
    if (kind == TWO_NODES) {
        CHECK_STATUS(pdn_model_shell_patch_node(model, &shell, 4, 3, &other), PDN_OK);
        CHECK_STATUS(pdn_model_add_rigid_joint(model, body, other, place, &joint), PDN_OK);
    }
    warned = describes(model, ALONE);
    CHECK(warned == describes(model, "warning: "));
    pdn_model_free(model);
    return warned;
}

static void couples_of_joints(void)
{
    CHECK(joint_is_warned_of(RIGID));
    CHECK(joint_is_warned_of(ACROSS));
    CHECK(!joint_is_warned_of(ALONG));
    CHECK(joint_is_warned_of(MOTOR));
    CHECK(joint_is_warned_of(SOFT));
    CHECK(!joint_is_warned_of(TWO_NODES));
}

/* A beam that butts on one node of a plate. */
static void couples_of_beams(void)
{
    const double stiffness[6] = {1e6, 1e6, 1e6, 1e3, 1e3, 1e3}, mass[4] = {1, 1e-3, 1e-3, 1e-3};
    /* Axis 1 along the beam, whose direction is the normal. */
    const double turn[9] = {0, 0, 1, 1, 0, 0, 0, 1, 0};
    const pdn_shell_section thin = section_of(0.02);
    pdn_section section;
    pdn_model *model;
    int32_t nodes[4], beam[2], element, joint, k;
    CHECK_STATUS(pdn_model_new(&model), PDN_OK);
    for (k = 0; k < 5; k++) {
        const double place[3] = {k / 2 % 2, k % 2, k / 4};
        CHECK_STATUS(pdn_model_add_node(model, place, turn, k < 4 ? &nodes[k] : &beam[1]), PDN_OK);
    }
    CHECK_STATUS(pdn_model_add_shell_element(model, nodes, 4, 2, &thin, NULL, &element), PDN_OK);
    for (k = 2; k < 4; k++) {
        const double place[3] = {1, k % 2, 0};
        CHECK_STATUS(pdn_model_add_rigid_joint(model, PDN_GROUND, nodes[k], place, &joint), PDN_OK);
    }
    PDN_INIT(pdn_section, &section);
    CHECK_STATUS(pdn_section_set_diagonal(&section, stiffness, mass), PDN_OK);
    beam[0] = nodes[0];
    CHECK_STATUS(pdn_model_add_beam_element(model, beam, 2, &section, &element), PDN_OK);
    CHECK(describes(model, ALONE));
    pdn_model_free(model);
}

/* Adds a plate of a unit square, from a corner, turned about axis 3 and lifted. */
static void add_plate(pdn_model *model, double x, double z, double turn, pdn_shell *shell)
{
    const pdn_shell_section section = section_of(0.02);
    const double corner[3] = {x, 0, z};
    const double along_u[3] = {cos(turn), sin(turn), 0}, along_v[3] = {-sin(turn), cos(turn), 0};
    pdn_surface surface;
    PDN_INIT(pdn_surface, &surface);
    CHECK_STATUS(pdn_surface_set_parallelogram(&surface, corner, along_u, along_v), PDN_OK);
    CHECK_STATUS(pdn_model_add_shell(model, &surface, 1, 1, 2, 2, 1, &section, NULL, shell),
                 PDN_OK);
    clamp(model, shell);
}

/* Two plates on each other in part, and beside each other: a patch is joined to those that it
   meets, and one that is there already is refused. */
static void patches_that_overlap(void)
{
    static const struct {
        double x, z, turn;
        int32_t overlap;
    } cases[] = {
        {0.4, 0, 0, 1},
        {0.4, 0, 0.7, 1},
        /* Layers, side by side, and along a common edge. */
        {0.4, 0.02, 0, 0},
        {1.01, 0, 0, 0},
        {1, 0, 0, 0},
    };
    size_t k;
    for (k = 0; k < sizeof cases / sizeof *cases; k++) {
        pdn_shell first, second;
        pdn_model *model;
        CHECK_STATUS(pdn_model_new(&model), PDN_OK);
        add_plate(model, 0, 0, 0, &first);
        add_plate(model, cases[k].x, cases[k].z, cases[k].turn, &second);
        CHECK(describes(model, "shell elements 0 and 1 lie on each other: mass") ==
              cases[k].overlap);
        CHECK(describes(model, "warning: ") == cases[k].overlap);
        pdn_model_free(model);
    }
}

/* Elements with nodes of their own along a common edge, or all at the same places. */
static void elements_that_are_not_joined(void)
{
    int32_t first;
    for (first = 0; first < 2; first++) {
        const pdn_shell_section section = section_of(0.01);
        int32_t n[6], own[4], k, element;
        pdn_model *model = square(n);
        for (k = 0; k < 4; k++)
            own[k] = node_at(model, first + k / 2, k % 2, 0);
        CHECK_STATUS(pdn_model_add_shell_element(model, own, 4, 2, &section, NULL, &element),
                     PDN_OK);
        CHECK(describes(model, "shell elements 0 and 1 lie on each other: mass") == (first == 0));
        CHECK(describes(model, "of shells are at the same places as others, but not all connected "
                               "there: are patches to be joined along edges"));
        pdn_model_free(model);
    }
}

/* A patch beside another, with so many elements along the common edge, from v on. */
static pdn_model *beside(size_t elements, double v, int32_t held)
{
    const pdn_shell_section section = section_of(0.01);
    const double corner[2][3] = {{0, 0, 0}, {1, v, 0}};
    const double along_u[3] = {1, 0, 0}, along_v[3] = {0, 1, 0};
    pdn_shell shells[2];
    pdn_model *model;
    int k;
    CHECK_STATUS(pdn_model_new(&model), PDN_OK);
    for (k = 0; k < 2; k++) {
        pdn_surface surface;
        PDN_INIT(pdn_surface, &surface);
        CHECK_STATUS(pdn_surface_set_parallelogram(&surface, corner[k], along_u, along_v), PDN_OK);
        CHECK_STATUS(pdn_model_add_shell(model, &surface, 1, k == 0 ? 2 : elements, 2, 2, 1,
                                         &section, NULL, &shells[k]),
                     PDN_OK);
    }
    clamp(model, &shells[0]);
    if (held) {
        int32_t first, joints;
        CHECK_STATUS(pdn_model_add_rigid_edge(model, PDN_GROUND, &shells[0], PDN_SHELL_EDGE_END_XI,
                                              &first, &joints),
                     PDN_OK);
        CHECK_STATUS(pdn_model_add_rigid_edge(model, PDN_GROUND, &shells[1],
                                              PDN_SHELL_EDGE_START_XI, &first, &joints),
                     PDN_OK);
    }
    return model;
}

/* Edges that meet are joined by common nodes alone: others come apart, unless they are held. */
static void edges_that_do_not_match(void)
{
    static const struct {
        double v;
        size_t elements;
        int32_t held, comes_apart;
    } cases[] = {{0, 2, 0, 0}, {0, 3, 0, 1}, {0, 3, 1, 0}, {0.1, 2, 0, 1}, {1, 2, 0, 0}};
    size_t k;
    for (k = 0; k < sizeof cases / sizeof *cases; k++) {
        pdn_model *model = beside(cases[k].elements, cases[k].v, cases[k].held);
        CHECK(describes(model, "shell elements 0 and 2 meet along edges") == cases[k].comes_apart);
        CHECK(describes(model, "there they come apart; give both edges the same elements and "
                               "nodes") == cases[k].comes_apart);
        CHECK(describes(model, "warning: ") == cases[k].comes_apart);
        pdn_model_free(model);
    }
}

int main(void)
{
    overlapping_and_inverted();
    patches_that_overlap();
    edges_that_do_not_match();
    elements_that_are_not_joined();
    normals_that_vanish();
    thin_and_warped();
    couples_of_loads();
    couples_of_joints();
    couples_of_beams();
    puts("bad shells: refused or warned of, each with its reason");
    return 0;
}
