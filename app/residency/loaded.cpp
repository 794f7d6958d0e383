#include "app/residency/loaded.h"

#include <algorithm>
#include <utility>

namespace frustumscreen {

LoadedLevels::LoadedLevels(PreparedArtifact prepared) : artifact(std::move(prepared)) {
    uploads_.reserve(artifact.data.size());
    for (LevelData& data : artifact.data) {
        uploads_.emplace_back(std::move(data));
    }
    artifact.data.clear();
}

Result<void> LoadedLevels::upload(GpuStore& store, std::uint64_t max_bytes) {
    LevelUpload& level = uploads_[uploaded_];
    TRY_VOID(level.go_on(max_bytes));
    if (level.done()) {
        artifact.levels.give(uploaded_, store.keep(std::move(level)), store);
        ++uploaded_;
    }
    return {};
}

std::uint64_t LoadedLevels::bytes() const {
    return artifact.levels.bytes() + (artifact.triangles.tree ? artifact.triangles.tree->bytes() : 0);
}

LoadedTexts::LoadedTexts(TextPictures pictures) : pictures_(std::move(pictures)) {
    textures_.reserve(pictures_.size());
    for (const Image<std::uint8_t>& picture : pictures_) {
        bytes_ += caption_gpu_bytes(picture.width, picture.height);
    }
}

Result<void> LoadedTexts::upload(GpuStore& store, std::uint64_t max_bytes) {
    const std::uint64_t before = uploaded_bytes_;
    while (!ready() && uploaded_bytes_ - before < max_bytes) {
        Image<std::uint8_t>& picture = pictures_[textures_.size()];
        const std::uint64_t bytes = caption_gpu_bytes(picture.width, picture.height);
        TRY(const TextureId texture, bytes > 0 ? store.upload(picture) : TextureId::None);
        textures_.push_back(texture);
        uploaded_bytes_ += bytes;
        picture = {};
    }
    return {};
}

void LoadedTexts::release(GpuStore& store) {
    for (const TextureId texture : textures_) {
        store.release(texture);
    }
}

} // namespace frustumscreen
