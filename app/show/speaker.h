/// Turns what the exhibit decides to say into what is to be heard: one voice at a time.
///
///     Presentation (says, tells, prepares) -> step -> SoundRequest -> Sound -> SoundReport -> hear -> Narration
///
/// Advice is said once, when its words have been read. A description is heard as long as the presentation tells it; then it is
/// left at its next pause or stopped, as the presentation says. What begins while something else is spoken stops that, but
/// advice that comes by itself waits for the pause.
///
/// Time     speech begins at the step that asks for it, if its recording was read by then (prompt_reader.h).
/// Threads  the render thread. `step` allocates nothing.
/// Errors   none: what cannot be read is silent.
#pragma once

#include "app/exhibit/exhibit.h"
#include "app/residency/prompt_reader.h"
#include "app/show/show.h"
#include "firmware_host/sound/sound.h"

#include <cstdint>
#include <optional>

namespace frustumscreen {

class Speaker {
public:
    /// There is something to say: without it nothing is heard, and there is no thread that reads.
    void begin(PromptReader::Answer answer);
    /// `announcement`: what is to be said when nothing else is heard, or about to be; none: nothing. Returns whether it begins now.
    bool step(const Presentation& presentation, const ExhibitStage& stage,
              const SharedRecording& announcement = nullptr);
    void hear(const SoundReport& report);
    /// Another set is shown: what was decided of the one before names nothing of this one, and what is heard of it ends.
    void forget();
    /// What is heard ends, and nothing that waits begins.
    void fall_silent();
    void set_gain_db(double gain_db) { wish_.set_gain_db(gain_db); }

    [[nodiscard]] const SoundRequest& wish() const { return wish_; }
    /// Something is heard.
    [[nodiscard]] bool speaks() const { return report_.number != 0; }
    /// How the description is heard that the latest step told, or left.
    [[nodiscard]] SpeechProgress narration() const;

private:
    /// For the staff: nothing but the tone that they asked for.
    void play_tones(std::uint32_t asked);
    void end_description(bool at_pause);
    void tell(const Presentation& presentation, const ExhibitStage& stage);
    void advise(const Presentation& presentation, const ExhibitStage& stage);
    [[nodiscard]] bool announce(const SharedRecording& announcement);
    [[nodiscard]] bool is_alive(std::uint64_t number) const { return number > report_.over; }

    std::optional<PromptReader> reader_;
    SoundRequest wish_;
    SoundReport report_;
    std::optional<DescriptionIndex> told_;
    std::uint64_t description_ = 0; ///< its number; 0: it was not said
    SharedReading reading_;         ///< of the description that was said
    bool comes_ = false;            ///< it is being read
    enum class Ending : std::uint8_t { None, Left, Stopped };
    Ending ending_ = Ending::None;  ///< of it, before its time
    std::optional<WordIndex> word_; ///< waits until it was read
    std::uint64_t advice_ = 0;      ///< the number of the latest
    SharedPrompt tone_;             ///< the staff's
    std::uint64_t tone_number_ = 0; ///< of the latest
    std::uint32_t tones_ = 0;       ///< asked for until now
};

} // namespace frustumscreen
