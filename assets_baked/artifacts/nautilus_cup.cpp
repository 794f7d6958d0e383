#include "assets_baked/artifacts/nautilus_cup.h"

#include "assets_baked/artifacts/nautilus_cup_paint.h"
#include "assets_baked/artifacts/profile.h"
#include "assets_baked/artifacts/surface.h"

#include <algorithm>
#include <cmath>

namespace frustumscreen::artifacts {
namespace {

namespace atlas = cup_atlas;
using glm::dvec2;
using glm::dvec3;
constexpr double turn = 6.283185307179586;

/// The shell: a whorl whose section grows threefold per turn. Angle `theta` (radians along the spiral) is 0
/// at the mouth and negative inside; `phi` goes around the section from the keel (0) to the coil (+-pi).
/// Source: the logarithmic spiral of molluscan shells (Moseley 1838).
namespace shell {
constexpr double growth = 0.17484955; ///< ln 3 / (2 pi)
constexpr double centre_radius_mm = 66.0;
constexpr double radial_mm = 44.0;
constexpr double axial_mm = 42.0;
constexpr double wall_mm = 1.5;
constexpr double first_theta = -1.4 * turn;
constexpr double septum_theta = -2.3;
constexpr double mouth_direction = 0.10; ///< radians above the horizontal
const dvec3 coil_mm{-14.0, 196.0, 0.0};

/// The mouth's edge: set back on the keel and at the coil, forward on the flanks.
double lip_theta(double phi) {
    const auto bump = [phi](double at, double width) {
        const double x = (std::abs(phi) - at) / width;
        return std::exp(-x * x);
    };
    return 0.10 * bump(1.15, 0.55) - 0.10 * bump(0.0, 0.40) - 0.25 * bump(3.14, 0.7);
}

dvec3 bare(double theta, double phi) {
    const double scale = std::exp(growth * theta);
    const double out = std::cos(phi);
    const double radius = scale * (centre_radius_mm + radial_mm * out);
    const double z =
        scale * axial_mm * std::sin(phi) * (1.0 + 0.08 * out); // slightly fuller towards the keel
    const double direction = mouth_direction + theta;
    return {radius * std::cos(direction), radius * std::sin(direction), z};
}

dvec3 normal(double theta, double phi) {
    constexpr double h = 1e-4;
    const dvec3 along = bare(theta + h, phi) - bare(theta - h, phi);
    const dvec3 around = bare(theta, phi + h) - bare(theta, phi - h);
    return glm::normalize(glm::cross(along, around));
}

/// The point `height` mm (at the mouth's scale) above the outer wall.
dvec3 at(double theta, double phi, double height) {
    return coil_mm + bare(theta, phi) + normal(theta, phi) * (height * std::exp(growth * theta));
}

/// Fine growth lines, and broader swellings where growth paused.
double growth_lines_mm(double theta) {
    return 0.06 * std::sin(theta * 260.0) + 0.10 * std::sin(theta * 61.0 + 1.7 * std::sin(theta * 9.0));
}

float u_of(double theta) {
    const double first = std::exp(growth * first_theta);
    return static_cast<float>(0.004 + 0.99 * (std::exp(growth * theta) - first) / (1.025 - first));
}
} // namespace shell

double phi_of(double v) {
    return v < 1.0 ? (v - 0.5) * turn : -0.5 * turn;
}

Patch shell_outside() {
    Patch patch;
    patch.at = [](double u, double v) {
        const double phi = phi_of(u);
        const double lip = shell::lip_theta(phi);
        const double theta = lip + (shell::first_theta - lip) * (1.0 - std::pow(1.0 - v, 0.8));
        return SurfacePoint{shell::at(theta, phi, shell::growth_lines_mm(theta)),
                            {shell::u_of(theta), atlas::outside.v(u, atlas::size)}};
    };
    patch.length_u_mm = 220.0;
    patch.length_v_mm = 420.0;
    patch.min_u = 9;
    patch.min_v = 14;
    return patch;
}

/// The septum that closes the body chamber, hollow like a bowl, and the wall from its rim to the lip.
Patch shell_inside() {
    Patch patch;
    patch.at = [](double u, double v) {
        constexpr double septum_share = 0.2;
        const double phi = phi_of(u);
        const double lip = shell::lip_theta(phi);
        const double along = std::max(0.0, (v - septum_share) / (1.0 - septum_share));
        const double theta = glm::mix(shell::septum_theta, lip, along);
        dvec3 position = shell::at(theta, phi, -shell::wall_mm);
        const double inwards =
            std::max(0.0, 1.0 - v / septum_share); // 0 at the septum's rim, 1 in its middle
        if (inwards > 0.0) {
            const auto middle_of = [](double at) {
                return shell::coil_mm + 0.5 * (shell::bare(at, 0.0) + shell::bare(at, 0.5 * turn));
            };
            const dvec3 middle = middle_of(theta);
            const dvec3 depth = middle_of(theta - 0.4) - middle;
            position = glm::mix(position, middle, inwards) + depth * std::sin(0.25 * turn * inwards);
        }
        return SurfacePoint{position, {shell::u_of(theta - 0.5 * inwards), atlas::inside.v(u, atlas::size)}};
    };
    patch.length_u_mm = 200.0;
    patch.length_v_mm = 210.0;
    patch.min_u = 9;
    patch.min_v = 8;
    patch.pole_at_start = true;
    patch.columns_of = 0;
    return patch;
}

/// The gilded band that clasps the lip: a flattened tube along it.
Patch lip_mount() {
    Patch patch;
    patch.at = [](double u, double v) {
        const double phi = phi_of(v);
        const double a = u < 1.0 ? u * turn : 0.0;
        const double lip = shell::lip_theta(phi);
        const double back_mm = 2.6 + 3.2 * std::cos(a); // reaches further down the wall than above it
        const double height =
            -0.5 * shell::wall_mm + 2.0 * std::sin(a) +
            0.35 * std::pow(std::abs(std::sin(26.0 * phi)), 3.0) * std::max(0.0, std::sin(a));
        return SurfacePoint{
            shell::at(lip - (back_mm - 2.4) / 95.0, phi, height),
            {static_cast<float>(4.0 * v), atlas::straps.v(0.5 + 0.49 * std::sin(a), atlas::size)}};
    };
    patch.length_u_mm = 17.0;
    patch.length_v_mm = 270.0;
    patch.min_u = 4;
    patch.min_v = 12;
    return patch;
}

/// A strap over the shell, from `from` to `to`, both (theta, phi); `across` is its half width in the same
/// angles.
Patch strap(dvec2 from, dvec2 to, dvec2 across, double length_mm) {
    Patch patch;
    patch.at = [from, to, across](double u, double v) {
        const double w = 2.0 * u - 1.0;
        const dvec2 angles = glm::mix(from, to, v) + across * w * (1.0 + 0.25 * std::cos(6.0 * turn * v));
        const double edge = std::pow(std::abs(w), 6.0);
        const double height =
            1.3 - 1.9 * edge + 0.5 * std::exp(-40.0 * (std::abs(w) - 0.78) * (std::abs(w) - 0.78));
        return SurfacePoint{shell::at(angles.x, angles.y, height),
                            {static_cast<float>(2.0 * v), atlas::straps.v(u, atlas::size)}};
    };
    patch.length_u_mm = 14.0;
    patch.length_v_mm = length_mm;
    patch.min_u = 3;
    patch.min_v = 8;
    return patch;
}

/// Foot, stem, knop and calyx in one line from the middle of the underside. Values are radius, height.
Profile stem_profile() {
    return Profile({{52, 0, true},   {55, 0.8},   {56.2, 3.5},   {55.5, 6.5},  {51.5, 8.5, true},
                    {50.5, 10},      {46, 15},    {37, 21},      {26, 26},     {16, 33},
                    {9.5, 43, true}, {12, 44},    {12.8, 46.2},  {11.5, 48.6}, {8.5, 50, true},
                    {6.2, 55},       {6, 60},     {9, 65},       {15, 71},     {17.5, 77},
                    {15, 83},        {9, 89},     {6, 94, true}, {9, 95},      {9.6, 97},
                    {6.4, 99, true}, {6, 103},    {10, 107.5},   {17, 111.5},  {22, 117.5, true},
                    {20.5, 117.5},   {14, 112.5}, {0, 109}});
}

Patch turned(const Profile& profile, double u_repeat, const AtlasStrip& strip, double row_share,
             bool chased) {
    Patch patch;
    patch.at = [=](double u, double v) {
        const Profile::Point p = profile.at_row(v);
        const double angle = u < 1.0 ? u * turn : 0.0;
        const dvec2 at = p.position + p.normal * (chased ? chasing_mm(angle, p.length_mm) : 0.0);
        return SurfacePoint{{at.x * std::cos(angle), at.y, -at.x * std::sin(angle)},
                            {static_cast<float>(u * u_repeat),
                             strip.v(row_share * p.length_mm / profile.length_mm(), atlas::size)}};
    };
    patch.length_v_mm = profile.length_mm();
    return patch;
}

/// A rosette over the coil's eye. `side` is +1 or -1: towards +Z or -Z.
Patch boss(double side) {
    const Profile dome({{19, 0},
                        {18.6, 2.2},
                        {15, 5, true},
                        {13.6, 5},
                        {11, 7.6},
                        {6, 9.4, true},
                        {5.4, 10.6},
                        {3.4, 12.2},
                        {0, 12.8}});
    Patch patch;
    patch.at = [dome, side](double u, double v) {
        const Profile::Point p = dome.at_row(v);
        const double angle = u < 1.0 ? u * turn : 0.0;
        const double petal = p.position.x > 6.0 && p.position.x < 15.0
                                 ? 1.3 * (std::sqrt(std::abs(std::cos(4.0 * angle))) - 0.7)
                                 : 0.0;
        const double fade = std::min(
            {1.0, std::max(0.0, p.position.x - 6.0) / 2.0, std::max(0.0, 15.0 - p.position.x) / 2.0});
        const dvec2 at = p.position + p.normal * (petal * fade);
        return SurfacePoint{shell::coil_mm + dvec3(at.x * std::cos(angle), side * at.x * std::sin(angle),
                                                   side * (15.0 + at.y)),
                            {static_cast<float>(u), atlas::straps.v(0.5 + 0.25 * v, atlas::size)}};
    };
    patch.length_u_mm = 90.0;
    patch.length_v_mm = dome.length_mm();
    patch.min_u = 8;
    patch.min_v = 3;
    patch.pole_at_end = true;
    return patch;
}

} // namespace

bake::SourceMesh make_nautilus_cup(std::int64_t triangles) {
    const Profile stem = stem_profile();
    std::vector<Patch> patches = {shell_outside(), shell_inside(), lip_mount()};
    patches.push_back(turned(stem, 1.0, atlas::stem, 1.0, true));
    patches.back().length_u_mm = turn * 28.0;
    patches.back().min_u = 10;
    patches.back().min_v = 16;
    patches.back().pole_at_end = true;
    patches.push_back(turned(Profile({{0, 5}, {30, 4}, {52, 0}}), 1.0, atlas::stem, 0.02, false));
    patches.back().columns_of = 3;
    patches.back().length_v_mm *= 0.3;
    patches.back().pole_at_start = true;
    constexpr double below = -0.25 * turn - shell::mouth_direction + 0.17; // theta directly above the stem
    patches.push_back(strap({-0.115, 0.0}, {-3.6, 0.0}, {0.0, 0.085}, 250.0));
    patches.push_back(strap({below, 0.02}, {below, 2.55}, {0.045, 0.0}, 100.0));
    patches.push_back(strap({below, -0.02}, {below, -2.55}, {-0.045, 0.0}, 100.0));
    patches.push_back(boss(1.0));
    patches.push_back(boss(-1.0));
    return make_mesh(patches, triangles, paint_nautilus_cup(stem.length_mm()));
}

} // namespace frustumscreen::artifacts
