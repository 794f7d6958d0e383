#include "firmware_host/sound/sound_request.h"

#include <cassert>
#include <utility>

namespace frustumscreen::sound {

std::uint64_t SoundRequest::say(SharedPrompt prompt) {
    assert(prompt);
    prompt_ = std::move(prompt);
    return ++number_;
}

void SoundRequest::leave() {
    prompt_.reset();
    ++leaves_;
}

void SoundRequest::stop() {
    prompt_.reset();
    ++stops_;
}

} // namespace frustumscreen::sound
