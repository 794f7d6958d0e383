#include "app/bench/room/room_set.h"

#include "app/bench/techniques/level_of_detail.h"
#include "app/pack/pack_relief.h"
#include "app/scene/scene_level.h"
#include "assets_baked/bake/level.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace frustumscreen::bench {

namespace {

/// For pictures of meshes, of reliefs, and of both.
scene::RenderNeeds needs_of(int samples) {
    scene::RenderNeeds needs{
        .samples = samples, .draws = {scene::ShaderKey{}, scene::raster_shader()}, .rasterizes = true};
    needs.draws.insert({.cut_out = true});
    needs.interlocks = true;
    return needs;
}

/// Half of the triangles of the next finer one, and one of `polygons`.
std::vector<std::size_t> targets_of(std::size_t triangles, std::size_t least, std::size_t polygons) {
    std::vector<std::size_t> targets;
    for (std::size_t target = triangles / 2; target >= least; target /= 2) {
        targets.push_back(target);
    }
    if (polygons < triangles) {
        std::erase_if(targets, [polygons](std::size_t target) {
            return target > polygons * 3 / 4 && target < polygons * 4 / 3;
        });
        targets.push_back(polygons);
    }
    return targets;
}

/// A simplified mesh as a level of a pack; its texture is the source's own.
pack::PackLevel as_level(const bake::SourceMesh& mesh, const glm::dmat4& box_from_file,
                         const glm::dvec3& box_size) {
    bake::ChartedMesh charted;
    charted.atlas_width = charted.atlas_height = 1;
    charted.uv_texels = mesh.uvs;
    for (const glm::dvec3& position : mesh.positions) {
        charted.positions.emplace_back(box_from_file * glm::dvec4(position, 1.0));
    }
    for (const auto& [a, b, c] : mesh.triangles) {
        charted.indices.insert(charted.indices.end(), {a, b, c});
    }
    return bake::make_level(charted, box_size);
}

image::Image8 at_most(image::Image8 texture, int side) {
    while (texture.width > side) {
        texture = image::half_size(texture);
    }
    return texture;
}

} // namespace

RoomSet::RoomSet(const settings::Settings& settings, room::Room room, std::vector<RoomSource> sources,
                 int samples)
    : settings_(settings), room_(std::move(room)), sources_(std::move(sources)),
      screen_(scene::flat_screen(settings.screen.corners_m, settings.screen.width, settings.screen.height)),
      samples_(samples) {}

Result<std::unique_ptr<RoomSet>> RoomSet::open(const settings::Settings& settings, room::Room room,
                                               std::vector<RoomSource> sources,
                                               const RoomSetOptions& options) {
    std::unique_ptr<RoomSet> made(
        new RoomSet(settings, std::move(room), std::move(sources), options.samples));
    const settings::ScreenSettings& screen = settings.screen;
    TRY(made->display_, display::SurfacelessDisplay::create(screen.width, screen.height));
    TRY(made->renderer_, render::Renderer::create(screen.width, screen.height, needs_of(options.samples)));
    for (const RoomSource& source : made->sources_) {
        TRY_VOID(made->add_ways(source, options));
    }
    return made;
}

Result<void> RoomSet::add_ways(const RoomSource& source, const RoomSetOptions& options) {
    TRY(const pack::VerifiedPack read, pack::load_pack(source.pack));
    const pack::Pack& pack = *read;
    RoomWays ways{.box_size = pack.box_size,
                  .source_triangles = source.mesh->triangles.size(),
                  .is_shell = source.use == PieceUse::Floor || source.use == PieceUse::Wall,
                  .meshes = {},
                  .reliefs = {},
                  .lods = {}};
    render::GpuStore& store = renderer_->store();
    for (std::uint32_t level = 0; level < pack.levels.size(); ++level) {
        const scene::SceneLevel whole = scene::whole_level(pack, level);
        TRY(const scene::Drawable drawable, store.upload(whole, pack.textures[whole.mesh.texture]));
        ways.meshes.push_back({.placed = scene::placed(pack, level, 1.0, drawable),
                               .error_box = static_cast<double>(pack.levels[level].error.mean_box),
                               .polygons = whole.mesh.indices.size() / 3,
                               .texel_box = 0.0});
    }
    TRY(const std::vector<pack::ReliefOutline> reliefs, pack::reliefs_of(pack));
    for (const pack::ReliefOutline& each : reliefs) {
        TRY(relief::BlockRelief relief, pack::relief_of(pack, each));
        const auto shared = std::make_shared<const relief::BlockRelief>(std::move(relief));
        ways.reliefs.push_back({.placed = scene::placed(pack, shared, 1.0, store.keep(shared)),
                                .error_box = static_cast<double>(each.error.mean_box),
                                .polygons = 0,
                                .texel_box = 1.0 / each.texels});
    }
    TRY_VOID(add_lods(pack, source, options, ways));
    for (std::vector<RoomWay>* const list : {&ways.meshes, &ways.reliefs, &ways.lods}) {
        for (RoomWay& way : *list) {
            way.placed.samples = samples_;
        }
    }
    ways_.push_back(std::move(ways));
    box_from_file_.push_back(pack.box_from_file);
    return {};
}

Result<void> RoomSet::add_lods(const pack::Pack& pack, const RoomSource& source,
                               const RoomSetOptions& options, RoomWays& ways) {
    constexpr int texture_side = 1024; // enough for an object on a screen
    const std::size_t triangles = source.mesh->triangles.size();
    std::vector<LevelOfDetail> levels = levels_of_detail(
        *source.mesh, targets_of(triangles, options.min_lod_triangles, options.polygons_each));
    levels.push_back({triangles, *source.mesh, 0.0});
    const double box_per_unit = std::cbrt(std::abs(glm::determinant(glm::dmat3(pack.box_from_file))));
    pack::Pack as_pack;
    as_pack.box_size = pack.box_size;
    as_pack.textures = {at_most(*source.mesh->textures.front().image, texture_side)};
    for (const LevelOfDetail& level : levels) {
        as_pack.levels.push_back(as_level(level.mesh, pack.box_from_file, pack.box_size));
    }
    render::GpuStore& store = renderer_->store();
    scene::TextureId texture = scene::TextureId::None;
    for (std::uint32_t level = 0; level < as_pack.levels.size(); ++level) {
        const scene::SceneLevel whole = scene::whole_level(as_pack, level);
        TRY(scene::Drawable drawable, store.upload(whole, as_pack.textures.front()));
        if (texture == scene::TextureId::None) {
            texture = drawable.material.texture;
        } else { // all share one
            store.release(std::exchange(drawable.material.texture, texture));
        }
        ways.lods.push_back({.placed = scene::placed(as_pack, level, 1.0, drawable),
                             .error_box = levels[level].error * box_per_unit,
                             .polygons = whole.mesh.indices.size() / 3,
                             .texel_box = 0.0});
    }
    return {};
}

std::size_t RoomSet::source_triangles() const {
    std::size_t sum = 0;
    for (const room::Object& object : room_.objects) {
        sum += ways_of(object).source_triangles;
    }
    return sum;
}

} // namespace frustumscreen::bench
