/* Files: tables as CSV, animations, and solutions that are saved and loaded. */
#include "driven_arm.h"
#include <math.h>

#define PI 3.14159265358979323846

enum { TIMES = 5 };

static const double PERIOD = 2.0;
static const double times[TIMES] = {0, 0.4, 1.0, 1.7, 2.9};

static int32_t body, hinge, spring;
static pdn_beam beam;

static int32_t push_signal(double time, double *value, void *user_data)
{
    *value = *(double *)user_data * sin(PI * time);
    return 0;
}

/* The driven arm, whose beam a callback's force bends. */
static pdn_model *arm(double *size)
{
    driven_arm parts;
    pdn_model *const model = make_driven_arm(2, 2, &parts);
    pdn_signal force;
    body = parts.body, hinge = parts.hinge, spring = parts.spring, beam = parts.beam;
    PDN_INIT(pdn_signal, &force);
    CHECK_STATUS(pdn_signal_set_function(&force, push_signal, size), PDN_OK);
    CHECK_STATUS(pdn_model_add_load(model, beam.last, PDN_FRAME_SPACE, PDN_FORCE_2, &force, NULL),
                 PDN_OK);
    return model;
}

static pdn_solution *solved(const pdn_model *model, const pdn_solution *initial)
{
    pdn_periodic_options options;
    pdn_solution *solution = NULL;
    PDN_INIT(pdn_periodic_options, &options);
    options.grid_points = 9;
    options.initial = initial;
    CHECK_STATUS(pdn_solve_periodic(model, PERIOD, &options, &solution), PDN_OK);
    CHECK(pdn_solution_outcome(solution) == PDN_CONVERGED);
    return solution;
}

/* The whole of a text file. */
static char *text_of(const char *path)
{
    static char text[1 << 16];
    FILE *file = fopen(path, "rb");
    size_t length;
    CHECK(file != NULL);
    length = fread(text, 1, sizeof text - 1, file);
    CHECK(length < sizeof text - 1 && fclose(file) == 0);
    text[length] = '\0';
    return text;
}

static void a_table(const pdn_solution *solution)
{
    static const char header[] =
        "t,p.x,p.y,p.z,joint0.rotation_1,torque,"
        "joint0.reaction.force_x,joint0.reaction.force_y,joint0.reaction.force_z,"
        "joint0.reaction.moment_x,joint0.reaction.moment_y,joint0.reaction.moment_z,"
        "root.axial,root.shear_2,root.shear_3,root.torque,root.bending_2,root.bending_3,"
        "force0.effort,\"mine, \"\"own\"\"\"\n";
    pdn_table *table = NULL;
    double position[3 * TIMES], angle[TIMES], torque[TIMES], reaction[6 * TIMES];
    double root[6 * TIMES], effort[TIMES], own[TIMES];
    char *line;
    int k, i;
    for (k = 0; k < TIMES; k++) {
        own[k] = 1.0 / (3.0 + k);
    }
    CHECK_STATUS(pdn_table_new(times, TIMES, &table), PDN_OK);
    CHECK_STATUS(pdn_table_add_quantity(table, solution,
                                        PDN_QUANTITY(PDN_NODE_POSITION, body, PDN_ALL_COMPONENTS),
                                        "p"),
                 PDN_OK);
    CHECK_STATUS(pdn_table_add_quantity(table, solution,
                                        PDN_QUANTITY(PDN_JOINT_COORDINATE, hinge, PDN_ROTATION),
                                        NULL),
                 PDN_OK);
    CHECK_STATUS(pdn_table_add_quantity(table, solution,
                                        PDN_QUANTITY(PDN_JOINT_DRIVING_EFFORT, hinge, PDN_ROTATION),
                                        "torque"),
                 PDN_OK);
    CHECK_STATUS(pdn_table_add_quantity(table, solution,
                                        PDN_QUANTITY(PDN_JOINT_REACTION, hinge, PDN_ALL_COMPONENTS),
                                        NULL),
                 PDN_OK);
    CHECK_STATUS(pdn_table_add_quantity(table, solution,
                                        PDN_QUANTITY(PDN_BEAM_FORCE, beam.first_element,
                                                     PDN_ALL_COMPONENTS, .station = -1),
                                        "root"),
                 PDN_OK);
    CHECK_STATUS(pdn_table_add_quantity(table, solution,
                                        PDN_QUANTITY(PDN_FORCE_EFFORT, spring, PDN_ALL_COMPONENTS),
                                        NULL),
                 PDN_OK);
    CHECK_STATUS(pdn_table_add_values(table, "mine, \"own\"", own, TIMES), PDN_OK);
    CHECK_STATUS(pdn_table_write_csv(table, "test_files.csv"), PDN_OK);
    pdn_table_free(table);

    CHECK_STATUS(pdn_solution_sample(solution,
                                     PDN_QUANTITY(PDN_NODE_POSITION, body, PDN_ALL_COMPONENTS),
                                     times, TIMES, position),
                 PDN_OK);
    CHECK_STATUS(pdn_solution_sample(solution,
                                     PDN_QUANTITY(PDN_JOINT_COORDINATE, hinge, PDN_ROTATION), times,
                                     TIMES, angle),
                 PDN_OK);
    CHECK_STATUS(pdn_solution_sample(solution,
                                     PDN_QUANTITY(PDN_JOINT_DRIVING_EFFORT, hinge, PDN_ROTATION),
                                     times, TIMES, torque),
                 PDN_OK);
    CHECK_STATUS(pdn_solution_sample(solution,
                                     PDN_QUANTITY(PDN_JOINT_REACTION, hinge, PDN_ALL_COMPONENTS),
                                     times, TIMES, reaction),
                 PDN_OK);
    CHECK_STATUS(pdn_solution_sample(solution,
                                     PDN_QUANTITY(PDN_BEAM_FORCE, beam.first_element,
                                                  PDN_ALL_COMPONENTS, .station = -1),
                                     times, TIMES, root),
                 PDN_OK);
    CHECK_STATUS(pdn_solution_sample(solution,
                                     PDN_QUANTITY(PDN_FORCE_EFFORT, spring, PDN_ALL_COMPONENTS),
                                     times, TIMES, effort),
                 PDN_OK);

    line = text_of("test_files.csv");
    CHECK(strncmp(line, header, sizeof header - 1) == 0);
    line += sizeof header - 1;
    for (k = 0; k < TIMES; k++) {
        double expected[20];
        size_t n = 0;
        expected[n++] = times[k];
        for (i = 0; i < 3; i++) {
            expected[n++] = position[3 * k + i];
        }
        expected[n++] = angle[k];
        expected[n++] = torque[k];
        for (i = 0; i < 6; i++) {
            expected[n++] = reaction[6 * k + i];
        }
        for (i = 0; i < 6; i++) {
            expected[n++] = root[6 * k + i];
        }
        expected[n++] = effort[k];
        expected[n++] = own[k];
        CHECK(n == 20);
        for (i = 0; i < 20; i++) {
            /* Read back exactly. */
            CHECK(strtod(line, &line) == expected[i]);
            CHECK(*line++ == (i < 19 ? ',' : '\n'));
        }
    }
    CHECK(*line == '\0');
    pdn_table_free(NULL);
}

static void an_animation(const pdn_solution *solution)
{
    const char *list;
    CHECK_STATUS(pdn_solution_write_vtk(solution, times, TIMES, 6, "test_animation.pvd"), PDN_OK);
    list = text_of("test_animation.pvd");
    CHECK(strstr(list, "type=\"Collection\"") != NULL);
    CHECK(strstr(list, "timestep=\"2.9\" part=\"0\" name=\"beams\" "
                       "file=\"test_animation/beams_000004.vtp\"") != NULL);
    CHECK(strstr(list, "file=\"test_animation/bodies_000000.vtp\"") != NULL);
    CHECK(strstr(list, "file=\"test_animation/joints_000003.vtp\"") != NULL);
    CHECK(strstr(text_of("test_animation/beams_000004.vtp"), "type=\"PolyData\"") != NULL);
}

static void a_saved_solution(const pdn_model *model, pdn_solution *solution)
{
    pdn_solution *loaded = NULL, *again = NULL;
    pdn_model *copy = NULL;
    pdn_periodic_options options;
    pdn_diagnostics diagnostics;
    double before[12 * TIMES], after[12 * TIMES];
    char report[2][2048];
    CHECK_STATUS(pdn_solution_save(solution, "test_files.pdn"), PDN_OK);
    CHECK_STATUS(pdn_solution_sample(solution,
                                     PDN_QUANTITY(PDN_BEAM_FORCE, beam.first_element,
                                                  PDN_ALL_COMPONENTS, .station = 0.3),
                                     times, TIMES, before),
                 PDN_OK);
    CHECK_STATUS(pdn_solution_sample(
                     solution, PDN_QUANTITY(PDN_NODE_ACCELERATION, beam.last, PDN_ALL_COMPONENTS),
                     times, TIMES, before + 6 * TIMES),
                 PDN_OK);
    CHECK(pdn_solution_report(solution, report[0], sizeof report[0]) < sizeof report[0]);
    pdn_solution_free(solution);

    CHECK_STATUS(pdn_solution_load("test_files.pdn", &loaded), PDN_OK);
    CHECK(pdn_solution_outcome(loaded) == PDN_CONVERGED);
    CHECK_STATUS(pdn_solution_sample(loaded,
                                     PDN_QUANTITY(PDN_BEAM_FORCE, beam.first_element,
                                                  PDN_ALL_COMPONENTS, .station = 0.3),
                                     times, TIMES, after),
                 PDN_OK);
    CHECK_STATUS(pdn_solution_sample(
                     loaded, PDN_QUANTITY(PDN_NODE_ACCELERATION, beam.last, PDN_ALL_COMPONENTS),
                     times, TIMES, after + 6 * TIMES),
                 PDN_OK);
    CHECK(memcmp(before, after, sizeof before) == 0);
    CHECK(pdn_solution_report(loaded, report[1], sizeof report[1]) < sizeof report[1]);
    CHECK(strcmp(report[0], report[1]) == 0);

    /* A solve that starts there is done at once. */
    again = solved(model, loaded);
    PDN_INIT(pdn_diagnostics, &diagnostics);
    CHECK_STATUS(pdn_solution_diagnostics(again, &diagnostics), PDN_OK);
    CHECK(diagnostics.iterations == 1 && diagnostics.guess_iterations == 0);
    pdn_solution_free(again);

    /* The model has lost its callback, and says so. */
    CHECK_STATUS(pdn_solution_model(loaded, &copy), PDN_OK);
    pdn_solution_free(loaded);
    PDN_INIT(pdn_periodic_options, &options);
    options.grid_points = 9;
    again = NULL;
    CHECK_STATUS(pdn_solve_periodic(copy, PERIOD, &options, &again), PDN_ERR_CALLBACK);
    CHECK_MESSAGE("the model was loaded from a file");
    CHECK(again == NULL);
    pdn_model_free(copy);
}

static int32_t nodes(const pdn_model *model)
{
    int32_t count;
    CHECK_STATUS(pdn_model_node_count(model, &count), PDN_OK);
    return count;
}

static void a_saved_model(const pdn_model *model)
{
    pdn_model *copy = NULL, *loaded = NULL;
    pdn_solution *solution = NULL;
    const double here[3] = {1, 2, 3};
    double mass[2], centre[2][3];
    int32_t node;
    CHECK_STATUS(pdn_model_save(model, "test_files.model"), PDN_OK);
    CHECK_STATUS(pdn_model_load("test_files.model", &loaded), PDN_OK);
    CHECK_STATUS(pdn_model_mass(model, &mass[0], centre[0]), PDN_OK);
    CHECK_STATUS(pdn_model_mass(loaded, &mass[1], centre[1]), PDN_OK);
    CHECK(mass[0] == mass[1] && memcmp(centre[0], centre[1], sizeof centre[0]) == 0);

    /* It has lost its callback, and says so; a copy has not, and is one of its own. */
    CHECK_STATUS(pdn_solve_periodic(loaded, PERIOD, NULL, &solution), PDN_ERR_CALLBACK);
    CHECK_MESSAGE("the model was loaded from a file");
    CHECK_STATUS(pdn_model_copy(model, &copy), PDN_OK);
    solution = solved(copy, NULL);
    CHECK(pdn_solution_outcome(solution) == PDN_CONVERGED);
    CHECK_STATUS(pdn_model_add_node(copy, here, NULL, &node), PDN_OK);
    CHECK(nodes(copy) == nodes(model) + 1 && nodes(loaded) == nodes(model));
    pdn_solution_free(solution);
    pdn_model_free(copy);
    pdn_model_free(loaded);
}

int main(void)
{
    double size = 40.0;
    pdn_model *model = arm(&size);
    pdn_solution *solution = solved(model, NULL);
    a_table(solution);
    an_animation(solution);
    a_saved_model(model);
    a_saved_solution(model, solution);
    pdn_model_free(model);
    puts("files: tables, animations, saved models and solutions as they should be");
    return 0;
}
