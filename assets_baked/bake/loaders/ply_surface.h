/// Pictures of a PLY file and the texture coordinates at its faces' corners, as MeshLab writes both.
///
/// Shape    texture coordinates: one for each corner of all polygons in their order, or none at all.
/// Errors   throws Refusal for a picture that is missing.
#pragma once

#include "assets_baked/bake/loaders/mesh_assembly.h"
#include "assets_baked/bake/loaders/model_files.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace frustumscreen {

class PlySurface {
public:
    /// `pictures` as the header names them.
    PlySurface(const std::vector<std::string>& pictures, ModelFiles& files, MeshAssembly& mesh)
        : pictures_(pictures), files_(files), mesh_(mesh) {}

    void at_vertices(bool coloured, bool textured);

    // While the faces are read: their values, and then the range of their corners.
    void face_value(std::string_view name, double value);
    void face_texcoord(double value) { texcoord_.push_back(value); }
    void end_face(std::size_t first_corner, std::size_t end_corner);

    // When all is read:
    /// Decides what shows, and notes what is lost.
    void begin();
    /// The material of the polygon whose corners begin at `first_corner`.
    [[nodiscard]] std::uint32_t material(std::size_t first_corner);
    /// Gives the corners of that polygon their texture coordinates. A vertex that has others already is copied.
    void split(std::size_t first_corner, std::span<std::uint32_t> corners);

private:
    struct CornerKey {
        std::uint32_t vertex;
        glm::vec2 uv;
        [[nodiscard]] bool operator==(const CornerKey&) const = default;
    };
    struct CornerHash {
        std::size_t operator()(const CornerKey& key) const noexcept;
    };

    const std::vector<std::string>& pictures_;
    ModelFiles& files_;
    MeshAssembly& mesh_;
    bool coloured_ = false;
    bool textured_ = false; ///< at the vertices
    bool colours_at_faces_ = false;
    std::size_t faces_without_uv_ = 0;
    std::vector<double> texcoord_;            ///< of the face being read
    int picture_ = 0;                         ///< of the face being read
    std::vector<glm::vec2> uvs_;              ///< of the corners; empty if no face has any
    std::map<std::size_t, int> picture_from_; ///< from this corner on; the first picture before
    bool shows_pictures_ = false;
    std::map<int, std::uint32_t> materials_; ///< of the pictures
    std::vector<bool> taken_;                ///< vertices that have their texture coordinates
    std::unordered_map<CornerKey, std::uint32_t, CornerHash> vertices_;
};

} // namespace frustumscreen
