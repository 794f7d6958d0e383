/// The surroundings of one model's bytes: side files, pictures, and notes.
#pragma once

#include "assets_baked/bake/load_mesh.h"
#include "assets_baked/bake/loaders/picture_store.h"

namespace frustumscreen::bake {

struct ModelFiles {
    ModelFiles(const std::filesystem::path& folder, const LoadOptions& options)
        : sidecars(folder, notes), pictures(sidecars, options.texture, options.kept_texels) {}
    ModelFiles(const ModelFiles&) = delete;
    ModelFiles& operator=(const ModelFiles&) = delete;
    ~ModelFiles() = default;

    LoadNotes notes;
    SourceAbout about;
    Sidecars sidecars;
    PictureStore pictures;
};

} // namespace frustumscreen::bake
