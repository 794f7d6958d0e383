// Settings: accepted by every check, or refused in one line that begins with the file's name. Accepted
// settings can be reported, and all their numbers are finite.
#include "app/settings/config_json.h"
#include "app/settings/settings.h"
#include "firmware_host/base/json.h"
#include "tests/fuzz/fuzz.h"

using namespace frustumscreen;

namespace {

/// JSON represents a non-finite number as null.
void require_no_null(const nlohmann::json& value, const std::string& report) {
    fuzz::require(!value.is_null(), "every number is finite", report);
    if (value.is_structured()) {
        for (const nlohmann::json& item : value) {
            require_no_null(item, report);
        }
    }
}

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text = fuzz::text_of(data, size);
    const auto settings = settings::parse_settings(text, "set/kiosk.toml");
    if (!settings) {
        const std::string& message = settings.error().message;
        fuzz::require(settings.error().kind == ErrorKind::BadConfiguration, "the operator acts", message);
        fuzz::require(message.starts_with("set/kiosk.toml:"), "a message names the file", message);
        fuzz::require_one_line(message);
        return 0;
    }
    // The report computes the lit zone, which takes a thousand times as long as all checks.
    if (size % 16 != 0) {
        return 0;
    }
    const std::string report = settings::config_json(*settings);
    require_no_null(nlohmann::json::parse(report), report);
    return 0;
}
