#include "app/exhibit/advice_presenter.h"

#include <utility>

namespace frustumscreen::exhibit {

SentenceEnvironment environment_of(const ExhibitPlace& place, const DrawnPose& drawn, const glm::dvec3& eye_m,
                                   int quarter_turns) {
    return {.around = area_hidden_by(place.prop, drawn, place.lens_m),
            .hidden = area_hidden_by(place.prop, drawn, eye_m),
            .prop_m = glm::dvec2(drawn.table_from_prop.translation),
            .quarter_turns = quarter_turns};
}

void AdvicePresenter::set_words(std::vector<AdviceLanguage> words, std::span<const glm::dvec2> picture_m) {
    sentences_ = Sentences(std::move(words), picture_m);
    spoken_.reset();
    speech_due_ = false;
}

void AdvicePresenter::hear(bool speaking) {
    if (speaking_ && !speaking) {
        spoken_.reset();
    }
    speaking_ = speaking;
}

AdvicePresenter::Output AdvicePresenter::step(MonotonicTime now, const Input& input) {
    const bool signs = input.note.sign && input.guidance != nullptr;
    SentenceEnvironment environment;
    if (signs || input.word || sentences_.busy()) {
        environment = environment_of(input.place, input.drawn, input.eye_m, input.quarter_turns);
    }
    sign_.reset();
    if (signs && environment.around) {
        sign_ =
            place_sign(*input.guidance, now, *environment.around, input.place.picture_m, input.quarter_turns);
        if (sign_) {
            environment.around = typography::hull_of(*environment.around, sign_->corners_m);
        }
    }
    Output output;
    output.words = sentences_.place(now, input.word, environment);
    speak(now, input, output);
    return output;
}

void AdvicePresenter::speak(MonotonicTime now, const Input& input, Output& output) {
    if (spoken_ && spoken_ != input.word) {
        spoken_.reset();
        output.falls_silent = true;
    }
    const guidance::Guidance* const guidance = input.guidance;
    speech_due_ = guidance != nullptr &&
                  (guidance->speak || (speech_due_ && guidance->stage == guidance::GuidanceStage::Voice));
    if (speech_due_ && input.word && input.note.voice && sentences_.shows(now, *input.word)) {
        output.says = input.word;
        spoken_ = input.word;
        speech_due_ = false;
    }
}

} // namespace frustumscreen::exhibit
