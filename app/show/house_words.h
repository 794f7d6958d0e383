/// The exhibit's own words in the house's language, or in the one nearest to it that the file has.
///
/// Errors   one line that names the file: it cannot be read, or is older than the words that are wanted.
/// Threads  any; it reads a file.
#pragma once

#include "app/pack/words_file.h"
#include "app/settings/settings.h"
#include "firmware_host/base/result.h"

#include <string_view>

namespace frustumscreen {

/// `key`: one of the words that are wanted.
[[nodiscard]] Result<LanguageWords> read_house_words(const Settings& settings, std::string_view key);

} // namespace frustumscreen
