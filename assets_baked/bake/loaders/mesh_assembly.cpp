#include "assets_baked/bake/loaders/mesh_assembly.h"

#include "assets_baked/bake/loaders/refusal.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace frustumscreen::bake {

namespace {

/// Up to this value 32 bits resolve fractions of a texel at 16k. A larger UV, or one that is not a number, has no
/// picture.
constexpr double largest_uv = 1e6;

float finite_or_zero(double value) {
    return std::abs(value) <= largest_uv ? static_cast<float>(value) : 0.0F;
}

float colour_factor(float value) {
    return std::isfinite(value) ? std::clamp(value, 0.0F, 1.0F) : 1.0F;
}

/// At least doubles the space if there is too little, because a file may have many small parts.
template <typename Value> void make_space(std::vector<Value>& values, std::size_t more, std::size_t most) {
    const std::size_t needed = std::min(values.size() + more, most);
    if (needed > values.capacity()) {
        values.reserve(std::max(needed, std::min(2 * values.capacity(), most)));
    }
}

/// As many of an attribute as there will be positions, so that no growing vector is copied.
template <typename Attribute>
void resize_like(std::vector<Attribute>& values, const std::vector<glm::dvec3>& positions,
                 const Attribute& missing) {
    values.reserve(positions.capacity());
    values.resize(positions.size(), missing);
}

} // namespace

void MeshAssembly::expect_vertices(std::size_t more) {
    make_space(mesh_.positions, more, max_source_vertices);
}

void MeshAssembly::expect_triangles(std::size_t more) {
    make_space(mesh_.triangles, more, max_triangles);
    make_space(mesh_.triangle_materials, more, max_triangles);
}

std::uint32_t MeshAssembly::add_vertex(const glm::dvec3& position, const char* place, std::size_t number) {
    for (int axis = 0; axis < 3; ++axis) {
        if (!(std::abs(position[axis]) <= largest_coordinate)) {
            refuse_damage("{} {}: its position ({}, {}, {}) is not a finite point within 1e30", place, number,
                          position.x, position.y, position.z);
        }
    }
    if (mesh_.positions.size() >= max_source_vertices) {
        refuse("mesh.too_many_vertices",
               "it has more than {} vertices; simplify it first, for instance in MeshLab",
               max_source_vertices);
    }
    mesh_.positions.push_back(position);
    return static_cast<std::uint32_t>(mesh_.positions.size() - 1);
}

std::uint32_t MeshAssembly::copy_vertex(std::uint32_t vertex) {
    const std::uint32_t copy = add_vertex(glm::dvec3(mesh_.positions[vertex]), "vertex", vertex);
    if (vertex < mesh_.colours.size()) {
        const glm::vec4 colour = mesh_.colours[vertex];
        set_colour(colour);
    }
    if (vertex < mesh_.normals.size()) {
        set_normal(glm::dvec3(mesh_.normals[vertex]));
    }
    return copy;
}

void MeshAssembly::set_uv(std::uint32_t vertex, const glm::dvec2& uv) {
    resize_like(mesh_.uvs, mesh_.positions, glm::vec2(0.0F));
    mesh_.uvs[vertex] = finite_uv(uv);
}

glm::vec2 MeshAssembly::finite_uv(const glm::dvec2& uv) {
    return {finite_or_zero(uv.x), finite_or_zero(uv.y)};
}

void MeshAssembly::set_colour(const glm::vec4& linear) {
    resize_like(mesh_.colours, mesh_.positions, glm::vec4(1.0F));
    mesh_.colours.back() = glm::vec4(colour_factor(linear.r), colour_factor(linear.g),
                                     colour_factor(linear.b), colour_factor(linear.a));
}

void MeshAssembly::set_normal(const glm::dvec3& normal) {
    const double length = glm::length(normal);
    const bool is_direction = length > 1e-12 && length < largest_coordinate;
    resize_like(mesh_.normals, mesh_.positions, glm::vec3(0.0F));
    mesh_.normals.back() = is_direction ? glm::vec3(normal / length) : glm::vec3(0.0F);
}

void MeshAssembly::set_colour_code(const glm::vec4& code) {
    resize_like(mesh_.colours, mesh_.positions,
                glm::vec4(std::numeric_limits<float>::infinity())); // a missing colour: white
    mesh_.colours.back() = code;
    for (int i = 0; i < 3; ++i) {
        if (std::isfinite(code[i])) {
            largest_code_ = std::max(largest_code_, code[i]);
            codes_are_whole_ = codes_are_whole_ && code[i] == std::floor(code[i]);
        }
    }
}

bool MeshAssembly::codes_to_linear() {
    const bool in_255 = largest_code_ > 1.0F && (codes_are_whole_ || largest_code_ > 2.0F);
    const float largest = in_255 ? 255.0F : 1.0F;
    for (glm::vec4& colour : mesh_.colours) {
        for (int i = 0; i < 3; ++i) {
            colour[i] = static_cast<float>(
                image::linear_from_srgb(static_cast<double>(colour_factor(colour[i] / largest))));
        }
        colour.a = colour_factor(colour.a / (colour.a > 1.0F ? largest : 1.0F));
    }
    return in_255;
}

std::uint32_t MeshAssembly::add_material(const SourceMaterial& material) {
    mesh_.materials.push_back(material);
    return static_cast<std::uint32_t>(mesh_.materials.size() - 1);
}

int MeshAssembly::add_texture(SourceTexture texture) {
    mesh_.textures.push_back(std::move(texture));
    return static_cast<int>(mesh_.textures.size() - 1);
}

void MeshAssembly::add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t material) {
    if (mesh_.triangles.size() >= max_triangles) {
        refuse("mesh.too_many_triangles",
               "it has more than {} triangles; simplify it first, for instance in MeshLab", max_triangles);
    }
    mesh_.triangles.push_back({a, b, c});
    mesh_.triangle_materials.push_back(material);
}

SourceMesh MeshAssembly::finish(bool has_points) {
    if (mesh_.triangles.empty() && (has_points || !mesh_.positions.empty())) {
        refuse("mesh.point_cloud",
               "it is a point cloud without faces (no triangles): mesh it first, for instance in MeshLab");
    }
    if (mesh_.triangles.empty()) {
        refuse("mesh.no_triangles",
               "it has no triangles, so there is nothing to show; export the artifact itself, as a mesh");
    }
    if (mesh_.materials.empty()) {
        mesh_.materials.emplace_back();
    }
    const std::size_t vertices = mesh_.positions.size();
    if (!mesh_.uvs.empty()) {
        mesh_.uvs.resize(vertices, glm::vec2(0.0F));
    }
    if (!mesh_.colours.empty()) {
        mesh_.colours.resize(vertices, glm::vec4(1.0F));
    }
    if (!mesh_.normals.empty()) {
        mesh_.normals.resize(vertices, glm::vec3(0.0F));
    }
    for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) {
        for (const std::uint32_t vertex : mesh_.triangles[i]) {
            if (vertex >= vertices) {
                refuse_contradiction("triangle {} uses vertex {}, but there are {} vertices", i, vertex,
                                     vertices);
            }
        }
    }
    return std::move(mesh_);
}

} // namespace frustumscreen::bake
