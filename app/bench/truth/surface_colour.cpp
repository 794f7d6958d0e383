#include "app/bench/truth/surface_colour.h"

#include <cmath>

namespace frustumscreen::bench {

namespace {

int wrapped(int texel, int size, bake::Wrap wrap) {
    switch (wrap) {
    case bake::Wrap::Clamp:
        return std::min(std::max(texel, 0), size - 1);
    case bake::Wrap::Mirror: {
        const int period = 2 * size;
        const int within = ((texel % period) + period) % period;
        return within < size ? within : period - 1 - within;
    }
    case bake::Wrap::Repeat:
        break;
    }
    return ((texel % size) + size) % size;
}

/// Texel coordinates of huge or non-finite uvs would not fit an int; one period gives an identical picture.
double reduced(double coordinate, bake::Wrap wrap) {
    if (!std::isfinite(coordinate)) {
        return 0.0;
    }
    return wrap == bake::Wrap::Clamp ? std::fmin(std::fmax(coordinate, 0.0), 1.0)
                                     : std::fmod(coordinate, 2.0);
}

/// Bilinear at the base level: colour in linear light, alpha as stored.
glm::dvec4 sample(const bake::SourceTexture& texture, const glm::dvec2& uv) {
    const image::Image8& image = *texture.image;
    const double x = reduced(uv.x, texture.wrap_u) * image.width - 0.5;
    const double y = reduced(uv.y, texture.wrap_v) * image.height - 0.5;
    const int left = static_cast<int>(std::floor(x));
    const int top = static_cast<int>(std::floor(y));
    const std::array<float, 256>& linear = image::linear_from_srgb8();
    glm::dvec4 sum(0.0);
    for (int dy = 0; dy < 2; ++dy) {
        for (int dx = 0; dx < 2; ++dx) {
            const glm::u8vec4 texel = image.at(wrapped(left + dx, image.width, texture.wrap_u),
                                               wrapped(top + dy, image.height, texture.wrap_v));
            const double weight =
                (dx == 0 ? 1.0 - (x - left) : x - left) * (dy == 0 ? 1.0 - (y - top) : y - top);
            sum += weight * glm::dvec4(linear[texel.r], linear[texel.g], linear[texel.b], texel.a / 255.0);
        }
    }
    return sum;
}

template <typename Attribute>
glm::vec<Attribute::length(), double> blended(const std::vector<Attribute>& values,
                                              const std::array<std::uint32_t, 3>& corners, double u,
                                              double v) {
    using Wide = glm::vec<Attribute::length(), double>;
    return (1.0 - u - v) * Wide(values[corners[0]]) + u * Wide(values[corners[1]]) +
           v * Wide(values[corners[2]]);
}

} // namespace

SurfaceColour surface_colour(const bake::SourceMesh& mesh, std::uint32_t triangle, double u, double v) {
    const std::array<std::uint32_t, 3>& corners = mesh.triangles[triangle];
    const bake::SourceMaterial& material = mesh.materials[mesh.triangle_materials[triangle]];
    glm::dvec4 colour(material.base_colour);
    if (material.texture >= 0 && !mesh.uvs.empty()) {
        const bake::SourceTexture& texture = mesh.textures[static_cast<std::size_t>(material.texture)];
        if (texture.image && texture.image->width > 0 && texture.image->height > 0) {
            colour *= sample(texture, blended(mesh.uvs, corners, u, v));
        }
    }
    if (!mesh.colours.empty()) {
        colour *= blended(mesh.colours, corners, u, v);
    }
    return {glm::vec3(colour), static_cast<float>(colour.a)};
}

} // namespace frustumscreen::bench
