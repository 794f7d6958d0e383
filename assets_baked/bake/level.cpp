#include "assets_baked/bake/level.h"

#include "assets_baked/bake/clusters.h"
#include "firmware_host/base/parallel.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace frustumscreen::bake {

namespace {

constexpr float code_max = 65535.0F;

std::uint16_t quantised(double value01) {
    return static_cast<std::uint16_t>(std::lround(std::clamp(value01, 0.0, 1.0) * 65535.0));
}

glm::vec3 box_low(const glm::dvec3& box_size) {
    return {-box_size.x / 2.0, -box_size.y / 2.0, 0.0};
}

std::array<std::uint16_t, 3> codes_of(const glm::vec3& p, const glm::dvec3& box_size) {
    const glm::dvec3 unit = (glm::dvec3(p) - glm::dvec3(box_low(box_size))) / box_size;
    return {quantised(unit.x), quantised(unit.y), quantised(unit.z)};
}

glm::vec3 position_of(const pack::PackVertex& vertex, const glm::dvec3& box_size) {
    const glm::vec3 unit(vertex.position[0], vertex.position[1], vertex.position[2]);
    return box_low(box_size) + unit / code_max * glm::vec3(box_size);
}

std::vector<glm::vec3> positions_of(const pack::PackLevel& level, const glm::dvec3& box_size) {
    std::vector<glm::vec3> positions;
    positions.reserve(level.vertices.size());
    for (const pack::PackVertex& vertex : level.vertices) {
        positions.push_back(position_of(vertex, box_size));
    }
    return positions;
}

void order_vertices(pack::PackLevel& level) {
    std::vector<pack::PackVertex> ordered(level.vertices.size());
    const std::size_t count =
        meshopt_optimizeVertexFetch(ordered.data(), level.indices.data(), level.indices.size(),
                                    level.vertices.data(), level.vertices.size(), sizeof(pack::PackVertex));
    ordered.resize(count);
    level.vertices = std::move(ordered);
}

/// Points spread over triangles by area.
struct AreaSampler {
    explicit AreaSampler(std::vector<double> areas) : running(std::move(areas)) {
        std::partial_sum(running.begin(), running.end(), running.begin());
    }
    /// The triangle under the k-th of `count` even steps of the area; the weights come from a low-discrepancy
    /// pair.
    [[nodiscard]] std::size_t triangle(std::size_t k, std::size_t count) const {
        const double at = running.back() * (static_cast<double>(k) + 0.5) / static_cast<double>(count);
        return static_cast<std::size_t>(std::lower_bound(running.begin(), running.end(), at) -
                                        running.begin());
    }
    [[nodiscard]] static glm::vec2 weights(std::size_t k) {
        const double a = std::fmod(0.5 + static_cast<double>(k) * 0.7548776662466927, 1.0); // R2 sequence
        const double b = std::fmod(0.5 + static_cast<double>(k) * 0.5698402909980532, 1.0);
        const double root = std::sqrt(a);
        return {root * (1.0 - b), root * b};
    }
    std::vector<double> running;
};

glm::vec3 texture_at(const image::Image8& texture, glm::vec2 uv) {
    const float x = uv.x * static_cast<float>(texture.width) - 0.5F;
    const float y = uv.y * static_cast<float>(texture.height) - 0.5F;
    const int x0 = static_cast<int>(std::floor(x));
    const int y0 = static_cast<int>(std::floor(y));
    const std::array<float, 256>& linear = image::linear_from_srgb8();
    const auto texel = [&](int i, int j) {
        const glm::u8vec4 t =
            texture.at(std::clamp(i, 0, texture.width - 1), std::clamp(j, 0, texture.height - 1));
        return glm::vec3(linear[t.x], linear[t.y], linear[t.z]);
    };
    const float fx = x - static_cast<float>(x0);
    const float fy = y - static_cast<float>(y0);
    return glm::mix(glm::mix(texel(x0, y0), texel(x0 + 1, y0), fx),
                    glm::mix(texel(x0, y0 + 1), texel(x0 + 1, y0 + 1), fx), fy);
}

/// At most about 200,000 of the positions that triangles use, evenly chosen.
std::vector<glm::vec3> used_positions(const TriangleMesh& mesh) {
    constexpr std::size_t most = 200'000;
    std::vector<bool> used(mesh.positions.size());
    for (const std::uint32_t index : mesh.indices) {
        used[index] = true;
    }
    std::vector<glm::vec3> positions;
    const std::size_t stride = 1 + mesh.positions.size() / most;
    for (std::size_t k = 0; k < used.size(); k += stride) {
        if (used[k]) {
            positions.push_back(mesh.positions[k]);
        }
    }
    return positions;
}

float squared_codes(const glm::vec3& a, const glm::vec3& b) {
    float sum = 0.0F;
    for (int k = 0; k < 3; ++k) {
        const float difference = static_cast<float>(image::srgb8_from_linear(a[k])) -
                                 static_cast<float>(image::srgb8_from_linear(b[k]));
        sum += difference * difference;
    }
    return sum / 3.0F;
}

/// The usual number of samples, scaled by `share`.
std::size_t sample_count(double share) {
    return static_cast<std::size_t>(24000.0 * share);
}
constexpr float search_reach = 0.2F;

} // namespace

pack::PackLevel make_level(const ChartedMesh& mesh, const glm::dvec3& box_size) {
    pack::PackLevel level;
    level.vertices.reserve(mesh.positions.size());
    for (std::size_t k = 0; k < mesh.positions.size(); ++k) {
        pack::PackVertex vertex;
        vertex.position = codes_of(mesh.positions[k], box_size);
        vertex.uv = {quantised(mesh.uv_texels[k].x / static_cast<float>(mesh.atlas_width)),
                     quantised(mesh.uv_texels[k].y / static_cast<float>(mesh.atlas_height))};
        level.vertices.push_back(vertex);
    }
    level.indices = mesh.indices;
    level.clusters = cut_into_clusters(level.indices, positions_of(level, box_size));
    order_vertices(level);
    return level;
}

TriangleMesh on_codes(TriangleMesh mesh, const glm::dvec3& box_size) {
    for (glm::vec3& p : mesh.positions) {
        p = position_of({codes_of(p, box_size), 0, {}}, box_size);
    }
    return mesh;
}

TriangleMesh surface_of(const pack::PackLevel& level, const glm::dvec3& box_size) {
    TriangleMesh mesh;
    mesh.positions = positions_of(level, box_size);
    mesh.indices = level.indices;
    return mesh;
}

SourceMesh textured_source(const pack::PackLevel& level, const image::Image8& texture,
                           const glm::dvec3& box_size) {
    SourceMesh mesh = as_source(surface_of(level, box_size));
    for (const pack::PackVertex& vertex : level.vertices) {
        mesh.uvs.push_back(glm::vec2(vertex.uv[0], vertex.uv[1]) / 65535.0F);
    }
    const std::shared_ptr<const image::Image8> borrowed(std::shared_ptr<void>(), &texture);
    mesh.textures = {{borrowed, Wrap::Clamp, Wrap::Clamp}};
    mesh.materials[0].texture = 0;
    mesh.materials[0].alpha_mask = image::has_cut_texels(texture);
    return mesh;
}

SourceSamples sample_source(const SourceScene& source, const TriangleMesh& visible, float tolerance_box,
                            double share) {
    const std::size_t count = sample_count(share);
    const SourceMesh seen_mesh = as_source(visible);
    const std::vector<glm::dvec3> seen_points(visible.positions.begin(), visible.positions.end());
    const SourceScene seen(seen_mesh, seen_points);
    std::vector<double> areas(source.mesh().triangles.size());
    for (std::uint32_t t = 0; t < areas.size(); ++t) {
        areas[t] = glm::length(
            glm::cross(source.corner(t, 1) - source.corner(t, 0), source.corner(t, 2) - source.corner(t, 0)));
    }
    const AreaSampler sampler(std::move(areas));
    std::vector<SourceSamples::Point> points(count);
    std::vector<std::uint8_t> keep(count, 0);
    parallel_for(count, 256, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            const auto t = static_cast<std::uint32_t>(sampler.triangle(k, count));
            const glm::vec2 w = AreaSampler::weights(k);
            const glm::vec3 a = source.corner(t, 0);
            const glm::vec3 position = a + (source.corner(t, 1) - a) * w.x + (source.corner(t, 2) - a) * w.y;
            const glm::vec4 colour = source.colour(t, w.x, w.y);
            const SourceMaterial& material = source.mesh().materials[source.mesh().triangle_materials[t]];
            const SurfaceHit near = seen.nearest(position, tolerance_box);
            if (near.hit && !(material.alpha_mask && colour.w < material.alpha_cutoff)) {
                points[k] = {position, near.normal,
                             glm::clamp(glm::vec3(colour), glm::vec3(0.0F), glm::vec3(1.0F))};
                keep[k] = 1;
            }
        }
    });
    SourceSamples samples;
    samples.share = share;
    for (std::size_t k = 0; k < count; ++k) {
        if (keep[k] != 0) {
            samples.points.push_back(points[k]);
        }
    }
    samples.corners = used_positions(visible);
    return samples;
}

pack::LevelError measure_shape(const TriangleMesh& surface, const SourceScene& source,
                               const SourceSamples& samples) {
    const SourceMesh surface_mesh = as_source(surface);
    const std::vector<glm::dvec3> surface_points(surface.positions.begin(), surface.positions.end());
    const SourceScene surface_scene(surface_mesh, surface_points);
    const auto distance_to = [](const SourceScene& scene, const glm::vec3& point) {
        const SurfaceHit hit = scene.nearest(point, search_reach);
        return hit.hit ? hit.distance : search_reach;
    };
    std::vector<double> areas(surface.triangle_count());
    for (std::size_t t = 0; t < areas.size(); ++t) {
        areas[t] = glm::length(surface.area_normal(t));
    }
    const AreaSampler sampler(std::move(areas));
    const std::size_t count = sample_count(samples.share);
    std::vector<float> distances(count + samples.points.size());
    parallel_for(distances.size(), 256, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            if (k >= count) {
                distances[k] = distance_to(surface_scene, samples.points[k - count].position);
                continue;
            }
            const std::size_t t = sampler.triangle(k, count);
            const glm::vec2 w = AreaSampler::weights(k);
            const glm::vec3 a = surface.corner(t, 0);
            distances[k] =
                distance_to(source, a + (surface.corner(t, 1) - a) * w.x + (surface.corner(t, 2) - a) * w.y);
        }
    });
    std::vector<float> corners(samples.corners.size());
    parallel_for(corners.size(), 256, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            corners[k] = distance_to(surface_scene, samples.corners[k]);
        }
    });
    pack::LevelError error;
    error.mean_box = static_cast<float>(std::accumulate(distances.begin(), distances.end(), 0.0) /
                                        static_cast<double>(distances.size()));
    std::sort(distances.begin(), distances.end());
    error.p95_box = distances[distances.size() * 95 / 100];
    error.max_box = std::accumulate(corners.begin(), corners.end(), distances.back(),
                                    [](float a, float b) { return std::max(a, b); });
    return error;
}

float measure_colour(const pack::PackLevel& level, const image::Image8& texture, const glm::dvec3& box_size,
                     const SourceSamples& samples) {
    const TriangleMesh surface = surface_of(level, box_size);
    const SourceMesh surface_mesh = as_source(surface);
    const std::vector<glm::dvec3> surface_points(surface.positions.begin(), surface.positions.end());
    const SourceScene surface_scene(surface_mesh, surface_points);
    std::vector<float> squares(samples.points.size(), 0.0F);
    parallel_for(samples.points.size(), 256, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            const SourceSamples::Point& point = samples.points[k];
            const SurfaceHit hit = surface_scene.nearest(point.position, search_reach);
            if (hit.hit) {
                const auto uv = [&](int corner) {
                    const pack::PackVertex& v =
                        level.vertices[level.indices[3 * std::size_t{hit.triangle} +
                                                     static_cast<std::size_t>(corner)]];
                    return glm::vec2(v.uv[0], v.uv[1]) / code_max;
                };
                const glm::vec2 at = uv(0) * (1.0F - hit.u - hit.v) + uv(1) * hit.u + uv(2) * hit.v;
                squares[k] = squared_codes(texture_at(texture, at), point.colour);
            }
        }
    });
    return squares.empty()
               ? 0.0F
               : static_cast<float>(std::sqrt(std::accumulate(squares.begin(), squares.end(), 0.0) /
                                              static_cast<double>(squares.size())));
}

pack::LevelError measure(const pack::PackLevel& level, const image::Image8& texture,
                         const glm::dvec3& box_size, const SourceScene& source, const SourceSamples& samples,
                         bool compare_colour) {
    pack::LevelError error = measure_shape(surface_of(level, box_size), source, samples);
    error.colour_rmse = compare_colour ? measure_colour(level, texture, box_size, samples) : 0.0F;
    return error;
}

} // namespace frustumscreen::bake
