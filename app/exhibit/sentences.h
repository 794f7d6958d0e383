/// The exhibit's own words on the table: one sentence at a time, beside the prop, in the visitor's language.
///
/// A sentence fades in at the best place that there is, stays there, and fades out before the next one comes.
///
/// Frames   table T, metres.
/// Time     `now` never goes back.
/// Threads  values; one caller. `find` and `place` allocate nothing.
/// Errors   none: a key that is not there, and a sentence without room, are not shown.
#pragma once

#include "app/typography/captions.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen {

/// A sentence of the exhibit's own words.
struct AdviceText {
    std::string key; ///< of an advice as words_key gives it, of others as the file of words has it
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
    TableRectangle rectangle;
    double brightness = 0.0; ///< above 0, up to 1; a factor on linear light
};

/// What a sentence lies beside.
struct SentenceEnvironment {
    std::optional<TablePolygon> around; ///< the prop's shadow, and the sign beside it
    std::optional<TablePolygon> hidden; ///< hidden_by_prop from the eye
    glm::dvec2 prop_m{0.0};
    int quarter_turns = 0; ///< the reader's side
};

class Sentences {
public:
    static constexpr Nanoseconds leaves = std::chrono::milliseconds(250); ///< to fade out

    Sentences(std::vector<AdviceLanguage> words, std::span<const glm::dvec2> picture_m);

    /// In the language nearest to `language`.
    [[nodiscard]] std::optional<WordIndex> find(std::string_view key, std::string_view language) const;
    /// What else lies on the table.
    void set_obstacles(std::span<const TableRectangle> obstacles) { placer_.set_obstacles(obstacles); }
    /// `wanted` is shown, or nothing more. Returns what is.
    [[nodiscard]] std::optional<PresentedAdvice>
    place(MonotonicTime now, const std::optional<WordIndex>& wanted, const SentenceEnvironment& environment);
    /// Its words are seen, or fade in: it may be spoken.
    [[nodiscard]] bool shows(MonotonicTime now, const WordIndex& word) const;
    /// Something is or will be shown: `place` looks at its surroundings.
    [[nodiscard]] bool busy() const { return lies_.has_value(); }

private:
    std::vector<AdviceLanguage> words_;
    std::vector<std::string> languages_;
    CaptionPlacer placer_;
    std::optional<WordIndex> lies_; ///< that the placer has
    double share_ = 0.0;            ///< of its light; it falls while another is wanted
    MonotonicTime last_;
    MonotonicTime appears_; ///< when the placer was given it
};

} // namespace frustumscreen
