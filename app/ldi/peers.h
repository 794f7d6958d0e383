/// Two peers of the multi-LDI, made of the same pieces: one layered depth image for all eyes, and an image-based object.
///
/// Frames   window (triangle_world.h).
/// Units    metres, pixels.
/// Errors   none: a world without a triangle that is seen is an image without a pixel.
/// Threads  pure; any. `splat` allocates nothing.
/// Source   the multi-LDI report, 2.3 and 5.4; Oliveira & Bishop 1999: an image-based object has six layered depth images, of
///          which at most three are drawn. There the six have one eye in the object, so a hollow world would lose what its far
///          sides hold. Here each side's eye is outside and its image holds all that its cameras see through the side, and
///          images after the first are drawn with a depth test.
#pragma once

#include "app/ldi/patch_layers.h"

#include <array>
#include <cstddef>
#include <span>

namespace frustumscreen::ldi {

/// One large image of all 29 cameras: its eye is on the axis, its plane the window's.
[[nodiscard]] LayeredDepth single_ldi(const Hemisphere& hemisphere,
                                      std::span<const DepthPicture, camera_count> pictures,
                                      const CameraView& view);

/// The world in its bounding box, seen through the box's sides.
struct ImageBasedObject {
    struct Side {
        LayeredDepth layers;
        glm::dvec3 middle{0.0}, outwards{0.0}; ///< of the side
    };
    std::array<Side, 6> sides;

    [[nodiscard]] std::uint64_t bytes() const;
};

/// Cameras of a side: one on its axis, four around it.
inline constexpr std::size_t side_camera_count = 5;
/// The angle of the four from the axis: half of the area of a cap of 120 degrees is nearer to the axis.
inline constexpr double side_camera_polar_rad = 0.7227342478134157; ///< acos(3/4)

/// `radius_m`: from a side's middle to its cameras. Pixels on the sides are as large as on the window, but at most `max_side` a
/// side.
[[nodiscard]] ImageBasedObject image_based_object(const TriangleWorld& world, double radius_m,
                                                  const CameraView& view);

/// Numbers of the sides that the eye is before, the one that it is farthest before first: three at most, and from within the
/// box the side that the eye is nearest to.
struct SeenSides {
    std::array<std::size_t, 3> numbers{};
    std::size_t count = 0;
};
[[nodiscard]] SeenSides seen_sides(const ImageBasedObject& object, const glm::dvec3& eye);

void splat(const ImageBasedObject& object, DepthPicture& picture);

} // namespace frustumscreen::ldi
