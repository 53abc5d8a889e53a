/* test_exponents: multipliers of a rotor by SLEPc on all ranks are those of pdn_solve_stability,
 * which integrates disturbances over the period; and what is refused. */

#include "mechanisms.h"
#include "periodyn_petsc.h"

#include <complex.h>
#include <petscsys.h>

enum { WANTED = 12, MOST = 400 };

/* A rotor whose blades differ, as equal ones have multipliers that are equal. */
static struct test_model unequal_rotor(size_t points)
{
    struct test_model out = rotor(3, points);
    const double inertia[9] = {0.2, 0, 0, 0, 0.3, 0, 0, 0, 0.4};
    int32_t body, joint;
    /* The last nodes of blades 2 and 3. */
    const int32_t tips[2] = {PDN_FIRST_NODE + 20, out.node};
    for (int i = 0; i < 2; ++i) {
        pdn_frame frame;
        GOOD(pdn_model_node_frame(out.model, tips[i], &frame));
        GOOD(pdn_model_add_rigid_body(out.model, 5 + 7 * i, frame.position, inertia, &body));
        GOOD(pdn_model_add_rigid_joint(out.model, tips[i], body, frame.position, &joint));
    }
    return out;
}

/* From the nearest of these numbers or their conjugates. */
static double distance(double complex x, const double complex *all, size_t count)
{
    double nearest = INFINITY;
    for (size_t i = 0; i < count; ++i) {
        nearest = fmin(nearest, fmin(cabs(x - all[i]), cabs(x - conj(all[i]))));
    }
    return nearest;
}

int main(int argc, char **argv)
{
    PetscInitialize(&argc, &argv, NULL, NULL);
    struct test_model model = unequal_rotor(31);
    pdn_periodic_options serial;
    pdn_petsc_options options;
    pdn_solution *solution;
    pdn_stability *stability;
    double real[WANTED], imaginary[WANTED], errors[WANTED];
    double complex expected[MOST], exponents[WANTED];
    size_t found = 0, count, states;
    PDN_INIT(pdn_periodic_options, &serial);
    serial.grid_points = model.points;
    GOOD(pdn_solve_periodic(model.model, model.period, &serial, &solution));
    CHECK(pdn_solution_outcome(solution) == PDN_CONVERGED);
    PDN_INIT(pdn_petsc_options, &options);
    options.grid_points = model.points;
    CHECK(pdn_petsc_exponents(PETSC_COMM_WORLD, model.model, model.period, &options, WANTED, real,
                              imaginary, errors, &found) == PDN_ERR_VALUE);
    options.initial = solution;
    CHECK(pdn_petsc_exponents(PETSC_COMM_WORLD, model.model, model.period, &options, 0, real,
                              imaginary, errors, &found) == PDN_ERR_SIZE);
    CHECK(pdn_petsc_exponents(PETSC_COMM_WORLD, model.model, model.period, &options, WANTED, NULL,
                              imaginary, errors, &found) == PDN_ERR_NULL);
    CHECK(found == 0);
    GOOD(pdn_petsc_exponents(PETSC_COMM_WORLD, model.model, model.period, &options, WANTED, real,
                             imaginary, errors, &found));
    CHECK(found == WANTED);

    GOOD(pdn_solve_stability(solution, NULL, &stability));
    GOOD(pdn_stability_count(stability, &count, &states));
    CHECK(count >= WANTED && count <= MOST);
    for (size_t i = 0; i < count; ++i) {
        pdn_multiplier multiplier;
        PDN_INIT(pdn_multiplier, &multiplier);
        GOOD(pdn_stability_get(stability, (int32_t)i, &multiplier));
        expected[i] = multiplier.real + I * multiplier.imaginary;
    }
    double largest = 0, radius = 0;
    for (size_t i = 0; i < found; ++i) {
        const double complex mu = real[i] + I * imaginary[i], rho = cexp(mu * model.period);
        const double error = distance(rho, expected, count);
        printf("mu = %.10f %+.10fi, error %.1e: rho %.10f %+.10fi, %.1e from the nearest\n", real[i],
               imaginary[i], errors[i], creal(rho), cimag(rho), error);
        largest = fmax(largest, error);
        radius = fmax(radius, cabs(mu));
        exponents[i] = rho;
    }
    /* The period map's tolerance, and what harmonics that 31 points do not resolve leave. */
    CHECK(largest < 1e-6);
    /* None within their distance from zero was missed. */
    size_t within = 0;
    for (size_t j = 0; j < count; ++j) {
        if (cabs(clog(expected[j])) / model.period < 0.99 * radius) {
            CHECK(distance(expected[j], exponents, found) < 1e-6);
            within++;
        }
    }
    printf("%zu multipliers within that distance\n", within);
    CHECK(within >= WANTED / 2 - 1);
    pdn_stability_free(stability);
    pdn_solution_free(solution);
    pdn_model_free(model.model);
    return PetscFinalize();
}
