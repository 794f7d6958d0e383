/// A picture with depth, of a pinhole whose image plane is a rectangle in space: of a camera of the hemisphere, of an eye, or
/// of a layered depth image.
///
/// Frames   window (triangle_world.h), but any rigid one will do. Picture: pixels, x to the right, y down from the
///          rectangle's upper left corner; pixel (i, j) has its middle at (i + 1/2, j + 1/2).
/// Units    metres. Nearness: 1 on the rectangle's plane, 1/2 twice as far from the eye, 0 infinitely far or empty. It is
///          linear along a straight line of the picture on any plane of the world.
/// Shape    row-major, row 0 at the top.
/// Colour   8-bit sRGB; the last component is 255 where there is a surface, and 0 where there is none.
/// Errors   none: an eye on the rectangle's plane, nearer to it than a millionth of its size, or behind it, and numbers that are
///          not finite or beyond 1e9 m, make `PictureMap::usable` false, and then nothing is drawn.
/// Threads  values and pure functions; any.
#pragma once

#include <glm/glm.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace frustumscreen::ldi {

inline constexpr int max_picture_side = 4096; ///< pixels
/// Nearer to the eye than this share of the rectangle's distance nothing is seen.
inline constexpr double min_farness = 1e-6;

struct PictureCamera {
    glm::dvec3 eye{0.0, 0.0, 1.0};
    glm::dvec3 middle{0.0}; ///< of the rectangle
    glm::dvec3 half_right{0.5, 0.0, 0.0},
        half_up{0.0, 0.5, 0.0}; ///< from the middle to two sides; at right angles
    int width = 0, height = 0;  ///< pixels, 1 to `max_picture_side`

    [[nodiscard]] std::size_t pixel_count() const {
        return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    }
};

/// The camera at `eye` whose picture is the window itself, window frame.
[[nodiscard]] PictureCamera camera_through_window(const glm::dvec3& eye, const glm::dvec2& half_extent_m,
                                                  int width, int height);

/// A camera's maps between world and picture, in 64 bits.
class PictureMap {
public:
    struct Place {
        double x = 0.0, y = 0.0; ///< pixels
        double nearness = 0.0;
    };

    explicit PictureMap(const PictureCamera& camera);

    /// False if the eye is not before the rectangle's plane, or the rectangle or picture has no area.
    [[nodiscard]] bool usable() const { return usable_; }
    /// nullopt beside and behind the eye, and nearer than `min_farness`.
    [[nodiscard]] std::optional<Place> project(const glm::dvec3& point) const;
    /// From the eye to the rectangle, where the nearness is 1.
    [[nodiscard]] glm::dvec3 ray(double x, double y) const {
        return to_corner_ + x * per_column_ + y * per_row_;
    }
    [[nodiscard]] glm::dvec3 point(double x, double y, double nearness) const {
        return eye_ + ray(x, y) / nearness;
    }
    [[nodiscard]] const glm::dvec3& eye() const { return eye_; }
    /// Distance of a point from the eye along the rectangle's normal, as a share of the rectangle's: 1 / nearness.
    [[nodiscard]] double farness(const glm::dvec3& point) const {
        return glm::dot(toward_plane_, point - eye_);
    }
    /// Homogeneous: (x, y) times farness, and farness. Linear in the vector from the eye.
    [[nodiscard]] glm::dvec3 homogeneous_from_eye(const glm::dvec3& vector) const {
        const double far = glm::dot(toward_plane_, vector);
        return {glm::dot(columns_, vector) + far * first_column_, glm::dot(rows_, vector) + far * first_row_,
                far};
    }
    [[nodiscard]] glm::dvec3 homogeneous(const glm::dvec3& point) const {
        return homogeneous_from_eye(point - eye_);
    }
    /// The change of the ray from a pixel to the next one.
    [[nodiscard]] const glm::dvec3& per_column() const { return per_column_; }
    [[nodiscard]] const glm::dvec3& per_row() const { return per_row_; }
    /// A step in depth by a pixel's size where the step is made changes the nearness by this share of it.
    [[nodiscard]] double step_share() const {
        return glm::length(toward_plane_) * std::max(glm::length(per_column_), glm::length(per_row_));
    }

private:
    bool usable_ = false;
    glm::dvec3 eye_;
    glm::dvec3 to_corner_{0.0}, per_column_{0.0}, per_row_{0.0};
    glm::dvec3 columns_{0.0}, rows_{0.0};         ///< pixels a metre along the rectangle
    double first_column_ = 0.0, first_row_ = 0.0; ///< of the eye's foot on the plane, less its own share
    glm::dvec3 toward_plane_{0.0};                ///< its product with a vector is the vector's farness
};

struct DepthPicture {
    PictureCamera camera;
    std::vector<float> nearness;      ///< 0: empty
    std::vector<glm::u8vec4> colours; ///< sRGB

    /// Empties it for another camera; keeps its memory, and allocates only if the camera has more pixels than any before.
    void begin(const PictureCamera& of);
    [[nodiscard]] std::size_t at(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(camera.width) +
               static_cast<std::size_t>(x);
    }
};

} // namespace frustumscreen::ldi
