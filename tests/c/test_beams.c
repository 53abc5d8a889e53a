/* Beams along lines, with sections and twist that vary; loads and forces along beams; gravity in
 * time. */
#include "check.h"
#include <math.h>
#include <stddef.h>

#define PI 3.14159265358979323846

static const double ORIGIN[3] = {0, 0, 0};

static void check_near(double found, double exact, double tolerance, int line)
{
    if (!(fabs(found - exact) <= tolerance)) {
        fprintf(stderr, "line %d: %.15g instead of %.15g\n", line, found, exact);
        exit(1);
    }
}

#define NEAR(found, exact, tolerance) check_near((found), (exact), (tolerance), __LINE__)

static pdn_model *new_model(void)
{
    pdn_model *model = NULL;
    CHECK_STATUS(pdn_model_new(&model), PDN_OK);
    return model;
}

static pdn_section section(double scale, double mass)
{
    const double stiffness[6] = {9e4 * scale, 4e4 * scale, 3e4 * scale,
                                 3e2 * scale, 5e2 * scale, 8e2 * scale};
    const double masses[4] = {mass, 0.02, 0.01, 0.01};
    pdn_section made;
    PDN_INIT(pdn_section, &made);
    CHECK_STATUS(pdn_section_set_diagonal(&made, stiffness, masses), PDN_OK);
    return made;
}

static pdn_stations uniform(const pdn_section *all_along)
{
    pdn_stations stations;
    PDN_INIT(pdn_stations, &stations);
    CHECK(stations.struct_size == sizeof stations && stations.count == 0);
    CHECK(!stations.fractions && !stations.sections && !stations.twists);
    stations.count = 1;
    stations.sections = all_along;
    return stations;
}

/* Fixes a node to the ground at a point; gives the joint. */
static int32_t hold(pdn_model *model, int32_t node, const double *point)
{
    int32_t joint = -1;
    CHECK_STATUS(pdn_model_add_rigid_joint(model, PDN_GROUND, node, point, &joint), PDN_OK);
    return joint;
}

static pdn_signal constant(double value)
{
    pdn_signal signal;
    PDN_INIT(pdn_signal, &signal);
    CHECK_STATUS(pdn_signal_set_constant(&signal, value), PDN_OK);
    return signal;
}

/* On so many points of time; one of them is statics. */
static pdn_solution *solve(const pdn_model *model, size_t grid_points)
{
    pdn_periodic_options options;
    pdn_solution *solution = NULL;
    PDN_INIT(pdn_periodic_options, &options);
    options.grid_points = grid_points;
    CHECK_STATUS(pdn_solve_periodic(model, 1.0, &options, &solution), PDN_OK);
    CHECK(pdn_solution_outcome(solution) == PDN_CONVERGED);
    return solution;
}

/* Force and moment of a joint at time zero. */
static void reaction(const pdn_solution *solution, int32_t joint, double time, double *wrench)
{
    CHECK_STATUS(pdn_solution_sample(solution,
                                     PDN_QUANTITY(PDN_JOINT_REACTION, joint, PDN_ALL_COMPONENTS),
                                     &time, 1, wrench),
                 PDN_OK);
}

/* Sections at stations, with a jump and a twist: mass, axes of the nodes, and the mesh. */
static void sections_and_twist_vary(void)
{
    const double end[3] = {0, 3, 0}, up[3] = {0, 0, 2};
    const double fractions[4] = {0, 0.5, 0.5, 1}, twists[4] = {0.1, 0.6, 0.6, -0.2};
    const pdn_section sections[4] = {section(4, 4), section(2, 2), section(1, 1), section(1, 0.5)};
    pdn_model *model = new_model();
    pdn_line line;
    pdn_stations stations;
    pdn_beam beam;
    pdn_frame frame;
    double mass, angle;
    int32_t node;
    PDN_INIT(pdn_line, &line);
    CHECK(line.struct_size == sizeof line && line.kind == PDN_LINE_STRAIGHT && !line.curve);
    CHECK_STATUS(pdn_line_set_straight(&line, ORIGIN, end, up), PDN_OK);
    PDN_INIT(pdn_stations, &stations);
    stations.count = 4;
    stations.fractions = fractions;
    stations.sections = sections;
    CHECK_STATUS(pdn_model_add_beam(model, &line, &stations, 2, 3, &beam), PDN_OK);
    CHECK(beam.first == NODE(0) && beam.last == NODE(6) && beam.first_element == BEAM_ELEMENT(0) &&
          beam.elements == 2);
    CHECK_STATUS(pdn_model_mass(model, &mass, NULL), PDN_OK);
    NEAR(mass, 1.5 * 3 + 1.5 * 0.75, 1e-13);

    stations.twists = twists;
    CHECK_STATUS(pdn_model_add_beam(model, &line, &stations, 4, 2, &beam), PDN_OK);
    CHECK(beam.first == NODE(7) && beam.last == NODE(15) && beam.first_element == BEAM_ELEMENT(2) &&
          beam.elements == 4);
    for (node = 0; node <= 8; node++) {
        const double fraction = node / 8.0;
        CHECK_STATUS(pdn_model_node_frame(model, beam.first + node, &frame), PDN_OK);
        NEAR(frame.position[1], 3 * fraction, 1e-14);
        NEAR(frame.rotation[1], 1, 1e-14);
        /* Axis 2 is up, turned about axis 1, which is global axis 2. */
        angle = fraction < 0.5 ? 0.1 + fraction : 0.6 - 1.6 * (fraction - 0.5);
        NEAR(frame.rotation[3], sin(angle), 1e-14);
        NEAR(frame.rotation[5], cos(angle), 1e-14);
    }
    /* Elements between the stations and a place of one's own. */
    stations.twists = NULL;
    const double boundaries[5] = {0, 0.125, 0.5, 0.75, 1}, amiss[3] = {0, 0.25, 1};
    const pdn_beam before = beam;
    CHECK_STATUS(pdn_model_add_beam_between(model, &line, &stations, amiss, 3, 2, &beam),
                 PDN_ERR_VALUE);
    CHECK_MESSAGE("boundaries: expected one at 0.5, where the section jumps, got none");
    CHECK_STATUS(pdn_model_add_beam_between(model, &line, &stations, NULL, 5, 2, &beam),
                 PDN_ERR_NULL);
    CHECK_STATUS(pdn_model_add_beam_between(model, &line, &stations, boundaries, 1, 2, &beam),
                 PDN_ERR_SIZE);
    CHECK_MESSAGE("count: expected at least 2, got 1");
    CHECK(memcmp(&before, &beam, sizeof beam) == 0);
    CHECK_STATUS(pdn_model_add_beam_between(model, &line, &stations, boundaries, 5, 2, &beam),
                 PDN_OK);
    CHECK(beam.first == NODE(16) && beam.last == NODE(24) && beam.elements == 4);
    for (node = 0; node <= 4; node++) {
        CHECK_STATUS(pdn_model_node_frame(model, beam.first + 2 * node, &frame), PDN_OK);
        NEAR(frame.position[1], 3 * boundaries[node], 1e-14);
    }
    pdn_model_free(model);
}

/* The 45 degree bend: a circle of radius 100 about (0, -100, 0). */
static const double RADIUS = 100;

static void on_circle(double angle, double *position)
{
    position[0] = RADIUS * sin(angle);
    position[1] = RADIUS * (cos(angle) - 1);
    position[2] = 0;
}

static int32_t circle(double fraction, double *position, double *axis_2, void *user_data)
{
    const double angle = fraction * *(const double *)user_data;
    on_circle(angle, position);
    axis_2[0] = 7 * sin(angle);
    axis_2[1] = 7 * cos(angle);
    axis_2[2] = 0;
    return 0;
}

/* Displacement of its end under a force across its plane. */
static void bend(const pdn_line *line, const pdn_stations *stations, double *displacement)
{
    const pdn_signal force = constant(600);
    const double time = 0;
    double end[3], position[3];
    pdn_model *model = new_model();
    pdn_solution *solution;
    pdn_beam beam;
    int i;
    CHECK_STATUS(pdn_model_add_beam(model, line, stations, 2, 9, &beam), PDN_OK);
    hold(model, beam.first, ORIGIN);
    CHECK_STATUS(pdn_model_add_load(model, beam.last, PDN_FRAME_SPACE, PDN_FORCE_3, &force, NULL),
                 PDN_OK);
    solution = solve(model, 1);
    CHECK_STATUS(pdn_solution_sample(solution,
                                     PDN_QUANTITY(PDN_NODE_POSITION, beam.last, PDN_ALL_COMPONENTS),
                                     &time, 1, position),
                 PDN_OK);
    on_circle(PI / 4, end);
    for (i = 0; i < 3; i++)
        displacement[i] = position[i] - end[i];
    pdn_solution_free(solution);
    pdn_model_free(model);
}

static void a_bend_as_an_arc_and_as_a_curve(void)
{
    /* By integration of the rod's equations. */
    const double exact[3] = {-23.560581878, 13.604632402, 53.475477998};
    const double shear = 5e6 * 5 / 6, bending = 1e7 / 12, axis_2[3] = {0, 1, 0};
    const double stiffness[6] = {1e7, shear, shear, bending, bending, bending};
    const double mass[4] = {1, 0.1, 0.1, 0.1};
    double middle[3], end[3], found[3], angle = PI / 4;
    pdn_section square;
    pdn_stations stations;
    pdn_line line;
    int i;
    PDN_INIT(pdn_section, &square);
    CHECK_STATUS(pdn_section_set_diagonal(&square, stiffness, mass), PDN_OK);
    stations = uniform(&square);
    PDN_INIT(pdn_line, &line);
    on_circle(0.3, middle);
    on_circle(angle, end);
    CHECK_STATUS(pdn_line_set_arc(&line, ORIGIN, middle, end, axis_2), PDN_OK);
    CHECK(line.kind == PDN_LINE_ARC && line.point[0] == middle[0] && line.axis_2[1] == 1);
    bend(&line, &stations, found);
    for (i = 0; i < 3; i++)
        NEAR(found[i], exact[i], 1e-6);
    CHECK_STATUS(pdn_line_set_curve(&line, circle, &angle), PDN_OK);
    CHECK(line.kind == PDN_LINE_CURVE && line.curve == circle && line.start[0] == 0);
    CHECK(line.user_data == &angle && line.point[0] == 0);
    bend(&line, &stations, found);
    for (i = 0; i < 3; i++)
        NEAR(found[i], exact[i], 1e-6);
}

/* A stiff cantilever along axis 1, so that it hardly bends. */
static pdn_model *cantilever(pdn_beam *beam, int32_t *joint)
{
    const double end[3] = {2, 0, 0}, axis_2[3] = {0, 1, 0};
    const pdn_section stiff = section(1e6, 3);
    pdn_model *model = new_model();
    CHECK_STATUS(pdn_model_add_straight_beam(model, ORIGIN, end, axis_2, &stiff, 3, 3, beam),
                 PDN_OK);
    *joint = hold(model, beam->first, ORIGIN);
    return model;
}

static void loads_along_a_beam_add_up(void)
{
    const double fractions[4] = {0, 0.25, 0.25, 1}, factors[4] = {0, 1, 2, 0};
    const pdn_signal load = constant(-10), moment = constant(4);
    const int32_t frames[2] = {PDN_FRAME_SPACE, PDN_FRAME_MATERIAL};
    int i;
    for (i = 0; i < 2; i++) {
        pdn_beam beam;
        int32_t joint;
        pdn_model *model = cantilever(&beam, &joint);
        pdn_solution *solution;
        double held[6], sum, about;
        CHECK_STATUS(pdn_model_add_distributed_load(model, beam.first_element, beam.elements,
                                                    frames[i], PDN_FORCE_3, &load, fractions,
                                                    factors, 4, NULL),
                     PDN_OK);
        /* Moment about axis 1 along the last two thirds. */
        CHECK_STATUS(pdn_model_add_distributed_load(model, beam.first_element + 1, 2, frames[i],
                                                    PDN_MOMENT_1, &moment, NULL, NULL, 0, NULL),
                     PDN_OK);
        solution = solve(model, 1);
        reaction(solution, joint, 0, held);
        /* Triangles: 1/8 with its centre at 1/6 of the length, 3/4 with its centre at 1/2. */
        sum = 10 * 2 * (0.125 + 0.75);
        about = 10 * 4 * (0.125 / 6 + 0.75 / 2);
        NEAR(fabs(held[2]), sum, 1e-6);
        NEAR(fabs(held[4]), about, 1e-6);
        NEAR(fabs(held[3]), 4 * 2 * 2.0 / 3, 1e-6);
        CHECK(held[2] * held[4] < 0);
        NEAR(held[0], 0, 1e-5);
        NEAR(held[1], 0, 1e-5);
        pdn_solution_free(solution);
        pdn_model_free(model);
    }
}

/* What the function below is told, and whether its data was disposed of. */
struct wind {
    double length, off;
    int32_t elements[3], calls, destroyed;
};

/* A lift of 7 along axis 3 of the sections less drag, and a moment about their axis 1 that grows
 * along the beam. */
static int32_t blow(const pdn_surface_state *state, pdn_surface_values *values, void *user_data)
{
    struct wind *wind = user_data;
    const int32_t element = state->element - PDN_FIRST_BEAM_ELEMENT;
    size_t k;
    wind->calls++;
    wind->length = wind->off = 0;
    CHECK(state->struct_size == sizeof *state && values->struct_size == sizeof *values);
    CHECK(element >= 1 && element < 3 && state->reserved == 0 && state->point_count >= 4);
    wind->elements[element]++;
    for (k = 0; k < state->point_count; k++) {
        const double fraction = 0.5 * (state->places[2 * k] + 1);
        CHECK(fraction > 0 && fraction < 1 && state->places[2 * k + 1] == 0);
        wind->off += fabs(state->positions[3 * k] - (element + fraction) * 2 / 3);
        wind->off += fabs(state->rotations[9 * k] - 1);
        wind->length += state->sizes[k];
        values->forces[6 * k + 2] = 7 - 0.2 * state->velocities[6 * k + 2];
        values->forces[6 * k + 3] = 4 * (element + fraction);
        if (values->by_velocity)
            values->by_velocity[36 * k + 14] = -0.2;
    }
    return 0;
}

static void dispose(void *user_data)
{
    ((struct wind *)user_data)->destroyed++;
}

/* The reaction tells the integrals of what a function gives along the last two thirds; also in a
 * model from a file, to which the function comes back by its label. */
static void a_function_along_a_beam_adds_up(void)
{
    struct wind wind = {0, 0, {0, 0, 0}, 0, 0};
    pdn_beam beam;
    pdn_force_info info;
    pdn_solution *solution;
    double held[6];
    int32_t joint, force, found;
    pdn_model *model = cantilever(&beam, &joint);
    CHECK_STATUS(pdn_model_add_line_force(model, beam.first_element + 1, 2, PDN_FRAME_MATERIAL,
                                          NULL, PDN_TANGENTS_GIVEN, blow, &wind, dispose, &force),
                 PDN_OK);
    CHECK(force == FORCE(0));
    PDN_INIT(pdn_force_info, &info);
    CHECK_STATUS(pdn_model_force(model, force + 1, &info), PDN_OK);
    CHECK(info.kind == PDN_FORCE_IS_LINE_FORCE && info.beam_element == BEAM_ELEMENT(2));
    CHECK(info.shell_element == -1 && info.shell_place == -1 && info.node_count == 0);
    CHECK(info.axis_2[0] == 0 && info.axis_2[1] == 0 && info.axis_2[2] == 0);
    CHECK_STATUS(pdn_model_set_label(model, force, "wind"), PDN_OK);
    CHECK_STATUS(pdn_model_save(model, "line_forces.pdm"), PDN_OK);
    pdn_model_free(model);
    CHECK(wind.calls == 0 && wind.destroyed == 1);

    CHECK_STATUS(pdn_model_load("line_forces.pdm", &model), PDN_OK);
    remove("line_forces.pdm");
    CHECK_STATUS(pdn_solve_static(model, NULL, &solution), PDN_ERR_CALLBACK);
    CHECK_STATUS(pdn_model_find_label(model, PDN_OBJECT_FORCE, "wind", &found), PDN_OK);
    CHECK(found == force);
    CHECK_STATUS(pdn_model_bind_surface_force(model, found, 2, PDN_FRAME_MATERIAL,
                                              PDN_TANGENTS_DIFFERENCED, blow, &wind, dispose),
                 PDN_OK);
    solution = solve(model, 1);
    reaction(solution, joint, 0, held);
    NEAR(fabs(held[2]), 7 * 4.0 / 3, 1e-6);
    NEAR(fabs(held[4]), 7 * 4.0 / 3 * 4.0 / 3, 1e-5);
    /* 4 x from 1 to 3 thirds. */
    NEAR(fabs(held[3]), 4 * 4.0 * 2 / 3, 1e-6);
    NEAR(held[1], 0, 1e-5);
    CHECK(wind.elements[0] == 0 && wind.elements[1] == wind.elements[2] && wind.elements[1] > 0);
    NEAR(wind.length, 2.0 / 3, 1e-14);
    /* It hardly bends. */
    NEAR(wind.off, 0, 1e-4);
    pdn_model_free(model);
    CHECK(wind.destroyed == 1);
    pdn_solution_free(solution);
    CHECK(wind.destroyed == 2);
}

/* The reaction of a twisted cantilever shows how the untwisted axes direct a load. */
static void a_load_at_places_in_untwisted_axes(void)
{
    const double end[3] = {3, 0, 0}, axis_2[3] = {0, 1, 0}, given[3] = {0.3, 0, 2};
    const double fractions[3] = {0, 0.5, 1}, at[2] = {0, 1}, twists[2] = {0.2, 1.1};
    pdn_section sections[2];
    pdn_signal signals[18];
    pdn_stations stations;
    pdn_line line;
    pdn_beam beam;
    pdn_solution *solution;
    pdn_model *model = new_model();
    double held[6];
    int32_t joint;
    int i;
    sections[0] = sections[1] = section(1e6, 3);
    PDN_INIT(pdn_line, &line);
    CHECK_STATUS(pdn_line_set_straight(&line, ORIGIN, end, axis_2), PDN_OK);
    PDN_INIT(pdn_stations, &stations);
    stations.count = 2;
    stations.fractions = at;
    stations.sections = sections;
    stations.twists = twists;
    CHECK_STATUS(pdn_model_add_beam(model, &line, &stations, 4, 3, &beam), PDN_OK);
    joint = hold(model, beam.first, ORIGIN);
    for (i = 0; i < 18; i++)
        PDN_INIT(pdn_signal, &signals[i]);
    /* Along the given direction, across the beam: 0, 4, 10 for a unit of length; along the beam 1,
     * 1, 1; a moment of 2 at the start. */
    signals[6 + 1] = constant(4);
    signals[12 + 1] = constant(10);
    for (i = 0; i < 3; i++)
        signals[6 * i] = constant(1);
    signals[5] = constant(2);
    CHECK_STATUS(pdn_model_add_load_at_places(model, beam.first_element, beam.elements,
                                              PDN_FRAME_UNTWISTED, given, fractions, signals, 3,
                                              NULL),
                 PDN_OK);
    solution = solve(model, 1);
    reaction(solution, joint, 0, held);
    /* Axis 2 is global axis 3, axis 3 is the other way along global axis 2. */
    NEAR(fabs(held[0]), 3, 1e-5);
    NEAR(fabs(held[1]), 0, 1e-5);
    NEAR(fabs(held[2]), 1.5 * (2 + 7), 1e-5);
    /* Of the forces 3 + 24.75 by integration, of the moment along the first half 1.5 about axis 3,
     * the same way. */
    NEAR(fabs(held[3]), 0, 1e-4);
    NEAR(fabs(held[4]), 27.75 + 1.5, 1e-4);
    NEAR(fabs(held[5]), 0, 1e-4);
    pdn_solution_free(solution);
    pdn_model_free(model);
}

static void gravity_may_vary(void)
{
    const double cosines[1] = {2}, sines[1] = {0.5}, centre[3] = {0.3, 0.2, 0.1};
    const double inertia[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    pdn_model *model = new_model();
    pdn_solution *solution;
    pdn_signal shake, weight = constant(-9.81);
    int32_t body, joint, k;
    CHECK_STATUS(pdn_model_add_rigid_body(model, 2.5, centre, inertia, &body), PDN_OK);
    joint = hold(model, body, ORIGIN);
    PDN_INIT(pdn_signal, &shake);
    CHECK_STATUS(pdn_signal_set_harmonics(&shake, 0, 0, cosines, sines, 1), PDN_OK);
    CHECK_STATUS(pdn_model_set_gravity_signals(model, &shake, NULL, &weight), PDN_OK);
    solution = solve(model, 5);
    for (k = 0; k < 7; k++) {
        const double time = 0.15 * k;
        const double sway = 2 * cos(2 * PI * time) + 0.5 * sin(2 * PI * time);
        double held[6];
        reaction(solution, joint, time, held);
        NEAR(fabs(held[0]), fabs(2.5 * sway), 1e-11);
        NEAR(held[1], 0, 1e-11);
        NEAR(fabs(held[2]), 2.5 * 9.81, 1e-11);
        /* About ORIGIN: r x f. */
        NEAR(held[5], 0.3 * held[1] - 0.2 * held[0], 1e-11);
        NEAR(held[4], 0.1 * held[0] - 0.3 * held[2], 1e-11);
    }
    pdn_solution_free(solution);
    pdn_model_free(model);
}

/* A body that a rigid joint fixes to the beam's end, away from it, and a point mass on
 * that body. */
static void bodies_hang_at_a_distance(void)
{
    const double centre[3] = {2.5, 0.4, 0}, point[3] = {2.5, 1.4, 0}, down[3] = {0, 0, -10};
    const double inertia[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    pdn_beam beam;
    int32_t joint, body, tie;
    pdn_model *model = cantilever(&beam, &joint);
    pdn_solution *solution;
    double held[6], mass, at[3];
    CHECK_STATUS(pdn_model_add_rigid_body(model, 1, centre, inertia, &body), PDN_OK);
    CHECK_STATUS(pdn_model_add_mass(model, body, 0.5, point, NULL, NULL), PDN_OK);
    CHECK_STATUS(pdn_model_add_rigid_joint(model, beam.last, body, centre, &tie), PDN_OK);
    CHECK_STATUS(pdn_model_set_gravity(model, down), PDN_OK);
    CHECK_STATUS(pdn_model_mass(model, &mass, at), PDN_OK);
    NEAR(mass, 6 + 1 + 0.5, 1e-13);
    NEAR(at[0], (6 * 1 + 1.5 * 2.5) / 7.5, 1e-13);
    NEAR(at[1], (0.4 + 0.5 * 1.4) / 7.5, 1e-13);
    solution = solve(model, 1);
    reaction(solution, joint, 0, held);
    NEAR(fabs(held[2]), 75, 1e-8);
    NEAR(fabs(held[4]), 10 * (6 * 1 + 1.5 * 2.5), 1e-5);
    NEAR(fabs(held[3]), 10 * (0.4 + 0.5 * 1.4), 1e-5);
    reaction(solution, tie, 0, held);
    NEAR(fabs(held[2]), 15, 1e-8);
    NEAR(fabs(held[3]), 10 * 0.5 * 1, 1e-5);
    pdn_solution_free(solution);
    pdn_model_free(model);
}

int main(void)
{
    sections_and_twist_vary();
    a_bend_as_an_arc_and_as_a_curve();
    loads_along_a_beam_add_up();
    a_function_along_a_beam_adds_up();
    a_load_at_places_in_untwisted_axes();
    gravity_may_vary();
    bodies_hang_at_a_distance();
    return 0;
}
