/// Reads the scan of a request, and tells what is lost of it.
///
/// Errors   one sentence.
/// Threads  one caller.
#pragma once

#include "app/programs/bake/bake_request.h"
#include "assets_baked/bake/source_mesh.h"

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen {

/// The mesh's notes list what is lost of the scan, and what is guessed about it.
[[nodiscard]] Result<SourceMesh> load_scan(
    const BakeRequest& request, const std::function<void(std::string_view step, double done)>& progress =
                                    [](std::string_view, double) {});

[[nodiscard]] std::vector<std::string> losses_in(const std::vector<SourceNote>& notes);
/// With --strict, losses are an error.
[[nodiscard]] Result<void> check_losses(const std::vector<SourceNote>& notes, const BakeRequest& request);

} // namespace frustumscreen
