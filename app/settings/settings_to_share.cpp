#include "app/settings/settings_to_share.h"

#include "app/settings/toml_file.h"

#include <sstream>

namespace frustumscreen::settings {

namespace {

constexpr std::uintmax_t max_bytes = 1U << 20U;

/// The values that `shown` leaves.
template <typename Shown>
Result<std::string> rewritten(std::string_view text, toml::format_flags flags, const Shown& shown) {
    ReadState state{.file = "kiosk.toml", .folder = {}, .lines = {}, .error = std::nullopt};
    std::string shared;
    read_toml(state, text, max_bytes, [&](const toml::table& root) {
        toml::table values = root;
        shown(values);
        std::ostringstream stream;
        stream << toml::toml_formatter(values, flags) << "\n";
        shared = stream.str();
    });
    if (state.error) {
        return tl::unexpected<Error>(*std::move(state.error));
    }
    return shared;
}

} // namespace

Result<std::string> settings_to_share(std::string_view text) {
    // 0.7, not 0.69999999999999996; six digits are enough to see how a kiosk is set.
    return rewritten(text, toml::toml_formatter::default_flags | toml::format_flags::relaxed_float_precision,
                     [](toml::table& values) {
                         if (toml::table* const exhibit = values["exhibit"].as_table()) {
                             exhibit->erase("keys");
                         }
                     });
}

Result<std::string> settings_without_comments(std::string_view text) {
    return rewritten(text, toml::toml_formatter::default_flags, [](toml::table&) {});
}

} // namespace frustumscreen::settings
