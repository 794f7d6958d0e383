/// The roles of the vertices' properties in a PLY file, by the names that programs write.
///
/// Names    in any case. If several properties have one role, the plainest name counts: `red` before `diffuse_red`.
/// Threads  pure; any.
#pragma once

#include "assets_baked/bake/loaders/ply_header.h"

#include <string>
#include <vector>

namespace frustumscreen::bake {

enum class PlyRole { None, X, Y, Z, Red, Green, Blue, Alpha, U, V, PackedColour, NormalX, NormalY, NormalZ };

struct PlyRoles {
    std::vector<PlyRole> of;          ///< one for each property
    std::vector<std::string> unknown; ///< names that no known program writes
    [[nodiscard]] bool has(PlyRole role) const;
    [[nodiscard]] bool has_colour() const;
    [[nodiscard]] bool has_normal() const;
};

[[nodiscard]] PlyRoles roles_of_vertices(const PlyElement& element);
/// Red, green, blue or alpha, of faces too; otherwise None.
[[nodiscard]] PlyRole colour_role_of(std::string_view name);
/// True for properties of faces without effect on the picture, and for those that the reader uses.
[[nodiscard]] bool is_known_at_faces(std::string_view name);

} // namespace frustumscreen::bake
