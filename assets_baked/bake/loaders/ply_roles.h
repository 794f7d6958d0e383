/// What the properties of a PLY file's vertices stand for, by the names that programs write.
///
/// Names    in any case. Where several properties have one role, the plainest name counts: `red` before `diffuse_red`.
/// Threads  pure; any.
#pragma once

#include "assets_baked/bake/loaders/ply_header.h"

#include <string>
#include <vector>

namespace frustumscreen {

enum class PlyRole { None, X, Y, Z, Red, Green, Blue, Alpha, U, V, PackedColour };

struct PlyRoles {
    std::vector<PlyRole> of;          ///< one each property
    std::vector<std::string> unknown; ///< names that no program is known to write
    [[nodiscard]] bool has(PlyRole role) const;
    [[nodiscard]] bool has_colour() const;
};

[[nodiscard]] PlyRoles roles_of_vertices(const PlyElement& element);
/// Red, green, blue or alpha, at a face too; else None.
[[nodiscard]] PlyRole colour_role_of(std::string_view name);
/// Properties of faces that change nothing of what is shown, or that the reader knows.
[[nodiscard]] bool is_known_at_faces(std::string_view name);

} // namespace frustumscreen
