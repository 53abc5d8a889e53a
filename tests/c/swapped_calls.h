/* Calls of test_swapped.c: each takes its integers from an array, in their order. */
#ifndef PDN_TEST_SWAPPED_CALLS_H
#define PDN_TEST_SWAPPED_CALLS_H

#include "near.h"

static pdn_model *model;
static pdn_solution *solution;
static pdn_shell shell;
static pdn_section section;
static pdn_shell_section plate;
static pdn_signal signal;
static const double time_[1] = {0.3};
static double values[16];

static int32_t law(double time, double coordinate, double rate, double *effort, double *derivatives,
                   void *user_data)
{
    (void)time, (void)rate, (void)derivatives, (void)user_data;
    *effort = coordinate;
    return 0;
}

static int32_t forces(const pdn_force_state *state, pdn_force_values *out, void *user_data)
{
    (void)state, (void)out, (void)user_data;
    return 0;
}

static int32_t control(const pdn_controller_state *state, pdn_controller_values *out,
                       void *user_data)
{
    (void)user_data;
    out->efforts[0] = -state->states[0];
    out->state_rates[0] = state->inputs[0] - state->states[0];
    return 0;
}

static int32_t surface_forces(const pdn_surface_state *state, pdn_surface_values *out,
                              void *user_data)
{
    (void)state, (void)out, (void)user_data;
    return 0;
}

static pdn_status prescribe(const int32_t *v)
{
    return pdn_model_prescribe(model, v[0], v[1], &signal, NULL);
}

static pdn_status add_joint(const int32_t *v)
{
    const pdn_frame at = {{1, 0, 0}, {1, 0, 0, 0, 1, 0, 0, 0, 1}};
    int32_t joint;
    return pdn_model_add_joint(model, v[0], v[1], v[2], &at, &at, &joint);
}

static pdn_status add_load(const int32_t *v)
{
    return pdn_model_add_load(model, v[0], v[1], v[2], &signal, NULL);
}

static pdn_status add_load_at_point(const int32_t *v)
{
    return pdn_model_add_load_at_point(model, v[0], values, v[1], v[2], &signal, NULL);
}

static pdn_status add_load_on_beam(const int32_t *v)
{
    return pdn_model_add_load_on_beam(model, v[0], v[1], 0.5, NULL, v[2], v[3], &signal, NULL);
}

static pdn_status set_load_frame(const int32_t *v)
{
    return pdn_model_set_load_frame(model, v[0], v[1], NULL);
}

static pdn_status add_distributed_load(const int32_t *v)
{
    return pdn_model_add_distributed_load(model, v[0], v[1], v[2], v[3], &signal, NULL, NULL, 0,
                                          NULL);
}

static pdn_status add_shell_load(const int32_t *v)
{
    return pdn_model_add_shell_load(model, v[0], v[1], v[2], v[3], v[4], &signal, NULL);
}

static pdn_status add_spring_damper(const int32_t *v)
{
    return pdn_model_add_spring_damper(model, v[0], v[1], 1, 0, 0, NULL);
}

static pdn_status add_nonlinear(const int32_t *v)
{
    return pdn_model_add_nonlinear_spring_damper(model, v[0], v[1], time_, 1, NULL, 0, 0, NULL);
}

static pdn_status add_actuator(const int32_t *v)
{
    return pdn_model_add_actuator(model, v[0], v[1], &signal, NULL);
}

static pdn_status add_viscoelastic(const int32_t *v)
{
    return pdn_model_add_viscoelastic(model, v[0], v[1], 1, 0, time_, time_, 1, NULL);
}

static pdn_status add_bushing(const int32_t *v)
{
    const pdn_frame at = {{0, 0, 0}, {1, 0, 0, 0, 1, 0, 0, 0, 1}};
    const double none[36] = {0};
    return pdn_model_add_bushing(model, v[0], v[1], &at, &at, none, none, v[2], NULL);
}

static pdn_status add_coordinate_law(const int32_t *v)
{
    return pdn_model_add_coordinate_law(model, v[0], v[1], v[2], law, NULL, NULL, NULL);
}

static pdn_status add_user_force(const int32_t *v)
{
    const int32_t node = NODE(0);
    return pdn_model_add_user_force(model, &node, 1, v[0], v[1], forces, NULL, NULL, NULL);
}

static pdn_status move_number(const int32_t *v)
{
    return pdn_model_move_number(model, v[0], v[1], v[2], v[3], 1);
}

static pdn_status move_signal(const int32_t *v)
{
    return pdn_model_move_signal(model, v[0], v[1], v[2], v[3], 1);
}

static pdn_status force_number(const int32_t *v)
{
    return pdn_model_force_number(model, v[0], v[1], v[2], values);
}

static pdn_status sample_signal(const int32_t *v)
{
    return pdn_model_sample_signal(model, v[0], v[1], 2, time_, 1, values);
}

static pdn_status sample(const int32_t *v)
{
    return pdn_solution_sample(solution, PDN_QUANTITY(v[0], v[1], v[2]), time_, 1, values);
}

static pdn_status sample_in_frame(const int32_t *v)
{
    return pdn_solution_sample(
        solution, PDN_QUANTITY(v[0], v[1], PDN_ALL_COMPONENTS, .frame = v[2]), time_, 1, values);
}

static pdn_status force_on_node(const int32_t *v)
{
    return pdn_solution_sample(
        solution,
        PDN_QUANTITY(PDN_FORCE_ON_NODE, v[0], PDN_ALL_COMPONENTS, .node = v[1], .frame = v[2]),
        time_, 1, values);
}

static pdn_status harmonics(const int32_t *v)
{
    return pdn_solution_harmonics(solution, PDN_QUANTITY(v[0], v[1], PDN_ALL_COMPONENTS), 0, values,
                                  NULL, NULL, NULL);
}

static pdn_status filtered(const int32_t *v)
{
    pdn_solution *smooth = NULL;
    const pdn_status status = pdn_solution_filtered(solution, v[0], v[1], &smooth);
    pdn_solution_free(smooth);
    return status;
}

static pdn_status load_at_places(const int32_t *v)
{
    const double ends[2] = {0, 1};
    pdn_signal signals[12];
    int i;
    for (i = 0; i < 12; i++)
        signals[i] = signal;
    return pdn_model_add_load_at_places(model, v[0], v[1], v[2], NULL, ends, signals, 2, NULL);
}

static pdn_status surface_force(const int32_t *v)
{
    return pdn_model_add_surface_force(model, v[0], v[1], v[2], v[3], v[4], surface_forces, NULL,
                                       NULL, NULL);
}

static pdn_status line_force(const int32_t *v)
{
    return pdn_model_add_line_force(model, v[0], v[1], v[2], NULL, v[3], surface_forces, NULL, NULL,
                                    NULL);
}

static pdn_status rigid_edge(const int32_t *v)
{
    int32_t first, count;
    return pdn_model_add_rigid_edge(model, v[0], &shell, v[1], &first, &count);
}

static pdn_status prestress(const int32_t *v)
{
    return pdn_model_set_shell_prestress(model, v[0], v[1], values);
}

static pdn_status beam_section(const int32_t *v)
{
    return pdn_model_set_beam_section(model, v[0], v[1], &section);
}

static pdn_status beam_spin(const int32_t *v)
{
    return pdn_model_set_beam_spin(model, v[0], v[1], 0);
}

static pdn_status shell_section(const int32_t *v)
{
    return pdn_model_set_shell_section(model, v[0], v[1], &plate);
}

static pdn_status set_signal(const int32_t *v)
{
    return pdn_model_set_signal(model, v[0], v[1], &signal);
}

static pdn_status force_numbers(const int32_t *v)
{
    return pdn_model_set_force_numbers(model, v[0], v[1], time_, 1);
}

static pdn_status bind_controller(const int32_t *v)
{
    return pdn_model_bind_controller(model, v[0], v[1], control, NULL, NULL);
}

static pdn_status bind_law(const int32_t *v)
{
    return pdn_model_bind_coordinate_law(model, v[0], v[1], law, NULL, NULL);
}

static pdn_status bind_user_force(const int32_t *v)
{
    return pdn_model_bind_user_force(model, v[0], v[1], v[2], forces, NULL, NULL);
}

static pdn_status bind_surface_force(const int32_t *v)
{
    return pdn_model_bind_surface_force(model, v[0], v[1], v[2], v[3], surface_forces, NULL, NULL);
}

static pdn_status controller_coordinate(const int32_t *v)
{
    int32_t joint, coordinate;
    return pdn_model_controller_coordinate(model, v[0], v[1], &joint, &coordinate);
}

static pdn_status controller_state(const int32_t *v)
{
    return pdn_model_controller_state(model, v[0], v[1], values, values + 1);
}

static pdn_status force_node(const int32_t *v)
{
    int32_t node;
    return pdn_model_force_node(model, v[0], v[1], &node);
}

static pdn_status beam_element_node(const int32_t *v)
{
    int32_t node;
    return pdn_model_beam_element_node(model, v[0], v[1], &node);
}

static pdn_status shell_node(const int32_t *v)
{
    int32_t node;
    return pdn_model_shell_node(model, v[0], v[1], v[2], &node);
}

static pdn_status relation_term(const int32_t *v)
{
    int32_t joint, coordinate;
    return pdn_model_relation_term(model, v[0], v[1], &joint, &coordinate, values);
}

static pdn_status beam_load_factor(const int32_t *v)
{
    return pdn_model_beam_load_factor(model, v[0], v[1], values, values + 1);
}

static pdn_status condition(const int32_t *v)
{
    pdn_conditions *conditions;
    pdn_status status;
    CHECK_STATUS(pdn_conditions_new(&conditions), PDN_OK);
    status = pdn_conditions_add_joint_coordinate(conditions, v[0], v[1], 0);
    pdn_conditions_free(conditions);
    return status;
}

static pdn_status equations_end(const int32_t *v)
{
    pdn_equations *equations;
    pdn_solution *end = NULL;
    pdn_equations_options options;
    pdn_status status;
    PDN_INIT(pdn_equations_options, &options);
    options.grid_points = 3;
    CHECK_STATUS(pdn_equations_new(model, 2, &options, &equations), PDN_OK);
    status = pdn_equations_solution(equations, v[0], v[1], &end);
    pdn_solution_free(end);
    pdn_equations_free(equations);
    return status;
}

#endif
