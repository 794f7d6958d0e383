#include "app/status/status_card.h"

#include "firmware_host/base/printable.h"
#include "firmware_host/base/words_of_time.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace frustumscreen::status {

namespace {

/// In the order in which a technician on the telephone asks for them.
constexpr std::array<std::string_view, 13> on_card{
    "projector",          "tracker",     "camera",   "buttons", "sound",
    "calibration in use", "calibration", "watchdog", "machine", "last faults",
    "left out",           "errors",      "system"};

std::string plain(std::string_view text) {
    std::string line = printable(text, max_card_line_bytes);
    std::replace_if(
        line.begin(), line.end(), [](char c) { return static_cast<unsigned char>(c) > 126; }, '?');
    return line;
}

std::string packs_line(const StatusReport& status) {
    if (!status.set || status.set->packs.empty()) {
        return fmt::format("packs: {}", "the packs of the settings");
    }
    std::string text = fmt::format("packs: set {}:", status.set->shown);
    for (const library::InstalledPack& pack : status.set->packs) {
        text += " " + (pack.id.empty() ? pack.sha256.substr(0, 8) : pack.id);
    }
    return text;
}

} // namespace

std::string status_card(std::string_view verdict, const StatusReport& status,
                        std::span<const StatusLine> lines, std::time_t now) {
    constexpr std::string_view cut = "...\n";
    std::string card;
    bool is_full = false;
    const auto add = [&](std::string_view text) {
        const std::string line = plain(text) + "\n";
        if (!is_full) {
            is_full = card.size() + line.size() + cut.size() > max_card_bytes;
            card += is_full ? std::string(cut) : line;
        }
    };
    add(fmt::format("FrustumScreen {}, {:%Y-%m-%d %H:%M}", status.versions.program,
                    fmt::localtime(std::max<std::time_t>(now, 0))));
    add(verdict);
    for (const std::string_view name : on_card) {
        const auto line = std::find_if(lines.begin(), lines.end(),
                                       [&](const StatusLine& each) { return each.name == name; });
        if (line != lines.end()) {
            add(fmt::format("{}: {}", name, line->text));
        }
        if (name == "calibration in use") {
            add(packs_line(status));
            add(fmt::format("it runs for {}", words_of_time(status.uptime_s.value_or(0.0))));
        }
    }
    return card;
}

} // namespace frustumscreen::status
