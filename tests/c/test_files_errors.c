/* What tables, animations and saved solutions refuse. */
#include "driven_arm.h"
#include <math.h>
#include <stdint.h>

static struct {
    double times[3];
    double values[3];
} in = {{0, 1, 2}, {3, 4, 5}};

static struct {
    pdn_table *table;
    pdn_solution *solution;
    pdn_model *model;
} out;

static pdn_table *table;
static pdn_solution *solution;

/* The table is written as it always was. */
static int model_changed(void)
{
    char text[64];
    size_t length;
    FILE *file;
    if (table == NULL) {
        return 0;
    }
    if (pdn_table_write_csv(table, "test_files_errors.csv") != PDN_OK) {
        return 1;
    }
    file = fopen("test_files_errors.csv", "rb");
    length = fread(text, 1, sizeof text - 1, file);
    fclose(file);
    text[length] = '\0';
    return strcmp(text, "t,own\n0.0,3.0\n1.0,4.0\n2.0,5.0\n") != 0;
}

#include "refusal.h"

static int32_t body, hinge;

static void make_solution(void)
{
    driven_arm parts;
    pdn_model *const model = make_driven_arm(1, 1, &parts);
    pdn_periodic_options options;
    body = parts.body, hinge = parts.hinge;
    PDN_INIT(pdn_periodic_options, &options);
    options.grid_points = 5;
    CHECK_STATUS(pdn_solve_periodic(model, 2.0, &options, &solution), PDN_OK);
    pdn_model_free(model);
}

static const int32_t bad_ids[] = {-1, NO_IDS};
static const char not_utf8[] = "a\xff";

static void new_tables(void)
{
    REFUSED(pdn_table_new(NULL, 3, &out.table), PDN_ERR_NULL, "times: ");
    REFUSED(pdn_table_new(in.times, 3, NULL), PDN_ERR_NULL, "out: ");
    REFUSED(pdn_table_new(in.times, 0, &out.table), PDN_ERR_SIZE, "count: expected at least one");
    REFUSED(pdn_table_new(in.times, SIZE_MAX, &out.table), PDN_ERR_SIZE, "times: expected at most");
    REFUSES_NOT_FINITE_ENTRIES(in.times, 3, pdn_table_new(in.times, 3, &out.table), "times");
}

static void columns(void)
{
    int32_t id, quantity, detail;
    double station = 0;
#define ADD_NODE(label) pdn_table_add_node(table, solution, id, quantity, label)
    id = body, quantity = PDN_NODE_POSITION;
    REFUSED(pdn_table_add_node(NULL, solution, id, quantity, NULL), PDN_ERR_NULL, "table: ");
    REFUSED(pdn_table_add_node(table, NULL, id, quantity, NULL), PDN_ERR_NULL, "solution: ");
    REFUSES_EACH(id, int32_t, bad_ids, ADD_NODE(NULL), PDN_ERR_ID, "node: expected ");
    REFUSES_EACH(quantity, int32_t, bad_enums, ADD_NODE(NULL), PDN_ERR_VALUE,
                 "quantity: expected ");
    REFUSED(ADD_NODE(""), PDN_ERR_VALUE, "label: expected a name");
    REFUSED(ADD_NODE(not_utf8), PDN_ERR_VALUE, "label: expected text in UTF-8");

#define ADD_JOINT(label) pdn_table_add_joint(table, solution, id, quantity, detail, label)
    id = hinge, quantity = PDN_JOINT_COORDINATE, detail = PDN_ROTATION;
    REFUSED(pdn_table_add_joint(NULL, solution, id, quantity, detail, NULL), PDN_ERR_NULL, "table");
    REFUSED(pdn_table_add_joint(table, NULL, id, quantity, detail, NULL), PDN_ERR_NULL, "solution");
    REFUSES_EACH(id, int32_t, bad_ids, ADD_JOINT(NULL), PDN_ERR_ID, "joint: expected ");
    REFUSES_EACH(quantity, int32_t, bad_enums, ADD_JOINT(NULL), PDN_ERR_VALUE,
                 "quantity: expected ");
    REFUSES_EACH(detail, int32_t, bad_enums, ADD_JOINT(NULL), PDN_ERR_VALUE, "detail: expected ");
    REFUSED(ADD_JOINT("own"), PDN_ERR_VALUE,
            "label: expected names that no column has, got \"own\"");
    REFUSED(ADD_JOINT("t"), PDN_ERR_VALUE, "label: ");
    REFUSED(ADD_JOINT(not_utf8), PDN_ERR_VALUE, "label: expected text in UTF-8");
    detail = PDN_DISPLACEMENT;
    REFUSED(ADD_JOINT(NULL), PDN_ERR_NOT_AVAILABLE, "coordinate: ");

#define ADD_BEAM(label) pdn_table_add_beam(table, solution, id, station, quantity, label)
    id = BEAM_ELEMENT(0), quantity = PDN_BEAM_FORCE;
    REFUSED(pdn_table_add_beam(NULL, solution, BEAM_ELEMENT(0), 0, quantity, NULL), PDN_ERR_NULL,
            "table: ");
    REFUSED(pdn_table_add_beam(table, NULL, BEAM_ELEMENT(0), 0, quantity, NULL), PDN_ERR_NULL,
            "solution: ");
    REFUSES_EACH(id, int32_t, bad_ids, ADD_BEAM(NULL), PDN_ERR_ID, "element: expected ");
    REFUSES_EACH(quantity, int32_t, bad_enums, ADD_BEAM(NULL), PDN_ERR_VALUE,
                 "quantity: expected ");
    REFUSES_NOT_FINITE(station, ADD_BEAM(NULL), "station");
    station = 1.5;
    REFUSED(ADD_BEAM(NULL), PDN_ERR_VALUE, "station: expected ");
    station = 0;
    REFUSED(ADD_BEAM(not_utf8), PDN_ERR_VALUE, "label: expected text in UTF-8");

#define ADD_FORCE(label) pdn_table_add_force(table, solution, id, quantity, detail, label)
    id = FORCE(0), quantity = PDN_FORCE_EFFORT, detail = 0;
    REFUSED(pdn_table_add_force(NULL, solution, FORCE(0), quantity, 0, NULL), PDN_ERR_NULL,
            "table: ");
    REFUSED(pdn_table_add_force(table, NULL, FORCE(0), quantity, 0, NULL), PDN_ERR_NULL,
            "solution: ");
    REFUSES_EACH(id, int32_t, bad_ids, ADD_FORCE(NULL), PDN_ERR_ID, "force: expected ");
    REFUSES_EACH(quantity, int32_t, bad_enums, ADD_FORCE(NULL), PDN_ERR_VALUE,
                 "quantity: expected ");
    REFUSED(ADD_FORCE(not_utf8), PDN_ERR_VALUE, "label: expected text in UTF-8");
    detail = 1;
    REFUSED(ADD_FORCE(NULL), PDN_ERR_VALUE, "detail: expected zero");
    quantity = PDN_FORCE_BRANCH_EFFORT;
    REFUSED(ADD_FORCE(NULL), PDN_ERR_NOT_AVAILABLE, "branch: ");

    REFUSED(pdn_table_add_values(NULL, "v", in.values, 3), PDN_ERR_NULL, "table: ");
    REFUSED(pdn_table_add_values(table, NULL, in.values, 3), PDN_ERR_NULL, "label: ");
    REFUSED(pdn_table_add_values(table, "v", NULL, 3), PDN_ERR_NULL, "values: ");
    REFUSED(pdn_table_add_values(table, "v", in.values, 2), PDN_ERR_SIZE, "count: expected one");
    REFUSED(pdn_table_add_values(table, "own", in.values, 3), PDN_ERR_VALUE, "label: ");
    REFUSES_NOT_FINITE_ENTRIES(in.values, 3, pdn_table_add_values(table, "v", in.values, 3),
                               "values");
}

static void paths(void)
{
    size_t points = 5, count = 3;
    FILE *file;
#define VTK(path) pdn_solution_write_vtk(solution, in.times, count, points, path)
    REFUSED(pdn_table_write_csv(NULL, "x.csv"), PDN_ERR_NULL, "table: ");
    REFUSED(pdn_table_write_csv(table, NULL), PDN_ERR_NULL, "path: ");
    REFUSED(pdn_table_write_csv(table, not_utf8), PDN_ERR_VALUE, "path: expected text in UTF-8");
    REFUSED(pdn_table_write_csv(table, ""), PDN_ERR_IO, "path: cannot write \"\": ");
    REFUSED(pdn_table_write_csv(table, "no/such/x.csv"), PDN_ERR_IO,
            "path: cannot write \"no/such/x.csv\": ");

    REFUSED(pdn_solution_write_vtk(NULL, in.times, 3, 5, "x.pvd"), PDN_ERR_NULL, "solution: ");
    REFUSED(pdn_solution_write_vtk(solution, NULL, 3, 5, "x.pvd"), PDN_ERR_NULL, "times: ");
    REFUSED(VTK(NULL), PDN_ERR_NULL, "path: ");
    REFUSED(VTK(not_utf8), PDN_ERR_VALUE, "path: expected text in UTF-8");
    REFUSED(VTK("x.vtk"), PDN_ERR_VALUE, "path: expected a name that ends in .pvd");
    REFUSED(VTK("no/such/x.pvd"), PDN_ERR_IO, "path: cannot write \"no/such/x.pvd\": ");
    REFUSES_NOT_FINITE_ENTRIES(in.times, 3, VTK("x.pvd"), "times");
    count = 0;
    REFUSED(VTK("x.pvd"), PDN_ERR_SIZE, "count: expected at least one");
    count = 3;
    points = 1;
    REFUSED(VTK("x.pvd"), PDN_ERR_SIZE, "points_per_element: expected 2 to 1000");
    points = SIZE_MAX;
    REFUSED(VTK("x.pvd"), PDN_ERR_SIZE, "points_per_element: expected 2 to 1000");
    points = 5;
    in.times[1] = 3;
    REFUSED(VTK("x.pvd"), PDN_ERR_VALUE, "times[2]: expected a time after the one before");
    in.times[1] = 1;

    REFUSED(pdn_solution_save(NULL, "x.pdn"), PDN_ERR_NULL, "solution: ");
    REFUSED(pdn_solution_save(solution, NULL), PDN_ERR_NULL, "path: ");
    REFUSED(pdn_solution_save(solution, not_utf8), PDN_ERR_VALUE, "path: expected text in UTF-8");
    REFUSED(pdn_solution_save(solution, "no/such/x.pdn"), PDN_ERR_IO,
            "path: cannot write \"no/such/x.pdn\": ");

    REFUSED(pdn_solution_load(NULL, &out.solution), PDN_ERR_NULL, "path: ");
    REFUSED(pdn_solution_load("x.pdn", NULL), PDN_ERR_NULL, "out: ");
    REFUSED(pdn_solution_load(not_utf8, &out.solution), PDN_ERR_VALUE,
            "path: expected text in UTF-8");
    REFUSED(pdn_solution_load("no/such/x.pdn", &out.solution), PDN_ERR_IO,
            "path: cannot read \"no/such/x.pdn\": ");
    REFUSED(pdn_solution_load("test_files_errors.csv", &out.solution), PDN_ERR_FORMAT,
            "path: \"test_files_errors.csv\" is not a saved solution");
    CHECK_STATUS(pdn_solution_save(solution, "test_files_errors.pdn"), PDN_OK);
    file = fopen("test_files_errors.pdn", "r+b");
    CHECK(file != NULL && fseek(file, 200, SEEK_SET) == 0 && fputc(0xc1, file) == 0xc1);
    CHECK(fclose(file) == 0);
    REFUSED(pdn_solution_load("test_files_errors.pdn", &out.solution), PDN_ERR_FORMAT,
            "path: \"test_files_errors.pdn\" is damaged: its checksum is wrong");

    REFUSED(pdn_model_copy(NULL, &out.model), PDN_ERR_NULL, "model: ");
    REFUSED(pdn_model_save(NULL, "x.model"), PDN_ERR_NULL, "model: ");
    REFUSED(pdn_model_load(NULL, &out.model), PDN_ERR_NULL, "path: ");
    REFUSED(pdn_model_load("x.model", NULL), PDN_ERR_NULL, "out: ");
    REFUSED(pdn_model_load("no/such/x.model", &out.model), PDN_ERR_IO,
            "path: cannot read \"no/such/x.model\"");
    REFUSED(pdn_model_load("test_files_errors.pdn", &out.model), PDN_ERR_FORMAT,
            "path: \"test_files_errors.pdn\" is not a saved model");
    REFUSED(pdn_solution_model(NULL, &out.model), PDN_ERR_NULL, "solution: ");
    REFUSED(pdn_solution_model(solution, NULL), PDN_ERR_NULL, "out: ");
}

int main(void)
{
    make_solution();
    new_tables();
    CHECK_STATUS(pdn_table_new(in.times, 3, &table), PDN_OK);
    CHECK_STATUS(pdn_table_add_values(table, "own", in.values, 3), PDN_OK);
    columns();
    paths();
    pdn_table_free(table);
    pdn_solution_free(solution);
    printf("%d calls refused as they should be\n", refusals);
    return 0;
}
