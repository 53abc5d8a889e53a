// Fourth-order central difference, to check derivatives with.

#pragma once

namespace reference {

// The error is about f''''' h^4 / 30 from truncation and eps |f| / h from rounding.
template <class Function>
auto central_difference(const Function &f, double h) {
    using Value = decltype(f(h));
    const Value p1 = f(h), m1 = f(-h), p2 = f(2 * h), m2 = f(-2 * h);
    return Value((8.0 * (p1 - m1) - (p2 - m2)) / (12.0 * h));
}

}  // namespace reference
