#include "assets_baked/bake/reduction_error.h"

namespace frustumscreen::bake {

pack::LevelError reduction_error(const SourceMesh& mesh, const BoxFrame& frame) {
    if (!mesh.reduced_from) {
        return {};
    }
    const auto in_box = [&](double distance) {
        return static_cast<float>(distance / frame.file_units_per_box);
    };
    return {.mean_box = in_box(mesh.reduced_from->mean),
            .p95_box = in_box(mesh.reduced_from->p95),
            .max_box = in_box(mesh.reduced_from->max),
            .colour_rmse = 0.0F};
}

void add_reduction(const pack::LevelError& reduction, pack::LevelError& error) {
    error.mean_box += reduction.mean_box;
    error.p95_box += reduction.p95_box;
    error.max_box += reduction.max_box;
}

void add_reduction(const pack::LevelError& reduction, pack::SeenErrors& seen) {
    for (std::vector<std::vector<pack::SeenError>>* each : {&seen.levels, &seen.reliefs}) {
        for (std::vector<pack::SeenError>& eyes : *each) {
            for (pack::SeenError& error : eyes) {
                error.mean_box += reduction.mean_box;
                error.p95_box += reduction.p95_box;
                error.outline_shift_box += reduction.mean_box;
                for (float& patch : error.patches_box) {
                    patch += reduction.mean_box;
                }
            }
        }
    }
}

} // namespace frustumscreen::bake
