#include "assets_baked/bake/eye_rays.h"
#include "assets_baked/bake/level.h"
#include "firmware_host/base/parallel.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace frustumscreen::bake {

pack::LevelError seen_distances(const SourceScene& surface, const TraceSurface& trace,
                                const SourceScene& source, const glm::dvec3& box_size,
                                const ViewingZone& zone, double share) {
    const double rays_an_eye = 1'750.0 * share;
    constexpr float reach = 0.2F;
    const auto distance_to = [](const SourceScene& scene, const glm::vec3& point) {
        const SurfaceHit hit = scene.nearest(point, reach);
        return hit.hit ? hit.distance : reach;
    };
    const std::vector<glm::dvec3> eyes = eyes_of(zone);
    std::vector<std::vector<float>> of_eyes(eyes.size());
    parallel_for(eyes.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            const EyeRays rays(eyes[k], box_size, rays_an_eye);
            for (int ray = 0; ray < rays.size().x * rays.size().y; ++ray) {
                const glm::vec3 direction = rays.direction(ray % rays.size().x, ray / rays.size().x);
                if (const SurfaceHit hit = source.trace(rays.eye(), direction); hit.hit) {
                    of_eyes[k].push_back(distance_to(surface, hit.point));
                }
                if (const SurfaceHit hit = trace(rays.eye(), direction); hit.hit) {
                    of_eyes[k].push_back(distance_to(source, hit.point));
                }
            }
        }
    });
    std::vector<float> distances;
    for (const std::vector<float>& of_eye : of_eyes) {
        distances.insert(distances.end(), of_eye.begin(), of_eye.end());
    }
    if (distances.empty()) {
        return {};
    }
    std::sort(distances.begin(), distances.end());
    const double sum = std::accumulate(distances.begin(), distances.end(), 0.0);
    return {.mean_box = static_cast<float>(sum / static_cast<double>(distances.size())),
            .p95_box = distances[distances.size() * 95 / 100],
            .max_box = distances.back(),
            .colour_rmse = 0.0F};
}

} // namespace frustumscreen::bake
