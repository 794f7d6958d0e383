// A kiosk's copy from a stick: refused in one line, or all of it is what the exhibit's own readers take, and written again
// it reads the same.
#include "app/kiosk_copy/kiosk_copy.h"
#include "app/settings/calibration.h"
#include "app/settings/settings.h"
#include "tests/fuzz/fuzz.h"

using namespace frustumscreen;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto copy = parse_kiosk_copy(as_bytes(fuzz::text_of(data, size)));
    if (!copy) {
        fuzz::require_one_line(copy.error().message);
        return 0;
    }
    fuzz::require(!copy->settings || parse_settings(*copy->settings, "kiosk.toml"), "settings are settings");
    fuzz::require(!copy->calibration || parse_calibration(*copy->calibration, "c"), "a calibration is one");
    for (std::size_t k = 0; k < copy->days.size(); ++k) {
        fuzz::require(copy->days[k].day.has_value(), "a day has its day");
        fuzz::require(k == 0 || copy->days[k - 1].day < copy->days[k].day,
                      "each day is there once, in order");
    }
    const auto bytes = write_kiosk_copy(*copy);
    if (!bytes) { // days are written with spaces
        fuzz::require(bytes.error().id.view() == "kiosk_copy.too_large", "it can be written",
                      bytes.error().message);
        return 0;
    }
    const auto again = parse_kiosk_copy(*bytes);
    fuzz::require(again && again->settings == copy->settings && again->calibration == copy->calibration &&
                      again->days == copy->days,
                  "written again it reads the same");
    return 0;
}
