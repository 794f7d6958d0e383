#include "assets_baked/artifacts/nautilus_cup_paint.h"

#include "assets_baked/artifacts/ink.h"

#include <algorithm>
#include <cmath>

namespace frustumscreen::artifacts {
namespace {

using glm::vec2;
using glm::vec3;

constexpr float turn = 6.28318531F;

/// Cream with rust-red flames that run with the growth lines and fade towards the lip. u 0..1, v 0..1.
vec3 outside_colour(float u, float v) {
    const float side = std::abs(2.0F * v - 1.0F); // 0 on the keel, 1 at the coil's axis
    const float drift = noise({u * 14.0F, side * 5.0F}, 64, 4, 41);
    const float flow = u - 0.075F * side * side + 0.020F * noise({u * 9.0F, v * 7.0F}, 64, 4, 42);
    const float wave = flow * 21.0F + 0.35F * drift;
    const float stripe = std::abs(wave - std::round(wave));
    const float fade = 1.0F - glm::smoothstep(0.50F, 0.78F, u + 0.10F * drift - 0.06F * side);
    const float width = (0.25F - 0.13F * side + 0.10F * drift) * fade;
    const float flame = cover(stripe - width, 0.10F) * glm::smoothstep(0.0F, 0.2F, fade);
    const float lines = noise({u * 420.0F, side * 3.0F}, 4096, 2, 43);
    const vec3 cream = vec3(0.91F, 0.82F, 0.67F) + vec3(0.03F, 0.02F, 0.0F) * drift -
                       vec3(0.03F, 0.045F, 0.06F) * std::abs(lines);
    const vec3 rust = glm::mix(vec3(0.66F, 0.29F, 0.13F), vec3(0.47F, 0.17F, 0.09F), 0.5F + 0.9F * drift) *
                      (1.0F + 0.10F * lines);
    const vec3 shell = glm::mix(cream, rust, flame);
    return glm::mix(shell, vec3(0.85F, 0.66F, 0.50F), 0.35F * glm::smoothstep(0.6F, 0.95F, side));
}

/// Mother-of-pearl: a pale ground whose hue drifts.
vec3 inside_colour(float u, float v) {
    const float drift = noise({u * 10.0F, v * 6.0F}, 64, 4, 51);
    const float bands = u * 9.0F + 1.8F * drift + 1.2F * std::cos(turn * v);
    const vec3 hue = {std::cos(turn * bands), std::cos(turn * (bands - 0.33F)),
                      std::cos(turn * (bands - 0.66F))};
    const float lines = noise({u * 300.0F, v * 4.0F}, 4096, 2, 52);
    return vec3(0.90F, 0.87F, 0.85F) + 0.045F * hue + vec3(0.03F) * drift + vec3(0.012F) * lines;
}

/// Gilding: worn and bright on raised parts, dark in the hollows. `recess` 0..1.
vec3 gold_colour(float u, float v, float recess) {
    const float drift = noise({u * 24.0F, v * 10.0F}, 24, 4, 61);
    const float fine = noise({u * 512.0F, v * 120.0F}, 512, 2, 62);
    const vec3 bright = vec3(0.84F, 0.63F, 0.29F) * (1.0F + 0.06F * drift + 0.04F * fine);
    const vec3 dark = {0.42F, 0.26F, 0.11F};
    return glm::mix(bright, dark, std::clamp(recess + 0.10F * drift, 0.0F, 0.85F));
}

/// 0 outside low..high, 1 well inside.
double window(double x, double low, double high, double soft) {
    return glm::smoothstep(low, low + soft, x) * (1.0 - glm::smoothstep(high - soft, high, x));
}

double beads(double angle, int count, double across_mm, double half_mm) {
    const double along = std::sin(0.5 * count * angle);
    const double round = 1.0 - (across_mm * across_mm) / (half_mm * half_mm);
    return round <= 0.0 ? 0.0 : std::sqrt(round) * std::abs(along);
}

} // namespace

double chasing_mm(double angle, double length) {
    double height = 0.0;
    // Gadroons on the dome of the foot, twisted as they rise; beads around its edge and on the rings.
    const double lobe = std::abs(std::cos(9.0 * (angle + 0.010 * length)));
    height += window(length, 16.0, 55.0, 6.0) * 2.0 * (std::sqrt(lobe) - 0.75);
    height += 1.3 * beads(angle, 72, length - 9.0, 2.2);
    height += 0.9 * beads(angle, 28, length - 74.0, 2.6);
    // The knop: upright leaves with a rib.
    const double leaf = std::abs(std::cos(4.0 * angle));
    height += window(length, 88.0, 121.0, 8.0) *
              (1.7 * std::pow(leaf, 0.6) - 1.0 - 0.6 * window(leaf, 0.965, 1.2, 0.02));
    // The calyx below the shell.
    const double petal = std::abs(std::cos(5.0 * angle));
    height += window(length, 146.0, 165.0, 5.0) * 1.2 * (std::pow(petal, 0.5) - 0.7);
    return height;
}

image::Image8 paint_nautilus_cup(double stem_length_mm) {
    image::Image8 texture(cup_atlas::size, cup_atlas::size, texel_of({0.90F, 0.70F, 0.34F}));
    paint_strip(cup_atlas::outside, texture, outside_colour);
    paint_strip(cup_atlas::inside, texture, inside_colour);
    paint_strip(cup_atlas::stem, texture, [stem_length_mm](float u, float v) {
        const double relief =
            chasing_mm(static_cast<double>(u * turn), static_cast<double>(v) * stem_length_mm);
        return gold_colour(u, v, static_cast<float>(glm::smoothstep(0.05, -0.9, relief)) * 0.75F + 0.08F);
    });
    paint_strip(cup_atlas::straps, texture, [](float u, float v) {
        // v runs across the strap: a dark line on either side of a row of lozenges.
        const float across = std::abs(2.0F * v - 1.0F);
        const float lozenge = std::abs(u * 64.0F - std::round(u * 64.0F)) * 2.0F + across / 0.5F;
        const float line = cover(std::abs(across - 0.70F) - 0.05F, 0.06F);
        const float cut = cover(std::abs(lozenge - 0.8F) - 0.12F, 0.12F);
        return gold_colour(u, 3.0F + v, 0.65F * std::max(line, cut) + 0.05F);
    });
    return texture;
}

} // namespace frustumscreen::artifacts
