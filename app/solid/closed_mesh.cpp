#include "app/solid/closed_mesh.h"

#include "app/geometry/union_find.h"
#include "app/solid/area_vector.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <utility>

namespace frustumscreen::solid {

namespace {

struct Extent {
    glm::dvec3 low{std::numeric_limits<double>::infinity()};
    glm::dvec3 high{-std::numeric_limits<double>::infinity()};
};

/// Bounds of the vertices that polygons use.
Extent extent_of(const PolygonMesh& mesh) {
    Extent extent;
    for (const Polygon& polygon : mesh.polygons) {
        for (const std::uint32_t corner : polygon.corners) {
            extent.low = glm::min(extent.low, mesh.vertices[corner]);
            extent.high = glm::max(extent.high, mesh.vertices[corner]);
        }
    }
    return extent;
}

bool is_allowed_size(double size_m) {
    return size_m >= min_size_m && size_m <= max_size_m;
}

Result<double> size_of(const PolygonMesh& mesh) {
    const Extent extent = extent_of(mesh);
    const glm::dvec3 edges = extent.high - extent.low;
    const double size_m = std::max({edges.x, edges.y, edges.z});
    if (is_allowed_size(size_m)) {
        return size_m;
    }
    const bool is_millimetres = mesh.unit == LengthUnit::Millimetre;
    const char* const remedy = is_millimetres && is_allowed_size(size_m * 1000.0)
                                   ? "it looks as if its numbers are metres: say so by the unit m"
                               : !is_millimetres && is_allowed_size(size_m / 1000.0)
                                   ? "it looks as if its numbers are millimetres: say so by the unit mm"
                                   : "draw it at its true size";
    return bad_input("prop_file.size", "it is {} long, allowed are {} to {}; {}", in_mm(size_m),
                     in_mm(min_size_m), in_mm(max_size_m), remedy);
}

Result<void> check_counts(const PolygonMesh& mesh) {
    std::size_t corners = 0;
    for (const Polygon& polygon : mesh.polygons) {
        corners += polygon.corners.size();
    }
    if (mesh.polygons.size() <= max_polygons && corners <= max_corners) {
        return {};
    }
    return bad_input(
        "prop_file.too_many",
        "it has {} polygons with {} corners, allowed are {} with {}; a prop has 4 to 16 flat faces, and "
        "a scan is not a prop: draw its shape alone",
        mesh.polygons.size(), corners, max_polygons, max_corners);
}

/// For each vertex, the first one at its place.
std::vector<std::uint32_t> first_at_place(const std::vector<glm::dvec3>& vertices, double distance_m) {
    std::multimap<double, std::uint32_t> firsts; // by x
    std::vector<std::uint32_t> places;
    for (std::uint32_t v = 0; v < vertices.size(); ++v) {
        const double x = vertices[v].x;
        auto near = firsts.lower_bound(x - distance_m);
        while (near != firsts.end() && near->first <= x + distance_m &&
               glm::distance(vertices[near->second], vertices[v]) > distance_m) {
            ++near;
        }
        const bool is_known = near != firsts.end() && near->first <= x + distance_m;
        places.push_back(is_known ? near->second : v);
        if (!is_known) {
            firsts.emplace(x, v);
        }
    }
    return places;
}

/// Makes vertices at one place one, and drops polygons that are left with two corners or one.
void weld(PolygonMesh& mesh, double distance_m) {
    const std::vector<std::uint32_t> places = first_at_place(mesh.vertices, distance_m);
    for (Polygon& polygon : mesh.polygons) {
        std::vector<std::uint32_t>& corners = polygon.corners;
        for (std::uint32_t& corner : corners) {
            corner = places[corner];
        }
        corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
        while (corners.size() > 1 && corners.front() == corners.back()) {
            corners.pop_back();
        }
    }
    std::erase_if(mesh.polygons, [](const Polygon& polygon) { return polygon.corners.size() < 3; });
}

/// One polygon's run along an edge between two vertices, `a` below `b`.
struct Run {
    std::uint32_t a = 0, b = 0;
    bool ascends = false; ///< from a to b
    std::uint32_t polygon = 0;
};

std::vector<Run> sorted_runs(const PolygonMesh& mesh) {
    std::vector<Run> runs;
    for (std::uint32_t p = 0; p < mesh.polygons.size(); ++p) {
        const std::vector<std::uint32_t>& corners = mesh.polygons[p].corners;
        for (std::size_t k = 0; k < corners.size(); ++k) {
            const auto [a, b] = std::pair(corners[k], corners[(k + 1) % corners.size()]);
            runs.push_back({std::min(a, b), std::max(a, b), a < b, p});
        }
    }
    std::stable_sort(runs.begin(), runs.end(),
                     [](const Run& x, const Run& y) { return std::pair(x.a, x.b) < std::pair(y.a, y.b); });
    return runs;
}

std::string between(const PolygonMesh& mesh, const Run& run) {
    return fmt::format("from {} to {}", in_mm(mesh.vertices[run.a]), in_mm(mesh.vertices[run.b]));
}

tl::unexpected<Error> open_edges(const PolygonMesh& mesh, const std::vector<Run>& open) {
    const auto length = [&](const Run& run) {
        return glm::distance(mesh.vertices[run.a], mesh.vertices[run.b]);
    };
    const Run& longest = *std::max_element(open.begin(), open.end(),
                                           [&](const Run& x, const Run& y) { return length(x) < length(y); });
    return bad_input(
        "prop_file.open",
        "its surface is open at {} edges, the longest of them {} long {}, where only {} is; close "
        "the surface, so that two faces meet at each edge, with corners at the same places",
        open.size(), in_mm(length(longest)), between(mesh, longest),
        place_of(mesh, mesh.polygons[longest.polygon]));
}

/// Pairs the runs along each edge.
Result<std::vector<SharedEdge>> pair_up(const PolygonMesh& mesh) {
    const std::vector<Run> runs = sorted_runs(mesh);
    std::vector<SharedEdge> edges;
    std::vector<Run> open;
    for (std::size_t begin = 0, end = 0; begin < runs.size(); begin = end) {
        const Run& run = runs[begin];
        while (end < runs.size() && runs[end].a == run.a && runs[end].b == run.b) {
            ++end;
        }
        const auto place = [&](std::size_t k) { return place_of(mesh, mesh.polygons[runs[k].polygon]); };
        if (end - begin > 2) {
            return bad_input(
                "prop_file.edge_of_many",
                "{} faces meet at the edge {}: {}, {}, {}{}; two are allowed: leave out what lies "
                "inside or twice",
                end - begin, between(mesh, run), place(begin), place(begin + 1), place(begin + 2),
                end - begin > 3 ? ", ..." : "");
        }
        if (end - begin == 1) {
            open.push_back(run);
            continue;
        }
        const Run& other = runs[begin + 1];
        if (run.ascends == other.ascends) {
            return bad_input("prop_file.turned",
                             "{} and {} are turned to different sides: they run in one direction along their "
                             "edge {}; turn one of them over, so that the corners of each go round "
                             "counter-clockwise seen from outside",
                             place(begin), place(begin + 1), between(mesh, run));
        }
        edges.push_back({.from = run.a,
                         .to = run.b,
                         .left = run.ascends ? run.polygon : other.polygon,
                         .right = run.ascends ? other.polygon : run.polygon});
    }
    if (!open.empty()) {
        return open_edges(mesh, open);
    }
    return edges;
}

/// Number of parts that edges hold together.
std::size_t parts_of(std::size_t polygons, const std::vector<SharedEdge>& edges) {
    geometry::UnionFind joined(polygons);
    std::size_t parts = polygons;
    for (const SharedEdge& edge : edges) {
        parts -= joined.join(edge.left, edge.right) ? 1 : 0;
    }
    return parts;
}

/// Inside a closed surface; negative if it is inside out.
double volume_of(const PolygonMesh& mesh) {
    const glm::dvec3 origin = mesh.vertices[mesh.polygons.front().corners.front()];
    double volume = 0.0;
    for (const Polygon& polygon : mesh.polygons) {
        const glm::dvec3 to_corner = mesh.vertices[polygon.corners.front()] - origin;
        volume += glm::dot(area_vector(corners_of(mesh, polygon)), to_corner) / 3.0;
    }
    return volume;
}

void turn_inside_out(ClosedMesh& closed) {
    for (Polygon& polygon : closed.mesh.polygons) {
        std::reverse(polygon.corners.begin() + 1, polygon.corners.end()); // the first corner stays the first
    }
    for (SharedEdge& edge : closed.edges) {
        std::swap(edge.left, edge.right);
    }
    closed.volume_m3 = -closed.volume_m3;
    closed.was_inside_out = true;
}

} // namespace

Result<ClosedMesh> close_up(PolygonMesh mesh) {
    TRY_VOID(check_counts(mesh));
    ClosedMesh closed;
    TRY(closed.size_m, size_of(mesh));
    weld(mesh, weld_share * closed.size_m);
    TRY(closed.edges, pair_up(mesh));
    if (const std::size_t parts = parts_of(mesh.polygons.size(), closed.edges); parts != 1) {
        return bad_input(
            "prop_file.parts",
            "it has {} bodies that do not share an edge; a prop is one body: leave out the others, "
            "or draw the outside of all of them as one",
            parts);
    }
    closed.volume_m3 = volume_of(mesh);
    closed.mesh = std::move(mesh);
    constexpr double min_volume_share = 1e-6;
    if (!(std::abs(closed.volume_m3) > min_volume_share * std::pow(closed.size_m, 3))) {
        return bad_input("prop_file.no_volume",
                         "it is flat: its faces enclose {:.3g} cm3; draw a body with an inside",
                         std::abs(closed.volume_m3) * 1e6);
    }
    if (closed.volume_m3 < 0.0) {
        turn_inside_out(closed);
    }
    return closed;
}

} // namespace frustumscreen::solid
