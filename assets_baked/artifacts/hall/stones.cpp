#include "assets_baked/artifacts/hall/sculptures.h"
#include "assets_baked/artifacts/hall/turned.h"
#include "assets_baked/artifacts/ink.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace frustumscreen::artifacts {
namespace {

using glm::vec2;
using glm::vec3;

constexpr int texture_size = 1024;
constexpr AtlasStrip whole{0, 1024};

vec2 around(const TurnedPlace& place, float cells, float mm_per_cell) {
    return {static_cast<float>(place.u) * cells, static_cast<float>(place.along.length_mm) / mm_per_cell};
}

// ---- the drum

constexpr double drum_height_mm = 300.0;

/// How deep a place lies in its flute: 0 on the sharp edge between two, 1 in the middle. There are 20.
double flute_at(const TurnedPlace& place) {
    const double across = 2.0 * std::abs(place.u * 20.0 - std::floor(place.u * 20.0) - 0.5);
    return std::sqrt(1.0 - across * across * 0.94) * (1.0 - across * across);
}

double flutes(const TurnedPlace& place) {
    const double height = place.along.position.y;
    const double radius = place.along.position.x;
    if (radius < 150.0) {
        return 0.0;
    }
    const double chipped = static_cast<double>(noise(around(place, 40.0F, 24.0F), 40, 4, 602));
    const double edge = std::min(height, drum_height_mm - height);
    const double broken = -16.0 * std::max(0.0, chipped - 0.24) * std::exp(-edge / 18.0);
    const double fluted = glm::smoothstep(20.0, 27.0, edge); // a plain band at either end
    return (-13.0 * fluted * flute_at(place) + broken) * glm::smoothstep(150.0, 166.0, radius);
}

vec3 marble(vec2 p, int period, float scale) {
    const float drift = noise(p, period, 5, 611);
    const float warp = noise(p * 2.0F, 2 * period, 4, 612);
    const float vein_at = std::abs(noise(p * vec2(1.0F, 0.6F) + vec2(0.0F, 0.8F * warp), period, 4, 613));
    const float vein = glm::smoothstep(0.030F, 0.0F, vein_at) * scale;
    const vec3 ground = vec3(0.87F, 0.84F, 0.78F) * (1.0F + 0.08F * drift);
    return glm::mix(ground, vec3(0.62F, 0.60F, 0.58F), 0.45F * vein);
}

vec3 drum_colour(const TurnedPlace& place) {
    const double radius = place.along.position.x;
    const bool end = radius < 158.0;
    vec3 colour = marble(around(place, 30.0F, 32.0F), 30, 0.7F);
    const float stain = noise(around(place, 60.0F, 12.0F), 60, 5, 621);
    colour = glm::mix(colour, vec3(0.70F, 0.59F, 0.44F), std::clamp(0.10F + 0.30F * stain, 0.0F, 0.3F));
    if (!end) {
        const double edge = std::min(place.along.position.y, drum_height_mm - place.along.position.y);
        colour *= 1.0F - 0.30F * static_cast<float>(glm::smoothstep(20.0, 27.0, edge) * flute_at(place));
    } else if (radius > 112.0) {
        colour *= 0.97F; // the band that carries the next drum is smoother
    } else {
        colour *= 0.88F + 0.10F * noise(around(place, 90.0F, 5.0F), 90, 3, 622);
    }
    if (radius < 24.0 && place.along.position.y > 200.0) {
        colour *= 0.45F;
    }
    return colour;
}

// ---- the pyramid

constexpr int steps = 9;
constexpr double half_base_mm = 150.0;
constexpr double half_top_mm = 42.0;
constexpr double rise_mm = 17.0;
constexpr double stair_share = 0.24; ///< of a side

Profile pyramid_profile() {
    std::vector<ProfileKnot> knots{{0, 0, true}, {half_base_mm, 0, true}};
    for (int k = 0; k < steps; ++k) {
        const double out = glm::mix(half_base_mm, half_top_mm, static_cast<double>(k) / steps);
        const double next = glm::mix(half_base_mm, half_top_mm, (k + 1.0) / steps);
        knots.push_back({out - 2.0, (k + 1) * rise_mm - 1.2, true});
        knots.push_back({out - 3.0, (k + 1) * rise_mm, true});
        knots.push_back({next, (k + 1) * rise_mm, true});
    }
    const double top = steps * rise_mm;
    for (const auto& [radius, height] : {std::pair{34.0, 0.0},
                                         {34.0, 4.0},
                                         {31.0, 4.0},
                                         {31.0, 26.0},
                                         {34.0, 26.0},
                                         {34.0, 34.0},
                                         {28.0, 37.0},
                                         {28.0, 42.0},
                                         {0.0, 42.0}}) {
        knots.push_back({radius, top + height, true});
    }
    return Profile(knots);
}

double across_of(const TurnedPlace& place) { // -1..1 over a side
    const double quarter = 4.0 * place.u + 0.5;
    return 2.0 * (quarter - std::floor(quarter)) - 1.0;
}

/// The stairs lie on the steps: a slope from the ground to the top, with a low wall on either side.
glm::dvec2 on_stair(const TurnedPlace& place, const glm::dvec2& at) {
    constexpr double top_mm = steps * rise_mm;
    const double across = std::abs(across_of(place));
    if (across > stair_share || at.y < 0.5 || at.y > top_mm) {
        return at;
    }
    const double wall = across > 0.78 * stair_share ? 4.0 : 0.0;
    // One step farther out than the steps' own edges.
    const double slope = glm::mix(half_base_mm, half_top_mm, at.y / top_mm - 1.0 / steps) + 3.0 + wall;
    return {std::max(at.x, slope), at.y};
}

vec3 pyramid_colour(const TurnedPlace& place) {
    const double across = std::abs(across_of(place));
    const auto height = static_cast<float>(place.along.position.y);
    const auto half = static_cast<float>(place.along.position.x);
    constexpr auto top_mm = static_cast<float>(steps * rise_mm);
    const float drift = noise(around(place, 32.0F, 22.0F), 32, 5, 631);
    vec3 colour = vec3(0.74F, 0.66F, 0.52F) * (1.0F + 0.14F * drift);
    const bool stair = across < stair_share && height < top_mm && height > 0.5F;
    if (stair && across < 0.78 * stair_share) {
        const float step = height / 5.1F - std::floor(height / 5.1F);
        colour *= 0.55F + 0.55F * glm::smoothstep(0.0F, 0.5F, step);
    } else if (!stair) {
        // Blocks: courses of 5.7 mm, each shifted by half a block.
        const float course = height / (static_cast<float>(rise_mm) / 3.0F);
        const float along = static_cast<float>(across_of(place)) * half / 11.0F + 0.5F * std::floor(course);
        const float joint = std::min(0.5F - std::abs(course - std::floor(course) - 0.5F),
                                     2.0F * (0.5F - std::abs(along - std::floor(along) - 0.5F)));
        colour *= 0.80F + 0.20F * glm::smoothstep(0.04F, 0.14F, joint);
        colour = glm::mix(colour, vec3(0.42F, 0.44F, 0.32F),
                          std::clamp(0.8F * drift - 0.12F, 0.0F, 0.35F)); // moss
    }
    if (height > top_mm + 3.9F && height < top_mm + 22.0F && half > 30.0F && half < 32.0F && across < 0.26) {
        colour = vec3(0.13F, 0.10F, 0.08F); // the temple's doors
    }
    if (height > top_mm + 26.5F && height < top_mm + 33.5F && half > 33.0F) {
        const float tooth =
            std::abs(std::fmod(std::abs(static_cast<float>(across_of(place))) * 6.0F, 2.0F) - 1.0F);
        colour = glm::mix(colour, vec3(0.62F, 0.24F, 0.16F), glm::smoothstep(0.42F, 0.52F, tooth));
    }
    return colour;
}

// ---- the tablet

constexpr double tablet_half_x_mm = 46.0;
constexpr double tablet_half_z_mm = 15.0;
constexpr double tablet_height_mm = 128.0;

std::uint32_t mixed(std::uint32_t x, std::uint32_t y) {
    std::uint32_t h = x * 0x9E3779B1U ^ y * 0x85EBCA77U;
    h ^= h >> 15U;
    h *= 0x2C1B3C6DU;
    return h ^ (h >> 13U);
}

/// How deep a wedge that points along `to` from `from` is pressed in at p: its head is broad and deep.
float wedge(vec2 p, vec2 from, vec2 to) {
    const vec2 axis = to - from;
    const float length = glm::length(axis);
    const vec2 along = axis / length;
    const float t = glm::dot(p - from, along);
    const float across = std::abs(along.x * (p.y - from.y) - along.y * (p.x - from.x));
    const float half = std::max(0.50F, 1.65F - 0.8F * t);
    const float inside = std::min({half - across, t + 0.2F, length - t});
    return std::clamp(inside / 0.7F, 0.0F, 1.0F) * std::clamp(1.2F - t / length, 0.35F, 1.0F);
}

/// Depth of the writing, 0..1, at x and y in mm on a face; lines of 10.8 mm, signs of 9.3 mm with one to four wedges each.
float writing(vec2 p, std::uint32_t face) {
    constexpr float scale = 1.5F;
    constexpr float line_mm = 7.2F;
    constexpr float sign_mm = 6.2F;
    if (std::abs(p.x) > 38.5F || p.y < 11.0F || p.y > 118.0F) {
        return 0.0F;
    }
    p = (p - glm::vec2(0.0F, 10.5F)) / scale;
    const float line = std::floor(p.y / line_mm);
    const float y = p.y - line * line_mm;
    float depth = 0.55F * cover(std::abs(y) - 0.16F, 0.5F); // the ruled line
    for (int step = -1; step <= 1; ++step) {
        const float sign = std::floor((p.x + 100.0F) / sign_mm) + static_cast<float>(step);
        const std::uint32_t h =
            mixed(static_cast<std::uint32_t>(sign) + 64U * face, static_cast<std::uint32_t>(line));
        const vec2 q(p.x + 100.0F - sign * sign_mm, y);
        if (h % 7U == 0U) {
            depth = std::max(depth, wedge(q, {1.2F, 5.6F}, {3.8F, 2.8F}));
            depth = std::max(depth, wedge(q, {4.4F, 5.8F}, {4.4F, 1.2F}));
            continue;
        }
        if ((h & 1U) != 0U) {
            depth = std::max(depth, wedge(q, {2.0F, 6.0F}, {2.0F, 1.4F}));
        }
        if ((h & 2U) != 0U) {
            depth = std::max(depth, wedge(q, {0.9F, 4.4F}, {5.6F, 4.4F}));
        }
        if ((h & 4U) != 0U) {
            depth = std::max(depth, wedge(q, {4.6F, 6.2F}, {4.6F, 2.4F}));
        }
        if ((h & 8U) != 0U) {
            depth = std::max(depth, wedge(q, {1.0F, 2.2F}, {5.4F, 2.2F}));
        }
    }
    return depth;
}

struct TabletPlace {
    glm::dvec3 position{0.0};
    float depth = 0.0F;
};

/// A rounded rectangle, by its length from the back's middle over the left side, the front and the right side.
glm::dvec2 tablet_section(double u) {
    constexpr double r = 8.0;
    constexpr double x = tablet_half_x_mm - r;
    constexpr double z = tablet_half_z_mm - r;
    constexpr double quarter_arc = 0.25 * full_turn * r;
    constexpr double around_mm = 4.0 * (x + z + quarter_arc);
    double at = (u < 1.0 ? u : 0.0) * around_mm;
    const bool right = at > 0.5 * around_mm;
    at = right ? around_mm - at : at; // the right half mirrors the left one
    glm::dvec2 place(0.0);            // x to the left, z
    if (at < x) {
        place = {at, -tablet_half_z_mm};
    } else if (at < x + quarter_arc) {
        const double a = (at - x) / r;
        place = {x + r * std::sin(a), -z - r * std::cos(a)};
    } else if (at < x + quarter_arc + 2.0 * z) {
        place = {tablet_half_x_mm, at - x - quarter_arc - z};
    } else if (at < x + 2.0 * quarter_arc + 2.0 * z) {
        const double a = (at - x - quarter_arc - 2.0 * z) / r;
        place = {x + r * std::cos(a), z + r * std::sin(a)};
    } else {
        place = {2.0 * x + 2.0 * quarter_arc + 2.0 * z - at, tablet_half_z_mm};
    }
    return {right ? place.x : -place.x, place.y};
}

const Profile& tablet_profile() {
    static const Profile profile({{0, 0, true},
                                  {36, 0.4, true},
                                  {42, 2},
                                  {45, 6},
                                  {46, 14, true},
                                  {46, 114, true},
                                  {45, 122},
                                  {42, 126},
                                  {36, 127.6, true},
                                  {0, 128}});
    return profile;
}

TabletPlace tablet_at(double u, const Profile::Point& along) {
    const double share = along.position.x / tablet_half_x_mm;
    const glm::dvec2 section = tablet_section(u) * share;
    glm::dvec3 position(section.x, along.position.y, section.y);
    const double up = along.position.y / (0.5 * tablet_height_mm) - 1.0;
    const double side = position.x / tablet_half_x_mm;
    position.z *= 1.0 + 0.22 * (1.0 - side * side) * (1.0 - up * up);
    const bool front = position.z > 0.0;
    const bool on_face = std::abs(section.y) > 0.995 * tablet_half_z_mm;
    const float depth =
        on_face
            ? writing({static_cast<float>(front ? position.x : -position.x), static_cast<float>(position.y)},
                      front ? 0U : 1U)
            : 0.0F;
    position.z -= (front ? 1.0 : -1.0) * 1.5 * static_cast<double>(depth);
    return {position, depth};
}

} // namespace

bake::SourceMesh make_column_drum(std::int64_t triangles) {
    const Turned body{.profile = Profile({{0, 4},
                                          {100, 4},
                                          {150, 2},
                                          {166, 0, true},
                                          {170, 3},
                                          {170, 297},
                                          {166, 300, true},
                                          {114, 300, true},
                                          {110, 297.5, true},
                                          {60, 297},
                                          {22, 298, true},
                                          {20, 296, true},
                                          {20, 262, true},
                                          {0, 260}}),
                      .strip = whole,
                      .atlas_rows = texture_size,
                      .raised_mm = flutes};
    image::Image8 texture(texture_size, texture_size);
    paint_turned(body, texture, drum_colour);
    return make_mesh({turned(body)}, triangles, std::move(texture));
}

bake::SourceMesh make_step_pyramid(std::int64_t triangles) {
    const Turned body{
        .profile = pyramid_profile(), .strip = whole, .atlas_rows = texture_size, .moved = on_stair};
    image::Image8 texture(texture_size, texture_size);
    paint_turned(body, texture, pyramid_colour);
    return make_mesh({squared(body, 26)}, triangles, std::move(texture));
}

bake::SourceMesh make_tablet(std::int64_t triangles) {
    image::Image8 texture(texture_size, texture_size);
    paint_strip(whole, texture, [](float u, float v) {
        const Profile& profile = tablet_profile();
        const TabletPlace place = tablet_at(static_cast<double>(u),
                                            profile.at_length(static_cast<double>(v) * profile.length_mm()));
        const vec3 at = vec3(place.position) / 9.0F; // the pattern of space: at the ends there are no rays
        const float drift = noise({at.x + 0.7F * at.z + 32.0F, at.y + 0.7F * at.z + 32.0F}, 4096, 5, 641);
        const vec3 clay = vec3(0.72F, 0.56F, 0.41F) * (1.0F + 0.16F * drift);
        return glm::mix(clay, vec3(0.24F, 0.15F, 0.09F), 0.85F * place.depth);
    });
    Patch patch;
    patch.at = [](double u, double v) {
        const Profile& profile = tablet_profile();
        const Profile::Point along = profile.at_row(v);
        return SurfacePoint{
            tablet_at(u, along).position,
            {static_cast<float>(u), whole.v(along.length_mm / profile.length_mm(), texture_size)}};
    };
    patch.length_u_mm = 240.0;
    patch.length_v_mm = 140.0;
    patch.min_u = 16;
    patch.min_v = 10;
    patch.pole_at_start = true;
    patch.pole_at_end = true;
    return make_mesh({patch}, triangles, std::move(texture));
}

} // namespace frustumscreen::artifacts
