#include "rotor_model.h"

int main(void)
{
    const double speeds[] = {3, 4, 5, 6, 7};
    pdn_solution *last = NULL;
    for (int i = 0; i < 5; ++i) {
        rotor r;
        build_rotor(&r, speeds[i], 0.02);
        pdn_periodic_options options;
        PDN_INIT(pdn_periodic_options, &options);
        options.initial = last;
        pdn_solution *solution = NULL;
        TRY(pdn_solve_periodic(r.model, r.period, &options, &solution));
        double least, most, times[2];
        TRY(pdn_solution_extremes(
            solution, PDN_QUANTITY(PDN_BEAM_FORCE, r.blades[0].first_element, 5, .station = -1),
            &least, &times[0], &most, &times[1]));
        const int32_t outcome = pdn_solution_outcome(solution);
        printf("%.0f rad/s: edgewise moment at the root %.3f to %.3f kN m, %s\n", speeds[i],
               1e-3 * least, 1e-3 * most,
               outcome == PDN_CONVERGED ? "converged" : "not converged");
        pdn_solution_free(last);
        pdn_model_free(r.model);
        last = solution;
    }
    pdn_solution_free(last);
    return 0;
}
