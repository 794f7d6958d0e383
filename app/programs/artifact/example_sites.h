/// Two made-up sites to try, each as a model and a curator's folder: a hill town and an excavation (app/simulation/site.h).
///
/// Frame    of the model as built-in artifacts': +Y up; metres.
/// Errors   an unknown name, a number of triangles that is not allowed.
/// Threads  pure; any. The same request gives the same bytes.
#pragma once

#include "assets_baked/bake/source_mesh.h"
#include "firmware_host/base/result.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::programs {

[[nodiscard]] bool is_example_site(std::string_view name);
/// Name and what it is.
struct ExampleSite {
    std::string_view name, what;
};
[[nodiscard]] std::vector<ExampleSite> example_sites();

[[nodiscard]] Result<bake::SourceMesh> make_example_site(std::string_view name, std::int64_t triangles);
/// The artifact.toml of its folder.
[[nodiscard]] std::string example_site_text(std::string_view name);

} // namespace frustumscreen::programs
