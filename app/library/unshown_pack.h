/// A pack that is named or installed but not shown, and why.
///
/// Threads  a value.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::library {

struct UnshownPack {
    std::string pack;
    std::string reason;
};

/// The list never changes.
using UnshownPacks = std::shared_ptr<const std::vector<UnshownPack>>;

/// The reason without the pack's name, with which an error's message begins.
[[nodiscard]] inline UnshownPack unshown_pack(const std::string& pack, std::string_view message) {
    const std::string place = pack + ": ";
    if (message.starts_with(place)) {
        message.remove_prefix(place.size());
    }
    return {pack, std::string(message)};
}

} // namespace frustumscreen::library
