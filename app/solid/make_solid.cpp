#include "app/solid/make_solid.h"

#include "app/solid/closed_mesh.h"
#include "app/solid/face_outlines.h"
#include "app/solid/join_faces.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <utility>

namespace frustumscreen::solid {

namespace {

/// For each group's name, the faces that have polygons of it.
std::map<std::string, std::set<std::size_t>> faces_of_groups(const PolygonMesh& mesh,
                                                             const std::vector<JoinedFace>& faces) {
    std::map<std::string, std::set<std::size_t>> groups;
    for (std::size_t k = 0; k < faces.size(); ++k) {
        for (const std::uint32_t polygon : faces[k].polygons) {
            groups[mesh.polygons[polygon].name].insert(k);
        }
    }
    groups.erase("");
    return groups;
}

/// Unique: the group's if it is of this face alone, else F and the face's number, or a number that is free.
std::vector<std::string> names_of(const PolygonMesh& mesh, const std::vector<JoinedFace>& faces) {
    const std::map<std::string, std::set<std::size_t>> groups = faces_of_groups(mesh, faces);
    std::vector<std::string> names(faces.size());
    std::set<std::string> used;
    for (std::size_t k = 0; k < faces.size(); ++k) {
        const std::string& name = mesh.polygons[faces[k].polygons.front()].name;
        const auto group = groups.find(name);
        if (group != groups.end() && group->second.size() == 1) {
            names[k] = name;
            used.insert(name);
        }
    }
    std::size_t free = faces.size();
    for (std::size_t k = 0; k < faces.size(); ++k) {
        if (names[k].empty()) {
            names[k] = fmt::format("F{}", k + 1);
            while (!used.insert(names[k]).second) {
                names[k] = fmt::format("F{}", ++free);
            }
        }
    }
    return names;
}

Result<void> check_count(const ClosedMesh& closed, std::size_t faces) {
    if (faces >= min_faces && faces <= max_faces) {
        return {};
    }
    return bad_input(
        "prop_file.faces",
        "it has {} flat faces, made of {} polygons; allowed are {} to {}: make edges sharp instead "
        "of round, and curved sides of few flat ones",
        faces, closed.mesh.polygons.size(), min_faces, max_faces);
}

/// A face of a message: "face F3, with the face of line 12,".
std::string described(const PolygonMesh& mesh, const JoinedFace& face, const std::string& name) {
    const Polygon& first = mesh.polygons[face.polygons.front()];
    return mesh.numbers == PolygonMesh::Numbers::Lines
               ? fmt::format("face {} (line {})", name, first.number)
               : fmt::format("face {} (with triangle {})", name, first.number);
}

struct Deviation {
    double distance_m = 0.0;
    std::uint32_t vertex = 0;
    std::size_t face = 0;
};

/// The largest `distance(face's plane, corner)` above 0 of all `corners_to(face)`.
Deviation max_deviation(const ClosedMesh& closed, const std::vector<JoinedFace>& faces,
                        const auto& corners_to, const auto& distance) {
    Deviation worst;
    for (std::size_t k = 0; k < faces.size(); ++k) {
        for (const std::uint32_t vertex : corners_to(faces[k])) {
            const double each = distance(faces[k].plane, closed.mesh.vertices[vertex]);
            if (!(each <= worst.distance_m)) {
                worst = {each, vertex, k};
            }
        }
    }
    return worst;
}

Result<void> check_flat(const ClosedMesh& closed, const std::vector<JoinedFace>& faces,
                        const std::vector<std::string>& described) {
    const auto own_corners = [&](const JoinedFace& face) {
        std::vector<std::uint32_t> corners;
        for (const std::uint32_t polygon : face.polygons) {
            const std::vector<std::uint32_t>& more = closed.mesh.polygons[polygon].corners;
            corners.insert(corners.end(), more.begin(), more.end());
        }
        return corners;
    };
    const Deviation worst =
        max_deviation(closed, faces, own_corners, [](const geometry::Plane& plane, const glm::dvec3& corner) {
            return std::abs(plane.distance(corner));
        });
    if (worst.distance_m <= flatness_m) {
        return {};
    }
    return bad_input(
        "prop_file.not_flat",
        "{} is not flat: its corner {} lies {} beside the plane that fits it best, allowed are {}; "
        "move the corner into the plane, or make two faces of it",
        described[worst.face], in_mm(closed.mesh.vertices[worst.vertex]), in_mm(worst.distance_m),
        in_mm(flatness_m));
}

Result<void> check_convex(const ClosedMesh& closed, const std::vector<JoinedFace>& faces,
                          const std::vector<std::string>& described) {
    std::set<std::uint32_t> used;
    for (const Polygon& polygon : closed.mesh.polygons) {
        used.insert(polygon.corners.begin(), polygon.corners.end());
    }
    const Deviation worst = max_deviation(
        closed, faces, [&](const JoinedFace&) -> const std::set<std::uint32_t>& { return used; },
        [](const geometry::Plane& plane, const glm::dvec3& corner) { return plane.distance(corner); });
    if (worst.distance_m <= flatness_m) {
        return {};
    }
    return bad_input(
        "prop_file.not_convex",
        "it is not convex: the corner {} lies {} outside the plane of {}, allowed are {}; fill the "
        "hollow, so that no face looks at another",
        in_mm(closed.mesh.vertices[worst.vertex]), in_mm(worst.distance_m), described[worst.face],
        in_mm(flatness_m));
}

/// A face of a convex solid meets each other face at one edge.
Result<void> check_corners(const Solid& solid, const std::vector<std::string>& described) {
    for (std::size_t k = 0; k < solid.faces.size(); ++k) {
        if (solid.faces[k].corners.size() > geometry::max_face_corners) {
            return bad_input("prop_file.edges_of_face",
                             "{} has {} corners, allowed are {}; it meets another face at two edges: make "
                             "one face of what lies between them",
                             described[k], solid.faces[k].corners.size(), geometry::max_face_corners);
        }
    }
    return {};
}

/// Two faces in one plane that look to one side overlap, or something lies between them.
Result<void> check_apart(const ClosedMesh& closed, const Solid& solid,
                         const std::vector<std::string>& described) {
    const double distance = joining_distance(closed);
    for (std::size_t a = 0; a < solid.faces.size(); ++a) {
        for (std::size_t b = 0; b < solid.faces.size(); ++b) {
            const geometry::Plane& plane = solid.faces[a].plane;
            const std::vector<glm::dvec3>& corners = solid.faces[b].corners;
            const auto is_near = [&](const glm::dvec3& p) { return std::abs(plane.distance(p)) <= distance; };
            if (a != b && glm::dot(plane.normal, solid.faces[b].plane.normal) > 0.0 &&
                std::all_of(corners.begin(), corners.end(), is_near)) {
                return bad_input(
                    "prop_file.one_plane",
                    "{} and {} lie in one plane; draw them as one face, and nothing between them",
                    described[std::min(a, b)], described[std::max(a, b)]);
            }
        }
    }
    return {};
}

Solid solid_of(const ClosedMesh& closed, const std::vector<JoinedFace>& faces, std::vector<std::string> names,
               const std::vector<std::vector<std::uint32_t>>& outlines) {
    Solid solid;
    std::set<std::uint32_t> used;
    for (std::size_t k = 0; k < faces.size(); ++k) {
        SolidFace face{.name = std::move(names[k]), .plane = faces[k].plane, .corners = {}};
        for (const std::uint32_t vertex : outlines[k]) {
            face.corners.push_back(closed.mesh.vertices[vertex]);
        }
        used.insert(outlines[k].begin(), outlines[k].end());
        solid.faces.push_back(std::move(face));
    }
    for (const std::uint32_t vertex : used) {
        solid.corners.push_back(closed.mesh.vertices[vertex]);
    }
    return solid;
}

std::vector<std::string> notes_on(const ClosedMesh& closed, std::size_t faces) {
    std::vector<std::string> notes;
    if (closed.was_inside_out) {
        notes.emplace_back("its faces were inside out, and are turned: their corners go round clockwise seen "
                           "from outside");
    }
    if (closed.mesh.polygons.size() > faces) {
        notes.push_back(
            fmt::format("its {} polygons are joined into {} flat faces", closed.mesh.polygons.size(), faces));
    }
    return notes;
}

} // namespace

Result<MadeSolid> make_solid(PolygonMesh mesh) {
    TRY(const ClosedMesh closed, close_up(std::move(mesh)));
    const std::vector<JoinedFace> faces = join_faces(closed);
    TRY_VOID(check_count(closed, faces.size()));
    std::vector<std::string> names = names_of(closed.mesh, faces);
    std::vector<std::string> descriptions;
    for (std::size_t k = 0; k < faces.size(); ++k) {
        descriptions.push_back(described(closed.mesh, faces[k], names[k]));
    }
    TRY_VOID(check_flat(closed, faces, descriptions));
    TRY_VOID(check_convex(closed, faces, descriptions));
    TRY(const auto outlines, face_outlines(closed, faces, descriptions));
    MadeSolid made;
    made.solid = solid_of(closed, faces, std::move(names), outlines);
    TRY_VOID(check_apart(closed, made.solid, descriptions));
    TRY_VOID(check_corners(made.solid, descriptions));
    made.notes = notes_on(closed, faces.size());
    return made;
}

} // namespace frustumscreen::solid
