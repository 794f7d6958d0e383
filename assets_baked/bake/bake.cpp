#include "assets_baked/bake/bake.h"

#include "app/geometry/convex_hull.h"
#include "app/pack/pack_file.h"
#include "app/pack/pack_hull.h"
#include "assets_baked/bake/bake_region.h"
#include "assets_baked/bake/box_frame.h"
#include "assets_baked/bake/file_normals.h"
#include "assets_baked/bake/layer_parts.h"
#include "assets_baked/bake/level.h"
#include "assets_baked/bake/measured_reliefs.h"
#include "assets_baked/bake/reduction_error.h"
#include "assets_baked/bake/seen_region.h"
#include "assets_baked/bake/simplify.h"
#include "assets_baked/bake/table_picture.h"
#include "assets_baked/bake/texture_bake.h"
#include "assets_baked/bake/triangle_mesh.h"
#include "assets_baked/bake/visibility.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>

namespace frustumscreen::bake {

namespace {

/// Simplification tolerances, box units: 1e-4 is 10 um on an artifact 0.1 m long. The finest level is the
/// source itself unless that is too large. (A tolerance near zero would not give it: the library's 32-bit
/// errors are meaningless below about 3e-4, and its result strays by that much.)
constexpr std::size_t max_finest_triangles = 600'000;
constexpr float finest_tolerance = 5e-5F;
constexpr std::array<float, 8> mesh_tolerances{1e-4F, 2.2e-4F, 3.6e-4F, 5.5e-4F, 9e-4F, 2e-3F, 4e-3F, 8e-3F};
constexpr std::size_t tolerances_of_whole = 6; ///< the others are for regions of sites

void begin_stage(const BakeOptions& options, const BakeStage& stage) {
    options.progress(stage.name, stage.begin);
}

/// All of them, but for that from below where no visitor looks from.
std::vector<pack::ReliefDirection> directions_of(const ViewingZone& zone) {
    using enum pack::ReliefDirection;
    std::vector<pack::ReliefDirection> directions{PlusX, MinusX, PlusY, MinusY, PlusZ};
    if (zone.lowest_elevation_deg < 0.0) {
        directions.push_back(MinusZ);
    }
    return directions;
}

/// Simplified triangles that become a level.
struct Surface {
    TriangleMesh mesh;
    float tolerance_box = 0.0F;
    pack::LevelError error;
};

/// Levels that share a texture; `PackLevel::texture` is left at 0.
struct TexturedLevels {
    std::vector<pack::PackLevel> levels;
    image::Image8 texture;
    std::vector<image::Image8> layers; ///< of the mesh, in place of the texture
};

/// The input of the levels, for making and measuring them.
class Bakery {
public:
    Bakery(const SourceMesh& mesh, const BoxFrame& frame, const BakeOptions& options,
           std::span<const CurtainTriangle> curtains)
        : options_(options), curtains_(curtains), frame_(frame), points_(in_box(mesh, frame)),
          source_(mesh, points_), normals_(mesh, frame), welded_(weld(mesh, points_)),
          texel_box_(1.0F / static_cast<float>(options.size)), reduction_(reduction_error(mesh, frame)) {}

    [[nodiscard]] Result<void> check() const { return check_surface(welded_); }
    [[nodiscard]] const std::vector<glm::dvec3>& points() const { return points_; }
    [[nodiscard]] const SourceScene& source() const { return source_; }
    /// The errors that are seen of a region of a site.
    [[nodiscard]] pack::SeenErrors seen_in_region(const pack::Pack& pack) const {
        const SourceMesh curtains = curtain_mesh();
        return seen_region_errors(pack, source_, SourceScene(curtains, curtains.positions),
                                  options_.prop.zone, options_.measuring);
    }
    [[nodiscard]] const pack::LevelError& reduction() const { return reduction_; }

    /// From fine to coarse.
    std::vector<Surface> surfaces() {
        finest_ =
            welded_.triangle_count() > max_finest_triangles ? simplify(welded_, finest_tolerance) : welded_;
        begin_stage(options_, stages::seen);
        visible_ = seen_sides(finest_);
        if (visible_.indices.empty()) {
            visible_ = finest_; // no part is visible from the zone: a sheet flat on the table
        }
        samples_ = sample_source(source_, visible_, 5.0F * finest_tolerance, options_.measuring);
        std::vector<Surface> surfaces{measured(visible_, finest_tolerance)};
        const SourceMesh seen_mesh = as_source(visible_);
        const std::vector<glm::dvec3> seen_points(visible_.positions.begin(), visible_.positions.end());
        const SourceScene seen(seen_mesh, seen_points);
        std::size_t last = finest_.triangle_count();
        const std::size_t tolerances = options_.of_site ? mesh_tolerances.size() : tolerances_of_whole;
        for (std::size_t k = 0; k < tolerances; ++k) {
            const double share = static_cast<double>(k) / static_cast<double>(tolerances);
            options_.progress(stages::levels.name,
                              std::lerp(stages::levels.begin, stages::colours.begin, share));
            const Borders borders = options_.of_site ? Borders::Stay : Borders::Move;
            const TriangleMesh fewer = simplify(finest_, mesh_tolerances[k], borders);
            if (fewer.triangle_count() * 20 > last * 19) {
                continue; // less than 5 % fewer than the last: not worth a level
            }
            last = fewer.triangle_count();
            const TriangleMesh sides = visible_sides_like(fewer, visible_, seen, mesh_tolerances[k]);
            if (!sides.indices.empty()) {
                surfaces.push_back(measured(sides, mesh_tolerances[k]));
            }
        }
        return surfaces;
    }

    /// `surfaces` from fine to coarse.
    TexturedLevels mesh_levels(const std::vector<Surface>& surfaces) {
        begin_stage(options_, stages::colours);
        SharedCharts charts(texel_box_, 4 * options_.size);
        for (auto surface = surfaces.rbegin(); surface != surfaces.rend(); ++surface) {
            const auto coarser = surface == surfaces.rbegin() ? surface : std::prev(surface);
            charts.add(surface->mesh, reach_of(coarser->tolerance_box));
        }
        std::vector<ChartedMesh> charted = charts.lay_out();
        std::reverse(charted.begin(), charted.end());
        // A texel shows the finest surface that contains it.
        const ChartedMesh all = joined(charted);
        const image::Image<AtlasTexel> texels = rasterise(all);
        const float reach = reach_of(surfaces.front().tolerance_box);
        image::ImageFloat colour = bake_colour(all, texels, source_, reach);
        const image::Image<float> coverage = bake_coverage(all, texels, source_, reach);
        std::vector<LayerColour> layers;
        for (const SourceLayer& layer : source_.mesh().layers) {
            layers.push_back(bake_layer(all, texels, source_, layer, reach));
        }
        light(all, texels, reach, colour, layers);
        for (std::size_t k = 0; k < layers.size(); ++k) {
            if (source_.mesh().layers[k].covers) {
                cover(layers[k], colour, coverage, texels);
            }
        }
        TexturedLevels made{{}, finish(colour, texels, coverage), {}};
        for (const LayerColour& layer : layers) {
            made.layers.push_back(finish_layer(layer, texels));
        }
        for (std::size_t k = 0; k < surfaces.size(); ++k) {
            pack::PackLevel level = make_level(charted[k], frame_.box_size);
            level.error = surfaces[k].error;
            if (options_.unlit) {
                level.error.colour_rmse = measure_colour(level, made.texture, frame_.box_size, samples_);
            }
            made.levels.push_back(std::move(level));
        }
        return made;
    }

    /// For the reliefs; `meshes` must outlive it.
    [[nodiscard]] ReliefSource relief_source(const TexturedLevels& meshes) const {
        const auto progress = [this](double done) {
            options_.progress(stages::relief.name,
                              std::lerp(stages::relief.begin, stages::choice.begin, done));
        };
        return {.finest = meshes.levels.front(),
                .texture = meshes.texture,
                .box_size = frame_.box_size,
                .directions = directions_of(options_.prop.zone),
                .truth = source_,
                .samples = samples_,
                .zone = options_.prop.zone,
                .compare_colour = options_.unlit,
                .far = options_.far,
                .progress = progress};
    }

    /// The pack's reliefs, in addition to the levels.
    [[nodiscard]] std::vector<pack::MeasuredRelief> reliefs(const TexturedLevels& meshes) const {
        std::vector<pack::MeasuredRelief> made = bake_reliefs(relief_source(meshes), options_.size);
        for (pack::MeasuredRelief& relief : made) {
            add_reduction(reduction_, relief.error);
        }
        return made;
    }

private:
    /// In the box.
    [[nodiscard]] SourceMesh curtain_mesh() const {
        SourceMesh mesh = as_source({});
        for (const CurtainTriangle& curtain : curtains_) {
            const auto first = static_cast<std::uint32_t>(mesh.positions.size());
            for (const glm::dvec3& corner : curtain) {
                mesh.positions.emplace_back(frame_.box_from_file * glm::dvec4(corner, 1.0));
            }
            mesh.triangles.push_back({first, first + 1, first + 2});
            mesh.triangle_materials.push_back(0);
        }
        return mesh;
    }

    /// The mesh itself decides what is hidden. If the source did, parts of a simplified surface slightly
    /// outside it would seem visible. Only if alpha cuts holes must the source decide.
    [[nodiscard]] TriangleMesh seen_sides(const TriangleMesh& mesh) const {
        const std::vector<SourceMaterial>& materials = source_.mesh().materials;
        if (std::any_of(materials.begin(), materials.end(),
                        [](const SourceMaterial& material) { return material.alpha_mask; })) {
            return visible_sides(mesh, source_, options_.prop.zone);
        }
        const SourceMesh own = as_source(mesh);
        const SourceScene scene(own, own.positions);
        if (curtains_.empty()) {
            return visible_sides(mesh, scene, options_.prop.zone);
        }
        const SourceMesh curtains = curtain_mesh();
        return visible_region_sides(mesh, scene, SourceScene(curtains, curtains.positions),
                                    options_.prop.zone);
    }

    [[nodiscard]] Surface measured(const TriangleMesh& mesh, float tolerance_box) const {
        Surface surface{on_codes(mesh, frame_.box_size), tolerance_box, {}};
        surface.error = measure_shape(surface.mesh, source_, samples_);
        add_reduction(reduction_, surface.error);
        return surface;
    }

    /// Largest distance of a surface from the source for looking up its colours.
    static float reach_of(float tolerance_box) { return 4.0F * tolerance_box + 1e-3F; }

    /// Puts the colours into the museum's light.
    void light(const ChartedMesh& mesh, const image::Image<AtlasTexel>& texels, float reach,
               image::ImageFloat& colour, std::vector<LayerColour>& layers) const {
        if (options_.unlit) {
            return;
        }
        begin_stage(options_, stages::light);
        const image::ImageFloat light = bake_light(mesh, texels, source_, normals_, reach, options_.part);
        multiply(colour, light);
        for (std::size_t k = 0; k < layers.size(); ++k) {
            if (source_.mesh().layers[k].lit) {
                multiply(layers[k].colour, light);
            }
        }
    }

    static void multiply(image::ImageFloat& colour, const image::ImageFloat& light) {
        for (std::size_t k = 0; k < colour.texels.size(); ++k) {
            colour.texels[k] *= light.texels[k];
        }
    }

    const BakeOptions& options_;
    std::span<const CurtainTriangle> curtains_; ///< of a region; they hide its underside
    const BoxFrame& frame_;
    std::vector<glm::dvec3> points_;
    SourceScene source_;
    FileNormals normals_;
    TriangleMesh welded_;
    float texel_box_;
    pack::LevelError reduction_; ///< of the source itself
    TriangleMesh finest_;
    TriangleMesh visible_;
    SourceSamples samples_;
};

double mm_per_box(const pack::Pack& pack, const BakedProp& prop) {
    return pack::place(pack, prop.shape).metres_per_box * 1e3;
}

/// The first level that is good enough, starting at the finest one of at most `free_triangles`. The start is
/// never the last level, which is for close views and is drawn with more samples.
std::uint32_t choose_default(const pack::Pack& pack, const pack::SeenErrors& seen, const BakedProp& prop) {
    constexpr std::size_t free_triangles = 30'000;
    std::uint32_t level = 0;
    while (level + 2 < pack.levels.size() && pack.levels[level + 1].indices.size() / 3 <= free_triangles) {
        ++level;
    }
    const auto good = [&](std::uint32_t one) {
        return good_enough(pack.levels[one].error, mean_of(seen.levels[one]), mm_per_box(pack, prop));
    };
    while (level + 1 < pack.levels.size() && !good(level)) {
        ++level;
    }
    return level;
}

pack::LevelOutline outline_of(const Surface& surface) {
    return {.technique = pack::LevelTechnique::Mesh,
            .error = surface.error,
            .triangles = surface.mesh.triangle_count(),
            .vertices = 0,
            .texture = 0};
}

/// Keeps the surfaces that are worth a level, from fine to coarse.
void keep_front(std::vector<Surface>& surfaces, float worst_mean) {
    std::vector<pack::LevelOutline> outlines;
    outlines.reserve(surfaces.size());
    for (const Surface& surface : surfaces) {
        outlines.push_back(outline_of(surface));
    }
    std::vector<Surface> kept;
    for (const std::size_t k : measured_front(outlines, worst_mean)) {
        kept.insert(kept.begin(), std::move(surfaces[k]));
    }
    surfaces = std::move(kept);
}

/// True if the mean error is smaller and neither the 95th percentile nor the colour error is clearly larger.
bool betters(const pack::LevelError& dearer, const pack::LevelError& cheaper) {
    constexpr float scatter = 1.1F; // scatter of a measure over random points
    constexpr float min_rmse = 1.0F;
    return dearer.mean_box < cheaper.mean_box && dearer.p95_box < scatter * cheaper.p95_box &&
           dearer.colour_rmse < scatter * cheaper.colour_rmse + min_rmse;
}

/// Moves the levels on the front, and their texture, into the pack.
void keep(pack::Pack& pack, TexturedLevels meshes, float worst_mean) {
    std::vector<pack::LevelOutline> outlines;
    outlines.reserve(meshes.levels.size());
    for (const pack::PackLevel& level : meshes.levels) {
        outlines.push_back({.technique = level.technique,
                            .error = level.error,
                            .triangles = level.indices.size() / 3,
                            .vertices = level.vertices.size(),
                            .texture = 0});
    }
    for (const std::size_t k : measured_front(outlines, worst_mean)) {
        pack.levels.push_back(std::move(meshes.levels[k]));
    }
    pack.textures.push_back(std::move(meshes.texture));
}

} // namespace

std::vector<std::size_t> measured_front(const std::vector<pack::LevelOutline>& levels, float worst_mean) {
    constexpr std::uint64_t few_triangles = 1500; // fewer triangles do not make a frame cheaper
    std::vector<std::size_t> order(levels.size());
    std::iota(order.begin(), order.end(), 0);
    const auto rank = [&](std::size_t k) {
        const pack::LevelOutline& level = levels[k];
        return std::tuple(std::max(level.triangles, few_triangles), level.error.mean_box, level.triangles);
    };
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });
    float nearest = std::numeric_limits<float>::infinity();
    for (const pack::LevelOutline& level : levels) {
        nearest = std::min(nearest, level.error.mean_box);
    }
    std::erase_if(order,
                  [&](std::size_t k) { return levels[k].error.mean_box > std::max(worst_mean, nearest); });
    std::vector<std::size_t> front;
    for (const std::size_t k : order) {
        if (front.empty() || betters(levels[k].error, levels[front.back()].error)) {
            front.push_back(k);
        }
    }
    return front;
}

Result<pack::Pack> bake(const SourceMesh& mesh, const BakeOptions& options) {
    return bake_region(mesh, options, {});
}

Result<pack::Pack> bake_region(const SourceMesh& mesh, const BakeOptions& options,
                               std::span<const CurtainTriangle> curtains) {
    const std::string up = options.up.empty() ? std::string(1, mesh.default_up) : options.up;
    TRY(const BoxFrame frame, make_box_frame(mesh, {up, options.turn_deg, options.lift}));
    begin_stage(options, stages::surface);
    Bakery bakery(mesh, frame, options, curtains);
    TRY_VOID(bakery.check());
    pack::Pack pack;
    for (const GivenHotspot& given : options.hotspots) {
        TRY(pack::PackHotspot hotspot, put_on_surface(given, bakery.source(), frame, options.prop.zone));
        pack.hotspots.push_back(std::move(hotspot));
    }
    std::vector<Surface> surfaces = bakery.surfaces();
    constexpr float of_region = 5.0F; // a region is a quarter of its site, or less
    const float worst_mean = options.of_site ? of_region * worst_mean_box : worst_mean_box;
    keep_front(surfaces, worst_mean);
    TexturedLevels meshes = bakery.mesh_levels(surfaces);
    const std::vector<pack::MeasuredRelief> cast =
        options.relief ? bakery.reliefs(meshes) : std::vector<pack::MeasuredRelief>{};
    pack::put_reliefs(pack, cast);
    TRY_VOID(put_torches(pack, meshes.layers, bakery.relief_source(meshes), cast, options));
    pack.prop_kind = options.prop.kind;
    pack.unlit = options.unlit;
    pack.relief_size = options.size;
    pack.box_size = frame.box_size;
    pack.box_from_file = frame.box_from_file;
    pack.scale = options.scale;
    pack.provenance.source_triangles =
        mesh.reduced_from ? mesh.reduced_from->triangles : mesh.triangles.size();
    std::vector<glm::dvec3> used;
    for (const auto& triangle : mesh.triangles) {
        for (const std::uint32_t vertex : triangle) {
            used.push_back(bakery.points()[vertex]);
        }
    }
    pack::put_hull(geometry::enclosing_corners(used, pack::max_hull_corners), pack);
    if (frame.lift_box > 0.0) {
        used.emplace_back(0.0); // the bottom of the box, above which the artifact stands
    }
    pack.extremes = profile_extremes(used);
    keep(pack, std::move(meshes), worst_mean);
    begin_stage(options, stages::choice);
    pack.samples = samples_needed(bakery.source(), pack.box_size, mm_per_box(pack, options.prop),
                                  options.prop.zone, options.measuring);
    pack::SeenErrors seen =
        options.of_site ? bakery.seen_in_region(pack)
                        : seen_errors(pack, cast, bakery.source(), options.prop.zone, options.measuring);
    add_reduction(bakery.reduction(), seen);
    pack::put_seen_errors(seen, pack);
    pack.default_level = choose_default(pack, seen, options.prop);
    if (options.table_picture) {
        pack.table_picture = make_table_picture(pack);
    }
    options.progress("done", 1.0);
    return pack;
}

} // namespace frustumscreen::bake
