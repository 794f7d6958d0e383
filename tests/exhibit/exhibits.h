// Exhibits for tests of decisions: artifacts with a caption in each of several languages, on a table of usual size.
#pragma once

#include "app/exhibit/exhibit.h"

#include <string>
#include <vector>

namespace frustumscreen::sample {

inline const MonotonicTime start{std::chrono::seconds(100)};

inline exhibit::ExhibitPlace place() {
    exhibit::ExhibitPlace place;
    place.prop = geometry::make_frustum({});
    place.lens_m = {0.0, 0.3, 1.4};
    place.picture_m = {{-0.4, -0.25}, {0.4, -0.25}, {0.4, 0.25}, {-0.4, 0.25}};
    return place;
}

inline exhibit::Exhibit exhibit(std::size_t artifacts, const std::vector<std::string>& languages,
                                std::size_t buttons = 3) {
    const exhibit::CatalogueEntry entry{languages, {languages.size(), {{0.2, 0.05}, {0.1, 0.1}}}};
    exhibit::ExhibitPlace where = place();
    where.buttons = buttons;
    return {exhibit::Catalogue(artifacts, entry), where, "en", start};
}

/// The situation with the prop at rest; its pose is unknown from `lost` on.
inline tracking::TrackedState tracked_state(MonotonicTime now, std::optional<MonotonicTime> lost = {}) {
    tracking::TrackedState tracked_state;
    tracked_state.eye_m = {0.0, -0.55, 0.5};
    tracked_state.prop_known = !lost;
    tracked_state.prop_age = lost ? now - *lost : Nanoseconds(0);
    return tracked_state;
}

} // namespace frustumscreen::sample
