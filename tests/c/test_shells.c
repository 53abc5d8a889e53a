/* Plates and shells as users of C meet them: surfaces, meshes, loads, statics, and closed forms. */
#include "near.h"

static const double THICKNESS = 0.02, YOUNG = 3e6, DENSITY = 1200;

static pdn_shell_section section_of(double poisson)
{
    pdn_shell_section section;
    PDN_INIT(pdn_shell_section, &section);
    CHECK_STATUS(
        pdn_shell_section_set_isotropic(&section, THICKNESS, YOUNG, poisson, DENSITY, 1, 0.1),
        PDN_OK);
    return section;
}

static pdn_surface strip(double length, double width)
{
    const double corner[3] = {0, 0, 0};
    const double along_u[3] = {length, 0, 0}, along_v[3] = {0, width, 0};
    pdn_surface surface;
    PDN_INIT(pdn_surface, &surface);
    CHECK_STATUS(pdn_surface_set_parallelogram(&surface, corner, along_u, along_v), PDN_OK);
    return surface;
}

static double mass_of(const pdn_model *model, double *centre)
{
    double mass;
    CHECK_STATUS(pdn_model_mass(model, &mass, centre), PDN_OK);
    return mass;
}

static void place_of(const pdn_model *model, int32_t node, double *position)
{
    pdn_frame frame;
    CHECK_STATUS(pdn_model_node_frame(model, node, &frame), PDN_OK);
    memcpy(position, frame.position, sizeof frame.position);
}

/* Clamps all nodes where u = 0. */
static void clamp_start(pdn_model *model, const pdn_shell *shell)
{
    int32_t first, joints;
    CHECK_STATUS(pdn_model_add_rigid_edge(model, PDN_GROUND, shell, PDN_SHELL_EDGE_START_XI, &first,
                                          &joints),
                 PDN_OK);
    CHECK(first == JOINT(0) && joints == shell->nodes_v);
}

/* Each edge has its nodes, but for what its body has already; a closed one has each once. */
static void rigid_edges(void)
{
    const double origin[3] = {0, 0, 0}, axis[3] = {0, 0, 1}, start[3] = {1, 0, 0};
    const double inertia[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    const int32_t edges[4] = {PDN_SHELL_EDGE_START_ETA, PDN_SHELL_EDGE_END_XI,
                              PDN_SHELL_EDGE_END_ETA, PDN_SHELL_EDGE_START_XI};
    /* Of 9 x 5 nodes, less the corners that came with the edges before. */
    const int32_t counts[4] = {9, 4, 8, 3}, starts[4][2] = {{0, 0}, {8, 1}, {0, 4}, {0, 1}};
    const pdn_shell_section section = section_of(0.3);
    const pdn_surface flat = strip(2, 1);
    pdn_model *model;
    pdn_surface surface;
    pdn_shell shell, tube;
    pdn_joint_info info;
    int32_t body, first, joints, node, nodes[3], k, total = 0;

    CHECK_STATUS(pdn_model_new(&model), PDN_OK);
    CHECK_STATUS(pdn_model_add_rigid_body(model, 1, origin, inertia, &body), PDN_OK);
    CHECK_STATUS(pdn_model_add_shell(model, &flat, 4, 2, 2, 2, 1, &section, NULL, &shell), PDN_OK);
    for (k = 0; k < 4; k++) {
        CHECK_STATUS(pdn_model_add_rigid_edge(model, body, &shell, edges[k], &first, &joints),
                     PDN_OK);
        CHECK(first == JOINT(total) && joints == counts[k]);
        total += joints;
        PDN_INIT(pdn_joint_info, &info);
        CHECK_STATUS(pdn_model_joint(model, first, &info), PDN_OK);
        CHECK_STATUS(pdn_model_shell_patch_node(model, &shell, starts[k][0], starts[k][1], &node),
                     PDN_OK);
        CHECK(info.kind == PDN_JOINT_RIGID && info.first == body && info.second == node);
    }
    /* A tube about the body: its end is a circle of 12 nodes. */
    PDN_INIT(pdn_surface, &surface);
    CHECK_STATUS(pdn_surface_set_cylinder(&surface, origin, axis, start, 0.4, 1, 2 * PI), PDN_OK);
    CHECK_STATUS(pdn_model_add_shell(model, &surface, 4, 2, 3, 2, 1, &section, NULL, &tube),
                 PDN_OK);
    CHECK_STATUS(
        pdn_model_add_rigid_edge(model, body, &tube, PDN_SHELL_EDGE_END_ETA, &first, &joints),
        PDN_OK);
    CHECK(first == JOINT(total) && joints == 12);
    /* Nodes by their ids; the body is one of them. */
    nodes[0] = body;
    CHECK_STATUS(pdn_model_shell_patch_node(model, &tube, 3, 0, &nodes[1]), PDN_OK);
    CHECK_STATUS(pdn_model_shell_patch_node(model, &tube, 5, 4, &nodes[2]), PDN_OK);
    CHECK_STATUS(pdn_model_add_rigid_joints(model, body, nodes, 3, &first, &joints), PDN_OK);
    CHECK(first == JOINT(total + 12) && joints == 1);
    pdn_model_free(model);
}

/* Mass and centre of what the surfaces describe; the interpolated arcs converge fast. */
static void surfaces(void)
{
    const double origin[3] = {0, 0, 0.3}, axis[3] = {0, 0, 2}, start[3] = {3, 0, 5};
    const double inner = 0.4, outer = 1, angle = PI / 2, length = 0.7, per_area = 1200 * 0.02;
    const pdn_shell_section section = section_of(0.3);
    pdn_model *model;
    pdn_surface surface;
    pdn_shell sector, tube;
    double centre[3], expected, position[3];
    int32_t node, count;

    PDN_INIT(pdn_surface, &surface);
    CHECK_STATUS(pdn_surface_set_annulus(&surface, origin, axis, start, inner, outer, angle),
                 PDN_OK);
    CHECK_STATUS(pdn_model_new(&model), PDN_OK);
    CHECK_STATUS(pdn_model_add_shell(model, &surface, 2, 3, 3, 5, 1, &section, NULL, &sector),
                 PDN_OK);
    CHECK(sector.first_element == SHELL_ELEMENT(0) && sector.elements_u == 2 &&
          sector.elements_v == 3);
    CHECK(sector.nodes_u == 7 && sector.nodes_v == 16);
    CHECK_STATUS(pdn_model_shell_element_count(model, &count), PDN_OK);
    CHECK(count == 6);
    expected = per_area * angle / 2 * (outer * outer - inner * inner);
    CHECK_NEAR(mass_of(model, centre) / expected, 1, 1e-9);
    /* Of a sector: 2/3 sin(a/2)/(a/2) (R^3 - r^3)/(R^2 - r^2) from the centre. */
    expected = 2.0 / 3 * sin(angle / 2) / (angle / 2) * (1 - inner * inner * inner) /
               (1 - inner * inner) / sqrt(2);
    CHECK_NEAR(centre[0], expected, 1e-9);
    CHECK_NEAR(centre[1], expected, 1e-9);
    CHECK_NEAR(centre[2], 0.3, 1e-14);
    CHECK_STATUS(pdn_model_shell_patch_node(model, &sector, 6, 15, &node), PDN_OK);
    place_of(model, node, position);
    CHECK_NEAR(position[0], 0, 1e-15);
    CHECK_NEAR(position[1], 1, 1e-15);

    /* A whole turn closes itself, as joined. */
    CHECK_STATUS(pdn_surface_set_cylinder(&surface, origin, axis, start, inner, length, 2 * PI),
                 PDN_OK);
    CHECK_STATUS(pdn_model_add_shell(model, &surface, 4, 2, 6, 2, 1, &section, NULL, &tube),
                 PDN_OK);
    CHECK(tube.first_element == SHELL_ELEMENT(6) && tube.nodes_u == 25 && tube.nodes_v == 5);
    {
        int32_t first, last, again;
        CHECK_STATUS(pdn_model_shell_patch_node(model, &tube, 0, 3, &first), PDN_OK);
        CHECK_STATUS(pdn_model_shell_patch_node(model, &tube, 24, 3, &last), PDN_OK);
        CHECK(first == last);
        /* The same by the element: its node 1 of 3 along eta, of the second of the first column. */
        CHECK_STATUS(pdn_model_shell_node(model, tube.first_element + 1, 0, 1, &again), PDN_OK);
        CHECK(again == first);
    }
    expected =
        per_area * PI / 4 * (outer * outer - inner * inner) + per_area * 2 * PI * inner * length;
    CHECK_NEAR(mass_of(model, centre) / expected, 1, 1e-9);
    pdn_model_free(model);
}

/* A strip of a quarter cylinder, called as often as there are nodes. */
static int32_t arch(double u, double v, double *position, void *calls)
{
    position[0] = sin(PI / 2 * u);
    position[1] = v;
    position[2] = cos(PI / 2 * u);
    ++*(int32_t *)calls;
    return 0;
}

/* The same shell by a function, over given points, and by cells of nine points. */
static void meshes(void)
{
    enum { POINTS = 9 * 5 };
    const pdn_shell_section section = section_of(0.3);
    pdn_model *models[3];
    pdn_surface surface;
    pdn_shell shell;
    double points[POINTS][3], masses[3], centres[3][3];
    int32_t calls = 0, cells[8][9], node, first, i, j, k, n = 0;

    PDN_INIT(pdn_surface, &surface);
    CHECK_STATUS(pdn_surface_set_function(&surface, arch, &calls), PDN_OK);
    for (k = 0; k < 3; k++)
        CHECK_STATUS(pdn_model_new(&models[k]), PDN_OK);
    CHECK_STATUS(pdn_model_add_shell(models[0], &surface, 4, 2, 2, 2, 1, &section, NULL, &shell),
                 PDN_OK);
    CHECK(calls == POINTS && shell.nodes_u == 9 && shell.nodes_v == 5);
    for (i = 0; i < 9; i++)
        for (j = 0; j < 5; j++) {
            CHECK_STATUS(pdn_model_shell_patch_node(models[0], &shell, i, j, &node), PDN_OK);
            place_of(models[0], node, points[5 * i + j]);
        }
    CHECK_STATUS(pdn_model_add_shell_grid(models[1], points[0], POINTS, 4, 2, 2, 2, 0, &section,
                                          NULL, &shell),
                 PDN_OK);
    for (i = 0; i < 4; i++)
        for (j = 0; j < 2; j++, n++) {
            const int32_t corner = 10 * i + 2 * j;
            /* Corners, middles of sides, centre. */
            const int32_t steps[9] = {0, 10, 12, 2, 5, 11, 7, 1, 6};
            for (k = 0; k < 9; k++)
                cells[n][k] = corner + steps[k];
        }
    CHECK_STATUS(pdn_model_add_shell_quadrilaterals(models[2], points[0], POINTS, cells[0], 72, 9,
                                                    2, &section, NULL, &first),
                 PDN_OK);
    CHECK(first == SHELL_ELEMENT(0));
    for (k = 0; k < 3; k++) {
        int32_t nodes;
        masses[k] = mass_of(models[k], centres[k]);
        CHECK_STATUS(pdn_model_node_count(models[k], &nodes), PDN_OK);
        CHECK(nodes == POINTS);
        CHECK_NEAR(masses[k] / masses[0], 1, 1e-13);
        CHECK_NEAR(centres[k][2], centres[0][2], 1e-13);
    }
    for (k = 0; k < 3; k++)
        pdn_model_free(models[k]);
}

/* Strains, resultants and stresses of a strip under a traction, along its axes and across. */
static void stretched(const pdn_solution *solution, double traction)
{
    const double time = 0, strain = traction / (YOUNG * THICKNESS);
    double values[12];
    pdn_quantity quantity;
    PDN_INIT(pdn_quantity, &quantity);
    quantity.kind = PDN_SHELL_STRAIN;
    quantity.object = SHELL_ELEMENT(1);
    quantity.station = 0.3;
    quantity.station_eta = -0.7;
    CHECK(pdn_quantity_components(&quantity) == 12);
    CHECK_STATUS(pdn_solution_sample(solution, &quantity, &time, 1, values), PDN_OK);
    CHECK_NEAR(values[0], strain, 1e-13);
    CHECK_NEAR(values[7], 0, 1e-13);
    quantity.kind = PDN_SHELL_RESULTANT;
    quantity.direction[1] = 2; /* axis 1 across the strip */
    CHECK_STATUS(pdn_solution_sample(solution, &quantity, &time, 1, values), PDN_OK);
    CHECK_NEAR(values[0], 0, 1e-7);
    CHECK_NEAR(values[7], traction, 1e-7);
    quantity.kind = PDN_SHELL_STRESS_TOP;
    CHECK(pdn_quantity_components(&quantity) == 4);
    CHECK_STATUS(pdn_solution_sample(solution, &quantity, &time, 1, values), PDN_OK);
    CHECK_NEAR(values[1], traction / THICKNESS, 1e-5);
    quantity.kind = PDN_SHELL_STRESS_BOTTOM;
    quantity.component = 3;
    CHECK(pdn_quantity_components(&quantity) == 1);
    CHECK_STATUS(pdn_solution_sample(solution, &quantity, &time, 1, values), PDN_OK);
    CHECK_NEAR(values[0], traction / THICKNESS, 1e-5);

    quantity.station_eta = 1.1;
    CHECK_STATUS(pdn_solution_sample(solution, &quantity, &time, 1, values), PDN_ERR_VALUE);
    CHECK_MESSAGE("quantity.station_eta: expected a number from -1 to 1, got 1.1");
    quantity.station_eta = 0;
    quantity.object = SHELL_ELEMENT(2);
    CHECK_STATUS(pdn_solution_sample(solution, &quantity, &time, 1, values), PDN_ERR_ID);
    quantity.object = SHELL_ELEMENT(0);
    quantity.direction[2] = NAN;
    CHECK_STATUS(pdn_solution_sample(solution, &quantity, &time, 1, values), PDN_ERR_NOT_FINITE);
    CHECK_MESSAGE("quantity.direction[2]: expected a finite number");
}

/* A traction stretches a strip by q L / (E h), as strains are those of Biot. */
static void loads(void)
{
    const double length = 2, width = 0.5, traction = 600;
    const pdn_shell_section section = section_of(0);
    const pdn_surface surface = strip(length, width);
    const double time = 0;
    pdn_model *model;
    pdn_shell shell;
    pdn_signal load;
    pdn_solution *solution;
    double position[3];
    int32_t node;

    CHECK_STATUS(pdn_model_new(&model), PDN_OK);
    CHECK_STATUS(pdn_model_add_shell(model, &surface, 2, 1, 3, 2, 1, &section, NULL, &shell),
                 PDN_OK);
    clamp_start(model, &shell);
    PDN_INIT(pdn_signal, &load);
    CHECK_STATUS(pdn_signal_set_constant(&load, traction), PDN_OK);
    CHECK_STATUS(pdn_model_add_shell_load(model, shell.first_element + 1, 1, PDN_SHELL_EDGE_END_XI,
                                          PDN_FRAME_SPACE, PDN_FORCE_1, &load, NULL),
                 PDN_OK);
    CHECK_STATUS(pdn_solve_static(model, NULL, &solution), PDN_OK);
    CHECK(pdn_solution_outcome(solution) == PDN_CONVERGED);
    CHECK_STATUS(pdn_model_shell_patch_node(model, &shell, 6, 1, &node), PDN_OK);
    CHECK_STATUS(pdn_solution_sample(solution,
                                     PDN_QUANTITY(PDN_NODE_POSITION, node, PDN_ALL_COMPONENTS),
                                     &time, 1, position),
                 PDN_OK);
    CHECK_NEAR(position[0] - length, traction * length / (YOUNG * THICKNESS), 1e-11);
    stretched(solution, traction);
    pdn_solution_free(solution);

    /* The same stress from the beginning shortens it by what the traction makes it longer. */
    {
        double resultants[12] = {0};
        resultants[0] = traction;
        CHECK_STATUS(pdn_model_set_shell_prestress(model, shell.first_element, 2, resultants),
                     PDN_OK);
        CHECK_STATUS(pdn_solve_static(model, NULL, &solution), PDN_OK);
        CHECK_STATUS(pdn_solution_sample(solution,
                                         PDN_QUANTITY(PDN_NODE_POSITION, node, PDN_ALL_COMPONENTS),
                                         &time, 1, position),
                     PDN_OK);
        CHECK_NEAR(position[0], length, 1e-11);
        pdn_solution_free(solution);
    }
    pdn_model_free(model);
}

/* What the function below is told, and whether its data was disposed of. */
struct wind {
    double pressure, drag, area;
    int32_t element, given, calls, destroyed;
    size_t points;
};

/* Pressure, and drag in proportion to the normal velocity, along the axes of the points. */
static int32_t blow(const pdn_surface_state *state, pdn_surface_values *values, void *user_data)
{
    struct wind *wind = user_data;
    size_t k;
    wind->area = 0;
    wind->calls++;
    CHECK(state->struct_size == sizeof *state && values->struct_size == sizeof *values);
    CHECK(state->element == wind->element && state->reserved == 0);
    CHECK(state->point_count == wind->points);
    for (k = 0; k < state->point_count; k++) {
        CHECK(fabs(state->places[2 * k]) < 1 && fabs(state->places[2 * k + 1]) < 1);
        wind->area += state->sizes[k];
        values->forces[6 * k + 2] = wind->pressure - wind->drag * state->velocities[6 * k + 2];
        if (values->by_velocity) {
            CHECK(wind->given);
            values->by_velocity[36 * k + 14] = -wind->drag;
        }
    }
    return 0;
}

static void dispose(void *user_data)
{
    ((struct wind *)user_data)->destroyed++;
}

/* A pressure by a function is the load; drag that damps a plate in proportion to its mass but for
 * rotary inertia shortens no frequency by more than that does. */
static void surface_forces(void)
{
    const pdn_surface surface = strip(2, 0.5);
    const double rate = 0.1, time = 0;
    pdn_shell_section section = section_of(0.3);
    double heights[2], position[3];
    int k;
    for (k = 0; k < 2; k++) {
        struct wind wind = {0.05, 3, 0, SHELL_ELEMENT(1), 0, 0, 0, 9};
        pdn_model *model;
        pdn_shell shell;
        pdn_solution *solution;
        pdn_signal pressure;
        int32_t node, force = -1;
        CHECK_STATUS(pdn_model_new(&model), PDN_OK);
        CHECK_STATUS(pdn_model_add_shell(model, &surface, 2, 1, 2, 2, 1, &section, NULL, &shell),
                     PDN_OK);
        clamp_start(model, &shell);
        if (k == 0) {
            PDN_INIT(pdn_signal, &pressure);
            CHECK_STATUS(pdn_signal_set_constant(&pressure, wind.pressure), PDN_OK);
            CHECK_STATUS(pdn_model_add_shell_load(model, SHELL_ELEMENT(1), 1, PDN_SHELL_SURFACE,
                                                  PDN_FRAME_MATERIAL, PDN_FORCE_3, &pressure, NULL),
                         PDN_OK);
        } else {
            pdn_force_info info;
            pdn_tangent_check check;
            CHECK_STATUS(pdn_model_add_surface_force(model, SHELL_ELEMENT(1), 1, PDN_SHELL_SURFACE,
                                                     PDN_FRAME_MATERIAL, PDN_TANGENTS_DIFFERENCED,
                                                     blow, &wind, dispose, &force),
                         PDN_OK);
            PDN_INIT(pdn_force_info, &info);
            CHECK_STATUS(pdn_model_force(model, force, &info), PDN_OK);
            CHECK(force == FORCE(0) && info.kind == PDN_FORCE_IS_SURFACE_FORCE);
            CHECK(info.shell_element == SHELL_ELEMENT(1) && info.shell_place == PDN_SHELL_SURFACE);
            PDN_INIT(pdn_tangent_check, &check);
            CHECK_STATUS(pdn_model_check_tangents(model, force, 1, &check), PDN_ERR_NOT_AVAILABLE);
            /* The same by a model from a file, to which the function comes back. */
            CHECK_STATUS(pdn_model_save(model, "surface_forces.pdm"), PDN_OK);
            pdn_model_free(model);
            CHECK_STATUS(pdn_model_load("surface_forces.pdm", &model), PDN_OK);
            remove("surface_forces.pdm");
            CHECK_STATUS(pdn_solve_static(model, NULL, &solution), PDN_ERR_CALLBACK);
            CHECK_STATUS(pdn_model_bind_surface_force(model, force, 1, PDN_FRAME_MATERIAL,
                                                      PDN_TANGENTS_DIFFERENCED, blow, &wind, NULL),
                         PDN_OK);
        }
        CHECK_STATUS(pdn_solve_static(model, NULL, &solution), PDN_OK);
        CHECK(pdn_solution_outcome(solution) == PDN_CONVERGED);
        CHECK_STATUS(pdn_model_shell_patch_node(model, &shell, 4, 0, &node), PDN_OK);
        CHECK_STATUS(pdn_solution_sample(solution,
                                         PDN_QUANTITY(PDN_NODE_POSITION, node, PDN_ALL_COMPONENTS),
                                         &time, 1, position),
                     PDN_OK);
        heights[k] = position[2];
        pdn_solution_free(solution);
        pdn_model_free(model);
        CHECK(wind.destroyed == k && (wind.calls > 0) == (k == 1));
        if (k == 1)
            CHECK_NEAR(wind.area, 0.5, 1e-14);
    }
    CHECK(heights[0] > 1e-3);
    CHECK_NEAR(heights[1], heights[0], 1e-12);

    /* Small motions: z'' + rate z' + w^2 z = 0 for all modes, but for rotary inertia, which is
       (h / L)^2 of the mass. */
    {
        struct wind wind = {0, 0, 0, SHELL_ELEMENT(0), 1, 0, 0, 36};
        pdn_modes_options options;
        pdn_modes *modes;
        pdn_model *model;
        pdn_shell shell;
        pdn_mode mode;
        double frequency = 0;
        wind.drag = rate * DENSITY * THICKNESS;
        for (k = 0; k < 2; k++) {
            CHECK_STATUS(pdn_model_new(&model), PDN_OK);
            CHECK_STATUS(
                pdn_model_add_shell(model, &surface, 1, 1, 5, 5, 1, &section, NULL, &shell),
                PDN_OK);
            clamp_start(model, &shell);
            if (k == 1)
                CHECK_STATUS(pdn_model_add_surface_force(
                                 model, SHELL_ELEMENT(0), 1, PDN_SHELL_SURFACE, PDN_FRAME_MATERIAL,
                                 PDN_TANGENTS_GIVEN, blow, &wind, NULL, NULL),
                             PDN_OK);
            PDN_INIT(pdn_modes_options, &options);
            options.count = 1;
            CHECK_STATUS(pdn_solve_modes(model, &options, &modes), PDN_OK);
            PDN_INIT(pdn_mode, &mode);
            CHECK_STATUS(pdn_modes_get(modes, 0, &mode), PDN_OK);
            if (k == 0) {
                frequency = mode.eigenvalue_imaginary;
            } else {
                CHECK_NEAR(mode.eigenvalue_real / (-0.5 * rate), 1, 1e-3);
                CHECK_NEAR(mode.eigenvalue_imaginary /
                               sqrt(frequency * frequency - 0.25 * rate * rate),
                           1, 1e-3);
            }
            pdn_modes_free(modes);
            pdn_model_free(model);
        }
    }
}

/* A moment rolls a clamped strip up to a circle, nearly: the miss is that of the beam. */
static void roll_up(void)
{
    const double length = 12, width = 1, h = 0.1, young = 1.2e6;
    const pdn_surface surface = strip(length, width);
    const double time = 0;
    pdn_model *model;
    pdn_shell shell;
    pdn_shell_section section;
    pdn_shell_placement placement;
    pdn_signal moment;
    pdn_solution *solution;
    pdn_static_options options;
    double tip[3];
    int32_t node;

    PDN_INIT(pdn_shell_section, &section);
    CHECK_STATUS(pdn_shell_section_set_isotropic(&section, h, young, 0, 1, 1, 0.1), PDN_OK);
    PDN_INIT(pdn_shell_placement, &placement);
    CHECK(placement.frames == PDN_SHELL_NORMALS && placement.offset == 0);
    placement.frames = PDN_SHELL_PARALLEL;
    CHECK_STATUS(pdn_model_new(&model), PDN_OK);
    CHECK_STATUS(pdn_model_add_shell(model, &surface, 1, 1, 11, 1, 1, &section, &placement, &shell),
                 PDN_OK);
    clamp_start(model, &shell);
    PDN_INIT(pdn_signal, &moment);
    CHECK_STATUS(pdn_signal_set_constant(&moment, -2 * PI * young * h * h * h / 12 / length),
                 PDN_OK);
    CHECK_STATUS(pdn_model_add_shell_load(model, SHELL_ELEMENT(0), 1, PDN_SHELL_EDGE_END_XI,
                                          PDN_FRAME_MATERIAL, PDN_MOMENT_1, &moment, NULL),
                 PDN_OK);
    PDN_INIT(pdn_static_options, &options);
    options.load_steps = 4;
    CHECK_STATUS(pdn_solve_static(model, &options, &solution), PDN_OK);
    CHECK(pdn_solution_outcome(solution) == PDN_CONVERGED);
    CHECK_STATUS(pdn_model_shell_patch_node(model, &shell, 11, 0, &node), PDN_OK);
    CHECK_STATUS(pdn_solution_sample(solution,
                                     PDN_QUANTITY(PDN_NODE_POSITION, node, PDN_ALL_COMPONENTS),
                                     &time, 1, tip),
                 PDN_OK);
    CHECK_NEAR(sqrt(tip[0] * tip[0] + tip[2] * tip[2]) / length, 1.72955e-8, 1e-11);
    pdn_solution_free(solution);
    pdn_model_free(model);
}

/* A laminate is a matrix that the caller writes; damping is in proportion to it. */
static void sections(void)
{
    pdn_shell_section section = section_of(0.3);
    const double shear = YOUNG / 2 / 1.3, membrane = YOUNG * THICKNESS / (1 - 0.3 * 0.3);
    int i;
    CHECK_NEAR(section.stiffness[0] / membrane, 1, 1e-14);
    CHECK_NEAR(section.stiffness[12 * 7] / membrane, 0.3, 1e-14);
    CHECK_NEAR(section.stiffness[12 * 2 + 2] / (shear * THICKNESS), 5.0 / 6, 1e-14);
    CHECK_NEAR(section.mass[0], DENSITY * THICKNESS, 1e-14);
    CHECK_NEAR(section.mass[35], DENSITY * pow(THICKNESS, 3) / 12, 1e-17);
    CHECK_STATUS(pdn_shell_section_set_proportional_damping(&section, 2e-3), PDN_OK);
    for (i = 0; i < 144; i++)
        CHECK_NEAR(section.damping[i], 2e-3 * section.stiffness[i], 1e-9);
}

int main(void)
{
    surfaces();
    meshes();
    rigid_edges();
    loads();
    surface_forces();
    roll_up();
    sections();
    puts("surfaces, meshes, edges, loads, forces and sections of shells are as they should be");
    return 0;
}
