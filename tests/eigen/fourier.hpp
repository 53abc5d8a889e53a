// Trigonometric interpolation of a periodic function from an odd number of equispaced samples.
//
// Everything is a plain sum over complex harmonics. The cardinal functions (periodic sinc) never
// appear: the library under test uses them, and a reference should reach the same numbers by
// another road. Cost is of no concern here.

#pragma once

#include <Eigen/Dense>

#include <cmath>
#include <complex>
#include <stdexcept>

namespace reference {

constexpr double pi = 3.14159265358979323846;

// exp(2 pi i m / n), with m reduced first so that high harmonics lose no digits.
inline std::complex<double> root_of_unity(long m, long n) {
    const long reduced = ((m % n) + n) % n;
    return std::polar(1.0, 2.0 * pi * static_cast<double>(reduced) / static_cast<double>(n));
}

inline double grid_time(int k, int n, double period) { return period * k / n; }

// Interpolant of a vector-valued function; column k of the samples is its value at t_k = k T / N.
class TrigonometricInterpolant {
public:
    TrigonometricInterpolant(double period, const Eigen::MatrixXd &samples)
        : omega_(2.0 * pi / period), highest_(static_cast<int>(samples.cols() - 1) / 2) {
        const int n = static_cast<int>(samples.cols());
        if (n % 2 == 0) throw std::invalid_argument("the number of samples must be odd");
        if (!(period > 0.0)) throw std::invalid_argument("the period must be positive");
        coefficients_.setZero(samples.rows(), n);
        for (int j = -highest_; j <= highest_; ++j)
            for (int k = 0; k < n; ++k)
                coefficients_.col(j + highest_) +=
                    samples.col(k) * root_of_unity(-long(j) * k, n) / double(n);
    }

    // Value (derivative = 0) or time derivative of the given order at any time.
    Eigen::VectorXd at(double time, int derivative = 0) const {
        const std::complex<double> i(0.0, 1.0);
        Eigen::VectorXcd sum = Eigen::VectorXcd::Zero(coefficients_.rows());
        for (int j = -highest_; j <= highest_; ++j) {
            std::complex<double> factor = std::polar(1.0, j * omega_ * time);
            for (int d = 0; d < derivative; ++d) factor *= i * (j * omega_);
            sum += factor * coefficients_.col(j + highest_);
        }
        return sum.real();
    }

    // Complex amplitude of exp(i j Omega t), |j| <= (N - 1) / 2.
    Eigen::VectorXcd harmonic(int j) const { return coefficients_.col(j + highest_); }

private:
    double omega_;
    int highest_;
    Eigen::MatrixXcd coefficients_;
};

// Dense matrix that maps samples to the samples of the interpolant's derivative: D for order 1,
// T for order 2.
inline Eigen::MatrixXd differentiation_matrix(int n, double period, int order) {
    if (n < 1 || n % 2 == 0) throw std::invalid_argument("the number of grid points must be odd");
    const double omega = 2.0 * pi / period;
    const std::complex<double> i(0.0, 1.0);
    Eigen::MatrixXd matrix(n, n);
    for (int l = 0; l < n; ++l)
        for (int k = 0; k < n; ++k) {
            std::complex<double> sum = 0.0;
            for (int j = -(n - 1) / 2; j <= (n - 1) / 2; ++j) {
                std::complex<double> factor = 1.0;
                for (int d = 0; d < order; ++d) factor *= i * (j * omega);
                sum += factor * root_of_unity(long(j) * (l - k), n);
            }
            matrix(l, k) = sum.real() / n;
        }
    return matrix;
}

}  // namespace reference
