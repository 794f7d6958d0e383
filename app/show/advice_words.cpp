#include "app/show/advice_words.h"

#include "app/exhibit/caption_image.h"
#include "app/exhibit/languages.h"
#include "app/pack/words_file.h"
#include "app/scene/scene_plan.h"
#include "firmware_host/base/file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <set>
#include <string_view>

namespace frustumscreen {

namespace {

constexpr std::string_view advice_prefix = "advice.";
/// What else is shown of the exhibit's own words.
constexpr std::array<std::string_view, 2> other_keys{"attract_line", "fault.no_artifact"};
/// Widths that a sentence is wrapped to, in type sizes and in falling preference: all that words are set for.
constexpr std::array<double, 3> widths_em{36.0, 18.0, 9.0};

/// Each language of the file that is the nearest one to some language that is shown.
std::set<std::string> nearest(const std::vector<WordsLanguage>& listed,
                              const std::vector<std::string>& shown) {
    std::vector<std::string> there;
    std::transform(listed.begin(), listed.end(), std::back_inserter(there),
                   [](const WordsLanguage& language) { return language.language; });
    std::set<std::string> chosen;
    for (const std::string& language : shown) {
        chosen.insert(there[caption_for(language, there)]);
    }
    return chosen;
}

SharedRecording recording_of(const LanguageWords& words, const std::string& key) {
    const auto sound = words.sounds.find(key);
    if (sound == words.sounds.end()) {
        return nullptr;
    }
    return std::make_shared<const Recording>(Recording{
        fmt::format("{} in '{}'", key, words.language), sound->second, {}, words.language, key, {}});
}

/// The key that the exhibit asks for; nothing: it asks for none.
std::optional<std::string> key_of(const PlainWord& word) {
    if (word.key.starts_with(advice_prefix)) {
        return word.key.substr(advice_prefix.size());
    }
    return std::find(other_keys.begin(), other_keys.end(), word.key) != other_keys.end()
               ? std::optional(word.key)
               : std::nullopt;
}

Result<void> add_language(const LanguageWords& words, const AdviceWordsRequest& request, GpuStore& store,
                          AdviceWords& all) {
    AdviceLanguage language{words.language, {}};
    std::vector<AdviceWord> made;
    for (const PlainWord& word : words.words) {
        const GlyphText* const set = words.runs.find(word.key);
        const std::optional<std::string> key = key_of(word);
        if (!key || set == nullptr) {
            continue;
        }
        AdviceText text{*key, {}};
        AdviceWord one;
        for (const double width_em : widths_em) {
            const CaptionImage image = make_caption(words.runs, words.atlas, nullptr, set, request.em_m,
                                                    width_em * request.em_m, request.texels_per_m);
            const Result<TextureId> texture = store.upload(image.coverage);
            if (!texture) {
                return tl::unexpected<Error>(texture.error());
            }
            all.planned_gpu_bytes += caption_gpu_bytes(image.coverage.width, image.coverage.height);
            text.sizes_m.push_back(image.size_m);
            one.textures.push_back(*texture);
        }
        if (request.spoken && word.key.starts_with(advice_prefix)) {
            one.recording = recording_of(words, word.key);
        }
        language.texts.push_back(std::move(text));
        made.push_back(std::move(one));
    }
    all.languages.push_back(std::move(language));
    all.words.push_back(std::move(made));
    return {};
}

} // namespace

Result<AdviceWords> load_advice_words(const AdviceWordsRequest& request, GpuStore& store) {
    const Result<Bytes> file = read_file(request.file);
    if (!file) {
        return tl::unexpected<Error>(file.error());
    }
    const Result<std::vector<WordsLanguage>> listed = list_words(*file);
    if (!listed) {
        return at(request.file.string(), listed.error());
    }
    AdviceWords all;
    for (const std::string& language : nearest(*listed, request.languages)) {
        const Result<LanguageWords> words = read_words(*file, language);
        if (!words) {
            return at(request.file.string(), words.error());
        }
        if (Result<void> added = add_language(*words, request, store, all); !added) {
            return tl::unexpected<Error>(added.error());
        }
    }
    return all;
}

} // namespace frustumscreen
