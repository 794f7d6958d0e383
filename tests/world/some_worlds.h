/// Small worlds for the tests: a chest with a lid and a bell.
#pragma once

#include "app/world/player.h"

#include <cmath>
#include <numbers>
#include <vector>

namespace frustumscreen::world {

inline MonotonicTime at_s(double seconds) {
    return MonotonicTime(Nanoseconds(std::llround(seconds * 1e9)));
}

inline glm::vec4 turn_about(const glm::dvec3& axis, double radians) {
    return {glm::vec3(axis * std::sin(0.5 * radians)), static_cast<float>(std::cos(0.5 * radians))};
}

/// chest (0), a root; lid (1), on the chest; bell (2), in the lid. The lid's rest is turned and scaled.
inline std::vector<Cell> chest() {
    std::vector<Cell> cells(3);
    cells[0].name = "chest";
    cells[0].has_geometry = true;
    cells[1].name = "lid";
    cells[1].parent = 0;
    cells[1].parent_from_base[3] = {0.0, 0.5, 0.4, 1.0};
    cells[1].rest = {.translation = {0.1, 0.0, 0.2},
                     .rotation = glm::angleAxis(0.3, glm::dvec3(0.0, 0.0, 1.0)),
                     .scale = {1.0, 2.0, 0.5}};
    cells[1].has_geometry = true;
    cells[1].cell_from_geometry[0][0] = 0.8;
    cells[1].cell_from_geometry[1][1] = 0.8;
    cells[1].cell_from_geometry[2][2] = 0.8;
    cells[2].name = "bell";
    cells[2].parent = 1;
    cells[2].has_geometry = true;
    return cells;
}

/// The chest moves along X, from where it rests to 1, in 2 s.
inline Behaviour slide() {
    Behaviour behaviour{.name = "slide", .seconds = 2.0};
    behaviour.channels.push_back({.cell = 0,
                                  .path = Path::Translation,
                                  .curve = {.interpolation = Interpolation::Linear,
                                            .times_s = {0.0F, 2.0F},
                                            .values = {glm::vec4(0.0F), {1.0F, 0.0F, 0.0F, 0.0F}}}});
    return behaviour;
}

/// The lid opens about X by 90 degrees in 1 s, and glows.
inline Behaviour open_lid() {
    Behaviour behaviour{.name = "open", .seconds = 1.0, .stays = true};
    const glm::dquat rest = chest()[1].rest.rotation;
    const glm::dquat open = rest * glm::angleAxis(std::numbers::pi / 2.0, glm::dvec3(1.0, 0.0, 0.0));
    const auto value = [](const glm::dquat& q) { return glm::vec4(q.x, q.y, q.z, q.w); };
    behaviour.channels.push_back({.cell = 1,
                                  .path = Path::Rotation,
                                  .curve = {.interpolation = Interpolation::Linear,
                                            .times_s = {0.0F, 1.0F},
                                            .values = {value(rest), value(open)}}});
    behaviour.channels.push_back({.cell = 1,
                                  .path = Path::Light,
                                  .curve = {.interpolation = Interpolation::Linear,
                                            .times_s = {0.0F, 1.0F},
                                            .values = {glm::vec4(1.0F), {0.5F, 2.0F, 1.0F, 0.0F}}}});
    return behaviour;
}

/// The chest goes round in 3 s, again and again; its curve begins where it ends.
inline Behaviour go_round() {
    Behaviour behaviour{.name = "round", .seconds = 3.0, .repeats = true};
    Curve curve;
    for (int k = 0; k <= 12; ++k) {
        curve.times_s.push_back(0.25F * static_cast<float>(k));
        const double angle = 2.0 * std::numbers::pi * (k % 12) / 12.0;
        curve.values.emplace_back(std::cos(angle), std::sin(angle), 0.0, 0.0);
    }
    behaviour.channels.push_back({.cell = 0, .path = Path::Translation, .curve = curve});
    return behaviour;
}

/// The lid is pulled up on a spring that swings, and stays up.
inline Behaviour spring_up() {
    Behaviour behaviour{.name = "spring", .seconds = 2.0, .stays = true};
    behaviour.springs.push_back({.cell = 1,
                                 .turns = true,
                                 .axis = {1.0, 0.0, 0.0},
                                 .reach = 1.2,
                                 .stiffness_per_s2 = 60.0,
                                 .damping_per_s = 4.0});
    return behaviour;
}

/// The bell is pushed every 0.7 s.
inline Behaviour ring() {
    Behaviour behaviour{.name = "ring", .seconds = 0.7, .repeats = true};
    behaviour.pendulums.push_back({.cell = 2, .angle_rad = 0.3, .length_m = 0.2, .damping_per_s = 0.5});
    return behaviour;
}

inline double difference(const glm::dmat4& a, const glm::dmat4& b) {
    double largest = 0.0;
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            largest = std::fmax(largest, std::abs(a[column][row] - b[column][row]));
        }
    }
    return largest;
}

inline double difference(std::span<const CellPose> a, std::span<const CellPose> b) {
    double largest = a.size() == b.size() ? 0.0 : 1e300;
    for (std::size_t k = 0; k < a.size() && k < b.size(); ++k) {
        largest = std::fmax(largest, difference(a[k].box_from_geometry, b[k].box_from_geometry));
        const glm::vec3 light = glm::abs(a[k].light - b[k].light);
        largest = std::fmax(largest, static_cast<double>(glm::max(light.x, glm::max(light.y, light.z))));
    }
    return largest;
}

inline std::vector<CellPose> copy(std::span<const CellPose> poses) {
    return {poses.begin(), poses.end()};
}

} // namespace frustumscreen::world
