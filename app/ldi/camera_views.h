/// Depth pictures of the cameras of a hemisphere: they tell which places of a world are hidden from all cameras.
///
/// Frames   window (triangle_world.h). Units: metres.
/// Threads  one at a time.
/// Memory   one number a pixel for each camera that was drawn; one picture with its colours while it is drawn.
#pragma once

#include "app/ldi/depth_picture.h"
#include "app/ldi/hemisphere.h"
#include "app/ldi/triangle_rasterizer.h"
#include "app/ldi/triangle_world.h"

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace frustumscreen::ldi {

/// One camera's depths.
class CameraDepths {
public:
    /// Keeps for each pixel the farthest surface in the 3 x 3 pixels around it, and for each square of 2 to 64 pixels the
    /// farthest in the 3 x 3 squares around it.
    explicit CameraDepths(const DepthPicture& picture);

    enum class Sight { Seen, Hidden, Beside };
    /// Beside: outside of the picture, or behind the camera. A place counts as seen up to `tolerance_m` behind the surface, along
    /// the window's normal. A hidden place counts as seen too if an eye between the cameras may see past the surface that hides
    /// it: the picture shows something as far away within the distance by which place and surface move against each other.
    [[nodiscard]] Sight sight(const glm::dvec3& point, double tolerance_m) const;
    /// The sight of everything between and around two places at most some ten pixels apart: Hidden if none of it is seen.
    [[nodiscard]] Sight sight_between(const glm::dvec3& from, const glm::dvec3& to, double tolerance_m) const;
    [[nodiscard]] std::uint64_t bytes() const { return 4 * nearness_.size() * sizeof(float) / 3; }

private:
    PictureCamera camera_;
    PictureMap map_;
    double per_metre_; ///< farness
    std::vector<float> nearness_;
    double shift_px_; ///< of an eye between cameras, for a nearness of 1
    /// Values of squares of 2^k pixels, k from 1.
    struct Level {
        int columns = 0, rows = 0;
        std::vector<float> nearness;
    };
    std::array<Level, 6> levels_;

    /// The farthest surface within `around_px` of a pixel, or farther.
    [[nodiscard]] float farthest(int x, int y, double around_px) const;
};

class CameraViews {
public:
    /// `width`, `height`: pixels of a camera's picture of the whole window. `world` and `hemisphere` must outlive it.
    CameraViews(const TriangleWorld& world, const Hemisphere& hemisphere, const glm::dvec2& half_extent_m,
                int width, int height);

    /// Draws a part of the picture of the first of `cameras` that lacks one: at most `triangles`. False if none lacks one.
    bool draw_part(std::span<const std::size_t> cameras, std::size_t triangles);
    /// Null before it is drawn.
    [[nodiscard]] const CameraDepths* of(std::size_t camera) const {
        return views_[camera] ? &*views_[camera] : nullptr;
    }
    [[nodiscard]] std::uint64_t bytes() const;

private:
    const TriangleWorld& world_;
    const Hemisphere& hemisphere_;
    glm::dvec2 half_extent_m_;
    int width_, height_;
    std::array<std::optional<CameraDepths>, camera_count> views_;
    std::size_t drawing_ = camera_count; ///< the camera whose picture is begun
    std::size_t next_triangle_ = 0;
    DepthPicture picture_;
    TriangleRasterizer rasterizer_;
};

/// True if one of `cameras`, all drawn, sees the place, or none looks there.
[[nodiscard]] bool may_be_seen(const CameraViews& views, std::span<const std::size_t> cameras,
                               const glm::dvec3& point, double tolerance_m);

/// False only if none of `cameras` sees a place between two that are close together, or around.
[[nodiscard]] bool may_be_seen_between(const CameraViews& views, std::span<const std::size_t> cameras,
                                       const glm::dvec3& from, const glm::dvec3& to, double tolerance_m);

} // namespace frustumscreen::ldi
