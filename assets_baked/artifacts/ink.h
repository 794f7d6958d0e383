/// Tools shared by the painters: flat shapes as signed distances, noise that is periodic around a body, ink
/// in layers.
///
/// Units    the caller's (mm or a figure's height); distances are negative inside a shape.
/// Threads  pure; any.
#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <span>

namespace frustumscreen::artifacts {

/// Signed distances.
[[nodiscard]] float disc(glm::vec2 p, glm::vec2 centre, float radius);
[[nodiscard]] float rectangle(glm::vec2 p, glm::vec2 centre, glm::vec2 half);
/// A limb: radius `ra` at a, `rb` at b, linear in between.
[[nodiscard]] float limb(glm::vec2 p, glm::vec2 a, glm::vec2 b, float ra, float rb);
/// Any simple polygon.
[[nodiscard]] float polygon(glm::vec2 p, std::span<const glm::vec2> corners);
/// A ring of `width`, between two angles (radians, counter-clockwise from +x), round ends.
[[nodiscard]] float arc(glm::vec2 p, glm::vec2 centre, float radius, float width, float from, float to);
/// A leaf from a to b, `half_width` at its middle, pointed at both ends.
[[nodiscard]] float leaf(glm::vec2 p, glm::vec2 a, glm::vec2 b, float half_width);

/// 1 inside, 0 outside, with a soft edge of width `edge`.
[[nodiscard]] float cover(float distance, float edge);

/// Smooth noise in -1..1 over (x, y); periodic in x with `period` cells, several octaves.
[[nodiscard]] float noise(glm::vec2 p, int period, int octaves, std::uint32_t seed);
/// Distance in cells to the border between the two nearest random sites; periodic in x.
[[nodiscard]] float cell_border(glm::vec2 p, int period, std::uint32_t seed);

enum class Pigment : int { Ground, Slip, Red, White };

/// The pigments at one point of the ground: the share of each (their sum is 1), and the height of the paint.
struct Ink {
    glm::vec4 share{1.0F, 0.0F, 0.0F, 0.0F};
    float raised_mm = 0.0F;

    void paint(Pigment pigment, float coverage);
    void raise(float by_mm, float coverage);
};

} // namespace frustumscreen::artifacts
