/// The default and finest level of a pack while the prop moves in steps of 0.1 pixel, against the ray cast
/// (measure: shimmer_sequence.h); and the edges between the prop's faces (edge_sparkle.h).
///
/// Limits   both ratios to one ray's <= 1 and the excess <= 0.1 % of the judged pixels, in every sequence.
///          Over all sequences feathered edges change no more than sharp ones.
/// Threads  the one whose context is current; rays are cast on every core.
/// Errors   any error from the parts, with the set-up's name in front.
#pragma once

#include "app/bench/measures/edge_sparkle.h"
#include "app/bench/measures/error_time.h"
#include "app/bench/measures/shimmer_sequence.h"
#include "app/bench/measures/verdicts.h"

#include <span>
#include <string>
#include <vector>

namespace frustumscreen::bench {

struct ShimmerOptions {
    int poses = 3;
    std::uint64_t seed = 1;
    int steps = 20;
    bool sixteen_rays = true; ///< also compute the slower truth
    PictureOptions picture;
};

/// One level in one sequence.
struct ShimmerRow {
    std::string technique;
    int pose = 0;
    PushDirection direction = PushDirection::Row;
    SequenceShimmer shimmer;
};

struct ShimmerResult {
    std::string name; ///< name of the set-up
    std::vector<BenchPose> poses;
    std::vector<ShimmerRow> rows;
    /// `side_by_side` of the sequence with the most excess.
    image::Image8 worst;
    std::vector<SparkleRow> edges; ///< as many steps of 0.1 mm in each
};

[[nodiscard]] Result<ShimmerResult> shimmer(const SetUp& set_up, const pack::Pack& pack,
                                            const std::shared_ptr<const bake::SourceMesh>& mesh,
                                            const ShimmerOptions& options, const StepProgress& progress);

inline constexpr double max_ratio = 1.0;
inline constexpr double max_excess_percent = 0.1;

[[nodiscard]] std::vector<LimitVerdict> judge(const ShimmerResult& result);
[[nodiscard]] std::string shimmer_csv(std::span<const ShimmerResult> results);
[[nodiscard]] std::string edge_sparkle_csv(std::span<const ShimmerResult> results);
[[nodiscard]] std::string shimmer_table(const ShimmerResult& result);

} // namespace frustumscreen::bench
