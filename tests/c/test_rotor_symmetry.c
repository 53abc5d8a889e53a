/* Rotors of like blades: three masses on hinged arms move as they do without symmetry, what was
 * said can be read, and calls that must be refused. */
#include <math.h>

#include "check.h"

enum { BLADES = 3, TIMES = 7 };

static struct {
    pdn_model *model;
    double axis[3], point[3];
    int32_t nodes[BLADES], hub[1];
} in;
static struct {
    double axis[3], point[3];
    int32_t blades, nodes, hub, node;
} out;

static int model_changed(void)
{
    double axis[3], point[3];
    int32_t blades, nodes, hub;
    CHECK_STATUS(pdn_model_rotor_symmetry(in.model, axis, point, &blades, &nodes, &hub), PDN_OK);
    return axis[2] != 1 || point[0] != 0 || blades != BLADES || nodes != 1 || hub != 1;
}

#include "refusal.h"

/* A hub that turns once a second about an upright axis on a soft support, and three bodies on flap
 * hinges with springs; gravity along `tilt` and up. */
static void build(double tilt)
{
    const double pi = 3.14159265358979323846, origin[3] = {0}, up[3] = {0, 0, 1};
    const double ball[9] = {0.1, 0, 0, 0, 0.1, 0, 0, 0, 0.1}, gravity[3] = {tilt, 0, -9.81};
    const int32_t slides[2] = {PDN_DISPLACEMENT, PDN_DISPLACEMENT_2};
    int32_t mast, support, shaft, spring;
    pdn_signal turn;
    PDN_INIT(pdn_signal, &turn);
    CHECK_STATUS(pdn_signal_set_harmonics(&turn, 0, 2 * pi, NULL, NULL, 0), PDN_OK);
    CHECK_STATUS(pdn_model_new(&in.model), PDN_OK);
    CHECK_STATUS(pdn_model_set_gravity(in.model, gravity), PDN_OK);
    CHECK_STATUS(pdn_model_add_rigid_body(in.model, 3, origin, ball, &mast), PDN_OK);
    CHECK_STATUS(pdn_model_add_rigid_body(in.model, 2, origin, ball, &in.hub[0]), PDN_OK);
    CHECK_STATUS(pdn_model_add_planar(in.model, PDN_GROUND, mast, origin, up, &support), PDN_OK);
    for (int k = 0; k < 2; ++k)
        CHECK_STATUS(pdn_model_add_spring_damper(in.model, support, slides[k], 900 + 500 * k, 20, 0,
                                                 &spring),
                     PDN_OK);
    CHECK_STATUS(pdn_model_add_spring_damper(in.model, support, PDN_ROTATION, 50, 5, 0, &spring),
                 PDN_OK);
    CHECK_STATUS(pdn_model_add_revolute(in.model, mast, in.hub[0], origin, up, &shaft), PDN_OK);
    CHECK_STATUS(pdn_model_prescribe(in.model, shaft, PDN_ROTATION, &turn, NULL), PDN_OK);
    for (int i = 0; i < BLADES; ++i) {
        const double c = cos(2 * pi * i / BLADES), s = sin(2 * pi * i / BLADES);
        const double root[3] = {0.2 * c, 0.2 * s, 0}, centre[3] = {c, s, 0}, flap[3] = {s, -c, 0};
        int32_t hinge;
        CHECK_STATUS(pdn_model_add_rigid_body(in.model, 1, centre, ball, &in.nodes[i]), PDN_OK);
        CHECK_STATUS(pdn_model_add_revolute(in.model, in.hub[0], in.nodes[i], root, flap, &hinge),
                     PDN_OK);
        CHECK_STATUS(pdn_model_add_spring_damper(in.model, hinge, PDN_ROTATION, 40, 1, 0, &spring),
                     PDN_OK);
    }
}

static void set_symmetry(void)
{
    const double twice_up[3] = {0, 0, 2};
    CHECK_STATUS(
        pdn_model_set_rotor_symmetry(in.model, twice_up, BLADES, in.nodes, BLADES, in.hub, 1, NULL),
        PDN_OK);
}

/* Where the second blade is. */
static void solve(double positions[TIMES][3])
{
    double times[TIMES];
    pdn_periodic_options options;
    pdn_solution *solution;
    for (int i = 0; i < TIMES; ++i)
        times[i] = (double)i / TIMES;
    PDN_INIT(pdn_periodic_options, &options);
    options.grid_points = 21;
    options.linear_solver = PDN_LINEAR_DIRECT;
    CHECK_STATUS(pdn_solve_periodic(in.model, 1, &options, &solution), PDN_OK);
    CHECK(pdn_solution_outcome(solution) == PDN_CONVERGED);
    CHECK_STATUS(pdn_solution_sample(
                     solution, PDN_QUANTITY(PDN_NODE_POSITION, in.nodes[1], PDN_ALL_COMPONENTS),
                     times, TIMES, positions[0]),
                 PDN_OK);
    pdn_solution_free(solution);
}

static void blades_move_as_in_whole(void)
{
    double whole[TIMES][3], one[TIMES][3];
    solve(whole);
    set_symmetry();
    solve(one);
    for (int i = 0; i < TIMES; ++i)
        for (int k = 0; k < 3; ++k)
            CHECK(fabs(whole[i][k] - one[i][k]) < 1e-10); /* of a metre: rounding */
}

static void what_was_said_can_be_read(void)
{
    CHECK(!model_changed());
    CHECK_STATUS(pdn_model_rotor_node(in.model, 2, 0, &out.node), PDN_OK);
    CHECK(out.node == in.nodes[2]);
    CHECK_STATUS(pdn_model_rotor_node(in.model, -1, 0, &out.node), PDN_OK);
    CHECK(out.node == in.hub[0]);
}

static void bad_calls_are_refused(void)
{
    const double zero[3] = {0};
    const int32_t twice[BLADES] = {in.nodes[0], in.nodes[1], in.nodes[0]};
    const int32_t nowhere[BLADES] = {in.nodes[0], in.nodes[1], 99};
#define CALL pdn_model_set_rotor_symmetry
    in.axis[2] = 1;
    REFUSED(CALL(NULL, in.axis, 3, in.nodes, 3, in.hub, 1, NULL), PDN_ERR_NULL, "model: ");
    REFUSED(CALL(in.model, NULL, 3, in.nodes, 3, in.hub, 1, NULL), PDN_ERR_NULL, "axis: ");
    REFUSED(CALL(in.model, zero, 3, in.nodes, 3, in.hub, 1, NULL), PDN_ERR_VALUE, "axis: ");
    REFUSED(CALL(in.model, in.axis, 3, NULL, 3, in.hub, 1, NULL), PDN_ERR_NULL, "nodes: ");
    REFUSED(CALL(in.model, in.axis, 3, in.nodes, 3, NULL, 1, NULL), PDN_ERR_NULL, "hub: ");
    REFUSED(CALL(in.model, in.axis, 3, twice, 3, in.hub, 1, NULL), PDN_ERR_VALUE, "nodes: ");
    REFUSED(CALL(in.model, in.axis, 3, nowhere, 3, in.hub, 1, NULL), PDN_ERR_ID, "nodes[2]: ");
    REFUSED(CALL(in.model, in.axis, 3, in.nodes, 3, in.nodes, 1, NULL), PDN_ERR_VALUE, "nodes: ");
    REFUSED(CALL(in.model, in.axis, 3, in.nodes, 2, in.hub, 1, NULL), PDN_ERR_SIZE, "count: ");
    REFUSED(CALL(in.model, in.axis, 3, in.nodes, 0, in.hub, 1, NULL), PDN_ERR_SIZE, "count: ");
    REFUSED(CALL(in.model, in.axis, -1, in.nodes, 3, in.hub, 1, NULL), PDN_ERR_SIZE, "count: ");
    REFUSED(CALL(in.model, in.axis, 1, in.nodes, 3, in.hub, 1, NULL), PDN_ERR_SIZE, "blades: ");
    REFUSED(CALL(in.model, in.axis, 3, in.nodes, SIZE_MAX, in.hub, 1, NULL), PDN_ERR_SIZE,
            "count: ");
    REFUSED(CALL(in.model, in.axis, 3, in.nodes, 3, in.hub, SIZE_MAX, NULL), PDN_ERR_SIZE,
            "hub_count: ");
    REFUSES_NOT_FINITE_ENTRIES(in.axis, 3, CALL(in.model, in.axis, 3, in.nodes, 3, in.hub, 1, NULL),
                               "axis");
    REFUSES_NOT_FINITE_ENTRIES(
        in.point, 3, CALL(in.model, in.axis, 3, in.nodes, 3, in.hub, 1, in.point), "point");
#undef CALL
#define CALL(model, axis, point)                                                                   \
    pdn_model_rotor_symmetry(model, axis, point, &out.blades, &out.nodes, &out.hub)
    REFUSED(CALL(NULL, out.axis, out.point), PDN_ERR_NULL, "model: ");
    REFUSED(CALL(in.model, NULL, out.point), PDN_ERR_NULL, "axis: ");
    REFUSED(CALL(in.model, out.axis, NULL), PDN_ERR_NULL, "point: ");
#undef CALL
#define CALL pdn_model_rotor_node
    REFUSED(CALL(NULL, 0, 0, &out.node), PDN_ERR_NULL, "model: ");
    REFUSED(CALL(in.model, 3, 0, &out.node), PDN_ERR_ID, "blade: ");
    REFUSED(CALL(in.model, -2, 0, &out.node), PDN_ERR_ID, "blade: ");
    REFUSED(CALL(in.model, 0, 1, &out.node), PDN_ERR_ID, "index: ");
    REFUSED(CALL(in.model, -1, -1, &out.node), PDN_ERR_ID, "index: ");
    REFUSED(CALL(in.model, 0, 0, NULL), PDN_ERR_NULL, "node: ");
#undef CALL
    pdn_model *model;
    CHECK_STATUS(pdn_model_new(&model), PDN_OK);
    REFUSED(pdn_model_rotor_node(model, 0, 0, &out.node), PDN_ERR_NOT_AVAILABLE, "model: ");
    pdn_model_free(model);
}

/* A mass on one blade: a solve says which node it is. */
static void unlike_blades_are_refused(void)
{
    const double centre[3] = {0}, inertia[9] = {0};
    char message[512];
    pdn_solution *solution = NULL;
    CHECK_STATUS(pdn_model_add_mass(in.model, in.nodes[1], 0.1, centre, inertia, NULL), PDN_OK);
    CHECK_STATUS(pdn_solve_periodic(in.model, 1, NULL, &solution), PDN_ERR_MODEL);
    pdn_last_error(message, sizeof message);
    CHECK(solution == NULL && strstr(message, "rotor symmetry") && strstr(message, "inertia"));
}

int main(void)
{
    build(0.5);
    blades_move_as_in_whole();
    what_was_said_can_be_read();
    bad_calls_are_refused();
    unlike_blades_are_refused();
    pdn_model_free(in.model);
    printf("%d calls refused\n", refusals);
    return 0;
}
