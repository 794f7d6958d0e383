/// Compares a frame plan with the exact picture, point by point.
///
/// Points   corners of small triangles that are scattered through the artifact's box, and of others that are
///          placed where the eye looks through a face, so a grazing view has as many as a frontal one.
///          Positions are stored as in a pack, 16 bits per axis.
/// Threads  pure; any.
#pragma once

#include "app/bench/stability/exact.h"
#include "app/bench/stability/stability.h"
#include "app/scene/frame_plan.h"

#include <optional>
#include <string>
#include <vector>

namespace frustumscreen::bench {

/// A kiosk as shipped: the projector 1.2 m above the table, the default prop at its centre.
[[nodiscard]] exact::SetUp usual_set_up();

/// Triangles that the set-up's eye sees through each face turned to it, and as many anywhere in the box.
struct SeenArtifact {
    pack::PackLevel level;
    scene::PlacedLevel placed;
    [[nodiscard]] exact::Vector corner(std::uint32_t index) const; ///< prop frame
};
inline const glm::dvec3 seen_box_size{1.0, 1.0, 0.75}; ///< the default prop's
[[nodiscard]] SeenArtifact seen_artifact(const exact::SetUp& set_up, int triangles = 2000,
                                         double metres_per_box = 0.16);
/// A level of a pack, placed in the set-up's prop.
[[nodiscard]] SeenArtifact seen_level(const exact::SetUp& set_up, const pack::Pack& pack,
                                      std::uint32_t level);

[[nodiscard]] scene::FramePlan plan_of(const exact::SetUp& set_up, const SeenArtifact& artifact);

struct PictureFigures {
    double error_px = 0.0;     ///< largest, of the 64-bit collineation
    double gpu_error_px = 0.0; ///< largest, of the 32-bit matrix on stored positions
    double points = 0.0;       ///< number compared
    double missing = 0.0;      ///< triangles that are visible on a face but missing from its plan
    double unlit = 0.0;        ///< visible points outside the plan's lit tiles
    double wrong_faces = 0.0;  ///< planned, although the eye or the lens is not above them
    double not_finite = 0.0;   ///< number of non-finite values in the plan

    void include(const PictureFigures& other); ///< takes the larger errors, adds the counts
};
[[nodiscard]] PictureFigures figures_of(const exact::SetUp& set_up, const SeenArtifact& artifact,
                                        const scene::FramePlan& plan,
                                        std::optional<std::size_t> only_face = std::nullopt);
/// Like the overload above, for `seen_artifact` of the set-up.
[[nodiscard]] PictureFigures figures_of(const exact::SetUp& set_up,
                                        std::optional<std::size_t> only_face = std::nullopt);

/// Errors of the usual set-up's picture without grazing views: the picture's width times four roundings of the
/// matrix, of 2^-53 or 2^-24. At grazing views they grow by 1 / sine.
inline constexpr double bound_px = 4.0 * 1280.0 * 0x1p-53;
inline constexpr double gpu_bound_px = 4.0 * 1280.0 * 0x1p-24;

/// Rows that require: nothing is missing, unlit, wrong or infinite; errors are within the bounds; at least
/// `min_points` were compared.
[[nodiscard]] std::vector<StabilityRow> rows_of(const PictureFigures& figures, const std::string& where,
                                                double bound_px, double gpu_bound_px,
                                                double min_points = 100.0);
void append(StabilityResult& result, std::vector<StabilityRow> rows);

} // namespace frustumscreen::bench
