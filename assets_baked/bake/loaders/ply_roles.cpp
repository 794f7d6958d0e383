#include "assets_baked/bake/loaders/ply_roles.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

namespace frustumscreen::bake {

namespace {

struct Named {
    PlyRole role = PlyRole::None;
    std::size_t rank = 0; ///< 0: the plainest name
};

std::string lower(std::string_view name) {
    std::string folded(name);
    std::transform(folded.begin(), folded.end(), folded.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + ('a' - 'A')) : c; });
    return folded;
}

/// The index of `name` in `names`.
template <std::size_t count>
std::optional<std::size_t> place_in(const std::array<std::string_view, count>& names, std::string_view name) {
    const auto found = std::find(names.begin(), names.end(), name);
    return found == names.end() ? std::nullopt
                                : std::optional(static_cast<std::size_t>(found - names.begin()));
}

std::optional<Named> colour_named(std::string_view name) {
    static constexpr std::array<std::string_view, 7> prefixes = {"",        "diffuse_", "vertex_", "color_",
                                                                 "colour_", "col_",     "rgb_"};
    static constexpr std::array<std::string_view, 4> words = {"red", "green", "blue", "alpha"};
    static constexpr std::array<std::string_view, 4> letters = {"r", "g", "b", "a"};
    static constexpr std::array roles = {PlyRole::Red, PlyRole::Green, PlyRole::Blue, PlyRole::Alpha};
    for (std::size_t k = 0; k < prefixes.size(); ++k) {
        if (!name.starts_with(prefixes.at(k))) {
            continue;
        }
        const std::string_view rest = name.substr(prefixes.at(k).size());
        if (const auto word = place_in(words, rest)) {
            return Named{roles.at(*word), 2 * k};
        }
        if (const auto letter = place_in(letters, rest)) {
            return Named{roles.at(*letter), 2 * k + 1};
        }
    }
    return std::nullopt;
}

std::optional<Named> named(std::string_view name) {
    static constexpr std::array<std::string_view, 3> axes = {"x", "y", "z"};
    static constexpr std::array across = {PlyRole::X, PlyRole::Y, PlyRole::Z};
    static constexpr std::array<std::string_view, 7> us = {"s",          "u",     "texture_u", "texture_s",
                                                           "texcoord_u", "tex_u", "tu"};
    static constexpr std::array<std::string_view, 7> vs = {"t",          "v",     "texture_v", "texture_t",
                                                           "texcoord_v", "tex_v", "tv"};
    if (const auto axis = place_in(axes, name)) {
        return Named{across.at(*axis), 0};
    }
    static constexpr std::array normals = {PlyRole::NormalX, PlyRole::NormalY, PlyRole::NormalZ};
    static constexpr std::array<std::string_view, 3> short_normals = {"nx", "ny", "nz"};
    static constexpr std::array<std::string_view, 3> long_normals = {"normal_x", "normal_y", "normal_z"};
    if (const auto normal = place_in(short_normals, name)) {
        return Named{normals.at(*normal), 0};
    }
    if (const auto normal = place_in(long_normals, name)) {
        return Named{normals.at(*normal), 1};
    }
    if (const auto u = place_in(us, name)) {
        return Named{PlyRole::U, *u};
    }
    if (const auto v = place_in(vs, name)) {
        return Named{PlyRole::V, *v};
    }
    if (name == "rgb" || name == "rgba") {
        return Named{PlyRole::PackedColour, 0};
    }
    return colour_named(name);
}

/// True for numbers that are not part of the picture.
bool is_measure(std::string_view name) {
    static constexpr std::array<std::string_view, 24> names = {
        "nx",      "ny",         "nz",        "normal_x", "normal_y",       "normal_z",
        "quality", "confidence", "intensity", "flags",    "radius",         "curvature",
        "value",   "id",         "label",     "class",    "classification", "time",
        "scale",   "density",    "error",     "group",    "segment",        "object_id"};
    static constexpr std::array<std::string_view, 3> prefixes = {"scalar_", "ambient_", "specular_"};
    return place_in(names, name) || std::any_of(prefixes.begin(), prefixes.end(), [&](std::string_view each) {
               return name.starts_with(each);
           });
}

} // namespace

bool PlyRoles::has(PlyRole role) const {
    return std::find(of.begin(), of.end(), role) != of.end();
}

bool PlyRoles::has_colour() const {
    return has(PlyRole::PackedColour) || (has(PlyRole::Red) && has(PlyRole::Green) && has(PlyRole::Blue));
}

bool PlyRoles::has_normal() const {
    return has(PlyRole::NormalX) && has(PlyRole::NormalY) && has(PlyRole::NormalZ);
}

PlyRoles roles_of_vertices(const PlyElement& element) {
    PlyRoles roles;
    roles.of.resize(element.properties.size(), PlyRole::None);
    std::array<std::size_t, 14> best{};
    best.fill(std::numeric_limits<std::size_t>::max());
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
        const PlyProperty& property = element.properties[i];
        const std::string name = lower(property.name);
        const std::optional<Named> found = property.list_count ? std::nullopt : named(name);
        if (!found) {
            if (!is_measure(name)) {
                roles.unknown.push_back(property.name);
            }
            continue;
        }
        std::size_t& rank = best.at(static_cast<std::size_t>(found->role));
        if (found->rank < rank) {
            std::replace(roles.of.begin(), roles.of.end(), found->role, PlyRole::None);
            roles.of[i] = found->role;
            rank = found->rank;
        }
    }
    if (roles.has(PlyRole::Red) && roles.has(PlyRole::PackedColour)) {
        std::replace(roles.of.begin(), roles.of.end(), PlyRole::PackedColour, PlyRole::None);
    }
    return roles;
}

PlyRole colour_role_of(std::string_view name) {
    const std::optional<Named> found = colour_named(lower(name));
    return found ? found->role : PlyRole::None;
}

bool is_known_at_faces(std::string_view name) {
    const std::string plain = lower(name);
    static constexpr std::array<std::string_view, 3> names = {"texnumber", "texcoord", "attribute"};
    return place_in(names, plain) || is_measure(plain) || colour_role_of(plain) != PlyRole::None;
}

} // namespace frustumscreen::bake
