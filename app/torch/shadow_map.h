/// A shadow map drawn on the processor: the nearness of the nearest triangle at each pixel of a torch's own picture.
///
/// Most triangles of a level are smaller than a pixel of the map and lie between pixel middles; they cost a comparison of
/// cells. A software renderer sets each of them up.
///
/// Frames   model: the triangles'. Picture: pixels, row 0 at the top; pixel (i, j) has its middle at (i + 1/2, j + 1/2).
/// Units    nearness: a length of the caller's over z, the depth along the torch's axis; 0 where nothing was drawn. On a plane it
///          is linear in the picture.
/// Threads  each one at a time. It keeps memory: a second `draw` of no more positions allocates nothing.
/// Errors   none: a triangle with a corner that is not finite is not drawn, nor what is nearer than 1/10 mm.
/// Method   corners are rounded to 1/256 of a pixel, then each edge function is exact in 64 bits, and pixels on an edge belong to
///          both triangles: a surface has no gaps. Triangles that reach beyond a guard band, behind the torch or out of
///          the half space are cut.
#pragma once

#include "firmware_host/base/pixel_rectangle.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace frustumscreen::torch {

class ShadowMap {
public:
    /// Clears the map to `width` x `height` pixels, up to 4096 each.
    void begin(int width, int height) {
        begin(width, height, {.x = 0, .y = 0, .width = width, .height = height});
    }
    /// Draws a part of the map alone, including its last column and row; the rest is undefined.
    void begin(int width, int height, const PixelRectangle& part);

    struct View {
        /// (x z, y z, z) of a place of the model: x and y in the picture, z in metres.
        glm::dmat4x3 picture_from_model{1.0};
        double metres = 1.0; ///< the nearness is this over z
        /// The torch may be inside the object: back-facing triangles are drawn into `backs`.
        bool from_within = false;
        /// Only what lies in the half space a.(x z, y z, z) + d >= 0 is drawn; zero: all.
        glm::dvec4 casting{0.0};
    };
    /// `indices`: three for each triangle, which has two sides.
    void draw(const View& view, std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices);

    /// Ends the map. If the first surface at a pixel is back-facing and nearer than all others by more than the share `slack`, the
    /// torch is inside an object there, and the whole ray is in shadow.
    void end(double slack);
    /// The nearness to compare a place with. The place lies between the middles of a pixel and its neighbours to the right, below
    /// and diagonally below; the three nearest of these four middles count.
    struct Farthest {
        float of_four = 0.0F; ///< the least nearness of all
        /// The least nearness of the three middles other than the least one; its two lowest bits name the least
        /// one: 0 the pixel, 1 to the right, 2 below, 3 both. For places of which that middle is the farthest of
        /// the four; other places use `of_four`.
        float without_one = 0.0F;
    };
    /// Computes `farthest` for all pixels, row by row, but for the last column and row. For steep surfaces both
    /// values are reduced by half the range of the four middles' nearness, but by at most the share `max_share`.
    void find_farthest();
    [[nodiscard]] std::span<const Farthest> farthest() const { return farthest_; }
    /// The share `slack` of the latest `end`.
    [[nodiscard]] float max_share() const { return max_share_; }

    /// The nearness of back-facing surfaces. The first call since `begin` clears it.
    [[nodiscard]] std::span<float> backs();
    /// Row by row. Others may draw into it too if they keep the nearer value.
    [[nodiscard]] std::span<float> nearness() { return nearness_; }
    [[nodiscard]] std::span<const float> nearness() const { return nearness_; }
    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }

private:
    /// A position in the picture, in 1/256 of a pixel.
    struct Corner {
        std::int32_t x = 0, y = 0;
        float nearness = 0.0F;
        /// The first column and row whose pixels' middles are not left of it and not above it, within the picture.
        std::uint16_t column = 0, row = 0;
    };
    /// Takes the nearness of a pixel (a), its neighbour to the right (b), below (c) and both (d).
    [[nodiscard]] static Farthest farthest_of(float a, float b, float c, float d, float max_share) {
        const float above_far = std::min(a, b), above_near = std::max(a, b);
        const float below_far = std::min(c, d), below_near = std::max(c, d);
        const float nearest = std::max(above_near, below_near);
        const float first = std::min(above_far, below_far);
        const float second = std::min(std::max(above_far, below_far), std::min(above_near, below_near));
        // Each comparison by itself, so that a loop over pixels needs no branch.
        const std::uint32_t of_above = b < a ? 1U : 0U, of_below = d < c ? 3U : 2U;
        const std::uint32_t which = below_far < above_far ? of_below : of_above;
        constexpr float share_of_range = 0.5F;
        const auto lower = [&](float farthest) {
            return farthest - std::min(share_of_range * (nearest - farthest), max_share * farthest);
        };
        const auto without = std::bit_cast<std::uint32_t>(lower(second));
        return {lower(first), std::bit_cast<float>((without & ~3U) | which)};
    }
    [[nodiscard]] Corner corner_at(const glm::dvec3& place, double metres) const;
    void place_corners(const View& view, std::span<const glm::vec3> positions);
    /// `clockwise`: as the picture is seen.
    void draw_triangle(const Corner& a, const Corner& b, const Corner& c, bool clockwise = true);
    void draw_cut(const View& view, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);

    int width_ = 0, height_ = 0;
    PixelRectangle part_;
    std::vector<float> nearness_, backs_;
    std::vector<Farthest> farthest_;
    bool has_backs_ = false;
    float max_share_ = 0.0F;
    std::vector<Corner> corners_;
    float *clockwise_ = nullptr, *others_ = nullptr; ///< where the view's triangles go: one of the two above
};

} // namespace frustumscreen::torch
