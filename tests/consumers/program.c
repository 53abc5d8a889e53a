/* The program that every consumer builds: the response of a torsional oscillator to cos wt, which
 * must be that of the closed form within the error that a solve allows by default. */
#include <periodyn.h>
#include <stdio.h>

#define TRY(call)                                                                                  \
    do {                                                                                           \
        if ((call) != PDN_OK) {                                                                    \
            char message[512];                                                                     \
            pdn_last_error(message, sizeof message);                                               \
            fprintf(stderr, "%s\n  failed: %s\n", #call, message);                                 \
            goto done;                                                                             \
        }                                                                                          \
    } while (0)

int main(void)
{
    const double origin[3] = {0, 0, 0}, axis[3] = {0, 0, 1}, start = 0;
    const double inertia[9] = {0.4, 0, 0, 0, 0.4, 0, 0, 0, 0.5}, cosine = 0.6, sine = 0;
    const double stiffness = 3, damping = 0.2, omega = 1.5, period = 4.1887902047863909846;
    const double real = stiffness - inertia[8] * omega * omega, imaginary = damping * omega;
    const double expected = cosine * real / (real * real + imaginary * imaginary);
    double angle, error;
    int32_t body, hinge;
    int failed = 1;
    pdn_signal moment;
    pdn_model *model = NULL;
    pdn_solution *solution = NULL;

    printf("%s\n", pdn_build_info());
    TRY(pdn_version_check(PDN_VERSION_MAJOR, PDN_VERSION_MINOR));
    TRY(pdn_model_new(&model));
    TRY(pdn_model_add_rigid_body(model, 2, origin, inertia, &body));
    TRY(pdn_model_add_revolute(model, PDN_GROUND, body, origin, axis, &hinge));
    TRY(pdn_model_add_spring_damper(model, hinge, PDN_ROTATION, stiffness, damping, 0, NULL));
    PDN_INIT(pdn_signal, &moment);
    TRY(pdn_signal_set_harmonics(&moment, 0, 0, &cosine, &sine, 1));
    TRY(pdn_model_add_load(model, body, PDN_FRAME_SPACE, PDN_MOMENT_3, &moment, NULL));
    TRY(pdn_solve_periodic(model, period, NULL, &solution));
    TRY(pdn_solution_sample(solution, PDN_QUANTITY(PDN_JOINT_COORDINATE, hinge, PDN_ROTATION),
                            &start, 1, &angle));

    error = angle - expected;
    printf("angle at the start %.12f, expected %.12f\n", angle, expected);
    failed = pdn_solution_outcome(solution) != PDN_CONVERGED || error > 1e-6 || error < -1e-6;
done:
    pdn_solution_free(solution);
    pdn_model_free(model);
    return failed;
}
