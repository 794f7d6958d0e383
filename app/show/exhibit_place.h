/// The exhibit's place as the settings have it: the projector, the prop, the table, the buttons, who is guided.
///
/// Its zone's frame and its words are left empty: they are what a show has (artifact_show.h).
///
/// Threads  pure; any. Takes some milliseconds.
#pragma once

#include "app/exhibit/exhibit.h"
#include "app/settings/settings.h"

namespace frustumscreen {

[[nodiscard]] ExhibitPlace exhibit_place(const Settings& settings);

} // namespace frustumscreen
