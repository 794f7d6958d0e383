/// Objects that shade each other, and torches at seeded poses.
///
/// Frames   as named; table T.
/// Threads  values; any.
#pragma once

#include "app/scene/placed_torch.h"
#include "tests/render/interlocked.h"

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace frustumscreen::synthetic {

inline constexpr float base_light = 0.4F; // with a torch's full light below the clipping at 1

inline glm::dmat4 put(const glm::dvec3& place, double degrees = 0.0,
                      const glm::dvec3& axis = {0.0, 0.0, 1.0}) {
    return glm::rotate(glm::translate(glm::dmat4(1.0), place), glm::radians(degrees), glm::normalize(axis));
}
inline Soup moved(Soup soup, const glm::dmat4& by) {
    for (glm::dvec3& point : soup.points) {
        point = glm::dvec3(by * glm::dvec4(point, 1.0));
    }
    return soup;
}
inline void append(Soup& soup, const Soup& more) {
    const auto first = static_cast<std::uint32_t>(soup.points.size());
    soup.points.insert(soup.points.end(), more.points.begin(), more.points.end());
    for (const std::uint32_t index : more.indices) {
        soup.indices.push_back(first + index);
    }
}

/// A ball and a post on a plate, on which they cast their shadows.
inline std::vector<WorldObject> ball_and_post() {
    return {{box({1.6, 1.2, 0.1}), put({0.0, 0.0, 0.05})},
            {ball(), glm::scale(put({-0.35, 0.1, 0.42}), glm::dvec3(0.3))},
            {box({0.14, 0.14, 0.75}), put({0.4, -0.1, 0.46}, 20.0)}};
}
/// A box in a crate: its walls keep the light from the inside.
inline std::vector<WorldObject> box_in_crate() {
    Soup crate = moved(box({1.4, 1.2, 0.1}), put({0.0, 0.0, 0.05}));
    for (const double side : {-1.0, 1.0}) {
        append(crate, moved(box({0.1, 1.2, 0.45}), put({0.65 * side, 0.0, 0.325})));
        append(crate, moved(box({1.2, 0.1, 0.45}), put({0.0, 0.55 * side, 0.325})));
    }
    return {{crate, glm::dmat4(1.0)}, {box({0.4, 0.3, 0.5}), put({0.1, 0.0, 0.37}, 30.0)}};
}
/// A world of small triangles.
inline std::vector<WorldObject> ball_in_ring() {
    return {{ball(), glm::scale(put({0.0, 0.0, 0.5}), glm::dvec3(0.3))},
            {torus(0.6, 0.12), put({0.05, 0.0, 0.5}, 50.0, {1.0, 0.3, 0.0})}};
}
/// The same objects as one.
inline std::vector<WorldObject> as_one(const std::vector<WorldObject>& objects) {
    Soup all;
    for (const WorldObject& object : objects) {
        append(all, moved(object.soup, object.world_from_soup));
    }
    return {{all, glm::dmat4(1.0)}};
}

/// At `from`, which looks at `at`; its picture turned by `roll`. Table frame.
inline geometry::RigidTransform looking(const glm::dvec3& from, const glm::dvec3& at, double roll = 0.0) {
    const glm::dvec3 z = glm::normalize(at - from);
    const glm::dvec3 x =
        glm::normalize(glm::cross(std::fabs(z.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0), z));
    const glm::dmat3 upright(x, glm::cross(z, x), z);
    return {glm::quat_cast(upright) * glm::angleAxis(roll, glm::dvec3(0, 0, 1)), from};
}

/// A torch that plain light of a colour comes from.
inline scene::PlacedTorch torch_of(const geometry::RigidTransform& pose, const torch::Beam& beam,
                                   torch::Blend blend = torch::Blend::Light,
                                   const glm::vec3& colour = glm::vec3(1.0F)) {
    torch::Content content = torch::white();
    content.blend = blend;
    content.height_per_width = beam.height_per_width;
    content.stages.front().colour = colour;
    return scene::placed(content, beam, pose, 0.0);
}

/// Anywhere around the prop and above the table's plane, pointed at its middle, with every kind of beam in turn.
inline scene::PlacedTorch seeded_torch(const TestTable& table, std::mt19937& random, int number) {
    std::uniform_real_distribution<double> u(-1.0, 1.0);
    const double azimuth = std::numbers::pi * u(random);
    const double elevation = 0.6 + 0.6 * u(random);
    const double away = 0.3 + 0.15 * u(random);
    const glm::dvec3 middle = table.table_from_prop.point(table.prop.middle);
    const glm::dvec3 from =
        middle + away * glm::dvec3(std::cos(elevation) * std::cos(azimuth),
                                   std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
    const glm::dvec3 at = middle + 0.03 * glm::dvec3(u(random), u(random), u(random));
    torch::Beam beam;
    beam.opening_rad = glm::radians(20.0 + 15.0 * u(random));
    beam.shape = number % 3 == 2 ? torch::Shape::Rectangle : torch::Shape::Round;
    beam.height_per_width = number % 5 == 4 ? 0.7 : 1.0;
    beam.attenuation = static_cast<torch::Attenuation>(number % 4);
    // Linear and smooth light ends in the object.
    beam.full_m = (beam.attenuation == torch::Attenuation::InverseSquare ? 0.6 : 0.8) * away;
    beam.dark_m = 1.1 * away;
    const bool over = number % 2 == 1;
    const glm::vec3 colour = over ? glm::vec3(0.2F, 0.7F, 0.9F) : glm::vec3(1.0F);
    return torch_of(looking(from, at, u(random)), beam, over ? torch::Blend::Over : torch::Blend::Light,
                    colour);
}

} // namespace frustumscreen::synthetic
