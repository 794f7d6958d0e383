#include "assets_baked/bake/chart.h"

#include <cmath>

namespace frustumscreen::bake {

namespace {

/// Twice the area of abc; positive counter-clockwise.
float doubled_area(const glm::vec2& a, const glm::vec2& b, const glm::vec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Calls `function` with each texel whose centre is inside abc and with the weights of a, b and c there,
/// until it returns false; returns true if it never did.
template <typename Function>
bool for_each_centre(const std::array<glm::vec2, 3>& corners, const Function& function) {
    const auto& [a, b, c] = corners;
    const float whole = doubled_area(a, b, c);
    const glm::ivec2 low(glm::floor(glm::min(a, glm::min(b, c))));
    const glm::ivec2 high(glm::floor(glm::max(a, glm::max(b, c))));
    for (int y = low.y; y <= high.y; ++y) {
        for (int x = low.x; x <= high.x; ++x) {
            const glm::vec2 p = glm::vec2(x, y) + 0.5F;
            const glm::vec3 weights(doubled_area(b, c, p), doubled_area(c, a, p), doubled_area(a, b, p));
            if (glm::min(weights.x, glm::min(weights.y, weights.z)) > 0.0F &&
                !function(glm::ivec2(x, y), weights / whole)) {
                return false;
            }
        }
    }
    return true;
}

} // namespace

Chart::Chart(const glm::vec3& direction, float texel_box) : direction_(direction) {
    const glm::vec3 reference = std::abs(direction.z) < 0.9F ? glm::vec3(0, 0, 1) : glm::vec3(0, 1, 0);
    axis_u_ = glm::normalize(glm::cross(reference, direction));
    axis_v_ = glm::cross(direction, axis_u_);
    axis_u_ /= texel_box;
    axis_v_ /= texel_box;
}

bool Chart::take(const TriangleCorners& corners, std::uint32_t mesh, float stray_box, float min_facing) {
    const glm::vec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    const float facing = glm::dot(normal, direction_);
    if (facing < min_facing * glm::length(normal)) {
        return false;
    }
    std::array<glm::vec2, 3> flat{};
    glm::vec3 heights(0.0F);
    for (std::size_t k = 0; k < 3; ++k) {
        flat[k] = project(corners[k]);
        heights[static_cast<int>(k)] = glm::dot(corners[k], direction_);
    }
    const glm::ivec2 low(glm::floor(glm::min(flat[0], glm::min(flat[1], flat[2]))));
    const glm::ivec2 high(glm::floor(glm::max(flat[0], glm::max(flat[1], flat[2]))));
    reach(low, high);
    const float max_apart = facing > 0.0F ? stray_box * glm::length(normal) / facing : stray_box;
    const bool free = for_each_centre(flat, [&](const glm::ivec2& at, const glm::vec3& weights) {
        const Texel& texel = texels_.at(at.x - origin_.x, at.y - origin_.y);
        return texel.mesh == 0 ||
               (texel.mesh != mesh && std::abs(glm::dot(weights, heights) - texel.height) <= max_apart);
    });
    if (free) {
        for_each_centre(flat, [&](const glm::ivec2& at, const glm::vec3& weights) {
            texels_.at(at.x - origin_.x, at.y - origin_.y) = {glm::dot(weights, heights), mesh};
            return true;
        });
    }
    return free;
}

void Chart::reach(const glm::ivec2& low, const glm::ivec2& high) {
    const glm::ivec2 old_size(texels_.width, texels_.height);
    const bool empty = texels_.texels.empty();
    if (!empty && low.x >= origin_.x && low.y >= origin_.y && high.x < origin_.x + old_size.x &&
        high.y < origin_.y + old_size.y) {
        return;
    }
    // A growing chart reserves a margin, so that it is seldom copied.
    const glm::ivec2 margin = empty ? glm::ivec2(0) : old_size / 4 + 4;
    const glm::ivec2 new_low = empty ? low : glm::min(low - margin, origin_);
    const glm::ivec2 new_high = empty ? high : glm::max(high + margin, origin_ + old_size - 1);
    image::Image<Texel> larger(new_high.x - new_low.x + 1, new_high.y - new_low.y + 1);
    for (int y = 0; y < old_size.y; ++y) {
        for (int x = 0; x < old_size.x; ++x) {
            larger.at(x + origin_.x - new_low.x, y + origin_.y - new_low.y) = texels_.at(x, y);
        }
    }
    texels_ = std::move(larger);
    origin_ = new_low;
}

} // namespace frustumscreen::bake
