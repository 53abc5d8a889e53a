// The same as program.c, by periodyn.hpp.
#include <periodyn.hpp>

#include <cmath>
#include <iostream>

int main()
{
    try {
        const double stiffness = 3, damping = 0.2, inertia = 0.5, omega = 1.5;
        const double real = stiffness - inertia * omega * omega, imaginary = damping * omega;
        const double expected = 0.6 * real / (real * real + imaginary * imaginary);

        std::cout << periodyn::build_info() << '\n';
        periodyn::Model model;
        const auto body = model.add_rigid_body(2, {0, 0, 0}, {0.4, 0, 0, 0, 0.4, 0, 0, 0, inertia});
        const auto hinge = model.add_revolute(periodyn::ground, body, {0, 0, 0}, {0, 0, 1});
        model.add_spring_damper(hinge, periodyn::Coordinate::rotation, stiffness, damping);
        model.add_load(body, periodyn::Frame::space, periodyn::Component::moment_3,
                       [=](double time) { return 0.6 * std::cos(omega * time); });
        const auto solution = periodyn::solve_periodic(model, 2 * std::acos(-1.0) / omega);
        const auto angle = solution.sample(
            {periodyn::Kind::joint_coordinate, hinge, periodyn::Coordinate::rotation}, {0})[0];
        std::cout << "angle at the start " << angle << ", expected " << expected << '\n';
        return solution.converged() && std::abs(angle - expected) < 1e-6 ? 0 : 1;
    } catch (const periodyn::error &failure) {
        std::cerr << failure.what() << '\n';
        return 1;
    }
}
