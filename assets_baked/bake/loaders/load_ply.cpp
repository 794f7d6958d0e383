#include "assets_baked/bake/loaders/load_ply.h"

#include "assets_baked/bake/loaders/mesh_assembly.h"
#include "assets_baked/bake/loaders/ply_roles.h"
#include "assets_baked/bake/loaders/ply_surface.h"
#include "assets_baked/bake/loaders/ply_values.h"
#include "assets_baked/bake/loaders/polygon.h"
#include "firmware_host/base/printable.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace frustumscreen {

namespace {

/// A colour's code in 0..1; a floating-point number as written, which may be in 0..255.
double code_from(double value, PlyType type) {
    switch (type) {
    case PlyType::F32:
    case PlyType::F64:
        return std::isfinite(value) ? value : 1.0;
    case PlyType::U16:
        return value / 65535.0;
    default:
        return std::clamp(value / 255.0, 0.0, 1.0);
    }
}

/// Red, green and blue in the bits of one number, as the Point Cloud Library writes them.
glm::vec4 unpacked_colour(double value, PlyType type) {
    const std::uint32_t bits = type == PlyType::F32
                                   ? std::bit_cast<std::uint32_t>(static_cast<float>(value))
                                   : static_cast<std::uint32_t>(static_cast<std::int64_t>(value));
    const auto byte = [&](unsigned shift) { return static_cast<float>((bits >> shift) & 0xffU) / 255.0F; };
    return {byte(16), byte(8), byte(0), 1.0F};
}

struct PlyVertex {
    glm::dvec3 position{0.0};
    glm::vec4 code{1.0F}; ///< colour
    glm::dvec2 uv{0.0};
    glm::dvec3 normal{0.0};
};

class PlyReader {
public:
    PlyReader(ByteView file, ModelFiles& files)
        : header_(ply_header_from(file)), values_(file, header_), files_(files),
          surface_(header_.pictures, files, mesh_) {}

    SourceMesh read() {
        files_.about = header_.about;
        for (const PlyElement& element : header_.elements) {
            if (element.properties.empty()) {
                continue; // an element without data, whatever its count
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
    void tell_passed(std::uint64_t row) const {
        constexpr std::uint64_t rows = 1U << 16U;
        if (row % rows == 0) {
            files_.passed(values_.passed());
        }
    }

    void read_vertices(const PlyElement& element) {
        const PlyRoles roles = roles_of_vertices(element);
        for (const PlyRole axis : {PlyRole::X, PlyRole::Y, PlyRole::Z}) {
            if (!roles.has(axis)) {
                refuse_damage("the vertices have no {}",
                              "xyz"[static_cast<int>(axis) - static_cast<int>(PlyRole::X)]);
            }
        }
        const bool coloured = roles.has_colour();
        const bool has_normals = roles.has_normal();
        const bool textured = roles.has(PlyRole::U) && roles.has(PlyRole::V);
        if (!coloured && (roles.has(PlyRole::Red) || roles.has(PlyRole::Green) || roles.has(PlyRole::Blue))) {
            files_.notes.lost("the colours at its points: red, green and blue are not all there");
        }
        note_unknown("points", roles.unknown);
        mesh_.expect_vertices(static_cast<std::size_t>(values_.possible_rows(element)));
        for (std::uint64_t row = 0; row < element.count; ++row) {
            tell_passed(row);
            PlyVertex vertex;
            for (std::size_t i = 0; i < roles.of.size(); ++i) {
                read_vertex_property(element, i, roles.of[i], row, vertex);
            }
            (void)mesh_.add_vertex(vertex.position, "vertex", static_cast<std::size_t>(row));
            if (coloured) {
                mesh_.set_colour_code(vertex.code);
            }
            if (has_normals) {
                mesh_.set_normal(vertex.normal);
            }
            if (textured) {
                mesh_.set_uv({vertex.uv.x, 1.0 - vertex.uv.y});
            }
        }
        if (coloured && mesh_.codes_to_linear()) {
            files_.notes.guessed("the colours at its points are read as 0 to 255, because some are above 1");
        }
        surface_.at_vertices(coloured, textured);
    }

    void note_unknown(std::string_view where, const std::vector<std::string>& names) {
        if (!names.empty()) {
            files_.notes.lost("numbers at its {} that this program does not know: {}", where,
                              printable(fmt::format("{}", fmt::join(names, ", "))));
        }
    }

    void read_vertex_property(const PlyElement& element, std::size_t i, PlyRole role, std::uint64_t row,
                              PlyVertex& vertex) {
        const PlyProperty& property = element.properties[i];
        if (property.list_count) {
            skip_list(element, property, row);
            return;
        }
        const double value = values_.next(property.type, element, row);
        switch (role) {
        case PlyRole::X:
        case PlyRole::Y:
        case PlyRole::Z:
            vertex.position[static_cast<int>(role) - static_cast<int>(PlyRole::X)] = value;
            break;
        case PlyRole::Red:
        case PlyRole::Green:
        case PlyRole::Blue:
        case PlyRole::Alpha:
            vertex.code[static_cast<int>(role) - static_cast<int>(PlyRole::Red)] =
                static_cast<float>(code_from(value, property.type));
            break;
        case PlyRole::U:
            vertex.uv.x = value;
            break;
        case PlyRole::V:
            vertex.uv.y = value;
            break;
        case PlyRole::NormalX:
        case PlyRole::NormalY:
        case PlyRole::NormalZ:
            vertex.normal[static_cast<int>(role) - static_cast<int>(PlyRole::NormalX)] = value;
            break;
        case PlyRole::PackedColour:
            vertex.code = unpacked_colour(value, property.type);
            break;
        case PlyRole::None:
            break;
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
        const std::size_t corner_list = corner_list_of(element);
        note_unread(element, faces || strips, corner_list);
        if (faces) {
            corners_.reserve(
                3 * std::min(static_cast<std::size_t>(values_.possible_rows(element)), max_triangles));
        }
        for (std::uint64_t row = 0; row < element.count; ++row) {
            tell_passed(row);
            const std::size_t first = corners_.size();
            for (std::size_t i = 0; i < element.properties.size(); ++i) {
                const PlyProperty& property = element.properties[i];
                const bool corners = i == corner_list;
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

    /// Index of the property with a face's corners; the number of properties if there is none.
    static std::size_t corner_list_of(const PlyElement& element) {
        const auto is_named = [](const PlyProperty& property) {
            std::string name = property.name;
            std::transform(name.begin(), name.end(), name.begin(), [](char c) {
                return c >= 'A' && c <= 'Z' ? static_cast<char>(c + ('a' - 'A')) : c;
            });
            return property.list_count && (name == "vertex_indices" || name == "vertex_index" ||
                                           name == "vertexindices" || name == "indices");
        };
        return static_cast<std::size_t>(
            std::find_if(element.properties.begin(), element.properties.end(), is_named) -
            element.properties.begin());
    }

    void note_unread(const PlyElement& element, bool is_shown, std::size_t corner_list) {
        if (!is_shown) {
            if (element.count > 0 && element.name != "edge" && element.name != "camera") {
                files_.notes.lost("the part \"{}\" of the file, which this program does not know",
                                  printable(element.name));
            }
            return;
        }
        std::vector<std::string> unknown;
        for (std::size_t i = 0; i < element.properties.size(); ++i) {
            if (i != corner_list && !is_known_at_faces(element.properties[i].name)) {
                unknown.push_back(element.properties[i].name);
            }
        }
        note_unknown("faces", unknown);
    }

    void read_texcoords(const PlyElement& element, const PlyProperty& property, std::uint64_t row) {
        for (std::int64_t left = list_length(element, property, row); left > 0; --left) {
            surface_.face_texcoord(values_.next(property.type, element, row));
        }
    }

    void read_corners(const PlyElement& element, const PlyProperty& property, std::uint64_t row, bool strip) {
        std::vector<std::int64_t>& corners = row_;
        corners.clear();
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

    /// Keeps polygons until the vertices are known, because faces may come first.
    void add_polygon(const std::vector<std::int64_t>& corners, std::uint64_t row) {
        for (const std::int64_t corner : corners) {
            if (corner < 0 || corner >= static_cast<std::int64_t>(max_source_vertices)) {
                refuse_contradiction("face {}: vertex {} is out of range", row, corner);
            }
            corners_.push_back(static_cast<std::uint32_t>(corner));
        }
        add_size(static_cast<std::uint32_t>(corners.size()));
    }

    /// Sizes are kept only once there is a polygon that is no triangle.
    void add_size(std::uint32_t size) {
        if (sizes_.empty() && size != 3) {
            sizes_.assign(polygons_, 3);
        }
        if (!sizes_.empty() || size != 3) {
            sizes_.push_back(size);
        }
        ++polygons_;
    }
    [[nodiscard]] std::size_t size_of_polygon(std::size_t polygon) const {
        return sizes_.empty() ? 3 : sizes_[polygon];
    }

    void check_corners() const {
        std::size_t corner = 0;
        for (std::size_t polygon = 0; polygon < polygons_; ++polygon) {
            for (const std::size_t end = corner + size_of_polygon(polygon); corner < end; ++corner) {
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
        mesh_.expect_triangles(polygons_);
        for (std::size_t polygon = 0; polygon < polygons_; ++polygon) {
            const auto corners = std::span(corners_).subspan(begin, size_of_polygon(polygon));
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
            begin += corners.size();
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
    std::size_t polygons_ = 0;
    std::vector<std::uint32_t> sizes_; ///< of all polygons; empty while they are triangles
    std::vector<std::int64_t> row_;    ///< corners of the row that is read
};

} // namespace

SourceMesh load_ply(ByteView file, ModelFiles& files) {
    return PlyReader(file, files).read();
}

} // namespace frustumscreen
