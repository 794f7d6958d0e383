#include "app/settings/language_tag.h"

#include <algorithm>

namespace frustumscreen::settings {

namespace {

/// ISO 639-1. A language with a two-letter code is always named by that code (RFC 5646, 2.2.1).
constexpr std::string_view two_letter_codes =
    "aa ab ae af ak am an ar as av ay az ba be bg bi bm bn bo br bs ca ce ch co cr cs cu cv cy da de "
    "dv dz ee el en eo es et eu fa ff fi fj fo fr fy ga gd gl gn gu gv ha he hi ho hr ht hu hy hz ia "
    "id ie ig ii ik io is it iu ja jv ka kg ki kj kk kl km kn ko kr ks ku kv kw ky la lb lg li ln lo "
    "lt lu lv mg mh mi mk ml mn mr ms mt my na nb nd ne ng nl nn no nr nv ny oc oj om or os pa pi pl "
    "ps pt qu rm rn ro ru rw sa sc sd se sg sh si sk sl sm sn so sq sr ss st su sv sw ta te tg th ti "
    "tk tl tn to tr ts tt tw ty ug uk ur uz ve vi vo wa wo xh yi yo za zh zu ";

bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

std::string lower(std::string_view text) {
    std::string made(text);
    std::transform(made.begin(), made.end(), made.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return made;
}

char upper(char c) {
    return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

/// A region is in capitals, a script has one capital; neither follows a subtag of one letter.
std::string in_usual_case(std::string_view subtag, bool after_single) {
    std::string made = lower(subtag);
    if (!after_single && made.size() == 2) {
        made = {upper(made[0]), upper(made[1])};
    } else if (!after_single && made.size() == 4) {
        made[0] = upper(made[0]);
    }
    return made;
}

/// There are too many three-letter codes for a list here: any three letters count as a code.
bool is_language_code(std::string_view code) {
    if (code.size() == 3) {
        return true;
    }
    return code.size() == 2 && two_letter_codes.find(lower(code) + " ") != std::string_view::npos;
}

} // namespace

std::optional<std::string> parse_language_tag(std::string_view tag) {
    const std::string_view code = tag.substr(0, tag.find('-'));
    if (!std::all_of(code.begin(), code.end(), is_letter) || !is_language_code(code)) {
        return std::nullopt;
    }
    std::string usual = lower(code);
    bool after_single = false;
    for (std::size_t begin = code.size(); begin < tag.size();) {
        const std::size_t end = std::min(tag.find('-', begin + 1), tag.size());
        const std::string_view subtag = tag.substr(begin + 1, end - begin - 1);
        if (subtag.empty() || subtag.size() > 8 || !std::all_of(subtag.begin(), subtag.end(), [](char c) {
                return is_letter(c) || (c >= '0' && c <= '9');
            })) {
            return std::nullopt;
        }
        usual += '-' + in_usual_case(subtag, after_single);
        after_single = after_single || subtag.size() == 1;
        begin = end;
    }
    return usual;
}

} // namespace frustumscreen::settings
