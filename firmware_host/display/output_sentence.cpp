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

/// Says how the eyes' pictures reach the eyes, at the end of the sentence about a lit output.
struct EyeClause {
    DeviceCondition condition{DeviceHealth::Well, "display.lit"};
    std::string words; ///< empty: one picture
};

EyeClause clause_in_turn(const LitOutput& output) {
    const double hz = refresh_hz(output.mode);
    if (!output.in_turn) {
        return {
            {DeviceHealth::Impaired, "display.one_eye"},
            fmt::format("; {} cannot show the eyes in turn, so the left eye's picture is shown alone: set "
                        "eye.stereo to another layout, or use another graphics card",
                        output.card)};
    }
    if (hz < min_in_turn_hz) {
        return {{DeviceHealth::Impaired, "display.eyes_flicker"},
                fmt::format("; each eye gets {:.4g} Hz, which flickers: set display.mode to one of at least "
                            "{:.4g} Hz",
                            0.5 * hz, min_in_turn_hz)};
    }
    return {.words = fmt::format("; each eye gets {:.4g} Hz", 0.5 * hz)};
}

EyeClause clause_of(const LitOutput& output) {
    const std::string_view layout = output.eyes == EyeLayout::SideBySide ? "side by side" : "top and bottom";
    switch (output.eyes) {
    case EyeLayout::One:
        break;
    case EyeLayout::InTurn:
        return clause_in_turn(output);
    case EyeLayout::SideBySide:
    case EyeLayout::TopBottom:
        if ((output.mode.flags & mode_stereo) != 0) {
            return {.words = fmt::format("; HDMI tells it that the picture is 3D, {}", layout)};
        }
        return {{DeviceHealth::Well, "display.choose_layout"},
                fmt::format("; choose 3D, {}, in the projector's own menu", layout)};
    }
    return {};
}

DeviceState dark(MessageId id, Sentence why) {
    return {{DeviceHealth::Away, id}, why};
}

} // namespace

DeviceState state_of(const LitOutput& output) {
    const ModeTiming& mode = output.mode;
    const double hz = refresh_hz(mode);
    const EyeClause eyes = clause_of(output);
    if (output.blindly) {
        return {
            {DeviceHealth::Well, "display.lit_blindly"},
            format_sentence("{} is lit, {} x {} at {:.4g} Hz, though it says that nothing is connected; if "
                            "it stays dark, start the kernel with {}{}",
                            output.connector, mode.width, mode.height, hz,
                            kernel_argument(output.connector, mode.width, mode.height, hz), eyes.words)};
    }
    const bool other_mode = !output.as_requested && eyes.condition.health == DeviceHealth::Well;
    return {other_mode ? DeviceCondition{DeviceHealth::Impaired, "display.other_mode"} : eyes.condition,
            format_sentence("the projector at {} is lit, {} x {} at {:.4g} Hz{}{}{}{}", output.connector,
                            mode.width, mode.height, hz,
                            output.as_requested ? "" : ", because it cannot do the mode in the settings",
                            eyes.words, output.shortcoming.empty() ? "" : "; ", output.shortcoming)};
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
