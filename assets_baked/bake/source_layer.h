/// Another look of a source's surface, which a torch or a state shows: other pictures and factors in place of its materials.
///
/// Colour   as of SourceMaterial, without the mesh's vertex colours. Alpha is how far the layer covers the artifact's own
///          colour; it cuts no hole.
/// Threads  values; any.
#pragma once

#include "app/image/image.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace frustumscreen::bake {

enum class Wrap : std::uint8_t { Repeat, Mirror, Clamp };

struct SourceTexture {
    std::shared_ptr<const image::Image8> image; ///< sRGB; may be shared between materials
    Wrap wrap_u = Wrap::Repeat;
    Wrap wrap_v = Wrap::Repeat;
};

struct SourceLayer {
    std::string name;
    bool lit = true;       ///< by the light that the artifact has
    bool has_alpha = true; ///< false: it covers all, whatever its pictures' alpha is
    bool covers = false; ///< where it is transparent it gets the artifact's own colours, and then covers all
    struct Look {
        glm::vec4 base_colour{1.0F}; ///< linear factor
        int texture = -1;            ///< index into `textures`; -1: none
    };
    std::vector<Look> looks; ///< one for each of the mesh's materials
    std::vector<SourceTexture> textures;
};

} // namespace frustumscreen::bake
