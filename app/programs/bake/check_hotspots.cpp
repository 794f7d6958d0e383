#include "app/programs/bake/check_hotspots.h"

#include "assets_baked/bake/box_frame.h"
#include "assets_baked/bake/hotspots.h"
#include "assets_baked/bake/source_scene.h"

namespace frustumscreen::programs {

Result<void> check_hotspots(const bake::SourceMesh& mesh, const bake::BakeOptions& options) {
    if (options.hotspots.empty()) {
        return {};
    }
    const std::string up = options.up.empty() ? std::string(1, mesh.default_up) : options.up;
    const Result<bake::BoxFrame> frame = bake::make_box_frame(mesh, {up, options.turn_deg, options.lift});
    if (!frame) {
        return {}; // the bake reports the scan's error
    }
    const std::vector<glm::dvec3> points = bake::in_box(mesh, *frame);
    const bake::SourceScene scene(mesh, points);
    for (const bake::GivenHotspot& given : options.hotspots) {
        TRY_VOID(without_value(bake::put_on_surface(given, scene, *frame, options.prop.zone)));
    }
    return {};
}

} // namespace frustumscreen::programs
