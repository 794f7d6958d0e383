/// Turns the exhibit's decisions about speech into the sound to play: one voice at a time.
///
///     Presentation (says, tells, prepares) -> step -> SoundRequest -> Sound -> SoundReport -> hear -> SpeechProgress
///
/// Advice is spoken once, as soon as its recording is decoded. A description is played as long as the presentation
/// tells it; then it ends at its next pause or at once, as the presentation says. New speech stops the current one,
/// but unrequested advice waits for the pause.
///
/// Time     speech begins at the step that requests it, if its recording is decoded by then (prompt_reader.h).
/// Threads  the render thread. `step` allocates nothing.
/// Errors   none: a recording that cannot be read is silent.
#pragma once

#include "app/exhibit/exhibit.h"
#include "app/residency/prompt_reader.h"
#include "app/show/show.h"
#include "firmware_host/sound/sound.h"

#include <cstdint>
#include <optional>

namespace frustumscreen::show {

class Speaker {
public:
    /// Starts the reader. Without this call nothing is played and no thread is started.
    void begin(residency::PromptReader::Answer answer);
    /// `announcement`: to be played when nothing else is, or is about to be; null: none. Returns true if it begins in
    /// this step.
    bool step(const exhibit::Presentation& presentation, const PresentationShow& show,
              const residency::SharedRecording& announcement = nullptr);
    void hear(const sound::SoundReport& report);
    /// Call when another set is shown: forgets the previous set's decisions and ends its speech.
    void forget();
    /// Ends all speech, including what waits.
    void fall_silent();
    void set_gain_db(double gain_db) { request_.set_gain_db(gain_db); }

    [[nodiscard]] const sound::SoundRequest& request() const { return request_; }
    /// True while something is heard.
    [[nodiscard]] bool speaks() const { return report_.number != 0; }
    /// Playback of the description that the latest step told or left.
    [[nodiscard]] exhibit::SpeechProgress narration() const;

private:
    /// Plays only the tones that the staff asked for.
    void play_tones(std::uint32_t asked);
    void end_description(bool at_pause);
    void tell(const exhibit::Presentation& presentation, const PresentationShow& show);
    void advise(const exhibit::Presentation& presentation, const PresentationShow& show);
    [[nodiscard]] bool announce(const residency::SharedRecording& announcement);
    [[nodiscard]] bool is_alive(std::uint64_t number) const { return number > report_.over; }

    std::optional<residency::PromptReader> reader_;
    sound::SoundRequest request_;
    sound::SoundReport report_;
    std::optional<exhibit::DescriptionIndex> told_;
    std::uint64_t description_ = 0;    ///< its number; 0: it was not played
    residency::SharedReading reading_; ///< of the description being played
    bool comes_ = false;               ///< it is being decoded
    enum class Ending : std::uint8_t { None, Left, Stopped };
    Ending ending_ = Ending::None;           ///< how it was ended early
    std::optional<exhibit::WordIndex> word_; ///< waits until it is decoded
    std::uint64_t advice_ = 0;               ///< the number of the latest advice
    sound::SharedPrompt tone_;               ///< the staff's
    std::uint64_t tone_number_ = 0;          ///< of the latest tone
    std::uint32_t tones_ = 0;                ///< number requested so far
};

} // namespace frustumscreen::show
