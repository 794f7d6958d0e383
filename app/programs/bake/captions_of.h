/// The captions that a person wrote on the bake's command line.
///
/// Errors   one sentence, wrong use: no language, a language or caption twice, a caption in a language not named.
/// Threads  pure; any.
#pragma once

#include "app/pack/pack.h"
#include "firmware_host/base/result.h"

#include <span>
#include <string>
#include <vector>

namespace frustumscreen {

/// One for each of `languages`, in their order; English alone if there are none. `captions` are LANGUAGE=TEXT; a
/// language without one has the title alone.
[[nodiscard]] Result<std::vector<PackCaption>> captions_of(const std::string& title,
                                                           std::span<const std::string> languages,
                                                           std::span<const std::string> captions);

} // namespace frustumscreen
