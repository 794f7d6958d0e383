#include "assets_baked/bake/loaders/load_obj.h"

#include "assets_baked/bake/loaders/mesh_assembly.h"
#include "assets_baked/bake/loaders/obj_materials.h"
#include "assets_baked/bake/loaders/polygon.h"
#include "assets_baked/bake/loaders/source_about.h"
#include "assets_baked/bake/loaders/text.h"
#include "assets_baked/bake/loaders/vertex_numbers.h"
#include "firmware_host/base/printable.h"
#include "firmware_host/base/trimmed.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <set>

namespace frustumscreen::bake {

namespace {

/// True for keywords without effect on the picture, and for those of curves, which `curv` and `surf` report.
bool is_ignored(std::string_view keyword) {
    static constexpr std::array keywords = {"",           "g",         "o",     "s",     "mg",     "vp",
                                            "cstype",     "deg",       "bmat",  "step",  "parm",   "trim",
                                            "hole",       "scrv",      "sp",    "end",   "con",    "bevel",
                                            "c_interp",   "d_interp",  "lod",   "curv2", "usemap", "maplib",
                                            "shadow_obj", "trace_obj", "ctech", "stech"};
    return keyword.starts_with('#') || std::find(keywords.begin(), keywords.end(), keyword) != keywords.end();
}

/// True if numbers after x y z could change the picture and are not read. Read is a colour; a weight (w) of 1 and an
/// alpha of 1 or 255 change nothing.
bool loses_numbers(const std::vector<double>& vertex) {
    switch (vertex.size()) {
    case 3:
    case 6:
        return false;
    case 4:
        return vertex[3] != 1.0;
    case 7:
        return vertex[6] != 1.0 && vertex[6] != 255.0;
    default:
        return true;
    }
}

/// Lines with numbers that are not read.
struct LongLines {
    std::size_t count = 0;
    std::size_t first = 0; ///< number of the first line

    void add(std::size_t line) {
        first = count == 0 ? line : first;
        ++count;
    }
};

class ObjReader {
public:
    ObjReader(std::string_view text, ModelFiles& files)
        : text_(text), size_(text.size()), passed_(files.passed), notes_(files.notes), about_(files.about),
          materials_(files, mesh_) {}

    SourceMesh read() {
        while (!text_.empty()) {
            read_line(next_line());
            constexpr std::size_t lines = std::size_t{1} << 16U;
            if (line_ % lines == 0) {
                passed_(size_ - text_.size());
            }
        }
        note_losses();
        if (!colours_.empty() && mesh_.codes_to_linear()) {
            notes_.guessed("the colours at its points are read as 0 to 255, because some are above 1");
        }
        return mesh_.finish(!positions_.empty());
    }

private:
    void note_losses() {
        if (faces_without_area_ > 0) {
            notes_.lost("{} of fewer than three corners", counted(faces_without_area_, "face", "faces"));
        }
        if (points_lines_surfaces_ > 0) {
            notes_.lost("{} that no triangle is made of: points, lines or curved surfaces",
                        counted(points_lines_surfaces_, "part", "parts"));
        }
        if (corners_at_0_ > 0) {
            notes_.lost("the texture coordinates of {}: they have the number 0, and the first is 1",
                        counted(corners_at_0_, "corner", "corners"));
        }
        if (long_positions_.count > 0) {
            notes_.lost("the numbers after x y z of {}, first in line {}: only a colour of three numbers is "
                        "read there",
                        counted(long_positions_.count, "vertex", "vertices"), long_positions_.first);
        }
        if (long_uvs_.count > 0) {
            notes_.lost("the numbers after u v w of {}, first in line {}",
                        counted(long_uvs_.count, "texture coordinate", "texture coordinates"),
                        long_uvs_.first);
        }
        if (!unknown_.empty()) {
            notes_.lost("lines that the OBJ format does not have: {}",
                        printable(fmt::format("{}", fmt::join(unknown_, ", "))));
        }
    }

    /// The next line; a backslash at its end joins it with the following one.
    std::string_view next_line() {
        joined_.clear();
        while (true) {
            ++line_;
            const std::size_t end = std::min(text_.find('\n'), text_.size());
            std::string_view line = text_.substr(0, end);
            text_.remove_prefix(std::min(end + 1, text_.size()));
            if (line.ends_with('\r')) {
                line.remove_suffix(1);
            }
            const bool goes_on = line.ends_with('\\') && !text_.empty();
            if (joined_.empty() && !goes_on) {
                return line;
            }
            joined_ += line.substr(0, line.size() - (goes_on ? 1 : 0));
            joined_ += ' ';
            if (!goes_on) {
                return joined_;
            }
        }
    }

    void read_line(std::string_view line) {
        WordReader words(line);
        const std::string_view keyword = words.next();
        if (keyword.starts_with('#')) {
            take_comments(line, about_);
        } else if (keyword == "v") {
            read_position(words);
        } else if (keyword == "vt") {
            const std::vector<double>& uv = numbers(words, 1);
            if (uv.size() > 3) {
                long_uvs_.add(line_);
            }
            uvs_.push_back(MeshAssembly::finite_uv({uv[0], uv.size() > 1 ? 1.0 - uv[1] : 1.0}));
        } else if (keyword == "vn") {
            read_normal(words);
        } else if (keyword == "f") {
            read_face(words);
        } else if (keyword == "p" || keyword == "l" || keyword == "curv" || keyword == "surf") {
            ++points_lines_surfaces_;
        } else if (keyword == "usemtl") {
            material_ = trimmed(words.rest_of_line());
        } else if (keyword == "mtllib") {
            materials_.read_libraries(trimmed(words.rest_of_line()), fmt::format("line {}: mtllib", line_));
        } else if (!is_ignored(keyword)) {
            unknown_.insert(std::string(keyword.substr(0, 40)));
        }
    }

    /// The next call overwrites them.
    const std::vector<double>& numbers(WordReader& words, std::size_t least) {
        std::vector<double>& values = numbers_;
        values.clear();
        for (std::string_view word = words.next(); !word.empty() && !word.starts_with('#');
             word = words.next()) {
            const std::optional<double> value = number_from(word);
            if (!value) {
                refuse_damage("line {}: a number is expected, not \"{}\"", line_, word.substr(0, 40));
            }
            values.push_back(*value);
        }
        if (values.size() < least) {
            refuse_damage("line {}: {} numbers are expected, there are {}", line_, least, values.size());
        }
        return values;
    }

    void read_position(WordReader& words) {
        const std::vector<double>& values = numbers(words, 3);
        const glm::dvec3 position(values[0], values[1], values[2]);
        if (!(glm::length(position) < largest_coordinate)) {
            refuse_contradiction("line {}: vertex {} is not a finite point within 1e30", line_,
                                 positions_.size() + 1);
        }
        positions_.push_back(position);
        if (loses_numbers(values)) {
            long_positions_.add(line_);
        }
        if (values.size() >= 6) {
            colours_.resize(positions_.size(), glm::vec4(1.0F));
            for (int i = 0; i < 3; ++i) {
                colours_.back()[i] = static_cast<float>(values[static_cast<std::size_t>(i) + 3]);
            }
        }
    }

    /// Normals only shape the light, so one that is no direction is left out and refuses no file.
    void read_normal(WordReader& words) {
        glm::dvec3 normal(0.0);
        for (int axis = 0; axis < 3; ++axis) {
            normal[axis] = number_from(words.next()).value_or(0.0);
        }
        normals_.push_back(normal);
    }

    /// The file counts from 1, or backwards from -1, the latest; the result is below `size`.
    std::uint32_t index_from(std::string_view word, std::size_t size, const char* what) {
        const std::optional<std::int64_t> number = whole_from(word);
        if (!number) {
            refuse_damage("line {}: the number of a {} is expected, not \"{}\"", line_, what,
                          word.substr(0, 40));
        }
        const auto count = static_cast<std::int64_t>(size);
        if (*number == 0 || *number > count || *number < -count) {
            refuse_contradiction("line {}: {} {} is out of range, there are {} so far", line_, what, *number,
                                 count);
        }
        return static_cast<std::uint32_t>(*number > 0 ? *number - 1 : count + *number);
    }

    /// v, v/vt, v//vn or v/vt/vn.
    std::uint32_t corner_from(std::string_view word) {
        const std::size_t slash = std::min(word.find('/'), word.size());
        const std::uint32_t position = index_from(word.substr(0, slash), positions_.size(), "vertex");
        std::string_view rest = word.substr(std::min(slash + 1, word.size()));
        const std::size_t second = std::min(rest.find('/'), rest.size());
        const std::string_view normal = rest.substr(std::min(second + 1, rest.size()));
        return vertex(position, uv_from(rest.substr(0, second)), normal_from(normal));
    }

    /// A number that no normal has counts as none.
    [[nodiscard]] std::uint32_t normal_from(std::string_view word) const {
        const std::int64_t number = whole_from(word).value_or(0);
        const auto count = static_cast<std::int64_t>(normals_.size());
        const std::int64_t index = number > 0 ? number - 1 : count + number;
        return number != 0 && index >= 0 && index < count ? static_cast<std::uint32_t>(index) : none;
    }

    /// Some exporters write 0 for a corner without a texture coordinate.
    std::uint32_t uv_from(std::string_view word) {
        if (word.empty()) {
            return none;
        }
        if (whole_from(word) == std::int64_t{0}) {
            ++corners_at_0_;
            return none;
        }
        return index_from(word, uvs_.size(), "texture coordinate");
    }

    /// The vertex of these numbers in the file; `none` for a missing texture coordinate or normal.
    std::uint32_t vertex(std::uint32_t position, std::uint32_t uv, std::uint32_t normal) {
        const auto [vertex, is_new] = vertices_.number_of({position, uv, normal});
        if (is_new) {
            (void)mesh_.add_vertex(positions_[position], "vertex", position + std::size_t{1});
            if (uv != none) {
                mesh_.set_uv(glm::dvec2(uvs_[uv]));
            }
            if (position < colours_.size()) {
                mesh_.set_colour_code(colours_[position]);
            }
            if (normal != none) {
                mesh_.set_normal(normals_[normal]);
            }
        }
        return vertex;
    }

    void read_face(WordReader& words) {
        corners_.clear();
        points_.clear();
        triangles_.clear();
        for (std::string_view word = words.next(); !word.empty() && !word.starts_with('#');
             word = words.next()) {
            corners_.push_back(corner_from(word));
            points_.push_back(mesh_.positions()[corners_.back()]);
        }
        triangulate_polygon(points_, triangles_);
        if (triangles_.empty()) {
            ++faces_without_area_;
            return;
        }
        const std::uint32_t material = materials_.number_of(material_, middle_uv());
        for (const auto& [a, b, c] : triangles_) {
            mesh_.add_triangle(corners_[a], corners_[b], corners_[c], material);
        }
    }

    /// Mean texture coordinate of the face being read.
    [[nodiscard]] glm::vec2 middle_uv() const {
        glm::vec2 sum(0.0F);
        for (const std::uint32_t corner : corners_) {
            sum += mesh_.uv(corner);
        }
        return sum / static_cast<float>(corners_.size());
    }

    static constexpr std::uint32_t none = 0xffffffffU;

    std::string_view text_; ///< what is left
    std::size_t size_;      ///< of the whole text
    const ModelFiles::Passed& passed_;
    std::string joined_;
    std::size_t line_ = 0;
    LoadNotes& notes_;
    SourceAbout& about_;
    MeshAssembly mesh_{'y'};
    ObjMaterials materials_;
    std::string material_;
    std::size_t faces_without_area_ = 0;    ///< faces of fewer than three corners
    std::size_t points_lines_surfaces_ = 0; ///< elements that are not faces
    std::size_t corners_at_0_ = 0;          ///< corners whose texture coordinate has the number 0
    std::set<std::string> unknown_;         ///< keywords
    LongLines long_positions_;
    LongLines long_uvs_;
    std::vector<glm::dvec3> positions_;
    std::vector<glm::vec2> uvs_;
    std::vector<glm::vec4> colours_; ///< codes of the first positions, as written; may be fewer
    std::vector<glm::dvec3> normals_;
    VertexNumbers vertices_;      ///< those of the mesh
    std::vector<double> numbers_; ///< of the line that is read
    std::vector<std::uint32_t> corners_;
    std::vector<glm::dvec3> points_;
    std::vector<std::array<std::uint32_t, 3>> triangles_;
};

} // namespace

SourceMesh load_obj(ByteView file, ModelFiles& files) {
    std::string_view text = as_text(file);
    constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
    text.remove_prefix(text.starts_with(byte_order_mark) ? byte_order_mark.size() : 0);
    return ObjReader(text, files).read();
}

} // namespace frustumscreen::bake
