/// Finds and decodes the pictures of one model.
///
/// Memory   all pictures together are kept in a number of texels: before another one comes and makes more of them, the
///          largest are halved. One picture at a time is decoded, to the size that it is kept in (decode_image.h).
/// Errors   throws Refusal.
#pragma once

#include "assets_baked/bake/loaders/decode_image.h"
#include "assets_baked/bake/loaders/refusal.h"
#include "assets_baked/bake/loaders/sidecar.h"

#include <memory>
#include <string_view>
#include <vector>

namespace frustumscreen::bake {

class PictureStore {
public:
    /// `texture` is the curator's own picture, used if the model's is missing; empty: there is none. `kept_texels` is
    /// for all pictures together.
    PictureStore(Sidecars& sidecars, std::filesystem::path texture, std::int64_t kept_texels)
        : sidecars_(sidecars), texture_(std::move(texture)), kept_texels_(kept_texels) {}

    [[nodiscard]] std::shared_ptr<const image::Image8> decode(ByteView bytes, std::string_view place);
    /// The picture in the file `name`; the curator's own if that is missing.
    [[nodiscard]] std::shared_ptr<const image::Image8> named(std::string_view name, std::string_view place);

    [[nodiscard]] bool has_curators() const { return !texture_.empty(); }
    /// The curator's own picture.
    [[nodiscard]] std::shared_ptr<const image::Image8> curators();
    [[nodiscard]] bool used_curators() const { return curators_ != nullptr; }

    /// Sizes of the decoded pictures, as in their files.
    [[nodiscard]] const std::vector<glm::ivec2>& file_sizes() const { return file_sizes_; }
    /// Notes how many pictures were shrunk.
    void note_shrunk(LoadNotes& notes) const;

private:
    /// Halves the largest pictures until all of them fit, with one more of this size; returns how often that one is halved.
    [[nodiscard]] int make_room_for(const glm::ivec2& file_size);

    Sidecars& sidecars_;
    std::filesystem::path texture_;
    std::shared_ptr<const image::Image8> curators_;
    std::int64_t kept_texels_;
    std::vector<std::shared_ptr<image::Image8>> kept_;
    std::vector<glm::ivec2> file_sizes_; ///< one for each kept picture
};

} // namespace frustumscreen::bake
