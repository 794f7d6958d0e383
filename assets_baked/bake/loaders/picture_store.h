/// Finds and decodes the pictures of one model, with one limit of texels for all of them.
///
/// Errors   throws Refusal.
#pragma once

#include "assets_baked/bake/loaders/decode_image.h"
#include "assets_baked/bake/loaders/refusal.h"
#include "assets_baked/bake/loaders/sidecar.h"

#include <memory>
#include <string_view>

namespace frustumscreen {

class PictureStore {
public:
    /// `texture` is the curator's own picture, used if the model's is missing; empty: there is none.
    PictureStore(Sidecars& sidecars, std::filesystem::path texture)
        : sidecars_(sidecars), texture_(std::move(texture)) {}

    [[nodiscard]] std::shared_ptr<const Image8> decode(ByteView bytes, std::string_view place);
    /// The picture in the file `name`; the curator's own if that is missing.
    [[nodiscard]] std::shared_ptr<const Image8> named(std::string_view name, std::string_view place);

    [[nodiscard]] bool has_curators() const { return !texture_.empty(); }
    /// The curator's own picture.
    [[nodiscard]] std::shared_ptr<const Image8> curators();
    [[nodiscard]] bool used_curators() const { return curators_ != nullptr; }

private:
    Sidecars& sidecars_;
    std::filesystem::path texture_;
    std::shared_ptr<const Image8> curators_;
    std::int64_t texels_left_ = max_texture_texels;
};

} // namespace frustumscreen
