#include "app/programs/batch/child_sentence.h"

#include "firmware_host/base/printable.h"

#include <fmt/format.h>

#include <csignal>
#include <cstring>
#include <string_view>

namespace frustumscreen::programs {

namespace {

constexpr std::size_t longest_sentence = 1000;

/// The last line, without the program's name: it gives the reason; earlier lines list losses.
std::string last_line(std::string_view text) {
    constexpr std::string_view name = "frustumscreen-bake: ";
    while (text.ends_with('\n')) {
        text.remove_suffix(1);
    }
    const std::size_t before = text.rfind('\n');
    std::string_view line = before == std::string_view::npos ? text : text.substr(before + 1);
    line.remove_prefix(line.starts_with(name) ? name.size() : 0);
    return printable(line, longest_sentence);
}

/// A memory limit that is too low can end a bake in this way too.
std::string signal_sentence(int signal, const ProgramLimits& limits) {
    return fmt::format("the bake was ended by signal {} ({}){}", signal, ::strsignal(signal),
                       limits.memory_bytes > 0 || signal == SIGKILL
                           ? "; perhaps it had too little memory: allow more, or fewer bakes at a time"
                           : "; this is a fault of the program: keep the scan and report it");
}

} // namespace

std::string sentence_of(const ProgramEnd& end, const ProgramLimits& limits) {
    switch (end.how) {
    case ProgramEnd::How::TooLate:
        return fmt::format(
            "the bake took longer than {:g} s and was ended; allow more time, or use a smaller scan",
            std::chrono::duration<double>(limits.time).count());
    case ProgramEnd::How::TooMuch:
        return "the bake wrote too much and was ended; keep the scan and report it";
    case ProgramEnd::How::GivenUp:
        return "the bake was ended on request";
    case ProgramEnd::How::ByItself:
        break;
    }
    if (end.status < 0) {
        return signal_sentence(-end.status, limits);
    }
    const std::string said = end.status == 0 ? std::string() : last_line(end.complaint);
    return end.status != 0 && said.empty() ? fmt::format("the bake ended with status {}", end.status) : said;
}

} // namespace frustumscreen::programs
