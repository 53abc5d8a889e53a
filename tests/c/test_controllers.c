/* Controllers: an oscillator with an integral against its closed form, a gas force by another
 * joint's angle, what can be read of them, and calls that must be refused. */
#include "near.h"
#include <stdio.h>

enum { POINTS = 9, TIMES = 6 };

static const double MASS = 2, STIFFNESS = 5, INTEGRAL = 1.5, LOSS = 0.8, OMEGA = 1.7;
static const double times[TIMES] = {-1.0, 0.0, 0.37, 1.1, 2.5, 9.3};

static struct {
    pdn_model *model;
    int32_t input_joints[2], input_coordinates[2], output_joints[2], output_coordinates[2];
    double initial[1], sizes[1];
    size_t inputs, outputs, states;
    int32_t tangents, force;
    pdn_controller_fn function;
} in;
static struct {
    int32_t id;
} out;

static int model_changed(void)
{
    int32_t forces;
    CHECK_STATUS(pdn_model_force_count(in.model, &forces), PDN_OK);
    return forces != 2;
}

#include "refusal.h"

/* u = -i x - d q', x' = q. */
static int32_t integrate(const pdn_controller_state *state, pdn_controller_values *values,
                         void *user_data)
{
    int *calls = user_data;
    ++*calls;
    if (state->struct_size != sizeof *state || values->struct_size != sizeof *values ||
        state->input_count != 1 || state->state_count != 1 || values->output_count != 1)
        return 1;
    values->efforts[0] = -INTEGRAL * state->states[0] - LOSS * state->input_rates[0];
    values->state_rates[0] = state->inputs[0];
    if (values->by_inputs != NULL) {
        values->by_inputs[1] = 1;
        values->by_input_rates[0] = -LOSS;
        values->by_states[0] = -INTEGRAL;
    }
    return 0;
}

static void count_destroyed(void *user_data)
{
    ++*(int *)user_data;
}

/* A mass on a spring along x, and its slide. */
static int32_t oscillator(pdn_model *model, double stiffness)
{
    const double centre[3] = {0}, moments[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1}, axis[3] = {1, 0, 0};
    int32_t body, joint;
    CHECK_STATUS(pdn_model_add_rigid_body(model, MASS, centre, moments, &body), PDN_OK);
    CHECK_STATUS(pdn_model_add_prismatic(model, PDN_GROUND, body, centre, axis, &joint), PDN_OK);
    CHECK_STATUS(pdn_model_add_spring_damper(model, joint, PDN_DISPLACEMENT, stiffness, 0, 0, NULL),
                 PDN_OK);
    return joint;
}

static int32_t add(pdn_model *model, int32_t joint, int32_t tangents, void *user_data)
{
    const int32_t coordinate = PDN_DISPLACEMENT;
    const double initial = 0.25, size = 0.5;
    int32_t force;
    CHECK_STATUS(pdn_model_add_controller(model, &joint, &coordinate, 1, &joint, &coordinate, 1,
                                          &initial, &size, 1, tangents, integrate, user_data, NULL,
                                          &force),
                 PDN_OK);
    return force;
}

static pdn_solution *solve(const pdn_model *model)
{
    pdn_periodic_options options;
    pdn_solution *solution;
    PDN_INIT(pdn_periodic_options, &options);
    options.grid_points = POINTS;
    CHECK_STATUS(pdn_solve_periodic(model, 2 * PI / OMEGA, &options, &solution), PDN_OK);
    CHECK(pdn_solution_outcome(solution) == PDN_CONVERGED);
    return solution;
}

/* (k - m w^2 + i w d + i / (i w)) q = F, in parts of cosine and sine. */
static void an_integral_makes_it_third_order(void)
{
    const double force = 0.9, cosines[1] = {0.9}, sines[1] = {0};
    const double real = STIFFNESS - MASS * OMEGA * OMEGA;
    const double imaginary = OMEGA * LOSS - INTEGRAL / OMEGA;
    const double size = real * real + imaginary * imaginary;
    const int32_t given[2] = {PDN_TANGENTS_GIVEN, PDN_TANGENTS_DIFFERENCED};
    int i, k;
    for (i = 0; i < 2; i++) {
        double found[TIMES], state[TIMES], effort[TIMES], start, scale;
        int32_t joint, id, count[3], coordinate;
        int calls = 0;
        pdn_signal signal;
        pdn_quantity quantity;
        pdn_tangent_check check;
        pdn_force_info info;
        pdn_model *model;
        pdn_solution *solution;
        CHECK_STATUS(pdn_model_new(&model), PDN_OK);
        joint = oscillator(model, STIFFNESS);
        id = add(model, joint, given[i], &calls);
        PDN_INIT(pdn_signal, &signal);
        CHECK_STATUS(pdn_signal_set_harmonics(&signal, 0, 0, cosines, sines, 1), PDN_OK);
        CHECK_STATUS(pdn_model_add_actuator(model, joint, PDN_DISPLACEMENT, &signal, NULL), PDN_OK);
        solution = solve(model);
        CHECK(calls > POINTS);
        CHECK_STATUS(pdn_solution_sample(
                         solution, PDN_QUANTITY(PDN_JOINT_COORDINATE, joint, PDN_DISPLACEMENT),
                         times, TIMES, found),
                     PDN_OK);
        PDN_INIT(pdn_quantity, &quantity);
        quantity.kind = PDN_FORCE_CONTROL_STATE;
        quantity.object = id;
        CHECK_STATUS(pdn_solution_sample(solution, &quantity, times, TIMES, state), PDN_OK);
        quantity.kind = PDN_FORCE_CONTROL_EFFORT;
        CHECK_STATUS(pdn_solution_sample(solution, &quantity, times, TIMES, effort), PDN_OK);
        quantity.branch = 1;
        CHECK_STATUS(pdn_solution_sample(solution, &quantity, times, TIMES, effort),
                     PDN_ERR_NOT_AVAILABLE);
        for (k = 0; k < TIMES; k++) {
            const double c = cos(OMEGA * times[k]), s = sin(OMEGA * times[k]);
            const double rate = force * OMEGA * (-real * s + imaginary * c) / size;
            const double integral = force * (real * s - imaginary * c) / (OMEGA * size);
            CHECK_NEAR(found[k], force * (real * c + imaginary * s) / size, 1e-11);
            CHECK_NEAR(state[k], integral, 1e-11);
            CHECK_NEAR(effort[k], -INTEGRAL * integral - LOSS * rate, 1e-11);
        }

        PDN_INIT(pdn_tangent_check, &check);
        CHECK_STATUS(pdn_model_check_tangents(model, id, 2 * PI / OMEGA, &check),
                     i == 0 ? PDN_OK : PDN_ERR_NOT_AVAILABLE);
        CHECK(i == 1 || check.error < 1e-8);
        PDN_INIT(pdn_force_info, &info);
        CHECK_STATUS(pdn_model_force(model, id, &info), PDN_OK);
        CHECK(info.kind == PDN_FORCE_IS_CONTROLLER && info.joint == -1);
        CHECK_STATUS(pdn_model_controller_counts(model, id, &count[0], &count[1], &count[2]),
                     PDN_OK);
        CHECK(count[0] == 1 && count[1] == 1 && count[2] == 1);
        CHECK_STATUS(pdn_model_controller_counts(model, id, NULL, NULL, NULL), PDN_OK);
        for (k = 0; k < 2; k++) {
            int32_t of = -1;
            CHECK_STATUS(pdn_model_controller_coordinate(model, id, k, &of, &coordinate), PDN_OK);
            CHECK(of == joint && coordinate == PDN_DISPLACEMENT);
        }
        CHECK_STATUS(pdn_model_controller_coordinate(model, id, 2, &joint, &coordinate),
                     PDN_ERR_ID);
        CHECK_STATUS(pdn_model_controller_state(model, id, 0, &start, &scale), PDN_OK);
        CHECK(start == 0.25 && scale == 0.5);
        CHECK_STATUS(pdn_model_controller_state(model, id, 1, &start, &scale), PDN_ERR_ID);
        CHECK_STATUS(pdn_model_controller_counts(model, FORCE(0), &count[0], NULL, NULL),
                     PDN_ERR_NOT_AVAILABLE);
        pdn_solution_free(solution);
        pdn_model_free(model);
    }
}

/* A model from a file has no functions; they are bound by the label of the force. */
static void functions_are_bound_by_label(void)
{
    const char *path = "controllers.pdm";
    int32_t joint, id;
    int calls = 0, destroyed = 0;
    pdn_periodic_options options;
    pdn_model *model, *loaded;
    pdn_solution *solution = NULL;
    CHECK_STATUS(pdn_model_new(&model), PDN_OK);
    joint = oscillator(model, STIFFNESS);
    id = add(model, joint, PDN_TANGENTS_GIVEN, &calls);
    CHECK_STATUS(pdn_model_set_label(model, id, "governor"), PDN_OK);
    CHECK_STATUS(pdn_model_save(model, path), PDN_OK);
    CHECK_STATUS(pdn_model_load(path, &loaded), PDN_OK);
    remove(path);
    PDN_INIT(pdn_periodic_options, &options);
    options.grid_points = POINTS;
    CHECK_STATUS(pdn_solve_periodic(loaded, 2.0, &options, &solution), PDN_ERR_CALLBACK);
    CHECK_STATUS(pdn_model_find_label(loaded, PDN_OBJECT_FORCE, "governor", &id), PDN_OK);
    CHECK_STATUS(pdn_model_bind_controller(loaded, id, PDN_TANGENTS_GIVEN, integrate, &calls, NULL),
                 PDN_OK);
    CHECK_STATUS(pdn_solve_periodic(loaded, 2.0, &options, &solution), PDN_OK);
    CHECK(calls > 0);
    pdn_solution_free(solution);
    /* What it had goes as another comes; what is refused is not taken over. */
    CHECK_STATUS(pdn_model_bind_controller(loaded, id, PDN_TANGENTS_GIVEN, integrate, &destroyed,
                                           count_destroyed),
                 PDN_OK);
    CHECK_STATUS(pdn_model_bind_controller(loaded, FORCE(0), PDN_TANGENTS_GIVEN, integrate,
                                           &destroyed, count_destroyed),
                 PDN_ERR_NOT_AVAILABLE);
    CHECK_STATUS(pdn_model_bind_controller(loaded, id, 7, integrate, &destroyed, count_destroyed),
                 PDN_ERR_VALUE);
    CHECK_STATUS(pdn_model_bind_controller(loaded, id, PDN_TANGENTS_GIVEN, NULL, &destroyed,
                                           count_destroyed),
                 PDN_ERR_NULL);
    CHECK(destroyed == 0);
    CHECK_STATUS(pdn_model_bind_controller(loaded, id, PDN_TANGENTS_GIVEN, integrate, &calls, NULL),
                 PDN_OK);
    CHECK(destroyed == 1);
    pdn_model_free(loaded);
    pdn_model_free(model);
}

static void reset(void)
{
    in.input_joints[0] = in.input_joints[1] = JOINT(0);
    in.output_joints[0] = in.output_joints[1] = JOINT(0);
    in.input_coordinates[0] = in.input_coordinates[1] = PDN_DISPLACEMENT;
    in.output_coordinates[0] = in.output_coordinates[1] = PDN_DISPLACEMENT;
    in.initial[0] = 0;
    in.sizes[0] = 1;
    in.inputs = in.outputs = in.states = 1;
    in.tangents = PDN_TANGENTS_DIFFERENCED;
    in.function = integrate;
}

static pdn_status call(void)
{
    static int destroyed;
    const pdn_status status = pdn_model_add_controller(
        in.model, in.input_joints, in.input_coordinates, in.inputs, in.output_joints,
        in.output_coordinates, in.outputs, in.initial, in.sizes, in.states, in.tangents,
        in.function, &destroyed, count_destroyed, &out.id);
    CHECK(destroyed == 0);
    return status;
}

/* The call is refused after a change of what it is given. */
#define REFUSES(change, status, start)                                                             \
    do {                                                                                           \
        reset();                                                                                   \
        change;                                                                                    \
        REFUSED(call(), status, start);                                                            \
    } while (0)

static void what_makes_no_controller_is_refused(void)
{
    int calls = 0;
    CHECK_STATUS(pdn_model_new(&in.model), PDN_OK);
    add(in.model, oscillator(in.model, STIFFNESS), PDN_TANGENTS_GIVEN, &calls);
    REFUSES(in.input_joints[0] = 1, PDN_ERR_ID, "input_joints[0]");
    REFUSES(in.output_joints[0] = -1, PDN_ERR_ID, "output_joints[0]");
    REFUSES(in.input_coordinates[0] = 77, PDN_ERR_VALUE, "input_coordinates[0]");
    REFUSES(in.input_coordinates[0] = PDN_ROTATION, PDN_ERR_NOT_AVAILABLE, "input[0]");
    REFUSES(in.output_coordinates[0] = PDN_ROTATION, PDN_ERR_NOT_AVAILABLE, "output[0]");
    REFUSES(in.inputs = 2, PDN_ERR_VALUE, "inputs");
    REFUSES(in.outputs = 2, PDN_ERR_VALUE, "outputs");
    REFUSES(in.outputs = 0, PDN_ERR_SIZE, "output_count");
    REFUSES(in.sizes[0] = 0, PDN_ERR_VALUE, "sizes[0]");
    REFUSES(in.sizes[0] = NAN, PDN_ERR_NOT_FINITE, "sizes");
    REFUSES(in.initial[0] = INFINITY, PDN_ERR_NOT_FINITE, "initial");
    REFUSES(in.tangents = 7, PDN_ERR_VALUE, "tangents");
    REFUSES(in.function = NULL, PDN_ERR_NULL, "function");
    pdn_model_free(in.model);
}

int main(void)
{
    an_integral_makes_it_third_order();
    functions_are_bound_by_label();
    what_makes_no_controller_is_refused();
    printf("%d calls refused\n", refusals);
    return 0;
}
