/* Free parameters under conditions, and branches, against values of prototypes in reduced
 * coordinates: a limit cycle, a family of free motions, a response with two folds. */
#include "near.h"

enum { POINTS = 51 };

static const double ORIGIN[3] = {0, 0, 0}, AXIS[3] = {1, 0, 0};
static const double BALL[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};

static pdn_model *model;
static int32_t body, joint, force;

/* A mass of 1 on a slide. */
static void begin(void)
{
    CHECK_STATUS(pdn_model_new(&model), PDN_OK);
    CHECK_STATUS(pdn_model_add_rigid_body(model, 1, ORIGIN, BALL, &body), PDN_OK);
    CHECK_STATUS(pdn_model_add_prismatic(model, PDN_GROUND, body, ORIGIN, AXIS, &joint), PDN_OK);
}

/* x'' - (1 - x^2) x' + x = 0, and the largest time that it is told. */
static int32_t van_der_pol(double time, double x, double v, double *effort, double *derivatives,
                           void *user_data)
{
    double *const latest = user_data;
    *latest = fmax(*latest, time);
    *effort = x - (1 - x * x) * v;
    if (derivatives) {
        derivatives[0] = 1 + 2 * x * v;
        derivatives[1] = -(1 - x * x);
    }
    return 0;
}

static void limit_cycle(void)
{
    static double positions[POINTS][3], rotations[POINTS][9];
    double latest = 0, frequency;
    pdn_conditions *conditions;
    pdn_solution *solution = NULL;
    begin();
    CHECK_STATUS(pdn_model_add_coordinate_law(model, joint, PDN_DISPLACEMENT, PDN_TANGENTS_GIVEN,
                                              van_der_pol, &latest, NULL, &force),
                 PDN_OK);
    CHECK_STATUS(pdn_conditions_new(&conditions), PDN_OK);
    CHECK_STATUS(pdn_conditions_release(conditions, PDN_FREQUENCY), PDN_OK);

    pdn_periodic_options options;
    PDN_INIT(pdn_periodic_options, &options);
    for (int k = 0; k < POINTS; ++k) {
        positions[k][0] = 2 * cos(2 * PI * k / POINTS);
        rotations[k][0] = rotations[k][4] = rotations[k][8] = 1;
    }
    options.grid_points = POINTS;
    options.guess_positions = positions[0];
    options.guess_rotations = rotations[0];
    CHECK_STATUS(pdn_solve_conditioned(model, 6.5, conditions, &options, &solution), PDN_ERR_SIZE);
    CHECK_MESSAGE("conditions: expected as many as there are free parameters (1), got 0");
    CHECK_STATUS(pdn_conditions_add_phase(conditions), PDN_OK);
    CHECK_STATUS(pdn_solve_conditioned(model, 6.5, conditions, &options, &solution),
                 PDN_ERR_NOT_PERIODIC);
    CHECK_MESSAGE("the function of force 0 has a frequency of its own");
    CHECK_STATUS(pdn_model_declare_of_phase(model, force), PDN_OK);
    latest = 0;
    CHECK_STATUS(pdn_solve_conditioned(model, 6.5, conditions, &options, &solution), PDN_OK);
    CHECK(pdn_solution_outcome(solution) == PDN_CONVERGED);
    /* It is told the phase. */
    CHECK(latest < 4 * PI && latest > 6);
    CHECK_STATUS(pdn_solution_parameter(solution, PDN_FREQUENCY, &frequency), PDN_OK);
    CHECK_NEAR(2 * PI / frequency, 6.663286859323, 2e-12);
    CHECK_STATUS(pdn_solution_parameter(solution, PARAMETER(0), &frequency), PDN_ERR_ID);
    pdn_solution_free(solution);

    /* From rest nothing tells the phase. */
    options.guess_positions = options.guess_rotations = NULL;
    CHECK_STATUS(pdn_solve_conditioned(model, 6.5, conditions, &options, &solution), PDN_ERR_VALUE);
    CHECK_MESSAGE("stands still");
    pdn_conditions_free(conditions);
    pdn_model_free(model);
}

/* A point mass on a rod of length 1, swinging freely from 60 degrees. */
static void free_motion(void)
{
    static double positions[POINTS][3], rotations[POINTS][9];
    const double bob[3] = {0, 0, -1}, point[9] = {0}, about[3] = {0, 1, 0};
    const double gravity[3] = {0, 0, -9.81}, angle = PI / 3;
    int32_t unfolding;
    double value, frequency;
    pdn_conditions *conditions;
    pdn_solution *solution;
    CHECK_STATUS(pdn_model_new(&model), PDN_OK);
    CHECK_STATUS(pdn_model_add_rigid_body(model, 1, bob, point, &body), PDN_OK);
    CHECK_STATUS(pdn_model_add_revolute(model, PDN_GROUND, body, ORIGIN, about, &joint), PDN_OK);
    CHECK_STATUS(pdn_model_set_gravity(model, gravity), PDN_OK);
    CHECK_STATUS(pdn_model_add_parameter(model, "unfolding", 0, 1, &unfolding), PDN_OK);
    CHECK_STATUS(pdn_model_move_number(model, unfolding, PDN_NUMBER_MASS_DAMPING, 0, 0, 1), PDN_OK);
    CHECK_STATUS(pdn_conditions_new(&conditions), PDN_OK);
    CHECK_STATUS(pdn_conditions_release(conditions, PDN_FREQUENCY), PDN_OK);
    CHECK_STATUS(pdn_conditions_release(conditions, unfolding), PDN_OK);
    CHECK_STATUS(pdn_conditions_add_phase(conditions), PDN_OK);
    CHECK_STATUS(pdn_conditions_add_joint_coordinate(conditions, joint, PDN_ROTATION, angle),
                 PDN_OK);
    for (int k = 0; k < POINTS; ++k) {
        const double q = angle * cos(2 * PI * k / POINTS), c = cos(q), s = sin(q);
        const double turned[9] = {c, 0, -s, 0, 1, 0, s, 0, c};
        memcpy(rotations[k], turned, sizeof turned);
        positions[k][0] = -s;
        positions[k][2] = -c;
    }
    pdn_periodic_options options;
    PDN_INIT(pdn_periodic_options, &options);
    options.grid_points = POINTS;
    options.guess_positions = positions[0];
    options.guess_rotations = rotations[0];
    CHECK_STATUS(pdn_solve_conditioned(model, 2.1, conditions, &options, &solution), PDN_OK);
    CHECK(pdn_solution_outcome(solution) == PDN_CONVERGED);
    CHECK_STATUS(pdn_solution_parameter(solution, PDN_FREQUENCY, &frequency), PDN_OK);
    CHECK_NEAR(2 * PI / frequency, 2.152874666881, 2e-12);
    CHECK_STATUS(pdn_solution_parameter(solution, unfolding, &value), PDN_OK);
    CHECK_NEAR(value, 0, 1e-12);

    /* Followed to larger amplitudes: periods by the arithmetic-geometric mean. */
    int32_t count;
    double at[3], start[1] = {0};
    pdn_branch_options along;
    pdn_branch *branch;
    pdn_conditions_free(conditions);
    CHECK_STATUS(pdn_conditions_new(&conditions), PDN_OK);
    CHECK_STATUS(pdn_conditions_release(conditions, unfolding), PDN_OK);
    CHECK_STATUS(pdn_conditions_add_phase(conditions), PDN_OK);
    PDN_INIT(pdn_branch_options, &along);
    PDN_INIT(pdn_periodic_options, &options);
    options.grid_points = 81;
    options.initial = solution;
    along.periodic = &options;
    along.conditions = conditions;
    along.from = 2.4;
    along.to = 3;
    along.downwards = 1;
    CHECK_STATUS(pdn_follow_branch(model, 2 * PI / frequency, PDN_FREQUENCY, &along, &branch),
                 PDN_OK);
    pdn_solution_free(solution);
    CHECK(pdn_branch_end(branch) == PDN_BRANCH_RANGE);
    CHECK_STATUS(pdn_branch_count(branch, &count), PDN_OK);
    CHECK(count > 3);
    for (int32_t i = 0; i < count; ++i) {
        CHECK_STATUS(pdn_branch_solution(branch, i, &solution), PDN_OK);
        CHECK_STATUS(pdn_solution_parameter(solution, unfolding, &value), PDN_OK);
        CHECK_STATUS(pdn_solution_parameter(solution, PDN_FREQUENCY, &frequency), PDN_OK);
        CHECK_STATUS(pdn_solution_sample(solution,
                                         PDN_QUANTITY(PDN_NODE_POSITION, body, PDN_ALL_COMPONENTS),
                                         start, 1, at),
                     PDN_OK);
        double a = 1, b = cos(atan2(hypot(at[0], at[1]), -at[2]) / 2);
        for (int k = 0; k < 8; ++k) {
            const double mean = (a + b) / 2;
            b = sqrt(a * b);
            a = mean;
        }
        CHECK_NEAR(value, 0, 1e-11);
        CHECK_NEAR(frequency, sqrt(9.81) * a, 1e-10);
        pdn_solution_free(solution);
    }
    pdn_branch_free(branch);
    pdn_conditions_free(conditions);
    pdn_model_free(model);
}

/* x'' + 0.05 x' + x + 0.1 x^3 = 0.18 cos wt. */
static void begin_duffing(void)
{
    const double stiffness[3] = {1, 0, 0.1}, damping[1] = {0.05}, size[1] = {0.18}, none[1] = {0};
    pdn_signal push;
    begin();
    CHECK_STATUS(pdn_model_add_nonlinear_spring_damper(model, joint, PDN_DISPLACEMENT, stiffness, 3,
                                                       damping, 1, 0, NULL),
                 PDN_OK);
    PDN_INIT(pdn_signal, &push);
    CHECK_STATUS(pdn_signal_set_harmonics(&push, 0, 0, size, none, 1), PDN_OK);
    CHECK_STATUS(pdn_model_add_actuator(model, joint, PDN_DISPLACEMENT, &push, &force), PDN_OK);
}

static int32_t count_points(const pdn_branch_point *point, int32_t number, void *user_data)
{
    int32_t *const most = user_data;
    CHECK(point->struct_size == sizeof *point);
    return number >= *most;
}

static void frequency_response(void)
{
    const double folds[2] = {1.269601955546, 1.115700251771};
    int32_t count, found = 0, most = 3;
    pdn_periodic_options periodic;
    pdn_branch_options options;
    pdn_branch_point point;
    pdn_branch *branch;
    pdn_solution *solution;
    char report[2048];
    begin_duffing();
    PDN_INIT(pdn_periodic_options, &periodic);
    PDN_INIT(pdn_branch_options, &options);
    PDN_INIT(pdn_branch_point, &point);
    periodic.grid_points = 31;
    options.periodic = &periodic;
    CHECK_STATUS(pdn_solve_frequency_response(model, 0.9, 1.6, &options, &branch), PDN_OK);
    CHECK(pdn_branch_end(branch) == PDN_BRANCH_RANGE);
    CHECK_STATUS(pdn_branch_count(branch, &count), PDN_OK);
    for (int32_t i = 0; i < count; ++i) {
        CHECK_STATUS(pdn_branch_get(branch, i, &point), PDN_OK);
        CHECK(point.angle <= 0.4 && point.grid_points == 31);
        CHECK_NEAR(point.parameter * point.period, 2 * PI, 1e-12);
        if (point.event == PDN_EVENT_FOLD) {
            CHECK(found < 2);
            CHECK_NEAR(point.parameter, folds[found], 2e-12);
            CHECK_NEAR(point.slope, 0, 1e-9);
            ++found;
        }
    }
    CHECK(found == 2);
    CHECK_NEAR(point.parameter, 1.6, 1e-14);
    CHECK(pdn_branch_report(branch, report, sizeof report) < sizeof report);
    CHECK(strstr(report, "fold at 1.2696019555") != NULL);

    /* A point is a solution. */
    double frequency, q[1], t[1] = {0};
    CHECK_STATUS(pdn_branch_solution(branch, count - 1, &solution), PDN_OK);
    CHECK_STATUS(pdn_solution_parameter(solution, PDN_FREQUENCY, &frequency), PDN_OK);
    CHECK_NEAR(frequency, 1.6, 1e-14);
    CHECK_STATUS(pdn_solution_sample(solution,
                                     PDN_QUANTITY(PDN_JOINT_COORDINATE, joint, PDN_DISPLACEMENT), t,
                                     1, q),
                 PDN_OK);
    CHECK(fabs(q[0]) > 0.05 && fabs(q[0]) < 0.2);
    pdn_solution_free(solution);
    CHECK_STATUS(pdn_branch_solution(branch, count, &solution), PDN_ERR_ID);
    CHECK_STATUS(pdn_branch_get(branch, -1, &point), PDN_ERR_ID);
    pdn_quantity outputs[2];
    for (int i = 0; i < 2; ++i) {
        PDN_INIT(pdn_quantity, &outputs[i]);
        outputs[i].kind = i ? PDN_FORCE_EFFORT : PDN_NODE_POSITION;
        outputs[i].object = i ? FORCE(0) : body;
    }
    CHECK_STATUS(pdn_branch_write_csv(branch, outputs, 2, "test_families.csv"), PDN_OK);
    CHECK_STATUS(pdn_branch_write_csv(branch, NULL, 0, "test_families.csv"), PDN_OK);
    CHECK_STATUS(pdn_branch_write_csv(branch, NULL, 1, "test_families.csv"), PDN_ERR_NULL);
    outputs[1].component = 3;
    CHECK_STATUS(pdn_branch_write_csv(branch, outputs, 2, "test_families.csv"), PDN_ERR_VALUE);
    CHECK_MESSAGE("quantities[1]: ");
    outputs[1].struct_size -= 8;
    CHECK_STATUS(pdn_branch_write_csv(branch, outputs, 2, "test_families.csv"),
                 PDN_ERR_STRUCT_SIZE);
    const int32_t blades[2] = {body, body}, none[2] = {body, NODE(99)};
    const char *path = "test_families.csv";
    CHECK_STATUS(pdn_branch_write_campbell(branch, NULL, NULL, 0, path), PDN_OK);
    CHECK_STATUS(pdn_branch_write_campbell(branch, NULL, NULL, 1, path), PDN_ERR_NULL);
    CHECK_STATUS(pdn_branch_write_campbell(branch, NULL, blades, 1, path), PDN_ERR_SIZE);
    CHECK_MESSAGE("blades: ");
    CHECK_STATUS(pdn_branch_write_campbell(branch, NULL, blades, 2, path), PDN_ERR_VALUE);
    CHECK_STATUS(pdn_branch_write_campbell(branch, NULL, none, 2, path), PDN_ERR_ID);
    CHECK_MESSAGE("blades[1]: ");
    CHECK_STATUS(pdn_branch_write_campbell(branch, NULL, NULL, 0, NULL), PDN_ERR_NULL);
    pdn_branch_free(branch);

    /* Downwards, and ended by the caller. */
    options.progress = count_points;
    options.progress_data = &most;
    CHECK_STATUS(pdn_solve_frequency_response(model, 0.9, 0.5, &options, &branch), PDN_OK);
    CHECK(pdn_branch_end(branch) == PDN_BRANCH_CANCELLED);
    CHECK_STATUS(pdn_branch_count(branch, &count), PDN_OK);
    CHECK(count == most);
    CHECK_STATUS(pdn_branch_get(branch, 2, &point), PDN_OK);
    CHECK(point.parameter < 0.9);
    pdn_branch_free(branch);
    pdn_model_free(model);
}

static void along_a_load(void)
{
    int32_t load;
    pdn_branch_options options;
    pdn_branch_point point;
    pdn_branch *branch;
    begin_duffing();
    CHECK_STATUS(pdn_model_add_parameter(model, "load", 1, 1, &load), PDN_OK);
    PDN_INIT(pdn_branch_options, &options);
    PDN_INIT(pdn_branch_point, &point);
    options.from = 0.5;
    options.to = 1.5;
    CHECK_STATUS(pdn_follow_branch(model, 2 * PI / 0.8, load, &options, &branch), PDN_ERR_VALUE);
    CHECK_MESSAGE("the parameter \"load\" moves nothing");
    CHECK_STATUS(pdn_model_move_signal(model, load, force, 0, PDN_PART_AMPLITUDE, 1), PDN_OK);
    CHECK_STATUS(pdn_follow_branch(model, 2 * PI / 0.8, load, &options, &branch), PDN_OK);
    CHECK(pdn_branch_end(branch) == PDN_BRANCH_RANGE);
    CHECK_STATUS(pdn_branch_get(branch, 0, &point), PDN_OK);
    CHECK_NEAR(point.parameter, 1, 1e-15);
    pdn_branch_free(branch);
    options.from = 1.2;
    CHECK_STATUS(pdn_follow_branch(model, 2 * PI / 0.8, load, &options, &branch), PDN_ERR_VALUE);
    CHECK_MESSAGE("the parameter \"load\" between 1.2 and 1.5, got 1");

    /* What is wrong with parameters. */
    CHECK_STATUS(pdn_model_add_parameter(model, "load", 1, 1, &load), PDN_ERR_VALUE);
    CHECK_STATUS(pdn_model_move_number(model, PARAMETER(3), PDN_NUMBER_REST, FORCE(0), 0, 1),
                 PDN_ERR_ID);
    CHECK_STATUS(pdn_model_move_number(model, load, PDN_NUMBER_STIFFNESS, FORCE(0), 4, 1),
                 PDN_ERR_ID);
    CHECK_STATUS(pdn_model_move_number(model, load, 99, 0, 0, 1), PDN_ERR_VALUE);
    CHECK_STATUS(pdn_model_move_signal(model, load, force, 0, PDN_PART_AMPLITUDE, 1),
                 PDN_ERR_VALUE);
    CHECK_MESSAGE("moves the same already");
    CHECK_STATUS(pdn_model_move_signal(model, load, PDN_GRAVITY, 0, PDN_PART_MEAN, 1), PDN_ERR_ID);
    CHECK_STATUS(pdn_model_set_parameter(model, load, 2), PDN_OK);
    CHECK_STATUS(pdn_model_declare_of_phase(model, FORCE(0)), PDN_ERR_NOT_AVAILABLE);
    CHECK_STATUS(pdn_solve_frequency_response(model, 0, 1, NULL, &branch), PDN_ERR_VALUE);
    CHECK_STATUS(pdn_solve_frequency_response(model, 1, 1, NULL, &branch), PDN_ERR_VALUE);
    pdn_model_free(model);
}

/* A mass on a spring of 4 with damping 0.1 is in resonance at 2, where its velocity has no sine. */
static void resonance(void)
{
    const double cosines[1] = {0.3}, sines[1] = {0};
    double frequency, mean, rate, cosine[1], sine[1];
    pdn_conditions *conditions;
    pdn_solution *solution = NULL;
    pdn_quantity velocity;
    pdn_signal push;
    pdn_periodic_options options;
    begin();
    CHECK_STATUS(pdn_model_add_spring_damper(model, joint, PDN_DISPLACEMENT, 4, 0.1, 0, &force),
                 PDN_OK);
    PDN_INIT(pdn_signal, &push);
    CHECK_STATUS(pdn_signal_set_harmonics(&push, 0, 0, cosines, sines, 1), PDN_OK);
    CHECK_STATUS(pdn_model_add_actuator(model, joint, PDN_DISPLACEMENT, &push, &force), PDN_OK);
    CHECK_STATUS(pdn_conditions_new(&conditions), PDN_OK);
    CHECK_STATUS(pdn_conditions_release(conditions, PDN_FREQUENCY), PDN_OK);
    PDN_INIT(pdn_quantity, &velocity);
    velocity.kind = PDN_NODE_VELOCITY;
    velocity.object = body;
    CHECK_STATUS(pdn_conditions_add_quantity(conditions, &velocity, PDN_FEATURE_SINE, 1, 0, 0),
                 PDN_ERR_VALUE);
    CHECK_MESSAGE("quantity.component");
    velocity.component = 0;
    CHECK_STATUS(pdn_conditions_add_quantity(conditions, &velocity, PDN_FEATURE_SINE, 1.5, 0, 0),
                 PDN_ERR_VALUE);
    CHECK_STATUS(pdn_conditions_add_quantity(conditions, &velocity, 3, 1, 0, 0), PDN_ERR_VALUE);
    CHECK_STATUS(pdn_conditions_add_quantity(conditions, &velocity, PDN_FEATURE_SINE, 1, 0, -1),
                 PDN_ERR_VALUE);
    CHECK_STATUS(pdn_conditions_add_quantity(conditions, &velocity, PDN_FEATURE_SINE, 1, 0, 0),
                 PDN_OK);
    PDN_INIT(pdn_periodic_options, &options);
    options.grid_points = 9;
    CHECK_STATUS(pdn_solve_conditioned(model, 2 * PI / 1.98, conditions, &options, &solution),
                 PDN_OK);
    CHECK(pdn_solution_outcome(solution) == PDN_CONVERGED);
    CHECK_STATUS(pdn_solution_parameter(solution, PDN_FREQUENCY, &frequency), PDN_OK);
    CHECK_NEAR(frequency, 2, 1e-12);
    CHECK_STATUS(pdn_solution_harmonics(solution, &velocity, 1, &mean, &rate, cosine, sine),
                 PDN_OK);
    CHECK_NEAR(fabs(cosine[0]), 3, 1e-11);
    CHECK_NEAR(sine[0], 0, 1e-11);
    pdn_solution_free(solution);
    pdn_conditions_free(conditions);
    pdn_model_free(model);
}

int main(void)
{
    limit_cycle();
    resonance();
    free_motion();
    frequency_response();
    along_a_load();
    return 0;
}
