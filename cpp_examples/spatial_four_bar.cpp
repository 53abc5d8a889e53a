// The flexible spatial four-bar mechanism of Han and Bauchau, Nonlinear Dynamics 92 (2018),
// section 7.2.
//
// Rocker AB (revolute at A, spherical at B), coupler BC (universal at C) and crank CD, which a
// motor at D turns once in a period. Metres, newtons, kilograms, seconds.
//
//   spatial_four_bar [--grid N] [--elements E] [--order P] [--out FILE]
//
// FILE gets `t,x3_B,v3_B,torque_D` at 401 times from 0 to T: height and vertical velocity of B, and
// the torque of the motor. The same programs in C and Fortran print the same.

#include <periodyn.hpp>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <map>

namespace pdn = periodyn;
using Coordinate = pdn::Coordinate;

// Options of the command line, each with its value.
using Options = std::map<std::string, std::string>;

static Options read_options(int argc, char **argv)
{
    Options options{{"--grid", "21"}, {"--elements", "8"}, {"--order", "1"}, {"--out", ""}};
    for (int i = 1; i < argc; i += 2) {
        if (options.count(argv[i]) == 0 || i + 1 == argc) {
            std::cerr << "usage: " << argv[0]
                      << " [--grid N] [--elements E] [--order P] [--out FILE]\n";
            std::exit(2);
        }
        options[argv[i]] = argv[i + 1];
    }
    return options;
}

static int run(const Options &given)
{
    const std::size_t elements = std::stoul(given.at("--elements"));
    const std::size_t order = std::stoul(given.at("--order"));

    // The reference configuration, in which nothing is strained.
    const pdn::Vector3 A{-0.40, 0.00, 0.000}, B{-0.75, 0.00, 0.652};
    const pdn::Vector3 C{0.00, 0.85, 0.200}, D{0.00, 0.85, 0.000};
    const pdn::Vector3 i1{1, 0, 0}, i2{0, 1, 0};
    const pdn::Vector3 cross{0, 0.452, 0.85}; // i1 x BC: arm of the universal joint fixed to BC

    // Steel, 16 x 16 mm and 8 x 8 mm: [axial, shear, shear, torsion, bending, bending] stiffness;
    // mass and its moments of inertia [m, m11, m22, m33], for each unit of length.
    pdn::Section steel16, steel8;
    steel16.set_diagonal({52.99e6, 16.88e6, 16.88e6, 733.5, 1131, 1131},
                         {1.997, 85.20e-6, 42.60e-6, 42.60e-6});
    steel8.set_diagonal({13.25e6, 4.220e6, 4.220e6, 45.84, 70.66, 70.66},
                        {0.4992, 5.324e-6, 2.662e-6, 2.662e-6});

    pdn::Model model;
    const auto rocker = model.add_straight_beam(A, B, i2, steel16, elements, order);
    const auto coupler = model.add_straight_beam(B, C, i1, steel16, elements, order);
    const auto crank = model.add_straight_beam(C, D, i1, steel8, elements, order);

    const auto hinge_A = model.add_revolute(pdn::ground, rocker.first, A, i2);
    model.add_spherical(rocker.last, coupler.first, B);
    model.add_universal(coupler.last, crank.first, C, cross, i1);
    const auto motor_D = model.add_revolute(pdn::ground, crank.last, D, i1);

    model.add_spring_damper(hinge_A, Coordinate::rotation, 18.0);

    // theta(t) = 0.3 t + (1 - cos 0.3 t) / 3 + sin(0.6 t) / 10 + (1 - cos 0.9 t) / 21
    const double omega = 0.3, period = 20.943951023931954923; // 2 pi / omega
    model.prescribe(motor_D, Coordinate::rotation,
                    pdn::Signal().set_harmonics(1.0 / 3 + 1.0 / 21, omega, {-1.0 / 3, 0, -1.0 / 21},
                                                {0, 0.1, 0}));

    pdn::PeriodicOptions options;
    options.grid_points = std::stoul(given.at("--grid"));
    const auto solution = pdn::solve_periodic(model, period, options);
    std::cout << solution.report();
    if (!solution.converged()) {
        return 1;
    }

    std::vector<double> t(401);
    for (std::size_t i = 0; i < t.size(); ++i) {
        t[i] = period * static_cast<double>(i) / 400;
    }
    const auto position = solution.sample<3>({pdn::Kind::node_position, rocker.last}, t);
    const auto velocity = solution.sample<6>({pdn::Kind::node_velocity, rocker.last}, t);
    const auto torque =
        solution.sample({pdn::Kind::joint_driving_effort, motor_D, Coordinate::rotation}, t);

    const auto [lowest, highest] = std::minmax_element(torque.begin(), torque.end());
    std::printf("Torque of the motor: %.4f N m at %.3f T to %.4f N m at %.3f T\n", *lowest,
                t[static_cast<std::size_t>(lowest - torque.begin())] / period, *highest,
                t[static_cast<std::size_t>(highest - torque.begin())] / period);

    if (!given.at("--out").empty()) {
        std::ofstream file(given.at("--out"));
        file << "t,x3_B,v3_B,torque_D\n" << std::setprecision(17);
        for (std::size_t i = 0; i < t.size(); ++i) {
            file << t[i] << ',' << position[i][2] << ',' << velocity[i][2] << ',' << torque[i]
                 << '\n';
        }
        if (!file.flush()) {
            std::cerr << "cannot write " << given.at("--out") << '\n';
            return 1;
        }
    }
    return 0;
}

int main(int argc, char **argv)
{
    try {
        return run(read_options(argc, argv));
    } catch (const std::exception &failure) {
        std::cerr << failure.what() << '\n';
        return 1;
    }
}
