#include "assets_baked/bake/bake.h"

#include "app/pack/pack_file.h"
#include "assets_baked/bake/box_frame.h"
#include "assets_baked/bake/level.h"
#include "assets_baked/bake/relief.h"
#include "assets_baked/bake/texture_bake.h"
#include "assets_baked/bake/triangle_mesh.h"
#include "assets_baked/bake/visibility.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <optional>
#include <tuple>

namespace frustumscreen {

namespace {

/// Simplification tolerances, box units: 1e-4 is 10 um on an artifact 0.1 m long. The finest level is the
/// source itself unless that is too large. (A tolerance near zero would not give it: the library's 32-bit
/// errors mean nothing below some 3e-4, and its result strays that far.)
constexpr std::size_t most_finest_triangles = 600'000;
constexpr float finest_tolerance = 5e-5F;
constexpr std::array<float, 6> mesh_tolerances{1e-4F, 2.2e-4F, 3.6e-4F, 5.5e-4F, 9e-4F, 2e-3F};
constexpr std::array<float, 4> relief_tolerances{5e-4F, 1e-3F, 2e-3F, 4e-3F};

/// The axis that each face looks along most.
std::vector<ReliefDirection> directions_of(const PropShape& prop) {
    std::vector<ReliefDirection> directions;
    for (const PropFace& face : prop.faces) {
        const glm::dvec3& n = face.plane.normal;
        const glm::dvec3 size = glm::abs(n);
        const int axis = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
        directions.push_back(static_cast<ReliefDirection>(2 * axis + (n[axis] < 0.0 ? 1 : 0)));
    }
    return directions;
}

/// A level with the picture that it wears.
struct Candidate {
    PackLevel level;
    Image8 texture;
};

/// Everything that candidates are made from and measured against.
class Bakery {
public:
    Bakery(const SourceMesh& mesh, const BoxFrame& frame, const BakeOptions& options)
        : options_(options), frame_(frame), points_(in_box(mesh, frame)), source_(mesh, points_),
          welded_(weld(mesh, points_)), texel_box_(1.0F / static_cast<float>(options.size)) {}

    [[nodiscard]] bool has_surface() const { return !welded_.indices.empty(); }
    [[nodiscard]] const std::vector<glm::dvec3>& points() const { return points_; }
    [[nodiscard]] const SourceScene& source() const { return source_; }

    std::vector<Candidate> mesh_levels() {
        finest_ =
            welded_.triangle_count() > most_finest_triangles ? simplify(welded_, finest_tolerance) : welded_;
        if (finest_.indices.empty()) {
            finest_ = welded_; // everything is thinner than the tolerance: a rod, a thread
        }
        options_.progress("what visitors can see", 0.02);
        visible_ = seen_sides(finest_);
        if (visible_.indices.empty()) {
            visible_ = finest_; // nothing is seen from the zone: a sheet flat on the table
        }
        samples_ = sample_source(source_, visible_, 5.0F * finest_tolerance);
        options_.progress("colours and light", 0.1);
        std::vector<Candidate> candidates{candidate_of(visible_, finest_tolerance)};
        const SourceMesh seen_mesh = as_source(visible_);
        const std::vector<glm::dvec3> seen_points(visible_.positions.begin(), visible_.positions.end());
        const SourceScene seen(seen_mesh, seen_points);
        std::size_t last = finest_.triangle_count();
        for (std::size_t k = 0; k < mesh_tolerances.size(); ++k) {
            options_.progress("simplified levels",
                              0.4 + 0.5 * static_cast<double>(k) / mesh_tolerances.size());
            const TriangleMesh fewer = simplify(finest_, mesh_tolerances[k]);
            if (fewer.indices.empty() || fewer.triangle_count() * 20 > last * 19) {
                continue; // nothing is left, or not 5 % fewer than the last: not worth a level
            }
            last = fewer.triangle_count();
            const TriangleMesh sides = visible_sides_like(fewer, visible_, seen, mesh_tolerances[k]);
            if (!sides.indices.empty()) {
                candidates.push_back(candidate_of(sides, mesh_tolerances[k]));
            }
        }
        return candidates;
    }

    /// Relief levels share one atlas; `relief` receives it.
    std::vector<Candidate> relief_levels(ReliefAtlas& atlas) {
        options_.progress("layered relief", 0.9);
        std::optional<BakedRelief> relief = bake_relief(source_, visible_, frame_.box_size,
                                                        directions_of(options_.prop.shape), options_.size);
        std::vector<Candidate> candidates;
        if (!relief) {
            return candidates;
        }
        const Image<AtlasTexel> texels = rasterise(relief->grid);
        const Image8 texture = lit(relief->grid, texels, std::move(relief->colour), 2.0F * texel_box_);
        for (std::size_t k = 0; k < relief_tolerances.size(); ++k) {
            options_.progress("relief levels",
                              0.92 + 0.06 * static_cast<double>(k) / relief_tolerances.size());
            const ChartedMesh fewer = simplify_grid(*relief, relief_tolerances[k]);
            if (fewer.indices.empty()) {
                continue;
            }
            PackLevel level = make_level(fewer, frame_.box_size, LevelTechnique::Relief);
            level.error = measure(level, texture, frame_.box_size, source_, samples_, options_.unlit);
            candidates.push_back({std::move(level), texture});
        }
        atlas = std::move(relief->atlas);
        return candidates;
    }

private:
    /// The mesh itself decides what is hidden. If the source did, parts of a simplified surface slightly
    /// outside it would seem visible. Only where alpha cuts holes the source must decide.
    [[nodiscard]] TriangleMesh seen_sides(const TriangleMesh& mesh) const {
        const std::vector<SourceMaterial>& materials = source_.mesh().materials;
        if (std::any_of(materials.begin(), materials.end(),
                        [](const SourceMaterial& material) { return material.alpha_mask; })) {
            return visible_sides(mesh, source_, options_.prop.zone);
        }
        const SourceMesh own = as_source(mesh);
        const std::vector<glm::dvec3> own_points(mesh.positions.begin(), mesh.positions.end());
        return visible_sides(mesh, SourceScene(own, own_points), options_.prop.zone);
    }

    Candidate candidate_of(const TriangleMesh& mesh, float tolerance) {
        const ChartedMesh charted = chart(mesh, texel_box_);
        const Image<AtlasTexel> texels = rasterise(charted);
        const float reach = 4.0F * tolerance + 1e-3F;
        Image8 texture = lit(charted, texels, bake_colour(charted, texels, source_, reach), reach,
                             bake_coverage(charted, texels, source_, reach));
        PackLevel level = make_level(charted, frame_.box_size, LevelTechnique::Mesh);
        level.error = measure(level, texture, frame_.box_size, source_, samples_, options_.unlit);
        return {std::move(level), std::move(texture)};
    }

    /// The texture in the museum's light: baked on the finest level, looked up from there for the others.
    Image8 lit(const ChartedMesh& mesh, const Image<AtlasTexel>& texels, ImageFloat colour, float reach,
               const Image<float>& coverage = {}) {
        if (!options_.unlit) {
            if (light_.texels.empty()) {
                light_mesh_ = mesh;
                light_ = bake_light(mesh, texels, source_);
                multiply(colour, light_);
            } else {
                multiply(colour, transfer_light(mesh, texels, light_mesh_, light_, reach));
            }
        }
        return finish(colour, texels, coverage);
    }

    static void multiply(ImageFloat& colour, const ImageFloat& light) {
        for (std::size_t k = 0; k < colour.texels.size(); ++k) {
            colour.texels[k] *= light.texels[k];
        }
    }

    const BakeOptions& options_;
    const BoxFrame& frame_;
    std::vector<glm::dvec3> points_;
    SourceScene source_;
    TriangleMesh welded_;
    float texel_box_;
    TriangleMesh finest_;
    TriangleMesh visible_;
    SourceSamples samples_;
    ChartedMesh light_mesh_;
    ImageFloat light_;
};

double mm_per_box(const Pack& pack, const BakedProp& prop) {
    return place(pack, prop.shape).metres_per_box * 1e3;
}

/// Judges the level as a visitor sees it on the usual prop.
bool good_enough(const PackLevel& level, const Pack& pack, const Bakery& bakery, const BakedProp& prop) {
    // The worst of fifty poses in two set-ups shows up to three times as much of each.
    constexpr double good_mean_mm = 0.09;
    constexpr double good_outline_shift_mm = 0.04;
    constexpr double good_silhouette_share = 0.012; // a thin object is all outline
    const SeenError error =
        seen_error(level, pack.textures[level.texture], pack.box_size, bakery.source(), prop.zone);
    const double scale = mm_per_box(pack, prop);
    return error.mean_box * scale <= good_mean_mm &&
           error.outline_shift_box * scale <= good_outline_shift_mm &&
           error.silhouette_share <= good_silhouette_share;
}

/// The first level that is good enough, from the finest one of at most `free_triangles` on. The last level is
/// for close views: it is drawn with more samples.
std::uint32_t choose_default(const Pack& pack, const Bakery& bakery, const BakedProp& prop) {
    constexpr std::size_t free_triangles = 30'000;
    std::uint32_t level = 0;
    while (level + 2 < pack.levels.size() && pack.levels[level + 1].indices.size() / 3 <= free_triangles) {
        ++level;
    }
    while (level + 1 < pack.levels.size() && !good_enough(pack.levels[level], pack, bakery, prop)) {
        ++level;
    }
    return level;
}

/// Drops levels that stray further than a visitor would accept; the nearest one always stays.
void drop_useless(std::vector<Candidate>& candidates) {
    constexpr float worst_mean_box = 3e-3F; // 0.3 mm on an artifact of 0.1 m
    float nearest = std::numeric_limits<float>::infinity();
    for (const Candidate& candidate : candidates) {
        nearest = std::min(nearest, candidate.level.error.mean_box);
    }
    std::erase_if(candidates, [&](const Candidate& candidate) {
        return candidate.level.error.mean_box > std::max(worst_mean_box, nearest);
    });
}

/// True if the mean error is smaller and neither the 95th percentile nor the colour error is clearly larger.
bool betters(const LevelError& dearer, const LevelError& cheaper) {
    constexpr float scatter = 1.1F; // of a measure over random points
    constexpr float least_rmse = 1.0F;
    return dearer.mean_box < cheaper.mean_box && dearer.p95_box < scatter * cheaper.p95_box &&
           dearer.colour_rmse < scatter * cheaper.colour_rmse + least_rmse;
}

/// Moves the kept candidates into the pack; equal textures are stored once.
void keep(Pack& pack, std::vector<Candidate>& candidates, ReliefAtlas& atlas) {
    drop_useless(candidates);
    std::vector<PackLevel> levels;
    levels.reserve(candidates.size());
    for (const Candidate& candidate : candidates) {
        levels.push_back(candidate.level);
    }
    std::optional<std::uint32_t> relief_texture;
    for (const std::size_t k : measured_front(levels)) {
        PackLevel& level = candidates[k].level;
        const bool is_relief = level.technique == LevelTechnique::Relief;
        if (is_relief && relief_texture) {
            level.texture = *relief_texture;
        } else {
            level.texture = static_cast<std::uint32_t>(pack.textures.size());
            pack.textures.push_back(std::move(candidates[k].texture));
            if (is_relief) {
                relief_texture = level.texture;
            }
        }
        pack.levels.push_back(std::move(level));
    }
    if (relief_texture) {
        pack.relief = std::move(atlas);
    }
}

} // namespace

std::vector<std::size_t> measured_front(const std::vector<PackLevel>& levels) {
    constexpr std::size_t few_triangles = 1500; // fewer triangles do not make a frame cheaper
    std::vector<std::size_t> order(levels.size());
    std::iota(order.begin(), order.end(), 0);
    const auto rank = [&](std::size_t k) {
        const std::size_t triangles = levels[k].indices.size() / 3;
        return std::tuple(std::max(triangles, few_triangles), levels[k].error.mean_box, triangles);
    };
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });
    std::vector<std::size_t> front;
    for (const std::size_t k : order) {
        if (front.empty() || betters(levels[k].error, levels[front.back()].error)) {
            front.push_back(k);
        }
    }
    return front;
}

BakedProp baked_frustum() {
    return {"frustum", make_frustum({}), {}};
}

BakedProp baked_cube() {
    return {"cube", make_cube(FrustumSize{}.base_m), ViewingZone::all_around()};
}

std::uintmax_t room_for_pack(int size) {
    constexpr std::uintmax_t triangles_bytes = 20'000'000;
    constexpr std::uintmax_t bytes_each_square = 200; // of all levels and the relief
    constexpr std::uintmax_t most_bytes = std::uintmax_t{2} << 30;
    const auto edge = static_cast<std::uintmax_t>(size);
    return std::min(most_bytes, triangles_bytes + bytes_each_square * edge * edge);
}

Result<Pack> bake(const SourceMesh& mesh, const BakeOptions& options) {
    const std::string up = options.up.empty() ? std::string(1, mesh.default_up) : options.up;
    const Result<BoxFrame> frame = make_box_frame(mesh, {up, options.turn_deg, options.lift});
    if (!frame) {
        return tl::unexpected<Error>(frame.error());
    }
    options.progress("reading the surface", 0.0);
    Bakery bakery(mesh, *frame, options);
    if (!bakery.has_surface()) {
        return bad_input("every triangle is degenerate; there is no surface to show");
    }
    std::vector<Candidate> candidates = bakery.mesh_levels();
    ReliefAtlas atlas;
    for (Candidate& candidate : bakery.relief_levels(atlas)) {
        candidates.push_back(std::move(candidate));
    }
    Pack pack;
    pack.prop_kind = options.prop.kind;
    pack.unlit = options.unlit;
    pack.relief_size = options.size;
    pack.box_size = frame->box_size;
    pack.box_from_file = frame->box_from_file;
    pack.scale = options.scale;
    pack.provenance.source_triangles = mesh.triangles.size();
    std::vector<glm::dvec3> used;
    for (const auto& triangle : mesh.triangles) {
        for (const std::uint32_t vertex : triangle) {
            used.push_back(bakery.points()[vertex]);
        }
    }
    if (frame->lift_box > 0.0) {
        used.emplace_back(0.0); // the box's bottom, above which the artifact stands
    }
    pack.extremes = profile_extremes(used);
    keep(pack, candidates, atlas);
    options.progress("choice of the level", 0.98);
    pack.samples =
        samples_needed(bakery.source(), pack.box_size, mm_per_box(pack, options.prop), options.prop.zone);
    pack.default_level = choose_default(pack, bakery, options.prop);
    options.progress("done", 1.0);
    return pack;
}

} // namespace frustumscreen
