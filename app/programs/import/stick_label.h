/// The label of a stick's file system, as udev found it.
///
/// udev makes a link whose name is `label=` and the label, in which bytes that are no UTF-8, and most marks, are written \xNN
/// (ID_FS_LABEL_ENC). What comes of it is anybody's bytes: printable() before it is told.
///
/// Threads  any.
/// Errors   none: without such a link the stick has no label.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace frustumscreen {

/// \xNN into the byte; anything else stays what it is.
[[nodiscard]] std::string unescaped_label(std::string_view escaped);
/// Of the first link in the folder whose name begins so.
[[nodiscard]] std::string label_in(const std::filesystem::path& folder);

} // namespace frustumscreen
