#include "app/bench/techniques/relief/relief_images.h"

#include "firmware_host/base/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace frustumscreen::bench {

namespace {

constexpr int rim_texels = 2;       ///< empty on every side, so no ray starts inside the artifact
constexpr int continued_texels = 8; ///< bilinear reads beyond an outline must find colours instead of black

int axis_of(const glm::dvec3& normal) {
    const glm::dvec3 size = glm::abs(normal);
    if (size.x >= size.y && size.x >= size.z) {
        return 0;
    }
    return size.y >= size.z ? 1 : 2;
}

/// Mean of four rays' colours within a texel, in linear light, because a texel stands for its area. If all
/// four miss (the surface is thinner than a texel), the middle's colour is used.
glm::vec3 colour_of_texel(const Truth& truth, const glm::dvec3& middle, const glm::vec3& colour_of_middle,
                          const glm::dvec3& inward, const glm::dvec3& across, const glm::dvec3& down) {
    Truth::Hit hit;
    glm::vec3 sum(0.0F);
    int count = 0;
    for (int k = 0; k < 4; ++k) {
        const double right = (k & 1) != 0 ? 0.25 : -0.25;
        const double below = (k & 2) != 0 ? 0.25 : -0.25;
        const glm::dvec3 origin = middle + right * across + below * down;
        if (truth.first_hit(origin, inward, hit)) {
            sum += glm::clamp(hit.colour.linear, 0.0F, 1.0F);
            ++count;
        }
    }
    return count > 0 ? sum / static_cast<float>(count) : glm::clamp(colour_of_middle, 0.0F, 1.0F);
}

void rasterize_row(const Truth& truth, const geometry::Box& box, int row, ReliefImage& image) {
    const int texels = image.depth.width;
    const auto [across, down] = image_axes(image.axis);
    const glm::dvec3 size = box.high - box.low;
    glm::dvec3 origin(0.0);
    origin[image.axis] = image.high ? box.high[image.axis] : box.low[image.axis];
    origin[down] = box.low[down] + size[down] * (row + 0.5) / texels;
    glm::dvec3 inward(0.0);
    inward[image.axis] = image.high ? -1.0 : 1.0;
    glm::dvec3 one_across(0.0);
    glm::dvec3 one_down(0.0);
    one_across[across] = size[across] / texels;
    one_down[down] = size[down] / texels;
    Truth::Hit hit;
    for (int column = 0; column < texels; ++column) {
        origin[across] = box.low[across] + size[across] * (column + 0.5) / texels;
        if (!truth.first_hit(origin, inward, hit)) {
            continue;
        }
        const double depth = std::abs(hit.point_m[image.axis] - origin[image.axis]) / size[image.axis];
        image.depth.at(column, row) =
            static_cast<std::uint16_t>(std::lround(std::clamp(depth, 0.0, 1.0) * depth_codes));
        const glm::vec3 colour =
            colour_of_texel(truth, origin, hit.colour.linear, inward, one_across, one_down);
        image.colour.at(column, row) = {image::srgb8_from_linear(colour.r),
                                        image::srgb8_from_linear(colour.g),
                                        image::srgb8_from_linear(colour.b), 255};
    }
}

/// Gives one ring of texels around the coloured texels the mean of their neighbours; `known` marks coloured
/// texels.
void continue_colours(image::Image8& colour, image::Image<std::uint8_t>& known) {
    const image::Image8 before = colour;
    const image::Image<std::uint8_t> known_before = known;
    const auto mend = [&](int x, int y) {
        glm::ivec3 sum(0);
        int count = 0;
        for (int v = std::max(y - 1, 0); v <= std::min(y + 1, before.height - 1); ++v) {
            for (int u = std::max(x - 1, 0); u <= std::min(x + 1, before.width - 1); ++u) {
                if (known_before.at(u, v) != 0) {
                    sum += glm::ivec3(before.at(u, v));
                    ++count;
                }
            }
        }
        if (count > 0) {
            colour.at(x, y) = glm::u8vec4(glm::u8vec3(sum / count), 0);
            known.at(x, y) = 1;
        }
    };
    for (int y = 0; y < before.height; ++y) {
        for (int x = 0; x < before.width; ++x) {
            if (known_before.at(x, y) == 0) {
                mend(x, y);
            }
        }
    }
}

/// Cosine between the surface normal and the line of sight, from the smaller steps of depth next to the
/// texel.
std::uint8_t squareness(const ReliefImage& image, const glm::dvec3& size, const glm::ivec2& at) {
    const auto [across, down] = image_axes(image.axis);
    const auto step = [&](int x, int y) {
        const std::uint16_t beside = image.depth.at(at.x + x, at.y + y);
        return beside == no_depth ? 1.0 : std::abs(beside - image.depth.at(at.x, at.y)) / depth_codes;
    };
    const double per_texel = image.depth.width * size[image.axis];
    const double slope_across = std::min(step(-1, 0), step(1, 0)) * per_texel / size[across];
    const double slope_down = std::min(step(0, -1), step(0, 1)) * per_texel / size[down];
    const double cosine = 1.0 / std::sqrt(1.0 + slope_across * slope_across + slope_down * slope_down);
    return static_cast<std::uint8_t>(std::max(std::lround(255.0 * cosine), 1L));
}

ReliefImage cast_image(const Truth& truth, const geometry::Box& box, const glm::dvec3& normal, int texels) {
    const int axis = axis_of(normal);
    ReliefImage image{.axis = axis,
                      .high = normal[axis] > 0.0,
                      .colour = {texels, texels},
                      .depth = {texels, texels, no_depth}};
    parallel_for(static_cast<std::size_t>(texels), 4, [&](std::size_t begin, std::size_t end) {
        for (std::size_t row = begin; row < end; ++row) {
            rasterize_row(truth, box, static_cast<int>(row), image);
        }
    });
    for (int y = 1; y + 1 < texels; ++y) { // the rim is empty
        for (int x = 1; x + 1 < texels; ++x) {
            if (image.depth.at(x, y) != no_depth) {
                image.colour.at(x, y).a = squareness(image, box.high - box.low, {x, y});
            }
        }
    }
    image::Image<std::uint8_t> known(texels, texels);
    for (std::size_t k = 0; k < known.texels.size(); ++k) {
        known.texels[k] = image.depth.texels[k] != no_depth ? 1 : 0;
    }
    for (int ring = 0; ring < continued_texels; ++ring) {
        continue_colours(image.colour, known);
    }
    return image;
}

} // namespace

geometry::Box placed_box(const bake::SourceMesh& mesh, const glm::dmat4& prop_from_artifact) {
    geometry::Box box{glm::dvec3(std::numeric_limits<double>::infinity()),
                      glm::dvec3(-std::numeric_limits<double>::infinity())};
    for (const std::array<std::uint32_t, 3>& triangle : mesh.triangles) {
        for (const std::uint32_t corner : triangle) {
            const glm::dvec3 placed(prop_from_artifact * glm::dvec4(mesh.positions[corner], 1.0));
            box = {glm::min(box.low, placed), glm::max(box.high, placed)};
        }
    }
    return box;
}

ReliefImages rasterize_relief_images(const Truth& truth, const geometry::Box& artifact,
                                     const geometry::PropShape& prop, int texels) {
    // A flat artifact also needs a box with a volume.
    const glm::dvec3 size = artifact.high - artifact.low;
    const double longest = std::max({size.x, size.y, size.z});
    const glm::dvec3 rim = glm::max(size, glm::dvec3(1e-3 * longest)) *
                           (static_cast<double>(rim_texels) / (texels - 2 * rim_texels));
    ReliefImages result{{artifact.low - rim, artifact.high + rim}, texels, {}};
    for (const geometry::PropFace& face : prop.faces) {
        result.images.push_back(cast_image(truth, result.box, face.plane.normal, texels));
    }
    return result;
}

image::Image<glm::u16vec2> material_along(const ReliefImages& images, int axis) {
    constexpr double codes = 65535.0;
    const auto code = [&](double box) { return static_cast<std::uint16_t>(std::lround(box * codes)); };
    image::Image<glm::u16vec2> material(images.texels, images.texels, glm::u16vec2(0, 65535));
    for (const ReliefImage& image : images.images) {
        for (std::size_t k = 0; image.axis == axis && k < material.texels.size(); ++k) {
            glm::u16vec2& at = material.texels[k];
            const double depth = image.depth.texels[k] / depth_codes;
            if (image.depth.texels[k] == no_depth) {
                at = {65535, 0};
            } else if (at.x <= at.y) {
                (image.high ? at.y : at.x) = code(image.high ? 1.0 - depth : depth);
            }
        }
    }
    return material;
}

} // namespace frustumscreen::bench
