/// The readable packs among those that the settings name, and what the table shows of each.
///
/// Threads  pure but for files; any.
/// Errors   none: a pack that cannot be read is left out.
#pragma once

#include "app/exhibit/exhibit.h"
#include "app/pack/pack.h"
#include "app/settings/settings.h"

#include <vector>

namespace frustumscreen::programs {

struct NamedPack {
    pack::PackDescription description;
    exhibit::CatalogueEntry entry; ///< with captions laid out for the settings' table
    std::vector<glm::dvec3> hull;  ///< in the prop of the settings
};
[[nodiscard]] std::vector<NamedPack> named_packs(const settings::Settings& settings);

/// Share of situations in which the first artifact's caption lies on the table, in the settings' language: a grid of
/// places all over `zone`, at each the prop turned by 0 and 45 degrees, the eye at its default place.
[[nodiscard]] double caption_share(const settings::Settings& settings, const std::vector<NamedPack>& packs,
                                   const settings::Rectangle& zone);

} // namespace frustumscreen::programs
