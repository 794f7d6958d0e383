/// Hash of a plan's picture.
///
/// Threads  pure; any. Allocates nothing.
/// Method   FNV-1a over 64-bit words.
#pragma once

#include "app/scene/frame_plan.h"

#include <cstdint>

namespace frustumscreen::scene {

/// Equal for equal pictures of one renderer; stored in FramePlan::hash.
[[nodiscard]] std::uint64_t hash_of(const FramePlan& plan);
/// As above, only for the draws in the prop; stored in FramePlan::prop_hash.
[[nodiscard]] std::uint64_t hash_of_prop(const FramePlan& plan);
/// Hash of one draw.
[[nodiscard]] std::uint64_t hash_of(const Draw& draw);

} // namespace frustumscreen::scene
