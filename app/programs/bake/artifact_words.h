/// The texts of a request, set for the kiosk's captions and spoken; frustumscreen-bake puts them into the pack.
///
/// Errors   speak_artifact.h.
/// Threads  one caller.
#pragma once

#include "app/pack/pack_texts.h"
#include "app/programs/bake/bake_request.h"

#include <string>
#include <vector>

namespace frustumscreen {

struct ArtifactWords {
    std::vector<SetLanguage> set;
    std::vector<SpokenLanguage> spoken;
    std::vector<std::string> silent; ///< which descriptions nobody hears, and why, a sentence each
    std::vector<std::string> lost;   ///< a sentence each
};

[[nodiscard]] Result<ArtifactWords> words_of(const BakeRequest& request);

} // namespace frustumscreen
