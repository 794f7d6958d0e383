#include "assets_baked/texts/set_artifact.h"

#include "app/pack/text_portions.h"
#include "assets_baked/texts/glyph_atlas.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace frustumscreen::texts {

namespace {

struct KeyedText {
    std::string key;
    std::string text;
    bool is_title = false;
};

using LabelLists = std::span<const std::vector<pack::PackLabel>>;

/// Adds those of a language; `key_of` gives the key of each list.
void add_labels(LabelLists lists, const std::string& language, std::string (*key_of)(std::size_t),
                std::vector<KeyedText>& texts) {
    for (std::size_t k = 0; k < lists.size(); ++k) {
        for (const pack::PackLabel& label : lists[k]) {
            if (label.language == language) {
                texts.push_back({key_of(k), label.text});
            }
        }
    }
}

std::vector<KeyedText> texts_of(const pack::PackCaption& caption, const pack::ScanRights& rights,
                                const SetLabels& labels) {
    std::vector<KeyedText> texts{{"title", caption.title, true},
                                 {"text", caption.text},
                                 {std::string(pack::attribution_key), pack::attribution_of(caption, rights)}};
    const std::vector<std::string> portions = pack::portions_of(caption.description);
    for (std::size_t k = 0; k < portions.size() && portions.size() <= pack::max_text_portions; ++k) {
        texts.push_back({pack::portion_key(k), portions[k]});
    }
    add_labels(labels.hotspots, caption.language, pack::label_key, texts);
    add_labels(labels.behaviours, caption.language, pack::behaviour_key, texts);
    add_labels(labels.torches, caption.language, pack::torch_key, texts);
    add_labels(labels.states, caption.language, pack::state_key, texts);
    std::erase_if(texts, [](const KeyedText& each) { return each.text.empty(); });
    return texts;
}

/// Keeps only the narrowest of adjacent settings that break a text alike.
void join_equal(std::vector<ShapedSetting>& settings) {
    const auto is_alike = [](const ShapedSetting& a, const ShapedSetting& b) {
        return a.width == b.width && a.height == b.height && a.glyphs.size() == b.glyphs.size();
    };
    for (std::size_t k = 0; k + 1 < settings.size();) {
        if (is_alike(settings[k], settings[k + 1])) {
            settings.erase(settings.begin() + static_cast<std::ptrdiff_t>(k));
        } else {
            ++k;
        }
    }
}

/// The smallest height over all widths; 0 without the text.
double min_height(const pack::GlyphRuns& runs, std::string_view key) {
    const pack::GlyphText* text = runs.find(key);
    if (text == nullptr || text->settings.empty()) {
        return 0.0;
    }
    return std::min_element(
               text->settings.begin(), text->settings.end(),
               [](const pack::GlyphSetting& a, const pack::GlyphSetting& b) { return a.height < b.height; })
        ->height;
}

class LanguageSetter {
public:
    LanguageSetter(const pack::PackCaption& caption, const CaptionLimits& limits, const Shaper& shaper,
                   std::vector<std::string>& notes)
        : caption_(caption), limits_(limits), shaper_(shaper), notes_(notes) {}

    void add(const KeyedText& text) {
        Result<ShapedText> shaped = shaper_.shape({.text = text.text,
                                                   .language = caption_.language,
                                                   .limits = text.is_title ? limits_.title : limits_.text,
                                                   .bold = text.is_title});
        if (!shaped) {
            note(fmt::format("{}: {}", text.key, shaped.error().message));
            return;
        }
        for (const std::string& lost : shaped->notes) {
            note(fmt::format("{}: {}", text.key, lost));
        }
        join_equal(shaped->settings);
        builder_.add(text.key, *shaped);
    }
    void check_length() {
        const std::size_t portions = pack::portions_of(caption_.description).size();
        if (portions > pack::max_text_portions) {
            note(fmt::format("description: it is as long as {} captions and is not told; allowed are {}: "
                             "shorten it to about {} letters",
                             portions, pack::max_text_portions,
                             letters_of(caption_.description) * pack::max_text_portions / portions));
        }
    }

    /// nullopt if the letters do not fit an atlas.
    [[nodiscard]] std::optional<pack::SetLanguage> finish() {
        Result<GlyphSheet> sheet = builder_.finish();
        if (!sheet) {
            note(sheet.error().message);
            return std::nullopt;
        }
        check_height(sheet->runs);
        return pack::SetLanguage{caption_.language, std::move(sheet->runs), std::move(sheet->atlas)};
    }

private:
    void check_height(const pack::GlyphRuns& runs) {
        const double text = min_height(runs, "text");
        const double height = limits_.title_em * min_height(runs, "title") + text;
        if (height > limits_.max_height && text > 0.0) {
            const double share = std::max(0.1, (limits_.max_height - height + text) / text);
            note(fmt::format("text: the caption, where it is widest, is {:.0f} times as high as its type "
                             "size, and does not fit on a table beside the prop; allowed are {:.0f} times: "
                             "shorten the text to about {} letters",
                             height / pack::em_units,
                             static_cast<double>(limits_.max_height) / pack::em_units,
                             static_cast<int>(share * static_cast<double>(letters_of(caption_.text)))));
        }
    }
    static std::size_t letters_of(std::string_view text) {
        return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
            return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
        }));
    }
    void note(const std::string& what) {
        notes_.push_back(fmt::format("texts in '{}': {}", caption_.language, what));
    }

    const pack::PackCaption& caption_;
    const CaptionLimits& limits_;
    const Shaper& shaper_;
    std::vector<std::string>& notes_;
    GlyphAtlasBuilder builder_;
};

} // namespace

SetArtifact set_artifact(std::span<const pack::PackCaption> captions, const pack::ScanRights& rights,
                         const SetLabels& labels, const CaptionLimits& limits, const Shaper& shaper) {
    SetArtifact set;
    for (const pack::PackCaption& caption : captions) {
        const std::vector<KeyedText> texts = texts_of(caption, rights, labels);
        if (texts.empty()) {
            continue;
        }
        if (const Result<void> there = shaper.fonts().check(caption.language); !there) {
            set.notes.push_back(fmt::format("texts in '{}': {}", caption.language, there.error().message));
            continue;
        }
        LanguageSetter setter(caption, limits, shaper, set.notes);
        for (const KeyedText& text : texts) {
            setter.add(text);
        }
        setter.check_length();
        if (std::optional<pack::SetLanguage> language = setter.finish()) {
            set.languages.push_back(*std::move(language));
        }
    }
    return set;
}

} // namespace frustumscreen::texts
