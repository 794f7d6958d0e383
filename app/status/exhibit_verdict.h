/// The verdict on the exhibit from outside. It is well if it shows an artifact, nothing reports trouble, and each
/// device that its settings name is usable. The watchdog follows the status field `health` instead, because no
/// restart plugs in a cable.
///
/// Threads  pure; any.
#pragma once

#include "app/status/known_exhibit.h"

#include <string>
#include <string_view>

namespace frustumscreen::status {

/// The watchdog's action in the mode with this word; `word` itself if there is no such mode.
[[nodiscard]] std::string_view sentence_of_mode(std::string_view word);

struct ExhibitVerdict {
    bool runs = false; ///< its status is current
    bool well = false;
    std::string sentence; ///< without a full stop
    std::string id;       ///< of the sentence, or of the device's sentence that it repeats: subject.problem
};
[[nodiscard]] ExhibitVerdict verdict_of(const KnownExhibit& known);

} // namespace frustumscreen::status
