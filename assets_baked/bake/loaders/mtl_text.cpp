#include "assets_baked/bake/loaders/mtl_text.h"

#include "assets_baked/bake/loaders/text.h"
#include "firmware_host/base/trimmed.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

namespace frustumscreen::bake {

namespace {

constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

// In tinyobjloader's spelling; it ignores keywords that it does not know.
constexpr std::array keywords = {
    "newmtl", "Ka",      "Kd",       "Ks",     "Kt",       "Tf",        "Ke",         "Ni",     "Ns",
    "Tr",     "d",       "illum",    "map_Ka", "map_Kd",   "map_Ks",    "map_Ke",     "map_Ns", "map_d",
    "map_Tr", "bump",    "map_bump", "disp",   "map_disp", "norm",      "map_norm",   "refl",   "map_refl",
    "decal",  "Pr",      "Pm",       "Ps",     "Pc",       "Pcr",       "map_Pr",     "map_Pm", "map_Ps",
    "map_Pc", "map_Pcr", "aniso",    "anisor", "map_aat",  "sharpness", "map_opacity"};

char lower(char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c + ('a' - 'A')) : c;
}

/// The keyword in the library's spelling; empty: unknown.
std::string_view known_keyword(std::string_view keyword) {
    for (const std::string_view each : keywords) {
        if (std::equal(each.begin(), each.end(), keyword.begin(), keyword.end(),
                       [](char x, char y) { return lower(x) == lower(y); })) {
            return each;
        }
    }
    return {};
}

/// The three numbers of a colour; empty for anything else, such as a spectral curve.
std::vector<double> colour_from(std::string_view rest) {
    WordReader words(rest);
    std::vector<double> colour;
    for (std::string_view word = words.next(); !word.empty() && !word.starts_with('#'); word = words.next()) {
        const std::optional<double> value = number_from(word);
        if (!value) {
            return {};
        }
        colour.push_back(*value);
    }
    if (colour.size() == 1) {
        colour.resize(3, colour.front());
    }
    return colour.size() == 3 ? colour : std::vector<double>();
}

bool is_in_codes(const std::vector<double>& colour) {
    const auto [low, high] = std::minmax_element(colour.begin(), colour.end());
    return *low >= 0.0 && *high > 1.0 && *high <= 255.0;
}

} // namespace

MtlText mtl_text_from(std::string_view file) {
    file.remove_prefix(file.starts_with(byte_order_mark) ? byte_order_mark.size() : 0);
    MtlText read;
    while (!file.empty()) {
        const std::size_t end = std::min(file.find_first_of("\r\n"), file.size());
        WordReader words(file.substr(0, end));
        file.remove_prefix(std::min(end + 1, file.size()));
        const std::string_view keyword = words.next();
        if (keyword.empty() || keyword.starts_with('#')) {
            continue;
        }
        const std::string_view known = known_keyword(keyword);
        const std::string_view rest = trimmed(words.rest_of_line());
        const bool is_colour = known == "Kd" || known == "Ke";
        const std::vector<double> colour = is_colour ? colour_from(rest) : std::vector<double>();
        if (known.empty() || (is_colour && colour.empty())) {
            read.unknown.emplace(keyword.substr(0, 40));
            continue;
        }
        if (is_colour) {
            read.text += fmt::format("{} {} {} {}\n", known, colour[0], colour[1], colour[2]);
            read.kd_in_codes = read.kd_in_codes || (known == "Kd" && is_in_codes(colour));
        } else {
            read.text += fmt::format("{} {}\n", known, rest);
        }
        if (known == "newmtl") {
            read.text += "Kd 1 1 1\n"; // the library's own default is black, or 0.6 with a picture
        }
    }
    return read;
}

} // namespace frustumscreen::bake
