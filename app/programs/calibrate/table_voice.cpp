#include "app/programs/calibrate/table_voice.h"

#include "firmware_host/sound/opus_reader.h"

namespace frustumscreen::programs {

TableVoice::TableVoice(const pack::LanguageWords& words, std::unique_ptr<sound::Sound> sound, double gain_db)
    : sound_(std::move(sound)) {
    request_.set_gain_db(gain_db);
    for (const auto& [key, opus] : words.sounds) {
        if (!key.starts_with("calibration.")) {
            continue;
        }
        if (Result<sound::Prompt> prompt = sound::read_opus(opus)) {
            prompts_[key] = std::make_shared<const sound::Prompt>(*std::move(prompt));
        }
    }
}

void TableVoice::say(std::string_view key) {
    request_.stop();
    if (const auto found = prompts_.find(key); found != prompts_.end()) {
        request_.say(found->second);
    }
}

} // namespace frustumscreen::programs
