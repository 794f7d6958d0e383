#include "assets_baked/bake/loaders/load_ply.h"

#include "assets_baked/bake/loaders/mesh_assembly.h"
#include "assets_baked/bake/loaders/ply_header.h"
#include "assets_baked/bake/loaders/polygon.h"
#include "assets_baked/bake/loaders/text.h"
#include "firmware_host/base/file.h"

#include <algorithm>
#include <cmath>

namespace frustumscreen {

namespace {

/// Reads the values after the header one by one, text or binary.
class PlyValues {
public:
    PlyValues(ByteView file, const PlyHeader& header)
        : header_(header), data_(file.subspan(header.size)), words_(as_text(data_)) {}

    double next(PlyType type, const PlyElement& element, std::uint64_t row) {
        if (header_.is_text) {
            return next_word(element, row);
        }
        if (size_of(type) > data_.size() - position_) {
            refuse_end(element, row);
        }
        const double value = binary(type);
        position_ += size_of(type);
        return value;
    }
    /// A length or an index.
    std::int64_t next_whole(PlyType type, const PlyElement& element, std::uint64_t row) {
        const double value = next(type, element, row);
        if (!(std::abs(value) < 9e15) || value != std::floor(value)) {
            refuse("{} {}: a whole number is expected, not {}", element.name, row, value);
        }
        return static_cast<std::int64_t>(value);
    }

private:
    [[noreturn]] static void refuse_end(const PlyElement& element, std::uint64_t row) {
        refuse("{} {} of {}: the file ends too early, it is truncated", element.name, row, element.count);
    }
    double next_word(const PlyElement& element, std::uint64_t row) {
        const std::string_view word = words_.next();
        if (word.empty()) {
            refuse_end(element, row);
        }
        const std::optional<double> number = number_from(word);
        if (!number) {
            refuse("{} {}: a number is expected, not \"{}\"", element.name, row, word.substr(0, 40));
        }
        return *number;
    }
    [[nodiscard]] double binary(PlyType type) const {
        switch (type) {
        case PlyType::I8:
            return load<std::int8_t>(data_, position_, header_.order);
        case PlyType::U8:
            return load<std::uint8_t>(data_, position_, header_.order);
        case PlyType::I16:
            return load<std::int16_t>(data_, position_, header_.order);
        case PlyType::U16:
            return load<std::uint16_t>(data_, position_, header_.order);
        case PlyType::I32:
            return load<std::int32_t>(data_, position_, header_.order);
        case PlyType::U32:
            return load<std::uint32_t>(data_, position_, header_.order);
        case PlyType::F32:
            return static_cast<double>(load<float>(data_, position_, header_.order));
        default:
            return load<double>(data_, position_, header_.order);
        }
    }

    const PlyHeader& header_;
    ByteView data_;
    std::size_t position_ = 0;
    WordReader words_;
};

/// What a vertex's property stands for: 0..2 position, 3..6 colour and alpha, -1 nothing.
int role_of(const PlyProperty& property) {
    static constexpr std::array<std::string_view, 7> names = {"x", "y", "z", "red", "green", "blue", "alpha"};
    const auto found = std::find(names.begin(), names.end(), property.name);
    return property.list_count || found == names.end() ? -1 : static_cast<int>(found - names.begin());
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
    explicit PlyReader(ByteView file) : header_(ply_header_from(file)), values_(file, header_) {}

    SourceMesh read() {
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
        for (int axis = 0; axis < 3; ++axis) {
            if (std::find(roles.begin(), roles.end(), axis) == roles.end()) {
                refuse("the vertices have no {}", "xyz"[axis]);
            }
        }
        const bool coloured = std::find(roles.begin(), roles.end(), 3) != roles.end();
        for (std::uint64_t row = 0; row < element.count; ++row) {
            std::array<double, 7> v{0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0};
            for (std::size_t i = 0; i < roles.size(); ++i) {
                read_vertex_property(element, i, roles[i], row, v);
            }
            (void)mesh_.add_vertex({v[0], v[1], v[2]}, "vertex", static_cast<std::size_t>(row));
            if (coloured) {
                mesh_.set_colour(
                    glm::vec4(linear_from_srgb(v[3]), linear_from_srgb(v[4]), linear_from_srgb(v[5]), v[6]));
            }
        }
    }

    void read_vertex_property(const PlyElement& element, std::size_t i, int role, std::uint64_t row,
                              std::array<double, 7>& vertex) {
        const PlyProperty& property = element.properties[i];
        if (property.list_count) {
            skip_list(element, property, row);
            return;
        }
        const double value = values_.next(property.type, element, row);
        if (role >= 0) {
            vertex[static_cast<std::size_t>(role)] = role < 3 ? value : colour01(value, property.type);
        }
    }

    std::int64_t list_length(const PlyElement& element, const PlyProperty& property, std::uint64_t row) {
        const std::int64_t length = values_.next_whole(*property.list_count, element, row);
        if (length < 0) {
            refuse("{} {}: a list's length is {}", element.name, row, length);
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
            for (const PlyProperty& property : element.properties) {
                const bool corners = property.name == "vertex_indices" || property.name == "vertex_index";
                if (!property.list_count) {
                    (void)values_.next(property.type, element, row);
                } else if ((faces || strips) && corners) {
                    read_corners(element, property, row, strips);
                } else {
                    skip_list(element, property, row);
                }
            }
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
            if (corner < 0 || corner >= static_cast<std::int64_t>(most_vertices)) {
                refuse("face {}: vertex {} is out of range", row, corner);
            }
            corners_.push_back(static_cast<std::uint32_t>(corner));
        }
        polygon_ends_.push_back(corners_.size());
    }

    void make_triangles() {
        std::vector<glm::dvec3> points;
        std::vector<std::array<std::uint32_t, 3>> triangles;
        std::size_t begin = 0;
        for (std::size_t polygon = 0; polygon < polygon_ends_.size(); ++polygon) {
            const auto corners = std::span(corners_).subspan(begin, polygon_ends_[polygon] - begin);
            begin = polygon_ends_[polygon];
            points.clear();
            triangles.clear();
            for (const std::uint32_t corner : corners) {
                if (corner >= mesh_.positions().size()) {
                    refuse("face {}: vertex {} is out of range, the file has {}", polygon, corner,
                           mesh_.positions().size());
                }
                points.push_back(mesh_.positions()[corner]);
            }
            triangulate_polygon(points, triangles);
            for (const auto& [a, b, c] : triangles) {
                mesh_.add_triangle(corners[a], corners[b], corners[c], 0);
            }
        }
    }

    PlyHeader header_;
    PlyValues values_;
    MeshAssembly mesh_{'y'};
    std::vector<std::uint32_t> corners_;
    std::vector<std::size_t> polygon_ends_;
};

} // namespace

SourceMesh load_ply(ByteView file) {
    return PlyReader(file).read();
}

} // namespace frustumscreen
