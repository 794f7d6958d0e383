#include "firmware_host/sound/sound_wish.h"

#include <cassert>
#include <utility>

namespace frustumscreen {

std::uint64_t SoundWish::say(SharedPrompt prompt) {
    assert(prompt);
    prompt_ = std::move(prompt);
    return ++number_;
}

void SoundWish::leave() {
    prompt_.reset();
    ++leaves_;
}

void SoundWish::stop() {
    prompt_.reset();
    ++stops_;
}

} // namespace frustumscreen
