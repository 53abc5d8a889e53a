/* Quantities as one noun: values, harmonics, extremes and columns. */
#include "driven_arm.h"
#include "near.h"

enum { TIMES = 4, HARMONICS = 3, MOST = 9 };

static const double PERIOD = 2.0;
static const double times[TIMES] = {0, 0.3, 1.1, 2.7};

static driven_arm parts;
static pdn_solution *solution;

static pdn_quantity quantity_of(int32_t kind, int32_t object)
{
    pdn_quantity quantity;
    PDN_INIT(pdn_quantity, &quantity);
    CHECK(quantity.struct_size == sizeof quantity && quantity.component == PDN_ALL_COMPONENTS);
    quantity.kind = kind;
    quantity.object = object;
    return quantity;
}

static void solve(void)
{
    pdn_periodic_options options;
    pdn_model *const model = make_driven_arm(2, 2, &parts);
    const double cosines[1] = {30}, sines[1] = {5};
    pdn_signal force;
    PDN_INIT(pdn_signal, &force);
    CHECK_STATUS(pdn_signal_set_harmonics(&force, 4, 0, cosines, sines, 1), PDN_OK);
    CHECK_STATUS(
        pdn_model_add_load(model, parts.beam.last, PDN_FRAME_SPACE, PDN_FORCE_2, &force, NULL),
        PDN_OK);
    PDN_INIT(pdn_periodic_options, &options);
    options.grid_points = 9;
    CHECK_STATUS(pdn_solve_periodic(model, PERIOD, &options, &solution), PDN_OK);
    CHECK(pdn_solution_outcome(solution) == PDN_CONVERGED);
    pdn_model_free(model);
}

/* Samples and harmonics of all components, and of each alone, against those given. */
static void check_values(pdn_quantity quantity, int32_t components, const double *expected)
{
    double values[MOST * TIMES], one[TIMES];
    int32_t c, k;
    CHECK(pdn_quantity_components(&quantity) == components);
    CHECK_STATUS(pdn_solution_sample(solution, &quantity, times, TIMES, values), PDN_OK);
    for (c = 0; c < components * TIMES; ++c)
        CHECK(values[c] == expected[c]);
    for (c = 0; components > 1 && c < components; ++c) {
        quantity.component = c;
        CHECK(pdn_quantity_components(&quantity) == 1);
        CHECK_STATUS(pdn_solution_sample(solution, &quantity, times, TIMES, one), PDN_OK);
        for (k = 0; k < TIMES; ++k)
            CHECK(one[k] == expected[components * k + c]);
    }
}

static void components_alone_are_parts_of_all(void)
{
    const int32_t last = parts.beam.last, hinge = parts.hinge;
    double all[MOST * TIMES];
    const struct {
        const pdn_quantity *asked;
        int32_t components;
    } cases[] = {
        {PDN_QUANTITY(PDN_NODE_POSITION, last, PDN_ALL_COMPONENTS), 3},
        {PDN_QUANTITY(PDN_NODE_ROTATION, last, PDN_ALL_COMPONENTS), 9},
        {PDN_QUANTITY(PDN_NODE_ACCELERATION, last, PDN_ALL_COMPONENTS, .frame = PDN_FRAME_MATERIAL),
         6},
        {PDN_QUANTITY(PDN_JOINT_RATE, hinge, PDN_ROTATION), 1},
        {PDN_QUANTITY(PDN_JOINT_REACTION, hinge, PDN_ALL_COMPONENTS, .frame = PDN_FRAME_FIRST), 6},
        {PDN_QUANTITY(PDN_BEAM_FORCE, parts.beam.first_element, PDN_ALL_COMPONENTS,
                      .station = -0.5),
         6},
        {PDN_QUANTITY(PDN_FORCE_EFFORT, parts.spring, PDN_ALL_COMPONENTS), 1},
        {PDN_QUANTITY(PDN_FORCE_ON_NODE, parts.spring, PDN_ALL_COMPONENTS, .node = parts.body,
                      .frame = PDN_FRAME_MATERIAL),
         6},
    };
    size_t c;
    for (c = 0; c < sizeof cases / sizeof *cases; ++c) {
        CHECK_STATUS(pdn_solution_sample(solution, cases[c].asked, times, TIMES, all), PDN_OK);
        check_values(*cases[c].asked, cases[c].components, all);
    }
}

static void one_call_is_the_same_as_a_struct(void)
{
    const pdn_quantity expected = pdn_quantity_of(PDN_JOINT_RATE, parts.hinge, PDN_ROTATION);
    const pdn_quantity *const found = PDN_QUANTITY(PDN_JOINT_RATE, parts.hinge, PDN_ROTATION);
    CHECK(memcmp(found, &expected, sizeof expected) == 0);
    CHECK(found->kind == PDN_JOINT_RATE && found->object == parts.hinge);
    CHECK(found->component == PDN_ROTATION && found->frame == PDN_FRAME_SPACE);
}

static void harmonics_and_extremes(void)
{
    double mean, rate, cosines[HARMONICS], sines[HARMONICS];
    double smallest, largest, early, late;
    pdn_quantity angle = quantity_of(PDN_JOINT_COORDINATE, parts.hinge);
    angle.component = PDN_ROTATION;
    /* It is prescribed: 0.3 sin(pi t). */
    CHECK_STATUS(pdn_solution_harmonics(solution, &angle, HARMONICS, &mean, &rate, cosines, sines),
                 PDN_OK);
    CHECK_NEAR(mean, 0, 1e-12);
    CHECK(rate == 0);
    CHECK_NEAR(sines[0], 0.3, 1e-12);
    CHECK_NEAR(cosines[0], 0, 1e-12);
    CHECK_STATUS(pdn_solution_extremes(solution, &angle, &smallest, &late, &largest, &early),
                 PDN_OK);
    CHECK_NEAR(smallest, -0.3, 1e-12);
    CHECK_NEAR(late, 1.5, 1e-6);
    CHECK_NEAR(largest, 0.3, 1e-12);
    CHECK_NEAR(early, 0.5, 1e-6);
    CHECK_STATUS(pdn_solution_extremes(solution, &angle, NULL, NULL, NULL, &early), PDN_OK);
    CHECK_NEAR(early, 0.5, 1e-6);
    angle.kind = PDN_JOINT_ACCELERATION;
    CHECK_STATUS(pdn_solution_extremes(solution, &angle, NULL, NULL, &largest, NULL), PDN_OK);
    CHECK_NEAR(largest, 0.3 * PI * PI, 1e-10);
}

static void columns(void)
{
    pdn_table *table = NULL;
    char line[256];
    FILE *file;
    pdn_quantity quantity = quantity_of(PDN_NODE_VELOCITY, parts.body);
    CHECK_STATUS(pdn_table_new(times, TIMES, &table), PDN_OK);
    quantity.component = 5;
    CHECK_STATUS(pdn_table_add_quantity(table, solution, &quantity, NULL), PDN_OK);
    CHECK_STATUS(pdn_table_add_quantity(table, solution, &quantity, "spin"), PDN_OK);
    CHECK_STATUS(pdn_table_add_quantity(table, solution, &quantity, "spin"), PDN_ERR_VALUE);
    quantity = quantity_of(PDN_NODE_POSITION, parts.body);
    CHECK_STATUS(pdn_table_add_quantity(table, solution, &quantity, "p"), PDN_OK);
    CHECK_STATUS(pdn_table_write_csv(table, "test_quantity.csv"), PDN_OK);
    pdn_table_free(table);
    file = fopen("test_quantity.csv", "rb");
    CHECK(file != NULL && fgets(line, sizeof line, file) != NULL);
    CHECK(strncmp(line, "t,node", 6) == 0);
    CHECK(strstr(line, ".velocity.angular_z,spin,p.x,p.y,p.z") != NULL);
    CHECK(fclose(file) == 0);
}

static void bad_input(void)
{
    double out[MOST * TIMES];
    pdn_quantity quantity, good = quantity_of(PDN_NODE_POSITION, parts.body);
    CHECK_STATUS(pdn_solution_sample(solution, NULL, times, TIMES, out), PDN_ERR_NULL);
    CHECK_STATUS(pdn_solution_sample(solution, &good, times, TIMES, NULL), PDN_ERR_NULL);
    CHECK_STATUS(pdn_solution_sample(NULL, &good, times, TIMES, out), PDN_ERR_NULL);
    PDN_INIT(pdn_quantity, &quantity);
    CHECK(pdn_quantity_components(&quantity) == PDN_ERR_VALUE);
    /* A kind of another list. */
    quantity.kind = PDN_PART_MEAN;
    CHECK(pdn_quantity_components(&quantity) == PDN_ERR_VALUE);
    /* An object of another kind. */
    quantity = good;
    quantity.kind = PDN_JOINT_REACTION;
    CHECK(pdn_quantity_components(&quantity) == PDN_ERR_ID);
    quantity = good;
    quantity.component = 3;
    CHECK(pdn_quantity_components(&quantity) == PDN_ERR_VALUE);
    quantity.component = -1;
    CHECK(pdn_quantity_components(&quantity) == PDN_ERR_ID);
    quantity = good;
    quantity.object = 999;
    CHECK_STATUS(pdn_solution_sample(solution, &quantity, times, TIMES, out), PDN_ERR_ID);
    quantity.object = -1;
    CHECK_STATUS(pdn_solution_sample(solution, &quantity, times, TIMES, out), PDN_ERR_ID);
    quantity = quantity_of(PDN_NODE_VELOCITY, parts.body);
    quantity.frame = 7;
    CHECK(pdn_quantity_components(&quantity) == PDN_ERR_VALUE);
    quantity = quantity_of(PDN_JOINT_COORDINATE, parts.hinge);
    CHECK(pdn_quantity_components(&quantity) == PDN_ERR_VALUE);
    quantity = quantity_of(PDN_BEAM_STRAIN, parts.beam.first_element);
    quantity.station = 1.5;
    CHECK_STATUS(pdn_solution_sample(solution, &quantity, times, TIMES, out), PDN_ERR_VALUE);
    quantity = quantity_of(PDN_FORCE_BRANCH_EFFORT, parts.spring);
    CHECK_STATUS(pdn_solution_sample(solution, &quantity, times, TIMES, out),
                 PDN_ERR_NOT_AVAILABLE);
    quantity = good;
    quantity.struct_size = 7;
    CHECK(pdn_quantity_components(&quantity) == PDN_ERR_STRUCT_SIZE);
}

int main(void)
{
    solve();
    components_alone_are_parts_of_all();
    one_call_is_the_same_as_a_struct();
    harmonics_and_extremes();
    columns();
    bad_input();
    pdn_solution_free(solution);
    return 0;
}
