/// A pack that was baked for another kind of prop than that of the settings: whether it can be shown, and what to tell.
///
/// A pack for a frustum has the sides of the surface that eyes above the table see. The bake removed those that are
/// seen from below alone (assets_baked/bake/visibility.h), and its relief has no direction from below. A pack for a
/// cube has all sides, so it serves every prop.
///
/// Errors   one sentence: the pack lacks sides that a face of the prop would show.
/// Threads  pure; any.
#pragma once

#include "app/geometry/prop_shape.h"
#include "app/pack/pack_outline.h"
#include "app/settings/settings.h"
#include "firmware_host/base/result.h"

#include <optional>
#include <string>

namespace frustumscreen::scene {

struct ScenePlan;

/// Refuses a pack without the sides seen from below for a prop in the hand, if an eye in front of one of its lit faces
/// can be below the artifact. Only a face that looks straight up keeps every eye above it.
[[nodiscard]] Result<void> check_sides(const settings::PropSettings& prop, const geometry::PropShape& shape,
                                       const pack::PackDescription& pack);

/// For a pack that was baked for another prop and lacks only sides that no face shows; nothing for any other. It tells
/// the mean error, as measured by the bake, of what is shown first. `pack`: with all its levels.
[[nodiscard]] std::optional<std::string> note_other_prop(const std::string& file,
                                                         const settings::PropSettings& prop,
                                                         const pack::PackOutline& pack,
                                                         const ScenePlan& plan);

} // namespace frustumscreen::scene
