/// A flat screen in the visitor's surroundings: a panel that shines by its picture, in a dark frame.
///
/// Frames   table T; metres. Pixels of its picture as in pinhole.h.
/// Light    linear.
/// Threads  pure; any.
#pragma once

#include "app/image/image.h"

#include <glm/glm.hpp>

#include <array>
#include <optional>
#include <vector>

namespace frustumscreen::simulation {

inline constexpr double screen_case_albedo = 0.05; ///< its frame and its back

struct VisitorScreen {
    /// The corners of its lit area, a rectangle: top left, top right, bottom right, bottom left, as people before it see it.
    std::array<glm::dvec3, 4> corners_m;
    image::Image8 picture; ///< for the scene's eye
    double rim_m = 0.012;
    double white = 0.85; ///< light of its white, as a share of the exposure's (room_light.h)
};

struct ScreenHit {
    double t = 0.0;
    glm::dvec3 normal{0.0}; ///< towards the ray's origin
    bool shines = false;    ///< the lit area, from the front
    glm::dvec2 pixel{0.0};
};
/// Where a ray first meets the panel or its frame, t > 0.
[[nodiscard]] std::optional<ScreenHit> meet(const VisitorScreen& screen, const glm::dvec3& origin,
                                            const glm::dvec3& direction);

/// The light of a screen on what is around it, which casts no shadows: of a few parts of its picture, each as a point.
class ScreenLight {
public:
    explicit ScreenLight(const VisitorScreen& screen);
    /// On a white surface; 0 behind the screen.
    [[nodiscard]] glm::dvec3 on(const glm::dvec3& point_m, const glm::dvec3& normal) const;

private:
    struct Part {
        glm::dvec3 middle_m{0.0};
        glm::dvec3 light{0.0};
    };
    std::vector<Part> parts_;
    glm::dvec3 normal_{0.0};
    double part_m2_ = 0.0;
};

} // namespace frustumscreen::simulation
