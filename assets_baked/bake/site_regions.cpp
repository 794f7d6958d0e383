#include "assets_baked/bake/site_regions.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

namespace frustumscreen::bake {

namespace {

constexpr int min_depth = 2, max_depth = 4;      ///< of the quadtree: 4 x 4 squares to 16 x 16
constexpr std::size_t min_square_triangles = 64; ///< fewer are joined with a neighbour
constexpr double on_edge_box = 1e-9;             ///< a corner this near to an edge lies on it

using Triangles = std::vector<std::uint32_t>;

/// A square of the ground, box frame.
struct Square {
    glm::dvec2 middle{0.0};
    double half = 0.5;
};

class Cutter {
public:
    Cutter(SourceMesh mesh, const BoxFrame& frame, const SiteOptions& options)
        : mesh_(std::move(mesh)), points_(in_box(mesh_, frame)), options_(options) {}

    Result<SourceMesh> cut(const BoxFrame& frame) {
        Triangles all(mesh_.triangles.size());
        for (std::size_t t = 0; t < all.size(); ++t) {
            all[t] = static_cast<std::uint32_t>(t);
        }
        TRY_VOID(divide({{0.0, 0.0}, 0.5 * std::max(frame.box_size.x, frame.box_size.y)}, std::move(all), 0));
        return in_regions();
    }

private:
    Result<void> divide(const Square& square, Triangles triangles, int depth) {
        if (depth >= min_depth && triangles.size() <= options_.max_triangles) {
            regions_.push_back(std::move(triangles));
            return {};
        }
        if (depth == max_depth) {
            return bad_input("bake.site_dense",
                             "the site has {} triangles in one 16th of its width, around {:.3f}, {:.3f} of "
                             "the box; a region holds at "
                             "most {}: reduce the model, or allow more with max_triangles of [site]",
                             triangles.size(), square.middle.x, square.middle.y, options_.max_triangles);
        }
        std::array<Triangles, 4> parts;
        auto [left, right] = cut_along(0, square.middle.x, triangles);
        std::tie(parts[0], parts[1]) = cut_along(1, square.middle.y, left);
        std::tie(parts[2], parts[3]) = cut_along(1, square.middle.y, right);
        join_small(parts);
        for (unsigned k = 0; k < parts.size(); ++k) {
            if (!parts[k].empty()) {
                const double half = 0.5 * square.half;
                const glm::dvec2 to((k & 2U) != 0 ? half : -half, (k & 1U) != 0 ? half : -half);
                TRY_VOID(divide({square.middle + to, half}, std::move(parts[k]), depth + 1));
            }
        }
        return {};
    }

    static void join_small(std::array<Triangles, 4>& parts) {
        const auto largest =
            std::max_element(parts.begin(), parts.end(),
                             [](const Triangles& a, const Triangles& b) { return a.size() < b.size(); });
        for (Triangles& part : parts) {
            if (&part != &*largest && part.size() < min_square_triangles) {
                largest->insert(largest->end(), part.begin(), part.end());
                part.clear();
            }
        }
    }

    /// Below and above `at` along the axis.
    std::pair<Triangles, Triangles> cut_along(int axis, double at, const Triangles& triangles) {
        std::pair<Triangles, Triangles> sides;
        new_corners_.clear();
        for (const std::uint32_t t : triangles) {
            std::array<int, 3> side{};
            for (std::size_t c = 0; c < 3; ++c) {
                const double away = points_[mesh_.triangles[t][c]][axis] - at;
                side[c] = away > on_edge_box ? 1 : away < -on_edge_box ? -1 : 0;
            }
            const auto [low, high] = std::minmax_element(side.begin(), side.end());
            if (*low >= 0 || *high <= 0) {
                (*high > 0 ? sides.second : sides.first).push_back(t);
            } else {
                cut_triangle(t, side, axis, at, sides);
            }
        }
        return sides;
    }

    /// Keeps one piece in the triangle's own place; others follow at the mesh's end.
    void cut_triangle(std::uint32_t t, const std::array<int, 3>& side, int axis, double at,
                      std::pair<Triangles, Triangles>& sides) {
        const std::array<std::uint32_t, 3> corners = mesh_.triangles[t];
        std::array<std::vector<std::uint32_t>, 2> outlines; // below, above
        for (std::size_t c = 0; c < 3; ++c) {
            const std::size_t next = (c + 1) % 3;
            for (const int which : {0, 1}) {
                if (side[c] == 0 || (side[c] > 0) == (which == 1)) {
                    outlines[static_cast<std::size_t>(which)].push_back(corners[c]);
                }
            }
            if (side[c] * side[next] < 0) {
                const std::uint32_t between = corner_between(corners[c], corners[next], axis, at);
                outlines[0].push_back(between);
                outlines[1].push_back(between);
            }
        }
        bool first = true;
        for (std::size_t which = 0; which < outlines.size(); ++which) {
            const std::vector<std::uint32_t>& outline = outlines[which];
            for (std::size_t k = 2; k < outline.size(); ++k) {
                const std::array<std::uint32_t, 3> piece{outline[0], outline[k - 1], outline[k]};
                std::uint32_t place = t;
                if (std::exchange(first, false)) {
                    mesh_.triangles[t] = piece;
                } else {
                    place = static_cast<std::uint32_t>(mesh_.triangles.size());
                    mesh_.triangles.push_back(piece);
                    mesh_.triangle_materials.push_back(mesh_.triangle_materials[t]);
                }
                (which == 0 ? sides.first : sides.second).push_back(place);
            }
        }
    }

    /// In the order of the places, not of the indices: vertices that the file splits at one place are cut at one place.
    std::uint32_t corner_between(std::uint32_t a, std::uint32_t b, int axis, double at) {
        const auto place = [&](std::uint32_t v) {
            return std::tuple(points_[v].x, points_[v].y, points_[v].z);
        };
        if (place(b) < place(a)) {
            std::swap(a, b);
        }
        const auto [known, is_new] = new_corners_.try_emplace(
            std::uint64_t{a} << 32U | b, static_cast<std::uint32_t>(mesh_.positions.size()));
        if (!is_new) {
            return known->second;
        }
        const double share = (at - points_[a][axis]) / (points_[b][axis] - points_[a][axis]);
        mesh_.positions.push_back(glm::mix(mesh_.positions[a], mesh_.positions[b], share));
        points_.push_back(glm::mix(points_[a], points_[b], share));
        points_.back()[axis] = at;
        const auto part = static_cast<float>(share);
        if (!mesh_.uvs.empty()) {
            mesh_.uvs.push_back(glm::mix(mesh_.uvs[a], mesh_.uvs[b], part));
        }
        if (!mesh_.colours.empty()) {
            mesh_.colours.push_back(glm::mix(mesh_.colours[a], mesh_.colours[b], part));
        }
        if (!mesh_.normals.empty()) {
            const glm::vec3 normal = glm::mix(mesh_.normals[a], mesh_.normals[b], part);
            const float length = glm::length(normal);
            mesh_.normals.push_back(length > 0.0F ? normal / length : glm::vec3(0.0F));
        }
        return known->second;
    }

    SourceMesh in_regions() {
        mesh_.nodes.clear();
        mesh_.animations.clear();
        mesh_.triangle_nodes.assign(mesh_.triangles.size(), 0);
        for (std::size_t region = 0; region < regions_.size(); ++region) {
            mesh_.nodes.push_back({.name = fmt::format("region {}", region + 1),
                                   .parent = std::nullopt,
                                   .parent_from_base = glm::dmat4(1.0),
                                   .rest = {}});
            for (const std::uint32_t t : regions_[region]) {
                mesh_.triangle_nodes[t] = static_cast<std::uint32_t>(region);
            }
        }
        return std::move(mesh_);
    }

    SourceMesh mesh_;
    std::vector<glm::dvec3> points_; ///< of its positions, in the box
    const SiteOptions& options_;
    std::vector<Triangles> regions_;
    std::unordered_map<std::uint64_t, std::uint32_t> new_corners_; ///< of one cut, by the edge's ends
};

} // namespace

Result<SourceMesh> cut_site(SourceMesh mesh, const BoxFrame& frame, const SiteOptions& options) {
    if (mesh.triangles.size() < min_site_triangles) {
        return bad_input(
            "bake.site_small",
            "the model has {} triangles; a site has at least {}, so that its regions show more than the "
            "whole: leave [site] out, or take a finer model",
            mesh.triangles.size(), min_site_triangles);
    }
    if (frame.box_size.z > std::max(frame.box_size.x, frame.box_size.y)) {
        return bad_input("bake.site_no_ground",
                         "the model is {:.2f} times as high as it is wide, so it has no ground to cut into "
                         "regions: set 'up' to the "
                         "axis that goes up, or leave [site] out",
                         frame.box_size.z / std::max(frame.box_size.x, frame.box_size.y));
    }
    return Cutter(std::move(mesh), frame, options).cut(frame);
}

} // namespace frustumscreen::bake
