/// The starting point of a measurement of one pack: its levels as a kiosk draws them, poses and the truth.
///
/// Threads  as TechniqueSet.
/// Errors   no display; no poses; any error from making a technique.
#pragma once

#include "app/bench/measures/technique_set.h"
#include "app/bench/truth/poses.h"
#include "app/bench/truth/truth.h"

#include <memory>
#include <span>
#include <vector>

namespace frustumscreen::bench {

/// The pack must outlive this.
struct Comparison {
    std::unique_ptr<TechniqueSet> set; ///< the floor and levels of the pack
    std::vector<BenchPose> poses;
    Truth truth;
    glm::dmat4 prop_from_artifact{1.0};
};
struct ComparisonOptions {
    PictureOptions picture;
    int poses = 50;
    std::uint64_t seed = 1;
};
[[nodiscard]] Result<Comparison> open_comparison(const SetUp& set_up, const pack::Pack& pack,
                                                 std::span<const std::uint32_t> levels,
                                                 const std::shared_ptr<const bake::SourceMesh>& mesh,
                                                 const ComparisonOptions& options);
/// The default level and, if different, the finest.
[[nodiscard]] std::vector<std::uint32_t> default_and_finest(const pack::Pack& pack);

} // namespace frustumscreen::bench
