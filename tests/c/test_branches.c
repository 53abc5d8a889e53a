/* Branches that switch, close, are saved and followed on, and events along a second parameter,
 * against values of prototypes in reduced coordinates and closed forms. */
#include "near.h"

static const double ORIGIN[3] = {0, 0, 0}, AXIS[3] = {1, 0, 0};
static const double BALL[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};

static pdn_model *model;
static int32_t body, joint, force;

/* A mass of 1 on a slide, on a spring and a damper, under size cos wt, and its load as a parameter
 * that is the size. */
static int32_t oscillator(const double *stiffness, size_t count, double damping, double size)
{
    const double sizes[1] = {size}, none[1] = {0};
    int32_t load;
    pdn_signal push;
    CHECK_STATUS(pdn_model_new(&model), PDN_OK);
    CHECK_STATUS(pdn_model_add_rigid_body(model, 1, ORIGIN, BALL, &body), PDN_OK);
    CHECK_STATUS(pdn_model_add_prismatic(model, PDN_GROUND, body, ORIGIN, AXIS, &joint), PDN_OK);
    CHECK_STATUS(pdn_model_add_nonlinear_spring_damper(model, joint, PDN_DISPLACEMENT, stiffness,
                                                       count, &damping, 1, 0, NULL),
                 PDN_OK);
    PDN_INIT(pdn_signal, &push);
    CHECK_STATUS(pdn_signal_set_harmonics(&push, 0, 0, sizes, none, 1), PDN_OK);
    CHECK_STATUS(pdn_model_add_actuator(model, joint, PDN_DISPLACEMENT, &push, &force), PDN_OK);
    CHECK_STATUS(pdn_model_add_parameter(model, "load", size, 0.1, &load), PDN_OK);
    CHECK_STATUS(pdn_model_move_signal(model, load, force, 0, PDN_PART_AMPLITUDE, 1 / size),
                 PDN_OK);
    return load;
}

static int32_t count_of(const pdn_branch *branch)
{
    int32_t count = 0;
    CHECK_STATUS(pdn_branch_count(branch, &count), PDN_OK);
    return count;
}

static pdn_branch_point point_of(const pdn_branch *branch, int32_t number)
{
    pdn_branch_point point;
    PDN_INIT(pdn_branch_point, &point);
    CHECK_STATUS(pdn_branch_get(branch, number, &point), PDN_OK);
    return point;
}

/* Number of the first point with an event. */
static int32_t first(const pdn_branch *branch, int32_t event)
{
    for (int32_t i = 0; i < count_of(branch); ++i) {
        if (point_of(branch, i).event == event) {
            return i;
        }
    }
    CHECK(0);
    return 0;
}

/* x'' + 0.1 x' + x - x^2 = F cos 0.85 t doubles its period. */
static void doubled(void)
{
    const double stiffness[2] = {1, -1};
    const double period = 2 * PI / 0.85;
    const int32_t load = oscillator(stiffness, 2, 0.1, 0.01);
    pdn_periodic_options periodic;
    pdn_branch_options options;
    pdn_branch *branch, *other;
    pdn_solution *solution;
    PDN_INIT(pdn_periodic_options, &periodic);
    PDN_INIT(pdn_branch_options, &options);
    periodic.grid_points = 31;
    options.periodic = &periodic;
    options.from = 0;
    options.to = 0.105;
    options.motion_scale = 0.5;
    options.events = options.stability = 1;
    CHECK_STATUS(pdn_follow_branch(model, period, load, &options, &branch), PDN_OK);
    const int32_t at = first(branch, PDN_EVENT_PERIOD_DOUBLING);
    const pdn_branch_point begins = point_of(branch, at);
    CHECK_NEAR(begins.parameter, 0.100501010278, 2e-12);
    CHECK(point_of(branch, at - 1).stability == PDN_STABLE);
    CHECK(point_of(branch, at - 1).multipliers_outside == 0);
    CHECK(point_of(branch, at + 1).stability == PDN_UNSTABLE);
    CHECK(point_of(branch, at + 1).multipliers_outside == 1);
    CHECK(point_of(branch, at + 1).largest_multiplier > 1);

    /* Multipliers of the solution there, and a line of its report once they were asked for. */
    double real[2], imaginary[2];
    size_t multipliers;
    static char report[4096];
    CHECK_STATUS(pdn_branch_solution(branch, at, &solution), PDN_OK);
    pdn_solution_report(solution, report, sizeof report);
    CHECK(strstr(report, "unit circle") == NULL);
    CHECK_STATUS(pdn_solution_floquet_count(solution, &multipliers), PDN_OK);
    CHECK(multipliers == 2);
    CHECK_STATUS(pdn_solution_floquet(solution, real, imaginary, 2), PDN_OK);
    CHECK_NEAR(real[0], -1, 1e-9);
    CHECK_NEAR(real[1], -0.4774965847545, 1e-9);
    CHECK_NEAR(imaginary[0], 0, 1e-9);
    pdn_solution_report(solution, report, sizeof report);
    CHECK(strstr(report, "of 2 multipliers outside the unit circle") != NULL);
    pdn_solution_free(solution);

    /* The load of the doubled motion goes with the square of the amplitude. */
    double away[2];
    options.events = 0;
    options.point_limit = 4;
    for (int i = 0; i < 2; ++i) {
        CHECK_STATUS(pdn_switch_branch(branch, at, i ? 0.04 : -0.02, &options, &other), PDN_OK);
        CHECK(pdn_branch_end(other) == PDN_BRANCH_POINT_LIMIT);
        CHECK_NEAR(point_of(other, 0).period, 2 * period, 1e-12);
        CHECK(point_of(other, 3).parameter > point_of(other, 0).parameter);
        CHECK(point_of(other, 3).stability == PDN_STABLE);
        away[i] = point_of(other, 0).parameter - begins.parameter;
        pdn_branch_free(other);
    }
    CHECK(away[0] > 0 && fabs(away[1] / away[0] - 4) < 0.1);
    CHECK_STATUS(pdn_switch_branch(branch, 0, 0.02, &options, &other), PDN_ERR_NOT_AVAILABLE);
    CHECK_MESSAGE("no other branch begins at point 0");
    CHECK_STATUS(pdn_switch_branch(branch, at, 0, &options, &other), PDN_ERR_VALUE);
    CHECK_STATUS(pdn_switch_branch(branch, 999, 0.02, &options, &other), PDN_ERR_ID);
    CHECK_STATUS(pdn_switch_branch(branch, at, 0.02, NULL, &other), PDN_ERR_VALUE);
    pdn_branch_free(branch);
    pdn_model_free(model);
}

/* x'' + 0.05 x' + x + 0.1 x^3 = F cos wt: both folds with F = 0.18 are on one locus. */
static void folds(void)
{
    const double stiffness[3] = {1, 0, 0.1};
    const int32_t load = oscillator(stiffness, 3, 0.05, 0.18);
    double frequency;
    pdn_periodic_options periodic;
    pdn_branch_options options;
    pdn_branch *branch, *locus;
    pdn_solution *solution;
    PDN_INIT(pdn_periodic_options, &periodic);
    PDN_INIT(pdn_branch_options, &options);
    periodic.grid_points = 31;
    options.periodic = &periodic;
    CHECK_STATUS(pdn_solve_frequency_response(model, 0.9, 1.4, &options, &branch), PDN_OK);
    const int32_t fold = first(branch, PDN_EVENT_FOLD);
    CHECK_NEAR(point_of(branch, fold).parameter, 1.269601955546, 2e-12);
    options.from = 0.02;
    options.to = 0.18;
    options.downwards = 1;
    CHECK_STATUS(pdn_follow_locus(branch, fold, load, &options, &locus), PDN_OK);
    CHECK(pdn_branch_end(locus) == PDN_BRANCH_RANGE);
    const int32_t last = count_of(locus) - 1;
    CHECK_NEAR(point_of(locus, last).parameter, 0.18, 1e-14);
    CHECK_STATUS(pdn_branch_solution(locus, last, &solution), PDN_OK);
    CHECK_STATUS(pdn_solution_parameter(solution, PDN_FREQUENCY, &frequency), PDN_OK);
    CHECK_NEAR(frequency, 1.115700251771, 2e-12);
    pdn_solution_free(solution);
    pdn_branch_free(locus);
    CHECK_STATUS(pdn_follow_locus(branch, 0, load, &options, &locus), PDN_ERR_NOT_AVAILABLE);
    CHECK_STATUS(pdn_follow_locus(branch, fold, PARAMETER(5), &options, &locus), PDN_ERR_ID);
    CHECK_STATUS(pdn_follow_locus(branch, load, fold, &options, &locus), PDN_ERR_ID);
    CHECK_STATUS(pdn_follow_locus(branch, fold, PDN_FREQUENCY, &options, &locus), PDN_ERR_VALUE);
    pdn_branch_free(branch);
    pdn_model_free(model);
}

/* A point mass on a rod of length 1 that a torque turns over: it stands still where 9.81 sin(angle)
 * is the torque, and comes back after a turn. */
static void loop(void)
{
    const double bob[3] = {0, 0, -1}, point[9] = {0}, about[3] = {0, 1, 0};
    const double gravity[3] = {0, 0, -9.81};
    int32_t torque;
    pdn_signal push;
    pdn_periodic_options periodic;
    pdn_branch_options options;
    pdn_branch *branch, *loaded, *more;
    CHECK_STATUS(pdn_model_new(&model), PDN_OK);
    CHECK_STATUS(pdn_model_add_rigid_body(model, 1, bob, point, &body), PDN_OK);
    CHECK_STATUS(pdn_model_add_revolute(model, PDN_GROUND, body, ORIGIN, about, &joint), PDN_OK);
    CHECK_STATUS(pdn_model_set_gravity(model, gravity), PDN_OK);
    PDN_INIT(pdn_signal, &push);
    CHECK_STATUS(pdn_signal_set_harmonics(&push, 0, 0, NULL, NULL, 0), PDN_OK);
    CHECK_STATUS(pdn_model_add_actuator(model, joint, PDN_ROTATION, &push, &force), PDN_OK);
    CHECK_STATUS(pdn_model_add_parameter(model, "torque", 0, 1, &torque), PDN_OK);
    CHECK_STATUS(pdn_model_move_signal(model, torque, force, 0, PDN_PART_MEAN, 1), PDN_OK);
    PDN_INIT(pdn_periodic_options, &periodic);
    PDN_INIT(pdn_branch_options, &options);
    periodic.grid_points = 3;
    options.periodic = &periodic;
    options.from = -12;
    options.to = 12;
    CHECK_STATUS(pdn_follow_branch(model, 0.7, torque, &options, &branch), PDN_OK);
    CHECK(pdn_branch_end(branch) == PDN_BRANCH_CLOSED);
    const int32_t count = count_of(branch);
    CHECK_NEAR(point_of(branch, count - 1).parameter, 0, 1e-6);
    CHECK_NEAR(point_of(branch, first(branch, PDN_EVENT_FOLD)).parameter, 9.81, 1e-11);
    CHECK_STATUS(pdn_continue_branch(branch, &options, &more), PDN_ERR_NOT_AVAILABLE);
    CHECK_MESSAGE("come back to its first point");
    pdn_branch_free(branch);

    /* A part of it, saved, loaded and followed on. */
    options.point_limit = 7;
    CHECK_STATUS(pdn_follow_branch(model, 0.7, torque, &options, &branch), PDN_OK);
    CHECK(pdn_branch_end(branch) == PDN_BRANCH_POINT_LIMIT);
    CHECK_STATUS(pdn_branch_save(branch, "test_branches.pdb"), PDN_OK);
    CHECK_STATUS(pdn_branch_load("test_branches.pdb", &loaded), PDN_OK);
    CHECK(pdn_branch_end(loaded) == PDN_BRANCH_POINT_LIMIT && count_of(loaded) == 7);
    options.point_limit = 1000;
    CHECK_STATUS(pdn_continue_branch(loaded, &options, &more), PDN_OK);
    CHECK(pdn_branch_end(more) == PDN_BRANCH_CLOSED);
    for (int32_t i = 0; i < 7; ++i) {
        CHECK(point_of(more, i).parameter == point_of(branch, i).parameter);
    }
    CHECK_NEAR(point_of(more, count_of(more) - 1).parameter, 0, 1e-6);
    pdn_branch_free(more);
    pdn_branch_free(loaded);
    options.to = 0.001;
    CHECK_STATUS(pdn_continue_branch(branch, &options, &more), PDN_ERR_VALUE);
    CHECK_STATUS(pdn_branch_save(branch, "no/such/place.pdb"), PDN_ERR_IO);
    CHECK_STATUS(pdn_branch_write_csv(branch, NULL, 0, "test_branches.csv"), PDN_OK);
    CHECK_STATUS(pdn_branch_load("test_branches.csv", &loaded), PDN_ERR_FORMAT);
    CHECK_MESSAGE("is not a saved branch");
    pdn_branch_free(branch);
    pdn_model_free(model);
}

int main(void)
{
    doubled();
    folds();
    loop();
    return 0;
}
