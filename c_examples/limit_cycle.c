/* A brake that squeals: a limit cycle, whose period nothing prescribes.
 *
 * A pad on a spring rubs on a disc that passes below at a steady speed. Friction falls with the
 * speed of sliding, and rises again: it feeds slow motions of the pad and damps fast ones. The
 * amplitude and the frequency of the cycle are followed as a damper is made stronger, until the pad
 * all but comes to rest. Metres, newtons, kilograms, seconds.
 *
 *   limit_cycle [--speed V] [--out FILE]
 *
 * FILE gets a line for each point of the branch; `script/plot.py FILE IMAGE` draws it. */

#include "example.h"

static const double PI = 3.14159265358979323846;

enum { POINTS = 31 };

/* Friction of the pad on the disc. */
typedef struct friction {
    double normal;     /* force */
    double fall, rise; /* of the coefficient: mu(v) = 0.4 - fall v + rise v^3 */
    double speed;      /* of the disc */
} friction;

/* Effort against the pad's motion: minus the force by which the disc drags it along. */
static int32_t rub(double time, double x, double rate, double *effort, double *derivatives,
                   void *user_data)
{
    const friction *const f = user_data;
    const double v = f->speed - rate;
    (void)time;
    (void)x;
    *effort = -f->normal * (0.4 - f->fall * v + f->rise * v * v * v);
    if (derivatives) {
        derivatives[0] = 0;
        derivatives[1] = f->normal * (-f->fall + 3 * f->rise * v * v);
    }
    return 0;
}

int main(int argc, char **argv)
{
    check_options(argc, argv, "--speed --out");
    friction law = {1000, 0.25, 0.05, option_number(argc, argv, "--speed", 1.2)};
    const char *out = option_text(argc, argv, "--out", NULL);

    int failed = 1;
    pdn_model *model = NULL;
    pdn_conditions *conditions = NULL;
    pdn_branch *branch = NULL;
    static double positions[POINTS][3], rotations[POINTS][9];
    const double mass = 0.5, stiffness = 5e4, damping = 5;
    const double origin[3] = {0, 0, 0}, along[3] = {1, 0, 0};
    const double inertia[9] = {1e-4, 0, 0, 0, 1e-4, 0, 0, 0, 1e-4};
    const double natural = sqrt(stiffness / mass);
    int32_t pad, slide, spring, contact, parameter, count;
    TRY(pdn_model_new(&model));
    TRY(pdn_model_add_rigid_body(model, mass, origin, inertia, &pad));
    TRY(pdn_model_add_prismatic(model, PDN_GROUND, pad, origin, along, &slide));
    TRY(pdn_model_add_spring_damper(model, slide, PDN_DISPLACEMENT, stiffness, damping, 0,
                                    &spring));
    TRY(pdn_model_add_coordinate_law(model, slide, PDN_DISPLACEMENT, PDN_TANGENTS_GIVEN, rub, &law,
                                     NULL, &contact));
    /* It does not depend on time: so it is one for any period. */
    TRY(pdn_model_declare_of_phase(model, contact));
    TRY(pdn_model_add_parameter(model, "damping", damping, 100, &parameter));
    TRY(pdn_model_move_number(model, parameter, PDN_NUMBER_DAMPING, spring, 1, 1));

    /* The period is free, and the phase takes its place. Newton's method starts at a guess. */
    TRY(pdn_conditions_new(&conditions));
    TRY(pdn_conditions_release(conditions, PDN_FREQUENCY));
    TRY(pdn_conditions_add_phase(conditions));
    const double still = law.normal * (0.4 - law.fall * law.speed + law.rise * pow(law.speed, 3));
    const double guess = 0.9 / natural;
    for (int k = 0; k < POINTS; ++k) {
        positions[k][0] = still / stiffness + guess * cos(2 * PI * k / POINTS);
        rotations[k][0] = rotations[k][4] = rotations[k][8] = 1;
    }
    pdn_periodic_options periodic;
    pdn_branch_options options;
    PDN_INIT(pdn_periodic_options, &periodic);
    PDN_INIT(pdn_branch_options, &options);
    periodic.grid_points = POINTS;
    periodic.guess_positions = positions[0];
    periodic.guess_rotations = rotations[0];
    options.periodic = &periodic;
    options.conditions = conditions;
    options.from = 0;
    options.to = 33;
    options.motion_scale = 0.05;
    TRY(pdn_follow_branch(model, 2 * PI / natural, parameter, &options, &branch));
    char report[2048];
    pdn_branch_report(branch, report, sizeof report);
    printf("%s", report);

    printf("Damping [N s/m]  frequency over natural  amplitude [mm]\n");
    TRY(pdn_branch_count(branch, &count));
    for (int32_t i = 0; i < count; ++i) {
        pdn_branch_point point;
        double cosine[1], sine[1];
        pdn_solution *solution;
        PDN_INIT(pdn_branch_point, &point);
        TRY(pdn_branch_get(branch, i, &point));
        TRY(pdn_branch_solution(branch, i, &solution));
        const pdn_status status = pdn_solution_harmonics(
            solution, PDN_QUANTITY(PDN_JOINT_COORDINATE, slide, PDN_DISPLACEMENT), 1, NULL, NULL,
            cosine, sine);
        pdn_solution_free(solution);
        TRY(status);
        if (i % 5 == 0 || i == count - 1) {
            printf("%15.3f %23.8f %15.6f\n", point.parameter, 2 * PI / point.period / natural,
                   1e3 * hypot(cosine[0], sine[0]));
        }
    }
    if (out) {
        TRY(pdn_branch_write_csv(branch, PDN_QUANTITY(PDN_NODE_POSITION, pad, 0), 1, out));
    }
    failed = pdn_branch_end(branch) == PDN_BRANCH_NO_START;
done:
    pdn_branch_free(branch);
    pdn_conditions_free(conditions);
    pdn_model_free(model);
    return failed;
}
