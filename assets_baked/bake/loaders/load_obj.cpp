#include "assets_baked/bake/loaders/load_obj.h"

#include "assets_baked/bake/loaders/mesh_assembly.h"
#include "assets_baked/bake/loaders/polygon.h"
#include "assets_baked/bake/loaders/source_about.h"
#include "assets_baked/bake/loaders/text.h"
#include "firmware_host/base/printable.h"
#include "firmware_host/base/trimmed.h"

#include <tiny_obj_loader.h>

#include <algorithm>
#include <map>
#include <sstream>
#include <unordered_map>

namespace frustumscreen {

namespace {

/// Materials by name, made when a face first uses them.
class ObjMaterials {
public:
    ObjMaterials(ModelFiles& files, MeshAssembly& mesh) : files_(files), mesh_(mesh) {}

    void read_library(const std::string& name, const std::string& place) {
        if (!files_.sidecars.exists(name)) {
            missing_library_ = true;
            if (files_.pictures.has_curators()) {
                return; // whose picture stands for the colours
            }
            files_.notes.lost(
                "the colours: it names \"{}\" for them, and there is no such file beside it; put "
                "it there ({})",
                printable(last_part(name)), place);
            return;
        }
        has_library_ = true;
        const std::shared_ptr<const Bytes> bytes = files_.sidecars.read(name, place);
        take_comments(as_text(*bytes), files_.about);
        std::istringstream stream{std::string(as_text(*bytes))};
        std::map<std::string, int> names;
        std::vector<tinyobj::material_t> materials;
        std::string warnings;
        std::string errors;
        tinyobj::LoadMtl(&names, &materials, &stream, &warnings, &errors);
        for (const auto& [material, index] : names) {
            if (index >= 0 && static_cast<std::size_t>(index) < materials.size()) {
                mention_pictures(materials[static_cast<std::size_t>(index)]);
                known_.insert_or_assign(material, materials[static_cast<std::size_t>(index)]);
            }
        }
    }

    /// A material with an unknown name is white, or wears the curator's own picture.
    std::uint32_t number_of(const std::string& name) {
        if (const auto used = used_.find(name); used != used_.end()) {
            return used->second;
        }
        SourceMaterial made;
        if (const auto known = known_.find(name); known != known_.end()) {
            made = made_from(known->second);
        } else if (!name.empty()) {
            note_unknown(name);
        }
        return used_[name] = mesh_.add_material(made);
    }

private:
    void note_unknown(const std::string& name) {
        if (has_library_) {
            files_.notes.lost(
                "the colour of the material \"{}\": the file of materials (.mtl) does not have it",
                printable(name));
        } else if (!missing_library_ && !files_.pictures.has_curators()) {
            files_.notes.lost(
                "the colours: it names materials, but no file of materials (.mtl); export it again "
                "with its materials");
        }
    }

    void mention_pictures(const tinyobj::material_t& material) {
        for (const std::string* name :
             {&material.diffuse_texname, &material.ambient_texname, &material.specular_texname,
              &material.specular_highlight_texname, &material.bump_texname, &material.displacement_texname,
              &material.alpha_texname, &material.reflection_texname, &material.roughness_texname,
              &material.metallic_texname, &material.sheen_texname, &material.emissive_texname,
              &material.normal_texname}) {
            files_.sidecars.mention(*name);
        }
    }

    SourceMaterial made_from(const tinyobj::material_t& source) {
        SourceMaterial made;
        const bool textured = !source.diffuse_texname.empty();
        for (int i = 0; i < 3; ++i) {
            const auto factor = static_cast<float>(source.diffuse[i]);
            made.base_colour[i] = factor >= 0.0F && factor <= 1.0F ? factor : 1.0F;
        }
        if (textured) {
            made.texture = texture(source.diffuse_texname, source.diffuse_texopt.clamp);
            // A writer that leaves Kd black beside a picture means the picture alone.
            made.base_colour =
                glm::vec3(made.base_colour) == glm::vec3(0.0F) ? glm::vec4(1.0F) : made.base_colour;
        }
        return made;
    }

    int texture(const std::string& name, bool clamp) {
        std::shared_ptr<const Image8>& picture = pictures_by_name_[name];
        if (!picture) {
            picture = files_.pictures.named(name, "map_Kd " + printable(name));
        }
        const Wrap wrap = clamp ? Wrap::Clamp : Wrap::Repeat;
        return mesh_.add_texture({picture, wrap, wrap});
    }

    ModelFiles& files_;
    MeshAssembly& mesh_;
    bool has_library_ = false;
    bool missing_library_ = false;
    std::map<std::string, std::shared_ptr<const Image8>> pictures_by_name_;
    std::map<std::string, tinyobj::material_t> known_;
    std::map<std::string, std::uint32_t> used_;
};

class ObjReader {
public:
    ObjReader(std::string_view text, ModelFiles& files)
        : text_(text), notes_(files.notes), about_(files.about), materials_(files, mesh_) {}

    SourceMesh read() {
        while (!text_.empty()) {
            read_line(next_line());
        }
        note_losses();
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
    }

    /// A backslash at the end joins a line with the next one.
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
            const std::vector<double> uv = numbers(words, 1);
            uvs_.emplace_back(uv[0], uv.size() > 1 ? 1.0 - uv[1] : 1.0);
        } else if (keyword == "f") {
            read_face(words);
        } else if (keyword == "p" || keyword == "l" || keyword == "curv" || keyword == "surf") {
            ++points_lines_surfaces_;
        } else if (keyword == "usemtl") {
            material_ = trimmed(words.rest_of_line());
        } else if (keyword == "mtllib") {
            materials_.read_library(std::string(trimmed(words.rest_of_line())),
                                    fmt::format("line {}: mtllib", line_));
        }
    }

    std::vector<double> numbers(WordReader& words, std::size_t least) {
        std::vector<double> values;
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
        const std::vector<double> values = numbers(words, 3);
        const glm::dvec3 position(values[0], values[1], values[2]);
        if (!(glm::length(position) < largest_coordinate)) {
            refuse_contradiction("line {}: vertex {} is not a finite point within 1e30", line_,
                                 positions_.size() + 1);
        }
        positions_.push_back(position);
        if (values.size() >= 6) {
            colours_.resize(positions_.size(), glm::vec4(1.0F));
            for (int i = 0; i < 3; ++i) {
                const double srgb = std::clamp(values[static_cast<std::size_t>(i) + 3], 0.0, 1.0);
                colours_.back()[i] = static_cast<float>(linear_from_srgb(srgb));
            }
        }
    }

    /// In the file 1 is the first and -1 the last so far; the result is below `size`.
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
        rest = rest.substr(0, rest.find('/'));
        const std::uint32_t uv = rest.empty() ? no_uv : index_from(rest, uvs_.size(), "texture coordinate");
        return vertex(position, uv);
    }

    std::uint32_t vertex(std::uint32_t position, std::uint32_t uv) {
        const std::uint64_t key = (std::uint64_t{position} << 32U) | uv;
        const auto [known, is_new] = vertices_.try_emplace(key, 0U);
        if (is_new) {
            known->second = mesh_.add_vertex(positions_[position], "vertex", position + std::size_t{1});
            if (uv != no_uv) {
                mesh_.set_uv(uvs_[uv]);
            }
            if (position < colours_.size()) {
                mesh_.set_colour(colours_[position]);
            }
        }
        return known->second;
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
        const std::uint32_t material = materials_.number_of(material_);
        for (const auto& [a, b, c] : triangles_) {
            mesh_.add_triangle(corners_[a], corners_[b], corners_[c], material);
        }
    }

    static constexpr std::uint32_t no_uv = 0xffffffffU;

    std::string_view text_;
    std::string joined_;
    std::size_t line_ = 0;
    LoadNotes& notes_;
    SourceAbout& about_;
    MeshAssembly mesh_{'y'};
    ObjMaterials materials_;
    std::string material_;
    std::size_t faces_without_area_ = 0;    ///< of fewer than three corners
    std::size_t points_lines_surfaces_ = 0; ///< elements that are no faces
    std::vector<glm::dvec3> positions_;
    std::vector<glm::dvec2> uvs_;
    std::vector<glm::vec4> colours_; ///< of the first positions; there may be fewer of them
    std::unordered_map<std::uint64_t, std::uint32_t> vertices_;
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

} // namespace frustumscreen
