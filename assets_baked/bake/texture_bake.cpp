#include "assets_baked/bake/texture_bake.h"

#include "firmware_host/base/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace frustumscreen::bake {

namespace {

constexpr std::uint32_t nothing = 0xFFFFFFFFU;

struct SurfacePoint {
    glm::vec3 position;
    glm::vec3 normal;
};

template <typename T>
T blend(const std::vector<T>& values, const ChartedMesh& mesh, const AtlasTexel& texel) {
    const std::size_t t = 3 * std::size_t{texel.triangle};
    return values[mesh.indices[t]] * (1.0F - texel.u - texel.v) + values[mesh.indices[t + 1]] * texel.u +
           values[mesh.indices[t + 2]] * texel.v;
}

SurfacePoint surface_at(const ChartedMesh& mesh, const AtlasTexel& texel) {
    const std::size_t t = 3 * std::size_t{texel.triangle};
    const glm::vec3 normal = mesh.normals[t] * (1.0F - texel.u - texel.v) + mesh.normals[t + 1] * texel.u +
                             mesh.normals[t + 2] * texel.v;
    return {blend(mesh.positions, mesh, texel), glm::normalize(normal)};
}

/// Weights and squared distance of the point of triangle abc nearest to p, in the plane.
glm::vec3 nearest_in_plane(const glm::vec2& p, const glm::vec2& a, const glm::vec2& b, const glm::vec2& c) {
    const auto cross = [](const glm::vec2& x, const glm::vec2& y) { return x.x * y.y - x.y * y.x; };
    const float area = cross(b - a, c - a);
    if (area > 0.0F) {
        const float u = cross(p - a, c - a) / area;
        const float v = cross(b - a, p - a) / area;
        if (u >= 0.0F && v >= 0.0F && u + v <= 1.0F) {
            return {u, v, 0.0F};
        }
    }
    glm::vec3 best(0.0F, 0.0F, 1e30F);
    const auto on_edge = [&](const glm::vec2& from, const glm::vec2& to, auto weights) {
        const glm::vec2 along = to - from;
        const float squared = glm::dot(along, along);
        const float s =
            squared > 0.0F ? std::fmin(std::fmax(glm::dot(p - from, along) / squared, 0.0F), 1.0F) : 0.0F;
        const glm::vec2 away = p - from - along * s;
        const float distance = glm::dot(away, away);
        if (distance < best.z) {
            const glm::vec2 w = weights(s);
            best = {w.x, w.y, distance};
        }
    };
    on_edge(a, b, [](float s) { return glm::vec2(s, 0.0F); });
    on_edge(b, c, [](float s) { return glm::vec2(1.0F - s, s); });
    on_edge(c, a, [](float s) { return glm::vec2(0.0F, 1.0F - s); });
    return best;
}

/// Four points of the texel, a quarter of a texel from its centre along each tangent, in the plane of its
/// normal.
std::array<SurfacePoint, 4> parts_of(const ChartedMesh& mesh, const AtlasTexel& texel) {
    const SurfacePoint centre = surface_at(mesh, texel);
    const glm::vec3 tangent = glm::normalize(glm::cross(
        std::abs(centre.normal.z) < 0.9F ? glm::vec3(0, 0, 1) : glm::vec3(0, 1, 0), centre.normal));
    const glm::vec3 bitangent = glm::cross(centre.normal, tangent);
    const std::size_t t = 3 * std::size_t{texel.triangle};
    const float uv_length =
        glm::distance(mesh.uv_texels[mesh.indices[t]], mesh.uv_texels[mesh.indices[t + 1]]);
    const float length = glm::distance(mesh.positions[mesh.indices[t]], mesh.positions[mesh.indices[t + 1]]);
    const float quarter = uv_length > 0.0F ? 0.25F * length / uv_length : 0.0F;
    std::array<SurfacePoint, 4> parts{centre, centre, centre, centre};
    for (unsigned k = 0; k < 4; ++k) {
        parts[k].position +=
            tangent * ((k & 1U) != 0 ? quarter : -quarter) + bitangent * ((k & 2U) != 0 ? quarter : -quarter);
    }
    return parts;
}

/// Alpha, scaled so that the material's cut-off maps to one half.
float coverage_of(const SourceScene& source, const SurfaceHit& hit) {
    const SourceMaterial& material = source.mesh().materials[source.mesh().triangle_materials[hit.triangle]];
    if (!material.alpha_mask) {
        return 1.0F;
    }
    const float alpha = source.colour(hit).w;
    const float cut = material.alpha_cutoff;
    if (alpha < cut) {
        return 0.5F * std::fmax(alpha, 0.0F) / cut;
    }
    return cut < 1.0F ? std::fmin(1.0F, 0.5F + 0.5F * (alpha - cut) / (1.0F - cut)) : 1.0F;
}

glm::vec3 clamped_rgb(const glm::vec4& colour) {
    return glm::clamp(glm::vec3(colour), glm::vec3(0.0F), glm::vec3(1.0F));
}

/// Fills unknown texels with the mean of the known ones in their 3 x 3 neighbourhood; `known` marks them.
template <typename Texel>
void spread(image::Image<Texel>& image, image::Image<std::uint8_t>& known, int passes) {
    for (int pass = 0; pass < passes; ++pass) {
        const image::Image<std::uint8_t> before = known;
        const auto row = [&](std::size_t begin, std::size_t end) {
            for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
                for (int x = 0; x < image.width; ++x) {
                    if (before.at(x, y) != 0) {
                        continue;
                    }
                    Texel sum(0.0F);
                    float count = 0.0F;
                    for (int j = std::max(0, y - 1); j <= std::min(image.height - 1, y + 1); ++j) {
                        for (int i = std::max(0, x - 1); i <= std::min(image.width - 1, x + 1); ++i) {
                            if (before.at(i, j) != 0) {
                                sum += image.at(i, j);
                                count += 1.0F;
                            }
                        }
                    }
                    if (count > 0.0F) {
                        image.at(x, y) = sum / count;
                        known.at(x, y) = 1;
                    }
                }
            }
        };
        parallel_for(static_cast<std::size_t>(image.height), 32, row);
    }
}

/// The mean of each known texel and its known neighbours; charts are too far apart to mix.
image::ImageFloat smoothed(const image::ImageFloat& image, const image::Image<std::uint8_t>& known) {
    image::ImageFloat result = image;
    parallel_for(static_cast<std::size_t>(image.height), 32, [&](std::size_t begin, std::size_t end) {
        for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
            for (int x = 0; x < image.width; ++x) {
                glm::vec3 sum(0.0F);
                float count = 0.0F;
                for (int j = std::max(0, y - 1); j <= std::min(image.height - 1, y + 1); ++j) {
                    for (int i = std::max(0, x - 1); i <= std::min(image.width - 1, x + 1); ++i) {
                        const float weight = known.at(i, j) != 0 ? 1.0F : 0.0F;
                        sum += image.at(i, j) * weight;
                        count += weight;
                    }
                }
                if (known.at(x, y) != 0) {
                    result.at(x, y) = sum / count;
                }
            }
        }
    });
    return result;
}

template <typename Function>
void for_each_texel(const image::Image<AtlasTexel>& texels, const Function& function) {
    parallel_for(static_cast<std::size_t>(texels.height), 4, [&](std::size_t begin, std::size_t end) {
        for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
            for (int x = 0; x < texels.width; ++x) {
                if (texels.at(x, y).triangle != nothing) {
                    function(x, y, texels.at(x, y));
                }
            }
        }
    });
}

} // namespace

image::Image<AtlasTexel> rasterise(const ChartedMesh& mesh) {
    constexpr float margin = static_cast<float>(chart_gutter_texels) - 0.5F;
    image::Image<AtlasTexel> texels(mesh.atlas_width, mesh.atlas_height);
    image::Image<float> distances(mesh.atlas_width, mesh.atlas_height, margin * margin);
    for (std::size_t t = 0; 3 * t < mesh.indices.size(); ++t) {
        const glm::vec2& a = mesh.uv_texels[mesh.indices[3 * t]];
        const glm::vec2& b = mesh.uv_texels[mesh.indices[3 * t + 1]];
        const glm::vec2& c = mesh.uv_texels[mesh.indices[3 * t + 2]];
        const glm::ivec2 low = glm::max(glm::ivec2(glm::min(a, glm::min(b, c)) - margin), glm::ivec2(0));
        const glm::ivec2 high = glm::min(glm::ivec2(glm::max(a, glm::max(b, c)) + margin),
                                         glm::ivec2(texels.width - 1, texels.height - 1));
        for (int y = low.y; y <= high.y; ++y) {
            for (int x = low.x; x <= high.x; ++x) {
                if (distances.at(x, y) == 0.0F) {
                    continue;
                }
                const glm::vec3 nearest = nearest_in_plane(glm::vec2(x, y) + 0.5F, a, b, c);
                if (nearest.z < distances.at(x, y)) {
                    distances.at(x, y) = nearest.z;
                    texels.at(x, y) = {static_cast<std::uint32_t>(t), nearest.x, nearest.y};
                }
            }
        }
    }
    return texels;
}

image::ImageFloat bake_colour(const ChartedMesh& mesh, const image::Image<AtlasTexel>& texels,
                              const SourceScene& source, float reach_box) {
    image::ImageFloat colour(texels.width, texels.height, glm::vec3(0.0F));
    const bool varies = source.has_varying_colour();
    const glm::vec3 plain = clamped_rgb(source.mesh().materials[0].base_colour);
    for_each_texel(texels, [&](int x, int y, const AtlasTexel& texel) {
        if (!varies) {
            colour.at(x, y) = plain;
            return;
        }
        glm::vec3 sum(0.0F);
        float count = 0.0F;
        for (const SurfacePoint& at : parts_of(mesh, texel)) {
            const SurfaceHit hit = source.facing(at.position, at.normal, reach_box);
            if (hit.hit) {
                sum += clamped_rgb(source.colour(hit));
                count += 1.0F;
            }
        }
        colour.at(x, y) = count > 0.0F ? sum / count : plain;
    });
    return colour;
}

LayerColour bake_layer(const ChartedMesh& mesh, const image::Image<AtlasTexel>& texels,
                       const SourceScene& source, const SourceLayer& layer, float reach_box) {
    LayerColour made{image::ImageFloat(texels.width, texels.height, glm::vec3(0.0F)),
                     image::Image<float>(texels.width, texels.height, 0.0F)};
    for_each_texel(texels, [&](int x, int y, const AtlasTexel& texel) {
        glm::vec3 sum(0.0F);
        float alpha = 0.0F;
        for (const SurfacePoint& at : parts_of(mesh, texel)) {
            const SurfaceHit hit = source.facing(at.position, at.normal, reach_box);
            if (hit.hit) {
                const glm::vec4 colour = source.colour(layer, hit);
                const float share = glm::clamp(colour.w, 0.0F, 1.0F);
                sum += share * clamped_rgb(colour);
                alpha += share;
            }
        }
        made.colour.at(x, y) = alpha > 0.0F ? sum / alpha : glm::vec3(0.0F);
        made.alpha.at(x, y) = alpha / 4.0F;
    });
    return made;
}

void cover(LayerColour& layer, const image::ImageFloat& colour, const image::Image<float>& coverage,
           const image::Image<AtlasTexel>& texels) {
    for (std::size_t k = 0; k < colour.texels.size(); ++k) {
        if (texels.texels[k].triangle == nothing) {
            continue;
        }
        layer.colour.texels[k] =
            glm::mix(colour.texels[k], layer.colour.texels[k], std::min(1.0F, layer.alpha.texels[k]));
        layer.alpha.texels[k] = coverage.texels.empty() ? 1.0F : coverage.texels[k];
    }
}

image::Image8 finish_layer(const LayerColour& layer, const image::Image<AtlasTexel>& texels) {
    image::Image<float> has_colour = layer.alpha;
    image::Image<float> alpha = layer.alpha;
    image::Image<std::uint8_t> known(texels.width, texels.height, 0);
    for (std::size_t k = 0; k < texels.texels.size(); ++k) {
        has_colour.texels[k] = layer.alpha.texels[k] > 0.0F ? 1.0F : 0.0F;
        known.texels[k] = texels.texels[k].triangle != nothing ? 1 : 0;
    }
    spread(alpha, known, chart_gutter_texels);
    image::Image8 result = finish(layer.colour, texels, has_colour);
    for (std::size_t k = 0; k < result.texels.size(); ++k) {
        const bool is_chart = known.texels[k] != 0;
        result.texels[k].w =
            is_chart ? static_cast<std::uint8_t>(std::lround(255.0F * alpha.texels[k])) : std::uint8_t{255};
    }
    return result;
}

image::Image<float> bake_coverage(const ChartedMesh& mesh, const image::Image<AtlasTexel>& texels,
                                  const SourceScene& source, float reach_box) {
    const std::vector<SourceMaterial>& materials = source.mesh().materials;
    if (std::none_of(materials.begin(), materials.end(),
                     [](const SourceMaterial& material) { return material.alpha_mask; })) {
        return {};
    }
    image::Image<float> coverage(texels.width, texels.height, 0.0F);
    image::Image<std::uint8_t> known(texels.width, texels.height, 0);
    for_each_texel(texels, [&](int x, int y, const AtlasTexel& texel) {
        float sum = 0.0F;
        for (const SurfacePoint& at : parts_of(mesh, texel)) {
            const SurfaceHit hit = source.nearest(at.position, reach_box); // ignores alpha
            sum += hit.hit ? coverage_of(source, hit) : 1.0F;
        }
        coverage.at(x, y) = sum / 4.0F;
        known.at(x, y) = 1;
    });
    spread(coverage, known, chart_gutter_texels);
    return coverage;
}

image::ImageFloat bake_light(const ChartedMesh& mesh, const image::Image<AtlasTexel>& texels,
                             const SourceScene& source, const FileNormals& normals, float reach_box,
                             const std::optional<PlaceInWhole>& place) {
    // Light is smooth, so only every third texel in each direction is computed, then spread and smoothed.
    constexpr int stride = 3;
    const PartLight museum(source, place);
    image::ImageFloat light(texels.width, texels.height, glm::vec3(0.0F));
    image::Image<std::uint8_t> known(texels.width, texels.height, 0);
    for_each_texel(texels, [&](int x, int y, const AtlasTexel& texel) {
        if (x % stride == 0 && y % stride == 0) {
            SurfacePoint at = surface_at(mesh, texel);
            const SurfaceHit hit = source.facing(at.position, at.normal, reach_box);
            at.position =
                hit.hit ? hit.point : at.position; // a coarse surface below the source would be in its shadow
            light.at(x, y) = glm::vec3(museum.at(at.position, normals.at(hit, at.normal)));
            known.at(x, y) = 1;
        }
    });
    spread(light, known, 4);
    for (int pass = 0; pass < 2; ++pass) {
        light = smoothed(light, known);
    }
    return light;
}

image::Image8 finish(const image::ImageFloat& colour, const image::Image<AtlasTexel>& texels,
                     const image::Image<float>& coverage) {
    image::ImageFloat filled = colour;
    image::Image<std::uint8_t> known(texels.width, texels.height, 0);
    for (std::size_t k = 0; k < texels.texels.size(); ++k) {
        const bool cut = !coverage.texels.empty() && coverage.texels[k] < 0.5F;
        known.texels[k] = texels.texels[k].triangle != nothing && !cut ? 1 : 0;
    }
    spread(filled, known, 8);
    image::Image8 result(colour.width, colour.height, glm::u8vec4(0, 0, 0, 255));
    parallel_for(result.texels.size(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            const glm::vec3& c = filled.texels[k];
            const float alpha = coverage.texels.empty() ? 1.0F : coverage.texels[k];
            result.texels[k] = {image::srgb8_from_linear(c.x), image::srgb8_from_linear(c.y),
                                image::srgb8_from_linear(c.z),
                                static_cast<std::uint8_t>(std::lround(255.0F * alpha))};
        }
    });
    return result;
}

} // namespace frustumscreen::bake
