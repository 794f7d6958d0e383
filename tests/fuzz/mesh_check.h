/// load_mesh's promise for any bytes: an error of one line that names the file, or a valid mesh.
#pragma once

#include "assets_baked/bake/loaders/load_bytes.h"
#include "tests/fuzz/fuzz.h"

#include <algorithm>

namespace frustumscreen::fuzz {

/// Nodes and animations.
inline void require_sound_world(const bake::SourceMesh& mesh) {
    require(mesh.nodes.empty() ? mesh.triangle_nodes.empty() && mesh.animations.empty()
                               : mesh.triangle_nodes.size() == mesh.triangles.size(),
            "a triangle has a node if there are nodes");
    require(mesh.nodes.size() <= world::max_cells && mesh.animations.size() <= world::max_behaviours,
            "nodes and animations are few");
    for (std::size_t k = 0; k < mesh.nodes.size(); ++k) {
        require(!mesh.nodes[k].parent || *mesh.nodes[k].parent < k, "a parent comes first");
    }
    for (const std::uint32_t node : mesh.triangle_nodes) {
        require(node < mesh.nodes.size(), "every triangle's node is there");
    }
    for (const bake::SourceAnimation& animation : mesh.animations) {
        for (const world::Channel& channel : animation.channels) {
            const world::Curve& curve = channel.curve;
            const std::size_t each = curve.interpolation == world::Interpolation::CubicSpline ? 3 : 1;
            require(channel.cell < mesh.nodes.size(), "every channel's node is there");
            require(!curve.times_s.empty() && curve.values.size() == each * curve.times_s.size(),
                    "a key has its values");
            require(std::is_sorted(curve.times_s.begin(), curve.times_s.end()), "times rise");
            for (const glm::vec4& value : curve.values) {
                require(is_finite(value) && std::isfinite(value.w), "a value is finite");
            }
        }
    }
}

inline void require_sound(const bake::SourceMesh& mesh) {
    const std::size_t vertices = mesh.positions.size();
    require(!mesh.triangles.empty() && !mesh.materials.empty(), "a mesh has triangles and a material");
    require(mesh.triangle_materials.size() == mesh.triangles.size(), "a triangle has a material");
    require((mesh.uvs.empty() || mesh.uvs.size() == vertices) &&
                (mesh.colours.empty() || mesh.colours.size() == vertices),
            "attributes are there for all vertices or for none");
    for (const auto& corners : mesh.triangles) {
        require(*std::max_element(corners.begin(), corners.end()) < vertices, "every corner has its vertex");
    }
    for (const glm::dvec3& position : mesh.positions) {
        require(is_finite(position), "a position is finite");
    }
    for (const glm::vec2& uv : mesh.uvs) {
        require(std::isfinite(uv.x) && std::isfinite(uv.y), "a texture coordinate is finite");
    }
    for (const glm::vec4& colour : mesh.colours) {
        require(is_finite(colour) && std::isfinite(colour.a), "a colour is finite");
    }
    for (const std::uint32_t material : mesh.triangle_materials) {
        require(material < mesh.materials.size(), "every triangle's material is there");
    }
    for (const bake::SourceMaterial& material : mesh.materials) {
        require(material.texture < static_cast<int>(mesh.textures.size()),
                "every material's texture is there");
        require(is_finite(material.base_colour) && std::isfinite(material.alpha_cutoff),
                "a material is finite");
        require(material.texture < 0 || mesh.textures[static_cast<std::size_t>(material.texture)].image,
                "every texture has a picture");
    }
    require_sound_world(mesh);
}

/// Loads the bytes as a file without other files next to it.
inline int check_mesh(const std::uint8_t* data, std::size_t size, const char* name) {
    const auto mesh = bake::load_mesh_bytes(bytes_of(data, size), std::filesystem::path("nowhere") / name);
    if (mesh) {
        require_sound(*mesh);
    } else {
        require_one_line(mesh.error().message);
        require(mesh.error().message.starts_with("nowhere/"), "a message names the file",
                mesh.error().message);
    }
    return 0;
}

} // namespace frustumscreen::fuzz
