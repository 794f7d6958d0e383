/// Cost against the source's size: the built-in amphora at several triangle counts, either with the carving
/// that each count can show, or one surface subdivided to each count. Each is baked and all are drawn in one
/// interleaved run, together with the two-pass method on the same full meshes.
///
/// Threads  the one whose context is current; bake and truth use every core.
/// Errors   any error from generator, bake and techniques.
#pragma once

#include "app/bench/measures/error_time.h"

namespace frustumscreen::bench {

struct ScalingOptions {
    std::vector<std::int64_t> triangles = {100'000, 1'000'000, 4'000'000};
    /// Use the first amphora for every count; each triangle is split into four until the count is reached or
    /// exceeded.
    bool same_surface = false;
    int size = 512; ///< texels of the bake along the longest edge of a face
    PictureOptions picture;
    int poses = 10;
    std::uint64_t seed = 1;
    int timing_rounds = 5;
    int two_pass_pixels = 1024;
};

/// One triangle count, baked.
struct ScalingSource {
    std::shared_ptr<const bake::SourceMesh> mesh;
    pack::Pack pack;
    double bake_s = 0.0;
};
[[nodiscard]] Result<std::vector<ScalingSource>> bake_amphoras(const ScalingOptions& options,
                                                               const StepProgress& progress);

struct ScalingRow {
    std::uint64_t source_triangles = 0;
    double bake_s = 0.0;
    TechniqueResult default_level;
    TechniqueResult finest_level;
    TechniqueResult relief; ///< the pack's finest relief
    TechniqueResult two_pass;
};

/// Cost at the largest triangle count over that at the smallest.
inline constexpr double max_growth = 1.25;        ///< the default level
inline constexpr double max_relief_growth = 1.10; ///< the finest relief

[[nodiscard]] Result<std::vector<ScalingRow>> scaling(const SetUp& set_up,
                                                      const std::vector<ScalingSource>& sources,
                                                      const ScalingOptions& options,
                                                      const StepProgress& progress);
[[nodiscard]] std::string scaling_csv(std::span<const ScalingRow> rows);
[[nodiscard]] std::string scaling_table(std::span<const ScalingRow> rows);

} // namespace frustumscreen::bench
