#include "app/bench/ldi/window_scene.h"

#include "app/bench/truth/seeded_draw.h"
#include "app/simulation/site.h"
#include "assets_baked/artifacts/site_mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace frustumscreen::bench {

namespace {

constexpr double turn = 2.0 * std::numbers::pi;
constexpr double degree = turn / 360.0;

/// The site's up direction leans by 15 degrees from the window's normal.
glm::dmat4 window_from_site_at(double depth_m) {
    constexpr double lean = 15.0 * degree;
    const glm::dvec3 up(0.0, std::sin(lean), std::cos(lean));
    const glm::dvec3 right(1.0, 0.0, 0.0);
    glm::dmat4 window_from_site(glm::dmat3(right, glm::cross(up, right), up));
    window_from_site[3] = glm::dvec4(0.0, 0.0, -depth_m, 1.0);
    return window_from_site;
}

glm::dvec3 eye_at(double polar, double azimuth, double distance_m) {
    return distance_m * glm::dvec3(std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth),
                                   std::cos(polar));
}

} // namespace

WindowScene make_window_scene(std::size_t triangles, std::uint64_t seed) {
    simulation::Site site =
        simulation::make_site({.kind = simulation::SiteKind::HillTown, .triangles = triangles, .seed = seed});
    WindowScene scene;
    glm::dvec3 low(0.0);
    glm::dvec3 high(0.0);
    double nearest_m = 0.0; // the point that reaches farthest towards the eyes
    for (const glm::vec3& at : site.positions) {
        low = glm::min(low, glm::dvec3(at));
        high = glm::max(high, glm::dvec3(at));
        nearest_m = std::fmax(nearest_m, (window_from_site_at(0.0) * glm::dvec4(at, 1.0)).z);
    }
    constexpr double behind_m = 0.002;
    scene.window_from_site = window_from_site_at(nearest_m + behind_m);
    scene.triangles = site.indices.size() / 3;
    const glm::dvec3 extent = high - low;
    scene.size_m = std::max({extent.x, extent.y, extent.z});
    scene.box_size = extent / scene.size_m;
    scene.frozen_eye_m = eye_at(35.0 * degree, -0.25 * turn, frozen_from_m);
    scene.mesh = std::make_shared<const bake::SourceMesh>(artifacts::mesh_of_site(site));
    auto world = std::make_shared<ldi::TriangleWorld>();
    for (const glm::vec3& at : site.positions) {
        world->positions.emplace_back(scene.window_from_site * glm::dvec4(at, 1.0));
    }
    world->indices = std::move(site.indices);
    world->texture_places = std::move(site.texture_places);
    world->texture = site.texture;
    world->one_sided = true; // the site's surfaces are closed, and the exhibit's plan culls backs
    scene.world = std::move(world);
    return scene;
}

scene::FlatScreen window_screen(int pixels) {
    constexpr double half = 0.5 * window_side_m;
    return scene::flat_screen(
        {glm::dvec3(-half, half, 0.0), {half, half, 0.0}, {half, -half, 0.0}, {-half, -half, 0.0}}, pixels,
        pixels);
}

std::vector<WindowFrame> window_path(int frames, std::uint64_t seed) {
    SeededDraw draw(seed);
    std::array<glm::dvec3, max_windows> begins{};
    for (glm::dvec3& begin : begins) {
        begin = {draw.between(0.0, 1.0), draw.between(0.0, 1.0), draw.between(0.0, 1.0)};
    }
    std::vector<WindowFrame> path;
    for (int k = 0; k < frames; ++k) {
        const double share = static_cast<double>(k) / frames;
        WindowFrame& frame = path.emplace_back();
        for (std::size_t window = 0; window < begins.size(); ++window) {
            const glm::dvec3 phase = turn * (begins.at(window) + share * glm::dvec3(1.0, 1.0, 3.0));
            const double polar = degree * (31.0 - 26.0 * std::cos(2.0 * phase.x)); // 5 to 57
            frame.eyes_m.at(window) =
                eye_at(polar, phase.y, frozen_from_m * (1.025 + 0.175 * std::sin(phase.z)));
        }
    }
    return path;
}

std::size_t nearest_patch(const ldi::Hemisphere& hemisphere, const glm::dvec3& eye_m) {
    if (const std::optional<std::size_t> patch = hemisphere.patch_of(eye_m)) {
        return *patch;
    }
    std::size_t nearest = 0;
    for (std::size_t patch = 1; patch < ldi::patch_count; ++patch) {
        if (glm::dot(hemisphere.middle_of(patch), eye_m) > glm::dot(hemisphere.middle_of(nearest), eye_m)) {
            nearest = patch;
        }
    }
    return nearest;
}

std::vector<glm::dvec3> eyes_in_patch(const ldi::Hemisphere& hemisphere, std::size_t patch, int count,
                                      std::uint64_t seed) {
    const ldi::PatchDirections& of = hemisphere.directions_of(patch);
    SeededDraw draw(seed + 1000 * patch);
    std::vector<glm::dvec3> eyes;
    for (int k = 0; k < count; ++k) { // even over the solid angle
        const double cosine = draw.between(std::cos(of.max_polar_rad), std::cos(of.min_polar_rad));
        const double azimuth = of.middle_azimuth_rad + of.half_width_rad * draw.between(-1.0, 1.0);
        eyes.push_back(eye_at(std::acos(cosine), azimuth, hemisphere.radius_m() * draw.between(0.85, 1.2)));
    }
    return eyes;
}

} // namespace frustumscreen::bench
