/// The output's state, in one sentence for the person beside it.
///
/// Threads  pure.
#pragma once

#include "firmware_host/base/device_state.h"
#include "firmware_host/display/kms_mode.h"

#include <string_view>

namespace frustumscreen::display {

struct LitOutput {
    std::string_view connector;
    ModeTiming mode;
    bool as_requested = true;     ///< the mode satisfies the settings
    bool blindly = false;         ///< the connector reports that nothing is connected
    std::string_view shortcoming; ///< possible fault, from KmsDevice::shortcoming
    EyeLayout eyes = EyeLayout::One;
    bool in_turn = false;  ///< of EyeLayout::InTurn, both eyes' pictures are shown
    std::string_view card; ///< the graphics card's name
};
[[nodiscard]] DeviceState state_of(const LitOutput& output);

/// Why nothing is lit, or that it is about to be.
[[nodiscard]] DeviceState why_dark(const CardSeen& card, const OutputRequest& request);

/// Why the connector chosen was not lit; `reason`: a clause, or empty.
[[nodiscard]] DeviceState why_refused(const ConnectorSeen& connector, const OutputRequest& request,
                                      std::string_view reason);

} // namespace frustumscreen::display
