#include <cmath>
#include <cstdio>
#include <periodyn.hpp>

namespace pdn = periodyn;
using Coordinate = pdn::Coordinate;

int main()
{
    // A motor turns the crank at 150 rad/s, a rod of steel pushes the piston against a damper.
    const double speed = 150, young = 210e9, shear = 81e9, density = 7850, width = 0.012;
    const double area = width * width, bending = area * area / 12;
    pdn::Section steel;
    steel.set_diagonal({young * area, shear * area * 5 / 6, shear * area * 5 / 6,
                        shear * 0.141 * area * area, young * bending, young * bending},
                       {density * area, 2 * density * bending, density * bending,
                        density * bending});
    steel.set_proportional_damping(1e-5);

    const pdn::Vector3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
    const pdn::Vector3 centre{0, 0, 0}, pin{0.1, 0, 0}, far{0.5, 0, 0};
    pdn::Model model;
    const auto crank = model.add_rigid_body(1.0, centre, {2e-3, 0, 0, 0, 2e-3, 0, 0, 0, 3e-3});
    const auto rod = model.add_straight_beam(pin, far, y, steel, 4, 3);
    const auto piston = model.add_rigid_body(0.6, far, {4e-4, 0, 0, 0, 4e-4, 0, 0, 0, 4e-4});
    const auto motor = model.add_revolute(pdn::ground, crank, centre, z);
    model.add_revolute(crank, rod.first, pin, z);
    model.add_revolute(rod.last, piston, far, z);
    const auto slide = model.add_prismatic(pdn::ground, piston, far, x);
    model.add_spring_damper(slide, Coordinate::displacement, 0, 20);
    model.prescribe(motor, Coordinate::rotation, pdn::Signal().set_harmonics(0, speed));

    const auto solution = pdn::solve_periodic(model, 2 * std::acos(-1.0) / speed);
    std::printf("converged: %s\n", solution.converged() ? "yes" : "no");
    const auto torque =
        solution.extremes({pdn::Kind::joint_driving_effort, motor, Coordinate::rotation});
    std::printf("torque of the motor: %.2f to %.2f N m\n", torque.smallest[0], torque.largest[0]);
    const auto in_middle = pdn::Quantity(pdn::Kind::beam_force, rod.first_element + 2)
                               .with_component(5)
                               .with_station(-1);
    const auto moment = solution.extremes(in_middle);
    std::printf("moment in the middle of the rod: %.2f to %.2f N m\n", moment.smallest[0],
                moment.largest[0]);
}
