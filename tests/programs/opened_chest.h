/// A chest, its lid that turns on a hinge, and the lid's knob that is pulled: as triangles without any code of the project, and as
/// a pack with a behaviour and states.
#pragma once

#include "app/pack/pack_states.h"
#include "app/pack/pack_world.h"
#include "assets_baked/bake/bake.h"
#include "tests/programs/solid_rays.h"

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace frustumscreen::programs {

/// Share of the largest size inside the prop, so that the open lid stays inside too.
inline constexpr double scale = 0.5;

/// A box in its own frame, and where that stands at rest in its parent's: T * R * S, as a glTF file has it.
struct BoxNode {
    glm::dvec3 low{0.0}, high{0.0};
    int parent = -1;
    glm::dvec3 translation{0.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
    glm::dvec3 scaling{1.0};
};
inline std::array<BoxNode, 3> nodes_at_rest() {
    return {{{.low = {-1.0, -0.6, 0.0}, .high = {1.0, 0.6, 0.8}},
             {.low = {-1.0, -1.2, 0.0}, .high = {1.0, 0.0, 0.2}, .parent = 0, .translation = {0.0, 0.6, 0.8}},
             {.low = {-1.0, -1.0, 0.0},
              .high = {1.0, 1.0, 1.0},
              .parent = 1,
              .translation = {0.3, -0.9, 0.2},
              .rotation = glm::dquat(std::cos(0.3), 0.0, 0.0, std::sin(0.3)),
              .scaling = glm::dvec3(0.2)}}};
}

inline constexpr double opened_rad = -1.1;
inline constexpr double seconds = 2.0;
inline constexpr double pulled = 0.15;

/// The nodes `t` seconds after the behaviour began: the lid turns evenly about its hinge for two seconds; after one
/// second, the knob is out at once.
inline std::array<BoxNode, 3> nodes_at(double t) {
    std::array<BoxNode, 3> nodes = nodes_at_rest();
    const double angle = opened_rad * std::clamp(t / seconds, 0.0, 1.0);
    nodes[1].rotation = glm::dquat(std::cos(0.5 * angle), std::sin(0.5 * angle), 0.0, 0.0);
    nodes[2].translation.z += t >= 1.0 ? pulled : 0.0;
    return nodes;
}

inline std::array<glm::dvec3, 8> corners_of(const BoxNode& node) {
    std::array<glm::dvec3, 8> corners;
    for (std::size_t k = 0; k < corners.size(); ++k) {
        corners.at(k) = {(k & 1U) != 0 ? node.high.x : node.low.x, (k & 2U) != 0 ? node.high.y : node.low.y,
                         (k & 4U) != 0 ? node.high.z : node.low.z};
    }
    return corners;
}
inline constexpr std::array<std::array<std::uint32_t, 3>, 12> box_triangles{{{0, 2, 1},
                                                                             {1, 2, 3},
                                                                             {4, 5, 6},
                                                                             {5, 7, 6},
                                                                             {0, 1, 4},
                                                                             {1, 5, 4},
                                                                             {2, 6, 3},
                                                                             {3, 6, 7},
                                                                             {0, 4, 2},
                                                                             {2, 4, 6},
                                                                             {1, 3, 5},
                                                                             {3, 7, 5}}};

/// Triangles of all boxes in the scene's frame, without any code of the project.
struct Triangles {
    explicit Triangles(const std::array<BoxNode, 3>& nodes, std::size_t count = 3) {
        for (const BoxNode& node : std::span(nodes).first(count)) {
            for (const std::array<std::uint32_t, 3>& triangle : box_triangles) {
                RayTriangle& placed = all.emplace_back();
                for (std::size_t k = 0; k < 3; ++k) {
                    glm::dvec3 point = corners_of(node).at(triangle.at(k));
                    for (const BoxNode* at = &node; at != nullptr;
                         at = at->parent < 0 ? nullptr : &nodes.at(static_cast<std::size_t>(at->parent))) {
                        point = at->translation + at->rotation * (at->scaling * point);
                    }
                    placed.at(k) = point;
                }
            }
        }
    }
    /// As Star::hit.
    [[nodiscard]] std::optional<glm::dvec3> hit(const glm::dvec3& from, const glm::dvec3& along) const {
        double first = std::numeric_limits<double>::infinity();
        for (const RayTriangle& triangle : all) {
            const double t = ray_meets(triangle, from, along);
            first = t > 0.0 ? std::fmin(first, t) : first;
        }
        return std::isfinite(first) ? std::optional(from + first * along) : std::nullopt;
    }
    std::vector<RayTriangle> all;
};

/// Where the artifact's rest stands in the prop, as Star.
struct PlacedInProp {
    explicit PlacedInProp(const std::vector<HalfSpace>& prop) {
        const Triangles rest(nodes_at_rest());
        glm::dvec3 low(std::numeric_limits<double>::infinity());
        glm::dvec3 high = -low;
        for (const auto& triangle : rest.all) {
            for (const glm::dvec3& corner : triangle) {
                low = glm::min(low, corner);
                high = glm::max(high, corner);
            }
        }
        base = {0.5 * (low.x + high.x), 0.5 * (low.y + high.y), low.z};
        metres = std::numeric_limits<double>::infinity();
        for (const auto& triangle : rest.all) {
            for (const glm::dvec3& corner : triangle) {
                for (const HalfSpace& plane : prop) {
                    const double reach = glm::dot(plane.normal, corner - base);
                    metres = reach > 1e-12 ? std::fmin(metres, plane.offset / reach) : metres;
                }
            }
        }
        metres *= scale;
    }
    [[nodiscard]] Triangles at(double t) const { return place(Triangles(nodes_at(t))); }
    /// At rest, the first nodes alone.
    [[nodiscard]] Triangles of_first(std::size_t count) const {
        return place(Triangles(nodes_at_rest(), count));
    }
    [[nodiscard]] Triangles place(Triangles placed) const {
        for (auto& triangle : placed.all) {
            for (glm::dvec3& corner : triangle) {
                corner = metres * (corner - base);
            }
        }
        return placed;
    }
    glm::dvec3 base{0.0};
    double metres = 0.0;
};

inline bake::SourceMesh mesh_of(const std::vector<std::array<glm::dvec3, 3>>& triangles) {
    bake::SourceMesh mesh;
    mesh.materials.emplace_back();
    for (const auto& triangle : triangles) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.insert(mesh.positions.end(), triangle.begin(), triangle.end());
        mesh.triangles.push_back({first, first + 1, first + 2});
        mesh.triangle_materials.push_back(0);
    }
    return mesh;
}

/// Without relief it is always drawn with one sample a pixel too, so that its pictures depend on no machine's time.
inline pack::Pack baked(const std::vector<std::array<glm::dvec3, 3>>& triangles, double of_largest,
                        bool relief = true) {
    bake::BakeOptions options;
    options.size = 64;
    options.unlit = true;
    options.prop = bake::baked_cube();
    options.up = "z";
    options.scale = of_largest;
    options.relief = relief;
    pack::Pack pack = bake::bake(mesh_of(triangles), options).value();
    pack.samples = relief ? pack.samples : 1;
    pack.title = "Chest";
    pack.provenance.source_name = "chest.gltf";
    pack.provenance.source_sha256 = std::string(64, '0');
    pack.provenance.source_triangles = triangles.size();
    return pack;
}

inline world::Behaviour opening(world::Trigger trigger) {
    world::Behaviour behaviour;
    behaviour.name = "open";
    behaviour.seconds = seconds;
    behaviour.stays = true;
    behaviour.trigger = trigger;
    world::Channel lid{.cell = 1, .path = world::Path::Rotation, .curve = {}};
    // Short arcs, so that the turn from key to key is even.
    for (const double t : {0.0, 0.5 * seconds, seconds}) {
        const glm::dquat q = nodes_at(t)[1].rotation;
        lid.curve.times_s.push_back(static_cast<float>(t));
        lid.curve.values.emplace_back(glm::dvec4(q.x, q.y, q.z, q.w));
    }
    world::Channel knob{.cell = 2, .path = world::Path::Translation, .curve = {}};
    knob.curve.interpolation = world::Interpolation::Step;
    for (const double t : {0.0, 1.0}) {
        knob.curve.times_s.push_back(static_cast<float>(t));
        knob.curve.values.emplace_back(glm::dvec4(nodes_at(t)[2].translation, 0.0));
    }
    behaviour.channels = {lid, knob};
    return behaviour;
}

/// Without cells.
inline pack::Pack whole_chest(bool relief = true) {
    return baked(Triangles(nodes_at_rest()).all, scale, relief);
}

inline pack::Pack chest(world::Trigger trigger = world::Trigger::Arrival, bool relief = true) {
    const std::array<BoxNode, 3> rest = nodes_at_rest();
    const std::vector<std::array<glm::dvec3, 3>> all = Triangles(rest).all;
    pack::Pack whole = whole_chest(relief);
    pack::PackWorld world;
    std::vector<pack::Pack> geometry;
    for (std::size_t k = 0; k < rest.size(); ++k) {
        std::vector<std::array<glm::dvec3, 3>> own;
        for (const std::array<std::uint32_t, 3>& triangle : box_triangles) {
            const std::array<glm::dvec3, 8> corners = corners_of(rest.at(k));
            own.push_back({corners.at(triangle[0]), corners.at(triangle[1]), corners.at(triangle[2])});
        }
        geometry.push_back(baked(own, 1.0, relief));
        pack::PackCell& cell = world.cells.emplace_back();
        cell.triangles = own.size();
        cell.cell.name = std::array{"chest", "lid", "knob"}.at(k);
        cell.cell.rest = {rest.at(k).translation, rest.at(k).rotation, rest.at(k).scaling};
        cell.cell.has_geometry = true;
        cell.cell.cell_from_geometry = glm::inverse(geometry.back().box_from_file);
        if (rest.at(k).parent < 0) {
            cell.cell.parent_from_base = whole.box_from_file;
        } else {
            cell.cell.parent = static_cast<std::size_t>(rest.at(k).parent);
        }
        cell.low = glm::dvec3(std::numeric_limits<double>::infinity());
        cell.high = -cell.low;
        for (std::size_t t = 12 * k; t < 12 * (k + 1); ++t) {
            for (const glm::dvec3& corner : all[t]) {
                const glm::dvec3 in_box(whole.box_from_file * glm::dvec4(corner, 1.0));
                cell.low = glm::min(cell.low, in_box);
                cell.high = glm::max(cell.high, in_box);
            }
        }
    }
    world.behaviours.push_back({opening(trigger), {{"en", "Open the lid"}}});
    EXPECT_TRUE(pack::put_world(whole, world, geometry));
    EXPECT_TRUE(pack::put_states(
        whole, {{.name = "opened", .titles = {{"en", "Opened"}}, .behaviour = 0},
                {.name = "without its lid", .titles = {{"en", "Without its lid"}}, .hidden = {1, 2}},
                {.name = "nothing", .titles = {{"en", "Nothing"}}, .hidden = {0, 1, 2}}}));
    return whole;
}

} // namespace frustumscreen::programs
