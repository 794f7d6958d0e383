/// The keys that the kiosk knows, as frustumscreen-import --list says them.
///
/// Threads  pure; any.
#pragma once

#include "app/library/set_file.h"
#include "app/pack/signature/signature.h"

#include <nlohmann/json_fwd.hpp>

#include <span>
#include <string>
#include <vector>

namespace frustumscreen {

struct ListedKey {
    std::string name, id;
    std::string until; ///< its last day; empty: it does not end
    std::string from;  ///< id of the key that signed for it; empty: the settings name it
    std::string since; ///< the day on which it came; empty: not known
    bool counts = true;
};

/// Those of the settings, then all that sets brought.
[[nodiscard]] std::vector<ListedKey> list_keys(std::span<const TrustedKey> settings,
                                               std::span<const CarriedKey> carried);

/// `knows_settings`: else nobody knows which keys count.
[[nodiscard]] nlohmann::ordered_json json_of(const ListedKey& key, bool knows_settings);
/// A line.
[[nodiscard]] std::string text_of(const ListedKey& key, bool knows_settings);

} // namespace frustumscreen
