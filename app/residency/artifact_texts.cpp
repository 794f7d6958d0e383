#include "app/residency/artifact_texts.h"

#include "app/exhibit/languages.h"
#include "app/pack/pack_states.h"
#include "app/pack/pack_torches.h"
#include "app/pack/pack_world.h"
#include "app/pack/text_portions.h"
#include "app/scene/scene_level.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string_view>
#include <utility>

namespace frustumscreen::residency {

namespace {

constexpr std::string_view description_key = "description";
constexpr double label_width_m = 0.15;

Nanoseconds reading_time(std::string_view text) {
    return Nanoseconds(std::llround(1e9 * pack::reading_time_s(text)));
}

/// The portions of a description; empty if it is too long to be narrated.
std::vector<std::string> told_portions(const pack::PackCaption& caption) {
    std::vector<std::string> portions = pack::portions_of(caption.description);
    return portions.size() <= pack::max_text_portions ? portions : std::vector<std::string>();
}

/// The caption with the attribution below it, and without, for places where both do not fit.
std::vector<TableText> caption_texts(const pack::ScanRights& rights, const pack::PackCaption& caption,
                                     std::span<const pack::SetLanguage> set) {
    const TableText bare = caption_text(caption);
    const std::vector<TextPiece> attribution =
        attribution_pieces(caption, rights, set, typography::CaptionRole::Small);
    if (attribution.empty()) {
        return {bare};
    }
    TableText whole = bare;
    whole.pieces.insert(whole.pieces.end(), attribution.begin(), attribution.end());
    return {whole, bare};
}

/// The narration of an artifact, by portion.
struct ToldTexts {
    std::vector<TableText> portions;
    bool ends_with_attribution = false;
};
ToldTexts told_texts(const pack::ScanRights& rights, const pack::PackCaption& caption,
                     std::span<const pack::SetLanguage> set) {
    ToldTexts told;
    for (const std::string& portion : told_portions(caption)) {
        told.portions.push_back(portion_text(caption, told.portions.size(), portion));
    }
    std::vector<TextPiece> attribution =
        attribution_pieces(caption, rights, set, typography::CaptionRole::Text);
    told.ends_with_attribution = !attribution.empty();
    if (told.ends_with_attribution) {
        told.portions.push_back({caption.language, std::move(attribution)});
    }
    return told;
}

Nanoseconds reading_time(const TableText& text) {
    Nanoseconds time(0);
    for (const TextPiece& piece : text.pieces) {
        time += reading_time(piece.text);
    }
    return time;
}

/// True if the text's lines begin at the right.
bool is_flush_right(const TableText& text, const pack::SetLanguage* set) {
    return set != nullptr && std::any_of(text.pieces.begin(), text.pieces.end(), [&](const TextPiece& piece) {
               const pack::GlyphText* const glyphs = set->runs.find(piece.key);
               return glyphs != nullptr && glyphs->direction == pack::TextDirection::RightToLeft;
           });
}

/// A label or a title. Null if the bake could not set it in this language.
const pack::GlyphText* label_in(const pack::SetLanguage* set, const std::string& key) {
    return set != nullptr ? set->runs.find(key) : nullptr;
}

/// In each language; 0 where the bake could not set it.
std::vector<glm::dvec2> label_sizes_m(const std::string& key, std::span<const std::string> languages,
                                      std::span<const pack::SetLanguage> set, const TextStyle& style) {
    std::vector<glm::dvec2> sizes_m;
    for (const std::string& language : languages) {
        const pack::SetLanguage* const texts = find_language(set, language);
        const typography::GlyphPart text{typography::CaptionRole::Text, label_in(texts, key)};
        sizes_m.push_back(text.text != nullptr
                              ? typography::caption_size_m(texts->runs, std::span(&text, 1), style.em_m,
                                                           label_width_m, style.texels_per_m)
                              : glm::dvec2(0.0));
    }
    return sizes_m;
}

/// Reading times of the hotspots' labels in the nearest language.
std::vector<Nanoseconds> label_times(const pack::PackDescription& pack, const std::string& language) {
    std::vector<Nanoseconds> times;
    for (const pack::PackHotspot& hotspot : pack.hotspots) {
        std::vector<std::string> languages;
        for (const pack::PackLabel& label : hotspot.labels) {
            languages.push_back(label.language);
        }
        times.push_back(languages.empty()
                            ? Nanoseconds(0)
                            : reading_time(hotspot.labels[exhibit::caption_for(language, languages)].text));
    }
    return times;
}

/// Null if the pack has no sound of the description.
SharedRecording recording_of(const TextSource& source, std::span<const pack::SpokenText> sounds,
                             const std::string& language, const std::vector<Nanoseconds>& portions) {
    const pack::SpokenText wanted{language, std::string(description_key)};
    if (portions.empty() || std::find(sounds.begin(), sounds.end(), wanted) == sounds.end()) {
        return nullptr;
    }
    return std::make_shared<const PromptRecording>(
        PromptRecording{.name = fmt::format("{}: the description in '{}'", source.file.string(), language),
                        .opus = Bytes(),
                        .pack = source.file,
                        .language = language,
                        .key = std::string(description_key),
                        .portions = portions});
}

Result<void> add_language(const TextSource& source, const pack::PackCaption& caption,
                          std::span<const pack::SetLanguage> set, std::span<const pack::SpokenText> sounds,
                          CaptionSetter& setter, ArtifactTexts& made) {
    TRY(const pack::ScanRights rights, pack::scan_rights(source.pack));
    std::vector<glm::dvec2>& captions = made.entry.caption_sizes_m.emplace_back();
    for (const TableText& text : caption_texts(rights, caption, set)) {
        TRY(const std::vector<glm::dvec2> sizes, setter.sizes_m(text, set));
        captions.insert(captions.end(), sizes.begin(), sizes.end());
    }
    exhibit::Tellable& tellable = made.entry.tellables.emplace_back();
    tellable.hotspots = label_times(source.pack, caption.language);
    exhibit::DescriptionShape& shape = made.entry.descriptions.emplace_back();
    const ToldTexts told = told_texts(rights, caption, set);
    for (const TableText& text : told.portions) {
        TRY(const std::vector<glm::dvec2> portion, setter.sizes_m(text, set));
        shape.sizes_m.push_back(portion);
        shape.flush_right = shape.flush_right || is_flush_right(text, find_language(set, caption.language));
        tellable.portions.push_back(reading_time(text));
    }
    shape.largest_m = exhibit::largest_sizes(shape.sizes_m);
    tellable.ends_unspoken = told.ends_with_attribution;
    std::vector<Nanoseconds> spoken = tellable.portions;
    spoken.resize(spoken.size() - (tellable.ends_unspoken ? 1 : 0));
    made.recordings.push_back(recording_of(source, sounds, caption.language, spoken));
    return {};
}

exhibit::HotspotSet lay_out_hotspots(const pack::PackDescription& pack,
                                     std::span<const std::string> languages,
                                     std::span<const pack::SetLanguage> set, double metres_per_box,
                                     const TextStyle& style) {
    exhibit::HotspotSet made;
    made.metres_per_box = metres_per_box;
    for (std::size_t k = 0; k < pack.hotspots.size(); ++k) {
        const pack::PackHotspot& hotspot = pack.hotspots[k];
        exhibit::LabelledHotspot& labelled = made.hotspots.emplace_back();
        labelled.at = {metres_per_box * hotspot.point, hotspot.normal};
        labelled.label_sizes_m = label_sizes_m(pack::label_key(k), languages, set, style);
    }
    return made;
}

/// The key of its title, which is shown only if a button begins it; empty: it is not.
std::string title_key(world::Trigger trigger, std::size_t behaviour) {
    return trigger == world::Trigger::Button ? pack::behaviour_key(behaviour) : std::string();
}

Result<std::vector<exhibit::TriggeredBehaviour>> lay_out_behaviours(const pack::PackDescription& pack,
                                                                    std::span<const std::string> languages,
                                                                    std::span<const pack::SetLanguage> set,
                                                                    const TextStyle& style) {
    TRY(const pack::PackWorld world, pack::world_outline_of(pack));
    std::vector<exhibit::TriggeredBehaviour> made;
    for (std::size_t k = 0; k < world.behaviours.size(); ++k) {
        const world::Behaviour& behaviour = world.behaviours[k].behaviour;
        made.push_back(
            {.trigger = behaviour.trigger,
             .hotspot = behaviour.hotspot,
             .narration_s = behaviour.narration_s,
             .lasts = behaviour.repeats || behaviour.stays,
             .title_sizes_m = label_sizes_m(title_key(behaviour.trigger, k), languages, set, style)});
    }
    return made;
}

/// The titles of a torch's contents.
Result<std::vector<std::vector<glm::dvec2>>> lay_out_contents(const pack::PackDescription& pack,
                                                              std::span<const std::string> languages,
                                                              std::span<const pack::SetLanguage> set,
                                                              const TextStyle& style) {
    TRY(const pack::PackTorches torches, pack::torches_of(pack));
    std::vector<std::vector<glm::dvec2>> made;
    for (std::size_t k = 0; k < torches.contents.size(); ++k) {
        made.push_back(label_sizes_m(pack::torch_key(k), languages, set, style));
    }
    return made;
}

Result<std::vector<std::vector<glm::dvec2>>> lay_out_states(const pack::PackDescription& pack,
                                                            std::span<const std::string> languages,
                                                            std::span<const pack::SetLanguage> set,
                                                            const TextStyle& style) {
    TRY(const std::vector<pack::PackState> states, pack::states_of(pack));
    std::vector<std::vector<glm::dvec2>> made;
    for (std::size_t k = 0; k < states.size(); ++k) {
        made.push_back(label_sizes_m(pack::state_key(k), languages, set, style));
    }
    return made;
}

/// Sizes of the part's pictures in their order; 0 for a missing picture.
std::vector<glm::ivec2> sizes_px(const exhibit::CatalogueEntry& entry, TextPart part, std::size_t language,
                                 const TextStyle& style) {
    std::vector<glm::ivec2> sizes;
    const auto add = [&](std::span<const glm::dvec2> sizes_m) {
        for (const glm::dvec2& size_m : sizes_m) {
            sizes.emplace_back(glm::round(style.texels_per_m * size_m));
        }
    };
    if (part == TextPart::Caption) {
        add(entry.caption_sizes_m[language]);
        for (const exhibit::TriggeredBehaviour& behaviour : entry.behaviours) {
            add(std::span(&behaviour.title_sizes_m[language], 1));
        }
        for (const auto* const titles : {&entry.content_title_sizes_m, &entry.state_title_sizes_m}) {
            for (const std::vector<glm::dvec2>& title : *titles) {
                add(std::span(&title[language], 1));
            }
        }
        return sizes;
    }
    for (const std::vector<glm::dvec2>& portion : entry.descriptions[language].sizes_m) {
        add(portion);
    }
    for (const exhibit::LabelledHotspot& hotspot : entry.hotspots.hotspots) {
        add(std::span(&hotspot.label_sizes_m[language], 1));
    }
    return sizes;
}

/// Draws pictures in order.
class Drawing {
public:
    Drawing(const TextStyle& style, std::span<const pack::SetLanguage> set,
            const std::function<bool()>& given_up)
        : style_(style), set_(set), given_up_(given_up), setter_(style) {}

    [[nodiscard]] Result<void> add(const TableText& text) {
        if (given_up_()) {
            return bad_input("show.texts_not_wanted", "not wanted any more");
        }
        TRY(std::vector<typography::CaptionImage> images, setter_.set(text, set_));
        for (typography::CaptionImage& image : images) {
            pictures.push_back(std::move(image.coverage));
        }
        return {};
    }
    void add_label(const std::string& language, const std::string& key) {
        const pack::SetLanguage* const texts = find_language(set_, language);
        const typography::GlyphPart text{typography::CaptionRole::Text, label_in(texts, key)};
        pictures.push_back(text.text != nullptr
                               ? typography::make_caption(texts->runs, texts->atlas, std::span(&text, 1),
                                                          style_.em_m, label_width_m, style_.texels_per_m)
                                     .coverage
                               : image::Image<std::uint8_t>());
    }

    TextPictures pictures;

private:
    TextStyle style_;
    std::span<const pack::SetLanguage> set_;
    const std::function<bool()>& given_up_;
    CaptionSetter setter_;
};

Result<void> draw(const pack::PackDescription& pack, const pack::PackCaption& caption,
                  const exhibit::CatalogueEntry& entry, std::span<const pack::SetLanguage> set, TextPart part,
                  Drawing& drawing) {
    const std::vector<exhibit::TriggeredBehaviour>& behaviours = entry.behaviours;
    TRY(const pack::ScanRights rights, pack::scan_rights(pack));
    const bool is_caption = part == TextPart::Caption;
    for (const TableText& text :
         is_caption ? caption_texts(rights, caption, set) : told_texts(rights, caption, set).portions) {
        TRY_VOID(drawing.add(text));
    }
    for (std::size_t k = 0; is_caption && k < behaviours.size(); ++k) {
        drawing.add_label(caption.language, title_key(behaviours[k].trigger, k));
    }
    for (std::size_t k = 0; is_caption && k < entry.content_title_sizes_m.size(); ++k) {
        drawing.add_label(caption.language, pack::torch_key(k));
    }
    for (std::size_t k = 0; is_caption && k < entry.state_title_sizes_m.size(); ++k) {
        drawing.add_label(caption.language, pack::state_key(k));
    }
    for (std::size_t k = 0; !is_caption && k < pack.hotspots.size(); ++k) {
        drawing.add_label(caption.language, pack::label_key(k));
    }
    return {};
}

} // namespace

Result<ArtifactTexts> lay_out_texts(const TextSource& source, double metres_per_box, const TextStyle& style,
                                    bool spoken) {
    ArtifactTexts made;
    for (const std::size_t each : source.captions) {
        made.entry.languages.push_back(source.pack.captions[each].language);
    }
    const std::vector<std::string>& languages = made.entry.languages;
    TRY(const std::vector<pack::SetLanguage> set,
        languages.empty() ? std::vector<pack::SetLanguage>()
                          : pack::load_set_texts(source.file, languages, pack::Atlases::NotRead));
    const Result<std::vector<pack::SpokenText>> sounds =
        spoken ? pack::list_sounds(source.pack) : std::vector<pack::SpokenText>();
    CaptionSetter setter(style);
    for (const std::size_t each : source.captions) {
        TRY_VOID(at(source.file.string(),
                    add_language(source, source.pack.captions[each], set,
                                 sounds.value_or(std::vector<pack::SpokenText>()), setter, made)));
    }
    made.entry.hotspots = lay_out_hotspots(source.pack, languages, set, metres_per_box, style);
    TRY(made.entry.behaviours,
        at(source.file.string(), lay_out_behaviours(source.pack, languages, set, style)));
    if (source.contents) {
        TRY(made.entry.content_title_sizes_m,
            at(source.file.string(), lay_out_contents(source.pack, languages, set, style)));
    }
    if (source.states) {
        TRY(made.entry.state_title_sizes_m,
            at(source.file.string(), lay_out_states(source.pack, languages, set, style)));
    }
    return made;
}

std::size_t portion_picture(std::size_t portion, std::size_t shape) {
    return typography::caption_widths_m.size() * portion + shape;
}

std::size_t label_picture(const exhibit::CatalogueEntry& entry, std::size_t language, std::size_t hotspot) {
    return portion_picture(entry.descriptions[language].sizes_m.size(), hotspot);
}

std::size_t title_picture(const exhibit::CatalogueEntry& entry, std::size_t language, std::size_t behaviour) {
    return entry.caption_sizes_m[language].size() + behaviour;
}

std::size_t state_picture(const exhibit::CatalogueEntry& entry, std::size_t language, std::size_t state) {
    return title_picture(entry, language,
                         entry.behaviours.size() + entry.content_title_sizes_m.size() + state);
}

std::uint64_t text_bytes(const exhibit::CatalogueEntry& entry, TextPart part, std::size_t language,
                         const TextStyle& style) {
    std::uint64_t bytes = 0;
    for (const glm::ivec2& size : sizes_px(entry, part, language, style)) {
        bytes += scene::caption_gpu_bytes(size.x, size.y);
    }
    return bytes;
}

Result<TextPictures> draw_texts(const TextSource& source, const ArtifactTexts& texts, TextPart part,
                                std::size_t language, const TextStyle& style,
                                const std::function<bool()>& given_up) {
    const pack::PackCaption& caption = source.pack.captions[source.captions[language]];
    TRY(const std::vector<pack::SetLanguage> set,
        pack::load_set_texts(source.file, std::span(&caption.language, 1)));
    Drawing drawing(style, set, given_up);
    TRY_VOID(at(source.file.string(), draw(source.pack, caption, texts.entry, set, part, drawing)));
    const std::vector<glm::ivec2> sizes = sizes_px(texts.entry, part, language, style);
    const auto as_laid_out = [](const image::Image<std::uint8_t>& picture, const glm::ivec2& size) {
        return glm::ivec2(picture.width, picture.height) == size;
    };
    if (!std::equal(drawing.pictures.begin(), drawing.pictures.end(), sizes.begin(), sizes.end(),
                    as_laid_out)) {
        return at(source.file.string(),
                  Error{ErrorKind::BadInput, "show.texts_changed",
                        "the texts have changed since the exhibit was started; start it again"});
    }
    return std::move(drawing.pictures);
}

} // namespace frustumscreen::residency
