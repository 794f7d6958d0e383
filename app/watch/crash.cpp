#include "app/watch/crash.h"

#include "firmware_host/base/crash_file.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

namespace frustumscreen::watch {

namespace {

constexpr std::uintmax_t max_bytes = 16384;
constexpr std::size_t max_value = 256;
constexpr std::size_t max_places = 64;
constexpr std::int64_t latest_unix_s = 253'402'300'799; ///< the year 9999
constexpr std::string_view compiled = "compiled+";

std::int64_t whole_number(std::string_view text) {
    std::int64_t value = 0;
    std::from_chars(text.data(), text.data() + text.size(), value);
    return std::max<std::int64_t>(value, 0);
}

void take(Crash& crash, std::string_view key, std::string_view value) {
    const std::array<std::pair<std::string_view, std::string*>, 6> texts{{{"boot", &crash.boot},
                                                                          {"signal", &crash.signal},
                                                                          {"thread", &crash.thread},
                                                                          {"program", &crash.program},
                                                                          {"system", &crash.system},
                                                                          {"driver", &crash.driver}}};
    for (const auto& [name, text] : texts) {
        if (key == name) {
            *text = printable(value, max_value);
        }
    }
    if (key == "unix_s") {
        crash.unix_s = std::min(whole_number(value), latest_unix_s);
    } else if (key == "monotonic_ms") {
        crash.monotonic_s = 1e-3 * static_cast<double>(whole_number(value));
    } else if (key == "frame" && crash.frames.size() < max_places) {
        crash.frames.push_back(printable(value, max_value));
    } else if (key == "guess" && crash.guesses.size() < max_places) {
        crash.guesses.push_back(printable(value, max_value));
    } else if (key == "end") {
        crash.whole = true;
    }
}

std::string_view next_line(std::string_view& text) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    return line;
}

/// The first frame or guess that lies in a file.
const std::string* named_place(const Crash& crash) {
    for (const std::vector<std::string>* places : {&crash.frames, &crash.guesses}) {
        const auto named = std::find_if(places->begin(), places->end(), [](const std::string& place) {
            return !place.starts_with(compiled);
        });
        if (named != places->end()) {
            return &*named;
        }
    }
    return nullptr;
}

} // namespace

std::optional<Crash> parse_crash(std::string_view text) {
    if (next_line(text) != crash_file_begin) {
        return std::nullopt;
    }
    Crash crash;
    while (!text.empty()) {
        const std::string_view line = next_line(text);
        const std::size_t space = std::min(line.find(' '), line.size());
        take(crash, line.substr(0, space), line.substr(std::min(space + 1, line.size())));
    }
    return crash.signal.empty() ? std::nullopt : std::optional(std::move(crash));
}

std::vector<Crash> read_crashes(const std::filesystem::path& folder) {
    std::vector<Crash> crashes;
    for (int k = 1; k <= crash_file_count; ++k) {
        const Result<Bytes> text = read_file(folder / crash_file_name(k), max_bytes);
        if (std::optional<Crash> crash = text ? parse_crash(as_text(*text)) : std::nullopt) {
            crashes.push_back(*std::move(crash));
        }
    }
    std::stable_sort(crashes.begin(), crashes.end(),
                     [](const Crash& a, const Crash& b) { return a.unix_s > b.unix_s; });
    return crashes;
}

std::string sentence_of(const Crash& crash) {
    const bool is_compiled = !crash.frames.empty() && crash.frames.front().starts_with(compiled);
    const std::string* const place = named_place(crash);
    std::string text = crash.signal;
    if (is_compiled) {
        text += " in code that the graphics driver compiled";
        text += place != nullptr ? ", called from " + *place : std::string();
    } else if (place != nullptr) {
        text += " in " + *place;
    }
    return crash.thread.empty() ? text : fmt::format("{}, thread {}", text, crash.thread);
}

} // namespace frustumscreen::watch
