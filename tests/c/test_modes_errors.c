/* What the functions of modes refuse. */
#include "check.h"
#include <math.h>

/* Arguments, each of them good. */
static struct {
    const pdn_model *model;
    pdn_static_options equilibrium;
    pdn_modes_options options;
    const pdn_modes *modes;
    int32_t mode, nodes[2];
    double amplitude;
} in;

static struct {
    pdn_modes *modes;
    pdn_solution *solution;
    int32_t count, complete;
    double real[12], imaginary[12];
} out;

static int model_changed(void)
{
    return 0; /* model and modes are const */
}

#include "refusal.h"

static pdn_model *model;
static pdn_modes *modes;

static void set_up(void)
{
    const double centre[3] = {0, 0, -1}, origin[3] = {0, 0, 0}, axis[3] = {0, -1, 0};
    const double gravity[3] = {0, 0, -9.81}, inertia[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    int32_t hinge;
    CHECK_STATUS(pdn_model_new(&model), PDN_OK);
    CHECK_STATUS(pdn_model_add_rigid_body(model, 2, centre, inertia, &in.nodes[0]), PDN_OK);
    CHECK_STATUS(pdn_model_add_revolute(model, PDN_GROUND, NODE(0), origin, axis, &hinge), PDN_OK);
    CHECK_STATUS(pdn_model_set_gravity(model, gravity), PDN_OK);
    CHECK_STATUS(pdn_solve_modes(model, NULL, &modes), PDN_OK);
    in.model = model;
    in.modes = modes;
    in.amplitude = 0.1;
    PDN_INIT(pdn_static_options, &in.equilibrium);
    PDN_INIT(pdn_modes_options, &in.options);
    in.options.equilibrium = &in.equilibrium;
}

static pdn_status solve(void)
{
    return pdn_solve_modes(in.model, &in.options, &out.modes);
}

static void solving(void)
{
    static const size_t bad_counts[] = {0, 100001, (size_t)-1};
    static const size_t bad_struct_sizes[] = {0, 1, 7, 8, 24, 5000, (size_t)-1};
    static const double negative[] = {-1.0, -1e-300};
    static const size_t zero[] = {0};
    pdn_modes_options options;
    pdn_model *empty;
    pdn_solution *other;
    pdn_mode mode;
    int32_t node;
    const double origin[3] = {0, 0, 0}, inertia[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};

    pdn_modes_options_init(NULL, sizeof options);
    CHECK_MESSAGE("options: expected a pointer, got NULL");
    pdn_modes_options_init(&options, 7);
    CHECK_MESSAGE("struct_size: expected between");
    pdn_mode_init(NULL, sizeof mode);
    CHECK_MESSAGE("mode: expected a pointer, got NULL");
    pdn_mode_init(&mode, 7);
    CHECK_MESSAGE("struct_size: expected between");

    REFUSED(pdn_solve_modes(NULL, &in.options, &out.modes), PDN_ERR_NULL,
            "model: expected a pointer, got NULL");
    REFUSED(pdn_solve_modes(in.model, &in.options, NULL), PDN_ERR_NULL,
            "out: expected a pointer, got NULL");
    REFUSES_EACH(in.options.struct_size, size_t, bad_struct_sizes, solve(), PDN_ERR_STRUCT_SIZE,
                 "options: expected struct_size ");
    REFUSES_EACH(in.options.count, size_t, bad_counts, solve(), PDN_ERR_SIZE,
                 "options.count: expected 1 to 100000, got ");
    REFUSES_NOT_FINITE(in.options.near_frequency, solve(), "options.near_frequency");
    REFUSES_EACH(in.options.near_frequency, double, negative, solve(), PDN_ERR_VALUE,
                 "options.near_frequency: expected a positive angular frequency, got ");
    REFUSES_EACH(in.equilibrium.struct_size, size_t, bad_struct_sizes, solve(), PDN_ERR_STRUCT_SIZE,
                 "options.equilibrium: expected struct_size ");
    REFUSES_NOT_FINITE(in.equilibrium.time, solve(), "options.equilibrium.time");
    REFUSES_EACH(in.equilibrium.iteration_limit, size_t, zero, solve(), PDN_ERR_VALUE,
                 "options.equilibrium: options.iteration_limit: expected at least 1");
    in.equilibrium.angular_velocity[0] = 1;
    REFUSED(solve(), PDN_ERR_NOT_PERIODIC, "gravity: expected a direction along the axis");
    in.equilibrium.angular_velocity[0] = 0;

    CHECK_STATUS(pdn_model_new(&empty), PDN_OK);
    REFUSED(pdn_solve_modes(empty, NULL, &out.modes), PDN_ERR_MODEL,
            "model: expected at least one node, got none");
    CHECK_STATUS(pdn_model_add_rigid_body(empty, 1, origin, inertia, &node), PDN_OK);
    CHECK_STATUS(pdn_solve_static(empty, NULL, &other), PDN_OK);
    in.equilibrium.initial = other;
    REFUSED(solve(), PDN_ERR_VALUE,
            "options.equilibrium: options.initial: expected a solution of a model with the same");
    in.equilibrium.initial = NULL;
    pdn_solution_free(other);
    pdn_model_free(empty);
}

static void looking(void)
{
    static const int32_t bad_modes[] = {-1, 1, 99, INT32_MAX, INT32_MIN};
    static const int32_t bad_nodes[] = {-1, NO_IDS};
    static const size_t bad_struct_sizes[] = {0, 1, 7, 8, 48, 5000, (size_t)-1};
    size_t i;
    pdn_mode mode, before;
    PDN_INIT(pdn_mode, &mode);

    CHECK(pdn_modes_outcome(NULL) == PDN_ERR_NULL);
    CHECK(pdn_modes_report(NULL, NULL, 0) == 0);
    CHECK_MESSAGE("modes: expected a pointer, got NULL");
    REFUSED(pdn_modes_count(NULL, &out.count, &out.complete), PDN_ERR_NULL, "modes: expected a");
    REFUSED(pdn_modes_count(in.modes, NULL, &out.complete), PDN_ERR_NULL, "out: expected a");

    REFUSED(pdn_modes_get(NULL, 0, &mode), PDN_ERR_NULL, "modes: expected a pointer");
    REFUSED(pdn_modes_get(in.modes, 0, NULL), PDN_ERR_NULL, "out: expected a pointer");
    before = mode;
    for (i = 0; i < LENGTH(bad_modes); i++) {
        REFUSED(pdn_modes_get(in.modes, bad_modes[i], &mode), PDN_ERR_ID, "mode: expected ");
    }
    CHECK(memcmp(&before, &mode, sizeof mode) == 0);
    for (i = 0; i < LENGTH(bad_struct_sizes); i++) {
        mode.struct_size = bad_struct_sizes[i];
        REFUSED(pdn_modes_get(in.modes, 0, &mode), PDN_ERR_STRUCT_SIZE,
                "out: expected struct_size ");
    }

#define SHAPE pdn_modes_shape(in.modes, in.mode, in.nodes, 2, out.real, out.imaginary)
    REFUSED(pdn_modes_shape(NULL, 0, in.nodes, 2, out.real, NULL), PDN_ERR_NULL, "modes: expect");
    REFUSED(pdn_modes_shape(in.modes, 0, NULL, 2, out.real, NULL), PDN_ERR_NULL, "nodes: expect");
    REFUSED(pdn_modes_shape(in.modes, 0, in.nodes, 2, NULL, out.imaginary), PDN_ERR_NULL,
            "real: expected a pointer");
    REFUSED(pdn_modes_shape(in.modes, 0, in.nodes, (size_t)-1, out.real, NULL), PDN_ERR_SIZE,
            "nodes: expected at most ");
    REFUSES_EACH(in.mode, int32_t, bad_modes, SHAPE, PDN_ERR_ID, "mode: expected ");
    REFUSES_EACH(in.nodes[1], int32_t, bad_nodes, SHAPE, PDN_ERR_ID, "nodes[1]: expected a node");

#define MOTION pdn_modes_motion(in.modes, in.mode, in.amplitude, &out.solution)
    REFUSED(pdn_modes_motion(NULL, 0, 0.1, &out.solution), PDN_ERR_NULL, "modes: expected a");
    REFUSED(pdn_modes_motion(in.modes, 0, 0.1, NULL), PDN_ERR_NULL, "out: expected a pointer");
    REFUSES_EACH(in.mode, int32_t, bad_modes, MOTION, PDN_ERR_ID, "mode: expected ");
    REFUSES_NOT_FINITE(in.amplitude, MOTION, "amplitude");

    REFUSED(pdn_modes_equilibrium(NULL, &out.solution), PDN_ERR_NULL, "modes: expected a");
    REFUSED(pdn_modes_equilibrium(in.modes, NULL), PDN_ERR_NULL, "out: expected a pointer");
}

int main(void)
{
    set_up();
    solving();
    looking();
    pdn_modes_free(modes);
    pdn_model_free(model);
    printf("%d calls refused as they must be\n", refusals);
    return 0;
}
