#include "app/show/advice_words.h"

#include "app/exhibit/languages.h"
#include "app/pack/words_file.h"
#include "app/show/default_words.h"
#include "app/typography/caption_image.h"
#include "firmware_host/base/file.h"

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

namespace frustumscreen::show {

namespace {

constexpr std::string_view advice_prefix = "advice.";
/// Keys of the other texts that the exhibit shows.
constexpr std::string_view attract_key = "attract_line";
constexpr std::string_view room_key = "room_line"; ///< in place of the invitation, where there is a room
constexpr std::string_view fault_key = "fault.no_artifact";
/// Widths that a sentence is wrapped to, in type sizes and in falling preference: all widths that the words are set
/// for.
constexpr std::array<double, 3> widths_em{36.0, 18.0, 9.0};

/// The languages of the file that are nearest to some shown language.
std::set<std::string> nearest(const std::vector<pack::WordsLanguage>& listed,
                              const std::vector<std::string>& shown) {
    std::set<std::string> chosen;
    for (const std::string& language : shown) {
        chosen.insert(listed[exhibit::item_for(language, listed)].language);
    }
    return chosen;
}

/// The exhibit's key of a word; nothing: the exhibit does not use it. `invitation`: the file's key of the invitation.
std::optional<std::string> key_of(const pack::PlainWord& word, std::string_view invitation) {
    if (word.key == invitation) {
        return std::string(attract_key);
    }
    if (word.key.starts_with(advice_prefix)) {
        return word.key.substr(advice_prefix.size());
    }
    return word.key == fault_key ? std::optional(word.key) : std::nullopt;
}

void add_language(const pack::LanguageWords& words, const AdviceWordsRequest& request, AdviceWords& all) {
    exhibit::AdviceLanguage language{words.language, {}};
    std::vector<AdviceWord> made;
    const bool room = request.room && words.runs.find(room_key) != nullptr; // older files have none
    for (const pack::PlainWord& word : words.words) {
        const pack::GlyphText* const set = words.runs.find(word.key);
        const std::optional<std::string> key = key_of(word, room ? room_key : attract_key);
        if (!key || set == nullptr) {
            continue;
        }
        exhibit::AdviceText text{*key, {}};
        AdviceWord one{all.pictures.size(), nullptr};
        for (const double width_em : widths_em) {
            const typography::GlyphPart part{typography::CaptionRole::Text, set};
            typography::CaptionImage image =
                typography::make_caption(words.runs, words.atlas, std::span(&part, 1), request.em_m,
                                         width_em * request.em_m, request.texels_per_m);
            text.sizes_m.push_back(image.size_m);
            all.pictures.push_back(std::move(image.coverage));
        }
        if (request.spoken && word.key.starts_with(advice_prefix)) {
            one.recording = word_recording(words, word.key);
        }
        language.texts.push_back(std::move(text));
        made.push_back(std::move(one));
    }
    all.languages.push_back(std::move(language));
    all.words.push_back(std::move(made));
}

} // namespace

Result<AdviceWords> read_advice_words(const AdviceWordsRequest& request) {
    TRY(const Bytes file, read_file(request.file));
    TRY(const std::vector<pack::WordsLanguage> listed, at(request.file.string(), pack::list_words(file)));
    AdviceWords all;
    for (const std::string& language : nearest(listed, request.languages)) {
        TRY(const pack::LanguageWords words, at(request.file.string(), pack::read_words(file, language)));
        add_language(words, request, all);
    }
    return all;
}

Result<void> set_attract_line(std::span<const AttractLine> lines, const std::string& language,
                              const residency::TextStyle& style, AdviceWords& words) {
    if (lines.empty()) {
        return {};
    }
    residency::CaptionSetter setter(style);
    TRY(std::vector<typography::CaptionImage> images,
        setter.set(
            {{}, {{typography::CaptionRole::Text, {}, lines[exhibit::item_for(language, lines)].text}}}, {}));
    if (words.languages.empty()) {
        words.languages.push_back({language, {}});
        words.words.emplace_back();
    }
    const std::size_t nearest_language = exhibit::item_for(language, words.languages);
    exhibit::AdviceText line{std::string(attract_key), {}};
    const AdviceWord word{words.pictures.size(), nullptr};
    for (typography::CaptionImage& image : images) {
        line.sizes_m.push_back(image.size_m);
        words.pictures.push_back(std::move(image.coverage));
    }
    std::vector<exhibit::AdviceText>& texts = words.languages[nearest_language].texts;
    const auto old = std::find_if(texts.begin(), texts.end(),
                                  [](const exhibit::AdviceText& text) { return text.key == attract_key; });
    if (old != texts.end()) {
        AdviceWord& replaced = words.words[nearest_language][static_cast<std::size_t>(old - texts.begin())];
        for (std::size_t shape = 0; shape < old->sizes_m.size(); ++shape) {
            words.pictures[replaced.first_picture + shape] = {}; // replaced, so not shown
        }
        replaced = word;
        *old = std::move(line);
    } else {
        texts.push_back(std::move(line));
        words.words[nearest_language].push_back(word);
    }
    return {};
}

} // namespace frustumscreen::show
