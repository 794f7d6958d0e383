/// Checks that prop, projector, eyes and the screen behind the table fit together.
///
/// Errors   collected in `fitness`; the first one is kept.
/// Threads  pure; any.
#pragma once

#include "app/settings/fitness.h"
#include "app/settings/settings.h"

#include <string_view>

namespace frustumscreen::settings {

void check_outputs(const Settings& settings, Fitness& fitness);

/// The lens must not fold the picture: up to 1.1 times the corners' r^2, each direction has a place of its own.
void check_lens(const geometry::Pinhole& pinhole, std::string_view key, Fitness& fitness);

} // namespace frustumscreen::settings
