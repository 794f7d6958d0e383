/// The museum's own recordings of texts: FOLDER/LANGUAGE/KEY.wav, .flac, .opus or .ogg.
///
/// Errors   one sentence, the file's name first.
/// Threads  pure apart from reading the file; any.
#pragma once

#include "assets_baked/texts/level_speech.h"

#include <filesystem>
#include <optional>
#include <string>

namespace frustumscreen {

/// Nothing if there is none; `folder` may be empty: then there is none.
[[nodiscard]] std::optional<std::filesystem::path>
find_recording(const std::filesystem::path& folder, const std::string& language, const std::string& key);

/// Made as loud as all speech.
[[nodiscard]] Result<Speech> read_speech(const std::filesystem::path& file);

} // namespace frustumscreen
