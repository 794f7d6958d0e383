/// An artifact's data in memory, or on its way to the GPU's memory: its levels with those of its cells, a page of a site, or some of its
/// texts.
///
/// Units    bytes.
/// Threads  constructed on any thread; everything else on the render thread, with the display's context
///          current. Once `ready` is true, nothing allocates.
/// Errors   the driver is out of memory.
#pragma once

#include "app/render/gpu_store.h"
#include "app/residency/prepared_artifact.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace frustumscreen::residency {

class LoadedLevels {
public:
    explicit LoadedLevels(PreparedArtifact prepared);

    /// Uploads about `max_bytes` more; it may exceed them slightly.
    [[nodiscard]] Result<void> upload(render::GpuStore& store, std::uint64_t max_bytes);
    [[nodiscard]] bool ready() const { return uploaded_ == uploads_.size(); }
    /// Removes all of it from the store.
    void release(render::GpuStore& store);
    /// GPU memory and main memory.
    [[nodiscard]] std::uint64_t bytes() const;

    /// Changes of quality level, cells' included.
    [[nodiscard]] std::uint64_t switches() const {
        return artifact.levels.state().switches + (artifact.cells ? artifact.cells->switches() : 0);
    }

    PreparedArtifact artifact;

private:
    std::vector<render::LevelUpload> uploads_;
    std::vector<std::optional<std::size_t>> texture_of_; ///< LevelData::texture_of, by upload
    std::size_t uploaded_ = 0;                           ///< levels, also of cells, that are in the store
    std::vector<scene::TextureId> textures_;             ///< theirs
};

/// A page of a site (RunCells), which its artifact's cells draw.
class LoadedPage {
public:
    /// `eyes`: of the artifact's plan.
    LoadedPage(PreparedPage prepared, std::size_t eyes);

    [[nodiscard]] Result<void> upload(render::GpuStore& store, std::uint64_t max_bytes);
    [[nodiscard]] bool ready() const { return ready_; }
    void release(render::GpuStore& store) { store.release(drawable_); }
    /// GPU memory and main memory, with its triangles' place in the frame's plans.
    [[nodiscard]] std::uint64_t bytes() const { return bytes_; }
    /// Requires `ready()`.
    void give_to(RunCells& cells, const render::GpuStore& store) const {
        cells.give_page(page_.place, page_.level, drawable_, store);
    }

private:
    PreparedPage page_;
    std::uint64_t bytes_ = 0;
    std::optional<render::LevelUpload> upload_; ///< until it is ready
    scene::Drawable drawable_;
    bool ready_ = false;
};

class LoadedTexts {
public:
    LoadedTexts() = default; ///< no texts
    explicit LoadedTexts(TextPictures pictures);

    /// As above, but pictures are uploaded whole.
    [[nodiscard]] Result<void> upload(render::GpuStore& store, std::uint64_t max_bytes);
    [[nodiscard]] bool ready() const { return textures_.size() == pictures_.size(); }
    void release(render::GpuStore& store);
    [[nodiscard]] std::uint64_t bytes() const { return bytes_; }
    /// The part of `bytes` for pictures that are in the store.
    [[nodiscard]] std::uint64_t uploaded_bytes() const { return uploaded_bytes_; }

    /// None if the picture is not in the store.
    [[nodiscard]] scene::TextureId texture(std::size_t picture) const {
        return picture < textures_.size() ? textures_[picture] : scene::TextureId::None;
    }

private:
    TextPictures pictures_; ///< emptied as they go into the store
    std::vector<scene::TextureId> textures_;
    std::uint64_t bytes_ = 0;
    std::uint64_t uploaded_bytes_ = 0;
};

} // namespace frustumscreen::residency
