/// Sets what a torch's shader takes (torch_shader.h), and binds its textures.
///
/// Threads  the render thread. Allocates nothing.
#pragma once

#include "app/render/gpu_store.h"
#include "app/render/raster.h"
#include "app/render/shader_cache.h"
#include "app/scene/frame_plan.h"

#include <span>

namespace frustumscreen::render {

/// A torch's view, as textures; 0: none.
struct TorchPicture {
    unsigned shadow = 0, colour = 0;
    glm::vec2 inverse_z{0.0F}; ///< of a texel of `shadow`: factor, offset
};

/// A lit picture: a plan that has been drawn, and the views of its torches.
struct Lit {
    const scene::FramePlan& plan;
    const GpuStore& store;
    const ShaderCache& shaders;
    const Raster& raster;
    std::span<const TorchPicture> torches; ///< one for each of the plan's
};
/// The shader for the light's own parts, otherwise the one for any content. Null: neither was prepared.
[[nodiscard]] const Shader* find_torch(const ShaderCache& shaders, const scene::ShaderKey& key,
                                       const scene::TorchLight& light);
/// True if the content has other colours of the surface, which only the surface's own draws know.
[[nodiscard]] bool shows_layer(const scene::TorchLight& light);
void bind(unsigned unit, unsigned texture);
/// The colour or the depth of the framebuffer that is drawn into, which must be a texture.
[[nodiscard]] unsigned texture_of_framebuffer(unsigned attachment);

/// Texture units of torch_shader.h.
inline constexpr unsigned shadow_unit = 4, content_unit = 5, layer_unit = 6, seen_unit = 7, depths_unit = 8,
                          backs_unit = 9;

/// How a beam's intensity falls (torch_shader.h).
[[nodiscard]] glm::vec4 fall_of(const torch::Beam& beam);
/// The share of z within which a surface does not shade itself: half a pixel of the torch's picture, the depth of a surface that bends
/// within a pixel.
[[nodiscard]] double slack_of(const scene::TorchLight& light);
void set_torch(const Shader& shader, const scene::TorchLight& light, const TorchPicture& picture,
               const GpuStore& store);
/// Sets a face and the maps from nearness to its places.
void set_nearness(const Shader& shader, const scene::FramePlan& plan, const scene::TorchLight& light,
                  int face, const glm::ivec4& raster);
/// Sets a face and the maps from depth to its places.
void set_depths(const Shader& shader, const scene::TorchFace& face, const glm::ivec4& raster);
/// Sets the face that a draw lights.
void set_lit_face(const Shader& shader, const scene::FramePlan& plan, const scene::Draw& draw,
                  const Raster& raster);
/// Lights a face in these parts, with a shader in use for which the depth or nearness of its places is set; returns the number of draw
/// calls.
int light_face(const Lit& lit, const scene::TorchFace& face, const Shader& shader,
               std::span<const PixelRectangle> parts);
/// The layer that the torch shows; TextureId::None if it shows none.
[[nodiscard]] scene::TextureId layer_of(const scene::TorchLight& light, const scene::Drawable& drawable);
/// True if the content is the torch's own view.
[[nodiscard]] bool shows_own_view(const scene::TorchLight& light);
/// Blending for the torch's content, in linear light.
void begin_blending(const scene::TorchLight& light);
void end_blending();

} // namespace frustumscreen::render
