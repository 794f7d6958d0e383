#include "assets_baked/bake/bake.h"

#include "app/geometry/convex_hull.h"
#include "app/pack/pack_file.h"
#include "app/pack/pack_hull.h"
#include "assets_baked/bake/bake_region.h"
#include "assets_baked/bake/box_frame.h"
#include "assets_baked/bake/layer_parts.h"
#include "assets_baked/bake/level.h"
#include "assets_baked/bake/level_bakery.h"
#include "assets_baked/bake/level_choice.h"
#include "assets_baked/bake/reduction_error.h"
#include "assets_baked/bake/table_picture.h"

#include <span>
#include <utility>

namespace frustumscreen::bake {

namespace {

double mm_per_box(const pack::Pack& pack, const BakedProp& prop) {
    return pack::place(pack, prop.shape).metres_per_box * 1e3;
}

Result<void> put_hotspots(pack::Pack& pack, const BakeOptions& options, const SourceScene& source,
                          const BoxFrame& frame) {
    for (const GivenHotspot& given : options.hotspots) {
        TRY(pack::PackHotspot hotspot, put_on_surface(given, source, frame, options.prop.zone));
        pack.hotspots.push_back(std::move(hotspot));
    }
    return {};
}

void describe(pack::Pack& pack, const SourceMesh& mesh, const BoxFrame& frame, const BakeOptions& options) {
    pack.prop_kind = options.prop.kind;
    pack.unlit = options.unlit;
    pack.relief_size = options.size;
    pack.box_size = frame.box_size;
    pack.box_from_file = frame.box_from_file;
    pack.scale = options.scale;
    pack.provenance.source_triangles =
        mesh.reduced_from ? mesh.reduced_from->triangles : mesh.triangles.size();
}

/// The hull and the profile of the corners that triangles use.
void put_extent(pack::Pack& pack, const SourceMesh& mesh, const std::vector<glm::dvec3>& points,
                const BoxFrame& frame) {
    std::vector<glm::dvec3> used;
    for (const auto& triangle : mesh.triangles) {
        for (const std::uint32_t vertex : triangle) {
            used.push_back(points[vertex]);
        }
    }
    pack::put_hull(geometry::enclosing_corners(used, pack::max_hull_corners), pack);
    if (frame.lift_box > 0.0) {
        used.emplace_back(0.0); // the bottom of the box, above which the artifact stands
    }
    pack.extremes = profile_extremes(used);
}

/// Measures the kept levels as visitors see them, and chooses the one that a picture begins with.
void choose_level(pack::Pack& pack, const LevelBakery& bakery, std::span<const pack::MeasuredRelief> reliefs,
                  const BakeOptions& options) {
    const double mm = mm_per_box(pack, options.prop);
    pack.samples = samples_needed(bakery.source(), pack.box_size, mm, options.prop.zone, options.measuring);
    pack::SeenErrors seen =
        options.of_site ? bakery.seen_in_region(pack)
                        : seen_errors(pack, reliefs, bakery.source(), options.prop.zone, options.measuring);
    add_reduction(bakery.reduction(), seen);
    pack::put_seen_errors(seen, pack);
    pack.default_level = choose_default(pack, seen, mm);
}

} // namespace

Result<pack::Pack> bake(const SourceMesh& mesh, const BakeOptions& options) {
    return bake_region(mesh, options, {});
}

Result<pack::Pack> bake_region(const SourceMesh& mesh, const BakeOptions& options,
                               std::span<const CurtainTriangle> curtains) {
    const std::string up = options.up.empty() ? std::string(1, mesh.default_up) : options.up;
    TRY(const BoxFrame frame, make_box_frame(mesh, {up, options.turn_deg, options.lift}));
    begin_stage(options, stages::surface);
    LevelBakery bakery(mesh, frame, options, curtains);
    TRY_VOID(bakery.check());
    pack::Pack pack;
    TRY_VOID(put_hotspots(pack, options, bakery.source(), frame));
    std::vector<Surface> surfaces = bakery.surfaces();
    constexpr float of_region = 5.0F; // a region is a quarter of its site, or less
    const float worst_mean = options.of_site ? of_region * worst_mean_box : worst_mean_box;
    keep_front(surfaces, worst_mean);
    TexturedLevels meshes = bakery.mesh_levels(surfaces);
    const std::vector<pack::MeasuredRelief> cast =
        options.relief ? bakery.reliefs(meshes) : std::vector<pack::MeasuredRelief>{};
    pack::put_reliefs(pack, cast);
    TRY_VOID(put_torches(pack, meshes.layers, bakery.relief_source(meshes), cast, options));
    describe(pack, mesh, frame, options);
    put_extent(pack, mesh, bakery.points(), frame);
    keep(pack, std::move(meshes), worst_mean);
    begin_stage(options, stages::choice);
    choose_level(pack, bakery, cast, options);
    if (options.table_picture) {
        pack.table_picture = make_table_picture(pack);
    }
    options.progress("done", 1.0);
    return pack;
}

} // namespace frustumscreen::bake
