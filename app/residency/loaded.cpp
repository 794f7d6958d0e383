#include "app/residency/loaded.h"

#include <utility>

namespace frustumscreen::residency {

LoadedLevels::LoadedLevels(PreparedArtifact prepared) : artifact(std::move(prepared)) {
    uploads_.reserve(artifact.data.size());
    textures_.reserve(artifact.data.size());
    for (scene::LevelData& data : artifact.data) {
        texture_of_.push_back(data.texture_of);
        uploads_.emplace_back(std::move(data));
    }
    artifact.data.clear();
}

Result<void> LoadedLevels::upload(render::GpuStore& store, std::uint64_t max_bytes) {
    render::LevelUpload& level = uploads_[uploaded_];
    TRY_VOID(level.go_on(max_bytes));
    if (level.done()) {
        const std::size_t levels = artifact.levels.uses().size();
        const std::optional<std::size_t> shared = texture_of_[uploaded_];
        const scene::Drawable drawable =
            store.keep(std::move(level), shared ? textures_[*shared] : scene::TextureId::None);
        textures_.push_back(drawable.material.texture);
        if (uploaded_ < levels) {
            artifact.levels.give(uploaded_, drawable, store);
        } else {
            artifact.cells->give(uploaded_ - levels, drawable, store);
        }
        ++uploaded_;
    }
    return {};
}

void LoadedLevels::release(render::GpuStore& store) {
    artifact.levels.release(store);
    if (artifact.cells) {
        artifact.cells->release(store);
    }
}

std::uint64_t LoadedLevels::bytes() const {
    return artifact.levels.bytes() + (artifact.triangles.tree ? artifact.triangles.tree->bytes() : 0) +
           (artifact.cells ? artifact.cells->bytes() : 0);
}

LoadedPage::LoadedPage(PreparedPage prepared, std::size_t eyes) : page_(std::move(prepared)) {
    const scene::LevelTriangles& triangles = *page_.level.triangles;
    bytes_ = page_.level.use.planned_gpu_bytes + scene::bytes_of(triangles) +
             eyes * 2 * sizeof(std::uint32_t) * triangles.indices.size();
    upload_.emplace(std::move(page_.level.data));
    page_.level.data = {};
}

Result<void> LoadedPage::upload(render::GpuStore& store, std::uint64_t max_bytes) {
    TRY_VOID(upload_->go_on(max_bytes));
    if (upload_->done()) {
        drawable_ = store.keep(*std::move(upload_));
        upload_.reset();
        ready_ = true;
    }
    return {};
}

LoadedTexts::LoadedTexts(TextPictures pictures) : pictures_(std::move(pictures)) {
    textures_.reserve(pictures_.size());
    for (const image::Image<std::uint8_t>& picture : pictures_) {
        bytes_ += scene::caption_gpu_bytes(picture.width, picture.height);
    }
}

Result<void> LoadedTexts::upload(render::GpuStore& store, std::uint64_t max_bytes) {
    const std::uint64_t before = uploaded_bytes_;
    while (!ready() && uploaded_bytes_ - before < max_bytes) {
        image::Image<std::uint8_t>& picture = pictures_[textures_.size()];
        const std::uint64_t bytes = scene::caption_gpu_bytes(picture.width, picture.height);
        TRY(const scene::TextureId texture, bytes > 0 ? store.upload(picture) : scene::TextureId::None);
        textures_.push_back(texture);
        uploaded_bytes_ += bytes;
        picture = {};
    }
    return {};
}

void LoadedTexts::release(render::GpuStore& store) {
    for (const scene::TextureId texture : textures_) {
        store.release(texture);
    }
}

} // namespace frustumscreen::residency
