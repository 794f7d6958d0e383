/// Whether the exhibit is well, as far as anybody can know from outside: it shows an artifact, nobody has a complaint, and each device
/// that its settings ask for can be used. The watchdog does not go by this but by the status' `health`: no restart plugs in a cable.
///
/// Threads  pure; any.
#pragma once

#include "app/status/known_exhibit.h"

#include <string>
#include <string_view>

namespace frustumscreen {

/// What the watchdog does, by its mode's word; `word` itself where it is no mode.
[[nodiscard]] std::string_view sentence_of_mode(std::string_view word);

struct ExhibitVerdict {
    bool runs = false; ///< its status is of now
    bool well = false;
    std::string sentence; ///< without a full stop
    std::string id;       ///< of the sentence, or of what it tells of a device: subject.problem
};
[[nodiscard]] ExhibitVerdict verdict_of(const KnownExhibit& known);

} // namespace frustumscreen
