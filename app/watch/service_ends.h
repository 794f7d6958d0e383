/// Number and reasons of the ends of the exhibit's process since the machine was started.
///
/// File     a line for each end, appended by the service manager: the monotonic clock in seconds, and
///          SERVICE_RESULT, EXIT_CODE and EXIT_STATUS of systemd.exec(5): `1234.56 watchdog killed KILL`.
/// Threads  values; any.
/// Errors   other lines are ignored.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace frustumscreen::watch {

/// The values of SERVICE_RESULT, with their meaning; the last one stands for all others.
struct ServiceResult {
    std::string_view word;
    std::string_view sentence;
};
inline constexpr std::array<ServiceResult, 11> service_results{{
    {"success", "it was told to stop"},
    {"exit-code", "it ended with an error"},
    {"signal", "a signal killed it"},
    {"core-dump", "it crashed"},
    {"watchdog", "it stopped reporting to systemd"},
    {"timeout", "it took too long to start or to stop"},
    {"oom-kill", "it took too much memory"},
    {"protocol", "it ended before it was ready"},
    {"resources", "the machine could not start it"},
    {"start-limit-hit", "it ended too often"},
    {"other", "systemd ended it for another reason"},
}};

struct ServiceEnd {
    double monotonic_s = 0.0;
    std::size_t result = 0;  ///< index into service_results
    std::string code;        ///< exited, killed, dumped; printable
    std::string exit_status; ///< a number, or a signal's name; printable
};

struct ServiceEnds {
    std::array<std::uint64_t, service_results.size()> counts{}; ///< for each entry of service_results
    std::optional<ServiceEnd> last;
    [[nodiscard]] std::uint64_t count() const;
};

/// nullopt: the line is not an end.
[[nodiscard]] std::optional<ServiceEnd> parse_service_end(std::string_view line);
/// True unless it was told to stop.
[[nodiscard]] inline bool is_failure(const ServiceEnd& end) {
    return service_results.at(end.result).word != "success";
}
[[nodiscard]] ServiceEnds parse_service_ends(std::string_view text);

} // namespace frustumscreen::watch
