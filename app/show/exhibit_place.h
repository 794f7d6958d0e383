/// The exhibit's place from the settings: projector, prop, table, buttons and guidance.
///
/// The zone's frame and the texts are left empty: a show has them (artifact_show.h).
///
/// Threads  pure; any. Takes some milliseconds.
#pragma once

#include "app/exhibit/exhibit.h"
#include "app/settings/settings.h"

namespace frustumscreen::show {

[[nodiscard]] exhibit::ExhibitPlace exhibit_place(const settings::Settings& settings);

} // namespace frustumscreen::show
