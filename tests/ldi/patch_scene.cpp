#include "tests/ldi/patch_scene.h"

#include "app/relief/relief_painter.h"
#include "app/scene/flat_screen.h"

#include <array>
#include <cmath>
#include <limits>

namespace frustumscreen::ldi {

namespace {

/// A parallelogram of `cells` x `cells` parts, coloured by `shade` of the place.
template <typename Shade>
void add_sheet(TriangleWorld& world, const glm::vec3& corner, const glm::vec3& along, const glm::vec3& across,
               int cells, const Shade& shade) {
    const auto first = static_cast<std::uint32_t>(world.positions.size());
    const auto columns = static_cast<std::uint32_t>(cells) + 1;
    for (int j = 0; j <= cells; ++j) {
        for (int i = 0; i <= cells; ++i) {
            const auto of = static_cast<float>(cells);
            glm::vec3 at = corner + static_cast<float>(i) / of * along + static_cast<float>(j) / of * across;
            world.colours.push_back(shade(at));
            world.positions.push_back(at);
        }
    }
    for (std::uint32_t j = 0; j + 1 < columns; ++j) {
        for (std::uint32_t i = 0; i + 1 < columns; ++i) {
            const std::uint32_t a = first + j * columns + i;
            for (const std::uint32_t k : {a, a + 1, a + columns, a + columns, a + 1, a + columns + 1}) {
                world.indices.push_back(k);
            }
        }
    }
}

glm::u8vec4 shaded(const glm::vec3& base, float light) {
    return {glm::u8vec3(glm::clamp(light * base, 0.0F, 255.0F)), 255};
}

void add_house(TriangleWorld& world, const glm::vec3& low, const glm::vec3& high, const glm::vec3& base) {
    for (int face = 0; face < 6; ++face) {
        const int axis = face / 2;
        glm::vec3 corner = low;
        glm::vec3 along(0.0F);
        glm::vec3 across(0.0F);
        corner[axis] = face % 2 == 0 ? low[axis] : high[axis];
        along[(axis + 1) % 3] = high[(axis + 1) % 3] - low[(axis + 1) % 3];
        across[(axis + 2) % 3] = high[(axis + 2) % 3] - low[(axis + 2) % 3];
        const float light = 0.7F + 0.05F * static_cast<float>(face);
        add_sheet(world, corner, along, across, 2,
                  [&](const glm::vec3& at) { return shaded(base, light + 0.5F * (at.x - at.y)); });
    }
}

void add_hills(TriangleWorld& world, float depth) {
    const std::size_t first = world.positions.size();
    add_sheet(world, {-0.4F, -0.4F, depth}, {0.8F, 0.0F, 0.0F}, {0.0F, 0.8F, 0.0F}, 32,
              [](const glm::vec3& at) {
                  return shaded({150.0F, 190.0F, 120.0F},
                                0.8F + 0.15F * std::sin(30.0F * at.x) * std::sin(26.0F * at.y));
              });
    for (std::size_t k = first; k < world.positions.size(); ++k) {
        glm::vec3& at = world.positions[k];
        at.z += 0.015F * std::sin(23.0F * at.x + 1.0F) * std::cos(19.0F * at.y);
    }
}

} // namespace

TriangleWorld hills() {
    TriangleWorld world;
    add_hills(world, -0.08F);
    return world;
}

TriangleWorld town(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> u(0.0F, 1.0F);
    TriangleWorld world;
    add_hills(world, -0.16F);
    for (int k = 0; k < 14; ++k) {
        const glm::vec3 middle(0.36F * (u(random) - 0.5F), 0.36F * (u(random) - 0.5F), -0.18F);
        const glm::vec3 half(0.008F + 0.014F * u(random), 0.008F + 0.014F * u(random), 0.0F);
        const glm::vec3 up(0.0F, 0.0F, 0.05F + 0.09F * u(random));
        add_house(world, middle - half, middle + half + up,
                  {120.0F + 120.0F * u(random), 120.0F + 120.0F * u(random), 120.0F + 120.0F * u(random)});
    }
    add_house(world, {-0.01F, 0.02F, -0.05F}, {0.002F, 0.032F, 0.03F}, {230.0F, 200.0F, 160.0F});
    return world;
}

TriangleWorld wires_before_a_wall() {
    TriangleWorld world;
    add_sheet(world, {-0.5F, -0.5F, -0.1F}, {1.0F, 0.0F, 0.0F}, {0.0F, 1.0F, 0.0F}, 8,
              [](const glm::vec3& at) {
                  return shaded({200.0F, 180.0F, 160.0F}, 0.9F + 0.1F * at.x);
              });
    for (int k = -6; k <= 6; ++k) {
        const float x = 0.0137F * static_cast<float>(k);
        add_house(world, {x, -0.3F, -0.04F}, {x + 0.0004F, 0.3F, -0.0396F}, {60.0F, 60.0F, 80.0F});
    }
    return world;
}

glm::dvec3 seeded_eye(const Hemisphere& hemisphere, std::size_t patch, std::mt19937& random) {
    const PatchDirections& directions = hemisphere.directions_of(patch);
    std::uniform_real_distribution<double> u(0.02, 0.98);
    const double cosine =
        std::lerp(std::cos(directions.min_polar_rad), std::cos(directions.max_polar_rad), u(random));
    const double sine = std::sqrt(1.0 - cosine * cosine);
    const double azimuth =
        directions.middle_azimuth_rad + directions.half_width_rad * (2.0 * u(random) - 1.0);
    return hemisphere.radius_m() * glm::dvec3(sine * std::cos(azimuth), sine * std::sin(azimuth), cosine);
}

bool SeenWindow::hit(int x, int y) const {
    return !std::isnan(point(x, y).x);
}

SeenWindow ray_cast(const TriangleWorld& world, const glm::dvec3& eye, int px) {
    struct Placed {
        glm::dvec3 corner, ab, ac;
        std::array<glm::u8vec4, 3> colours;
    };
    std::vector<Placed> triangles;
    for (std::size_t k = 0; k < world.indices.size(); k += 3) {
        const auto at = [&](std::size_t corner) {
            return glm::dvec3(world.positions[world.indices[k + corner]]);
        };
        const auto colour = [&](std::size_t corner) { return world.colours[world.indices[k + corner]]; };
        triangles.push_back({at(0), at(1) - at(0), at(2) - at(0), {colour(0), colour(1), colour(2)}});
    }
    SeenWindow seen{px, {}, image::Image8(px, px, glm::u8vec4(0))};
    seen.points.resize(static_cast<std::size_t>(px) * static_cast<std::size_t>(px),
                       glm::vec3(std::numeric_limits<float>::quiet_NaN()));
    for (int y = 0; y < px; ++y) {
        for (int x = 0; x < px; ++x) {
            const glm::dvec3 on_window(half_window_m * (2.0 * (x + 0.5) / px - 1.0),
                                       half_window_m * (1.0 - 2.0 * (y + 0.5) / px), 0.0);
            const glm::dvec3 ray = on_window - eye;
            double nearest = std::numeric_limits<double>::infinity();
            for (const Placed& triangle : triangles) {
                const glm::dvec3 across = glm::cross(ray, triangle.ac);
                const double determinant = glm::dot(across, triangle.ab);
                const glm::dvec3 from = eye - triangle.corner;
                const double b = glm::dot(from, across) / determinant;
                const glm::dvec3 around = glm::cross(from, triangle.ab);
                const double c = glm::dot(ray, around) / determinant;
                const double way = glm::dot(triangle.ac, around) / determinant;
                if (b >= 0.0 && c >= 0.0 && b + c <= 1.0 && way > 0.0 && way < nearest) {
                    nearest = way;
                    seen.points[static_cast<std::size_t>(y) * static_cast<std::size_t>(px) +
                                static_cast<std::size_t>(x)] = glm::vec3(eye + way * ray);
                    const glm::dvec3 codes = (1.0 - b - c) * glm::dvec3(triangle.colours[0]) +
                                             b * glm::dvec3(triangle.colours[1]) +
                                             c * glm::dvec3(triangle.colours[2]);
                    seen.colours.at(x, y) = {glm::u8vec3(codes + 0.5), 255};
                }
            }
        }
    }
    return seen;
}

SeenWindow drawn(const PatchRelief& patch, const glm::dvec3& eye, int px, int samples) {
    constexpr double half = half_window_m;
    const scene::FlatScreen screen = scene::flat_screen(
        {glm::dvec3(-half, half, 0.0), {half, half, 0.0}, {half, -half, 0.0}, {-half, -half, 0.0}}, px, px);
    relief::RasterScene scene;
    scene.prop_from_box = patch.window_from_box;
    scene.box_size = patch.box_size;
    scene.projector = screen.pinhole;
    scene.prop_from_projector = screen.table_from_pinhole;
    scene.eye_m = eye;
    relief::RasterView view;
    relief::set_up(view, screen.surface, scene);
    SeenWindow seen{px, {}, image::Image8(px, px, glm::u8vec4(0))};
    seen.points.resize(static_cast<std::size_t>(px) * static_cast<std::size_t>(px));
    relief::ReliefPainter painter(1);
    painter.paint(patch.relief, view, samples, {seen.colours.texels.data(), px, px, px});
    painter.hit_points(patch.relief, view, {seen.points.data(), px, px, px});
    for (glm::vec3& point : seen.points) {
        point = glm::vec3(patch.window_from_box * glm::dvec4(point, 1.0));
    }
    return seen;
}

} // namespace frustumscreen::ldi
