#include "assets_baked/bake/measured_reliefs.h"

#include "assets_baked/bake/block_relief.h"
#include "assets_baked/bake/relief_scene.h"

#include <algorithm>

namespace frustumscreen::bake {

namespace {

/// The texture, whose texels are a `size`th of the box, reduced to about the relief's texels, so that no
/// texel is skipped.
image::Image8 mip_for(const image::Image8& texture, int size, int texels) {
    image::Image8 mip = texture;
    for (int each = size; each >= 2 * texels; each /= 2) {
        mip = image::half_size(mip);
    }
    return mip;
}

} // namespace

std::vector<int> relief_texels(int size, bool far) {
    const int coarsest = far && size >= 96 ? 24 : 96;
    std::vector<int> texels;
    for (int each = std::min(coarsest, size); each <= size; each *= 2) {
        texels.push_back(each);
    }
    return texels;
}

std::vector<pack::MeasuredRelief> bake_reliefs(const ReliefSource& source, int size) {
    std::vector<pack::MeasuredRelief> reliefs;
    const auto work = [](double texels) { return texels * texels; };
    double all = 0.0;
    for (const int texels : relief_texels(size, source.far)) {
        all += work(texels);
    }
    double done = 0.0;
    for (const int texels : relief_texels(size, source.far)) {
        source.progress(done / all);
        done += work(texels);
        const image::Image8 texture = mip_for(source.texture, size, texels);
        const SourceMesh mesh = textured_source(source.finest, texture, source.box_size);
        const SourceScene scene(mesh, mesh.positions, Sides::Front);
        pack::MeasuredRelief made{bake_blocks({.surface = scene,
                                               .box_size = source.box_size,
                                               .directions = source.directions,
                                               .texels = texels}),
                                  {}};
        if (made.relief.blocks.empty()) {
            continue;
        }
        const ReliefScene drawn(made.relief);
        made.error = seen_distances(
            drawn.scene(),
            [&](const glm::vec3& eye, const glm::vec3& direction) { return drawn.trace(eye, direction); },
            source.truth, source.box_size, source.zone, source.samples.share);
        made.error.colour_rmse = source.compare_colour ? drawn.colour_rmse(source.samples) : 0.0F;
        reliefs.push_back(std::move(made));
    }
    return reliefs;
}

} // namespace frustumscreen::bake
