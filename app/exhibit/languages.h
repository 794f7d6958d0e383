/// Which of some languages, named by BCP 47 tags, stands for the one that is asked for.
///
/// Threads  pure; any.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen {

/// Index of the caption for `language` among captions in `languages`: the same tag, else the same language
/// with another region or script, else English, else the first. `languages` is not empty.
[[nodiscard]] std::size_t caption_for(std::string_view language, std::span<const std::string> languages);
/// Appends a language that is not there yet.
void add_language(std::vector<std::string>& languages, const std::string& language);
/// One of them is this language, with this region and script or others.
[[nodiscard]] bool has_language(std::span<const std::string> languages, std::string_view language);

} // namespace frustumscreen
