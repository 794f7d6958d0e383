/// What is in memory of an artifact, or on its way into the GPU's memory: its levels, or some of its texts.
///
/// Units    bytes.
/// Threads  made on any; the render thread, with the display's context current, for all else. After `upload` said that it is
///          ready nothing allocates.
/// Errors   the driver has no memory.
#pragma once

#include "app/render/gpu_store.h"
#include "app/residency/prepared_artifact.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace frustumscreen {

class LoadedLevels {
public:
    explicit LoadedLevels(PreparedArtifact prepared);

    /// So many bytes more, or a little more than that.
    [[nodiscard]] Result<void> upload(GpuStore& store, std::uint64_t most_bytes);
    [[nodiscard]] bool ready() const { return uploaded_ == uploads_.size(); }
    /// Takes all of it out of the store.
    void release(GpuStore& store) { artifact.levels.release(store); }
    /// Of the GPU's memory and of main memory.
    [[nodiscard]] std::uint64_t bytes() const;

    PreparedArtifact artifact;

private:
    std::vector<LevelUpload> uploads_;
    std::size_t uploaded_ = 0; ///< levels that are in the store
};

class LoadedTexts {
public:
    LoadedTexts() = default; ///< none
    explicit LoadedTexts(TextPictures pictures);

    /// As above; a picture is never cut.
    [[nodiscard]] Result<void> upload(GpuStore& store, std::uint64_t most_bytes);
    [[nodiscard]] bool ready() const { return textures_.size() == pictures_.size(); }
    void release(GpuStore& store);
    [[nodiscard]] std::uint64_t bytes() const { return bytes_; }
    /// Of those, what the pictures take that are in the store.
    [[nodiscard]] std::uint64_t uploaded_bytes() const { return uploaded_bytes_; }

    /// None if it is not in the store.
    [[nodiscard]] TextureId texture(std::size_t picture) const {
        return picture < textures_.size() ? textures_[picture] : TextureId::None;
    }

private:
    TextPictures pictures_; ///< empty, once they are in the store
    std::vector<TextureId> textures_;
    std::uint64_t bytes_ = 0;
    std::uint64_t uploaded_bytes_ = 0;
};

} // namespace frustumscreen
