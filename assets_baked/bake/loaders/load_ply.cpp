#include "assets_baked/bake/loaders/load_ply.h"

#include "assets_baked/bake/loaders/mesh_assembly.h"
#include "assets_baked/bake/loaders/ply_surface.h"
#include "assets_baked/bake/loaders/ply_values.h"
#include "assets_baked/bake/loaders/polygon.h"

#include <algorithm>
#include <cmath>

namespace frustumscreen {

namespace {

/// What a vertex's property stands for: 0..2 position, 3..6 colour and alpha, 7..8 texture coordinates, -1
/// nothing.
int role_of(const PlyProperty& property) {
    static constexpr std::array<std::string_view, 15> names = {
        "x", "y", "z", "red",       "green",     "blue",      "alpha",    "s",
        "t", "u", "v", "texture_u", "texture_v", "texture_s", "texture_t"};
    const auto found = std::find(names.begin(), names.end(), property.name);
    if (property.list_count || found == names.end()) {
        return -1;
    }
    const int place = static_cast<int>(found - names.begin());
    return place < 7 ? place : 7 + (place - 7) % 2;
}

double colour01(double value, PlyType type) {
    switch (type) {
    case PlyType::F32:
    case PlyType::F64:
        return std::isfinite(value) ? std::clamp(value, 0.0, 1.0) : 1.0;
    case PlyType::U16:
        return value / 65535.0;
    default:
        return std::clamp(value / 255.0, 0.0, 1.0);
    }
}

class PlyReader {
public:
    PlyReader(ByteView file, ModelFiles& files)
        : header_(ply_header_from(file)), values_(file, header_), files_(files),
          surface_(header_.pictures, files, mesh_) {}

    SourceMesh read() {
        files_.about = header_.about;
        for (const PlyElement& element : header_.elements) {
            if (element.properties.empty()) {
                continue; // it has no data, whatever its count
            }
            if (element.name == "vertex") {
                read_vertices(element);
            } else {
                read_lists(element);
            }
        }
        make_triangles();
        return mesh_.finish();
    }

private:
    void read_vertices(const PlyElement& element) {
        std::vector<int> roles;
        for (const PlyProperty& property : element.properties) {
            roles.push_back(role_of(property));
        }
        const auto has = [&](int role) { return std::find(roles.begin(), roles.end(), role) != roles.end(); };
        for (int axis = 0; axis < 3; ++axis) {
            if (!has(axis)) {
                refuse_damage("the vertices have no {}", "xyz"[axis]);
            }
        }
        const bool coloured = has(3);
        const bool textured = has(7) && has(8);
        for (std::uint64_t row = 0; row < element.count; ++row) {
            std::array<double, 9> v{0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0, 0.0, 0.0};
            for (std::size_t i = 0; i < roles.size(); ++i) {
                read_vertex_property(element, i, roles[i], row, v);
            }
            (void)mesh_.add_vertex({v[0], v[1], v[2]}, "vertex", static_cast<std::size_t>(row));
            if (coloured) {
                mesh_.set_colour(
                    glm::vec4(linear_from_srgb(v[3]), linear_from_srgb(v[4]), linear_from_srgb(v[5]), v[6]));
            }
            if (textured) {
                mesh_.set_uv({v[7], 1.0 - v[8]});
            }
        }
        surface_.at_vertices(coloured, textured);
    }

    void read_vertex_property(const PlyElement& element, std::size_t i, int role, std::uint64_t row,
                              std::array<double, 9>& vertex) {
        const PlyProperty& property = element.properties[i];
        if (property.list_count) {
            skip_list(element, property, row);
            return;
        }
        const double value = values_.next(property.type, element, row);
        if (role >= 0) {
            const bool is_colour = role >= 3 && role <= 6;
            vertex[static_cast<std::size_t>(role)] = is_colour ? colour01(value, property.type) : value;
        }
    }

    std::int64_t list_length(const PlyElement& element, const PlyProperty& property, std::uint64_t row) {
        const std::int64_t length = values_.next_whole(*property.list_count, element, row);
        if (length < 0) {
            refuse_damage("{} {}: a list's length is {}", element.name, row, length);
        }
        return length;
    }

    void skip_list(const PlyElement& element, const PlyProperty& property, std::uint64_t row) {
        for (std::int64_t left = list_length(element, property, row); left > 0; --left) {
            (void)values_.next(property.type, element, row);
        }
    }

    /// Reads faces and strips; skips other elements value by value.
    void read_lists(const PlyElement& element) {
        const bool faces = element.name == "face";
        const bool strips = element.name == "tristrips";
        for (std::uint64_t row = 0; row < element.count; ++row) {
            const std::size_t first = corners_.size();
            for (const PlyProperty& property : element.properties) {
                const bool corners = property.name == "vertex_indices" || property.name == "vertex_index";
                if (faces && !property.list_count) {
                    surface_.face_value(property.name, values_.next(property.type, element, row));
                } else if (!property.list_count) {
                    (void)values_.next(property.type, element, row);
                } else if ((faces || strips) && corners) {
                    read_corners(element, property, row, strips);
                } else if (faces && property.name == "texcoord") {
                    read_texcoords(element, property, row);
                } else {
                    skip_list(element, property, row);
                }
            }
            if (faces) {
                surface_.end_face(first, corners_.size());
            }
        }
    }

    void read_texcoords(const PlyElement& element, const PlyProperty& property, std::uint64_t row) {
        for (std::int64_t left = list_length(element, property, row); left > 0; --left) {
            surface_.face_texcoord(values_.next(property.type, element, row));
        }
    }

    void read_corners(const PlyElement& element, const PlyProperty& property, std::uint64_t row, bool strip) {
        std::vector<std::int64_t> corners;
        for (std::int64_t left = list_length(element, property, row); left > 0; --left) {
            corners.push_back(values_.next_whole(property.type, element, row));
        }
        if (!strip) {
            add_polygon(corners, row);
            return;
        }
        std::size_t begin = 0;
        for (std::size_t i = 2; i < corners.size(); ++i) {
            if (corners[i] < 0) { // a new strip starts
                begin = i + 1;
                i += 2;
            } else {
                const bool odd = (i - begin) % 2 == 1;
                add_polygon({corners[i - 2], corners[odd ? i : i - 1], corners[odd ? i - 1 : i]}, row);
            }
        }
    }

    /// Polygons are kept until the vertices are known, because faces may come first.
    void add_polygon(const std::vector<std::int64_t>& corners, std::uint64_t row) {
        for (const std::int64_t corner : corners) {
            if (corner < 0 || corner >= static_cast<std::int64_t>(most_source_vertices)) {
                refuse_contradiction("face {}: vertex {} is out of range", row, corner);
            }
            corners_.push_back(static_cast<std::uint32_t>(corner));
        }
        polygon_ends_.push_back(corners_.size());
    }

    void check_corners() const {
        std::size_t corner = 0;
        for (std::size_t polygon = 0; polygon < polygon_ends_.size(); ++polygon) {
            for (; corner < polygon_ends_[polygon]; ++corner) {
                if (corners_[corner] >= mesh_.positions().size()) {
                    refuse_contradiction("face {}: vertex {} is out of range, the file has {}", polygon,
                                         corners_[corner], mesh_.positions().size());
                }
            }
        }
    }

    void make_triangles() {
        check_corners();
        surface_.begin();
        std::vector<glm::dvec3> points;
        std::vector<std::array<std::uint32_t, 3>> triangles;
        std::size_t faces_without_area = 0;
        std::size_t begin = 0;
        for (const std::size_t end : polygon_ends_) {
            const auto corners = std::span(corners_).subspan(begin, end - begin);
            points.clear();
            triangles.clear();
            for (const std::uint32_t corner : corners) {
                points.push_back(mesh_.positions()[corner]);
            }
            triangulate_polygon(points, triangles);
            faces_without_area += triangles.empty() ? 1 : 0;
            const std::uint32_t material = surface_.material(begin);
            surface_.split(begin, corners);
            for (const auto& [a, b, c] : triangles) {
                mesh_.add_triangle(corners[a], corners[b], corners[c], material);
            }
            begin = end;
        }
        if (faces_without_area > 0) {
            files_.notes.lost("{} of fewer than three corners", counted(faces_without_area, "face", "faces"));
        }
    }

    PlyHeader header_;
    PlyValues values_;
    ModelFiles& files_;
    MeshAssembly mesh_{'y'};
    PlySurface surface_;
    std::vector<std::uint32_t> corners_;
    std::vector<std::size_t> polygon_ends_;
};

} // namespace

SourceMesh load_ply(ByteView file, ModelFiles& files) {
    return PlyReader(file, files).read();
}

} // namespace frustumscreen
