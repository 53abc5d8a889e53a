/* What tables, animations and saved solutions refuse. */
#include "driven_arm.h"
#include <math.h>
#include <stdint.h>

static struct {
    double times[3];
    double values[3];
    pdn_quantity asked;
} in = {{0, 1, 2}, {3, 4, 5}, {0}};

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
    const int32_t coordinate[] = {PDN_DISPLACEMENT}, absent[] = {0, 1};
#define ADD(label) pdn_table_add_quantity(table, solution, &in.asked, label)
    in.asked = pdn_quantity_of(PDN_NODE_POSITION, body, PDN_ALL_COMPONENTS);
    REFUSED(pdn_table_add_quantity(NULL, solution, &in.asked, NULL), PDN_ERR_NULL, "table: ");
    REFUSED(pdn_table_add_quantity(table, NULL, &in.asked, NULL), PDN_ERR_NULL, "solution: ");
    REFUSED(pdn_table_add_quantity(table, solution, NULL, NULL), PDN_ERR_NULL, "quantity: ");
    REFUSES_OBJECTS(in.asked.object, ADD(NULL), "node", "object");
    REFUSES_EACH(in.asked.kind, int32_t, bad_enums, ADD(NULL), PDN_ERR_VALUE,
                 "quantity.kind: expected ");
    REFUSED(ADD(""), PDN_ERR_VALUE, "label: expected a name");
    REFUSED(ADD(not_utf8), PDN_ERR_VALUE, "label: expected text in UTF-8");

    in.asked = pdn_quantity_of(PDN_JOINT_COORDINATE, hinge, PDN_ROTATION);
    REFUSES_OBJECTS(in.asked.object, ADD(NULL), "joint", "object");
    REFUSES_EACH(in.asked.component, int32_t, bad_enums, ADD(NULL), PDN_ERR_VALUE,
                 "quantity.component: expected ");
    REFUSED(ADD("own"), PDN_ERR_VALUE, "label: expected names that no column has, got \"own\"");
    REFUSED(ADD("t"), PDN_ERR_VALUE, "label: ");
    REFUSED(ADD(not_utf8), PDN_ERR_VALUE, "label: expected text in UTF-8");
    REFUSES_EACH(in.asked.component, int32_t, coordinate, ADD(NULL), PDN_ERR_NOT_AVAILABLE,
                 "coordinate: ");

    in.asked = pdn_quantity_of(PDN_BEAM_FORCE, BEAM_ELEMENT(0), PDN_ALL_COMPONENTS);
    REFUSES_OBJECTS(in.asked.object, ADD(NULL), "element", "object");
    REFUSES_NOT_FINITE(in.asked.station, ADD(NULL), "station");
    in.asked.station = 1.5;
    REFUSED(ADD(NULL), PDN_ERR_VALUE, "station: expected ");

    in.asked = pdn_quantity_of(PDN_FORCE_EFFORT, FORCE(0), PDN_ALL_COMPONENTS);
    REFUSES_OBJECTS(in.asked.object, ADD(NULL), "force", "object");
    in.asked.kind = PDN_FORCE_BRANCH_EFFORT;
    REFUSES_EACH(in.asked.branch, int32_t, absent, ADD(NULL), PDN_ERR_NOT_AVAILABLE, "branch: ");

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
