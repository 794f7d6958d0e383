#include "app/exhibit/artifact_caption.h"

namespace frustumscreen::exhibit {

std::optional<PresentedCaption> ArtifactCaption::step(MonotonicTime now, const Input& input) {
    const CatalogueEntry& entry = input.entry;
    const CaptionText& text = input.text;
    const std::vector<glm::dvec2>& sizes =
        text.portion ? entry.descriptions[input.language].largest_m : entry.caption_sizes_m[input.language];
    if (placed_ != &sizes) {
        placed_ = &sizes;
        placer_.set_shapes(sizes);
    }
    const SentenceEnvironment& environment = input.environment;
    placer_.update(now, environment.around, environment.hidden, environment.prop_m,
                   environment.quarter_turns);
    const typography::CaptionPlace place = placer_.at(now);
    const double brightness = place.opacity * input.light * text.brightness;
    if (brightness <= 0.0) {
        return std::nullopt;
    }
    PresentedCaption caption{.language = input.language,
                             .shape = place.shape,
                             .rectangle = place.rectangle,
                             .brightness = brightness,
                             .portion = text.portion};
    if (text.portion) {
        const DescriptionShape& description = entry.descriptions[input.language];
        caption.rectangle = portion_place(place.rectangle, description.sizes_m[*text.portion][place.shape],
                                          description.flush_right);
    }
    return caption;
}

} // namespace frustumscreen::exhibit
