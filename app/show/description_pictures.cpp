#include "app/show/description_pictures.h"

#include "app/exhibit/languages.h"
#include "app/pack/pack_texts.h"
#include "app/pack/text_portions.h"
#include "app/scene/scene_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace frustumscreen {

namespace {

constexpr std::string_view description_key = "description";

Nanoseconds reading_time(std::string_view text) {
    return Nanoseconds(std::llround(1e9 * reading_time_s(text)));
}

/// Of each hotspot's label in the nearest language.
std::vector<Nanoseconds> label_times(const Pack& pack, const std::string& language) {
    std::vector<Nanoseconds> times;
    for (const PackHotspot& hotspot : pack.hotspots) {
        std::vector<std::string> languages;
        for (const PackLabel& label : hotspot.labels) {
            languages.push_back(label.language);
        }
        times.push_back(languages.empty()
                            ? Nanoseconds(0)
                            : reading_time(hotspot.labels[caption_for(language, languages)].text));
    }
    return times;
}

/// Null if there is no sound of it.
SharedRecording recording_of(const DescriptionRequest& request, const std::string& language,
                             const std::vector<Nanoseconds>& portions) {
    const Result<std::vector<SpokenText>> sounds = list_sounds(request.pack);
    const SpokenText wanted{language, std::string(description_key)};
    if (!request.spoken || !sounds || std::find(sounds->begin(), sounds->end(), wanted) == sounds->end()) {
        return nullptr;
    }
    return std::make_shared<const Recording>(
        Recording{fmt::format("{}: the description in '{}'", request.file.string(), language), Bytes(),
                  request.file, language, std::string(description_key), portions});
}

Result<void> add_portion(std::span<const CaptionImage> images, GpuStore& store, DescriptionPictures& made) {
    std::vector<TextureId>& textures = made.portions.emplace_back();
    std::vector<glm::dvec2>& sizes = made.shape.sizes_m.emplace_back();
    for (const CaptionImage& image : images) {
        const Result<TextureId> texture = store.upload(image.coverage);
        if (!texture) {
            return tl::unexpected<Error>(texture.error());
        }
        textures.push_back(*texture);
        sizes.push_back(image.size_m);
        made.planned_gpu_bytes += caption_gpu_bytes(image.coverage.width, image.coverage.height);
    }
    return {};
}

} // namespace

Result<DescriptionPictures> make_description(const DescriptionRequest& request, const PackCaption& caption,
                                             CaptionSetter& setter, GpuStore& store) {
    DescriptionPictures made;
    made.tellable.hotspots = label_times(request.pack, caption.language);
    const std::vector<std::string> portions = portions_of(caption.description);
    if (portions.size() > most_text_portions) {
        return made;
    }
    for (std::size_t k = 0; k < portions.size(); ++k) {
        const Result<SetPortion> set =
            setter.set_portion(caption.language, portion_key(k), portions[k], request.set);
        Result<void> added =
            set ? add_portion(set->images, store, made) : Result<void>(tl::unexpected<Error>(set.error()));
        if (!added) {
            release(made, store);
            return tl::unexpected<Error>(added.error());
        }
        made.shape.flush_right = made.shape.flush_right || set->flush_right;
        made.tellable.portions.push_back(reading_time(portions[k]));
    }
    made.shape.largest_m = largest_sizes(made.shape.sizes_m);
    if (!portions.empty()) {
        made.recording = recording_of(request, caption.language, made.tellable.portions);
    }
    return made;
}

void release(const DescriptionPictures& description, GpuStore& store) {
    for (const std::vector<TextureId>& portion : description.portions) {
        for (const TextureId texture : portion) {
            store.release(texture);
        }
    }
}

} // namespace frustumscreen
