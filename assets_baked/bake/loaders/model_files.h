/// The surroundings of one model's bytes: side files, pictures, and notes.
#pragma once

#include "assets_baked/bake/load_mesh.h"
#include "assets_baked/bake/loaders/picture_store.h"

#include <functional>
#include <utility>

namespace frustumscreen {

struct ModelFiles {
    /// Told how many bytes of the model are not read any more.
    using Passed = std::function<void(std::size_t offset)>;

    ModelFiles(const std::filesystem::path& folder, const LoadOptions& options, Passed told)
        : sidecars(folder, notes), pictures(sidecars, options.texture, options.kept_texels),
          passed(std::move(told)) {}
    ModelFiles(const ModelFiles&) = delete;
    ModelFiles& operator=(const ModelFiles&) = delete;
    ~ModelFiles() = default;

    LoadNotes notes;
    SourceAbout about;
    Sidecars sidecars;
    PictureStore pictures;
    Passed passed;
};

} // namespace frustumscreen
