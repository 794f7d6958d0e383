#include "assets_baked/bake/eye_rays.h"
#include "assets_baked/bake/level.h"
#include "assets_baked/bake/relief_scene.h"
#include "assets_baked/bake/seen_region.h"
#include "firmware_host/base/quantile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <vector>

namespace frustumscreen::bake {

namespace {

/// `curtains`: a ray that meets them first hits nothing; null: there are none.
TraceSurface on(const SourceScene& scene, const SourceScene* curtains = nullptr) {
    return [&scene, curtains](const glm::vec3& eye, const glm::vec3& direction) {
        constexpr float before = 1.0F - 1e-5F; // a curtain hangs from the surface's own edge
        const SurfaceHit hit = scene.trace(eye, direction);
        const bool is_hidden =
            hit.hit && curtains != nullptr && curtains->occluded(eye, direction, 0.0F, before * hit.distance);
        return is_hidden ? SurfaceHit{} : hit;
    };
}

/// Number of hits with a 4-neighbour that misses.
std::size_t outline_of(const image::Image<float>& distances) {
    std::size_t found = 0;
    const auto missed = [&](int x, int y) { return distances.at(x, y) == no_hit; };
    for (int y = 1; y + 1 < distances.height; ++y) {
        for (int x = 1; x + 1 < distances.width; ++x) {
            found += !missed(x, y) &&
                             (missed(x - 1, y) || missed(x + 1, y) || missed(x, y - 1) || missed(x, y + 1))
                         ? 1
                         : 0;
        }
    }
    return found;
}

/// Movement of a ray's hit point when the ray moves to its neighbour, divided by the movement of the ray.
struct Slopes {
    float steepness = 1.0F; ///< mean over all neighbours
    /// For each patch: the distances of neighbours that hit different surfaces, summed and divided by the
    /// number of all neighbours. Hidden parts begin there, and a ray hits them when an edge moves.
    std::array<double, pack::seen_patches> over_edges{};
    double edges = 0.0; ///< neighbours that hit different surfaces
    double gaps = 0.0;  ///< sum of their distances
};

/// Hits of neighbouring rays that are this many ray spacings farther apart than their own neighbours are lie
/// on two surfaces, or on either side of an edge. A plane seen edge-on also has neighbours far apart, but all
/// of them are.
constexpr double edge_slope = 4.0;

Slopes slopes_of(const EyeRays& rays, const image::Image<float>& source) {
    double sum = 0.0;
    double count = 0.0;
    Slopes slopes;
    std::array<double, pack::seen_patches> counts{};
    const auto slope = [&](const glm::ivec2& from, const glm::ivec2& to) -> std::optional<double> {
        const auto inside = [&](const glm::ivec2& at) {
            return at.x >= 0 && at.y >= 0 && at.x < source.width && at.y < source.height;
        };
        if (!inside(from) || !inside(to) || source.at(from.x, from.y) == no_hit ||
            source.at(to.x, to.y) == no_hit) {
            return std::nullopt;
        }
        return std::abs(static_cast<double>(source.at(to.x, to.y) - source.at(from.x, from.y))) /
               rays.spacing_box();
    };
    for (int y = 0; y < source.height; ++y) {
        for (int x = 0; x < source.width; ++x) {
            for (const glm::ivec2 step : {glm::ivec2(1, 0), glm::ivec2(0, 1)}) {
                const glm::ivec2 here(x, y);
                const std::optional<double> found = slope(here, here + step);
                if (!found) {
                    continue;
                }
                const std::optional<double> before = slope(here - step, here);
                const std::optional<double> after = slope(here + step, here + 2 * step);
                const double usual =
                    std::min(before.value_or(after.value_or(0.0)), after.value_or(before.value_or(0.0)));
                counts[rays.patch(x, y)] += 1.0;
                sum += std::hypot(1.0, *found);
                count += 1.0;
                if (*found - usual >= edge_slope) {
                    slopes.over_edges[rays.patch(x, y)] += *found;
                    slopes.gaps += *found * rays.spacing_box();
                    slopes.edges += 1.0;
                }
            }
        }
    }
    for (std::size_t k = 0; k < pack::seen_patches; ++k) {
        slopes.over_edges[k] /= std::max(counts[k], 1.0);
    }
    slopes.steepness = count > 0.0 ? static_cast<float>(sum / count) : 1.0F;
    return slopes;
}

pack::SeenEye eye_of(const glm::dvec3& towards, const EyeRays& rays, const image::Image<float>& source,
                     float steepness) {
    pack::SeenEye eye{towards, steepness, {}};
    double hits = 0.0;
    for (int y = 0; y < source.height; ++y) {
        for (int x = 0; x < source.width; ++x) {
            if (source.at(x, y) != no_hit) {
                pack::SeenPatch& patch = eye.patches[rays.patch(x, y)];
                patch.place += glm::dvec3(rays.eye() + rays.direction(x, y) * source.at(x, y));
                patch.share += 1.0;
                hits += 1.0;
            }
        }
    }
    for (pack::SeenPatch& patch : eye.patches) {
        patch.place /= std::max(patch.share, 1.0);
        patch.share /= std::max(hits, 1.0);
    }
    return eye;
}

/// Comparison of a level with the source for one eye.
struct Compared {
    pack::SeenError error; ///< its means are of rays that hit the same surface in both
    double both = 0.0;     ///< rays that hit in both
    double beyond_edges =
        0.0; ///< of these, the rays that hit another surface: the sum of their errors, box units
};

Compared compare(const EyeRays& rays, const image::Image<float>& level, const image::Image<float>& source) {
    std::vector<double> off;
    std::array<double, pack::seen_patches> sums{};
    std::array<double, pack::seen_patches> counts{};
    std::size_t one = 0;
    Compared found;
    for (int y = 0; y < source.height; ++y) {
        for (int x = 0; x < source.width; ++x) {
            const bool hit = source.at(x, y) != no_hit;
            if (hit != (level.at(x, y) != no_hit)) {
                ++one;
            } else if (hit) {
                off.push_back(
                    std::abs(static_cast<double>(level.at(x, y)) - static_cast<double>(source.at(x, y))));
                if (off.back() < rays.spacing_box()) {
                    sums[rays.patch(x, y)] += off.back();
                    counts[rays.patch(x, y)] += 1.0;
                } else {
                    found.beyond_edges += off.back();
                }
            }
        }
    }
    pack::SeenError& seen = found.error;
    found.both = static_cast<double>(off.size());
    if (!off.empty()) {
        seen.mean_box = static_cast<float>(std::accumulate(sums.begin(), sums.end(), 0.0) /
                                           std::max(std::accumulate(counts.begin(), counts.end(), 0.0), 1.0));
        seen.silhouette_share = static_cast<float>(static_cast<double>(one) / found.both);
        seen.p95_box = static_cast<float>(quantile(std::move(off), 0.95));
    }
    for (std::size_t k = 0; k < pack::seen_patches; ++k) {
        seen.patches_box[k] = counts[k] > 0.0 ? static_cast<float>(sums[k] / counts[k]) : seen.mean_box;
    }
    if (const std::size_t outline = outline_of(source); outline > 0) {
        seen.outline_shift_box =
            static_cast<float>(rays.spacing_box() * static_cast<double>(one) / static_cast<double>(outline));
    }
    return found;
}

/// The source as hit by one eye's rays.
struct SeenSource {
    EyeRays rays;
    image::Image<float> distances;
    Slopes slopes;
};

/// Movement of a level's edges, box units, over all eyes together.
///
/// Prior: counts as if `taken` further places on an edge had been hit where the edge moves by the distance of
/// the surfaces, which is half of the distance along rays (Cauchy; error_estimate.h). For a level whose edges
/// move so little that hardly a ray detects it, that is the better estimate.
double edges_moved(const std::vector<Compared>& compared, const std::vector<SeenSource>& eyes,
                   const std::vector<double>& over_edges) {
    constexpr double taken = 4.0; // the uncertainty of a count of four is half of it
    double found = 0.0;
    double of_one = 0.0; // sum for edges that move by 1
    double gaps = 0.0;
    double edges = 0.0;
    double surface_box = 0.0;
    for (std::size_t k = 0; k < compared.size(); ++k) {
        found += compared[k].beyond_edges;
        of_one += compared[k].both * over_edges[k];
        gaps += eyes[k].slopes.gaps;
        edges += eyes[k].slopes.edges;
        surface_box +=
            0.5 * static_cast<double>(compared[k].error.mean_box) / static_cast<double>(compared.size());
    }
    if (!(of_one > 0.0)) {
        return 0.0;
    }
    const double gap = gaps / edges;
    return surface_box > 0.0 ? (found + taken * gap) / (of_one + taken * gap / surface_box) : found / of_one;
}

/// Adds the error of misplaced edges, which show what they should hide. An eye's rays hit few such places, so
/// their sum is mostly chance. The movement of a level's edges is common to all eyes; the error for an eye
/// follows from the depth behind its edges.
std::vector<pack::SeenError> with_edges(const std::vector<Compared>& compared,
                                        const std::vector<SeenSource>& eyes, const pack::SeenErrors& seen) {
    std::vector<double> over_edges(compared.size(), 0.0);
    for (std::size_t eye = 0; eye < compared.size(); ++eye) {
        for (std::size_t k = 0; k < pack::seen_patches; ++k) {
            over_edges[eye] += seen.eyes[eye].patches[k].share * eyes[eye].slopes.over_edges[k];
        }
    }
    const double moved_box = edges_moved(compared, eyes, over_edges);
    std::vector<pack::SeenError> errors;
    for (std::size_t eye = 0; eye < compared.size(); ++eye) {
        pack::SeenError& error = errors.emplace_back(compared[eye].error);
        error.mean_box += static_cast<float>(moved_box * over_edges[eye]);
        for (std::size_t k = 0; k < pack::seen_patches; ++k) {
            error.patches_box[k] += static_cast<float>(moved_box * eyes[eye].slopes.over_edges[k]);
        }
    }
    return errors;
}

pack::SeenErrors errors_behind(const SourceScene* curtains, const pack::Pack& pack,
                               std::span<const pack::MeasuredRelief> reliefs, const SourceScene& source,
                               const ViewingZone& zone, double share) {
    const double rays_an_eye = 10'000.0 * share;
    pack::SeenErrors seen;
    std::vector<SeenSource> eyes;
    for (const glm::dvec3& towards : eyes_of(zone)) {
        const EyeRays rays(towards, pack.box_size, rays_an_eye);
        image::Image<float> distances = rays.cast(on(source, curtains));
        const Slopes slopes = slopes_of(rays, distances);
        seen.eyes.push_back(eye_of(towards, rays, distances, slopes.steepness));
        eyes.push_back({rays, std::move(distances), slopes});
    }
    const auto errors_of = [&](const TraceSurface& trace) {
        std::vector<Compared> compared;
        for (const SeenSource& eye : eyes) {
            compared.push_back(compare(eye.rays, eye.rays.cast(trace), eye.distances));
        }
        return with_edges(compared, eyes, seen);
    };
    for (const pack::PackLevel& level : pack.levels) {
        const SourceMesh mesh = textured_source(level, pack.textures[level.texture], pack.box_size);
        const SourceScene scene(mesh, mesh.positions, Sides::Front);
        seen.levels.push_back(errors_of(on(scene, curtains)));
    }
    for (const pack::MeasuredRelief& measured : reliefs) {
        const ReliefScene scene(measured.relief);
        seen.reliefs.push_back(errors_of(
            [&](const glm::vec3& eye, const glm::vec3& direction) { return scene.trace(eye, direction); }));
    }
    return seen;
}

} // namespace

pack::SeenErrors seen_errors(const pack::Pack& pack, std::span<const pack::MeasuredRelief> reliefs,
                             const SourceScene& source, const ViewingZone& zone, double share) {
    return errors_behind(nullptr, pack, reliefs, source, zone, share);
}

pack::SeenErrors seen_region_errors(const pack::Pack& pack, const SourceScene& source,
                                    const SourceScene& curtains, const ViewingZone& zone, double share) {
    return errors_behind(&curtains, pack, {}, source, zone, share);
}

pack::SeenError mean_of(std::span<const pack::SeenError> seen) {
    pack::SeenError mean;
    const float share = 1.0F / static_cast<float>(std::max<std::size_t>(seen.size(), 1));
    for (const pack::SeenError& each : seen) {
        mean.mean_box += share * each.mean_box;
        mean.p95_box += share * each.p95_box;
        mean.outline_shift_box += share * each.outline_shift_box;
        mean.silhouette_share += share * each.silhouette_share;
    }
    return mean;
}

bool good_enough(const pack::LevelError& measured, const pack::SeenError& seen, double mm_per_box) {
    constexpr double worst_mm =
        1.0; // two pixels of a projector of 1280 x 800; means would hide a blade that is cut off
    // The worst of fifty poses in two set-ups shows up to three times these values.
    constexpr double mean_mm = 0.09;
    constexpr double outline_shift_mm = 0.04;
    constexpr double silhouette_share = 0.012; // a thin object consists of outline
    const auto within = [mm_per_box](float box, double max_mm) {
        return static_cast<double>(box) * mm_per_box <= max_mm;
    };
    return within(measured.max_box, worst_mm) && within(seen.mean_box, mean_mm) &&
           within(seen.outline_shift_box, outline_shift_mm) &&
           static_cast<double>(seen.silhouette_share) <= silhouette_share;
}

} // namespace frustumscreen::bake
