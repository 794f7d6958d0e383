/// The contents of a pack's torch, in the reports of frustumscreen-pack.
///
/// Errors   none: of a pack whose section is damaged nothing is reported (`verify` tells the reason).
/// Threads  pure; any.
#pragma once

#include "app/pack/pack.h"
#include "app/pack/pack_contents.h"

#include <nlohmann/json_fwd.hpp>

#include <span>
#include <string>

namespace frustumscreen::programs {

/// [{name, blend, shape, height_per_width, stages: [{source, mix, opacity, and what it shows: width, height, frames,
/// rate_hz, layer, bytes}], titles: {language: text}}]; `bytes` as stored in the file.
[[nodiscard]] nlohmann::ordered_json torches_json(const pack::PackDescription& pack,
                                                  std::span<const pack::PackPart> parts);
/// A line for each content; empty without any.
[[nodiscard]] std::string torches_text(const pack::PackDescription& pack,
                                       std::span<const pack::PackPart> parts);

} // namespace frustumscreen::programs
