/// Sets a request's texts for the kiosk's captions and speaks them; frustumscreen-bake puts both into the pack.
///
/// Errors   as speak_artifact.h.
/// Threads  one caller.
#pragma once

#include "app/pack/pack_texts.h"
#include "app/pack/pack_world.h"
#include "app/programs/bake/bake_request.h"

#include <span>
#include <string>
#include <vector>

namespace frustumscreen::programs {

struct ArtifactWords {
    std::vector<pack::SetLanguage> set;
    std::vector<pack::SpokenLanguage> spoken;
    std::vector<std::string> silent; ///< descriptions without speech, and why, a sentence each
    std::vector<std::string> lost;   ///< texts that cannot be shown or spoken, a sentence each
};

/// `behaviours`: what moves, whose titles are set.
[[nodiscard]] Result<ArtifactWords> words_of(const BakeRequest& request,
                                             std::span<const pack::PackBehaviour> behaviours);

/// Gives the set titles of `behaviours` the keys that they have in a pack with `kept`, some of them in the same order.
void number_titles(std::span<const pack::PackBehaviour> behaviours, std::span<const pack::PackBehaviour> kept,
                   std::vector<pack::SetLanguage>& set);

} // namespace frustumscreen::programs
