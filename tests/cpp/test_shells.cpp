// Shells over surfaces, points and cells; what a traction does to a strip is known.
#include "check.hpp"

#include <cmath>
#include <string>

namespace
{

constexpr double length = 2, width = 0.5, thickness = 0.02, young = 3e6;

double stretch_of(pdn::Model &model, std::int32_t first_clamped, std::int32_t loaded_element,
                  std::int32_t tip, const std::vector<std::int32_t> &clamped)
{
    CHECK(model.add_rigid_joints(pdn::ground, clamped).joints ==
          static_cast<std::int32_t>(clamped.size()));
    const double before = model.node_frame(tip).position[0];
    CHECK(model.node_frame(first_clamped).position[0] == 0);
    const auto load = model.add_shell_load(loaded_element, 1, pdn::ShellPlace::edge_end_xi,
                                           pdn::Frame::space, pdn::Component::force_1, 600.0);
    CHECK(load == pdn::first_shell_load && model.shell_load_count() == 1);
    CHECK(model.shell_load(load).first_element == loaded_element);
    CHECK(model.shell_load(load).place == pdn::ShellPlace::edge_end_xi);
    const auto solution = pdn::solve_static(model);
    CHECK(solution.converged());
    const auto stress = pdn::Quantity(pdn::Kind::shell_stress_top, loaded_element)
                            .with_station(0.5)
                            .with_direction({1, 0, 0});
    CHECK(stress.components() == 4);
    NEAR(solution.sample(stress, {0})[0], 600 / thickness, 1e-5);
    const auto force = pdn::Quantity(pdn::Kind::shell_resultant, loaded_element).with_station(0.5);
    NEAR(solution.sample(force, {0})[0], 600, 1e-7);
    const auto strain = pdn::Quantity(pdn::Kind::shell_strain, loaded_element).with_station(0.5);
    NEAR(solution.sample(strain, {0})[0], 600 / (young * thickness), 1e-12);
    return solution.sample<3>({pdn::Kind::node_position, tip}, {0})[0][0] - before;
}

std::vector<std::int32_t> start_of(const pdn::Model &model, const pdn_shell &shell)
{
    std::vector<std::int32_t> nodes;
    for (std::int32_t v = 0; v < shell.nodes_v; ++v) {
        nodes.push_back(model.shell_patch_node(shell, 0, v));
    }
    return nodes;
}

} // namespace

int main()
{
    pdn::ShellSection section;
    section.set_isotropic(thickness, young, 0.0, 1200);
    const double expected = 600 * length / (young * thickness);
    const auto rectangle =
        pdn::Surface().set_parallelogram({0, 0, 0}, {length, 0, 0}, {0, width, 0});

    // Over a surface, by a function, and over its points.
    const auto function = pdn::Surface().set_function(
        [](double u, double v) { return pdn::Vector3{length * u, width * v, 0}; });
    std::vector<pdn::Vector3> points;
    for (const pdn::Surface &surface : {rectangle, function}) {
        pdn::Model model;
        const auto shell = model.add_shell(surface, 2, 1, 2, 1, section);
        CHECK(shell.nodes_u == 5 && shell.nodes_v == 2 && model.shell_element_count() == 2);
        const auto tip = model.shell_patch_node(shell, 4, 0);
        CHECK(tip == model.shell_node(shell.first_element + 1, 2, 0));
        points.clear();
        for (std::int32_t u = 0; u < 5; ++u) {
            for (std::int32_t v = 0; v < 2; ++v) {
                const pdn_frame at = model.node_frame(model.shell_patch_node(shell, u, v));
                points.push_back({at.position[0], at.position[1], at.position[2]});
            }
        }
        const auto start = start_of(model, shell);
        NEAR(stretch_of(model, start[0], shell.first_element + 1, tip, start), expected, 1e-12);
    }
    {
        pdn::Model model;
        pdn::ShellPlacement placement;
        placement.frames = pdn::ShellFrames::parallel;
        const auto shell = model.add_shell_grid(points, 2, 1, 2, 1, section, true, placement);
        const auto start = start_of(model, shell);
        {
            // The same by the edge, of which a corner is held already.
            pdn::Model held = model.copy();
            CHECK(held.add_rigid_joints(pdn::ground, {start[0]}).first_joint == pdn::first_joint);
            const auto [first_joint, joints] =
                held.add_rigid_edge(pdn::ground, shell, pdn::ShellPlace::edge_start_xi);
            CHECK(first_joint == pdn::first_joint + 1 && joints == 1);
        }
        NEAR(stretch_of(model, start[0], pdn::first_shell_element + 1,
                        model.shell_patch_node(shell, 4, 1), start),
             expected, 1e-12);
    }
    {
        // A pressure by a function is the load; drag takes a velocity that there is not.
        const auto bent = [&](bool by_function) {
            pdn::Model model;
            const auto shell = model.add_shell(rectangle, 2, 1, 2, 1, section);
            model.add_rigid_edge(pdn::ground, shell, pdn::ShellPlace::edge_start_xi);
            if (by_function) {
                const auto first = model.add_surface_force(
                    pdn::first_shell_element + 1, 1, pdn::ShellPlace::surface, pdn::Frame::material,
                    pdn::Tangents::given,
                    [](const pdn::SurfaceState &state, pdn::SurfaceValues &values) {
                        double area = 0;
                        for (std::size_t k = 0; k < state.point_count; ++k) {
                            area += state.sizes(k);
                            CHECK(std::abs(state.places(1, k)) < 1 && state.positions(0, k) > 0);
                            values.forces(2, k) = 0.05 - 3 * state.velocities(2, k);
                            if (values.by_motion) {
                                CHECK(values.by_motion(2, 2, k) == 0);
                                values.by_velocity(2, 2, k) = -3;
                            }
                        }
                        CHECK(state.element == pdn::first_shell_element + 1 &&
                              state.rotations(8, 0) > 0);
                        NEAR(area, length * width / 2, 1e-14);
                    });
                CHECK(first == pdn::first_force && model.check_tangents(first, 1).error < 1e-7);
                CHECK(model.force(first).shell_element == pdn::first_shell_element + 1);
            } else {
                model.add_shell_load(pdn::first_shell_element + 1, 1, pdn::ShellPlace::surface,
                                     pdn::Frame::material, pdn::Component::force_3, 0.05);
            }
            const auto solution = pdn::solve_static(model);
            CHECK(solution.converged());
            return solution.sample<3>(
                {pdn::Kind::node_position, model.shell_patch_node(shell, 4, 0)}, {0})[0][2];
        };
        CHECK(bent(false) > 1e-3);
        NEAR(bent(true), bent(false), 1e-13);
    }
    {
        pdn::Model model;
        const std::vector<pdn::Vector3> corners = {
            {0, 0, 0}, {length, 0, 0}, {length, width, 0}, {0, width, 0}};
        const auto first = model.add_shell_quadrilaterals(corners, {0, 1, 2, 3}, 4, 2, section);
        const std::vector<std::int32_t> start = {model.shell_node(first, 0, 0),
                                                 model.shell_node(first, 0, 1),
                                                 model.shell_node(first, 0, 2)};
        NEAR(stretch_of(model, start[0], first, model.shell_node(first, 2, 1), start), expected,
             1e-12);
    }

    // Over nodes that are there; other surfaces; damping.
    {
        pdn::Model model;
        const pdn::Matrix3 turn = {1, 0, 0, 0, 1, 0, 0, 0, 1};
        std::vector<std::int32_t> nodes;
        for (const double x : {0.0, length}) {
            for (const double y : {0.0, width}) {
                nodes.push_back(model.add_node({x, y, 0}, turn));
            }
        }
        CHECK(model.add_shell_element(nodes, 2, section) == pdn::first_shell_element);
        model.set_shell_prestress(pdn::first_shell_element, 1, {1, 0, 0, 0, 0, 0, 0, 1});
        const double pi = 3.14159265358979323846, per_area = 1200 * thickness;
        NEAR(model.mass().mass, per_area * length * width, 1e-12);
        model.add_shell(pdn::Surface().set_annulus({0, 0, 1}, {0, 0, 1}, {1, 0, 0}, 0.5, 1, 2 * pi),
                        1, 8, 2, 6, section);
        NEAR(model.mass().mass, per_area * (length * width + 0.75 * pi), 1e-8);
        model.add_shell(pdn::Surface().set_cylinder({0, 0, 1}, {0, 0, 1}, {1, 0, 0}, 1, 2, 2 * pi),
                        8, 1, 6, 2, section);
        NEAR(model.mass().mass, per_area * (length * width + 4.75 * pi), 1e-8);
        section.set_proportional_damping(0.5);
        CHECK(section.damping[0] == 0.5 * section.stiffness[0]);
    }

    // What surfaces throw comes out.
    pdn::Model model;
    try {
        model.add_shell(pdn::Surface().set_function([](double, double) -> pdn::Vector3 {
            throw std::domain_error("no such surface");
        }),
                        1, 1, 1, 1, section);
        std::exit(1);
    } catch (const std::domain_error &e) {
        CHECK(e.what() == std::string("no such surface"));
    }
    try {
        pdn::Surface().set_cylinder({0, 0, NAN}, {0, 0, 1}, {1, 0, 0}, 1, 2, 1);
        std::exit(1);
    } catch (const pdn::error &e) {
        CHECK(std::string(e.what()).find("centre[2]: expected a finite number") == 0);
    }
    CHECK(model.node_count() == 0);
    return 0;
}
