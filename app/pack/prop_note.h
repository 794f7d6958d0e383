/// A note for the staff: a pack was baked for another kind of prop than that of the settings. The pack is still
/// shown; its relief and the choice of its levels are the other prop's.
///
/// Threads  pure; any.
#pragma once

#include "app/pack/pack.h"

#include <fmt/format.h>

#include <optional>
#include <string>

namespace frustumscreen::pack {

/// `wanted`: the kind that the settings name. Returns nothing if they agree.
[[nodiscard]] inline std::optional<std::string>
note_other_prop(const std::string& file, const PackDescription& pack, std::string_view wanted) {
    if (pack.prop_kind == wanted) {
        return std::nullopt;
    }
    return fmt::format(
        "{}: it was baked for a {}, and the prop of the settings is a {}; bake it with --prop {}", file,
        pack.prop_kind, wanted, wanted);
}

} // namespace frustumscreen::pack
