// The equations below the solve: Newton's method of the test's own against the closed form of a
// forced oscillator; transposed products, the pencil, states, and what is refused.
#include "check.hpp"

#include <algorithm>
#include <functional>

using Vector = std::vector<double>;

static double dot(const Vector &x, const Vector &y)
{
    double sum = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        sum += x[i] * y[i];
    }
    return sum;
}

static Vector wave(std::size_t size, double rate)
{
    Vector x(size);
    for (std::size_t i = 0; i < size; ++i) {
        x[i] = std::sin(rate * static_cast<double>(i) + 0.2);
    }
    return x;
}

// Solves J x = b with the preconditioner alone, again and again.
static Vector solve(pdn::Equations &equations, const Vector &b)
{
    Vector x(b.size(), 0.0), rest = b;
    for (int i = 0; i < 60; ++i) {
        const Vector correction = equations.precondition(rest);
        for (std::size_t j = 0; j < x.size(); ++j) {
            x[j] += correction[j];
        }
        const Vector product = equations.product(x);
        for (std::size_t j = 0; j < x.size(); ++j) {
            rest[j] = b[j] - product[j];
        }
    }
    return x;
}

int main()
{
    Oscillator o;
    o.model.add_load(o.body, pdn::Frame::space, pdn::Component::moment_3,
                     pdn::Signal().set_harmonics(0, 0, {0.6}, {0}));
    pdn::EquationsOptions options;
    options.grid_points = 21;
    options.preconditioner = pdn::Linear::body_circulant;
    pdn::Equations equations(o.model, period, options);
    const pdn_equations_sizes sizes = equations.sizes();
    CHECK(sizes.size == sizes.total && sizes.nodes == 1 && sizes.halo == 0);
    CHECK(equations.nodes() == std::vector<std::int32_t>{o.body});
    CHECK(equations.numbers().size() == sizes.size && equations.numbers()[5] == 5);

    pdn::EquationsNorms norms{1, 1};
    for (int step = 0; step < 8 && norms.motion > 1e-10; ++step) {
        equations.linearise();
        Vector right = equations.residual();
        std::transform(right.begin(), right.end(), right.begin(), std::negate<double>());
        CHECK(equations.factor(right));
        const Vector increment = solve(equations, right);
        CHECK(!equations.compliance(increment).compliant);
        norms = equations.norms(increment);
        equations.update(increment);
    }
    CHECK(norms.motion <= 1e-10);
    const auto solution = equations.solution(pdn::Outcome::converged);
    CHECK(solution && solution->converged());
    NEAR(
        solution->sample({pdn::Kind::joint_coordinate, o.hinge, pdn::Coordinate::rotation}, {0})[0],
        oscillator_angle()[0], 1e-9);

    const Vector x = wave(sizes.size, 0.37), y = wave(sizes.size, 0.23);
    NEAR(dot(y, equations.product(x)), dot(equations.transposed_product(y), x), 1e-11);
    CHECK(dot(equations.power_product(2, x), equations.power_product(2, x)) > 0);
    CHECK(dot(equations.power_product(1, x), equations.power_product(1, x)) > 0);
    REFUSED(equations.power_product(3, x), PDN_ERR_VALUE, "power: expected 1 or 2");

    auto [motions, own] = equations.state();
    const Vector residual = equations.residual();
    equations.set_state(motions, own);
    const Vector again = equations.residual();
    for (std::size_t i = 0; i < again.size(); ++i) {
        NEAR(again[i], residual[i], 1e-12);
    }
    motions[4] += 0.5;
    REFUSED(equations.set_state(motions, own), PDN_ERR_VALUE, "motions[3]: expected a rotation");
    options.owners = {0, 0};
    REFUSED(pdn::Equations(o.model, period, options), PDN_ERR_SIZE, "owners: ");
    return 0;
}
