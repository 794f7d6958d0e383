/// Edge sparkle: how much the pixels shared by two faces of the prop change while the prop moves in steps of
/// 0.1 mm.
///
/// A pixel on an edge lights both faces, but has the gain of one. If the gains differ, the pixel jumps when
/// the edge crosses its centre, unless the edge is feathered (edge_feather.h). The default level is therefore
/// drawn in even light, with feathered and with sharp edges, in identical poses.
///
/// Steps    The prop is pushed over the table, without turning, along X in one sequence and along Y in
///          another.
/// Measure  The change of a pixel from one step to the next: that of the channel that changes most, in sRGB
///          codes.
/// Judged   Shared: pixels whose square is crossed by an edge between two faces in either picture of a step;
///          the eye and the lens see both faces. Beside: pixels 2 to 5 pixels from such edges in both
///          pictures; they show how much the artifact changes by itself. Both kinds: only pixels that
///          show the artifact, with all their neighbours.
/// Threads  the one whose context is current.
/// Errors   any error from making the techniques.
#pragma once

#include "app/bench/measures/technique_set.h"
#include "app/bench/truth/poses.h"

#include <array>
#include <cstdint>
#include <vector>

namespace frustumscreen::bench {

inline constexpr double sparkle_step_m = 1e-4;

/// How often pixels changed by 0, 1, ... 255 codes from one step to the next.
class ChangeHistogram {
public:
    void add(int codes) { ++counts_.at(static_cast<std::size_t>(codes)); }
    void add(const ChangeHistogram& other);

    [[nodiscard]] std::int64_t changes() const;
    [[nodiscard]] double rms() const;  ///< codes
    [[nodiscard]] int q999() const;    ///< smallest number of codes that 99.9 % of the changes do not exceed
    [[nodiscard]] int largest() const; ///< codes; 0 without changes
    [[nodiscard]] double percent_over(int codes) const;

private:
    std::array<std::int64_t, 256> counts_{};
};

struct EdgeSparkle {
    ChangeHistogram sharp, feathered;               ///< shared pixels
    ChangeHistogram beside_sharp, beside_feathered; ///< these two must be alike, otherwise feathering reaches
                                                    ///< too far

    void add(const EdgeSparkle& other);
};

/// A pixel's zone relative to the shared edges of one picture; with several edges the last of these values
/// wins.
enum class EdgeZone : std::uint8_t { Away, Beside, Near, Shared };
[[nodiscard]] image::Image<EdgeZone> edge_zones(const settings::Settings& settings,
                                                const geometry::PropShape& prop, const BenchPose& pose);

/// Adds one step. `sharp` and `feathered` hold the pictures before and after it, `zones` the zones of these
/// poses.
void add_step(const std::array<image::Image8, 2>& sharp, const std::array<image::Image8, 2>& feathered,
              const std::array<image::Image<EdgeZone>, 2>& zones, EdgeSparkle& sparkle);

/// One prop pushed along X or Y.
struct SparkleRow {
    int pose = 0;
    bool along_x = true;
    EdgeSparkle sparkle;
};
/// Two rows per pose, with `steps` steps each.
[[nodiscard]] Result<std::vector<SparkleRow>> edge_sparkle(const SetUp& set_up, const pack::Pack& pack,
                                                           const std::vector<BenchPose>& poses, int steps,
                                                           const PictureOptions& picture,
                                                           const Progress& progress);

} // namespace frustumscreen::bench
