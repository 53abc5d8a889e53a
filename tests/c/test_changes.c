/* Changes of what a model holds, and functions that come back to a model from a file: what they do
 * to motions, and calls that must be refused. */
#include "near.h"
#include <stdio.h>

enum { POINTS = 15, TIMES = 4, FORCES = 4 };

static const double PERIOD = 2, times[TIMES] = {0.0, 0.31, 0.9, 1.7};
/* Stiffness of the law, drag, amplitude of the push. */
static double numbers[3] = {4.0, 0.5, 0.3};

static struct {
    pdn_model *model;
    int32_t force, number, id, component, first_element, elements, frame, tangents, count;
    double values[2];
    pdn_signal signal;
    pdn_section section;
    pdn_coordinate_law_fn law;
    pdn_user_force_fn drag;
    pdn_surface_force_fn pressure;
} in;
static struct {
    int32_t nothing;
} out;

static int model_changed(void)
{
    double stiffness;
    CHECK_STATUS(pdn_model_force_number(in.model, FORCE(3), PDN_NUMBER_STIFFNESS, 0, &stiffness),
                 PDN_OK);
    return stiffness != 2;
}

#include "refusal.h"

static int32_t law(double time, double coordinate, double rate, double *effort, double *derivatives,
                   void *user_data)
{
    const double stiffness = *(const double *)user_data;
    (void)time, (void)rate;
    *effort = stiffness * coordinate;
    if (derivatives != NULL) {
        derivatives[0] = stiffness;
        derivatives[1] = 0;
    }
    return 0;
}

static int32_t drag(const pdn_force_state *state, pdn_force_values *values, void *user_data)
{
    int i;
    for (i = 0; i < 3; ++i)
        values->forces[i] = -*(const double *)user_data * state->velocities[i];
    return 0;
}

static int32_t pressure(const pdn_surface_state *state, pdn_surface_values *values, void *user_data)
{
    (void)state, (void)values, (void)user_data;
    return 0;
}

static int32_t push(double time, double *value, void *user_data)
{
    *value = *(const double *)user_data * cos(6.283185307179586 / PERIOD * time);
    return 0;
}

static void destroyed(void *user_data)
{
    ++*(int *)user_data;
}

/* A body on a slide, held by a law, a drag and a spring, and pushed. */
static pdn_model *build(double spring)
{
    const double centre[3] = {0}, moments[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1}, axis[3] = {1, 0, 0};
    pdn_signal signal;
    pdn_model *model;
    int32_t body, joint;
    CHECK_STATUS(pdn_model_new(&model), PDN_OK);
    CHECK_STATUS(pdn_model_add_rigid_body(model, 1, centre, moments, &body), PDN_OK);
    CHECK_STATUS(pdn_model_add_prismatic(model, PDN_GROUND, body, centre, axis, &joint), PDN_OK);
    CHECK_STATUS(pdn_model_add_coordinate_law(model, joint, PDN_DISPLACEMENT, PDN_TANGENTS_GIVEN,
                                              law, &numbers[0], NULL, NULL),
                 PDN_OK);
    CHECK_STATUS(pdn_model_add_user_force(model, &body, 1, PDN_FRAME_SPACE,
                                          PDN_TANGENTS_DIFFERENCED, drag, &numbers[1], NULL, NULL),
                 PDN_OK);
    PDN_INIT(pdn_signal, &signal);
    CHECK_STATUS(pdn_signal_set_function(&signal, push, &numbers[2]), PDN_OK);
    CHECK_STATUS(pdn_model_add_actuator(model, joint, PDN_DISPLACEMENT, &signal, NULL), PDN_OK);
    CHECK_STATUS(pdn_model_add_spring_damper(model, joint, PDN_DISPLACEMENT, spring, 0.1, 0, NULL),
                 PDN_OK);
    return model;
}

static void solve(const pdn_model *model, double *positions)
{
    pdn_periodic_options options;
    pdn_solution *solution;
    PDN_INIT(pdn_periodic_options, &options);
    options.grid_points = POINTS;
    CHECK_STATUS(pdn_solve_periodic(model, PERIOD, &options, &solution), PDN_OK);
    CHECK(pdn_solution_outcome(solution) == PDN_CONVERGED);
    CHECK_STATUS(pdn_solution_sample(solution,
                                     PDN_QUANTITY(PDN_NODE_POSITION, NODE(0), PDN_ALL_COMPONENTS),
                                     times, TIMES, positions),
                 PDN_OK);
    pdn_solution_free(solution);
}

/* A model from a file has no functions; with them it moves as the one that was saved. */
static void functions_come_back(void)
{
    const char *path = "changes.pdm";
    const char *labels[3] = {"spring", "drag", "push"};
    double wanted[3 * TIMES], found[3 * TIMES], other[3 * TIMES];
    pdn_model *model = build(2), *loaded;
    pdn_solution *solution = NULL;
    pdn_signal signal;
    int32_t id[3];
    int i, freed = 0;
    for (i = 0; i < 3; ++i)
        CHECK_STATUS(pdn_model_set_label(model, FORCE(i), labels[i]), PDN_OK);
    solve(model, wanted);
    CHECK_STATUS(pdn_model_save(model, path), PDN_OK);
    CHECK_STATUS(pdn_model_load(path, &loaded), PDN_OK);
    remove(path);
    CHECK_STATUS(pdn_solve_periodic(loaded, PERIOD, NULL, &solution), PDN_ERR_CALLBACK);
    for (i = 0; i < 3; ++i)
        CHECK_STATUS(pdn_model_find_label(loaded, PDN_OBJECT_FORCE, labels[i], &id[i]), PDN_OK);
    CHECK_STATUS(
        pdn_model_bind_coordinate_law(loaded, id[0], PDN_TANGENTS_GIVEN, law, &numbers[0], NULL),
        PDN_OK);
    CHECK_STATUS(pdn_model_bind_user_force(loaded, id[1], PDN_FRAME_SPACE, PDN_TANGENTS_DIFFERENCED,
                                           drag, &numbers[1], NULL),
                 PDN_OK);
    PDN_INIT(pdn_signal, &signal);
    CHECK_STATUS(pdn_signal_set_function(&signal, push, &numbers[2]), PDN_OK);
    CHECK_STATUS(pdn_model_set_signal(loaded, id[2], 0, &signal), PDN_OK);
    solve(loaded, found);
    for (i = 0; i < 3 * TIMES; ++i)
        CHECK(found[i] == wanted[i]);

    /* A law that is taken over is let go of when another comes, or the model goes. */
    CHECK_STATUS(pdn_model_bind_coordinate_law(loaded, id[0], PDN_TANGENTS_DIFFERENCED, law, &freed,
                                               destroyed),
                 PDN_OK);
    CHECK(freed == 0);
    CHECK_STATUS(
        pdn_model_bind_coordinate_law(loaded, id[0], PDN_TANGENTS_GIVEN, law, &numbers[0], NULL),
        PDN_OK);
    CHECK(freed == 1);

    /* Other numbers of the spring: as if built so. */
    in.values[0] = 6;
    CHECK_STATUS(pdn_model_set_force_numbers(loaded, FORCE(3), PDN_NUMBER_STIFFNESS, in.values, 1),
                 PDN_OK);
    solve(loaded, found);
    pdn_model_free(loaded);
    loaded = build(6);
    solve(loaded, other);
    for (i = 0; i < 3 * TIMES; ++i)
        CHECK(found[i] == other[i]);
    CHECK(found[0] != wanted[0]);
    pdn_model_free(loaded);
    pdn_model_free(model);
}

/* A plate on nodes that are there, and a mass, are changed to what they tell. */
static void shells_and_inertias_change(void)
{
    static const double eye[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    const double origin[3] = {0};
    double matrix[36], told[36];
    int32_t nodes[4], inertia, node, element;
    pdn_model *model;
    pdn_shell_section section;
    CHECK_STATUS(pdn_model_new(&model), PDN_OK);
    for (int i = 0; i < 4; ++i) {
        const double position[3] = {i / 2, i % 2, 0};
        CHECK_STATUS(pdn_model_add_node(model, position, NULL, &nodes[i]), PDN_OK);
    }
    PDN_INIT(pdn_shell_section, &section);
    CHECK_STATUS(pdn_shell_section_set_isotropic(&section, 0.1, 1e6, 0.3, 1, 1, 0.1), PDN_OK);
    CHECK_STATUS(pdn_model_add_shell_element(model, nodes, 4, 2, &section, NULL, &element), PDN_OK);
    CHECK_STATUS(pdn_shell_section_set_isotropic(&section, 0.2, 1e6, 0.3, 1, 1, 0.1), PDN_OK);
    CHECK_STATUS(pdn_model_set_shell_section(model, element, 1, &section), PDN_OK);
    CHECK_STATUS(pdn_shell_section_set_isotropic(&section, 0.2, 1e6, 0.3, 0, 1, 0.1), PDN_OK);
    CHECK_STATUS(pdn_model_set_shell_section(model, element, 1, &section), PDN_ERR_VALUE);
    CHECK_STATUS(pdn_model_set_shell_section(model, element, 2, &section), PDN_ERR_SIZE);

    CHECK_STATUS(pdn_model_add_mass(model, nodes[0], 2, origin, eye, &inertia), PDN_OK);
    CHECK_STATUS(pdn_model_inertia(model, inertia, &node, matrix), PDN_OK);
    CHECK(node == nodes[0] && matrix[0] == 2 && matrix[21] == 1);
    for (int i = 0; i < 36; ++i) {
        matrix[i] *= 3;
    }
    CHECK_STATUS(pdn_model_set_inertia(model, inertia, matrix), PDN_OK);
    CHECK_STATUS(pdn_model_inertia(model, inertia, &node, told), PDN_OK);
    CHECK(node == nodes[0] && memcmp(told, matrix, sizeof matrix) == 0);
    pdn_model_free(model);
}

/* Frames of loads, and where a spring is free of effort, are what they were changed to. */
static void frames_and_rests_change(void)
{
    static const double origin[3] = {0}, end[3] = {1, 0, 0}, side[3] = {0, 1, 0};
    const double soft[6] = {1e3, 1e3, 1e3, 1, 1, 1}, mass[4] = {1, 1e-3, 1e-3, 1e-3};
    const double rest = 0.25;
    double axis_2[3], value;
    int32_t joint, force, load, node, first, elements, frame, places;
    pdn_section section;
    pdn_surface surface;
    pdn_shell_section plate;
    pdn_signal signal;
    pdn_model *model;
    pdn_beam beam;
    pdn_shell shell;
    CHECK_STATUS(pdn_model_new(&model), PDN_OK);
    PDN_INIT(pdn_section, &section);
    CHECK_STATUS(pdn_section_set_diagonal(&section, soft, mass), PDN_OK);
    CHECK_STATUS(pdn_model_add_straight_beam(model, origin, end, side, &section, 2, 1, &beam),
                 PDN_OK);
    PDN_INIT(pdn_surface, &surface);
    CHECK_STATUS(pdn_surface_set_parallelogram(&surface, origin, end, side), PDN_OK);
    PDN_INIT(pdn_shell_section, &plate);
    CHECK_STATUS(pdn_shell_section_set_isotropic(&plate, 0.1, 1e6, 0.3, 1000, 1, 0.1), PDN_OK);
    CHECK_STATUS(pdn_model_add_shell(model, &surface, 1, 1, 1, 1, 0, &plate, NULL, &shell), PDN_OK);
    PDN_INIT(pdn_signal, &signal);
    CHECK_STATUS(pdn_signal_set_constant(&signal, 2), PDN_OK);
    CHECK_STATUS(pdn_model_add_load(model, beam.last, PDN_FRAME_SPACE, PDN_FORCE_2, &signal, &load),
                 PDN_OK);
    CHECK_STATUS(pdn_model_add_distributed_load(model, beam.first_element, 2, PDN_FRAME_SPACE,
                                                PDN_FORCE_2, &signal, NULL, NULL, 0, NULL),
                 PDN_OK);
    CHECK_STATUS(pdn_model_add_shell_load(model, shell.first_element, 1, PDN_SHELL_SURFACE,
                                          PDN_FRAME_SPACE, PDN_FORCE_3, &signal, NULL),
                 PDN_OK);
    CHECK_STATUS(pdn_model_set_load_frame(model, load, PDN_FRAME_MATERIAL, NULL), PDN_OK);
    CHECK_STATUS(pdn_model_load_at(model, load, &node, &first, &elements, &value, NULL, &frame),
                 PDN_OK);
    CHECK(node == beam.last && frame == PDN_FRAME_MATERIAL);
    CHECK_STATUS(pdn_model_set_load_frame(model, SHELL_LOAD(0), PDN_FRAME_MATERIAL, NULL), PDN_OK);
    CHECK_STATUS(pdn_model_shell_load(model, SHELL_LOAD(0), &first, &elements, &places, &frame),
                 PDN_OK);
    CHECK(frame == PDN_FRAME_MATERIAL);
    CHECK_STATUS(pdn_model_set_load_frame(model, BEAM_LOAD(0), PDN_FRAME_UNTWISTED, side), PDN_OK);
    CHECK_STATUS(
        pdn_model_beam_load(model, BEAM_LOAD(0), &first, &elements, &frame, axis_2, &places),
        PDN_OK);
    CHECK(frame == PDN_FRAME_UNTWISTED && axis_2[1] == 1);
    CHECK_STATUS(pdn_model_set_load_frame(model, BEAM_LOAD(0), PDN_FRAME_UNTWISTED, end),
                 PDN_ERR_VALUE);
    CHECK_MESSAGE("axis_2: expected a direction across the beam");
    CHECK_STATUS(pdn_model_set_load_frame(model, load, PDN_FRAME_UNTWISTED, side), PDN_ERR_VALUE);
    CHECK_MESSAGE("frame: expected PDN_FRAME_SPACE or PDN_FRAME_MATERIAL");

    CHECK_STATUS(pdn_model_add_revolute(model, PDN_GROUND, beam.first, origin, side, &joint),
                 PDN_OK);
    CHECK_STATUS(pdn_model_add_spring_damper(model, joint, PDN_ROTATION, 3, 0, 0.1, &force),
                 PDN_OK);
    CHECK_STATUS(pdn_model_set_force_numbers(model, force, PDN_NUMBER_REST, &rest, 1), PDN_OK);
    CHECK_STATUS(pdn_model_force_number(model, force, PDN_NUMBER_REST, 0, &value), PDN_OK);
    CHECK(value == rest);
    pdn_model_free(model);
}

/* A cantilever's tip under its weight moves with the inverse of its section's stiffness. */
static void sections_change(void)
{
    const double start[3] = {0}, end[3] = {1, 0, 0}, side[3] = {0, 1, 0}, weight[3] = {0, 0, -1e-4};
    const double soft[6] = {1e3, 1e3, 1e3, 1, 1, 1}, mass[4] = {1, 1e-3, 1e-3, 1e-3};
    const double time = 0;
    double stiff[6], heights[2], position[3];
    pdn_section section;
    pdn_model *model;
    pdn_solution *solution;
    pdn_beam beam;
    int32_t joint;
    int i;
    for (i = 0; i < 6; ++i)
        stiff[i] = 2 * soft[i];
    CHECK_STATUS(pdn_model_new(&model), PDN_OK);
    PDN_INIT(pdn_section, &section);
    CHECK_STATUS(pdn_section_set_diagonal(&section, soft, mass), PDN_OK);
    CHECK_STATUS(pdn_model_add_straight_beam(model, start, end, side, &section, 4, 1, &beam),
                 PDN_OK);
    CHECK_STATUS(pdn_model_add_rigid_joint(model, PDN_GROUND, beam.first, start, &joint), PDN_OK);
    CHECK_STATUS(pdn_model_set_gravity(model, weight), PDN_OK);
    for (i = 0; i < 2; ++i) {
        CHECK_STATUS(pdn_solve_static(model, NULL, &solution), PDN_OK);
        CHECK_STATUS(pdn_solution_sample(
                         solution, PDN_QUANTITY(PDN_NODE_POSITION, beam.last, PDN_ALL_COMPONENTS),
                         &time, 1, position),
                     PDN_OK);
        heights[i] = position[2];
        pdn_solution_free(solution);
        CHECK_STATUS(pdn_section_set_diagonal(&section, stiff, mass), PDN_OK);
        CHECK_STATUS(pdn_model_set_beam_section(model, beam.first_element, 4, &section), PDN_OK);
    }
    CHECK(heights[0] < -1e-6);
    /* Twice the stiffness but for what large motions change, of the order of the slope squared. */
    CHECK_NEAR(heights[0] / heights[1], 2, 1e-8);
    pdn_model_free(model);
}

static pdn_status set_signal(void)
{
    return pdn_model_set_signal(in.model, in.id, in.component, &in.signal);
}

static pdn_status set_numbers(void)
{
    return pdn_model_set_force_numbers(in.model, in.force, in.number, in.values, (size_t)in.count);
}

static int let_go;

static pdn_status bind_law(void)
{
    return pdn_model_bind_coordinate_law(in.model, in.force, in.tangents, in.law, &let_go,
                                         destroyed);
}

static pdn_status bind_drag(void)
{
    return pdn_model_bind_user_force(in.model, in.force, in.frame, in.tangents, in.drag, &let_go,
                                     destroyed);
}

static pdn_status bind_pressure(void)
{
    return pdn_model_bind_surface_force(in.model, in.force, in.count, in.frame, in.tangents,
                                        in.pressure, &let_go, destroyed);
}

static void refusals_of_changes(void)
{
    in.model = build(2);
    PDN_INIT(pdn_signal, &in.signal);
    in.id = FORCE(FORCES);
    REFUSED(set_signal(), PDN_ERR_ID, "id: expected ");
    in.id = FORCE(3);
    REFUSED(set_signal(), PDN_ERR_NOT_AVAILABLE,
            "id: expected what has a signal there, got force 3");

    in.force = FORCE(3);
    in.number = PDN_NUMBER_STIFFNESS;
    in.count = 2;
    REFUSED(set_numbers(), PDN_ERR_SIZE, "count: expected 1");
    in.count = 1;
    REFUSES_NOT_FINITE(in.values[0], set_numbers(), "values");
    REFUSES_OTHER_ROLES(in.number, set_numbers(), "number: expected ");

    in.number = PDN_NUMBER_REST;
    in.count = 2;
    REFUSED(set_numbers(), PDN_ERR_SIZE, "count: expected 1");
    in.count = 1;
    REFUSES_NOT_FINITE(in.values[0], set_numbers(), "values");

#define SET_FRAME(axis_2) pdn_model_set_load_frame(in.model, in.id, in.frame, axis_2)
    in.frame = PDN_FRAME_MATERIAL;
    in.id = FORCE(0);
    REFUSED(SET_FRAME(NULL), PDN_ERR_ID,
            "load: expected a beam load id, a shell load id or a load");
    in.id = BEAM_LOAD(0);
    REFUSED(SET_FRAME(NULL), PDN_ERR_ID, "load: expected a beam load id though");
    in.id = SHELL_LOAD(0);
    REFUSED(SET_FRAME(NULL), PDN_ERR_ID, "load: expected a shell load id though");
#undef SET_FRAME

    PDN_INIT(pdn_section, &in.section);
    REFUSED(pdn_model_set_beam_section(in.model, BEAM_ELEMENT(0), 1, &in.section), PDN_ERR_ID,
            "first_element: expected ");
    REFUSED(pdn_model_set_beam_section(in.model, BEAM_ELEMENT(0), 1, NULL), PDN_ERR_ID,
            "first_element: expected ");
    REFUSED(pdn_model_set_shell_section(in.model, BEAM_ELEMENT(0), 1, NULL), PDN_ERR_ID,
            "first_element: expected ");
    const double none[36] = {-1};
    REFUSED(pdn_model_set_inertia(in.model, INERTIA(0), NULL), PDN_ERR_NULL, "matrix: expected ");
    REFUSED(pdn_model_set_inertia(in.model, INERTIA(99), none), PDN_ERR_ID, "inertia: expected ");
    REFUSED(pdn_model_set_inertia(in.model, INERTIA(0), none), PDN_ERR_VALUE, "matrix: expected ");

    in.frame = PDN_FRAME_SPACE;
    in.tangents = PDN_TANGENTS_GIVEN;
    in.law = law;
    in.drag = drag;
    in.pressure = pressure;
    REFUSED(bind_law(), PDN_ERR_NOT_AVAILABLE, "force: ");
    REFUSED(bind_drag(), PDN_ERR_NOT_AVAILABLE, "force: ");
    REFUSED(bind_pressure(), PDN_ERR_NOT_AVAILABLE, "force: ");
    in.count = 2;
    REFUSED(bind_pressure(), PDN_ERR_SIZE, "forces: expected 1 to 1 ");
    in.count = 0;
    REFUSED(bind_pressure(), PDN_ERR_SIZE, "forces: expected 1 to 1 ");
    in.force = FORCE(0);
    REFUSES_OTHER_ROLES(in.tangents, bind_law(), "tangents: expected ");
    in.law = NULL;
    REFUSED(bind_law(), PDN_ERR_NULL, "function: ");
    in.force = FORCE(1);
    REFUSES_OTHER_ROLES(in.frame, bind_drag(), "frame: expected ");
    REFUSES_OTHER_ROLES(in.tangents, bind_drag(), "tangents: expected ");
    in.drag = NULL;
    REFUSED(bind_drag(), PDN_ERR_NULL, "function: ");
    CHECK(let_go == 0);
    pdn_model_free(in.model);
}

int main(void)
{
    functions_come_back();
    sections_change();
    frames_and_rests_change();
    shells_and_inertias_change();
    refusals_of_changes();
    printf("%d refusals\n", refusals);
    return 0;
}
