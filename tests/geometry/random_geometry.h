/// Seeded random values for the geometry tests.
#pragma once

#include "app/geometry/prop_shape.h"
#include "app/geometry/transform.h"

#include <cmath>
#include <random>

namespace frustumscreen::geometry {

class Random {
public:
    explicit Random(unsigned seed) : engine_(seed) {}

    double between(double low, double high) { return low + (high - low) * uniform(); }
    /// Uniform on a logarithmic scale.
    double scale(double low, double high) { return std::exp(between(std::log(low), std::log(high))); }
    glm::dvec3 vector(double reach) {
        return {between(-reach, reach), between(-reach, reach), between(-reach, reach)};
    }
    glm::dvec3 direction() {
        while (true) {
            const glm::dvec3 v = vector(1.0);
            if (glm::length(v) > 0.1 && glm::length(v) <= 1.0) {
                return glm::normalize(v);
            }
        }
    }
    glm::dquat rotation() {
        while (true) {
            const glm::dquat q(between(-1, 1), between(-1, 1), between(-1, 1), between(-1, 1));
            if (glm::length(q) > 0.1) {
                return glm::normalize(q);
            }
        }
    }
    FrustumSize prop() {
        const double base = between(0.05, 0.5);
        return {base, base * between(0.05, 0.95), between(0.05, 0.5)};
    }

private:
    double uniform() { return std::uniform_real_distribution<double>(0.0, 1.0)(engine_); }
    std::mt19937 engine_;
};

} // namespace frustumscreen::geometry
