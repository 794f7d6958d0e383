/// Reads the shape of a solid prop that the settings name or hold, and picks the faces that get a picture.
///
/// Errors   in `state`, one line: where the settings name it, the file, what is wrong, what to do.
/// Threads  one caller; reads a file.
#pragma once

#include "app/settings/settings.h"
#include "app/settings/table_reader.h"

namespace frustumscreen::settings {

/// Fills in `shape`, `notes` and the size of a solid. Leaves a frustum or a cube unchanged, and any prop after an
/// error.
void read_prop(ReadState& state, PropSettings& prop);

} // namespace frustumscreen::settings
