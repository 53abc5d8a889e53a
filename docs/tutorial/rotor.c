#include "rotor_model.h"

int main(void)
{
    const double speed = 5;
    rotor r;
    build_rotor(&r, speed, 0.02);
    pdn_solution *solution = NULL;
    TRY(pdn_solve_periodic(r.model, r.period, NULL, &solution));
    const int32_t outcome = pdn_solution_outcome(solution);
    printf("converged: %s\n", outcome == PDN_CONVERGED ? "yes" : "no");

    double mean, rate, cosines[2], sines[2];
    TRY(pdn_solution_harmonics(solution,
                               PDN_QUANTITY(PDN_JOINT_DRIVING_EFFORT, r.shaft, PDN_ROTATION), 1,
                               &mean, &rate, cosines, sines));
    printf("power: %.3f kW\n", -1e-3 * speed * mean);
    TRY(pdn_solution_harmonics(
        solution, PDN_QUANTITY(PDN_BEAM_FORCE, r.blades[0].first_element, 4, .station = -1), 2,
        &mean, &rate, cosines, sines));
    printf("flapwise moment at the root: mean %.3f kN m\n", 1e-3 * mean);
    for (int j = 0; j < 2; ++j) {
        printf("  %d a turn: %.3f cos, %.3f sin\n", j + 1, 1e-3 * cosines[j], 1e-3 * sines[j]);
    }
    pdn_solution_free(solution);
    pdn_model_free(r.model);
    return 0;
}
