/// Random numbers from a seed, equal on every machine: std::uniform_real_distribution differs between libraries.
///
/// Threads  values; one caller.
#pragma once

#include <cstdint>
#include <random>

namespace frustumscreen::bench {

class SeededDraw {
public:
    explicit SeededDraw(std::uint64_t seed) : engine_(seed) {}
    double between(double low, double high) {
        return low + (high - low) * (static_cast<double>(engine_() >> 11U) * 0x1p-53);
    }

private:
    std::mt19937_64 engine_;
};

} // namespace frustumscreen::bench
