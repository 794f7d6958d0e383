/// Builds a SourceMesh that is finite and bounded, with every index in range.
///
/// Errors   throws Refusal.
#pragma once

#include "assets_baked/bake/source_mesh.h"

#include <cstdint>
#include <string>

namespace frustumscreen::bake {

/// Limits of what a curator's computer can bake: 60 million triangles are 2.5 GiB of mesh. They also stop a small file
/// that repeats its parts endlessly.
inline constexpr std::size_t max_triangles = 60'000'000;
inline constexpr std::size_t max_source_vertices = 100'000'000;
/// Beyond this, squares and products of coordinates leave the range of the arithmetic that follows.
inline constexpr double largest_coordinate = 1e30;

class MeshAssembly {
public:
    explicit MeshAssembly(char default_up) { mesh_.default_up = default_up; }

    /// Makes space for more of them; no more than the file backs with data.
    void expect_vertices(std::size_t more);
    void expect_triangles(std::size_t more);

    /// `place` names the vertex's origin in messages, for example "vertex".
    std::uint32_t add_vertex(const glm::dvec3& position, const char* place, std::size_t number);
    /// A vertex like `vertex` in place, colour and normal.
    std::uint32_t copy_vertex(std::uint32_t vertex);
    /// Sets the last added vertex's coordinates. Default: (0, 0), and white.
    void set_uv(const glm::dvec2& uv) { set_uv(last_vertex(), uv); }
    void set_uv(std::uint32_t vertex, const glm::dvec2& uv);
    void set_colour(const glm::vec4& linear);
    /// Normals of any length; an invalid one becomes zero, as for vertices without a normal.
    void set_normal(const glm::dvec3& normal);
    /// Sets an sRGB code as written in the file, in 0..1 or 0..255. `codes_to_linear` converts all of them to linear
    /// factors and returns true if they are in 0..255: some are above 1, and all are whole or some are above 2.
    void set_colour_code(const glm::vec4& code);
    [[nodiscard]] bool codes_to_linear();
    /// Removes all vertices' colours, or texture coordinates.
    void drop_colours() { mesh_.colours.clear(); }
    void drop_uvs() { mesh_.uvs.clear(); }
    /// The coordinates that `set_uv` stores; one that addresses no picture becomes 0.
    [[nodiscard]] static glm::vec2 finite_uv(const glm::dvec2& uv);

    std::uint32_t add_material(const SourceMaterial& material);
    int add_texture(SourceTexture texture);
    [[nodiscard]] const SourceTexture& texture(int index) const {
        return mesh_.textures[static_cast<std::size_t>(index)];
    }
    void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t material);

    [[nodiscard]] std::size_t triangle_count() const { return mesh_.triangles.size(); }
    [[nodiscard]] const std::vector<glm::dvec3>& positions() const { return mesh_.positions; }
    [[nodiscard]] glm::vec2 uv(std::uint32_t vertex) const {
        return vertex < mesh_.uvs.size() ? mesh_.uvs[vertex] : glm::vec2(0.0F);
    }
    /// Refuses a mesh without triangles. `has_points`: the file has points that belong to no triangle.
    [[nodiscard]] SourceMesh finish(bool has_points = false);

private:
    [[nodiscard]] std::uint32_t last_vertex() const {
        return static_cast<std::uint32_t>(mesh_.positions.size() - 1);
    }

    SourceMesh mesh_;
    float largest_code_ = 0.0F;
    bool codes_are_whole_ = true;
};

} // namespace frustumscreen::bake
