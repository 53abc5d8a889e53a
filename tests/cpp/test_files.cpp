// Tables as CSV and animations.
#include "check.hpp"

#include <fstream>
#include <sstream>
#include <utility>

static std::string content(const std::string &path)
{
    std::ifstream file(path);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
}

int main()
{
    Oscillator o;
    o.model.add_load(o.body, pdn::Frame::space, pdn::Component::moment_3,
                     [](double t) { return 0.6 * std::cos(omega * t); });
    const auto solution = pdn::solve_periodic(o.model, period);

    pdn::Table table({0, 0.5, 1});
    table.add_quantity(solution, {pdn::Kind::joint_coordinate, o.hinge, pdn::Coordinate::rotation},
                       "angle");
    table.add_values("mine", {1, 2, 3});
    table.write_csv("own.csv");
    std::istringstream rows(content("own.csv"));
    std::string head;
    std::getline(rows, head);
    CHECK(head == "t,angle,mine");
    const auto angle = solution.sample(
        {pdn::Kind::joint_coordinate, o.hinge, pdn::Coordinate::rotation}, {0, 0.5, 1});
    for (std::size_t k = 0; k < 3; ++k) {
        double t, value, mine;
        char comma;
        CHECK(rows >> t >> comma >> value >> comma >> mine);
        CHECK(t == 0.5 * static_cast<double>(k) && value == angle[k] &&
              mine == static_cast<double>(k + 1));
    }

    const pdn::Quantity turn(pdn::Kind::joint_coordinate, o.hinge, pdn::Coordinate::rotation);
    CHECK(solution.sample(turn, {0, 0.5, 1}) == angle);
    const auto extremes = solution.extremes(turn);
    CHECK(extremes.smallest[0] < angle[1] && angle[1] < extremes.largest[0]);
    const auto waves = solution.harmonics(turn, 2);
    CHECK(waves.mean.size() == 1 && waves.cosines.size() == 2 && waves.rate[0] == 0);
    pdn::Quantity spin(pdn::Kind::node_velocity, o.body);
    CHECK(spin.component == pdn::all_components && solution.sample(spin, {0, 0.5}).size() == 12);
    spin.component = 6;
    REFUSED(solution.sample(spin, {0}), PDN_ERR_VALUE, "quantity: component: ");
    table.add_quantity(solution, turn, "turn");

    table.add_quantity(solution, {pdn::Kind::node_position, o.body});
    table.add_quantity(solution, {pdn::Kind::joint_reaction, o.hinge});
    table.add_quantity(solution,
                       pdn::Quantity(pdn::Kind::force_on_node, o.spring).with_node(o.body), "pull");
    table.write_csv("more.csv");
    const std::string more = content("more.csv");
    CHECK(more.find("node0.position.x") != std::string::npos);
    CHECK(more.find("joint0.") != std::string::npos && more.find("pull.") != std::string::npos);

    pdn::Model cantilever;
    const auto beam = cantilever.add_straight_beam(origin, axis_1, axis_2, steel(), 2, 1);
    cantilever.add_rigid_joint(pdn::ground, beam.first, origin);
    const auto bent = pdn::solve_static(cantilever);
    table.add_quantity(bent, {pdn::Kind::beam_force, beam.first_element}, "root");
    bent.write_vtk({0}, 3, "bent.pvd");
    CHECK(content("bent.pvd").find("VTKFile") != std::string::npos);

    // What is loaded is what was saved, and can be solved again.
    bent.save("bent.pdn");
    const pdn::Solution loaded = pdn::Solution::load("bent.pdn");
    CHECK(loaded.sample<3>({pdn::Kind::node_position, beam.last}, {0}) ==
          bent.sample<3>({pdn::Kind::node_position, beam.last}, {0}));
    CHECK(loaded.report() == bent.report());
    pdn::Model again = loaded.model();
    CHECK(again.element_count() == 2);
    again.add_load(beam.last, pdn::Frame::space, pdn::Component::force_3, 1.0);
    CHECK(pdn::solve_static(again).converged());
    // A copy of a model keeps the functions of its signals.
    CHECK(pdn::solve_periodic(solution.model(), period).converged());
    CHECK(!solution.model().kept().empty());

    const double none = std::numeric_limits<double>::quiet_NaN();
    REFUSED(pdn::Table({}), PDN_ERR_SIZE, "count: ");
    REFUSED(pdn::Table({none}), PDN_ERR_NOT_FINITE, "times");
    REFUSED(table.add_quantity(solution, {pdn::Kind::node_position, 4}, "x"), PDN_ERR_ID,
            "quantity.object: ");
    REFUSED(table.add_quantity(solution, {pdn::Kind::node_position, o.body}), PDN_ERR_VALUE,
            "label: ");
    REFUSED(table.add_quantity(solution,
                               {pdn::Kind::joint_rate, o.hinge, pdn::Coordinate::displacement}),
            PDN_ERR_NOT_AVAILABLE, "coordinate: ");
    REFUSED(table.add_quantity(solution, {pdn::Kind::joint_reaction, 5}), PDN_ERR_ID,
            "quantity.object: ");
    REFUSED(table.add_quantity(
                bent, pdn::Quantity(pdn::Kind::beam_force, beam.first_element).with_station(3)),
            PDN_ERR_VALUE, "station: ");
    REFUSED(table.add_quantity(solution, {pdn::Kind::force_effort, 8}), PDN_ERR_ID,
            "quantity.object: ");
    REFUSED(table.add_values("short", {1}), PDN_ERR_SIZE, "count: ");
    REFUSED(table.write_csv("no/such/place.csv"), PDN_ERR_IO, "path: ");
    REFUSED(bent.write_vtk({0}, 1, "bent.pvd"), PDN_ERR_SIZE, "points_per_element: ");
    REFUSED(bent.write_vtk({0}, 2, "bent.vtk"), PDN_ERR_VALUE, "path: ");

    REFUSED(pdn::Solution::load("nowhere.pdn"), PDN_ERR_IO, "path: ");
    REFUSED(pdn::Solution::load("own.csv"), PDN_ERR_FORMAT, "");
    REFUSED(bent.save("no/such/place.pdn"), PDN_ERR_IO, "path: ");
    pdn::Solution moved = pdn::Solution::load("bent.pdn"), target = std::move(moved);
    REFUSED(moved.save("bent.pdn"), PDN_ERR_NULL, "solution: ");
    REFUSED(moved.model(), PDN_ERR_NULL, "solution: ");

    pdn::Table other = std::move(table);
    REFUSED(table.write_csv("own.csv"), PDN_ERR_NULL, "table: ");
    other.write_csv("more.csv");
    CHECK(content("more.csv").find("root.axial") != std::string::npos);
    return 0;
}
