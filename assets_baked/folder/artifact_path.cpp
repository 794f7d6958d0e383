#include "assets_baked/folder/artifact_path.h"

#include "firmware_host/base/printable.h"

#include <fmt/format.h>

#include <string>

namespace frustumscreen::folder {

void read_path(settings::TableReader& table, std::string_view key, std::filesystem::path& value) {
    std::filesystem::path written;
    std::string text;
    table.any_text(key, text);
    written = std::filesystem::path(text).lexically_normal();
    if (text.empty()) {
        return;
    }
    if (written.is_absolute() || *written.begin() == ".." || text.size() > 4096 ||
        text.find('\0') != std::string::npos) {
        table.refuse(
            "folder.file_name", key,
            fmt::format("is \"{}\"; allowed is the name of a file in this folder", printable(text, 60)));
        return;
    }
    table.path(key, value, {});
}

} // namespace frustumscreen::folder
