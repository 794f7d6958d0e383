/// The cost of a frame of a pack's default level in numbers that do not depend on the machine, and their
/// change against a reference kept in the repository.
///
/// Counted  from the frame plan, averaged over seeded poses: triangles and draw calls sent, vertices they
///          reference (each once), samples cleared and averaged (whole tiles), and bytes: indices uploaded,
///          vertices read, colour and depth of samples written and read back, the picture cleared. The
///          texture's cache lines and hidden fragments are not counted.
/// Threads  pure; any.
/// Errors   settings without poses; a reference that `counts_json` did not write.
#pragma once

#include "app/bench/measures/technique_set.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::bench {

struct FrameCounts {
    double triangles = 0.0;
    double vertices = 0.0;
    double draw_calls = 0.0;
    double samples = 0.0;
    double bytes = 0.0;
};

struct CountedPack {
    std::string artifact; ///< the source's file name and triangle count
    std::string set_up;
    FrameCounts counts;
};

/// The pack's default level, averaged over the poses.
[[nodiscard]] FrameCounts count_frames(const settings::Settings& settings, const pack::Pack& pack,
                                       std::span<const BenchPose> poses);
/// Like the overload above, over `poses` poses from `seed`.
[[nodiscard]] Result<CountedPack> count_frames(const SetUp& set_up, const pack::Pack& pack, int poses,
                                               std::uint64_t seed);

[[nodiscard]] std::string counts_json(std::span<const CountedPack> counted);
[[nodiscard]] Result<std::vector<CountedPack>> read_counts(std::string_view text);

/// Growth above this factor of the reference's count is a regression that must be explained.
inline constexpr double max_count_growth = 1.05;

struct CountChange {
    CountedPack now;
    FrameCounts reference;
    bool grown = false; ///< a count grew by more than `max_count_growth`
};
/// Only packs that the reference contains.
[[nodiscard]] std::vector<CountChange> changes(std::span<const CountedPack> counted,
                                               std::span<const CountedPack> reference);
/// "ARTIFACT in SET-UP" for each pack that the reference lacks.
[[nodiscard]] std::vector<std::string> without_reference(std::span<const CountedPack> counted,
                                                         std::span<const CountedPack> reference);
/// One row per pack; next to each number its change in percent, if the reference contains the pack.
[[nodiscard]] std::string counts_table(std::span<const CountedPack> counted,
                                       std::span<const CountChange> against);

} // namespace frustumscreen::bench
