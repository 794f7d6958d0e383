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

/// The use of a keyword: obj_materials.cpp shows or tells what is `Read`; what is `Shine` makes no difference in the
/// museum light; what is `Lost` is told here.
enum class Use { Read, Shine, Lost };
struct Keyword {
    std::string_view name; ///< in tinyobjloader's spelling, which ignores keywords that it does not know
    Use use;
};
constexpr std::array keywords = {
    Keyword{"newmtl", Use::Read},    Keyword{"Kd", Use::Read},          Keyword{"Ke", Use::Read},
    Keyword{"Tr", Use::Read},        Keyword{"d", Use::Read},           Keyword{"map_Kd", Use::Read},
    Keyword{"map_Ke", Use::Read},    Keyword{"map_d", Use::Read},       Keyword{"bump", Use::Read},
    Keyword{"map_bump", Use::Read},  Keyword{"disp", Use::Read},        Keyword{"map_disp", Use::Read},
    Keyword{"norm", Use::Read},      Keyword{"Ka", Use::Shine},         Keyword{"Ks", Use::Shine},
    Keyword{"Kt", Use::Shine},       Keyword{"Tf", Use::Shine},         Keyword{"Ni", Use::Shine},
    Keyword{"Ns", Use::Shine},       Keyword{"illum", Use::Shine},      Keyword{"map_Ka", Use::Shine},
    Keyword{"map_Ks", Use::Shine},   Keyword{"map_Ns", Use::Shine},     Keyword{"refl", Use::Shine},
    Keyword{"map_refl", Use::Shine}, Keyword{"Pr", Use::Shine},         Keyword{"Pm", Use::Shine},
    Keyword{"Ps", Use::Shine},       Keyword{"Pc", Use::Shine},         Keyword{"Pcr", Use::Shine},
    Keyword{"map_Pr", Use::Shine},   Keyword{"map_Pm", Use::Shine},     Keyword{"map_Ps", Use::Shine},
    Keyword{"map_Pc", Use::Shine},   Keyword{"map_Pcr", Use::Shine},    Keyword{"aniso", Use::Shine},
    Keyword{"anisor", Use::Shine},   Keyword{"sharpness", Use::Shine},  Keyword{"map_aat", Use::Shine},
    Keyword{"decal", Use::Lost},     Keyword{"map_opacity", Use::Lost}, Keyword{"map_Tr", Use::Lost},
    Keyword{"map_norm", Use::Lost}};

char lower(char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c + ('a' - 'A')) : c;
}

/// Null: unknown.
const Keyword* known_keyword(std::string_view keyword) {
    for (const Keyword& each : keywords) {
        if (std::equal(each.name.begin(), each.name.end(), keyword.begin(), keyword.end(),
                       [](char x, char y) { return lower(x) == lower(y); })) {
            return &each;
        }
    }
    return nullptr;
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
        const Keyword* const found = known_keyword(keyword);
        const std::string_view known = found == nullptr ? std::string_view() : found->name;
        if (found != nullptr && found->use == Use::Lost) {
            read.lost.emplace(keyword.substr(0, 40));
            continue;
        }
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
