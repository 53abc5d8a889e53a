#include "rotor_model.h"

int main(void)
{
    /* Which pitch gives a mean thrust of 8 kN? The shaft holds the hub against it. */
    rotor r;
    build_rotor(&r, 5, 0.02);
    int32_t pitch;
    TRY(pdn_model_add_parameter(r.model, "collective pitch", 0.02, 0.1, &pitch));
    for (int b = 0; b < BLADES; ++b) {
        TRY(pdn_model_move_signal(r.model, pitch, r.pitches[b], 0, PDN_PART_MEAN, 1));
    }
    const pdn_quantity held = *PDN_QUANTITY(PDN_JOINT_REACTION, r.shaft, 0);
    pdn_conditions *conditions = NULL;
    TRY(pdn_conditions_new(&conditions));
    TRY(pdn_conditions_release(conditions, pitch));
    TRY(pdn_conditions_add_quantity(conditions, &held, PDN_FEATURE_MEAN, 0, -8e3, 0));

    pdn_solution *solution = NULL;
    TRY(pdn_solve_conditioned(r.model, r.period, conditions, NULL, &solution));
    const int32_t outcome = pdn_solution_outcome(solution);
    printf("converged: %s\n", outcome == PDN_CONVERGED ? "yes" : "no");
    double found, mean, rate, cosine, sine;
    TRY(pdn_solution_parameter(solution, pitch, &found));
    printf("pitch: %.3f degrees\n", found * 180 / PI);
    TRY(pdn_solution_harmonics(solution, &held, 1, &mean, &rate, &cosine, &sine));
    printf("thrust: %.3f kN\n", -1e-3 * mean);
    pdn_solution_free(solution);
    pdn_conditions_free(conditions);
    pdn_model_free(r.model);
    return 0;
}
