#include "assets_baked/bake/loaders/picture_store.h"

#include "assets_baked/bake/loaders/picture_bytes.h"
#include "firmware_host/base/printable.h"

#include <algorithm>
#include <numeric>

namespace frustumscreen::bake {

std::shared_ptr<const image::Image8> PictureStore::decode(ByteView bytes, std::string_view place) {
    Result<ShrunkImage> picture =
        decode_shrunk(bytes, [this](const glm::ivec2& file_size) { return make_room_for(file_size); });
    if (!picture) {
        refuse({ErrorKind::BadInput, picture.error().id,
                fmt::format("{} ({})", picture.error().message, place)});
    }
    file_sizes_.push_back(picture->file_size);
    kept_.push_back(std::make_shared<image::Image8>(std::move(picture->image)));
    return kept_.back();
}

int PictureStore::make_room_for(const glm::ivec2& file_size) {
    int halvings = halvings_within(file_size, kept_texels_);
    while (true) {
        const glm::ivec2 size = image::halved_size(file_size, halvings);
        const std::int64_t coming = std::int64_t{size.x} * size.y;
        const std::int64_t all =
            std::accumulate(kept_.begin(), kept_.end(), coming,
                            [](std::int64_t sum, const auto& picture) { return sum + texels_of(*picture); });
        const auto largest = std::max_element(kept_.begin(), kept_.end(), [](const auto& a, const auto& b) {
            return a->texels.size() < b->texels.size();
        });
        const std::int64_t most = largest == kept_.end() ? 0 : texels_of(**largest);
        if (all <= kept_texels_ || std::max(most, coming) <= 1) {
            return halvings;
        }
        if (most >= coming) {
            **largest = image::half_size(**largest);
        } else {
            ++halvings;
        }
    }
}

void PictureStore::note_shrunk(LoadNotes& notes) const {
    std::size_t shrunk = 0;
    double texels = 0.0;
    for (std::size_t k = 0; k < kept_.size(); ++k) {
        shrunk += glm::ivec2(kept_[k]->width, kept_[k]->height) != file_sizes_[k] ? 1 : 0;
        texels += static_cast<double>(file_sizes_[k].x) * file_sizes_[k].y;
    }
    if (shrunk > 0) {
        notes.guessed(
            "{} of its {} {} shrunk while reading: together they have {:.3g} million texels, and a pack "
            "of this --size shows no more than {:.3g} million",
            shrunk, counted(kept_.size(), "picture", "pictures"), shrunk == 1 ? "is" : "are", texels / 1e6,
            static_cast<double>(kept_texels_) / 1e6);
    }
}

std::shared_ptr<const image::Image8> PictureStore::named(std::string_view name, std::string_view place) {
    if (sidecars_.exists(name)) {
        return decode(*sidecars_.read(name, place), place);
    }
    if (has_curators()) {
        return curators();
    }
    const std::optional<std::string> like = sidecars_.like(name);
    refuse("mesh.picture_missing",
           "its picture \"{}\" is not beside it; put it there, or name another picture with --texture FILE{} "
           "({})",
           printable(last_part(name)), like ? ", such as " + printable(*like) : std::string(), place);
}

std::shared_ptr<const image::Image8> PictureStore::curators() {
    if (!curators_) {
        const Result<Bytes> bytes = read_file(texture_);
        if (!bytes) {
            refuse({ErrorKind::BadInput, bytes.error().id,
                    "the picture for its colours, " + bytes.error().message});
        }
        curators_ = decode(*bytes, "the picture for its colours, " + texture_.string());
    }
    return curators_;
}

} // namespace frustumscreen::bake
