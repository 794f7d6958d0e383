/// Pictures of a PLY file and the texture coordinates at its faces' corners, in MeshLab's form.
///
/// Shape    texture coordinates: one for each corner of all polygons in their order, or none.
/// Errors   throws Refusal for a missing picture.
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

namespace frustumscreen::bake {

class PlySurface {
public:
    /// `pictures`: names as in the header.
    PlySurface(const std::vector<std::string>& pictures, ModelFiles& files, MeshAssembly& mesh)
        : pictures_(pictures), files_(files), mesh_(mesh) {}

    void at_vertices(bool coloured, bool textured);

    // While faces are read: their values, then the range of their corners.
    void face_value(std::string_view name, double value);
    void face_texcoord(double value) { texcoord_.push_back(value); }
    void end_face(std::size_t first_corner, std::size_t end_corner);

    // After all faces are read:
    /// Chooses between pictures and colours, and notes losses.
    void begin();
    /// The material of the polygon whose corners begin at `first_corner`.
    [[nodiscard]] std::uint32_t material(std::size_t first_corner);
    /// Sets the texture coordinates of that polygon's corners. A vertex that has different ones already is copied.
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
    bool textured_ = false; ///< the vertices have texture coordinates
    bool colours_at_faces_ = false;
    std::size_t faces_without_uv_ = 0;
    std::vector<double> texcoord_; ///< texture coordinates of the face being read
    int picture_ = 0;              ///< picture of the face being read
    std::vector<glm::vec2> uvs_;   ///< texture coordinates of the corners; empty if no face has any
    std::map<std::size_t, int> picture_from_; ///< picture from this corner on; before, the first picture
    bool shows_pictures_ = false;
    std::map<int, std::uint32_t> materials_; ///< material of each picture
    std::vector<bool> taken_;                ///< vertices that have their texture coordinates
    std::unordered_map<CornerKey, std::uint32_t, CornerHash> vertices_;
};

} // namespace frustumscreen::bake
