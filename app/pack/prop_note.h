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

/// `prop`: the kind that the settings name. `wanted`: the kind that packs are baked for then; empty: any. Returns
/// nothing if the pack is one of these.
[[nodiscard]] inline std::optional<std::string> note_other_prop(const std::string& file,
                                                                const PackDescription& pack,
                                                                std::string_view prop,
                                                                std::string_view wanted) {
    if (wanted.empty() || pack.prop_kind == wanted) {
        return std::nullopt;
    }
    return fmt::format(
        "{}: it was baked for a {}, and the prop of the settings is a {}; bake it with --prop {}", file,
        pack.prop_kind, prop, wanted);
}

} // namespace frustumscreen::pack
