#include "try.h"

int main(void)
{
    /* A motor turns the crank at 150 rad/s, a rod of steel pushes the piston against a damper. */
    const double pi = 3.14159265358979323846, speed = 150;
    const double young = 210e9, shear = 81e9, density = 7850, width = 0.012;
    const double area = width * width, bending = area * area / 12;
    const double stiffness[6] = {young * area,           shear * area * 5 / 6,
                                 shear * area * 5 / 6,   shear * 0.141 * area * area,
                                 young * bending,        young * bending};
    const double mass[4] = {density * area, 2 * density * bending, density * bending,
                            density * bending};
    pdn_section steel;
    PDN_INIT(pdn_section, &steel);
    TRY(pdn_section_set_diagonal(&steel, stiffness, mass));
    TRY(pdn_section_set_proportional_damping(&steel, 1e-5));

    const double x[3] = {1, 0, 0}, y[3] = {0, 1, 0}, z[3] = {0, 0, 1};
    const double centre[3] = {0, 0, 0}, pin[3] = {0.1, 0, 0}, far[3] = {0.5, 0, 0};
    const double of_crank[9] = {2e-3, 0, 0, 0, 2e-3, 0, 0, 0, 3e-3};
    const double of_piston[9] = {4e-4, 0, 0, 0, 4e-4, 0, 0, 0, 4e-4};
    pdn_model *model = NULL;
    pdn_beam rod;
    int32_t crank, piston, motor, slide;
    TRY(pdn_model_new(&model));
    TRY(pdn_model_add_rigid_body(model, 1.0, centre, of_crank, &crank));
    TRY(pdn_model_add_straight_beam(model, pin, far, y, &steel, 4, 3, &rod));
    TRY(pdn_model_add_rigid_body(model, 0.6, far, of_piston, &piston));
    TRY(pdn_model_add_revolute(model, PDN_GROUND, crank, centre, z, &motor));
    TRY(pdn_model_add_revolute(model, crank, rod.first, pin, z, NULL));
    TRY(pdn_model_add_revolute(model, rod.last, piston, far, z, NULL));
    TRY(pdn_model_add_prismatic(model, PDN_GROUND, piston, far, x, &slide));
    TRY(pdn_model_add_spring_damper(model, slide, PDN_DISPLACEMENT, 0, 20, 0, NULL));
    pdn_signal turn;
    PDN_INIT(pdn_signal, &turn);
    TRY(pdn_signal_set_harmonics(&turn, 0, speed, NULL, NULL, 0));
    TRY(pdn_model_prescribe(model, motor, PDN_ROTATION, &turn, NULL));

    pdn_solution *solution = NULL;
    TRY(pdn_solve_periodic(model, 2 * pi / speed, NULL, &solution));
    const int32_t outcome = pdn_solution_outcome(solution);
    printf("converged: %s\n", outcome == PDN_CONVERGED ? "yes" : "no");
    double least, most, times[2];
    TRY(pdn_solution_extremes(solution, PDN_QUANTITY(PDN_JOINT_DRIVING_EFFORT, motor, PDN_ROTATION),
                              &least, &times[0], &most, &times[1]));
    printf("torque of the motor: %.2f to %.2f N m\n", least, most);
    /* Station -1 is the beginning of the element. */
    TRY(pdn_solution_extremes(
        solution, PDN_QUANTITY(PDN_BEAM_FORCE, rod.first_element + 2, 5, .station = -1), &least,
        &times[0], &most, &times[1]));
    printf("moment in the middle of the rod: %.2f to %.2f N m\n", least, most);
    pdn_solution_free(solution);
    pdn_model_free(model);
    return 0;
}
