#include "assets_baked/artifacts/amphora_figures.h"
#include "assets_baked/artifacts/amphora_ornaments.h"
#include "assets_baked/artifacts/hall/turned.h"
#include "assets_baked/artifacts/hall/vessels.h"

#include <cmath>
#include <utility>

namespace frustumscreen::artifacts {
namespace {

using glm::vec2;
using glm::vec3;

constexpr int texture_size = 1024;
constexpr AtlasStrip walls{0, 944};
constexpr AtlasStrip handles{952, 64};

Profile profile() {
    return Profile({{0, 12},    {40, 11},       {62, 5, true},    {70, 0, true}, {76, 1},
                    {78, 8},    {74, 15},       {58, 20, true},   {40, 24},      {31, 32, true},
                    {33, 36},   {36, 38, true}, {62, 54},         {94, 84},      {112, 122},
                    {117, 160}, {119, 200},     {128, 236},       {147, 262},    {158, 268, true},
                    {161, 272}, {160, 279},     {154, 281, true}, {143, 274},    {124, 246},
                    {113, 205}, {110, 160},     {103, 122},       {84, 86},      {48, 56},
                    {0, 46}});
}

/// The frieze: warriors all around; x and y in mm.
void paint_frieze(Ink& ink, vec2 p, float around_mm) {
    constexpr int figures = 6;
    constexpr float height_mm = 92.0F;
    const float unit = around_mm / static_cast<float>(figures);
    const float number = std::floor(p.x / unit);
    const vec2 q = vec2(p.x - (number + 0.5F) * unit, p.y) / height_mm;
    const int which = ((static_cast<int>(number) % figures) + figures) % figures;
    if (which == 1 || which == 4) { // below the handles
        paint_handle_ornament(ink, {1.05F * q.x, 1.05F * q.y}, 0.012F);
    } else {
        paint_hoplite(ink, {which % 3 == 0 ? -q.x : q.x, q.y}, which, 0.012F); // two and two face each other
    }
}

/// Ornament and figures are left in the clay's colour; the ground around them is painted.
vec3 red_figure(const Ink& ink, float wear) {
    const vec3 black = vec3(0.125F, 0.115F, 0.112F) + 0.03F * wear;
    const vec3 clay = vec3(0.80F, 0.43F, 0.22F) * (1.0F + 0.07F * wear);
    const vec3 red(0.55F, 0.20F, 0.12F);
    const vec3 white(0.93F, 0.87F, 0.76F);
    return ink.share.x * black + ink.share.y * clay + ink.share.z * red + ink.share.w * white;
}

vec3 wall_colour(const TurnedPlace& place, double rim_mm) {
    const auto height = static_cast<float>(place.along.position.y);
    const auto length = static_cast<float>(place.along.length_mm);
    const auto u = static_cast<float>(place.u);
    const float wear = noise({u * 40.0F, length * 0.05F}, 40, 4, 211);
    Ink ink;
    if (place.along.length_mm < rim_mm) {
        constexpr float edge = 0.9F;
        constexpr float belly_mm = 736.0F; // around the frieze
        const float x = u * belly_mm;
        if (height > 112.0F && height < 212.0F) {
            paint_frieze(ink, {x, height - 116.0F}, belly_mm);
        }
        if (height > 92.0F && height < 112.0F) {
            paint_meander(ink, {x, height - 95.0F}, belly_mm / 46.0F, 13.0F, edge);
        }
        if (height > 38.0F && height < 74.0F) {
            paint_rays(ink, {x, height - 40.0F}, belly_mm / 24.0F, 32.0F, edge);
        }
        if (height > 214.0F && height < 222.0F) {
            paint_tongues(ink, {x, height - 214.0F}, belly_mm / 92.0F, 7.0F, edge);
        }
        if (height > 224.0F && height < 262.0F) {
            paint_lotus_chain(ink, {x, height - 225.0F}, belly_mm / 28.0F, 34.0F, edge);
        }
        if (height > 266.0F) {
            paint_tongues(ink, {x, height - 266.0F}, belly_mm / 64.0F, 11.0F, edge);
        }
        for (const float at : {264.5F, 92.5F, 110.5F, 213.0F, 223.0F}) {
            paint_line(ink, height, at, 1.6F, Pigment::Slip, edge);
        }
        if (height < 20.0F && height > 2.0F) {
            paint_line(ink, height, 10.0F, 7.0F, Pigment::Slip, edge);
        }
    }
    return red_figure(ink, wear);
}

/// A loop that leaves the wall low, runs outward and upward. `side` is +1 or -1: towards +X or -X.
Patch loop(double side) {
    return bar({.path =
                    [side](double t) {
                        const double a = (t - 0.5) * 0.56 * full_turn;
                        const double out = 106.0 + 42.0 * std::cos(a);
                        return glm::dvec3(side * out, 152.0 + 40.0 * std::cos(a), 62.0 * std::sin(a));
                    },
                .half_mm =
                    [](double t) {
                        const double end = std::exp(-14.0 * std::min(t, 1.0 - t));
                        return glm::dvec2(8.0, 7.0) * (1.0 + 0.7 * end);
                    },
                .side = {0.0, 1.0, 0.0},
                .length_mm = 190.0,
                .strip = handles,
                .atlas_rows = texture_size});
}

} // namespace

bake::SourceMesh make_krater(std::int64_t triangles) {
    const Turned body{.profile = profile(), .strip = walls, .atlas_rows = texture_size};
    image::Image8 texture(texture_size, texture_size, texel_of({0.13F, 0.12F, 0.115F}));
    const double rim_mm = body.profile.length_at_height(279.0);
    paint_turned(body, texture, [rim_mm](const TurnedPlace& place) { return wall_colour(place, rim_mm); });
    return make_mesh({turned(body), loop(1.0), loop(-1.0)}, triangles, std::move(texture));
}

} // namespace frustumscreen::artifacts
