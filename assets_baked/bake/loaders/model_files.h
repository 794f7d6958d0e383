/// What lies around the bytes of one model: its side files and its pictures, and what is to be said of them.
#pragma once

#include "assets_baked/bake/load_mesh.h"
#include "assets_baked/bake/loaders/picture_store.h"

namespace frustumscreen {

struct ModelFiles {
    ModelFiles(const std::filesystem::path& folder, const LoadOptions& options)
        : sidecars(folder, notes), pictures(sidecars, options.texture) {}
    ModelFiles(const ModelFiles&) = delete;
    ModelFiles& operator=(const ModelFiles&) = delete;
    ~ModelFiles() = default;

    LoadNotes notes;
    SourceAbout about;
    Sidecars sidecars;
    PictureStore pictures;
};

} // namespace frustumscreen
