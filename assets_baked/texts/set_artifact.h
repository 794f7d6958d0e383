/// Sets the texts of an artifact in all their languages: captions, attribution, the labels of hotspots, the titles of
/// behaviours, of a torch's contents and of states, by the keys of app/pack/pack_texts.h.
///
/// Losses are reported, a sentence each: a language whose typeface is missing, a text that is too long to be
/// shaped, a letter that no typeface has, a word or a caption that fits nowhere. The plain texts are not
/// affected.
///
/// Threads  one caller.
/// Errors   none: all problems become notes.
#pragma once

#include "app/pack/attribution.h"
#include "app/pack/pack.h"
#include "app/pack/pack_texts.h"
#include "assets_baked/texts/shape.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace frustumscreen::texts {

/// Widths of lines, in 1/1024 of each text's own type size, and the height of title and text together, in
/// 1/1024 of the text's type size, above which a caption fits nowhere.
struct CaptionLimits {
    std::vector<std::int32_t> text;
    std::vector<std::int32_t> title;
    double title_em = 1.0; ///< the title's type size relative to the text's
    std::int32_t max_height = 0;
};

struct SetArtifact {
    std::vector<pack::SetLanguage> languages;
    std::vector<std::string> notes; ///< losses, a sentence each
};

/// Words beside the captions, a list for each thing that they name.
struct SetLabels {
    std::vector<std::vector<pack::PackLabel>> hotspots, behaviours, torches, states;
};

[[nodiscard]] SetArtifact set_artifact(std::span<const pack::PackCaption> captions,
                                       const pack::ScanRights& rights, const SetLabels& labels,
                                       const CaptionLimits& limits, const Shaper& shaper);

} // namespace frustumscreen::texts
