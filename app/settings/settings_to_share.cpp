#include "app/settings/settings_to_share.h"

#include "app/settings/toml_file.h"

#include <sstream>

namespace frustumscreen::settings {

namespace {

constexpr std::uintmax_t max_bytes = 1U << 20U;

} // namespace

Result<std::string> settings_to_share(std::string_view text) {
    ReadState state{.file = "kiosk.toml", .folder = {}, .lines = {}, .error = std::nullopt};
    std::string shared;
    read_toml(state, text, max_bytes, [&](const toml::table& root) {
        toml::table without = root;
        if (toml::table* const exhibit = without["exhibit"].as_table()) {
            exhibit->erase("keys");
        }
        std::ostringstream stream;
        // 0.7, not 0.69999999999999996; six digits are enough to see how a kiosk is set.
        stream << toml::toml_formatter(without, toml::toml_formatter::default_flags |
                                                    toml::format_flags::relaxed_float_precision)
               << "\n";
        shared = stream.str();
    });
    if (state.error) {
        return tl::unexpected<Error>(*std::move(state.error));
    }
    return shared;
}

} // namespace frustumscreen::settings
