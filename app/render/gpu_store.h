/// Meshes, pictures and reliefs in the GPU's memory, and reliefs that are rasterized on the processor, by the
/// numbers that plans name them with.
///
/// Colour   an artifact's texture gives sRGB codes as stored (level_data.h). A caption is coverage 0..255,
///          white light. A picture on the table gives its colours over black, as light.
/// Threads  the render thread; `find` allocates nothing.
/// Errors   the driver is out of memory, or a texture exceeds its limit.
#pragma once

#include "app/image/image.h"
#include "app/pack/pack.h"
#include "app/render/level_upload.h"
#include "app/scene/drawable.h"
#include "app/scene/scene_level.h"
#include "firmware_host/base/result.h"
#include "firmware_host/gl/gl_handle.h"

#include <cstdint>
#include <map>
#include <memory>
#include <span>

namespace frustumscreen::render {

class GpuStore {
public:
    /// Uploads the part of a level that a scene needs; `texture` is the level's whole texture.
    [[nodiscard]] Result<scene::Drawable> upload(const scene::SceneLevel& level,
                                                 const image::Image8& texture);
    /// Takes over a level or a relief that has been uploaded piece by piece; its upload must be done. `texture`: the one in the store
    /// that it shares with another level (LevelData::texture_of); it stays until both are released.
    [[nodiscard]] scene::Drawable keep(LevelUpload upload, scene::TextureId texture = scene::TextureId::None);
    /// Takes over a relief that is rasterized on the processor; nothing is uploaded.
    [[nodiscard]] scene::Drawable keep(std::shared_ptr<const relief::BlockRelief> relief);
    /// Uploads a relief that the GPU draws.
    [[nodiscard]] Result<scene::Drawable> upload(std::shared_ptr<const relief::BlockRelief> relief);
    /// Uploads a whole level.
    [[nodiscard]] Result<scene::Drawable> upload(const pack::Pack& pack, std::uint32_t level);
    /// Uploads a caption's coverage, row 0 at the text's top.
    [[nodiscard]] Result<scene::TextureId> upload(const image::Image<std::uint8_t>& coverage);
    /// Uploads a picture on the table, row 0 at its top: `mips` from light_mips.
    [[nodiscard]] Result<scene::TextureId> upload_picture(std::span<const image::Image8> mips);
    /// Gives a level another texture of its surface, or a relief other colours in the order of its own, which torches show.
    /// `layer`: below scene::max_layers. One that the drawable has is released. Where the alpha is below 255 the surface's own
    /// colour shows through.
    [[nodiscard]] Result<void> add_layer(scene::Drawable& drawable, std::size_t layer,
                                         const image::Image8& texture);
    void add_layer(scene::Drawable& drawable, std::size_t layer,
                   std::shared_ptr<const std::vector<glm::u8vec4>> colours);
    /// Replaces a texture by the next picture of a film, as large as the first; `picture` gives colours over black.
    void replace_picture(scene::TextureId texture, const image::Image8& picture);
    /// From now on, draws that name it show nothing.
    void release(const scene::Drawable& drawable);
    void release(scene::TextureId texture);

    struct Mesh {
        gl::GlVertexArray vertex_array;
        gl::GlBuffer vertices;
    };
    struct Texture {
        gl::GlTexture texels;
        int finest_mip = 0;    ///< mip level of the whole texture that is uploaded as level 0
        std::size_t users = 1; ///< drawables that it belongs to
    };
    /// As in block_upload.h; the colours are the drawable's texture.
    struct Blocks {
        std::shared_ptr<const relief::BlockRelief> relief; ///< in main memory, where blocks are listed
        gl::GlTexture numbers, covers;
    };
    /// Null if it was not uploaded, or was released.
    [[nodiscard]] const Mesh* find(scene::MeshId mesh) const;
    /// As above, for a relief's data in main memory, whichever way it is drawn.
    [[nodiscard]] const relief::BlockRelief* find_relief(scene::MeshId relief) const;
    /// Other colours of a relief.
    [[nodiscard]] const std::vector<glm::u8vec4>* find_colours(scene::TextureId layer) const;
    /// As above, for a relief that the GPU draws.
    [[nodiscard]] const Blocks* find_blocks(scene::MeshId relief) const;
    [[nodiscard]] const Texture* find(scene::TextureId texture) const;

    /// Bytes of GPU memory, as the driver reports.
    [[nodiscard]] std::uint64_t bytes() const;
    [[nodiscard]] std::uint64_t bytes(const scene::Drawable& drawable) const;
    [[nodiscard]] std::uint64_t bytes(scene::TextureId texture) const;

private:
    [[nodiscard]] scene::TextureId keep(gl::GlTexture texels, int finest_mip);

    std::map<scene::MeshId, Mesh> meshes_;
    std::map<scene::MeshId, std::shared_ptr<const relief::BlockRelief>>
        reliefs_; ///< rasterized on the processor
    std::map<scene::MeshId, Blocks> blocks_;
    std::map<scene::TextureId, Texture> textures_;
    std::map<scene::TextureId, std::shared_ptr<const std::vector<glm::u8vec4>>> colours_;
    std::uint32_t last_ = 0; ///< last number given out
};

} // namespace frustumscreen::render
