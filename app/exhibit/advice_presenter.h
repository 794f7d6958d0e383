/// The exhibit's own message to the visitor in its three forms: a sign and a sentence on the table, and the sentence's
/// speech, which waits until its words are visible.
///
/// Frames   table T, metres.
/// Time     `now` never goes back.
/// Threads  values; one caller. `step` allocates nothing.
/// Errors   none: a sign or a sentence without space is not shown.
#pragma once

#include "app/exhibit/advice_sign.h"
#include "app/exhibit/catalogue.h"
#include "app/exhibit/idle_pose.h"
#include "app/exhibit/sentences.h"
#include "app/exhibit/states.h"

#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace frustumscreen::exhibit {

/// The surroundings of a text that stands beside the artifact's place. `quarter_turns`: the reader's side.
[[nodiscard]] SentenceEnvironment environment_of(const ExhibitPlace& place, const DrawnPose& drawn,
                                                 const glm::dvec3& eye_m, int quarter_turns);

class AdvicePresenter {
public:
    AdvicePresenter(std::vector<AdviceLanguage> words, std::span<const glm::dvec2> picture_m)
        : sentences_(std::move(words), picture_m) {}
    /// Replaces the words; nothing is said any more.
    void set_words(std::vector<AdviceLanguage> words, std::span<const glm::dvec2> picture_m);
    /// Sets the other rectangles on the table.
    void set_obstacles(std::span<const typography::TableRectangle> obstacles) {
        sentences_.set_obstacles(obstacles);
    }
    /// `speaking`: something is being spoken.
    void hear(bool speaking);
    [[nodiscard]] bool speaking() const { return speaking_; }
    /// As Sentences::find.
    [[nodiscard]] std::optional<WordIndex> find(std::string_view key, std::string_view language) const {
        return sentences_.find(key, language);
    }
    /// The advice of the latest step.
    [[nodiscard]] const std::optional<PlacedSign>& sign() const { return sign_; }

    struct Input {
        const StateNote& note;
        const guidance::Guidance* guidance = nullptr; ///< null: no advice
        std::optional<WordIndex> word;                ///< the sentence to show
        const ExhibitPlace& place;
        const DrawnPose& drawn;
        glm::dvec3 eye_m{0.0};
        int quarter_turns = 0; ///< the reader's side
    };
    struct Output {
        std::optional<PresentedAdvice> words;
        std::optional<WordIndex> says; ///< sentence whose speech begins in this step
        bool falls_silent = false;     ///< the sentence being spoken does not apply any more
    };
    [[nodiscard]] Output step(MonotonicTime now, const Input& input);

private:
    void speak(MonotonicTime now, const Input& input, Output& output);

    Sentences sentences_;
    std::optional<PlacedSign> sign_;
    bool speaking_ = false;           ///< speech is heard
    bool speech_due_ = false;         ///< until the words are visible on the table
    std::optional<WordIndex> spoken_; ///< the sentence that may still be heard
};

} // namespace frustumscreen::exhibit
