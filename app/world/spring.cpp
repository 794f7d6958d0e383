#include "app/world/spring.h"

#include <cmath>

namespace frustumscreen::world {

namespace {

/// w^2 of spring.h, rounded once: near critical damping it is a small difference.
double square_of_rate(const SpringLaw& law) {
    const double b = 0.5 * law.damping_per_s;
    return std::fma(b, b, -law.stiffness_per_s2);
}

/// sin(x) / x, by its series near 0.
double sinc(double x) {
    const double x2 = x * x;
    return x2 < 1e-4 ? 1.0 - x2 / 6.0 * (1.0 - x2 / 20.0 * (1.0 - x2 / 42.0)) : std::sin(x) / x;
}

/// (1 - exp(-x)) / x for 0 and more, by its series near 0.
double mean_decay(double x) {
    return x < 1e-4 ? 1.0 - x / 2.0 * (1.0 - x / 3.0 * (1.0 - x / 4.0)) : -std::expm1(-x) / x;
}

struct Terms {
    double c = 1.0, s = 0.0; ///< C and S of spring.h
};

Terms terms_of(const SpringLaw& law, double t) {
    const double b = 0.5 * law.damping_per_s;
    const double square = square_of_rate(law);
    if (square <= 0.0) {
        const double w = std::sqrt(-square);
        const double decay = std::exp(-b * t);
        return {decay * std::cos(w * t), decay * t * sinc(w * t)};
    }
    const double w = std::sqrt(square);
    // exp(-(b - w) t) and exp(-(b + w) t), without the difference b - w, whose digits are lost far above critical.
    const double slow = std::exp(-law.stiffness_per_s2 / (b + w) * t);
    const double fast = std::exp(-(b + w) * t);
    return {0.5 * (slow + fast), slow * t * mean_decay(2.0 * w * t)};
}

} // namespace

Motion motion_after(const SpringLaw& law, const Motion& motion, double seconds) {
    if (!(seconds > 0.0)) {
        return motion;
    }
    const double b = 0.5 * law.damping_per_s;
    const auto [c, s] = terms_of(law, seconds);
    return {motion.x * c + (motion.v + b * motion.x) * s,
            motion.v * c - (law.stiffness_per_s2 * motion.x + b * motion.v) * s};
}

double swing_of(const SpringLaw& law, const Motion& motion) {
    return std::hypot(motion.x, motion.v / std::sqrt(law.stiffness_per_s2));
}

double speed_to_reach(const SpringLaw& law, double x) {
    // The first swing ends where v is 0: at w t = atan2(w, b) below critical damping and w t = asinh(w / sqrt(stiffness))
    // above it. There x = speed / sqrt(stiffness) exp(-b t).
    const double b = 0.5 * law.damping_per_s;
    const double square = square_of_rate(law);
    const double w = std::sqrt(std::abs(square));
    const double root = std::sqrt(law.stiffness_per_s2);
    double t = 1.0 / root;
    if (square < 0.0) {
        t = std::atan2(w, b) / w;
    } else if (square > 0.0) {
        t = std::asinh(w / root) / w;
    }
    return x * root * std::exp(b * t);
}

} // namespace frustumscreen::world
