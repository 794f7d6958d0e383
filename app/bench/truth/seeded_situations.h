/// Situations from a seed: a frustum as visitors leave it on a table, a cube in a hand; and people who follow
/// advice imprecisely.
///
/// Frames   table T, metres, radians.
/// Threads  values; any.
#pragma once

#include "app/guidance/advise.h"
#include "app/settings/settings.h"

#include <cstdint>
#include <random>

namespace frustumscreen::bench {

class Seeded {
public:
    explicit Seeded(std::uint64_t seed) : generator_(seed) {}
    double between(double low, double high) { return low + (high - low) * share_(generator_); }
    double normal() { return normal_(generator_); }
    bool happens(double probability) { return share_(generator_) < probability; }

private:
    std::mt19937_64 generator_;
    std::uniform_real_distribution<double> share_{0.0, 1.0};
    std::normal_distribution<double> normal_;
};

/// A small cube under a low projector, as in config/cube.toml.
[[nodiscard]] settings::Settings cube_in_hand();

/// A prop as left by a visitor: on the table, half of the time lifted, a quarter of the time leaning or
/// lying; in the hand in any orientation.
[[nodiscard]] guidance::GuidedState seeded_situation(const guidance::GuidanceSetup& setup, Seeded& seeded);

/// A person's execution of a move: direction within 20 degrees, amount within 40 per cent.
[[nodiscard]] guidance::Execution seeded_person(const guidance::Move& move,
                                                const guidance::GuidanceSetup& setup, Seeded& seeded);

} // namespace frustumscreen::bench
