#include "assets_baked/artifacts/ink.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace frustumscreen::artifacts {
namespace {

std::uint32_t hash(std::uint32_t x, std::uint32_t y, std::uint32_t seed) {
    std::uint32_t h = x * 0x8DA6B343U ^ y * 0xD8163841U ^ seed * 0xCB1AB31FU;
    h = (h ^ (h >> 15)) * 0x2C1B3C6DU;
    h = (h ^ (h >> 12)) * 0x297A2D39U;
    return h ^ (h >> 15);
}

float random01(std::uint32_t h) {
    return static_cast<float>(h >> 8) * (1.0F / 16777216.0F);
}

std::uint32_t wrapped(int x, int period) {
    const int rest = x % period; // one division: they take most of the time of a texture
    return static_cast<std::uint32_t>(rest < 0 ? rest + period : rest);
}

/// std::floor is a function call without newer instruction sets, and this is the innermost loop.
int floor_of(float x) {
    const int truncated = static_cast<int>(x);
    return truncated - (static_cast<float>(truncated) > x ? 1 : 0);
}

float value_noise(glm::vec2 p, int period, std::uint32_t seed) {
    const int x = floor_of(p.x);
    const int y = floor_of(p.y);
    const glm::vec2 f = p - glm::vec2(x, y);
    const glm::vec2 s = f * f * f * (f * (f * 6.0F - 15.0F) + 10.0F);
    const std::uint32_t left = wrapped(x, period);
    const std::uint32_t right = left + 1 == static_cast<std::uint32_t>(period) ? 0 : left + 1;
    const std::array<std::uint32_t, 2> column = {left, right};
    const auto corner = [&](std::size_t dx, int dy) {
        return random01(hash(column[dx], static_cast<std::uint32_t>(y + dy), seed));
    };
    return 2.0F * glm::mix(glm::mix(corner(0, 0), corner(1, 0), s.x),
                           glm::mix(corner(0, 1), corner(1, 1), s.x), s.y) -
           1.0F;
}

} // namespace

float disc(glm::vec2 p, glm::vec2 centre, float radius) {
    return glm::distance(p, centre) - radius;
}

float rectangle(glm::vec2 p, glm::vec2 centre, glm::vec2 half) {
    const glm::vec2 d = glm::abs(p - centre) - half;
    return glm::length(glm::max(d, 0.0F)) + std::min(std::max(d.x, d.y), 0.0F);
}

float limb(glm::vec2 p, glm::vec2 a, glm::vec2 b, float ra, float rb) {
    const glm::vec2 ab = b - a;
    const float t = std::clamp(glm::dot(p - a, ab) / glm::dot(ab, ab), 0.0F, 1.0F);
    return glm::distance(p, a + t * ab) - glm::mix(ra, rb, t);
}

float polygon(glm::vec2 p, std::span<const glm::vec2> corners) {
    float nearest = std::numeric_limits<float>::max();
    bool inside = false;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::vec2 a = corners[i];
        const glm::vec2 b = corners[(i + 1) % corners.size()];
        nearest = std::min(nearest, limb(p, a, b, 0.0F, 0.0F));
        if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y)) {
            inside = !inside;
        }
    }
    return inside ? -nearest : nearest;
}

float arc(glm::vec2 p, glm::vec2 centre, float radius, float width, float from, float to) {
    const glm::vec2 d = p - centre;
    constexpr float turn = 6.28318531F;
    float angle = std::atan2(d.y, d.x) - from;
    angle -= turn * std::floor(angle / turn);
    if (angle <= to - from) {
        return std::abs(glm::length(d) - radius) - 0.5F * width;
    }
    const glm::vec2 a = centre + radius * glm::vec2(std::cos(from), std::sin(from));
    const glm::vec2 b = centre + radius * glm::vec2(std::cos(to), std::sin(to));
    return std::min(glm::distance(p, a), glm::distance(p, b)) - 0.5F * width;
}

float leaf(glm::vec2 p, glm::vec2 a, glm::vec2 b, float half_width) {
    // Two circles through a and b; their intersection is the leaf.
    const glm::vec2 middle = 0.5F * (a + b);
    const glm::vec2 axis = b - a;
    const float half = 0.5F * glm::length(axis);
    const glm::vec2 side = glm::vec2(-axis.y, axis.x) / (2.0F * half);
    const float offset = (half * half - half_width * half_width) / (2.0F * half_width);
    const float radius = offset + half_width;
    return std::max(disc(p, middle + side * offset, radius), disc(p, middle - side * offset, radius));
}

float cover(float distance, float edge) {
    const float t = std::clamp(0.5F - distance / edge, 0.0F, 1.0F);
    return t * t * (3.0F - 2.0F * t);
}

float noise(glm::vec2 p, int period, int octaves, std::uint32_t seed) {
    float sum = 0.0F;
    float weight = 0.5F;
    for (int octave = 0; octave < octaves; ++octave) {
        sum += weight * value_noise(p, period, seed + static_cast<std::uint32_t>(octave));
        p *= 2.0F;
        period *= 2;
        weight *= 0.5F;
    }
    return sum;
}

float cell_border(glm::vec2 p, int period, std::uint32_t seed) {
    const glm::ivec2 cell = glm::ivec2(glm::floor(p));
    glm::vec2 nearest{0.0F};
    float least = std::numeric_limits<float>::max();
    const auto site = [&](int dx, int dy) {
        const std::uint32_t h =
            hash(wrapped(cell.x + dx, period), static_cast<std::uint32_t>(cell.y + dy), seed);
        return glm::vec2(cell) + glm::vec2(static_cast<float>(dx) + random01(h),
                                           static_cast<float>(dy) + random01(h * 0x9E3779B9U));
    };
    for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
            const glm::vec2 s = site(dx, dy);
            if (glm::distance(s, p) < least) {
                least = glm::distance(s, p);
                nearest = s;
            }
        }
    }
    float border = std::numeric_limits<float>::max();
    for (int dy = -2; dy <= 2; ++dy) {
        for (int dx = -2; dx <= 2; ++dx) {
            const glm::vec2 s = site(dx, dy);
            const glm::vec2 between = s - nearest;
            if (glm::dot(between, between) > 1e-8F) {
                border = std::min(border, glm::dot(0.5F * (s + nearest) - p, glm::normalize(between)));
            }
        }
    }
    return border;
}

void Ink::paint(Pigment pigment, float coverage) {
    if (coverage <= 0.0F) {
        return;
    }
    glm::vec4 only{0.0F};
    only[static_cast<int>(pigment)] = 1.0F;
    share = glm::mix(share, only, coverage);
}

void Ink::raise(float by_mm, float coverage) {
    raised_mm = std::max(raised_mm, by_mm * coverage);
}

} // namespace frustumscreen::artifacts
