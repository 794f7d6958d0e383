/// The exhibit's own texts in the house's language, or in the nearest one in the file; and their recordings.
///
/// Errors   one line that names the file: it cannot be read, or is too old to have the requested texts.
/// Threads  any; reads a file.
#pragma once

#include "app/pack/words_file.h"
#include "app/residency/prompt_reader.h"
#include "app/settings/settings.h"
#include "firmware_host/base/result.h"

#include <string>
#include <string_view>

namespace frustumscreen::show {

/// `key`: one of the requested texts.
[[nodiscard]] Result<pack::LanguageWords> read_default_words(const settings::Settings& settings,
                                                             std::string_view key);

/// The spoken text of `key`; null if it has no recording. `gain_db`: at most 0.
[[nodiscard]] residency::SharedRecording word_recording(const pack::LanguageWords& words,
                                                        const std::string& key, double gain_db = 0.0);

} // namespace frustumscreen::show
