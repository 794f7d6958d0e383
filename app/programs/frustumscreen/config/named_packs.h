/// The packs that settings name, as far as they can be read, with what the table shows of each.
///
/// Threads  pure but for files; any.
/// Errors   none: a pack that cannot be read is left out.
#pragma once

#include "app/exhibit/exhibit.h"
#include "app/pack/pack.h"
#include "app/settings/settings.h"

#include <vector>

namespace frustumscreen {

struct NamedPack {
    PackDescription description;
    CatalogueEntry entry;         ///< its captions, laid out for the settings' table
    std::vector<glm::dvec3> hull; ///< in the settings' prop
};
[[nodiscard]] std::vector<NamedPack> named_packs(const Settings& settings);

/// Of a grid of places all over `zone`, each with the prop turned by 0 and 45 degrees and the eye at its default place, the share at which
/// the first artifact's caption lies on the table, in the settings' language.
[[nodiscard]] double caption_share(const Settings& settings, const std::vector<NamedPack>& packs,
                                   const Rectangle& zone);

} // namespace frustumscreen
