#include "assets_baked/names/file_name.h"

#include <glib.h>

#include <memory>

namespace frustumscreen::names {

namespace {

using GText = std::unique_ptr<char, decltype(&g_free)>;

GText owned(char* text) {
    return {text, g_free};
}

} // namespace

std::string folded_file_name(std::string_view name) {
    const auto bytes = static_cast<gssize>(name.size());
    GText utf8 =
        owned(g_utf8_validate(name.data(), bytes, nullptr)
                  ? g_strndup(name.data(), name.size())
                  : g_convert(name.data(), bytes, "UTF-8", "WINDOWS-1252", nullptr, nullptr, nullptr));
    if (!utf8) { // a byte that is undefined in the code page
        return std::string(name);
    }
    const GText folded = owned(g_utf8_casefold(utf8.get(), -1));
    const GText composed = owned(g_utf8_normalize(folded.get(), -1, G_NORMALIZE_NFC));
    return composed ? composed.get() : utf8.get();
}

bool is_same_file_name(std::string_view a, std::string_view b) {
    return a == b || folded_file_name(a) == folded_file_name(b);
}

} // namespace frustumscreen::names
