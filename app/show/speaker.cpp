#include "app/show/speaker.h"

#include "app/show/test_tone.h"

#include <algorithm>
#include <utility>

namespace frustumscreen::show {

void Speaker::begin(residency::PromptReader::Answer answer) {
    reader_.emplace(answer);
    tone_ = test_tone();
}

bool Speaker::step(const exhibit::Presentation& presentation, const PresentationShow& show,
                   const residency::SharedRecording& announcement) {
    if (!reader_) {
        return false;
    }
    reader_->want(residency::SpokenUse::Word,
                  presentation.prepares_word ? show.recording(*presentation.prepares_word) : announcement);
    reader_->want(residency::SpokenUse::Description,
                  presentation.prepares ? show.recording(*presentation.prepares) : nullptr);
    if (presentation.staff) {
        fall_silent();
        play_tones(presentation.staff_tones);
        return false;
    }
    if (is_alive(tone_number_)) {
        request_.stop();
    }
    tell(presentation, show);
    advise(presentation, show);
    return announcement && !presentation.prepares_word && announce(announcement);
}

/// Plays the latest tone at once.
void Speaker::play_tones(std::uint32_t asked) {
    if (std::exchange(tones_, asked) == asked) {
        return;
    }
    if (is_alive(tone_number_)) {
        request_.stop();
    }
    tone_number_ = request_.say(tone_);
}

bool Speaker::announce(const residency::SharedRecording& announcement) {
    const bool another = speaks() || word_ || comes_ || is_alive(std::max(description_, advice_));
    const residency::SharedReading reading = another ? nullptr : reader_->find(announcement);
    if (reading && reading->prompt) {
        advice_ = request_.say(reading->prompt);
    }
    return reading != nullptr;
}

void Speaker::end_description(bool at_pause) {
    const bool is_heard = report_.number == description_;
    if (!is_alive(description_) || ending_ == Ending::Stopped) {
        return;
    }
    // A description not heard yet waits for other speech to end, which goes on to its own next pause.
    if (!at_pause && is_heard) {
        request_.stop();
        ending_ = Ending::Stopped;
    } else if (ending_ == Ending::None) {
        request_.leave();
        ending_ = Ending::Left;
    }
}

void Speaker::tell(const exhibit::Presentation& presentation, const PresentationShow& show) {
    if (told_ != presentation.tells) {
        end_description(!presentation.tells && presentation.leaves);
        told_ = presentation.tells;
        if (told_) {
            description_ = 0;
            reading_ = nullptr;
            ending_ = Ending::None;
        }
    } else if (!told_ && !presentation.leaves) {
        end_description(false); // no pause came in time
    }
    if (reading_ && !is_alive(description_)) {
        if (description_ > advice_) {
            request_.leave(); // releases its samples
        }
        reading_ = nullptr;
    }
    comes_ = false;
    if (!told_ || description_ != 0) {
        return;
    }
    const residency::SharedRecording recording = show.recording(*told_);
    reading_ = recording ? reader_->find(recording) : nullptr;
    comes_ = recording && !reading_;
    if (reading_ && reading_->prompt) {
        if (speaks()) {
            request_.stop();
        }
        description_ = request_.say(reading_->prompt);
    }
}

void Speaker::advise(const exhibit::Presentation& presentation, const PresentationShow& show) {
    if (presentation.falls_silent) {
        word_.reset();
        if (is_alive(advice_) && advice_ > description_) {
            request_.leave();
        }
    }
    if (presentation.says) {
        word_ = presentation.says;
    }
    if (!word_) {
        return;
    }
    const residency::SharedRecording recording = show.recording(*word_);
    const residency::SharedReading reading = recording ? reader_->find(recording) : nullptr;
    if (recording && !reading) {
        word_ = word_ == presentation.prepares_word ? word_ : std::nullopt; // not needed any more
        return;
    }
    word_.reset();
    if (reading && reading->prompt) {
        advice_ = request_.say(reading->prompt);
    }
}

void Speaker::forget() {
    told_.reset();
    word_.reset();
}

void Speaker::fall_silent() {
    if (is_alive(std::max(description_, advice_))) {
        request_.stop();
    }
    forget();
}

void Speaker::hear(const sound::SoundReport& report) {
    report_ = report;
}

exhibit::SpeechProgress Speaker::narration() const {
    if (description_ == 0) {
        return {comes_ ? exhibit::SpeechProgress::State::Coming : exhibit::SpeechProgress::State::Silent, 0};
    }
    if (!is_alive(description_)) {
        return {exhibit::SpeechProgress::State::Over, 0};
    }
    if (report_.number != description_) {
        return {exhibit::SpeechProgress::State::Coming, 0};
    }
    const std::vector<Nanoseconds>& begins = reading_->portions;
    const auto next = std::upper_bound(begins.begin(), begins.end(), report_.heard);
    return {exhibit::SpeechProgress::State::Heard,
            static_cast<std::size_t>(std::max<std::ptrdiff_t>(next - begins.begin(), 1) - 1)};
}

} // namespace frustumscreen::show
