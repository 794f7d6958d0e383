#include "app/programs/watchdog/orders.h"

#include "firmware_host/base/file.h"

#include <fmt/format.h>

namespace frustumscreen::programs {

std::string_view Orders::order_for(watch::Step step) {
    switch (step) {
    case watch::Step::ResetDevice:
        return "reset-device";
    case watch::Step::SafePicture:
        return "safe-picture";
    case watch::Step::Reboot:
        return "reboot";
    case watch::Step::RestartExhibit:
    case watch::Step::LastGoodSet:
    case watch::Step::DrawPlainly:
    case watch::Step::BuiltIn:
    case watch::Step::Return:
        break;
    }
    return "restart-exhibit"; // the mode changes with the restart
}

Result<void> Orders::set_mode(watch::Mode mode) const {
    return renew_file(folder_ / "mode", as_bytes(fmt::format("{}\n", watch::word_of(mode))));
}

Result<void> Orders::begin(watch::Mode mode) const {
    std::error_code failed; // `set_mode` reports it, because its folder is missing then
    std::filesystem::remove_all(folder_ / "steps", failed);
    std::filesystem::create_directories(folder_ / "steps", failed);
    // The unit that takes an order has this group, but no right to override permissions; it must be able to
    // remove the file.
    std::filesystem::permissions(folder_ / "steps", std::filesystem::perms::group_write,
                                 std::filesystem::perm_options::add, failed);
    return set_mode(mode);
}

Result<void> Orders::give(watch::Step step, watch::Mode mode, std::string_view reason) const {
    const Result<void> is_set = set_mode(mode);
    const Result<void> is_told = renew_file(folder_ / "reason", as_bytes(fmt::format("{}\n", reason)));
    const Result<void> is_given = write_file(folder_ / "steps" / order_for(step), {});
    return !is_set ? is_set : !is_told ? is_told : is_given;
}

} // namespace frustumscreen::programs
