#include "try.h"

int main(void)
{
    /* Metres, kilograms, seconds. Below its hinge hangs a bar of 1 m and 2 kg. */
    const double pi = 3.14159265358979323846, origin[3] = {0, 0, 0}, axis[3] = {0, 1, 0};
    const double gravity[3] = {0, 0, -9.81}, centre[3] = {0, 0, -0.5};
    const double inertia[9] = {1.0 / 6, 0, 0, 0, 1.0 / 6, 0, 0, 0, 0.001};
    pdn_model *model = NULL;
    int32_t bar, hinge;
    TRY(pdn_model_new(&model));
    TRY(pdn_model_set_gravity(model, gravity));
    TRY(pdn_model_add_rigid_body(model, 2.0, centre, inertia, &bar));
    TRY(pdn_model_add_revolute(model, PDN_GROUND, bar, origin, axis, &hinge));
    TRY(pdn_model_add_spring_damper(model, hinge, PDN_ROTATION, 0, 0.5, 0, NULL));

    /* A motor at the hinge pushes it to and fro, by 1.5 N m at 3 rad/s. */
    const double cosine = 1.5, sine = 0;
    pdn_signal push;
    PDN_INIT(pdn_signal, &push);
    TRY(pdn_signal_set_harmonics(&push, 0, 0, &cosine, &sine, 1));
    TRY(pdn_model_add_actuator(model, hinge, PDN_ROTATION, &push, NULL));

    pdn_solution *solution = NULL;
    TRY(pdn_solve_periodic(model, 2 * pi / 3, NULL, &solution));
    const int32_t outcome = pdn_solution_outcome(solution);
    printf("converged: %s\n", outcome == PDN_CONVERGED ? "yes" : "no");
    double least, most, times[2];
    TRY(pdn_solution_extremes(solution, PDN_QUANTITY(PDN_JOINT_COORDINATE, hinge, PDN_ROTATION),
                              &least, &times[0], &most, &times[1]));
    printf("it swings to %.3f degrees, at %.3f s\n", most * 180 / pi, times[1]);
    pdn_solution_free(solution);
    pdn_model_free(model);
    return 0;
}
