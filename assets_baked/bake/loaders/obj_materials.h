/// Reads the .mtl files of an OBJ file, and keeps the part of its materials that this program shows.
///
/// Shown    Kd and map_Kd; for a material without a colour, Ke and map_Ke. A material without Kd is white.
/// Colour   Kd is linear, as today's exporters mean it.
/// Tiles    (UDIM) a picture with <UDIM> in its name, or with 1001 where pictures of other tiles lie beside it, is one of
///          several: texture coordinates from (u, v) to (u + 1, v + 1) lie in the picture of the number 1001 + u + 10 v.
/// Names    of materials and files are first compared exactly, then as in file_name.h. Keywords may have any case.
/// Library  tinyobjloader reads the .mtl after mtl_text.h has rewritten its keywords.
/// Errors   throws Refusal for a missing picture; everything else is noted.
#pragma once

#include "assets_baked/bake/loaders/mesh_assembly.h"
#include "assets_baked/bake/loaders/model_files.h"

#include <tiny_obj_loader.h>

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>

namespace frustumscreen {

class ObjMaterials {
public:
    ObjMaterials(ModelFiles& files, MeshAssembly& mesh) : files_(files), mesh_(mesh) {}

    /// Takes the rest of a line `mtllib`: one name, which may contain blanks, or several.
    void read_libraries(std::string_view names, const std::string& place);
    /// The material that a face uses; empty: the face names none. An unknown one is white, or has the curator's own
    /// picture.
    /// `uv`: of the face's middle, which lies in one tile; v counts from the top.
    std::uint32_t number_of(const std::string& name, const glm::vec2& uv);

private:
    struct Material {
        tinyobj::material_t source;
        std::filesystem::path folder; ///< folder of its .mtl, relative to the model's
    };

    void read_library(const std::string& name, const std::string& place);
    void take(const std::string& name, const tinyobj::material_t& source,
              const std::filesystem::path& folder);
    void note_missing_library(std::string_view name, const std::string& place);
    void note_unknown(const std::string& name);
    void note_unshown(const Material& material);
    [[nodiscard]] const Material* find(const std::string& name);
    [[nodiscard]] SourceMaterial made_from(const Material& material, int tile);
    /// The name of the tile's picture; `name` itself if it is one picture for all.
    [[nodiscard]] std::string picture_of_tile(const Material& material, const std::string& name,
                                              int tile) const;
    [[nodiscard]] int texture(const Material& material, const std::string& name,
                              const tinyobj::texture_option_t& options, std::string_view keyword);
    /// The picture's name relative to the model's folder: a file beside the model, otherwise beside the .mtl.
    [[nodiscard]] std::string picture_name(const Material& material, const std::string& name) const;

    ModelFiles& files_;
    MeshAssembly& mesh_;
    bool has_library_ = false;
    bool missing_library_ = false;
    std::map<std::string, std::shared_ptr<const Image8>> pictures_by_name_;
    std::map<std::string, Material> known_;
    struct Used {
        bool is_tiled = false;
        std::map<int, std::uint32_t> number_of_tile; ///< 1001 alone for a material that is not tiled
    };
    std::map<std::string, Used> used_;
};

} // namespace frustumscreen
