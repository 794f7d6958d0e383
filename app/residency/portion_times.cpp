#include "app/residency/portion_times.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace frustumscreen::residency {

namespace {

/// Relative uncertainty of a sentence's length, if predicted by its letters: numbers and names take longer
/// than they look.
constexpr double uncertain_share = 0.3;
constexpr double min_uncertain_s = 1.2;
/// A pause longer by some time may be farther away by this multiple of it: pauses between sentences are
/// longer than those at commas.
constexpr double pause_is_worth = 4.0;

double seconds_of(std::uint32_t sample) {
    return static_cast<double>(sample) / sound::sample_rate_hz;
}

/// The middle of the best pause near `expected_s`; `expected_s` if there is none.
double nearest_pause(const sound::Prompt& prompt, double expected_s, double begin_s, double uncertain_s) {
    double best = expected_s;
    double min_cost = std::numeric_limits<double>::infinity();
    for (const sound::Mark& mark : prompt.marks) {
        const double middle_s = 0.5 * (seconds_of(mark.begin) + seconds_of(mark.end));
        const double off_s = std::abs(middle_s - expected_s);
        const double cost = off_s - pause_is_worth * (seconds_of(mark.end) - seconds_of(mark.begin));
        if (middle_s > begin_s && off_s <= uncertain_s && cost < min_cost) {
            min_cost = cost;
            best = middle_s;
        }
    }
    return best;
}

} // namespace

std::vector<Nanoseconds> portion_times(std::span<const Nanoseconds> shares, const sound::Prompt& prompt) {
    const double length_s = to_seconds(sound::duration_of(prompt.samples.size()));
    double left = to_seconds(std::accumulate(shares.begin(), shares.end(), Nanoseconds(0)));
    double begin_s = 0.0;
    std::vector<Nanoseconds> times;
    for (const Nanoseconds& share : shares) {
        times.push_back(Nanoseconds(std::llround(1e9 * begin_s)));
        const double part = left > 0.0 ? to_seconds(share) / left : 0.0;
        const double takes_s = (length_s - begin_s) * part;
        left -= to_seconds(share);
        begin_s = nearest_pause(prompt, begin_s + takes_s, begin_s,
                                std::max(min_uncertain_s, uncertain_share * takes_s));
    }
    return times;
}

} // namespace frustumscreen::residency
