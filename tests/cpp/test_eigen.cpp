// Views of Eigen, of what periodyn.hpp takes and gives.
#include <Eigen/Dense>

#include "check.hpp"

int main()
{
    const Eigen::Vector3d point(1, 2, 3);
    const Eigen::Matrix3d turn(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ()));
    pdn::Model model;
    const auto node = model.add_node(pdn::array(point), pdn::array(turn));
    model.add_mass(node, 1, pdn::array(point + Eigen::Vector3d::UnitX()));
    const auto frame = model.node_frame(node);
    CHECK(Eigen::Map<const Eigen::Vector3d>(frame.position) == point);
    pdn::Matrix3 rotation;
    std::copy(std::begin(frame.rotation), std::end(frame.rotation), rotation.begin());
    CHECK((pdn::view(rotation) - turn).norm() < 1e-15);
    CHECK(pdn::array(Eigen::RowVector3d(4, 5, 6)) == (pdn::Vector3{4, 5, 6}));

    Oscillator o;
    o.model.add_load(o.body, pdn::Frame::space, pdn::Component::moment_3,
                     [](double t) { return 0.6 * std::cos(omega * t); });
    pdn::PeriodicOptions options;
    options.grid_points = 31;
    const auto solution = pdn::solve_periodic(o.model, period, options);
    const auto times = solution.grid_times();
    const auto velocity = solution.sample<6>({pdn::Kind::node_velocity, o.body}, times);
    const auto rate =
        solution.sample({pdn::Kind::joint_rate, o.hinge, pdn::Coordinate::rotation}, times);
    CHECK(pdn::view(velocity).cols() == 31 && pdn::view(velocity).rows() == 6);
    CHECK((pdn::view(velocity).row(5).transpose() - pdn::view(rate)).norm() < 1e-12);
    CHECK(pdn::view(rate).norm() > 0.1);
    return 0;
}
