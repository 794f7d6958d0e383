#include "assets_baked/bake/level_bakery.h"

#include "assets_baked/bake/reduction_error.h"
#include "assets_baked/bake/seen_region.h"
#include "assets_baked/bake/simplify.h"
#include "assets_baked/bake/visibility.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>

namespace frustumscreen::bake {

namespace {

/// Simplification tolerances, box units: 1e-4 is 10 um on an artifact 0.1 m long. The finest level is the
/// source itself unless that is too large. (A tolerance near zero would not give it: the library's 32-bit
/// errors are meaningless below about 3e-4, and its result strays by that much.)
constexpr std::size_t max_finest_triangles = 600'000;
constexpr float finest_tolerance = 5e-5F;
constexpr std::array<float, 8> mesh_tolerances{1e-4F, 2.2e-4F, 3.6e-4F, 5.5e-4F, 9e-4F, 2e-3F, 4e-3F, 8e-3F};
constexpr std::size_t tolerances_of_whole = 6; ///< the others are for regions of sites

/// All of them, but for that from below where no visitor looks from.
std::vector<pack::ReliefDirection> directions_of(const ViewingZone& zone) {
    using enum pack::ReliefDirection;
    std::vector<pack::ReliefDirection> directions{PlusX, MinusX, PlusY, MinusY, PlusZ};
    if (zone.lowest_elevation_deg < 0.0) {
        directions.push_back(MinusZ);
    }
    return directions;
}

/// Largest distance of a surface from the source for looking up its colours.
float reach_of(float tolerance_box) {
    return 4.0F * tolerance_box + 1e-3F;
}

/// Charts surfaces, which are ordered from fine to coarse. A texel is looked up within the reach of the next coarser surface.
std::vector<ChartedMesh> charted(const std::vector<Surface>& surfaces, float texel_box, int max_size) {
    SharedCharts charts(texel_box, max_size);
    for (auto surface = surfaces.rbegin(); surface != surfaces.rend(); ++surface) {
        const auto coarser = surface == surfaces.rbegin() ? surface : std::prev(surface);
        charts.add(surface->mesh, reach_of(coarser->tolerance_box));
    }
    std::vector<ChartedMesh> laid_out = charts.lay_out();
    std::reverse(laid_out.begin(), laid_out.end());
    return laid_out;
}

void multiply(image::ImageFloat& colour, const image::ImageFloat& light) {
    for (std::size_t k = 0; k < colour.texels.size(); ++k) {
        colour.texels[k] *= light.texels[k];
    }
}

} // namespace

void begin_stage(const BakeOptions& options, const BakeStage& stage) {
    options.progress(stage.name, stage.begin);
}

LevelBakery::LevelBakery(const SourceMesh& mesh, const BoxFrame& frame, const BakeOptions& options,
                         std::span<const CurtainTriangle> curtains)
    : options_(options), curtains_(curtains), frame_(frame), points_(in_box(mesh, frame)),
      source_(mesh, points_), normals_(mesh, frame), welded_(weld(mesh, points_)),
      texel_box_(1.0F / static_cast<float>(options.size)), reduction_(reduction_error(mesh, frame)) {}

pack::SeenErrors LevelBakery::seen_in_region(const pack::Pack& pack) const {
    const SourceMesh curtains = curtain_mesh();
    return seen_region_errors(pack, source_, SourceScene(curtains, curtains.positions), options_.prop.zone,
                              options_.measuring);
}

std::vector<Surface> LevelBakery::surfaces() {
    finest_ = welded_.triangle_count() > max_finest_triangles ? simplify(welded_, finest_tolerance) : welded_;
    begin_stage(options_, stages::seen);
    visible_ = seen_sides(finest_);
    if (visible_.indices.empty()) {
        visible_ = finest_; // no part is visible from the zone: a sheet flat on the table
    }
    samples_ = sample_source(source_, visible_, 5.0F * finest_tolerance, options_.measuring);
    std::vector<Surface> surfaces{measured(visible_, finest_tolerance)};
    add_simplified(surfaces);
    return surfaces;
}

/// Adds the surfaces that are coarser than the finest one.
void LevelBakery::add_simplified(std::vector<Surface>& surfaces) const {
    const SourceMesh seen_mesh = as_source(visible_);
    const std::vector<glm::dvec3> seen_points(visible_.positions.begin(), visible_.positions.end());
    const SourceScene seen(seen_mesh, seen_points);
    const Borders borders = options_.of_site ? Borders::Stay : Borders::Move;
    const std::size_t tolerances = options_.of_site ? mesh_tolerances.size() : tolerances_of_whole;
    std::size_t last = finest_.triangle_count();
    for (std::size_t k = 0; k < tolerances; ++k) {
        const double share = static_cast<double>(k) / static_cast<double>(tolerances);
        options_.progress(stages::levels.name, std::lerp(stages::levels.begin, stages::colours.begin, share));
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
}

TexturedLevels LevelBakery::mesh_levels(const std::vector<Surface>& surfaces) const {
    begin_stage(options_, stages::colours);
    const std::vector<ChartedMesh> meshes = charted(surfaces, texel_box_, 4 * options_.size);
    // A texel shows the finest surface that contains it.
    const ChartedMesh all = joined(meshes);
    const image::Image<AtlasTexel> texels = rasterise(all);
    const float reach = reach_of(surfaces.front().tolerance_box);
    image::ImageFloat colour = bake_colour(all, texels, source_, reach);
    const image::Image<float> coverage = bake_coverage(all, texels, source_, reach);
    std::vector<LayerColour> layers = layer_colours_of(all, texels, reach);
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
        pack::PackLevel level = make_level(meshes[k], frame_.box_size);
        level.error = surfaces[k].error;
        if (options_.unlit) {
            level.error.colour_rmse = measure_colour(level, made.texture, frame_.box_size, samples_);
        }
        made.levels.push_back(std::move(level));
    }
    return made;
}

ReliefSource LevelBakery::relief_source(const TexturedLevels& meshes) const {
    const auto progress = [this](double done) {
        options_.progress(stages::relief.name, std::lerp(stages::relief.begin, stages::choice.begin, done));
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

std::vector<pack::MeasuredRelief> LevelBakery::reliefs(const TexturedLevels& meshes) const {
    std::vector<pack::MeasuredRelief> made = bake_reliefs(relief_source(meshes), options_.size);
    for (pack::MeasuredRelief& relief : made) {
        add_reduction(reduction_, relief.error);
    }
    return made;
}

SourceMesh LevelBakery::curtain_mesh() const {
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
TriangleMesh LevelBakery::seen_sides(const TriangleMesh& mesh) const {
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
    return visible_region_sides(mesh, scene, SourceScene(curtains, curtains.positions), options_.prop.zone);
}

Surface LevelBakery::measured(const TriangleMesh& mesh, float tolerance_box) const {
    Surface surface{on_codes(mesh, frame_.box_size), tolerance_box, {}};
    surface.error = measure_shape(surface.mesh, source_, samples_);
    add_reduction(reduction_, surface.error);
    return surface;
}

std::vector<LayerColour> LevelBakery::layer_colours_of(const ChartedMesh& mesh,
                                                       const image::Image<AtlasTexel>& texels,
                                                       float reach) const {
    std::vector<LayerColour> layers;
    for (const SourceLayer& layer : source_.mesh().layers) {
        layers.push_back(bake_layer(mesh, texels, source_, layer, reach));
    }
    return layers;
}

/// Puts the colours into the museum's light.
void LevelBakery::light(const ChartedMesh& mesh, const image::Image<AtlasTexel>& texels, float reach,
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

} // namespace frustumscreen::bake
