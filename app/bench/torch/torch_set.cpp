#include "app/bench/torch/torch_set.h"

#include "app/pack/pack_relief.h"
#include "app/scene/scene_level.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace frustumscreen::bench {

namespace {

/// Exactly the positions that the vertex shader gets.
std::vector<glm::dvec3> unit_positions_of(const scene::PlacedLevel& placed) {
    const glm::dvec3 low(-0.5 * placed.box_size.x, -0.5 * placed.box_size.y, 0.0);
    std::vector<glm::dvec3> positions;
    positions.reserve(placed.triangles->positions.size());
    for (const glm::vec3& position : placed.triangles->positions) {
        const glm::dvec3 unit = (glm::dvec3(position) - low) / placed.box_size;
        positions.push_back(glm::dvec3(glm::vec3(glm::round(65535.0 * unit) / 65535.0)));
    }
    return positions;
}

/// The coarsest that errs by no more than half a pixel of a usual set-up; else the finest.
const CellWay& way_of(const std::vector<CellWay>& finest_first) {
    constexpr double enough_mm = 0.1;
    const auto coarsest = std::find_if(finest_first.rbegin(), finest_first.rend(),
                                       [](const CellWay& way) { return way.worst_mm <= enough_mm; });
    return coarsest != finest_first.rend() ? *coarsest : finest_first.front();
}

} // namespace

torch::Content white_over() {
    torch::Content content = torch::white();
    content.blend = torch::Blend::Over;
    return content;
}

Result<std::unique_ptr<TorchSet>> TorchSet::open(settings::Settings settings,
                                                 const std::filesystem::path& pack) {
    settings.projector.pinhole = settings.projector.pinhole.ideal();
    std::unique_ptr<TorchSet> made(new TorchSet());
    const torch::Content content = white_over();
    TRY(made->cells_, CellSet::open(settings, pack, 1, torch::parts_of(content.stages, content.blend)));
    const image::Image8 black(1, 1, glm::u8vec4(0, 0, 0, 255));
    TRY(made->black_, made->cells_->renderer().store().upload_picture(std::span(&black, 1)));
    TRY_VOID(made->add_whole(pack));
    made->add_cells();
    return made;
}

scene::PlacedLevel TorchSet::in_black(const scene::PlacedLevel& placed) {
    scene::PlacedLevel black = placed;
    if (placed.relief) {
        relief::BlockRelief relief = *placed.relief;
        std::fill(relief.colours.begin(), relief.colours.end(), glm::u8vec4(0, 0, 0, 255));
        black.relief = std::make_shared<const relief::BlockRelief>(std::move(relief));
        black.drawable = cells_->renderer().store().keep(black.relief);
    } else {
        black.drawable.material.texture = black_;
        black.drawable.material.texels_per_box = 1.0; // of one mip level
    }
    return black;
}

void TorchSet::add_part(TorchSurface& surface, const scene::PlacedLevel& placed) {
    if (placed.triangles && unit_positions_.count(placed.drawable.mesh) == 0) {
        unit_positions_[placed.drawable.mesh] = unit_positions_of(placed);
    }
    surface.parts.push_back({placed, std::nullopt});
    surface.black.push_back({in_black(placed), std::nullopt});
}

void TorchSet::add_scene(std::string name, TorchSurface drawn, TorchSurface polygons) {
    TorchScene scene{.name = std::move(name), .drawn = std::move(drawn), .polygons = std::move(polygons)};
    for (const auto* const surface : {&scene.drawn, &scene.polygons}) {
        std::size_t indices = 0;
        for (const scene::Part& part : surface->parts) {
            indices += part.level.triangles ? part.level.triangles->indices.size() : 0;
        }
        scene.max_indices = std::max(scene.max_indices, indices);
        scene.triangles = indices / 3; // in the end, those of the polygons
    }
    scenes_.push_back(std::move(scene));
}

Result<void> TorchSet::add_whole(const std::filesystem::path& file) {
    TRY(const pack::VerifiedPack pack, pack::load_pack(file));
    TRY(const std::vector<pack::ReliefOutline> reliefs, pack::reliefs_of(*pack));
    if (reliefs.empty()) {
        return bad_input("bench.no_reliefs", "{}: the pack has no reliefs; bake it again", file.string());
    }
    const pack::Placement placement = pack::place(*pack, prop());
    const double metres_per_box = placement.metres_per_box;
    samples_ = pack->samples;
    prop_from_artifact_ = placement.prop_from_artifact;
    render::GpuStore& store = cells_->renderer().store();
    TRY(const scene::Drawable drawable, store.upload(*pack, pack->default_level));
    scene::PlacedLevel mesh = scene::placed(*pack, pack->default_level, metres_per_box, drawable);
    mesh.samples = 1;
    box_ = mesh.placed_box();
    TRY(relief::BlockRelief blocks, pack::relief_of(*pack, reliefs.back()));
    const auto shared = std::make_shared<const relief::BlockRelief>(std::move(blocks));
    scene::PlacedLevel relief = scene::placed(*pack, shared, metres_per_box, store.keep(shared));
    relief.samples = 1;
    TorchSurface polygons;
    TorchSurface cast;
    add_part(polygons, mesh);
    add_part(cast, relief);
    add_scene("mesh", polygons, polygons);
    add_scene("relief", std::move(cast), std::move(polygons));
    return {};
}

/// Every second cell is relief, so that each kind casts shadows onto the other.
void TorchSet::add_cells() {
    TorchSurface drawn;
    TorchSurface polygons;
    const std::vector<CellWays>& cells = cells_->cells();
    for (std::size_t k = 0; k < cells.size(); ++k) {
        const bool relief = k % 2 == 1 && !cells[k].reliefs.empty();
        add_part(drawn, (relief ? cells[k].reliefs.back() : way_of(cells[k].meshes)).placed);
        add_part(polygons, way_of(cells[k].meshes).placed);
    }
    add_scene("cells", std::move(drawn), std::move(polygons));
}

} // namespace frustumscreen::bench
