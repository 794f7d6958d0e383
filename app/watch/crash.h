/// The last crashes of the exhibit, read from their files (firmware_host/service/crash_record.h has the
/// format).
///
/// Threads  any; reads small files.
/// Errors   none: a file that is not such a record is ignored; a truncated one has `whole` = false.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::watch {

inline constexpr std::string_view usual_crash_folder = "/var/cache/frustumscreen/crashes";

/// Each text is one printable line.
struct Crash {
    std::int64_t unix_s = 0;
    double monotonic_s = 0.0;
    std::string boot; ///< of that monotonic clock
    std::string signal, thread;
    std::string program, system, driver; ///< versions; `driver` may be empty
    std::vector<std::string> frames;     ///< `MODULE+0xOFFSET`, from the crash outwards
    std::vector<std::string> guesses;    ///< return addresses on the stack, if the frames stop early
    bool whole = false;
};

[[nodiscard]] std::optional<Crash> parse_crash(std::string_view text);
/// The crashes, latest first.
[[nodiscard]] std::vector<Crash> read_crashes(const std::filesystem::path& folder);
/// Signal, place and thread: `SIGSEGV in swrast_dri.so+0x1f3a0, thread llvmpipe-0`.
[[nodiscard]] std::string sentence_of(const Crash& crash);

} // namespace frustumscreen::watch
