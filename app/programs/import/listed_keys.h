/// The kiosk's known keys, as listed by frustumscreen-import --list.
///
/// Threads  pure; any.
#pragma once

#include "app/library/set_file.h"
#include "app/pack/signature/signature.h"

#include <nlohmann/json_fwd.hpp>

#include <span>
#include <string>
#include <vector>

namespace frustumscreen::programs {

struct ListedKey {
    std::string name, id;
    std::string until; ///< last day of validity; empty: no end
    std::string from;  ///< id of the key that signed it; empty: named by the settings
    std::string since; ///< day on which it arrived; empty: not known
    bool counts = true;
};

/// The settings' keys, then all keys that sets brought.
[[nodiscard]] std::vector<ListedKey> list_keys(std::span<const pack::TrustedKey> settings,
                                               std::span<const library::CarriedKey> carried);

/// `knows_settings`: false: it is not known which keys count.
[[nodiscard]] nlohmann::ordered_json json_of(const ListedKey& key, bool knows_settings);
/// One line.
[[nodiscard]] std::string text_of(const ListedKey& key, bool knows_settings);

} // namespace frustumscreen::programs
