/// The label of a stick's file system, as udev found it.
///
/// udev makes a link whose name is `label=` and the label, in which most punctuation and bytes that are not UTF-8 are
/// written \xNN (ID_FS_LABEL_ENC). The result may be any bytes: pass it through printable() before it is shown.
///
/// Threads  any.
/// Errors   none: without such a link the stick has no label.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace frustumscreen::programs {

/// Replaces each \xNN by its byte; other text is kept.
[[nodiscard]] std::string unescaped_label(std::string_view escaped);
/// The label in the name of the folder's first link that begins with `label=`.
[[nodiscard]] std::string label_in(const std::filesystem::path& folder);

} // namespace frustumscreen::programs
