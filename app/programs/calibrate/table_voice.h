/// Speaks the words on the table, in the house's language.
///
/// Threads  one caller. The constructor decodes all prompts: some sixty short sentences.
/// Errors   what cannot be decoded is silent.
#pragma once

#include "app/pack/words_file.h"
#include "firmware_host/base/time.h"
#include "firmware_host/sound/sound.h"

#include <map>
#include <memory>
#include <string>
#include <string_view>

namespace frustumscreen::programs {

class TableVoice {
public:
    TableVoice(const pack::LanguageWords& words, std::unique_ptr<sound::Sound> sound, double gain_db);

    /// Interrupts the current prompt. A key without a recording is silent.
    void say(std::string_view key);
    void poll(MonotonicTime now) { static_cast<void>(sound_->poll(now, request_)); }

private:
    std::map<std::string, sound::SharedPrompt, std::less<>> prompts_;
    std::unique_ptr<sound::Sound> sound_;
    sound::SoundRequest request_;
};

} // namespace frustumscreen::programs
