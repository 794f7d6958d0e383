/// Edge sparkle: how much the pixels that two faces of the prop share change while the prop is moved by 0.1 mm at a time.
///
/// A pixel on an edge lights both faces, but has the gain of one. Where the gains differ it jumps when the edge crosses
/// its middle, unless the edge is feathered (edge_feather.h). So the default level is drawn in even light, feathered
/// and with sharp edges, in the same places.
///
/// Steps    The prop is pushed over the table, without turning, along X in one sequence and along Y in another.
/// Measure  The change of a pixel from one step to the next: that of the channel that changes most, in sRGB codes.
/// Judged   Shared: pixels whose square an edge between two faces crosses in either of both pictures; the eye and the
///          lens see both faces. Beside: pixels 2 to 5 pixels from such edges in both, which say how much the artifact
///          changes by itself. Of either kind only those that show the artifact, with all their neighbours.
/// Threads  the one whose context is current.
/// Errors   whatever making the techniques reports.
#pragma once

#include "app/bench/measures/technique_set.h"
#include "app/bench/truth/poses.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace frustumscreen {

inline constexpr double sparkle_step_m = 1e-4;

/// How often pixels changed by 0, 1, ... 255 codes from one step to the next.
class ChangeHistogram {
public:
    void add(int codes) { ++counts_.at(static_cast<std::size_t>(codes)); }
    void add(const ChangeHistogram& other);

    [[nodiscard]] std::int64_t changes() const;
    [[nodiscard]] double rms() const;  ///< codes
    [[nodiscard]] int q999() const;    ///< the least number of codes that 99.9 % of the changes do not exceed
    [[nodiscard]] int largest() const; ///< codes; 0 where there was none
    [[nodiscard]] double percent_over(int codes) const;

private:
    std::array<std::int64_t, 256> counts_{};
};

struct EdgeSparkle {
    ChangeHistogram sharp, feathered;               ///< of the shared pixels
    ChangeHistogram beside_sharp, beside_feathered; ///< alike, or feathering reaches too far

    void add(const EdgeSparkle& other);
};

/// Where a pixel lies, as seen from the shared edges of one picture; of several edges the last of these counts.
enum class EdgeZone : std::uint8_t { Away, Beside, Near, Shared };
[[nodiscard]] Image<EdgeZone> edge_zones(const Settings& settings, const PropShape& prop,
                                         const BenchPose& pose);

/// Adds one step. `sharp` and `feathered` hold the pictures before and after it, `zones` those of the same poses.
void add_step(const std::array<Image8, 2>& sharp, const std::array<Image8, 2>& feathered,
              const std::array<Image<EdgeZone>, 2>& zones, EdgeSparkle& sparkle);

/// One prop pushed along X or Y.
struct SparkleRow {
    int pose = 0;
    bool along_x = true;
    EdgeSparkle sparkle;
};
/// Two rows for each pose, of `steps` steps.
[[nodiscard]] Result<std::vector<SparkleRow>> edge_sparkle(const SetUp& set_up, const Pack& pack,
                                                           const std::vector<BenchPose>& poses, int steps,
                                                           const PictureOptions& picture,
                                                           const Progress& progress);

} // namespace frustumscreen
