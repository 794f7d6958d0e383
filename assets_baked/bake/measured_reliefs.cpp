#include "assets_baked/bake/measured_reliefs.h"

#include "assets_baked/bake/block_relief.h"
#include "assets_baked/bake/relief_scene.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

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

/// Blocks of the source's surface with this texture, which is in place of its own.
relief::BlockRelief blocks_with(const ReliefSource& source, const image::Image8& texture, int size,
                                int texels) {
    const image::Image8 mip = mip_for(texture, size, texels);
    const SourceMesh mesh = textured_source(source.finest, mip, source.box_size);
    const SourceScene scene(mesh, mesh.positions, Sides::Front);
    return bake_blocks(
        {.surface = scene, .box_size = source.box_size, .directions = source.directions, .texels = texels});
}

/// The layer's colours, or its alpha as light, with the alpha of the source's texture, which decides what is cut.
image::Image8 with_own_cuts(const image::Image8& layer, const image::Image8& own, bool alpha_as_light) {
    image::Image8 made = layer;
    for (std::size_t k = 0; k < made.texels.size(); ++k) {
        glm::u8vec4& texel = made.texels[k];
        if (alpha_as_light) {
            const std::uint8_t light = image::srgb8_from_linear(texel.w / 255.0);
            texel = {light, light, light, 0};
        }
        texel.w = own.texels[k].w;
    }
    return made;
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
        pack::MeasuredRelief made{blocks_with(source, source.texture, size, texels), {}};
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

std::vector<std::vector<glm::u8vec4>> layer_colours(const ReliefSource& source, const image::Image8& layer,
                                                    int size, std::span<const pack::MeasuredRelief> made) {
    const bool covers_all = std::all_of(layer.texels.begin(), layer.texels.end(),
                                        [](const glm::u8vec4& texel) { return texel.w == 255; });
    const image::Image8 colours = with_own_cuts(layer, source.texture, false);
    const image::Image8 alphas = covers_all ? image::Image8() : with_own_cuts(layer, source.texture, true);
    std::vector<std::vector<glm::u8vec4>> all;
    for (const pack::MeasuredRelief& relief : made) {
        const auto texels = static_cast<int>(std::lround(1.0F / relief.relief.texel_box));
        // The surface alone decides the blocks, so these are those of the relief.
        std::vector<glm::u8vec4> corners = blocks_with(source, colours, size, texels).colours;
        if (!covers_all) {
            const relief::BlockRelief alpha = blocks_with(source, alphas, size, texels);
            for (std::size_t k = 0; k < corners.size(); ++k) {
                const double light = image::linear_from_srgb(alpha.colours[k].x / 255.0);
                corners[k].w = static_cast<std::uint8_t>(std::lround(255.0 * light));
            }
        }
        assert(corners.size() == relief.relief.colours.size());
        all.push_back(std::move(corners));
    }
    return all;
}

} // namespace frustumscreen::bake
