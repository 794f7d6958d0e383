/// The contents of an artifact's torch, from artifact.toml and the files that it names.
///
/// Errors   one line that begins with the place in artifact.toml: a picture or film that a pack does not hold.
/// Threads  one caller; encodes on all cores.
#pragma once

#include "app/pack/pack_torches.h"
#include "app/programs/bake/bake_request.h"
#include "assets_baked/bake/source_mesh.h"
#include "firmware_host/base/result.h"

#include <string>
#include <vector>

namespace frustumscreen::programs {

struct TorchContents {
    pack::PackTorches torches; ///< without the layers' parts
    pack::TorchParts parts;    ///< without the layers'
    std::vector<bake::SourceNote> notes;
    std::vector<std::string> told; ///< what each content shows, a line each: "x-ray: layer xray.png, over"
};

/// `Look`: films are not decoded, and the parts are left out.
enum class Contents { Look, Read };
/// `mesh` has the request's layers.
[[nodiscard]] Result<TorchContents> contents_of(const BakeRequest& request, const bake::SourceMesh& mesh,
                                                Contents contents);

} // namespace frustumscreen::programs
