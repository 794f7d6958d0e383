/// The output's state in one sentence, for the person next to the projector.
///
/// Threads  pure.
#pragma once

#include "firmware_host/base/sentence.h"
#include "firmware_host/display/kms_mode.h"

#include <string_view>

namespace frustumscreen {

struct LitOutput {
    std::string_view connector;
    ModeTiming mode;
    bool as_requested = true;     ///< the mode satisfies the settings
    bool blindly = false;         ///< the connector reports that nothing is connected
    std::string_view shortcoming; ///< possible fault, from KmsDevice::shortcoming
};
[[nodiscard]] Sentence sentence_of(const LitOutput& output);

/// Why nothing is lit, or that the projector is about to be lit.
[[nodiscard]] Sentence why_dark(const CardSeen& card, const OutputRequest& request);

/// Why the chosen connector was not lit; `reason` is a clause, or empty.
[[nodiscard]] Sentence why_refused(const ConnectorSeen& connector, const OutputRequest& request,
                                   std::string_view reason);

} // namespace frustumscreen
