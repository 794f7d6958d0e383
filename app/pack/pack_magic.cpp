#include "app/pack/pack_magic.h"

#include "app/pack/manifest.h"

#include <array>
#include <fstream>
#include <string_view>

namespace frustumscreen::pack {

bool begins_as_pack(const std::filesystem::path& file) {
    constexpr std::string_view signature("PK\x03\x04", 4);
    constexpr std::size_t name_length_at = 26;
    constexpr std::size_t name_at = 30;

    std::array<char, name_at + manifest_name.size()> head{};
    std::ifstream stream(file, std::ios::binary);
    if (!stream.read(head.data(), head.size())) {
        return false;
    }
    const std::string_view text(head.data(), head.size());
    return text.starts_with(signature) && text[name_length_at] == static_cast<char>(manifest_name.size()) &&
           text[name_length_at + 1] == 0 && text.substr(name_at) == manifest_name;
}

} // namespace frustumscreen::pack
