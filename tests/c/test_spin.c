/* Bodies that spin relative to their nodes: the precession of a top, what can be read, and calls
 * that must be refused. */
#include "near.h"

static struct {
    pdn_model *model;
    double axis[3], rate;
    int32_t inertia;
} in;
static struct {
    double axis[3], rate;
} out;

static int model_changed(void)
{
    double axis[3], rate;
    CHECK_STATUS(pdn_model_spin(in.model, PDN_FIRST_INERTIA, axis, &rate), PDN_OK);
    return rate != 40 || axis[0] != 0 || axis[1] != 0 || axis[2] != 1;
}

#include "refusal.h"

enum { MASS = 2 };
static const double height = 0.3, along = 0.05, across = 0.2;

/* A top upright at the origin, on a hinge about y. */
static pdn_model *top(int32_t *inertia, int32_t *hinge)
{
    const double origin[3] = {0}, centre[3] = {0, 0, height}, y[3] = {0, 1, 0};
    const double up[3] = {0, 0, 2}, gravity[3] = {0, 0, -9.81};
    const double moment = across - MASS * height * height;
    const double moments[9] = {moment, 0, 0, 0, moment, 0, 0, 0, along};
    pdn_model *model;
    int32_t node;
    CHECK_STATUS(pdn_model_new(&model), PDN_OK);
    CHECK_STATUS(pdn_model_add_rigid_body(model, MASS, centre, moments, &node), PDN_OK);
    CHECK_STATUS(pdn_model_inertia_of(model, node, inertia), PDN_OK);
    CHECK_STATUS(pdn_model_add_revolute(model, PDN_GROUND, node, origin, y, hinge), PDN_OK);
    CHECK_STATUS(pdn_model_set_gravity(model, gravity), PDN_OK);
    CHECK_STATUS(pdn_model_set_spin(model, *inertia, up, 40), PDN_OK);
    return model;
}

/* A top that leans by 1 precesses steadily where the moments of gravity, of its spin and of its
 * precession balance: so a spring on the hinge has nothing to hold. The rate of the spin is a
 * parameter. */
static void a_top_precesses_steadily(void)
{
    const double up[3] = {0, 0, 1}, rate = 3, lean = 1;
    const double weight = MASS * 9.81 * height;
    const double spin = (weight + across * rate * rate * cos(lean)) / (along * rate) -
                        rate * cos(lean);
    int32_t inertia, hinge, speed, spring;
    double time = 0, angle, found, axis[3];
    pdn_static_options options;
    pdn_solution *solution;
    pdn_quantity quantity;
    pdn_model *model = top(&inertia, &hinge);
    CHECK_STATUS(pdn_model_set_turning_frame(model, up, rate, NULL), PDN_OK);
    CHECK_STATUS(pdn_model_add_parameter(model, "speed", spin / 2, 1, &speed), PDN_OK);
    CHECK_STATUS(pdn_model_move_number(model, speed, PDN_NUMBER_SPIN, inertia, 0, 2), PDN_OK);
    CHECK_STATUS(pdn_model_spin(model, inertia, axis, &found), PDN_OK);
    CHECK_NEAR(found, spin, 1e-13 * spin);
    CHECK_STATUS(
        pdn_model_add_spring_damper(model, hinge, PDN_ROTATION, 50, 0, lean, &spring), PDN_OK);
    PDN_INIT(pdn_static_options, &options);
    CHECK_STATUS(pdn_solve_static(model, &options, &solution), PDN_OK);
    CHECK(pdn_solution_outcome(solution) == PDN_CONVERGED);
    PDN_INIT(pdn_quantity, &quantity);
    quantity.kind = PDN_JOINT_COORDINATE;
    quantity.component = PDN_ROTATION;
    quantity.object = hinge;
    CHECK_STATUS(pdn_solution_sample(solution, &quantity, &time, 1, &angle), PDN_OK);
    CHECK_NEAR(angle, lean, 1e-10);
    pdn_solution_free(solution);
    pdn_model_free(model);
}

/* A shaft clamped at one end, of one element, whose sections have the other bending stiffness about
 * axis 3. */
static pdn_model *shaft(double other)
{
    const double start[3] = {0}, end[3] = {1, 0, 0}, up[3] = {0, 0, 1};
    pdn_section section;
    pdn_beam ids;
    pdn_model *model;
    int32_t held;
    CHECK_STATUS(pdn_model_new(&model), PDN_OK);
    PDN_INIT(pdn_section, &section);
    for (int i = 0; i < 6; ++i) {
        section.stiffness[7 * i] = i < 3 ? 1e4 : 100;
        section.damping[7 * i] = i < 3 ? 10 : 0.1;
        section.mass[7 * i] = i < 3 ? 2 : 0;
    }
    section.stiffness[35] = other;
    CHECK_STATUS(pdn_model_add_straight_beam(model, start, end, up, &section, 1, 4, &ids), PDN_OK);
    CHECK_STATUS(
        pdn_model_add_rigid_joint(model, PDN_GROUND, ids.first, start, &held), PDN_OK);
    return model;
}

/* Damping of 1e-3 s that rotates, and no other, makes a shaft unstable that spins faster than its
 * first frequency: it is at rest, spins slower, and faster. The rate is a parameter. */
static void rotating_damping_limits_the_speed(void)
{
    const double parts[3] = {0, 0.9, 1.1};
    double first = 0, rate;
    for (int i = 0; i < 3; ++i) {
        const double wanted = parts[i] * first;
        pdn_model *model = shaft(100);
        pdn_modes_options options;
        pdn_modes *modes;
        pdn_mode mode;
        int32_t speed;
        CHECK_STATUS(pdn_model_set_beam_spin(model, PDN_FIRST_BEAM_ELEMENT, 1, 3), PDN_OK);
        CHECK_STATUS(pdn_model_add_parameter(model, "speed", wanted, 1, &speed), PDN_OK);
        CHECK_STATUS(pdn_model_move_number(model, speed, PDN_NUMBER_BEAM_SPIN,
                                           PDN_FIRST_BEAM_ELEMENT, 0, 1),
                     PDN_OK);
        CHECK_STATUS(pdn_model_beam_spin(model, PDN_FIRST_BEAM_ELEMENT, &rate), PDN_OK);
        CHECK(rate == wanted);
        PDN_INIT(pdn_modes_options, &options);
        options.count = 2;
        CHECK_STATUS(pdn_solve_modes(model, &options, &modes), PDN_OK);
        double growth = -1;
        for (int k = 0; k < 2; ++k) {
            PDN_INIT(pdn_mode, &mode);
            CHECK_STATUS(pdn_modes_get(modes, k, &mode), PDN_OK);
            growth = fmax(growth, mode.eigenvalue_real);
        }
        CHECK((growth > 0) == (i == 2));
        first = hypot(mode.eigenvalue_real, mode.eigenvalue_imaginary);
        pdn_modes_free(modes);
        pdn_model_free(model);
    }
}

static void bad_spins_are_refused(void)
{
    const double axis[3] = {0}, askew[3] = {0, 1, 0};
    const double mass[36] = {0};
    int32_t other;
    pdn_model *model = top(&in.inertia, &other);
    in.model = model;
    in.axis[2] = 1;
    in.rate = 2;
#define CALL pdn_model_set_spin(in.model, in.inertia, in.axis, in.rate)
    REFUSED(pdn_model_set_spin(NULL, in.inertia, in.axis, 1), PDN_ERR_NULL, "model: ");
    REFUSED(pdn_model_set_spin(in.model, in.inertia, NULL, 1), PDN_ERR_NULL, "axis: ");
    REFUSED(pdn_model_set_spin(in.model, in.inertia, axis, 1), PDN_ERR_VALUE, "axis: ");
    REFUSED(pdn_model_set_spin(in.model, in.inertia, askew, 1), PDN_ERR_VALUE,
            "inertia: expected one that is symmetric about the axis");
    REFUSED(pdn_model_set_spin(in.model, 0, in.axis, 1), PDN_ERR_ID, "inertia: ");
    REFUSED(pdn_model_set_spin(in.model, in.inertia + 1, in.axis, 1), PDN_ERR_ID, "inertia: ");
    REFUSES_NOT_FINITE_ENTRIES(in.axis, 3, CALL, "axis");
    REFUSES_NOT_FINITE(in.rate, CALL, "rate");
#undef CALL
#define CALL pdn_model_spin
    REFUSED(CALL(NULL, in.inertia, out.axis, &out.rate), PDN_ERR_NULL, "model: ");
    REFUSED(CALL(in.model, in.inertia, NULL, &out.rate), PDN_ERR_NULL, "axis: ");
    REFUSED(CALL(in.model, in.inertia, out.axis, NULL), PDN_ERR_NULL, "rate: ");
    REFUSED(CALL(in.model, in.inertia + 1, out.axis, &out.rate), PDN_ERR_ID, "inertia: ");
    CHECK_STATUS(pdn_model_add_inertia(model, PDN_FIRST_NODE, NULL, mass, &other), PDN_OK);
    REFUSED(CALL(in.model, other, out.axis, &out.rate), PDN_ERR_NOT_AVAILABLE,
            "inertia: expected one that spins");
#undef CALL
    pdn_model_free(model);
    in.model = NULL;
}

static void bad_spins_of_beams_are_refused(void)
{
    pdn_model *beam = shaft(100), *flat = shaft(101);
    int32_t inertia, hinge;
    in.model = top(&inertia, &hinge);
    in.rate = 2;
#define CALL pdn_model_set_beam_spin(beam, PDN_FIRST_BEAM_ELEMENT, 1, in.rate)
    REFUSED(pdn_model_set_beam_spin(NULL, PDN_FIRST_BEAM_ELEMENT, 1, 1), PDN_ERR_NULL, "model: ");
    REFUSED(pdn_model_set_beam_spin(beam, 0, 1, 1), PDN_ERR_ID, "first_element: ");
    REFUSED(pdn_model_set_beam_spin(beam, PDN_FIRST_BEAM_ELEMENT, 0, 1), PDN_ERR_SIZE,
            "elements: ");
    REFUSED(pdn_model_set_beam_spin(flat, PDN_FIRST_BEAM_ELEMENT, 1, 1), PDN_ERR_VALUE,
            "beam element 0: expected sections that are symmetric about axis 1");
    REFUSES_NOT_FINITE(in.rate, CALL, "rate");
#undef CALL
#define CALL pdn_model_beam_spin
    REFUSED(CALL(NULL, PDN_FIRST_BEAM_ELEMENT, &out.rate), PDN_ERR_NULL, "model: ");
    REFUSED(CALL(beam, PDN_FIRST_BEAM_ELEMENT, NULL), PDN_ERR_NULL, "rate: ");
    REFUSED(CALL(beam, PDN_FIRST_BEAM_ELEMENT + 1, &out.rate), PDN_ERR_ID, "element: ");
#undef CALL
    pdn_model_free(flat);
    pdn_model_free(beam);
    pdn_model_free(in.model);
}

int main(void)
{
    a_top_precesses_steadily();
    rotating_damping_limits_the_speed();
    bad_spins_are_refused();
    bad_spins_of_beams_are_refused();
    printf("%d calls refused\n", refusals);
    return 0;
}
