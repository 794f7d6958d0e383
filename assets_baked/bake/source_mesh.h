/// A curator's artifact as read from the file: one triangle list with materials.
///
/// Frame    the file's own coordinates (glTF: the scene's, node transforms applied), 64-bit.
/// Threads  values; any.
#pragma once

#include "app/image/image.h"
#include "app/world/behaviour.h"
#include "app/world/cell.h"
#include "assets_baked/bake/source_layer.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace frustumscreen::bake {

struct SourceMaterial {
    glm::vec4 base_colour{1.0F}; ///< linear factor
    int texture = -1;            ///< index into SourceMesh::textures; -1 = none
    bool alpha_mask = false;     ///< cut where alpha < alpha_cutoff
    float alpha_cutoff = 0.5F;
    bool has_own_light =
        false; ///< the file gives the colour as emission, or as unlit: light is in it already
};

/// A loss, a guess, or a value taken because nothing else was given: one line for the person who has the file.
struct SourceNote {
    enum class Kind : std::uint8_t { Lost, Guessed, Taken };
    Kind kind = Kind::Lost;
    std::string text;
};

/// The file's own metadata, one line each; empty: not given.
struct SourceAbout {
    std::string title, author, licence, source;
    [[nodiscard]] bool operator==(const SourceAbout&) const = default;
};

/// Contents of the file that the mesh keeps in another form.
struct SourceContents {
    std::string format;                    ///< "glTF", "GLB", "OBJ", "PLY", "STL"
    std::vector<glm::ivec2> picture_sizes; ///< of each picture of colours, texels, as in the file
};

/// A scan before it was reduced to what a bake uses (reduce_scan.h), and how far the two surfaces lie apart: of points
/// spread over both, each point's distance from the other surface, in the file's units.
struct SourceReduction {
    std::size_t triangles = 0;
    std::size_t points = 0; ///< different ones that triangles use
    double mean = 0.0, p95 = 0.0, max = 0.0;
};

/// The file's nodes that have triangles, or that such a node or a moving one hangs from.
struct SourceNode {
    std::string name;                  ///< unique: the file's own, with a number where it is not, or "node 7"
    std::optional<std::size_t> parent; ///< index into SourceMesh::nodes, before this one
    glm::dmat4 parent_from_base{1.0};  ///< of a root: file_from_base; a matrix of the file, or nodes left out
    world::LocalPose rest;             ///< base_from_node, as the file's translation, rotation and scale
};
/// An animation of the file that moves nodes; morph targets and joints of skins are not kept.
struct SourceAnimation {
    std::string name;                     ///< unique, as of nodes
    std::vector<world::Channel> channels; ///< `cell`: index into SourceMesh::nodes
};

/// Corner attributes of a triangle, kept per vertex: the loader splits vertices where the file does.
struct SourceMesh {
    std::vector<glm::dvec3> positions;
    std::vector<glm::vec2> uvs;     ///< transformed; empty or one per position; v = 0 at the top row
    std::vector<glm::vec4> colours; ///< linear vertex colour factors; empty or one per position
    std::vector<glm::vec3> normals; ///< the file's own, unit; zero: none there; empty or one per position
    std::vector<std::array<std::uint32_t, 3>> triangles; ///< counter-clockwise seen from outside
    std::vector<std::uint32_t> triangle_materials;       ///< one per triangle
    std::vector<SourceMaterial> materials;               ///< at least one
    std::vector<SourceTexture> textures;
    std::vector<SourceLayer> layers; ///< at most pack::max_layers
    /// Empty: the file has no nodes, or only one with triangles and no animation. The triangles are at rest.
    std::vector<SourceNode> nodes;
    std::vector<std::uint32_t> triangle_nodes; ///< one per triangle, index into `nodes`; empty without nodes
    std::vector<SourceAnimation> animations;
    std::vector<std::filesystem::path> side_files; ///< other files that the model is made of or names
    std::vector<SourceNote> notes;                 ///< in the order in which they were found
    SourceAbout about;
    SourceContents contents;
    std::optional<SourceReduction> reduced_from;
    bool is_unlit = false; ///< the file's colours are shown as they are, without light
    char default_up = 'y'; ///< 'y' for glTF, OBJ, PLY; 'z' for STL
};

} // namespace frustumscreen::bake
