#include "firmware_host/display/output_sentence.h"

#include "firmware_host/base/format_sentence.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace frustumscreen::display {

namespace {

/// Kernel argument that declares a connector connected (Documentation/fb/modedb.rst).
std::string kernel_argument(std::string_view connector, int width, int height, double hz) {
    return fmt::format("video={}:{}x{}@{}e", connector, width, height,
                       hz > 0.0 ? std::lround(hz) : std::lround(OutputRequest{}.picture_hz));
}

DeviceState dark(MessageId id, Sentence why) {
    return {{DeviceHealth::Away, id}, why};
}

} // namespace

DeviceState state_of(const LitOutput& output) {
    const ModeTiming& mode = output.mode;
    const double hz = refresh_hz(mode);
    if (output.blindly) {
        return {
            {DeviceHealth::Well, "display.lit_blindly"},
            format_sentence("{} is lit, {} x {} at {:.4g} Hz, though it says that nothing is connected; if "
                            "it stays dark, start the kernel with {}",
                            output.connector, mode.width, mode.height, hz,
                            kernel_argument(output.connector, mode.width, mode.height, hz))};
    }
    const DeviceCondition condition = output.as_requested
                                          ? DeviceCondition{DeviceHealth::Well, "display.lit"}
                                          : DeviceCondition{DeviceHealth::Impaired, "display.other_mode"};
    return {condition,
            format_sentence("the projector at {} is lit, {} x {} at {:.4g} Hz{}{}{}", output.connector,
                            mode.width, mode.height, hz,
                            output.as_requested ? "" : ", because it cannot do the mode in the settings",
                            output.shortcoming.empty() ? "" : "; ", output.shortcoming)};
}

DeviceState why_dark(const CardSeen& card, const OutputRequest& request) {
    const auto& all = card.connectors;
    const auto named = [&request](const ConnectorSeen& seen) { return seen.name == request.connector; };
    const auto plugged = [&request, &named](const ConnectorSeen& seen) {
        return seen.plugged == Plugged::Yes && (request.connector.empty() || named(seen));
    };
    const auto mute = std::find_if(all.begin(), all.end(), plugged);
    if (choose_connector(card, request) != nullptr) {
        return {{DeviceHealth::Well, "display.soon_lit"},
                format_sentence("the projector is about to be lit")};
    }
    if (mute != all.end()) {
        return dark("display.no_mode",
                    format_sentence("the projector at {} names no mode; set display.mode and display.force",
                                    mute->name));
    }
    if (!request.connector.empty() && std::none_of(all.begin(), all.end(), named)) {
        std::string names;
        for (const ConnectorSeen& seen : all) {
            names += (names.empty() ? "" : ", ") + seen.name;
        }
        return dark(
            "display.no_such_connector",
            format_sentence("the graphics card has no connector {}; it has {}", request.connector, names));
    }
    return dark(
        "display.no_projector",
        format_sentence(
            "no projector is connected{}{}, or it is off; the exhibit lights it when it comes{}",
            request.connector.empty() ? "" : " to ", request.connector,
            request.force ? "; set display.connector to light a projector that does not report itself" : ""));
}

DeviceState why_refused(const ConnectorSeen& connector, const OutputRequest& request,
                        std::string_view reason) {
    const std::string_view before = reason.empty() ? "" : ": ";
    if (is_lit_blindly(connector, request)) {
        return dark("display.not_lit_blindly",
                    format_sentence(
                        "the graphics card does not light {}, which says that nothing is connected{}{}; "
                        "start the kernel with {}",
                        connector.name, before, reason,
                        kernel_argument(connector.name, request.width, request.height, request.refresh_hz)));
    }
    return dark("display.no_mode_taken",
                format_sentence("the graphics card refuses every mode of the projector at {}{}{}; the "
                                "exhibit goes on in the dark",
                                connector.name, before, reason));
}

} // namespace frustumscreen::display
