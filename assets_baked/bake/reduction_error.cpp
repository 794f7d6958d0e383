#include "assets_baked/bake/reduction_error.h"

namespace frustumscreen {

LevelError reduction_error(const SourceMesh& mesh, const BoxFrame& frame) {
    if (!mesh.reduced_from) {
        return {};
    }
    const auto in_box = [&](double distance) {
        return static_cast<float>(distance / frame.file_units_per_box);
    };
    return {in_box(mesh.reduced_from->mean), in_box(mesh.reduced_from->p95), in_box(mesh.reduced_from->max),
            0.0F};
}

void add_reduction(const LevelError& reduction, LevelError& error) {
    error.mean_box += reduction.mean_box;
    error.p95_box += reduction.p95_box;
    error.max_box += reduction.max_box;
}

void add_reduction(const LevelError& reduction, SeenErrors& seen) {
    for (std::vector<std::vector<SeenError>>* each : {&seen.levels, &seen.reliefs}) {
        for (std::vector<SeenError>& eyes : *each) {
            for (SeenError& error : eyes) {
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

} // namespace frustumscreen
