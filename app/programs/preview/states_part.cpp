#include "app/programs/preview/states_part.h"

#include "app/pack/pack_states.h"
#include "firmware_host/base/xml_text.h"

#include <fmt/format.h>

#include <vector>

namespace frustumscreen::programs {

std::string states_part(const pack::PackDescription& pack) {
    const std::vector<pack::PackState> states =
        pack::states_of(pack).value_or(std::vector<pack::PackState>());
    if (states.empty()) {
        return {};
    }
    std::string items;
    for (const pack::PackState& state : states) {
        items += fmt::format("<li><b>{}</b>", xml_text(state.name));
        for (const pack::PackLabel& title : state.titles) {
            items += fmt::format("<br>{0}: <span lang=\"{0}\" dir=\"auto\">{1}</span>",
                                 xml_text(title.language), xml_text(title.text));
        }
        items += "</li>\n";
    }
    return fmt::format(
        "<h2>States side by side</h2>\n<p class=\"soft\">Where the exhibit has windows, a visitor "
        "pins what the prop shows onto the table. Further presses pin these states beside it, in "
        "the same view, each with its title below.</p>\n<ol>\n{}</ol>\n",
        items);
}

} // namespace frustumscreen::programs
