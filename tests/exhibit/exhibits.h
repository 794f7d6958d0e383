// Exhibits for tests of decisions: artifacts with a caption in each of several languages, on a table of usual size.
#pragma once

#include "app/exhibit/exhibit.h"
#include "app/exhibit/guidance_setup.h"

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

/// The shipped settings' table, without words.
inline exhibit::ExhibitPlace shipped_place() {
    const settings::Settings shipped;
    exhibit::ExhibitPlace place;
    place.prop = settings::make_prop(shipped.prop);
    place.lens_m = shipped.projector.table_from_projector.translation;
    place.picture_m = settings::picture_on_table(shipped, 0.0);
    place.guidance = exhibit::guidance_setup(shipped);
    return place;
}

/// Words of one size for these keys.
inline exhibit::AdviceLanguage words_of(const std::string& language, const std::vector<std::string>& keys,
                                        const glm::dvec2& size_m = {0.1, 0.02}) {
    exhibit::AdviceLanguage words{language, {}};
    for (const std::string& key : keys) {
        words.texts.push_back({key, {size_m}});
    }
    return words;
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
