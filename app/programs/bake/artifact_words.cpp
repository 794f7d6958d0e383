#include "app/programs/bake/artifact_words.h"

#include "app/settings/settings.h"
#include "app/typography/caption_image.h"
#include "app/typography/captions.h"
#include "assets_baked/texts/set_artifact.h"

#include <cmath>
#include <functional>
#include <map>

namespace frustumscreen::programs {

namespace {

/// Height in metres that the prop and its shadow leave free on a table 0.5 m deep, about.
constexpr double max_caption_height_m = 0.25;

/// The kiosk's widths at the usual type size and at the smallest.
texts::CaptionLimits caption_limits() {
    texts::CaptionLimits limits;
    const double usual_em_m = settings::ExhibitSettings{}.caption_height_m;
    for (const double width_m : typography::caption_widths_m) {
        for (const double em_m : {typography::min_caption_em_m, usual_em_m}) {
            const double units = pack::em_units * width_m / em_m;
            limits.text.push_back(static_cast<std::int32_t>(std::floor(units)));
            limits.title.push_back(
                static_cast<std::int32_t>(std::floor(units / typography::caption_title_em)));
        }
    }
    limits.title_em = typography::caption_title_em;
    limits.max_height = static_cast<std::int32_t>(pack::em_units * max_caption_height_m / usual_em_m);
    return limits;
}

void set_texts(const BakeRequest& request, std::span<const pack::PackBehaviour> behaviours,
               ArtifactWords& words) {
    const Result<texts::Shaper> shaper = texts::Shaper::open();
    if (!shaper) {
        words.lost.push_back(shaper.error().message);
        return;
    }
    texts::SetLabels labels;
    for (const bake::GivenHotspot& hotspot : request.options.hotspots) {
        labels.hotspots.push_back(hotspot.labels);
    }
    for (const pack::PackBehaviour& behaviour : behaviours) {
        labels.behaviours.push_back(behaviour.titles);
    }
    for (const folder::ArtifactTorch& content : request.torches) {
        labels.torches.push_back(content.titles);
    }
    for (const folder::ArtifactState& state : request.states) {
        labels.states.push_back(state.titles);
    }
    texts::SetArtifact set =
        texts::set_artifact(request.captions, request.rights, labels, caption_limits(), *shaper);
    words.set = std::move(set.languages);
    words.lost.insert(words.lost.end(), set.notes.begin(), set.notes.end());
}

} // namespace

Result<ArtifactWords> words_of(const BakeRequest& request, std::span<const pack::PackBehaviour> behaviours) {
    ArtifactWords words;
    words.lost = request.lost;
    set_texts(request, behaviours, words);
    TRY(texts::SpokenArtifact spoken, texts::speak_artifact(request.captions, request.speech));
    words.spoken = std::move(spoken.languages);
    words.silent = std::move(spoken.silent);
    words.lost.insert(words.lost.end(), spoken.notes.begin(), spoken.notes.end());
    return words;
}

void number_titles(std::span<const pack::PackBehaviour> behaviours, std::span<const pack::PackBehaviour> kept,
                   std::vector<pack::SetLanguage>& set) {
    std::map<std::string, std::string, std::less<>> keys; // empty: the behaviour is not kept
    std::size_t next = 0;
    for (std::size_t k = 0; k < behaviours.size(); ++k) {
        const bool stays =
            next < kept.size() && kept[next].behaviour.name == behaviours[k].behaviour.name; // each name once
        keys[pack::behaviour_key(k)] = stays ? pack::behaviour_key(next++) : std::string();
    }
    for (pack::SetLanguage& language : set) {
        for (pack::GlyphText& text : language.runs.texts) {
            if (const auto found = keys.find(text.key); found != keys.end()) {
                text.key = found->second;
            }
        }
        std::erase_if(language.runs.texts, [](const pack::GlyphText& text) { return text.key.empty(); });
    }
}

} // namespace frustumscreen::programs
