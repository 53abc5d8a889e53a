/* Interpolation of a periodic rotation, Han and Bauchau, Nonlinear Dynamics 92 (2018), section 4.4.
 *
 * Precession W t, nutation (pi/13) sin 2 W t and spin (pi/17) (1 - cos 3 W t), with W = 9 rad/s, is
 * given at N times of a period and compared with itself at 60 N times.
 *
 *   motion_interpolation [--grid N] [--out FILE]
 *
 * FILE gets `N,e_R,e_omega` for N = 3, 7, 15, 31, 63, up to the N given: mean error of the rotation
 * matrix (Frobenius norm over 3), and mean relative error of the angular velocity. */

#include <math.h>

#include "example.h"

static const double PI = 3.14159265358979323846;
static const double OMEGA = 9.0;

/* Rotation matrix (column by column) by the Euler angles 3-1-3, and angular velocity in its axes.
 */
static void exact_motion(double t, double r[9], double w[3])
{
    const double phi = OMEGA * t, theta = PI / 13 * sin(2 * phi),
                 psi = PI / 17 * (1 - cos(3 * phi));
    const double phi_rate = OMEGA, theta_rate = 2 * OMEGA * PI / 13 * cos(2 * phi);
    const double psi_rate = 3 * OMEGA * PI / 17 * sin(3 * phi);
    const double cf = cos(phi), sf = sin(phi), ct = cos(theta), st = sin(theta);
    const double cp = cos(psi), sp = sin(psi);
    r[0] = cf * cp - sf * ct * sp, r[3] = -cf * sp - sf * ct * cp, r[6] = sf * st;
    r[1] = sf * cp + cf * ct * sp, r[4] = -sf * sp + cf * ct * cp, r[7] = -cf * st;
    r[2] = st * sp, r[5] = st * cp, r[8] = ct;
    w[0] = phi_rate * st * sp + theta_rate * cp;
    w[1] = phi_rate * st * cp - theta_rate * sp;
    w[2] = phi_rate * ct + psi_rate;
}

/* Both errors for n grid points; 0 on success. */
static int errors(size_t n, double *e_rotation, double *e_omega)
{
    const double period = 2 * PI / OMEGA;
    const size_t count = 60 * n;
    int failed = 1;
    double *positions = calloc(3 * n, sizeof(double)), *rotations = calloc(9 * n, sizeof(double));
    double *times = calloc(count, sizeof(double));
    double *rotation = calloc(9 * count, sizeof(double));
    double *velocity = calloc(6 * count, sizeof(double)); /* linear, then angular */
    double ignored[3];
    if (!positions || !rotations || !times || !rotation || !velocity) {
        goto done;
    }
    for (size_t k = 0; k < n; ++k) {
        exact_motion(period * (double)k / (double)n, rotations + 9 * k, ignored);
    }
    for (size_t k = 0; k < count; ++k) {
        times[k] = period * (double)(k + 1) / (double)count;
    }
    TRY(pdn_motion_interpolate(period, positions, rotations, n, times, count, NULL, rotation,
                               velocity, NULL));
    *e_rotation = *e_omega = 0;
    for (size_t k = 0; k < count; ++k) {
        double r[9], w[3], difference = 0, slip = 0, speed = 0;
        exact_motion(times[k], r, w);
        /* |R^T R_e - I| = |R_e - R| */
        for (int i = 0; i < 9; ++i) {
            difference += pow(rotation[9 * k + i] - r[i], 2);
        }
        for (int i = 0; i < 3; ++i) {
            slip += pow(velocity[6 * k + 3 + i] - w[i], 2);
            speed += w[i] * w[i];
        }
        *e_rotation += sqrt(difference) / (3 * (double)count);
        *e_omega += sqrt(slip / speed) / (double)count;
    }
    failed = 0;
done:
    free(positions);
    free(rotations);
    free(times);
    free(rotation);
    free(velocity);
    return failed;
}

int main(int argc, char **argv)
{
    check_options(argc, argv, "--grid --out");
    const size_t finest = option_count(argc, argv, "--grid", 63);
    FILE *file = open_out(argc, argv);
    int failed = 0;

    printf("  N        e_R    e_omega\n");
    if (file) {
        fputs("N,e_R,e_omega\n", file);
    }
    for (size_t n = 3; n <= finest && !failed; n = 2 * n + 1) {
        double e_rotation, e_omega;
        failed = errors(n, &e_rotation, &e_omega);
        if (!failed) {
            printf("%3zu %10.2e %10.2e\n", n, e_rotation, e_omega);
        }
        if (!failed && file) {
            fprintf(file, "%zu,%.17g,%.17g\n", n, e_rotation, e_omega);
        }
    }
    if (file && fclose(file) != 0) {
        perror("--out");
        failed = 1;
    }
    return failed;
}
