/// The pack's facts about the scan: the request overrides the scan's file, which overrides the defaults.
///
/// Threads  pure; any.
#pragma once

#include "app/programs/bake/bake_request.h"
#include "assets_baked/bake/source_mesh.h"

#include <string>
#include <vector>

namespace frustumscreen::programs {

/// The id of an artifact without one: the pack's name in lower case, so that a pack replaces an older one with its
/// name.
[[nodiscard]] std::string default_id(const std::filesystem::path& pack_file);

struct CompletedRequest {
    BakeRequest request;                 ///< every caption has a title, and the id is set
    std::vector<bake::SourceNote> notes; ///< facts taken from the file, and losses
};
[[nodiscard]] CompletedRequest completed(BakeRequest request, const bake::SourceAbout& about);

} // namespace frustumscreen::programs
