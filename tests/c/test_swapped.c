/* Calls with two of their integers exchanged: unless both are numbers, or ids of things of one
 * kind, they are refused. */
#include "swapped_calls.h"
#include <stdio.h>

enum { MOST = 5 };

#define CONTROLLER FORCE(3)
#define LAW FORCE(4)
#define USER_FORCE FORCE(5)
#define SURFACE_FORCE FORCE(6)

/* Whether these may well be meant the other way round. */
static int are_alike(int32_t a, int32_t b)
{
    const int32_t span = PDN_FIRST_JOINT - PDN_FIRST_NODE;
    const int numbers = a < 100 && b < 100 && a >= 0 && b >= 0;
    const int bodies = (a == PDN_GROUND || a / span == 1) && (b == PDN_GROUND || b / span == 1);
    return numbers || bodies || (a >= span && a / span == b / span);
}

static const struct {
    const char *name;
    pdn_status (*call)(const int32_t *);
    int count;
    int32_t values[MOST];
} cases[] = {
    {"prescribe", prescribe, 2, {JOINT(2), PDN_ROTATION}},
    {"joint", add_joint, 3, {PDN_JOINT_FREE, NODE(0), NODE(1)}},
    {"load", add_load, 3, {NODE(0), PDN_FRAME_SPACE, PDN_FORCE_1}},
    {"load at a point", add_load_at_point, 3, {NODE(0), PDN_FRAME_SPACE, PDN_FORCE_1}},
    {"load on a beam", add_load_on_beam, 4, {BEAM_ELEMENT(0), 1, PDN_FRAME_SPACE, PDN_FORCE_1}},
    {"distributed", add_distributed_load, 4, {BEAM_ELEMENT(0), 1, PDN_FRAME_SPACE, PDN_FORCE_1}},
    {"shell",
     add_shell_load,
     5,
     {SHELL_ELEMENT(0), 1, PDN_SHELL_SURFACE, PDN_FRAME_SPACE, PDN_FORCE_1}},
    {"spring", add_spring_damper, 2, {JOINT(0), PDN_ROTATION}},
    {"nonlinear", add_nonlinear, 2, {JOINT(0), PDN_ROTATION}},
    {"actuator", add_actuator, 2, {JOINT(0), PDN_ROTATION}},
    {"viscoelastic", add_viscoelastic, 2, {JOINT(0), PDN_ROTATION}},
    {"bushing", add_bushing, 3, {PDN_GROUND, NODE(0), PDN_ANGLES_ROTATION_VECTOR}},
    {"law", add_coordinate_law, 3, {JOINT(0), PDN_ROTATION, PDN_TANGENTS_DIFFERENCED}},
    {"user force", add_user_force, 2, {PDN_FRAME_SPACE, PDN_TANGENTS_DIFFERENCED}},
    {"number", move_number, 4, {PARAMETER(0), PDN_NUMBER_STIFFNESS, FORCE(0), 1}},
    {"inertia", move_number, 3, {PARAMETER(0), PDN_NUMBER_INERTIA, INERTIA(1)}},
    {"signal of a drive", move_signal, 4, {PARAMETER(0), PRESCRIBED(0), 0, PDN_PART_MEAN}},
    {"signal of a beam load",
     move_signal,
     4,
     {PARAMETER(0), BEAM_LOAD(0), PDN_FORCE_1, PDN_PART_MEAN}},
    {"signal of a shell load",
     move_signal,
     4,
     {PARAMETER(0), SHELL_LOAD(0), PDN_FORCE_1, PDN_PART_MEAN}},
    {"signal", move_signal, 4, {PARAMETER(0), LOAD(0), PDN_FORCE_1, PDN_PART_MEAN}},
    {"force number", force_number, 3, {FORCE(0), PDN_NUMBER_STIFFNESS, 0}},
    {"sample", sample_signal, 2, {LOAD(0), PDN_FORCE_1}},
    {"sample of a prescribed coordinate", sample_signal, 2, {PRESCRIBED(0), 0}},
    {"velocity", sample_in_frame, 3, {PDN_NODE_VELOCITY, NODE(0), PDN_FRAME_SPACE}},
    {"acceleration", sample_in_frame, 3, {PDN_NODE_ACCELERATION, NODE(0), PDN_FRAME_MATERIAL}},
    {"coordinate", sample, 3, {PDN_JOINT_COORDINATE, JOINT(0), PDN_ROTATION}},
    {"rate", sample, 3, {PDN_JOINT_RATE, JOINT(0), PDN_ROTATION}},
    {"acceleration of a joint", sample, 3, {PDN_JOINT_ACCELERATION, JOINT(0), PDN_ROTATION}},
    {"driving effort", sample, 3, {PDN_JOINT_DRIVING_EFFORT, JOINT(1), PDN_ROTATION}},
    {"reaction", sample_in_frame, 3, {PDN_JOINT_REACTION, JOINT(0), PDN_FRAME_FIRST}},
    {"force on node", force_on_node, 3, {FORCE(0), NODE(0), PDN_FRAME_SPACE}},
    {"filtered", filtered, 2, {PDN_FILTER_EXPONENTIAL, 4}},
    {"load at places", load_at_places, 3, {BEAM_ELEMENT(0), 1, PDN_FRAME_SPACE}},
    {"surface force",
     surface_force,
     5,
     {SHELL_ELEMENT(0), 1, PDN_SHELL_SURFACE, PDN_FRAME_SPACE, PDN_TANGENTS_DIFFERENCED}},
    {"line force", line_force, 4, {BEAM_ELEMENT(0), 1, PDN_FRAME_SPACE, PDN_TANGENTS_DIFFERENCED}},
    {"rigid edge", rigid_edge, 2, {NODE(0), PDN_SHELL_EDGE_END_XI}},
    {"prestress", prestress, 2, {SHELL_ELEMENT(0), 1}},
    {"beam section", beam_section, 2, {BEAM_ELEMENT(0), 1}},
    {"beam spin", beam_spin, 2, {BEAM_ELEMENT(0), 1}},
    {"shell section", shell_section, 2, {SHELL_ELEMENT(0), 1}},
    {"frame of a load", set_load_frame, 2, {LOAD(0), PDN_FRAME_SPACE}},
    {"signal set", set_signal, 2, {LOAD(0), PDN_FORCE_1}},
    {"force numbers", force_numbers, 2, {FORCE(0), PDN_NUMBER_STIFFNESS}},
    {"controller bound", bind_controller, 2, {CONTROLLER, PDN_TANGENTS_DIFFERENCED}},
    {"law bound", bind_law, 2, {LAW, PDN_TANGENTS_DIFFERENCED}},
    {"user force bound",
     bind_user_force,
     3,
     {USER_FORCE, PDN_FRAME_SPACE, PDN_TANGENTS_DIFFERENCED}},
    {"surface force bound",
     bind_surface_force,
     4,
     {SURFACE_FORCE, 1, PDN_FRAME_SPACE, PDN_TANGENTS_DIFFERENCED}},
    {"coordinate of a controller", controller_coordinate, 2, {CONTROLLER, 0}},
    {"state of a controller", controller_state, 2, {CONTROLLER, 0}},
    {"node of a force", force_node, 2, {USER_FORCE, 0}},
    {"node of a beam element", beam_element_node, 2, {BEAM_ELEMENT(0), 0}},
    {"node of a shell element", shell_node, 3, {SHELL_ELEMENT(0), 0, 1}},
    {"term of a relation", relation_term, 2, {RELATION(0), 0}},
    {"factor of a beam load", beam_load_factor, 2, {BEAM_LOAD(1), 0}},
    {"condition", condition, 2, {JOINT(0), PDN_ROTATION}},
    {"end of equations", equations_end, 2, {-1, PDN_CONVERGED}},
    {"harmonics of a node", harmonics, 2, {PDN_NODE_POSITION, NODE(0)}},
    {"harmonics of a joint", harmonics, 2, {PDN_JOINT_REACTION, JOINT(0)}},
    {"harmonics of a beam", harmonics, 2, {PDN_BEAM_STRAIN, BEAM_ELEMENT(0)}},
    {"harmonics of a force", harmonics, 2, {PDN_FORCE_EFFORT, FORCE(0)}},
};

/* What functions act by, a load that varies along the beam, a relation, and a label. */
static void add_more(pdn_model *out)
{
    const double ends[2] = {0, 1}, factors[2] = {1, 2}, one = 1;
    const int32_t node = NODE(0), joint = JOINT(0), last = JOINT(2), coordinate = PDN_ROTATION;
    const int32_t joints[2] = {JOINT(0), JOINT(2)};
    const int32_t coordinates[2] = {PDN_ROTATION, PDN_ROTATION};
    int32_t id;
    CHECK_STATUS(pdn_model_add_controller(out, &joint, &coordinate, 1, &last, &coordinate, 1, time_,
                                          &one, 1, PDN_TANGENTS_DIFFERENCED, control, NULL, NULL,
                                          &id),
                 PDN_OK);
    CHECK(id == CONTROLLER);
    CHECK_STATUS(pdn_model_add_coordinate_law(out, joint, coordinate, PDN_TANGENTS_DIFFERENCED, law,
                                              NULL, NULL, &id),
                 PDN_OK);
    CHECK(id == LAW);
    CHECK_STATUS(pdn_model_add_user_force(out, &node, 1, PDN_FRAME_SPACE, PDN_TANGENTS_DIFFERENCED,
                                          forces, NULL, NULL, &id),
                 PDN_OK);
    CHECK(id == USER_FORCE);
    CHECK_STATUS(pdn_model_add_surface_force(out, SHELL_ELEMENT(0), 1, PDN_SHELL_SURFACE,
                                             PDN_FRAME_SPACE, PDN_TANGENTS_DIFFERENCED,
                                             surface_forces, NULL, NULL, &id),
                 PDN_OK);
    CHECK(id == SURFACE_FORCE);
    CHECK_STATUS(pdn_model_add_distributed_load(out, BEAM_ELEMENT(0), 1, PDN_FRAME_SPACE,
                                                PDN_FORCE_1, &signal, ends, factors, 2, &id),
                 PDN_OK);
    CHECK(id == BEAM_LOAD(1));
    CHECK_STATUS(pdn_model_add_relation(out, joints, coordinates, factors, 2, NULL, &id), PDN_OK);
    CHECK(id == RELATION(0));
    CHECK_STATUS(pdn_model_set_label(out, NODE(0), "named"), PDN_OK);
}

/* A body on a hinge, another that is driven, a third on one, a beam, and a shell. */
static pdn_model *made(void)
{
    const double x[3] = {1, 0, 0}, y[3] = {0, 1, 0}, z[3] = {0, 0, 1}, origin[3] = {0};
    const double moments[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    const double stiffness[6] = {1e4, 1e4, 1e4, 10, 10, 10}, mass[4] = {1, 1e-2, 1e-2, 1e-2};
    int32_t body, i, id;
    pdn_surface surface;
    pdn_line line;
    pdn_stations stations;
    pdn_beam beam;
    pdn_model *out;
    CHECK_STATUS(pdn_model_new(&out), PDN_OK);
    for (i = 0; i < 3; i++) {
        CHECK_STATUS(pdn_model_add_rigid_body(out, 1, x, moments, &body), PDN_OK);
        CHECK_STATUS(pdn_model_add_revolute(out, PDN_GROUND, body, origin, z, &id), PDN_OK);
        CHECK_STATUS(pdn_model_add_spring_damper(out, id, PDN_ROTATION, 9, 1, 0, NULL), PDN_OK);
    }
    PDN_INIT(pdn_signal, &signal);
    CHECK_STATUS(pdn_signal_set_constant(&signal, 0.1), PDN_OK);
    CHECK_STATUS(pdn_model_prescribe(out, JOINT(1), PDN_ROTATION, &signal, NULL), PDN_OK);
    CHECK_STATUS(pdn_model_add_load(out, NODE(0), PDN_FRAME_SPACE, PDN_FORCE_1, &signal, NULL),
                 PDN_OK);
    PDN_INIT(pdn_section, &section);
    for (i = 0; i < 6; i++)
        section.stiffness[7 * i] = stiffness[i];
    for (i = 0; i < 3; i++)
        section.mass[7 * i] = mass[0];
    for (i = 3; i < 6; i++)
        section.mass[7 * i] = mass[i - 2];
    PDN_INIT(pdn_line, &line);
    CHECK_STATUS(pdn_line_set_straight(&line, y, z, x), PDN_OK);
    PDN_INIT(pdn_stations, &stations);
    stations.count = 1;
    stations.fractions = origin;
    stations.sections = &section;
    CHECK_STATUS(pdn_model_add_beam(out, &line, &stations, 1, 2, &beam), PDN_OK);
    CHECK_STATUS(pdn_model_add_rigid_joint(out, PDN_GROUND, beam.first, y, &id), PDN_OK);
    PDN_INIT(pdn_surface, &surface);
    CHECK_STATUS(pdn_surface_set_parallelogram(&surface, x, y, z), PDN_OK);
    PDN_INIT(pdn_shell_section, &plate);
    CHECK_STATUS(pdn_shell_section_set_isotropic(&plate, 0.1, 1e6, 0.3, 1000, 1, 0.1), PDN_OK);
    CHECK_STATUS(pdn_model_add_shell(out, &surface, 1, 1, 1, 1, 0, &plate, NULL, &shell), PDN_OK);
    CHECK_STATUS(pdn_model_shell_node(out, shell.first_element, 0, 0, &id), PDN_OK);
    CHECK_STATUS(pdn_model_add_rigid_joint(out, PDN_GROUND, id, x, &id), PDN_OK);
    CHECK_STATUS(pdn_model_add_distributed_load(out, beam.first_element, 1, PDN_FRAME_SPACE,
                                                PDN_FORCE_1, &signal, NULL, NULL, 0, &id),
                 PDN_OK);
    CHECK(id == BEAM_LOAD(0));
    CHECK_STATUS(pdn_model_add_shell_load(out, shell.first_element, 1, PDN_SHELL_SURFACE,
                                          PDN_FRAME_SPACE, PDN_FORCE_1, &signal, &id),
                 PDN_OK);
    CHECK(id == SHELL_LOAD(0));
    CHECK_STATUS(pdn_model_add_parameter(out, "p", 1, 1, &id), PDN_OK);
    add_more(out);
    return out;
}

int main(void)
{
    pdn_model *const whole = made();
    pdn_periodic_options options;
    size_t c;
    int swaps = 0, i, j;
    PDN_INIT(pdn_periodic_options, &options);
    options.grid_points = 3;
    CHECK_STATUS(pdn_solve_periodic(whole, 2, &options, &solution), PDN_OK);
    CHECK(pdn_solution_outcome(solution) == PDN_CONVERGED);
    for (c = 0; c < sizeof cases / sizeof *cases; c++) {
        CHECK_STATUS(pdn_model_copy(whole, &model), PDN_OK);
        if (cases[c].call(cases[c].values) != PDN_OK) {
            char message[256];
            pdn_last_error(message, sizeof message);
            fprintf(stderr, "%s: %s\n", cases[c].name, message);
            return 1;
        }
        pdn_model_free(model);
        CHECK_STATUS(pdn_model_copy(whole, &model), PDN_OK);
        for (i = 0; i < cases[c].count; i++) {
            for (j = 0; j < i; j++) {
                int32_t v[MOST];
                memcpy(v, cases[c].values, sizeof v);
                if (are_alike(v[i], v[j]))
                    continue;
                v[i] = cases[c].values[j];
                v[j] = cases[c].values[i];
                if (cases[c].call(v) >= 0) {
                    fprintf(stderr, "%s: arguments %d and %d exchanged\n", cases[c].name, j, i);
                    return 1;
                }
                swaps++;
            }
        }
        pdn_model_free(model);
    }
    printf("%d exchanges refused\n", swaps);
    pdn_solution_free(solution);
    pdn_model_free(whole);
    return 0;
}
