/// The data of the sections `cells` and `behaviours`: JSON from and to a world. FORMAT.md defines the fields.
///
/// Errors   one line beginning with the field's place in the manifest. Only the syntax is checked here; check_world.h has
///          the rest.
/// Threads  pure; any.
#pragma once

#include "app/pack/pack_world.h"
#include "firmware_host/base/result.h"

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::pack {

inline constexpr std::string_view cells_section = "cells";
inline constexpr std::string_view behaviours_section = "behaviours";
/// In the order of world::Path.
inline constexpr std::array<std::string_view, 4> path_names{"translation", "rotation", "scale", "light"};

/// Null if the pack does not have the section.
[[nodiscard]] const PackSection* find_section(const PackDescription& pack, std::string_view name);

/// Empty without the sections; the curves are empty.
[[nodiscard]] Result<PackWorld> read_world_sections(const PackDescription& pack);
[[nodiscard]] std::string write_cells(const PackWorld& world);
[[nodiscard]] std::string write_behaviours(const std::vector<PackBehaviour>& behaviours);

} // namespace frustumscreen::pack
