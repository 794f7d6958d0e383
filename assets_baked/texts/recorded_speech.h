/// The museum's own recordings of texts: FOLDER/LANGUAGE/KEY.wav, .flac, .opus or .ogg, in any case (find_entry.h).
///
/// Errors   one sentence; messages begin with the file's name.
/// Threads  pure except for reading files; any.
#pragma once

#include "assets_baked/texts/level_speech.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace frustumscreen::texts {

/// nullopt if there is no recording; `folder` may be empty, which means none.
[[nodiscard]] std::optional<std::filesystem::path>
find_recording(const std::filesystem::path& folder, const std::string& language, const std::string& key);

/// The names LANGUAGE/KEY that are searched for in a folder, each with the recording that is used, if any.
using RecordingNames = std::map<std::string, std::optional<std::filesystem::path>>;

/// A sentence for each unused sound file in `folder` and its subfolders, with the nearest name. `left_out`:
/// languages that were not requested.
[[nodiscard]] std::vector<std::string> unused_recordings(const std::filesystem::path& folder,
                                                         const RecordingNames& names,
                                                         const std::vector<std::string>& left_out);

/// Reads a recording, levelled like all speech.
[[nodiscard]] Result<Speech> read_speech(const std::filesystem::path& file);

} // namespace frustumscreen::texts
