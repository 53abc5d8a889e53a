// Checks that hold in every build type, unlike assert.
#ifndef PDN_TEST_CHECK_HPP
#define PDN_TEST_CHECK_HPP

#include <periodyn.hpp>

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <limits>
#include <string>

namespace pdn = periodyn;

#define CHECK(condition)                                                                           \
    do {                                                                                           \
        if (!(condition)) {                                                                        \
            std::cerr << __FILE__ << ':' << __LINE__ << ": not so: " #condition "\n";              \
            std::exit(1);                                                                          \
        }                                                                                          \
    } while (0)

#define NEAR(a, b, tolerance) check_near((a), (b), (tolerance), #a, __LINE__)

inline void check_near(double a, double b, double tolerance, const char *what, int line)
{
    if (!(std::abs(a - b) <= tolerance)) {
        std::cerr << "line " << line << ": " << what << " is " << a << ", expected " << b << '\n';
        std::exit(1);
    }
}

// The statement throws periodyn::error with the status and a message that starts so.
#define REFUSED(statement, expected, start)                                                        \
    do {                                                                                           \
        try {                                                                                      \
            statement;                                                                             \
            std::cerr << "line " << __LINE__ << ": did not throw: " #statement "\n";               \
            std::exit(1);                                                                          \
        } catch (const pdn::error &refusal) {                                                      \
            const std::string message = refusal.what();                                            \
            if (refusal.status() != (expected) || message.rfind((start), 0) != 0) {                \
                std::cerr << "line " << __LINE__ << ": " #statement " threw "                      \
                          << pdn::status_name(refusal.status()) << ": " << message << '\n';        \
                std::exit(1);                                                                      \
            }                                                                                      \
        }                                                                                          \
    } while (0)

const double pi = std::acos(-1.0);
const double nan_value = std::numeric_limits<double>::quiet_NaN();
const double infinity = std::numeric_limits<double>::infinity();
const pdn::Matrix3 identity{1, 0, 0, 0, 1, 0, 0, 0, 1};
const pdn::Vector3 origin{0, 0, 0}, axis_1{1, 0, 0}, axis_2{0, 1, 0}, axis_3{0, 0, 1};
const pdn_frame at_origin{{0, 0, 0}, {1, 0, 0, 0, 1, 0, 0, 0, 1}};

// A torsional oscillator about axis 3: moment of inertia 0.5, stiffness 3, damping 0.2.
struct Oscillator {
    pdn::Model model;
    std::int32_t body, hinge, spring;

    Oscillator()
        : body(model.add_rigid_body(2, origin, {0.4, 0, 0, 0, 0.4, 0, 0, 0, 0.5})),
          hinge(model.add_revolute(pdn::ground, body, origin, axis_3)),
          spring(model.add_spring_damper(hinge, pdn::Coordinate::rotation, 3, 0.2))
    {
    }
};

const double omega = 1.5, period = 2 * pi / omega;

// Its angle under the moment 0.6 cos(omega t): real and imaginary part, for other stiffness too.
inline std::array<double, 2> oscillator_angle(double stiffness = 3, double damping = 0.2)
{
    const double real = stiffness - 0.5 * omega * omega, imaginary = damping * omega;
    const double square = real * real + imaginary * imaginary;
    return {0.6 * real / square, 0.6 * imaginary / square};
}

inline pdn::Section steel()
{
    return pdn::Section().set_diagonal({53e6, 17e6, 17e6, 730, 1130, 1130},
                                       {2, 85e-6, 43e-6, 43e-6});
}

#endif
