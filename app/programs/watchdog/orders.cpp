#include "app/programs/watchdog/orders.h"

#include "firmware_host/base/file.h"

#include <fmt/format.h>

namespace frustumscreen {

std::string_view Orders::order_for(Step step) {
    switch (step) {
    case Step::ResetDevice:
        return "reset-device";
    case Step::SafePicture:
        return "safe-picture";
    case Step::Reboot:
        return "reboot";
    case Step::RestartExhibit:
    case Step::LastGoodSet:
    case Step::DrawPlainly:
    case Step::BuiltIn:
    case Step::Return:
        break;
    }
    return "restart-exhibit"; // the mode changes with the restart
}

Result<void> Orders::set_mode(Mode mode) const {
    return renew_file(folder_ / "mode", as_bytes(fmt::format("{}\n", word_of(mode))));
}

Result<void> Orders::begin(Mode mode) const {
    std::error_code failed; // `set_mode` reports it, because its folder is missing then
    std::filesystem::remove_all(folder_ / "steps", failed);
    std::filesystem::create_directories(folder_ / "steps", failed);
    // The unit that takes an order has this group, but no right to override permissions; it must be able to
    // remove the file.
    std::filesystem::permissions(folder_ / "steps", std::filesystem::perms::group_write,
                                 std::filesystem::perm_options::add, failed);
    return set_mode(mode);
}

Result<void> Orders::give(Step step, Mode mode, std::string_view reason) const {
    const Result<void> is_set = set_mode(mode);
    const Result<void> is_told = renew_file(folder_ / "reason", as_bytes(fmt::format("{}\n", reason)));
    const Result<void> is_given = write_file(folder_ / "steps" / order_for(step), {});
    return !is_set ? is_set : !is_told ? is_told : is_given;
}

} // namespace frustumscreen
