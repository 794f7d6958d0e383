#include "app/programs/calibrate/table_words.h"

#include <cctype>

namespace frustumscreen {

std::string as_sentence(std::string reason) {
    if (!reason.empty()) {
        reason.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(reason.front())));
        reason += '.';
    }
    return reason;
}

std::vector<Paragraph> paragraphs_of(const std::vector<std::string>& lines, double unit) {
    std::vector<Paragraph> paragraphs;
    for (const std::string& line : lines) {
        const bool is_first = paragraphs.empty();
        paragraphs.push_back({line, (is_first ? 4.0 : 2.6) * unit, is_first, 1.0, is_first ? 0.0 : unit});
    }
    return paragraphs;
}

void draw_dots(Canvas& canvas, const glm::dvec2& middle, double unit, int count,
               const std::function<bool(int)>& is_done, const DotColours& colours) {
    for (int k = 0; k < count; ++k) {
        const bool done = is_done(k);
        canvas.circle(middle + glm::dvec2((k - 0.5 * (count - 1)) * 4.0 * unit, 0.0), unit, done ? 4.0 : 1.0,
                      done ? colours.done : colours.open);
    }
}

} // namespace frustumscreen
