#include "app/residency/read_layer.h"

#include <algorithm>

namespace frustumscreen::residency {

Result<void> add_layer(render::GpuStore& store, const ReadLayer& layer, std::uint32_t number, bool is_relief,
                       scene::Drawable& drawable) {
    if (drawable.layers.at(layer.layer) != scene::TextureId::None) {
        return {}; // read before, and a window may show it
    }
    if (is_relief) {
        const auto found = std::find(layer.relief_texels.begin(), layer.relief_texels.end(), number);
        const auto place = static_cast<std::size_t>(found - layer.relief_texels.begin());
        if (place < layer.reliefs.size()) {
            store.add_layer(drawable, layer.layer, layer.reliefs[place]);
        }
        return {};
    }
    const std::size_t texture =
        number < layer.texture_of_level.size() ? layer.texture_of_level[number] : layer.textures.size();
    return texture < layer.textures.size() ? store.add_layer(drawable, layer.layer, layer.textures[texture])
                                           : Result<void>();
}

} // namespace frustumscreen::residency
