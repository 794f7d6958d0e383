#include "assets_baked/artifacts/hall/building.h"

#include "assets_baked/artifacts/hall/turned.h"
#include "assets_baked/artifacts/ink.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace frustumscreen::artifacts {
namespace {

using glm::vec2;
using glm::vec3;

constexpr float hall_width_mm = 3600.0F;
constexpr float floor_depth_mm = 3950.0F;
constexpr float wall_height_mm = 1300.0F;

/// A rectangle from (0, 0) to `size`, in mm, with its rim turned back by `rim_mm`; `placed` puts a place of it into space.
Patch sheet(glm::dvec2 size, double rim_mm, int texture_size,
            const std::function<glm::dvec3(const glm::dvec2& place, double back_mm)>& placed) {
    constexpr double rim_share = 0.02; // of the rows and columns
    Patch patch;
    patch.at = [=](double u, double v) {
        const auto inner = [&](double t) {
            return std::clamp((t - rim_share) / (1.0 - 2.0 * rim_share), 0.0, 1.0);
        };
        const auto beyond = [&](double t) {
            return std::max({rim_share - t, t - 1.0 + rim_share, 0.0}) / rim_share;
        };
        const glm::dvec2 place(inner(u) * size.x, inner(v) * size.y);
        return SurfacePoint{
            placed(place, rim_mm * std::max(beyond(u), beyond(v))),
            {static_cast<float>(inner(u)), AtlasStrip{0, texture_size}.v(inner(v), texture_size)}};
    };
    patch.length_u_mm = 1e-6; // with a number of cells of its own, so that the rim is a row of them
    patch.min_u = 50;
    patch.length_v_mm = size.y;
    patch.min_v = 10;
    return patch;
}

/// Two kinds of marble: 0 light, 1 dark.
vec3 marble(vec2 p_mm, float dark, std::uint32_t seed) {
    const vec2 p = p_mm / 210.0F;
    const float drift = noise(p, 4096, 5, seed);
    const float warp = noise(p * 2.2F, 4096, 4, seed + 20U);
    const float vein = glm::smoothstep(
        0.05F, 0.0F, std::abs(noise(p * vec2(0.8F, 1.1F) + 0.7F * warp, 4096, 4, seed + 40U)));
    const vec3 light =
        glm::mix(vec3(0.80F, 0.76F, 0.69F), vec3(0.62F, 0.57F, 0.51F), 0.45F * vein) * (1.0F + 0.10F * drift);
    const vec3 deep =
        glm::mix(vec3(0.30F, 0.34F, 0.33F), vec3(0.52F, 0.55F, 0.52F), 0.5F * vein) * (1.0F + 0.20F * drift);
    return glm::mix(light, deep, dark);
}

vec3 floor_colour(float u, float v) {
    const vec2 p((u - 0.5F) * hall_width_mm, v * floor_depth_mm); // y: 0 at the back
    const vec2 wall(0.5F * hall_width_mm - std::abs(p.x), p.y);
    constexpr float tile_mm = 300.0F;
    const vec2 cell = glm::floor(p / tile_mm);
    const vec2 in_cell = glm::abs(p / tile_mm - cell - 0.5F);
    const float joint = (0.5F - std::max(in_cell.x, in_cell.y)) * tile_mm;
    const bool odd = (static_cast<int>(cell.x + cell.y + 64.0F) & 1) != 0;
    const float border = std::min(wall.x, wall.y + 100.0F);
    const bool band = border < 300.0F;
    const std::uint32_t seed =
        101U + static_cast<std::uint32_t>(static_cast<int>(cell.x + 31.0F * cell.y) & 63);
    vec3 colour = marble(p + 37.0F * cell, band ? 1.0F : odd ? 0.82F : 0.0F, seed);
    colour *= 0.72F + 0.28F * glm::smoothstep(0.8F, 3.2F, band ? std::abs(border - 297.0F) : joint);
    if (band && border > 236.0F && border < 262.0F) {
        colour = marble(p, 0.0F, 99U) * 0.98F;
    }
    // The skylight is above the middle; walls keep light away.
    const float pool = std::exp(-(p.x * p.x) / (1500.0F * 1500.0F) -
                                (p.y - 1700.0F) * (p.y - 1700.0F) / (2300.0F * 2300.0F));
    const float near_wall =
        (1.0F - 0.55F * std::exp(-wall.x / 170.0F)) * (1.0F - 0.55F * std::exp(-wall.y / 170.0F));
    return colour * (0.50F + 0.60F * pool) * near_wall;
}

/// Light that falls on the wall from above each panel's middle, at x and y in mm.
float wall_light(vec2 p) {
    constexpr float panel_mm = 900.0F;
    const float x = p.x - (std::floor(p.x / panel_mm) + 0.5F) * panel_mm;
    const float below = wall_height_mm - 120.0F - p.y;
    const float cone = x * x / (2.0F * 210.0F * 210.0F) * (420.0F / std::max(120.0F, below));
    return 0.50F +
           0.62F * std::exp(-cone) * std::exp(-below / 1150.0F) * glm::smoothstep(20.0F, 260.0F, below);
}

vec3 wall_colour(float u, float v) {
    const vec2 p(u * hall_width_mm, v * wall_height_mm);
    const float drift = noise(p / 260.0F, 4096, 5, 131);
    const vec3 stone = vec3(0.74F, 0.69F, 0.60F) * (1.0F + 0.09F * drift);
    const vec3 paint = vec3(0.185F, 0.265F, 0.285F) * (1.0F + 0.10F * drift);
    constexpr float panel_mm = 900.0F;
    const float from_edge =
        std::abs(p.x / panel_mm - std::round(p.x / panel_mm)) * panel_mm; // of a pilaster's middle
    constexpr float half_pilaster_mm = 72.0F;
    vec3 colour = paint;
    float shade = 1.0F;
    if (p.y < 130.0F || p.y > 1130.0F) { // base and cornice
        colour = stone;
        shade = p.y < 130.0F ? 0.72F + 0.28F * glm::smoothstep(0.0F, 90.0F, p.y) : 0.82F;
    } else if (from_edge < half_pilaster_mm) {
        colour = stone;
        // Three flutes, lit from above; an edge on either side.
        const float flute = std::cos(from_edge / half_pilaster_mm * 3.5F * 3.14159265F);
        shade = 0.90F +
                0.10F * flute * glm::smoothstep(160.0F, 190.0F, p.y) * glm::smoothstep(1080.0F, 1050.0F, p.y);
    } else {
        // A frame of gilded wood within the panel, and the pilasters' shadow.
        const vec2 inside(from_edge - half_pilaster_mm - 55.0F, std::min(p.y - 190.0F, 1070.0F - p.y));
        const float frame = std::abs(std::min(inside.x, inside.y)) - 4.5F;
        if (inside.x > -4.5F && inside.y > -4.5F && frame < 0.0F) {
            colour = vec3(0.66F, 0.54F, 0.31F);
        }
        shade = 0.70F + 0.30F * glm::smoothstep(0.0F, 70.0F, from_edge - half_pilaster_mm);
        shade *= 0.62F + 0.38F * glm::smoothstep(0.0F, 120.0F, 1130.0F - p.y);
    }
    return colour * shade * wall_light(p) * (0.78F + 0.22F * glm::smoothstep(0.0F, 420.0F, p.y));
}

vec3 ceiling_colour(float u, float v) {
    const vec2 p((u - 0.5F) * hall_width_mm, (v - 0.5F) * hall_width_mm);
    if (std::max(std::abs(p.x) - 620.0F, std::abs(p.y) - 1250.0F) < 0.0F) { // the skylight
        const vec2 pane = glm::abs(p / vec2(310.0F, 312.5F) - glm::round(p / vec2(310.0F, 312.5F)));
        const float bar = std::min(pane.x * 310.0F, pane.y * 312.5F);
        return glm::mix(vec3(0.44F, 0.43F, 0.42F), vec3(0.90F, 0.95F, 0.99F),
                        glm::smoothstep(5.0F, 9.0F, bar));
    }
    const vec2 coffer = glm::abs(p / 400.0F - glm::floor(p / 400.0F) - 0.5F) * 400.0F;
    const float inside = 200.0F - std::max(coffer.x, coffer.y);
    const float depth = glm::smoothstep(34.0F, 42.0F, inside) + glm::smoothstep(66.0F, 74.0F, inside);
    const float glow =
        std::exp(-std::max(0.0F, std::max(std::abs(p.x) - 620.0F, std::abs(p.y) - 1250.0F)) / 420.0F);
    return vec3(0.62F, 0.59F, 0.53F) * (1.0F - 0.24F * depth) * (0.62F + 0.40F * glow);
}

/// Light on a plinth's stone: from above, less on the sides, in corners and below an edge.
vec3 stone_light(const TurnedPlace& place, float height_mm, float slab_mm, float side_light) {
    const auto height = static_cast<float>(place.along.position.y);
    // On flat tops the pattern is that of the plane: around the middle it would be rays.
    const auto radius = static_cast<float>(place.along.position.x);
    const auto angle = static_cast<float>(place.angle);
    const vec2 flat = radius / 46.0F * vec2(std::sin(angle), std::cos(angle));
    const bool on_top = place.along.normal.y > 0.9;
    const float drift = on_top ? noise(flat + 16.0F, 4096, 5, 152)
                               : noise({static_cast<float>(place.u) * 24.0F, height * 0.018F}, 24, 5, 151);
    const vec3 stone = vec3(0.80F, 0.77F, 0.71F) * (1.0F + 0.06F * drift);
    const float up = std::max(0.0F, static_cast<float>(place.along.normal.y));
    float light = glm::mix(side_light, 0.98F, up);
    light *= 0.66F + 0.34F * glm::smoothstep(slab_mm, slab_mm + 130.0F, height);
    light *= 0.74F + 0.26F * glm::smoothstep(2.0F, 46.0F, height_mm - 30.0F - height + 90.0F * up);
    return stone * light;
}

} // namespace

bake::SourceMesh make_hall_floor(std::int64_t triangles) {
    constexpr int texels = 1536;
    image::Image8 texture(texels, texels);
    paint_strip({0, texels}, texture, floor_colour);
    const Patch patch =
        sheet({hall_width_mm, floor_depth_mm}, 20.0, texels, [](const glm::dvec2& p, double back) {
            return glm::dvec3(p.x - 0.5 * hall_width_mm, 20.0 - back, p.y - 0.5 * floor_depth_mm);
        });
    // Rows run from the back to the front; columns to the right: the normal looks down unless they are swapped.
    Patch upward = patch;
    upward.at = [at = patch.at](double u, double v) { return at(1.0 - u, v); };
    return make_mesh({upward}, triangles, std::move(texture));
}

bake::SourceMesh make_hall_wall(std::int64_t triangles) {
    constexpr int texels = 1024;
    image::Image8 texture(texels, texels);
    paint_strip({0, texels}, texture, wall_colour);
    // Depth and height. Each strip between two corners is flat, so that few triangles have it exactly.
    constexpr std::array<glm::dvec2, 10> corners{{{54, 0},
                                                  {54, 122},
                                                  {20, 130},
                                                  {20, 1130},
                                                  {46, 1134},
                                                  {46, 1180},
                                                  {72, 1200},
                                                  {72, 1236},
                                                  {106, 1262},
                                                  {106, 1300}}};
    std::vector<Patch> strips;
    for (std::size_t k = 0; k + 1 < corners.size(); ++k) {
        Patch strip;
        strip.at = [low = corners[k], high = corners[k + 1]](double u, double v) {
            const glm::dvec2 at = v < 1.0 ? glm::mix(low, high, v) : high; // strips share their edges' points
            return SurfacePoint{
                {(u - 0.5) * hall_width_mm, at.y, at.x},
                {static_cast<float>(u), AtlasStrip{0, texels}.v(at.y / wall_height_mm, texels)}};
        };
        strip.length_u_mm = hall_width_mm;
        strip.length_v_mm = glm::distance(corners[k], corners[k + 1]);
        strip.min_v = 1;
        strip.columns_of = k == 0 ? -1 : 0;
        strips.push_back(std::move(strip));
    }
    return make_mesh(strips, triangles, std::move(texture));
}

bake::SourceMesh make_hall_ceiling(std::int64_t triangles) {
    constexpr int texels = 1024;
    image::Image8 texture(texels, texels);
    paint_strip({0, texels}, texture, ceiling_colour);
    const Patch patch =
        sheet({hall_width_mm, hall_width_mm}, 20.0, texels, [](const glm::dvec2& p, double back) {
            return glm::dvec3(p.x - 0.5 * hall_width_mm, back, p.y - 0.5 * hall_width_mm);
        });
    return make_mesh({patch}, triangles, std::move(texture));
}

bake::SourceMesh make_hall_plinth(std::int64_t triangles) {
    constexpr int texels = 512;
    const Turned body{.profile = Profile({{0, 0, true},
                                          {150, 0, true},
                                          {150, 12, true},
                                          {146, 16, true},
                                          {118, 18, true},
                                          {112, 24, true},
                                          {110, 300, true},
                                          {114, 306, true},
                                          {124, 310, true},
                                          {124, 336, true},
                                          {121, 340, true},
                                          {0, 340, true}}),
                      .strip = {0, texels},
                      .atlas_rows = texels};
    image::Image8 texture(texels, texels);
    paint_turned(body, texture, [](const TurnedPlace& place) {
        const double quarter = 4.0 * place.u + 0.5;
        const int side = static_cast<int>(quarter) % 4; // back, left, front, right
        constexpr std::array<float, 4> lights{0.55F, 0.74F, 0.86F, 0.64F};
        vec3 colour = stone_light(place, 340.0F, 20.0F, lights.at(static_cast<std::size_t>(side)));
        if (place.along.position.y < 19.0) { // the slab: darker towards the shaft
            const auto out = static_cast<float>(place.along.position.x) - 112.0F;
            colour = vec3(0.46F, 0.44F, 0.41F) * (0.45F + 0.55F * glm::smoothstep(0.0F, 36.0F, out));
        }
        return colour;
    });
    return make_mesh({squared(body, 8)}, triangles, std::move(texture));
}

bake::SourceMesh make_hall_pedestal(std::int64_t triangles) {
    constexpr int texels = 512;
    const Turned body{.profile = Profile({{0, 0, true},
                                          {80, 0, true},
                                          {80, 14, true},
                                          {74, 17},
                                          {77, 24},
                                          {74, 31, true},
                                          {60, 34, true},
                                          {57, 44},
                                          {52, 200},
                                          {49, 372, true},
                                          {52, 378},
                                          {66, 390, true},
                                          {72, 394, true},
                                          {72, 414, true},
                                          {70, 420, true},
                                          {0, 420, true}}),
                      .strip = {0, texels},
                      .atlas_rows = texels};
    image::Image8 texture(texels, texels);
    paint_turned(body, texture, [](const TurnedPlace& place) {
        const auto lit = static_cast<float>(0.5 + 0.5 * std::cos(place.angle + 0.5)); // from the front's left
        return stone_light(place, 420.0F, 30.0F, 0.44F + 0.46F * lit);
    });
    return make_mesh({turned(body)}, triangles, std::move(texture));
}

} // namespace frustumscreen::artifacts
