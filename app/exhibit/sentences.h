/// The exhibit's own texts on the table: one sentence at a time, beside the prop, in the visitor's language.
///
/// A sentence fades in at the best place, stays there, and fades out before the next one.
///
/// Frames   table T, metres.
/// Time     `now` never goes back.
/// Threads  values; one caller. `find` and `place` allocate nothing.
/// Errors   none: an unknown key, or a sentence without space, shows nothing.
#pragma once

#include "app/typography/captions.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::exhibit {

/// A sentence of the exhibit's own texts.
struct AdviceText {
    std::string key;                 ///< of an advice as from words_key, of others as in the file of words
    std::vector<glm::dvec2> sizes_m; ///< as CatalogueEntry::caption_sizes_m
};
struct AdviceLanguage {
    std::string language; ///< BCP 47
    std::vector<AdviceText> texts;
};

/// One of ExhibitPlace::words.
struct WordIndex {
    std::size_t language = 0;
    std::size_t text = 0;
    [[nodiscard]] bool operator==(const WordIndex&) const = default;
};
struct PresentedAdvice {
    WordIndex word;
    std::size_t shape = 0; ///< index into its sizes
    typography::TableRectangle rectangle;
    double brightness = 0.0; ///< above 0, up to 1; a factor on linear light
};

/// The surroundings that a sentence must not overlap.
struct SentenceEnvironment {
    std::optional<typography::TablePolygon> around; ///< the prop's shadow, and the sign beside it
    std::optional<typography::TablePolygon> hidden; ///< hidden_by_prop from the eye
    glm::dvec2 prop_m{0.0};
    int quarter_turns = 0; ///< the reader's side
};

class Sentences {
public:
    static constexpr Nanoseconds leaves = std::chrono::milliseconds(250); ///< fade out

    Sentences(std::vector<AdviceLanguage> words, std::span<const glm::dvec2> picture_m);

    /// The sentence with this key, in the language nearest to `language`.
    [[nodiscard]] std::optional<WordIndex> find(std::string_view key, std::string_view language) const;
    /// Sets the other rectangles on the table.
    void set_obstacles(std::span<const typography::TableRectangle> obstacles) {
        placer_.set_obstacles(obstacles);
    }
    /// Shows `wanted`, or nothing. Returns what is shown in this step.
    [[nodiscard]] std::optional<PresentedAdvice>
    place(MonotonicTime now, const std::optional<WordIndex>& wanted, const SentenceEnvironment& environment);
    /// True if its words are visible or fade in, so that it may be spoken.
    [[nodiscard]] bool shows(MonotonicTime now, const WordIndex& word) const;
    /// True if a sentence is or will be shown: `place` uses its surroundings.
    [[nodiscard]] bool busy() const { return placed_.has_value(); }

private:
    std::vector<AdviceLanguage> words_;
    std::vector<std::string> languages_;
    typography::CaptionPlacer placer_;
    std::optional<WordIndex> placed_; ///< the sentence that has a place in `placer_`
    double share_ = 0.0;              ///< of its light; falls while another sentence is wanted
    MonotonicTime last_;
    MonotonicTime appears_; ///< when the placer received it
};

} // namespace frustumscreen::exhibit
