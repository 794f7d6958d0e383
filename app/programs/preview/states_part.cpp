#include "app/programs/preview/states_part.h"

#include "app/programs/preview/html_parts.h"
#include "firmware_host/base/xml_text.h"

#include <fmt/format.h>

namespace frustumscreen::programs {

namespace {

constexpr float quality = 82.0F;

std::string figure_of(const StatePicture& drawn) {
    const std::string name = xml_text(drawn.state.name);
    std::string told;
    for (const pack::PackLabel& title : drawn.state.titles) {
        told += fmt::format("<br>{0}: <span lang=\"{0}\" dir=\"auto\">{1}</span>", xml_text(title.language),
                            xml_text(title.text));
    }
    return fmt::format("<figure class=\"state\"><img alt=\"{0}: the artifact in this state\" src=\"{1}\">"
                       "<figcaption><b>{0}</b>{2}</figcaption></figure>\n",
                       name, data_address("image/webp", image::encode_lossy_webp(drawn.picture, quality)),
                       told);
}

} // namespace

std::string states_part(const std::vector<StatePicture>& states) {
    if (states.empty()) {
        return {};
    }
    std::string figures;
    for (const StatePicture& drawn : states) {
        figures += figure_of(drawn);
    }
    return fmt::format(
        "<h2>States side by side</h2>\n<p class=\"soft\">Where the exhibit has windows, a visitor "
        "pins what the prop shows onto the table. Further presses pin these states beside it, in "
        "this order and in the same view, each with its title below.</p>\n<div class=\"states\">\n{}</div>\n",
        figures);
}

} // namespace frustumscreen::programs
