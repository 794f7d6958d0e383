#include "assets_baked/artifacts/amphora.h"

#include "assets_baked/artifacts/amphora_paint.h"
#include "assets_baked/artifacts/profile.h"
#include "assets_baked/artifacts/surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

namespace frustumscreen::artifacts {
namespace {

namespace atlas = amphora_atlas;
constexpr double turn = 6.283185307179586;

/// One line from the middle of the underside over foot, body and lip into the mouth, cut in three. Values are
/// radius, height.
Profile underside_profile() {
    return Profile({{0, 11}, {25, 10}, {38, 5, true}, {43, 0.6}, {46, 0}});
}

Profile body_profile() {
    return Profile({{46, 0, true},      {50.5, 0.8},      {52, 4},           {50, 9},
                    {43, 13.5},         {36, 15.5, true}, {35.2, 17},        {36.2, 18.5},
                    {35.2, 20.5, true}, {38, 27},         {49, 50},          {67, 84},
                    {83, 118},          {92.5, 152},      {94.5, 178},       {89, 204},
                    {76, 225},          {60, 238},        {47, 243, true},   {45.2, 243.7},
                    {44.2, 245},        {44.6, 246.6},    {42, 247.6, true}, {39.6, 256},
                    {37.8, 270},        {37.6, 284},      {39.4, 297},       {42, 304, true},
                    {45, 306.5},        {52.5, 313},      {57, 321},         {57.6, 326},
                    {55.5, 329.4},      {52, 330}});
}

Profile mouth_profile() {
    return Profile({{52, 330, true},
                    {49.6, 328.6},
                    {47, 323},
                    {40, 312},
                    {34.4, 300},
                    {32.6, 284},
                    {32.8, 268},
                    {35, 252},
                    {42, 242},
                    {58, 232},
                    {72, 221},
                    {84, 203},
                    {88, 178},
                    {86, 152},
                    {76, 118},
                    {60, 84},
                    {42, 52},
                    {26, 34},
                    {0, 28}});
}

glm::dvec3 around_axis(double radius, double height, double angle) {
    return {radius * std::cos(angle), height, -radius * std::sin(angle)};
}

Patch turned(const Profile& profile, const AtlasStrip& strip) {
    Patch patch;
    patch.at = [profile, strip](double u, double v) {
        const Profile::Point p = profile.at_row(v);
        const double angle = u < 1.0 ? u * turn : 0.0; // the seam's two sides are equal points
        return SurfacePoint{around_axis(p.position.x, p.position.y, angle),
                            {static_cast<float>(u), strip.v(p.length_mm / profile.length_mm(), atlas::size)}};
    };
    patch.length_v_mm = profile.length_mm();
    return patch;
}

Patch body_patch(const Profile& profile, const std::shared_ptr<const ReliefMap>& relief) {
    Patch patch;
    patch.at = [profile, relief](double u, double v) {
        const Profile::Point p = profile.at_row(v);
        const double from_top = 1.0 - p.length_mm / profile.length_mm();
        // No relief at the two edges, which are shared with other patches.
        const double fade = std::min({1.0, 40.0 * from_top, 40.0 * (1.0 - from_top)});
        const double around = u < 1.0 ? u : 0.0;
        const glm::dvec2 at = p.position + p.normal * (fade * relief->sample(around, from_top));
        return SurfacePoint{around_axis(at.x, at.y, around * turn),
                            {static_cast<float>(u), atlas::body.v(from_top, atlas::size)}};
    };
    patch.length_u_mm = turn * 80.0;
    patch.length_v_mm = profile.length_mm();
    patch.min_u = 12;
    patch.min_v = 12;
    return patch;
}

/// The handle's centre line, in the profile's half-plane: out of the neck, up, and down to the shoulder.
class HandlePath {
public:
    struct Point {
        glm::dvec2 position, direction;
    };
    [[nodiscard]] static Point at(double t) {
        constexpr std::array<glm::dvec2, 4> p = {
            {{33.8, 288.0}, {82.0, 309.0}, {94.0, 272.0}, {74.5, 219.0}}};
        const double s = 1.0 - t;
        const glm::dvec2 position =
            s * s * s * p[0] + 3.0 * s * s * t * p[1] + 3.0 * s * t * t * p[2] + t * t * t * p[3];
        const glm::dvec2 direction =
            s * s * (p[1] - p[0]) + 2.0 * s * t * (p[2] - p[1]) + t * t * (p[3] - p[2]);
        return {position, glm::normalize(direction)};
    }
};

/// A strap with three reeds that widens into the wall at both ends. `side` is +1 or -1: towards +X or -X.
Patch handle_patch(double side) {
    Patch patch;
    patch.at = [side](double u, double v) {
        const double phi = u < 1.0 ? u * turn : 0.0;
        const HandlePath::Point p = HandlePath::at(v);
        const double from_end = std::min(v, 1.0 - v) * 110.0; // about mm
        const double swell = 1.0 + 0.75 * std::exp(-from_end / 5.5);
        const double across = std::sin(phi);
        const double out = std::cos(phi); // +1 on the side away from the body
        const double reeds =
            out > -0.2 ? 0.75 * std::cos(3.0 * turn * across * 0.47) * glm::smoothstep(-0.2, 0.4, out) : 0.0;
        const double thick = (4.6 + reeds) * swell * out;
        const double wide = 9.6 * swell * across;
        const glm::dvec2 outward = {-p.direction.y, p.direction.x}; // left of the path to the shoulder
        const glm::dvec2 at = p.position + outward * thick;
        // Bent around the axis: the ends have a constant depth below the round wall.
        const double x = std::sqrt(std::max(0.0, at.x * at.x - wide * wide));
        return SurfacePoint{{side * x, at.y, side * wide},
                            {static_cast<float>(v), atlas::handle.v(u, atlas::size)}};
    };
    patch.length_u_mm = 48.0;
    patch.length_v_mm = 120.0;
    patch.min_u = 7;
    patch.min_v = 8;
    return patch;
}

} // namespace

bake::SourceMesh make_amphora(std::int64_t triangles) {
    const Profile body = body_profile();
    AmphoraSkin skin = paint_amphora(body);
    const auto relief = std::make_shared<const ReliefMap>(std::move(skin.body_relief_mm));

    std::vector<Patch> patches = {body_patch(body, relief), turned(mouth_profile(), atlas::mouth),
                                  turned(underside_profile(), atlas::underside), handle_patch(1.0),
                                  handle_patch(-1.0)};
    patches[1].columns_of = 0;
    patches[1].length_v_mm *= 0.4; // hardly any of it is visible
    patches[1].min_v = 8;
    patches[1].pole_at_end = true;
    patches[2].columns_of = 0;
    patches[2].min_v = 3;
    patches[2].length_v_mm *= 0.4;
    patches[2].pole_at_start = true;
    return make_mesh(patches, triangles, std::move(skin.texture));
}

image::Image8 new_amphora_colours() {
    return paint_new_amphora(body_profile());
}

} // namespace frustumscreen::artifacts
