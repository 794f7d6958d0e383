#include "app/programs/preview/text_pictures.h"

#include "app/image/image.h"
#include "app/pack/attribution.h"
#include "app/pack/pack_texts.h"
#include "app/pack/text_portions.h"
#include "app/residency/artifact_texts.h"
#include "app/settings/settings.h"

#include <algorithm>
#include <utility>

namespace frustumscreen::programs {

namespace {

constexpr auto never = [] { return false; };
constexpr double usual_texels_per_m = 2400.0;

/// The style of a kiosk without a type size in its settings.
residency::TextStyle usual_style() {
    return {settings::ExhibitSettings{}.caption_height_m, usual_texels_per_m};
}

/// White on black, as the projector shows it.
ProjectedText projected(std::string text, const image::Image<std::uint8_t>& coverage) {
    if (coverage.texels.empty()) {
        return {std::move(text), {}, {}};
    }
    image::Image8 picture(coverage.width, coverage.height);
    std::transform(coverage.texels.begin(), coverage.texels.end(), picture.texels.begin(),
                   [](std::uint8_t light) {
                       const std::uint8_t code = image::srgb8_from_linear(light / 255.0);
                       return glm::u8vec4(code, code, code, 255);
                   });
    return {std::move(text), image::encode_webp(picture), {picture.width, picture.height}};
}

/// The label in the language itself; empty if there is none.
std::string label_in(const pack::PackHotspot& hotspot, const std::string& language) {
    const auto found = std::find_if(hotspot.labels.begin(), hotspot.labels.end(),
                                    [&](const pack::PackLabel& label) { return label.language == language; });
    return found != hotspot.labels.end() ? found->text : std::string();
}

Result<ProjectedLanguage> language_of(const residency::TextSource& source,
                                      const residency::ArtifactTexts& texts, std::size_t language) {
    ProjectedLanguage made;
    made.caption = source.pack.captions[source.captions[language]];
    const Result<residency::TextPictures> captions =
        residency::draw_texts(source, texts, residency::TextPart::Caption, language, usual_style(), never);
    TRY(const residency::TextPictures narration_sequencer,
        captions ? residency::draw_texts(source, texts, residency::TextPart::Narration, language,
                                         usual_style(), never)
                 : captions);
    made.title = projected(made.caption.title, captions->front());
    const std::size_t portions = texts.entry.descriptions[language].sizes_m.size();
    const std::vector<std::string> told = pack::portions_of(made.caption.description);
    TRY(const pack::ScanRights rights, at(source.file.string(), pack::scan_rights(source.pack)));
    const std::string attribution = pack::attribution_of(made.caption, rights);
    const bool has_attribution = texts.entry.tellables[language].ends_unspoken;
    for (std::size_t k = 0; k < portions; ++k) {
        const bool is_attribution = has_attribution && k + 1 == portions;
        made.portions.push_back(projected(is_attribution ? attribution : told[k],
                                          narration_sequencer[residency::portion_picture(k, 0)]));
    }
    made.ends_with_attribution = has_attribution;
    for (std::size_t k = 0; k < source.pack.hotspots.size(); ++k) {
        made.labels.push_back(
            projected(label_in(source.pack.hotspots[k], made.caption.language),
                      narration_sequencer[residency::label_picture(texts.entry, language, k)]));
    }
    TRY(made.sound, pack::load_sound(source.file, made.caption.language, "description"));
    return made;
}

} // namespace

double widest_text_px() {
    return usual_texels_per_m * typography::caption_widths_m.front();
}

Result<std::vector<ProjectedLanguage>> projected_texts(const std::filesystem::path& pack_file,
                                                       const pack::PackDescription& pack,
                                                       double metres_per_box) {
    std::vector<std::size_t> all;
    for (std::size_t k = 0; k < pack.captions.size(); ++k) {
        all.push_back(k);
    }
    const residency::TextSource source{pack_file, pack, all};
    TRY(const residency::ArtifactTexts texts,
        residency::lay_out_texts(source, metres_per_box, usual_style(), true));
    std::vector<ProjectedLanguage> languages;
    for (std::size_t k = 0; k < all.size(); ++k) {
        TRY(ProjectedLanguage language, language_of(source, texts, k));
        languages.push_back(std::move(language));
    }
    return languages;
}

} // namespace frustumscreen::programs
