#include <cmath>
#include <cstdio>
#include <periodyn.hpp>

namespace pdn = periodyn;

int main()
{
    // Metres, kilograms, seconds. Below its hinge hangs a bar of 1 m and 2 kg.
    const double pi = std::acos(-1.0);
    pdn::Model model;
    model.set_gravity({0, 0, -9.81});
    const auto bar = model.add_rigid_body(2.0, {0, 0, -0.5},
                                          {1.0 / 6, 0, 0, 0, 1.0 / 6, 0, 0, 0, 0.001});
    const auto hinge = model.add_revolute(pdn::ground, bar, {0, 0, 0}, {0, 1, 0});
    model.add_spring_damper(hinge, pdn::Coordinate::rotation, 0, 0.5);

    // A motor at the hinge pushes it to and fro, by 1.5 N m at 3 rad/s.
    model.add_actuator(hinge, pdn::Coordinate::rotation,
                       pdn::Signal().set_harmonics(0, 0, {1.5}, {0}));

    const auto solution = pdn::solve_periodic(model, 2 * pi / 3);
    std::printf("converged: %s\n", solution.converged() ? "yes" : "no");
    const auto angle =
        solution.extremes({pdn::Kind::joint_coordinate, hinge, pdn::Coordinate::rotation});
    std::printf("it swings to %.3f degrees, at %.3f s\n", angle.largest[0] * 180 / pi,
                angle.time_of_largest[0]);
}
