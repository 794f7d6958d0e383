// Prop files: refused in one line, or a closed convex solid of 4 to 16 faces, which is written and read again.
#include "app/solid/prop_file.h"
#include "tests/fuzz/fuzz.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

using namespace frustumscreen;

namespace {

using Point = std::array<double, 3>;
Point point_of(const glm::dvec3& p) {
    return {p.x, p.y, p.z};
}

/// Each edge belongs to two faces, which run along it in opposite directions; and Euler's formula holds.
void require_closed(const solid::Solid& solid) {
    std::set<std::pair<Point, Point>> edges;
    std::set<Point> corners;
    for (const solid::SolidFace& face : solid.faces) {
        fuzz::require(face.corners.size() >= 3, "a face has three corners");
        for (std::size_t k = 0; k < face.corners.size(); ++k) {
            const Point from = point_of(face.corners[k]);
            corners.insert(from);
            fuzz::require(edges.emplace(from, point_of(face.corners[(k + 1) % face.corners.size()])).second,
                          "an edge is run along once in each direction");
        }
    }
    for (const auto& [from, to] : edges) {
        fuzz::require(edges.count({to, from}) == 1, "an edge has a face on its other side");
    }
    fuzz::require(corners.size() == solid.corners.size(), "the corners are those of the faces");
    fuzz::require(corners.size() + solid.faces.size() == edges.size() / 2 + 2,
                  "it is one body without holes");
}

void require_convex(const solid::Solid& solid) {
    std::set<std::string> names;
    for (const solid::SolidFace& face : solid.faces) {
        fuzz::require(names.insert(face.name).second && !face.name.empty(), "a face has a name of its own");
        fuzz::require(std::abs(glm::length(face.plane.normal) - 1.0) < 1e-9, "a normal has length 1");
        for (const glm::dvec3& corner : solid.corners) {
            fuzz::require(fuzz::is_finite(corner), "a corner is finite");
            fuzz::require(face.plane.distance(corner) <= solid::flatness_m,
                          "no corner lies outside of a face");
        }
        for (const glm::dvec3& corner : face.corners) {
            fuzz::require(std::abs(face.plane.distance(corner)) <= solid::flatness_m, "a face is flat");
        }
    }
}

void require_sound(const solid::PropFile& file) {
    const solid::Solid& solid = file.solid;
    fuzz::require(solid.faces.size() >= solid::min_faces && solid.faces.size() <= solid::max_faces,
                  "it has 4 to 16 faces");
    require_closed(solid);
    require_convex(solid);
    const solid::SolidBox box = solid::box_around(solid);
    const glm::dvec3 edges = box.high - box.low;
    const double width = solid::min_width(solid).width_m;
    fuzz::require(width >= 0.0 && width <= std::min({edges.x, edges.y, edges.z}) + solid::flatness_m,
                  "it is no wider than its box");
    fuzz::require(std::isfinite(solid::volume_of(solid)), "its volume is finite");
    for (const std::string& note : file.notes) {
        fuzz::require_one_line(note);
    }
    if (const Result<void> stands = solid::check_stand(solid); !stands) {
        fuzz::require_one_line(stands.error().message);
    }
}

/// The text alone: whether the solid is taken again depends on rounding, where it is hardly flat enough.
void require_same_text(const solid::Solid& solid) {
    const Result<solid::ObjText> again =
        solid::parse_obj(solid::write_prop_file(solid), solid::LengthUnit::Millimetre);
    fuzz::require(again.has_value() && again->notes.empty(), "what was written is read",
                  again ? "" : again.error().message);
    fuzz::require(again->mesh.polygons.size() == solid.faces.size(), "it has the same faces");
    for (std::size_t k = 0; k < solid.faces.size(); ++k) {
        const solid::Polygon& polygon = again->mesh.polygons[k];
        const solid::SolidFace& face = solid.faces[k];
        fuzz::require(polygon.name == face.name && polygon.corners.size() == face.corners.size(),
                      "a face has the same name and corners", face.name);
        for (std::size_t c = 0; c < face.corners.size(); ++c) {
            fuzz::require(glm::distance(again->mesh.vertices[polygon.corners[c]], face.corners[c]) < 1e-8,
                          "a corner is at the same place");
        }
    }
}

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text = fuzz::text_of(data, size);
    for (const solid::LengthUnit unit : {solid::LengthUnit::Millimetre, solid::LengthUnit::Metre}) {
        const Result<solid::PropFile> file = solid::parse_prop_file(text, unit);
        if (!file) {
            fuzz::require_one_line(file.error().message);
            continue;
        }
        require_sound(*file);
        require_same_text(file->solid);
    }
    return 0;
}
