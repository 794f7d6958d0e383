/// The materials of an OBJ file: its .mtl files read, and what of them this program shows.
///
/// Shown    Kd and map_Kd; where a material has no colour of its own, Ke and map_Ke. A material without Kd is white.
/// Colour   Kd is taken as linear, as today's writers mean it.
/// Names    of materials and files compare exactly first, then as file_name.h has it. Keywords may have any case.
/// Library  tinyobjloader reads the .mtl, of which the keywords are written in its own case before.
/// Errors   throws Refusal for a picture that is missing; all else is noted.
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

    /// The rest of a line `mtllib`: one name, which may have blanks, or several.
    void read_libraries(std::string_view names, const std::string& place);
    /// The material that a face uses; empty: the face names none. An unknown one is white, or wears the curator's own picture.
    std::uint32_t number_of(const std::string& name);

private:
    struct Material {
        tinyobj::material_t source;
        std::filesystem::path folder; ///< of its .mtl, from the model's on
    };

    void read_library(const std::string& name, const std::string& place);
    void take(const std::string& name, const tinyobj::material_t& source,
              const std::filesystem::path& folder);
    void note_missing_library(std::string_view name, const std::string& place);
    void note_unknown(const std::string& name);
    void note_unshown(const Material& material);
    [[nodiscard]] const Material* find(const std::string& name);
    [[nodiscard]] SourceMaterial made_from(const Material& material);
    [[nodiscard]] int texture(const Material& material, const std::string& name,
                              const tinyobj::texture_option_t& options, std::string_view keyword);
    /// The picture's name from the model's folder on: beside the model, else beside the .mtl.
    [[nodiscard]] std::string picture_name(const Material& material, const std::string& name) const;

    ModelFiles& files_;
    MeshAssembly& mesh_;
    bool has_library_ = false;
    bool missing_library_ = false;
    std::map<std::string, std::shared_ptr<const Image8>> pictures_by_name_;
    std::map<std::string, Material> known_;
    std::map<std::string, std::uint32_t> used_;
};

} // namespace frustumscreen
