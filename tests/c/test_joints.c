/* Every joint against its closed form: one body on one joint to the ground, whose coordinates are
 * prescribed. What is read: coordinates, rates, accelerations, driving efforts and reactions. */
#include "near.h"

#define PERIOD 1.6
#define OMEGA (2 * PI / PERIOD)

enum { TIMES = 9, MOST_COORDINATES = 6 };

/* Grid points: as many as resolve the motion. */
enum { FEW = 7, POINTS = 29, MANY = 61 };

/* The joint's point, where the body has its centre; its axis, and two directions across. */
static const double POINT[3] = {0.3, -0.2, 0.5};
static const double AXES[9] = {2. / 3,  -2. / 3, 1. / 3, 2. / 3, 1. / 3,
                               -2. / 3, 1. / 3,  2. / 3, 2. / 3};
static const double *const ACROSS_1 = AXES, *const ACROSS_2 = AXES + 3, *const AXIS = AXES + 6;
static const double MASS = 2.5, INERTIA = 0.4, GRAVITY[3] = {1, -3, -9};
static const double PITCH = -0.3;

/* Times before, inside and after the period. */
static const double times[TIMES] = {-2.3 * PERIOD,  -0.31 * PERIOD, 0.0,
                                    0.123 * PERIOD, 0.31 * PERIOD,  0.5 * PERIOD,
                                    0.9 * PERIOD,   1.77 * PERIOD,  12.4 * PERIOD};

/* mean + rate t + cosine cos wt + sine sin wt, and its first two derivatives. */
struct wave {
    double mean, rate, cosine, sine;
};

static double value(struct wave w, double t)
{
    return w.mean + w.rate * t + w.cosine * cos(OMEGA * t) + w.sine * sin(OMEGA * t);
}

static double rate(struct wave w, double t)
{
    return w.rate + OMEGA * (w.sine * cos(OMEGA * t) - w.cosine * sin(OMEGA * t));
}

static double acceleration(struct wave w, double t)
{
    return -OMEGA * OMEGA * (w.cosine * cos(OMEGA * t) + w.sine * sin(OMEGA * t));
}

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* The body on its joint. */
static struct {
    pdn_model *model;
    pdn_solution *solution;
    int32_t body, joint;
} rig;

static const double SPIN[9] = {0.4, 0, 0, 0, 0.4, 0, 0, 0, 0.4};

static void begin(void)
{
    rig.joint = rig.body = -1;
    CHECK_STATUS(pdn_model_new(&rig.model), PDN_OK);
    CHECK_STATUS(pdn_model_set_gravity(rig.model, GRAVITY), PDN_OK);
    CHECK_STATUS(pdn_model_add_rigid_body(rig.model, MASS, POINT, SPIN, &rig.body), PDN_OK);
}

static void prescribe(int32_t coordinate, struct wave w)
{
    pdn_signal signal;
    PDN_INIT(pdn_signal, &signal);
    CHECK_STATUS(pdn_signal_set_harmonics(&signal, w.mean, w.rate, &w.cosine, &w.sine, 1), PDN_OK);
    CHECK_STATUS(pdn_model_prescribe(rig.model, rig.joint, coordinate, &signal, NULL), PDN_OK);
}

static void solve_on(size_t points)
{
    pdn_periodic_options options;
    PDN_INIT(pdn_periodic_options, &options);
    options.grid_points = points;
    options.tolerance = 1e-11;
    CHECK_STATUS(pdn_solve_periodic(rig.model, PERIOD, &options, &rig.solution), PDN_OK);
    CHECK(reports(rig.solution, "converged"));
    CHECK(pdn_solution_outcome(rig.solution) == PDN_CONVERGED);
}

static void solve(void)
{
    solve_on(POINTS);
}

static void end(void)
{
    pdn_solution_free(rig.solution);
    pdn_model_free(rig.model);
    rig.solution = NULL;
    rig.model = NULL;
}

/* The coordinate moves as the wave says: value, rate, acceleration, and its harmonics. */
static void check_wave(int32_t coordinate, struct wave w)
{
    const pdn_solution *const s = rig.solution;
    double q[TIMES], v[TIMES], a[TIMES], mean, slope, cosines[2], sines[2];
    int i;
    CHECK_STATUS(pdn_solution_sample(s, PDN_QUANTITY(PDN_JOINT_COORDINATE, rig.joint, coordinate),
                                     times, TIMES, q),
                 PDN_OK);
    CHECK_STATUS(pdn_solution_sample(s, PDN_QUANTITY(PDN_JOINT_RATE, rig.joint, coordinate), times,
                                     TIMES, v),
                 PDN_OK);
    CHECK_STATUS(pdn_solution_sample(s, PDN_QUANTITY(PDN_JOINT_ACCELERATION, rig.joint, coordinate),
                                     times, TIMES, a),
                 PDN_OK);
    for (i = 0; i < TIMES; i++) {
        CHECK_NEAR(q[i], value(w, times[i]), 1e-10);
        CHECK_NEAR(v[i], rate(w, times[i]), 1e-9);
        CHECK_NEAR(a[i], acceleration(w, times[i]), 1e-8);
    }
    CHECK_STATUS(pdn_solution_harmonics(s,
                                        PDN_QUANTITY(PDN_JOINT_COORDINATE, rig.joint, coordinate),
                                        2, &mean, &slope, cosines, sines),
                 PDN_OK);
    CHECK_NEAR(mean, w.mean, 1e-10);
    CHECK_NEAR(slope, w.rate, 1e-10);
    CHECK_NEAR(cosines[0], w.cosine, 1e-10);
    CHECK_NEAR(sines[0], w.sine, 1e-10);
    CHECK_NEAR(cosines[1], 0, 1e-10);
    CHECK_NEAR(sines[1], 0, 1e-10);
}

static void driving_effort(int32_t coordinate, double *effort)
{
    CHECK_STATUS(pdn_solution_sample(rig.solution,
                                     PDN_QUANTITY(PDN_JOINT_DRIVING_EFFORT, rig.joint, coordinate),
                                     times, TIMES, effort),
                 PDN_OK);
}

static void reaction(double *wrench)
{
    CHECK_STATUS(pdn_solution_sample(
                     rig.solution, PDN_QUANTITY(PDN_JOINT_REACTION, rig.joint, PDN_ALL_COMPONENTS),
                     times, TIMES, wrench),
                 PDN_OK);
}

static void position(double *at)
{
    CHECK_STATUS(pdn_solution_sample(rig.solution,
                                     PDN_QUANTITY(PDN_NODE_POSITION, rig.body, PDN_ALL_COMPONENTS),
                                     times, TIMES, at),
                 PDN_OK);
}

/* Coordinates that the joint does not have cannot be read. */
static void check_absent(int32_t coordinate)
{
    double q[TIMES];
    CHECK_STATUS(pdn_solution_sample(rig.solution,
                                     PDN_QUANTITY(PDN_JOINT_COORDINATE, rig.joint, coordinate),
                                     times, TIMES, q),
                 PDN_ERR_NOT_AVAILABLE);
    CHECK_MESSAGE("coordinate: expected one of a ");
}

/* --- Joints with one axis --- */

/* The force along the axis that the body needs beside its weight. */
static double thrust(struct wave along, double t)
{
    return MASS * (acceleration(along, t) - dot(GRAVITY, AXIS));
}

/* The body's centre is on the axis: what its weight needs across, the joint bears. */
static void check_body_on_axis(struct wave along, double force_along, double moment_about, int i,
                               const double *wrench, const double *at)
{
    int k;
    for (k = 0; k < 3; k++) {
        const double across = -MASS * (GRAVITY[k] - dot(GRAVITY, AXIS) * AXIS[k]);
        CHECK_NEAR(at[3 * i + k], POINT[k] + AXIS[k] * value(along, times[i]), 1e-10);
        CHECK_NEAR(wrench[6 * i + k], across + force_along * AXIS[k], 1e-8);
        CHECK_NEAR(wrench[6 * i + 3 + k], moment_about * AXIS[k], 1e-8);
    }
}

static const struct wave STILL = {0, 0, 0, 0};
static const struct wave SHIFT = {0.1, 0, -0.3, 0.2}, TURN = {0.2, 0, 0.5, -0.4};
static const struct wave TURNING = {0.1, OMEGA, 0.2, -0.1};

static void a_revolute_turns(void)
{
    double drive[TIMES], wrench[6 * TIMES], at[3 * TIMES];
    int i;
    begin();
    CHECK_STATUS(pdn_model_add_revolute(rig.model, PDN_GROUND, rig.body, POINT, AXIS, &rig.joint),
                 PDN_OK);
    prescribe(PDN_ROTATION, TURNING);
    solve();
    check_wave(PDN_ROTATION, TURNING);
    check_absent(PDN_DISPLACEMENT);
    driving_effort(PDN_ROTATION, drive);
    reaction(wrench);
    position(at);
    for (i = 0; i < TIMES; i++) {
        CHECK_NEAR(drive[i], INERTIA * acceleration(TURNING, times[i]), 1e-8);
        check_body_on_axis(STILL, thrust(STILL, times[i]), 0, i, wrench, at);
    }
    end();
}

static void a_prismatic_slides(void)
{
    double drive[TIMES], wrench[6 * TIMES], at[3 * TIMES];
    int i;
    begin();
    CHECK_STATUS(pdn_model_add_prismatic(rig.model, PDN_GROUND, rig.body, POINT, AXIS, &rig.joint),
                 PDN_OK);
    prescribe(PDN_DISPLACEMENT, SHIFT);
    solve();
    check_wave(PDN_DISPLACEMENT, SHIFT);
    check_absent(PDN_ROTATION);
    driving_effort(PDN_DISPLACEMENT, drive);
    reaction(wrench);
    position(at);
    for (i = 0; i < TIMES; i++) {
        CHECK_NEAR(drive[i], thrust(SHIFT, times[i]), 1e-8);
        check_body_on_axis(SHIFT, 0, 0, i, wrench, at);
    }
    end();
}

static void a_cylindrical_slides_and_turns(void)
{
    double push[TIMES], twist[TIMES], wrench[6 * TIMES], at[3 * TIMES];
    int i;
    begin();
    CHECK_STATUS(
        pdn_model_add_cylindrical(rig.model, PDN_GROUND, rig.body, POINT, AXIS, &rig.joint),
        PDN_OK);
    prescribe(PDN_DISPLACEMENT, SHIFT);
    prescribe(PDN_ROTATION, TURNING);
    solve();
    check_wave(PDN_DISPLACEMENT, SHIFT);
    check_wave(PDN_ROTATION, TURNING);
    check_absent(PDN_ROTATION_2);
    driving_effort(PDN_DISPLACEMENT, push);
    driving_effort(PDN_ROTATION, twist);
    reaction(wrench);
    position(at);
    for (i = 0; i < TIMES; i++) {
        CHECK_NEAR(push[i], thrust(SHIFT, times[i]), 1e-8);
        CHECK_NEAR(twist[i], INERTIA * acceleration(TURNING, times[i]), 1e-8);
        check_body_on_axis(SHIFT, 0, 0, i, wrench, at);
    }
    end();
}

/* The angle is prescribed, and advances the body; drive and thread share the thrust. */
static void check_screw(struct wave turn, size_t points)
{
    const double lead = PITCH / (2 * PI);
    const struct wave along = {lead * turn.mean, 0, lead * turn.cosine, lead * turn.sine};
    double drive[TIMES], wrench[6 * TIMES];
    int i;
    prescribe(PDN_ROTATION, turn);
    solve_on(points);
    check_wave(PDN_ROTATION, turn);
    check_wave(PDN_DISPLACEMENT, along);
    check_absent(PDN_DISPLACEMENT_2);
    driving_effort(PDN_ROTATION, drive);
    reaction(wrench);
    for (i = 0; i < TIMES; i++) {
        const double load = thrust(along, times[i]);
        CHECK_NEAR(drive[i], INERTIA * acceleration(turn, times[i]) + lead * load, 1e-8);
        CHECK_NEAR(dot(wrench + 6 * i, AXIS), load, 1e-8);
        CHECK_NEAR(dot(wrench + 6 * i + 3, AXIS), -lead * load, 1e-8);
    }
}

static void a_screw_advances(void)
{
    const struct wave turns = {0.5, 0, 8.0, -3.0}; /* more than one turn each way */
    double at[3 * TIMES], wrench[6 * TIMES];
    const double lead = PITCH / (2 * PI);
    const struct wave along = {lead * 0.5, 0, lead * 8.0, lead * -3.0};
    int i;
    begin();
    CHECK_STATUS(
        pdn_model_add_screw(rig.model, PDN_GROUND, rig.body, POINT, AXIS, PITCH, &rig.joint),
        PDN_OK);
    check_screw(turns, MANY);
    position(at);
    reaction(wrench);
    for (i = 0; i < TIMES; i++) {
        const double load = thrust(along, times[i]);
        check_body_on_axis(along, load, -lead * load, i, wrench, at);
    }
    end();
}

/* A frame at the joint's point, moved along its axis 3 and turned about it. */
static pdn_frame frame_at(double along, double turn)
{
    pdn_frame frame;
    int k;
    for (k = 0; k < 3; k++) {
        frame.position[k] = POINT[k] + along * AXIS[k];
        frame.rotation[k] = cos(turn) * ACROSS_1[k] + sin(turn) * ACROSS_2[k];
        frame.rotation[3 + k] = cos(turn) * ACROSS_2[k] - sin(turn) * ACROSS_1[k];
        frame.rotation[6 + k] = AXIS[k];
    }
    return frame;
}

/* Coordinates are measured from the frames as given: a quarter of a turn in the reference
 * configuration. */
static void a_screw_between_frames_starts_where_they_are(void)
{
    const struct wave turns = {0.5 * PI, 0, 0.9, -0.3};
    const pdn_frame first = frame_at(0, 0), second = frame_at(0.25 * PITCH, 0.5 * PI);
    double at[3 * TIMES];
    int i, k;
    begin();
    CHECK_STATUS(pdn_model_add_screw_between(rig.model, PDN_GROUND, rig.body, &first, &second,
                                             PITCH, &rig.joint),
                 PDN_OK);
    check_screw(turns, POINTS);
    position(at);
    for (i = 0; i < TIMES; i++)
        for (k = 0; k < 3; k++)
            CHECK_NEAR(at[3 * i + k],
                       POINT[k] + PITCH * (value(turns, times[i]) / (2 * PI) - 0.25) * AXIS[k],
                       1e-10);
    end();
}

/* --- Joints with more --- */

static void a_planar_slides_in_its_plane(void)
{
    const struct wave x = {0.1, 0, 0.2, -0.1}, y = {-0.2, 0, 0.05, 0.3};
    double push[2][TIMES], twist[TIMES], wrench[6 * TIMES], at[3 * TIMES];
    int i, k;
    begin();
    CHECK_STATUS(pdn_model_add_planar(rig.model, PDN_GROUND, rig.body, POINT, AXIS, &rig.joint),
                 PDN_OK);
    prescribe(PDN_DISPLACEMENT, x);
    prescribe(PDN_DISPLACEMENT_2, y);
    prescribe(PDN_ROTATION, TURNING);
    solve();
    check_wave(PDN_DISPLACEMENT, x);
    check_wave(PDN_DISPLACEMENT_2, y);
    check_wave(PDN_ROTATION, TURNING);
    check_absent(PDN_DISPLACEMENT_3);
    driving_effort(PDN_DISPLACEMENT, push[0]);
    driving_effort(PDN_DISPLACEMENT_2, push[1]);
    driving_effort(PDN_ROTATION, twist);
    reaction(wrench);
    position(at);
    for (i = 0; i < TIMES; i++) {
        const double t = times[i], a = value(x, t), b = value(y, t);
        const double ddx = acceleration(x, t), ddy = acceleration(y, t);
        double moved[3], weight, inertial;
        for (k = 0; k < 3; k++)
            moved[k] = at[3 * i + k] - POINT[k];
        CHECK_NEAR(dot(moved, AXIS), 0, 1e-10);
        CHECK_NEAR(dot(moved, moved), a * a + b * b, 1e-10);
        /* The library chose the axes in the plane: power tells nothing of them. */
        weight = dot(GRAVITY, AXIS);
        inertial = MASS * MASS * (dot(GRAVITY, GRAVITY) - weight * weight);
        CHECK_NEAR((push[0][i] - MASS * ddx) * (push[0][i] - MASS * ddx) +
                       (push[1][i] - MASS * ddy) * (push[1][i] - MASS * ddy),
                   inertial, 1e-6);
        CHECK_NEAR(twist[i], INERTIA * acceleration(TURNING, t), 1e-8);
        for (k = 0; k < 3; k++) {
            CHECK_NEAR(wrench[6 * i + k], -MASS * weight * AXIS[k], 1e-8);
            CHECK_NEAR(wrench[6 * i + 3 + k], 0, 1e-8);
        }
    }
    end();
}

/* Power of the drives is what the body gains, if joints do no work: J w . w' as its inertia is the
 * same about all axes. */
static void check_power_of_angles(int count)
{
    double drive[3][TIMES], speed[3][TIMES], velocity[6 * TIMES], gained[6 * TIMES];
    int i, k;
    for (k = 0; k < count; k++) {
        driving_effort(PDN_ROTATION + k, drive[k]);
        CHECK_STATUS(pdn_solution_sample(rig.solution,
                                         PDN_QUANTITY(PDN_JOINT_RATE, rig.joint, PDN_ROTATION + k),
                                         times, TIMES, speed[k]),
                     PDN_OK);
    }
    CHECK_STATUS(pdn_solution_sample(rig.solution,
                                     PDN_QUANTITY(PDN_NODE_VELOCITY, rig.body, PDN_ALL_COMPONENTS),
                                     times, TIMES, velocity),
                 PDN_OK);
    CHECK_STATUS(
        pdn_solution_sample(rig.solution,
                            PDN_QUANTITY(PDN_NODE_ACCELERATION, rig.body, PDN_ALL_COMPONENTS),
                            times, TIMES, gained),
        PDN_OK);
    for (i = 0; i < TIMES; i++) {
        double power = 0;
        for (k = 0; k < count; k++)
            power += drive[k][i] * speed[k][i];
        CHECK_NEAR(power, INERTIA * dot(velocity + 6 * i + 3, gained + 6 * i + 3), 1e-7);
    }
}

static void a_universal_turns_about_two_arms(void)
{
    const struct wave b = {0.1, 0, -0.2, 0.6};
    double wrench[6 * TIMES], rotation[9 * TIMES];
    int i, k;
    begin();
    CHECK_STATUS(pdn_model_add_universal(rig.model, PDN_GROUND, rig.body, POINT, ACROSS_1, ACROSS_2,
                                         &rig.joint),
                 PDN_OK);
    prescribe(PDN_ROTATION, TURN);
    prescribe(PDN_ROTATION_2, b);
    solve();
    check_wave(PDN_ROTATION, TURN);
    check_wave(PDN_ROTATION_2, b);
    check_absent(PDN_ROTATION_3);
    check_power_of_angles(2);
    reaction(wrench);
    CHECK_STATUS(pdn_solution_sample(rig.solution,
                                     PDN_QUANTITY(PDN_NODE_ROTATION, rig.body, PDN_ALL_COMPONENTS),
                                     times, TIMES, rotation),
                 PDN_OK);
    for (i = 0; i < TIMES; i++) {
        /* The second arm, fixed to the body, turns about the first. */
        double arm[3];
        const double *const R = rotation + 9 * i;
        for (k = 0; k < 3; k++)
            arm[k] = R[k] * ACROSS_2[0] + R[3 + k] * ACROSS_2[1] + R[6 + k] * ACROSS_2[2];
        CHECK_NEAR(dot(arm, ACROSS_1), 0, 1e-10);
        CHECK_NEAR(dot(arm, ACROSS_2), cos(value(TURN, times[i])), 1e-10);
        CHECK_NEAR(dot(arm, AXIS), sin(value(TURN, times[i])), 1e-10);
        for (k = 0; k < 3; k++)
            CHECK_NEAR(wrench[6 * i + k], -MASS * GRAVITY[k], 1e-8);
        /* It bears no moment about either arm. */
        CHECK_NEAR(dot(wrench + 6 * i + 3, ACROSS_1), 0, 1e-8);
        CHECK_NEAR(dot(wrench + 6 * i + 3, arm), 0, 1e-8);
    }
    end();
}

static void a_spherical_turns_by_three_angles(void)
{
    const struct wave b = {0.1, 0, -0.2, 0.6}, c = {-0.4, 0, 0.3, 0.3};
    double wrench[6 * TIMES];
    int i, k;
    begin();
    CHECK_STATUS(pdn_model_add_spherical(rig.model, PDN_GROUND, rig.body, POINT, &rig.joint),
                 PDN_OK);
    prescribe(PDN_ROTATION, TURN);
    prescribe(PDN_ROTATION_2, b);
    prescribe(PDN_ROTATION_3, c);
    solve();
    check_wave(PDN_ROTATION, TURN);
    check_wave(PDN_ROTATION_2, b);
    check_wave(PDN_ROTATION_3, c);
    check_absent(PDN_DISPLACEMENT);
    check_power_of_angles(3);
    reaction(wrench);
    for (i = 0; i < TIMES; i++)
        for (k = 0; k < 3; k++) {
            CHECK_NEAR(wrench[6 * i + k], -MASS * GRAVITY[k], 1e-8);
            CHECK_NEAR(wrench[6 * i + 3 + k], 0, 1e-8);
        }
    end();
}

static void a_free_joint_has_all_coordinates(void)
{
    static const struct wave waves[MOST_COORDINATES] = {{0.1, 0, 0.2, -0.1}, {-0.2, 0, 0.05, 0.3},
                                                        {0.3, 0, 0.1, 0.1},  {0.2, 0, 0.5, -0.4},
                                                        {0.1, 0, -0.2, 0.6}, {-0.4, 0, 0.3, 0.3}};
    double push[TIMES], wrench[6 * TIMES], at[3 * TIMES];
    int i, k;
    begin();
    CHECK_STATUS(pdn_model_add_free_joint(rig.model, PDN_GROUND, rig.body, POINT, &rig.joint),
                 PDN_OK);
    for (k = 0; k < MOST_COORDINATES; k++)
        prescribe(PDN_DISPLACEMENT + k, waves[k]);
    solve();
    for (k = 0; k < MOST_COORDINATES; k++)
        check_wave(PDN_DISPLACEMENT + k, waves[k]);
    check_power_of_angles(3);
    reaction(wrench);
    position(at);
    for (k = 0; k < 3; k++) {
        driving_effort(PDN_DISPLACEMENT + k, push);
        for (i = 0; i < TIMES; i++) {
            const double t = times[i];
            CHECK_NEAR(at[3 * i + k], POINT[k] + value(waves[k], t), 1e-10);
            CHECK_NEAR(push[i], MASS * (acceleration(waves[k], t) - GRAVITY[k]), 1e-8);
        }
    }
    for (i = 0; i < 6 * TIMES; i++)
        CHECK(wrench[i] == 0.0);
    end();
}

static void a_rigid_joint_bears_the_weight(void)
{
    double wrench[6 * TIMES], at[3 * TIMES];
    int i, k;
    begin();
    CHECK_STATUS(pdn_model_add_rigid_joint(rig.model, PDN_GROUND, rig.body, POINT, &rig.joint),
                 PDN_OK);
    solve();
    check_absent(PDN_DISPLACEMENT);
    check_absent(PDN_ROTATION);
    reaction(wrench);
    position(at);
    for (i = 0; i < TIMES; i++)
        for (k = 0; k < 3; k++) {
            CHECK_NEAR(at[3 * i + k], POINT[k], 1e-12);
            CHECK_NEAR(wrench[6 * i + k], -MASS * GRAVITY[k], 1e-9);
            CHECK_NEAR(wrench[6 * i + 3 + k], 0, 1e-9);
        }
    end();
}

/* A rod of varying length moves a slider, from a point at the height H above its axis. */
static void a_strut_moves_a_slider(void)
{
    const double height = 0.5, start = 0.4;
    const struct wave length = {0.9, 0, 0.1, 0.15};
    double foot[3], drive[TIMES], wrench[6 * TIMES], x[TIMES], hold[6 * TIMES];
    int32_t slider;
    int i, k;
    begin();
    for (k = 0; k < 3; k++)
        foot[k] = POINT[k] - start * AXIS[k] + height * ACROSS_1[k];
    CHECK_STATUS(pdn_model_add_prismatic(rig.model, PDN_GROUND, rig.body, POINT, AXIS, &slider),
                 PDN_OK);
    CHECK_STATUS(pdn_model_add_strut(rig.model, PDN_GROUND, rig.body, foot, POINT, &rig.joint),
                 PDN_OK);
    CHECK(slider == JOINT(0) && rig.joint == JOINT(1));
    prescribe(PDN_DISPLACEMENT, length);
    solve_on(MANY); /* its motion is not band-limited */
    check_wave(PDN_DISPLACEMENT, length);
    check_absent(PDN_ROTATION);
    driving_effort(PDN_DISPLACEMENT, drive);
    reaction(wrench);
    CHECK_STATUS(pdn_solution_sample(rig.solution,
                                     PDN_QUANTITY(PDN_JOINT_COORDINATE, slider, PDN_DISPLACEMENT),
                                     times, TIMES, x),
                 PDN_OK);
    CHECK_STATUS(pdn_solution_sample(rig.solution,
                                     PDN_QUANTITY(PDN_JOINT_REACTION, slider, PDN_ALL_COMPONENTS),
                                     times, TIMES, hold),
                 PDN_OK);
    for (i = 0; i < TIMES; i++) {
        const double t = times[i], l = value(length, t), v = rate(length, t);
        const double reach = sqrt(l * l - height * height);
        /* x x' = l l'. */
        const double speed = l * v / reach;
        const double a = (v * v + l * acceleration(length, t) - speed * speed) / reach;
        CHECK_NEAR(x[i], reach - start, 1e-9);
        CHECK_NEAR(drive[i], MASS * (a - dot(GRAVITY, AXIS)) * l / reach, 1e-7);
        /* The rod is not a part of its reaction, which is zero; the slider bears it across. */
        for (k = 0; k < 6; k++)
            CHECK(wrench[6 * i + k] == 0.0);
        CHECK_NEAR(dot(hold + 6 * i, ACROSS_1),
                   -MASS * dot(GRAVITY, ACROSS_1) + drive[i] * height / l, 1e-7);
    }
    end();
}

/* --- Joints by frames --- */

/* Samples of a joint: its coordinates, then its reaction. */
static void sample(const int32_t *coordinates, int count, double *to)
{
    int k;
    for (k = 0; k < count; k++, to += TIMES)
        CHECK_STATUS(
            pdn_solution_sample(rig.solution,
                                PDN_QUANTITY(PDN_JOINT_COORDINATE, rig.joint, coordinates[k]),
                                times, TIMES, to),
            PDN_OK);
    reaction(to);
}

static pdn_status add(int32_t kind, int32_t *joint)
{
    pdn_model *const m = rig.model;
    const int32_t ground = PDN_GROUND, body = rig.body;
    switch (kind) {
    case PDN_JOINT_RIGID:
        return pdn_model_add_rigid_joint(m, ground, body, POINT, joint);
    case PDN_JOINT_REVOLUTE:
        return pdn_model_add_revolute(m, ground, body, POINT, AXIS, joint);
    case PDN_JOINT_PRISMATIC:
        return pdn_model_add_prismatic(m, ground, body, POINT, AXIS, joint);
    case PDN_JOINT_CYLINDRICAL:
        return pdn_model_add_cylindrical(m, ground, body, POINT, AXIS, joint);
    case PDN_JOINT_UNIVERSAL:
        return pdn_model_add_universal(m, ground, body, POINT, ACROSS_1, ACROSS_2, joint);
    default:
        return PDN_ERR_VALUE;
    }
}

/* A joint by point and axis is the joint by frames that coincide, axis 3 along the axis. */
static void joints_by_frames_are_those_by_axes(void)
{
    static const struct {
        int32_t kind;
        int count;
        int32_t coordinates[2];
    } kinds[] = {
        {PDN_JOINT_RIGID, 0, {0, 0}},
        {PDN_JOINT_REVOLUTE, 1, {PDN_ROTATION, 0}},
        {PDN_JOINT_PRISMATIC, 1, {PDN_DISPLACEMENT, 0}},
        {PDN_JOINT_CYLINDRICAL, 2, {PDN_DISPLACEMENT, PDN_ROTATION}},
        {PDN_JOINT_UNIVERSAL, 2, {PDN_ROTATION, PDN_ROTATION_2}},
    };
    const pdn_frame frame = frame_at(0, 0);
    const struct wave waves[2] = {SHIFT, TURN};
    double samples[2][8 * TIMES];
    size_t n;
    int by_frames, i, k;
    for (n = 0; n < sizeof kinds / sizeof *kinds; n++) {
        const int32_t kind = kinds[n].kind;
        const int values = (kinds[n].count + 6) * TIMES;
        for (by_frames = 0; by_frames < 2; by_frames++) {
            begin();
            CHECK_STATUS(by_frames ? pdn_model_add_joint(rig.model, kind, PDN_GROUND, rig.body,
                                                         &frame, &frame, &rig.joint)
                                   : add(kind, &rig.joint),
                         PDN_OK);
            for (k = 0; k < kinds[n].count; k++)
                prescribe(kinds[n].coordinates[k], waves[k]);
            solve_on(FEW); /* the same errors on the same grid */
            sample(kinds[n].coordinates, kinds[n].count, samples[by_frames]);
            end();
        }
        for (i = 0; i < values; i++)
            CHECK_NEAR(samples[0][i], samples[1][i], 1e-9);
    }
}

/* In a plane by frames the axes are known: the weight is borne along them by the drives. */
static void a_planar_joint_by_frames_has_their_axes(void)
{
    const pdn_frame frame = frame_at(0, 0);
    const struct wave x = {0.1, 0, 0.2, -0.1}, y = {-0.2, 0, 0.05, 0.3};
    double push[2][TIMES], at[3 * TIMES];
    int i, k;
    begin();
    CHECK_STATUS(pdn_model_add_joint(rig.model, PDN_JOINT_PLANAR, PDN_GROUND, rig.body, &frame,
                                     &frame, &rig.joint),
                 PDN_OK);
    prescribe(PDN_DISPLACEMENT, x);
    prescribe(PDN_DISPLACEMENT_2, y);
    prescribe(PDN_ROTATION, TURN);
    solve();
    driving_effort(PDN_DISPLACEMENT, push[0]);
    driving_effort(PDN_DISPLACEMENT_2, push[1]);
    position(at);
    for (i = 0; i < TIMES; i++) {
        const double t = times[i];
        CHECK_NEAR(push[0][i], MASS * (acceleration(x, t) - dot(GRAVITY, ACROSS_1)), 1e-8);
        CHECK_NEAR(push[1][i], MASS * (acceleration(y, t) - dot(GRAVITY, ACROSS_2)), 1e-8);
        for (k = 0; k < 3; k++)
            CHECK_NEAR(at[3 * i + k],
                       POINT[k] + value(x, t) * ACROSS_1[k] + value(y, t) * ACROSS_2[k], 1e-10);
    }
    end();
}

/* Reactions along the axes of either frame are those along the inertial axes, resolved. */
static void reactions_are_resolved_in_either_frame(void)
{
    const pdn_frame frame = frame_at(0, 0);
    double space[6 * TIMES], first[6 * TIMES], second[6 * TIMES];
    int i, half, k;
    begin();
    CHECK_STATUS(pdn_model_add_joint(rig.model, PDN_JOINT_REVOLUTE, PDN_GROUND, rig.body, &frame,
                                     &frame, &rig.joint),
                 PDN_OK);
    prescribe(PDN_ROTATION, TURNING);
    solve();
    reaction(space);
    CHECK_STATUS(pdn_solution_sample(rig.solution,
                                     PDN_QUANTITY(PDN_JOINT_REACTION, rig.joint, PDN_ALL_COMPONENTS,
                                                  .frame = PDN_FRAME_FIRST),
                                     times, TIMES, first),
                 PDN_OK);
    CHECK_STATUS(pdn_solution_sample(rig.solution,
                                     PDN_QUANTITY(PDN_JOINT_REACTION, rig.joint, PDN_ALL_COMPONENTS,
                                                  .frame = PDN_FRAME_SECOND),
                                     times, TIMES, second),
                 PDN_OK);
    for (i = 0; i < TIMES; i++)
        for (half = 0; half < 6; half += 3) {
            const pdn_frame turned = frame_at(0, value(TURNING, times[i]));
            for (k = 0; k < 3; k++) {
                const double *const v = space + 6 * i + half;
                CHECK_NEAR(first[6 * i + half + k], dot(v, AXES + 3 * k), 1e-8);
                CHECK_NEAR(second[6 * i + half + k], dot(v, turned.rotation + 3 * k), 1e-8);
            }
        }
    end();
}

/* Axis 1 is what is across axis 3 of what is given, whatever its length. */
static void frames_from_axes(void)
{
    double oblique[3], longer[3];
    pdn_frame frame;
    for (int i = 0; i < 3; ++i) {
        oblique[i] = 3 * ACROSS_1[i] - 7 * AXIS[i];
        longer[i] = 5 * AXIS[i];
    }
    CHECK_STATUS(pdn_joint_frame(POINT, longer, oblique, &frame), PDN_OK);
    for (int i = 0; i < 9; ++i) {
        CHECK_NEAR(frame.rotation[i], AXES[i], 1e-14);
    }
    for (int i = 0; i < 3; ++i) {
        CHECK(frame.position[i] == POINT[i]);
    }
}

int main(void)
{
    frames_from_axes();
    a_revolute_turns();
    a_prismatic_slides();
    a_cylindrical_slides_and_turns();
    a_screw_advances();
    a_screw_between_frames_starts_where_they_are();
    a_planar_slides_in_its_plane();
    a_universal_turns_about_two_arms();
    a_spherical_turns_by_three_angles();
    a_free_joint_has_all_coordinates();
    a_rigid_joint_bears_the_weight();
    a_strut_moves_a_slider();
    joints_by_frames_are_those_by_axes();
    a_planar_joint_by_frames_has_their_axes();
    reactions_are_resolved_in_either_frame();
    return 0;
}
