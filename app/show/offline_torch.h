/// A torch's content in an offline picture, read from a pack's file: only the chosen content's parts.
///
/// Errors   a content that the pack does not have; as the readers of pack_torches.h.
/// Threads  any.
#pragma once

#include "app/show/offline_scene.h"
#include "firmware_host/base/result.h"

#include <filesystem>
#include <string>

namespace frustumscreen::show {

/// `name`: torch::white_name, or one of the pack's contents. `scene`: all else of it has been read.
[[nodiscard]] Result<OfflineTorch> load_offline_torch(const std::filesystem::path& file,
                                                      const OfflineScene& scene, const std::string& name);

/// A layer of the pack alone: textures and colours in place of those of each thing that is drawn.
[[nodiscard]] Result<OfflineTorch> load_offline_layer(const std::filesystem::path& file,
                                                      const OfflineScene& scene, std::size_t layer);

} // namespace frustumscreen::show
