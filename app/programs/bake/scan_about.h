/// What the pack says of the scan: the request over what the scan's file says of itself over what is usual.
///
/// Threads  pure; any.
#pragma once

#include "app/programs/bake/bake_request.h"
#include "assets_baked/bake/source_mesh.h"

#include <string>
#include <vector>

namespace frustumscreen {

/// Of an artifact that nobody named: the pack's name in small letters, so that a pack replaces an older one of its name.
[[nodiscard]] std::string default_id(const std::filesystem::path& pack_file);

struct CompletedRequest {
    BakeRequest request;           ///< every caption has a title, and there is an id
    std::vector<SourceNote> notes; ///< what was taken, and what of the file is lost
};
[[nodiscard]] CompletedRequest completed(BakeRequest request, const SourceAbout& about);

} // namespace frustumscreen
