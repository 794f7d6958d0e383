#include "assets_baked/artifacts/hall/sculptures.h"
#include "assets_baked/artifacts/hall/turned.h"
#include "assets_baked/artifacts/ink.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace frustumscreen::artifacts {
namespace {

using glm::vec2;
using glm::vec3;

constexpr int texture_size = 1024;
constexpr AtlasStrip whole{0, 1024};

/// Half widths and depths of the body at its heights, as profiles from the base to the top of the head.
const Profile& widths() {
    static const Profile profile(
        {{0, 0, true}, {30, 0, true}, {32, 3},   {32, 15},  {29, 19, true}, {20, 22},    {18, 30},  {22, 58},
         {26, 84},     {23, 104},     {25, 118}, {36, 150}, {46, 180},      {47, 196},   {41, 216}, {45, 238},
         {57, 262},    {62, 276},     {58, 288}, {38, 298}, {20, 305},      {17.5, 318}, {18, 330}, {22, 340},
         {29, 356},    {35, 378},     {38, 398}, {37, 412}, {30, 422},      {16, 427},   {0, 428}});
    return profile;
}

double bump(double x, double width) {
    return std::exp(-x * x / (width * width));
}

double depth_at(double height) {
    static const Profile depths({{24, 0},   {24, 18},  {16, 22},  {14, 40},  {17, 66},  {15, 104}, {18, 130},
                                 {23, 168}, {24, 190}, {18, 216}, {20, 240}, {20, 270}, {16, 292}, {14, 306},
                                 {14, 330}, {17, 350}, {20, 380}, {20, 410}, {16, 424}, {6, 428}});
    return depths.at_length(depths.length_at_height(height)).position.x;
}

/// The knees are bent, and the head leans back.
double lean_at(double height) {
    return 4.0 * bump(height - 96.0, 40.0) - 5.0 * bump(height - 190.0, 50.0) -
           0.10 * std::max(0.0, height - 330.0);
}

/// Height of what is carved, in mm; x across, from the middle; `front` 1 in front, 0 behind, between at the sides.
double carved(double x, double y, double front, double half) {
    const double side = std::abs(x);
    const double back = 1.0 - front;
    double height = 0.0;
    // Legs part below the hips; the cleft is deeper in front.
    height -= (5.0 * front + 4.0 * back) * bump(x, 2.6) * glm::smoothstep(172.0, 150.0, y) *
              glm::smoothstep(17.0, 26.0, y);
    // Knees and the line of the hips.
    height += 2.2 * front * bump(side - 12.0, 8.0) * bump(y - 96.0, 12.0);
    height -= 1.6 * front * bump(y - 178.0 - 0.55 * side + 8.0, 2.2) * glm::smoothstep(46.0, 36.0, side) *
              glm::smoothstep(2.0, 6.0, side);
    // Forearms, the left above the right, and upper arms that a groove parts from the chest.
    const auto forearm = [&](double at) {
        return 4.4 * front * std::sqrt(bump(y - at, 8.0)) * glm::smoothstep(0.98, 0.84, side / half);
    };
    height += std::max(forearm(226.0), forearm(243.0));
    height -= 2.0 * front * bump(y - 234.5, 1.8) * glm::smoothstep(0.95, 0.80, side / half);
    height -= 2.4 * front * bump(side / half - 0.70, 0.05) * bump(y - 262.0, 13.0);
    // Breasts.
    height += 5.0 * front * bump(side - 19.0, 8.5) * bump(y - 266.0, 8.5);
    // The neck's line, the nose, the flat face.
    height -= 1.2 * bump(y - 303.0 + 0.15 * side * front, 2.0) * glm::smoothstep(30.0, 20.0, side);
    const double nose = glm::smoothstep(360.0, 366.0, y) * glm::smoothstep(404.0, 392.0, y);
    height += front * nose * (9.0 - 0.14 * (y - 366.0)) * bump(x, 5.2);
    // The backbone.
    height -= 2.2 * back * bump(x, 3.0) * glm::smoothstep(180.0, 196.0, y) * glm::smoothstep(290.0, 280.0, y);
    return height;
}

/// Feet and body in one; the base is a low block.
glm::dvec3 at(double u, const Profile::Point& along) {
    const double a = ((u < 1.0 ? u : 0.0) - 0.5) * full_turn;
    const double y = along.position.y;
    const double half = along.position.x;
    const double depth = std::min(depth_at(y), 0.9 * half);
    const double out = std::cos(a);
    const double front = glm::smoothstep(-0.15, 0.35, out);
    const double x = half * std::sin(a);
    const double face = std::copysign(std::pow(std::abs(out), 0.8), out);
    double z = depth * face + lean_at(y);
    const double fade = std::min(1.0, half / 12.0) * glm::smoothstep(15.0, 26.0, y);
    z += (out >= 0.0 ? 1.0 : -1.0) * fade * std::sqrt(std::abs(out)) *
         carved(x, y, out >= 0.0 ? front : 0.0, std::max(half, 1.0));
    return {x, y, z};
}

/// Dirt in what is carved: more where the neighbourhood is higher, 0..0.5.
float hollow(double u, const glm::dvec2& width) {
    const double a = (u - 0.5) * full_turn;
    const double half = width.x;
    const double y = width.y;
    const double front = std::cos(a) >= 0.0 ? glm::smoothstep(-0.15, 0.35, std::cos(a)) : 0.0;
    const double x = half * std::sin(a);
    const auto height = [&](double dx, double dy) {
        return carved(x + dx, y + dy, front, std::max(half, 1.0));
    };
    constexpr double reach = 3.2;
    const double around =
        0.25 * (height(reach, 0.0) + height(-reach, 0.0) + height(0.0, reach) + height(0.0, -reach));
    return static_cast<float>(std::clamp(0.42 * (around - height(0.0, 0.0)), 0.0, 0.5));
}

} // namespace

bake::SourceMesh make_figurine(std::int64_t triangles) {
    image::Image8 texture(texture_size, texture_size);
    paint_strip(whole, texture, [](float u, float v) {
        const glm::dvec2 width = widths().at_length(static_cast<double>(v) * widths().length_mm()).position;
        const double y = width.y;
        const vec2 p(u * 6.0F, static_cast<float>(y) * 0.016F);
        const float drift = noise(p, 6, 5, 701);
        const float grain = noise({u * 160.0F, static_cast<float>(y) * 0.5F}, 160, 2, 702);
        const float earth = noise(p * 3.0F, 18, 4, 703);
        vec3 colour = vec3(0.90F, 0.86F, 0.78F) * (1.0F + 0.07F * drift + 0.025F * grain);
        colour = glm::mix(colour, vec3(0.66F, 0.52F, 0.36F), std::clamp(0.9F * earth - 0.10F, 0.0F, 0.32F));
        return colour * (y < 18.5 ? 0.86F : 1.0F - hollow(static_cast<double>(u), width));
    });
    Patch patch;
    patch.at = [](double u, double v) {
        const Profile::Point along = widths().at_row(v);
        return SurfacePoint{
            at(u, along),
            {static_cast<float>(u), whole.v(along.length_mm / widths().length_mm(), texture_size)}};
    };
    patch.length_u_mm = 300.0;
    patch.length_v_mm = 560.0;
    patch.min_u = 20;
    patch.min_v = 24;
    patch.pole_at_start = true;
    patch.pole_at_end = true;
    return make_mesh({patch}, triangles, std::move(texture));
}

} // namespace frustumscreen::artifacts
