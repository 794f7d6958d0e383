#include "firmware_host/base/local_time.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <cstdlib>
#include <ctime>
#include <filesystem>

namespace frustumscreen {

namespace {

constexpr const char* zones = "/usr/share/zoneinfo";

} // namespace

bool has_time_zone(const std::string& name) {
    std::error_code failed;
    return !name.empty() && name.find("..") == std::string::npos &&
           std::filesystem::is_regular_file(std::filesystem::path(zones) / name, failed);
}

bool use_time_zone(const std::string& name) {
    if (!has_time_zone(name)) { // libc would silently use UTC
        return false;
    }
    ::setenv("TZ", (":" + name).c_str(), 1);
    ::tzset();
    return true;
}

std::chrono::seconds local_offset_at(std::chrono::sys_seconds time) {
    const std::time_t seconds = std::chrono::system_clock::to_time_t(time);
    std::tm local{};
    return std::chrono::seconds(::localtime_r(&seconds, &local) != nullptr ? local.tm_gmtoff : 0);
}

std::string utc_text(std::chrono::system_clock::time_point time) {
    return fmt::format("{:%FT%TZ}", fmt::gmtime(std::chrono::system_clock::to_time_t(time)));
}

std::string local_time_text(std::chrono::sys_seconds time) {
    const std::chrono::seconds offset = local_offset_at(time);
    const auto minutes = std::chrono::duration_cast<std::chrono::minutes>(std::chrono::abs(offset)).count();
    return fmt::format("{:%FT%T}{}{:02}:{:02}",
                       fmt::gmtime(std::chrono::system_clock::to_time_t(time + offset)),
                       offset.count() < 0 ? '-' : '+', minutes / 60, minutes % 60);
}

} // namespace frustumscreen
