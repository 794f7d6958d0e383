#include "app/programs/import/stick_label.h"

#include <charconv>
#include <system_error>

namespace frustumscreen::programs {

std::string unescaped_label(std::string_view escaped) {
    constexpr std::string_view mark = "\\x";
    constexpr std::size_t digits = 2;
    std::string label;
    while (!escaped.empty()) {
        unsigned char byte = 0;
        const char* const first = escaped.data() + mark.size();
        if (escaped.starts_with(mark) && escaped.size() >= mark.size() + digits &&
            std::from_chars(first, first + digits, byte, 16).ptr == first + digits) {
            label.push_back(static_cast<char>(byte));
            escaped.remove_prefix(mark.size() + digits);
        } else {
            label.push_back(escaped.front());
            escaped.remove_prefix(1);
        }
    }
    return label;
}

std::string label_in(const std::filesystem::path& folder) {
    constexpr std::string_view beginning = "label=";
    std::error_code failed;
    for (std::filesystem::directory_iterator each(folder, failed), end; !failed && each != end;
         each.increment(failed)) {
        const std::string name = each->path().filename().string();
        if (name.starts_with(beginning)) {
            return unescaped_label(std::string_view(name).substr(beginning.size()));
        }
    }
    return {};
}

} // namespace frustumscreen::programs
