// Cells that move: springs in closed form, curves, the player, and a deep tree.

#include "app/bench/stability/sweep.h"
#include "app/bench/stability/themes.h"
#include "app/world/curve.h"
#include "app/world/player.h"
#include "app/world/spring.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace frustumscreen::bench {

namespace {

using Real = long double;
using world::Motion;
using world::SpringLaw;

constexpr double eps = 0x1p-52;
constexpr double day_s = 86'400.0;

struct ExactMotion {
    Real x = 0, v = 0;
};

/// From the roots of the characteristic polynomial, as a textbook has it; near critical damping, where these lose their
/// digits, from a series in their difference.
ExactMotion exact_after(const SpringLaw& law, const ExactMotion& start, Real t) {
    const Real b = static_cast<Real>(law.damping_per_s) / 2;
    const Real k = law.stiffness_per_s2;
    const Real square = b * b - k;
    const Real decay = std::exp(-b * t);
    const Real q = square * t * t;
    if (std::abs(q) < 1e-3L) {
        const Real c = decay * (1 + q / 2 * (1 + q / 12 * (1 + q / 30 * (1 + q / 56))));
        const Real s = decay * t * (1 + q / 6 * (1 + q / 20 * (1 + q / 42 * (1 + q / 72))));
        return {start.x * c + (start.v + b * start.x) * s, start.v * c - (k * start.x + b * start.v) * s};
    }
    const Real w = std::sqrt(std::abs(square));
    if (square < 0) {
        const Real c = decay * std::cos(w * t);
        const Real s = decay * std::sin(w * t) / w;
        return {start.x * c + (start.v + b * start.x) * s, start.v * c - (k * start.x + b * start.v) * s};
    }
    const Real fast = -b - w;
    const Real slow = k / fast;
    const Real of_slow = (start.v - fast * start.x) / (slow - fast);
    const Real of_fast = start.x - of_slow;
    return {of_slow * std::exp(slow * t) + of_fast * std::exp(fast * t),
            of_slow * slow * std::exp(slow * t) + of_fast * fast * std::exp(fast * t)};
}

/// Distance of two motions in place and speed, as a share of the swing at the start. A speed counts as the swing that it makes.
double off(const SpringLaw& law, const Motion& start, const Motion& seen, const ExactMotion& exact) {
    const double rate = std::sqrt(law.stiffness_per_s2);
    return std::fmax(static_cast<double>(std::abs(seen.x - exact.x)),
                     static_cast<double>(std::abs(seen.v - exact.v)) / rate) /
           world::swing_of(law, start);
}

constexpr std::array damping_ratios{0.0, 1e-3, 0.1, 0.9, 1.0, 1.1, 10.0, 1e3};

SpringLaw law_of(double stiffness, double ratio) {
    return {stiffness, 2.0 * ratio * std::sqrt(stiffness)};
}

/// An argument of sine that is rounded shifts the phase by as much, so the error may grow with the number of swings.
StabilityResult one_step(const StabilityOptions&) {
    double worst = 0.0;
    double grows = 0.0;
    for (const double stiffness : sweep(1e-3, 1e9, 4)) {
        for (const double ratio : damping_ratios) {
            const SpringLaw law = law_of(stiffness, ratio);
            const Motion start{1.0, -0.5 * std::sqrt(stiffness)};
            for (const double t : sweep(1e-6, 10.0, 8)) {
                const Motion seen = world::motion_after(law, start, t);
                const double phase = ratio < 1.0 ? std::sqrt(stiffness) * t : 0.0;
                const ExactMotion exact = exact_after(law, {start.x, start.v}, t);
                worst = std::fmax(worst, off(law, start, seen, exact) / (1.0 + 0.25 * phase));
                grows +=
                    world::swing_of(law, seen) > world::swing_of(law, start) * (1.0 + 4 * eps) ? 1.0 : 0.0;
            }
        }
    }
    return {{{"off the exact motion, of its swing and a quarter of the phase", 4 * eps, worst},
             {"swings that grow", 0.0, grows}}};
}

/// The way over 10 s, or 1000 steps if that is less.
StabilityResult many_steps(const StabilityOptions&) {
    double worst = 0.0;
    double grows = 0.0;
    for (const double stiffness : sweep(1e-3, 1e9, 1)) {
        for (const double ratio : damping_ratios) {
            const SpringLaw law = law_of(stiffness, ratio);
            const Motion start{1.0, 0.0};
            for (const double step : sweep(1e-6, 10.0, 2)) {
                const int count = static_cast<int>(std::clamp(10.0 / step, 1.0, 1000.0));
                Motion at = start;
                for (int k = 0; k < count; ++k) {
                    const double before = world::swing_of(law, at);
                    at = world::motion_after(law, at, step);
                    grows += world::swing_of(law, at) > before * (1.0 + 4 * eps) ? 1.0 : 0.0;
                }
                const double phase = ratio < 1.0 ? std::sqrt(stiffness) * step : 0.0;
                const ExactMotion exact =
                    exact_after(law, {start.x, start.v}, static_cast<Real>(step) * count);
                worst = std::fmax(worst, off(law, start, at, exact) / (count * (1.0 + 0.25 * phase)));
            }
        }
    }
    return {{{"off the exact motion, each step, of its swing and a quarter of the phase", 4 * eps, worst},
             {"swings that grow", 0.0, grows}}};
}

/// A stiffness of 4^n has an exact root, so its damping is critical to the last bit.
StabilityResult critical(const StabilityOptions&) {
    double on_spot = 0.0;
    double beside = 0.0;
    for (int n = -5; n <= 15; ++n) {
        const double w = std::ldexp(1.0, n);
        for (const double own_time : sweep(1e-6, 1e2, 8)) {
            const double t = own_time / w;
            const Motion start{1.0, 0.5 * w};
            const Motion spot = world::motion_after({w * w, 2.0 * w}, start, t);
            const Real wt = static_cast<Real>(w) * t;
            const Real exact = (1 + 1.5L * wt) * std::exp(-wt); // x + (v + w x) t
            on_spot = std::fmax(on_spot, static_cast<double>(std::abs(spot.x - exact)));
            for (const double away : sweep(1e-17, 1e-2, 1)) {
                for (const double side : {-away, away}) {
                    const SpringLaw law{w * w, 2.0 * w * (1.0 + side)};
                    beside = std::fmax(beside, off(law, start, world::motion_after(law, start, t),
                                                   exact_after(law, {start.x, start.v}, t)));
                }
            }
        }
    }
    return {{{"on the spot: off (1 + w t) exp(-w t)", 2 * eps, on_spot},
             {"1e-17 to 0.01 beside it: off the exact motion, of its swing", 2 * eps, beside}}};
}

MonotonicTime at_seconds(double seconds) {
    return MonotonicTime(Nanoseconds(std::llround(seconds * 1e9)));
}

std::vector<world::Cell> one_cell() {
    std::vector<world::Cell> cells(1);
    cells[0].has_geometry = true;
    return cells;
}

world::Behaviour loop_of(double seconds) {
    world::Behaviour loop{.name = "loop", .seconds = seconds, .repeats = true};
    world::Curve curve;
    for (int k = 0; k <= 20; ++k) {
        curve.times_s.push_back(static_cast<float>(seconds * k / 20.0));
        curve.values.emplace_back(std::cos(0.3 * k), std::sin(0.7 * k), 0.0, 0.0);
    }
    loop.channels.push_back({.cell = 0, .path = world::Path::Translation, .curve = curve});
    return loop;
}

world::Behaviour swing_of_stiffness(double stiffness) {
    world::Behaviour behaviour{.name = "swing", .stays = true};
    behaviour.springs.push_back({.cell = 0,
                                 .axis = {1.0, 0.0, 0.0},
                                 .reach = 1.0,
                                 .stiffness_per_s2 = stiffness,
                                 .damping_per_s = 0.0});
    return behaviour;
}

/// A loop and an undamped spring, looked at in steps and at the day's end.
StabilityResult a_day(const StabilityOptions&) {
    double loops = 0.0;
    double steps = 0.0;
    double drift = 0.0;
    for (const double stiffness : {1e-3, 1.0, 1e3, 1e6, 1e9}) {
        world::Player once(one_cell(), {swing_of_stiffness(stiffness)});
        once.start(0, at_seconds(0.0));
        const double x = once.step(at_seconds(day_s))[0].box_from_geometry[3].x;
        const Real phase = std::sqrt(static_cast<Real>(stiffness)) * day_s;
        drift = std::fmax(drift, static_cast<double>(std::abs(x - (1 - std::cos(phase))) / (1 + phase)));
        for (const double step : {0.25, 1.0, 10.0}) {
            world::Player often(one_cell(), {swing_of_stiffness(stiffness)});
            often.start(0, at_seconds(0.0));
            for (int k = 1; k < static_cast<int>(day_s / step); ++k) {
                (void)often.step(at_seconds(step * k));
            }
            steps += often.step(at_seconds(day_s))[0].box_from_geometry[3].x == x ? 0.0 : 1.0;
        }
    }
    for (const double seconds : {1.0, 0.1, 7.0}) {
        world::Player player(one_cell(), {loop_of(seconds)});
        player.start(0, at_seconds(0.0));
        const std::int64_t whole = std::llround(day_s / seconds);
        for (const double into : {0.0, 0.2, 0.5, 0.999}) {
            const auto length = Nanoseconds(std::llround(seconds * 1e9));
            const MonotonicTime first = at_seconds(into * seconds);
            const glm::dmat4 begin = player.step(first)[0].box_from_geometry;
            world::Player later(one_cell(), {loop_of(seconds)});
            later.start(0, at_seconds(0.0));
            loops += later.step(first + whole * length)[0].box_from_geometry == begin ? 0.0 : 1.0;
        }
    }
    return {{{"undamped, stiffness 1e-3 to 1e9: off the exact swing, of its phase", 2 * eps, drift},
             {"in steps of 0.25, 1 and 10 s: other than in one step", 0.0, steps},
             {"loops of 0.1, 1 and 7 s: other than in the first round", 0.0, loops}}};
}

/// Component `i` of a curve between keys k and k + 1, by the formulas of glTF, appendix C, in long double.
Real exact_value(const world::Curve& curve, std::size_t k, int i, double seconds) {
    const Real begin = curve.times_s[k];
    const Real interval = curve.times_s[k + 1] - begin;
    const Real t = (seconds - begin) / interval;
    if (curve.interpolation == world::Interpolation::Linear) {
        return (1 - t) * curve.values[k][i] + t * curve.values[k + 1][i];
    }
    return (2 * t * t * t - 3 * t * t + 1) * curve.values[3 * k + 1][i] +
           interval * (t * t * t - 2 * t * t + t) * curve.values[3 * k + 2][i] +
           (3 * t * t - 2 * t * t * t) * curve.values[3 * k + 4][i] +
           interval * (t * t * t - t * t) * curve.values[3 * k + 3][i];
}

/// Keys a nanosecond to a thousand seconds apart; tangents as steep as the values are apart.
StabilityResult curves(const StabilityOptions&) {
    std::mt19937 random(12);
    std::uniform_real_distribution<float> number(-1.0F, 1.0F);
    double off_value = 0.0;
    double off_unit = 0.0;
    double outside = 0.0;
    for (const double apart : sweep(1e-9, 1e3, 1)) {
        for (const bool spline : {false, true}) {
            world::Curve curve{.interpolation =
                                   spline ? world::Interpolation::CubicSpline : world::Interpolation::Linear,
                               .times_s = {},
                               .values = {}};
            for (int k = 0; k < 8; ++k) {
                curve.times_s.push_back(static_cast<float>(apart * k));
                for (int part = 0; part < (spline ? 3 : 1); ++part) {
                    const float steep = spline && part != 1 ? static_cast<float>(1.0 / apart) : 1.0F;
                    curve.values.push_back(
                        steep * glm::vec4(number(random), number(random), number(random), number(random)));
                }
            }
            for (int j = 0; j < 700; ++j) {
                const double seconds = apart * 0.01 * j;
                const auto after = std::upper_bound(curve.times_s.begin(), curve.times_s.end(), seconds);
                const std::size_t k = std::min<std::ptrdiff_t>(after - curve.times_s.begin(), 7) - 1;
                const glm::dvec4 value = world::value_at(curve, world::Path::Translation, seconds);
                for (int i = 0; i < 3; ++i) {
                    off_value = std::fmax(off_value, static_cast<double>(std::abs(
                                                         value[i] - exact_value(curve, k, i, seconds))));
                }
                const glm::dvec4 rotation = world::value_at(curve, world::Path::Rotation, seconds);
                off_unit = std::fmax(off_unit, std::abs(glm::length(rotation) - 1.0));
            }
            const auto value = [&](double t) { return world::value_at(curve, world::Path::Scale, t); };
            const glm::dvec4 first(curve.values[spline ? 1 : 0]);
            const glm::dvec4 last(curve.values[spline ? 22 : 7]);
            for (const double before : {-1e300, -1e-9, 0.0}) {
                outside += value(before) == first ? 0.0 : 1.0;
            }
            for (const double later : {8.0 * apart, 1e300}) {
                outside += value(later) == last ? 0.0 : 1.0;
            }
            curve.times_s.resize(1); // one key
            curve.values.resize(spline ? 3 : 1);
            for (const double any : {-1.0, 0.0, 1e-9, 1e300}) {
                outside += value(any) == first ? 0.0 : 1.0;
            }
        }
    }
    return {{{"keys 1 ns to 1000 s apart: off the formulas, of the largest value", 8 * eps, off_value},
             {"rotations off unit", 2 * eps, off_unit},
             {"before, after, of one key: other than that key", 0.0, outside}}};
}

/// A tree of the greatest depth, each cell turned at random and as long as the others.
StabilityResult deep_tree(const StabilityOptions&) {
    std::mt19937 random(5);
    std::normal_distribution<double> normal;
    std::vector<world::Cell> cells(world::max_cells);
    std::array<std::array<Real, 4>, 3> exact{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
    double worst = 0.0;
    for (std::size_t k = 0; k < cells.size(); ++k) {
        world::LocalPose& rest = cells[k].rest;
        rest.rotation =
            glm::normalize(glm::dquat(normal(random), normal(random), normal(random), normal(random)));
        rest.translation = {normal(random), normal(random), normal(random)};
        if (k > 0) {
            cells[k].parent = k - 1;
        }
        const glm::dmat4 local = rest.matrix();
        std::array<std::array<Real, 4>, 3> next{};
        for (std::size_t row = 0; row < 3; ++row) {
            for (std::size_t column = 0; column < 4; ++column) {
                next[row][column] = column == 3 ? exact[row][3] : 0;
                for (std::size_t i = 0; i < 3; ++i) {
                    next[row][column] += exact[row][i] * local[static_cast<int>(column)][static_cast<int>(i)];
                }
            }
        }
        exact = next;
    }
    const std::vector<world::CellPose> poses = world::poses_at_rest(cells);
    const glm::dmat4& seen = poses.back().box_from_geometry;
    for (std::size_t row = 0; row < 3; ++row) {
        for (std::size_t column = 0; column < 4; ++column) {
            const Real difference =
                seen[static_cast<int>(column)][static_cast<int>(row)] - exact[row][column];
            worst = std::fmax(worst, static_cast<double>(std::abs(difference)));
        }
    }
    // Each of 256 products rounds a place that is some sqrt(256) cells away, with a sign of its own: a random walk.
    constexpr double way = 16.0;
    constexpr double roundings = 16.0;
    return {{{"256 cells deep: a matrix off, cells' lengths", way * roundings * 0.5 * eps, worst}}};
}

} // namespace

std::vector<StabilityCase> motion_cases() {
    const std::string theme = "motion";
    return {
        {theme, "springs, stiffness 1e-3 to 1e9, a step of 1 us to 10 s", FloatingPoint::Strict, one_step},
        {theme, "the same in many steps", FloatingPoint::Strict, many_steps},
        {theme, "critical damping", FloatingPoint::Strict, critical},
        {theme, "24 hours", FloatingPoint::Strict, a_day},
        {theme, "curves", FloatingPoint::Strict, curves},
        {theme, "a deep tree", FloatingPoint::Strict, deep_tree}};
}

} // namespace frustumscreen::bench
