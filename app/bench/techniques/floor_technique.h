/// The floor that costs are ratios of, as a technique.
#pragma once

#include "app/bench/techniques/technique.h"

#include <memory>

namespace frustumscreen {

[[nodiscard]] Result<std::unique_ptr<Technique>> make_floor_technique(const Stage& stage);

} // namespace frustumscreen
