#include "assets_baked/bake/colour_looks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace frustumscreen::bake {

namespace {

constexpr int max_code_step = 2; ///< of 255, within which two colours are one

const image::Image8* picture_of(const SourceMesh& mesh, const SourceMaterial& material) {
    return material.texture < 0 || mesh.uvs.empty()
               ? nullptr
               : mesh.textures[static_cast<std::size_t>(material.texture)].image.get();
}

bool is_near(const glm::u8vec4& a, const glm::u8vec4& b) {
    return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)}) <= max_code_step;
}

glm::u8vec4 code_of(const glm::vec4& linear) {
    return {image::srgb8_from_linear(static_cast<double>(linear.r)),
            image::srgb8_from_linear(static_cast<double>(linear.g)),
            image::srgb8_from_linear(static_cast<double>(linear.b)), 255};
}

/// The picture's colour, linear, if it has only one.
std::optional<glm::vec4> one_colour_of(const image::Image8& picture) {
    const glm::u8vec4 first = picture.texels.front();
    if (!std::all_of(picture.texels.begin(), picture.texels.end(),
                     [&](const glm::u8vec4& texel) { return is_near(texel, first); })) {
        return std::nullopt;
    }
    const std::array<float, 256>& linear = image::linear_from_srgb8();
    return glm::vec4(linear[first.r], linear[first.g], linear[first.b], 1.0F);
}

/// The colour of all vertices, linear, if they have only one; white without colours.
std::optional<glm::vec4> one_vertex_colour(const SourceMesh& mesh) {
    if (mesh.colours.empty()) {
        return glm::vec4(1.0F);
    }
    const glm::u8vec4 first = code_of(mesh.colours.front());
    const bool are_one = std::all_of(mesh.colours.begin(), mesh.colours.end(), [&](const glm::vec4& colour) {
        return is_near(code_of(colour), first);
    });
    return are_one ? std::optional(mesh.colours.front()) : std::nullopt;
}

/// True for each material that triangles use.
std::vector<bool> used_materials(const SourceMesh& mesh) {
    std::vector<bool> used(mesh.materials.size(), false);
    for (const std::uint32_t material : mesh.triangle_materials) {
        used[material] = true;
    }
    return used;
}

/// The colour of all triangles, linear, if they have only one.
std::optional<glm::vec4> one_colour_of(const SourceMesh& mesh) {
    const std::optional<glm::vec4> vertices = one_vertex_colour(mesh);
    if (!vertices) {
        return std::nullopt;
    }
    const std::vector<bool> used = used_materials(mesh);
    std::optional<glm::vec4> first;
    for (std::size_t k = 0; k < mesh.materials.size(); ++k) {
        const SourceMaterial& material = mesh.materials[k];
        const image::Image8* picture = used[k] ? picture_of(mesh, material) : nullptr;
        const std::optional<glm::vec4> painted =
            picture != nullptr ? one_colour_of(*picture) : glm::vec4(1.0F);
        if (!painted) {
            return std::nullopt;
        }
        const glm::vec4 colour = material.base_colour * *painted * *vertices;
        if (used[k] && first && !is_near(code_of(colour), code_of(*first))) {
            return std::nullopt;
        }
        first = used[k] && !first ? std::optional(colour) : first;
    }
    return first;
}

/// True if pictures are shown, and all of each triangle shows the same point of them.
bool shows_one_point(const SourceMesh& mesh) {
    constexpr float max_extent = 1e-6F;
    glm::vec2 low(std::numeric_limits<float>::infinity());
    glm::vec2 high(-std::numeric_limits<float>::infinity());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (picture_of(mesh, mesh.materials[mesh.triangle_materials[t]]) != nullptr) {
            for (const std::uint32_t vertex : mesh.triangles[t]) {
                low = glm::min(low, mesh.uvs[vertex]);
                high = glm::max(high, mesh.uvs[vertex]);
            }
        }
    }
    return low.x <= high.x && std::max(high.x - low.x, high.y - low.y) <= max_extent;
}

bool is_dark(const glm::vec4& colour) {
    constexpr float black = 1e-3F; // linear
    return std::max({colour.r, colour.g, colour.b}) < black;
}

bool is_all_black(const SourceMesh& mesh) {
    const bool dark_vertices =
        !mesh.colours.empty() && std::all_of(mesh.colours.begin(), mesh.colours.end(), is_dark);
    const auto is_dark_material = [&](const SourceMaterial& material) {
        const image::Image8* picture =
            material.texture < 0 ? nullptr
                                 : mesh.textures[static_cast<std::size_t>(material.texture)].image.get();
        return is_dark(material.base_colour) ||
               (picture != nullptr &&
                std::all_of(picture->texels.begin(), picture->texels.end(), [](const glm::u8vec4& texel) {
                    return std::max({texel.r, texel.g, texel.b}) < 4;
                }));
    };
    const std::vector<bool> used = used_materials(mesh);
    bool all_dark = true;
    for (std::size_t k = 0; k < mesh.materials.size(); ++k) {
        all_dark = all_dark && (!used[k] || is_dark_material(mesh.materials[k]));
    }
    return dark_vertices || all_dark;
}

} // namespace

std::optional<std::string> look_for_black(const SourceMesh& mesh) {
    return is_all_black(mesh) ? std::optional<std::string>("all of its colours are black, so nothing of it "
                                                           "will show: export it with its colours, or name "
                                                           "a picture with --texture FILE")
                              : std::nullopt;
}

std::optional<std::string> look_for_one_colour(const SourceMesh& mesh) {
    if (is_all_black(mesh)) {
        return std::nullopt;
    }
    const bool has_pictures =
        std::any_of(mesh.materials.begin(), mesh.materials.end(),
                    [&](const SourceMaterial& material) { return picture_of(mesh, material) != nullptr; });
    if (shows_one_point(mesh) && one_vertex_colour(mesh)) {
        return "all of its surface shows one point of its picture, so it has one colour: export it again "
               "with its "
               "texture coordinates (UV)";
    }
    const std::optional<glm::vec4> colour =
        has_pictures || !mesh.colours.empty() ? one_colour_of(mesh) : std::nullopt;
    if (!colour) {
        return std::nullopt;
    }
    const glm::u8vec4 code = code_of(*colour);
    return fmt::format(
        "all of its colours are one, red {}, green {}, blue {}, though it has {}: if it is not so in truth, "
        "export it again with its colours, or name a picture with --texture FILE",
        code.r, code.g, code.b, has_pictures ? "a picture" : "colours at its vertices");
}

std::optional<std::string> look_for_own_light(const SourceMesh& mesh) {
    std::size_t triangles = 0;
    for (const std::uint32_t material : mesh.triangle_materials) {
        triangles += mesh.materials[material].has_own_light ? 1 : 0;
    }
    if (triangles == 0) {
        return std::nullopt;
    }
    return fmt::format(
        "the colours of {} of its {} triangles are light in the file (emission, or unlit), so light and "
        "shade "
        "are probably in them already, and the museum light falls on them once more: bake it with "
        "--unlit",
        triangles, mesh.triangles.size());
}

} // namespace frustumscreen::bake
