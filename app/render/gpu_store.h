/// Meshes, pictures and reliefs in the GPU's memory, and reliefs that are cast on the processor, by the numbers that plans name them
/// with.
///
/// Colour   an artifact's texture gives sRGB codes as they are stored (level_data.h). A caption is coverage
///          0..255, white light. A picture for the table gives its colours over black, as light.
/// Threads  the render thread; `find` allocates nothing.
/// Errors   the driver has no memory, or a texture is larger than it allows.
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

namespace frustumscreen {

class GpuStore {
public:
    /// Uploads what a scene needs of a level; `texture` is the level's whole texture.
    [[nodiscard]] Result<Drawable> upload(const SceneLevel& level, const Image8& texture);
    /// Takes a level or a relief that has been uploaded piece by piece; it must be done.
    [[nodiscard]] Drawable keep(LevelUpload upload);
    /// Takes a relief that is cast, of which nothing is uploaded.
    [[nodiscard]] Drawable keep(std::shared_ptr<const BlockRelief> relief);
    /// Uploads a relief that the GPU draws.
    [[nodiscard]] Result<Drawable> upload(std::shared_ptr<const BlockRelief> relief);
    /// Uploads all of a level.
    [[nodiscard]] Result<Drawable> upload(const Pack& pack, std::uint32_t level);
    /// Uploads a caption's coverage, row 0 at the text's top.
    [[nodiscard]] Result<TextureId> upload(const Image<std::uint8_t>& coverage);
    /// Uploads a picture for the table, row 0 at its top: light_mips of it.
    [[nodiscard]] Result<TextureId> upload_picture(std::span<const Image8> mips);
    /// Draws that name it show nothing from now on.
    void release(const Drawable& drawable);
    void release(TextureId texture);

    struct Mesh {
        GlVertexArray vertex_array;
        GlBuffer vertices;
    };
    struct Texture {
        GlTexture texels;
        int finest_mip = 0; ///< the whole texture's mip level that is uploaded as level 0
    };
    /// As block_upload.h; the colours are the drawable's texture.
    struct Blocks {
        std::shared_ptr<const BlockRelief> relief; ///< in main memory, where blocks are listed
        GlTexture numbers, covers;
    };
    /// Null if it was not uploaded, or released.
    [[nodiscard]] const Mesh* find(MeshId mesh) const;
    /// The same for a relief as it lies in main memory, whatever draws it.
    [[nodiscard]] const BlockRelief* find_relief(MeshId relief) const;
    /// The same for a relief that the GPU draws.
    [[nodiscard]] const Blocks* find_blocks(MeshId relief) const;
    [[nodiscard]] const Texture* find(TextureId texture) const;

    /// Bytes of GPU memory, as the driver says.
    [[nodiscard]] std::uint64_t bytes() const;
    [[nodiscard]] std::uint64_t bytes(const Drawable& drawable) const;
    [[nodiscard]] std::uint64_t bytes(TextureId texture) const;

private:
    [[nodiscard]] TextureId keep(GlTexture texels, int finest_mip);

    std::map<MeshId, Mesh> meshes_;
    std::map<MeshId, std::shared_ptr<const BlockRelief>> reliefs_; ///< that are cast
    std::map<MeshId, Blocks> blocks_;
    std::map<TextureId, Texture> textures_;
    std::uint32_t last_ = 0; ///< last number given out
};

} // namespace frustumscreen
