#include "assets_baked/bake/layer_parts.h"

#include "app/pack/colours_part.h"

#include <utility>

namespace frustumscreen::bake {

Result<void> put_torches(pack::Pack& pack, std::span<const image::Image8> layers, const ReliefSource& source,
                         std::span<const pack::MeasuredRelief> reliefs, const BakeOptions& options) {
    pack::PackTorches torches = options.torches;
    pack::TorchParts parts = options.torch_parts;
    torches.layers.clear();
    for (std::size_t k = 0; k < layers.size(); ++k) {
        const std::string& name = source.truth.mesh().layers[k].name;
        pack::TorchParts::Layer made{{image::encode_webp(layers[k])}, {}};
        if (made.textures.front().empty()) {
            return bad_input(
                "layer_parts.too_large",
                "the layer '{}' has {} x {} texels on the artifact, more than 16383 a side; bake "
                "with a smaller --size",
                name, layers[k].width, layers[k].height);
        }
        for (const std::vector<glm::u8vec4>& colours :
             layer_colours(source, layers[k], options.size, reliefs)) {
            made.reliefs.push_back(pack::encode_colours(colours));
        }
        torches.layers.push_back({.name = name});
        parts.layers.push_back(std::move(made));
    }
    return pack::put_torches(pack, std::move(torches), std::move(parts));
}

} // namespace frustumscreen::bake
