#include "tests/ldi/worlds.h"

#include <cmath>
#include <numbers>
#include <random>

namespace frustumscreen::ldi {

void add_rectangle(TriangleWorld& world, const glm::vec3& middle, const glm::vec2& half_extent_m,
                   const glm::u8vec3& colour) {
    const auto first = static_cast<std::uint32_t>(world.positions.size());
    for (const glm::vec2& corner : {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(1, 1), glm::vec2(-1, 1)}) {
        world.positions.push_back(middle + glm::vec3(corner * half_extent_m, 0.0F));
        world.colours.emplace_back(colour, 255);
    }
    for (const std::uint32_t corner : {0U, 1U, 2U, 0U, 2U, 3U}) {
        world.indices.push_back(first + corner);
    }
}

void add_sphere(TriangleWorld& world, const glm::vec3& middle, float radius_m, const glm::u8vec3& colour) {
    constexpr std::uint32_t rows = 24;
    constexpr std::uint32_t columns = 48;
    const auto first = static_cast<std::uint32_t>(world.positions.size());
    for (std::uint32_t row = 0; row <= rows; ++row) {
        for (std::uint32_t column = 0; column <= columns; ++column) {
            const float polar = std::numbers::pi_v<float> * static_cast<float>(row) / rows;
            const float azimuth = 2.0F * std::numbers::pi_v<float> * static_cast<float>(column) / columns;
            world.positions.push_back(middle + radius_m * glm::vec3(std::sin(polar) * std::cos(azimuth),
                                                                    std::sin(polar) * std::sin(azimuth),
                                                                    std::cos(polar)));
            world.colours.emplace_back(colour, 255);
        }
    }
    for (std::uint32_t row = 0; row < rows; ++row) {
        for (std::uint32_t column = 0; column < columns; ++column) {
            const std::uint32_t corner = first + row * (columns + 1) + column;
            const std::uint32_t below = corner + columns + 1;
            world.indices.insert(world.indices.end(),
                                 {corner, below, corner + 1, corner + 1, below, below + 1});
        }
    }
}

TriangleWorld spheres_before_a_wall() {
    TriangleWorld world;
    add_rectangle(world, {0.0F, 0.0F, -0.15F}, {0.6F, 0.6F}, {90, 140, 70});
    std::mt19937 random(7);
    std::uniform_real_distribution<float> u(-1.0F, 1.0F);
    for (int k = 0; k < 11; ++k) {
        const glm::vec3 middle(0.08F * u(random), 0.08F * u(random),
                               k == 0 ? 0.03F : -0.07F + 0.05F * u(random));
        add_sphere(world, middle, 0.012F + 0.008F * std::fabs(u(random)),
                   {static_cast<std::uint8_t>(20 * k + 10), 200, static_cast<std::uint8_t>(250 - 20 * k)});
    }
    return world;
}

} // namespace frustumscreen::ldi
