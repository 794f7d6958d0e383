/// The museum's own recordings of texts: FOLDER/LANGUAGE/KEY.wav, .flac, .opus or .ogg.
///
/// Errors   one sentence, the file's name first.
/// Threads  pure apart from reading the file; any.
#pragma once

#include "assets_baked/texts/level_speech.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace frustumscreen {

/// Nothing if there is none; `folder` may be empty: then there is none.
[[nodiscard]] std::optional<std::filesystem::path>
find_recording(const std::filesystem::path& folder, const std::string& language, const std::string& key);

/// The names LANGUAGE/KEY that a folder is searched for, each with the recording that is taken, if there is one.
using RecordingNames = std::map<std::string, std::optional<std::filesystem::path>>;

/// A sentence for each sound file in `folder` and its folders that is not taken, with the nearest name. `left_out`: languages that
/// nobody asked for.
[[nodiscard]] std::vector<std::string> unused_recordings(const std::filesystem::path& folder,
                                                         const RecordingNames& names,
                                                         const std::vector<std::string>& left_out);

/// Made as loud as all speech.
[[nodiscard]] Result<Speech> read_speech(const std::filesystem::path& file);

} // namespace frustumscreen
